"""0*log(x) is 0, but it says x > 0: a name that stands in such a term is one that the formula contains."""

import pytest

from canon.errors import InputError
from canon.mechanics.phase_space import PhaseSpace
from tests.claims.test_action import LINE, action_claim

OSCILLATOR = 'H = "p**2/2 + q**2/2"'


def _along(f="q**2", equals="1/2", to="2*pi", **motion):
    moves = {"q": "sin(s)", "p": "cos(s)", "t": "s", **motion}
    table = ", ".join(f'"{name}" = "{formula}"' for name, formula in moves.items())
    return (
        f'kind = "average"\nf = "{f}"\nequals = "{equals}"\nmotion = {{{table}}}\nparameter = "s"\n'
        f'from = "0"\nto = "{to}"'
    )


def test_a_formula_knows_the_names_of_its_conditions():
    formula = PhaseSpace("x y", "px z").formula("x + 0*log(y) + 0/z")
    assert {str(symbol) for symbol in formula.symbols} == {"x", "y", "z"}
    assert {str(symbol) for symbol in formula.expr.free_symbols} == {"x"}


@pytest.mark.parametrize("term", ["0*log(q - 5)", "0/q", "0*gamma(t)", "0*log(t - 7)"])
def test_a_motion_is_given_in_its_parameter_alone(ask, term):
    assert ask(_along(), space=LINE, hamiltonian=OSCILLATOR)[0].status == "proved"
    claims = (_along(q=f"sin(s) + {term}"), _along(p=f"cos(s) + {term}"), _along(t=f"s + {term}"))
    for claim in (*claims, _along(equals=f"1/2 + {term}"), _along(to=f"2*pi + {term}")):
        with pytest.raises(InputError, match="moves: write it"):
            ask(claim, space=LINE, hamiltonian=OSCILLATOR)
    for claim in (_along(equals="1/2 + 0*sqrt(s + 1)"), _along(to="2*pi + 0/(s - 7)")):
        with pytest.raises(InputError):
            ask(claim, space=LINE, hamiltonian=OSCILLATOR)


def test_what_else_moves_is_given_too(ask, status):
    space = 'q = ["q", "x"]\np = ["p", "px"]'
    for term in ("0*log(x)", "0/(x - q)"):
        with pytest.raises(InputError, match="the motion of x is missing"):
            ask(_along(f"q**2 + {term}"), space=space)
    assert status(_along(), space=space, domain='where = ["x > 0"]') == "proved"
    assert status(_along(), space=space, domain='where = ["x > q"]') == "undecided"


@pytest.mark.parametrize("term", ["0*log(t)", "0/(t - 1)", "0*log(q)", "0/p"])
def test_an_action_is_a_function_of_energy_and_constants(ask, term):
    with pytest.raises(InputError, match="a function of energy and constants"):
        ask(action_claim(f"2*pi*E + {term}"), space=LINE, hamiltonian=OSCILLATOR)


@pytest.mark.parametrize(("term", "said"), [("0*log(t)", "depends on t"), ("0*log(t - q)", "depends on t"),
                                            ("0*log(E - 5)", "E is in H too")])  # fmt: skip
def test_an_action_is_one_of_an_H_without_time_and_its_own_name(ask, term, said):
    with pytest.raises(InputError, match=said):
        ask(action_claim("2*pi*E"), space=LINE, symbols='E = "real"', hamiltonian=f'H = "p**2/2 + q**2/2 + {term}"')


@pytest.mark.parametrize("term", ["0*log(x)", "0/x", "0/(x - 1)"])
def test_a_limit_and_an_end_are_free_of_what_varies(ask, term):
    limit = 'kind = "limit"\nf = "x"\nvariable = "x"\nto = "{}"\nequals = "{}"'
    integral = 'kind = "integral"\nf = "x"\nvariable = "x"\nfrom = "{}"\nto = "2"\nequals = "{}"'
    for claim in (limit.format(f"1 + {term}", "1"), limit.format("1", f"1 + {term}"),
                  integral.format(f"0 + {term}", "2"), integral.format("0", f"2 + {term}")):  # fmt: skip
        with pytest.raises(InputError, match=r"can't be in|doesn't depend on"):
            ask(claim, space=LINE)


def test_functions_of_the_coordinates_hold_no_velocities(ask, status):
    space = 'q = ["x", "y"]\np = ["px", "py"]'
    claim = 'kind = "constraint"\nvelocities = ["vx", "vy"]\n{}'
    for rest in ('forms = ["vx"]\nintegrals = ["x + 0*log(vx)"]',
                 'functions = ["x + 0*log(vx)"]\ndetermined = true\nL = "(vx**2 + vy**2)/2"'):  # fmt: skip
        with pytest.raises(InputError, match="contains velocities"):
            ask(claim.format(rest), space=space)
    rest = 'functions = ["x"]\ndetermined = true\nL = "(vx**2 + vy**2)/2 + {}"'
    assert status(claim.format(rest.format("0/vy")), space=space) == "proved"
    with pytest.raises(InputError, match="no point of the domain"):  # where x = 0 along the motion, vx = 0
        ask(claim.format(rest.format("0/vx")), space=space)


@pytest.mark.parametrize("term", ["0*elliptic_e(g)", "0*elliptic_f(pi/2, g)", "0*lambertw(-g*exp(-1))"])
def test_a_function_is_analytic_at_what_is_fixed(ask, term):
    """E(1) and W(-1/e) have values, but what isn't analytic there has no place in the domain."""
    space = {"space": LINE, "symbols": 'g = "positive"'}
    fixed, inside = {"fixed": '{g = "1"}'}, term.replace("g", "g/2")
    claims = ((f"2*pi*E + {term}", "g*q**2"), ("2*pi*E", f"g*q**2 + {term}"))
    for equals, potential in claims:
        sections = {**space, "hamiltonian": f'H = "(p**2 + {potential})/2"'}
        with pytest.raises(InputError, match="analytic"):
            ask(action_claim(equals, **fixed), **sections)
        sections["hamiltonian"] = sections["hamiltonian"].replace(term, inside)
        assert ask(action_claim(equals.replace(term, inside), **fixed), **sections)[0].status == "proved"
