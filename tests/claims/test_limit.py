"""Limits, by exact expansions in powers of the distance."""

import pytest

from canon.errors import InputError

SYMBOLS = "\n".join(
    [f'{x} = "positive"' for x in "abcmNw"]
    + ['n = "integer"', 'v = "real"', 'k = "real"', 'V = "function"', 'l = "nonnegative"']
)


def _claim(f: str, x: str, to: str, equals: str, side: str = "") -> str:
    more = f'\nside = "{side}"' if side else ""
    return f'kind = "limit"\nf = "{f}"\nvariable = "{x}"\nto = "{to}"\nequals = "{equals}"{more}'


@pytest.mark.parametrize(
    ("f", "x", "to", "equals", "side", "expected"),
    [
        ("sin(q)/q", "q", "0", "1", "", "proved"),
        ("sin(q)/q", "q", "0", "1001/1000", "", "refuted"),
        ("(1 - cos(q))/q**2", "q", "0", "1/2", "", "proved"),
        ("(q**2 - a**2)/(q - a)", "q", "a", "2*a", "", "proved"),
        ("(q**2 - a**2)/(q - a)", "q", "a", "a", "", "refuted"),
        ("(1 + k/N)**N", "N", "infinity", "exp(k)", "", "proved"),
        ("(1 + k/N)**N", "N", "infinity", "exp(k) + 1/1000", "", "refuted"),
        ("m*c**2/sqrt(1 - v**2/c**2) - m*c**2", "c", "infinity", "m*v**2/2", "", "proved"),
        ("m*c**2/sqrt(1 - v**2/c**2)", "c", "infinity", "infinity", "", "proved"),
        ("m*c**2/sqrt(1 - v**2/c**2)", "c", "infinity", "-infinity", "", "refuted"),
        ("a*b/(a + b)", "b", "infinity", "a", "", "proved"),
        ("a*b/(a + b)", "b", "infinity", "a + 1", "", "refuted"),
        ("abs(q)/q", "q", "0", "1", "", "refuted"),
        ("abs(q)/q", "q", "0", "1", "+", "proved"),
        ("abs(q)/q", "q", "0", "-1", "-", "proved"),
        ("k/q", "q", "0", "0", "+", "refuted"),  # but where k is 0
        ("k*q/q", "q", "0", "k", "", "proved"),
        ("a/q", "q", "0", "infinity", "+", "proved"),
        ("a/q", "q", "0", "infinity", "", "refuted"),  # -infinity from below
        ("sqrt(q)/q", "q", "0", "infinity", "+", "proved"),
        ("(sqrt(1 + q) - 1)/sqrt(q)", "q", "0", "0", "+", "proved"),
        ("q*log(q)", "q", "0", "0", "+", "proved"),
        ("log(q)", "q", "0", "-infinity", "+", "proved"),
        ("exp(-1/q)/q**3", "q", "0", "0", "+", "proved"),
        ("asin(q)", "q", "1", "pi/2", "-", "proved"),
        ("(pi - acos(q))/sqrt(2 + 2*q)", "q", "-1", "1", "+", "proved"),
        ("(pi - acos(q))/sqrt(2 + 2*q)", "q", "-1", "-1", "+", "refuted"),
        ("cos(q)/(q - pi/2)", "q", "pi/2", "-1", "", "proved"),
        ("sin(2*q)/(q + 3*pi/2)", "q", "-3*pi/2", "-2", "", "proved"),
        ("sin(q)/(q - 3*pi)", "q", "3*pi", "1", "", "refuted"),
        ("atan(a*q)", "q", "infinity", "pi/2", "", "proved"),
        ("atan(k*q)", "q", "infinity", "pi/2", "", "refuted"),
        ("atan2(q, -1)", "q", "0", "pi", "+", "proved"),
        ("elliptic_k(q**2)", "q", "0", "pi/2", "", "proved"),
        ("(elliptic_k(q**2) - pi/2)/q**2", "q", "0", "pi/8", "", "proved"),
        ("(elliptic_e(q**2) - pi/2)/q**2", "q", "0", "-pi/8", "", "proved"),
        ("(V(q + a*k) - V(q))/a", "a", "0", "k*D(V(q), q)", "+", "proved"),
        ("(V(q + a*k) - V(q))/a", "a", "0", "D(V(q), q)", "+", "refuted"),
        ("exp(-a*q)*cos(w*q)", "q", "infinity", "0", "", "proved"),
        ("q + cos(q)", "q", "infinity", "infinity", "", "proved"),
        ("log(q) + cos(q)", "q", "infinity", "infinity", "", "proved"),
        ("sin(w*t)/w", "w", "0", "t", "+", "proved"),
        ("(1 - exp(-2*l*t))/l", "l", "0", "2*t", "+", "proved"),
    ],
)
def test_limits(status, f, x, to, equals, side, expected):
    assert status(_claim(f, x, to, equals, side), symbols=SYMBOLS) == expected


@pytest.mark.parametrize(
    ("f", "to", "equals", "expected"),
    [
        ("tanh(a*q)", "infinity", "1", "proved"),
        ("tanh(a*q)", "-infinity", "-1", "proved"),
        ("tanh(a*q)", "infinity", "1001/1000", "refuted"),
        ("tanh(k*q)", "infinity", "1", "refuted"),  # k may be negative
        ("q - log(cosh(q))", "infinity", "log(2)", "proved"),
        ("q - log(cosh(q))", "infinity", "log(2) + 1/1000", "refuted"),
        ("cosh(q)*exp(-q)", "infinity", "1/2", "proved"),
        ("(cosh(q) - sinh(q))*exp(q)", "infinity", "1", "proved"),
        ("(cosh(q) - sinh(q))*exp(q)", "infinity", "0", "refuted"),
        ("(tanh(q) - 1)*exp(2*q)", "infinity", "-2", "supported"),  # the leading parts cancel inside a quotient
        ("sinh(q)", "-infinity", "-infinity", "proved"),
        ("sinh(q)", "-infinity", "infinity", "refuted"),
        ("exp(q)/q**5", "infinity", "infinity", "proved"),
        ("exp(a*q)/exp(b*q)", "infinity", "0", "refuted"),  # which of a and b is the larger?
        ("exp(a*q)/exp((a + b)*q)", "infinity", "0", "proved"),
        ("exp(q + 1/q) - exp(q)", "infinity", "infinity", "proved"),
        ("exp(q*(1 + 1/q))*exp(-q)", "infinity", "exp(1)", "proved"),
        ("exp(sqrt(q))/q**100", "infinity", "infinity", "proved"),
        ("exp(exp(q))/exp(q**2)", "infinity", "infinity", "proved"),
        ("exp(q + sin(q))/exp(q)", "infinity", "1", "undecided"),
        ("exp(q)*sin(q)", "infinity", "infinity", "undecided"),
        ("1/(exp(1/q) + 1)", "0", "0", "refuted"),  # 1 from below
        ("4*atan(exp(w*q)) - pi", "infinity", "pi", "proved"),  # the pendulum on its separatrix
        ("4*atan(exp(w*q)) - pi", "-infinity", "-pi", "proved"),
        ("asinh(q) - log(q)", "infinity", "log(2)", "proved"),  # logarithms that cancel
        ("asinh(q) - 1001/1000*log(q)", "infinity", "log(2)", "refuted"),
        ("tanh(q) + V(1/q)", "infinity", "1 + V(0)", "proved"),
    ],
)
def test_exponentials_beyond_every_power(status, f, to, equals, expected):
    assert status(_claim(f, "q", to, equals), symbols=SYMBOLS) == expected


@pytest.mark.parametrize(
    ("f", "equals", "expected"),
    [
        ("q*sin(1/q)", "0", "proved"),
        ("q*sin(1/q) + q*cos(log(q)/q**2)", "0", "proved"),
        ("sin(1/q)**2 + cos(1/q)**2", "1", "supported"),
        ("exp(-1/q)*cos(1/q)/q", "0", "proved"),
        ("(2 + sin(1/q))/q", "0", "undecided"),
        ("sin(1/q)", "0", "undecided"),
        ("sqrt(q)*V(q)", "0", "undecided"),  # V may be 1/q where q > 0
        ("q*V(q)*0 + q", "0", "proved"),
    ],
)
def test_what_has_no_expansion(status, f, equals, expected):
    assert status(_claim(f, "q", "0", equals, "+"), symbols=SYMBOLS) == expected


@pytest.mark.parametrize(
    ("f", "to", "equals", "side"),
    [
        ("abs(V(q))", "0", "V(0)", ""),
        ("abs(V(q))", "0", "abs(V(0))", ""),  # true, but of no sign that is known
        ("V(0)*q", "infinity", "infinity", ""),
        ("exp(V(0)*q)", "infinity", "infinity", ""),
        ("atan(V(0)/q)", "0", "pi/2", "+"),
        ("atan2(q, V(0))", "0", "0", ""),
        ("(V(0)*q + 1)/(V(0)*q + 2)", "infinity", "1", ""),
    ],
)
def test_values_of_arbitrary_functions_have_no_sign(status, f, to, equals, side):
    assert status(_claim(f, "q", to, equals, side), symbols=SYMBOLS) in ("undecided", "supported")


@pytest.mark.parametrize(
    ("f", "to", "equals", "where", "expected"),
    [
        ("sqrt(k**2 + q) - abs(k)", "0", "0", "k != 0", "proved"),
        ("sqrt(k**2 + q) - k", "0", "0", "k != 0", "refuted"),  # where k < 0
        ("p/(p + q)", "0", "1", "p != 0", "proved"),
        ("p/(p + q)", "0", "1001/1000", "p != 0", "refuted"),
        ("(k*q**2 + q)/(k*q**2 + 2*q)", "infinity", "1", "k != 0", "proved"),
        ("(k*q**2 + q)/(k*q**2 + 2*q)", "infinity", "1", "p > 0", "refuted"),  # 1/2 where k = 0
        ("k*q", "infinity", "infinity", "k != 0", "refuted"),
    ],
)
def test_what_is_not_zero_may_have_no_sign(status, f, to, equals, where, expected):
    claim = _claim(f, "q", to, equals)
    assert status(claim, symbols=SYMBOLS, domain=f'where = ["{where}"]') == expected


def test_a_number_that_may_be_0_is_no_infinite_limit(status):
    nought = "(2*atan(sqrt((1 - cos(1))/(1 + cos(1)))) - 1)"  # 0, which is hard to show
    claim = _claim(f"{nought}/q + q**2/(k + q)", "q", "0", "0", "+")
    assert status(claim, symbols=SYMBOLS) in ("supported", "proved")
    wrong = _claim("(1 - 2*atan(1/3))/q + q**2/(k + q)", "q", "0", "0", "+")
    assert status(wrong, symbols=SYMBOLS) == "refuted"


def test_values_of_positive_functions_have_a_sign(status):
    claim = _claim("V(0)*q", "q", "infinity", "infinity")
    assert status(claim, symbols='V = ["function", "positive"]') == "proved"


@pytest.mark.parametrize("equals", ["2", "2002/1000"])
def test_balls_that_hold_any_value_support_nothing(ask, equals):
    numeric = {"method": "numeric"}  # 1 - tanh q is below the rounding of 128 bits where q is large
    for f in ("(1 - tanh(q))*exp(2*q)", "sqrt(q**2 + 4*q) - q"):
        (verdict,) = ask(_claim(f, "q", "infinity", equals), options=numeric)
        assert verdict.status == ("supported" if equals == "2" else "undecided")


@pytest.mark.parametrize(("f", "expected"), [("log(q)", "supported"), ("1 - 1/q", "undecided"), ("-q", "undecided")])
def test_values_that_only_increase_support_no_infinite_limit(ask, f, expected):
    (verdict,) = ask(_claim(f, "q", "infinity", "infinity"), options={"method": "numeric"})
    assert verdict.status == expected


def test_conditions_near_the_limit_are_part_of_the_claim(status):
    claim = _claim("sqrt(q - a)/sqrt(q - b)", "q", "infinity", "1")
    assert status(claim, symbols=SYMBOLS) == "proved"
    claim = _claim("sqrt(q**2)/q", "q", "0", "1", "+")
    assert status(claim, symbols=SYMBOLS, domain='where = ["q > 0"]') == "proved"


def test_numeric_only(ask):
    true, false = _claim("sin(q)/q", "q", "0", "1"), _claim("sin(q)/q", "q", "0", "2")
    verdicts = ask(true, false, options={"method": "numeric"})
    assert [v.status for v in verdicts] == ["supported", "undecided"]
    assert verdicts[0].numeric.max_residual < 1e-15


@pytest.mark.parametrize(
    ("claim", "message"),
    [
        (_claim("sqrt(q - 1)", "q", "0", "0"), "doesn't reach"),
        (_claim("q", "q", "p", "q"), "tends to its limit"),
        (_claim("q", "q", "infinity", "infinity", "+"), "one side only"),
        (_claim("q", "q", "oo", "0"), "infinity"),
        (_claim("q", "q", "0", "0", "above"), "from above"),
        (_claim("q", "V", "0", "0"), "function"),
        (_claim("n", "n", "0", "0"), "integer"),
        (_claim("1j*q", "q", "infinity", "infinity"), "complex"),
    ],
)
def test_faults(ask, claim, message):
    with pytest.raises((InputError, AssertionError), match=message):
        ask(claim, symbols=SYMBOLS)


@pytest.mark.parametrize("sections", [
    {"symbols": 'infinity = "positive"'}, {"space": 'q = ["q"]\np = ["infinity"]'}, {"definitions": 'infinity = "7"'},
    {"symbols": 'infinity = "function"'},
])  # fmt: skip
def test_a_name_that_is_written_as_infinity_is(ask, sections):
    """Of declared names it is said that they win, of ends of ranges that they are this: nobody knows which is meant."""
    lower = 'kind = "integral"\nf = "exp(-q)"\nvariable = "q"\nfrom = "0"\nto = "infinity"\nequals = "1"'
    space = {"space": 'q = ["q"]\np = ["p"]', **sections}
    for claim in (_claim("1/q", "q", "infinity", "0"), _claim("1/q", "q", "0", "-infinity", "-"), lower):
        with pytest.raises((InputError, AssertionError), match="is a name of the file"):
            ask(claim, **space)
    if "function" not in sections.get("symbols", ""):
        (meant,) = ask(_claim("(q + 1)/q", "q", "(infinity)", "1 + 1/infinity"), **space)
        assert meant.status == "proved"


def test_a_name_may_be_written_as_other_words_for_it(status):
    assert status(_claim("q + oo", "q", "oo", "2*oo"), symbols='oo = "real"', space='q = ["q"]\np = ["p"]') == "proved"
