"""A claim file's tables as the checker reads them: names, formulas, the map in coordinates, its brackets."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import combinations
from typing import Any

from canon.checker import places, stated
from canon.checker.formulas import Formulas
from canon.checker.functions import Unknown, Unreadable
from canon.checker.whole import at_least_zero, is_thin

TYPES = {1: ("q", 1, "Q", -1), 2: ("q", 1, "P", 1), 3: ("p", -1, "Q", -1), 4: ("p", -1, "P", 1)}
"""Of each type of generating function: its old variable, the sign of ∂F by it, its new one, the sign of ∂F by that."""

LARGEST = 12
"""The most rows of a Pfaffian; of a determinant, half of it."""
KNOWN = {
    "proved": ("determinant", "potential", "structure", "antiderivative", "torus"),
    "refuted": ("fails_at_order", "structure"),
}
"""What a certificate may say of what its claim leaves open."""


_IMAGINARY = re.compile(r"[\d.]j\b", re.IGNORECASE)
DESCRIBE = ("kind", "title", "source", "expect", "budget", "antiderivative")
"""Keys of claims that say nothing of what has to hold."""


class Keys(dict[str, Any]):
    """A claim's keys, and which were asked for: one that nobody looked at may change what the claim means."""

    def __init__(self, table: Mapping[str, Any]) -> None:
        super().__init__(table)
        self.unread = {*table} - {*DESCRIBE}

    def __getitem__(self, key: str) -> Any:
        self.unread.discard(key)
        if not super().__contains__(key):
            raise Unreadable(f"the claim has no key {key[:40]!r}, which its rule needs")
        return super().__getitem__(key)

    def __contains__(self, key: object) -> bool:
        self.unread.discard(str(key))
        return super().__contains__(key)

    def get(self, key: str, default: Any = None) -> Any:
        """The value of a key."""
        self.unread.discard(key)
        return super().get(key, default)


class Statement:
    """A claim file's tables with one claim, in the coordinates in which old and new variables are explicit.

    `known` is what the certificate says of what a claim leaves open, where that can do no harm: of a proof, the
    determinant's phase or a potential; of a refutation, the order at which a series fails.
    """

    def __init__(self, tables: Mapping[str, Any], known: Mapping[str, Any], verdict: str) -> None:
        stated.check_names(tables)
        space, self.claim = tables["phase_space"], Keys(tables["claim"])
        self.verdict = verdict
        self.known = {word: known[word] for word in KNOWN[verdict] if word in known}
        self.words = {name: [w] if isinstance(w, str) else list(w) for name, w in tables.get("symbols", {}).items()}
        self.q, self.p, self.Q, self.P = (list(space.get(side, [])) for side in "qpQP")
        functions = [name for name, words in self.words.items() if "function" in words]
        self.f = Formulas(functions, list(zip(self.q, self.p, strict=True)), self.words)
        self.f.taken |= {*self.q, *self.p, *self.Q, *self.P, space.get("time", "t"), *stated.own_names(self.claim)}
        self.f.is_complex = self.f.is_complex or _IMAGINARY.search(str(tables)) is not None
        self.fixed = {n for n, words in self.words.items() if "integer" in words}
        self.declared = {*self.words, *self.q, *self.p, *self.Q, *self.P}
        self.time, self.names, self.written = stated.time_of(tables), dict[str, int](), list[int]()
        self.added: list[int] = []  # formulas that the certificate says of what the claim leaves open
        self.trusted: list[str] = []  # what the claim's place beside a map takes on trust, whatever its verdict
        self.bracketed: list[str] = []  # coordinates of a bracket that isn't the canonical one
        later = {*tables.get("definitions", {})}
        for name, text in tables.get("definitions", {}).items():
            self.f.abbreviate(name, text, self.names)
            if early := stated.written_names(self, text) & later:
                raise Unreadable(f"{min(early)[:40]!r} is defined further down than it is used")
            later.discard(name)
        self._H = self.f.read(tables["hamiltonian"]["H"], self.names) if "hamiltonian" in tables else None
        self.written += [] if self._H is None else [self._H]
        self._chart(tables.get("transformation"), tables.get("generating_function"))
        stated.check_sides(self, tables)
        places.check_places(self, tables)
        self.domain = tables.get("domain", {})
        self._restrict()
        self._check_declared(set())  # the file's own sections don't know the claim's own names

    def _restrict(self) -> None:
        """The surface, and what the inequalities say, in the coordinates."""
        self.surface = [self.pull(self.f.read(text, self.names)) for text in self.domain.get("on", [])]
        self.conditions = [c for text in self.domain.get("where", []) for c in self.relation(text)]

    def check_names(self) -> None:
        """Refuse a name that nothing declares: a section of the file, or a key of the claim that holds names."""
        self._check_declared(stated.own_names(self.claim))

    def _check_declared(self, more: set[str]) -> None:
        known = self.declared | more | {self.time, "pi", "1j"}
        for op in self.f.ops:
            if op[0] == "s" and op[1][0] != "#" and op[1] not in known:
                raise Unreadable(f"the name {op[1][:40]!r} is not declared")

    def without_map(self) -> None:
        """Leave the map out of the domain: the claim is one in the old variables, without conditions on new ones."""
        self.direction, self.images, new = "none", dict[str, int](), {*self.Q, *self.P}
        self._restrict()
        for_new = {
            a
            for a, _ in self.conditions
            if new & {self.f.ops[b][1] for b in self.f.reach(a) if self.f.ops[b][0] == "s"}
        }
        self.conditions = [(a, kind) for a, kind in self.conditions if a not in for_new]

    def on_old_side(self) -> None:
        """Leave out a map that gives old variables by others, but of refutations.

        What is proved of all old variables is so on the map's image, too; what refutes is to be one of its points. A
        map that is given forward restricts both; what the claim calls its constants is none of the map's values.
        """
        if self.direction == "forward":
            for name in stated.own_names(self.claim) & {*self.images}:
                del self.images[name]
            self._restrict()
        elif self.verdict == "proved":
            self.without_map()

    def parameter(self, name: Any) -> str:
        """A name that stands for a number: no variable of the phase space. Raises Unreadable for any other."""
        if not isinstance(name, str) or name in {*self.q, *self.p, *self.Q, *self.P, *self.f.functions, "pi"}:
            raise Unreadable(f"{str(name)[:40]!r} is no parameter")
        return name

    def without(self, a: int, names: Iterable[str]) -> None:
        """Refuse a formula with a name that the claim varies: it would be varied, too. Raises Unreadable."""
        if found := {self.f.ops[b][1] for b in self.f.reach(a) if self.f.ops[b][0] == "s"} & {*names}:
            raise Unreadable(f"{min(found)[:40]!r} is a name of the claim's own, and stands in a formula besides")

    @property
    def H(self) -> int:
        """The Hamiltonian."""
        if self._H is None:
            raise Unreadable("a claim about a Hamiltonian that isn't there")
        return self._H

    def key(self, name: str) -> int:
        """A key of the claim that is a formula; its values are part of the domain."""
        found = self.f.read(self.claim[name], self.names)
        self.written.append(found)
        return found

    def keys(self, name: str) -> list[int]:
        """A key of the claim that is a list of formulas."""
        found = [self.f.read(text, self.names) for text in self.claim[name]]
        self.written += found
        return found

    def relation(self, text: str) -> Iterator[tuple[int, str]]:
        """The differences that an inequality says to be positive, or not to vanish."""
        words = re.split(r"(<=|>=|!=|<|>)", text)
        if len(words) < 3:
            raise Unreadable(f"no inequality: {text[:60]!r}")
        sides = [self.pull(self.f.read(side, self.names)) for side in words[::2]]
        ops = [self.f.ops[b] for b in self.f.reach(*sides)]
        odd = any(op[0] == "s" and (op[1] == "1j" or "complex" in self.words.get(op[1], ())) for op in ops)
        if odd and any(sign != "!=" for sign in words[1::2]) and all(op[:2] != ("f", "abs") for op in ops):
            raise Unreadable(f"complex values are compared: {text[:60]!r}")
        for left, sign, right in zip(sides, words[1::2], sides[1:], strict=False):
            a, b = (right, left) if "<" in sign else (left, right)
            difference = self.f.sub(a, b)
            if sign in ("<=", ">="):
                bound = at_least_zero(self.f, difference, self.fixed)
                moving = {*self.q, *self.p, *self.Q, *self.P, self.time, *stated.own_names(self.claim)} - self.fixed
                thin = not self.surface and is_thin(self.f, difference, moving, str(self.claim["kind"]))
                if bound == difference and self.verdict == "proved" and not thin:
                    self.trusted.append(f"what holds where both sides of {text[:60]} are equal")
                difference = bound
            yield difference, "nonzero" if sign == "!=" else "positive"

    # -- the map ------------------------------------------------------------------------------------

    def _chart(self, explicit: Any, generating: Any) -> None:
        """Coordinates in which old and new variables are explicit: old ones, new ones, or mixed ones."""
        f, node = self.f, lambda name: self.f.node("s", name)
        self.direction, self.images = "none" if not (explicit or generating) else "forward", dict[str, int]()
        self.halves = (self.q, self.p)
        self.generating = generating and (generating["type"], f.read(generating["F"], self.names))
        if explicit:
            self.direction = "forward" if "Q" in explicit else "backward"
            sides = ((self.Q, "Q"), (self.P, "P")) if "Q" in explicit else ((self.q, "q"), (self.p, "p"))
            self.halves = (self.q, self.p) if "Q" in explicit else (self.Q, self.P)
            for names, side in sides:
                self.images |= {n: f.read(text, self.names) for n, text in zip(names, explicit[side], strict=True)}
        elif generating:
            self.direction = "implicit"
            self.written.append(self.generating[1])  # what F demands, its slopes may not
            equations = list(self.equations(*self.generating))
            mixed = [variable for _, variable, _ in equations]
            self.halves = (mixed[0::2], mixed[1::2])
            self.images = {name: slope for name, _, slope in equations}
        self.coordinates = [*self.halves[0], *self.halves[1]]
        self.old = [self.pull(node(name)) for name in (*self.q, *self.p)]
        self.new = [self.pull(node(name)) for name in (*self.Q, *self.P)]

    def equations(self, types: Any, F: int) -> Iterator[tuple[str, str, int]]:
        """Each equation of a generating function: the variable that it gives, the one of F's, the derivative of F."""
        sides = {"q": self.q, "p": self.p, "Q": self.Q, "P": self.P}
        if not isinstance(types, int) and len(types) != len(self.q):
            raise Unreadable(f"{len(types)} types for {len(self.q)} degrees of freedom")
        for i in range(len(self.q)):
            old, sign, new, other = TYPES[types if isinstance(types, int) else types[i]]
            for side, s in ((old, sign), (new, other)):
                name, other_side = sides[side][i], {"q": "p", "p": "q", "Q": "P", "P": "Q"}[side]
                yield sides[other_side][i], name, self.f.mul(self.f.number(s), self.f.slope(F, name))

    def pull(self, a: int) -> int:
        """A function of old and new variables as one of the coordinates."""
        return self.f.substitute(a, self.images)

    def brackets(self, scale: int | None) -> tuple[list[int], int]:
        """What vanishes where the map is canonical with a scale (None: that of its first pair), and the scale."""
        f, one = self.f, self.f.number(1)
        if self.direction == "implicit":
            new, old, scale = self.lagrange(self.new), self.lagrange(self.old), scale or one
            return [f.sub(new[ij], f.mul(scale, old[ij])) for ij in new], scale
        X = self.new if self.direction == "forward" else self.old
        pairs, half = list(zip(*self.halves, strict=True)), len(X) // 2
        if scale is None:
            first = f.bracket(X[0], X[half], pairs)
            scale = first if self.direction == "forward" else f.over(one, first)
        unit = scale if self.direction == "forward" else f.over(one, scale)
        found = []
        for i, j in combinations(range(len(X)), 2):
            found.append(f.sub(f.bracket(X[i], X[j], pairs), unit if j == i + half else f.number(0)))
        return found, scale

    def lagrange(self, X: Sequence[int], extra: Sequence[str] = ()) -> dict[tuple[int, int], int]:
        """Lagrange's brackets of the coordinates: Σ ∂q/∂a ∂p/∂b − ∂p/∂a ∂q/∂b."""
        f, half, names = self.f, len(X) // 2, [*self.coordinates, *extra]
        d = [[f.slope(x, name) for name in names] for x in X]
        return {(a, b): f.add(*(f.sub(f.mul(d[i][a], d[i + half][b]), f.mul(d[i + half][a], d[i][b]))
                                for i in range(half))) for a, b in combinations(range(len(names)), 2)}  # fmt: skip

    def pfaffian(self, matrix: Mapping[tuple[int, int], int], rows: Sequence[int]) -> int:
        """The Pfaffian of an antisymmetric matrix."""
        f, first, terms = self.f, rows[:1], []
        if len(rows) > LARGEST:
            raise Unknown(f"a Pfaffian of {len(rows)} rows")
        for k, j in enumerate(rows[1:]):
            rest = self.pfaffian(matrix, [i for i in rows[1:] if i != j])
            terms.append(f.mul(f.number((-1) ** k), matrix[first[0], j], rest))
        return f.add(*terms) if rows else f.number(1)

    def determinant(self, rows: Sequence[Sequence[int]]) -> int:
        """A determinant, by its first row."""
        f = self.f
        if len(rows) > LARGEST // 2:
            raise Unknown(f"a determinant of {len(rows)} rows")
        minors = (self.determinant([r[:k] + r[k + 1 :] for r in map(list, rows[1:])]) for k in range(len(rows)))
        return (
            f.add(*(f.mul(f.number((-1) ** k), rows[0][k], m) for k, m in enumerate(minors))) if rows else f.number(1)
        )
