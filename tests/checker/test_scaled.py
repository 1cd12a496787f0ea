"""Structure constants with parameters, and bases that are independent whatever the parameters are."""

from fractions import Fraction
from typing import Any

import pytest

from canon.checker.algebras import stated
from canon.checker.homogeneous import are_independent_by_scaling
from canon.checker.kinds import obligations
from canon.checker.lie import galilei, is_named
from canon.checker.power_wells import Form, well_action
from canon.checker.scaled import scaled
from canon.checker.statement import Statement

SPACE = {"q": ["x", "y", "z"], "p": ["px", "py", "pz"]}
SYMBOLS = {**dict.fromkeys("amk", "positive"), "n": "negative", "c": "real", "i": ["integer", "positive"]}
ROTATIONS = {"J1,J2": "J3", "J1,J3": "-J2", "J2,J3": "J1", "J1,A2": "A3", "J1,A3": "-A2", "J2,A1": "-A3",
             "J2,A3": "A1", "J3,A1": "A2", "J3,A2": "-A1"}  # fmt: skip
KEPLER = {
    "r": "sqrt(x**2 + y**2 + z**2)", "E": "(px**2 + py**2 + pz**2)/(2*m) - a/r",
    "J1": "y*pz - z*py", "J2": "z*px - x*pz", "J3": "x*py - y*px",
    "A1": "py*J3 - pz*J2 - m*a*x/r", "A2": "pz*J1 - px*J3 - m*a*y/r", "A3": "px*J2 - py*J1 - m*a*z/r",
}  # fmt: skip
VECTORS = ["J1", "J2", "J3", "A1", "A2", "A3"]


def about(claim: dict[str, Any], verdict: str = "proved", **tables: Any) -> Statement:
    return Statement({"phase_space": SPACE, "symbols": SYMBOLS, "claim": claim, **tables}, {}, verdict)


def constants(factor: str, where: list[str] | None = None) -> Any:
    """[A_i, A_j] = factor · J_k, made numbers."""
    table = {**ROTATIONS, "A1,A2": f"({factor})*J3", "A1,A3": f"-({factor})*J2", "A2,A3": f"({factor})*J1"}
    claim = {"kind": "algebra", "basis": dict.fromkeys(VECTORS, "x"), "structure": table}
    s = about(claim, domain={"where": where or []})
    return scaled(s, stated(s, VECTORS) or {}, 6)


@pytest.mark.parametrize(
    ("factor", "where", "name"),
    [
        ("k/m", [], "so(4)"), ("-2*m*k", [], "so(3,1)"), ("2*m*n", [], "so(3,1)"), ("-n**3/k", [], "so(4)"),
        ("-m*c", ["c < 0"], "so(4)"), ("-m*c", ["c > 0"], "so(3,1)"), ("k - c", ["c < k"], "so(4)"),
        ("m*c", [], ""), ("k - m", [], ""), ("c**2", [], ""),
    ],
)  # fmt: skip
def test_an_algebra_with_parameters(factor: str, where: list[str], name: str) -> None:
    algebra = constants(factor, where)
    assert (algebra is None) == (name == "")
    if algebra is not None:
        assert [word for word in ("so(4)", "so(3,1)", "e(3)") if is_named(algebra, word)] == [name]


def test_constants_that_no_scaling_makes_numbers() -> None:
    claim = {"kind": "algebra", "basis": {"h": "x", "u": "y", "v": "z"}}
    for other, seen in (("3*k*v", True), ("k**2*v", False), ("m*v", False)):
        s = about({**claim, "structure": {"h,u": "k*u", "h,v": other}})
        assert (scaled(s, stated(s, ["h", "u", "v"]) or {}, 3) is not None) == seen


def test_an_algebra_is_the_one_with_its_table() -> None:
    mine, other = galilei(mass=True), galilei(mass=True)
    assert is_named(mine, "bargmann")
    other.table[3, 6] = [2 * x for x in other.table[3, 6]]
    other.table[6, 3] = [-x for x in other.table[3, 6]]
    assert not is_named(other, "bargmann")
    assert is_named(galilei(mass=False), "bargmann") is False


@pytest.mark.parametrize(
    ("functions", "domain", "independent"),
    [
        (VECTORS, {"on": ["E"]}, True), (VECTORS, {"on": ["E - c"]}, True), (VECTORS, {"where": ["E < 0"]}, True),
        (["E", "m", "J3"], {"where": ["E > 0"]}, True), (["E", "m", "J3"], {"on": ["E - c"]}, False),
        (["J1", "J2", "J1 + 2*J2"], {"where": ["E > 0"]}, False), ([*VECTORS, "A1*J1 + A2*J2 + A3*J3"], {}, False),
        (["x", "c*px"], {}, False), (["x", "k*px"], {}, True), (["x", "px", "x + c*px"], {}, False),
        (["x", "(k - 1)*px"], {}, False), (["x", "i*px"], {}, False), (["x", "(k - m)*px"], {}, False),
        (["x", "y*abs(c)"], {}, False), (["x", "exp(k*px)"], {}, True), (["x", "px*sin(c)"], {}, False),
    ],
)  # fmt: skip
def test_independence_by_units(functions: list[str], domain: dict[str, Any], independent: bool) -> None:
    s = about({"kind": "identity", "lhs": "0", "rhs": "0"}, definitions=KEPLER, domain=domain)
    nodes = [s.f.read(text, s.names) for text in functions]
    assert are_independent_by_scaling(s, nodes, sorted(s.coordinates)) == independent


def test_a_composition_that_is_none_is_seen_without_a_point() -> None:
    first, second = ["a1", "a2"], ["b1", "b2"]
    for theta, wrong in (
        (["a1 + b1", "a2 + b2 + a1*b1"], None), (["a1 + b1", "a2 + b2 + a1*b1**2/1000"], False),
        (["a1 + b1", "a2 + b2 + sin(a1)*b1**2"], None),
    ):  # fmt: skip
        claim = {"kind": "group", "first": first, "second": second, "composition": theta}
        (case,) = obligations(about(claim, "refuted"))
        assert case.found is wrong


def test_the_action_in_a_well_is_a_formula() -> None:
    for V, seen in (("k*abs(x)**m", True), ("c*abs(x)**m", False), ("k*abs(x)**m + x", False)):
        s = about({"kind": "identity", "lhs": "0", "rhs": "0"})
        H = s.f.read(f"px**2/2 + {V}", {})
        assert (well_action(s, Form.of(s, H, "x", "px"), s.f.number(Fraction(2))) is not None) == seen
