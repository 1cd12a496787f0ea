"""Field equations: `python alone_fields.py CERTIFICATE.json …`

For each field u of variables x the claim says Σ (−1)^|α| D^α ∂L/∂(D^α u). With u + ε exp(k·x) for u, ∂L/∂ε at ε = 0 is
exp(k·x) Σ k^α ∂L/∂(D^α u), a polynomial in k, whose coefficients are derivatives at k = 0. So the sum is one of
derivatives of L as it is written, by ε, k and x, each of which is taken before ε and k are 0; it is compared with the
claim's equation at random points (`alone_values.py`).
"""

from __future__ import annotations

import ast
import re
from itertools import count, product
from math import factorial, prod
from typing import Any

if __package__:
    from canon.checker import alone, alone_special, alone_values
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_special  # type: ignore
    import alone_values  # type: ignore

Formula, Stop = alone.Formula, alone.Stop
CALL = re.compile(r"\s*(\w+)\s*\(\s*(\w+(?:\s*,\s*\w+)*)\s*\)\s*")
HIGHEST = 2


def order(f: Any) -> int:
    """How many derivatives stand in one another in a formula."""
    inner = max((order(g) for g in f.of if isinstance(g, Formula)), default=0)
    return inner + (len(f.orders) if f.kind == "D" else sum(f.orders))


class Field(alone_special.Small):
    """The equation of one field, as an identity; in L it stands beside ε exp(k·x)."""

    def __init__(self, tables: Any, name: str, variables: list[str], equation: str, fields: Any) -> None:
        self.name, self.placed, self.fields, self.met = "", variables, fields, set[str]()
        whole = alone.formulas(tables)
        fresh = next(f"field{k}x" for k in count() if f"field{k}x" not in whole)
        self.small, waves = f"{fresh}e", [f"{fresh}k{i}" for i in range(len(variables))]
        along = [f"{k}*{x}" for k, x in zip(waves, variables, strict=True)]
        self.wave = f"{self.small}*exp({' + '.join(along)})"
        rest = {key: x for key, x in tables.items() if key != "claim"}
        symbols = {**tables.get("symbols", {}), **dict.fromkeys((self.small, *waves), "real")}
        definitions = {**tables.get("definitions", {}), f"{fresh}L": tables["claim"]["L"]}
        claim = {"kind": "identity", "lhs": "0", "rhs": equation}
        super().__init__({**rest, "symbols": symbols, "definitions": definitions, "claim": claim})
        odd = {*variables} - {*self.variables, *self.words} or {*variables} & {*self.texts}
        if odd or any(map(self.is_function, variables)) or any("integer" in self.words.get(x, ()) for x in variables):
            raise Stop("not shown", "fields of other than names")
        highest = order(self.known(f"{fresh}L"))
        if highest > HIGHEST or name not in self.met:
            raise Stop("not shown", "a field that isn't there, or with so high derivatives")
        self.known.cache_clear()  # type: ignore[attr-defined]
        self.name, self.held = name, dict.fromkeys((self.small, *waves), 0)
        terms, base = list[str](), f"(D({fresh}L, {self.small})*exp(-({' + '.join(along)})))"
        for powers in product(range(highest + 1), repeat=len(variables)):
            if sum(powers) <= highest:
                text = base
                for x, k, n in zip(variables, waves, powers, strict=True):
                    for by in (k, x) * n:
                        text = f"D({text}, {by})"
                terms.append(f"({(-1) ** sum(powers)})/{prod(map(factorial, powers))}*{text}")
        self.zeros = [f"{' + '.join(terms)} - ({equation})"]

    def built(self, at: Any, text: str, own: Any) -> Any:
        """A field is one of its variables alone; the one that is varied has ε exp(k·x) beside it."""
        f = super().built(at, text, own)
        called = getattr(at.func, "id", "_")[1:] if isinstance(at, ast.Call) else ""
        if isinstance(at, ast.Call) and isinstance(at.func, ast.Subscript):
            raise Stop("not shown", "a field's derivative of that form")
        if called in self.fields:
            self.met.add(called)
            if [(g.kind, g.of) for g in f.of] != [(".", (x,)) for x in self.placed]:
                raise Stop("not shown", "a field at another place")
            return self.made("+", f, self.read(self.wave)) if called == self.name else f
        return f


class Still(alone_values.Values):
    """A random point, where ε and k are 0."""

    def __init__(self, claim: Any, prime: int) -> None:
        super().__init__(claim, prime, claim.held)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim: one identity for each field."""
    tables = data["tables"]
    claim = {key: x for key, x in tables["claim"].items() if key not in alone.UNASKED}
    if tables["claim"]["kind"] != "field_equations" or {*claim} != {"L", "fields", "equations"}:
        raise Stop("not shown", "no field equations, or other keys")
    calls = [CALL.fullmatch(text) for text in claim["fields"]]
    if not all(calls) or not calls or len(calls) != len(claim["equations"]):
        raise Stop("not shown", "fields of another form, or other equations than fields")
    names, places = zip(*((m[1], re.split(r"\s*,\s*", m[2])) for m in calls if m), strict=True)
    functions = [name for name, words in tables.get("symbols", {}).items() if words in ("function", ["function"])]
    odd = len({*names}) < len(names) or {*names} - {*functions} or any(place != places[0] for place in places)
    if odd or len({*places[0]}) < len(places[0]):
        raise Stop("not shown", "fields of other variables, or no functions")
    for name, equation in zip(names, claim["equations"], strict=True):
        one = Field(tables, name, places[0], equation, names)
        one.insist()
        alone_values.shown(one, Still)
    return "shown", ""


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
