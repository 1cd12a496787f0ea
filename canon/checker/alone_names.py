"""More names of Lie algebras for `alone_lie.py`, and constants with parameters: by exact linear algebra.

Poincaré's algebra is the one of dimension 10 whose radical R is abelian of dimension 4, with so(3,1) left of it, and
one symmetric form on R, up to a factor, that the algebra leaves as it is, which isn't degenerate. By Levi's theorem
there is an so(3,1) in the algebra, and of its real representations of dimension 4 the trivial one has ten such forms,
spinors have none, and only vectors are left.

Bargmann's is the one of dimension 11 with so(3) left of its radical R, D = [R, R] of dimension 4, not all of it fixed,
and [R, D] of dimension 1, the centre Z. D/Z is a representation of dimension 3 that isn't trivial, one of vectors P. So
R/D, which is paired with it, has a vector K, and an E besides, since dimension 4 leaves 1. By the symmetry [P, P] and
[E, P] are 0, [K_i, K_j] = α ε_ijk P_k, [K, E] = β P and [K_i, P_j] = γ δ_ij Z. γ isn't 0 as [R, D] isn't; Jacobi's
identity of the three K is 3 α γ Z = 0; and β isn't 0 as D is all of [R, R].
"""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations, product
from typing import Any

if __package__:
    from canon.checker import alone, alone_lie
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_lie  # type: ignore

Stop = alone.Stop
Vector = list[Fraction]
bracket, kernel, rank, signature, killing = (
    alone_lie.bracket, alone_lie.kernel, alone_lie.rank, alone_lie.signature, alone_lie.killing,
)  # fmt: skip


def units(n: int) -> list[Vector]:
    return [[Fraction(int(i == k)) for k in range(n)] for i in range(n)]


def span(vectors: list[Vector]) -> list[Vector]:
    """Some of these that are independent, and span the same."""
    found = list[Vector]()
    for v in vectors:
        if rank([*found, v]) > len(found):
            found.append(v)
    return found


def images(c: Any, xs: list[Vector], ys: list[Vector]) -> list[Vector]:
    """[X, Y] of two spaces."""
    return span([bracket(c, x, y) for x, y in product(xs, ys)])


def quotient(c: Any, ideal: list[Vector]) -> Any:
    """The constants of what is left of an ideal."""
    basis = span([*ideal, *units(len(c))])
    rest, n = basis[len(ideal) :], len(ideal)
    return [[(alone_lie.solved(basis, bracket(c, x, y)) or [])[n:] for y in rest] for x in rest]


def radical(c: Any) -> list[Vector]:
    """What is orthogonal to [L, L] by the Killing form."""
    n, form = len(c), killing(c)
    derived = images(c, units(n), units(n))
    rows = [[sum((form[i][j] * x[j] for j in range(n)), Fraction(0)) for i in range(n)] for x in derived]
    return kernel(rows, n)


def centre(c: Any) -> list[Vector]:
    n = range(len(c))
    return kernel([[c[i][j][k] for i in n] for j, k in product(n, repeat=2)], len(c))


def left_alone(c: Any, ideal: list[Vector]) -> list[Any]:
    """A basis of the symmetric forms on an abelian ideal that the algebra leaves as they are."""
    n = len(ideal)
    places = {pair: k for k, pair in enumerate((i, j) for i in range(n) for j in range(i, n))}
    rows = list[Vector]()
    for e in units(len(c)):
        moved = [alone_lie.solved(ideal, bracket(c, e, x)) or [] for x in ideal]
        for i, j in places:
            row = [Fraction(0)] * len(places)
            for k in range(n):  # B([e, x_i], x_j) + B(x_i, [e, x_j])
                row[places[min(k, j), max(k, j)]] += moved[i][k]
                row[places[min(k, i), max(k, i)]] += moved[j][k]
            rows.append(row)
    return [[[v[places[min(i, j), max(i, j)]] for j in range(n)] for i in range(n)] for v in kernel(rows, len(places))]


def is_poincare(c: Any) -> bool:
    r = radical(c)
    if len(c) != 10 or len(r) != 4 or any(any(bracket(c, x, y)) for x, y in combinations(r, 2)):
        return False
    forms = left_alone(c, r)
    fits = len(forms) == 1 and sum(signature(forms[0])) == 4
    return fits and signature(killing(quotient(c, r))) == (3, 3)


def is_bargmann(c: Any) -> bool:
    r = radical(c)
    if len(c) != 11 or len(r) != 8 or signature(killing(quotient(c, r))) != (0, 3):
        return False
    d, z = images(c, r, r), centre(c)
    last = images(c, r, d)
    moved = images(c, units(11), d)
    return (len(d), len(last), len(z), rank([*last, *z])) == (4, 1, 1, 1) and len(moved) > 1


NAMES = {"poincare": is_poincare, "poincaré": is_poincare, "iso(3,1)": is_poincare, "iso(1,3)": is_poincare,
    "bargmann": is_bargmann}  # fmt: skip


def is_called(c: Any, name: str) -> bool:
    """Whether the algebra is seen to be the one of this name."""
    if (known := NAMES.get("".join(name.lower().split()))) is None:
        return alone_lie.is_called(c, name)
    alone_lie.check_lie(c)
    return known(c)


# -- constants with parameters

Monomial = tuple[Fraction, dict[str, Fraction]]


def monomial(f: Any) -> Monomial:
    """A formula as a number times powers of names that are positive; the number may be 0."""
    if f.kind == "#":
        return f.of[0], {}
    if f.kind == ".":
        return Fraction(1), {f.of[0]: Fraction(1)}
    if f.kind == "^" and f.of[1].kind == "#":
        (a, powers), r = monomial(f.of[0]), f.of[1].of[0]
        if (a != 1 and r.denominator > 1) or abs(r) > alone.HIGHEST or not (a or r > 0):
            raise Stop("not shown", "constants that are no products")
        return a ** int(r) if r.denominator == 1 else a, {x: k * r for x, k in powers.items()}
    if f.kind not in "+*":
        raise Stop("not shown", "constants that are no products")
    (a, p), (b, q) = map(monomial, f.of)
    if f.kind == "*":
        powers = {x: p.get(x, Fraction(0)) + q.get(x, Fraction(0)) for x in {*p, *q}}
        return a * b, {x: k for x, k in powers.items() if k}
    if a and b and p != q:
        raise Stop("not shown", "constants that are no products")
    return a + b, p if a else q


def at_one(read: Any, n: int, positive: Any) -> Any:
    """The constants where all parameters are 1, if they are these for all positive values, in another basis.

    With e_i times x^w_i for e_i the constant c_ijk has w_i + w_j − w_k more powers of x: for each parameter x some w
    has to fit all constants that aren't 0.
    """
    table = {(i, j, k): monomial(read(i, j, k)) for i, j, k in product(range(n), repeat=3)}
    there = {place: m for place, m in table.items() if m[0]}
    names = {x for _, powers in there.values() for x in powers}
    if names - {*positive}:
        raise Stop("not shown", "constants with parameters that aren't positive")
    for x in names:
        rows = list[Vector]()
        for (i, j, k), (_, powers) in there.items():
            row = [Fraction(int(m == i)) + int(m == j) - int(m == k) for m in range(n)]
            rows.append([*row, powers.get(x, Fraction(0))])
        if rank(rows) != rank([row[:-1] for row in rows]):
            raise Stop("not shown", "the algebra of constants with parameters")
    return [[[table[i, j, k][0] for k in range(n)] for j in range(n)] for i in range(n)]
