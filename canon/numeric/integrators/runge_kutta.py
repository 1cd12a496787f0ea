"""Explicit Runge–Kutta methods with a fixed step, as references: they keep none of a Hamiltonian flow's structure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

from canon.numeric.compensated import add_increment
from canon.numeric.integrators.fields import as_field
from canon.numeric.integrators.problem import State
from canon.numeric.integrators.stepper import Stepper, Time
from canon.numeric.integrators.traits import Traits


@dataclass(frozen=True)
class RungeKutta:
    """k_i = f(z + h Σ_j a_ij k_j, t + c_i h), z' = z + h Σ b_i k_i, with a strictly lower triangular `a`."""

    name: str
    traits: Traits
    a: tuple[tuple[float, ...], ...]
    b: tuple[float, ...]
    source: str

    @property
    def stages(self) -> int:
        """Evaluations of the field in a step."""
        return len(self.b)

    def stepper(self, problem: Any, *, compensated: bool = False) -> Stepper:
        """The method set up for a `Field`, or for the sum of a `Splitting`'s parts."""
        import jax
        import jax.numpy as jnp

        field = as_field(problem, self.name)

        def initial(state: State) -> Any:
            return (state, jax.tree.map(jnp.zeros_like, state) if compensated else None)

        def step(carry: Any, tables: Any, time: Time) -> Any:
            state, lost = carry
            slopes: list[Any] = []
            for row in self.a:
                moved = state if not slopes else jax.tree.map(lambda z, d: z + time.h * d, state, _sum(row, slopes))
                slopes.append(field.rate(moved, time.at(sum(row))))
            increment = jax.tree.map(lambda d: time.h * d, _sum(self.b, slopes))
            if lost is None:
                return jax.tree.map(jnp.add, state, increment), None
            pairs = jax.tree.map(add_increment, state, lost, increment)
            return jax.tree.transpose(jax.tree.structure(state), None, pairs)

        return Stepper(
            prepare=lambda h: None,
            initial=initial,
            begin=lambda carry, tables, time: carry,
            step=step,
            end=lambda carry, tables, time: carry,
            read=lambda carry: carry[0],
        )


def _sum(weights: tuple[float, ...], slopes: list[Any]) -> Any:
    import jax

    used = [(w, k) for w, k in zip(weights, slopes, strict=True) if w != 0]
    return jax.tree.map(
        lambda *values: sum((w * v for (w, _), v in zip(used[1:], values[1:], strict=True)), used[0][0] * values[0]),
        *(k for _, k in used),
    )


RK4: Final = RungeKutta(
    "rk4",
    Traits(order=4, symplectic=False, symmetric=False, volume_preserving=False),
    ((), (1 / 2,), (0.0, 1 / 2), (0.0, 0.0, 1.0)),
    (1 / 6, 1 / 3, 1 / 3, 1 / 6),
    "Kutta (1901); Hairer, Nørsett and Wanner (1993), Solving Ordinary Differential Equations I, II.1",
)
EULER: Final = RungeKutta(
    "euler", Traits(1, symplectic=False, symmetric=False, volume_preserving=False), ((),), (1.0,), "Euler (1768)"
)
METHODS: Final = (EULER, RK4)
