"""Certificates of false claims, and of claims that no file could state: none is confirmed.

What they show is right, as far as it goes: they lie in what a claim means, in where a formula is real, in what a point
has to do with what is claimed. Each was confirmed by an earlier checker.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import pytest

from canon.checker.check import check
from canon.checker.functions import Unreadable
from tests.checker.test_forgeries import forged, kernel, sealed

MAPPED = {"q": ["x"], "p": ["p"], "Q": ["X"], "P": ["Y"]}
IDENTITY = {"Q": ["x"], "P": ["p"]}
CONSTANT = {"Q": ["1"], "P": ["2"]}
ROOT = kernel("g1", "(x+1)**(1/2)", {"g1^2": "1", "x": "-1", "": "-1"}, "pos")
ROOTED = "(((x+1)**2)**(1/2))"
ARCSINE = kernel("g1", "cos(asin(x))", {"g1^2": "1", "x^2": "1", "": "-1"}, "pos")
ONE, BARE = {"": "1"}, {"q": ["q"], "p": ["p"]}
ZERO = {"numerator": {}, "denominator": ONE, "cofactors": {}}


def of(
    claim: Mapping[str, Any],
    zeros: int = 1,
    *,
    kernels: Sequence[Any] = (),
    atoms: Mapping[str, Any] | None = None,
    known: Mapping[str, str] | None = None,
    cases: int = 1,
    **tables: Any,
) -> dict[str, Any]:
    """A certificate that so many residuals are 0/1."""
    data = forged("0")
    own = {"phase_space": MAPPED if "transformation" in tables else {"q": ["x"], "p": ["p"]}, "claim": claim}
    shown = [{"kernels": list(kernels), "atoms": atoms or {}, "residuals": [ZERO] * zeros}]
    rest = [{"kernels": [], "atoms": {}, "residuals": []}] * (cases - 1)
    return sealed({**data, "tables": {**own, **tables}, "known": known or {}, "cases": shown + rest})


def against(data: dict[str, Any], **witness: str) -> dict[str, Any]:
    """A refutation by a point."""
    return sealed({**data, "verdict": "refuted", "witness": witness, "cases": []})


UNREAL = {
    "a root as a kernel": forged("sqrt((x + 1)**2)", "x + 1", kernels=(ROOT,),
        atoms={ROOTED: [{"x": "1", "": "1"}, ONE]}),
    "a root's even power": forged("sqrt((x + 1)**2)", "x + 1", kernels=(ROOT,), atoms={ROOTED: [{"g1^2": "1"}, ONE]},
        residual={"numerator": {"g1^2": "1", "x": "-1", "": "-1"}, "denominator": ONE, "cofactors": {"g1": ONE}}),
    "an arcsine as a kernel": forged("abs(1 - x**2)", "1 - x**2", kernels=(ARCSINE,),
        atoms={"abs((1+(-1*(x**2))))": [{"x^2": "-1", "": "1"}, ONE]}),
    "an antiderivative with a root": of(
        {"kind": "integral", "f": "sqrt((x+1)**2)", "variable": "u", "from": "0", "to": "1", "equals": "x+1"}, 2,
        known={"antiderivative": "u*sqrt((x+1)**2) + sqrt(x+1) - sqrt(x+1)"}, kernels=(ROOT,), symbols={"x": "real"},
        atoms={"((x+1)**(1/2))": [{"g1": "1"}, ONE], ROOTED: [{"x": "1", "": "1"}, ONE]}, phase_space=BARE),
}  # fmt: skip
MEANT = {
    "an average that depends on its parameter": of({"kind": "average", "f": "x", "equals": "u/2", "parameter": "u",
        "from": "0", "to": "1", "motion": {"x": "u", "p": "0", "t": "u"}, "antiderivative": "u**2/2"}, 2),
    "an action where a positive name is fixed at −1": of({"kind": "action", "coordinate": "x", "energy": "E",
        "equals": "2*pi*E", "fixed": {"k": "-1"}}, 0, symbols={"k": "positive"},
        hamiltonian={"H": "p**2/2 + (sqrt(k**2) - k + 1)*x**2/2"}),
    "a scale of 0": of({"kind": "canonical", "scale": "0"}, transformation=CONSTANT),
    "a scale that varies": of({"kind": "canonical", "scale": "x"}, transformation={"Q": ["x**2/2"], "P": ["p"]}),
    "a map to a point": of({"kind": "new_hamiltonian", "K": "X"}, 6, transformation=CONSTANT, hamiltonian={"H": "p"}),
    "no map": of({"kind": "canonical"}),
    "an order in a coordinate": of({"kind": "canonical", "order": ["x", 0]},
        transformation={"Q": ["x + x**2"], "P": ["p"]}),
    "an invariant beyond the last": of({"kind": "integral_invariant", "order": 2}, 0,
        transformation={"Q": ["2*x"], "P": ["p"]}),
    "an invariant before the first": of({"kind": "integral_invariant", "order": 0},
        transformation={"Q": ["2*x"], "P": ["p"]}),
    "a generating function of its own map": of({"kind": "generates"}, 2, phase_space=MAPPED,
        generating_function={"type": 2, "F": "x*Y + x**3"}),
    "K in old variables": of({"kind": "new_hamiltonian", "K": "p**2/2"}, 6, hamiltonian={"H": "p**2/2"},
        transformation={"Q": ["x"], "P": ["p + x"]}),
    "a bracket of new variables": of({"kind": "bracket", "f": "X", "g": "p", "equals": "0"}, transformation=IDENTITY),
    "a bracket in K": of({"kind": "new_hamiltonian", "K": "bracket(X, Y)"}, 6, hamiltonian={"H": "0"},
        transformation=IDENTITY),
    "H in new variables": of({"kind": "conserved", "f": "p"}, transformation=IDENTITY, hamiltonian={"H": "X**2"}),
    "solutions in a coordinate": of({"kind": "canonical_when", "solutions": [{"x": "0"}]}, cases=2,
        transformation={"Q": ["x + x**2"], "P": ["p"]}),
    "an integral's constant that moves": of({"kind": "hamilton_jacobi", "W": "x**3/3", "energy": "1/2",
        "constants": ["x"]}, hamiltonian={"H": "p**2/2 - x**4/2 + 1/2"}),
    "a generator with the series' parameter": of({"kind": "lie_series", "generator": "s*p", "parameter": "s", "f": "x",
        "equals": "x + s**2/2"}, 2, symbols={"s": "real"}),
    "an average over no time": of({"kind": "average", "f": "0", "equals": "7", "parameter": "u", "from": "0", "to": "0",
        "motion": {"t": "u", "x": "u", "p": "1"}, "antiderivative": "0"}, 4, hamiltonian={"H": "p**2/2"}),
    "a velocity that is a momentum": of({"kind": "euler_lagrange", "L": "p**2/2", "velocities": ["p"],
        "accelerations": ["a"], "equations": ["a"]}),
    "a bracket of new variables in an identity": of({"kind": "identity", "lhs": "bracket(X, Y)", "rhs": "0"},
        transformation=IDENTITY),
    "a bracket of old and new variables": of({"kind": "identity", "lhs": "bracket(x, x*X)", "rhs": "0"},
        transformation=IDENTITY),
    "a derivative of a new variable by an old one": of({"kind": "identity", "lhs": "D(X, x)", "rhs": "0"},
        transformation=IDENTITY),
    "a derivative of an old variable by a new one": of({"kind": "identity", "lhs": "X + D(sin(x), X)", "rhs": "X"},
        transformation=IDENTITY),
    "a derivative of a solution by what else it depends on": of(
        {"kind": "solves", "solution": {"f(t)": "a*cos(t)"}, "equations": ["D(f(t), a)"]},
        symbols={"a": "real", "f": "function"}),
    "the same by an abbreviation": of(
        {"kind": "solves", "solution": {"f(t)": "x*cos(t)"}, "equations": ["g + 0*f(t)"]},
        definitions={"g": "bracket(p, f(t))"}, symbols={"f": "function"}),
    "a dimension of pi": of({"kind": "dimension", "functions": ["pi"], "dimensions": {"pi": "L"}, "equals": "L"}, 0),
    "a derivative beyond the twentieth": forged("D(x**20, x, 21)", "2432902008176640000"),
    "a derivative by a number": forged("D(x**3, 2)"),
    "a derivative by a product": forged("D(x**3*p, x*p)"),
    "half a derivative": forged("D(x**3, x, 1/2)", "x**3"),
    "one argument too many": forged("sin(x, p)", "sin(x, p)"),
    "a comment": forged("x # + 1", "x"),
    "two letters that look alike": forged("\u00b5 - \u03bc", symbols={"\u00b5": "real", "\u03bc": "real"}),
    "a coordinate twice": of({"kind": "bracket", "f": "x", "g": "p", "equals": "2"},
        phase_space={"q": ["x", "x"], "p": ["p", "p"]}),
    "a coordinate defined as another": of({"kind": "identity", "lhs": "x", "rhs": "p"}, definitions={"x": "p"}),
    "a condition that says nothing": forged("0", domain={"where": ["x"]}),
    "an assumption that says nothing": forged("0", symbols={"a": "positiv"}),
    "pi as a name": forged("sqrt(pi**2)", "pi", symbols={"pi": "real"}, domain={"where": ["pi > -1/10**30"]},
        atoms={"((pi**2)**(1/2))": [{"pi": "1"}, ONE]}),
    "orbits of which the domain has a half": of({"kind": "action", "coordinate": "q", "energy": "E",
        "equals": "2*pi*E"}, 2, phase_space=BARE, symbols={"E": "positive"}, domain={"where": ["p > 0"]},
        hamiltonian={"H": "p**2/2 + q**2/2"}),
    "orbits with positive momenta": of({"kind": "action", "coordinate": "q", "energy": "E", "equals": "2*pi*E"}, 2,
        phase_space=BARE, symbols={"E": "positive", "p": "positive"}, hamiltonian={"H": "p**2/2 + q**2/2"}),
    "an integral that runs downwards through a pole": of({"kind": "integral", "f": "1/u**2", "variable": "u",
        "from": "1", "to": "-infinity", "equals": "1"}, 2, known={"antiderivative": "-1/u"}, phase_space=BARE),
    "a limit from where an arcsine isn't real": of({"kind": "limit", "f": "asin(u)", "variable": "u", "to": "1",
        "side": "+", "equals": "pi/2"}, phase_space=BARE),
    "a limit from both sides of an arccosine's end": of({"kind": "limit", "f": "acos(u)", "variable": "u",
        "to": "1", "equals": "0"}, 2, phase_space=BARE),
    "a mass as a constant of integration": of({"kind": "hamilton_jacobi", "W": "(2*m)**(1/2)*x", "constants": ["m"],
        "energy": "1"}, symbols={"m": "positive"}, hamiltonian={"H": "p**2/(2*m)"}),
    "a velocity in H": of({"kind": "legendre", "L": "v**2/2", "velocities": ["v"]}, hamiltonian={"H": "p*v/2"}),
    "an acceleration in L": of({"kind": "euler_lagrange", "L": "v**2/2 + x*a", "velocities": ["v"],
        "accelerations": ["a"], "equations": ["0"]}),
    "a momentum in L": of({"kind": "euler_lagrange", "L": "v**2/2 + p*x", "velocities": ["v"],
        "accelerations": ["a"], "equations": ["a - p"]}),
    "an acceleration in Noether's L": of({"kind": "noether", "L": "v**2/2 + x*a", "velocities": ["v"],
        "accelerations": ["a"], "dq": ["0"]}),
    "a momentum in Noether's L": of({"kind": "noether", "L": "v**2/2 + p*v", "velocities": ["v"], "dq": ["1"],
        "charge": "v + p"}, 2),
    "a bracket of integers": of({"kind": "jacobi", "f": "a", "g": "b", "h": "c",
        "structure": {"a,b": "c", "b,c": "a", "c,a": "b"}}, symbols={"a": "integer", "b": "real", "c": "real"}),
    "a time of integers": of({"kind": "conserved", "f": "x - t"}, symbols={"t": "integer"}, hamiltonian={"H": "p"}),
    "the imaginary unit as a name": against(forged("1j**2", "-1", symbols={"1j": "real"}), **{"1j": "2"}),
}  # fmt: skip
SPIKE = "10**40/(1 + (10**40*(u - 1/3))**2)/(atan(2*10**40/3) + atan(10**40/3))"
TRUE = {
    "an integral of a spike": against(of({"kind": "integral", "f": SPIKE, "variable": "u", "from": "0", "to": "1",
        "equals": "1"}, 0, phase_space=BARE), q="1", p="1"),
    "a limit that is late": against(of({"kind": "limit", "f": "u/(u + 1/2**200) + u", "variable": "u", "to": "0",
        "side": "+", "equals": "0"}, 0, phase_space=BARE), q="1", p="1"),
    "an average by a virial that is none": against(of({"kind": "average", "f": "x**2", "equals": "(x**2 + p**2)/2",
        "virial": "0", "bound": "1"}, 0, hamiltonian={"H": "(x**2 + p**2)/2"}), x="1", p="3"),
    "an average where motions end": against(of({"kind": "average", "f": "1", "equals": "2", "virial": "0",
        "bound": "0"}, 0, hamiltonian={"H": "p**2/2 - exp(x)"}, domain={"where": ["p**2/2 < exp(x)"]}), x="1", p="1"),
    "an action with a name that is fixed": against(of({"kind": "action", "coordinate": "x", "energy": "E",
        "equals": "2*pi*E/sqrt(k)", "fixed": {"k": "4"}}, 0, symbols={"k": "positive"},
        hamiltonian={"H": "p**2/2 + k*x**2/2"}), E="1", k="9"),
    "a positive function that is negative": against(
        forged("sqrt(V(x)**2)", "V(x)", symbols={"V": ["function", "positive"]}), x="1", p="1", V="-1"),
    "functions that are independent outside": against(of({"kind": "algebra", "basis": {"A": "p", "B": "(x - 1)**2/2",
        "C": "abs(x - 1)", "D": "1"}, "structure": {"B,A": "C", "C,A": "D"}}, 0, domain={"where": ["x > 1"]}),
        x="101/100", p="1"),
    "a length that is cut off": against(of({"kind": "dimension", "functions": ["x*sign(x - 1)"], "equals": "L",
        "dimensions": {"x": "L"}}, 0, domain={"where": ["x > 1"]}), x="101/100", p="1"),
}  # fmt: skip


THROUGH_POLES = {
    "motions that all leave": of({"kind": "average", "f": "1", "equals": "0", "virial": "x", "bound": "1"}, 3,
        hamiltonian={"H": "p"}, domain={"where": ["-1 < x", "x < 1"]}),
    "a path": of({"kind": "stationary", "L": "v**2/2 + x**4/2", "velocities": ["v"], "path": ["1/t"], "from": "-1",
        "to": "1"}),
    "a motion": of({"kind": "average", "f": "1", "equals": "1", "parameter": "u", "from": "-1", "to": "1",
        "motion": {"x": "1/u", "p": "0", "t": "u"}, "antiderivative": "u"}, 2),
}  # fmt: skip


def status(data: Any) -> str:
    try:
        return check(data).status
    except Unreadable:
        return "unreadable"


def resealed_status(data: dict[str, Any]) -> str:
    """The answer once the checksum is right again."""
    return status(sealed(data))


@pytest.mark.parametrize("name", sorted(UNREAL))
def test_a_kernel_says_nothing_of_where_it_isnt_real(name: str) -> None:
    answer = check(UNREAL[name])
    assert answer.status == "confirmed in part"
    assert "is real throughout the domain" in str(answer)


@pytest.mark.parametrize("name", sorted(THROUGH_POLES))
def test_what_has_a_pole_on_its_way_is_not_confirmed(name: str) -> None:
    assert status(THROUGH_POLES[name]) == "confirmed in part", name


@pytest.mark.parametrize("name", sorted(MEANT))
def test_no_claim_that_a_file_could_not_state(name: str) -> None:
    assert status(MEANT[name]) in ("unreadable", "rejected", "not confirmed"), name


@pytest.mark.parametrize("name", sorted(TRUE))
def test_no_refutation_of_what_is_true(name: str) -> None:
    assert status(TRUE[name]) != "confirmed", name


def test_a_length_beside_a_fixed_one_is_none() -> None:
    """The point says by what factor the units grow."""
    claim = {"kind": "dimension", "functions": ["x*sign(x - 1)"], "dimensions": {"x": "L"}, "equals": "L"}
    assert status(against(of(claim, 0), **{"x": "1/2", "p": "1", "#L": "4"})) == "confirmed"
    assert status(against(of(claim, 0), **{"x": "2", "p": "1", "#L": "4"})) == "rejected"


def test_a_kernel_that_is_real_is_confirmed() -> None:
    """The claim's own root, and one of a number that is positive."""
    relation = {"numerator": {"g1^2": "1", "x": "-1", "": "-1"}, "denominator": ONE, "cofactors": {"g1": ONE}}
    own = forged(
        "sqrt(x + 1)**2", "x + 1", kernels=(ROOT,), residual=relation, atoms={"((x+1)**(1/2))": [{"g1": "1"}, ONE]}
    )
    assert str(check(own)) == "confirmed"
