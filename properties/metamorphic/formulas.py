"""The same claim with formulas written otherwise."""

from __future__ import annotations

import random

from canon.syntax import Call, Name, Node, Number, Power, Product, Sum, parse
from canon.vocabulary import CALLABLE, CONSTANTS
from properties.metamorphic.parts import CANONICAL, is_canonical, is_complex, outside_exponents, with_claim, with_symbol
from properties.metamorphic.tables import Tables, declared, in_nodes, mapped, shown, unused


def _functions(node: Node, real: bool) -> list[str]:
    """Other ways to write a node, wherever it is defined."""
    text = f"({shown(node)})"
    found = [f"-(-{text})", f"{text}*2/2", f"({text}+17/10-17/10)", f"{text}*(cos(1)**2+sin(1)**2)"]
    if isinstance(node, Power):
        base = f"({shown(node.base)})"
        if isinstance(node.exponent, Number) and node.exponent.value > 1 and node.exponent.value.denominator == 1:
            found += [f"{base}**{node.exponent.value - 1}*{base}"] * 3
        if shown(node.exponent) in ("1/2", "(1/2)"):
            found += [f"sqrt{base}"] * 3
        found.append(f"1/{base}**(-({shown(node.exponent)}))")
    if isinstance(node, Product):
        order = [*zip(node.factors, node.multiplied, strict=True)]
        found.append("*".join(f"({shown(f)})" if up else f"({shown(f)})**(-1)" for f, up in reversed(order)))
        found += [found[-1]] * 3
    if isinstance(node, Sum):
        order = [*zip(node.terms, node.added, strict=True)]
        found += ["+".join(f"({shown(f)})" if up else f"(-1)*({shown(f)})" for f, up in reversed(order))] * 3
    if isinstance(node, Call) and len(node.arguments) == 1:
        x = f"({shown(node.arguments[0])})"
        always = {
            "sin": (f"cos(pi/2-{x})", f"2*sin({x}/2)*cos({x}/2)", f"-sin(-{x})", f"sin({x}+2*pi)"),
            "cos": (f"sin(pi/2-{x})", f"(1-2*sin({x}/2)**2)", f"cos(-{x})", f"sin({x}+pi/2)"),
            "tan": (f"sin{x}/cos{x}", f"cot(pi/2-{x})"), "cot": (f"cos{x}/sin{x}",), "sec": (f"1/cos{x}",),
            "csc": (f"1/sin{x}",), "sqrt": (f"{x}**(1/2)", f"{x}**(1/4)*{x}**(1/4)"), "cbrt": (f"{x}**(1/3)",),
            "exp": (f"exp({x}/2)**2", f"1/exp(-{x})", f"(cosh{x}+sinh{x})", f"exp({x}-1)*exp(1)"),
            "sinh": (f"(exp{x}-exp(-{x}))/2", f"-sinh(-{x})"), "cosh": (f"(exp{x}+exp(-{x}))/2",),
            "tanh": (f"(exp{x}-exp(-{x}))/(exp{x}+exp(-{x}))", f"sinh{x}/cosh{x}"), "coth": (f"cosh{x}/sinh{x}",),
            "log": (f"2*log(sqrt{x})",), "atan": (f"-atan(-{x})",), "asin": (f"(pi/2-acos{x})", f"-asin(-{x})"),
            "acos": (f"(pi/2-asin{x})",), "gamma": (f"gamma({x}+1)/{x}",),
        }.get(node.name, ())  # fmt: skip
        only_real = {
            "atan": (f"asin({x}/sqrt(1+{x}**2))", f"2*atan({x}/(1+sqrt(1+{x}**2)))"),
            "abs": (f"sqrt({x}**2)", f"abs(-{x})"),
            "sign": (f"{x}/abs{x}",), "asinh": (f"log({x}+sqrt({x}**2+1))", f"-asinh(-{x})"),
            "log": (f"(log(3*{x})-log(3))", f"-log(1/{x})"),
            "acosh": (f"log({x}+sqrt({x}**2-1))",), "atanh": (f"log((1+{x})/(1-{x}))/2",),
            "acos": (f"2*atan(sqrt(1-{x})/sqrt(1+{x}))",),
            "asin": (f"atan({x}/sqrt(1-{x}**2))",), "sqrt": (f"exp(log{x}/2)", f"sqrt(3*{x})/sqrt(3)"),
        }.get(node.name, ()) if real else ()  # fmt: skip
        found += [*always, *only_real] * 3
    if isinstance(node, Call) and node.name == "atan2" and real:
        y, x = (f"({shown(part)})" for part in node.arguments)
        found += [f"-atan2(-{y},{x})", f"atan2(3*{y},3*{x})", f"2*atan({y}/(sqrt({x}**2+{y}**2)+{x}))"] * 3
    return found


def rewritten(rng: random.Random, tables: Tables) -> Tables | None:
    """A few parts of formulas written otherwise."""
    if tables["claim"][0]["kind"] == "dimension":
        return None
    shadowed = {*CALLABLE, *CONSTANTS} & declared(tables)
    real, share = not is_complex(tables), rng.choice((0.04, 0.1, 0.3))
    changed = False

    def told(node: Node) -> Node:
        nonlocal changed
        if isinstance(node, Number) and node.value in (0, 1):
            return node
        if rng.random() > (share if not isinstance(node, (Name, Number)) else share / 8):
            return node
        changed = True
        return parse(rng.choice(_functions(node, real)))

    def outer(text: str) -> str:
        return in_nodes(text, lambda node: outside_exponents(node, told))

    if shadowed:
        return None
    found = mapped(tables, outer)
    return found if changed else None


def multiplied(rng: random.Random, tables: Tables) -> Tables | None:
    """Both sides of an equation multiplied, or a term added to both; a claim's function times a number."""
    claim = tables["claim"][0]
    both = {"identity": ("lhs", "rhs"), "bracket": ("f", "equals"), "inequality": ("lhs", "rhs"), "conserved": ("f",),
            "integral": ("f", "equals"), "limit": ("f", "equals"), "jacobi": ("g",)}.get(claim["kind"])  # fmt: skip
    if both is None or any("infinity" in str(claim[word]) for word in both) or "antiderivative" in claim:
        return None
    factor = rng.choice(("2", "3/7", "1000", "10**(-6)", "22/7") + (() if claim["kind"] == "inequality" else ("-1",)))
    if claim["kind"] in ("identity", "inequality") and rng.random() < 0.4:
        return with_claim(tables, **{word: f"({claim[word]})+{factor}" for word in both})
    return with_claim(tables, **{word: f"{factor}*({claim[word]})" for word in both})


def with_another_hamiltonian(rng: random.Random, tables: Tables) -> Tables | None:
    """A constant added to H."""
    kinds = ("conserved", "equations_of_motion", "new_hamiltonian", "symmetry", "action_angle", "cartan_invariant")
    if tables["claim"][0]["kind"] not in kinds or "hamiltonian" not in tables:
        return None
    c = unused(tables, "c")
    some = rng.choice(("7/3", "-2", f"{c}**2+{c}"))
    tables = with_symbol(tables, c, "real") if c in some else tables
    return {**tables, "hamiltonian": {"H": f"{some}+({tables['hamiltonian']['H']})"}}


def by_derivatives(rng: random.Random, tables: Tables) -> Tables | None:
    """Parts of formulas of the old variables as derivatives and brackets."""
    kind, space = tables["claim"][0]["kind"], tables.get("phase_space", {})
    if kind not in (*CANONICAL, "equations_of_motion", "infinitesimal") or not is_canonical(tables) or not space:
        return None
    if {"Q"} & {*space} or {"D", "bracket"} & declared(tables) or "on" in tables.get("domain", {}):
        return None
    x = rng.choice([*space["q"], *space["p"]])
    k = rng.randrange(len(space["q"]))
    q, p = space["q"][k], space["p"][k]
    share, changed = rng.choice((0.05, 0.15)), False

    def told(node: Node) -> Node:
        nonlocal changed
        text = shown(node)
        if isinstance(node, Number) and (node.value != 1 or node.imaginary):
            return node
        if rng.random() > share:
            return node
        changed = True
        if isinstance(node, Number):
            return parse(rng.choice((f"D({x},{x})", f"bracket({q},{p})", f"-bracket({p},{q})", f"D({x}**2,{x},2)/2")))
        once, again = f"D({x}*({text}),{x})-{x}*D({text},{x})", f"bracket({q},{p}*({text}))-{p}*bracket({q},{text})"
        twice = f"D(({text})*{x}**2,{x},2)/2-2*{x}*D({text},{x})-{x}**2*D({text},{x},2)/2"
        return parse(rng.choice((once, again, twice)))

    body = {word: value for word, value in tables.items() if word != "domain"}
    found = mapped(body, lambda text: in_nodes(text, lambda node: outside_exponents(node, told)))
    return {**found, **({"domain": tables["domain"]} if "domain" in tables else {})} if changed else None
