"""Where the integrals are elliptic: J and T of a potential with one harmonic, by Gauss's arithmetic–geometric mean.

V = c + a cos nq + b sin nq with a constant mass is a pendulum in θ = nq. With V from low to top, m_1 = (top − E)/(top −
low), I = 1/2An² and k = (top − low)/2, librations have J = 16√(Ik) [E(m) − m_1 K(m)] and T = 4√(I/k) K(m), rotations
over one period J = 8√(Ikm) E(1/m) and T = 2√(I/km) K(1/m). Abramowitz and Stegun 17.6; Lawden (1989), 5.1.
"""

from __future__ import annotations

import flint
from flint import arb

from canon.numeric.actions.balls import Ball
from canon.numeric.actions.branches import LIBRATION, Branch
from canon.numeric.actions.profile import Profile
from canon.numeric.actions.rules import Quadrature

RULE = "arithmetic-geometric mean"


def by_mean(profile: Profile, branch: Branch, E: Ball, bits: int) -> Quadrature | None:
    """(J, T) of a branch of a pendulum, resolved where both have `bits` bits; None of others, and on the separatrix."""
    if profile.harmonic is None or profile.square is None or branch.on_separatrix or branch.is_open:
        return None
    if branch.kind != LIBRATION and profile.centre != 0:
        return None  # p_0 adds to the action of a rotation
    nodes = [node for node, _ in branch.inside]
    around = [end.outer for end in branch.ends or ()]
    minima = [node for node in nodes if node.kind > 0]
    tops = [node for node in (*nodes, *around) if node.kind < 0]
    if len(minima) != 1 or not tops or len(nodes) != (1 if branch.kind == LIBRATION else 2):
        return None
    low, top = minima[0].value(), tops[0].value()
    m1, m, k = (top - E) / (top - low), (E - low) / (top - low), (top - low) / 2
    inertia = 1 / (2 * profile.square(arb(0)) * profile.harmonic() ** 2)
    if branch.kind == LIBRATION:
        K, rest, steps = _complete(m, m1)
        J, T = 16 * (inertia * k).sqrt() * K * (m / 2 - rest), 4 * K * (inertia / k).sqrt()
    else:
        K, rest, steps = _complete(1 / m, -m1 / m)
        J = 8 * (inertia * k * m).sqrt() * K * (1 - 1 / (2 * m) - rest)
        T = 2 * K * (inertia / (k * m)).sqrt()
    return Quadrature((J, T), steps, RULE, all(x.is_finite() and x.rel_accuracy_bits() >= bits for x in (J, T)))


def _complete(m: Ball, m1: Ball) -> tuple[Ball, Ball, int]:
    """K(m) and Σ 2^(n−1) c_n² from n = 1, of which E(m) = K(m) (1 − m/2 − Σ), and the steps that they took."""
    b = m1.sqrt()
    a = (1 + b) / 2
    c, b = m / (4 * a), b.sqrt()
    rest, weight, steps = c * c, arb(1), 1
    small = arb(2) ** -flint.ctx.prec
    while c > small and steps < 64:
        weight, steps = 2 * weight, steps + 1
        a, b = (a + b) / 2, (a * b).sqrt()
        c = c * c / (4 * a)
        rest = rest + weight * c * c
    # the mean lies between a and b; what is left of the sum is less than its next term, twice
    return arb.pi() / (2 * a.union(b)), rest + arb(0, (4 * weight * c * c).abs_upper()), steps
