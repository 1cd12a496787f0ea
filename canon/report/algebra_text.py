"""A Lie algebra for people and programs: bracket table, Killing form, identification, as text, LaTeX and data."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.budget import Budget
from canon.deadline import within
from canon.errors import BudgetExceeded
from canon.mechanics.algebra import linear
from canon.mechanics.algebra.casimirs import casimirs
from canon.mechanics.algebra.coefficients import as_sympy
from canon.mechanics.algebra.ideals import centre, derived_series, lower_central_series
from canon.mechanics.algebra.invariants import motion_casimirs
from canon.mechanics.algebra.lie_algebra import LieAlgebra
from canon.report.words import visible

if TYPE_CHECKING:
    from canon.claim import Claim
    from canon.claims.algebra_table import AlgebraTable
    from canon.claims.worker import Entry, Settings
    from canon.mechanics.algebra.identify import Identification
    from canon.verdict import Verdict

WIDEST = 12
"""The largest dimension whose brackets and Killing form are shown as square tables."""


def recorded(settings: Settings, form: str, entry: Entry, claim: Claim, verdict: Verdict) -> dict[str, Any]:
    """The algebra of a claim in a form ("record", "text" or "latex"), as `shown`, beside the verdict and whether it
    is `expected`: what a worker answers. A verdict stands, whatever happens to its algebra."""
    from canon.claims.algebra_table import AlgebraTable, algebra_table

    def shown(table: AlgebraTable) -> Any:
        if form == "record":
            return as_record(table, entry.file)
        return as_latex(table) if form == "latex" else "\n".join(as_text(table, entry.file))

    def found() -> Any:
        return shown(algebra_table(claim, verdict, budget=seconds, seed=settings.seed))

    seconds = settings.seconds(entry)
    answer = {"verdict": verdict.status, "expected": claim.is_met_by(verdict.status)}
    note = str(verdict.detail.get("note", ""))
    if not note.startswith("stopped"):  # or its worker is there no more, and this is asked of another process
        try:
            return {**answer, "shown": within(Budget(seconds), found)}
        except BudgetExceeded:
            note = f"its algebra isn't found within {seconds:g} s"
        except MemoryError:
            note = "its algebra isn't found: out of memory"
        except Exception as error:
            note = f"its algebra isn't found: stopped by an internal error, {type(error).__name__}: {error}"[:300]
    return {**answer, "shown": shown(AlgebraTable(claim, verdict, None, None, None, note))}


def as_record(table: AlgebraTable, file: str) -> dict[str, Any]:
    """The algebra as data that JSON can hold."""
    record: dict[str, Any] = {
        "file": file,
        "index": table.claim.index,
        "kind": table.claim.kind,
        "title": table.claim.title,
        "verdict": table.verdict.status,
        "expected": table.claim.is_met_by(table.verdict.status),
        "algebra": None,
        "note": table.note or None,
    }
    if table.algebra is not None:
        record |= {
            "basis": list(table.algebra.names),
            "brackets": {f"{a},{b}": value for a, b, value in table.algebra.rows()},
        }
    if table.found is not None and table.scaled is not None:
        found, g = table.found, table.scaled.algebra
        record |= {
            "algebra": found.identity.name,
            "also_called": list(found.identity.aliases),
            "dimension": g.dimension,
            "killing_form": [[str(entry) for entry in row] for row in linear.rows(g.killing_form())],
            "killing_signature": list(found.killing_signature),
            "direct_summands": [{"algebra": name, "basis": list(found.words(rows))} for name, rows in found.summands],
            "radical": list(found.words(found.radical)),
            "centre": list(found.words(centre(g))),
            "levi_basis": list(found.words(found.levi)),
            "levi": [s.names[0] for s in found.identity.levi],
            "levi_types": [f"{s.type}(C)" if s.is_complex else str(s.type) for s in found.identity.levi],
            "casimirs": [str(f) for f in _casimirs(found)] if g.dimension <= WIDEST else None,
            "radical_dimension": found.radical.nrows(),
            "centre_dimension": centre(g).nrows(),
            "derived_series": [space.nrows() for space in derived_series(g)],
            "lower_central_series": [space.nrows() for space in lower_central_series(g)],
            "simple_ideals": [list(basis) for basis in found.ideal_bases()],
            "scales": {n: str(s) for n, s in zip(g.names, table.scaled.scales, strict=True) if s != 1},
        }
    return record


def _casimirs(found: Identification) -> tuple[sp.Expr, ...]:
    """The quadratic ones; of iso(p, q) those that generate all."""
    core, g = next(iter(found.identity.cores), None), found.algebra
    if core is not None and core.family == "iso" and core.dimension == g.dimension and found.levi.nrows():
        return motion_casimirs(g)
    return casimirs(g)


def as_text(table: AlgebraTable, file: str) -> list[str]:
    """The algebra as lines."""
    title = f" ({table.claim.title})" if table.claim.title else ""
    lines = [visible(f"{file} #{table.claim.index + 1}{title}: {table.verdict.status}")]
    g = table.algebra
    if g is None:
        return [*lines, f"  {table.note}"]
    brackets = [[as_text_of(g, a, b) for b in range(g.dimension)] for a in range(g.dimension)]
    lines += _square("[ , ]", g, brackets) if g.dimension <= WIDEST else [f"  [{a}, {b}] = {v}" for a, b, v in g.rows()]
    if table.found is None or table.scaled is None:
        known = table.note or table.verdict.detail.get("algebra") or "not identified for all values of the parameters"
        if g.dimension <= WIDEST:
            lines += ["", *_square("K", g, [[str(entry) for entry in row] for row in g.killing_matrix().tolist()])]
        return [*lines, "", f"  algebra          {known}"]
    found, form = table.found, table.scaled.algebra.killing_form()
    scales = [f"{n} by {s}" for n, s in zip(g.names, table.scaled.scales, strict=True) if s != 1]
    if g.dimension <= WIDEST:
        lines += ["", *_square("K", g, [[str(entry) for entry in row] for row in linear.rows(form)])]
    if scales:
        lines.append(f"  (of the basis rescaled, {', '.join(scales)})")
    record = as_record(table, file)
    names = ", ".join((found.identity.name, *found.identity.aliases))
    positive, negative, zero = found.killing_signature
    levi = " + ".join(record["levi"]) or "none"
    types = f" (type {' + '.join(record['levi_types'])})" if record["levi_types"] else ""
    lines += [
        "",
        f"  algebra          {names}",
        f"  Killing form     {positive} positive, {negative} negative, {zero} zero",
        f"  Levi subalgebra  {levi}{types}; radical of dimension {record['radical_dimension']}",
        f"  derived series   {_chain(record['derived_series'])}; centre of dimension {record['centre_dimension']}",
    ]
    lines += [f"  Casimir          {formula}" for formula in record["casimirs"] or ()]
    if found.radical.nrows() and found.levi.nrows():
        lines += [
            f"  Levi subalgebra  {', '.join(record['levi_basis'])}",
            f"  radical          {', '.join(record['radical'])}",
        ]
    lines += [f"  centre           {', '.join(record['centre'])}"] if record["centre"] else []
    if len(record["direct_summands"]) > 1:
        lines += [f"  direct summand   {s['algebra']}: {', '.join(s['basis'])}" for s in record["direct_summands"]]
    return lines


def as_text_of(g: LieAlgebra, a: int, b: int) -> str:
    """One bracket."""
    return g.show(g.bracket_of(a, b))


def as_latex(table: AlgebraTable) -> str:
    """The bracket table with the algebra's name below it, and the Killing form, for a paper."""
    g = table.algebra
    if g is None:
        return f"% {table.note}"
    heads = [_tex_name(name) for name in g.names]
    rows = []
    for a in range(g.dimension):
        values = [sp.latex(as_sympy(g.bracket_of(a, b), g.names)) for b in range(g.dimension)]
        rows.append(" & ".join([heads[a], *values]))
    body = " \\\\\n".join([" & ".join(["[\\cdot,\\cdot]", *heads]) + " \\\\ \\hline", *rows])
    body = body.replace("\\hline \\\\\n", "\\hline\n")
    name = (
        f" \\\\[1ex]\n\\multicolumn{{{g.dimension + 1}}}{{l}}{{\\text{{{_tex_words(table)}}}}}" if table.found else ""
    )
    brackets = f"\\[\n\\begin{{array}}{{c|{'c' * g.dimension}}}\n{body}{name}\n\\end{{array}}\n\\]"
    return brackets if g.dimension > WIDEST else f"{brackets}\n\\[\n{_killing_form(g)}\n\\]"


def _killing_form(g: LieAlgebra) -> str:
    rows = " \\\\\n".join(" & ".join(sp.latex(entry) for entry in row) for row in g.killing_matrix().tolist())
    return f"K = \\begin{{pmatrix}}\n{rows}\n\\end{{pmatrix}}"


def _tex_words(table: AlgebraTable) -> str:
    assert table.found is not None
    name = re.sub(r"\^([0-9]+)", r"$^{\1}$", table.found.identity.name)
    positive, negative, zero = table.found.killing_signature
    return f"{name}, Killing form of signature $({positive}, {negative}, {zero})$"


def _tex_name(name: str) -> str:
    return sp.latex(sp.Symbol(name))


def _square(corner: str, g: LieAlgebra, cells: list[list[str]]) -> Iterable[str]:
    table = [[corner, *g.names], *([name, *row] for name, row in zip(g.names, cells, strict=True))]
    widths = [max(len(row[k]) for row in table) for k in range(len(table[0]))]
    return ["  " + "  ".join(f"{cell:>{width}}" for cell, width in zip(row, widths, strict=True)) for row in table]


def _chain(dimensions: list[int]) -> str:
    return " > ".join(str(n) for n in dimensions)
