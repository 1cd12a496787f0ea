"""The checker of refutations: what it shows, that no true claim is shown to be false, and that its intervals hold."""

import json
import random
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import mpmath
import pytest

from canon.checker import alone, counterexample
from canon.checker.counterexample import Arithmetic, Interval, Open
from tests.checker.certified import certified, resealed

FILE = Path(counterexample.__file__)
LINE = '[phase_space]\nq = ["q"]\np = ["p"]\n'
MAP = LINE.replace("]\np", "]\nQ = ['Q']\nP = ['P']\np")
PAIRS = "[phase_space]\nq = ['x', 'y', 'z']\np = ['u', 'v', 'w']\n"
WELL = "[symbols]\nV = 'function'\nk = 'positive'\n[hamiltonian]\nH = '(p**2 + k**2*q**2)/2 + V(q)'\n"
SHOWN = {
    "fractions": (MAP + "[transformation]\nQ = ['q + p**2']\nP = ['2*p']\n", "kind = 'canonical'"),
    "roots": (MAP + "[transformation]\nQ = ['sqrt(3*q)*cos(p)']\nP = ['sqrt(2*q)*sin(p)']\n", "kind = 'canonical'"),
    "an arc": (MAP + "[transformation]\nQ = ['atan2(q, p)']\nP = ['(q**2 + p**2)/3']\n", "kind = 'canonical'"),
    "another branch": (LINE, "kind = 'identity'\nlhs = 'asin(sin(q))'\nrhs = 'q'"),
    "hyperbolic functions": (LINE, "kind = 'identity'\nlhs = 'atanh(tanh(q)) + asinh(sinh(p))'\nrhs = 'q - p'"),
    "given backward": (
        MAP + "[symbols]\nP = 'positive'\n[hamiltonian]\nH = '(p**2 + q**2)/2'\n[transformation]\n"
        "q = ['sqrt(2*P)*sin(Q)']\np = ['sqrt(2*P)*cos(Q)']\n",
        "kind = 'new_hamiltonian'\nK = 'P + P**2/1000'",
    ),
    "type 1": (
        MAP + "[transformation]\nQ = ['p']\nP = ['-q']\n", "kind = 'generating_function'\ntype = 1\nF = 'q*Q + q*Q**3'"
    ),
    "a function by its formula": (LINE + WELL, "kind = 'conserved'\nf = 'p**2 + k**2*q**2'"),
    "a power": (
        LINE + "[symbols]\na = 'real'\nq = 'positive'\n", "kind = 'bracket'\nf = 'q**a'\ng = 'p'\nequals = 'a'"
    ),
    "an inequality": (LINE, "kind = 'inequality'\nlhs = 'exp(q)'\nrelation = '>'\nrhs = '1 + q + q**2/2'"),
    "equality": (LINE, "kind = 'inequality'\nlhs = '2*q'\nrelation = '<'\nrhs = 'q + q'"),
    "Lagrange's equations": (LINE, "kind = 'euler_lagrange'\nL = 'v**2/2 - cos(q)'\nvelocities = ['v']\nqddot = ['q']"),
    "a solution": (
        LINE + "[symbols]\nx = 'function'\n",
        "kind = 'solves'\nequations = ['D(x(t), t, 2) + x(t)']\n[claim.solution]\n'x(t)' = 'sin(2*t)'"
    ),
    "a complete integral": (
        LINE + "[hamiltonian]\nH = 'p**2/2 + q'\n",
        "kind = 'hamilton_jacobi'\nW = '(2*E - 2*q)**(3/2)/4'\nconstants = ['E']\nenergy = 'E'"
    ),
    "a field": (LINE, "kind = 'hamiltonian_field'\nqdot = ['p']\npdot = ['-q - p/10']"),
    "a symmetry": (LINE, "kind = 'noether'\nL = 'v**2/2 - q**4'\nvelocities = ['v']\ndq = ['q']\nf = 'q*t'"),
    "Legendre's transform": (
        LINE + "[hamiltonian]\nH = 'p**2/2 + cos(q)'\n", "kind = 'legendre'\nL = 'v**2/2 + cos(q)'\nvelocities = ['v']"
    ),
    "a matrix": (
        "[symbols]\na = 'real'\n",
        "kind = 'invariant_interval'\nmatrix = [['cos(a)', 'sin(a)'], ['sin(a)', 'cos(a)']]\nmetric = [[1, 0], [0, 1]]"
    ),
    "a Casimir function": (
        PAIRS, "kind = 'casimir'\nf = 'x**2 + y**2 + 2*z**2'\n[claim.structure]\n'x,y' = 'z'\n'y,z' = 'x'\n'z,x' = 'y'"
    ),
    "a bracket of a tensor": (
        LINE,
        "kind = 'bracket'\nf = 'q'\ng = 'p'\nequals = 'q**2'\ncoordinates = ['q', 'p']\ntensor = [[0, 'q'], ['-q', 0]]"
    ),
    "Poincare's invariant": (
        MAP + "[transformation]\nQ = ['q*exp(p)']\nP = ['p']\n", "kind = 'integral_invariant'"
    ),
    "areas": (MAP + "[transformation]\nQ = ['q*exp(p)']\nP = ['p*exp(-q)']\n", "kind = 'volume'"),
    "beside a map": (
        MAP + "[transformation]\nQ = ['q**3']\nP = ['p']\n", "kind = 'identity'\nlhs = 'Q*q'\nrhs = 'q**2'"
    ),
}  # fmt: skip


def refutation(name: str) -> Any:
    return certified(*SHOWN[name])


@pytest.mark.parametrize("name", SHOWN)
def test_it_shows_what_is_refuted(name: str) -> None:
    data = refutation(name)
    assert data["verdict"] == "refuted"
    assert counterexample.checked(data) == ("shown", "")
    assert alone.checked(data)[0] == "not shown"


def test_a_changed_certificate_is_wrong() -> None:
    data = refutation("fractions")
    data["witness"]["q"] += "0"
    assert counterexample.checked(data) == ("wrong", "the checksum")
    data = refutation("type 1")
    data["witness"] |= {"q": "0", "p": "0"}
    assert counterexample.checked(resealed(data)) == ("wrong", "nothing fails at the witness")


def answer(claim: Any, witness: Any, **tables: Any) -> str:
    """The answer about a certificate that refutes a claim by a witness."""
    space = {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]}
    tables = {"phase_space": space, **tables, "claim": claim}
    data = {"certificate": 1, "tables": tables, "verdict": "refuted", "witness": witness, "cases": []}
    return counterexample.checked(resealed(data))[0]


ROUND = {"transformation": {"Q": ["q*exp(t)"], "P": ["p*exp(-t)"]}}
TRUE: dict[str, tuple[Any, Any]] = {
    "a quotient that is 1": ({"lhs": "sin(q)/sin(q)", "rhs": "1"}, {}),
    "a pole that is taken away": ({"lhs": "q*(1/q)", "rhs": "1"}, {}),
    "a slope": ({"lhs": "q**3*D(1/q**2, q)", "rhs": "-2"}, {}),
    "the root of a square": ({"lhs": "D(sqrt(q**2), q)**2", "rhs": "1"}, {}),
    "a cube root, of what is positive": ({"lhs": "cbrt(q**3)", "rhs": "q"}, {}),
    "a logarithm": ({"lhs": "exp(log(q))", "rhs": "q"}, {}),
    "two logarithms": ({"lhs": "log(q*p)", "rhs": "log(q) + log(p)"}, {}),
    "what is multiplied by 0": ({"lhs": "0*log(q) + q**2/q", "rhs": "q"}, {}),
    "a sum of arcs": ({"lhs": "asin(q) + acos(q)", "rhs": "pi/2"}, {}),
    "an angle": ({"lhs": "tan(atan2(q, p))", "rhs": "q/p"}, {}),
    "a hyperbolic function": ({"lhs": "acosh(cosh(q) + 1/10**40)", "rhs": "acosh(cosh(q) + 1/10**40)"}, {}),
    "a very small angle": ({"lhs": "sin(q/10**90)**2 + cos(q/10**90)**2", "rhs": "1"}, {}),
    "a very large angle": ({"lhs": "sin(10**90*q)**2 + cos(10**90*q)**2", "rhs": "1"}, {}),
    "a domain": ({"lhs": "sqrt((q - 1)**2)", "rhs": "q - 1"}, {"domain": {"where": ["q > 1"]}}),
    "a chain": ({"lhs": "asin(sin(q))", "rhs": "q"}, {"domain": {"where": ["-pi/2 < q < pi/2"]}}),
    "another side": ({"lhs": "atan(1/q) + atan(q)", "rhs": "pi/2"}, {"domain": {"where": ["q >= 0", "p != 0"]}}),
    "a name that is positive": ({"lhs": "sqrt(c**2)", "rhs": "c"}, {"symbols": {"c": "positive"}}),
    "a name that is negative": ({"lhs": "sqrt(c**2)", "rhs": "-c"}, {"symbols": {"c": ["real", "negative"]}}),
    "a whole number": ({"lhs": "sin(pi*n)", "rhs": "0"}, {"symbols": {"n": "integer"}}),
    "a new variable that is positive": (
        {"lhs": "sqrt(q**2)", "rhs": "q"}, {"symbols": {"Q": "positive"}, **ROUND},
    ),
    "a new variable's value": ({"lhs": "Q*P", "rhs": "q*p"}, ROUND),
    "a condition on it": ({"lhs": "sqrt(Q**2)", "rhs": "Q"}, {"domain": {"where": ["0 < Q"]}, **ROUND}),
    "a Hamiltonian's own domain": ({"lhs": "sqrt(q**2)", "rhs": "q"}, {"hamiltonian": {"H": "p**2 + log(q)"}}),
    "it beside a map": ({"kind": "canonical"}, {"hamiltonian": {"H": "p**2 + log(q)"}, "transformation": {
        "Q": ["sqrt(q**2)"], "P": ["p"]}}),
    "the domain of a map that is given by a generating function": (
        {"lhs": "sqrt(q**2)", "rhs": "q"}, {"generating_function": {"type": 2, "F": "P*log(q)"}},
    ),
    "a map's own domain": (
        {"lhs": "sqrt(q**2)", "rhs": "q"}, {"transformation": {"Q": ["log(q)"], "P": ["q*p"]}},
    ),
    "a map": ({"kind": "canonical"}, ROUND),
    "a scale": ({"kind": "canonical", "scale": "c"}, {"symbols": {"c": "nonzero"}, "transformation": {
        "Q": ["c*q"], "P": ["p"]}}),
    "a map's scale": ({"kind": "new_hamiltonian", "K": "3*P**2"}, {"hamiltonian": {"H": "p**2"}, "transformation": {
        "Q": ["3*q"], "P": ["p/1"]}, "symbols": {}}),
    "a map backward": ({"kind": "canonical"}, {"transformation": {
        "q": ["sqrt(2*P)*sin(Q)"], "p": ["sqrt(2*P)*cos(Q)"]}}),
    "a bracket beside it": ({"kind": "new_hamiltonian", "K": "P**2/4"}, {"transformation": {
        "q": ["2*Q"], "p": ["P"]}, "hamiltonian": {"H": "bracket(q, p)*p**2/2"}}),
    "a generating function up to time": (
        {"kind": "generating_function", "type": 2, "F": "q*P*exp(t) + sin(t)"}, ROUND,
    ),
    "a function": ({"kind": "bracket", "f": "V(q)", "g": "p", "equals": "D(V(q), q)"}, {"symbols": {"V": "function"}}),
    "a function that is positive": ({"lhs": "sqrt(V(q)**2)", "rhs": "V(q)"}, {"symbols": {
        "V": ["function", "positive"]}}),
    "a function that has one sign": ({"lhs": "sqrt(V(q)**2*V(p)**2)", "rhs": "V(q)*V(p)"}, {"symbols": {
        "V": ["function", "nonzero"]}}),
    "a difference that nobody sees": ({"kind": "inequality", "lhs": "sin(q)**2 + cos(q)**2", "relation": "<",
        "rhs": "1 + 1/10**300"}, {}),
    "a square": ({"kind": "inequality", "lhs": "q**2", "relation": ">=", "rhs": "0"}, {}),
    "an exponential": ({"kind": "inequality", "lhs": "exp(q)", "relation": ">", "rhs": "0"}, {}),
    "the side of a motion": ({"kind": "inequality", "lhs": "q", "relation": "<=", "rhs": "0"}, {"domain": {
        "where": ["q < 0"]}}),
    "a motion": ({"kind": "conserved", "f": "q - p*t"}, {"hamiltonian": {"H": "p**2/2"}}),
    "a field": ({"kind": "hamiltonian_field", "qdot": ["p"], "pdot": ["-q"], "H": "(p**2 + q**2)/2"}, {}),
    "the field of some other H": ({"kind": "hamiltonian_field", "qdot": ["p"], "pdot": ["-q"]}, {
        "hamiltonian": {"H": "p**2/2"}}),
    "Lagrange's equations": ({"kind": "euler_lagrange", "L": "v**2/2 - sqrt(q**2)", "velocities": ["v"],
        "accelerations": ["a"], "equations": ["a + 1"]}, {"domain": {"where": ["q > 0"]}}),
    "a solution": ({"kind": "solves", "solution": {"x(t)": "sqrt(t**2)"}, "equations": ["D(x(t), t)**2 - 1"]}, {
        "symbols": {"x": "function"}}),
    "a solution at a time": ({"kind": "solves", "solution": {"x(t)": "cos(t)"}, "equations": ["x(0) - 1"]}, {
        "symbols": {"x": "function"}}),
    "a complete integral, of a momentum with a sign": (
        {"kind": "hamilton_jacobi", "W": "e*q", "constants": ["e"], "energy": "e**2/2"},
        {"hamiltonian": {"H": "p*sqrt(p**2)/2"}, "symbols": {"p": "positive"}},
    ),
    "Legendre's transformation, of one": (
        {"kind": "legendre", "L": "v**2/2", "velocities": ["v"]},
        {"hamiltonian": {"H": "p*sqrt(p**2)/2"}, "domain": {"where": ["p > 0"]}},
    ),
    "a solution whose argument is positive": ({"kind": "solves", "solution": {"x(t)": "sqrt(t**2)"}, "equations": [
        "x(q) - q"]}, {"symbols": {"x": "function", "t": "positive"}}),
    "solutions, one of them where both have values": ({"kind": "solves", "solution": {"x(t)": "sqrt(t)", "y(t)": "q"},
        "equations": ["y(t) - sqrt(q**2)", "x(q)**2 - q"]}, {"symbols": {"x": "function", "y": "function"}}),
    "Lagrange's equations beside a map": ({"kind": "euler_lagrange", "L": "v**2/2 - sqrt(q**2)", "velocities": ["v"],
        "accelerations": ["a"], "equations": ["a + 1"]}, {"transformation": {"Q": ["-q"], "P": ["-p"]}, "domain": {
        "where": ["Q < 0"]}}),
    "a charge": ({"kind": "noether", "L": "v**2/2", "velocities": ["v"], "dq": ["1"], "charge": "v"}, {}),
    "a bracket of the claim's own": ({"kind": "bracket", "f": "q", "g": "p", "equals": "2*q", "tensor": [
        ["0", "2*q"], ["-2*q", "0"]], "coordinates": ["q", "p"]}, {}),
    "what is no bracket": ({"kind": "bracket", "f": "q", "g": "p", "equals": "2", "tensor": [
        ["0", "1"], ["-2", "0"]], "coordinates": ["q", "p"]}, {}),
    "a volume, turned round": ({"kind": "volume"}, {"transformation": {"Q": ["q"], "P": ["-p"]}}),
    "equations with friction and a force": ({"kind": "euler_lagrange", "L": "c*v**2/2 - V(q)", "velocities": ["v"],
        "accelerations": ["a"], "equations": ["c*a + D(V(q), q) + k*v - sin(t)"], "dissipation": "k*v**2/2",
        "forces": ["sin(t)"]}, {"symbols": {"V": "function", "c": "positive", "k": "real"}}),
    "accelerations": ({"kind": "euler_lagrange", "L": "q**2*v**2/2 + t*q", "velocities": ["v"],
        "qddot": ["(t - q*v**2)/q**2"]}, {}),
    "a pendulum's acceleration, on a half": ({"kind": "euler_lagrange", "L": "v**2/2 + sqrt(cos(q)**2)",
        "velocities": ["v"], "qddot": ["-sin(q)"]}, {"domain": {"where": ["-pi/2 < q < pi/2"]}}),
    "a boost": ({"kind": "noether", "L": "c*v**2/2", "velocities": ["v"], "dq": ["t"], "f": "c*q",
        "charge": "c*(v*t - q)"}, {"symbols": {"c": "positive"}}),
    "a shift of time": ({"kind": "noether", "L": "v**2/2 - V(q)", "velocities": ["v"], "dq": ["0"], "dt": "1",
        "charge": "-v**2/2 - V(q)"}, {"symbols": {"V": "function"}}),
    "a complete integral in time": ({"kind": "hamilton_jacobi", "S": "e*q - e**2*t/2", "constants": ["e"]}, {
        "hamiltonian": {"H": "p**2/2"}}),
    "a complete integral where it is real": ({"kind": "hamilton_jacobi", "W": "-(2*(e - q))**(3/2)/3",
        "constants": ["e"], "energy": "e"}, {"hamiltonian": {"H": "p**2/2 + q"}}),
    "one of a momentum that is bounded": ({"kind": "hamilton_jacobi", "W": "e*q", "constants": ["e"],
        "energy": "1 - e"}, {"hamiltonian": {"H": "sqrt((1 - p)**2)"}, "domain": {"where": ["p < 1"]}}),
    "Legendre's transformation, relativistic": ({"kind": "legendre", "L": "-sqrt(1 - v**2)", "velocities": ["v"]}, {
        "hamiltonian": {"H": "sqrt(1 + p**2)"}}),
    "Legendre's, of a velocity with a sign": ({"kind": "legendre", "L": "v*sqrt(v**2)/2", "velocities": ["v"]}, {
        "symbols": {"v": "positive"}, "hamiltonian": {"H": "p**2/2"}}),
    "a solution with a root of its argument": ({"kind": "solves", "solution": {"x(t)": "sqrt(t)"}, "equations": [
        "D(x(t), t)*x(t) - 1/2", "x(t**2) - sqrt(t**2)"]}, {"symbols": {"x": "function"}}),
    "a solution of two names": ({"kind": "solves", "solution": {"x(q, t)": "sin(q - t) + (q + t)**2"}, "equations": [
        "D(x(q, t), q, 2) - D(x(q, t), t, 2)", "x(t, t) - 4*t**2"]}, {"symbols": {"x": "function"}}),
    "a solution with a constant that has a sign": ({"kind": "solves", "solution": {"x(t)": "sqrt(c**2)*t"},
        "equations": ["x(t) - c*t"]}, {"symbols": {"x": "function", "c": "positive"}}),
    "a matrix": ({"kind": "invariant_interval", "matrix": [["cosh(a)", "sinh(a)"], ["sinh(a)", "cosh(a)"]], "metric": [
        [1, 0], [0, -1]], "inverse": [["cosh(a)", "-sinh(a)"], ["-sinh(a)", "cosh(a)"]]}, {"symbols": {"a": "real"}}),
    "a Casimir function": ({"kind": "casimir", "f": "x**2 + y**2 + z**2", "structure": {
        "x,y": "z", "y,z": "x", "z,x": "y"}}, {"phase_space": {"q": ["x", "y", "z"], "p": ["u", "v", "w"]}}),
    "a Casimir function of a tensor": ({"kind": "casimir", "f": "z/x", "coordinates": ["x", "y", "z"], "tensor": [
        ["0", "x*z", "0"], ["-x*z", "0", "-z**2"], ["0", "z**2", "0"]]}, {
        "phase_space": {"q": ["x", "y", "z"], "p": ["u", "v", "w"]}}),
    "spins": ({"kind": "conserved", "f": "x**2 + y**2 + z**2", "structure": {"x,y": "z", "y,z": "x", "z,x": "y"}}, {
        "phase_space": {"q": ["x", "y", "z"], "p": ["u", "v", "w"]}, "hamiltonian": {"H": "sin(x) + y*z"}}),
    "spins turned": ({"kind": "bracket", "f": "x**2", "g": "y", "equals": "2*x*z", "structure": {
        "x,y": "z", "y,z": "x", "z,x": "y"}}, {"phase_space": {"q": ["x", "y", "z"], "p": ["u", "v", "w"]}}),
    "a volume backward": ({"kind": "volume"}, {"transformation": {
        "q": ["sqrt(2*P)*sin(Q)"], "p": ["sqrt(2*P)*cos(Q)"]}}),
    "areas that are kept": ({"kind": "integral_invariant"}, {"transformation": {
        "Q": ["atan2(q, p)"], "P": ["(q**2 + p**2)/2"]}}),
    "an area of fourth order": ({"kind": "integral_invariant", "order": 2}, {
        "phase_space": {"q": ["x", "y"], "p": ["u", "v"], "Q": ["X", "Y"], "P": ["U", "W"]},
        "transformation": {"Q": ["2*x", "y/2"], "P": ["u", "v"]}}),
    "a Hamiltonian field beside another sign": ({"kind": "hamiltonian_field", "qdot": ["p/sqrt(q**2)"],
        "pdot": ["p**2/(2*q**2)"]}, {"domain": {"where": ["q > 0"]}}),
    "a surface": ({"lhs": "q", "rhs": "1"}, {"domain": {"on": ["q - 1"]}}),
    "a shift that a claim's own key says": ({"kind": "canonical", "order": ["eps", 1]}, {"symbols": {
        "eps": "real"}, "transformation": {"Q": ["q + eps*p"], "P": ["p + eps**2*q"]}}),
    "an imaginary number": ({"lhs": "(1j*q)**2", "rhs": "-q**2"}, {}),
}  # fmt: skip
VALUES = ("0", "1", "-1", "2", "-2", "1/2", "-7/3", "22/7", "-1000000000001/1000000000000", "1/100000000000000000000")


@pytest.mark.parametrize("name", TRUE)
def test_no_true_claim_is_shown_to_be_false(name: str) -> None:
    """At points of the domain and outside of it, in integers and near them, with names left out, or of others."""
    claim, tables = TRUE[name]
    rng = random.Random(name)
    names = ["q", "p", "Q", "P", "t", "c", "n", "eps", "v", "a", "e", "k", "x", "y", "z"]
    for k in range(8):
        witness = {x: rng.choice(VALUES) if k > 3 else VALUES[k] for x in names if k % 4 or rng.random() < 0.8}
        witness |= {"V": rng.choice(["a", "a**2 - 1/2", "-1", "sqrt(a)", "1/a", "q", "exp(a)"])} if k % 2 else {}
        found = answer(
            {"kind": "identity", **claim}, {**witness, "_lhs": "1", "_H": "0", "pi": "3", "__L": "0"}, **tables
        )
        assert found != "shown", witness


def test_what_is_false_is_shown_where_it_fails_in_the_domain_alone() -> None:
    claim, where = {"kind": "identity", "lhs": "sqrt(q**2)", "rhs": "q"}, {"domain": {"where": ["q < -1", "p > q"]}}
    assert answer(claim, {"q": "-2", "p": "0"}, **where) == "shown"
    assert answer(claim, {"q": "-2", "p": "-2"}, **where) == "not shown"
    assert answer(claim, {"q": "-1", "p": "0"}, **where) == "not shown"
    assert answer(claim, {"q": "2", "p": "3"}, **where) == "not shown"


def test_a_difference_that_is_small_is_seen_and_one_that_is_smaller_is_not() -> None:
    claim = {"kind": "identity", "lhs": "exp(q)*exp(p)"}
    assert answer({**claim, "rhs": "exp(q + p) + 1/10**150"}, {"q": "1/3", "p": "-5/7"}) == "shown"
    assert answer({**claim, "rhs": "exp(q + p) + 1/10**160"}, {"q": "1/3", "p": "-5/7"}) == "not shown"


@pytest.mark.parametrize(
    "witness", [{"q": "q"}, {"q": {"re": "1", "im": "1"}}, {"q": ["1"]}, {"q": "1e999999999"}, [1]]
)
def test_what_is_no_point_shows_nothing(witness: Any) -> None:
    assert answer({"kind": "identity", "lhs": "q", "rhs": "p"}, witness) == "not shown"


@pytest.mark.parametrize("data", [[], {}, {"checksum": ""}, None, {"checksum": 1, "tables": []}])
def test_what_is_no_certificate_is_said_to_be_none(data: Any) -> None:
    assert counterexample.checked(data)[0] != "shown"


def test_large_numbers_and_high_derivatives_are_not_waited_for() -> None:
    squares = {f"a{k + 1}": f"a{k}*a{k}" for k in range(60)}
    for first in ("10*q", "exp(q)", "1/q"):
        tables = {"definitions": {"a0": first, **squares}}
        for formula in ("a60", "sin(a60)", "exp(a60)", "D(a60, q)"):
            assert answer({"kind": "identity", "lhs": formula, "rhs": "1"}, {"q": "3"}, **tables) == "not shown"
    nested = {f"a{k + 1}": f"D(sin(a{k})*a{k}, q, 7)" for k in range(6)}
    tables = {"definitions": {"a0": "q*p", **nested}}
    assert answer({"kind": "identity", "lhs": "a6", "rhs": "1"}, {"q": "3", "p": "1/7"}, **tables) == "not shown"


def exact(x: Any) -> Fraction:
    sign, mantissa, exponent, _ = mpmath.mpf(x)._mpf_
    return (-1) ** sign * int(mantissa) * Fraction(2) ** exponent


def some_number(rng: random.Random) -> Fraction:
    digits = 10 ** rng.choice([0, 1, 3, 30])
    x = Fraction(rng.randint(-20 * digits, 20 * digits), rng.randint(1, digits))
    return rng.choice([x, x * 10**25, x / 10**40, 1 + x / 10**30, x - 1, Fraction(round(x), 2)])


@pytest.mark.parametrize("bits", [64, 300])
def test_intervals_hold_what_mpmath_says(bits: int) -> None:
    """Near 0 and far from it, near 1, and near the zeros of sines and cosines."""
    rng, real = random.Random(bits), Arithmetic(bits)
    with mpmath.workprec(1500):
        for _ in range(150):
            x = some_number(rng)
            turns = exact(mpmath.pi * rng.randint(-(10**12), 10**12) / 2) + some_number(rng) / 10**50
            found: list[tuple[Interval, Any]] = []
            for y in (x, Fraction(turns.numerator * 2**200 // turns.denominator, 2**200)):
                z = mpmath.mpf(y.numerator) / y.denominator
                found += [(real.sine((y, y)), mpmath.sin(z)), (real.sine((y, y), 1), mpmath.cos(z))]
                found.append((real.monotone(real.atan, (y, y)), mpmath.atan(z)))
            z = mpmath.mpf(x.numerator) / x.denominator
            found += [(real.monotone(real.exp, (x, x)), mpmath.exp(z))] if abs(x) < 1000 else []
            for f, value in ((real.log, mpmath.log), (real.root, mpmath.sqrt)) if x > 0 else ():
                found.append((real.monotone(f, (x, x)), value(z)))
            for (low, high), value in found:
                middle = exact(value)
                spare = (1 + abs(middle)) / 2**1400
                assert low - spare <= middle <= high + spare
                assert high - low <= (1 + abs(middle)) / 2 ** (bits - 2)


def test_intervals_hold_all_values_of_an_interval() -> None:
    rng, real = random.Random(3), Arithmetic(64)
    for _ in range(150):
        (a, b), wide = (some_number(rng), some_number(rng)), Fraction(rng.randint(0, 99), 10 ** rng.randint(0, 9))
        x, y = (a, a + wide), (b, b + wide * 3)
        s, t = a + wide * rng.randint(0, 8) / 8, b + wide * 3 * rng.randint(0, 8) / 8
        n = rng.randint(0, 7)
        ways = [(real.add(x, y), s + t), (real.times(x, y), s * t), (real.power(x, n), s**n)]
        with mpmath.workprec(300):
            z = mpmath.mpf(s.numerator) / s.denominator
            ways += [(real.sine(x), exact(mpmath.sin(z))), (real.monotone(real.atan, x), exact(mpmath.atan(z)))]
        assert all(low - Fraction(1, 2**200) <= value <= high + Fraction(1, 2**200) for (low, high), value in ways)
        if x[0] <= 0 <= x[1]:
            with pytest.raises(Open):
                real.power(x, -1)
        else:
            low, high = real.power(x, -n)
            assert low <= 1 / s**n <= high


def test_it_needs_nothing_but_python_and_the_other_file(tmp_path: Path) -> None:
    """Copies of both, elsewhere, by a Python that sees no packages; then of those with the table besides."""
    beside = (FILE, Path(alone.__file__))
    for file in beside:
        (tmp_path / file.name).write_bytes(file.read_bytes())
    arc, motion, command = refutation("an arc"), refutation("areas"), [sys.executable, "-ES", FILE.name, "c.json"]
    runs = [
        (arc, 0, "shown"),
        ({**arc, "method": "by hand"}, 1, "wrong"),
        (motion, 2, "not shown"),
        (motion, 0, "shown"),
    ]
    for k, (data, status, word) in enumerate(runs):
        for file in FILE.parent.glob("alone*") if k == 3 else ():
            (tmp_path / file.name).write_bytes(file.read_bytes())
        (tmp_path / "c.json").write_text(json.dumps(data), encoding="utf-8")
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
        assert (done.returncode, done.stderr) == (status, "")
        assert f": {word}" in done.stdout
