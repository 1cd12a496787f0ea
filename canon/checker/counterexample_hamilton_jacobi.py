"""Refutations of complete integrals beside a map, beside `counterexample.py`: the equation fails on the map's image.

Beside a map given backward, or by a generating function, a file is about its image. So the point is one of the new
variables and time (or those of F, where its mixed Hessian isn't 0), the constants of the integral among them, and the
coordinates are what the map gives there. Beside a map given forward the file's conditions hold with p = ∂S/∂q, for the
new variables that the map gives. What the claim calls its constants is none of these: it is a name of the claim's own,
of which the conditions speak, and so does S; the map's value is another one where S is no integral.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from fractions import Fraction
from random import Random
from typing import Any

if __package__:
    from canon.checker import alone_table
    from canon.checker.alone import TYPES, Stop
    from canon.checker.counterexample import Arithmetic, Open, check, check_domain, fails, momenta_of, somewhere
    from canon.checker.counterexample_formulas import inner_names
    from canon.checker.counterexample_functions import More, Place
    from canon.checker.counterexample_integrals import sides_of
    from canon.checker.counterexample_kinds import SHARED, Table, image
    from canon.checker.counterexample_maps import determinant, plain
else:  # as a program's part, beside the other files
    import alone_table  # type: ignore
    from alone import TYPES, Stop  # type: ignore
    from counterexample import (  # type: ignore
        Arithmetic,
        Open,
        check,
        check_domain,
        fails,
        momenta_of,
        somewhere,
    )  # fmt: skip
    from counterexample_formulas import inner_names  # type: ignore
    from counterexample_functions import More, Place  # type: ignore
    from counterexample_integrals import sides_of  # type: ignore
    from counterexample_kinds import SHARED, Table, image  # type: ignore
    from counterexample_maps import determinant, plain  # type: ignore

BITS, TRIES, MORE = 64, 3, 150
FACTORS = tuple(Fraction(n, 8) for n in (1, 2, 4, 6, 8, 10, 12, 16, 24, 64, -8, -4))


def points(claim: Any, witness: Any, tries: int) -> Iterator[dict[str, Any]]:
    """The witness with values for what it leaves open, and places around it."""
    rng, seen = Random(0), list[Any]()
    for k in range(3 + tries):
        of = somewhere(claim, witness, k % 3)
        for name, x in of.items() if k > 2 else ():
            if isinstance(x, tuple) and "integer" not in claim.words.get(name, ()) and rng.random() < 0.6:
                signed = {*claim.words.get(name, ())} - {"real"}
                of[name] = (x[0] * rng.choice(FACTORS[:-2] if signed else FACTORS),) * 2
        if of not in seen:
            seen.append(of)
            yield of


def soon(asked: Any, of: dict[str, Any], tables: Any, real: Arithmetic) -> None:
    """See that conditions without momenta hold, before something that takes long is evaluated. Raises Open."""
    point, moving = Place(asked, of, real), {*tables["phase_space"]["p"]}
    for text, word in sides_of(tables.get("domain", {}).get("where", [])):
        if not inner_names(asked.known(text), asked) & moving:
            check(point.text(text), [word])


def on_map(tables: Any, of: dict[str, Any], real: Arithmetic) -> dict[str, Any]:
    """The coordinates that the map gives at new variables, or at those of F; the map has a value there. Raises Open."""
    space, explicit = tables["phase_space"], tables.get("transformation", {})
    sections = {key: x for key, x in tables.items() if key not in SHARED}
    moved = More(plain({**sections, "domain": {"where": []}}))
    if {*explicit} == {"q", "p"}:
        texts = {x: text for side in explicit for x, text in zip(space[side], explicit[side], strict=True)}
        new = {*space["Q"], *space["P"]}
    else:
        generating, n = tables["generating_function"], len(space["q"])
        types = [generating["type"]] * n if isinstance(generating["type"], int) else generating["type"]
        free = [[space[side][i] for i, one in enumerate(types) for side in TYPES[one][k]] for k in (0, 1)]
        if any(one not in (1, 2) for one in types) or [len(space[side]) for side in "qpQP"] != [n] * 4:
            raise Stop("not shown", "a generating function of momenta")
        texts, new = {"_F": generating["F"]}, {*free[1]}
        rows = [[f"D(D(_F, {u}), {v})" for v in free[1]] for u in free[0]]
        moved.texts |= texts
        point = Place(moved, of, real)
        for name in (*free[0], *free[1]):
            point.text(f"D(_F, {name})")
        if not fails(point.text(determinant(rows)), ""):
            raise Open("that the mixed Hessian isn't 0")
        return {}
    if not {*tables["claim"]["constants"]} <= new:
        raise Stop("not shown", "constants that aren't new variables")
    own = {x: y for x, y in of.items() if x not in texts}
    point, found = Place(moved, own, real), dict[str, Any]()
    for x, text in texts.items():
        found[x] = point.text(text)
        check(found[x], moved.words.get(x, ()))
    jacobian = [[f"D({x}, {u})" for u in (*space["Q"], *space["P"])] for x in texts]
    moved.texts |= texts
    moved.variables = [*space["Q"], *space["P"], moved.names[-1]]
    moved.known.cache_clear()  # type: ignore
    if not fails(Place(moved, own, real).text(determinant(jacobian)), ""):
        raise Open("that the map isn't singular")
    return {x: found[x] for x in space["q"]}


def refuted(tables: Any, witness: Any, known: Any = None) -> tuple[str, str]:
    """Whether the equation fails at a point of the domain."""
    explicit = tables.get("transformation", {})
    if tables["claim"]["kind"] != "hamilton_jacobi" or not isinstance(witness, dict):
        raise Stop("not shown", "a refutation of such a claim")
    if not {*SHARED[1:]} & {*tables} or {*tables.get("domain", {})} - {"where"}:
        raise Stop("not shown", "an equation beside no map, or on a surface")
    usual = {key: x for key, x in tables.items() if key not in SHARED[1:]}
    if {*explicit} != {"Q", "P"} and tables.get("domain", {}).get("where"):
        raise Stop("not shown", "conditions beside an image")
    form, reason = dict(alone_table.form_of(usual)), "that something fails at the witness"
    form["nonzero"] = []
    asked = Table(usual, form)
    momenta_of(asked, tables["claim"], tables["phase_space"])
    forward = {*explicit} == {"Q", "P"}
    for of in points(asked, witness, TRIES if forward else MORE):
        real = Arithmetic(BITS)
        try:
            soon(asked, of, tables, real)
            there = {**of, **({} if forward else on_map(tables, of, real))}
            point = Place(asked, there, real)
            check_domain(point, {"hamiltonian": tables.get("hamiltonian", {})})
            if forward:
                image(point, tables, tables["claim"]["constants"])
            for text in asked.zeros:
                with suppress(Open):
                    if fails(point.text(text), ""):
                        return "shown", ""
        except Open as left:
            reason = str(left)
    return "not shown", reason
