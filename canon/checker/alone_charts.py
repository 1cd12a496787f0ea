"""The function u of a coordinate in which an orbit is algebraic, and what H is in it, for `alone_actions.py`.

u grows or falls all the way in the range that the domain gives the coordinate: q itself, q², √(q² + β), exp c q with
c > 0, sin, cos and sin² of c q where the domain says that c q is in such a quarter or half of the circle. So Δ has the
same sign changes in u as in q.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

if __package__:
    from canon.checker import alone, alone_orbits, alone_signs
    from canon.checker import alone_polynomials as of
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_orbits  # type: ignore
    import alone_polynomials as of  # type: ignore
    import alone_signs  # type: ignore

Formula, Stop, ONE = alone.Formula, alone.Stop, of.ONE
named, number, times, plus = of.named, of.number, of.times, of.plus
U = alone_orbits.U
ARCS = {"cos": (0, 1), "sin": (Fraction(-1, 2), Fraction(1, 2)), "sin2": (0, Fraction(1, 2))}
"""Between which multiples of π the angle is."""
PUT = {"circle": {"cos": "u", "sin": "(1 - u**2)**(1/2)"},
    "cos": {"cos": "u", "sin": "(1 - u**2)**(1/2)"},
    "sin": {"sin": "u", "cos": "(1 - u**2)**(1/2)"},
    "sin2": {"sin": "u**(1/2)", "cos": "(1 - u)**(1/2)"}}  # fmt: skip
SLOPES = {"circle": "c**2*(1 - u**2)",
    "cos": "c**2*(1 - u**2)", "sin": "c**2*(1 - u**2)", "sin2": "4*c**2*u*(1 - u)",
    "exp": "c**2*u**2",
    "line": "1", "square": "4*u", "even": "4*u", "root": "(u**2 - b)/u**2"}  # fmt: skip
"""u'²."""
PLACES = {
    "circle": (-1, 1),
    "even": (0, None),
    "cos": (-1, 1),
    "sin": (-1, 1),
    "sin2": (0, 1),
    "exp": (0, None),
    "square": (0, None),
}
"""The ends of the range of u."""
FOLDS = {"even": (0,), "circle": (-1, 1)}
"""Those ends that are places of the line, or of the circle, through which a motion may go."""


class Chart:
    """u of one kind, with its rate c; `low` and `high` are formulas, or None where the range has no end."""

    def __init__(self, motion: Any, kind: str, rate: Any = None, at: Any = None) -> None:
        self.motion, self.kind, self.rate, self.at, self.flat = motion, kind, rate, at, alone_orbits.Flat(motion)
        self.u = Formula(".", (U,))
        self.low, self.high = (None if x is None else alone.number(x) for x in PLACES.get(kind, (None, None)))
        own = {"u": self.u, "c": rate, "b": at} if rate is not None or at is not None else {"u": self.u}
        if kind == "root":
            own["b"], signs = self.constant(at), alone_signs.Signs(motion)
            self.low = motion.made("^", own["b"], alone.number(Fraction(1, 2)))
            if not signs.shown(signs.quotient(own["b"])[0], True):
                raise Stop("not shown", "that a root begins above 0")
        self.steep = motion.read(SLOPES[kind], own)
        self.own = own

    def constant(self, at: Any) -> Any:
        """β of √(q² + β)."""
        powers = of.by_powers(*self.flat.quotient(at.of[0])[:1], self.motion.q)
        below = self.flat.quotient(at.of[0])[1]
        if {*powers} != {0, 2} or powers[2] != below or self.motion.q in of.names_in(below):
            raise Stop("not shown", "a root of that form")
        return self.motion.made("/", self.flat.written(powers[0]), self.flat.written(below))

    def put(self, f: Any) -> Any:
        """A formula with u in it for the coordinate."""
        motion = self.motion
        if motion.q not in motion.inner(f):
            return f
        if f.kind == ".":
            if f.of[0] != motion.q:
                return self.put(motion.known(motion.texts[f.of[0]]))
            text = {"line": "u", "square": "u**(1/2)", "even": "u**(1/2)", "root": "(u**2 - b)**(1/2)"}.get(self.kind)
            if text is None:
                raise Stop("not shown", "a coordinate within and without its function")
            return motion.read(text, self.own)
        if self.kind == "root" and self.flat.structure(f) == self.flat.structure(self.at):
            return self.u
        if f.kind in ("sin", "cos", "exp") and self.rate is not None:
            n = multiple(self.flat, f.of[0], self.rate, motion.q)
            if f.kind == "exp" and self.kind == "exp" and (2 * n).denominator == 1:
                return motion.made("^", self.u, alone.number(n))
            if f.kind != "exp" and self.kind in PUT and abs(n) == 1:
                found = motion.read(PUT[self.kind][f.kind], {"u": self.u})
                return motion.made("*", alone.number(n if f.kind == "sin" else 1), found)
        if f.kind not in "+*^":
            raise Stop("not shown", "another function of the coordinate")
        return motion.made(f.kind, *(self.put(x) if isinstance(x, Formula) else x for x in f.of))


def times_minus(motion: Any, f: Any) -> Any:
    return motion.made("*", alone.number(-1), f)


def multiple(flat: Any, f: Any, rate: Any, q: str) -> Fraction:
    """n, where the formula is n times rate · q. Raises Stop."""
    (n, d), (a, b) = flat.reduced(flat.quotient(f)), flat.reduced(flat.quotient(rate))
    left, right = times(n, b), times(times(a, named(q)), d)
    if left and right and {*left} == {*right}:
        ratios = {c / right[m] for m, c in left.items()}
        if len(ratios) == 1:
            return ratios.pop()
    raise Stop("not shown", "an angle, or an exponent, of another form")


def parts(motion: Any, f: Any) -> Any:
    """What a formula is made of, where the coordinate is in it."""
    if motion.q in motion.inner(f):
        yield f
        inside = [motion.known(motion.texts[f.of[0]])] if f.kind == "." and f.of[0] in motion.texts else f.of
        for g in inside:
            if isinstance(g, Formula):
                yield from parts(motion, g)


def rates(motion: Any, kinds: Any) -> list[Any]:
    """The slopes of arguments, which are positive."""
    flat, signs, found = alone_orbits.Flat(motion), alone_signs.Signs(motion), []
    for g in parts(motion, motion.known("_H")):
        if g.kind in kinds:
            n, d = flat.quotient(g.of[0])
            powers = of.by_powers(n, motion.q)
            if {*powers} == {1} and motion.q not in of.names_in(d):
                c = motion.made("/", flat.written(powers[1]), flat.written(d))
                for sign in (1, -1):
                    rate = motion.made("*", alone.number(sign), c)
                    if signs.shown(signs.quotient(rate)[0], True):
                        found.append(rate)
    return found


def bounds(motion: Any) -> tuple[Any, Any]:
    """The ends of the coordinate's range by the domain, as formulas or None."""
    ends: list[Any] = [None, None]
    flat, signs = alone_orbits.Flat(motion), alone_signs.Signs(motion)
    if "positive" in motion.words.get(motion.q, ()):
        ends[0] = alone.number(0)
    for text in motion.bounds:
        words = alone_orbits.re.split(r"(<=|>=|!=|<|>)", text)
        for a, sign, b in zip(words[::2], words[1::2], words[2::2], strict=False):
            if sign not in "<>":
                raise Stop("not shown", "such a condition on the coordinate")
            f = motion.read(f"({b}) - ({a})" if sign == "<" else f"({a}) - ({b})")  # positive
            if motion.q not in motion.inner(f):
                raise Stop("not shown", "a condition of that form")
            n, d = flat.quotient(f)
            powers = of.by_powers(n, motion.q)
            if not {*powers} <= {0, 1} or motion.q in of.names_in(d):
                raise Stop("not shown", "a condition of that form on the coordinate")
            slope, rest = (flat.written(powers.get(k, {})) for k in (1, 0))
            over = motion.made("/", slope, flat.written(d))
            side = next(
                (
                    s
                    for s in (1, -1)
                    if signs.shown(signs.quotient(times_minus(motion, over) if s < 0 else over)[0], True)
                ),
                0,
            )
            if not side or ends[side < 0] is not None:
                raise Stop("not shown", "which side a condition on the coordinate is of")
            ends[side < 0] = motion.made("*", alone.number(-1), motion.made("/", rest, slope))
    return ends[0], ends[1]


def mirrors(motion: Any) -> Any:
    """Charts of all q that fold the line: u = q², and u = cos c q, whose H has the period 2π/c."""
    if bounds(motion) == (None, None):
        yield Chart(motion, "even")
        for rate in rates(motion, ("sin", "cos")):
            yield Chart(motion, "circle", rate)


def charts(motion: Any) -> Any:
    """The charts in which H may be algebraic, for the range that the coordinate has."""
    low, high = bounds(motion)
    flat = alone_orbits.Flat(motion)
    zero = low is not None and not flat.quotient(low)[0]
    if high is None and zero:
        roots = [g for g in parts(motion, motion.known("_H")) if g.kind == "^" and g.of[1].of == (Fraction(1, 2),)]
        yield from (Chart(motion, "root", at=g) for g in roots if motion.p not in motion.inner(g))
        yield Chart(motion, "square")
    if low is None and high is None:
        for rate in rates(motion, ("exp",)):
            for n in (2, 1):
                yield Chart(motion, "exp", motion.made("*", alone.number(n), rate))
    if low is not None and high is not None:
        for rate in rates(motion, ("sin", "cos")):
            for kind, arc in ARCS.items():
                turns = [motion.made("*", rate, end) for end in (low, high)]
                if all(
                    same(flat, f, motion.made("*", alone.number(r), motion.read("pi")))
                    for f, r in zip(turns, arc, strict=True)
                ):
                    yield Chart(motion, kind, rate)
    line = Chart(motion, "line")
    line.low, line.high = low, high
    yield line


def at(p: of.Polynomial, x: int) -> of.Polynomial:
    """A polynomial where u is a number."""
    total: of.Polynomial = {}
    for k, c in of.by_powers(p, U).items():
        total = plus(total, times(number(x**k), c))
    return total


def same(flat: Any, f: Any, g: Any) -> bool:
    """Whether two formulas are the same quotient."""
    (n, d), (a, b) = flat.reduced(flat.quotient(f)), flat.reduced(flat.quotient(g))
    return times(n, b) == times(a, d)


class Level:
    """n₂ p² + n₁ p + n₀ = κ where H is the energy, as polynomials in u: Δ and what else the integrals need."""

    def __init__(self, motion: Any, chart: Chart) -> None:
        self.motion, self.chart, self.flat = motion, chart, chart.flat
        p, (n, d) = motion.p, self.reduced(motion.known("_H"))
        e, below = self.flat.reduced(self.flat.quotient(Formula(".", (motion.energy,))))
        inside = [w for w, (up, down) in self.flat.roots.items() if p in of.names_in(up) + of.names_in(down)]
        self.is_time, self.turns, self.pattern, self.times = False, False, "-[+]-", 2
        self.others, self.zeros, self.ends = list[Any](), list[Any](), list[Any]()
        self.allowed: Any = None  # what has to be positive where p is real, besides Δ
        self.positive, self.plain, kappa = list[Any](), not inside, (times(e, d), below)
        if inside:  # α √X + ρ = E d: X = ((E d − ρ)/α)²
            powers = of.by_powers(n, inside[0])
            if len(inside) > 1 or {*powers} - {0, 1} or 1 not in powers or inside[0] in of.names_in(d):
                raise Stop("not shown", "a Hamiltonian with such roots of the momentum")
            alpha, (up, down) = powers[1], self.flat.roots[inside[0]]
            rest = plus(times(e, d), of.minus(times(powers.get(0, {}), below)))
            self.positive += [(alpha, d), (down, ONE)]
            self.allowed = rest, times(alpha, below)
            self.keep_out(p, rest, alpha, d)
            n, d = self.level(times(up, times(times(alpha, alpha), times(below, below)))), down
            kappa = self.level(times(times(rest, rest), down)), ONE
        powers = of.by_powers(n, p)
        if p in of.names_in(d) or not {*powers} <= {0, 1, 2} or 2 not in powers:
            raise Stop("not shown", "a Hamiltonian that isn't quadratic in the momentum")
        n0, self.n1, self.n2 = (powers.get(k, {}) for k in (0, 1, 2))
        # times what κ is divided by: κ = kappa[0]/kappa[1]
        square = times(number(4), self.n2)
        delta = plus(
            times(plus(times(self.n1, self.n1), of.minus(times(square, n0))), kappa[1]), times(square, kappa[0])
        )
        self.below, self.d = kappa[1], d
        self.delta, more = self.flat.reduced((delta, ONE))
        self.below = times(self.below, more)
        self.steep = self.flat.reduced(self.flat.quotient(chart.steep))
        self.positive += [(self.n2, d)]
        for w, (up, down) in self.flat.roots.items():
            if U in of.names_in(up) + of.names_in(down):
                self.keep_out(w, self.n2, self.delta, self.d, self.below, *self.steep)

    def keep_out(self, name: str, *of_these: Any) -> None:
        if any(name in of.names_in(p) for p in of_these):
            raise Stop("not shown", "roots of the coordinate that stay")

    def level(self, p: Any) -> Any:
        """A polynomial without squares of roots; a denominator would be one of constants."""
        n, d = self.flat.reduced((p, ONE))
        if d != ONE:
            raise Stop("not shown", "roots of fractions")
        return n

    def reduced(self, f: Any) -> of.Quotient:
        return self.flat.reduced(self.flat.quotient(self.chart.put(f)))

    def range_signs(self) -> Any:
        """Signs where u is in its range."""
        signs = alone_signs.Signs(self.motion)
        signs.everywhere = True
        u = self.chart.u
        for end, side in ((self.chart.low, 1), (self.chart.high, -1)):
            if end is not None:
                gap = self.motion.made("+", u, times_minus(self.motion, end))
                signs.use(signs.quotient(gap if side > 0 else times_minus(self.motion, gap))[0])
        return signs

    def is_positive(self, n: Any, d: Any, folds: bool = True) -> bool:
        """Whether a quotient is seen to be positive for all u of the range, and where it is folded."""
        ends = FOLDS.get(self.chart.kind, ()) if folds else ()
        places = [(n, d), *((at(n, x), at(d, x)) for x in ends)]
        for a, b in places:
            f = self.motion.made("*", self.flat.written(a), Formula("^", (self.flat.written(b), alone.number(-1))))
            signs = self.range_signs()
            if not signs.shown(signs.quotient(f)[0], True):
                return False
        return True

    def check(self) -> None:
        """See that H has a value throughout the range, and ∂²H/∂p² is positive."""
        for n, d in self.positive:
            if not self.is_positive(n, d):
                raise Stop("not shown", "that something is positive throughout the range")
        if not (self.is_positive(self.d, ONE) or self.is_positive(of.minus(self.d), ONE)):
            raise Stop("not shown", "that H has a value throughout the range")
        moving = {self.motion.q, self.motion.p}
        for f in [f for f in self.motion.radicands if self.motion.inner(f) & moving]:
            if not self.is_positive(*self.reduced(f)):
                raise Stop("not shown", "that what a root, or a modulus, is of isn't 0 on the way")
        for up, down in self.flat.roots.values():
            if U in of.names_in(up) + of.names_in(down) and self.motion.p not in of.names_in(up) + of.names_in(down):
                if not self.is_positive(up, down, folds=(up, down) != (named(U), ONE)):  # that of q² is smooth
                    raise Stop("not shown", "that a root has a value throughout the range")
