"""Concrete functions in place of arbitrary ones, so that a refutation names the function that it chose.

An arbitrary smooth function is replaced by a sum of powers of affine forms with rational coefficients:
defined and smooth everywhere, with derivatives in closed form, and generic enough to have independent jets.
"""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

import flint

from canon.decide.tape import Node, Tape


@dataclass(frozen=True)
class ChosenFunction:
    """f(a) = Σ coefficient · (shift + Σ slope_i a_i) ** power, with rational data."""

    terms: tuple[tuple[Fraction, Fraction, tuple[Fraction, ...], int], ...]

    def derivative_at(self, orders: Sequence[int], arguments: Sequence[Any]) -> Any:
        """The partial derivative of these orders, at arguments given as balls."""
        total: Any = flint.arb(0)
        drop = sum(orders)
        for coefficient, shift, slopes, power in self._rationals:
            if drop > power:
                continue
            factor = coefficient * math.perm(power, drop)
            for slope, order in zip(slopes, orders, strict=True):
                if order:
                    factor = factor * slope**order
            if not factor:
                continue
            form: Any = shift
            for slope, argument in zip(slopes, arguments, strict=True):
                form = form + slope * argument
            total = total + factor * form ** (power - drop)
        return total

    @cached_property
    def _rationals(self) -> list[tuple[Any, Any, list[Any], int]]:
        return [(rational(c), rational(shift), [rational(s) for s in slopes], k) for c, shift, slopes, k in self.terms]

    def formula(self) -> str:
        """The function as text in a1, a2, … (one argument: a)."""
        arity = len(self.terms[0][2])
        names = ["a"] if arity == 1 else [f"a{k + 1}" for k in range(arity)]
        parts = []
        for coefficient, shift, slopes, power in self.terms:
            form = " + ".join([f"{s}*{n}" for s, n in zip(slopes, names, strict=True) if s] + [str(shift)])
            parts.append(f"({coefficient})*({form})**{power}")
        return " + ".join(parts)


def rational(value: Fraction) -> Any:
    """The flint rational of a Fraction."""
    return flint.fmpq(value.numerator, value.denominator)


def choose_functions(tape: Tape, nodes: Sequence[Node], rng: random.Random) -> dict[str, ChosenFunction]:
    """A concrete function for every arbitrary function in the nodes."""
    needs: dict[str, tuple[int, int]] = {}
    for node in nodes:
        op = tape.ops[node]
        if op[0] == "u":
            _, order = needs.get(op[1], (0, 0))
            needs[op[1]] = (len(op[2]), max(order, sum(op[2])))
    chosen = {}
    for name, (arity, order) in sorted(needs.items()):
        terms = []
        for k in range(3 + min(arity, 4)):
            slopes = tuple(Fraction(rng.choice((-2, -1, 1, 2, 3)), rng.choice((1, 1, 2))) for _ in range(arity))
            coefficient = Fraction(rng.choice((-3, -2, -1, 1, 2, 3, 5)), rng.choice((2, 3, 5, 7)))
            terms.append((coefficient, Fraction(rng.randrange(-3, 4)), slopes, max(order, 1) + k % 3))
        chosen[name] = ChosenFunction(tuple(terms))
    return chosen
