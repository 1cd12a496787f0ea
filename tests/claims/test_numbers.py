"""What sampling says of kinds whose residuals are not plain formulas, and of those that have no numbers."""

import pytest
from flint import arb

from canon.claims.algebra_in_balls import killing_signature
from canon.claims.no_numbers import EXACTLY, NOTHING_EVALUATED, sampled_only
from canon.claims.outcome import Outcome, exact
from canon.verdict import Evidence

NUMERIC = {"method": "numeric"}
SPIN = """kind = "matrix_algebra"
{statement}
[claim.basis]
X = [["0", "{s}"], ["{s}", "0"]]
Y = [["0", "-1j*{s}"], ["1j*{s}", "0"]]
Z = [["{s}", "0"], ["0", "-{s}"]]
"""


def _spin(statement: str, s: str = "1/2") -> str:
    return SPIN.format(statement=statement, s=s)


def test_matrices_have_their_brackets_in_numbers(ask):
    right, other = ask(_spin('equals = "so(3)"'), _spin('equals = "sl(2,R)"'), options=NUMERIC)
    assert (right.status, other.status) == ("supported", "refuted")
    for verdict in (right, other):  # their brackets are the same, and close
        assert verdict.numeric.points == 1
        assert verdict.numeric.max_residual <= verdict.numeric.bound < 1e-14


def test_a_wrong_structure_constant_shows_in_the_numbers(ask):
    table = 'structure = {{ "X,Y" = "{c}", "Y,Z" = "X", "Z,X" = "Y" }}'
    right, near = ask(_spin(table.format(c="Z")), _spin(table.format(c="1001/1000*Z")), options=NUMERIC)
    assert (right.status, near.status) == ("supported", "refuted")
    assert right.numeric.max_residual <= right.numeric.bound
    assert near.numeric.max_residual == pytest.approx(0.0005)
    assert near.numeric.max_residual > 1e9 * near.numeric.bound


def test_matrices_with_parameters_are_sampled(ask):
    (verdict,) = ask(_spin('equals = "so(3)"', s="k/3"), symbols='k = "positive"', options=NUMERIC)
    assert verdict.status == "supported"
    assert verdict.numeric.points > 10
    assert 0 < verdict.numeric.bound < 1e-9
    (verdict,) = ask(_spin('equals = "so(3)"', s="k/3"), symbols='k = "positive"', options={"method": "all"})
    assert verdict.status == "proved"
    assert verdict.numeric.points > 10


SO3 = """kind = "algebra"
equals = "{name}"
[claim.basis]
A = "q**2/2"
B = "p**2/2"
C = "q*p"
"""


def test_a_killing_form_of_another_signature_refutes_without_a_proof_of_the_brackets(ask):
    right, wrong, larger = ask(*(SO3.format(name=name) for name in ("sl(2,R)", "so(3)", "e(2)")), options=NUMERIC)
    assert [v.status for v in (right, wrong, larger)] == ["supported", "refuted", "refuted"]
    assert wrong.method == "balls at several points"
    assert wrong.detail["killing_signature"] == "2 positive, 1 negative, 0 zero"
    assert wrong.numeric.points == 1000


def test_a_limit_of_another_algebra_is_not_told_from_it(ask):
    plane = 'kind = "algebra"\nequals = "{}"\n[claim.basis]\nL = "x*py - y*px"\nX = "px"\nY = "py"\n'
    space = 'q = ["x", "y"]\np = ["px", "py"]\n'
    right, wrong = ask(plane.format("e(2)"), plane.format("so(3)"), space=space, options=NUMERIC)
    assert (right.status, wrong.status) == ("supported", "undecided")
    assert "only sampled" in wrong.detail["note"]


def test_functions_that_leave_the_span_show_by_how_much(ask):
    text = 'kind = "algebra"\nequals = "heisenberg(1)"\n[claim.basis]\nA = "q"\nB = "p**3"\nC = "1"\n'
    (verdict,) = ask(text, options=NUMERIC)
    assert verdict.status == "refuted"
    assert verdict.numeric.max_residual > 1e10 * verdict.numeric.bound


def test_the_signature_of_constants_in_balls():
    def constants(z: float, radius: float) -> dict:
        return {(0, 1): [0, 0, 1], (1, 2): [1, 0, 0], (0, 2): [0, arb(-z, radius), 0]}

    assert killing_signature(3, constants(1, 0)) == (0, 3)
    assert killing_signature(3, constants(-1, 0.1)) == (2, 1)
    assert killing_signature(3, constants(0.1, 0.2)) is None
    assert killing_signature(3, constants(0, 0)) is None


def test_a_determinant_that_is_the_number_0_needs_no_points(ask):
    claim = 'kind = "hamilton_jacobi"\nS = "0*a*q - t*0"\nconstants = ["a"]'
    (verdict,) = ask(claim, hamiltonian='H = "p**2/2"', options=NUMERIC)
    assert verdict.status == "refuted"
    assert verdict.detail["determinant"] == "0"


def test_nothing_is_supported_without_numbers():
    assert sampled_only(Outcome("supported", numeric=Evidence(3, 0.0, 1e-16))).status == "supported"
    proved = sampled_only(exact("proved", "linear algebra"))
    assert (proved.status, proved.detail["numbers"]) == ("undecided", NOTHING_EVALUATED)
    said = sampled_only(exact("proved", "linear algebra", numbers="none: names have no size"))
    assert said.detail["numbers"] == "none: names have no size"
    noted = sampled_only(Outcome("undecided", note="an infinite range has no certified quadrature"))
    assert noted.detail["numbers"] == "none: an infinite range has no certified quadrature"
    refuted = sampled_only(exact("refuted", "linear algebra"))
    assert (refuted.status, refuted.detail["numbers"]) == ("refuted", EXACTLY)
