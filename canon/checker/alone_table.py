"""What a kind of claims asks for by `alone_kinds.toml`, as texts about a claim: its formulas with its own names."""

from __future__ import annotations

import re
import tomllib
from itertools import chain, combinations, pairwise, permutations, product
from math import prod
from pathlib import Path
from typing import Any

TABLE = tomllib.loads(Path(__file__).with_name("alone_kinds.toml").read_text(encoding="utf-8"))
LANGUAGE, MOST, LONGEST = {"D": "D", "bracket": "bracket", "with": "_with"}, 500, 200_000
WORD = re.compile(r"(?<!\w)([A-Za-z]+)(?:_([a-z\d]+))?")
UNASKED = {"kind", "title", "source", "expect", "budget"}


def flat(x: Any) -> list[Any]:
    """What is in lists of lists."""
    return [*chain(*map(flat, x))] if isinstance(x, list) else [x]


class Template:
    """A formula of the table; `held` says what its words stand for, `absent` what those that it doesn't say do."""

    def __init__(self, held: Any, absent: Any) -> None:
        self.held, self.absent = held, absent

    def texts(self, row: str) -> list[str]:
        """What it is, for each value of the letters that are free."""
        order, _, text = row.rpartition(": ")
        while m := re.search(rf"({'|'.join(TABLE['macros'])})\[([^][]*)\]", text):
            new = TABLE["macros"][m[1]]
            for n, part in enumerate(m[2].split("; "), 1):
                new = new.replace(f"${n}", part)
            text = text[: m.start()] + new + text[m.end() :]
        bound = {*"".join(re.findall(r"[a-z]+_([a-z]+)\[", text))}
        free = sorted({one for _, run in WORD.findall(text) for one in run if one.isalpha()} - bound)
        ways = [w for w in self.ways(free, text, {}) if all(w[a] < w[b] for a, b in pairwise(order.split("<")))]
        return [self.written(text, way) for way in ways]

    def size(self, letter: str, text: str) -> range:
        """The values of a letter: the lists that it runs along have one length."""
        sizes = set[int]()
        for word, run in WORD.findall(text):
            level = [self.held[word]] if word in self.held and letter in run else []
            for one in run:
                level = [x if isinstance(x, list) else [x] for x in level]
                sizes |= {len(x) for x in level if one == letter}
                level = [y for x in level for y in x]
        if len(sizes) != 1:
            raise ValueError("lists of other lengths")
        return range(*sizes)

    def ways(self, letters: Any, text: str, at: Any) -> list[Any]:
        """All values of some letters, beside those `at` which others are."""
        sizes = [self.size(one, text) for one in letters]
        if prod(map(len, sizes)) > 10 * MOST:
            raise ValueError("lists that are so long")
        return [at | dict(zip(letters, way, strict=True)) for way in product(*sizes)]

    def stands(self, word: str, places: list[int]) -> str:
        """What a word stands for, with these indices."""
        if word in LANGUAGE or word == "one":
            return str(int(len({*places}) == 1)) if word == "one" else LANGUAGE[word]
        if word not in self.held:
            return str(self.absent[word])
        x = self.held[word]
        for n in places:
            x = (x if isinstance(x, list) else [x])[n]
        return "" + x

    def written(self, text: str, at: Any) -> str:
        """The text at these values of its letters."""
        if not (m := re.search(r"([a-z]+)_([a-z]+)\[", text)):
            return WORD.sub(lambda m: self.stands(m[1], [at[n] if n in at else int(n) for n in m[2] or ""]), text)
        depth, end = 1, m.end()
        while depth:
            depth, end = depth + {"[": 1, "]": -1}.get(text[end], 0), end + 1
        op, letters, body = m[1], m[2], text[m.end() : end - 1]
        each = [self.written(body, way) for way in self.ways(letters, body, at)]
        if op == "det":
            n, terms = len(self.size(letters[0], body)), list[str]()
            if len(each) != n * n or n > 5:
                raise ValueError("no determinant, or one that is so large")
            for turn in permutations(range(n)):
                sign = (-1) ** sum(a > b for a, b in combinations(turn, 2))
                terms.append("*".join([f"({sign})", *(f"({each[n * a + b]})" for a, b in enumerate(turn))]))
            each = terms
        new = ", ".join(each) if op == "each" else f"({' + '.join(each)})"
        if len(new) > LONGEST:
            raise ValueError("formulas that are so long")
        return self.written(text[: m.start()], at) + new + self.written(text[end:], at)


def form_of(tables: Any, kinds: Any = TABLE["kinds"]) -> Any:
    """The form of a kind of claims with these keys, beside such a map."""
    claim, explicit = tables["claim"], "".join(sorted(tables.get("transformation", {})))
    given = {"PQ": ("forward", "either"), "pq": ("backward", "either")}.get(explicit, ())
    for form in kinds.get(claim["kind"], ()):
        needed, may = ({*form.get(word, "").split()} for word in ("keys", "may"))
        fixed = all(repr(claim.get(key, value)) == repr(value) for key, value in form.get("fixed", {}).items())
        if needed <= {*claim} - UNASKED <= needed | may and fixed and form.get("map", None) in (None, *given):
            return form
    raise ValueError(f"claims of kind {str(claim['kind'])[:40]} with these keys, or beside this map")
