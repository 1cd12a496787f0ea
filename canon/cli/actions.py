"""`canon actions`: actions, frequencies and angles of a scene or of a claim file's Hamiltonian, with their bounds."""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

from canon.cli.parser import NOT_WRITTEN, seconds
from canon.cli.refusal import refused, unfinished
from canon.cli.simulate import picture
from canon.cli.spoken import complain, notation, shown

if TYPE_CHECKING:
    from canon.scenes.actions import Actions

HELP: Final = "actions, frequencies and angles of a scene, or of a claim file's Hamiltonian"
DESCRIPTION: Final = (
    "Prints J = ∮ p dq, the frequency dE/dJ and the angle w (which grows by 1 in a period) of every degree of freedom, "
    "each with a bound of its error: for one degree of freedom, for sums of such, for one coordinate that moves while "
    "the others are cyclic, and for central problems in Cartesian coordinates. The orbit is that of the scene's "
    "initial state, or one that is named by its energy, or by its distance from the minimum or separatrix of a well."
)
BUDGET: Final = 60.0
"""Seconds, where none are given: a hundred times what the examples take."""
_NAMES: Final = ("energy", "above_minimum", "above_separatrix", "below_separatrix", "well", "branch")


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the command."""
    parser.add_argument(
        "file", metavar="SCENE|CLAIM", help="a scene file, a claim file, or the name of a system (see `canon scenes`)"
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object and nothing else")
    parser.add_argument(
        "--plot", metavar="FILE", type=picture, help="draw the phase portrait, in equal steps of action"
    )
    which = parser.add_mutually_exclusive_group()
    for name, words in (
        ("energy", "the orbit at this energy"),
        ("above-minimum", "the orbit this much above the minimum of its well"),
        ("above-separatrix", "the orbit this much above the lower barrier of its well"),
        ("below-separatrix", "the orbit this much below the lower barrier of its well, as 1e-12"),
    ):
        which.add_argument(f"--{name}", metavar="E", help=words)
    parser.add_argument("--well", metavar="Q", help="a point in the well that is meant")
    parser.add_argument("--branch", choices=("libration", "rotation"), help="the kind of motion that is meant")
    parser.add_argument("--q", metavar="Q", help="a claim file's coordinate, with --p: the orbit through this point")
    parser.add_argument("--p", metavar="P", help="the momentum there")
    parser.add_argument(
        "--budget", metavar="SECONDS", type=seconds, default=BUDGET, help=f"time for all of it (default: {BUDGET:g})"
    )
    parser.add_argument(
        "--parameter",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="a value of a claim file's parameter, or of a momentum that is constant",
    )


def execute(arguments: argparse.Namespace) -> int:
    """Print and draw what is asked for, and return the exit status."""
    from canon.budget import Budget
    from canon.cli.simulate import check_folder, write_each
    from canon.deadline import within
    from canon.errors import BudgetExceeded, InputError

    begun, budget = time.monotonic(), Budget(arguments.budget)
    found = None
    try:
        check_folder("--plot", arguments.plot, arguments.file)
        found = within(budget, lambda: _found(arguments))
        faults = write_each(arguments, {"plot": lambda: within(budget, lambda: _draw(found, arguments.plot))})
    except InputError as error:
        return refused("actions", arguments.file, error, as_json=arguments.json)
    except BudgetExceeded:
        if found is None:
            reason = f"nothing is known after {arguments.budget:g} s, the time that it has: give more with --budget"
            return unfinished("actions", arguments.file, reason, as_json=arguments.json)
        faults = [f"--plot {arguments.plot} was not drawn within the {arguments.budget:g} s that there are (--budget)"]
        arguments.plot = None
    from canon.report.action_record import action_lines, action_record

    if arguments.json:
        print(notation(action_record(found, time.monotonic() - begun)))
    else:
        print("\n".join(action_lines(found)))
        if arguments.plot is not None:
            print(f"  figure       {shown(arguments.plot)}")
    for fault in faults:
        complain(f"canon actions: {fault}")
    return NOT_WRITTEN if faults else 0


def _draw(found: Actions, path: str) -> None:
    from canon.report.portrait import plot_portrait

    plot_portrait(found, path)


def _found(arguments: argparse.Namespace) -> Actions:
    from canon.claims import document
    from canon.cli.simulate import read_scene_or_system
    from canon.errors import InputError
    from canon.scenes.actions import actions_of_scene
    from canon.scenes.reader import scene_of

    named = {name: getattr(arguments, name) for name in _NAMES if getattr(arguments, name) is not None}
    name = arguments.file
    is_file = os.path.lexists(name) or name.endswith(".toml")
    tables = document.load(name) if is_file else {}
    if is_file and {"phase_space", "hamiltonian", "claim"} & {*tables}:
        return _of_claims(arguments, tables, named)
    for option in ("q", "p", "parameter"):
        if getattr(arguments, option):
            raise InputError("a scene has its initial state and its parameters itself", f"--{option}")
    _check_named(named)
    return actions_of_scene(scene_of(tables) if is_file else read_scene_or_system(name), named)


def _check_named(named: dict[str, Any]) -> None:
    from canon.errors import InputError

    for name in ("well", "branch"):
        if name in named and not {*_NAMES[:4]} & {*named}:
            raise InputError("goes with --energy or with a distance from a minimum or separatrix", f"--{name}")


def _of_claims(arguments: argparse.Namespace, tables: dict[str, Any], named: dict[str, Any]) -> Actions:
    from canon.claims.numbers import one_degree_with
    from canon.errors import InputError
    from canon.numeric.actions.motion import motion
    from canon.scenes.actions import actions_of
    from canon.scenes.values import number

    values = parameter_values(arguments.parameter)
    title, q, p, H = one_degree_with(tables, values)
    point = [getattr(arguments, word) for word in ("q", "p")]
    if named and point != [None, None]:
        raise InputError("either a point is given, or an energy", "--q")
    if not named and None in point:
        raise InputError(
            "no orbit is named: give --energy, a distance from a minimum or separatrix, or --q and --p; "
            + motion(H, q, p).ranges()
        )
    _check_named(named)
    at = () if named else tuple(float(number(text, f"--{word}")) for word, text in zip("qp", point, strict=True))
    return actions_of(title, H, (q,), (p,), at[:1], at[1:], named)


def parameter_values(texts: Sequence[str]) -> dict[str, Any]:
    """The numbers of options NAME=VALUE. **Raises:** `InputError`."""
    from canon.errors import InputError
    from canon.scenes.values import number

    values = {}
    for text in texts:
        name, equals, value = text.partition("=")
        if not equals:
            raise InputError(f"{text!r} sets nothing: write a name and its value, as k=1", "--parameter")
        values[name.strip()] = number(value.strip(), f"--parameter {name.strip()}")
    return values
