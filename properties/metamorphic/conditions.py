"""The same claim with conditions and parameters stated otherwise."""

from __future__ import annotations

import random

from canon.syntax import Call, Name, Node, parse_relation
from properties.metamorphic.parts import (
    CANONICAL,
    differentiated,
    is_canonical,
    is_complex,
    named,
    names_in,
    nodes,
    parameters,
    substituted,
    with_claim,
    with_symbol,
    words_of,
)
from properties.metamorphic.tables import Tables, shown, unused, walk


def by_conditions(rng: random.Random, tables: Tables) -> Tables | None:
    """Conditions of the domain written otherwise."""
    where, found = list(tables.get("domain", {}).get("where", [])), list[list[str]]()
    for k, text in enumerate(where):
        sides, signs = parse_relation(text)
        if len(signs) == 2:
            a, b, c = map(shown, sides)
            found.append([f"{a} {signs[0]} {b}", f"{b} {signs[1]} {c}"])
            if signs == ("<", "<"):
                found.append([f"(({b})-({a}))*(({c})-({b})) > 0", f"({a}) < ({c})"])
        if len(signs) == 1 and signs[0] in ("<", ">") and not is_complex(tables):
            a, b = f"({shown(sides[0])})", f"({shown(sides[1])})"
            r = signs[0]
            found += [
                [f"{a}-{b} {r} 0"],
                [f"exp({a}) {r} exp({b})"],
                [f"({a}-{b})**3 {r} 0"],
                [f"{b} {'<' if r == '>' else '>'} {a}"],
            ]
            found += [
                [f"1/({a}-{b}) {r} 0"],
                [f"sign({a}-{b}) {r} 0"],
                [f"atan({a}) {r} atan({b})"],
                [f"2*{a} {r} 2*{b}"],
            ]
        if len(signs) == 1 and signs[0] == "!=":
            a, b = f"({shown(sides[0])})", f"({shown(sides[1])})"
            found += [[f"({a}-{b})**2 > 0"], [f"abs({a}-{b}) > 0"]]
        if found:
            new = rng.choice(found)
            return {**tables, "domain": {**tables["domain"], "where": [*where[:k], *new, *where[k + 1 :]]}}
    return None


def by_a_word(rng: random.Random, tables: Tables) -> Tables | None:
    """What a word says of a name, said by a condition, by a sum or by a square."""
    choices = parameters(tables, "positive", "negative", "nonzero", "nonnegative")
    if not choices or "phase_space" not in tables or is_complex(tables):
        return None
    if tables["claim"][0]["kind"] in ("dimension", "canonical_when"):
        return None
    name = rng.choice(choices)
    word = words_of(tables, name)[0]
    domain = tables.get("domain", {})
    b, c = unused(tables, "b"), unused(with_symbol(tables, "b", ""), "c")
    choice = rng.randrange(4)
    if choice == 0 and word != "nonnegative":
        condition = {"positive": f"{name} > 0", "negative": f"{name} < 0", "nonzero": f"{name} != 0"}[word]
        found = {**tables, "domain": {**domain, "where": [*domain.get("where", []), condition]}}
        return with_symbol(found, name, "real")
    if choice == 1 and word in ("positive", "nonzero"):
        condition = f"{b} > {c}" if word == "positive" else f"{b} != {c}"
        found = with_symbol(with_symbol(tables, b, "real"), c, "real")
        found = {**found, "domain": {**domain, "where": [*domain.get("where", []), condition]}}
        return substituted(found, {name: f"{b}-{c}"})
    if choice == 2 and word == "positive":
        return substituted(
            with_symbol(tables, b, "nonzero"),
            {name: rng.choice((f"{b}**2", f"abs({b})", f"sqrt({b}**2)", f"1/{b}**2"))},
        )
    if choice == 3 and word == "positive":
        return substituted(
            with_symbol(tables, b, "negative"),
            {name: rng.choice((f"-{b}", f"{b}**2", f"-1/{b}"))},
        )
    return None


def by_a_domain(rng: random.Random, tables: Tables) -> Tables | None:
    """A condition a > b that a formula states: + 0*sqrt(a - b)."""
    where, claim = list(tables.get("domain", {}).get("where", [])), tables["claim"][0]
    key = {"identity": "lhs", "bracket": "equals", "inequality": "lhs"}.get(claim["kind"])
    for k, text in enumerate(where):
        sides, signs = parse_relation(text)
        if key and len(signs) == 1 and signs[0] in ("<", ">") and not is_complex(tables):
            a, b = (shown(side) for side in (sides if signs[0] == ">" else sides[::-1]))
            new = rng.choice((f"0*log(({a})-({b}))", f"0*sqrt(({a})-({b}))", f"log(({a})-({b}))-log(({a})-({b}))"))
            rest = {**tables["domain"], "where": where[:k] + where[k + 1 :]}
            return with_claim({**tables, "domain": rest}, **{key: f"({claim[key]})+{new}"})
    return None


def by_a_surface(rng: random.Random, tables: Tables) -> Tables | None:
    """A part that consists of parameters gets a name, by an equation of the domain."""
    free = {*parameters(tables, "positive", "real", "nonzero")}
    kind = tables["claim"][0]["kind"]
    if (
        "phase_space" not in tables
        or kind not in (*CANONICAL, "equations_of_motion", "infinitesimal")
        or is_complex(tables)
    ):
        return None
    if kind in ("independent", "canonical_when", "lie_series") or not is_canonical(tables):
        return None

    free -= differentiated(tables)

    def wanted(node: Node) -> bool:
        names = {part.name for part in walk(node) if isinstance(part, Name)}
        return (
            bool(names)
            and names <= free
            and not isinstance(node, Name)
            and not any(isinstance(p, Call) for p in walk(node))
        )

    body = {word: value for word, value in tables.items() if word != "domain"}
    texts = nodes(body, wanted)
    if not texts:
        return None
    text, name = rng.choice(texts), unused(tables, rng.choice("wuc"))
    found = named(body, text, name)
    domain = tables.get("domain", {})
    found["domain"] = {**domain, "on": [*domain.get("on", []), f"{name}-({text})"]}
    return with_symbol(found, name, "real")


def with_other_parameters(rng: random.Random, tables: Tables) -> Tables | None:
    """A parameter replaced by a function that takes exactly its values."""
    if tables["claim"][0]["kind"] in ("dimension", "canonical_when"):
        return None
    choices = parameters(tables, "positive", "real", "nonzero", "negative")
    if not choices:
        return None
    name = rng.choice(choices)
    word, b = words_of(tables, name)[0], unused(tables, rng.choice("bce"))
    values = {
        "positive": (
            f"{name}**2",
            f"1/{name}",
            f"2*{name}",
            f"{name}/{b}",
            f"{name}*{b}",
            f"{name}+{b}",
            f"sqrt({name})",
        ),
        "real": (f"{name}+1", f"2*{name}", f"-{name}", f"{name}+{b}", f"{name}-1/{b}", f"log({b})", f"{name}*{b}"),
        "nonzero": (f"1/{name}", f"-{name}", f"{name}/{b}"),
        "negative": (f"-{b}", f"-{b}**2", f"1/{name}", f"{name}*{b}"),
    }[word]
    text = rng.choice(values)
    if word == "positive" and rng.random() < 0.2:
        text, tables = f"exp({name})", with_symbol(tables, name, "real")
    if b in names_in(text):
        tables = with_symbol(tables, b, "positive")
    if rng.random() < 0.25:  # by a definition
        c = unused(with_symbol(tables, b, "positive"), "a")
        found = substituted(tables, {name: c})
        return found and {**found, "definitions": {c: text, **found.get("definitions", {})}}
    return substituted(tables, {name: text})


def by_a_function(rng: random.Random, tables: Tables) -> Tables | None:
    """A parameter that is the value of an unknown function at a number."""
    choices = parameters(tables, "positive", "real", "nonzero", "negative")
    if not choices or tables["claim"][0]["kind"] in ("dimension", "canonical_when", "solves", "field_equations"):
        return None
    name = rng.choice(choices)
    word, new = words_of(tables, name)[0], unused(tables, rng.choice("fgA"))
    found = with_symbol(tables, new, "function" if word == "real" else ["function", word])
    return substituted(found, {name: f"{new}({rng.choice(('0', '1', '5/7', '-1/3'))})"})
