"""Which real Lie algebra structure constants make, as far as invariants determine it. All in exact fractions.

An algebra is compared with the one of a name by invariants: the dimension, the signature of the Killing form, the
dimensions of the centre and of [g, g]. Where they differ, it is another one. Where they agree, it is the same one if

- the null space of the Killing form is the centre, and the rest, which is then semisimple (Cartan), has the dimension
  0, 3, 6, 8 or 10: there the signature determines the real form (the complex types are A1, 2 A1, A2, B2);
- or it isn't abelian and has two dimensions; or [g, g] is the centre, of one dimension (Heisenberg);
- or the null space N is abelian, g/N is so(3) and N has three dimensions, on which it acts (e(3)), or g/N is so(3,1)
  and N has four, with a trace form half as large as the Killing form of g/N (vectors; of spinors it is a quarter).
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import combinations, product

from canon.checker.linear import Rows, kernel, rank, signature, solved, unit

Constants = Mapping[tuple[int, int], Mapping[int, Fraction]]
DETERMINED, SIMPLE = (0, 3, 6, 8, 10), (3, 8, 10)
SAME = {
    "su(2)": "so(3)", "usp(2)": "so(3)", "sl(2,R)": "so(2,1)", "sp(2,R)": "so(2,1)", "su(1,1)": "so(2,1)",
    "sl(2,C)": "so(3,1)", "so(3,C)": "so(3,1)", "lorentz": "so(3,1)", "poincare": "iso(3,1)", "e(3)": "iso(3)",
    "e(2)": "iso(2)", "sp(4,R)": "so(3,2)", "so(2)": "u(1)", "usp(4)": "so(5)",
}  # fmt: skip
FORMS = {"su(3)": (8, (0, 8, 0), 0, 8), "su(2,1)": (8, (4, 4, 0), 0, 8), "sl(3,R)": (8, (5, 3, 0), 0, 8)}
_NAMED = re.compile(r"(so|iso|heisenberg)\(([1-9])(?:, ?([1-9]))?\)")
Invariants = tuple[int, tuple[int, int, int], int, int]
"""Dimension; positive, negative and zero squares of the Killing form; dimensions of the centre and of [g, g]."""


class Algebra:
    """Structure constants [e_a, e_b] = Σ C^c_ab e_c, for pairs a < b."""

    def __init__(self, size: int, constants: Constants) -> None:
        self.size = size
        zero = [Fraction(0)] * size
        self.table = {(a, b): list(zero) for a in range(size) for b in range(size)}
        for (a, b), row in constants.items():
            for c, x in row.items():
                self.table[a, b][c], self.table[b, a][c] = x, -x

    def bracket(self, x: Sequence[Fraction], y: Sequence[Fraction]) -> list[Fraction]:
        """[x, y] of vectors of components."""
        pairs = [(a, b, u * v) for a, u in enumerate(x) if u for b, v in enumerate(y) if v]
        return [sum((w * self.table[a, b][c] for a, b, w in pairs), Fraction(0)) for c in range(self.size)]

    def is_lie(self) -> bool:
        """Jacobi's identity."""
        sparse = {pair: [(c, x) for c, x in enumerate(row) if x] for pair, row in self.table.items()}
        for a, b, c in combinations(range(self.size), 3):
            total: dict[int, Fraction] = {}
            for i, j, k in ((a, b, c), (b, c, a), (c, a, b)):
                for d, x in sparse[j, k]:
                    for e, y in sparse[i, d]:
                        total[e] = total.get(e, Fraction(0)) + x * y
            if any(total.values()):
                return False
        return True

    def killing(self) -> Rows:
        """tr(ad e_a ad e_b)."""
        n, t = range(self.size), self.table
        ad = [[(c, d, t[a, d][c]) for c, d in product(n, n) if t[a, d][c]] for a in n]
        return [[sum((x * t[b, c][d] for c, d, x in ad[a]), Fraction(0)) for b in n] for a in n]

    def invariants(self) -> Invariants:
        """What an isomorphism keeps."""
        n = range(self.size)
        centre = self.size - rank([[self.table[a, b][c] for a in n] for b in n for c in n])
        derived = rank([self.table[a, b] for a, b in combinations(n, 2)])
        return self.size, signature(self.killing()), centre, derived

    def quotient(self, ideal: Rows) -> Algebra | None:
        """The algebra modulo an ideal; None where the rows don't span one."""
        basis = list(ideal)
        for e in unit(self.size):
            if rank([*basis, e]) > len(basis):
                basis.append(e)
        k, n = len(ideal), self.size
        new = {}
        for a, b in combinations(range(n), 2):
            row = solved(basis, self.bracket(basis[a], basis[b])) or [Fraction(0)] * n
            if a < k and any(row[k:]):
                return None
            if a >= k:
                new[a - k, b - k] = dict(enumerate(row[k:]))
        return Algebra(n - k, new)

    def is_determined(self) -> bool:
        """Whether the invariants leave only one algebra: see above."""
        size, (plus, minus, zero), centre, derived = self.invariants()
        N = kernel(self.killing())
        central = all(not any(self.bracket(e, x)) for x in N for e in unit(size))
        if zero == len(N) and central:
            return size - zero in DETERMINED
        if size == 2 or (derived == centre == 1 and plus + minus == 0):
            return True
        rest = self.quotient(N) if all(not any(self.bracket(x, y)) for x, y in combinations(N, 2)) else None
        if rest is None or not any(any(self.bracket(e, x)) for x in N for e in unit(size)):
            return False
        if rest.invariants() == (3, (0, 3, 0), 0, 3):
            return len(N) == 3
        own = rest.killing()  # the whole form is that of g/N and the trace form of N
        basis = [e for e in unit(size) if rank([*N, e]) > len(N)][: rest.size]
        if rest.invariants() != (6, (3, 3, 0), 0, 6) or len(N) != 4 or rank([*N, *basis]) < size:
            return False
        whole = self.killing()
        given = [[sum(x * y * whole[a][b] for a, x in enumerate(u) if x for b, y in enumerate(v) if y) for v in basis]
                 for u in basis]  # fmt: skip
        return all(2 * (w - k) == k for r, q in zip(given, own, strict=True) for w, k in zip(r, q, strict=True))


def is_named(algebra: Algebra, name: str) -> bool | None:
    """Whether the algebra is the one of a name: True, False, or None where the invariants don't tell."""
    if not algebra.is_lie():
        return False
    wanted = named(name)
    if wanted is None:
        return None
    if isinstance(wanted, Algebra) and algebra.table == wanted.table:
        return True
    found = algebra.invariants()
    if found != (wanted.invariants() if isinstance(wanted, Algebra) else wanted):
        return False
    return True if algebra.is_determined() else None


def is_simple(algebra: Algebra) -> bool:
    """Whether structure constants are those of a simple algebra, as the invariants tell."""
    found = signature(algebra.killing())
    return algebra.is_lie() and not found[2] and (algebra.size in SIMPLE or found == (3, 3, 0))


def named(name: str) -> Algebra | Invariants | None:
    """The algebra of a name, or its invariants; None for a name that isn't known here."""
    parts = [SAME.get(part.strip(), part.strip()) for part in name.split("+")]
    if len(parts) > 1:
        found = [x for part in parts if isinstance(x := named(part), Algebra)]
        return total(found) if len(found) == len(parts) else None
    (word,) = parts
    if word in FORMS:
        return FORMS[word]
    found = _NAMED.fullmatch(word)
    head, numbers = (found[1], [int(n) for n in found.groups()[1:] if n]) if found else ("", [])
    if word == "u(1)":
        return Algebra(1, {})
    if word in ("u(2)", "u(3)"):
        n = int(word[2]) ** 2
        return n, (0, n - 1, 1), 1, n - 1
    if word == "aff(1)":
        return Algebra(2, {(0, 1): {1: Fraction(1)}})
    if head == "heisenberg" and len(numbers) == 1:
        n = numbers[0]
        return Algebra(2 * n + 1, {(2 * k, 2 * k + 1): {2 * n: Fraction(1)} for k in range(n)})
    if word in ("galilei", "bargmann"):
        return galilei(mass=word == "bargmann")
    if head in ("so", "iso") and numbers and len(numbers) <= 2 and sum(numbers) <= 6:
        return orthogonal([1] * numbers[0] + [-1] * sum(numbers[1:]), translations=head == "iso")
    return None


def orthogonal(metric: Sequence[int], *, translations: bool) -> Algebra:
    """so(p, q): [M_ij, M_kl] = g_jk M_il − g_ik M_jl − g_jl M_ik + g_il M_jk; with P_i it is iso(p, q)."""
    n = len(metric)
    pairs = list(combinations(range(n), 2))
    place = {pair: k for k, pair in enumerate(pairs)}
    table: dict[tuple[int, int], dict[int, Fraction]] = {}

    def add(row: dict[int, Fraction], i: int, j: int, x: int) -> None:
        if i != j and x:
            k = place[min(i, j), max(i, j)]
            row[k] = row.get(k, Fraction(0)) + (x if i < j else -x)

    for (a, (i, j)), (b, (k, m)) in combinations(enumerate(pairs), 2):
        row = table.setdefault((a, b), {})
        for meets, at, first, second, sign in (
            (j == k, k, i, m, 1), (i == k, k, j, m, -1), (j == m, m, i, k, -1), (i == m, m, j, k, 1)
        ):  # fmt: skip
            add(row, first, second, sign * metric[at] * meets)
    if translations:
        for (a, (i, j)), k in product(enumerate(pairs), range(n)):
            row = table.setdefault((a, len(pairs) + k), {})
            if j == k:
                row[len(pairs) + i] = Fraction(metric[j])
            if i == k:
                row[len(pairs) + j] = Fraction(-metric[i])
    return Algebra(len(pairs) + n * translations, table)


def galilei(*, mass: bool) -> Algebra:
    """J, K, P, E: rotations of the vectors J, K, P, [K_i, E] = P_i; with the mass in the centre, [K_i, P_i] = m."""
    one = Fraction(1)
    table: dict[tuple[int, int], dict[int, Fraction]] = {(3 + i, 9): {6 + i: one} for i in range(3)}
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        table[min(i, j), max(i, j)] = {k: one if i < j else -one}
        for vector in (3, 6):
            table[i, vector + j], table[j, vector + i] = {vector + k: one}, {vector + k: -one}
        if mass:
            table[3 + i, 6 + i] = {10: one}
    return Algebra(10 + mass, table)


def total(parts: Sequence[Algebra]) -> Algebra:
    """The direct sum."""
    table, start = dict[tuple[int, int], dict[int, Fraction]](), 0
    for part in parts:
        for a, b in combinations(range(part.size), 2):
            table[a + start, b + start] = {c + start: x for c, x in enumerate(part.table[a, b]) if x}
        start += part.size
    return Algebra(start, table)
