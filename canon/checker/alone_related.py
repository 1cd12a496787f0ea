"""Identities of old and new variables, with derivatives by either, and on surfaces: `python alone_related.py FILE…`

Old and new variables are names that are independent of each other wherever something is differentiated; then those that
a map gives have its formulas' values. A map is given forward (to as many variables, or to fewer), backward, or by a
generating function, p being ∂F/∂q and so on; where it isn't forward its determinant isn't 0 (`alone_wider.py`).
Surfaces: `alone_surfaces.py`. What else is known at the points: `alone_values.py`, `alone_facts.py`; of other kinds
of claims, without maps and surfaces, these are asked too.
"""

from __future__ import annotations

import ast
import json
from contextlib import suppress
from itertools import chain, count, permutations
from typing import Any

if __package__:
    from canon.checker import alone, alone_facts, alone_table, alone_values
    from canon.checker.alone_special import Small, Wide, names_of
    from canon.checker.alone_surfaces import On, Surface
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_facts  # type: ignore
    import alone_table  # type: ignore
    import alone_values  # type: ignore
    from alone_special import Small, Wide, names_of  # type: ignore
    from alone_surfaces import On, Surface  # type: ignore

Formula, Stop, flat = alone.Formula, alone.Stop, alone_table.flat
MAPS, MOST_ROWS = ("transformation", "generating_function"), 5
KINDS = (
    "identity", "bracket", "conserved", "involution", "jacobi", "casimir", "equations_of_motion", "hamiltonian_field",
    "infinitesimal", "matrix_group", "invariant_interval", "euler_lagrange", "solves",
)  # fmt: skip


class Related(Surface, Small):
    """An identity; `given` names have the values of formulas, and `on` vanishes by the value of the name `solved`."""

    def __init__(self, tables: Any) -> None:
        tables = json.loads(json.dumps(tables))
        space, claim = dict(tables["phase_space"]), tables["claim"]
        sides = {side: space.pop(side, []) for side in "qpQP"}
        self.old, self.new = {*sides["q"], *sides["p"]}, {*sides["Q"], *sides["P"]}
        symbols, held = dict(tables.get("symbols", {})), [*chain(*sides.values()), space.get("time", "t")]
        maps, domain = [s for s in MAPS if s in tables], dict(tables.get("domain", {}))
        stated = "transformation" in maps or not maps
        on, odd = domain.pop("on", []), {*tables} - {*alone.SECTIONS} or {*domain} - {"where"}
        odd = odd or any({*tables.get(s, {})} - {*keys} for s, keys in alone.SECTIONS.items() if keys and s != "domain")
        odd = odd or claim["kind"] != "identity" or len({*held}) < len(held) or len(on) > 1
        odd = odd or any(w in str(symbols.get(n, "")) for n in held for w in ("function", "integer", "complex"))
        odd = odd or not all(isinstance(x, str) for x in (*held, *on))
        if odd or (not stated and self.new and not {"type", "F"} == {*tables[MAPS[1]]}):
            raise Stop("not shown", "another claim, or names with two meanings")
        whole, definitions = alone.formulas(tables), dict(tables.get("definitions", {}))
        fresh = next(f"given{k}x" for k in count() if f"given{k}x" not in whole)
        ways = self.ways(sides, tables, stated) if maps else []
        texts = {f"{fresh}{k}": text for k, (_, text) in enumerate(ways)}
        texts |= {f"{fresh}on": text for text in on}
        if maps and any(word in str(domain) for word in ("D(", "bracket(")):
            raise Stop("not shown", "a condition on derivatives beside a map")
        rest = {key: x for key, x in tables.items() if key not in MAPS}
        super().__init__({
            **rest, "phase_space": {**space, "q": sides["q"], "p": sides["p"]}, "domain": domain,
            "definitions": {**definitions, **texts}, "symbols": {**dict.fromkeys(self.new, "real"), **symbols},
        })  # fmt: skip
        self.given = {name: self.known(f"{fresh}{k}") for k, (name, _) in enumerate(ways)}
        self.settle(self.given)
        self.base = [name for name in held[:-1] if name not in self.given]
        if any(names_of(f) & {*self.given} for f in self.given.values()) or len(self.given) < len(ways):
            raise Stop("not shown", "a map of variables that it gives")
        self.words = {name: ["real"] for name in self.old} | self.words  # derivatives are by these as well
        self.variables = [*self.base, held[-1]]
        for f in map(self.known, ("_lhs", "_rhs", *texts)):
            self.check_related(f)
            if not maps and names_of(f) & self.new:
                raise Stop("not shown", "new variables without a map")
        if on:
            self.solve(self.known(f"{fresh}on"), [*self.words, *self.base])
        if ways and not (stated and "Q" in tables["transformation"]):
            if on or [*map(len, sides.values())] != [len(sides["q"])] * 4:
                raise Stop("not shown", "a surface beside a map that isn't forward, or fewer variables")
            if stated:
                rows = [[f"D({fresh}{i}, {x})" for x in self.base] for i in range(len(ways))]
            else:
                F, mine = tables[MAPS[1]]["F"], {*self.base}
                inside = [[x for x in (*sides[a], *sides[b]) if x in mine] for a, b in ("qp", "QP")]
                rows = [[f"D(D({F}, {x}), {y})" for y in inside[1]] for x in inside[0]]
            self.nonzero = [determinant(rows)]

    def ways(self, sides: Any, tables: Any, stated: bool) -> list[tuple[str, str]]:
        """(a name that the map gives, its formula)."""
        if stated:
            explicit = tables["transformation"]
            if {*explicit} not in ({*"QP"}, {*"qp"}):
                raise Stop("not shown", "a map of another form")
            return [*chain(*(zip(sides[side], explicit[side], strict=True) for side in explicit))]
        given, found = tables["generating_function"], list[tuple[str, str]]()
        n = len(sides["q"])
        types = [given["type"]] * n if isinstance(given["type"], int) else given["type"]
        own = {sides[side][i] for i, one in zip(range(n), types, strict=True) for side in alone.TYPES[one]}
        if [*map(len, sides.values())] != [n] * 4:
            raise Stop("not shown", "a map to fewer variables by a generating function")
        for i, one in enumerate(types):
            for side in alone.TYPES[one]:
                other, up = alone.GIVES[side]
                found.append((sides[other][i], f"{'-' if up == '+' else ''}D({given['F']}, {sides[side][i]})"))
        if {name for name, _ in found} & own:
            raise Stop("not shown", "a generating function of another form")
        return found

    def built(self, at: Any, text: str, own: Any) -> Any:
        """Besides: no bracket, which is of old variables, of what has new ones in it."""
        f = super().built(at, text, own)
        if isinstance(at, ast.Call) and getattr(at.func, "id", "") == "_bracket":
            if any(names_of(self.built(x, text, own)) & self.new for x in at.args):
                raise Stop("not shown", "a bracket of new variables")
        return f

    def check_related(self, f: Any) -> None:
        """A derivative is of what has a name of its own side in it, or none: by the map Q depends on q."""
        if f.kind == "D":
            names, by = names_of(f.of[0]) & (self.old | self.new), {*f.orders}
            for side, other in ((self.old, self.new), (self.new, self.old)):
                if by & side and names & other and not names & side:
                    raise Stop("not shown", "a derivative of what depends on a name by the map")
            if not by & (self.old | self.new) and names and names <= {*self.given}:
                raise Stop("not shown", "a derivative of what a map gives")
        for g in f.of:
            if isinstance(g, Formula):
                self.check_related(g)


def determinant(rows: list[list[str]]) -> str:
    """Of a matrix of texts."""
    n, terms = range(len(rows)), list[str]()
    if len(rows) > MOST_ROWS or any(len(row) != len(rows) for row in rows):
        raise Stop("not shown", "no determinant, or one that is so large")
    for turn in permutations(n):
        sign = (-1) ** sum(turn[i] > turn[j] for j in n for i in range(j))
        terms.append("*".join([f"({sign})", *(rows[i][turn[i]] for i in n)]))
    return " + ".join(terms)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim itself."""
    kind = data["tables"]["claim"]["kind"]
    if kind not in KINDS:
        raise Stop("not shown", "a claim of another kind")
    reason = Stop("not shown", "another claim")
    for read in (Related,) if kind == "identity" else (Small, Wide):
        try:
            claim: Any = read(data["tables"])
            claim.insist()
            with suppress(Stop):
                return alone_values.shown(claim, On)
            alone_facts.find(claim)
            return alone_values.shown(claim, On)
        except (Stop, KeyError, ValueError) as other:
            reason = other if isinstance(other, Stop) else reason
    raise reason


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
