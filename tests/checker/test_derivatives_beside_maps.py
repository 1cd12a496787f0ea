"""Derivatives in what a map gives are taken before the map's formulas are there, by every small file alike."""

from typing import Any

import pytest

from canon.checker import alone_together, refutations
from tests.checker.certified import certified, resealed
from tests.checker.test_forged_kinds import status

SPACE: Any = {"q": ["x"], "p": ["p"], "Q": ["X"], "P": ["P"]}
NAMES: Any = {"m": "positive", "e": "real", "f": "function", "V": "function"}
GAUGE: Any = {"transformation": {"Q": ["x"], "P": ["p + e*D(f(x, t), x)"]}}
H = "(p - e*D(f(x, t), x))**2/(2*m) + V(x)"
K = "(P - 2*e*D(f(X, t), X))**2/(2*m) + V(X) - e*D(f(X, t), t)"
WITNESS: Any = {"x": "2/3", "p": "3/4", "X": "-7", "P": "5", "t": "1/5", "m": "3/2", "e": "2",
    "f": "a1**3*a2 + a1*a2**2 - a1", "V": "a**3 - a"}  # fmt: skip


def answers(K: str, H: str, witness: Any = WITNESS, residuals: int = 6, **more: Any) -> str:
    """Which of a proof and a refutation, neither of which says anything else, are shown."""
    tables = {"phase_space": SPACE, "symbols": NAMES, "hamiltonian": {"H": H}, **more}
    tables["claim"] = {**({"kind": "new_hamiltonian", "K": K} if K else {}), **more.get("claim", {})}
    case = {"kernels": [], "residuals": [{"numerator": {}, "denominator": {"": "1"}, "cofactors": {}}] * residuals}
    data = {"certificate": 1, "tables": tables, "known": {}, "cases": [case]}
    proof = alone_together.checked(resealed({**data, "verdict": "proved", "witness": None}))[0]
    refutation = refutations.checked(resealed({**data, "verdict": "refuted", "witness": witness}))[0]
    return " ".join(word for word, one in (("proof", proof), ("refutation", refutation)) if one == "shown")


def test_the_right_one_is_proved() -> None:
    assert answers(K, H, **GAUGE) == "proof"


MISSES = {
    "a sign": K.replace("- e*D", "+ e*D"),
    "without the rate": K.replace("- e*D(f(X, t), t)", ""),
    "a factor": K.replace("2*e", "e"),
    "a second derivative": K.replace("D(f(X, t), t)", "D(f(X, t), X, 2)"),
    "a term": f"{K} + X/1000000",
}


@pytest.mark.parametrize("name", MISSES)
def test_others_are_refuted(name: str) -> None:
    assert answers(MISSES[name], H, **GAUGE) == "refutation"


def test_what_the_prover_refutes_is_shown() -> None:
    text = """
    phase_space = { q = ["x"], p = ["p"], Q = ["X"], P = ["P"] }
    symbols = { f = "function" }
    definitions = { g = "f(X, t)" }
    hamiltonian = { H = "p**2/2" }
    transformation = { Q = ["x"], P = ["p + D(f(x, t), x)"] }
    """
    for sign, verdict in (("-", "proved"), ("+", "refuted")):
        data = certified(text, f"kind = 'new_hamiltonian'\nK = '(P - D(g, X))**2/2 {sign} D(g, t)'")
        assert data["verdict"] == verdict
        assert (alone_together if sign == "-" else refutations).checked(data)[0] == "shown"


OTHERS: Any = {
    "old in K": (f"{K} + x*X", H, {}),
    "old in K by a definition": (f"{K} + X*y", H, {"definitions": {"y": "x"}}),
    "old derivatives in K": (f"{K} + D(f(X, t), x) + X", H, {}),
    "a bracket in K": (f"{K} + bracket(X, P)*X", H, {}),
    "by a parameter": (f"{K} + X*D(m*X, m)", H, {}),
    "new in H": (K, f"{H} + X*x", {}),
    "new derivatives in H": (K, f"{H} + D(x, X) + x", {}),
    "new in the map": (K, H, {"transformation": {"Q": ["x"], "P": ["p + X"]}}),
    "a text for a name of the file's own": (K, H, {"transformation": {"Q": ["_H"], "P": ["p"]}}),
    "no formula": ("X, P) + D(P**2/2", "p**2/2", {"transformation": {"Q": ["x"], "P": ["p"]}}),
    "other keys": (f"{K} + X", H, {"claim": {"scale": "1"}}),
    "a surface": (f"{K} + X", H, {"domain": {"on": ["x - p"]}}),
    "a generating function beside": (f"{K} + X", H, {"generating_function": {"type": 2, "F": "x*P"}}),
    "whole numbers": (f"{K} + X", H, {"symbols": {**NAMES, "X": "integer"}}),
    "a scale of 0": (f"{K} + X", H, {"transformation": {"Q": ["x"], "P": ["0*p"]}}),
    "a condition on what the map gives": (f"{K} + X", H, {"domain": {"where": ["D(t*X, t) > 0"]}}),
    "another name": (f"{K} + z*X", H, {}),
    "two meanings": (f"{K} + X", H, {"definitions": {"X": "x"}}),
}  # fmt: skip


@pytest.mark.parametrize("name", OTHERS)
def test_claims_of_another_form_are_left_alone(name: str) -> None:
    wrong, of, more = OTHERS[name]
    assert answers(wrong, of, {**WITNESS, "x": "2"}, **(GAUGE | more)) == ""


def test_the_point_lies_in_the_domain() -> None:
    """Of what the witness says of new variables nothing is used."""
    wrong = f"{K} + X"
    elsewhere: Any = (
        {"domain": {"where": ["X < 0"]}},
        {"domain": {"where": ["x > 1"]}},
        {"symbols": {**NAMES, "X": "negative"}},
        {"symbols": {**NAMES, "f": ["function", "positive"]}},
        {"symbols": {**NAMES, "e": "negative"}},
    )
    for more in elsewhere:
        assert answers(wrong, H, **GAUGE, **more) == ""


def test_what_the_claim_says_has_a_value_there() -> None:
    assert answers(f"{K} + X", H, **GAUGE, domain={"where": ["X > 0", "D(V(x), x) < 1"]}) == "refutation"
    assert answers(f"{K} + sqrt(X - 1)", H, **GAUGE) == ""
    assert answers(f"{K} + X*sqrt(-V(X))", H, {**WITNESS, "V": "a"}, **GAUGE) == ""


T: Any = {"transformation": {"Q": ["x*exp(t)"], "P": ["p*exp(-t)"]}}
M: Any = {"transformation": {"Q": ["m*x"], "P": ["p/m"]}}
GENERATED: Any = {"generating_function": {"type": 2, "F": "x*P*exp(t)"}}
BACKWARD: Any = {"transformation": {"q": ["X*exp(-t)"], "p": ["P*exp(t)"]}}
MOVING = "exp(2*t)*P**2/2 + X*P"


@pytest.mark.parametrize("by", [T, GENERATED, BACKWARD], ids=["forward", "generated", "backward"])
def test_a_derivative_by_time_holds_new_variables(by: Any) -> None:
    """∂(t X)/∂t is X, and not X + t X, as it would be along the map."""
    assert answers(MOVING, "p**2/2", **by) == "proof"
    assert answers(f"{MOVING} + D(t*X, t) - X", "p**2/2", **by) in ("proof", "")
    assert answers(f"{MOVING} + D(t*X, t) - X - t*X", "p**2/2", **by) in ("refutation", "")


def test_forward_both_are_shown() -> None:
    assert answers(f"{MOVING} + D(t*X, t) - X", "p**2/2", **T) == "proof"
    assert answers(f"{MOVING} + D(t*X, t) - X - t*X", "p**2/2", **T) == "refutation"


@pytest.mark.parametrize("more", ["D(m*X, m) - X", "D(m*X, m) - 2*X", "D(X, m)"])
@pytest.mark.parametrize("by", [M, {"generating_function": {"type": 2, "F": "m*x*P"}}], ids=["forward", "generated"])
def test_derivatives_by_parameters_are_left_alone(by: Any, more: str) -> None:
    assert answers("m**2*P**2/2", "p**2/2", **by) == "proof"
    assert answers(f"m**2*P**2/2 + {more}", "p**2/2", **by) == ""
    assert answers("m**2*P**2/2 + y", "p**2/2", definitions={"y": more}, **by) == ""


@pytest.mark.parametrize("more", ["D(t*x, t) - x", "D(t*x, t) - x + t*x", "bracket(t*x, p) - t"])
def test_nor_are_derivatives_of_old_variables_that_a_map_gives(more: str) -> None:
    assert answers(MOVING, f"p**2/2 + {more}", **BACKWARD) == ""


@pytest.mark.parametrize("by", [T, GENERATED, BACKWARD], ids=["forward", "generated", "backward"])
def test_nor_conditions_on_them(by: Any) -> None:
    """(t + 1) X grows where X is positive; along the map it does where X (t + 2) is."""
    given = "x" if by is BACKWARD else "X"
    for sign, x in (">", "-2/3"), ("<", "2/3"):
        where: Any = {"where": [f"D((t + 1)*{given}, t) {sign} 0"]}
        there = {**WITNESS, "x": x, "X": x, "t": "-3"}
        for root in ("sqrt(X**2) - X", "sqrt(X**2) + X"):
            assert answers(f"{MOVING} + {root}", "p**2/2", there, domain=where, **by) == ""


def test_nor_conditions_where_brackets_are_asked_for() -> None:
    """The map is canonical where X is positive."""
    where = {"where": ["D((t + 1)*X, t) > 0"]}
    by = {"transformation": {"Q": ["x*exp(t)"], "P": ["p*exp(-t)*sqrt(x**2)/x"]}}
    data: Any = {"certificate": 1, "known": {}, "cases": [], "verdict": "refuted"}
    for x, conditions, answer in (("-2/3", where, "not shown"), ("-2/3", {}, "shown"), ("2/3", {}, "not shown")):
        tables = {"phase_space": SPACE, **by, "domain": conditions, "claim": {"kind": "canonical"}}
        sealed = {**data, "tables": tables, "witness": {"x": x, "p": "1", "t": "-3"}}
        assert (refutations.checked(resealed(sealed))[0] == "shown") == (answer == "shown")


PLACES = {
    "hamilton_jacobi": ("p**2/2", "D(t*p, t)", "D(t*p, t) - p", {"S": "(x - a)**2/(2*t)", "constants": ["a"]}),
    "legendre": ("p**2/(2*m)", "D(p/m, m)", "D(m*p, m) - p", {"L": "m*v**2/2", "velocities": ["v"]}),
}


@pytest.mark.parametrize("kind", PLACES)
def test_nor_derivatives_of_what_momenta_stand_for(kind: str) -> None:
    """The first is 0 where p is ∂S/∂x, or ∂L/∂v, but not where p is p; the second is 0 where p is p."""
    H, wrong, right, claim = PLACES[kind]
    space = {"q": ["x"], "p": ["p"]}
    witness = {"x": "1", "v": "2/3", "a": "1/3", "t": "2", "m": "3/2"}
    more: Any = {"phase_space": space, "symbols": {"m": "positive"}}
    more |= {"domain": {"where": ["t > 0"]}} if "S" in claim else {"residuals": 1}
    assert answers("", H, witness, **more, claim={"kind": kind, **claim}) == "proof"
    for term in (wrong, right):
        assert answers("", f"{H} + {term}", witness, **more, claim={"kind": kind, **claim}) == ""
    assert answers("", f"{H} + x", witness, **more, claim={"kind": kind, **claim}) == "refutation"


def test_an_edge_that_a_map_gives_is_no_point() -> None:
    """With X = x² − x and x not negative the domain is x > 1, and 0, where nothing else is."""
    tables: Any = {"phase_space": SPACE, "symbols": {"x": "nonnegative", "X": "nonnegative"}}
    tables["transformation"] = {"Q": ["x**2 - x"]}
    data: Any = {"certificate": 1, "known": {}, "cases": [], "verdict": "refuted"}
    for x, factor, answer in (("0", "1", "not shown"), ("2", "1", "not shown"), ("2", "2", "shown")):
        tables["transformation"]["P"] = [f"{factor}*p/sqrt((2*x - 1)**2)"]
        sealed = {**data, "tables": {**tables, "claim": {"kind": "canonical"}}, "witness": {"x": x, "p": "1"}}
        assert (refutations.checked(resealed(sealed))[0] == "shown") == (answer == "shown")
        everything = {**sealed["tables"]}
        claim = everything.pop("claim")
        argument = {"argument": "ball at 64 bits"}
        found = status(claim, "refuted", argument, everything, sealed["witness"])
        assert (found == "confirmed") == (answer == "shown")
