"""Certificates of false claims about actions and complete integrals, and of claims that no file could state.

They show nothing and rely on the rules alone. All but one of `FALSE` were confirmed by an earlier checker.
"""

from typing import Any

import pytest

from canon.checker.check import check
from tests.checker.test_forged_calculus import of, status
from tests.checker.test_forgeries import sealed

FREE = {"H": "p**2/2"}


def rotation(equals: str, H: str = "p**2/2", *, period: str = "2*pi", **tables: Any) -> dict[str, Any]:
    keys = {"coordinate": "q", "energy": "E", "branch": "rotation", "period": period, "equals": equals}
    return of({"kind": "action", **keys}, 1, hamiltonian={"H": H}, **tables)


def complete(W: str, *constants: str) -> dict[str, Any]:
    claim = {"kind": "hamilton_jacobi", "W": f"({W})*q", "energy": f"({W})**2/2", "constants": list(constants)}
    return of(claim, 1, hamiltonian=FREE)


FALSE = {
    "a period below 0": rotation("-2*pi*sqrt(2*E)", period="-2*pi"),
    "no period": rotation("0", period="0"),
    "a period that moves": rotation("q*sqrt(2*E)", period="q"),
    "another branch with p > 0": rotation("2*pi*(3 + sqrt(2*E))", "(p - 3)**2/2"),
    "p < 0": rotation("2*pi*sqrt(2*E)", domain={"where": ["p < 0"]}),
    "p is negative": rotation("2*pi*sqrt(2*E)", symbols={"p": "negative"}),
    "no constant for a < 0": complete("abs(a) + a", "a"),
    "the same by a root": complete("sqrt(a**2) + a", "a"),
    "the same by arctangents": complete("1/7 + (a + 1)*(atan(a) + atan(1/a) - pi/2)", "a"),
    "an energy that is no name": of(
        {"kind": "action", "coordinate": "q", "energy": "2*E", "equals": "4*pi*E"},
        1,
        hamiltonian={"H": "p**2/2 + q**2/2"},
        symbols={"E": "positive"},
    ),
    "a constant twice": complete("sqrt(2*E)", "E", "E"),
}


@pytest.mark.parametrize("name", sorted(FALSE))
def test_what_is_false_is_not_confirmed(name: str) -> None:
    assert status(FALSE[name]) != "confirmed", name


def test_what_is_true_of_them_is_confirmed() -> None:
    """The same rules, where they hold."""
    assert status(rotation("2*pi*sqrt(2*E)")) == "confirmed"
    assert status(rotation("c*sqrt(2*E)", period="c", symbols={"c": "positive"})) == "confirmed"
    assert status(complete("sqrt(2*E)", "E")) == "confirmed"


def least(path: str = "sin(t)", L: str = "v**2/2 - q**2/2", to: str = "6", start: str = "0", **keys: Any) -> Any:
    """A path that is to be a minimum; the residuals are left to the rules."""
    domain = {"domain": {"where": [keys.pop("where")]}} if "where" in keys else {}
    claim = {"kind": "stationary", "L": L, "velocities": ["v"], "path": [path], "from": start, "to": to}
    zeros = 1 + ("field" in keys)
    symbols = {"t": keys.pop("time")} if "time" in keys else {}
    return of({**claim, "extremum": "minimum", **keys}, zeros, symbols=symbols, **domain)


MINIMA = {
    "a field with a kink at the conjugate point": least(field="sqrt(sin(t)**2)"),
    "the same by |sin t|": least(field="abs(sin(t))"),
    "the same by a root of the fourth power": least(field="(sin(t)**4)**(1/4)"),
    "a pole of the second variation": least("0", "v**2/2 + q**2/(t - 1)**2"),
    "a path that leaves the domain": least("1 - t", "v**2/2", where="q > 0"),
    "a time that leaves the domain": least("1", "t*v**2/2", "1", "-1", where="t > 0"),
    "a time that is positive, from -1 on": least("1", "t*v**2/2", "1", "-1", time="positive"),
    "a path of velocities": least("v*t", "v**2/2"),
    "a path of its coordinate": least("t*q", "v**2/2"),
    "a momentum in L": least("t", "v**2/2 + p*v"),
    "ends that move": least("t", "v**2/2", "t + 1", "t"),
}
QUARTIC = {"H": "p**2/2 + q**2/2 + q**4"}
CENTRED = {
    "an origin outside of the domain": ({"4": "3/8*(q**2 + p**2)**2"}, QUARTIC, {"where": ["q > 1"]}),
    "two parts of one degree": ({"4": "7*(q**2 + p**2)**2", "04": "3/8*(q**2 + p**2)**2"}, QUARTIC, {}),
    "a coefficient that is 1001/1000 of its own": ({"4": "3003/8000*(q**2 + p**2)**2"}, QUARTIC, {}),
}


@pytest.mark.parametrize("name", sorted(MINIMA))
def test_no_minimum_that_is_none(name: str) -> None:
    assert status(MINIMA[name]) != "confirmed", name


@pytest.mark.parametrize("cases", [1, 2])
@pytest.mark.parametrize(
    "more",
    [{"field": "sin(7*t)"}, {"field": "sinh(t - 1)", "conjugate": ["1", "2"]}, {"conjugate": ["1", "2"]}],
)
def test_no_field_that_is_none_beside_a_sum_of_squares(more: dict[str, Any], cases: int) -> None:
    claim = {"kind": "stationary", "L": "(v**2 + q**2)/2", "velocities": ["v"], "path": ["sinh(t)"]}
    assert status(of({**claim, "from": "0", "to": "6", "extremum": "minimum", **more}, cases)) != "confirmed"


@pytest.mark.parametrize("name", sorted(CENTRED))
def test_no_normal_form_that_is_none(name: str) -> None:
    N, H, domain = CENTRED[name]
    claim = {"kind": "normal_form", "order": 4, "N": N}
    assert status(of(claim, 0, hamiltonian=H, domain=domain)) != "confirmed", name


def test_no_refutation_of_a_normal_form_without_a_quadratic_part() -> None:
    data = of({"kind": "normal_form", "order": 4, "N": {}}, 0, hamiltonian={"H": "q**4"})
    assert status(sealed({**data, "verdict": "refuted", "cases": []})) != "confirmed"


def test_minima_and_normal_forms_are_confirmed() -> None:
    """The same rules, where they hold: up to half a period, with a time that begins at 0."""
    assert status(least(to="3", field="sin(t)")) == "confirmed"
    assert status(least("sinh(t)", "(v**2 + q**2)/2", field="cosh(t)")) == "confirmed"
    assert status(least("t", "v**2/2", time="positive")) == "confirmed"
    claim = {"kind": "normal_form", "order": 4, "N": {"4": "3/8*(q**2 + p**2)**2"}}
    assert status(of(claim, 0, hamiltonian=QUARTIC)) == "confirmed"


def test_no_refutation_by_an_orbit_that_leaves_the_domain() -> None:
    """Of an action at a point, where all orbits have momenta of both signs."""
    claim = {"kind": "action", "coordinate": "q", "energy": "E", "equals": "3*pi*E"}
    data = of(claim, 0, hamiltonian={"H": "p**2/2 + q**2/2"})
    against = sealed({**data, "verdict": "refuted", "witness": {"E": "1"}, "cases": []})
    assert check(against).status == "confirmed"
    for word in ("negative", "nonzero"):
        tables = {**against["tables"], "symbols": {"p": word}}
        assert check(sealed({**against, "tables": tables})).status != "confirmed"
