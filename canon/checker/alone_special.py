"""More functions for `alone.py` and its table: elliptic integrals, Jacobi's functions, moduli, and what is positive.

Here is how they are read, and what is seen of signs (`alone_signs.py`); `alone_values.py` has their values at a point.
The derivatives of elliptic integrals are known, as those of any function; |a| is √(a²).
"""

from __future__ import annotations

from contextlib import suppress
from fractions import Fraction
from functools import cache
from typing import Any

if __package__:
    from canon.checker import alone, alone_signs, alone_wider
    from canon.checker import alone_polynomials as of
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_polynomials as of  # type: ignore
    import alone_signs  # type: ignore
    import alone_wider  # type: ignore

Formula, Stop = alone.Formula, alone.Stop
QUICK = 17_000
_FALL = "((1 - b)*a - jacobi_epsilon(a, b))"
MORE = {
    "elliptic_k": ["elliptic_e(a)/(2*a*(1 - a)) - elliptic_k(a)/(2*a)"],
    "elliptic_e": ["(elliptic_e(a) - elliptic_k(a))/(2*a)"],
    "elliptic_f/2": ["(1 - b*sin(a)**2)**(-1/2)", "elliptic_e(a, b)/(2*b*(1 - b)) - elliptic_f(a, b)/(2*b)"
        " - sin(a)*cos(a)/(2*(1 - b)*sqrt(1 - b*sin(a)**2))"],
    "elliptic_e/2": ["sqrt(1 - b*sin(a)**2)", "(elliptic_e(a, b) - elliptic_f(a, b))/(2*b)"],
    "jacobi_sn/2": ["jacobi_cn(a, b)*jacobi_dn(a, b)", "jacobi_cn(a, b)*(jacobi_dn(a, b)*" + _FALL +
        " + b*jacobi_sn(a, b)*jacobi_cn(a, b))/(2*b*(1 - b))"],
    "jacobi_cn/2": ["-jacobi_sn(a, b)*jacobi_dn(a, b)", "-jacobi_sn(a, b)*(jacobi_dn(a, b)*" + _FALL +
        " + b*jacobi_sn(a, b)*jacobi_cn(a, b))/(2*b*(1 - b))"],
    "jacobi_dn/2": ["-b*jacobi_sn(a, b)*jacobi_cn(a, b)", "-jacobi_sn(a, b)*(jacobi_sn(a, b)*jacobi_dn(a, b)"
        " + jacobi_cn(a, b)*" + _FALL + ")/(2*(1 - b))"],
    "jacobi_epsilon/2": ["jacobi_dn(a, b)**2", "(jacobi_sn(a, b)*jacobi_cn(a, b)*jacobi_dn(a, b)"
        " - (1 - b)*a*jacobi_sn(a, b)**2 - jacobi_epsilon(a, b)*jacobi_cn(a, b)**2)/(2*(1 - b))"],
}  # fmt: skip
"""The derivatives by the arguments a and b; of a function that there is with one and two, of either."""
WORDS = {"abs": "sqrt(a**2)", "sign": "a/sqrt(a**2)"}
KNOWN = {*(name.partition("/")[0] for name in MORE), *WORDS}


class Bounds(alone_signs.Signs):
    """Bounds are of variables rather than of parameters; sines and cosines may be names of their own."""

    plainly = False

    def late(self, v: str) -> tuple[bool, str]:
        return v not in self.claim.variables, v

    def turn(self, sine: bool, angle: Any) -> of.Quotient:
        if not self.plainly:
            return super().turn(sine, angle)
        return of.named(self.new((sine, self.structure(angle)), False)), of.ONE


class Functions:
    """What is read otherwise."""

    form: Any = {}  # noqa: RUF012
    names: Any
    words: Any
    texts: Any
    domain: Any
    signs: Any
    scale: Any = None
    chosen_too = True  # that positive names within bounds are squares, too
    bases, zero, loose = False, "", frozenset[int]()

    def __init__(self, tables: Any, *form: Any) -> None:
        super().__init__(tables, *form)  # type: ignore[call-arg]
        self.outer, self.halves, self.is_positive = map(cache, (self.sloped, self.halves, self.is_positive))
        self.reach = cache(self.reach)
        self.formula, self.factor = cache(self.formula), cache(self.factor)
        self.is_above = cache(self.is_above)
        if KNOWN & {*self.names, *self.words, *self.texts}:
            raise Stop("not shown", "names with two meanings")
        try:
            self.signs = Bounds(self)  # type: ignore[arg-type]
            named = {*self.signs.roots, *self.signs.seen.values()}
            self.put = {v: q for v, q in self.signs.put.items() if not named & {v, *self.within(v)} and v != "pi"}
            self.chosen = {"pi"}.union(*map(self.within, self.put)) - {*self.names, *self.words, *self.put}
            self.chosen |= {v for v, w in self.words.items() if "positive" in w} - {*self.put, *self.texts}
        except (Stop, ValueError, ArithmeticError):  # no sign is seen then
            self.signs, self.put, self.chosen = None, dict[str, of.Quotient](), set[str]()

    def within(self, name: str) -> set[str]:
        """The names by which a name is given, and those by which these are."""
        given = {*of.names_in(self.signs.put[name][0]), *of.names_in(self.signs.put[name][1])}  # type: ignore
        return given.union(*(self.within(v) for v in given if v in self.signs.put))

    def made(self, kind: str, *of: Any) -> Any:
        if kind not in KNOWN:
            return super().made(kind, *of)  # type: ignore[misc]
        if kind in WORDS and len(of) == 1:
            return self.read(WORDS[kind], {"a": of[0]})  # type: ignore
        full = kind if kind in MORE and len(of) == 1 else f"{kind}/{len(of)}"
        if full not in MORE or (full == kind and len(of) != 1):
            raise Stop("not shown", f"what is given to {kind[:40]}")
        return Formula(full, of)

    def sloped(self, f: Any, k: int) -> Any:
        """∂f/∂(its k-th argument); that of a is 1 where a is 0, too."""
        if f.kind in MORE:
            return self.read(MORE[f.kind][k], dict(zip("ab", f.of, strict=False)))  # type: ignore
        if f.kind == "^" and k == 0 and f.of[1].kind == "#" and f.of[1].of[0] in (0, 1):
            return alone.number(f.of[1].of[0])
        return alone.Claim.outer(self, f, k)  # type: ignore[arg-type]

    def sign_of(self, f: Any, *, plainly: bool = False) -> Any:
        """A formula as a quotient; None where no signs are seen."""
        if self.signs is None:
            return None
        self.signs.work, self.signs.plainly = QUICK, plainly
        try:
            return self.signs.quotient(f)
        except (Stop, ValueError, ArithmeticError, RecursionError, AttributeError):
            return None
        finally:
            self.signs.plainly = False

    def is_above(self, f: Any, strict: bool = True) -> bool:
        """Whether a formula is seen to be positive in the domain, or not to be negative."""
        q = self.sign_of(f)
        with suppress(Stop):
            self.signs.work = QUICK
            return q is not None and self.signs.shown(q[0], strict)
        return False

    def formula(self, text: str, *of: Any) -> Any:
        """A formula of others, which are called a and b in it."""
        return self.read(text, dict(zip("ab", of, strict=False)))  # type: ignore

    def reach(self, f: Any) -> set[str]:
        """The names in a formula."""
        return {*f.of} if f.kind == "." else set[str]().union(*(self.reach(g) for g in f.of if isinstance(g, Formula)))

    def factor(self, f: Any) -> Any:
        """A polynomial: a formula times squares, of numbers and of the roots of names that are chosen as squares.

        What else is positive has a root that isn't: its square's root may be it, or less it, modulo a prime.
        """
        with suppress(Stop, ValueError, ArithmeticError, RecursionError, TypeError):
            p, d = self.sign_of(f, plainly=True)
            low, *others = d.items()
            chosen = [v for v in of.names_in(p) if v in self.chosen]
            least = {v: min(dict(m).get(v, 0) for m in p) for v in chosen}
            size, plain = abs(p[min(p)]), all(v in self.chosen for v, _ in low[0]) and not others
            if plain and low[1] > 0 and pow(alone.MODULUS, alone.LONGEST, _size(size) * _size(low[1])) == 0:
                rest = lambda m: tuple((v, k - least.get(v, 0)) for v, k in m if k > least.get(v, 0))
                return frozenset((rest(m), c / size) for m, c in p.items())
        return None

    def is_bound(self, text: str) -> bool:
        """Whether a condition is one that the names within their bounds fulfil, of one among them."""
        f = self.formula(text)
        return self.factor(f) is None and bool(self.reach(f) & {*self.put}) and self.is_above(f)

    def halves(self, f: Any) -> tuple[int, ...]:
        """The quarters k for which an angle is seen to be between k π/2 and (k + 2) π/2."""
        if "pi" not in str(self.domain):
            return ()
        edge = lambda k: self.read(f"a - {k}*pi/2", {"a": f})  # type: ignore
        back = lambda k: self.read(f"{k + 2}*pi/2 - a", {"a": f})  # type: ignore
        return tuple(k for k in range(-3, 4) if self.is_above(edge(k)) and self.is_above(back(k)))

    def is_positive(self, f: Any) -> bool:
        """Whether a formula is a product of powers of numbers and names that are positive."""
        if f.kind == "." and f.of[0] in self.texts:
            return self.is_positive(self.known(self.texts[f.of[0]]))  # type: ignore
        if f.kind == "^":
            return f.of[1].kind == "#" and self.is_positive(f.of[0])
        named = f.kind == "." and (f.of[0] == "pi" or "positive" in self.words.get(f.of[0], ()))  # type: ignore
        small = f.kind == "#" and f.of[0] > 0 and pow(alone.MODULUS, alone.LONGEST, _size(f.of[0])) == 0
        return (named and f.of[0] not in self.put) or small or (f.kind == "*" and all(map(self.is_positive, f.of)))


def _size(r: Fraction) -> int:
    return r.numerator * r.denominator


def is_above_everywhere(claim: Any, f: Any) -> bool:
    """Whether a formula is seen to be positive at all places, those at which an angle is π among them."""
    with suppress(Stop, ValueError, ArithmeticError, RecursionError):
        first = Bounds(claim)
        first.quotient(f)
        if len(first.angles) <= 3:
            flats = [[k for n, k in enumerate(first.angles) if way >> n & 1] for way in range(1 << len(first.angles))]
            return all((signs := Bounds(claim, flat)).shown(signs.quotient(f)[0], True) for flat in flats)
    return False


class Small(Functions, alone.Claim):
    """A claim that `alone` knows."""


class Wide(Functions, alone_wider.Wider):
    """One of the table."""
