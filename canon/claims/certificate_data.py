"""Certificates as data: what the checker asks to be shown of a claim, and how the deciders show it.

The checker derives from the claim's own text what must vanish. Each of these residuals is brought onto the kernels of
a tower here, as a fraction of polynomials in them as free variables, and its numerator divided by their relations.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import sympy as sp

from canon.budget import Budget
from canon.checker.case import Case
from canon.checker.check import VERSION, checksum
from canon.checker.formulas import Formulas
from canon.checker.functions import Unknown, Unreadable
from canon.checker.kinds import obligations
from canon.checker.statement import KNOWN, Statement
from canon.claim import Claim
from canon.claims.names import orders
from canon.claims.obligation_tape import OnTape
from canon.claims.question import Question
from canon.claims.worker import CERTIFICATE_SECONDS
from canon.decide import ladder
from canon.decide.fraction_field import Element, FractionField
from canon.decide.intervals import intervals_of
from canon.decide.kernel_text import KernelText, cofactors, denominator_of, free_of
from canon.decide.region import Region
from canon.decide.ring import Polynomial, TooCostly
from canon.decide.tape import ONE, Unsupported
from canon.decide.tower import Tower, combine
from canon.errors import CanonError, InputError
from canon.expression import Formula
from canon.verdict import Verdict

LARGEST = 2e7
"""The term products that one residual may cost: beyond it the certificate names the argument, and says so."""
MOST_TERMS = 20_000
LONGEST = 200
"""Operations of a residual that is written down; the checker derives it anyway."""
Data = dict[str, Any]


def certificate(
    claim: Claim, verdict: Verdict, tables: Mapping[str, Any], *, budget: float = CERTIFICATE_SECONDS
) -> Data:
    """The certificate of a claim that is proved or refuted, as data that JSON can hold.

    **Arguments:** the claim and its verdict; `tables`, the claim file's own tables with the claim's under "claim";
    `budget`, seconds for the identities: what takes longer is named and left to trust.

    **Raises:** `InputError` where the claim is neither proved nor refuted.
    """
    if verdict.status not in ("proved", "refuted"):
        raise InputError(f"a certificate is of a claim that is proved or refuted; this one is {verdict.status}")
    known = {word: verdict.detail[word] for word in KNOWN.get(verdict.status, ()) if word in verdict.detail}
    known = (
        _structure(verdict, tables["claim"]) | {k: x for k, x in known.items() if k != "structure"} | _torus(verdict)
    )
    data: Data = {
        "certificate": VERSION,
        "tables": tables,
        "known": known,
        "verdict": verdict.status,
        "method": verdict.method,
        "domain": [],
        "witness": None if verdict.witness is None else _plain(verdict.witness),
        "points": [],
        "cases": [],
    }
    question = Question(claim, Budget(budget))
    try:
        statement = Statement(tables, known, verdict.status)
        cases = obligations(statement)
        region = _region(question, {})
        data["domain"] = [requirement.text for requirement in region.requirements]
        if verdict.status == "proved" or verdict.witness is None:
            data["points"] = _points(question, region)
            data["cases"] = [_case(question, statement, case, verdict) for case in cases]
    except (Unknown, Unreadable) as reason:
        data["unknown"] = str(reason)
    return {**data, "checksum": checksum(data)}


def _structure(verdict: Verdict, claim: Mapping[str, Any]) -> Data:
    """The structure constants that a claim about an algebra rests on, where it doesn't state them itself."""
    if verdict.kind != "algebra" or verdict.certificate is None or "structure" in claim:
        return {}
    steps = (step for step in verdict.certificate["arguments"] if "structure" in step)
    return next(({"structure": _plain(step["structure"])} for step in steps), {})


def _torus(verdict: Verdict) -> Data:
    """The cycles round which several angles were followed."""
    if verdict.kind != "action_angle" or verdict.certificate is None:
        return {}
    steps = (step["torus"] for step in verdict.certificate["arguments"] if "torus" in step)
    return next(({"torus": _plain(torus)} for torus in steps), {})


def _region(question: Question, images: Mapping[Any, Any]) -> Region:
    """The domain of the claim with all its keys; what can't be stated of it is left out."""
    try:
        return question.region(*_formulas(question.claim.keys.values()), images=images)
    except CanonError:
        return Region((), (), ())


def _formulas(values: Iterable[Any]) -> Iterable[Formula]:
    for value in values:
        if isinstance(value, Formula):
            yield value
        elif isinstance(value, (list, tuple)):
            yield from _formulas(value)
        elif isinstance(value, Mapping):
            yield from _formulas(value.values())


def _points(question: Question, region: Region) -> list[Data]:
    """Points of the domain, for the checker to look near them."""
    try:
        found, _ = ladder.look(question.tape, [question.tape.zero], region, budget=question.budget.share(0.3))
    except (CanonError, Unsupported):
        return []
    points = []
    for sample in found:
        values = {str(question.tape.symbol_at(node)): value for node, value in sample.point.items()}
        points.append({name: _number(value) for name, value in values.items()})
    return points


def _number(value: Any) -> Any:
    return {"re": str(value[0]), "im": str(value[1])} if isinstance(value, tuple) else str(value)


def _case(question: Question, statement: Statement, case: Case, verdict: Verdict) -> Data:
    """The kernels, the functions' values in them, and an identity for each residual."""
    f, tape = statement.f, question.tape
    zeros = case.shown(verdict.status)
    symbols = {s.name: s for s in question.space.vocabulary.values()}
    for formula in _formulas(question.claim.keys.values()):
        symbols |= {s.name: s for s in formula.expr.free_symbols if isinstance(s, sp.Symbol)}
    on_tape = OnTape(tape, f, symbols)
    leaves = f.rational([*zeros, *statement.surface])[1]
    argument = {"argument": verdict.method}
    try:
        nodes = {a: on_tape.node(a) for a in leaves}
        images = {tape.symbol(symbols[n]): on_tape.node(a) for n, a in case.images.items() if n in symbols}
        region = _region(question, images)
        positive = [r.nodes[0] for r in region.requirements if r.kind == "positive" and not tape.is_complex(r.nodes[0])]
        tower = Tower(
            tape,
            list(nodes.values()) or [tape.zero],
            positive=positive,
            intervals=intervals_of(tape, region),
            budget=question.budget,
        )
        values = dict(tower.values)
        for i in tape.reach(nodes.values()):
            if i not in values:
                values[i] = combine(tower.field, tape.ops[i], values)
    except (Unsupported, TooCostly, ZeroDivisionError, CanonError):
        return {"kernels": [], "atoms": {}, "residuals": [argument for _ in zeros]}
    text = KernelText(tower, {op[1] for op in f.ops if op[0] == "s"} | set(symbols))
    free = FractionField(tower.ring)
    atoms = {a: free_of(tower, values[node], free) for a, node in nodes.items()}
    written = {}
    for a, x in atoms.items():
        name = f.text(a)
        if f.ops[a][0] != "s" or text.table(x[0]) != {name: "1"}:
            written[name] = [text.table(x[0]), text.table(denominator_of(free, x))]
    on = [_fraction(f, a, atoms, free) for a in statement.surface]
    surface = [x[0] for x in on]
    residuals = [_identity(f, a, atoms, free, tower, surface, text, argument) for a in zeros]
    found: Data = {"atoms": written, "residuals": residuals}
    if on:
        found["surface"] = [_over(text, free, x) for x in on]
    return {"kernels": text.kernels(found), **found}


def _identity(
    f: Formulas,
    target: int,
    atoms: Mapping[int, Element],
    free: FractionField,
    tower: Tower,
    surface: Sequence[Polynomial],
    text: KernelText,
    argument: Data,
) -> Data:
    """residual = numerator / denominator in the kernels as free variables, and numerator = Σ cofactor · relation."""
    ring = tower.ring
    ring.limit, ring.spent = LARGEST, 0.0
    shown = {"expression": f.text(target)} if len(f.reach(target)) < LONGEST else {}
    try:
        x = _fraction(f, target, atoms, free)
        under = denominator_of(free, x) if x[0] else ring.one
        found = cofactors(tower.field, x[0], surface)
    except (TooCostly, ZeroDivisionError, CanonError):
        return {**shown, **argument}
    if found is None or sum(map(len, (x[0], under, *found.values()))) > MOST_TERMS:
        return {**shown, **argument}
    return {
        **shown,
        "numerator": text.table(x[0]),
        "denominator": text.table(under),
        "cofactors": {_relation(text, k): text.table(c) for k, c in found.items()},
    }


def _over(text: KernelText, free: FractionField, x: Element) -> Data:
    """A fraction as its numerator and its denominator."""
    return {
        "numerator": text.table(x[0]),
        "denominator": text.table(denominator_of(free, x) if x[0] else free.ring.one),
    }


def _relation(text: KernelText, k: int) -> str:
    """The name of a relation: that of its kernel, or "surface 1" and so on for the equations of a surface (-1, …)."""
    return text.names[k] if k >= 0 else f"surface {-k}"


def _fraction(f: Formulas, target: int, atoms: Mapping[int, Element], free: FractionField) -> Element:
    """The value of a residual in the kernels, nothing reduced."""
    out: dict[int, Element] = dict(atoms)
    for a in f.rational([target])[0]:
        op, parts = f.ops[a], [out[b] for b in f.parts(a)]
        if op[0] == "n":
            out[a] = free.constant(op[1])
        elif op[0] == "^":
            out[a] = free.power(parts[0], op[2])
        else:
            out[a] = free.combine([(ONE, x) for x in parts]) if op[0] == "+" else free.product(parts)
    return out[target]


def statement_tables(tables: Mapping[str, Any], index: int) -> Data:
    """A claim file's tables with the claim of this index alone, as JSON can hold them; without a space an empty one.

    The small parameters that any claim's `order` names are the file's, in its map too: here they are declared.
    """
    kept = {name: _plain(value) for name, value in tables.items() if name != "claim"}
    said = {"phase_space": {"q": [], "p": []}, **kept, "claim": _plain(tables["claim"][index])}
    space = said["phase_space"]
    taken = {space.get("time", "t"), *kept.get("symbols", {}), *kept.get("definitions", {})}
    taken |= {name for side in "qpQP" for name in space.get(side, [])}
    small = {name: "real" for name in orders(tables["claim"]) if name not in taken}
    return {**said, "symbols": {**kept.get("symbols", {}), **small}} if small else said


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(name): _plain(item) for name, item in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [_plain(item) for item in value]
    return value if isinstance(value, (str, int, bool)) else str(value)
