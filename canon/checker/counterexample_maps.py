"""What claims about maps need, for `counterexample_kinds.py`: maps by a generating function alone, and maps given
forward, where K may have derivatives by new variables in it.

A rule yields what has to vanish, and what a point has to be like before it counts.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain, combinations, permutations
from typing import Any

if __package__:
    from canon.checker.alone import GIVES, TYPES, Formula, Stop
    from canon.checker.counterexample_functions import More
else:  # as a program's part, beside the other files
    from alone import GIVES, TYPES, Formula, Stop  # type: ignore
    from counterexample_functions import More  # type: ignore

MOST_ORDER, SIDES = 7, ("q", "p", "Q", "P")


@dataclass(frozen=True)
class Asked:
    """A claim with what vanishes, and what a point has to be like: on the surface of `on`, with `apart` not 0, with the
    names in `held` at these values, and as `here` says besides."""

    claim: Any
    zeros: tuple[str, ...]
    on: tuple[str, ...] = ()
    apart: tuple[str, ...] = ()
    held: tuple[tuple[str, Fraction], ...] = ()
    orders: tuple[str, int] = ("", 0)
    relation: str = ""
    here: Any = None
    time: str = ""


def plain(tables: Any, **claim: Any) -> Any:
    """The tables of an identity, in which new variables are names like others, without the sections of a map."""
    space = tables["phase_space"]
    sides = {"q": [*space["q"], *space.get("Q", [])], "p": [*space["p"], *space.get("P", [])]}
    rest = {key: x for key, x in tables.items() if key in ("symbols", "definitions", "hamiltonian", "domain")}
    said = {key: x for key, x in space.items() if key == "time"}
    return {**rest, "phase_space": {**said, **sides}, "claim": {"kind": "identity", "lhs": "0", "rhs": "0"} | claim}


def of_generated(tables: Any) -> Iterator[Asked]:
    """K and H + ∂F/∂t differ by a function of time, in the variables of F, where its mixed Hessian isn't 0."""
    generating, space = tables["generating_function"], tables["phase_space"]
    n, types = len(space["q"]), generating["type"]
    kinds = [types] * n if isinstance(types, int) else types
    if [len(space[side]) for side in SIDES] != [n] * 4 or len(kinds) != n or {*tables["claim"]} != {"kind", "K"}:
        raise Stop("not shown", "a map of that form")
    claim = More(plain(tables, rhs=tables["claim"]["K"]))
    free = [[space[side][i] for i, one in enumerate(kinds) for side in TYPES[one][k]] for k in (0, 1)]
    claim.texts["_F"], sides = generating["F"], (free[0] + free[1], space["q"] + space["p"], space["Q"] + space["P"])
    for name, may in zip(("_F", "_H", "_rhs"), sides, strict=True):
        check_inner(claim, name, {*may})
    check_apart(claim, ["_H", "_rhs", *sides_of(tables)], {*claim.names[:-1]} - {*sides[0]})
    for i, one in enumerate(kinds):
        for side in TYPES[one]:
            other, sign = GIVES[side]
            minus = "-" if sign == "+" else ""  # p − ∂F/∂q = 0, P + ∂F/∂Q = 0
            claim.texts[space[other][i]] = f"{minus}D(_F, {space[side][i]})"
    claim.variables = [*sides[0], claim.names[-1]]
    claim.known.cache_clear()  # type: ignore
    zeros = tuple(f"D(_rhs - _H - D(_F, {claim.names[-1]}), {u})" for u in claim.variables[:-1])
    yield Asked(claim, zeros, apart=(determinant([[f"D(D(_F, {u}), {v})" for v in free[1]] for u in free[0]]),))


def parts(*of: Formula) -> set[Formula]:
    """Formulas with all that they are made of."""
    found, left = set[Formula](), [*of]
    while left:
        if (f := left.pop()) not in found:
            found.add(f)
            left += [x for x in f.of if isinstance(x, Formula)]
    return found


def check_inner(claim: Any, name: str, may: set[str], text: Any = None) -> None:
    """A formula is of these variables, as it is written."""
    own = {x: Formula(".", (x,)) for x in claim.names}
    found = parts(claim.read(claim.texts[name] if text is None else text, own))
    if {*chain(*(f.of for f in found))} & ({*claim.names[:-1]} - may):
        raise Stop("not shown", "a formula of other variables")


def slopes(f: Formula) -> set[str]:
    """The names by which something in a formula is differentiated."""
    return {name for g in parts(f) if g.kind == "D" for name in g.orders}


def check_apart(claim: Any, texts: Any, given: set[str]) -> None:
    """Nothing is differentiated that has what a map gives in it: with the map's formulas there it'd be something else.

    This is asked of a claim in which these names have no formulas yet."""
    found = parts(*(f for f in parts(*map(claim.known, texts)) if f.kind == "D"))
    if {*chain(*((*f.of, *f.orders) for f in found))} & given:
        raise Stop("not shown", "a derivative of what a map gives")


def sides_of(tables: Any) -> list[str]:
    """What stands on either side in the domain's conditions."""
    return [*chain(*(re.split("<=|>=|!=|<|>", text) for text in tables.get("domain", {}).get("where", [])))]


def of_transported(tables: Any) -> Iterator[Asked]:
    """The motion of the new variables is the one that K says: {Q, H} + ∂Q/∂t = ∂K/∂P, {P, H} + ∂P/∂t = −∂K/∂Q.

    Old and new variables are independent names wherever something is differentiated; then new ones are what the map
    gives. Where M J Mᵀ = c J with a number c that isn't 0 these equations are the claim's, Mᵀ∇K = c∇H − MᵀJ ∂(Q, P)/∂t;
    a map without such a number makes the claim false by itself.
    """
    space, explicit, claim = tables["phase_space"], tables["transformation"], tables["claim"]
    if {*explicit} != {"Q", "P"} or {*claim} != {"kind", "K"} or "generating_function" in tables:
        raise Stop("not shown", "a map that isn't given forward, or other keys")
    pairs = More({**tables, "claim": {"kind": "canonical"}}).pairs  # names have one meaning, conditions no such slopes
    old, new = ([*space[a], *space[b]] for a, b in ("qp", "QP"))
    asked = More(plain(tables, rhs=claim["K"]))
    asked.pairs, time, given = pairs, asked.names[-1], [*chain(*(explicit[side] for side in "QP"))]
    if any("integer" in asked.words.get(name, ()) for name in asked.names):
        raise Stop("not shown", "variables that are whole numbers")
    asked.texts |= {f"_new{i}": text for i, text in enumerate(given)}
    own = [(name, {*old}) for name in ("_H", *(f"_new{i}" for i in range(len(new))))] + [("_rhs", {*new})]
    for name, may in own:
        check_inner(asked, name, may)
        if slopes(asked.known(name)) - may - {time}:
            raise Stop("not shown", "a derivative by other names")
    asked.texts |= {x: f"_new{i}" for i, x in enumerate(new)}
    zeros, n = list[str](), len(pairs)
    for i in range(2 * n):
        moved = [f"D(_new{i}, {q})*D(_H, {p}) - D(_new{i}, {p})*D(_H, {q})" for q, p in pairs]
        said = f"- D(_rhs, {new[i + n]})" if i < n else f"+ D(_rhs, {new[i - n]})"
        zeros.append(" + ".join([f"D(_new{i}, {time})", *moved]) + said)
    yield Asked(asked, tuple(zeros), apart=(f"bracket(_new0, _new{n})",))


def determinant(rows: list[list[str]]) -> str:
    """As a text, by Leibniz."""
    terms = list[str]()
    for turn in permutations(range(len(rows))):
        sign = (-1) ** sum(a > b for a, b in combinations(turn, 2))
        terms.append("*".join([f"({sign})", *(f"({rows[i][j]})" for i, j in enumerate(turn))]))
    return " + ".join(terms)


def of_map(tables: Any) -> Iterator[Asked]:
    """Brackets of a map given forward: to an order of a parameter, on a surface, of fewer variables than old ones."""
    claim, space, on = tables["claim"], tables["phase_space"], tables.get("domain", {}).get("on", [])
    explicit, pairs = tables.get("transformation", {}), [*zip(space["q"], space["p"], strict=True)]
    new = [*zip(space["Q"], space["P"], strict=True)]
    if {*explicit} != {"Q", "P"} or {*claim} - {"kind", "order"} or "generating_function" in tables:
        raise Stop("not shown", "a map that isn't given forward, or a scale")
    domain = {"domain": {"where": tables.get("domain", {}).get("where", [])}}
    asked = More(plain({**tables, **domain}))
    check_apart(asked, sides_of(tables), {*space["Q"], *space["P"]})
    asked.texts |= {x: text for side in explicit for x, text in zip(space[side], explicit[side], strict=True)}
    asked.pairs, asked.variables = pairs, [*space["q"], *space["p"], asked.names[-1]]
    asked.known.cache_clear()  # type: ignore
    x = [*space["Q"], *space["P"]]
    for side in explicit.values():
        for text in side:
            check_inner(asked, "", {*space["q"], *space["p"]}, text)
    zeros = [f"bracket({x[i]}, {x[j]}) - {int(j == i + len(new))}" for i, j in combinations(range(len(x)), 2)]
    name, n = claim.get("order", ["", 0])
    said = str([tables.get("domain", {}), tables.get("hamiltonian", {})])
    if name and ({*asked.words.get(name, ())} - {"real"} or re.search(rf"(?<!\w){name}(?!\w)", said)):
        raise Stop("not shown", "a parameter near 0 of which more is said")
    if name and (name in {*asked.names, *asked.texts} or not isinstance(n, int) or n > MOST_ORDER or on):
        raise Stop("not shown", "such an order")
    yield Asked(asked, tuple(zeros), tuple(on), (), ((name, Fraction(0)),) if name else (), (name, n))
