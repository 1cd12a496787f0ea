"""`canon algebra`: the Lie algebras that the claims of files are about."""

from __future__ import annotations

import argparse
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from canon.cli.files import claim_files
from canon.cli.parser import BAD_INPUT, NO_RESOURCES, seconds, whole
from canon.cli.spoken import complain, notation
from canon.cli.verify import INTERRUPTED

if TYPE_CHECKING:
    from canon.claims.worker import Entry

HELP: Final = "show the Lie algebras of claims: bracket table, Killing form, identification"
DESCRIPTION: Final = (
    "Shows the Lie algebra of each claim of kind algebra, matrix_algebra or group: its bracket table, Killing form, "
    "Levi decomposition and name, with the verdict on the claim."
)


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the command."""
    parser.add_argument("files", nargs="+", metavar="FILE", help="a claim file, or a folder: every *.toml below it")
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_true", help="print one JSON object and nothing else")
    form.add_argument("--latex", action="store_true", help="print the bracket tables in LaTeX")
    parser.add_argument("--budget", type=seconds, default=10.0, metavar="SECONDS", help="for each claim (default: 10)")
    parser.add_argument("--seed", type=whole, default=0, metavar="N", help="of the sample points (default: 0)")


def execute(arguments: argparse.Namespace) -> int:
    """Print the algebras and return the exit status: 3 for bad input, 1 or 2 for a verdict against its expectation."""
    from canon.claims.algebra_table import KINDS
    from canon.claims.run import NoWorkers

    entries, errors = _read(arguments.files, KINDS)
    found, stopped = dict[int, dict[str, Any]](), 0
    try:
        _ask(entries, arguments, found)
    except KeyboardInterrupt:
        stopped = INTERRUPTED
    except NoWorkers as error:
        stopped = NO_RESOURCES
        complain(f"canon algebra: {len(entries) - len(found)} of {len(entries)} claims not asked: {error}")
    answers = [found[position] for position in sorted(found)]
    errors += [answer["error"] for answer in answers if "error" in answer]
    tables = [answer["claim"] for answer in answers if "claim" in answer]
    if not entries and not errors:
        kinds = ", ".join(KINDS)
        errors.append({"file": arguments.files[0], "where": "", "message": f"no claim of kind {kinds} is in it"})
    if arguments.json:
        algebras = [table["shown"] for table in tables]
        print(notation({"format": 1, "algebras": algebras, "errors": errors}))
    else:
        print("\n\n".join(table["shown"] for table in tables))
        for error in errors:
            place = ": ".join(part for part in (error["file"], error["where"], error["message"]) if part)
            complain(f"canon algebra: {place}")
    if stopped == INTERRUPTED:
        complain(f"canon algebra: interrupted: {len(entries) - len(found)} of {len(entries)} claims not looked at")
    against = {table["verdict"] for table in tables if not table["expected"]}
    return stopped or (BAD_INPUT if errors else 0 if not against else 2 if against == {"undecided"} else 1)


def _read(names: list[str], kinds: tuple[str, ...]) -> tuple[list[Entry], list[dict[str, Any]]]:
    """The claims of these kinds, and what is wrong with the files."""
    from canon.claims import document
    from canon.claims.reader import read_text
    from canon.claims.worker import Entry
    from canon.errors import InputError

    files, missing = claim_files(names)
    errors: list[dict[str, Any]] = [{"file": f.name, "where": "", "message": f.message} for f in missing]
    entries = list[Entry]()
    for file in files:
        try:
            text = document.content(file.path)
            claims, problems = read_text(text)
        except InputError as error:
            claims, problems = [], [{"where": error.where, "message": error.message}]
            text = ""
        errors += [{"file": file.name, **problem} for problem in problems]
        asked = [claim for claim in claims if claim.kind in kinds]
        digest = document.digest(text)
        entries += [Entry(file.name, claim.index, claim, str(file.path), digest=digest) for claim in asked]
    return entries, errors


def _ask(entries: list[Entry], arguments: argparse.Namespace, found: dict[int, dict[str, Any]]) -> None:
    """Decide the claims and find their algebras, in processes that are ended where they overstay their time."""
    from canon.claims.run import run
    from canon.claims.worker import Settings
    from canon.report.algebra_text import recorded

    form = "record" if arguments.json else "latex" if arguments.latex else "text"
    settings = Settings(budget=arguments.budget, seed=arguments.seed, recording=True)
    for position, answer in run(entries, settings, partial(recorded, settings, form)):
        found[position] = answer
