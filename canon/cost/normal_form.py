"""What the order of a normal form costs, and what it gains: the remainder of H in the new variables at a distance from
the equilibrium, which first falls with the order and, as the series diverges, rises again.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import numpy as np
import sympy as sp

from canon.cost.clock import timed
from canon.cost.reference import ordinary
from canon.cost.study import Point, Study
from canon.errors import InputError
from canon.expected import formula_of
from canon.mechanics.birkhoff import NormalForm, birkhoff_gustavson
from canon.mechanics.phase_space import PhaseSpace
from canon.numeric.lower import lower
from canon.scenes.scene import Scene

DIRECTIONS: Final = 64
RADIUS: Final = 0.1

Watch = Callable[[str], None]


def cost_of_normal_form(
    title: str, space: PhaseSpace, H: Any, *, order: int = 10, radius: float = RADIUS, seed: int = 0, cap: float = 20.0,
    watch: Watch | None = None,
) -> Study:  # fmt: skip
    """The largest |H(T(x)) − N(x)| / |H(x)| at random points of the sphere |x| = radius, for orders from 3 on.

    T is the transformation and N the normal form, both truncated at the order; rounding of doubles is the floor.

    **Raises:** `InputError` where the origin is no equilibrium; `NoNormalForm` where H₂ isn't semisimple.
    """
    rng = np.random.default_rng(seed)
    sphere = rng.standard_normal((DIRECTIONS, 2 * space.n))
    x = radius * (sphere / np.linalg.norm(sphere, axis=1, keepdims=True))
    energy = lower((formula_of(H, "H"),), tuple(space.old))
    with np.errstate(all="ignore"):
        size = float(np.abs(energy(*x.T, numbers=np)[0]).max())
    if not 1e-290 < size < 1e290:
        raise InputError(f"at a distance {radius:g} H is about {size:g}, of which doubles keep no digits", "--radius")
    points: list[Point] = []
    for k in range(3, order + 1):
        if watch:
            watch(f"order {k}")
        form, timing = timed(lambda k=k: birkhoff_gustavson(space, H, k), cap=cap)
        error = float(np.abs(_remainder(form, energy, x)).max()) / size
        points.append(
            Point("Lie series", k, error, timing.median, timing.least, timing.first, timing.runs)
        )  # fmt: skip
        if 3 * timing.median > cap:
            break
    return Study(
        "normal-form", title, "order", f"relative, of H at a distance {radius:g} from the equilibrium",
        "H itself, in the new variables", 2.0**-50, tuple(points),
    )  # fmt: skip


def henon_heiles() -> tuple[str, PhaseSpace, Any]:
    """(title, phase space, H) of Hénon and Heiles (1964), Astron. J. 69, 73."""
    space = PhaseSpace("x y", "p_x p_y")
    x, y, px, py = space.old
    return "Hénon and Heiles", space, (px**2 + py**2 + x**2 + y**2) / 2 + x**2 * y - y**3 / 3


def hamiltonian_of_scene(scene: Scene) -> tuple[str, PhaseSpace, Any]:
    """(title, phase space, H) of a scene, its numbers as the fractions that they are written as.

    **Raises:** `InputError` where the scene has friction, depends on time, or isn't stated in canonical variables.
    """
    model = scene.model
    if not ordinary(model) or model.frictions or model.t in model.H.free_symbols:
        raise InputError("a normal form is one of a Hamiltonian in canonical variables, without friction or time")
    space = PhaseSpace([str(q) for q in model.q], [str(p) for p in model.p])
    H = model.H.subs(dict(zip((*model.q, *model.p), space.old, strict=True)), simultaneous=True)
    return scene.title, space, sp.nsimplify(H, rational=True)


def _remainder(form: NormalForm, energy: Any, x: np.ndarray) -> np.ndarray:
    symbols = tuple(form.algebra.variables)
    images = lower(tuple(form.transformation()), symbols)(*x.T, numbers=np)
    normal = lower((form.hamiltonian(),), symbols)(*x.T, numbers=np)[0]
    return energy(*images, numbers=np)[0] - normal
