"""The region in which a claim is made, loaded on the tape."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction

import sympy as sp
from flint import acb, arb

from canon.decide.enclosure import Ball, certainly_positive, excludes_zero, off_the_slit
from canon.decide.tape import Node, Tape
from canon.domain import Domain
from canon.sign import declared


@dataclass(frozen=True)
class Requirement:
    """One condition of the region: its kind (canon.domain.Condition), its nodes, and what says it in words."""

    kind: str
    nodes: tuple[Node, ...]
    said: object
    note: str = ""

    @property
    def text(self) -> str:
        """The condition in words, printed when somebody asks."""
        return f"{self.said}{self.note}"

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True)
class Region:
    """Requirements that hold throughout, surface equations, and the symbols with their assumptions."""

    requirements: tuple[Requirement, ...]
    surface: tuple[Node, ...]
    symbols: tuple[Node, ...]

    @staticmethod
    def of(tape: Tape, domain: Domain, symbols: Iterable[sp.Symbol] = ()) -> Region:
        """The region of a domain; `symbols` are those that a witness names beyond the ones that occur."""
        requirements = []
        seen = set()
        for condition in domain.conditions:
            nodes = tuple(tape.load(term) for term in condition.terms)
            key = (condition.kind, nodes)
            if key in seen or _evident(tape, condition.kind, nodes):
                continue
            seen.add(key)
            requirements.append(Requirement(condition.kind, nodes, condition))
        surface = tuple(tape.load(equation) for equation in domain.surface)
        named = {tape.symbol(symbol) for symbol in symbols}
        return Region(tuple(requirements), surface, tuple(sorted(named)))

    def also(self, *requirements: Requirement) -> Region:
        """This region with further requirements."""
        return Region(self.requirements + requirements, self.surface, self.symbols)

    def nodes(self) -> list[Node]:
        """Every node that membership in the region is read from."""
        return [node for requirement in self.requirements for node in requirement.nodes] + list(self.surface)


def _evident(tape: Tape, kind: str, nodes: tuple[Node, ...]) -> bool:
    """A condition on rational numbers that holds."""
    values = [tape.value(node) for node in nodes]
    if any(value is None for value in values):
        return False
    if kind in ("positive", "slit"):
        return values[0] is not None and values[0] > 0
    return kind == "nonzero" and values[0] != 0


def holds(requirement: Requirement, balls: Mapping[Node, Ball]) -> bool:
    """True when the requirement is certified at the point whose balls these are."""
    first = balls[requirement.nodes[0]]
    kind = requirement.kind
    if kind == "positive":
        return certainly_positive(first)
    if kind == "nonzero":
        return excludes_zero(first)
    if kind == "uncut":
        x = balls[requirement.nodes[1]]
        return isinstance(first, arb) and isinstance(x, arb) and (excludes_zero(first) or certainly_positive(x))
    if kind == "slit":
        return off_the_slit(first)
    return first.is_finite()


def admits(symbol: sp.Symbol, ball: Ball) -> bool:
    """True when the ball certainly satisfies the symbol's assumptions."""
    facts = declared(symbol)
    if facts.get("real") and isinstance(ball, acb):
        return False
    if facts.get("integer") and not (ball.is_exact() and ball.is_integer()):
        return False
    if facts.get("rational") and not facts.get("integer") and not ball.is_exact():
        return False
    if facts.get("positive") and not ball > 0:
        return False
    if facts.get("negative") and not ball < 0:
        return False
    if facts.get("nonnegative") and not facts.get("positive") and not ball >= 0:
        return False
    if facts.get("nonpositive") and not facts.get("negative") and not ball <= 0:
        return False
    return not (facts.get("nonzero") and not facts.get("positive") and not facts.get("negative") and ball.contains(0))


def bounds(tape: Tape, region: Region) -> dict[Node, tuple[float, float]]:
    """Open intervals that requirements affine in one symbol alone put on it (rounded outward: a guide for sampling)."""
    out: dict[Node, tuple[float, float]] = {}
    for requirement in region.requirements:
        if requirement.kind != "positive":
            continue
        try:
            form = affine(tape, requirement.nodes[0])
            if form is None:
                continue
            constant, slope, symbol = form
            edge = -constant / float(slope)
        except (OverflowError, ZeroDivisionError):  # beyond double precision
            continue
        low, high = out.get(symbol, (-float("inf"), float("inf")))
        out[symbol] = (max(low, edge), high) if slope > 0 else (low, min(high, edge))
    return out


def affine(tape: Tape, node: Node) -> tuple[float, Fraction, Node] | None:
    """(constant, slope, symbol) of constant + slope·symbol, constants in Q + Q·pi; None for any other node."""
    op = tape.ops[node]
    if op[0] == "s":
        return 0.0, Fraction(1), node
    if op[0] != "+":
        return None
    constant, slope, symbol = float(op[1]), None, None
    for inner, coefficient in op[2]:
        kind = tape.ops[inner]
        if kind == ("c", "pi"):
            constant += float(coefficient) * 3.141592653589793
        elif kind[0] == "s" and symbol is None:
            slope, symbol = coefficient, inner
        else:
            return None
    return None if symbol is None or slope is None else (constant, slope, symbol)
