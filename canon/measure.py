"""The size of formulas while they are built: what keeps the reader within its time and memory.

sympy shares subexpressions but walks them as trees, computes integer powers at once, and carries whatever its functions
return. So every formula that is built has a bounded tree, bounded numbers, and heads of the language only.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Any, Final

import sympy as sp
from sympy.core.function import AppliedUndef

from canon.errors import InputError
from canon.special import EllipticPi, JacobiCN, JacobiDN, JacobiEpsilon, JacobiSN
from canon.syntax import BITS

LARGEST: Final = 20_000
"""The most nodes of a formula's tree, abbreviations expanded."""
TALLEST: Final = 80
"""The most levels of a formula's tree, abbreviations expanded."""
WIDEST: Final = 2_000
"""The most nodes of a function's argument, or of a power's base."""
STEEPEST: Final = 10_000
"""The largest numerical exponent."""
LONG: Final = 512
"""The most bits of a number in a function's argument, or in the base of a root."""
EFFORT: Final = 400_000
"""The most work that a formula may take to build, in about the microseconds that sympy needs for it."""

OF_FILE: Final = 700_000
"""The same of all formulas of a file: what is refused for it is refused in under a second.

What is built already is hardly counted again, so that it is different functions, and derivatives, that are dear: the
dearest file of the catalogue takes two fifths of it.
"""

CLAIM: Final = 100
FORMULA: Final = 30
LETTER: Final = 2
"""The work of a claim, of a formula, and of each letter of it, whatever is in them."""

CALL: Final = 600
AGAIN: Final = 20
"""The work of a function or a root, and of one that has been built in this file before."""
POWER: Final = 200
POWER_OF: Final = 8
"""The work of a power of a sum, and of each node of that."""

COMPARED: Final = 10_000
"""How many words the unknown names of a file are compared with in all, to say which are meant: tenths of a second."""

_HEADS: Final = (
    sp.Add, sp.Mul, sp.Pow, sp.exp, sp.log, sp.Abs, sp.sign, sp.atan2, AppliedUndef, sp.Derivative, sp.Subs, sp.Tuple,
    sp.sin, sp.cos, sp.tan, sp.cot, sp.sec, sp.csc, sp.asin, sp.acos, sp.atan, sp.sinh, sp.cosh, sp.tanh, sp.coth,
    sp.sech, sp.csch, sp.asinh, sp.acosh, sp.atanh, sp.gamma, sp.polygamma, sp.LambertW,
    sp.elliptic_k, sp.elliptic_e, sp.elliptic_f, JacobiSN, JacobiCN, JacobiDN, JacobiEpsilon, EllipticPi,
)  # fmt: skip
_CONSTANTS: Final = (sp.pi, sp.E, sp.I, sp.EulerGamma, sp.Catalan)


class Measure:
    """Tree size, depth and reality of expressions, each distinct one looked at once, and the work done on them.

    One may serve all formulas of a file: then `begin` each of them. The file's `letters` had to be read, too.
    """

    def __init__(self, letters: int = 0) -> None:
        self._spent = 0
        self._before = letters // 2
        self._compared = 0
        self._known: dict[Any, tuple[int, int, bool]] = {}
        self.slopes: dict[Any, dict[Any, Any]] = {}
        """Of each symbol: the derivatives by it that are known."""
        self.built: dict[Any, Any] = {}
        """What has been built already, by what it was built of."""

    def size(self, expression: Any) -> int:
        """The number of nodes of the tree."""
        return self._of(expression)[0]

    def is_complex(self, expression: Any) -> bool:
        """Whether it has i or a name that isn't known to be real."""
        return self._of(expression)[2]

    def spend(self, effort: int) -> None:
        """Count work that is about to be done.

        **Raises:** `InputError` if it is more than `EFFORT` for this formula, or more than `OF_FILE` in all.
        """
        self._spent += effort
        if self._spent > EFFORT:
            raise InputError("too much work to read: shorten the formula, or divide it over several claims")
        if self.is_spent:
            raise InputError("too much work to read all formulas up to here: divide them over several files")

    def spend_on_claim(self) -> None:
        """Count a claim, whatever it says. **Raises:** `InputError` if it is one more than the file may have."""
        self._before += CLAIM
        self.spend(0)

    @property
    def is_spent(self) -> bool:
        """Whether the file has taken all the work that it may."""
        return self._before + self._spent > OF_FILE

    def compares(self, words: int) -> bool:
        """Whether an unknown name may still be compared with so many words: a file may have thousands of such names."""
        self._compared += words
        return self._compared <= COMPARED

    def once(self, key: Any, build: Callable[[], Any]) -> Any:
        """What `build` makes; where the same was written in this file before, what it made then."""
        if key in self.built:
            self.spend(AGAIN)
        else:
            self.built[key] = build()
        return self.built[key]

    def begin(self, text: str) -> Measure:
        """Itself, for a further formula: what has been spent counts for the file only. **Raises:** `InputError`."""
        self._before += self._spent
        self._spent = 0
        self.spend(FORMULA + LETTER * len(text))
        return self

    def spend_on(self, arguments: Iterable[Any]) -> None:
        """Count the work of a function or a power of these arguments; numbers are looked up in tables and cost more.

        **Raises:** `InputError`, also if an argument is too large.
        """
        for argument in arguments:
            size = self.size(argument)
            if size > WIDEST:
                raise InputError(f"too large: more than {WIDEST} operations in an argument")
            if any(_height(number) > LONG for number in argument.atoms(sp.Rational)):
                raise InputError(f"a number of more than {LONG} bits in an argument")
            numeric = 0 if argument.free_symbols else 500 if size == 1 else 1_500
            self.spend(CALL + size + numeric)

    def spend_on_power(self, base: Any, exponent: Any) -> None:
        """Count the work of a power of a sum, of which sympy asks whether it is infinite. **Raises:** `InputError`."""
        if base.is_Add:
            key = ("of a sum", base, exponent)
            self.spend(AGAIN if key in self.built else POWER + POWER_OF * self.size(base))
            self.built[key] = None

    def admit(self, expression: Any) -> Any:
        """The expression itself.

        **Raises:** `InputError` if it is too large, has too large a number, or is infinite or undefined.
        """
        size, depth, _ = self._of(expression)
        if size > LARGEST:
            raise InputError(f"too large: more than {LARGEST} operations with its abbreviations expanded")
        if depth > TALLEST:
            raise InputError(f"nested more than {TALLEST} levels deep with its abbreviations expanded")
        return expression

    def _of(self, expression: Any) -> tuple[int, int, bool]:
        found = self._known.get(expression)
        if found is not None:
            return found
        stack = [expression]
        while stack:
            node = stack[-1]
            missing = [part for part in node.args if part not in self._known]
            if missing:
                stack.extend(missing)
                continue
            stack.pop()
            if node not in self._known:
                self._known[node] = self._measured(node)
        return self._known[expression]

    def _measured(self, node: Any) -> tuple[int, int, bool]:
        if not node.args:
            _check_leaf(node)
            return 1, 1, node is sp.I or (node.is_Symbol and node.is_real is not True)
        if not isinstance(node, _HEADS):
            raise InputError(f"it leads to {type(node).__name__}, which is not in the language")
        if isinstance(node, sp.Pow):
            check_power(node.base, node.exp)
        parts = [self._known[part] for part in node.args]
        size = 1 + sum(part[0] for part in parts)
        return size, 1 + max(part[1] for part in parts), any(part[2] for part in parts) and not isinstance(node, sp.Abs)


def _check_leaf(node: Any) -> None:
    if node.is_Rational:
        if max(bits(node.p), bits(node.q)) > 2 * BITS:
            raise InputError(f"a number of more than {BITS} bits arises")
    elif node.is_infinite or node is sp.nan:
        raise InputError("undefined everywhere: a value is infinite or indeterminate")
    elif not node.is_Symbol and node not in _CONSTANTS and not isinstance(node, sp.Tuple):
        raise InputError(f"it leads to {node}, which is not in the language")


def bits(integer: Any) -> int:
    """The bits of an integer."""
    return int(integer).bit_length()


def _height(number: Any) -> int:
    return max(bits(number.p), bits(number.q))


def check_power(base: Any, exponent: Any) -> None:
    """Refuse `base**exponent` before it is computed, if it is or soon becomes too large a number or power.

    **Raises:** `InputError`.
    """
    if exponent.is_Rational:
        if base.is_Rational and exponent.q > 1_000:
            raise InputError("an exponent of too many digits")
        steepness = abs(exponent)
        factors = base.args if base.is_Mul else (base,)
        inner = max((abs(factor.exp) for factor in factors if factor.is_Pow and factor.exp.is_Rational), default=1)
        if steepness * max(inner, 1) > STEEPEST:
            raise InputError(f"an exponent above {STEEPEST}")
        coefficient = base.as_coeff_Mul()[0]
        if abs(coefficient) != 1 and _height(coefficient) * steepness > 2 * BITS:
            raise InputError(f"a power of more than {BITS} bits")
    elif base.is_number and any(abs(number) > STEEPEST for number in exponent.atoms(sp.Rational)):
        raise InputError(f"an exponent above {STEEPEST}")


def check_product(factors: Iterable[Any]) -> None:
    """Refuse a product whose numerical factors make too large a number. **Raises:** `InputError`."""
    if sum(_height(factor.as_coeff_Mul()[0]) for factor in factors) > 2 * BITS:
        raise InputError(f"a number of more than {BITS} bits arises")


def check_sum(terms: Iterable[Any]) -> None:
    """Refuse a sum of fractions without a common denominator of bounded size. **Raises:** `InputError`."""
    common = 1
    for term in terms:
        common = math.lcm(common, int(term.as_coeff_Mul()[0].q))
        if bits(common) > 2 * BITS:
            raise InputError(f"a denominator of more than {BITS} bits arises")


def check_exponential(argument: Any) -> None:
    """Refuse exp(n log a), which sympy computes as a**n, where that is too large. **Raises:** `InputError`."""
    for term in sp.Add.make_args(argument):
        coefficient, rest = term.as_coeff_Mul()
        for factor in sp.Mul.make_args(rest):
            if isinstance(factor, sp.log):
                check_power(factor.args[0], coefficient)
