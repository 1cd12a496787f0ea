"""Claims about brackets, the canonical one or that of a tensor."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import combinations, combinations_with_replacement

from canon.checker.case import Case
from canon.checker.followed import at_random, is_identity
from canon.checker.functions import Unknown, Unreadable
from canon.checker.stated import texts
from canon.checker.statement import Statement


def bracketed(s: Statement, structure: Mapping[str, str]) -> tuple[Callable[[int, int], int], list[str]]:
    """The claim's own bracket of two functions, the canonical one or that of a tensor, and the latter's coordinates."""
    f, claim = s.f, s.claim
    if "tensor" not in claim and not structure:
        return lambda a, b: f.bracket(a, b, f.pairs), []
    pairs = {tuple(n.strip() for n in pair.split(",")): text for pair, text in structure.items()}
    x = claim.get("coordinates") or list(dict.fromkeys(name for pair in pairs for name in pair))
    if whole_numbers := {*x} & s.fixed:
        raise Unreadable(f"{min(whole_numbers)[:40]!r} is an integer: there is no derivative by it")
    s.declared |= {*x}
    s.bracketed = list(x)
    if "tensor" in claim:
        _check_antisymmetric(s, claim["tensor"])
        entries = {(i, j): f.read(claim["tensor"][i][j], s.names) for i, j in combinations(range(len(x)), 2)}
    else:
        entries = {(x.index(a), x.index(b)): f.read(text, s.names) for (a, b), text in pairs.items()}
        _check_linear(s, entries.values(), x)
    s.written += entries.values()
    _check_variables(s, x)

    def bracket(a: int, b: int) -> int:
        d, mul = f.slope, f.mul
        return f.add(*(mul(T, f.sub(mul(d(a, x[i]), d(b, x[j])), mul(d(a, x[j]), d(b, x[i]))))
                       for (i, j), T in entries.items()))  # fmt: skip

    return bracket, x


def _check_linear(s: Statement, constants: Iterable[int], x: Sequence[str]) -> None:
    """Refuse structure constants that are no combinations of the basis. Raises Unreadable."""
    f, zero = s.f, {name: s.f.number(0) for name in x}
    for a in constants:
        slopes = [f.slope(a, name) for name in x]
        if f.value(f.substitute(a, zero)) != 0 or any(f.ops[b] in [("s", n) for n in x] for b in f.reach(*slopes)):
            raise Unreadable(f"{f.text(a)[:40]!r} is no combination of the basis")


def _check_variables(s: Statement, x: Sequence[str]) -> None:
    """Refuse formulas of other variables than those that the bracket is one of. Raises Unreadable."""
    closed, kind = {*s.q, *s.p, *s.Q, *s.P} - {*x}, dict.get(s.claim, "kind")
    keys = ("f", "g", "h", "functions", "tensor", "basis", *(["structure", "equals"] if kind == "bracket" else []))
    for text in texts([dict.get(s.claim, key) for key in keys]):
        s.without(s.f.read(text, s.names), closed)
    if kind == "conserved":
        s.without(s.H, closed)


def _check_antisymmetric(s: Statement, tensor: Sequence[Sequence[str]]) -> None:
    """Refuse a tensor that isn't antisymmetric, Unreadable, or isn't seen to be so, Unknown."""
    f, everything = s.f, combinations_with_replacement(range(len(tensor)), 2)
    for total in (f.add(f.read(tensor[i][j], s.names), f.read(tensor[j][i], s.names)) for i, j in everything):
        if (f.value(total) or 0) != 0:
            raise Unreadable("a tensor that isn't antisymmetric")
        if not is_identity(at_random(s), total):
            raise Unknown("a tensor that isn't seen to be antisymmetric")


def brackets(s: Statement) -> Case:
    """bracket, jacobi, conserved, involution, casimir."""
    f, kind = s.f, s.claim["kind"]
    b, coordinates = bracketed(s, s.claim.get("structure", {}))
    if kind == "involution":
        labels = [f"bracket(f_{i}, f_{j})" for i, j in combinations(range(1, len(s.claim["functions"]) + 1), 2)]
        return Case([s.pull(b(x, y)) for x, y in combinations(s.keys("functions"), 2)], labels=labels)
    x = s.key("f")
    if kind == "conserved":
        return Case([s.pull(f.add(f.slope(x, s.time), b(x, s.H)))], labels=["D(f, t) + bracket(f, H)"])
    if kind == "casimir":
        if not coordinates:
            raise Unreadable("what commutes with the coordinates of a tensor, which isn't there")
        nodes = [f.node("s", name) for name in coordinates]
        cycles = (f.add(b(x, b(y, z)), b(y, b(z, x)), b(z, b(x, y))) for x, y, z in combinations(nodes, 3))
        return Case([s.pull(a) for a in (*(b(x, y) for y in nodes), *cycles)])
    y = s.key("g")
    if kind == "bracket":
        return Case([s.pull(f.sub(b(x, y), s.key("equals")))], labels=["lhs - rhs"])
    z = s.key("h")
    cycle = "bracket(f, bracket(g, h)) + bracket(g, bracket(h, f)) + bracket(h, bracket(f, g))"
    return Case([s.pull(f.add(b(x, b(y, z)), b(y, b(z, x)), b(z, b(x, y))))], labels=[cycle])
