"""`canonical`, `canonical_when`, `fundamental_brackets`: brackets, scales, orders, surfaces, domains."""

import math
from fractions import Fraction

import pytest

from canon.errors import InputError

CANONICAL = 'kind = "canonical"'


def forward(Q: str, P: str) -> str:
    return f'Q = ["{Q}"]\nP = ["{P}"]'


def backward(q: str, p: str) -> str:
    return f'q = ["{q}"]\np = ["{p}"]'


@pytest.mark.parametrize(
    ("Q", "P", "expected"),
    [
        ("p", "-q", "proved"),
        ("p", "q", "refuted"),
        ("q", "q", "refuted"),
        ("q + p**3", "p", "proved"),
        ("q + q**2", "p", "refuted"),
        ("log(sin(p)/q)", "q*cot(p)", "proved"),  # Goldstein, Poole and Safko (2002), exercise 9.5
        ("abs(q)", "p*abs(q)/q", "proved"),
        ("abs(q)", "p", "refuted"),  # right for q > 0 alone
        ("q*(2 + sign(q))", "p/(2 + sign(q))", "proved"),
        ("q*1001/1000", "p", "refuted"),
        ("(q + 1j*p)/sqrt(2)", "1j*(q - 1j*p)/sqrt(2)", "proved"),
    ],
)
def test_one_degree_of_freedom(status, Q, P, expected):
    assert status(CANONICAL, transformation=forward(Q, P)) == expected


def test_a_map_given_backward_is_judged_by_its_inverse(ask):
    polar = backward("sqrt(2*P)*sin(Q)", "sqrt(2*P)*cos(Q)")
    plain, scaled = ask(CANONICAL, CANONICAL + '\nscale = "1/4"', transformation=backward("2*Q", "2*P"))
    assert ask(CANONICAL, transformation=polar)[0].status == "proved"
    assert plain.status == "refuted"
    assert plain.detail["scale"] == "1/4"
    assert scaled.status == "proved"


def test_a_refutation_names_the_constant_scale(ask):
    (verdict,) = ask(CANONICAL, transformation=forward("2*q", "3*p"))
    assert verdict.status == "refuted"
    assert verdict.detail["scale"] == "6"
    assert verdict.witness is not None


@pytest.mark.parametrize(
    ("symbols", "scale", "expected"),
    [('a = "positive"', "a", "proved"), ('a = "nonzero"', "a", "proved"), ('a = "positive"', "2*a", "refuted")],
)
def test_a_scale_of_parameters(status, symbols, scale, expected):
    claim = f'{CANONICAL}\nscale = "{scale}"'
    assert status(claim, symbols=symbols, transformation=forward("a*q", "p")) == expected


@pytest.mark.parametrize("scale", ["a", "a - 1", "1 - a**2", "0"])
def test_a_scale_that_may_vanish_is_no_scale(status, scale):
    with pytest.raises(InputError, match="zero"):
        status(f'{CANONICAL}\nscale = "{scale}"', symbols='a = "real"', transformation=forward("a*q", "p"))


def test_a_polynomial_without_real_roots_is_a_scale(status):
    claim = f'{CANONICAL}\nscale = "1 - h**6/72 + h**8/576"'
    assert status(claim, symbols='h = "real"', transformation=forward("q*(1 - h**6/72 + h**8/576)", "p")) == "proved"


@pytest.mark.parametrize(("order", "expected"), [(0, "proved"), (1, "proved"), (2, "refuted"), (3, "refuted")])
def test_a_truncated_map(ask, order, expected):
    (verdict,) = ask(f'{CANONICAL}\norder = ["eps", {order}]', transformation=forward("q + eps*p", "p - eps*q"))
    assert verdict.status == expected
    if expected == "refuted":
        assert verdict.detail["fails_at_order"] == 2
        assert verdict.detail["value"] == "1"


def test_a_truncated_map_with_a_bound_on_its_parameter(status):
    sections = {"transformation": forward("q + eps*p", "p - eps*q"), "symbols": 'eps = "real"'}
    near = {**sections, "domain": 'where = ["0 < eps < 1/10"]'}
    assert status(f'{CANONICAL}\norder = ["eps", 1]', **near) == "proved"
    with pytest.raises(InputError, match="eps = 0"):
        status(f'{CANONICAL}\norder = ["eps", 1]', **{**sections, "domain": 'where = ["eps > 1"]'})


@pytest.mark.parametrize("Q", ["q + sqrt(eps)*p", "q + p/eps", "q + abs(eps)*p"])
def test_a_truncated_map_must_be_analytic_at_zero(status, Q):
    with pytest.raises(InputError, match="eps"):
        status(f'{CANONICAL}\norder = ["eps", 1]', transformation=forward(Q, "p"))


GOLDSTEIN = {"symbols": 'a = "real"\nb = "real"', "transformation": forward("q**a*cos(b*p)", "q**a*sin(b*p)")}


@pytest.mark.parametrize(
    ("a", "b", "expected"), [("1/2", "2", "proved"), ("1/2", "3", "refuted"), ("-1/2", "2", "refuted")]
)
def test_canonical_at_values_of_parameters(status, a, b, expected):
    """Goldstein, Poole and Safko (2002), exercise 9.13."""
    assert status(f'kind = "canonical_when"\nsolutions = [{{a = "{a}", b = "{b}"}}]', **GOLDSTEIN) == expected


@pytest.mark.parametrize(
    ("d", "expected"),
    [
        ("(1 + b*c)/a", "proved"),
        ("(1 - b*c)/a", "refuted"),
        ("(1 + b*c)/a + 1/1000", "refuted"),
        ("(1 + b*c)/sqrt(a**2)", "refuted"),  # a may be negative
    ],
)
def test_a_quotient_of_real_names_is_real_where_it_is_defined(status, d, expected):
    """Goldstein, Poole and Safko (2002), exercise 9.3, of linear maps: the solution restricts the domain to a != 0."""
    claim = f'kind = "canonical_when"\nsolutions = [{{d = "{d}"}}]'
    names = 'a = "real"\nb = "real"\nc = "real"\nd = "real"'
    assert status(claim, symbols=names, transformation=forward("a*q + b*p", "c*q + d*p")) == expected


def test_canonical_when_is_refuted_where_every_value_will_do(ask):
    (verdict,) = ask(
        'kind = "canonical_when"\nsolutions = [{a = "1"}]',
        symbols='a = "real"',
        transformation=forward("q + a*p", "p"),
    )
    assert verdict.status == "refuted"
    assert verdict.witness is None


@pytest.mark.parametrize("value", ["-1/2", "0", "1j"])
def test_a_solution_must_satisfy_what_is_assumed(status, value):
    with pytest.raises(InputError):
        status(
            f'kind = "canonical_when"\nsolutions = [{{a = "{value}"}}]',
            symbols='a = "positive"',
            transformation=forward("a*q", "p"),
        )


@pytest.mark.parametrize(("value", "expected"), [("0", "proved"), ("1", "refuted")])
def test_a_solution_may_lie_on_the_edge_of_what_is_assumed(status, value, expected):
    claim = f'kind = "canonical_when"\nsolutions = [{{a = "{value}"}}]'
    assert status(claim, symbols='a = "nonnegative"', transformation=forward("q + a*p", "p + a*q")) == expected


def test_the_witness_at_a_solution_is_data(ask):
    def at(value):
        (verdict,) = ask(
            f'kind = "canonical_when"\nsolutions = [{{a = "{value}"}}]',
            symbols='a = "real"\nth = "real"',
            transformation=forward("a*q", "p"),
        )
        assert verdict.detail["at"] == {"a": value}
        return verdict.witness

    cosine, square = at("cos(th)"), at("th**2")
    assert float(cosine["a"]) == pytest.approx(math.cos(Fraction(cosine["th"])), rel=1e-14)
    assert len(cosine["a"]) > 25
    assert Fraction(square["a"]) == Fraction(square["th"]) ** 2
    assert at("3/2")["a"] == "3/2"


def test_a_solution_must_leave_the_formulas_defined(status):
    with pytest.raises(InputError):
        status(
            'kind = "canonical_when"\nsolutions = [{a = "1"}]',
            symbols='a = "real"',
            transformation=forward("q/(a - 1)", "p"),
        )


def test_one_failure_is_not_generic_on_both_sides_of_an_absolute_value(status):
    """Canonical for every a > 0, constant for a < 0."""
    claim = 'kind = "canonical_when"\nsolutions = [{a = "1"}]'
    sections = {"symbols": 'a = "real"', "transformation": forward("q*(abs(a) + a)/(2*a)", "p")}
    assert status(claim, **sections) == "supported"


@pytest.mark.parametrize(
    ("symbol", "Q", "domain"),
    [
        ('a = "real"', "sqrt(q**2)", 'where = ["q > a"]'),
        ('a = "real"', "q + (a - 1)*(abs(q) - q)", 'where = ["q > a"]'),
        ('a = "nonzero"', "q**2/(2*a)", 'on = ["q - abs(a)"]'),
        ('a = "integer"', "q*(-1)**(a + 1)", ""),
    ],
)
def test_one_failure_is_not_generic_where_the_domain_hangs_on_the_parameter(status, symbol, Q, domain):
    """Canonical for every a > 0, or every odd one; not for some others."""
    claim = 'kind = "canonical_when"\nsolutions = [{a = "1"}]'
    assert status(claim, symbols=symbol, transformation=forward(Q, "p"), domain=domain) == "supported"


def test_one_failure_is_generic_where_the_bracket_is_analytic_or_the_domain_fixed(status):
    claim = 'kind = "canonical_when"\nsolutions = [{a = "1"}]'
    for Q, domain in (("a*q", 'where = ["q > a"]'), ("q + (a - 1)*(abs(q) - q)", ""), ("a*q", 'on = ["q - 1"]')):
        sections = {"symbols": 'a = "real"', "transformation": forward(Q, "p"), "domain": domain}
        assert status(claim, **sections) == "proved"


def test_a_generated_map_is_canonical_at_all_values(status):
    claim = 'kind = "canonical_when"\nsolutions = [{a = "1"}]'
    assert status(claim, symbols='a = "real"', generating_function='type = 2\nF = "a*q*P"') == "refuted"


def test_what_is_assumed_of_a_new_variable_restricts_the_domain(status):
    claim = 'kind = "identity"\nlhs = "sqrt(Q**2)"\nrhs = "-q"'
    sections = {"transformation": forward("-q", "-p")}
    assert status(claim, symbols='Q = "positive"', **sections) == "proved"
    assert status(claim, domain='where = ["Q > 0"]', **sections) == "proved"
    assert status(claim, **sections) == "refuted"


def test_brackets_one_by_one(ask):
    (verdict,) = ask('kind = "fundamental_brackets"', transformation=forward("p", "-q"))
    assert verdict.detail["brackets"] == {"{Q, P}": "proved"}


FOUR_TO_THREE = """q = ["u0", "u1", "u2", "u3"]
p = ["w0", "w1", "w2", "w3"]
Q = ["x", "y", "z"]
P = ["px", "py", "pz"]"""
KS = """Q = ["2*(u0*u2 + u1*u3)", "2*(u2*u3 - u0*u1)", "u0**2 - u1**2 - u2**2 + u3**2"]
P = ["(u0*w2 + u1*w3 + u2*w0 + u3*w1)/(2*R)", "(-u0*w1 - u1*w0 + u2*w3 + u3*w2)/(2*R)",
     "(u0*w0 - u1*w1 - u2*w2 + u3*w3)/(2*R)"]"""
RADIUS = 'R = "u0**2 + u1**2 + u2**2 + u3**2"'


def test_regularisation_in_four_dimensions_is_canonical_on_its_surface_alone(status):
    """Kustaanheimo and Stiefel (1965): eight variables to six, canonical where the bilinear relation holds."""
    sections = {"space": FOUR_TO_THREE, "definitions": RADIUS, "transformation": KS}
    assert status(CANONICAL, **sections) == "refuted"
    assert status(CANONICAL, domain='on = ["u0*w3 - u1*w2 + u2*w1 - u3*w0"]', **sections) == "proved"


def test_the_domain_decides(status):
    sections = {"transformation": forward("sqrt(q**2)", "p")}
    assert status(CANONICAL, domain='where = ["q > 0"]', **sections) == "proved"
    assert status(CANONICAL, domain='where = ["q < 0"]', **sections) == "refuted"
    with pytest.raises(InputError, match="empty"):
        status(CANONICAL, domain='where = ["q > 1", "q < 0"]', **sections)
