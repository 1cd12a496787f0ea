"""What a refutation of `canonical` teaches: scales, failing brackets, parameters, repairs, each of them proved."""

import pytest
import sympy as sp

from canon.claims import parameters, potential

CANONICAL = 'kind = "canonical"'
x, y, b = sp.symbols("x y b", real=True)


def lesson(ask, Q: str, P: str, **sections: str) -> dict:
    (verdict,) = ask(CANONICAL, transformation=f'Q = ["{Q}"]\nP = ["{P}"]', **sections)
    assert verdict.status == "refuted"
    return dict(verdict.detail)


@pytest.mark.parametrize(
    ("Q", "P", "scale"), [("p", "q", "-1"), ("2*q", "3*p", "6"), ("(q + 1j*p)/sqrt(2)", "(q - 1j*p)/sqrt(2)", "-I")]
)
def test_the_constant_scale_is_named(ask, Q, P, scale):
    assert lesson(ask, Q, P)["scale"] == scale


def test_a_missing_factor(ask):
    """P = p/(2q) belongs to Q = q²."""
    found = lesson(ask, "q**2", "p")
    assert found["brackets"] == {"{Q, P}": "2*q"}
    assert found["repair"] == "divide P by 2*q, where that is not 0"


def test_a_missing_factor_that_is_never_zero(ask):
    assert lesson(ask, "q**2*a", "p", symbols='a = "positive"\nq = "positive"')["repair"] == "divide P by 2*a*q"


def test_what_is_taught_is_bounded_by_counts(monkeypatch):
    """Not by the clock, so that every machine teaches the same."""
    assert [tired() for tired in [potential.tired_after(2)] * 4] == [False, False, True, True]
    equations, names = [b * (x - 1), b * (x - y)], [x, y]
    assert parameters.solutions(equations, names) == [{x: 1, y: 1}]
    monkeypatch.setattr(parameters, "MOST_STEPS", 0)
    assert parameters.solutions(equations, names) == []


def test_a_sign_in_a_formula(ask):
    found = lesson(ask, "q*cos(a) + p*sin(a)", "q*sin(a) + p*cos(a)", symbols='a = "real"')
    assert found["repair"].startswith("the sign of the term")


def test_a_sign_of_one_pair(ask):
    (verdict,) = ask(
        CANONICAL,
        space='q = ["x", "y"]\np = ["px", "py"]\nQ = ["X", "Y"]\nP = ["PX", "PY"]\n',
        transformation='Q = ["px", "y"]\nP = ["x", "py"]',
    )
    assert verdict.detail["repair"] == "the sign of PX"


def test_a_swapped_pair(ask):
    (verdict,) = ask(
        CANONICAL,
        space='q = ["x", "y"]\np = ["px", "py"]\nQ = ["X", "Y"]\nP = ["PX", "PY"]\n',
        transformation='Q = ["x", "y"]\nP = ["py", "px"]',
    )
    assert verdict.detail["repair"].startswith("exchange")


def test_values_of_parameters(ask):
    found = lesson(ask, "q**a*cos(b*p)", "q**a*sin(b*p)", symbols='a = "real"\nb = "real"')
    assert found["holds_when"] == [{"a": "1/2", "b": "2"}]
    assert found["brackets"] == {"{Q, P}": "a*b*q**(2*a)/q"}


def test_nothing_is_divided_by_zero(ask):
    found = lesson(ask, "q", "p*(cos(a)**2 + sin(a)**2 - 1)", symbols='a = "real"')
    assert "repair" not in found
    assert "scale" not in found


def test_a_map_that_nothing_simple_repairs(ask):
    found = lesson(ask, "q", "q")
    assert found["brackets"] == {"{Q, P}": "0"}
    assert "repair" not in found
