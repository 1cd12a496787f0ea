"""Cases: compositions of shears, linear maps, generating functions and Lie series with pseudo-random coefficients."""

from __future__ import annotations

import itertools
import random
from collections.abc import Sequence

import sympy as sp
from cases_common import Case, of_map, of_residuals, pb, reals


def polynomial(rng: random.Random, variables: Sequence[sp.Symbol], degree: int, terms: int) -> sp.Expr:
    """A homogeneous polynomial with small rational coefficients."""
    out = []
    for _ in range(terms):
        monomial = [rng.choice(variables) for _ in range(degree)]
        out.append(sp.Rational(rng.randint(-9, 9) or 1, rng.randint(1, 7)) * sp.Mul(*monomial))
    return sp.Add(*out)


def shears(n: int, count: int, degree: int, seed: int, terms: int = 6) -> Case:
    """`count` shears of n degrees of freedom, by turns of the momenta and of the coordinates, not expanded."""
    rng = random.Random(seed)
    q, p = list(reals(f"q1:{n + 1}")), list(reals(f"p1:{n + 1}"))
    Q, P = q[:], p[:]
    for step in range(count):
        names, values = (q, Q) if step % 2 == 0 else (p, P)
        V = polynomial(rng, names, degree, terms)
        places = dict(zip(names, values, strict=True))
        moves = [sp.diff(V, x).subs(places, simultaneous=True) for x in names]
        if step % 2 == 0:
            P = [a + b for a, b in zip(P, moves, strict=True)]
        else:
            Q = [a + b for a, b in zip(Q, moves, strict=True)]
    return of_map(Q, P, q, p)


def c16_shear_2dof_4quad() -> Case:
    """Four shears by cubic potentials."""
    return shears(2, 4, 3, 11)


def c17_shear_3dof_3quad() -> Case:
    """Three shears by cubic potentials."""
    return shears(3, 3, 3, 12)


def c18_shear_2dof_3cubic() -> Case:
    """Three shears by quartic potentials."""
    return shears(2, 3, 4, 13)


def c19_shear_4dof_2cubic() -> Case:
    """Two shears by quartic potentials."""
    return shears(4, 2, 4, 14)


def c20_shear_6dof_3quad() -> Case:
    """Three shears by cubic potentials."""
    return shears(6, 3, 3, 15)


def n20_shear_6dof_3quad_miss() -> Case:
    """The same with a momentum that a shear of another kind has moved."""
    given = c20_shear_6dof_3quad().map
    P = list(given.P)
    P[2] = P[2] + sp.Rational(1, 1000) * given.q[3] * given.q[1]
    return of_map(given.Q, P, given.q, given.p).missed()


def c45_shear_6dof_4cubic() -> Case:
    """Four shears by quartic potentials: far too large to expand."""
    return shears(6, 4, 4, 16, 7)


def c21_F2_random_poly() -> Case:
    """The map of a type-2 generating function, in mixed coordinates."""
    rng = random.Random(5)
    q, P = list(reals("q1 q2")), list(reals("P1 P2"))
    F2 = q[0] * P[0] + q[1] * P[1] + polynomial(rng, q + P, 3, 6) / 10
    old, new = q + [sp.diff(F2, a) for a in q], [sp.diff(F2, a) for a in P] + P
    A = sp.Matrix(4, 4, lambda i, j: sp.diff(old[i], (q + P)[j]))
    B = sp.Matrix(4, 4, lambda i, j: sp.diff(new[i], (q + P)[j]))
    M = B * (A.adjugate() / A.det())
    R = M * _J(2) * M.T - _J(2)
    return of_residuals(*(R[i, j] for i in range(4) for j in range(i + 1, 4)))


def c22_lie_series_order6() -> Case:
    """A Lie series with a sine in its generator is canonical order by order (to the fourth)."""
    q1, q2, p1, p2, _ = reals("q1 q2 p1 p2 epsilon")
    q, p, order = [q1, q2], [p1, p2], 4
    chi = p1**2 * q2 + sp.sin(q1 - q2) * p2 + q1 * q2 * p1 / 3
    series = {s: lie(s, chi, q, p, order) for s in q + p}
    return of_residuals(
        *(
            sp.Add(*(pb(series[a][i], series[b][k - i], q, p) for i in range(k + 1)))
            for a, b in itertools.combinations(q + p, 2)
            for k in range(1, order + 1)
        )
    )


def lie(f: sp.Expr, chi: sp.Expr, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol], order: int) -> list[sp.Expr]:
    """The terms of exp({., χ}) f."""
    out = [f]
    for k in range(1, order + 1):
        out.append(pb(out[-1], chi, q, p) / k)
    return out


def c33_linear_symbolic_3dof() -> Case:
    """A product of four linear shears with symbolic entries."""
    n, rng, count = 3, random.Random(3), itertools.count()
    names, M = reals("a0:40"), sp.eye(6)
    for k in range(4):
        B = sp.zeros(n)
        for i in range(n):
            for j in range(i, n):
                if rng.random() < 0.7:
                    B[i, j] = B[j, i] = names[next(count)]
        M = _block(B, upper=bool(k % 2)) * M
    R = M * _J(n) * M.T - _J(n)
    return of_residuals(*(R[i, j] for i in range(2 * n) for j in range(i + 1, 2 * n)))


def c34_linear_numeric_16dof() -> Case:
    """A linear map of 32 dimensions with rational entries."""
    n, rng, M = 16, random.Random(4), sp.eye(32)
    for k in range(4):
        B = sp.zeros(n)
        for i in range(n):
            for j in range(i, n):
                B[i, j] = B[j, i] = sp.Rational(rng.randint(-5, 5), rng.randint(1, 6))
        M = _block(B, upper=bool(k % 2)) * M
    q, p = reals("q1:17"), reals("p1:17")
    images = list(M * sp.Matrix([*q, *p]))
    return of_map(images[:n], images[n:], q, p)


def c49_lie_poly_3dof_order5() -> Case:
    """A Lie series with a cubic generator is canonical at the fifth order."""
    q, p = list(reals("q1 q2 q3")), list(reals("p1 p2 p3"))
    chi, order = polynomial(random.Random(9), q + p, 3, 8), 5
    series = {s: lie(s, chi, q, p, order) for s in (q[0], p[0], q[1], p[2])}
    return of_residuals(
        *(
            sp.Add(*(pb(series[a][i], series[b][order - i], q, p) for i in range(order + 1)))
            for a, b in itertools.combinations(series, 2)
        )
    )


def _J(n: int) -> sp.Matrix:
    return sp.Matrix(sp.BlockMatrix([[sp.zeros(n), sp.eye(n)], [-sp.eye(n), sp.zeros(n)]]))


def _block(B: sp.Matrix, *, upper: bool) -> sp.Matrix:
    """[[1, B], [0, 1]] or its transpose's kind."""
    n = B.rows
    rows = [[sp.eye(n), B], [sp.zeros(n), sp.eye(n)]] if upper else [[sp.eye(n), sp.zeros(n)], [B, sp.eye(n)]]
    return sp.Matrix(sp.BlockMatrix(rows))


CASES = {name: build for name, build in list(globals().items()) if name[:1] in "cn" and name[1:3].isdigit()}
