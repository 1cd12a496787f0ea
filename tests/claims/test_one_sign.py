"""A smooth function that is declared `nonzero` has one sign: it is refuted by no values of both signs."""

import pytest

FUNCTIONS = 'X = ["function", "nonzero"]\nV = "function"'
TRUE = {
    "a product of values": 'kind = "inequality"\nlhs = "X(q)*X(p)"\nrelation = ">"\nrhs = "0"',
    "signs": 'kind = "identity"\nlhs = "abs(X(q))/X(q)"\nrhs = "abs(X(p))/X(p)"',
    "roots": 'kind = "identity"\nlhs = "sqrt(X(q)**2)*X(p)"\nrhs = "X(q)*sqrt(X(p)**2)"',
    "a bracket": 'kind = "bracket"\nf = "q*sign(X(q))"\ng = "p*sign(X(p))"\nequals = "1"',
    "functions in involution": 'kind = "involution"\nfunctions = ["p", "q*(sign(X(1)) - sign(X(2)))"]',
}
FALSE = {
    "one value": 'kind = "inequality"\nlhs = "X(q)"\nrelation = ">"\nrhs = "0"',
    "a slope": 'kind = "inequality"\nlhs = "X(q)*D(X(p), p)"\nrelation = ">"\nrhs = "0"',
    "any function": 'kind = "inequality"\nlhs = "V(q)*V(p)"\nrelation = ">"\nrhs = "0"',
}


@pytest.fixture
def answer(status):
    return lambda claim: status(claim, space='q = ["q"]\np = ["p"]\n', symbols=FUNCTIONS)


@pytest.mark.parametrize("name", sorted(TRUE))
def test_no_witness_has_values_of_both_signs(name, answer):
    assert answer(TRUE[name]) == "supported", name


@pytest.mark.parametrize("name", sorted(FALSE))
def test_what_fails_with_one_sign_is_refuted(name, answer):
    assert answer(FALSE[name]) == "refuted", name
