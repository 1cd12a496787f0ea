"""Actions at a separatrix and in wells |q|ⁿ by the small files: what is shown, near misses, and other motions."""

from fractions import Fraction
from typing import Any

import pytest

from canon.checker import (
    alone_power_wells,
    alone_separatrices,
    alone_together,
    counterexample_closed_actions,
    refutations,
)
from canon.checker.alone import Stop
from canon.checker.counterexample import Arithmetic, Open
from canon.checker.counterexample_closed_actions import gamma
from tests.checker.certified import resealed

NAMES = dict.fromkeys(("m", "w", "g", "k", "n", "a", "b"), "positive") | {"c": "real"}


def tables(H: str, equals: str, **more: Any) -> Any:
    """A file with one action at the energy E; keys of the claim and sections of the file besides."""
    sections = {key: more.pop(key) for key in ("domain", "definitions", "transformation") if key in more}
    space = more.pop("phase_space", {"q": ["q"], "p": ["p"]})
    symbols = {**NAMES, **more.pop("symbols", {})}
    claim = {"kind": "action", "coordinate": "q", "energy": "E", "equals": equals, **more}
    return {"phase_space": space, "symbols": symbols, "hamiltonian": {"H": H}, "claim": claim, **sections}


def answer(H: str, equals: str, **more: Any) -> str:
    """The answer about a claim that a certificate calls proved, by these two files."""
    data = {"certificate": 1, "tables": tables(H, equals, **more), "verdict": "proved", "witness": None, "cases": [{}]}
    found = alone_separatrices.checked(resealed(data))[0]
    return found if found != "not shown" else alone_power_wells.checked(resealed(data))[0]


def refuted(H: str, equals: str, witness: Any, **more: Any) -> str:
    """The answer about a witness by the file for such actions alone."""
    try:
        return counterexample_closed_actions.refuted(tables(H, equals, **more), witness)[0]
    except (Stop, Open):
        return "not shown"


CUBIC, LOOP = "p**2/(2*m) + m*w**2*q**2/2 - m*g*q**3/3", "6*m*w**5/(5*g**2)"
TOP: Any = {"fixed": {"E": "m*w**6/(6*g**2)"}}
NUMBERS: Any = {"fixed": {"E": "1/6"}}
PLAIN = "p**2/2 + q**2/2 - q**3/3"
WELLS, LEFT, RIGHT = (
    "p**2/2 - q**2*(q + 1)*(2 - q)/2",
    "(76*sqrt(2) + 54*asin(1/3) - 27*pi)/48",
    "(76*sqrt(2) + 54*asin(1/3) + 27*pi)/48",
)
REST: Any = {"fixed": {"E": "0"}}
DUFFING, TWIN = "p**2/2 - a**2*q**2/2 + b**2*q**4/4", "4*a**3/(3*b**2)"
PENDULUM, UP = "p**2/(2*m*a**2) - m*g*a*cos(q)", {"fixed": {"E": "m*g*a"}}
SWING, ROUND, SWINGS, ROUNDS = (
    {**UP, "branch": "libration"},
    {**UP, "branch": "rotation"},
    "16*m*a*sqrt(g*a)",
    "8*m*a*sqrt(g*a)",
)
POWER = "p**2/(2*m) + k*abs(q)**n"
BETA = "2*sqrt(2*pi*m*E)*(E/k)**(1/n)*gamma(1 + 1/n)/gamma(3/2 + 1/n)"
SLOPE, SLOPES = "p**2/(2*m) + k*abs(q)", "8*sqrt(2*m)*E**(3/2)/(3*k)"
HALF: Any = {"symbols": {"q": "positive"}}


@pytest.mark.parametrize(("H", "equals", "more"), [
    (CUBIC, LOOP, TOP), (PLAIN, "6/5", NUMBERS), (PLAIN, "6/5", {**NUMBERS, "well": "-1/4"}),
    ("p**2/2 + q**2/2 + q**3/3", "6/5", {**NUMBERS, "well": "1/4"}), (CUBIC, LOOP, {**TOP, "branch": "libration"}),
    ("p**2/2 + (q - 5)**2/2 - (q - 5)**3/3", "6/5", NUMBERS),
    (WELLS, LEFT, {**REST, "well": "-1/2"}), (WELLS, RIGHT, {**REST, "well": "1"}),
    ("p**2/2 - q**2*(q - 1)*(-2 - q)/2", RIGHT, {**REST, "well": "-1"}),
    ("p**2/2 - (q - 3)**2*(q - 2)*(5 - q)/2", RIGHT, {**REST, "well": "4"}),
    (DUFFING, TWIN, {**REST, "well": "a/b"}), (DUFFING, TWIN, {**REST, "well": "-a/b"}),
    (PENDULUM, SWINGS, SWING), (PENDULUM, ROUNDS, ROUND), (PENDULUM, ROUNDS, {**ROUND, "period": "2*pi"}),
    ("p**2/2 + cos(3*q)", "8/3", {"fixed": {"E": "1"}, "branch": "rotation", "period": "2*pi/3"}),
    (POWER, BETA, {}), (POWER, BETA.replace("n", "(4)"), {"fixed": {"n": "4"}}), (SLOPE, SLOPES, {}),
    (POWER, SLOPES, {"fixed": {"n": "1"}}), (POWER, BETA.replace("gamma(1 + 1/n)", "gamma(1/n)/n"), {}),
    ("p**2/(2*m) + k*(q**2)**(n/2) + c", BETA.replace("E", "(E - c)"), {}),
    ("(p**2 + 2*m*k*abs(q)**n)/(2*m)", BETA, {}), ("p**2/2 + q**2/2", "2*pi*E", {}),
    ("p**2/2 + abs(q)**3", "2*sqrt(2*pi*E)*E**(1/3)*gamma(4/3)/(5/6*gamma(5/6))", {}),
])  # fmt: skip
def test_an_action_is_shown(H: str, equals: str, more: Any) -> None:
    assert answer(H, equals, **more) == "shown"


@pytest.mark.parametrize(("H", "equals", "more"), [
    (CUBIC, f"1001/1000*{LOOP}", TOP), (CUBIC, f"-{LOOP}", TOP), (CUBIC, f"2*{LOOP}", TOP), (CUBIC, f"{LOOP} + E", TOP),
    (CUBIC, LOOP.replace("w**5", "w**4"), TOP), (PLAIN, "3/5", NUMBERS), (PLAIN, "pi/3", NUMBERS),
    (WELLS, LEFT, {**REST, "well": "1"}), (WELLS, RIGHT, {**REST, "well": "-1/2"}),
    (WELLS, RIGHT.replace("asin(1/3)", "asin(1/4)"), {**REST, "well": "1"}),
    (WELLS, RIGHT.replace("+ 54*asin", "- 54*asin"), {**REST, "well": "1"}),
    (WELLS, RIGHT.replace("76", "75"), {**REST, "well": "1"}), (WELLS, f"{LEFT} + {RIGHT}", {**REST, "well": "1"}),
    (DUFFING, f"2*{TWIN}", {**REST, "well": "a/b"}), (PENDULUM, SWINGS, ROUND), (PENDULUM, ROUNDS, SWING),
    (PENDULUM, f"-{ROUNDS}", ROUND), (PENDULUM, SWINGS.replace("g*a", "g"), SWING),
    ("p**2/2 + cos(3*q)", "8", {"fixed": {"E": "1"}, "branch": "rotation", "period": "2*pi/3"}),
    (POWER, BETA.replace("3/2", "1501/1000"), {}), (POWER, BETA.replace("gamma(1 +", "gamma(2 +"), {}),
    (POWER, BETA.replace("(1/n)*", "(2/n)*"), {}), (POWER, BETA.replace("E/k", "k/E"), {}), (POWER, f"-{BETA}", {}),
    (SLOPE, SLOPES.replace("3/2", "5/2"), {}), (SLOPE, SLOPES.replace("8", "4"), {}),
    ("p**2/2 + q**4", "2*sqrt(2*pi*E)*E**(1/4)*gamma(5/4)/gamma(3/4)", {}),
    ("p**2/2 + abs(q)**3", "2*sqrt(2*pi*E)*E**(1/3)*gamma(4/3)/gamma(5/6)", {}),
])  # fmt: skip
def test_another_value_is_not(H: str, equals: str, more: Any) -> None:
    assert answer(H, equals, **more) == "not shown"


@pytest.mark.parametrize(("H", "equals", "more"), [
    # which loop, or none
    (WELLS, RIGHT, REST), (DUFFING, TWIN, REST), (WELLS, RIGHT, {**REST, "well": "0"}),
    (WELLS, RIGHT, {**REST, "well": "a"}),
    (WELLS, RIGHT, {**REST, "well": "2"}), (WELLS, RIGHT, {**REST, "well": "5/2"}),
    (WELLS, LEFT, {**REST, "well": "-2"}),
    (PLAIN, "6/5", {**NUMBERS, "well": "1"}), (PLAIN, "6/5", {**NUMBERS, "well": "3/2"}),
    (PLAIN, "6/5", {**NUMBERS, "well": "-1"}),
    (PLAIN, "6/5", {"fixed": {"E": "1/6 + 1/1000"}}), (PLAIN, "0", REST), (PLAIN, "6/5", {}),
    (PLAIN, "6/5", {**NUMBERS, "branch": "rotation"}), (PLAIN, "6/5", {**NUMBERS, "period": "1"}),
    ("p**2/2 - q**2/2", "0", REST), ("p**2/2 - q**3/3", "0", REST),
    ("p**2/2 + q**4/4 + q**2/2", "0", {**REST, "well": "1"}),
    ("p**2/2 - q**4/4 + q**2/2", "4/3", {**REST, "well": "1"}),
    ("-p**2/2 - q**2/2 + q**3/3", "6/5", {"fixed": {"E": "-1/6"}}),
    (WELLS + " + q/1000", RIGHT, {**REST, "well": "1"}), (DUFFING, TWIN, {"fixed": {"E": "1/1000"}, "well": "a/b"}),
    # the domain cuts it, or has no point
    (PLAIN, "6/5", {**NUMBERS, **HALF}), (PLAIN, "6/5", {**NUMBERS, "domain": {"where": ["q < 2"]}}),
    (PLAIN, "6/5", {**NUMBERS, "domain": {"where": ["p > 0"]}}),
    (PLAIN, "6/5", {**NUMBERS, "domain": {"where": ["c > c"]}}),
    (PLAIN, "6/5", {**NUMBERS, "domain": {"where": ["c**2 < -1"]}}), (PENDULUM, SWINGS, {**SWING, **HALF}),
    (PENDULUM, SWINGS, {**SWING, "domain": {"where": ["-4 < q < 4"]}}),
    # signs that a parameter may turn round
    ("p**2/2 + q**2/2 - c*q**3/3", "6/(5*c**2)", {"fixed": {"E": "1/(6*c**2)"}}),
    ("p**2/2 + c*q**2/2 - q**3/3", "6*c**2*sqrt(c)/5", {"fixed": {"E": "c**3/6"}}),
    ("p**2/(2*c) - cos(q)", "16*sqrt(c)", {"fixed": {"E": "1"}, "branch": "libration"}),
    ("p**2/2 - c*cos(q)", "16*sqrt(c)", {"fixed": {"E": "c"}, "branch": "libration"}),
    # not all the way, or another motion
    (PLAIN + " + 0/(q + 1/4)", "6/5", NUMBERS), (PLAIN + " + 0*log(q)", "6/5", NUMBERS),
    (PLAIN + " + 0*sqrt(q)", "6/5", NUMBERS),
    ("(p - q)**2/2 + q**2/2 - q**3/3 + 0*log(p)", "6/5", NUMBERS),
    ("p**2*(1 + q**2)/2 + q**2/2 - q**3/3", "6/5", NUMBERS),
    (PENDULUM, SWINGS, UP), (PENDULUM, SWINGS, {**SWING, "well": "0"}), (PENDULUM, ROUNDS, {**ROUND, "period": "4*pi"}),
    (PENDULUM, ROUNDS, {**ROUND, "period": "pi"}), (PENDULUM, SWINGS, {**SWING, "period": "2*pi"}),
    (PENDULUM, "0", {"fixed": {"E": "-m*g*a"}, "branch": "libration"}), (PENDULUM + " + 0/sin(q)", SWINGS, SWING),
    ("(p - 1)**2/2 - cos(q)", "8", {"fixed": {"E": "1"}, "branch": "rotation"}),
    ("p**2/2 - cos(q) + cos(q/2) - cos(q/2)", "8", {"fixed": {"E": "1"}, "branch": "rotation", "period": "4*pi"}),
    (PENDULUM, SWINGS, {**SWING, "kind": "frequency"}), (PLAIN, "6/5", {**NUMBERS, "kind": "frequency"}),
    (PLAIN, "6/5 + 0*log(-m)", NUMBERS), (PLAIN, "6/5 + asin(2) - asin(2)", NUMBERS),
    (PLAIN, "6/5", {**NUMBERS, "transformation": {"q": ["q"], "p": ["p"]}}),
])  # fmt: skip
def test_a_separatrix_that_is_not_that_motion_is_not_shown(H: str, equals: str, more: Any) -> None:
    assert answer(H, equals, **more) == "not shown"


@pytest.mark.parametrize(("H", "equals", "more"), [
    (POWER, BETA, {"symbols": {"n": "real"}}), (POWER, BETA, {"symbols": {"k": "real"}}),
    (POWER, BETA, {"symbols": {"m": "real"}}),
    (POWER, BETA, {"symbols": {"E": "negative"}}), (POWER, "0", {"fixed": {"E": "0"}}),
    (POWER, BETA, {"fixed": {"E": "-1"}}),
    (POWER, BETA, HALF), (POWER, BETA, {"domain": {"where": ["q > -1"]}}),
    (POWER, BETA, {"domain": {"where": ["q != 0"]}}),
    (POWER, BETA, {"domain": {"where": ["p > 0"]}}), (POWER, BETA, {"domain": {"where": ["n < -1"]}}),
    (POWER, BETA, {"well": "0"}), (POWER, BETA, {"branch": "rotation"}), (POWER, BETA, {"kind": "frequency"}),
    ("-(p**2/2 + abs(q))", "8*sqrt(2)*(-E)**(3/2)/3", {}), ("p**2/(2*m) + k*abs(q)**(n + q - q)", BETA, {}),
    ("p**2/(2*m) + k*abs(q)/2 + k*abs(q)**n/2", BETA, {}),
    (f"{POWER} + q - q", BETA, {}), (f"{POWER} + 0/q", BETA, {}), (f"{POWER} + abs(q) - abs(q)", BETA, {}),
    (f"{POWER}*q/q", BETA, {}), (f"{POWER} + 0*log(p)", BETA, {}), (f"-({POWER})", f"-({BETA})", {}),
    ("p**2/(2*m) + k*abs(q)**(-n)", BETA.replace("1/n", "(-1/n)"), {}), ("p**2/(2*m) - k*abs(q)**n", BETA, {}),
    ("p**2/(2*m) + k*abs(q)**0", BETA, {}), ("p**2/(2*m) + k*abs(q - 1)**n", BETA, {}),
    ("p**2/(2*m) + k*q**3", SLOPES, {}),
    ("p**2/(2*m) + k*abs(q)**q", BETA, {}), ("p**2/(2*m) + k*abs(q)**p", BETA, {}),
    ("p**2/(2*m) + k*abs(q)**E", BETA, {}),
    ("p**2/(2*m) + k*abs(q)**t", BETA, {}), ("p**2/(2*m) + k*abs(q)**n*abs(q)**n", BETA, {}),
    ("p**2*abs(q)**n/(2*m) + k*abs(q)**n", BETA, {}), ("sqrt(p**2 + 1) + abs(q)", SLOPES, {}),
    ("p**2/2 + p + abs(q)", "8*sqrt(2)*E**(3/2)/3", {}), ("p**4/2 + abs(q)", "8*sqrt(2)*E**(3/2)/3", {}),
    ("p**2/(2*m) + k*sqrt(abs(q)**n)", BETA, {}), (POWER, f"{BETA} + 0*log(-m)", {}),
    (POWER, f"{BETA} + 0*gamma(-2)", {}),
    (POWER, f"{BETA}*gamma(n - 1)*(n - 1)/gamma(n)", {}), (POWER, BETA, {"symbols": {"gamma": "function"}}),
    (POWER, BETA, {"definitions": {"gamma": "1"}}), (POWER, BETA, {"transformation": {"q": ["q"], "p": ["p"]}}),
    (POWER, f"{BETA} + q - q", {}), (POWER, f"{BETA}*gamma(c)/gamma(c)", {}),
])  # fmt: skip
def test_what_is_no_such_well_is_not_shown(H: str, equals: str, more: Any) -> None:
    assert answer(H, equals, **more) == "not shown"


ONES = dict.fromkeys(("m", "w", "g", "k", "n", "a", "b", "c", "E"), "1")


@pytest.mark.parametrize(("H", "equals", "witness", "more"), [
    (WELLS, LEFT, {}, {**REST, "well": "1"}), (WELLS, RIGHT, {}, {**REST, "well": "-1/2"}),
    (CUBIC, "2*pi*m*w**5/(6*g**2)", {"m": "3", "w": "11/3", "g": "3/4"}, TOP), (PENDULUM, ROUNDS, ONES, SWING),
    (POWER, BETA.replace("3/2", "1501/1000"), {**ONES, "n": "2/5"}, {}), (SLOPE, SLOPES.replace("8", "9"), ONES, {}),
])  # fmt: skip
def test_another_value_is_refuted(H: str, equals: str, witness: Any, more: Any) -> None:
    assert refuted(H, equals, witness, **more) == "shown"


@pytest.mark.parametrize(("H", "equals", "witness", "more"), [
    (WELLS, RIGHT, {}, {**REST, "well": "1"}), (CUBIC, LOOP, ONES, TOP), (PENDULUM, SWINGS, ONES, SWING),
    (POWER, BETA, {**ONES, "n": "2/5"}, {}), (SLOPE, SLOPES, ONES, {}), (SLOPE, "1", {**ONES, "E": "-1"}, {}),
    (SLOPE, "1", {**ONES, "k": "-1"}, {}), (SLOPE, "log(-m)", ONES, {}),
    (SLOPE, "1", ONES, {"domain": {"where": ["c > 1"]}}),
    (SLOPE, "1", ONES, HALF), (WELLS, "1", {}, REST), (WELLS, "1", {}, {**REST, "well": "0"}),
    (PENDULUM, "1", ONES, UP),
])  # fmt: skip
def test_what_holds_or_is_no_claim_is_not_refuted(H: str, equals: str, witness: Any, more: Any) -> None:
    assert refuted(H, equals, witness, **more) == "not shown"


@pytest.mark.parametrize(("x", "square"), [("1/2", "pi"), ("5/2", "9*pi/16"), ("1", "1"), ("5", "576")])
def test_gamma_is_enclosed(x: str, square: str) -> None:
    real = Arithmetic(128)
    low, high = gamma((Fraction(x), Fraction(x)), real)
    name, _, rest = square.partition("pi")
    factor = Fraction(name.strip("*") or "1") / Fraction(rest.strip("/") or 1) if "pi" in square else Fraction(square)
    pi = real.pi if "pi" in square else (Fraction(1),) * 2
    assert low**2 < factor * pi[0]
    assert factor * pi[1] < high**2
    assert high - low < Fraction(1, 10**5)


def test_the_files_are_asked() -> None:
    data = {"certificate": 1, "tables": tables(SLOPE, SLOPES.replace("8", "9")), "verdict": "refuted", "witness": ONES}
    assert refutations.checked(resealed({**data, "cases": []}))[0] == "shown"
    for H, equals, more in ((CUBIC, LOOP, TOP), (POWER, BETA, {})):
        data = {
            "certificate": 1,
            "tables": tables(H, equals, **more),
            "verdict": "proved",
            "witness": None,
            "known": {},
        }
        assert alone_together.checked(resealed({**data, "cases": [{}]}))[0] == "shown"
