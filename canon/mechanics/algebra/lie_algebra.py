"""A Lie algebra by its structure constants: [e_a, e_b] = Σ_c C^c_ab e_c in a basis e_1 … e_n."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import combinations
from typing import Any

import sympy as sp
from flint import fmpq, fmpq_mat

from canon.errors import InputError
from canon.expression import Vocabulary, read
from canon.mechanics.algebra import linear
from canon.mechanics.algebra.linear import fraction, rational

Number = Fraction | sp.Expr
"""A structure constant: a rational number, or an expression in parameters (an algebraic number too)."""

Combination = Mapping[int, Number]
"""Coefficients by the position of the basis element; what isn't there is 0."""


@dataclass(frozen=True, slots=True)
class LieAlgebra:
    """An immutable Lie algebra over the reals, verified on construction.

    **Arguments:** `names` of the basis; `constants`, the combination [e_a, e_b] for each pair of positions a < b (or
    a > b; the rest follows by antisymmetry, and what isn't given is 0). Numbers are exact: whole numbers, fractions,
    sympy numbers, or expressions in parameters.

    **Raises:** `InputError` where a pair is given twice with different values, or where Jacobi's identity fails: it
    names the first triple and what its sum is.
    """

    names: tuple[str, ...]
    constants: Mapping[tuple[int, int], Combination]
    _table: dict[tuple[int, int], dict[int, Number]] = field(init=False, repr=False, compare=False, hash=False)

    def __post_init__(self) -> None:
        size = len(self.names)
        if len(set(self.names)) < size:
            raise InputError("a name of the basis is given twice")
        table = _antisymmetric(self.names, self.constants)
        object.__setattr__(self, "names", tuple(self.names))
        object.__setattr__(self, "constants", {pair: dict(row) for pair, row in sorted(table.items())})
        object.__setattr__(self, "_table", _both_orders(table))
        failure = None if _rescaled_is_right(self.constants, size) else jacobi_failure(self)
        if failure is not None:
            a, b, c = (self.names[k] for k in failure[0])
            raise InputError(
                f"Jacobi's identity fails for {a}, {b}, {c}: [{a}, [{b}, {c}]] and its cyclic permutations add up to "
                f"{self.show(failure[1])}"
            )

    @staticmethod
    def of(names: Sequence[str], brackets: Mapping[str, Any]) -> LieAlgebra:
        """The algebra of a table "A,B" = combination, as text, as a sympy expression or as {name: coefficient}."""
        return structure(names, brackets)

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
        """[e_a, e_b] by positions."""
        return self._table.get((a, b), {})

    def bracket(self, x: Mapping[str, Any], y: Mapping[str, Any]) -> dict[str, Number]:
        """[x, y] for elements given as {name: coefficient}; **raises** `InputError` for a name not in the basis."""
        left, right = ({self.position(name): exact(value) for name, value in z.items()} for z in (x, y))
        total: dict[int, Number] = {}
        for a, u in left.items():
            for b, v in right.items():
                for c, w in self.bracket_of(a, b).items():
                    _increase(total, c, times(times(u, v), w))
        return {self.names[c]: value for c, value in sorted(total.items())}

    def position(self, name: str) -> int:
        """The place of a basis element; **raises** `InputError` for another name."""
        if name not in self.names:
            raise InputError(f"{name!r} is none of the basis {', '.join(self.names)}")
        return self.names.index(name)

    def show(self, element: Combination) -> str:
        """A combination of the basis, as a formula."""
        return str(as_sympy(element, self.names))

    def rows(self) -> Iterator[tuple[str, str, str]]:
        """The brackets that are not 0, each as (first name, second name, value)."""
        for (a, b), row in self.constants.items():
            yield self.names[a], self.names[b], self.show(row)

    def adjoint(self, a: int) -> fmpq_mat:
        """ad e_a, whose column b is [e_a, e_b]; for rational structure constants."""
        values = fmpq_mat(self.dimension, self.dimension)
        for b in range(self.dimension):
            for c, value in self.bracket_of(a, b).items():
                values[c, b] = rational(_rational(value))
        return values

    def killing_form(self) -> fmpq_mat:
        """K_ab = tr(ad e_a ad e_b); for rational structure constants."""
        size = self.dimension
        flat = linear.matrix(([x for row in linear.rows(self.adjoint(a)) for x in row] for a in range(size)), size**2)
        turned = linear.matrix(
            ([x for row in linear.rows(self.adjoint(a).transpose()) for x in row] for a in range(size)), size**2
        )
        return flat * turned.transpose()

    def product(self, x: Sequence[fmpq], y: Sequence[fmpq]) -> list[fmpq]:
        """[x, y] for vectors of rational components."""
        total = [fmpq(0)] * self.dimension
        left = [(a, u) for a, u in enumerate(x) if u != 0]
        right = [(b, v) for b, v in enumerate(y) if v != 0]
        for a, u in left:
            for b, v in right:
                for c, w in self.bracket_of(a, b).items():
                    total[c] += u * v * rational(_rational(w))
        return total

    def in_basis(self, basis: fmpq_mat, names: Sequence[str] = ()) -> LieAlgebra:
        """The subalgebra that the rows span, in that basis: a change of basis where they span everything.

        **Raises:** `InputError` where they are dependent or don't close under the bracket.
        """
        given = linear.rows(basis)
        size = len(given)
        pairs = list(combinations(range(size), 2))
        brackets = linear.matrix((self.product(given[a], given[b]) for a, b in pairs), self.dimension)
        try:
            found = linear.rows(linear.coordinates(basis, brackets))
        except ValueError as error:
            raise InputError(f"these elements don't make a subalgebra: {error}") from None
        constants = {
            pair: {c: fraction(value) for c, value in enumerate(row) if value != 0}
            for pair, row in zip(pairs, found, strict=True)
        }
        return LieAlgebra(tuple(names) or tuple(f"e{k + 1}" for k in range(size)), constants)


def structure(names: Sequence[str], brackets: Mapping[str, Any]) -> LieAlgebra:
    """The Lie algebra of a table "A,B" = {C: coefficient}, or = a combination as text or as a sympy expression.

    **Raises:** `InputError` for a pair or a name that isn't of the basis, or where `LieAlgebra` does.
    """
    places = {name: k for k, name in enumerate(names)}
    constants: dict[tuple[int, int], dict[int, Any]] = {}
    for pair, value in brackets.items():
        words = [word.strip() for word in pair.split(",")]
        if len(words) != 2 or not set(words) <= set(places):
            raise InputError(f'a pair of the basis {", ".join(names)} is expected, as "A,B", not {pair!r}')
        row = value if isinstance(value, Mapping) else _coefficients(value, names)
        for name in row:
            if name not in places:
                raise InputError(f"{name!r} is none of the basis {', '.join(names)}")
        constants[places[words[0]], places[words[1]]] = {places[name]: number for name, number in row.items()}
    return LieAlgebra(tuple(names), constants)


def _coefficients(value: Any, names: Sequence[str]) -> dict[str, Any]:
    if isinstance(value, str):
        value = read(value, Vocabulary(symbols={name: sp.Symbol(name) for name in names})).expr
    if not isinstance(value, sp.Expr):
        raise InputError(f"a linear combination of basis elements is expected, not {value!r}")
    expression = sp.expand(value)
    own = {symbol for symbol in expression.free_symbols if symbol.name in names}
    found = {symbol.name: expression.coeff(symbol) for symbol in own}
    rest = expression - sp.Add(*(number * symbol for symbol in own for number in [found[symbol.name]]))
    if sp.expand(rest) != 0 or any(number.has(*own) for number in found.values()):
        raise InputError(f"a linear combination of basis elements is expected, not {value}")
    return found


def exact(value: Any) -> Number:
    """The number as a fraction where it is rational, else as a sympy expression; **raises** `InputError` for floats."""
    if isinstance(value, Fraction):
        return value
    if isinstance(value, fmpq):
        return fraction(value)
    expression: Any = sp.Integer(value) if isinstance(value, int) else value
    if not hasattr(expression, "is_commutative") or not hasattr(expression, "expand") or expression.has(sp.Float):
        raise InputError(f"{value!r} is no exact number: give a whole number, a fraction or an expression")
    return Fraction(int(expression.p), int(expression.q)) if expression.is_Rational else expression


def times(a: Number, b: Number) -> Number:
    """The product of two numbers."""
    if isinstance(a, Fraction) and isinstance(b, Fraction):
        return a * b
    return exact(sp.expand(_sympy(a) * _sympy(b)))


def plus(a: Number, b: Number) -> Number:
    """The sum of two numbers, 0 where it is recognised as 0."""
    if isinstance(a, Fraction) and isinstance(b, Fraction):
        return a + b
    total = sp.expand(_sympy(a) + _sympy(b))
    if total != 0 and total.has(sp.Pow):
        total = sp.radsimp(sp.cancel(total)) if not total.has(sp.Function) else sp.simplify(total)
    return exact(total)


def as_sympy(element: Combination, names: Sequence[str]) -> sp.Expr:
    """A combination of the basis as a sum of symbols."""
    return sp.Add(*(_sympy(value) * sp.Symbol(names[c]) for c, value in element.items()))


def _sympy(value: Number) -> sp.Expr:
    return sp.Rational(value.numerator, value.denominator) if isinstance(value, Fraction) else value


def _rational(value: Number) -> Fraction:
    if not isinstance(value, Fraction):
        raise InputError(f"the structure constant {value} isn't rational: rescale the basis first")
    return value


def _increase(total: dict[int, Number], c: int, value: Number) -> None:
    new = plus(total[c], value) if c in total else value
    if new == 0:
        total.pop(c, None)
    else:
        total[c] = new


def _antisymmetric(names: Sequence[str], given: Mapping[tuple[int, int], Combination]) -> dict[Any, dict[int, Number]]:
    table: dict[tuple[int, int], dict[int, Number]] = {}
    for (a, b), row in given.items():
        numbers = {c: value for c, value in ((c, exact(value)) for c, value in row.items()) if value != 0}
        if a == b and numbers:
            raise InputError(f"the bracket of {names[a]} with itself is 0")
        if a > b:
            a, b, numbers = b, a, {c: times(value, Fraction(-1)) for c, value in numbers.items()}
        if table.setdefault((a, b), numbers) != numbers:
            raise InputError(f"the bracket of {names[a]} and {names[b]} is stated twice, differently")
    return {pair: row for pair, row in table.items() if row}


def _both_orders(table: Mapping[tuple[int, int], dict[int, Number]]) -> dict[tuple[int, int], dict[int, Number]]:
    turned = {(b, a): {c: times(v, Fraction(-1)) for c, v in row.items()} for (a, b), row in table.items()}
    return {**table, **turned}


def _rescaled_is_right(constants: Mapping[tuple[int, int], Combination], size: int) -> bool:
    """Whether Jacobi's identity holds for constants that a change of scale makes rational, which is quicker to see."""
    from canon.mechanics.algebra.rescaling import rational_table

    if all(isinstance(value, Fraction) for row in constants.values() for value in row.values()):
        return False
    found = rational_table(constants, size)
    return found is not None and jacobi_sum_fails(_both_orders(found[0]), size) is None


def jacobi_failure(algebra: LieAlgebra) -> tuple[tuple[int, int, int], Combination] | None:
    """The first triple whose cyclic sum [a, [b, c]] + [b, [c, a]] + [c, [a, b]] isn't 0, and that sum; None if none.

    Only triples with a pair that doesn't commute are looked at.
    """
    return jacobi_sum_fails(algebra._table, algebra.dimension)


def jacobi_sum_fails(
    table: Mapping[tuple[int, int], Combination], size: int
) -> tuple[tuple[int, int, int], Combination] | None:
    """The same for a table of brackets in both orders."""
    empty: Combination = {}
    for a, b, c in combinations(range(size), 3):
        inner = (
            (a, table.get((b, c), empty)),
            (b, table.get((c, a), empty)),
            (c, table.get((a, b), empty)),
        )
        total: dict[int, Number] = {}
        for outer, row in inner:
            for d, u in row.items():
                for e, v in table.get((outer, d), empty).items():
                    _increase(total, e, times(u, v))
        left = {e: value for e, value in total.items() if isinstance(value, Fraction) or not _vanishes(value)}
        if left:
            return (a, b, c), left
    return None


def _vanishes(value: sp.Expr) -> bool:
    """Whether an expression that wasn't recognised as 0 is 0 in 60 digits at some values of its parameters."""
    for shift in range(3):
        values = {}
        for k, symbol in enumerate(sorted(value.free_symbols, key=str)):
            number = sp.Rational(7 + 4 * k + shift, 5 + 2 * shift)
            values[symbol] = -number if symbol.is_negative else number
        if abs(sp.N(value.xreplace(values), 60, chop=True)) > sp.Float("1e-40", 60):
            return False
    return True
