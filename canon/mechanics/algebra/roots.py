"""The roots of a semisimple Lie algebra with respect to a Cartan subalgebra of it, with root vectors, exactly.

The roots are algebraic numbers, conjugate ones together: for an element h of the Cartan subalgebra, each irreducible
factor f of the characteristic polynomial of ad h is an orbit of roots α, one for each zero t of f, with α(h) = t, all
values α(h_i) = p_i(t) and the root vector v(t) polynomials in t with rational coefficients.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from random import Random
from typing import Any

import sympy as sp
from flint import acb, fmpq, fmpq_mat, fmpq_poly, fmpz_mat

from canon.errors import InputError
from canon.expected import instance_of, whole_number
from canon.mechanics.algebra import linear
from canon.mechanics.algebra.coefficients import as_sympy
from canon.mechanics.algebra.ideals import centraliser
from canon.mechanics.algebra.lie_algebra import LieAlgebra
from canon.mechanics.algebra.semisimple import ATTEMPTS

HIGHEST = 24
"""The highest degree of the algebraic numbers in which roots are shown."""
Vector = list[fmpq]


@dataclass(frozen=True, slots=True)
class Root:
    """A root α of g ⊗ C.

    **Arguments:** `values`, α(h_i) on the basis of the Cartan subalgebra; `vector`, a formula v in the basis' names
    with [h, v] = α(h) v; `coordinates`, whole numbers: α as a combination of the simple roots.
    """

    values: tuple[sp.Expr, ...]
    vector: sp.Expr
    coordinates: tuple[int, ...]

    @property
    def is_positive(self) -> bool:
        """Whether its coordinates in the simple roots aren't negative."""
        return all(c >= 0 for c in self.coordinates)


@dataclass(frozen=True, slots=True)
class RootSystem:
    """The root space decomposition of a semisimple algebra over C.

    **Arguments:** `cartan`, a basis of the Cartan subalgebra as formulas in the names of the basis; `roots`, the
    positive ones first, by height; `simple`, positions of the simple roots; `cartan_matrix`,
    a_ij = 2 (α_i, α_j)/(α_i, α_i) of the simple roots, as in `cartan_matrix` of a type.
    """

    cartan: tuple[sp.Expr, ...]
    roots: tuple[Root, ...]
    simple: tuple[int, ...]
    cartan_matrix: tuple[tuple[int, ...], ...]


def roots_of(algebra: LieAlgebra, seed: int = 0) -> RootSystem:
    """Cartan subalgebra, roots and root vectors of a semisimple algebra with rational structure constants.

    The Cartan subalgebra is spanned by elements of the given basis as far as they serve, so that the usual bases show
    the usual roots. Humphreys, Introduction to Lie Algebras (1972), 8 and 10.

    **Raises:** `InputError` where the algebra isn't semisimple or has irrational structure constants.
    """
    instance_of(algebra, LieAlgebra, "algebra")
    seed = whole_number(seed, "seed")
    if not algebra.is_rational:
        raise InputError("roots are computed for rational structure constants: rescale the basis first")
    n = algebra.dimension
    form = algebra.killing_form()
    if not n or form.rank() < n:
        raise InputError("the Killing form is degenerate: an algebra that isn't semisimple has no root system")
    H = _toral(algebra, seed)
    rank = H.nrows()
    orbits = list(_orbits(algebra, H, seed))
    balls = [values for orbit in orbits for values in orbit.balls()]
    pairing = _cartan_integers(balls, (H * form * H.transpose()).inv(), rank)
    simple, coordinates = _simple_roots(pairing)
    exact = [root for orbit in orbits for root in orbit.exactly(algebra.names)]
    order = sorted(range(len(exact)), key=lambda k: (min(coordinates[k]) < 0, abs(sum(coordinates[k])), coordinates[k]))
    roots = tuple(Root(*exact[k], coordinates[k]) for k in order)
    cartan = tuple(as_sympy({c: linear.fraction(v) for c, v in enumerate(row) if v != 0}, algebra.names)
                   for row in linear.rows(H))  # fmt: skip
    positions = tuple(order.index(k) for k in simple)
    matrix = tuple(tuple(pairing[j][i] for j in simple) for i in simple)
    return RootSystem(cartan, roots, positions, matrix)


# -- a Cartan subalgebra ---------------------------------------------------------------------------------------------


def _toral(algebra: LieAlgebra, seed: int) -> fmpq_mat:
    """A Cartan subalgebra: semisimple elements that commute, until they are their own centraliser."""
    n, rng = algebra.dimension, Random(seed)
    H, C = linear.matrix([], n), linear.matrix([[fmpq(int(i == j)) for j in range(n)] for i in range(n)], n)
    while C.nrows() > H.nrows():
        for x in _candidates(C, rng):
            if not linear.contains(linear.span(linear.rows(H), n), x) and _is_semisimple(algebra.adjoint_of(x)):
                break
        else:
            raise ArithmeticError("no semisimple element was found")
        H = linear.matrix([*linear.rows(H), x], n)
        C = centraliser(algebra, H)
    return H


def _candidates(space: fmpq_mat, rng: Random) -> Iterator[Vector]:
    """Elements of a subspace: its basis, sums and differences of pairs, and random ones."""
    rows = linear.rows(space)
    yield from rows
    for a, b in combinations(rows, 2):
        yield [x + y for x, y in zip(a, b, strict=True)]
        yield [x - y for x, y in zip(a, b, strict=True)]
    for _ in range(ATTEMPTS):
        weights = [fmpq(rng.randint(-5, 5)) for _ in rows]
        yield [
            sum((w * row[k] for w, row in zip(weights, rows, strict=True)), start=fmpq(0)) for k in range(len(rows[0]))
        ]


def _is_semisimple(ad: fmpq_mat) -> bool:
    """Whether the minimal polynomial has no multiple zero."""
    polynomial = fmpq_poly([1])
    for factor, _ in _characteristic(ad).factor()[1]:
        polynomial *= fmpq_poly(factor)
    return _applied(polynomial, ad) == fmpq_mat(ad.nrows(), ad.nrows())


def _characteristic(values: fmpq_mat) -> Any:
    """The characteristic polynomial with integer coefficients, of the matrix times its common denominator."""
    scaled, denominator = values.numer_denom()
    polynomial = fmpz_mat(scaled).charpoly()
    stretched = fmpq_poly([c * fmpq(denominator) ** k for k, c in enumerate(polynomial.coeffs())])
    return stretched.numer()


def _applied(polynomial: fmpq_poly, values: fmpq_mat) -> fmpq_mat:
    n = values.nrows()
    total = fmpq_mat(n, n)
    for c in reversed(polynomial.coeffs()):
        total = total * values + fmpq_mat(n, n, [c if i == j else fmpq(0) for i in range(n) for j in range(n)])
    return total


# -- orbits of conjugate roots ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Orbit:
    """Roots α for the zeros t of an irreducible `factor`: α(h_i) = `values[i]`(t), with `vector`, polynomials in t."""

    factor: Any
    values: list[fmpq_poly]
    vector: list[fmpq_poly]

    def balls(self) -> list[list[acb]]:
        """The roots' values in balls, in the order of the zeros."""
        return [[_at_ball(p, t) for p in self.values] for t, _ in self.factor.complex_roots()]

    def exactly(self, names: Sequence[str]) -> list[tuple[tuple[sp.Expr, ...], sp.Expr]]:
        """The roots' values and vectors as sympy has them, in the same order."""
        found = []
        for t in self._zeros():
            vector = {c: _at_number(p, t) for c, p in enumerate(self.vector) if p != 0}
            found.append((tuple(_at_number(p, t) for p in self.values), as_sympy(vector, names)))
        return found

    def _zeros(self) -> list[Any]:
        """The zeros as sympy has them, in the order of the balls that contain them."""
        x = sp.Symbol("x")
        polynomial = sp.Poly([int(c) for c in reversed(self.factor.coeffs())], x)
        if polynomial.degree() > HIGHEST:
            raise ArithmeticError(f"the roots are algebraic numbers of degree {polynomial.degree()}: at most {HIGHEST}")
        zeros = [sp.sqrtdenest(zero) for zero in sp.roots(polynomial, quartics=False, cubics=False)]
        plain = len(zeros) == polynomial.degree() and not any(zero.has(sp.Function) for zero in zeros)
        given = zeros if plain else polynomial.all_roots(radicals=False)
        numbers = [complex(sp.N(z, 30)) for z in given]
        found = []
        for t, _ in self.factor.complex_roots():
            middle = complex(t.mid())
            near, *others = sorted(range(len(given)), key=lambda k, m=middle: abs(numbers[k] - m))
            if others and 1000 * abs(numbers[near] - middle) > abs(numbers[others[0]] - middle):
                raise ArithmeticError("two roots are too close to be told apart")
            found.append(given[near])
        return found


def _at_number(polynomial: fmpq_poly, t: Any) -> Any:
    value = sp.Add(*(sp.Rational(int(c.p), int(c.q)) * t**k for k, c in enumerate(polynomial.coeffs())))
    return value if value.has(sp.CRootOf) else sp.radsimp(sp.expand(value))


def _at_ball(polynomial: fmpq_poly, t: acb) -> acb:
    total = acb(0)
    for c in reversed(polynomial.coeffs()):
        total = total * t + acb(c)
    return total


def _orbits(algebra: LieAlgebra, H: fmpq_mat, seed: int) -> Iterator[_Orbit]:
    """The orbits, from an element of H on which all roots differ and none is 0."""
    n, rank = algebra.dimension, H.nrows()
    factors, ad = _generic(algebra, H, seed)
    acting = [algebra.adjoint_of(row) for row in linear.rows(H)]
    for factor in factors:
        f = fmpq_poly(factor)
        space = linear.rows(linear.null_space(_applied(f, ad)))
        column = fmpq_mat(n, 1, space[0])
        powers = [column]
        for _ in range(f.degree() - 1):
            powers.append(ad * powers[-1])
        cyclic = linear.matrix(([row[0] for row in linear.rows(p)] for p in powers), n)
        images = linear.matrix(([row[0] for row in linear.rows(X * column)] for X in acting), n)
        values = [fmpq_poly(row) for row in linear.rows(linear.coordinates(cyclic, images))]
        c = f.coeffs()
        vectors = []  # (f(A) − f(t))/(A − t) w, whose coefficient of t^k is Σ_j>k c_j A^(j−1−k) w
        for k in range(f.degree()):
            rows = [(c[j], linear.rows(cyclic)[j - 1 - k]) for j in range(k + 1, f.degree() + 1)]
            vectors.append([sum((a * row[i] for a, row in rows), start=fmpq(0)) for i in range(n)])
        yield _Orbit(factor, values[:rank], _scaled([fmpq_poly([v[i] for v in vectors]) for i in range(n)], f))


def _scaled(vector: list[fmpq_poly], f: fmpq_poly) -> list[fmpq_poly]:
    """The vector divided by its first component that isn't 0, modulo the irreducible f."""
    first = next(p for p in vector if p != 0)
    common, inverse, _ = first.xgcd(f)
    return [(p * inverse / common.coeffs()[0]) % f for p in vector]


def _generic(algebra: LieAlgebra, H: fmpq_mat, seed: int) -> tuple[list[Any], fmpq_mat]:
    rng, rows = Random(seed), linear.rows(H)
    for attempt in range(ATTEMPTS):
        weights = [fmpq(rng.choice((-1, 1)) * rng.randint(1, 2 + attempt * len(rows))) for _ in rows]
        h = [sum((w * row[k] for w, row in zip(weights, rows, strict=True)), start=fmpq(0)) for k in range(H.ncols())]
        ad = algebra.adjoint_of(h)
        factors = _characteristic(ad).factor()[1]
        simple = [factor for factor, power in factors if power == 1 and factor.coeffs()[0] != 0]
        if sum(factor.degree() for factor in simple) == algebra.dimension - H.nrows():
            return simple, ad
    raise ArithmeticError("no element tells all roots apart")


# -- whole numbers ---------------------------------------------------------------------------------------------------


def _cartan_integers(balls: list[list[acb]], inverse: fmpq_mat, rank: int) -> list[list[int]]:
    """pairing[β][α] = 2 (β, α)/(α, α): the whole number in a ball, since such a number it is (Humphreys, 9.4)."""
    dual = [[sum((acb(inverse[i, j]) * v[j] for j in range(rank)), start=acb(0)) for i in range(rank)] for v in balls]
    found = []
    for v in balls:
        row = []
        for w, u in zip(balls, dual, strict=True):
            above = sum((a * b for a, b in zip(v, u, strict=True)), start=acb(0))
            below = sum((a * b for a, b in zip(w, u, strict=True)), start=acb(0))
            value = (2 * above / below).real.unique_fmpz()
            if value is None:
                raise ArithmeticError("a Cartan integer isn't known within its bound")
            row.append(int(value))
        found.append(row)
    return found


def _simple_roots(pairing: list[list[int]]) -> tuple[list[int], list[tuple[int, ...]]]:
    """The simple roots for an order, and all roots in them.

    A root's row of Cartan integers is linear in it and determines it; positive is one whose first entry that isn't 0 is
    positive. Simple roots are the positive ones that aren't sums of two.
    """
    rows = [tuple(row) for row in pairing]
    positive = [k for k, row in enumerate(rows) if next(v for v in row if v) > 0]
    sums = {tuple(a + b for a, b in zip(rows[i], rows[j], strict=True)) for i, j in combinations(positive, 2)}
    simple = [k for k in positive if rows[k] not in sums]
    width = len(rows)
    basis = linear.matrix(([fmpq(v) for v in rows[k]] for k in simple), width)
    every = linear.matrix(([fmpq(v) for v in row] for row in rows), width)
    coordinates = [tuple(int(v.p) for v in row) for row in linear.rows(linear.coordinates(basis, every))]
    return simple, coordinates
