"""Antiderivatives to try: sympy's rules, and those of a few integrands of mechanics that these don't know.

Nothing rests on any of them: whether its derivative is the integrand, and where it is smooth, is decided afterwards.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import lcm
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.deadline import within
from canon.errors import InputError
from canon.expression import Formula
from canon.mechanics.formulas import as_formula
from canon.mechanics.unfinished_integrals import forget_unfinished_integrals
from canon.mechanics.wave_integrals import wave_integrals

if TYPE_CHECKING:
    from canon.claims.question import Question

FOUND_NONE = (
    ArithmeticError, AttributeError, InputError, LookupError, NotImplementedError, RecursionError, TypeError,
    ValueError,
)  # fmt: skip
"""What sympy raises where it has no rule, and what says that its answer has no place in the language."""
LONGEST = 60
"""Operations of an integrand of which an antiderivative is looked for."""


def antiderivatives(question: Question, f: Formula, x: sp.Symbol) -> Iterator[Formula]:
    """Formulas that may be antiderivatives of f by x. **Raises:** `BudgetExceeded`."""
    expression: Any = f.expr
    if sp.count_ops(expression) > LONGEST:
        return
    rules = (_of_a_slope,) if expression.has(sp.Derivative) else (wave_integrals, _by_rules, _of_exponentials)
    plain = sp.Symbol(x.name, real=True)
    constant, integrand = expression.subs(x, plain).as_independent(plain, as_Add=False)
    seen = set[Any]()
    for rule in (_of_cosines, *rules):
        try:
            found = within(question.budget.share(0.3), lambda rule=rule: list(rule(integrand, plain)))
        except FOUND_NONE:
            continue
        for F in found:
            if F in seen or F.has(sp.Integral, sp.Piecewise, sp.I):
                continue
            seen.add(F)
            try:
                formula = as_formula(constant * F.subs(plain, x))
            except FOUND_NONE:
                continue
            yield formula


def _by_rules(f: Any, x: sp.Symbol) -> Iterator[Any]:
    """Sympy's rules; of what they distinguish cases each case."""
    from sympy.integrals.manualintegrate import manualintegrate

    forget_unfinished_integrals()
    found: Any = manualintegrate(f, x)
    if isinstance(found, sp.Piecewise):
        cases: Any = found.args
        yield from (case for case, _ in cases)
    yield found
    if f.is_rational_function(x):
        from sympy.integrals.rationaltools import ratint

        yield ratint(f, x)


def _of_exponentials(f: Any, x: sp.Symbol) -> Iterator[Any]:
    """exp(k x) times a wave; and rational functions of exp(k x), hyperbolic ones among them, by w = exp(k x)."""
    yield from _of_a_damped_wave(f, x)
    written = f.rewrite(sp.exp)
    rates = {part.args[0].coeff(x) for part in written.atoms(sp.exp) if part.has(x)}
    if not rates or any(part.args[0].has(x) and sp.diff(part.args[0], x, 2) != 0 for part in written.atoms(sp.exp)):
        return
    first = min(rates, key=lambda rate: (abs(rate) if rate.is_number else 0, str(rate)))
    ratios = [sp.simplify(rate / first) for rate in rates]
    if not all(ratio.is_Rational for ratio in ratios):
        return
    unit = first / lcm(*(int(ratio.q) for ratio in ratios))
    w = sp.Symbol("w", positive=True)
    images = {
        part: sp.exp(part.args[0] - part.args[0].coeff(x) * x) * w ** sp.simplify(part.args[0].coeff(x) / unit)
        for part in written.atoms(sp.exp)
        if part.has(x)
    }
    rational = sp.cancel(sp.together(written.xreplace(images) / w))
    if rational.has(x) or not rational.is_rational_function(w):
        return
    from sympy.integrals.rationaltools import ratint

    yield ratint(rational, w).subs(w, sp.exp(unit * x)) / unit


def _of_cosines(f: Any, x: sp.Symbol) -> Iterator[Any]:
    """What becomes plainer where sin² is 1 − cos², as p² along an ellipse; and with g, then −g, for a root √(g²), as
    that of the distance r = 1 − e cos u by x and y.
    """
    if not f.has(sp.sin, sp.cos):
        return
    moduli: dict[Any, Any] = {part: part.args[0] for part in f.atoms(sp.Abs) if part.has(x)}
    for part in f.atoms(sp.Pow):
        if part.exp.is_Rational and part.exp.q == 2 and part.base.has(x):
            found: Any = sp.factor_list(_in_cosines(part.base))
            factor, factors = found
            if any(power % 2 for _, power in factors):
                return
            moduli[part] = (sp.sqrt(factor) * sp.prod([base ** (power // 2) for base, power in factors])) ** part.exp.p
    for sign in (1, -1) if moduli else (1,):
        plain = f.xreplace({part: sign * value for part, value in moduli.items()})
        above, below = (_in_cosines(part) for part in sp.fraction(sp.together(plain)))
        plainer = sp.expand(sp.cancel(above / below))
        yield from wave_integrals(plainer, x)
        yield from _by_rules(plainer, x)


def _in_cosines(f: Any) -> Any:
    """A polynomial in sines and cosines, of the sines at most their first powers."""
    written = sp.expand(f)
    for wave in written.atoms(sp.sin):
        written = sp.expand(written.subs(wave**2, 1 - sp.cos(wave.args[0]) ** 2))
    return written


def _of_a_slope(f: Any, x: sp.Symbol) -> Iterator[Any]:
    """g(V) times the derivative of an arbitrary function V of x alone."""
    slopes = f.atoms(sp.Derivative)
    if len(slopes) != 1:
        return
    (slope,) = slopes
    place, call = sp.Symbol("place", real=True), slope.expr
    if slope.variables != (x,) or call.args != (x,):
        return
    rest = (f / slope).subs(call, place)
    if rest.has(x, sp.Derivative):
        return
    yield from (F.subs(place, call) for F in _by_rules(rest, place))


def _of_a_damped_wave(f: Any, x: sp.Symbol) -> Iterator[Any]:
    """c exp(k x + d) cos(w x + e), or sin."""
    c, rest = f.as_independent(x)
    factors = sp.Mul.make_args(rest)
    if len(factors) != 2:
        return
    grows = next((g for g in factors if isinstance(g, sp.exp)), None)
    wave = next((g for g in factors if isinstance(g, (sp.sin, sp.cos))), None)
    if grows is None or wave is None:
        return
    k, w = sp.diff(grows.args[0], x), sp.diff(wave.args[0], x)
    if k.has(x) or w.has(x):
        return
    yield c * grows * (k * wave - sp.diff(wave, x)) / (k**2 + w**2)
