"""Certificates of what holds somewhere, and was claimed of a whole range, an orbit, or the neighbourhood of a place.

Each was confirmed once: what stands in a text and in no formula (0 · log q) was only asked to have a value somewhere,
the slope of a sign was 0 and so the sign a constant, and what bounds a motion, a limit's range or a solution wasn't
looked at.
"""

from typing import Any

import pytest

from canon.checker.check import Answer, check
from canon.checker.functions import Unreadable
from tests.checker.test_forged_calculus import of
from tests.checker.test_forgeries import sealed

OSCILLATOR = {"hamiltonian": {"H": "p**2/2 + q**2/2"}}
POSITIVE: dict[str, Any] = {"symbols": {"E": "positive"}}
MAP = {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]}}
PLANE: dict[str, Any] = {"phase_space": {"q": ["q", "r"], "p": ["p", "s"]}}
Stated = tuple[dict[str, Any], dict[str, Any]]


def answer(stated: Stated) -> str:
    """What the checker says of a proof that leaves all residuals to the rules, as many as there are."""
    claim, tables = stated
    for zeros in range(9):
        try:
            found: Answer = check(of(claim, zeros, **tables))
        except Unreadable:
            return "unreadable"
        if not any("residuals, but" in reason for reason in found.reasons):
            return found.status
    raise AssertionError("no number of residuals will do")


def claim(kind: str, keys: dict[str, Any], **tables: Any) -> Stated:
    return {"kind": kind, **keys}, tables


def integral(f: str, F: str, low: str, high: str, equals: str, **tables: Any) -> Stated:
    keys = {"f": f, "antiderivative": F, "variable": "u", "from": low, "to": high, "equals": equals}
    return claim("integral", keys, **tables)


def gauss(f: str) -> Stated:
    ends = {"from": "-infinity", "to": "infinity"}
    return claim("integral", {"f": f, "variable": "u", "equals": "sqrt(2*pi)", **ends})


def limit(
    f: str, to: str, equals: str, side: str | None = None, where: str | None = None, said: str = "real"
) -> Stated:
    keys = {"f": f, "variable": "x", "to": to, "equals": equals, **({"side": side} if side else {})}
    return claim("limit", keys, symbols={"x": said}, domain={"where": [where] if where else []})


def average(f: str, virial: str, H: str, where: str | None = None, equals: str = "0") -> Stated:
    keys = {"f": f, "equals": equals, "virial": virial, "bound": "1"}
    return claim("average", keys, hamiltonian={"H": H}, domain={"where": [where] if where else []})


def action(H: str = "p**2/2 + q**2/2", equals: str = "2*pi*E", kind: str = "action", **more: Any) -> Stated:
    keys = {key: more.pop(key) for key in ("branch", "period") if key in more}
    return claim(
        kind, {"coordinate": "q", "energy": "E", "equals": equals, **keys}, hamiltonian={"H": H}, **POSITIVE, **more
    )


def angles(H: str = "p**2/2 + q**2/2", forward: bool = False) -> Stated:
    back = {"q": ["sqrt(2*P)*sin(Q)"], "p": ["sqrt(2*P)*cos(Q)"]}
    images = {"Q": ["atan2(q, p)"], "P": ["(q**2 + p**2)/2"]} if forward else back
    tables = {"transformation": images, "hamiltonian": {"H": H}, "symbols": {} if forward else {"P": "positive"}}
    return claim("action_angle", {"angle_period": "2*pi"}, **tables, **MAP)


def normal(H: str) -> Stated:
    return claim("normal_form", {"order": 4, "N": {"4": "0"}}, hamiltonian={"H": H})


def path(L: str, along: str) -> Stated:
    keys = {"L": L, "velocities": ["v"], "path": [along], "from": "-1", "to": "1"}
    return claim("stationary", keys)


def series(equals: str) -> Stated:
    keys = {"generator": "p", "parameter": "s", "f": "q", "equals": equals}
    return claim("lie_series", keys, symbols={"s": "real"})


def solved(body: str, word: str) -> Stated:
    keys = {"solution": {"x(t)": body}, "equations": ["D(x(t), t) - x(t)"]}
    return claim("solves", keys, symbols={"x": ["function", word]})


GAP: dict[str, Any] = {"domain": {"where": ["sign((q - 1/1000)**2 - 1/100000000) > 0"]}}
"""A thin strip that each orbit has to cross, and that fifteen places of it are not in."""
FALSE = {
    # a name that is called as a function of the language is
    "a power that is positive, as the name power is": claim(
        "inequality", {"lhs": "x**n", "relation": ">", "rhs": "0"},
        symbols={"x": "real", "n": "integer", "power": "positive"}),
    # integrands without values
    "an integral across a hole": integral("(u**2 + u)/(u + 1)", "u**2/2", "-2", "2", "0"),
    "an integral over a half where a logarithm isn't": integral("1 + 0*log(u)", "u", "-1", "1", "2"),
    "an integral over a half where a root isn't": integral("sqrt(u)*sqrt(u) + u**2 - u", "u**3/3", "-1", "1", "2/3"),
    "an integral of |u| as of u": integral("0*sqrt(u) + sqrt(u**2)", "u**2/2", "-1", "1", "0"),
    "an integrand over what is 0 on a half": integral("(abs(u) + u)/(abs(u) + u)", "u", "-1", "1", "2"),
    "Gauss's integral with a jump": gauss("exp(-u**2/2 + sign(u - 1) + 1)"),
    "Gauss's integral over a half": gauss("exp(-u**2/2 + 0*log(u))"),
    # limits where nothing comes
    "a limit across a jump": limit("exp(x + sign(x - 1))*exp(-x)", "infinity", "exp(-1)"),
    "a limit on the logarithm's other side": limit("1 + x + 0*log(-x)", "0", "1", "+"),
    "a limit on the root's other side": limit("1 + x + 0*sqrt(x)", "0", "1", "-"),
    "a limit at -1 of a positive name": limit("x**2", "-1", "1", said="positive"),
    "a limit from below 0 of a positive name": limit("x**2 + 1", "0", "1", "-", said="positive"),
    "a limit at 0 where x > 1": limit("x**2 + 1", "0", "1", where="x > 1"),
    "a limit at infinity where x < 5": limit("1/x", "infinity", "0", where="x < 5"),
    "a limit at infinity of a negative name": limit("1/x", "infinity", "0", said="negative"),
    # motions that leave
    "an average within a wall that jumps": average("cos(q)", "sin(q)", "p", "sign(q) > 0"),
    "an average between two walls that jump": average("cos(q)", "sin(q)", "p", "sign(1 - q**2) > 0"),
    "an average of what isn't everywhere": average("cos(q) + 0*sqrt(q)", "sin(q)", "p"),
    "an average of 1 along motions that end": average("1", "q/sqrt(1 + q**2)", "p*(1 + q**2)*sqrt(1 + q**2)"),
    # orbits that leave
    "an action across a strip": action(**GAP),
    "a frequency across a strip": action(equals="1/(2*pi)", kind="frequency", **GAP),
    "an action where p > 0": action("p**2/2 + q**2/2 + 0*log(p)"),
    "an action where q > 0": action("p**2/2 + q**2/2 + 0*sqrt(q)"),
    "an action with a jump in p": action("p**2/2 + q**2/2 + sign(p - 5) + 1"),
    "an action of one coordinate of two": action(
        "p**2/2 + q**2/2 + s**2/2 + r**2/2", "2*pi*(E - s**2/2 - r**2/2)", **PLANE),
    "a rotation's action with the coordinate in it": action(
        "p**2/2 + sign(q - 1) + 1", "2*pi*sqrt(2*(E - sign(q - 1) - 1))", branch="rotation", period="2*pi"),
    "a rotation without a period": action("p**2/2", "2*pi*sqrt(2*E)", branch="rotation"),
    "an angle where p > 0": angles("p**2/2 + q**2/2 + 0*log(p)"),
    "an angle given forward where p > 0": angles("p**2/2 + q**2/2 + 0*log(p)", forward=True),
    "an angle given forward where q > 0": angles("p**2/2 + q**2/2 + 0*sqrt(q)", forward=True),
    # places that aren't there
    "a normal form where q > 0": normal("p**2/2 + q**2/2 + 0*log(q)"),
    "a normal form where q > 1": normal("p**2/2 + q**2/2 + sqrt(q - 1)**2*q**5"),
    "a Lie series where s > 0": series("q + s + 0*log(s)"),
    "a path along which L is nowhere": path("v**2/2 + 0*log(q)", "t"),
    "a path that is on a half": path("v**2/2", "t + 0*sqrt(t)"),
    "a solution that isn't positive": solved("-exp(t)", "positive"),
}  # fmt: skip
TRUE = {
    "an integral": integral("1 + 0*log(u)", "u", "1", "2", "1"),
    "an integral beside a root": integral("0*sqrt(u) + u", "u**2/2", "1", "3", "4"),
    "an integral with a root": integral("sqrt(1 - u)*sqrt(1 - u) + 0*log(u + 2)", "u - u**2/2", "-1", "1", "2"),
    "an integral over a polynomial": integral("(u**2 + u)/(u + 1)", "u**2/2", "0", "2", "2"),
    "Gauss's": gauss("exp(-u**2/2 + 0*atan(u))"),
    "a limit": limit("1 + x + 0*sqrt(x)", "0", "1", "+"),
    "a limit of a positive name": limit("x**2 + 1", "0", "1", "+", said="positive"),
    "a limit where x > 1": limit("1/x", "infinity", "0", where="x > 1"),
    "an average": average("cos(q)", "sin(q)", "p"),
    "an action": action(),
    "an action, with what is everywhere": action("p**2/2 + q**2/2 + 0*sin(p)*exp(q)"),
    "a rotation": action("p**2/2", "2*pi*sqrt(2*E)", branch="rotation", period="2*pi"),
    "an angle": angles(),
    "an angle given forward": angles(forward=True),
    "a normal form": normal("p**2/2 + q**2/2 + sqrt(1 - q)**2*q**5"),
    "a Lie series": series("q + s + 0*log(1 + s)"),
    "a path": path("v**2/2 + 0*log(2 + q**2)", "t + 0*exp(t)"),
    "a solution": solved("exp(t)", "positive"),
    "a solution that isn't 0": solved("-exp(t)", "nonzero"),
    "a power of a positive name": claim("inequality", {"lhs": "x**n", "relation": ">", "rhs": "0"},
                                        symbols={"x": "positive", "n": "integer"}),
}  # fmt: skip


@pytest.mark.parametrize("name", sorted(FALSE))
def test_what_holds_somewhere_is_not_confirmed(name: str) -> None:
    assert answer(FALSE[name]) != "confirmed", name


@pytest.mark.parametrize("name", sorted(TRUE))
def test_what_holds_all_over_is_confirmed(name: str) -> None:
    assert answer(TRUE[name]) == "confirmed", name


def refuted(stated: Stated, witness: dict[str, str]) -> str:
    keys, tables = stated
    data = {**of(keys, 0, **tables), "verdict": "refuted", "witness": witness}
    return check(sealed(data)).status


def test_what_is_no_period_of_H_is_not_refuted() -> None:
    """A claim that can't be made isn't false."""
    for period, expected in (("3", "not confirmed"), ("2*pi", "confirmed")):
        stated = action("p**2/2 - cos(q)", "1", branch="rotation", period=period)
        assert refuted(stated, {"E": "5"}) == expected


def test_an_integral_that_has_no_value_is_not_refuted() -> None:
    for f, expected in (("1 + 0*log(u)", "confirmed in part"), ("1", "confirmed")):
        assert refuted(integral(f, "u", "-1", "1", "3"), {}) == expected


def test_an_integral_without_an_integrand_for_these_values_is_not_refuted() -> None:
    for demand, expected in (("sqrt(1 - k*u)", "confirmed in part"), ("sqrt(1 + k**2*u**2)", "confirmed")):
        stated = integral(
            f"1 + 0*{demand}", "u", "0", "1", "sign(1 - k)", symbols={"k": "real"}
        )  # for k > 1 there is none
        assert refuted(stated, {"k": "2"}) == expected


def test_a_path_along_which_l_has_no_value_is_not_refuted() -> None:
    """Lagrange's equation fails at a time; it isn't the claim's, where L is undefined at another one."""
    for demand, expected in (("sqrt(1 - k*(t + 1))", "confirmed in part"), ("sqrt(1 + k**2*t**2)", "confirmed")):
        keys, _ = path(f"v**2/2 + 0*{demand} - q*(1 - sign(1 - k))", "t")
        assert refuted((keys, {"symbols": {"k": "real"}}), {"k": "2", "t": "-3/4"}) == expected


def test_a_limit_where_nothing_comes_is_not_refuted() -> None:
    for side, expected in (("-", "confirmed in part"), ("+", "confirmed")):
        assert refuted(limit("x**2", "0", "1", side, said="positive"), {}) == expected


IMAGE: dict[str, Any] = {"transformation": {"q": ["Q"], "p": ["Q"]}, **MAP}
"""Old variables on a line: what holds on it says nothing of the rest."""


def test_the_image_of_a_singular_map_refutes_nothing() -> None:
    free = {"hamiltonian": {"H": "p**2/2"}}
    regular = {**IMAGE, "transformation": {"q": ["Q"], "p": ["P"]}}
    for tables, expected in ((IMAGE, "rejected"), (regular, "confirmed")):
        stated = claim("conserved", {"f": "q"}, **free, **tables)
        assert refuted(stated, {"Q": "1", "P": "1"}) == expected
        assert refuted(claim("involution", {"functions": ["q", "p"]}, **tables), {"Q": "1", "P": "1"}) == expected


def test_a_scale_that_may_be_0_is_no_claim_that_fails() -> None:
    for word, expected in (("real", "confirmed in part"), ("positive", "confirmed")):
        images = {"transformation": {"Q": ["q"], "P": ["p"]}, "symbols": {"a": word}}
        stated = claim("canonical", {"scale": "a"}, **images, **MAP)
        assert refuted(stated, {"q": "1", "p": "1", "a": "2"}) == expected
