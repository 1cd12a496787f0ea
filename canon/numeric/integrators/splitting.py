"""Splitting methods: products of the exact flows of a problem's parts over fractions of a step.

A step is exp(a_1 h A) exp(b_1 h B) exp(a_2 h A) … exp(b_s h B) exp(a_{s+1} h A), the leftmost applied first. Written as
χ*_{α_1 h} χ_{α_2 h} χ*_{α_3 h} …, with χ = exp(hB) exp(hA), it applies to any number of parts with the same order:
McLachlan (1995), SIAM J. Sci. Comput. 16, 151. The last substep of a step and the first of the next are one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal, NamedTuple

import numpy as np

from canon.errors import InputError
from canon.numeric.compensated import add_product
from canon.numeric.integrators.problem import Part, Shear, Splitting, State
from canon.numeric.integrators.stepper import Stepper, Time
from canon.numeric.integrators.traits import Traits

Needs = Literal["any", "nystrom"]


@dataclass(frozen=True)
class SplittingMethod:
    """A splitting method by its coefficients: `a` (s+1 of them) of the outer part, `b` (s) of the inner one.

    The outer part is the problem's first, or its last where `outer` says so. `needs` is what a problem must be for the
    order to hold: "nystrom" methods are for H = T(p) + V(q, t) with a quadratic T alone. `processor` is a sequence of
    substeps (part, fraction), applied to what is shown and undone before going on: P K^n P⁻¹ with the step K.
    `near_integrable` are the orders (p_1, p_2, …) of an error ε h^p_1 + ε² h^p_2 + … where the last part is of size ε
    beside the first: the order of `traits` is then the last.
    """

    name: str
    traits: Traits
    a: tuple[float, ...]
    b: tuple[float, ...]
    source: str
    needs: Needs = "any"
    processor: tuple[tuple[int, float], ...] = ()
    outer: Literal["first", "last"] = "first"
    near_integrable: tuple[int, ...] = ()

    @property
    def stages(self) -> int:
        """Evaluations of the inner part in a step, and of the outer one: its last substep is the next one's first."""
        return len(self.b)

    def stepper(self, problem: Any, *, compensated: bool = False) -> Stepper:
        """The method set up for a `Splitting`; `compensated` keeps what the additions of shears round away."""
        if not isinstance(problem, Splitting):
            raise InputError(
                f"{self.name} takes a problem that is split into solvable parts, and this one is not: gauss6 takes it "
                f"whole, or rattle_6 where there are constraints"
            )
        if self.needs == "nystrom" and not problem.nystrom:
            raise InputError(
                f"{self.name} is for H = T(p) + V(q, t) with T quadratic: choose a method for any splitting"
            )
        if self.processor and len(problem.parts) != 2:
            raise InputError(f"{self.name} is processed for two parts, and the problem has {len(problem.parts)}")
        return _stepper(self, problem, compensated)


def from_composition(name: str, traits: Traits, gamma: Sequence[float], source: str) -> SplittingMethod:
    """S_{γ_1 h} S_{γ_2 h} … of the second-order symmetric S_h = exp(hA/2) exp(hB) exp(hA/2)."""
    ends = [0.0, *gamma, 0.0]
    a = tuple((x + y) / 2 for x, y in pairwise(ends))
    return SplittingMethod(name, traits, a, tuple(gamma), source)


def palindrome(half: Sequence[float], total: float = 1.0) -> tuple[float, ...]:
    """x_1 … x_m, the middle one that makes the sum `total`, and back."""
    return (*half, total - 2 * sum(half), *reversed(half))


def mirrored(half: Sequence[float], total: float = 1.0) -> tuple[float, ...]:
    """x_1 … x_m, the one that makes the sum `total` twice over, and back: an even number."""
    whole = (*half, total / 2 - sum(half))
    return (*whole, *reversed(whole))


class _Substeps(NamedTuple):
    """A sequence of substeps: which part, over which fractions of h, at which fraction of the step's time."""

    parts: tuple[int, ...]
    lengths: np.ndarray
    times: np.ndarray


def _alpha(method: SplittingMethod) -> list[float]:
    """The coefficients α_1 … α_2s of χ* and χ in turn."""
    alpha: list[float] = []
    last = 0.0
    for a, b in zip(method.a, method.b, strict=False):
        alpha += [a - last, b - (a - last)]
        last = alpha[-1]
    return alpha


def _stages(method: SplittingMethod, count: int, clock: int | None) -> _Substeps:
    """The substeps of every stage (s, m), ends joined to the neighbours'; parts counted from the outer."""
    if count == 1:
        return _Substeps((0,), np.ones((1, 1)), np.zeros((1, 1)))
    alpha = _alpha(method)
    middle = tuple(range(1, count - 1))
    parts = (*middle, count - 1, *reversed(middle), 0)
    lengths, times = [], []
    passed = method.a[0] if clock == 0 else 0.0
    for i, (a, b) in enumerate(zip([*method.a[1:-1], method.a[-1] + method.a[0]], method.b, strict=True)):
        row = [*(alpha[2 * i] for _ in middle), b, *(alpha[2 * i + 1] for _ in middle), a]
        seen = []
        for part, length in zip(parts, row, strict=True):
            seen.append(passed)
            passed += length if part == clock else 0.0
        lengths.append(row)
        times.append(seen)
    return _Substeps(parts, np.array(lengths), np.array(times))


def _ends(method: SplittingMethod, count: int) -> list[tuple[int, float]]:
    """What is done before a run of steps; its inverse ends the run."""
    first = [] if count == 1 or method.a[0] == 0.0 else [(0, method.a[0])]
    return [*((part, -length) for part, length in reversed(method.processor)), *first]


def _stepper(method: SplittingMethod, problem: Splitting, compensated: bool) -> Stepper:
    import jax
    import jax.numpy as jnp
    from jax import lax

    parts, clock = problem.parts, problem.clock
    if method.outer == "last":
        parts, clock = parts[::-1], None if clock is None else len(parts) - 1 - clock
    stages = _stages(method, len(parts), clock)
    ends = _ends(method, len(parts))
    count = len(stages.lengths)

    pieces = [(part, stages.lengths[:, j]) for j, part in enumerate(stages.parts)]
    pieces += [(part, np.array([length])) for part, length in ends]
    pieces += [(part, np.array([-length])) for part, length in reversed(ends)]

    def prepare(h: Any) -> Any:
        # each part once, for all its lengths: what is prepared is compiled too
        made: list[Any] = [None] * len(pieces)
        for part in range(len(parts)):
            own = [k for k, (other, _) in enumerate(pieces) if other == part]
            if not own:
                continue
            table = _prepared(parts[part], jnp.asarray(np.concatenate([pieces[k][1] for k in own])) * h)
            first = 0
            for k in own:
                last = first + len(pieces[k][1])
                made[k] = jax.tree.map(lambda rows, first=first, last=last: rows[first:last], table)
                first = last
        columns, openings = len(stages.parts), len(stages.parts) + len(ends)
        return made[:columns], made[columns:openings], made[openings:]

    def initial(state: State) -> Any:
        return (state, jax.tree.map(jnp.zeros_like, state) if compensated else None)

    def stage(i: Any, carry: Any, columns: Any, time: Time) -> Any:
        for j, part in enumerate(stages.parts):
            t = None if clock is None else time.at(jnp.asarray(stages.times[:, j])[i])
            carry = _moved(parts[part], carry, jax.tree.map(lambda table: table[i], columns[j]), t)
        return carry

    def step(carry: Any, tables: Any, time: Time) -> Any:
        if count == 1:
            return stage(0, carry, tables[0], time)
        # two stages at once are faster for one orbit, and slower for many
        single = all(jnp.ndim(x) <= 1 for x in jax.tree.leaves(carry))
        unroll = 2 if single and count % 2 == 0 else 1
        return lax.fori_loop(0, count, lambda i, c: stage(i, c, tables[0], time), carry, unroll=unroll)

    def bracket(carry: Any, sequence: Sequence[tuple[int, float]], prepared: Any, time: Time, passed: float) -> Any:
        for (part, length), values in zip(sequence, prepared, strict=True):
            t = None if clock is None else time.at(passed)
            carry = _moved(parts[part], carry, jax.tree.map(lambda table: table[0], values), t)
            passed += length if part == clock else 0.0
        return carry

    def begin(carry: Any, tables: Any, time: Time) -> Any:
        return bracket(carry, ends, tables[1], time, 0.0)

    def end(carry: Any, tables: Any, time: Time) -> Any:
        undo = [(part, -length) for part, length in reversed(ends)]
        return bracket(carry, undo, tables[2], time, sum(length for part, length in ends if part == clock))

    return Stepper(prepare, initial, begin, step, end, lambda carry: carry[0])


def _prepared(part: Part, lengths: Any) -> Any:
    return lengths if isinstance(part, Shear) or part.prepare is None else part.prepare(lengths)


def _moved(part: Part, carry: Any, prepared: Any, t: Any) -> Any:
    """The flow of one part over one substep."""
    import jax

    state, lost = carry
    if not isinstance(part, Shear):
        return part.flow(state, prepared, t), lost
    state = [*state]
    left = None if lost is None else [*lost]
    for slot, rate in zip(part.slots, part.rate((*state,), t), strict=True):
        if left is None:
            state[slot] = jax.tree.map(lambda x, r: x + prepared * r, state[slot], rate)
            continue
        pairs = jax.tree.map(lambda x, e, r: add_product(x, e, prepared, r), state[slot], left[slot], rate)
        state[slot], left[slot] = jax.tree.transpose(jax.tree.structure(state[slot]), None, pairs)
    return (*state,), None if left is None else (*left,)
