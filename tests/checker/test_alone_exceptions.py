"""Maps that are canonical for some values of parameters: what is shown, near misses, special values, hidden names."""

from typing import Any

import pytest

from canon.checker import alone_exceptions, alone_together
from canon.claims.reader import read_tables
from canon.claims.verify import verify
from tests.checker.certified import resealed

LINE: Any = {"q": ["q"], "p": ["p"], "Q": ["X"], "P": ["Y"]}
PLANE: Any = {"q": ["x", "y"], "p": ["a", "b"], "Q": ["X", "Y"], "P": ["A", "B"]}
NAMES: Any = {"c": "real", "d": "real", "k": "positive", "n": "nonzero", "V": "function"}


def tables(Q: Any, P: Any, *solutions: Any, symbols: Any = None, space: Any = None, **sections: Any) -> Any:
    of = lambda x: x if isinstance(x, list) else [x]
    return {
        "phase_space": space or LINE,
        "symbols": NAMES | (symbols or {}),
        "transformation": {"Q": of(Q), "P": of(P)},
        **{key: x for key, x in sections.items() if key != "claim"},
        "claim": {"kind": "canonical_when", "solutions": [*solutions], **sections.get("claim", {})},
    }


def answer(*of: Any, by: Any = alone_exceptions, **sections: Any) -> str:
    """The answer about the claim, whatever a certificate says of it."""
    data = {"certificate": 1, "tables": tables(*of, **sections), "verdict": "proved", "witness": None, "cases": []}
    return by.checked(resealed(data | {"known": {}}))[0]


POLAR = ("q**c*cos(d*p)", "q**c*sin(d*p)")
RADIUS: Any = {"symbols": {"q": "positive"}}
LINEAR = ("n*q + c*p", "d*q + k*p")
SHOWN: dict[str, Any] = {
    "a number": (("n*q", "p", {"n": "1"}), {}),
    "another parameter's inverse": (("n*q", "c*p", {"c": "1/n"}), {}),
    "a parameter that may be 0": (("q + p*c", "c*p + d*p", {"d": "1 - c"}), {}),
    "several solutions": ((*LINEAR, {"d": "(n*k - 1)/c"}, {"c": "0", "k": "2", "n": "1/2"}), {}),
    "powers and angles": ((*POLAR, {"c": "1/2", "d": "2"}), RADIUS),
    "a condition": (("q*c", "p*d", {"d": "1/c"}), {"domain": {"where": ["c > d", "q != p"]}}),
    "a definition": (("q*w", "p", {"c": "2"}), {"definitions": {"w": "c**2 - 3"}}),
    "time": (("q*(1 + c*t)", "p", {"c": "0"}), {}),
    "another name of time": (("q*(1 + c*s)", "p", {"c": "0"}), {"space": {**LINE, "time": "s"}}),
    "an exponential": (("q*exp(c)", "p*exp(d)", {"c": "-d"}, {"c": "0", "d": "0"}), {}),
    "a function in the Hamiltonian alone": (("q*c", "p", {"c": "1"}), {"hamiltonian": {"H": "V(q) + k*p**2"}}),
    "two pairs": ((["x", "y"], ["a + c*y", "b + d*x"], {"c": "d"}), {"space": PLANE}),
    "what isn't 0 besides": (("(1 + n*(c - 1))*q", "p", {"c": "1"}), {}),
}  # fmt: skip


@pytest.mark.parametrize("name", SHOWN)
def test_exceptions_are_shown(name: str) -> None:
    of, sections = SHOWN[name]
    assert answer(*of, **sections) == "shown"
    assert answer(*of, by=alone_together, **sections) == "shown"
    Q, P, *solutions = of
    more = [{**one, key: f"({text}) + 1/1000"} for one in solutions for key, text in [*one.items()][:1]]
    assert all(answer(Q, P, *solutions, one, **sections) == "not shown" for one in more)
    assert answer(Q, P, **sections) == "not shown"
    assert answer(Q, P, *solutions, {}, **sections) == "not shown"


NOT: dict[str, Any] = {
    "all values": (("n*q", "p/n", {"n": "1"}), {}), "all values of it": (("n*q", "p/n", {"c": "1"}), {}),
    "all values, by sines": (("q + sin(c)*p", "p", {"c": "0"}), {}),
    "all values where another is 0": (("(1 + d*(c - 1))*q", "p", {"c": "1"}), {}),
    "all values where others are alike": (("(1 + (d - k)*(c - 1))*q", "p", {"c": "1"}), {}),
    "one of two is wrong": (("c**2*q", "p", {"c": "1"}, {"c": "2"}), {}),
    "another scale": (("c*q", "p", {"c": "2"}), {}), "minus": (("c*q", "p", {"c": "-1"}), {}),
    "a solution for others": (("c*q", "d*p", {"c": "d"}), {}),
    "a positive name that isn't": (("k**2*q", "p", {"k": "-1"}), {}),
    "a name of any sign for a positive one": (("k*q", "p*c", {"k": "1/c"}), {}),
    "a name that isn't 0": (("(n + 1)*q", "p", {"n": "0"}), {}),
    "a name that isn't 0, as a difference": (("(n + 1)*q", "p", {"n": "c - c"}), {}),
    "a sign in a definition": (("k**2*q", "p", {"k": "w"}), {"definitions": {"w": "-1"}}),
    "a domain without its values": (("c**2*q", "p", {"c": "-1"}), {"domain": {"where": ["c > 0"]}}),
    "a domain that shuts it out": (("c*q", "p", {"c": "1"}), {"domain": {"where": ["c != 1"]}}),
    "a range without points": (("c*q", "p", {"c": "1"}), {"domain": {"where": ["0 < q < c - 1"]}}),
    "a domain without points": (("c*q", "p", {"c": "1"}), {"domain": {"where": ["q > 1", "q < 1"]}}),
    "a domain with an edge": (("c*q", "p", {"c": "1"}), {"domain": {"where": ["q >= c"]}}),
    "a domain of one value": (("c*q", "p", {"c": "1"}), {"domain": {"where": ["c <= 1", "c >= 1"]}}),
    "a surface": (("c*q", "p", {"c": "1"}), {"domain": {"on": ["q - 1"]}}),
    "a pole there": (("q", "p*(c - 1)/(c - 1)*c", {"c": "1"}), {}),
    "a value with a pole": (("c*q", "p", {"c": "1/(d - d)"}), {}),
    "a root that pins it": (("c*q + 0*sqrt(-(c - 2)**2)", "p", {"c": "1"}), {}),
    "a logarithm": (("c*q + 0*log(q)", "p", {"c": "1"}), {}),
    "moduli": (("q + c*(sqrt(q**2) - q)", "p", {"c": "0"}), {"domain": {"where": ["q > -1"]}}),
    "moduli that are none": (("q + c*(sqrt(q**2) - q)", "p", {"c": "0"}), {"domain": {"where": ["q > 0"]}}),
    "a modulus": (("q*abs(c)", "p", {"c": "1"}), {}),
    "an essential pole": (("q*exp(1/c)", "p*exp(d)", {"d": "-1/c"}), {}),
    "a pole in an exponent": (("q*exp(1/c - 1)", "p", {"c": "1"}), {}),
    "a new variable that restricts it": (("c*q", "p", {"c": "1"}), {"symbols": {"X": "positive"}}),
    "a power of what has no sign": ((*POLAR, {"c": "1/2", "d": "2"}), {}),
    "half of an angle": ((*POLAR, {"c": "1/2", "d": "1"}), RADIUS),
    "the other angle": ((*POLAR, {"c": "1/2", "d": "-2"}), RADIUS),
    "an angle nearly so": ((*POLAR, {"c": "1/2", "d": "2 + 10**(-9)"}), RADIUS),
    "a function in the map": (("c*q + V(p)", "p", {"c": "1"}), {}),
    "a function for a parameter": (("c*q", "p", {"V": "1"}), {}),
    "a variable": (("c*q", "p", {"q": "1"}), {}), "a new variable": (("c*q", "p", {"X": "1", "c": "1"}), {}),
    "time for a value": (("c*q", "p*d", {"c": "1/t", "d": "t"}), {}), "time": (("t*q", "p", {"t": "1"}), {}),
    "a variable in a value": (("c*q", "p", {"c": "1 + 0*q"}), {}),
    "a variable in a definition": (("c*q", "p", {"c": "w"}), {"definitions": {"w": "1 + 0*q"}}),
    "two names for each other": (("c*q", "p/d", {"c": "d", "d": "c"}), {}),
    "a name for itself": (("c*q", "p", {"c": "c"}), {}),
    "itself, by a definition": (("c*q", "p/w", {"c": "w"}), {"definitions": {"w": "c"}}),
    "a definition's name": (("w*q", "p", {"w": "1"}), {"definitions": {"w": "c"}}),
    "a name that isn't declared": (("g*q", "p", {"g": "1"}), {}), "a number that is none": (("c*q", "p", {"c": 1}), {}),
    "whole numbers": (("m*q", "p", {"m": "1"}), {"symbols": {"m": "integer"}}),
    "complex ones": (("m*q", "p", {"m": "1"}), {"symbols": {"m": "complex"}}),
    "a key": (("c*q", "p", {"c": "1"}), {"claim": {"scale": "1"}}),
    "a table for a list": (("c*q", "p"), {"claim": {"solutions": {"c": "1"}}}),
    "another kind": (("c*q", "p", {"c": "1"}), {"claim": {"kind": "canonical"}}),
    "a Hamiltonian with an edge": (("c*q", "p", {"c": "1"}), {"hamiltonian": {"H": "log(q)"}}),
    "a Hamiltonian of new variables": (("c*q", "p", {"c": "1"}), {"hamiltonian": {"H": "X**2"}}),
    "a new variable with a sign": (("-c*q**2", "p", {"c": "1"}), {"symbols": {"X": "positive"}}),
    "a new variable in the map": (("c*q", "p + 0*X", {"c": "1"}), {}),
    "a definition with an edge": (("c*q", "p", {"c": "1"}), {"definitions": {"w": "sqrt(-c**2)"}}),
    "a generating function": (("c*q", "p", {"c": "1"}), {"generating_function": {"type": 2, "F": "q*Y"}}),
    "a generating function that isn't one": (("c*q", "p", {"c": "1"}), {"generating_function": {}}),
    "fewer variables": ((["x*c"], ["a"], {"c": "1"}), {"space": {**PLANE, "Q": ["X"], "P": ["A"]}}),
    "one pair alone": ((["c*x", "d*y"], ["a", "b"], {"c": "1"}), {"space": PLANE}),
    "pairs that are exchanged": ((["y", "x"], ["a*c", "b*c"], {"c": "1"}), {"space": PLANE}),
    "what isn't rational, with another name in it": (("q*exp(c)", "p*exp(d)", {"c": "-d"}), {}),
    "a derivative": (("c*q", "D(c*p, p)*p/c", {"c": "1"}), {}),
}  # fmt: skip


@pytest.mark.parametrize("name", NOT)
def test_others_are_not(name: str) -> None:
    of, sections = NOT[name]
    assert answer(*of, **sections) == "not shown"


def test_what_is_shown_is_what_canon_proves() -> None:
    for of, sections in SHOWN.values():
        (claim,) = read_tables(files(tables(*of, **sections))).claims
        assert verify(claim).status == "proved"


def files(one: Any) -> Any:
    """The tables of a file with this claim."""
    return {key: x for key, x in one.items() if key != "claim"} | {"claim": [one["claim"]]}


def test_a_checksum_and_a_verdict() -> None:
    data = {
        "certificate": 1,
        "tables": tables("c*q", "p", {"c": "1"}),
        "verdict": "proved",
        "witness": None,
        "cases": [],
    }
    assert alone_exceptions.checked(resealed(data))[0] == "shown"
    assert alone_exceptions.checked({**resealed(data), "checksum": "0"})[0] == "wrong"
    for other in ({"verdict": "refuted"}, {"verdict": "supported"}, {"witness": {"c": "1"}}):
        assert alone_exceptions.checked(resealed(data | other))[0] == "not shown"
