"""Refutations of claims about matrices and groups, beside `counterexample.py`: structure constants in exact
fractions, and Taylor's coefficients of a composition at 0."""

from __future__ import annotations

import ast
import re
from fractions import Fraction
from itertools import combinations, product
from typing import Any

if __package__:
    from canon.checker.alone import Formula, Stop
    from canon.checker.counterexample import Arithmetic, check, fails, somewhere
    from canon.checker.counterexample_formulas import Writer, put_names
    from canon.checker.counterexample_functions import Place, just
    from canon.checker.counterexample_integrals import claim_with
    from canon.checker.lie_invariants import Invariants, named, structure_of
else:  # as a program's part, beside the other files
    from alone import Formula, Stop  # type: ignore
    from counterexample import Arithmetic, check, fails, somewhere  # type: ignore
    from counterexample_formulas import Writer, put_names  # type: ignore
    from counterexample_functions import Place, just  # type: ignore
    from counterexample_integrals import claim_with  # type: ignore
    from lie_invariants import Invariants, named, structure_of  # type: ignore

BITS, SHARED = 192, ("hamiltonian", "transformation", "generating_function")


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
    of = {**somewhere(asked, {}, 0), **{x: just(Fraction(0)) for x in (*first, *second, *third)}}
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


RULES = {"matrix_algebra": of_matrices, "group": of_group}


def refuted(tables: Any, witness: Any, known: Any) -> tuple[str, str]:
    """Whether the claim fails."""
    if (rule := RULES.get(tables["claim"]["kind"])) is None:
        raise Stop("not shown", "a refutation of such a claim")
    return ("shown", "") if rule(tables, witness, known) else ("not shown", "that something fails")
