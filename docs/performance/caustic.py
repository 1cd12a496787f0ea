"""Digits that images keep near a caustic of a type-1 generating function, by how they are found.

    python docs/performance/caustic.py          prints the table of docs/decisions/0019-another-type-near-a-caustic.md

The map is the pendulum's leapfrog step, with momentum kicks before and after the drift (`leapfrog`) or before it alone
(`kick and drift`). F(q, Q) has a caustic at h = 0, where Q = q. References are computed in 50 digits.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import mpmath as mp
import numpy as np
import sympy as sp

from canon import GeneratingFunction, ImplicitMap, PhaseSpace
from canon.claims.other_type import valued
from canon.numeric.implicit import solve_mixed

SPACE = PhaseSpace("q", "p", new=("Q", "P"), symbols={"h": "real"})
q, Q, h = SPACE.symbols("q Q h")
DRIFT = -((Q - q) ** 2) / (2 * h)
MAPS: dict[str, tuple[sp.Expr, int]] = {
    "kick and drift": (DRIFT + h * sp.cos(q), 0),
    "leapfrog": (DRIFT + h * (sp.cos(q) + sp.cos(Q)) / 2, 1),
}
SIZES = (1e-4, 1e-8, 1e-12)
POINTS = np.random.default_rng(1).uniform(-1, 1, (200, 2))


def exactly(point: np.ndarray, size: float, halves: int) -> list[float]:
    """The image in 50 digits, rounded once."""
    with mp.workdps(50):
        x, y, step = map(mp.mpf, (*point, size))
        part = step / 2 if halves else step
        y = y + part * mp.sin(x)
        x = x + step * y
        return [float(x), float(y + part * mp.sin(x) if halves else y)]


def by_a_numerical_transform(point: np.ndarray, size: float, halves: int) -> list[float]:
    """Newton's method for P in v = ∂G/∂q, where G(q, P) = F + QP is evaluated by solving P = −∂F/∂Q for Q."""
    x, v = point
    part = size / 2 if halves else 0.0

    def argument(P: float) -> float:
        y = x + size * P
        for _ in range(20):
            y -= ((y - x) / size + part * np.sin(y) - P) / (1 / size + part * np.cos(y))
        return y

    P = v
    for _ in range(20):
        y = argument(P)
        off = (y - x) / size - (size if not halves else part) * np.sin(x) - v
        P -= off * (1 + size * part * np.cos(y))
    return [argument(P), P]


def digits(images: Any, exact: np.ndarray) -> str:
    """The digits of the worst image."""
    off = np.abs(images - exact).max(axis=1) / np.abs(exact).max(axis=1)
    return f"{min(16.0, -np.log10(max(off.max(), 1e-17))):4.1f}"


def timed(action: Callable[[], Any]) -> tuple[float, Any]:
    """CPU microseconds for a point, and what was found."""
    start = time.process_time()
    result = action()
    return (time.process_time() - start) / len(POINTS) * 1e6, result


def main() -> None:
    print("map             h      own type  transformed numerically  canon  µs a point  how")
    for name, (F, halves) in MAPS.items():
        for size in SIZES:
            exact = np.array([exactly(point, size, halves) for point in POINTS])
            map = ImplicitMap(GeneratingFunction(SPACE, type=1, F=F), {"h": size})
            map.solve(POINTS[:2])
            _, derivatives = valued(map.generating, map.parameters)
            own = solve_mixed(derivatives, derivatives.pattern, POINTS, exact[:, :1]).images
            turned = np.array([by_a_numerical_transform(point, size, halves) for point in POINTS])
            cost, found = timed(lambda map=map: map.solve(POINTS))
            how = "; ".join(found.notes) or "type 1"
            print(
                f"{name:15} {size:.0e}  {digits(own, exact)}      {digits(turned, exact)}                     "
                f"{digits(found.images, exact)}   {cost:6.0f}      {how}"
            )


if __name__ == "__main__":
    main()
