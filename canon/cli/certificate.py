"""`canon certificate`: check certificates by two checkers, neither of which shares code with the deciders."""

from __future__ import annotations

import argparse
import os
import re
import sys
from collections import Counter
from itertools import chain
from typing import TYPE_CHECKING, Any, Final

from canon.cli.files import files_below
from canon.cli.parser import BAD_INPUT, NOT_WRITTEN, Parser
from canon.cli.spoken import complain, notation, shown

if TYPE_CHECKING:
    from canon.checker.check import Answer

HELP: Final = "check certificates of proofs and refutations, or put them in Coq"
DESCRIPTION: Final = "Works with certificates that `canon verify --certificate DIR` has written."
CHECK: Final = (
    "Derives from each claim's own text what must vanish, and checks the certificate's identities or its witness: by "
    "the checker of all kinds of claims, and by the one in a single file of Python, or by that of refutations beside "
    "it (`shown`, or nothing where they have no means). They share no code with the other checker, nor with what has "
    "made the certificate."
)
EXPORT: Final = (
    "Writes theorems that each residual of the claim is 0 over the reals (or isn't, at a witness), with proofs that "
    "`coqc` checks."
)
STATUS: Final = {
    "confirmed": 0, "confirmed in part": 2, "not confirmed": 2, "rejected": 1, "unreadable": BAD_INPUT,
    "shown": 0, "not shown": 2, "wrong": 1,
}  # fmt: skip
"""The exit status of each answer; of several files the gravest: unreadable, rejected or wrong, in part, confirmed. What
one of the two checkers has no means to show is no fault where the other one shows it."""
LONGEST: Final = 1000
"""Characters of the reasons that are printed; with --json all are."""
_GRAVEST: Final = (0, 2, 1, BAD_INPUT)


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the command."""
    actions = parser.add_subparsers(title="actions", dest="action", metavar="ACTION", parser_class=Parser)
    check = actions.add_parser("check", help="check certificates", description=CHECK)
    check.add_argument("files", nargs="+", metavar="FILE", help="a certificate, or a folder: every *.json below it")
    export = actions.add_parser("export", help="write a certificate as a file of Coq", description=EXPORT)
    export.add_argument("file", metavar="CERTIFICATE", help="a certificate")
    export.add_argument("--coq", required=True, metavar="FILE.v", help="the file to be written")
    check.add_argument("--alone", action="store_true", help="ask the small checkers alone: shown, not shown, or wrong")
    check.add_argument("--json", action="store_true", help="print one JSON object and nothing else")


def execute(arguments: argparse.Namespace) -> int:
    """Do what is asked for, and return the exit status."""
    if arguments.action is None:
        print("canon certificate: say what to do: `check FILE…`, or `export FILE --coq FILE.v`", file=sys.stderr)
        return BAD_INPUT
    return _check(arguments) if arguments.action == "check" else _export(arguments)


def _export(arguments: argparse.Namespace) -> int:
    from canon.checker.check import check
    from canon.checker.files import load
    from canon.checker.functions import Unreadable
    from canon.cli.simulate import check_folder
    from canon.errors import InputError
    from canon.report.coq import coq_of
    from canon.report.whole_file import written

    try:
        data = load(arguments.file)
        if (answer := check(data)).status == "rejected":
            remedy = "one that another version of canon made has to be made anew: `canon verify FILE --certificate DIR`"
            raise InputError(f"this certificate is {answer} ({remedy})")
        check_folder("--coq", arguments.coq, arguments.file)
        text = coq_of(data)
        written(arguments.coq, text)
    except (InputError, Unreadable) as error:
        complain(f"canon certificate: {arguments.file}: {error}")
        return BAD_INPUT
    except OSError as error:
        complain(f"canon certificate: {arguments.coq} can't be written: {error.strerror}")
        return NOT_WRITTEN
    count = text.count("\nTheorem ")
    print(shown(f"{arguments.coq}: {count} theorem{'s' * (count > 1)}; {_checked_with(arguments.coq)}"))
    return 0


def _checked_with(path: str) -> str:
    """How Coq checks the file: its name is that of a module, so that it may have letters, digits and _ alone."""
    name = os.path.basename(path)
    stem, ending = os.path.splitext(name)
    if stem.isidentifier() and ending == ".v":
        return f"check with `coqc {path}`"
    fit = re.sub(r"\W", "_", stem)
    fit = fit if fit.isidentifier() else f"proof_{fit}"
    return f"coqc takes names of letters, digits and _ that end in .v: rename it, `coqc {fit}.v`"


def _check(arguments: argparse.Namespace) -> int:
    from canon.checker.check import Answer
    from canon.checker.files import load
    from canon.checker.functions import Unreadable
    from canon.checker.limits import checked, checked_alone
    from canon.report.words import visible

    rows: list[tuple[str, list[Answer]]] = []
    for name in _files(arguments.files):
        try:
            data = load(name)
            answers = [checked_alone(data) if arguments.alone else checked(data)]
            if not arguments.alone and answers[0].status != "rejected":
                answers.append(checked_alone(data))
        except Unreadable as reason:
            answers = [Answer("unreadable", (str(reason),))]
        rows.append((name, answers))
        if not arguments.json:
            words = ", ".join(answer.status for answer in _said(answers))
            why = visible("; ".join(chain.from_iterable(answer.reasons for answer in _said(answers))))
            print(f"{words:<18} {visible(name)}{': ' if why else ''}{cut(why)}", flush=True)  # both quote the file
    if arguments.json:
        print(notation({"format": 1, "certificates": [_row(name, answers) for name, answers in rows]}, indent=1))
    elif len(rows) > 1:
        counts = Counter(answer.status for _, answers in rows for answer in _said(answers))
        print(f"\n{len(rows)} certificates: " + ", ".join(f"{counts[word]} {word}" for word in STATUS if counts[word]))
    return max((_status(answers) for _, answers in rows), key=_GRAVEST.index)


def _status(answers: list[Answer]) -> int:
    """The exit status of one file: 0 where either checker shows it, and neither has found a fault."""
    each = [STATUS[answer.status] for answer in answers]
    return 0 if 0 in each and {*each} <= {0, 2} else max(each, key=_GRAVEST.index)


def _said(answers: list[Answer]) -> list[Answer]:
    """The first answer, and the other checker's, but for "not shown": that it has no means is no fault of the proof."""
    return [*answers[:1], *(answer for answer in answers[1:] if answer.status != "not shown")]


def _row(name: str, answers: list[Answer]) -> dict[str, Any]:
    """What the JSON says of a certificate: the first answer, and the other checker's beside it."""
    first, *others = [{"status": answer.status, "reasons": list(answer.reasons)} for answer in answers]
    return {"file": name, **first, **({"in_one_file": others[0]} if others else {})}


def cut(text: str) -> str:
    """The text, or the beginning of a long one."""
    return text if len(text) <= LONGEST else f"{text[:LONGEST]} …"


def _files(names: list[str]) -> list[str]:
    """The files named, and every *.json below the folders named; a folder without one stands for itself, and so does
    one that can't be read."""
    found: list[str] = []
    for name in names:
        unread: list[str] = []
        below = list(files_below(name, ".json", lambda error, unread=unread: unread.append(str(error.filename))))
        found += below + unread if os.path.isdir(name) and (below or unread) else [name]
    return found
