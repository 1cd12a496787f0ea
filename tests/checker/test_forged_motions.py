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


def test_no_refutation_by_an_orbit_that_leaves_the_domain() -> None:
    """Of an action at a point, where all orbits have momenta of both signs."""
    claim = {"kind": "action", "coordinate": "q", "energy": "E", "equals": "3*pi*E"}
    data = of(claim, 0, hamiltonian={"H": "p**2/2 + q**2/2"})
    against = sealed({**data, "verdict": "refuted", "witness": {"E": "1"}, "cases": []})
    assert check(against).status == "confirmed"
    for word in ("negative", "nonzero"):
        tables = {**against["tables"], "symbols": {"p": word}}
        assert check(sealed({**against, "tables": tables})).status != "confirmed"
