"""The same claim about an action, an integral, a limit, a Lagrangian, an algebra, in other variables of its own."""

from __future__ import annotations

import random
from typing import Any

from canon.syntax import Name, Node, parse
from properties.metamorphic.parts import is_complex, variables, with_claim, words_of
from properties.metamorphic.tables import Tables, every_name, in_nodes, mapped, replaced


def put(text: Any, values: dict[str, str]) -> str:
    """A formula with others in the place of names, by which no derivative is taken."""
    trees = {name: parse(value) for name, value in values.items()}

    def told(node: Node) -> Node:
        return trees.get(node.name, node) if isinstance(node, Name) else node

    return in_nodes(str(text), lambda node: replaced(node, told))


def _derives(tables: Tables) -> bool:
    return {"D", "bracket"} & every_name(tables) != set()


def with_a_function_of_the_energy(rng: random.Random, tables: Tables) -> Tables | None:
    """Actions and frequencies of a function of H that grows, at the energy that belongs to it."""
    claim = tables["claim"][0]
    if claim["kind"] not in ("action", "frequency") or _derives(tables) or is_complex(tables):
        return None
    E, H = claim["energy"], tables["hamiltonian"]["H"]
    if E in {*tables.get("definitions", {})} or words_of(tables, E) != ["real"]:
        return None
    new, old, slope = rng.choice((
        ("{}+7/3", f"{E}-7/3", "1"), ("2*({})", f"{E}/2", "2"), ("({})/3-1", f"3*({E}+1)", "1/3"),
        ("exp({})", f"log({E})", E), ("sinh({})", f"asinh({E})", f"sqrt(1+{E}**2)"),
    ))  # fmt: skip
    fixed = dict(claim.get("fixed", {}))
    if E in fixed:
        fixed[E] = new.format(fixed[E])
    rest = {word: value for word, value in tables.items() if word not in ("hamiltonian", "claim")}
    found = mapped({**rest, "claim": []}, lambda text: put(text, {E: old}))
    equals = put(claim["equals"], {E: old})
    if claim["kind"] == "frequency":
        equals = f"({equals})*({slope})"
    found |= {"hamiltonian": {"H": new.format(H)}, "claim": [claim]}
    return with_claim(found, equals=equals, **({"fixed": fixed} if fixed else {}))


def round_another_orbit(rng: random.Random, tables: Tables) -> Tables | None:
    """Actions and frequencies with the coordinate shifted, stretched or turned round."""
    claim = tables["claim"][0]
    if claim["kind"] not in ("action", "frequency") or _derives(tables) or is_complex(tables) or "period" in claim:
        return None
    q = claim["coordinate"]
    p = tables["phase_space"]["p"][tables["phase_space"]["q"].index(q)]
    if words_of(tables, q) != ["real"] or words_of(tables, p) != ["real"] or {q, p} & {*claim.get("fixed", {})}:
        return None
    new_q, new_p, well = rng.choice((
        (f"{q}+3/2", p, "({})-3/2"), (f"2*{q}", f"{p}/2", "({})/2"), (f"-{q}", f"-{p}", "-({})"),
        (f"{q}/3-1", f"3*{p}", "3*(({})+1)"), (q, f"{p}+1/2", "{}"),
    ))  # fmt: skip
    if claim.get("branch") == "rotation" and new_q != f"{q}+3/2":
        return None
    found = mapped(tables, lambda text: put(text, {q: new_q, p: new_p}))
    new = found["claim"][0]
    if "well" in claim:
        new = {**new, "well": well.format(claim["well"])}
    return {**found, "claim": [new]}


def in_another_variable(rng: random.Random, tables: Tables) -> Tables | None:
    """Integrals and limits over another variable that grows with the first one, or falls."""
    claim = tables["claim"][0]
    if claim["kind"] not in ("integral", "limit") or "antiderivative" in claim or _derives(tables):
        return None
    x = claim["variable"]
    defined = {
        n
        for text in tables.get("definitions", {}).values()
        for n in every_name({"claim": [], "definitions": {"d": text}})
    }
    where = {
        n
        for text in tables.get("domain", {}).get("where", ())
        for n in every_name({"claim": [], "domain": {"where": [text]}})
    }
    if x in variables(tables) | defined | where or words_of(tables, x) != ["real"] or "on" in tables.get("domain", {}):
        return None
    ends = [str(claim[word]) for word in ("from", "to") if word in claim]
    infinite = any("infinity" in end for end in ends)
    choices = [("{}+3/2", "({})-3/2", "1"), ("2*({})", "({})/2", "2"), ("({})/3-1", "3*(({})+1)", "1/3")]
    if not infinite:
        choices += [("sinh({})", "asinh({})", f"cosh({x})")]
    image, back, slope = rng.choice(choices)

    def end(text: str) -> str:
        return text if "infinity" in text else back.format(text)

    f = put(claim["f"], {x: image.format(x)})
    if claim["kind"] == "limit":
        if rng.random() < 0.3 and str(claim["to"]) == "infinity":
            return with_claim(tables, f=put(claim["f"], {x: f"1/{x}"}), to="0", side="+")
        if rng.random() < 0.3 and str(claim["to"]) == "0" and claim.get("side") == "+":
            new = {word: value for word, value in claim.items() if word != "side"}
            return {**tables, "claim": [{**new, "f": put(claim["f"], {x: f"1/{x}"}), "to": "infinity"}]}
        if rng.random() < 0.3 and not infinite:
            side = {"side": {"+": "-", "-": "+"}[claim["side"]]} if "side" in claim else {}
            return with_claim(tables, f=put(claim["f"], {x: f"-{x}"}), to=f"-({claim['to']})", **side)
        return with_claim(tables, f=f, to=end(str(claim["to"])))
    if rng.random() < 0.25:  # turned round
        turned = {"infinity": "-infinity", "-infinity": "infinity"}
        a, b = (turned.get(text, f"-({text})") for text in ends)
        return with_claim(tables, **{"f": put(claim["f"], {x: f"-{x}"}), "from": b, "to": a})
    return with_claim(tables, **{"f": f"({f})*({slope})", "from": end(ends[0]), "to": end(ends[1])})


def by_another_lagrangian(rng: random.Random, tables: Tables) -> Tables | None:
    """A Lagrangian with a total derivative more, or times a number."""
    claim = dict(tables["claim"][0])
    if claim["kind"] not in ("euler_lagrange", "stationary", "noether", "legendre") or "L" not in claim:
        return None
    if {"dissipation", "forces"} & {*claim}:
        return None
    q, v = tables["phase_space"]["q"], claim["velocities"]
    t = tables["phase_space"].get("time", "t")
    k = rng.randrange(len(q))
    L = f"({claim['L']})"
    if claim["kind"] == "noether" or (claim["kind"] != "legendre" and rng.random() < 0.4):
        factor = rng.choice(("3", "2/7", "1000"))
        claim["L"] = f"{factor}*{L}"
        for word in ("equations",):
            if word in claim:
                claim[word] = [f"{factor}*({row})" for row in claim[word]]
        for word in ("f", "charge"):
            if word in claim:
                claim[word] = f"{factor}*({claim[word]})"
        return {**tables, "claim": [claim]}
    if claim["kind"] == "legendre":
        c = rng.choice(("7/3", f"sin({q[k]})", f"{q[k]}**2"))
        claim["L"] = f"{L}-{c}"
        return {**tables, "claim": [claim], "hamiltonian": {"H": f"({tables['hamiltonian']['H']})+{c}"}}
    if claim["kind"] == "stationary" and rng.random() < 0.3:
        claim["L"] = f"-{L}"
        other = {"minimum": "maximum", "maximum": "minimum"}
        return {
            **tables,
            "claim": [
                {
                    **claim,
                    **({"extremum": other.get(claim["extremum"], claim["extremum"])} if "extremum" in claim else {}),
                }
            ],
        }
    time = (
        t if t not in {*tables.get("definitions", {}), *variables(tables)} and words_of(tables, t) == ["real"] else "1"
    )
    claim["L"] = f"{L}+" + rng.choice((
        f"3*{q[k]}**2*{v[k]}", f"cos({q[k]})*{v[k]}", f"5*{v[k]}", "7", f"{time}*{v[k]}+{q[k]}" if time != "1" else "1",
        f"2*{time}*exp({q[k]})+{time}**2*exp({q[k]})*{v[k]}" if time != "1" else f"{q[k]}*{v[k]}",
    ))  # fmt: skip
    return {**tables, "claim": [claim]}


def in_another_basis(rng: random.Random, tables: Tables) -> Tables | None:
    """Matrices in other coordinates, a group by other parameters, a normal form times a number."""
    claim = dict(tables["claim"][0])
    if claim["kind"] == "matrix_algebra" and "structure" not in claim:
        size = len(next(iter(claim["basis"].values())))
        if size < 2:
            return None
        i, j = rng.sample(range(size), 2)
        c = rng.choice(("2", "-1/3", "1", "sqrt(2)"))

        def sheared(rows: list[list[Any]]) -> list[list[Any]]:
            """S M S⁻¹ with S = 1 + c e_ij."""
            new = [[str(entry) for entry in row] for row in rows]
            new[i] = [f"({a})+{c}*({b})" for a, b in zip(new[i], new[j], strict=True)]
            for row in new:
                row[j] = f"({row[j]})-{c}*({row[i]})"
            return new

        def adjoint(rows: list[list[Any]]) -> list[list[Any]]:
            return [[f"-({rows[b][a]})" for b in range(size)] for a in range(size)]

        change = rng.choice((sheared, adjoint))
        return {**tables, "claim": [{**claim, "basis": {name: change(rows) for name, rows in claim["basis"].items()}}]}
    if claim["kind"] == "group" and "structure" not in claim and "composition" in claim:
        a, b = claim["first"], claim["second"]
        factor = rng.choice(("2", "-3", "1/5"))
        values = {name: f"{factor}*{name}" for name in (*a, *b)}
        return with_claim(tables, composition=[f"({put(row, values)})/({factor})" for row in claim["composition"]])
    if claim["kind"] == "normal_form":
        factor = rng.choice(("2", "1/3", "-1"))
        N = {degree: f"{factor}*({text})" for degree, text in claim["N"].items()}
        return {
            **tables,
            "hamiltonian": {"H": f"{factor}*({tables['hamiltonian']['H']})"},
            "claim": [{**claim, "N": N}],
        }
    if claim["kind"] == "lie_series":
        s = claim["parameter"]
        factor = rng.choice(("2", "-1", "1/3") if words_of(tables, s) == ["real"] else ("2", "1/3"))
        return (
            with_claim(
                tables,
                generator=f"({claim['generator']})/({factor})",
                equals=put(claim["equals"], {s: f"{s}/({factor})"}),
            )
            if not _derives(tables)
            else None
        )
    if claim["kind"] == "casimir":
        return with_claim(tables, f=rng.choice(("-2*({})", "({})+7")).format(claim["f"]))
    if claim["kind"] == "invariant_interval":
        return with_claim(tables, metric=[[f"3*({entry})" for entry in row] for row in claim["metric"]])
    if claim["kind"] == "algebra" and "equals" in claim and "structure" not in claim:
        a, *_ = rng.sample([*claim["basis"]], 1)
        return with_claim(
            tables, basis={name: f"5*({text})" if name == a else text for name, text in claim["basis"].items()}
        )
    return None


def by_other_constraints(rng: random.Random, tables: Tables) -> Tables | None:
    """Constraints multiplied by what is nowhere 0, and added to each other; equations of a solution, too."""
    claim = tables["claim"][0]
    if claim["kind"] == "solves":
        rows = [f"{rng.choice(('2', '-1', 'exp(1)'))}*({row})" for row in claim["equations"]]
        return with_claim(tables, equations=rng.sample(rows, len(rows)))
    if claim["kind"] != "constraint" or {"multipliers", "determined", "L"} & {*claim}:
        return None
    x = rng.choice(tables["phase_space"]["q"])
    word = "forms" if "forms" in claim else "functions"
    rows = (
        [f"({row})*{rng.choice(('2', f'(2+sin({x}))', f'(1+{x}**2)'))}" for row in claim[word]]
        if word == "forms"
        else claim[word]
    )
    if len(rows) > 1:
        rows = [f"({rows[0]})+3*({rows[1]})", *rows[1:]]
    return with_claim(tables, **{word: rows})


def with_more_of_an_average(rng: random.Random, tables: Tables) -> Tables | None:
    """An average of a multiple, or with a constant more."""
    claim = tables["claim"][0]
    if claim["kind"] != "average" or "antiderivative" in claim:
        return None
    if "virial" in claim:
        if rng.random() < 0.5:
            return with_claim(
                tables, **{word: f"3*({claim[word]})" for word in ("f", "equals", "virial", "bound") if word in claim}
            )
        return with_claim(tables, virial=f"({claim['virial']})+2", bound=f"({claim['bound']})+2")
    if rng.random() < 0.5:
        return with_claim(tables, f=f"({claim['f']})*3/7", equals=f"({claim['equals']})*3/7")
    return with_claim(tables, f=f"({claim['f']})+5", equals=f"({claim['equals']})+5")
