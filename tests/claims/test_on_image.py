"""Claims in old variables beside a map given backward, or by a generating function: its image is their domain."""

import tomllib

import pytest

from canon.checker.check import check
from canon.claims.certificate_data import certificate, statement_tables
from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.errors import InputError

EXPONENTIAL = """[phase_space]
q = ["q"]
p = ["p"]
Q = ["Q"]
P = ["P"]
[symbols]
k = "real"
h = "real"
[hamiltonian]
H = "p**2/2 + abs(q)"
[transformation]
q = ["exp(Q)"]
p = ["P*exp(-Q)"]
"""
GENERATED = """[phase_space]
q = ["q"]
p = ["p"]
Q = ["Q"]
P = ["P"]
[generating_function]
type = 1
F = "sqrt(q - 5)*Q"
"""
SPAN = '\nfrom = "0"\nto = "2"\n'


def _status(text: str) -> str:
    (claim,) = read_text(text).claims
    return verify(claim).status


@pytest.mark.parametrize(
    ("claim", "expected"),
    [
        ('kind = "legendre"\nL = "v**2/2 - q"\nvelocities = ["v"]', {"proved", "undecided"}),
        ('kind = "legendre"\nL = "v**2/2 - 2*q"\nvelocities = ["v"]', {"refuted"}),
        ('kind = "legendre"\nL = "v**2/2 - abs(q)"\nvelocities = ["v"]', {"proved"}),
        (
            'kind = "euler_lagrange"\nL = "v**2/2 - abs(q)"\nvelocities = ["v"]\nqddot = ["-1"]',
            {"proved", "undecided"},
        ),
        ('kind = "euler_lagrange"\nL = "v**2/2 - abs(q)"\nvelocities = ["v"]\nqddot = ["-2"]', {"refuted"}),
        (
            'kind = "hamilton_jacobi"\nS = "a*q - a**2*t/2 - q*t + a*t**2/2 - t**3/6"\nconstants = ["a"]',
            {"proved", "undecided"},
        ),
        ('kind = "hamilton_jacobi"\nS = "a*q - a**2*t/2"\nconstants = ["a"]', {"refuted"}),
        (
            'kind = "noether"\nL = "v**2/2 - abs(q)"\nvelocities = ["v"]\ndq = ["1"]\nf = "-t"',
            {"proved", "undecided"},
        ),
        ('kind = "limit"\nvariable = "q"\nf = "q"\nto = "-1"\nequals = "-1"', {"undecided"}),
        ('kind = "limit"\nvariable = "q"\nf = "q"\nto = "-1"\nequals = "1"', {"undecided"}),
        ('kind = "limit"\nvariable = "h"\nf = "abs(q) + h"\nto = "0"\nequals = "q"', {"proved", "undecided"}),
        ('kind = "limit"\nvariable = "h"\nf = "q + h"\nto = "0"\nequals = "2*q"', {"refuted"}),
        ('kind = "limit"\nvariable = "h"\nf = "sin(h)/h"\nto = "0"\nequals = "1"', {"proved"}),
        ('kind = "integral"\nvariable = "q"\nf = "q"\nequals = "0"\nfrom = "-1"\nto = "1"', {"undecided"}),
        ('kind = "integral"\nvariable = "h"\nf = "h"\nequals = "2"' + SPAN, {"proved"}),
        ('kind = "integral"\nvariable = "h"\nf = "h"\nequals = "3"' + SPAN, {"refuted"}),
        (
            'kind = "stationary"\nL = "v**2/2"\nvelocities = ["v"]\npath = ["t"]\nextremum = "minimum"'
            '\nfrom = "-1"\nto = "1"',
            {"undecided"},
        ),
    ],
)
def test_a_claim_is_one_about_the_image_of_a_map_given_backward(claim: str, expected: set[str]):
    assert _status(EXPONENTIAL + "[[claim]]\n" + claim) in expected


@pytest.mark.parametrize("equals", ["2", "3"])
def test_a_range_leaves_what_a_generating_function_demands(equals: str):
    text = GENERATED + f'[[claim]]\nkind = "integral"\nvariable = "q"\nf = "q"\nequals = "{equals}"' + SPAN
    assert _status(text) == "undecided"


@pytest.mark.parametrize("equals", ["-1", "1"])
def test_a_limit_is_taken_where_a_generating_function_has_values(equals: str):
    text = GENERATED + f'[[claim]]\nkind = "limit"\nvariable = "q"\nf = "q"\nto = "-1"\nequals = "{equals}"'
    with pytest.raises(InputError, match="q - 5 > 0"):  # the map's image is all of q > 5
        _status(text)


@pytest.mark.parametrize(
    ("map_of_the_file", "solution", "equation", "expected"),
    [
        ('Q = ["2*q"]\nP = ["p/2"]', "Q*t", "D(x(t), t) - 2*q", "proved"),
        ('Q = ["2*q"]\nP = ["p/2"]', "q*t", "D(x(t), t) - Q/2", "proved"),
        ('Q = ["2*q"]\nP = ["p/2"]', "Q*t", "D(x(t), t) - q", "refuted"),
        ('q = ["exp(Q)"]\np = ["P*exp(-Q)"]', "abs(q)*t", "D(x(t), t) - q", "proved"),
        ('q = ["exp(Q)"]\np = ["P*exp(-Q)"]', "log(q)*t", "D(x(t), t) - Q", "proved"),
        ('q = ["exp(Q)"]\np = ["P*exp(-Q)"]', "log(q)*t", "D(x(t), t) - 2*Q", "refuted"),
    ],
)
def test_a_solution_is_in_variables_related_by_the_map(
    map_of_the_file: str, solution: str, equation: str, expected: str
):
    text = f"""[phase_space]
q = ["q"]
p = ["p"]
Q = ["Q"]
P = ["P"]
[symbols]
x = "function"
[transformation]
{map_of_the_file}
[[claim]]
kind = "solves"
solution = {{ "x(t)" = "{solution}" }}
equations = ["{equation}"]
"""
    assert _status(text) == expected
    (claim,) = read_text(text).claims
    assert check(certificate(claim, verify(claim), statement_tables(tomllib.loads(text), 0))).status != "rejected"
