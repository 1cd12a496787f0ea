"""Refutations of dimensions of functions, of minima with conjugate points, of integrals beside a map whose constants
conditions speak of: what is shown, and that nothing is which is true or ill-posed."""

from typing import Any

import pytest

from canon.checker import counterexample_hamilton_jacobi, counterexample_units, counterexample_variations, refutations
from canon.checker.alone import Stop
from canon.checker.counterexample import Open
from tests.checker.certified import resealed

LINE: Any = {"phase_space": {"q": ["q"], "p": ["p"]}}
NAMES: Any = {"m": "positive", "x": "real", "r": "positive", "s": "positive", "V": "function", "W": "function",
              "U": ["function", "positive"], "N": ["function", "nonzero"], "n": "integer"}  # fmt: skip
UNITS: Any = {"m": "M", "x": "L", "r": "L", "V": ["E", "L"], "U": ["E/L", "L"], "W": ["E", "L", "M"], "q": "L",
              "p": "M*L/T", "t": "T"}  # fmt: skip


def ask(by: Any, tables: Any, witness: Any = None) -> str:
    try:
        return by.refuted(*refutations.renamed(refutations.said(tables), witness), {})[0]
    except (Stop, Open, ValueError, TypeError, KeyError):
        return "not shown"


def units(f: str, equals: str, more: Any = None, *, witness: Any = None, **sections: Any) -> str:
    dimensions = {name: said for name, said in {**UNITS, **(more or {})}.items() if said}
    claim = {"kind": "dimension", "functions": [f], "dimensions": dimensions, "base": ["M", "L", "T", "E"]}
    tables = {**LINE, "symbols": NAMES, **sections, "claim": {**claim, "equals": equals, **sections.get("claim", {})}}
    return ask(counterexample_units, tables, witness)


DIMENSIONS: dict[str, tuple[str, str, str]] = {
    "a value": ("V(x)", "E", "E*L"), "a slope": ("D(V(x), x)", "E/L", "E"), "a product": ("m*V(x)", "E*M", "E"),
    "two arguments": ("D(D(W(x, m), x), m)", "E/(L*M)", "E/L"), "a positive one": ("x*U(x)", "E", "E/L"),
    "a sum": ("V(x) + r*U(2*x)", "E", "E*M"), "a quotient": ("V(x)/V(r)", "1", "L"),
    "a root": ("sqrt(r*U(x))", "E**(1/2)", "E"), "a logarithm": ("log(U(x)/U(r))", "1", "E"),
    "logarithms": ("log(r) - log(s)", "1", "L"), "a coordinate": ("p*q + 0*V(q)", "M*L**2/T", "M*L/T"),
    "time": ("V(x)/t**3", "E/T**3", "E/T**2"), "no function": ("m*x**2/t**2", "M*L**2/T**2", "M*L/T**2"),
}  # fmt: skip


@pytest.mark.parametrize("name", DIMENSIONS)
def test_a_dimension_is_refuted(name: str) -> None:
    f, right, wrong = DIMENSIONS[name]
    for witness in (None, {"x": "7/3", "r": "1/2", "m": "5"}, {"V": "a**3 - 2*a", "x": "-1/3"}):
        assert units(f, wrong, {"s": "L"}, witness=witness) == "shown"
        assert units(f, right, {"s": "L"}, witness=witness) == "not shown"


def test_what_has_no_dimension_is_refuted() -> None:
    for f in ("V(x) + x", "V(x*m)", "V(x)**2 + V(x)", "exp(x)*V(x)", "V(x + 1)", "x**2*U(x)", "W(m, x)"):
        assert units(f, "E") == "shown"


def test_a_dimension_that_is_no_claim_isnt_refuted() -> None:
    assert units("V(x)", "L", {"V": None}) == "not shown"  # what a function's dimension is isn't said
    assert units("V(x)", "L", {"V": "E"}) == "not shown"
    assert units("V(x)", "L", {"V": ["E", "L", "L"]}) == "not shown"
    assert units("N(x)", "L", {"N": ["E", "L"]}) == "not shown"
    assert units("x", "M", {"x": ["L"]}) == "not shown"
    assert units("V(x)", "G") == "not shown"
    assert units("V(x)", "E + L") == "not shown"
    assert units("n*V(x)", "L", {"n": "L"}) == "not shown"
    assert units("w*V(x)", "L", {"w": "L"}, definitions={"w": "x"}) == "not shown"
    assert units("V(x)", "L", domain={"where": ["V(x) < 0", "V(x) > 0"]}) == "not shown"
    assert units("V(x)", "L", domain={"where": ["x > r", "x < r"]}) == "not shown"
    assert units("V(x)", "L", domain={"on": ["x - r"]}) == "not shown"
    assert units("V(x)", "L", hamiltonian={"H": "sqrt(-p**2)"}) == "not shown"
    assert units("V(x)", "L", hamiltonian={"H": "N(x)"}) == "not shown"
    assert units("V(x)", "L", claim={"where": "x"}) == "not shown"
    assert units("sqrt(-x**2)*V(x)", "L") == "not shown"
    assert units("log(U(x) - U(x))", "L") == "not shown"
    assert units("0*V(x)", "L") == "not shown"
    assert units("V(x) - V(x)", "L") == "not shown"
    assert units("V(x)", "L", witness={"V": "0"}) == "not shown"
    assert units("V(x)", "L", witness={"V": "m*a"}) == "not shown"  # no function of a


TURN: Any = {
    "phase_space": {"q": ["x", "y"], "p": ["px", "py"]},
    "symbols": {"m": "positive", "b": "positive", "T": "positive", "A": "real", "u": "real", "v": "real"},
}
CHARGE = {
    "kind": "stationary", "L": "m*(u**2 + v**2)/2 + m*b*(x*v - y*u)/2", "velocities": ["u", "v"], "from": "0",
    "path": ["A*sin(b*t)", "A*cos(b*t)"], "to": "T + 3*pi/b", "extremum": "minimum",
    "field": [["sin(b*(t - T))", "cos(b*(t - T)) - 1"]], "conjugate": ["T", "T + 2*pi/b"],
}  # fmt: skip


def test_a_minimum_with_conjugate_points_is_refuted() -> None:
    said = lambda **keys: ask(counterexample_variations, {**TURN, "claim": {**CHARGE, **keys}})
    assert said() == "shown"
    assert said(extremum="maximum") == "shown"
    others: list[Any] = [
        {"extremum": "neither"}, {"to": "T + 2*pi/b"}, {"to": "T + pi/b"}, {"from": "T"}, {"from": "T + pi/b"},
        {"field": [["sin(b*(t - T))", "cos(b*(t - T))"]]}, {"field": [["sin(2*b*(t - T))", "cos(2*b*(t - T)) - 1"]]},
        {"field": [["0", "0"]]}, {"conjugate": ["T", "T"]}, {"conjugate": ["T", "T + pi/b"]}, {"conjugate": ["T"]},
        {"conjugate": ["T + 2*pi/b", "T"]}, {"path": ["A*sin(b*t)", "A*cos(2*b*t)"]}, {"field": []},
        {"L": "m*(u**2 - v**2)/2 + m*b*(x*v - y*u)/2"}, {"extremum": "saddle"}, {"kind": "stationary", "key": "0"},
    ]  # fmt: skip
    for keys in others:
        assert said(**keys) == "not shown"
    assert ask(counterexample_variations, {**TURN, "claim": {**CHARGE}, "domain": {"where": ["x > 0"]}}) == "not shown"
    plain = {key: x for key, x in CHARGE.items() if key not in ("field", "conjugate")}
    assert ask(counterexample_variations, {**TURN, "claim": plain}) == "not shown"


def test_the_certificate_is_refuted_with_the_other_files() -> None:
    data = {"certificate": 1, "tables": {**TURN, "claim": CHARGE}, "verdict": "refuted", "witness": None, "known": {}}
    assert refutations.checked(resealed(data))[0] == "shown"
    short = {**data, "tables": {**TURN, "claim": {**CHARGE, "to": "T + pi/b"}}}
    assert refutations.checked(resealed(short))[0] == "not shown"


FREE: Any = {
    "phase_space": {"q": ["q"], "p": ["p"], "Q": ["tau"], "P": ["E"]},
    "hamiltonian": {"H": "p**2/2"},
    "transformation": {"Q": ["q/p"], "P": ["p**2/2"]},
}


def integral(W: str, *where: str, witness: Any = None, **sections: Any) -> str:
    claim = {"kind": "hamilton_jacobi", "W": W, "constants": ["E"], "energy": "E", **sections.pop("claim", {})}
    tables = {**FREE, **sections, "domain": {"where": [*where]}, "claim": claim}
    return ask(counterexample_hamilton_jacobi, tables, witness or {"E": "1/2", "q": "3"})


def test_conditions_on_a_constant_are_about_the_constant() -> None:
    """The map's value is 4 E with this W, of which nothing is said."""
    right, wrong = "sqrt(2*E)*q", "2*sqrt(2*E)*q"
    assert integral(right, "E < 1") == "not shown"
    assert integral(wrong, "E < 1") == "shown"
    assert integral(wrong, "E < 1", "p > 0") == "shown"
    assert integral(right, "E < 1", "p > 0") == "not shown"
    assert integral(wrong, "E < 1", "E > 1") == "not shown"
    assert integral(wrong, "E < 1", "p < 0") == "not shown"
    assert integral(wrong, "E < 0") == "not shown"
    assert integral(right, "E < 1", claim={"constants": [], "energy": "E"}) == "not shown"
    assert integral(wrong, symbols={"E": "negative"}) == "not shown"
    assert integral("(sqrt(2*E) + 2)*q", "E < 1") == "shown"  # the map's value is above 2


def test_conditions_on_other_new_variables_are_about_the_map() -> None:
    """τ = q/p has the sign of q."""
    wrong = "2*sqrt(2*E)*q"
    assert integral(wrong, "tau > 0") == "shown"
    assert integral(wrong, "tau < 0", "q > 0") == "not shown"
    assert integral(wrong, "q > 0", symbols={"tau": "negative"}) == "not shown"
