"""A phase portrait whose curves have equal steps of action between them. matplotlib is loaded here."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, Final

from flint import arb

from canon.errors import InputError
from canon.numeric.actions.balls import precision
from canon.numeric.actions.motion import Motion
from canon.numeric.actions.orbit import Orbit
from canon.report.figure_style import plain, words
from canon.report.whole_file import figure_written
from canon.scenes.actions import Actions

_CURVES: Final = 6
_ROTATIONS: Final = 3
_POINTS: Final = 160
_WELLS: Final = 6


@plain()
def plot_portrait(actions: Actions, path: str | Path) -> None:
    """Write the portrait of every degree of freedom that moves; the orbit itself, and its point, stand out."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    moving = [degree for degree in actions.degrees if degree.motion is not None and degree.orbit is not None]
    figure = Figure(figsize=(6.4 * len(moving), 4.8), layout="constrained")
    FigureCanvasAgg(figure)
    for axes, degree in zip(figure.subplots(1, len(moving), squeeze=False)[0], moving, strict=True):
        assert degree.motion is not None
        assert degree.orbit is not None
        _portrait(axes, degree.motion, degree.orbit)
        if degree.at is not None:
            axes.plot(*(float(x) for x in degree.at), "o", color="C3", ms=6, zorder=4)
    if actions.title:
        figure.suptitle(words(actions.title))
    figure_written(path, figure)


def _portrait(axes: Any, motion: Motion, orbit: Orbit) -> None:
    profile = motion.profile
    step = _step(motion, orbit)
    for well in _wells(motion):
        most = _most(motion, well)
        last = _CURVES if most is None else int(most / step)
        for k in range(1, last + 1):
            if most is not None and k * step >= most:
                break
            try:
                energy = motion.energy(k * step, well=well).value
            except InputError:  # a well that is bound up to the energy of escape has no larger actions
                break
            _orbit_at(axes, motion, energy, well, color="C0", lw=0.8)
        if most is not None:
            _separatrix(axes, motion, well)
    if motion.domain.period is not None:
        for k in range(1, _ROTATIONS + 1):
            _rotations(axes, motion, step, k)
    _curve(axes, motion, orbit, color="C3", lw=1.8)
    axes.plot([], [], color="C0", lw=0.8, label=f"every ΔJ = {step:.4g}")
    axes.plot([], [], color="C3", lw=1.8, label=f"J = {orbit.action.value:.10g}")
    if motion.domain.period is not None:
        axes.plot([], [], color="C2", lw=0.8, label=f"rotations, every ΔJ = {step / 2:.4g}")
    if any(_most(motion, well) is not None for well in _wells(motion)):
        axes.plot([], [], color="k", ls="--", lw=1, label="separatrix")
    axes.set(xlabel=str(profile.q), ylabel=str(profile.p))
    axes.legend(loc="upper right", fontsize="small")


def _wells(motion: Motion) -> list[float]:
    """The wells nearest to 0, by their minima."""
    minima = sorted((float(node) for node in motion.nodes if node.kind > 0), key=abs)
    return minima[:_WELLS]


def _most(motion: Motion, well: float) -> float | None:
    """The action of a well's separatrix; None where it has none."""
    try:
        return motion.orbit(below_separatrix=0, well=well).action.value
    except InputError:
        return None


def _step(motion: Motion, orbit: Orbit) -> float:
    """A sixth of the largest action that a well has, or of twice that of the orbit where no barrier limits them."""
    mosts = [_most(motion, well) for well in _wells(motion)]
    known = [most for most in mosts if most is not None]
    return (max(known) if known and len(known) == len(mosts) else 2 * orbit.action.value) / _CURVES


def _separatrix(axes: Any, motion: Motion, well: float) -> None:
    _curve(axes, motion, motion.orbit(below_separatrix=0, well=well), color="k", ls="--", lw=1)


def _rotations(axes: Any, motion: Motion, step: float, k: int) -> None:
    tops = [node for node in motion.nodes if node.kind < 0]
    least = 0.0
    if tops:
        well = min(float(node) for node in motion.nodes if node.kind > 0)
        least = motion.orbit(below_separatrix=0, well=well).action.value / 2
    energy = motion.energy(least + k * step / 2, branch="rotation").value
    _orbit_at(axes, motion, energy, None, color="C2", lw=0.8)


def _orbit_at(axes: Any, motion: Motion, energy: float, well: float | None, **style: Any) -> None:
    _curve(axes, motion, motion.orbit(energy, well=well), **style)


def _curve(axes: Any, motion: Motion, orbit: Orbit, **style: Any) -> None:
    """Both branches, with nodes that crowd at the ends as the curve turns there."""
    low, high = (end.value for end in orbit.ends)
    q = [low + (high - low) * (1 - math.cos(math.pi * k / _POINTS)) / 2 for k in range(_POINTS + 1)]
    for side in (1, -1):
        p = [_momentum(motion, x, orbit.energy.value, side) for x in q]
        axes.plot(q, p, **style)


def _momentum(motion: Motion, q: float, E: float, side: int) -> float:
    with precision(80):
        p, _ = motion.profile.outward(arb(q), arb(E), side)
        if not p.is_finite():  # at the end itself rounding may leave E a little below V
            p = motion.profile.middle_momentum(arb(q))
        return float(p.mid())
