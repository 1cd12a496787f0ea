"""Refutations of angles without a point, beside `counterexample.py`: by cycles that are seen without solving anything.

The old variables must come back when an angle has grown by its period, and not before. Of a map given backward: they
come back after a half, a third, … of the period, whatever the point is. Of one given forward, or by a generating
function of old coordinates and new momenta: a coordinate θ of which H is free stands in one angle alone, as ±θ. So that
angle alone grows along θ, and they are back after 2π, no sooner, whatever the claim's period is. All of it is seen by
`alone.py`'s random points, and in intervals that there is a point at which everything has a value.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from random import Random
from typing import Any

if __package__:
    from canon.checker import alone
    from canon.checker.alone import Stop
    from canon.checker.counterexample import Arithmetic, Open, check, check_domain, fails, somewhere
    from canon.checker.counterexample_functions import More, Place
    from canon.checker.counterexample_maps import plain
else:  # as a program's part, beside the other files
    import alone  # type: ignore
    from alone import Stop  # type: ignore
    from counterexample import Arithmetic, Open, check, check_domain, fails, somewhere  # type: ignore
    from counterexample_functions import More, Place  # type: ignore
    from counterexample_maps import plain  # type: ignore

BITS, PLACES, PARTS = 128, 200, (2, 3, 4, 5)


class Turning(alone.Point):
    """A random point; quarters of a turn are known."""

    def circle(self, terms: Any) -> tuple[int, int]:
        quarters = 2 * terms.get(pi := self.text("pi"), Fraction(0))
        if quarters.denominator > 1:
            return super().circle(terms)
        c, s = super().circle({v: r for v, r in terms.items() if v != pi})
        return ((c, s), (-s, c), (-c, -s), (s, -c))[int(quarters) % 4]


def sample(claim: Any, texts: list[str], prime: int) -> int:
    """See that formulas are 0 at one point."""
    point = Turning(claim, prime)
    if any(point.text(text) for text in texts):
        raise Stop("not shown", "that old variables come back")
    return len(point.roots)


def vanish(claim: Any, texts: list[str]) -> bool:
    """Whether formulas are 0 wherever they have values."""
    try:
        return alone.tried(sample, claim, texts)[0] == "shown"
    except Stop as stop:
        if stop.args[0] == "wrong":
            raise
        return False


def asked_of(tables: Any) -> Any:
    """The names of the file, the new variables among them, and the claim's period; no name has a map's text."""
    sections = {key: x for key, x in tables.items() if key not in ("transformation", "generating_function", "domain")}
    asked = More(plain(sections))
    asked.texts["_period"] = str(tables["claim"].get("angle_period", "1"))
    return asked


def comes_back_sooner(tables: Any) -> bool:
    """Whether the old variables are the same when an angle has grown by a part of its period."""
    space, explicit = tables["phase_space"], tables["transformation"]
    asked = asked_of(tables)
    if {*words(asked, "_period")} & {*asked.names}:
        raise Stop("not shown", "a period that moves")
    lists = [text for side in "qp" for text in explicit[side]]
    for w in space["Q"]:
        for n in PARTS:
            texts = list[str]()
            for k, text in enumerate(lists):
                asked.texts[f"_now{k}"] = text
                later = re.sub(rf"(?<![\w.]){re.escape(w)}(?!\w)", f"({w} + _period/{n})", unfolded(tables, text))
                texts.append(f"({later}) - _now{k}")
            if vanish(asked, texts):
                return True
    return False


def unfolded(tables: Any, text: str) -> str:
    """A text with what its definitions say in their place."""
    for _ in range(20):
        defined = {name: x for name, x in tables.get("definitions", {}).items() if re.search(rf"\b{name}\b", text)}
        if not defined:
            return text
        for name, x in defined.items():
            text = re.sub(rf"(?<![\w.]){re.escape(name)}(?!\w)", f"({x})", text)
        if len(text) > alone.LONGEST:
            break
    raise Stop("not shown", "formulas that are so long")


def words(asked: Any, name: str) -> Iterator[str]:
    """The names of which a text is made."""
    left = [asked.known(asked.texts[name])]
    while left:
        f = left.pop()
        if f.kind == ".":
            yield f.of[0]
            left += [asked.known(asked.texts[f.of[0]])] if f.of[0] in asked.texts else []
        left += [x for x in f.of if isinstance(x, alone.Formula)]


def turns_alone(tables: Any, theta: str) -> bool:
    """Whether along a coordinate one angle alone grows, as fast as this or as fast backwards."""
    space, explicit, generating = (
        tables.get(key, {}) for key in ("phase_space", "transformation", "generating_function")
    )
    asked, angles = asked_of(tables), [*space["Q"]]
    asked.variables = asked.names
    if explicit:
        slopes = [f"D(_x{k}, {theta})" for k in range(2 * len(angles))]
        asked.texts |= {f"_x{k}": text for k, text in enumerate([*explicit["Q"], *explicit["P"]])}
        zeros = [*slopes, f"D(_H, {theta})"]
        asked.texts["_H"] = tables["hamiltonian"]["H"]
        for k in range(len(angles)):
            rest = [text for j, text in enumerate(zeros) if j != k]
            for sign in ("-", "+"):
                if vanish(asked, [f"{slopes[k]} {sign} 1"]) and vanish(asked, rest):
                    return True
        return False
    types = generating["type"]
    if types != 2 and types != [2] * len(angles):
        raise Stop("not shown", "a generating function of that type")
    asked.texts |= {"_F": generating["F"], "_H": tables["hamiltonian"]["H"]}
    return any(
        vanish(asked, [f"D(_F, {theta}) {sign} {momentum}"]) and vanish(asked, [f"D(_H, {theta})"])
        for momentum in space["P"]
        for sign in "-+"
    )


def is_somewhere(tables: Any) -> bool:
    """Whether the domain has a point at which the map and H have values."""
    space, explicit, generating = (
        tables.get(key, {}) for key in ("phase_space", "transformation", "generating_function")
    )
    asked, rng = asked_of(tables), Random(0)
    asked.domain = tables.get("domain", {})
    asked.texts |= {x: text for side in explicit for x, text in zip(space[side], explicit[side], strict=True)}
    if generating:
        for coordinate, momentum, new, action in zip(*(space[side] for side in "qpQP"), strict=True):
            asked.texts |= {momentum: f"D(_F, {coordinate})", new: f"D(_F, {action})"}
        asked.texts["_F"] = generating["F"]
        asked.variables = [*space["q"], *space["P"], asked.names[-1]]
    asked.known.cache_clear()
    for _ in range(PLACES):
        of = dict[str, Any]()
        for name, x in somewhere(asked, {}, 0).items():
            size = Fraction(rng.randint(1, 40), rng.randint(1, 40))
            said = {*asked.words.get(name, ())}
            sign = -1 if "negative" in said or (not said - {"real", "nonzero"} and rng.random() < 0.5) else 1
            of[name] = (sign * size,) * 2 if isinstance(x, tuple) and "integer" not in said else x
        point = Place(asked, {n: x for n, x in of.items() if n not in asked.texts}, Arithmetic(BITS))
        try:
            check_domain(point, {"hamiltonian": tables.get("hamiltonian", {}), "transformation": explicit})
            for name in (*space["q"], *space["p"], *space["Q"], *space["P"]):
                check(point.named(name), asked.words.get(name, ()))
            check(point.text("_period"), ["nonzero"])
            return True
        except Open:
            continue
    return False


def refuted(tables: Any, witness: Any, known: Any = None) -> tuple[str, str]:
    """Whether an angle has another period."""
    claim, space, explicit = tables["claim"], tables["phase_space"], tables.get("transformation", {})
    if claim["kind"] != "action_angle" or {*claim} - {"kind", "angle_period"} or "hamiltonian" not in tables:
        raise Stop("not shown", "a refutation of such a claim")
    if [len(space.get(side, ())) for side in "qpQP"] != [len(space["q"])] * 4 or {*tables.get("domain", {})} - {
        "where"
    }:
        raise Stop("not shown", "a map of that form")
    asked = asked_of(tables)
    lists = [text for side in explicit.values() for text in side]
    asked.texts |= {
        f"_m{k}": text for k, text in enumerate([*lists, tables.get("generating_function", {}).get("F", "0")])
    }
    if any(asked.names[-1] in {*words(asked, name)} for name in asked.texts if name == "_H" or name.startswith("_m")):
        raise Stop("not shown", "a map, or a Hamiltonian, that depends on time")
    if {*explicit} == {"q", "p"}:
        if "generating_function" not in tables and comes_back_sooner(tables) and is_somewhere(tables):
            return "shown", ""
        return "not shown", "that old variables come back"
    if bool(explicit) == ("generating_function" in tables) or {*explicit} - {"Q", "P"}:
        raise Stop("not shown", "a map of that form")
    if {*words(asked, "_period")} - {"pi"}:
        raise Stop("not shown", "a period that isn't a number")
    point = Place(asked, {}, Arithmetic(BITS))
    if not all(fails(point.text(text), "") for text in ("_period - 2*pi", "_period + 2*pi")):
        return "not shown", "a period of 2 pi"
    conditions = unfolded(tables, " ".join(tables.get("domain", {}).get("where", [])))
    for theta in space["q"]:
        if not asked.words.get(theta) and not re.search(rf"(?<!\w){re.escape(theta)}(?!\w)", conditions):
            if turns_alone(tables, theta) and is_somewhere(tables):
                return "shown", ""
    return "not shown", "a coordinate along which one angle grows"
