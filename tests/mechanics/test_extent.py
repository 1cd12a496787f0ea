"""Formulas of sympy's that are too large, or too deep, are refused before anybody walks them as trees."""

import sys
import time
from functools import reduce

import pytest
import sympy as sp

from canon import Formula, InputError, PhaseSpace, Transformation, bracket, identity, poisson_bracket, verify
from canon.mechanics.extent import extent_of

SPACE = PhaseSpace("q", "p", new=("Q", "P"))
q, p = SPACE.old


def squares(k):
    """Shared as 2 k objects, 2ᵏ⁺² nodes as a tree."""
    e = q
    for _ in range(k):
        e = sp.Add(sp.Mul(e, e, evaluate=False), 1, evaluate=False)
    return e


def sines(k):
    e = q
    for _ in range(k):
        e = sp.sin(e)
    return e


def refusal(make):
    start = time.monotonic()
    with pytest.raises(InputError) as caught:
        make()
    assert time.monotonic() - start < 1
    return str(caught.value)


def test_the_extent_is_that_of_the_tree():
    assert extent_of(q) == (1, 1)
    assert extent_of(squares(3))[0] == 8 + 3 * 7
    assert extent_of(q * p + 1, {q: (10, 4)}) == (14, 6)


MAKERS = [
    lambda e: identity(SPACE, e, e),
    lambda e: bracket(SPACE, e, p, 1),
    lambda e: poisson_bracket(e, p, SPACE),
    lambda e: Transformation(SPACE, Q=q, P=p + e),
    lambda e: SPACE.where(sp.Gt(e, 0, evaluate=False)),
    lambda e: identity(SPACE, Formula(e), 0),
]


@pytest.mark.parametrize("make", MAKERS)
def test_shared_squares_and_towers_are_refused_at_once(make):
    assert "too large: more than" in refusal(lambda: make(squares(60)))
    assert "levels deep" in refusal(lambda: make(sines(150)))


def test_what_a_file_could_hold_is_decided():
    assert verify(identity(SPACE, squares(8), squares(8))).status == "proved"
    assert verify(identity(SPACE, sines(70), sines(70) + 1)).status == "refuted"


def test_numbers_and_exponents_are_bounded():
    long = sp.Integer(10) ** 5000
    for value in (long, 10**5000, q / long, long * q):
        assert "more than 10000 bits" in refusal(lambda value=value: identity(SPACE, value, value))
    assert "an exponent above" in refusal(lambda: identity(SPACE, (q + 1) ** 10**6, q))
    assert "an exponent above" in refusal(lambda: identity(SPACE, (q**2 + 1) ** sp.Rational(1, 10**6), q))


def test_iterated_maps_are_refused_before_they_are_written_out():
    step = Transformation(PhaseSpace("q", "p", new=("q1", "p1")), Q=q + p, P=p - sp.sin(q + p))
    start = time.monotonic()
    with pytest.raises(InputError, match=r"too large|levels deep"):
        reduce(lambda done, _: done.after(step), range(40), step)
    assert time.monotonic() - start < 5


def test_a_small_limit_of_recursion_is_an_error_of_input():
    formula, depth, frame = sines(90), 0, sys._getframe()
    while frame is not None:
        depth, frame = depth + 1, frame.f_back
    before = sys.getrecursionlimit()
    try:
        sys.setrecursionlimit(depth + 150)
        with pytest.raises(InputError, match="limit of recursion"):
            poisson_bracket(formula, p, SPACE)
    finally:
        sys.setrecursionlimit(before)
