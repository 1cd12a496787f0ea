"""Names that a claim declares must not stand for something else in the file's formulas, nor canon's for the file's."""

import pytest

from canon.errors import InputError

LINE = 'q = ["q"]\np = ["p"]\n'
FREE = {"space": LINE, "symbols": 'm = "positive"\nE = "positive"', "hamiltonian": 'H = "p**2/(2*m)"'}
WELL = {"space": LINE, "symbols": 'k = "positive"', "hamiltonian": 'H = "p**2/2 + k*q**2/2"'}


@pytest.mark.parametrize(
    ("claim", "file"),
    [
        ('kind = "hamilton_jacobi"\nW = "sqrt(2*m*E)*q"\nconstants = ["m"]\nenergy = "E"', FREE),
        ('kind = "hamilton_jacobi"\nS = "sqrt(2*m*E)*q - E*t"\nconstants = ["m"]', FREE),
        ('kind = "frequency"\ncoordinate = "q"\nenergy = "k"\nequals = "sqrt(k)/pi"', WELL),
        ('kind = "frequency"\ncoordinate = "q"\nenergy = "k"\nequals = "sqrt(k)/(2*pi)"', WELL),
        ('kind = "action"\ncoordinate = "q"\nenergy = "k"\nequals = "2*pi*sqrt(k)"', WELL),
        ('kind = "legendre"\nL = "k**2/2"\nvelocities = ["k"]', WELL),
        ('kind = "euler_lagrange"\nL = "v**2/2 - k*q"\nvelocities = ["v"]\naccelerations = ["k"]\nequations = ["2*k"]',
         WELL),
        ('kind = "matrix_group"\nmatrix = [["1", "a + b"], ["0", "1"]]\nfirst = ["a"]\nsecond = ["b"]\n'
         'composition = ["a + b"]', WELL),
    ],
)  # fmt: skip
def test_what_a_claim_varies_is_nothing_else(ask, claim, file):
    with pytest.raises((InputError, AssertionError), match="needs a name of its own"):
        ask(claim, **file)


def test_a_series_in_an_integer_has_no_coefficients(ask):
    series = 'kind = "lie_series"\ngenerator = "p"\nparameter = "n"\nf = "q"\nequals = "q + n*cos(2*pi*n)"'
    with pytest.raises((InputError, AssertionError), match="integer"):
        ask(series, space=LINE, symbols='n = "integer"')
    with pytest.raises((InputError, AssertionError), match="integer"):
        ask('kind = "canonical"\norder = ["n", 1]', space=LINE + 'Q = ["Q"]\nP = ["P"]\n', symbols='n = "integer"',
            transformation='Q = ["q*cos(2*pi*n)"]\nP = ["p"]')  # fmt: skip


def test_a_law_that_is_associative_with_one_parameter_alone(status):
    """a + b + a sin(2πb/c) is as if it were associative where the third element is c, whatever c is called."""
    for name in ("c", "b_third"):
        law = f'kind = "group"\nfirst = ["a"]\nsecond = ["b"]\ncomposition = ["a + b + a*sin(2*pi*b/{name})"]\n'
        assert status(law + 'equals = "u(1)"', space=LINE, symbols=f'{name} = "real"') == "refuted"


@pytest.mark.parametrize(
    ("claim", "symbols", "sections"),
    [
        ('kind = "conserved"\nf = "q - t*cos(2*pi*t)"', 't = "integer"', {"hamiltonian": 'H = "p"'}),
        ('kind = "frequency"\ncoordinate = "q"\nenergy = "E"\nequals = "cos(2*pi*E)/(2*pi)"', 'E = "integer"',
         {"hamiltonian": 'H = "p**2/2 + q**2/2"'}),
        ('kind = "hamilton_jacobi"\nW = "n*q*cos(2*pi*n)"\nconstants = ["n"]\nenergy = "n**2/2"', 'n = "integer"',
         {"hamiltonian": 'H = "p**2/2"'}),
        ('kind = "euler_lagrange"\nL = "v**2*cos(2*pi*v)/2"\nvelocities = ["v"]\naccelerations = ["a"]\n'
         'equations = ["a"]', 'v = "integer"', {}),
        ('kind = "group"\nfirst = ["a"]\nsecond = ["b"]\ncomposition = ["a + b + sin(2*pi*a)*b**2"]\nequals = "u(1)"',
         'a = "integer"', {}),
        ('kind = "casimir"\nf = "cos(2*pi*u)"\ncoordinates = ["u", "v"]\ntensor = [["0", "1"], ["-1", "0"]]',
         'u = "integer"', {}),
        ('kind = "dimension"\nfunctions = ["x*cos(2*pi*n)"]\ndimensions = {n = "L", x = "L"}\nequals = "L"',
         'n = "integer"\nx = "positive"', {}),
    ],
)  # fmt: skip
def test_no_derivative_by_an_integer(ask, claim, symbols, sections):
    """cos 2πn is 1 for all integers, and so is its derivative 0 where n can't move."""
    with pytest.raises((InputError, AssertionError), match="integer"):
        ask(claim, space=LINE, symbols=symbols, **sections)


@pytest.mark.parametrize(("path", "end"), [("v*t", "1"), ("B*t", "q"), ("B*t", "v**2 + 1"), ("p*t", "1")])
def test_a_path_is_a_function_of_time(ask, path, end):
    claim = f'kind = "stationary"\nL = "v**2/2"\nvelocities = ["v"]\npath = ["{path}"]\nfrom = 0\nto = "{end}"'
    with pytest.raises((InputError, AssertionError), match="function of t, not of"):
        ask(claim, space=LINE, symbols='B = "real"')


def test_parameters_of_a_group_may_be_0(ask):
    """Of positive numbers |a| is a, and a + b + (|a| − a) b is smooth."""
    law = 'kind = "group"\nfirst = ["a"]\nsecond = ["b"]\ncomposition = ["a + b + (abs(a) - a)*b"]\nequals = "u(1)"'
    with pytest.raises((InputError, AssertionError), match="not to be 0"):
        ask(law, space=LINE, symbols='a = "positive"\nb = "positive"')
