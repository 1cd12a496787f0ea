"""What claims about constraints ask for: forms a·v + b that vanish, or functions of coordinates and time."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain, combinations

from canon.checker.case import Case
from canon.checker.everywhere import is_nearly
from canon.checker.functions import Unknown
from canon.checker.inhabited import is_inhabited
from canon.checker.motion import Motion, formulas
from canon.checker.points import Numbers, domain_of, names_in, points
from canon.checker.positive import is_nowhere_zero
from canon.checker.statement import Statement

Form = list[int]
"""The coefficients of dq₁, …, dq_n and of dt."""
ON_FORMS = ("holonomic", "stationary", "integrals")
ON_MOTIONS = ("possible", "virtual", "multipliers")


def constraint(s: Statement) -> list[Case]:
    """Of forms: Frobenius' condition, time, integrals; of motions: velocities, displacements, multipliers."""
    f, m = s.f, Motion(s)
    asked = [word for word in (*ON_FORMS, *ON_MOTIONS, "determined") if word in s.claim]
    functions = s.keys("functions") if "functions" in s.claim else []
    lines = [m.rate(a) for a in functions] or s.keys("forms")
    at_rest = {v: f.number(0) for v in m.v}
    forms = [[*(f.substitute(f.slope(a, v), at_rest) for v in m.v), f.substitute(a, at_rest)] for a in lines]
    linear = []
    for a, form in zip(lines, forms, strict=True):
        terms = [f.mul(c, f.node("s", v)) for c, v in zip(form, m.v, strict=False)]
        linear.append(f.sub(a, f.add(*terms, form[-1])))
    found = [Case(linear)] if s.verdict == "proved" else []
    found += [_of_forms(s, m, forms, word) for word in ON_FORMS if word in asked]
    if "holonomic" in asked or "integrals" in asked:
        minors = _minors(s, forms)
        sure = is_nearly(s, minors, (*m.q, m.t))
        trusted = "" if sure else "that the forms are independent nearly everywhere"
        found.append(Case([], [minors], trusted=trusted, granted_by_all=True))
    if "determined" in asked:
        found.append(_determined(s, m, forms))
    for word in (w for w in ON_MOTIONS if w in asked):
        found.append(_of_motions(s, m, forms, lines, word))
    if "determined" in asked and (s.verdict == "refuted" or s.claim["determined"] is not True):
        # it is a claim of states that the constraints allow; a determinant without a zero has none there, either
        if len(asked) > 1:
            raise Unknown("several claims about constraints at once")
        whole = [a for case in found[-1:] for a in (*case.zeros, *chain(*case.nonzeros))]
        moving = {*names_in(s, whole)} & {*m.v} or any(s.f.value(form[-1]) != 0 for form in forms)
        rates = lines if moving or s.verdict == "proved" else []  # at rest they hold, and velocities don't matter
        s.surface += [s.pull(a) for a in (*functions, *rates) if s.f.value(a) != 0]
    formal = functions and {*ON_FORMS} & {*asked} and not {*ON_MOTIONS} & {*asked}
    if formal and s.verdict == "proved" and not _hold_somewhere(s, functions):
        found[0].trusted = "that the constraints hold somewhere, and say something there"
    if {*ON_MOTIONS} & {*asked} and (functions or "multipliers" in asked):
        if any(word in asked for word in (*ON_FORMS, "determined")) and functions:
            raise Unknown("claims about functions and about motions on them at once")
        on = [*functions, *(lines if "multipliers" in asked else [])]
        s.surface += [s.pull(a) for a in on if s.f.value(a) != 0]
    return found


def _hold_somewhere(s: Statement, functions: Sequence[int]) -> bool:
    """Whether functions of coordinates and time are seen to change their signs at one point of the domain."""
    kept, numbers = s.surface, Numbers()
    try:
        s.surface = [*kept, *(s.pull(a) for a in functions)]
        free = names_in(s, [*s.surface, *domain_of(s)])
        return is_inhabited(s, Case([]), points(s, Case([]), numbers, [], free), real=True)
    finally:
        s.surface = kept


def _of_forms(s: Statement, m: Motion, forms: Sequence[Form], word: str) -> Case:
    f, names = s.f, [*m.q, m.t]
    if word == "integrals":
        stacked = [[*forms, [f.slope(a, x) for x in names]] for a in s.keys("integrals")]
        own = [[f.slope(a, x) for x in names] for a in s.keys("integrals")]
        if len(own) != len(forms):
            raise Unknown("more or fewer integrals than forms")
        trusted = "" if is_nearly(s, _minors(s, own), names) else "that the integrals are independent nearly everywhere"
        return Case([a for rows in stacked for a in _minors(s, rows)], [_minors(s, own)], trusted=trusted)
    if word == "holonomic":
        found = [a for form in forms for a in _wedge(s, form, forms, names)]
    else:
        found = [x for form in forms for x in (form[-1], *(f.slope(a, m.t) for a in form[:-1]))]
    if s.claim[word] is True:
        return Case(found)
    trusted = "" if is_nearly(s, found, names) else f"that the forms are {word} on no open part of the domain"
    return Case([], [found or [f.number(0)]], trusted=trusted)


def _determined(s: Statement, m: Motion, forms: Sequence[Form]) -> Case:
    """The determinant of (∂²L/∂v², −aᵀ; a, 0)."""
    f, L, zero = s.f, s.key("L"), s.f.number(0)
    rows = [[f.slope(f.slope(L, v), w) for w in m.v] for v in m.v]
    rows = [[*row, *(f.mul(f.number(-1), form[k]) for form in forms)] for k, row in enumerate(rows)]
    rows += [[*form[:-1], *(zero for _ in forms)] for form in forms]
    whole = s.determinant(rows)
    if s.claim["determined"] is not True:
        return Case([whole])
    trusted = "that the multipliers are determined at every state, not only at those tried"
    return Case([], [[whole]], trusted="" if is_nowhere_zero(s, whole) else trusted)


def _minors(s: Statement, rows: Sequence[Form]) -> list[int]:
    columns = combinations(range(len(rows[0])), len(rows))
    return [s.determinant([[row[k] for k in chosen] for row in rows]) for chosen in columns]


def _wedge(s: Statement, form: Form, forms: Sequence[Form], names: Sequence[str]) -> list[int]:
    """The coefficients of dω ∧ ω₁ ∧ … ∧ ω_m."""
    f, size, found = s.f, len(forms) + 2, []
    for chosen in combinations(range(len(names)), size):
        terms = []
        for i, j in combinations(range(size), 2):
            rest = [k for n, k in enumerate(chosen) if n not in (i, j)]
            a, b = chosen[i], chosen[j]
            curl = f.sub(f.slope(form[b], names[a]), f.slope(form[a], names[b]))
            minor = s.determinant([[row[k] for k in rest] for row in forms])
            terms.append(f.mul(f.number((-1) ** (i + j + 1)), curl, minor))
        found.append(f.add(*terms))
    return found


def _of_motions(s: Statement, m: Motion, forms: Sequence[Form], lines: Sequence[int], word: str) -> Case:
    f = s.f
    if word != "multipliers":
        moved = s.keys(word)
        zeros = []
        for form in forms:
            terms = [f.mul(c, x) for c, x in zip(form[:-1], moved, strict=True)]
            zeros.append(f.add(*terms, *([form[-1]] if word == "possible" else [])))
        return Case(zeros)
    L, multipliers = s.key("L"), s.keys("multipliers")
    accelerations = dict(zip(m.a, formulas(s, "qddot"), strict=True))
    forces = formulas(s, "forces") if "forces" in s.claim else [f.number(0)] * len(m.q)
    zeros = []
    for k, (q, v, force) in enumerate(zip(m.q, m.v, forces, strict=True)):
        left = f.sub(f.sub(m.rate(f.slope(L, v)), f.slope(L, q)), force)
        reactions = [f.mul(x, form[k]) for x, form in zip(multipliers, forms, strict=True)]
        zeros.append(f.substitute(f.sub(left, f.add(*reactions)), accelerations))
    return Case([*zeros, *(f.substitute(m.rate(a), accelerations) for a in lines)])
