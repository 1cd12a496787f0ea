"""A checker in one file, of Python's standard library alone: `python alone.py CERTIFICATE.json …`

From the claim's own text it derives what must vanish, and sees that it is 0 at random points modulo random primes, and
the certificate's numerator over its denominator; that the relations are 0 there; and that with kernels that are free
numerator = Σ cofactor · relation. A refutation's witness is put into rational formulas: not 0 modulo a prime, not 0.

Positive means: a square. For p = −1 mod 24·3·5⋯23 the squares are a group of odd order: x^r, r rational, is one
number, √x √y = √(xy), |x| is x or −x, −1 is no square, all as with real numbers. Names that are positive, radicands and
what the domain's conditions say to be positive have to be squares; a point where they aren't is thrown away. A term of
an angle is a point on the circle, one of an exponent a square; of other functions only the derivatives are known. What
holds of these holds wherever the formulas have real values: primes and points at which all roots behave as at a given
real point aren't rare (Chebotarev's theorem), and the more roots there are, which may make them rarer, the more points
are tried. A wrong claim passes about once in e^TRIALS times.

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
from functools import cache
from itertools import chain, combinations, permutations, product
from math import prod
from random import SystemRandom
from typing import Any

TRIALS, MOST_ROOTS, MOST_TERMS, MOST_TRIED, LONGEST, MOST_SLOPES = 25, 5, 40, 500, 4000, 100_000
MODULUS, SMALL, RANDOM = 24 * prod((3, 5, 7, 11, 13, 17, 19, 23)), (1, -1, 2, -2, 3, -3, 4, 5, 6, 7, 8), SystemRandom()
SLOPES = {
    "sin": ["cos(a)"], "cos": ["-sin(a)"], "exp": ["exp(a)"], "log": ["1/a"], "asin": ["(1 - a**2)**(-1/2)"],
    "acos": ["-(1 - a**2)**(-1/2)"], "atan": ["1/(1 + a**2)"], "atan2": ["b/(a**2 + b**2)", "-a/(a**2 + b**2)"],
    "asinh": ["(a**2 + 1)**(-1/2)"], "acosh": ["(a - 1)**(-1/2)*(a + 1)**(-1/2)"], "atanh": ["1/(1 - a**2)"],
    "abs": ["sign(a)"], "sign": ["0"], "^": ["b*a**(b - 1)", ""],
}  # fmt: skip
MEANINGS = {
    "sqrt": "a**(1/2)", "cbrt": "a**(1/3)", "tan": "sin(a)/cos(a)", "cot": "cos(a)/sin(a)", "sec": "1/cos(a)",
    "csc": "1/sin(a)", "sinh": "(exp(a) - exp(-a))/2", "cosh": "(exp(a) + exp(-a))/2",
    "tanh": "1 - 2/(exp(2*a) + 1)", "coth": "1 + 2/(exp(2*a) - 1)",
}  # fmt: skip
FIELD = ["D(_H, {p}) - _qdot{i}", "D(_H, {q}) + _pdot{i}"]
KINDS = {
    "identity": ["_lhs - _rhs"], "bracket": ["bracket(_f, _g) - _equals"],
    "conserved": ["D(_f, {t}) + bracket(_f, _H)"], "equations_of_motion": FIELD, "hamiltonian_field": FIELD,
    "jacobi": ["bracket(_f, bracket(_g, _h)) + bracket(_g, bracket(_h, _f)) + bracket(_h, bracket(_f, _g))"],
    "infinitesimal": ["D(_generator, {p}) - _dq{i}", "D(_generator, {q}) + _dp{i}"],
}  # fmt: skip
"""What vanishes, for each degree of freedom where it says so; _f is what the claim has under f."""
OPAQUE = re.findall(r"\w+", "gamma lambertw elliptic_k elliptic_e elliptic_f elliptic_pi jacobi_sn jacobi_cn jacobi_dn")
MAPS = ("canonical", "fundamental_brackets", "new_hamiltonian", "generates", "generating_function")
TYPES = {1: "qQ", 2: "qP", 3: "pQ", 4: "pP"}
GIVES = {"q": ("p", ""), "p": ("q", "-"), "Q": ("P", "-"), "P": ("Q", "")}
"""p = ∂F/∂q, q = −∂F/∂p, P = −∂F/∂Q, Q = ∂F/∂P."""


class Stop(Exception):
    """The end of a check: (the answer, the reason)."""


class Elsewhere(Exception):
    """A point at which something isn't positive that has to be."""


@dataclass(frozen=True, eq=False)
class Formula:
    """Of kind "#" (a number), "." (a name), "+", "*", "^" (of numbers), or a function with orders of derivatives."""

    kind: str
    of: tuple[Any, ...]
    orders: tuple[int, ...] = ()


def number(r: Any) -> Formula:
    if not isinstance(r, str) or (len(r) < LONGEST and not re.search(r"[eE][-+]?\d{4}", r)):
        if max(map(int.bit_length, (r := Fraction(r)).as_integer_ratio())) < LONGEST:
            return Formula("#", (r,))
    raise Stop("not shown", "a number that is so long")


def joined(kind: str, *of: Formula) -> Formula:
    """A sum or a product; its numbers are put together."""
    numbers, rest = ([f for f in of if (f.kind == "#") == are] for are in (True, False))
    r = number((sum if kind == "+" else prod)(f.of[0] for f in numbers))
    if not rest or (kind == "*" and r.of == (0,)):
        return r
    rest += [r] if r.of != (kind == "*",) else []
    return rest[0] if len(rest) == 1 else Formula(kind, tuple(rest))


def power(a: Formula, b: Formula) -> Formula:
    whole = a.kind == "#" and b.of[0].denominator == 1 and abs(b.of[0]) < LONGEST
    return number(a.of[0] ** int(b.of[0])) if whole else Formula("^", (a, b))


@cache
def parsed(text: str) -> tuple[Any, str]:
    """What Python's parser makes of a formula, and the text: names have a mark in front, so that none is Python's."""
    marked = re.sub(r"(?<![\w.])[^\W\d]\w*", r"_\g<0>", " ".join(text.split()))
    return ast.parse(marked, mode="eval").body, marked


class Claim:
    """What a claim asks for: the texts in `zeros` vanish, the text `regular` doesn't."""

    def __init__(self, tables: Any) -> None:
        self.slope, self.known, self.count = cache(self.slope), cache(self.read), 0
        space, self.kind, self.domain = tables["phase_space"], tables["claim"]["kind"], tables.get("domain", {})
        said = ("kind", "title", "source", "expect", "budget")
        claim = {key: value for key, value in tables["claim"].items() if key not in said}
        sides = {side: space.get(side, []) for side in "qpQP"}
        self.words = {n: [w] if isinstance(w, str) else w for n, w in tables.get("symbols", {}).items()}
        self.names = [*chain(*sides.values()), space.get("time", "t")]
        self.texts, whole = dict(tables.get("definitions", {})), json.dumps(tables, ensure_ascii=False)
        twice = {*self.texts} & {*self.names, *self.words} or len({*self.names}) < len(self.names)
        taken = {*self.texts, *self.names, *self.words} & {"pi", "D", "bracket", *SLOPES, *MEANINGS, *OPAQUE}
        odd = (
            re.search(r"(?<!\w)_", whole)
            or unicodedata.normalize("NFKC", whole) != whole
            or "complex" in str(self.words)
        )
        if twice or taken or odd or not all(map(str.isidentifier, self.names)):
            raise Stop("not shown", "names with two meanings, complex ones, or of another form")
        self.words |= dict.fromkeys(OPAQUE, "function")
        for key, value in (tables.get("hamiltonian", {}) | claim).items():
            parts = value if isinstance(value, list) else [value]
            self.texts |= {f"_{key}": value} | {f"_{key}{i}": text for i, text in enumerate(parts)}
        self.pairs, explicit = [*zip(sides["q"], sides["p"], strict=True)], tables.get("transformation", {})
        said = {*re.findall(r"\w+", json.dumps([*self.texts.values()], ensure_ascii=False))}
        self.new = {*sides["Q"], *sides["P"]}
        if self.kind not in MAPS and not self.new & said:
            explicit = {}
        if self.kind in MAPS or (self.kind == "identity" and not {"D", "bracket"} & said):
            self.new = {*()}
        for side in explicit:
            self.texts |= dict(zip(sides[side], explicit[side], strict=True))
        self.variables, self.regular = self.names, "1"
        if "q" in explicit and self.kind not in MAPS[:3]:
            rows = [*explicit["q"], *explicit["p"]]
            self.regular = determinant([[f"D({f}, {u})" for u in (*sides["Q"], *sides["P"])] for f in rows])
        if self.kind in MAPS:
            self.zeros = self.of_map(sides, explicit, claim if "F" in claim else tables.get("generating_function", {}))
        elif self.kind == "involution":
            pairs = combinations(range(len(claim["functions"])), 2)
            self.zeros = [f"bracket(_functions{i}, _functions{j})" for i, j in pairs]
        else:
            each = [(row, i, *pair) for row in KINDS[self.kind] for i, pair in enumerate(self.pairs)]
            self.zeros = [*dict.fromkeys(row.format(i=i, q=q, p=p, t=self.names[-1]) for row, i, q, p in each)]
        lists = {
            len(value) for key, value in claim.items() if isinstance(value, list) and key not in ("type", "functions")
        }
        asked = re.findall(r"(?<!\w)_([a-zA-Z]+)", str([self.zeros, *self.texts.values()]))
        unread = {*claim, *self.domain} - {*asked, "type", "where"}
        if not self.zeros or unread or lists - {len(self.pairs)}:
            raise Stop("not shown", f"what {min(unread, default='it')[:40]} says")

    def of_map(self, sides: Any, explicit: Any, generating: Any) -> list[str]:
        """Of a map: brackets, or the equations of its generating function; then the new Hamiltonian's gradient."""
        n, rows, types = len(sides["q"]), [], generating.get("type", [])
        for i, one in enumerate([types] * n if isinstance(types, int) else types):
            for side, (other, sign) in ((side, GIVES[side]) for side in TYPES[one]):
                rows.append((sides[other][i], sides[side][i], f"{sign}D(_F, {sides[side][i]})"))
            self.texts["_F"] = generating["F"]
        if len(sides["Q"]) != n or len(sides["P"]) != n or len(rows) not in (0, 2 * n):
            raise Stop("not shown", "a map that isn't one of as many variables")
        if self.kind in MAPS[-2:]:
            return [f"{name} - {text}" for name, _, text in rows]
        forward, scaled = "Q" in explicit, self.kind == "new_hamiltonian"
        X, Y = ([*sides[a], *sides[b]] for a, b in (("QP", "qp") if forward else ("qp", "QP")))
        self.pairs = [*zip(Y[:n], Y[n:], strict=True)]
        if not explicit:
            self.pairs = [(a[1], b[1]) for a, b in zip(rows[::2], rows[1::2], strict=True)]
        self.variables = [*(a for a, _ in self.pairs), *(b for _, b in self.pairs), self.names[-1]]
        inverse = "" if forward or not explicit else "1/"
        self.texts.setdefault("_scale", f"bracket({X[0]}, {X[n]})" if explicit and scaled else "1")
        self.texts["_c"] = f"{inverse}_scale" if scaled else "_scale"
        each = [*combinations(range(2 * n), 2)]
        zeros = [f"bracket({X[i]}, {X[j]})" + f" - {'' if scaled else inverse}_scale" * (j == i + n) for i, j in each]
        if not explicit:
            coordinates = [(self.variables[i], self.variables[j]) for i, j in each]
            zeros = [f"{form(sides, 'QP', *ab)} - ({form(sides, 'qp', *ab)})" for ab in coordinates]
            zeros += [] if scaled else ["_scale - 1"]
            self.texts |= {name: text for name, _, text in rows}
            self.regular = determinant([[f"D(D(_F, {a}), {b})" for _, b in self.pairs] for a, _ in self.pairs])
        zeros += [f"D(_c, {u})" for u in self.variables if scaled]
        for u in self.variables[:-1] if scaled else ():
            moved = [form(sides, half, u, self.names[-1]) for half in ("QP", "qp")]
            zeros.append(f"D(_K - _c*_H, {u}) + {moved[0]} - _c*({moved[1]})")
        return zeros

    def read(self, text: Any, own: Any = None) -> Formula:
        return self.built(*parsed(str(text)), own or {})

    def built(self, at: Any, text: str, own: Any) -> Formula:
        """The formula of a syntax tree; `own` are names that stand for formulas. Derivatives are taken at once."""
        if isinstance(at, ast.BinOp):
            a, b = (self.built(side, text, own) for side in (at.left, at.right))
            if isinstance(at.op, ast.Pow) and b.kind != "#":
                if "integer" in str(self.words):
                    raise Stop("not shown", "powers with a name in the exponent beside integers")
                return self.read("exp(b*log(a))", {"a": a, "b": b})
            if isinstance(at.op, (ast.Sub, ast.Div)):
                b = joined("*", number(-1), b) if isinstance(at.op, ast.Sub) else power(b, number(-1))
            kinds = {ast.Add: "+", ast.Sub: "+", ast.Mult: "*", ast.Div: "*", ast.Pow: "^"}
            return power(a, b) if isinstance(at.op, ast.Pow) else joined(kinds[type(at.op)], a, b)
        if isinstance(at, ast.UnaryOp):
            return joined("*", number({ast.UAdd: 1, ast.USub: -1}[type(at.op)]), self.built(at.operand, text, own))
        if isinstance(at, ast.Constant):
            return number(ast.get_source_segment(text, at))
        if isinstance(at, ast.Name):
            name = at.id[1:]
            if name in own or (name in self.texts and name not in self.variables):
                return own[name] if name in own else self.known(self.texts[name])
            if "function" in self.words.get(name, ()) or name not in {*self.names, *self.words, "pi"}:
                raise Stop("not shown", f"what {name.strip('_')[:40]} is")
            return Formula(".", (name,))
        of, orders, x = at.func, (), [self.built(item, text, own) for item in at.args]
        if isinstance(of, ast.Subscript):  # V[1](r), in certificates, is V'(r)
            of, orders = of.value, tuple(int(item.value) for item in getattr(of.slice, "elts", [of.slice]))
        name = getattr(of, "id", "_")[1:]
        if name == "bracket":
            ways = [(1, q, p) for q, p in self.pairs] + [(-1, p, q) for q, p in self.pairs]
            return joined("+", *(joined("*", number(s), self.slope(x[0], a), self.slope(x[1], b)) for s, a, b in ways))
        if name == "D":
            if (by := x[1].of[0]) not in self.variables and (by not in self.words or by in self.texts):
                raise Stop("not shown", f"a derivative by {by}")
            for _ in range(range(20)[int(x[2].of[0]) if len(x) > 2 else 1]):
                x[0] = self.slope(x[0], by)
            return x[0]
        if "function" in self.words.get(name, ()):
            return Formula(name, tuple(x), orders or (0,) * len(x))
        if at.keywords or orders or len(x) != (1 if name in MEANINGS else len(SLOPES[name])):
            raise ValueError(f"what is given to {name[:40]}")
        return self.read(MEANINGS[name], {"a": x[0]}) if name in MEANINGS else Formula(name, tuple(x), ())

    def slope(self, f: Formula, x: str) -> Formula:
        """∂f/∂x."""
        self.count += 1
        if self.count > MOST_SLOPES or (f.kind == "." and f.of[0] in self.new):
            raise Stop("not shown", "derivatives of new variables, or so many")
        if f.kind in "#.":
            return number(f.of == (x,))
        steep = [self.slope(a, x) for a in f.of]
        if f.kind == "+":
            return joined("+", *steep)
        if f.kind == "*":
            return joined("+", *(joined("*", a, *f.of[:k], *f.of[k + 1 :]) for k, a in enumerate(steep)))
        terms, own = [number(0)], dict(zip("ab", f.of, strict=False))
        for k, a in enumerate(steep):
            if a.of != (0,):
                more = Formula(f.kind, f.of, tuple(n + (j == k) for j, n in enumerate(f.orders)))
                terms.append(joined("*", a, more if f.orders else self.read(SLOPES[f.kind][k], own)))
        return joined("+", *terms)


def form(sides: Any, half: str, a: str, b: str) -> str:
    """Lagrange's bracket of two coordinates: Σ ∂q/∂a ∂p/∂b − ∂p/∂a ∂q/∂b."""
    pairs = zip(sides[half[0]], sides[half[1]], strict=True)
    return " + ".join(f"D({q}, {a})*D({p}, {b}) - D({p}, {a})*D({q}, {b})" for q, p in pairs)


def determinant(rows: list[list[str]]) -> str:
    if len(rows) > 4:
        raise Stop("not shown", "that a map of so many variables is regular")
    terms = [(sum(a > b for a, b in combinations(rank, 2)), rank) for rank in permutations(range(len(rows)))]
    return " + ".join(
        "*".join([f"(-1)**{odd}", *(row[k] for row, k in zip(rows, rank, strict=True))]) for odd, rank in terms
    )


class Point:
    """A random point modulo a prime, and what formulas are there."""

    def __init__(self, claim: Claim, prime: int, given: Any = ()) -> None:
        self.claim, self.p, self.half, self.free = claim, prime, (prime - 1) // 2, dict[Any, int]()
        self.given = {name: self.fraction(r, prime) for name, r in dict(given).items()}
        self.roots, self.sure, self.logs, self.rational = set[int](), set[int](), dict[int, int](), True
        self.value, self.terms = cache(self.value), cache(self.terms)

    def any(self, *key: Any) -> int:
        """A random number for what nothing is known of but that it is the same where the key is."""
        return self.free.setdefault(key, RANDOM.randrange(2, self.p))

    def fraction(self, r: Any, order: int) -> int:
        return Fraction(r).numerator * pow(Fraction(r).denominator, -1, order) % order

    def root(self, x: int, r: Fraction) -> int:
        """x^r."""
        whole = r.denominator == 1
        return pow(x if whole else self.square(x), int(r) if whole else self.fraction(r, self.half), self.p)

    def square(self, x: int) -> int:
        """What has to be positive."""
        if pow(x, self.half, self.p) != 1:
            raise Elsewhere
        return x

    def value(self, f: Formula) -> int:
        if f.kind == ".":
            return self.named(f.of[0])
        if f.kind == "#":
            self.sure |= {self.fraction(f.of[0], self.p)} if f.of[0] > 0 else set()
            return self.fraction(f.of[0], self.p)
        a = [self.value(x) for x in f.of]
        if f.kind in "+*":
            return (sum(a) if f.kind == "+" else prod(a)) % self.p
        if f.kind == "^":
            r = f.of[1].of[0]
            self.roots |= {a[0]} - self.sure if r.denominator % 2 == 0 else set()
            self.rational &= r.denominator == 1
            return self.root(a[0], r)
        self.rational = False
        if f.kind in ("abs", "sign"):
            self.roots |= {a[0] ** 2 % self.p}
            return pow(a[0], self.half, self.p) * (a[0] if f.kind == "abs" else 1) % self.p
        if f.kind == "exp":
            terms = self.terms(f.of[0]).items()
            return prod(self.root(self.logs.get(v, self.any("exp", v) ** 2), r) for v, r in terms) % self.p
        if f.kind in ("sin", "cos"):
            return self.circle(self.terms(f.of[0]))[f.kind == "sin"]
        found = self.any(f.kind, f.orders, *a)
        self.logs |= {found: self.square(a[0])} if f.kind == "log" else {}
        return found

    def named(self, name: str) -> int:
        """The value of a name: what the map gives it, or a number that has its sign."""
        if name in self.claim.texts:
            return self.value(self.claim.known(self.claim.texts[name]))
        value, said = self.given.get(name) or self.any(name), {*self.claim.words.get(name, ())}
        if name not in self.given and (said & {"positive", "negative", "nonnegative"} or name == "pi"):
            value = value**2 * (-1 if "negative" in said else 1) % self.p
            self.sure.add(value)
        return self.given.get(name, value)

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
        return {self.value(f): Fraction(1)}

    def circle(self, terms: dict[int, Fraction]) -> tuple[int, int]:
        """(cos, sin) of a sum: for each term the power of a random point on the circle; for π/2 that of (0, 1)."""
        c, s, p = 1, 0, self.p
        for value, r in terms.items():
            u, right = self.any("circle", value), value == self.named("pi")
            x, n = (0 if right else (1 - u * u) * pow(1 + u * u, -1, p)), r * (2 if right else MODULUS**2)
            if n.denominator > 1:
                raise Stop("not shown", "a part of an angle")
            y, n = (1 if right else 2 * u * pow(1 + u * u, -1, p)) * (1 if n > 0 else -1), abs(int(n))
            while n:
                c, s = ((c * x - s * y) % p, (c * y + s * x) % p) if n % 2 else (c, s)
                x, y, n = (x * x - y * y) % p, 2 * x * y % p, n // 2
        return c, s


def random_prime() -> int:
    """A prime of some 127 bits that is −1 modulo MODULUS, by Fermat's test, as it is a random number."""
    while True:
        p = MODULUS * RANDOM.getrandbits(127 - MODULUS.bit_length()) - 1
        if p > 2**110 and all(pow(RANDOM.randrange(2, p), p - 1, p) == 1 for _ in range(20)):
            return p


def sample(claim: Claim, case: Any, prime: int) -> int:
    """Put one random point into everything; returns the number of roots that were met."""
    point, own = Point(claim, prime), {}
    value = lambda text: point.value(claim.known(text))
    for words in (re.split(r"(<=|>=|!=|<|>)", text) for text in claim.domain.get("where", [])):
        for a, sign, b in zip(words[::2], words[1::2], words[2::2], strict=False):
            if sign != "!=":
                point.square(value(f"({b}) - ({a})" if "<" in sign else f"({a}) - ({b})"))

    def put(polynomial: Any, kernel: Any) -> int:
        """A polynomial's value, of {"g1^2 x": "3/2"}."""
        powers = {m: [factor.partition("^") for factor in m.split()] for m in polynomial}
        values = {m: prod(pow(kernel(name), int(n or 1), prime) for name, _, n in powers[m]) for m in polynomial}
        return sum(point.fraction(number(c).of[0], prime) * values[m] for m, c in polynomial.items()) % prime

    for k in case["kernels"]:
        own[k["name"]] = claim.read(k["stands for"], own)
    kernel, free = cache(lambda name: point.value(claim.read(name, own))), cache(lambda name: RANDOM.randrange(prime))
    if wrong := [k["name"] for k in case["kernels"] if put(k.get("relation", {}), kernel)]:
        raise Stop("not shown", f"the relation of {wrong[0][:40]}")
    relations = {k["name"]: put(k.get("relation", {}), free) for k in case["kernels"]}
    for text, entry in zip(claim.zeros, case["residuals"], strict=True):
        parts = sum(put(cofactor, free) * relations[name] for name, cofactor in entry["cofactors"].items())
        if (put(entry["numerator"], free) - parts) % prime:
            raise Stop("wrong", "a numerator isn't the sum of cofactors times relations")
        residual = value(text)
        if (residual * put(entry["denominator"], kernel) - put(entry["numerator"], kernel)) % prime or residual:
            raise Stop("not shown", f"{text[:60]} isn't seen to be 0 and the fraction that is stated")
    small = any((value("_c") * b - a) % prime == 0 for a, b in product(SMALL, SMALL)) if "_c" in claim.texts else True
    if not small or not value(claim.regular):
        raise Stop("not shown", "that the generating function is regular, and the scale a number that isn't 0")
    return len(point.roots)


def refuted(claim: Claim, witness: Any, prime: int) -> tuple[str, str]:
    """Whether something isn't 0 at a rational point in rational formulas: what isn't 0 modulo a prime isn't 0."""
    point, signs = Point(claim, prime, witness), {"real": 0, "positive": 1, "nonnegative": 1, "negative": -1}
    fits = [signs[word] * Fraction(witness[name]) >= 0 for name in witness for word in claim.words.get(name, ())]
    wrong = [text for text in claim.zeros if point.value(claim.known(text))]
    if not point.rational or claim.domain or not all(fits) or not point.value(claim.known(claim.regular)):
        raise Stop("not shown", "a refutation that isn't one by fractions alone")
    return ("shown", "") if wrong else ("wrong", "nothing fails at the witness")


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate that was read as JSON."""
    try:
        rest = json.dumps({key: data[key] for key in data if key != "checksum"}, sort_keys=True, separators=(",", ":"))
        if hashlib.sha256(rest.encode()).hexdigest() != data["checksum"]:
            raise Stop("wrong", "the checksum")
        claim, cases, primes = Claim(data["tables"]), data["cases"], [random_prime() for _ in range(16)]
        if data["verdict"] == "refuted" and data["witness"] and not cases:
            return refuted(claim, data["witness"], primes[0])
        if data["verdict"] != "proved" or data["witness"] is not None or len(cases) != 1:
            raise Stop("not shown", "no proof, or one of several cases")
        done, tried, needed = 0, 0, TRIALS
        while done < needed:
            if (tried := tried + 1) > MOST_TRIED + 20 * done or needed > TRIALS << MOST_ROOTS:
                raise Stop("not shown", "points at which everything is positive that has to be, or so many roots")
            with suppress(Elsewhere):
                needed = max(needed, TRIALS << sample(claim, cases[0], primes[tried & 15]))
                done += 1
        return "shown", ""
    except Stop as stop:
        return stop.args[0], stop.args[1]
    except Exception as error:  # whatever a certificate has in the wrong place
        return "not shown", f"a certificate of another form ({type(error).__name__}: {error})"


if __name__ == "__main__":
    answers = []
    for path in sys.argv[1:]:
        with open(path, encoding="utf-8") as file:
            answers.append(checked(json.load(file)))
        print(path, *filter(None, answers[-1]), sep=": ")
    sys.exit(1 if any(answer == "wrong" for answer, _ in answers) else 2 * any(a != "shown" for a, _ in answers))
