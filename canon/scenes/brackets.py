"""Poisson brackets of a scene's integrals along its orbit: which are in involution, and what the others make.

The integrals are the energy and Noether's charges: Σp of translations, Σ x × p of rotations, the Laplace–Runge–Lenz
vector of the hidden symmetry, or what a system of the catalogue names. {f, g} = Σ ∂f/∂q ∂g/∂p − ∂f/∂p ∂g/∂q.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np
import sympy as sp

from canon.errors import InputError
from canon.numeric.observe import observe
from canon.scenes.model import Formula, Model
from canon.scenes.simulate import Result


def integrals(model: Model) -> dict[str, Formula]:
    """The quantities that the monitors of energy, momentum, angular momentum and LRL vector follow, by name."""
    return {"H": model.H, **model.momenta, **model.angular_momenta, **model.lrl}


def brackets_along(result: Result) -> dict[tuple[str, str], np.ndarray]:
    """{f, g} at the stored states (samples,), for every pair of the scene's integrals.

    **Raises:** `InputError` where the state is not (q, p), or is held by constraints.
    """
    model = result.scene.model
    if model.constraints or len(model.q) != len(model.p) or result.q.shape != result.p.shape or model.rigid:
        raise InputError("brackets along the orbit are those of canonical variables, without constraints")
    pairs = list(combinations(integrals(model).items(), 2))
    formulas = [
        sp.Add(*(f.diff(x) * g.diff(y) - f.diff(y) * g.diff(x) for x, y in zip(model.q, model.p, strict=True)))
        for (_, f), (_, g) in pairs
    ]
    values = observe(formulas, (model.q, model.p, model.t), result.times, result.q, result.p)
    return {(one, other): row for ((one, _), (other, _)), row in zip(pairs, values, strict=True)}
