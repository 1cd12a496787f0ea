"""Certificates that were no use: of names that `order` declares, powers of whole numbers, groups, edges of surfaces."""

import json

import pytest

from canon.checker.check import check
from canon.checker.formulas import Formulas
from canon.checker.functions import Unknown, Unreadable
from canon.checker.kinds import obligations
from canon.checker.points import Numbers, points
from canon.checker.statement import Keys, Statement
from canon.checker.whole import is_whole
from canon.claims import document
from canon.claims.certificate_data import certificate, statement_tables
from canon.claims.reader import read_text
from canon.claims.verify import verify
from tests.checker.certified import resealed

MAP = """
[phase_space]
q = ["q"]
p = ["p"]
Q = ["Q"]
P = ["P"]
"""
NEAR = f"""{MAP}
[transformation]
Q = ["q + eps*p"]
P = ["p - eps*q"]
[[claim]]
kind = "canonical"
order = ["eps", 1]
[[claim]]
kind = "canonical"
order = ["eps", 2]
[[claim]]
kind = "canonical"
"""
TURNED = f"""{MAP}
[symbols]
n = "integer"
[transformation]
Q = ["(-1)**n*q"]
P = ["p"]
[[claim]]
kind = "canonical"
[[claim]]
kind = "inequality"
lhs = "q**n"
relation = ">"
rhs = "0"
[[claim]]
kind = "identity"
lhs = "(-1)**(n**2)"
rhs = "(-1)**(n + 1)"
"""
MATRICES = """
[[claim]]
kind = "group"
first = ["a"]
matrix = [["cos(a)", "-sin(a)"], ["sin(a)", "cos(a)"]]
equals = "u(1)"
[[claim]]
kind = "group"
first = ["a", "b"]
matrix = [["1 + a", "b"], ["b", "1 + b"]]
equals = "u(1)^2"
"""


def answers(text: str) -> list[tuple[str, str]]:
    """What canon and what the checker say of each claim of a file."""
    reading, tables = read_text(text), document.parse(text)
    assert reading.problems == []
    found = []
    for k, claim in enumerate(reading.claims):
        verdict = verify(claim, budget=20)
        data = certificate(claim, verdict, statement_tables(tables, k))
        found.append((verdict.status, check(json.loads(json.dumps(data))).status))
    return found


def test_a_small_parameter_that_a_claim_declares_is_the_files() -> None:
    assert answers(NEAR) == [("proved", "confirmed"), ("refuted", "confirmed"), ("refuted", "confirmed")]


def test_a_negative_base_has_powers_with_whole_exponents() -> None:
    assert answers(TURNED) == [("refuted", "confirmed")] * 3


def test_a_group_of_matrices_has_a_certificate_that_is_not_confirmed() -> None:
    assert answers(MATRICES) == [("proved", "not confirmed"), ("refuted", "not confirmed")]


@pytest.mark.parametrize(
    ("text", "whole"),
    [("n", True), ("n**2 + 2*m", True), ("n*(n + 1)/2", False), ("n + 1/2", False), ("n*x", False), ("1/n", False)],
)
def test_which_exponents_are_whole(text: str, whole: bool) -> None:
    f = Formulas(words={"n": ["integer"], "m": ["integer", "positive"], "x": ["real"]})
    assert is_whole(f, f.read(text, {})) is whole


SKEW = """
[[claim]]
kind = "group"
first = ["a", "b", "c"]
second = ["d", "e", "f"]
composition = ["a + d", "b + e*cos(a) + f*sin(a)", "c + f*cos(a) + e*sin(a)"]
equals = "e(2)"
"""
EDGE = """
[phase_space]
q = ["q"]
p = ["p"]
[domain]
where = ["q != 0"]
on = ["q*(q - 1)"]
[[claim]]
kind = "identity"
lhs = "q"
rhs = "1"
"""


def test_a_law_is_refuted_by_its_algebra_though_it_is_none() -> None:
    assert answers(SKEW) == [("refuted", "confirmed")]


def test_no_point_of_a_surface_is_one_that_ends_on_the_edge_of_the_domain() -> None:
    for _ in range(8):  # the checker's points are other ones each time
        assert answers(EDGE) == [("proved", "confirmed in part")]


APART = """
[phase_space]
q = ["q"]
p = ["p"]
[hamiltonian]
H = "(p**2 + q**2)/2"
[[claim]]
kind = "normal_form"
order = 4
N = {}
[[claim]]
kind = "algebra"
basis = {A = "abs(q)", B = "q"}
equals = "u(1)^2"
"""


def test_a_normal_form_may_be_empty_and_two_components_tell_functions_apart() -> None:
    assert answers(APART) == [("proved", "confirmed"), ("proved", "confirmed in part")]


REAL = """
[phase_space]
q = ["q"]
p = ["p"]
[symbols]
n = "real"
[[claim]]
kind = "identity"
lhs = "abs(q)**n"
rhs = "q**n + 1"
"""


def test_an_exponent_that_is_no_whole_number_has_no_power_of_a_negative_base() -> None:
    (claim,) = read_text(REAL).claims
    data = json.loads(json.dumps(certificate(claim, verify(claim), statement_tables(document.parse(REAL), 0))))
    assert check(data).status == "confirmed"
    assert check(resealed({**data, "witness": {**data["witness"], "n": "3", "q": "-2"}})).status == "rejected"


def test_a_key_that_a_rule_needs_is_asked_for() -> None:
    with pytest.raises(Unreadable, match="no key 'second'"):
        Keys({"first": ["a"]})["second"]
    claim = {"kind": "group", "first": ["a"], "matrix": [["exp(a)"]], "equals": "u(1)"}
    with pytest.raises(Unknown, match="by its matrices"):
        obligations(Statement({"phase_space": {"q": [], "p": []}, "claim": claim}, {}, "proved"))


def test_points_have_whole_numbers_of_every_remainder() -> None:
    """What is 0 for odd ones alone isn't seen to be 0, however the points fall."""
    space = {"phase_space": {"q": ["q"], "p": ["p"]}, "symbols": {"m": "integer", "n": "integer"}}
    claim = {"kind": "identity", "lhs": "cos(pi*n)*cos(pi*m)*q", "rhs": "q"}
    statement = Statement({**space, "claim": claim}, {}, "proved")
    (case,) = obligations(statement)
    found = [*points(statement, case, Numbers(), [], {"q", "m", "n"})]
    assert [sorted(abs(int(of[name])) for of in found) for name in "mn"] == [[1, 2, 3, 4, 5]] * 2
