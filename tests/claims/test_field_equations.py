"""Euler–Lagrange equations of functionals of several variables."""

import pytest

from canon.errors import InputError

PLANE = 'q = ["x", "y"]\np = ["px", "py"]\n'
SYMBOLS = 'u = "function"\nw = "function"\nV = "function"\nc = "positive"\nk = "positive"'


@pytest.mark.parametrize(
    ("L", "equation", "expected"),
    [
        ("D(u(x, t), t)**2/2 - c**2*D(u(x, t), x)**2/2", "-D(u(x, t), t, 2) + c**2*D(u(x, t), x, 2)", "proved"),
        ("D(u(x, t), t)**2/2 - c**2*D(u(x, t), x)**2/2", "-D(u(x, t), t, 2) - c**2*D(u(x, t), x, 2)", "refuted"),
        ("D(u(x, t), t)**2/2 - k*D(u(x, t), x, 2)**2/2", "-D(u(x, t), t, 2) - k*D(u(x, t), x, 4)", "proved"),
        ("D(u(x, t), t)**2/2 - k*D(u(x, t), x, 2)**2/2", "-D(u(x, t), t, 2) + k*D(u(x, t), x, 4)", "refuted"),
        ("D(u(x, t), t)*D(u(x, t), x)", "-2*D(D(u(x, t), x), t)", "proved"),
        ("-V(u(x, t))", "-D(V(u(x, t)), x)/D(u(x, t), x)", "proved"),
    ],
)
def test_one_field(status, L, equation, expected):
    claim = f'kind = "field_equations"\nL = "{L}"\nfields = ["u(x, t)"]\nequations = ["{equation}"]'
    assert status(claim, space=PLANE, symbols=SYMBOLS) == expected


def test_two_fields(status):
    claim = (
        'kind = "field_equations"\nL = "D(u(x, y), x)*D(w(x, y), y) - k*u(x, y)*w(x, y)"\n'
        'fields = ["u(x, y)", "w(x, y)"]\n'
        'equations = ["-D(D(w(x, y), x), y) - k*w(x, y)", "-D(D(u(x, y), x), y) - k*u(x, y)"]'
    )
    assert status(claim, space=PLANE, symbols=SYMBOLS) == "proved"


@pytest.mark.parametrize(
    ("L", "field", "message"),
    [
        ("w(x, t)", "u(x, t)", "nothing of u"),
        ("u(x, t) + u(2*x, t)", "u(x, t)", "other arguments"),
        ("u(x, t)", "u(x, x)", "different names"),
        ("u(x, t)", "c", "different names"),
    ],
)
def test_faults(ask, L, field, message):
    claim = f'kind = "field_equations"\nL = "{L}"\nfields = ["{field}"]\nequations = ["0"]'
    with pytest.raises((InputError, AssertionError), match=message):
        ask(claim, space=PLANE, symbols=SYMBOLS)
