"""The Lie algebra that a claim is about, with its invariants: what `canon algebra` prints."""

from __future__ import annotations

from dataclasses import dataclass

from canon.budget import Budget
from canon.claim import Claim
from canon.claims import group_of_matrices
from canon.claims.algebra import basis_of, stated_constants
from canon.claims.bracket import keys_domain
from canon.claims.group import law_of, structure_constants
from canon.claims.matrix_algebra import closings, entries_of
from canon.claims.question import Question
from canon.claims.scaled_matrices import scaled_matrices, unscaled
from canon.claims.structure_constants import find_constants
from canon.errors import InputError
from canon.mechanics.algebra.from_matrices import algebra_of_matrices
from canon.mechanics.algebra.identify import Identification, identify
from canon.mechanics.algebra.lie_algebra import LieAlgebra
from canon.mechanics.algebra.rescaling import Rescaled, rescaled
from canon.verdict import Verdict

KINDS = ("algebra", "matrix_algebra", "group")
"""The kinds of claims that are about a Lie algebra."""


@dataclass(frozen=True, slots=True)
class AlgebraTable:
    """A claim with the algebra that it is about.

    **Arguments:** `verdict` on the claim; `algebra`, its structure constants, None where the basis doesn't close;
    `scaled`, the same with rational constants, and `found`, what that is, None where parameters leave it open; `note`,
    why there is no algebra.
    """

    claim: Claim
    verdict: Verdict
    algebra: LieAlgebra | None
    scaled: Rescaled | None
    found: Identification | None
    note: str = ""


def algebra_table(claim: Claim, verdict: Verdict, *, budget: float = 10.0, seed: int = 0) -> AlgebraTable:
    """The algebra of a claim of one of `KINDS`, which was answered so.

    **Raises:** `InputError` where the claim is ill-posed, `BudgetExceeded` where the time is over, as far as somebody
    looks at the clock: what names an algebra doesn't.
    """
    question = Question(claim, Budget(budget), seed)
    try:
        algebra = {"algebra": _of_functions, "matrix_algebra": _of_matrices, "group": _of_group}[claim.kind](question)
    except InputError as error:
        return AlgebraTable(claim, verdict, None, None, None, error.message)
    if algebra is None:
        note = "the basis doesn't close with constant coefficients"
        fails, value = verdict.detail.get("fails"), verdict.detail.get("value")
        note += f": {fails.split(' in the span')[0]} = {value}" if fails and value else ""
        return AlgebraTable(claim, verdict, None, None, None, note)
    scaled = rescaled(algebra)
    try:
        found = None if scaled is None else identify(scaled.algebra, seed)
    except ArithmeticError as error:
        return AlgebraTable(claim, verdict, algebra, scaled, None, str(error))
    return AlgebraTable(claim, verdict, algebra, scaled, found)


def _of_functions(question: Question) -> LieAlgebra | None:
    given = question.key("basis")
    region = keys_domain(question, *given.values())
    basis = basis_of(question, given)
    found = find_constants(question, region, basis.nodes, list(basis.brackets.values()), basis.variables)
    if found.outside is None and not found.nothing and found.unknown is None:
        return LieAlgebra(basis.names, {p: dict(row) for p, row in zip(basis.brackets, found.constants, strict=True)})
    stated = question.key("brackets")
    return (
        None
        if stated is None or found.outside is not None
        else LieAlgebra(basis.names, stated_constants(basis, stated))
    )


def _of_matrices(question: Question) -> LieAlgebra | None:
    matrices = entries_of(question.key("basis"))
    scaled = scaled_matrices(matrices)
    if scaled is not None:
        scales, plain = scaled
        return unscaled(algebra_of_matrices(plain).algebra, scales)
    entries = [entry for rows in question.key("basis").values() for row in rows for entry in row]
    found = (algebra for _, algebra, _ in closings(question, question.region(*entries), matrices))
    return next((algebra for algebra in found if algebra is not None), None)


def _of_group(question: Question) -> LieAlgebra | None:
    if question.key("matrix") is not None:
        return group_of_matrices.constants(question)
    return structure_constants(question, law_of(question))
