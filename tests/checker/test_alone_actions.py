"""Actions and frequencies by the small files: what is shown, near misses, and orbits that a claim doesn't name."""

from typing import Any

import pytest

from canon.checker import alone_actions, alone_elliptic, alone_somewhere, alone_together
from tests.checker.certified import certified, resealed

NAMES = dict.fromkeys(("m", "w", "k", "a", "b", "M", "U", "A"), "positive")
PLANE = {"q": ["r", "theta"], "p": ["p_r", "p_theta"]}


def answer(H: str, equals: str, kind: str = "action", **more: Any) -> str:
    """The answer about a claim at the energy E; keys of the claim and sections of the file besides."""
    space = more.pop("phase_space", {"q": ["q"], "p": ["p"]})
    sections = {key: more.pop(key) for key in ("domain", "definitions", "transformation") if key in more}
    symbols = {**NAMES, **more.pop("symbols", {})}
    claim = {"kind": kind, "coordinate": space["q"][0], "energy": "E", "equals": equals, **more}
    tables = {"phase_space": space, "symbols": symbols, "hamiltonian": {"H": H}, "claim": claim, **sections}
    data = resealed({"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": [{}]})
    found = alone_actions.checked(data)[0]
    return found if found != "not shown" else alone_elliptic.checked(data)[0]


OSCILLATOR, ATOM = "p**2/(2*m) + m*w**2*q**2/2", "(p_r**2 + p_theta**2/r**2)/(2*m) - a/r"
MORSE, WALLS = "p**2/(2*m) + A*(1 - exp(-a*q))**2", "p**2/(2*m) + U*tan(a*q)**2"
RADIUS: Any = {"phase_space": PLANE, "symbols": {"r": "positive"}}
ARC: Any = {"domain": {"where": ["-pi/2 < a*q < pi/2"]}}
SQUARE = "p**2/2 - q**2/2 + q**4/4"
BOTTOM: Any = {"symbols": {"q": "positive", "s": "real"}, "domain": {"where": ["0 < s < 1"]},
    "fixed": {"E": "(s**2 - 1)/4"}}  # fmt: skip
ROOTS = "2*sqrt(1 + s)/3*(elliptic_e(2*s/(1 + s)) - (1 - s)*elliptic_k(2*s/(1 + s)))*sqrt(2)"
CUBIC = "p**2/2 - q**3/2 + q**2*(x + y + z)/2 - q*(x*y + y*z + x*z)/2"
ORDER: Any = {"symbols": {"x": "real", "y": "real", "z": "real"}, "domain": {"where": ["x < y", "y < z"]},
    "fixed": {"E": "-x*y*z/2"}}  # fmt: skip
TURN: Any = {"branch": "rotation"}
ROUND: Any = {"branch": "rotation", "period": "2*pi"}
SWING: Any = {"branch": "libration"}
PERIOD = "sqrt(z - x)/(4*elliptic_k((y - x)/(z - x)))"
LIBRATION, ROTATION = (
    "16*(elliptic_e((E + 1)/2) - (1 - E)/2*elliptic_k((E + 1)/2))",
    "4*sqrt(2*(E+1))*elliptic_e(2/(E+1))",
)


@pytest.mark.parametrize(("H", "equals", "more"), [
    (OSCILLATOR, "2*pi*E/w", {}), (OSCILLATOR, "w/(2*pi)", {"kind": "frequency"}),
    ("(p - q)**2/2 + q**2/2", "2*pi*E", {}), (ATOM, "2*pi*(a*sqrt(m/(-2*E)) - abs(p_theta))", RADIUS),
    (ATOM, "2*pi*(a*sqrt(m/(-2*E)) - M)", {**RADIUS, "fixed": {"p_theta": "M"}}),
    ("p**2/2 + w**2*q**2/2 + b**2/(2*q**2)", "pi*(E/w - b)", {"symbols": {"q": "positive"}}),
    (MORSE, "2*pi*sqrt(2*m)*(sqrt(A) - sqrt(A - E))/a", {}),
    (MORSE, "a*sqrt(A - E)/(pi*sqrt(2*m))", {"kind": "frequency"}),
    (WALLS, "a*sqrt(2*(E + U)/m)/(2*pi)", {**ARC, "kind": "frequency"}),
    ("sqrt(p**2 + 1) + k*q**2/2",
     "8/3*sqrt(2*(E + 1)/k)*(E*elliptic_e((E - 1)/(E + 1)) - elliptic_k((E - 1)/(E + 1)))", {}),
    (SQUARE, ROOTS, BOTTOM), (CUBIC, PERIOD, {**ORDER, "kind": "frequency"}),
    ("p**2/(2*m)", "2*pi*sqrt(2*m*E)", ROUND), ("p**2/(2*m)", "sqrt(2*E/m)/(2*pi)", {**ROUND, "kind": "frequency"}),
    ("p**2/2 - cos(q)", LIBRATION, SWING), ("p**2/2 - cos(q)", ROTATION, TURN),
    ("p**2/2 - cos(q)", "1/(4*elliptic_k((E + 1)/2))", {**SWING, "kind": "frequency"}),
])  # fmt: skip
def test_an_action_or_a_frequency_is_shown(H: str, equals: str, more: Any) -> None:
    assert answer(H, equals, **more) == "shown"


@pytest.mark.parametrize(("H", "equals", "more"), [
    (OSCILLATOR, "1001/1000*2*pi*E/w", {}), (OSCILLATOR, "-2*pi*E/w", {}), (OSCILLATOR, "pi*E/w", {}),
    (OSCILLATOR, "2*pi*E/w + 1/1000", {}), (OSCILLATOR, "w/pi", {"kind": "frequency"}),
    (ATOM, "2*pi*(a*sqrt(m/(-2*E)) - p_theta)", RADIUS), (ATOM, "2*pi*(a*sqrt(m/(-2*E)) + abs(p_theta))", RADIUS),
    (ATOM, "2*pi*a*sqrt(m/(-2*E))", RADIUS), (MORSE, "2*pi*sqrt(2*m)*(sqrt(A) + sqrt(A - E))/a", {}),
    (MORSE, "2*pi*sqrt(2*m)*(sqrt(A) - sqrt(A + E))/a", {}),
    ("p**2/2 + w**2*q**2/2 + b**2/(2*q**2)", "pi*(E/w + b)", {"symbols": {"q": "positive"}}),
    ("p**2/2 + w**2*q**2/2 + c/(2*q**2)", "pi*(E/w - c)", {"symbols": {"q": "positive", "c": "real"}}),
    (SQUARE, ROOTS.replace("(1 - s)", "(1 + s)"), BOTTOM), (SQUARE, f"2*{ROOTS}", BOTTOM),
    (SQUARE, f"-{ROOTS}", BOTTOM),
    (CUBIC, PERIOD.replace("4", "2"), {**ORDER, "kind": "frequency"}),
    (CUBIC, "sqrt(z - x)/(4*elliptic_k((z - y)/(z - x)))", {**ORDER, "kind": "frequency"}),
    ("p**2/2 - cos(q)", LIBRATION.replace("16", "8"), SWING), ("p**2/2 - cos(q)", ROTATION.replace("4", "8"), TURN),
    ("p**2/2 - cos(q)", LIBRATION.replace("/2)", ")"), SWING),
    ("p**2/2 - cos(q)", LIBRATION, TURN), ("p**2/2 - cos(q)", ROTATION, SWING),
])  # fmt: skip
def test_another_value_is_not(H: str, equals: str, more: Any) -> None:
    assert answer(H, equals, **more) == "not shown"


@pytest.mark.parametrize(("H", "equals", "more"), [
    # the orbit isn't there, or leaves the domain
    (OSCILLATOR, "2*pi*E/w", {"symbols": {"q": "positive"}}), (OSCILLATOR, "0", {"fixed": {"E": "0"}}),
    (OSCILLATOR, "2*pi*E/w", {"fixed": {"E": "-1"}}), (OSCILLATOR, "2*pi*E/w", {"symbols": {"E": "negative"}}),
    ("p**2/2 - q**2/2", "2*pi*E", {}), ("p**2/2 - q**2/2", "-2*pi*E", {}), ("-p**2/2 - q**2/2", "-2*pi*E", {}),
    (OSCILLATOR, "2*pi*E/w", {"domain": {"where": ["w < 0"]}}),
    (OSCILLATOR, "2*pi*E/w", {"domain": {"where": ["E < 0"]}}),
    ("p**2/2 - 1/r", "2*pi/sqrt(-2*E)", {"phase_space": {"q": ["r"], "p": ["p"]}, "symbols": {"r": "positive"}}),
    # conditions that cut it
    (OSCILLATOR, "2*pi*E/w", {"symbols": {"p": "positive"}}),
    (OSCILLATOR, "2*pi*E/w", {"domain": {"where": ["p > 0"]}}),
    (OSCILLATOR, "2*pi*E/w", {"domain": {"where": ["p + q > 0"]}}),
    (OSCILLATOR, "2*pi*E/w", {"symbols": {"q": "nonzero"}}),
    (OSCILLATOR, "2*pi*E/w", {"domain": {"where": ["q != 0"]}}),
    (OSCILLATOR, "2*pi*E/w", {"domain": {"where": ["q**2 > 1"]}}),
    # H has no value on the way
    ("p**2/2 + q**2/2 + 0*log(p + 1)", "2*pi*E", {}), ("p**2/2 + q**2/2 + 0*log(q + 1)", "2*pi*E", {}),
    ("p**2/2 + sqrt(q - 1)**2*(q + 1)/2 + 1/2", "2*pi*E", {}), ("p**2/2 + q**2/2 + 0/q", "2*pi*E", {}),
    ("p**2/2 + q**2/2 + 0/p", "2*pi*E", {}), ("p**2/2 + q**2/2 + 0*sqrt(p)", "2*pi*E", {}),
    ("p**2/2 + q**3/(2*q)", "2*pi*E", {}),
    ("p**2/2 + q**2/2 + 0*log(-w)", "2*pi*E", {}), (WALLS, "a*sqrt(2*(E + U)/m)/(2*pi)", {"kind": "frequency"}),
    (WALLS, "a*sqrt(2*(E + U)/m)/(2*pi)", {"kind": "frequency", "domain": {"where": ["0 < a*q < pi"]}}),
    # another energy, time, map, well, branch
    ("p**2/2 + k*q**2/2", "2*pi*sqrt(k)", {"energy": "k"}), (OSCILLATOR, "2*pi*E/w", {"energy": "q"}),
    (OSCILLATOR, "2*pi*E/w*(1 + 0*q)", {}), (OSCILLATOR, "2*pi*E/w", {"well": "10"}),
    (OSCILLATOR, "2*pi*E/w", {"period": "1"}),
    (OSCILLATOR, "2*pi*E/w", {"branch": "rotation"}), ("p**2/2 + q**2/2 + 0*t", "2*pi*E", {}),
    (OSCILLATOR, "2*pi*E/w", {"transformation": {"Q": ["q"], "P": ["p"]}}),
    ("p**2/2 - cos(q)", LIBRATION, {}), ("(p - 2)**2/2 - cos(q)", ROTATION, TURN),
    ("p**2/2 - cos(q)", LIBRATION, {**SWING, "domain": {"where": ["-1 < q", "q < 1"]}}),
    ("p**2/2 - cos(q)", ROTATION, {**TURN, "symbols": {"q": "positive"}}),
    (SQUARE, ROOTS, {**BOTTOM, "symbols": {"s": "real"}}),
    (SQUARE, ROOTS, {**BOTTOM, "domain": {"where": ["s > 1"]}}),
    ("p**2/2", "2*pi*sqrt(2*E)", TURN), ("p**2/2", "2*pi*sqrt(2*E)", {"period": "2*pi"}),
    ("p**2/2", "2*pi*sqrt(2*E)", {}),
    ("p**2/2", "-2*pi*sqrt(2*E)", {**TURN, "period": "-2*pi"}), ("p**2/2", "E*sqrt(2*E)", {**TURN, "period": "E"}),
    ("p**2/2", "c*sqrt(2*E)", {**TURN, "period": "c", "symbols": {"c": "real"}}),
    ("(p - 3)**2/2", "2*pi*(sqrt(2*E) + 3)", ROUND), ("-p**2/2", "2*pi*sqrt(-2*E)", ROUND),
    ("p**2/2", "2*pi*sqrt(2*E)", {**ROUND, "symbols": {"q": "positive"}}),
    ("p**2/2", "2*pi*sqrt(2*E)", {**ROUND, "domain": {"where": ["q < 1"]}}),
    ("p**2/2 + 0*q", "2*pi*sqrt(2*E)", ROUND), ("p**2/2", "4*pi*sqrt(2*E)", ROUND),
    ("p**2/2", "2*pi", {**ROUND, "fixed": {"E": "1/2"}}),
    # what is fixed
    ("p**2/2 + k*q**2/2", "2*pi*E/sqrt(k)", {"fixed": {"k": "-1"}}), (ATOM, "2*pi*(a*sqrt(m/(-2*E)) - M)",
     {**RADIUS, "fixed": {"p_theta": "r"}}), (OSCILLATOR, "2*pi*E/w", {"fixed": {"q": "1"}}),
    (ATOM, "sqrt(-2*E)**3/(2*pi*a*sqrt(m))", {**RADIUS, "kind": "frequency", "fixed": {"p_theta": "sqrt(-E)"}}),
    (CUBIC, PERIOD, {**ORDER, "kind": "frequency", "domain": {"where": ["x < z", "z < y"]}}),
])  # fmt: skip
def test_a_claim_about_no_orbit_or_another_one_is_not(
    H: str, equals: str, more: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(alone_somewhere, "SEARCHED", 100)
    assert answer(H, equals, **more) == "not shown"


def test_a_symbol_may_have_the_name_of_the_derivative() -> None:
    equals = "2*pi*sqrt(2*m)*(sqrt(D) - sqrt(D - E))/a"
    assert answer(MORSE.replace("A", "D"), equals, symbols={"D": "positive"}) == "shown"
    assert answer(MORSE.replace("A", "D"), equals, symbols={"D": "function"}) == "not shown"


def test_the_name_that_it_gets_is_no_other_one() -> None:
    equals = "2*pi*sqrt(2*m)*(sqrt(D) - sqrt(D0_of_the_file - E))/a"
    names = {"D": "positive", "D0_of_the_file": "positive"}
    assert answer(MORSE.replace("A", "D"), equals, symbols=names) == "not shown"


def test_it_is_asked_of_a_certificate() -> None:
    text = '[phase_space]\nq = ["q"]\np = ["p"]\n[hamiltonian]\nH = "p**2/2 + 2*q**2"\n'
    data = certified(text, "kind = 'frequency'\ncoordinate = 'q'\nenergy = 'E'\nequals = '1/pi'")
    assert alone_together.checked(data) == ("shown", "")


SINGULAR = "q**2*p**2/2 - b*x*y*z/q**2 + b*q**4"
THROUGH: Any = {"symbols": {"x": "positive", "y": "positive"}, "definitions": {"z": "x + y"},
    "fixed": {"E": "b*((x + y)**2 - x*y)"}, "kind": "frequency"}  # fmt: skip
FAST: Any = {**TURN, "symbols": {"c": "real", "E": "positive"}}


@pytest.mark.parametrize(("H", "equals", "more"), [
    (SINGULAR, "sqrt(2*b*(z + x)*y)/4/elliptic_k((y - x)*z/(y*(z + x)))", THROUGH),
    ("(p**2/2 - c)/(1 - cos(q))", "4*sqrt(2*(c + 2*E))*elliptic_e(2*E/(c + 2*E))", FAST),
    ("(p**2/2 - c)/(1 + cos(q))", "4*sqrt(2*(c + 2*E))*elliptic_e(2*E/(c + 2*E))", FAST),
    ("p**2/2 - cos(q) + 0*sqrt(1 - cos(q))", ROTATION, TURN),
])  # fmt: skip
def test_a_motion_through_a_place_where_h_has_no_value_is_none(H: str, equals: str, more: Any) -> None:
    """The line, or the circle, is folded there, and the integral has a value."""
    assert answer(H, equals, **more) == "not shown"


def test_where_h_has_a_value_there_it_is_one() -> None:
    equals = "4*sqrt(2*(c + 4*E))*elliptic_e(2*E/(c + 4*E))"
    assert answer("(p**2/2 - c)/(3 - cos(q))", equals, **FAST) == "shown"


OVAL = "p**2/2 + b*(x - z)*q**2/4 + {}"
ROUND_OVAL: Any = {"symbols": {"x": "positive", "z": "positive"}, "fixed": {"E": "b*z*x/4"}, "kind": "frequency"}
OVAL_RATE = "sqrt(b/2)*sqrt(z + x)/(4*elliptic_k(z/(z + x)))"


def test_a_root_or_a_modulus_that_is_0_on_the_way() -> None:
    """These have a value, and a derivative, where what they are of isn't 0."""
    assert answer(OVAL.format("b*q**4/4"), OVAL_RATE, **ROUND_OVAL) == "shown"
    for other in ("b*q**4/4 + 0*abs(q)", "b*q**4/4 + 0*sqrt(q**2)", "b*abs(q)**3*abs(q)/4"):
        assert answer(OVAL.format(other), OVAL_RATE, **ROUND_OVAL) == "not shown"
    assert answer("p**2/2 + sqrt(q**2 + a**2)**2/2 - a**2/2", "2*pi*E") == "shown"
    assert answer("p**2/2 + abs(q)**2/2", "2*pi*E") == "shown"
