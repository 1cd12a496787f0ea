"""Gauss's integrals, and integrals with many roots or beside conditions on other names: what is shown, near misses."""

from typing import Any

import pytest

from canon.checker import alone_gauss, alone_radicands, alone_together
from tests.checker.certified import certified, resealed

NAMES = {"a": "positive", "b": "positive", "k": "real", "V": "function", "x": "real", "d": "real", "n": "nonzero"}
LINE = ("-infinity", "infinity")


def answer(f: str, ends: tuple[str, str], equals: str, by: Any, *where: str, known: str = "", **sections: Any) -> str:
    claim = {"kind": "integral", "f": f, "variable": "x", "from": ends[0], "to": ends[1], "equals": equals}
    tables = {"phase_space": {"q": ["q"], "p": ["p"]}, "symbols": NAMES, "domain": {"where": [*where]}}
    data = {"certificate": 1, "tables": {**tables, **sections, "claim": claim}, "verdict": "proved", "witness": None}
    return by.checked(resealed({**data, "cases": [{}], "known": {"antiderivative": known} if known else {}}))[0]


SHOWN = [
    ("exp(-x**2)", "sqrt(pi)"),
    ("k*exp(-a*x**2)", "k*sqrt(pi/a)"),
    ("exp(-x**2/(2*a**2))", "a*sqrt(2*pi)"),
    ("exp(-a*(x - d)**2)*cos(k*x)", "sqrt(pi/a)*exp(-k**2/(4*a))*cos(k*d)"),
    ("exp(-a*x**2 + k*x)", "sqrt(pi/a)*exp(k**2/(4*a))"),
    ("exp(-a*x**2)*exp(-b*x**2)", "sqrt(pi/(a + b))"),
    ("exp(-a*x**2)*sin(k*x)", "0"),
    ("(1 + cos(k*x))*exp(-a*x**2)", "sqrt(pi/a)*(1 + exp(-k**2/(4*a)))"),
    ("w*exp(-a*x**2)", "sqrt(pi/a)*exp(-1/(4*a))"),
    ("V(k)*exp(-a*x**2)", "V(k)*sqrt(pi)/sqrt(a)"),
]

MISSES = [
    ("exp(-x**2)", "sqrt(2*pi)"),
    ("exp(-x**2)", "-sqrt(pi)"),
    ("exp(-k*x**2)", "sqrt(pi/k)"),
    ("exp(x**2)", "sqrt(pi)"),
    ("exp(-k**2*x**2)", "sqrt(pi/k**2)"),
    ("exp(-a*x**2)*cos(k*x)", "sqrt(pi/a)*exp(-k**2/(2*a))"),
    ("exp(-a*(x - d)**2)*cos(k*x)", "sqrt(pi/a)*exp(-k**2/(4*a))*cos(k*d/2)"),
    ("exp(-a*(x - d)**2)*sin(k*x)", "0"),
    ("exp(-a*x**2 + k*x)", "sqrt(pi/a)*exp(-k**2/(4*a))"),
    ("x*exp(-a*x**2)", "0"),
    ("exp(-a*x)", "1/a"),
    ("exp(-a*x**2)/x", "0"),
    ("exp(-a*x**4)", "sqrt(pi/a)"),
    ("exp(-a*x**2)*V(x)", "V(0)*sqrt(pi/a)"),
    ("cos(x)", "0"),
    ("exp(-a*x**2)*cos(x**2)", "sqrt(pi/a)"),
    ("exp(-a*x**2)*cos(k*x)**2", "sqrt(pi/a)"),
    ("exp(-x**2*x**2)", "sqrt(pi)"),
    ("exp(-a*x**2) + 1", "sqrt(pi/a)"),
    ("1/exp(-a*x**2)", "sqrt(pi/a)"),
    ("exp(-a*x**2)*exp(b*x**2)", "sqrt(pi/(a - b))"),
    ("exp(-sqrt(x**4))", "sqrt(pi)"),
    ("exp(-x**2/x)", "0"),
    ("exp(-a*x**2)", "x"),
    ("w*exp(-a*x**2)", "sqrt(pi/a)"),
    ("exp(-abs(a)*x**2)", "sqrt(pi/a)"),
    ("exp(-a*x**2 + exp(x))", "sqrt(pi/a)"),
    ("exp(-a*q**2)", "sqrt(pi/a)"),
    ("log(-1)*0*exp(-a*x**2)", "1"),
    ("exp(-a*x**2)*D(x**2, x)", "0"),
    ("exp(-a*x**2)/0", "0"),
]


@pytest.mark.parametrize("given", SHOWN)
def test_gausss_integral_is_shown(given: Any) -> None:
    assert answer(given[0], LINE, given[1], alone_gauss, definitions={"w": "cos(x)"}) == "shown"


@pytest.mark.parametrize("given", MISSES)
def test_another_value_or_form_is_not(given: Any) -> None:
    assert answer(given[0], LINE, given[1], alone_gauss, definitions={"w": "cos(x)"}) == "not shown"


def test_it_is_about_all_of_the_line() -> None:
    f, value = "exp(-a*x**2)", "sqrt(pi/a)"
    for ends in (
        ("infinity", "-infinity"),
        ("0", "infinity"),
        ("-infinity", "0"),
        ("-1", "1"),
        ("infinity", "infinity"),
    ):
        assert answer(f, ends, value, alone_gauss) == "not shown"
    assert answer(f, LINE, value, alone_gauss, symbols={**NAMES, "x": "positive"}) == "not shown"
    assert answer(f, LINE, value, alone_gauss, "x > 0") == "not shown"
    assert answer(f, LINE, value, alone_gauss, "d > 0") == "shown"
    assert answer("exp(-k*x**2)", LINE, "sqrt(pi/k)", alone_gauss, "k >= 0") == "not shown"
    assert answer("exp(-a*x**2)", LINE, value, alone_gauss, hamiltonian={"H": "x"}) == "not shown"


ROOTS = ("sqrt(a*b/(2*d))*sqrt(x/(b - x))", "sqrt(a*b/(2*d))*(b/2*acos(1 - 2*x/b) - sqrt(x*(b - x)))")


def test_products_of_what_is_positive_are_squares() -> None:
    names = {"symbols": {**NAMES, "d": "positive"}}
    f, known = ROOTS
    assert answer(f, ("0", "b"), "pi*sqrt(a*b**3/(8*d))", alone_radicands, known=known, **names) == "shown"
    for ends, value in ((("0", "b"), "pi*sqrt(a*b**3/(4*d))"), (("0", "b/2"), "pi*sqrt(a*b**3/(8*d))"),
                        (("b", "0"), "pi*sqrt(a*b**3/(8*d))"), (("-b", "b"), "pi*sqrt(a*b**3/(8*d))"),
                        (("0", "2*b"), "pi*sqrt(a*b**3/(8*d))"), (("0", "b"), "-pi*sqrt(a*b**3/(8*d))")):  # fmt: skip
        assert answer(f, ends, value, alone_radicands, known=known, **names) == "not shown"
    jumps = known + " + (b - 2*x)/sqrt((b - 2*x)**2)"
    assert answer(f, ("0", "b"), "pi*sqrt(a*b**3/(8*d))", alone_radicands, known=jumps, **names) == "not shown"


def test_signs_of_roots_are_still_tried() -> None:
    """√((x − 2)²) is x − 2 beyond 2 alone, and √(29²) is 29 modulo half of the primes."""
    for f, known, value in (("sqrt((x - 2)**2)", "x**2/2 - 2*x", "-3/2"), ("sqrt(29**2*x**2)/x", "-29*x", "-29"),
                            ("sqrt(k**2)", "k*x", "k"), ("sqrt((a - b)**2)", "(a - b)*x", "a - b")):  # fmt: skip
        assert answer(f, ("0", "1"), value, alone_radicands, known=known) == "not shown"
    assert answer("sqrt(a**2*x**2)", ("0", "1"), "a/2", alone_radicands, known="a*x**2/2") == "shown"


def test_conditions_on_other_names_are_left_out() -> None:
    where = ("0 < d < pi/2", "0 < q < 1", "k > 0", "p > 0", "k < 1")
    given = ("1/sqrt(2*a*x)", ("0", "b"), "sqrt(2*b/a)", alone_radicands)
    assert answer(*given, *where, known="sqrt(2)*sqrt(x)/sqrt(a)") == "shown"
    assert answer("k/sqrt(k**2)", ("0", "1"), "1", alone_radicands, *where, known="x*k/sqrt(k**2)") == "shown"
    assert (
        answer("w/sqrt(w**2)", ("0", "1"), "1", alone_radicands, *where, known="x", definitions={"w": "k"}) == "shown"
    )
    assert (
        answer("d/sqrt(d**2)", ("0", "1"), "1", alone_radicands, "u > 0", known="x", definitions={"u": "d"}) == "shown"
    )
    assert (
        answer("d/sqrt(d**2)", ("0", "1"), "1", alone_radicands, "u > 0", known="x", definitions={"u": "k"})
        == "not shown"
    )


def test_it_is_asked_of_a_certificate() -> None:
    text = '[phase_space]\nq = ["q"]\np = ["p"]\n[symbols]\na = "positive"\n'
    claim = "kind = 'integral'\nvariable = 'x'\nf = 'exp(-a*x**2)'\nfrom = '-infinity'\nto = 'infinity'\n"
    data = certified(text, claim + "equals = 'sqrt(pi/a)'")
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["symbols"]["a"] = "nonzero"
    assert alone_together.checked(resealed(data))[0] == "not shown"
