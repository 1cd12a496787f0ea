"""Certificates of false claims about integrals, limits and averages, which show nothing and rely on the rules alone.

Those of `FALSE` were confirmed by an earlier checker.
"""

from typing import Any

import pytest

from canon.checker.check import check
from canon.checker.functions import Unreadable
from tests.checker.test_forgeries import forged, sealed


def of(claim: dict[str, Any], zeros: int, *, atoms: dict[str, Any] | None = None, **tables: Any) -> dict[str, Any]:
    """A certificate that leaves so many residuals to the rules; or with `atoms`, of residuals that are 0 by these."""
    own = {"phase_space": {"q": ["q"], "p": ["p"]}, "claim": claim}
    zero = {"argument": "the rules"} if atoms is None else {"numerator": {}, "denominator": {"": "1"}, "cofactors": {}}
    shown = {"kernels": [], "atoms": atoms or {}, "residuals": [zero] * zeros}
    return sealed({**forged("0"), "tables": {**own, **tables}, "cases": [shown]})


def integral(f: str, F: str, low: str, high: str, equals: str, **symbols: str) -> dict[str, Any]:
    keys = {"f": f, "antiderivative": F, "variable": "u", "from": low, "to": high, "equals": equals}
    return of({"kind": "integral", **keys}, 2, symbols=symbols)


def average(f: str, equals: str, F: str, motion: dict[str, str], zeros: int = 4, **tables: Any) -> dict[str, Any]:
    keys = {"f": f, "equals": equals, "antiderivative": F, "parameter": "u", "from": "0", "to": "2*pi"}
    return of({"kind": "average", "motion": {**motion, "t": "u"}, **keys}, zeros, **tables)


ROUND = {"q": "cos(u)", "p": "-sin(u)"}
OSCILLATOR = {"H": "p**2/2 + q**2/2"}
FALSE = {
    "past a pole of tanh at iπ/2": integral("1/cosh(u + pi*1j/2)**2", "tanh(u + pi*1j/2)", "-1", "1",
        "tanh(1 + pi*1j/2) - tanh(pi*1j/2 - 1)"),
    "across the cut of atan": integral("1/(1 + (u + 2j)**2)", "atan(u + 2j)", "-1", "1", "atan(1 + 2j) - atan(2j - 1)"),
    "the same with a complex name": integral("1/(1 + (u + c)**2)", "atan(u + c)", "-1", "1",
        "atan(1 + c) - atan(c - 1)", c="complex"),
    "|u| of a positive u, from -1 on": of({"kind": "integral", "f": "abs(u)", "antiderivative": "u**2/2",
        "variable": "u", "from": "-1", "to": "1", "equals": "0"}, 2, atoms={"abs(u)": [{"u": "1"}, {"": "1"}]},
        symbols={"u": "positive"}),
    "an end that moves": integral("u", "u**2/2", "0", "u", "u**2/2"),
    "a limit that moves": of({"kind": "limit", "f": "u", "variable": "u", "to": "2*u", "equals": "2*u"}, 2),
    "Gauss's integral over a positive name": of({"kind": "integral", "f": "exp(-u**2/2)", "variable": "u",
        "from": "-infinity", "to": "infinity", "equals": "sqrt(2*pi)"}, 1, symbols={"u": "positive"}),
    "a parameter that moves": average("m", "1/2", "u/2 - sin(u)*cos(u)/2", {"q": "0", "p": "0", "m": "sin(u)**2"},
        hamiltonian=OSCILLATOR, symbols={"m": "real"}),
}  # fmt: skip
BEYOND = {
    "a positive coordinate": average("abs(q)", "0", "sin(u)", ROUND, hamiltonian=OSCILLATOR, symbols={"q": "positive"}),
    "a force with a kink": average("q", "0", "sin(u)", ROUND, hamiltonian={"H": "p**2/2 + q*sqrt(q**2)/2"},
        symbols={"q": "nonnegative"}),
    "a condition": average("sqrt(q**2)", "0", "sin(u)", ROUND, hamiltonian=OSCILLATOR, domain={"where": ["q > 0"]}),
}  # fmt: skip


def status(data: dict[str, Any]) -> str:
    try:
        return check(data).status
    except Unreadable:
        return "unreadable"


@pytest.mark.parametrize("name", sorted(FALSE))
def test_what_is_false_is_not_confirmed(name: str) -> None:
    assert status(FALSE[name]) in ("unreadable", "rejected", "not confirmed", "confirmed in part"), name


@pytest.mark.parametrize("name", sorted(BEYOND))
def test_a_motion_that_leaves_the_domain_says_nothing(name: str) -> None:
    assert status(BEYOND[name]) != "confirmed", name


def test_what_is_true_of_them_is_confirmed() -> None:
    """The same rules, where they hold."""
    assert status(integral("1/cosh(u)**2", "tanh(u)", "-1", "1", "2*tanh(1)")) == "confirmed"
    assert status(integral("exp(1j*u)", "-1j*exp(1j*u)", "0", "1", "1j - 1j*exp(1j)")) == "confirmed"
    assert status(average("q**2", "1/2", "u/2 + sin(2*u)/4", ROUND, hamiltonian=OSCILLATOR)) == "confirmed"


def test_a_name_that_is_written_as_infinity_is() -> None:
    decay = integral("exp(-u)", "-exp(-u)", "0", "infinity", "1")
    assert status(decay) == "confirmed"
    named = {**decay["tables"], "symbols": {"infinity": "positive"}}
    assert status(sealed({**decay, "tables": named})) == "unreadable"
