"""False claims of kinds that are confirmed by more than an identity, and true ones refuted: none is confirmed.

A forger writes what the checker would like to read: as many residuals as it asks for, each said to be 0 or shown by an
argument; for a refutation, a point.
"""

from typing import Any

import pytest

from canon.checker.check import check, checksum
from canon.checker.functions import Unknown, Unreadable
from canon.checker.kinds import obligations
from canon.checker.statement import Statement

SPACE = {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["w"], "P": ["J"]}}
POSITIVE = {"symbols": {"a": "positive", "b": "positive", "c": "positive"}}
SHOWN: tuple[dict[str, Any], ...] = (
    {"argument": "normal form"},
    {"numerator": {}, "denominator": {"": "1"}, "cofactors": {}},
)


def status(claim: dict[str, Any], verdict: str, shown: dict[str, Any], tables: Any, witness: Any = None) -> str:
    """The checker's answer about a forged certificate with a right checksum."""
    everything = {**SPACE, **POSITIVE, **tables, "claim": claim}
    try:
        count = [len(case.shown(verdict)) for case in obligations(Statement(everything, {}, verdict))]
    except (Unknown, Unreadable):
        count = [1]
    data = {
        "certificate": 1, "tables": everything, "known": {}, "verdict": verdict, "method": "normal form",
        "domain": [], "witness": witness, "points": [],
        "cases": [{"kernels": [], "atoms": {}, "residuals": [shown] * n} for n in count],
    }  # fmt: skip
    try:
        return check({**data, "checksum": checksum(data)}).status
    except Unreadable:
        return "unreadable"


def limit(f: str, equals: str, to: str = "0", **more: str) -> dict[str, Any]:
    return {"kind": "limit", "f": f, "variable": "x", "to": to, "equals": equals, **more}


def integral(f: str, low: str, high: str, equals: str, antiderivative: str) -> dict[str, Any]:
    ends = {"from": low, "to": high, "equals": equals, "antiderivative": antiderivative}
    return {"kind": "integral", "f": f, "variable": "x", **ends}


def map_of(q: str, p: str, H: str = "(p**2 + a**2*q**2)/2", **more: Any) -> dict[str, Any]:
    return {"transformation": {"q": [q], "p": [p]}, "hamiltonian": {"H": H}, **more}


OSCILLATOR = map_of("sqrt(2*J/a)*sin(w)", "sqrt(2*a*J)*cos(w)", symbols={"a": "positive", "J": "positive"})
FORWARD = {
    "transformation": {"Q": ["atan2(a*q, p)"], "P": ["(p**2 + a**2*q**2)/(2*a)"]},
    "hamiltonian": {"H": "(p**2 + a**2*q**2)/2"},
}
ANGLE = {"kind": "action_angle", "angle_period": "2*pi"}


def normal(H: str, N: dict[str, str], order: int = 4) -> tuple[dict[str, Any], dict[str, Any]]:
    return {"kind": "normal_form", "order": order, "N": N}, {"hamiltonian": {"H": H}}


def extremal(L: str, path: str, to: str, extremum: str, **more: Any) -> tuple[dict[str, Any], dict[str, Any]]:
    claim = {"kind": "stationary", "L": L, "velocities": ["v"], "path": [path], "from": "0", "to": to}
    return {**claim, "extremum": extremum, **more}, {"phase_space": {"q": ["q"], "p": ["p"]}}


QUARTIC, WAVE, PATH = "(p**2 + a**2*q**2)/2 + q**4", "(v**2 - q**2)/2", "sin(t)"
RIGHT = "3/2*((p**2 + a**2*q**2)/2)**2/a**4"

FALSE: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "a limit's thousandth": (limit("sin(a*x)/x", "1001/1000*a"), {}),
    "a limit at an edge": (limit("acos(1 - x)/sqrt(x)", "1001/1000*sqrt(2)", side="+"), {}),
    "a limit from the other side": (limit("sqrt(a*x**2)/x", "sqrt(a)", side="-"), {}),
    "a limit from both sides": (limit("x/abs(x)", "1"), {}),
    "a limit's branch": (limit("acos((sqrt(1 - x**2) - 1)/x)", "-pi/2", side="+"), {}),
    "a pole that is left out": (limit("1/x + a", "a", side="+"), {}),
    "an infinity of the other sign": (limit("-a/x**2", "infinity"), {}),
    "an infinity of no sign": (limit("a/x", "infinity"), {}),
    "a coefficient that may vanish": (limit("(q*x + x**2)/(p*x + x**2)", "q/p"), {}),
    "an exponential": (limit("tanh(a*x)", "1 + 1/1000000", to="infinity"), {}),
    "exponentials of two rates": (limit("exp(-a*x)*sinh(b*x)", "1/2", to="infinity"), {}),
    "an oscillation": (limit("x*sin(1/x)/x", "1"), {}),
    "an arbitrary function": (limit("sqrt(x)*V(x)", "0", side="+"), {"symbols": {"V": "function"}}),
    "a turn that is two": ({**ANGLE, "angle_period": "4*pi"}, OSCILLATOR),
    "a turn that is half": ({**ANGLE, "angle_period": "pi"}, OSCILLATOR),
    "a turn a thousandth longer": ({**ANGLE, "angle_period": "2*pi*1001/1000"}, OSCILLATOR),
    "a turn given forward that is two": ({**ANGLE, "angle_period": "4*pi"}, FORWARD),
    "a turn given forward, a thousandth longer": ({**ANGLE, "angle_period": "2*pi*1001/1000"}, FORWARD),
    "twice round, in bounds": (
        {**ANGLE, "angle_period": "4*pi"},
        OSCILLATOR | {"domain": {"where": ["0 < w", "w < pi/2"]}},
    ),
    "another Hamiltonian": (ANGLE, OSCILLATOR | {"hamiltonian": {"H": "p**2/2 + a**2*q**2/2 + q/1000"}}),
    "half of a phase space": (ANGLE, OSCILLATOR | {"hamiltonian": {"H": "p**2/2 + a**2*sqrt(q)**4/2"}}),
    "a cosine that isn't alone": (
        {**ANGLE, "angle_period": "4*pi"},
        map_of("sqrt(2*J/a)*sin(w)", "sqrt(2*a*J)*cos(w)*cos(w/2)/cos(w/2)", symbols=OSCILLATOR["symbols"]),
    ),
}  # fmt: skip

FALSE |= {
    "a normal form's thousandth": normal(QUARTIC, {"4": f"1001/1000*{RIGHT}"}),
    "a normal form's sign": normal(QUARTIC, {"4": f"-{RIGHT}"}),
    "a normal form that doesn't commute": normal(QUARTIC, {"4": "3/8*q**4 + 3/8*p**4/a**4"}),
    "a normal form one order short": normal(f"{QUARTIC} + q**6", {"4": RIGHT}, order=6),
    "another quadratic part": normal(QUARTIC, {"2": "(p**2 + q**2)/2", "4": "3/2*((p**2 + q**2)/2)**2"}),
    "a cubic that is left out": normal(f"{QUARTIC} + q**3/1000", {"4": RIGHT}),
    "no analytic Hamiltonian": normal("(p**2 + q**2)/2 + abs(q)**5", {}),
    "a frequency that may vanish": (
        {"kind": "normal_form", "order": 3, "N": {}},
        {
            "phase_space": {"q": ["q", "x"], "p": ["p", "y"]},
            "hamiltonian": {"H": "(p**2 + q**2)/2 + b*(y**2 + x**2)/2 + q**2*x"},
        },
    ),
    "no minimum beyond a conjugate point": extremal(WAVE, PATH, "4", "minimum", field="sin(t + 1/2)"),
    "a field that isn't one": extremal(WAVE, PATH, "4", "minimum", field="exp(t)"),
    "a field with a zero inside": extremal(WAVE, PATH, "4", "minimum", field="sin(t - 1)"),
    "neither, before a conjugate point": extremal(
        WAVE, PATH, "3", "neither", field="sin(t - 1/10)", conjugate=["1/10", "1/10 + pi"]
    ),
    "a field that is 0": extremal(WAVE, PATH, "4", "neither", field="0", conjugate=["1", "2"]),
    "a maximum": extremal(WAVE, PATH, "3", "maximum", field="cos(t - 3/2)"),
    "no extremal": extremal(WAVE, "sin(2*t)", "3", "minimum", field="cos(t - 3/2)"),
    "ends in the wrong order": extremal("(v**2 + (sin(t) + 2)*q**2)/2", "0", "-1", "maximum"),
    "an end that is nearly a conjugate point": extremal(
        WAVE, PATH, "pi + 1/1000", "minimum", field="sin(t + 1/1000000)"
    ),
}  # fmt: skip

FALSE |= {
    "an integral's thousandth": (integral("1/sqrt(a - x)", "0", "a", "2001/1000*sqrt(a)", "-2*sqrt(a - x)"), {}),
    "an integral to infinity": (integral("exp(-a*x)*cos(b*x)", "0", "infinity", "1/a",
                                         "exp(-a*x)*(b*sin(b*x) - a*cos(b*x))/(a**2 + b**2)"), {}),
    "an integral without an end": (integral("cos(x)", "0", "infinity", "0", "sin(x)"), {}),
    "a growing exponential": (integral("exp(x*(a - b))", "0", "infinity", "1/(b - a)", "exp(x*(a - b))/(a - b)"), {}),
    "another function's antiderivative": (integral("1/sqrt(a - x)", "0", "a", "2*sqrt(a)",
                                                   "2*(sqrt(a) - sqrt(a - x)) + x*(a - x)"), {}),
    "a jump inside": (integral("1/sqrt(1 - x**2)*0 + 1/(1 + x**2)", "0", "infinity", "-pi/2", "atan(-1/x)*0 + atan(x) "
                               "- pi*(1 + (x - 1)/abs(x - 1))/2"), {}),
    "an end beyond what is real": (integral("1/sqrt(a - x)", "0", "2*a", "2*sqrt(a)", "-2*sqrt(a - x)"), {}),
    "a pole inside": (integral("1/(x - a)**2", "0", "2*a", "-2/a", "-1/(x - a)"), {}),
    "a range that runs down": (integral("x/sqrt(x)", "a", "0", "-2/3*a**(3/2)", "2/3*x**(3/2)"), {}),
    "an end of any order": (integral("1/sqrt(x - a)", "a", "b", "2*sqrt(b - a)", "2*sqrt(x - a)"), {}),
    "a domain that is another": (
        integral("sqrt(x**2)/sqrt(a + x)*sqrt(a + x)", "-a", "a", "0", "x*sqrt(x**2)/2*sqrt(a + x)/sqrt(a + x)"),
        {"domain": {"where": ["x < 0"]}},
    ),
}  # fmt: skip

ACTION = {"kind": "action", "coordinate": "q", "energy": "E", "equals": "2*pi*E/a"}
RADIAL = {"hamiltonian": {"H": "p**2/2 + b**2/(2*q**2) - a/q"}, "symbols": {
    "a": "positive", "b": "positive", "q": "positive", "E": "negative"}}  # fmt: skip
KEPLER = "2*pi*(a/sqrt(-2*E) - b)"
MORSE = {"hamiltonian": {"H": "p**2/2 + b*(1 - exp(-a*q))**2"}}


PLAIN = {name: table for name, table in OSCILLATOR.items() if name != "transformation"}  # which leaves no orbits


def quartic(H: str) -> dict[str, Any]:
    return PLAIN | {"hamiltonian": {"H": H}}


FALSE |= {
    "an action's thousandth": ({**ACTION, "equals": "2001/1000*pi*E/a"}, PLAIN),
    "a frequency's thousandth": ({**ACTION, "kind": "frequency", "equals": "1001/2000*a/pi"}, PLAIN),
    "a small quartic": (ACTION, quartic("(p**2 + a**2*q**2)/2 + q**4/10**12")),
    "a small quartic's frequency": (
        {**ACTION, "kind": "frequency", "equals": "a/(2*pi)"}, quartic("(p**2 + a**2*q**2)/2 + q**4/10**12")),
    "a wall": (ACTION, PLAIN | {"domain": {"where": ["q > -1"]}}),
    "a positive coordinate": (ACTION, PLAIN | {"symbols": {"a": "positive", "q": "positive"}}),
    "a radial action's sign": ({**ACTION, "equals": "2*pi*(a/sqrt(-2*E) + b)"}, RADIAL),
    "a radial action's thousandth": ({**ACTION, "equals": "2*pi*(a/sqrt(-2*E) - 1001/1000*b)"}, RADIAL),
    "a radial action of any coordinate": (
        {**ACTION, "equals": KEPLER}, RADIAL | {"symbols": {**RADIAL["symbols"], "q": "real", "a": "real"}}),
    "an oscillator's half": (
        {**ACTION, "equals": "pi*(E/a + b)"},
        {"hamiltonian": {"H": "(p**2 + b**2/q**2 + a**2*q**2)/2"}, "symbols": {
            "a": "positive", "b": "positive", "q": "positive"}}),
    "an exponential's rate": ({**ACTION, "equals": "2*pi*sqrt(2)*(sqrt(b) - sqrt(b - E))/(2*a)"}, MORSE),
    "an exponential's height": ({**ACTION, "equals": "2*pi*sqrt(2)*(sqrt(b) - sqrt(b - 1001/1000*E))/a"}, MORSE),
    "a mass that moves": (ACTION, quartic("p**2/(2*(1 + q**2/10**9)) + a**2*q**2/2")),
    "a rotation backwards": (
        {**ACTION, "equals": "-2*pi*sqrt(2*E)", "branch": "rotation", "period": "2*pi"}, quartic("p**2/2")),
    "a rotation's period": (
        {**ACTION, "equals": "2*pi*sqrt(2*E)", "branch": "rotation", "period": "pi"}, quartic("p**2/2")),
}  # fmt: skip

TRUE: dict[str, tuple[dict[str, Any], dict[str, Any], dict[str, str] | None]] = {
    "a limit": (limit("sin(a*x)/x", "a"), {}, {"a": "1/3"}),
    "a limit of nested roots": (limit("(sqrt(1 + a*x) - 1)/x", "a/2"), {}, {"a": "3"}),
    "a limit at infinity": (limit("tanh(a*x)", "1", to="infinity"), {}, {"a": "2"}),
    "an action": (ACTION, PLAIN, {"a": "2", "E": "3"}),
    "a radial action": ({**ACTION, "equals": KEPLER}, RADIAL, {"a": "2", "b": "1", "E": "-1/3"}),
    "an action in exponentials": (
        {**ACTION, "equals": "2*pi*sqrt(2)*(sqrt(b) - sqrt(b - E))/a"}, MORSE, {"a": "2", "b": "2", "E": "1/3"}
    ),
    "an isochrone action": (
        {**ACTION, "equals": "2*pi*(a/sqrt(-2*E) - (b + sqrt(b**2 + 4*a*c))/2)"},
        RADIAL | {"hamiltonian": {"H": "p**2/2 + b**2/(2*q**2) - a/(c + sqrt(c**2 + q**2))"},
                  "symbols": {**RADIAL["symbols"], "c": "positive"}},
        {"a": "2", "b": "1", "c": "1", "E": "-1/10"},
    ),
    "a frequency": ({**ACTION, "kind": "frequency", "equals": "a/(2*pi)"}, PLAIN, {"a": "2", "E": "3"}),
    "an action about a well": (
        {**ACTION, "equals": "1/3*2*pi*E/a + 2/3*2*pi*E/a", "well": "1/100"}, PLAIN, {"a": "1/2", "E": "5"}
    ),
    "a rotation": (
        {**ACTION, "equals": "2*pi*sqrt(2*E)", "branch": "rotation", "period": "2*pi"},
        PLAIN | {"hamiltonian": {"H": "p**2/2"}}, {"E": "3", "a": "1"},
    ),
    "a pendulum's action": (
        {**ACTION, "equals": "16*(elliptic_e((1 + E)/2) - (1 - E)/2*elliptic_k((1 + E)/2))", "branch": "libration"},
        PLAIN | {"hamiltonian": {"H": "p**2/2 - cos(q)"}}, {"E": "1/3", "a": "1"},
    ),
    "a turn": (ANGLE, OSCILLATOR, {"a": "2", "J": "3", "w": "1/2"}),
    "a turn given forward": (ANGLE, FORWARD, {"a": "2", "q": "1", "p": "1/3"}),
    "a turn given forward, and back": (
        {**ANGLE, "angle_period": "-2*pi"}, FORWARD, {"a": "2", "q": "1", "p": "1/3"}
    ),
    "a turn without a point": (ANGLE, OSCILLATOR, None),
    "a normal form": (*normal(QUARTIC, {"4": RIGHT}), {"a": "2"}),
    "a normal form's logarithms": (
        *normal("(p**2 + q**2)/2 + log(4)*q**4", {"4": "3*log(2)*((p**2 + q**2)/2)**2"}), None
    ),
    "a normal form without a point": (*normal(QUARTIC, {"4": RIGHT}), None),
    "a minimum": (*extremal(WAVE, PATH, "3", "minimum", field="cos(t - 3/2)"), {"q": "1", "p": "1"}),
    "a minimum without a point": (*extremal(WAVE, PATH, "3", "minimum", field="cos(t - 3/2)"), None),
    "neither": (
        *extremal(WAVE, PATH, "4", "neither", field="sin(t - 1/10)", conjugate=["1/10", "1/10 + pi"]), {"q": "1"}
    ),
    "an integral with an edge": (integral("1/sqrt(a - x)", "0", "a", "2*sqrt(a)", "-2*sqrt(a - x)"), {}, {"a": "2"}),
    "an integral to infinity": (
        integral("exp(-a*x)*cos(b*x)", "0", "infinity", "a/(a**2 + b**2)",
                 "exp(-a*x)*(b*sin(b*x) - a*cos(b*x))/(a**2 + b**2)"), {}, {"a": "2", "b": "1"},
    ),
    "a complex identity": (
        {"kind": "identity", "lhs": "exp(1j*q)*exp(-1j*p)", "rhs": "cos(q - p) + 1j*sin(q - p)"}, {},
        {"q": "1/3", "p": "2"},
    ),
    "on a surface": (
        {"kind": "identity", "lhs": "q**2 + p**2", "rhs": "a"}, {"domain": {"on": ["q**2 + p**2 - a"]}},
        {"q": "1/3", "p": "2", "a": "37/9"},
    ),
    "on a surface of roots": (
        {"kind": "identity", "lhs": "q**2 + p**2", "rhs": "a"}, {"domain": {"on": ["q**2 + p**2 - a"]}},
        {"q": "1/3", "p": "1.374368541872553448412713437", "a": "2"},
    ),
    "off a surface": (
        {"kind": "identity", "lhs": "q**2 + p**2", "rhs": "a"}, {"domain": {"on": ["q**2 + p**2 - a"]}},
        {"q": "1/3", "p": "1.374", "a": "2"},
    ),
    "turns that are combined": (
        ANGLE,
        {
            "phase_space": {"q": ["q", "x"], "p": ["p", "y"], "Q": ["w", "v"], "P": ["J", "K"]},
            "transformation": {"q": ["2*w + v", "w + v"], "p": ["J - K", "2*K - J"]},
            "hamiltonian": {"H": "p**2/2 + y**2/2"},
        },
        {"w": "1/2", "v": "1/3", "J": "2", "K": "3"},
    ),
}  # fmt: skip


LONG = (
    "a small quartic", "a small quartic's frequency", "a mass that moves", "a wall", "a positive coordinate",
    "a pole inside", "a jump inside", "an action", "a frequency", "an action about a well", "a pendulum's action",
    "a radial action", "an isochrone action",
    "an action in exponentials", "an oscillator's half", "a radial action of any coordinate",
    "an exponential's rate", "a radial action's sign", "a turn given forward", "a turn given forward, and back",
)  # fmt: skip
"""They are measured first, or enclosed."""


def named(names: Any) -> list[Any]:
    return [pytest.param(name, marks=pytest.mark.slow if name in LONG else ()) for name in names]


UNSURE = ("turns that are combined", "a normal form's logarithms")
"""True, and no rule says so."""


@pytest.mark.parametrize("shown", SHOWN, ids=("argument", "identity"))
@pytest.mark.parametrize("name", named(FALSE))
def test_no_proof_of_what_is_false(name: str, shown: dict[str, Any]) -> None:
    claim, tables = FALSE[name]
    assert status(claim, "proved", shown, tables) != "confirmed"


@pytest.mark.parametrize("name", named(TRUE))
def test_no_refutation_of_what_is_true(name: str) -> None:
    claim, tables, witness = TRUE[name]
    assert status(claim, "refuted", SHOWN[0], tables, witness) not in ("confirmed", "confirmed in part")


@pytest.mark.parametrize("name", [name for name in TRUE if name not in UNSURE])
def test_these_are_true(name: str) -> None:
    """The same claims as proofs: confirmed, or in part where they are measured."""
    claim, tables, _ = TRUE[name]
    assert status(claim, "proved", SHOWN[0], tables).startswith("confirmed")
