"""Actions where p² is an even quartic A + Bq² + Cq⁴: Duffing's oscillators, the double well, a bead on a parabola.

With p² = |C| times a product of two brackets in q², a > b > 0, and integrals from one turning point to the other one or
to the middle of the well (Gradshteyn and Ryzhik 3.155; Byrd and Friedman 1971, 213 to 219; K, E by their parameter m):

- ∫₀ᵃ √((a² − q²)(b² + q²)) dq = √(a² + b²)/3 · (b² K + (a² − b²) E), m = a²/(a² + b²), for any a, b;
- ∫_b^a √((a² − q²)(q² − b²)) dq = a/3 · ((a² + b²) E − 2b² K), m = 1 − b²/a²;
- ∫₀ᵇ √((a² − q²)(b² − q²)) dq = a/3 · ((a² + b²) E − (a² − b²) K), m = b²/a².

At a separatrix, where b is 0 or a, they are a³/3 and 2a³/3.
"""

from collections.abc import Iterator
from typing import Any

import sympy as sp

from canon.mechanics.action_angle import NOT_NEGATIVE, ClosedAction, OneDegree, Test, nowhere
from canon.mechanics.standard_actions import SEPARATRIX
from canon.sign import known_sign

_NOT_POSITIVE = ("negative", "zero", "nonpositive")


def _one_well(A: Any, B: Any) -> bool:
    """Whether A < 0 < B, which would make two wells, is certainly not so: B − tA isn't positive for some t ≥ 0, say."""
    if known_sign(A) == "positive" or known_sign(B) in _NOT_POSITIVE:
        return True
    for name in sorted(A.free_symbols, key=str):
        slope = A.diff(name)
        if slope != 0:
            t = sp.cancel(B.diff(name) / slope)
            if known_sign(t) in NOT_NEGATIVE and known_sign(sp.expand(B - t * A)) in _NOT_POSITIVE:
                return True
    return False


def _between(well: sp.Expr | None, square: sp.Expr) -> tuple[sp.Expr, ...]:
    """That a point lies between the turning points ±√square: p² is positive beyond the barriers, too."""
    return () if well is None else (square - well**2,)


def quartic_wells(motion: OneDegree, positive: Test = nowhere, well: sp.Expr | None = None) -> Iterator[ClosedAction]:
    """The action of the libration through q = 0, or of the one to the right of it where the range ends at 0.

    Where a point inside, `well`, is given, and `positive` says that E − V < 0 at q = 0, it is that of either side.

    Where wells on either side of 0 aren't excluded by the signs of the coefficients, the whole line has no closed form.
    """
    q = motion.q
    square: Any = sp.expand(motion.square)
    if not square.is_polynomial(q):
        return
    polynomial = sp.Poly(square, q)
    if polynomial.degree() != 4 or any(e[0] % 2 for e in polynomial.monoms()):
        return
    A, B, C = (polynomial.coeff_monomial(q**k) for k in (0, 2, 4))
    root = sp.sqrt(B**2 - 4 * A * C)
    whole = (motion.low, motion.high) == (sp.S.NegativeInfinity, sp.S.Infinity)
    right = (motion.low, motion.high) == (sp.S.Zero, sp.S.Infinity)
    right = right or (whole and well is not None and positive(-A))
    if known_sign(C) == "negative":
        outer = (B + root) / (-2 * C)
        if right and A == 0:
            yield ClosedAction(2 * B * sp.sqrt(B) / (-3 * C), (B,), (), SEPARATRIX)
        elif right:
            inner = (B - root) / (-2 * C)
            m = 1 - inner / outer
            both = (outer + inner) * sp.elliptic_e(m) - 2 * inner * sp.elliptic_k(m)
            exists = (-A, B, B**2 - 4 * A * C)
            yield ClosedAction(2 * sp.sqrt(-C) * sp.sqrt(outer) / 3 * both, exists, (), "an even quartic")
        elif whole and _one_well(A, B):
            other = (root - B) / (-2 * C)
            m = outer / (outer + other)
            both = other * sp.elliptic_k(m) + (outer - other) * sp.elliptic_e(m)
            yield ClosedAction(
                4 * sp.sqrt(-C) * sp.sqrt(outer + other) / 3 * both, (A,), (), "an even quartic", inside=sp.S.Zero
            )
    elif known_sign(C) == "positive" and whole and sp.expand(root**2) == 0:
        edge = sp.sqrt(-B / (2 * C))
        exists = (A, -B, *_between(well, edge**2))
        yield ClosedAction(8 * sp.sqrt(C) * edge**3 / 3, exists, (), SEPARATRIX)
    elif known_sign(C) == "positive" and whole:
        inner, outer = (-B - root) / (2 * C), (-B + root) / (2 * C)
        m = inner / outer
        both = (outer + inner) * sp.elliptic_e(m) - (outer - inner) * sp.elliptic_k(m)
        exists = (A, -B, B**2 - 4 * A * C, *_between(well, inner))
        value = 4 * sp.sqrt(C) * sp.sqrt(outer) / 3 * both
        yield ClosedAction(value, exists, (), "an even quartic", inside=sp.S.Zero)
