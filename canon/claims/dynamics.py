"""Hamilton's equations, Hamiltonian vector fields, the Legendre transform, infinitesimal transformations."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import TYPE_CHECKING

from canon.claims.chart import chart_of
from canon.claims.flat_parts import regular_in_parts
from canon.claims.independence import full_rank
from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.own_names import is_free_of
from canon.claims.show import with_value
from canon.claims.velocities import region_in_velocities, velocity_names
from canon.decide.derivative import derivative, substitute
from canon.decide.tape import Node
from canon.errors import InputError
from canon.expression import Formula

if TYPE_CHECKING:
    from canon.claims.question import Question


def _pulled(question: Question, label: str, node: Node, actual: Node | None = None) -> Residual:
    chart = question.chart
    return Residual(label, chart.pull(node), None if actual is None else chart.pull(actual))


def equations_of_motion(question: Question) -> Outcome:
    """`equations_of_motion`: q̇ = ∂H/∂p and ṗ = −∂H/∂q are `qdot`, `pdot`."""
    H = question.hamiltonian()
    qdot, pdot = question.formulas("qdot", question.space.n), question.formulas("pdot", question.space.n)
    region = question.region(*qdot, *pdot)
    return with_value(question, question.decide(_flow(question, question.load(H), qdot, pdot, ("{}'", "{}'")), region))


def infinitesimal(question: Question) -> Outcome:
    """`infinitesimal`: δω = ε J ∂G/∂ω: `dq` is ∂G/∂p and `dp` is −∂G/∂q."""
    G = question.formula("generator")
    dq, dp = question.formulas("dq", question.space.n), question.formulas("dp", question.space.n)
    region = question.region(G, *dq, *dp)
    return with_value(
        question, question.decide(_flow(question, question.load(G), dq, dp, ("delta {}", "delta {}")), region)
    )


def _flow(
    question: Question, H: Node, first: tuple[Formula, ...], second: tuple[Formula, ...], words: tuple[str, str]
) -> Iterator[Residual]:
    """J∇H less the field given."""
    tape, space = question.tape, question.space
    for x, y, given in zip(space.q, space.p, first, strict=True):
        actual = derivative(tape, H, tape.symbol(y))
        yield _pulled(question, words[0].format(x), tape.minus(actual, question.load(given)), actual)
    for x, y, given in zip(space.q, space.p, second, strict=True):
        actual = tape.negative(derivative(tape, H, tape.symbol(x)))
        yield _pulled(question, words[1].format(y), tape.minus(actual, question.load(given)), actual)


def hamiltonian_field(question: Question) -> Outcome:
    """`hamiltonian_field`: the field is locally Hamiltonian: −ṗ dq + q̇ dp is closed (with `H`: it is dH).

    Without `H` one is looked for and, where it is found and verified, reported.
    """
    n, tape = question.space.n, question.tape
    qdot, pdot = question.formulas("qdot", n), question.formulas("pdot", n)
    if question.key("H") is not None:
        H = question.formula("H")
        region = question.region(H, *qdot, *pdot)
        flow = _flow(question, question.load(H), qdot, pdot, ("{}'", "{}'"))
        return with_value(question, question.decide(flow, region))
    region = question.region(*qdot, *pdot)
    slopes = [tape.negative(question.load(f)) for f in pdot] + [question.load(f) for f in qdot]
    variables = question.nodes(question.space.old)

    def curls() -> Iterator[Residual]:
        for a, b in combinations(range(2 * n), 2):
            curl = tape.minus(derivative(tape, slopes[b], variables[a]), derivative(tape, slopes[a], variables[b]))
            label = f"d{question.space.old[a]}^d{question.space.old[b]}"
            yield _pulled(question, label, curl, curl)

    outcome = question.decide(curls(), region)
    if outcome.status != "proved" or question.method == "numeric":
        return with_value(question, outcome)
    from canon.claims.potential import verified_potential

    found = verified_potential(question, slopes, variables, region)
    return outcome.with_detail(H=None if found is None else str(found))


def legendre(question: Question) -> Outcome:
    """`legendre`: with p = ∂L/∂q̇, H is Σ p q̇ − L, and det ∂²L/∂q̇² is not identically 0."""
    H, space, tape = question.hamiltonian(), question.space, question.tape
    L = question.formula("L")
    velocities = velocity_names(question, "velocities")
    for symbol in sorted(L.symbols & set(space.p), key=str):
        raise InputError(f"L is a function of coordinates and velocities, not of {symbol}", "key 'L'")
    is_free_of(H, velocities, "H", "key 'velocities'")
    v, node = question.nodes(velocities), question.load(L)
    momenta = [derivative(tape, node, x) for x in v]
    images = dict(zip(question.nodes(space.p), momenta, strict=True))
    region = region_in_velocities(question, L, carried=[H], images=images)
    plain = chart_of(tape, space, None)
    energy = tape.minus(tape.plus(*(tape.times(x, p) for x, p in zip(v, momenta, strict=True))), node)
    along = substitute(tape, question.load(H), images)
    outcome = question.decide([Residual("H - (p v - L)", tape.minus(along, energy), energy)], region)
    shown = {str(y): question.show(p) for y, p in zip(space.p, momenta, strict=True)}
    if outcome.status == "refuted":
        return outcome.with_detail(momenta=shown, value=question.show(energy))
    rows = [[derivative(tape, p, x) for x in v] for p in momenta]
    regular = full_rank(question, rows, v, region, everywhere=False, chart=plain)
    if regular.status == "refuted":
        regular = regular.with_detail(hessian="det d2L/dv2 is identically 0")
    regular = regular_in_parts(question, rows, region, regular)
    return combined([outcome, regular]).with_detail(momenta=shown)


KINDS = {
    "equations_of_motion": equations_of_motion,
    "infinitesimal": infinitesimal,
    "hamiltonian_field": hamiltonian_field,
    "legendre": legendre,
}
