"""A claim with one change of which nobody knows what it does, and what mpmath says of it at points of its domain."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import combinations
from typing import Any, Final

import mpmath as mp

from canon.syntax import Call, Name, Node, Number, Power, Product, Sum, parse, parse_relation
from properties.metamorphic.parts import nodes, words_of
from properties.metamorphic.tables import Tables, in_nodes, mapped, replaced, shown
from properties.soundness import oracle
from properties.soundness.formula import DIGITS, FUNCTIONS, Formula, Outside, call, names, of, value, variable

POINTS: Final = 60
SEEN: Final = 4
"""The fewest points of the domain at which a claim has been looked at."""
OTHER: Final = {
    "sin": "cos", "cos": "sin", "tan": "sin", "exp": "sinh", "sinh": "cosh", "cosh": "sinh", "log": "atan",
    "sqrt": "atan", "atan": "tanh", "tanh": "atan", "acos": "asin", "asin": "acos", "abs": "sqrt",
}  # fmt: skip
UNDEFINED: Final = (Outside, ZeroDivisionError, OverflowError, ValueError)


class Untold(Exception):
    """A claim of which nothing is said here."""


def spoiled(rng: random.Random, tables: Tables) -> Tables | None:
    """One coefficient, sign, exponent or function changed."""
    count = len(nodes(tables, lambda node: True))
    if not count:
        return None
    place, seen = rng.randrange(count), -1

    def told(node: Node) -> Node:
        nonlocal seen
        seen += 1
        if seen != place:
            return node
        text = f"({shown(node)})"
        if isinstance(node, Number):
            return parse(rng.choice((f"{text}*1001/1000", f"({text}+1)", f"-{text}")))
        if isinstance(node, Call) and node.name in OTHER and rng.random() < 0.5:
            return Call(node.span, OTHER[node.name], node.arguments)
        return parse(
            rng.choice((f"{text}*1001/1000", f"-{text}", f"{text}**2", f"{text}*(1+10**(-9))", f"{text}+1/1000"))
        )

    return mapped(tables, lambda text: in_nodes(text, lambda node: replaced(node, told)))


class _Read:
    """The formulas of a file, definitions and the map put in."""

    def __init__(self, tables: Tables) -> None:
        space, self.known = tables.get("phase_space", {}), dict[str, Formula]()
        self.pairs = [*zip(space.get("q", ()), space.get("p", ()), strict=True)]
        self.symbols = tables.get("symbols", {})
        self.functions = {name for name in self.symbols if "function" in words_of(tables, name)}
        if self.functions & {*FUNCTIONS, "D", "bracket"}:
            raise Untold("a function by the name of another")
        given = tables.get("transformation", {})
        sides = ("q", "p", "Q", "P") if "q" in given else ("Q", "P", "q", "p")
        for name, text in tables.get("definitions", {}).items():
            self.known[name] = self.formula(str(text))
        self.rows = [self.formula(str(row)) for word in sides[:2] for row in given.get(word, ())]
        self.images = dict(zip((n for word in sides[:2] for n in space.get(word, ())), self.rows, strict=bool(given)))
        self.variables = [name for word in sides[2:] for name in space.get(word, ())]

    def formula(self, text: str) -> Formula:
        """A formula of the names that vary."""
        return self.tree(parse(text))

    def tree(self, node: Node) -> Formula:
        """A tree of the reader's as one of those that mpmath evaluates."""
        if isinstance(node, Number):
            return of(node.value) * variable("1j") if node.imaginary else of(node.value)
        if isinstance(node, Name):
            return self.known.get(node.name) or variable(node.name)
        if isinstance(node, Sum):
            first, *rest = (
                self.tree(part) * (1 if up else -1) for part, up in zip(node.terms, node.added, strict=True)
            )
            return sum(rest, first)
        if isinstance(node, Product):
            found = of(1)
            for part, up in zip(node.factors, node.multiplied, strict=True):
                found = found * self.tree(part) if up else found / self.tree(part)
            return found
        if isinstance(node, Power):
            return self.tree(node.base) ** self.tree(node.exponent)
        if node.name == "bracket":
            f, g = map(self.tree, node.arguments)
            return bracket(f, g, self.pairs)
        if node.name == "D":
            f, order = self.tree(node.arguments[0]), node.arguments[2:]
            if order and not isinstance(order[0], Number):
                raise Untold("a derivative of any order")
            for _ in range(int(order[0].value) if order and isinstance(order[0], Number) else 1):
                f = call("D", f, self.tree(node.arguments[1]))
            return f
        if node.name not in FUNCTIONS and node.name not in self.functions:
            raise Untold(node.name)
        if any(len(words) > 1 for words in [self.symbols.get(node.name, "")] if isinstance(words, list)):
            raise Untold("a function with a sign")
        return call(node.name, *map(self.tree, node.arguments))


def bracket(f: Formula, g: Formula, pairs: list[tuple[str, str]]) -> Formula:
    """Poisson's bracket, by differences."""
    found = of(0)
    for q, p in pairs:
        dq, dp = variable(q), variable(p)
        found = found + call("D", f, dq) * call("D", g, dp) - call("D", f, dp) * call("D", g, dq)
    return found


def equations(tables: Tables) -> tuple[_Read, list[tuple[Formula, Formula]]]:
    """What a claim says, as equations; **raises** `Untold` of other kinds."""
    claim, space = tables["claim"][0], tables.get("phase_space", {})
    if {"tensor", "structure", "order", "scale"} & {*claim} or "on" in tables.get("domain", {}) or not space:
        raise Untold("a tensor, an order, a surface")
    if "generating_function" in tables and "transformation" not in tables:
        raise Untold("a generating function")
    read, kind = _Read(tables), claim["kind"]
    H = read.formula(str(tables["hamiltonian"]["H"])) if "hamiltonian" in tables else of(0)
    zero = of(0)
    if kind in ("identity", "bracket", "jacobi", "conserved", "involution"):
        f = {word: read.formula(str(claim[word])) for word in claim if word not in ("kind", "source", "functions")}
        if kind == "identity":
            return read, [(f["lhs"], f["rhs"])]
        if kind == "bracket":
            return read, [(bracket(f["f"], f["g"], read.pairs), f["equals"])]
        if kind == "conserved":
            t = variable(space.get("time", "t"))
            return read, [(bracket(f["f"], H, read.pairs), -call("D", f["f"], t))]
        if kind == "jacobi":
            a, b, c = f["f"], f["g"], f["h"]
            parts = [bracket(u, bracket(v, w, read.pairs), read.pairs) for u, v, w in ((a, b, c), (b, c, a), (c, a, b))]
            return read, [(parts[0] + parts[1], -parts[2])]
        functions = [read.formula(str(text)) for text in claim["functions"]]
        return read, [(bracket(g, h, read.pairs), zero) for g, h in combinations(functions, 2)]
    if kind in ("canonical", "fundamental_brackets") and len(read.rows) == len(read.variables):
        half = len(read.rows) // 2
        pairs = [*zip(read.variables[:half], read.variables[half:], strict=True)]
        return read, [
            (bracket(read.rows[i], read.rows[j], pairs), of(int(j == i + half)))
            for i, j in combinations(range(2 * half), 2)
        ]
    if kind in ("equations_of_motion", "infinitesimal"):
        G = H if kind == "equations_of_motion" else read.formula(str(claim["generator"]))
        rows = zip(*(claim[word] for word in (("qdot", "pdot") if "qdot" in claim else ("dq", "dp"))), strict=True)
        found = list[tuple[Formula, Formula]]()
        for (q, p), (dq, dp) in zip(read.pairs, rows, strict=True):
            found += [
                (call("D", G, variable(p)), read.formula(str(dq))),
                (call("D", G, variable(q)), -read.formula(str(dp))),
            ]
        return read, found
    raise Untold(kind)


def _points(rng: random.Random, tables: Tables, read: _Read, used: list[str]) -> Iterator[dict[str, Any]]:
    """Points of the domain, with old and new variables."""
    words = {name: words_of(tables, name) for name in used}
    if any("complex" in given for given in words.values()):
        raise Untold("a complex name")
    box = dict[str, tuple[Fraction | None, Fraction | None]]()
    for name, given in words.items():
        low = Fraction(0) if {"positive", "nonnegative"} & {*given} else None
        box[name] = (low, Fraction(0) if "negative" in given else None)
    where = [parse_relation(text) for text in tables.get("domain", {}).get("where", ())]
    integers = [name for name, given in words.items() if "integer" in given]
    for point in oracle.points(rng, used, box, POINTS, integers):
        try:
            for name, image in read.images.items():
                point[name] = value(image, point)
            if all(_holds(sides, signs, read, point) for sides, signs in where):
                yield point
        except UNDEFINED:
            continue


def _holds(sides: tuple[Node, ...], signs: tuple[str, ...], read: _Read, point: Mapping[str, Any]) -> bool:
    values = [value(read.tree(side), point) for side in sides]
    return all(
        a < b if sign[0] == "<" else a > b if sign[0] == ">" else a != b
        for a, b, sign in zip(values[:-1], values[1:], signs, strict=True)
    )


def _apart(left: Any, right: Any) -> bool:
    """Whether values differ by more than differences in place of derivatives explain."""
    return bool(abs(left - right) > oracle.NOISE * (1 + abs(left) + abs(right)))


def is_true(rng: random.Random, tables: Tables) -> bool | None:
    """False if the claim fails at a point of its domain, True if it holds at a few, None where nothing is known."""
    seen = 0
    try:
        read, claimed = equations(tables)
        used = {name for sides in claimed for side in sides for name in names(side)} | {*read.variables}
        used |= {name for sides in tables.get("domain", {}).get("where", ()) for side in parse_relation(sides)[0]
                 for name in names(read.tree(side))} - {"pi", "1j"}  # fmt: skip
        with mp.workdps(2 * DIGITS):
            for point in _points(rng, tables, read, sorted(used - {*read.images} - {"pi", "1j"})):
                try:
                    if any(_apart(value(lhs, point), value(rhs, point)) for lhs, rhs in claimed):
                        return False
                    seen += 1
                except (*UNDEFINED, KeyError):
                    continue
    except (Untold, KeyError):
        return None
    return True if seen >= SEEN else None
