"""Formulas with the conditions under which they are defined: wrapping, and substitution along a map."""

from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import Any, TypeAlias

import sympy as sp

from canon.constants import reliable
from canon.domain import Condition, Domain, Smoothness, nonzero, positive, unique
from canon.errors import InputError
from canon.expected import listed
from canon.expression import Formula
from canon.granted import moved
from canon.mechanics.admissible import check_calls, check_leak, check_symbol
from canon.mechanics.extent import check_extent, extent_of, recursion_told
from canon.special import EllipticPi
from canon.substitution import replaced

Expression: TypeAlias = Formula | sp.Expr | int | Fraction


def as_expression(value: Expression, where: str = "") -> sp.Expr:
    """The bare sympy expression of `value`.

    **Arguments:** a `Formula`, a sympy expression, an `int` or a `Fraction`.

    **Raises:** `InputError` for floats (exact claims want exact numbers) and for anything else.
    """
    if isinstance(value, Formula):
        return value.expr
    if isinstance(value, bool) or not isinstance(value, int | Fraction | sp.Expr):
        advice = "; write Rational('0.1') for an exact 0.1" if isinstance(value, float) else ""
        advice = "; text is read by space.formula(...)" if isinstance(value, str) else advice
        raise InputError(f"an expression is expected, not {value!r}{advice}", where)
    if isinstance(value, sp.Expr):
        if isinstance(value, sp.Lambda):
            raise InputError(f"{value} is a function: call it with an argument", where)
        check_extent(value, where=where)
        for part in (sp.zoo, sp.nan, sp.oo, -sp.oo):
            if value.has(part):
                raise InputError(f"the expression contains {part}: it is undefined everywhere", where)
        if value.has(sp.Float):
            raise InputError(f"{value} contains a floating-point number; write it as a Rational", where)
        if not value.is_commutative:
            raise InputError(f"{value} contains symbols that do not commute", where)
        plain: Any = reliable(value)
        return plain.replace(sp.elliptic_pi, EllipticPi) if plain.has(sp.elliptic_pi) else plain
    number = sp.Integer(value) if isinstance(value, int) else sp.Rational(value.numerator, value.denominator)
    check_extent(number, where=where)
    return number


def as_formula(value: Expression, where: str = "", smoothness: Smoothness | None = None) -> Formula:
    """`value` as a `Formula`; a plain expression gets the conditions that its own form shows.

    `smoothness` knows them of subexpressions that it has seen before.
    """
    if isinstance(value, Formula):
        return value
    with recursion_told(where):
        expression = as_expression(value, where)
        return Formula(expression, (smoothness or Smoothness())(expression))


def as_formulas(
    values: Expression | Iterable[Expression], where: str = "", smoothness: Smoothness | None = None
) -> tuple[Formula, ...]:
    """Several of them; a single expression counts as a sequence of one."""
    smoothness = smoothness or Smoothness()
    if isinstance(values, Formula | sp.Expr | int | Fraction | str) or not isinstance(values, Iterable):
        return (as_formula(values, where, smoothness),)  # pyright: ignore[reportArgumentType] - refused there
    return tuple(as_formula(value, where, smoothness) for value in listed(values, "expressions", where))


def check_symbols(formulas: Iterable[Formula | sp.Expr], known: Mapping[str, sp.Symbol], where: str = "") -> None:
    """Refuse a symbol that bears a name of the phase space but isn't its symbol: derivatives by that would miss it.

    And one of which, or a function of which, more is assumed than a claim can state (`canon.mechanics.admissible`).

    **Arguments:** `known`, the space's symbols by name.

    **Raises:** `InputError` with what differs and where to take the symbol from.
    """
    formulas = tuple(formulas)
    for formula in formulas:
        expression = formula.expr if isinstance(formula, Formula) else formula
        symbols = sorted((s for s in expression.free_symbols if isinstance(s, sp.Symbol)), key=str)
        for symbol in symbols:
            name, meant = symbol.name, known.get(symbol.name, symbol)
            if meant != symbol:
                mine, its = (_assumed(x) for x in (symbol, meant))
                raise InputError(
                    f"this {name} is {mine}, and the {name} of the phase space is {its}: two different symbols; "
                    f"take it from the space, as in {name} = space.symbols({name!r})",
                    where,
                )
            check_symbol(symbol, where)
            if name not in known:
                check_leak(symbol, expression, where)
    check_calls(formulas, where)


def _assumed(symbol: Any) -> str:
    """What sets a symbol apart, in words."""
    if type(symbol) is not sp.Symbol:
        return f"a {type(symbol).__name__}"
    if symbol.is_positive or symbol.is_negative:
        return "positive" if symbol.is_positive else "negative"
    if symbol.is_real:
        return "an integer" if symbol.is_integer else "nonnegative" if symbol.is_nonnegative else "real"
    return "complex" if symbol.is_complex else "a symbol without assumptions"


def substituted(formula: Formula, mapping: Mapping[sp.Symbol, Formula]) -> Formula:
    """The pull-back of `formula` along x -> mapping[x].

    It is defined where the images that it uses are defined, its own conditions hold of them, and they are what is
    assumed of the symbols in whose place they stand: it may have been simplified by that, as √x² to x.
    """
    extents = {symbol: extent_of(image.expr) for symbol, image in mapping.items()}
    for expression in (formula.expr, *(term for condition in formula.conditions for term in condition.terms)):
        check_extent(expression, extents)
    with recursion_told():
        return _substituted(formula, mapping)


def _substituted(formula: Formula, mapping: Mapping[sp.Symbol, Formula]) -> Formula:
    used = [symbol for symbol in mapping if symbol in formula.symbols]
    images: dict[sp.Expr, sp.Expr] = {symbol: image.expr for symbol, image in mapping.items()}
    own = Domain(conditions=formula.conditions).substitute(images).conditions
    inherited = tuple(c for s in used for c in mapping[s].conditions)
    assumed = tuple(c for s in used for c in assumed_of(s, mapping[s].expr))
    inside = (operation for s in used for operation in mapping[s].granted)
    granted = tuple(dict.fromkeys((*inside, *moved(formula.granted, images))))
    conditions = distinct(inherited + own + assumed)
    return Formula(replaced(formula.expr, images), conditions, formula.text, granted=granted)


def assumed_of(symbol: sp.Symbol, image: sp.Expr) -> tuple[Condition, ...]:
    """The sign that a symbol is assumed to have, as a condition on what stands in its place."""
    if image == symbol or (image == 0 and symbol.is_zero is not False):
        return ()
    if symbol.is_nonnegative or symbol.is_nonpositive:
        return positive(image if symbol.is_nonnegative else -image)
    return nonzero(image) if symbol.is_zero is False else ()


def distinct(conditions: Iterable[Condition]) -> tuple[Condition, ...]:
    """The conditions in their order, each kind and terms once."""
    return unique(conditions)
