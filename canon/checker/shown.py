"""What a certificate shows of one case of its claim: residuals that are 0, and what else has to be so.

For each residual that is claimed to vanish: (1) its functions, one by one, have the values in the kernels that the
certificate says, and the kernels satisfy their relations, by rules (`canon.checker.values`), no denominator being a
divisor of 0; (2) with these values the residual is numerator / denominator, as a rational function of the kernels as
free variables (at random values modulo random primes); (3) numerator = Σ cofactor · relation, exactly. Steps 2 and 3
are those of `canon.checker.core`. What the rules don't reach is seen in fifty digits at points of the domain, and
named.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from itertools import chain
from typing import Any

from canon.checker import core
from canon.checker.case import Case
from canon.checker.followed import Followed, is_identity
from canon.checker.functions import NotZero, Rejected, Unknown
from canon.checker.independent import are_independent
from canon.checker.inhabited import is_inhabited
from canon.checker.intervals import Intervals, Open
from canon.checker.points import CLOSE, DIGITS, Numbers, Outside, domain_of, names_in, points, value_of
from canon.checker.positive import is_positive
from canon.checker.reality import unreal
from canon.checker.shapes import is_algebraic
from canon.checker.statement import Statement
from canon.checker.told_apart import independence
from canon.checker.values import Values

SIGNS = {
    "pos": lambda x: _is_real(x) and x.real > 0, "neg": lambda x: _is_real(x) and x.real < 0,
    "nonneg": lambda x: _is_real(x) and x.real >= 0, "nonpos": lambda x: _is_real(x) and x.real <= 0,
    "real": lambda x: _is_real(x), "cplx": lambda x: True,
}  # fmt: skip
PRIMES = 2
"""Modulo so many primes a residual is compared with its numerator and denominator."""
MEASURED = 2
"""At so many points what takes an integral is measured."""
AGAIN = 4
"""So often are points drawn near which functions are seen to be independent: some are 0 on a part of the domain."""
Places = Sequence[tuple[dict[str, Any], dict[int, Any]]]


def _is_real(x: Any) -> bool:
    """Whether a value is real, as far as can be seen: beside complex names all values have an imaginary part."""
    return abs(x.imag) <= 10.0**-CLOSE * abs(x)


class Shown:
    """What is shown of a claim, at random values of its own; `hints` are points near which some are looked for."""

    def __init__(self, s: Statement, hints: Sequence[Any], *, real: bool) -> None:
        self.s, self.hints, self.real = s, hints, real
        self.numbers = Numbers(real=real)
        self.rng = random.SystemRandom()
        self.primes = [core.random_prime(self.rng) for _ in range(PRIMES)]

    def of(self, case: Case, data: Mapping[str, Any]) -> list[str]:
        """What has to be taken on trust of one case."""
        s, f, trusted = self.s, self.s.f, [case.trusted] if case.trusted else []
        if len(data["residuals"]) != len(case.zeros):
            raise Rejected(f"{len(data['residuals'])} residuals, but the claim has {len(case.zeros)}")
        if not (case.zeros or case.nonzeros or case.independent or case.positive or case.measured):
            return [*trusted, *self.is_somewhere(case)]
        kernels = {str(k["name"]): f.apart(k["stands for"], {}) for k in data["kernels"]}
        targets = [*case.zeros, *s.surface, *chain(*case.nonzeros), *case.independent, *(a for a, _ in case.positive)]
        targets += case.somewhere
        images = [s.pull(a) for a in case.images.values()]
        leaves = names_in(s, [*targets, *domain_of(s), *images, *case.mentions])
        if clash := kernels.keys() & (leaves | s.declared | {*s.words, *s.coordinates, s.time, *s.names, "pi", "1j"}):
            raise Rejected(f"the name {min(clash)} of a kernel is one of the claim's")
        leaves |= names_in(s, [*kernels.values()])
        places = self.places(case, kernels, leaves - kernels.keys() - case.images.keys(), targets)
        trusted += self._in_domain(case, places)
        granted = tuple(trusted)
        relations = self._relations(data["kernels"], list(kernels), places)
        known = {str(text): tuple(map(core.read, value)) for text, value in data["atoms"].items()}
        atoms = self._atoms([*case.zeros, *s.surface], known, places)
        followed = Followed(s, kernels, atoms, Values(s, self.primes[0], self.rng, real=self.real))
        if self.real:
            own = [*domain_of(s), *(targets if not s.added else [])]
            trusted += unreal(followed, own, kernels)
        used = {name for entry in data["residuals"] for name in entry.get("cofactors", {})} & relations.keys()
        lost = [f.text(kernels[n])[:80] for n in sorted(used) if not followed.vanishes(relations[n])]
        trusted += [f"the relation of {text} (seen to hold at {len(places)} points)" for text in lost]
        shown = [a for a, entry in zip(case.zeros, data["residuals"], strict=True) if "cofactors" in entry]
        lost = [a for a in f.rational([*shown, *s.surface])[1] if a in atoms and not followed.is_value(a)]
        trusted += [f"the value of {f.text(a)[:80]} in the kernels (seen at {len(places)} points)" for a in lost]
        if len(trusted) > len(granted) and not s.surface:  # what is 0 by the rules alone needs none of these
            own = Values(s, self.primes[-1], self.rng, real=self.real)
            if not (self.real and unreal(followed, domain_of(s), {})) and all(is_identity(own, a) for a in case.zeros):
                trusted = [*granted]
        for k, (a, entry) in enumerate(zip(s.surface, data.get("surface", []), strict=False), 1):
            self._denominator(entry, places)
            relations[f"surface {k}"] = core.fraction(self._program(a, atoms), entry, self.primes)
        for a, entry in zip(case.zeros, data["residuals"], strict=True):
            if any(abs(of[a]) > 10.0**-CLOSE * (1 + max(map(abs, of.values()))) for _, of in places):
                raise NotZero("a residual doesn't vanish at a point of the domain")
            if "expression" in entry and entry["expression"] != f.text(a):
                raise Rejected("a residual is written down wrongly")
            if "cofactors" not in entry and not followed.is_zero(a):
                trusted.append(f"the argument {str(entry['argument'])[:200]!r} (seen to hold at {len(places)} points)")
            if "cofactors" not in entry:
                continue
            self._denominator(entry, places)
            core.identity(self._program(a, atoms), entry, relations, self.primes)
            if s.surface and not followed.is_nowhere_zero(entry["denominator"]):
                trusted.append("that no denominator vanishes on a part of the surface")
            elif not followed.has_inverse(core.read(entry["denominator"])):
                trusted.append(f"that a denominator doesn't vanish identically (seen at {len(places)} points)")
        for group in case.nonzeros:
            if all(abs(of[a]) < 10.0**-CLOSE for a in group for _, of in places):
                raise Rejected("what must not vanish everywhere is 0 at all points that were tried")
            if not any(self._is_not_zero(a, of, followed) for a in group for of, _ in places):
                trusted.append("that what must not vanish everywhere doesn't, as values in 50 digits say")
        if case.independent and all(independence(s, case, case.independent, self.numbers, of) == 0 for of, _ in places):
            raise Rejected("what must be linearly independent is not, at the points that were tried")
        more = lambda: self.places(case, kernels, leaves - kernels.keys() - case.images.keys(), targets)
        at = (of for n in range(AGAIN) for of, _ in (more() if n else places))
        if case.independent and not are_independent(s, case.independent, at, case.algebra, case.is_simple):
            trusted.append("that the basis is independent for all values of the parameters, as values at points say")
        return [*trusted, *self._positive(case, places), *self._measured(case, places)]

    def is_somewhere(self, case: Case) -> list[str]:
        """What has to be taken on trust of a claim's domain, that there is one. Raises Unknown."""
        names = names_in(self.s, [*domain_of(self.s), *case.mentions]) - case.images.keys()
        return self._in_domain(case, self.places(case, {}, names, []))

    def _in_domain(self, case: Case, places: Places) -> list[str]:
        if not places:
            raise Unknown("the checker found no point of the domain")
        sure = is_inhabited(self.s, case, (of for of, _ in places), real=self.real)
        what = "there is such a motion" if case.somewhere else "the domain isn't empty, as values in 50 digits say"
        return [] if sure else [f"that {what}"]

    def _is_not_zero(self, a: int, of: Mapping[str, Any], followed: Followed) -> bool:
        """Whether a formula isn't identically 0: one of roots alone modulo a prime, others in intervals."""
        if is_algebraic(self.s, a):
            return not self.s.surface and followed.is_not_zero(a)
        if followed.is_number(a):
            return True
        own = Intervals(2 * DIGITS)
        try:
            point = {n: x if isinstance(x, str) else own.iv.mpf(x) for n, x in of.items()}
            return 0 not in own.values(self.s.f, [a], point)[a]
        except (Open, TypeError, ValueError):
            return False

    def _positive(self, case: Case, places: Places) -> list[str]:
        """What has to be taken on trust of what must be positive."""
        trusted = []
        for a, strict in case.positive:
            if any(of[a] < 0 or (strict and of[a] == 0) for _, of in places):
                raise Rejected("an inequality fails at a point of the domain")
            if not is_positive(self.s, a, strict=strict, real=self.real):
                trusted.append(f"that the inequality holds throughout the domain (seen to at {len(places)} points)")
        return trusted

    def _measured(self, case: Case, places: Places) -> list[str]:
        """Values that must vanish at points: what isn't seen to is wrong, and that it is so everywhere is trusted."""
        found = []
        for of, _ in places if case.measured is not None else ():
            if len(found) == (1 if case.found else MEASURED):
                break
            try:
                found.append(case.measured(self.numbers, of) if case.measured is not None else [])
            except Outside:
                continue
        if case.measured is not None and not found:
            raise Unknown("the checker found no point at which it could measure what is claimed")
        if any(abs(value) > 10.0**-case.digits for values in found for value in values):
            raise Rejected("what is claimed isn't what is measured at a point of the domain")
        trusted = f"that it holds everywhere, not only at the {len(found)} points where it was measured"
        return [trusted] if found and not case.found else []

    def places(self, case: Case, kernels: Mapping[str, int], free: set[str], targets: Sequence[int]) -> Places:
        """At some points of the domain: the values of names and kernels, and those of formulas."""
        found = []
        for of in points(self.s, case, self.numbers, self.hints, free):
            try:
                for name, a in kernels.items():
                    of[name] = self.numbers.values(self.s.f, [a], of)[a]
                found.append((of, self.numbers.values(self.s.f, targets, of)))
            except Outside:
                continue
        return found

    def _relations(self, kernels: Sequence[Any], order: list[str], places: Places) -> dict[str, core.Polynomial]:
        """The kernels' relations: each defines its own, and holds, as do their signs, at points of the domain."""
        relations = {str(k["name"]): core.read(k["relation"]) for k in kernels if "relation" in k}
        for name, relation in relations.items():
            if not core.is_triangular(relation, name, order[order.index(name) :]):
                raise Rejected(f"the relation of {name} is not one for it in terms of those before")
            for of, _ in places:
                value, size = value_of(relation, of, self.numbers.number)
                if abs(value) > 10.0**-CLOSE * size:
                    raise Rejected(f"the relation of {name} doesn't hold at a point of the domain")
        for kernel in kernels:
            if not all(SIGNS[kernel["sign"]](of[kernel["name"]]) for of, _ in places):
                raise Rejected(f"{kernel['name']} hasn't the sign that is stated")
        return relations

    def _atoms(self, zeros: Sequence[int], known: Mapping[str, Any], places: Places) -> dict[int, Any]:
        """The functions and constants in the residuals, each with its value in the kernels, which is checked."""
        f, atoms = self.s.f, {}
        for a in f.rational(zeros)[1]:
            text = f.text(a)
            if f.ops[a][0] == "s" and text not in known:
                atoms[a] = core.read({text: "1"}), core.ONE
                continue
            if text not in known:
                continue
            over, under = atoms[a] = known[text]
            for of, values in places:
                (x, size), (y, other) = (value_of(p, of, self.numbers.number) for p in (over, under))
                if abs(y) < 10.0**-CLOSE * other or abs(values[a] * y - x) > 10.0**-CLOSE * (size + other):
                    raise Rejected(f"{text[:80]} hasn't the value in the kernels that is stated")
        return atoms

    def _denominator(self, entry: Any, places: Places) -> None:
        under = core.read(entry["denominator"])
        for of, _ in places:
            value, size = value_of(under, of, self.numbers.number)
            if abs(value) < 10.0**-CLOSE * size:
                raise Rejected("a denominator vanishes at a point of the domain")

    def _program(self, a: int, atoms: Mapping[int, Any]) -> core.Program:
        """A formula as a program of its sums, products and powers."""
        f = self.s.f
        steps, leaves = f.rational([a])
        for leaf in leaves:
            if leaf not in atoms:
                raise Rejected(f"the value of {f.text(leaf)[:80]} in the kernels is missing")
        return core.Program(a, [(b, f.ops[b], f.parts(b)) for b in steps], {leaf: atoms[leaf] for leaf in leaves})
