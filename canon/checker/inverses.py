"""Inverse sines, cosines and tangents in a tower: which angle is meant.

- asin X and atan X lie between right angles, acos X between 0 and π, atan2(y, x) between −π and π; with a positive x
  between right angles. Where sine, or tangent, are the same there, the angles are.
- asin(sin A) is A − kπ for an even k, kπ − A for an odd one, if A is seen to lie within a right angle of kπ; likewise
  acos(cos A) and atan(tan A).
- Half of such an angle has a cosine that is nowhere negative, √((1 + c)/2), and the sine s/2 over that; of atan2 only
  where it is seen to stay off its cut, across which the half's sine jumps.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from canon.checker.core import Fraction
from canon.checker.tower import Element

if TYPE_CHECKING:
    from canon.checker.roots import Fraction_
    from canon.checker.values import Values

INVERSE = {"asin": "sin", "acos": "cos", "atan": "tan", "atan2": ""}
QUARTERS = {
    "asin": ((1, 1), (-1, -1)), "acos": ((0, 1), (1, 0), (-1, 2)), "atan": ((1, "1/2"), (-1, "-1/2")),
}  # fmt: skip
"""Values of inverse functions in right angles."""
TURNS = (0, 1, -1, 2, -2, 3, -3)
"""So many half turns an angle may be away from 0."""
Angle = tuple[Element, Element, Element]


class Inverses:
    """Of the angles in one tower; `right` is the right one."""

    def __init__(self, values: Values, right: Element) -> None:
        self.v, self.f, self.t, self.right = values, values.f, values.t, right
        self._sharp: list[tuple[Element, Element, Element | None]] = []  # an angle, and its sine, or y and x > 0

    def angle(self, name: str, op: tuple[Any, ...], x: Sequence[Element]) -> Element | None:
        """The value of an inverse function, known from others or a new one; None for any other function."""
        if name not in INVERSE:
            return None
        for sine, turns in QUARTERS.get(name, ()):
            if x[0] == self.t.constant(Fraction(sine)):
                return self.t.mul(self.right, self.t.constant(Fraction(turns)))
        if (found := self._unwound(name, op)) is not None:
            return found
        if name == "acos":
            return self.t.add(self.right, self.v.function(("f", "asin", (), op[3]), x), -1)
        mine = (x[0], self.t.constant(1) if name == "atan" else None if name == "asin" else x[1])
        if not self.v.real or (name == "atan2" and not self.v.roots.is_above(op[3][1])):
            return self.t.free()
        for known, *other in self._sharp:
            if self._are_one(mine, other) or self._are_one(other, mine):
                return known
        self._sharp.append((self.t.free(), *mine))
        return self._sharp[-1][0]

    def _are_one(self, a: Sequence[Element | None], b: Sequence[Element | None]) -> bool:
        """Whether a sine, or y and x, are those of other y and x."""
        (first, second), (y, x), t = a, b, self.t
        if first is None or y is None or x is None:
            return False
        if second is not None:
            return t.mul(first, x) == t.mul(y, second)
        size = self.v.roots.known_root(t.add(t.mul(x, x), t.mul(y, y)), 2, True)
        return size is not None and t.mul(first, size) == y

    def _unwound(self, name: str, op: tuple[Any, ...]) -> Element | None:
        """An inverse function of its own function."""
        f = self.f
        inner = f.ops[f.substitute(op[3][0], self.v.roots.meanings)]
        if not self.v.real or inner[:2] != ("f", INVERSE[name]):
            return None
        (angle,), pi = inner[3], f.node("s", "pi")
        for k in TURNS:
            rest = f.sub(angle, f.mul(f.number(k), pi))
            middle = f.mul(f.number("1/2"), pi) if name == "acos" else 0
            ends = [f.add(f.mul(f.number("1/2"), pi), f.mul(f.number(n), f.sub(rest, middle))) for n in (1, -1)]
            if all(self.v.roots.is_above(end, strict=False) for end in ends):
                if k % 2 and name == "acos":
                    rest = f.sub(pi, rest)
                elif k % 2 and name == "asin":
                    rest = f.mul(f.number(-1), rest)
                return self.v.value(rest)
        return None

    # -- their sines and cosines --------------------------------------------------------------------

    def angles(
        self, angle: Element, name: str, claimed: Fraction_ | None, node: int, known: Sequence[Angle]
    ) -> list[Angle]:
        """Inverse functions in an angle that aren't known, with sine and cosine; and the angle, if it is half of one.

        What a root is may be `claimed` of a function, by its name, of the angle.
        """
        found = [*known]
        for b in self.f.reach(node):
            op = self.f.ops[b]
            if op[0] != "f" or op[1] not in INVERSE or (op[1] == "atan2" and not self.v.real):
                continue
            whole = self.v.value(b)
            if all(a != whole for a, _, _ in found):
                found.append((whole, *self._circle(op, name, claimed if b == node else None)))
            if self.t.add(angle, angle) == whole and all(a != angle for a, _, _ in found) and self._is_off_cut(op):
                _, s, c = next(x for x in found if x[0] == whole)
                half = self.t.constant(Fraction(1, 2))
                square = self.t.mul(half, self.t.add(self.v.one, c))
                cosine = self.v.roots.root(square, 2, claimed if name == "cos" else None)
                found.append((angle, self.t.mul(self.t.mul(half, s), self.t.inverse(cosine)), cosine))
        return found[len(known) :]

    def _is_off_cut(self, op: tuple[Any, ...]) -> bool:
        above, number, mul = self.v.roots.is_above, self.f.number, self.f.mul
        if op[1] != "atan2":
            return self.v.real
        return above(op[3][1]) or any(above(mul(number(n), op[3][0])) for n in (1, -1))

    def _circle(self, op: tuple[Any, ...], name: str, claimed: Fraction_ | None) -> tuple[Element, Element]:
        """The sine and the cosine of an inverse function; the one that is a root may be the one that is claimed."""
        t, x, one, root = self.t, [self.v.value(b) for b in op[3]], self.v.one, self.v.roots.root
        if op[1] in ("asin", "acos"):
            rest = t.add(one, t.mul(x[0], x[0]), -1)
            given = {("asin", "cos"): claimed, ("acos", "sin"): claimed}.get((op[1], name))
            if (op[1], name) == ("acos", "tan"):
                given = self.v.times(claimed, op[3][0])
            other = root(rest, 2, given)
            return (x[0], other) if op[1] == "asin" else (other, x[0])
        if op[1] == "atan":
            cosine = t.inverse(root(t.add(one, t.mul(x[0], x[0])), 2, None))
            return t.mul(x[0], cosine), cosine
        size = t.inverse(root(t.add(t.mul(x[0], x[0]), t.mul(x[1], x[1])), 2, None))
        return t.mul(x[0], size), t.mul(x[1], size)
