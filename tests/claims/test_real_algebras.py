"""Real Lie algebras have real structure constants, and the parameters of a group compose to real ones."""

import pytest

from canon import verify
from canon.claims.reader import read_text
from canon.errors import InputError

SPACE = """[phase_space]
q = ["x"]
p = ["u"]
[symbols]
z = ["complex", "nonzero"]
k = "real"
[[claim]]
"""
ALGEBRAS = {
    "{z x, u} = z": 'basis = {A = "z*x", B = "u", D = "1"}\nstructure = {"A,B" = "z*D"}',
    "{z x u, u} = z u": 'basis = {A = "z*x*u", B = "u"}\nstructure = {"A,B" = "z*B"}',
    "a tensor": 'basis = {A = "a", B = "b"}\ntensor = [["0", "z*a"], ["-z*a", "0"]]\n'
    'coordinates = ["a", "b"]\nstructure = {"A,B" = "z*A"}',
    "1 = D/z": 'basis = {A = "x", B = "u", D = "z"}\nequals = "heisenberg(1)"',
    "i": 'basis = {A = "1j*x*u", B = "u"}\nstructure = {"A,B" = "1j*B"}',
}
LAW = 'first = ["a"]\nsecond = ["b"]\nequals = "u(1)"\ncomposition = '
GROUPS = {
    "z a b": LAW + '["a + b + z*a*b"]',
    "i a b": LAW + '["a + b + 1j*a*b"]',
    "1 + z a": 'first = ["a"]\nequals = "u(1)"\nmatrix = [["1 + z*a"]]',
    "structure": 'first = ["a", "c"]\nsecond = ["b", "d"]\ncomposition = ["a + b", "c + exp(z*a)*d"]\n'
    'structure = {"a,c" = "-z*c"}',
}
REAL = {
    "a modulus": 'kind = "algebra"\nbasis = {A = "x*u", B = "u"}\nstructure = {"A,B" = "abs(z)*B/abs(z)"}',
    "a modulus composed": f'kind = "group"\n{LAW}["a + b + abs(1 + 1j*k)*a*b"]',
    "a complex basis": 'kind = "algebra"\nbasis = {A = "x", B = "z*u", D = "z"}\nequals = "heisenberg(1)"',
    "x + i y": 'kind = "group"\nfirst = ["a", "b"]\nequals = "u(1)^2"\nmatrix = [["1 + a + 1j*b"]]',
}


def decided(text):
    (claim,) = read_text(SPACE + text).claims
    return verify(claim, budget=20).status


@pytest.mark.parametrize("name", ALGEBRAS)
def test_complex_structure_constants_are_none_of_a_real_algebra(name):
    assert decided(f'kind = "algebra"\n{ALGEBRAS[name]}') != "proved"


@pytest.mark.parametrize("name", GROUPS)
def test_a_law_that_is_not_real_is_no_group_of_real_parameters(name):
    with pytest.raises(InputError, match="real"):
        decided(f'kind = "group"\n{GROUPS[name]}')


@pytest.mark.parametrize("name", REAL)
def test_what_is_real_stays_provable(name):
    assert decided(REAL[name]) == "proved"
