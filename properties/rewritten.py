"""Random formulas and what true rules make of them, as identities in a file and of sympy's formulas in Python.

    python -m properties.rewritten --cases 20000 --seed 1

Each case is a pair of trees that are equal by construction wherever both are defined: built from the leaves up, with
the same functions on both sides, and here and there a rule of `properties.rewriting_rules` between them. Some are
spoiled: by another sign or factor, a shifted branch, a rule that holds in part of the domain only. What is true is then
settled by mpmath at points of the domain; canon has no part in it. In Python the formulas are those that sympy makes,
which evaluates them: their domain may be larger than what was written, and a witness out of that isn't judged.
"""

from __future__ import annotations

import argparse
import json
import random
import time
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import mpmath as mp
import sympy as sp
from mpmath.libmp import NoConvergence

from canon import PhaseSpace, identity, verify
from canon.claims.reader import read_text
from canon.errors import InputError
from canon.functions import FUNCTIONS
from properties.rewriting_rules import RULES, D, a, f, m, n, pi, x, y
from properties.soundness import oracle
from properties.soundness.cases import equation_file
from properties.soundness.formula import DIGITS, Formula, Outside, TooLarge, names, of, size
from properties.soundness.identities import REAL, Equation
from properties.soundness.mutants import mutant
from properties.soundness.truth import numbers

BUDGET = 0.25
LARGEST = 60
SEEN = 6
"""The fewest points of the domain at which a claim has been looked at."""
ALIKE = ("sin", "cos", "tan", "cot", "sec", "csc", "exp", "log", "sqrt", "cbrt", "asin", "acos", "atan", "sinh", "cosh",
         "tanh", "coth", "asinh", "acosh", "atanh", "abs", "sign", "gamma", "lambertw", "V")  # fmt: skip
WORDS = {"x": "real", "y": "real", "a": "positive", "n": "integer", "m": "real"}
UNDEFINED = (Outside, ZeroDivisionError, OverflowError, ValueError, ArithmeticError, NoConvergence)
Pair = tuple[Formula, Formula]


@dataclass(frozen=True)
class Rewritten:
    """An equation; `truth` is True by construction, False at a point that mpmath found, None where neither is so."""

    equation: Equation
    truth: bool | None
    rules: tuple[str, ...]


def pair(rng: random.Random, depth: int, rules: list[str]) -> Pair:
    """Two trees that are equal where both are defined, and in `rules` by what."""
    if depth == 0 or rng.random() < 0.15:
        number = of(Fraction(rng.choice((-3, -2, -1, 1, 2, 3, 5)), rng.choice((1, 1, 1, 2, 3))))
        leaf = rng.choice((x, x, x, y, y, a, n, m, number, number))
        return leaf, leaf
    kind = rng.random()
    first, second = pair(rng, depth - 1, rules), pair(rng, depth - 1, rules)
    if kind < 0.45:
        family = rng.choice([*RULES])
        name, rule = rng.choice([*RULES[family].items()])
        rules.append(f"{family}: {name}")
        left, right = rule(first[0], second[0])[0], rule(first[1], second[1])[1]
        return (left, right) if rng.getrandbits(1) else (rule(first[0], second[0])[1], rule(first[1], second[1])[0])
    if kind < 0.60:
        head = f(rng.choice(ALIKE))
        return head(first[0]), head(first[1])
    if kind < 0.66:
        exponent = rng.choice((2, 3, -1, Fraction(1, 2), Fraction(-1, 2), Fraction(2, 3), Fraction(3, 2)))
        return first[0] ** exponent, first[1] ** exponent
    if kind < 0.70:
        return D(first[0], x), D(first[1], x)
    if kind < 0.84:
        return first[0] + second[0], second[1] + first[1]
    if kind < 0.96:
        return first[0] * second[0], second[1] * first[1]
    return first[0] / second[0], first[1] / second[1]


def made(seed: int) -> Rewritten | None:
    """The case of a seed, or None where it has no points that can be looked at, or says nothing."""
    rng = random.Random(f"rewritten {seed}")
    rules: list[str] = []
    lhs, rhs = pair(rng, rng.choice((2, 2, 3, 3, 4)), rules)
    exact = True
    if not rules or rng.random() < 0.12:
        name, template = rng.choice([*REAL.items()])
        left, right = template(x if rng.getrandbits(1) else x * y, y)
        lhs, rhs, exact = lhs + left * a, rhs + a * right, False
        rules.append(f"in part: {name}")
    if rng.random() < 0.4:
        rhs, change = mutant(rng, rhs) if rng.random() < 0.8 else (_shifted(rng, rhs), "shifted")
        exact = False
        rules.append(f"spoiled: {change}")
    if lhs == rhs or size(lhs) + size(rhs) > 2 * LARGEST:
        return None
    equation = Equation(lhs, rhs, WORDS, _box(rng, lhs, rhs))
    used = sorted((names(lhs) | names(rhs)) - {"pi", "1j"})
    try:
        point, seen = oracle.differs(rng, lhs, rhs, used, equation.box, count=4 * SEEN, integers=("n",))
    except UNDEFINED:
        return None
    if point is None and seen < SEEN:
        return None
    return Rewritten(equation, False if point else True if exact else None, tuple(rules))


def _shifted(rng: random.Random, formula: Formula) -> Formula:
    return formula + rng.choice((pi, 2 * pi, pi / 2, -pi)) * rng.choice((of(1), x / f("abs")(x) + 1, of(-2)))


def _box(rng: random.Random, lhs: Formula, rhs: Formula) -> dict[str, Any]:
    used = names(lhs) | names(rhs)
    ends = (None, (Fraction(0), Fraction(1)), (Fraction(0), None), (Fraction(1), None), (None, Fraction(-1)),
            (Fraction(-1), Fraction(1)), (Fraction(-1), Fraction(0)), ("1/2pi", "1pi"),
            ("-1/2pi", "1/2pi"))  # fmt: skip
    box = {"a": (Fraction(0), None), "m": (Fraction(0), Fraction(1))}
    box |= {name: end for name in ("x", "y") if (end := rng.choice(ends)) is not None}
    return {name: end for name, end in box.items() if name in used}


def in_sympy(formula: Formula, space: PhaseSpace) -> Any:
    """The formula as a user of sympy would write it, evaluated by sympy as it is made."""
    head = formula.head
    if head == "num":
        number = Fraction(formula.args[0])
        return sp.Rational(number.numerator, number.denominator)
    if head == "var":
        return sp.pi if formula.args[0] == "pi" else space.symbol(formula.args[0])
    values = [in_sympy(part, space) for part in formula.args]
    if head == "+":
        return sp.Add(*values)
    if head == "*":
        return sp.Mul(*values)
    if head == "/":
        return values[0] / values[1]
    if head == "**":
        return values[0] ** values[1]
    if head == "D":
        return sp.diff(*values)
    if head in ("V", "W"):
        return space.function(head)(*values)
    if head in ("tan", "cot") and "n" in names(formula):
        sine, cosine = sp.sin(*values), sp.cos(*values)  # sympy 1.14 makes tan x of tan(x + n*pi + pi/2)
        return sine / cosine if head == "tan" else cosine / sine
    function: Any = {"sqrt": sp.sqrt, "cbrt": sp.cbrt}.get(head) or FUNCTIONS[head][0]
    return function(*values)


def at_witness(equation: Equation, witness: Mapping[str, Any] | None) -> str:
    """What mpmath says of the equation at a point: "differs", "equal", "outside", or "unknown"."""
    text = f"{equation.lhs}{equation.rhs}"
    if witness is None:
        return "unknown"
    noise = oracle.NOISE if "D(" in text else oracle.NOISE**8
    with mp.workdps(oracle.FINER * DIGITS):
        point = numbers(witness) or {}
        free = sorted((names(equation.lhs) | names(equation.rhs)) - {*point, "pi", "1j"})
        point |= next(oracle.points(random.Random(1), free, equation.box, 1, ("n",)))
        try:
            differ = oracle.apart(equation.lhs, equation.rhs, point, noise=noise)
        except TooLarge:
            return "unknown"
        except Outside:
            return "outside"
        except UNDEFINED:
            return "unknown"
        ends = {name: equation.box.get(name, (None, None)) for name in point}
        if any(low is not None and not point[name] > oracle.edge(low) for name, (low, _) in ends.items()):
            return "outside"
        if any(high is not None and not point[name] < oracle.edge(high) for name, (_, high) in ends.items()):
            return "outside"
    if "V(" in text or "W(" in text:
        return "unknown"  # some function fails there, but which is meant isn't said
    return "differs" if differ else "equal"


def in_a_file(case: Rewritten, seed: int, budget: float = BUDGET) -> tuple[str, Any]:
    """(status, witness) of the claim in a file; a refusal is "refused: …"."""
    reading = read_text(equation_file(case.equation))
    if reading.problems:
        return f"refused: {reading.problems[0]['message']}", None
    verdict = verify(reading.claims[0], budget=budget, seed=seed)
    return verdict.status, verdict.witness


def in_python(case: Rewritten, seed: int, budget: float = BUDGET) -> tuple[str, Any]:
    """(status, witness) of the claim about sympy's formulas."""
    space = PhaseSpace("Z1", "Z2", symbols=WORDS, functions="V W")
    lhs, rhs = (in_sympy(side, space) for side in (case.equation.lhs, case.equation.rhs))
    for name, (low, high) in case.equation.box.items():
        symbol: Any = space.symbol(name)
        space = space if low is None else space.where(symbol > in_sympy(_end(low), space))
        space = space if high is None else space.where(symbol < in_sympy(_end(high), space))
    verdict = verify(identity(space, lhs, rhs), budget=budget, seed=seed)
    return verdict.status, verdict.witness


def _end(end: Any) -> Formula:
    return pi * Fraction(end.removesuffix("pi")) if isinstance(end, str) else of(end)


def wrong(case: Rewritten, status: str, witness: Any, python: bool) -> str:
    """What is wrong with a verdict, in a word; nothing if nothing is known to be."""
    if status == "proved" and case.truth is False:
        return "wrong proof"
    if status != "refuted":
        return ""
    seen = at_witness(case.equation, witness)
    if seen == "equal" or (seen == "outside" and not python):
        return f"wrong witness: {seen}"
    return "wrong refutation" if case.truth is True and seen != "outside" else ""


def asked(seed: int) -> Counter[str] | None:
    """What became of a case both ways; printed, where something is wrong."""
    case = made(seed)
    if case is None:
        return None
    counts: Counter[str] = Counter()
    for way, ask in (("file", in_a_file), ("python", in_python)):
        start = time.process_time()
        try:
            status, witness = ask(case, seed)
        except InputError as error:
            status, witness = f"refused: {error}", None
        except Exception as error:
            if not isinstance(error, (AttributeError, RecursionError)) or "canon" in str(error):
                counts[f"{way}: crash"] += 1
                print(
                    f"seed {seed}, {way}: {type(error).__name__}: {error}\n{equation_file(case.equation)}", flush=True
                )
            continue
        said = wrong(case, status, witness, way == "python")
        if said or time.process_time() - start > 20 * BUDGET:
            counts[f"{way}: {said or 'overstayed'}"] += 1
            print(f"seed {seed}, {way}: {said or 'overstayed'}: {status}, {case.truth}, {case.rules} {witness}\n"
                  f"{equation_file(case.equation)}", flush=True)  # fmt: skip
        truth = {True: "true", False: "false", None: "open"}[case.truth]
        counts[f"{way}: {truth}, {status.partition(':')[0]}"] += 1
    return counts


def main() -> int:
    """Try cases; what is wrong is printed, and the counts."""
    parser = argparse.ArgumentParser(prog="python -m properties.rewritten", description=__doc__)
    parser.add_argument("--cases", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    counts: Counter[str] = Counter()
    seed, done, start = options.seed * 10**7, 0, time.process_time()
    while done < options.cases:
        found, seed = asked(seed), seed + 1
        done += found is not None
        counts.update(found or {})
    decided = sum(k for said, k in counts.items() if said.endswith(("proved", "refuted")))
    total = sum(k for said, k in counts.items() if ", " in said)
    figures = {"cases": done, "undecided": round(1 - decided / max(1, total), 4), **dict(sorted(counts.items()))}
    print(json.dumps(figures | {"seconds of a processor": round(time.process_time() - start, 1)}, indent=1))
    return int(any("wrong" in said or "crash" in said or "overstayed" in said for said in counts))


if __name__ == "__main__":
    raise SystemExit(main())
