"""`group`: a composition function θ(a, b) is a local group law with given structure constants.

About the identity, θ^i(a, b) = a^i + b^i + f^i_jk a^j b^k + …, and C^i_jk = f^i_kj − f^i_jk: with T(θ) = 1 + i θ^j t_j
+ … and T(a) T(b) = T(θ(a, b)) the generators satisfy [t_j, t_k] = i C^i_jk t_i. What holds of the germs at 0 is decided
as identities near 0; what doesn't is refuted by a Taylor coefficient at 0, or at a point of a box around it throughout
which everything is smooth, since elsewhere another branch may be met.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations_with_replacement
from math import comb
from random import Random
from typing import TYPE_CHECKING, Any

import sympy as sp
from flint import arb, fmpq

from canon.claims.algebra_identity import identity_outcome
from canon.claims.fixed_parameters import fixed_region, moved_region
from canon.claims.matrix_algebra import compared
from canon.claims.outcome import Outcome, Residual, combined
from canon.claims.show import neat
from canon.decide.derivative import derivative, substitute
from canon.decide.enclosure import OutOfDomain, evaluate, precision
from canon.decide.region import Region, Requirement, holds
from canon.decide.tape import Node, Tape, Unsupported
from canon.errors import InputError
from canon.mechanics.algebra.lie_algebra import LieAlgebra

if TYPE_CHECKING:
    from canon.claims.question import Question

NEAR = Fraction(1, 16)
HIGHEST, MOST_COEFFICIENTS = 3, 3000
SLOPES = tuple(sign * n for n in (1, 2, 3, 5, 7, 11, 13, 17, 19, 23) for sign in (1, -1))
LOCAL = "a Taylor coefficient at the identity differs"


@dataclass(frozen=True)
class Law:
    """A composition function on the tape: θ(a, b) with `first` a, `second` b, and `third` names for associativity."""

    tape: Tape
    theta: tuple[Node, ...]
    first: tuple[Node, ...]
    second: tuple[Node, ...]
    third: tuple[Node, ...]

    def of(self, a: Sequence[Node], b: Sequence[Node]) -> tuple[Node, ...]:
        """θ(a, b) for other arguments."""
        images = dict(zip((*self.first, *self.second), (*a, *b), strict=True))
        return tuple(substitute(self.tape, f, images) for f in self.theta)


def group(question: Question) -> Outcome:
    """Identity, associativity near it, and the structure constants of the second-order Taylor coefficients."""
    if question.key("brackets") is None and question.key("equals") is None:
        raise InputError("a claim of kind 'group' needs 'equals', the name of an algebra, or 'structure'")
    for word in ("first", "second"):
        for symbol in question.key(word) or ():
            if symbol.is_zero is False:
                raise InputError(
                    f"{symbol} is assumed not to be 0, but the identity is where all are 0", f"key {word!r}"
                )
    if question.key("matrix") is not None:
        return _by_matrices(question)
    law = law_of(question)
    coefficients = [v for row in (question.key("brackets") or {}).values() for v in row.values()]
    region = question.region(*question.key("composition"), *coefficients)
    at_zero = fixed_region(question.tape, region, dict.fromkeys((*law.first, *law.second), question.tape.zero))
    if at_zero is None:
        raise InputError("the composition isn't smooth at the identity, where all parameters are 0")
    question.decide([Residual("0", question.tape.zero)], at_zero)  # raises where no point is shown to meet all of it
    outcomes = [*_identity(question, law, region, at_zero)]
    if all(outcome.status != "refuted" for outcome in outcomes):
        outcomes.append(_associative(question, law, region, at_zero))
    refuted = next((outcome for outcome in outcomes if outcome.status == "refuted"), None)
    if refuted is not None:
        return refuted
    try:
        algebra = structure_constants(question, law)
    except InputError as error:  # of an associative law it can't be false, but zeros may go unrecognised
        return Outcome("undecided", note=f"of the structure constants it isn't known that {error.message}")
    return _with_constants(question, at_zero, outcomes, algebra)


def _with_constants(question: Question, at_zero: Region, outcomes: list[Outcome], algebra: LieAlgebra) -> Outcome:
    """The outcome of a group law, with that of what is claimed of its structure constants."""
    if question.key("brackets") is not None:
        outcomes.append(compared(question, at_zero, algebra, question.key("brackets")))
    outcomes.append(identity_outcome(question, at_zero, algebra, question.key("equals")))
    found = {f"{a},{b}": value for a, b, value in algebra.rows()}
    return combined(outcomes).with_detail(structure=found if len(found) <= 20 else f"{len(found)} brackets")


def _by_matrices(question: Question) -> Outcome:
    """The same of M(θ) in place of the composition of parameters."""
    from canon.claims import group_of_matrices

    if question.key("composition") is not None or question.key("second") is not None:
        raise InputError("'matrix' stands in place of 'composition' and 'second'", "key 'matrix'")
    try:
        outcomes, at_zero = group_of_matrices.outcomes(question)
        refuted = next((outcome for outcome in outcomes if outcome.status == "refuted"), None)
        if refuted is not None:
            return refuted
        algebra = group_of_matrices.constants(question)
    except group_of_matrices.NoChart as error:
        return Outcome("undecided", note=error.message)
    return _with_constants(question, at_zero, outcomes, algebra)


def law_of(question: Question) -> Law:
    """The claim's composition function; **raises** `InputError` where names don't fit it."""
    for word in ("composition", "second"):
        if question.key(word) is None:
            raise InputError(f"a claim of kind 'group' needs '{word}', or a 'matrix' of the parameters 'first'")
    if question.key("inverse") is not None:
        raise InputError("an inverse is given, but no 'matrix'", "key 'inverse'")
    tape, names = question.tape, [question.key("first"), question.key("second")]
    composition = question.key("composition")
    for word, given in zip(("first", "second"), names, strict=True):
        if len(given) != len(composition):
            raise InputError(f"{len(given)} names for {len(composition)} components", f"key {word!r}")
    if set(names[0]) & set(names[1]):
        raise InputError("a name is among the first and among the second parameters", "key 'second'")
    a, b = (tuple(question.nodes(given)) for given in names)
    taken = {*question.space.vocabulary, *map(str, (*names[0], *names[1]))}
    third = tuple(tape.symbol(sp.Symbol(_unused(f"{symbol}_third", taken), real=True)) for symbol in names[1])
    theta = tuple(question.load(f) for f in composition)
    if any(map(tape.is_complex, theta)):  # θ(a, b) is an element of the group again
        raise InputError("a group has real parameters, and the composition is not seen to be real", "key 'composition'")
    return Law(tape, theta, a, b, third)


def _unused(name: str, taken: set[str]) -> str:
    """The name, or one like it that the file doesn't have."""
    while name in taken:
        name += "_"
    return name


def structure_constants(question: Question, law: Law) -> LieAlgebra:
    """C^i_jk = f^i_kj − f^i_jk of the second-order coefficients.

    **Raises:** `InputError` if Jacobi's identity fails for them.
    """
    tape, size = law.tape, len(law.theta)
    zero = dict.fromkeys((*law.first, *law.second), tape.zero)
    f = [
        [[substitute(tape, derivative(tape, derivative(tape, t, a), b), zero) for b in law.second] for a in law.first]
        for t in law.theta
    ]
    constants: dict[tuple[int, int], dict[int, Any]] = {}
    for j in range(size):
        for k in range(j + 1, size):
            values = {i: tape.minus(f[i][k][j], f[i][j][k]) for i in range(size)}
            constants[j, k] = {i: neat(tape.to_sympy(v)) for i, v in values.items() if tape.value(v) != 0}
    return LieAlgebra(tuple(str(tape.symbol_at(a)) for a in law.first), constants)


def _identity(question: Question, law: Law, region: Region, at_zero: Region) -> Iterator[Outcome]:
    """θ(a, 0) = a and θ(0, b) = b."""
    tape = law.tape
    nothing = [tape.zero] * len(law.theta)
    for arguments, kept, gone in ((law.first, law.first, law.second), (law.second, law.second, law.first)):
        pair = (arguments, nothing) if arguments is law.first else (nothing, arguments)
        values = law.of(*pair)
        labels = [f"θ{i}({'a, 0' if arguments is law.first else '0, b'})" for i in range(1, len(values) + 1)]
        residuals = [Residual(label, tape.minus(v, x)) for label, v, x in zip(labels, values, kept, strict=True)]
        there = fixed_region(tape, region, dict.fromkeys(gone, tape.zero))
        yield germ(question, residuals, [] if there is None else [there], kept, at_zero)


def _associative(question: Question, law: Law, region: Region, at_zero: Region) -> Outcome:
    """θ(θ(a, b), c) = θ(a, θ(b, c)) near 0."""
    tape = law.tape
    left = law.of(law.of(law.first, law.second), law.third)
    inner = law.of(law.second, law.third)
    right = law.of(law.first, inner)
    residuals = [
        Residual(f"associativity of θ{i}", tape.minus(x, y))
        for i, (x, y) in enumerate(zip(left, right, strict=True), 1)
    ]
    regions = []
    for a, b in (
        (law.first, law.second),
        (law.second, law.third),
        (law.of(law.first, law.second), law.third),
        (law.first, inner),
    ):
        images: Mapping[Node, Node] = dict(zip((*law.first, *law.second), (*a, *b), strict=True))
        moved = moved_region(tape, region, lambda node, images=images: substitute(tape, node, images))
        regions += [] if moved is None else [moved]
    return germ(question, residuals, regions, (*law.first, *law.second, *law.third), at_zero)


def germ(
    question: Question, residuals: Sequence[Residual], regions: Iterable[Region], names: Sequence[Node], at_zero: Region
) -> Outcome:
    """Do germs at 0 vanish? Proved as identities near 0, refuted by a Taylor coefficient there."""
    requirements = [r for region in regions for r in region.requirements]
    near = Region((*dict.fromkeys(requirements), *_box(question.tape, names)), (), at_zero.symbols)
    budget = question.budget.share(0.5)
    outcome = question.decide(residuals, near, budget=budget)
    if outcome.status == "proved":
        return outcome
    refuted = _coefficient(question, residuals, names, at_zero)
    if refuted is not None:
        return refuted
    if outcome.status == "refuted" and _is_analytic_near(question, residuals, near, names, outcome.witness):
        return outcome
    if outcome.status == "refuted":
        label = outcome.failed.residual.label if outcome.failed is not None else "the law"
        return Outcome(
            "undecided",
            note=f"{label} fails away from the identity, but no Taylor coefficient there was found that does",
        )
    return outcome


def _box(tape: Tape, names: Sequence[Node]) -> Iterator[Requirement]:
    for x in names:
        for sign in (1, -1):
            yield Requirement("positive", (tape.add(((x, sign),), NEAR),), f"{tape.symbol_at(x)} within {NEAR} of 0")


def _is_analytic_near(
    question: Question, residuals: Sequence[Residual], near: Region, names: Sequence[Node], witness: Any
) -> bool:
    """Whether everything is defined and smooth on the whole box around 0, at the witness's values of parameters.

    Then what isn't 0 at a point of the box isn't 0 as a germ at 0 (analytic continuation on a connected set).
    """
    tape = question.tape
    nodes = [*(r.node for r in residuals), *near.nodes()]
    point: dict[Node, Any] = {x: arb(0, float(NEAR)) for x in names}
    for x in {x for node in nodes for x in tape.support(node)} - set(names):
        value = (witness or {}).get(str(tape.symbol_at(x)))
        if not isinstance(value, (str, Fraction, int)):
            return False
        point[x] = arb(fmpq(Fraction(value).numerator, Fraction(value).denominator))
    edges = {node for requirement in _box(tape, names) for node in requirement.nodes}
    inner = [r for r in near.requirements if not set(r.nodes) <= edges]
    try:
        with precision(64):
            balls = evaluate(tape, tape.reach(nodes), point)
            return all(holds(requirement, balls) for requirement in inner)
    except (OutOfDomain, Unsupported, ZeroDivisionError):
        return False


def _coefficient(
    question: Question, residuals: Sequence[Residual], names: Sequence[Node], at_zero: Region
) -> Outcome | None:
    """A refutation by a derivative at 0, up to the third, that isn't 0."""
    tape = question.tape
    for order in range(HIGHEST + 1):
        question.budget.check()
        found = [r for r in _derivatives(question, residuals, names, order) if tape.value(r.node) != 0]
        if not found:
            continue
        outcome = question.decide(found, at_zero)
        if outcome.status == "refuted":
            label = outcome.failed.residual.label if outcome.failed is not None else ""
            constant = next((r for r in found if r.label == label and tape.value(r.node) is not None), None)
            if constant is not None:
                return question.refuted_exactly(at_zero, LOCAL, fails=label, value=str(tape.value(constant.node)))
            return outcome
    return None


def _derivatives(
    question: Question, residuals: Sequence[Residual], names: Sequence[Node], order: int
) -> Iterator[Residual]:
    """All partial derivatives at 0 of an order; where they are too many, those along a line in a random direction."""
    tape, zero = question.tape, dict.fromkeys(names, question.tape.zero)
    if len(residuals) * comb(len(names) + order - 1, order) > MOST_COEFFICIENTS:
        along = tape.symbol(sp.Dummy("along_a_line", real=True))
        direction = Random(question.seed)
        line = {x: tape.add(((along, Fraction(direction.choice(SLOPES), direction.choice(SLOPES))),)) for x in names}
        lines = [Residual(r.label, substitute(tape, r.node, line)) for r in residuals]
        yield from (_derivative(tape, r, [along] * order, {along: tape.zero}) for r in lines)
        return
    for variables in combinations_with_replacement(names, order):
        yield from (_derivative(tape, residual, variables, zero) for residual in residuals)


def _derivative(tape: Tape, residual: Residual, variables: Sequence[Node], zero: Mapping[Node, Node]) -> Residual:
    node = residual.node
    for x in variables:
        node = derivative(tape, node, x)
    return Residual(f"{residual.label} at order {len(variables)}", substitute(tape, node, zero))


KINDS = {"group": group}
