"""Hamilton's equations, Hamiltonian fields, Legendre transforms, infinitesimal transformations, Lie series."""

import pytest

from canon.errors import InputError

LINE = 'q = ["q"]\np = ["p"]\n'


def test_equations_of_motion(ask):
    right, wrong = ask(
        'kind = "equations_of_motion"\nqdot = ["p/m"]\npdot = ["-D(V(q), q)"]',
        'kind = "equations_of_motion"\nqdot = ["p/m"]\npdot = ["D(V(q), q)"]',
        space=LINE,
        symbols='m = "positive"\nV = "function"',
        hamiltonian='H = "p**2/(2*m) + V(q)"',
    )
    assert right.status == "proved"
    assert wrong.status == "refuted"
    assert "V" in wrong.witness


@pytest.mark.parametrize(
    ("dq", "dp", "expected"), [("-y", "-py", "proved"), ("y", "py", "refuted"), ("-y", "py", "refuted")]
)
def test_infinitesimal_rotation(status, dq, dp, expected):
    claim = f'kind = "infinitesimal"\ngenerator = "x*py - y*px"\ndq = ["{dq}", "x"]\ndp = ["{dp}", "px"]'
    assert status(claim, space='q = ["x", "y"]\np = ["px", "py"]\n') == expected


@pytest.mark.parametrize(
    ("qdot", "pdot", "H"),
    [
        ("p", "-sin(q)", "p**2/2 - cos(q)"),
        ("p/sqrt(1 + p**2)", "-1/(1 + q**2)", "sqrt(p**2 + 1) + atan(q)"),
        ("q*p", "-p**2/2", "p**2*q/2"),
        ("p", "-D(V(q), q)", "p**2/2 + V(q)"),
    ],
)
def test_a_hamiltonian_is_found(ask, qdot, pdot, H):
    claim = f'kind = "hamiltonian_field"\nqdot = ["{qdot}"]\npdot = ["{pdot}"]'
    (verdict,) = ask(claim, space=LINE, symbols='V = "function"')
    assert verdict.status == "proved"
    assert verdict.detail["H"] == H


def test_a_field_with_friction_has_none(status):
    claim = 'kind = "hamiltonian_field"\nqdot = ["p"]\npdot = ["-q - g*p"]'
    assert status(claim, space=LINE, symbols='g = "positive"') == "refuted"
    assert status(claim + '\nH = "p**2/2 + q**2/2"', space=LINE, symbols='g = "positive"') == "refuted"


@pytest.mark.parametrize(
    ("H", "L", "expected"),
    [
        ("p**2/(2*m) + V(q)", "m*v**2/2 - V(q)", "proved"),
        ("p**2/(2*m) - V(q)", "m*v**2/2 - V(q)", "refuted"),
        ("0", "v", "refuted"),  # singular
        ("3*p**(4/3)/4", "v**4/4", "proved"),
        ("p**2/(2*m)", "m*v**2/2 + 1", "refuted"),
    ],
)
def test_legendre(status, H, L, expected):
    claim = f'kind = "legendre"\nL = "{L}"\nvelocities = ["v"]'
    symbols = 'm = "positive"\nV = "function"'
    assert status(claim, space=LINE, symbols=symbols, hamiltonian=f'H = "{H}"') == expected


def lie(generator: str, f: str, equals: str, order: int | None = None) -> str:
    text = f'kind = "lie_series"\ngenerator = "{generator}"\nparameter = "s"\nf = "{f}"\nequals = "{equals}"'
    return text if order is None else f"{text}\norder = {order}"


@pytest.mark.parametrize(
    ("claim", "expected"),
    [
        (lie("(p**2 + q**2)/2", "q", "q*cos(s) + p*sin(s)"), "proved"),
        (lie("(p**2 + q**2)/2", "q", "q*cos(s) - p*sin(s)"), "refuted"),
        (lie("p*q**2", "q", "q/(1 - q*s)"), "proved"),
        (lie("p", "q", "q + s + s**15"), "refuted"),
        (lie("p", "q", "q + abs(1 + s) - 1"), "proved"),  # the same germ at 0, another function for s < −1
        (lie("p", "q", "q + s + (sqrt((1 - s)**2) - 1 + s)*s**20"), "proved"),
        (lie("p", "q", "q + abs(1 + s)"), "refuted"),
        (lie("p", "q**2", "(q + s)**2", 2), "proved"),
        (lie("p", "q**2", "q**2 + 2*q*s", 1), "proved"),
        (lie("p", "q**2", "(q + s)**2", 1), "refuted"),  # a term above the order
        (lie("p", "q**2", "q**2", 1), "refuted"),
        (lie("p", "q**2", "q**2", 0), "proved"),
    ],
)
def test_lie_series_as_germs(status, claim, expected):
    assert status(claim, space=LINE) == expected


@pytest.mark.parametrize("equals", ["q*sin(s)/s + s", "q + s + abs(s)*s", "q + sqrt(s)"])
def test_a_lie_series_is_analytic_at_zero(status, equals):
    with pytest.raises(InputError, match="s = 0"):
        status(lie("p", "q", equals), space=LINE)


def test_the_parameter_is_no_variable(ask):
    with pytest.raises((InputError, AssertionError)):
        ask(lie("p", "q", "q").replace('"s"', '"q"'), space=LINE)


def test_time_may_be_the_parameter_of_a_flow(ask):
    """exp(t {·, H}) q is the motion; and a map may be truncated in time."""
    flow, early, late = ask(
        'kind = "lie_series"\ngenerator = "p**2/2 + q**2/2"\nparameter = "t"\nf = "q"\nequals = "q*cos(t) + p*sin(t)"',
        'kind = "canonical"\norder = ["t", 1]',
        'kind = "canonical"\norder = ["t", 2]',
        transformation='Q = ["q + t*p"]\nP = ["p - t*q"]',
    )
    assert (flow.status, early.status, late.status) == ("proved", "proved", "refuted")


def test_a_hessian_that_only_poles_could_make_vanish(status):
    """m c³/(c² − v²)^(3/2): no zero whatever m and c are, though c² − v² has no sign by itself."""
    claim = 'kind = "legendre"\nL = "-m*c**2*sqrt(1 - v**2/c**2)"\nvelocities = ["v"]'
    sections = {"symbols": 'm = "positive"\nc = "positive"', "hamiltonian": 'H = "sqrt(p**2*c**2 + m**2*c**4)"'}
    assert status(claim, space=LINE, **sections) == "proved"
    weak = {**sections, "symbols": 'm = "nonnegative"\nc = "positive"'}
    assert status(claim, space=LINE, **weak) != "proved"

    claim = 'kind = "euler_lagrange"\nL = "{}"\nvelocities = ["v"]\nqddot = ["0"]'
    assert status(claim.format("(v + abs(v))**2")) == "supported"
    assert status(claim.format("abs(v)*v**2")) == "proved"


def test_a_legendre_transform_of_a_part(status):
    claim = 'kind = "legendre"\nL = "(v + abs(v))**2/8"\nvelocities = ["v"]'
    assert status(claim, hamiltonian='H = "p**2/2"') == "supported"


@pytest.mark.parametrize("where", ["q > d", "q > V(q)", "q > n"])
@pytest.mark.parametrize(
    "keys",
    [
        'kind = "legendre"\nL = "v**2/4*(1 - sign(q - 10**9))"\nvelocities = ["v"]',
        'kind = "euler_lagrange"\nL = "v**2/4*(1 - sign(q - 10**9))"\nvelocities = ["v"]\nqddot = ["0"]',
        'kind = "hamilton_jacobi"\nS = "c*(abs(q - 10**9) - q + 10**9)"\nconstants = ["c"]',
    ],
)
def test_what_is_regular_for_some_parameters_need_not_be_for_others(status, where, keys):
    """Beyond 10⁹ the determinant is 0, and for d = 10¹⁰ the domain is there: too far to be sampled."""
    sections = {"symbols": 'd = "real"\nV = "function"\nn = "integer"', "domain": f'where = ["{where}"]'}
    H = 'H = "0*p"' if "jacobi" in keys else 'H = "p**2/2"'
    assert status(keys, space=LINE, hamiltonian=H, **sections) == "supported"


def test_an_integral_on_a_surface_that_hangs_on_a_parameter(status):
    """(q − 1) is 0 on the surface q = d for d = 1."""
    claim = 'kind = "hamilton_jacobi"\nS = "c*(q - 1)**2/2"\nconstants = ["c"]'
    sections = {"space": LINE, "hamiltonian": 'H = "0*p"', "symbols": 'd = "real"'}
    assert status(claim, domain='on = ["q - d"]', **sections) == "supported"
    assert status(claim, domain='on = ["q - 2"]', **sections) == "proved"
    assert status(claim, domain='where = ["q > d"]', **sections) == "proved"
