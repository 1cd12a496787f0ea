"""Which real Lie algebra it is, proved by invariants that determine it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from html import escape

from flint import fmpq_mat

from canon.display import list_in_html
from canon.errors import InputError
from canon.expected import instance_of, whole_number
from canon.mechanics.algebra import linear
from canon.mechanics.algebra.decomposition import Summand
from canon.mechanics.algebra.decomposition import summands as direct_summands
from canon.mechanics.algebra.families import conjugate_cores, recognised
from canon.mechanics.algebra.ideals import centraliser, centre, derived, whole
from canon.mechanics.algebra.identity import Core, Identity, RealSimple
from canon.mechanics.algebra.levi import levi_decomposition
from canon.mechanics.algebra.lie_algebra import LieAlgebra
from canon.mechanics.algebra.rescaling import rescaled
from canon.mechanics.algebra.semisimple import SimpleIdeal, simple_ideals


@dataclass(frozen=True, slots=True)
class Identification:
    """What was found: the isomorphism class, and the decomposition that shows it.

    **Arguments:** `identity`; `algebra`, rational; `levi` and `radical`, rows; `ideals`, the simple ideals of the Levi
    subalgebra in its own basis; `killing_signature`, the numbers of positive, negative and zero squares; `summands`,
    ideals of which the algebra is the direct sum, each with its name and rows, one ideal for several simple ones that
    are none over the rationals.
    """

    identity: Identity
    algebra: LieAlgebra
    levi: fmpq_mat
    radical: fmpq_mat
    ideals: tuple[SimpleIdeal, ...]
    killing_signature: tuple[int, int, int]
    summands: tuple[tuple[str, fmpq_mat], ...] = ()

    def _repr_html_(self) -> str:
        plus, minus, zero = self.killing_signature
        said = [
            f"dimension {self.algebra.dimension}",
            f"Killing form with {plus} positive, {minus} negative, {zero} zero squares",
            *(f"{name}: spanned by {', '.join(self.words(rows))}" for name, rows in self.summands),
        ]
        return f"<div><b>{escape(str(self.identity))}</b>{list_in_html(said)}</div>"

    def words(self, space: fmpq_mat) -> tuple[str, ...]:
        """The rows of a subspace as formulas in the basis' names."""
        return tuple(
            self.algebra.show({c: linear.fraction(v) for c, v in enumerate(row) if v != 0})
            for row in linear.rows(space)
        )

    def ideal_bases(self) -> tuple[tuple[str, ...], ...]:
        """For each simple ideal that is one over the rationals, its basis as formulas in the basis' names."""
        return tuple(self.words(_rows(ideal) * self.levi) for ideal in self.ideals if ideal.basis is not None)


def identify(algebra: LieAlgebra, seed: int = 0) -> Identification:
    """The isomorphism class over the reals of an algebra with rational structure constants.

    Where a change of scale of the basis makes them rational, the `algebra` that is identified is the rescaled one.

    Direct factors are split off (simple ideals that commute with the radical, central elements outside of [g, g], and
    what the centroid of the rest shows); simple ones are named by complex type, real form or complex structure; of the
    others the families of `canon.mechanics.algebra.families` are recognised, and what is none of them described.

    **Raises:** `InputError` for other structure constants, `ArithmeticError` where a type can't be told.
    """
    instance_of(algebra, LieAlgebra, "algebra")
    seed = whole_number(seed, "seed")
    scaled = rescaled(algebra)
    if scaled is None:
        raise InputError(
            "no change of scale that the assumptions allow makes the structure constants rational: declare the signs "
            "of their parameters (positive, negative), or give values to them"
        )
    algebra, n = scaled.algebra, algebra.dimension
    S, R = levi_decomposition(algebra)
    inner = algebra if S.nrows() == n else algebra.in_basis(S)
    ideals = simple_ideals(inner, seed)
    signature = linear.signature(algebra.killing_form())
    levi = tuple(sorted(_real(ideal) for ideal in ideals))
    if not R.nrows():
        identity = Identity(levi, 0, (), "", levi, n)
        return Identification(identity, algebra, S, R, ideals, signature, _simple_summands(algebra, ideals, S))
    idle = linear.intersection(centraliser(algebra, R), S)  # an ideal that commutes with R
    busy = linear.intersection(centraliser(algebra, idle), S) if idle.nrows() else S
    free_ideals = simple_ideals(algebra.in_basis(idle), seed) if idle.nrows() else ()
    free = tuple(sorted(_real(ideal) for ideal in free_ideals))
    summands = _simple_summands(algebra, free_ideals, idle)
    products, Z = derived(algebra), centre(algebra)
    abelian = linear.complement(linear.intersection(Z, products), Z)
    inside = linear.intersection(products, R)
    beside = linear.complement(linear.span([*linear.rows(inside), *linear.rows(abelian)], n), R)
    core_radical = linear.matrix([*linear.rows(inside), *linear.rows(beside)], n)
    parts: list[Part] = []
    if core_radical.nrows():
        basis = linear.matrix([*linear.rows(busy), *linear.rows(core_radical)], n)
        parts = [
            replace(part, space=part.space * basis) for part in _parts(algebra.in_basis(basis), busy.nrows(), seed)
        ]
    summands += tuple((part.name, part.space) for part in parts)
    cores = tuple(sorted(core for part in parts for core in part.cores))
    other = " + ".join(part.name for part in parts if not part.cores)
    is_open = any(part.is_open for part in parts)
    identity = Identity(free, abelian.nrows(), cores, other, levi, n, is_open)
    if abelian.nrows():
        summands += ((Identity((), abelian.nrows(), (), "", (), abelian.nrows()).name, abelian),)
    return Identification(identity, algebra, S, R, ideals, signature, summands)


@dataclass(frozen=True)
class Part:
    """A direct summand over the rationals: its rows, and the algebras with a name whose sum over R it is, if it is."""

    space: fmpq_mat
    name: str
    cores: tuple[Core, ...] = ()
    is_open: bool = False


def _parts(algebra: LieAlgebra, levi: int, seed: int) -> list[Part]:
    """An algebra without simple or abelian direct factors, whose first rows are a Levi subalgebra, taken apart."""
    n = algebra.dimension
    every = whole(algebra)
    unit = linear.rows(every)
    core = recognised(algebra, linear.matrix(unit[:levi], n), linear.matrix(unit[levi:], n))
    if core is not None:
        return [Part(every, core.name, (core,))]
    try:
        found = direct_summands(algebra, seed)
    except ArithmeticError:
        S, R = levi_decomposition(algebra)
        return [Part(every, _described(_real_ideals(algebra, S, seed), R.nrows()), (), is_open=True)]
    return [_part(algebra.in_basis(part.space), part, seed) for part in found]


def _part(inner: LieAlgebra, part: Summand, seed: int) -> Part:
    """A summand over the rationals, by name where each of those that it is over R has one."""
    S, R = levi_decomposition(inner)
    if part.pairs == 0:
        core = recognised(inner, S, R) if part.real == 1 else conjugate_cores(inner, part.real)
        if core is not None:
            return Part(part.space, " + ".join([core.name] * part.real), (core,) * part.real)
    return Part(part.space, _described(_real_ideals(inner, S, seed), R.nrows()), (), is_open=part.real > 1)


def _simple_summands(
    algebra: LieAlgebra, ideals: tuple[SimpleIdeal, ...], space: fmpq_mat
) -> tuple[tuple[str, fmpq_mat], ...]:
    """Simple ideals of a subalgebra in whose rows they are given, those that are none over the rationals as one."""
    found = [(_real(ideal).names[0], _rows(ideal) * space) for ideal in ideals if ideal.basis is not None]
    rest = [_real(ideal).names[0] for ideal in ideals if ideal.basis is None]
    if rest:
        known = linear.matrix([row for _, rows in found for row in linear.rows(rows)], algebra.dimension)
        joint = linear.intersection(centraliser(algebra, known), space) if found else space
        found.append((" + ".join(rest), joint))
    return tuple(found)


def _rows(ideal: SimpleIdeal) -> fmpq_mat:
    basis = ideal.basis or ()
    return linear.matrix(([linear.rational(u) for u in row] for row in basis), len(basis[0]) if basis else 0)


def _real(ideal: SimpleIdeal) -> RealSimple:
    return RealSimple(ideal.type, ideal.is_complex, ideal.compact_dimension)


def _real_ideals(algebra: LieAlgebra, space: fmpq_mat, seed: int) -> tuple[RealSimple, ...]:
    if not space.nrows():
        return ()
    return tuple(sorted(_real(ideal) for ideal in simple_ideals(algebra.in_basis(space), seed)))


def _described(levi: tuple[RealSimple, ...], radical: int) -> str:
    solvable = f"a solvable algebra of dimension {radical}"
    return f"({' + '.join(s.names[0] for s in levi)}) ⋉ {solvable}" if levi else solvable
