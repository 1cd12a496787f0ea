"""Refutations of claims about Lie algebras and groups, beside `counterexample.py`.

A bracket that isn't in the span of the basis: a determinant of values at as many points, and one more, isn't 0. An algebra of
another name: its structure constants, which the claim or the certificate states, are seen to be right by `alone.py`'s
random points, and an invariant, computed in fractions, isn't that of the named algebra. A group: Taylor's coefficients at 0.
"""

from __future__ import annotations

import ast
import re
from contextlib import suppress
from fractions import Fraction
from itertools import combinations, product
from random import Random
from typing import Any

if __package__:
    from canon.checker.alone import Formula, Stop
    from canon.checker.alone_wider import Wider
    from canon.checker.counterexample import (
        NONE, Arithmetic, Interval, Open, check, check_domain, fails, somewhere,
    )  # fmt: skip
    from canon.checker.counterexample_formulas import Writer, inner_names, is_nought, put_names
    from canon.checker.counterexample_functions import Place
    from canon.checker.counterexample_integrals import claim_with
    from canon.checker.counterexample_kinds import Asked, guesses
    from canon.checker.counterexample_vanishing import vanish
    from canon.checker.lie_invariants import Invariants, named, structure_of
else:  # as a program's part, beside the other files
    from alone import Formula, Stop  # type: ignore
    from alone_wider import Wider  # type: ignore
    from counterexample import (  # type: ignore
        NONE, Arithmetic, Interval, Open, check, check_domain, fails, somewhere,
    )  # fmt: skip
    from counterexample_formulas import Writer, inner_names, is_nought, put_names  # type: ignore
    from counterexample_functions import Place  # type: ignore
    from counterexample_integrals import claim_with  # type: ignore
    from counterexample_kinds import Asked, guesses  # type: ignore
    from counterexample_vanishing import vanish  # type: ignore
    from lie_invariants import Invariants, named, structure_of  # type: ignore

BITS, SETS, FARTHEST = 192, 4, 8
SHARED = ("hamiltonian", "transformation", "generating_function")
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
    here = Place(asked, {**parameters, **{x: (Fraction(0),) * 2 for x in basis}}, point.real)
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


def of_matrices(tables: Any, witness: Any, known: Any) -> bool:
    """Matrices of numbers: another algebra than is named, or other structure constants."""
    del witness, known
    claim = tables["claim"]
    basis = [*claim["basis"]]
    matrices = [[[gaussian(x) for x in row] for row in claim["basis"][name]] for name in basis]
    if len({len(row) for a in matrices for row in (a, *a)}) != 1:
        raise Stop("not shown", "matrices of several sizes")
    found = structure_of(matrices)
    if found is None:
        return True  # it doesn't close, or isn't independent
    if "equals" in claim and Invariants.of(found) != named(claim["equals"]):
        return True
    for pair, text in claim.get("structure", {}).items():
        a, b = (basis.index(name.strip()) for name in pair.split(","))
        if found[a][b] != combination(text, basis):
            return True
    return False


def combination(text: str, basis: list[str]) -> list[Fraction]:
    """The coefficients of a sum of names with rational factors."""
    parts = re.findall(r"([+-]?)(?:(\d+(?:/\d+)?)\*)?([^\W\d]\w*)", re.sub(r"\s", "", text))
    plain = "".join(f"{sign}{r + '*' if r else ''}{name}" for sign, r, name in parts)
    if re.sub(r"\s", "", text) not in (plain, "0") or not all(name in basis for *_, name in parts):
        raise Stop("not shown", "structure constants of another form")
    found = [Fraction(0)] * len(basis)
    for sign, r, name in parts:
        found[basis.index(name)] += Fraction(r or 1) * (-1 if sign == "-" else 1)
    return found


def gaussian(text: Any) -> tuple[Fraction, Fraction]:
    """A complex number with rational parts, by a text of numbers, +, −, *, / and the imaginary unit."""
    def of(at: Any) -> tuple[Fraction, Fraction]:
        if isinstance(at, ast.Constant):
            said = ast.get_source_segment(str(text), at) or ""
            if len(said) > 200 or re.search("[eE_]", said):
                raise Stop("not shown", "a number of another form")
            return (Fraction(0), Fraction(said[:-1])) if said[-1:] in "jJ" else (Fraction(said), Fraction(0))
        if isinstance(at, ast.UnaryOp):
            a, b = of(at.operand)
            return (-a, -b) if isinstance(at.op, ast.USub) else (a, b)
        if isinstance(at, ast.BinOp) and isinstance(at.op, ast.Add | ast.Sub | ast.Mult | ast.Div):
            (a, b), (c, d) = of(at.left), of(at.right)
            if isinstance(at.op, ast.Add | ast.Sub):
                sign = 1 if isinstance(at.op, ast.Add) else -1
                return a + sign * c, b + sign * d
            size = c * c + d * d
            if isinstance(at.op, ast.Div):
                c, d = c / size, -d / size
            return a * c - b * d, a * d + b * c
        raise Stop("not shown", "a matrix that isn't one of numbers")

    return of(ast.parse(str(text).strip(), mode="eval").body)


def of_group(tables: Any, witness: Any, known: Any) -> bool:
    """A composition that isn't associative, or whose structure constants are others: by derivatives at 0."""
    del witness, known
    claim = tables["claim"]
    first, second = claim["first"], claim["second"]
    if {*SHARED} & {*tables} or tables.get("domain") or "composition" not in claim or len(first) != len(second):
        raise Stop("not shown", "a group beside other sections, or of matrices")
    words = tables.get("symbols", {})
    if any(words.get(name, "real") not in ("real", ["real"]) for name in (*first, *second)):
        raise Stop("not shown", "parameters that have signs")
    n, third = range(len(first)), [f"#c{k}" for k in range(len(first))]
    asked = claim_with(tables, [*first, *second], {f"_t{k}": text for k, text in enumerate(claim["composition"])})
    of = {**somewhere(asked, {}, 0), **{x: (Fraction(0),) * 2 for x in (*first, *second, *third)}}
    point = Place(asked, of, Arithmetic(BITS))
    for name, said in asked.words.items():
        if "function" not in said:
            check(point.named(name), said)
    write = Writer(asked)
    theta = [write.written(asked.known(f"_t{k}")) for k in n]
    for f in write.under:  # what D(…, a) is of has a value there
        point.at(f)
    slope = lambda k, a, b: point.at(theta[k], a, b)
    for i, j in combinations(n, 2):
        stated = [(a, b, text) for pair, text in claim.get("structure", {}).items()
                  for a, b in [tuple(first.index(x.strip()) for x in pair.split(","))] if {a, b} == {i, j}]  # fmt: skip
        if "structure" not in claim:
            break
        right = combination(stated[0][2], first) if stated else [Fraction(0)] * len(first)
        sign = -1 if stated and stated[0][0] == j else 1
        for k in n:
            x, y = slope(k, first[j], second[i]), slope(k, first[i], second[j])
            if fails(point.real.add(x, (-y[1] - sign * right[k], -y[0] - sign * right[k])), ""):
                return True
    a, b = (dict(zip(names, map(name_of, names), strict=True)) for names in (first, second))
    inner = {x: theta[k] for k, x in enumerate(first)} | {x: name_of(third[k]) for k, x in enumerate(second)}
    shifted = {x: b[second[k]] for k, x in enumerate(first)} | {x: name_of(third[k]) for k, x in enumerate(second)}
    outer = a | {x: put_names(theta[k], shifted) for k, x in enumerate(second)}
    for k in n:
        gap = asked.read("a - b", {"a": put_names(theta[k], inner), "b": put_names(theta[k], outer)})
        for names in product(first, second, third):
            if fails(point.at(gap, *names), ""):
                return True
    return False


def name_of(name: str) -> Formula:
    """The formula that is a name."""
    return Formula(".", (name,))


RULES = {"algebra": of_algebra, "matrix_algebra": of_matrices, "group": of_group}


def refuted(tables: Any, witness: Any, known: Any) -> tuple[str, str]:
    """Whether the claim fails."""
    if (rule := RULES.get(tables["claim"]["kind"])) is None:
        raise Stop("not shown", "a refutation of such a claim")
    tables = {key: x for key, x in tables.items() if key not in ("title", "source")}
    try:
        return ("shown", "") if rule(tables, witness, known) else ("not shown", "that something fails")
    except Open as left:
        return "not shown", str(left)
