"""Refutations of paths whose ends no formula has a value at, beside `counterexample_kinds.py`.

A path with a vertical tangent, or a Lagrangian with a pole at an end, can't be covered by boxes. Between the ends all
of L along the path is seen to be smooth by signs, for all values of the parameters (`alone_integrals.py`); then
Lagrange's equations fail at a point between them.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

if __package__:
    from canon.checker import alone, alone_integrals, alone_limits
    from canon.checker.alone import Stop
    from canon.checker.counterexample import Arithmetic, Open
    from canon.checker.counterexample_kinds import BITS, SHARED, fails_at, guesses, of_table
else:  # as a program's part, beside the other files
    import alone  # type: ignore
    import alone_integrals  # type: ignore
    import alone_limits  # type: ignore
    from alone import Stop  # type: ignore
    from counterexample import Arithmetic, Open  # type: ignore
    from counterexample_kinds import BITS, SHARED, fails_at, guesses, of_table  # type: ignore


def check_between(tables: Any) -> None:
    """See that the Lagrangian is smooth along the path between the ends. Raises Stop."""
    claim, space = tables["claim"], tables["phase_space"]
    time, moving = space.get("time", "t"), [*space["q"], *claim["velocities"]]
    words, where = tables.get("symbols", {}), tables.get("domain", {}).get("where", [])
    if {*SHARED} & {*tables} or {*tables.get("domain", {})} - {"where"} or {*words} & {*moving, *space["p"], time}:
        raise Stop("not shown", "a path beside other sections, or of which something is assumed")
    texts = [*claim["path"], claim["from"], claim["to"], *where]
    if any(alone_limits.mentions(tables, str(text), name) for text in texts for name in [*moving, *space["p"]]):
        raise Stop("not shown", "a path by itself, or conditions on it")
    if any(alone_limits.mentions(tables, text, time) for text in where):
        raise Stop("not shown", "conditions on time")
    whole = alone.formulas(tables)
    names = [f"old{k}" for k in range(1000) if f"old{k}" not in whole][:3]
    rates = [f"D({path}, {time})" for path in claim["path"]]
    on = dict(zip(moving, [*claim["path"], *rates], strict=True))
    integral = {"kind": "integral", "f": claim["L"], "variable": time, "equals": "0"}
    inner = {
        "phase_space": {"q": names[:1], "p": names[1:2], "time": names[2]},
        "symbols": words,
        "definitions": {**tables.get("definitions", {}), **on},
        **({"domain": {"where": where}} if where else {}),
        "claim": {**integral, "from": claim["from"], "to": claim["to"]},
    }
    path = alone_integrals.Integral(inner, "0")
    if any(isinstance(end, int) for end in path.ends):
        raise Stop("not shown", "a path without an end")
    between = alone_integrals.Between(path)
    for name in on:
        between.check(path.known(name), strict=True)
    between.check(path.f, strict=True)


def within(point: Any) -> None:
    """The time lies between the ends. Raises Open."""
    low, high = (point.text(f"__{end}") for end in ("from", "to"))
    now = point.named(point.claim.names[-1])
    if not low[1] < now[0] or not now[1] < high[0]:
        raise Open("that the time is between the ends")


def refuted(tables: Any, witness: Any, known: Any = None) -> tuple[str, str]:
    """Whether Lagrange's equations fail between the ends."""
    claim = tables["claim"]
    if claim["kind"] != "stationary" or not isinstance(witness, dict):
        raise Stop("not shown", "a refutation of such a claim")
    if {*claim} - {"kind", "L", "velocities", "path", "from", "to"}:
        raise Stop("not shown", "an extremum")
    check_between(tables)
    reason = "that something fails at the witness"
    for asked in of_table(tables):
        open_path = replace(asked, here=partial(within))
        for of in guesses(open_path, witness):
            for bits in BITS:
                try:
                    if fails_at(open_path, of, tables, Arithmetic(bits)):
                        return "shown", ""
                except Open as left:
                    reason = str(left)
    return "not shown", reason
