"""Campaigns: claims by the thousand on any executor of `concurrent.futures`, in processes here or on a cluster.

Claims go out in batches and verdicts come back, in the order in which they are answered. What a lost worker had is
asked again, claim by claim; a claim whose worker is lost again is `undecided`, with the reason.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from dataclasses import replace
from itertools import islice
from multiprocessing import get_context
from typing import Final

from canon.claim import Claim
from canon.claims.apart import decided_apart
from canon.claims.batches import answers
from canon.claims.read_many import Sent
from canon.claims.run import available_cores, memory_limit
from canon.claims.verify import Method, check_settings, verify
from canon.claims.worker import Settings, without_verdict
from canon.errors import InputError
from canon.expected import whole_number, yes_or_no
from canon.verdict import Verdict

BATCH: Final = 16
"""Claims that travel together: a message costs about as much as a small claim."""

MOST_TOGETHER: Final = 10**6
"""The most claims in a batch."""
LOST: Final = "stopped: its worker was lost twice"
"""How it is said of a claim that nobody was there to answer it: another run may."""

Answer = Verdict | InputError


def verify_many(
    claims: Iterable[Claim | Sent],
    *,
    executor: Executor | None = None,
    budget: float = 10.0,
    seed: int = 0,
    method: Method = "symbolic",
    accuracy: float | None = None,
    batch: int = BATCH,
    certificates: bool = False,
    apart: bool = True,
    memory: int | None = None,
) -> Iterator[tuple[int, Answer]]:
    """The verdicts on many claims as they come, each with the claim's place in the order of `claims`.

    **Arguments:** `claims`, taken only as they are needed (or as `read_many` sends them);
    `executor`, on which they are decided (default: a process
    for each core here), with workers that can import `canon`; `budget` in seconds for each claim (its own wins),
    `seed`, `method` and `accuracy` as of `verify`; `batch`, how many claims travel together; `certificates`, whether
    verdicts bring theirs along; `apart`, whether each worker decides in a process beside it, which is killed where a
    claim overstays its budget or needs more than `memory` bytes (default: a core's share of the machine's; False: in
    the worker itself, whose time nothing but the deciders' own clock limits).

    **Raises:** `InputError` for a batch of no claims, settings that `verify` doesn't take, or where `claims` or
    `executor` is something else.

    **Yields:** (position, verdict); for an ill-posed claim (position, `InputError`). They are the same on every
    executor and in every order, as long as no budget ends a decision.
    """
    try:
        claims = iter(claims)
    except TypeError:  # as of an array of numpy's without axes
        raise InputError(f"claims are expected, in a list for example, not {claims!r}") from None
    batch = whole_number(batch, "batch", 1, MOST_TOGETHER)
    yes_or_no(certificates, "certificates")
    yes_or_no(apart, "apart")
    if executor is not None and not hasattr(executor, "submit"):
        raise InputError(f"an executor of concurrent.futures is expected, not {executor!r}")
    asked = Settings(budget=budget, seed=seed, method=method, accuracy=accuracy, memory=memory)
    check_settings(asked)
    settings = (asked, certificates, apart)
    if executor is None:
        with ProcessPoolExecutor(available_cores(), mp_context=get_context("spawn")) as own:
            yield from answers(_batches(claims, batch), own, decided, settings, _lost)
    else:
        yield from answers(_batches(claims, batch), executor, decided, settings, _lost)


def _batches(claims: Iterable[Claim | Sent], size: int) -> Iterator[list[tuple[int, Claim | Sent]]]:
    numbered = enumerate(claims)
    while batch := list(islice(numbered, size)):
        yield batch


def decided(claims: Sequence[Claim | Sent], settings: Settings, certificates: bool, apart: bool) -> list[Answer]:
    """The answers to a batch of claims: what a worker does."""
    if settings.memory is None:
        settings = replace(settings, memory=memory_limit(available_cores()))
    found: list[Answer] = []
    for given in claims:
        claim = given.opened() if isinstance(given, Sent) else given
        if not hasattr(claim, "kind"):
            found.append(InputError(f"a claim is expected, not {claim!r}"))
            continue
        answer = decided_apart(claim, settings, certificates) if apart else None
        found.append(decided_here(claim, settings, certificates) if answer is None else answer)
    return found


def decided_here(claim: Claim, settings: Settings, certificates: bool) -> Answer:
    """The answer to a claim, in this process."""
    try:
        verdict = verify(
            claim,
            budget=settings.budget,
            seed=settings.seed,
            method=settings.method,
            accuracy=settings.accuracy,
        )
        return verdict if certificates else replace(verdict, certificate=None)
    except InputError as error:
        return error
    except MemoryError:
        return without_verdict(claim, "stopped: out of memory", 0.0)
    except Exception as error:
        note = f"stopped by an internal error, {type(error).__name__}: {error}"
        return without_verdict(claim, note, 0.0)


def _lost(given: Claim | Sent, error: BaseException) -> Verdict:
    claim = given.claim if isinstance(given, Sent) else given
    return without_verdict(claim, f"{LOST} ({type(error).__name__}: {error})"[:300], 0.0)
