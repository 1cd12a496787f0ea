"""Störmer's explicit multistep methods for H = T(p) + V(q, t) with T quadratic: one force a step, at a high order.

    q_{n+1} − 2 q_n + q_{n−1} = h² Σ_j β_j a_{n−j},   β from the polynomial through the last k accelerations.

Summed once, it looks like a leapfrog whose kick knows the past: π += h Σ β_j F_{n−j}, q += h T'(π), where π stays by a
fixed combination of the past forces beside the momentum, which is made of both where it is asked for. Per step these
are the cheapest methods there are for smooth motions; they keep no structure, and where h is too long they blow up.

With compensated sums, the second differences of the forces are what is remembered and summed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final, NamedTuple

import numpy as np

from canon.errors import InputError
from canon.numeric.compensated import add_small_product
from canon.numeric.integrators.compositions import SOFRONIOU_SPALETTA_10
from canon.numeric.integrators.multistep_weights import sums_of
from canon.numeric.integrators.nystrom_8 import NYSTROM_8
from canon.numeric.integrators.problem import Shear, Splitting, State
from canon.numeric.integrators.splitting import SplittingMethod
from canon.numeric.integrators.stepper import Past, Stepper, Time
from canon.numeric.integrators.traits import Traits

WRITTEN_OUT: Final = 12
"""Coordinates up to which one orbit is computed number by number: XLA makes one native loop of that."""


@dataclass(frozen=True)
class Stormer:
    """The method of `terms` forces, each run begun by steps of `starter` into the past."""

    name: str
    traits: Traits
    terms: int
    starter: SplittingMethod
    source: str

    @property
    def stages(self) -> int:
        """Forces in a step."""
        return 1

    def stepper(self, problem: Any, *, compensated: bool = False) -> Stepper:
        """The method set up for two shears T(p) and V(q, t) on slots (q, p).

        **Raises:** `InputError` for anything else: the forces of the past must tell the acceleration.
        """
        parts = problem.parts if isinstance(problem, Splitting) and problem.nystrom else ()
        if [part.slots for part in parts if isinstance(part, Shear)] != [(0,), (1,)]:
            raise InputError(
                f"{self.name} is for H = T(p) + V(q, t) with T quadratic, split as that: choose a splitting method"
            )
        return _stepper(self, problem, compensated)


class _Carry(NamedTuple):
    """After step n: the state that is shown, q_n and π_n, and the remembered values, the newest at `place`.

    With compensated sums there are the last `force` and its difference `slope`, and what rounding `lost` of q and π.
    """

    shown: State
    started: Any
    place: Any
    q: Any
    pi: Any
    ring: Any
    force: Any
    slope: Any
    lost: Any


def _stepper(method: Stormer, problem: Splitting, compensated: bool) -> Stepper:
    import jax
    import jax.numpy as jnp
    from jax import lax

    kinetic, potential = (part for part in problem.parts if isinstance(part, Shear))
    clocked = problem.clock is not None
    sums = sums_of(method.terms, compensated)
    kept = len(sums.kick)
    starter = lru_cache(1)(lambda: method.starter.stepper(problem))
    each = jax.tree.map

    def force(q: Any, shown: State, time: Time, fraction: float) -> Any:
        whole = _whole(q, shown[0])
        return _components(potential.rate((whole, whole), time.at(fraction) if clocked else None)[0])

    def velocity(pi: Any, shown: State) -> Any:
        whole = _whole(pi, shown[1])
        return _components(kinetic.rate((whole, whole), None)[0])

    def initial(state: State) -> _Carry:
        q, p = map(_components, state)
        zero = each(lambda x: np.zeros(jnp.shape(x)), q)
        ring = each(lambda x: np.zeros((kept, *jnp.shape(x))), q)
        more = (zero, zero, (zero, zero)) if compensated else (None, None, None)
        return _Carry(state, np.asarray(False), np.asarray(0), q, p, ring, *more)

    def past(state: State, tables: Any, time: Time) -> State:
        """The states before a state (terms, …), itself first."""
        first, begun, back = starter(), time.at(0.0), -time.h

        def earlier(j: Any, loop: Any) -> Any:
            carry, states = loop
            before, after = Time(begun, back, j * 1.0), Time(begun, back, j + 1.0)
            carry = first.end(first.step(first.begin(carry, tables, before), tables, before), tables, after)
            return carry, each(lambda rows, x: rows.at[j + 1].set(x), states, first.read(carry))

        rows = each(lambda x: jnp.zeros((method.terms, *jnp.shape(x))).at[0].set(x), state)
        return lax.fori_loop(0, method.terms - 1, earlier, (first.initial(state), rows))[1]

    def started(carry: _Carry, states: State, time: Time) -> _Carry:
        def at(j: int) -> Any:
            state = each(lambda rows: rows[j], states)
            return force(_components(state[0]), state, Time(time.at(0.0), -time.h, j * 1.0), 0.0)

        forces = each(lambda *rows: jnp.stack(rows), *(at(j) for j in range(method.terms)))
        slopes = each(lambda rows: rows[:-1] - rows[1:], forces)
        values = each(lambda rows: rows[:-1] - rows[1:], slopes) if compensated else forces
        made = carry._replace(
            started=jnp.asarray(True),
            force=each(lambda rows: rows[0], forces) if compensated else None,
            ring=each(lambda rows: jnp.roll(rows[::-1], 1, axis=0), values),
            slope=each(lambda rows: rows[0], slopes) if compensated else None,
        )
        return made._replace(pi=each(lambda p, b: p + time.h * b, _components(carry.shown[1]), beside(made)))

    def beside(carry: _Carry) -> Any:
        """(π − p)/h."""

        def remembered(ring: Any) -> Any:
            ordered = jnp.roll(ring[::-1], carry.place + 1, axis=0)
            return sum(sums.shown[j] * ordered[j] for j in range(kept))

        found = each(remembered, carry.ring)
        if not compensated:
            return found
        return each(lambda r, f, s: r - f / 2 + sums.slope * s, found, carry.force, carry.slope)

    def kick(carry: _Carry) -> Any:
        """Σ w_j H_{n−j} by two chains of additions, so that one need not wait for the other."""
        weights = lax.dynamic_index_in_dim(jnp.asarray(sums.turned), carry.place, keepdims=False)

        def total(ring: Any) -> Any:
            terms = [weights[j] * ring[j] for j in range(kept)]
            return sum(terms[2::2], terms[0]) + sum(terms[3::2], terms[1])

        found = each(total, carry.ring)
        return each(jnp.add, carry.force, found) if compensated else found

    def ordered_kick(carry: _Carry) -> Any:
        """The same with the newest value at place 0, which comes last."""

        def total(ring: Any) -> Any:
            terms = [sums.kick[j] * ring[-j] for j in range(1, kept)]
            return (sum(terms[2::2], terms[0]) + sum(terms[3::2], terms[1])) + sums.kick[0] * ring[0]

        if not compensated:
            return each(total, carry.ring)
        return each(lambda f, ring: total(ring) + f, carry.force, carry.ring)

    def begun(carry: _Carry, tables: Any, time: Time) -> _Carry:
        """Begun, with the newest value at place 0."""
        carry = begin(carry, tables, time)
        ring = each(lambda rows: jnp.roll(rows, -carry.place, axis=0), carry.ring)
        return carry._replace(ring=ring, place=jnp.zeros_like(carry.place))

    def begin(carry: _Carry, tables: Any, time: Time) -> _Carry:
        return lax.cond(carry.started, lambda c: c, lambda c: started(c, past(c.shown, tables, time), time), carry)

    def step(carry: _Carry, tables: Any, time: Time) -> _Carry:
        place = jnp.where(carry.place == kept - 1, 0, carry.place + 1)
        put = lambda rows, x: lax.dynamic_update_index_in_dim(rows, x, place, 0)
        return stepped(carry, time, kick(carry), put)._replace(place=place)

    def shifted(carry: _Carry, tables: Any, time: Time) -> _Carry:
        return stepped(carry, time, ordered_kick(carry), lambda rows, x: jnp.stack([x, *rows[2:], rows[0]]))

    def stepped(carry: _Carry, time: Time, total: Any, put: Callable[[Any, Any], Any]) -> _Carry:
        def moved(values: Any, lost: Any, rates: Any) -> tuple[Any, Any]:
            if lost is None:
                return each(lambda x, r: x + time.h * r, values, rates), None
            pairs = each(lambda x, e, r: add_small_product(x, e, time.h, r), values, lost, rates)
            return jax.tree.transpose(jax.tree.structure(values), None, pairs)

        lost_q, lost_pi = carry.lost or (None, None)
        pi, lost_pi = moved(carry.pi, lost_pi, total)
        q, lost_q = moved(carry.q, lost_q, velocity(pi, carry.shown))
        new = force(q, carry.shown, time, 1.0)
        slope = each(jnp.subtract, new, carry.force) if compensated else None
        value = each(jnp.subtract, slope, carry.slope) if compensated else new
        ring = each(put, carry.ring, value)
        lost = None if carry.lost is None else (lost_q, lost_pi)
        kept_force = new if compensated else None
        return carry._replace(q=q, pi=pi, ring=ring, force=kept_force, slope=slope, lost=lost)

    def end(carry: _Carry, tables: Any, time: Time) -> _Carry:
        p = each(lambda x, b: x - time.h * b, carry.pi, beside(carry))
        return carry._replace(shown=tuple(_whole(new, old) for old, new in zip(carry.shown, (carry.q, p), strict=True)))

    def prepare(h: Any) -> Any:
        return starter().prepare(-h)

    def read(carry: _Carry) -> State:
        return carry.shown

    # in registers what is remembered moves on at no cost, and its newest value is waited for by one product alone
    marked = lambda carry: carry._replace(started=np.asarray(True), place=np.asarray(0))
    history = Past(starter(), method.terms - 1, started, lambda carry: not carry.started, marked)
    straight = Stepper(prepare, initial, begun, shifted, end, read, past=history)
    return Stepper(prepare, initial, begin, step, end, read, straight)


def _components(slot: Any) -> Any:
    """A slot as it is computed with: numbers one by one for one orbit of a small system, else one array."""
    import jax.numpy as jnp

    if len(slot) <= WRITTEN_OUT and all(jnp.ndim(x) == 0 for x in slot):
        return tuple(slot[k] for k in range(len(slot)))
    if not isinstance(slot, tuple):
        return slot
    # numbers that nothing has traced are stacked at once: each call of jax's costs a tenth of a millisecond
    return np.stack(slot) if all(isinstance(x, np.ndarray) for x in slot) else jnp.stack(slot)


def _whole(found: Any, slot: Any) -> Any:
    """What `_components` made of a slot, in its own form."""
    import jax.numpy as jnp

    if isinstance(slot, tuple):
        return found if isinstance(found, tuple) else tuple(found)
    return jnp.stack(found) if isinstance(found, tuple) else found


def _method(terms: int, starter: SplittingMethod) -> Stormer:
    traits = Traits(terms, symplectic=False, symmetric=False, volume_preserving=False)
    source = "Störmer (1907), Arch. Sci. Phys. Nat. 24, 5; Hairer, Nørsett and Wanner (1993), III.10"
    return Stormer(f"stormer{terms}", traits, terms, starter, source)


METHODS: Final = (
    _method(8, NYSTROM_8),
    _method(10, NYSTROM_8),
    _method(12, SOFRONIOU_SPALETTA_10),
)
