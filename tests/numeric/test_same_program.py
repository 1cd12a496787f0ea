"""Programs that are one, and programs that differ in a little."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from canon.numeric.compiled import compiled
from canon.numeric.precision import double
from canon.numeric.same_program import alike

POINT = np.zeros(4)


def program(function):
    with double():
        return jax.make_jaxpr(lambda z: function(z))(POINT)


def leapfrog(z):
    p = z[2:] - 0.1 * jnp.sin(z[:2])
    return jnp.concatenate([z[:2] + 0.1 * p, p])


def test_two_traces_of_one_function_are_alike():
    assert alike(program(leapfrog), program(leapfrog))


@pytest.mark.parametrize(
    ("left", "right"),
    [
        (lambda z: z * 0.1, lambda z: z * 0.1000000000000001),
        (lambda z: z * 0.0, lambda z: z * -0.0),
        (lambda z: z[:2], lambda z: z[2:]),
        (lambda z: z**3, lambda z: z**2),
        (lambda z: z[0] - z[1], lambda z: z[1] - z[0]),
        (jnp.sin, jnp.cos),
        (lambda z: z, lambda z: -z),
        (lambda z: (z + 1.0) * z, lambda z: (z + 1.0) * (z + 1.0)),
        (lambda z: (z * 2.0, z * 3.0)[0], lambda z: (z * 2.0, z * 3.0)[1]),
        (lambda z: z.astype(jnp.float32) * 2.0, lambda z: z.astype(jnp.float16) * 2.0),
        (lambda z: z * np.array([1.0, 2.0, 3.0, 4.0]), lambda z: z * np.array([1.0, 2.0, 3.0, 5.0])),
    ],
)
def test_programs_that_differ_are_not_alike(left, right):
    assert not alike(program(left), program(right))
    assert not alike(program(right), program(left))


def test_programs_of_other_points_are_not_alike():
    with double():
        four, six = (jax.make_jaxpr(lambda z: -z)(np.zeros(size)) for size in (4, 6))
    assert not alike(four, six)


def test_wide_registers_do_not_change_a_bit():
    z = np.random.default_rng(0).uniform(-3, 3, (4, 1000))
    function = lambda z: leapfrog(leapfrog(z)) / (1 + z * z) - jnp.exp(z)
    with double():
        assert np.array_equal(compiled(function)(z), jax.jit(function)(z))
