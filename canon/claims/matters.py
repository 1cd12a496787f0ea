"""Which coordinates of a witness a refutation depends on: the others may have any value that the region allows."""

from __future__ import annotations

from canon.claims.outcome import Outcome
from canon.decide.region import Region
from canon.decide.tape import Node, Tape


def tied_to(tape: Tape, node: Node, region: Region) -> frozenset[str]:
    """The names in the node, and those that the region's conditions tie to them, and to these, and so on.

    A name that isn't among these can be changed without changing the node's value, and as far as the conditions on
    it alone allow.
    """
    groups = [_names(tape, requirement.nodes) for requirement in region.requirements]
    groups += [_names(tape, [equation]) for equation in region.surface]
    found, reached = _names(tape, [node]), False
    while not reached:
        more = found.union(*(group for group in groups if len(group) > 1 and group & found))
        found, reached = more, more == found
    return found


def _names(tape: Tape, nodes: list[Node] | tuple[Node, ...]) -> frozenset[str]:
    symbols = frozenset(str(symbol) for node in nodes for symbol in tape.symbols_of(node))
    return symbols | tape.functions_of(nodes)


def mattering(outcome: Outcome) -> tuple[str, ...] | None:
    """The names of a refutation's witness that matter, in its order.

    None where all of them do, or where what failed is no single quantity; none where this is one number everywhere.
    """
    failed, witness = outcome.failed, outcome.witness
    if outcome.status != "refuted" or not witness or failed is None:
        return None
    if failed.answer.witness is None or failed.answer.witness.as_table() != witness:
        return None
    found = tuple(name for name in witness if name in failed.tied)
    return None if len(found) == len(witness) else found
