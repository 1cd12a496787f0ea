"""Sines and cosines made for vector instructions, against 50 digits, and where they are not to be trusted."""

import jax
import jax.numpy as jnp
import mpmath as mp
import numpy as np
import pytest

from canon import audit
from canon.numeric.precision import UNIT, double
from canon.numeric.sines import FAR, VectorSines

RNG = np.random.default_rng(3)
ARGUMENTS = np.concatenate(
    [
        RNG.uniform(-4, 4, 400),
        RNG.uniform(-FAR, FAR, 400),
        RNG.choice([-1, 1], 100) * 10.0 ** RNG.uniform(-300, 0, 100),
        np.arange(-150, 150) * (np.pi / 2),  # where one of the two nearly vanishes
        np.arange(1, 600_000, 7001) * (np.pi / 2),
        (np.arange(-60, 60) + 0.5) * (np.pi / 2),  # where the reduced argument jumps
    ]
)


@pytest.mark.parametrize("name", ["sin", "cos"])
def test_the_error_is_less_than_what_is_granted(name: str) -> None:
    """Within 3 units of roundoff of the value; the running bounds grant 4."""
    exact_rule = getattr(mp, name)
    with double():
        values = np.asarray(jax.jit(lambda x: getattr(VectorSines(jnp), name)(x))(ARGUMENTS))
    with mp.workdps(50):
        exact = [exact_rule(mp.mpf(x)) for x in ARGUMENTS]
        off = max(abs((mp.mpf(v) - e) / e) for v, e in zip(values, exact, strict=True) if e)
    assert off < 3 * UNIT


def test_numpy_gives_the_same_and_arguments_that_are_too_large_are_told() -> None:
    sines = VectorSines(np)
    assert sines.sin(np.array([0.0]))[0] == 0.0
    assert sines.cos(np.array([0.0]))[0] == 1.0
    sines.sin(np.array([FAR, -1.01 * FAR, 0.0]))
    assert [list(far) for far in sines.far[2:]] == [[False, True, False]]
    assert sines.hypot(3.0, 4.0) == 5.0


def test_a_sweep_over_large_arguments_uses_the_library() -> None:
    """A kick of a pendulum whose angle has grown to 10⁹: beyond the reduction, and as symplectic as ever."""

    def kicked(z: jax.Array) -> jax.Array:
        p = z[1] - 0.3 * jnp.sin(z[0])
        return jnp.stack([z[0] + 0.1 * p, p])

    report = audit(kicked, dimension=2, domain={"q": (1e9, 1e9 + 10), "p": (-1, 1)}, samples=40_000)
    assert (report.verdict, report.audited, report.failing) == ("supported", 40_000, 0)
    assert max(defect.largest for defect in report.brackets.values()) < 1e-15
