"""Refutations of limits, beside `counterexample.py`: by series in the distance w to the limit, of intervals.

A series (v, c) is wᵛ (c₀ + c₁ w + … + c_N w^N) for every w between 0 and NEAR, where the last "coefficient" is an
interval of what is left over, at all these w. If f tended to a number, its terms of negative powers were 0, and the
constant one that number; so another constant term refutes it.
"""

from __future__ import annotations

from fractions import Fraction
from functools import reduce
from math import factorial
from typing import Any

if __package__:
    from canon.checker.alone import Formula, Stop
    from canon.checker.counterexample import NONE, ONE, Arithmetic, Interval, Open, check, fails, somewhere
    from canon.checker.counterexample_formulas import Writer, inner_names
    from canon.checker.counterexample_functions import Place, just
    from canon.checker.counterexample_integrals import claim_with, sides_of
else:  # as a program's part, beside the other files
    from alone import Formula, Stop  # type: ignore
    from counterexample import NONE, ONE, Arithmetic, Interval, Open, check, fails, somewhere  # type: ignore
    from counterexample_formulas import Writer, inner_names  # type: ignore
    from counterexample_functions import Place, just  # type: ignore
    from counterexample_integrals import claim_with, sides_of  # type: ignore

N, BITS, NEAR = 8, 256, (Fraction(0), Fraction(1, 2**24))
Series = tuple[int, tuple[Interval, ...]]
SHARED = ("hamiltonian", "transformation", "generating_function")
X = Formula(".", ("#x",))


class Expansion:
    """Series of a claim's formulas where a name is `to`, one side of it, or at an infinity."""

    def __init__(self, claim: Any, of: dict[str, Any], name: str, start: Series) -> None:
        self.claim, self.of, self.name, self.start, self.real = claim, of, name, start, Arithmetic(BITS)
        self.known = dict[int, tuple[Formula, Series]]()
        self.point = Place(claim, of, self.real)

    def at(self, f: Formula) -> Series:
        """The series of a formula without derivatives."""
        if id(f) not in self.known:
            self.known[id(f)] = f, self.trimmed(self.made(f))
        return self.known[id(f)][1]

    def trimmed(self, x: Series) -> Series:
        """Without coefficients that are 0 exactly in front."""
        v, c = x
        while len(c) > 1 and c[0] == NONE:
            v, c = v + 1, c[1:]
        return v, c

    def folded(self, v: int, c: list[Interval], size: int) -> Series:
        """With so many places at most: the others are part of what is left over."""
        real, rest = self.real, NONE
        for one in reversed(c[size - 1 :]):
            rest = real.add(one, real.times(rest, NEAR))
        return v, (*c[: size - 1], rest)

    def sum(self, x: Series, y: Series) -> Series:
        if x[0] > y[0]:
            x, y = y, x
        gap, real = y[0] - x[0], self.real
        other = [NONE] * gap + [*y[1]]
        ends = min(len(x[1]), len(other))
        c = [real.add(a, b) for a, b in zip([*x[1]] + [NONE] * len(other), other + [NONE] * len(x[1]), strict=False)]
        return self.folded(x[0], c[: max(len(x[1]), len(other))], ends)

    def product(self, x: Series, y: Series) -> Series:
        real, c = self.real, [NONE] * (len(x[1]) + len(y[1]) - 1)
        for i, a in enumerate(x[1]):
            for j, b in enumerate(y[1]):
                c[i + j] = real.add(c[i + j], real.times(a, b))
        return self.folded(x[0] + y[0], c, min(len(x[1]), len(y[1])))

    def constant(self, x: Interval) -> Series:
        return 0, (x, *[NONE] * N)

    def bounds(self, c: tuple[Interval, ...]) -> Interval:
        """All values of Σ c wᵏ."""
        return reduce(lambda rest, one: self.real.add(one, self.real.times(rest, NEAR)), reversed(c), NONE)

    def composed(self, g: Formula, x: Series) -> Series:
        """g(x) by Taylor's formula about the constant term, g being a formula of one name."""
        v, c = x
        if v < 0:
            raise Open("a function of what grows")
        if v > 0:
            v, c = self.folded(0, [*[NONE] * v, *c], min(v + len(c), N + 1))
        here = Place(self.claim, {**self.of, "#x": c[0]}, self.real)
        box = Place(self.claim, {**self.of, "#x": self.bounds(c)}, self.real)
        rest = 1, (c[1:] if len(c) > 1 else (NONE,))
        size, power = len(c), self.constant(ONE)
        found: Series = 0, (here.at(g), *[NONE] * (size - 1))
        for k in range(1, size):
            power = self.product(power, rest)
            slope = (here if k < size - 1 else box).at(g, *("#x",) * k)
            slope = self.real.times(slope, just(Fraction(1, factorial(k))))
            found = self.sum(found, self.product(power, self.constant(slope)))
        return found

    def sign(self, x: Series) -> int:
        """The sign for small w; 0 where it isn't seen."""
        first = next((one for one in x[1] if one != NONE), NONE)
        return 0 if not fails(first, "") else 1 if first[0] > 0 else -1

    def made(self, f: Formula) -> Series:
        if f.kind == "." and f.of[0] == self.name:
            return self.start
        if self.name not in inner_names(f, self.claim):
            return self.constant(self.point.at(f))
        if f.kind in "+*":
            x, y = (self.at(part) for part in f.of)
            return self.sum(x, y) if f.kind == "+" else self.product(x, y)
        if f.kind == "^":
            return self.power(f)
        if f.kind == "atan" and f.of[0].kind == "exp" and self.at(f.of[0].of[0])[0] < 0:
            minus = self.product(self.constant(just(Fraction(-1))), self.at(f.of[0].of[0]))
            if self.sign(minus) < 0:  # π/2 − arctan of what falls
                other = self.composed(Formula("atan", (X,)), self.fallen(minus))
                return self.sum(self.constant(self.real.times(self.real.pi, just(Fraction(1, 2)))),
                                self.product(self.constant(just(Fraction(-1))), other))  # fmt: skip
        x = self.at(f.of[0])
        if f.kind == "exp" and x[0] < 0:
            return self.fallen(x)
        if f.kind in ("exp", "log", "sin", "cos", "atan") and len(f.of) == 1:
            return self.composed(Formula(f.kind, (X,)), x)
        raise Open(f"a series of {f.kind}")

    def fallen(self, x: Series) -> Series:
        """exp x for x ≤ −c/w: smaller than every power, w⁻ⁿ exp(−c/w) ≤ (n/c)ⁿ."""
        top = self.bounds(x[1])[1]
        if x[0] >= 0 or top >= 0:
            raise Open("an exponential that grows, or that isn't seen to fall")
        return 0, (*[NONE] * N, (Fraction(0), (Fraction(N) / -top) ** N))

    def power(self, f: Formula) -> Series:
        """x^r: by logarithms where the exponent isn't a number."""
        base, exponent = f.of
        x = self.at(base)
        if exponent.kind != "#":
            if self.sign(x) <= 0:
                raise Open("a power of what isn't positive")
            y = self.product(self.at(exponent), self.composed(Formula("log", (X,)), x))
            y = self.trimmed(y)
            return self.fallen(y) if y[0] < 0 else self.composed(Formula("exp", (X,)), y)
        r = exponent.of[0]
        if r.denominator == 1 and 0 <= r <= N:
            return reduce(self.product, [x] * int(r), self.constant(ONE))
        if (x[0] * r).denominator != 1 or not self.sign(x) or (r.denominator != 1 and self.sign(x) < 0):
            raise Open("such a power")
        v, c = self.composed(Formula("^", (X, exponent)), (0, x[1]))
        return v + int(x[0] * r), c


def limit_of(x: Series) -> Interval:
    """The constant term, where what is left over vanishes with w."""
    v, c = x
    if v + len(c) - 1 <= 0:
        raise Open("a series of so few terms")
    return c[-v] if v <= 0 else NONE


RULES = {"limit"}


def refuted(tables: Any, witness: Any, known: Any = None) -> tuple[str, str]:
    """Whether f doesn't tend to `equals`."""
    del known
    claim = tables["claim"]
    if claim["kind"] not in RULES or not isinstance(witness, dict) or {*SHARED} & {*tables}:
        raise Stop("not shown", "a refutation of such a claim, or beside such a map")
    name, texts = claim["variable"], {"_f": claim["f"], "_equals": claim["equals"]}
    if "infinity" in str(claim["equals"]):
        raise Stop("not shown", "a limit that is infinite")
    infinite = {"infinity": 1, "-infinity": -1}.get(str(claim["to"]).replace(" ", ""))
    asked = claim_with(tables, [name], texts | ({} if infinite else {"_to": claim["to"]}))
    if "integer" in asked.words.get(name, ()) or name in asked.texts:
        raise Stop("not shown", "such a variable")
    if any(name in inner_names(asked.known(text), asked) for text in texts if text != "_f"):
        raise Stop("not shown", "a limit that moves")
    if not infinite and name in inner_names(asked.known("_to"), asked):
        raise Stop("not shown", "a limit that moves")
    of = somewhere(asked, witness, 0)
    of.pop(name, None)
    point, reason = Place(asked, of, Arithmetic(BITS)), "that it tends to something else"
    value, write = point.text("_equals"), Writer(asked)
    f = write.written(asked.known("_f"))
    for side in (1, -1):
        if infinite not in (None, side) or {"+": 1, "-": -1}.get(claim.get("side", ""), side) != side:
            continue
        sign = just(Fraction(side))
        if infinite is None:
            start = 0, (point.text("_to"), sign, *[NONE] * (N - 1))
        else:
            start = -1, (sign, *[NONE] * N)
        try:
            whole = Expansion(asked, of, name, start)
            conditions = [(asked.known(text), word) for text, word in sides_of(asked.domain.get("where", []))]
            for g, word in conditions:
                if name in inner_names(g, asked):
                    here = whole.sign(whole.trimmed(whole.at(write.written(g))))
                    check(just(Fraction(here)), [word])
                else:
                    check(point.at(g), [word])
            for other, words in asked.words.items():
                if "function" not in words and other != name:
                    check(point.named(other), words)
            mine = {*asked.words.get(name, ())} - {"real"}
            check(just(Fraction(whole.sign(whole.trimmed(start)))), mine)
            for g in write.under:
                whole.at(g)
            found = limit_of(whole.at(f))
            if found[1] < value[0] or value[1] < found[0]:
                return "shown", ""
        except Open as left:
            reason = str(left)
    return "not shown", reason
