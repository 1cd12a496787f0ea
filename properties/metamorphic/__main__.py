"""Claims of known truth, written otherwise: what is proved of one must not be refuted of the other.

    python -m properties.metamorphic --variants 1000 --seed 1

The claims are the catalogue's and those of the corpora in `properties/`. Each variant is made by a few of the rules of
`properties.metamorphic.rules`, by chance, and decided as `canon verify` decides. With `--rules same` it is true exactly
when its source is; with `weaker` it follows from a true one, or a false one follows from it; with `kinds` it is what a
true one says in words of another kind, or denies; with `mixed` all of these; with `spoiled` something was changed, and
only mpmath says what it makes of it: what is proved then is printed if it fails at a point, and what is refuted if it
holds at all that were tried. No verdict may contradict the truth; every such one is printed with its file.
"""

from __future__ import annotations

import argparse
import json
import random
import time
import tomllib
from collections import Counter
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from typing import Any, NamedTuple

from canon import catalogue
from canon.claims import document
from canon.claims.reader import read_tables
from canon.claims.run import run
from canon.claims.verify import METHODS
from canon.claims.worker import Entry, Settings
from canon.errors import InputError
from canon.report.record import claim_record
from properties.metamorphic.rules import KINDS, SAME, STRONGER, WEAKER
from properties.metamorphic.spoiled import is_true, spoiled
from properties.metamorphic.tables import Tables, alone, in_toml

CORPORA = Path(__file__).parents[1]
ASKED = ("same", "weaker", "kinds", "mixed", "spoiled")
BATCH = 200


class Source(NamedTuple):
    """A claim alone in its file, and whether it is true."""

    label: str
    tables: Tables
    truth: bool


class Variant(NamedTuple):
    """A claim written otherwise, by which rules; its truth, where that follows."""

    source: Source
    rules: tuple[str, ...]
    tables: Tables
    truth: bool | None


def sources() -> list[Source]:
    """The claims of the catalogue and of the corpora, but for those that are ill-posed."""
    found = list[Source]()
    for entry in catalogue.files():
        tables = document.parse(entry.read_text(encoding="utf-8"))
        for k, claim in enumerate(tables.get("claim", ())):
            truth = claim.get("expect", "holds") not in ("fails", "refuted")
            found.append(Source(f"{entry.name} #{k + 1}", alone(tables, k), truth))
    for path in sorted(CORPORA.glob("*.toml")):
        for number, file in enumerate(tomllib.loads(path.read_text(encoding="utf-8"))["file"], 1):
            try:
                tables = document.parse(file["text"])
            except InputError:
                continue
            if len(tables.get("claim", ())) == len(file["truths"]):
                for k, truth in enumerate(file["truths"]):
                    if truth != "ill-posed":
                        label = f"{path.name} {number} #{k + 1}"
                        found.append(Source(label, alone(tables, k), truth == "true"))
    return found


def variant(source: Source, seed: str, asked: str) -> Variant | None:
    """A claim made of the source's; None where the rules that chance chose have no place."""
    rng = random.Random(f"{source.label} {seed}")
    tables, used, truth = source.tables, list[str](), source.truth
    if asked == "spoiled":
        new = spoiled(rng, tables)
        return None if new is None else Variant(source, ("spoiled",), new, None)
    if asked in ("kinds", "mixed") and (truth or asked == "kinds"):
        name, rule = rng.choice([*KINDS.items()])
        new = rule(rng, tables) if truth else None
        if new is None:
            return None
        tables, used, truth = new, [name], not name.startswith("as_not")
    for name in rng.choices([*SAME], k=rng.choice((1, 2, 3, 4))):
        new = SAME[name](rng, tables)
        if new is not None and new != tables:
            tables, used = new, [*used, name]
    if asked in ("weaker", "mixed"):  # a generating function has a map only where its Hessian isn't 0, be it nowhere
        name, rule = rng.choice([*(WEAKER if truth else STRONGER).items()])
        new = rule(rng, tables) if truth or "transformation" in tables or "generating_function" not in tables else None
        if new is None:
            return None
        tables, used = new, [*used, name]
    return Variant(source, tuple(used), tables, truth) if used else None


def variants(chosen: list[Source], seed: str, asked: str) -> Iterator[Variant]:
    """Variants of the sources, each in its turn, in an order that chance chose; for ever."""
    turn = 0
    while chosen:
        for source in random.Random(f"{seed} {turn}").sample(chosen, len(chosen)):
            try:
                found = variant(source, f"{seed} {turn}", asked)
            except InputError:
                continue
            if found is not None:
                yield found
        turn += 1


def decided(found: list[Variant], settings: Settings, jobs: int) -> Iterator[tuple[Variant, dict[str, Any]]]:
    """Each variant with the record of its verdict, or with the message of why it isn't read."""
    entries, kept = list[Entry](), list[Variant]()
    for each in found:
        reading = read_tables(each.tables)
        if reading.problems or not reading.claims:
            yield each, {"verdict": "input error", "message": str(reading.problems[:1])}
            continue
        entries.append(Entry(each.source.label, 0, reading.claims[0]))
        kept.append(each)
    for position, reply in run(entries, settings, claim_record, jobs=jobs):
        record = reply.get("claim") or {"verdict": "input error", "message": reply["error"]["message"]}
        yield kept[position], record


def contradicts(found: Variant, verdict: str) -> bool:
    """Whether a verdict is wrong, or for what was spoiled, whether mpmath sees it otherwise."""
    if verdict not in ("proved", "refuted"):
        return False
    truth = found.truth if found.truth is not None else is_true(random.Random(1), found.tables)
    return truth is not None and verdict == ("refuted" if truth else "proved")


def main() -> int:
    """Try variants; each contradiction is printed as a file, and the counts at the end."""
    parser = argparse.ArgumentParser(prog="python -m properties.metamorphic", description=__doc__)
    parser.add_argument("--variants", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--rules", choices=ASKED, default="same")
    parser.add_argument("--only", default="", help="sources whose label contains this")
    parser.add_argument("--budget", type=float, default=1.0)
    parser.add_argument("--method", choices=METHODS, default="symbolic")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--journal", type=Path, help="a file to which a record of each variant is added, a line each")
    options = parser.parse_args()
    chosen = [source for source in sources() if options.only in source.label]
    settings = Settings(options.budget, options.seed, options.method)
    waiting = islice(variants(chosen, str(options.seed), options.rules), options.variants)
    counts, wrong, start = Counter[str](), 0, time.monotonic()
    while batch := [*islice(waiting, BATCH)]:
        for found, record in decided(batch, settings, options.jobs):
            verdict, truth = record["verdict"], {True: "true", False: "false", None: "spoiled"}[found.truth]
            counts[f"{truth}, {verdict}"] += 1
            counts["alarms"] += "alarm" in record.get("detail", {})
            if contradicts(found, verdict) or "alarm" in record.get("detail", {}):
                wrong += 1
                print(f"# {found.source.label} ({found.source.truth}), {', '.join(found.rules)}: {verdict}, "
                      f"{record['method']}, {record['witness']}\n{in_toml(found.tables)}", flush=True)  # fmt: skip
            if options.journal:
                note = {"label": found.source.label, "truth": truth, "rules": found.rules}
                note |= {key: record.get(key) for key in ("kind", "verdict", "method", "seconds", "message")}
                with options.journal.open("a", encoding="utf-8") as stream:
                    stream.write(json.dumps(note) + "\n")
    figures = {**dict(sorted(counts.items())), "contradictions": wrong, "seconds": round(time.monotonic() - start, 1)}
    print(json.dumps(figures, indent=1))
    return int(bool(wrong))


if __name__ == "__main__":
    raise SystemExit(main())
