"""Actions and periods that the checker derives itself: a rational function of the coordinate under one root."""

import copy
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from canon.catalogue import files
from canon.checker.actions import action, action_angle
from canon.checker.statement import Statement
from canon.claims import document

ROOM = {Path(str(file)).stem: Path(str(file)) for file in files()}
DERIVED = {
    ("bead-on-a-parabola-action", 0), ("cubic-well-action", 0), ("cubic-well-action", 1), ("double-well-action", 0),
    ("heavy-top-actions", 0), ("hookes-atom-action", 0), ("hookes-atom-action", 1), ("isochrone-action", 0),
    ("isochrone-action", 1), ("polar-angle-action", 1), ("poschl-teller-actions", 0), ("poschl-teller-actions", 1),
    ("poschl-teller-two-walls", 0), ("relativistic-actions", 0), ("sommerfeld-action", 0),
    ("spherical-pendulum-action", 1), ("tangent-well-action", 0), ("tangent-well-action", 1), ("action-pendulum", 0),
    ("action-pendulum", 1), ("action-pendulum", 2), ("action-pendulum", 3), ("power-law-action", 0),
    ("power-law-action", 1), ("power-law-action", 2), ("power-law-action", 3),
}  # fmt: skip
SHORT = ("cubic-well-action", "polar-angle-action", "power-law-action", "action-angle-oscillator-forward")


def named(cases: Any) -> list[Any]:
    return [pytest.param(*case, marks=() if case[0] in SHORT else pytest.mark.slow) for case in sorted(cases)]


@cache
def _tables(name: str) -> Any:
    return document.load(ROOM[name])


def tables(name: str, index: int) -> Any:
    """The tables of one claim of the catalogue, one's own."""
    found = copy.deepcopy(_tables(name))
    found["claim"] = found["claim"][index]
    return found


def found(of: Any) -> bool:
    """Whether the checker derives the claim."""
    return action(Statement(of, {}, "proved")).found is True


@pytest.mark.parametrize(("name", "index"), named(DERIVED))
def test_derived(name: str, index: int) -> None:
    """The claim is; with a thousandth more, the other sign, or a small term more in H, it isn't."""
    right = tables(name, index)
    assert found(right)
    H, equals = right["hamiltonian"]["H"], right["claim"]["equals"]
    for wrong in (f"1001/1000*({equals})", f"-({equals})"):
        assert not found({**right, "claim": {**right["claim"], "equals": wrong}})
    x = right["claim"]["coordinate"]
    for more in (f"{x}**4/10**9", "1/10**9"):
        assert not found({**right, "hamiltonian": {"H": f"{H} + {more}"}}) or right["claim"]["kind"] == "frequency"


PENDULUM = "16*m*l*sqrt(g*l)*(elliptic_e(k) - (1 - k)*elliptic_k(k))"
OTHER: dict[str, tuple[str, int, dict[str, Any]]] = {
    "cut by the domain": ("action-pendulum", 2, {"domain": {"where": ["theta > -1/2"]}}),
    "one side of a swing": ("action-pendulum", 2, {"domain": {"where": ["0 < theta < pi"]}}),
    "a coordinate of one sign": ("bead-on-a-parabola-action", 0, {"symbols": {
        "m": "positive", "g": "positive", "c": "positive", "q": "positive"}}),
    "above the barrier": ("double-well-action", 0, {"domain": {"where": ["s > 1"]}}),
    "roots in no order": ("cubic-well-action", 0, {"domain": {"where": ["a < c"]}}),
    "a spin that may be larger": ("polar-angle-action", 1, {"domain": {"where": ["0 < theta < pi"]}}),
    "a potential between its signs": ("poschl-teller-actions", 0, {
        "hamiltonian": {"H": "p**2/(2*m) - U/cosh(alpha*q)"}}),
    "a centre that may repel": ("sommerfeld-action", 0, {"symbols": {
        "r": "positive", "m": "positive", "c": "positive", "k": "real", "L": "positive", "E": "positive"}}),
    "a momentum of one sign": ("action-pendulum", 2, {"domain": {"where": ["p > 0"]}}),
    "a period that is half": ("action-pendulum", 3, {"claim": {"period": "pi"}}),
    "a rotation for a libration": ("action-pendulum", 2, {"claim": {"branch": "rotation"}}),
    "a libration for a rotation": ("action-pendulum", 3, {"claim": {"branch": "libration"}}),
    "an energy without librations": ("action-pendulum", 2, {"claim": {"fixed": {"E": "2*m*g*l"}}}),
    "the modulus for the parameter": ("action-pendulum", 2, {"claim": {"equals": PENDULUM.replace("(k)", "(k**2)")}}),
    "two wells": ("hookes-atom-action", 0, {"symbols": {
        "r": "real", "w": "positive", "a": "positive", "b": "positive"}}),
    "a momentum beside the root": ("relativistic-actions", 0, {
        "hamiltonian": {"H": "sqrt(p**2*c**2 + m**2*c**4) + k*q**2/2 + p/1000"}}),
    "a cosine of something else": ("action-pendulum", 2, {
        "hamiltonian": {"H": "p**2/(2*m*l**2) - m*g*l*cos(theta)*cos(g)"}}),
    "a power's other half": ("power-law-action", 0, {"symbols": {
        "m": "positive", "k": "positive", "n": "positive", "q": "positive"}}),
    "a power that may be negative": ("power-law-action", 0, {"symbols": {
        "m": "positive", "k": "positive", "n": "real"}}),
    "another power": ("power-law-action", 2, {"claim": {"fixed": {"n": "6"}}}),
    "an action for a frequency": ("cubic-well-action", 0, {"claim": {"kind": "frequency"}}),
}  # fmt: skip


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=() if OTHER[n][0] in SHORT else pytest.mark.slow) for n in OTHER]
)
def test_not_derived(name: str) -> None:
    """What isn't so, or isn't said clearly enough."""
    file, index, change = OTHER[name]
    right = tables(file, index)
    claim = {**right["claim"], **change.get("claim", {})}
    assert not found({**right, **{key: value for key, value in change.items() if key != "claim"}, "claim": claim})


ANGLES = {
    ("pendulum-angle", 1), ("pendulum-rotation-angle", 1), ("bead-on-a-parabola-angle", 1),
    ("action-angle-oscillator-forward", 0),
}  # fmt: skip


def advances(of: Any) -> bool:
    """Whether the checker derives that the angle of a map given forward advances by its period once."""
    return action_angle(Statement(of, {}, "proved")).trusted == ""


@pytest.mark.parametrize(("name", "index"), named(ANGLES))
def test_an_angle_that_is_given_forward(name: str, index: int) -> None:
    """By the frequency of the orbit through each point; not by another period, momentum, or H."""
    right = tables(name, index)
    assert advances(right)
    period = right["claim"].get("angle_period", "1")
    for other in (f"1001/1000*({period})", f"2*({period})", f"({period})/2", f"-({period})"):
        assert not advances({**right, "claim": {**right["claim"], "angle_period": other}})
    P = [f"1001/1000*({text})" for text in right["transformation"]["P"]]
    assert not advances({**right, "transformation": {**right["transformation"], "P": P}})


OTHER_ANGLES: dict[str, tuple[str, Any]] = {
    "a libration's, of rotations": ("pendulum-angle", {"domain": {"where": ["k > 1", "-pi < theta < pi", "p > 0"]}}),
    "a libration's, of both": ("pendulum-angle", {"domain": {"where": ["-pi < theta < pi", "p > 0"]}}),
    "a rotation's, of librations": (
        "pendulum-rotation-angle", {"domain": {"where": ["k < 1", "-pi < theta < pi", "p > 0"]}}),
    "of a wire that hangs down": ("bead-on-a-parabola-angle", {
        "hamiltonian": {"H": "p**2/(2*m*(1 + c**2*q**2)) - m*g*c*q**2/2"}}),
    "of an oscillator that may repel": ("action-angle-oscillator-forward", {
        "hamiltonian": {"H": "p**2/(2*m) - m*omega**2*q**2/2"}}),
    "of a barrier beside the well": ("action-angle-oscillator-forward", {
        "hamiltonian": {"H": "p**2/(2*m) + m*omega**2*q**2/2 - q**3/10**6"}}),
}  # fmt: skip


@pytest.mark.parametrize("name", OTHER_ANGLES)
def test_no_angle(name: str) -> None:
    file, change = OTHER_ANGLES[name]
    right = tables(file, next(index for stem, index in ANGLES if stem == file))
    assert not advances({**right, **change})
