"""The energies at which a motion has orbits, in words, for errors."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite

from canon.errors import InputError
from canon.numeric.actions.balls import precision
from canon.numeric.actions.landscape import Critical, Interval
from canon.numeric.actions.levels import barrier_of


def ranges_text(nodes: Sequence[Critical], domain: Interval, name: str) -> str:
    """As "librations about q = 0 have energies from −1 to 1; rotations, energies above 1"."""
    with precision(128):
        minima = [node for node in nodes if node.kind > 0]
        if not minima and domain.period is None:
            return "the potential has no minimum, so that nothing is bound at any energy"
        parts = []
        for node in minima[:4]:
            bottom = float(node.value())
            try:
                top = f"to {float(barrier_of(nodes, node).value()):.10g}"
            except InputError:
                top = "up"
            start = f"{bottom:.10g}" if isfinite(bottom) else "a singularity"
            parts.append(f"about {name} = {float(node):.6g} from {start} {top}")
        words = "librations " + ", ".join(parts) if parts else ""
        if len(minima) > 4:
            words += f", and {len(minima) - 4} wells more"
        if domain.period is not None:
            tops = [node.value() for node in nodes if node.kind < 0]
            if all(top.is_finite() for top in tops):
                above = f"rotations above {max(map(float, tops)):.10g}" if tops else "rotations above the potential"
                words = f"{words}; {above}" if words else above
        elif len(minima) > 1:
            walls = [node.value() for node in (nodes[0], nodes[-1])]
            lid = min(float(wall) for wall in walls)
            words += f"; over the barriers {'at any higher energy' if lid == float('inf') else f'up to {lid:.10g}'}"
        return f"the energies are: {words}"
