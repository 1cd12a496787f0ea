"""Wrong arguments of public functions from Python: one error that names them; none of them is taken for another."""

from collections.abc import Callable
from typing import Any

import jax
import numpy as np
import pytest
import sympy as sp

import canon
from canon import InputError, LieAlgebra, PhaseSpace
from canon.expected import real_array
from canon.mechanics.algebra.casimirs import casimirs
from canon.mechanics.algebra.root_system import cartan_matrix
from canon.numeric.integrate import integrate
from canon.numeric.integrators import separable
from canon.numeric.integrators.catalogue import method
from canon.testing import BRACKET_LAWS, assert_hamiltonian_flow, assert_law, assert_order, assert_reversible, check_laws

SPACE = PhaseSpace("q", "p", new=("Q", "P"), real="s")
Q, P, S = (SPACE.symbol(name) for name in ("q", "p", "s"))
R = sp.Symbol("r", positive=True)
F2 = canon.GeneratingFunction(SPACE, 2, Q * SPACE.P[0] + S * Q**2 * SPACE.P[0] ** 2)
PLANE = LieAlgebra.of(["A", "B"], {"A,B": "B"})
MOTION = canon.motion(P**2 / 2 + Q**2 / 2)
FIELDS = canon.field_tensor((0, 0, 0), (0, 0, 1))
STEP = method("verlet")
FALL = separable(lambda p: p, lambda q: -q)
AT = {Q: 1.0, P: 0.5}
MIRROR = canon.Transformation(SPACE, Q=-Q, P=-P)
COMPLEX = np.array([[2, 1j], [-1j, 2]])
CLAIM = canon.bracket(SPACE, Q, P, 1)
CALLED = "open('/nowhere')"  # raises FileNotFoundError where it is evaluated


def circle(s: Any) -> Any:
    return np.stack([np.cos(2 * np.pi * s), np.sin(2 * np.pi * s), 0 * s], axis=1)


WRONG: dict[str, tuple[Callable[[], Any], str]] = {
    # what numpy would make real by dropping imaginary parts
    "modes": (lambda: canon.normal_modes(np.eye(2), COMPLEX), "K: real numbers are expected"),
    "williamson": (lambda: canon.williamson(COMPLEX), "A: real numbers are expected"),
    "points": (lambda: canon.audit(lambda z: z, dimension=2, domain=COMPLEX), "domain: real numbers are expected"),
    "box": (
        lambda: canon.audit(lambda z: z, dimension=2, domain=[(np.complex128(1j), 2), (0, 1)]),
        r"domain: a pair \(low, high\)",
    ),
    "map of states": (
        lambda: canon.cartan_loop_invariant(lambda z, t: z + 1j, circle, H=lambda z, t: 0 * t),
        "map: real numbers are expected",
    ),
    "flow": (
        lambda: assert_hamiltonian_flow(lambda z, t: z + 1j * t, lambda z: 0.0, dimension=2),
        "flow: real numbers are expected",
    ),
    "step": (
        lambda: assert_order(lambda z, h: np.array([z[0], z[1] - h * z[0] ** 3]) + 1j, 1, start=(1.0, 0.0)),
        "step: real numbers are expected",
    ),
    "involution": (
        lambda: assert_reversible(lambda z: z, dimension=2, involution=lambda z: z * 1j),
        "involution: real numbers are expected",
    ),
    "state": (
        lambda: integrate(FALL, STEP, (np.array([1j]), np.ones(1)), duration=1.0, steps=1),
        "state: real numbers are expected",
    ),
    "orbits": (lambda: canon.central_actions("-1/r", np.array([1j]), 0.1, 1.0), "r: real numbers are expected"),
    # what was passed over
    "energy": (
        lambda: canon.radial_regions(-1 / R, R, energy=float("nan"), angular_momentum=1),
        "energy: mass, energy",
    ),
    "momentum": (
        lambda: canon.radial_regions(-1 / R, R, energy=-1, angular_momentum=float("inf")),
        "angular_momentum: mass, energy",
    ),
    "distance": (lambda: canon.two_bodies(1, 2).hamiltonian(1 / R, sp.Symbol("r")), "V: this r is positive"),
    "distance's name": (lambda: canon.two_bodies(1, 2).hamiltonian(1 / R, CALLED), "r: a Symbol is expected"),  # type: ignore[arg-type]
    "components": (lambda: PLANE.product([1, 0], [1]), "y: 2 components are expected, not 1"),  # type: ignore[list-item]
    "place": (lambda: PLANE.adjoint(7), "position: there is no position 7 in a basis of 2"),
    "combination": (lambda: PLANE.show({5: 1}), "position: there is no position 5"),  # type: ignore[dict-item]
    "names in a set": (lambda: PhaseSpace({"x", "y"}, {"px", "py"}), "names in an order are expected"),
    "share": (lambda: canon.fastest_descent(1.0, 1.0).place(2.0), "share: a share of the time is from 0 to 1"),
    "light": (lambda: canon.fields_of(FIELDS, 0), "c: the speed of light is positive, not 0"),
    "velocity": (
        lambda: canon.four_force(1, FIELDS, FIELDS),
        "velocity: a tensor of rank 1 is expected, not of rank 2",
    ),
    "branch": (lambda: MOTION.energy(1.0, branch=""), "branch: a branch is 'libration' or 'rotation', not ''"),
    "well": (lambda: MOTION.energy(1.0, well=[]), "well: a real number is expected"),  # type: ignore[arg-type]
    # what was evaluated, as sympy does with texts
    "focus": (lambda: canon.orthogonal_coordinates("elliptic", 2, CALLED), "focus: an expression is expected"),  # type: ignore[arg-type]
    "parameters": (
        lambda: canon.central_actions("-k/r", 1.0, 0.1, 1.0, parameters={"k": CALLED}),
        "parameters, k: a finite number is needed",
    ),
    # what Python's own errors said
    "orbit": (lambda: MOTION.orbits(None), "energy: a real number is expected, not None"),
    "rate": (lambda: MOTION.drift(0.1, 0.2, "q", 0.0), "rate: a formula of sympy's is expected"),
    "time": (lambda: canon.lie_sum(Q, P, (Q,), (P,), AT, None), "s: a formula of sympy's is expected, not None"),
    "depth": (lambda: canon.closed_lie_series(Q, Q * P, S, SPACE, 0), "depth: a whole number is needed, at least 1"),
    "domain": (lambda: canon.motion("p**2 + q**2", domain=3), "domain: a list of numbers is expected"),  # type: ignore[arg-type]
    "count": (lambda: canon.frequency_lines(np.ones(64), 1.0, 1.5), "count: a whole number is needed"),  # type: ignore[arg-type]
    "bodies": (lambda: canon.composite([3]), "bodies: a RigidBody is expected, not 3"),  # type: ignore[list-item]
    "tensor": (lambda: FIELDS.times(3), "other: a FourTensor is expected, not 3"),  # type: ignore[arg-type]
    "tensor's entries": (lambda: canon.FourTensor("abc", "u"), "components: lists of exact numbers"),
    "index": (lambda: FIELDS.with_index("0", "u"), "index: a whole number is needed"),  # type: ignore[arg-type]
    "group": (lambda: canon.group(SPACE, [S], 3, [S]), "first: a list of symbols is expected, not 3"),  # type: ignore[arg-type]
    "constants": (lambda: canon.CompleteIntegral(SPACE, P, Q, [3]), "constants: a Symbol is expected, not 3"),  # type: ignore[list-item]
    "matrices": (lambda: canon.algebra_of_matrices({"A": 3}), "matrices, 'A': a list of rows is expected, not 3"),  # type: ignore[dict-item]
    "pairs": (lambda: LieAlgebra(["A"], {1: 2}), "constants: a pair of positions in the basis is expected"),  # type: ignore[dict-item,list-item]
    "huge": (lambda: canon.fastest_descent(10**400, 1.0), "across: a finite number is needed"),
    "a bracket of new variables": (
        lambda: canon.poisson_bracket(*SPACE.new, SPACE),
        "Q is one of the new variables, and brackets are in the old ones",  # {Q, P} was 0
    ),
    "brackets of new variables": (lambda: canon.bracket_matrix(SPACE.new, SPACE), "Q is one of the new variables"),
    "a generator of new variables": (
        lambda: canon.InfinitesimalTransformation(SPACE, SPACE.Q[0] * SPACE.P[0]),
        "generator: P is one of the new variables",
    ),
    "a series of new variables": (
        lambda: canon.closed_lie_series(SPACE.Q[0], P, S, SPACE),
        "Q is one of the new variables",
    ),
    "a cycloid beyond doubles": (
        lambda: canon.fastest_descent(1e-300, 1.0),
        "across, down: in double precision there is",
    ),
    "a law": (lambda: assert_law(None, SPACE), "law: a Law is expected, not None"),  # type: ignore[arg-type]
    "objects of a law": (lambda: assert_law(BRACKET_LAWS[0], SPACE, *[Q] * 7), "objects: the law .* takes .*, not 7"),
    "laws": (lambda: check_laws(3), "laws: a list of laws is expected, not 3"),  # type: ignore[arg-type]
    "laws that are none": (lambda: check_laws([3]), "laws: a Law is expected, not 3"),  # type: ignore[list-item]
    "no examples": (lambda: check_laws(BRACKET_LAWS, max_examples=0), "max_examples: a whole number is needed"),
    "names in one text": (
        lambda: LieAlgebra.of("A,B", {"A,B": "B"}),
        r"names: a name of the basis is expected, not ','",
    ),
    "no name": (lambda: LieAlgebra(["A", ""], {}), "names: a name of the basis is expected, not ''"),  # type: ignore[arg-type]
    "degree": (lambda: casimirs(PLANE, "2"), "degree: a whole number is needed, at least 1"),  # type: ignore[arg-type]
    "simple type": (lambda: cartan_matrix("A3"), "type: a ComplexType is expected, not 'A3': one is"),  # type: ignore[arg-type]
    "nesting": (lambda: canon.closure(SPACE, {"A": Q}, steps=-1), "steps: a whole number is needed, at least 0"),
    "budget": (lambda: canon.closure(SPACE, {"A": Q}, budget=-1), "a budget is a number of seconds from 0 on"),
    # what was an undecided claim each, or passed over
    "many claims' budget": (lambda: next(canon.verify_many([CLAIM], budget="1")), "a budget is a number of seconds"),  # type: ignore[arg-type]
    "many claims' memory": (lambda: next(canon.verify_many([CLAIM], memory=-1)), "a limit of memory is a whole number"),
    "integrator": (
        lambda: integrate(FALL, "verlet", (np.ones(1), np.ones(1)), duration=1.0, steps=1),  # type: ignore[arg-type]
        "method: an integrator is expected",
    ),
    "steps": (
        lambda: integrate(FALL, STEP, (np.ones(1), np.ones(1)), duration=1.0, steps=2.5),  # type: ignore[arg-type]
        "steps: a whole number is needed, at least 1, not 2.5",
    ),
    # audits, bounds and integrals
    "a zero period": (
        lambda: canon.loop_invariant(lambda z: z, lambda s: circle(s)[:, :2] + s[:, None], periods=(0.0, None)),
        "periods: a period is positive, not 0",
    ),
    "a period too few": (
        lambda: canon.loop_invariant(lambda z: z, lambda s: circle(s)[:, :2], new_periods=(None,)),
        r"new_periods: 2 periods are expected, None for what is no angle, not \(None,\)",
    ),
    "a map": (
        lambda: canon.cartan_loop_invariant(None, circle, H=lambda z, t: 0 * t),  # type: ignore[arg-type]
        "map: a map is a function, not None",
    ),
    "a Hamiltonian": (
        lambda: canon.cartan_loop_invariant(lambda z, t: z, circle, H=P),
        "H: beside a map that is a function, a Hamiltonian is a function, not p",
    ),
    "a value": (
        lambda: canon.audit(MIRROR, parameters={"s": "1"}),
        "parameters, s: a finite number is needed, not '1'",
    ),
    "values": (lambda: canon.certify(MIRROR, (-1, 1), parameters=[1]), "parameters: a table of numbers is expected"),  # type: ignore[arg-type]
    "a space": (
        lambda: canon.audit(lambda z: z, space="q"),  # type: ignore[arg-type]
        "space: a PhaseSpace is expected, not 'q'",
    ),
    "a type": (
        lambda: canon.symplectify(lambda z: z, dimension=2, type=1.5),  # type: ignore[arg-type]
        "type: a list of types is expected, not 1.5",
    ),
    "no orbits": (
        lambda: integrate(FALL, STEP, (np.empty(0), np.empty(0)), duration=1.0, steps=1),
        "state: a state is a tuple of arrays",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_argument_is_named(name: str) -> None:
    call, message = WRONG[name]
    with pytest.raises(InputError, match=message):
        call()


def test_real_arrays() -> None:
    for value in (1j, "1", b"1", None, [None, 1.0], [[1], [1, 2]], {}, object(), COMPLEX, 10**400):
        with pytest.raises(InputError, match="x: real numbers are expected"):
            real_array(value, "x")
    for value in (1, [1, 2.5], (sp.Rational(1, 2),), np.float32(0.5), [[]], [float("nan")]):
        assert real_array(value, "x").dtype == float


def test_bounds_of_64_bits_are_given_of_64_bits_alone() -> None:
    """In 32 bits J_r was off by 6e-7 beside a bound of 8e-15."""
    calls: tuple[Callable[[], Any], ...] = (
        lambda: canon.isochrone_actions(1.0, 0.3, 1.1),
        lambda: canon.isochrone_angle(1.0, 0.3, 1.1),
        lambda: canon.pendulum_actions(0.3),
        lambda: canon.pendulum_angle(0.3, 0.9, 0.1),
    )
    for call in calls:
        with jax.enable_x64(False), pytest.raises(InputError, match="jax computes in 32 bits here"):
            call()
        with jax.enable_x64(True):
            call()
    with jax.enable_x64(True), pytest.raises(InputError, match="r: real numbers are expected, not complex ones"):
        canon.isochrone_actions(jax.numpy.asarray(1j), 0.3, 1.1)


def test_no_orbits_have_no_actions() -> None:
    assert canon.central_actions("-1/r", [], [], []).radial.shape == (0,)


def test_an_implicit_map_keeps_its_parameters() -> None:
    given = {"s": 0.15}
    map_of = canon.ImplicitMap(F2, given)
    given["s"] = 5.0
    assert np.allclose(map_of([1.0, 0.5]), canon.ImplicitMap(F2, {"s": 0.15})([1.0, 0.5]), rtol=1e-13)
    with pytest.raises(InputError, match="parameters, s: a finite number is needed"):
        canon.ImplicitMap(F2, {"s": float("nan")})


def test_an_image_is_the_same_whatever_points_it_is_asked_with() -> None:
    map_of = canon.ImplicitMap(F2, {"s": 0.15})
    points = np.array([[1e-3, 2e-3], [0.4, 0.3], [1.0, 0.5], [2.0, 0.1]])
    together = map_of(points)
    assert np.isfinite(together).all()
    assert np.array_equal(together, [map_of(point) for point in points])
    assert map_of(points[:0]).shape == (0, 2)
    assert map_of(points.reshape(2, 2, 2)[:, :0]).shape == (2, 0, 2)


def test_the_valence_of_a_map_given_backward_is_the_exact_reciprocal() -> None:
    """1/3 rounded made a defect of 1.9e-17 certain, at a point, of a map that has none."""
    thrice = canon.Transformation(SPACE, q=SPACE.Q[0], p=SPACE.P[0] / 3)
    found = canon.certify(thrice, (-1, 1), scale=3)
    assert found.lower == 0
    assert found.upper < 1e-30
    assert canon.certify(thrice, (-1, 1), scale=np.int64(3)).lower == 0  # type: ignore[arg-type]
    assert canon.certify(thrice, (-1, 1), scale=np.float32(3)).lower == 0  # type: ignore[arg-type]
