"""Actions and angles of maps that have to be inverted first, or are given by a generating function."""

import time

import pytest

from canon.claims.reader import read_text
from canon.claims.verify import verify
from tests.claims.test_action_angle import OSCILLATOR, SPACE, angle_claim


@pytest.mark.parametrize(("period", "expected"), [("2*pi", "proved"), ("pi", "refuted"), ("1", "refuted")])
def test_a_map_given_forward_is_inverted(status, period, expected):
    forward = 'Q = ["atan2(m*omega*q, p)"]\nP = ["(p**2/(2*m) + m*omega**2*q**2/2)/omega"]'
    assert status(angle_claim(period), space=SPACE, transformation=forward, **OSCILLATOR) == expected


def test_a_map_given_forward_with_angles_in_turns(status):
    sections = {
        "symbols": 'm = "positive"\nomega = "positive"',
        "hamiltonian": 'H = "p**2/(2*m) + m*omega**2*q**2/2"',
        "transformation": 'Q = ["atan2(m*omega*q, p)/(2*pi)"]\nP = ["2*pi*(p**2/(2*m) + m*omega**2*q**2/2)/omega"]',
    }
    assert status('kind = "action_angle"', **sections) == "proved"


def test_a_generating_function_of_type_1(status):
    section = 'type = 1\nF = "m*omega*q**2*cot(w)/2"'
    assert status(angle_claim("2*pi"), space=SPACE, generating_function=section, **OSCILLATOR) == "proved"


def test_a_map_that_is_not_inverted_is_undecided(status):
    section = 'type = 1\nF = "m*omega*q**2*cot(2*pi*w)/2 + q**7*w**5"'
    assert status(angle_claim(), space=SPACE, generating_function=section, **OSCILLATOR) in ("undecided", "refuted")


ISOCHRONE = {
    "symbols": "\n".join(f'{name} = "positive"' for name in ("r", "k", "b", "J", "K")),
    "hamiltonian": 'H = "(p_r**2 + L**2/r**2)/2 - k/(b + sqrt(b**2 + r**2))"',
}
ISOCHRONES = """
M = "sqrt(K**2 + 4*k*b)"
n = "k/({radial} + (K + M)/2)"
s = "sqrt(b**2 + r**2)"
X = "2*k*(s - b) - n**2*r**2 - K**2"
eta = "atan2(n*sqrt(X), k - n**2*s)"
f = "atan2(K*sqrt(X), K**2 - (k - n**2*b)*(s - b))"
h = "atan2(M*sqrt(X), M**2 - (k + n**2*b)*(s + b))"
"""


@pytest.mark.parametrize(
    ("radial", "period", "expected"),
    [
        ("J", "2*pi", "proved"),
        ("J + K", "2*pi", "proved"),  # another basis of the same cycles
        ("J", "1", "refuted"),
        ("J", "4*pi", "refuted"),
        ("2*J", "2*pi", "refuted"),
        ("J + K/2", "2*pi", "refuted"),
        ("1001/1000*J", "2*pi", "refuted"),
    ],
)
def test_the_angles_of_the_isochrone_by_their_generating_function(status, radial, period, expected):
    sections = {
        **ISOCHRONE,
        "definitions": ISOCHRONES.format(radial=radial),
        "generating_function": 'type = 2\nF = "K*theta + sqrt(X) + k/n*eta - (K*f + M*h)/2"',
    }
    space = 'q = ["r", "theta"]\np = ["p_r", "L"]\nQ = ["u", "v"]\nP = ["J", "K"]\n'
    assert status(angle_claim(period), space=space, **sections) == expected


def test_a_map_that_sympy_inverts_for_minutes_keeps_to_the_budget() -> None:
    """A Gröbner basis over functions, of one call that looks at no clock."""
    text = (
        '[phase_space]\nq = ["q"]\np = ["p"]\nQ = ["w"]\nP = ["J"]\n[symbols]\nq = "positive"\n'
        '[definitions]\nE = "p**2/2 + q**2/2 + 1/q**2"\n[hamiltonian]\nH = "E"\n'
        '[transformation]\nQ = ["atan2(q**2 - E, q*p)/(2*pi)"]\nP = ["pi*E"]\n[[claim]]\nkind = "action_angle"\n'
    )
    (claim,) = read_text(text).claims
    start = time.process_time()
    assert verify(claim, budget=0.6).status == "undecided"
    assert time.process_time() - start < 3.0


@pytest.mark.parametrize("term", ["0*asin(w)", "0*log(w)", "0/w", "0*sqrt(1 - w)*sqrt(1 + w)", "w/w - 1"])
def test_a_map_is_defined_all_along_its_cycles(status, term):
    """A formula that ends within a turn has no cycle, though what is left of it goes on; other than a bound."""
    given = 'q = ["sqrt(2*J/(m*omega))*sin(w) + {}"]\np = ["sqrt(2*m*omega*J)*cos(w)"]'
    sections = {"space": SPACE, **OSCILLATOR}
    assert status(angle_claim("2*pi"), transformation=given.format(term), **sections) == "supported"
    for smooth in ("0*w", "0*exp(w)", "0/(2 + sin(w))"):
        assert status(angle_claim("2*pi"), transformation=given.format(smooth), **sections) == "proved"
    bounded = {"transformation": given.format("0*J"), "domain": 'where = ["0 < w < 1"]'}
    assert status(angle_claim("2*pi"), **bounded, **sections) == "proved"
