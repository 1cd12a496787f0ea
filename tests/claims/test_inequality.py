"""Inequalities: proved by signs of factors or by a cover, refuted by a certified point."""

from fractions import Fraction

import pytest

from canon.errors import InputError

PLANE = 'q = ["x", "y"]\np = ["px", "py"]\n'
SYMBOLS = (
    'a = "positive"\nb = "positive"\nn = "nonnegative"\nf = ["function", "positive"]\nV = "function"\nk = "integer"'
)
UNIT = 'where = ["0 < x < 1", "0 < y < 1"]'


def _claim(lhs: str, relation: str, rhs: str) -> str:
    return f'kind = "inequality"\nlhs = "{lhs}"\nrelation = "{relation}"\nrhs = "{rhs}"'


@pytest.mark.parametrize(
    ("lhs", "relation", "rhs", "expected"),
    [
        ("a*b/(a + b)", "<", "a", "proved"),
        ("x*y", "<=", "(x**2 + y**2)/2", "proved"),
        ("x*y", "<", "(x**2 + y**2)/2", "refuted"),  # equal at x = y
        ("1001/1000*x*y", "<=", "(x**2 + y**2)/2", "refuted"),
        ("n", ">=", "0", "proved"),
        ("n", ">", "0", "refuted"),  # n may be 0
        ("n*x**2 + a", ">", "0", "proved"),
        ("n*x**2 + n*a", ">", "0", "refuted"),
        ("f(x)*a + V(y)**2", ">", "0", "proved"),
        ("V(y)", ">=", "0", "refuted"),
        ("1/x**2", ">", "0", "proved"),
        ("exp(x)", ">", "1 + x", "refuted"),  # equal at 0
        ("k**2", ">=", "k", "proved"),
        ("k**2", ">", "k", "refuted"),  # equal at 0 and 1
        ("4*k**2 + 1", ">", "4*k", "proved"),  # 0 at 1/2, which is no whole number
        ("k**3", ">=", "k", "refuted"),
        ("1001/1000*k**2", ">=", "k**2 + k/900", "refuted"),  # at 1
    ],
)
def test_on_the_plane(status, lhs, relation, rhs, expected):
    assert status(_claim(lhs, relation, rhs), space=PLANE, symbols=SYMBOLS) == expected


@pytest.mark.parametrize(
    ("lhs", "relation", "rhs", "where", "expected"),
    [
        ("exp(x)", ">=", "1 + x", "", "proved"),
        ("exp(x)", ">=", "1 + x + 1e-12", "", "refuted"),
        ("exp(a*x)", ">=", "1 + a*x", "", "proved"),
        ("log(x)", "<=", "x - 1", "", "proved"),
        ("sin(x)", "<", "x", "x > 0", "proved"),
        ("sin(x)", "<", "x", "x > -1/1000", "refuted"),
        ("sin(x)", ">", "x - x**3/6", "x > 0", "proved"),
        ("sin(a*x)", "<=", "a*x", "x > 0", "proved"),
        ("sin(k*x)", "<=", "k*x", "x > 0", "refuted"),
        ("sin(n)", "<", "n", "", "refuted"),  # n may be 0
        ("sin(n)", "<=", "n", "", "proved"),
        ("tan(x)", ">", "x", "0 < x < pi/2", "proved"),
        ("tan(x)", ">", "1001/1000*x", "0 < x < pi/2", "refuted"),
        ("-sign(x)", ">=", "0", "x > 0", "refuted"),  # its slope is 0, but it jumps at 0
        ("sign(x - 1e-9)", ">=", "0", "x > 0", "refuted"),
        ("-abs(x)/x", ">=", "0", "x > 0", "refuted"),
    ],
)
def test_by_slopes(status, lhs, relation, rhs, where, expected):
    domain = f'where = ["{where}"]' if where else ""
    assert status(_claim(lhs, relation, rhs), space=PLANE, symbols=SYMBOLS, domain=domain) == expected


@pytest.mark.parametrize(
    ("lhs", "relation", "rhs", "expected", "method"),
    [
        ("sin(x)", "<", "x + 1/100", "proved", "slopes"),
        ("exp(-x)*sin(5*x)", "<", "4/5", "proved", "cover"),
        ("sin(x) + cos(y)", "<", "2", "proved", "signs"),
        ("sin(x) + cos(y)", "<", "19/10", "proved", "slopes"),
        ("exp(-x*y)*sin(5*x + y)", "<", "3/2", "proved", "cover by "),
        ("sin(x) + cos(y)", "<", "184/100", "refuted", "ball"),
        ("x*(1 - x)", "<=", "1/4", "proved", "signs"),
        ("x*(1 - x)", "<=", "249999/1000000", "refuted", "ball"),
        ("1/sqrt(1 - x**2)", ">", "1 + x**2/2", "proved", "signs"),
    ],
)
def test_on_a_box(ask, lhs, relation, rhs, expected, method):
    (verdict,) = ask(_claim(lhs, relation, rhs), space=PLANE, symbols=SYMBOLS, domain=UNIT)
    assert verdict.status == expected
    assert method in verdict.method
    assert verdict.numeric is not None
    difference, off = verdict.numeric.max_residual, verdict.numeric.bound
    assert difference + off < 0 if expected == "refuted" else difference > -off


def test_the_cover_reaches_an_edge_that_is_a_large_multiple_of_pi(status):
    domain = 'where = ["0 < x < 1000000000*pi"]'
    expected = {"1e-9": "supported", "1e-8": "supported", "-1e-9": "proved"}  # false for a while before the edge
    for less, verdict in expected.items():
        assert status(_claim("x", "<", f"1000000000*pi - ({less})"), space=PLANE, domain=domain) == verdict


@pytest.mark.parametrize(
    ("lhs", "rhs"),
    [
        ("sign(x - 1/10**12)", "0"),
        ("sign(x - 1/10**12) + y", "-1/2"),
        ("atan2(x - 1/10**12, -1)", "-3"),
        ("(x - 1/10**12)/sqrt((x - 1/10**12)**2)", "0"),
    ],
)
def test_a_jump_within_a_box_is_not_passed_over(status, lhs, rhs):
    assert status(_claim(lhs, ">", rhs), space=PLANE, domain=UNIT) == "refuted"  # false for x < 1/10**12
    assert status(_claim(lhs.replace("- 1/10**12", "+ 1/10**12"), ">", rhs), space=PLANE, domain=UNIT) == "proved"


@pytest.mark.parametrize("high", ["1e-9", "1e-40"])
@pytest.mark.parametrize(("lhs", "rhs"), [("-1/x", "0"), ("-1/x - 1", "-1/2"), ("-atan(1/x)", "0")])
def test_a_slope_does_not_lead_across_what_is_left_out(status, lhs, rhs, high):
    """x is declared not to be 0, so that no condition says so; beyond 0 the inequalities fail."""
    plane = 'q = ["x"]\np = ["p"]\n'
    where = f'where = ["-1 < x < {high}"]'
    assert status(_claim(lhs, ">", rhs), space=plane, symbols='x = "nonzero"', domain=where) != "proved"


@pytest.mark.parametrize(
    ("lhs", "rhs", "where", "expected"),
    [
        ("sin(x)", "2*x/pi", "0 < x < pi/2", "proved"),  # concave, and 0 at both ends
        ("sin(x)", "2*x/pi", "0 < x < 1.5708", "refuted"),  # beyond π/2 by 4e-6
        ("sin(x)", "2*x/pi + 1e-9", "0 < x < pi/2", "refuted"),
        ("sqrt(x)", "x", "0 < x < 1", "proved"),
        ("log(x)", "(x - 1)*log(2)", "1 < x < 2", "proved"),
        ("log(x)", "(x - 1)*log(2)", "1 < x < 2.001", "refuted"),
        ("sin(a*x)", "2*a*x/pi", "0 < x < 1", "refuted"),
    ],
)
def test_concave_between_two_zeros(status, lhs, rhs, where, expected):
    plane = 'q = ["x"]\np = ["p"]\n'
    assert status(_claim(lhs, ">", rhs), space=plane, symbols=SYMBOLS, domain=f'where = ["{where}"]') == expected


@pytest.mark.parametrize(
    ("lhs", "expected"),
    [("x**2", "proved"), ("y**2", "refuted"), ("x**2*y**2", "refuted"), ("x**2 + n", "proved"), ("x**3", "refuted"),
     ("1/x**2", "proved"), ("x**2*n", "refuted"), ("x**4*(1 + y**2)", "proved")],
)  # fmt: skip
def test_squares_of_what_is_not_0(status, lhs, expected):
    plane = 'q = ["x", "y"]\np = ["p", "r"]\n'
    symbols = 'x = "nonzero"\nn = "nonnegative"'
    assert status(_claim(lhs, ">", "0"), space=plane, symbols=symbols) == expected


def test_the_cover_leaves_out_what_the_domain_does(status):
    ring = 'where = ["-2 < x < 2", "-2 < y < 2", "x**2 + y**2 < 1"]'
    claim = _claim("exp(x) + exp(y)", "<", "5")  # false on the square, true on the disc
    assert status(claim, space=PLANE, domain=ring) == "proved"
    assert status(claim, space=PLANE, domain='where = ["-2 < x < 2", "-2 < y < 2"]') == "refuted"


def test_a_witness_names_the_difference(ask):
    (verdict,) = ask(_claim("x**2", ">", "1"), space=PLANE)
    assert verdict.status == "refuted"
    assert Fraction(verdict.witness["x"]) ** 2 <= 1


def test_numeric_only_supports_or_refutes(ask):
    (verdict,) = ask(_claim("x**2", ">=", "0"), space=PLANE, options={"method": "numeric"})
    assert verdict.status == "supported"
    assert verdict.numeric.max_residual >= 0


@pytest.mark.parametrize(("lhs", "relation", "message"), [("x", "==", "< <= > >="), ("1j*x", "<", "complex")])
def test_faults(ask, lhs, relation, message):
    with pytest.raises((InputError, AssertionError), match=message):
        ask(_claim(lhs, relation, "0"), space=PLANE)


@pytest.mark.parametrize(
    ("where", "lhs", "relation", "rhs", "expected"),
    [
        ("x != 0", "x**2", ">", "0", "proved"),
        ("x != 0", "abs(x)", ">", "0", "proved"),
        ("x != 0", "x**2 + y**2", ">", "0", "proved"),
        ("x != 0", "x**2*(1 + y**2)", ">", "0", "proved"),
        ("x != y", "(x - y)**2", ">", "0", "proved"),
        ("x != y", "x**2 + y**2", ">", "2*x*y", "proved"),
        ("x*y != 0", "x**2*y**2", ">", "0", "proved"),
        ("x != 0", "x**2*y**2", ">", "0", "refuted"),
        ("x != 0", "x**3", ">", "0", "refuted"),
        ("x != 0", "y**2", ">", "0", "refuted"),
        ("x != 1", "x**2", ">", "0", "refuted"),
        ("x != 0", "x**2*n", ">", "0", "refuted"),  # n may be 0
    ],
)
def test_what_is_not_zero_has_a_sign(status, where, lhs, relation, rhs, expected):
    domain = f'where = ["{where}"]'
    assert status(_claim(lhs, relation, rhs), space=PLANE, symbols=SYMBOLS, domain=domain) == expected


@pytest.mark.parametrize(
    ("words", "rhs", "expected"),
    [
        ('["integer", "positive"]', "k", "proved"),
        ('["integer", "negative"]', "k", "refuted"),
        ('["integer", "nonnegative"]', "k", "proved"),
        ('["integer", "positive"]', "k + 1", "refuted"),
        ('["integer", "nonzero", "nonnegative"]', "1", "proved"),
    ],
)
def test_whole_numbers_of_one_sign(status, words, rhs, expected):
    assert status(_claim("k**3", ">=", rhs), space=PLANE, symbols=f"k = {words}") == expected
