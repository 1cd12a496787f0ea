"""One program on eight devices, emulated on this processor: the same numbers as on one."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from canon.numeric.integrate import advance, start
from canon.numeric.integrators import separable
from canon.numeric.integrators.yoshida import YOSHIDA_6
from canon.numeric.points import Points
from canon.numeric.scalar_program import values_and_jacobian
from canon.numeric.sweep import BLOCK, sweeper

SIZE = 64
WHERE = Points(-np.ones(2), np.ones(2))


def lossy(z: Any) -> Any:
    """A kick and a drift, with a defect of 1e-9 on a hundredth of the box."""
    p = z[1:] - 0.3 * jnp.sin(z[:1])
    w = jnp.concatenate([z[:1] + 0.1 * p, p])
    return jnp.where(z[0] > 0.98, w * jnp.array([1.0, 1 + 1e-9]), w)


def found() -> dict[str, Any]:
    """An ensemble of pendulums, one of which is lost on the way; and what an audit's loop says of a block of points."""
    problem = separable(lambda p: p, lambda q: -jnp.sin(q))
    state = (np.linspace(0.1, 3.0, SIZE)[None, :], np.where(np.arange(SIZE) == 9, np.nan, 0.0)[None, :])
    run = start(problem, YOSHIDA_6, state, duration=4.0, steps=40, samples=5)
    run = advance(problem, YOSHIDA_6, run, batched=True)
    program = values_and_jacobian(lossy, 2)
    loop = sweeper(program, WHERE, 1, 1.0)
    sweep = loop.generated(5, min(loop.block, BLOCK))
    return {
        "q": run.states[0],
        "p": run.states[1],
        "devices": len(run.stored[0].sharding.device_set),
        "block": loop.block,
        **{f"sweep_{name}": np.asarray(value) for name, value in sweep._asdict().items()},
    }


@pytest.mark.thorough
def test_eight_devices_find_what_one_does(tmp_path: Path) -> None:
    flags = "--xla_force_host_platform_device_count=8"
    environment = {**os.environ, "XLA_FLAGS": flags, "PYTHONPATH": os.pathsep.join(sys.path)}
    program = "import sys, numpy; from tests.numeric.test_devices import found; numpy.savez(sys.argv[1], **found())"
    command = [sys.executable, "-c", program, str(tmp_path / "x.npz")]
    subprocess.run(command, check=True, timeout=120, env=environment)
    eight, one = np.load(tmp_path / "x.npz"), found()
    assert (int(eight["devices"]), one["devices"]) == (8, len(jax.devices()))
    assert int(eight["block"]) == 8 * BLOCK
    assert set(eight) == {*one}
    for name in one:
        if name not in ("devices", "block"):
            assert np.array_equal(eight[name], one[name], equal_nan=True), name
    assert np.isfinite(one["q"][-1, 0]).sum() == SIZE - 1
