"""The texts of a claim about a map, its names, and other claims that are made of them: for `alone_forward.py` and
`alone_tori.py`.

A text isn't read here: names are put in the place of names, and what is asked of the texts that come of it is a claim
of its own, which another small file shows. That the domain has a point is seen in intervals.
"""

from __future__ import annotations

import re
from contextlib import suppress
from itertools import pairwise
from typing import Any

if __package__:
    from canon.checker import alone, alone_somewhere, counterexample
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_somewhere  # type: ignore
    import counterexample  # type: ignore

Stop, RANDOM, SEARCHED = alone.Stop, alone.RANDOM, 400
CALLED = {"sin", "cos", "exp", "sqrt", "asin", "atan", "atan2", "log", "elliptic_k", "elliptic_e", "elliptic_f"}
NAME, SIGN = re.compile(r"(?<![\w.])[^\W\d]\w*"), re.compile(r"(<=|>=|!=|<|>)")
WORDS = {"real", "positive", "negative"}


class Texts:
    """What a file says in formulas, and the names in them."""

    def __init__(self, tables: Any) -> None:
        space = tables["phase_space"]
        self.tables, self.time = tables, space.get("time", "t")
        self.new = {*space["Q"], *space["P"]}
        self.symbols, self.definitions = tables.get("symbols", {}), tables.get("definitions", {})
        self.H, self.where = str(tables["hamiltonian"]["H"]), [*tables.get("domain", {}).get("where", [])]
        self.found = dict[str, set[str]]()

    def words(self, name: str) -> set[str]:
        """What is said of a name, besides that it is real."""
        said = self.symbols.get(name, [])
        return {*([said] if isinstance(said, str) else said)} - {"real"}

    def check_names(self, old: list[str], plain: Any, made: Any) -> None:
        """See that each name has one meaning, that nothing is said of `plain` ones, and none is `made` here."""
        held = [*old, *self.new, self.time]
        given = [*held, *self.definitions, "pi"]
        if len({*given}) != len(given) or {*self.definitions} & {*self.symbols} or {"pi", self.time} & {*self.symbols}:
            raise Stop("not shown", "names with two meanings")
        odd = any(self.words(name) - WORDS or len(self.words(name)) > 1 for name in self.symbols)
        if odd or any(map(self.words, plain)):
            raise Stop("not shown", "names with such words")
        if any(len(SIGN.split(text)) < 3 for text in self.where):
            raise Stop("not shown", "conditions that compare nothing")
        named = {*NAME.findall(alone.formulas(self.tables))} | {*given} | {*self.symbols}
        if any(map(made, named)) or CALLED & {*given, *self.symbols}:
            raise Stop("not shown", "names that are made here")

    def names(self, text: str, depth: int = 0) -> set[str]:
        """The names in a text, of what definitions say."""
        if text not in self.found:
            self.found[text] = self.searched(text, depth)
        return {*self.found[text]}

    def searched(self, text: str, depth: int) -> set[str]:
        if depth > len(self.definitions):
            raise Stop("not shown", "definitions of themselves")
        called = {*re.findall(r"([^\W\d]\w*)\s*\(", text)}
        found = {*NAME.findall(text)} - called
        if called - CALLED or found & CALLED:
            raise Stop("not shown", "other functions, or derivatives")
        for name in sorted(found & {*self.definitions}):
            found |= self.names(str(self.definitions[name]), depth + 1)
        return found

    def has_point(self, claim: Any, free: Any, made: dict[str, str], texts: Any) -> bool:
        """Whether a point of the domain is found, for values of the `free` names, at which all texts have values.

        What is `made` of them has the signs that are said of its names.
        """
        for _ in range(SEARCHED):
            at = dict[str, Any]()
            for name in sorted(free):
                sign = -1 if "negative" in self.words(name) else 1 if self.words(name) else RANDOM.choice((1, -1))
                at[name] = (sign * RANDOM.choice(alone_somewhere.SIZES),) * 2
            with suppress(counterexample.Open, ZeroDivisionError):
                point = Point(claim, at, alone_somewhere.REAL)
                plain = counterexample.Point(claim, at, alone_somewhere.REAL)
                for words in map(SIGN.split, self.where):
                    for (a, b), sign in zip(pairwise(words[::2]), words[1::2], strict=True):
                        a, b = (a, b) if "<" in sign else (b, a)
                        kind = ["nonzero" if sign == "!=" else "positive"]
                        counterexample.check(plain.text(f"({b}) - ({a})"), kind)
                for text in (*made.values(), *texts):
                    point.text(text)
                for name, text in made.items():
                    if word := self.words(name):
                        counterexample.check(plain.text(text), [*word])
                return True
        return False


def written(f: Any) -> str:
    """A formula as a text."""
    if f.kind in "#.":
        return f"({f.of[0]})"
    each = [written(x) for x in f.of]
    if f.kind in "+*^":
        return f"({each[0]} {'**' if f.kind == '^' else f.kind} {each[1]})"
    return f"{f.kind.partition('/')[0]}({', '.join(each)})"


class Point(counterexample.Point):
    """A point in intervals, where elliptic integrals have values that aren't looked at."""

    def value(self, f: Any) -> Any:
        if not f.kind.startswith("elliptic"):
            return super().value(f)
        if [self.at(x) for x in f.of][-1][1] >= 1:
            raise counterexample.Open("an elliptic integral's value")
        return counterexample.ONE


def asked(file: Any, tables: Any) -> bool:
    """Whether a file shows a claim that is made here."""
    data = {"tables": tables, "known": {}, "cases": [{}]}
    with suppress(Stop, ValueError, ArithmeticError, KeyError):
        return file.shown(data)[0] == "shown"
    return False
