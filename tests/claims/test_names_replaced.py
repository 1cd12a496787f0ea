"""What stands in a name's place must be what is assumed of the name: its formulas are simplified by that."""

import pytest

from canon import PhaseSpace, Transformation, verify
from canon.errors import InputError
from canon.mechanics.composition import compose

LINE = 'q = ["q"]\np = ["p"]\n'
ADDED = 'first = ["a"]\nsecond = ["b"]\ncomposition = ["a + b"]'
WHOLE = 'a = "integer"\nb = "integer"'


def group(entry: str, more: str = "", law: str = ADDED) -> str:
    return f'kind = "matrix_group"\nmatrix = [["{entry}"]]\n{law}\n{more}'


@pytest.mark.parametrize(
    ("claim", "symbols"),
    [
        (group("exp(sqrt(a**2))", 'inverse = ["-a"]'), 'a = "positive"'),
        (group("exp(abs(a))"), 'a = "positive"\nb = "negative"'),
        (group("exp(a)*cos(2*pi*a)"), 'a = "integer"\nb = "real"'),
        (group("cos(2*pi*a)", 'inverse = ["a/2"]'), WHOLE),
        (group("exp(sqrt(a**2) - abs(a))"), 'a = "real"\nb = "complex"'),
    ],
)
def test_elements_of_a_group_outside_of_what_is_assumed(ask, claim, symbols):
    with pytest.raises((InputError, AssertionError), match=r"in its place is not seen to be|no point of the domain"):
        ask(claim, space=LINE, symbols=symbols)


@pytest.mark.parametrize(
    ("claim", "symbols", "expected"),
    [
        (group("exp(abs(a))"), 'a = "positive"', "proved"),
        (group("exp(-abs(a))", law=ADDED.replace("a + b", "a - b")), 'a = "positive"', "refuted"),
        (group("a", 'inverse = ["1/a"]', ADDED.replace("a + b", "a*b")), 'a = "nonzero"', "proved"),
        (group("(-1)**a", 'inverse = ["-a"]'), WHOLE, "proved"),
    ],
)
def test_elements_of_a_group_that_are_as_assumed(status, claim, symbols, expected):
    assert status(claim, space=LINE, symbols=symbols) == expected


@pytest.mark.parametrize(
    ("solution", "equation", "symbols"),
    [
        ('"x(t)" = "abs(t)"', "x(t) + x(-t)", 't = "positive"'),
        ('"x(t)" = "sqrt(t**2)"', "x(1) + 1", 't = "negative"'),
        ('"x(n)" = "cos(2*pi*n)"', "x(n/2) - 1", 'n = "integer"'),
        ('"x(n)" = "cos(2*pi*n)"', "x(y) - 1", 'n = "integer"\ny = "real"'),
    ],
)
def test_a_solution_is_not_asked_beyond_its_argument(ask, solution, equation, symbols):
    claim = f'kind = "solves"\nsolution = {{{solution}}}\nequations = ["{equation}"]'
    with pytest.raises((InputError, AssertionError), match=r"in its place is not seen to be|no point of the domain"):
        ask(claim, space=LINE, symbols=f'{symbols}\nx = "function"')


def test_a_solution_at_arguments_that_are_as_assumed(status):
    claim = 'kind = "solves"\nsolution = {"x(n)" = "2**n*cos(2*pi*n)"}\nequations = ["x(n + 1) - 2*x(n)", "x(0) - 1"]'
    assert status(claim, space=LINE, symbols='n = "integer"\nx = "function"') == "proved"


def test_the_new_hamiltonian_of_a_symmetry_is_defined_where_the_old_one_is(ask):
    """√q² is q for q ≥ 0, but for the new coordinate −q it isn't −q."""
    mirror = {"transformation": 'Q = ["-q"]\nP = ["-p"]', "hamiltonian": 'H = "sqrt(q**2) + p**2/2"'}
    with pytest.raises(InputError, match=r"no point of the domain|undefined everywhere"):
        ask('kind = "symmetry"', symbols='q = "nonnegative"', **mirror)
    assert ask('kind = "symmetry"', **mirror)[0].status == "proved"


def test_a_composed_map_is_one_where_the_second_is_defined():
    """The second map is one of u > 0 alone, so that the composed one speaks of −q > 0."""
    first = Transformation(one := PhaseSpace("q", "p", new=("u", "w")), Q=-one.q[0], P=-one.p[0])
    two = PhaseSpace("u", "w", new=("Q", "P"), positive="u")
    second = Transformation(two, Q=two.formula("sqrt(u**2)"), P=two.formula("w"))
    whole = compose(first, second)
    assert [str(c) for f in whole.Q for c in f.conditions] == ["-q > 0"]
    assert verify(whole.canonical()).witness is None


def test_surfaces_of_whole_numbers_are_no_space(status):
    """On p² + q² = 2n sin πH is 0, though not elsewhere."""
    claim = 'kind = "algebra"\nbasis = {A = "q", B = "1 + sin(pi*(p**2 + q**2)/2)**2"}\nstructure = {}'
    on = 'on = ["(p**2 + q**2)/2 - n"]'
    assert status(claim, space=LINE, symbols='n = "integer"', domain=on) in ("proved", "supported")
    assert status(claim, space=LINE, symbols='n = "real"', domain=on) == "refuted"


@pytest.mark.parametrize(("sign", "expected"), [("nonnegative", "supported"), ("positive", "proved")])
def test_functions_that_vanish_for_one_value_of_a_parameter_are_dependent(status, sign, expected):
    """a/(a + q − 1) is 1 at q = 1 for every a but 0, for which it is 0 throughout."""
    claim = 'kind = "algebra"\nbasis = {A = "a/(a + q - 1)", B = "q"}\nequals = "u(1)^2"'
    assert status(claim, space=LINE, symbols=f'a = "{sign}"', domain='where = ["q > 2"]') == expected


@pytest.mark.parametrize(("power", "expected"), [("b**n", "refuted"), ("b**(n + 1)", "proved")])
def test_what_a_power_of_it_says_of_a_number(status, power, expected):
    """b⁰ is 1 for b = 0, too."""
    claim = 'kind = "independent"\nfunctions = ["b*q", "p"]'
    words = 'b = "real"\nn = ["integer", "nonnegative"]'
    assert status(claim, space=LINE, symbols=words, domain=f'where = ["{power} > 0"]') == expected


@pytest.mark.parametrize(
    ("basis", "structure", "expected"),
    [
        ('A = "q", B = "a*b*q"', "", "undecided"),
        ('A = "a*q", B = "b*q"', "", "undecided"),
        ('A = "q", B = "a*b*q**2"', "", "proved"),
        ('A = "q", B = "a*b*p", C = "1"', '"A,B" = "a*b*C"', "proved"),
    ],
)
def test_a_basis_with_two_constants_of_either_sign(status, basis, structure, expected):
    """Where each sign of one is looked at, the other one is still held fixed."""
    claim = f'kind = "algebra"\nbasis = {{{basis}}}\nstructure = {{{structure}}}'
    assert status(claim, space=LINE, symbols='a = "nonzero"\nb = "nonzero"') == expected


@pytest.mark.parametrize(
    ("solution", "equation", "definitions"),
    [
        ('"f(t)" = "a*cos(t)"', "D(f(t), a)", ""),
        ('"f(t)" = "a*cos(t)"', "D(f(t), a) - cos(t)", ""),
        ('"f(a)" = "t*a"', "D(a*f(2*a)**2, t, 2)", ""),
        ('"f(t)" = "q*cos(t)"', "1 + g + f(t) - q*cos(t)", 'g = "bracket(p, q + f(t))"'),
        ('"f(t)" = "q*cos(t)"', "D(g, q) + 0*f(t)", 'g = "f(t)"'),
    ],
)
def test_a_derivative_of_a_solution_by_what_its_function_does_not_depend_on(ask, solution, equation, definitions):
    """It was taken before the solution was put in, and was 0."""
    claim = f'kind = "solves"\nsolution = {{{solution}}}\nequations = ["{equation}"]'
    with pytest.raises((InputError, AssertionError), match=r"make .* one of its arguments, or write the derivative"):
        ask(claim, space=LINE, symbols='a = "real"\nf = "function"', definitions=definitions)


@pytest.mark.parametrize(
    ("solution", "equation"),
    [
        ('"f(t)" = "a*cos(t)"', "D(f(t), t) + a*sin(t)"),
        ('"f(t, a)" = "a*cos(t)"', "D(f(t, a), a) - cos(t)"),
        ('"f(q)" = "a*q**2"', "bracket(f(q), p) + D(f(q) - q*f(q), q, 3) + 6*a - 2*a*q"),
        ('"f(t)" = "a*t/a"', "D(f(t), a)"),
    ],
)
def test_derivatives_of_a_solution_by_its_arguments(status, solution, equation):
    claim = f'kind = "solves"\nsolution = {{{solution}}}\nequations = ["{equation}"]'
    assert status(claim, space=LINE, symbols='a = "real"\nf = "function"') == "proved"


def test_a_constant_put_in_keeps_its_sign(ask):
    """sympy 1.14 takes |acos(tanh 9)|, which is 0.000247, for 0."""
    kind = 'kind = "frequency"\ncoordinate = "q"\nenergy = "E"\nfixed = {d = "tanh(9)"}\nequals = '
    sections = {"symbols": 'E = "positive"\nb = "positive"\nd = "real"',
                "hamiltonian": 'H = "p**2/2 + (abs(acos(d)) + b)**2*q**2/2"'}  # fmt: skip
    assert ask(kind + '"b/(2*pi)"', space=LINE, **sections)[0].status == "refuted"
    assert ask(kind + '"(b + acos(tanh(9)))/(2*pi)"', space=LINE, **sections)[0].status in ("supported", "proved")
