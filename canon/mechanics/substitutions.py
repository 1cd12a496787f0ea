"""Substitutions u(q), monotonic on the range of a coordinate, that make an integrand rational in u beside one root."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import sympy as sp

from canon.mechanics.action_angle import OneDegree, at_most, degree
from canon.sign import known_sign

U = sp.Symbol("u(q)", real=True)  # no name of a file


@dataclass(frozen=True, slots=True)
class Substitution:
    """u(q), with its inverse `q`, (dq/du)² as `rate`, and the open range of u."""

    u: sp.Expr
    q: sp.Expr
    rate: sp.Expr
    low: sp.Expr
    high: sp.Expr


def substitutions(motion: OneDegree) -> Iterator[Substitution]:
    """Those that suit what occurs in the integrand: q, q², √(c + q²), exponentials, sines and cosines."""
    q, low, high = motion.q, motion.low, motion.high
    yield Substitution(q, U, sp.S.One, low, high)
    if at_most(sp.S.Zero, low):
        yield Substitution(q**2, sp.sqrt(U), 1 / (4 * U), low**2, high**2)
        yield from _roots(motion)
    for rate in _rates(motion.square, q, (sp.exp, sp.sinh, sp.cosh, sp.tanh, sp.coth, sp.sech, sp.csch)):
        if (low, high) == (sp.S.NegativeInfinity, sp.S.Infinity):
            yield Substitution(sp.exp(rate * q), sp.log(U) / rate, 1 / (rate * U) ** 2, sp.S.Zero, sp.S.Infinity)
        elif (low, high) == (sp.S.Zero, sp.S.Infinity):
            positive = known_sign(rate) == "positive"
            ends = (sp.S.One, sp.S.Infinity) if positive else (sp.S.Zero, sp.S.One)
            if known_sign(rate) in ("positive", "negative"):
                yield Substitution(sp.exp(rate * q), sp.log(U) / rate, 1 / (rate * U) ** 2, *ends)
    for rate in _rates(motion.square, q, (sp.sin, sp.cos, sp.tan, sp.cot, sp.sec, sp.csc)):
        if known_sign(rate) == "positive":
            yield from _waves(motion, rate)


def _roots(motion: OneDegree) -> Iterator[Substitution]:
    q = motion.q
    for power in sorted(motion.square.atoms(sp.Pow), key=str):
        base, exponent = sp.expand(power.base), power.exp
        if isinstance(exponent, sp.Rational) and exponent.q == 2 and base.is_polynomial(q) and degree(base, q) == 2:
            k, c = base.coeff(q, 2), base.coeff(q, 0)
            if base.coeff(q, 1) == 0 and known_sign(k) == "positive" and known_sign(c) == "positive":
                high = sp.S.Infinity if motion.high == sp.S.Infinity else sp.sqrt(base.xreplace({q: motion.high}))
                low = sp.sqrt(base.xreplace({q: motion.low}))
                yield Substitution(sp.sqrt(base), sp.sqrt((U**2 - c) / k), U**2 / (k * (U**2 - c)), low, high)


def _waves(motion: OneDegree, rate: Any) -> Iterator[Substitution]:
    q, low, high = motion.q, motion.low, motion.high
    quarter = sp.pi / 2 / rate
    if motion.spans(sp.S.Zero, quarter):
        ends = sp.sin(rate * low) ** 2, sp.sin(rate * high) ** 2
        yield Substitution(sp.sin(rate * q) ** 2, sp.asin(sp.sqrt(U)) / rate, 1 / (4 * rate**2 * U * (1 - U)), *ends)
    if motion.spans(-quarter, quarter):
        ends = sp.sin(rate * low), sp.sin(rate * high)
        yield Substitution(sp.sin(rate * q), sp.asin(U) / rate, 1 / (rate**2 * (1 - U**2)), *ends)
    if motion.spans(sp.S.Zero, 2 * quarter):
        ends = sp.cos(rate * high), sp.cos(rate * low)
        yield Substitution(sp.cos(rate * q), sp.acos(U) / rate, 1 / (rate**2 * (1 - U**2)), *ends)


def _rates(expression: sp.Expr, q: sp.Symbol, kinds: tuple[Any, ...]) -> list[sp.Expr]:
    """The coefficients of q in the arguments of these functions."""
    found: dict[sp.Expr, None] = {}
    for call in sorted(expression.atoms(*kinds), key=str):
        slope = sp.expand(call.args[0]).diff(q)
        if slope != 0 and not slope.has(q):
            found[slope] = None
            found.update({slope / 2: None, 2 * slope: None})
    return list(found)


def integrands(motion: OneDegree) -> Iterator[tuple[Substitution, sp.Expr]]:
    """The substitutions that make (√square dq/du)² a rational function of u, with it in lowest terms."""
    for chosen in substitutions(motion):
        try:
            found = _integrand(motion, chosen)
        except (sp.PolynomialError, NotImplementedError, TypeError, ValueError):
            continue
        if found is not None:
            yield chosen, found


def _integrand(motion: OneDegree, chosen: Substitution) -> sp.Expr | None:
    square: Any = motion.square
    if chosen.u == motion.q and square.has(sp.exp, sp.log, sp.Abs, sp.sin, sp.cos, sp.tan, sp.cot, sp.cosh, sp.sinh):
        if any(motion.q in call.free_symbols for call in square.atoms(sp.Function)):
            return None
    if isinstance(chosen.q, sp.log) or chosen.q.has(sp.log):
        square = square.rewrite(sp.exp)
    elif chosen.q.has(sp.asin, sp.acos):
        square = sp.expand_trig(square)
    value = square.xreplace({motion.q: chosen.q})
    if value.has(sp.asin, sp.acos) or _keeps_a_root(value):
        return None
    value = value.replace(lambda e: isinstance(e, sp.exp), lambda e: sp.powsimp(sp.expand(e)))
    roots = {e for e in value.atoms(sp.Pow) if not e.has(U) and not e.exp.is_Integer}
    names: Any = {e: sp.Dummy(positive=True) for e in roots}
    names = {e: name for e, name in names.items() if not any(e != other and other.has(e) for other in names)}
    plain = _positive_u(sp.expand_power_base(sp.powdenest(value.xreplace(names))) * chosen.rate)
    moved = sp.cancel(sp.together(plain.xreplace({name: e for e, name in names.items()})))
    return moved if moved.is_rational_function(U) else None


def _keeps_a_root(value: Any) -> bool:
    """Whether a square root of something in u plainly matters: the value at some numbers changes with its sign.

    Nothing rests on it but time: roots that cancel are seen by simplification, which is slow.
    """
    powers = [e for e in value.atoms(sp.Pow) if e.has(U) and isinstance(e.exp, sp.Rational) and e.exp.q == 2]
    bases = {e.base: sp.Dummy() for e in powers}
    plain = value.xreplace({e: bases[e.base] ** (2 * e.exp) for e in powers})
    names = sorted(value.free_symbols, key=str)
    numbers: Any = {name: sp.Float(0.3 + 0.37 * k / (1 + k)) for k, name in enumerate(names)}
    here: Any = {root: sp.sqrt(base.xreplace(numbers)).evalf(20) for base, root in bases.items()}
    for root in here if powers and not plain.has(sp.log, sp.Abs) else ():
        both = [plain.xreplace({**numbers, **here, root: sign * here[root]}).evalf(20) for sign in (1, -1)]
        if all(x.is_number and x.is_finite for x in both) and abs(both[0] - both[1]) > 1e-9 * abs(both[0]):
            return True
    return False


def _positive_u(expression: Any) -> Any:
    """Simplified as if u were positive, so that √u² is u and exp(log u) merges: the identity is checked afterwards."""
    plain = sp.Symbol("u", positive=True)
    moved = expression.xreplace({U: plain})
    # without force: that would take parameters for positive, too, and |a| for a
    return sp.powsimp(sp.powdenest(sp.expand(moved, power_base=True))).xreplace({plain: U})
