"""Several angles, by the cycles of a torus: `python alone_tori.py CERTIFICATE.json …`

H is made of degrees of freedom inside one another, H₁(q₁, p₁), H₂(q₂, p₂, H₁), … H, beside coordinates that don't occur
in it, and are angles of 2π. So all levels are constant on a product of curves, one in each plane (qₖ, pₖ), and circles.
`alone_actions.py` shows that Iₖ is the action of each closed curve, in levels and parameters; that the curve through a
point of the domain is closed is seen from ∂²H/∂p² > 0 and from p² < 0 near both ends of the range. For a cyclic
coordinate Iₖ is 2π p. The flow of each Iₖ closes after the time 1 and not before, and there are no other cycles.

The map is canonical, and T Pⱼ = Σ Nⱼₖ Iₖ with whole numbers Nⱼₖ without a common divisor (identities at random points).
Then the flow of Pⱼ, along which Qⱼ alone grows, evenly, closes after T and not before; and Pⱼ being n independent
functions of the levels, each level is one of P. Arnold (1989), sections 49 and 50.

The certificate says how H is taken apart, Iₖ and Nⱼₖ, and of a map by a generating function F(q, P) the levels as
functions of P; nothing of it is trusted. What is used of levels' and momenta's signs is shown in the domain
(`alone_signs.py`).
"""

from __future__ import annotations

import json
import math
import re
from contextlib import suppress
from itertools import chain
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

Stop, SIGN, NAME, asked = alone.Stop, alone_texts.SIGN, alone_texts.NAME, alone_texts.asked
SECTIONS = {"phase_space", "symbols", "definitions", "domain", "hamiltonian", "claim", "title", "source"}
LEVEL, RANGED = re.compile(r"level_\d+"), {"positive"}
SMOOTH, COMPLETE = ("#", ".", "+", "*", "sin", "cos", "exp", "atan"), ("elliptic_k", "elliptic_e")
GIVEN = {True: {"coordinate", "action"}, False: {"coordinate", "action", "H", "level"}}


class Torus(alone_texts.Texts):
    """A claim, and the cycles that a certificate names: texts."""

    def __init__(self, tables: Any, torus: Any) -> None:
        space, claim = tables["phase_space"], tables["claim"]
        said = {key: x for key, x in claim.items() if key not in alone.UNASKED}
        self.forward = "transformation" in tables
        given = tables["transformation" if self.forward else "generating_function"]
        n = len(space["q"])
        if {*said} - {"angle_period"} or [len(space.get(side, [])) for side in "qpQP"] != [n] * 4:
            raise Stop("not shown", "no angles of as many degrees of freedom")
        if {*tables} - SECTIONS != {"transformation" if self.forward else "generating_function"}:
            raise Stop("not shown", "angles of a map with other sections")
        if {*given} != ({*"QP"} if self.forward else {"type", "F"}) or {*tables["hamiltonian"]} != {"H"}:
            raise Stop("not shown", "angles of a map that isn't given forward, or by a generating function")
        if {*tables.get("domain", {})} - {"where"} or {*space} - {*"qpQP", "time"}:
            raise Stop("not shown", "angles on a surface")
        if not self.forward and given["type"] not in (2, [2] * n):
            raise Stop("not shown", "a generating function of another type")
        super().__init__(tables)
        self.q, self.p, self.Q, self.P = (space[side] for side in "qpQP")
        self.pairs, self.given = dict(zip(self.q, self.p, strict=True)), given
        self.period = str(said.get("angle_period", "1"))
        self.parameters = {*self.symbols} - {*self.q, *self.p, *self.new}
        self.check_names([*self.q, *self.p], self.Q, LEVEL.fullmatch)
        self.check_map()
        self.take(torus)

    def check_map(self) -> None:
        """See that the map and H are of their own variables, and free of time."""
        own = {*self.q, *self.p, *self.parameters, "pi"}
        made = [*self.given["Q"], *self.given["P"]] if self.forward else [self.given["F"]]
        mixed = {*self.q, *self.P, *self.parameters, "pi"}
        if self.free(self.H) - own or any(self.free(x) - (own if self.forward else mixed) for x in made):
            raise Stop("not shown", "a map, or H, of other variables or time")
        if self.free(self.period) - {*self.parameters, "pi"}:
            raise Stop("not shown", "a period with variables")

    def free(self, text: str) -> set[str]:
        """The names in a text that aren't defined by others."""
        return self.names(text) - {*self.definitions}

    def take(self, torus: Any) -> None:
        """The cycles that are named, and how H is taken apart: each level of what was named before it."""
        self.cycles, self.turns, n = torus["cycles"], torus["turns"], len(self.q)
        if sorted(cycle["coordinate"] for cycle in self.cycles) != sorted(self.q):
            raise Stop("not shown", "a cycle for each coordinate")
        if [*map(len, self.turns)] != [n] * n or any(type(k) is not int for k in chain(*self.turns)):
            raise Stop("not shown", "whole numbers of turns")
        if any(math.gcd(*row) != 1 for row in self.turns):
            raise Stop("not shown", "cycles that are gone round once")
        self.levels, self.values = dict[str, str](), dict[str, str]()
        self.cyclic = {self.pairs[cycle["coordinate"]] for cycle in self.cycles if "H" not in cycle}
        for cycle in self.cycles:
            q, still = cycle["coordinate"], "H" not in cycle
            p, known = self.pairs[q], {*self.parameters, *self.cyclic, *self.levels, "pi"}
            name = p if still else cycle["level"]
            if {*cycle} != GIVEN[still] | (set() if self.forward else {"value"}):
                raise Stop("not shown", "a cycle with other keys")
            if not still:
                if not LEVEL.fullmatch(name) or name in self.levels or self.plain(cycle["H"]) - known - {q, p}:
                    raise Stop("not shown", "a level of other names")
                self.levels[name], known = cycle["H"], known | {name}
            elif self.words(q) or any(q in self.compared(text) for text in self.where):
                raise Stop("not shown", "a circle that is cut")
            if (
                self.words(q) - RANGED
                or (self.words(p) and not (still and self.forward))
                or self.plain(cycle["action"]) - known
            ):
                raise Stop("not shown", "a cycle with other words, or an action of other names")
            if not self.forward:
                self.values[name] = cycle["value"]
                if self.plain(cycle["value"]) - {*self.parameters, *self.P, "pi"}:
                    raise Stop("not shown", "a level that isn't one of the new momenta")
        if not self.levels:
            raise Stop("not shown", "a Hamiltonian with coordinates in it")

    def plain(self, text: str) -> set[str]:
        """The names in a text that the certificate adds, which uses no definitions."""
        if not isinstance(text, str) or self.names(text) & {*self.definitions}:
            raise Stop("not shown", "texts with definitions in them")
        return self.names(text)

    def compared(self, text: str) -> set[str]:
        """The names in a condition."""
        return {name for side in SIGN.split(text)[::2] for name in self.free(side)}

    def put(self, text: str, by: Any) -> str:
        """The same text with others in the place of names."""
        return NAME.sub(lambda m: f"({by[m[0]]})" if m[0] in by else m[0], text)

    def of(self, claim: Any, made: Any = None, where: Any = ()) -> Any:
        """Tables of a claim of old variables and of new momenta, as parameters."""
        symbols = {x: w for x, w in self.symbols.items() if x not in self.new or (x in self.P and not self.forward)}
        if not self.forward:
            symbols = {**dict.fromkeys(self.P, "real"), **symbols}
        return {"phase_space": {"q": self.q, "p": self.p, "time": self.time}, "symbols": symbols,
                "definitions": {**self.definitions, **(made or {})}, "domain": {"where": [*where]},
                "hamiltonian": {"H": self.H}, "claim": claim}  # fmt: skip

    def kept(self) -> list[str]:
        """The domain's conditions on what is free in the map's formulas, and parameters."""
        free = {*self.parameters, *self.q, *(self.p if self.forward else self.P), "pi"}
        found = [text for text in self.where if not self.compared(text) - free]
        return sorted(found, key=lambda text: len(self.compared(text)))  # bounds of angles first

    def bounds(self, q: str) -> list[str]:
        """The domain's conditions on a coordinate alone, and parameters."""
        return [text for text in self.where if {q} <= self.compared(text) <= {*self.parameters, "pi", q}]

    def check_whole(self) -> None:
        """See that H, as it is written, has a value and is smooth in all of the coordinates' ranges."""
        where = [text for q in self.q for text in self.bounds(q)]
        claim = alone.Claim(self.of({"kind": "identity", "lhs": self.H, "rhs": self.H}, None, where))
        for f in alone_maps.parts(claim, claim.known(self.H)):
            r = f.of[1].of[0] if f.kind == "^" and f.of[1].kind == "#" else None
            if f.kind in SMOOTH or (r is not None and r.denominator == 1 and r > 0):
                continue
            signed = [f.of[0]] if r is not None or f.kind == "log" else []
            signed += [claim.made("*", alone.number(-1), f.of[0])] if r is not None and r.denominator == 1 else []
            if not any(alone_special.is_above_everywhere(claim, x) for x in signed):
                raise Stop("not shown", f"that H is smooth, for {f.kind[:40]} in it")

    def check_values(self) -> None:
        """See that what the certificate says has values at all points of the domain, but for poles.

        Identities hold where both sides have values: of √L √L − L they say nothing where L < 0.
        """
        texts = [*self.values.values(), *(self.put(cycle["action"], self.values) for cycle in self.cycles)]
        texts += [self.put(text, self.values) for text in self.levels.values()]
        made = self.levels if self.forward else None
        claim = alone_special.Small(self.of({"kind": "identity", "lhs": self.H, "rhs": self.H}, made, self.kept()))
        for f in dict.fromkeys(chain(*(alone_maps.parts(claim, claim.known(text)) for text in texts))):
            r = f.of[1].of[0] if f.kind == "^" and f.of[1].kind == "#" else None
            if f.kind in SMOOTH or (r is not None and r.denominator == 1):
                continue
            less_than_1 = claim.made("+", alone.number(1), claim.made("*", alone.number(-1), f.of[0]))
            signed = f.of[0] if r is not None else less_than_1 if f.kind in COMPLETE else None
            if signed is None or not alone_special.is_above_everywhere(claim, signed):
                raise Stop("not shown", f"that a level or an action has a value, for {f.kind[:40]} in it")

    def is_same(self, f: str, g: str, made: Any, where: Any) -> bool:
        tables = self.of({"kind": "identity", "lhs": f, "rhs": g}, made, where)
        return any(asked(file, tables) for file in (alone_maps, alone_related))

    def is_above(self, f: str, g: str) -> bool:
        """Whether one formula is larger than another one at all points of the domain."""
        claim = {"kind": "inequality", "lhs": f, "relation": ">", "rhs": g}
        return asked(alone_signs, self.of(claim, self.levels if self.forward else None, self.kept()))

    def signs(self) -> list[str]:
        """The signs of levels and cyclic momenta, as conditions, that they have throughout the domain."""
        found = []
        for name in (*self.levels, *self.cyclic):
            value = name if self.forward else self.values[name]
            found += [f"{name} > 0"] if self.is_above(value, "0") else []
            found += [f"{name} < 0"] if self.is_above("0", value) else []
        return found

    def motion(self, cycle: Any, facts: list[str]) -> Any:
        """Tables of the claim that a cycle has its action."""
        q, energy = cycle["coordinate"], cycle["level"]
        inside = {*self.names(cycle["H"]), *self.names(cycle["action"]), energy}
        words = {name: w for name, w in self.symbols.items() if name in {*self.parameters, q}}
        words |= dict.fromkeys(sorted({*self.levels, *self.cyclic} & inside), "real")
        facts = [fact for fact in facts if fact.split()[0] in inside]
        claim = {"kind": "action", "coordinate": q, "energy": energy, "equals": cycle["action"]}
        return {"phase_space": {"q": [q], "p": [self.pairs[q]], "time": self.time}, "symbols": words,
                "definitions": self.definitions, "domain": {"where": [*self.bounds(q), *facts]},
                "hamiltonian": {"H": cycle["H"]}, "claim": claim}  # fmt: skip

    def check_cycle(self, cycle: Any, facts: list[str]) -> None:
        """See that the curves of a degree of freedom are closed ones with this action."""
        tables = self.motion(cycle, facts)
        if not any(asked(file, tables) for file in (alone_actions, alone_elliptic)):
            raise Stop("not shown", f"the action of {cycle['coordinate'][:40]}")
        if not closes(tables):
            raise Stop("not shown", f"that the motion of {cycle['coordinate'][:40]} comes back")

    def check_levels(self) -> None:
        """See that the last level is H, and by a generating function the levels what they are said to be."""
        if not self.is_same([*self.levels][-1], self.H, self.levels, ()):
            raise Stop("not shown", "that H is taken apart so")
        if self.forward:
            return
        slope = {p: f"D({self.given['F']}, {q})" for q, p in self.pairs.items()}
        for name, value in self.values.items():
            found = slope[name] if name in self.cyclic else self.put(self.levels[name], {**slope, **self.values})
            if not self.is_same(found, value, None, self.kept()):
                raise Stop("not shown", f"the value of {name[:40]}")

    def check_actions(self) -> None:
        """See that T Pⱼ = Σ Nⱼₖ Iₖ."""
        actions = [self.put(cycle["action"], self.values) for cycle in self.cycles]
        for P, row in zip(self.given["P"] if self.forward else self.P, self.turns, strict=True):
            total = " + ".join(f"({k})*({action})" for k, action in zip(row, actions, strict=True) if k)
            made = self.levels if self.forward else None
            if not self.is_same(f"({self.period})*({P})", total, made, self.kept()):
                raise Stop("not shown", f"that T*({P[:40]}) is that sum of actions")

    def is_somewhere(self) -> bool:
        """Whether a point of the domain, at which the map's formulas have values, is found."""
        if len(self.kept()) < len(self.where):
            return False
        claim = alone.Claim(self.of({"kind": "identity", "lhs": self.H, "rhs": self.H}))
        made = dict(zip(self.P, self.given["P"], strict=True)) if self.forward else {}
        texts = [self.period, *([self.H, *self.given["Q"]] if self.forward else [self.given["F"]])]
        free = {*self.q, *self.parameters, *(self.p if self.forward else self.P)}
        return self.has_point(claim, free, made, texts)


def closes(tables: Any) -> bool:
    """Whether p² is negative near both ends of the coordinate's range, at all levels that are allowed."""
    motion = alone_orbits.Motion(tables)
    for chart in alone_charts.charts(motion):
        with suppress(Stop):
            level = alone_charts.Level(motion, chart)
            level.check()
            powers = of.by_powers(of.times(level.delta, level.below), alone_orbits.U)
            if not level.allowed and all(is_below(level, powers, side) for side in (1, -1)):
                return True
    return False


def is_below(level: Any, powers: Any, side: int) -> bool:
    """Whether a polynomial in u is negative near the lower end (1), or the upper one (-1)."""
    made, flat, end = level.motion.made, level.flat, level.chart.low if side > 0 else level.chart.high
    signs = alone_signs.Signs(level.motion)
    if end is None:  # by its leading term
        k = max(powers)
        found = [made("*", alone.number(side**k if side > 0 else 1), flat.written(powers[k]))]
        found = [made("*", alone.number(-1), found[0])] if side > 0 and k % 2 else found
    else:  # by the first of its derivatives there that isn't 0
        found = []
        for n in range(max(powers) + 1):
            total = alone.number(0)
            for k, c in powers.items():
                if k >= n:
                    term = made("*", alone.number(math.comb(k, n) * side**n), flat.written(c))
                    total = made("+", total, made("*", term, made("^", end, alone.number(k - n))) if k > n else term)
            if flat.reduced(flat.quotient(total))[0]:
                found = [total]
                break
    return bool(found) and signs.shown(of.minus(signs.quotient(found[0])[0]), True)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim itself; the certificate may have no identities besides."""
    tables = json.loads(json.dumps(data["tables"]))
    if tables["claim"]["kind"] != "action_angle" or "torus" not in data["known"] or len(data["cases"]) > 1:
        raise Stop("not shown", "no angles with the cycles of a torus")
    torus = Torus(tables, data["known"]["torus"])
    if not torus.is_above(torus.period, "0"):
        raise Stop("not shown", "a period that is positive")
    torus.check_whole()
    torus.check_values()
    torus.check_levels()
    facts = torus.signs()
    for cycle in torus.cycles:
        if "H" in cycle:
            torus.check_cycle(cycle, facts)
        elif not torus.is_same(cycle["action"], f"2*pi*{torus.pairs[cycle['coordinate']]}", None, ()):
            raise Stop("not shown", "the action of a circle")
    torus.check_actions()
    if not torus.is_somewhere():
        raise Stop("not shown", "a point of the domain")
    if not asked(alone_maps, {**tables, "claim": {"kind": "canonical"}}):
        raise Stop("not shown", "that the map is canonical")
    return "shown", ""


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown, several=True)


if __name__ == "__main__":
    alone.main(checked)
