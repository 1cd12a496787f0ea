"""What a kind of claim found: a status with its grounds, and how several of them combine."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, cast

from canon.verdict import Evidence, Status

if TYPE_CHECKING:
    from canon.decide.ladder import Answer


@dataclass(frozen=True)
class Residual:
    """A quantity that must vanish for the claim to hold.

    **Arguments:** `label`, its name for people ("{Q, P}"); `node`, its place on the tape; `actual`, the node of the
    quantity itself (a bracket, of which `node` is the difference from what was claimed).
    """

    label: str
    node: int
    actual: int | None = None


@dataclass(frozen=True)
class Finding:
    """A residual with the decider's answer about it; of a refutation, the names that its witness is `tied` to."""

    residual: Residual
    answer: Answer
    tied: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Outcome:
    """A verdict in the making.

    **Arguments:** `status`; `method`, the arguments used; `findings`, one for each residual that was decided;
    `witness`, a table name = value; `numeric`, the samples taken; `detail`, what the kind found; `arguments`, the
    certificate's steps as data; `note`, for people: what was tried, or which theorem was used; `everywhere`: refuted by
    an argument that leaves no point of the domain at which the claim could be supported.
    """

    status: Status
    method: str = ""
    findings: tuple[Finding, ...] = ()
    witness: Mapping[str, Any] | None = None
    numeric: Evidence | None = None
    detail: Mapping[str, Any] = field(default_factory=dict)
    arguments: tuple[Mapping[str, Any], ...] = ()
    note: str = ""
    everywhere: bool = False

    @property
    def failed(self) -> Finding | None:
        """The finding that refutes, if there is one."""
        return next((finding for finding in self.findings if finding.answer.status == "refuted"), None)

    def with_detail(self, **items: Any) -> Outcome:
        """The same outcome, with further details (None is left out)."""
        return replace(self, detail={**self.detail, **{k: v for k, v in items.items() if v is not None}})

    def with_status(self, status: Status, note: str = "") -> Outcome:
        """The same outcome with another status, and a note added that says why."""
        return replace(self, status=status, note="; ".join(part for part in (self.note, note) if part))


def exact(status: Status, theorem: str, **detail: Any) -> Outcome:
    """An outcome that follows from a theorem or from exact algebra, without a point."""
    return Outcome(status, method="theorem", arguments=({"theorem": theorem},), detail=detail)


def combined(outcomes: Iterable[Outcome]) -> Outcome:
    """The conjunction: refuted if one is, proved if all are, supported if each is at least that, else undecided."""
    parts = list(outcomes)
    refuted = next((part for part in parts if part.status == "refuted"), None)
    if refuted is not None:
        status: Status = "refuted"
    elif all(part.status == "proved" for part in parts):
        status = "proved"
    elif all(part.status in ("proved", "supported") for part in parts):
        status = "supported"
    else:
        status = "undecided"
    detail: dict[str, Any] = {}
    for part in (*parts, *([refuted] if refuted else ())):  # what fails, its value and its witness belong together
        detail.update(part.detail)
    methods = [name for part in ([refuted] if refuted else parts) for name in part.method.split(", ") if name]
    return Outcome(
        status,
        method=", ".join(dict.fromkeys(methods)),
        findings=tuple(finding for part in parts for finding in part.findings),
        witness=refuted.witness if refuted else None,
        numeric=refuted.numeric if refuted and refuted.witness else merged(part.numeric for part in parts),
        detail=detail,
        arguments=tuple(argument for part in parts for argument in part.arguments),
        everywhere=refuted.everywhere if refuted else False,
        note=refuted.note if refuted else "; ".join(dict.fromkeys(part.note for part in parts if part.note)),
    )


def merged(evidence: Iterable[Evidence | None]) -> Evidence | None:
    """One account of several samplings: the fewest points, the residual that is worst against its own bound."""
    found = [item for item in evidence if item is not None]
    if not found:
        return None
    worst = max(found, key=_part_of_bound)
    return Evidence(min(item.points for item in found), worst.max_residual, worst.bound, worst.bits)


def _part_of_bound(item: Evidence) -> float:
    if item.bound:
        return item.max_residual / item.bound
    return math.inf if item.max_residual else 0.0


def outcome_of(finding: Finding) -> Outcome:
    """What the answer about one residual says of the claim that asked for it."""
    answer, residual = finding.answer, finding.residual
    arguments: tuple[dict[str, Any], ...] = ()
    if answer.status == "proved":
        step = {"vanishes": residual.label, "method": answer.method, "conditions": answer.conditions}
        arguments = ({**step, "certificate": answer.certificate},)
    detail: dict[str, Any] = {}
    if answer.status == "refuted":
        detail["fails"] = residual.label
        if answer.witness is not None:
            detail["residual"] = answer.witness.value
    return Outcome(
        cast(Status, answer.status),
        method=answer.method,
        findings=(finding,),
        witness=answer.witness.as_table() if answer.status == "refuted" and answer.witness else None,
        numeric=answer.numeric,
        detail=detail,
        arguments=arguments,
        note=answer.note if answer.status in ("supported", "undecided") else "",
    )
