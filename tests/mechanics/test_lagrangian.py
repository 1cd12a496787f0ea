import pytest
import sympy as sp

from canon import Hamiltonian, InputError, Lagrangian, PhaseSpace
from canon.mechanics.hamiltonian import field_residuals, hamiltonian_of_field
from canon.mechanics.lagrangian import lagrangian_of

SPACE = PhaseSpace("r theta", "p_r p_theta", positive="r m", real="v w k")
(r, theta), (p_r, p_theta) = SPACE.q, SPACE.p
m, v, w, k = SPACE.symbols("m v w k")
KEPLER = Lagrangian(SPACE, m * (v**2 + r**2 * w**2) / 2 + k / r, (v, w))
H = p_r**2 / (2 * m) + p_theta**2 / (2 * m * r**2) - k / r


def test_legendre_there_and_back(vanishes):
    assert KEPLER.momenta() == (m * v, m * r**2 * w)
    assert KEPLER.hessian() == sp.diag(m, m * r**2)
    assert vanishes(KEPLER.hamiltonian().H.expr - H)
    assert vanishes(KEPLER.legendre_residual(H))
    assert vanishes(lagrangian_of(Hamiltonian(SPACE, H), (v, w)).L.expr - KEPLER.L.expr)


def test_the_claim_of_a_legendre_transform():
    claim = KEPLER.legendre(H)
    assert claim.kind == "legendre"
    assert Lagrangian(SPACE, v**2 + w**2, [v, w]).velocities == (v, w)
    with pytest.raises(InputError, match="1 velocities for 2 coordinates"):
        Lagrangian(SPACE, v**2, v)
    with pytest.raises(InputError, match="L: L is a function of coordinates and velocities, not of p_r"):
        Lagrangian(SPACE, p_r * v + v**2 + w**2, (v, w))


def test_the_relativistic_particle(vanishes):
    space = PhaseSpace("x", "p", positive="m c", real="v")
    mass, c, u, p = space.symbols("m c v p")
    free = Lagrangian(space, -mass * c**2 * sp.sqrt(1 - u**2 / c**2), u)
    assert vanishes(free.hamiltonian().H.expr - c * sp.sqrt(p**2 + mass**2 * c**2))


def test_a_singular_lagrangian_has_no_hamiltonian():
    with pytest.raises(InputError, match="not solved"):
        Lagrangian(SPACE, v * r - theta**2 + w, (v, w)).hamiltonian()


def test_hamiltons_equations():
    qdot, pdot = Hamiltonian(SPACE, H).equations()
    assert qdot == (p_r / m, p_theta / (m * r**2))
    assert pdot == (p_theta**2 / (m * r**3) - k / r**2, 0)
    assert Hamiltonian(SPACE, H).rate(p_theta) == 0


def test_a_field_and_its_hamiltonian(vanishes):
    qdot, pdot = Hamiltonian(SPACE, H).equations()
    assert vanishes(field_residuals(SPACE, qdot, pdot))
    found = hamiltonian_of_field(SPACE, qdot, pdot)
    assert found is not None
    assert vanishes(found.residuals)
    assert not vanishes(field_residuals(SPACE, qdot, (pdot[0] - p_r, 0)))


@pytest.mark.parametrize(
    ("region", "L", "H"),
    [
        ("v > 0", "v**3/3", "2*p**(3/2)/3"),
        ("v < 0", "v**3/3", "-2*p**(3/2)/3"),
        ("v < 0", "v**4/4", "3*(-p)**(4/3)/4"),
        ("p < 0", "-sqrt(1 - v**2)", "sqrt(1 + p**2)"),
    ],
)
def test_the_legendre_transform_is_that_of_the_domain(region: str, L: str, H: str) -> None:
    space = PhaseSpace("q", "p", real="v").where(region)
    v, p = space.symbol("v"), space.symbol("p")
    lagrangian = Lagrangian(space, space.formula(L), v)
    at = {v: sp.Rational(3 if region == "v > 0" else -3, 7)}
    at |= {p: lagrangian.momenta()[0].subs(at)}
    found = lagrangian.hamiltonian().H.expr
    for value in (found, space.formula(H).expr):
        assert abs(complex((value - lagrangian.energy()).subs(at).evalf())) < 1e-12


def test_a_velocity_of_either_sign_has_no_one_legendre_transform() -> None:
    """p = v²: H is ±2p^(3/2)/3 for v = ±√p. And back: v = p²."""
    space = PhaseSpace("q", "p", real="v")
    v, p = space.symbol("v"), space.symbol("p")
    lagrangian = Lagrangian(space, v**3 / 3, v)
    with pytest.raises(InputError, match="several solutions, and none is right throughout the domain"):
        lagrangian.hamiltonian()
    assert {sp.simplify(lagrangian.hamiltonian(k).H.expr / p ** sp.Rational(3, 2)) for k in (0, 1)} == {
        sp.Rational(2, 3),
        -sp.Rational(2, 3),
    }
    with pytest.raises(InputError, match="several solutions, and none is right throughout the domain"):
        lagrangian_of(Hamiltonian(space, p**3 / 3), v)
    half = space.where("p < 0")
    assert sp.simplify(lagrangian_of(Hamiltonian(half, p**3 / 3), v).L.expr + 2 * v ** sp.Rational(3, 2) / 3) == 0
