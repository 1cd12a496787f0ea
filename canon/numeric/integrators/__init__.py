"""Integrators: immutable values with measured traits, their coefficients verified by tests.

How they are used. A *problem* says what is integrated: `Splitting(parts)` (exactly solvable parts; `separable(velocity,
force)` makes the one of T(p) + V(q, t)) or `Field(rate)` (a whole vector field). A *state* is a tuple of slots, (q, p)
for most problems; a slot is an array, or a tuple of arrays, whose first axis counts coordinates and whose last one,
where there are many orbits, counts these. A *method* is a value such as `VERLET` or `YOSHIDA_6`, with `name`, `traits`,
`source` and `stepper(problem)`. Then

    run = integrate(separable(lambda p: p, lambda q: -jnp.sin(q)), YOSHIDA_6, (q, p), duration=100.0, steps=1000,
                    samples=201)
    run.times, run.states, run.state, run.completed

from `canon.numeric.integrate` is the orbit at equidistant times, and `flow_map(problem, method, steps=…, h=…)` there is
the map state -> state that jax can differentiate. `start`, `advance` and `pieces` make a run piece by piece: a run that
is interrupted and resumed has every bit of one that isn't.

Which functions of a state are fastest. For one orbit let slots be arrays (n,), and a force return `jnp.stack([…])`; for
a thousand let slots be tuples of arrays (N,), and a force return a tuple. `canon.numeric.lower` makes both.
"""

from canon.numeric.integrators.problem import (
    ExactPart,
    Field,
    Part,
    Shear,
    Splitting,
    State,
    clock_part,
    separable,
)
from canon.numeric.integrators.splitting import SplittingMethod
from canon.numeric.integrators.stepper import Method, Stepper, Time
from canon.numeric.integrators.traits import Traits

__all__ = [
    "ExactPart",
    "Field",
    "Method",
    "Part",
    "Shear",
    "Splitting",
    "SplittingMethod",
    "State",
    "Stepper",
    "Time",
    "Traits",
    "clock_part",
    "separable",
]
