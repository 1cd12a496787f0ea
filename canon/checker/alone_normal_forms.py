"""Normal forms of Birkhoff and Gustavson: `python alone_normal_forms.py CERTIFICATE.json …`

H and N become polynomials in coordinates and momenta, with exact fractions, by sums, products, quotients, and the
series of sin, cos and exp. {H₂, N} = 0 in each degree; and degree by degree a χ of degree 3 and more, with {H, χ} = 0
below, leads from H to N by the flow exp {·, χ}: linear equations (`counterexample_normal_forms.py` says why there is
one wherever N can be reached). In the end H has become N.

Parameters have random values. In one degree of freedom, where det ∂²H is seen to have a sign at the origin, the normal
form is unique, and its coefficients are rational functions of those of H with powers of that determinant below; so what
holds at random values holds at all.
"""

from __future__ import annotations

import re
from fractions import Fraction
from itertools import count
from typing import Any

if __package__:
    from canon.checker import alone, alone_regular, alone_wider
    from canon.checker.counterexample_formulas import Writer, inner_names, put_names
    from canon.checker.counterexample_normal_forms import bracket, reached
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_regular  # type: ignore
    import alone_wider  # type: ignore
    from counterexample_formulas import Writer, inner_names, put_names  # type: ignore
    from counterexample_normal_forms import bracket, reached  # type: ignore

Stop, RANDOM = alone.Stop, alone.RANDOM
MOST_ORDER, MOST_STEPS, LARGE, TRIES = 8, 400_000, 1 << 48, 3
FORM = {"keys": "parts", "of": {"parts H": "q p"}, "besides": ["H - H", "parts_i - parts_i"]}
Polynomial = dict[tuple[int, ...], Fraction]
"""{exponents of q…, p…: coefficient}."""


class Series:
    """Formulas as polynomials in the variables up to an order; `values` are those of the parameters."""

    def __init__(self, claim: Any, order: int, values: dict[str, Fraction]) -> None:
        self.claim, self.order, self.values, self.steps = claim, order, values, count()
        self.x = [*flat_of(claim.pairs)]
        self.one: Polynomial = {(0,) * len(self.x): Fraction(1)}

    def plus(self, a: Polynomial, b: Polynomial, factor: Fraction = Fraction(1)) -> Polynomial:
        """a + factor b."""
        found = dict(a)
        for powers, c in b.items():
            found[powers] = found.get(powers, Fraction(0)) + factor * c
        return {powers: c for powers, c in found.items() if c}

    def times(self, a: Polynomial, b: Polynomial) -> Polynomial:
        found: Polynomial = {}
        for x, c in a.items():
            for y, d in b.items():
                if next(self.steps) > MOST_STEPS:
                    raise Stop("not shown", "series that are so long")
                if sum(x) + sum(y) <= self.order:
                    powers = tuple(i + j for i, j in zip(x, y, strict=True))
                    found[powers] = found.get(powers, Fraction(0)) + c * d
        return {powers: c for powers, c in found.items() if c}

    def composed(self, a: Polynomial, coefficients: Any) -> Polynomial:
        """Σ c_k aᵏ, of an a that is 0 at the origin."""
        found, power = dict[tuple[int, ...], Fraction](), self.one
        for k in range(self.order + 1):
            found = self.plus(found, power, Fraction(coefficients(k)))
            power = self.times(power, a)
        return found

    def of(self, f: Any) -> Polynomial:
        """A formula without derivatives."""
        if f.kind == "#":
            return {next(iter(self.one)): f.of[0]} if f.of[0] else {}
        if f.kind == ".":
            if f.of[0] in self.x:
                return {tuple(int(name == f.of[0]) for name in self.x): Fraction(1)}
            if f.of[0] not in self.values:
                raise Stop("not shown", f"a coefficient with {f.of[0][:40]}")
            return {next(iter(self.one)): self.values[f.of[0]]}
        if f.kind not in ("+", "*", "^", "sin", "cos", "exp"):
            raise Stop("not shown", f"the series of {f.kind[:40]}")
        a = self.of(f.of[0])
        if f.kind in "+*":
            b = self.of(f.of[1])
            return self.plus(a, b) if f.kind == "+" else self.times(a, b)
        first = a.get(next(iter(self.one)), Fraction(0))
        if f.kind == "^":
            r = f.of[1].of[0] if f.of[1].kind == "#" else Fraction(1, 2)
            if r.denominator != 1 or abs(r) > 24 or (r < 0 and not first):
                raise Stop("not shown", "a root, a high power or a pole")
            if r < 0:  # 1/(first + b) = Σ (−b)ᵏ/first^(k+1)
                rest = self.plus(a, self.one, -first)
                a = self.composed(rest, lambda k: (-1) ** k / first ** (k + 1))
            found = self.one
            for _ in range(abs(int(r))):
                found = self.times(found, a)
            return found
        if first:
            raise Stop("not shown", f"{f.kind} of what isn't 0 at the origin")
        skip = {"exp": None, "sin": 0, "cos": 1}[f.kind]
        below = [1]
        for k in range(1, self.order + 1):
            below.append(below[-1] * k)
        sign = lambda k: 1 if skip is None else 0 if k % 2 == skip else (-1) ** (k // 2)
        return self.composed(a, lambda k: Fraction(sign(k), below[k]))


def flat_of(pairs: Any) -> list[str]:
    """Coordinates, and then momenta."""
    return [q for q, _ in pairs] + [p for _, p in pairs]


def is_normal(h: Polynomial, parts: dict[int, Polynomial], order: int) -> bool:
    """Whether H₂ + Σ parts is a normal form of H, at these values of the parameters."""
    if any(sum(p) == 1 for p in h) or not any(sum(p) == 2 for p in h):
        raise Stop("not shown", "what is no equilibrium, or without a quadratic part")
    h = {p: c for p, c in h.items() if sum(p) > 1}
    quadratic = {p: c for p, c in h.items() if sum(p) == 2}
    if any(sum(p) != degree for degree, part in parts.items() for p in part):
        raise Stop("not shown", "terms of another degree")
    n = dict(quadratic)
    for degree, part in parts.items():
        if bracket(quadratic, part, order) or (degree == 2 and part != quadratic):
            return False
        n |= part
    return reached(h, n, order) == n


def check_parameters(claim: Any, own: Any, write: Any) -> None:
    """In one degree of freedom the determinant of H's second derivatives has a sign at the origin. Raises Stop."""
    if len(claim.pairs) != 1:
        raise Stop("not shown", "small divisors, at all values of the parameters")
    (q, p), *_ = claim.pairs
    text = f"D(D(__H, {q}), {q})*D(D(__H, {p}), {p}) - D(D(__H, {q}), {p})**2"
    f = put_names(write.written(claim.read(text, own)), {x: alone.number(0) for x in (q, p)})
    alone_regular.check_sign(claim, f)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim."""
    tables = data["tables"]
    said = {key: x for key, x in tables["claim"].items() if key not in alone.UNASKED}
    if tables["claim"]["kind"] != "normal_form" or {*said} != {"order", "N"}:
        raise Stop("not shown", "no normal form, or with other keys")
    order, degrees = said["order"], [*said["N"]]
    if {"transformation", "generating_function"} & {*tables} or type(order) is not int or not 3 <= order <= MOST_ORDER:
        raise Stop("not shown", "a normal form beside a map, or such an order")
    if not all(re.fullmatch("[2-9]", d) and int(d) <= order for d in degrees):
        raise Stop("not shown", "such degrees")
    parts = [*said["N"].values()] or ["0"]
    claim = alone_wider.Wider({**tables, "claim": {"kind": "normal_form", "parts": parts}}, FORM)
    own, write = alone_regular.itself(claim), Writer(claim)
    if any({*claim.words.get(x, ())} - {"real"} for x in flat_of(claim.pairs)):
        raise Stop("not shown", "variables that have signs")
    for side in (side for text in claim.domain.get("where", []) for side in re.split("<=|>=|!=|<|>", text)):
        if inner_names(claim.read(side, own), claim) & {*claim.names}:
            raise Stop("not shown", "a condition on variables")
    H, *texts = (write.written(claim.read(x, own)) for x in ("__H", *(f"__parts_{k}" for k in range(len(parts)))))
    names = set[str]().union(*(inner_names(f, claim) for f in (H, *texts, *write.under))) - {*flat_of(claim.pairs)}
    if names:
        check_parameters(claim, own, write)
    for _ in range(TRIES if names else 1):
        values = {name: value_of(claim.words.get(name, ())) for name in names - {"pi"}}
        series = Series(claim, order, values)
        found = dict(zip((int(d) for d in degrees), map(series.of, texts), strict=False))
        for f in write.under:  # what is differentiated has a series as well
            series.of(f)
        if not is_normal(series.of(H), found, order):
            raise Stop("not shown", "that this is a normal form")
    return "shown", ""


def value_of(words: Any) -> Fraction:
    """A random number for a parameter; its sign is what is said of it, or random."""
    value = Fraction(RANDOM.randrange(1, LARGE), RANDOM.randrange(1, LARGE))
    negative = "negative" in words or (not {*words} & {"positive", "nonnegative"} and RANDOM.random() < 0.5)
    return -value if negative else value


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
