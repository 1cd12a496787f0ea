"""Actions and angles by a small file: what is shown, near misses, cycles that are cut, singular or gone round twice."""

from typing import Any

import pytest

from canon.checker import alone_angles, alone_together
from tests.checker.certified import certified, resealed

LINE: Any = {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["w"], "P": ["J"]}}
PLANE: Any = {"phase_space": {"q": ["x", "y"], "p": ["a", "b"], "Q": ["u", "v"], "P": ["J", "K"]}}
NAMES: Any = {"m": "positive", "k": "positive", "e": "real", "J": "positive", "K": "positive", "V": "function"}
TURN = {"kind": "action_angle", "angle_period": "2*pi"}


def answer(H: str, q: Any, p: Any, claim: Any = TURN, **sections: Any) -> str:
    """The answer about a map given backward, whatever a certificate says of it."""
    of = lambda x: x if isinstance(x, list) else [x]
    tables = {**(LINE if isinstance(q, str) else PLANE), "symbols": NAMES, "hamiltonian": {"H": H},
              "transformation": {"q": of(q), "p": of(p)}, **sections, "claim": claim}  # fmt: skip
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": [{}], "known": {}}
    return alone_angles.checked(resealed(data))[0]


OSCILLATOR: Any = ("(p**2 + m**2*q**2)/2", "sqrt(2*J/m)*sin(w)", "sqrt(2*m*J)*cos(w)")
MORSE: Any = ("(p**2 + (1 - exp(-q))**2)/2", "log((1 + s*sin(w))/(1 - J)**2)", "(1 - J)*s*cos(w)/(1 + s*sin(w))")
ROOT = {"definitions": {"s": "sqrt(J*(2 - J))"}, "domain": {"where": ["J < 1"]}}


def test_wells_are_shown() -> None:
    assert answer(*OSCILLATOR) == "shown"
    assert answer(*MORSE, **ROOT) == "shown"
    once = {"kind": "action_angle"}
    assert answer("p**2/(2*m)", "2*pi*w", "J/(2*pi)", once, symbols=NAMES) == "shown"
    turning: Any = ("a**2 + (b - a)**2", ["u", "v"], ["J", "K"])
    assert answer(*turning) == "shown"
    two: Any = ("(a**2 + x**2)/2 + b**2", ["sqrt(2*J)*sin(u)", "v"], ["sqrt(2*J)*cos(u)", "K"])
    assert answer(*two) == "shown"


@pytest.mark.parametrize("claim", [
    {"kind": "action_angle"}, {"kind": "action_angle", "angle_period": "4*pi"}, {**TURN, "angle_period": "pi"},
    {**TURN, "angle_period": "-2*pi"}, {**TURN, "angle_period": "0"}, {**TURN, "angle_period": "2*pi*J/J"},
    {**TURN, "angle_period": "2*pi + e"}, {**TURN, "angle_period": "6*pi"}, {**TURN, "well": "0"},
])  # fmt: skip
def test_another_period_is_not_shown(claim: Any) -> None:
    assert answer(*OSCILLATOR, claim=claim) == "not shown"


def test_two_turns_are_not_one() -> None:
    """q = √J sin 2w, p = √J cos 2w with 2J in the place of J is canonical, and gone round twice in 2π."""
    twice: Any = ("(p**2 + q**2)/2", "sqrt(J)*sin(2*w)", "sqrt(J)*cos(2*w)")
    assert answer(*twice) == "not shown"
    assert answer(*twice, claim={**TURN, "angle_period": "pi"}) == "shown"
    rotor: Any = ("p**2", "2*w", "J/2")
    assert answer(*rotor) == "not shown"
    assert answer(*rotor, claim={**TURN, "angle_period": "pi"}) == "shown"
    mixed: Any = ("a**2 + b**2", ["u", "2*v"], ["J", "K/2"])
    assert answer(*mixed) == "not shown"


MISSES: dict[str, Any] = {
    "another factor": ("(p**2 + m**2*q**2)/2", "sqrt(J/m)*sin(w)", "sqrt(2*m*J)*cos(w)"),
    "another Hamiltonian": ("(p**2 + m**2*q**2)/2 + q", *OSCILLATOR[1:]),
    "with time in it": ("(p**2 + m**2*q**2)/2 + t", *OSCILLATOR[1:]),
    "a map with time in it": (OSCILLATOR[0], "sqrt(2*J/m)*sin(w + t)", "sqrt(2*m*J)*cos(w + t)"),
    "no period in q": ("p**2 + 0*q**3/q", "w + 0*sin(w)", "J"),
    "a line that is no circle": ("p**2 + V(q) - V(q)", "w", "J"),
    "a pole on the cycle": ("(p**2 + m**2*q**2)/2 + 0/q", *OSCILLATOR[1:]),
    "a root that is 0 on it": ("(p**2 + m**2*q**2)/2 + 0*sqrt(q**2)", *OSCILLATOR[1:]),
    "a modulus": ("(p**2 + m**2*abs(q)**2)/2", *OSCILLATOR[1:]),
    "a logarithm": ("(p**2 + m**2*q**2)/2 + 0*log(p**2)", *OSCILLATOR[1:]),
    "a half of the cycle": (
        "p**2/2 + q**2/2", "sqrt(2*J)*sqrt(sin(w)**2)", "sqrt(2*J)*cos(w)*sin(w)/sqrt(sin(w)**2)",
    ),
    "only at the edge": ("p**2", "w + 0/(1 + cos(w))", "J"),
}  # fmt: skip


@pytest.mark.parametrize("name", MISSES)
def test_what_is_false_or_singular_is_not_shown(name: str) -> None:
    assert answer(*MISSES[name]) == "not shown"


@pytest.mark.parametrize("sections", [
    {"domain": {"where": ["q > 0"]}}, {"domain": {"where": ["-1 < w < 1"]}}, {"domain": {"where": ["p + J > 0"]}},
    {"symbols": {**NAMES, "q": "positive"}}, {"symbols": {**NAMES, "w": "positive"}}, {"domain": {"on": ["q"]}},
    {"symbols": {**NAMES, "p": "nonnegative"}}, {"domain": {"where": ["q != 0"]}}, {"symbols": {**NAMES,
    "w": "integer"}},
    {"definitions": {"z": "q"}, "domain": {"where": ["z < 1"]}},
])  # fmt: skip
def test_a_cycle_that_is_cut_is_none(sections: Any) -> None:
    assert answer(*OSCILLATOR, **sections) == "not shown"
    assert answer(*OSCILLATOR, domain={"where": ["J > m", "m < 3"]}) == "shown"


def test_beyond_the_well_there_is_no_cycle() -> None:
    free = {**ROOT, "domain": {"where": ["J < 2"]}}
    assert answer(*MORSE, **free) == "not shown"
    unbounded: Any = ("(p**2 + (1 - exp(-q))**2)/2", "log((1 + m*sin(w))/(1 - J)**2)", MORSE[2])
    assert answer(*unbounded, **ROOT) == "not shown"


def test_several_angles_each_have_a_cycle() -> None:
    H = "(a**2 + x**2)/2 + (b**2 + y**2)/2"
    x, y, a, b = "sqrt(2*J)*sin(u)", "sqrt(2*K)*sin(v)", "sqrt(2*J)*cos(u)", "sqrt(2*K)*cos(v)"
    assert answer(H, [x, y], [a, b]) == "shown"
    assert answer(H, [x, y], [b, a]) == "not shown"
    assert answer(H, [x, "sqrt(K)*sin(2*v)"], [a, "sqrt(K)*cos(2*v)"]) == "not shown"
    assert answer(H + " + x*y", [x, y], [a, b]) == "not shown"


def test_a_map_given_forward_is_left_to_others() -> None:
    given = {"transformation": {"Q": ["atan2(q, p)"], "P": ["(p**2 + q**2)/2"]}}
    assert answer("(p**2 + q**2)/2", "q", "p", **given) == "not shown"


def test_it_is_asked_of_a_certificate() -> None:
    text = (
        '[phase_space]\nq = ["q"]\np = ["p"]\nQ = ["w"]\nP = ["J"]\n[symbols]\nJ = "positive"\n[hamiltonian]\n'
        'H = "(p**2 + q**2)/2"\n[transformation]\nq = ["sqrt(2*J)*sin(w)"]\np = ["sqrt(2*J)*cos(w)"]\n'
    )
    data = certified(text, "kind = 'action_angle'\nangle_period = '2*pi'")
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["claim"]["angle_period"] = "4*pi"
    assert alone_together.checked(resealed(data))[0] == "not shown"
