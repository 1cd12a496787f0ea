"""The same claim with unknown functions, complex names, integers and surfaces stated otherwise."""

from __future__ import annotations

import random

from canon.syntax import Call, Node, parse
from properties.metamorphic.parts import (
    is_complex,
    parameters,
    substituted,
    variables,
    with_claim,
    with_symbol,
    words_of,
)
from properties.metamorphic.tables import Tables, every_name, in_nodes, mapped, own_names, replaced, shown, unused

ALONE = ("dimension", "canonical_when", "solves", "field_equations")
"""Kinds that name functions or parameters themselves."""


def with_other_functions(rng: random.Random, tables: Tables) -> Tables | None:
    """An unknown function that is made of another one, so that it may be any."""
    known = {
        "function": ("2*{}+3", "{}**3+{}", "sinh({})", "-{}", "{}-7"), "positive": ("exp({})", "1/{}", "3*{}", "{}**2"),
        "nonzero": ("1/{}", "-2*{}", "{}**3"), "negative": ("-exp({})", "1/{}", "-1/({}**2)"),
    }  # fmt: skip
    names = [name for name in tables.get("symbols", {}) if "function" in words_of(tables, name)]
    names = [name for name in names if name not in own_names(tables["claim"][0])]
    if not names or tables["claim"][0]["kind"] in ALONE:
        return None
    name = rng.choice(names)
    word = next((word for word in words_of(tables, name) if word in ("positive", "negative", "nonzero")), "function")
    form = rng.choice(known[word])
    inner = rng.choice(("{}", "{}", "2*({})", "({})**3+({})", "sinh({})"))
    turned, new = rng.random() < 0.5, unused(tables, rng.choice("UWg"))

    def told(node: Node) -> Node:
        if not isinstance(node, Call) or node.name != name:
            return node
        first, *rest = map(shown, node.arguments)
        parts = [inner.format(*[first] * inner.count("{}")), *rest]
        call = f"{new}({', '.join(reversed(parts) if turned else parts)})"
        return parse(f"({form.format(*[call] * form.count('{}'))})")

    found = mapped(tables, lambda text: in_nodes(text, lambda node: replaced(node, told)))
    if name in every_name({**found, "symbols": {}}):
        return None
    left = {n: w for n, w in found["symbols"].items() if n != name}
    free = word == "function" or form in ("exp({})", "-exp({})")
    return {**found, "symbols": {**left, new: "function" if free else ["function", word]}}


def as_real_and_imaginary(rng: random.Random, tables: Tables) -> Tables | None:
    """A complex parameter by its two parts, or by another one."""
    names = [name for name in tables.get("symbols", {}) if words_of(tables, name) == ["complex"]]
    names = [name for name in names if name not in {*variables(tables), *own_names(tables["claim"][0])}]
    if not names or tables["claim"][0]["kind"] in ALONE:
        return None
    name = rng.choice(names)
    a, b = unused(tables, "re"), unused(tables, "im")
    if rng.random() < 0.5:
        return substituted(tables, {name: rng.choice((f"1j*{name}", f"{name}+1-2j", f"-{name}/3", f"{name}*(1+1j)"))})
    found = with_symbol(with_symbol(tables, a, "real"), b, "real")
    found = substituted(found, {name: f"{a}+1j*{b}"})
    return found and {**found, "symbols": {n: w for n, w in found["symbols"].items() if n != name}}


def with_other_integers(rng: random.Random, tables: Tables) -> Tables | None:
    """An integer that is another one and a number, or a sum."""
    names = [name for name in tables.get("symbols", {}) if words_of(tables, name) == ["integer"]]
    names = [name for name in names if name not in own_names(tables["claim"][0])]
    if not names or tables["claim"][0]["kind"] in ALONE:
        return None
    name, m = rng.choice(names), unused(tables, "m")
    text = rng.choice((f"{name}+1", f"-{name}", f"{name}-2", f"{name}+{m}", f"{m}-{name}"))
    return substituted(with_symbol(tables, m, "integer") if m in text else tables, {name: text})


def by_another_equation(rng: random.Random, tables: Tables) -> Tables | None:
    """The same surface by another equation."""
    on = list(tables.get("domain", {}).get("on", ()))
    if not on or "phase_space" not in tables or is_complex(tables):
        return None
    x = rng.choice(tables["phase_space"]["q"])
    k = rng.randrange(len(on))
    f = f"({on[k]})"
    new = rng.choice(
        (f"2*{f}", f"-{f}", f"{f}*(1+{x}**2)", f"{f}*(2+sin({x}))", f"{f}*exp({x})", f"{f}**3", f"{f}**2", f"sinh({f})")
    )
    if len(on) == 2 and rng.random() < 0.4:
        on = rng.choice(
            ([f"({on[0]})+({on[1]})", f"({on[0]})-({on[1]})"], [f"({on[0]})+3*({on[1]})", on[1]], [on[1], on[0]])
        )
    else:
        on[k] = new
    return {**tables, "domain": {**tables["domain"], "on": on}}


def with_a_hole(rng: random.Random, tables: Tables) -> Tables | None:
    """A claim where a formula has no value in places: it says less."""
    claim = tables["claim"][0]
    key = {"identity": "lhs", "bracket": "f", "conserved": "f", "jacobi": "g", "inequality": "lhs"}.get(claim["kind"])
    if key is None or {"tensor", "structure", "coordinates"} & {*claim} or is_complex(tables):
        return None
    if "q" in tables.get("transformation", {}) or "generating_function" in tables:
        return None
    space = tables["phase_space"]
    x = rng.choice([*space["q"], *space["p"], *parameters(tables, "real", "positive")])
    hole = rng.choice((f"0/({x}-1)", f"0*sqrt({x})", f"0*log({x}+3)", f"0*asin({x}/2)", f"0*tan({x})", f"0*abs({x}-2)",
                       f"0*sqrt(4-{x}**2)", f"0*atan2({x},{x}-1)", f"0*sign({x})", f"0*gamma({x})"))  # fmt: skip
    return with_claim(tables, **{key: f"({claim[key]})+{hole}"})
