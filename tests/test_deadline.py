"""What can't be asked to stop is stopped: sympy's rules, and what is given to them."""

from __future__ import annotations

import itertools
import math
import sys
import threading
import time

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

    before = threading.active_count()
    start = time.monotonic()
    with pytest.raises(BudgetExceeded, match=r"the budget of .* is spent"):
        within(Budget(0.1), deaf)
    assert time.monotonic() - start < LONG
    assert (undone, threading.active_count()) == ([True], before)


LENGTHS = itertools.cycle((1, 4, 2, 7, 3))
"""Milliseconds, out of step with whoever looks at a clock."""


class Fading:
    """Whoever ends it is, for half of its life, in a callback that nobody hears."""

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
        with pytest.raises(BudgetExceeded):
            within(Budget(0.05), lambda: fading(True))
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
    assert verify(claim, budget=1.0).status == "refuted"
    assert time.process_time() - start < 3.0


def test_exponents_of_a_long_number_are_multiplied_out_by_nobody() -> None:
    """tanh p beside tanh(1001 p/1000), as exponentials: a polynomial of degree 2000 in two names."""
    field = (
        'kind = "hamiltonian_field"\nqdot = ["(1 - tanh(p)**2)*p + tanh(1001*p/1000)", "exp(y/2)"]\npdot = ["0", "0"]\n'
    )
    (claim,) = read_text(f"{HEAD}[[claim]]\n{field}").claims
    start = time.process_time()
    assert verify(claim, budget=20.0).status == "proved"
    assert time.process_time() - start < 5.0


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
