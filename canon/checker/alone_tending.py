"""Limits of formulas with limits within them, beside `alone_limits.py`: `python alone_tending.py CERTIFICATE.json …`

A quotient N/D that stands in a function, as (√(1 − b²) − 1)/b in an arccosine, is smooth at the limit if both are
smooth there, D vanishes in the n-th order and N at least so fast; its Taylor coefficients follow from theirs. D needn't
be a polynomial: its first derivative that isn't 0 has a sign whatever the parameters are. A power with a variable
exponent is exp(b log a), an arctangent of what has a pole ±π/2 − atan(D/N), K(m) its series where m is 0.

Before that the variable is chosen anew. At infinity, where it stands in exponentials alone, whose exponents are
multiples of one that grows, it is E = exp(−u) > 0, which tends to 0. On one side of a zero of radicands it is y with
x = a ± y², so that √(2 a y² + y⁴) = y √(2 a + y²).
"""

from __future__ import annotations

from fractions import Fraction
from math import gcd, lcm
from typing import Any

if __package__:
    from canon.checker import alone, alone_edges, alone_limits, alone_signs
    from canon.checker import alone_polynomials as of
    from canon.checker.counterexample_formulas import Writer, put
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_edges  # type: ignore
    import alone_limits  # type: ignore
    import alone_polynomials as of  # type: ignore
    import alone_signs  # type: ignore
    from counterexample_formulas import Writer, put  # type: ignore

Formula, Stop, ONE = alone.Formula, alone.Stop, alone_limits.ONE


def inverse(f: Any) -> Any:
    return Formula("^", (f, alone.number(-1)))


def product(*factors: Any) -> Any:
    """A product, without factors that are 1."""
    found = ONE
    for f in factors:
        found = f if found.of == (1,) else found if f.of == (1,) else Formula("*", (found, f))
    return found


class Tending(alone_limits.Limit):
    """f as x tends to a, or beyond all bounds."""

    def prepare(self) -> None:
        self.vanishing = list[tuple[Any, int]]()  # formulas that vanish at the limit in so high an order
        self.at_end, self.writer = alone_edges.Edge(self), Writer(self)
        self.growing: Any = None  # u
        self.step: Any = None  # a ± y²
        if self.way:
            self.growing = self.base()
        elif self.side and self.radicands(self.f):
            y = Formula(".", (self.x,))
            self.start, self.ends = self.ends[0], [alone.number(0)] * 2
            square = product(alone.number(self.side), Formula("^", (y, alone.number(2))))
            self.step = Formula("+", (self.start, square))
            self.at_end, self.side = alone_edges.Edge(self), 1

    def made(self, kind: str, *given: Any) -> Any:
        free = kind == "elliptic_k" and kind not in {*self.names, *self.words, *self.texts} and len(given) == 1
        return Formula(kind, given) if free else super().made(kind, *given)

    def plain(self, f: Any) -> Any:
        """The formula with what definitions stand for written out."""
        texts = self.texts
        return put(f, lambda g: self.plain(self.known(texts[g.of[0]])) if g.kind == "." and g.of[0] in texts else None)

    def inside(self, f: Any) -> tuple[list[Any], bool]:
        """The exponents with the variable in a formula, and whether it is nowhere else."""
        if not self.has(f):
            return [], True
        if f.kind == "exp":
            return [f.of[0]], True
        if f.kind in (".", "D") or self.is_called(f):
            return [], f.kind == "." and f.of[0] in self.texts and self.inside(self.inner(f)[0])[1]
        each = [self.inside(g) for g in f.of if isinstance(g, Formula)]
        return [e for some, _ in each for e in some], all(alone_ for _, alone_ in each)

    def base(self) -> Any:
        """The polynomial u, with a denominator, of which all exponents are whole multiples, and that grows beyond all
        bounds; None where there is none."""
        signs = alone_signs.Signs(self)
        signs.everywhere = True
        exponents, only = self.inside(self.plain(self.f))
        if not exponents or not only:
            return None
        each = [signs.quotient(e) for e in exponents]
        ratios = [self.ratio(each[0], one) for one in each]
        if not all(ratios):
            return None
        common = lcm(*(r.denominator for r in ratios))
        share = Fraction(gcd(*(int(r * common) for r in ratios)), common)
        n, d = each[0]
        powers = of.by_powers(n, self.x)
        top = max(powers)
        grows = [s for s in (1, -1) if signs.shown(of.times(of.number(s), powers[top]), True)]
        own = all(name[0] != "#" for p in (n, d) for name in of.names_in(p)) and self.x not in of.names_in(d)
        if not grows or not own or top == 0:
            return None
        return of.times(of.number(share * grows[0] * (self.way or 1) ** top), n), d

    def ratio(self, a: of.Quotient, b: of.Quotient) -> Fraction:
        """b/a where this is a number; else 0."""
        p, q = of.times(a[0], b[1]), of.times(b[0], a[1])
        m = next(iter(p), None)
        r = q.get(m, Fraction(0)) / p[m] if m in p else Fraction(0)
        return r if q == of.times(of.number(r), p) else Fraction(0)

    def moved(self, f: Any) -> Any:
        """The formula in the new variable."""
        x = Formula(".", (self.x,))
        if not self.has(f):
            return f
        if self.growing:
            if not self.inside(self.plain(f))[1]:
                raise Stop("not shown", "a variable within exponents and elsewhere")
            signs = alone_signs.Signs(self)
            signs.everywhere = True

            def power(g: Any) -> Any:
                if g.kind != "exp" or not self.has(g):
                    return None
                n = self.ratio(self.growing, signs.quotient(g.of[0]))
                if n.denominator > 1 or not n:
                    raise Stop("not shown", "exponents that aren't multiples of one")
                return Formula("^", (x, alone.number(-n)))  # exp(n u) with x = exp(−u)

            return put(self.plain(f), power)
        if self.way or not self.step:
            return super().moved(f)
        return put(self.plain(f), lambda g: self.put_radicand(g))

    def radicands(self, f: Any) -> bool:
        """Whether a square root of what vanishes at the limit is in a formula."""
        roots = [g for g in self.parts(f) if g.kind == "^" and self.is_half(g) and self.has(g)]
        return any(not self.at_end.plain(self.at_end.quotient(g.of[0])[0]) for g in roots)

    def is_half(self, f: Any) -> bool:
        return f.of[1].kind == "#" and f.of[1].of[0].denominator == 2

    def put_radicand(self, g: Any) -> Any:
        """With a ± y² for x; of the square root of a polynomial its factors y are taken out."""
        if g == Formula(".", (self.x,)) or (g.kind == "." and g.of[0] == self.x):
            return self.step
        if g.kind == "D" or self.is_called(g):
            raise Stop("not shown", "a derivative, or a function, where a root vanishes")
        if g.kind != "^" or not self.is_half(g) or not self.has(g):
            return None
        radicand = put(g.of[0], self.put_radicand)
        signs = alone_signs.Signs(self)
        signs.everywhere = True
        n, d = signs.quotient(radicand)
        powers = of.by_powers(n, self.x)
        least = min(powers)
        if least == 0 or least % 2 or any(name[0] == "#" for name in (*of.names_in(n), *of.names_in(d))):
            return Formula("^", (radicand, g.of[1]))
        rest = {
            tuple((x, k - least * (x == self.x)) for x, k in m if (x, k) != (self.x, least)): c for m, c in n.items()
        }
        inner = product(self.text_of(rest), inverse(self.text_of(d)))
        outer = Formula("^", (Formula(".", (self.x,)), alone.number(least * g.of[1].of[0])))
        return product(outer, Formula("^", (inner, g.of[1])))

    def text_of(self, p: of.Polynomial) -> Any:
        """A polynomial as a formula."""
        return self.read(" + ".join(" * ".join((f"({c})", *(f"{x}**{k}" for x, k in m))) for m, c in p.items()))

    def split(self, f: Any) -> tuple[Any, Any]:
        """N and D of a formula N/D, where limits within it are taken."""
        if not self.has(f) or f.kind in ("D", ".", "+", "*") or self.is_called(f):
            return super().split(f)
        if f.kind == "^" and f.of[1].kind != "#":
            return self.split(Formula("exp", (Formula("*", (f.of[1], Formula("log", (f.of[0],)))),)))
        if f.kind == "^" and f.of[1].of[0].denominator == 1:
            return super().split(f)
        each = [self.split(g) if isinstance(g, Formula) else (g, ONE) for g in f.of]
        if f.kind == "elliptic_k" and each[0][1].of == (1,) and not self.value_of(each[0][0])[0]:
            c, terms = Fraction(1, 2), list[str]()
            for k in range(alone.HIGHEST + 2):
                terms.append(f"{c}*pi*m**{k}")
                c *= Fraction(2 * k + 1, 2 * k + 2) ** 2
            return self.read(" + ".join(terms[1:]) + f" + {terms[0]}".replace("*m**0", ""), {"m": each[0][0]}), ONE
        if f.kind == "atan" and each[0][1].of != (1,):
            try:
                order, sign = self.tends(*each[0])
            except Stop:
                order, sign = 0, 0
            if order < 0 and sign:
                turn = Formula("atan", (product(each[0][1], inverse(each[0][0])),))
                text = f"{sign}*pi/2 - a"
                return self.split(self.read(text, {"a": turn}))
        inner = [a if d.of == (1,) else self.removed(a, d) for a, d in each]
        return Formula(f.kind, tuple(inner), f.orders), ONE

    def removed(self, top: Any, bottom: Any) -> Any:
        """A quotient as a formula that is smooth at the limit."""
        self.at_end.check(top, strict=True)
        order, _ = self.at_end.first(bottom)
        if order == 0:
            return product(top, inverse(bottom))
        if any(g.kind == alone_edges.REMOVED for f in (top, bottom) for g in self.parts(f)):
            raise Stop("not shown", "limits within limits within limits")
        self.vanishing.append((top, order))
        return Formula(alone_edges.REMOVED, (top, bottom), (order,))

    def value_of(self, f: Any) -> of.Quotient:
        n, d = self.at_end.quotient(f)
        return self.at_end.plain(n), d

    def derivative(self, f: Any, n: int) -> Any:
        """∂ⁿf/∂xⁿ, written out."""
        found = self.writer.written(f)
        for _ in range(n):
            found = self.writer.slope(found, self.x)
        return found


def sample(claim: Tending, order: int, prime: int) -> int:
    """See at one point what the derivatives are."""
    point = alone_edges.Coming(claim, prime)
    point.check_domain()
    end = alone_edges.Coming(claim, prime, point, claim.ends[0])
    along = lambda k: (claim.x,) * k
    rest = [end.at(f, *along(k)) for f, n in (*claim.vanishing, (claim.top, order)) for k in range(n)]
    last = end.at(claim.top, *along(order)) - point.at(claim.equals) * end.at(claim.bottom, *along(order))
    if any(rest) or last % prime:
        raise Stop("not shown", "that this is the limit")
    return len(point.roots)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim."""
    claim = Tending(data["tables"])
    order, _ = claim.at_end.first(claim.bottom)
    claim.at_end.check(claim.top, strict=order > 0 or claim.value is not None)
    if claim.value is None:
        return alone.tried(sample, claim, order)
    grows, sign = claim.tends(claim.top, claim.bottom)
    if claim.vanishing:
        raise Stop("not shown", "what grows, with a limit in it")
    return ("shown", "") if grows < 0 and sign == claim.value else ("not shown", "that it grows beyond all bounds")


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
