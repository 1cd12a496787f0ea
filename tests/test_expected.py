"""Values of wrong types at public functions: one clear error each, which names the argument and what was given."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
import sympy as sp

import canon
from canon import InputError, LieAlgebra, PhaseSpace, Transformation
from canon.expected import finite_number, listed, shown, whole_number

SPACE = PhaseSpace("q", "p", new=("Q", "P"), real="s")
Q, P, S = (SPACE.symbol(name) for name in ("q", "p", "s"))
IDENTITY = Transformation(SPACE, Q=Q, P=P)
F2 = canon.GeneratingFunction(SPACE, 2, Q * SPACE.P[0])
PLANE = LieAlgebra.of(["A", "B"], {"A,B": "B"})
WRONG: dict[str, tuple[Callable[[], Any], str]] = {
    "generates": (lambda: F2.generates(None), "transformation: a Transformation is expected, not None: one is made by"),  # type: ignore[arg-type]
    "identity": (lambda: canon.identity_transformation("q"), "space: a PhaseSpace is expected, not 'q': one is made"),  # type: ignore[arg-type]
    "bracket": (lambda: canon.poisson_bracket(Q, P, None), "space: a PhaseSpace is expected"),  # type: ignore[arg-type]
    "hamiltonian": (lambda: canon.Hamiltonian(None, P), "space: a PhaseSpace is expected"),  # type: ignore[arg-type]
    "branch": (lambda: IDENTITY.backward("1"), "branch: a whole number is needed, at least 0, not '1'"),  # type: ignore[arg-type]
    "converted": (lambda: F2.converted(None), "there is no type None"),  # type: ignore[arg-type]
    "velocities": (lambda: canon.Lagrangian(SPACE, Q**2, [P]), "velocities: p is a variable of the phase space"),
    "no velocities": (lambda: canon.Lagrangian(SPACE, Q**2, 3), "velocities: a list of symbols is expected, not 3"),  # type: ignore[arg-type]
    "parameter": (
        lambda: canon.InfinitesimalTransformation(SPACE, Q * P).finite(Q),
        "parameter: q is a variable of the phase space",
    ),
    "identify": (lambda: canon.identify({}), "algebra: a LieAlgebra is expected, not {}"),  # type: ignore[arg-type]
    "position": (lambda: PLANE.bracket_of(0, 7), "position: there is no position 7 in a basis of 2"),
    "names": (lambda: LieAlgebra.of(3, {}), "names: a list of names is expected, not 3"),  # type: ignore[arg-type]
    "closure": (lambda: canon.closure(SPACE, [Q]), r"functions: a table of functions is expected, as \{name: value\}"),  # type: ignore[arg-type]
    "order": (lambda: canon.birkhoff_gustavson(SPACE, Q**2 + P**2, "4"), "order: a whole number is needed"),  # type: ignore[arg-type]
    "point": (lambda: canon.value_at(Q, None), "point: a table of numbers"),  # type: ignore[arg-type]
    "no point": (lambda: canon.lie_sum(Q, P, (Q,), (P,), {Q: 1.0}, 0.5), "at: a number for p is missing"),
    "formula": (lambda: canon.motion(None), "H: a formula of sympy's is expected, not None"),
    "components": (lambda: canon.boost(3), "velocity: a list of components is expected, not 3"),  # type: ignore[arg-type]
    "masses": (lambda: canon.point_masses(None, []), "masses: a list of masses is expected"),  # type: ignore[arg-type]
    "verdict": (lambda: canon.proof(IDENTITY.canonical(), "yes"), "verdict: a Verdict is expected"),  # type: ignore[arg-type]
    "keys": (lambda: canon.Subject(SPACE).claim("identity", None), "keys: a table of a kind's own keys"),  # type: ignore[arg-type]
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_argument_is_named(name: str) -> None:
    call, message = WRONG[name]
    with pytest.raises(InputError, match=message):
        call()


def test_what_is_long_is_cut_short() -> None:
    assert shown("ab") == "'ab'"
    assert shown(list(range(1000))).endswith("… (list)")


def test_numbers_and_lists() -> None:
    for value in (True, 1.0, None, "1", 0):
        with pytest.raises(InputError, match="n: a whole number is needed, at least 1"):
            whole_number(value, "n", 1)
    for value in (float("nan"), float("inf"), 1j, "1", None, True):
        with pytest.raises(InputError, match="x: a finite number is needed"):
            finite_number(value, "x")
    for value in ("ab", {"a": 1}, {1, 2}, 3, None):
        with pytest.raises(InputError, match="x: a list of names is expected"):
            listed(value, "names", "x")
    assert listed(iter([1, 2]), "numbers", "x") == (1, 2)


def test_the_tables_in_a_claim_are_nobodys_to_change() -> None:
    stated = {"A,B": {"B": sp.Integer(1)}}
    claim = canon.algebra(SPACE, {"A": Q * P, "B": Q}, structure={"A,B": {"B": -1}})
    with pytest.raises(TypeError):
        claim.keys["brackets"]["A,B"] = stated
    with pytest.raises(TypeError):
        claim.keys["brackets"]["A,B"]["B"] = 7
    assert canon.verify(claim).status == "proved"


def test_a_proof_of_structure_constants_is_written() -> None:
    claim = canon.algebra(
        SPACE, {"A": Q * P, "B": Q, "C": Q**2}, structure={"A,B": {"B": -1}, "A,C": {"C": -2, "A": 0}}
    )
    written = canon.proof(claim)
    assert written.verdict.status == "proved"
    assert written.tables["claim"]["structure"] == {"A,B": "(-1)*B", "A,C": "(-2)*C"}


def test_a_proof_keeps_to_its_claim() -> None:
    """Another claim's verdict is told by what a file would state; one from another process by the checker."""
    false, true = canon.identity(SPACE, Q, P), canon.identity(SPACE, Q, Q)
    with pytest.raises(InputError, match="verdict: this is the verdict on another claim of this kind"):
        canon.proof(false, canon.verify(true))
    with pytest.raises(InputError, match="verdict: this is the verdict on another claim of this kind"):
        canon.proof(false, canon.verify(true, method="numeric"))  # supported: no certificate is looked at
    elsewhere = replace(canon.verify(true), claim=None)
    with pytest.raises(InputError, match="verdict: this verdict isn't that of the claim"):
        canon.proof(false, elsewhere)
    assert canon.proof(canon.identity(SPACE, SPACE.formula("q"), Q), canon.verify(true)).verdict.status == "proved"
    with pytest.raises(InputError, match="verdict: this is the verdict on another claim, of kind 'bracket'"):
        canon.proof(true, canon.verify(canon.bracket(SPACE, Q, P, 1)))
    assert canon.proof(true, canon.verify(true)).verdict.status == "proved"


@pytest.mark.parametrize("several", [{Q: 1}, b"q", {Q, P}])
def test_formulas_stand_in_an_order(several: Any) -> None:
    with pytest.raises(InputError, match="transformation, Q: a list of expressions is expected"):
        Transformation(SPACE, Q=several, P=P)


def test_symbols_and_functions_have_names_of_their_own() -> None:
    with pytest.raises(InputError, match="q is a variable and a function"):
        canon.bracket(SPACE, sp.Function("q")(Q), P, 0)
    with pytest.raises(InputError, match="z_ is a pattern of sympy's"):
        canon.bracket(SPACE, sp.Wild("z"), P, 0)
