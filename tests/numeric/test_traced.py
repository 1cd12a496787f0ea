"""jax programs as keys: what is taken apart once is taken again only for the same program."""

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from canon import audit
from canon.numeric import differentiable as door
from canon.numeric.traced import Source, traced

Map = Callable[[Any], Any]


def source(function: Map) -> Source | None:
    """The key of a map of the plane."""
    found = traced(function, 2)
    assert found is not None
    return found.source


def shear(factor: Any) -> Map:
    return lambda z: jnp.stack([z[0] + factor * z[1], z[1]])


def by_table(table: Any) -> Map:
    return lambda z: z + jnp.asarray(table) * jnp.roll(z, 1)


def in_a_loop(table: Any) -> Map:
    inner = jax.jit(lambda z: z + 0.1 * jnp.asarray(table) * jnp.roll(z, 1))
    return lambda z: jax.lax.fori_loop(0, 2, lambda k, w: inner(w), z)


@pytest.mark.parametrize("make", [shear, by_table, in_a_loop])
def test_programs_of_equal_numbers_are_equal_and_of_others_are_not(make: Callable[[Any], Map]) -> None:
    value = 0.1 if make is shear else np.array([0.1, 0.0])
    other = np.nextafter(value, 1.0)
    assert source(make(value)) is not None
    assert source(make(value)) == source(make(value))
    assert source(make(value)) != source(make(other))


def test_a_derivative_of_ones_own_makes_no_key() -> None:
    def with_slope(slope: float) -> Map:
        @jax.custom_jvp
        def f(x: Any) -> Any:
            return x

        f.defjvp(lambda primals, tangents: (primals[0], slope * tangents[0]))
        return lambda z: jnp.stack([f(z[0]), z[1]])

    assert source(with_slope(1.0)) is None
    assert audit(with_slope(1.0), dimension=2, samples=5).verdict == "supported"
    assert audit(with_slope(2.0), dimension=2, samples=5).verdict == "undecided"


def test_a_program_is_taken_apart_once(monkeypatch: pytest.MonkeyPatch) -> None:
    taken: list[int] = []
    work = door.values_and_jacobian

    def counted(one: Any, size: int) -> Any:
        taken.append(size)
        return work(one, size)

    monkeypatch.setattr(door, "values_and_jacobian", counted)
    first = [audit(shear(0.123), dimension=2, samples=5, seed=seed) for seed in (1, 2)]
    assert [report.verdict for report in first] == ["supported", "supported"]
    assert taken == [2]
    assert audit(shear(0.321), dimension=2, samples=5).determinant == pytest.approx((1.0, 1.0))
    assert taken == [2, 2]


def test_a_map_that_changes_is_told_apart_from_the_steady_one_it_once_was() -> None:
    assert audit(shear(0.25), dimension=2, samples=5).verdict == "supported"
    calls: list[int] = []

    def changing(z: Any) -> Any:
        calls.append(1)
        return shear(0.25 if len(calls) % 2 else 0.5)(z)

    report = audit(changing, dimension=2, samples=5)
    assert report.verdict == "undecided"
    assert "hidden state" in report.doubts[0]
