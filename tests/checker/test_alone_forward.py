"""Angles of maps given forward by a small file: what is shown, near misses, other orbits, domains without a point."""

from typing import Any

import pytest

from canon.checker import alone_forward, alone_together
from tests.checker.certified import resealed

SPACE: Any = {"q": ["q"], "p": ["p"], "Q": ["w"], "P": ["J"]}
NAMES: Any = {"m": "positive", "k": "positive", "g": "positive", "e": "real"}


def answer(H: str, w: str, J: str, period: Any = "2*pi", where: Any = (), by: Any = alone_forward, **more: Any) -> str:
    """The answer about a claim, whatever a certificate says of it."""
    tables = {"phase_space": SPACE, "symbols": NAMES, "hamiltonian": {"H": H}, "domain": {"where": [*where]},
              "transformation": {"Q": [w], "P": [J]}, **more}  # fmt: skip
    tables["claim"] = {"kind": "action_angle"} | ({} if period is None else {"angle_period": period})
    tables["claim"] |= more.get("claim", {})
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": [{}], "known": {}}
    return by.checked(resealed(data))[0]


OSCILLATOR: Any = ("(p**2 + m**2*q**2)/2", "atan2(m*q, p)", "(p**2 + m**2*q**2)/(2*m)")
MODULUS: Any = {"definitions": {"n": "p**2/4 + sin(q/2)**2"}}
SWING: Any = ("p**2/2 - cos(q)", "elliptic_f(asin(sin(q/2)/sqrt(n)), n)/(4*elliptic_k(n))",
    "16*(elliptic_e(n) - (1 - n)*elliptic_k(n))", None, ["n < 1", "p > 0", "-pi < q < pi"])  # fmt: skip
TURN: Any = ("p**2/2 - cos(q)", "elliptic_f(q/2, 1/n)/(2*elliptic_k(1/n))", "8*sqrt(n)*elliptic_e(1/n)",
    None, ["n > 1", "-pi < q < pi", "p > 0"])  # fmt: skip


def test_an_oscillator_is_shown() -> None:
    assert answer(*OSCILLATOR) == "shown"
    assert answer(*OSCILLATOR, by=alone_together) == "shown"
    assert answer(OSCILLATOR[0], "atan2(m*q, p)/(2*pi)", f"2*pi*({OSCILLATOR[2]})", None) == "shown"
    moved: Any = ("(p**2 + m**2*q**2)/2 + e", "atan2(m*q, p)", "(p**2 + m**2*q**2)/(2*m)")
    assert answer(*moved, where=["q > 1", "p**2 + q**2 < 4"]) == "shown"


def test_a_pendulum_is_shown() -> None:
    assert answer(*SWING, **MODULUS) == "shown"


def test_a_rotation_is_shown() -> None:
    assert answer(*TURN, **MODULUS) == "shown"


@pytest.mark.parametrize("period", [None, "pi", "4*pi", "-2*pi", "0", "2*pi + e", "2*pi*J/J", "2*pi*q/q", "6*pi"])
def test_another_period_is_not_shown(period: Any) -> None:
    assert answer(*OSCILLATOR, period=period) == "not shown"


MISSES: Any = {
    "J by a factor": (OSCILLATOR[0], "atan2(m*q, p)/2", "(p**2 + m**2*q**2)/m"),
    "J with a constant": (OSCILLATOR[0], "atan2(m*q, p)", "(p**2 + m**2*q**2)/(2*m) + 1"),
    "not canonical": (OSCILLATOR[0], "atan2(q, p)", OSCILLATOR[2]),
    "J that is no function of H": (OSCILLATOR[0], "m*q/p", "p**2/(2*m)"),
    "the other way round": (OSCILLATOR[0], "-atan2(m*q, p)", f"-({OSCILLATOR[2]})"),
    "another H": ("(p**2 + 4*m**2*q**2)/2", *OSCILLATOR[1:]),
    "H with q": ("(p**2 + m**2*q**2)/2 + q", *OSCILLATOR[1:]),
    "with time": (OSCILLATOR[0], "atan2(m*q, p) + t", OSCILLATOR[2]),
    "H with time": ("(p**2 + m**2*q**2)/2 + t", *OSCILLATOR[1:]),
    "a maximum": ("(p**2 - m**2*q**2)/2", "atanh(m*q/p)", "(p**2 - m**2*q**2)/(2*m)"),
    "free": ("p**2/2", "2*pi*q", "p/(2*pi)"),
    "H below": ("-(p**2 + m**2*q**2)/2", *OSCILLATOR[1:]),
    "new names in it": (OSCILLATOR[0], "atan2(m*q, p) + 0*J", OSCILLATOR[2]),
    "a pole": ("(p**2 + m**2*q**2)/2 + 0/q", *OSCILLATOR[1:]),
    "an empty domain": (*OSCILLATOR, "2*pi", ["p > 0", "p < 0"]),
    "a root without values": (*OSCILLATOR, "2*pi", ["sqrt(-1 - q**2) > 0"]),
}  # fmt: skip


@pytest.mark.parametrize("name", MISSES)
def test_near_misses_are_not_shown(name: str) -> None:
    assert answer(*MISSES[name]) == "not shown"


@pytest.mark.slow
@pytest.mark.parametrize("more", ["", " + 0*sqrt(k + q**2)", " + 0*log(k + q**2)"])
def test_a_formula_of_the_energy_has_values_in_the_domain(more: str) -> None:
    """Where k < 0 the factor is 2, and the angle advances by π. At q = 0 there is √k, that is: k > 0."""
    factor, where = "(3 - sqrt(k**2)/k)/2", "k + k**3 < 0"
    for period in ("2*pi", "pi"):
        maps = ("(p**2 + q**2)/2", f"atan2(q, p)/({factor})", f"(p**2 + q**2)/2*({factor}){more}", period, [where])
        assert answer(*maps, symbols={"k": "real"}) == "not shown"


OTHER: Any = {
    "a half-line": {"symbols": {**NAMES, "q": "positive"}},
    "J negative": {"symbols": {**NAMES, "J": "negative"}},
    "two meanings": {"symbols": {**NAMES, "t": "real"}},
    "two definitions": {"definitions": {"m": "2"}},
    "a name of q": {"definitions": {"q": "p"}},
    "endless": {"definitions": {"a": "b", "b": "a"}, "hamiltonian": {"H": f"{OSCILLATOR[0]} + 0*a"}},
    "names made here": {"symbols": {**NAMES, "E_of_point": "real"}},
    "a surface": {"domain": {"on": ["q - p"]}},
    "a whole number": {"symbols": {**NAMES, "m": "integer"}},
    "complex": {"symbols": {**NAMES, "m": "complex"}},
    "a key": {"claim": {"well": "0"}},
    "a tensor": {"tensor": [["0", "1"], ["-1", "0"]]},
    "a generating function": {"generating_function": {"type": 1, "F": "q*w"}},
}  # fmt: skip


@pytest.mark.parametrize("name", OTHER)
def test_other_sections_are_heeded(name: str) -> None:
    assert answer(*OSCILLATOR, **OTHER[name]) == "not shown"


@pytest.mark.parametrize("claim", [SWING, TURN], ids=["swing", "turn"])
def test_a_pendulum_has_another_period(claim: Any) -> None:
    assert answer(claim[0], claim[1], claim[2], "2", claim[4], **MODULUS) == "not shown"


@pytest.mark.parametrize("where", [[], ["n < 2"], ["n > 1/2"]])
def test_of_two_branches_the_domain_has_to_say_which(where: Any) -> None:
    assert answer(SWING[0], SWING[1], SWING[2], None, [*where, "p > 0", "-pi < q < pi"], **MODULUS) == "not shown"


def test_a_rotation_among_several_wells() -> None:
    """cos 2q has the period π, but q comes back after 2π: not after the time of a half of it."""
    half = {"definitions": {"n": "p**2/4 + sin(q)**2"}}
    rotating: Any = ("p**2/2 - cos(2*q)", "elliptic_f(q, 1/n)/(2*elliptic_k(1/n))", "4*sqrt(n)*elliptic_e(1/n)")
    assert answer(rotating[0], rotating[1], rotating[2], None, ["n > 1", "p > 0"], **half) == "not shown"
