"""Which orbit a claim of an action or a frequency is about, for `alone_actions.py`.

H is n₂ p² + n₁ p + n₀ = κ at the energy, and a function u of the coordinate (q, q², √(q² + β), exp, sine or cosine)
makes these polynomials in u with exact fractions. u grows or falls with q throughout the range that the domain gives
it. p has real values where Δ = n₁² − 4 n₂ (n₀ − κ) is positive, and ∮ p dq = 2 ∫ √R du with R = Δ/(2 n₂ u')², T =
2 ∫ √R du with R = n²/(Δ u'²), where dp/dt and so on have the denominator n. n, n₂ and what else H divides by are seen
not to be 0 in all of the range (`alone_signs.py`).
"""

from __future__ import annotations

import re
from fractions import Fraction
from functools import cache
from typing import Any

if __package__:
    from canon.checker import alone, alone_signs
    from canon.checker import alone_polynomials as of
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_polynomials as of  # type: ignore
    import alone_signs  # type: ignore

Formula, Stop, ONE = alone.Formula, alone.Stop, of.ONE
named, number, times, plus = of.named, of.number, of.times, of.plus
KEYS, WORDS, U = {"coordinate", "energy", "equals", "fixed", "branch", "well", "period"}, {"real", "positive"}, "_u"
OTHER = "D0_of_the_file"
MOST_PARTS, ELLIPTIC = 20_000, {"elliptic_k": 1, "elliptic_e": 1, "elliptic_pi": 2}


class Motion(alone.Claim):
    """The formulas of a claim: `_H`, `_equals`; with what is fixed in the place of its names."""

    def __init__(self, tables: Any) -> None:
        whole = re.sub(r"\s", "", alone.formulas(tables))
        if "D" in tables.get("symbols", {}) and "D(" not in whole and OTHER not in whole:
            tables = renamed(tables)
        said = {key: x for key, x in tables["claim"].items() if key not in (*alone.UNASKED, "kind")}
        space, symbols, fixed = tables["phase_space"], tables.get("symbols", {}), said.get("fixed", {})
        self.q, self.energy, self.inner = said["coordinate"], said["energy"], cache(self.inner)
        self.radicands = list[Any]()  # of all roots and moduli that stay: they have to be positive
        sections = {"phase_space", "symbols", "domain", "definitions", "hamiltonian", "claim", "title", "source"}
        if {*tables} - sections or {*said} - KEYS or {*space} - {"q", "p", "time"} or {*tables["hamiltonian"]} != {"H"}:
            raise Stop("not shown", "an orbit beside a map, or with other keys")
        usual = [*space["q"], *space["p"], space.get("time", "t"), *tables.get("definitions", {}), "pi"]
        words = symbols.get(self.energy, "real")
        if {*ELLIPTIC, "gamma"} & {*usual, *symbols, *fixed}:
            raise Stop("not shown", "another function of such a name")
        if self.energy in usual or words not in WORDS or not re.fullmatch(r"[^\W\d_]\w*", self.energy):
            raise Stop("not shown", "such an energy")
        claim = {
            "kind": "identity",
            "lhs": said["equals"],
            "rhs": str([said.get(key) for key in ("fixed", "well", "period")]),
        }
        super().__init__({**tables, "symbols": {**symbols, self.energy: words}, "claim": claim})
        self.p = space["p"][space["q"].index(self.q)]
        still = {*space["q"], self.p, self.names[-1]}
        self.texts |= {"_equals": said["equals"], **{f"_{key}": said[key] for key in ("well", "period") if key in said}}
        h = self.inner(self.known("_H"))
        if h & {*still - {self.q, self.p}, self.energy} or any("integer" in self.words.get(name, ()) for name in h):
            raise Stop("not shown", "a Hamiltonian of other coordinates, time, whole numbers or its energy")
        where = [side for text in self.domain.get("where", []) for side in re.split("<=|>=|!=|<|>", text)]
        if {*self.domain} - {"where"} or any(self.inner(self.known(side)) & (still - {self.q}) for side in where):
            raise Stop("not shown", "conditions on momenta, or a surface")
        if {*self.words.get(self.p, ())} - {"real"} or {*self.words.get(self.q, ())} - WORDS:
            raise Stop("not shown", "words of the coordinate or its momentum")
        for name, text in fixed.items():
            free = name in symbols or name in space["p"] or name == self.energy
            if not free or name in (self.p, self.q) or self.inner(self.known(text)) & {*still, *fixed, self.energy}:
                raise Stop("not shown", "what is fixed to such a value")
            if name in self.texts or {*self.words.get(name, ())} - WORDS:
                raise Stop("not shown", "a name that is fixed with such words")
        if self.inner(self.known("_equals")) & still or self.has_moving(still):
            raise Stop("not shown", "a value that moves")
        self.texts |= fixed
        self.radicands = []  # all is read anew
        self.known.cache_clear()
        self.inner.cache_clear()  # type: ignore
        self.fixed, self.branch, self.said = fixed, said.get("branch"), said
        self.bounds = [text for text in self.domain.get("where", []) if self.q in self.named_in(text)]
        self.domain = {"where": [text for text in self.domain.get("where", []) if text not in self.bounds]}
        positive = alone_signs.Signs(self)
        for name in fixed:
            if "positive" in self.words.get(name, ()) and not positive.shown(
                positive.quotient(self.known(fixed[name]))[0], True
            ):
                raise Stop("not shown", "that what is fixed is positive")

    def has_moving(self, still: Any) -> bool:
        return any(self.inner(self.known(f"_{key}")) & still for key in ("well", "period") if f"_{key}" in self.texts)

    def named_in(self, text: str) -> set[str]:
        """The names in a condition."""
        return {name for side in re.split("<=|>=|!=|<|>", text) for name in self.inner(self.known(side))}

    def inner(self, f: Any) -> set[str]:
        """The names in a formula, of what definitions say."""
        found, left, count = set[str](), [f], 0
        while left:
            g, count = left.pop(), count + 1
            if g.kind == "D" or count > MOST_PARTS:
                raise Stop("not shown", "derivatives, or formulas that are so long")
            if g.kind == ".":
                found |= {*g.of}
                left += [self.known(self.texts[g.of[0]])] if g.of[0] in self.texts else []
            left += [x for x in g.of if isinstance(x, Formula)]
        return found

    def made(self, kind: str, *x: Any) -> Any:
        """A modulus is the positive root of a square."""
        base, *power = x
        if kind == "^" and power[0].kind == "#" and power[0].of[0].denominator > 1:
            self.radicands.append(base)
        if kind == "abs" and len(x) == 1 and kind not in {*self.names, *self.words, *self.texts}:
            return self.read("(a**2)**(1/2)", {"a": base})
        if ELLIPTIC.get(kind) == len(x) and kind not in {*self.names, *self.words, *self.texts}:
            return Formula(kind, x)
        if kind == "^" and base.kind == "^" and power[0].kind == "#" and base.of[1].of == (Fraction(1, 2),):
            inside, n = base.of[0], power[0].of[0]
            if inside.kind == "^" and inside.of[1].of == (2,) and n > 0 and n % 2 == 0:  # |a|ⁿ with an even n
                self.radicands = [f for f in self.radicands if f is not inside]  # a power of a, smooth at 0
                return super().made("^", inside.of[0], *power)
        return super().made(kind, *x)


def renamed(tables: Any) -> Any:
    """The same with another name for D, which the language has for derivatives."""
    if isinstance(tables, dict):
        return {renamed(key): renamed(x) for key, x in tables.items()}
    if isinstance(tables, list):
        return [renamed(x) for x in tables]
    return re.sub(r"(?<!\w)D(?!\w)", OTHER, tables) if isinstance(tables, str) else tables


class Flat:
    """Formulas as quotients of polynomials, without a word on signs; roots and functions are names."""

    def __init__(self, claim: Motion) -> None:
        self.claim, self.seen = claim, dict[Any, str]()
        self.roots, self.formulas = dict[str, of.Quotient](), dict[str, Any]()

    def structure(self, f: Any) -> Any:
        if f.kind == "." and f.of[0] in self.claim.texts:
            return self.structure(self.claim.known(self.claim.texts[f.of[0]]))
        return (f.kind, f.orders, *(self.structure(x) if isinstance(x, Formula) else x for x in f.of))

    def new(self, key: Any) -> str:
        return self.seen.setdefault(key, f"#{len(self.seen)}")

    def quotient(self, f: Any) -> of.Quotient:
        """A formula as a quotient."""
        if f.kind == "#":
            return number(f.of[0]), ONE
        if f.kind == ".":
            inside = f.of[0] in self.claim.texts
            return self.quotient(self.claim.known(self.claim.texts[f.of[0]])) if inside else (named(f.of[0]), ONE)
        if f.kind in "+*":
            a, b = map(self.quotient, f.of)
            return of.added(a, b) if f.kind == "+" else of.multiplied(a, b)
        if f.kind == "^" and f.of[1].kind == "#" and f.of[1].of[0].denominator in (1, 2) and f.of[1].of[0]:
            r, base = f.of[1].of[0], self.reduced(self.quotient(f.of[0]))
            if r.denominator == 2:
                base = times(base[0], base[1]), of.power(base[1], 2)  # √(n/d) = √(n d)/d where d > 0, as n d is
                w = self.new(("root", *sorted(base[0].items()), *sorted(base[1].items())))
                self.roots[w], base = base, (named(w), ONE)
            n, d = base if r > 0 else base[::-1]
            return of.power(n, abs(r.numerator)), of.power(d, abs(r.numerator))
        if self.claim.p in self.claim.inner(f):
            raise Stop("not shown", "another function of the momentum")
        w = self.new(self.structure(f))
        self.formulas[w] = f
        return named(w), ONE

    def reduced(self, a: of.Quotient) -> of.Quotient:
        """The same with the squares of roots put in."""
        for w in reversed([*self.roots]):
            up, down = self.roots[w]
            both = [of.by_powers(p, w) for p in a]
            if max(max(powers, default=0) for powers in both) < 2:
                continue
            parts = []
            for powers in both:
                part: of.Quotient = ({}, ONE)
                for k, p in powers.items():
                    p = times(p, named(w)) if k % 2 else p
                    part = of.added(part, (times(p, of.power(up, k // 2)), of.power(down, k // 2)))
                parts.append(part)
            a = times(parts[0][0], parts[1][1]), times(parts[0][1], parts[1][0])
        return a

    def written(self, p: of.Polynomial) -> Any:
        """A polynomial as a formula."""
        made, total = self.claim.made, alone.number(0)
        for m, c in p.items():
            term = alone.number(c)
            for name, k in m:
                one = self.formulas.get(name) or Formula(".", (name,))
                if name in self.roots:
                    up, down = map(self.written, self.roots[name])
                    one = made("^", made("/", up, down), alone.number(Fraction(1, 2)))
                term = made("*", term, made("^", one, alone.number(k)))
            total = made("+", total, term)
        return total
