"""Threads that compute in balls: the precision and the length of series are the process', so they take turns."""

import sys
import threading
from collections.abc import Callable, Iterator
from typing import Any

import flint
import pytest
import sympy as sp

from canon import PhaseSpace, Transformation, certify, lie_sum, motion, nested_bracket, verify
from canon.ball_precision import precision
from canon.budget import Budget
from canon.deadline import within
from canon.mechanics.statements import bracket
from canon.turns import in_turn

q, p = sp.symbols("q p", real=True)
SPACE = PhaseSpace("q", "p", new=("Q", "P"))
BENT = Transformation(SPACE, Q=SPACE.q[0] + sp.sin(SPACE.p[0]) / 10, P=SPACE.p[0])
SWING = motion(p**2 / 2 - sp.cos(q))
AT = {q: 1.0, p: 0.5}
CALLS: tuple[Callable[[], Any], ...] = (
    lambda: lie_sum(q, q**2 * p, (q,), (p,), AT, 0.99),
    lambda: nested_bracket(sp.sin(q), q**2 * p + p**2 * sp.exp(q), (q,), (p,), AT, 30),
    lambda: certify(BENT, (-1, 1), boxes=4, budget=60.0).upper,
    lambda: SWING.point(1.0, 0.3),
    lambda: verify(bracket(SPACE, SPACE.q[0], SPACE.p[0], 1)).status,
)


@pytest.fixture
def eager() -> Iterator[None]:
    """Threads that are changed often."""
    usual = sys.getswitchinterval()
    sys.setswitchinterval(1e-4)
    yield
    sys.setswitchinterval(usual)


@pytest.mark.usefixtures("eager")
def test_threads_compute_what_one_computes() -> None:
    """Some gave 0 exactly for −4e41, and 40.2 ± 1e-16 for 100: with series that another thread had cut short."""
    before = flint.ctx.prec, flint.ctx.cap
    expected = [call() for call in CALLS]
    wrong = []

    def work(first: int) -> None:
        for k in range(2 * len(CALLS)):
            place = (first + k) % len(CALLS)
            found = CALLS[place]()
            if found != expected[place]:
                wrong.append((place, found))

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(120)
    assert not wrong
    assert (flint.ctx.prec, flint.ctx.cap) == before


@pytest.mark.parametrize("bits", [20, 400])
def test_the_precision_of_who_asks_changes_nothing(bits: int) -> None:
    """It did: a Lie sum's bound was computed after its own precision had been put back."""
    for call in CALLS:
        alone = call()
        with precision(bits):
            assert call() == alone


def test_a_thread_that_is_waited_for_has_the_turn_too() -> None:
    def bits() -> int:
        with precision(77), in_turn():
            return flint.ctx.prec

    with in_turn():
        assert within(Budget(20.0), bits) == 77
        assert within(Budget(20.0), lambda: within(Budget(10.0), bits)) == 77
    assert within(Budget(20.0), bits) == 77


def test_others_wait_until_the_turn_is_over() -> None:
    order = []

    def other() -> None:
        with precision(99):
            order.append("other")

    thread = threading.Thread(target=other)
    with in_turn():
        thread.start()
        thread.join(0.1)
        order.append("first")
    thread.join(20)
    assert order == ["first", "other"]
    with pytest.raises(ZeroDivisionError), precision(99):
        raise ZeroDivisionError
    assert flint.ctx.prec == 53
