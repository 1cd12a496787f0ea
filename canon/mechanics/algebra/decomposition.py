"""Direct sums of ideals that are none themselves, of an algebra without abelian direct factors.

Direct summands are the images of idempotents of the centroid, the algebra of all linear maps T with
T [x, y] = [x, T y]. Two of them commute but for maps from g to its centre that vanish on [g, g], since
T S [x, y] = [T x, S y] = S T [x, y]; where the centre lies in [g, g] such maps make an ideal of square 0. So the
centroid modulo its radical is a product of number fields, which the factors of the minimal polynomial of a generic T
show, and the rank of tr(T T') says how many dimensions they have. Of a field with r real and 2s complex embeddings the
summand is over R a sum of r + s.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import Final

from flint import fmpq, fmpq_mat, fmpq_poly, nmod_mat

from canon.mechanics.algebra import linear
from canon.mechanics.algebra.lie_algebra import LieAlgebra

PRIME: Final = (1 << 61) - 1
ATTEMPTS: Final = 20
LARGEST: Final = 60
"""The largest dimension that is taken apart."""


@dataclass(frozen=True)
class Summand:
    """An ideal, as rows, that is no direct sum over Q: over R it is one of `real` and `pairs` summands.

    Those of a pair of complex embeddings are complex algebras read as real ones; without any, 1 and 0, it is no direct
    sum over R either.
    """

    space: fmpq_mat
    real: int
    pairs: int


def summands(algebra: LieAlgebra, seed: int = 0) -> tuple[Summand, ...]:
    """The direct summands over Q of an algebra whose centre lies in [g, g], which have no more of them.

    **Raises:** `ArithmeticError` for an algebra that is too large, or where no generic element was found.
    """
    if algebra.dimension > LARGEST:
        raise ArithmeticError(f"at most {LARGEST} dimensions are taken apart")
    maps = centroid(algebra)
    flat = linear.matrix((T.entries() for T in maps), algebra.dimension**2)
    turned = linear.matrix((T.transpose().entries() for T in maps), algebra.dimension**2)
    rank = (flat * turned.transpose()).rank()  # of the centroid modulo its radical
    rng = random.Random(seed)
    for attempt in range(ATTEMPTS):
        weights = [fmpq(rng.randint(-3 - attempt, 3 + attempt)) for _ in maps]
        T = sum((M * w for M, w in zip(maps[1:], weights[1:], strict=True)), maps[0] * weights[0])
        factors = T.minpoly().numer().factor()[1]
        if sum(factor.degree() for factor, _ in factors) == rank:
            return tuple(_summand(T, fmpq_poly(factor), power) for factor, power in factors)
    raise ArithmeticError("no generic element of the centroid was found")


def _summand(T: fmpq_mat, factor: fmpq_poly, power: int) -> Summand:
    """The kernel of f(T)^k, and the embeddings of the field of the irreducible f."""
    n = T.nrows()
    value = fmpq_mat(n, n)
    for coefficient in reversed(factor.coeffs()):
        value = value * T + fmpq_mat(n, n, [coefficient if i == j else fmpq(0) for i in range(n) for j in range(n)])
    whole = value
    for _ in range(power - 1):
        whole = whole * value
    real = 1 if factor.degree() == 1 else _real_roots(factor)
    return Summand(linear.null_space(whole), real, (factor.degree() - real) // 2)


def _real_roots(factor: fmpq_poly) -> int:
    import sympy as sp

    coefficients = [int(c) for c in reversed(factor.numer().coeffs())]
    return int(sp.Poly(coefficients, sp.Symbol("x")).count_roots())


def centroid(algebra: LieAlgebra) -> list[fmpq_mat]:
    """A basis of all linear maps T with T [x, y] = [x, T y], whose columns are images.

    A few elements x_k with words in the ad e_i on them make a basis of g; T is known by the images of the x_k.
    """
    n = algebra.dimension
    turned = [algebra.adjoint(a).transpose() for a in range(n)]  # of row vectors
    words = _words(turned)
    starts = [k for k, (parent, _) in enumerate(words) if parent < 0]
    unit = [[fmpq(int(i == j)) for j in range(n)] for i in range(n)]
    maps: list[fmpq_mat] = []
    for start in (-1, *starts):
        for image in unit if start >= 0 else [[]]:
            chain: list[fmpq_mat] = []
            for k, (parent, i) in enumerate(words):
                if parent >= 0:
                    chain.append(chain[parent] * turned[i])
                elif start < 0:
                    chain.append(linear.matrix([unit[i]], n))
                else:
                    chain.append(linear.matrix([image], n) if k == start else fmpq_mat(1, n))
            maps.append(linear.matrix((row.entries() for row in chain), n))
    inverse = maps[0].inv()
    candidates = [inverse * images for images in maps[1:]]  # rows are images
    equations = [[e for ad in turned for e in (T * ad - ad * T).entries()] for T in candidates]
    solutions = linear.null_space(linear.matrix(equations, n**3).transpose())
    found = []
    for row in linear.rows(solutions):
        T = sum((M * c for M, c in zip(candidates[1:], row[1:], strict=True)), candidates[0] * row[0])
        found.append(T.transpose())
    return found


def _words(turned: list[fmpq_mat]) -> list[tuple[int, int]]:
    """Words (parent, i) that make a basis: vector j is ad e_i of vector `parent`, or e_i itself where that is −1.

    Independence modulo a prime implies independence.
    """
    n = len(turned)
    ads = [nmod_mat(n, n, [_residue(v) for v in ad.entries()], PRIME) for ad in turned]
    words: list[tuple[int, int]] = []
    vectors: list[nmod_mat] = []

    def is_new(v: nmod_mat) -> bool:
        entries = [int(e) for vector in (*vectors, v) for e in vector.entries()]
        return nmod_mat(len(vectors) + 1, n, entries, PRIME).rank() > len(vectors)

    position = 0
    for start in reversed(range(n)):
        first = nmod_mat(1, n, [int(j == start) for j in range(n)], PRIME)
        if not is_new(first):
            continue
        words.append((-1, start))
        vectors.append(first)
        while position < len(vectors):
            for i, ad in enumerate(ads):
                v = vectors[position] * ad
                if is_new(v):
                    words.append((position, i))
                    vectors.append(v)
            position += 1
    return words


def _residue(value: fmpq) -> int:
    if value.q % PRIME == 0:
        raise ArithmeticError(f"a denominator is a multiple of {PRIME}: rescale the basis")
    return int(value.p) * pow(int(value.q), -1, PRIME) % PRIME
