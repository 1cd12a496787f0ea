"""Two bodies as one: the transformation is canonical, and takes H to the reduced one."""

import pytest
import sympy as sp

from canon.claims.verify import verify
from canon.errors import InputError
from canon.mechanics.two_body import two_bodies

m1, m2, k, r = sp.symbols("m1 m2 k r", positive=True)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_the_reduction_is_canonical(dimension):
    assert verify(two_bodies(m1, m2, dimension).transformation.canonical()).status == "proved"


def test_the_new_hamiltonian_is_that_of_a_free_centre_and_of_the_reduced_mass():
    bodies = two_bodies(m1, m2, 2)
    H, K = bodies.old_hamiltonian(-k / r, r, m1, m2), bodies.hamiltonian(-k / r, r)
    assert verify(bodies.transformation.new_hamiltonian(H, K)).status == "proved"
    wrong = K + bodies.transformation.space.P[-1] ** 2 / 1000
    assert verify(bodies.transformation.new_hamiltonian(H, wrong)).status == "refuted"


def test_numbers():
    bodies = two_bodies(3, 1)
    assert (bodies.total, bodies.reduced) == (4, sp.Rational(3, 4))
    assert bodies.transformation.expressions[0] == sp.Rational(3, 4) * sp.Symbol("x1", real=True) + sp.Rational(
        1, 4
    ) * sp.Symbol("x2", real=True)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: two_bodies(1, -2), "a positive mass"),
        (lambda: two_bodies(1, sp.Symbol("m")), "a positive mass"),
        (lambda: two_bodies(1, 2, 4), "one to three"),
        (lambda: two_bodies(1.5, 2), "m1"),
    ],
)
def test_faults(call, message):
    with pytest.raises(InputError, match=message):
        call()
