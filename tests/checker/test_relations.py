"""Relations of kernels that the checker knows to be proved, and such that only look so."""

import pytest

from canon.checker import core
from canon.checker.formulas import Formulas
from canon.checker.relations import is_proved

KERNELS = {
    "r": "(x**2 + y**2)**(1/2)",
    "h": "(x**2 + y**2)**(1/4)",
    "k": "(r + y)**(1/3)",
    "c": "cos(x*r)",
    "s": "sin(x*r)",
    "s2": "sin(2*x*r)",
    "ch": "cosh(y)",
    "sh": "sinh(y)",
    "a": "abs(x - y)",
    "cn": "jacobi_cn(x, m)",
    "sn": "jacobi_sn(x, m)",
    "dn": "jacobi_dn(x, m)",
    "n": "2**(1/2)",
    "e": "exp(x)",
}


def answer(name: str, relation: dict[str, str], *, real: bool = True) -> bool:
    f = Formulas()
    kernels = {name: f.read(text, {}) for name, text in KERNELS.items()}
    return is_proved(f, name, core.read(relation), kernels, real=real)


@pytest.mark.parametrize(
    ("name", "relation"),
    [
        ("r", {"r^2": "1", "x^2": "-1", "y^2": "-1"}),
        ("h", {"h^2": "1", "r": "-1"}),
        ("h", {"h^4": "1", "x^2": "-1", "y^2": "-1"}),
        ("k", {"k^3": "1", "r": "-1", "y": "-1"}),
        ("s", {"s^2": "1", "c^2": "1", "": "-1"}),
        ("c", {"s^2": "1", "c^2": "1", "": "-1"}),
        ("sh", {"sh^2": "1", "ch^2": "-1", "": "1"}),
        ("ch", {"ch^2": "1", "sh^2": "-1", "": "-1"}),
        ("a", {"a^2": "1", "x^2": "-1", "x y": "2", "y^2": "-1"}),
        ("cn", {"cn^2": "1", "sn^2": "1", "": "-1"}),
        ("dn", {"dn^2": "1", "m sn^2": "1", "": "-1"}),
        ("n", {"n^2": "1", "": "-2"}),
    ],
)
def test_what_the_table_proves(name: str, relation: dict[str, str]) -> None:
    assert answer(name, relation)
    for monomial, coefficient in relation.items():  # each coefficient matters
        other = {**relation, monomial: f"{coefficient}01/100"}
        assert not answer(name, other) or name == "n"  # a number's relation is looked at in fifty digits


@pytest.mark.parametrize(
    ("name", "relation"),
    [
        ("s2", {"s2^2": "1", "c^2": "1", "": "-1"}),  # another argument
        ("h", {"h^3": "1", "r": "-1"}),
        ("r", {"r^2": "1", "r": "1", "x^2": "-1", "y^2": "-1"}),
        ("e", {"e^2": "1", "x": "-1"}),
        ("dn", {"dn^2": "1", "sn^2": "1", "": "-1"}),
    ],
)
def test_what_it_does_not_prove(name: str, relation: dict[str, str]) -> None:
    assert not answer(name, relation)


def test_an_absolute_value_is_one_of_something_real() -> None:
    assert not answer("a", {"a^2": "1", "x^2": "-1", "x y": "2", "y^2": "-1"}, real=False)
