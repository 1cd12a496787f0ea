"""Compositions of shears are proved by structure, and only proved by it."""

import sympy as sp

from canon import PhaseSpace, verify
from canon.mechanics import Transformation


def composed(n: int, *, mutant: bool = False) -> Transformation:
    """Four shears by quartic potentials, one of them no gradient in the mutant."""
    names = [f"q{k}" for k in range(n)], [f"p{k}" for k in range(n)]
    space = PhaseSpace(*names, new=([f"Q{k}" for k in range(n)], [f"P{k}" for k in range(n)]))
    q, p = list(space.q), list(space.p)
    Q, P = q[:], p[:]
    for step in range(4):
        source, names_ = (Q, q) if step % 2 == 0 else (P, p)
        potential = sum(names_[k] ** 3 * names_[(k + 1) % n] for k in range(n)) / (step + 2)
        kick = [sp.diff(potential, a) for a in names_]
        if mutant and step == 3:
            kick[0] += names_[1] ** 2 / 1000
        kick = [k.xreplace(dict(zip(names_, source, strict=True))) for k in kick]
        if step % 2 == 0:
            P = [a + b for a, b in zip(P, kick, strict=True)]
        else:
            Q = [a + b for a, b in zip(Q, kick, strict=True)]
    return Transformation(space, Q=Q, P=P)


def test_what_cannot_be_expanded_is_proved_by_its_factors():
    verdict = verify(composed(6).canonical(), budget=20)
    assert verdict.status == "proved"
    assert "structure" in verdict.method


def test_a_shear_that_is_no_gradient_is_refuted():
    assert verify(composed(3, mutant=True).canonical(), budget=20).status == "refuted"
