"""Polynomials on phase space with exact coefficients: the Poisson algebra in which normal forms are computed.

Rational coefficients are FLINT's sparse polynomials; others (parameters, square roots) lie in a field of sympy's. Both
kinds of polynomial know + and *, and here their derivatives, coefficients and degrees get one name each.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, cast

import flint
import sympy as sp

Polynomial = Any  # flint.fmpq_mpoly or sympy's PolyElement; neither has type stubs
Exponents = tuple[int, ...]


@dataclass(frozen=True)
class GradedAlgebra:
    """Polynomials in (q, p), positions first, over an exact field.

    **Arguments:** the `variables`; `generators`, these as polynomials; `one`; `derivative(f, i)` by the i-th variable;
    `constant(number)`, a coefficient from an expression; `value(coefficient)`, the expression of one.
    """

    variables: tuple[sp.Symbol, ...]
    generators: tuple[Polynomial, ...]
    one: Polynomial
    derivative: Callable[[Polynomial, int], Polynomial]
    constant: Callable[[Any], Any]
    value: Callable[[Any], sp.Expr]

    @property
    def n(self) -> int:
        """The number of degrees of freedom."""
        return len(self.variables) // 2

    @property
    def zero(self) -> Polynomial:
        """The polynomial 0."""
        return self.one - self.one

    def bracket(self, f: Polynomial, g: Polynomial) -> Polynomial:
        """{f, g}."""
        n, total = self.n, self.zero
        for i in range(n):
            total = total + self.derivative(f, i) * self.derivative(g, i + n)
            total = total - self.derivative(f, i + n) * self.derivative(g, i)
        return total

    def parts(self, f: Polynomial) -> dict[int, Polynomial]:
        """The homogeneous parts of a polynomial by degree."""
        found: dict[int, list[Polynomial]] = {}
        for exponents, coefficient in terms(f):
            found.setdefault(sum(exponents), []).append(self.monomial(exponents) * coefficient)
        return {degree: self.sum(group) for degree, group in found.items()}

    def monomial(self, exponents: Exponents) -> Polynomial:
        """The product of powers of the variables."""
        value = self.one
        for x, e in zip(self.generators, exponents, strict=True):
            if e:
                value = value * x**e
        return value

    def sum(self, group: Iterable[Polynomial]) -> Polynomial:
        """The sum of many, by halves: adding one by one copies the long sum each time."""
        rest = list(group)
        while len(rest) > 1:
            rest = [rest[i] + rest[i + 1] if i + 1 < len(rest) else rest[i] for i in range(0, len(rest), 2)]
        return rest[0] if rest else self.zero

    def expression(self, f: Polynomial) -> sp.Expr:
        """The polynomial as a sympy expression."""
        return sp.Add(
            *(
                self.value(c) * sp.Mul(*(x**e for x, e in zip(self.variables, exponents, strict=True)))
                for exponents, c in terms(f)
            )
        )


def terms(f: Polynomial) -> list[tuple[Exponents, Any]]:
    """(exponents, coefficient) of each term, none twice."""
    if isinstance(f, flint.fmpq_mpoly):
        return [(tuple(map(int, e)), c) for e, c in f.to_dict().items()]
    return [(tuple(e), c) for e, c in f.items()]


def coefficient(f: Polynomial, exponents: Exponents) -> Any:
    """The coefficient of one monomial."""
    return f[exponents] if isinstance(f, flint.fmpq_mpoly) else f.get(exponents, f.ring.domain.zero)


def algebra_over(variables: Sequence[sp.Symbol], numbers: Iterable[sp.Expr]) -> GradedAlgebra:
    """The polynomials in these variables over the least field that sympy finds for the numbers.

    **Raises:** `ValueError` where that isn't a field of exact arithmetic: Q, Q with algebraic numbers, or rational
    functions of parameters.
    """
    numbers = [sp.sympify(number) for number in numbers]
    symbols = tuple(variables)
    if all(number.is_Rational for number in numbers):
        context: Any = flint.fmpq_mpoly_ctx.get(tuple(f"x{i}" for i in range(len(symbols))), flint.Ordering.deglex)
        return GradedAlgebra(
            symbols,
            tuple(context.gens()),
            context.constant(1),
            lambda f, i: f.derivative(i),
            lambda number: flint.fmpq(int(sp.sympify(number).p), int(sp.sympify(number).q)),
            lambda c: sp.Rational(int(c.p), int(c.q)),
        )
    field, _ = sp.construct_domain(numbers, field=True, extension=True)
    if not (field.is_QQ or field.is_Algebraic or field.is_FractionField) or not _exact(field):
        raise ValueError(f"coefficients in {field}")
    ring: Any = sp.ring(symbols, field, cast(Any, sp.grlex))[0]
    return GradedAlgebra(
        symbols,
        tuple(ring.gens),
        ring.one,
        lambda f, i: f.diff(ring.gens[i]),
        lambda number: field.from_sympy(sp.sympify(number)),
        field.to_sympy,
    )


def _exact(field: Any) -> bool:
    """Whether elements of the field are 0 only where they are 0 as numbers, whatever the parameters are."""
    if field.is_QQ or field.is_Algebraic:
        return True
    inner = field.dom
    known = all(x.is_Symbol or x is sp.pi for x in field.symbols)  # cos(1) and sin(1), say, aren't independent
    return known and bool(inner.is_QQ or inner.is_ZZ or (inner.is_Algebraic and sp.pi not in field.symbols))
