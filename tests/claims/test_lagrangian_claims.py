"""Lagrange's equations, Noether's theorem, and functions that solve equations."""

import pytest

from canon.errors import InputError

PLANE = 'q = ["r", "phi"]\np = ["pr", "pphi"]\n'
CENTRAL = 'L = "m*(v**2 + r**2*w**2)/2 - V(r)"\nvelocities = ["v", "w"]\n'
SYMBOLS = 'm = "positive"\nb = "positive"\nV = "function"'


@pytest.mark.parametrize(
    ("radial", "angular", "expected"),
    [
        ("m*a - m*r*w**2 + D(V(r), r)", "m*r**2*c + 2*m*r*v*w", "proved"),
        ("m*a + m*r*w**2 + D(V(r), r)", "m*r**2*c + 2*m*r*v*w", "refuted"),
        ("m*a - m*r*w**2 + D(V(r), r)", "m*r**2*c + m*r*v*w", "refuted"),
        ("m*a - 1001/1000*m*r*w**2 + D(V(r), r)", "m*r**2*c + 2*m*r*v*w", "refuted"),
    ],
)
def test_lagrange_s_equations(status, radial, angular, expected):
    claim = f'kind = "euler_lagrange"\n{CENTRAL}accelerations = ["a", "c"]\nequations = ["{radial}", "{angular}"]'
    assert status(claim, space=PLANE, symbols=SYMBOLS) == expected


def test_accelerations_with_friction_and_a_force(status):
    claim = f'kind = "euler_lagrange"\n{CENTRAL}dissipation = "b*v**2/2"\nforces = ["sin(t)", "0"]\n'
    right = 'qddot = ["r*w**2 - D(V(r), r)/m - b*v/m + sin(t)/m", "-2*v*w/r"]'
    assert status(claim + right, space=PLANE, symbols=SYMBOLS) == "proved"
    assert status(claim + right.replace("- b*v", "- 2*b*v"), space=PLANE, symbols=SYMBOLS) == "refuted"


def test_a_singular_lagrangian_determines_no_accelerations(ask):
    claim = 'kind = "euler_lagrange"\nL = "v**2/2"\nvelocities = ["v", "w"]\nqddot = ["0", "0"]\n'
    (verdict,) = ask(claim, space=PLANE)
    assert verdict.status == "refuted"
    assert verdict.detail["hessian"] == "det d2L/dv2 is identically 0"


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        ('dq = ["0", "1"]\ncharge = "m*r**2*w"', "proved"),
        ('dq = ["0", "1"]\ncharge = "m*r*w"', "refuted"),
        ('dq = ["1", "0"]', "refuted"),
        ('dq = ["0", "0"]\ndt = "-1"\ncharge = "m*(v**2 + r**2*w**2)/2 + V(r)"', "proved"),
        ('dq = ["0", "0"]\ndt = "1"\ncharge = "m*(v**2 + r**2*w**2)/2 + V(r)"', "refuted"),
    ],
)
def test_noether_s_charges(status, keys, expected):
    assert status(f'kind = "noether"\n{CENTRAL}{keys}', space=PLANE, symbols=SYMBOLS) == expected


def test_a_total_derivative_and_a_dilation(status):
    free = 'kind = "noether"\nL = "m*(v**2 + w**2)/2 - b/(r**2 + phi**2)"\nvelocities = ["v", "w"]\n'
    assert status(free + 'dq = ["r/2", "phi/2"]\ndt = "t"', space=PLANE, symbols=SYMBOLS) == "proved"
    assert status(free + 'dq = ["r", "phi"]\ndt = "t"', space=PLANE, symbols=SYMBOLS) == "refuted"
    boost = 'kind = "noether"\nL = "m*(v**2 + w**2)/2"\nvelocities = ["v", "w"]\ndq = ["t", "0"]\n'
    assert status(boost + 'f = "m*r"\ncharge = "m*v*t - m*r"', space=PLANE, symbols=SYMBOLS) == "proved"
    assert status(boost + 'charge = "m*v*t"', space=PLANE, symbols=SYMBOLS) == "refuted"


def test_a_variation_may_depend_on_velocities(status):
    """The Runge–Lenz vector's x component, as a charge of the Kepler problem (velocity-dependent variation)."""
    kepler = 'kind = "noether"\nL = "(v**2 + w**2)/2 + 1/sqrt(x**2 + y**2)"\nvelocities = ["v", "w"]\n'
    space = 'q = ["x", "y"]\np = ["px", "py"]\n'
    right = 'dq = ["-y*w", "2*x*w - y*v"]\nf = "x*w**2 - y*v*w + x/sqrt(x**2 + y**2)"\n'
    assert status(kepler + right, space=space) == "proved"
    assert status(kepler + right.replace("2*x*w", "x*w"), space=space) == "refuted"
    assert status(kepler + right + 'charge = "x*w**2 - y*v*w - x/sqrt(x**2 + y**2)"', space=space) == "proved"


LINE = 'q = ["q"]\np = ["p"]\n'
FUNCTIONS = 'x = "function"\nu = "function"\nf = "function"\ng = "function"\nc = "positive"\ny = "real"\nk = "positive"'


@pytest.mark.parametrize(
    ("solution", "equations", "expected"),
    [
        ('"x(t)" = "exp(-k*t)*cos(t)"', ["D(x(t), t, 2) + 2*k*D(x(t), t) + (1 + k**2)*x(t)", "x(0) - 1"], "proved"),
        ('"x(t)" = "exp(-k*t)*cos(t)"', ["D(x(t), t, 2) + 2*k*D(x(t), t) + (1 + k**2)*x(t)", "x(0)"], "refuted"),
        ('"u(y, t)" = "f(y - c*t) + g(y + c*t)"', ["D(u(y, t), t, 2) - c**2*D(u(y, t), y, 2)"], "proved"),
        ('"u(y, t)" = "f(y - c*t) + g(y + 2*c*t)"', ["D(u(y, t), t, 2) - c**2*D(u(y, t), y, 2)"], "refuted"),
        ('"x(t)" = "log(t)"', ["x(2*t) - x(t) - log(2)", "D(x(t), t) - 1/t", "sqrt(x(t))**2 - x(t)"], "proved"),
    ],
)
def test_solutions(status, solution, equations, expected):
    claim = f'kind = "solves"\nsolution = {{ {solution} }}\nequations = {equations!r}'
    assert status(claim, space=LINE, symbols=FUNCTIONS) == expected


@pytest.mark.parametrize(
    ("solution", "equation", "message"),
    [
        ('"x(t)" = "x(t)"', "x(t)", "contains 'x' itself"),
        ('"x(2*t)" = "1"', "x(t)", "different names"),
        ('"x(t)" = "1"', "u(t, y)", "none of the functions"),
        ('"x(t)" = "log(t)"', "x(0)", "no point of the domain"),
        ("", "x(t)", "at least one function"),
    ],
)
def test_faults_of_solutions(ask, solution, equation, message):
    claim = f'kind = "solves"\nsolution = {{ {solution} }}\nequations = ["{equation}"]'
    with pytest.raises((InputError, AssertionError), match=message):
        ask(claim, space=LINE, symbols=FUNCTIONS)


def test_one_of_equations_and_accelerations_is_needed(ask):
    with pytest.raises(InputError, match="either 'equations'"):
        ask(f'kind = "euler_lagrange"\n{CENTRAL}', space=PLANE, symbols=SYMBOLS)
