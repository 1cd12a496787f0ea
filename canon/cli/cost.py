"""`canon cost`: what accuracy costs in time, of verdicts, runs, actions, loops and normal forms."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final

from canon.cli.actions import parameter_values
from canon.cli.parser import NOT_WRITTEN, Parser, count, positive, seconds
from canon.cli.refusal import refused
from canon.cli.simulate import check_folder, picture, read_scene_or_system, write_each
from canon.cli.spoken import complain, notation, shown

if TYPE_CHECKING:
    from canon.cost.study import Study

HELP: Final = "what accuracy costs in time: of verdicts, runs, actions, loops and normal forms"
DESCRIPTION: Final = (
    "Measures error against seconds, warm, the median of repeated runs, beside a reference that is none of what is "
    "measured. The table marks what nothing else beats in both; --plot draws the work-precision diagram."
)
KINDS: Final = {
    "verify": "claims in floats, in balls of more and more bits, and by exact proof",
    "simulate": "integrators and steps for a scene",
    "action": "quadrature rules and nodes for the actions of a scene",
    "loop": "nodes of a loop that a scene carries along",
    "normal-form": "orders of the normal form about the origin",
}
WHERE: Final = {
    "verify": ("CLAIMS.toml", "a claim file"),
    "normal-form": (
        "SCENE|CLAIM",
        "a scene, a claim file with a Hamiltonian, or the name of a system; Hénon and Heiles's",
    ),
}


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the command."""
    kinds = parser.add_subparsers(
        title="what is bought", dest="what", metavar="WHAT", parser_class=Parser, required=True
    )
    for kind, words in KINDS.items():
        sub = kinds.add_parser(kind, help=words, description=f"{words[0].upper()}{words[1:]}: error against seconds.")
        metavar, about = WHERE.get(kind, ("SCENE.toml", "a scene file, or the name of a system (see `canon scenes`)"))
        sub.add_argument("file", metavar=metavar, help=about, nargs="?" if kind == "normal-form" else None)
        sub.add_argument("--json", action="store_true", help="print one JSON object and nothing else")
        sub.add_argument("--csv", metavar="FILE.csv", help="write all points into a file, one a row")
        sub.add_argument("--plot", metavar="FILE", type=picture, help="draw the diagram into a .png, .svg or .pdf file")
        sub.add_argument("--accuracy", type=positive, metavar="A", help="name what is cheapest for this accuracy")
        sub.add_argument("--within", type=seconds, metavar="SECONDS", help="name what is most exact within this time")
        _own(sub, kind)


def _own(parser: argparse.ArgumentParser, kind: str) -> None:
    if kind == "verify":
        parser.add_argument(
            "--budget", type=seconds, default=10.0, metavar="SECONDS", help="of each claim (default: 10)"
        )
        return
    parser.add_argument("--cap", type=seconds, default=None, metavar="SECONDS", help="that one run may take")
    if kind == "simulate":
        parser.add_argument(
            "--integrator", action="append", default=[], metavar="NAME", help="one to be measured; may be given again"
        )
    if kind == "normal-form":
        parser.add_argument("--order", type=count, default=10, metavar="N", help="the highest order (default: 10)")
        parser.add_argument(
            "--radius",
            type=positive,
            default=0.1,
            metavar="R",
            help="the distance at which the remainder is measured (default: 0.1)",
        )
        parser.add_argument(
            "--parameter",
            action="append",
            default=[],
            metavar="NAME=VALUE",
            help="a number for a name of a claim file's H",
        )


def execute(arguments: argparse.Namespace) -> int:
    """Measure, print and write what is asked for, and return the exit status."""
    from canon.errors import InputError

    try:
        check_folder("--plot", arguments.plot, arguments.file, arguments.csv)
        check_folder("--csv", arguments.csv, arguments.file)
        with _watched(arguments.json) as watch:
            studies = _STUDIES[arguments.what](arguments, watch)
    except InputError as error:
        return refused("cost", arguments.file, error, as_json=arguments.json)
    faults = _write(studies, arguments)
    _print(studies, arguments)
    for fault in faults:
        complain(f"canon cost: {fault}")
    return NOT_WRITTEN if faults else 0


def _verify(arguments: argparse.Namespace, watch: Any) -> list[Study]:
    from canon.claims.reader import read_file
    from canon.cost.claim import cost_of_claim
    from canon.errors import InputError

    reading = read_file(arguments.file)
    if reading.problems:
        first = reading.problems[0]
        raise InputError(first["message"], first["where"])
    studies = []
    for claim in reading.claims:
        watch(claim.title or claim.kind)
        studies.append(cost_of_claim(claim, budget=arguments.budget))
    return studies


def _simulate(arguments: argparse.Namespace, watch: Any) -> list[Study]:
    from canon.cost.scene import cost_of_scene

    scene = read_scene_or_system(arguments.file)
    return [cost_of_scene(scene, integrators=arguments.integrator, cap=arguments.cap or 0.3, watch=watch)]


def _action(arguments: argparse.Namespace, watch: Any) -> list[Study]:
    from canon.cost.action import cost_of_action

    watch("actions")
    return cost_of_action(read_scene_or_system(arguments.file), cap=arguments.cap or 1.0)


def _loop(arguments: argparse.Namespace, watch: Any) -> list[Study]:
    from canon.cost.loop import cost_of_loop

    return [cost_of_loop(read_scene_or_system(arguments.file), cap=arguments.cap or 2.0, watch=watch)]


def _normal_form(arguments: argparse.Namespace, watch: Any) -> list[Study]:
    from canon.claims import document
    from canon.claims.numbers import hamiltonian_with
    from canon.cost.normal_form import cost_of_normal_form, hamiltonian_of_scene, henon_heiles
    from canon.scenes.reader import scene_of

    name = arguments.file
    tables = document.load(name) if name is not None and os.path.lexists(name) else {}
    if name is None:
        title, space, H = henon_heiles()
    elif {"phase_space", "hamiltonian", "claim"} & {*tables}:
        title, space, H = hamiltonian_with(tables, parameter_values(arguments.parameter))
    else:
        title, space, H = hamiltonian_of_scene(
            scene_of(tables) if os.path.lexists(name) else read_scene_or_system(name)
        )
    return [
        cost_of_normal_form(
            title, space, H, order=arguments.order, radius=arguments.radius, cap=arguments.cap or 20.0, watch=watch
        )
    ]  # fmt: skip


_STUDIES: Final[dict[str, Callable[[argparse.Namespace, Any], Any]]] = {
    "verify": _verify, "simulate": _simulate, "action": _action, "loop": _loop, "normal-form": _normal_form,
}  # fmt: skip


class _watched:  # noqa: N801 - a context manager that reads as a word
    """On a terminal, a line that says what is being measured; nothing elsewhere."""

    def __init__(self, silent: bool) -> None:
        self.shown = not silent and sys.stderr.isatty()

    def __enter__(self) -> Callable[[str], None]:
        return self._show

    def _show(self, what: str) -> None:
        if self.shown:
            print(f"\r\033[Kmeasuring {shown(what)} …", end="", file=sys.stderr, flush=True)

    def __exit__(self, *exception: object) -> None:
        if self.shown:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def _write(studies: list[Study], arguments: argparse.Namespace) -> list[str]:
    """Write the files that were asked for, and return what to say of those that couldn't be written."""

    def table() -> None:
        from canon.report.cost_text import as_csv
        from canon.report.whole_file import written

        written(arguments.csv, as_csv(studies))

    def figure() -> None:
        from canon.report.cost_figure import plot_studies

        plot_studies(studies, arguments.plot)

    return write_each(arguments, {"csv": table, "plot": figure})


def _print(studies: list[Study], arguments: argparse.Namespace) -> None:
    if arguments.json:
        from canon.cost.study import record

        print(notation({"format": 1, "studies": [record(study) for study in studies]}))
        return
    from canon.report.cost_text import study_lines

    for study in studies:
        print("\n".join(study_lines(study, accuracy=arguments.accuracy, budget=arguments.within)))
    for option, path in (("table", arguments.csv), ("figure", arguments.plot)):
        if path is not None:
            print(f"  {option:<7} {shown(path)}")
