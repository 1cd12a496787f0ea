"""An energy that is known to any precision: given, or at a distance from a minimum or a barrier of the potential."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from canon.errors import InputError
from canon.numeric.actions.balls import Ball, ball_of
from canon.numeric.actions.landscape import Critical


@dataclass(frozen=True)
class Level:
    """An energy: `value` gives it to the working precision, `text` says how it was given."""

    value: Callable[[], Ball]
    text: str


def level_of(value: Any, text: str) -> Level:
    """The level of a number."""
    return Level(lambda: ball_of(value), f"E = {text}")


def level_at(given: Mapping[str, Any], nodes: Sequence[Critical], well: float | None) -> Level:
    """The level that one of `energy`, `above_minimum`, `above_separatrix`, `below_separatrix` states.

    **Raises:** `InputError` where none or several are given, or there is no such minimum or barrier.
    """
    if len(given) != 1:
        names = "energy, above_minimum, above_separatrix or below_separatrix"
        raise InputError(f"one of {names} is expected" + (f", not {len(given)} of them" if given else ""), "energy")
    ((name, number),) = given.items()
    if name == "energy":
        return level_of(number, str(number))
    if ball_of(number) < 0:
        raise InputError(f"a distance is 0 or more, unlike {number}", name)
    lowest = well_of(nodes, well)
    if name == "above_minimum":
        return Level(lambda: lowest.value() + ball_of(number), f"{number} above the minimum at {float(lowest):.6g}")
    top = barrier_of(nodes, lowest)
    sign = 1 if name == "above_separatrix" else -1
    word = "above" if sign > 0 else "below"
    return Level(lambda: top.value() + sign * ball_of(number), f"{number} {word} the barrier at {float(top):.6g}")


def well_of(nodes: Sequence[Critical], well: float | None) -> Critical:
    """The minimum of the well in which a point lies, or the only one. **Raises:** `InputError`."""
    minima = [node for node in nodes if node.kind > 0]
    if not minima:
        raise InputError("the potential has no minimum, so that nothing is bound", "H")
    if len(minima) == 1:
        return minima[0]
    if well is None:
        places = ", ".join(f"{float(node):.6g}" for node in minima)
        raise InputError(f"the potential has {len(minima)} wells: choose one with well = {places}", "well")
    tops = [float(node) for node in nodes if node.kind < 0]
    for node in minima:
        between = sorted((float(node), float(well)))
        if not any(between[0] < top < between[1] for top in tops):
            return node
    return min(minima, key=lambda node: abs(float(node) - float(well)))


def barrier_of(nodes: Sequence[Critical], lowest: Critical) -> Critical:
    """The lower of the two barriers of a well. **Raises:** `InputError` where it has none."""
    k = list(nodes).index(lowest)
    around = [nodes[k - 1], nodes[(k + 1) % len(nodes)]]
    tops = [node for node in around if node.kind <= 0 and node.value().is_finite()]
    if not tops:
        raise InputError("the well has no barrier: it has no separatrix", "energy")
    return min(tops, key=lambda node: float(node.value()))
