"""Draws the work-precision diagrams of docs/performance/cost.md, and prints their readings as tables.

    python docs/performance/cost_diagrams.py [--only NAME] [--to FOLDER]

Each study is that of the command `canon cost` that is printed beside it; seconds are wall time, so run it on a machine
that does nothing else.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Final

from canon.claims.reader import read_file
from canon.cli.simulate import read_scene_or_system
from canon.cost.action import cost_of_action
from canon.cost.claim import cost_of_claim
from canon.cost.loop import cost_of_loop
from canon.cost.normal_form import cost_of_normal_form, henon_heiles
from canon.cost.scene import cost_of_scene
from canon.cost.study import Study, cheapest, measured_order
from canon.report.cost_figure import plot_studies

HERE: Final = Path(__file__).parent
ACCURACIES: Final = (1e-3, 1e-6, 1e-9, 1e-12)
SYSTEMS: Final = ("pendulum", "kepler", "three_body", "heavy_symmetric_top")


def verify() -> list[Study]:
    """The one claim of the whole-process measurements."""
    return [cost_of_claim(claim) for claim in read_file(HERE / "oscillator.toml").claims]


def scene(name: str) -> Callable[[], list[Study]]:
    """The usual integrators of a system of the catalogue."""
    return lambda: [cost_of_scene(read_scene_or_system(name), cap=0.3, patience=60.0)]


STUDIES: Final[dict[str, tuple[str, Callable[[], list[Study]]]]] = {
    "verify": ("canon cost verify docs/performance/oscillator.toml", verify),
    **{f"simulate_{name}": (f"canon cost simulate {name}", scene(name)) for name in SYSTEMS},
    "action": ("canon cost action pendulum", lambda: cost_of_action(read_scene_or_system("pendulum"))),
    "loop": ("canon cost loop pendulum", lambda: [cost_of_loop(read_scene_or_system("pendulum"), cap=2.0)]),
    "normal_form": ("canon cost normal-form", lambda: [cost_of_normal_form(*henon_heiles())]),
}


def reading(study: Study) -> None:
    """The cheapest configuration for each of some accuracies, and the orders."""
    print(f"\n{study.title}; {study.error}; against {study.reference}\n")
    print(f"| accuracy | cheapest | {study.unit} | seconds |")
    print("|--:|---|--:|--:|")
    for accuracy in ACCURACIES:
        best = cheapest(study, accuracy)
        row = "– | | " if best is None else f"{best.method} | {best.work or '–'} | {best.seconds:.2g}"
        print(f"| {accuracy:.0e} | {row} |")
    for method in study.methods:
        order = measured_order(study, method)
        if order is not None and method in study.orders:
            print(f"- {method}: order {study.orders[method]}, measured {order:.2f}")


def main() -> None:
    """Every study, or one."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", choices=STUDIES)
    parser.add_argument("--to", type=Path, default=HERE)
    arguments = parser.parse_args()
    for name, (command, study) in STUDIES.items():
        if arguments.only in (None, name):
            print(f"\n## {name}: `{command}`", flush=True)
            studies = study()
            plot_studies(studies, arguments.to / f"cost_{name}.png")
            for each in studies:
                reading(each)


if __name__ == "__main__":
    main()
