"""Shorter trigonometric formulas by cos^2 + sin^2 = 1 and cosh^2 - sinh^2 = 1 alone: quick, where a search is not."""

from typing import Any

import sympy as sp

_QUOTIENTS = {
    sp.tan: lambda a: sp.sin(a) / sp.cos(a),
    sp.cot: lambda a: sp.cos(a) / sp.sin(a),
    sp.sec: lambda a: 1 / sp.cos(a),
    sp.csc: lambda a: 1 / sp.sin(a),
    sp.tanh: lambda a: sp.sinh(a) / sp.cosh(a),
    sp.coth: lambda a: sp.cosh(a) / sp.sinh(a),
}
_PAIRS = ((sp.sin, sp.cos, 1), (sp.sinh, sp.cosh, -1))


def contracted(expression: Any) -> Any:
    """The same function with squares of sines or cosines eliminated where that makes it shorter.

    Radicands, numerator and denominator are taken by themselves, and one angle after the other.
    """
    if not expression.has(sp.sin, sp.cos, sp.sinh, sp.cosh, *_QUOTIENTS):
        return expression
    plain = expression
    for function, quotient in _QUOTIENTS.items():
        plain = plain.replace(function, quotient)
    plain = plain.replace(
        lambda part: part.is_Pow and part.exp.is_Rational and not part.exp.is_Integer,
        lambda root: contracted(root.base) ** root.exp,
    )
    numerator, denominator = sp.fraction(sp.cancel(sp.together(plain)))
    numerator, denominator = _shortened(numerator), _shortened(denominator)
    return min((expression, sp.cancel(numerator / denominator), numerator / denominator), key=sp.count_ops)


def _shortened(part: Any) -> Any:
    for sine, cosine, sign in _PAIRS:
        angles = {call.args[0] for call in part.atoms(sine)} & {call.args[0] for call in part.atoms(cosine)}
        for angle in sorted(angles, key=sp.default_sort_key):
            s, c = sine(angle), cosine(angle)
            choices = [part, _eliminated(part, s, c, (1 - c**2) * sign), _eliminated(part, c, s, 1 - sign * s**2)]
            part = min(choices, key=sp.count_ops)
    return part


def _eliminated(part: Any, wave: Any, other: Any, square: Any) -> Any:
    """`part` with wave^2 = `square` used until wave occurs at most once; unchanged if it is not a polynomial in it."""
    x, y = sp.Dummy(), sp.Dummy()
    named = part.xreplace({wave: x, other: y})
    if not named.is_polynomial(x, y):
        return part
    terms = sp.Poly(named, x).terms()
    total = sp.Add(*(coefficient * x ** (k % 2) * square ** (k // 2) for (k,), coefficient in terms))
    return sp.expand(total.xreplace({x: wave, y: other}))
