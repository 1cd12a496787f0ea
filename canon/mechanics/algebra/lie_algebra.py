"""A Lie algebra by its structure constants: [e_a, e_b] = Σ_c C^c_ab e_c in a basis e_1 … e_n."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import combinations
from types import MappingProxyType
from typing import Any

import sympy as sp
from flint import fmpq, fmpq_mat

from canon.errors import InputError
from canon.expected import listed, whole_number
from canon.expected import table as table_of
from canon.mechanics.algebra import full_tables, linear
from canon.mechanics.algebra.coefficients import (
    Combination,
    Number,
    as_sympy,
    exact,
    increase,
    is_zero,
    sympy_of,
    times,
)
from canon.mechanics.algebra.given_table import antisymmetric, letters, positions_of
from canon.mechanics.algebra.jacobi import both_orders, jacobi_failure
from canon.mechanics.algebra.linear import fraction, rational


@dataclass(frozen=True, slots=True)
class LieAlgebra:
    """An immutable Lie algebra over the reals, verified on construction.

    **Arguments:** `names` of the basis; `constants`, the combination [e_a, e_b] for each pair of positions a < b (or
    a > b; the rest follows by antisymmetry, and what isn't given is 0). Numbers are exact: whole numbers, fractions,
    sympy numbers, or expressions in parameters.

    **Raises:** `InputError` for a position that isn't one, a number that isn't exact and real, a pair that is given
    twice with different values, or where Jacobi's identity fails: it names the first triple and what its sum is.
    """

    names: tuple[str, ...]
    constants: Mapping[tuple[int, int], Combination]
    _table: dict[tuple[int, int], dict[int, Number]] = field(init=False, repr=False, compare=False, hash=False)
    _full: fmpq_mat | None = field(init=False, repr=False, compare=False, hash=False)

    def __post_init__(self) -> None:
        names = letters(self.names)
        table_of(self.constants, "structure constants", "constants")
        size = len(names)
        if len(set(self.names)) < size:
            raise InputError("a name of the basis is given twice")
        table = antisymmetric(self.names, self.constants)
        object.__setattr__(self, "names", tuple(self.names))
        rows = {pair: MappingProxyType(dict(sorted(row.items()))) for pair, row in sorted(table.items())}
        object.__setattr__(self, "constants", MappingProxyType(rows))
        object.__setattr__(self, "_table", both_orders(table))
        full = full_tables.full_table(self.constants, size)
        object.__setattr__(self, "_full", full)
        right = _rescaled_is_right(self.constants, size) if full is None else full_tables.obeys_jacobi(full)
        failure = None if right else jacobi_failure(self._table, size)
        if failure is not None:
            a, b, c = (self.names[k] for k in failure[0])
            known = any(is_zero(value) is False for value in failure[1].values())
            raise InputError(
                f"Jacobi's identity {'fails' if known else 'is not seen to hold'} for {a}, {b}, {c}: [{a}, [{b}, {c}]] "
                f"and its cyclic permutations add up to {self.show(failure[1])}"
            )

    @staticmethod
    def of(names: Sequence[str], brackets: Mapping[str, Any]) -> LieAlgebra:
        """The algebra of a table "A,B" = combination, as text, as a sympy expression or as {name: coefficient}."""
        return structure(names, brackets)

    def __repr__(self) -> str:
        return f"LieAlgebra(names={self.names!r}, constants={self.__reduce__()[1][1]!r})"

    def _repr_latex_(self) -> str:
        rows = [
            rf"{{}}[{_tex(a)}, {_tex(b)}] &= {sp.latex(as_sympy(row, self.names))}"  # after a break, [ begins an option
            for (i, j), row in self.constants.items()
            for a, b in [(self.names[i], self.names[j])]
            if row
        ]
        body = " \\\\ ".join(rows) or rf"{{}}[\cdot, \cdot] &= 0 \quad \text{{in dimension {self.dimension}}}"
        return rf"$\begin{{aligned}} {body} \end{{aligned}}$"

    def __reduce__(self) -> tuple[Any, ...]:
        return LieAlgebra, (self.names, {pair: dict(row) for pair, row in self.constants.items()})

    def __hash__(self) -> int:
        return hash((self.names, tuple((pair, tuple(row.items())) for pair, row in self.constants.items())))

    @property
    def dimension(self) -> int:
        """The number of basis elements."""
        return len(self.names)

    @property
    def is_rational(self) -> bool:
        """Whether every structure constant is a rational number."""
        return all(isinstance(value, Fraction) for row in self.constants.values() for value in row.values())

    @property
    def parameters(self) -> frozenset[sp.Symbol]:
        """The symbols in the structure constants."""
        found: set[Any] = set()
        for row in self.constants.values():
            for value in row.values():
                if not isinstance(value, Fraction):
                    found |= value.free_symbols
        return frozenset(found)

    def bracket_of(self, a: int, b: int) -> Combination:
        """[e_a, e_b] by positions, from 0; **raises** `InputError` where there is none."""
        for place in (a, b):
            self._check_position(place)
        return MappingProxyType(self._table.get((a, b), {}))

    def _check_position(self, place: Any) -> None:
        whole_number(place, "position", 0)
        if place >= self.dimension:
            raise InputError(f"there is no position {place} in a basis of {self.dimension}", "position")

    def _components(self, x: Any, where: str) -> list[fmpq]:
        """The rational components of an element. **Raises:** `InputError` where there are more or fewer of them."""
        given = listed(x, "components", where)
        if len(given) != self.dimension:
            raise InputError(f"{self.dimension} components are expected, not {len(given)}", where)
        return [v if isinstance(v, fmpq) else rational(_rational(exact(v))) for v in given]

    def bracket(self, x: Mapping[str, Any], y: Mapping[str, Any]) -> dict[str, Number]:
        """[x, y] for elements given as {name: coefficient}; **raises** `InputError` for a name not in the basis."""
        for z in (x, y):
            table_of(z, "coefficients", "element")
        left, right = ({self.position(name): exact(value) for name, value in z.items()} for z in (x, y))
        total: dict[int, Number] = {}
        for a, u in left.items():
            for b, v in right.items():
                for c, w in self.bracket_of(a, b).items():
                    increase(total, c, times(times(u, v), w))
        return {self.names[c]: value for c, value in sorted(total.items())}

    def position(self, name: str) -> int:
        """The place of a basis element; **raises** `InputError` for another name."""
        if not isinstance(name, str) or name not in self.names:
            raise InputError(f"{name!r} is none of the basis {', '.join(self.names)}")
        return self.names.index(name)

    def show(self, element: Combination) -> str:
        """A combination of the basis, as a formula; **raises** `InputError` for a position that there isn't."""
        table_of(element, "coefficients, by their positions,", "element")
        for place in element:
            self._check_position(place)
        return str(as_sympy({place: exact(value) for place, value in element.items()}, self.names))

    def rows(self) -> Iterator[tuple[str, str, str]]:
        """The brackets that are not 0, each as (first name, second name, value)."""
        for (a, b), row in self.constants.items():
            yield self.names[a], self.names[b], self.show(row)

    def adjoint(self, a: int) -> fmpq_mat:
        """ad e_a, whose column b is [e_a, e_b]; for rational structure constants."""
        self._check_position(a)
        if self._full is not None:
            return full_tables.ad_of_basis(self._full, a)
        return self.adjoint_of([fmpq(int(b == a)) for b in range(self.dimension)])

    def adjoint_of(self, x: Sequence[fmpq]) -> fmpq_mat:
        """ad x, whose column b is [x, e_b]; for rational structure constants and components."""
        x = self._components(x, "x")
        if self._full is not None:
            return full_tables.ad(self._full, x)
        values = fmpq_mat(self.dimension, self.dimension)
        for a, u in enumerate(x):
            if u != 0:
                for b in range(self.dimension):
                    for c, w in self.bracket_of(a, b).items():
                        values[c, b] += u * rational(_rational(w))
        return values

    def killing_form(self) -> fmpq_mat:
        """K_ab = tr(ad e_a ad e_b); for rational structure constants."""
        if self._full is not None:
            return full_tables.killing_form(self._full)
        size = self.dimension
        flat = linear.matrix(([x for row in linear.rows(self.adjoint(a)) for x in row] for a in range(size)), size**2)
        turned = linear.matrix(
            ([x for row in linear.rows(self.adjoint(a).transpose()) for x in row] for a in range(size)), size**2
        )
        return flat * turned.transpose()

    def adjoint_matrix(self, a: int) -> sp.Matrix:
        """ad e_a, whose column b is [e_a, e_b], for any structure constants."""
        n = self.dimension
        return sp.Matrix(n, n, lambda c, b: sympy_of(self.bracket_of(a, b).get(c, Fraction(0))))

    def killing_matrix(self) -> sp.Matrix:
        """K_ab = tr(ad e_a ad e_b), for any structure constants: formulas in their parameters."""
        n = self.dimension
        ad = [self.adjoint_matrix(a) for a in range(n)]
        return sp.Matrix(
            n, n, lambda a, b: sp.expand(sum(ad[a][i, j] * ad[b][j, i] for i in range(n) for j in range(n)))
        )

    def product(self, x: Sequence[fmpq], y: Sequence[fmpq]) -> list[fmpq]:
        """[x, y] for vectors of rational components."""
        x, y = self._components(x, "x"), self._components(y, "y")
        if self._full is not None:
            return (self.adjoint_of(x) * fmpq_mat(self.dimension, 1, y)).entries()
        total = [fmpq(0)] * self.dimension
        left = [(a, u) for a, u in enumerate(x) if u != 0]
        right = [(b, v) for b, v in enumerate(y) if v != 0]
        for a, u in left:
            for b, v in right:
                for c, w in self.bracket_of(a, b).items():
                    total[c] += u * v * rational(_rational(w))
        return total

    def generators(self) -> list[list[fmpq]]:
        """Elements that generate the algebra: few of them for a full table, else the basis."""
        if self._full is not None:
            return full_tables.generators(self._full)
        return [[fmpq(int(b == a)) for b in range(self.dimension)] for a in range(self.dimension)]

    def images(self, x: Sequence[fmpq], space: fmpq_mat) -> fmpq_mat:
        """[x, y] for the rows y of a matrix, as rows."""
        space = self._rows(space, "space")
        if self._full is not None:
            return space * self.adjoint_of(x).transpose()
        return linear.matrix((self.product(x, y) for y in linear.rows(space)), self.dimension)

    def products(self, space: fmpq_mat) -> Iterator[list[fmpq]]:
        """[x, y] for all pairs of rows x before y of a matrix."""
        given = linear.rows(self._rows(space, "space"))
        for a, x in enumerate(given):
            yield from linear.rows(self.images(x, linear.matrix(given[a + 1 :], self.dimension)))

    def in_basis(self, basis: fmpq_mat | Sequence[Sequence[Any]], names: Sequence[str] = ()) -> LieAlgebra:
        """The subalgebra that the rows span, in that basis: a change of basis where they span everything.

        **Arguments:** `basis`, rational rows, as flint's matrix or nested lists; `names` of the new basis.

        **Raises:** `InputError` where they are dependent or don't close under the bracket.
        """
        basis = self._rows(basis, "basis")
        names = letters(names) if isinstance(names, str) else listed(names, "names", "names")
        size = basis.nrows()
        pairs = list(combinations(range(size), 2))
        brackets = linear.matrix(self.products(basis), self.dimension)
        try:
            found = linear.rows(linear.coordinates(basis, brackets))
        except ValueError as error:
            raise InputError(f"these elements don't make a subalgebra: {error}") from None
        constants = {
            pair: {c: fraction(value) for c, value in enumerate(row) if value != 0}
            for pair, row in zip(pairs, found, strict=True)
        }
        return LieAlgebra(names or tuple(f"e{k + 1}" for k in range(size)), constants)

    def _rows(self, space: Any, where: str) -> fmpq_mat:
        """Rational rows as a matrix. **Raises:** `InputError` for rows of another length."""
        if isinstance(space, fmpq_mat) and space.ncols() in (self.dimension, 0):
            return space
        rows = space.tolist() if isinstance(space, fmpq_mat) else listed(space, "rows", where)
        return linear.matrix([self._components(row, where) for row in rows], self.dimension)


def _tex(name: str) -> str:
    return sp.latex(sp.Symbol(name))


def structure(names: Sequence[str], brackets: Mapping[str, Any]) -> LieAlgebra:
    """The Lie algebra of a table "A,B" = {C: coefficient}, or = a combination as text or as a sympy expression.

    **Raises:** `InputError` for a pair or a name that isn't of the basis, or where `LieAlgebra` does.
    """
    basis = letters(names)
    return LieAlgebra(basis, positions_of(basis, brackets))


def _rational(value: Number) -> Fraction:
    if not isinstance(value, Fraction):
        raise InputError(f"{value} isn't rational: rescale the basis first")
    return value


def _rescaled_is_right(constants: Mapping[tuple[int, int], Combination], size: int) -> bool:
    """Whether Jacobi's identity holds for constants that a change of scale makes rational, which is quicker to see."""
    from canon.mechanics.algebra.rescaling import rational_table

    if all(isinstance(value, Fraction) for row in constants.values() for value in row.values()):
        return False
    found = rational_table(constants, size)
    return found is not None and jacobi_failure(both_orders(found[0]), size) is None
