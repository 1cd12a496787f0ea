"""A sign that a rule concludes is the sign at every point of the region: of polynomials drawn by chance.

Each rule is asked by itself, so that none stands in another's light. The region's points are a sample that goes near
its edges; there each generator of the tower is a floating point number.
"""

import math
import random
from collections import Counter
from collections.abc import Iterator
from fractions import Fraction

import pytest
import sympy as sp

from canon.decide import sign_intervals, sign_rules, sign_sums, signs
from canon.decide.tape import Tape
from canon.decide.tower import Tower
from properties.towers import tower_of

x, y, t, s = sp.symbols("x y t s", real=True)
a, b = sp.symbols("a b", positive=True)
u, d, n = sp.Symbol("u", nonnegative=True), sp.Symbol("d", negative=True), sp.Symbol("n", nonpositive=True)
NAMES = (x, y, t, s, a, b, u, d, n)
FORMULA = (
    sp.sin(x) + sp.sqrt(1 + x**2) + sp.sqrt(a) + sp.sqrt(a * b) * sp.exp(y) + sp.exp(-a) + sp.log(b) + sp.pi * t * s
    + u * d * n * sp.sin(t)
)  # fmt: skip
CONDITIONS = (t, 2 - t, s + 1, sp.pi - s, b - a * x, x + 3 * y + 2, a + y - 2 * x)
RULES = (
    signs.sign_of, signs.sign_at_sight, sign_intervals.affine_sign, sign_intervals.sign_on_orthant,
    sign_intervals.sign_by_real_roots, sign_sums.by_even_powers, sign_sums.by_known_forms, sign_rules._bounded_pair,
    sign_rules._against_wave, sign_rules._against_one, sign_rules._quadratic, sign_rules._against_root,
    sign_rules.constant_sign, sign_rules.sign_of_product,
)  # fmt: skip
ALLOWED = {
    "pos": lambda v: v > -1e-9, "neg": lambda v: v < 1e-9, "nonneg": lambda v: v > -1e-9, "nonpos": lambda v: v < 1e-9
}  # fmt: skip


def points(rng: random.Random, count: int) -> Iterator[dict[sp.Symbol, float]]:
    """Points where the conditions hold, some of them near the ends of intervals."""
    lambdas = [sp.lambdify(NAMES, c, "math") for c in CONDITIONS]
    while count:
        size = rng.choice((0.02, 1.0, 3.0, 12.0))
        place = [rng.uniform(-size, size), rng.uniform(-size, size), rng.choice((0.003, 1.997, rng.uniform(0, 2)))]
        place += [rng.choice((-0.997, 3.14, rng.uniform(-1, 3.14)))]
        place += [rng.uniform(0, size) for _ in range(3)] + [-rng.uniform(0, size) for _ in range(2)]
        if all(c(*place) > 1e-6 for c in lambdas):
            count -= 1
            yield dict(zip(NAMES, place, strict=True))


def values(tower: Tower, point: dict[sp.Symbol, float]) -> list[float]:
    """What each generator is there."""
    out: list[float] = []
    for made in tower.generators:
        if made.kind == "symbol":
            out.append(point[tower.tape.symbol_at(made.data)])
        elif made.kind == "pi":
            out.append(math.pi)
        elif made.kind == "root":
            _, radicand, prime, height = made.data
            out.append(number(tower, radicand, out) ** (1 / prime**height))
        elif made.kind == "log":
            out.append(math.log(number(tower, made.data[1], out)))
        else:
            inside = number(tower, made.data[0], out)
            assert not made.data[1]
            out.append({"cos": math.cos, "sin": math.sin, "exp": math.exp}[made.kind](inside))
    return out


def number(tower: Tower, p, of: list[float]) -> float:
    return sum(float(c) * math.prod(of[k] ** e for k, e in enumerate(m) if e) for m, c in tower.ring.terms(p).items())


@pytest.fixture(scope="module")
def tower() -> Tower:
    tape = Tape()
    return tower_of(tape, tape.load(FORMULA), [tape.load(c) for c in CONDITIONS])


@pytest.fixture(scope="module")
def places(tower: Tower) -> list[list[float]]:
    return [values(tower, point) for point in points(random.Random(5), 40)]


def form(tower: Tower, rng: random.Random):
    """A polynomial of few terms that may well have a sign: squares, linear forms, conditions, pairs of terms."""
    ring, size = tower.ring, len(tower.generators)
    few = [ring.generators[k] for k in rng.sample(range(size), rng.choice((1, 2, 2, 3)))]
    number = lambda: ring.constant(Fraction(rng.choice((1, 1, 2, 3, 4, -1, -2)), rng.choice((1, 1, 2))))  # noqa: E731
    kind, g = rng.randrange(6), rng.choice(few)
    total = number() if rng.random() < 0.8 else ring.zero
    if kind == 0:
        return total + sum((number() * h for h in few), ring.zero)
    if kind == 1:
        return total + sum((number() * h ** rng.choice((2, 2, 4, 1, 3)) for h in few), ring.zero)
    if kind == 2:
        return total + number() * g + number() * g**2 * rng.choice(few) ** rng.choice((0, 0, 1, 2))
    if kind == 3:
        facts = [f for f, sign in tower.facts if sign == "pos" and len(f) > 1]
        return sum((number() * rng.choice(facts) for _ in range(2)), total * few[0] ** rng.choice((0, 1, 2)))
    if kind == 4:
        return total * rng.choice((ring.one, g)) + number() * rng.choice(few) * few[0] ** rng.choice((0, 1, 2))
    return (total + number() * g) ** 2 * rng.choice(few) + number() * rng.choice(few) ** 2 * rng.choice((0, 1))


@pytest.mark.parametrize("seed", range(4))
def test_signs_are_those_of_the_values(tower: Tower, places: list[list[float]], seed: int):
    rng, found = random.Random(seed), Counter[str]()
    for _ in range(100):
        p = form(tower, rng)
        if not p or p.is_constant():
            continue
        of = [number(tower, p, place) for place in places]
        scale = 1 + max(map(abs, of))
        for rule in RULES:
            sign = rule(tower, p)
            if sign is not None:
                found[rule.__name__] += 1
                assert all(ALLOWED[sign](v / scale) for v in of), (rule.__name__, str(p), sign)
    assert len(found) > len(RULES) - 5, found


def test_signs_that_are_known(tower: Tower):
    """Each rule sees the sign of a polynomial that it is made for, and of no other near it."""
    tape, ring = tower.tape, tower.ring
    of = {made.data: ring.generators[made.index] for made in tower.generators if made.kind == "symbol"}
    X, Y, T, S, A, B, U, D, N = (of[tape.symbol(name)] for name in NAMES)
    pi = next(ring.generators[made.index] for made in tower.generators if made.kind == "pi")
    cases = [
        (signs.sign_at_sight, A * N + D, "neg", A * N - D),
        (signs.sign_at_sight, N * U * A - B * N**2, "nonpos", N * U * A + B * N**2),
        (sign_sums.by_even_powers, X**2 + A * Y**4 + 1, "pos", X**3 + A * Y**4 + 1),
        (sign_sums.by_even_powers, X**2 + A * Y**2, "nonneg", X**2 - A * Y**2),
        (sign_sums.by_even_powers, A**2 + X**2, "pos", A**2 + X**3),
        (sign_sums.by_known_forms, 2 * B - 2 * A * X + U, "pos", 2 * B - 3 * A * X + U),
        (sign_sums.by_known_forms, B - A * X + X + 3 * Y + 2, "pos", B + A * X + X + 3 * Y + 2),
        (sign_intervals.affine_sign, 2 - T, "pos", ring.constant(Fraction(199, 100)) - T),
        (sign_intervals.affine_sign, S - pi, "neg", S - pi * ring.constant(Fraction(99, 100))),
        (sign_intervals.affine_sign, 3 * S + 3, "pos", 3 * S + 2),
        (sign_intervals.sign_on_orthant, T * A - 2 * A - B, "neg", T * A - A - B),
        (sign_intervals.sign_on_orthant, 4 - T**2, "pos", 3 - T**2),
        (sign_intervals.sign_by_real_roots, T**3 - 9 * T + 11, "pos", T**3 - 9 * T + 10),
        (sign_intervals.sign_by_real_roots, -(X**4) - X - 1, "neg", -(X**4) - 2 * X - 1),
    ]
    for rule, known, sign, other in cases:
        assert rule(tower, known) == sign, (rule.__name__, str(known))
        assert rule(tower, -known) == signs.OPPOSITE[sign]
        assert rule(tower, other) is None, (rule.__name__, str(other))
