"""Complete integrals: course section 14.1 (Goldstein, Poole and Safko 2002, chapter 10)."""

import pytest
import sympy as sp

from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.mechanics.hamilton_jacobi import CompleteIntegral
from canon.mechanics.phase_space import PhaseSpace

LINE = 'q = ["q"]\np = ["p"]\n'
OSCILLATOR = {"symbols": 'm = "positive"\nomega = "positive"', "hamiltonian": 'H = "p**2/(2*m) + m*omega**2*q**2/2"'}
TWO_POINT = "m*omega/(2*sin(omega*t))*((q**2 + q0**2)*cos(omega*t) - 2*q*q0)"


def _claim(**keys: str) -> str:
    return 'kind = "hamilton_jacobi"\n' + "\n".join(f"{name} = {value}" for name, value in keys.items())


@pytest.mark.parametrize(
    ("S", "expected"),
    [
        (TWO_POINT, "proved"),
        (TWO_POINT + " + q0**3", "proved"),  # any function of the constant may be added
        (TWO_POINT.replace("- 2*q", "+ 2*q"), "proved"),  # q0 with the other sign
        (TWO_POINT.replace("- 2*q", "- 2001/1000*q"), "refuted"),
        (TWO_POINT + " + t/1000", "refuted"),
        (f"({TWO_POINT.replace('q0', '0')})", "refuted"),  # a solution, but without its constant
    ],
)
def test_the_two_point_function_of_the_oscillator(status, S, expected):
    assert status(_claim(S=f'"{S}"', constants='["q0"]'), space=LINE, **OSCILLATOR) == expected


def test_a_solution_that_is_not_complete_is_refuted_by_an_exact_argument(ask):
    (verdict,) = ask(_claim(S='"sqrt(2*m)*q - t + a**3"', constants='["a"]'), space=LINE, symbols='m = "positive"',
        hamiltonian='H = "p**2/(2*m)"')  # fmt: skip
    assert verdict.status == "refuted"
    assert verdict.witness is None
    assert verdict.detail["determinant"] == "0"


def test_completeness_must_hold_for_all_values_of_parameters(ask):
    sections = {"symbols": 'k = "real"', "hamiltonian": 'H = "p**2/2"'}
    (verdict,) = ask(_claim(S='"(k*a + 1)*q - (k*a + 1)**2*t/2"', constants='["a"]'), space=LINE, **sections)
    assert verdict.status == "supported"  # not at k = 0
    sections["symbols"] = 'k = "nonzero"'
    (verdict,) = ask(_claim(S='"(k*a + 1)*q - (k*a + 1)**2*t/2"', constants='["a"]'), space=LINE, **sections)
    assert verdict.status == "proved"


@pytest.mark.parametrize("slope", ["abs(a) + a", "sqrt(a**2) - a", "asin(sin(a)) - a"])
def test_an_integral_that_is_complete_in_a_part_of_its_domain_alone_is_supported(ask, slope):
    keys = {"W": f'"({slope})*q"', "constants": '["a"]', "energy": f'"({slope})**2/2"'}
    (verdict,) = ask(_claim(**keys), space=LINE, hamiltonian='H = "p**2/2"')
    assert verdict.status == "supported"


def test_the_energy_may_be_an_expression_of_the_constants(status):
    W = '"J/(2*pi)*asin(q*sqrt(m*pi*omega/J)) + q*sqrt(m*omega*J/pi - m**2*omega**2*q**2)/2"'
    for energy, expected in (("omega*J/(2*pi)", "proved"), ("omega*J", "refuted")):
        keys = {"W": W, "constants": '["J"]', "energy": f'"{energy}"'}
        assert status(_claim(**keys), space=LINE, **OSCILLATOR) == expected


def test_conditions_on_momenta_are_read_along_the_integral(ask):
    (verdict,) = ask(_claim(S='"a*q - a**2*t/2 + t/8*abs(a)*0"', constants='["a"]'), space=LINE,
        domain='where = ["p > 3"]', hamiltonian='H = "p**2/2 + (abs(p - 3) - (p - 3))"')  # fmt: skip
    assert verdict.status == "proved"


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"S": '"q"', "W": '"q"', "constants": '["a"]'}, "one of them"),
        ({"S": '"a*q"', "constants": '["a", "b"]'}, "1 constants beside an additive one, not 2"),
        ({"W": '"a*q"', "constants": '["a"]'}, "needs the key 'energy'"),
        ({"W": '"a*q*t"', "constants": '["a"]', "energy": '"a"'}, "not of t"),
        ({"S": '"a*q"', "constants": '["a"]', "energy": '"a"'}, "the energy belongs to W"),
    ],
)
def test_bad_input(keys, words):
    text = f'[phase_space]\n{LINE}[hamiltonian]\nH = "p**2/2"\n[[claim]]\n{_claim(**keys)}'
    reading = read_text(text)
    assert not reading.problems
    with pytest.raises(Exception, match=words):
        verify(reading.claims[0])


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"S": '"a*q + p"', "constants": '["a"]'}, "'p' at column 7 is out of place"),
        ({"S": '"a*q"', "constants": '["q"]'}, "'q' moves, so it is no constant"),
        ({"S": '"a*q"'}, "needs the key 'constants'"),
        ({"W": '"a*q"', "constants": '["a"]', "energy": '"q"'}, "'q' at column 1 is out of place"),
    ],
)
def test_faults_of_the_file(keys, words):
    reading = read_text(f'[phase_space]\n{LINE}[hamiltonian]\nH = "p**2/2"\n[[claim]]\n{_claim(**keys)}')
    assert words in reading.problems[0]["message"]


def test_no_W_where_H_depends_on_time():
    text = f'[phase_space]\n{LINE}[hamiltonian]\nH = "p**2/2 + q*t"\n[[claim]]\n'
    reading = read_text(text + _claim(W='"a*q"', constants='["a"]', energy='"a"'))
    with pytest.raises(Exception, match="there is no W at an energy"):
        verify(reading.claims[0])


@pytest.mark.parametrize("falling", [False, True])
def test_orbits_solve_hamiltons_equations(falling):
    space = PhaseSpace("q", "p", positive="m g")
    q, p, m, g = space.symbols("q p m g")
    a = sp.Symbol("a", real=True)
    if falling:
        W = -((2 * m * (a - m * g * q)) ** sp.Rational(3, 2)) / (3 * m**2 * g)
        integral = CompleteIntegral(space, p**2 / (2 * m) + m * g * q, W, a, energy=a)
    else:
        integral = CompleteIntegral(space, p**2 / (2 * m), a * q - a**2 * space.t / (2 * m), a)
    assert verify(integral.complete()).status == "proved"
    generating = integral.generating_function("b")
    assert verify(generating.transformation().new_hamiltonian(integral.H, 0)).status == "proved"
    assert verify(generating.transformation().new_hamiltonian(integral.H, a)).status == "refuted"
    orbit = integral.orbit("b")
    assert sp.expand(orbit.mapping[q].expr.diff(space.t, 2)) == (-g if falling else 0)
    assert verify(orbit.canonical()).status == "proved"
    assert verify(orbit.new_hamiltonian(integral.H, 0)).status == "proved"


def test_an_orbit_goes_on_behind_its_turning_points():
    space = PhaseSpace("x y", "p_x p_y", positive="m omega g a")
    x, y, p_x, p_y, m, omega, g, a = space.symbols("x y p_x p_y m omega g a")
    b = sp.Symbol("b", real=True)
    swing = x * sp.sqrt(2 * m * a - (m * omega * x) ** 2) / 2 + a / omega * sp.asin(x * omega * sp.sqrt(m / (2 * a)))
    fall = -((2 * m * (b - m * g * y)) ** sp.Rational(3, 2)) / (3 * m**2 * g)
    H = (p_x**2 + p_y**2) / (2 * m) + m * (omega * x) ** 2 / 2 + m * g * y
    orbit = CompleteIntegral(space, H, swing + fall, (a, b), energy=a + b).orbit("u v")
    assert not any(formula.expr.has(sp.Abs) for formula in orbit.formulas)
    assert verify(orbit.canonical()).status == "proved"
    assert verify(orbit.new_hamiltonian(H, 0)).status == "proved"
    assert verify(orbit.new_hamiltonian(H + x**2 / 1000, 0)).status == "refuted"
