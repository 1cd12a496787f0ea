"""Claims with complex names or 1j, for `alone.py` and its table: `python alone_complex.py CERTIFICATE.json …`

Modulo a prime that is 1 modulo 4 there is a number i with i² = −1. Nothing is positive then: conditions of the domain
aren't used, so that more is asked for, and a square root has either sign, by chance, for each radicand; those of names
that are positive, and of their products, are products of numbers. An exponential of a term v is a random number, one
of −v its inverse, and cos z and sin z are (e^iz ± e^−iz)/2 and /2i. Other functions are of what is real alone.
"""

from __future__ import annotations

import ast
import json
from fractions import Fraction
from functools import cache
from math import isqrt, prod
from typing import Any

if __package__:
    from canon.checker import alone, alone_wider
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_wider  # type: ignore

Formula, Stop, MODULUS, RANDOM = alone.Formula, alone.Stop, alone.MODULUS, alone.RANDOM
UNIT = Formula(".", ("1j",))
ANALYTIC = ("#", ".", "+", "*", "^", "exp", "sin", "cos", "D")


class Complex:
    """What is read otherwise: a claim with complex names."""

    def __init__(self, tables: Any) -> None:
        tables, self.is_complex = json.loads(json.dumps(tables)), cache(self.is_complex)
        words = {n: [w] if isinstance(w, str) else w for n, w in tables.get("symbols", {}).items()}
        self.spread = {n for n, w in words.items() if "complex" in w} | {"1j"}
        if any({*words[n]} - {"complex", "nonzero"} for n in self.spread - {"1j"}):
            raise Stop("not shown", "a complex name with a sign")
        plain = {n: ["nonzero"] if "nonzero" in w else ["real"] for n, w in words.items() if n in self.spread}
        super().__init__({**tables, **({"symbols": words | plain} if words else {})})  # type: ignore[call-arg]
        self.domain = {}

    def is_complex(self, f: Any) -> bool:
        """Whether a formula isn't one of real names alone."""
        if f.kind == "." and f.of[0] in self.texts:  # type: ignore[attr-defined]
            return self.is_complex(self.known(self.texts[f.of[0]]))  # type: ignore[attr-defined]
        return any(self.is_complex(g) if isinstance(g, Formula) else g in self.spread for g in f.of)

    def built(self, at: Any, text: str, own: Any) -> Any:
        if isinstance(at, ast.Constant) and isinstance(at.value, complex):
            return self.made("*", alone.number((ast.get_source_segment(text, at) or "")[:-1]), UNIT)  # type: ignore
        f = super().built(at, text, own)  # type: ignore[misc]
        if f.kind not in ANALYTIC and self.is_complex(f):
            raise Stop("not shown", f"{f.kind[:40]} of what is complex")
        return f


class Small(Complex, alone.Claim):
    """A claim that `alone` knows."""

    form: Any = {}  # noqa: RUF012


class Wide(Complex, alone_wider.Wider):
    """One of the table."""


class Imaginary(Wide):
    """One with a scale that is i times a number."""

    def __init__(self, tables: Any) -> None:
        super().__init__(tables)
        if self.texts.get("_scale") != "__scale":
            raise Stop("not shown", "a scale that isn't looked for")
        self.texts["_scale"] = "1j*__scale"


class Numbers(alone_wider.Placed):
    """A random point modulo a prime with a root of −1."""

    def __init__(self, claim: Any, prime: int) -> None:
        super().__init__(claim, prime)
        self.halves, self.is_positive, self.halved = dict[int, int](), cache(self.is_positive), cache(self.halved)

    def named(self, name: str) -> int:
        if name == "1j":
            if ("1j",) not in self.free:
                self.free["1j",] = self.square_root(self.p - 1)
            return self.free["1j",]
        value, said = super().named(name), {*self.claim.words.get(name, ())}
        if (name == "pi" or said & {"positive", "nonnegative"}) and name not in self.claim.texts:
            self.halves[value] = self.free[name,]
        return value

    def square_root(self, x: int) -> int:
        """A square root of x: by Tonelli's and Shanks's method, of either sign."""
        p = self.p
        if x == 0 or pow(x, self.half, p) != 1:
            raise alone.Elsewhere
        odd, twos = p - 1, 0
        while odd % 2 == 0:
            odd, twos = odd // 2, twos + 1
        z = next(z for z in iter(lambda: RANDOM.randrange(2, p), 0) if pow(z, self.half, p) == p - 1)
        c, root, rest = pow(z, odd, p), pow(x, (odd + 1) // 2, p), pow(x, odd, p)
        while rest != 1:
            k = next(k for k in range(1, twos) if pow(rest, 1 << k, p) == 1)
            step = pow(c, 1 << (twos - k - 1), p)
            twos, c = k, step * step % p
            root, rest = root * step % p, rest * c % p
        return root * RANDOM.choice((1, -1)) % p

    def root(self, x: int, r: Fraction) -> int:
        if r.denominator > 2:
            raise Stop("not shown", "another root than a square root")
        if r.denominator == 2 and x not in self.halves:
            self.halves[x] = self.square_root(x)
            self.roots.add(x)
        return pow(self.halves[x] if r.denominator == 2 else x, r.numerator if r.denominator == 2 else int(r), self.p)

    def is_positive(self, f: Any) -> bool:
        """Whether a formula is a product of powers of numbers and names that are positive."""
        if f.kind == "." and f.of[0] in self.claim.texts:
            return self.is_positive(self.claim.known(self.claim.texts[f.of[0]]))
        if f.kind == "^":
            return f.of[1].kind == "#" and self.is_positive(f.of[0])
        named = f.kind == "." and (f.of[0] == "pi" or "positive" in self.claim.words.get(f.of[0], ()))
        return named or (f.kind == "#" and f.of[0] > 0) or (f.kind == "*" and all(map(self.is_positive, f.of)))

    def halved(self, f: Any) -> int:
        """The positive square root of such a product."""
        if f.kind == "." and f.of[0] in self.claim.texts:
            return self.halved(self.claim.known(self.claim.texts[f.of[0]]))
        if f.kind == "*":
            return prod(map(self.halved, f.of)) % self.p
        if f.kind == "^" and f.of[1].of[0].denominator == 1:
            return pow(self.halved(f.of[0]), int(f.of[1].of[0]), self.p)
        if f.kind == "#" and all(isqrt(n) ** 2 == n for n in f.of[0].as_integer_ratio()):
            return self.fraction(Fraction(*map(isqrt, f.of[0].as_integer_ratio())), self.p)
        return self.root(self.at(f), Fraction(1, 2))

    def value(self, f: Any) -> int:
        if f.kind == "^" and f.of[1].kind == "#" and f.of[1].of[0].denominator == 2 and self.is_positive(f.of[0]):
            return pow(self.halved(f.of[0]), f.of[1].of[0].numerator, self.p)
        if f.kind == "exp":
            found, size = 1, MODULUS**2
            for v, r in self.terms(f.of[0]).items():
                v, r = (v, r) if v <= self.p - v else (self.p - v, -r)
                if (r * size).denominator > 1:
                    raise Stop("not shown", "a part of an exponent")
                found = found * pow(self.any("exp", v), int(r * size), self.p) % self.p
            return found
        if "germ" in self.asked.form and f.kind in {*alone.SLOPES} - {*"+*", "sin", "cos"}:
            if f.kind != "^" or f.of[1].of[0].denominator > 1:  # an edge or a cut isn't seen without signs
                raise Stop("not shown", "what is near 0")
        if f.kind in ("sin", "cos"):
            up = self.at(Formula("exp", (Formula("*", (UNIT, f.of[0])),)))
            down, two = pow(up, -1, self.p), pow(2, -1, self.p)
            return (
                (up + down) * two % self.p
                if f.kind == "cos"
                else (up - down) * two * pow(self.at(UNIT), -1, self.p) % self.p
            )
        return super().value(f)

    def check(self) -> None:
        if any(words & {"positive", "nonnegative", "negative"} for _, words in self.asked.places):
            raise Stop("not shown", "what is put in the place of a name that has a sign")
        super().check()


def random_prime() -> int:
    """A prime that is 1 modulo 4 MODULUS, by Fermat's test, as it is a random number."""
    while True:
        p = 4 * MODULUS * RANDOM.getrandbits(125 - MODULUS.bit_length()) + 1
        if p > 2**110 and all(pow(RANDOM.randrange(2, p), p - 1, p) == 1 for _ in range(20)):
            return p


def sample(claim: Any, case: Any, _: int) -> int:
    """Put one random point into everything; returns the number of roots that were met."""
    return alone.sample(claim, case, random_prime(), Numbers, Numbers.check if isinstance(claim, Wide) else None)


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    answer = alone.checked(data, Small, sample)
    answer = answer if answer[0] != "not shown" else alone.checked(data, Wide, sample)
    return answer if answer[0] != "not shown" else alone.checked(data, Imaginary, sample)


if __name__ == "__main__":
    alone.main(checked)
