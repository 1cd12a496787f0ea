"""Refutations of angles, beside `counterexample.py`: the old variables don't come back after the angle's period, or
the time that the angle takes for it isn't that of the orbit."""

from __future__ import annotations

from typing import Any

if __package__:
    from canon.checker.alone import Stop
    from canon.checker.counterexample import Arithmetic, Open, check, fails, somewhere
    from canon.checker.counterexample_formulas import inner_names
    from canon.checker.counterexample_functions import Place
    from canon.checker.counterexample_integrals import claim_with, sides_of
    from canon.checker.counterexample_orbits import BITS, Orbits, apart, circular, multiples
else:  # as a program's part, beside the other files
    from alone import Stop  # type: ignore
    from counterexample import Arithmetic, Open, check, fails, somewhere  # type: ignore
    from counterexample_formulas import inner_names  # type: ignore
    from counterexample_functions import Place  # type: ignore
    from counterexample_integrals import claim_with, sides_of  # type: ignore
    from counterexample_orbits import BITS, Orbits, apart, circular, multiples  # type: ignore


def of_angle(tables: Any, witness: Any) -> bool:
    """An angle doesn't advance by its period: the old variables don't come back, or it advances by another T {w, H}."""
    claim, space, explicit = tables["claim"], tables["phase_space"], tables["transformation"]
    if "generating_function" in tables or {*claim} - {"kind", "angle_period"}:
        raise Stop("not shown", "angles by a generating function")
    new = [*space["Q"], *space["P"]]
    period = {"_period": claim.get("angle_period", "1")}
    if {*explicit} == {"q", "p"}:
        return comes_back(tables, witness, period)
    if len(space["q"]) != 1:
        raise Stop("not shown", "several angles that are given forward")
    maps = dict(zip(new, [*explicit["Q"], *explicit["P"]], strict=True))
    asked = claim_with({**tables, "domain": {"where": []}}, [], period | {f"_{x}": y for x, y in maps.items()})
    q, p, time = asked.names
    of = somewhere(asked, witness, 0)
    of["#e"] = Place(asked, of, Arithmetic(BITS)).text("_H")
    domain = claim_with(tables, new, {**maps, **period})
    point = Place(domain, {n: x for n, x in of.items() if n not in maps}, Arithmetic(BITS))
    for text, word in sides_of(tables.get("domain", {}).get("where", [])):
        check(point.text(text), [word])
    for name, words in domain.words.items():
        if "function" not in words:
            check(point.named(name), words)
    if time in inner_names(asked.known("_H"), asked) | inner_names(asked.known(f"_{new[0]}"), asked):
        raise Stop("not shown", "a map that depends on time")
    point.text(new[1])
    rate, turn = point.text(f"bracket({new[0]}, _H)"), point.text("_period")
    if not fails(rate, "") or not fails(turn, ""):
        raise Open("that the angle moves")
    for name in (q, p):
        of.pop(name, None)
    orbits = Orbits(asked, of, q, "#e", [])
    if not orbits.plain:
        raise Stop("not shown", "a Hamiltonian that isn't quadratic in the momentum")
    bound = [abs(turn[k] / rate[m]) for k in (0, 1) for m in (0, 1)]
    value = (min(bound), max(bound))  # the time that the angle takes
    start = point.named(q)[0]
    try:
        found = orbits.over(orbits.time, orbits.reach(start), value, True)
        return apart(found, value)
    except Open:
        if not circular(orbits.d, q):
            raise
        length, half = point.text("2*pi"), asked.read("a/2", {"a": orbits.time})
        return not multiples(orbits.turn(half, length, value), value)


def comes_back(tables: Any, witness: Any, period: Any) -> bool:
    """With an angle that has grown by its period, a momentum isn't the same, or a coordinate not up to turns."""
    space, explicit = tables["phase_space"], tables["transformation"]
    flipped = {**tables, "phase_space": {**space, "q": space["Q"], "p": space["P"], "Q": [], "P": []}}
    asked = claim_with({**flipped, "domain": {"where": []}, "hamiltonian": {"H": "0"}}, [*space["q"], *space["p"]],
                       period | {f"_{side}{i}": x for side in "qp" for i, x in enumerate(explicit[side])})  # fmt: skip
    old = dict(zip([*space["q"], *space["p"]], [*explicit["q"], *explicit["p"]], strict=True))
    asked.texts |= old
    of = {n: x for n, x in somewhere(asked, witness, 0).items() if n not in old}
    point = Place(asked, of, Arithmetic(BITS))
    for text, word in sides_of(tables.get("domain", {}).get("where", [])):
        check(point.text(text), [word])
    asked.texts["_H"] = tables["hamiltonian"]["H"]
    point.text("_H")
    for name, words in asked.words.items():
        if "function" not in words:
            check(point.named(name), words)
    turn, real = point.text("_period"), point.real
    for w in space["Q"]:
        later = Place(asked, {**of, w: real.add(of[w], turn)}, real)
        for side in "qp":
            for k in range(len(explicit[side])):
                x, y = point.text(f"_{side}{k}"), later.text(f"_{side}{k}")
                gap = real.add(y, (-x[1], -x[0]))
                if side == "p" and fails(gap, ""):
                    return True
                turns = real.times(gap, real.power(point.text("2*pi"), -1))
                if side == "q" and turns[0].__floor__() < turns[0] and turns[0].__floor__() == turns[1].__floor__():
                    return True
    return False


RULES = {"action_angle": of_angle}


def refuted(tables: Any, witness: Any, known: Any = None) -> tuple[str, str]:
    """Whether the claim fails at the witness."""
    if (rule := RULES.get(tables["claim"]["kind"])) is None or not isinstance(witness, dict):
        raise Stop("not shown", "a refutation of such a claim")
    return ("shown", "") if rule(tables, witness) else ("not shown", "that something fails at the witness")
