"""Lie algebras of functions for all values of parameters, and on surfaces: `python alone_parameters.py CERTIFICATE…`

Beside what `alone_algebras.py` shows: a parameter that is real is 0 or isn't, and both are looked at. On a surface
(`alone_surfaces.py`) brackets are taken before; the basis is independent on it if its values at as many points are, for
one choice of parameters. This is so for almost all values of these, and for all if the basis and the surface's equation
are homogeneous: where x may be scaled with the variables, and no other parameter, one positive value of x is as good as
any other. Constants that are powers of positive parameters are those at 1, in another basis (`alone_names.py`).
"""

from __future__ import annotations

import re
from contextlib import suppress
from fractions import Fraction
from itertools import count, product
from typing import Any

if __package__:
    from canon.checker import alone, alone_algebras, alone_lie, alone_names, alone_special, alone_values
    from canon.checker.alone_surfaces import On, Surface
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_algebras  # type: ignore
    import alone_lie  # type: ignore
    import alone_names  # type: ignore
    import alone_special  # type: ignore
    import alone_values  # type: ignore
    from alone_surfaces import On, Surface  # type: ignore

Formula, Stop, names_of = alone.Formula, alone.Stop, alone_special.names_of
MOST_REAL, MOST_OTHERS = 2, 300
Row = dict[str, Fraction]
"""A linear form in the weights of names."""


class Weights:
    """Weights of names, by which formulas are homogeneous: what has to be 0 of them."""

    def __init__(self) -> None:
        self.rows = list[Row]()

    def of(self, f: Any) -> Row | None:
        """The weight of a formula; None is that of 0, which has any."""
        if f.kind == "#":
            return {} if f.of[0] else None
        if f.kind == ".":
            return {} if f.of[0] == "pi" else {f.of[0]: Fraction(1)}
        if f.kind == "^" and f.of[1].kind == "#":
            base = self.of(f.of[0])
            return base if base is None else {x: k * f.of[1].of[0] for x, k in base.items()}
        if f.kind not in "+*":
            raise Stop("not shown", "what isn't homogeneous")
        a, b = map(self.of, f.of)
        if a is None or b is None:
            return None if f.kind == "*" else a if b is None else b
        sign = 1 if f.kind == "*" else -1
        both = {x: a.get(x, Fraction(0)) + sign * b.get(x, Fraction(0)) for x in {*a, *b}}
        if f.kind == "*":
            return both
        self.rows.append(both)
        return a

    def scales(self, name: str, fixed: set[str]) -> bool:
        """Whether a name may be scaled with others than those that are fixed."""
        names = sorted({x for row in self.rows for x in row} | {name})
        rows = [[row.get(x, Fraction(0)) for x in names] for row in self.rows]
        rows += [[Fraction(int(x == y)) for x in names] for y in fixed - {name} if y in names]
        return any(v[names.index(name)] for v in alone_lie.kernel(rows, len(names)))


class Restricted(Surface, alone_special.Functions, alone_algebras.Algebra):
    """A claim that functions make a Lie algebra, on a surface or not, with a basis that is homogeneous."""

    def __init__(self, tables: Any) -> None:
        domain, self.space = dict(tables.get("domain", {})), tables["phase_space"]
        on, whole = domain.pop("on", []), alone.formulas(tables)
        fresh = next(f"surface{k}x" for k in count() if f"surface{k}x" not in whole)
        if len(on) > 1 or {*domain} - {"where"}:
            raise Stop("not shown", "a surface of several equations")
        texts = dict(zip([fresh], on, strict=False))
        super().__init__({**tables, "domain": domain, "definitions": {**tables.get("definitions", {}), **texts}})
        self.is_independent = False
        weights, equations = Weights(), [self.known(text) for text in texts]
        used = frozenset[str]().union(*map(names_of, (*equations, *self.basis)))
        for f in (*equations, *self.basis, *self.conditions()):
            weights.of(f)
        self.fixed = {x for x in self.parameters if x in used}
        for x in self.fixed:
            signed = {*self.words[x]} & {"positive", "negative", "nonzero"}
            if not signed or "integer" in self.words[x] or not weights.scales(x, self.fixed):
                raise Stop("not shown", f"that the functions are independent, whatever {x[:40]} is")
        for f in equations:
            if used - {*self.variables, *self.parameters}:
                raise Stop("not shown", "a surface in other variables")
            self.solve(f, [v for v in self.variables[:-1] if self.words.get(v, ["real"]) == ["real"]])

    def is_fine(self, f: Any) -> bool:
        """Whether the surface is smooth: f and what scaling of all coordinates, or all momenta, makes of it have a
        combination that is 0 nowhere, one of the terms of f. Where f = 0 its gradient isn't 0 then.
        """
        terms, space = [g for g in self.terms_of(f) if Weights().of(g) is not None], self.space
        groups = [dict.fromkeys(space[side], 1) for side in "qp"]
        rows = [[self.degree(term, group) for group in groups] + [Fraction(1)] for term in terms]
        for k, term in enumerate(terms):
            target = [[*row, Fraction(int(k == m))] for m, row in enumerate(rows)]
            if self.is_apart(term) and alone_lie.rank(target) == alone_lie.rank(rows):
                return True
        return False

    def terms_of(self, f: Any) -> list[Any]:
        return [g for part in f.of for g in self.terms_of(part)] if f.kind == "+" else [f]

    def degree(self, f: Any, group: Any) -> Fraction:
        """How a term grows when names are scaled."""
        weights = Weights()
        row, value = weights.of(f), lambda row: sum((k * group.get(x, 0) for x, k in row.items()), Fraction(0))
        if row is None or any(map(value, weights.rows)):
            raise Stop("not shown", "a surface that isn't homogeneous, term by term")
        return value(row)


class Apart(On):
    """A random point, and others for the same parameters, at which the basis is independent."""

    def check(self) -> None:
        super().check()
        claim: Any = self.asked
        if claim.is_independent:  # at one point is enough, as the surface has one part
            return
        self.check_one_part()
        rows = [self.row()]
        for _ in range(MOST_OTHERS * len(claim.basis)):
            if len(rows) == len(claim.basis):
                break
            with suppress(alone.Elsewhere):
                rows.append(self.another().row())
        if len(rows) < len(claim.basis) or not determinant(rows, self.p):
            raise Stop("not shown", "that the functions are independent")
        claim.is_independent = True

    def another(self) -> Apart:
        """A point for the same parameters, at the same time."""
        claim: Any = self.asked
        still = {*claim.parameters, claim.names[-1], "pi"}
        still = still.union(*(claim.within(name) for name in still & {*claim.put}))
        free = {k: x for k, x in self.free.items() if k[0] in still}
        return Apart(claim, self.p, {name: x for name, x in self.fixed.items() if name in still}, free)

    def check_one_part(self) -> None:
        """See that all points of the surface and the roots are those of one irreducible part, for these parameters.

        Each radicand has to be a square at some points and none at others, where all before it are squares: so it
        isn't a square times a number, and the cover by its root has one part. Else some functions may depend on each
        other on the domain's part, and not on both: √(x²) and x.
        """
        found = list[list[bool]]()
        for _ in range(MOST_OTHERS):
            point = self.another()
            with suppress(alone.Elsewhere):
                point.row()
            found.append(point.steps)
        for k in range(max(map(len, found))):
            if {steps[k] for steps in found if len(steps) > k} != {True, False}:
                raise Stop("not shown", "that a radicand is no square")

    def row(self) -> list[int]:
        self.place()
        return [self.at(f) for f in self.asked.basis]


def determinant(rows: list[list[int]], p: int) -> int:
    """Whether it isn't 0 modulo p, as a number."""
    rows, n = [row[:] for row in rows], len(rows)
    for k in range(n):
        pivot = next((r for r in range(k, n) if rows[r][k]), None)
        if pivot is None:
            return 0
        rows[k], rows[pivot] = rows[pivot], rows[k]
        inverse = pow(rows[k][k], -1, p)
        for r in range(k + 1, n):
            factor = rows[r][k] * inverse
            rows[r] = [(x - factor * y) % p for x, y in zip(rows[r], rows[k], strict=True)]
    return 1


def is_named(claim: Any, n: int, name: str) -> bool:
    """Whether the constants are those of the algebra of this name, whatever the parameters are."""
    read = lambda i, j, k: claim.known(f"__constants_{i}_{j}_{k}")
    positive = [x for x, words in claim.words.items() if "positive" in words and x not in claim.texts]
    return alone_names.is_called(alone_names.at_one(read, n, positive), name)


def one(data: Any) -> tuple[str, str]:
    """The answer for one case of the parameters."""
    tables, said, names = alone_algebras.claim_of(data)
    on = "on" in tables.get("domain", {})
    try:
        claim: Any = Restricted(tables)
        by = lambda: alone_values.shown(claim, Apart)
    except Stop as stop:
        if on:
            return stop.args[0], stop.args[1]
        claim = alone_algebras.Algebra(tables)
        by = lambda: alone.tried(independent, claim)
    if "equals" in said and not is_named(claim, len(names), said["equals"]):
        raise Stop("not shown", "that it is the algebra of this name")
    return by()


def independent(claim: Any, prime: int) -> int:
    """See at a random point that all vanishes that has to, and that the basis is independent."""
    point = alone_algebras.Independent(claim, prime)
    point.check_domain()
    if any(map(point.text, claim.zeros)):
        raise Stop("not shown", "that all of it is 0")
    point.check()
    return len(point.roots)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim: of a real parameter that it is 0, and that it isn't."""
    tables = data["tables"]
    if tables["claim"]["kind"] != "algebra":
        raise Stop("not shown", "no algebra of functions")
    symbols, space = dict(tables.get("symbols", {})), tables.get("phase_space", {})
    named = {x for side in space.values() for x in ([side] if isinstance(side, str) else side)}
    named |= {*tables["claim"].get("coordinates", ())} | {space.get("time", "t")}
    written = {*re.findall(r"\w+", alone.formulas({**tables, "symbols": {}}))}
    real = [x for x, words in symbols.items() if words in ("real", ["real"]) and x in written - named]
    if len(real) > MOST_REAL:
        raise Stop("not shown", "so many real parameters")
    for ways in product((True, False), repeat=len(real)):
        zero = {x: "0" for x, way in zip(real, ways, strict=True) if way}
        apart = {x: ["real", "nonzero"] for x in real if x not in zero}
        kept = {x: words for x, words in (symbols | apart).items() if x not in zero}
        definitions = {**tables.get("definitions", {}), **zero}
        answer = one({**data, "tables": {**tables, "symbols": kept, "definitions": definitions}})
        if answer[0] != "shown":
            return answer
    return "shown", ""


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
