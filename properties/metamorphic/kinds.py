"""What follows from a true claim, as a claim of another kind, and what is false then."""

from __future__ import annotations

import random
from typing import Any

from properties.metamorphic.parts import is_canonical, is_complex, variables, with_claim_of, words_of
from properties.metamorphic.tables import Tables, every_name


def as_another_kind(rng: random.Random, tables: Tables) -> Tables | None:
    """A consequence of a true claim, as a claim of another kind."""
    claim = tables["claim"][0]
    kind, found = claim["kind"], list[dict[str, Any]]()
    given, space = tables.get("transformation", {}), tables.get("phase_space", {})
    H = str(tables.get("hamiltonian", {}).get("H", ""))
    t = space.get("time", "t")
    still = (
        bool(H) and t not in every_name({**tables, "claim": [{"kind": "volume"}]}) if "tensor" not in claim else False
    )
    if kind == "canonical" and "order" not in claim and len(space["Q"]) == len(space["q"]):
        plain = "scale" not in claim
        if plain:
            found += [{"kind": "fundamental_brackets"}, {"kind": "volume"}, {"kind": "canonical", "scale": "1"}]
            found += [{"kind": "integral_invariant", "order": k} for k in range(1, len(space["Q"]) + 1)]
            a, b = space["Q"][0], space["P"][-1]
            found += [{"kind": "bracket_invariance", "f": f"{a}**2*{b}", "g": f"sin({a})+{b}**3"}]
        if "Q" in given:
            k = rng.randrange(len(given["Q"]))
            scale = claim.get("scale", "1")
            found += [{"kind": "bracket", "f": given["Q"][k], "g": given["P"][k], "equals": scale}] * 2
            found += [
                {"kind": "identity", "lhs": f"bracket({given['P'][k]},{given['Q'][k]})", "rhs": f"-({scale})"}
            ] * 2
            found += [{"kind": "independent", "functions": [*given["Q"], *given["P"]]}]
            if len(given["Q"]) > 1:
                found += [{"kind": "involution", "functions": given[word]} for word in "QP"]
    if kind == "fundamental_brackets":
        found += [{"kind": "canonical"}] + [{"kind": "volume"}] * (len(space["Q"]) == len(space["q"]))
    if kind == "conserved" and is_canonical(tables):
        f = claim["f"]
        found += [{**claim, "f": g} for g in (f"({f})**2", f"sin({f})", f"-({f})/7", f"exp({f})")]
        found += [{"kind": "identity", "lhs": f"bracket({f},{H})", "rhs": f"-D({f},{t})"}] * 2
        if still and t not in str(f):
            found += [{"kind": "involution", "functions": [f, H]}, {"kind": "bracket", "f": H, "g": f, "equals": "0"}]
            found += [{**claim, "f": f"({f})*({H})"}]
    if kind == "bracket" and is_canonical(tables):
        f, g, h = claim["f"], claim["g"], claim["equals"]
        found += [
            {"kind": "identity", "lhs": f"bracket({f},{g})", "rhs": h},
            {**claim, "f": g, "g": f, "equals": f"-({h})"},
        ]
        found += [
            {**claim, "g": f"({g})**2", "equals": f"2*({g})*({h})"},
            {**claim, "f": f"sin({f})", "equals": f"cos({f})*({h})"},
        ]
        found += [{**claim, "f": f"({f})+({g})**3"}]
    if kind == "involution" and is_canonical(tables):
        f, g, *more = claim["functions"]
        found += [
            {"kind": "bracket", "f": f, "g": g, "equals": "0"},
            {"kind": "involution", "functions": [f"({f})*({g})", g, *more]},
        ]
    if kind == "identity":
        lhs, rhs = claim["lhs"], claim["rhs"]
        found += [{**claim, "lhs": rhs, "rhs": lhs}, {**claim, "lhs": f"({lhs})**2", "rhs": f"({rhs})**2"}]
        found += [
            {**claim, "lhs": f"exp({lhs})", "rhs": f"exp({rhs})"},
            {**claim, "lhs": f"({lhs})-({rhs})", "rhs": "0"},
        ]
        found += [
            {**claim, "lhs": f"1/(1+({lhs})**2)", "rhs": f"1/(1+({rhs})**2)"},
            {**claim, "lhs": f"sin({lhs})", "rhs": f"sin({rhs})"},
        ]
        if not is_complex(tables):
            found += [{"kind": "inequality", "lhs": lhs, "relation": r, "rhs": rhs} for r in ("<=", ">=")]
            found += [{"kind": "inequality", "lhs": lhs, "relation": "<", "rhs": f"({rhs})+1/1000"}]
            found += [
                {**claim, "lhs": f"abs({lhs})", "rhs": f"abs({rhs})"},
                {**claim, "lhs": f"atan({lhs})", "rhs": f"atan({rhs})"},
            ]
        names = sorted(variables(tables) & every_name({**tables, "phase_space": {}, "symbols": {}}))
        if names and "phase_space" in tables and "on" not in tables.get("domain", {}) and not {"Q"} & {*space}:
            x = rng.choice(names)
            found += [{**claim, "lhs": f"D({lhs},{x})", "rhs": f"D({rhs},{x})"}] * 2
    if kind == "inequality":
        lhs, rhs, r = claim["lhs"], claim["rhs"], claim["relation"]
        other = {"<": ">", ">": "<", "<=": ">=", ">=": "<="}[r]
        found += [
            {**claim, "lhs": rhs, "rhs": lhs, "relation": other},
            {**claim, "lhs": f"-({lhs})", "rhs": f"-({rhs})", "relation": other},
        ]
        found += [
            {**claim, "lhs": f"exp({lhs})", "rhs": f"exp({rhs})"},
            {**claim, "lhs": f"({lhs})-({rhs})", "rhs": "0"},
        ]
        found += [
            {**claim, "lhs": f"atan({lhs})", "rhs": f"atan({rhs})"},
            {**claim, "lhs": f"({lhs})**3", "rhs": f"({rhs})**3"},
        ]
        found += [{**claim, "relation": r[0] + "="}]
    if kind == "limit" and "side" not in claim and "infinity" not in str(claim["to"]):
        found += [{**claim, "side": side} for side in "+-"]
        if "infinity" not in str(claim["equals"]):
            f, e = claim["f"], claim["equals"]
            found += [
                {**claim, "f": f"({f})**2", "equals": f"({e})**2"},
                {**claim, "f": f"exp({f})", "equals": f"exp({e})"},
            ]
    if kind == "equations_of_motion":
        k = rng.randrange(len(space["q"]))
        found += [{"kind": "bracket", "f": space[a][k], "g": H, "equals": claim[f"{a}dot"][k]} for a in "qp"]
        found += [{"kind": "hamiltonian_field", "qdot": claim["qdot"], "pdot": claim["pdot"]}]
        found += [{"kind": "infinitesimal", "generator": H, "dq": claim["qdot"], "dp": claim["pdot"]}]
    if kind == "new_hamiltonian":
        found += [{**claim, "K": f"({claim['K']})+7/3"}]
    if kind == "algebra" and "basis" in claim and is_canonical(tables) and len(claim["basis"]) > 1:
        basis = dict(claim["basis"])
        a, b = rng.sample([*basis], 2)
        if "structure" not in claim:
            found += [
                {**claim, "basis": {**basis, a: f"({basis[a]})+2*({basis[b]})"}},
                {**claim, "basis": {**basis, a: f"-3*({basis[a]})"}},
            ]
    if kind == "independent" and len(claim["functions"]) > 1:
        f, g, *more = claim["functions"]
        found += [{**claim, "functions": [f, *more]}, {**claim, "functions": [f"({f})+({g})", g, *more]}]
        found += [
            {**claim, "functions": [f"({f})**3", g, *more]},
            {**claim, "functions": [f"atan({f})", f"({g})*2", *more]},
        ]
    if kind == "integral" and "infinity" not in repr(claim) and "antiderivative" not in claim:
        x, f = claim["variable"], claim["f"]
        a, b = claim["from"], claim["to"]
        found += [{**claim, "f": f"({f})+3*{x}**2", "equals": f"({claim['equals']})+({b})**3-({a})**3"}]
    return with_claim_of(tables, **rng.choice(found)) if found else None


def as_not(rng: random.Random, tables: Tables) -> Tables | None:
    """A claim that is false where this one is true."""
    claim, found = tables["claim"][0], list[dict[str, Any]]()
    kind = claim["kind"]
    small = rng.choice(("1", "1/1000", "10**(-12)", "1/10**30"))
    if kind == "identity":
        found += [{**claim, "rhs": f"({claim['rhs']})+{small}"}]
        if not is_complex(tables):
            found += [{"kind": "inequality", "lhs": claim["lhs"], "relation": r, "rhs": claim["rhs"]} for r in "<>"]
            found += [{"kind": "inequality", "lhs": claim["lhs"], "relation": ">=", "rhs": f"({claim['rhs']})+{small}"}]
    if kind == "inequality":
        found += (
            [{"kind": "identity", "lhs": claim["lhs"], "rhs": f"({claim['rhs']})"}] if claim["relation"] in "<>" else []
        )
        other = {"<": ">=", ">": "<=", "<=": ">", ">=": "<"}[claim["relation"]]
        found += [{**claim, "relation": other}]
    if kind in ("bracket", "limit", "integral", "average") and "infinity" not in str(claim["equals"]):
        found += [{**claim, "equals": f"({claim['equals']})+{small}"}]
    if kind == "canonical" and "order" not in claim:
        found += [{**claim, "scale": f"({claim.get('scale', '1')})*(1+{small})"}]
    if kind == "involution" and is_canonical(tables) and "phase_space" in tables:
        q, p = tables["phase_space"]["q"][0], tables["phase_space"]["p"][0]
        found += [{**claim, "functions": [*claim["functions"], q, p]}]
    if kind == "independent":
        f = claim["functions"]
        found += [
            {**claim, "functions": [*f, f"({f[0]})**2"]},
            {**claim, "functions": [*f, "+".join(f"({g})" for g in f)]},
        ]
        found += [{**claim, "functions": [*f, f"sin({f[-1]})*exp({f[0]})"]}, {**claim, "functions": [*f, "7"]}]
    t = tables.get("phase_space", {}).get("time", "t")
    moves = t not in {*tables.get("definitions", {}), *variables(tables)} and words_of(tables, t) == ["real"]
    if kind == "conserved" and is_canonical(tables) and "on" not in tables.get("domain", {}) and moves:
        found += [{**claim, "f": f"({claim['f']})+{small}*{t}"}]
    if kind == "new_hamiltonian":
        Q = rng.choice([*tables["phase_space"]["Q"], *tables["phase_space"]["P"]])
        found += [{**claim, "K": f"({claim['K']})+{small}*{Q}"}]
    if kind == "equations_of_motion":
        word = rng.choice(("qdot", "pdot"))
        found += [{**claim, word: [f"({row})+{small}" for row in claim[word]]}]
    return with_claim_of(tables, **rng.choice(found)) if found else None
