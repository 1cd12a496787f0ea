"""Figures of a scene's run: the orbit, and what the monitors saw. matplotlib is loaded here and nowhere else."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

from canon.report.drawn import drawn
from canon.report.figure_style import plain, words
from canon.report.whole_file import figure_written
from canon.scenes.simulate import Result
from canon.scenes.states import named_states

NAMED: Final = 10
"""Bodies whose names a legend has room for."""


@plain()
def plot(result: Result, path: str | Path) -> None:
    """Write a figure of the run to a file, whose ending says in which format."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10, 4.5), layout="constrained")
    FigureCanvasAgg(figure)
    left, right = figure.subplots(1, 2)
    result = drawn(result)
    _orbit(left, result)
    _against_time(right, result)
    if result.scene.title:
        figure.suptitle(words(result.scene.title))
    figure_written(path, figure)


def _orbit(axes: Any, result: Result) -> None:
    """The path in the first two coordinates; the phase portrait where there is only one."""
    model, bodies = result.scene.model, list(result.scene.bodies)
    if model.rigid and not bodies:
        _tops(axes, result)
        return
    if bodies and bodies[0].ray:
        _rays(axes, result)
        return
    if bodies:
        for body in bodies:
            _path(axes, result, body.first, body.dimension, body.name)
        if 1 < len(bodies) <= NAMED:
            axes.legend()
        names = ("x", "y") if bodies[0].dimension > 1 else ("x", "p")
    else:
        _path(axes, result, 0, model.n, "")
        names = (str(model.q[0]), str(model.q[1] if model.n > 1 else model.p[0]))
    axes.set(xlabel=names[0], ylabel=names[1])
    if bodies and names[1] == "y":
        axes.set_aspect("equal", adjustable="datalim")


def _rays(axes: Any, result: Result) -> None:
    """Rays along the axis, their first coordinate across it."""
    for body in result.scene.bodies:
        axes.plot(result.times, result.q[:, body.first], lw=1, label=words(body.name))
    if 1 < len(result.scene.bodies) <= NAMED:
        axes.legend()
    axes.set(xlabel=str(result.scene.model.t), ylabel="x")


def _tops(axes: Any, result: Result) -> None:
    """Where the third axes of rigid bodies point, seen from above; M in the body where there is no attitude."""
    rotations = named_states(result).get("rotation", {})
    for name, rows in rotations.items():
        (line,) = axes.plot(rows[:, 0, 2], rows[:, 1, 2], lw=1, label=words(name))
        axes.plot(rows[-1:, 0, 2], rows[-1:, 1, 2], "o", ms=4, color=line.get_color())
    if rotations:
        axes.set(xlabel="x of the third axis", ylabel="y of the third axis")
        axes.legend()
    else:
        axes.plot(result.p[:, 0], result.p[:, 1], lw=1)
        axes.set(xlabel="M_1", ylabel="M_2")
    axes.set_aspect("equal", adjustable="datalim")


def _path(axes: Any, result: Result, first: int, dimension: int, label: str) -> None:
    across = result.q[:, first + 1] if dimension > 1 else result.p[:, first]
    (line,) = axes.plot(result.q[:, first], across, lw=1, label=words(label))
    axes.plot(result.q[-1:, first], across[-1:], "o", ms=4, color=line.get_color())


def _against_time(axes: Any, result: Result) -> None:
    model = result.scene.model
    symbols, rows = (model.p, result.p) if model.rigid and not model.beside else (model.q, result.q)
    for k, symbol in enumerate(symbols[:6]):
        axes.plot(result.times, rows[:, k], lw=1, label=str(symbol))
    axes.set(xlabel=str(model.t))
    axes.legend()
