"""Two answers to one claim, an exact one and a sampled one: together where they agree, an alarm where they can't be.

An exact argument and a ball at a certified point can't both be right against each other: one of the deciders is at
fault. Then nothing is known of the claim, and the answer says so and shows both.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Final

from canon.claims.outcome import Outcome

ALARM: Final = (
    "a proof and a certified counterexample contradict each other, a fault of canon: please report this claim"
)


def compared(symbolic: Outcome, numeric: Outcome) -> Outcome:
    """The exact answer with the sampled evidence beside it; an alarm where they contradict each other.

    A witness that sampling finds outweighs an exact attempt that came to nothing; one that it doesn't find says
    nothing against a refutation by a point, nor against an exact one, unless that leaves no point at all.
    """
    if "alarm" in numeric.detail:
        return alarm(symbolic, numeric)
    if numeric.status == "refuted":
        if symbolic.status == "refuted":
            return _beside(symbolic, numeric)
        return alarm(symbolic, numeric) if symbolic.status == "proved" else numeric
    if symbolic.status == "refuted":
        contradicted = symbolic.everywhere and numeric.status == "supported"
        return alarm(symbolic, numeric) if contradicted else _beside(symbolic, numeric)
    if symbolic.status == "undecided" and numeric.status == "supported":
        merged = {**numeric.detail, **symbolic.detail}
        note = "; ".join(dict.fromkeys(part for part in (symbolic.note, numeric.note) if part))
        return replace(numeric, detail=merged, note=note)
    solved = numeric.detail.get("solved")
    return _beside(symbolic, numeric).with_detail(solved=solved)


def _beside(symbolic: Outcome, numeric: Outcome) -> Outcome:
    """The exact answer with the numbers, or with why there are none; a witness keeps its own."""
    if symbolic.witness is not None:
        return symbolic
    found = numeric.numeric or symbolic.numeric
    return replace(symbolic, numeric=found).with_detail(numbers=None if found else numeric.detail.get("numbers"))


def alarm(symbolic: Outcome, numeric: Outcome) -> Outcome:
    """Undecided, with both answers."""
    return Outcome(
        "undecided",
        method=", ".join(dict.fromkeys(name for name in (symbolic.method, numeric.method) if name)),
        numeric=numeric.numeric,
        detail={"alarm": ALARM, "symbolic": _summary(symbolic), "numeric": _summary(numeric)},
    )


def alarm_within(reason: str) -> Outcome:
    """Undecided: a decider has found itself in contradiction."""
    return Outcome("undecided", detail={"alarm": f"{ALARM} ({reason})"})


def _summary(outcome: Outcome) -> dict[str, Any]:
    shown: dict[str, Any] = {"verdict": outcome.status, "method": outcome.method}
    shown |= {key: outcome.detail[key] for key in ("fails", "residual") if key in outcome.detail}
    if outcome.witness is not None:
        shown["at"] = dict(outcome.witness)
    if outcome.numeric is not None:
        shown["evidence"] = str(outcome.numeric)
    return shown
