"""What the tower makes of a formula has its value: at points of the region, branch by branch, and whatever is known.

Every kernel, every relation between generators and every sign that is concluded is compared with Arb's balls of the
formula as it is written.
"""

from fractions import Fraction
from itertools import product

import pytest
import sympy as sp

from canon.decide.squares import hidden_square
from canon.decide.tape import Tape
from canon.special import EllipticPi, JacobiCN, JacobiDN, JacobiSN
from properties.towers import disagreement, tower_of

x, y = sp.symbols("x y", real=True)
a, b = sp.symbols("a b", positive=True)
u, v = sp.symbols("u v", nonnegative=True)
d = sp.Symbol("d", negative=True)
w, z = sp.symbols("w z")
k = sp.Symbol("k", integer=True)
pi, sqrt, sin, cos, exp, log, atan, asin, acos, atan2 = (
    sp.pi, sp.sqrt, sp.sin, sp.cos, sp.exp, sp.log, sp.atan, sp.asin, sp.acos, sp.atan2,
)  # fmt: skip
THIRD, HALF = sp.Rational(1, 3), sp.Rational(1, 2)

PLACES: dict[sp.Symbol, tuple] = {
    x: ("-7/3", "-1/5", "2/7", "5/2"), y: ("-3/2", "1/9", "4/3"), a: ("1/7", "8/5", "3"), b: ("2/3", "9/4"),
    u: ("0", "5/4"), v: ("1/3", "7/2"), d: ("-1/4", "-11/5"), k: ("-3", "0", "4"),
    w: (("-1/3", "2/5"), ("3/2", "-7/4"), ("-2", "0")), z: (("5/3", "1/2"), ("0", "-3/4")),
}  # fmt: skip

CASES: list[tuple[sp.Expr, ...]] = [  # a formula, and conditions that are known to be positive
    (sqrt(x**2 * y) + sqrt(4 * a) + sqrt(a * b) * sqrt(b) + sqrt(x**2 * a / b**3),),
    (sqrt(x * y) + sqrt(x / y) * y,),
    (sqrt(-x * y) + log(-(x**3) * y),),
    (sqrt(-x) + sqrt(1 - x) * sqrt(1 - x**2) + sqrt((1 - x) / (1 + x)),),
    (sqrt(x**2 - 2 * x * y + y**2) + sqrt((x - y) ** 2 / (x + y) ** 4) + (a * (x - y) ** 4) ** (3 * HALF / 2),),
    (a**THIRD + (a * b) ** (-2 * THIRD) + a ** sp.Rational(5, 6) * b ** sp.Rational(-7, 4) + (8 * a**3) ** THIRD,),
    ((x * y) ** THIRD + (x**2 * y**2) ** THIRD + (x * y) ** sp.Rational(-5, 4), x * y),
    (sp.expand(x**4 * (y + 2) ** 2) ** (HALF / 2) + log(sp.expand(x**4 * (y + 2) ** 2)),),
    (sqrt(x - 1) * sqrt(x + 1) + sqrt(x**2 - 1) + (x**2 - 1) ** THIRD * (x + 1) ** THIRD * (x - 1) ** THIRD,),
    (sqrt(a + sqrt(a)) + sqrt(sqrt(a)) + sqrt(sqrt(a) * b) + (sqrt(a) + 1) ** THIRD,),
    (sqrt(x + 5 - 2 * sqrt(x + 4)) + sqrt(x + 5 + 2 * sqrt(x + 4)),),
    (sqrt(1 - cos(x) ** 2) + sqrt(1 - 2 * sin(x) * cos(x)) + sqrt(2 + 2 * cos(x)) + sqrt(1 + sin(2 * x)),),
    (sqrt(3 - 3 * cos(x) ** 2) + sqrt(4 * y + 20 - 8 * sqrt(y + 4)) + 1 / sqrt(2 - 4 * sin(x) * cos(x)),),
    (sqrt(1 + cos(x)) + sqrt(1 - cos(x)) + sqrt(1 + sin(y)) + sqrt(1 - sin(y)) + sqrt(1 - sin(y)) ** 3,),
    ((sqrt(x**6 + 1) + 1) ** THIRD + (sqrt(x**6 + 1) - 1) ** THIRD + (sqrt(8 * x**6 + 1) + 1) ** (-THIRD),),
    ((sqrt(8 * x**6 + 1) + 1) ** THIRD + (sqrt(8 * x**6 + 1) - 1) ** THIRD + (1 / (x * y)) ** (2 * THIRD),),
    (sqrt(6) + sqrt(2) * sqrt(3) - 12 ** sp.Rational(2, 3) + sp.Rational(5, 7) ** sp.Rational(3, 4),),
    (sqrt(3 - 2 * sqrt(2)) + (2 + sqrt(5)) ** THIRD + sqrt(2 - sqrt(3)),),
    (sp.Abs(x) + sp.Abs(x * y) - sp.Abs(d) + sp.Abs(d * x**3 / y) + sp.Abs(1 + x**2) + sp.Abs(x - y) ** 3,),
    (sp.Abs(sin(x)) + sp.sign(y) * sp.Abs(y - 7) + sp.sign(d) + sp.sign(a + b),),
    (sp.Abs(w) + sp.Abs(w * a) + sp.Abs(3 * sp.I * w) ** 2,),
    (sqrt(w) + sqrt(w**2) + sqrt(w * z) + (w / z) ** THIRD + (w**2 - 1) ** (-THIRD),),
    (log(w) + log(w * z) + log(w / z) + log(w**2),),
    (log(a * b) + log(a**3 / b) + log(x**2) + log(x**4 * y**2) + log(x * y) + log(12) - log(sp.Rational(9, 8)),),
    (log(-d) + log(-x * a) + log(sqrt(a) * b**2) + log(exp(x) * a) + log(a + b) + log(a**2 - b**2),),
    (log(1 - x**2) + log((1 - x) / (1 + x)) + log(2 - x - y),),
    (log(-((x - y) ** 3)) + log((x + 2 * y) ** 2 / (y - x) ** 2),),
    (exp(x + log(a)) + exp(2 * log(a) / 3 - y) + exp(x * log(a)) + exp(-x / 2) * exp(THIRD * x + y),),
    (exp(x) ** 2 - exp(2 * x + 1) + sqrt(exp(x)) + exp(x / 5) ** THIRD + log(exp(x) + 1),),
    (exp(sp.I * x) + exp(x + sp.I * y) + exp(sp.I * pi / 7) + exp(-3 * sp.I * (x + y) / 2),),
    (exp(w) + exp(w / 2 + x) + exp(-2 * w + sp.I * x),),
    (exp(HALF * log(w)) + exp(log(w * z)),),
    (sp.sinh(x) + sp.cosh(2 * x) * sp.tanh(y / 3),),
    (exp(sp.LambertW(a)) + sp.LambertW(a * exp(a)) + sp.LambertW(x * exp(x)) + sp.LambertW(2 * b * exp(2 * b)), 1 + x),
    (sin(x + y) + cos(2 * x - 3 * y) + sin(x / 2) * cos(y / 3) + cos(5 * x / 6),),
    (sp.tan(x) + sp.cot(2 * x + 1) + 1 / cos(x / 3 - pi / 4),),
    (sin(x + pi / 3) + cos(x - 7 * pi / 12) + sin(5 * pi / 4) + sin(pi / 7) * cos(3 * pi / 14) + cos(pi / 5),),
    (cos(pi * k) + sin(pi * k + x) + cos(2 * pi * k / 3) + cos(pi * k * (k + 2) - y),),
    (cos(atan(x)) + sin(2 * atan(x)) + cos(atan(x) / 2 + y) + sin(asin(x / 3)) + cos(3 * asin(x / 3) - acos(y / 2)),),
    (cos(acos(y / 2) / 2) + sin(acos(y / 2)) + sin(atan2(x, y) / 2) + cos(atan2(y, x) - 2 * atan2(a, x)),),
    (cos(w) + sin(w + x) + sin(2 * w) * cos(w / 2),),
    (sin(x / a) + cos(2 * x / a + y / (a + b)) + sin((x**2 + x * a) / a),),
    (atan(-x) + asin(-x / 3) + acos(-x / 3) + atan(a) + atan(x**2 + 1) - atan(d * a),),
    (log(acos(x / 3)) + sqrt(atan(a) * b) + log(asin(a / (a + 1))),),
    (sp.gamma(a + 3) + sp.gamma(a) + sp.gamma(b + HALF) + sp.gamma(a - 2) + sp.gamma(2 * THIRD) + sp.gamma(5 * HALF),),
    (sp.gamma(1 - x) + sp.gamma(x) + sp.gamma(2 * b) - sp.gamma(2 * x + 1) + sp.gamma(4 * b - 2),),
    (sp.elliptic_k(x) + sp.elliptic_k(x / (x - 1)) + sp.elliptic_e(x / (x - 1)) + sp.elliptic_e(x),),
    (sp.elliptic_e(a / (a + 1)) + sp.elliptic_e(1 / (a + 1)) + sp.elliptic_k(a / (a + 1)),),
    (EllipticPi(0, x) + EllipticPi(x, x) + EllipticPi(-a, x) + EllipticPi(a / (1 + a), x / (x - 1)),),
    (sqrt(1 - sqrt(2) * sin(x) + sin(x) ** 2) + sqrt(exp(2 * x) - 2 * exp(x) * y + y**2),),
    (1 / (sqrt(a) - sqrt(b)) + 1 / (sqrt(a + 1) + sqrt(a)) ** 2 + sqrt(1 / (sqrt(a + 1) - sqrt(a))),),
    (1 / (1 + sp.I * x) + (x + sp.I * y) ** -3 + sqrt(x + sp.I) + log(1 + sp.I * y) + log((x + sp.I) * (y - sp.I)),),
    (sqrt(cos(x)) + log(sin(x)) + sqrt(1 - cos(x)) + sp.Abs(1 + sin(y)), x, pi - x),
    (sqrt((1 - x) ** 2) + sqrt((x - 2) ** 2) + sqrt((2 * x - 1) ** 2 * a), 1 - x, 2 - x),
    (sqrt((2 * a - b * a) ** 2) + sp.Abs(3 - x * y) + sp.Abs(a**2 + a - 12), 2 - b, 3 - x * y, 3 - a),
    (sp.Abs(u + v) + sqrt(u * v) + sp.Abs(1 - exp(-a)) + sp.Abs(exp(d) - 1) + sp.Abs(sqrt(1 + u) - 1 + v),),
    (sp.Abs(sqrt(1 + x**2) - x) + sp.Abs(x - sqrt(x**2 + 1)) + sp.Abs(a - sqrt(a**2 + b)),),
    (sp.Abs(x + 2 * sqrt(x**2 + 2)) + sp.Abs(a * x - sqrt(a**2 * x**2 + b)),),
    (sp.Abs(2 + cos(x)) + sp.Abs(sin(x) - a - 1) + sp.Abs(1 + a**2 - 2 * a * cos(x)) + sp.Abs(x**2 + x + 1),),
    (sp.Abs(a + b * cos(x)) + sp.Abs(a * sin(x) - b) + sp.Abs(a * b - 3 * sin(y)) + sp.Abs(cos(y) - 1 + a),),
    (sp.Abs(x**2 - 4 * x + 5) + sp.Abs(-(x**2) + x - 1) + sp.Abs(x**2 + 2 * x + 1) + sp.Abs(x**4 + y**2 + a),),
    (sp.Abs(x**3 - 4 * x + 7) + sp.Abs(x - pi) + sp.Abs(x**2 - 2) + sp.Abs(x * y - 1), x - 2, 2 - y, y - 1),
    (sp.Abs(sqrt(2) - sp.Rational(7, 5)) + sp.Abs(sqrt(3) - 7 * pi / 4) + sp.Abs(pi - sp.Rational(22, 7)),),
]  # fmt: skip


CASES += [  # what sympy would write in another way before it is seen
    (log((1 + sp.I) * (1 - sp.I) * x) + log((2 + sp.I) * (sp.I - 2) * y) + sqrt((1 + sp.I) * (sp.I - 1) * x * y),),
    (sp.Pow(exp(x), HALF, evaluate=False) + sp.Pow(exp(x) ** 2, THIRD, evaluate=False),),
    (exp(2 * log(w * z) + x, evaluate=False) + exp(log(w * z) / 2, evaluate=False),),
    (exp(log(x * y) / 2 + x, evaluate=False) + exp(3 * log(x * y**3), evaluate=False),),
    (exp(log(a**2 * b) / 3 - y, evaluate=False) + log(exp(x) * a, evaluate=False),),
    (sp.Pow(x**2, HALF, evaluate=False) + sp.Pow(4 * x**2 * y**4, THIRD / 2, evaluate=False),),
    (sp.Pow(x**2 / y**2, HALF, evaluate=False) + sp.Pow(x**-2 * (y + 1) ** -4, HALF / 2, evaluate=False),),
]


LONG = x + 3 * y + x**2 * y + x * y**2 / 3 + x**3 / 5 + y**3 / 7 + x**3 * y**2 / 2
OTHER = x + 2 * y + 5 * x**2 * y + x * y**2 / 2 + x**3 / 4 + y**3 / 9 + x**2 * y**3 / 3

CASES += [  # what has no sign, though something like it has
    (
        sp.Abs(sin(x * y)) + sp.Abs(sin(x**2)) + sp.Abs(sin(x + y)) + sp.Abs(sin(5 * pi**2 * x / 13)),
        x,
        sp.Rational(13, 5) - x,
    ),
    (sp.Abs(LONG) + sqrt(LONG**2 * a) + log(OTHER**2), LONG * OTHER),
    (sqrt(y + 5 - 2 * (y + 4) ** THIRD) + sqrt(x + 5 - 2 * (x + 4) ** (HALF / 2)),),
    (sqrt(a * (1 - HALF * JacobiSN(x, HALF) ** 2)) + sqrt((1 - JacobiSN(x, HALF) ** 2) * b) + JacobiDN(x, HALF),),
    (JacobiSN(x, HALF) + JacobiCN(9 * x, HALF) * JacobiDN(x / 2, HALF) + JacobiSN(-3 * x, HALF),),
    (JacobiSN(x, -a) * JacobiCN(y, -a) + JacobiDN(x + 2 * y, -a) + sqrt(1 - a * JacobiSN(y, a) ** 2),),
    (sp.Abs(JacobiDN(x, a / d)) + sqrt(1 - a / d * JacobiSN(x, a / d) ** 2) + JacobiDN(x, a / (1 + a)) ** 3,),
    (sqrt(x * (1 - HALF * JacobiSN(y, HALF) ** 2)) + sqrt((y - x) * (1 - JacobiSN(x, HALF) ** 2)),),
    (sp.Abs(x**3 + a**2) + sp.Abs(x * y + a**2) + sp.Abs(a**2 * x**2 + y) + sp.Abs(u * x**2 + v * y),),
]


def at(value: str | tuple[str, str]) -> Fraction | tuple[Fraction, ...]:
    return tuple(map(Fraction, value)) if isinstance(value, tuple) else Fraction(value)


@pytest.mark.parametrize("case", CASES, ids=lambda case: str(case[0])[:60])
def test_the_tower_says_what_is_written(case: tuple[sp.Expr, ...]):
    formula, *positive = case
    tape = Tape()
    node, conditions = tape.load(formula), [tape.load(c) for c in positive]
    tower = tower_of(tape, node, conditions)
    names = sorted(set().union(*(f.free_symbols for f in case)), key=str)
    points = [dict(zip(names, place, strict=True)) for place in product(*(PLACES[name] for name in names))]
    found = [disagreement(tower, conditions, {tape.symbol(s): at(v) for s, v in point.items()}) for point in points]
    assert any(said is not None for said in found)
    assert not any(found), next(filter(None, found))


def test_a_denominator_that_is_a_number():
    """It comes of a power of a root of a number: (1/2**(1/3))³."""
    tape = Tape()
    name = tape.symbol(x)
    below = tape.root(tape.number(2), Fraction(1, 3))
    inside = tape.plus(tape.times(tape.constant("I"), name), tape.power(below, -1))
    tower = tower_of(tape, tape.sqrt(tape.power(inside, 3)), [])
    assert disagreement(tower, [], {name: Fraction(3, 7)}) == ""


def test_a_hidden_square_is_one():
    """c · b² is what it was made from, by the relations; of what is no square, none is found."""
    tape = Tape()
    formula = JacobiDN(x, HALF) + JacobiCN(x, HALF) + sin(y) + sqrt(y + 4) + b * cos(y)
    tower = tower_of(tape, tape.load(formula), [])
    field, ring = tower.field, tower.ring
    g = {made.kind: ring.generators[made.index] for made in tower.generators if made.kind != "symbol"}
    symbols = {made.data: ring.generators[made.index] for made in tower.generators if made.kind == "symbol"}
    X, Y, B = (symbols[tape.symbol(name)] for name in (x, y, b))
    lowers = [made.lower for made in tower.generators if made.kind.startswith("jacobi_") and made.degree]
    squares = [lower * factor for lower in lowers for factor in (ring.one, B**2, (X - Y) ** 2 * 3)]
    squares += [1 - g["cos"] ** 2, 1 - 2 * g["sin"] * g["cos"], Y + 5 - 2 * g["root"], (Y + 5 + 2 * g["root"]) * B**2]
    others = [lower * factor for lower in lowers for factor in (B, X, (X - Y) ** 2 * B, -(B**2))]
    others += [2 - g["cos"] ** 2, 1 - g["sin"] * g["cos"], Y + 4 - 2 * g["root"], 1 - g["cos"], (1 - g["cos"] ** 2) * Y]
    for p in squares:
        found = hidden_square(tower, (p * ring.one, {}))
        assert found is not None, str(p)
        assert found[0] > 0
        square = field.product([field.power(found[1], 2), field.constant(found[0])])
        assert field.equal(square, (p * ring.one, {})), str(p)
    for p in others:
        assert hidden_square(tower, (p * ring.one, {})) is None, str(p)
