"""Odd values in files, and journals that are damaged: a part of `python -m properties.command_attacks`.

A value of every odd kind stands in any place of claim files, scenes and certificates, and a journal is damaged at each
of its bytes: there is an answer or an error that is meant, soon, and no other answer than before.
"""

from __future__ import annotations

import copy
import datetime
import random
import time
import traceback
from collections.abc import Iterator
from contextlib import suppress
from decimal import Decimal
from pathlib import Path
from typing import Any, Final

from canon.catalogue import files
from canon.checker.check import check, checksum
from canon.checker.functions import Unreadable
from canon.claims.certificate_data import certificate, statement_tables
from canon.claims.document import parse
from canon.claims.journal import answered, journal, write
from canon.claims.reader import read_tables, read_text
from canon.claims.verify import verify
from canon.claims.worker import Entry, Settings
from canon.errors import InputError
from canon.report.record import claim_record
from canon.scenes.examples import scene_text
from canon.scenes.reader import scene_of
from canon.scenes.systems import load_system, system_names

CLAIMS: Final = (
    '[phase_space]\nq = ["q"]\np = ["p"]\n[[claim]]\nkind = "bracket"\nf = "q"\ng = "p"\nequals = "1"\n'
    '[[claim]]\nkind = "identity"\nlhs = "sin(q)**2 + cos(q)**2"\nrhs = "1"\n'
)
COLOUR: Final = "\x1b]0;a\x07\x1b[31m\u202e\x9b31m"
SLOW: Final = 10.0
"""Seconds of a processor that reading an odd file may take, and deciding two claims with a fifth of a second each."""
VALUES: Final = (
    True, 0, -1, 10**30, 10**400, Decimal("nan"), Decimal("inf"), Decimal("1e308"), Decimal("-0.0"), Decimal("1e-400"),
    "", " ", "nan", "q", "1/0", "oo", "0**0", "__import__('os')", "q.__class__", "a" * 10_000, "\0", COLOUR, "(" * 300,
    "٣", "ﬁ", "q\u200b", [], [[]], [[[[]]]], {}, {"": {}}, [1, "a"], datetime.date(1, 1, 1), datetime.time(0),
    ["q"] * 999,
)  # fmt: skip


def spoiled(rng: random.Random, data: Any, value: Any, *, inner: bool = False) -> Any:
    """Data in one of whose places is the value; an inner table or list is changed as a whole at times, too."""
    if isinstance(data, (dict, list)) and data and (not inner or rng.random() < 0.9):
        keys = list(data) if isinstance(data, dict) else range(len(data))
        key, whole = rng.choice(list(keys)), copy.copy(data)
        whole[key] = spoiled(rng, data[key], value, inner=True)
        return whole
    return copy.deepcopy(value)


def odd_values(rng: random.Random, tries: int) -> Iterator[tuple[str, str]]:
    """(what was tried, what was wrong) of files with an odd value in one of their places."""

    paths = sorted(map(str, files()))
    scenes = sorted(system_names())

    def claims() -> None:
        found = read_tables(
            spoiled(rng, parse(Path(rng.choice(paths)).read_text(encoding="utf-8")), rng.choice(VALUES))
        )
        for claim in found.claims[:2]:
            with suppress(InputError):
                verify(claim, budget=0.2)

    def scene() -> None:
        scene_of(spoiled(rng, parse(scene_text(load_system(rng.choice(scenes)))), rng.choice(VALUES)))

    made: list[dict[str, Any]] = []

    def certificates() -> None:
        if len(made) < 20:
            tables = parse(Path(rng.choice(paths)).read_text(encoding="utf-8"))
            claim = read_tables(tables).claims[0]
            made.append(certificate(claim, verify(claim, budget=2.0), statement_tables(tables, claim.index)))
        whole = spoiled(rng, made[-1], rng.choice([v for v in VALUES if isinstance(v, (bool, int, str, list, dict))]))
        check({**whole, "checksum": checksum(whole)} if isinstance(whole, dict) else whole)

    for number in range(tries):
        target = (claims, scene, certificates)[number % 3]
        start = time.process_time()
        try:
            target()
        except (InputError, Unreadable):
            pass
        except Exception:  # a crash is what is looked for
            yield target.__name__, traceback.format_exc()[-900:]
            continue
        yield target.__name__, "slow" if time.process_time() - start > SLOW else ""


def journals() -> Iterator[tuple[str, str]]:
    """The same of a journal, of which each byte in turn is another one, or the last."""

    entries = [Entry("claims.toml", claim.index, claim, digest="d") for claim in read_text(CLAIMS).claims]
    path = Path("damaged")
    path.unlink(missing_ok=True)

    kept = journal(path, Settings())
    for entry in entries:
        assert entry.claim is not None
        write(kept, entry, {"claim": claim_record(entry, entry.claim, verify(entry.claim))})
    sound, whole = answered(kept, entries), path.read_bytes()
    for place in range(len(whole)):
        for data in (whole[:place], whole[:place] + bytes([whole[place] ^ 21]) + whole[place + 1 :]):
            path.write_bytes(data)
            try:
                found = answered(kept, entries)
            except InputError:
                found = {}
            yield "journal", "" if found.items() <= sound.items() else f"another answer, of byte {place}"
