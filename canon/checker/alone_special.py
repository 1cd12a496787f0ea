"""More functions for `alone.py` and its table: elliptic integrals, Jacobi's functions, moduli, and what is positive.

Here is how they are read, and what is seen of signs (`alone_signs.py`); `alone_values.py` has their values at a point.
The derivatives of elliptic integrals are known, as those of any function; |a| is √(a²). A name's value may be `given`
by a formula; derivatives by the name are taken before.
"""

from __future__ import annotations

import re
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
QUICK, UNIT = 17_000, frozenset({((), Fraction(1))})
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
JACOBI = ("jacobi_sn/2", "jacobi_cn/2", "jacobi_dn/2")
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


class Sides(Bounds):
    """Names by one bound alone: by two of them, L + (U − L) s/(1 + s), it takes as much luck that 1 + s is a square."""

    def use(self, p: of.Polynomial) -> None:
        before = {*self.put}
        super().use(p)
        for v in {*self.put} - before:
            if not {*of.names_in(self.put[v][1])} <= {*of.names_in(p)}:
                del self.put[v]


def names_of(f: Any, inner: Any = None) -> frozenset[str]:
    """The names that stand in a formula, also where it is differentiated; those of its parts may be known."""
    parts = [(inner or names_of)(x) for x in f.of if isinstance(x, Formula)]
    return frozenset({f.of[0]} if f.kind == "." else ()).union(*parts)


class Functions:
    """What is read otherwise."""

    form: Any = {}  # noqa: RUF012
    places: Any = ()
    besides: Any = ()
    nonzero: Any = ()
    names: Any
    words: Any
    texts: Any
    domain: Any
    signs: Any = None
    bounds: Any = None
    scale: Any = None
    chosen_too = True  # that positive names within bounds are squares, too
    bases, zero, loose = False, "", frozenset[int]()

    def __init__(self, tables: Any, *form: Any) -> None:
        self.given = dict[str, Any]()  # name: the formula that says its value
        self.facts = list[Any]()  # formulas that are positive wherever all formulas of the claim have values
        self.branches = dict[Any, Any]()  # an arc of a sine: what it is on the domain
        self.moduli = set[Any]()  # those of Jacobi's functions that are less than 1
        self.cosh = list[Any]()  # what hyperbolic cosines are taken of
        super().__init__(tables, *form)  # type: ignore[call-arg]
        self.outer, self.halves, self.is_positive = map(cache, (self.sloped, self.halves, self.is_positive))
        self.reach = cache(lambda f: names_of(f, self.reach))
        self.conditions = cache(self.conditions)
        self.formula, self.factor = cache(self.formula), cache(self.factor)
        self.is_above = cache(self.is_above)
        if KNOWN & {*self.names, *self.words, *self.texts}:
            raise Stop("not shown", "names with two meanings")
        self.settled = set[str]()
        self.choose(Bounds)

    def choose(self, of_kind: Any) -> None:
        """Choose names in their bounds."""
        try:
            self.bounds = of_kind(self)
            self.signs = self.signs or self.bounds
            named = {*self.bounds.roots, *self.bounds.seen.values()}
            self.put = {v: q for v, q in self.bounds.put.items() if not named & {v, *self.within(v)} and v != "pi"}
        except (Stop, ValueError, ArithmeticError):  # no sign is seen then
            self.signs, self.put = None, dict[str, of.Quotient]()
        self.settle(())

    def insist(self) -> None:
        """Let the domain's conditions be positive at each point, also those that hold as names are chosen."""
        self.facts = self.conditions()
        self.choose(Sides)

    def settle(self, names: Any) -> None:
        """Let bounds choose no value for these names, nor for those in whose bounds they are."""
        self.settled |= {*names}
        self.put = {v: q for v, q in self.put.items() if not {v, *self.within(v)} & self.settled}
        self.squares = {"pi"}.union(*map(self.within, self.put)) - {*self.names, *self.words, *self.put}
        self.squares |= {v for v, w in self.words.items() if "positive" in w} - {*self.put, *self.texts, *self.settled}
        self.is_positive.cache_clear()  # type: ignore[attr-defined]
        self.factor.cache_clear()  # type: ignore[attr-defined]

    def within(self, name: str) -> set[str]:
        """The names by which a name is given, and those by which these are."""
        given = {*of.names_in(self.bounds.put[name][0]), *of.names_in(self.bounds.put[name][1])}
        return given.union(*(self.within(v) for v in given if v in self.bounds.put))

    def made(self, kind: str, *of: Any) -> Any:
        if kind == "cosh" and len(of) == 1:
            self.cosh.append(of[0])
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
        """A formula as a quotient, `plainly` in the names by which others are chosen; None where no signs are seen."""
        if self.signs is None:
            return None
        signs = self.bounds if plainly else self.signs
        signs.work, signs.plainly = QUICK, plainly
        try:
            return signs.quotient(f)
        except (Stop, ValueError, ArithmeticError, RecursionError, AttributeError):
            return None
        finally:
            signs.plainly = False

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

    def is_function(self, name: str) -> bool:
        """Whether a name is declared as one."""
        return "function" in self.words.get(name, ())

    def conditions(self) -> list[Any]:
        """What is positive in the domain, or not negative."""
        found = list[Any]()
        for words in (re.split(r"(<=|>=|<|>)", text) for text in self.domain.get("where", [])):
            for a, sign, b in zip(words[::2], words[1::2], words[2::2], strict=False):
                found.append(self.known(f"({b}) - ({a})" if "<" in sign else f"({a}) - ({b})"))  # type: ignore
        return found

    def factor(self, f: Any) -> Any:
        """Two polynomials: of f times squares, of numbers and of the roots of names that are chosen as squares.

        What else is positive has a root that isn't: its square's root may be it, or less it, modulo a prime.
        """
        with suppress(Stop, ValueError, ArithmeticError, RecursionError, TypeError):
            return tuple(map(self.rest, self.sign_of(f, plainly=True)))
        return None

    def rest(self, p: of.Polynomial) -> Any:
        """A polynomial less the factors that are such squares."""
        least = {v: min(dict(m).get(v, 0) for m in p) for v in of.names_in(p) if v in self.squares}
        less = {tuple((v, k - least.get(v, 0)) for v, k in m if k > least.get(v, 0)): c for m, c in p.items()}
        size = abs(less[min(less)])
        if pow(alone.MODULUS, alone.LONGEST, _size(size)):
            raise Stop("not shown", "a number without a root that is known")
        return frozenset((m, c / size) for m, c in less.items())

    def is_bound(self, f: Any) -> bool:
        """Whether a condition is one that the names within their bounds fulfil, of one among them."""
        divided = (self.factor(f) or (0, 0))[1] != UNIT
        return divided and bool(self.reach(f) & {*self.put}) and self.is_above(f)

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
        named = f.kind == "." and f.of[0] in self.squares
        small = f.kind == "#" and f.of[0] > 0 and pow(alone.MODULUS, alone.LONGEST, _size(f.of[0])) == 0
        return named or small or (f.kind == "*" and all(map(self.is_positive, f.of)))


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
