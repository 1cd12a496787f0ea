"""Refutations of claims that constraints are *not* holonomic, and that multipliers are *not* determined."""

import pytest

from canon.checker.check import check
from tests.checker.certified import certified, resealed

SPACE = "[phase_space]\nq = ['x', 'y', 'z']\np = ['a', 'b', 'c']\n[symbols]\nm = 'positive'\n"
FORMS = "kind = 'constraint'\nvelocities = ['u', 'v', 'w']\nforms = [{}]\nholonomic = {}"
MULTIPLIERS = (
    "kind = 'constraint'\nvelocities = ['u', 'v', 'w']\nfunctions = [{}]\nL = 'm*(u**2 + v**2 + w**2)/2'\n"
    "determined = {}"
)


@pytest.mark.parametrize("form", ["x*u + y*v + z*w", "u + v + w", "y*u + x*v", "y*z*u + x*z*v + x*y*w"])
def test_a_form_that_is_integrable_isnt_non_holonomic(form: str) -> None:
    data = certified(SPACE, FORMS.format(repr(form), "false"))
    assert data["verdict"] == "refuted"
    assert str(check(data)) == "confirmed"


def test_a_form_that_isnt_integrable_is_not_refuted_so() -> None:
    data = certified(SPACE, FORMS.format("'x*u + y*v + z*w'", "false"))
    for form in ("y*u - x*v + w", "y*u + w", "x*u + y*v + x*w"):
        data["tables"]["claim"]["forms"] = [form]
        assert str(check(resealed(data))) not in ("confirmed", "shown")
    for form in ("0*u", "x*u - x*u", "u - u + 0*v"):  # no form at all: the claim takes for granted that there is one
        data["tables"]["claim"]["forms"] = [form]
        assert not str(check(resealed(data))).startswith("confirmed")


@pytest.mark.parametrize("function", ["x**2 + y**2 - 1", "x - y", "x**2 + y**2 + z**2 - 3"])
def test_multipliers_of_a_surface_are_determined(function: str) -> None:
    data = certified(SPACE, MULTIPLIERS.format(repr(function), "false"))
    assert data["verdict"] == "refuted"
    assert str(check(data)) == "confirmed"


def test_multipliers_that_are_open_are_not_refuted_so() -> None:
    data = certified(SPACE, MULTIPLIERS.format("'x - y'", "false"))
    for functions in (["x - y", "y - x"], ["x - y", "2*x - 2*y"]):
        data["tables"]["claim"]["functions"] = functions
        assert not str(check(resealed(data))).startswith("confirmed")


@pytest.mark.parametrize("functions", ["'x - 2', '2*x - 4'", "'x - y', '2*x - 2*y'", "'x**2 + y**2 - 1', 'z', '2*z'"])
def test_constraints_that_follow_from_others_leave_the_multipliers_open(functions: str) -> None:
    """Points are found though the equations aren't independent."""
    data = certified(SPACE, MULTIPLIERS.format(functions, "false"))
    assert data["verdict"] == "proved"
    assert check(data).status in ("confirmed", "confirmed in part")


def test_constraints_that_contradict_one_another_have_no_point() -> None:
    data = certified(SPACE, MULTIPLIERS.format("'x - y', '2*x - 2*y'", "false"))
    data["tables"]["claim"]["functions"][1] = "2*x - 2*y - 1"
    assert str(check(resealed(data))) == "not confirmed: the checker found no point of the domain"
