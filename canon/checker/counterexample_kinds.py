"""More refutations at a point, beside `counterexample.py`: by tables, by orders of a parameter, on surfaces, by
maps.

Each rule names formulas that have to vanish if the claim holds, and what has to be so of a point before it counts.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Collection, Iterator
from contextlib import suppress
from fractions import Fraction
from functools import cache, partial
from pathlib import Path
from random import Random
from typing import Any, cast

if __package__:
    from canon.checker import alone_table
    from canon.checker.alone import Formula, Stop
    from canon.checker.alone_wider import Wider
    from canon.checker.counterexample import (
        NONE,
        Arithmetic,
        Open,
        check,
        check_domain,
        claim_of,
        fails,
        momenta_of,
        somewhere,
    )  # fmt: skip
    from canon.checker.counterexample_formulas import Writer, put_names
    from canon.checker.counterexample_functions import More, Place
    from canon.checker.counterexample_maps import Asked, of_generated, of_map, of_transported, plain
else:  # as a program's part, beside the other files
    import alone_table  # type: ignore
    from alone import Formula, Stop  # type: ignore
    from alone_wider import Wider  # type: ignore
    from counterexample import (  # type: ignore
        NONE,
        Arithmetic,
        Open,
        check,
        check_domain,
        claim_of,
        fails,
        momenta_of,
        somewhere,
    )  # fmt: skip
    from counterexample_formulas import Writer, put_names  # type: ignore
    from counterexample_functions import More, Place  # type: ignore
    from counterexample_maps import Asked, of_generated, of_map, of_transported, plain  # type: ignore

KINDS = tomllib.loads(Path(__file__).with_name("counterexample_kinds.toml").read_text(encoding="utf-8"))["kinds"]
BITS, PIECES, GUESSES = (64, 192), 300, 12
SHARED = ("hamiltonian", "transformation", "generating_function")


class Table(More, Wider):
    """What a claim asks for by a table. Names that a solution is called with have to be what is assumed of them."""

    def __init__(self, tables: Any, form: Any) -> None:
        self.placed_in, self.writer = list[tuple[Formula, set[str]]](), Writer(self)
        super().__init__(tables, form)
        self.outer = cache(partial(More.outer, self))

    def built(self, at: Any, text: str, own: Any) -> Any:
        called = getattr(getattr(at, "func", None), "id", "_")[1:]
        if called == "_along":
            first, *rest = (self.built(x, text, {}) for x in at.args)
            names = {x.of[0]: self.writer.written(y) for x, y in zip(rest[::2], rest[1::2], strict=True)}
            found = put_names(self.writer.written(first), names)
            self.placed_in += [(put_names(x, names), set[str]()) for x in self.writer.under]
            return found
        if called in getattr(self, "solution", {}):
            given = zip(self.solution[called][0], at.args, strict=True)
            self.placed_in += [(self.built(x, text, own), {*self.words.get(n, ())}) for n, x in given]
        return super().built(at, text, own)


def of_table(tables: Any) -> Iterator[Asked]:
    """By a row of a table: all of it is evaluated at the point."""
    claim, kind = dict(tables["claim"]), tables["claim"]["kind"]
    order, parameter = claim.get("order", 3), claim.get("parameter", "")
    apart = {"lie_series": ("order",), "stationary": ("extremum", "field", "conjugate")}.get(kind, ())
    tables = {**tables, "claim": {key: x for key, x in claim.items() if key not in apart}}
    beside = kind in ("hamilton_jacobi", "lie_series") and {*tables.get("transformation", {})} == {"Q", "P"}
    usual = {key: x for key, x in tables.items() if key not in SHARED[1:]} if beside else tables
    try:
        form = alone_table.form_of(usual, KINDS)
    except ValueError:
        form = dict(alone_table.form_of(usual))
        form["nonzero"] = form.get("nonzero", []) if kind == "identity" else []
    if "map" not in form and not beside and {*SHARED[1:]} & {*tables}:
        raise Stop("not shown", "a claim of this kind beside a map")
    if "generating_function" in usual and "map" in form and "transformation" not in usual:
        raise Stop("not shown", "a claim of this kind beside a generating function")
    if "one" in form and len(claim[form["one"]]) != 1:
        raise Stop("not shown", "several forms")
    asked, zeros = Table(usual, form), ()
    if kind == "hamilton_jacobi":
        momenta_of(asked, claim, tables["phase_space"])
    on = tuple(asked.besides) if form in KINDS.get(kind, ()) else ()
    asked.besides = [] if on or kind == "dimension" else asked.besides
    held: tuple[Any, ...] = ()
    if kind == "dimension":
        functions = any(isinstance(x, list) for x in claim["dimensions"].values())
        if {*SHARED} & {*tables} or tables.get("domain") or functions:
            raise Stop("not shown", "units beside conditions, or of functions")
        zeros = tuple(Wider(usual, form).besides)
    elif kind == "lie_series":
        held = ((parameter, Fraction(0)),)
    elif kind == "matrix_group":
        asked.places = (*asked.places, *asked.placed)
    here = None
    if kind == "stationary":
        here = partial(along, tables=tables)
        if {*SHARED} & {*tables} or {*asked.words} & {*tables["phase_space"]["p"]}:
            raise Stop("not shown", "a path beside a Hamiltonian or a map")
        for i, v in enumerate(claim["velocities"]):
            asked.texts |= {asked.names[i]: f"__path_{i}", v: f"D(__path_{i}, {asked.names[-1]})"}
        yield from by_legendre(asked, claim, here)
    elif kind == "matrix_group" and tables.get("domain", {}).get("where"):
        here = partial(elsewhere, tables=tables)
    elif beside:
        here = partial(image, tables=tables)
    last = (parameter, min(order - 1, 4)) if kind == "lie_series" else ("", 0)
    yield Asked(asked, (*asked.zeros, *zeros), on, tuple(asked.nonzero), held, last, here=here)


def by_legendre(asked: Any, claim: Any, here: Any) -> Iterator[Asked]:
    """At a minimum ∂²L/∂v² isn't negative along the path, in any velocity; at a maximum not positive."""
    if claim.get("extremum") not in ("minimum", "maximum"):
        return
    sign = "" if claim["extremum"] == "minimum" else "-"
    zeros = tuple(f"{sign}({on_path(asked, claim, f'D(D(__L, {v}), {v})')})" for v in claim["velocities"])
    yield Asked(asked, zeros, relation=">=", here=here, time="(__from + __to)/2")


def on_path(asked: Any, claim: Any, text: str) -> str:
    """A formula of coordinates, velocities and time at the path."""
    n, time = range(len(claim["path"])), asked.names[-1]
    puts = [f"{asked.names[i]}, __path_{i}" for i in n]
    puts += [f"{claim['velocities'][i]}, D(__path_{i}, {time})" for i in n]
    return f"_along({text}, {', '.join(puts)})"


def along(point: Place, tables: Any) -> None:
    """The time lies between the ends, and the path in the domain, with all that the claim needs, all the way."""
    asked, claim, time = cast(Table, point.claim), tables["claim"], point.claim.names[-1]
    low, high = (point.text(f"__{end}") for end in ("from", "to"))
    now = point.named(time)
    if not low[1] < now[0] or not now[1] < high[0]:
        raise Open("that the time is between the ends")
    conditions = [text for text in tables.get("domain", {}).get("where", []) if re.search(r"\w", text)]
    if re.search(rf"(?<!\w)({'|'.join(map(re.escape, tables['phase_space']['p']))})(?!\w)", str(conditions)):
        raise Stop("not shown", "a path where a condition speaks of momenta")
    pieces, tried = [(low[0], high[1])], 0
    while pieces:
        a, b = pieces.pop()
        if (tried := tried + 1) > PIECES:
            raise Open("that the path lies in the domain")
        try:
            box = type(point)(asked, {**point.of, time: (a, b)}, point.real)
            box.text(on_path(asked, claim, "__L"))
            for f, _ in asked.placed_in:
                box.at(f)
            for text in conditions:
                words = re.split(r"(<=|>=|!=|<|>)", text)
                for x, sign, y in zip(words[::2], words[1::2], words[2::2], strict=False):
                    value = box.text(on_path(asked, claim, f"({y}) - ({x})"))
                    check(value, ["nonzero" if sign == "!=" else "positive" if "<" in sign else "negative"])
            for i in range(len(claim["path"])):
                check(box.text(f"__path_{i}"), asked.words.get(asked.names[i], ()))
            for i in range(len(claim["path"])):
                box.text(f"D(__path_{i}, {time})")
        except Open:
            pieces += [(a, (a + b) / 2), ((a + b) / 2, b)]


def elsewhere(point: Place, tables: Any) -> None:
    """What stands in the place of a group's parameters lies in the domain as well."""
    claim = tables["claim"]
    lists = [[f"__{key}_{k}" for k in range(len(claim["first"]))] for key in ("composition", "inverse") if key in claim]
    for new in (claim["second"], *lists):
        put = ", ".join(f"{a}, {b}" for a, b in zip(claim["first"], new, strict=True))
        for text in tables["domain"]["where"]:
            words = re.split(r"(<=|>=|!=|<|>)", text)
            for x, sign, y in zip(words[::2], words[1::2], words[2::2], strict=False):
                value = point.text(f"_with(({y}) - ({x}), {put})")
                check(value, ["nonzero" if sign == "!=" else "positive" if "<" in sign else "negative"])


def image(point: Place, tables: Any, but: Collection[str] = ()) -> None:
    """Beside a map given forward: with p = ∂S/∂q the point lies in the map's domain, and its image in the file's; the
    names in `but` are none of the map's values."""
    space, explicit = tables["phase_space"], tables["transformation"]
    other = More(plain(tables))
    given = ((x, text) for side in explicit for x, text in zip(space[side], explicit[side], strict=True))
    other.texts |= {x: text for x, text in given if x not in but}
    of = {**point.of, **{p: point.named(p) for p in space["p"]}}
    check_domain(Place(other, {x: y for x, y in of.items() if x not in other.texts}, point.real), tables)


def of_plain(tables: Any) -> Iterator[Asked]:
    """What `counterexample.py` knows, with more functions."""
    asked = claim_of(tables, More)
    yield Asked(asked, tuple(asked.zeros), relation=tables["claim"].get("relation", ""))


RULES = {"canonical": of_map, "fundamental_brackets": of_map, "cartan_invariant": of_table, "stationary": of_table,
    "constraint": of_table, "dimension": of_table, "euler_lagrange": of_table, "hamilton_jacobi": of_table,
    "identity": of_table, "lie_series": of_table, "matrix_group": of_table, "new_hamiltonian": of_transported,
    "solves": of_table}  # fmt: skip


def near(asked: Asked, of: dict[str, Any], real: Arithmetic) -> dict[str, Any]:
    """A point of the surface: each equation is 0 exactly, or changes its sign along one name in a short interval."""
    point, wide = Place(asked.claim, of, real), list[str]()
    values = [point.text(text) for text in asked.on]
    inexact = [text for text, value in zip(asked.on, values, strict=True) if value != NONE]
    if len(inexact) > 1:
        raise Open("a point of the surface")
    for text in inexact:
        for name in (n for n, x in of.items() if isinstance(x, tuple) and n not in asked.claim.texts):
            x = of[name][0]
            far = (abs(x) + 1) / 10**25
            ends = [Place(asked.claim, {**of, name: (y, y)}, real).text(text) for y in (x - far, x + far)]
            if (ends[0][1] < 0 < ends[1][0]) or (ends[1][1] < 0 < ends[0][0]):
                wide.append(name)
                of = {**of, name: (x - far, x + far)}
                break
        else:
            raise Open("a point of the surface")
    box = Place(asked.claim, of, real)
    values = {text: box.text(text) for text in asked.on}  # continuous where they have values
    if any(values[text] != NONE for text in asked.on if text not in inexact):
        raise Open("a point of the surface")
    return of


def guesses(asked: Asked, witness: Any) -> Iterator[dict[str, Any]]:
    """The witness with values for what it leaves open; without one, values of our own."""
    if isinstance(witness, dict):
        yield from (somewhere(asked.claim, witness, k) for k in range(3))
        return
    rng = Random(0)
    for k in range(GUESSES):
        of = somewhere(asked.claim, {}, k)
        numbers = {n: Fraction(rng.randint(1, 40), rng.randint(1, 40)) for n, x in of.items() if isinstance(x, tuple)}
        for n, x in numbers.items():
            words = asked.claim.words.get(n, ())
            sign = -1 if "negative" in words or (not {*words} - {"real", "nonzero"} and rng.random() < 0.5) else 1
            of[n] = (Fraction(round(x) if "integer" in words else x) * sign,) * 2
        yield of


def fails_at(asked: Asked, of: dict[str, Any], tables: Any, real: Arithmetic) -> bool:
    """Whether something isn't 0 that has to be, at a point that counts. Raises Open."""
    if asked.time:  # halfway
        of = of | {asked.claim.names[-1]: Place(asked.claim, of, real).text(asked.time)}
    of = near(asked, of | {name: (x, x) for name, x in asked.held}, real)
    point = Place(asked.claim, of, real)
    sections = {"hamiltonian": tables.get("hamiltonian", {}), "transformation": {}}
    if tables.get("transformation") and not callable(asked.here):
        sections["transformation"] = tables["transformation"]
    check_domain(point, sections)
    for f, words in (*getattr(asked.claim, "places", ()), *getattr(asked.claim, "placed_in", ())):
        check(point.at(f), {*words} - {"function"})
    if not all(fails(point.text(text), "") for text in asked.apart):
        raise Open("that something isn't 0 that must not be")
    name, most = asked.orders
    for text, k in ((text, k) for text in reversed(asked.zeros) for k in range(most + 1)):
        with suppress(Open):
            if fails(point.at(asked.claim.known(text), *(name,) * k), asked.relation):
                break
    else:
        return False
    if asked.here:
        asked.here(point)
    return True


def refuted(tables: Any, witness: Any, known: Any = None) -> tuple[str, str]:
    """Whether the claim fails at the witness, or somewhere else."""
    kind, reason = tables["claim"]["kind"], "that something fails at the witness"
    rules = [RULES[kind]] if kind in RULES else []
    if "generating_function" in tables and "transformation" not in tables:
        rules = [of_generated] if kind == "new_hamiltonian" else []
    rules = [of_map] if tables.get("domain", {}).get("on") and rules == [of_map] else [*rules, of_plain]
    for rule in rules:
        try:
            for asked, of, bits in ((a, of, bits) for a in rule(tables) for of in guesses(a, witness) for bits in BITS):
                try:
                    if fails_at(asked, of, tables, Arithmetic(bits)):
                        return "shown", ""
                except Open as left:
                    reason = str(left)
        except (Stop, ValueError, KeyError, TypeError) as stop:  # not of this rule's form
            reason = str(stop.args[-1])
    return "not shown", reason
