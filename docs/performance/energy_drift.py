"""How the energy drifts in runs of ten and a hundred million steps, with and without compensated sums.

    python docs/performance/energy_drift.py [--steps 1e7] [--orbits 4] [--figure FILE]
    python docs/performance/energy_drift.py --oscillators --orbits 64 --steps 1e8 [--step 1e-3] [--method gauss6]

Hénon–Heiles at E = 1/12, nystrom8 with a step of 0.1: the method's own error of the energy is below rounding, so that
what is seen is rounding. A random walk grows as √t. The table has the root mean square over orbits that begin at
neighbouring points, and the CPU time of a step.

With `--oscillators`, leapfrog steps of oscillators, all in one run: they conserve q² + (1 − h²/4) p² but for rounding,
so that a hundred million steps of 64 walks take half a minute. With `--method`, those of a Gauss method, which conserve
q² + p², or of rk4, which multiply it by 1 − h⁶/72 + h⁸/576.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import numpy as np
import sympy as sp

from canon.numeric.integrate import integrate
from canon.numeric.integrators import separable
from canon.numeric.integrators.catalogue import method
from canon.numeric.split_hamiltonian import split_hamiltonian

STEP = 0.1
SEED = 0
METHOD = "nystrom8"
x, y, px, py = sp.symbols("x y p_x p_y", real=True)
H = (px**2 + py**2) / 2 + (x**2 + y**2) / 2 + x**2 * y - y**3 / 3


def energy(q: np.ndarray, p: np.ndarray) -> np.ndarray:
    """H (samples,) in extended precision, so that reading it adds nothing."""
    (a, b), (u, v) = np.longdouble(q).T, np.longdouble(p).T
    return (u * u + v * v) / 2 + (a * a + b * b) / 2 + a * a * b - b**3 / 3


def drifts(steps: int, samples: int, orbits: int, compensated: bool) -> tuple[np.ndarray, np.ndarray, float]:
    """Numbers of steps, |ΔE|/E as a root mean square over the orbits, and the CPU seconds of a step."""
    problem = split_hamiltonian(H, (x, y), (px, py))[0].splitting()
    rows, spent = [], 0.0
    for k in range(orbits):
        begin = (np.array([0.0, 0.1 + 1e-6 * k]), np.array([0.3, 0.2537]))
        begun = time.process_time()
        run = integrate(
            problem, method(METHOD), begin,
            duration=STEP * steps, steps=steps, samples=samples, compensated=compensated,
        )  # fmt: skip
        spent += time.process_time() - begun
        values = energy(*run.states)
        rows.append((values - values[0]) / values[0])
    counts = steps * np.arange(samples) / (samples - 1)
    return counts, np.sqrt(np.mean(np.array(rows, dtype=float) ** 2, axis=0)), spent / steps / orbits


def walks(
    steps: int, samples: int, orbits: int, compensated: bool, h: float, name: str
) -> tuple[np.ndarray, np.ndarray, float]:
    """The same of so many oscillators, at random points with amplitudes from 1/2 to 3/2, with steps h."""
    random = np.random.default_rng(SEED)
    angles, sizes = random.uniform(0, 2 * np.pi, orbits), random.uniform(0.5, 1.5, orbits)
    began = time.process_time()
    run = integrate(
        separable(lambda p: p, lambda q: -q), method(name), (sizes * np.cos(angles), sizes * np.sin(angles)),
        duration=h * steps, steps=steps, samples=samples, compensated=compensated,
    )  # fmt: skip
    spent = time.process_time() - began
    q, p = (np.longdouble(np.asarray(slot)) for slot in run.states)
    values = kept_by(name, np.longdouble(run.step), run.total * np.arange(samples) / (samples - 1), q, p)
    off = ((values - values[0]) / values[0]).astype(float)
    kind = "compensated" if compensated else "plain"
    print(f"{kind}: mean {off[-1].mean():.1e}, scatter {off[-1].std():.1e} at the end", flush=True)
    return steps * np.arange(samples) / (samples - 1), np.sqrt(np.mean(off**2, axis=1)), spent / steps / orbits


def kept_by(name: str, h: np.longdouble, counts: np.ndarray, q: np.ndarray, p: np.ndarray) -> np.ndarray:
    """What these steps of q̈ = −q conserve but for rounding, at the states (samples, orbits) after so many of them."""
    if name == "verlet":
        return q * q + (1 - h * h / 4) * p * p
    if name == "rk4":
        return (q * q + p * p) * np.exp(-counts * np.log1p(-(h**6) / 72 + h**8 / 576))[:, None]
    return q * q + p * p


def slope(counts: np.ndarray, values: np.ndarray) -> float:
    """The exponent of the drift's growth over the later nine tenths of the run."""
    later = counts > counts[-1] / 10
    return float(np.polyfit(np.log(counts[later]), np.log(np.maximum(values[later], 1e-19)), 1)[0])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=float, default=1e7)
    parser.add_argument("--samples", type=int, default=1001)
    parser.add_argument("--orbits", type=int, default=4)
    parser.add_argument("--figure", type=Path)
    parser.add_argument("--oscillators", action="store_true")
    parser.add_argument("--step", type=float, default=1e-3, help="of the oscillators")
    parser.add_argument("--method", default="verlet", help="of the oscillators: verlet, gauss4, gauss6, gauss8, rk4")
    options = parser.parse_args()
    steps = int(options.steps)
    curves = {}
    print("| sums | steps | relative drift of the energy at 1 %, 10 %, 100 % | exponent | ns a step |")
    print("|---|--:|---|--:|--:|")
    for name, compensated in (("plain", False), ("compensated", True)):
        shape = steps, options.samples, options.orbits, compensated
        counts, values, seconds = walks(*shape, options.step, options.method) if options.oscillators else drifts(*shape)
        curves[name] = counts, values
        last = options.samples - 1
        shown = ", ".join(f"{values[max(last // part - 4, 1) : last // part + 1].mean():.1e}" for part in (100, 10, 1))
        print(f"| {name} | {steps:.0e} | {shown} | {slope(counts, values):.2f} | {seconds * 1e9:.1f} |", flush=True)
    if options.figure:
        draw(curves, options.figure)


def draw(curves: dict[str, tuple[np.ndarray, np.ndarray]], path: Path) -> None:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(7, 4), layout="constrained")
    for name, (counts, values) in curves.items():
        axes.loglog(counts[1:], np.maximum(values[1:], 1e-18), label=name, linewidth=0.9)
    counts, values = curves["plain"]
    axes.loglog(counts[1:], values[-1] * np.sqrt(counts[1:] / counts[-1]), "k--", linewidth=0.8, label="√t")
    axes.set(xlabel="steps", ylabel="relative drift of the energy")
    axes.legend()
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    main()
