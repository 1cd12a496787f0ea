"""Points of a claim's domain, and the values of formulas there in fifty digits."""

from __future__ import annotations

import random
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

import mpmath

from canon.checker.case import Case
from canon.checker.core import Polynomial, number
from canon.checker.formulas import Formulas, Unknown, Unreadable
from canon.checker.intervals import off_the_edge
from canon.checker.statement import Statement
from canon.checker.whole import is_whole

DIGITS = 50
CLOSE = 30
"""To so many digits values must agree, of the fifty that they are computed in."""
TRIES, MOST, MANY = 60, 5, 30
FUNCTIONS = {
    "elliptic_k": "ellipk", "elliptic_e": "ellipe", "elliptic_f": "ellipf", "elliptic_pi": "ellippi",
    "abs": "fabs", "power": "power",
    "jacobi_sn": "sn", "jacobi_cn": "cn", "jacobi_dn": "dn",
}  # fmt: skip
"""The names of functions in mpmath, where they differ."""

STEEPEST, FLAT = 10**6, ("log", "abs", "sign", "atan", "atan2", "asinh")
"""The largest argument of a function that isn't one of the flat ones: beyond it the value's digits have no end."""

EDGED = ("log", "abs", "sign", "power")
"""Functions that end, or have a kink, where their argument is 0."""


class Outside(ValueError):
    """A point at which a formula isn't defined, isn't smooth, or isn't real."""


class Numbers:
    """Values at points, in a number of digits; `real`: what isn't real is outside of the domain."""

    def __init__(self, digits: int = DIGITS, *, real: bool = True) -> None:
        self.mp: Any = mpmath.MPContext()
        self.mp.dps, self.real = digits, real
        self.signs: Mapping[str, Sequence[str]] = {}

    def number(self, value: Fraction) -> Any:
        """A rational number."""
        return self.mp.mpf(value.numerator) / value.denominator

    def read(self, value: Any) -> Any:
        """A coordinate: "3/2", or {"re": …, "im": …}."""
        if isinstance(value, Mapping):
            return self.mp.mpc(*(self.number(number(value[part])) for part in ("re", "im")))
        return self.number(number(value))

    def values(self, f: Formulas, targets: Sequence[int], of: Mapping[str, Any]) -> dict[int, Any]:
        """The values of the targets and of all below them; `of` gives those of names, and functions' formulas.

        Raises Outside.
        """
        out: dict[int, Any] = {}
        above: dict[str, bool] = {}  # a smooth function without a zero has one sign
        for a in f.reach(*targets):
            op, parts = f.ops[a], [out[b] for b in f.parts(a)]
            try:
                if op[0] == "f" and op[1] in f.functions:
                    body = f.body(of[op[1]], op[2])
                    out[a] = self.values(f, [body], {f"#{k}": x for k, x in enumerate(parts, 1)})[body]
                    words = self.signs.get(op[1], ())
                    if not any(op[2]) and not allowed(words, out[a], self):
                        raise Outside
                    sign = bool(self.mp.re(out[a]) > 0)
                    if not any(op[2]) and "nonzero" in words and above.setdefault(op[1], sign) != sign:
                        raise Outside
                elif op[:2] == ("f", "power") and is_whole(f, op[3][1]):
                    out[a] = self._raised(*parts)
                else:
                    out[a] = self._value(op, parts, of)
            except (ValueError, ZeroDivisionError, OverflowError, TypeError) as error:
                raise error if isinstance(error, Unknown) else Outside from None
            if not self.mp.isfinite(out[a]) or (self.real and self.mp.im(out[a]) != 0):
                raise Outside
            out[a] = self.mp.re(out[a]) if self.real else out[a]
        return out

    def _raised(self, base: Any, exponent: Any) -> Any:
        """A power with a whole exponent, which has a value at every base but 0."""
        n = self.mp.nint(self.mp.re(exponent))
        if base == 0 or exponent != n or abs(n) > STEEPEST:
            raise Outside
        return base ** int(n)

    def _value(self, op: tuple[Any, ...], x: list[Any], of: Mapping[str, Any]) -> Any:
        mp = self.mp
        if op[0] == "n":
            return self.number(op[1])
        if op[0] == "s":
            if op[1] not in of and op[1] not in ("pi", "1j"):
                raise Unknown(f"the name {op[1][:40]!r} has no value")
            return of[op[1]] if op[1] in of else +mp.pi if op[1] == "pi" else mp.j
        if op[0] in "+*":
            return x[0] + x[1] if op[0] == "+" else x[0] * x[1]
        if op[0] == "^":
            if op[2] < 0 and abs(x[0]) < mp.mpf(10) ** (-mp.dps // 2):
                raise Outside
            return x[0] ** op[2]
        along = all(mp.im(y) == 0 for y in x)  # beside complex names, too, nothing is defined on a cut
        cut = op[1] in ("power", "log") and along and mp.re(x[0]) <= 0
        steep = op[1] not in FLAT and max(map(abs, x)) > STEEPEST
        if steep or cut or (op[1] in ("abs", "sign", "power", "log") and x[0] == 0):
            raise Outside
        if op[1] == "jacobi_epsilon":
            return mp.quad(lambda w: mp.ellipfun("dn", w, m=x[1]) ** 2, [0, x[0]])
        name = FUNCTIONS.get(op[1], op[1])
        if name in ("sn", "cn", "dn"):
            return mp.ellipfun(name, x[0], m=x[1])
        value = getattr(mp, name)(*x)
        if along and mp.im(value) != 0:
            raise Outside
        return value


def functions_at_random(s: Statement, rng: random.Random) -> dict[str, str]:
    """A formula for every declared function: b·exp(r₁a₁), of two arguments b·exp(r₁a₁ + r₂a₂) + c₁a₁² + c₂a₂², …"""
    found, counts = {}, {op[1]: len(op[3]) for op in s.f.ops if op[0] == "f"}
    for name in s.f.functions:
        slopes = (f"{rng.choice('+-')}{rng.randint(1, 9)}/7*a{k}" for k in range(1, counts.get(name, 1) + 1))
        sign = "-" if "negative" in s.words[name] else ""
        body = f"{rng.randint(1, 5)}/{rng.randint(1, 5)}*exp({''.join(slopes)})"
        count = counts.get(name, 1)
        squares = "".join(f" + {rng.randint(1, 9)}/7*a{k}**2" for k in range(1, count + 1)) if count > 1 else ""
        found[name] = f"{sign}({body}{squares})"
    return found


def points(
    s: Statement, case: Case, numbers: Numbers, hints: Sequence[Mapping[str, Any]], names: set[str]
) -> Iterator[dict[str, Any]]:
    """Up to five points of the domain, with a formula for each declared function.

    They are looked for near the hints, which are trusted for nothing, and elsewhere.
    """
    # nobody foresees the points of what is confirmed; what is measured never is wholly, and has the same ones each time
    rng, found = random.Random(1) if case.measured is not None else random.SystemRandom(), 0
    whole = {name: rng.sample(range(1, 6), 5) for name in sorted(names) if "integer" in s.words.get(name, ())}
    for attempt in range(TRIES * (1 + bool(hints))):
        hint = hints[attempt // 2 % len(hints)] if hints and attempt % 2 == 0 else {}
        of: dict[str, Any] = completed(s, numbers, {}, names - hint.keys(), rng, Fraction(1, 4 ** (attempt // 4 % 3)))
        for name in whole.keys() - hint.keys():  # even and odd ones, where what is said hangs on that
            of[name] = numbers.mp.sign(of[name]) * whole[name][attempt % 5]
        for name in sorted(names & hint.keys()):
            of[name] = numbers.read(hint[name])
            if "integer" not in s.words.get(name, ()):
                of[name] *= 1 + (rng.random() - 0.5) / 10 ** (1 + attempt % 8)
        if on_surface(s, numbers, of) and inside(s, case, numbers, of):
            yield of
            found += 1
        if found == (MANY if case.measured is not None and case.found else MOST):
            return


def on_surface(s: Statement, numbers: Numbers, of: dict[str, Any], held: Collection[str] = ()) -> bool:
    """Move a point onto the surface, the shortest way (Newton), names that are `held` staying; False where it can't."""
    f, mp, equations = s.f, numbers.mp, s.surface
    names = sorted({f.ops[a][1] for a in f.reach(*equations) if f.ops[a][0] == "s"} & of.keys() - s.fixed - {*held})
    slopes = [[f.slope(e, name) for name in names] for e in equations]
    for _ in range(40 if equations else 0):
        try:
            found = numbers.values(f, [*equations, *(d for row in slopes for d in row)], of)
            residual = [found[e] for e in equations]
            if mp.norm(residual) < mp.mpf(10) ** (5 - mp.dps):
                return True
            step = _shortest(mp, [[found[d] for d in row] for row in slopes], residual)
        except (Outside, ZeroDivisionError, ValueError):
            return False
        for name, change in zip(names, step, strict=True):
            of[name] -= change
    return not equations


def _shortest(mp: Any, rows: Sequence[Sequence[Any]], values: Sequence[Any]) -> list[Any]:
    """The shortest x with row · x = value for all rows but those that are, nearly, combinations of rows before them."""
    across, x = list[Any](), [mp.mpf(0) for _ in rows[0]]
    for row, value in zip(rows, values, strict=True):
        rest = [*row]
        for other in across:
            part = mp.fdot(rest, other, conjugate=True) / mp.norm(other) ** 2
            rest = [a - part * b for a, b in zip(rest, other, strict=True)]
        if rest and mp.norm(rest) > mp.mpf(10) ** (-mp.dps // 2) * mp.norm(row):
            part = (value - mp.fdot(row, x)) / mp.norm(rest) ** 2
            x = [a + part * mp.conj(b) for a, b in zip(x, rest, strict=True)]
            across.append(rest)
    return x


def completed(
    s: Statement,
    numbers: Numbers,
    given: Mapping[str, Any],
    names: set[str],
    rng: random.Random,
    scale: Fraction = Fraction(1),
) -> dict[str, Any]:
    """The values that are given, any others for the remaining names, and formulas for the functions that have none."""
    more = {name: _near(s.words.get(name, ()), rng, numbers, scale) for name in sorted(names - given.keys())}
    return {**functions_at_random(s, rng), **more, **given}


def anywhere(words: Sequence[str], rng: random.Random, scale: Fraction) -> Fraction | None:
    """A rational number for a real name, of the sign that is assumed of it; None for a complex one."""
    if "complex" in words:
        return None
    size = Fraction(rng.randint(1, 5)) if "integer" in words else scale * rng.getrandbits(60) / 2**58
    free = not {"positive", "negative", "nonnegative", "nonpositive"} & set(words)
    return -size if "negative" in words or "nonpositive" in words or (free and rng.random() < 0.5) else size


def _near(words: Sequence[str], rng: random.Random, numbers: Numbers, scale: Fraction) -> Any:
    size = anywhere(words, rng, scale)
    if size is None:
        return numbers.mp.mpc(numbers.number(scale * rng.getrandbits(60) / 2**58), rng.random() - 0.5)
    return numbers.number(size)


def inside(s: Statement, case: Case, numbers: Numbers, of: dict[str, Any]) -> bool:
    """Whether a point lies in the domain; the values of the case's images are added to it."""
    f = s.f
    try:
        for name, image in case.images.items():
            of[name] = numbers.values(f, [image], of)[image]
        written = [*domain_of(s), *(s.pull(image) for image in s.images.values())]
        found = numbers.values(f, [*written, *(a for a, _ in s.conditions), *case.somewhere], of)
    except Outside:
        return False
    if not all(numbers.mp.re(found[a]) > 0 for a in case.somewhere) or (s.surface and not _is_clear(s, found, of)):
        return False
    least = numbers.mp.mpf(10) ** (10 - numbers.mp.dps) if s.surface else 0  # nearer, Newton's steps end on the edge
    signs = ((numbers.mp.re(found[a]), kind) for a, kind in s.conditions)
    given = {name: found[s.pull(image)] for name, image in s.images.items()}
    return all(sign > least or (kind == "nonzero" and abs(sign) > least) for sign, kind in signs) and all(
        allowed(off_the_edge(words) if name in given else words, value, numbers)
        for name, value in {**of, **given}.items()
        if name not in f.functions and (words := s.words.get(name, ()))
    )


def _is_clear(s: Statement, found: Mapping[int, Any], of: Mapping[str, Any]) -> bool:
    """Whether a point is off the edges of the domain by more than rounding: x = 10⁻⁵⁰ isn't above 0 where x p = 0."""
    f, asked = s.f, [found[a] for a, _ in s.conditions]
    for a in found:
        op, parts = f.ops[a], f.parts(a)
        if (op[0] == "f" and op[1] in EDGED) or (op[0] == "^" and op[2] < 0):
            asked.append(found[parts[0]])
    signed = {"positive", "negative", "nonnegative", "nonpositive", "nonzero"}
    words = (of[name] for name in of if name not in f.functions and signed & {*s.words.get(name, ())})
    return all(abs(value) > 10.0**-CLOSE for value in asked) and all(not x or abs(x) > 10.0**-CLOSE for x in words)


def names_in(s: Statement, targets: Sequence[int]) -> set[str]:
    """The names that have to have values for formulas, and for the domain's conditions."""
    f = s.f
    leaves = {f.ops[a][1] for a in f.reach(*targets, *(a for a, _ in s.conditions)) if f.ops[a][0] == "s"}
    return {name for name in leaves if name in s.declared or name not in ("pi", "1j")}


def value_of(a: Polynomial, of: Mapping[str, Any], number_of: Callable[[Fraction], Any]) -> tuple[Any, Any]:
    """Its value, and the sum of the moduli of its terms: what its rounding errors are to be measured against."""
    total = size = number_of(Fraction(0))
    for monomial, c in a.items():
        term = number_of(c)
        for name, e in monomial:
            if name not in of:
                raise Unreadable(f"{name[:40]!r} is neither a name of the claim nor a kernel")
            term = term * of[name] ** e
        total, size = total + term, size + abs(term)
    return total, size


def domain_of(s: Statement) -> list[int]:
    """The formulas that have a value throughout the domain."""
    own = [*s.written, *s.f.unseen, *s.images.values()]
    still = {name: a for name, a in s.images.items() if s.f.value(a) is not None}
    return [*(s.pull(a) for a in own), *(s.pull(b) for a in (own if still else ()) for b in s.f.at(a, still))]


def allowed(words: Sequence[str], value: Any, numbers: Numbers) -> bool:
    """Whether a value is as its name's assumptions say."""
    real = numbers.mp.re(value)
    return not (
        ("positive" in words and not real > 0) or ("negative" in words and not real < 0)
        or ("nonnegative" in words and not real >= 0) or ("nonpositive" in words and not real <= 0)
        or ("nonzero" in words and value == 0) or ("integer" in words and value != numbers.mp.nint(real))
    )  # fmt: skip
