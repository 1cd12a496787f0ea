"""Between which energies the branches of a well exist, and which actions they have: from barrier to barrier.

A libration's action grows with the energy up to that of its separatrix, the energy of the lower barrier. Above it the
wells on both sides are one, whose action begins with the sum of theirs: in between there is none.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from flint import arb

from canon.errors import InputError
from canon.numeric.actions.balls import Ball
from canon.numeric.actions.branches import Branch, End, branches_at
from canon.numeric.actions.course import course_of, whole
from canon.numeric.actions.landscape import Critical
from canon.numeric.actions.levels import barrier_of
from canon.numeric.actions.wells import holds

if TYPE_CHECKING:
    from canon.numeric.actions.motion import Motion

_BITS: Final = 58


class Reach(NamedTuple):
    """The energies `low` to `high` of a branch, with no upper one where `high` is None."""

    low: Ball
    high: Ball | None


def rotation_reach(motion: Motion, J: Ball) -> Reach:
    """The energies of rotations. **Raises:** `InputError` where there are none, or J is too small for one."""
    if motion.domain.period is None:
        raise InputError(f"there are no rotations: {motion.profile.q} is no angle", "branch")
    tops = [node for node in motion.nodes if node.kind < 0]
    if not tops:
        return Reach(motion.profile.potential(arb(0)), None)
    top = max(tops, key=lambda node: float(node.value()))
    if not top.value().is_finite():
        raise InputError(f"there are no rotations: the barrier at {float(top):.6g} is infinite", "branch")
    # on the separatrix the way there and back, of all that lies between two such barriers
    least = sum((_action(motion, each, top.value()) for each in _at(motion, top.value())), start=arb(0)) / 2
    if least > J:
        raise InputError(f"rotations have actions above {float(least):.10g}, unlike {float(J):.10g}", "action")
    return Reach(top.value(), None)


def libration_reach(motion: Motion, J: Ball, lowest: Critical) -> Reach:
    """The energies of the libration of action J around a minimum, over barriers where it takes that.

    **Raises:** `InputError` where there is none, with the actions that there are.
    """
    low = lowest.value()
    try:
        top: Critical | None = barrier_of(motion.nodes, lowest)
    except InputError:
        top = None
    while top is not None and top.kind < 0:
        E = top.value()
        chain, own = _chain(motion, E, lowest)
        most = _action(motion, own, E)
        if most > J:
            return Reach(low, E)
        words = f"librations about {motion.profile.q} = {float(lowest):.6g} have actions below {float(most):.10g}"
        if len(chain) == 1 or any(each.is_open for each in chain) or _goes_round(chain):
            raise InputError(f"{words}, unlike {float(J):.10g}: choose another branch or well", "action")
        beyond = sum((_action(motion, each, E) for each in chain), start=arb(0))
        if not beyond < J:
            raise InputError(
                f"{words} or, over the barrier, above {float(beyond):.10g}, unlike {float(J):.10g}", "action"
            )
        low, top = E, _lid(chain)
    return Reach(low, None if top is None else top.value())


def _at(motion: Motion, E: Ball) -> tuple[Branch, ...]:
    return branches_at(motion.nodes, motion.domain, E, last=True)


def _action(motion: Motion, branch: Branch, E: Ball) -> Ball:
    course = course_of(motion.profile, branch, motion.domain, E)
    found = whole(course, bits=_BITS, times=False)
    if not found.resolved:
        raise InputError(f"the action at the barrier at E = {float(E):.17g} does not settle", "action")
    return found.values[0]


def _chain(motion: Motion, E: Ball, lowest: Critical) -> tuple[list[Branch], Branch]:
    """The branches that become one above the energy E of a barrier, and that of a minimum among them."""
    chains: list[list[Branch]] = [[]]
    for branch in _at(motion, E):
        assert branch.ends is not None
        before = chains[-1][-1].ends if chains[-1] else None
        if before is None or not _joined(before[1], branch.ends[0]):
            chains.append([])
        chains[-1].append(branch)
    for chain in chains:
        for branch in chain:
            if holds(branch, lowest.place(), motion.domain):
                return chain, branch
    raise InputError(f"there is no libration at E = {float(E):.17g}: {motion.ranges()}", "action")


def _joined(left: End, right: End) -> bool:
    """Whether two ends are the same unstable point, up to periods."""
    return left.kind == right.kind == "unstable" and left.outer is right.outer


def _goes_round(chain: list[Branch]) -> bool:
    """Whether the chain closes over a period, so that what is above it rotates."""
    first, last = chain[0].ends, chain[-1].ends
    return first is not None and last is not None and _joined(last[1], first[0])


def _lid(chain: list[Branch]) -> Critical | None:
    """The lower of the barriers at the two ends of a chain; None where there is none of finite height."""
    first, last = chain[0].ends, chain[-1].ends
    assert first is not None
    assert last is not None
    tops = [node for node in (first[0].outer, last[1].outer) if node.kind <= 0 and node.value().is_finite()]
    return min(tops, key=lambda node: float(node.value())) if tops else None
