"""The logarithmic Hamiltonian of a formula T(p) + V(q), for motion with close approaches."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from canon.errors import InputError
from canon.numeric.integrators.problem import Splitting, State
from canon.numeric.integrators.time_transformation import logarithmic, logarithmic_state
from canon.numeric.lower import lower_map
from canon.numeric.shears import Parameters


@dataclass(frozen=True)
class Regularised:
    """`problem`, on slots (q, p, t, b), and `state`, which takes (q, p, t) there."""

    problem: Splitting
    kinetic: Any
    potential: Any

    def state(self, q: Any, p: Any, t: float = 0.0) -> State:
        """The state of the transformed problem.

        **Raises:** `InputError` where the potential is not negative: then its logarithm has no meaning.
        """
        import jax.numpy as jnp

        from canon.numeric.precision import double

        with double():
            q, p = jnp.asarray(q, dtype=float), jnp.asarray(p, dtype=float)
            if not bool(jnp.all(self.potential(q) < 0)):
                raise InputError("the logarithmic Hamiltonian needs V < 0: subtract a constant from V")
            return logarithmic_state(q, p, t, self.kinetic, self.potential)


def regularise(
    T: sp.Expr, V: sp.Expr, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol], parameters: Parameters | None = None
) -> Regularised:
    """The logarithmic Hamiltonian of T(p) + V(q), with the gradient of ln(−V) as one formula.

    **Raises:** `InputError` where T has coordinates, or V has momenta.
    """
    if T.free_symbols & {*q} or V.free_symbols & {*p}:
        raise InputError("the logarithmic Hamiltonian is of T(p) + V(q)")
    values = parameters or {}
    pull = [sp.cancel(sp.together(V.diff(x) / V)) for x in q]
    kinetic, potential = lower_map([T], p, values), lower_map([V], q, values)
    problem = logarithmic(
        lower_map([T.diff(y) for y in p], p, values), lambda y: kinetic(y)[0], lower_map(pull, q, values)
    )
    return Regularised(problem, lambda y: kinetic(y)[0], lambda x: potential(x)[0])
