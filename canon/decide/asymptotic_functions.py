"""Functions of asymptotic expansions: Taylor's series at points inside a domain, and the edges that have series too.

Olver, Asymptotics and Special Functions, §1.7; the complete elliptic integrals at m = 0 by DLMF 19.5.1 and 19.5.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import comb
from typing import TYPE_CHECKING, Final

import sympy as sp

from canon.decide.derivative import derivative, substitute
from canon.decide.power_series import Series, Unexpanded
from canon.decide.tape import ONE, Node, Unsupported

if TYPE_CHECKING:
    from canon.decide.asymptotic import Expander

_HALF: Final = Fraction(1, 2)


def of_function(e: Expander, name: str, nodes: Sequence[Node], arguments: Sequence[Series]) -> Series:
    """The expansion of a function of the language, from those of its arguments.

    **Raises:** `Unexpanded` at the edge of its domain, or where it grows beyond every power.
    """
    tape, u = e.tape, arguments[0]
    if name == "abs":
        f, sign = e.leading(u)
        return f if sign == "pos" else e.series.scaled(f, -ONE)
    if name == "atan2":
        return _atan2(e, *arguments)
    if name == "log":
        return _log(e, u)
    if name == "exp" and u.start < 0:
        u, sign = e.stripped(u)
        if u.start < 0:
            if sign == "pos":
                raise Unexpanded("an exponential beyond every power")
            return e.series.exact(0, ())  # smaller than every power
    if name == "atan":
        return _atan(e, u)
    if name in ("sin", "cos") and _may_grow(e, u):
        wave = tape.symbol(sp.Dummy("wave", real=True))
        e.waves.add(wave)
        return e.series.exact(0, (wave,))
    if any(f.start < 0 and e.stripped(f)[0].start < 0 for f in arguments):
        raise Unexpanded(f"{name} of something that grows beyond all bounds")
    moving = [k for k, a in enumerate(nodes) if e.s in tape.support(a)]
    if len(moving) > 1:
        raise Unexpanded(f"{name} of several arguments that move")
    (k,) = moving
    place = tape.symbol(sp.Dummy(real=True))
    call = tape.call(name, *(place if j == k else a for j, a in enumerate(nodes)))
    return _taylor(e, call, place, e.stripped(arguments[k])[0], name)


def _may_grow(e: Expander, u: Series) -> bool:
    """Whether the series isn't seen to be bounded; a sine or cosine of it is, whatever it does."""
    try:
        return e.stripped(u)[0].start < 0
    except Unexpanded:
        return True


def _taylor(e: Expander, call: Node, place: Node, u: Series, name: str) -> Series:
    """A function of one argument at the argument's value for s = 0, which lies inside its domain."""
    tape = e.tape
    if u.start > 0:
        u = Series(0, (*([tape.zero] * u.start), *u.coefficients))
    if not u.coefficients:
        raise Unexpanded("too few terms")
    centre = u.coefficients[0]
    if e.wild(centre):
        raise Unexpanded(f"{name} of a logarithm or an oscillation")
    if name in ("elliptic_k", "elliptic_e") and e.sign_of(centre) == "zero":
        return e.series.composed(_elliptic(e, name), e.series.rest(u, tape.one))
    if name in ("asin", "acos"):
        margin = tape.minus(tape.one, tape.power(centre, 2))
        if e.sign_of(margin) == "zero":
            return _arc(e, name, u)
    _inside(e, name, centre, call, place)
    coefficients, slope, factorial = [], call, 1
    for k in range(e.terms):
        factorial *= max(k, 1)
        at = _plain(e, substitute(tape, slope, {place: centre}))
        coefficients.append(tape.scaled(at, Fraction(1, factorial)))
        if k + 1 < e.terms:
            try:
                slope = derivative(tape, slope, place)
            except Unsupported as reason:
                raise Unexpanded(str(reason)) from None
    return e.series.composed(coefficients, e.series.rest(u, tape.one))


def _plain(e: Expander, node: Node) -> Node:
    """The number that a sine or cosine of a multiple of π/2, or its negative, is; else the node as it is."""
    tape, op = e.tape, e.tape.ops[node]
    if op[0] == "+" and not op[1] and len(op[2]) == 1:
        inner, factor = op[2][0]
        return tape.scaled(_plain(e, inner), factor)
    if op[0] != "f" or op[1] not in ("sin", "cos"):
        return node
    turns = tape.times(op[2][0], tape.power(tape.constant("pi"), -1))
    value = tape.value(tape.scaled(turns, 2))
    if value is None or value.denominator > 1:
        return node
    quarter = (int(value) - (op[1] == "sin")) % 4  # sin x = cos(x − π/2)
    return tape.number((1, 0, -1, 0)[quarter])


def _arc(e: Expander, name: str, u: Series) -> Series:
    """asin or acos at ±1: asin u = atan(u/√(1 − u²)) on both sides of which |u| < 1."""
    root = e.power(
        e.series.add(e.series.exact(0, (e.tape.one,)), e.series.scaled(e.series.mul(u, u), -ONE)),
        _HALF,
    )
    arc = _atan(e, e.series.mul(u, e.power(root, -ONE)))
    if name == "asin":
        return arc
    quarter = e.series.exact(0, (e.tape.scaled(e.tape.constant("pi"), _HALF),))
    return e.series.add(quarter, e.series.scaled(arc, -ONE))


def _elliptic(e: Expander, name: str) -> list[Node]:
    """The coefficients at m = 0 of K or E (DLMF 19.5.1, 19.5.2)."""
    squares = [Fraction(comb(2 * n, n), 4**n) ** 2 for n in range(e.terms)]
    factors = [square if name == "elliptic_k" else square / (1 - 2 * n) for n, square in enumerate(squares)]
    return [e.tape.scaled(e.tape.constant("pi"), _HALF * f) for f in factors]


def _inside(e: Expander, name: str, centre: Node, call: Node, place: Node) -> None:
    """Whether the function, a call in which an argument is at that place, is analytic at the point."""
    tape = e.tape
    if name in ("exp", "sin", "cos", "atan"):
        return
    if name in ("asin", "acos"):
        margin = tape.minus(tape.one, tape.power(centre, 2))
    elif name in ("elliptic_k", "elliptic_e") and e.sign_of(centre) in ("pos", "neg"):
        margin = tape.minus(tape.one, centre)
    elif name in ("elliptic_f", "elliptic_ei") and tape.ops[call][2][0] == place:
        margin = tape.minus(tape.one, tape.ops[call][2][1])  # analytic in φ for m < 1
    elif name in ("gamma", "log"):
        margin = centre
    else:
        raise Unexpanded(f"no expansion of {name}")
    if e.sign_of(margin) != "pos":
        raise Unexpanded(f"{name} at the edge of its domain, or beyond")


def _log(e: Expander, u: Series) -> Series:
    tape = e.tape
    f, sign = e.leading(u)
    if sign != "pos":
        raise Unexpanded("the logarithm of something that isn't positive")
    first = f.coefficients[0]
    coefficients = [tape.zero, *(tape.number(Fraction((-1) ** (k + 1), k)) for k in range(1, e.terms))]
    inner = e.series.composed(coefficients, e.series.rest(f, tape.power(first, -1)))
    lead = tape.add([(tape.call("log", first), 1), (e.log, f.start)])
    return e.series.add(e.series.exact(0, (lead,)), inner)


def _atan(e: Expander, u: Series) -> Series:
    tape = e.tape
    u, sign = e.stripped(u)
    place = tape.symbol(sp.Dummy(real=True))
    call = tape.call("atan", place)
    if u.start >= 0:
        return _taylor(e, call, place, u, "atan")
    turned = _taylor(e, call, place, e.power(u, -ONE), "atan")
    quarter = tape.scaled(tape.constant("pi"), _HALF if sign == "pos" else -_HALF)
    return e.series.add(e.series.exact(0, (quarter,)), e.series.scaled(turned, -ONE))


def _atan2(e: Expander, y: Series, x: Series) -> Series:
    tape = e.tape
    x, sign = e.leading(x)
    found = _atan(e, e.series.mul(y, e.power(x, -ONE)))
    if sign == "pos":
        return found
    _, above = e.leading(y)
    half = tape.scaled(tape.constant("pi"), 1 if above == "pos" else -1)
    return e.series.add(found, e.series.exact(0, (half,)))


def of_arbitrary(
    e: Expander, name: str, orders: tuple[int, ...], nodes: tuple[Node, ...], arguments: Sequence[Series]
) -> Series:
    """The expansion of an arbitrary smooth function, or a derivative of it, at the value where its argument goes."""
    tape = e.tape
    moving = [k for k, a in enumerate(nodes) if e.s in tape.support(a)]
    if len(moving) > 1:
        raise Unexpanded(f"{name} of several arguments that move")
    (k,) = moving
    u = e.stripped(arguments[k])[0]
    if u.start < 0:
        raise Unexpanded(f"{name} of something that grows beyond all bounds")
    if u.start == 0 and u.coefficients:
        centre = u.coefficients[0]
    else:
        centre = tape.zero
    e.arbitrary.add((name, tuple(centre if j == k else a for j, a in enumerate(nodes))))
    place = tape.symbol(sp.Dummy(real=True))
    call = tape.arbitrary(name, orders, tuple(place if j == k else a for j, a in enumerate(nodes)))
    return _taylor(e, call, place, u, "exp")
