"""What a map leaves alone: volume, Poincaré's integral invariants, the form of Poincaré–Cartan, brackets.

All of it is compared in the chart's coordinates, in which old and new variables are explicit. Of a map that is
canonical with a constant scale c the determinant is cⁿ and the k-th power of Σdp∧dq is multiplied by cᵏ.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations
from typing import TYPE_CHECKING

from canon.claims.determinant import determinant, lagrange_matrix, pfaffian
from canon.claims.outcome import Outcome, Residual, combined, exact
from canon.claims.scale import constant_scale
from canon.decide.defined_functions import conjugate
from canon.decide.derivative import derivative, poisson_bracket
from canon.decide.region import Region, Requirement
from canon.decide.tape import Node, Unsupported
from canon.errors import InputError

if TYPE_CHECKING:
    from canon.claims.question import Question


def volume(question: Question) -> Outcome:
    """`volume`: |det M| = 1, with the determinant's sign (of a complex map: its phase)."""
    question.square_map()
    region = question.region()
    tape, n = question.tape, question.space.n
    if n > 1 or question.chart.direction == "implicit":
        constant = constant_scale(replace(question, budget=question.budget.share(0.5)), region)
        if constant.status == "proved" and constant.node is not None:
            value = tape.power(constant.node, n)
            return combined([constant.outcome, _of_modulus_one(question, value, tape.one, region)])
        if question.chart.direction == "implicit":
            return constant.outcome
    chart = question.chart
    return _of_modulus_one(
        question, determinant(tape, chart.jacobian(chart.new)), determinant(tape, chart.jacobian(chart.old)), region
    )


def _of_modulus_one(question: Question, new: Node, old: Node, region: Region) -> Outcome:
    """|new| = |old|: the phase where it is one of ±1, ±i, else the moduli."""
    tape = question.tape
    phases: list[tuple[str, Node]] = [("1", tape.one), ("-1", tape.number(-1))]
    if tape.is_complex(new) or tape.is_complex(old):
        unit = tape.constant("I")
        phases += [("1j", unit), ("-1j", tape.negative(unit))]
    for name, phase in phases:
        outcome = question.decide([Residual(f"det M = {name}", tape.minus(new, tape.times(phase, old)))], region)
        if outcome.status in ("proved", "supported"):
            return outcome.with_detail(determinant=name)
        if outcome.status == "undecided" and question.budget.spent():
            return outcome
    if tape.value(old) == 0:
        raise InputError("the map is nowhere invertible")
    ratio = tape.mul([(new, 1), (old, -1)])
    try:
        moduli = [
            tape.times(node, conjugate(tape, node)) if tape.is_complex(node) else tape.power(node, 2)
            for node in (new, old)
        ]
    except Unsupported as reason:
        regular = region.also(Requirement("nonzero", (old,), "the map is invertible"))
        found = _holomorphic(question, ratio, regular)
        return (found or Outcome("undecided", note=str(reason))).with_detail(determinant=question.show(ratio))
    residual = Residual("|det M|**2 = 1", tape.minus(*moduli), ratio)
    outcome = question.decide([residual], region)
    sign = "of modulus 1; its sign or phase is not the same everywhere, or not found"
    return outcome.with_detail(determinant=sign if outcome.status == "proved" else question.show(ratio))


def _holomorphic(question: Question, ratio: Node, region: Region) -> Outcome | None:
    """A refutation by the open mapping theorem: the determinant depends on a complex variable."""
    tape = question.tape
    for u in sorted(tape.support(ratio)):
        if tape.symbol_at(u).is_real or region.surface:
            continue
        answer = question.not_identically_zero(derivative(tape, ratio, u), region)
        if answer.status == "proved":
            theorem = "a holomorphic function of constant modulus is constant"
            return exact("refuted", theorem, depends_on=str(tape.symbol_at(u)))
    return None


def integral_invariant(question: Question) -> Outcome:
    """`integral_invariant`: the `order`-th power of Σdp∧dq is preserved (order n: det M = +1)."""
    question.square_map()
    n, tape = question.space.n, question.tape
    order = question.key("order", 1)
    if isinstance(order, bool) or not isinstance(order, int) or not 1 <= order <= n:
        raise InputError(f"an order from 1 to {n} is expected, not {order}", "key 'order'")
    region = question.region()
    constant = constant_scale(replace(question, budget=question.budget.share(0.5)), region)
    if constant.status == "proved" and constant.node is not None:
        power = tape.power(constant.node, order)
        claimed = question.decide([Residual(f"scale**{order} = 1", tape.minus(power, tape.one), power)], region)
        return combined([constant.outcome, claimed]).with_detail(order=order)
    if question.chart.direction == "implicit":
        return constant.outcome
    return question.decide(_power_residuals(question, order), region).with_detail(order=order)


def _power_residuals(question: Question, order: int) -> Iterator[Residual]:
    """The components of the difference of the two 2·order-forms (Pfaffians of the Lagrange brackets)."""
    tape, chart = question.tape, question.chart
    new = lagrange_matrix(tape, chart.jacobian(chart.new))
    old = lagrange_matrix(tape, chart.jacobian(chart.old))
    names = [str(tape.symbol_at(u)) for u in chart.coordinates]
    for indices in combinations(range(len(names)), 2 * order):
        actual = pfaffian(tape, new, indices)
        label = "component " + ", ".join(names[i] for i in indices)
        yield Residual(label, tape.minus(actual, pfaffian(tape, old, indices)), actual)


def cartan_invariant(question: Question) -> Outcome:
    """`cartan_invariant`: p dq − H dt − (P dQ − K dt) is exact in the extended phase space.

    It is refuted where it isn't closed, or where its integral round a loop in the domain isn't 0. Closed, it is proved
    with a potential that is smooth throughout the domain (the generating function as a function of the chart's
    coordinates), or on a domain all of whose loops can be contracted; else supported.
    """
    question.square_map()
    H, K = question.hamiltonian(), question.formula("K", "new")
    singular = _singular(question)
    if singular is not None:
        return singular
    region = question.region(K)
    outcome = question.decide(_cartan_residuals(question, question.load(H), question.load(K)), region)
    if outcome.status != "proved" or question.method == "numeric":
        return outcome
    from canon.claims.exactness import exact_throughout
    from canon.claims.potential import cartan_slopes

    return exact_throughout(question, outcome, cartan_slopes(question, question.load(H), question.load(K)), region)


def _singular(question: Question) -> Outcome | None:
    """A refutation where the file has nothing but a generating function that defines no map."""
    if question.chart.direction != "implicit":
        return None
    from canon.claims.generating_function import hessian_outcome

    outcome = hessian_outcome(question, solving=False)
    return outcome if outcome.status == "refuted" else None


def _cartan_residuals(question: Question, H: Node, K: Node) -> Iterator[Residual]:
    tape, chart = question.tape, question.chart
    names = [*(str(tape.symbol_at(u)) for u in chart.coordinates), str(tape.symbol_at(chart.time))]
    new = lagrange_matrix(
        tape, [[*row, s] for row, s in zip(chart.jacobian(chart.new), chart.by_time(chart.new), strict=True)]
    )
    old = lagrange_matrix(
        tape, [[*row, s] for row, s in zip(chart.jacobian(chart.old), chart.by_time(chart.old), strict=True)]
    )
    last = len(names) - 1
    for a, b in combinations(range(last), 2):
        yield Residual(f"d{names[a]}^d{names[b]}", tape.minus(new[a][b], old[a][b]))
    difference = tape.minus(chart.pull(K), chart.pull(H))
    for a in range(last):
        slope = derivative(tape, difference, chart.coordinates[a])
        yield Residual(f"d{names[a]}^d{names[last]}", tape.plus(tape.minus(new[a][last], old[a][last]), slope))


def bracket_invariance(question: Question) -> Outcome:
    """`bracket_invariance`: {f, g} is the same function in either set of variables."""
    question.map  # noqa: B018 - there must be one
    f, g = question.formula("f", "new"), question.formula("g", "new")
    singular = _singular(question)
    if singular is not None:
        return singular
    region = question.region(f, g)
    tape, chart, space = question.tape, question.chart, question.space
    F, G = question.load(f), question.load(g)
    inner = chart.pull(poisson_bracket(tape, F, G, question.nodes(space.Q), question.nodes(space.P)))
    if chart.direction == "forward":
        half = len(chart.coordinates) // 2
        outer = poisson_bracket(tape, chart.pull(F), chart.pull(G), chart.coordinates[:half], chart.coordinates[half:])
        return question.decide([Residual("{f, g}", tape.minus(outer, inner), outer)], region)
    question.square_map()
    return _invariance_without_inverse(question, chart.pull(F), chart.pull(G), inner, region)


def _invariance_without_inverse(question: Question, F: Node, G: Node, inner: Node, region: Region) -> Outcome:
    """The bracket in the old variables of functions of the chart's coordinates, without their inverse.

    With L the Lagrange brackets of the coordinates, it is −∇FᵀL⁻¹∇G; it is compared after a multiplication by
    Pf L, which is not 0 where the map is one.
    """
    tape, chart = question.tape, question.chart
    lagrange = lagrange_matrix(tape, chart.jacobian(chart.old))
    size = len(chart.coordinates)
    everything = tuple(range(size))
    whole = pfaffian(tape, lagrange, everything)
    slopes_f = [derivative(tape, F, u) for u in chart.coordinates]
    slopes_g = [derivative(tape, G, u) for u in chart.coordinates]
    terms = []
    for i, j in combinations(everything, 2):
        minor = tape.minus(tape.times(slopes_f[i], slopes_g[j]), tape.times(slopes_f[j], slopes_g[i]))
        if tape.value(minor) == 0:
            continue
        rest = pfaffian(tape, lagrange, [k for k in everything if k not in (i, j)])
        terms.append((tape.times(rest, minor), -1 if (i + j) % 2 == 0 else 1))
    scaled = tape.add(terms)
    actual = tape.mul([(scaled, 1), (whole, -1)]) if tape.value(whole) != 0 else tape.zero
    regular = region.also(Requirement("nonzero", (whole,), "the map is invertible"))
    return question.decide([Residual("{f, g}", tape.minus(scaled, tape.times(whole, inner)), actual)], regular)


KINDS = {
    "volume": volume,
    "integral_invariant": integral_invariant,
    "cartan_invariant": cartan_invariant,
    "bracket_invariance": bracket_invariance,
}
