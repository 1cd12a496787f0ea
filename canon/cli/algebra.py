"""`canon algebra`: the Lie algebras that the claims of files are about."""

from __future__ import annotations

import argparse
from typing import Any, Final

from canon.cli.files import claim_files
from canon.cli.parser import BAD_INPUT, seconds, whole
from canon.cli.spoken import complain, notation

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
    from canon.claims.algebra_table import KINDS, AlgebraTable, algebra_table
    from canon.claims.reader import read_file
    from canon.errors import InputError
    from canon.report.algebra_text import as_latex, as_record, as_text

    files, missing = claim_files(arguments.files)
    errors: list[dict[str, Any]] = [{"file": f.name, "where": "", "message": f.message} for f in missing]
    tables: list[tuple[str, AlgebraTable]] = []
    for file in files:
        claims, problems = read_file(file.path)
        errors += [{"file": file.name, **problem} for problem in problems]
        for claim in claims:
            if claim.kind not in KINDS:
                continue
            try:
                tables.append((file.name, algebra_table(claim, budget=arguments.budget, seed=arguments.seed)))
            except InputError as error:
                where = f"claim {claim.index + 1}" + (f", {error.where}" if error.where else "")
                errors.append({"file": file.name, "where": where, "message": error.message})
    if not tables and not errors:
        kinds = ", ".join(KINDS)
        errors.append({"file": arguments.files[0], "where": "", "message": f"no claim of kind {kinds} is in it"})
    if arguments.json:
        record = {"format": 1, "algebras": [as_record(table, name) for name, table in tables], "errors": errors}
        print(notation(record))
    elif arguments.latex:
        print("\n\n".join(as_latex(table) for _, table in tables))
    else:
        print("\n\n".join("\n".join(as_text(table, name)) for name, table in tables))
    if not arguments.json:
        for error in errors:
            place = ": ".join(part for part in (error["file"], error["where"], error["message"]) if part)
            complain(f"canon algebra: {place}")
    against = [table.verdict.status for _, table in tables if not table.claim.is_met_by(table.verdict.status)]
    if errors:
        return BAD_INPUT
    return 0 if not against else 2 if set(against) == {"undecided"} else 1
