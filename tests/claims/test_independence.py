"""Functions that are dependent at one value of a parameter, or on one side of a wall: never proved independent."""

import pytest

TWO = 'q = ["x", "y"]\np = ["px", "py"]\n'


def independent(ask, functions, symbols, where=()):
    claim = f'kind = "independent"\nfunctions = {list(functions)}'
    (verdict,) = ask(claim, space=TWO, symbols=symbols, domain=f"where = {list(where)}")
    return verdict.status


@pytest.mark.parametrize(
    ("functions", "symbols", "where"),
    [
        # ∂/∂y is 1 at x = 1, where a cancels, and 0 everywhere for a = 0
        (("a**2*y/(a**2 + x - 1)", "x"), 'a = "real"', ()),
        (("a**2*y/(a**2 + (x - 1)**2)", "x"), 'a = "real"', ()),
        (("a*log(a + (x - 1)*b)",), 'a = "nonnegative"\nb = "positive"', ("a + (x - 1)*b > 0",)),
        # a + sign(x − 6/5) is a + 1 on one side and a − 1 on the other: at a = ±1 it is 0 on one of them
        (("a*x + abs(x - 6/5)", "y"), 'a = "real"', ()),
        (("a*x + sqrt((x - 6/5)**2)", "y"), 'a = "real"', ()),
        # what is nonnegative may be 0
        (("(a + b)*log(x)", "y"), 'a = "nonnegative"\nb = "nonnegative"', ()),
        # 1 + cos(n*pi) is 0 for odd n
        (("x*(1 + cos(n*pi))", "y*exp(y)"), 'n = "integer"', ()),
    ],
)
def test_dependent_somewhere(ask, functions, symbols, where):
    assert independent(ask, functions, symbols, where) in ("refuted", "supported")


@pytest.mark.parametrize(
    ("functions", "symbols", "where"),
    [
        (("x/(a + y)", "y"), 'a = "real"', ()),
        (("x/(a**2 + y**2)", "y"), 'a = "positive"', ()),
        (("a*x + sqrt(x**2 + 1)", "y"), 'a = "real"', ()),
        (("(a + b)*log(x)", "y"), 'a = "nonnegative"\nb = "positive"', ()),
    ],
)
def test_independent_for_all_parameters(ask, functions, symbols, where):
    assert independent(ask, functions, symbols, where) == "proved"
