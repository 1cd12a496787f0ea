"""Actions at a separatrix, as the checker derives them, against quadrature; and motions that it can't tell apart."""

from typing import Any

import mpmath
import pytest

from canon.checker.intervals import Intervals
from canon.checker.kinds import obligations
from canon.checker.points import Numbers
from canon.checker.statement import Statement

VALUES = {"a": mpmath.mpf(3) / 2, "b": mpmath.mpf(5) / 7}
CUBIC, WELLS, DUFFING = "p**2/2 + a**2*q**2/2 - b*q**3/3", "p**2/2 - q**2*(q + 1)*(2 - q)/2", "p**2/2 - a*q**2 + b*q**4"
BARRIERS, PENDULUM = "p**2/2 - a*(1 - q**2)**2/2", "p**2/(2*b) - a*cos(q)"
TOP = {"E": "a**6/(6*b**2)"}
ZERO, UP = {"E": "0"}, {"E": "a"}
ROTATION = {"branch": "rotation", "fixed": UP}
Claim = dict[str, Any]
FOUND: dict[str, tuple[str, Claim, tuple[float, float], float]] = {
    "a cubic": (CUBIC, {"fixed": TOP}, (-63 / 40, 63 / 20), 2),
    "a cubic, turned round": (CUBIC.replace("- b", "+ b"), {"fixed": TOP}, (-63 / 20, 63 / 40), 2),
    "about its well": (CUBIC, {"fixed": TOP, "well": "0"}, (-63 / 40, 63 / 20), 2),
    "the left of two loops": (WELLS, {"fixed": ZERO, "well": "-1/2"}, (-1, 0), 2),
    "the right of two loops": (WELLS, {"fixed": ZERO, "well": "1"}, (0, 2), 2),
    "one of two equal loops": (DUFFING, {"fixed": ZERO}, (0, (21 / 10) ** 0.5), 2),
    "between two barriers": (BARRIERS, {"fixed": ZERO}, (-1, 1), 2),
    "a pendulum": (PENDULUM, {"fixed": UP}, (-mpmath.pi, mpmath.pi), 2),
    "a pendulum going round": (PENDULUM, ROTATION, (-mpmath.pi, mpmath.pi), 1),
}
HALF = {"symbols": {"a": "positive", "b": "positive", "q": "positive"}}
OPEN: dict[str, tuple[str, Claim, Claim]] = {
    "two loops": (WELLS, {"fixed": ZERO}, {}),
    "a well where the motion rests": (WELLS, {"fixed": ZERO, "well": "0"}, {}),
    "a well beyond": (WELLS, {"fixed": ZERO, "well": "5/2"}, {}),
    "a well that a parameter moves": (WELLS, {"fixed": ZERO, "well": "a - 1"}, {}),
    "another energy": (CUBIC, {"fixed": {"E": "a**6/(6*b**2) - 1/1000"}}, {}),
    "a loop that a wall cuts": (CUBIC, {"fixed": TOP}, HALF),
    "a loop that the domain cuts": (CUBIC, {"fixed": TOP}, {"domain": {"where": ["q < a"]}}),
    "a momentum of one sign": (CUBIC, {"fixed": TOP}, {"domain": {"where": ["p > 0"]}}),
    "half a pendulum": (PENDULUM, {"fixed": UP}, HALF),
    "a pendulum with a well": (PENDULUM, {"fixed": UP, "well": "0"}, {}),
    "a period of two turns": (PENDULUM, {**ROTATION, "period": "4*pi"}, {}),
    "a pendulum upside down": ("p**2/(2*b) - c*cos(q)", {"fixed": {"E": "c"}}, {}),
    "barriers that a wall cuts": (BARRIERS, {"fixed": ZERO}, {"domain": {"where": ["-1/2 < q"]}}),
    "a mass that isn't positive": ("p**2/(2*c) + q**2/2 - q**3/3", {"fixed": {"E": "1/6"}}, {}),
    "a barrier of any sign": ("p**2/2 + q**2/2 - c*q**3/3", {"fixed": {"E": "1/(6*c**2)"}}, {}),
}


def case(H: str, claim: Claim, tables: Claim, verdict: str = "proved") -> tuple[Statement, Any]:
    symbols = {"a": "positive", "b": "positive", "c": "real"}
    everything = {
        "phase_space": {"q": ["q"], "p": ["p"]},
        "symbols": symbols,
        "hamiltonian": {"H": H},
        **tables,
        "claim": {"kind": "action", "coordinate": "q", "energy": "E", "equals": "a", **claim},
    }
    s = Statement(everything, {}, verdict)
    (found,) = obligations(s)
    return s, found


@pytest.mark.parametrize("name", FOUND)
def test_the_action_is_the_integral(name: str) -> None:
    H, claim, ends, times = FOUND[name]
    s, found = case(H, claim, {}, "refuted")
    (zero,) = found.zeros
    own = Intervals(30)
    value = own.values(s.f, [zero], {n: own.iv.mpf(str(x)) for n, x in VALUES.items()})[zero] + own.iv.mpf("1.5")
    level, rest = s.f.read(claim["fixed"]["E"], {}), s.f.substitute(s.H, {"p": s.f.number(0)})
    room, speed = s.f.sub(level, rest), s.f.slope(s.f.slope(s.H, "p"), "p")
    D = s.f.over(s.f.mul(s.f.number(2), room), speed)
    numbers = Numbers(20)
    square = lambda q: abs(numbers.values(s.f, [D], {**VALUES, "q": q})[D])
    total: Any = mpmath.quad(lambda q: mpmath.sqrt(square(q)), [ends[0], sum(ends) / 2, ends[1]])
    assert abs(float(value.mid) / float(times * total) - 1) < 1e-6


@pytest.mark.parametrize("name", OPEN)
def test_a_motion_that_is_not_the_only_one_is_measured_alone(name: str) -> None:
    assert not case(*OPEN[name])[1].zeros
