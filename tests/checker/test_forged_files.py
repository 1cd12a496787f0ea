"""Certificates of claims that the rest of their file makes others than they look.

H, the map and a generating function bound the domain of every claim of a file, used or not; old variables that a map
gives by others stay in its image; a file that calls a coordinate t has no time; qⁿ has a value for a negative q; and
the edges of a domain are none of its points.
Each of `FALSE` was confirmed by an earlier checker.
"""

from typing import Any

import pytest

from tests.checker.test_forged_places import MAP, of, status
from tests.checker.test_forgeries import kernel, sealed

OSCILLATOR: dict[str, Any] = {"H": "p**2/2 + q**2/2"}
GIVEN: dict[str, Any] = {"transformation": {"q": ["exp(Q)"], "p": ["P*exp(-Q)"]}, "phase_space": MAP}
GENERATED: dict[str, Any] = {"generating_function": {"type": 2, "F": "log(q)*P"}, "phase_space": MAP}
LOGARITHM: dict[str, Any] = {"transformation": {"Q": ["log(q)"], "P": ["q*p"]}, "phase_space": MAP}
POSITIVE: dict[str, Any] = {"transformation": {"Q": ["q"], "P": ["p"]}, "phase_space": MAP}
ROOT: dict[str, Any] = {"hamiltonian": {"H": "sqrt(u)*p"}, "symbols": {"u": "real"}}
PULLED: dict[str, Any] = {
    "transformation": {"Q": ["sqrt(u)*q"], "P": ["p/sqrt(u)"]},
    "phase_space": MAP,
    "symbols": {"u": "real"},
}


def against(claim: dict[str, Any], witness: dict[str, str], known: Any = None, **tables: Any) -> dict[str, Any]:
    """A refutation by a point."""
    data = of(claim, **tables)
    return sealed({**data, "verdict": "refuted", "witness": witness, "cases": [], "known": known or {}})


def action(kind: str = "action", **tables: Any) -> dict[str, Any]:
    tables = {"hamiltonian": OSCILLATOR, **tables, "symbols": {"E": "positive", **tables.get("symbols", {})}}
    value = "2*pi*E" if kind == "action" else "1/(2*pi)"
    return of({"kind": kind, "coordinate": "q", "energy": "E", "equals": value}, **tables)


def path(text: str, start: str = "0", end: str = "1", **tables: Any) -> dict[str, Any]:
    claim = {"kind": "stationary", "L": "v**2/2", "velocities": ["v"], "path": [text], "from": start, "to": end}
    return of(claim, **tables)


def limit(to: str, **tables: Any) -> dict[str, Any]:
    return of({"kind": "limit", "f": "u", "variable": "u", "to": to, "equals": to}, **tables)


def integral(start: str, end: str, value: str, **tables: Any) -> dict[str, Any]:
    ends = {"from": start, "to": end, "equals": value, "antiderivative": "u**2/2"}
    return of({"kind": "integral", "f": "u", "variable": "u", **ends}, **tables)


def normal(**tables: Any) -> dict[str, Any]:
    H = {"H": "p**2/2 + q**2/2 + q**3"}
    return of({"kind": "normal_form", "order": 3, "N": {"3": "0"}}, hamiltonian=H, **tables)


def series(**tables: Any) -> dict[str, Any]:
    return of({"kind": "lie_series", "generator": "p", "parameter": "u", "f": "q", "equals": "q + u"}, **tables)


def group(law: str, **tables: Any) -> dict[str, Any]:
    return of({"kind": "group", "first": ["u"], "second": ["w"], "composition": [law], "structure": {}}, **tables)


def motion(L: str, equation: str, witness: dict[str, str], **tables: Any) -> dict[str, Any]:
    claim = {"kind": "euler_lagrange", "L": L, "velocities": ["v"], "accelerations": ["w"], "equations": [equation]}
    return against(claim, witness, **tables)


def average(start: str, end: str, moved: dict[str, str], f: str = "1", **tables: Any) -> dict[str, Any]:
    ends = {"parameter": "u", "from": start, "to": end, "antiderivative": "u"}
    return of({"kind": "average", "f": f, "equals": f, "motion": moved, **ends}, **tables)


def power(a: str) -> dict[str, Any]:
    """|qⁿ| = qⁿ, with √(qⁿ) for a kernel."""
    data = of({"kind": "identity", "lhs": f"abs({a})", "rhs": a}, symbols={"n": "integer"})
    kernels = [kernel("h", a), kernel("g", f"sqrt({a})", {"g^2": "1", "h": "-1"}, "nonneg")]
    atoms = {f"abs(({a}))": [{"g^2": "1"}, {"": "1"}], f"({a})": [{"h": "1"}, {"": "1"}]}
    residual = {"numerator": {"g^2": "1", "h": "-1"}, "denominator": {"": "1"}, "cofactors": {"g": {"": "1"}}}
    return sealed({**data, "cases": [{"kernels": kernels, "atoms": atoms, "residuals": [residual]}]})


def conserved(q: str, p: str, H: str) -> dict[str, Any]:
    return of({"kind": "conserved", "f": "t"}, phase_space={"q": [q], "p": [p]}, hamiltonian={"H": H})


def length(f: str, **tables: Any) -> dict[str, Any]:
    claim = {"kind": "dimension", "functions": [f], "dimensions": {"q": "L"}, "equals": "L"}
    return against(claim, {"q": "2", "p": "1", "#L": "1/4"}, **tables)


def characteristic(W: str, energy: str, H: str) -> dict[str, Any]:
    claim = {"kind": "hamilton_jacobi", "W": W, "constants": ["a"], "energy": energy}
    return of(claim, hamiltonian={"H": H}, symbols={"a": "positive"})


def edge(hidden: str, said: str = "q") -> dict[str, Any]:
    """q < 1, refuted at 1, where a function that stands in the text, or in H, has its edge."""
    H = {"hamiltonian": {"H": hidden}} if said == "q" else {}
    return against({"kind": "inequality", "lhs": said, "relation": "<", "rhs": "1"}, {"q": "1", "p": "1/2"}, **H)


FOUR = [[f"{side}{k}" for k in range(4)] for side in "qpQP"]
CIRCLE = {"q": "cos(u)", "p": "-sin(u)", "t": "u"}
HEISENBERG = {"kind": "algebra", "basis": {"v": "q", "u": "p", "w": "1"}, "equals": "heisenberg(1)"}
FREE: dict[str, Any] = {"phase_space": {"q": ["x", "y"], "p": ["c", "d"]}}
UNDETERMINED = {"kind": "constraint", "velocities": ["v", "w"], "functions": ["x"], "L": "v**2/2 + x*w**2/2"}
AT_REST = {"kind": "constraint", "velocities": ["v", "w"], "forms": ["v"], "L": "v*w**2/2", "determined": False}

FALSE = {
    "an orbit through a logarithm of the map's": action(**LOGARITHM),
    "its frequency": action("frequency", **LOGARITHM),
    "an orbit beside what is assumed of the map": action(**POSITIVE, symbols={"Q": "positive"}),
    "an orbit that leaves the image": action(**GIVEN),
    "an orbit that leaves a generated image": action(**GENERATED),
    "a path through a logarithm of the map's": path("-1 - t", **LOGARITHM),
    "a path beside what is assumed of the map": path("-1 - t", **POSITIVE, symbols={"Q": "positive"}),
    "a path that leaves the image": path("-1 - t", **GIVEN),
    "a path through H's root": path("-1 - t", hamiltonian={"H": "sqrt(q)*p"}),
    "a path from 1 down to 0": path("t", "1", "0"),
    "a path from an infinity downwards": path("t", "infinity", "-infinity"),
    "a limit where H has no value": limit("-1", **ROOT),
    "a limit where the map has none": limit("0", **PULLED),
    "an integral where H has no value": integral("-1", "1", "0", **ROOT),
    "an integral where the map has none": integral("-1", "1", "0", **PULLED),
    "an integral downwards, for a < 0": integral("0", "a", "a**2/2", symbols={"a": "real"}),
    "a refuted integral downwards": against(
        {"kind": "integral", "f": "u", "variable": "u", "from": "1", "to": "0", "equals": "1/2",
         "antiderivative": "u**2/2"}, {"q": "1"}),
    "an infinity from a side": of(
        {"kind": "limit", "f": "1/u", "variable": "u", "to": "infinity", "side": "-", "equals": "0"}),
    "an origin beyond the map's logarithm": normal(**LOGARITHM),
    "an origin beyond the image": normal(**GIVEN),
    "a germ at the end of H's root": series(**ROOT),
    "a germ beside what is assumed of the map": series(
        transformation={"Q": ["u"], "P": ["p"]}, phase_space=MAP, symbols={"u": "real", "Q": "positive"}),
    "a unit at the end of H's root": group("u + w", **ROOT),
    "a unit that is none": group("u + w", symbols={"u": "positive"}),
    "a law in time": of({"kind": "group", "first": ["t"], "second": ["w"], "composition": ["t + w"], "structure": {}}),
    "a law refuted far from its unit": against(
        {"kind": "group", "first": ["u"], "second": ["w"], "composition": ["u + w + sqrt((u - 5)**2) + u - 5"],
         "structure": {}}, {"u": "6", "w": "1"}),
    "an acceleration refuted beside the image": motion(
        "v**2/2 - abs(q)", "w + 1", {"q": "-1", "v": "1", "w": "1"}, **GIVEN),
    "the same beside a generated image": motion(
        "v**2/2 - abs(q)", "w + 1", {"q": "-1", "v": "1", "w": "1"}, phase_space=MAP,
        generating_function={"type": 3, "F": "-p*exp(Q)"}),
    "an integral refuted beside the image": against(
        {"kind": "integral", "f": "abs(q)*u", "variable": "u", "from": "0", "to": "1", "equals": "q/2"},
        {"q": "-1", "p": "1", "Q": "1", "P": "1"}, **GIVEN),
    "a length refuted where H has no value": length("q*sign(q - 1)", hamiltonian={"H": "sqrt(q - 1)*p"}),
    "a length refuted where it has no value": length("q*sign(q - 1) + 0*sqrt(q - 1)"),
    "a new Hamiltonian refuted where F has no value": against(
        {"kind": "new_hamiltonian", "K": "Q - 2/P"}, {"q": "-1", "P": "2"}, phase_space=MAP,
        generating_function={"type": 2, "F": "q*P + log(q) - log(q)"}, hamiltonian={"H": "abs(q) - 2/p"}),
    "a new Hamiltonian refuted where F makes no map": against(
        {"kind": "new_hamiltonian", "K": "P**2/2 + Q"}, {"q": "-1", "P": "2"}, phase_space=MAP,
        generating_function={"type": 2, "F": "(abs(q) + q)*P/2"}, hamiltonian={"H": "p**2/2 + q"}),
    "a new variable without a map": of(
        {"kind": "identity", "lhs": "sqrt(Q**2)", "rhs": "Q"}, phase_space=MAP, symbols={"Q": "positive"}),
    "undetermined motions, beside the constraint": against(
        {**UNDETERMINED, "determined": False}, {"x": "1", "y": "1", "v": "1", "w": "1"}, **FREE),
    "undetermined motions, beside the velocities that are allowed": of(AT_REST | {"forms": ["v - 1"]}, **FREE),
    "a constraint that nothing keeps": of(
        {"kind": "constraint", "velocities": ["v", "w"], "functions": ["x**2 + 1"], "holonomic": True}, **FREE),
    "velocities of one coordinate of two": of(
        {"kind": "constraint", "velocities": ["v", "w"], "forms": ["w"], "possible": ["5"]}, **FREE),
    "constants that are the certificate's alone": against(
        HEISENBERG, {"q": "1", "p": "1"}, known={"structure": {"v,u": "2*w"}}),
    "an arcsine's edge": edge("asin(q)"),
    "the same, times 0": edge("", "q + 0*acos(-q)"),
    "the edge of an inverse cosine": edge("acosh(1/q)"),
    "the edge of an elliptic integral": edge("elliptic_e(q)"),
    "a range beyond a root, beside a complex name": of(
        {"kind": "integral", "f": "u + 0*sqrt(u)", "variable": "u", "from": "-1", "to": "1", "equals": "0",
         "antiderivative": "u**2/2"}, symbols={"z": "complex"}, definitions={"D0": "z"}),
    "a coordinate t": conserved("t", "e", "-e"),
    "a momentum t": conserved("x", "t", "x"),
    "an action of time and coordinate": of(
        {"kind": "hamilton_jacobi", "S": "a*t", "constants": ["a"]}, hamiltonian={"H": "-e"},
        phase_space={"q": ["t"], "p": ["e"]}),
    "an even power that isn't": power("q**n"),
    "W with time": characteristic("sqrt(2*a)*q + t", "a", "p**2/2"),
    "an energy that is a coordinate": characteristic("a*q", "q", "q"),
    "an energy that is time": characteristic("a*q", "t", "t"),
    "four coordinates in one point": of(
        {"kind": "bracket", "f": "q0", "g": "p0**2 - q0**2", "equals": "2*q0"},
        phase_space=dict(zip("qpQP", FOUR, strict=True)), transformation={"q": ["Q0"] * 4, "p": ["Q0"] * 4}),
    "a solution in time": of(
        {"kind": "canonical_when", "solutions": [{"t": "0"}]}, phase_space=MAP,
        transformation={"Q": ["(1 + t)*q"], "P": ["p"]}),
    "a coordinate that is held fixed": of(
        {"kind": "action", "coordinate": "q", "energy": "E", "equals": "2*pi*sqrt(2*E)", "fixed": {"q": "0"},
         "branch": "rotation", "period": "2*pi"},
        hamiltonian={"H": "p**2/2 + cos(q) - 1"}, symbols={"E": "positive"}),
    "an energy that is a new momentum": of(
        {"kind": "action", "coordinate": "q", "energy": "P", "equals": "2*pi*P"}, **POSITIVE, hamiltonian=OSCILLATOR),
    "a variable that is a new one": of(
        {"kind": "limit", "f": "Q", "variable": "Q", "to": "1", "equals": "1"}, **POSITIVE),
    "a tensor of old and new variables": of(
        {"kind": "bracket", "f": "Q", "g": "q", "equals": "1", "tensor": [["0", "1"], ["-1", "0"]],
         "coordinates": ["Q", "q"]}, **POSITIVE),
    "an acceleration that is time": of(
        {"kind": "euler_lagrange", "L": "v**2/2", "velocities": ["v"], "accelerations": ["t"], "equations": ["t"]}),
    "an equation without the solution": of(
        {"kind": "solves", "solution": {"x(t)": "t"}, "equations": ["x(t) - t", "0"]}, symbols={"x": "function"}),
    "a field that L doesn't have": of(
        {"kind": "field_equations", "L": "q**2", "fields": ["y(x, t)"], "equations": ["0"]},
        symbols={"y": "function", "x": "real"}),
    "two types for one degree of freedom": of(
        {"kind": "canonical"}, generating_function={"type": [2, 3], "F": "q*P"}, phase_space=MAP),
    "a coordinate that is a function": of({"kind": "conserved", "f": "p"}, hamiltonian={"H": "p"},
                                         symbols={"q": "function"}),
    "angles that time moves": of(
        {"kind": "action_angle", "angle_period": "2*pi"}, phase_space=MAP, hamiltonian=OSCILLATOR,
        symbols={"P": "positive"},
        transformation={"q": ["sqrt(2*P)*sin(Q + t)"], "p": ["sqrt(2*P)*cos(Q + t)"]}),
    "an extremum of what is complex": of(
        {"kind": "stationary", "L": "v**2/2 + 1j*q*v - 1j*q*v", "velocities": ["v"], "path": ["t"], "from": "0",
         "to": "1", "extremum": "minimum"}),
    "matrices where they aren't said to be": of(
        {"kind": "matrix_group", "first": ["a"], "second": ["b"], "matrix": [["exp(a)"]], "composition": ["a + b"]},
        symbols={"a": "real", "b": "real"}, domain={"where": ["-2 < a < -1"]}),
    "matrices of whole numbers, at others": of(
        {"kind": "matrix_group", "first": ["a"], "second": ["b"], "matrix": [["exp(a)"]], "composition": ["a + b"]},
        symbols={"a": "integer", "b": "real"}),
    "an integral over what its name isn't": against(
        {"kind": "integral", "f": "u", "variable": "u", "from": "0", "to": "1", "equals": "1/3"}, {"q": "1"},
        symbols={"u": "negative"}),
    "a dimension of a whole number": of(
        {"kind": "dimension", "functions": ["n*q"], "dimensions": {"n": "L", "q": "M"}, "equals": "L*M"},
        symbols={"n": "integer"}),
    "complex numbers in an order": against(
        {"kind": "identity", "lhs": "q", "rhs": "p"}, {"q": "1", "p": "2", "a": "1"}, symbols={"a": "complex"},
        domain={"where": ["a > 0"]}),
    "an average backwards": average("2*pi", "0", CIRCLE, hamiltonian=OSCILLATOR),
    "an average over a stretch that moves": average("0", "q**2 + 1", CIRCLE, hamiltonian=OSCILLATOR),
    "an average of what has no motion": average("0", "1", {"q": "cos(u)", "t": "u"}, "p/p"),
    "an average refuted of what is no motion": against(
        {"kind": "average", "f": "q", "equals": "0", "motion": CIRCLE, "parameter": "u", "from": "0", "to": "2*pi",
         "antiderivative": "sin(u)"}, {"q": "1", "u": "1"}, hamiltonian={"H": "p**2/2 + q**2"}),
}  # fmt: skip
TRUE = {
    "a point beyond an edge that isn't there": edge("atan(q)"),
    "an orbit beside a map": action(transformation={"Q": ["q + p**3"], "P": ["p"]}, phase_space=MAP),
    "an orbit beside an assumption that always holds": action(
        transformation={"Q": ["q"], "P": ["p + q**2 + p**2/4 + 2"]}, phase_space=MAP, symbols={"P": "positive"}),
    "a path beside a map": path("1 + t", **LOGARITHM),
    "a limit where H has a value": limit("1", **ROOT),
    "an integral where H has a value": integral("1", "2", "3/2", **ROOT),
    "an integral upwards": integral("0", "a", "a**2/2", symbols={"a": "nonnegative"}),
    "an origin beside a map": normal(transformation={"Q": ["q + p**3"], "P": ["p"]}, phase_space=MAP),
    "a germ beside a root": series(hamiltonian={"H": "sqrt(1 + u)*p"}, symbols={"u": "real"}),
    "a unit beside a root": group("u + w", hamiltonian={"H": "sqrt(1 + u)*p"}, symbols={"u": "real"}),
    "a law refuted": against(
        {"kind": "group", "first": ["u"], "second": ["w"], "composition": ["u + w + u*w**2"], "structure": {}},
        {"u": "6", "w": "1"}),
    "an acceleration refuted on the image": motion("v**2/2 - q**2/2", "w + 1", {"q": "2", "v": "1", "w": "1"}, **GIVEN),
    "a length refuted": length("q + sqrt(q)"),
    "what is determined, on the constraint": of(
        {**UNDETERMINED, "L": "v**2/2 + w**2/2", "determined": True}, **FREE),
    "undetermined motions, at velocities that are allowed": of(AT_REST, **FREE),
    "a constraint": of(
        {"kind": "constraint", "velocities": ["v", "w"], "functions": ["x**2 + y**2 - 1"], "holonomic": True}, **FREE),
    "a coordinate t, which isn't time": of({"kind": "conserved", "f": "e"}, phase_space={"q": ["t"], "p": ["e"]},
                                          hamiltonian={"H": "-e"}),
    "matrices": of(
        {"kind": "matrix_group", "first": ["a"], "second": ["b"], "matrix": [["exp(a)"]], "composition": ["a + b"],
         "inverse": ["-a"]}, symbols={"a": "real", "b": "real"}),
    "matrices of positive numbers": of(
        {"kind": "matrix_group", "first": ["a"], "second": ["b"], "matrix": [["sqrt(a**2)"]], "composition": ["a*b"],
         "inverse": ["1/a"]}, symbols={"a": "positive", "b": "positive"}),
    "an integral over a positive name": of(
        {"kind": "integral", "f": "u", "variable": "u", "from": "0", "to": "1", "equals": "1/2",
         "antiderivative": "u**2/2"}, symbols={"u": "positive"}),
    "an energy of constants": characteristic("sqrt(2*a)*q", "a", "p**2/2"),
    "four coordinates": of(
        {"kind": "bracket", "f": "q0", "g": "p0", "equals": "1"}, phase_space=dict(zip("qpQP", FOUR, strict=True)),
        transformation={"q": FOUR[2], "p": FOUR[3]}),
    "an average": average("0", "2*pi", CIRCLE, hamiltonian=OSCILLATOR),
}  # fmt: skip


@pytest.mark.parametrize("name", sorted(FALSE))
def test_what_the_file_makes_false_is_not_confirmed(name: str) -> None:
    assert status(FALSE[name]) != "confirmed", name


@pytest.mark.parametrize("name", sorted(TRUE))
def test_what_holds_beside_the_rest_of_the_file_is_confirmed(name: str) -> None:
    assert status(TRUE[name]) == "confirmed", name


def test_an_integral_is_asked_for_where_the_map_given_forward_has_a_value() -> None:
    claim = {"kind": "hamilton_jacobi", "W": "a*(q**2)**(1/2)", "constants": ["a"], "energy": "a"}
    H = {"hamiltonian": {"H": "p"}}
    assert status(against(claim, {"q": "-1", "a": "1"}, **H)) == "confirmed"
    assert status(against(claim, {"q": "-1", "a": "1"}, **H, **LOGARITHM)) == "rejected"
