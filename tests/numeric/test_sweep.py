"""The compiled loop agrees with what is computed point by point, counts what it should, and needs a block's memory."""

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from canon.numeric.counter import key_of, rows_of
from canon.numeric.points import Points
from canon.numeric.precision import double
from canon.numeric.residuals import brackets
from canon.numeric.running_bound import run_bounded
from canon.numeric.scalar_program import values_and_jacobian
from canon.numeric.sweep import BLOCK, COMPILED, length_of, sweeper
from canon.numeric.sweep_word import number

Array = np.ndarray
WHERE = Points(-np.ones(4), np.full(4, 2.0))


def coupled(z: Any) -> Any:
    """A kick by V = sin(q1 q2), and a drift: symplectic."""
    q, p = z[:2], z[2:]
    p = p - 0.3 * jnp.cos(q[0] * q[1]) * q[::-1]
    return jnp.concatenate([q + 0.1 * p, p])


def lossy(z: Any) -> Any:
    """The same, with a defect of 1e-9 on a hundredth of the box."""
    w = coupled(z)
    return jnp.where(z[0] > 1.97, w * jnp.array([1.0, 1.0, 1.0, 1 + 1e-9]), w)


def test_points_are_functions_of_their_number() -> None:
    index = np.array([0, 1, 2**40, 5], dtype=np.uint64)
    low, lengths = np.array([-1.0, 2.0]), np.array([2.0, 1.0])
    rows = np.stack(rows_of(index, low, lengths, key_of(7)))
    again = np.stack(rows_of(index[::-1].copy(), low, lengths, key_of(7)))[:, ::-1]
    assert np.array_equal(rows, again)
    with double():
        compiled = np.stack(rows_of(jnp.asarray(index), low, lengths, key_of(7)))
    assert np.allclose(rows, compiled, rtol=0, atol=1e-15)
    assert not np.array_equal(rows, np.stack(rows_of(index, low, lengths, key_of(8))))
    many = np.stack(rows_of(np.arange(20_000, dtype=np.uint64), low, lengths, key_of(0)))
    assert np.allclose(many.mean(axis=1), [0.0, 2.5], atol=0.02)
    assert abs(np.corrcoef(many)[0, 1]) < 0.03
    assert many[0].min() > -1
    assert many[0].max() < 1


@pytest.mark.parametrize("count", [4000, np.inf])
@pytest.mark.parametrize("function", [coupled, lossy])
def test_the_loops_agree_with_the_brackets_point_by_point(function: Any, count: float) -> None:
    """Run by numpy, for few points; and compiled."""
    program = values_and_jacobian(function, 4)
    loop = sweeper(program, WHERE, 3, 1.0, count=count)
    points = WHERE.at(np.arange(4000, dtype=np.uint64), 3)
    pairs = run_bounded(program, list(points.T))[4:]
    M, E = (np.stack([np.broadcast_to(pair[k], 4000) for pair in pairs], axis=1) for k in (0, 1))
    found = brackets(M.reshape(-1, 4, 4), E.reshape(-1, 4, 4)).residuals(1.0)
    exceeds = np.any([(r.sizes > r.bounds).any(axis=(1, 2)) for r in found], axis=0)
    quick, bounded = loop.generated(0, 4000), loop.bounded(np.arange(4000, dtype=np.uint64))
    assert set(bounded.exceeds) == set(np.flatnonzero(exceeds))
    assert set(bounded.exceeds) <= set(quick.exceeds)  # a part of a bound is no larger than the bound
    assert len(quick.exceeds) < 1000
    for half, residuals in zip((bounded.QQ, bounded.PP, bounded.QP), found, strict=True):
        largest = residuals.sizes.max()
        assert number(half.max()) == pytest.approx(largest, rel=0.02, abs=2e-16)


def test_what_would_take_long_to_compile_is_run_by_numpy(monkeypatch: pytest.MonkeyPatch) -> None:
    def many_times(z: Any) -> Any:
        for _ in range(60):
            z = coupled(z)
        return z

    program = values_and_jacobian(many_times, 4)
    assert length_of(program) > COMPILED > 5 * length_of(values_and_jacobian(coupled, 4))
    monkeypatch.setattr(jax, "jit", None)
    loop = sweeper(program, WHERE, 0, 1.0)
    found, whole = loop.generated(5, 5000), loop.bounded(np.arange(5, 5005, dtype=np.uint64))
    assert len(found.ratio) == 5000
    assert np.array_equal(found.QP, whole.QP)
    assert np.all(found.ratio >= whole.ratio)
    assert not len(whole.exceeds)


def test_points_without_a_value_are_told_apart() -> None:
    def map(z: Any) -> Any:
        # no value for q < 0, and no derivative at p = 0
        return jnp.stack([jnp.sqrt(z[0]), 2 * jnp.sqrt(z[0]) * jnp.sqrt(z[1] ** 2)])

    points = np.array([[0.5, 0.5], [-0.5, 0.5], [0.5, 0.0], [1.0, 1.0]])
    where = Points(points.min(axis=0), points.max(axis=0), points)
    found = sweeper(values_and_jacobian(map, 2), where, 0, 1.0).given(points)
    assert list(found.undefined) == [1]
    assert list(found.rough) == [2]
    assert not len(found.outside)


def test_a_map_is_compiled_once() -> None:
    program = values_and_jacobian(coupled, 4)
    first, second = (sweeper(program, Points(np.zeros(4), np.full(4, x)), 0, 1.0) for x in (1.0, 2.0))
    assert first.block == second.block == BLOCK
    a, b = first.generated(0, 10), second.generated(0, 10)
    assert len(a.ratio) == 10
    assert not np.array_equal(a.QP, b.QP) or not np.array_equal(a.ratio, b.ratio)
