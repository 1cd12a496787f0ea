"""Certificates of solutions that have no value, or not the sign that is declared, where an equation calls them."""

import pytest

from canon.checker.check import check
from canon.checker.functions import Unreadable
from tests.checker.certified import certified, resealed

SPACE = "[phase_space]\nq = ['q']\np = ['p']\n[symbols]\nt = 'positive'\nx = {}\n"
CLAIM = "kind = 'solves'\nsolution = {'x(t)' = '1 + t'}\nequations = ['x(2) - 3']"


def changed(solution: str, equation: str, words: str = "'function'") -> str:
    data = certified(SPACE.format(words), CLAIM)
    assert str(check(data)) == "confirmed"
    data["tables"]["claim"] |= {"solution": {"x(t)": solution}, "equations": [equation]}
    try:
        return check(resealed(data)).status
    except Unreadable:
        return "unreadable"


@pytest.mark.parametrize(
    ("solution", "equation"),
    [
        ("1 + t + 0*log(t)", "x(0) - 1"),
        ("1 + t + 0*log(t)", "x(-t) - 1 + t"),
        ("1 + t + 0/t", "x(0) - 1"),
        ("1 + t + 0*log(t)", "0*x(0)"),
        ("1 + t + 0*sqrt(t - 1)", "x(1/2) - 3/2"),
    ],
)
def test_a_value_that_there_is_not(solution: str, equation: str) -> None:
    assert changed(solution, equation) in ("not confirmed", "unreadable")


def test_the_same_where_there_is_one() -> None:
    assert changed("1 + t + 0*log(t)", "x(2) - 3") == "confirmed"
    assert changed("1 + t + 0*sqrt(t - 1)", "x(3) - 4") == "confirmed"


def test_a_function_is_as_it_is_declared_where_it_is_called() -> None:
    assert changed("t + 1", "x(-1)", words="['function', 'nonzero']") in ("not confirmed", "unreadable")
    assert changed("t + 1", "x(-3) + 2", words="['function', 'positive']") in ("not confirmed", "unreadable")
