"""What can't be asked to stop is stopped: sympy's rules, and what is given to them."""

from __future__ import annotations

import itertools
import math
import sys
import threading
import time
from typing import Any

import pytest

from canon import verify
from canon.budget import Budget
from canon.claims.reader import read_text
from canon.deadline import within
from canon.decide.ring import Ring, TooCostly
from canon.errors import BudgetExceeded

LONG = 60.0


def test_answers_and_errors_pass() -> None:
    for seconds in (math.inf, 20.0):
        assert within(Budget(seconds), lambda: 7) == 7
        with pytest.raises(ZeroDivisionError, match="as it was"):
            within(Budget(seconds), lambda: (_ for _ in ()).throw(ZeroDivisionError("as it was")))
    with pytest.raises(BudgetExceeded):
        within(Budget(0.0), lambda: pytest.fail("nothing is begun"))


def test_what_goes_on_for_ever_is_ended() -> None:
    """Also where it catches whatever is an error; and what it holds is given back."""
    undone = []

    def deaf() -> None:
        try:
            while True:
                try:
                    sum(range(100))
                except Exception:
                    pytest.fail("it is no error")
        finally:
            undone.append(True)

    before = {*threading.enumerate()}
    start = time.monotonic()
    with pytest.raises(BudgetExceeded, match=r"the budget of .* is spent"):
        within(Budget(0.1), deaf)
    assert time.monotonic() - start < LONG
    assert (undone, {*threading.enumerate()} - before) == ([True], set())


LENGTHS = itertools.cycle((1, 4, 2, 7, 3))
"""Milliseconds, out of step with whoever looks at a clock."""


class Fading:
    """Whoever ends it is, for half of its life, in a callback that nobody hears."""

    fails = False  # of one whose making is interrupted

    def __init__(self, fails: bool) -> None:
        self.fails = fails
        _pass(0.001 * next(LENGTHS))

    def __del__(self) -> None:
        _pass(0.001 * next(LENGTHS))
        if self.fails:
            raise ValueError("told as ever")


def _pass(seconds: float) -> None:
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        pass


def test_what_is_raised_where_nobody_hears_is_raised_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """It is no news to anybody, either; what others lose there is."""
    told: list[str] = []
    monkeypatch.setattr(sys, "unraisablehook", lambda lost: told.append(str(lost.exc_value)))
    hook, going = sys.unraisablehook, threading.Event()
    going.set()

    def fading(fails: bool) -> None:
        while going.is_set():
            Fading(fails)

    try:
        for tried in range(10):
            with pytest.raises(BudgetExceeded):
                within(Budget(0.02 + tried / 1000), lambda: fading(False))
        assert (told, sys.unraisablehook) == ([], hook)
        for tried in range(100):  # until one has faded before its time was over
            with pytest.raises(BudgetExceeded):
                within(Budget(0.05 + tried / 100), lambda: fading(True))
            if told:
                break
    finally:
        going.clear()
    assert set(told) == {"told as ever"}


def test_what_is_busy_elsewhere_is_left_until_it_comes_back() -> None:
    release = threading.Event()
    start = time.monotonic()
    with pytest.raises(BudgetExceeded):
        within(Budget(0.05), lambda: release.wait(LONG))
    assert time.monotonic() - start < LONG / 2
    release.set()


HEAD = '[phase_space]\nq = ["q", "x"]\np = ["p", "y"]\n'


def test_a_claim_keeps_to_its_budget() -> None:
    """An integral of which sympy's rules find no antiderivative, in four minutes: it is enclosed instead."""
    integral = 'f = "log(1 + q)/((1 + q**3)*sqrt(1 + q))"\nvariable = "q"\nfrom = "0"\nto = "1"\nequals = "1"\n'
    (claim,) = read_text(f'{HEAD}[[claim]]\nkind = "integral"\n{integral}').claims
    start = time.process_time()
    assert verify(claim, budget=10.0).status == "refuted"
    assert time.process_time() - start < 30.0


def test_exponents_of_a_long_number_are_multiplied_out_by_nobody() -> None:
    """tanh p beside tanh(1001 p/1000), as exponentials: a polynomial of degree 2000 in two names."""
    field = (
        'kind = "hamiltonian_field"\nqdot = ["(1 - tanh(p)**2)*p + tanh(1001*p/1000)", "exp(y/2)"]\npdot = ["0", "0"]\n'
    )
    (claim,) = read_text(f"{HEAD}[[claim]]\n{field}").claims
    start = time.process_time()
    assert verify(claim, budget=20.0).status == "proved"
    assert time.process_time() - start < 10.0


def test_what_flint_cant_do_in_time_is_not_begun() -> None:
    ring = Ring(4, 1e30, Budget(0.2))
    sums = sum(ring.generators, ring.one)
    with pytest.raises(TooCostly, match="in the time that is left"):
        ring.power(sums, 200)
    assert len(ring.power(sums, 3)) == 35


@pytest.mark.slow
def test_a_hamiltonian_beyond_all_floats_is_no_energy() -> None:
    """At some of the points that are tried it is infinite as a floating-point number."""
    H = "p**2/(2*m) + D*(1 - exp(-alpha*((q + 1/3)**7)))**2"
    symbols = "".join(f'{name} = "positive"\n' for name in ("m", "D", "alpha"))
    head = f'[phase_space]\nq = ["q"]\np = ["p"]\n[symbols]\n{symbols}[hamiltonian]\nH = "{H}"\n'
    equals = "2*pi*sqrt(2*m)*(sqrt(D) - sqrt(D - 1001*E/1000))/alpha"
    text = f'[[claim]]\nkind = "action"\ncoordinate = "q"\nenergy = "E"\nequals = "{equals}"\n'
    (claim,) = read_text(head + text).claims
    assert verify(claim, budget=3.0).status in ("undecided", "supported", "refuted")


INTEGRAL = f'{HEAD}[[claim]]\nkind = "integral"\nf = "q*exp(q)"\nvariable = "q"\nfrom = "0"\nto = "1"\nequals = "1"\n'


def test_a_rule_that_was_given_up_finds_its_answer_the_next_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """Sympy's rules for integrals note what they are at, and take a note that they left behind for a circle."""
    from sympy.integrals import manualintegrate as rules

    def given_up(*_: object) -> None:
        raise RecursionError

    with monkeypatch.context() as broken:
        broken.setattr(rules, "find_substitutions", given_up)
        (claim,) = read_text(INTEGRAL).claims
        assert verify(claim).status == "supported"
    (claim,) = read_text(INTEGRAL).claims
    assert verify(claim).status == "proved"


@pytest.mark.parametrize("seconds", [1e12, 1e300, math.inf])
def test_a_budget_without_an_end_is_none_too_long(seconds: float) -> None:
    (claim,) = read_text(INTEGRAL).claims
    assert verify(claim, budget=seconds).status == "proved"


def test_threads_that_are_ended_at_once_leave_nothing_behind() -> None:
    """Neither what Python prints lost errors with, nor a thread; each is ended, though others end before it."""
    hook, before, ended = sys.unraisablehook, threading.active_count(), []

    def asks(late: float) -> None:
        undo = threading.Event()

        def busy() -> None:
            try:
                while True:
                    sum(range(100))
            finally:
                undo.wait(late)  # one that undoes for a while: the others begin and end meanwhile

        with pytest.raises(BudgetExceeded):
            within(Budget(0.02 + late / 10), busy)
        ended.append(late)

    asking = [threading.Thread(target=asks, args=(late,)) for late in (0.2, 0.05, 0.3, 0.1)]
    for thread in asking:
        thread.start()
    for thread in asking:
        thread.join(LONG)
    assert (sys.unraisablehook, len(ended)) == (hook, 4)
    end = time.monotonic() + LONG
    while threading.active_count() > before and time.monotonic() < end:
        time.sleep(0.01)
    assert threading.active_count() == before


def test_nothing_is_raised_in_a_thread_whose_work_is_over(monkeypatch: pytest.MonkeyPatch) -> None:
    """What ends just as its time is over ends quietly: its answer counts, or it is given up, and nothing is printed."""
    told: list[object] = []
    monkeypatch.setattr(threading, "excepthook", told.append)
    monkeypatch.setattr(sys, "unraisablehook", told.append)
    answers = []
    for tried in range(200):
        seconds = 0.001 + tried % 7 / 5000
        try:
            answers.append(within(Budget(seconds), lambda: _pass(seconds)))  # noqa: B023
        except BudgetExceeded:
            continue
    assert told == []
    assert set(answers) <= {None}


def test_threads_that_ask_at_once_take_turns(monkeypatch: pytest.MonkeyPatch) -> None:
    """The precision of the balls is the process's own: it stays what it was, and no other's claim changes it."""
    import flint

    from canon.claims import verify as module

    (claim,) = read_text(INTEGRAL).claims
    decide, inside, together = module.kind_named(claim.kind), [], []

    def alone(question: Any) -> Any:
        inside.append(None)
        _pass(0.02)
        together.append(len(inside))
        outcome = decide(question)
        inside.pop()
        return outcome

    monkeypatch.setattr(module, "kind_named", lambda kind: alone)
    before, found = flint.ctx.prec, []
    asking = [threading.Thread(target=lambda: found.append(verify(claim).status)) for _ in range(4)]
    for thread in asking:
        thread.start()
    for thread in asking:
        thread.join(LONG)
    assert (found, together, flint.ctx.prec) == (["proved"] * 4, [1] * 4, before)
