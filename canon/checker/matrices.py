"""What claims about matrices, fields and inequalities ask for."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

from canon.checker.case import Case
from canon.checker.functions import Unreadable
from canon.checker.shapes import has_complex
from canon.checker.statement import Statement

Rows = list[list[int]]


def _read(s: Statement, rows: Sequence[Sequence[Any]]) -> Rows:
    found = [[s.f.read(text, s.names) for text in row] for row in rows]
    s.written += [entry for row in found for entry in row]
    return found


def _product(s: Statement, *matrices: Rows) -> Rows:
    total = matrices[0]
    for m in matrices[1:]:
        columns = list(zip(*m, strict=True))
        total = [[s.f.add(*(s.f.mul(a, b) for a, b in zip(row, c, strict=True))) for c in columns] for row in total]
    return total


def _differences(s: Statement, left: Rows, right: Rows) -> list[int]:
    pairs = zip((x for row in left for x in row), (y for row in right for y in row), strict=True)
    return [s.pull(s.f.sub(x, y)) for x, y in pairs]


def _one(s: Statement, size: int) -> Rows:
    return [[s.f.number(int(i == j)) for j in range(size)] for i in range(size)]


def invariant_interval(s: Statement) -> Case:
    """ΛᵀgΛ = g, and Λ · inverse = 1."""
    L, g = _read(s, s.claim["matrix"]), _read(s, s.claim["metric"])
    zeros = _differences(s, _product(s, [list(c) for c in zip(*L, strict=True)], g, L), g)
    if "inverse" in s.claim:
        zeros += _differences(s, _product(s, L, _read(s, s.claim["inverse"])), _one(s, len(L)))
    return Case(zeros)


def matrix_group(s: Statement) -> Case:
    """M(a) M(b) = M(θ(a, b)), and M(a) M(inverse) = 1."""
    f, a, b = s.f, list(s.claim["first"]), list(s.claim["second"])
    s.declared |= {*a, *b}
    M, theta = _read(s, s.claim["matrix"]), s.keys("composition")
    for x in (x for row in M for x in row):
        s.without(x, b)

    kept = [(x, kind) for x, kind in s.conditions if {("s", n) for n in a} & {f.ops[k] for k in f.reach(x)}]

    def at(values: Sequence[int]) -> Rows:
        images = dict(zip(a, values, strict=True))
        for n, x in images.items():
            s.conditions += _as_assumed(s, n, x)
        s.conditions += [(f.substitute(x, images), kind) for x, kind in kept]
        moved = [[f.substitute(x, images) for x in row] for row in M]
        s.written += [x for row in moved for x in row]
        return moved

    zeros = _differences(s, _product(s, M, at([f.node("s", x) for x in b])), at(theta))
    if "inverse" in s.claim:
        zeros += _differences(s, _product(s, M, at(s.keys("inverse"))), _one(s, len(M)))
    return Case(zeros)


def _as_assumed(s: Statement, name: str, value: int) -> Iterator[tuple[int, str]]:
    """What a value in a name's place has to be; Unreadable where it isn't seen to be whole, or real, as the name is."""
    f, words = s.f, {*s.words.get(name, ())}
    inside = [f.ops[k] for k in f.reach(value)]
    known = all(op[0] in "s+*" or (op[0] == "n" and op[1].denominator == 1) for op in inside)
    whole = known and all("integer" in s.words.get(op[1], ()) for op in inside if op[0] == "s")
    if ("integer" in words and not whole) or ("complex" not in words and has_complex(s, value)):
        raise Unreadable(f"{name[:40]!r} is whole, or real, and what stands in its place isn't seen to be")
    for word in words & {"positive", "nonnegative", "negative", "nonzero"}:
        x = f.mul(f.number(-1), value) if word == "negative" else value
        yield x, "nonzero" if word == "nonzero" else "positive"


def field_equations(s: Statement) -> Case:
    """Σ (−1)^|α| D^α ∂L/∂(D^α u) are the equations, one for each field u."""
    f, L, equations = s.f, s.key("L"), s.keys("equations")
    zeros = []
    if len({*s.claim["fields"]}) < len(s.claim["fields"]):
        raise Unreadable("a field stands twice")
    for text, equation in zip(s.claim["fields"], equations, strict=True):
        op = f.ops[f.read(text, {})]
        if op[0] != "f" or op[1] not in f.functions or any(f.ops[x][0] != "s" for x in op[3]) or any(op[2]):
            raise Unreadable(f"{text[:40]!r} is no function of names")
        jets = [x for x in f.reach(L) if f.ops[x][0] == "f" and f.ops[x][1] == op[1]]
        if not jets:
            raise Unreadable(f"L has nothing of {text[:40]!r} in it")
        if len({*op[3]}) < len(op[3]) or any(f.ops[x][3] != op[3] for x in jets):
            raise Unreadable(f"{text[:40]!r} is a function of different names, and of these everywhere")
        marks = {x: f"#jet{x}" for x in jets}
        free, back = _marked(s, L, marks), {mark: x for x, mark in marks.items()}
        total = [f.mul(f.number(-1), equation)]
        for x, mark in marks.items():
            slope = f.substitute(f.slope(free, mark), back)
            for argument, order in zip(op[3], f.ops[x][2], strict=True):
                for _ in range(order):
                    slope = f.slope(slope, f.ops[argument][1])
            total.append(f.mul(f.number((-1) ** sum(f.ops[x][2])), slope))
        zeros.append(s.pull(f.add(*total)))
    return Case(zeros)


def _marked(s: Statement, target: int, marks: dict[int, str]) -> int:
    """The formula with names in place of these nodes."""
    new: dict[int, int] = {}
    for a in s.f.reach(target):
        parts = [new[b] for b in s.f.parts(a)]
        new[a] = s.f.node("s", marks[a]) if a in marks else s.f.rebuilt(a, parts)
    return new[target]


def inequality(s: Statement) -> Case:
    """lhs < rhs, and so on: the difference is positive, or nowhere negative."""
    lhs, rhs, sign = s.key("lhs"), s.key("rhs"), s.claim["relation"]
    if sign not in ("<", "<=", ">", ">="):
        raise Unreadable(f"{sign!r} is no relation")
    small, large = (lhs, rhs) if "<" in sign else (rhs, lhs)
    return Case([], positive=[(s.pull(s.f.sub(large, small)), "=" not in sign)])


KINDS: dict[str, Callable[[Statement], Case]] = {
    "invariant_interval": invariant_interval,
    "matrix_group": matrix_group,
    "field_equations": field_equations,
    "inequality": inequality,
}
