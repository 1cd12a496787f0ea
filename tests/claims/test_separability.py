"""In which coordinates the Hamilton–Jacobi equation separates, and in which it provably doesn't."""

import pytest
import sympy as sp

from canon.claims.separability import separates, separates_here
from canon.claims.verify import verify
from canon.errors import InputError
from canon.mechanics.hamilton_jacobi import CompleteIntegral
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.separation.actions import separated_actions
from canon.mechanics.separation.characteristic import characteristic_function
from canon.mechanics.separation.coordinates import orthogonal_coordinates, systems_of
from canon.mechanics.statements import identity

PLANE = PhaseSpace("x y", "p_x p_y", positive="m k a c")
SPACE = PhaseSpace("x y z", "p_x p_y p_z", positive="m k a c")
X, Y, Z = SPACE.symbols("x y z")
M, K, A, C = SPACE.symbols("m k a c")
R2, R3 = sp.sqrt(X**2 + Y**2), sp.sqrt(X**2 + Y**2 + Z**2)


def _H(space, V):
    return sum(p**2 for p in space.p) / (2 * M) + V


TWO_CENTRES = -K / sp.sqrt((X - C) ** 2 + Y**2) - A / sp.sqrt((X + C) ** 2 + Y**2)
IN_SPACE = -K / sp.sqrt((Z - C) ** 2 + X**2 + Y**2) - A / sp.sqrt((Z + C) ** 2 + X**2 + Y**2)


@pytest.mark.parametrize(
    ("space", "V", "expected"),
    [
        (PLANE, -K / R2, {"polar", "parabolic"}),
        (PLANE, K * (X**2 + Y**2), {"cartesian", "polar", "elliptic"}),
        (PLANE, K * (4 * X**2 + Y**2), {"cartesian", "parabolic"}),
        (PLANE, K * (4.001 * X**2 + Y**2).subs(4.001, sp.Rational(4001, 1000)), {"cartesian"}),
        (PLANE, -K / R2 + A * X, {"parabolic"}),
        (PLANE, TWO_CENTRES, {"elliptic"}),
        (PLANE, X**2 * Y - Y**3 / 3 + (X**2 + Y**2) / 2, set()),
        (SPACE, -K / R3, {"spherical", "parabolic"}),
        (SPACE, -K / R3 + A * Z, {"parabolic"}),
        (SPACE, IN_SPACE, {"prolate spheroidal"}),
        (SPACE, -K / R3 + A / (X**2 + Y**2), {"spherical", "parabolic"}),
    ],
)
def test_textbook_systems(space, V, expected):
    found = {name: separates(space, _H(space, V), name, focus=C) for name in systems_of(space.n)}
    assert {name for name, answer in found.items() if answer.verdict.status == "proved"} == expected
    for name in set(found) - expected:
        assert found[name].verdict.status == "refuted"
        assert found[name].verdict.witness
        assert str(found[name]) == f"does not separate in {name} coordinates: that is a proof"


def test_every_central_potential_separates():
    space = PhaseSpace("x y z", "p_x p_y p_z", functions="V", positive="m")
    H = sum(p**2 for p in space.p) / (2 * space.symbol("m")) + space.function("V")(R3)
    assert separates(space, H, "spherical").verdict.status == "proved"
    assert separates(space, H, "cartesian").verdict.status == "refuted"


@pytest.mark.parametrize("name", systems_of(3))
def test_the_stated_matrices_are_staeckel_matrices(name):
    """1/h² is the first row of the inverse, h² are the lengths of ∂x/∂u, and these are orthogonal."""
    system = orthogonal_coordinates(name, 3, C)
    space = PhaseSpace(system.u, [f"p_{u}" for u in system.u], real=[C])
    jacobian = sp.Matrix(system.cartesian).jacobian(system.u)
    residuals = []
    for i, u in enumerate(system.u):
        assert system.staeckel[i, :].free_symbols <= {u, C}
        for j in range(3):
            product = sum(jacobian[k, i] * jacobian[k, j] for k in range(3))
            residuals.append(product - (system.squares[i] if i == j else 0))
        column = sum(system.staeckel[k, i] / system.squares[k] for k in range(3))
        residuals.append(column - (1 if i == 0 else 0))
    for residual in residuals:
        assert verify(identity(space, residual, 0)).status == "proved"


def test_separated_momenta_solve_the_reduced_equation():
    answer = separates(SPACE, _H(SPACE, -K / R3), "spherical")
    separated = answer.separation
    u = separated.coordinates.u
    fresh = PhaseSpace(u, [f"p_{x}" for x in u], real=[M, K, *separated.constants()])
    assert verify(identity(fresh, separated.equation(), 0)).status == "proved"
    for x, square in zip(u, separated.momentum_squares(), strict=True):
        assert square.free_symbols & set(u) <= {x}


def test_kepler_actions_and_their_degeneracy():
    separated = separates(SPACE, _H(SPACE, -K / R3), "spherical").separation
    E, total, axial = separated.constants()
    J = [closed.value for closed in separated_actions(separated).values()]
    whole = sp.simplify(sum(J))
    assert not whole.has(total)  # one frequency for all three
    assert not whole.has(axial)
    known = 2 * sp.pi * K * sp.sqrt(M / (-2 * E))
    assert abs((whole - known).subs({E: -2, M: 3, K: 5}).evalf()) < 1e-12


def test_levi_civita_in_the_coordinates_as_they_are():
    polar = PhaseSpace("r phi", "p_r p_phi", positive="r k")
    r, phi, p_r, p_phi, k = polar.symbols("r phi p_r p_phi k")
    kinetic = (p_r**2 + p_phi**2 / r**2) / 2
    assert separates_here(polar, kinetic - k / r).verdict.status == "proved"
    assert separates_here(polar, kinetic - k / r + sp.cos(phi) / r**2).verdict.status == "proved"
    assert separates_here(polar, kinetic - k / r + r * sp.cos(phi)).verdict.status == "refuted"
    assert separates_here(polar, kinetic + p_phi * r).verdict.status == "proved"  # phi is cyclic: any orbit of it
    assert "does not separate in its own" in str(separates_here(polar, kinetic + r * phi))


@pytest.mark.parametrize(
    ("H", "name", "words"),
    [
        (sum(p**2 for p in PLANE.p) + PLANE.p[0], "polar", "an H of the form"),
        (PLANE.p[0] ** 2 + 2 * PLANE.p[1] ** 2, "polar", "an H of the form"),
        (_H(PLANE, X * PLANE.t), "polar", "depends on t"),
        (_H(PLANE, X), "spherical", "those of 3 dimensions"),
        (_H(PLANE, X), "toroidal", "unknown coordinates"),
        (_H(PLANE, X * sp.Symbol("r", real=True)), "polar", "a coordinate of the new system and a parameter"),
    ],
)
def test_bad_input(H, name, words):
    with pytest.raises(InputError, match=words):
        separates(PLANE, H, name)


@pytest.mark.parametrize(
    ("space", "V", "name"),
    [
        (PLANE, -K / R2, "polar"),
        (PLANE, -K / R2, "parabolic"),
        (PLANE, K * R2**2, "polar"),
        (PLANE, K * (X**2 + 4 * Y**2), "cartesian"),
        (PLANE, A * X, "cartesian"),
        (SPACE, -K / R3, "spherical"),
        (SPACE, A * Z, "cylindrical"),
    ],
)
def test_complete_integrals_are_found_and_proved(space, V, name):
    found = characteristic_function(separates(space, _H(space, V), name).separation)
    assert verify(found.complete()).status == "proved"
    wrong = CompleteIntegral(found.space, found.H, found.function.expr * sp.Rational(1001, 1000), found.constants,
        energy=found.constants[0])  # fmt: skip
    assert verify(wrong.complete()).status == "refuted"


def test_no_elementary_integral():
    assert characteristic_function(separates(PLANE, _H(PLANE, X**4 + Y**4), "cartesian").separation) is None
    assert characteristic_function(separates(PLANE, _H(PLANE, TWO_CENTRES), "elliptic", focus=C).separation) is None


def test_the_orbit_of_kepler_from_its_complete_integral():
    """∂W/∂α₂ is a constant: phi − phi₀ = −arccos of (p/r − 1)/e, in terms of the asin of the same argument."""
    found = characteristic_function(separates(PLANE, _H(PLANE, -K / R2), "polar").separation)
    beta = found.constants_of_motion()[1]
    (r, phi), (E, alpha) = found.space.q, found.constants
    eccentric = sp.sqrt(4 * E * alpha * M + K**2 * M**2)
    closed = (phi - sp.asin((K * M * r - 2 * alpha) / (r * eccentric))) / sp.sqrt(2 * alpha)
    change = (beta - closed).diff(r)
    assert verify(identity(found.space, change, 0)).status == "proved"


def test_a_potential_is_looked_at_where_the_space_is_and_on_both_sides_of_the_axis() -> None:
    space = PhaseSpace("x y", "p_x p_y")
    x, y, p_x, p_y = space.old
    kinetic = (p_x**2 + p_y**2) / 2
    vanishing = kinetic + y * (x - sp.Abs(x))
    assert separates(space.where(x > 0), vanishing, "cartesian").verdict.status == "proved"
    assert separates(space, vanishing, "cartesian").verdict.status == "refuted"
    # along the lines through the base point, which lies outside of y < 0, V is another
    assert separates(space.where(y < 0), kinetic + x * (y + sp.Abs(y)), "cartesian").verdict.status == "undecided"
    assert separates(space, kinetic + x * y * (y - sp.Abs(y)), "parabolic").verdict.status == "refuted"
    assert separates(space.where(y > 0), kinetic + x * y * (y - sp.Abs(y)), "parabolic").verdict.status == "proved"
    with pytest.raises(InputError, match="a matter of coordinates, not of p_x"):
        separates(space.where(p_x > 0), kinetic, "cartesian")
    assert separates_here(PhaseSpace("x", "p"), sp.Symbol("p", real=True) ** 2).verdict.status == "proved"
