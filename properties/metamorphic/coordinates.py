"""The same claim in other canonical coordinates, as that of the inverse map, at another time, with another pair."""

from __future__ import annotations

import random

from properties.metamorphic.parts import (
    CANONICAL,
    MAPS,
    is_canonical,
    is_complex,
    substituted,
    with_claim,
    with_symbol,
    words_of,
)
from properties.metamorphic.tables import Tables, every_name, own_names, unused


def _pair_values(rng: random.Random, tables: Tables, q: str, p: str) -> tuple[Tables, str, str]:
    """The file, perhaps with another parameter, and what canonical coordinates replace: q and p in new ones."""
    c = unused(tables, "c")
    choice = rng.randrange(8)
    if choice in (6, 7):
        tables = with_symbol(tables, c, "positive" if choice == 6 else "real")
    return (tables, *(
        (p, f"-{q}"), (f"-{p}", q), (f"{q}+3/2", p), (q, f"{p}-2/3"), (f"3*{q}", f"{p}/3"), (q, f"{p}+{q}/2"),
        (f"{c}*{q}", f"{p}/{c}"), (f"{q}+{c}", f"{p}+{c}*{q}"),
    )[choice])  # fmt: skip


def in_other_coordinates(rng: random.Random, tables: Tables) -> Tables | None:
    """Old variables replaced by other canonical ones."""
    claim = tables["claim"][0]
    backward = {"q", "p"} & {*tables.get("transformation", {})} or "generating_function" in tables
    if claim["kind"] not in CANONICAL or {"tensor", "structure", "coordinates"} & {*claim} or backward:
        return None
    k = rng.randrange(len(tables["phase_space"]["q"]))
    q, p = tables["phase_space"]["q"][k], tables["phase_space"]["p"][k]
    tables, new_q, new_p = _pair_values(rng, tables, q, p)
    signs = {"positive": "{} > 0", "negative": "{} < 0", "nonzero": "{} != 0", "real": "", "nonnegative": "{} >= 0"}
    words = [words_of(tables, name) for name in (q, p)]
    if any(len(given) > 1 or given[0] not in signs for given in words) or is_complex(tables):
        return None
    where = [signs[given[0]].format(name) for given, name in zip(words, (q, p), strict=True) if given != ["real"]]
    if where:
        domain = tables.get("domain", {})
        tables = {**tables, "domain": {**domain, "where": [*domain.get("where", []), *where]}}
        tables = {**tables, "symbols": {n: w for n, w in tables["symbols"].items() if n not in (q, p)}}
    return substituted(tables, {q: new_q, p: new_p})


def to_other_coordinates(rng: random.Random, tables: Tables) -> Tables | None:
    """The map, and after it another canonical one of one pair."""
    given = tables.get("transformation", {})
    new = {name for word in "QP" for name in tables.get("phase_space", {}).get(word, [])}
    seen = every_name({**tables, "phase_space": {}})
    if tables["claim"][0]["kind"] not in MAPS or "Q" not in given or seen & new:
        return None
    k = rng.randrange(len(given["Q"]))
    Q, P = f"({given['Q'][k]})", f"({given['P'][k]})"
    tables, new_Q, new_P = _pair_values(rng, tables, Q, P)
    rows = {
        word: [row if i != k else own for i, row in enumerate(given[word])]
        for word, own in (("Q", new_Q), ("P", new_P))
    }
    return {**tables, "transformation": rows}


def read_backward(rng: random.Random, tables: Tables) -> Tables | None:
    """The same formulas as the map's inverse."""
    given, claim, space = tables.get("transformation", {}), tables["claim"][0], tables.get("phase_space", {})
    square = len(space.get("q", ())) == len(space.get("Q", ()))
    if claim["kind"] not in MAPS or not given or not square or "order" in claim or {"on"} & {*tables.get("domain", {})}:
        return None
    if claim["kind"] == "integral_invariant":
        return None
    swap = dict(zip("qpQP", "QPqp", strict=True))
    found = {**tables, "phase_space": {swap.get(word, word): names for word, names in space.items()}}
    found["transformation"] = {swap[word]: rows for word, rows in given.items()}
    found = {word: value for word, value in found.items() if word not in ("hamiltonian", "generating_function")}
    return with_claim(found, scale=f"1/({claim['scale']})") if "scale" in claim else found


def with_another_pair(rng: random.Random, tables: Tables) -> Tables | None:
    """One more degree of freedom, in which nothing happens."""
    claim, space = tables["claim"][0], tables.get("phase_space", {})
    scaled = "scale" in claim or claim["kind"] in (
        "volume",
        "new_hamiltonian",
        "integral_invariant",
        "cartan_invariant",
    )
    if claim["kind"] not in CANONICAL or {"tensor", "structure", "coordinates"} & {*claim} or scaled:
        return None
    if claim["kind"] == "lie_series" or "generating_function" in tables:
        return None
    z, pz = unused(tables, "z"), unused(tables, "pz")
    found = {**tables, "phase_space": {**space, "q": [*space["q"], z], "p": [*space["p"], pz]}}
    given = tables.get("transformation", {})
    if "Q" in space:
        if not given or len(space["Q"]) != len(space["q"]):
            return None
        Z, PZ = unused(found, "Z"), unused(found, "PZ")
        found["phase_space"] |= {"Q": [*space["Q"], Z], "P": [*space["P"], PZ]}
        ends = (
            {"Q": PZ and f"-{pz}", "P": z, "q": PZ, "p": f"-{Z}"}
            if claim["kind"] in MAPS
            else {"Q": z, "P": pz, "q": Z, "p": PZ}
        )
        found["transformation"] = {word: [*rows, ends[word]] for word, rows in given.items()}
    return found


def in_curved_coordinates(rng: random.Random, tables: Tables) -> Tables | None:
    """A coordinate replaced by a function that takes all values once, and its momentum with it."""
    claim = tables["claim"][0]
    backward = {"q", "p"} & {*tables.get("transformation", {})} or "generating_function" in tables
    if claim["kind"] not in CANONICAL or not is_canonical(tables) or backward or is_complex(tables):
        return None
    k = rng.randrange(len(tables["phase_space"]["q"]))
    q, p = tables["phase_space"]["q"][k], tables["phase_space"]["p"][k]
    V = unused(tables, "V")
    if words_of(tables, p) != ["real"] or words_of(tables, q) not in (["real"], ["positive"]):
        return None
    values = [(f"sinh({q})", f"{p}/cosh({q})"), (f"{q}+{q}**3", f"{p}/(1+3*{q}**2)"), (q, f"{p}+{q}**2"),
              (q, f"{p}+D({V}({q}),{q})"), (f"2*{q}+sin({q})", f"{p}/(2+cos({q}))")]  # fmt: skip
    if words_of(tables, q) == ["positive"]:
        values = [
            (f"{q}**2", f"{p}/(2*{q})"),
            (f"1/{q}", f"-{p}*{q}**2"),
            (f"sqrt({q})", f"2*{p}*sqrt({q})"),
            (q, f"{p}+log({q})"),
        ]
    new_q, new_p = rng.choice(values)
    tables = with_symbol(tables, V, "function") if V in new_p else tables
    return substituted(tables, {q: new_q, p: new_p})


def at_another_time(rng: random.Random, tables: Tables) -> Tables | None:
    """Time from another moment on."""
    space, kind = tables.get("phase_space", {}), tables["claim"][0]["kind"]
    t = space.get("time", "t")
    hidden = {name for word in "qpQP" for name in space.get(word, [])} | {
        *tables.get("symbols", {}),
        *tables.get("definitions", {}),
    }
    if kind not in (*CANONICAL, "equations_of_motion", "infinitesimal", "action_angle") or t in hidden - {
        space.get("time")
    }:
        return None
    c = unused(tables, "c")
    if t not in every_name(tables) or t in own_names(tables["claim"][0]):
        return None
    return substituted(with_symbol(tables, c, "real"), {t: rng.choice((f"{t}+{c}", f"{t}-3/2"))})
