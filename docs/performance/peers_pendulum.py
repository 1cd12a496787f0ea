"""The pendulum at E_sep(1 − 1e-8) after 100 periods: the exact flow, and heyoka, which steps."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from mpmath import mp
from peers_common import Row, Setting, cheapest, compared

START = 2 * np.sqrt(1 - 1e-8)
"""The momentum at the bottom: E = 2(1 − 1e-8), with E_sep = 2."""


def reference() -> tuple[float, float]:
    """100 periods and a bit, and the angle then, in 60 digits, of the momentum as the double that it is."""
    with mp.workdps(60):
        k = mp.mpf(float(START)) / 2
        time = float(400 * mp.ellipk(k**2) + 1)
        return time, float(2 * mp.asin(k * mp.ellipfun("sn", mp.mpf(time), m=k**2)))


def rows() -> Iterator[Row]:
    import heyoka as hy
    import jax

    from canon.numeric.exact.pendulum import pendulum
    from canon.numeric.precision import double

    time, angle = reference()
    with double():
        program = jax.jit(pendulum).lower(0.0, 0.0, 0.0).compile()
        arguments = [jax.device_put(np.float64(value)) for value in (0.0, START, time)]

    def ours() -> np.ndarray:
        q, _ = program(*arguments)
        return np.asarray(q)

    q, p = hy.make_vars("q", "p")
    solver = hy.taylor_adaptive([(q, p), (p, -hy.sin(q))], [0.0, 0.0], tol=1e-16)

    def theirs() -> np.ndarray:
        solver.time = 0.0
        solver.state[:] = [0.0, START]
        solver.propagate_until(time)
        return solver.state[:1].copy()

    settings = {"canon": [Setting("elliptic functions", ours)], "heyoka": [Setting("tol 1e-16", theirs)]}
    for target in (1e-12, 1.0):
        chosen = {
            name: cheapest(each, lambda end: float(np.abs(end - angle).max()), target)
            for name, each in settings.items()
        }
        yield compared("pendulum at E_sep(1 − 1e-8), 100 periods", f"{target:.0e}", chosen, {})
