"""Refutations of claims about Lie algebras and groups, beside `counterexample.py`.

A bracket that isn't in the span of the basis: a determinant of values at as many points, and one more, isn't 0. An
algebra of another name: its structure constants, which the certificate states, are seen to be right by `alone.py`'s
random points, and an invariant, computed in fractions, isn't that of the named algebra.
"""

from __future__ import annotations

import re
from contextlib import suppress
from fractions import Fraction
from itertools import combinations
from random import Random
from typing import Any

if __package__:
    from canon.checker.alone import Formula, Stop
    from canon.checker.alone_wider import Wider
    from canon.checker.counterexample import (
        NONE,
        Arithmetic,
        Interval,
        Open,
        check_domain,
        fails,
        somewhere,
    )  # fmt: skip
    from canon.checker.counterexample_formulas import Writer, inner_names, is_nought
    from canon.checker.counterexample_functions import Place, just
    from canon.checker.counterexample_kinds import guesses
    from canon.checker.counterexample_maps import Asked
    from canon.checker.counterexample_vanishing import vanish
    from canon.checker.lie_invariants import Invariants, named
else:  # as a program's part, beside the other files
    from alone import Formula, Stop  # type: ignore
    from alone_wider import Wider  # type: ignore
    from counterexample import (  # type: ignore
        NONE,
        Arithmetic,
        Interval,
        Open,
        check_domain,
        fails,
        somewhere,
    )  # fmt: skip
    from counterexample_formulas import Writer, inner_names, is_nought  # type: ignore
    from counterexample_functions import Place, just  # type: ignore
    from counterexample_kinds import guesses  # type: ignore
    from counterexample_maps import Asked  # type: ignore
    from counterexample_vanishing import vanish  # type: ignore
    from lie_invariants import Invariants, named  # type: ignore

BITS, SETS, FARTHEST = 192, 4, 8
PLAIN = {"keys": "f g equals", "zeros": ["bracket(f, g) - equals"]}
OWN = {"keys": "f g equals tensor coordinates", "names": "coordinates", "among": "q p",
    "of": {"f equals g tensor": "coordinates t"}, "besides": ["tensor_ij + tensor_ji"],
    "zeros": ["bracket(f, g) - equals"]}  # fmt: skip


def brackets(tables: Any) -> Any:
    """The claim's bracket and basis: a claim with texts `_b0`, `_b1`, …, in the variables of the bracket."""
    claim = tables["claim"]
    if {"transformation", "generating_function"} & {*tables} or "structure" in claim:
        raise Stop("not shown", "an algebra beside a map, or with structure constants")
    form, own = (OWN, {key: claim[key] for key in ("tensor", "coordinates")}) if "tensor" in claim else (PLAIN, {})
    domain = {"domain": {"where": tables.get("domain", {}).get("where", [])}}
    said = {"kind": "bracket", "f": "0", "g": "0", "equals": "0", **own}
    asked = Wider({**tables, **domain, "claim": said}, form)
    if {*claim["basis"]} & {*asked.words, *asked.names}:
        raise Stop("not shown", "a name with two meanings")
    for k, text in enumerate(claim["basis"].values()):
        asked.texts[f"_b{k}"] = text
    return asked


def leaves_span(tables: Any, witness: Any) -> bool:
    """Whether a bracket of two of the basis isn't a combination of it with constant coefficients."""
    if tables.get("domain", {}).get("on"):
        raise Stop("not shown", "an algebra on a surface")
    asked, n = brackets(tables), len(tables["claim"]["basis"])
    moving, rng = {*asked.names}, Random(1)
    first = somewhere(asked, witness, 0)
    basis, tried = list[Place](), 0
    while len(basis) < n + 1:
        tried += 1
        if tried > 40 * (n + 1):
            raise Open("points of the domain")
        of = {x: y if x not in moving or not isinstance(y, tuple) or x == asked.names[-1] else
              (y[0] * (1 + Fraction(rng.randint(-FARTHEST, FARTHEST), 2 * FARTHEST + 1)),) * 2
              for x, y in first.items()}  # fmt: skip
        point = Place(asked, of, Arithmetic(BITS))
        with suppress(Open):
            check_domain(point, {"hamiltonian": tables.get("hamiltonian", {})})
            for k in range(n):
                point.text(f"_b{k}")
            basis.append(point)
    for i, j in combinations(range(n), 2):
        rows = [[*(point.text(f"_b{k}") for k in range(n)), point.text(f"bracket(_b{i}, _b{j})")] for point in basis]
        with suppress(Open):
            if is_regular(rows, basis[0].real):
                return True
    return False


def is_regular(rows: list[list[Interval]], real: Arithmetic) -> bool:
    """Whether the determinant of a matrix isn't 0, by elimination. Raises Open where that isn't seen."""
    rows = [[*row] for row in rows]
    for k in range(len(rows)):
        best = max(range(k, len(rows)), key=lambda m: min(map(abs, rows[m][k])) if fails(rows[m][k], "") else -1)
        if not fails(rows[best][k], ""):
            raise Open("that a determinant isn't 0")
        rows[k], rows[best] = rows[best], rows[k]
        inverse = real.power(rows[k][k], -1)
        for m in range(k + 1, len(rows)):
            ratio = real.times(rows[m][k], inverse)
            for c in range(k, len(rows)):
                low, high = real.times(ratio, rows[k][c])
                rows[m][c] = real.add(rows[m][c], (-high, -low))
    return True


def of_algebra(tables: Any, witness: Any, known: Any) -> bool:
    """The functions don't close, or close as another algebra."""
    claim = tables["claim"]
    if "equals" not in claim:
        raise Stop("not shown", "an algebra without a name")
    if isinstance(witness, dict):
        return leaves_span(tables, witness)
    constants = known["structure"]
    asked, basis, on = brackets(tables), [*claim["basis"]], tables.get("domain", {}).get("on", [])
    texts = list[str]()
    rows = dict[tuple[int, int], str]()
    for pair, text in constants.items():
        a, b = (name.strip() for name in pair.split(","))
        i, j = basis.index(a), basis.index(b)
        if i == j or (i, j) in rows or (j, i) in rows:
            raise Stop("not shown", "pairs that stand twice")
        rows[i, j] = named_by(text, basis)
    for i, j in combinations(range(len(basis)), 2):
        right = rows.get((i, j)) or (f"-({rows[j, i]})" if (j, i) in rows else "0")
        texts.append(f"bracket(_b{i}, _b{j}) - ({right})")
    solved = on_surface(asked, on)
    named_ones = named(claim["equals"])
    own = {f"_b{k}": Formula(".", (f"#b{k}",)) for k in range(len(basis))}
    coefficients = {pair: asked.read(text, own) for pair, text in rows.items()}
    for of in guesses(Asked(asked, ()), None):
        point = Place(asked, {n: x for n, x in of.items() if n != solved}, Arithmetic(BITS))
        with suppress(Open):
            check_domain(point, {"hamiltonian": tables.get("hamiltonian", {})})
            for text in texts:
                point.text(text)
            found = exactly(asked, point, coefficients, len(basis))
            if found is not None and Invariants.of(found) != named_ones and vanish(asked, texts):
                return True
    return False


def named_by(text: str, basis: list[str]) -> str:
    """A combination of the basis, with `_b0`, `_b1`, … for its names."""
    return re.sub(r"(?<![\w.])[^\W\d]\w*", lambda m: f"_b{basis.index(m[0])}" if m[0] in basis else m[0], text)


def on_surface(asked: Any, on: list[str]) -> str | None:
    """The one equation of a surface is solved for a name that is no variable of the bracket and stands in it linearly;
    derivatives are taken before, as of any other constant."""
    if not on:
        return None
    moving = {x for pair in asked.pairs for x in pair} | {*asked.names}
    used = {n for text in on for n in re.findall(r"\w+", str([text, *asked.texts.values()]))}
    for name in (n for n in asked.words if n in used and n not in moving and n not in asked.texts):
        if len(on) != 1:
            raise Stop("not shown", "a surface of several equations")
        write = Writer(asked)
        f = write.written(asked.known(on[0]))
        first = write.slope(f, name)
        if not write.under and is_nought(write.slope(first, name)):
            low, high = (f"_with({on[0]}, {name}, {k})" for k in (0, 1))
            asked.texts[name] = f"-({low})/(({high}) - ({low}))"
            asked.variables = [*asked.variables, name]
            asked.known.cache_clear()
            return name
    raise Stop("not shown", "a surface that isn't solved for a constant")


def exactly(asked: Any, point: Place, coefficients: Any, n: int) -> Any:
    """The structure constants as fractions, at the point's parameters; None where they aren't such, or the texts aren't
    linear in the basis as they stand."""
    found, write = [[[Fraction(0)] * n for _ in range(n)] for _ in range(n)], Writer(asked)
    parameters = {name: x for name, x in point.of.items() if name not in asked.names}
    basis = [f"#b{k}" for k in range(n)]
    here = Place(asked, {**parameters, **{x: just(Fraction(0)) for x in basis}}, point.real)
    for (i, j), text in coefficients.items():
        f = write.written(text)
        slopes = [write.slope(f, x) for x in basis]
        if write.under or any({*basis, *asked.names} & inner_names(x, asked) for x in slopes) or here.at(f) != NONE:
            return None
        for k, x in enumerate(slopes):
            low, high = here.at(x)
            if low != high:
                return None
            found[i][j][k], found[j][i][k] = low, -low
    return found


RULES = {"algebra": of_algebra}


def refuted(tables: Any, witness: Any, known: Any) -> tuple[str, str]:
    """Whether the claim fails."""
    if (rule := RULES.get(tables["claim"]["kind"])) is None:
        raise Stop("not shown", "a refutation of such a claim")
    return ("shown", "") if rule(tables, witness, known) else ("not shown", "that something fails")
