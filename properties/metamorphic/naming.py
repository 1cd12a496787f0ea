"""The same claim with other names, in another order, with more or fewer abbreviations."""

from __future__ import annotations

import random
from typing import Final

from canon.syntax import Call, Name, Node
from properties.metamorphic.parts import (
    is_complex,
    named,
    nodes,
    parameters,
    substituted,
    variables,
    with_symbol,
    words_of,
)
from properties.metamorphic.tables import (
    Tables,
    declared,
    every_name,
    in_names,
    mapped,
    own_names,
    unused,
    walk,
)

ODD: Final = (
    "e", "i", "j", "I", "E", "S", "N", "O", "Q", "C", "beta", "gamma", "lambda", "zeta", "Q1", "P1", "g1", "x0",
    "t0", "t", "k", "m", "n", "x", "y", "z", "a", "b", "s", "u", "w", "q", "p", "tau", "dt", "D1", "V", "W",
    "pi", "sign", "abs", "exp", "sqrt", "bracket", "D", "None", "True", "class", "in", "is", "and", "not", "nan",
    "oo", "zoo", "Symbol", "_", "__", "_x", "x_", "t_", "x1", "x10", "x2", "X", "α", "ħ", "λ", "Δ", "lambertw",
    "elliptic_k", "test", "self", "L", "M", "T", "H", "K", "F", "G", "J", "scale", "time", "eps", "real",
    "positive", "function", "c0", "c1", "y0", "w0", "dummy", "r", "pr",
)  # fmt: skip
"""Names that something inside might have for its own."""


def renamed(rng: random.Random, tables: Tables) -> Tables | None:
    """Names called otherwise, by what something inside may be called."""
    names, used = declared(tables), every_name(tables)
    space = tables.get("phase_space", {})
    if "phase_space" in tables and "time" not in space:
        own = {n for word in "qpQP" for n in space.get(word, [])} | {*tables.get("definitions", {})}
        if "t" not in own | own_names(tables["claim"][0]) and "function" not in words_of(tables, "t"):
            tables = {**tables, "phase_space": {**space, "time": "t"}}
    free = [name for name in ODD if name not in used | names | {"t"}]
    old = sorted(names & (used | {"t"}))
    rng.shuffle(free)
    rng.shuffle(old)
    if rng.random() < 0.3:  # among each other
        new = dict(zip(old, [*old[1:], *old[:1]], strict=True))
    else:
        new = dict(zip(old[: rng.randint(1, 12)], free, strict=False))
    if "phase_space" not in tables or "time" not in tables["phase_space"]:
        new = {a: b for a, b in new.items() if "t" not in (a, b)} if "t" in old else new
        if len({new.get(name, name) for name in old}) < len(old):
            return None

    def name(word: str) -> str:
        return new.get(word, word)

    return mapped(tables, lambda text: in_names(text, name), name)


def reordered(rng: random.Random, tables: Tables) -> Tables | None:
    """Degrees of freedom, lists whose order says nothing, symbols, conditions in another order."""
    claim, space = dict(tables["claim"][0]), dict(tables.get("phase_space", {}))
    n = len(space.get("q", []))
    order = rng.sample(range(n), n)
    vectors = ("dq", "dp", "qdot", "pdot", "velocities", "accelerations", "equations", "qddot", "forces", "possible",
               "virtual", "path")  # fmt: skip
    found = dict(tables)
    if claim["kind"] not in ("solves", "field_equations") and "field" not in claim:
        for word in ("q", "p"):
            space[word] = [space[word][k] for k in order] if word in space else []
        for word in vectors:
            if isinstance(claim.get(word), list) and len(claim[word]) == n:
                claim[word] = [claim[word][k] for k in order]
        given = dict(tables.get("transformation", {}))
        square = len(space.get("Q", [])) == n
        if square:
            space |= {word: [space[word][k] for k in order] for word in "QP"}
            given |= {word: [given[word][k] for k in order] for word in "qpQP" if word in given}
            if given:
                found["transformation"] = given
        else:
            given |= {word: [given[word][k] for k in order] for word in "qp" if word in given}
        for holder in (section := dict(tables.get("generating_function", {})), claim):
            if isinstance(holder.get("type"), list):
                holder["type"] = [holder["type"][k] for k in order]
        if section:
            found["generating_function"] = section
        if n:
            found["phase_space"] = space
    for word in ("functions",):
        if isinstance(claim.get(word), list) and claim["kind"] in ("involution", "independent", "dimension"):
            claim[word] = rng.sample(claim[word], len(claim[word]))
    if "domain" in tables:
        found["domain"] = {word: rng.sample(value, len(value)) for word, value in tables["domain"].items()}
    if "symbols" in tables:
        found["symbols"] = dict(rng.sample([*tables["symbols"].items()], len(tables["symbols"])))
    found["claim"] = [dict(rng.sample([*claim.items()], len(claim)))]
    return found


def abbreviated(rng: random.Random, tables: Tables) -> Tables | None:
    """A part of a formula, or a number, becomes a definition."""
    closed = variables(tables) if rng.random() < 0.2 else set[str]()
    taken = own_names(tables["claim"][0]) | closed
    definitions = tables.get("definitions", {})

    def wanted(node: Node) -> bool:
        names = {part.name for part in walk(node) if isinstance(part, Name)}
        calls = {part.name for part in walk(node) if isinstance(part, Call)}
        return not isinstance(node, Name) and not (names | calls) & taken and "bracket" not in calls

    body = {word: value for word, value in tables.items() if word != "definitions"}
    texts = nodes(body, wanted)
    if not texts:
        return None
    text, name = rng.choice(texts), unused(tables, rng.choice(("d", "w", "u1", "aux", "E", "N")))
    found = named(body, text, name)
    return {**found, "definitions": {**definitions, name: text}}


def written_out(rng: random.Random, tables: Tables) -> Tables | None:
    """A definition put in wherever it is used."""
    definitions = dict(tables.get("definitions", {}))
    if not definitions:
        return None
    name = rng.choice([*definitions])
    text = str(definitions.pop(name))
    return substituted({**tables, "definitions": definitions}, {name: text})


def with_more(rng: random.Random, tables: Tables) -> Tables | None:
    """Names that nothing uses, and conditions that hold anyway."""
    kind = tables["claim"][0]["kind"]
    new = unused(tables, rng.choice(("c", "a", "V", "z")))
    choice = rng.randrange(4)
    if choice == 0:
        return with_symbol(tables, new, rng.choice(("real", "positive", "complex", "integer", "function", "nonzero")))
    if choice == 1 and "phase_space" in tables:
        some = rng.choice(sorted({name for word in "qp" for name in tables["phase_space"][word]}))
        return {**tables, "definitions": {**tables.get("definitions", {}), new: f"sin({some})**2/{some}"}}
    conditions = [f"{name} > 0" for name in parameters(tables, "positive")]
    conditions += [f"-1 < tanh({name}) < 1" for name in parameters(tables, "positive", "real")]
    conditions += [f"exp({name}) > {name}" for name in parameters(tables, "positive", "real")]
    conditions += [f"{name}**2 + 1 > 0" for name in sorted(variables(tables))]
    conditions += [f"sin({name}) < 2" for name in sorted(variables(tables))]
    if not conditions or "phase_space" not in tables or is_complex(tables) or kind in ("dimension", "average"):
        return None
    domain = tables.get("domain", {})
    more = [*domain.get("where", []), rng.choice(conditions)]
    return {**tables, "domain": {**domain, "where": rng.sample(more, len(more))}}
