"""Certificates through places that a file leaves out, with names that are out of place, and of no algebra's name.

A map's, or a Hamiltonian's, formula with no value at one place of an orbit, a path or a range leaves no claim about all
of it; a name is out of place in a text though it is multiplied by 0 there, or stands behind an abbreviation; and what
names no algebra is no other algebra's name. All but the true ones were confirmed once.
"""

from typing import Any

import pytest

from canon.checker.algebra_names import is_name
from tests.checker.test_forged_files import action, against, group, path
from tests.checker.test_forged_places import MAP, of, status

INVERSE: dict[str, Any] = {"transformation": {"Q": ["1/q"], "P": ["-q**2*p"]}, "phase_space": MAP}
CORNER: dict[str, Any] = {"transformation": {"Q": ["q"], "P": ["p + abs(q)"]}, "phase_space": MAP}
ACROSS: dict[str, Any] = {"kind": "integral", "f": "q", "variable": "q", "from": "-1", "to": "1", "equals": "0",
                          "antiderivative": "q**2/2"}  # fmt: skip
NO_NAMES = ("1001/1000*(so(4))", "", "so(3", "so(4)1", "foo", "so(0)", "heisenberg(0)", "so(99)", "u(1)^0", "usp(3)")


def through(*terms: str) -> dict[str, Any]:
    return action(hamiltonian={"H": " + ".join(["p**2/2 + q**2/2", *terms])})


def heisenberg(name: str) -> dict[str, Any]:
    """Refuted, by structure constants that the claim states."""
    claim = {"kind": "algebra", "basis": {"v": "q", "u": "p", "w": "1"}, "equals": name, "structure": {"v,u": "2*w"}}
    return against(claim, {"q": "1", "p": "1"})


def complete(S: str, **domain: Any) -> dict[str, Any]:
    """A complete integral where H is 0."""
    claim = {"kind": "hamilton_jacobi", "S": S, "constants": ["c"]}
    return of(claim, hamiltonian={"H": "0"}, symbols={"d": "real"}, **domain)


def alone(function: str, **domain: Any) -> dict[str, Any]:
    """An algebra of one function, which is one where that isn't 0 all over the domain, for any d."""
    words = {"d": "real", "n": "integer", "V": "function"}
    return of({"kind": "algebra", "basis": {"A": function}, "structure": {}}, symbols=words, **domain)


def lagrange(L: str, **tables: Any) -> dict[str, Any]:
    claim = {"kind": "euler_lagrange", "L": L, "velocities": ["v"], "accelerations": ["w"], "equations": ["w"]}
    return of(claim, **tables)


FALSE = {
    "an orbit through the map's pole": action(**INVERSE),
    "its frequency": action("frequency", **INVERSE),
    "a path through the map's pole": path("t", "-1", "1", **INVERSE),
    "a path through the map's corner": path("t", "-1", "1", **CORNER),
    "a path through H's pole": path("t", "-1", "1", hamiltonian={"H": "p + 1/q"}),
    "an integral across the map's pole": of(ACROSS, **INVERSE),
    "an integral across H's jump": of(ACROSS, hamiltonian={"H": "p + sign(q)"}),
    "an integral across its own hole": of({**ACROSS, "f": "q*(q/q)"}),
    "an orbit through H's pole": through("1/q", "-1/q"),
    "an integral that isn't complete on q = π/2": complete("c*sin(q)", domain={"on": ["q - d"]}),
    "an integral that isn't complete on q = 0": complete("c*exp(q)*(q - 1)", domain={"on": ["q - d**2"]}),
    "a function that is 0 for large d": alone("abs(q - 10**9) - q + 10**9", domain={"where": ["q > d"]}),
    "one that is 0 for large n": alone("sqrt((q - 3)**2) - q + 3", domain={"where": ["q > n"]}),
    "one that is 0 for some V": alone("sign(q - 5) - 1", domain={"where": ["q > V(p)"]}),
    "one that is 0 where H has values": alone("1 - sign(q)", hamiltonian={"H": "sqrt(q - d)"}),
    "an orbit through poles in q²": through("1/(q**2 - 1/4)", "-1/(q**2 - 1/4)"),
}  # fmt: skip
NO_FILE = {
    "a law with 0*q": group("u + w + 0*q"),
    "a law with {q, q}": group("u + w + bracket(q, q)"),
    "a Lagrangian with 0*p": lagrange("v**2/2 + 0*p"),
    "the same in a definition": lagrange("T", definitions={"T": "v**2/2 + 0*p"}),
    "a Lagrangian with a bracket": lagrange("v**2/2 + 0*bracket(q, q)"),
    "an energy with 0*q": of(
        {"kind": "hamilton_jacobi", "W": "a*q", "constants": ["a"], "energy": "a**2/2 + 0*q"},
        hamiltonian={"H": "p**2/2"}),
    "matrices with 0*t": of({"kind": "matrix_algebra", "basis": {"A": [["0*t", "1"], ["-1", "0"]]}, "equals": "u(1)"}),
    "a dimension with 0*q": of(
        {"kind": "dimension", "functions": ["q"], "dimensions": {"q": "L"}, "equals": "L + 0*q"}),
    "a map with 0*Q in a definition": of(
        {"kind": "canonical"}, transformation={"Q": ["g"], "P": ["p"]}, definitions={"g": "q + 0*Q"}, phase_space=MAP),
    "a tensor's claim with another variable": of(
        {"kind": "casimir", "f": "y + 0*q", "tensor": [["0", "0"], ["0", "0"]], "coordinates": ["x", "y"]}),
}  # fmt: skip
TRUE = {
    "an orbit beside a map": action(transformation={"Q": ["q + p**3"], "P": ["p"]}, phase_space=MAP),
    "a path beside the map's pole": path("1 + t", **INVERSE),
    "an integral beside the map's pole": of({**ACROSS, "from": "1", "to": "3", "equals": "4"}, **INVERSE),
    "an integral that is complete nearly everywhere": complete("c*sin(q)", domain={"where": ["q > d"]}),
    "a function in a domain of its own": alone("abs(q) - q", domain={"where": ["q < 1", "d > 0"]}),
    "an analytic function": alone("q*exp(q)", domain={"where": ["q > d"]}),
    "a law in time": group("u + w + 0*t"),
    "a Lagrangian": lagrange("v**2/2 + 0*q"),
    "structure constants of a refuted name": heisenberg("so(3)"),
    "a wall where a condition has a name's sign": action(
        "action", hamiltonian={"H": "p**2/2 + q**2/2 + 0*log(k)"}, symbols={"k": "positive"}),
}  # fmt: skip


@pytest.mark.parametrize("name", sorted(FALSE))
def test_what_goes_through_a_place_that_the_file_leaves_out_is_not_confirmed(name: str) -> None:
    assert status(FALSE[name]) != "confirmed", name


@pytest.mark.parametrize("name", sorted(NO_FILE))
def test_a_name_out_of_place_is_unreadable_whatever_it_is_multiplied_by(name: str) -> None:
    assert status(NO_FILE[name]) == "unreadable", name


@pytest.mark.parametrize("name", NO_NAMES)
def test_what_names_no_algebra_is_unreadable(name: str) -> None:
    assert not is_name(name)
    assert status(heisenberg(name)) == "unreadable"


@pytest.mark.parametrize("name", sorted(TRUE))
def test_what_holds_beside_is_confirmed(name: str) -> None:
    assert status(TRUE[name]) == "confirmed", name


@pytest.mark.parametrize(
    "name", ["so(4)", "SO(3,1)", "so*(6)", "sl(2,C) + u(1)^3", "sp(4)", "Poincaré", "h(2)", "gl(2,R)"]
)
def test_names_of_algebras_are_read(name: str) -> None:
    assert is_name(name)
