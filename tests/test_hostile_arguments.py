"""What no argument may do from Python: be run as a program, be let through as a number, last for ever."""

import os
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import sympy as sp

import canon
from canon import InputError, PhaseSpace
from canon.testing import assert_order, assert_reversible, check_laws, rationals, symplectic_matrices

SPACE = PhaseSpace("q", "p", new=("Q", "P"), functions="V")
Q, P = SPACE.old
R = sp.Symbol("r", positive=True)
PROGRAM = "__import__('os').environ.__setitem__('CANON_WAS_RUN', '1')"
CONTAINERS: tuple[Any, ...] = (
    (PROGRAM,), [PROGRAM], {PROGRAM}, frozenset({PROGRAM}), {PROGRAM: 1}, {1: PROGRAM}, {"A": (PROGRAM,)},
    [[(PROGRAM,)]],
    np.array([PROGRAM]), np.array([(PROGRAM,)], dtype=object), PROGRAM,
)  # fmt: skip
SWING = canon.motion("p**2/2 - cos(q)")
SO3 = canon.LieAlgebra.of(["A", "B", "C"], {"A,B": "C", "B,C": "A", "C,A": "B"})
AT = {Q: 1.0, P: 0.5}
BODY = canon.point_masses([1], [(0, 0, 0)])
TAKING: dict[str, Callable[[Any], Any]] = {
    "motion": lambda x: canon.motion(x),
    "period": lambda x: canon.motion("p**2/2 - cos(q)", period=x),
    "parameters": lambda x: canon.motion("p**2/2 + k*q**2", parameters={"k": x}),
    "energy": lambda x: SWING.orbit(x),
    "below": lambda x: SWING.orbit(below_separatrix=x),
    "well": lambda x: SWING.orbit("1/2", well=x),
    "at": lambda x: SWING.at(x, 0.5),
    "point": lambda x: SWING.point(x, 0.2),
    "rate": lambda x: SWING.drift(0.5, 0.5, x, 0),
    "value": lambda x: canon.value_at(x, AT),
    "place": lambda x: canon.value_at(Q, {Q: x}),
    "bracket": lambda x: canon.nested_bracket(x, P, (Q,), (P,), AT, 1),
    "sum": lambda x: canon.lie_sum(Q, P, (Q,), (P,), AT, x),
    "potential": lambda x: canon.central_actions(x, 1.0, 0.1, 1.0),
    "staeckel": lambda x: canon.staeckel_actions(x, 1.0, 1.0, 0.1, 0.1, 0.1, 0.3),
    "regions": lambda x: canon.radial_regions(-1 / R, R, energy=x, angular_momentum=1),
    "mass": lambda x: canon.radial_regions(-1 / R, R, mass=x, energy=-1, angular_momentum=1),
    "shown": lambda x: SO3.show({0: x}),
    "tensor": lambda x: canon.FourTensor(x, "u"),
    "body": lambda x: canon.RigidBody(1, (0, 0, 0), x),
    "formula": lambda x: canon.bracket(SPACE, x, P, 1),
    "boost": lambda x: canon.boost(x),
    "matrices": lambda x: canon.algebra_of_matrices({"A": x}),
}


@pytest.mark.parametrize("name", TAKING)
def test_no_argument_is_run_as_a_program(name: str) -> None:
    for container in CONTAINERS:
        with pytest.raises(InputError):
            TAKING[name](container)
        assert os.environ.pop("CANON_WAS_RUN", None) is None, container


WITHOUT_A_VALUE: dict[str, Callable[[Any], Any]] = {
    "poisson bracket": lambda x: canon.poisson_bracket(x, P, SPACE),
    "jacobi": lambda x: canon.jacobi_sum(x, P, Q, SPACE),
    "generator": lambda x: canon.lie_sum(Q, x, (Q,), (P,), AT, 1),
    "nested": lambda x: canon.nested_bracket(Q, x, (Q,), (P,), AT, 1),
    "new hamiltonian": lambda x: canon.identity_transformation(SPACE).transformed(x),
    "levi-civita": lambda x: canon.levi_civita(SPACE, x),
    "scattering": lambda x: canon.scattering(x, R, energy=1.0, impact_parameter=1.0),
    "normal form": lambda x: canon.birkhoff_gustavson(SPACE, x, 4),
    "solid": lambda x: canon.RigidBody(x, (0, 0, 0), sp.eye(3)),
}


@pytest.mark.parametrize("name", WITHOUT_A_VALUE)
@pytest.mark.parametrize("value", [sp.zoo, sp.nan, sp.oo, -sp.oo])
def test_what_has_no_finite_value_is_no_formula(name: str, value: Any) -> None:
    with pytest.raises(InputError):
        WITHOUT_A_VALUE[name](value)


HUGE = 10**60
UNBOUNDED: dict[str, Callable[[], Any]] = {
    "J": lambda: canon.standard_j(HUGE),
    "series": lambda: canon.truncated_lie_series(
        sp.sin(Q), P**2 / 2 - sp.cos(Q), sp.Symbol("s", real=True), SPACE, HUGE
    ),
    "growing": lambda: canon.truncated_lie_series(
        sp.sin(Q), P**2 / 2 - sp.cos(Q), sp.Symbol("s", real=True), SPACE, 60
    ),
    "form": lambda: canon.birkhoff_gustavson(SPACE, P**2 / 2 + Q**2 / 2 + Q**4, HUGE),
    "nested": lambda: canon.nested_bracket(Q, P, (Q,), (P,), AT, HUGE),
    "picard": lambda: canon.picard(R, R, sp.Symbol("t"), 1, HUGE),
    "samples": lambda: canon.audit(lambda z: z, dimension=2, samples=HUGE),
    "repaired": lambda: canon.symplectify(lambda z: z, dimension=2, samples=HUGE),
    "degree": lambda: canon.certify(canon.identity_transformation(SPACE), (-1, 1), degree=HUGE),
    "reversed": lambda: assert_reversible(lambda z: z, dimension=2, samples=HUGE),
    "refined": lambda: assert_order(lambda z, h: z + h * z**2, 1, start=(0.5, 0.1), refinements=HUGE),
    "examples": lambda: check_laws([], max_examples=HUGE),
    "batch": lambda: list(canon.verify_many([], batch=HUGE)),
    "regions": lambda: canon.radial_regions(-1 / R, R, mass=10**400, energy=sp.Rational(-1, 4), angular_momentum=1),
}


@pytest.mark.parametrize("name", UNBOUNDED)
def test_what_would_last_for_ever_is_refused(name: str) -> None:
    with pytest.raises(InputError):
        UNBOUNDED[name]()


ODD: dict[str, Callable[[], Any]] = {
    "time's names": lambda: canon.extended_by_time(canon.identity_transformation(SPACE), time=None),  # type: ignore[arg-type]
    "one name": lambda: canon.extended_by_time(canon.identity_transformation(SPACE), time=("a b", "c")),
    "labels": lambda: canon.bracket_matrix([Q, P], SPACE, names=0),  # type: ignore[arg-type]
    "other labels": lambda: canon.bracket_matrix([Q, P], SPACE, names=("a",)),
    "rows": lambda: SO3.images([1, 0, 0], None),  # type: ignore[arg-type]
    "narrow rows": lambda: list(SO3.products([[1, 0]])),  # type: ignore[arg-type]
    "seed": lambda: canon.roots_of(SO3, seed=[]),  # type: ignore[arg-type]
    "levels": lambda: canon.closure(SPACE, {"A": Q}, over=-1),  # type: ignore[arg-type]
    "fields": lambda: canon.closure_of_fields({"A": 2}, [Q]),  # type: ignore[dict-item]
    "coordinates": lambda: canon.separates(SPACE, P**2 / 2, None),  # type: ignore[arg-type]
    "space": lambda: canon.separation(None, P**2 / 2, canon.orthogonal_coordinates("polar", 2)),  # type: ignore[arg-type]
    "parts": lambda: canon.characteristic_function(None),  # type: ignore[arg-type]
    "signs": lambda: canon.Conventions("X", function_signs=0),  # type: ignore[arg-type]
    "no space": lambda: canon.GOLDSTEIN.bracket(Q, P, None),  # type: ignore[arg-type]
    "array": lambda: canon.verify(canon.bracket(SPACE, Q, P, 1), method=np.array([1, 2])),  # type: ignore[arg-type]
    "inequality": lambda: canon.scattering(1 / R, R, energy=1.0, impact_parameter=1.0, parameters=Q > 0),  # type: ignore[arg-type]
    "title": lambda: canon.Condition("positive", (Q,), -1),  # type: ignore[arg-type]
    "rest": lambda: canon.Domain() & 0,  # type: ignore[operator]
    "image": lambda: canon.Domain().substitute("abc"),  # type: ignore[arg-type]
    "normal": lambda: canon.reflected((1, 0), (1, 0, 0)),
    "strategy": lambda: check_laws([], spaces=0),  # type: ignore[arg-type]
    "largest": lambda: rationals(largest=None),  # type: ignore[arg-type]
    "made": lambda: symplectic_matrices(1, made=-1),  # type: ignore[arg-type]
    "skew": lambda: canon.RigidBody(1, (0, 0, 0), [[1, 2, 0], [0, 1, 0], [0, 0, 1]]),  # type: ignore[arg-type]
    "flat": lambda: canon.RigidBody(1, (0, 0), sp.eye(3)),  # type: ignore[arg-type]
    "axis": lambda: BODY.about_axis((0, 0, 0), (0, 0, 0)),
    "truth": lambda: SWING.orbit(True),
    "set": lambda: canon.FourTensor({"q"}, "u"),
    "arbitrary": lambda: canon.birkhoff_gustavson(SPACE, SPACE.function("V")(Q), 4),
    "long name": lambda: PhaseSpace("q" * 81, "p"),
    "look-alike": lambda: PhaseSpace("ﬁ", "p"),
}


@pytest.mark.parametrize("name", ODD)
def test_an_argument_of_another_kind_is_an_input_error(name: str) -> None:
    with pytest.raises(InputError):
        ODD[name]()


def test_a_number_beyond_all_doubles_is_not_taken_for_infinity() -> None:
    x = sp.Symbol("x", real=True)
    with pytest.raises(InputError, match=r"about 1.97e\+434, beyond the range of doubles"):
        canon.value_at(sp.exp(x), {x: 1000})
    with pytest.raises(InputError, match="beyond the range of doubles"):
        canon.nested_bracket(Q, P**2 / 2 - sp.cos(Q), (Q,), (P,), AT, 400)


def test_a_declared_name_is_not_a_function_of_the_language_in_the_same_claim() -> None:
    space = PhaseSpace(["sin", "x"], ["p", "px"])
    y, x, _, px = space.old
    with pytest.raises(InputError, match="sin is a declared name here"):
        canon.bracket(space, sp.sin(x) + y, px, sp.cos(x))
    assert canon.verify(canon.bracket(space, y + x**2, px, 2 * x)).status == "proved"
    assert canon.verify(canon.bracket(space, space.formula("sin + D(x**2, x)"), px, 2)).status == "proved"


def test_what_is_held_fixed_is_something_that_the_claim_depends_on() -> None:
    space = PhaseSpace("q", "p", new=("Q", "P"), positive="E k")
    q, p, E, k, new = space.symbols("q p E k P")
    H = p**2 / 2 + q**2 / 2
    for name in (new, k):
        with pytest.raises(InputError, match="held fixed, but nothing here depends on it"):
            canon.verify(canon.action(space, H, q, E, 2 * sp.pi * E, fixed={name: 1}))
    assert canon.verify(canon.action(space, H, q, E, 2 * sp.pi, fixed={E: 1})).status == "proved"


def test_images_of_formulas_under_a_normal_form() -> None:
    form = canon.birkhoff_gustavson(SPACE, P**2 / 2 + Q**2 / 2 + Q**4, 4)
    assert form.image(Q) == form.image(form.algebra.generators[0])
    with pytest.raises(InputError, match="a polynomial in q, p"):
        form.image(sp.sin(Q))
