"""From a claim to its verdict."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, Literal

from sympy.core.parameters import evaluate

from canon.budget import Budget
from canon.claim import Claim
from canon.claims.agreement import alarm_within, compared
from canon.claims.beside_forward import on_its_domain
from canon.claims.confined import unconfined
from canon.claims.edges import with_edges
from canon.claims.kinds import Kind, kind_named
from canon.claims.matters import mattering
from canon.claims.no_numbers import sampled_only
from canon.claims.on_image import grounds, on_image, without_its_map
from canon.claims.other_wells import WELL
from canon.claims.outcome import Outcome
from canon.claims.own_names import are_continuous
from canon.claims.question import Question
from canon.claims.well_formed import check_accuracy, check_budget, check_claim, check_seed
from canon.claims.worker import Settings
from canon.decide.certificate import Certificate
from canon.decide.ladder import Contradiction
from canon.decide.tape import Unsupported
from canon.errors import BudgetExceeded, InputError
from canon.mechanics.extent import recursion_told
from canon.turns import in_turn
from canon.verdict import Verdict

Method = Literal["symbolic", "numeric", "all"]
METHODS: tuple[Method, ...] = ("symbolic", "numeric", "all")
LEAST_MEMORY = 1 << 29
"""Bytes: what the libraries themselves take, and a little."""
EXACT_SHARE = 0.7
"""The part of a budget that the exact deciders may spend where sampling is asked for too."""
SELDOM = 0.2
"""Seconds between two words about how much of a budget is spent."""


def verify(
    claim: Claim,
    *,
    budget: float = 10.0,
    seed: int = 0,
    method: Method = "symbolic",
    accuracy: float | None = None,
    memory: int | None = None,
    watch: Callable[[float], None] | None = None,
) -> Verdict:
    """The verdict on a claim.

    **Arguments:** `claim`; `budget` in seconds (the claim's own wins); `seed` of the points that are tried; `method`:
    "symbolic" decides exactly, "numeric" samples the residuals (at most `supported`, or `refuted` by a ball), "all"
    does both, one beside the other; `accuracy`: what sampled residuals are to be bounded by, in balls of as many bits
    as that takes, in place of what double precision shows; `memory`: decide in a process beside this one, which may
    have so many bytes (of address space, at least 2²⁹) and is killed where the claim needs more or is still busy well
    past its budget, which is `undecided` then. It is kept for the next claims; the first one waits for it, about a
    second. Without `memory` the claim is decided here, where the deciders look at the clock, but nothing limits memory.
    `watch` is told now and then which part of the budget is spent, from 0 to 1, as in `with progress("deciding") as
    watch: verify(claim, watch=watch)`: where the deciders look at the clock, and not from the process beside.

    **Returns:** a `Verdict`: `proved` and `refuted` rest on exact arguments or certified witnesses, never on floats.
    Should an exact and a numerical answer contradict each other, it is `undecided`, with both in `detail["alarm"]`.
    Threads that ask at once take turns, each with its budget from when it is its turn.

    **Raises:** `InputError` where the claim is ill-posed, where the budget is none, or where it can't be decided in
    another process.
    """
    if not isinstance(claim, Claim) or claim.subject is None:
        called = ": call it" if callable(claim) else ""
        raise InputError(
            f"a claim about something is expected, as transformation.canonical() makes one, not {claim!r}{called}"
        )
    check_settings(Settings(budget, seed, method, memory, accuracy=accuracy))
    if memory is not None:
        return replace(_apart(claim, Settings(budget, seed, method, memory, accuracy=accuracy)), claim=claim)
    check_claim(claim)
    decide = kind_named(claim.kind)
    with in_turn(), recursion_told(), evaluate(True):  # whatever the program has told sympy
        return replace(_here(claim, decide, Settings(budget, seed, method, accuracy=accuracy), watch), claim=claim)


def check_settings(settings: Settings) -> None:
    """**Raises** `InputError` for settings by which nothing can be decided."""
    if not isinstance(settings.method, str) or settings.method not in METHODS:
        raise InputError(f"a method is one of {', '.join(METHODS)}, not {settings.method!r}")
    check_budget(settings.budget)
    check_seed(settings.seed)
    check_accuracy(settings.accuracy)
    memory = settings.memory
    if memory is not None and (type(memory) is not int or memory < LEAST_MEMORY):
        raise InputError(f"a limit of memory is a whole number of bytes, at least {LEAST_MEMORY}: {memory!r}")


def _here(claim: Claim, decide: Kind, settings: Settings, watch: Callable[[float], None] | None) -> Verdict:
    seed, method, accuracy = settings.seed, settings.method, settings.accuracy
    start = time.monotonic()
    are_continuous(claim)
    seconds = claim.budget if claim.budget is not None else settings.budget
    whole = Budget(seconds, None if watch is None else _looked(watch, start, seconds))
    question = Question(claim, whole, seed, "numeric" if method == "numeric" else "symbolic", accuracy)
    if method != "all":
        return _verdict(question, _answer(decide, question), time.monotonic() - start)
    symbolic = _answer(decide, replace(question, budget=whole.share(EXACT_SHARE)))
    numeric = _answer(decide, replace(question, method="numeric"))
    return _verdict(question, compared(symbolic, numeric), time.monotonic() - start)


def _looked(watch: Callable[[float], None], start: float, seconds: float) -> Callable[[], None]:
    """Tell which part of a budget is spent, but not more often than anybody can see."""
    last = start

    def look() -> None:
        nonlocal last
        now = time.monotonic()
        if now - last >= SELDOM:
            last = now
            watch(min((now - start) / seconds, 1.0) if seconds else 1.0)

    return look


def _apart(claim: Claim, settings: Settings) -> Verdict:
    from canon.claims.apart import NotApart, asked_apart

    try:
        answer = asked_apart(claim, settings, certificates=True)
    except NotApart as reason:
        raise InputError(f"this claim can't be decided with a limit of memory: {reason}; leave `memory` out") from None
    if isinstance(answer, InputError):
        raise answer
    return answer


def _answer(decide: Kind, question: Question) -> Outcome:
    """What the kind says; a budget spent, or what the deciders don't know, is `undecided` and says so."""
    try:
        outcome = with_edges(question, _decided(decide, question))
    except BudgetExceeded as reason:
        return Outcome("undecided", note=str(reason))
    except Unsupported as reason:
        return Outcome("undecided", note=f"outside of what the deciders know: {reason}")
    except RecursionError:
        return Outcome("undecided", note="an expression nested too deeply")
    except Contradiction as reason:
        return alarm_within(str(reason))
    return sampled_only(outcome) if question.method == "numeric" else outcome


def _decided(decide: Kind, question: Question) -> Outcome:
    """What the kind says, of a claim without the file's map where its domain is the same."""
    alone, seen = without_its_map(question)
    if alone is None or seen is None:
        try:
            outcome = unconfined(question, decide(question))
        except InputError as fault:
            if fault.where != WELL or question.key("well") is not None:
                raise
            left = on_its_domain(question, on_image(question, Outcome("refuted"), seen))
            if left.status != "undecided":
                raise
            return left  # the other well may be where the map doesn't lead
        return on_its_domain(question, on_image(question, outcome, seen))
    return grounds(seen, decide(alone))


def _verdict(question: Question, outcome: Outcome, seconds: float) -> Verdict:
    claim = question.claim
    detail: dict[str, Any] = dict(outcome.detail)
    wanted, seen = question.accuracy, outcome.numeric
    if wanted is not None and seen is not None:
        detail["accuracy"] = {"asked": wanted, "reached": seen.bound <= wanted}
    if outcome.note:
        detail["note"] = outcome.note
    return Verdict(
        status=outcome.status,
        kind=claim.kind,
        title=claim.title,
        method=outcome.method,
        seconds=seconds,
        witness=outcome.witness if outcome.status == "refuted" else None,
        numeric=outcome.numeric,
        certificate=_certificate(question, outcome) if outcome.status in ("proved", "refuted") else None,
        detail=detail,
        matters=mattering(outcome),
    )


def _certificate(question: Question, outcome: Outcome) -> Certificate:
    """The argument as data, made when it is looked at: claim, domain, and each step with its grounds."""
    return Certificate(lambda: _steps(question, outcome))


def _steps(question: Question, outcome: Outcome) -> dict[str, Any]:
    claim = question.claim
    domain = question.domain()
    return {
        "kind": claim.kind,
        "title": claim.title,
        "verdict": outcome.status,
        "keys": {name: _plain(value) for name, value in claim.keys.items()},
        "domain": [str(condition) for condition in domain.conditions] + [f"{e} = 0" for e in domain.surface],
        "witness": dict(outcome.witness) if outcome.witness is not None else None,
        "arguments": [{name: _grounds(value) for name, value in argument.items()} for argument in outcome.arguments],
    }


def _grounds(value: Any) -> Any:
    """An item of an argument as data: certificates are made now, and conditions put into words."""
    if isinstance(value, Mapping):
        return dict(value)
    return [str(item) for item in value] if isinstance(value, tuple) else value


def _plain(value: Any) -> Any:
    """A key's value as text, lists and tables of text."""
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if hasattr(value, "items"):
        return {str(name): _plain(item) for name, item in value.items()}
    return str(getattr(value, "expr", value))
