"""Lie algebras for all values of parameters, on surfaces, and by more names: what is shown, and near misses."""

from fractions import Fraction
from itertools import product
from typing import Any

import pytest

from canon.checker import alone, alone_names, alone_parameters, alone_together
from tests.checker.certified import certified, resealed

SPACE: Any = {"phase_space": {"q": ["x", "y", "z"], "p": ["u", "v", "w"]}}
NAMES = {"m": "positive", "a": "positive", "b": "positive", "k": "real", "h": "real", "e": "negative", "n": "integer"}
SPIN = {"A": "y*w - z*v", "B": "z*u - x*w", "C": "x*v - y*u"}
CYCLE = {"A,B": "C", "B,C": "A", "C,A": "B"}
PLANE = {"phase_space": {"q": ["x", "y"], "p": ["u", "v"]}, "definitions": {"r": "sqrt(x**2 + y**2)"}}
RUNGE = {"L": "x*v - y*u", "F": "v*(x*v - y*u) - m*a*x/r", "G": "-u*(x*v - y*u) - m*a*y/r"}
ENERGY = "(u**2 + v**2)/(2*m) - a/r"


def answer(basis: Any, structure: Any = None, equals: str = "", known: Any = None, **sections: Any) -> str:
    """The answer about a claim that functions make a Lie algebra."""
    claim = {"kind": "algebra", "basis": basis, **({"structure": structure} if structure is not None else {})}
    claim |= {"equals": equals} if equals else {}
    tables = {**SPACE, "symbols": NAMES, **sections, "claim": claim}
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "known": {"structure": known or {}},
        "witness": None,
            "cases": [{}]}  # fmt: skip
    return alone_parameters.checked(resealed(data))[0]


SHOWN: Any = [
    (SPIN, CYCLE, "so(3)"), ({"A": "x", "B": "u", "C": "1"}, {"A,B": "C"}, "h(1)"),
    ({"A": "m*x", "B": "u/m"}, {}, None),
    ({"A": "x + k*y", "B": "y + v", "C": "1"}, {"A,B": "k*C"}), ({"A": "x*u", "B": "u*m"}, {"A,B": "B"}, "aff(1)"),
    ({"A": "m*x*u", "B": "u"}, {"A,B": "m*B"}, "aff(1)"),
    ({"A": "a*x", "B": "m*u", "C": "1"}, {"A,B": "a*m*C"}, "h(1)"),
    ({"A": "a*(y*w - z*v)", "B": "a*(z*u - x*w)", "C": "x*v - y*u"}, {"A,B": "a**2*C", "B,C": "A", "C,A": "B"},
        "so(3)"),
    ({"A": "u**2/(2*m) + a*x**2/2", "B": "u**2/(2*m) - a*x**2/2", "C": "x*u"},
        {"A,B": "2*a/m*C", "B,C": "-2*A", "A,C": "-2*B"}, "sl(2,R)"),
]  # fmt: skip


@pytest.mark.parametrize("given", SHOWN)
def test_parameters(given: Any) -> None:
    basis, structure, *name = given
    turned = answer(basis, {pair: f"-({text}) - ({text})" for pair, text in structure.items()}) if structure else ""
    if name and not name[0]:
        assert (answer(basis, {"A,B": "m*0*A"}), turned) == ("not shown", "")
        return
    assert (answer(basis, structure, *name), turned) == ("shown", "not shown")


MISSES: Any = [
    ({"A": "k*u", "B": "v"}, {}), ({"A": "(a - m)*u", "B": "v"}, {}), ({"A": "(a - 1)*u", "B": "v"}, {}),
    ({"A": "sqrt(u**2)", "B": "u"}, {}),
    ({"A": "n*u", "B": "v"}, {}), ({"A": "u", "B": "v/k - v/h"}, {}), ({"A": "a*u + m*v", "B": "m*u + a*v"}, {}),
    ({"A": "sqrt(a*u**2)", "B": "u"}, {}), ({"A": "sqrt((u**2 + v**2)**2)", "B": "u**2 + v**2"}, {}),
    ({"A": "u", "B": "t*u"}, {}),
    ({"A": "sqrt(u**2)*sqrt(v**2)", "B": "u*v"}, {}), ({"A": "sqrt(u)*sqrt(v)", "B": "sqrt(u*v)"}, {}),
    ({"A": "u*0", "B": "v"}, {}),
    ({"A": "x*u", "B": "u", "C": "y*v", "D": "v"}, {"A,B": "B", "C,D": "D"}, "aff(1)"),
    ({"A": "k*x*u", "B": "u"}, {"A,B": "k*B"}, "aff(1)"),
    ({"A": "x*u + a*y*v", "B": "u", "C": "v"}, {"A,B": "B", "A,C": "a*C"}, "e(3)"),
    ({"A": "(a - m)*x", "B": "u", "C": "1"}, {"A,B": "(a - m)*C"}, "h(1)"), (SPIN, CYCLE, "sl(2,R)"),
    (SPIN, CYCLE, "bargmann"),
    ({"A": "u**2/(2*m) - e*x**2/2", "B": "u**2/(2*m) + e*x**2/2", "C": "x*u"},
        {"A,B": "-2*e/m*C", "B,C": "-2*A", "A,C": "-2*B"}, "so(3)"),
]  # fmt: skip


@pytest.mark.parametrize("given", MISSES)
def test_parameters_for_which_it_fails_show_nothing(given: Any) -> None:
    assert answer(*given) == "not shown"


def on(equation: str, *where: str) -> Any:
    return {**PLANE, "domain": {"on": [equation], **({"where": [*where]} if where else {})}}


FLAT = {"L,F": "G", "L,G": "-F"}
BENT = {"L,F": "G", "L,G": "-F", "F,G": "-2*m*h*L"}
LOWER = {"L,F": "G", "L,G": "-F", "F,G": "-2*m*b*L"}
KEPLER: Any = [
    (FLAT, "", ENERGY, "shown"), (FLAT, "e(2)", ENERGY, "not shown"), (FLAT, "", f"{ENERGY} - h", "not shown"),
    (BENT, "", f"{ENERGY} - h", "shown"), ({**BENT, "F,G": "2*m*h*L"}, "", f"{ENERGY} - h", "not shown"),
    (LOWER, "so(2,1)", f"{ENERGY} - b", "shown"), (LOWER, "so(3)", f"{ENERGY} - b", "not shown"),
    (LOWER, "", f"{ENERGY} + b", "not shown"), (FLAT, "", f"{ENERGY} - b", "not shown"),
]  # fmt: skip


@pytest.mark.parametrize("given", KEPLER)
def test_on_a_surface(given: Any) -> None:
    structure, name, equation, expected = given
    assert answer(RUNGE, structure, name, **on(equation)) == expected


@pytest.mark.parametrize("given", [
    ({"A": "x", "B": "y"}, {}, "x"), ({"A": "x", "B": "y"}, {}, "x - y"), ({"A": "u", "B": "v"}, {}, "u**2 - v**2"),
    ({"A": "u**2", "B": "v**2"}, {}, "u**2 + v**2 - 2*v**2"), ({"A": "u", "B": "x"}, {}, "u**2 + v**2"),
    ({"A": "u"}, {}, "u*x"),
    ({"A": "u", "B": "v"}, {}, "a*x - a*y*X"), ({"A": "u", "B": "v"}, {}, "u - v - k"),
    ({"A": "u", "B": "k*v"}, {}, "x - 1"),
    ({"A": "u", "B": "u*(x**2 + y**2 - 1)"}, {}, "x**2 + y**2 - 1"), ({"A": "x", "B": "u"}, {}, "x - 1"),
    ({"A": "u**2 + v**2", "B": "1"}, {}, "u**2 + v**2 - 2*m*b"),
])  # fmt: skip
def test_a_basis_that_depends_on_a_surface_shows_nothing(given: Any) -> None:
    basis, structure, equation = given
    assert answer(basis, structure, **on(equation)) == "not shown"


def test_a_surface_that_leaves_the_basis_alone() -> None:
    assert answer({"A": "u", "B": "v"}, {}, **on("x - y")) == "shown"
    assert answer({"A": "u", "B": "v"}, {}, **on("x**2 + y**2 - b")) == "shown"
    assert answer({"A": "u", "B": "v"}, {}, **on("x**2 + y**2 - k")) == "not shown"  # none, or a point


# -- names, by constants


def algebra(n: int, brackets: Any) -> Any:
    """Structure constants of a table (i, j): {k: number}."""
    c = [[[Fraction(0)] * n for _ in range(n)] for _ in range(n)]
    for (i, j), row in brackets.items():
        for k, x in row.items():
            c[i][j][k], c[j][i][k] = Fraction(x), -Fraction(x)
    return c


def turning(*starts: int) -> Any:
    """J = 0, 1, 2 turns vectors that start at these places."""
    signs = {(0, 1): (2, 1), (1, 2): (0, 1), (2, 0): (1, 1), (1, 0): (2, -1), (2, 1): (0, -1), (0, 2): (1, -1)}
    table = {(0, 1): {2: 1}, (1, 2): {0: 1}, (2, 0): {1: 1}}
    return table | {(i, s + j): {s + k: x} for s in starts for (i, j), (k, x) in signs.items()}


def boosts(sign: int) -> Any:
    """[K, K] = sign · J, for K at 3, 4, 5."""
    return {(3 + i, 3 + j): {k: sign} for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1))}


def moving(sign: int, energy: int = 1) -> Any:
    """[K_i, P_i] = sign · E, and [K_i, E] = energy · P_i, for P at 6, 7, 8 and E at 9."""
    return {(3 + i, 6 + i): {9: sign} for i in range(3)} | {(3 + i, 9): {6 + i: energy} for i in range(3)}


POINCARE = turning(3, 6) | boosts(-1) | moving(1)
MASS = {(3 + i, 6 + i): {10: 1} for i in range(3)} | {(3 + i, 9): {6 + i: 1} for i in range(3)}
SPINOR = {(i, 6 + j): {6 + k: x} for i, rows in enumerate([  # J and K on (Re a, Re b, Im a, Im b), σ/2i and σ/2
    {0: (3, "-1/2"), 1: (2, "-1/2"), 2: (1, "1/2"), 3: (0, "1/2")}, {0: (1, "1/2"), 1: (0, "-1/2"), 2: (3,
        "1/2"), 3: (2, "-1/2")},
    {0: (2, "-1/2"), 1: (3, "1/2"), 2: (0, "1/2"), 3: (1, "-1/2")}, {0: (1, "1/2"), 1: (0, "1/2"), 2: (3,
        "1/2"), 3: (2, "1/2")},
    {0: (3, "1/2"), 1: (2, "-1/2"), 2: (1, "-1/2"), 3: (0, "1/2")}, {0: (0, "1/2"), 1: (1, "-1/2"), 2: (2,
        "1/2"), 3: (3, "-1/2")},
]) for j, (k, x) in rows.items()}  # fmt: skip


def changed(c: Any) -> Any:
    """The same algebra in another basis: e_i + e_(i + 1)."""
    n = len(c)
    rows = [[Fraction(int(k in (i, i + 1))) for k in range(n)] for i in range(n)]
    solved = alone_names.alone_lie.solved
    new = [[solved(rows, alone_names.bracket(c, x, y)) for y in rows] for x in rows]
    assert all(x is not None for row in new for x in row)
    return new


NAMED: Any = [
    (10, POINCARE, {"poincare"}), (10, turning(3, 6) | boosts(1) | moving(-1), set()),  # e(4)
    (10, turning(3) | boosts(-1), set()), (10, turning(3) | boosts(-1) | SPINOR, set()),
    (11, turning(3, 6) | MASS, {"bargmann"}),
    (10, turning(3, 6) | moving(0), set()), (11, turning(3, 6) | moving(0), set()),
    (11, turning(3, 6) | moving(1, 0), set()),
    (11, turning() | MASS, set()), (11, POINCARE, set()), (10, turning(3, 6) | moving(1, 0), set()),
    (10, turning(3, 6), set()),
    (11, turning(3, 6) | MASS | {(6 + i, 9): {3 + i: -1} for i in range(3)}, set()),  # Newton's and Hooke's
    (11, turning(3, 6) | {(3 + i, 6 + i): {10: 1} for i in range(3)}, set()),
]  # fmt: skip


@pytest.mark.parametrize("given", NAMED)
def test_names(given: Any) -> None:
    n, brackets, names = given
    c = algebra(n, brackets)
    alone_names.alone_lie.check_lie(c)
    for table, name in product((c, changed(c)), ("poincare", "bargmann")):
        assert alone_names.is_called(table, name) == (name in names)


@pytest.mark.parametrize(("rows", "fine"), [
    ({(0, 1): {1: "a"}}, True), ({(0, 1): {1: "e"}}, False), ({(0, 1): {1: "k"}}, False),
    ({(0, 1): {1: "a + 1"}}, False),
    ({(0, 1): {1: "1"}, (0, 2): {2: "a"}}, False), ({(0, 1): {1: "a/m"}, (0, 2): {2: "2*a/m"}}, True),
    ({(0, 1): {2: "a"}, (1, 2): {0: "b"}, (2, 0): {1: "a*b"}}, True),
    ({(0, 1): {1: "a", 2: "1"}, (0, 2): {2: "1"}}, False),
])  # fmt: skip
def test_constants_with_parameters(rows: Any, fine: bool) -> None:
    claim = alone.Claim({**SPACE, "symbols": NAMES, "claim": {"kind": "identity", "lhs": "0", "rhs": "0"}})
    read = lambda i, j, k: claim.read(rows.get((i, j), {}).get(k) or f"-({rows.get((j, i), {}).get(k, 0)})")
    if fine:
        assert alone_names.at_one(read, 3, {"a", "b", "m"})
        return
    with pytest.raises(alone_names.Stop):
        alone_names.at_one(read, 3, {"a", "b", "m"})


def test_constants_that_are_none_have_no_name() -> None:
    with pytest.raises(alone_names.Stop):
        alone_names.is_called(algebra(10, turning(3, 6) | boosts(-1) | moving(1, -1)), "poincare")


def test_it_is_asked_of_a_certificate() -> None:
    text = '[phase_space]\nq = ["x"]\np = ["u"]\n[symbols]\nm = "positive"\n'
    data = certified(text, 'kind = "algebra"\nequals = "aff(1)"\nbasis = { A = "m*x*u", B = "u" }')
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["claim"]["equals"] = "u(1) + u(1)"
    assert alone_together.checked(resealed(data))[0] == "not shown"
