"""What claims about Lie algebras ask for: of functions under a bracket, of matrices, of a composition of parameters."""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from itertools import combinations
from typing import Any

from canon.checker.at_zero import evaluated
from canon.checker.case import Case
from canon.checker.defined import assumed, shared, unseen
from canon.checker.functions import Unknown, Unreadable
from canon.checker.lie import Algebra, is_named, is_simple
from canon.checker.linear import rank, solved
from canon.checker.motion import unused
from canon.checker.poisson import bracketed
from canon.checker.positive import is_nowhere_zero, is_positive
from canon.checker.regular import is_regular
from canon.checker.scaled import scaled
from canon.checker.shapes import has_complex, is_rational, is_smooth
from canon.checker.statement import Statement

Pair = tuple[int, int]
Table = dict[Pair, dict[int, int]]
"""Of each pair of the basis the coefficients of its bracket, as formulas."""


def algebra(s: Statement) -> Case:
    """The brackets of the basis are as the structure constants say, the basis is independent, and the name is right."""
    f = s.f
    bracket, _ = bracketed(s, {})
    basis = {name: f.read(text, s.names) for name, text in s.claim["basis"].items()}
    s.written += basis.values()
    e = list(basis.values())
    brackets = {(a, b): bracket(e[a], e[b]) for a, b in combinations(range(len(e)), 2)}
    table = stated(s, list(basis))
    pulled = [s.pull(x) for x in e]
    outside = [[*pulled, s.pull(value)] for value in brackets.values()]
    if table is None:
        return Case([], outside=outside, trusted="the structure constants, which aren't stated")
    zeros = [s.pull(f.sub(value, _combined(s, table.get(pair, {}), e))) for pair, value in brackets.items()]
    labels = [_label(list(basis), pair, table.get(pair, {}), s) for pair in brackets]
    found, trusted = identified(s, table, len(e))
    if found is False and "structure" in s.claim:  # the claim contradicts itself
        return Case([], found=False)
    if s.verdict == "refuted" and found is not False and "structure" not in s.claim:
        zeros, labels = [], []  # other constants than the certificate's may be right
    case = Case(zeros, independent=pulled, found=found, trusted=trusted, outside=outside, labels=labels)
    other = scaled(s, table, len(e))
    return replace(case, algebra=numeric(s, table, len(e)), is_simple=other is not None and is_simple(other))


def _label(names: Sequence[str], pair: Pair, row: Mapping[int, int], s: Statement) -> str:
    terms = " + ".join(f"({s.f.text(c)})*{names[k]}" for k, c in row.items())
    return f"bracket({names[pair[0]]}, {names[pair[1]]})" + (f" - ({terms})" if terms else "")


def _combined(s: Statement, row: Mapping[int, int], e: Sequence[int]) -> int:
    return s.f.add(*(s.f.mul(c, e[k]) for k, c in row.items()))


def stated(s: Statement, names: Sequence[str]) -> Table | None:
    """The structure constants that the claim states; else those that the certificate says it has."""
    given = s.claim.get("structure", s.known.get("structure"))
    if given is None:
        return None
    marks = {name: s.f.node("s", f"#{name}") for name in names}  # a name of the basis may be an abbreviation too
    own = {name: value for name, value in s.names.items() if name not in marks}
    moving = {*s.q, *s.p, *s.Q, *s.P, s.time, *s.bracketed, *s.claim.get("first", ()), *s.claim.get("second", ())}
    table: Table = {}
    for words, text in given.items():
        a, b = (list(names).index(word.strip()) for word in words.split(","))
        value = (s.f.read if "structure" in s.claim else s.f.apart)(text, {**own, **marks})
        row = {k: s.f.slope(value, f"#{name}") for k, name in enumerate(names)}
        zeros = {f"#{name}": s.f.number(0) for name in names}
        if s.f.value(s.f.substitute(value, zeros)) != 0 or any(_has(s, c, marks) for c in row.values()):
            raise Unreadable(f"{text[:40]!r} is no combination of the basis")
        if found := {s.f.ops[x][1] for x in s.f.reach(*row.values()) if s.f.ops[x][0] == "s"} & moving:
            raise Unreadable(f"{min(found)[:40]!r} moves: [e, f] = q e with a coordinate q is no algebra's bracket")
        if any(has_complex(s, c) for c in row.values() if c):
            raise Unknown("structure constants of a real Lie algebra that aren't seen to be real")
        (s.written if "structure" in s.claim else s.added).extend(row.values())
        table[min(a, b), max(a, b)] = {k: c if a < b else s.f.mul(s.f.number(-1), c) for k, c in row.items() if c}
    return table


def _has(s: Statement, a: int, marks: Mapping[str, int]) -> bool:
    return bool({*s.f.reach(a)} & {*marks.values()})


def numeric(s: Statement, table: Table, size: int) -> Algebra | None:
    """The algebra of structure constants that are numbers; None for others."""
    numbers = {p: {k: s.f.value(c) for k, c in row.items()} for p, row in table.items()}
    exact = {p: {k: c for k, c in row.items() if c is not None} for p, row in numbers.items()}
    complete = all(len(exact[p]) == len(row) for p, row in numbers.items())
    return Algebra(size, exact) if complete else None


def identified(s: Statement, table: Table, size: int) -> tuple[bool | None, str]:
    """Whether the algebra is the one that is named, as exact arithmetic knows it; and what is left to trust."""
    algebra, name = numeric(s, table, size) or scaled(s, table, size), s.claim.get("equals")
    if name is None:
        return None, ""
    if algebra is None:
        return None, f"that the algebra is {name} for all values of the parameters"
    answer = is_named(algebra, str(name))
    return answer, "" if answer is not None else f"that an algebra with these structure constants is {name}"


def _is_wrong(s: Statement, zeros: Sequence[int]) -> bool:
    """Whether one of these isn't 0 as a rational function, and so on no open set."""
    rng = random.Random(4)
    if s.surface:
        return False
    for a in zeros:
        names = sorted({op[1] for b in s.f.reach(a) if (op := s.f.ops[b])[0] == "s"})
        free = all(len({*s.words.get(n, ())} - {"real"}) < 2 for n in names)  # of two signs at once it would be 0
        if free and is_rational(s, a) and not {"1j", "pi", *s.fixed} & {*names}:
            with suppress(Unreadable, ZeroDivisionError):
                if s.f.value(s.f.substitute(a, {n: s.f.number(rng.randint(2, 99)) for n in names})):
                    return True
    return False


# -- matrices -----------------------------------------------------------------------------------

Number = tuple[Fraction, Fraction]
"""A Gaussian number: its real and imaginary parts."""
Matrix = list[list[Number]]


def matrix_algebra(s: Statement) -> Case:
    """Matrices of Gaussian numbers under the commutator, or, where it doesn't close over the reals, under −i[A, B]."""
    basis = {name: [[gaussian(s, x) for x in row] for row in rows] for name, rows in s.claim["basis"].items()}
    names, matrices = list(basis), list(basis.values())
    flat = [_flat(m) for m in matrices]
    pairs = list(combinations(range(len(names)), 2))
    if rank(flat) < len(flat):
        return Case([], found=False)
    for turn in ((Fraction(1), Fraction(0)), (Fraction(0), Fraction(-1))):
        values = {(a, b): _commutator(matrices[a], matrices[b], turn) for a, b in pairs}
        rows = {pair: solved(flat, _flat(value)) for pair, value in values.items()}
        if all(row is not None for row in rows.values()):
            return _compared(s, names, {pair: dict(enumerate(row or [])) for pair, row in rows.items()})
    return Case([], found=False)


def _compared(s: Statement, names: Sequence[str], own: dict[Pair, dict[int, Fraction]]) -> Case:
    """The claim's structure constants and its name beside the matrices' own."""
    if "structure" in s.claim:
        table = stated(s, names) or {}
        for pair, row in own.items():
            claimed = {k: s.f.value(c) for k, c in table.get(pair, {}).items()}
            if None in claimed.values():
                raise Unknown("structure constants of matrices with parameters")
            if any(row.get(k, 0) != (claimed.get(k) or 0) for k in {*row, *claimed}):
                return Case([], found=False)
    name = s.claim.get("equals")
    if name is None:
        return Case([], found=True)
    answer = is_named(Algebra(len(names), own), str(name))
    return Case([], found=answer, trusted="" if answer is not None else f"that these matrices span {name}")


def gaussian(s: Statement, text: Any) -> Number:
    """The Gaussian number that a formula is."""
    f, out = s.f, dict[int, Number]()
    target = f.read(text, s.names)
    for a in f.reach(target):
        op, x = f.ops[a], [out[b] for b in f.parts(a)]
        if op == ("s", "1j"):
            out[a] = Fraction(0), Fraction(1)
        elif op[0] == "n":
            out[a] = op[1], Fraction(0)
        elif op[0] == "+":
            out[a] = x[0][0] + x[1][0], x[0][1] + x[1][1]
        elif op[0] == "*":
            out[a] = _times(*x)
        elif op[0] == "^" and 0 < op[2] < 20:
            out[a] = Fraction(1), Fraction(0)
            for _ in range(op[2]):
                out[a] = _times(out[a], x[0])
        else:
            raise Unknown("matrices whose entries are no Gaussian numbers")
    return out[target]


def _times(x: Number, y: Number) -> Number:
    return x[0] * y[0] - x[1] * y[1], x[0] * y[1] + x[1] * y[0]


def _flat(m: Matrix) -> list[Fraction]:
    return [part for row in m for entry in row for part in entry]


def _commutator(A: Matrix, B: Matrix, turn: Number) -> Matrix:
    n = range(len(A))

    def entry(X: Matrix, Y: Matrix, i: int, j: int) -> Number:
        terms = [_times(X[i][k], Y[k][j]) for k in n]
        return sum((t[0] for t in terms), Fraction(0)), sum((t[1] for t in terms), Fraction(0))

    both = [[(entry(A, B, i, j), entry(B, A, i, j)) for j in n] for i in n]
    return [[_times(turn, (x[0] - y[0], x[1] - y[1])) for x, y in row] for row in both]


# -- compositions of parameters -----------------------------------------------------------------


def group(s: Statement) -> Case:
    """θ(a, 0) = a, θ(0, b) = b, θ(θ(a, b), c) = θ(a, θ(b, c)); and C = f_kj − f_jk of the second-order coefficients."""
    f, claim = s.f, s.claim
    if "matrix" in claim:
        raise Unknown("a group that is given by its matrices, without a composition, has no rule in the checker")
    a, b = list(claim["first"]), list(claim["second"])
    c = [unused(f"{name}_third", {*s.declared, *s.names, *a, *b}) for name in b]
    s.declared |= {*a, *b, *c}
    theta = s.keys("composition")
    nodes = {name: f.node("s", name) for name in (*a, *b, *c)}
    zero = {name: f.number(0) for name in (*a, *b)}

    def of(x: Sequence[int], y: Sequence[int]) -> list[int]:
        images = {**dict(zip(a, x, strict=True)), **dict(zip(b, y, strict=True))}
        return [f.substitute(t, images) for t in theta]

    if has_complex(s, *theta):
        raise Unreadable("the parameters of a group are real, and their composition isn't seen to be")
    for x in theta:
        s.without(x, {*s.q, *s.p, *s.Q, *s.P, s.time} - {*a, *b})
    for n in (*a, *b):
        if {*s.words.get(n, ())} - {"real", "nonnegative"} or _is_bound(s, zero, n):
            raise Unreadable(f"{n[:40]!r} may not be 0, where a group has its unit")
    A, B, C = ([nodes[n] for n in group] for group in (a, b, c))
    nothing = [f.number(0)] * len(a)
    zeros = [f.sub(x, y) for x, y in zip([*of(A, nothing), *of(nothing, B)], [*A, *B], strict=True)]
    zeros += [f.sub(x, y) for x, y in zip(of(of(A, B), C), of(A, of(B, C)), strict=True)]
    if not is_regular(s, [*theta, *unseen(s), *shared(s)], zero, own=False):
        raise Unknown("a composition that isn't seen to be smooth where all parameters are 0")
    second: Callable[[int, str, str], int] = lambda t, x, y: f.substitute(f.slope(f.slope(t, x), y), zero)
    table = {
        (j, k): {i: f.sub(second(t, a[k], b[j]), second(t, a[j], b[k])) for i, t in enumerate(theta)}
        for j, k in combinations(range(len(a)), 2)
    }
    claimed = stated(s, a) if "structure" in claim else None
    table = {p: {i: evaluated(s, x) for i, x in row.items()} for p, row in table.items()}
    numbers = {p: {i: f.value(x) for i, x in row.items()} for p, row in table.items()}
    found: bool | None = None
    if claimed is not None:
        for pair, row in numbers.items():
            for i, value in row.items():
                stands = claimed.get(pair, {}).get(i, f.number(0))
                if value is None or f.value(stands) is None:
                    zeros.append(f.sub(table[pair][i], stands))
                elif value != f.value(stands):
                    found = False
    if found is None and s.verdict == "refuted" and _is_wrong(s, zeros):
        found = False
    if found is None:
        found, trusted = identified(s, table, len(a))
        entire = all(is_smooth(s, x, n) for x in theta for n in (*a, *b))
        called = any(f.ops[x][0] == "f" and f.ops[x][1] in f.functions for x in f.reach(*theta))
        against = (
            "" if entire and not called else "that the point speaks of the law near its unit, where it may be another"
        )
        wrong = found is False and s.verdict == "refuted"  # by its algebra, whether it is a law or none
        return Case([] if wrong else zeros, found=found, trusted=trusted, against=against)
    return Case([], found=found)


def _is_bound(s: Statement, zero: Mapping[str, int], name: str) -> bool:
    """Whether what the domain says of a parameter isn't seen to hold where all are 0."""
    f = s.f
    for a, kind in (*s.conditions, *assumed(s)):
        if any(f.ops[b] == ("s", name) for b in f.reach(a)):
            there = f.substitute(a, zero)
            if not (is_nowhere_zero(s, there) if kind == "nonzero" else is_positive(s, there, strict=True, real=True)):
                return True
    return any(f.ops[b] == ("s", name) for b in f.reach(*s.surface))
