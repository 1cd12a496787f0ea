"""`verify(claim, memory=…)`: both budgets, of time and of memory, hold in the middle of any call."""

from __future__ import annotations

import os
import time
from dataclasses import replace

import pytest

from canon import verify
from canon.claims import apart
from canon.claims.reader import read_text
from canon.errors import InputError

HEAD = '[phase_space]\nq = ["q"]\np = ["p"]\n'
BRACKET = '[[claim]]\nkind = "bracket"\nf = "q**2"\ng = "p"\nequals = "{}*q"\n'
TRUE, FALSE = read_text(HEAD + BRACKET.format(2) + BRACKET.format("2.001")).claims
(ILL,) = read_text(HEAD + '[domain]\nwhere = ["q > 1", "q < 0"]\n' + BRACKET.format(2)).claims
GIB = 1 << 30


class Busy:
    """What takes minutes in one call into C, where it arrives."""

    def __reduce__(self):
        return pow, (3, 10**9)


class Hungry(str):
    """The name of a kind that asks for 16 GiB, in pieces, where it is looked up."""

    def __hash__(self) -> int:
        return hash(len([bytearray(1 << 27) for _ in range(128)]))


def test_the_answer_is_that_of_this_process() -> None:
    for claim in (TRUE, FALSE):
        here, there = verify(claim, seed=3), verify(claim, seed=3, memory=2 * GIB)
        assert (here.status, here.method, here.witness) == (there.status, there.method, there.witness)
        assert here.certificate is not None
        assert there.certificate is not None
        assert {**here.certificate} == {**there.certificate}
    with pytest.raises(InputError, match="domain"):
        verify(ILL, memory=2 * GIB)


def test_neither_time_nor_memory_is_exceeded() -> None:
    start = time.thread_time()  # what other tests may have left running in threads isn't counted
    busy = verify(replace(TRUE, keys={"f": Busy()}), budget=0.2, memory=2 * GIB)
    hungry = verify(replace(TRUE, kind=Hungry("bracket")), budget=60, memory=2 * GIB)
    assert time.thread_time() - start < 1.0  # the work was another process's
    assert [busy.status, hungry.status] == ["undecided", "undecided"]
    assert busy.detail["note"] == "stopped: still busy well past its budget of 0.2 s"
    assert hungry.detail["note"] == "stopped: out of memory"
    assert verify(FALSE, memory=2 * GIB).status == "refuted"


def test_a_limit_that_cant_be_kept_is_not_left_aside() -> None:
    for limit in (0, -1, 1000, 2.5e9, True, "2G"):
        with pytest.raises(InputError, match="a limit of memory is a whole number of bytes, at least 536870912"):
            verify(TRUE, memory=limit)  # type: ignore[arg-type]
    local = replace(TRUE, title=type("Words", (str,), {})("no other program knows this type"))
    with pytest.raises(InputError, match="can't be sent to another process; leave `memory` out"):
        verify(local, memory=2 * GIB)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
def test_a_fork_shares_no_pipe_with_its_parent() -> None:
    """Two that ask over one pipe would get each other's answers."""
    verify(TRUE, memory=2 * GIB)
    (companion,) = apart._IDLE[2 * GIB]
    child = os.fork()
    if child == 0:
        os._exit(7 if not apart._IDLE and companion.connection.closed else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
    assert verify(FALSE, memory=2 * GIB).status == "refuted"
    assert apart._IDLE[2 * GIB] == [companion]


@pytest.mark.slow
def test_processes_of_many_limits_do_not_pile_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(apart, "MOST_IDLE", 1)
    verify(TRUE, memory=2 * GIB)
    (companion,) = apart._IDLE[2 * GIB]
    verify(TRUE, memory=2 * GIB + 1)
    assert not companion.alive
    assert len(apart._IDLE[2 * GIB + 1]) == 1
