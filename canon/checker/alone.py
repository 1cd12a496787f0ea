"""A checker in one file, of Python's standard library alone: `python alone.py CERTIFICATE.json …`

From the claim's own text it derives what must vanish, and sees that it is 0 at random points modulo random primes, and
the certificate's numerator over its denominator; that the relations are 0 there; and that with kernels that are free
numerator = Σ cofactor · relation. Refutations are what counterexample.py is for.

Positive means: a square. For p = −1 mod 24·3·5⋯23 the squares are a group of odd order: x^r, r rational, is one
number, √x √y = √(xy), √(x²) is x or −x, −1 is no square, as with real numbers. Names that are positive, radicands and
what the domain's conditions say to be positive have to be squares; other points are thrown away. A term of an angle is
a point on the circle, one of an exponent a square; of other functions only the derivatives are known. What holds of
these holds wherever the formulas have real values: primes and points at which all roots behave as at a real one aren't
rare (Chebotarev's theorem); more roots, more points. A wrong claim passes about once in e^TRIALS times.
"shown": the claim holds where its formulas have values. "not shown": not by this file. "wrong": something isn't so.
"""

import ast
import hashlib
import json
import re
import sys
import unicodedata
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, lru_cache
from itertools import chain, combinations, compress, count, product
from math import gcd, prod
from pathlib import Path
from random import SystemRandom
from typing import Any

TRIALS, MOST_ROOTS, MOST_TERMS, MOST_TRIED, LONGEST, MOST_VALUES, HIGHEST = 25, 5, 40, 500, 4000, 200_000, 8
MODULUS, SMALL, RANDOM = 24 * prod((3, 5, 7, 11, 13, 17, 19, 23)), (1, -1, 2, -2, 3, -3, 4, 5, 6, 7, 8), SystemRandom()
SLOPES = {"+": ["1", "1"], "*": ["b", "a"], "^": ["b*a**(b - 1)"], "sin": ["cos(a)"], "cos": ["-sin(a)"],
    "exp": ["exp(a)"], "log": ["1/a"], "asin": ["(1 - a**2)**(-1/2)"], "acos": ["-(1 - a**2)**(-1/2)"],
    "atan": ["1/(1 + a**2)"], "atan2": ["b/(a**2 + b**2)", "-a/(a**2 + b**2)"], "asinh": ["(a**2 + 1)**(-1/2)"],
    "acosh": ["(a - 1)**(-1/2)*(a + 1)**(-1/2)"], "atanh": ["1/(1 - a**2)"]}  # fmt: skip
MEANINGS = {"-": "a + (-1)*b", "/": "a*b**(-1)", "sqrt": "a**(1/2)", "cbrt": "a**(1/3)", "tan": "sin(a)/cos(a)",
    "cot": "cos(a)/sin(a)", "sec": "1/cos(a)", "csc": "1/sin(a)", "sinh": "(exp(a) - exp(-a))/2",
    "cosh": "(exp(a) + exp(-a))/2", "tanh": "1 - 2/(exp(2*a) + 1)", "coth": "1 + 2/(exp(2*a) - 1)"}  # fmt: skip
SIGNS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "^", ast.UAdd: 1, ast.USub: -1}
FIELD, UNASKED = ["D(_H, {p}) - _qdot{i}", "D(_H, {q}) + _pdot{i}"], ("kind", "title", "source", "expect", "budget")
KINDS = {"identity": ["_lhs - _rhs"], "bracket": ["bracket(_f, _g) - _equals"],
    "conserved": ["D(_f, {t}) + bracket(_f, _H)"], "equations_of_motion": FIELD, "hamiltonian_field": FIELD,
    "jacobi": ["bracket(_f, bracket(_g, _h)) + bracket(_g, bracket(_h, _f)) + bracket(_h, bracket(_f, _g))"],
    "infinitesimal": ["D(_generator, {p}) - _dq{i}", "D(_generator, {q}) + _dp{i}"]}  # fmt: skip
"""What vanishes, for each degree of freedom where it says so; _f is what the claim has under f."""
MAPS = ("canonical", "fundamental_brackets", "new_hamiltonian", "generates", "generating_function")
SECTIONS = {"phase_space": {*"qpQP", "time"}, "hamiltonian": {"H"}, "transformation": {*"qpQP"}, "domain": {"where"},
    MAPS[-1]: {"type", "F"}, "claim": 0, "symbols": 0, "definitions": 0, "title": 0, "source": 0}  # fmt: skip
"""The sections of a file, and their keys where these are always the same."""
OWN = {"hamiltonian_field": ["H"], "canonical": ["scale"], "generating_function": ["type", "F"]}
"""Keys that claims of these kinds alone have."""
TYPES, GIVES = {1: "qQ", 2: "qP", 3: "pQ", 4: "pP"}, {"q": "p-", "p": "q+", "Q": "P+", "P": "Q-"}
"""p − ∂F/∂q = 0, q + ∂F/∂p = 0, P + ∂F/∂Q = 0, Q − ∂F/∂P = 0."""
factors = lru_cache(MOST_VALUES)(lambda m: [(x, int(n or 1)) for x, _, n in (y.partition("^") for y in m.split())])


class Stop(Exception):
    """The end of a check: (the answer, the reason)."""


class Elsewhere(Exception):
    """A point at which something isn't positive that has to be."""


@dataclass(frozen=True, eq=False)
class Formula:
    """Of kind "#" (a number), "." (a name), "D" (its derivative by the names in `orders`), or a key of SLOPES, or a
    function that is declared, with orders of derivatives."""

    kind: str
    of: tuple[Any, ...]
    orders: tuple[Any, ...] = ()


def formulas(tables: Any) -> str:
    """All that is written in a file about one claim, but for what is there for people: it has no meaning."""
    said = lambda part: {key: x for key, x in part.items() if key not in ("title", "source")}
    return json.dumps([{**said(tables), "claim": said(tables["claim"])}], ensure_ascii=False)


def number(r: Any) -> Formula:
    if not isinstance(r, str) or (len(r) < LONGEST and not re.search(r"[eE][-+]?[\d_]{4}", r)):
        if max(map(int.bit_length, (r := Fraction(r)).as_integer_ratio())) < LONGEST:
            return Formula("#", (r,))
    raise Stop("not shown", "a number that is so long")


class Claim:
    """What a claim asks for: the texts in `zeros` vanish."""

    scales: Any = frozenset(Fraction(a, b) for a in SMALL for b in SMALL)

    def __init__(self, tables: Any) -> None:
        self.known, self.outer = cache(self.read), cache(self.outer)
        tables = json.loads(re.sub(r"\\([nrtfb]|u00[01].)", " ", json.dumps(tables)))
        space, self.kind, self.domain = tables["phase_space"], tables["claim"]["kind"], tables.get("domain", {})
        claim = {key: value for key, value in tables["claim"].items() if key not in UNASKED}
        sides = {side: space.get(side, []) for side in "qpQP"}
        self.words = {n: [w] if isinstance(w, str) else w for n, w in tables.get("symbols", {}).items()}
        self.names, whole = [*chain(*sides.values()), space.get("time", "t")], formulas(tables)
        self.texts, explicit = dict(tables.get("definitions", {})), tables.get("transformation", {})
        named = [*self.texts, *self.names, *({*self.words} - {*self.names})]
        every = [*named, "pi", "D", "bracket", *SLOPES, *MEANINGS]
        odd = re.search(r"(?<!\w)_", whole) or unicodedata.normalize("NFKC", whole) != whole
        odd = odd or {*tables} - {*SECTIONS} or any({*tables.get(s, {})} - k for s, k in SECTIONS.items() if k)
        odd = odd or max(len(every), len(claim.get("functions", ()))) > 4 * MOST_TERMS
        if len({*every}) < len(every) or odd or "complex" in str(self.words) or not all(map(str.isidentifier, named)):
            raise Stop("not shown", "names with two meanings, complex ones, of another form, or so many")
        for key, value in ((tables.get("hamiltonian", {}) if self.kind not in OWN else {}) | claim).items():
            self.texts |= {f"_{key}{i}": x for i, x in enumerate(value if isinstance(value, list) else ())}
            self.texts[f"_{key}"] = value
        self.pairs, self.variables = [*zip(sides["q"], sides["p"], strict=True)], self.names
        if self.kind in MAPS or {*sides["Q"], *sides["P"]} & {*re.findall(r"\w+", str([*self.texts.values()]))}:
            self.zeros = self.of_map(sides, explicit, claim if self.kind == MAPS[-1] else tables.get(MAPS[-1], {}))
        elif self.kind == "involution":
            pairs = combinations(range(len(claim["functions"])), 2)
            self.zeros = [f"bracket(_functions{i}, _functions{j})" for i, j in pairs]
        else:
            each = [(row, i, *pair) for row in KINDS[self.kind] for i, pair in enumerate(self.pairs)]
            self.zeros = [*dict.fromkeys(row.format(i=i, q=q, p=p, t=self.names[-1]) for row, i, q, p in each)]
        lists = {len(v) for key, v in claim.items() if isinstance(v, list) and key not in ("type", "functions")}
        asked = re.findall(r"(?<!\w)_([a-zA-Z]+)", str([self.zeros, *self.texts.values()]))
        unread = {*claim} - ({*asked} - {*chain(*OWN.values())} | {*OWN.get(self.kind, ())})
        if not self.zeros or unread or lists - {len(self.pairs)}:
            raise Stop("not shown", f"what {min(unread, default='it')[:40]} says")

    def of_map(self, sides: Any, explicit: Any, generating: Any) -> list[str]:
        """Of a map: its generating function's equations; or brackets, and the gradient of K − cH."""
        n, forward, types = len(sides["q"]), "Q" in explicit, generating.get("type", [])
        if [*map(len, sides.values())] != [n] * 4 or {*explicit} not in ({*"QP"}, {*"qp"}) or self.kind not in MAPS:
            raise Stop("not shown", "a claim about new variables that isn't about a map of old ones to as many")
        inner = lambda f: (x for x in f.of if isinstance(x, Formula))
        names = cache(lambda f, D=1: {*(f.of + f.orders) * D}.union(*(names(x, D or x.kind == "D") for x in inner(f))))
        parts = re.split("[<>=!]+", "<".join(["0", *self.domain.get("where", [])]))
        parts += [self.texts.get(key, 0) for key in ("_K", "_H", "_scale")]
        if names(Formula("", (*map(self.known, parts),)), False) & {*chain(*(sides[side] for side in explicit))}:
            raise Stop("not shown", "a derivative, or a bracket, of what a map gives")
        self.known.cache_clear()  # from here on these names are the map's formulas
        self.texts |= dict(chain(*(zip(sides[side], explicit[side], strict=True) for side in explicit)))
        if self.kind in MAPS[-2:]:
            self.texts["_F"], types = generating["F"], [types] * n if isinstance(types, int) else types
            places = [(*GIVES[side], side, i) for i, one in zip(range(n), types, strict=True) for side in TYPES[one]]
            if names(self.known(self.texts["_F"])) & ({*self.names[:-1]} - {sides[side][i] for *_, side, i in places}):
                raise Stop("not shown", "what the other variables do in a generating function")
            return [f"{sides[other][i]} {sign} D(_F, {sides[side][i]})" for other, sign, side, i in places]
        X, Y = ([*sides[a], *sides[b]] for a, b in (("QP", "qp") if forward else ("qp", "QP")))
        self.pairs, self.variables = [*zip(Y[:n], Y[n:], strict=True)], [*Y, self.names[-1]]
        scaled, inverse = self.kind == "new_hamiltonian", "" if forward else "1/"
        self.texts.setdefault("_scale", f"{inverse}bracket({X[0]}, {X[n]})" if scaled else "1")
        pairs = combinations(range(2 * n), 2)
        zeros = [f"bracket({X[i]}, {X[j]})" + f" - {inverse}_scale" * (j == i + n) for i, j in pairs]
        zeros += [f"D(_scale, {u})" for u in self.variables if scaled]
        return zeros + [f"D(_K - _scale*_H, {u}) + {moved(sides, u, self.names[-1])}" for u in Y if scaled]

    def read(self, text: Any, own: Any = None) -> Formula:
        """The formula of a text; `own` are names that stand for formulas. Names get a mark: none is Python's."""
        plain = re.sub(r"[^\w ()\[\],.+*/-]", "?", " ".join(str(text).split()))
        marked = re.sub(r"(?<![\w.])[^\W\d]\w*", r"_\g<0>", plain)
        return self.built(ast.parse(marked, mode="eval").body, marked, own or {})

    def built(self, at: Any, text: str, own: Any) -> Formula:
        """The formula of a syntax tree in this text."""
        if isinstance(at, ast.BinOp):
            return self.made(SIGNS[type(at.op)], *(self.built(side, text, own) for side in (at.left, at.right)))
        if isinstance(at, ast.UnaryOp):
            return self.made("*", number(SIGNS[type(at.op)]), self.built(at.operand, text, own))
        if isinstance(at, ast.Constant):
            return number(ast.get_source_segment(text, at))
        if isinstance(at, ast.Name):
            name = at.id[1:]
            if name in own or (name in self.texts and name not in self.variables):
                return own[name] if name in own else self.known(self.texts[name])
            if "function" in self.words.get(name, ()) or name not in {*self.names, *self.words, "pi"}:
                raise Stop("not shown", f"what {name.strip('_')[:40]} is")
            return Formula(".", (name,))
        of, orders, x = at.func, (), [self.built(item, text, own) for item in (*at.args, *at.keywords)]
        if isinstance(of, ast.Subscript):  # V[1](r), in certificates, is V'(r)
            of, orders = of.value, tuple(int(item.value) for item in getattr(of.slice, "elts", [of.slice]))
        name = getattr(of, "id", "_")[1:]
        if name == "bracket":
            each = " + ".join(f"D(a, {q})*D(b, {p}) - D(a, {p})*D(b, {q})" for q, p in self.pairs)
            return self.read(each, dict(zip("ab", x, strict=True)))
        if name == "D":
            if (by := at.args[1].id[1:]) not in self.variables and (by not in self.words or by in self.texts):
                raise Stop("not shown", f"a derivative by {by}")
            return Formula("D", (x[0],), (by,) * range(HIGHEST + 1).index(*[f.of[0] for f in x[2:]] or [1]))
        if "function" in self.words.get(name, ()):
            return Formula(name, tuple(x), orders or (0,) * len(x))
        return self.made(name, *x, *orders)

    def made(self, kind: str, *of: Any) -> Formula:
        """Of numbers a number; of what MEANINGS says in other words, these."""
        own, r = dict(zip("ab", of, strict=False)), [f.of[0] for f in of if f.kind == "#"]
        if kind not in {*SLOPES, *MEANINGS} or len(of) != (2 if kind in ("atan2", *"+-*/^") else 1):
            raise ValueError(f"what is given to {kind[:40]}")
        if kind in "+*^" and len(r) == 2 and (kind != "^" or (r[1] % 1 == 0 and abs(r[1]) < LONGEST)):
            return number(sum(r) if kind == "+" else prod(r) if kind == "*" else r[0] ** int(r[1]))
        return self.read(MEANINGS[kind], own) if kind in MEANINGS else Formula(kind, of)

    def outer(self, f: Formula, k: int) -> Formula:
        """∂f/∂(its k-th argument)."""
        if f.orders:
            return Formula(f.kind, f.of, tuple(n + (j == k) for j, n in enumerate(f.orders)))
        return self.read(SLOPES[f.kind][k], dict(zip("ab", f.of, strict=False)))


def moved(sides: Any, a: str, b: str) -> str:
    """Lagrange's bracket of two coordinates, Σ ∂q/∂a ∂p/∂b − ∂p/∂a ∂q/∂b, of new ones less scale · of old ones."""
    pairs = [zip(sides[half[0]], sides[half[1]], strict=True) for half in ("QP", "qp")]
    new, old = (" + ".join(f"D({q}, {a})*D({p}, {b}) - D({p}, {a})*D({q}, {b})" for q, p in half) for half in pairs)
    return f"{new} - _scale*({old})"


class Point:
    """A random point modulo a prime, and what formulas are there."""

    def __init__(self, claim: Claim, prime: int) -> None:
        self.claim, self.p, self.half, self.free, self.count = claim, prime, (prime - 1) // 2, dict[Any, int](), count()
        self.roots, self.sure = set[int](), set[int]()
        self.at, self.terms = cache(self.at), cache(self.terms)

    def any(self, *key: Any) -> int:
        """A random number for what nothing is known of but that it is the same where the key is."""
        return self.free.setdefault(key, RANDOM.randrange(2, self.p))

    def fraction(self, r: Any, order: int) -> int:
        return Fraction(r).numerator * pow(Fraction(r).denominator, -1, order) % order

    def root(self, x: int, r: Fraction) -> int:
        """x^r."""
        return pow(*(x, int(r)) if r.denominator == 1 else (self.square(x), self.fraction(r, self.half)), self.p)

    def text(self, text: str) -> int:
        return self.at(self.claim.known(text))

    def check_domain(self) -> None:
        """See that what has to be positive in the domain is."""
        for words in (re.split(r"(<=|>=|<|>)", text) for text in self.claim.domain.get("where", [])):
            for a, sign, b in zip(words[::2], words[1::2], words[2::2], strict=False):
                self.square(self.text(f"({b}) - ({a})" if "<" in sign else f"({a}) - ({b})"))

    def square(self, x: int) -> int:
        """What has to be positive."""
        if pow(x, self.half, self.p) != 1:
            raise Elsewhere
        return x

    def at(self, f: Formula, *by: str) -> int:
        """The derivative of a formula by the names: by the chain rule, one after the other; of a sum, of its terms."""
        if len(by) > HIGHEST or next(self.count) > MOST_VALUES:
            raise Stop("not shown", "so many derivatives, or so high ones")
        if f.kind == "D":
            return self.at(f.of[0], *sorted((*by, *f.orders)))
        if not by or f.kind in "#.":
            return self.value(f) if not by else int(by == f.of)
        found = 0 * self.at(f)  # where it has no value, it has no slope
        for (k, x), taken in product(enumerate(f.of), product((1, 0)[: 1 + (f.kind != "+")], repeat=len(by) - 1)):
            if steep := self.at(x, by[0], *compress(by[1:], taken)):
                found += steep * self.at(self.claim.outer(f, k), *compress(by[1:], (not one for one in taken)))
        return found % self.p

    def value(self, f: Formula) -> int:
        if f.kind in "#.":
            return self.named(f.of[0]) if f.kind == "." else self.fraction(f.of[0], self.p)
        a = [self.at(x) for x in f.of]
        if f.kind in "+*":
            return (sum(a) if f.kind == "+" else prod(a)) % self.p
        if f.kind == "^":
            r, n = f.of[1].of[0], prod(f.of[0].of[0].as_integer_ratio()) if f.of[0].kind == "#" else MODULUS + 1
            self.roots |= {a[0]} - self.sure if r.denominator % 2 == 0 and pow(MODULUS, LONGEST, n) else set()
            return self.root(a[0], r)
        if f.kind == "exp":
            return prod(self.root(self.any("exp", v) ** 2, r) for v, r in self.terms(f.of[0]).items()) % self.p
        if f.kind in ("sin", "cos"):
            return self.circle(self.terms(f.of[0]))[f.kind == "sin"]
        return self.any(f.kind, f.orders, *a)

    def named(self, name: str) -> int:
        """The value of a name: of what stands for it, or a number that has its sign."""
        if name in self.claim.texts:
            return self.at(self.claim.known(self.claim.texts[name]))
        value, said = self.any(name), {*self.claim.words.get(name, ())}
        if said & {"positive", "negative", "nonnegative"} or name == "pi":
            value = value**2 * (-1 if "negative" in said else 1) % self.p
            self.sure.add(value)
        return value

    def terms(self, f: Formula) -> dict[int, Fraction]:
        """What a formula is the sum of: {the value of a product: its rational factor}."""
        if f.kind == "#":
            return {1: f.of[0]} if f.of[0] else {}
        if f.kind == "." and f.of[0] in self.claim.texts:
            return self.terms(self.claim.known(self.claim.texts[f.of[0]]))
        a, found = [self.terms(x) for x in f.of if f.kind in "+*^"], dict[int, Fraction]()
        if f.kind == "+" or (f.kind == "*" and prod(map(len, a)) <= MOST_TERMS):
            ways = product(*(x.items() for x in a)) if f.kind == "*" else ([one] for x in a for one in x.items())
            for way in ways:
                v = prod(v for v, _ in way) % self.p
                found[v] = number(found.get(v, 0) + prod(r for _, r in way)).of[0]
            return {v: r for v, r in found.items() if r}
        if f.kind == "^" and len(a[0]) == 1 and (n := f.of[1].of[0]).denominator == 1 and abs(n) < LONGEST:
            return {self.root(v, n): number(r ** int(n)).of[0] for v, r in a[0].items()}
        return {self.at(f): Fraction(1)}

    def circle(self, terms: dict[int, Fraction]) -> tuple[int, int]:
        """(cos, sin) of a sum: for each term the power of a random point on the circle."""
        c, s, p = 1, 0, self.p
        for value, r in terms.items():
            u, n = self.any("circle", value), r * MODULUS**2
            x, y = (1 - u * u) * pow(1 + u * u, -1, p), 2 * u * pow(1 + u * u, -1, p) * (1 if n > 0 else -1)
            if n.denominator > 1:
                raise Stop("not shown", "a part of an angle")
            for bit in f"{abs(int(n)):b}"[::-1]:
                c, s = ((c * x - s * y) % p, (c * y + s * x) % p) if bit == "1" else (c, s)
                x, y = (x * x - y * y) % p, 2 * x * y % p
        return c, s


def random_prime() -> int:
    """A prime of some 127 bits that is −1 modulo MODULUS, by Fermat's test, as it is a random number."""
    while True:
        p = MODULUS * (RANDOM.getrandbits(94) + 2**94) - 1
        if gcd(p, prod(range(29, 99, 2))) < 2 and all(pow(RANDOM.randrange(p), p - 1, p) == 1 for _ in range(12)):
            return p


def sample(claim: Claim, case: Any, prime: int, of: Any = Point, besides: Any = None) -> int:
    """Put one random point into everything; returns the number of roots that were met."""
    point, own = of(claim, prime), {}
    point.check_domain()
    at = cache(lambda c: point.fraction(number(c).of[0], prime))

    def put(polynomial: Any, kernel: Any) -> int:
        """A polynomial's value, of {"g1^2 x": "3/2"}."""
        return sum(at(c) * prod(pow(kernel(x), n, prime) for x, n in factors(m)) for m, c in polynomial.items()) % prime

    # the claim first: a kernel's root may throw points away; a scale is one number everywhere, which sign(x) isn't
    claim.scales = {r for r in claim.scales if point.text(claim.texts.get("_scale", "1")) == point.fraction(r, prime)}
    if any(map(point.text, claim.zeros)) or not claim.scales:
        raise Stop("not shown", "that all of it is 0, and the scale a number that isn't 0")
    _ = besides and besides(point)
    for k in case["kernels"]:
        own[k["name"]] = claim.read(k["stands for"], own)
    kernel, free = cache(lambda name: point.at(claim.read(name, own))), cache(lambda name: RANDOM.randrange(prime))
    relations = {k["name"]: put(k.get("relation", {}), free) for k in case["kernels"]}
    if any(put(k.get("relation", {}), kernel) for k in case["kernels"]):
        raise Stop("not shown", "a relation")
    for text, entry in zip(claim.zeros, case["residuals"], strict=True):
        parts = sum(put(cofactor, free) * relations[name] for name, cofactor in entry["cofactors"].items())
        if (put(entry["numerator"], free) - parts) % prime:
            raise Stop("wrong", "a numerator isn't the sum of cofactors times relations")
        if put(entry["numerator"], kernel) or not put(entry["denominator"], kernel):
            raise Stop("not shown", f"{text[:60]} isn't seen to be 0 and the fraction that is stated")
    return len(point.roots)


def tried(put: Any, *of: Any) -> tuple[str, str]:
    """The answer that as many random points give as are needed."""
    done, tried, needed = 0, 0, TRIALS
    while done < needed:
        if (tried := tried + 1) > MOST_TRIED + 40 * done or needed > TRIALS << MOST_ROOTS:
            raise Stop("not shown", "points at which everything is positive that has to be, or so many roots")
        with suppress(Elsewhere):
            needed, done = max(needed, TRIALS << put(*of, random_prime())), done + 1
    return "shown", ""


def answered(data: Any, by: Any, several: bool = False) -> tuple[str, str]:
    """(answer, reason) about a certificate that was read as JSON, of one case or several, by what a function says."""
    try:
        rest = json.dumps({key: data[key] for key in data if key != "checksum"}, sort_keys=True, separators=(",", ":"))
        if hashlib.sha256(rest.encode()).hexdigest() != data["checksum"]:
            raise Stop("wrong", "the checksum")
        if data["verdict"] != "proved" or data["witness"] is not None or (len(data["cases"]) != 1 and not several):
            raise Stop("not shown", "no proof, or one of several cases")
        return by(data)
    except Stop as stop:
        return stop.args[0], stop.args[1]
    except Exception as error:  # whatever a certificate has in the wrong place
        return "not shown", f"a certificate of another form ({type(error).__name__}: {error})"


def checked(data: Any, asked: Any = Claim, put: Any = sample) -> tuple[str, str]:
    """(answer, reason) for a certificate: a random point is put into what the claim asks for and what it states."""
    return answered(data, lambda data: tried(put, asked(data["tables"]), data["cases"][0]))


def main(by: Any = checked) -> None:
    """Print the answers about the files that the command names; the exit status is the gravest."""
    answers = []
    for path in sys.argv[1:]:
        answers.append(by(json.loads(Path(path).read_bytes())))
        print(path, *filter(None, answers[-1]), sep=": ")
    sys.exit(1 if any(answer == "wrong" for answer, _ in answers) else 2 * any(a != "shown" for a, _ in answers))


if __name__ == "__main__":
    main()
