"""Refutations of integrals, averages and extrema, beside `counterexample.py`: an enclosure that leaves out the
value.

At an end where the integrand is infinite as 1/√g is, g having a slope there, what is left out is at most 2 √(δ/|g'|)
times the rest of it.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from fractions import Fraction
from functools import cache
from typing import Any

if __package__:
    from canon.checker.alone import Formula, Stop, number
    from canon.checker.counterexample import NONE, Arithmetic, Interval, Open, check, check_domain, fails, somewhere
    from canon.checker.counterexample_formulas import UNIT, Writer, degree, inner_names, put, put_names
    from canon.checker.counterexample_functions import More, Place, integral, just, piece
else:  # as a program's part, beside the other files
    from alone import Formula, Stop, number  # type: ignore
    from counterexample import (  # type: ignore
        NONE,
        Arithmetic,
        Interval,
        Open,
        check,
        check_domain,
        fails,
        somewhere,
    )  # fmt: skip
    from counterexample_formulas import UNIT, Writer, degree, inner_names, put, put_names  # type: ignore
    from counterexample_functions import More, Place, integral, just, piece  # type: ignore

BITS, NEAR, WAVES, MOST_FACTORS = 160, Fraction(1, 2**60), (1, 2, 3), 20
SHARED = ("hamiltonian", "transformation", "generating_function")
S, WHOLE = Formula(".", ("#s",)), (Fraction(0), Fraction(1))


def claim_with(tables: Any, names: Any, texts: dict[str, Any]) -> More:
    """The names of a file and of a claim, with these texts; the file's Hamiltonian among them."""
    space = tables["phase_space"]
    usual = {*space["q"], *space["p"], space.get("time", "t"), *tables.get("symbols", {})}
    symbols = tables.get("symbols", {}) | {name: "real" for name in names if name not in usual}
    kept = {key: x for key, x in tables.items() if key in ("definitions", "hamiltonian")}
    where = {"domain": {"where": tables.get("domain", {}).get("where", [])}}
    if {*tables.get("domain", {})} - {"where"} or {*names} & {*tables.get("definitions", {})}:
        raise Stop("not shown", "a surface, or a name with two meanings")
    old = {key: x for key, x in space.items() if key in ("q", "p", "time")}
    claim = {"kind": "identity", "lhs": "0", "rhs": "0"}
    asked = More({**kept, **where, "phase_space": old, "symbols": symbols, "claim": claim})
    asked.texts |= texts
    return asked


def sides_of(conditions: Any) -> list[tuple[str, str]]:
    """(text, word): what a domain's conditions ask of differences."""
    found = list[tuple[str, str]]()
    for words in (re.split(r"(<=|>=|!=|<|>)", text) for text in conditions):
        for a, sign, b in zip(words[::2], words[1::2], words[2::2], strict=False):
            found.append((f"({b}) - ({a})", "nonzero" if sign == "!=" else "positive" if "<" in sign else "negative"))
    return found


class Range:
    """A formula of s between 0 and 1 at a point, with signs of others that have to be so all the way."""

    def __init__(self, claim: Any, of: dict[str, Any], f: Formula, asked: Any = ()) -> None:
        self.claim, self.of, self.f, self.asked, self.real = claim, of, f, asked, Arithmetic(BITS)

    def box(self, s: Interval) -> Place:
        """The names at the point, with s in an interval."""
        return Place(self.claim, {**self.of, "#s": s}, self.real)

    def part(self, s: Interval) -> Interval:
        """The integral over a piece."""
        box = self.box(s)
        for formula, words in self.asked:
            check(box.at(formula), words)
        return piece(self.box, self.f, "#s", s)

    def enclosed(self, done: Callable[[Interval], bool]) -> Interval:
        """The integral from 0 to 1, as exactly as is needed. Raises Open."""
        left, right = self.at_end(0), self.at_end(1)
        over = (NEAR if left else WHOLE[0], 1 - NEAR if right else WHOLE[1])
        low, high = (sum((x[k] for x in (left, right) if x), Fraction(0)) for k in (0, 1))
        found = integral(self.part, over, lambda x: done((x[0] + low, x[1] + high)))
        return found[0] + low, found[1] + high

    def at_end(self, end: int) -> Interval | None:
        """What is left out at an end where the integrand may be infinite; None where nothing has to be."""
        s = (WHOLE[0], NEAR) if end == 0 else (1 - NEAR, WHOLE[1])
        try:
            self.part(s)
            return None
        except Open:
            pass
        box, tip = self.box(s), self.box(just(Fraction(end)))
        for formula, words in self.asked:
            check(box.at(formula), words)
        for node, base in poles(self.f):
            value, steep = tip.at(base), box.at(base, "#s")
            slope = steep[0] if end == 0 else -steep[1]
            if value[0] >= 0 and slope > 0 and times_in(self.f, node) == 1:
                rest = box.at(put(self.f, lambda x, node=node: UNIT if x is node else None))
                far = 2 * self.real.root(NEAR / slope)[1]
                ends = [r * c for r in rest for c in (Fraction(0), far)]
                return min(ends), max(ends)
        raise Open("an end of the range")


@cache
def poles(f: Formula) -> list[tuple[Formula, Formula]]:
    """The factors 1/√g of a product, each with its g."""
    if f.kind == "*":
        return [*dict.fromkeys(x for factor in f.of for x in poles(factor))][:MOST_FACTORS]
    if f.kind != "^" or f.of[1].kind != "#":
        return []
    base, r = f.of[0], f.of[1].of[0]
    if r == Fraction(-1, 2):
        return [(f, base)]
    if r == -1 and base.kind == "^" and base.of[1].kind == "#" and base.of[1].of[0] == Fraction(1, 2):
        return [(f, base.of[0])]
    return []


def times_in(f: Formula, node: Formula) -> int:
    """How often a formula stands in another, which may have the same part in several places."""
    count = cache(lambda x: 1 if x is node else sum(count(y) for y in x.of if isinstance(y, Formula)))
    return count(f)


def of_integral(tables: Any, witness: Any) -> bool:
    """∫ f over the variable isn't `equals`."""
    claim = tables["claim"]
    if {*SHARED} & {*tables} or "infinity" in f"{claim['from']} {claim['to']}":
        raise Stop("not shown", "an integral beside a Hamiltonian or a map, or to infinity")
    name = claim["variable"]
    asked = claim_with(tables, [name], {f"_{key}": claim[key] for key in ("f", "from", "to", "equals")})
    within = lambda text: inner_names(asked.known(text), asked)
    conditions = sides_of(asked.domain.get("where", []))
    if any(name in within(text) for text in (*(x for x, _ in conditions), "_from", "_to", "_equals")):
        raise Stop("not shown", "conditions on the variable")
    words = {*asked.words.get(name, ())} - {"real"}
    if words - {"positive", "negative", "nonnegative"}:
        raise Stop("not shown", "such a variable")
    of = somewhere(asked, witness, 0)
    of.pop(name, None)
    point = Place(asked, of, Arithmetic(BITS))
    for text, word in conditions:
        check(point.text(text), [word])
    for other, said in asked.words.items():
        if "function" not in said and other != name:
            check(point.named(other), said)
    low, high, value = (point.text(f"_{key}") for key in ("from", "to", "equals"))
    if not low[1] < high[0] or (words - {"negative"} and low[0] < 0) or ("negative" in words and high[1] > 0):
        raise Open("that the range is one")
    write = Writer(asked)
    length = asked.read("_to - _from")
    moved = asked.read("_from + s*a", {"a": length, "s": S})
    there = {name: write.written(moved)}
    f = asked.made("*", put_names(write.written(asked.known("_f")), there), write.written(length))
    return leaves_out(Range(asked, of, f, [(put_names(x, there), ()) for x in write.under]), value)


def leaves_out(whole: Range, value: Interval) -> bool:
    """Whether the integral isn't the value."""
    apart = lambda x: x[1] < value[0] or value[1] < x[0]
    small = (abs(value[0]) + abs(value[1]) or 1) / 10**5
    found = whole.enclosed(lambda x: apart(x) or x[1] - x[0] < small)
    return apart(found)


def of_average(tables: Any, witness: Any) -> bool:
    """An average over time isn't `equals`: along a motion that is given, or by a virial at a point."""
    claim = tables["claim"]
    if {"transformation", "generating_function"} & {*tables}:
        raise Stop("not shown", "an average beside a map")
    texts = {f"_{key}": claim[key] for key in ("f", "equals", "virial", "from", "to") if key in claim}
    if "virial" in claim:
        return by_virial(claim_with(tables, [], texts), tables, witness)
    if "motion" not in claim:
        raise Stop("not shown", "an average over an orbit")
    u = claim["parameter"]
    asked = claim_with(tables, [u], texts)
    time, moving = asked.names[-1], {*asked.names[:-1]}
    conditions = sides_of(asked.domain.get("where", []))
    if any(inner_names(asked.known(text), asked) & {*moving, u, time} for text, _ in conditions):
        raise Stop("not shown", "conditions on what moves")
    if inner_names(asked.known("_equals"), asked) & {*moving, u} or {*claim["motion"]} - {*moving, time}:
        raise Stop("not shown", "an average of that form")
    of = somewhere(asked, witness, 0)
    point = Place(asked, {name: x for name, x in of.items() if name not in (*moving, u)}, Arithmetic(BITS))
    for text, word in conditions:
        check(point.text(text), [word])
    for name, words in asked.words.items():
        if "function" not in words and name not in moving | {u, time}:
            check(point.named(name), words)
    write = Writer(asked)
    length, s = asked.read("_to - _from"), {"a": asked.read("_to - _from"), "s": S}
    along = {u: write.written(asked.read("_from + s*a", s))}
    motion = {name: write.written(asked.known(text)) for name, text in claim["motion"].items()}
    if time not in motion and u != time:
        raise Stop("not shown", "a motion without its time")
    rate = write.slope(motion[time], u) if time in motion else UNIT
    here = lambda f: put_names(put_names(f, motion), along)
    f = asked.read("a*b*c", {"a": here(write.written(asked.read("_f - _equals"))),
                             "b": put_names(rate, along), "c": write.written(length)})  # fmt: skip
    signs = [(put_names(motion[n], along), asked.words.get(n, ()) if n != time else ()) for n in motion]
    signs += [(here(x), ()) for x in write.under]
    return leaves_out(Range(asked, {n: x for n, x in of.items() if n not in moving}, f, signs), NONE)


def by_virial(asked: Any, tables: Any, witness: Any) -> bool:
    """f − dG/dt isn't `equals` at a point, where every motion goes on for ever: Hamilton's equations are linear."""
    time, claim = asked.names[-1], tables["claim"]
    write, scale = Writer(asked), Formula(".", ("#k",))
    turned = {x: asked.made("*", scale, Formula(".", (x,))) for x in asked.names[:-1]}
    h = put_names(write.written(asked.known("_H")), turned)
    most = degree(h, "#k", asked)
    said = {*asked.names} & {n for text in tables.get("domain", {}).get("where", []) for n in re.findall(r"\w+", text)}
    if most is None or most > 2 or said or any({*asked.words.get(x, ())} - {"real"} for x in asked.names):
        raise Stop("not shown", "motions that may end")
    if time in inner_names(h, asked) or "bound" not in claim:
        raise Stop("not shown", "a Hamiltonian that depends on time")
    point = Place(asked, somewhere(asked, witness, 0), Arithmetic(BITS))
    check_domain(point, tables)
    return fails(point.text(f"_f - bracket(_virial, _H) - D(_virial, {time}) - _equals"), "")


def of_extremum(tables: Any, witness: Any) -> bool:
    """A wave between the ends for which the second variation has the wrong sign, in one coordinate."""
    claim = tables["claim"]
    if {*SHARED} & {*tables} or claim.get("extremum") not in ("minimum", "maximum") or len(claim["path"]) != 1:
        raise Stop("not shown", "an extremum of that form")
    (v,), (path,) = claim["velocities"], claim["path"]
    asked = claim_with(tables, [v], {"_L": claim["L"], "_path": path, "_from": claim["from"], "_to": claim["to"]})
    time, q = asked.names[-1], asked.names[0]
    conditions = sides_of(asked.domain.get("where", []))
    if any(inner_names(asked.known(text), asked) & {*asked.names, v} for text, _ in conditions):
        raise Stop("not shown", "conditions on the path")
    asked.variables = [*asked.names, v]
    of = somewhere(asked, witness if isinstance(witness, dict) else {}, 0)
    point = Place(asked, of, Arithmetic(BITS))
    for text, word in conditions:
        check(point.text(text), [word])
    for name, words in asked.words.items():
        if "function" not in words and name not in (v, *asked.names):
            check(point.named(name), words)
    if not point.text("_from")[1] < point.text("_to")[0]:
        raise Open("that the range is one")
    write = Writer(asked)
    length, lagrangian = write.written(asked.read("_to - _from")), write.written(asked.known("_L"))
    moved = {time: write.written(asked.read("_from + s*a", {"a": length, "s": S}))}
    curve = write.written(asked.known("_path"))
    on = {q: put_names(curve, moved), v: put_names(write.slope(curve, time), moved), **moved}
    second = {x + y: put_names(write.slope(write.slope(lagrangian, x), y), on) for x, y in ((q, q), (q, v), (v, v))}
    signs = [(on[q], asked.words.get(q, ())), *((put_names(x, on), ()) for x in (lagrangian, *write.under))]
    for k in WAVES:
        wave = {"s": S, "a": length, "k": number(k), "x": second[q + q], "y": second[q + v], "z": second[v + v]}
        text = "x*sin(k*pi*s)**2*a + 2*y*sin(k*pi*s)*cos(k*pi*s)*k*pi + z*(cos(k*pi*s)*k*pi)**2/a"
        whole = Range(asked, {n: x for n, x in of.items() if n != v}, asked.read(text, wave), signs)
        found = whole.enclosed(lambda x: x[0] > 0 or x[1] < 0 or x[1] - x[0] < Fraction(1, 10**6))
        if found[1] < 0 if claim["extremum"] == "minimum" else found[0] > 0:
            return True
    return False


RULES = {"integral": of_integral, "average": of_average, "stationary": of_extremum}


def refuted(tables: Any, witness: Any, known: Any = None) -> tuple[str, str]:
    """Whether the claim fails at the witness."""
    if (rule := RULES.get(tables["claim"]["kind"])) is None or not isinstance(witness, dict):
        raise Stop("not shown", "a refutation of such a claim")
    return ("shown", "") if rule(tables, witness) else ("not shown", "that something fails at the witness")
