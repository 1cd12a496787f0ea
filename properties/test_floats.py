"""Symbolic verdicts beside floating-point residuals: what is proved is small everywhere, what is refuted isn't."""

import numpy as np
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from canon.claims.verify import verify
from canon.mechanics.transformation import Transformation
from canon.testing import canonical_maps, mutants, phase_spaces

POINTS = 40


def largest(made: Transformation, seed: int) -> float:
    """The largest |M J Mᵀ − J| over |M|² at random points, in floating-point arithmetic."""
    symbols = [*made.space.old, *made.space.parameters]
    jacobian = sp.lambdify(symbols, made.jacobian(), "numpy", cse=True)
    J = np.array(made.space.J.tolist(), dtype=float)
    rng = np.random.default_rng(seed)
    worst = 0.0
    for point in rng.uniform(0.3, 1.5, (POINTS, len(symbols))):
        M = np.array(jacobian(*point), dtype=float)
        size = 1 + float(np.abs(M).max()) ** 2
        worst = max(worst, float(np.abs(M @ J @ M.T - J).max()) / size)
    return worst


@settings(max_examples=max(5, settings.default.max_examples // 2))
@given(st.data())
def test_proved_is_small_in_floats(data: st.DataObject):
    made = data.draw(canonical_maps(data.draw(phase_spaces(max_degrees=2))))
    if verify(made.canonical(), budget=20).status == "proved":
        with np.errstate(all="ignore"):
            assert largest(made, 1) < 1e-8, made


@settings(max_examples=max(5, settings.default.max_examples // 2))
@given(st.data())
def test_refuted_is_not(data: st.DataObject):
    mutant = data.draw(mutants(data.draw(phase_spaces(max_degrees=2)), max_factors=1))
    verdict = verify(mutant.transformation.canonical(), budget=20)
    assert verdict.status == "refuted"
    residual = mutant.transformation.symplectic_residual()
    point = {s: sp.Rational(verdict.witness[s.name]) for s in residual.free_symbols}
    values = sp.lambdify(list(point), residual, "numpy")(*(float(v) for v in point.values()))
    assert np.abs(np.array(values, dtype=float)).max() > 0.5 * min(abs(mutant.defect), 1)
