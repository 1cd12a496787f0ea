"""More functions in intervals, for `counterexample.py`: |x|, elliptic integrals, Jacobi's functions, and integrals.

An integral is a sum over pieces, of each by Taylor's formula: f(c), f''(c), and the fourth derivative in the whole
of it. The pieces with the largest errors are halved. Elliptic integrals are such integrals; Jacobi's functions are
led back to sines by Landen's transformation, sn(u, m) with m of the size 10⁻²⁰ lying between sin √(1 − m) u and sin
u.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from fractions import Fraction
from heapq import heapify, heappop, heappush
from itertools import count
from typing import Any

if __package__:
    from canon.checker.alone import Claim, Formula, Stop, number
    from canon.checker.counterexample import NONE, ONE, Arithmetic, Interval, Open, Point
else:  # as a program's part, beside the other files
    from alone import Claim, Formula, Stop, number  # type: ignore
    from counterexample import NONE, ONE, Arithmetic, Interval, Open, Point  # type: ignore

NOUGHT, MOST_PIECES, SMALL = number(0), 3000, Fraction(1, 10**7)
INTEGRANDS = {"elliptic_f": "b*(1 - a*sin(b*s)**2)**(-1/2)", "elliptic_e": "b*(1 - a*sin(b*s)**2)**(1/2)",
    "elliptic_pi": "b*(1 - a*sin(b*s)**2)**(-1/2)/(1 - c*sin(b*s)**2)",
    "jacobi_epsilon": "b*jacobi_dn(b*s, a)**2"}  # fmt: skip
"""Integrals over s from 0 to 1: a is the parameter m, b the angle (or u), c the characteristic n."""
MORE_SLOPES = {
    "abs": ["sign(a)"], "sign": ["0*sign(a)"],
    "elliptic_k": ["(elliptic_e(a)/(1 - a) - elliptic_k(a))/(2*a)"],
    "elliptic_e": ["(elliptic_e(a) - elliptic_k(a))/(2*a)"],
    "elliptic_f": ["(1 - b*sin(a)**2)**(-1/2)",
        "elliptic_e(a, b)/(2*b*(1 - b)) - elliptic_f(a, b)/(2*b) - sin(2*a)*(1 - b*sin(a)**2)**(-1/2)/(4*(1 - b))"],
    "elliptic_e2": ["(1 - b*sin(a)**2)**(1/2)", "(elliptic_e(a, b) - elliptic_f(a, b))/(2*b)"],
    "jacobi_sn": ["jacobi_cn(a, b)*jacobi_dn(a, b)", "jacobi_cn(a, b)*jacobi_dn(a, b)*(_lag)"],
    "jacobi_cn": ["-jacobi_sn(a, b)*jacobi_dn(a, b)", "-jacobi_sn(a, b)*jacobi_dn(a, b)*(_lag)"],
    "jacobi_dn": ["-b*jacobi_sn(a, b)*jacobi_cn(a, b)",
        "-b*jacobi_sn(a, b)*jacobi_cn(a, b)*(_lag) - jacobi_sn(a, b)**2/(2*jacobi_dn(a, b))"],
    "jacobi_epsilon": ["jacobi_dn(a, b)**2", "jacobi_dn(a, b)**2*(_lag) + (jacobi_epsilon(a, b) - a)/(2*b)"],
}  # fmt: skip
LAG = "(a - jacobi_epsilon(a, b)/(1 - b))/(2*b) + jacobi_sn(a, b)*jacobi_cn(a, b)/(2*(1 - b)*jacobi_dn(a, b))"
"""∂am(u, m)/∂m over dn(u, m)."""
ARITIES = {"abs": (1,), "sign": (1,), "elliptic_k": (1,), "elliptic_e": (1, 2), "elliptic_f": (2,),
    "elliptic_pi": (2, 3), "jacobi_sn": (2,), "jacobi_cn": (2,), "jacobi_dn": (2,), "jacobi_epsilon": (2,)}  # fmt: skip

EXACTLY = {"exp": (NONE, ONE), "log": (ONE, NONE), "sin": (NONE, NONE), "cos": (NONE, ONE), "atan": (NONE, NONE)}
"""Where values are no irrational numbers."""


def just(x: Fraction) -> Interval:
    """The interval of one number."""
    return x, x


class More(Claim):
    """A claim in whose formulas these functions may stand."""

    def made(self, kind: str, *of: Any) -> Formula:
        """A formula; a name that the file gives a meaning to is no function of ours."""
        if kind not in ARITIES:
            return super().made(kind, *of)
        if len(of) not in ARITIES[kind] or kind in {*self.names, *self.words, *self.texts}:
            raise Stop("not shown", f"what is given to {kind}")
        return Formula(kind, of)

    def outer(self, f: Formula, k: int) -> Formula:
        """∂f/∂(its k-th argument)."""
        kind = "elliptic_e2" if f.kind == "elliptic_e" and len(f.of) == 2 else f.kind
        if kind in MORE_SLOPES:
            return self.read(MORE_SLOPES[kind][k].replace("_lag", LAG), dict(zip("ab", f.of, strict=False)))
        if kind in ARITIES:
            raise Open(f"a slope of {kind}")
        if f.kind == "^" and not k and f.of[1].kind == "#":  # so that the third one of a square is 0, and no 0 · 1/a
            r = f.of[1].of[0]
            lower = f.of[0] if r == 2 else self.made("^", f.of[0], number(r - 1))
            return self.made("*", number(r), lower) if r else NOUGHT
        return super().outer(f, k)


class Place(Point):
    """A point, or a box, with these functions."""

    def value(self, f: Formula) -> Interval:
        if f.kind == "^" and f.of[1].kind == "#" and f.of[1].of[0] == 0:
            return ONE
        if f.kind in EXACTLY and self.at(f.of[0]) == EXACTLY[f.kind][0]:
            return EXACTLY[f.kind][1]
        if f.kind in ("sin", "cos"):
            return wave(self.real, self.at(f.of[0]), f.kind == "cos")
        if f.kind not in ARITIES:
            return super().value(f)
        a = [self.at(x) for x in f.of]
        if f.kind in ("abs", "sign"):
            if a[0][0] <= 0 <= a[0][1]:
                raise Open("the modulus, or the sign, of what may be 0")
            side = 1 if a[0][0] > 0 else -1
            return self.real.times(a[0], just(Fraction(side))) if f.kind == "abs" else just(Fraction(side))
        if f.kind.startswith("jacobi") and f.kind != "jacobi_epsilon":
            known = self.real.__dict__.setdefault("known", {})
            if (*a,) not in known:
                known[(*a,)] = jacobi(self.real, *a)
            return known[(*a,)]["scd".index(f.kind[7])]
        if f.kind == "jacobi_epsilon" or f.kind == "elliptic_f":
            return self.legendre(f.kind, a[1], a[0])
        quarter = self.real.times(self.real.pi, just(Fraction(1, 2)))
        if f.kind == "elliptic_pi":
            return self.legendre(f.kind, a[-1], a[1] if len(a) == 3 else quarter, a[0])
        if len(a) == 2:
            return self.legendre(f.kind, a[1], a[0])
        ends = [complete(self.real, x)[f.kind == "elliptic_e"] for x in a[0]]  # K grows with m, E falls
        return min(x for x, _ in ends), max(y for _, y in ends)

    def legendre(self, kind: str, m: Interval, upper: Interval, n: Interval = NONE) -> Interval:
        """An integral of INTEGRANDS."""
        key, known = (kind, m, upper, n), self.real.__dict__.setdefault("known", {})
        if key in known:
            return known[key]
        names = {f"#{x}": value for x, value in zip("abc", (m, upper, n), strict=True)}
        f = self.claim.read(INTEGRANDS[kind], {x: Formula(".", (f"#{x}",)) for x in "abcs"})
        where = lambda x: type(self)(self.claim, {**names, "#s": x}, self.real)
        found = integral(lambda x: piece(where, f, "#s", x), (Fraction(0), Fraction(1)), lambda x: x[1] - x[0] < SMALL)
        return known.setdefault(key, found)


def wave(real: Arithmetic, x: Interval, quarters: int) -> Interval:
    """sin(x + quarters · π/2): in the middle of x, and as far away as x is wide times the steepest slope there."""
    found, middle = real.sine(x, quarters), (x[0] + x[1]) / 2
    if x[0] == x[1]:
        return found
    near, steep = real.sine((middle, middle), quarters), real.sine(x, quarters + 1)
    far = (x[1] - x[0]) / 2 * max(map(abs, steep))
    low, high = real.held(near[0] - far, near[1] + far)
    return max(low, found[0]), min(high, found[1])


def complete(real: Arithmetic, m: Fraction) -> tuple[Interval, Interval]:
    """K = π/(2 M(1, k')) and E = K (1 − Σ 2ⁿ⁻¹ c²), by arithmetic and geometric means a and b with a² − b² = c²."""
    if m >= 1:
        raise Open("an elliptic integral beyond its edge")
    half, minus, total = just(Fraction(1, 2)), just(Fraction(-1)), ONE
    a, b, weight = ONE, real.monotone(real.root, (1 - m, 1 - m)), Fraction(1, 2)
    squares = (m, m)
    for _ in range(12):
        total = real.add(total, real.times(squares, (-weight, -weight)))
        if abs(squares[0]) + abs(squares[1]) < Fraction(1, 10**16):
            break
        c = real.times(half, real.add(a, real.times(minus, b)))
        a, b = real.times(half, real.add(a, b)), real.monotone(real.root, real.times(a, b))
        squares, weight = real.times(c, c), 2 * weight
    else:
        raise Open("an elliptic integral near its edge")
    rest = 2 * weight * max(map(abs, squares))  # what follows is less than a half of what is before it, each time
    both = (min(a[0], b[0]), max(a[1], b[1]))
    k = real.times(real.times(half, real.pi), real.power(both, -1))
    return k, real.times(k, (total[0] - rest, total[1] + rest))


def jacobi(real: Arithmetic, u: Interval, m: Interval) -> tuple[Interval, Interval, Interval]:
    """sn, cn and dn, for 0 ≤ m < 1."""
    if m[0] < 0 or m[1] >= 1 or abs(u[0]) + abs(u[1]) > 10**4:
        raise Open("Jacobi's functions of such a parameter")
    add, times = real.add, real.times
    if m[1] < Fraction(1, 10**20):
        # am u lies between √(1 − m) u and u, as its slope does between √(1 − m) and 1
        near = add(u, (-max(map(abs, u)) * m[1], max(map(abs, u)) * m[1]))
        return real.sine(near), real.sine(near, 1), (1 - m[1], Fraction(1))
    root = lambda x: real.monotone(real.root, x)
    minus = lambda x: (-x[1], -x[0])
    k1 = add(ONE, minus(root(add(ONE, minus(m)))))  # (1 − k')/(1 + k')
    k1 = times(k1, real.power(add(ONE, root(add(ONE, minus(m)))), -1))
    plus = add(ONE, k1)
    s, c, d = jacobi(real, times(u, real.power(plus, -1)), (max(Fraction(0), times(k1, k1)[0]), times(k1, k1)[1]))
    below = real.power(add(ONE, times(k1, times(s, s))), -1)
    sn = times(times(plus, s), below)
    cn = times(times(c, d), below)
    dn = times(add(ONE, minus(times(k1, times(s, s)))), below)
    return sn, cn, dn


def piece(where: Callable[[Interval], Point], f: Formula, name: str, x: Interval) -> Interval:
    """∫ f over x by Taylor's formula about its middle: 2h f + h³/3 f'' + h⁵/60 f'''', the last anywhere in x."""
    middle, h = (x[0] + x[1]) / 2, (x[1] - x[0]) / 2
    box, point = where(x), where((middle, middle))
    parts = [(point.at(f), 2 * h), (point.at(f, name, name), h**3 / 3), (box.at(f, *(name,) * 4), h**5 / 60)]
    ends = [point.real.times(y, (c, c)) for y, c in parts]
    return point.real.add(ends[0], point.real.add(ends[1], ends[2]))


def integral(of: Callable[[Interval], Interval], over: Interval, done: Callable[[Interval], bool]) -> Interval:
    """The sum of an integral over pieces, halved where the error is largest until it is `done`. Raises Open."""
    order, low, high, unseen = count(), Fraction(0), Fraction(0), 0
    heap: list[Any] = []

    def put(x: Interval) -> None:
        nonlocal low, high, unseen
        y = None
        with suppress(Open):
            y = of(x)
        low, high, unseen = (low, high, unseen + 1) if y is None else (low + y[0], high + y[1], unseen)
        error = Fraction(x[1] - x[0]) * 10**30 if y is None else y[1] - y[0]
        heappush(heap, (-error, next(order), x, y))

    heapify(heap)
    for k in range(8):
        put((over[0] + (over[1] - over[0]) * k / 8, over[0] + (over[1] - over[0]) * (k + 1) / 8))
    while unseen or not done((low, high)):
        _, number, (a, b), y = heappop(heap)
        if number > MOST_PIECES or b - a < (over[1] - over[0]) / 2**160:
            raise Open("an integral, in so many pieces")
        low, high, unseen = (low, high, unseen - 1) if y is None else (low - y[0], high - y[1], unseen)
        put((a, (a + b) / 2))
        put(((a + b) / 2, b))
    return low, high
