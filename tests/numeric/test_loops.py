"""Loop integrals: spectral accuracy, symplectic maps preserve them, others don't, and what is unresolved is said."""

import numpy as np
import pytest

from canon import InputError
from canon.numeric.images import compare_loops
from canon.numeric.loops import loop_integral

Array = np.ndarray


def loop(s: Array) -> Array:
    a = 2 * np.pi * s
    return np.stack([0.5 + np.cos(a) + 0.2 * np.cos(3 * a), 0.3 + np.sin(a)], axis=1)


def field(z: Array) -> Array:
    return np.stack([z[:, 1], -np.sin(z[:, 0])], axis=1)


def leapfrog(z: Array, h: float = 0.1) -> Array:
    q, p = z.T
    for _ in range(50):
        p = p - h / 2 * np.sin(q)
        q = q + h * p
        p = p - h / 2 * np.sin(q)
    return np.stack([q, p], axis=1)


def rk4(z: Array, h: float = 0.1) -> Array:
    for _ in range(50):
        a = field(z)
        b = field(z + h / 2 * a)
        c = field(z + h / 2 * b)
        d = field(z + h * c)
        z = z + h / 6 * (a + 2 * b + 2 * c + d)
    return z


def test_an_ellipse_has_its_area() -> None:
    """∮ p dq with q = a cos, p = b sin is −π a b."""
    found = loop_integral(lambda s: np.stack([1e9 * np.cos(2 * np.pi * s), 1e-9 * np.sin(2 * np.pi * s)], axis=1))
    assert found.resolved
    assert abs(found.value + np.pi) <= found.bound < 1e-12


def test_leapfrog_preserves_the_loop_integral_at_large_steps_too() -> None:
    for h in (0.1, 0.5):
        found = compare_loops(lambda z, h=h: leapfrog(z, h), loop)
        assert found.preserved is True
        assert abs(found.difference) < 1e-13


def test_runge_kutta_does_not() -> None:
    found = compare_loops(rk4, loop)
    assert found.preserved is False
    assert 1e-7 < abs(found.difference) < 1e-4


def test_nodes_are_not_fooled_by_a_fast_loop() -> None:
    """With 32 and with 64 nodes, 64 turns look like standing still."""
    a = 64 * 2 * np.pi
    found = loop_integral(lambda s: np.stack([np.cos(a * s), np.sin(a * s)], axis=1))
    assert found.resolved
    assert found.value == pytest.approx(-64 * np.pi, abs=1e-10)


def test_an_unresolved_loop_is_called_so() -> None:
    found = compare_loops(lambda z: np.stack([z[:, 0], np.abs(z[:, 1])], axis=1), loop, most_nodes=512)
    assert not found.after.resolved
    assert found.after.nodes == 512
    assert found.preserved is None


def test_what_is_no_loop_is_an_input_error() -> None:
    with pytest.raises(InputError, match="not closed"):
        loop_integral(lambda s: np.stack([s, s**2], axis=1))
    with pytest.raises(InputError, match="not to shape"):
        loop_integral(lambda s: s)
    with pytest.raises(InputError, match="not finite"):
        loop_integral(lambda s: np.stack([s * np.nan, s], axis=1))


def test_a_ripple_that_all_nodes_miss_is_not_resolved() -> None:
    """Doubled nodes agree, and the sums with them, though the loop goes astray between: only a look tells."""

    def rippled(s: Array) -> Array:
        fast = 2 * np.pi * 2**17 * s
        return loop(s) + 0.5 * np.stack([np.sin(fast), np.cos(fast)], axis=1)

    assert loop_integral(loop).resolved
    assert not loop_integral(rippled).resolved
