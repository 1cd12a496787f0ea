"""`canon verify`: check the claims of files, of folders, or of the built-in catalogue."""

from __future__ import annotations

import argparse
import re
import sys
import time
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from canon.cli.accuracy import no_accuracy
from canon.cli.files import ClaimFile, claim_files
from canon.cli.parser import BAD_INPUT, NO_RESOURCES, NOT_WRITTEN, count, positive, seconds, whole
from canon.cli.spoken import complain
from canon.cli.verify_output import no_proof_file, not_a_folder, print_report, write_proofs
from canon.interruption import raise_again

if TYPE_CHECKING:
    from canon.claims.journal import Journal
    from canon.claims.remembered import Memory
    from canon.claims.worker import Entry, Settings
    from canon.errors import InputError

HELP: Final = "check the claims of files, of folders, or of the built-in catalogue"
DESCRIPTION: Final = (
    "Checks claims about transformations of mechanics. A verdict is `proved` (by an exact argument), `refuted` "
    "(by a point of the domain, or an exact argument), `supported` (numerically) or `undecided`."
)
INTERRUPTED: Final = 130
Record = dict[str, Any]


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the command."""
    parser.add_argument(
        "files", nargs="*", metavar="FILE", help="a claim file, or a folder: every *.toml below it (default: catalogue)"
    )
    parser.add_argument(
        "--catalogue", action="store_true", help="check the built-in catalogue, as is done where no file is given"
    )
    parser.add_argument(
        "--coverage",
        action="store_true",
        help="show what checks every statement of the course (of the catalogue)",
    )
    parser.add_argument(
        "--fresh", action="store_true", help="answer the catalogue's claims anew, whatever is remembered of them"
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object and nothing else")
    parser.add_argument(
        "--method",
        choices=("symbolic", "numeric", "all"),
        default="symbolic",
        help="decide exactly (symbolic, the default), only sample (numeric), or decide and sample (all)",
    )
    parser.add_argument("--budget", type=seconds, default=10.0, metavar="SECONDS", help="for each claim (default: 10)")
    parser.add_argument(
        "--accuracy",
        type=positive,
        metavar="A",
        help="of numeric and all: what sampled residuals are to be bounded by, in as many bits as that takes",
    )
    parser.add_argument("--seed", type=whole, default=0, metavar="N", help="of the sample points (default: 0)")
    parser.add_argument(
        "--certificate", metavar="DIR", help="write a certificate of each proof and refutation into this folder"
    )
    parser.add_argument(
        "--proof",
        metavar="FILE",
        help="write each claim with its proof or refutation into FILE.html, .tex, .md or .txt",
    )
    parser.add_argument("--jobs", type=count, default=None, metavar="N", help="worker processes (default: the cores)")
    parser.add_argument(
        "--cluster", metavar="tcp://HOST:PORT", help="decide on the workers of this Dask cluster (extra: cluster)"
    )
    parser.add_argument(
        "--resume",
        metavar="FILE",
        help="write each answer into this journal as it comes, and don't ask again what is in it already",
    )


def execute(arguments: argparse.Namespace) -> int:
    """Check what is asked for, print the report, and return the exit status."""
    if arguments.files and (arguments.coverage or arguments.catalogue):
        option = "--coverage" if arguments.coverage else "--catalogue"
        complain(f"canon verify: error: {option} speaks of the built-in catalogue: leave out the files")
        return BAD_INPUT
    if arguments.cluster is not None and (arguments.certificate is not None or arguments.proof is not None):
        print("canon verify: error: --cluster brings verdicts alone: no certificates and no proofs", file=sys.stderr)
        return BAD_INPUT
    if arguments.accuracy is not None and (reason := no_accuracy(arguments)):
        complain(f"canon verify: --accuracy: {reason}")
        return BAD_INPUT
    start = time.monotonic()
    from canon.claims.journal import answered, journal
    from canon.claims.remembered import memory
    from canon.claims.run import NoWorkers
    from canon.cli.verify_run import run_claims
    from canon.errors import InputError

    if arguments.certificate is not None and (reason := not_a_folder(arguments.certificate, arguments.resume)):
        complain(f"canon verify: --certificate: {reason}")
        return BAD_INPUT
    if arguments.proof is not None and (reason := no_proof_file(arguments.proof, [*arguments.files, arguments.resume])):
        complain(f"canon verify: --proof: {reason}")
        return BAD_INPUT
    settings = _settings(arguments)
    try:
        diary = None if arguments.resume is None else journal(arguments.resume, settings)
    except InputError as error:
        return _refuse(error)
    results: dict[int, Record] = {}
    entries: list[Entry] = []
    errors, order = list[Record](), dict[str, int]()
    terminal = not arguments.json and sys.stdout.isatty()
    interrupted, unasked = False, ""
    kept = memory(settings) if not (arguments.files or arguments.fresh) else None
    recalled: set[str] = set()
    try:
        _read(arguments.files, entries, errors, order, results, kept, recalled, arguments.cluster)
        if diary is not None:
            results |= answered(diary, entries)
            if diary.others:
                reason = f"{diary.others} of its answers are of another version of canon or other options, and not used"
                complain(f"canon verify: --resume {arguments.resume}: {reason}")
        quiet = arguments.json or arguments.coverage
        told = None if diary is None else partial(_write_down, diary, entries)
        where = {"jobs": arguments.jobs, "cluster": arguments.cluster}
        run_claims(entries, settings, results, **where, terminal=terminal, quiet=quiet, told=told)
    except InputError as error:
        return _refuse(error)
    except NoWorkers as error:
        unasked = str(error)
    except KeyboardInterrupt:
        interrupted = True
    if diary is not None and diary.fault:
        reason = f"{diary.fault}: the answers since then are not in it"
        complain(f"canon verify: --resume {arguments.resume}: {reason}")
    if kept is not None:
        _remember(kept, entries, results, recalled | {error["file"] for error in errors})
    from canon.report.record import exit_status, run_record

    answers = [results[position] for position in sorted(results)]
    claims = [answer["claim"] for answer in answers if "claim" in answer]
    errors += [answer["error"] for answer in answers if "error" in answer]
    unproved = "" if arguments.proof is None else write_proofs(arguments.proof, claims, time.monotonic() - start)
    errors.sort(key=lambda error: (order.get(error["file"], -1), _claim_number(error["where"])))
    record = run_record(claims, errors)
    table = _coverage(entries, record) if arguments.coverage else []
    left = len(entries) - len(results) if interrupted or unasked else 0
    if table and not arguments.json:
        print("\n".join(table))
    else:
        print_report(record, json=arguments.json, terminal=terminal, seconds=time.monotonic() - start, interrupted=left)
    unwritten = [claim["detail"]["certificate_error"] for claim in claims if "certificate_error" in claim["detail"]]
    if unwritten:
        what = "proofs" if arguments.certificate is None else "certificates"
        complain(f"canon verify: {len(unwritten)} {what} are missing: {unwritten[0]}")
    if unproved:
        complain(f"canon verify: --proof: {unproved}")
    if unasked:
        complain(f"canon verify: {left} of {len(entries)} claims not asked: {unasked}")
        return NO_RESOURCES
    status = INTERRUPTED if interrupted else exit_status(claims, errors)
    unkept = diary is not None and diary.fault
    return status or (NOT_WRITTEN if unwritten or unproved or unkept else 0)


def _write_down(diary: Journal, entries: list[Entry], position: int, answer: Record) -> None:
    from canon.claims.journal import write
    from canon.claims.many import LOST
    from canon.claims.worker import ENDED

    note = str(answer["claim"]["detail"].get("note")) if "claim" in answer else ""
    if not note.startswith((LOST, ENDED)):  # nobody has answered: another run asks again
        write(diary, entries[position], answer)


def _refuse(error: InputError) -> int:
    complain(f"canon verify: {error}")
    return BAD_INPUT


def _coverage(entries: list[Entry], record: Record) -> list[str]:
    """The table of the course's statements as lines; it is put into the record as data."""
    from canon.report.coverage import as_records, as_text, coverage

    rows = coverage(entries, record["claims"])
    record["coverage"] = as_records(rows)
    return as_text(rows)


def _read(
    names: list[str],
    entries: list[Entry],
    errors: list[Record],
    order: dict[str, int],
    results: dict[int, Record],
    kept: Memory | None,
    recalled: set[str],
    cluster: str | None,
) -> None:
    """Read the files into `entries` and `errors`, and number them in `order`; a cluster's workers do it where one is.

    What is remembered goes to `results`, the names of its files to `recalled`. All are filled as reading goes on, so
    that an interruption loses nothing.
    """
    from canon.claims.remembered import recall
    from canon.claims.worker import Entry
    from canon.report.record import error_record

    files, missing = claim_files(names) if names else (_catalogue(), [])
    errors += [error_record(absent.name, "", absent.message) for absent in missing]
    memories = [None if kept is None else recall(kept, file.path, file.name) for file in files]
    readings = _readings([file.path for file, known in zip(files, memories, strict=True) if known is None], cluster)
    for file, known in zip(files, memories, strict=True):
        raise_again()
        order.setdefault(file.name, len(order))
        if known is not None:
            recalled.add(file.name)
            results |= {len(entries) + k: {"claim": record} for k, record in enumerate(known[1])}
            entries += [Entry(file.name, claim.index, claim, str(file.path)) for claim in known[0]]
            continue
        claims, problems, digest = next(readings)
        entries += [Entry(file.name, claim.index, claim, str(file.path), message, digest) for claim, message in claims]
        errors += [error_record(file.name, problem["where"], problem["message"]) for problem in problems]


def _readings(paths: list[Path], cluster: str | None) -> Iterator[tuple[list[Any], list[dict[str, str]], str]]:
    """Of each file its claims, each with the message in which it came from elsewhere or None, its faults, and the name
    of what it says."""
    if cluster is not None:
        from canon.cli.cluster import readings_of

        yield from readings_of(cluster, paths) if paths else ()
        return
    from canon.claims import document
    from canon.claims.read_many import stopped
    from canon.claims.reader import read_text
    from canon.errors import InputError

    for path in paths:
        try:
            text = document.content(path)
            claims, problems = read_text(text)
        except InputError as error:
            yield [], [{"where": error.where, "message": error.message}], ""
        except Exception as error:  # a flaw of the reader must not keep the other files from being checked
            yield [], [stopped(error)], ""
        else:
            yield [(claim, None) for claim in claims], problems, document.digest(text)


def _remember(kept: Memory, entries: list[Entry], results: dict[int, Record], others: set[str]) -> None:
    """Keep the answers about each file, but for `others`."""
    from canon.claims.remembered import forget_the_oldest, remember

    files: dict[str, list[int]] = {}
    for position, entry in enumerate(entries):
        if entry.file not in others:
            files.setdefault(entry.file, []).append(position)
    for positions in files.values():
        claims = [claim for k in positions if (claim := entries[k].claim) is not None]
        records = [results[k]["claim"] for k in positions if "claim" in results.get(k, {})]
        if entries[positions[0]].digest:
            remember(kept, entries[positions[0]].digest, claims, records)
    if files:
        forget_the_oldest(kept)


def _catalogue() -> list[ClaimFile]:
    """Return the files of the built-in catalogue, named by their room in it and their file's name."""
    from canon.catalogue import files

    paths = [Path(str(file)) for file in files()]
    return [ClaimFile(f"{path.parent.name}/{path.name}", path) for path in paths]


def _settings(arguments: argparse.Namespace) -> Settings:
    from canon.claims.worker import Settings
    from canon.report.proof_file import notation_of

    return Settings(
        budget=arguments.budget,
        seed=arguments.seed,
        method=arguments.method,
        accuracy=arguments.accuracy,
        certificates=arguments.certificate,
        proof=arguments.proof and notation_of(arguments.proof),
    )


def _claim_number(where: str) -> int:
    """Return the number of the claim that a place names, 0 for another place."""
    found = re.match(r"claim (\d+)", where)
    return int(found[1]) if found else 0
