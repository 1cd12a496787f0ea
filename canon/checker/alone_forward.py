"""The angle of a map given forward, in one degree of freedom: `python alone_forward.py CERTIFICATE.json …`

The map w(q, p), J(q, p) is canonical (`alone_maps.py`), and J = j(H) where j(E) is J at a fixed q and the momentum that
the energy E has there: an identity. That ∮ p dq = T j(E) is a claim of its own, for all E (`alone_actions.py`,
`alone_elliptic.py`), in which j has the same text. So the period of the orbit is T dj/dE, and w, whose rate is dE/dj,
advances by T. Conditions on the point bound no orbit: they are left out of it, but for those that are identities of E.

That the orbit through each point closes is seen from H(q, 0): on the line it grows to both sides beyond all bounds, as
a quotient of polynomials; on the circle, where H has the period 2π, it is above E somewhere (libration), or below it
everywhere (rotation). That there is a point in the domain at all is seen in intervals.
"""

from __future__ import annotations

import json
import re
from contextlib import suppress
from typing import Any

if __package__:
    from canon.checker import (
        alone,
        alone_actions,
        alone_charts,
        alone_elliptic,
        alone_maps,
        alone_orbits,
        alone_related,
        alone_signs,
        alone_special,
        alone_texts,
    )
    from canon.checker import alone_polynomials as of
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_actions  # type: ignore
    import alone_charts  # type: ignore
    import alone_elliptic  # type: ignore
    import alone_maps  # type: ignore
    import alone_orbits  # type: ignore
    import alone_polynomials as of  # type: ignore
    import alone_related  # type: ignore
    import alone_signs  # type: ignore
    import alone_special  # type: ignore
    import alone_texts  # type: ignore

Stop = alone.Stop
SECTIONS = {
    "phase_space", "symbols", "definitions", "domain", "hamiltonian", "transformation", "claim", "title", "source",
}  # fmt: skip
NAME, SIGN, asked = alone_texts.NAME, alone_texts.SIGN, alone_texts.asked
ENERGY, HERE, PLACE = "E_of_point", "_there", "0"
SMOOTH = ("#", ".", "+", "*", "sin", "cos", "exp", "atan", "atan2")
SQUARE = "p**2"  # what is put for the square of the momentum


class Forward(alone_texts.Texts):
    """The parts of a claim, as texts."""

    def __init__(self, tables: Any) -> None:
        space, claim = tables["phase_space"], tables["claim"]
        said = {key: x for key, x in claim.items() if key not in alone.UNASKED}
        sides = [space.get(side, []) for side in "qpQP"]
        if {*said} - {"kind", "angle_period"} or {*tables} - SECTIONS or [*map(len, sides)] != [1] * 4:
            raise Stop("not shown", "no angle of a map in one degree of freedom")
        if {*tables["transformation"]} != {*"QP"} or {*tables["hamiltonian"]} != {"H"}:
            raise Stop("not shown", "angles of a map that isn't given forward")
        if {*tables.get("domain", {})} - {"where"} or {*space} - {*"qpQP", "time"}:
            raise Stop("not shown", "angles on a surface")
        super().__init__(tables)
        self.q, self.p = (side[0] for side in sides[:2])
        (self.w,), (self.J,) = (tables["transformation"][side] for side in "QP")
        self.period = str(said.get("angle_period", "1"))
        self.check_texts()

    def check_texts(self) -> None:
        """See that nothing is in a place where it can't be."""
        self.check_names([self.q, self.p], (self.q, self.p), lambda name: name == ENERGY or name.endswith(HERE))
        own = {self.q, self.p}
        for text in (self.H, self.J, self.w):
            if self.names(text) & {self.time, *self.new} or not self.names(text) & own:
                raise Stop("not shown", "a map, or H, of other variables or time")
        if self.names(self.period) & {*own, *self.new, self.time}:
            raise Stop("not shown", "a period with variables")

    def put(self, text: str, by: Any, mark: str, made: dict[str, str]) -> str:
        """The same text with others for the coordinate and the momentum; definitions of it get the mark."""
        for name in sorted({*NAME.findall(text)} & {*self.definitions}):
            if self.names(self.definitions[name]) & {*by} and name + mark not in made:
                made[name + mark] = self.put(self.definitions[name], by, mark, made)
        other = lambda m: f"({by[m[0]]})" if m[0] in by else m[0] + mark if m[0] + mark in made else m[0]
        if SQUARE in by:
            text = re.sub(rf"(?<![\w.]){re.escape(self.p)}\s*\*\*\s*2(?![\w.])(?!\s*\*\*)", f"({by[SQUARE]})", text)
        return NAME.sub(other, text)

    def at_energy(self) -> None:
        """J and the domain's conditions at a fixed place and its momentum at the energy: j(E), of E alone."""
        made = dict[str, str]()
        low, high = (self.put(self.H, {self.q: PLACE, self.p: x}, f"{x}{HERE}", made) for x in "01")
        square = f"({ENERGY} - ({low}))/(({high}) - ({low}))"
        by = {self.q: PLACE, self.p: f"sqrt({square})", SQUARE: square}
        self.j = self.put(self.J, by, HERE, made)
        self.still = self.put(self.H, {self.p: "0"}, f"v{HERE}", made)
        self.made = {**self.definitions, **made}
        self.sides = {side.strip(): self.put(side.strip(), by, HERE, made) for side in self.all_sides()}
        self.made = {**self.definitions, **made}

    def all_sides(self) -> list[str]:
        """What is compared by conditions on old variables."""
        return [x for text in self.where for x in SIGN.split(text)[::2] if not self.names(text) & {*self.new}]

    def tables_of(self, claim: Any, where: Any) -> Any:
        """Tables of a claim of old variables and the energy."""
        symbols = {name: x for name, x in self.symbols.items() if name not in self.new}
        space = {"q": [self.q], "p": [self.p], "time": self.time}
        symbols |= {ENERGY: "real"} if claim["kind"] == "inequality" else {}
        return {"phase_space": space, "symbols": symbols, "definitions": self.made, "domain": {"where": where},
                "hamiltonian": {"H": self.H}, "claim": claim}  # fmt: skip

    def is_same(self, f: str, g: str) -> bool:
        """Whether a formula is another one of E, for E = H."""
        definitions = {**self.made, ENERGY: self.H}
        made = {**self.tables, "definitions": definitions, "claim": {"kind": "identity", "lhs": f, "rhs": g}}
        return any(asked(file, made) for file in (alone_maps, alone_related))

    def is_of_energy(self, f: str, g: str) -> bool:
        """Whether a formula is another one of E, which has a value where it has."""
        return self.is_same(f, g) and self.has_values(f, g)

    def has_values(self, f: str, g: str) -> bool:
        """Whether a text that was made of another one, for E = H, has a value wherever that one has, but for poles.

        What its roots and functions are of is the same, or has such a sign. An identity holds where both sides have
        values: where √B has none it says nothing.
        """
        where = [text for text in self.where if not self.names(text) & {*self.new}]
        tables = self.tables_of({"kind": "identity", "lhs": f, "rhs": g}, where)
        claim: Any = alone_special.Small({**tables, "definitions": {**self.made, ENERGY: self.H}})
        left, structure = [(claim.known(f), claim.known(g))], alone_orbits.Flat(claim).structure
        while left:
            a, b = (
                claim.known(claim.texts[x.of[0]]) if x.kind == "." and x.of[0] in claim.texts else x for x in left.pop()
            )
            if structure(a) == structure(b):
                continue
            if a.kind == b.kind and len(a.of) == len(b.of) and b.kind not in "#.":
                if is_partial(b) and not all(
                    self.is_same(*map(alone_texts.written, x)) for x in zip(a.of, b.of, strict=True)
                ):
                    return False
                left += zip(a.of, b.of, strict=True)
            elif any(is_partial(x) and not is_root_above(claim, x) for x in alone_maps.parts(claim, b)):
                return False
        return True

    def conditions(self) -> list[str]:
        """The domain's conditions that are conditions of E and parameters."""
        found, moving = [], {self.q, self.p}
        for text in self.where:
            words = SIGN.split(text)
            if self.names(text) & {*self.new}:
                continue
            for a, sign, b in zip(words[::2], words[1::2], words[2::2], strict=False):
                both = [x.strip() for x in (a, b)]
                if all(not self.names(x) & moving or self.is_of_energy(x, self.sides[x]) for x in both):
                    found.append(f"{self.sides[both[0]]} {sign} {self.sides[both[1]]}")
        return found

    def is_above(self, f: str, g: str, where: Any) -> bool:
        """Whether a formula of E is larger than another one for all values that conditions allow."""
        claim = {"kind": "inequality", "lhs": f, "relation": ">", "rhs": g}
        return asked(alone_signs, self.tables_of(claim, where))

    def closes(self, branch: str | None, where: Any, tables: Any) -> bool:
        """Whether the motion through each point of the domain is a closed orbit of the branch."""
        if branch is None:
            motion = alone_orbits.Motion(tables)
            flat, signs = alone_orbits.Flat(motion), alone_signs.Signs(motion)
            powers = [of.by_powers(x, self.q) for x in flat.reduced(flat.quotient(motion.read(self.still)))]
            up, down = map(max, powers)
            leads = [flat.written(x[k]) for x, k in zip(powers, (up, down), strict=True)]
            over = signs.quotient(motion.made("/", *leads))[0]
            return up > down and (up - down) % 2 == 0 and signs.shown(over, True)
        motion = alone_orbits.Motion(tables)
        circles = [chart for chart in alone_charts.mirrors(motion) if chart.kind == "circle"]
        if any(chart.flat.quotient(chart.rate) != (of.ONE, of.ONE) for chart in circles):
            return False  # the least period of H is a part of 2π
        turned = self.put(self.H, {self.q: f"{self.q} + 2*pi"}, f"t{HERE}", made := dict[str, str]())
        self.made = {**self.made, **made}
        if not self.is_same(self.H, turned):
            return False
        if branch == "rotation":
            return self.is_above(ENERGY, self.still, where)
        top = self.put(self.H, {self.q: "pi", self.p: "0"}, f"p{HERE}", made)
        self.made = {**self.made, **made}
        return self.is_above(top, ENERGY, where)

    def is_somewhere(self) -> bool:
        """Whether a point of the domain, at which the map has values, is found."""
        tables = {key: x for key, x in self.tables.items() if key != "claim"}
        claim = alone_maps.claim_of({"tables": {**tables, "claim": {"kind": "canonical"}}})
        free = {self.q, self.p, *self.symbols} - {*self.new}
        return self.has_point(
            claim, free, dict(zip(self.new_names(), (self.w, self.J), strict=True)), [self.H, self.period]
        )

    def new_names(self) -> list[str]:
        space = self.tables["phase_space"]
        return [*space["Q"], *space["P"]]


def is_partial(f: Any) -> bool:
    """Whether a formula may have no value where what it is made of has, in a region."""
    r = f.of[1].of[0] if f.kind == "^" and f.of[1].kind == "#" else None
    return f.kind not in SMOOTH and (r is None or r.denominator > 1)


def is_root_above(claim: Any, f: Any) -> bool:
    """Whether it is a root of what is positive."""
    return f.kind == "^" and f.of[1].kind == "#" and alone_special.is_above_everywhere(claim, f.of[0])


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim itself."""
    tables = json.loads(json.dumps(data["tables"]))
    if tables["claim"]["kind"] != "action_angle":
        raise Stop("not shown", "no angles")
    forward = Forward(tables)
    forward.at_energy()
    if not forward.is_above(forward.period, "0", []):
        raise Stop("not shown", "a period that is positive")
    if not forward.is_of_energy(forward.J, forward.j):
        raise Stop("not shown", "that J is a function of H")
    where = forward.conditions()
    for branch in (None, "libration", "rotation"):
        claim = {"kind": "action", "coordinate": forward.q, "energy": ENERGY}
        claim |= {"equals": f"({forward.period})*({forward.j})"} | ({"branch": branch} if branch else {})
        with suppress(Stop):
            if not forward.closes(branch, where, forward.tables_of(claim, [])):
                continue
        for kept in ([], where):  # without conditions it is a claim of more orbits
            if any(asked(file, forward.tables_of(claim, kept)) for file in (alone_elliptic, alone_actions)):
                if not forward.is_somewhere():
                    raise Stop("not shown", "a point of the domain")
                if not asked(alone_maps, {**tables, "claim": {"kind": "canonical"}}):
                    raise Stop("not shown", "that the map is canonical")
                return "shown", ""
    return "not shown", "that the orbit through each point has this action"


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
