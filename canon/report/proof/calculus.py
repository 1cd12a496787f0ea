"""What claims about inequalities, integrals, limits, averages, Lagrange's equations and symmetries say, in words."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Final

from canon.report.proof.blocks import Block, Display, listed, paragraph
from canon.report.proof.lines import formulas, names_of
from canon.report.proof.structure import LONG, structured
from canon.typeset.trees import Tree, tree_of

Tables = Mapping[str, Any]
Blocks = list[Block]


def _inequality(claim: Tables, tables: Tables) -> Blocks:
    left, right, sign = tree_of(str(claim["lhs"])), tree_of(str(claim["rhs"])), str(claim["relation"])
    if left.size + right.size <= 2 * LONG:
        line = Tree("relation", parts=(left, right), signs=(sign,))
        return [Display((line,)), paragraph("throughout the domain.")]
    sides = formulas([("lhs", claim["lhs"]), ("rhs", claim["rhs"])], tables)
    return [paragraph(f"`lhs {sign} rhs` throughout the domain, where"), sides]


def _integral(claim: Tables, tables: Tables) -> Blocks:
    x, ends = claim["variable"], f"from {_end(claim['from'])} to {_end(claim['to'])}"
    pairs = [("f", str(claim["f"]))]
    found: Blocks = [paragraph(f"The integral over `{x}` {ends} of"), formulas(pairs, tables), paragraph("is")]
    return [*found, _value(claim["equals"], tables)]


def _limit(claim: Tables, tables: Tables) -> Blocks:
    side = {"+": " from above", "-": " from below"}.get(str(claim.get("side")), "")
    towards = f"As `{claim['variable']}` tends to {_end(claim['to'])}{side}"
    if str(claim["equals"]) in ENDS:
        pairs = formulas([("f", str(claim["f"]))], tables)
        return [paragraph(f"{towards}, this tends to {_end(claim['equals'])}:"), pairs]
    pairs = formulas([("f", str(claim["f"]))], tables)
    return [paragraph(f"{towards}, the function"), pairs, paragraph("tends to"), _value(claim["equals"], tables)]


def _average(claim: Tables, tables: Tables) -> Blocks:
    if "motion" in claim:
        pairs = [(str(name), str(text)) for name, text in claim["motion"].items()]
        stretch = f"`{claim['parameter']}` from {_end(claim['from'])} to {_end(claim['to'])}"
        where: Blocks = [paragraph(f"along the motion, {stretch},"), formulas(pairs, tables)]
    elif "virial" in claim:
        pairs = [("G", str(claim["virial"])), ("B", str(claim["bound"]))]
        said = "along every motion that stays in the domain, by a virial `G` of which the modulus is at most `B`:"
        where = [paragraph(said), formulas(pairs, tables)]
    else:
        where = [paragraph(f"over one period of `{claim['coordinate']}` at the energy `{claim['energy']}`.")]
    found: Blocks = [paragraph("The average over time of"), formulas([("f", str(claim["f"]))], tables), paragraph("is")]
    return [*found, _value(claim["equals"], tables), *where]


def _lagrange(claim: Tables, tables: Tables) -> Blocks:
    q = tables["phase_space"]["q"]
    found: Blocks = [paragraph("With the Lagrangian `L`")]
    if str(claim["L"]) != "L":
        found = [paragraph("With the Lagrangian"), formulas([("L", str(claim["L"]))], tables)]
    for key, said in (("dissipation", "the dissipation function"), ("forces", "the forces")):
        if key in claim:
            values = claim[key] if isinstance(claim[key], list) else [claim[key]]
            found += [paragraph(f"and {said}"), formulas(_numbered(key[0].upper(), values), tables)]
    key, said = ("equations", "Lagrange's equations, one for each coordinate, say that these are 0:")
    if key not in claim:
        key, said = "qddot", "Lagrange's equations are solved by the accelerations"
    values = claim[key] if isinstance(claim[key], list) else [claim[key]]
    names = [f"ddot({x})" for x in q] if key == "qddot" else [f"e_{k}" for k in range(1, len(values) + 1)]
    pairs = [(name, str(value)) for name, value in zip(names, values, strict=False)]
    return [*found, paragraph(said), formulas(pairs, tables)]


def _numbered(letter: str, values: list[Any]) -> list[tuple[str, str]]:
    return [(f"{letter}_{k}" if len(values) > 1 else letter, str(value)) for k, value in enumerate(values, 1)]


ENDS: Final = {"infinity": "infinity", "-infinity": "minus infinity"}


def _end(text: Any) -> str:
    return ENDS.get(str(text), f"`{text}`")


def _value(text: Any, tables: Tables) -> Display:
    tree = tree_of(str(text))
    if tree.size <= LONG:
        return Display((tree,))
    short, parts = structured(tree, names_of(tables))
    rows = [Tree("relation", parts=(Tree("name", name), part), signs=("=",)) for name, part in reversed(parts)]
    return Display((short, *rows))


def _noether(claim: Tables, tables: Tables) -> Blocks:
    shifts = zip(tables["phase_space"]["q"], claim["dq"], strict=False)
    pairs = [*((f"delta({x})", dx) for x, dx in shifts), *([("delta(t)", claim["dt"])] if "dt" in claim else [])]
    charge = [("charge", claim["charge"])] if "charge" in claim else []
    return [
        paragraph(f"The infinitesimal displacement along every path, with velocities {listed(claim['velocities'])},"),
        formulas(pairs, tables),
        paragraph(
            "changes `L*dt`, to first order, by the differential of"
            if "f" in claim
            else "leaves `L*dt` as it is, to first order, for the Lagrangian"
        ),
        *([formulas([("f", claim["f"])], tables), paragraph("for the Lagrangian")] if "f" in claim else []),
        formulas([("L", claim["L"])], tables),
        *([paragraph("and the conserved quantity is"), formulas(charge, tables)] if charge else []),
    ]


def _solves(claim: Tables, tables: Tables) -> Blocks:
    lines = [Tree("relation", parts=(tree_of(str(e)), Tree("number", "0")), signs=("=",)) for e in claim["equations"]]
    return [
        formulas([(str(name), str(value)) for name, value in claim["solution"].items()], tables),
        paragraph("solves"),
        Display(tuple(lines)),
    ]


KINDS: Final[Mapping[str, Callable[[Tables, Tables], Blocks]]] = {
    "inequality": _inequality,
    "integral": _integral,
    "limit": _limit,
    "average": _average,
    "euler_lagrange": _lagrange,
    "noether": _noether,
    "solves": _solves,
}
