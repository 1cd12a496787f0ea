"""Casimirs of orthogonal algebras and of motions, from the invariants of the generic element in the vector module.

Of so(p, q) and iso(p, q) with metric g the functions on the dual space make an antisymmetric tensor L_ij (and a vector
P_i). With Λ = L g⁻¹ and det(λ − Λ) = λⁿ + c_1 λⁿ⁻¹ + c_2 λⁿ⁻² + …, the Casimirs of so(p, q) are c_2, c_4, …, with the
Pfaffian of L in place of c_n for even n. Those of iso(p, q) are P·B_2k P with B_m = Λᵐ + c_1 Λᵐ⁻¹ + … + c_m, which are
P², W², …, with P ∧ L ∧ … ∧ L in place of the last for odd n.

Perelomov and Popov, Math. USSR Izvestija 2 (1968) 1313, for so(n); the others by contraction of so(n + 1).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

import sympy as sp
from flint import fmpq, fmpq_mat, fmpq_mpoly, fmpq_mpoly_ctx

from canon.errors import InputError
from canon.mechanics.algebra import linear
from canon.mechanics.algebra.families import action, invariant_forms
from canon.mechanics.algebra.from_matrices import Rows, algebra_of_matrices, real_matrices
from canon.mechanics.algebra.identify import identify
from canon.mechanics.algebra.lie_algebra import LieAlgebra

Square = list[list[fmpq_mpoly]]


def orthogonal_casimirs(matrices: Mapping[str, Rows], highest: int | None = None) -> tuple[sp.Expr, ...]:
    """The Casimirs of so(p, q), which generate all others, from n (n − 1)/2 real matrices that keep a metric.

    **Arguments:** `matrices` by name; `highest`, the degree beyond which Casimirs are left out.

    **Returns:** the even ones c_2, c_4, … by degree, and for even n the Pfaffian, of degree n/2, as the last.

    **Raises:** `InputError` where the matrices aren't real and rational or aren't all that keep one metric.
    """
    names = algebra_of_matrices(matrices).algebra.names
    given = real_matrices(matrices)
    n = given[0].nrows() if given else 0
    forms = invariant_forms(given) if given else []
    if not given or len(names) != n * (n - 1) // 2 or len(forms) != 1 or forms[0].rank() < n:
        raise InputError(f"{len(names)} matrices that aren't all those that keep one metric: no basis of so(p, q)")
    most = n if highest is None else highest
    ring = _ring(len(names))
    L = _tensor(ring, given, forms[0], list(ring.gens()))
    inverse = _constants(ring, forms[0].inv())
    found = []
    for m, (c, _) in enumerate(_leverrier(ring, _product(L, inverse), min(n - 1, most))):
        if m and m % 2 == 0:
            found.append(c)
    if n % 2 == 0 and n // 2 <= most:
        found.append(_pfaffian(ring, L))
    return tuple(_shown(f, names) for f in found)


def motion_casimirs(algebra: LieAlgebra, highest: int | None = None) -> tuple[sp.Expr, ...]:
    """The Casimirs of e(n) or iso(p, q), p + q > 2, in any basis: P², W², … by degree, for odd n P ∧ L ∧ … as the last.

    **Arguments:** `highest`, the degree beyond which Casimirs are left out.

    **Raises:** `InputError` for another algebra, or constants that aren't rational.
    """
    if not algebra.is_rational:
        raise InputError("Casimirs are computed for rational structure constants: rescale the basis first")
    found = identify(algebra)
    core = found.identity.cores[0] if found.identity.cores else None
    if core is None or core.family != "iso" or core.dimension != algebra.dimension or not found.levi.nrows():
        raise InputError(f"the algebra is {found.identity.name}, not iso(p, q) in more than two dimensions")
    ring, R = _ring(algebra.dimension), found.radical
    given = [action(algebra, x, R) for x in linear.rows(found.levi)]
    (metric,) = invariant_forms(given)
    n = R.nrows()
    most = 2 * n if highest is None else highest
    L = _tensor(ring, given, metric, [_element(ring, x) for x in linear.rows(found.levi)])
    P = [_element(ring, x) for x in linear.rows(R)]
    inverse = _constants(ring, metric.inv())
    up = [_sum(ring, (inverse[i][j] * P[j] for j in range(n))) for i in range(n)]
    polynomials = []
    for m, (_, B) in enumerate(_leverrier(ring, _product(L, inverse), min(n - 2, most - 2))):
        if m % 2 == 0:
            polynomials.append(_sum(ring, (up[i] * B[i][j] * P[j] for i in range(n) for j in range(n))))
    if n % 2 and (n + 1) // 2 <= most:
        bordered = [[*row, p] for row, p in zip(L, P, strict=True)] + [[*(-p for p in P), ring.constant(0)]]
        polynomials.append(_pfaffian(ring, bordered))
    return tuple(_shown(f, algebra.names) for f in polynomials)


def _ring(size: int) -> fmpq_mpoly_ctx:
    return fmpq_mpoly_ctx.get([f"x{k}" for k in range(size)])


def _sum(ring: fmpq_mpoly_ctx, terms: object) -> fmpq_mpoly:
    return sum(terms, start=ring.constant(0))  # type: ignore[call-overload]


def _element(ring: fmpq_mpoly_ctx, x: Sequence[fmpq]) -> fmpq_mpoly:
    return _sum(ring, (symbol * v for symbol, v in zip(ring.gens(), x, strict=True) if v != 0))


def _constants(ring: fmpq_mpoly_ctx, values: fmpq_mat) -> Square:
    return [[ring.constant(v) for v in row] for row in linear.rows(values)]


def _product(a: Square, b: Square) -> Square:
    ring = a[0][0].context()
    return [[_sum(ring, (x * row[j] for x, row in zip(line, b, strict=True))) for j in range(len(b[0]))] for line in a]


def _tensor(ring: fmpq_mpoly_ctx, matrices: Sequence[fmpq_mat], g: fmpq_mat, elements: Sequence[fmpq_mpoly]) -> Square:
    """L_ij: the element of the algebra whose matrix is v → e_i g(e_j, v) − e_j g(e_i, v)."""
    n = g.nrows()
    basis = linear.matrix(([entry for row in linear.rows(M) for entry in row] for M in matrices), n * n)
    planes = []
    for i in range(n):
        for j in range(n):
            plane = fmpq_mat(n, n)
            for k in range(n):
                plane[i, k] += g[j, k]
                plane[j, k] -= g[i, k]
            planes.append([entry for row in linear.rows(plane) for entry in row])
    rows = linear.rows(linear.coordinates(basis, linear.matrix(planes, n * n)))
    values = [_sum(ring, (f * v for f, v in zip(elements, row, strict=True) if v != 0)) for row in rows]
    return [values[i * n : (i + 1) * n] for i in range(n)]


def _leverrier(ring: fmpq_mpoly_ctx, values: Square, most: int) -> list[tuple[fmpq_mpoly, Square]]:
    """(c_m, B_m) for m = 0 … `most`: c_m = −tr(Λ B_(m−1))/m, B_m = Λ B_(m−1) + c_m (Faddeev, Leverrier)."""
    n = len(values)
    c = ring.constant(1)
    B = [[ring.constant(int(i == j)) for j in range(n)] for i in range(n)]
    found = [(c, B)]
    for m in range(1, most + 1):
        moved = _product(values, B)
        c = _sum(ring, (moved[i][i] for i in range(n))) * fmpq(-1, m)
        B = [[moved[i][j] + c if i == j else moved[i][j] for j in range(n)] for i in range(n)]
        found.append((c, B))
    return found


def _pfaffian(ring: fmpq_mpoly_ctx, values: Square) -> fmpq_mpoly:
    """By expansion along the first row, each minor once."""
    known: dict[tuple[int, ...], fmpq_mpoly] = {(): ring.constant(1)}

    def minor(kept: tuple[int, ...]) -> fmpq_mpoly:
        if kept not in known:
            first, *rest = kept
            terms = []
            for k, j in enumerate(rest):
                entry = values[first][j]
                if entry != 0:
                    inner = minor((*rest[:k], *rest[k + 1 :]))
                    terms.append(entry * inner if k % 2 == 0 else -(entry * inner))
            known[kept] = _sum(ring, terms)
        return known[kept]

    return minor(tuple(range(len(values))))


def _shown(f: fmpq_mpoly, names: Sequence[str]) -> sp.Expr:
    """The polynomial without its common rational factor, as a formula."""
    symbols = [sp.Symbol(name) for name in names]
    _, primitive = sp.Poly(
        {tuple(int(e) for e in power): sp.Rational(*_parts(linear.fraction(v))) for power, v in f.to_dict().items()},
        *symbols,
    ).primitive()
    return primitive.as_expr()


def _parts(value: Fraction) -> tuple[int, int]:
    return value.numerator, value.denominator
