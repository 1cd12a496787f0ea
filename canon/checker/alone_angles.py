"""Actions and angles of a map given backward: `python alone_angles.py CERTIFICATE.json …`

The map is canonical, and H at it has no slope by an angle (`alone_maps.py`). For each angle w, with the others held,
the old variables come back after the period T, but for coordinates that advance by 2π, in which H has this period; all
of the formulas are smooth at all angles, by signs. No part of T brings them back: a coordinate advances by 2π once, or
a variable is g cos(2π w/T + b), or with a sine, g being 0 nowhere: between two of its changes from − to + lies T.
"""

from __future__ import annotations

import json
from contextlib import suppress
from typing import Any

if __package__:
    from canon.checker import alone, alone_maps, alone_special, alone_values
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_maps  # type: ignore
    import alone_special  # type: ignore
    import alone_values  # type: ignore

Stop, above = alone.Stop, alone_special.is_above_everywhere
ZEROS = [*alone_maps.BACKWARD, "D(H, Q_i)"]
TRIED, ENOUGH = 200, 6
FINE = ("#", ".", "+", "*", "sin", "cos", "exp", "asinh", "atan", "D")


class Angles:
    """A claim, with what is asked of the cycles of its angles."""

    def __init__(self, tables: Any) -> None:
        claim, space = tables["claim"], tables["phase_space"]
        said = {key: x for key, x in claim.items() if key not in alone.UNASKED}
        if {*said} - {"angle_period"} or {*tables.get("transformation", {})} != {*"qp"}:
            raise Stop("not shown", "angles of a map that isn't given backward")
        if "on" in tables.get("domain", {}):
            raise Stop("not shown", "angles on a surface")
        form = {"map": "backward", "absent": {"scale": "1"}, "of": {"period": ""}, "zeros": ZEROS}
        period = {"period": str(said.get("angle_period", "1"))}
        self.claim = alone_maps.Map({**tables, "claim": {"kind": "action_angle", **period}}, form)
        self.old, self.angles = [*space["q"], *space["p"]], space["Q"]
        self.coordinates, self.time = {*space["q"]}, space.get("time", "t")
        self.period = self.claim.known("__period")
        self.check_bounds()
        self.points = list[Any]()
        for _ in range(TRIED):
            point = alone_values.Values(self.claim, alone_values.random_prime())
            with suppress(alone.Elsewhere):
                point.evaluate()
                self.points.append(point)
            if len(self.points) == ENOUGH:
                break
        else:
            raise Stop("not shown", "points at which everything is positive that has to be")

    def names(self, f: Any) -> set[str]:
        """The names in a formula, at the map."""
        return {g.of[0] for g in alone_maps.parts(self.claim, f) if g.kind == "."}

    def check_bounds(self) -> None:
        """See that nothing in the file bounds an angle, nor what moves with it, and that time is nowhere."""
        claim = self.claim
        bounded = [name for name in (*self.old, *self.angles) if {*claim.words.get(name, ())} - {"real"}]
        sides = [claim.known(side) for text in claim.domain.get("where", []) for side in alone_maps.sides(text)]
        if bounded or any(self.names(f) & {*self.angles} for f in sides):
            raise Stop("not shown", "that a cycle isn't cut by what is assumed of its variables")
        written = [claim.known(name) for name in (*self.old, "__H")]
        if any(self.time in self.names(f) for f in (*written, self.period)):
            raise Stop("not shown", "angles of what moves with time")
        if any(g.kind == "." and g.of[0] in claim.names for g in alone_maps.parts(claim, self.period)):
            raise Stop("not shown", "a period with variables")
        if not above(claim, self.period):
            raise Stop("not shown", "a period that is positive")
        for f in written:
            self.check_smooth(f)

    def is_above(self, f: Any) -> bool:
        """Whether a formula is positive at all angles."""
        inner = self.resolved(f.of[0]) if f.kind == "cos" else f
        return (f.kind == "cos" and inner.kind in ("asin", "atan")) or above(self.claim, f)

    def resolved(self, f: Any) -> Any:
        """A formula in the place of a name that stands for it."""
        while f.kind == "." and f.of[0] in self.claim.texts:
            f = self.claim.known(self.claim.texts[f.of[0]])
        return f

    def check_smooth(self, f: Any) -> None:
        """See that a formula is smooth at all angles."""
        claim = self.claim
        for g in alone_maps.parts(claim, f):
            if g.kind in FINE or not self.names(g) & {*self.angles}:
                continue
            r = g.of[1].of[0] if g.kind == "^" and g.of[1].kind == "#" else None
            inside = g.of[0]
            if r is not None and r.denominator == 1:
                right = r > 0 or self.is_above(inside) or self.is_above(claim.made("*", alone.number(-1), inside))
            elif r is not None or g.kind == "log":
                right = self.is_above(inside)
            else:
                right = g.kind in ("asin", "acos", "atanh") and self.is_above(claim.read("1 - a**2", {"a": inside}))
            if not right:
                raise Stop("not shown", f"that {g.kind[:40]} is smooth at all angles")

    def zeros_of_cycle(self, angle: str) -> list[str]:
        """What vanishes where the cycle of an angle closes after its period, and not before."""
        found, once, point = list[str](), False, self.points[0]
        for name in self.old:
            change = f"_with({name}, {angle}, {angle} + __period) - {name}"
            advance = point.text(change)
            turns = {0: "0", point.text("2*pi"): "2*pi", point.text("-2*pi"): "-2*pi"}.get(advance)
            if turns is None or (turns != "0" and name not in self.coordinates):
                raise Stop("not shown", f"that {name[:40]} comes back")
            found.append(f"{change} - ({turns})")
            if turns != "0":
                found.append(f"_with(__H, {name}, {name} + 2*pi) - __H")
            once = once or turns != "0" or self.swings(name, angle)
        if not once:
            raise Stop("not shown", f"that the cycle of {angle[:40]} is gone round once")
        return found

    def swings(self, name: str, angle: str) -> bool:
        """Whether a variable is g cos(2π w/T + b), or with a sine, g being 0 nowhere."""
        claim, factors, waves = self.claim, [self.claim.known(self.claim.texts[name])], 0
        while factors:
            f = self.resolved(factors.pop())
            if f.kind == "*":
                factors += f.of
            elif f.kind in ("sin", "cos") and angle in self.names(f.of[0]):
                rate, turn = claim.read(f"D(a, {angle})*__period", {"a": f.of[0]}), claim.read("2*pi")
                if not any(all(x.at(rate) == k * x.at(turn) % x.p for x in self.points) for k in (1, -1)):
                    return False
                waves += 1
            elif self.names(f) & {*self.angles}:
                power = f.kind == "^" and f.of[1].kind == "#" and f.of[1].of[0] < 0
                if not power and not self.is_above(f):
                    return False
        return waves == 1


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim itself."""
    asked = Angles(json.loads(json.dumps(data["tables"])))
    cycles = [text for angle in asked.angles for text in asked.zeros_of_cycle(angle)]
    asked.claim.zeros = [*asked.claim.zeros, *cycles]
    return alone_values.shown(asked.claim)


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
