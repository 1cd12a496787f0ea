"""Birkhoff–Gustavson normal forms: {H₂, N} = 0, and N is reached from H by a near-identity canonical map.

At resonance N isn't unique. Whether the N claimed is one of them is decided by `reached`, over the rational numbers, an
algebraic field, or rational functions of the file's parameters; there a proof holds where no denominator that was used
vanishes, and a refutation names values of the parameters.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims.chart import chart_of
from canon.claims.key_tables import HIGHEST_DEGREE
from canon.claims.outcome import Outcome, Residual
from canon.claims.reached import THEOREM, Comparison, compared
from canon.claims.scale import never_zero
from canon.claims.show import shown
from canon.deadline import within
from canon.decide.derivative import poisson_bracket
from canon.decide.region import Region
from canon.decide.search import samples
from canon.domain import Condition, Domain
from canon.errors import InputError
from canon.expression import Formula
from canon.mechanics.birkhoff import resonances
from canon.mechanics.graded_algebra import Polynomial, terms
from canon.substitution import replaced

if TYPE_CHECKING:
    from canon.claims.question import Question

PLACES = 3
EXACTLY = "linear algebra, degree by degree"


def normal_form(question: Question) -> Outcome:
    """`normal_form`: H₂ + `N` is a Birkhoff–Gustavson normal form of H about the origin to the `order`."""
    H, order, N = question.hamiltonian(), question.key("order"), _table(question)
    conditions = _conditions(question, H, *N.values())
    region = _at_the_origin(question, conditions)
    if question.method == "numeric":
        return _sampled(question, H, N, region)
    expressions = {degree: formula.expr for degree, formula in N.items()}
    try:
        found = compared(question.space.old, H.expr, expressions, order, question.budget.check)
    except (ValueError, ArithmeticError) as reason:
        return Outcome("undecided", note=f"outside of what is computed exactly: {reason}")
    detail: dict[str, Any] = {"order": order}
    near = resonances(question.space, found.algebra.expression(found.parts[2]), order)
    if near is not None:
        detail["resonances"] = [str(k) for k in near]
    if found.holds:
        return _holds(question, found, region, conditions).with_detail(**detail)
    parameters = _parameters(question, H.expr, expressions)
    if not parameters:
        outcome = question.refuted_exactly(region, f"{found.reason}; {THEOREM}")
        return outcome.with_detail(**detail, **_failure(question, found))
    for values in _points(question, parameters, region):
        there = _at(question, H.expr, expressions, values)
        if isinstance(there, Outcome):
            return replace(there, detail={**detail, **there.detail})
    return Outcome(
        "undecided", detail=detail, note="fails at generic values of the parameters, but at none that was tried"
    )


def _table(question: Question) -> dict[int, Formula]:
    """`N` by degree; **raises** `InputError` for degrees above the order, and parts that aren't of their degree."""
    order, table = question.key("order"), question.key("N") or {}
    space = question.space
    if order > HIGHEST_DEGREE:
        raise InputError(f"an order up to {HIGHEST_DEGREE} is expected, not {order}", "key 'order'")
    if space.t in question.hamiltonian().symbols:
        raise InputError(f"H depends on {space.t}: a normal form is one of an H without time")
    for degree, formula in table.items():
        where = f"key 'N', degree {degree}"
        if degree > order:
            raise InputError(f"the order is {order}", where)
        question.checked(formula, f"N, degree {degree}", "old")
        if space.t in formula.symbols:
            raise InputError(f"N depends on {space.t}", where)
        wrong = within(
            question.budget, lambda degree=degree, expr=formula.expr: _not_of_degree(expr, space.old, degree)
        )
        if wrong:
            raise InputError(wrong, where)
    return dict(table)


def _not_of_degree(expr: sp.Expr, variables: Sequence[sp.Symbol], degree: int) -> str:
    """What keeps a formula from being a homogeneous polynomial of this degree; nothing where it is one."""
    expanded = sp.expand(expr)
    if expanded.is_zero:
        return ""
    if not expanded.is_polynomial(*variables):
        return "a polynomial in the variables is expected"
    if any(sum(powers) != degree for powers in sp.Poly(expanded, *variables).monoms()):
        return f"not homogeneous of degree {degree}"
    return ""


def _conditions(question: Question, *formulas: Formula) -> tuple[Condition, ...]:
    """The domain's conditions; what speaks of a map's new side is left out."""
    asked = question.subject.domain
    if asked.surface:
        raise InputError("a normal form is one about the origin of the whole phase space, not of a surface")
    others = {*question.space.new}
    found = [c for c in asked.conditions if not any(term.free_symbols & others for term in c.terms)]
    for formula in formulas:
        found += formula.conditions
    return tuple(dict.fromkeys(found))


def _at_the_origin(question: Question, conditions: Sequence[Condition]) -> Region:
    """What they say of the parameters at the origin; **raises** `InputError` where the origin isn't inside."""
    space, tape = question.space, question.tape
    origin = dict.fromkeys(space.old, sp.S.Zero)
    for x in space.old:
        if x.is_zero is False:
            raise InputError(f"{x} is assumed not to be 0, but a normal form is one about the origin")
        if x.is_extended_nonnegative or x.is_extended_nonpositive:
            raise InputError(f"{x} is assumed to have one sign, but a normal form is one about the origin, inside")
    for condition in conditions:
        there = [term.xreplace(origin) for term in condition.terms]
        first = there[0]
        bad = any(value.has(sp.zoo, sp.nan, sp.oo) for value in there)
        if condition.kind in ("positive", "slit"):
            bad = bad or bool(first.is_nonpositive)
        elif condition.kind == "nonzero":
            bad = bad or bool(first.is_zero)
        if bad:
            raise InputError(f"the origin, about which a normal form is made, isn't inside the domain: {condition}")
    images = {tape.symbol(x): tape.zero for x in space.old}
    domain, plain = Domain(tuple(conditions)), chart_of(tape, space, None)
    return question.region(domain=domain, images=images, chart=plain, assumed=False)


def _holds(question: Question, found: Comparison, region: Region, conditions: Sequence[Condition]) -> Outcome:
    """Proved, where no denominator that was used vanishes at any values of the parameters."""
    (somewhere,) = question.decide([Residual("0", question.tape.zero)], region).findings
    if somewhere.answer.status != "proved":
        return Outcome("undecided", note="no point of the domain could be certified")
    step = {"theorem": THEOREM, "maps": list(found.maps)}
    vanishing = [below for below in _denominators(found, found.used) if not never_zero(below, conditions)]
    status = "supported" if vanishing else "proved"
    note = "proved but where " + " or ".join(f"{below} = 0" for below in vanishing[:4]) if vanishing else ""
    return Outcome(status, EXACTLY, arguments=(step,), note=note)


def _denominators(found: Comparison, used: Iterable[Polynomial]) -> list[sp.Expr]:
    below: dict[sp.Expr, None] = {}
    for polynomial in used:
        for _, c in terms(polynomial):
            denominator = sp.fraction(sp.together(found.algebra.value(c)))[1]
            if denominator.free_symbols:
                below[denominator] = None
    products: list[Any] = [sp.factor(d) for d in below]
    factors = {base for product in products for base in sp.Mul.make_args(product)}
    plain = {base.base if isinstance(base, sp.Pow) else base for base in factors}
    return sorted((base for base in plain if base.free_symbols), key=str)


def _failure(question: Question, found: Comparison) -> dict[str, Any]:
    """What fails, and where N isn't reached, a part of that degree that would be."""
    detail = {"fails": f"N{found.fails_at}", "fails_at_degree": found.fails_at, "why": found.reason}
    if found.reachable is not None:
        detail["value"] = shown(question.tape, question.tape.load(found.algebra.expression(found.reachable)))
    return detail


def _points(question: Question, names: list[sp.Symbol], region: Region) -> Iterator[Mapping[sp.Symbol, sp.Expr]]:
    """Rational values of the parameters in the domain."""
    tape, rng = question.tape, random.Random(question.seed)
    nodes = question.nodes(names)
    for sample in samples(tape, nodes, region, rng, count=PLACES, budget=question.budget, nice=True):
        values = {name: sample.point.get(node) for name, node in zip(names, nodes, strict=True)}
        if all(isinstance(value, Fraction) for value in values.values()):
            yield {s: sp.Rational(v.numerator, v.denominator) for s, v in values.items() if isinstance(v, Fraction)}


def _sampled(question: Question, H: Formula, N: Mapping[int, Formula], inside: Region) -> Outcome:
    """Balls for {H₂, N} = 0; that N is reached from H, at a few values of the parameters."""
    space, tape = question.space, question.tape
    origin = dict.fromkeys(space.old, sp.S.Zero)
    slopes = [[replaced(H.expr.diff(x, y), origin) for y in space.old] for x in space.old]
    H2 = sp.Add(
        *(a * x * y / 2 for row, x in zip(slopes, space.old, strict=True) for a, y in zip(row, space.old, strict=True))
    )
    q, p = question.nodes(space.q), question.nodes(space.p)
    brackets = (
        Residual(f"{{H2, N{degree}}}", poisson_bracket(tape, question.load(H2), question.load(part), q, p))
        for degree, part in N.items()
    )
    region = question.region(H, *N.values(), chart=chart_of(tape, space, None), domain=question.subject.domain)
    outcome = question.decide(brackets, region)
    if outcome.status != "supported":
        return outcome
    expressions: dict[int, Any] = {degree: formula.expr for degree, formula in N.items()}
    parameters = _parameters(question, H.expr, expressions)
    reached = 0
    for values in _points(question, parameters, inside) if parameters else [{}]:
        there = _at(question, H.expr, expressions, values)
        if isinstance(there, Outcome):
            return replace(there if parameters else _refuted_inside(question, there, inside), numeric=outcome.numeric)
        reached += there
    if not reached:
        return outcome.with_status("undecided", "{H2, N} = 0 was sampled; that N is reached from H wasn't decided")
    where = f" at {reached} choices of the parameters" if parameters else ""
    return outcome.with_status("supported", f"N is reached from H{where}, by linear algebra in rational numbers")


def _refuted_inside(question: Question, refuted: Outcome, inside: Region) -> Outcome:
    """A refutation without values of parameters, for a domain that is shown to have a point."""
    exactly = question.refuted_exactly(inside, f"{refuted.arguments[0]['fails']}; {THEOREM}")
    return exactly.with_detail(**refuted.detail) if exactly.status == "refuted" else exactly


def _parameters(question: Question, H: Any, N: Mapping[int, Any]) -> list[sp.Symbol]:
    names = sorted(set().union(H.free_symbols, *(e.free_symbols for e in N.values())), key=str)
    return [s for s in names if isinstance(s, sp.Symbol) and s not in question.space.old]


def _at(question: Question, H: Any, N: Mapping[int, Any], values: Mapping[sp.Symbol, sp.Expr]) -> Outcome | bool:
    """Whether N is reached at values of the parameters: a refutation there, True, or False where it isn't decided."""
    rules: Any = dict(values)
    here = {degree: e.xreplace(rules) for degree, e in N.items()}
    order = question.key("order")
    try:
        there = compared(question.space.old, H.xreplace(rules), here, order, question.budget.check)
    except (ValueError, ArithmeticError, InputError):
        return False
    if there.holds:
        return True
    witness = {str(name): str(value) for name, value in values.items()}
    step = {"theorem": THEOREM, "at": witness, "fails": there.reason}
    detail = {"order": order, **_failure(question, there)}
    return Outcome("refuted", EXACTLY, witness=witness or None, detail=detail, arguments=(step,))


KINDS = {"normal_form": normal_form}
