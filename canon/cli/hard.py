"""`canon hard`: cases in which textbook formulas lose digits, run beside canon's routines and other packages."""

from __future__ import annotations

import argparse
import csv
import sys
from typing import Final

from canon.cli.parser import BAD_INPUT
from canon.cli.spoken import complain, notation

HELP: Final = "run the catalogue of hard cases: digits kept beside what conditioning allows"
DESCRIPTION: Final = (
    "Runs cases in which textbook formulas lose digits (separatrices, slim orbits, resonance, caustics, …). Each line "
    "shows the condition of the quantity, the digits that it allows, and those that the naive formula, canon's routine "
    "and the packages that are installed keep, all measured in this run against fifty digits."
)

WIDTH: Final = 140
"""Columns of a table that goes into a file."""


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the command."""
    parser.add_argument("names", nargs="*", metavar="NAME", help="a family, or a part of a case's name (default: all)")
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_true", help="print one JSON object and nothing else")
    form.add_argument("--csv", action="store_true", help="print a line for each point of each case, and nothing else")
    parser.add_argument("--list", action="store_true", help="list the cases and what they state; run nothing")
    parser.add_argument("--slow", action="store_true", help="the slow cases too")


def execute(arguments: argparse.Namespace) -> int:
    """Print the table and return the exit status: 1 where digits are lost without a reason, 3 for bad input."""
    from canon.errors import InputError
    from canon.hard.catalogue import cases

    try:
        chosen = cases(arguments.names, slow=arguments.slow)
    except InputError as error:
        complain(f"canon hard: {error.message}")
        return BAD_INPUT
    if arguments.list:
        for case in chosen:
            print(f"{case.family}: {case.name} ({case.states})")
        return 0
    from canon.hard.run import Row, run
    from canon.report.hard_table import closing_lines, hard_csv, hard_record, hard_table
    from canon.report.waiting import progress

    found = list[Row]()
    with progress("hard cases") as watch:
        for case in chosen:
            found.append(run(case))
            watch(len(found) / len(chosen))
    if arguments.json:
        print(notation(hard_record(found)))
    elif arguments.csv:
        csv.writer(sys.stdout).writerows(hard_csv(found))
    else:
        from canon.report.console import terminal

        console = terminal()
        if not console.is_terminal:
            console.width = WIDTH
        console.print(hard_table(found), "", *closing_lines(found), sep="\n")
    return 1 if any(row.verdict == "lost" for row in found) else 0
