"""Systems that do not act on each other, each with a method of its own, at the same times.

The Hamiltonian is a sum H_1(z_1) + H_2(z_2) + …, whose flow is the product of theirs: a step of the whole is a step of
each, and keeps of each what its method keeps. So bodies that split and bodies that are held can move in one scene.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from canon.errors import InputError
from canon.numeric.integrators.problem import State
from canon.numeric.integrators.stepper import Method, Stepper, Time
from canon.numeric.integrators.traits import Traits


@dataclass(frozen=True)
class SideBySide:
    """Independent `problems`, whose states are the consecutive rows of the slots: `widths` has, for each problem, how
    many rows of every slot are its own. Slots are arrays.
    """

    problems: tuple[Any, ...]
    widths: tuple[tuple[int, ...], ...]

    def shares(self, state: State) -> tuple[State, ...]:
        """The state of each problem."""
        first = [0] * len(state)
        found = []
        for widths in self.widths:
            found.append(tuple(slot[a : a + n] for slot, a, n in zip(state, first, widths, strict=True)))
            first = [a + n for a, n in zip(first, widths, strict=True)]
        return tuple(found)


@dataclass(frozen=True)
class Together:
    """One of `methods` for each problem of a `SideBySide`; `weighty` are those whose steps make an error."""

    methods: tuple[Method, ...]
    weighty: tuple[Method, ...] = ()

    @property
    def name(self) -> str:
        """All their names."""
        return " + ".join(dict.fromkeys(method.name for method in self.methods))

    @property
    def traits(self) -> Traits:
        """The least order of those that make an error, and what all of them keep."""
        all_traits = [method.traits for method in self.methods]
        order = min(method.traits.order for method in self.weighty or self.methods)
        return Traits(
            order,
            _all([traits.symplectic for traits in all_traits]),
            _all([traits.symmetric for traits in all_traits]),
            _all([traits.volume_preserving for traits in all_traits]),
        )

    @property
    def source(self) -> str:
        """All their sources."""
        return "; ".join(dict.fromkeys(method.source for method in self.methods if method.source))

    def stepper(self, problem: Any, *, compensated: bool = False) -> Stepper:
        """The methods set up side by side. **Raises:** `InputError` for a problem of another kind."""
        if not isinstance(problem, SideBySide) or len(problem.problems) != len(self.methods):
            raise InputError(f"{self.name} takes {len(self.methods)} independent problems, not {type(problem)}")
        steppers = [
            method.stepper(own, compensated=compensated)
            for method, own in zip(self.methods, problem.problems, strict=True)
        ]

        def initial(state: State) -> Any:
            return tuple(each.initial(own) for each, own in zip(steppers, problem.shares(state), strict=True))

        def each_with(word: str) -> Any:
            def moved(carry: Any, tables: Any, time: Time) -> Any:
                rows = zip(steppers, carry, tables, strict=True)
                return tuple(getattr(each, word)(own, table, time) for each, own, table in rows)

            return moved

        def read(carry: Any) -> State:
            import jax.numpy as jnp

            states = [each.read(own) for each, own in zip(steppers, carry, strict=True)]
            return tuple(jnp.concatenate(slots) for slots in zip(*states, strict=True))

        return Stepper(
            prepare=lambda h: tuple(each.prepare(h) for each in steppers),
            initial=initial,
            begin=each_with("begin"),
            step=each_with("step"),
            end=each_with("end"),
            read=read,
        )


def _all(answers: Sequence[bool | None]) -> bool | None:
    """True where all are, False where one is; else nobody knows."""
    return False if False in answers else None if None in answers else True
