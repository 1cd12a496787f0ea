"""Forgeries for the checker in one file, and for that of refutations: certificates that say of each residual that it is
0, or that it isn't at a point."""

from typing import Any

import pytest

from canon.checker import alone, counterexample
from tests.checker.certified import resealed


def forged(tables: Any, count: int = 1, **case: Any) -> tuple[str, str]:
    """The answer about a certificate that says of each residual that it is 0."""
    entry = {"numerator": {}, "denominator": {"": "1"}, "cofactors": {}}
    cases = [{"kernels": [], "residuals": [entry] * count, **case}]
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": cases}
    return alone.checked(resealed(data))


SPACE: Any = {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]}}


TURNED = {"transformation": {"Q": ["p"], "P": ["q"]}}
LARGE = (29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71)


FORGED = {
    "a kernel by the name of the claim's own formula": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "q", "rhs": "0"}},
        {"kernels": [{"name": "_lhs", "stands for": "0"}]},
    ),
    "a kernel by the name of a coordinate": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "q", "rhs": "0"}},
        {"kernels": [{"name": "q", "stands for": "0"}]},
    ),
    "a name of this program's own": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "_rhs", "rhs": "_lhs + 1 - 1"}}, {},
    ),
    "a formula that isn't there": ({**SPACE, "claim": {"kind": "conserved", "f": "q"}}, {}),
    "a function with a name of the language": (
        {**SPACE, "symbols": {"sin": "function"}, "claim": {"kind": "identity", "lhs": "sin(q)", "rhs": "sin(q)"}}, {},
    ),
    "a definition of a coordinate": (
        {**SPACE, "definitions": {"q": "0"}, "claim": {"kind": "identity", "lhs": "q", "rhs": "0"}}, {},
    ),
    "a bracket in the old variables of new ones": (
        {**SPACE, **TURNED, "claim": {"kind": "bracket", "f": "Q", "g": "p", "equals": "0"}}, {},
    ),
    "a letter that looks like another": (
        {**SPACE, **TURNED, "claim": {"kind": "bracket", "f": "\uff31", "g": "q", "equals": "0"}}, {},
    ),
    "a key that nobody asks for": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "q", "rhs": "q", "order": "1"}}, {},
    ),
    "a function that nobody declares": ({**SPACE, "claim": {"kind": "identity", "lhs": "f(q)", "rhs": "f(q)"}}, {}),
    "a function without its arguments": (
        {**SPACE, "symbols": {"f": "function"}, "claim": {"kind": "identity", "lhs": "f*q", "rhs": "q*f"}}, {},
    ),
    "an order below 0": ({**SPACE, "claim": {"kind": "identity", "lhs": "D(q, q, -1)", "rhs": "q"}}, {}),
    "an order that is too high": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "D(exp(q), q, 999999999)", "rhs": "exp(q)"}}, {},
    ),
    "a surface": ({**SPACE, "domain": {"on": ["q - 1"]}, "claim": {"kind": "identity", "lhs": "q", "rhs": "q"}}, {}),
    "a scale that may be 0": (
        {**SPACE, "symbols": {"c": "real"}, "transformation": {"Q": ["q"], "P": ["c*p"]}, "hamiltonian": {"H": "0"},
         "claim": {"kind": "new_hamiltonian", "K": "0"}}, {"residuals": []},
    ),
    "integers in an exponent": (
        {**SPACE, "symbols": {"n": "integer"}, "claim": {"kind": "identity", "lhs": "sqrt(q**(2*n))", "rhs": "q**n"}},
        {},
    ),
    "the image of a map that is singular everywhere": (
        {**SPACE, "hamiltonian": {"H": "(p**2 + q**2)/2"}, "transformation": {"q": ["Q"], "p": ["Q"]},
         "claim": {"kind": "conserved", "f": "q*p"}}, {},
    ),
    "a map backward that is singular everywhere": (
        {**SPACE, "transformation": {"q": ["Q"], "p": ["Q"]}, "claim": {"kind": "identity", "lhs": "q", "rhs": "p"}},
        {},
    ),
    "what holds on its image, of new variables": (
        {**SPACE, "transformation": {"q": ["Q"], "p": ["Q"]},
         "claim": {"kind": "identity", "lhs": "q - p + Q", "rhs": "Q"}}, {},
    ),
    "a generating function whose Hessian is singular": (
        {**SPACE, "generating_function": {"type": 2, "F": "q"}, "claim": {"kind": "canonical"}},
        {"residuals": [None] * 2},
    ),
    "what it generates there": (
        {**SPACE, "transformation": {"q": ["0*Q"], "p": ["0*P"]},
         "claim": {"kind": "generating_function", "type": 1, "F": "q*sin(p*Q)*0 + q*0"}}, {"residuals": [None] * 2},
    ),
    "two maps backward that are singular everywhere": (
        {"phase_space": {"q": ["q", "x"], "p": ["p", "y"], "Q": ["Q", "X"], "P": ["P", "Y"]},
         "transformation": {"q": ["0*Q", "0*X"], "p": ["0*P", "0*Y"]},
         "claim": {"kind": "generating_function", "type": 1, "F": "q*x*Q"}}, {"residuals": [None] * 4},
    ),
    "a power's slope by its exponent": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "D(2**q, q)", "rhs": "0"}}, {},
    ),
    "a sine with more than its argument": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "sin(q, x=p)", "rhs": "sin(q)"}}, {},
    ),
    "a sine's slope for a sine": ({**SPACE, "claim": {"kind": "identity", "lhs": "sin[1](q)", "rhs": "sin(q)"}}, {}),
    "a kernel whose root throws points away": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "sqrt(q**2)", "rhs": "q"}},
        {"kernels": [{"name": "k", "stands for": "sqrt(q)", "relation": {"k^2": "1", "q": "-1"}}]},
    ),
    "roots of numbers, 0 modulo most primes": (
        {**SPACE, "claim": {"kind": "identity", "rhs": "0", "lhs": "*".join(
            f"(sqrt((sqrt({n}) - 1)**2) + sqrt({n}) - 1)" for n in (2, 3, 5, 7, 11))}}, {},
    ),
    "roots of the squares of large primes": (
        {**SPACE, "claim": {"kind": "identity", "rhs": "0", "lhs": "*".join(f"(sqrt({n * n}) + {n})" for n in LARGE)}},
        {},
    ),
    "a program's own name in a line of its own": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "\n_rhs", "rhs": "q"}}, {},
    ),
    "a new variable in a line of its own": (
        {**SPACE, **TURNED, "claim": {"kind": "bracket", "f": "\nQ", "g": "q", "equals": "0"}}, {},
    ),
    "a new variable behind a separator": (
        {**SPACE, **TURNED, "claim": {"kind": "bracket", "f": "\x1fQ", "g": "q", "equals": "0"}}, {},
    ),
    "a new variable with a dot": (
        {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["Q\u0307"], "P": ["P"]}, **TURNED,
         "claim": {"kind": "bracket", "f": "Q\u0307", "g": "q", "equals": "0"}}, {},
    ),
    "a sign that Python takes for a letter": (
        {**SPACE, "symbols": {"\u2118rhs": "real"}, "claim": {"kind": "identity", "lhs": "\u2118rhs", "rhs": "q"}}, {},
    ),
    "a remark": ({**SPACE, "claim": {"kind": "identity", "lhs": "q # + 1", "rhs": "q"}}, {}),
    "an order below 0, of nothing": ({**SPACE, "claim": {"kind": "identity", "lhs": "D(q, q, -1)", "rhs": "0"}}, {}),
    "half a derivative": ({**SPACE, "claim": {"kind": "identity", "lhs": "D(q, q, 1/2)", "rhs": "q"}}, {}),
    "a Hamiltonian of the claim's own": (
        {**SPACE, "hamiltonian": {"H": "p**2/2"}, "claim": {"kind": "conserved", "f": "q", "H": "0"}}, {},
    ),
    "a scale beside the Hamiltonian": (
        {**SPACE, "hamiltonian": {"H": "0", "scale": "2"}, "transformation": {"Q": ["2*q"], "P": ["p"]},
         "claim": {"kind": "canonical"}}, {},
    ),
    "a map forward and a value backward": (
        {**SPACE, "transformation": {"Q": ["q + q**2"], "P": ["p"], "q": ["0"]}, "claim": {"kind": "canonical"}}, {},
    ),
    "a type beside another file's": (
        {**SPACE, "transformation": {"Q": ["q"], "P": ["p"]}, "generating_function": {"type": 2, "F": "q*P"},
         "claim": {"kind": "generates", "type": 1}}, {"residuals": [None] * 2},
    ),
    "a generating function of the other variables": (
        {**SPACE, "transformation": {"Q": ["q"], "P": ["0*p"]},
         "claim": {"kind": "generating_function", "type": 2, "F": "q*p + q*P"}}, {"residuals": [None] * 2},
    ),
    "a function without a name": (
        {**SPACE, "symbols": {"": "function"}, "claim": {"kind": "identity", "lhs": "q.f(q)", "rhs": "p.g(q)"}}, {},
    ),
    "a section that isn't known": (
        {**SPACE, "constraints": {"on": ["q"]}, "claim": {"kind": "bracket", "f": "q", "g": "p", "equals": "1"}}, {},
    ),
    "nothing": ({**SPACE, "claim": {"kind": "involution", "functions": ["q"]}}, {"residuals": []}),
    "a sum of roots": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "sqrt((q - p)**2)", "rhs": "q - p"}}, {},
    ),
    "a root of another branch": (
        {**SPACE, "symbols": {"q": "positive"}, "claim": {"kind": "identity", "lhs": "sqrt((q-1)**2)", "rhs": "q-1"}},
        {},
    ),
    "an arc": ({**SPACE, "claim": {"kind": "identity", "lhs": "asin(sin(q))", "rhs": "q"}}, {}),
    "logarithms of what has a sign": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "log(q**2)", "rhs": "2*log(q)"}}, {},
    ),
    "a bracket of old variables beside a map that gives them": (
        {**SPACE, "hamiltonian": {"H": "bracket(q, p)*p**2/2"}, "transformation": {"q": ["2*Q"], "p": ["P"]},
         "claim": {"kind": "new_hamiltonian", "K": "P**2/2"}}, {"residuals": [None] * 6},
    ),
    "a condition with one": (
        {**SPACE, "domain": {"where": ["bracket(q, p) > 1"]}, "transformation": {"q": ["2*Q"], "p": ["P"]},
         "claim": {"kind": "canonical", "scale": "1/2"}}, {},
    ),
    "half of the equations": (
        {"phase_space": {"q": ["q", "x"], "p": ["p", "y"], "Q": ["Q", "X"], "P": ["P", "Y"]},
         "transformation": {"Q": ["q", "x"], "P": ["p", "7*y"]},
         "claim": {"kind": "generating_function", "type": [2], "F": "q*P"}}, {"residuals": [None] * 2},
    ),
    "another file's generating function": (
        {**SPACE, "generating_function": {"type": 2, "F": "q*P"}, "transformation": {"Q": ["q"], "P": ["p"]},
         "claim": {"kind": "generating_function", "type": 3, "F": "-p*Q + p*sin(t)"}}, {"residuals": [None] * 2},
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", FORGED)
def test_nothing_is_shown_by_a_forgery(name: str) -> None:
    tables, case = FORGED[name]
    count = len(case.pop("residuals", [None])) if "residuals" in case else 1
    assert all(forged(tables, n, **case)[0] != "shown" for n in {count, 1, 2, 3, 4, 6})


def test_of_old_variables_alone_a_map_says_nothing() -> None:
    tables = {**SPACE, "hamiltonian": {"H": "p**2 + q**2"}, "transformation": {"q": ["Q"], "p": ["Q"]}}
    assert forged({**tables, "claim": {"kind": "conserved", "f": "H"}})[0] == "not shown"
    assert forged({**tables, "claim": {"kind": "conserved", "f": "(p**2 + q**2)**2"}})[0] == "shown"


def test_exponents_and_numbers_are_limited() -> None:
    tables = {**SPACE, "claim": {"kind": "identity", "lhs": "q*1e999999999", "rhs": "q*1e999999999"}}
    assert forged(tables)[0] == "not shown"
    entry = {"numerator": {"q^999999999": "1"}, "denominator": {"": "1"}, "cofactors": {}}
    assert forged({**SPACE, "claim": {"kind": "identity", "lhs": "0", "rhs": "0"}}, residuals=[entry])[0] == "wrong"


def test_numbers_that_are_squared_for_ever_are_not_waited_for() -> None:
    squares = {f"a{k + 1}": f"a{k}*a{k}" for k in range(60)}
    for first in ("10", "10*q"):
        tables = {**SPACE, "definitions": {"a0": first, **squares}}
        for formula in ("a60", "sin(a60)", "D(a60, q)"):
            assert forged({**tables, "claim": {"kind": "identity", "lhs": formula, "rhs": "0"}})[0] == "not shown"


@pytest.mark.parametrize(("formula", "order"), [("a{0}*sin(a{0}*q + {0})", 15), ("a{0}*p", 8), ("sin(a{0})", 2)])
def test_derivatives_of_derivatives_are_not_waited_for(formula: str, order: int) -> None:
    nested = {f"a{k + 1}": f"D({formula.format(k)}, q, {order})" for k in range(6)}
    tables = {
        **SPACE,
        "definitions": {"a0": "q*p", **nested},
        "claim": {"kind": "identity", "lhs": "a6 + 1", "rhs": "0"},
    }
    assert forged(tables)[0] == "not shown"


@pytest.mark.parametrize(
    "witness", [{"_lhs": "1"}, {"Q": "5", "P": "7"}, {"q": "q"}, {"q": "p + 1"}, {"c": "-1", "q": "1"}]
)
def test_a_witness_says_nothing_but_where(witness: Any) -> None:
    """What is true isn't refuted by naming other formulas, and -1 is no value of what is positive."""
    maps = {**SPACE, "symbols": {"c": "positive"}, "transformation": {"Q": ["q"], "P": ["p"]}}
    claims = [{"kind": "identity", "lhs": "c*Q", "rhs": "c*q"}, {"kind": "identity", "lhs": "c*q", "rhs": "q*c"},
              {"kind": "canonical"}]  # fmt: skip
    for claim in claims:
        data = {"certificate": 1, "tables": {**maps, "claim": claim}, "verdict": "refuted", "witness": witness}
        assert counterexample.checked(resealed({**data, "cases": []}))[0] != "shown"


def refuted(claim: Any, witness: Any, **tables: Any) -> str:
    """The answer about a certificate that refutes a claim by a witness."""
    data = {"certificate": 1, "tables": {**SPACE, **tables, "claim": claim}, "verdict": "refuted", "witness": witness}
    return counterexample.checked(resealed({**data, "cases": []}))[0]


@pytest.mark.parametrize("true", [
    {"lhs": "q**3*D(1/q**2, q)", "rhs": "-2"}, {"lhs": "D(sqrt(q**2), q)**2", "rhs": "1"},
    {"lhs": "q*D(log(q**2), q)", "rhs": "2"}, {"kind": "bracket", "f": "1/q**2", "g": "p*q**3", "equals": "-2"},
])  # fmt: skip
def test_what_has_no_value_has_no_slope(true: Any) -> None:
    """At 0 the slope of q² is 0, and that of 1/q² isn't."""
    assert refuted({"kind": "identity", **true}, {"q": "0", "p": "1"}) == "not shown"


def test_a_field_has_a_hamiltonian_of_its_own() -> None:
    """The witness names none, and the file's is another."""
    field, place = {"kind": "hamiltonian_field", "qdot": ["p"], "pdot": ["-q"]}, {"q": "1", "p": "1"}
    assert refuted(field, {"_H": "0", **place}) == refuted(field, place, hamiltonian={"H": "p**2/2"}) == "not shown"
    assert refuted({**field, "H": "p**2/2"}, place) == "shown"


def test_many_names_and_long_numbers_are_not_waited_for() -> None:
    identity = {"kind": "identity", "lhs": "q", "rhs": "q"}
    assert forged({**SPACE, "claim": {**identity, "lhs": "q*1e9_9_9_9_9_9_9_9_9"}})[0] == "not shown"
    assert refuted(identity, {"q": "1e999999999"}) == "not shown"
    space = {side: [f"{side}{i}" for i in range(2000)] for side in "qpQP"}
    zeros = {"Q": ["0"] * 2000, "P": ["0"] * 2000}
    many = {"phase_space": space, "transformation": zeros, "claim": {"kind": "canonical"}}
    assert forged(many, 0)[0] == "not shown"
    assert forged({**SPACE, "claim": {"kind": "involution", "functions": ["q"] * 2000}})[0] == "not shown"
