"""Certificates of false claims, made by hand by somebody who knows the checker: none is confirmed.

Each has a right checksum; what it shows was true in some sense of an earlier checker, and isn't a proof.
"""

from typing import Any

import pytest

from canon.checker.check import Answer, check, checksum
from canon.checker.functions import Unreadable

PRIME = 2**127 - 1
"""The prime of an earlier version."""


def forged(
    lhs: str,
    rhs: str = "0",
    *,
    residual: dict[str, Any] | None = None,
    kernels: tuple[dict[str, Any], ...] = (),
    atoms: dict[str, Any] | None = None,
    **tables: Any,
) -> dict[str, Any]:
    """A certificate of lhs = rhs; without more, it says that the residual is 0/1."""
    residual = residual or {"numerator": {}, "denominator": {"": "1"}, "cofactors": {}}
    return sealed(
        {
            "certificate": 1,
            "tables": {
                "phase_space": {"q": ["x"], "p": ["p"]},
                "claim": {"kind": "identity", "lhs": lhs, "rhs": rhs},
                **tables,
            },
            "known": {},
            "verdict": "proved",
            "method": "normal form",
            "domain": [],
            "witness": None,
            "points": [],
            "cases": [{"kernels": list(kernels), "atoms": atoms or {}, "residuals": [residual]}],
        }
    )


def sealed(data: dict[str, Any]) -> dict[str, Any]:
    return {**data, "checksum": checksum({k: v for k, v in data.items() if k != "checksum"})}


def kernel(name: str, meaning: str, relation: dict[str, str] | None = None, sign: str = "real") -> dict[str, Any]:
    return {"name": name, "stands for": meaning, "sign": sign} | ({"relation": relation} if relation else {})


def power_of(name: str, exponent: int) -> str:
    """x^exponent with no exponent of more than 10,000 in it."""
    if exponent <= 10_000:
        return f"{name}**{exponent}"
    quotient, rest = divmod(exponent, 10_000)
    return f"({power_of(name, quotient)})**10000*{name}**{rest}"


SMALL = "(x*(1/10000000000000000000000000000000000000000))"
BRANCH = "sqrt((x - 1000)**2)"
"""|x - 1000|, which is 1000 - x at all points that a checker would try."""

FALLING = {"x": "-1", "": "1000"}
FORGERIES: dict[str, dict[str, Any]] = {
    # a value that is smaller than what can be told from 0 in fifty digits
    "a small sine": forged("sin(x/10**40)", atoms={f"sin({SMALL})": [{}, {"": "1"}]}),
    "a small exponential": forged("exp(x/10**40)", "1", atoms={
        f"exp({SMALL})": [{"": "1"}, {"": "1"}]}),
    # numbers that are 0 modulo the prime
    "a multiple of the prime": forged(f"x*{PRIME}/10**80"),
    "Fermat": forged(f"(({power_of('x', PRIME - 1)}) - 1)/10**40", domain={"where": ["x > 0", "x < 1"]}),
    # right in one component of the domain: the denominator is 0 in another
    "another branch": forged(BRANCH, "1000 - x", kernels=(
        kernel("g1", "((x-1000)**2)**(1/2)", {"g1^2": "1", "x^2": "-1", "x": "2000", "": "-1000000"}, "nonneg"),),
        atoms={"(((x+-1000)**2)**(1/2))": [{"g1": "1"}, {"": "1"}]},
        residual={"numerator": {"g1^2": "1", "x^2": "-1", "x": "2000", "": "-1000000"},
                  "denominator": {"g1": "1", "x": "-1", "": "1000"}, "cofactors": {"g1": {"": "1"}}}),
    "a root's sign": forged(BRANCH, "1000 - x", atoms={"(((x+-1000)**2)**(1/2))": [FALLING, {"": "1"}]}),
    "an absolute value": forged("abs(x - 1000)", "1000 - x", atoms={"abs((x+-1000))": [FALLING, {"": "1"}]}),
    "a sign": forged("sign(x - 1000)", "-1", atoms={"sign((x+-1000))": [{"": "-1"}, {"": "1"}]}),
    "an arcsine": forged("asin(sin(x/100))", "x/100", atoms={"asin(sin((x*(1/100))))": [{"x": "1/100"}, {"": "1"}]}),
    # a number that is nearly a root
    "nearly a root": forged("(sqrt(2) + 1/10**40)**2", "2", kernels=(
        kernel("g1", "2**(1/2) + 1/10**40", {"g1^2": "1", "": "-2"}, "pos"),),
        atoms={"(2**(1/2))": [{"g1": "1", "": "-1/10000000000000000000000000000000000000000"}, {"": "1"}]},
        residual={"numerator": {"g1^2": "1", "": "-2"}, "denominator": {"": "1"}, "cofactors": {"g1": {"": "1"}}}),
    # a kernel with the name of a variable
    "a variable's name": forged("x**2", "y**2", kernels=(kernel("y", "(x**2)**(1/2)", {"y^2": "1", "x^2": "-1"}),),
        residual={"numerator": {"x^2": "1", "y^2": "-1"}, "denominator": {"": "1"}, "cofactors": {"y": {"": "-1"}}},
        claim={"kind": "identity", "lhs": "x**2", "rhs": "y**2", "constants": ["y"]}),
    # the potential of a form that is closed, and has none beyond the cut
    "a potential with a cut": sealed({**forged("0"), "known": {"potential": "atan(x/y)"},
        "tables": {"phase_space": {"q": ["x", "y"], "p": ["a", "b"], "Q": ["X", "Y"], "P": ["A", "B"]},
                   "hamiltonian": {"H": "0"}, "claim": {"kind": "cartan_invariant", "K": "0"},
                   "transformation": {"Q": ["x", "y"], "P": ["a - y/(x**2 + y**2)", "b + x/(x**2 + y**2)"]}},
        "cases": [{"kernels": [], "atoms": {}, "residuals": [
            {"numerator": {}, "denominator": {"": "1"}, "cofactors": {}}] * 5}]}),
    # an antiderivative that jumps
    "a jump": sealed({**forged("0"), "tables": {"phase_space": {"q": ["q"], "p": ["p"]}, "claim": {
        "kind": "integral", "f": "-1/x**2", "variable": "x", "from": "-1", "to": "1", "equals": "2",
        "antiderivative": "1/x"}}, "cases": [{"kernels": [], "atoms": {}, "residuals": [
            {"numerator": {}, "denominator": {"": "1"}, "cofactors": {}}] * 2}]}),
    # a key that nobody looks at
    "an unknown key": forged("x", "x", claim={"kind": "identity", "lhs": "x", "rhs": "x", "and_so_is": "1 = 0"}),
    # inequalities between numbers that cancel
    "digits that cancel": forged("0", "3 - ((pi + 10**200) - 10**200)",
        claim={"kind": "inequality", "lhs": "0", "rhs": "3 - ((pi + 10**200) - 10**200)", "relation": "<"}),
}  # fmt: skip


def witnessed(data: dict[str, Any], **point: str) -> dict[str, Any]:
    return sealed({**data, "verdict": "refuted", "witness": point, "cases": []})


REFUTATIONS = {
    "cancelling": witnessed(forged("(x + 10**200) - 10**200", "x"), x="1/3", p="1"),
    "cancelling in a function": witnessed(forged("exp(x)*((p + 10**200) - 10**200)", "exp(x)*p"), x="1/3", p="1/7"),
    "outside of the domain": witnessed(
        forged("sqrt(x**2)", "x", domain={"where": ["(x + 10**200) - 10**200 + 1 > 0", "x > 0"]}), x="-1/3", p="1"
    ),
}


def answered(data: dict[str, Any]) -> str:
    try:
        return check(data).status
    except Unreadable:
        return "unreadable"


@pytest.mark.parametrize("name", sorted(FORGERIES))
def test_no_proof_of_what_is_false(name: str) -> None:
    assert answered(FORGERIES[name]) != "confirmed", name


@pytest.mark.parametrize("name", sorted(REFUTATIONS))
def test_no_refutation_of_what_is_true(name: str) -> None:
    answer: Answer = check(REFUTATIONS[name])
    assert answer.status != "confirmed", name
