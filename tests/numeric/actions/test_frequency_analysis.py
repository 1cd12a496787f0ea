"""Lines of signals that are known, and the frequency of a pendulum against ν = dE/dJ."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from canon.errors import InputError
from canon.numeric.actions.frequency_analysis import frequency_lines
from canon.numeric.actions.motion import motion
from canon.numeric.exact.pendulum import pendulum
from canon.numeric.precision import double


def test_three_lines_to_rounding() -> None:
    t = np.arange(2048) * 0.1
    lines = np.array([0.31234567890123, -0.0771234567, 1.9123456])
    sizes = np.array([1.0, 0.3 + 0.2j, 0.01j])
    signal = sum(a * np.exp(2j * np.pi * nu * t) for a, nu in zip(sizes, lines, strict=True))
    found = frequency_lines(signal, 0.1, 3)
    assert np.all(np.abs(found.frequencies - lines) < 1e-14)
    assert np.all(np.abs(found.amplitudes - sizes) < 1e-12)
    assert found.left < 1e-12
    # with one of them left out, the window keeps what leaks from it small
    assert abs(frequency_lines(signal, 0.1, 2).frequencies[0] - lines[0]) < 1e-12


def test_close_lines_are_told_apart_and_a_plain_transform_would_not_find_them() -> None:
    t = np.arange(2048.0)
    lines = np.array([0.2, 0.2 + 6 / 2048])
    signal = np.exp(2j * np.pi * lines[0] * t) + 0.5 * np.exp(2j * np.pi * lines[1] * t)
    found = frequency_lines(signal, 1.0, 2, power=1)
    assert np.all(np.abs(found.frequencies - lines) < 1e-10)


def test_a_real_signal_has_two_lines_each() -> None:
    t = np.arange(1024) * 0.5
    found = frequency_lines(np.cos(2 * np.pi * 0.123456789 * t + 0.3), 0.5, 2)
    assert np.allclose(np.sort(found.frequencies), [-0.123456789, 0.123456789], rtol=0, atol=1e-15)
    assert np.allclose(np.abs(np.angle(found.amplitudes)), 0.3, atol=1e-12)


def test_the_pendulum_agrees_with_its_action() -> None:
    """sec-14.5-c: ν = dE/dJ is the frequency that an orbit shows."""
    starts = np.array([[1.0], [2.5]])
    with double():
        q, p = jax.jit(pendulum)(jnp.asarray(starts), jnp.zeros((2, 1024)), jnp.arange(1024) * 0.25)
        signals = np.asarray(q) + 1j * np.asarray(p)
    for start, signal in zip(starts[:, 0], signals, strict=True):
        frequency = motion("p**2/2 - cos(q)").at(start, 0).frequency
        assert frequency is not None
        found = frequency_lines(signal, 0.25, 6)
        assert abs(abs(found.frequencies[0]) / frequency.value - 1) < 1e-14


@pytest.mark.parametrize(
    ("signal", "step", "count"),
    [(np.ones(8), 1.0, 1), (np.ones(64), 1.0, 5), (np.full(64, np.nan), 1.0, 1), (np.ones(64), 0, 1)],
)
def test_what_is_refused(signal: np.ndarray, step: float, count: int) -> None:
    with pytest.raises(InputError, match=r"samples in a row|not finite"):
        frequency_lines(signal, step, count)
