"""What `>=` says besides `>`: places with an inner point at which both sides are equal."""

import pytest
import sympy as sp

from canon import PhaseSpace, identity, verify
from canon.claims.edges import edge_of
from canon.claims.reader import read_text

FILE = '[phase_space]\nq = ["x"]\np = ["p"]\nQ = ["X"]\nP = ["Y"]\n'
LINE = '[phase_space]\nq = ["x"]\np = ["p"]\n'


def asked(text: str, claim: str) -> str:
    (found,) = read_text(f"{text}\n[[claim]]\n{claim}\n").claims
    return verify(found).status


def same(lhs: str, rhs: str) -> str:
    return f'kind = "identity"\nlhs = "{lhs}"\nrhs = "{rhs}"'


def more(lhs: str, relation: str, rhs: str = "0") -> str:
    return f'kind = "inequality"\nlhs = "{lhs}"\nrelation = "{relation}"\nrhs = "{rhs}"'


def independent(one: str, other: str) -> str:
    return f'kind = "independent"\nfunctions = ["{one}", "{other}"]'


@pytest.mark.parametrize(
    ("domain", "claim"),
    [
        ('where = ["x >= 0"]\non = ["x*p"]', same("p", "0")),  # false at x = 0, p = 1
        ('where = ["x <= p"]\non = ["x**2 - p**2"]', same("x", "-p")),
        ('where = ["x >= 0"]\non = ["x*(x**2 + p**2 - 1)"]', same("x**2 + p**2", "1")),
        ('where = ["x + abs(x) >= 0"]', more("x + abs(x)", ">")),  # false at x = -1
        ('where = ["sign(x) <= 1"]', more("sign(x)", "<", "1")),
        ('where = ["x + sqrt(x**2) >= 0"]', independent("p", "x + sqrt(x**2)")),
        ('where = ["acosh(cosh(x)) + x >= 0"]', more("acosh(cosh(x)) + x", ">")),  # not meromorphic: |x| + x
        ('where = ["lambertw(x*exp(x)) - x >= 0"]', more("lambertw(x*exp(x)) - x", ">")),  # 0 for x > -1
        ('where = ["atan2(x, 0) + pi/2 >= 0"]', more("atan2(x, 0) + pi/2", ">")),  # 0 for x < 0
        ('where = ["a >= 0"]', independent("x", "a*p")),
        ('where = ["0 <= a < 1"]', independent("x", "a*p")),
        ('where = ["a**2 >= 0"]', independent("x", "a*p")),
        ('where = ["a*x >= 0"]', independent("x", "a*p")),
        ('where = ["a >= 1"]', more("a**2", ">", "1")),
        ('where = ["a**2*(a - 1) >= 0"]', same("sqrt((2*a - 1)**2)", "2*a - 1")),  # false at a = 0
        ('where = ["a >= 0"]\non = ["a*x"]', same("x", "0")),
        ('where = ["b**3 - b**2 >= c"]', same("sqrt((2*b - 1)**2)", "2*b - 1")),  # c can't be less than 0
        ('where = ["V(x) >= 0"]', more("V(x)", ">")),  # false of V = 0
        ('where = ["D(V(x), x) >= 0"]', independent("V(x)", "p")),
    ],
)
def test_an_edge_with_an_inner_point_is_not_shown(domain: str, claim: str) -> None:
    text = f'{LINE}[symbols]\na = "real"\nb = "real"\nc = "nonnegative"\nV = "function"\n[domain]\n{domain}'
    assert asked(text, claim) == "supported"
    assert asked(text.replace(">=", ">").replace("<=", "<"), claim) == "proved"


@pytest.mark.parametrize(
    ("map_", "symbols", "claim"),
    [
        ("x + abs(x)", 'X = "nonnegative"', more("x + abs(x)", ">")),
        ("a*x**2", 'X = "nonnegative"', independent("x", "a*p")),
        ("V(x)", 'X = "nonnegative"', more("V(x)", ">")),
        ("x", 'X = "nonnegative"\n[domain]\non = ["x*p"]', same("p", "0")),
        ("x + abs(x)", '[domain]\nwhere = ["X >= 0"]', more("x + abs(x)", ">")),
    ],
)
def test_nor_is_that_of_a_variable_that_may_be_zero(map_: str, symbols: str, claim: str) -> None:
    text = f'{FILE}[transformation]\nQ = ["{map_}"]\nP = ["p"]\n[symbols]\na = "real"\nV = "function"\n{symbols}'
    assert asked(text, claim) == "supported"
    assert asked(text.replace("nonnegative", "positive").replace("X >=", "X >"), claim) == "proved"


@pytest.mark.parametrize(
    ("domain", "claim"),
    [
        ('where = ["x >= 1"]', more("x", ">")),
        ('where = ["x >= 0"]\non = ["x**2 + p**2 - 1"]', same("sqrt(1 - p**2)", "x")),
        ('where = ["a >= 0"]', same("sqrt(a**2)", "a")),
        ('where = ["a >= 0"]', more("a*x**2", ">=")),
        ('where = ["a >= 0"]', independent("x", "sqrt(a)*p")),  # the root asks for a > 0
        ('where = ["a >= 0"]', independent("x", "p/a")),  # so does a pole
        ('where = ["a >= 0", "a != 0"]', independent("x", "a*p")),
        ('where = ["a >= 0"]', independent("x", "p")),
        ('where = ["p**2/2 + x**2/2 <= a"]', independent("x", "p")),
        ('where = ["sqrt(x**2 + p**2) <= a"]', independent("x", "p")),
        ('where = ["V(x) >= 0"]', same("sqrt(V(x)**2)", "V(x)")),
    ],
)
def test_what_an_edge_does_not_matter_to_is_proved(domain: str, claim: str) -> None:
    assert asked(f'{LINE}[symbols]\na = "real"\nV = "function"\n[domain]\n{domain}', claim) == "proved"


def test_so_is_that_of_a_map_by_a_generating_function() -> None:
    for symbols, where in (('X = "nonnegative"', ""), ('X = "real"', 'where = ["X >= 0"]\n')):
        text = f'{FILE}[symbols]\n{symbols}\n[generating_function]\ntype = 2\nF = "x*Y"\n[domain]\n{where}on = ["x*p"]'
        assert asked(text, same("p", "0")) == "supported"


def test_what_is_canonical_wherever_it_was_looked_at_is_not_refuted() -> None:
    text = f'{FILE}[transformation]\nQ = ["x + (abs(x) - x)*(a - 1)/2"]\nP = ["p"]\n[symbols]\na = "real"\n'
    claim = 'kind = "canonical_when"\nsolutions = [{ a = "1" }]'
    assert asked(text, claim) == "proved"
    assert asked(f'{text}[domain]\nwhere = ["x + abs(x) >= 0"]', claim) == "undecided"
    assert asked(f'{text}[domain]\nwhere = ["x > 0"]', claim) == "refuted"


def test_relations_of_sympy_are_asked_alike() -> None:
    space = PhaseSpace("x", "p", real="a")
    a = space.symbol("a")
    for relation, status in ((sp.Ge(a**2 * (a - 1), 0), "supported"), (a**2 * (a - 1) > 0, "proved")):
        there = space.where(relation)
        assert verify(identity(there, there.formula("sqrt((2*a - 1)**2)"), there.formula("2*a - 1"))).status == status


X, P, A = sp.symbols("x p a", real=True)
M = sp.Symbol("m", positive=True)
V = sp.Function("V")


@pytest.mark.parametrize(
    ("e", "surface", "edge"),
    [
        (X, (), "thin"),
        (1 - sp.Abs(X), (), "thin"),
        (M * X, (), "thin"),
        (A * X - 1, (), "thin"),
        (A - P**2 / (2 * M) - X**2, (), "thin"),
        (A - sp.cos(X), (), "thin"),
        (X - sp.sqrt(P), (), "thin"),
        (sp.log(X), (), "thin"),
        (sp.atan2(X, P), (), "thin"),
        (X, (X**2 + P**2 - 1,), "thin"),
        (A, (), "given"),
        (A - V(X), (), "given"),
        (V(X), (), "given"),
        (V(X).diff(X), (), "given"),
        (A * X, (), "thick"),
        (A**2 * (A - 1), (), "thick"),
        (X + sp.Abs(X), (), "thick"),
        (sp.sqrt(X) * sp.sqrt(P) - sp.sqrt(X * P), (), "thick"),
        (sp.acos(sp.cos(X)) - X, (), "thick"),
        (sp.atan(X) + sp.atan(1 / X) - sp.pi / 2, (), "thick"),
        (V(X) - V(P), (), "thick"),
        (X, (X * P,), "thick"),
        (X, ((X**2 + P**2) * (X - 1),), "thick"),  # the origin is a piece
        (X, (X - A,), "thick"),
        (1 - sp.Abs(sp.Symbol("z")), (), "thick"),
    ],
)
def test_edges(e: sp.Expr, surface: tuple[sp.Expr, ...], edge: str) -> None:
    assert edge_of(e, [X, P], surface) == edge
