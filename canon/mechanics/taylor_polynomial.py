"""The Taylor polynomial of a function at the origin of phase space, with exact coefficients."""

from collections.abc import Iterator, Sequence
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from canon.errors import InputError
from canon.mechanics.graded_algebra import GradedAlgebra, Polynomial, algebra_over

MOST_OPERATIONS = 4000


def homogeneous_parts(
    f: sp.Expr, variables: Sequence[sp.Symbol], order: int, *more: sp.Expr
) -> tuple[GradedAlgebra, list[dict[int, Polynomial]]]:
    """An algebra, and the parts of degree 0 to `order` of f and of further functions, by degree.

    **Raises:** `InputError` where a function isn't analytic at the origin as it is written; `ValueError` where its
    coefficients, or a function in it, are outside of exact arithmetic.
    """
    functions = (f, *more)
    origin = dict.fromkeys(variables, sp.S.Zero)
    numbers: dict[sp.Expr, None] = {}
    for function in functions:
        if sp.count_ops(function) > MOST_OPERATIONS:
            raise ValueError("a very long formula")
        for node in sp.preorder_traversal(function):
            numbers.update(dict.fromkeys(_numbers(node, origin, order)))
    algebra = algebra_over(variables, numbers)
    return algebra, [_Expansion(algebra, origin, order).of(function) for function in functions]


def _numbers(node: Any, origin: dict[Any, Any], order: int) -> Iterator[sp.Expr]:
    """The coefficients that the expansion of one node brings in."""
    if not set(origin) & node.free_symbols:
        yield node
    elif isinstance(node, sp.Pow) and not (node.exp.is_Integer and node.exp.is_nonnegative):
        base = _at(node.base, origin)
        if base.is_zero:
            raise InputError(f"{node} isn't analytic at the origin, where the claim is made")
        yield from (base**node.exp, 1 / base, node.exp)
    elif isinstance(node, sp.Function):
        yield from _taylor(node, origin, order)


def _at(expression: Any, origin: dict[Any, Any]) -> sp.Expr:
    value = expression.xreplace(origin)
    if value.has(sp.zoo, sp.nan, sp.oo):
        raise InputError(f"{expression} isn't analytic at the origin, where the claim is made")
    return value


def _taylor(node: Any, origin: dict[Any, Any], order: int) -> list[sp.Expr]:
    """f(c), f'(c), f''(c)/2, … of a function of one argument whose value at the origin is c."""
    if isinstance(node, AppliedUndef):
        raise ValueError("an arbitrary function")
    if len(node.args) != 1:
        raise ValueError(f"{node.func} of several arguments")
    u = sp.Dummy("u")
    c, slope, found = _at(node.args[0], origin), node.func(u), []
    for k in range(order + 1):
        value = slope.subs(u, c) / sp.factorial(k)
        if value.has(sp.zoo, sp.nan, sp.oo):
            raise InputError(f"{node} isn't analytic at the origin, where the claim is made")
        found.append(value)
        slope = sp.diff(slope, u)
    return found


class _Expansion:
    """Expands subexpressions, shared ones once."""

    def __init__(self, algebra: GradedAlgebra, origin: dict[Any, Any], order: int) -> None:
        self.algebra, self.origin, self.order = algebra, origin, order
        self.images = dict(zip(algebra.variables, algebra.generators, strict=True))
        self.known: dict[Any, dict[int, Polynomial]] = {}

    def of(self, node: Any) -> dict[int, Polynomial]:
        if node not in self.known:
            self.known[node] = self.expand(node)
        return self.known[node]

    def expand(self, node: Any) -> dict[int, Polynomial]:
        algebra = self.algebra
        if node in self.images:
            return {1: self.images[node]}
        if not set(self.origin) & node.free_symbols:
            return self.number(node)
        if isinstance(node, sp.Add):
            total: dict[int, Polynomial] = {}
            for part in node.args:
                for degree, value in self.of(part).items():
                    total[degree] = total.get(degree, algebra.zero) + value
            return total
        if isinstance(node, sp.Mul):
            value = self.number(sp.S.One)
            for part in node.args:
                value = self.product(value, self.of(part))
            return value
        if isinstance(node, sp.Pow):
            return self.power(node)
        if isinstance(node, sp.Function):
            return self.composed(_taylor(node, self.origin, self.order), self.of(node.args[0]))
        raise ValueError(f"{type(node).__name__} isn't expanded")

    def number(self, value: Any) -> dict[int, Polynomial]:
        return {0: self.algebra.one * self.algebra.constant(value)} if value != 0 else {}

    def product(self, f: dict[int, Polynomial], g: dict[int, Polynomial]) -> dict[int, Polynomial]:
        out: dict[int, Polynomial] = {}
        for i, a in f.items():
            for j, b in g.items():
                if i + j <= self.order:
                    out[i + j] = out.get(i + j, self.algebra.zero) + a * b
        return out

    def power(self, node: Any) -> dict[int, Polynomial]:
        base, exponent = self.of(node.base), node.exp
        if exponent.is_Integer and exponent >= 0:
            value = self.number(sp.S.One)
            for _ in range(int(exponent)):
                value = self.product(value, base)
            return value
        if set(self.origin) & exponent.free_symbols:
            raise ValueError("a variable in an exponent")
        c = _at(node.base, self.origin)
        binomials = [c**exponent * sp.ff(exponent, k) / sp.factorial(k) / c**k for k in range(self.order + 1)]
        return self.composed(binomials, base)

    def composed(self, series: Sequence[sp.Expr], argument: dict[int, Polynomial]) -> dict[int, Polynomial]:
        """Σ series[k] · (argument − its value at the origin)ᵏ, by Horner's rule."""
        rest = {degree: value for degree, value in argument.items() if degree}
        value: dict[int, Polynomial] = {}
        for number in reversed(series):
            value = self.product(value, rest)
            for degree, part in self.number(number).items():
                value[degree] = value.get(degree, self.algebra.zero) + part
        return value
