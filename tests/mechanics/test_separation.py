"""Separating coordinates by their geometry, and separated systems by energy, gradients and areas."""

from random import Random
from typing import Any

import pytest
import sympy as sp

from canon.errors import InputError
from canon.mechanics.formulas import replaced
from canon.mechanics.nested_degrees import nested_degrees
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.separation.actions import separated_actions
from canon.mechanics.separation.characteristic import characteristic_function, root_integral
from canon.mechanics.separation.coordinates import OrthogonalCoordinates, orthogonal_coordinates, systems_of
from canon.mechanics.separation.levi_civita import levi_civita
from canon.mechanics.separation.staeckel import separation

FOCUS = sp.Rational(3, 2)
SYSTEMS = [(name, n) for n in (2, 3) for name in systems_of(n)]
NAMES: Any = {2: PhaseSpace("x y", "p_x p_y", positive="m k"), 3: PhaseSpace("x y z", "p_x p_y p_z", positive="m k")}


def system(name: str, dimension: int) -> OrthogonalCoordinates:
    return orthogonal_coordinates(name, dimension, FOCUS)


def somewhere(symbols: Any, seed: int = 0) -> dict[Any, Any]:
    random = Random(seed)
    return {s: sp.Rational(random.randint(300, 900), 1000) for s in sorted(symbols, key=str)}


def is_zero(expression: Any, point: dict[Any, Any]) -> bool:
    return abs(sp.N(sp.sympify(expression).xreplace(point), 30)) < 1e-25


@pytest.mark.parametrize(("name", "dimension"), SYSTEMS)
def test_scale_factors_and_staeckel_matrices(name: str, dimension: int) -> None:
    """dx² = Σ h² du² without mixed terms; row i of S contains uᵢ alone, and 1/h² is the first row of S⁻¹."""
    found = system(name, dimension)
    point = somewhere(found.u)
    J = sp.Matrix([[x.diff(u) for u in found.u] for x in found.cartesian])
    metric = J.T * J
    for i in range(dimension):
        for j in range(dimension):
            assert is_zero(metric[i, j] - (found.squares[i] if i == j else 0), point)
        assert {s for e in found.staeckel.row(i) for s in e.free_symbols} <= {found.u[i]}
        first = sum(found.staeckel[k, i] / found.squares[k] for k in range(dimension))
        assert is_zero(first - int(i == 0), point)
    for base in found.bases:
        there: Any = dict(zip(found.u, base, strict=True))
        assert all(sp.N(h.xreplace(there)) > 0 for h in map(sp.sympify, found.squares))
    foci = {"elliptic": (FOCUS, 0), "prolate spheroidal": (0, 0, FOCUS)}.get(name)
    if foci:  # the sum of the distances from both foci depends on the first coordinate alone
        ways: Any = [
            sp.sqrt(sum((x + s * f) ** 2 for x, f in zip(found.cartesian, foci, strict=True))) for s in (1, -1)
        ]
        assert is_zero(sum(ways) - 2 * FOCUS * sp.cosh(found.u[0]), point)


@pytest.mark.parametrize(("name", "dimension"), SYSTEMS)
def test_momenta_of_a_separated_system_have_its_energy(name: str, dimension: int) -> None:
    """V = Σ wᵢ/hᵢ² for polynomials wᵢ is separated: Σ pᵢ²/2mhᵢ² + V = E; with a thousandth of u₁u₂ it isn't."""
    found = system(name, dimension)
    space = NAMES[dimension]
    m = space.symbol("m")
    parts = [u**2 * (k + 2) + u for k, u in enumerate(found.u)]
    potential = sum(w / h for w, h in zip(parts, found.squares, strict=True)) / m
    point = somewhere({*found.u, m, *sp.symbols("E alpha_2 alpha_3", real=True)})
    for spoilt in (0, found.u[0] * found.u[-1] / 1000)[: 2 if name in ("polar", "cartesian") else 1]:
        V = potential + spoilt
        made = _separated(space, found, V, m)
        assert is_zero(made.residual(), point) == (spoilt == 0)
        assert is_zero(made.equation(), point) == (spoilt == 0)
        assert all(made.parts[k].free_symbols <= {u, m} for k, u in enumerate(found.u))


def _separated(space: Any, found: OrthogonalCoordinates, V: Any, m: Any) -> Any:
    """Separation of a potential that is given in the separating coordinates themselves."""
    plain = OrthogonalCoordinates(found.name, found.u, found.u, found.squares, found.staeckel, found.bases)
    H = sum(p**2 for p in space.p) / (2 * m) + V.xreplace(dict(zip(found.u, space.q, strict=True)))
    return separation(space, H, plain)


def test_what_is_no_natural_system_is_refused() -> None:
    space = NAMES[2]
    (x, y), (a, b) = space.q, space.p
    polar = system("polar", 2)
    for H in (a**2 + 2 * b**2, a**2 + b**2 + a * b, x * (a**2 + b**2), a**2 + b**2 + x * b, a + b):
        with pytest.raises(InputError, match="is expected"):
            separation(space, H, polar)
    with pytest.raises(InputError, match="depends on t"):
        separation(space, a**2 + b**2 + space.t * y, polar)
    with pytest.raises(InputError, match="coordinates here are 2"):
        separation(NAMES[3], NAMES[3].p[0] ** 2, polar)
    with pytest.raises(InputError, match="those of 2 dimensions"):
        orthogonal_coordinates("polar", 3)
    with pytest.raises(InputError, match="unknown coordinates"):
        orthogonal_coordinates("toroidal", 3)


u = sp.Symbol("u", positive=True)
theta = sp.Symbol("theta", real=True)


@pytest.mark.parametrize(
    ("square", "at"),
    [
        (sp.Integer(3), 1), (5 - 2 * u, 1), (7 + 2 * u - u**2, 1), (7 + 2 * u - u**2, 3), (4 - u**2, 1),
        (-2 + 5 / u - 1 / u**2, sp.Rational(1, 3)), (-2 + 5 / u - 1 / u**2, 2), (-2 + 5 / u, 2), (5 / u - 2 / u**2, 1),
        (5 - 2 / u**2, 1), (7 - u**2 - 2 / u**2, 1), (7 - u**2 - 2 / u**2, 2), (3 + 2 * u**2 - u**4, 1),
        (5 - 2 / sp.sin(theta) ** 2, 1), (5 - 2 / sp.sin(theta) ** 2, 2),
    ],
)  # fmt: skip
def test_the_integral_of_a_root_has_it_as_its_derivative(square: Any, at: Any) -> None:
    """With its sign, on either side of the middle of the motion."""
    x = theta if square.has(theta) else u
    found = root_integral(square, x)
    if square == 3 + 2 * u**2 - u**4 or square == 5 - 2 / u**2:
        assert found is None or abs(sp.N((found.diff(x) - sp.sqrt(square)).subs(x, at), 20)) < 1e-15
        return
    assert found is not None
    assert abs(sp.N((found.diff(x) - sp.sqrt(square)).subs(x, at), 20)) < 1e-15


@pytest.mark.slow
def test_a_characteristic_function_solves_the_reduced_equation() -> None:
    """Kepler in spherical coordinates with numbers of a bound orbit, between its turning points."""
    space = NAMES[3]
    m, k = space.symbols("m k")
    H = sum(p**2 for p in space.p) / (2 * m) - k / sp.sqrt(sum(x**2 for x in space.q))
    spherical = orthogonal_coordinates("spherical", 3)
    made = characteristic_function(separation(space, H, spherical))
    assert made is not None
    E, a2, a3 = made.constants
    at = {m: sp.Rational(6, 5), k: 2, E: sp.Rational(-7, 10), a2: sp.Rational(2, 5), a3: sp.Rational(1, 9)}
    r, polar, phi = spherical.u
    point = at | {r: 1, polar: sp.Rational(7, 5), phi: sp.Rational(1, 3)}
    assert abs(sp.N(made.residual().xreplace(point), 25)) < 1e-20
    assert {c.terms for c in made.space.domain.conditions} == {(polar,), (sp.pi - polar,)}
    assert abs(sp.N(made.hessian().xreplace(point), 25).det()) > 1e-3


def test_actions_of_a_separated_system() -> None:
    """Kepler: J_φ = 2π|α|, J_θ = 2π(√2α₂ − |p_φ|), J_r = 2π(k √(m/−2E) − √(2α₂)) by areas."""
    space = NAMES[3]
    m, k = space.symbols("m k")
    H = sum(p**2 for p in space.p) / (2 * m) - k / sp.sqrt(sum(x**2 for x in space.q))
    made = separation(space, H, orthogonal_coordinates("spherical", 3))
    E, a2, a3 = made.constants()
    at = {m: sp.Rational(6, 5), k: 2, E: sp.Rational(-7, 10), a2: sp.Rational(2, 5), a3: sp.Rational(1, 9)}
    size, axis = sp.sqrt(2 * a2), sp.sqrt(2 * a3)
    wanted = (k * m / sp.sqrt(-2 * m * E) - size, size - axis, axis)
    found = separated_actions(made)
    for x, value in zip(made.coordinates.u, wanted, strict=True):
        closed = found[x]
        assert closed is not None
        assert abs(sp.N((closed.value - 2 * sp.pi * value).xreplace(at), 20)) < 1e-15
    polar = separation(NAMES[2], sum(p**2 for p in NAMES[2].p) / 2 + NAMES[2].q[0] ** 2, system("cartesian", 2))
    assert separated_actions(polar)[polar.coordinates.u[1]] is None  # a free direction has no libration


def test_levi_civitas_conditions() -> None:
    """They vanish for Kepler's H in parabolic coordinates with their momenta, and not in Cartesian ones."""
    space = PhaseSpace("xi eta", "p_xi p_eta", positive="xi eta")
    (x, y), (a, b) = space.q, space.p
    H = ((a**2 + b**2) / 2 - 2) / (x**2 + y**2)
    point = somewhere({x, y, a, b})
    assert is_zero(levi_civita(space, H)[x, y], point)
    assert not is_zero(levi_civita(space, H + x * y / 1000)[x, y], point)
    assert is_zero(levi_civita(space, a**2 * x + sp.exp(b) * y)[x, y], point)
    assert not is_zero(levi_civita(space, a * b + x * y**2)[x, y], point)
    for one in ((a**2 + x**2) * (b**2 + sp.sin(y)), sp.sqrt(a * x + sp.exp(b) / y), (a + x) / (b + y**2)):
        assert is_zero(levi_civita(space, one)[x, y], point)
        assert not is_zero(levi_civita(space, one + a * y / 1000)[x, y], point)
    three = NAMES[3]
    assert set(levi_civita(three, sum(p**2 for p in three.p))) == {
        (three.q[0], three.q[1]), (three.q[0], three.q[2]), (three.q[1], three.q[2]),
    }  # fmt: skip
    assert systems_of(2) == ("cartesian", "polar", "parabolic", "elliptic")
    assert systems_of(3) == ("cartesian", "cylindrical", "spherical", "parabolic", "prolate spheroidal")


def test_degrees_inside_one_another() -> None:
    """A central field: first p_θ² + p_φ²/sin²θ, then H; the levels are those of the motion, and φ is cyclic."""
    space = PhaseSpace("r theta phi", "p_r p_theta p_phi", positive="r m")
    (r, polar, phi), (a, b, c), m = space.q, space.p, space.symbol("m")
    H = (a**2 + b**2 / r**2 + c**2 / (r**2 * sp.sin(polar) ** 2)) / (2 * m) - 1 / r
    found = nested_degrees(H, space.q, space.p)
    assert found is not None
    (inner, outer), cyclic = found
    assert cyclic == ((phi, c),)
    assert (inner.q, inner.p, outer.q, outer.p) == (polar, b, r, a)
    point = somewhere({*space.old, m})
    assert is_zero(inner.value - (b**2 + c**2 / sp.sin(polar) ** 2), point)
    assert is_zero(inner.H - inner.value, point)
    assert is_zero(outer.H.xreplace({inner.level: inner.value}) - H, point)
    assert outer.value == H
    assert nested_degrees(a**2 + b**2 + r * sp.cos(polar), (r, polar), (a, b)) is None
    assert nested_degrees(a**2 + r**2 * b**4 + polar**2, (r, polar), (a, b)) is None
    four = PhaseSpace("w x y z", "a b c d")
    (w, x, y, z), (p1, p2, p3, p4) = four.q, four.p
    H = p1**2 + w**2 * (p2**2 + x**2 * (p3**2 + y**4 + p4))
    levels = nested_degrees(H, four.q, four.p)
    assert levels is not None
    assert [d.q for d in levels[0]] == [y, x, w]
    assert levels[1] == ((z, p4),)
    for one, two in zip(levels[0], levels[0][1:], strict=False):
        assert sp.expand(replaced(two.H, {one.level: one.value}) - two.value) == 0
