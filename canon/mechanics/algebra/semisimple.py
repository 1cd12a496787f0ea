"""A semisimple Lie algebra with rational structure constants, taken apart into its simple ideals over the reals.

The centroid (all linear maps that commute with every ad x) of a semisimple algebra is a product of fields: over R, one
R for each simple ideal that stays simple over C, and one C for each complex simple algebra read as a real one.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

from flint import fmpq, fmpq_mat, fmpq_poly, fmpz_poly, nmod_mat

from canon.mechanics.algebra import linear
from canon.mechanics.algebra.complex_type import ComplexType, complex_type
from canon.mechanics.algebra.lie_algebra import LieAlgebra

PRIME = (1 << 61) - 1
ATTEMPTS = 40


@dataclass(frozen=True, slots=True)
class SimpleIdeal:
    """A simple ideal over the reals.

    **Arguments:** `type`, of the complex simple algebra; `is_complex`, whether the ideal is that complex algebra read
    as a real one; `compact_dimension`, the number of negative squares of its Killing form (of a maximal compact
    subalgebra); `dimension` over the reals; `basis`, rows, where the ideal is defined over the rationals.
    """

    type: ComplexType
    is_complex: bool
    compact_dimension: int
    dimension: int
    basis: tuple[tuple[Fraction, ...], ...] | None = None


def cartan_subalgebra(algebra: LieAlgebra, seed: int = 0) -> tuple[list[fmpq], fmpq_mat]:
    """A regular element x of a semisimple algebra, and the Cartan subalgebra of all elements that commute with it.

    The null space of ad x is one where it is abelian and ad x has no larger null space in its square (it is then
    nilpotent and its own normaliser: Humphreys, Introduction to Lie Algebras (1972), 15.3).
    """
    n = algebra.dimension
    rng = random.Random(seed)
    for attempt in range(ATTEMPTS):
        x = [fmpq(rng.randint(-3 - attempt, 3 + attempt)) for _ in range(n)]
        ad = algebra.adjoint_of(x)
        H = linear.null_space(ad)
        if (ad * ad).rank() == n - H.nrows() and _is_abelian(algebra, H):
            return x, H
    raise ArithmeticError("no regular element was found")


def _is_abelian(algebra: LieAlgebra, space: fmpq_mat) -> bool:
    return all(all(entry == 0 for entry in row) for row in algebra.products(space))


def simple_ideals(algebra: LieAlgebra, seed: int = 0) -> tuple[SimpleIdeal, ...]:
    """The simple ideals over the reals of a semisimple algebra, the smallest first.

    **Raises:** `ArithmeticError` where a complex type can't be told (see `complex_type`).
    """
    if not algebra.dimension:
        return ()
    form = algebra.killing_form()
    found: list[SimpleIdeal] = []
    centroid = _centroid(algebra, seed)
    if len(centroid) == 1:
        return (_absolutely_simple(algebra, form, None),)
    T, minimal = _generic(centroid, seed)
    for factor, _ in minimal.numer().factor()[1]:
        ideal = linear.null_space(_at(fmpq_poly(factor), T))
        inner = algebra.in_basis(ideal)
        inside = ideal * form * ideal.transpose()
        if factor.degree() == 1:
            found.append(_absolutely_simple(inner, inside, ideal))
        else:
            found += _over_a_field(inner, inside, _restricted(T, ideal), factor, seed)
    return tuple(sorted(found, key=lambda s: (s.dimension, str(s.type), s.compact_dimension)))


def _absolutely_simple(algebra: LieAlgebra, form: fmpq_mat, ideal: fmpq_mat | None) -> SimpleIdeal:
    """An ideal whose centroid is Q."""
    x, H = cartan_subalgebra(algebra)
    kind = complex_type(algebra.dimension, H.nrows(), algebra.adjoint_of(x))
    _, negative, _ = linear.signature(form)
    if ideal is None:
        n = algebra.dimension
        basis = tuple(tuple(Fraction(int(i == j)) for j in range(n)) for i in range(n))
    else:
        basis = tuple(tuple(linear.fraction(entry) for entry in row) for row in linear.rows(ideal))
    return SimpleIdeal(kind, False, negative, algebra.dimension, basis)


def _over_a_field(algebra: LieAlgebra, form: fmpq_mat, T: fmpq_mat, factor: fmpz_poly, seed: int) -> list[SimpleIdeal]:
    """An ideal whose centroid is a number field: a real ideal for each real root, a complex one for each other pair.

    T is self-adjoint in the Killing form, so K((T − c) x, y) is the sum of the forms of the real ideals with their
    signs changed below c, and those of the complex ones have as many positive as negative squares.
    """
    degree = factor.degree()
    _, H = cartan_subalgebra(algebra, seed)
    kind = complex_type(algebra.dimension // degree, H.nrows() // degree, None)
    size = kind.dimension
    cuts = _between_real_roots(factor)
    real = len(cuts) - 1
    found = [SimpleIdeal(kind, True, size, 2 * size) for _ in range((degree - real) // 2)]
    differences = []
    for cut in cuts:
        shifted = (T - fmpq_mat(T.nrows(), T.nrows(), _diagonal(cut, T.nrows()))).transpose() * form
        positive, negative, _ = linear.signature(shifted)
        differences.append(positive - negative)
    for below, above in pairwise(differences):
        trace = (below - above) // 2  # positive less negative squares of the ideal between the two cuts
        found.append(SimpleIdeal(kind, False, (size - trace) // 2, size))
    return found


def _diagonal(value: fmpq, size: int) -> list[fmpq]:
    return [value if i == j else fmpq(0) for i in range(size) for j in range(size)]


def _between_real_roots(factor: fmpz_poly) -> list[fmpq]:
    """Rational numbers that separate the real roots, with one below and one above them all."""
    import sympy as sp

    variable = sp.Symbol("x")
    intervals: Any = sp.Poly([int(c) for c in reversed(factor.coeffs())], variable).intervals()
    ends = [(sp.Rational(a), sp.Rational(b)) for (a, b), _ in intervals]
    if not ends:
        return [fmpq(0)]
    cuts = [ends[0][0] - 1, *((b + a) / 2 for (_, b), (a, _) in pairwise(ends)), ends[-1][1] + 1]
    return [fmpq(int(c.p), int(c.q)) for c in cuts]


def _restricted(T: fmpq_mat, ideal: fmpq_mat) -> fmpq_mat:
    """T on an invariant subspace, in the rows of `ideal` as a basis (columns are images)."""
    return linear.coordinates(ideal, ideal * T.transpose()).transpose()


def _at(polynomial: fmpq_poly, T: fmpq_mat) -> fmpq_mat:
    """The polynomial of a matrix."""
    n = T.nrows()
    value = fmpq_mat(n, n)
    for coefficient in reversed(polynomial.coeffs()):
        value = value * T + fmpq_mat(n, n, _diagonal(coefficient, n))
    return value


def _generic(centroid: list[fmpq_mat], seed: int) -> tuple[fmpq_mat, fmpq_poly]:
    """An element of the centroid that generates it, and its minimal polynomial."""
    rng = random.Random(seed)
    for attempt in range(ATTEMPTS):
        weights = [fmpq(rng.randint(-2 - attempt, 2 + attempt)) for _ in centroid]
        T = sum((M * w for M, w in zip(centroid[1:], weights[1:], strict=True)), centroid[0] * weights[0])
        minimal = T.minpoly()
        if minimal.degree() == len(centroid) and minimal.gcd(minimal.derivative()).degree() == 0:
            return T, minimal
    raise ArithmeticError("no generator of the centroid was found")


# -- the centroid ---------------------------------------------------------------------------------------------


def _centroid(algebra: LieAlgebra, seed: int) -> list[fmpq_mat]:
    """A basis of all linear maps that commute with every ad x.

    Such a map T takes a regular x into its Cartan subalgebra H, and is known by T x = z, since words in the ad e_i
    that make a basis of g from x make its image from z. So there are rank-many unknowns.
    """
    n = algebra.dimension
    turned = [algebra.adjoint(a).transpose() for a in range(n)]
    for attempt in range(ATTEMPTS):
        x, H = cartan_subalgebra(algebra, seed + attempt)
        words = _words(turned, x)
        if len(words) == n:
            break
    else:
        raise ArithmeticError("no element generates the algebra as an ideal")
    starts = [x, *linear.rows(H)]
    images = [[start] for start in starts]
    for parent, i in words[1:]:
        for chain in images:
            chain.append(_image(turned[i], chain[parent]))
    if _nullity_modulo_a_prime(turned, images) == 1:
        return [linear.matrix([[fmpq(int(i == j)) for j in range(n)] for i in range(n)], n)]
    inverse = linear.matrix(images[0], n).inv()
    maps = [(inverse * linear.matrix(chain, n)).transpose() for chain in images[1:]]
    adjoints = [algebra.adjoint_of(g) for g in algebra.generators()]  # what commutes with these commutes with all
    unknowns = [[entry for ad in adjoints for row in linear.rows(T * ad - ad * T) for entry in row] for T in maps]
    solutions = linear.null_space(linear.matrix(unknowns, len(adjoints) * n**2).transpose())
    combined = []
    for row in linear.rows(solutions):
        combined.append(sum((T * c for T, c in zip(maps[1:], row[1:], strict=True)), maps[0] * row[0]))
    return combined


def _image(turned: fmpq_mat, v: list[fmpq]) -> list[fmpq]:
    """[e_i, v] by the transpose of ad e_i."""
    return (linear.matrix([v], len(v)) * turned).entries()


def _words(turned: list[fmpq_mat], x: list[fmpq]) -> list[tuple[int, int]]:
    """Words (parent, i) that make independent vectors from x: vector j is ad e_i of vector `parent`; the first is x.

    Independence modulo a prime implies independence.
    """
    n = len(x)
    words, vectors = [(-1, -1)], [x]
    known = _Echelon(n)
    known.add(x)
    position = 0
    while position < len(vectors) and len(words) < n:
        for i in range(n):
            v = _image(turned[i], vectors[position])
            if known.add(v):
                words.append((position, i))
                vectors.append(v)
                if len(words) == n:
                    break
        position += 1
    return words


class _Echelon:
    """Vectors in echelon form modulo a prime, grown one at a time."""

    def __init__(self, width: int) -> None:
        self.rows: dict[int, list[int]] = {}
        self.width = width

    def add(self, vector: list[fmpq]) -> bool:
        """Add a vector; whether it is independent of those before."""
        rest = [_residue(v) for v in vector]
        for k in range(self.width):
            if rest[k] == 0:
                continue
            row = self.rows.get(k)
            if row is None:
                inverse = pow(rest[k], -1, PRIME)
                self.rows[k] = [v * inverse % PRIME for v in rest]
                return True
            factor = rest[k]
            rest = [(a - factor * b) % PRIME for a, b in zip(rest, row, strict=True)]
        return False


def _residue(value: fmpq) -> int:
    if value.q % PRIME == 0:
        raise ArithmeticError(f"a denominator is a multiple of {PRIME}: rescale the basis")
    return int(value.p) * pow(int(value.q), -1, PRIME) % PRIME


def _nullity_modulo_a_prime(turned: list[fmpq_mat], images: list[list[list[fmpq]]]) -> int:
    """An upper bound on the centroid's dimension: that of the maps that commute with every ad e_i on one vector.

    The rank of equations modulo a prime is at most their rank.
    """
    n = len(turned)
    reduced = [nmod_mat(n, n, [_residue(v) for row in chain for v in row], PRIME) for chain in images]
    inverse = reduced[0].inv()
    maps = [inverse * chain for chain in reduced[1:]]  # rows are images
    rng = random.Random(1)
    u = nmod_mat(1, n, [rng.randrange(PRIME) for _ in range(n)], PRIME)
    ads = [nmod_mat(n, n, [_residue(v) for v in ad.entries()], PRIME) for ad in turned]  # rows are images
    columns = []
    for T in maps:
        entries: list[int] = []
        for ad in ads:
            difference = u * T * ad - u * ad * T
            entries += [int(difference[0, k]) for k in range(n)]
        columns.append(entries)
    equations = nmod_mat(len(columns), n * n, [v for column in columns for v in column], PRIME)
    return len(columns) - equations.rank()
