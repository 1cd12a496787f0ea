"""What a claim implies by itself: at values of its names, in a part of its domain; and what it follows from."""

from __future__ import annotations

import random
from typing import Any

from canon.syntax import Call, Name, Node, Number, parse
from properties.metamorphic.parts import (
    differentiated,
    is_complex,
    outside_exponents,
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
    in_nodes,
    mapped,
    own_names,
    replaced,
    shown,
    unused,
)

WHOLE = (
    "action", "frequency", "average", "action_angle", "algebra", "independent", "canonical_when", "legendre",
    "hamilton_jacobi", "euler_lagrange", "generates", "generating_function",
)  # fmt: skip
"""Kinds that speak of a domain, or of orbits in it, as a whole: in a larger one they may become true, as a determinant
that is 0 on one half of it isn't 0 on the other."""


def at_a_number(rng: random.Random, tables: Tables) -> Tables | None:
    """A parameter given a value."""
    choices = parameters(tables, "positive", "real", "nonzero", "negative", "nonnegative")
    if not choices or tables["claim"][0]["kind"] in ("dimension", "canonical_when"):
        return None
    name = rng.choice(choices)
    word = words_of(tables, name)[0]
    value = rng.choice(("1", "2", "3/2", "1/3", "7", "22/7", "1/100", "10"))
    if word == "negative" or (word in ("real", "nonzero") and rng.random() < 0.4):
        value = f"-{value}"
    if word in ("real", "nonnegative") and rng.random() < 0.15:
        value = "0"
    found = substituted(tables, {name: value})
    return found and {**found, "symbols": {n: w for n, w in found["symbols"].items() if n != name}}


def with_a_condition(rng: random.Random, tables: Tables) -> Tables | None:
    """A smaller domain."""
    if tables["claim"][0]["kind"] in (
        "action",
        "frequency",
        "average",
        "action_angle",
        "dimension",
        "integral",
        "limit",
        "stationary",
    ):
        return None
    names = sorted(variables(tables)) + 2 * parameters(tables, "positive", "real", "nonzero")
    if "phase_space" not in tables or not names or is_complex(tables):
        return None
    name = rng.choice(names)
    condition = rng.choice(
        (f"{name} > 0", f"{name} > 1/2", f"{name} < 1", f"{name} > 2", f"0 < {name} < 1/10", f"{name}**2 < 3")
    )
    domain = tables.get("domain", {})
    return {**tables, "domain": {**domain, "where": [*domain.get("where", []), condition]}}


def with_a_stronger_word(rng: random.Random, tables: Tables) -> Tables | None:
    """A parameter that is known to be more."""
    stronger = {"real": ("positive", "negative", "integer", "nonzero"), "positive": (["positive", "integer"],),
                "nonzero": ("positive", "negative"), "complex": ("real", "positive", "nonzero"),
                "nonnegative": ("positive",)}  # fmt: skip
    choices = parameters(tables, *stronger)
    if not choices:
        return None
    name = rng.choice(choices)
    return with_symbol(tables, name, rng.choice(stronger[words_of(tables, name)[0]]))


def with_a_function(rng: random.Random, tables: Tables) -> Tables | None:
    """An unknown function of one argument, or of several, that becomes known."""
    symbols = tables.get("symbols", {})
    functions = [name for name in symbols if words_of(tables, name) in (["function"], ["function", "positive"])]
    functions = [name for name in functions if name not in own_names(tables["claim"][0])]
    if not functions or tables["claim"][0]["kind"] in ("dimension", "field_equations", "solves"):
        return None
    name = rng.choice(functions)
    head, outer = rng.choice(("sin", "exp", "cos", "atan", "tanh", "", "2-1/3*")), rng.choice(("exp", "3*", "-1/2+"))
    outer = "exp" if "positive" in words_of(tables, name) else outer

    def told(node: Node) -> Node:
        if isinstance(node, Call) and node.name == name:
            inner = "+".join(f"({shown(part)})*{k}" for k, part in enumerate(node.arguments, 1))
            return parse(f"({outer}({head}({inner})))")
        return node

    found = mapped(tables, lambda text: in_nodes(text, lambda node: replaced(node, told)))
    if name in every_name({**found, "symbols": {}}):
        return None
    return {**found, "symbols": {n: w for n, w in found["symbols"].items() if n != name}}


def identified(rng: random.Random, tables: Tables) -> Tables | None:
    """A parameter that is another one, or an admissible function of another one."""
    held = differentiated(tables)
    choices = [name for name in parameters(tables, "positive", "real", "nonzero") if name not in held]
    if not choices or tables["claim"][0]["kind"] in ("dimension", "canonical_when"):
        return None
    name = rng.choice(choices)
    word, b = words_of(tables, name)[0], unused(tables, "b")
    same = [other for other in parameters(tables, word) if other not in {name, *held}]
    new = rng.choice(same) if same else None
    if new is None or rng.random() < 0.4:
        new, tables = b, with_symbol(tables, b, word)
        values = {"positive": ("1/(1+{}**2)", "2+sin({})", "exp(-{})", "{}**2+{}"),
                  "nonzero": ("{}**3", "2+{}**2", "exp({})"),
                  "real": ("sin({})", "{}**2", "-abs({})-1", "{}**3-{}", "tanh({})")}[word]  # fmt: skip
    else:
        values = {
            "positive": ("{}", "{}", "2*{}", "1/{}", "{}**2"),
            "nonzero": ("{}", "-{}", "1/{}"),
            "real": ("{}", "-{}", "{}+1", "2*{}"),
        }[word]
    text = rng.choice(values)
    found = substituted(tables, {name: text.format(*[new] * text.count("{}"))})
    return found and {**found, "symbols": {n: w for n, w in found["symbols"].items() if n != name}}


def on_a_surface(rng: random.Random, tables: Tables) -> Tables | None:
    """The claim on a surface alone."""
    kind, space = tables["claim"][0]["kind"], tables.get("phase_space", {})
    kinds = (
        "identity",
        "inequality",
        "bracket",
        "conserved",
        "involution",
        "jacobi",
        "canonical",
        "fundamental_brackets",
    )
    if kind not in kinds or not space or is_complex(tables) or "order" in tables["claim"][0]:
        return None
    names = [*space["q"], *space["p"]]
    if "q" in tables.get("transformation", {}) or "generating_function" in tables:
        return None
    names += parameters(tables, "real", "positive")
    x, y = rng.sample(names, 2)
    text = rng.choice(
        (
            f"{x}-1",
            f"{x}-{y}-1",
            f"{x}**2+{y}**2-2",
            f"{x}*{y}-2",
            f"{x}**2-{y}-1",
            f"{x}**2-3",
            f"2*{x}-3*{y}-5",
            f"{x}**3-2",
        )
    )
    domain = tables.get("domain", {})
    return {**tables, "domain": {**domain, "on": [*domain.get("on", []), text]}}


def at_an_integer(rng: random.Random, tables: Tables) -> Tables | None:
    """An integer parameter given a value."""
    if "phase_space" not in tables or tables["claim"][0]["kind"] in ("canonical_when", "dimension"):
        return None
    names = [
        n
        for n in tables.get("symbols", {})
        if "integer" in words_of(tables, n) and n not in own_names(tables["claim"][0])
    ]
    if not names:
        return None
    name = rng.choice(names)
    words = words_of(tables, name)
    value = rng.choice((1, 2, 3, 5, 4)) * (-1 if "negative" in words else 1)
    if not {"positive", "negative", "nonnegative"} & {*words}:
        value *= rng.choice((1, -1))
    value = 0 if not {"positive", "negative", "nonzero"} & {*words} and rng.random() < 0.2 else value
    found = substituted(tables, {name: str(value)})
    return found and {**found, "symbols": {n: w for n, w in found["symbols"].items() if n != name}}


def without_a_condition(rng: random.Random, tables: Tables) -> Tables | None:
    """A larger domain: a condition less, or a word that says less."""
    if tables["claim"][0]["kind"] in WHOLE:
        return None
    weaker = {
        "positive": ("real", "nonzero", "nonnegative"),
        "nonzero": ("real",),
        "negative": ("real", "nonzero"),
        "nonnegative": ("real",),
    }
    choices = parameters(tables, *weaker)
    where = tables.get("domain", {}).get("where", [])
    if where and (not choices or rng.random() < 0.6):
        k = rng.randrange(len(where))
        return {**tables, "domain": {**tables["domain"], "where": where[:k] + where[k + 1 :]}}
    if not choices:
        return None
    name = rng.choice(choices)
    return with_symbol(tables, name, rng.choice(weaker[words_of(tables, name)[0]]))


def _one_changed(rng: random.Random, tables: Tables, wanted: Any, new: Any) -> Tables | None:
    """The file with one node replaced, outside of exponents, conditions and definitions."""
    kept = {word: tables[word] for word in ("domain", "definitions") if word in tables}
    body = {word: value for word, value in tables.items() if word not in kept}
    count = 0

    def counted(node: Node) -> Node:
        nonlocal count
        count += bool(wanted(node))
        return node

    mapped(body, lambda text: in_nodes(text, lambda node: outside_exponents(node, counted)))
    if not count:
        return None
    place, seen = rng.randrange(count), -1

    def told(node: Node) -> Node:
        nonlocal seen
        if not wanted(node):
            return node
        seen += 1
        return new(node) if seen == place else node

    found = mapped(body, lambda text: in_nodes(text, lambda node: outside_exponents(node, told)))
    return {**found, **kept}


def with_a_free_number(rng: random.Random, tables: Tables) -> Tables | None:
    """A number that becomes a parameter."""
    c = unused(tables, "c")
    found = _one_changed(
        rng, tables, lambda node: isinstance(node, Number) and not node.imaginary and node.value > 0,
        lambda node: Name(node.span, c),
    )  # fmt: skip
    return found and with_symbol(found, c, rng.choice(("positive", "real", "nonzero")))


def with_a_free_function(rng: random.Random, tables: Tables) -> Tables | None:
    """A known function that becomes unknown."""
    heads: dict[str, Any] = dict.fromkeys(("sin", "cos", "tanh", "atan", "sinh"), "function")
    heads |= {head: ["function", "positive"] for head in ("exp", "cosh")}
    if {*heads} & declared(tables) or is_complex(tables):
        return None
    head = rng.choice([*heads])
    V = unused(tables, "V")
    body = {word: value for word, value in tables.items() if word != "domain"}

    def told(node: Node) -> Node:
        return Call(node.span, V, node.arguments) if isinstance(node, Call) and node.name == head else node

    found = mapped(body, lambda text: in_nodes(text, lambda node: replaced(node, told)))
    if V not in every_name({**found, "symbols": {}}):
        return None
    return with_symbol({**found, **({"domain": tables["domain"]} if "domain" in tables else {})}, V, heads[head])


def with_a_free_name(rng: random.Random, tables: Tables) -> Tables | None:
    """A parameter that is another one at one of its places."""
    held = differentiated(tables)
    choices = [name for name in parameters(tables, "positive", "real", "nonzero") if name not in held]
    if not choices:
        return None
    name, c = rng.choice(choices), unused(tables, "c")
    found = _one_changed(
        rng, tables, lambda node: isinstance(node, Name) and node.name == name, lambda node: Name(node.span, c)
    )
    return found and with_symbol(found, c, tables["symbols"][name])
