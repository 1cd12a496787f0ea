"""The checker's own Lie algebras: identified by exact invariants, told apart, and what was changed is rejected."""

import copy
from fractions import Fraction
from typing import Any

import pytest

from canon.checker.algebras import group
from canon.checker.check import check
from canon.checker.functions import Unreadable
from canon.checker.lie import Algebra, is_named, named, total
from canon.checker.linear import kernel, rank, signature, solved
from canon.checker.statement import Statement
from tests.checker.certified import certified, resealed

PLANE = '[phase_space]\nq = ["x", "y"]\np = ["px", "py"]\n'
SPACE = '[phase_space]\nq = ["x", "y", "z"]\np = ["px", "py", "pz"]\n'
TURNS = 'basis = { X = "y*pz - z*py", Y = "z*px - x*pz", Z = "x*py - y*px" }'
PAULI = """basis = { a = [["0", "1/2"], ["1/2", "0"]], b = [["0", "-1j/2"], ["1j/2", "0"]],
                             c = [["1/2", "0"], ["0", "-1/2"]] }""".replace("\n", " ")
SUM = 'first = ["a1", "a2"]\nsecond = ["b1", "b2"]\ncomposition = ["a1 + b1", "a2 + exp(a1)*b2"]\n'
BOOST = 'matrix = [["cosh(a1)", "sinh(a1)"], ["sinh(a1)", "cosh(a1)"]]\n'
ADDED = 'first = ["a1"]\nsecond = ["b1"]\ncomposition = ["a1 + b1"]\ninverse = ["-a1"]'
DOUBLE = 'structure = { "a,b" = "2*c", "b,c" = "a", "c,a" = "b" }'
SYMBOLS = '[symbols]\na1 = "real"\na2 = "real"\nb1 = "real"\nb2 = "real"\nm = "positive"\nu = "function"\n'
CLAIMS = {
    "so(3)": (SPACE, f'kind = "algebra"\n{TURNS}\nequals = "so(3)"'),
    "stated": (SPACE, f'kind = "algebra"\n{TURNS}\nstructure = {{ "X,Y" = "Z", "Y,Z" = "X", "Z,X" = "Y" }}'),
    "e(3)": (SPACE, f'kind = "algebra"\n{TURNS[:-2]}, A = "px", B = "py", C = "pz" }}\nequals = "e(3)"'),
    "not sl(2)": (SPACE, f'kind = "algebra"\n{TURNS}\nequals = "sl(2,R)"'),
    "not closed": (PLANE, 'kind = "algebra"\nbasis = { A = "x*px", B = "x**3" , C = "px**2" }\nequals = "so(3)"'),
    "pauli": (PLANE, f'kind = "matrix_algebra"\n{PAULI}\nequals = "su(2)"'),
    "not pauli": (PLANE, f'kind = "matrix_algebra"\n{PAULI}\n{DOUBLE}'),
    "affine": (PLANE + SYMBOLS, f'kind = "group"\n{SUM}structure = {{ "a1,a2" = "-a2" }}\nequals = "aff(1)"'),
    "not affine": (PLANE + SYMBOLS, f'kind = "group"\n{SUM}structure = {{ "a1,a2" = "a2" }}'),
    "boost": (PLANE + SYMBOLS, f'kind = "invariant_interval"\n{BOOST}metric = [["1", "0"], ["0", "-1"]]'),
    "rapidities": (PLANE + SYMBOLS, f'kind = "matrix_group"\n{BOOST}{ADDED}'),
    "string": (
        PLANE + SYMBOLS,
        'kind = "field_equations"\nL = "D(u(x, y), y)**2/2 - m*D(u(x, y), x)**2/2 - u(x, y)**4"\nfields = ["u(x, y)"]\n'
        'equations = ["-D(u(x, y), y, 2) + m*D(u(x, y), x, 2) - 4*u(x, y)**3"]',
    ),
    "squares": (PLANE, 'kind = "inequality"\nlhs = "x**2 + y**4 + 1"\nrelation = ">"\nrhs = "0"'),
    "not squares": (PLANE, 'kind = "inequality"\nlhs = "x**2 + y**3 + 1"\nrelation = ">"\nrhs = "0"'),
    "number": (PLANE, 'kind = "inequality"\nlhs = "exp(1)"\nrelation = "<"\nrhs = "2719/1000"'),
}  # fmt: skip
REFUTED = {"not sl(2)", "not closed", "not pauli", "not affine", "not squares"}


def made(name: str) -> Any:
    return certified(*CLAIMS[name])


@pytest.mark.parametrize("name", sorted(CLAIMS))
def test_each_kind_is_confirmed(name: str) -> None:
    data = made(name)
    assert data["verdict"] == ("refuted" if name in REFUTED else "proved")
    assert str(check(data)) == "confirmed"


def leaves(data: Any, path: tuple[Any, ...] = ()) -> Any:
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, item in items:
        yield from leaves(item, (*path, key))
    if path and not isinstance(data, dict | list):
        yield path, data


def changed(data: Any, path: tuple[Any, ...]) -> Any:
    """A number one digit longer, a formula doubled and one more; the relation of an inequality turned round."""
    data = copy.deepcopy(data)
    holder = data
    for key in path[:-1]:
        holder = holder[key]
    item = holder[path[-1]]
    if path[-1] == "relation" and item in ("<", ">"):
        holder[path[-1]] = {"<": ">", ">": "<"}[item]
    elif isinstance(item, str) and item.lstrip("-").replace("/", "").isdigit():
        holder[path[-1]] = f"{item}1"
    else:
        holder[path[-1]] = f"2*({item}) + 1"
    return data


OWN = ("basis", "structure", "composition", "matrix", "metric", "L", "equations", "lhs", "rhs", "relation", "inverse")
HARMLESS = {("squares", "lhs"), ("number", "rhs"), ("boost", "metric")}
"""Larger still; the metric times 2 is kept too, and of a diagonal one the changed entries are off the diagonal."""


@pytest.mark.parametrize("name", sorted(set(CLAIMS) - REFUTED))
def test_a_changed_claim_or_proof_is_not_confirmed(name: str) -> None:
    """Each formula of the claim, each structure constant, and each thing that the certificate shows."""
    data, count = made(name), 0
    for path, _ in leaves(data):
        if path[-1] in ("sign", "name", "kind"):
            continue
        ours = path[:2] == ("tables", "claim") and path[2] in OWN and (name, path[2]) not in HARMLESS
        if ours or path[0] == "cases" or path[:2] == ("known", "structure"):
            try:
                status = check(resealed(changed(data, path))).status
            except Unreadable:
                status = "unreadable"
            assert status in ("rejected", "unreadable", "not confirmed"), (path, status)
            count += 1
    assert count >= 2 or name in ("number", "squares")


@pytest.mark.parametrize(("claim", "proof"), [("not sl(2)", "so(3)"), ("not pauli", "pauli"), ("not affine", "affine")])
def test_the_refutation_of_something_true_is_rejected(claim: str, proof: str) -> None:
    wrong = {**made(claim), "tables": made(proof)["tables"]}
    assert check(resealed(wrong)).status in ("rejected", "not confirmed")


def test_a_basis_may_depend_on_itself_for_one_value_of_a_parameter() -> None:
    """x/(a + x − 1) times a is 0 for a = 0, which a nonnegative a may be: what is seen at some values isn't shown."""
    symbols = PLANE + '[symbols]\na = "positive"\n[domain]\nwhere = ["x > 2"]\n'
    data = certified(symbols, 'kind = "algebra"\nbasis = { A = "a/(a + x - 1)", B = "1" }\nstructure = {}')
    data["tables"]["symbols"]["a"] = "nonnegative"
    answer = check(resealed(data))
    assert answer.status == "confirmed in part"
    assert "independent for all values of the parameters" in str(answer)


def test_another_name_is_rejected() -> None:
    for name, other in (("so(3)", "so(2,1)"), ("e(3)", "so(4)"), ("pauli", "so(2,1)"), ("affine", "u(1) + u(1)")):
        data = copy.deepcopy(made(name))
        data["tables"]["claim"]["equals"] = other
        assert str(check(resealed(data))) == "rejected: by exact arithmetic the claim fails"


NAMES = (
    "so(3)", "so(2,1)", "so(4)", "so(3,1)", "so(2,2)", "so(3,2)", "so(4,1)", "iso(3)", "iso(3,1)", "u(1)",
    "heisenberg(1)", "heisenberg(2)", "aff(1)", "so(3) + so(2,1)", "so(3) + u(1)", "u(1) + u(1)",
)  # fmt: skip


def test_names_are_told_apart() -> None:
    """Each algebra by name is itself, and none of the others, whatever basis it is given in."""
    found = {name: named(name) for name in NAMES}
    sizes = {name: algebra.size for name, algebra in found.items() if isinstance(algebra, Algebra)}
    for name, algebra in found.items():
        assert isinstance(algebra, Algebra)
        turned = moved(algebra)
        for other in (other for other in NAMES if sizes[other] == sizes[name]):
            assert is_named(turned, other) is (name == other), (name, other)
    assert is_named(total([named("so(3)")] * 2), "so(4)") is True  # pyright: ignore[reportArgumentType]
    assert is_named(named("galilei"), "bargmann") is False  # pyright: ignore[reportArgumentType]
    assert is_named(named("bargmann"), "galilei + u(1)") is False  # pyright: ignore[reportArgumentType]
    assert is_named(named("iso(2)"), "iso(2)") is True  # pyright: ignore[reportArgumentType]
    assert is_named(moved(named("iso(2)")), "iso(2)") is None  # pyright: ignore[reportArgumentType]


def moved(algebra: Algebra) -> Algebra:
    """The algebra in the basis e_1, e_1 + e_2, e_2 + e_3, …"""
    n = algebra.size
    basis = [[Fraction(int(c in (a - 1, a))) for c in range(n)] for a in range(n)]
    pairs = [(a, b) for a in range(n) for b in range(a + 1, n)]
    rows = {(a, b): solved(basis, algebra.bracket(basis[a], basis[b])) or [] for a, b in pairs}
    return Algebra(n, {pair: dict(enumerate(row)) for pair, row in rows.items()})


def test_what_is_no_lie_algebra_has_no_name() -> None:
    one = Fraction(1)
    assert is_named(Algebra(3, {(0, 1): {2: one}, (1, 2): {1: one}}), "so(3)") is False


def test_linear_algebra_is_exact() -> None:
    rows = [[Fraction(x) for x in row] for row in ((1, 2, 3), (2, 4, 6), (0, 1, 1))]
    assert rank(rows) == 2
    assert kernel(rows) == [[-1, -1, 1]]
    assert solved(rows[:1], rows[1]) == [2]
    assert solved(rows[:1], rows[2]) is None
    assert signature([[Fraction(0), Fraction(1)], [Fraction(1), Fraction(0)]]) == (1, 1, 0)
    assert signature(rows[:1] and [[Fraction(-3)]]) == (0, 1, 0)


def test_the_third_element_of_a_group_is_no_name_of_the_file() -> None:
    claim = {"kind": "group", "first": ["a"], "second": ["b"], "composition": ["a + b + b_third*a*b"], "equals": "u(1)"}
    tables = {"phase_space": {"q": ["q"], "p": ["p"]}, "symbols": {"b_third": "real"}, "claim": claim}
    statement = Statement(tables, {}, "proved")
    (associativity,) = group(statement).zeros[2:]
    names = {statement.f.ops[a][1] for a in statement.f.reach(associativity) if statement.f.ops[a][0] == "s"}
    assert names == {"a", "b", "b_third", "b_third_"}
