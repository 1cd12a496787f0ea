"""A residual as a fraction of polynomials, for Coq: what its denominators are made of, and its identity."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Any, Final

from canon.budget import Budget
from canon.checker.formulas import Formulas
from canon.decide.fraction_field import Element, FractionField
from canon.decide.ring import Polynomial, Ring

LIMIT: Final = 2e7
SECONDS: Final = 20.0
Table = Mapping[str, str]


class Fractions:
    """Fractions in names and kernels as free variables; denominators as products of irreducible factors.

    **Arguments:** the checker's formulas; all names; `atoms`, the value of each name and function in the residual as
    [numerator, denominator]; `relations`, (kernel, n, rest) for g ^ n = rest, by which numerators are reduced.
    """

    def __init__(
        self,
        f: Formulas,
        names: Sequence[str],
        atoms: Mapping[int, Sequence[Table]],
        relations: Iterable[tuple[str, int, Table]] = (),
    ) -> None:
        self.f, self.names = f, list(names)
        self.ring = Ring(max(len(self.names), 1), LIMIT, Budget(SECONDS))
        self.field = FractionField(self.ring)
        for name, degree, rest in relations:
            self.field.relate(self.names.index(name), degree, self.polynomial(rest))
        self.values: dict[int, Element] = {}
        self.bases: list[Element] = []
        self.divisors: list[int] = []
        for a, (over, under) in atoms.items():
            bottom = (self.polynomial(under), {})
            self.bases.append(bottom)
            self.values[a] = self.field.product([(self.polynomial(over), {}), self.field.inverse(bottom)])

    def polynomial(self, table: Table) -> Polynomial:
        """The polynomial of a table."""
        terms: dict[tuple[int, ...], Fraction] = {}
        for monomial, coefficient in table.items():
            exponents = [0] * self.ring.size
            for factor in monomial.split():
                name, _, exponent = factor.partition("^")
                exponents[self.names.index(name)] += int(exponent or 1)
            terms[tuple(exponents)] = Fraction(coefficient)
        return self.ring.polynomial(terms)

    def table(self, p: Polynomial) -> dict[str, str]:
        """A polynomial as a table."""
        found = {}
        for monomial, c in self.ring.terms(p).items():
            factors = (n if e == 1 else f"{n}^{e}" for n, e in zip(self.names, monomial, strict=False) if e)
            found[" ".join(factors)] = str(c)
        return found

    def value(self, target: int) -> Element:
        """The value of a formula; on the way, the nodes that it divides by are kept in `divisors`."""
        out = self.values
        for a in self.f.rational([target])[0]:
            op, parts = self.f.ops[a], [out[b] for b in self.f.parts(a)] if a not in out else []
            if a in out:
                continue
            if op[0] == "n":
                out[a] = self.field.constant(op[1])
            elif op[0] == "^":
                self.divisors += self.f.parts(a) if op[2] < 0 else ()
                out[a] = self.field.power(parts[0], op[2])
            else:
                out[a] = (
                    self.field.combine([(Fraction(1), x) for x in parts]) if op[0] == "+" else self.field.product(parts)
                )
        return out[target]

    def products(self) -> list[tuple[Fraction, dict[int, int]]]:
        """The numerator of everything that is divided by, as constant · Π factor ** exponent."""
        bases = [*self.bases, *(self.values[a] for a in self.divisors)]
        return [self.field.split_denominator(base[0]) for base in bases]

    def name_of(self, k: int) -> str | None:
        """The name that the k-th factor is, if it is one."""
        ((monomial, coefficient), *more) = self.table(self.field.factors[k]).items()
        return monomial if not more and coefficient == "1" and monomial in self.names else None


def scaled(table: Table, factor: Fraction) -> dict[str, Any]:
    """A polynomial times a number."""
    return {monomial: str(Fraction(c) * factor) for monomial, c in table.items()}
