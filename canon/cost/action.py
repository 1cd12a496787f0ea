"""What the digits of J = ∮ p dq cost: quadrature rules of more and more nodes, against Gauss–Legendre by mpmath."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, Final

import mpmath
from flint import arb

from canon.cost.clock import timed
from canon.cost.study import Point, Study
from canon.errors import InputError
from canon.numeric.actions.balls import ball_of, precision
from canon.numeric.actions.branches import branches_at
from canon.numeric.actions.course import Course, course_of
from canon.numeric.actions.wells import holds
from canon.scenes.actions import actions_of_scene
from canon.scenes.degrees import Degree
from canon.scenes.scene import Scene

BITS: Final = 160
DIGITS: Final = 40
NODES: Final = (4, 8, 16, 32, 64, 128, 256, 512)
LEVELS: Final = (1, 2, 3, 4, 5, 6, 7)
FAR: Final = 4.0
"""Beyond u = ±4 the weights of tanh-sinh are below 10⁻³⁶."""
FLOOR: Final = 1e-30

Momentum = Callable[[Any], Any]


def cost_of_action(scene: Scene, *, cap: float = 5.0) -> list[Study]:
    """One study for every degree of freedom that moves: the relative error of J by each rule.

    **Arguments:** `cap`, seconds that one sum may take.

    **Raises:** `InputError` where the scene is no bounded, separable Hamiltonian motion.
    """
    degrees = [each for each in actions_of_scene(scene).degrees if each.motion is not None and each.at is not None]
    studies = [_study(scene.title, degree, cap) for degree in degrees]
    if not studies:
        raise InputError("no degree of freedom of this scene oscillates: its actions are momenta, and cost nothing")
    return studies


def _study(title: str, degree: Degree, cap: float) -> Study:
    with precision(BITS):
        course = _course(degree)
        momentum = _momentum(course)
        exact = _reference(course, momentum)
        points = [
            Point(name, nodes, _error(value, exact), timing.median, timing.least, timing.first, timing.runs)
            for name, nodes, value, timing in _rules(course, momentum, cap)
        ]
    what = f"mpmath's Gauss–Legendre rule with {DIGITS} digits"
    return Study(
        "action", f"{title}: J of {degree.name}", "nodes", "relative, of J", what, FLOOR, tuple(points),
    )  # fmt: skip


def _course(degree: Degree) -> Course:
    """The orbit's way between its turning points, or over a period."""
    motion, at = degree.motion, degree.at
    assert motion is not None
    assert at is not None
    q, p = (ball_of(value) for value in at)
    energy = motion.profile.energy(q, p)
    found = branches_at(motion.nodes, motion.domain, energy, last=True)
    branch = next((each for each in found if holds(each, q, motion.domain)), found[0])
    side = -1 if motion.profile.middle_momentum(q) > p else 1
    return course_of(motion.profile, branch, motion.domain, energy, side)


def _momentum(course: Course) -> Momentum:
    """p(q) of the branch: of a libration half the distance between its two values."""
    profile, E = course.profile, course.E
    if course.rotates:
        return lambda q: profile.outward(q, E, course.side)[0]
    return lambda q: (profile.outward(q, E, 1)[0] - profile.outward(q, E, -1)[0]) / 2


def _rules(course: Course, momentum: Momentum, cap: float) -> Iterator[tuple[str, int, Any, Any]]:
    turns = 1 if course.rotates else 2
    low, length = course.low.mid(), (course.high - course.low).mid()
    rules: list[tuple[str, Callable[[int], Any], tuple[int, ...]]] = [
        ("midpoints", lambda count: _midpoints(momentum, low, length, count), NODES),
        ("tanh-sinh", lambda level: _tanh_sinh(momentum, low, length, level), LEVELS),
    ]
    if not course.rotates:
        rules.insert(0, ("Gauss-Chebyshev", lambda count: _chebyshev(momentum, low, length, count), NODES))
    for name, rule, sizes in rules:
        for size in sizes:
            (value, nodes), timing = timed(lambda rule=rule, size=size: rule(size), cap=cap)
            yield name, nodes, turns * value, timing
            if 2 * timing.median > cap:
                break


def _midpoints(momentum: Momentum, low: Any, length: Any, count: int) -> tuple[Any, int]:
    """Equidistant nodes: of a rotation the best there is, of a libration what roots at the ends make slow."""
    total = sum((momentum(low + length * arb(2 * k + 1) / (2 * count)) for k in range(count)), start=arb(0))
    return total * length / count, count


def _chebyshev(momentum: Momentum, low: Any, length: Any, count: int) -> tuple[Any, int]:
    """Equidistant in the angle θ of q = mid − half cos θ."""
    total = arb(0)
    for k in range(count):
        sine, cosine = (arb.pi() * (2 * k + 1) / (2 * count)).sin_cos()
        total = total + momentum(low + length * (1 - cosine) / 2) * sine
    return total * length / 2 * arb.pi() / count, count


def _tanh_sinh(momentum: Momentum, low: Any, length: Any, level: int) -> tuple[Any, int]:
    h, total, nodes = arb(1) / 2**level, arb(0), 0
    for k in range(-int(FAR * 2**level), int(FAR * 2**level) + 1):
        u = h * k
        fraction = 1 / (1 + (-arb.pi() * u.sinh()).exp())
        weight = arb.pi() * u.cosh() * fraction * (1 - fraction)
        value = momentum(low + length * fraction)
        if value.is_finite():
            total, nodes = total + value * weight, nodes + 1
    return total * length * h, nodes


def _reference(course: Course, momentum: Momentum) -> Any:
    """J by another library's nodes, in the angle θ where the ends are turning points."""
    low, length = course.low.mid(), (course.high - course.low).mid()

    def at(x: Any) -> Any:
        fraction = arb(mpmath.nstr(x, DIGITS + 8))
        if course.rotates:
            return _mp(momentum(low + length * fraction))
        sine, cosine = (arb.pi() * fraction).sin_cos()
        return _mp(momentum(low + length * (1 - cosine) / 2) * sine * arb.pi() / 2)

    with mpmath.workdps(DIGITS + 5):
        parts = mpmath.linspace(0, 1, 9)
        total = mpmath.quad(at, parts, method="gauss-legendre")
        return total * _mp(length) * (1 if course.rotates else 2)


def _mp(ball: Any) -> Any:
    return mpmath.mpf(ball.mid().str(DIGITS + 8, radius=False))


def _error(value: Any, exact: Any) -> float:
    with mpmath.workdps(DIGITS + 5):
        return float(abs(_mp(value) - exact) / abs(exact))
