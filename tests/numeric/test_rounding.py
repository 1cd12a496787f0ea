"""Lowering, derivatives and residuals: right values, and bounds that hold against exact arithmetic."""

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
import sympy as sp

from canon import InputError
from canon.numeric.differentiable import differentiable
from canon.numeric.lower import lower
from canon.numeric.precision import double
from canon.numeric.residuals import brackets, determinants, invariants
from canon.numeric.rounding import Unbounded, with_rounding

Array = np.ndarray
x, y = sp.symbols("x y", real=True)


@pytest.mark.parametrize(
    "expression",
    [
        x**2 - 3 * y / 7,
        sp.sqrt(x**2 + y**2) ** 3 + 1 / sp.sqrt(x),
        sp.atan2(y, x) * sp.exp(-x) + sp.log(x) * sp.pi,
        sp.cot(x) + sp.sec(y) * sp.tanh(x) + sp.Abs(y - 2) + sp.sign(y),
        x ** sp.Rational(1, 3) + x**y + sp.asinh(y),
    ],
)
def test_formulas_have_their_values(expression: sp.Expr) -> None:
    with double():
        (value,) = lower((expression,), (x, y))(jnp.float64(0.7), jnp.float64(1.3))
        assert float(value) == pytest.approx(float(expression.subs({x: 0.7, y: 1.3})), rel=1e-14)


def test_lowering_is_cached_and_names_what_is_missing() -> None:
    assert lower((x * y,), (x, y)) is lower((x * y,), (x, y))
    with pytest.raises(InputError, match="no value is given for y"):
        lower((x * y,), (x,))
    with pytest.raises(InputError, match="complex"):
        lower((sp.I * x,), (x,))
    with pytest.raises(InputError, match="zeta has no numerical form"):
        lower((sp.zeta(x),), (x,))


def test_the_running_bound_holds_where_digits_cancel() -> None:
    """(1 + t)³ − 1 − 3t − 3t² − t³ is 0: what floats leave is rounding, and less than the bound says."""

    def cancels(t: Any) -> Any:
        return (1 + t) * (1 + t) * (1 + t) - 1 - 3 * t - 3 * t * t - t * t * t

    with double():
        points = jnp.linspace(-2.0, 2.0, 101)
        values, bounds = map(np.asarray, jax.vmap(with_rounding(cancels, points[0]))(points))
    assert np.max(np.abs(values)) > 0
    assert np.all(np.abs(values) <= bounds)
    assert np.max(bounds) < 1e-13


def test_the_running_bound_holds_against_exact_numbers() -> None:
    def program(t: Any) -> Any:
        for _ in range(6):
            t = 3.5 * t * (1 - t)
        return t / (t + 0.25)

    with double():
        for k in range(1, 20):
            start = k / 20
            value, bound = with_rounding(program, jnp.float64(0.0))(jnp.float64(start))
            exact = program_exactly(Fraction(start))
            assert abs(Fraction(float(value)) - exact) <= Fraction(float(bound))


def program_exactly(t: Fraction) -> Fraction:
    for _ in range(6):
        t = Fraction(3.5) * t * (1 - t)
    return t / (t + Fraction(1, 4))


@pytest.mark.parametrize(
    "function",
    [
        lambda z: jax.lax.fori_loop(0, 5, lambda _, w: jnp.sin(w) + w, z),
        lambda z: jnp.where(z > 0, z, z**2).at[0].add(1.0),
        lambda z: jax.lax.cond(z[0] > 0, lambda w: w, lambda w: 2 * w, z),
        lambda z: jnp.tanh(jnp.ones((2, 2)) @ z) + jnp.linalg.norm(z),
    ],
)
def test_programs_with_rules(function: Callable[[Any], Any]) -> None:
    with double():
        z = jnp.array([0.3, -0.4])
        value, bound = with_rounding(function, z)(z)
        assert np.allclose(value, function(z), rtol=1e-14)
        assert np.all(np.isfinite(bound))
        assert np.all(bound < 1e-13)


def test_a_program_without_a_rule_is_refused() -> None:
    with double(), pytest.raises(Unbounded):
        with_rounding(lambda z: jax.lax.while_loop(lambda w: w[0] < 9.0, lambda w: 2 * w, z), jnp.ones(2))


def kinked(z: Array) -> Array:
    """|q| is not analytic, so that the complex step does not serve."""
    return np.array([z[0] + np.abs(z[1]), z[1] + 0 * z[0]])


def smooth(z: Array) -> Array:
    return np.array([z[0] + np.exp(z[1]), z[1] * np.cos(z[0])])


@pytest.mark.parametrize(("function", "method"), [(kinked, "central differences"), (smooth, "complex step")])
def test_black_boxes_have_derivatives_within_their_estimates(function: Any, method: str) -> None:
    points = np.random.default_rng(0).uniform(-1, 1, (200, 2))
    map = differentiable(function, points, np.full(2, 2.0))
    assert (map.method, map.errors) == (method, "estimate")
    M, E = map.linearise(points)
    a, b = points.T
    if function is kinked:
        exact = np.array([[np.ones(200), np.sign(b)], [np.zeros(200), np.ones(200)]])
    else:
        exact = np.array([[np.ones(200), np.exp(b)], [-b * np.sin(a), np.cos(a)]])
    assert np.all(np.abs(M - np.moveaxis(exact, 2, 0)) <= E)
    assert np.median(E) < 1e-11


def test_brackets_are_the_blocks_of_the_symplectic_condition() -> None:
    rng = np.random.default_rng(1)
    M = rng.normal(size=(20, 6, 6))
    J = np.block([[np.zeros((3, 3)), np.eye(3)], [-np.eye(3), np.zeros((3, 3))]])
    full = M @ J @ np.swapaxes(M, 1, 2)
    found = brackets(M, np.zeros_like(M))
    assert np.allclose(found.QQ, full[:, :3, :3])
    assert np.allclose(found.QP, full[:, :3, 3:])
    assert np.allclose(found.PP, full[:, 3:, 3:])


def test_the_last_invariant_is_the_determinant() -> None:
    M = np.random.default_rng(2).normal(size=(20, 4, 4))
    det, bound, _ = determinants(M, np.zeros_like(M), np.array([1.0, 2.0, 3.0, 4.0]))
    assert np.allclose(det, np.linalg.det(M))
    assert np.all(bound < 1e-10)
    first, second = invariants(M, np.zeros_like(M), 1.0)
    J = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.eye(2), np.zeros((2, 2))]])
    lagrange = np.swapaxes(M, 1, 2) @ J @ M - J
    assert np.allclose(first.sizes.max(axis=1), np.abs(lagrange).max(axis=(1, 2)))
    assert np.allclose(second.sizes[:, 0], np.abs(det - 1))


def exact(M: Array) -> sp.Matrix:
    return sp.Matrix(M.shape[0], M.shape[1], [sp.Rational(*float(x).as_integer_ratio()) for x in M.ravel()])


def test_sums_and_determinants_of_exact_entries_have_bounds_for_their_own_rounding() -> None:
    """Of entries that are not off at all, brackets and det M are off by what was rounded on the way, and no more."""
    M = np.random.default_rng(3).normal(size=(20, 6, 6))
    M[:, :3] = M[:, 3:] + 1e-3 * M[:, :3]  # terms that cancel: their sum's own last digit is finer than theirs
    found = brackets(M, np.zeros_like(M))
    det, det_bound, _ = determinants(M, np.zeros_like(M), np.ones(6))
    J = sp.Matrix(np.block([[np.zeros((3, 3)), np.eye(3)], [-np.eye(3), np.zeros((3, 3))]]).astype(int))
    finer = 0
    for k in range(20):
        E = exact(M[k])
        full = E * J * E.T
        for off, value, bound in (
            (full[:3, :3], found.QQ[k], found.QQ_bound[k]),
            (full[:3, 3:], found.QP[k], found.QP_bound[k]),
            (full[3:, 3:], found.PP[k], found.PP_bound[k]),
        ):
            error = np.array((off - exact(value)).tolist(), dtype=float)
            assert np.all(np.abs(error) <= bound)
            finer += int((np.abs(error) > 2.0**-52 * np.abs(value)).sum())
        error = abs(float(E.det() - sp.Rational(*float(det[k]).as_integer_ratio())))
        assert 0 < error <= det_bound[k] < 1e-6
    assert finer > 20
