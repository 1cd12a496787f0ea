"""Lie algebras of functions and of matrices: what is shown, other constants and names, and bases that depend."""

from typing import Any

import pytest

from canon.checker import alone_algebras, alone_lie, alone_together
from tests.checker.certified import certified, resealed

SPACE: Any = {"phase_space": {"q": ["x", "y", "z"], "p": ["u", "v", "w"]}}
NAMES = {"m": "positive", "k": "real", "V": "function"}
SPIN = {"A": "y*w - z*v", "B": "z*u - x*w", "C": "x*v - y*u"}
CYCLE = {"A,B": "C", "B,C": "A", "C,A": "B"}
LINE = {"E": "u**2/2", "F": "x**2/2", "G": "x*u"}
LINES = {"E,F": "-G", "G,E": "2*E", "G,F": "-2*F"}
MOVED = {**CYCLE, "A,v": "w", "A,w": "-v", "B,u": "-w", "B,w": "u", "C,u": "v", "C,v": "-u"}


def answer(basis: Any, structure: Any = None, equals: str | None = None, known: Any = None, **sections: Any) -> str:
    """The answer about a certificate that says of each residual that it is 0."""
    claim = {"kind": "algebra", "basis": basis, **({"structure": structure} if structure is not None else {})}
    claim |= {"equals": equals} if equals else {}
    claim |= {key: sections.pop(key) for key in ("tensor", "coordinates") if key in sections}
    entry, n = {"numerator": {}, "denominator": {"": "1"}, "cofactors": {}}, len(basis)
    data = {"certificate": 1, "tables": {**SPACE, "symbols": NAMES, **sections, "claim": claim}, "verdict": "proved",
            "known": {"structure": known or {}}, "witness": None,
            "cases": [{"kernels": [], "residuals": [entry] * (n * (n - 1) // 2)}]}  # fmt: skip
    return alone_algebras.checked(resealed(data))[0]


SHOWN: Any = [
    (SPIN, CYCLE, "so(3)"), (SPIN, CYCLE), (SPIN, None, "su(2)", CYCLE), (LINE, LINES, "sl(2,R)"),
    (LINE, LINES, "so(2,1)"), ({**SPIN, "u": "u", "v": "v", "w": "w"}, MOVED, "e(3)"),
    ({"A": "x", "B": "u", "C": "1"}, {"A,B": "C"}, "heisenberg(1)"), ({"A": "x*u", "B": "u"}, {"A,B": "B"}, "aff(1)"),
    ({"A": "u", "B": "v"}, {}, "u(1) + u(1)"), ({"A": "x", "B": "m*u", "C": "1"}, {"A,B": "m*C"}),
    ({**SPIN, "D": "x**2 + y**2 + z**2"}, CYCLE, "u(2)"),
    ({"E": "u**2/2 + k/x**2", "F": "x**2/2", "G": "x*u"}, LINES, "sl(2,R)"),
]  # fmt: skip


@pytest.mark.parametrize("given", SHOWN)
def test_an_algebra_is_shown(given: Any) -> None:
    assert answer(*given) == "shown"


MISSES: Any = [
    (SPIN, {**CYCLE, "C,A": "-B"}), (SPIN, CYCLE, "sl(2,R)"), (LINE, LINES, "so(3)"),
    (SPIN, {"A,B": "C", "B,C": "A"}), (SPIN, None, "su(2)", {**CYCLE, "C,A": "2*B"}), (SPIN, {**CYCLE, "B,A": "-C"}),
    (SPIN, {**CYCLE, "A,A": "B"}), ({"A": "u", "B": "v", "C": "u + v"}, {}), ({"A": "u", "B": "2*u"}, {}),
    ({"A": "k*u", "B": "v"}, {}), ({"A": "u", "B": "0*u"}, {}), ({"A": "V(u)", "B": "v"}, {}),
    ({"A": "x", "B": "t*x"}, {}), ({"A": "1", "B": "t"}, {}), ({"A": "sqrt(u**2)", "B": "u"}, {}),
    ({"A": "x", "B": "u", "C": "k"}, {"A,B": "C/k"}), ({"A": "x**2/2", "B": "u"}, {"A,B": "x*B"}),
    ({"A": "x**2/2", "B": "u"}, {"A,B": "2*A/x"}), ({"A": "x*u", "B": "u"}, {"A,B": "B**2/u"}),
    ({"A": "x*u", "B": "u"}, {"A,B": "sqrt(B**2)"}), ({"A": "x*u", "B": "u"}, {"A,B": "B + 0*D"}),
    ({"A": "x*u", "B": "u"}, {"A,B": "B"}, "u(1) + u(1)"), ({"A": "sin(x)**2", "B": "cos(2*x)", "C": "1"}, {}),
    ({"A": "u", "B": "u*exp(1/(2*x + 2*y) - 1/(2*(x + y)))"}, {}),
    ({**SPIN, "u": "u", "v": "v", "w": "w"}, MOVED, "so(4)"), (SPIN, CYCLE, "so(3) + u(1)"), (SPIN, CYCLE, "e(2)"),
    ({"A": "x", "B": "u", "C": "1"}, {"A,B": "C"}, "heisenberg(2)"), ({"A": "x", "B": "u", "C": "1"}, {}, "u(1)"),
]  # fmt: skip


@pytest.mark.parametrize("given", MISSES)
def test_other_constants_names_or_a_basis_that_depends_show_nothing(given: Any) -> None:
    assert answer(*given) == "not shown"


def test_a_bracket_of_the_claims_own() -> None:
    tensor = [["0", "z", "-y"], ["-z", "0", "x"], ["y", "-x", "0"]]
    basis, own = {"A": "x", "B": "y", "C": "z"}, {"coordinates": ["x", "y", "z"]}
    assert answer(basis, CYCLE, "so(3)", tensor=tensor, **own) == "shown"
    assert answer(basis, CYCLE, "so(3)", tensor=[["0", "z", "y"], *tensor[1:]], **own) == "not shown"
    assert (
        answer(basis, CYCLE, "so(3)", tensor=[["0", "z", "-y"], ["z", "0", "x"], ["y", "-x", "0"]], **own)
        == "not shown"
    )


SIGMA = {"A": [["0", "1"], ["1", "0"]], "B": [["0", "-1j"], ["1j", "0"]], "C": [["1", "0"], ["0", "-1"]]}
REAL = {"A": [[0, 1], [0, 0]], "B": [[0, 0], [1, 0]], "C": [["1/2", "0"], ["0", "-1/2"]]}
HALF = {name: [[f"({x})/2" for x in row] for row in matrix] for name, matrix in SIGMA.items()}


def of_matrices(basis: Any, **claim: Any) -> str:
    tables = {"claim": {"kind": "matrix_algebra", "basis": basis, **claim}}
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": [{}]}
    return alone_lie.checked(resealed(data))[0]


def test_algebras_of_matrices() -> None:
    assert of_matrices(HALF, structure=CYCLE, equals="su(2)") == "shown"
    assert of_matrices(SIGMA, structure={"A,B": "2*C", "B,C": "2*A", "C,A": "2*B"}) == "shown"
    assert of_matrices(REAL, structure={"A,B": "2*C", "C,A": "A", "C,B": "-B"}, equals="sl(2,R)") == "shown"
    for claim in ({"structure": {**CYCLE, "C,A": "-B"}}, {"equals": "sl(2,R)"}, {"equals": "e(3)"}, {}, {"order": 1}):
        assert of_matrices(HALF, **claim) == "not shown"
    assert of_matrices({**HALF, "D": [["0", "1"], ["1", "0"]]}, equals="u(2)") == "not shown"  # dependent
    assert of_matrices({"A": HALF["A"], "B": HALF["B"]}, structure={}) == "not shown"  # not closed
    assert of_matrices({"A": [["1", "0", "0"], ["0", "1"]]}, structure={}) == "not shown"
    assert of_matrices({"A": [["k", "0"], ["0", "1"]]}, structure={}) == "not shown"
    assert of_matrices({"A": [["0", "0"], ["0", "0"]]}, structure={}) == "not shown"


def constants(table: Any, names: str) -> Any:
    return alone_lie.constants_of([*names], table, lambda text: alone_lie.combination(text, [*names]))


def test_real_forms_and_contractions_are_told_apart() -> None:
    rotation = {
        "A,B": "C",
        "B,C": "A",
        "C,A": "B",
        "A,E": "F",
        "B,D": "-F",
        "B,F": "D",
        "C,E": "-D",
        "C,D": "E",
        "A,F": "-E",
    }
    for sign, name in (("", "so(4)"), ("-", "so(3,1)"), ("0*", "e(3)")):
        boosts = {"D,E": f"{sign}C", "E,F": f"{sign}A", "F,D": f"{sign}B"}
        found = [n for n in ("so(4)", "so(3,1)", "e(3)", "so(2,2)", "so(3) + so(3)") if
                 alone_lie.is_called(constants(rotation | boosts, "ABCDEF"), n)]  # fmt: skip
        assert found == ([name, "so(3) + so(3)"] if name == "so(4)" else [name])
    solvable = constants({"A,B": "B", "A,C": "C"}, "ABC")  # neither nilpotent nor simple
    assert not any(alone_lie.is_called(solvable, n) for n in ("so(3)", "sl(2)", "heisenberg(1)", "u(1) + u(1) + u(1)"))
    with pytest.raises(alone_lie.Stop):
        alone_lie.is_called(constants({"A,B": "C", "B,C": "B"}, "ABC"), "so(3)")  # no Jacobi identity
    with pytest.raises(alone_lie.Stop):
        alone_lie.is_called(constants(CYCLE, "ABC"), "g(2)")


def test_certificates_carry_the_constants() -> None:
    text = '[phase_space]\nq = ["x"]\np = ["u"]\n'
    data = certified(text, "kind = 'algebra'\nequals = 'sl(2,R)'\n[claim.basis]\nE = 'u**2/2'\nF = 'x**2/2'\nG = 'x*u'")
    assert alone_together.checked(data) == ("shown", "")
    data["known"]["structure"]["E,F"] = "G"
    assert alone_together.checked(resealed(data))[0] == "not shown"
    text = "kind = 'matrix_algebra'\nequals = 'su(2)'\n[claim.basis]\n"
    data = certified("", text + "\n".join(f"{name} = {matrix}" for name, matrix in HALF.items()))
    assert alone_together.checked(data) == ("shown", "")
