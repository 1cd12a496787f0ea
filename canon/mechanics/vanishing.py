"""Whether an expression is exactly 0: by normal form for "yes", by balls at a point for "no".

Roots are generators t with t^n = a polynomial in those below, i with i² = −1, sines with sin² = 1 − cos²; all else that
isn't rational is a free generator. An expression whose numerator is 0 modulo these relations vanishes wherever it is
defined, for every branch of its roots. A number that isn't so reduced is a root of the characteristic polynomial of its
multiplication on the algebra of its roots, so that a ball within Cauchy's bound on the others proves 0.

What a claim says is decided above, in `canon.decide`; this serves the values of this floor, which are verified when
they are made.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import product
from typing import Any, Final

import flint
import sympy as sp
from flint import acb, arb, fmpq, fmpq_mat, fmpq_mpoly, fmpq_mpoly_ctx
from sympy.core.function import AppliedUndef

from canon.sign import declared

BITS: Final = (128, 1024, 8192)
LARGEST: Final = 96
"""The highest dimension of an algebra of roots whose characteristic polynomial is taken."""
LONGEST: Final = 20000
"""The most operations of an expression that is brought to normal form."""
_FUNCTIONS: Final = ("exp", "log", "sin", "cos", "tan", "sinh", "cosh", "tanh", "asin", "acos", "atan", "asinh")


class _Unknown(Exception):
    """Something that isn't understood, or isn't defined at the point."""


def vanishes(expression: Any) -> bool | None:
    """Whether an exact expression is 0 wherever it is defined: True and False are proofs, None says it isn't known.

    False says that it isn't 0 at some values of its names that their assumptions allow.
    """
    if expression.is_Rational:
        return expression == 0
    if expression.has(sp.Float, AppliedUndef, sp.Derivative, sp.Integral, sp.Piecewise):
        return None
    values = list(_places(expression))
    if any(_excludes_zero(expression, there, BITS[0]) for there in values):
        return False
    numerator = _Numerator.of(expression)
    if numerator is not None and any(_is_defined(expression, there) for there in values):
        if numerator.value == 0:
            return True
        bound = None if expression.free_symbols else numerator.bound()
        if bound is not None:
            return _by_bound(numerator, bound)
    if any(_excludes_zero(expression, there, BITS[1]) for there in values[:1]):
        return False
    return None


def sign_at_a_point(expression: Any) -> int | None:
    """1 or −1, the certified sign of a real expression at values of its names that are allowed; None: it isn't known.

    Of a number that is its sign.
    """
    for there in _places(expression):
        for bits in BITS[:2]:
            ball = ball_of(expression, there, bits)
            if ball is not None and ball.imag.contains(0) and not ball.real.contains(0):
                return 1 if ball.real > 0 else -1
    return None


# -- balls -----------------------------------------------------------------------------------------------------


@contextmanager
def _precision(bits: int) -> Iterator[None]:
    before = flint.ctx.prec
    flint.ctx.prec = bits
    try:
        yield
    finally:
        flint.ctx.prec = before


def ball_of(expression: Any, values: Mapping[Any, Any], bits: int = BITS[0]) -> acb | None:
    """A ball that holds the principal value at rational values of the names; None where none is certified."""
    with _precision(bits):
        try:
            found = _ball(expression, values, bits)
        except (_Unknown, ZeroDivisionError, OverflowError):
            return None
        return found if found.is_finite() else None


def _excludes_zero(expression: Any, values: Mapping[Any, Any], bits: int) -> bool:
    found = ball_of(expression, values, bits)
    return found is not None and not found.contains(0)


def _is_defined(expression: Any, values: Mapping[Any, Any]) -> bool:
    return ball_of(expression, values) is not None


def _places(expression: Any) -> Iterator[dict[Any, Any]]:
    """A few values of the names, such as their assumptions allow."""
    names = sorted(expression.free_symbols, key=str)
    for shift in range(3 if names else 1):
        found: dict[Any, Any] = {}
        for k, name in enumerate(names):
            sign = -1 if (k + shift) % 2 else 1
            fraction = sp.Rational(sign * (7 + 4 * k + shift), 5 + 2 * shift)
            whole = sp.Integer(sign * (2 + k + shift))
            number = next((n for n in (fraction, -fraction, whole, -whole, sp.S.Zero) if _allows(name, n)), None)
            if number is None:
                return
            found[name] = number
        yield found


def _allows(name: Any, number: Any) -> bool:
    return all(getattr(number, f"is_{word}", None) is value for word, value in declared(name).items())


def _ball(expression: Any, values: Mapping[Any, Any], bits: int) -> acb:
    if expression.is_Rational:
        return acb(fmpq(int(expression.p), int(expression.q)))
    if expression.is_Symbol:
        return _ball(values[expression], values, bits)
    if expression is sp.pi:
        return acb.pi()
    if expression is sp.E:
        return acb(1).exp()
    if expression is sp.I:
        return acb(0, 1)
    if isinstance(expression, sp.CRootOf):
        return _algebraic(expression, bits)
    parts = [_ball(part, values, bits) for part in expression.args]
    if expression.is_Add:
        return sum(parts, start=acb(0))
    if expression.is_Mul:
        return math.prod(parts, start=acb(1))
    if expression.is_Pow:
        return _power(parts[0], expression.exp, parts[1])
    name = expression.func.__name__
    if name == "Abs":
        return acb(abs(parts[0]))
    if name not in _FUNCTIONS:
        raise _Unknown
    return getattr(parts[0], name)()


def _power(base: acb, exponent: Any, there: acb) -> acb:
    if exponent.is_Integer:
        n = int(exponent)
        if abs(n) > 10_000 or (n < 0 and base.contains(0)):
            raise _Unknown
        return base**n if n >= 0 else 1 / base ** (-n)
    if base.contains(0):
        raise _Unknown
    if exponent.is_Rational and exponent.q == 2:
        root = base.sqrt() ** abs(int(exponent.p))
        return root if exponent > 0 else 1 / root
    return (there * base.log()).exp()


def _algebraic(root: Any, bits: int) -> acb:
    """A ball around a zero of a polynomial that sympy isolates by exact intervals."""
    width = sp.Rational(1, 2**bits)
    near = root.eval_rational(width, width)
    real, imaginary = near.as_real_imag()
    off = arb(0, 2.0 ** (1 - bits))
    parts = [arb(fmpq(int(part.p), int(part.q))) + off for part in (real, imaginary)]
    return acb(parts[0], arb(0)) if root.is_real else acb(*parts)


# -- normal form -----------------------------------------------------------------------------------------------


class _Numerator:
    """The numerator of an expression in generators, reduced modulo their relations, the last generators first."""

    def __init__(self, expression: Any) -> None:
        self.atoms: list[Any] = []
        self.orders: dict[Any, int] = {}
        self._collect(expression)
        count = len(self.atoms)
        self.ring = fmpq_mpoly_ctx.get([f"x{k}" for k in range(count)] or ["x0"], "lex")
        gens = self.ring.gens()
        # of a lexicographic order the first generator is the highest: the last atoms come first
        self.generator = {atom: gens[count - 1 - k] for k, atom in enumerate(self.atoms)}
        self.roots: dict[Any, tuple[fmpq_mpoly, fmpq_mpoly]] = {}
        self.relations: list[tuple[fmpq_mpoly, int, fmpq_mpoly]] = []
        for atom in self.atoms:
            self._relate(atom)
        self.value = self.reduced(self.fraction(expression)[0])

    @staticmethod
    def of(expression: Any) -> _Numerator | None:
        """The normal form; None where the expression is too long or has a denominator that is 0."""
        if sp.count_ops(expression) > LONGEST:
            return None
        try:
            return _Numerator(expression)
        except (_Unknown, ZeroDivisionError):
            return None

    def _collect(self, e: Any) -> None:
        """The generators of an expression, each after those that it is made of."""
        if e.is_Rational or ("atom", e) in self.atoms:
            return
        if e.is_Add or e.is_Mul:
            for part in e.args:
                self._collect(part)
        elif e.is_Pow and e.exp.is_Rational:
            self._collect(e.base)
            if not e.exp.is_Integer:
                if e.base not in self.orders:
                    self.orders[e.base] = 1
                    self.atoms.append(("root", e.base))
                self.orders[e.base] = math.lcm(self.orders[e.base], int(e.exp.q))
        else:
            for odd, even in ((sp.sin, sp.cos), (sp.sinh, sp.cosh)):
                if isinstance(e, odd):
                    self._collect(even(e.args[0]))
            self.atoms.append(("atom", e))

    def _relate(self, atom: Any) -> None:
        """The relation of a generator, with leading coefficient 1."""
        kind, e = atom
        t, one = self.generator[atom], self.ring.constant(1)
        if kind == "root":
            above, below = self.fraction(e)
            n = self.orders[e]
            self.roots[e] = (t, below)  # base^(1/n) = t/below with t^n = above · below^(n − 1)
            self.relations.append((t, n, t**n - self.reduced(above * below ** (n - 1))))
        elif e is sp.I:
            self.relations.append((t, 2, t**2 + one))
        elif isinstance(e, (sp.sin, sp.sinh)):
            even = sp.cos(e.args[0]) if isinstance(e, sp.sin) else sp.cosh(e.args[0])
            c = self.fraction(even)[0]
            self.relations.append((t, 2, t**2 - self.reduced(one - c**2 if isinstance(e, sp.sin) else c**2 - one)))
        elif isinstance(e, sp.CRootOf):
            coefficients = [self.ring.constant(fmpq(int(c.p), int(c.q))) for c in e.poly.monic().all_coeffs()]
            degree = len(coefficients) - 1
            polynomial = sum((c * t ** (degree - k) for k, c in enumerate(coefficients)), start=self.ring.constant(0))
            self.relations.append((t, degree, polynomial))

    def fraction(self, e: Any) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        """The expression as a quotient of polynomials in the generators."""
        one = self.ring.constant(1)
        if e.is_Rational:
            return self.ring.constant(fmpq(int(e.p), int(e.q))), one
        if ("atom", e) in self.generator:
            return self.generator["atom", e], one
        if e.is_Add:
            above, below = self.ring.constant(0), one
            for part in e.args:
                a, b = self.fraction(part)
                above, below = (above + a, below) if b == below else (above * b + a * below, below * b)
            return self.reduced(above), self.reduced(below)
        if e.is_Mul:
            above, below = one, one
            for part in e.args:
                a, b = self.fraction(part)
                above, below = self.reduced(above * a), self.reduced(below * b)
            return above, below
        if e.is_Pow and e.exp.is_Integer:
            return self._to_a_power(*self.fraction(e.base), int(e.exp))
        if e.is_Pow and e.exp.is_Rational:
            t, below = self.roots[e.base]
            return self._to_a_power(t, below, int(e.exp * self.orders[e.base]))
        raise _Unknown

    def _to_a_power(self, above: fmpq_mpoly, below: fmpq_mpoly, n: int) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        if abs(n) > 64:
            raise _Unknown
        if n < 0:
            above, below, n = below, above, -n
        if below == 0:
            raise _Unknown
        return self.reduced(above**n), self.reduced(below**n)

    def reduced(self, polynomial: fmpq_mpoly) -> fmpq_mpoly:
        """Its remainder by the relations, the highest generator first."""
        for _, _, relation in reversed(self.relations):
            _, polynomial = divmod(polynomial, relation)
        return polynomial

    def bound(self) -> arb | None:
        """A lower bound on the modulus of the number, if it isn't 0; None where a generator has no relation."""
        sizes = {str(t): n for t, n, _ in self.relations}
        names = [str(g) for g in self.ring.gens()]
        if not self.relations or set(names) - set(sizes) or math.prod(sizes.values()) > LARGEST:
            return None
        gens = self.ring.gens()
        basis = list(product(*(range(sizes[name]) for name in names)))
        place = {exponents: k for k, exponents in enumerate(basis)}
        matrix = fmpq_mat(len(basis), len(basis))
        for row, exponents in enumerate(basis):
            monomial = math.prod((g**n for g, n in zip(gens, exponents, strict=True)), start=self.ring.constant(1))
            for powers, c in self.reduced(self.value * monomial).to_dict().items():
                matrix[row, place[tuple(int(n) for n in powers)]] = c
        polynomial = matrix.charpoly()
        coefficients = [polynomial[k] for k in range(polynomial.degree() + 1)]
        while coefficients[0] == 0:
            coefficients.pop(0)
        first, largest = abs(coefficients[0]), max((abs(c) for c in coefficients[1:]), default=fmpq(0))
        with _precision(256):
            return arb(first / (first + largest)) / 2

    def ball(self, bits: int) -> acb | None:
        """The value of the reduced numerator, of a number."""
        with _precision(bits):
            try:
                points = {}
                for atom in self.atoms:
                    kind, e = atom
                    value = _ball(e, {}, bits)
                    if kind == "root":
                        below = self.roots[e][1]
                        value = _power(value, sp.Rational(1, self.orders[e]), acb(fmpq(1, self.orders[e])))
                        value = value * self._at(below, points)
                    points[str(self.generator[atom])] = value
                return self._at(self.value, points)
            except (_Unknown, ZeroDivisionError, OverflowError):
                return None

    def _at(self, polynomial: fmpq_mpoly, points: Mapping[str, acb]) -> acb:
        names, total = [str(g) for g in self.ring.gens()], acb(0)
        for powers, c in polynomial.to_dict().items():
            term = acb(c)
            for name, n in zip(names, powers, strict=True):
                if n:
                    term = term * points[name] ** int(n)
            total = total + term
        return total


def _by_bound(numerator: _Numerator, bound: arb) -> bool | None:
    for bits in BITS:
        ball = numerator.ball(bits)
        if ball is None:
            return None
        if not ball.contains(0):
            return False
        with _precision(bits):
            if ball.abs_upper() < bound:
                return True
    return None
