"""What sympy makes of a formula at construction agrees with the principal values of what was written."""

import random

import mpmath
import pytest
import sympy as sp

from canon.errors import InputError
from canon.expression import Vocabulary, read
from canon.syntax import Name, Node, Number, Power, Product, Sum, parse

SYMBOLS = (
    sp.Symbol("x", real=True),
    sp.Symbol("y", real=True),
    sp.Symbol("a", positive=True),
    sp.Symbol("b", negative=True),
    sp.Symbol("c", nonnegative=True),
    sp.Symbol("n", integer=True),
    sp.Symbol("z", complex=True),
)
WORDS = Vocabulary({symbol.name: symbol for symbol in SYMBOLS})
FUNCTIONS = (
    "sqrt", "cbrt", "exp", "log", "sin", "cos", "tan", "cot", "sec", "csc", "asin", "acos", "atan", "sinh", "cosh",
    "tanh", "coth", "asinh", "acosh", "atanh", "abs", "sign", "gamma",
)  # fmt: skip
POLES = {"tan": "cos", "sec": "cos", "cot": "sin", "csc": "sin", "coth": "sinh", "tanh": "cosh"}
TINY = mpmath.mpf(10) ** -20


class OutsideError(Exception):
    """The point is outside of the formula's domain, or the value too large to compare."""


def off_the_cut(value):
    if abs(mpmath.im(value)) < TINY and mpmath.re(value) <= TINY:
        raise OutsideError
    return value


def power(base, exponent):
    if mpmath.im(exponent) == 0 and mpmath.re(exponent) == mpmath.floor(mpmath.re(exponent)):
        whole = int(mpmath.re(exponent))
        if abs(whole) > 100 or (whole < 0 and abs(base) < TINY):
            raise OutsideError
        return base**whole
    return mpmath.exp(exponent * mpmath.log(off_the_cut(base)))


def function(name, u):
    if name in ("sqrt", "cbrt"):
        return power(u, mpmath.mpf(1) / (2 if name == "sqrt" else 3))
    if name in ("abs", "sign"):
        if abs(u) < TINY or (name == "sign" and mpmath.im(u)):
            raise OutsideError
        return abs(u) if name == "abs" else mpmath.sign(mpmath.re(u))
    inside = {"log": u, "asin": 1 - u * u, "acos": 1 - u * u, "atanh": 1 - u * u, "acosh": u - 1}
    if name in inside:
        off_the_cut(inside[name])
    if name in ("atan", "asinh"):
        off_the_cut(1 + u * u)
    near_pole = name in POLES and abs(getattr(mpmath, POLES[name])(u)) < TINY
    at_pole = name == "gamma" and mpmath.re(u) <= 0 and abs(u - mpmath.nint(mpmath.re(u))) < TINY
    if abs(u) > 1000 or near_pole or at_pole:
        raise OutsideError
    return getattr(mpmath, name)(u)


def value(node: Node, point):
    """The principal value of a formula, subexpression by subexpression."""
    if isinstance(node, Number):
        number = mpmath.mpf(node.value.numerator) / node.value.denominator
        return mpmath.mpc(0, number) if node.imaginary else number
    if isinstance(node, Name):
        return +mpmath.pi if node.name == "pi" else point[node.name]
    if isinstance(node, Sum):
        terms = [value(term, point) for term in node.terms]
        return sum(t if plus else -t for t, plus in zip(terms, node.added, strict=True))
    if isinstance(node, Product):
        result = mpmath.mpf(1)
        for factor, up in zip(node.factors, node.multiplied, strict=True):
            number = value(factor, point)
            if not up and abs(number) < TINY:
                raise OutsideError
            result = result * number if up else result / number
        return result
    if isinstance(node, Power):
        return power(value(node.base, point), value(node.exponent, point))
    arguments = [value(argument, point) for argument in node.arguments]
    if node.name == "atan2":
        v, u = arguments
        if mpmath.im(v) or mpmath.im(u) or (abs(v) < TINY and mpmath.re(u) <= TINY):
            raise OutsideError
        return mpmath.atan2(mpmath.re(v), mpmath.re(u))
    return function(node.name, arguments[0])


def constant(chance: random.Random, depth: int) -> str:
    """A formula without names, often with a sign or a root that sympy evaluates."""
    if depth <= 0:
        return chance.choice(
            ["2", "3", "pi", "1/3", "-1", "907894/3", "288865/7", "-10001/10", "350000370081/350000000000"]
        )
    kind = chance.random()
    if kind < 0.3:
        return f"({constant(chance, depth - 1)}){chance.choice('+-*/')}({constant(chance, depth - 1)})"
    if kind < 0.5:
        return f"{chance.choice(['abs', 'sign', 'sqrt', 'log'])}({constant(chance, depth - 1)})"
    return f"{chance.choice(FUNCTIONS)}({constant(chance, depth - 1)})"


def formula(chance: random.Random, depth: int, is_complex: bool) -> str:
    if depth <= 0 or chance.random() < 0.12:
        leaves = ["x", "y", "a", "b", "c", "n", "x", "y", "2", "3", "1/2", "pi", "0.5", "-1"]
        return chance.choice(leaves + ["z", "1j"] * is_complex)

    def part(less: int = 1) -> str:
        return formula(chance, depth - less, is_complex)

    kind = chance.random()
    if kind < 0.2:
        return f"({part()}{chance.choice('+-')}{part()})"
    if kind < 0.45:
        return f"{chance.choice(['', '-'])}({part()}){chance.choice('*/')}({part()})"
    if kind < 0.62:
        return (
            f"({part()})**({chance.choice([part(2), '2', '-1', '1/2', '1/3', '3', '-2', '3/2', 'n', 'x', 'a', '1/4'])})"
        )
    if kind < 0.66:
        return f"atan2({formula(chance, depth - 1, False)},{formula(chance, depth - 1, False)})"
    return f"{chance.choice(FUNCTIONS)}({part()})"


def point(chance: random.Random):
    def between(low: float, high: float):
        return mpmath.mpf(chance.randint(int(low * 997), int(high * 997))) / 997

    return {
        "x": between(-2, 2),
        "y": between(-3, 3),
        "a": between(0.01, 3),
        "b": -between(0.01, 3),
        "c": between(0.01, 2),
        "n": mpmath.mpf(chance.randint(-3, 3)),
        "z": mpmath.mpc(between(-2, 2), between(-2, 2)),
    }


def compared(seed: int, count: int, constants: bool = False) -> int:
    """Read `count` random formulas, or constants, and compare their values; the number of points compared."""
    chance, points = random.Random(seed), 0
    for _ in range(count):
        depth = chance.randint(1, 4)
        text = constant(chance, depth) if constants else formula(chance, depth, chance.random() < 0.35)
        tree = parse(text)
        try:
            expression = read(text, WORDS).expr
        except InputError:
            continue
        compiled = sp.lambdify(SYMBOLS, expression, modules="mpmath")
        for _ in range(3):
            place = point(chance)
            try:
                written = value(tree, place)
                merged = mpmath.mpmathify(compiled(*(place[symbol.name] for symbol in SYMBOLS)))
            except (OutsideError, ArithmeticError, ValueError, AttributeError, TypeError):
                continue
            if not mpmath.isfinite(written) or abs(written) > 1e15:
                continue
            points += 1
            assert abs(written - merged) <= 1e-15 * (1 + abs(written)), f"{text} became {expression} at {place}"
    return points


def test_values_agree():
    with mpmath.workdps(40):
        assert compared(seed=20, count=250) > 400


def test_values_of_constants_agree():
    with mpmath.workdps(60):
        assert compared(seed=21, count=200, constants=True) > 100


@pytest.mark.parametrize(
    "text", ["sign(sec(288865/7))", "sign(acosh(350000370081/350000000000))", "sign(acos(tanh(9)))"]
)
def test_signs_that_two_digits_get_wrong(text):
    assert read(text, WORDS).expr == 1


@pytest.mark.thorough
@pytest.mark.parametrize("seed", range(10))
def test_values_agree_at_length(seed):
    with mpmath.workdps(40):
        assert compared(seed, count=3000) > 5000
    with mpmath.workdps(100):
        assert compared(seed, count=3000, constants=True) > 1000
