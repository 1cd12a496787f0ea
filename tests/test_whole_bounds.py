"""Whole numbers compared by >=: their edge belongs to the domain."""

import pytest
import sympy as sp

from canon import InputError, PhaseSpace, identity, verify
from canon.checker.formulas import Formulas
from canon.checker.functions import Unreadable
from canon.checker.whole import at_least_zero as of_checker
from canon.whole_bounds import at_least_zero

SPACE = PhaseSpace("q", "p", integer="n m", real="a")
n, m, a, q = (SPACE.symbol(name) for name in ("n", "m", "a", "q"))


@pytest.mark.parametrize(
    ("where", "lhs", "status"),
    [
        ("n >= 1", "sqrt((2*n - 3)**2)", "refuted"),  # at n = 1 alone
        ("n >= 2", "sqrt((2*n - 3)**2)", "proved"),
        ("2 <= n", "sqrt((2*n - 3)**2)", "proved"),
        ("1 <= n <= 2", "sqrt((2*n - 3)**2)", "refuted"),
        ("n/2 >= 1", "sqrt((2*n - 3)**2)", "proved"),
        ("n/2 >= 1/2", "sqrt((2*n - 3)**2)", "refuted"),
    ],
)
def test_the_edge_is_asked(where: str, lhs: str, status: str) -> None:
    space = SPACE.where(where)
    assert verify(identity(space, space.formula(lhs), space.formula("2*n - 3"))).status == status


def test_relations_of_sympy_are_read_alike() -> None:
    for relation, status in ((sp.Ge(n, 1), "refuted"), (sp.Le(2, n), "proved")):
        space = SPACE.where(relation)
        assert verify(identity(space, space.formula("sqrt((2*n - 3)**2)"), space.formula("2*n - 3"))).status == status


def values(e: sp.Expr) -> list[tuple[int, int]]:
    places = [(i, k) for i in range(-4, 5) for k in range(-4, 5)]
    return [(i, k) for i, k in places if e.subs({n: i, m: k}) > 0]


@pytest.mark.parametrize(
    "e", [n, n - m, n * (n - 1) / 2 - m, n / 6 + m / 4, (n / 2 - m / 3) ** 3, sp.Abs(n) - 2, n * sp.sign(m), 3 - n**2]
)
def test_it_holds_where_the_difference_is_not_negative(e: sp.Expr) -> None:
    places = [(i, k) for i in range(-4, 5) for k in range(-4, 5)]
    assert values(at_least_zero(e, "")) == [(i, k) for i, k in places if e.subs({n: i, m: k}) >= 0]


@pytest.mark.parametrize(
    "e", [a, a - n, n * a - 1, a**2 + n * q, sp.exp(q) + a - n, a * (n * q - 1), a + sp.Abs(q) * n]
)
def test_an_edge_without_an_inner_point_is_left_out(e: sp.Expr) -> None:
    assert at_least_zero(e, "") is e


@pytest.mark.parametrize(
    "e",
    [
        n * a,
        n * a * q + n,
        2**n - 1,
        n - sp.pi,
        1 / n - 1,
        sp.exp(n),
        n * sp.sin(a),
        n + sp.Abs(q) + q,
        n * q + m,
        n**n,
    ],
)
def test_what_may_be_equal_all_over_is_refused(e: sp.Expr) -> None:
    with pytest.raises(InputError, match="equal all over a part of the domain"):
        at_least_zero(e, "the text")


@pytest.mark.parametrize(
    ("text", "positive"),
    [
        ("n", "2*n + 1"), ("n*(n - 1)/2", "2*n*(n - 1) + 1"), ("abs(n) - 1/3", "6*abs(n) - 1"),
        ("(n/2)**2", "2*n**2 + 1"),
        ("x - n", "x - n"), ("n*x", None), ("n - pi", None), ("1/n", None), ("2**n", None), ("sqrt(n)", None),
    ],
)  # fmt: skip
def test_the_checker_reads_them_alike(text: str, positive: str | None) -> None:
    f = Formulas([], [], {"n": ["integer"]})
    read = lambda text: f.read(text, {})
    if positive is None:
        with pytest.raises(Unreadable, match="equal all over a part of the domain"):
            of_checker(f, read(text), {"n"})
        return
    found = of_checker(f, read(text), {"n"})
    left, right = (f.substitute(b, {"n": f.number(5), "x": f.number(2)}) for b in (found, read(positive)))
    assert f.text(left) == f.text(right) or f.value(left) == f.value(right)
