"""Which coordinates of a witness the refutation depends on: the others may have any value that the domain allows."""

from __future__ import annotations

from collections.abc import Iterable

from canon.claims.outcome import Outcome
from canon.claims.question import Question


def mattering(question: Question, outcome: Outcome) -> tuple[str, ...] | None:
    """The names in the quantity that isn't 0 at the witness, and those that conditions of the domain tie to them.

    A name in none of these can be changed without changing the quantity, or leaving the domain by its doing alone. None
    where all names of the witness matter, or where what failed is no single quantity.
    """
    failed, witness = outcome.failed, outcome.witness
    if outcome.status != "refuted" or not witness or failed is None:
        return None
    if failed.answer.witness is None or failed.answer.witness.as_table() != witness:
        return None
    tape, node = question.tape, failed.residual.node
    names = {str(symbol) for symbol in tape.symbols_of(node)} | tape.functions_of([node])
    domain = question.domain()
    tied = [_names(condition.terms) for condition in domain.conditions] + [_names([term]) for term in domain.surface]
    found = _closed(names, tied) & witness.keys()
    return None if not found or found == witness.keys() else tuple(name for name in witness if name in found)


def _names(terms: Iterable[object]) -> set[str]:
    found: set[str] = set()
    for term in terms:
        found |= {str(symbol) for symbol in getattr(term, "free_symbols", ())}
    return found


def _closed(names: set[str], tied: list[set[str]]) -> set[str]:
    """The names, with all that are tied to one of them, and to these, and so on."""
    found, reached = set(names), False
    while not reached:
        more = found.union(*(group for group in tied if group & found))
        found, reached = more, more == found
    return found
