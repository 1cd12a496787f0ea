"""Actions that are no elementary functions: a cosine potential by elliptic integrals, a power by Euler's beta function.

∮ √(a + b cos κq) dq: with sin(κq/2) = √μ sin φ and μ = (a + b)/2b, a libration (|a| < b) gives
(8√2b/κ)(E(μ) − (1 − μ) K(μ)) and a turn of a rotation (a > b) gives (4√(a + b)/κ) E(2b/(a + b)), K and E in terms of
the parameter; at the separatrix (a = b) that is 8√2b/κ, and for a turn, one of its two branches, half of it (Byrd and
Friedman 1971, 289). ∮ √(α − β|q|ⁿ)ʳ dq = 4√αʳ (α/β)^(1/n) Γ(1 + 1/n) Γ(1 + r/2)/Γ(1 + r/2 + 1/n).
"""

from collections.abc import Iterator
from typing import Any

import sympy as sp

from canon.errors import InputError
from canon.mechanics.action_angle import ClosedAction, OneDegree, degree
from canon.sign import is_complex, known_sign

SEPARATRIX = "the area inside the separatrix"


def rotation(motion: OneDegree, period: sp.Expr | None) -> Iterator[ClosedAction]:
    """The action of a rotation with p > 0 over a period of the coordinate (None: the least one of H in it).

    **Raises:** `InputError` where the period is none of H, or is needed and isn't given.
    """
    if not motion.square.has(motion.q) and not motion.mean.has(motion.q):
        if period is None:
            raise InputError(f"H doesn't depend on {motion.q}: a rotation needs the key 'period'", "key 'branch'")
        momentum = motion.mean + sp.sqrt(motion.square)
        if not _whole(motion, period):
            return
        yield ClosedAction(period * momentum, (motion.square, momentum), (), "a constant momentum")
        return
    found = cosine(motion.square, motion.q)
    if found is None or motion.mean != 0 or not _whole(motion, 2 * sp.pi / found[2]):
        return
    a, b, rate = found
    turns = sp.S.One if period is None else sp.simplify(period * rate / (2 * sp.pi))
    if not (turns.is_Integer and turns > 0):
        raise InputError(f"{period} is not a period of H, whose least one is {2 * sp.pi / rate}", "key 'period'")
    size = _size(b)
    if sp.expand(a - size) == 0:
        yield ClosedAction(turns * 4 * sp.sqrt(2 * size) / rate, (size, rate), _check(motion, found), SEPARATRIX)
        return
    turn = 4 * sp.sqrt(a + size) / rate * sp.elliptic_e(2 * size / (a + size))
    yield ClosedAction(
        turns * turn, (a - size, rate), _check(motion, found), "a complete elliptic integral, for one turn"
    )


def pendulum_like(motion: OneDegree) -> Iterator[ClosedAction]:
    """The action of a libration where the square of the momentum is a + b cos(κq)."""
    found = cosine(motion.square, motion.q)
    if found is None:
        return
    a, b, rate = found
    if not _whole(motion, 2 * sp.pi / rate) or not _well_inside(motion, b, rate):
        return
    size = _size(b)
    if sp.expand(a - size) == 0:
        yield ClosedAction(8 * sp.sqrt(2 * size) / rate, (size, rate), _check(motion, found), SEPARATRIX)
        return
    mu = (a + size) / (2 * size)
    value = 8 * sp.sqrt(2 * size) / rate * (sp.elliptic_e(mu) - (1 - mu) * sp.elliptic_k(mu))
    yield ClosedAction(value, (size - a, size + a, rate), _check(motion, found), "complete elliptic integrals")


def _size(b: sp.Expr) -> sp.Expr:
    sign = known_sign(b)
    return b if sign == "positive" else -b if sign == "negative" else sp.Abs(b)


def _whole(motion: OneDegree, period: sp.Expr) -> bool:
    """Whether the range is the whole line, or one period."""
    if (motion.low, motion.high) == (sp.S.NegativeInfinity, sp.S.Infinity):
        return True
    return sp.expand(motion.high - motion.low - period) == 0


def _well_inside(motion: OneDegree, b: sp.Expr, rate: sp.Expr) -> bool:
    """Whether the barriers, not the wells, lie at the ends of a range of one period."""
    if motion.low == sp.S.NegativeInfinity:
        return True
    if known_sign(b) not in ("positive", "negative"):
        return False
    return sp.expand(sp.cos(sp.expand(rate * motion.low)) + (1 if _size(b) == b else -1)) == 0


def _check(motion: OneDegree, found: tuple[sp.Expr, sp.Expr, sp.Expr]) -> tuple[tuple[str, sp.Expr], ...]:
    a, b, rate = found
    return (("p**2 as a cosine", motion.square - a - b * sp.cos(rate * motion.q)),)


def cosine(square: sp.Expr, q: sp.Symbol) -> tuple[sp.Expr, sp.Expr, sp.Expr] | None:
    """(a, b, κ) of a + b cos(κq) with real b and κ > 0; None for anything else."""
    wave = sp.Dummy("c", real=True)
    for call in sorted(square.atoms(sp.cos, sp.sin), key=str):
        rate = sp.expand(call.args[0]).diff(q)
        if rate.has(q) or rate == 0:
            continue
        for turn in (rate, 2 * rate):  # sin(q/2)**2 is a cosine of q
            half = sp.expand(turn * q / 2)
            rules: Any = {sp.sin(half): sp.sqrt((1 - wave) / 2), sp.cos(half): sp.sqrt((1 + wave) / 2)}
            rules |= {sp.cos(sp.expand(turn * q)): wave}
            plain: Any = sp.expand(sp.expand(square).xreplace(rules))
            if plain.has(q) or not plain.is_polynomial(wave) or degree(plain, wave) != 1:
                continue
            a, b = plain.coeff(wave, 0), plain.coeff(wave, 1)
            if not is_complex(b) and not is_complex(turn):
                return a, b, _size(turn)
    return None


def _exponent(power: Any, q: sp.Symbol) -> Any:
    """n of |q|ⁿ, however that is written: sympy has q² for |q|², and q² |q| for |q|³. None of anything else."""
    x = sp.Dummy(positive=True)
    base, n = sp.powsimp(power.xreplace({q: x})).as_base_exp()
    return n if base == x and power.xreplace({q: -q}) == power and not n.has(x) else None


def power_well(motion: OneDegree) -> Iterator[ClosedAction]:
    """The action where the square of the momentum is γ(α − β|q|ⁿ)ʳ on the whole line, n > 0 and r > 0."""
    q = motion.q
    if (motion.low, motion.high) != (sp.S.NegativeInfinity, sp.S.Infinity):
        return
    factor, power = motion.square.as_independent(q, as_Add=False)
    base, r = power.as_base_exp() if isinstance(power, sp.Pow) else (power, sp.S.One)
    if isinstance(base, sp.Symbol) or base.func is sp.Abs or known_sign(r) != "positive" or not r.is_Rational:
        base, r, factor = motion.square, sp.S.One, sp.S.One
    expanded = sp.expand(base if r != 1 else motion.square)
    factor = factor if r != 1 else sp.S.One
    alpha, rest = expanded.as_independent(q, as_Add=True)
    slope, power = rest.as_independent(q, as_Add=False)
    n = _exponent(power, q)
    if n is None or known_sign(n) != "positive" or known_sign(factor) != "positive":
        return
    beta = -slope
    gamma: Any = sp.gamma
    value = 4 * sp.sqrt(factor) * alpha ** (r / 2) * (alpha / beta) ** (1 / n)
    value = value * gamma(1 + 1 / n) * gamma(1 + r / 2) / gamma(1 + r / 2 + 1 / n)
    same = (("p**2 as a power", motion.square - factor * (alpha - beta * power) ** r),)
    yield ClosedAction(value, (alpha, beta), same, "Euler's beta function", passes_zero=True, inside=sp.S.Zero)
