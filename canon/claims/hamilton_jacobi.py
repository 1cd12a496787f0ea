"""Hamilton–Jacobi: a complete integral S(q, α, t) of H(q, ∂S/∂q, t) + ∂S/∂t = 0, or W(q, α) of H(q, ∂W/∂q) = energy.

The momenta never occur: they are ∂S/∂q wherever they stand, in H and in the domain. The solution is complete where
det ∂²S/∂q∂α is not identically 0 (Goldstein, Poole and Safko 2002, sections 10.1 and 10.3; Arnold 1989, section 47).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import sympy as sp

from canon.claims.beside_forward import demanded
from canon.claims.chart import chart_of
from canon.claims.determinant import determinant
from canon.claims.flat_parts import seems_flat_in_parts
from canon.claims.outcome import Outcome, Residual, combined, exact
from canon.claims.own_names import is_free_of
from canon.claims.same_points import has_the_same_points
from canon.claims.special_parameters import not_zero_for_any_parameters
from canon.decide.derivative import derivative, substitute
from canon.decide.nowhere_zero import has_no_zero
from canon.decide.region import Region
from canon.decide.tape import Node
from canon.domain import Domain
from canon.errors import InputError
from canon.expression import Formula

if TYPE_CHECKING:
    from canon.claims.question import Question


def hamilton_jacobi(question: Question) -> Outcome:
    """`hamilton_jacobi`: `S` (or `W` at the `energy`) is a complete integral with these `constants`."""
    H = question.hamiltonian()
    word, function = _integral(question, H)
    space, tape = question.space, question.tape
    energy = question.key("energy")
    constants = _constants(question, energy)
    is_free_of(H, constants, "H", _KEY)
    _only_of(function, word, (*space.q, *constants, *([space.t] if word == "S" else [])), question)
    node = question.load(function)
    q = question.nodes(space.q)
    momenta = [derivative(tape, node, x) for x in q]
    images = dict(zip(question.nodes(space.p), momenta, strict=True))
    domain = _domain(question, constants, H, function, *([energy] if energy is not None else []))
    region = question.region(domain=domain, images=images, chart=chart_of(tape, space, None), regular=False)
    along = substitute(tape, question.load(H), images)
    if word == "S":
        label = "H(q, dS/dq, t) + dS/dt"
        residual = tape.plus(along, derivative(tape, node, tape.symbol(space.t)))
    else:
        assert energy is not None
        label = "H(q, dW/dq) - energy"
        residual = tape.minus(along, question.load(energy))
    outcome = question.decide([Residual(label, residual)], region)
    if outcome.status == "refuted":
        return outcome.with_detail(value=question.show(residual))
    rows = [[derivative(tape, p, tape.symbol(a)) for a in constants] for p in momenta]
    return combined([outcome, _complete(question, word, determinant(tape, rows), constants, region, domain)])


def _integral(question: Question, H: Formula) -> tuple[str, Formula]:
    """The key that is given, "S" or "W", with its formula; **raises** `InputError` for both, for none, for a W in t."""
    given = [word for word in ("S", "W") if question.key(word) is not None]
    if len(given) != 1:
        raise InputError("give S (with `constants`) or W (with `constants` and `energy`), one of them")
    (word,) = given
    if word == "S" and question.key("energy") is not None:
        raise InputError("the energy belongs to W; S holds it in its own terms", "key 'energy'")
    if word == "W":
        if question.key("energy") is None:
            raise InputError("a W needs the key 'energy': the constant, or an expression of the constants")
        if question.space.t in H.symbols:
            raise InputError(f"H depends on {question.space.t}, so there is no W at an energy: give S", "key 'W'")
    return word, question.key(word)


def _constants(question: Question, energy: Formula | None) -> tuple[sp.Symbol, ...]:
    """The n constants; with n − 1 of them, the energy is the n-th. **Raises** `InputError` for another number."""
    found: tuple[sp.Symbol, ...] = tuple(question.key("constants") or ())
    n, space = question.space.n, question.space
    own = None if energy is None else energy.expr
    if len(found) == n - 1 and isinstance(own, sp.Symbol) and own not in found:
        found = (*found, own)
    if len(found) != n:
        raise InputError(f"a complete integral has {n} constants beside an additive one, not {len(found)}", _KEY)
    if len(set(found)) != n or set(found) & {*space.old, space.t}:
        raise InputError("the constants are names of their own, each once, and not among q, p, t", _KEY)
    return found


def _only_of(function: Formula, word: str, allowed: Sequence[sp.Symbol], question: Question) -> None:
    space = question.space
    wrong = function.symbols & ({*space.old, *space.new, space.t} - set(allowed))
    for symbol in sorted(wrong, key=str):
        open_to = "coordinates, constants and time" if word == "S" else "coordinates and constants"
        raise InputError(f"{word} is a function of {open_to}, not of {symbol}", f"key {word!r}")


def _domain(question: Question, constants: Sequence[sp.Symbol], *formulas: Formula) -> Domain:
    """The domain in coordinates, momenta, constants and time.

    A map given forward restricts it, in old variables; what speaks of the new side of another map is left out.
    """
    others = set(question.space.new) - set(constants)
    asked = question.subject.domain
    kept = [c for c in asked.conditions if not any(term.free_symbols & others for term in c.terms)]
    for formula in formulas:
        kept += formula.conditions
    if question.chart.direction == "forward":
        kept += demanded(question, but=constants)
    return Domain(tuple(dict.fromkeys(kept)), asked.surface)


def _complete(
    question: Question, word: str, node: Node, constants: Sequence[sp.Symbol], region: Region, domain: Domain
) -> Outcome:
    """det ∂²S/∂q∂α is not identically 0, whatever the file's parameters are."""
    tape = question.tape
    answer = question.not_identically_zero(node, region)
    shown = question.show(node)
    if answer.status == "refuted":
        zero = exact(
            "refuted", f"det d2{word}/dq dalpha is identically 0: the integral isn't complete", determinant="0"
        )
        return zero
    if answer.status != "proved":
        return Outcome("undecided", method=answer.method, note=f"is det d2{word}/dq dalpha = {shown} identically zero?")
    point = answer.witness.as_table() if answer.witness is not None else {}
    step = {"determinant": shown, "is not 0 at": point}
    parameters = {tape.symbol(s) for s in question.space.parameters if s not in constants}
    fixed = frozenset(tape.support(node) & parameters)
    free = not fixed and not tape.functions_of([node]) and has_the_same_points(tape, region, parameters)
    whole = (
        free
        or (not region.surface and not_zero_for_any_parameters(tape, node, fixed, domain.conditions))
        or has_no_zero(tape, node, region, question.budget)
    )
    note = "" if whole else "complete at one point; not shown at all values of the parameters"
    if whole and seems_flat_in_parts(question, node, region):
        whole, note = False, "complete on a part of the domain; on another the determinant seems to be 0"
    status = "proved" if whole and question.method != "numeric" else "supported"
    return Outcome(status, "nonzero at a point", detail={"determinant": shown}, arguments=(step,), note=note)


_KEY = "key 'constants'"

KINDS = {"hamilton_jacobi": hamilton_jacobi}
