"""Audits in points a second, beside plain `vmap(jacfwd)` and numpy's central differences, in one run.

    python docs/performance/audit.py            prints the table and writes audit.json beside this file

CPU times (`time.process_time`) of one process, pinned to one core where the system allows it; contestants take turns,
and each figure is the median of the turns. What compiles has compiled before.
"""

from __future__ import annotations

import json
import os
import platform
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from canon import audit

H = 0.1
TURNS = 9
POINTS = 1_000_000
MANY = 100_000_000
J = np.kron([[0.0, 1.0], [-1.0, 0.0]], np.eye(3))
PEER = "plain vmap(jacfwd), one call for all points"
NUMPY = "numpy central differences"


def quartic(numbers: Any) -> Callable[[Any], Any]:
    """Leapfrog in V = r²/2 + r⁴/4 + 0.3 (x²y − y³/3 + z²x)."""

    def force(q: Any) -> Any:
        x, y, z = q[0], q[1], q[2]
        r2 = x * x + y * y + z * z
        cubic = numbers.stack([2 * x * y + z * z, x * x - y * y, 2 * z * x])
        return -q * (1 + r2) - 0.3 * cubic

    return leapfrog(force, numbers)


def chain(numbers: Any) -> Callable[[Any], Any]:
    """Leapfrog of three pendulums coupled in a ring."""

    def force(q: Any) -> Any:
        return -numbers.sin(q) - 0.1 * (2 * q - numbers.roll(q, 1, 0) - numbers.roll(q, -1, 0))

    return leapfrog(force, numbers)


def leapfrog(force: Callable[[Any], Any], numbers: Any) -> Callable[[Any], Any]:
    """Kick, drift, kick; points (6,) or columns (6, N)."""

    def step(z: Any) -> Any:
        q, p = z[:3], z[3:]
        p = p + H / 2 * force(q)
        q = q + H * p
        return numbers.concatenate([q, p + H / 2 * force(q)])

    return step


def plain(step: Callable[[Any], Any]) -> Callable[[int], float]:
    """What one writes without a tool: all Jacobians, then M J Mᵀ − J."""

    def largest(z: Any) -> Any:
        M = jax.vmap(jax.jacfwd(step))(z)
        return jnp.abs(M @ J @ jnp.swapaxes(M, 1, 2) - J).max()

    compiled = jax.jit(largest)

    def run(count: int) -> float:
        with jax.enable_x64(True):
            return float(compiled(points(count)))

    return run


def differences(step: Callable[[Any], Any]) -> Callable[[int], float]:
    """Central differences of columns, step 1e-5, in blocks of 2000."""

    def run(count: int) -> float:
        worst, z = 0.0, points(count).T
        for start in range(0, count, 2000):
            block = z[:, start : start + 2000]
            M = np.empty((6, 6, block.shape[1]))
            for k in range(6):
                ahead, behind = block.copy(), block.copy()
                ahead[k] += 1e-5
                behind[k] -= 1e-5
                M[:, k] = (step(ahead) - step(behind)) / 2e-5
            rows = np.moveaxis(M, 2, 0)
            worst = max(worst, float(np.abs(rows @ J @ np.swapaxes(rows, 1, 2) - J).max()))
        return worst

    return run


def points(count: int) -> np.ndarray:
    """Points of the unit box."""
    return np.random.default_rng(0).uniform(-1, 1, (count, 6))


def audited(step: Callable[[Any], Any]) -> Callable[[int], float]:
    """canon's audit: its points, every bracket beside its bound, a report."""

    def run(count: int) -> float:
        report = audit(step, dimension=6, samples=count)
        assert report.verdict == "supported", str(report)
        return max(defect.largest for defect in report.brackets.values())

    return run


def cpu(action: Callable[[], Any]) -> tuple[float, Any]:
    start = time.process_time()
    result = action()
    return time.process_time() - start, result


def rates(name: str, make: Callable[[Any], Callable[[Any], Any]]) -> dict[str, Any]:
    """Points a second of the contestants on one map."""
    mine, peer, other = audited(make(jnp)), plain(make(jnp)), differences(make(np))
    contestants: dict[str, tuple[Callable[[], float], int]] = {
        "canon.audit, 1e6 points, the whole call": (lambda: mine(POINTS), POINTS),
        PEER: (lambda: peer(POINTS), POINTS),
        NUMPY: (lambda: other(POINTS // 5), POINTS // 5),
    }
    longer = 6 * POINTS
    mine(POINTS)
    peer(POINTS)
    times: dict[str, list[float]] = {key: [] for key in contestants}
    residual: dict[str, float] = {}
    steady: list[float] = []
    making, _ = cpu(lambda: points(POINTS))
    for _ in range(TURNS):
        for key, (action, count) in contestants.items():
            seconds, residual[key] = cpu(action)
            # the peers' points are made outside of what is timed
            seconds -= 0.0 if key.startswith("canon") else making * count / POINTS
            times[key].append(seconds / count)
        seconds, _ = cpu(lambda: mine(longer))
        steady.append((seconds - times["canon.audit, 1e6 points, the whole call"][-1] * POINTS) / (longer - POINTS))
    found = {key: 1 / statistics.median(values) for key, values in times.items()}
    found["canon.audit, each further point"] = 1 / statistics.median(steady)
    return {
        "map": name,
        "points_per_second": found,
        "over_plain": {key: value / found[PEER] for key, value in found.items()},
        "over_numpy": {key: value / found[NUMPY] for key, value in found.items()},
        "largest_residual": residual,
    }


def pendulums(z: Any) -> Any:
    """One leapfrog step of 200 pendulums in a ring, all coupled by their mean."""
    q, p = z[:200], z[200:]

    def force(q: Any) -> Any:
        return -jnp.sin(q) - 0.1 * (2 * q - jnp.roll(q, 1) - jnp.roll(q, -1)) - 0.01 * jnp.mean(q) ** 3 / 200

    p = p + H / 2 * force(q)
    q = q + H * p
    return jnp.concatenate([q, p + H / 2 * force(q)])


def dense() -> dict[str, float]:
    """M J Mᵀ at one point of 200 degrees of freedom, after compilation, and a whole audit of one point."""
    from canon.numeric.differentiable import differentiable
    from canon.numeric.residuals import brackets

    z = np.random.default_rng(0).uniform(-1, 1, (1, 400))
    map = differentiable(pendulums, z, np.full(400, 2.0))

    def once() -> float:
        found = brackets(*map.linearise(z))
        return max(float(residuals.sizes.max()) for residuals in found.residuals(1.0))

    once()  # compiles
    seconds, largest = zip(*(cpu(once) for _ in range(TURNS)), strict=True)
    whole, report = cpu(lambda: audit(pendulums, dimension=400, samples=1))
    assert report.verdict == "supported"
    return {
        "seconds": statistics.median(seconds),
        "largest_residual": largest[0],
        "audit_of_one_point": whole,
    }


def longer() -> dict[str, float]:
    """Seconds of the first audit of 1e5 points of several leapfrog steps: nothing of them is compiled before."""
    found = {}
    for steps in (4, 12):
        step = quartic(jnp)

        def several(z: Any, step: Any = step, steps: int = steps) -> Any:
            for _ in range(steps):
                z = step(z)
            return z

        seconds, report = cpu(lambda several=several: audit(several, dimension=6, samples=100_000))
        assert report.verdict == "supported", str(report)
        found[f"{steps} steps"] = seconds
    return found


SMALL = """
import time
import numpy as np
{extra}
from canon import audit
def step(z, h=0.1):
    p = z[2:] - h * {sin}(z[:2])
    return {join}([z[:2] + h * p, p])
print(audit(step, dimension=4).verdict, time.process_time())
"""


def first_answers() -> dict[str, float]:
    """CPU seconds of a new process from its start to a small audit's report."""
    found = {}
    for kind, extra in (("jax", "import jax.numpy as jnp"), ("numpy", "")):
        module = "jnp" if kind == "jax" else "np"
        program = SMALL.format(extra=extra, sin=f"{module}.sin", join=f"{module}.concatenate")
        times = []
        for _ in range(3):
            done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
            verdict, seconds = done.stdout.split()
            assert verdict == "supported"
            times.append(float(seconds))
        found[kind] = statistics.median(times)
    return found


def many() -> dict[str, float]:
    """A hundred million points: seconds, and the most memory that the process has held, in GB."""
    seconds, report = cpu(lambda: audit(quartic(jnp), dimension=6, samples=MANY))
    assert report.audited == MANY
    return {"seconds": seconds, "peak_gigabytes": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6}


def main() -> None:
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    record: dict[str, Any] = {
        "many_points": many(),
        "maps": [rates("quartic", quartic), rates("chain", chain)],
        "200_degrees_of_freedom": dense(),
        "first_audit_of_1e5_points": longer(),
        "first_answer": first_answers(),
        "devices": [str(device) for device in jax.devices()],
        "python": platform.python_version(),
        "jax": jax.__version__,
        "numpy": np.__version__,
        "processor": platform.machine(),
    }
    target = Path(__file__).with_suffix(".json")
    target.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
    print(json.dumps(record, indent=1))


if __name__ == "__main__":
    main()
