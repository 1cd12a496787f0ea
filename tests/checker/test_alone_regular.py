"""What isn't 0, in one small file: independent functions and Hessians, and functions that depend on each other."""

from typing import Any

import pytest

from canon.checker import alone_regular, alone_together
from tests.checker.certified import certified, resealed

SPACE: Any = {"phase_space": {"q": ["x", "y"], "p": ["px", "py"]}}
NAMES = {"m": "positive", "k": "real", "c": "nonzero", "V": "function", "N": ["function", "positive"]}
ZERO = {"numerator": {}, "denominator": {"": "1"}, "cofactors": {}}


def answer(claim: Any, residuals: int = 0, **sections: Any) -> str:
    """The answer about a claim with a certificate that says of each residual that it is 0."""
    tables = {**SPACE, "symbols": NAMES, "claim": claim, **sections}
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None}
    return alone_regular.checked(resealed({**data, "cases": [{"kernels": [], "residuals": [ZERO] * residuals}]}))[0]


def independent(*functions: str, **sections: Any) -> str:
    return answer({"kind": "independent", "functions": [*functions]}, **sections)


@pytest.mark.parametrize("functions", [
    ["x"], ["x", "y", "px", "py"], ["px**2/(2*m) + V(x)", "py"], ["x*py - y*px", "x**2 + y**2"], ["c*x", "y/m"],
    ["exp(x - y)", "px"], ["sin(x)", "cos(y)"], ["x - px*t/m", "y - py*t/m", "px", "py"], ["x + V(y)", "y"],
    ["cos(t)*x + sin(t)*px", "cos(t)*px - sin(t)*x"], ["sqrt(x**2 + 1)", "y"], ["k*x + y", "x"],
])  # fmt: skip
def test_functions_are_independent(functions: Any) -> None:
    assert independent(*functions) == "shown"


@pytest.mark.parametrize("functions", [
    ["1"], ["x", "2*x"], ["x", "y", "x*y"], ["k*x"], ["t*x"], ["V(x)"], ["x + y", "V(x + y)"], ["V(x)", "y"],
    ["sqrt(x**2) + x"], ["asin(sin(x)) - x"], ["x", "y", "px", "py", "x + y"], ["(k - 1)*x + y", "y"], ["0*x"],
    ["sin(x)**2 + cos(x)**2", "y"], ["c*x", "(c - 1)*x + (c - 1)*y"], ["exp(x)*exp(-x)"], ["m"], ["t"],
    ["x", "x + sqrt((y + px)**2) - y - px"], ["log(exp(x)) - x"], ["x + exp(1/(x + 1)) - exp(1/(1 + x))", "x"],
    ["1j*x"], [],
])  # fmt: skip
def test_functions_that_depend_arent_shown(functions: Any) -> None:
    assert independent(*functions) == "not shown"


def test_independence_beside_other_sections() -> None:
    back = {"phase_space": {"q": ["x"], "p": ["px"], "Q": ["X"], "P": ["PX"]}}
    assert independent("x", "px", **back, transformation={"q": ["X"], "p": ["X"]}) == "not shown"
    assert independent("x", "px", **back, transformation={"Q": ["x"], "P": ["px"]}) == "shown"
    assert independent("X", "px", **back, transformation={"Q": ["x"], "P": ["px"]}) == "not shown"
    assert independent("x", domain={"on": ["x - 1"]}) == "not shown"
    assert independent("x", definitions={"x": "1"}) == "not shown"
    assert independent("n*x", symbols={"n": "integer"}) == "not shown"
    claim = {"kind": "independent", "functions": ["x"], "structure": {"x,y": "x"}}
    assert answer(claim) == "not shown"


EQUATION = {"kind": "euler_lagrange", "velocities": ["u", "v"], "qddot": ["0", "0"]}


@pytest.mark.parametrize("L", [
    "m*(u**2 + v**2)/2", "-m*(u**2 + v**2)/2", "m*u*v", "N(t)/N(t)*u*v", "sqrt(1 + u**2 + v**2)", "exp(u) + exp(v)",
    "u**2/m + (m + k**2)*v**2", "(2 + cos(k))*(u**2 + v**2)",
])  # fmt: skip
def test_a_hessian_without_a_zero(L: str) -> None:
    assert answer({**EQUATION, "L": L}, 2) == "shown"


@pytest.mark.parametrize("L", [
    "u", "u + v", "u**2", "(u + v)**2", "k*(u**2 + v**2)", "(1 + cos(k))*(u**2 + v**2)", "(k - 1)**2*(u**2 + v**2)",
    "V(t)*(u**2 + v**2)", "u**2 + v**2 - x", "u**3 + v**3", "sqrt(u**2 + v**2)", "0*u*v",
])  # fmt: skip
def test_a_hessian_that_may_be_0_isnt_shown(L: str) -> None:
    assert answer({**EQUATION, "L": L}, 2) == "not shown"


def test_six_velocities() -> None:
    q, p, v = ([f"{a}{k}" for k in range(6)] for a in "qpv")
    tables: Any = {"phase_space": {"q": q, "p": p}, "claim": {**EQUATION, "velocities": v, "qddot": ["0"] * 6}}
    L = " + ".join(f"{name}**2" for name in v)
    one = lambda L: answer({**tables["claim"], "L": L}, 6, phase_space=tables["phase_space"])
    assert (one(f"{L} - v5**2"), one(L.replace("v5**2", "v5*v4"))) == ("not shown", "shown")


def test_legendres_transform() -> None:
    claim = {"kind": "legendre", "L": "N(x)*(u**2 + v**2)/2 - V(x)", "velocities": ["u", "v"]}
    assert answer(claim, 1, hamiltonian={"H": "(px**2 + py**2)/(2*N(x)) + V(x)"}) == "shown"
    assert answer(claim, 1, hamiltonian={"H": "(px**2 + py**2)/(2*N(x)) - V(x)"}) == "not shown"
    assert (
        answer({**claim, "L": "V(x)*(u**2 + v**2)/2"}, 1, hamiltonian={"H": "(px**2 + py**2)/(2*V(x))"}) == "not shown"
    )


def test_it_is_asked_of_a_certificate() -> None:
    file = '[phase_space]\nq = ["q"]\np = ["p"]\n[symbols]\nV = "function"\n'
    data = certified(file, 'kind = "independent"\nfunctions = ["p**2 + V(q)", "q"]')
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["claim"]["functions"] = ["p**2 + V(q)", "V(q) + p**2"]
    assert alone_together.checked(resealed(data))[0] == "not shown"
