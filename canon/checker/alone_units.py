"""Dimensions, step by step: `python alone_units.py CERTIFICATE.json …`

A product has the product of the dimensions, a power its power, a derivative that of the function over that of the name,
and a declared function the one that is stated, of arguments with those that are stated. Terms of a sum have the same
one, and what stands in an exponent, an angle or a logarithm has none. So each formula is multiplied by the units'
scales.
"""

from __future__ import annotations

import ast
from fractions import Fraction
from itertools import chain
from typing import Any

if __package__:
    from canon.checker import alone, alone_wider
    from canon.checker.alone_regular import itself
    from canon.checker.counterexample_formulas import is_nought
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_wider  # type: ignore
    from alone_regular import itself  # type: ignore
    from counterexample_formulas import is_nought  # type: ignore

Stop, LONGEST = alone.Stop, 200
USUAL = ["L", "M", "T", "I", "Theta", "N", "J"]
FORM = {"keys": "functions", "of": {"functions": "q p Q P t"}, "besides": ["functions_i - functions_i"]}
Dimension = dict[str, Fraction]
"""{unit: its exponent}."""


def product(a: Dimension, b: Dimension, exponent: Fraction) -> Dimension:
    """a · b^exponent."""
    found = dict(a)
    for unit, n in b.items():
        found[unit] = found.get(unit, Fraction(0)) + n * exponent
    return {unit: n for unit, n in found.items() if n}


def dimension_of(text: Any) -> Dimension:
    """What M*L**2/T says. Raises Stop for a text of another form."""
    if not isinstance(text, str) or not text.isascii() or len(text) > LONGEST:
        raise Stop("not shown", "a unit of that form")
    return unit_of(ast.parse(text.strip(), mode="eval").body)


def unit_of(at: Any) -> Dimension:
    """The dimension of a syntax tree: names, 1, products, quotients and powers with rational numbers."""
    if isinstance(at, ast.Name):
        return {at.id: Fraction(1)}
    if isinstance(at, ast.Constant) and type(at.value) is int and at.value == 1:
        return {}
    if isinstance(at, ast.BinOp) and isinstance(at.op, ast.Mult | ast.Div):
        return product(unit_of(at.left), unit_of(at.right), Fraction(1 if isinstance(at.op, ast.Mult) else -1))
    if isinstance(at, ast.BinOp) and isinstance(at.op, ast.Pow):
        return product({}, unit_of(at.left), exponent_of(at.right))
    raise Stop("not shown", "a unit of that form")


def exponent_of(at: Any) -> Fraction:
    """A whole number, or a quotient of two."""
    if isinstance(at, ast.Constant) and type(at.value) is int:
        return Fraction(at.value)
    if isinstance(at, ast.UnaryOp) and isinstance(at.op, ast.USub):
        return -exponent_of(at.operand)
    if isinstance(at, ast.BinOp) and isinstance(at.op, ast.Div):
        return exponent_of(at.left) / exponent_of(at.right)
    raise Stop("not shown", "a unit of that form")


class Units:
    """The dimensions of names and functions of a claim, and of formulas made of these."""

    def __init__(self, claim: Any, table: Any) -> None:
        self.claim, self.names, self.functions = claim, dict[str, Dimension](), dict[str, list[Dimension]]()
        for name, said in table.items():
            words = {*claim.words.get(name, ())}
            if isinstance(said, list) == ("function" not in words) or "integer" in words:
                raise Stop("not shown", "units of a function for a name, of a name for a function, or of an integer")
            if name not in {*claim.names, *claim.words} or name in claim.texts:
                raise Stop("not shown", "units of what isn't declared")
            if isinstance(said, list):
                self.functions[name] = [*map(dimension_of, said)]
            else:
                self.names[name] = dimension_of(said)

    def of(self, f: Any) -> Dimension:
        """The dimension of a formula. Raises Stop."""
        if f.kind == "#":
            return {}
        if f.kind == ".":
            return self.names.get(f.of[0], {})
        if f.kind == "D":
            found = self.of(f.of[0])
            for name in f.orders:
                found = product(found, self.names.get(name, {}), Fraction(-1))
            return found
        if f.kind == "^":
            base, exponent = f.of
            if exponent.kind == "#":
                return product({}, self.of(base), exponent.of[0])
            return self.alike([base, exponent], {})
        if f.kind == "+":
            terms = [x for x in f.of if not is_nought(x)]
            return self.alike(terms, self.of(terms[0])) if terms else {}
        if f.kind == "*":
            return product(self.of(f.of[0]), self.of(f.of[1]), Fraction(1))
        if f.kind == "atan2":
            self.alike(f.of, self.of(f.of[0]))
            return {}
        if f.kind not in self.functions:
            return self.alike(f.of, {})
        found, *arguments = self.functions[f.kind]
        for x, said, n in zip(f.of, arguments, f.orders, strict=True):
            self.alike([x], said)
            found = product(found, said, Fraction(-n))
        return found

    def alike(self, formulas: Any, said: Dimension) -> Dimension:
        """This dimension, where all of them have it. Raises Stop."""
        if any(self.of(x) != said for x in formulas):
            raise Stop("not shown", "a dimension that doesn't follow step by step")
        return said


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim."""
    tables = data["tables"]
    said = {key: x for key, x in tables["claim"].items() if key not in alone.UNASKED}
    if tables["claim"]["kind"] != "dimension" or {*said} - {"base"} != {"functions", "dimensions", "equals"}:
        raise Stop("not shown", "no dimension, or with other keys")
    if {"transformation", "generating_function"} & {*tables}:
        raise Stop("not shown", "units beside a map")
    claim = alone_wider.Wider({**tables, "claim": {"kind": "dimension", "functions": said["functions"]}}, FORM)
    base, listed = said.get("base", USUAL), [said["equals"], *alone_wider.flat([*said["dimensions"].values()])]
    if not isinstance(base, list) or not {*map(str.isidentifier, base)} <= {True} or len({*base}) < len(base):
        raise Stop("not shown", "a base of another form")
    if {*chain(*map(dimension_of, listed))} - {*base}:
        raise Stop("not shown", "units that aren't in the base")
    units, wanted, own = Units(claim, said["dimensions"]), dimension_of(said["equals"]), itself(claim)
    if not said["functions"]:
        raise Stop("not shown", "no functions")
    for k in range(len(said["functions"])):
        if units.of(claim.read(f"__functions_{k}", own)) != wanted:
            raise Stop("not shown", "that it has this dimension")
    return "shown", ""


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
