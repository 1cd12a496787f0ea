"""Rigid bodies on the Lie–Poisson structure of so(3)*: splittings into rotations, exact tops, and torques.

The slots are (attitude, M): a unit quaternion (4, …) from body to space, and the angular momentum (3, …) in the body's
frame, with Ṁ = M × ω + K. Rotations keep |M| and the attitude's norm, whatever the step. McLachlan (1993), Phys. Rev.
Lett. 71, 3043; Touma and Wisdom (1994), Astron. J. 107, 1189.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from canon.errors import InputError
from canon.numeric.integrators.problem import ExactPart, Part, Shear, Splitting, State
from canon.numeric.rotations import about_axis, multiply, normalised, rotate


def rigid_body(
    moments: Sequence[float],
    torque: Callable[..., Any] | None = None,
    *,
    time_dependent: bool = False,
    frame: str = "body",
    exact: bool = False,
) -> Splitting:
    """Euler's equations and the attitude, split.

    **Arguments:** `moments` of inertia (3,), positive; `torque(attitude)`, or `torque(attitude, t)` where it is
    `time_dependent`, in the "body"'s frame or in "space"; `exact`: the free motion is one part, in elliptic functions,
    in place of three rotations: steps are then as long as the torque allows.

    **Raises:** `InputError` where a moment is not positive, or two of them are smaller than the third.
    """
    I = check_moments(moments)
    free = [_top(I)] if exact else [rotation_part(axis, I[axis]) for axis in range(3)]
    if torque is None:
        return Splitting(tuple(free))
    kick = torque_part(torque, time_dependent=time_dependent, frame=frame)
    parts: tuple[Part, ...] = (*free, kick)
    return Splitting(parts, 0 if time_dependent else None)


def rigid_bodies(
    moments: Sequence[Sequence[float]],
    torque: Callable[[Any, Any], Any] | None = None,
    *,
    time_dependent: bool = False,
    attitude: bool = True,
    closed: bool = True,
) -> Splitting:
    """Several bodies, in slots (attitudes (4k, …), momenta (3k, …)); without `attitude` the first slot is left alone.

    **Arguments:** `moments` of each; `torque(state, t)` returns (3k, …), in the bodies' frames. Without a torque the
    free motion is one part, in closed form, unless `closed` is False. Else bodies with two equal moments move in closed
    form, between kicks, and others by three rotations, which cost less than elliptic functions.

    **Raises:** `InputError` as `rigid_body` does.
    """
    checked = [check_moments(I) for I in moments]
    slow = [len({*I}) == 3 for I in checked]
    if (torque is None and closed) or not any(slow):
        free = [_all_of([_free(I, attitude) for I in checked], attitude, "free tops")]
    else:
        firsts = [_turning(0, I[0], attitude) if s else _free(I, attitude) for I, s in zip(checked, slow, strict=True)]
        free = [_all_of(firsts, attitude, "M_1^2/2I_1" if all(slow) else "M_1^2/2I_1 and free tops")]
        for axis in (1, 2):
            turning = [_turning(axis, I[axis], attitude) if s else _still for I, s in zip(checked, slow, strict=True)]
            free.append(_all_of(turning, attitude, f"M_{axis + 1}^2/2I_{axis + 1}"))
    if torque is None:
        return Splitting(tuple(free))
    kick = Shear((1,), lambda state, t: (torque(state, t),), "torque")
    # the kick moves momenta alone and the free motion is quadratic in them, as for T(p) + V(q)
    return Splitting((*free, kick), 0 if time_dependent else None, nystrom=len(free) == 1)


_Motion = Callable[[Any, Any, Any], tuple[Any, Any]]


def _still(attitude: Any, M: Any, h: Any) -> tuple[Any, Any]:
    return attitude, M


def _free(I: tuple[float, float, float], turning: bool) -> _Motion:
    from canon.numeric.exact.free_top import free_momentum, free_top

    if turning:
        return lambda attitude, M, h: free_top(attitude, M, I, h)
    return lambda attitude, M, h: (attitude, free_momentum(M, I, h))


def _turning(axis: int, moment: float, turning: bool) -> _Motion:
    """About one axis, by the angle M_i h/I_i."""
    part = rotation_part(axis, moment, attitude=turning)
    return lambda attitude, M, h: part.flow((attitude, M), h, None)[:2]


def _all_of(motions: Sequence[_Motion], turning: bool, name: str) -> ExactPart:
    """The bodies' motions side by side."""

    def flow(state: State, h: Any, t: Any) -> State:
        import jax.numpy as jnp

        attitudes, momenta, *others = state
        if len(motions) == 1:
            return (*motions[0](attitudes, momenta, h), *others)
        moved = [
            motion(attitudes[4 * k : 4 * k + 4] if turning else attitudes, momenta[3 * k : 3 * k + 3], h)
            for k, motion in enumerate(motions)
        ]
        after = jnp.concatenate([each for each, _ in moved]) if turning else attitudes
        return (after, jnp.concatenate([each for _, each in moved]), *others)

    return ExactPart(flow, name=name)


def check_moments(moments: Sequence[float]) -> tuple[float, float, float]:
    """The principal moments of inertia of a body that can be."""
    I = tuple(float(moment) for moment in moments)
    if len(I) != 3 or min(I) < 0 or sorted(I)[1] <= 0 or max(I) > (sum(I) - max(I)) * (1 + 1e-12):
        raise InputError(f"{list(moments)} are no principal moments of inertia: each is at most the sum of the others")
    if min(I) == 0:
        raise InputError("a moment of inertia 0 leaves the rotation about that axis undefined: give it a small one")
    return I  # pyright: ignore[reportReturnType]


def rotation_part(axis: int, moment: float, *, attitude: bool = True) -> ExactPart:
    """The flow of M_i²/2I_i: M and, unless it is left alone, the attitude turn about the body's axis i by M_i h/I_i."""
    j, k = (axis + 1) % 3, (axis + 2) % 3

    def flow(state: State, h: Any, t: Any) -> State:
        import jax.numpy as jnp

        placed, M, *others = state
        angle = h * M[axis] / moment
        c, s = jnp.cos(angle), jnp.sin(angle)
        turned = [M[axis]] * 3
        turned[j], turned[k] = c * M[j] + s * M[k], c * M[k] - s * M[j]
        turn = normalised(multiply(placed, about_axis(axis, angle))) if attitude else placed
        return (turn, jnp.stack(turned), *others)

    return ExactPart(flow, name=f"M_{axis + 1}^2/2I_{axis + 1}")


def torque_part(torque: Callable[..., Any], *, time_dependent: bool = False, frame: str = "body") -> Shear:
    """Ṁ = K(attitude, t), at a fixed attitude; a torque in "space" is turned into the body's frame."""
    from canon.numeric.rotations import conjugate

    def rate(state: State, t: Any) -> tuple[Any]:
        K = torque(state[0], t) if time_dependent else torque(state[0])
        return (rotate(conjugate(state[0]), K) if frame == "space" else K,)

    return Shear((1,), rate, "torque")


def _top(moments: tuple[float, float, float]) -> ExactPart:
    def flow(state: State, h: Any, t: Any) -> State:
        from canon.numeric.exact.free_top import free_top

        attitude, M, *others = state
        return (*free_top(attitude, M, moments, h), *others)

    return ExactPart(flow, name="free top")
