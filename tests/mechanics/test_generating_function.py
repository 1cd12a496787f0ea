from itertools import product

import pytest
import sympy as sp

from canon import GeneratingFunction, InputError, PhaseSpace, Transformation, recovered, verify

OSCILLATOR = PhaseSpace("q", "p", new=("phi", "I"), positive="m omega")
q, p, phi, I, m, omega = OSCILLATOR.symbols("q p phi I m omega")
F1 = GeneratingFunction(OSCILLATOR, type=1, F=m * omega * q**2 * sp.cot(phi) / 2)
H = p**2 / (2 * m) + m * omega**2 * q**2 / 2
ONE = PhaseSpace("q", "p", new=("Q", "P"))
TWO = PhaseSpace("q1 q2", "p1 p2", new=("Q1 Q2", "P1 P2"))


def test_the_equations_of_the_four_types():
    """Goldstein, Poole and Safko (2002), table 9.1."""
    x, y, Q, P = *ONE.old, *ONE.new
    f = sp.Function("f")
    assert GeneratingFunction(ONE, 1, f(x, Q)).conjugates() == {y: f(x, Q).diff(x), P: -f(x, Q).diff(Q)}
    assert GeneratingFunction(ONE, 2, f(x, P)).conjugates() == {y: f(x, P).diff(x), Q: f(x, P).diff(P)}
    assert GeneratingFunction(ONE, 3, f(y, Q)).conjugates() == {x: -f(y, Q).diff(y), P: -f(y, Q).diff(Q)}
    assert GeneratingFunction(ONE, 4, f(y, P)).conjugates() == {x: -f(y, P).diff(y), Q: f(y, P).diff(P)}


@pytest.mark.parametrize("types", list(product((1, 2, 3, 4), repeat=2)))
def test_every_pattern_of_types_gives_a_symplectic_map(types, vanishes):
    a, b, A, B = (u := GeneratingFunction(TWO, types, 0).mixed)
    F = GeneratingFunction(TWO, types, a * A + 2 * b * B + a**2 * B + sp.sin(b * A) + a * b * A * B)
    assert F.mixed == u
    assert vanishes(F.symplectic_residual())
    old, hessian = F.old_jacobian().det(), F.mixed_hessian().det()
    assert vanishes(old**2 - hessian**2)


def test_the_oscillator_from_function_to_map_to_new_hamiltonian(vanishes):
    forward, backward = F1.transformation().forward(), F1.transformation().backward()
    assert forward.expressions == (sp.atan(m * omega * q / p), m * omega * q**2 / 2 + p**2 / (2 * m * omega))
    assert vanishes(forward.symplectic_residual())
    assert vanishes(backward.symplectic_residual())
    assert not backward.q[0].expr.has(sp.Abs)
    assert F1.transformation().transformed(H) == omega * I


@pytest.mark.parametrize("kind", [2, 3, 4])
def test_the_oscillator_in_the_other_types(kind, vanishes):
    other = F1.converted(kind)
    given = {**dict(zip(OSCILLATOR.new, F1.transformation().forward().expressions, strict=True))}
    for variable, formula in other.conjugates().items():
        value = given.get(variable, variable)
        assert vanishes(formula.subs(given, simultaneous=True) - value)


@pytest.mark.parametrize(("first", "second"), [(1, 2), (1, 3), (1, 4), (2, 3), (2, 4), (3, 4), (2, 1), (4, 1)])
def test_types_there_and_back(first, second, vanishes):
    old, new = GeneratingFunction(ONE, first, 0).mixed
    F = GeneratingFunction(ONE, first, 3 * old * new + old**2 + 2 * new**2)
    back = F.converted(second).converted(first)
    assert vanishes(back.F.expr - F.F.expr)


def test_mixed_types_convert_in_each_degree_of_freedom(vanishes):
    a, b, A, B = GeneratingFunction(TWO, (2, 1), 0).mixed
    F = GeneratingFunction(TWO, (2, 1), a * A + 2 * b * B + a**2 + a * b + B**2 + A**2 + A * B)
    other = F.converted((3, 4))
    assert other.types == (3, 4)
    assert vanishes(other.converted((2, 1)).F.expr - F.F.expr)


def test_the_identity_has_no_function_of_type_one():
    x, P = ONE.q[0], ONE.P[0]
    identity = GeneratingFunction(ONE, 2, x * P)
    assert identity.transformation().forward().expressions == ONE.old
    with pytest.raises(InputError, match="no generating function of type 1"):
        identity.converted(1)


@pytest.mark.parametrize("kind", [1, 2, 3, 4])
def test_a_function_is_recovered_from_the_map(kind, vanishes):
    quarter = OSCILLATOR.where(p > 0, q > 0)
    found = recovered(GeneratingFunction(quarter, type=1, F=F1.F).transformation().forward(), kind)
    assert vanishes(found.residuals)
    assert found.generating_function.type == kind


@pytest.mark.parametrize(
    ("region", "angle", "kind"),
    [
        ("p < 0", "atan(q/p)", 2),
        ("p < 0", "atan2(q, p)", 1),
        ("q < 0", "-atan(p/q)", 4),
        ("q < 0", "atan2(q, p)", 3),
        ("q < 0", "atan(q/p)", 1),
    ],
)
def test_a_recovered_function_is_right_throughout_the_domain(region, angle, kind):
    space = PhaseSpace("q", "p", new=("phi", "I")).where(region)
    map_ = Transformation(space, Q=space.formula(angle), P=space.formula("(q**2 + p**2)/2"))
    F = map_.generating_function_of(kind)
    x, y, phi, I = map(space.symbol, ("q", "p", "phi", "I"))
    at = {x: -sp.Rational(3, 7), y: -sp.Rational(5, 7)}
    at |= {phi: map_.Q[0].expr.subs(at), I: map_.P[0].expr.subs(at)}
    for variable, formula in F.conjugates().items():
        assert abs(complex((formula - variable).subs(at).evalf())) < 1e-12
    assert verify(map_.has_generating_function(kind, F.F)).status == "proved"


@pytest.mark.parametrize(
    ("region", "angle", "kind"),
    [("q + p > 0", "atan2(q, p)", 2)],
)
def test_what_is_several_functions_on_the_domain_is_not_recovered(region, angle, kind):
    """p = ±√(2I − q²) where q + p > 0: no one function of q and I is F of type 2."""
    space = PhaseSpace("q", "p", new=("phi", "I")).where(region)
    map_ = Transformation(space, Q=space.formula(angle), P=space.formula("(q**2 + p**2)/2"))
    with pytest.raises(InputError, match=f"no generating function of type {kind} .* throughout the domain"):
        map_.generating_function_of(kind)


def test_a_branch_is_looked_at_where_residuals_vanish_but_are_not_seen_to():
    """sin p = q exp(Q) has two solutions p in (0, 3)."""
    space = PhaseSpace("q", "p", new=("Q", "P")).where("q > 0", "p > 0", "p < 3")
    map_ = Transformation(space, Q=space.formula("log(sin(p)/q)"), P=space.formula("q*cot(p)"))
    with pytest.raises(InputError, match=r"no generating function of type 1 .* throughout the domain"):
        map_.generating_function_of(1)


def test_recovery_shows_that_a_map_is_not_canonical(vanishes):
    x, y = ONE.old
    found = recovered(Transformation(ONE, Q=y, P=-2 * x), 1)
    assert not vanishes(found.residuals)


@pytest.mark.parametrize(
    ("new", "kind"), [(("2*q", "p"), 2), (("q*exp(p)", "exp(-p)"), 2), (("p", "-2*q"), 1), (("q + p**2", "p*q"), 3)]
)
def test_a_map_that_is_not_canonical_has_no_generating_function(new, kind):
    """F = P q + P was found for (2q, p), and nothing said that dF leaves 1 − q."""
    Q, P = map(ONE.formula, new)
    with pytest.raises(
        InputError, match=r"isn't canonical, so no function generates it|no generating function of type"
    ):
        Transformation(ONE, Q=Q, P=P).generating_function_of(kind)


def test_the_inverse_map_has_the_negative_function(vanishes):
    x, P = ONE.q[0], ONE.P[0]
    F = GeneratingFunction(ONE, 2, x * P + P**2 + x**2)
    inverse = F.inverse()
    assert inverse.type == 3
    there, back = F.transformation().forward(), inverse.transformation().forward()
    both = back.after(there)
    assert vanishes(u - v for u, v in zip(both.expressions, ONE.old, strict=True))


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: GeneratingFunction(ONE, 5, 0), "no type 5"),
        (lambda: GeneratingFunction(TWO, (1, 2, 3), 0), "3 types for 2 degrees"),
        (lambda: GeneratingFunction(ONE, 1, ONE.p[0]), "of type 1 is a function of q, Q, not of p"),
        (lambda: GeneratingFunction(PhaseSpace("q", "p"), 1, 0), "as many new pairs"),
    ],
)
def test_what_is_ill_posed_is_an_input_error(build, message):
    with pytest.raises(InputError, match=message):
        build()


def test_it_shows_itself_in_latex():
    assert repr(F1) == f"GeneratingFunction({F1})"
    assert repr(F1.F) == "Formula(m*omega*q**2*cot(phi)/2, where sin(phi) != 0)"
    assert "F_{1}(q, \\phi)" in F1._repr_latex_()
    assert F1.transformation()._repr_latex_() == F1._repr_latex_()


def test_time_in_a_generating_function_is_what_the_hamiltonian_gains():
    x, P, t = ONE.q[0], ONE.P[0], ONE.t
    F = GeneratingFunction(ONE, 2, x * P + t**2 * x + 3 * t * P)
    assert F.time_derivative() == 2 * t * x + 3 * P
    assert GeneratingFunction(ONE, 2, x * P).time_derivative() == 0


def test_the_inverse_of_a_map_that_is_known_by_its_function_alone():
    x, P = ONE.q[0], ONE.P[0]
    implicit = GeneratingFunction(ONE, 2, x * P + P**5 + x**5 * P).transformation()
    there = implicit.generating_function
    back = implicit.inverse().generating_function
    assert back.types == (3,)
    assert back.F.expr == -there.F.expr
    assert back.space.old == there.space.new


@pytest.mark.parametrize("types", [1, 2, 3, 4, (1, 4), (2, 3)])
def test_the_inverse_generates_the_inverse_map(types, vanishes):
    """−F with old and new exchanged: of a quadratic F of each type the matrices are inverse to one another."""
    u = GeneratingFunction(TWO, types, 0).mixed
    F = GeneratingFunction(TWO, types, u[0] * u[2] + 2 * u[1] * u[3] + u[0] * u[3] + u[0] ** 2 / 2 + u[3] ** 2 / 3)
    forth, back = (each.transformation().forward().jacobian() for each in (F, F.inverse()))
    assert vanishes(forth * back - sp.eye(4))
