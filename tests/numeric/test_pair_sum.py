"""Sums over pairs: the same values and slopes as all their terms written out, in a program of constant length."""

from itertools import pairwise

import jax
import jax.numpy as jnp
import numpy as np
import pytest
import sympy as sp

from canon.numeric.gradient import gradient, poisson_terms
from canon.numeric.lower import lower
from canon.numeric.pair_kernel import AT_ONCE
from canon.numeric.pair_sum import RADIUS, PairSlope, PairSum
from canon.numeric.precision import double
from canon.numeric.rows import lower_rows

t = sp.Symbol("t", real=True)
LAWS = {
    "gravity": -sp.Rational(3, 2) / RADIUS,
    "softened": -1 / sp.sqrt(RADIUS**2 + sp.Rational(1, 100)),
    "linear": RADIUS,
    "yukawa": sp.exp(-RADIUS) / RADIUS,
    "in time": sp.cos(t) * RADIUS**3,
}


def pairs(bodies: int, dimension: int, law: sp.Expr = LAWS["gravity"], weighted: bool = True) -> PairSum:
    places = [[sp.Symbol(f"x{i}_{k}", real=True) for k in range(dimension)] for i in range(bodies)]
    return PairSum(law, places, [sp.Rational(i + 1, 3) for i in range(bodies)] if weighted else None)


def numbers(of: PairSum, samples: int = 7) -> np.ndarray:
    return np.random.default_rng(5).standard_normal((len(of.coordinates), samples))


@pytest.mark.parametrize(
    ("law", "bodies", "dimension"),
    [
        *((law, 4, 2) for law in LAWS),
        ("gravity", 5, 3),
        pytest.param("gravity", 6, 1, marks=pytest.mark.slow),
    ],
)
def test_values_and_slopes_are_those_of_the_terms_written_out(law: str, bodies: int, dimension: int) -> None:
    of = pairs(bodies, dimension, LAWS[law], weighted=law != "softened" and bodies != 5)
    written = of.written_out()
    z, place = numbers(of), (*of.coordinates, t)
    formulas = (of, of.diff(t), *(of.diff(x) for x in of.coordinates))
    expected = lower((written, written.diff(t), *(written.diff(x) for x in of.coordinates)), place)
    wanted = np.array([np.broadcast_to(x, 7) for x in expected(*z, 0.4, numbers=np)])
    found = np.array([np.broadcast_to(x, 7) for x in lower(formulas, place)(*z, 0.4, numbers=np)])
    assert found == pytest.approx(wanted, rel=1e-12, abs=1e-12)
    with double():
        rows = lower_rows(formulas, of.coordinates, (t,))
        assert np.asarray(rows(jnp.asarray(z), 0.4)) == pytest.approx(wanted, rel=1e-12, abs=1e-12)
        one = np.asarray(jax.jit(rows)(jnp.asarray(z[:, 0]), 0.4))
        assert one == pytest.approx(wanted[:, 0], rel=1e-12, abs=1e-12)


def test_many_bodies_one_by_one_are_the_same_as_all_at_once() -> None:
    of = pairs(AT_ONCE + 5, 3)
    z = numbers(of, 1)
    slopes = lower_rows(gradient(of, of.coordinates), of.coordinates)
    with double():
        found = np.asarray(jax.jit(slopes)(jnp.asarray(z[:, 0])))
    assert found == pytest.approx(slopes(z, numbers=np)[:, 0], rel=1e-12)
    assert np.abs(found.reshape(-1, 3).sum(axis=0)).max() < 1e-12 * np.abs(found).max()
    places, w = z.reshape(-1, 3), np.arange(1, AT_ONCE + 6) / 3
    apart = places[7] - np.delete(places, 7, axis=0)
    pull = 1.5 * w[7] * np.delete(w, 7)[:, None] * apart / np.linalg.norm(apart, axis=1)[:, None] ** 3
    assert found[21:24] == pytest.approx(pull.sum(axis=0), rel=1e-12)


def test_the_program_has_constant_length_and_needs_memory_in_proportion_to_the_bodies() -> None:
    programs = []
    for bodies in (40, 160):
        of = pairs(bodies, 3)
        with double():
            programs.append(
                jax.make_jaxpr(lower_rows(gradient(of, of.coordinates), of.coordinates))(np.ones(3 * bodies))
            )
    lengths = [str(program).count("\n") for program in programs]
    assert lengths[0] == lengths[1] < 120
    for bodies, program in zip((40, 160), programs, strict=True):
        assert max(sizes(program.jaxpr)) <= 3 * bodies


def sizes(jaxpr: object):
    for equation in jaxpr.eqns:  # type: ignore[attr-defined]
        for value in equation.params.values():
            inner = getattr(value, "jaxpr", value)
            if hasattr(inner, "eqns"):
                yield from sizes(inner)
        yield from (int(np.prod(out.aval.shape)) for out in equation.outvars)


def test_a_collision_is_not_passed_over() -> None:
    of = pairs(4, 2)
    z = numbers(of, 1)[:, 0]
    z[2:4] = z[0:2]
    slopes = lower_rows(gradient(of, of.coordinates), of.coordinates)
    with double():
        assert not np.isfinite(np.asarray(slopes(jnp.asarray(z)))).all()


def test_second_derivatives_are_those_of_the_terms() -> None:
    of = pairs(4, 2)
    x = of.coordinates
    assert of.diff(x[0]) == PairSlope(of, 0) != PairSlope(of, 1)
    assert sp.simplify(of.diff(x[0], x[3]) - of.written_out().diff(x[0], x[3])) == 0
    assert of.diff(sp.Symbol("other")) == 0


@pytest.mark.slow
def test_the_tangent_map_is_finite_and_symmetric() -> None:
    """The second derivatives that jax takes of the slopes: a body's distance from itself must leave no nan."""
    for bodies in (5, AT_ONCE + 1):
        of = pairs(bodies, 2)
        with double():
            slopes = lower_rows(gradient(of, of.coordinates), of.coordinates)
            hessian = np.asarray(jax.jacfwd(slopes)(jnp.asarray(numbers(of, 1)[:, 0])))
        assert np.isfinite(hessian).all()
        assert np.abs(hessian - hessian.T).max() < 1e-12 * np.abs(hessian).max()


def test_an_atom_is_itself_in_sums_and_products() -> None:
    of, other = pairs(4, 2), pairs(4, 2, LAWS["linear"])
    assert of == pairs(4, 2) != other
    assert hash(of) == hash(pairs(4, 2))
    assert of - pairs(4, 2) == 0 != of - other
    assert of.free_symbols == {*of.coordinates}
    assert other.diff(t) == 0 != pairs(4, 2, LAWS["in time"]).diff(t)
    assert not (1 + of).is_polynomial(of.coordinates[0])
    assert "6 pairs of 4 bodies" in str(2 * of)


def test_gradients_of_long_sums_are_sympys() -> None:
    x = sp.symbols("x0:6", real=True)
    H = sum(y**2 / (k + 1) for k, y in enumerate(x)) + sum(sp.cos(a - b) for a, b in pairwise(x)) + x[0] * x[3] ** -2
    assert gradient(H, x) == tuple(map(H.diff, x))
    q, p = x[:3], x[3:]
    bracket = sum(H.diff(a) * x[4].diff(b) - H.diff(b) * x[4].diff(a) for a, b in zip(q, p, strict=True))
    assert sp.expand(sum(poisson_terms(H, x[4], q, p)) - bracket) == 0
