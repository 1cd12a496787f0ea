"""Signs on intervals: of affine forms, by a map of the box onto the orthant, and by real roots."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from flint import fmpq, fmpq_poly

from canon.decide.intervals import Edge, Interval, declared
from canon.decide.ring import Polynomial

if TYPE_CHECKING:
    from canon.decide.tower import Generator, Tower

PI = Fraction(31415926535897932384626433832795, 10**31)  # a place near it, not a bound
MOST_DEGREE = 8


def interval_of(tower: Tower, made: Generator) -> Interval | None:
    """The interval of a real generator, from its symbol's bounds and its sign; None for others."""
    if made.kind != "symbol":
        return Interval(low=Edge()) if made.sign == "pos" else None
    symbol = tower.tape.symbol_at(made.data)
    if not symbol.is_real:
        return None
    interval = tower.intervals.get(made.data, declared(tower.tape, made.data))
    if made.sign == "pos":
        interval = interval.meet(Interval(low=Edge()))
    return interval.meet(Interval(high=Edge())) if made.sign == "neg" else interval


def affine_sign(tower: Tower, p: Polynomial) -> str | None:
    """a + b·x, with a in Q + Q·π and x in a known interval."""
    shift, slope, found = Edge(), Fraction(0), None
    for monomial, coefficient in tower.ring.terms(p).items():
        if not any(monomial):
            shift = shift.plus(Edge(coefficient))
            continue
        made = tower.generators[monomial.index(1)] if sum(monomial) == 1 else None
        if made is not None and made.kind == "pi":
            shift = shift.plus(Edge(Fraction(0), coefficient))
        elif made is not None and made.kind == "symbol" and found is None:
            slope, found = coefficient, made
        else:
            return None
    interval = interval_of(tower, found) if found is not None else None
    return interval.affine(slope, shift).sign() if interval is not None else None


def sign_on_orthant(tower: Tower, p: Polynomial) -> str | None:
    """All coefficients of one sign after the box is mapped onto the positive orthant by x = (a + b·t)/(1 + t)."""
    ring = tower.ring
    degrees = ring.degrees(p)
    if max(degrees) > MOST_DEGREE or sum(1 for d in degrees if d) > 4:
        return None
    maps: dict[int, tuple[Polynomial, Polynomial]] = {}
    for k, degree in enumerate(degrees):
        if not degree:
            continue
        interval, t = interval_of(tower, tower.generators[k]), ring.generators[k]
        if interval is None or any(e is not None and e.pi for e in (interval.low, interval.high)):
            return None
        low = None if interval.low is None else ring.constant(interval.low.rational)
        high = None if interval.high is None else ring.constant(interval.high.rational)
        if low is not None and high is not None:
            maps[k] = low + high * t, ring.one + t
        elif low is not None:
            maps[k] = low + t, ring.one
        elif high is not None:
            maps[k] = high - t, ring.one
        else:
            return None
    total = ring.zero
    for monomial, coefficient in ring.terms(p).items():
        term = ring.constant(coefficient)
        for k, (top, under) in maps.items():
            term = term * top ** monomial[k] * under ** (degrees[k] - monomial[k])
        total = total + term
    signs = {coefficient > 0 for coefficient in ring.terms(total).values()}
    if len(signs) != 1:
        return None
    return "pos" if signs.pop() else "neg"


def sign_by_real_roots(tower: Tower, p: Polynomial) -> str | None:
    """A polynomial over Q in one symbol, without a real root in the symbol's interval."""
    used = tower.used(p)
    if len(used) != 1 or used[0].kind != "symbol":
        return None
    interval = interval_of(tower, used[0])
    if interval is None:
        return None
    k = used[0].index
    coefficients = [fmpq(0)] * (tower.ring.degrees(p)[k] + 1)
    for monomial, c in tower.ring.terms(p).items():
        coefficients[monomial[k]] = fmpq(c.numerator, c.denominator)
    polynomial = fmpq_poly(coefficients)
    roots: Any = polynomial.complex_roots()
    for root, _ in roots:
        if root.imag.is_zero() and not _outside(root.real, interval):
            return None
    place = _inside(interval)
    return None if place is None else ("pos" if polynomial(place) > 0 else "neg")


def _outside(root: Any, interval: Interval) -> bool:
    below = interval.low is not None and bool(root <= _ball(interval.low))
    return below or (interval.high is not None and bool(root >= _ball(interval.high)))


def _ball(edge: Edge) -> Any:
    from flint import arb

    return arb(fmpq(edge.rational.numerator, edge.rational.denominator)) + arb.pi() * arb(
        fmpq(edge.pi.numerator, edge.pi.denominator)
    )


def _inside(interval: Interval) -> fmpq | None:
    """A rational number certainly inside the interval, about its middle; None where it is too thin for that."""
    low, high = (None if edge is None else edge.rational + PI * edge.pi for edge in (interval.low, interval.high))
    if low is not None and high is not None:
        value = (low + high) / 2
    elif low is not None:
        value = low + 1
    else:
        value = high - 1 if high is not None else Fraction(0)
    place = fmpq(value.numerator, value.denominator)
    above = interval.low is None or _certainly_below(interval.low, Edge(value))
    return place if above and (interval.high is None or _certainly_below(Edge(value), interval.high)) else None


def _certainly_below(low: Edge, high: Edge) -> bool:
    """Whether low < high: exactly where π isn't in them, else by balls."""
    if low.pi == high.pi:
        return low.rational < high.rational
    return bool(_ball(low) < _ball(high))
