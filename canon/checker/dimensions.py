"""What claims about dimensions ask for: exponents of basic quantities, followed through each formula exactly."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from canon.checker.case import Case
from canon.checker.defined import assumed, shared
from canon.checker.formulas import Formulas
from canon.checker.functions import Unknown, Unreadable
from canon.checker.points import domain_of
from canon.checker.statement import Statement

Dimension = dict[str, Fraction]
SAME = ("abs", "sqrt")
FREE = ("sign", "atan2")
"""Functions of dimensioned arguments whose value is a number."""


class Mixed(ValueError):
    """A sum of different dimensions, or a function of something that is no number."""


def dimension(s: Statement) -> Case:
    """Each of the functions has the dimension that is stated; names that are left out are numbers."""
    claim, f = s.claim, s.f
    table: dict[str, Any] = dict(claim["dimensions"])
    names = {name: _read(text) for name, text in table.items() if isinstance(text, str)}
    functions = {
        name: (_read(rows[0]), [_read(x) for x in rows[1:]]) for name, rows in table.items() if isinstance(rows, list)
    }
    if unknown := {*table} - s.declared - {s.time}:
        raise Unreadable(f"{min(unknown)[:40]!r} is not declared")
    if whole := {*table} & s.fixed:
        raise Unreadable(f"{min(whole)[:40]!r} is an integer: it has no units")
    wanted, values = _read(claim["equals"]), s.keys("functions")
    claim.get("base")  # what quantities are called says nothing of what they are made of
    if s.verdict == "refuted":
        if functions:
            raise Unknown("a dimension that is refuted, of functions that have one")
        return Case(_scaled(s, values, names, wanted))
    try:
        found = all(_of(f, a, names, functions) == wanted for a in values)
    except Mixed:
        found = False
    if not found:  # x - x + 1 is a number too: what isn't seen here may be so
        raise Unknown("a dimension that doesn't follow step by step")
    return Case([], found=True)


def _scaled(s: Statement, values: list[int], names: Mapping[str, Dimension], wanted: Dimension) -> list[int]:
    """f of names that are multiplied by the units' scales, less the scale of the dimension times f.

    Both are to be in the domain: the value in other units may be one of another part of it.
    """
    f = s.f
    units = sorted({unit for dimension in (*names.values(), wanted) for unit in dimension})
    s.words |= {f"#{unit}": ["positive"] for unit in units}

    def scale(dimension: Dimension) -> int:
        return f.mul(*(f.power(f.node("s", f"#{unit}"), f.number(e)) for unit, e in dimension.items()))

    images = {name: f.mul(scale(dimension), f.node("s", name)) for name, dimension in names.items()}
    own = {*s.Q, *s.P} if s.direction == "forward" else {*s.q, *s.p} if s.direction != "none" else set[str]()
    if any(f.ops[b][0] == "s" and f.ops[b][1] in own for b in f.reach(*values)):
        raise Unknown("a dimension that is refuted, of variables that the map gives by others")
    s.written += [f.substitute(a, images) for a in (*domain_of(s), *shared(s))]
    assumptions = [(a, "nonzero" if word == "nonzero" else "positive") for a, word in assumed(s)]
    s.conditions = [*s.conditions, *((f.substitute(a, images), kind) for a, kind in (*s.conditions, *assumptions))]
    s.surface = [*s.surface, *(f.substitute(a, images) for a in s.surface)]
    return [f.sub(f.substitute(a, images), f.mul(scale(wanted), a)) for a in values]


def _read(text: Any) -> Dimension:
    """The exponents of "M*L**2/T**2"; of "1" there are none."""
    f = Formulas()
    target = f.read(text, {})
    for a in f.reach(target):
        if f.ops[a][0] == "+" or (f.ops[a][0] == "*" and any(f.ops[b][0] == "n" for b in f.parts(a))):
            raise Unreadable(f"a product of powers is expected, not {str(text)[:40]!r}")
    return _of(f, target, None, {})


def _of(
    f: Formulas,
    target: int,
    names: Mapping[str, Dimension] | None,
    functions: Mapping[str, tuple[Dimension, list[Dimension]]],
) -> Dimension:
    """The dimension of a formula; without `names` each name stands for itself. Raises Mixed."""
    out: dict[int, Dimension] = {}
    for a in f.reach(target):
        op, x = f.ops[a], [out[b] for b in f.parts(a)]
        if op[0] == "n":
            out[a] = {}
        elif op[0] == "s":
            out[a] = {op[1]: Fraction(1)} if names is None else names.get(op[1], {})
        elif op[0] == "+":
            nothing = [f.value(b) == 0 for b in f.parts(a)]
            if x[0] != x[1] and not any(nothing):
                raise Mixed
            out[a] = x[1] if nothing[0] else x[0]
        elif op[0] == "*":
            out[a] = _product(x[0], x[1], Fraction(1))
        elif op[0] == "^":
            out[a] = _product({}, x[0], Fraction(op[2]))
        elif op[1] == "power":
            exponent = f.value(op[3][1])
            if exponent is None and (x[0] or x[1]):
                raise Mixed
            out[a] = {} if exponent is None else _product({}, x[0], exponent)
        elif op[1] in functions:
            value, arguments = functions[op[1]]
            if x != arguments:
                raise Mixed
            for argument, order in zip(arguments, op[2], strict=True):  # a derivative is divided by its arguments
                value = _product(value, argument, Fraction(-order))
            out[a] = value
        elif op[1] in SAME:
            out[a] = x[0]
        else:
            if (any(x) and op[1] not in FREE) or (op[1] == "atan2" and x[0] != x[1]):
                raise Mixed
            out[a] = {}
    return out[target]


def _product(a: Dimension, b: Dimension, exponent: Fraction) -> Dimension:
    total = {**a}
    for name, e in b.items():
        total[name] = total.get(name, Fraction(0)) + e * exponent
    return {name: e for name, e in total.items() if e}
