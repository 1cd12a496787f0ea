"""Kernels and polynomials of a tower as text and tables, for certificates that are read without the deciders."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from canon.decide.fraction_field import Element, FractionField
from canon.decide.ring import Polynomial
from canon.decide.tower import Generator, Tower

_WORD = re.compile(r"\w+")
FUNCTIONS: Mapping[str, str] = {"elliptic_ei": "elliptic_e", "elliptic_pii": "elliptic_pi"}
"""Functions that the tape and the language of formulas name differently."""


class KernelText:
    """The names of a tower's generators: symbols keep theirs, the others are g0, g1, … (other letters if taken).

    **Arguments:** the tower; `taken`, the names that the claim uses.
    """

    def __init__(self, tower: Tower, taken: Iterable[str]) -> None:
        self.tower = tower
        used, letter = set(taken), "g"
        while any(name.startswith(letter) and name[len(letter) :].isdigit() for name in used):
            letter += "_"
        self.names = [
            str(tower.tape.symbol_at(g.data)) if g.kind == "symbol" else f"{letter}{g.index}" for g in tower.generators
        ]

    def table(self, p: Polynomial) -> dict[str, str]:
        """A polynomial as a table monomial = coefficient, such as {"g1^2": "1", "x^2": "-1"}."""
        ring, found = self.tower.ring, {}
        for monomial, coefficient in ring.terms(p).items():
            powers = (name if e == 1 else f"{name}^{e}" for name, e in zip(self.names, monomial, strict=False) if e)
            found[" ".join(powers)] = str(coefficient)
        return found

    def formula(self, p: Polynomial) -> str:
        """A polynomial as a formula."""
        terms = []
        for monomial, coefficient in self.tower.ring.terms(p).items():
            factors = [name if e == 1 else f"{name}**{e}" for name, e in zip(self.names, monomial, strict=False) if e]
            if coefficient != 1 or not factors:
                factors.insert(
                    0, f"({coefficient})" if coefficient < 0 or coefficient.denominator > 1 else str(coefficient)
                )
            terms.append("*".join(factors))
        return " + ".join(terms) or "0"

    def fraction(self, x: Element) -> str:
        """An element as a formula."""
        under = "*".join(f"({self.formula(self.tower.field.factors[k])})**{e}" for k, e in x[1].items())
        return f"({self.formula(x[0])})/({under})" if under else self.formula(x[0])

    def kernels(self, data: Any) -> list[dict[str, Any]]:
        """The generators, symbols left out, that occur in `data` or in what these stand for or are related to.

        Each with its name, what it stands for in terms of those before, its sign and its relation.
        """
        made, used = [], set(_WORD.findall(str(data)))
        for g in reversed(self.tower.generators):
            if g.kind not in ("symbol", "full") and self.names[g.index] in used:
                entry: dict[str, Any] = {"name": self.names[g.index], "stands for": self._meaning(g), "sign": g.sign}
                if g.degree:
                    power = self.tower.ring.generators[g.index] ** g.degree
                    entry["relation"] = self.table(power - g.lower)
                used.update(_WORD.findall(str(entry)))
                made.append(entry)
        return made[::-1]

    def _meaning(self, g: Generator) -> str:
        kind, data = g.kind, g.data
        if kind in ("pi", "I"):
            return "pi" if kind == "pi" else "1j"
        if kind in ("cos", "sin", "exp"):
            return f"{kind}({self.fraction(data)})"
        if kind.endswith("of pi/n"):
            return f"{kind[:3]}(pi/{data})"
        if kind == "log":
            inner = self.formula(data[1])
            return f"log({inner})" if len(data) == 2 else f"log(({inner})/({self.formula(data[2])}))"
        if kind == "root" and data[0] == "chain":
            return f"({self.formula(data[1])})**(1/{data[2] ** data[3]})"
        if kind == "root":
            over, under = self.formula(data[1]), self.formula(data[2])
            return f"({under})*(({over})/({under}))**(1/{data[3]})"
        if kind == "abs":
            return f"abs({self.formula(data)})"
        if kind == "arbitrary":
            name, orders, arguments = data
            counts = f"{list(orders)}" if any(orders) else ""
            return f"{name}{counts}({', '.join(self.fraction(x) for x in arguments)})"
        if kind == "integer_power":
            return f"({self.fraction(data[0])})**({self.fraction(data[1])})"
        if kind == "jacobi_dn over":
            u, m, under = (self.fraction(x) for x in data)
            return f"({under})*jacobi_dn({u}, {m})"
        return f"{FUNCTIONS.get(kind, kind)}({', '.join(self.fraction(x) for x in data)})"


def cofactors(
    field: FractionField, numerator: Polynomial, surface: Sequence[Polynomial] = ()
) -> dict[int, Polynomial] | None:
    """{k: c}: numerator = Σ c · (relation of generator k) + Σ c · (equation −k of a surface). None if none is found.

    Every relation is monic in its own generator, and the order of the ring is lexicographic with the top first, so that
    one division by each, from the top down, gives the normal form; a surface's equations are divided by one by one.
    """
    found: dict[int, Polynomial] = {}
    relations = [(generator, relation) for generator, _, _, relation in reversed(field.relations)]
    for k, relation in [*relations, *((-k, p) for k, p in enumerate(surface, 1))]:
        if not numerator or not relation:
            continue
        field.ring.charge(len(numerator) * len(relation))
        quotient, numerator = divmod(numerator, relation)
        if quotient:
            found[k] = quotient
    return None if numerator else found


def free_of(tower: Tower, x: Element, field: FractionField) -> Element:
    """The element in a field of fractions of the same ring that knows no relations."""
    return x[0], {field.factor_number(tower.field.factors[k]): e for k, e in x[1].items()}


def denominator_of(field: FractionField, x: Element) -> Polynomial:
    """The denominator multiplied out."""
    total = field.ring.one
    for k, e in x[1].items():
        total = field.ring.times(total, field.ring.power(field.factors[k], e))
    return total
