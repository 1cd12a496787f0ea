"""`canon scenes`: the systems and effects that scenes can name, and a scene file of any system."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import Final

from canon.cli.parser import BAD_INPUT
from canon.cli.spoken import complain

HELP: Final = "list the systems and effects that scenes can name, or print a system's scene file"
DESCRIPTION: Final = (
    "Lists systems with their parameters and effects, and effects with theirs. With the name of a system, prints a "
    "scene file that `canon simulate` runs; with that of an effect, what it takes and which monitors it breaks."
)


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the command."""
    parser.add_argument("name", nargs="?", metavar="NAME", help="a system or an effect (default: list them all)")


def execute(arguments: argparse.Namespace) -> int:
    """Print the list, a scene file or an effect, and return the exit status."""
    from canon.errors import InputError

    if arguments.name is None:
        print("\n".join(_everything()))
        return 0
    try:
        print(_one(arguments.name), end="")
    except InputError as error:
        complain(f"canon scenes: {error.message}")
        return BAD_INPUT
    return 0


def _everything() -> Iterator[str]:
    from canon.scenes.effects import EFFECTS
    from canon.scenes.systems import load_system, system_names

    yield "systems (canon scenes NAME prints a scene file)"
    for name in system_names():
        system = load_system(name)
        parameters = ", ".join(
            (*system.parameters, *(f"{f}({', '.join(of)})" for f, (of, _) in system.functions.items()))
        )
        yield f"  {name:<26} {system.title}"
        yield f"  {'':<26}   parameters: {parameters or 'none'}; effects: {', '.join(system.terms)}"
    yield ""
    yield "effects on bodies (canon scenes NAME says more); those marked * act on systems too, those marked ° on rigid"
    yield "bodies and on the asymmetric top alone"
    for kind, effect in EFFECTS.items():
        marked = kind + " *" * effect.on_systems + " °" * effect.on_rigid
        yield f"  {marked:<26} {', '.join(effect.parameters)}: {effect.meaning}"


def _one(name: str) -> str:
    from canon.errors import InputError
    from canon.scenes.effects import EFFECTS
    from canon.scenes.examples import scene_text
    from canon.scenes.systems import load_system, system_names
    from canon.vocabulary import nearest

    if name in system_names():
        return scene_text(load_system(name))
    if name not in EFFECTS:
        advice = nearest(name, (*system_names(), *EFFECTS)) or ": `canon scenes` lists them"
        raise InputError(f"there is no system or effect {name[:80]!r}{advice}")
    effect = EFFECTS[name]
    keys = [f"{word} (optional)" if word in effect.optional else word for word in effect.parameters]
    lines = [
        f"{effect.kind}: {effect.meaning}",
        f"  parameters   {', '.join(keys)}",
        f"  Hamiltonian  {'yes' if effect.hamiltonian else 'no: it is a force'}",
        f"  breaks       {', '.join(effect.breaks) or 'nothing'}, in general",
    ]
    return "\n".join(lines) + "\n"
