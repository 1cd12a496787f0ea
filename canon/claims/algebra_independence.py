"""Linear independence of functions over the reals, for all values of the parameters."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy as sp
from sympy.polys.matrices import DomainMatrix

from canon.claims.algebra_identity import sign_on_the_domain
from canon.claims.fixed_parameters import fixed_region
from canon.claims.outcome import Outcome, exact
from canon.claims.scale import never_zero
from canon.claims.special_parameters import (
    MEROMORPHIC,
    PLACES,
    denominators,
    not_zero_for_any_parameters,
)
from canon.claims.structure_search import Values, first_values, frame, parameters_of, solve
from canon.claims.units import same_in_other_units
from canon.decide.derivative import substitute
from canon.decide.tape import Node
from canon.errors import InputError
from canon.mechanics.algebra.lie_algebra import LieAlgebra
from canon.mechanics.algebra.rescaling import rescaled
from canon.mechanics.algebra.semisimple import simple_ideals
from canon.mechanics.formulas import replaced
from canon.sign import declared

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.decide.region import Region

BY_POINTS = "a determinant of the functions' values at certified points is not 0"
BY_UNITS = f"{BY_POINTS}, and a change of units takes the parameters there into any others"
BY_IDEALS = "linear relations make an ideal, and no simple ideal is represented by 0"


def independent_outcome(
    question: Question,
    region: Region,
    basis: Sequence[Node],
    variables: Sequence[Node],
    algebra: LieAlgebra,
    further: Sequence[Node] = (),
) -> Outcome:
    """No combination of the functions with real coefficients vanishes on the domain, for any allowed parameters.

    Shown at points for one choice of the parameters; for all others by a change of units, or because the relations
    that hold are an ideal of the algebra (the kernel of a homomorphism), which for a semisimple one contains a simple
    ideal, or by a determinant that is a formula in the parameters. `further` are symbols that are parameters too.
    """
    tape = question.tape
    if tape.functions_of(basis):
        return Outcome("supported", note="independence is shown for particular functions, not for all")
    nodes = [*basis, *region.nodes(), *region.surface]
    used = {x for node in nodes for x in tape.support(node)}
    parameters = sorted({*parameters_of(question, variables, nodes), *(x for x in further if x in used)})
    unit = {x: Fraction(-1 if declared(tape.symbol_at(x)).get("negative") else 1) for x in parameters}
    at_unit = _at(question, region, basis, unit)
    inside = [x for x in parameters if any(x in tape.support(f) for f in basis)]
    if at_unit and not parameters:
        return exact("proved", BY_POINTS)
    everywhere = not region.surface  # what follows speaks of open sets, not of values on a surface
    if everywhere and _by_ideals(question, basis, inside, algebra):
        return exact("proved", BY_IDEALS)
    if at_unit and same_in_other_units(question, region, basis, variables, unit):
        return exact("proved", BY_UNITS)
    if everywhere and _by_places(question, basis, inside):
        return exact("proved", BY_POINTS)
    if _in_each_case(question, region, basis, variables, parameters, algebra, further):
        return exact("proved", f"{BY_UNITS}, for each sign of a parameter")
    somewhere = at_unit or _at(question, region, basis, first_values(question, region, basis, parameters, near=True))
    known = "at one choice of the parameters" if somewhere else "at no point that was tried"
    return Outcome("supported" if somewhere else "undecided", note=f"linear independence of the basis is shown {known}")


def _in_each_case(
    question: Question,
    region: Region,
    basis: Sequence[Node],
    variables: Sequence[Node],
    parameters: Sequence[Node],
    algebra: LieAlgebra,
    further: Sequence[Node],
) -> bool:
    """For a parameter of unknown sign: independence where it is positive, negative and 0."""
    tape = question.tape
    words = ("positive", "negative", "nonnegative", "nonpositive", "integer")
    facts = {x: declared(tape.symbol_at(x)) for x in parameters}
    free = [x for x in parameters if facts[x].get("real") and not any(facts[x].get(word) for word in words)]
    if not free:
        return False
    name, zero = tape.symbol_at(free[0]).name, facts[free[0]].get("zero")
    positive, negative = (tape.symbol(sp.Symbol(name, **{sign: True})) for sign in ("positive", "negative"))
    known = sign_on_the_domain(tape.symbol_at(free[0]), question.domain().conditions)
    cases = {"positive": [positive], "negative": [negative]}.get(
        known or "", [positive, negative, *([tape.zero] if zero is None else [])]
    )
    for value in cases:
        moved = fixed_region(tape, region, {free[0]: value})
        if moved is None:
            return False
        functions = [substitute(tape, f, {free[0]: value}) for f in basis]
        known_too = (*further, *tape.support(value))
        if independent_outcome(question, moved, functions, variables, algebra, known_too).status != "proved":
            return False
    return True


def _at(question: Question, region: Region, basis: Sequence[Node], values: Values) -> bool:
    try:
        found = frame(question, region, basis, [], values)
    except InputError:
        return False
    return found is not None and not found.chosen and solve(found).independent


def _by_ideals(question: Question, basis: Sequence[Node], parameters: Sequence[Node], algebra: LieAlgebra) -> bool:
    """For a semisimple algebra: an element of each simple ideal is never identically 0, for any parameters."""
    scaled = rescaled(algebra)
    if scaled is None or scaled.algebra.killing_form().rank() < algebra.dimension:
        return False
    try:
        ideals = simple_ideals(scaled.algebra)
    except ArithmeticError:
        return False
    anything = (tuple(Fraction(int(k == 0)) for k in range(algebra.dimension)),)
    if len(ideals) > 1 and any(ideal.basis is None for ideal in ideals):
        return False
    return bool(ideals) and all(
        any(_never_zero(question, basis, parameters, row, scaled.scales) for row in ideal.basis or anything)
        for ideal in ideals
    )


def _never_zero(
    question: Question,
    basis: Sequence[Node],
    parameters: Sequence[Node],
    row: Sequence[Fraction],
    scales: Sequence[Any],
) -> bool:
    tape = question.tape
    terms = [
        tape.times(tape.number(c), question.load(scale), f) for c, scale, f in zip(row, scales, basis, strict=True) if c
    ]
    return not_zero_for_any_parameters(tape, tape.plus(*terms), frozenset(parameters), question.domain().conditions)


def _by_places(question: Question, basis: Sequence[Node], parameters: Sequence[Node]) -> bool:
    """For formulas without branches: a determinant of values at some places is 0 for no parameters.

    At a place where a denominator may vanish for some of them they prove nothing: a/(a + x − 1) is 1 at x = 1, but for
    a = 0 it is 0 throughout.
    """
    tape = question.tape
    operations = [tape.ops[i] for i in tape.reach(basis)]
    if any(op[0] in ("r", "u") or (op[0] == "f" and op[1] not in MEROMORPHIC) for op in operations):
        return False
    variables = sorted({x for f in basis for x in tape.support(f)} - set(parameters))
    below, conditions = denominators(tape, basis, variables), question.domain().conditions
    some = {tape.symbol_at(x): sp.Rational(7 + 3 * k, 5 + k) for k, x in enumerate(parameters)}
    rows: list[list[Any]] = []
    rank = 0
    for shift in range(3 * len(basis)):
        place = PLACES[shift % (len(PLACES) - 1)]
        values = {x: tape.number(place[(k + shift) % len(place)] + shift) for k, x in enumerate(variables)}
        try:
            if not all(never_zero(tape.to_sympy(substitute(tape, d, values)), conditions) for d in below):
                continue
            row: list[Any] = [tape.to_sympy(substitute(tape, f, values)) for f in basis]
        except (InputError, ZeroDivisionError):
            continue
        wider = DomainMatrix.from_Matrix(sp.Matrix([[replaced(v, some) for v in r] for r in (*rows, row)])).to_field()
        if wider.rank() > rank:
            rows, rank = [*rows, row], rank + 1
        if rank == len(basis):
            determinant = DomainMatrix.from_Matrix(sp.Matrix(rows)).to_field().det()
            value: Any = sp.factor(
                determinant.as_expr() if hasattr(determinant, "as_expr") else sp.sympify(determinant)
            )
            return never_zero(value, conditions)
    return False
