"""Certificates in which something has no value, or no constancy, at the very place that a claim is about.

What is multiplied by 0 there vanishes from a formula and not from its domain: x·√(x − 1) has no value at 0. And what
stands in a kernel's text, or moves in a structure constant, says nothing of the claim's domain. Each of `FALSE` was
confirmed by an earlier checker.
"""

from typing import Any

import pytest

from canon.checker.check import check
from canon.checker.functions import Unreadable
from canon.checker.kinds import obligations
from canon.checker.statement import Statement
from tests.checker.test_forgeries import kernel, sealed

PLANE = {"phase_space": {"q": ["q"], "p": ["p"]}}
MAP = {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]}
ZERO = {"argument": "the rules"}


def of(claim: dict[str, Any], *, known: dict[str, Any] | None = None, **tables: Any) -> dict[str, Any]:
    """A certificate that leaves as many residuals to the rules as its claim asks for."""
    tables, known = {**PLANE, **tables, "claim": claim}, known or {}
    try:
        cases = obligations(Statement(tables, known, "proved"))
    except ValueError:  # the checker's own answer is asked for
        cases = []
    shown = [{"kernels": [], "atoms": {}, "residuals": [ZERO] * len(case.shown("proved"))} for case in cases]
    data = {"certificate": 1, "tables": tables, "known": known, "verdict": "proved", "witness": None, "cases": shown}
    return sealed(data)


def absolute(meaning: str, *first: dict[str, Any], known: dict[str, str] | None = None) -> dict[str, Any]:
    """|q| = q, as g² = |q| for a kernel g that is √q, where q is 0 or more."""
    data = of({"kind": "identity", "lhs": "abs(q)", "rhs": "q"}, known=known)
    root = kernel("g", meaning, {"g^2": "1", "q": "-1"}, "nonneg")
    residual = {"numerator": {"g^2": "1", "q": "-1"}, "denominator": {"": "1"}, "cofactors": {"g": {"": "1"}}}
    shown = {"kernels": [*first, root], "atoms": {"abs(q)": [{"g^2": "1"}, {"": "1"}]}, "residuals": [residual]}
    return sealed({**data, "cases": [shown]})


def solves(equation: str, solution: str) -> dict[str, Any]:
    claim = {"kind": "solves", "equations": [equation], "solution": {"x(t)": solution}}
    return of(claim, symbols={"x": "function"})


def least(L: str, path: str, **keys: str) -> dict[str, Any]:
    claim = {"kind": "stationary", "L": L, "velocities": ["v"], "path": [path], "from": "0", "to": "1", **keys}
    return of(claim)


def average(f: str, H: str) -> dict[str, Any]:
    motion = {"q": "0", "p": "0", "t": "u"}
    ends = {"parameter": "u", "from": "0", "to": "1", "antiderivative": "u"}
    return of({"kind": "average", "f": f, "equals": "1", "motion": motion, **ends}, hamiltonian={"H": H})


def action(H: str, equals: str = "2*pi*E", kind: str = "action", **keys: Any) -> dict[str, Any]:
    claim = {"kind": kind, "coordinate": "q", "energy": "E", "equals": equals, **keys}
    space = {"q": ["q", "a"], "p": ["p", "m"]} if "fixed" in keys else PLANE["phase_space"]
    return of(claim, hamiltonian={"H": H}, symbols={"E": "positive"}, phase_space=space)


def algebra(v: str, u: str, structure: str, known: dict[str, Any] | None = None, **keys: Any) -> dict[str, Any]:
    own = {} if known else {"structure": {"v, u": structure}}
    return of({"kind": "algebra", "basis": {"v": v, "u": u, **keys.pop("more", {})}, **own, **keys}, known=known,
              symbols={"q": "positive"})  # fmt: skip


def group(composition: str) -> dict[str, Any]:
    return of({"kind": "group", "first": ["a"], "second": ["b"], "composition": [composition], "equals": "u(1)"})


def dimension(function: str, equals: str) -> dict[str, Any]:
    return of({"kind": "dimension", "functions": [function], "dimensions": {"q": "L"}, "equals": equals})


ROUND = "p**2/2 + q**2/2"
NARROW = kernel("h", "q + 0*sqrt(q)")
FALSE = {
    "a kernel's text with 0 times a root": absolute("sqrt(q) + 0*sqrt(q)"),
    "a kernel's text with a derivative of a root": absolute("sqrt(q) + D(sqrt(q), p)"),
    "a kernel's text with a bracket of a root": absolute("sqrt(q) + bracket(sqrt(q), 1)"),
    "another kernel's text": absolute("sqrt(q)", NARROW),
    "a root at a place where it is imaginary": solves("x(0)", "t*sqrt(t - 1)"),
    "a logarithm of 0": solves("x(0)", "t*log(t)"),
    "0 over 0": solves("x(0)", "t/sqrt(t)"),
    "an arcsine of -3": solves("x(0)", "t*asin(t - 3)"),
    "a path on which L has no value": least("v**2/2 + q**3*sqrt(q - 1)", "0"),
    "a minimum of what has no value": least("v**2/2 + q**4*sqrt(q - 1)", "0", extremum="minimum"),
    "a motion on which H has no value": average("1", "p**2/2 + q**3*sqrt(q - 1)"),
    "an average of what has no value": average("1 + q*sqrt(q - 1)", ROUND),
    "a value at which H has none": action(f"{ROUND} + m*sqrt(m - 1)", fixed={"m": "0"}),
    "a value at which H has none, for a frequency": action(
        f"{ROUND} + m*sqrt(m - 1)", "1/(2*pi)", "frequency", fixed={"m": "0"}
    ),
    "an orbit through roots that cancel": action(f"{ROUND} + sqrt(q + 5) - sqrt(q + 5)"),
    "their frequency": action(f"{ROUND} + sqrt(q + 5) - sqrt(q + 5)", "1/(2*pi)", "frequency"),
    "an orbit beyond a logarithm": action(f"{ROUND} + exp(log(q + 5)) - q - 5"),
    "an orbit beyond an arcsine": action("p**2/2 + sin(asin(q))**2/2"),
    "a constant map": of(
        {"kind": "identity", "lhs": "Q*sqrt(Q - 1)", "rhs": "0"},
        phase_space=MAP,
        transformation={"Q": ["0"], "P": ["p"]},
    ),
    "a structure constant with a coordinate": algebra("q**2/2", "p", "2/q*v"),
    "the same in the certificate alone": algebra("q**2/2", "p", "", known={"structure": {"v, u": "2/q*v"}},
                                                 equals="aff(1)"),
    "a structure constant with time": algebra("q*exp(t)", "p*exp(t)", "exp(2*t)*w", more={"w": "1"}),
    "a group without its unit": group("a + b*(1 + 0*log(b))"),
    "a group with a root of −1 at its unit": group("a + b + 0*sqrt(a - 1)"),
    "a dimension that is a sum": dimension("q", "L + L"),
    "a group without a name": of({"kind": "group", "first": ["a"], "second": ["b"], "composition": ["a + b"]}),
}  # fmt: skip
TRUE = {
    "a place": solves("x(0)", "t*sqrt(t + 1)"),
    "a path": least("v**2/2 + q**2*sqrt(q + 1)", "0"),
    "a minimum": least("v**2/2 + q**2*exp(q)", "0", extremum="minimum"),
    "a motion at rest": average("1 + q*exp(q)", f"{ROUND} + q**3"),
    "a value": action(f"{ROUND} + m*sqrt(m + 1)", fixed={"m": "0"}),
    "an orbit": action(ROUND),
    "a structure constant": algebra("q", "p", "w", more={"w": "1"}),
    "the same in the certificate alone": algebra("q", "p", "", known={"structure": {"v, u": "w"}}, more={"w": "1"},
                                                 equals="heisenberg(1)"),
    "a dimension": dimension("1/q**2", "1/L**2"),
    "a group": group("a + b"),
}  # fmt: skip


def status(data: dict[str, Any]) -> str:
    try:
        return check(data).status
    except Unreadable:
        return "unreadable"


@pytest.mark.parametrize("name", sorted(FALSE))
def test_what_is_false_is_not_confirmed(name: str) -> None:
    assert status(FALSE[name]) != "confirmed", name


@pytest.mark.parametrize("name", sorted(TRUE))
def test_what_is_true_is_confirmed(name: str) -> None:
    """The same rules, where they hold."""
    assert status(TRUE[name]) == "confirmed", name
