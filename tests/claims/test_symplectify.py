"""Maps that are nearly symplectic are made so: to rounding, in the right order, and away from caustics."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import sympy as sp

from canon import InputError, PhaseSpace, Transformation, audit, symplectify
from canon.numeric.images import compare_loops
from canon.numeric.mixed_variables import Pattern, best_conditioned, condition_of

Array = np.ndarray
q, p = sp.symbols("q p", real=True)


def truncated(order: int, angle: float = 1.2) -> Callable[[Array], Array]:
    """A rotation after the kick of V = e^q − q, its series about the origin cut after a power."""
    kicked = p - sum(q**k / sp.factorial(k) for k in range(1, order + 1))
    c, s = np.cos(angle), np.sin(angle)
    drift = sum((c * q + s * kicked) ** k / sp.factorial(k) for k in range(2, order + 1))
    scale = sp.Symbol("scale")
    images = [c * q + s * kicked, -s * q + c * kicked - drift]
    cut = [
        sp.expand(f.subs({q: scale * q, p: scale * p}, simultaneous=True)).series(scale, 0, order + 1).removeO()
        for f in map(sp.expand, images)
    ]
    function: Any = sp.lambdify((q, p), [f.subs(scale, 1) for f in cut], "numpy")
    return lambda z: np.array(function(z[0], z[1]))


def circle(radius: float) -> Callable[[Array], Array]:
    return lambda s: radius * np.stack([np.cos(2 * np.pi * s), np.sin(2 * np.pi * s)], axis=1)


@pytest.mark.parametrize(
    "order", [1, pytest.param(2, marks=pytest.mark.slow), pytest.param(3, marks=pytest.mark.slow), 4]
)
def test_a_truncated_series_changes_in_the_next_order(order: int) -> None:
    f = truncated(order)
    repair = symplectify(f, dimension=2, domain=(-0.2, 0.2), samples=40)
    if order == 1:
        assert repair.order is None  # a linear map of one degree of freedom with det 1 is symplectic
        assert repair.largest <= 1e-14
        return
    assert repair.before.verdict == "undecided"
    assert repair.after.verdict == "supported"
    assert repair.order == order + 1
    assert 0 < repair.typical <= repair.largest < 0.2**order
    assert f"the change begins in order {order + 1} of the series about the centre" in str(repair)
    spoiled = compare_loops(lambda z: f(z.T).T, circle(0.2))
    mended = compare_loops(repair, circle(0.2))
    assert spoiled.preserved is False
    assert mended.preserved is True
    assert abs(mended.difference) < 1e-14


def leapfrog(z: Array, h: float = 0.3) -> Array:
    half = z[1] - h / 2 * np.sin(z[0])
    new = z[0] + h * half
    return np.array([new, half - h / 2 * np.sin(new)])


def test_what_is_symplectic_stays() -> None:
    repair = symplectify(leapfrog, dimension=2, samples=60)
    assert repair.largest <= 1e-14
    assert repair.order is None
    assert "too little moved beyond rounding" in str(repair)
    assert repair.after.verdict == "supported"


def test_a_pair_and_many_points_are_taken_too() -> None:
    repair = symplectify(truncated(2), dimension=2, domain=(-0.2, 0.2), samples=20)
    many = repair(np.array([[0.1, 0.05], [0.0, -0.1]]))
    assert repair(np.array([0.1, 0.05])) == pytest.approx(many[0], abs=1e-15)
    Q, P = repair(np.array([0.1]), np.array([0.05]))
    assert [*Q, *P] == pytest.approx(many[0], abs=1e-15)
    assert repair(np.empty((0, 2))).shape == (0, 2)


def turned(angle: float) -> Callable[[Array], Array]:
    """Hénon's map of a phase advance, with a sextupole that is 1% off in one place."""
    c, s = np.cos(angle), np.sin(angle)

    def henon(z: Array) -> Array:
        kicked = z[1] - z[0] ** 2
        return np.array([c * z[0] + s * kicked, -s * z[0] + c * (kicked + 0.01 * z[0] * z[1])])

    return henon


@pytest.mark.parametrize(("angle", "types"), [(0.1, {2, 3}), (np.pi / 2, {1, 4})])
def test_the_type_suits_the_phase_advance(angle: float, types: set[int]) -> None:
    repair = symplectify(turned(angle), dimension=2, domain=(-0.1, 0.1), samples=20)
    assert repair.types[0] in types
    assert repair.compared == 4
    assert repair.condition < 2


def test_a_caustic_is_an_error_for_the_type_that_is_asked_for() -> None:
    with pytest.raises(InputError, match=r"type 2 meets a caustic .* or leave the type to the choice"):
        symplectify(turned(np.pi / 2), dimension=2, domain=(-0.1, 0.1), samples=40, type=2)
    with pytest.raises(InputError, match="a type is 1, 2, 3 or 4"):
        symplectify(leapfrog, dimension=2, type=[2, 2])


def test_every_type_may_meet_a_caustic() -> None:
    def twisted(z: Array) -> Array:
        angle = 40 * (z[0] ** 2 + z[1] ** 2)
        c, s = np.cos(angle), np.sin(angle)
        return np.array([c * z[0] + s * z[1], c * z[1] - s * z[0]])

    with pytest.raises(InputError, match=r"every type of generating function meets a caustic .* a smaller domain"):
        symplectify(twisted, dimension=2)


def test_a_map_that_turns_the_orientation_has_no_symplectic_neighbour() -> None:
    with pytest.raises(InputError, match="its determinant is negative at every sample, theirs is 1"):
        symplectify(lambda z: np.array([z[1], z[0]]), dimension=2, samples=10)


def coupled(z: Array) -> Array:
    """Two oscillators, one turned by a right angle, with a kick that is no gradient by 1e-4."""
    x, y, u, v = z
    u = u - 0.3 * x**2 + 0.2 * x * y
    v = v + 0.1 * x**2 * (1 + 1e-4) - 0.2 * y**2
    y = y + 0.2 * v
    return np.array([u, y, -x, v - 0.1 * y])


def test_types_are_mixed_where_that_is_better() -> None:
    repair = symplectify(coupled, dimension=4, domain=(-0.5, 0.5), samples=40)
    assert repair.compared == 16
    assert repair.types[0] in (1, 4)
    assert repair.types[1] in (2, 3)
    assert repair.after.verdict == "supported"
    assert repair.before.brackets["{Q,P}"].largest > 1e-6
    assert repair.after.worst.size < 1e-11
    assert repair.order == 2
    assert repair.largest < 1e-5


def test_formulas() -> None:
    space = PhaseSpace("q", "p", new=("Q", "P"), real="h")
    x, y, h = space.symbols("q p h")
    kick = Transformation(space, Q=x + h * (y - h * x**2), P=y - h * x**2 + h**4 * x * y**2)
    repair = symplectify(kick, parameters={"h": 0.2}, domain=(-0.3, 0.3), samples=30)
    assert repair.order == 3
    assert repair.after.verdict == "supported"


def test_a_shifted_centre_keeps_its_image() -> None:
    f = truncated(3)
    centre = np.array([0.05, -0.02])
    repair = symplectify(f, dimension=2, domain=(-0.2, 0.2), samples=20, centre=centre)
    assert repair(centre) == pytest.approx(f(centre), abs=1e-15)
    assert repair.order == 1  # about another point the truncated series isn't symplectic in first order


def test_many_degrees_of_freedom_are_improved_one_by_one() -> None:
    n, rng = 12, np.random.default_rng(3)
    turned = rng.permutation(n)[:5]
    M = np.eye(2 * n)
    for k in turned:
        M[[k, k + n]] = M[[k + n, k]] * np.array([[1.0], [-1.0]])
    M = M + 1e-2 * rng.normal(size=M.shape)
    chosen = best_conditioned(M[None])
    assert chosen.compared < 1000
    assert {k for k in range(n) if chosen.types[k] in (1, 4)} == {*turned}
    assert chosen.condition < 3


def test_patterns_are_those_of_goldsteins_table() -> None:
    mixed = Pattern((1, 2, 3, 4))
    assert mixed.old_arguments.tolist() == [0, 1, 6, 7]
    assert mixed.old_conjugates.tolist() == [4, 5, 2, 3]
    assert mixed.new_arguments.tolist() == [0, 5, 2, 7]
    assert mixed.new_conjugates.tolist() == [4, 1, 6, 3]
    assert mixed.old_signs.tolist() == [1, 1, -1, -1]
    assert mixed.new_signs.tolist() == [-1, 1, -1, 1]
    flip = np.array([[[1.0, 0.0], [0.0, 1.0]], [[1.0, 0.0], [0.0, -1.0]]])
    assert condition_of((2,), flip) == np.inf


def test_a_black_box_is_repaired_by_differences() -> None:
    import math

    def step(z: Array) -> Array:
        p = z[1] - 0.3 * math.sin(z[0])
        return np.array([z[0] + 0.3 * p, p * (1 + 1e-4 * z[0])])

    repair = symplectify(step, dimension=2, samples=2)
    assert repair.after.verdict == "supported"
    assert repair.after.worst.size < 1e-11
    assert "the map's derivatives are differences" in repair.notes[-1]
    assert repair.order == 2


def test_bad_input() -> None:
    with pytest.raises(InputError, match="float32, too coarse"):
        symplectify(lambda z: np.asarray(z * np.float32(1.1), dtype=np.float32), dimension=2, samples=5)
    state = iter(np.linspace(0, 1, 10_000))
    with pytest.raises(InputError, match="hidden state"):
        symplectify(lambda z: z + next(state), dimension=2)
    with pytest.raises(InputError, match="a phase point of shape"):
        symplectify(leapfrog, dimension=2, centre=[0.0])
    with pytest.raises(InputError, match="no finite value there"):
        symplectify(lambda z: np.array([np.log(z[0]), z[0] * z[1]]), dimension=2, domain=(-1, 1), centre=[-0.5, 0])
    with pytest.raises(InputError, match="a method is for a matrix"):
        symplectify(leapfrog, dimension=2, method="polar")  # type: ignore[call-overload]


def test_the_repaired_map_is_audited_as_any_other() -> None:
    repair = symplectify(truncated(3), dimension=2, domain=(-0.2, 0.2), samples=30)
    report = audit(repair, dimension=2, domain=(-0.15, 0.15), samples=30, seed=5)
    assert report.verdict == "supported"
    assert report.worst.size < 1e-11
