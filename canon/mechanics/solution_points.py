"""Sample points at which equations hold: there what solving them has found is looked at.

Points are made by choosing the unknowns, within what is assumed of their names and where the conditions of a domain
hold, and computing the rest.
"""

from collections.abc import Iterator, Mapping, Sequence
from random import Random
from typing import Any, Final, TypeAlias

import sympy as sp
from sympy.core.function import AppliedUndef

from canon.domain import Condition
from canon.mechanics.formulas import replaced

Point: TypeAlias = dict[Any, Any]

SAMPLES: Final = 12
_ATTEMPTS: Final = 8
_ATTEMPTS_WITHIN: Final = 50
_DIGITS: Final = 30


def sample_points(
    equations: Mapping[sp.Symbol, sp.Expr],
    unknowns: Sequence[sp.Symbol],
    also: Mapping[sp.Symbol, sp.Expr],
    within: Sequence[Condition] = (),
) -> Iterator[Point]:
    """Points at which y = equations[y], and what is defined in `also`, where the conditions hold; none with unknown
    functions, and none where they are not met by chance.

    Each variable is chosen but for those that the equations, and `also`, give.
    """
    values = [*equations.values(), *also.values(), *(term for condition in within for term in condition.terms)]
    occurring: set[Any] = {*unknowns, *(symbol for value in values for symbol in value.free_symbols)}
    if any(value.atoms(AppliedUndef) for value in values):
        return
    chosen = sorted(occurring - {*equations, *also}, key=str)
    ranges = _ranges(within)
    first = [condition for condition in within if _names(condition) <= {*chosen}]
    last = [condition for condition in within if condition not in first]
    random, count = Random(0), 0
    for attempt in range((_ATTEMPTS_WITHIN if within else _ATTEMPTS) * SAMPLES):
        size = (1, 3)[attempt % 2]
        point = {symbol: _choice(symbol, random, size, ranges.get(symbol)) for symbol in chosen}
        if not all(holds(condition, point) for condition in first):
            continue
        for given in (equations, also):
            point |= {name: replaced(value, point).evalf(_DIGITS) for name, value in given.items()}
        if all(_suits(name, point[name]) for name in (*equations, *also)) and all(holds(c, point) for c in last):
            yield point
            count += 1
            if count == SAMPLES:
                return


def agrees(solution: Mapping[Any, Any], point: Point) -> bool:
    """Whether a solution gives the unknowns at a point."""
    for unknown, formula in solution.items():
        value = (replaced(formula, point) - point[unknown]).evalf(_DIGITS)
        if not value.is_number or value.has(sp.nan, sp.zoo) or abs(complex(value)) > 1e-9:
            return False
    return True


def real_value(expression: sp.Expr, point: Point) -> float | None:
    """The value of an expression at a point, None where it has none that is real and finite."""
    value: Any = replaced(expression, point).evalf(_DIGITS)
    if not value.is_number or value.has(sp.nan, sp.zoo, sp.oo):
        return None
    number = complex(value)
    return None if abs(number.imag) > 1e-12 * (1 + abs(number)) else number.real


def _names(condition: Condition) -> set[Any]:
    return {symbol for term in condition.terms for symbol in term.free_symbols}


def holds(condition: Condition, point: Point) -> bool:
    """Whether a condition holds at a point, as far as its terms have real values there."""
    if condition.kind == "regular":
        return True
    terms = [replaced(term, point).evalf(_DIGITS) for term in condition.terms]
    if not all(term.is_number and not term.has(sp.nan, sp.zoo, sp.oo) for term in terms):
        return False
    values = [complex(term) for term in terms]
    if condition.kind == "positive":
        return values[0].real > 0 and abs(values[0].imag) <= 1e-12 * abs(values[0])
    if condition.kind == "nonzero":
        return values[0] != 0
    *_, last = values
    return not (last.real <= 0 and last.imag == 0 and values[0].imag == 0 and (len(values) == 1 or values[0] == 0))


def _ranges(within: Sequence[Condition]) -> dict[Any, tuple[float | None, float | None]]:
    """Between which numbers the conditions that are linear in one name want it to be."""
    found: dict[Any, tuple[float | None, float | None]] = {}
    for condition in within:
        names = _names(condition)
        if condition.kind != "positive" or len(names) != 1:
            continue
        (name,) = names
        slope = condition.terms[0].diff(name)
        if not slope.is_number or not slope.is_real or slope == 0:
            continue
        end = float(-replaced(condition.terms[0], {name: sp.S.Zero}) / slope)
        low, high = found.get(name, (None, None))
        if slope > 0:
            low = end if low is None else max(low, end)
        else:
            high = end if high is None else min(high, end)
        found[name] = low, high
    return found


def _choice(symbol: sp.Symbol, random: Random, size: int, ends: tuple[float | None, float | None] | None) -> sp.Expr:
    if symbol.is_integer:
        return sp.Integer(random.randint(1, 4) * (-1 if symbol.is_negative else 1))
    share = sp.Rational(random.randint(20, 1000), 1000)
    low, high = ends or (None, None)
    if symbol.is_nonnegative:
        low = max(low or 0.0, 0.0)
    elif symbol.is_nonpositive:
        high = min(high or 0.0, 0.0)
    if low is not None and high is not None:
        return sp.Rational(low) + (sp.Rational(high) - sp.Rational(low)) * share * sp.Rational(999, 1000)
    value = share * size
    if low is not None:
        return sp.Rational(low) + value
    if high is not None:
        return sp.Rational(high) - value
    return value if random.random() < 0.5 else -value


def _suits(symbol: sp.Symbol, value: sp.Expr) -> bool:
    """Whether a sampled value is finite and what is assumed of its name."""
    if not value.is_number or value.has(sp.zoo, sp.nan, sp.oo):
        return False
    if symbol.is_real and not value.is_real:
        return False
    if symbol.is_nonnegative and not value.is_nonnegative:
        return False
    return not (symbol.is_nonpositive and not value.is_nonpositive)
