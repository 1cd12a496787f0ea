"""Does the tower say what a formula says? Random formulas, compared with Arb's balls at random points.

    python -m properties.towers --cases 10000 --seed 1

The exact decider rests on the tower: every kernel of a formula becomes an element of a field of fractions, by relations
that are to hold on the whole region and on every branch that a formula can take there. Here each kernel's element, each
relation and each sign that is concluded is evaluated at points of the region, and must agree with what is written.
"""

from __future__ import annotations

import argparse
import json
import random
import time
from collections import Counter
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import sympy as sp
from flint import acb, arb

from canon.budget import Budget, BudgetExceeded
from canon.decide.arbitrary import rational
from canon.decide.enclosure import Ball, OutOfDomain, evaluate, precision
from canon.decide.generator_values import GeneratorBalls
from canon.decide.intervals import intervals_of
from canon.decide.region import Region, Requirement
from canon.decide.ring import TooCostly
from canon.decide.signs import sign_of
from canon.decide.tape import Node, Tape, Unsupported
from canon.decide.tower import Tower
from canon.errors import InputError

BITS = 160
REFUSED = (Unsupported, TooCostly, BudgetExceeded, InputError)
SIGNS = {
    "pos": lambda ball: ball > 0,
    "neg": lambda ball: ball < 0,
    "nonneg": lambda ball: not ball < 0,
    "nonpos": lambda ball: not ball > 0,
    "real": lambda ball: isinstance(ball, arb),
    "cplx": lambda _: True,
}


def tower_of(tape: Tape, node: Node, conditions: Sequence[Node], budget: float = 20.0) -> Tower:
    """The tower of a formula where these are positive."""
    region = Region(tuple(Requirement("positive", (c,), "") for c in conditions), (), ())
    return Tower(tape, [node], positive=conditions, intervals=intervals_of(tape, region), budget=Budget(budget))


def disagreement(tower: Tower, conditions: Sequence[Node], point: Mapping[Node, Fraction | tuple]) -> str | None:
    """What the tower says wrongly at a point: "" for nothing; None where the point isn't in the region."""
    tape, targets = tower.tape, [*tower.targets, *conditions]
    with precision(BITS):
        place = {name: _ball(value) for name, value in point.items()}
        try:
            balls = evaluate(tape, tape.reach(targets), place)
        except OutOfDomain:
            return None
        if not all(isinstance(balls[c], arb) and balls[c] > 0 for c in conditions):
            return None
        values = GeneratorBalls(tower, place)
        for made in tower.generators:
            ball = values.generator(made.index)
            if not SIGNS[made.sign](ball):
                return f"{made} is {ball}"
            if made.degree and not _agree(ball**made.degree, values.polynomial(made.lower)):
                return f"the relation of {made}"
        for kernel, element in tower.kernels.items():
            if not _agree(values.element(element), balls[kernel]):
                return f"{tape.to_sympy(kernel)} is {balls[kernel]}, not {values.element(element)}"
        factors = [p for x in tower.kernels.values() for p in tower.parts(x)]
        for p in [known for known, _ in tower.facts] + tower.field.factors + factors:
            sign = sign_of(tower, p) if p else None
            if sign is not None and not SIGNS[sign](values.polynomial(p)):
                return f"{p} isn't {sign}"
    return ""


def _ball(value: Fraction | tuple) -> Ball:
    return acb(*map(rational, value)) if isinstance(value, tuple) else arb(rational(value))


def _agree(found: Ball, expected: Ball) -> bool:
    return bool((found - expected).contains(0))


NAMES = {
    **{name: sp.Symbol(name, real=True) for name in "xyu"}, "a": sp.Symbol("a", positive=True),
    "b": sp.Symbol("b", nonnegative=True), "d": sp.Symbol("d", negative=True), "k": sp.Symbol("k", integer=True),
    "w": sp.Symbol("w"),
}  # fmt: skip
EXPONENTS = [
    Fraction(*e) for e in ((1, 2), (1, 2), (1, 2), (1, 3), (1, 4), (3, 2), (2, 3), (-1, 2), (3, 4), (5, 6), (1, 6))
]
CALLS = ("abs", "abs", "log", "log", "exp", "exp", "sin", "cos", "atan", "asin", "acos")


def _number(rng: random.Random, most: int = 3) -> Fraction:
    return Fraction(rng.choice([n for n in range(-most, most + 1) if n]), rng.choice((1, 1, 1, 2, 3)))


def formula(rng: random.Random, tape: Tape) -> tuple[Node, list[Node], list[sp.Symbol]]:
    """A random formula, conditions on it, and the names in both."""
    chosen = [NAMES[n] for n in rng.sample("xxyyuabd" + ("w" if rng.random() < 0.3 else "x") + "k", rng.randint(2, 4))]
    pool = [tape.symbol(s) for s in dict.fromkeys(chosen)]
    pool += [tape.constant("pi")] * (rng.random() < 0.2) + [tape.constant("I")] * (rng.random() < 0.1)
    leaves = len(pool)
    for _ in range(rng.randint(3, 7)):
        pool.append(_grown(rng, tape, pool))
    node = tape.add([(n, _number(rng)) for n in dict.fromkeys(pool[leaves:])])
    conditions = []
    for _ in range(rng.choice((0, 0, 1, 1, 2, 3))):
        of = rng.choice([p for p in pool if not tape.is_complex(p)] or [tape.one])
        conditions.append(tape.add([(of, rng.choice((1, -1)))], rng.choice((0, 0, 1, 2, -1))))
    conditions = [c for c in conditions if tape.value(c) is None]
    return node, conditions, sorted({s for n in (node, *conditions) for s in tape.symbols_of(n)}, key=str)


def _grown(rng: random.Random, tape: Tape, pool: Sequence[Node]) -> Node:
    def some() -> Node:
        return rng.choice(pool)

    kind = rng.random()
    if kind < 0.25:
        return tape.add([(some(), _number(rng)), (some(), _number(rng))], rng.choice((0, 0, 1, -1, 2)))
    if kind < 0.4:
        return tape.mul([(some(), rng.choice((1, 1, 2, 3, -1, -2))) for _ in range(2)], _number(rng))
    if kind < 0.65:
        even = rng.random() < 0.5
        factors = [
            (some(), rng.choice((2, 4, 2, -2, 6) if even else (1, 1, 3, 2, -1))) for _ in range(rng.randint(1, 3))
        ]
        inside = tape.mul(
            [(tape.add([(n, 1)], rng.choice((0, 0, 1, -2))), e) for n, e in factors], rng.choice((1, 4, 2))
        )
        return tape.root(inside, rng.choice(EXPONENTS)) if rng.random() < 0.7 else tape.call("log", inside)
    name = rng.choice(CALLS)
    if kind < 0.7:
        return tape.call("atan2", some(), some())
    if name in ("exp", "sin", "cos"):
        return tape.call(name, tape.add([(some(), rng.choice((1, 2, -1, Fraction(1, 2), Fraction(2, 3))))], 0))
    return tape.call(name, some())


def tried(seed: int) -> tuple[str, str]:
    """("agrees", "disagrees", or why it isn't known; the case)."""
    rng, tape = random.Random(seed), Tape()
    try:
        node, conditions, names = formula(rng, tape)
        if tape.value(node) is not None:
            return "a number", ""
        tower = tower_of(tape, node, conditions)
        looked = 0
        for _ in range(40):
            point = {tape.symbol(s): _value(rng, s) for s in names}
            found = disagreement(tower, conditions, point)
            if found:
                where = {str(tape.symbol_at(n)): str(v) for n, v in point.items()}
                said = f"{tape.to_sympy(node)}; {[str(tape.to_sympy(c)) for c in conditions]}; {where}: {found}"
                return "disagrees", f"seed {seed}: {said}"
            looked += found is not None
            if looked >= 6:
                break
    except (
        Unsupported,
        TooCostly,
        BudgetExceeded,
        InputError,
        ZeroDivisionError,
        OutOfDomain,
        OverflowError,
    ) as reason:
        return f"{type(reason).__name__}", f"seed {seed}: {reason}"
    return ("agrees" if looked else "no point"), ""


def _value(rng: random.Random, symbol: sp.Symbol) -> Fraction | tuple:
    if symbol.is_integer:
        return Fraction(rng.randint(-4, 4))
    size = Fraction(rng.randint(1, 40), rng.choice((3, 7, 11, 13)))
    if symbol.is_positive or symbol.is_nonnegative:
        return size
    if symbol.is_negative:
        return -size
    if symbol.is_real:
        return size * rng.choice((1, -1))
    return size * rng.choice((1, -1)), Fraction(rng.randint(-30, 30), 7)


def main() -> int:
    """Try cases; what disagrees is printed, and a count of the rest."""
    parser = argparse.ArgumentParser(prog="python -m properties.towers", description=__doc__)
    parser.add_argument("--cases", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    counts: Counter[str] = Counter()
    start = time.process_time()
    for k in range(options.cases):
        state, case = tried(options.seed * 10**7 + k)
        counts[state] += 1
        if state == "disagrees":
            print(case, flush=True)
    result: dict[str, Any] = {**counts, "seconds of a processor": round(time.process_time() - start, 1)}
    print(json.dumps(result))
    return int(counts["disagrees"] > 0)


if __name__ == "__main__":
    raise SystemExit(main())
