"""Real Lie algebras by exact structure constants, and algebras of matrices: `python alone_lie.py CERTIFICATE.json …`

With [e_i, e_j] = Σ c_ijk e_k the Killing form is tr(ad e_i ad e_j), whose signature is found by completing squares. The
names that are known are those that it settles. A real semisimple algebra of dimension 3, 6, 8, 9 or 10 is told from all
others by its signature. Where the form vanishes on the centre alone the algebra is the sum of its centre and a
semisimple one. Where it vanishes on an abelian ideal of dimension 3 that isn't central, and what is left is so(3), the
algebra is e(3): a real representation of so(3) of dimension 3 is trivial or that of vectors. Heisenberg's has a centre
of dimension 1 that is all of [L, L]; the one of dimension 2 that isn't abelian is aff(1).
"""

from __future__ import annotations

import ast
import re
from fractions import Fraction
from itertools import combinations, product
from typing import Any

if __package__:
    from canon.checker import alone
else:  # as a program, beside the other files
    import alone  # type: ignore

Stop = alone.Stop
Constants = list[list[list[Fraction]]]
Matrix = list[list[Fraction]]
SETTLED, LARGEST = (0, 3, 6, 8, 9, 10), 16
SEMISIMPLE = {
    "so(3)": (0, 3), "su(2)": (0, 3), "usp(2)": (0, 3), "sl(2,r)": (2, 1), "sl(2)": (2, 1), "so(2,1)": (2, 1),
    "so(1,2)": (2, 1), "su(1,1)": (2, 1), "sp(2,r)": (2, 1), "sp(2)": (2, 1), "so(4)": (0, 6), "so(3,1)": (3, 3),
    "so(1,3)": (3, 3), "lorentz": (3, 3), "sl(2,c)": (3, 3), "so(2,2)": (4, 2), "su(3)": (0, 8), "su(2,1)": (4, 4),
    "sl(3,r)": (5, 3), "sl(3)": (5, 3), "so(5)": (0, 10), "so(4,1)": (4, 6), "so(1,4)": (4, 6), "so(3,2)": (6, 4),
    "so(2,3)": (6, 4), "sp(4,r)": (6, 4), "sp(4)": (6, 4),
}  # fmt: skip
"""Positive and negative squares in the Killing form."""
CENTRAL = {"u(1)": (0, 0, 1), "so(2)": (0, 0, 1), "u(2)": (0, 3, 1), "u(3)": (0, 8, 1), "u(1,1)": (2, 1, 1),
    "gl(2,r)": (2, 1, 1), "gl(2)": (2, 1, 1)}  # fmt: skip
"""The same, and the dimension of the centre."""


def rank(rows: Matrix) -> int:
    """The rank of a matrix."""
    rows, found = [row[:] for row in rows], 0
    for column in range(len(rows[0]) if rows else 0):
        pivot = next((r for r in range(found, len(rows)) if rows[r][column]), None)
        if pivot is None:
            continue
        rows[found], rows[pivot] = rows[pivot], rows[found]
        for r in range(found + 1, len(rows)):
            if factor := rows[r][column] / rows[found][column]:
                rows[r] = [a - factor * b for a, b in zip(rows[r], rows[found], strict=True)]
        found += 1
    return found


def solved(rows: Matrix, target: list[Fraction]) -> list[Fraction] | None:
    """The coefficients with Σ c_i rows_i = target, for rows that are independent; None where there are none."""
    n = len(rows)
    system = [[row[k] for row in rows] + [target[k]] for k in range(len(target))]
    for done in range(n):
        column, pivot = done, next(r for r in range(done, len(system)) if system[r][done])
        system[done], system[pivot] = system[pivot], system[done]
        system[done] = [a / system[done][column] for a in system[done]]
        for r in range(len(system)):
            if r != done and (factor := system[r][column]):
                system[r] = [a - factor * b for a, b in zip(system[r], system[done], strict=True)]
    return None if any(row[n] for row in system[n:]) else [row[n] for row in system[:n]]


def kernel(rows: Matrix, n: int) -> Matrix:
    """A basis of the vectors of n numbers that are orthogonal to all rows."""
    rows, pivots = [row[:] for row in rows], list[int]()
    for column in range(n):
        done = len(pivots)
        pivot = next((r for r in range(done, len(rows)) if rows[r][column]), None)
        if pivot is None:
            continue
        rows[done], rows[pivot] = rows[pivot], rows[done]
        rows[done] = [a / rows[done][column] for a in rows[done]]
        for r in range(len(rows)):
            if r != done and (factor := rows[r][column]):
                rows[r] = [a - factor * b for a, b in zip(rows[r], rows[done], strict=True)]
        pivots.append(column)
    found = []
    for free in (k for k in range(n) if k not in pivots):
        vector = [Fraction(int(k == free)) for k in range(n)]
        for row, column in zip(rows, pivots, strict=False):
            vector[column] = -row[free]
        found.append(vector)
    return found


def signature(form: Matrix) -> tuple[int, int]:
    """(positive, negative) squares of a symmetric form, one after the other."""
    form, signs = [row[:] for row in form], [0, 0]
    while form:
        n = len(form)
        k = next((k for k in range(n) if form[k][k]), None)
        if k is None:
            pair = next(((i, j) for i, j in combinations(range(n), 2) if form[i][j]), None)
            if pair is None:
                break
            i, k = pair[1], pair[0]  # e_k + e_i for e_k
            form[k] = [a + b for a, b in zip(form[k], form[i], strict=True)]
            for row in form:
                row[k] += row[i]
        square = form[k][k]
        signs[square < 0] += 1
        rest = [i for i in range(n) if i != k]
        form = [[form[i][j] - form[i][k] * form[k][j] / square for j in rest] for i in rest]
    return signs[0], signs[1]


def bracket(c: Constants, x: list[Fraction], y: list[Fraction]) -> list[Fraction]:
    """[x, y]."""
    n = len(c)
    places = [(i, j, x[i] * y[j]) for i, j in product(range(n), repeat=2) if x[i] and y[j]]
    return [sum((w * c[i][j][k] for i, j, w in places), Fraction(0)) for k in range(n)]


def killing(c: Constants) -> Matrix:
    """tr(ad e_i ad e_j)."""
    n = len(c)
    one = lambda i, j: sum((c[i][k][m] * c[j][m][k] for k, m in product(range(n), repeat=2)), Fraction(0))
    return [[one(i, j) for j in range(n)] for i in range(n)]


def check_lie(c: Constants) -> None:
    """Antisymmetric, with Jacobi's identity. Raises Stop."""
    n = len(c)
    unit = [[Fraction(int(i == k)) for k in range(n)] for i in range(n)]
    odd = any(c[i][j][k] + c[j][i][k] for i, j, k in product(range(n), repeat=3))
    for i, j, k in combinations(range(n), 3):
        cyclic = [bracket(c, bracket(c, unit[a], unit[b]), unit[d]) for a, b, d in ((i, j, k), (j, k, i), (k, i, j))]
        odd = odd or any(map(sum, zip(*cyclic, strict=True)))
    if odd or n > LARGEST:
        raise Stop("not shown", "that these are the constants of a Lie algebra")


def is_called(c: Constants, name: str) -> bool:
    """Whether the algebra is seen to be the one of this name."""
    check_lie(c)
    n, form = len(c), killing(c)
    unit = [[Fraction(int(i == k)) for k in range(n)] for i in range(n)]
    images = [c[i][j] for i, j in combinations(range(n), 2)]
    centre = kernel([[c[i][j][k] for i in range(n)] for j, k in product(range(n), repeat=2)], n)
    words = [re.sub(r"\s", "", part) for part in re.split(r"\+", name.lower())]
    if len(words) == 1 and (m := re.fullmatch(r"(?:h|heisenberg)\((\d+)\)", words[0])):
        return n == 2 * int(m[1]) + 1 and n > 1 and len(centre) == rank(images) == rank([*images, *centre]) == 1
    if words == ["aff(1)"]:
        return n == 2 and rank(images) == 1
    plus, minus = signature(form)
    if words in (["e(3)"], ["iso(3)"]):
        ideal = kernel(form, n)
        if (n, len(ideal), plus, minus) != (6, 3, 0, 3):
            return False
        moved = [bracket(c, x, e) for x in ideal for e in unit]
        flat = any(any(bracket(c, x, y)) for x, y in combinations(ideal, 2))
        left = [e for k, e in enumerate(unit) if rank([*ideal, *unit[:k]]) < rank([*ideal, *unit[: k + 1]])]
        rest = [[solved([*left, *ideal], bracket(c, x, y)) for y in left] for x in left]
        quotient = [[(v or [])[:3] for v in row] for row in rest]
        return not flat and rank([*ideal, *moved]) == 3 and rank(moved) > 0 and signature(killing(quotient)) == (0, 3)
    sums = [(*SEMISIMPLE.get(w, (0, 0)), 0) if w in SEMISIMPLE else CENTRAL.get(w) for w in words]
    if None in sums:
        raise Stop("not shown", f"what algebra {name[:40]} is")
    a, b, z = (sum(one[k] for one in sums if one) for k in range(3))
    return (n, plus, minus, len(centre)) == (a + b + z, a, b, z) and a + b in SETTLED


def constants_of(names: list[str], table: Any, read: Any) -> Constants:
    """The constants of a table "A,B" = combination; `read` gives the coefficients of one."""
    n = len(names)
    c = [[[Fraction(0)] * n for _ in range(n)] for _ in range(n)]
    seen = set[frozenset[int]]()
    for pair, text in table.items():
        i, j = (names.index(name.strip()) for name in pair.split(","))
        if i == j or frozenset((i, j)) in seen:
            raise Stop("not shown", "pairs that stand twice")
        seen.add(frozenset((i, j)))
        c[i][j] = read(text)
        c[j][i] = [-x for x in c[i][j]]
    return c


def evaluated(at: Any, names: Any) -> Any:
    """A number re + i im, or a combination, {name: number}; each a table of {name or "": (re, im)}."""
    if isinstance(at, ast.Expression):
        return evaluated(at.body, names)
    if isinstance(at, ast.Constant) and isinstance(at.value, int | float | complex) and not isinstance(at.value, bool):
        value = at.value
        if isinstance(value, float) or (isinstance(value, complex) and value.imag != int(value.imag)):
            raise Stop("not shown", "a number of that form")
        return {"": (Fraction(0), Fraction(int(value.imag))) if isinstance(value, complex) else (Fraction(value), 0)}
    if isinstance(at, ast.Name) and at.id in names:
        return {at.id: (Fraction(1), Fraction(0))}
    if isinstance(at, ast.UnaryOp) and isinstance(at.op, ast.USub):
        return {name: (-a, -b) for name, (a, b) in evaluated(at.operand, names).items()}
    if not isinstance(at, ast.BinOp):
        raise Stop("not shown", "an entry of that form")
    x, y = evaluated(at.left, names), evaluated(at.right, names)
    if isinstance(at.op, ast.Add | ast.Sub):
        sign = 1 if isinstance(at.op, ast.Add) else -1
        both = {*x, *y}
        get = lambda table, name: table.get(name, (Fraction(0), Fraction(0)))
        return {k: (get(x, k)[0] + sign * get(y, k)[0], get(x, k)[1] + sign * get(y, k)[1]) for k in both}
    if {*y} - {""} and {*x} <= {""} and isinstance(at.op, ast.Mult):
        x, y = y, x
    if {*y} - {""} or not isinstance(at.op, ast.Mult | ast.Div):
        raise Stop("not shown", "an entry of that form")
    a, b = y.get("", (Fraction(0), Fraction(0)))
    if isinstance(at.op, ast.Div):
        a, b = a / (a * a + b * b), -b / (a * a + b * b)
    return {name: (u * a - v * b, u * b + v * a) for name, (u, v) in x.items()}


def combination(text: Any, names: list[str]) -> list[Fraction]:
    """The coefficients of a linear combination of names, which are rational."""
    found = evaluated(ast.parse(str(text), mode="eval"), names)
    if found.get("", (0, 0)) != (0, 0) or any(b for _, b in found.values()):
        raise Stop("not shown", "a combination with another term, or complex")
    return [found.get(name, (Fraction(0), 0))[0] for name in names]


def shown(data: Any) -> tuple[str, str]:
    """The answer about matrices: multiplied out exactly."""
    claim = {key: x for key, x in data["tables"]["claim"].items() if key not in alone.UNASKED}
    if data["tables"]["claim"]["kind"] != "matrix_algebra" or {*claim} - {"basis", "equals", "structure"}:
        raise Stop("not shown", "no algebra of matrices, or with other keys")
    names = [*claim["basis"]]
    read = lambda text: evaluated(ast.parse(str(text), mode="eval"), ()).get("", (Fraction(0), Fraction(0)))
    matrices = [[[read(x) for x in row] for row in matrix] for matrix in claim["basis"].values()]
    size = len(matrices[0])
    if any(len(m) != size or any(len(row) != size for row in m) for m in matrices) or len(names) > LARGEST or size > 9:
        raise Stop("not shown", "matrices of other sizes, or so large")
    flat = lambda m: [part for row in m for entry in row for part in entry]
    rows = [flat(m) for m in matrices]
    if rank(rows) < len(rows):
        raise Stop("not shown", "that the matrices are independent")
    for turn in (False, True):  # [A, B], or −i [A, B]
        c = [[solved(rows, flat(commutator(a, b, turn))) for b in matrices] for a in matrices]
        if all(x is not None for row in c for x in row):
            break
    else:
        raise Stop("not shown", "that the real span closes")
    found = [[x or [] for x in row] for row in c]
    if "structure" in claim and constants_of(names, claim["structure"], lambda t: combination(t, names)) != found:
        raise Stop("not shown", "these structure constants")
    if "equals" in claim and not is_called(found, claim["equals"]):
        raise Stop("not shown", "that it is the algebra of this name")
    if not {"structure", "equals"} & {*claim}:
        raise Stop("not shown", "nothing that is claimed")
    return "shown", ""


def commutator(a: Any, b: Any, turn: bool) -> Any:
    """A B − B A, or −i times it."""
    times = lambda u, v: (u[0] * v[0] - u[1] * v[1], u[0] * v[1] + u[1] * v[0])
    n = range(len(a))
    terms = lambda i, j: [(times(a[i][k], b[k][j]), times(b[i][k], a[k][j])) for k in n]
    entry = lambda i, j: tuple(sum((x[s] - y[s] for x, y in terms(i, j)), Fraction(0)) for s in (0, 1))
    return [[(e[1], -e[0]) if turn else e for e in (entry(i, j) for j in n)] for i in n]


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
