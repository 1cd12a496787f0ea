"""A name may stand in a formula and show nowhere, by what is declared of it: in 0·log(t) of a positive t.

So may the call of a function, in 0·x(0).
"""

import pytest

from canon import PhaseSpace, Transformation, compose, verify
from canon.errors import InputError
from canon.mechanics.formulas import substituted

LINE = 'q = ["q"]\np = ["p"]'
MAPPED = LINE + '\nQ = ["Q"]\nP = ["P"]'
OSCILLATOR = "p**2/2 + q**2/2"
TERMS = (("positive", "0*log({})"), ("nonzero", "0/{}"), ("negative", "0*sqrt(-{})"))
WAVES = 'q = ["sqrt(2*P)*sin(Q)"]\np = ["sqrt(2*P)*cos(Q)"]'


@pytest.mark.parametrize(("word", "term"), TERMS)
def test_a_formula_knows_the_names_whose_conditions_are_granted(word, term):
    space = PhaseSpace("x", "px", symbols={"a": word, "b": "positive"})
    a = space.symbols("a")
    assert a in space.formula(f"x + {term.format('a')}").symbols
    assert a not in space.formula("x + 0*a + 0*sin(a) + 0*sqrt(b)").symbols


@pytest.mark.parametrize(("word", "term"), TERMS)
def test_what_has_no_time_has_none_hidden(ask, word, term):
    hidden = term.format("t")
    symbols, H = f't = "{word}"\nP = "positive"', f'H = "{OSCILLATOR} + {hidden}"'
    for claim in ('kind = "normal_form"\norder = 3\nN = {}',
                  'kind = "action"\ncoordinate = "q"\nenergy = "E"\nequals = "2*pi*E"',
                  'kind = "hamilton_jacobi"\nW = "a*q"\nconstants = ["a"]\nenergy = "a**2/2"'):  # fmt: skip
        with pytest.raises(InputError, match="depends on t"):
            ask(claim, space=LINE, symbols=symbols, hamiltonian=H)
    claim = 'kind = "action_angle"\nangle_period = "2*pi"'
    with pytest.raises(InputError, match="without time"):
        ask(claim, space=MAPPED, symbols=symbols, hamiltonian=H, transformation=WAVES)
    claim = f'kind = "action"\ncoordinate = "q"\nenergy = "E"\nequals = "2*pi*E + {hidden}"'
    with pytest.raises(InputError, match="energy and constants"):
        ask(claim, space=LINE, symbols=symbols, hamiltonian=f'H = "{OSCILLATOR}"')


@pytest.mark.parametrize(("word", "term"), TERMS)
def test_what_a_claim_names_is_in_no_other_formula_hidden(ask, word, term):
    hidden = term.format("a")
    symbols, H = f'a = "{word}"', f'H = "p**2/2 + {hidden}"'
    claim = 'kind = "euler_lagrange"\nL = "v**2/2 + {}"\nvelocities = ["v"]\naccelerations = ["a"]\nequations = ["a"]'
    with pytest.raises(InputError, match="a is in L too"):
        ask(claim.format(hidden), space=LINE, symbols=symbols)
    with pytest.raises(InputError, match="a is in H too"):
        ask('kind = "legendre"\nL = "a**2/2"\nvelocities = ["a"]', space=LINE, symbols=symbols, hamiltonian=H)
    claim = 'kind = "hamilton_jacobi"\nW = "a*q"\nconstants = ["a"]\nenergy = "a**2/2"'
    with pytest.raises(InputError, match="a is in H too"):
        ask(claim, space=LINE, symbols=symbols, hamiltonian=H)


@pytest.mark.parametrize(("word", "term"), TERMS)
def test_a_motion_is_given_of_what_is_hidden(ask, word, term):
    claim = (
        'kind = "average"\nf = "q**2 + {}"\nequals = "1/2"\nmotion = {{q = "sin(s)", p = "cos(s)", t = "s"}}\n'
        'parameter = "s"\nfrom = "0"\nto = "2*pi"'
    )
    with pytest.raises(InputError, match="the motion of x is missing"):
        ask(claim.format(term.format("x")), space='q = ["q", "x"]\np = ["p", "px"]', symbols=f'x = "{word}"')


def test_a_symmetry_puts_new_names_where_old_ones_are_hidden(ask, status):
    mirror, turned = 'Q = ["-q"]\nP = ["-p"]', {"space": MAPPED, "hamiltonian": 'H = "p**2/2 + {}"'}
    for word, term, whole in (("positive", "0*log(q)", False), ("nonzero", "0/q", True)):
        file = {**turned, "hamiltonian": turned["hamiltonian"].format(term), "symbols": f'q = "{word}"'}
        if whole:
            assert status('kind = "symmetry"', transformation=mirror, **file) == "proved"
            continue
        with pytest.raises(InputError, match="no point of the domain"):
            ask('kind = "symmetry"', transformation=mirror, **file)


def test_a_composed_map_keeps_what_is_granted():
    space = PhaseSpace("q", "p", new=("Q", "P"), positive="eps")
    (eps,) = space.parameters
    first = Transformation(space, Q=[space.formula("q + eps*p + 0*log(eps)")], P=[space.formula("p")])
    second = Transformation(space, Q=[space.formula("q")], P=[space.formula("p")])
    for made in (compose(first, second), compose(second, first)):
        with pytest.raises(InputError, match="not analytic at eps = 0"):
            verify(made.canonical(order=(eps, 1)))
    assert substituted(space.formula("q + 0/eps"), {}).granted


def test_what_is_granted_is_kept_once():
    """Else a map that is composed with itself would keep twice as much each time."""
    space = PhaseSpace("q", "p", new=("Q", "P"), positive="m")
    made = step = Transformation(space, Q=[space.formula("q + p/m")], P=[space.formula("p + q/m - q/m")])
    for _ in range(20):
        made = compose(made, step)
    assert len(made.Q[0].granted) < 50


@pytest.mark.parametrize("there", ["0*x(0)", "x(0) - x(0)", "0*x(-t**2)", "0*D(x(0*t + 0), t)", "0*exp(x(0))"])
@pytest.mark.parametrize(("solution", "left_out"), [("t + 0*log(t)", True), ("t + 0*sqrt(t + t)", True), ("t", False)])
def test_a_function_that_is_called_has_a_value(ask, status, there, solution, left_out):
    claim = f'kind = "solves"\nsolution = {{"x(t)" = "{solution}"}}\nequations = ["x(t) - t + {there}"]'
    for written, definitions in ((claim, ""), (claim.replace(there, "part"), f'part = "{there}"')):
        file = {"space": LINE, "symbols": 'x = "function"', "definitions": definitions}
        if not left_out:
            assert status(written, **file) == "proved"
            continue
        with pytest.raises(InputError, match="no point of the domain"):
            ask(written, **file)
