"""Normal forms by Lie series: Hénon and Heiles (Gustavson 1966), the pendulum, resonances, what isn't semisimple."""

import pytest
import sympy as sp

from canon.errors import InputError
from canon.mechanics.birkhoff import NoNormalForm, birkhoff_gustavson, exponential, lie_transformed, resonances
from canon.mechanics.graded_algebra import algebra_over
from canon.mechanics.homological import semisimple, split
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.taylor_polynomial import homogeneous_parts

PLANE = PhaseSpace("x y", "px py")
X, Y, PX, PY = PLANE.symbols("x y px py")
ISOTROPIC = (PX**2 + PY**2 + X**2 + Y**2) / 2
HENON_HEILES = ISOTROPIC + X**2 * Y - Y**3 / 3
LINE = PhaseSpace("q", "p", positive="omega")
Q, P, OMEGA = LINE.symbols("q p omega")


def test_henon_heiles_to_order_12_in_invariants_of_the_resonance():
    found = birkhoff_gustavson(PLANE, HENON_HEILES, 12)
    L, u, v = X * PY - Y * PX, X * Y + PX * PY, (X**2 + PX**2 - Y**2 - PY**2) / 2
    fourth = -sp.Rational(5, 12) * ISOTROPIC**2 + sp.Rational(7, 12) * L**2
    sixth = -sp.Rational(67, 432) * ISOTROPIC**3 - sp.Rational(7, 144) * ISOTROPIC * L**2
    sixth += sp.Rational(7, 18) * (v**3 - 3 * v * u**2)
    assert sp.expand(found.term(4) - fourth) == 0
    assert sp.expand(found.term(6) - sixth) == 0
    assert [found.term(degree) for degree in (3, 5, 7, 9, 11)] == [0] * 5
    for degree in (8, 10, 12):
        part = found.parts[degree]
        assert part != 0
        assert found.algebra.bracket(part, found.parts[2]) == 0


def test_the_transformation_is_symplectic_order_by_order_and_leads_to_the_normal_form():
    found = birkhoff_gustavson(PLANE, HENON_HEILES, 4)
    assert birkhoff_gustavson(PLANE, HENON_HEILES, 8).symplectic_defect() == {}
    assert found.symplectic_defect() == {}
    images = dict(zip(PLANE.old, found.transformation(), strict=True))
    difference = sp.Poly(HENON_HEILES.subs(images, simultaneous=True) - found.hamiltonian(), *PLANE.old)
    assert min(map(sum, difference.monoms())) == 5  # by substitution, without a Lie series


def test_the_homological_equation_is_solved_inside_the_image_of_ad():
    """R = N + {χ, H₂}, {N, H₂} = 0, and χ has no part that commutes with H₂; to order 4 the map has degree 3."""
    found = birkhoff_gustavson(PLANE, HENON_HEILES, 4)
    algebra, H2 = found.algebra, found.parts[2]
    x, y, u, v = algebra.generators
    for R in ((x**2 + u * y) * (v + x) ** 2, x**4 + y**4, x * y * u):
        N, chi = split(algebra, H2, R)
        assert algebra.bracket(N, H2) == 0
        assert N + algebra.bracket(chi, H2) == R
        assert split(algebra, H2, chi)[0] == 0
    assert max(max(map(sum, sp.Poly(image, *PLANE.old).monoms())) for image in found.transformation()) == 3


def test_a_part_in_the_kernel_is_split_off_where_the_spectrum_is_lopsided():
    """{qᵃpᵇ, qp} = (a − b) qᵃpᵇ: of q²p² + q³p + q⁴ the first part is N, and χ has none of it."""
    algebra, (parts,) = homogeneous_parts(Q * P, (Q, P), 2)
    x, y = algebra.generators
    R = x**2 * y**2 * 3 + x**3 * y + x**4
    N, chi = split(algebra, parts[2], R)
    assert x**2 * y**2 * 3 == N
    assert chi * 4 == x**3 * y * 2 + x**4


def test_taylor_polynomials_are_those_of_the_series():
    """Products, compositions, negative and broken powers, each beside the derivatives at 0."""
    for f in (
        1 / (1 + Q) ** 2, sp.sqrt(4 + Q - P), (2 + Q * P) ** sp.Rational(-3, 2), sp.exp(Q) / (1 - P), sp.cos(Q + P**2),
        (1 + Q) ** 3 * sp.log(1 + P), sp.tan(Q) * OMEGA + OMEGA**2 * P, 1 / (sp.cosh(Q) + P),
    ):  # fmt: skip
        algebra, (parts,) = homogeneous_parts(f, (Q, P), 4)
        found = sum(algebra.expression(part) for part in parts.values())
        s = sp.Dummy("s")
        along = f.xreplace({Q: 2 * s / 3, P: 3 * s / 5})
        for k in range(5):
            wanted = along.diff(s, k).subs(s, 0) / sp.factorial(k)
            value = sp.expand(found.xreplace({Q: 2 * s / 3, P: 3 * s / 5})).coeff(s, k)
            assert abs(sp.N((value - wanted).xreplace({OMEGA: sp.Rational(7, 5)}), 20)) < 1e-15


def test_exponentials_of_a_bracket_are_the_lie_series():
    """Of a χ of one degree and of one with several; applied to a bracket it is that of the images."""
    algebra, (f, g, chi) = homogeneous_parts(Q**2 + P**3, (Q, P), 7, Q * P + Q**2, Q**3 - Q * P**2)
    c = sum(chi.values(), start=algebra.zero)
    several = c + algebra.generators[1] ** 4
    assert exponential(algebra, f, c, 7) == lie_transformed(algebra, f, c, 3, 7)
    total, term = algebra.zero, sum(f.values(), start=algebra.zero)
    for k in range(8):
        total = total + term
        term = algebra.bracket(term, several) * algebra.constant(sp.Rational(1, k + 1))
    found = exponential(algebra, f, several, 7)
    assert found == {d: part for d, part in algebra.parts(total).items() if d <= 7}
    images = [sum(exponential(algebra, h, several, 7).values(), start=algebra.zero) for h in (f, g)]
    product = algebra.parts(algebra.bracket(*(sum(h.values(), start=algebra.zero) for h in (f, g))))
    both = algebra.parts(algebra.bracket(*images))
    assert {d: both[d] for d in both if d <= 6} == {
        d: e for d, e in exponential(algebra, product, several, 6).items() if e
    }


def test_generators_are_shown_as_formulas():
    found = birkhoff_gustavson(PLANE, HENON_HEILES, 4)
    for degree in (3, 4):
        assert found.generator(degree) == found.algebra.expression(found.generators[degree]) != 0
    assert found.generator(5) == 0


def test_the_linear_flow_is_semisimple_where_no_root_is_double():
    for H2, expected in (
        (P**2 + Q**2, True), (P**2 - Q**2, True), (P**2, False), (Q * P, True), ((P - 2 * Q) ** 2, False),
    ):  # fmt: skip
        algebra, (parts,) = homogeneous_parts(H2, (Q, P), 2)
        assert semisimple(algebra, parts[2]) is expected


def test_coefficients_are_in_a_field_in_which_nothing_is_zero_unseen():
    """Square roots of numbers are, and parameters beside π; of functions of numbers it isn't known."""
    for numbers in ([sp.sqrt(2), sp.sqrt(3)], [sp.pi, OMEGA], [sp.Rational(1, 3)]):
        assert algebra_over((Q, P), numbers).one
    for numbers in ([sp.cos(1), sp.sin(1)], [sp.sqrt(2), sp.pi], [sp.log(2)]):
        with pytest.raises(ValueError, match="coefficients in"):
            algebra_over((Q, P), numbers)


def test_a_wrong_generator_is_seen():
    found = birkhoff_gustavson(PLANE, HENON_HEILES, 5)
    broken = dict(zip(PLANE.old, found.transformation(), strict=True))
    broken[X] += X**2 / 1000
    bracket = sum(
        broken[X].diff(a) * broken[PX].diff(b) - broken[X].diff(b) * broken[PX].diff(a) for a, b in ((X, PX), (Y, PY))
    )
    degrees = list(map(sum, sp.Poly(bracket - 1, *PLANE.old).monoms()))
    assert min(degrees) == 1


def test_the_pendulum():
    found = birkhoff_gustavson(LINE, P**2 / 2 + 1 - sp.cos(Q), 10)
    J = sp.Symbol("J")
    energy = J - J**2 / 16 - J**3 / 256 - 5 * J**4 / 8192 - 33 * J**5 / 262144
    assert sp.expand(found.hamiltonian() - energy.subs(J, (P**2 + Q**2) / 2)) == 0


def test_parameters_square_roots_and_saddles():
    found = birkhoff_gustavson(LINE, P**2 / 2 + OMEGA**2 * Q**2 / 2 + Q**4, 4)
    assert sp.expand(found.term(4) - 3 * (P**2 + OMEGA**2 * Q**2) ** 2 / (8 * OMEGA**4)) == 0
    H = (PX**2 + X**2) / 2 + sp.sqrt(2) * (PY**2 + Y**2) / 2 + X * Y**2
    found = birkhoff_gustavson(PLANE, H, 4)
    assert found.algebra.bracket(found.parts[4], found.parts[2]) == 0
    saddle = birkhoff_gustavson(LINE, P**2 / 2 - Q**2 / 2 + Q**4, 4)
    assert sp.expand(saddle.term(4) - 3 * (P**2 - Q**2) ** 2 / 8) == 0


def test_resonances():
    three = PhaseSpace("x y z", "u v w")
    x, y, z, u, v, w = three.symbols("x y z u v w")
    H2 = (u**2 + x**2) / 2 + (v**2 + 4 * y**2) / 2 - sp.sqrt(2) * (w**2 + z**2) / 2
    assert resonances(three, H2, 4) == [(2, -1, 0)]
    assert resonances(PLANE, ISOTROPIC, 6) == [(1, -1)]
    assert resonances(PLANE, (PX**2 + X**2 - PY**2 - Y**2) / 2, 6) == [(1, 1)]
    assert resonances(PLANE, X * PY, 6) is None


@pytest.mark.parametrize(
    ("H", "error", "words"),
    [
        (P**2 / 2 + Q, InputError, "no equilibrium"),
        (P**2 / 2 + sp.sqrt(Q), InputError, "isn't analytic at the origin"),
        (Q**3, InputError, "no quadratic part"),
        (P**2 / 2 + Q**4, NoNormalForm, "isn't semisimple"),
        (P**2 / 2 + Q**2 * sp.cos(1) + sp.sin(1) * Q**3, InputError, "coefficients in"),
    ],
)
def test_what_has_none(H, error, words):
    with pytest.raises(error, match=words):
        birkhoff_gustavson(LINE, H, 4)
