"""Integral invariants by quadrature: exact values, and maps that keep them or change them by a known factor."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from canon import loop_invariant, surface_invariant
from canon.numeric.loops import loop_integral
from canon.numeric.surfaces import surface_integral
from canon.testing.curves import Loop, Surface, loops, surfaces

Array = np.ndarray


def kicked(q: Array, p: Array) -> tuple[Array, Array]:
    """A symplectic map that couples all pairs: a kick by a gradient, then a drift."""
    total = q.sum(axis=-1, keepdims=True)
    p = p - 0.3 * np.sin(total)
    return q + 0.2 * p, p


@given(loops(2))
def test_loops_have_their_exact_integral(loop: Loop) -> None:
    found = loop_integral(loop)
    assert found.resolved
    assert abs(found.value - loop.integral) <= found.bound + 1e-15 * abs(loop.integral)


@given(surfaces(2))
def test_surfaces_have_their_exact_integral(surface: Surface) -> None:
    found = surface_integral(surface, (False, False))
    assert found.resolved
    assert abs(found.value - surface.integral) <= found.bound + 1e-15 * abs(surface.integral)


@given(loops(2), st.sampled_from([1.0, 0.5, -2.0]))
def test_loops_are_multiplied_by_the_valence(loop: Loop, scale: float) -> None:
    def scaled(q: Array, p: Array) -> tuple[Array, Array]:
        new_q, new_p = kicked(q, p)
        return new_q, scale * new_p

    found = loop_invariant(scaled, loop, scale=scale)
    assert found.preserved
    if abs(loop.integral) > 1e-3:
        assert loop_invariant(scaled, loop, scale=scale * (1 + 1e-6)).preserved is False


@given(surfaces(2))
def test_surfaces_are_kept_and_a_squeeze_is_seen(surface: Surface) -> None:
    found = surface_invariant(kicked, surface, periodic=(False, False))
    assert found.preserved
    if abs(surface.integral) > 1e-3:
        squeezed = surface_invariant(lambda q, p: (q, p * (1 + 1e-6)), surface, periodic=(False, False))
        assert squeezed.preserved is False
