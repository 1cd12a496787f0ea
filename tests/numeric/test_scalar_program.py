"""jax programs taken apart: the same values and derivatives, sparse where they are; refused where not straight."""

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from canon.numeric.emit import run
from canon.numeric.precision import double
from canon.numeric.running_bound import run_bounded
from canon.numeric.scalar_program import Unscalar, scalar_program, values_and_jacobian
from canon.program import Builder, TooLong

Array = np.ndarray


def leapfrog(z: Any) -> Any:
    q, p = z[:2], z[2:]
    p = p - 0.05 * jnp.sin(q)
    q = q + 0.1 * p
    return jnp.concatenate([q, p - 0.05 * jnp.sin(q)])


def looped(z: Any) -> Any:
    return jax.lax.fori_loop(0, 3, lambda k, w: w + 0.1 * jnp.roll(w, 1) * jnp.cos(w[0]), z)


def layered(z: Any) -> Any:
    """A small network: matrix products, tanh, a residual."""
    A = np.arange(12.0).reshape(3, 4) / 10
    return z + A.T @ jnp.tanh(A @ z) / jnp.linalg.norm(z)


def scattered(z: Any) -> Any:
    w = jnp.zeros(4).at[np.array([2, 0])].set(z[:2]).at[1].set(z[3] ** 3)
    return jnp.where(w > 0.1, w, 2 * w) + jnp.cumsum(z) * jnp.maximum(z[0], 0.2)


def scanned(z: Any) -> Any:
    last, kept = jax.lax.scan(lambda w, a: (w * a, w[0]), z, jnp.array([1.0, 2.0, 0.5]), reverse=True)
    return last + jnp.sum(kept) + jnp.einsum("i,j->ij", z, z)[1]


def nested(z: Any) -> Any:
    angle = jnp.arctan2(z[0], z[1] + 2) + jax.nn.sigmoid(z[2]) + jnp.mod(z[3], 0.7) + jax.nn.softplus(z[0])
    return jnp.stack([angle, jnp.sqrt(z[0] ** 2 + 1), jnp.abs(z[1]) ** 1.5, jnp.log1p(z[2] ** 2)])


MAPS = [leapfrog, looped, layered, scattered, scanned, nested]


@pytest.mark.slow
@pytest.mark.parametrize("function", MAPS)
def test_values_and_jacobians_are_jaxs(function: Callable[[Any], Any]) -> None:
    program = values_and_jacobian(function, 4)
    points = np.random.default_rng(0).uniform(-1, 1, (7, 4))
    found = np.stack([np.broadcast_to(row, 7) for row in run(program, list(points.T))], axis=1)
    with double():
        values = jax.vmap(function)(points)
        M = jax.vmap(jax.jacfwd(function))(points)
    assert np.allclose(found[:, :4], values, rtol=1e-14, atol=1e-15)
    assert np.allclose(found[:, 4:].reshape(7, 4, 4), M, rtol=1e-13, atol=1e-15)


@pytest.mark.parametrize("function", MAPS)
def test_the_running_bound_covers_another_order_of_operations(function: Callable[[Any], Any]) -> None:
    """numpy's and the compiler's roundings differ, and both are within the bound of the exact number."""
    program = values_and_jacobian(function, 4)
    points = np.random.default_rng(1).uniform(-1, 1, (50, 4))
    pairs = run_bounded(program, list(points.T))
    with double():
        M = np.asarray(jax.jit(jax.vmap(jax.jacfwd(function)))(points)).reshape(50, 16)
    for k, (value, bound) in enumerate(pairs[4:]):
        assert np.all(np.abs(value - M[:, k]) <= 2 * np.asarray(bound))


def test_what_is_zero_or_one_is_no_operation() -> None:
    program = values_and_jacobian(leapfrog, 4)
    constants = [program.constant(node) for node in program.outputs[4:]]
    # q1′ depends on q1 and p1 alone, and so does p1′
    assert [constants[k] == 0 for k in (1, 3, 4, 6)] == [True] * 4
    assert len(program.operations) < 60


def test_numbers_of_formulas_are_rounded_ones() -> None:
    program = scalar_program(lambda z: z * 0.1, 1)
    ((_, exact),) = run_bounded(program, [np.ones(1)])
    ((_, rounded),) = run_bounded(program, [np.ones(1)], rounded_numbers=True)
    assert exact[0] == pytest.approx(2.0**-53 * 0.1)
    assert rounded[0] == pytest.approx(2.0**-52 * 0.1)


@pytest.mark.parametrize(
    ("function", "reason"),
    [
        (lambda z: jax.lax.while_loop(lambda w: w[0] < 9.0, lambda w: 2 * w, z), "depends on the point"),
        (lambda z: jnp.linalg.solve(jnp.eye(2) + jnp.outer(z, z), z), "operation|type"),
        (lambda z: z.astype(jnp.float32), "float32"),
        (lambda z: jnp.sort(z), "operation sort|numbers of type"),
        (lambda z: jax.lax.fori_loop(0, 10_000, lambda k, w: jnp.sin(w) + w, z), "operations"),
    ],
)
def test_what_is_not_straight_is_refused(function: Callable[[Any], Any], reason: str) -> None:
    with pytest.raises(Unscalar, match=reason):
        scalar_program(function, 2)


def test_a_builder_shares_and_stops() -> None:
    builder = Builder(1, 4)
    x = builder.input(0)
    assert builder.apply("add", x, builder.number(0.0)) == x
    two = builder.apply("add", x, x)
    assert builder.apply("add", x, x) == two
    builder.apply("sin", x)
    with pytest.raises(TooLong):
        builder.apply("cos", x)


def test_what_nothing_needs_any_more_is_told() -> None:
    """A program's memory can be used again; what comes out is kept, and nothing is given up twice."""
    program = scalar_program(lambda z: jnp.stack([jnp.sin(z[0]) * z[1] + z[0], z[1] * z[1]]), 2)
    given_up = [node for nodes in program.spent for node in nodes]
    assert len(given_up) == len(set(given_up))
    assert set(given_up) == set(range(len(program.operations))) - set(program.outputs)
    for place, nodes in enumerate(program.spent):
        later = program.operations[place + 1 :]
        assert not any(node in operation.operands for operation in later for node in nodes)
