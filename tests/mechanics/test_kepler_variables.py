"""Delaunay's and Poincaré's variables as transformations (Goldstein, Poole and Safko 2002, section 10.8)."""

import pytest
import sympy as sp

from canon.claims.verify import verify
from canon.errors import InputError
from canon.mechanics.composition import compose
from canon.mechanics.kepler_variables import delaunay_variables, poincare_variables
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.transformation import Transformation

SPACES = {
    2: (("r theta", "p_r p_theta"), ("l g", "L G"), ("lam eta", "Lam xi")),
    3: (("r theta phi", "p_r p_theta p_phi"), ("l g h", "L G H"), ("lam eta zeta", "Lam xi kappa")),
}


@pytest.mark.parametrize("n", [2, 3])
def test_delaunay_variables_of_a_mass_and_an_attraction(n):
    old, new, _ = SPACES[n]
    space = PhaseSpace(*old, new=new, positive="r k m")
    k, m, r, L = space.symbols("k m r L")
    to_elements = delaunay_variables(space, k, m)
    square = space.p[1] ** 2 + (space.p[2] ** 2 / sp.sin(space.q[1]) ** 2 if n == 3 else 0)
    H = (space.p[0] ** 2 + square / r**2) / (2 * m) - k / r
    assert verify(to_elements.canonical()).status == "proved"
    assert verify(to_elements.new_hamiltonian(H, -m * k**2 / (2 * L**2))).status == "proved"
    if n == 3:
        return
    assert verify(to_elements.new_hamiltonian(H, -m * k**2 / (2 * L**2) * sp.Rational(1001, 1000))).status == "refuted"
    (l, *others), P = to_elements.Q, to_elements.P
    wrong = Transformation(space, Q=(l.expr * sp.Rational(1001, 1000), *others), P=P)
    assert verify(wrong.canonical()).status == "refuted"


@pytest.mark.parametrize("n", [2, 3])
def test_poincare_variables_and_the_way_to_them(n):
    old, between, new = SPACES[n]
    elements = PhaseSpace(*between, new=new)
    regular = poincare_variables(elements)
    assert verify(regular.canonical()).status == "proved"
    assert sp.simplify(regular.Q[1].expr ** 2 + regular.P[1].expr ** 2 - 2 * (elements.p[0] - elements.p[1])) == 0
    if n == 2:
        whole = compose(delaunay_variables(PhaseSpace(*old, new=between, positive="r")), regular)
        assert verify(whole.canonical()).status == "proved"


def test_other_numbers_of_degrees_of_freedom_are_refused():
    line = PhaseSpace("r", "p", new=("l", "L"))
    for variables in (delaunay_variables, poincare_variables):
        with pytest.raises(InputError, match="two or three degrees of freedom"):
            variables(line)
