"""Dimensions: how formulas change with the units."""

import pytest

from canon.errors import InputError

SYMBOLS = 'm = "positive"\ng = "positive"\nk = "positive"\nR = "positive"\nV = "function"\nE0 = "real"'
TABLE = '{q = "L", p = "M*L/T", m = "M", g = "L/T**2", k = "M/T**2", R = "L", V = ["M*L**2/T**2", "L"], t = "T"}'


def _claim(function: str, equals: str, table: str = TABLE, more: str = "") -> str:
    return f'kind = "dimension"\nfunctions = ["{function}"]\ndimensions = {table}\nequals = "{equals}"\n{more}'


@pytest.mark.parametrize(
    ("function", "equals", "expected"),
    [
        ("p**2/(2*m) + m*g*q + k*q**2/2 + V(q)", "M*L**2/T**2", "proved"),
        ("p**2/(2*m) + m*g*q**2", "M*L**2/T**2", "refuted"),
        ("p**2/(2*m)", "M*L/T**2", "refuted"),
        ("2*pi*sqrt(R/g)*(1 + sin(q/R)**2/4)", "T", "proved"),
        ("2*pi*sqrt(R/g)*(1 + sin(q)**2/4)", "T", "refuted"),
        ("q*D(V(q), q) + V(q)", "M*L**2/T**2", "proved"),
        ("D(V(q), q)", "M*L**2/T**2", "refuted"),
        ("V(q**2/R)", "M*L**2/T**2", "proved"),
        ("V(q**2)", "M*L**2/T**2", "refuted"),
        ("V(q + t)", "M*L**2/T**2", "refuted"),
        ("log(abs(q)/R)", "1", "proved"),
        ("log(abs(q)) - log(R)", "1", "proved"),
        ("log(abs(q))", "1", "refuted"),
        ("cbrt(m*g*t*R)**2", "M**(2/3)*L**(4/3)/T**(2/3)", "proved"),
        ("cbrt(m*g*t*R)**2", "M**(2/3)*L**(4/3)/T**(1/3)", "refuted"),
    ],
)
def test_dimensions(status, function, equals, expected):
    domain = 'where = ["q > 0", "t > 0"]'
    assert status(_claim(function, equals), symbols=SYMBOLS, domain=domain) == expected


@pytest.mark.parametrize("function", ["1j*q", "1j**1j", "q*sqrt(1j)"])
def test_a_value_that_is_complex_is_no_error(ask, function):
    (verdict,) = ask(_claim(function, "L**2"), symbols=SYMBOLS, domain='where = ["q > 0"]')
    assert verdict.status == "refuted"
    assert "note" not in verdict.detail


def test_the_answer_names_the_dimension(ask):
    (verdict,) = ask(_claim("2*pi*sqrt(R/g)", "L"), symbols=SYMBOLS)
    assert verdict.detail["dimensions"] == ["T"]
    (verdict,) = ask(_claim("m*g*cbrt(R)", "L"), symbols=SYMBOLS)
    assert verdict.detail["dimensions"] == ["L**(4/3)*M*T**(-2)"]


@pytest.mark.parametrize(
    ("function", "equals", "domain", "expected"),
    [
        ("sign(q - 1)", "1", "", "refuted"),  # the slope of it is 0, and its value another one in other units
        ("q*sign(q - 1)", "L", "", "refuted"),
        ("atan(tan(q)) - q", "1", "", "refuted"),
        ("sign(V(q) - 1)", "1", "", "refuted"),
        ("q*sign(q - 1)", "L", 'where = ["q > 1"]', "proved"),
        ("V(q)*sqrt(q - 1)/sqrt(q - 1)", "M*L**2/T**2", "", "proved"),
        ("q*sign(q - R)", "L", "", "proved"),
        ("(q - 1)**2", "M", 'on = ["q - 1"]', "undecided"),
        ("q + R", "L", 'on = ["q - R"]', "proved"),
    ],
)
def test_units_that_change_by_any_factor(status, function, equals, domain, expected):
    assert status(_claim(function, equals), symbols=SYMBOLS, domain=domain) == expected


@pytest.mark.parametrize(
    ("sections", "expected"),
    [
        ({"symbols": 'Q = "positive"', "transformation": 'Q = ["q - 1"]\nP = ["p"]'}, "undecided"),
        ({"transformation": 'q = ["1 + exp(Q)"]\np = ["P*exp(-Q)"]'}, "undecided"),
        ({"transformation": 'Q = ["log(q - 1)"]\nP = ["p*(q - 1)"]'}, "proved"),
        ({"transformation": 'Q = ["q - 1"]\nP = ["p"]'}, "refuted"),
    ],
)
def test_other_units_beside_a_map(status, sections, expected):
    """q sign(q - 1) is a length where the map says that q > 1."""
    assert status(_claim("q*sign(q - 1)", "L", '{q = "L"}'), **sections) == expected


def test_bases_of_ones_own(status):
    claim = _claim("q/R", "m/ft", '{q = "m", R = "ft"}', 'base = ["m", "ft"]')
    assert status(claim, symbols=SYMBOLS) == "proved"


@pytest.mark.parametrize(
    ("function", "equals", "table", "message"),
    [
        ("q", "L + T", '{q = "L"}', "product of rational powers"),
        ("q", "l", '{q = "L"}', "'l'"),
        ("q", "L", '{qq = "L"}', "qq"),
        ("V(q)", "L", '{V = "L"}', "a list"),
        ("V(q)", "L", '{V = ["L"]}', "1 arguments"),
        ("q", "L", '{q = ["L"]}', "a dimension"),
    ],
)
def test_faults(ask, function, equals, table, message):
    with pytest.raises((InputError, AssertionError), match=message):
        ask(_claim(function, equals, table), symbols=SYMBOLS)
