"""Linear friction: −2 m λ v, or Rayleigh's −α v. It is in no Hamiltonian, and it contracts phase space."""

from __future__ import annotations

from typing import Final

from canon.scenes.effects.effect import Contribution, Effect, Given
from canon.scenes.values import exactly_one, matrix


def _add(given: Given) -> Contribution:
    if exactly_one(given.table, ("rate", "matrix"), given.where) == "rate":
        rate = given.formula("rate")
        if not rate.is_number:
            raise given.fail("the rate is a number", "rate")
        return Contribution(rates={particle.name: rate for particle in given.particles})
    if given.surroundings.is_system:
        raise given.fail("Rayleigh's matrix acts on the velocities of bodies: give a system a 'rate'", "matrix")
    acted = {symbol for particle in given.particles for symbol in particle.x}
    everything = [symbol for particle in given.surroundings.particles for symbol in particle.x]
    rows = [k for k, symbol in enumerate(everything) if symbol in acted]
    small = matrix(given.table["matrix"], given.place("matrix"), len(rows))
    if small != small.T:
        raise given.fail("Rayleigh's matrix is symmetric", "matrix")
    import sympy as sp

    alpha = sp.zeros(len(everything), len(everything))
    for i, row in enumerate(rows):
        for j, column in enumerate(rows):
            alpha[row, column] = small[i, j]
    return Contribution(resistance=alpha.as_immutable())


EFFECT: Final = Effect(
    "damping",
    "force −2 m rate v, or −α v with a symmetric matrix α over the coordinates (Rayleigh)",
    ("rate", "matrix"),
    ("energy", "momentum", "angular_momentum", "lrl", "symplecticity", "volume", "loop", "cartan"),
    _add,
    optional=("rate", "matrix"),
    hamiltonian=False,
    on_systems=True,
)
