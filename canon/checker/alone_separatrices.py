"""Actions at a separatrix: `python alone_separatrices.py CERTIFICATE.json …`

Where Δ of `alone_orbits.py` has a double zero d inside the line, with y = q − d and Δ/4n₂² = y² P(y):

    P = b y + c:            ∮ p dq = 8 c^(5/2)/15 b²,  the one loop that is bounded;
    P = a y² + b y + c:     two loops where a < 0 < c, to the left (s = −1) and to the right (s = 1) of d,
                            ∮ p dq = 2 (−c^(3/2)/3a − s b I/2a),  I = ∫ √P dy over the loop.

That y⁰ and y¹ have the coefficient 0 is an identity of polynomials; the signs of a, b, c are seen for all values of the
parameters (`alone_signs.py`), so that the ends of the loops need no formula. Round the circle Δ/4n₂² = λ (1 ± u), u =
cos γq, and from one top to the next ∫ p dq = 2 √(8 λ)/γ. The value is a formula, and the claim's is the same at random
points modulo primes.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from fractions import Fraction
from math import comb
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

Stop, U = alone.Stop, alone_orbits.U
ONE_LOOP = "8*c**(5/2)/(15*b**2)"
TWO_LOOPS = (
    "2*(-c**(3/2)/(3*a) - s*b/(2*a)*(-s*b*c**(1/2)/(4*a)"
    " + (4*a*c - b**2)/(8*a)*(pi/2 + s*asin(b*(b**2 - 4*a*c)**(-1/2)))*(-a)**(-1/2)))"
)
TWICE = "(9*a*d - b*c)/(2*(b**2 - 3*a*c))"
"""The double zero of a u³ + b u² + c u + d, if there is one, and b² ≠ 3 a c."""


class Separatrix:
    """A level of H whose Δ has a double zero; `value` is its action."""

    def __init__(self, motion: Any, chart: Any) -> None:
        self.motion, self.chart = motion, chart
        self.level = level = alone_charts.Level(motion, chart)
        self.flat = level.flat
        level.check()
        if not level.plain or level.allowed or level.n1:
            raise Stop("not shown", "a Hamiltonian that isn't a square of the momentum and a potential")
        if any(U in of.names_in(p) for p in (level.n2, level.d, level.below)):
            raise Stop("not shown", "a mass that depends on the place")
        powers, written = of.by_powers(level.delta, U), self.flat.written
        self.scale = motion.read("4*n**2*k", {"n": written(level.n2), "k": written(level.below)})
        self.series = [
            motion.made("/", written(powers.get(k, {})), self.scale) for k in range(max(powers, default=0) + 1)
        ]
        level.pattern = "[+]"  # the signs of a, b and c say the rest
        self.value = self.round() if chart.kind == "circle" else self.loop()

    def is_zero(self, f: Any) -> bool:
        return not self.flat.reduced(self.flat.quotient(f))[0]

    def is_positive(self, text: str, own: Any) -> bool:
        """Whether a text is seen to be positive, whatever the parameters are."""
        signs = alone_signs.Signs(self.motion)
        return signs.shown(signs.quotient(self.motion.read(text, own))[0], True)

    def doubles(self) -> Iterator[Any]:
        """Places at which a double zero may be, as formulas."""
        read, series = self.motion.read, self.series
        own = dict(zip("dcba", series, strict=False))
        if len(series) == 4:
            if self.is_positive("b**2 - 3*a*c", own):
                yield read(TWICE, own)
            return
        yield alone.number(0)
        yield read("-b/(4*a)", {"b": series[3], "a": series[4]})  # the middle of a symmetric one
        ratios = [self.flat.reduced(self.flat.quotient(self.motion.made("/", f, series[4]))) for f in series]
        if all({*n} <= {()} and {*d} == {()} for n, d in ratios):
            yield from map(alone.number, repeated([n.get((), Fraction(0)) / d[()] for n, d in ratios]))

    def about(self, place: Any) -> list[Any]:
        """The coefficients of the powers of y = u − place, as formulas."""
        make, found = self.motion.made, []
        for k in range(len(self.series)):
            total = alone.number(0)
            for j in range(k, len(self.series)):
                term = make("*", alone.number(comb(j, k)), self.series[j])
                total = make("+", total, make("*", term, make("^", place, alone.number(j - k))) if j > k else term)
            found.append(self.motion.made("*", alone.number(1), total))
        return found

    def loop(self) -> Any:
        """The action of the loop on a line that has no ends, or of the one round the well."""
        motion = self.motion
        if alone_charts.bounds(motion) != (None, None) or motion.bounds or motion.branch not in (None, "libration"):
            raise Stop("not shown", "a part of the line, or another branch")
        if len(self.series) not in (4, 5) or "period" in motion.said:
            raise Stop("not shown", "a double zero of a polynomial of another degree, or a period")
        for place in self.doubles():
            first, second, *rest = self.about(place)
            if self.is_zero(first) and self.is_zero(second):
                own = {**dict(zip("cba", rest, strict=False)), "d": place}
                if "well" in motion.said:
                    own["w"] = motion.known("_well")
                return self.one(own) if len(rest) == 2 else self.two(own)
        raise Stop("not shown", "a double zero")

    def one(self, own: Any) -> Any:
        """P is linear: the loop lies where b y < 0."""
        signs = [s for s in (1, -1) if self.is_positive(f"({s})*b", own)]
        if not signs or not self.is_positive("c", own):
            raise Stop("not shown", "that there is one loop")
        if "w" in own and not (
            self.is_positive(f"({signs[0]})*(d - w)", own) and self.is_positive("b*(w - d) + c", own)
        ):
            raise Stop("not shown", "that the well is in the loop")
        return self.motion.read(ONE_LOOP, own)

    def two(self, own: Any) -> Any:
        """P is quadratic, with zeros on both sides of d."""
        if not self.is_positive("-a", own) or not self.is_positive("c", own):
            raise Stop("not shown", "that there are two loops")
        side = "w" in own and next((s for s in (1, -1) if self.is_positive(f"({s})*(w - d)", own)), 0)
        if not side or not self.is_positive("a*(w - d)**2 + b*(w - d) + c", own):
            raise Stop("not shown", "in which of two loops the well is")
        return self.motion.read(TWO_LOOPS, {**own, "s": alone.number(side)})

    def round(self) -> Any:
        """The action from one top of a potential of one cosine to the next, or there and back."""
        motion, read, times = self.motion, self.motion.read, {"libration": 4, "rotation": 2}.get(self.motion.branch)
        if (
            alone_charts.bounds(motion) != (None, None)
            or motion.bounds
            or len(self.series) != 2
            or "well" in motion.said
        ):
            raise Stop("not shown", "a motion on the circle with one cosine")
        own = {"a": self.series[0], "b": self.series[1], "c": self.chart.rate}
        if times is None or not (self.is_zero(read("a - b", own)) or self.is_zero(read("a + b", own))):
            raise Stop("not shown", "the energy of the top, and one branch")
        if not self.is_positive("a", own) or not self.is_positive("c", own):
            raise Stop("not shown", "that there is a motion")
        if "period" in motion.said and (
            times == 4 or not self.is_zero(read("t*c - 2*pi", {**own, "t": motion.known("_period")}))
        ):
            raise Stop("not shown", "the period of that cosine")
        return read("n*(8*a/c**2)**(1/2)", {**own, "n": alone.number(times)})


def repeated(series: list[Fraction]) -> list[Fraction]:
    """The repeated zero of a polynomial with such coefficients, of y⁰ first, if there is one alone."""
    a, b = series, [k * c for k, c in enumerate(series)][1:]
    while b:
        while len(a) >= len(b):
            c = a[-1] / b[-1]
            a = [x - (c * b[k - len(a) + len(b)] if k >= len(a) - len(b) else 0) for k, x in enumerate(a)][:-1]
        while a and not a[-1]:
            a = a[:-1]
        a, b = b, a
    return [-a[0] / a[1]] if len(a) == 2 else []


class Odd(alone_actions.Residues):
    """A random point modulo a prime, at which asin is odd."""

    def value(self, f: Any) -> int:
        if f.kind != "asin":
            return super().value(f)
        x = self.at(f.of[0])
        return self.any("asin", min(x, self.p - x)) * (1 if 2 * x < self.p else -1) % self.p if x else 0


def levels(motion: Any) -> Iterator[Separatrix]:
    """The charts in which there is a separatrix, one alone in general."""
    with suppress(Stop):
        yield Separatrix(motion, alone_charts.Chart(motion, "line"))
    for rate in alone_charts.rates(motion, ("sin", "cos")):
        with suppress(Stop):
            yield Separatrix(motion, alone_charts.Chart(motion, "circle", rate))


def sample(one: Separatrix, prime: int) -> int:
    """Compare at one point."""
    point = Odd(one.level, prime)
    point.check_domain()
    if (point.text("_equals") - point.at(one.value)) % prime:
        raise Stop("not shown", "that this is the value")
    return len(point.roots)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim."""
    tables = data["tables"]
    if tables["claim"]["kind"] != "action":
        raise Stop("not shown", "no action")
    for one in levels(alone_orbits.Motion(tables)):
        answer = alone.tried(sample, one)
        if alone_somewhere.is_somewhere(one.level):
            return answer
    return "not shown", "a separatrix"


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
