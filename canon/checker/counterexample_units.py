"""Refutations of dimensions, beside `counterexample.py`: a value at a point, and in other units.

In units that are smaller by some factors each name, and each function that is declared, grows by its own: a function f
of x becomes s f(x/r). If a formula had the dimension that is claimed, its value would grow by that dimension's factor.
Both values are enclosed, and both points lie in the domain; so an enclosure that leaves this out refutes the claim. A
declared function is the witness's, or one of ours: there is a smooth one that is as this near the places where it is
asked.
"""

from __future__ import annotations

import re
from contextlib import suppress
from fractions import Fraction
from itertools import chain
from math import lcm
from random import Random
from typing import Any

if __package__:
    from canon.checker import alone, alone_units
    from canon.checker.alone import Stop
    from canon.checker.counterexample import Arithmetic, Open, check_domain, fails, somewhere
    from canon.checker.counterexample_functions import Place
    from canon.checker.counterexample_kinds import Table
else:  # as a program's part, beside the other files
    import alone  # type: ignore
    import alone_units  # type: ignore
    from alone import Stop  # type: ignore
    from counterexample import Arithmetic, Open, check_domain, fails, somewhere  # type: ignore
    from counterexample_functions import Place  # type: ignore
    from counterexample_kinds import Table  # type: ignore

BITS, TRIES, FACTORS = (64, 192), 6, (Fraction(1), Fraction(2), Fraction(1, 2), Fraction(3, 2))
FORM = {"keys": "functions", "of": {"functions": "q p Q P t"}, "besides": ["functions_i - functions_i"]}


class Scales:
    """What is multiplied by what in other units: {unit: its factor}, each a power whose roots are rational."""

    def __init__(self, dimensions: list[Any], rng: Random) -> None:
        self.factors = dict[str, Fraction]()
        for unit in sorted({*chain(*dimensions)}):
            whole = lcm(*(d[unit].denominator for d in dimensions if unit in d))
            self.factors[unit] = rng.choice(FACTORS) ** whole

    def of(self, dimension: Any) -> Fraction:
        """The factor of a dimension."""
        found = Fraction(1)
        for unit, n in dimension.items():
            root = rational_root(self.factors[unit], n.denominator)
            found *= root**n.numerator
        return found


def rational_root(x: Fraction, n: int) -> Fraction:
    """The n-th root of a power. Raises Stop where it isn't rational."""
    roots = [round(part ** (1 / n)) if n > 1 else part for part in x.as_integer_ratio()]
    if Fraction(*roots) ** n != x:
        raise Stop("not shown", "a factor without a root")
    return Fraction(*roots)


def in_other_units(claim: Any, of: dict[str, Any], units: alone_units.Units, scales: Scales) -> dict[str, Any]:
    """The same values in other units."""
    new = dict(of)
    for name, dimension in units.names.items():
        x = of[name]
        new[name] = (x[0] * scales.of(dimension), x[1] * scales.of(dimension))
    for name, (own, *arguments) in units.functions.items():
        names = ["a"] if len(arguments) == 1 else [f"a{k + 1}" for k in range(len(arguments))]
        words = {*claim.words[name]}
        if words - {"function", "positive", "negative"}:
            raise Stop("not shown", "a function of another sign")
        usual = "exp(" + " + ".join(f"{x}/{k + 2}" for k, x in enumerate(names)) + ")"
        of.setdefault(name, f"-{usual}" if "negative" in words else usual)
        put = {x: f"({x}/({scales.of(d)}))" for x, d in zip(names, arguments, strict=True)}
        body = re.sub(r"(?<!\w)[^\W\d]\w*", lambda m, put=put: put.get(m[0], m[0]), str(of[name]))
        new[name] = f"({scales.of(own)})*({body})"
    return new


def check_functions(claim: Any, f: Any, units: alone_units.Units) -> None:
    """See that each function that is called has a dimension, of so many arguments. Raises Stop."""
    if claim.is_function(f.kind) and len(units.functions.get(f.kind, ())) != 1 + len(f.of):
        raise Stop("not shown", "a function without a dimension")
    for g in f.of:
        if isinstance(g, alone.Formula):
            check_functions(claim, g, units)


def refuted(tables: Any, witness: Any, known: Any = None) -> tuple[str, str]:
    """Whether a value, in other units, isn't what the dimension makes of it."""
    said = {key: x for key, x in tables["claim"].items() if key not in alone.UNASKED}
    if tables["claim"]["kind"] != "dimension" or {*said} - {"base"} != {"functions", "dimensions", "equals"}:
        raise Stop("not shown", "a refutation of such a claim")
    if {"transformation", "generating_function"} & {*tables} or {*tables.get("domain", {})} - {"where"}:
        raise Stop("not shown", "units beside a map, or on a surface")
    claim = Table({**tables, "claim": {"kind": "dimension", "functions": said["functions"]}}, FORM)
    units, wanted = alone_units.Units(claim, said["dimensions"]), alone_units.dimension_of(said["equals"])
    base, every = (
        said.get("base", alone_units.USUAL),
        [wanted, *units.names.values(), *chain(*units.functions.values())],
    )
    if not isinstance(base, list) or {*chain(*every)} - {*base} or len({*base}) < len(base):
        raise Stop("not shown", "units that aren't in the base")
    formulas = [claim.known(f"__functions_{k}") for k in range(len(said["functions"]))]
    sides = chain(*(re.split("<=|>=|!=|<|>", text) for text in tables.get("domain", {}).get("where", [])))
    for f in (*formulas, *map(claim.known, (*sides, *tables.get("hamiltonian", {}).values()))):
        check_functions(claim, f, units)
    rng, reason, values = Random(0), "that something fails at the witness", witness if isinstance(witness, dict) else {}
    for k in range(TRIES):
        scales, of = Scales(every, rng), somewhere(claim, values, k % 3)
        new = in_other_units(claim, of, units, scales)
        for bits in BITS:
            try:
                points = [Place(claim, x, Arithmetic(bits)) for x in (of, new)]
                for point in points:
                    check_domain(point, {"hamiltonian": tables.get("hamiltonian", {})})
            except Open as left:
                reason = str(left)
                continue
            for f in formulas:
                with suppress(Open):
                    old, now, factor = points[0].at(f), points[1].at(f), -scales.of(wanted)
                    real = points[0].real
                    if fails(real.add(now, real.times(old, (factor, factor))), ""):
                        return "shown", ""
    return "not shown", reason
