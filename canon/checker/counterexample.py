"""Refutations, checked by this file and those beside it: `python counterexample.py CERTIFICATE.json …`

`alone.py` reads the claim, or `alone_wider.py` by its table, and says what has to vanish; here these formulas are
evaluated at the certificate's point, by arithmetic of this file's own: intervals of fractions, exact as long as these
are short, else rounded outwards to 64, 128, 256, then 512 bits. Roots, exponentials, sines and so on are summed up from
their series, with a bound of what is left over. Derivatives are taken at the point by the chain rule, with the slopes
that alone.py knows.

"shown": the point lies in the claim's domain, all that the claim says has a value there, and something isn't 0 that has
to be. So the claim is false, whoever wrote the certificate. "not shown": not by this file. "wrong": something isn't so.
"""

import hashlib
import json
import re
import sys
from collections.abc import Callable
from contextlib import suppress
from fractions import Fraction
from functools import cache
from itertools import chain, compress, count, product
from math import isqrt
from pathlib import Path
from typing import Any

if __package__:
    from canon.checker.alone import Claim, Formula, Stop, number
    from canon.checker.alone_wider import Wider
else:  # as a program, beside the other files
    from alone import Claim, Formula, Stop, number  # type: ignore

    try:
        from alone_wider import Wider  # type: ignore
    except (ImportError, OSError):  # it, or its table, isn't there: what it reads isn't shown then
        Wider = None

Interval = tuple[Fraction, Fraction]

BITS, EXACT, LARGEST, MOST_VALUES, HIGHEST, TRIES = (64, 128, 256, 512), 1000, 20_000, 100_000, 8, 3
"""Precisions; and limits, in bits, of a number that stays exact, and of any; of how much is evaluated, and how often
something is differentiated."""
NONE, ONE = (Fraction(0), Fraction(0)), (Fraction(1), Fraction(1))
SQUARE, VALUES = ("volume", "integral_invariant"), ("identity", "inequality")
MAPS = (*SQUARE, "canonical", "fundamental_brackets", "new_hamiltonian", "generates", "generating_function")
TABLE = (*SQUARE, "euler_lagrange", "noether", "solves", "hamilton_jacobi", "legendre", "invariant_interval", "casimir")
KINDS = (*MAPS, *VALUES, *TABLE, "bracket", "conserved", "equations_of_motion", "hamiltonian_field", "jacobi",
    "infinitesimal", "involution")  # fmt: skip
"""Claims that are false where one of the zeros isn't 0: each of them has to vanish everywhere. Those in TABLE are read
by alone_wider.py, and so are those with a bracket of their own, and fields without a Hamiltonian."""
MEANINGS = {"asin": "atan(a*(1 - a**2)**(-1/2))", "acos": "pi/2 - atan(a*(1 - a**2)**(-1/2))",
    "asinh": "log(a + (a**2 + 1)**(1/2))", "acosh": "log(a + (a**2 - 1)**(1/2))",
    "atanh": "log((1 + a)/(1 - a))/2"}  # fmt: skip
"""These have values where the functions are smooth, and nowhere else."""


class Open(Exception):
    """A value isn't seen at this precision, or there is none."""


class Arithmetic:
    """Intervals of real numbers, with ends of so many bits."""

    def __init__(self, bits: int) -> None:
        self.bits, self.one = bits, 1 << bits + 32
        fifth, other, third = Fraction(1, 5), Fraction(1, 239), Fraction(1, 3)
        arcs = [[n * end for end in self.arc(x, -1)] for n, x in ((16, fifth), (4, other))]
        self.pi = (arcs[0][0] - arcs[1][1], arcs[0][1] - arcs[1][0])
        self.log2 = (2 * self.arc(third, 1)[0], 2 * self.arc(third, 1)[1])

    def held(self, low: Fraction, high: Fraction) -> Interval:
        """The interval, rounded outwards; a number that isn't long stays as it is."""
        size = max(map(int.bit_length, (*low.as_integer_ratio(), *high.as_integer_ratio())))
        if size > LARGEST:
            raise Open("a number that is so large, or so small")
        return (low, high) if size < EXACT and low == high else (self.below(low), -self.below(-high))

    def below(self, x: Fraction) -> Fraction:
        """A number of so many bits that isn't above x."""
        unit = Fraction(2) ** (x.numerator.bit_length() - x.denominator.bit_length() - self.bits)
        return (x / unit).__floor__() * unit

    def add(self, x: Interval, y: Interval) -> Interval:
        return self.held(x[0] + y[0], x[1] + y[1])

    def times(self, x: Interval, y: Interval) -> Interval:
        ends = [a * b for a in x for b in y] if x[0] < x[1] or y[0] < y[1] else [x[0] * y[0]]
        return self.held(min(ends), max(ends))

    def power(self, x: Interval, n: int) -> Interval:
        """x^n, by squares."""
        if n < 0 and x[0] <= 0 <= x[1]:
            raise Open("a pole")
        base, found = (self.held(1 / x[1], 1 / x[0]) if n < 0 else x), ONE
        for bit in f"{abs(n):b}":
            found = self.times(found, found)
            found = self.times(found, base) if bit == "1" else found
        return found

    def monotone(self, f: Callable[[Fraction], Interval], x: Interval) -> Interval:
        """The values of a function that grows."""
        return self.held(f(x[0])[0], f(x[1])[1])

    def root(self, x: Fraction) -> Interval:
        """√x, x > 0."""
        unit = Fraction(1, 2 ** (self.bits + max(0, x.denominator.bit_length() - x.numerator.bit_length())))
        square = x / unit**2
        low = isqrt(square.__floor__())
        return low * unit, (low if low**2 == square else low + 1) * unit

    def series(self, first: Fraction, x: Fraction, ratio: Callable[[int], tuple[int, int]]) -> Interval:
        """Σ cₙ with c₀ = first, cₙ₊₁ = cₙ · x · u/v, (u, v) = ratio(n), where |first| ≤ 1, |x u/v| ≤ 1/2 and u ≤ v.

        In units of 1/one the error of a term is half of the one before it and 3 more, so 6 at most. When a term is less
        than 2, what is left over is less than 16.
        """
        one, total = self.one, 0
        term, step = (first * one).__floor__(), (x * one).__floor__()
        for n in count():
            if -2 < term < 2:
                return Fraction(total - 6 * n - 16, one), Fraction(total + 6 * n + 16, one)
            (u, v), total = ratio(n), total + term
            term = term * step * u // (v * one)
        raise AssertionError

    def arc(self, z: Fraction, sign: int) -> Interval:
        """artanh z (sign 1), or arctan z (−1), |z| ≤ 1/2."""
        return self.series(z, sign * z * z, lambda n: (2 * n + 1, 2 * n + 3))

    def exp(self, x: Fraction) -> Interval:
        """2^k exp r with x = k log 2 + r."""
        if abs(x) > LARGEST / 2:
            raise Open("an exponential that is so large, or so small")
        k = round(x / self.log2[0])
        rests = sorted(x - k * end for end in self.log2)
        low, high = (self.series(Fraction(1), r, lambda n: (1, n + 1)) for r in rests)
        return low[0] * Fraction(2) ** k, high[1] * Fraction(2) ** k

    def log(self, x: Fraction) -> Interval:
        """k log 2 + 2 artanh((m − 1)/(m + 1)) with x = 2^k m."""
        k = x.numerator.bit_length() - x.denominator.bit_length()
        m = x / Fraction(2) ** k
        rest, ends = self.arc((m - 1) / (m + 1), 1), sorted(k * end for end in self.log2)
        return ends[0] + 2 * rest[0], ends[1] + 2 * rest[1]

    def atan(self, z: Fraction) -> Interval:
        """By arctan z = π/2 − arctan 1/z = π/4 − arctan (1 − z)/(1 + z)."""
        if z < 0:
            low, high = self.atan(-z)
            return -high, -low
        if z <= Fraction(1, 2):
            return self.arc(z, -1)
        part, other = (2, 1 / z) if z > 1 else (4, (1 - z) / (1 + z))
        low, high = self.atan(other)
        return self.pi[0] / part - high, self.pi[1] / part - low

    def sine(self, x: Interval, quarters: int = 0) -> Interval:
        """sin(x + quarters · π/2): in the middle of x, and as far away as x is wide, since it isn't steeper than 1."""
        middle = (x[0] + x[1]) / 2
        if abs(middle) > 1 << EXACT:
            raise Open("an angle that is so large")
        pi = Arithmetic(self.bits + middle.numerator.bit_length()).pi if abs(middle) > 1 << 16 else self.pi
        k = round(2 * middle / pi[0])
        r = middle - k * (pi[0] + pi[1]) / 4
        first, skip = ((r, 1), (Fraction(1), 0))[(k + quarters) % 2]
        low, high = self.series(first, -r * r, lambda n: (1, (2 * n + 1 + skip) * (2 * n + 2 + skip)))
        far = (x[1] - x[0]) / 2 + abs(k) * (pi[1] - pi[0]) / 4
        low, high = (-high, -low) if (k + quarters) % 4 > 1 else (low, high)
        return self.held(low - far, high + far)


class Point:
    """What a claim's formulas are at a point; `of` has values of names, and formulas of functions."""

    def __init__(self, claim: Claim, of: dict[str, Any], real: Arithmetic) -> None:
        self.claim, self.of, self.real, self.count, self.signs = claim, of, real, count(), dict[str, bool]()
        self.at = cache(self.at)

    def at(self, f: Formula, *by: str) -> Interval:
        """The derivative of a formula by the names: by the chain rule, one after the other."""
        if len(by) > HIGHEST or next(self.count) > MOST_VALUES:
            raise Stop("not shown", "so many derivatives, or so high ones")
        if f.kind == "D":
            return self.at(f.of[0], *sorted((*by, *f.orders)))
        if not by or f.kind in "#.":
            return self.value(f) if not by else ONE if by == f.of else NONE
        self.at(f)  # where it has no value, it has no slope
        found = NONE
        for (k, inner), taken in product(enumerate(f.of), product((True, False), repeat=len(by) - 1)):
            if (steep := self.at(inner, by[0], *compress(by[1:], taken))) != NONE:
                outer = self.at(self.claim.outer(f, k), *compress(by[1:], (not one for one in taken)))
                found = self.real.add(found, self.real.times(steep, outer))
        return found

    def text(self, text: Any, *of: Formula) -> Interval:
        """What a text is; a and b stand for formulas."""
        return self.at(self.claim.read(text, dict(zip("ab", of, strict=False))) if of else self.claim.known(text))

    def value(self, f: Formula) -> Interval:
        if f.kind in "#.":
            return (f.of[0], f.of[0]) if f.kind == "#" else self.named(f.of[0])
        if f.kind in MEANINGS:
            return self.text(MEANINGS[f.kind], *f.of)
        real, a = self.real, [self.at(x) for x in f.of]
        if f.kind in "+*":
            return real.add(*a) if f.kind == "+" else real.times(*a)
        r = f.of[1].of[0] if f.kind == "^" and f.of[1].kind == "#" else Fraction(1, LARGEST)
        if f.kind == "^" and r.denominator == 1:
            return real.power(a[0], int(r))
        if f.kind in ("^", "log") and a[0][0] <= 0:
            raise Open("a root or a logarithm of what isn't positive")
        if f.kind == "^" and r.denominator == 2:
            return real.power(real.monotone(real.root, a[0]), r.numerator)
        if f.kind == "^":
            return real.monotone(real.exp, real.times(a[1], real.monotone(real.log, a[0])))
        if f.kind in ("exp", "log", "atan"):
            return real.monotone(getattr(real, f.kind), a[0])
        if f.kind in ("sin", "cos"):
            return real.sine(a[0], f.kind == "cos")
        if f.kind == "atan2":
            side = 0 if a[1][0] > 0 else 1 if a[0][0] > 0 else 2  # on the cut it is b/a that has no value
            return self.text(("atan(a/b)", "pi/2 - atan(b/a)", "-pi/2 - atan(b/a)")[side], *f.of)
        return self.function(f, a)

    def named(self, name: str) -> Interval:
        if name in self.claim.texts:
            return self.text(self.claim.texts[name])
        if name == "pi" or isinstance(self.of.get(name), tuple):
            return self.of.get(name, self.real.pi)
        raise Stop("not shown", f"what {name[:40]} is at the point")

    def function(self, f: Formula, a: list[Interval]) -> Interval:
        """A declared function is a formula of a, or of a1, a2, …: some smooth one is as this near the few places where
        it is asked, and has its sign everywhere."""
        words, names = self.claim.words[f.kind], ["a"] if len(a) == 1 else [f"a{k + 1}" for k in range(len(a))]
        power = " + ".join(f"{name}/{k + 2}" for k, name in enumerate(names))
        text = self.of.get(f.kind, f"-exp({power})" if "negative" in words else f"exp({power})")
        body = self.claim.read(text, {name: Formula(".", (f"#{name}",)) for name in names})
        inner = Point(self.claim, {f"#{name}": x for name, x in zip(names, a, strict=True)}, self.real)
        inner.count, value = self.count, inner.at(body)
        check(value, words)
        if "nonzero" in words and self.signs.setdefault(f.kind, value[0] > 0) != (value[0] > 0):
            raise Stop("not shown", "a function without zeros that has both signs")
        return inner.at(body, *(f"#{name}" for name, n in zip(names, f.orders, strict=True) for _ in range(n)))


def check(x: Interval, words: Any) -> None:
    """Raise Open where a number isn't seen to be as the words say."""
    low, high = x
    seen = {"positive": low > 0, "negative": high < 0, "nonnegative": low >= 0, "nonzero": low > 0 or high < 0,
            "integer": low == high and low.denominator == 1, "real": True, "function": True}  # fmt: skip
    if not all(seen[word] for word in words):
        raise Open("that a name, a function or a condition of the domain has the sign, or the value, that it must have")


def claim_of(tables: Any, of: Any = Claim) -> Claim:
    """What has to vanish, with the variables that the map gives. Raises Stop where it isn't all needed."""
    drop = lambda table, *keys: {key: x for key, x in table.items() if key not in keys}
    explicit, space, claim = (tables.get(key, {}) for key in ("transformation", "phase_space", "claim"))
    plain, claim, kind = drop(tables, "title", "source", "claim"), drop(claim, "title", "source"), claim["kind"]
    if (
        kind not in KINDS
        or ("generating_function" in tables and not explicit)
        or ("q" in explicit and kind not in MAPS)
    ):
        raise Stop("not shown", "a refutation of such a claim, or beside such a map")
    own = {"tensor", "structure"} & {*claim} or (kind == "hamiltonian_field" and "H" not in claim)
    if kind in TABLE or own:
        if Wider is None or (explicit and kind not in SQUARE):
            raise Stop("not shown", "a refutation of such a claim beside a map, or without alone_wider.py")
        return momenta_of(Wider({**plain, "claim": claim}), claim, space)
    if kind in VALUES and explicit:  # its variables are names like others, for which there are texts
        sides = {"q": [*space["q"], *space["Q"]], "p": [*space["p"], *space["P"]]}
        plain = drop(plain, "transformation") | {"phase_space": drop(space, *"QP") | sides}
    if kind == "inequality":
        claim = drop(claim, "relation") | {"kind": "identity"}
    found = of({**plain, "claim": claim})
    for side, texts in explicit.items():
        found.texts |= dict(zip(space[side], texts, strict=True))
    return found


def momenta_of(claim: Any, said: Any, space: Any) -> Any:
    """The claim, with what its momenta are by ∂S/∂q or ∂L/∂v, so that they have signs and lie in the domain."""
    f, by = ("__L", "velocities") if claim.kind == "legendre" else ("__S" if "S" in said else "__W", "")
    if claim.kind in ("legendre", "hamilton_jacobi"):
        names = zip(space["p"], said[by] if by else space["q"], strict=True)
        claim.texts |= {p: f"D({f}, {x})" for p, x in names}
    for given, _ in claim.solution.values():
        if any({*claim.words.get(name, ())} - {"real"} for name in given):
            raise Stop("not shown", "what is put in the place of a name that has a sign")
    return claim


def check_domain(point: Point, tables: Any) -> None:
    """All that is written has a value at the point, and the domain's conditions hold there. Raises Open."""
    claim = point.claim
    own = [text for name, text in claim.texts.items() if name[0] == "_" and not isinstance(text, list)]
    for text in [*tables.get("hamiltonian", {}).values(), *chain(*tables.get("transformation", {}).values()), *own]:
        point.text(text)
    for words in (re.split(r"(<=|>=|!=|<|>)", text) for text in claim.domain.get("where", [])):
        for a, sign, b in zip(words[::2], words[1::2], words[2::2], strict=False):
            names = re.findall(r"[^\W\d]\w*", a + b)
            edge = sign in ("<=", ">=") and all("integer" in claim.words.get(name, ()) for name in names)
            a, b = (a, b) if "<" in sign else (b, a)
            check(point.text(f"({b}) - ({a})"), ["nonzero" if sign == "!=" else "nonnegative" if edge else "positive"])
    for name, words in claim.words.items():
        if "function" not in words:
            given = name in claim.texts  # at its edge there may be no other points of the domain
            check(point.named(name), ["positive" if given and word == "nonnegative" else word for word in words])
    for text in getattr(claim, "besides", ()):
        if fails(point.text(text), ""):
            raise Open("that the claim's own bracket is one")


def somewhere(claim: Claim, witness: Any, k: int) -> dict[str, Any]:
    """The witness, and values for what it leaves open, which may have any; these are the k-th."""
    of = dict[str, Any]()
    for i, name in enumerate(dict.fromkeys([*claim.names, *claim.words])):
        words = claim.words.get(name, ())
        if "function" in words:
            of |= {name: witness[name]} if name in witness else {}
        elif name in witness:
            of[name] = number(witness[name]).of * 2
        else:
            value = Fraction(i + 2 + 3 * k, 1 if "integer" in words else 3 + 2 * k)
            of[name] = (-value if "negative" in words else value,) * 2
    return of


def fails(x: Interval, relation: str) -> bool:
    """Whether a number isn't as it has to be: 0, or below 0 (<), and so on."""
    low, high = x
    return {"": low > 0 or high < 0, "<": low >= 0, "<=": low > 0, ">": high <= 0, ">=": high < 0}[relation]


def refuted(tables: Any, witness: Any) -> tuple[str, str]:
    """Whether the claim fails at the witness."""
    claim, relation, reasons = claim_of(tables), tables["claim"].get("relation", ""), list[str]()
    for k, bits in product(range(TRIES), BITS):
        point, values = Point(claim, somewhere(claim, witness, k), Arithmetic(bits)), list[Interval]()
        try:
            check_domain(point, tables)
        except Open as left:
            reasons.append(str(left))
            continue
        for text in claim.zeros:
            with suppress(Open):
                values.append(point.text(text))
                if fails(values[-1], relation):
                    return "shown", ""
        nothing = values == [NONE] * len(claim.zeros)
        reasons.append("nothing fails at the witness" if nothing else "that something fails at the witness")
    nothing = {*reasons} == {"nothing fails at the witness"} and type(claim) is Claim
    return ("wrong" if nothing else "not shown"), reasons[-1]


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate that was read as JSON."""
    try:
        rest = json.dumps({key: data[key] for key in data if key != "checksum"}, sort_keys=True, separators=(",", ":"))
        if hashlib.sha256(rest.encode()).hexdigest() != data["checksum"]:
            raise Stop("wrong", "the checksum")
        if data["verdict"] != "refuted" or not isinstance(data["witness"], dict):
            raise Stop("not shown", "what isn't refuted at a point")
        return refuted(data["tables"], data["witness"])
    except Stop as stop:
        return stop.args[0], stop.args[1]
    except Exception as error:  # whatever a certificate has in the wrong place
        return "not shown", f"a certificate of another form ({type(error).__name__}: {error})"


if __name__ == "__main__":
    answers = []
    for path in sys.argv[1:]:
        answers.append(checked(json.loads(Path(path).read_bytes())))
        print(path, *filter(None, answers[-1]), sep=": ")
    sys.exit(1 if any(answer == "wrong" for answer, _ in answers) else 2 * any(a != "shown" for a, _ in answers))
