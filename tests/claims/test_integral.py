"""Definite integrals: exact by an antiderivative, else enclosed."""

import pytest

from canon.errors import InputError

SYMBOLS = "\n".join([f'{x} = "positive"' for x in ("a", "b", "m", "w", "R", "A", "E0", "r")])
SYMBOLS += '\nV = "function"\nk = "real"\nn = "integer"'


def _claim(f: str, x: str, low: str, high: str, equals: str, F: str = "") -> str:
    more = f'\nantiderivative = "{F}"' if F else ""
    return f'kind = "integral"\nf = "{f}"\nvariable = "{x}"\nfrom = "{low}"\nto = "{high}"\nequals = "{equals}"{more}'


@pytest.mark.parametrize(
    ("f", "x", "low", "high", "equals", "expected"),
    [
        ("q**2", "q", "0", "1", "1/3", "proved"),
        ("q**2", "q", "0", "1", "334/1000", "refuted"),
        ("1/(1 + q**2)", "q", "-infinity", "infinity", "pi", "proved"),
        ("1/(1 + q**2)", "q", "-infinity", "infinity", "2*pi", "refuted"),
        ("exp(-a*q)", "q", "0", "infinity", "1/a", "proved"),
        ("exp(-k*q)", "q", "0", "infinity", "1/k", "undecided"),  # it diverges for k <= 0
        ("1/sqrt(1 - q**2)", "q", "-1", "1", "pi", "proved"),  # improper at both ends
        ("1/sqrt(q*(2*a - q))", "q", "0", "2*a", "pi", "proved"),
        ("1/q", "q", "0", "1", "0", "refuted"),  # divergent
        ("1/q**2", "q", "-1", "1", "-2", "undecided"),  # F(1) - F(-1), but a pole between
        ("log(q)", "q", "0", "1", "-1", "proved"),
        ("sqrt(2*m*(E0 - m*w**2*q**2/2))", "q", "-sqrt(2*E0/m)/w", "sqrt(2*E0/m)/w", "pi*E0/w", "proved"),
        ("sqrt(2*m*(E0 - m*w**2*q**2/2))", "q", "-sqrt(2*E0/m)/w", "sqrt(2*E0/m)/w", "E0/w", "refuted"),
        ("m*A**2*w**2*sin(w*t)**2/2", "t", "0", "2*pi/w", "pi*m*A**2*w/2", "proved"),
        ("k*q**3", "q", "0", "b", "k*b**4/4", "proved"),
        ("k*q**3", "q", "0", "b", "a*b**4/4", "refuted"),
        ("exp(-q**2)", "q", "0", "1", "sqrt(pi)/2", "refuted"),  # by certified quadrature
        ("1/(2 + cos(q))", "q", "0", "2*pi", "2*pi/sqrt(3)", "proved"),
        ("1/(2 + cos(q))", "q", "0", "2*pi", "2*pi/sqrt(3) + 1e-9", "refuted"),
        ("1/(a**2*cos(q)**2 + b**2*sin(q)**2)", "q", "0", "2*pi", "2*pi/(a*b)", "proved"),
        ("1/(a**2*cos(q)**2 + b**2*sin(q)**2)", "q", "0", "2*pi", "pi/(a*b)", "refuted"),
        ("1/cosh(q)**2", "q", "-infinity", "infinity", "2", "proved"),
        ("exp(-a*q)*cos(w*q)", "q", "0", "infinity", "a/(a**2 + w**2)", "proved"),
        ("exp(-a*q)*cos(w*q)", "q", "0", "infinity", "w/(a**2 + w**2)", "refuted"),
        ("1/(1 + q**4)", "q", "0", "infinity", "pi/(2*sqrt(2))", "proved"),
        ("1/(1 + q**3)", "q", "0", "infinity", "2*pi/(3*sqrt(3))", "proved"),  # with atan(sqrt(3)/3) in it
        ("1/(q*sqrt(q**2 - 1))", "q", "1", "infinity", "pi/2", "proved"),
        ("V(q)*D(V(q), q)", "q", "0", "1", "(V(1)**2 - V(0)**2)/2", "proved"),
        ("V(q)*D(V(q), q)", "q", "0", "1", "V(1)**2 - V(0)**2", "refuted"),
        ("1/sqrt(1 - r**2)", "r", "0", "1", "pi/2", "proved"),
        ("1/sqrt(1 - sin(q)**2/3)", "q", "0", "pi/2", "elliptic_k(1/3)", "proved"),
        ("1/sqrt(1 - sin(q)**2/3)", "q", "0", "pi/2", "elliptic_k(1/3) + 1e-12", "refuted"),
        ("sqrt(1 + a*sin(q)**2)", "q", "0", "pi/2", "elliptic_e(-a)", "proved"),
        ("1/sqrt(1 - k**2*sin(q)**2)", "q", "0", "pi/2", "elliptic_k(k**2)", "supported"),  # it has k**2 < 1
    ],
)
def test_integrals(status, f, x, low, high, equals, expected):
    assert status(_claim(f, x, low, high, equals), symbols=SYMBOLS) == expected


@pytest.mark.parametrize(
    ("f", "low", "equals", "expected"),
    [
        ("exp(-q**2)", "-infinity", "sqrt(pi)", "proved"),
        ("exp(-q**2)", "-infinity", "sqrt(pi) + 1e-12", "refuted"),
        ("exp(-a*q**2 + b*q)", "-infinity", "sqrt(pi/a)*exp(b**2/(4*a))", "proved"),
        ("exp(-a*q**2 + b*q)", "-infinity", "sqrt(pi/a)*exp(b**2/(2*a))", "refuted"),
        ("exp(-a*q**2)*cos(w*q)", "-infinity", "sqrt(pi/a)*exp(-w**2/(4*a))", "proved"),
        ("q*exp(-a*q**2)*sin(w*q)", "-infinity", "w/(2*a)*sqrt(pi/a)*exp(-w**2/(4*a))", "proved"),
        ("q**4*exp(-a*q**2)", "0", "3*sqrt(pi)/(8*a**2*sqrt(a))", "proved"),
        ("q**4*exp(-a*q**2)", "0", "3*sqrt(pi)/(4*a**2*sqrt(a))", "refuted"),  # over all q
        ("exp(-k*q**2)", "-infinity", "sqrt(pi)", "refuted"),  # at k > 0; for others there is none
        ("exp(a*q**2)", "-infinity", "1", "undecided"),
        ("1/(1 + exp(k*q))", "0", "log(2)/k", "undecided"),  # it diverges for k < 0
        ("exp(-q**2)", "1", "sqrt(pi)/2", "refuted"),  # a tail is bounded
        ("1/cosh(q)", "-infinity", "pi", "proved"),
        ("cos(w*q)/cosh(q)", "-infinity", "pi/sinh(pi*w/2)", "refuted"),
        ("1/(1 + q**4)", "0", "pi/(2*sqrt(2))", "proved"),
        ("1/(1 + q**4)", "0", "pi/(2*sqrt(2)) + 1e-12", "refuted"),
        ("1/sqrt(1 + q**2)", "0", "100", "refuted"),  # by its antiderivative, which grows
        ("sin(q)/q", "1", "0.6247", "undecided"),  # its tail has no bound but by cancellation
        ("sin(q)/q**3", "1", "0.378530017", "supported"),
        ("sin(q)/q**3", "1", "0.3786", "refuted"),
    ],
)
def test_over_infinite_ranges(status, f, low, equals, expected):
    assert status(_claim(f, "q", low, "infinity", equals), symbols=SYMBOLS) == expected


@pytest.mark.parametrize(
    ("F", "expected"),
    [
        ("2/sqrt(3)*atan(tan(q/2)/sqrt(3))", "undecided"),  # it jumps at pi
        ("q/sqrt(3) - 2/sqrt(3)*atan(sin(q)/(2 + sqrt(3) + cos(q)))", "proved"),
    ],
)
def test_an_antiderivative_must_be_smooth_inside(status, F, expected):
    value = "2*pi/sqrt(3)" if expected == "proved" else "0"
    found = status(_claim("1/(2 + cos(q))", "q", "0", "2*pi", value, F), symbols=SYMBOLS)
    assert found == (expected if expected == "proved" else "refuted")  # the quadrature refutes what the jump suggests


def test_a_pole_under_a_concave_function(status):
    claim = _claim("2*q/(1/2 - q**2)/(1/2 - q**2)", "q", "0", "1", "-4", "1/(1/2 - q**2)")
    assert status(claim, symbols=SYMBOLS) == "undecided"


@pytest.mark.parametrize(
    ("f", "low", "high", "equals", "expected"),
    [
        ("1/(q + 1j)", "-1", "1", "-1j*pi/2", "supported"),
        ("1/(q + 1j)", "-1", "1", "0", "refuted"),
        ("exp(1j*q)", "0", "pi", "2j", "supported"),
        ("exp(1j*q)", "0", "pi", "2.001j", "refuted"),
        ("1j/(1 + q**4)", "0", "infinity", "0", "undecided"),
        ("(1 + 1j*q)**(-5/2)", "0", "infinity", "0", "undecided"),  # a fractional power, so that envelopes are asked
        ("k*(1 + 1j)*q", "0", "1", "k/2", "refuted"),
    ],
)
def test_complex_integrands(status, f, low, high, equals, expected):
    assert status(_claim(f, "q", low, high, equals), symbols=SYMBOLS) == expected


@pytest.mark.parametrize(
    ("f", "high", "equals", "expected"),
    [
        ("1/(1 + k*cos(q))", "2*pi", "2*pi/sqrt(1 - k**2)", "proved"),
        ("1/(1 + k*cos(q))", "2*pi", "2*pi/(1 - k**2)", "refuted"),
        ("1/(1 + k*cos(q))", "4*pi", "4*pi/sqrt(1 - k**2)", "proved"),
        ("1/(1 + k*cos(q))", "pi", "pi/sqrt(1 - k**2)", "proved"),
        ("1/(1 + k*cos(q))**2", "2*pi", "2*pi/(1 - k**2)**(3/2)", "proved"),  # Kepler's third law
        ("1/(1 + k*cos(q))**2", "2*pi", "2*pi/sqrt(1 - k**2)", "refuted"),
        ("cos(q)/(1 + k*cos(q))**2", "2*pi", "-2*pi*k/(1 - k**2)**(3/2)", "proved"),
        ("k**2*sin(q)**2/(1 + k*cos(q))**2", "2*pi", "2*pi*(1/sqrt(1 - k**2) - 1)", "proved"),
        ("1/(1 - k*sin(q))", "2*pi", "2*pi/sqrt(1 - k**2)", "proved"),
        ("1/(1 + k*cos(q))", "2*pi", "2*pi/sqrt(1 - k**2)*(1 + 1e-12)", "refuted"),
    ],
)
def test_round_an_ellipse(status, f, high, equals, expected):
    """Of an orbit with eccentricity k the antiderivative has no jumps."""
    assert status(_claim(f, "q", "0", high, equals), symbols=SYMBOLS, domain='where = ["0 < k < 1"]') == expected


@pytest.mark.parametrize(
    ("f", "equals", "expected"),
    [
        ("sqrt((cos(u) - e)**2 + (1 - e**2)*sin(u)**2)", "2*pi", "proved"),  # the distance, 1 - e cos u
        ("sqrt((cos(u) - e)**2 + (1 - e**2)*sin(u)**2)", "-2*pi", "refuted"),
        ("sqrt((cos(u) - e)**2 + (1 - e**2)*sin(u)**2)*(1 - e*cos(u))", "2*pi + pi*e**2", "proved"),
        ("(sin(u)**2 + (1 - e**2)*cos(u)**2)/(1 - e*cos(u))", "2*pi", "proved"),  # 1 + e cos u
        ("(sin(u)**2 + (1 - e**2)*cos(u)**2)/(1 - e*cos(u))", "2*pi + e/10**6", "refuted"),
        ("sqrt(1 - e**2)*sin(u)*(1 - e*cos(u))", "0", "proved"),
        ("sqrt((cos(u) - 2)**6)", "22*pi", "proved"),
        ("1/sqrt((1 - e*cos(u))**2)", "2*pi/sqrt(1 - e**2)", "proved"),  # without jumps
        ("1/sqrt((1 - e*cos(u))**2)", "2*pi/sqrt(1 + e**2)", "refuted"),
        ("sqrt(sin(u)**2)", "0", "undecided"),  # of sin u, but not of its modulus
        ("sqrt((1 - 2*cos(u))**2)", "2*pi", "undecided"),  # of 1 - 2 cos u alone
    ],
)
def test_roots_of_squares_round_a_circle(status, f, equals, expected):
    found = status(_claim(f, "u", "0", "2*pi", equals), symbols='e = "real"', domain='where = ["0 < e < 1"]')
    assert found == expected


def test_an_ellipse_that_may_be_a_hyperbola(status):
    claim = _claim("1/(1 + k*cos(q))", "q", "0", "2*pi", "2*pi/sqrt(abs(1 - k**2))")
    assert status(claim, symbols=SYMBOLS, domain='where = ["0 < k < 2"]') == "undecided"
    assert status(claim, symbols=SYMBOLS, domain='where = ["0 < k < 1"]') == "proved"


NOUGHT = "(2*atan(sqrt((1 - cos(r))/(1 + cos(r)))) - r)"
"""0 for 0 < r < π, which is hard to show."""


@pytest.mark.parametrize(
    ("f", "F", "expected"),
    [
        (f"1 + {NOUGHT}/q**2", f"q - {NOUGHT}/q", {"proved", "supported", "undecided"}),
        (f"1 + {NOUGHT}*k/q**2", f"q - {NOUGHT}*k/q", {"proved", "supported", "undecided"}),
        ("1 + k/q**2", "q - k/q", {"refuted"}),  # of unknown sign, but not 0 for every k
    ],
)
def test_a_coefficient_that_may_be_0_diverges_nowhere(ask, f, F, expected):
    claim = _claim(f, "q", "0", "1", "1", F)
    (verdict,) = ask(claim, symbols=SYMBOLS, domain='where = ["r < 3"]', options={"budget": 1.0})
    assert verdict.status in expected


def test_the_sign_of_an_arbitrary_function_s_value_decides_nothing(status):
    claim = _claim("exp(-V(0)*q)", "q", "0", "infinity", "1/V(0)")
    assert status(claim, symbols=SYMBOLS) == "undecided"  # it diverges where V(0) < 0
    assert status(claim, symbols='V = ["function", "positive"]') == "proved"


def test_arbitrary_functions(status):
    claim = _claim("D(V(q), q)", "q", "a", "b", "V(b) - V(a)", "V(q)")
    assert status(claim, symbols=SYMBOLS) == "undecided"  # which of a and b is the larger?
    assert status(claim, symbols=SYMBOLS, domain='where = ["a < b"]') == "proved"


@pytest.mark.parametrize(
    ("f", "equals"),
    [
        ("sqrt(1 - k*q)**2", "abs(1 - k/2)"),  # true: for k > 1 there is no integrand all along the range
        ("exp(log(q - k))", "abs(1/2 - k)"),
        ("1 + 0*elliptic_k(k*q)", "sign(1 - k)"),
        ("1 + 0*log(q - 1/2)", "7"),
        ("q/q", "7"),
    ],
)
@pytest.mark.parametrize("method", ["all", "numeric"])
def test_what_is_demanded_and_has_gone_from_the_integrand_is_shown_before_a_quadrature(ask, f, equals, method):
    (verdict,) = ask(
        _claim(f, "q", "-1/4" if f == "q/q" else "0", "1", equals), symbols=SYMBOLS, options={"method": method}
    )
    assert verdict.status == "undecided"
    assert "no quadrature meets it" in verdict.detail["note"]


def test_what_is_demanded_and_stands_in_the_integrand_is_met_by_a_quadrature(status):
    claim = _claim("sqrt(4 - 4*k**2*q**2)*exp(-q**2)", "q", "0", "1", "7")
    assert status(claim, symbols=SYMBOLS) == "refuted"
    assert status(_claim("abs(q - k)*exp(q**2)", "q", "0", "1", "1"), symbols=SYMBOLS) == "refuted"


@pytest.mark.parametrize(
    ("f", "equals", "expected"),
    [
        ("sqrt(V(q))**2/V(q)", "1", "proved"),
        ("sqrt(V(q))**2/V(q) + sqrt(-V(q))**2/V(q)", "0", "undecided"),  # no function is both
        ("sqrt(V(q))**2/V(q) + sqrt(-V(1-q))**2/V(1-q)", "0", "undecided"),
        ("sqrt(V(q))**2/V(q)", "1 + 0*sqrt(-V(1/2))", "undecided"),
        ("sqrt(V(q))**2/V(q) + 0*sqrt(-D(V(q), q)) + 0/D(V(q), q, 2)", "1", "proved"),  # exp(-q)
        ("sqrt(-D(V(q), q))**2/D(V(q), q)", "-1 + 0*sqrt(V(1) - V(0))", "undecided"),  # it falls, and would grow
        ("sqrt(-D(V(q), q))**2/D(V(q), q)", "-1 + 0*sqrt(V(0) - V(1))", "proved"),
    ],
)
def test_a_claim_of_functions_with_values_is_one_of_functions_that_there_are(status, f, equals, expected):
    assert status(_claim(f, "q", "0", "1", equals), symbols=SYMBOLS) == expected


def test_the_answer_names_the_antiderivative_and_the_value(ask):
    (verdict,) = ask(_claim("q**2", "q", "0", "a", "a**3/4"), symbols=SYMBOLS)
    assert verdict.detail["antiderivative"] == "q**3/3"
    assert verdict.detail["value"] == "a**3/3"


def test_numeric_only(ask):
    claims = [_claim("sin(q)", "q", "0", "pi", "2"), _claim("sin(q)", "q", "0", "pi", "2.000001")]
    verdicts = ask(*claims, options={"method": "numeric"})
    assert [v.status for v in verdicts] == ["supported", "refuted"]
    assert all(v.method == "certified quadrature" for v in verdicts)


@pytest.mark.parametrize(
    ("claim", "message"),
    [
        (_claim("q", "q", "0", "1", "1/2", "q**2"), "another function"),
        (_claim("q", "q", "infinity", "0", "0"), "upwards"),
        (_claim("q", "q", "0", "q", "q**2/2"), "variable of integration"),
        (_claim("q", "q", "0", "1", "q/2"), "doesn't depend"),
        (_claim("r", "r", "-1", "1", "0"), "leaves what is assumed"),
        (_claim("n", "n", "0", "1", "0"), "no real variable"),
    ],
)
def test_faults(ask, claim, message):
    with pytest.raises((InputError, AssertionError), match=message):
        ask(claim, symbols=SYMBOLS)
