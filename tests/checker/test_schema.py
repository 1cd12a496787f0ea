"""Certificates of what no claim file could state: of sections, keys and values that mean nothing, or two things.

Each was confirmed once: the rule of its kind didn't look at what is wrong, or read it as something else.
"""

from typing import Any

import pytest

from tests.checker.certified import certified
from tests.checker.test_forged_kinds import SHOWN, status

SPACE: dict[str, Any] = {"phase_space": {"q": ["q"], "p": ["p"]}}
MAPPED: dict[str, Any] = {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["X"], "P": ["Y"]}}
THREE: dict[str, Any] = {"phase_space": {"q": ["x", "y", "z"], "p": ["a", "b", "c"]}}
PLANE = {"forms": ["z*v1 + v2"], "velocities": ["v1", "v2", "v3"]}
FALL = {"L": "v**2/2", "velocities": ["v"], "accelerations": ["a"]}
LATER = {"definitions": {"b": "2", "c": "b*q"}, "symbols": {"v": "real"}, "domain": {"where": ["v > 0"]}}
PAIR = {"A": "q", "B": "p", "C": "1"}
SPHERE = {"A": "y*c - z*b", "B": "z*a - x*c", "C": "x*b - y*a"}
TURNS = {"A,B": "C", "B,C": "A", "C,A": "B"}


def identity(lhs: Any, rhs: Any, **tables: Any) -> tuple[dict[str, Any], dict[str, Any]]:
    return {"kind": "identity", "lhs": lhs, "rhs": rhs}, {**SPACE, **tables}


def of(kind: str, tables: dict[str, Any] = SPACE, **keys: Any) -> tuple[dict[str, Any], dict[str, Any]]:
    return {"kind": kind, **keys}, tables


def empty(**keys: Any) -> dict[str, Any]:
    return {**MAPPED, "transformation": {"Q": ["q"], "P": ["p"]}, **keys}


NONE = {
    "a derivative by an integer": identity("D(cos(2*pi*n)*q, n)", "-2*pi*sin(2*pi*n)*q", symbols={"n": "integer"}),
    "an order that is a sum": identity("D(q**2, q, 1 + 1)", "2"),
    "a derivative by pi": identity("D(pi**2, pi)", "2*pi"),
    "a derivative by a function": identity("D(V(q), V)", "0", symbols={"V": "function"}),
    "a function without arguments": identity("2*V", "V + V", symbols={"V": "function"}),
    "a function by an index": identity("V[1](q)", "D(V(q), q)", symbols={"V": "function"}),
    "a symbol that is called": identity("sin(q)", "sin(q)", symbols={"sin": "real"}),
    "a coordinate that is called": identity("sin(p)", "sin(p)", phase_space={"q": ["sin"], "p": ["p"]}),
    "a function's name for another": identity("power(q, 2)", "q*q", symbols={"power": "function"}),
    "a number in parts": identity("1_000*q", "1000*q"),
    "true for a formula": identity(True, "1"),
    "signs that contradict": identity("abs(a)", "-a", symbols={"a": ["positive", "negative"]}),
    "a derivative beside complex numbers": identity("D(abs(q + 1j), q)", "abs(q + 1j)/(q + 1j)"),
    "what is nowhere defined, times 0": identity("0*log(-1 - q**2)", "0"),
    "what is nowhere defined, in a derivative": identity("D(log(-1 - q**2), p)", "0"),
    "what is nowhere defined, in an abbreviation": identity("z", "0", definitions={"z": "0*log(-1 - q**2)"}),
    "what is nowhere defined, alone": of("involution", functions=["log(-1 - q**2)"]),
    "a domain that digits make": of("bracket", {**SPACE, "domain": {"on": ["(10**60 + 1 + q**2) - 10**60"]}},
        f="q", g="p", equals="1"),
    "a section": identity("q", "q", hamiltonians={"H": "p"}),
    "a section's key": identity("q", "q", phase_space={"q": ["q"], "p": ["p"], "Time": "T"}),
    "a key": of("fundamental_brackets", empty(transformation={"Q": ["2*q"], "P": ["p"]}), scale="2"),
    "a type that is true": of("generating_function", empty(transformation={"Q": ["p"], "P": ["-q"]}), type=True,
        F="q*X"),
    "a side": of("limit", f="q", variable="x", to="0", side="right", equals="q"),
    "1 for true": of("constraint", THREE, **PLANE, holonomic=1),
    "a text for true": of("constraint", THREE, **PLANE, holonomic="true"),
    "a text for a list": of("involution", functions="qq"),
    "a text for names": identity("q", "q", phase_space={"q": "q", "p": "p"}),
    "no functions": of("involution", functions=[]),
    "no equations": of("solves", solution={}, equations=[]),
    "no dimensions": of("dimension", functions=[], dimensions={}, equals="M"),
    "no matrix": of("invariant_interval", matrix=[], metric=[]),
    "no basis": of("algebra", basis={}, structure={}),
    "no coordinates": of("canonical", {"phase_space": {"q": [], "p": [], "Q": [], "P": []},
        "transformation": {"Q": [], "P": []}}),
    "fewer old variables": of("canonical", {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["X", "U"], "P": ["Y", "V"]},
        "transformation": {"q": ["X"], "p": ["Y"]}}),
    "a pair of one": of("algebra", basis={"A": "q", "B": "1"}, structure={"A,A": "B"}),
    "a pair twice": of("algebra", basis=PAIR, structure={"A,B": "2*C", "B,A": "-C"}),
    "a pair twice, in other letters": of("algebra", basis=PAIR, structure={"A,B": "2*C", "A,\u00a0B": "C"}),
    "coordinates twice": of("bracket", f="A", g="A", equals="0", coordinates=["A", "A"],
        tensor=[["0", "1"], ["-1", "0"]]),
    "a tensor of other coordinates": of("bracket", f="A", g="B", equals="1", coordinates=["A", "B"],
        tensor=[["0", "1", "5"], ["-1", "0", "7"], ["-5", "-7", "0"]]),
    "a coordinate that is 5": of("casimir", {**SPACE, "definitions": {"A": "5"}}, f="A", coordinates=["A", "B"],
        tensor=[["0", "1"], ["-1", "0"]]),
    "a velocity that is 3": of("euler_lagrange", {**SPACE, "definitions": {"v": "3"}}, L="v**2/2", velocities=["v"],
        equations=["0"]),
    "a parameter that is 0": of("lie_series", {**SPACE, "definitions": {"s": "0"}}, generator="0", parameter="s",
        f="q", equals="q + s"),
    "an order in what is 0": of("canonical", empty(definitions={"e": "0"},
        transformation={"Q": ["q + e*q"], "P": ["p"]}), order=["e", 2]),
    "an algebra's other name": of("algebra", THREE, basis=SPHERE, structure=TURNS, equals="so(13,3)"),
    "a degree with a sign": of("normal_form", {**SPACE, "hamiltonian": {"H": "(p**2 + q**2)/2 + q**4"}}, order=4,
        N={"+4": "3/2*((p**2 + q**2)/2)**2"}),
    "a degree with a space": of("normal_form", {**SPACE, "hamiltonian": {"H": "(p**2 + q**2)/2 + q**4"}}, order=4,
        N={" 4": "3/2*((p**2 + q**2)/2)**2"}),
    "a text for a list of equations": of("euler_lagrange", SPACE, **FALL, equations="a"),
    "one function in involution": of("involution", SPACE, functions=["q"]),
    "an abbreviation of what is the claim's own": of("euler_lagrange", {**SPACE, "definitions": {"A": "v**2/2"}},
        L="A", velocities=["v"], accelerations=["a"], equations=["a"]),
    "a domain of what is the claim's own": of("euler_lagrange", {**SPACE, "domain": {"where": ["v > 0"]}}, **FALL,
        equations=["a"]),
    "a Hamiltonian of what is the claim's own": of("euler_lagrange", {**SPACE, "hamiltonian": {"H": "p*v"}}, **FALL,
        equations=["a"]),
    "time, that is defined further down": of("conserved", {**SPACE, "definitions": {"a": "t", "t": "3"},
        "hamiltonian": {"H": "p**2/2"}}, f="q - p*a"),
    "an expectation of nothing": of("involution", SPACE, functions=["q", "q"], expect="zzz"),
    "a budget that is none": of("involution", SPACE, functions=["q", "q"], budget="zzz"),
    "a title that is a number": of("involution", {**SPACE, "title": 5}, functions=["q", "q"]),
    "a map to nothing": of("involution", {**SPACE, "transformation": {}}, functions=["q", "q"]),
    "half of an algebra's name": of("algebra", THREE, basis=SPHERE, structure=TURNS, equals="so(3"),
}  # fmt: skip


@pytest.mark.parametrize("name", sorted(NONE))
def test_what_no_file_could_state_is_not_confirmed(name: str) -> None:
    claim, tables = NONE[name]
    assert {status(claim, "proved", shown, tables) for shown in SHOWN}.isdisjoint({"confirmed"})


def test_no_refutation_of_nothing() -> None:
    assert (
        status({"kind": "constraint", "forms": ["v"], "velocities": ["v"]}, "refuted", SHOWN[0], SPACE) != "confirmed"
    )


def test_the_same_as_a_file_states_it_is_confirmed() -> None:
    of_text = {"numerator": {}, "denominator": {"": "1"}, "cofactors": {}}
    claims = (
        identity("0*sqrt(q)", "0"), identity("1e3*q", "1000*q"), identity("D(n*q, q)", "n", symbols={"n": "integer"}),
        of("constraint", THREE, **PLANE, holonomic=False), of("algebra", basis=PAIR, structure={"A,B": "C"}),
        of("algebra", THREE, basis=SPHERE, structure=TURNS, equals="so(3)"),
        of("involution", functions=["sqrt(q)", "q"]),
        of("euler_lagrange", {**SPACE, **LATER}, **FALL, equations=["a"]),
    )  # fmt: skip
    for claim, tables in claims:
        assert status(claim, "proved", of_text, {**tables}) == "confirmed", claim


def test_a_certificate_says_no_pair_twice() -> None:
    from canon.checker.check import check
    from canon.checker.functions import Unreadable
    from tests.checker.certified import resealed

    text = '[phase_space]\nq = ["q"]\np = ["p"]'
    data = certified(text, 'kind = "algebra"\nbasis = {A = "q", B = "p", C = "1"}\nequals = "heisenberg(1)"')
    assert check(data).status == "confirmed"
    data["known"]["structure"] = {**data["known"]["structure"], "B,A": "-C"}
    with pytest.raises(Unreadable):
        check(resealed(data))


@pytest.mark.parametrize(
    "torus",
    [
        {"cycles": [{"coordinate": "r"}], "turns": [[1.0]]},
        {"cycles": [{"coordinate": 1}], "turns": [[1]]},
        {"cycles": [], "turns": [[1]]},
        {"cycles": [{"coordinate": "r"}], "turns": [[1]], "more": []},
        [],
    ],
)
def test_a_torus_is_made_of_cycles_and_turns(torus: Any) -> None:
    from canon.checker.check import check
    from canon.checker.functions import Unreadable
    from tests.checker.certified import resealed

    data = certified('[phase_space]\nq = ["q"]\np = ["p"]', 'kind = "identity"\nlhs = "q + q"\nrhs = "2*q"')
    data["known"]["torus"] = {"cycles": [{"coordinate": "q", "action": "2*pi*p"}], "turns": [[1]]}
    assert check(resealed(data)).status == "confirmed"
    data["known"]["torus"] = torus
    with pytest.raises(Unreadable, match="torus"):
        check(resealed(data))


POSITIVE = {**SPACE, "symbols": {"a": "positive", "b": "positive", "q": "positive", "E": "negative"}}
ATTRACTED = {**POSITIVE, "hamiltonian": {"H": "p**2/2 - a/q + b**2/(2*q**2)"}}
REPELLED = {**POSITIVE, "hamiltonian": {"H": "p**2/2 + a/q + b**2/(2*q**2)"}}
WELL = {"symbols": {"a": "positive", "b": "positive", "E": "positive"}, "domain": {"where": ["E < b"]},
        "hamiltonian": {"H": "p**2/2 + b*(1 - exp(-a*q))**2"}}  # fmt: skip
WALLED = {**WELL, "symbols": {**WELL["symbols"], "q": "positive"}}
DEPTH = "2*pi*(sqrt(2*b) - sqrt(2*(b - E)))/a"


def orbit(kind: str, tables: dict[str, Any], equals: str) -> tuple[dict[str, Any], dict[str, Any]]:
    return {"kind": kind, "coordinate": "q", "energy": "E", "equals": equals}, {**SPACE, **tables}


LINE: dict[str, Any] = {**SPACE, "symbols": {"a": "real"}}
BACKWARD = {**MAPPED, "hamiltonian": {"H": "p**3/3"}, "transformation": {"q": ["0"], "p": ["0"]}}
FLAT = {**MAPPED, "generating_function": {"type": 1, "F": "0"}}
COMPLEX = {**MAPPED, "symbols": {"a": "real"}, "transformation": {"Q": ["(a + 1)*q + 1j - 1j"], "P": ["p"]}}
MEANT: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "a basis that is none for a = 0": of("algebra", LINE, basis={"A": "q", "B": "a*p", "C": "a"},
        structure={"A,B": "C"}),
    "an algebra that is 0 for a = 0": of("algebra", {**THREE, "symbols": {"g": "real"}}, structure=TURNS,
        basis={name: f"g*({text})/g" for name, text in SPHERE.items()} | {"A": "g**2*(y*c - z*b)"}),
    "a conserved quantity at one point": of("conserved", BACKWARD, f="q"),
    "a bracket where a map is none": of("bracket", FLAT, f="q", g="p**2", equals="0"),
    "a root that may be imaginary": of("canonical", COMPLEX, scale="sqrt(a)*sqrt(a) + 1"),
    "a bracket of what it isn't one of": of("casimir", f="q", tensor=[["0", "1"], ["-1", "0"]], coordinates=["A", "B"]),
    "constants that aren't": of("bracket", f="A", g="B", equals="A**2", structure={"A,B": "A**2"}),
    "an integral to i": of("integral", f="1", variable="x", to="1j", equals="1j", antiderivative="x", **{"from": "0"}),
    "an integral that is 0 on a half": of("constraint", forms=["v"], velocities=["v"], integrals=["abs(q) + q"]),
    "an integral of velocities": of("constraint", forms=["v"], velocities=["v"], integrals=["q*v"]),
    "a force of momenta": of("euler_lagrange", L="v**2/2", velocities=["v"], accelerations=["w"], forces=["p"],
        equations=["w - p"]),
    "a complete integral of momenta": of("hamilton_jacobi", {**SPACE, "hamiltonian": {"H": "p**2/2"}}, W="a*q + p",
        constants=["a"], energy="a**2/2"),
    "a field elsewhere": of("field_equations", {**SPACE, "symbols": {"u": "function", "x": "real"}}, L="u(x)*u(2*x)",
        fields=["u(x)"], equations=["u(x) + u(2*x)"]),
    "a solution of a name twice": of("solves", {**SPACE, "symbols": {"u": "function", "x": "real"}},
        solution={"u(x, x)": "x**2"}, equations=["u(x, x) - x**2"]),
    "a solution by itself": of("solves", {**SPACE, "symbols": {"u": "function", "x": "real"}},
        solution={"u(x)": "u(x) + 1"}, equations=["D(u(x), x) - D(u(x) + 7, x)"]),
    "the frequency of no motion": orbit("frequency", REPELLED, "-(-2*E)**(3/2)/(2*pi*a)"),
    "the action of an orbit through a wall": orbit("action", WALLED, DEPTH),
}  # fmt: skip


@pytest.mark.parametrize("name", sorted(MEANT))
def test_no_proof_of_what_is_nothing(name: str) -> None:
    claim, tables = MEANT[name]
    assert status(claim, "proved", SHOWN[0], tables) != "confirmed"


def test_bases_whatever_the_parameters_are() -> None:
    """By pivots, by an ideal that isn't there, by one function of a simple algebra, in intervals."""
    positive = {**LINE, "symbols": {"a": "positive"}}
    for tables, basis, structure in (
        (positive, {"A": "q", "B": "a*p", "C": "a"}, {"A,B": "C"}),
        (LINE, {"A": "p**2/2 + a/q**2", "B": "q*p/2", "C": "q**2/2"}, {"A,B": "-A", "B,C": "-C", "A,C": "-2*B"}),
        (THREE, SPHERE, TURNS),
        ({**SPACE}, {"A": "exp(q)", "B": "p"}, {"A,B": "A"}),
    ):
        claim = {"kind": "algebra", "basis": basis, "structure": structure}
        assert status(claim, "proved", SHOWN[0], tables) == "confirmed", basis


def test_motions_that_there_are() -> None:
    for kind, tables, equals in (
        ("frequency", ATTRACTED, "(-2*E)**(3/2)/(2*pi*a)"), ("action", WELL, DEPTH)
    ):  # fmt: skip
        claim, everything = orbit(kind, tables, equals)
        assert status(claim, "proved", SHOWN[0], everything) == "confirmed", kind
