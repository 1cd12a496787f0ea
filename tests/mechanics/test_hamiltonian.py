"""Rates of change along the motion, and the claims that a Hamiltonian makes."""

import sympy as sp

from canon import Hamiltonian, PhaseSpace
from canon.claims.verify import verify

SPACE = PhaseSpace("q", "p", positive="m k")
q, p, m, k = SPACE.symbols("q p m k")
t = SPACE.t
H = Hamiltonian(SPACE, p**2 / (2 * m) + k * q**2 / 2)


def test_the_rate_of_change_is_the_bracket_with_h_and_what_time_adds():
    assert H.rate(q) == p / m
    assert H.rate(p) == -k * q
    assert sp.expand(H.rate(t * p + t**2) - (p + 2 * t - t * k * q)) == 0
    assert H.equations() == ((p / m,), (-k * q,))


def test_what_a_hamiltonian_claims():
    assert verify(H.conserved(p**2 / m + k * q**2)).status == "proved"
    assert verify(H.conserved(p**2 / m + 1001 * k * q**2 / 1000)).status == "refuted"
    assert verify(H.has_equations([p / m], [-k * q])).status == "proved"
    assert verify(H.has_equations([p / m], [k * q])).status == "refuted"


def test_it_is_shown_as_a_formula():
    assert H._repr_latex_().startswith("$H = ")
