"""Actions in wells |q|ⁿ, by Euler's beta function: `python alone_power_wells.py CERTIFICATE.json …`

Where H = E says n₂ p² + k |q|ⁿ = ρ, with n, k/n₂ and n₂/d positive whatever the parameters are, d being what H divides
by, there is one orbit for each ρ/n₂ > 0, over all of the line, and with x = |q| (k/ρ)^(1/n)

    ∮ p dq = 4 √(ρ/n₂) (ρ/k)^(1/n) ∫₀¹ √(1 − xⁿ) dx,  ∫₀¹ √(1 − xⁿ) dx = √π/2 Γ(1 + 1/n)/Γ(3/2 + 1/n).

The coordinate stands in |q|ⁿ alone. The claim's value is the same at random points modulo primes: x^v is a random
square for each x and v, Γ a random number for each argument but for Γ(x + 1) = x Γ(x), Γ(1) = 1, Γ(1/2) = √π, where its
arguments are seen to be positive.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

if __package__:
    from canon.checker import alone, alone_actions, alone_charts, alone_orbits, alone_signs, alone_somewhere
    from canon.checker import alone_polynomials as of
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_actions  # type: ignore
    import alone_charts  # type: ignore
    import alone_orbits  # type: ignore
    import alone_polynomials as of  # type: ignore
    import alone_signs  # type: ignore
    import alone_somewhere  # type: ignore

Formula, Stop, U = alone.Formula, alone.Stop, alone_orbits.U
HALF, MOST_STEPS = Fraction(1, 2), 40
ACTION = "2*(pi*r/m)**(1/2)*(r/k)**(1/n)*gamma(1 + 1/n)/gamma(3/2 + 1/n)"


class Beta(alone_orbits.Motion):
    """A claim in which gamma has its meaning."""

    def made(self, kind: str, *x: Any) -> Any:
        if kind == "gamma" and len(x) == 1 and kind not in {*self.names, *self.words, *self.texts}:
            return Formula(kind, x)
        return super().made(kind, *x)


class Line:
    """U = |q|ⁿ has all values from 0 on; `put` is what `alone_somewhere.py` asks of a chart."""

    def __init__(self, h: Any) -> None:
        self.low, self.high, self.h = alone.number(0), None, h

    def put(self, _: Any) -> Any:
        return self.h


class Well:
    """The well of a claim; `value` is its action."""

    def __init__(self, motion: Any) -> None:
        self.motion, self.flat, self.exponent = motion, alone_orbits.Flat(motion), None
        said = {*motion.said} & {"well", "period"} or motion.branch not in (None, "libration")
        if said or motion.bounds or alone_charts.bounds(motion) != (None, None):
            raise Stop("not shown", "a part of the line, or another motion")
        self.chart = Line(self.put(motion.known("_H")))
        n, d = self.flat.reduced(self.flat.quotient(self.chart.h))
        for up, down in self.flat.roots.values():
            if {U, motion.p} & {*of.names_in(up), *of.names_in(down)}:
                raise Stop("not shown", "roots of what moves")
        powers = of.by_powers(n, motion.p)
        rest = of.by_powers(powers.get(0, {}), U)
        n2, k = powers.get(2, {}), rest.get(1, {})
        if {U, motion.p} & {*of.names_in(d), *of.names_in(n2)} or {*powers} != {0, 2} or not {*rest} <= {0, 1} or not k:
            raise Stop("not shown", "a Hamiltonian that isn't p² and |q|ⁿ")
        e, below = self.flat.reduced(self.flat.quotient(Formula(".", (motion.energy,))))
        written = self.flat.written
        room = of.plus(of.times(e, d), of.minus(of.times(rest.get(0, {}), below)))
        own = {"m": written(n2), "k": written(k), "n": self.exponent, "d": written(d)}
        for text in ("n", "m/d", "k/m"):
            if not self.is_positive(motion.read(text, own)):
                raise Stop("not shown", "that it is a well")
        own["r"] = motion.made("/", written(room), written(below))
        self.room, self.value = motion.read("r/m", own), motion.read(ACTION, own)
        for x in gammas(motion.known("_equals")):
            if not self.is_positive(x):
                raise Stop("not shown", "that what gamma is of is positive")
        # what `alone_somewhere.py` asks of a level: Δ and its signs
        self.delta, self.below = of.times(n2, of.plus(room, of.minus(of.times(of.times(k, below), of.named(U))))), below
        self.allowed, self.pattern = None, "^[+]-"

    def is_positive(self, f: Any) -> bool:
        signs = alone_signs.Signs(self.motion)
        return signs.shown(signs.quotient(f)[0], True)

    def put(self, f: Any) -> Any:
        """A formula with U in the place of |q|ⁿ; the coordinate must not stand elsewhere."""
        motion = self.motion
        if motion.q not in motion.inner(f):
            return f
        if f.kind == "." and f.of[0] != motion.q:
            return self.put(motion.known(motion.texts[f.of[0]]))
        if (n := self.exponent_of(f)) is not None:
            if self.exponent is not None and self.flat.structure(n) != self.flat.structure(self.exponent):
                raise Stop("not shown", "two powers of the coordinate")
            self.exponent = n
            return Formula(".", (U,))
        if f.kind not in "+*^":
            raise Stop("not shown", "another function of the coordinate")
        return motion.made(f.kind, *(self.put(x) for x in f.of))

    def exponent_of(self, f: Any) -> Any:
        """n, where a formula is |q|ⁿ with a number n ≠ 0, or a formula n that doesn't move; None else."""
        motion = self.motion
        if f.kind != "^":
            return None
        base, n = f.of
        is_number = n.kind == "#"
        if base.kind == "." and base.of[0] == motion.q:
            return n if is_number and n.of[0] > 0 and n.of[0] % 2 == 0 else None
        inside = self.exponent_of(base)
        if inside is None or (is_number and n.of[0] <= 0):
            return None
        if motion.inner(n) & {*motion.names, motion.energy}:
            return None
        return motion.made("*", inside, n)


class Gammas(alone_actions.Residues):
    """A random point modulo a prime, where powers and gamma functions have values."""

    def value(self, f: Any) -> int:
        if f.kind == "gamma":
            return self.gamma(self.terms(f.of[0]), self.at(f.of[0]))
        if f.kind == "^" and f.of[1].kind != "#":
            return self.any_power(self.at(f.of[0]), self.terms(f.of[1]))
        return super().value(f)

    def any_power(self, base: int, terms: dict[int, Fraction]) -> int:
        """base^Σ r v, base being positive: base^r where v is 1, and (base^v)^r."""
        self.roots.add(self.square(base))
        found = 1
        for v, r in terms.items():
            found *= self.root(base if v == 1 else self.any("^", base, v) ** 2 % self.p, r)
        return found % self.p

    def gamma(self, terms: dict[int, Fraction], x: int) -> int:
        """Γ(x), where x is a sum of a number and something else, or a number."""
        r, factor, is_number = terms.get(1, Fraction(0)), 1, not {*terms} - {1}
        steps = max(0, -(-r // 1) - 1 if is_number else r // 1)  # down to 0 < r ≤ 1, or 0 ≤ r < 1
        if steps > MOST_STEPS:
            raise Stop("not shown", "gamma of what is so large")
        for _ in range(steps):
            r, x = r - 1, (x - 1) % self.p
            factor = factor * x % self.p
        if is_number:
            if r <= 0:
                raise Stop("not shown", "gamma of what isn't positive")
            known = {Fraction(1): 1, HALF: self.root(self.text("pi"), HALF)}
            if r in known:
                return factor * known[r] % self.p
        return factor * self.any("gamma", x) % self.p


def gammas(f: Any) -> Iterator[Any]:
    """What gamma is of in a formula."""
    for x in f.of:
        if isinstance(x, Formula):
            yield from gammas(x)
    if f.kind == "gamma":
        yield f.of[0]


def sample(well: Well, prime: int) -> int:
    """Compare at one point, where the energy is high enough."""
    point = Gammas(well, prime)
    point.check_domain()
    point.square(point.at(well.room))
    if (point.text("_equals") - point.at(well.value)) % prime:
        raise Stop("not shown", "that this is the value")
    return len(point.roots)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim."""
    tables = data["tables"]
    if tables["claim"]["kind"] != "action":
        raise Stop("not shown", "no action")
    well = Well(Beta(tables))
    answer = alone.tried(sample, well)
    if not alone_somewhere.is_somewhere(well):
        raise Stop("not shown", "that there is such an orbit")
    return answer


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
