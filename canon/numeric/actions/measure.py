"""The numbers of one branch at one energy, computed with as many digits as it takes.

Conditioning: none is left to pay. Energy, parameters and points are taken as exact, as written, and the digits that
cancel are computed in more; the bounds are of what is returned.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Final

from flint import arb

from canon.errors import InputError
from canon.numeric.actions.balls import Ball, precision
from canon.numeric.actions.bounded import Bounded, bounded
from canon.numeric.actions.branches import Branch, TooCoarse, signs_of
from canon.numeric.actions.course import Course, course_of, whole
from canon.numeric.actions.levels import Level
from canon.numeric.actions.orbit import Orbit
from canon.numeric.actions.rules import Quadrature

if TYPE_CHECKING:
    from canon.numeric.actions.motion import Motion

FIRST: Final = (384, 768, 1536, 3072, 6144)
WANTED: Final = 58


def measured(
    motion: Motion, level: Level, branch: Branch, angle: Callable[[Course], Ball] | None = None, side: int = 1
) -> Orbit:
    """The orbit on a branch. **Raises:** `InputError` where it is not bounded, or an angle is asked for in vain."""
    if branch.is_open:
        raise InputError(f"the motion at {level.text} is not bounded: {motion.ranges()}", "energy")
    if branch.on_separatrix:
        if angle is not None:
            raise InputError(
                f"{level.text} is exactly that of the separatrix: the period is infinite there and there is no angle; "
                f"the action is finite (`orbit` gives it). {motion.ranges()}",
                "energy",
            )
        return _on_separatrix(motion, level, branch)
    for bits in FIRST:
        with precision(bits):
            try:
                signs_of([node for node, _ in branch.inside], level.value(), last=False)
                course = course_of(motion.profile, branch, motion.domain, level.value(), side)
            except TooCoarse:
                continue
            found = whole(course, bits=WANTED, times=True)
            if found.hopeless:
                break
            if not found.resolved:
                continue
            J, T = found.values
            w = None if angle is None else angle(course)
            if w is not None and not w.is_finite():
                continue
            return _orbit(course, J, T, w, found.rule, found.nodes)
    flat = None if angle is not None else _with_flat_end(motion, level, branch)
    if flat is not None:
        return flat
    raise InputError(
        f"the integrals at {level.text} do not settle: H is too rough between the turning points for any rule", "H"
    )


def drifted(
    motion: Motion, level: Level, branch: Branch, side: int, drift: Callable[[Course], tuple[Ball, Ball]]
) -> tuple[Bounded, Bounded]:
    """What `drift` finds of a course, with as many digits as it takes. **Raises:** `InputError`."""
    if branch.is_open or branch.on_separatrix:
        measured(motion, level, branch, lambda course: course.E)
    for bits in FIRST:
        with precision(bits):
            course = course_of(motion.profile, branch, motion.domain, level.value(), side)
            first, second = drift(course)
            if first.is_finite() and second.is_finite():
                return bounded(first), bounded(second)
    raise InputError(f"the mean rate at {level.text} does not settle", "H")


def _orbit(course: Course, J: Ball, T: Ball, w: Ball | None, rule: str, nodes: int) -> Orbit:
    return Orbit(
        course.branch.kind,
        bounded(course.E),
        (bounded(course.low), bounded(course.high)),
        bounded(J),
        bounded(T),
        bounded(1 / T),
        None if w is None else bounded(w),
        rule,
        nodes,
    )


def _with_flat_end(motion: Motion, level: Level, branch: Branch) -> Orbit | None:
    """The action alone, where the slope of V seems to vanish at a turning point though V goes on to rise beyond it."""
    for bits in FIRST[1:3]:
        with precision(bits):
            course = course_of(motion.profile, branch, motion.domain, level.value())
            flat = [end for end in (course.low, course.high) if abs(motion.profile.slope(end)) < arb(2) ** (-bits // 4)]
            if course.rotates or not flat:
                return None
            found = whole(course, bits=WANTED, times=False)
            if found.resolved:
                where = f"{motion.profile.q} = {float(flat[0]):.10g}"
                note = f"V is level at the turning point {where}: the period is infinite, and there is no angle"
                return _action_alone(course, found, note)
    return None


def _action_alone(course: Course, found: Quadrature, note: str) -> Orbit:
    ends = (bounded(course.low), bounded(course.high))
    J = bounded(found.values[0])
    return Orbit(course.branch.kind, bounded(course.E), ends, J, None, None, None, found.rule, found.nodes, note)


def _on_separatrix(motion: Motion, level: Level, branch: Branch) -> Orbit:
    """The action alone, of the loop from the unstable point and back to it on the other side."""
    assert branch.ends is not None
    top = next(end.outer for end in branch.ends if end.kind == "unstable")
    for bits in FIRST[:3]:
        with precision(bits):
            course = course_of(motion.profile, branch, motion.domain, top.value())
            found = whole(course, bits=WANTED, times=False)
            if found.resolved:
                break
    else:
        raise InputError(f"the action at {level.text}, on the separatrix, does not settle", "energy")
    note = "on the separatrix: the period is infinite, the frequency 0, and there is no angle"
    if motion.domain.period is not None:
        note += "; J is that of libration, there and back: a rotation next to it has half of that"
    return _action_alone(course, found, note)
