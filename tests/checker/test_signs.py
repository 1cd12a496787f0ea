"""Inequalities that the checker sees to hold throughout a domain, and mutants of them that don't."""

import random
from typing import Any

import pytest

from canon.checker.points import Numbers, Outside
from canon.checker.positive import is_positive
from canon.checker.statement import Statement

SYMBOLS = {
    "a": "positive", "b": "positive", "c": "positive", "e": "nonnegative", "u": "real", "v": "real", "w": "real",
    "be": "real", "V": "function",
}  # fmt: skip
WHERE = ["a < b", "e < 1", "be**2 < 1", "a*c > u**2", "-b < w < b"]
HOLD = {
    "u**2 - 2*u*v + v**2": False,
    "u**2 + u*v + v**2": False,
    "a*v**2 + 2*u*v*w + c*w**2": False,
    "b - a": True,
    "(b - a)*(b + a)*c": True,
    "1/sqrt(1 - be**2) - 1": False,
    "1 - sqrt(1 - be**2)": False,
    "(sqrt(1 - be**2) - 1)/(1 + a) + 1": True,
    "c/sqrt(1 - w**2/b**2) - c": False,
    "1 - e*cos(v)": True,
    "(a + b)*cos(v)**2 + b*sin(v)**2 - b": False,
    "exp(u)*sqrt(a)/c": True,
    "V(u)**2": False,
    "sqrt(a + c) - sqrt(a)": True,
    "(sqrt(u**2) + u)*v**2 + sqrt(u**2) - u": False,
    "u**4 - 2*u**2*v**2 + v**4 + a*v**2": False,
}
FAIL = {
    "u**2 - 2*u*v + v**2": True,
    "u**2 - 2001/1000*u*v + v**2": False,
    "u**2 + 3*u*v + v**2": False,
    "a*v**2 + 2*u*v + c*999/1000": False,
    "b - 1001/1000*a": False,
    "1/sqrt(1 - be**2) - 1001/1000": False,
    "1 - 1001/1000*sqrt(1 - be**2)": False,
    "999/1000 - e*cos(v)": False,
    "1 - e - e*cos(v)": False,
    "(a + b)*cos(v)**2 + b*sin(v)**2 - b": True,
    "V(u)": False,
    "u*exp(u)": False,
    "sqrt(a + c) - sqrt(a) - c/1000": False,
    "u**3": False,
    "(sqrt(u**2) - u)*v**2 - u": False,
    "-u**2": False,
}


def statement(symbols: dict[str, Any] | None = None) -> Statement:
    claim = {"kind": "identity", "lhs": "0", "rhs": "0"}
    tables = {"phase_space": {"q": [], "p": []}, "symbols": symbols or SYMBOLS, "claim": claim}
    return Statement({**tables, "domain": {"where": [] if symbols else WHERE}}, {}, "proved")


@pytest.mark.parametrize("text", sorted(HOLD))
def test_what_has_a_sign(text: str) -> None:
    s = statement()
    assert is_positive(s, s.f.read(text, {}), strict=HOLD[text], real=True)


@pytest.mark.parametrize("text", sorted(FAIL))
def test_what_has_none(text: str) -> None:
    s = statement()
    assert not is_positive(s, s.f.read(text, {}), strict=FAIL[text], real=True)


def test_a_condition_with_a_root_of_a_fraction() -> None:
    claim = {"kind": "identity", "lhs": "0", "rhs": "0"}
    tables = {"phase_space": {"q": [], "p": []}, "symbols": SYMBOLS, "claim": claim}
    s = Statement({**tables, "domain": {"where": ["u > sqrt(a/b)"]}}, {}, "proved")
    assert is_positive(s, s.f.read("u - sqrt(a/b)", {}), strict=True, real=True)
    assert not is_positive(s, s.f.read("u - 1001/1000*sqrt(a/b)", {}), strict=False, real=True)


def test_no_number_contradicts_a_sign() -> None:
    """Random sums of products: what is called nowhere negative is so at random points."""
    rng, symbols, called = random.Random(7), {"a": "positive", "u": "real", "v": "real"}, 0
    numbers = Numbers(20)
    for _ in range(150):
        terms = (
            f"{rng.randint(-2, 4)}*{rng.choice(('a', '1', 'sqrt(a)', 'cos(u)', 'u', 'u**2'))}"
            f"*{rng.choice(('v', 'v**2', '1', 'sin(u)', 'a', 'sqrt(a + 1)'))}"
            for _ in range(rng.randint(2, 4))
        )
        s = statement(symbols)
        target = s.f.read(" + ".join(terms), {})
        if not is_positive(s, target, strict=False, real=True):
            continue
        called += 1
        for _ in range(40):
            of = {"a": numbers.mp.mpf(rng.expovariate(0.7)), **{n: numbers.mp.mpf(rng.gauss(0, 2)) for n in "uv"}}
            try:
                assert numbers.values(s.f, [target], of)[target] >= 0, s.f.text(target)
            except Outside:
                continue
    assert called > 10
