"""A checker in one file, of Python's standard library alone: `python alone.py CERTIFICATE.json …`

It derives what must vanish from the claim's own text, and sees that it is 0 at random points modulo random primes,
and the certificate's numerator over its denominator; that the relations are 0 there; and that, multiplied out,
numerator = Σ cofactor · relation. A refutation's witness is put into rational formulas: not 0 modulo a prime, not 0.

Positive means: a square. Modulo a prime p = −1 mod 24·3·5⋯23 the squares are a group of odd order: x^r, r rational, is
one number, √x √y = √(xy), |x| is x or −x, −1 is no square, all as with real numbers. Names that are positive, radicands
and what the domain's conditions say to be positive have to be squares; a point where they aren't is thrown away. Sines
and cosines are points on the circle, exponentials squares, one for each term of the angle or the exponent; of any other
function only the derivatives are known. What holds of these holds wherever the formulas have real values: primes and
points at which all roots behave as at a given real point aren't rare (Chebotarev's theorem), and the more roots there
are, which may make them rarer, the more points are tried. A wrong claim passes about once in e^TRIALS times.

"shown": the claim holds where its formulas have values. "not shown": not by this file. "wrong": something isn't so.
"""

from __future__ import annotations

import ast
import copy
import hashlib
import json
import random
import re
import sys
import unicodedata
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cache
from itertools import combinations, product
from math import prod
from typing import Any, NamedTuple

TRIALS, MOST_ROOTS, MOST_TERMS, THROWN, HIGHEST, STEEPEST = 25, 5, 40, 500, 1000, 20
SMALL = (1, -1, 2, -2, 3, -3, 4, 5, 6, 7, 8, 9, 10)
MODULUS = 24 * prod((3, 5, 7, 11, 13, 17, 19, 23))
SLOPES = {
    "sin": ["cos(a)"], "cos": ["-sin(a)"], "exp": ["exp(a)"], "log": ["1/a"], "asin": ["(1 - a**2)**(-1/2)"],
    "acos": ["-(1 - a**2)**(-1/2)"], "atan": ["1/(1 + a**2)"], "atan2": ["b/(a**2 + b**2)", "-a/(a**2 + b**2)"],
    "asinh": ["(a**2 + 1)**(-1/2)"], "acosh": ["(a - 1)**(-1/2)*(a + 1)**(-1/2)"], "atanh": ["1/(1 - a**2)"],
    "abs": ["abs(a)/a"], "sign": ["0"], "power": ["b*a**(b - 1)"],
}  # fmt: skip
MEANINGS = {
    "sqrt": "a**(1/2)", "cbrt": "a**(1/3)", "tan": "sin(a)/cos(a)", "cot": "cos(a)/sin(a)", "sec": "1/cos(a)",
    "csc": "1/sin(a)", "sinh": "(exp(a) - exp(-a))/2", "cosh": "(exp(a) + exp(-a))/2",
    "tanh": "1 - 2/(exp(2*a) + 1)", "coth": "1 + 2/(exp(2*a) - 1)",
}  # fmt: skip
OPAQUE = (
    "gamma",
    "lambertw",
    "elliptic_k",
    "elliptic_e",
    "elliptic_f",
    "elliptic_pi",
    "jacobi_sn",
    "jacobi_cn",
    "jacobi_dn",
)
"""Functions of which nothing is known."""
TEMPLATES = {
    "identity": ["_lhs - _rhs"], "bracket": ["bracket(_f, _g) - _equals"],
    "conserved": ["D(_f, {t}) + bracket(_f, _H)"],
    "jacobi": ["bracket(_f, bracket(_g, _h)) + bracket(_g, bracket(_h, _f)) + bracket(_h, bracket(_f, _g))"],
    "equations_of_motion": ["D(_H, {p}) - _qdot{i}", "D(_H, {q}) + _pdot{i}"],
    "infinitesimal": ["D(_generator, {p}) - _dq{i}", "D(_generator, {q}) + _dp{i}"],
    "hamiltonian_field": ["D(_H, {p}) - _qdot{i}", "D(_H, {q}) + _pdot{i}"],
}  # fmt: skip
"""What vanishes, for each degree of freedom where it says so; _f is what the claim has under f."""
MAPS = ("canonical", "fundamental_brackets", "new_hamiltonian", "generates", "generating_function")
TYPES = {1: ("q", 1, "Q", -1), 2: ("q", 1, "P", 1), 3: ("p", -1, "Q", -1), 4: ("p", -1, "P", 1)}
OTHER = {"q": "p", "p": "q", "Q": "P", "P": "Q"}


class Stop(Exception):
    """The end of a check: (the answer, the reason)."""


class Jet(NamedTuple):
    """A Taylor series, {(names of a monomial in order): coefficient}; its value as a sum, {term: rational factor}."""

    order: int
    taylor: dict[tuple[str, ...], int]
    terms: dict[int, Fraction]


def rational(text: Any) -> Fraction:
    """The number that a text is. Raises ValueError."""
    if len(str(text)) > HIGHEST or re.search(r"[eE][-+]?\d{4}", str(text)):
        raise ValueError("a number that is too long")
    return Fraction(text)


@cache
def parsed(text: str) -> tuple[ast.expr, str]:
    """What Python's parser makes of a formula, and the text: names have a mark in front, so that none is Python's."""
    marked = re.sub(r"(?<![\w.])[^\W\d]\w*", r"_\g<0>", " ".join(text.split()))
    return ast.parse(marked, mode="eval").body, marked


class Point:
    """A random point modulo a prime; about it formulas are series in the `variables` up to an order."""

    def __init__(self, claim: Claim, prime: int) -> None:
        self.words, self.variables, self.pairs, self.texts = claim.words, claim.variables, claim.pairs, claim.texts
        self.p, self.half, self.rng, self.given = prime, (prime - 1) // 2, random.SystemRandom(), dict[str, int]()
        self.roots, self.free, self.logs = set[int](), dict[Any, int](), dict[int, int]()
        self.found, self.sure, self.powers = dict[tuple[str, int], Jet](), set[int](), set[Fraction]()

    def any(self, *key: Any) -> int:
        """A random number for what nothing is known of but that it is the same where the key is."""
        return self.free.setdefault(key, self.rng.randrange(2, self.p))

    def fraction(self, r: Fraction, order: int) -> int:
        return r.numerator * pow(r.denominator, -1, order) % order

    def root(self, x: int, r: Fraction) -> int:
        """x^r."""
        if r.denominator == 1 and abs(r) <= HIGHEST:
            return pow(x, int(r), self.p)
        return pow(self.square(x), self.fraction(r, self.half), self.p)

    def square(self, x: int) -> int:
        """What has to be positive."""
        if pow(x, self.half, self.p) != 1:
            raise Stop("elsewhere", "a point at which everything is positive that has to be")
        return x

    # -- series ------------------------------------------------------------------------------------------

    def constant(self, value: int, terms: dict[int, Fraction] | None = None, order: int = HIGHEST) -> Jet:
        return Jet(order, {(): value % self.p}, {value % self.p: Fraction(1)} if terms is None else terms)

    def number(self, r: Any) -> Jet:
        r = rational(r)
        value = self.fraction(r, self.p)
        self.sure |= {value} if r > 0 else set()
        return self.constant(value, {1: r} if value else {})

    def named(self, name: str, order: int) -> Jet:
        """The series of a name: what it is defined as, or a variable, or a constant."""
        if (name, order) not in self.found and name in self.texts:
            self.found[name, order] = self.read(self.texts[name], {}, order)
        elif (name, order) not in self.found:
            if name.startswith("_") or "function" in self.words.get(name, ()):
                raise Stop("not shown", f"what {name.strip('_')} is")
            said, value = {*self.words.get(name, ())}, self.given[name] if name in self.given else self.any(name)
            if name not in self.given and (said & {"positive", "negative", "nonnegative"} or name == "pi"):
                value = value**2 * (-1 if "negative" in said else 1) % self.p
                self.sure.add(value)
            one, near = self.constant(value, order=order), {(name,): 1} if name in self.variables and order else {}
            self.found[name, order] = one._replace(taylor=one.taylor | near)
        return self.found[name, order]

    def add(self, a: Jet, b: Jet, factor: int = 1) -> Jet:
        taylor = {m: (a.taylor.get(m, 0) + factor * b.taylor.get(m, 0)) % self.p for m in a.taylor | b.taylor}
        terms = {v: a.terms.get(v, Fraction(0)) + factor * b.terms.get(v, Fraction(0)) for v in a.terms | b.terms}
        return Jet(min(a.order, b.order), taylor, {v: r for v, r in terms.items() if r})

    def mul(self, a: Jet, b: Jet) -> Jet:
        order, taylor, terms = min(a.order, b.order), dict[tuple[str, ...], int](), dict[int, Fraction]()
        for m, c in a.taylor.items():
            for n, d in b.taylor.items():
                if len(m) + len(n) <= order:
                    key = tuple(sorted(m + n))
                    taylor[key] = (taylor.get(key, 0) + c * d) % self.p
        for x, y in product(a.terms, b.terms) if len(a.terms) * len(b.terms) <= MOST_TERMS else ():
            terms[x * y % self.p] = terms.get(x * y % self.p, Fraction(0)) + a.terms[x] * b.terms[y]
        return Jet(order, taylor, terms or {taylor.get((), 0): Fraction(1)})

    def slope(self, a: Jet, name: str) -> Jet:
        """The derivative by a variable."""
        if name not in self.variables or a.order < 1:
            raise Stop("not shown", f"a derivative by {name}")
        less = {m: (*m[: m.index(name)], *m[m.index(name) + 1 :]) for m in a.taylor if name in m}
        taylor = {less[m]: a.taylor[m] * m.count(name) % self.p for m in less}
        return Jet(a.order - 1, taylor, {taylor.get((), 0): Fraction(1)})

    def applied(self, name: str, x: Sequence[Jet], orders: tuple[int, ...] = ()) -> Jet:
        """The series of a function: its value, and degree by degree Σ ∂f/∂x · (x's own terms, times their degrees)."""
        order, value = min(a.order for a in x), self.value(name, x, orders) % self.p
        total, terms = self.constant(0), {value: Fraction(1)}
        short = [Jet(order - 1, {m: c for m, c in a.taylor.items() if len(m) < order}, a.terms) for a in x]
        for k, a in enumerate(x):
            steep = {m: c * len(m) for m, c in a.taylor.items() if m}
            if steep and order and orders:
                by = self.applied(name, short, tuple(n + (j == k) for j, n in enumerate(orders)))
            elif steep and order:
                by = self.read(SLOPES[name][k], dict(zip("ab", short, strict=False)))
            else:
                continue
            total = self.add(total, self.mul(by._replace(order=order), Jet(order, steep, {})))
        taylor = {m: c * pow(len(m), -1, self.p) % self.p for m, c in total.taylor.items() if m}
        if name == "power" and len(x[0].terms) == len(x[1].terms) == 1 and (r := x[1].terms[1]).denominator == 1:
            terms = {self.root(v, r): s ** int(r) for v, s in x[0].terms.items()}
        return Jet(order, taylor | {(): value}, terms)

    def value(self, name: str, x: Sequence[Jet], orders: tuple[int, ...]) -> int:
        """A function's value."""
        a = [jet.taylor.get((), 0) for jet in x]
        if name == "power":
            r = x[1].terms.get(1, Fraction(0))
            self.powers |= {r} if r.denominator > 1 else set()
            self.roots |= {a[0]} - self.sure if r.denominator % 2 == 0 else set()
            return self.root(a[0], r)
        if name in ("abs", "sign"):
            self.roots |= {a[0] ** 2 % self.p}
            return pow(a[0], self.half, self.p) * (a[0] if name == "abs" else 1)
        if name == "exp":
            return prod(self.root(self.logs.get(v, self.any("exp", v) ** 2), r) for v, r in x[0].terms.items())
        if name in ("sin", "cos"):
            return self.circle(x[0].terms)[name == "sin"]
        found = self.any(name, orders, *a)
        if name == "log":
            self.logs[found] = self.square(a[0])
        return found

    def circle(self, terms: Mapping[int, Fraction]) -> tuple[int, int]:
        """(cos, sin) of a sum: for each term the power of a random point on the circle; for π/2 that of (0, 1)."""
        c, s, p = 1, 0, self.p
        for value, r in terms.items():
            u, right = self.any("circle", value), value == self.named("pi", 0).taylor.get((), 0)
            x, n = (0 if right else (1 - u * u) * pow(1 + u * u, -1, p)), r * (2 if right else MODULUS**2)
            if n.denominator > 1:
                raise Stop("not shown", "a part of an angle")
            y, n = (1 if right else 2 * u * pow(1 + u * u, -1, p)) * (1 if n > 0 else -1), abs(int(n))
            while n:
                c, s = ((c * x - s * y) % p, (c * y + s * x) % p) if n % 2 else (c, s)
                x, y, n = (x * x - y * y) % p, 2 * x * y % p, n // 2
        return c, s

    # -- formulas ----------------------------------------------------------------------------------------

    def read(self, text: Any, own: Mapping[str, Jet], order: int = 0) -> Jet:
        """The series of a formula."""
        try:
            return self.built(*parsed(str(text)), own, order)
        except (ArithmeticError, SyntaxError, MemoryError, ValueError, TypeError, LookupError, AttributeError) as error:
            raise Stop("not shown", f"what this formula stands for: {str(text)[:60]}") from error

    def built(self, at: Any, text: str, own: Mapping[str, Jet], order: int) -> Jet:
        if isinstance(at, ast.BinOp):
            a, b = (self.built(side, text, own, order) for side in (at.left, at.right))
            if isinstance(at.op, ast.Pow):
                if b.terms == {1: 2}:
                    return self.mul(a, a)
                plain = {*b.terms} <= {1}
                if not plain and "integer" in str(self.words):
                    raise Stop("not shown", "powers with a name in the exponent beside integers")
                return self.applied("power", [a, b]) if plain else self.read("exp(b*log(a))", {"a": a, "b": b})
            if isinstance(at.op, (ast.Mult, ast.Div)):
                return self.mul(a, b if isinstance(at.op, ast.Mult) else self.applied("power", [b, self.number(-1)]))
            return self.add(a, b, {ast.Add: 1, ast.Sub: -1}[type(at.op)])
        if isinstance(at, ast.UnaryOp):
            return self.mul(
                self.number({ast.UAdd: 1, ast.USub: -1}[type(at.op)]), self.built(at.operand, text, own, order)
            )
        if isinstance(at, ast.Constant):
            return self.number(ast.get_source_segment(text, at))
        if isinstance(at, ast.Name):
            return own[at.id[1:]] if at.id[1:] in own else self.named(at.id[1:], order)
        of, orders = at.func, []
        if isinstance(of, ast.Subscript):  # V[1](r), in certificates, is V'(r)
            of, orders = of.value, [item.value for item in getattr(of.slice, "elts", [of.slice])]
        name = getattr(of, "id", "")[1:]
        times = int(name in ("D", "bracket"))
        if name == "D" and len(at.args) > 2:
            times = int(ast.get_source_segment(text, at.args[2]) or 0)
            if not 0 <= times <= STEEPEST:
                raise ValueError("an order that D doesn't have")
        x = [self.built(item, text, own, order + times) for item in at.args]
        if name == "D":
            for _ in range(times):
                x[0] = self.slope(x[0], at.args[1].id[1:])
            return x[0]
        if name == "bracket":
            total, d, (a, b) = self.number(0), self.slope, x
            for q, p in self.pairs:
                total = self.add(self.add(total, self.mul(d(a, q), d(b, p))), self.mul(d(a, p), d(b, q)), -1)
            return total
        if "function" in self.words.get(name, ()):
            return self.applied(name, x, tuple(orders) or (0,) * len(x))
        if name not in (*SLOPES, *MEANINGS, *OPAQUE):
            raise ValueError(f"no function is called {name}")
        return self.read(MEANINGS[name], {"a": x[0]}) if name in MEANINGS else self.applied(name, x)


class Claim:
    """What a claim asks for: the texts in `zeros` vanish, the text `regular` doesn't."""

    def __init__(self, tables: Mapping[str, Any]) -> None:
        space, claim, self.domain = tables["phase_space"], dict(tables["claim"]), tables.get("domain", {})
        sides, self.t, self.kind = {side: space.get(side, []) for side in "qpQP"}, space.get("time", "t"), claim["kind"]
        self.words = {n: [w] if isinstance(w, str) else w for n, w in tables.get("symbols", {}).items()}
        self.names, self.texts = [name for side in "qpQP" for name in sides[side]], dict(tables.get("definitions", {}))
        self.names.append(self.t)
        twice = {*self.texts} & {*self.names, *self.words} or len({*self.names}) < len(self.names)
        taken = {*self.texts, *self.names, *self.words} & {"pi", "D", "bracket", *SLOPES, *MEANINGS}
        whole = json.dumps(tables, ensure_ascii=False)
        odd = re.search(r"(?<!\w)_", whole) or unicodedata.normalize("NFKC", whole) != whole
        odd = odd or not all(map(str.isidentifier, self.names)) or "complex" in str(self.words)
        if twice or taken or odd or len(sides["q"]) != len(sides["p"]) or len(sides["Q"]) != len(sides["P"]):
            raise Stop("not shown", "names with two meanings, complex ones, or of another form")
        said = json.dumps([[*claim.values()], [*self.texts.values()], tables.get("hamiltonian")], ensure_ascii=False)
        new = any(re.search(rf"\b{name}\b", said) for name in (*sides["Q"], *sides["P"]))
        if new and self.kind not in MAPS and (self.kind != "identity" or re.search(r"\b(D|bracket)\b", said)):
            raise Stop("not shown", "derivatives beside new variables")
        self.texts |= {f"_{key}": text for key, text in tables.get("hamiltonian", {}).items()}
        for key in ("kind", "title", "source", "expect", "budget"):
            claim.pop(key, None)
        for key, value in claim.items():
            parts = value if isinstance(value, list) else [value]
            self.texts |= {f"_{key}": value} | {f"_{key}{i}": text for i, text in enumerate(parts)}
        self.variables, self.pairs = [*sides["q"], *sides["p"], self.t], list(zip(sides["q"], sides["p"], strict=True))
        explicit, self.regular = tables.get("transformation", {}), "1"
        self.along = bool(explicit)
        for side in explicit:
            self.texts |= dict(zip(sides[side], explicit[side], strict=True))
        if self.kind in MAPS:
            generating = claim if self.kind == "generating_function" else tables.get("generating_function", {})
            self.zeros = self.of_map(sides, explicit, generating)
        elif self.kind == "involution":
            pairs = combinations(range(len(claim["functions"])), 2)
            self.zeros = [f"bracket(_functions{i}, _functions{j})" for i, j in pairs]
        elif self.kind in TEMPLATES:
            each = [(row, i, *pair) for row in TEMPLATES[self.kind] for i, pair in enumerate(self.pairs)]
            self.zeros = list(dict.fromkeys(row.format(i=i, q=q, p=p, t=self.t) for row, i, q, p in each))
        else:
            raise Stop("not shown", f"a claim of kind {self.kind[:40]}")
        said = " ".join([*self.zeros, *map(str, self.texts.values())])
        self.variables += {*re.findall(r",\s*([^\W\d]\w*)\s*[,)]", said)} & {*self.words} - {*self.names}
        forms = {key: [f"_{key}{i}" for i in range(len(value))] if isinstance(value, list) else [f"_{key}0?"]
                 for key, value in claim.items() if key != "type"}  # fmt: skip
        unread = {key for key, of in forms.items() if not all(re.search(rf"\b{one}\b", said) for one in of)}
        if not self.zeros or (unread := unread | ({*self.domain} - {"where"})):
            raise Stop("not shown", f"what {min(unread, default='it')[:40]} says")

    def of_map(
        self, sides: Mapping[str, list[str]], explicit: Mapping[str, Any], generating: Mapping[str, Any]
    ) -> list[str]:
        """Of a map: brackets, or the equations of its generating function; then the new Hamiltonian's gradient."""
        n, rows, types = len(sides["q"]), [], generating.get("type", [])
        for i, one in enumerate([types] * n if isinstance(types, int) else types):
            old, sign, new, last = TYPES[one]
            for side, f in ((old, sign), (new, last)):
                rows.append((sides[OTHER[side]][i], sides[side][i], f"{f}*D(_F, {sides[side][i]})"))
            self.texts["_F"] = generating["F"]
        if len(sides["Q"]) != n or len(rows) not in (0, 2 * n):
            raise Stop("not shown", "a map that isn't one of as many variables")
        forward, scaled = "Q" in explicit, self.kind == "new_hamiltonian"
        X, Y = ([*sides[a], *sides[b]] for a, b in (("QP", "qp") if forward else ("qp", "QP")))
        self.pairs = [(a[1], b[1]) for a, b in zip(rows[::2], rows[1::2], strict=True)]
        self.pairs = list(zip(Y[:n], Y[n:], strict=True)) if explicit else self.pairs
        self.variables = [*(a for a, _ in self.pairs), *(b for _, b in self.pairs), self.t]
        if self.kind in MAPS[-2:]:
            self.variables = self.names
            return [f"{name} - {text}" for name, _, text in rows]
        self.along, inverse = False, "" if forward or not explicit else "1/"
        self.texts.setdefault("_scale", f"bracket({X[0]}, {X[n]})" if explicit and scaled else "1")
        self.texts["_c"] = f"{inverse}_scale" if scaled else "_scale"
        if explicit:
            unit = " - _scale" if scaled else f" - {inverse}_scale"
            zeros = [f"bracket({X[i]}, {X[j]}){unit * (j == i + n)}" for i, j in combinations(range(2 * n), 2)]
        else:
            zeros = [
                f"{form(sides, 'QP', *ab)} - ({form(sides, 'qp', *ab)})" for ab in combinations(self.variables[:-1], 2)
            ]
            zeros += [] if scaled else ["_scale - 1"]
            self.texts |= {name: text for name, _, text in rows}
            self.regular = determinant([[f"D(D(_F, {a}), {b})" for _, b in self.pairs] for a, _ in self.pairs])
        if scaled:
            zeros += [f"D(_c, {u})" for u in self.variables]
            for u in self.variables[:-1]:
                moved = [form(sides, half, u, self.t) for half in ("QP", "qp")]
                zeros.append(f"D(_K - _c*_H, {u}) + {moved[0]} - _c*({moved[1]})")
        return zeros


def form(sides: Mapping[str, list[str]], half: str, a: str, b: str) -> str:
    """Lagrange's bracket of two coordinates: Σ ∂q/∂a ∂p/∂b − ∂p/∂a ∂q/∂b."""
    pairs = zip(sides[half[0]], sides[half[1]], strict=True)
    return " + ".join(f"D({q}, {a})*D({p}, {b}) - D({p}, {a})*D({q}, {b})" for q, p in pairs)


def determinant(rows: Sequence[Sequence[str]]) -> str:
    """The text of a determinant, by its first row."""
    minors = ([[*row[:k], *row[k + 1 :]] for row in rows[1:]] for k in range(len(rows)))
    terms = (
        [f"{(-1) ** k}*({a})*({determinant(m)})" for k, (a, m) in enumerate(zip(rows[0], minors, strict=True))]
        if rows
        else []
    )
    return " + ".join(terms) or "1"


def polynomial(data: Mapping[str, str]) -> dict[tuple[str, ...], Fraction]:
    """{"g1^2 x": "3/2"} as products of names with their coefficients."""
    found = dict[tuple[str, ...], Fraction]()
    for monomial, c in data.items():
        powers = [(name, int(n or 1)) for name, _, n in (factor.partition("^") for factor in monomial.split())]
        if any(not 0 < n <= HIGHEST for _, n in powers):
            raise ValueError(f"the powers in {monomial[:60]}")
        key = tuple(sorted(name for name, n in powers for _ in range(n)))
        found[key] = found.get(key, Fraction(0)) + rational(c)
    return found


def is_combination(entry: Mapping[str, Any], relations: Mapping[str, Mapping[tuple[str, ...], Fraction]]) -> bool:
    """Whether numerator = Σ cofactor · relation, multiplied out."""
    left = polynomial(entry["numerator"])
    for name, cofactor in entry["cofactors"].items():
        for (m, c), (n, d) in product(polynomial(cofactor).items(), relations[name].items()):
            key = tuple(sorted(m + n))
            left[key] = left.get(key, Fraction(0)) - c * d
    return not any(left.values())


def random_prime(rng: random.Random) -> int:
    """A prime of some 127 bits that is −1 modulo MODULUS, by Fermat's test, as it is a random number."""
    while True:
        p = MODULUS * rng.getrandbits(127 - MODULUS.bit_length()) - 1
        if p > 2**110 and all(pow(rng.randrange(2, p), p - 1, p) == 1 for _ in range(20)):
            return p


def along(claim: Claim, point: Point) -> Point:
    """Where the claim is asked: old and new variables, free of each other, at values that the map gives them."""
    there = copy.copy(point)
    if claim.along:
        there.given = {name: point.named(name, 0).taylor.get((), 0) for name in claim.names}
        there.texts = {name: text for name, text in point.texts.items() if name not in there.given}
        there.found = {}
    return there


def sample(claim: Claim, case: Mapping[str, Any], prime: int) -> int:
    """Put one random point into everything; returns the number of roots that were met."""
    point = Point(claim, prime)
    shown = copy.copy(
        point
    )  # in which the certificate's kernels have names; the claim's own formulas know nothing of them
    shown.texts, shown.found = claim.texts | {k["name"]: k["stands for"] for k in case["kernels"]}, {}
    value = lambda text: point.read(text, {}).taylor.get((), 0)
    kernel = lambda name: shown.read(name, {}).taylor.get((), 0)
    put = lambda table: sum(point.fraction(c, prime) * prod(map(kernel, m)) for m, c in polynomial(table).items())
    for words in (re.split(r"(<=|>=|!=|<|>)", text) for text in claim.domain.get("where", [])):
        for a, sign, b in zip(words[::2], words[1::2], words[2::2], strict=False):
            if sign != "!=":
                point.square(value(f"({b}) - ({a})" if "<" in sign else f"({a}) - ({b})"))
    for k in case["kernels"]:
        if put(k.get("relation", {})) % prime:
            raise Stop("not shown", f"the relation of {k['name']}")
    there = along(claim, point)
    for text, entry in zip(claim.zeros, case["residuals"], strict=True):
        residual = there.read(text, {}).taylor.get((), 0)
        if (residual * put(entry["denominator"]) - put(entry["numerator"])) % prime:
            raise Stop("not shown", f"{text[:60]} isn't seen to be the fraction that is stated")
        if residual:
            raise Stop("not shown", f"{text[:60]} isn't 0 at each point")
    if not value(claim.regular):
        raise Stop("not shown", "that the generating function is regular")
    if "_c" in claim.texts and all((value("_c") * b - a) % prime for a in SMALL for b in SMALL):
        raise Stop("not shown", "that the scale is a number that isn't 0")
    return len(point.roots)


def refuted(claim: Claim, witness: Mapping[str, str], prime: int) -> tuple[str, str]:
    """Whether something isn't 0 at a rational point in rational formulas: what isn't 0 modulo a prime isn't 0."""
    point = Point(claim, prime)
    point.given = {name: point.fraction(Fraction(value), prime) for name, value in witness.items()}
    signs = {"real": 0, "positive": 1, "nonnegative": 1, "negative": -1}
    fits = [signs[word] * Fraction(witness[name]) >= 0 for name in witness for word in claim.words.get(name, ())]
    there = along(claim, point)
    wrong = [text for text in claim.zeros if there.read(text, {}).taylor.get((), 0)]
    functions = point.powers or any(len(key) > 1 for key in point.free)
    if functions or claim.domain or not all(fits) or not point.read(claim.regular, {}).taylor.get((), 0):
        raise Stop("not shown", "a refutation that isn't one by fractions alone")
    return ("shown", "") if wrong else ("wrong", "nothing fails at the witness")


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate that was read as JSON."""
    try:
        rest = json.dumps({key: data[key] for key in data if key != "checksum"}, sort_keys=True, separators=(",", ":"))
        if hashlib.sha256(rest.encode()).hexdigest() != data["checksum"]:
            raise Stop("wrong", "the checksum")
        claim, cases = Claim(data["tables"]), data["cases"]
        primes = [random_prime(random.SystemRandom()) for _ in range(16)]
        if data["verdict"] == "refuted" and data["witness"] and not cases:
            return refuted(claim, data["witness"], primes[0])
        if data["verdict"] != "proved" or data["witness"] is not None or len(cases) != 1:
            raise Stop("not shown", "no proof, or one of several cases")
        case = cases[0]
        relations = {kernel["name"]: polynomial(kernel.get("relation", {})) for kernel in case["kernels"]}
        if not all(is_combination(entry, relations) for entry in case["residuals"]):
            raise Stop("wrong", "a numerator isn't the sum of cofactors times relations")
        done, thrown, needed = 0, 0, TRIALS
        while done < needed:
            try:
                if (roots := sample(claim, case, primes[thrown + done & 15])) > MOST_ROOTS:
                    raise Stop("not shown", "anything with so many roots")
                done, needed = done + 1, max(needed, TRIALS << roots)
            except Stop as stop:
                thrown += 1
                if stop.args[0] != "elsewhere" or thrown > THROWN + 20 * done:
                    raise
        return "shown", ""
    except Stop as stop:
        return ("not shown", stop.args[1]) if stop.args[0] == "elsewhere" else (stop.args[0], stop.args[1])
    except (KeyError, TypeError, ValueError, LookupError, AttributeError, ArithmeticError, RecursionError) as error:
        return "not shown", f"a certificate of another form ({type(error).__name__}: {error})"


if __name__ == "__main__":
    answers = []
    for path in sys.argv[1:]:
        with open(path, encoding="utf-8") as file:
            answers.append(checked(json.load(file)))
        print(path, *filter(None, answers[-1]), sep=": ")
    sys.exit(
        1 if any(answer == "wrong" for answer, _ in answers) else 2 * any(answer != "shown" for answer, _ in answers)
    )
