"""Inequalities by what is seen to be positive: what is shown, near misses, and what isn't so at a single point."""

from typing import Any

import pytest

from canon.checker import alone_signs, alone_together
from tests.checker.certified import certified, resealed

PLANE: Any = {"phase_space": {"q": ["x", "y"], "p": ["px", "py"]}}
NAMES = {
    "m": "positive",
    "k": "positive",
    "a": "positive",
    "b": "positive",
    "V": "function",
    "W": ["function", "positive"],
}


def answer(claim: str, *where: str, **symbols: Any) -> str:
    """The answer about an inequality, whatever its certificate says."""
    lhs, relation, rhs = next(claim.partition(word) for word in (" <= ", " >= ", " < ", " > ") if word in claim)
    tables = {**PLANE, "symbols": {**NAMES, **symbols}, "domain": {"where": [*where]},
              "claim": {"kind": "inequality", "lhs": lhs, "relation": relation.strip(), "rhs": rhs}}  # fmt: skip
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": [{}]}
    return alone_signs.checked(resealed(data))[0]


SHOWN = [
    ("m/k > 0",), ("m*k/(m + k) < m",), ("x**2 >= 0",), ("exp(x) > 0",), ("m*x**2 + V(y) >= V(y)",),
    ("W(x) + x**2 > 0",), ("x**2 + y**2 >= 2*x*y",), ("m*x**2 + 2*x*y + y**2/m >= 0",), ("x**2 + x + 1 > 0",),
    ("x**2 + x*y + y**2 >= 0",), ("sqrt(m*k) <= (m + k)/2",), ("sqrt(1 + x**2) > x",), ("sqrt(m**2 + k**2) < m + k",),
    ("sqrt(a**2 + b) > a",), ("cos(x) <= 1",), ("sin(x)**2 < 1001/1000",), ("cos(x) > -1001/1000",),
    ("1/sqrt(1 - x**2) >= 1", "x**2 < 1"), ("a - b > 0", "a > b"), ("a**2 > b**2", "b < a"),
    ("a*m > b*k", "b < a", "k < m"), ("x*y > 0", "1 < x < 2", "0 < y < 3"),
    ("a*x**2 + 2*b*x*y + k*y**2 >= 0", "a*k > b**2"), ("x > y + 1", "x - y > 2"), ("pi > 3",),
    ("sqrt(2) + sqrt(3) > 3.146",), ("acos(-1/3) < 1.9107",), ("exp(1) < 2.7183",), ("cos(pi/2) < 1",),
    ("sqrt(x) + m > 0",), ("(x**2 + 1)**(-1/3) > 0",),
]  # fmt: skip


@pytest.mark.parametrize("given", SHOWN)
def test_what_is_positive_is_seen(given: Any) -> None:
    assert answer(*given) == "shown"


MISSES = [
    ("m/k > 1/1000",), ("m*k/(m + k) < m - 1/1000",), ("x**2 > 0",), ("exp(x) > 1/1000",), ("V(y) > 0",),
    ("W(x) + x**3 > 0",), ("x**2 + y**2 > 2*x*y",), ("x**2 + y**2 >= 2001/1000*x*y",),
    ("m*x**2 + 2*x*y + 999/1000*y**2/m >= 0",), ("x**2 + 2001/1000*x + 1 >= 0",), ("sqrt(m*k) < (m + k)/2",),
    ("sqrt(m*k) >= (m + k)/2",), ("sqrt(1 + x**2) > 1",), ("sqrt(x**2) > x",),
    ("sqrt(m**2 + k**2) < 999/1000*(m + k)",), ("cos(x) < 1",), ("cos(x) > -1",), ("sin(x) > -1",),
    ("cos(x)**2 < 1",), ("cos(x) + cos(y) > -2",), ("cos(x) >= -999/1000",), ("m*cos(x)**2 + k*sin(x)**2 > m/1000",),
    ("1/sqrt(1 - x**2) > 1", "x**2 < 1"), ("a - b > 0", "a >= b"), ("a > b", "a*b > 0"), ("a**2 > b**2", "b < x"),
    ("x*y > 2", "1 < x < 2", "0 < y < 3"), ("x*y > 0", "-1 < x < 2", "0 < y < 3"), ("x**2 < y**2", "x < y"),
    ("a*x**2 + 2*b*x*y + k*y**2 > 0", "a*k > b**2"), ("a*x**2 + 2*b*x*y + k*y**2 >= 0", "a*k > b**2 - 1/1000"),
    ("x > y + 1", "x - y > 999/1000"), ("pi > 3.1416",), ("sqrt(2) + sqrt(3) > 3.1463",), ("acos(-1/3) < 1.9106",),
    ("x - x > 0",), ("0*x > 0",), ("x**3 + 1 > 0",), ("x >= 0",), ("D(V(x), x) >= 0",), ("D(W(x), x) > 0",),
    ("px < m",), ("cos(sqrt(4)*pi/2) > -1",), ("x**2 + y**2 > 0",), ("x**4 - x**2*y**2 + y**4 > 0",),
    ("(x - 1)**2*(x + 2) >= 0",), ("log(m) > 0",), ("m**x > 0*m**x + 1",), ("sqrt(x**2) >= 1/1000",),
    ("sqrt(sqrt(x**4)) > 1/1000",), ("1/x > 0",),
]  # fmt: skip


@pytest.mark.parametrize("given", MISSES)
def test_what_is_false_somewhere_is_not_shown(given: Any) -> None:
    assert answer(*given) == "not shown"


@pytest.mark.parametrize(
    "symbols", [{"m": "nonnegative"}, {"m": "nonzero"}, {"m": "real"}, {"m": "integer"}, {"m": "function"}]
)
def test_what_may_be_0_or_negative_is_not_positive(symbols: Any) -> None:
    assert answer("m > 0", **symbols) == "not shown"


@pytest.mark.parametrize(
    "given", [("m > -1", "m = 1"), ("m == m",), ("m > k > 0",), ("m > 0", "m != 1 > 0"), ("1j*m > 0",)]
)
def test_what_is_no_inequality_is_not_read(given: Any) -> None:
    claim, *where = given
    assert answer(claim if " > " in claim else "m > " + claim, *where) != "wrong"
    tables = {**PLANE, "symbols": NAMES, "claim": {"kind": "inequality", "lhs": "m", "relation": "!=", "rhs": "0"}}
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": [{}]}
    assert alone_signs.checked(resealed(data))[0] == "not shown"


def test_nobody_waits_for_a_sign() -> None:
    long = " + ".join(f"x**{n}*y**{20 - n}*px**{n % 7}" for n in range(20))
    assert answer(f"({long})**12 + x*y*px > 0") == "not shown"
    assert (
        answer(" + ".join(f"sqrt({n} + sqrt({n + 1} + x**{n % 3} * y))" for n in range(12)) + " - x - y > 0")
        == "not shown"
    )


def test_a_certificate_is_asked_for_its_checksum() -> None:
    text = '[phase_space]\nq = ["q"]\np = ["p"]\n[symbols]\nm = "positive"\n'
    data = certified(text, "kind = 'inequality'\nlhs = 'm*q**2'\nrelation = '>='\nrhs = '0'")
    assert alone_together.checked(data) == alone_signs.checked(data) == ("shown", "")
    assert alone_together.checked({**data, "method": "by hand"})[0] == "wrong"
    assert alone_signs.checked(resealed({**data, "verdict": "refuted"}))[0] == "not shown"
