"""Matrices that keep a metric, and groups of matrices."""

import pytest

from canon.errors import InputError

SPACE = 'q = ["x"]\np = ["px"]\n'
SYMBOLS = 'a = "real"\nb = "real"\nu = "real"\nv = "real"'
MINKOWSKI = '[["1", "0"], ["0", "-1"]]'


@pytest.mark.parametrize(
    ("matrix", "metric", "more", "expected"),
    [
        ('[["cosh(a)", "sinh(a)"], ["sinh(a)", "cosh(a)"]]', MINKOWSKI, "", "proved"),
        ('[["cosh(a)", "-sinh(a)"], ["sinh(a)", "cosh(a)"]]', MINKOWSKI, "", "refuted"),
        ('[["cos(a)", "-sin(a)"], ["sin(a)", "cos(a)"]]', '[["1", "0"], ["0", "1"]]', "", "proved"),
        ('[["cos(a)", "-sin(a)"], ["sin(a)", "cos(a)"]]', MINKOWSKI, "", "refuted"),
        ('[["1", "a"], ["0", "1"]]', '[["0", "1"], ["-1", "0"]]', 'inverse = [["1", "-a"], ["0", "1"]]', "proved"),
        ('[["1", "a"], ["0", "1"]]', '[["0", "1"], ["-1", "0"]]', 'inverse = [["1", "a"], ["0", "1"]]', "refuted"),
    ],
)
def test_metrics_that_are_kept(status, matrix, metric, more, expected):
    claim = f'kind = "invariant_interval"\nmatrix = {matrix}\nmetric = {metric}\n{more}'
    assert status(claim, space=SPACE, symbols=SYMBOLS) == expected


BOOST = 'matrix = [["1/sqrt(1 - u**2)", "u/sqrt(1 - u**2)"], ["u/sqrt(1 - u**2)", "1/sqrt(1 - u**2)"]]'


@pytest.mark.parametrize(
    ("composition", "inverse", "expected"),
    [
        ("(u + v)/(1 + u*v)", "", "proved"),
        ("(u + v)/(1 - u*v)", "", "refuted"),
        ("u + v", "", "refuted"),
        ("(u + v)/(1 + u*v)", 'inverse = ["-u"]', "proved"),
        ("(u + v)/(1 + u*v)", 'inverse = ["1 - u"]', "refuted"),
    ],
)
def test_boosts_compose(status, composition, inverse, expected):
    claim = f'kind = "matrix_group"\n{BOOST}\nfirst = ["u"]\nsecond = ["v"]\ncomposition = ["{composition}"]\n{inverse}'
    assert status(claim, space=SPACE, symbols=SYMBOLS) == expected


@pytest.mark.parametrize(
    ("claim", "message"),
    [
        ('kind = "invariant_interval"\nmatrix = [["1", "0"]]\nmetric = [["1"]]', "square matrix"),
        ('kind = "invariant_interval"\nmatrix = [["1"]]\nmetric = [["1", "0"], ["0", "1"]]', "2 rows"),
        (f'kind = "matrix_group"\n{BOOST}\nfirst = ["u"]\nsecond = ["u"]\ncomposition = ["u"]', "other names"),
    ],
)
def test_faults(ask, claim, message):
    with pytest.raises((InputError, AssertionError), match=message):
        ask(claim, space=SPACE, symbols=SYMBOLS)
