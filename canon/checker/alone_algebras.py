"""Lie algebras of functions on phase space: `python alone_algebras.py CERTIFICATE.json …`

The brackets are [e_i, e_j] = Σ c_ijk e_k at random points (`alone_wider.py`, by a row of the table), with constants
that the claim states, or else the certificate. The functions are independent, at any time, where a determinant of their
derivatives isn't 0: which derivatives is tried, and it has to be so whatever the parameters are. The algebra of a name
is told by the exact constants (`alone_lie.py`).
"""

from __future__ import annotations

import re
from itertools import combinations_with_replacement, count
from typing import Any

if __package__:
    from canon.checker import alone, alone_lie, alone_wider
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_lie  # type: ignore
    import alone_wider  # type: ignore

Stop, RANDOM = alone.Stop, alone.RANDOM
Route = tuple[str, ...]
"""Names by which there is differentiated."""
KEYS, TRIES = {"basis", "equals", "structure", "tensor", "coordinates"}, 12


def claim_of(data: Any) -> tuple[Any, Any, list[str]]:
    """The file's tables with the claim as the table has it; the structure constants, as a table; the basis."""
    tables, claim = data["tables"], data["tables"]["claim"]
    said = {key: x for key, x in claim.items() if key not in alone.UNASKED}
    if claim["kind"] != "algebra" or {*said} - KEYS or not {"equals", "structure"} & {*said}:
        raise Stop("not shown", "no algebra, or with other keys")
    names, structure = [*said["basis"]], said["structure"] if "structure" in said else data["known"]["structure"]
    if len(names) > alone_lie.LARGEST or not all(map(str.isidentifier, names)):
        raise Stop("not shown", "a basis of so many elements, or of other names")
    whole = alone.formulas({**tables, "claim": {**said, "structure": structure}})
    unit = next(u for u in (f"unit{k}x" for k in count()) if u not in whole)
    units = [f"{unit}{k}" for k in range(len(names))]
    combos = [["0"] * len(names) for _ in names]
    seen = set[frozenset[str]]()
    for pair, text in structure.items():
        a, b = (name.strip() for name in pair.split(","))
        if a == b or frozenset((a, b)) in seen:
            raise Stop("not shown", "pairs that stand twice")
        seen.add(frozenset((a, b)))
        i, j = names.index(a), names.index(b)
        called = lambda m: units[names.index(m[0])] if m[0] in names else m[0]
        combo = re.sub(r"(?<![\w.])[^\W\d]\w*", called, str(text))
        combos[i][j], combos[j][i] = combo, f"-({combo})"
    put = lambda text, k: re.sub(rf"\b{unit}(\d+)\b", lambda m: f"({int(int(m[1]) == k)})", text)
    constants = [[[put(text, k) for k in range(len(names))] for text in row] for row in combos]
    new = {"basis": [*said["basis"].values()], "constants": constants, "combos": combos, "units": units}
    new |= {key: said[key] for key in ("tensor", "coordinates") if key in said}
    symbols = {**tables.get("symbols", {}), **dict.fromkeys(units, "real")}
    return {**tables, "symbols": symbols, "claim": {"kind": "algebra", **new}}, said, names


class Algebra(alone_wider.Wider):
    """A claim that functions make a Lie algebra."""

    def __init__(self, tables: Any) -> None:
        super().__init__(tables)
        self.basis = [self.known(f"__basis_{k}") for k in range(len(tables["claim"]["basis"]))]
        apart = {f"__units_{k}" for k in range(len(self.basis))}
        self.parameters = [n for n in self.words if not self.is_function(n) and n not in {*self.variables} | apart]
        self.chosen: tuple[Route, ...] = ()


class Independent(alone_wider.Placed):
    """A random point at which the functions are seen to be independent."""

    def row(self, by: Route) -> list[int]:
        return [self.at(f, *by) for f in self.asked.basis]  # type: ignore[attr-defined]

    def determinant(self, routes: tuple[Route, ...], *by: str) -> int:
        """Of these derivatives of the basis; or its derivative by a name, det M tr(M⁻¹ M')."""
        p, n = self.p, len(routes)
        slopes = [self.row(tuple(sorted((*route, *by)))) if by else [] for route in routes]
        rows, found = [[*self.row(route), *slope] for route, slope in zip(routes, slopes, strict=True)], 1
        for k in range(n):
            pivot = next((r for r in range(k, n) if rows[r][k]), None)
            if pivot is None:
                return 0
            if pivot != k:
                rows[k], rows[pivot], found = rows[pivot], rows[k], -found
            found = found * rows[k][k] % p
            inverse = pow(rows[k][k], -1, p)
            rows[k] = [x * inverse % p for x in rows[k]]
            for r in range(n):
                if r != k and (factor := rows[r][k]):
                    rows[r] = [(x - factor * y) % p for x, y in zip(rows[r], rows[k], strict=True)]
        return found * sum(row[n + k] for k, row in enumerate(rows)) % p if by else found % p

    def check(self) -> None:
        super().check()
        claim: Any = self.asked
        if claim.chosen:
            self.check_apart(lambda point, *by: point.determinant(claim.chosen, *by))
            return
        moving = [v for v in claim.variables if v != claim.names[-1]]  # at one time
        routes: list[Route] = [(), *((v,) for v in moving), *combinations_with_replacement(moving, 2)]
        routes = [route for route in routes if any(self.row(tuple(sorted(route))))]
        bare = {r: sum(any(self.row(tuple(sorted((*r, x))))) for x in claim.parameters) for r in routes}
        reason = Stop("not shown", "that the functions are independent")
        for _ in range(TRIES):
            order = sorted(routes, key=lambda r: (bare[r], RANDOM.random()))
            chosen = self.chosen_of(order)
            if len(chosen) < len(claim.basis):
                break
            try:
                self.check_apart(lambda point, *by, c=chosen: point.determinant(c, *by))
            except Stop as stop:
                reason = stop
                continue
            claim.chosen = chosen
            return
        raise reason

    def chosen_of(self, order: list[Route]) -> tuple[Route, ...]:
        """The first derivatives in this order that make independent rows."""
        rows, chosen, p = list[list[int]](), list[Route](), self.p
        for route in order:
            row = self.row(tuple(sorted(route)))
            for other in rows:
                k = next(k for k, x in enumerate(other) if x)
                factor = row[k] * pow(other[k], -1, p)
                row = [(x - factor * y) % p for x, y in zip(row, other, strict=True)]
            if any(row) and len(chosen) < len(self.asked.basis):  # type: ignore[attr-defined]
                rows.append(row)
                chosen.append(route)
        return tuple(chosen)


def sample(claim: Any, case: Any, prime: int) -> int:
    return alone.sample(claim, case, prime, Independent, Independent.check)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim."""
    tables, said, names = claim_of(data)
    claim = Algebra(tables)
    if "equals" in said:
        n = range(len(names))
        read = lambda i, j, k: claim.known(f"__constants_{i}_{j}_{k}")
        if any(read(i, j, k).kind != "#" for i in n for j in n for k in n):
            raise Stop("not shown", "the algebra of constants with parameters")
        constants = [[[read(i, j, k).of[0] for k in n] for j in n] for i in n]
        if not alone_lie.is_called(constants, said["equals"]):
            raise Stop("not shown", "that it is the algebra of this name")
    return alone.tried(sample, claim, data["cases"][0])


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
