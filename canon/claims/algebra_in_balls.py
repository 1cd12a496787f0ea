"""Which Lie algebra functions can't make, whatever their brackets are: the Killing form at certified points, in balls.

Should the brackets close, then with the constants that linear equations at certified points allow, all of them in
balls. Where the Killing form of every algebra with constants in these balls is regular and has one signature, and an
algebra of another one is claimed, the claim is refuted, though nothing was proved of the brackets. A degenerate form
can't be told so from regular ones near it: e(3) is a limit of so(4)'s.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

from flint import arb, arb_mat

from canon.claims.outcome import Outcome
from canon.claims.structure_search import BITS, first_values, frame, parameters_of, solve
from canon.decide.enclosure import precision
from canon.mechanics.algebra.names import read_name

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.decide.region import Region
    from canon.decide.tape import Node
    from canon.mechanics.algebra.identity import Identity

BY_SIGNATURE: Final = (
    "linear equations at certified points leave structure constants with a regular Killing form of another signature"
)


def refuted_by_signature(
    question: Question,
    region: Region,
    basis: Sequence[Node],
    brackets: Mapping[tuple[int, int], Node],
    variables: Sequence[Node],
    equals: str,
) -> Outcome | None:
    """A refutation of "the functions close with the algebra `equals`" by enclosed structure constants; else None."""
    shown = [*basis, *brackets.values(), *region.surface]
    parameters = parameters_of(question, variables, [*shown, *region.nodes()])
    values = first_values(question, region, [*basis, *brackets.values()], parameters)
    found = frame(question, region, basis, list(brackets.values()), values)
    if found is None or found.chosen:
        return None
    solution = solve(found)
    if not solution.independent or solution.outside is not None or not solution.constants:
        return None
    signature = killing_signature(len(basis), dict(zip(brackets, solution.constants, strict=True)))
    if signature is None or signature == signature_of(read_name(equals)):
        return None
    positive, negative = signature
    detail = {
        "fails": f"isomorphism with {equals}",
        "killing_signature": f"{positive} positive, {negative} negative, 0 zero",
    }
    where = {str(question.tape.symbol_at(x)): str(v) for x, v in values.items()}
    step = {"theorem": BY_SIGNATURE, "parameters": where, "points": len(found.points), "bits": BITS}
    return Outcome("refuted", "balls at several points", detail=detail, arguments=(step,))


def killing_signature(size: int, constants: Mapping[tuple[int, int], Sequence[Any]]) -> tuple[int, int] | None:
    """(positive, negative) squares of tr(ad_a ad_b) for all constants in the balls; None where it may be singular.

    In a basis that makes it nearly diagonal each row's Gershgorin disc keeps away from 0 (Sylvester's law of inertia).
    """
    import numpy as np

    with precision(BITS):
        zero = arb(0)
        ad = [arb_mat([[zero] * size for _ in range(size)]) for _ in range(size)]
        for (a, b), row in constants.items():
            for c, value in enumerate(row):
                ad[a][c, b] = value
                ad[b][c, a] = -value
        form = arb_mat(size, size)
        for a in range(size):
            for b in range(a + 1):
                product = ad[a] * ad[b]
                form[a, b] = form[b, a] = sum((product[k, k] for k in range(size)), start=zero)
        middle = np.array([[float(form[a, b].mid()) for b in range(size)] for a in range(size)])
        if not np.isfinite(middle).all():
            return None
        _, vectors = np.linalg.eigh(middle)
        turn = arb_mat([[arb(float(v)) for v in row] for row in vectors])
        turned = turn.transpose() * form * turn
        positive = negative = 0
        for a in range(size):
            others = sum((abs(turned[a, b]) for b in range(size) if b != a), start=zero)
            if turned[a, a] > others:
                positive += 1
            elif -turned[a, a] > others:
                negative += 1
            else:
                return None
    return positive, negative


def signature_of(named: Identity) -> tuple[int, int] | None:
    """The Killing form's signature of a semisimple algebra with a name; None where it is degenerate."""
    if named.abelian or named.cores or named.other:
        return None
    negative = sum(simple.compact_dimension for simple in named.simple)
    return named.dimension - negative, negative
