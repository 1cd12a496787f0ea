"""Unilateral constraints: strings, which pull and do not push, on top of a method for holonomic ones.

A taut string is a constraint g = 0 until its multiplier, the tension by its length, becomes negative; a slack one is
none until g, which is negative then, comes back to 0. Either time is found by bisection, to rounding, with steps of
the method itself; the rest of the step goes on from there. A string that becomes taut takes away the momentum with
which it would be stretched: the jerk is perfectly inelastic. Brogliato (2016), Nonsmooth Mechanics, 5.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Final, NamedTuple

from canon.numeric.integrators.composed import OneStep
from canon.numeric.integrators.constrained import Held, gradients, reactions
from canon.numeric.integrators.multipliers import along, combined, dot, products, solve_active
from canon.numeric.integrators.problem import State
from canon.numeric.integrators.stepper import Stepper, Time
from canon.numeric.integrators.traits import Traits

MOST_EVENTS: Final = 32
"""In a step: where a string becomes taut and slack more often, the run ends."""
LOGGED: Final = 1024
"""Events that are kept."""
BISECTIONS: Final = 54
STRETCHED: Final = 1e-13
"""Of the squared length: by so much a slack string may be too long, so that rounding doesn't pull it taut."""
TAUT: Final = 1e-9
"""Of the squared length: a string that is so nearly taut at the beginning is taken to be so."""


class Events(NamedTuple):
    """When (k,) which string (k,) became taut, 1, or slack, 0, and the energy (k,) that was lost; `count` of them."""

    times: Any
    strings: Any
    taut: Any
    lost: Any
    count: Any


class _Carry(NamedTuple):
    state: State
    active: Any
    """1 for every constraint that acts, 0 for a slack string; −1 where it isn't known yet."""
    events: Events


@dataclass(frozen=True)
class WithStrings:
    """A method for holonomic constraints that also knows of strings."""

    base: OneStep

    @property
    def name(self) -> str:
        """That of the method."""
        return self.base.name

    @property
    def traits(self) -> Traits:
        """Those of the method, between events."""
        return self.base.traits

    @property
    def source(self) -> str:
        """That of the method."""
        return self.base.source

    def stepper(self, problem: Any, *, compensated: bool = False) -> Stepper:
        """The method set up for a problem, with the search for events where it has strings."""
        if not getattr(problem, "strings", ()):
            return self.base.stepper(problem, compensated=compensated)
        return _stepper(self.base, problem)


def events_in(carry: Any) -> Events | None:
    """The events of a run, from what its steps carry; None where there are no strings."""
    return carry.events if isinstance(carry, _Carry) else None


def _stepper(base: OneStep, problem: Held) -> Stepper:
    import jax.numpy as jnp
    from jax import lax

    strings = problem.strings

    def moved(state: State, active: Any, t: Any, h: Any) -> State:
        return base.build(replace(problem, strings=(), active=active))(state, t, h)

    def margins(state: State, active: Any, t: Any) -> Any:
        """By how much each string is from its next event: its multiplier, or what it is too short by."""
        q, p = state[0], state[1]
        multipliers = reactions(replace(problem, active=active), q, p, t)
        values, rows, _ = gradients(problem, q, t)
        slack = [STRETCHED * dot(rows[k], rows[k]) - values[k] for k in strings]
        return jnp.stack(
            [jnp.where(active[k] > 0, multipliers[k], room) for k, room in zip(strings, slack, strict=True)]
        )

    def switched(state: State, active: Any, t: Any) -> tuple[State, Any, Any]:
        """The state after the jerk of the strings that have just become taut, and what acts from then on."""
        q, p, *others = state
        _, rows, rates = gradients(problem, q, t)
        velocity = problem.rates(q, p, t)[0]
        pulls = problem.pulls(q, p, t, rows)
        matrix, missed = products(rows, pulls), along(rows, velocity, rates)
        small = -TAUT * jnp.max(jnp.abs(p))
        impulses = solve_active(active, matrix, missed)
        for _ in strings:
            # a string does not push: one that would is let go, and the others are jerked without it
            for k in strings:
                pushing = impulses[k] * jnp.sqrt(dot(rows[k], rows[k])) < small
                active = active.at[k].set(jnp.where(pushing, 0.0, active[k]))
            impulses = solve_active(active, matrix, missed)
        held = replace(problem, active=active)
        after = p - combined(impulses, rows)
        lost = dot(p - after, velocity + held.rates(q, after, t)[0]) / 2
        state = (q, after, *others)
        multipliers = jnp.asarray(reactions(held, q, after, t))
        loose = jnp.stack([multipliers[k] < 0 if k in strings else jnp.asarray(False) for k in range(len(rows))])
        return state, jnp.where(loose, 0.0, active), lost

    def happened(state: State, active: Any, t: Any, rest: Any, events: Events) -> Any:
        """To the first event, and through it."""

        def halve(_: Any, span: Any) -> Any:
            low, high = span
            middle = (low + high) / 2
            beyond = jnp.min(margins(moved(state, active, t, middle), active, t + middle)) < 0
            return jnp.where(beyond, low, middle), jnp.where(beyond, middle, high)

        _, passed = lax.fori_loop(0, BISECTIONS, halve, (jnp.zeros_like(rest), rest))
        there, when = moved(state, active, t, passed), t + passed
        over = margins(there, active, when) < 0
        flipped = active
        for place, k in enumerate(strings):
            flipped = flipped.at[k].set(jnp.where(over[place], 1 - active[k], active[k]))
        after, left, lost = switched(there, flipped, when)
        pulled = jnp.any(flipped > active)
        shift = after[1] - there[1]
        felt = pulled & (dot(shift, shift) > (TAUT**2) * dot(there[1], there[1]))
        there = tuple(jnp.where(pulled, new, old) for new, old in zip(after, there, strict=True))
        left = jnp.where(pulled, left, flipped)
        index = jnp.minimum(events.count, LOGGED - 1)
        events = Events(
            events.times.at[index].set(when),
            events.strings.at[index].set(jnp.asarray(strings)[jnp.argmax(over)]),
            events.taut.at[index].set(jnp.where(pulled, 1.0, 0.0)),
            events.lost.at[index].set(jnp.where(pulled, lost, 0.0)),
            # a string that is found taut at once where it has just gone slack, by rounding, is no event
            events.count + jnp.where(felt | jnp.any(left != active), 1, 0),
        )
        return there, left, passed, events

    def initial(state: State) -> Any:
        empty = jnp.zeros(LOGGED)
        events = Events(empty, jnp.zeros(LOGGED, dtype=int), empty, empty, jnp.zeros((), dtype=int))
        unknown = jnp.full(len(problem.constraints(jnp.asarray(state[0]), 0.0)), -1.0)
        return _Carry(tuple(jnp.asarray(slot) for slot in state), unknown, events)

    def begin(carry: Any, tables: Any, time: Time) -> Any:
        """Which strings are taut at the very beginning: those of full length that would have a tension."""
        state, active, events = carry
        values, rows, _ = gradients(problem, state[0], time.at(0.0))
        full = [values[k] > -TAUT * dot(rows[k], rows[k]) if k in strings else True for k in range(len(rows))]
        held = jnp.stack([jnp.where(jnp.asarray(whole), 1.0, 0.0) for whole in full])
        speeds = [dot(row, problem.rates(state[0], state[1], time.at(0.0))[0]) for row in rows]
        inward = [
            speeds[k] < -TAUT * jnp.sqrt(dot(rows[k], rows[k])) if k in strings else False for k in range(len(rows))
        ]
        held = jnp.where(jnp.stack([jnp.asarray(x) for x in inward]), 0.0, held)
        after, held, lost = switched(state, held, time.at(0.0))
        unknown = active[0] < 0
        # a body that is thrown outwards at full length is jerked at once
        jerked = unknown & (dot(state[1] - after[1], state[1] - after[1]) > (TAUT**2) * dot(state[1], state[1]))
        events = Events(
            events.times.at[0].set(jnp.where(jerked, time.at(0.0), events.times[0])),
            events.strings.at[0].set(jnp.where(jerked, strings[0], events.strings[0])),
            events.taut.at[0].set(jnp.where(jerked, 1.0, events.taut[0])),
            events.lost.at[0].set(jnp.where(jerked, lost, events.lost[0])),
            jnp.where(jerked, 1, events.count),
        )
        state = tuple(jnp.where(unknown, new, old) for new, old in zip(after, state, strict=True))
        return _Carry(state, jnp.where(unknown, held, active), events)

    def step(carry: Any, tables: Any, time: Time) -> Any:
        t, h = time.at(0.0), time.h

        def onward(loop: Any) -> Any:
            (state, active, events), done, count = loop
            rest = h - done
            trial = moved(state, active, t + done, rest)
            quiet = (trial, active, rest, events)
            found = lax.cond(
                jnp.min(margins(trial, active, t + h)) < 0,
                lambda: happened(state, active, t + done, rest, events),
                lambda: quiet,
            )
            state, active, passed, events = found
            return _Carry(state, active, events), jnp.where(passed >= rest, h, done + passed), count + 1

        begun = (carry, jnp.zeros_like(h * 1.0), 0)
        carry, done, _ = lax.while_loop(lambda loop: (loop[1] < h) & (loop[2] < MOST_EVENTS), onward, begun)
        whole = done >= h
        return carry._replace(state=tuple(jnp.where(whole, slot, jnp.nan) for slot in carry.state))

    return Stepper(
        prepare=lambda h: None,
        initial=initial,
        begin=begin,
        step=step,
        end=lambda carry, tables, time: carry,
        read=lambda carry: carry.state,
    )
