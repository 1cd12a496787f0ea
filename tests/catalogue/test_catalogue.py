"""The catalogue's files: complete, readable at a glance, and accounted for in the audit of the course."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

from canon.catalogue import ROOMS, files
from canon.catalogue.ledger import cited, elsewhere, errata, statements

ROOT = Path(__file__).resolve().parents[2]
FILES = files()


def test_every_claim_file_of_every_room_is_listed() -> None:
    rooms = [Path(str(entry)).parent.name for entry in FILES]
    assert list(dict.fromkeys(rooms)) == list(ROOMS)
    folder = Path(str(FILES[0])).parents[1]
    # `systems` holds what scenes can name, not claims
    assert len(FILES) == len([file for file in folder.glob("*/*.toml") if file.parent.name != "systems"])


def test_the_course_is_read_in_its_own_order() -> None:
    chapter_of, chapters = {item.id: item.chapter for item in statements()}, []
    for entry in FILES:
        if Path(str(entry)).parent.name == "course":
            table = tomllib.loads(entry.read_text(encoding="utf-8"))
            sources = [table.get("source"), *(claim.get("source") for claim in table["claim"])]
            chapters.append(next(chapter_of[name] for s in sources for name in cited(s) if name in chapter_of))
    assert chapters == sorted(chapters)
    assert {chapters[0], chapters[-1]} == {1, 15}


@pytest.mark.parametrize("entry", FILES, ids=lambda entry: entry.name)
def test_names_are_kebab_case_and_every_claim_has_a_title(entry) -> None:
    assert re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*\.toml", entry.name)
    table = tomllib.loads(entry.read_text(encoding="utf-8"))
    titles = [table["title"], *(claim["title"] for claim in table["claim"])]
    assert all(titles)
    assert len(titles) == len(set(titles)) > 1


def test_at_least_sixty_transformations_and_thirty_false_claims_beside_the_course() -> None:
    besides = [
        tomllib.loads(entry.read_text(encoding="utf-8"))
        for entry in FILES
        if Path(str(entry)).parent.name not in ("course", "errata")
    ]
    canonical = [
        table
        for table in besides
        if any(c["kind"] == "canonical" and c.get("expect", "holds") == "holds" for c in table["claim"])
    ]
    false = [claim for table in besides for claim in table["claim"] if claim.get("expect") == "fails"]
    assert len(canonical) >= 60
    assert len(false) >= 30


def test_each_printed_error_stands_beside_its_correction() -> None:
    for entry in FILES:
        if Path(str(entry)).parent.name == "errata":
            expectations = {c.get("expect", "holds") for c in tomllib.loads(entry.read_text(encoding="utf-8"))["claim"]}
            assert expectations == {"holds", "fails"}, entry.name


def test_every_erratum_is_cited_by_a_claim_that_fails_and_by_one_that_holds() -> None:
    found: dict[str, set[str]] = {item.id: set() for item in errata()}
    for entry in FILES:
        table = tomllib.loads(entry.read_text(encoding="utf-8"))
        for claim in table["claim"]:
            for name in cited(claim.get("source", table.get("source"))):
                if name in found:
                    found[name].add(claim.get("expect", "holds"))
    assert {name for name, expectations in found.items() if expectations != {"holds", "fails"}} == set()


def test_every_statement_of_the_course_is_cited_or_named_as_open() -> None:
    found: set[str] = set()
    for entry in FILES:
        table = tomllib.loads(entry.read_text(encoding="utf-8"))
        ids = {name for claim in table["claim"] for name in cited(claim.get("source", table.get("source")))}
        found |= ids
        assert ids or Path(str(entry)).parent.name not in ("course", "errata"), entry.name
    every = {item.id for item in (*statements(), *errata())}
    known = elsewhere()
    assert set(known.tests) | set(known.open) | set(known.limits) <= every
    assert every - found == set(known.tests) | set(known.open)
    for place in known.tests.values():
        file, _, name = place.partition("::")
        assert not ROOT.joinpath("tests").exists() or f"def {name}(" in ROOT.joinpath(file).read_text(encoding="utf-8")


def test_sources_are_read() -> None:
    assert cited("course 13.35, sec-13.5-g, erratum E47") == ("13.35", "sec-13.5-g", "E47")
    assert cited("course 13.1") == ("13.3",)  # it stands for 13.1 too
    assert cited("Goldstein, eq. 9.14") == cited(None) == ()
