"""Campaigns on executors: the same verdicts on each of them, and none lost with a worker."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import BrokenExecutor, Executor, Future, ThreadPoolExecutor
from dataclasses import replace

import pytest

from canon import verify, verify_many
from canon.claim import Claim
from canon.claims import apart, many
from canon.claims.apart import decided_apart
from canon.claims.batches import AHEAD
from canon.claims.many import LOST
from canon.claims.read_many import _sent, read_many
from canon.claims.reader import read_text
from canon.claims.worker import Settings
from canon.errors import InputError
from canon.verdict import Verdict

HEAD = '[phase_space]\nq = ["q"]\np = ["p"]\n'


def brackets(count: int) -> str:
    text = HEAD
    for k in range(1, count + 1):
        value = f"{k}*q**{k - 1}" + "*1001/1000" * (k % 3 == 0)
        text += f'[[claim]]\nkind = "bracket"\nf = "q**{k}"\ng = "p"\nequals = "{value}"\n'
    return text


CLAIMS = read_text(brackets(20)).claims
WORDS = ["refuted" if k % 3 == 0 else "proved" for k in range(1, 21)]


class Here(Executor):
    """Does the work where it is called, but loses the first results that are told by `lose(number, claims)`."""

    def __init__(self, lose=lambda number, claims: False) -> None:
        self.lose, self.number, self.most, self.out = lose, 0, 0, 0

    def submit(self, fn, /, *args, **kwargs) -> Future:
        future: Future = Future()
        self.number += 1
        if self.lose(self.number, args[0]):
            future.set_exception(BrokenExecutor("its machine is gone"))
        else:
            future.set_result(fn(*args, **kwargs))
        return future


def words_of(answers) -> list[str]:
    found = dict(answers)
    return [found[k].status for k in sorted(found)]


def test_the_same_on_every_executor() -> None:
    alone = [verify(claim, seed=3) for claim in CLAIMS]
    assert [verdict.status for verdict in alone] == WORDS
    with ThreadPoolExecutor(3) as threads:
        for executor in (Here(), threads):
            for batch in (1, 7):
                found = dict(verify_many(CLAIMS, executor=executor, apart=False, batch=batch, seed=3))
                assert [found[k].witness for k in range(20)] == [verdict.witness for verdict in alone]
                assert words_of(found.items()) == WORDS


def test_what_a_lost_worker_had_is_asked_again() -> None:
    executor = Here(lose=lambda number, claims: number in (1, 3))
    assert words_of(verify_many(CLAIMS, executor=executor, apart=False, batch=6)) == WORDS
    assert executor.number == 4 + 12  # the claims of two batches, one by one


def test_a_claim_that_takes_its_workers_along_is_undecided() -> None:
    executor = Here(lose=lambda number, claims: any(claim.index == 4 for claim in claims))
    found = dict(verify_many(CLAIMS, executor=executor, apart=False, batch=6))
    assert [k for k in range(20) if found[k].status != WORDS[k]] == [4]
    assert found[4].status == "undecided"
    assert "its worker was lost twice (BrokenExecutor: its machine is gone)" in found[4].detail["note"]


def test_a_pool_that_takes_nothing_more_loses_no_claim() -> None:
    class Broken(Here):
        def submit(self, fn, /, *args, **kwargs) -> Future:
            if self.number >= 2:
                raise BrokenExecutor("the pool is broken")
            return super().submit(fn, *args, **kwargs)

    found = Counter(words_of(verify_many(CLAIMS, executor=Broken(), apart=False, batch=5)))
    assert found == {"proved": 7, "refuted": 3, "undecided": 10}


def test_claims_are_taken_as_they_are_needed() -> None:
    taken = 0

    def endless() -> Iterator[Claim]:
        nonlocal taken
        while True:
            taken += 1
            yield CLAIMS[0]

    answers = verify_many(endless(), executor=Here(), apart=False, batch=2)
    assert next(answers)[1].status == "proved"
    assert taken <= 2 * AHEAD
    answers.close()


def test_what_is_no_verdict_stays_in_its_place(monkeypatch: pytest.MonkeyPatch) -> None:
    def odd(claim: Claim, **options):
        if claim.index == 1:
            raise InputError("the domain seems empty", "claim 2")
        if claim.index in (2, 3):
            raise (MemoryError, ZeroDivisionError("flaw"))[claim.index - 2]
        return verify(claim, **options)

    monkeypatch.setattr(many, "verify", odd)
    found = dict(verify_many(CLAIMS[:5], executor=Here(), apart=False))
    assert isinstance(found[1], InputError)
    assert [found[k].detail["note"] for k in (2, 3)] == [
        "stopped: out of memory",
        "stopped by an internal error, ZeroDivisionError: flaw",
    ]
    assert [found[k].status for k in (0, 2, 3, 4)] == ["proved", "undecided", "undecided", "proved"]


class Hostile:
    """A claim that does something else where it arrives."""

    kind, title, budget, index = "bracket", None, 0.2, 0

    def __init__(self, act, *arguments) -> None:
        self.act = act, arguments

    def __reduce__(self):
        return self.act


def test_a_claim_that_overstays_or_takes_its_process_along_costs_one_answer() -> None:
    """Each is decided in a process beside the worker, which is killed in the middle of a call into C."""
    claims = [Hostile(pow, 3, 10**9), CLAIMS[0], Hostile(os.abort), CLAIMS[2], CLAIMS[1]]  # a power that takes minutes
    found = dict(verify_many(claims, executor=Here(), batch=3))  # type: ignore[arg-type]
    assert [found[k].status for k in range(5)] == ["undecided", "proved", "undecided", "refuted", "proved"]
    assert found[0].detail["note"] == "stopped: still busy well past its budget of 0.2 s"
    assert found[2].detail["note"] == "stopped: its worker process was ended by SIGABRT (out of memory, most likely)"


def test_what_cannot_be_sent_to_another_process_is_decided_here() -> None:
    local = replace(CLAIMS[0], title=type("Words", (str,), {})("no other program knows this type"))
    assert words_of(verify_many([local, CLAIMS[2]], executor=Here())) == ["proved", "refuted"]


def test_a_process_that_waits_is_asked_again() -> None:
    settings = Settings(memory=1 << 31)
    kept = [(decided_apart(claim, settings, False), apart._IDLE[1 << 31][0]) for claim in CLAIMS[:2]]
    assert kept[0][1] is kept[1][1]
    kept[0][1].process.kill()
    kept[0][1].process.wait()
    again = decided_apart(CLAIMS[2], settings, False)
    assert isinstance(again, Verdict)
    assert again.status == "refuted"


def test_certificates_travel_where_they_are_wanted() -> None:
    import pickle

    (_, plain), (_, whole) = (
        next(verify_many(CLAIMS, executor=Here(), apart=False, certificates=word)) for word in (False, True)
    )
    assert plain.certificate is None
    again = pickle.loads(pickle.dumps(whole))  # noqa: S301 - our own, just made
    assert dict(again.certificate) == dict(whole.certificate)
    assert again.certificate["verdict"] == "proved"


def test_an_accuracy_goes_along_to_whoever_decides() -> None:
    claims = [CLAIMS[k] for k in (0, 1)]
    found = dict(verify_many(claims, executor=Here(), method="numeric", accuracy=1e-40, apart=False))
    for verdict in found.values():
        assert verdict.status == "supported"
        assert verdict.numeric.bound <= 1e-40
        assert verdict.detail["accuracy"] == {"asked": 1e-40, "reached": True}


def test_files_are_read_as_here_by_whoever_reads_them() -> None:
    """Faults, claims and what is said of them are the same, in every order; a worker that is lost loses no file."""
    texts = [brackets(k % 4) if k % 5 else HEAD + "[[claim]]\nkind = 'brackett'\n" for k in range(40)]
    texts[7] = "no TOML"
    here = [read_text(text) for text in texts]
    executor = Here(lose=lambda number, items: number == 2)
    found = dict(read_many(texts, executor))
    assert executor.number == 3 + 16  # the files of one message, one by one
    assert [found[k].problems for k in range(40)] == [read.problems for read in here]
    for k, read in enumerate(here):
        assert [sent.opened() for sent in found[k].claims] == [sent.opened() for sent in map(_sent, read.claims)]
        assert [replace(claim, subject=None, keys={}) for claim in read.claims] == [s.claim for s in found[k].claims]
    claims = [sent for k in range(40) for sent in found[k].claims]
    assert words_of(verify_many(claims, executor=Here(), apart=False, batch=7)) == words_of(
        verify_many([sent.opened() for sent in claims], executor=Here(), apart=False)
    )


def test_a_file_that_takes_its_readers_along_is_at_fault() -> None:
    executor = Here(lose=lambda number, items: any("kind = 'gone'" in item for item in items))
    found = dict(read_many([brackets(1), "kind = 'gone'", brackets(2)], executor))
    assert [len(found[k].claims) for k in range(3)] == [1, 0, 2]
    (fault,) = found[1].problems
    assert fault["message"] == "not read: its worker was lost twice (BrokenExecutor: its machine is gone)"


def test_what_an_executor_calls_off_is_asked_again() -> None:
    """As Dask's does with all that is out where its scheduler is gone; it takes nothing more then."""
    from canon.cli.cluster import Reaching

    class Client:
        status = "running"

        def get_executor(self) -> Executor:
            return CallingOff()

    class CallingOff(Here):
        def submit(self, fn, /, *args, **kwargs):
            client.status = "closed"
            future: Future = Future()
            future.cancel()
            future.set_running_or_notify_cancel()
            return future

    client = Client()
    found = dict(verify_many(CLAIMS, executor=Reaching(client, patience=60, glance=60), apart=False, batch=100))
    assert len(found) == len(CLAIMS)
    notes = {answer.detail["note"] for answer in found.values() if isinstance(answer, Verdict)}
    assert notes == {f"{LOST} (RuntimeError: the scheduler of the cluster is gone)"}
