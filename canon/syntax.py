"""The language of formulas: text to a tree of what was written, nothing evaluated.

The grammar is Python's for `+ - * / **`, signs, parentheses and calls of names, and no more. It is read by a parser of
its own, so that `lambda` is a name, numbers are exact, and what the language doesn't have is refused with the place.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Final

from canon.errors import InputError
from canon.tokens import RELATIONS, Token, place, tokens

DEEPEST: Final = 100
"""The most levels of parentheses, calls, signs and exponents inside each other."""
BITS: Final = 10_000
"""The most bits of a number, written or computed."""

Span = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Number:
    """An exact number, times i if `imaginary`."""

    span: Span
    value: Fraction
    imaginary: bool


@dataclass(frozen=True, slots=True)
class Name:
    """A name that isn't called."""

    span: Span
    name: str


@dataclass(frozen=True, slots=True)
class Call:
    """`name(arguments)`."""

    span: Span
    name: str
    arguments: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Sum:
    """Terms, each added (True) or subtracted (False); a sign in front is a sum of one term."""

    span: Span
    terms: tuple[Node, ...]
    added: tuple[bool, ...]


@dataclass(frozen=True, slots=True)
class Product:
    """Factors, each multiplied by (True) or divided by (False)."""

    span: Span
    factors: tuple[Node, ...]
    multiplied: tuple[bool, ...]


@dataclass(frozen=True, slots=True)
class Power:
    """`base**exponent`."""

    span: Span
    base: Node
    exponent: Node


Node = Number | Name | Call | Sum | Product | Power


def children(node: Node) -> tuple[Node, ...]:
    """The parts of a node, in the order in which they are written."""
    if isinstance(node, Sum):
        return node.terms
    if isinstance(node, Product):
        return node.factors
    if isinstance(node, Power):
        return (node.base, node.exponent)
    return node.arguments if isinstance(node, Call) else ()


def parse(text: str) -> Node:
    """The tree of a formula.

    **Raises:** `InputError` with the column where the text leaves the language, or if it is too long or too deep.
    """
    parser = _Parser(text)
    node = parser.expression(0)
    token = parser.token
    if token.kind != "end":
        if token.text in RELATIONS:
            raise InputError(f"a comparison has no place here: {token.text!r} {place(text, token.start)}")
        raise InputError(parser.unexpected(token))
    return node


def parse_relation(text: str) -> tuple[tuple[Node, ...], tuple[str, ...]]:
    """The sides and signs of a chain of comparisons, as `0 < theta < pi`.

    **Raises:** `InputError` as `parse` does, and if there is no comparison.
    """
    parser = _Parser(text)
    sides, signs = [parser.expression(0)], list[str]()
    while parser.token.text in RELATIONS:
        signs.append(parser.advance().text)
        sides.append(parser.expression(0))
    if parser.token.kind != "end":
        raise InputError(parser.unexpected(parser.token))
    if not signs:
        raise InputError("an inequality is expected: two expressions with one of < <= > >= != between them")
    return tuple(sides), tuple(signs)


_SUM, _PRODUCT, _SIGN, _POWER = 1, 2, 3, 4
_BINDING: Final = {"+": _SUM, "-": _SUM, "*": _PRODUCT, "/": _PRODUCT, "**": _POWER}


class _Parser:
    """One pass over the tokens by precedence climbing."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.tokens = tokens(text)
        self.index = 0
        self.depth = 0

    @property
    def token(self) -> Token:
        return self.tokens[self.index]

    def advance(self) -> Token:
        token = self.tokens[self.index]
        self.index += 1
        return token

    def unexpected(self, token: Token) -> str:
        if token.kind == "end":
            return "the formula is empty" if self.index == 0 else "the formula ends too early"
        where = place(self.text, token.start)
        before = self.tokens[self.index - 1] if self.index else None
        adjacent = before is not None and (before.kind in ("number", "name") or before.text == ")")
        if adjacent and (token.kind in ("number", "name") or token.text == "("):
            said = f"an operator is missing before {token.text[:40]!r} {where}: write a product with *"
            return said + self._call_meant(token)
        return f"{token.text[:40]!r} {where} is not expected there"

    def _call_meant(self, token: Token) -> str:
        """Advice where a function may be meant: `sin x`, or `sin**2(x)`."""
        before = self.tokens[max(0, self.index - 3) : self.index]
        if before[-1].kind == "name" and token.kind in ("number", "name"):
            return f", a function's argument in parentheses, as in {before[-1].text[:40]}({token.text[:40]})"
        if (
            [each.kind for each in before] == ["name", "sign", "number"]
            and before[1].text == "**"
            and token.text == "("
        ):
            return f", a power of a function behind it, as in {before[0].text[:40]}(...)**{before[2].text[:40]}"
        return ""

    def deeper(self, token: Token) -> None:
        self.depth += 1
        if self.depth > DEEPEST:
            where = place(self.text, token.start)
            raise InputError(f"nested more than {DEEPEST} levels deep {where}: use [definitions]")

    def expect(self, sign: str) -> Token:
        if self.token.text != sign:
            missing = f"{sign!r} is missing"
            raise InputError(missing if self.token.kind == "end" else f"{missing}: {self.unexpected(self.token)}")
        return self.advance()

    def expression(self, floor: int) -> Node:
        """Everything from here on that binds at least as tightly as `floor`."""
        left = self.operand()
        while True:
            binding = _BINDING.get(self.token.text, 0)
            if not binding or binding < floor:
                return left
            if binding == _POWER:
                self.deeper(self.advance())
                right = self.expression(_POWER)
                self.depth -= 1
                left = Power((left.span[0], right.span[1]), left, right)
                continue
            parts, straight = [left], [True]
            while _BINDING.get(self.token.text) == binding:
                straight.append(self.advance().text in "+*")
                parts.append(self.expression(binding + 1))
            span = (left.span[0], parts[-1].span[1])
            make = Sum if binding == _SUM else Product
            left = make(span, tuple(parts), tuple(straight))

    def operand(self) -> Node:
        token = self.token
        if token.text in ("+", "-"):
            self.deeper(self.advance())
            inner = self.expression(_SIGN)
            self.depth -= 1
            return Sum((token.start, inner.span[1]), (inner,), (token.text == "+",))
        if token.kind == "number":
            return self.number()
        if token.kind == "name":
            self.advance()
            if self.token.text == "(":
                return self.call(token)
            return Name((token.start, token.end), token.text)
        if token.text == "(":
            self.deeper(self.advance())
            inner = self.expression(0)
            self.depth -= 1
            return replace(inner, span=(token.start, self.expect(")").end))
        raise InputError(self.unexpected(token))

    def call(self, name: Token) -> Call:
        self.deeper(self.advance())
        if self.token.text == ")":
            raise InputError(f"{name.text!r} {place(self.text, name.start)} is called without an argument")
        arguments = [self.expression(0)]
        while self.token.text == ",":
            self.advance()
            arguments.append(self.expression(0))
        self.depth -= 1
        return Call((name.start, self.expect(")").end), name.text, tuple(arguments))

    def number(self) -> Number:
        token = self.advance()
        follower = self.token
        imaginary = follower.text == "j" and follower.start == token.end
        if imaginary:
            self.advance()
        elif follower.kind == "name" and follower.start == token.end:
            raise InputError(self._glued(token, follower))
        return Number((token.start, follower.end if imaginary else token.end), self.exact(token), imaginary)

    def _glued(self, number: Token, name: Token) -> str:
        both, where = (number.text + name.text)[:40], place(self.text, number.start)
        if name.text.strip("_").isdigit() or number.text == "0":
            return f"{both!r} {where} is not a number of the language: write plain decimal digits"
        return f"an operator is missing in {both!r} {where}: write {number.text[:20]}*{name.text[:20]}"

    def exact(self, token: Token) -> Fraction:
        """The number as it is written, never through a float; its size is known before it is computed."""
        mantissa, _, power = token.text.replace("E", "e").partition("e")
        digits = len(mantissa) + (abs(int(power)) if 0 < len(power) <= 6 else 0)
        if len(power) > 6 or digits * 3.33 > BITS:
            raise InputError(f"the number {place(self.text, token.start)} has more than {BITS} bits")
        return Fraction(token.text)
