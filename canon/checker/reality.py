"""Where are kernels real? One that is real on a part of the domain only would say nothing of the rest.

The claim's own formulas are real on its domain, by the meaning of the domain; a kernel, or a formula that the
certificate adds, need not be: √(x + 1) as a kernel of a claim about every x would make x + 1 look like a square. So
each of its roots, logarithms and inverse functions must be one of the claim's, or its argument be seen to lie where
they are real. Nothing is concluded from a kernel before: with √x for one, |x| would be x, and x a part of any |x| + x.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping

from canon.checker import core
from canon.checker.followed import Followed
from canon.checker.functions import Unknown
from canon.checker.ratios import multiple
from canon.checker.roots import Undecided
from canon.checker.signs import Signs
from canon.checker.terms import sign_of
from canon.checker.tower import Element
from canon.checker.values import Values

ENTIRE = (
    "sin", "cos", "tan", "cot", "sec", "csc", "exp", "sinh", "cosh", "tanh", "coth", "atan", "asinh", "atan2", "abs",
    "sign", "jacobi_sn", "jacobi_cn", "jacobi_dn", "jacobi_epsilon",
)  # fmt: skip
"""Functions that are real wherever they have a value."""
FAILURES = (Undecided, Unknown, ZeroDivisionError, RecursionError, ValueError)


def unreal(followed: Followed, own: Iterable[int], kernels: Mapping[str, int]) -> list[str]:
    """What has to be taken on trust of kernels, and of formulas that a certificate adds to a claim's own."""
    s, known = followed.s, Real(followed, own, kernels)
    doubtful, again = {**kernels}, True
    while again:
        again = False
        for name, a in [*doubtful.items()]:
            if known.names(a) & doubtful.keys() - {name}:
                continue
            if known.is_real(a) or known.is_factor(name, a, doubtful):
                known.grant(name, doubtful.pop(name))
                again = True
    left = [*doubtful.values(), *(a for a in s.added if not known.is_real(a))]
    return [f"that {s.f.text(a)[:80]} is real throughout the domain" for a in left]


class Real:
    """What of a claim is known to be real on its domain: its own formulas, and what has a sign."""

    def __init__(self, followed: Followed, own: Iterable[int], kernels: Mapping[str, int]) -> None:
        self.s = s = followed.s
        self.f, self.atoms, self._tower = s.f, followed.atoms, followed.values.t
        self._granted = dict[str, int]()
        self._values: Values | None = None
        self._plain: Values | None = None
        self.own = {*s.f.reach(*own, *(a for a, _ in s.conditions))}
        self.words = {**s.words, "pi": ["positive"]}
        plain = [s.f.ops[a] for a, kind in s.conditions if kind == "positive"]
        self.words |= {op[1]: [*self.words.get(op[1], ()), "positive"] for op in plain if op[0] == "s"}
        arguments = [x for a in self.own if s.f.ops[a][0] == "f" for x in self._radicands(a)]
        self._known = [*arguments, *(a for a, kind in s.conditions if kind == "positive")]
        self._elements: list[Element] | None = None
        self.kernels = kernels

    def names(self, meaning: int) -> set[str]:
        """The names in a formula."""
        return {self.f.ops[b][1] for b in self.f.reach(meaning) if self.f.ops[b][0] == "s"}

    def grant(self, name: str, meaning: int) -> None:
        """Take a kernel for real from now on."""
        self._granted[name] = meaning
        self._values = self._elements = None

    @property
    def values(self) -> Values:
        """Values of formulas, those of kernels that are known to be real among them."""
        if self._values is None:
            self._values = Values(self.s, self._tower.prime, self._tower.rng, real=True)
            for name, a in self._granted.items():
                try:
                    self._values.kernel(name, a)
                except FAILURES:
                    continue
            left = self.kernels.keys() - self._granted.keys()
            self._values.roots.claimed = {
                a: x for a, x in self.atoms.items() if not any(core.names(p) & left for p in x)
            }
        return self._values

    def _without_signs(self) -> Values:
        """All kernels in a tower in which no root is known to be that of a number that isn't negative."""
        if self._plain is None:
            self._plain = Values(self.s, self._tower.prime, self._tower.rng, real=False)
            for name, a in self.kernels.items():
                try:
                    self._plain.kernel(name, a)
                except FAILURES:
                    continue
        return self._plain

    def is_real(self, meaning: int) -> bool:
        """Whether a formula is real throughout the domain, but where it has a pole."""
        for a in self.f.reach(meaning):
            op = self.f.ops[a]
            if op[0] != "f" or op[1] in ENTIRE or op[1] in self.f.functions or a in self.own:
                continue
            radicands = self._radicands(a)
            if not radicands and not self._is_own_function(a):
                return False
            if not all(self._is_nonnegative(x) or self._is_above(x) for x in radicands):
                return False
        return True

    def is_factor(self, name: str, meaning: int, doubtful: Collection[str]) -> bool:
        """Whether a kernel R^(1/n) is all that isn't known to be real in one of the claim's powers, n being even.

        With (g^k A/B)^n = S^m, which is nowhere negative where the claim's S^(m/n) is real, R^k = S^m (B/A)^n isn't
        either, nor R for an odd k: A and B being 0 on no component.
        """
        f, op, plain = self.f, self.f.ops[meaning], self._without_signs()
        roots, t = plain.roots, plain.t
        n = self.f.value(op[3][1]) if op[:2] == ("f", "power") else None
        if n is None or n.numerator != 1 or n.denominator % 2 or not self.is_real(op[3][0]):
            return False
        for a, (over, under) in self.atoms.items():
            m = f.value(f.ops[a][3][1]) if a in self.own and f.ops[a][:2] == ("f", "power") else None
            if m is None or m.denominator != n.denominator or core.names(over) & ({*doubtful} - {name}):
                continue
            powers = [{dict(monomial).get(name, 0) for monomial in p} for p in (over, under)]
            if any(len(p) != 1 for p in powers) or (min(powers[0]) - min(powers[1])) % 2 == 0:
                continue  # an odd power of g it has to be
            try:
                radicand = t.power(plain.value(f.ops[a][3][0]), m.numerator)
                if t.power(roots.fraction((over, under)), n.denominator) == radicand:
                    t.inverse(roots.fraction((over, core.ONE)))  # which there is none of where A is 0
                    return not core.names(under) & ({*doubtful} - {name})
            except FAILURES:
                continue
        return False

    def _radicands(self, a: int) -> list[int]:
        """Formulas that are nowhere negative where a function is real; none where that isn't said by such."""
        f, op = self.f, self.f.ops[a]
        x = op[3][0] if op[3] else 0
        if op[1] == "log" or (op[1] == "power" and not self._may_be_whole(op[3][1])):
            return [x]
        if op[1] in ("asin", "acos", "atanh"):
            return [f.sub(f.number(1), f.power(x, f.number(2)))]
        if op[1] in ("elliptic_f", "elliptic_e") and len(op[3]) == 2:
            return [f.sub(f.number(1), f.mul(op[3][1], f.power(f.node("f", "sin", (), (x,)), f.number(2))))]
        return [f.add(x, f.number(n)) for n in (1, -1)] if op[1] == "acosh" else []

    def _may_be_whole(self, exponent: int) -> bool:
        """Whether an exponent may be a whole number: qⁿ has a value for every q."""
        value, f = self.f.value(exponent), self.f
        named = [op for op in map(f.ops.__getitem__, f.reach(exponent)) if op[0] == "s" and op[1] != "pi"]
        whole = all("integer" in self.s.words.get(op[1], ()) for op in named)
        return (whole or f.ops[exponent][0] != "s") if value is None else value.denominator == 1

    def _is_own_function(self, a: int) -> bool:
        """Whether the claim has the same function, of the same arguments."""
        op = self.f.ops[a]
        others = [self.f.ops[b][3] for b in self.own if self.f.ops[b][:2] == op[:2]]
        try:
            mine = [self.values.value(x) for x in op[3]]
            return any([self.values.value(x) for x in other] == mine for other in others)
        except FAILURES:
            return False

    def _is_nonnegative(self, a: int) -> bool:
        f, op = self.f, self.f.ops[a]
        parts = f.parts(a)
        if op[0] == "n":
            return op[1] >= 0
        if op[0] == "s":
            kernel = self.kernels.get(op[1])
            own = kernel is not None and f.ops[kernel][0] == "f" and self._is_nonnegative(kernel)
            return own or bool({"positive", "nonnegative"} & {*self.words.get(op[1], ())})
        if op[0] == "f" and op[1] == "power" and self._may_be_whole(op[3][1]):
            return self._is_nonnegative(op[3][0])
        if op[0] == "f" and op[1] in ("exp", "cosh", "abs", "power"):  # of a root it is asked elsewhere that it be real
            return True
        if op[0] == "^" and op[2] % 2 == 0:
            return True
        if op[0] == "+" and all(map(self._is_nonnegative, parts)):
            return True
        if op[0] in "*^" and all(map(self._is_nonnegative, parts)):
            return True
        polynomial = self.values.polynomial(a)
        if polynomial is not None and sign_of(self.words, polynomial)[0] > 0:
            return True
        return self._is_known(a)

    def _is_above(self, a: int) -> bool:
        """Whether the rules for signs say so of a formula, with what kernels stand for."""
        if self.names(a) & (self.kernels.keys() - self._granted.keys()):
            return False
        meant = self.f.substitute(a, self.values.roots.meanings)
        return Signs(self.s).is_positive(meant, strict=False)

    def _is_known(self, a: int) -> bool:
        """Whether a formula is a positive multiple of one that the claim says to be nowhere negative."""
        if self._elements is None:
            self._elements = []
            for b in self._known:
                try:
                    self._elements.append(self.values.value(b))
                except FAILURES:
                    continue
        try:
            mine = self.values.value(a)
        except FAILURES:
            return False
        return any((multiple(mine, x, self.values.t.prime) or 0) > 0 for x in self._elements)
