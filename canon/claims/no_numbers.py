"""What sampling may say of a claim: at most `supported`, and that with numbers alone.

A kind that has no meaning in numbers, or can't give them for this claim, says why in `detail["numbers"]`; where it says
nothing, that is said here. The record's `numeric` is null then, and the verdict is never `supported`.
"""

from __future__ import annotations

from typing import Final

from canon.claims.outcome import Outcome

EXACTLY: Final = "none: an exact argument refutes it, without a point"
NOTHING_EVALUATED: Final = "none: nothing was evaluated in floating-point numbers"


def sampled_only(outcome: Outcome) -> Outcome:
    """The outcome as sampling may give it."""
    if outcome.numeric is not None:
        return outcome.with_status("supported", "sampled only") if outcome.status == "proved" else outcome
    reason = EXACTLY if outcome.status == "refuted" else NOTHING_EVALUATED
    if outcome.status == "undecided" and outcome.note:
        reason = f"none: {outcome.note}"
    said = outcome.with_detail(numbers=outcome.detail.get("numbers", reason))
    return said if said.status == "refuted" else said.with_status("undecided")
