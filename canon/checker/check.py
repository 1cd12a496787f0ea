"""Is what a certificate says so? Its claim's residuals are derived anew, its identities multiplied out.

For each residual that is claimed to vanish: (1) its functions, one by one, have the values in the kernels that the
certificate says, and the kernels satisfy their relations, at points of the domain in fifty digits; (2) with these
values the residual is numerator / denominator, as a rational function of the kernels as free variables (at random
values modulo a prime: an error has the probability degree / 2^127); (3) numerator = Σ cofactor · relation, exactly.
"""

from __future__ import annotations

import hashlib
import json
import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Any

from canon.checker import polynomials
from canon.checker.functions import Unknown, Unreadable
from canon.checker.kinds import obligations
from canon.checker.obligations import Case
from canon.checker.points import Numbers, Outside, completed, domain_of, inside, on_surface, points
from canon.checker.statement import KNOWN, Statement

VERSION = 1
PRIME = 2**127 - 1
FREE_POINTS = 2
CLOSE = 30
"""To so many digits values must agree, of the fifty that they are computed in."""

SIGNS = {
    "pos": lambda x: x > 0, "neg": lambda x: x < 0, "nonneg": lambda x: x >= 0, "nonpos": lambda x: x <= 0,
    "real": lambda x: x.imag == 0, "cplx": lambda x: True,
}  # fmt: skip


class Rejected(Exception):
    """What the certificate says isn't so."""


@dataclass(frozen=True)
class Answer:
    """`status` is "confirmed", "confirmed in part", "not confirmed" (what the checker has no rules for) or "rejected".

    `reasons` say what isn't confirmed, or what is wrong.
    """

    status: str
    reasons: tuple[str, ...] = ()

    def __str__(self) -> str:
        return ": ".join([self.status, *(["; ".join(self.reasons)] if self.reasons else [])])


def check(certificate: Any) -> Answer:
    """The answer about a certificate that has been read as JSON. Raises Unreadable for what is none."""
    if not isinstance(certificate, Mapping) or certificate.get("certificate") != VERSION:
        raise Unreadable(f"this is no certificate of version {VERSION}")
    try:
        if checksum(certificate) != certificate.get("checksum"):
            raise Rejected("the checksum is wrong: something was changed")
        trusted = tuple(dict.fromkeys(_Check(certificate).run()))
    except Rejected as reason:
        return Answer("rejected", (str(reason),))
    except (KeyError, TypeError, AttributeError, IndexError, ValueError, RecursionError) as error:
        if isinstance(error, Unknown):
            return Answer("not confirmed", (str(error),))
        raise Unreadable(str(error) if isinstance(error, Unreadable) else f"something is missing: {error}") from None
    return Answer("confirmed in part" if trusted else "confirmed", trusted)


def checksum(certificate: Mapping[str, Any]) -> str:
    """SHA-256 of all the rest, as compact JSON with its keys in order."""
    rest = {key: value for key, value in certificate.items() if key != "checksum"}
    return hashlib.sha256(json.dumps(rest, sort_keys=True, separators=(",", ":")).encode()).hexdigest()


class _Check:
    """One certificate being checked."""

    def __init__(self, certificate: Mapping[str, Any]) -> None:
        self.data, self.verdict = certificate, certificate["verdict"]
        if self.verdict not in KNOWN:
            raise Rejected(f"there is no proof of what is {str(self.verdict)[:40]!r}")
        self.s = Statement(certificate["tables"], certificate["known"], self.verdict)
        self.cases = obligations(self.s)
        self.s.check_names()
        words = chain.from_iterable(self.s.words.values())
        self.real = "complex" not in words and ("s", "1j") not in self.s.f.ops
        self.numbers = Numbers(real=self.real)

    def run(self) -> list[str]:
        """What has to be taken on trust. Raises Rejected."""
        if self.verdict == "refuted" and self.data.get("witness") is not None:
            return self._witness(self.data["witness"])
        if self.data.get("witness") is not None:
            raise Rejected("a proof with a witness against it")
        if len(self.data["cases"]) != len(self.cases):
            raise Rejected(f"{len(self.data['cases'])} cases are shown, but the claim has {len(self.cases)}")
        trusted = []
        for case, data in zip(self.cases, self.data["cases"], strict=True):
            if self.verdict == "refuted":  # by an exact argument: what must not vanish everywhere does
                case = Case(case.nonzeros[0] if case.nonzeros else [], [], case.images)
                if not case.zeros:
                    raise Unknown("a refutation without a point, by an argument that there is no rule for")
            trusted += self._case(case, data)
        return trusted

    # -- refutations --------------------------------------------------------------------------------

    def _witness(self, witness: Mapping[str, Any]) -> list[str]:
        """Some residual isn't 0 at the witness, which lies in the domain: in 50 digits and in 100.

        What it leaves open may have any value that the domain admits.
        """
        f, rng = self.s.f, random.Random(1)
        for case in (case for case in self.cases for _ in range(20)):
            sizes, names = [], self._names([*case.zeros, *domain_of(self.s)]) - case.images.keys()
            given = {n: x if n in f.functions else self.numbers.read(x) for n, x in witness.items()}
            of = completed(self.s, self.numbers, given, names, rng)
            for numbers in (self.numbers, Numbers(100, real=self.real)):
                of |= {n: numbers.read(x) for n, x in witness.items() if n not in f.functions}
                if not on_surface(self.s, numbers, of) or not inside(self.s, case, numbers, of):
                    break
                try:
                    found = numbers.values(f, case.zeros, of)
                except Outside:
                    break
                sizes.append(max((abs(found[z]) for z in case.zeros), default=0))
            if len(sizes) == 2 and sizes[0] > 10.0**-CLOSE and abs(sizes[1] / sizes[0] - 1) < 1e-9:
                return []
        raise Rejected("at the witness the claim doesn't fail, or it isn't a point of the domain")

    def _names(self, targets: Sequence[int]) -> set[str]:
        """The names that have to have values."""
        f, conditions = self.s.f, [a for a, _ in self.s.conditions]
        leaves = {f.ops[a][1] for a in f.reach(*targets, *conditions) if f.ops[a][0] == "s"}
        return {name for name in leaves if name in self.s.declared or name not in ("pi", "1j")}

    # -- proofs -------------------------------------------------------------------------------------

    def _case(self, case: Case, data: Mapping[str, Any]) -> list[str]:
        """What has to be taken on trust of one case."""
        s, f, trusted = self.s, self.s.f, [case.trusted] if case.trusted else []
        kernels = {str(k["name"]): f.read(k["stands for"], {}) for k in data["kernels"]}
        relations = {str(k["name"]): polynomials.read(k["relation"]) for k in data["kernels"] if "relation" in k}
        residuals = data["residuals"]
        if len(residuals) != len(case.zeros):
            raise Rejected(f"{len(residuals)} residuals, but the claim has {len(case.zeros)}")
        targets = [*case.zeros, *chain(*case.nonzeros)]
        images = [s.pull(a) for a in case.images.values()]
        leaves = self._names([*targets, *kernels.values(), *domain_of(s), *images])
        free = leaves - kernels.keys() - case.images.keys()
        if clash := kernels.keys() & (leaves & {*s.words, *s.coordinates, s.time, *s.names}):
            raise Rejected(f"the name {min(clash)} of a kernel is one of the claim's")
        places = self._values(case, kernels, free, targets)
        if not places:
            raise Unknown("the checker found no point of the domain")
        order = list(kernels)
        for name, relation in relations.items():
            if not _is_triangular(relation, name, order[order.index(name) :]):
                raise Rejected(f"the relation of {name} is not one for it in terms of those before")
            self._vanishes(relation, places, f"the relation of {name}")
        for kernel in data["kernels"]:
            test = SIGNS[kernel["sign"]]
            if not all(test(of[kernel["name"]]) for of, _ in places):
                raise Rejected(f"{kernel['name']} hasn't the sign that is stated")
        known = {str(text): tuple(map(polynomials.read, value)) for text, value in data["atoms"].items()}
        atoms = self._atoms([*case.zeros, *s.surface], known, places)
        for k, (a, entry) in enumerate(zip(s.surface, data.get("surface", []), strict=False), 1):
            relations[f"surface {k}"] = self._fraction(a, entry, atoms, places)
        for a, entry in zip(case.zeros, residuals, strict=True):
            if any(abs(of[a]) > 10.0**-CLOSE * (1 + max(map(abs, of.values()))) for _, of in places):
                raise Rejected("a residual doesn't vanish at a point of the domain")
            if "expression" in entry and entry["expression"] != f.text(a):
                raise Rejected("a residual is written down wrongly")
            if "cofactors" not in entry:
                trusted.append(f"the argument {str(entry['argument'])[:200]!r} (seen to hold at {len(places)} points)")
                continue
            self._identity(a, entry, atoms, relations, places)
        for group in case.nonzeros:
            if all(abs(of[a]) < 10.0**-CLOSE for a in group for _, of in places):
                raise Rejected("what must not vanish everywhere is 0 at all points that were tried")
        return trusted

    def _values(
        self, case: Case, kernels: Mapping[str, int], free: set[str], targets: Sequence[int]
    ) -> list[tuple[dict[str, Any], dict[int, Any]]]:
        """At some points of the domain: the values of names and kernels, and those of formulas."""
        found = []
        for of in points(self.s, case, self.numbers, self.data.get("points", []), free):
            try:
                for name, a in kernels.items():
                    of[name] = self.numbers.values(self.s.f, [a], of)[a]
                found.append((of, self.numbers.values(self.s.f, targets, of)))
            except Outside:
                continue
        return found

    def _vanishes(self, relation: polynomials.Polynomial, places: Sequence[Any], what: str) -> None:
        for of, _ in places:
            value, size = polynomials.value(relation, of, self.numbers.number)
            if abs(value) > 10.0**-CLOSE * size:
                raise Rejected(f"{what} doesn't hold at a point of the domain")

    def _atoms(self, zeros: Sequence[int], known: Mapping[str, Any], places: Sequence[Any]) -> dict[int, Any]:
        """The functions and constants in the residuals, each with its value in the kernels, which is checked."""
        f, atoms = self.s.f, {}
        for a in f.rational(zeros)[1]:
            text = f.text(a)
            if f.ops[a][0] == "s" and text not in known:
                atoms[a] = polynomials.read({text: "1"}), polynomials.read({"": "1"})
                continue
            if text not in known:
                continue
            over, under = atoms[a] = known[text]
            for of, values in places:
                (x, size), (y, other) = (polynomials.value(p, of, self.numbers.number) for p in (over, under))
                if abs(y) < 10.0**-CLOSE * other or abs(values[a] * y - x) > 10.0**-CLOSE * (size + other):
                    raise Rejected(f"{text[:80]} hasn't the value in the kernels that is stated")
        return atoms

    def _identity(self, a: int, entry: Any, atoms: Any, relations: Mapping[str, Any], places: Sequence[Any]) -> None:
        """residual = numerator / denominator, and numerator = Σ cofactor · relation."""
        rest = {m: -c for m, c in self._fraction(a, entry, atoms, places).items()}
        for name, cofactor in entry["cofactors"].items():
            rest = polynomials.combined(rest, relations[name], polynomials.read(cofactor))
        if rest:
            raise Rejected("a numerator isn't the sum of cofactors times relations")

    def _fraction(self, a: int, entry: Any, atoms: Mapping[int, Any], places: Sequence[Any]) -> polynomials.Polynomial:
        """The numerator of a formula, of which numerator / denominator is the value in the kernels."""
        over, under = (polynomials.read(entry[word]) for word in ("numerator", "denominator"))
        if not over and under != polynomials.read({"": "1"}):
            raise Rejected("0 is written as 0/1")
        for of, _ in places:
            value, size = polynomials.value(under, of, self.numbers.number)
            if abs(value) < 10.0**-CLOSE * size:
                raise Rejected("a denominator vanishes at a point of the domain")
        rng, done, everything = random.SystemRandom(), 0, chain(*atoms.values(), [over, under])
        names = set(chain.from_iterable(polynomials.names(p) for p in everything))
        for _ in range(5 * FREE_POINTS):
            of = {name: rng.randrange(PRIME) for name in names}
            try:
                value = _modulo(self.s.f, a, atoms, of)
            except ZeroDivisionError:
                continue
            if (value * polynomials.modulo(under, of, PRIME) - polynomials.modulo(over, of, PRIME)) % PRIME:
                raise Rejected("a formula of the claim isn't the numerator over the denominator that is stated")
            done += 1
        if done < FREE_POINTS:
            raise Rejected("a formula of the claim has no value in the kernels")
        return over


def _is_triangular(relation: polynomials.Polynomial, name: str, later: Sequence[str]) -> bool:
    """Whether it is name^n + lower powers of name, with none of the kernels after it.

    No polynomial in the kernels before it, other than 0, is a consequence of such relations: each defines its kernel.
    """
    degree = max((e for monomial in relation for n, e in monomial if n == name), default=0)
    top = [m for m in relation if (name, degree) in m]
    return (
        degree > 0
        and top == [((name, degree),)]
        and relation[top[0]] == 1
        and not (polynomials.names(relation) & {*later} - {name})
    )


def _modulo(f: Any, target: int, atoms: Mapping[int, Any], of: Mapping[str, int]) -> int:
    """The value of a residual at free values of the kernels, modulo the prime."""
    out: dict[int, int] = {}
    inner, leaves = f.rational([target])
    for a in leaves:
        if a not in atoms:
            raise Rejected(f"the value of {f.text(a)[:80]} in the kernels is missing")
        over, under = (polynomials.modulo(p, of, PRIME) for p in atoms[a])
        out[a] = over * _inverse(under) % PRIME
    for a in inner:
        op, x = f.ops[a], [out[b] for b in f.parts(a)]
        if op[0] == "n":
            out[a] = op[1].numerator * _inverse(op[1].denominator) % PRIME
        elif op[0] == "^":
            out[a] = pow(x[0] if op[2] > 0 else _inverse(x[0]), abs(op[2]), PRIME)
        else:
            out[a] = (x[0] + x[1] if op[0] == "+" else x[0] * x[1]) % PRIME
    return out[target]


def _inverse(x: int) -> int:
    if x % PRIME == 0:
        raise ZeroDivisionError
    return pow(x, -1, PRIME)
