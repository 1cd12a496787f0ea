"""What claims of dynamics and analysis say, as identities, and what denies them."""

from __future__ import annotations

import random
from typing import Any

from properties.metamorphic.analysis import put
from properties.metamorphic.parts import (
    called_in,
    is_complex,
    names_in,
    parameters,
    variables,
    with_claim,
    with_claim_of,
    with_symbol,
    words_of,
)
from properties.metamorphic.tables import Tables, every_name


def as_an_equation(rng: random.Random, tables: Tables) -> Tables | None:
    """An identity, or a claim of another kind, that a true claim of dynamics or analysis implies."""
    claim, space = tables["claim"][0], tables.get("phase_space", {})
    kind, domain = claim["kind"], tables.get("domain", {})
    plain = not {"D", "bracket"} & every_name(tables) and "on" not in domain and not is_complex(tables)
    t = space.get("time", "t")
    defined = {name for text in tables.get("definitions", {}).values() for name in names_in(str(text))}
    plain = plain and not defined & {*space.get("p", ()), *space.get("q", ())}
    H = str(tables.get("hamiltonian", {}).get("H", ""))
    if kind == "action" and "fixed" not in claim and plain:
        new = {**claim, "kind": "frequency", "equals": f"1/D({claim['equals']},{claim['energy']})"}
        return {**tables, "claim": [new]}
    told = {name for text in domain.get("where", ()) for name in names_in(str(text))}
    free = all(words_of(tables, p) == ["real"] and p not in told for p in space.get("p", ()))
    if kind == "hamilton_jacobi" and plain and free and not variables(tables) & {*claim["constants"]}:
        for name in (*claim["constants"], *([claim["energy"]] if str(claim.get("energy", "")).isidentifier() else ())):
            if name not in tables.get("symbols", {}) and name not in tables.get("definitions", {}):
                tables = with_symbol(tables, name, "real")
        S = claim.get("S", claim.get("W"))
        energy = put(H, {p: f"D({S},{q})" for q, p in zip(space["q"], space["p"], strict=True)})
        rhs = f"-D({S},{t})" if "S" in claim else str(claim["energy"])
        return with_claim_of(tables, kind="identity", lhs=energy, rhs=rhs)
    if kind == "legendre" and plain and free:
        L, v = claim["L"], claim["velocities"]
        for name in v:
            tables = with_symbol(tables, name, tables.get("symbols", {}).get(name, "real"))
        slopes = [f"D({L},{name})" for name in v]
        lhs = put(H, dict(zip(space["p"], slopes, strict=True)))
        rhs = "+".join(f"{name}*({slope})" for name, slope in zip(v, slopes, strict=True)) + f"-({L})"
        return with_claim_of(tables, kind="identity", lhs=lhs, rhs=rhs)
    if kind == "lie_series" and "order" not in claim and plain:
        known = {"exp", "sin", "cos", "sinh", "cosh", *tables.get("symbols", {})}
        if not called_in(str(claim["equals"])) <= known:  # the claim speaks of a germ
            return None
        s = claim["parameter"]
        tables = tables if s in tables.get("symbols", {}) else with_symbol(tables, s, "real")
        f = claim["equals"]
        return with_claim_of(tables, kind="identity", lhs=f"D({f},{s})", rhs=f"bracket({f},{claim['generator']})")
    if kind == "infinitesimal":
        if rng.random() < 0.5:
            return with_claim_of(tables, kind="hamiltonian_field", qdot=claim["dq"], pdot=claim["dp"])
        k = rng.randrange(len(space["q"]))
        return with_claim_of(tables, kind="bracket", f=space["q"][k], g=claim["generator"], equals=claim["dq"][k])
    if kind == "integral" and plain and str(claim["to"]) in parameters(tables, "real", "positive"):
        f = put(claim["f"], {claim["variable"]: claim["to"]})
        inner = every_name({"claim": [{"kind": "identity", "lhs": claim["f"], "rhs": claim["from"]}]})
        if claim["to"] in inner or claim["variable"] in variables(tables) | defined:
            return None
        return with_claim_of(tables, kind="identity", lhs=f"D({claim['equals']},{claim['to']})", rhs=f)
    if kind == "normal_form" and claim["order"] > 2:
        lower = claim["order"] - 1
        return with_claim(tables, order=lower, N={k: text for k, text in claim["N"].items() if int(k) <= lower})
    if kind == "stationary" and "extremum" in claim:
        return {**tables, "claim": [{k: v for k, v in claim.items() if k not in ("extremum", "field", "conjugate")}]}
    if kind == "euler_lagrange" and "equations" in claim:
        return with_claim(tables, equations=[f"({row})*2-({row})" for row in claim["equations"]])
    return None


def as_not_quite(rng: random.Random, tables: Tables) -> Tables | None:
    """A claim of dynamics or analysis that is off by a little."""
    claim, space = tables["claim"][0], tables.get("phase_space", {})
    kind, found = claim["kind"], list[dict[str, Any]]()
    small = rng.choice(("1/7", "1/1000", "10**(-9)"))
    more: dict[str, tuple[str, ...]] = {
        "euler_lagrange": ("equations", "qddot"), "solves": ("equations",), "infinitesimal": ("dq", "dp"),
        "equations_of_motion": ("qdot", "pdot"),
    }  # fmt: skip
    for word in more.get(kind, ()):
        if word in claim:
            found += [{**claim, word: [f"({row})+{small}" for row in claim[word]]}]
    if kind in ("action", "frequency"):
        found += [{**claim, "equals": f"({claim['equals']})*(1+{small})"}, {**claim, "equals": f"-({claim['equals']})"}]
    if kind == "lie_series" and int(claim.get("order", 1)) > 0:
        found += [{**claim, "equals": f"({claim['equals']})+{small}*{claim['parameter']}"}]
    if kind == "stationary":
        found += [{**claim, "L": f"({claim['L']})+{small}*{space['q'][0]}"}]
        other = {"minimum": "maximum", "maximum": "minimum", "neither": "minimum"}
        if "extremum" in claim:
            base = {k: v for k, v in claim.items() if k not in ("field", "conjugate")}
            found += [{**base, "extremum": other[claim["extremum"]]}] * 2
    if kind == "legendre":
        return {**tables, "hamiltonian": {"H": f"({tables['hamiltonian']['H']})+{small}"}}
    if kind == "constraint":
        found += [
            {**claim, word: not claim[word]} for word in ("holonomic", "stationary", "determined") if word in claim
        ]
    if kind == "hamiltonian_field":
        q = space["q"][0]
        found += [{**claim, "qdot": [f"({claim['qdot'][0]})+{small}*{q}", *claim["qdot"][1:]]}]
    if kind in ("algebra", "matrix_algebra", "group") and "equals" in claim and "structure" not in claim:
        others = {
            "so(3)": "sl(2,R)", "su(2)": "sl(2,R)", "so(4)": "so(3,1)", "so(3,1)": "so(2,2)", "e(3)": "so(4)",
            "e(2)": "e(1,1)", "sl(2,R)": "so(3)", "so(2,1)": "su(2)", "u(1)": "u(1)+u(1)", "heisenberg(1)": "e(2)",
            "u(2)": "gl(2,R)",
        }  # fmt: skip
        if str(claim["equals"]) in others:
            found += [{**claim, "equals": others[claim["equals"]]}]
    if kind == "volume" and "Q" in tables.get("transformation", {}):
        given = tables["transformation"]
        rows = [f"({given['Q'][0]})*(1+{small})", *given["Q"][1:]]
        return {**tables, "transformation": {**given, "Q": rows}}
    if kind == "average" and "virial" in claim:
        found += [{**claim, "equals": f"({claim['equals']})-{small}"}]
    if kind == "noether" and "charge" in claim:
        found += [{**claim, "charge": f"({claim['charge']})+{small}*{claim['velocities'][0]}"}]
    return with_claim_of(tables, **rng.choice(found)) if found else None
