"""Which angle, which root, which sign is meant: rules that hold on a domain, each beside what they mustn't see."""

from typing import Any

import pytest

from canon.checker.followed import at_random, is_identity, without_surface
from canon.checker.kinds import obligations
from canon.checker.signs import Signs
from canon.checker.statement import Statement

SPACE = {"q": ["q", "x", "y"], "p": ["p", "px", "py"]}
SYMBOLS = {"a": "real", "b": "real", "u": "real", "v": "real", "m": "positive", "k": "real", "r": "positive"}
ATAN2 = ("atan2(y, x)", "asin(y/sqrt(x**2 + y**2))")
NEXT, HALF = ("asin(sin(q))", "pi - q"), ("sin(atan2(b, a)/2)*cos(atan2(b, a)/2)", "b/(2*sqrt(a**2 + b**2))")
ADDED = ("1/sqrt(1 - ((u + v)/(1 + u*v))**2)", "(1 + u*v)/(sqrt(1 - u**2)*sqrt(1 - v**2))")
SN, CN = "sqrt(1 - jacobi_sn(u, m)**2)", "jacobi_cn(u, m)"
TRUE = [
    (*ATAN2, ["x > 0"]),
    ("atan2(y, x)", "atan(y/x)", ["x > 0"]),
    (*NEXT, ["pi/2 < q < 3*pi/2"]),
    ("acos(cos(q))", "2*pi - q", ["pi < q < 2*pi"]),
    ("acos(cos(q))", "q", ["0 < q < pi"]),
    ("atan(tan(q))", "q - pi", ["pi/2 < q < 3*pi/2"]),
    (*HALF, ["b > 0"]),
    (*ADDED, []),
    (SN, CN, [f"{CN} > 0"]),
    ("tan(acos(k/sqrt(1 + k**2)))", "1/k", []),
]
FALSE = [
    (*ATAN2, []),
    (*ATAN2, ["x < 0"]),
    (ATAN2[0], f"-{ATAN2[1]}", ["x > 0"]),
    (ATAN2[0], "asin(1001*y/(1000*sqrt(x**2 + y**2)))", ["x > 0"]),
    ("atan2(y, x)", "atan(y/x)", []),
    (*NEXT, ["pi/2 < q < 5*pi/2"]),
    (*NEXT, ["1499*pi/1000 < q < 1501*pi/1000"]),
    ("asin(sin(q))", "pi - 1001*q/1000", ["pi/2 < q < 3*pi/2"]),
    ("asin(sin(q))", "q - pi", ["pi/2 < q < 3*pi/2"]),
    ("asin(sin(q))", "3*pi - q", ["pi/2 < q < 3*pi/2"]),
    ("acos(cos(q))", "q", ["pi < q < 2*pi"]),
    ("atan(tan(q))", "q", ["pi/2 < q < 3*pi/2"]),
    ("sin(atan2(-b**2, a)/2)", "-sqrt((1 - a/sqrt(a**2 + b**4))/2)", []),  # not so for b = 0 and a < 0
    (HALF[0], f"-{HALF[1]}", ["b > 0"]),
    ("cos(atan2(b, a)/2)", "-sqrt((1 + a/sqrt(a**2 + b**2))/2)", ["b > 0"]),
    (ADDED[0], ADDED[1].replace("1 + u*v", "1 - u*v"), []),
    (ADDED[0], f"-{ADDED[1]}", []),
    (SN, CN, []),
    (SN, CN, ["jacobi_sn(u, m) > 0"]),
    (SN, CN, ["jacobi_cn(u, 2*m) > 0"]),
    (SN, f"-{CN}", [f"{CN} > 0"]),
]  # fmt: skip
ENDS = ["r < sqrt(1 + k**2) - k"]
HOLD = [
    ("1 - r**2 - 2*k*r", ENDS),
    ("sqrt(1 + k**2) + k + r", []),
    ("1 + u*v", ["u**2 < 1", "v**2 < 1"]),
    ("3 - u - v", ["u**2 < 1", "v**2 < 1"]),
]
FAIL = [
    ("999/1000 - r**2 - 2*k*r", ENDS),
    ("1 - r**2 - 1001*k*r/500", ENDS),
    ("1 - r**2 - 2*k*r", ["r < sqrt(1 + k**2) + k"]),
    ("r**2 + 2*k*r - 1", ENDS),
    ("sqrt(1 + k**2) + 1001*k/1000 + r", []),
    ("999/1000 + u*v", ["u**2 < 1", "v**2 < 1"]),
    ("1 + u*v", ["u**2 < 1", "v**2 < 2"]),
    ("1 + u*v", ["u**2 < 1"]),
    ("1999/1000 - u - v", ["u**2 < 1", "v**2 < 1"]),
]


def said(where: list[str], lhs: str = "0", rhs: str = "0", **tables: Any) -> Statement:
    claim = {"kind": "identity", "lhs": lhs, "rhs": rhs}
    own = {"phase_space": SPACE, "symbols": SYMBOLS, "domain": {"where": where}, "claim": claim}
    return Statement({**own, **tables}, {}, "proved")


def is_seen(lhs: str, rhs: str, where: list[str]) -> bool:
    s = said(where, lhs, rhs)
    (case,) = [obligations(s)][0]
    return is_identity(at_random(s), case.zeros[0])


@pytest.mark.parametrize("claim", TRUE, ids=str)
def test_what_holds_on_the_domain_is_seen(claim: tuple[str, str, list[str]]) -> None:
    assert is_seen(*claim)


@pytest.mark.parametrize("claim", FALSE, ids=str)
def test_what_does_not_hold_throughout_is_not(claim: tuple[str, str, list[str]]) -> None:
    assert not is_seen(*claim)


@pytest.mark.parametrize("claim", HOLD, ids=str)
def test_signs_by_conjugates_and_between_ends(claim: tuple[str, list[str]]) -> None:
    s = said(claim[1])
    assert Signs(s).is_positive(s.f.read(claim[0], s.names), strict=True)


@pytest.mark.parametrize("claim", FAIL, ids=str)
def test_no_sign_where_there_is_none(claim: tuple[str, list[str]]) -> None:
    s = said(claim[1])
    assert not Signs(s).is_positive(s.f.read(claim[0], s.names), strict=True)


def test_dn_has_a_sign_only_below_1() -> None:
    for where, positive in ((["0 < k < 1"], True), (["0 < k < 1001/1000"], False), (["k > 1"], False)):
        values = at_random(said(where))
        values.kernel("g1", values.f.read("jacobi_dn(u, k)", {}))
        assert ("positive" in values.roots.words["g1"]) == positive


def test_a_name_that_a_surface_gives() -> None:
    for on, seen in (("q - a*sqrt(1 + x**2)", True), ("q - a*x", True), ("q**2 - a*x", False), ("q*p - x*a", False)):
        s = said([], domain={"on": [on]})
        assert (without_surface(s, s.f.read("a*q", {})) is not None) == seen
    s = said([], domain={"on": ["q - a*sqrt(1 + x**2)"]})
    for text, seen in (("a - q/sqrt(1 + x**2)", True), ("a - 1001*q/(1000*sqrt(1 + x**2))", False)):
        assert is_identity(at_random(s), without_surface(s, s.f.read(text, {})) or 1) == seen
