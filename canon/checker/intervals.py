"""Intervals that hold a formula's value at a point: mpmath's, with functions that it has none of by their monotony.

Sums, products, powers, exp, log, sin, cos and gamma are mpmath's own intervals, rounded outwards. Of atan, asinh,
elliptic integrals and so on, mpmath's values at the ends of an interval are trusted but for their last ten digits.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import product
from typing import Any

import mpmath
from mpmath.ctx_iv import MPIntervalContext

from canon.checker.formulas import Formulas
from canon.checker.whole import is_whole

SPARE = 10
"""So many of the last digits of a function's value are left open."""
MONOTONE = {
    "asin": "asin", "acos": "acos", "atan": "atan", "asinh": "asinh", "acosh": "acosh", "atanh": "atanh",
    "elliptic_k": "ellipk", "elliptic_e": "ellipe", "elliptic_f": "ellipf", "elliptic_pi": "ellippi",
}  # fmt: skip
"""Functions that are monotonic in each of their arguments, where these don't change their sign, and mpmath's names."""
FAR = float("inf")
EDGES = {
    "asin": (-1, 1), "acos": (-1, 1), "atanh": (-1, 1), "acosh": (1, FAR), "elliptic_k": (-FAR, 1),
}  # fmt: skip
"""Where functions are smooth: between these, and not at them."""
STEEPEST, FLAT = 10**6, ("power", "log", "abs", "sign", "atan", "atan2", "asinh")
"""The largest argument of a function that isn't one of the flat ones."""
MOST = 10_000
"""The largest exponent, of those that are known at the point alone."""
BOUNDED = {"jacobi_sn": "sn", "jacobi_cn": "cn", "jacobi_dn": "dn", "jacobi_epsilon": "epsilon"}
"""Jacobi's functions, for a parameter between 0 and 1."""


class Open(ValueError):
    """An interval can't be given: the formula has no value there, or there is no rule."""


class Intervals:
    """Values of formulas in intervals, with so many digits; not `real`, in rectangles of the complex plane.

    Functions have values inside of where they are smooth; or also at its edges, where that is `closed`.
    """

    def __init__(self, digits: int, *, real: bool = True, closed: bool = False) -> None:
        self.is_real, self.is_closed = real, closed
        self.iv: Any = MPIntervalContext()
        self.iv.dps = digits
        self.mp: Any = mpmath.MPContext()
        self.mp.dps = digits
        self.signs: Mapping[str, Sequence[str]] = {}

    def number(self, x: Fraction) -> Any:
        """A rational number."""
        value = self.iv.mpf(x.numerator) / self.iv.mpf(x.denominator)
        return value if self.is_real else self.iv.mpc(value, 0)

    def parts(self, x: Any) -> tuple[Any, ...]:
        """The real part, and the imaginary one where there may be one."""
        return (x,) if self.is_real else (x.real, x.imag)

    def is_nonzero(self, x: Any) -> bool:
        """Whether it is seen not to be 0."""
        return any(0 not in part for part in self.parts(x))

    def real(self, x: Any) -> Any:
        """A value that is seen to be real. Raises Open for any other."""
        first, *rest = self.parts(x)
        if any(part != 0 for part in rest):
            raise Open
        return first

    def values(self, f: Formulas, targets: Sequence[int], of: Mapping[str, Any]) -> dict[int, Any]:
        """Intervals of the targets and of all below them; `of` has those of names, and formulas of declared functions.

        Raises Open.
        """
        out: dict[int, Any] = {}
        above: dict[str, bool] = {}  # a smooth function without a zero has one sign
        for a in f.reach(*targets):
            op, parts = f.ops[a], [out[b] for b in f.parts(a)]
            try:
                if op[0] == "f" and op[1] in f.functions:
                    body = f.body(of[op[1]], op[2])
                    out[a] = self.values(f, [body], {f"#{k}": x for k, x in enumerate(parts, 1)})[body]
                    words = self.signs.get(op[1], ())
                    if not any(op[2]) and {*words} - {"function"} and not is_allowed(words, self.real(out[a])):
                        raise Open
                    if not any(op[2]) and "nonzero" in words:
                        sign = bool(self.real(out[a]).a > 0)
                        if above.setdefault(op[1], sign) != sign:
                            raise Open
                elif op[:2] == ("f", "power") and (n := self._exponent(f, op[3][1], parts[1])) is not None:
                    if not self.is_nonzero(parts[0]):
                        raise Open
                    out[a] = self._raised(parts[0], n)
                else:
                    out[a] = self._value(op, parts, of)
            except (ValueError, ZeroDivisionError, OverflowError, TypeError, KeyError, NotImplementedError):
                raise Open from None
            if not all(self.mp.isfinite(self.mp.mpf(end)) for x in self.parts(out[a]) for end in (x.a, x.b)):
                raise Open
        return out

    def _value(self, op: tuple[Any, ...], x: list[Any], of: Mapping[str, Any]) -> Any:
        iv = self.iv
        if op[0] == "n":
            return self.number(op[1])
        if op[0] == "s":
            if op[1] in of or op[1] not in ("pi", "1j"):
                return of[op[1]]
            return iv.mpc(0, 1) if op[1] == "1j" else iv.pi if self.is_real else iv.mpc(+iv.pi, 0)
        if op[0] in "+*":
            return x[0] + x[1] if op[0] == "+" else x[0] * x[1]
        if op[0] == "^":
            if op[2] < 0 and not self.is_nonzero(x[0]):
                raise Open
            return self._raised(x[0], op[2])
        if self.is_real:
            return self._function(str(op[1]), x)
        if op[1] in ("exp", "sin", "cos") and x[0].imag != 0:
            return self._entire(str(op[1]), x[0].real, x[0].imag)
        return iv.mpc(self._function(str(op[1]), [self.real(part) for part in x]), 0)

    def _exponent(self, f: Formulas, a: int, x: Any) -> int | None:
        """The whole number that a formula of whole numbers is; None for any other exponent, or where it isn't known."""
        if not is_whole(f, a):
            return None
        n = int(self.mp.mpf(self.real(x).a))
        return n if abs(n) <= MOST and self.real(x) == n else None

    def _raised(self, x: Any, n: int) -> Any:
        if self.is_real:
            return x**n
        power = self.iv.mpc(1, 0)
        for _ in range(abs(n)):
            power = power * x
        return power if n >= 0 else 1 / power

    def _check_size(self, *x: Any) -> None:
        """Refuse arguments of functions whose values would have digits without an end. Raises Open."""
        if any(not (part.a > -STEEPEST and part.b < STEEPEST) for part in x):
            raise Open

    def _entire(self, name: str, x: Any, y: Any) -> Any:
        """exp, sine and cosine of x + iy."""
        iv = self.iv
        self._check_size(x, y)
        if name == "exp":
            return iv.mpc(iv.exp(x) * iv.cos(y), iv.exp(x) * iv.sin(y))
        up, down = iv.exp(y), iv.exp(-y)
        cosh, sinh = (up + down) / 2, (up - down) / 2
        if name == "sin":
            return iv.mpc(iv.sin(x) * cosh, iv.cos(x) * sinh)
        return iv.mpc(iv.cos(x) * cosh, -iv.sin(x) * sinh)

    def _function(self, name: str, x: list[Any]) -> Any:
        iv = self.iv
        if name in ("power", "log") and not x[0].a > 0:
            raise Open
        if name not in FLAT:
            self._check_size(*x)
        if name == "power":
            exponent = x[1] * iv.log(x[0])
            self._check_size(exponent)
            return iv.exp(exponent)
        if name in ("exp", "log", "sin", "cos") or (name == "gamma" and x[0].a > 0):
            return getattr(iv, name)(x[0])
        if name in ("tan", "cot", "sec", "csc"):
            sine, cosine = iv.sin(x[0]), iv.cos(x[0])
            over, under = {"tan": (sine, cosine), "cot": (cosine, sine), "sec": (1, cosine), "csc": (1, sine)}[name]
            return over / self._nonzero(under)
        if name in ("sinh", "cosh", "tanh", "coth"):
            up, down = iv.exp(x[0]), iv.exp(-x[0])
            sinh, cosh = (up - down) / 2, (up + down) / 2
            if name in ("sinh", "cosh"):
                return sinh if name == "sinh" else cosh
            return sinh / cosh if name == "tanh" else cosh / self._nonzero(sinh)
        if name in ("abs", "sign"):
            self._nonzero(x[0])
            sign = 1 if x[0].a > 0 else -1
            return x[0] * sign if name == "abs" else iv.mpf(sign)
        if name == "atan2":
            return self._angle(*x)
        low, high = EDGES.get(name if name != "elliptic_e" or len(x) > 1 else "elliptic_k", (-FAR, FAR))
        if not self.is_closed and not (low < x[0].a and x[0].b < high):
            raise Open
        if name in MONOTONE and (name != "elliptic_pi" or (len(x) == 2 and x[0].b < 1 and x[1].b < 1)):
            return self._monotone(MONOTONE[name], x)
        if name in BOUNDED and x[1].a >= 0 and x[1].b < 1:
            return self._jacobi(BOUNDED[name], x[0], x[1])
        raise Open

    def _nonzero(self, x: Any) -> Any:
        if 0 in x:
            raise Open
        return x

    def _width(self, x: Any) -> Any:
        return self.mp.mpf(x.b) - self.mp.mpf(x.a)

    def _spare(self, value: Any) -> Any:
        return (1 + abs(value)) * self.mp.mpf(10) ** (SPARE - self.mp.dps)

    def _monotone(self, name: str, x: list[Any]) -> Any:
        """The least and the largest value at the corners; an argument around 0 is left alone, but by odd functions."""
        if len(x) > 1 and 0 in x[0] and name != "ellippi":
            raise Open
        corners = product(*((self.mp.mpf(t.a), self.mp.mpf(t.b)) for t in x))
        found = [getattr(self.mp, name)(*corner) for corner in corners]
        if any(self.mp.im(v) != 0 for v in found):
            raise Open
        low, high = min(map(self.mp.re, found)), max(map(self.mp.re, found))
        return self.iv.mpf([low - self._spare(low), high + self._spare(high)])

    def is_regular(self, rows: Sequence[Sequence[Any]]) -> bool:
        """Whether a square matrix of intervals is seen to have no determinant 0, by Gauss's elimination."""
        left = [list(row) for row in rows]
        while left:
            top = max(left, key=lambda row: min(abs(row[0].a), abs(row[0].b)) if 0 not in row[0] else -1)
            if 0 in top[0]:
                return False
            left.remove(top)
            left = [[x - row[0] / top[0] * y for x, y in zip(row[1:], top[1:], strict=True)] for row in left]
        return True

    def _jacobi(self, name: str, u: Any, m: Any) -> Any:
        """The value in the middle, and bounds of its slopes: by u 1, by m from |∂ am/∂m| ≤ |u|/(2 (1 − m)^(3/2))."""
        mp = self.mp
        middles = [(mp.mpf(t.a) + mp.mpf(t.b)) / 2 for t in (u, m)]
        rest = 1 - mp.mpf(m.b)
        slope = (1 + max(abs(mp.mpf(u.a)), abs(mp.mpf(u.b))) / rest**1.5) / mp.sqrt(rest)
        if name == "epsilon":  # the integral of dn², which is 1 at most, and by m changes by 1 + |∂ am/∂m| at most
            value, farthest = self._epsilon(*middles), max(abs(mp.mpf(u.a)), abs(mp.mpf(u.b)))
            slope = farthest * (1 + farthest / rest**1.5)
        else:
            value = mp.ellipfun(name, middles[0], m=middles[1])
        far = 2 * (self._width(u) + slope * self._width(m)) + self._spare(value)
        return self.iv.mpf([value - far, value + far])

    def _epsilon(self, u: Any, m: Any) -> Any:
        """Jacobi's ε is E(am(u), m), and grows by 2 E(m) over 2 K(m)."""
        mp = self.mp
        turns = mp.nint(u / (2 * mp.ellipk(m)))
        u = u - 2 * turns * mp.ellipk(m)
        return mp.ellipe(mp.atan2(mp.ellipfun("sn", u, m=m), mp.ellipfun("cn", u, m=m)), m) + 2 * turns * mp.ellipe(m)

    def _angle(self, y: Any, x: Any) -> Any:
        """atan2(y, x), off the cut."""
        iv = self.iv
        if x.a > 0:
            return self._monotone("atan", [y / x])
        turn = iv.pi / 2
        if y.a > 0:
            return turn - self._monotone("atan", [x / y])
        if y.b < 0:
            return -turn - self._monotone("atan", [x / y])
        raise Open


def off_the_edge(words: Sequence[str]) -> list[str]:
    """What has to hold of a value that a map gives: on the edge of what a word allows there may be no point near by.

    So x = 0 is alone where x and x² − x aren't negative, and a claim is about the open domain.
    """
    return [{"nonnegative": "positive", "nonpositive": "negative"}.get(word, word) for word in words]


def is_allowed(words: Sequence[str], x: Any) -> bool:
    """Whether the values in an interval are as a name's assumptions say."""
    return not (
        ("positive" in words and not x.a > 0) or ("negative" in words and not x.b < 0)
        or ("nonnegative" in words and not x.a >= 0) or ("nonpositive" in words and not x.b <= 0)
        or ("nonzero" in words and 0 in x) or ("integer" in words and (x.a != x.b or int(x.a) != x.a))
    )  # fmt: skip
