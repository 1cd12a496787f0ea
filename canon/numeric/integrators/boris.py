"""Boris's push for charges in any electric and magnetic fields, and the exact one for fields that are uniform.

The slots are (x, u), u = v, or γv where there is a c. A step is half a drift, half a kick by E, a rotation by B, half a
kick, half a drift: symmetric and volume-preserving, but not symplectic where B varies. Boris (1970), Proc. 4th Conf.
Num. Sim. Plasmas, 3; Qin et al. (2013), Phys. Plasmas 20, 084503; Ellison, Burby and Qin (2015), J. Comput. Phys. 301,
489; Zhang et al. (2015), Phys. Plasmas 22, 044501, for the relativistic one.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

from canon.errors import InputError
from canon.numeric.integrators.composed import OneStep, StepMap
from canon.numeric.integrators.problem import Field, State
from canon.numeric.integrators.traits import Traits
from canon.numeric.rotations import cross

NO_CHARGE: Final = (
    "takes a charge in fields that are functions, a Charge in Python, and no Hamiltonian: scenes are run without it; "
    "yoshida6, or gauss6 where H cannot be split, take a charge's Hamiltonian"
)


@dataclass(frozen=True)
class Charge:
    """A charge: `electric(x, t)` = qE/m and `magnetic(x, t)` = qB/m, arrays (3, …); `c` where it is relativistic."""

    electric: Callable[[Any, Any], Any]
    magnetic: Callable[[Any, Any], Any]
    c: float | None = None

    def field(self) -> Field:
        """ẋ = v, u̇ = qE/m + v × qB/m."""

        def rate(state: State, t: Any) -> State:
            x, u = state
            v = u / gamma(u, self.c)
            return v, self.electric(x, t) + cross(v, self.magnetic(x, t))

        return Field(rate, autonomous=False)


def gamma(u: Any, c: float | None) -> Any:
    """√(1 + u²/c²); 1 where there is no c."""
    import jax.numpy as jnp

    return 1.0 if c is None else jnp.sqrt(1 + jnp.sum(u * u, axis=0) / (c * c))


def _turned(u: Any, angle: Any) -> Any:
    """u̇ = u × w over a time, for w times that time (3, …): Rodrigues's formula."""
    import jax.numpy as jnp

    from canon.numeric.exact.stumpff import stumpff

    _, c1, c2, _ = stumpff(jnp.sum(angle * angle, axis=0))
    once = cross(u, angle)
    return u + c1 * once + c2 * cross(once, angle)


def _boris(problem: Any) -> StepMap:
    if not isinstance(problem, Charge):
        raise InputError(f"boris {NO_CHARGE}")
    c = problem.c

    def step(state: State, t: Any, h: Any) -> State:
        x, u, *others = state
        x = x + h / 2 * u / gamma(u, c)
        middle = t + h / 2
        push = h / 2 * problem.electric(x, middle)
        u = u + push
        u = _turned(u, h / gamma(u, c) * problem.magnetic(x, middle)) + push
        return (x + h / 2 * u / gamma(u, c), u, *others)

    return step


def _exact_push(problem: Any) -> StepMap:
    if not isinstance(problem, Charge):
        raise InputError(f"the exact push {NO_CHARGE}")

    def step(state: State, t: Any, h: Any) -> State:
        from canon.numeric.exact.relativistic_charge import relativistic_charge
        from canon.numeric.exact.uniform import uniform_fields

        x, u, *others = state
        c = problem.c
        x = x + h / 2 * u / gamma(u, c)
        e, w = problem.electric(x, t + h / 2), problem.magnetic(x, t + h / 2)
        u = uniform_fields(x, u, e, w, h)[1] if c is None else relativistic_charge(x, u, e, w, c, h)[1]
        return (x + h / 2 * u / gamma(u, c), u, *others)

    return step


BORIS: Final = OneStep(
    "boris",
    Traits(order=2, symplectic=False, symmetric=True, volume_preserving=True),
    _boris,
    "Boris (1970); Qin et al. (2013), Phys. Plasmas 20, 084503",
)
EXACT_PUSH: Final = OneStep(
    "exact_push",
    Traits(order=2, symplectic=False, symmetric=True, volume_preserving=True),
    _exact_push,
    "Gordon and Hafizi (2021), Comput. Phys. Commun. 258, 107628",
)
METHODS: Final = (BORIS, EXACT_PUSH)
