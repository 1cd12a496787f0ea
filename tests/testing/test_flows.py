"""Flows of Hamiltonians pass, and what isn't one is told what fails: the start, the velocity, or symplecticity."""

from typing import Any

import numpy as np
import pytest

from canon import Hamiltonian, InputError, PhaseSpace
from canon.testing import assert_hamiltonian_flow

Array = np.ndarray


def turn(z: Array, t: float) -> Array:
    """The oscillator of frequency 2."""
    c, s = np.cos(2 * t), np.sin(2 * t)
    return np.array([c * z[0] + s * z[1] / 2, -2 * s * z[0] + c * z[1]])


def energy(z: Array) -> Any:
    return z[1] ** 2 / 2 + 2 * z[0] ** 2


def test_the_flow_of_a_function_and_of_a_formula() -> None:
    assert_hamiltonian_flow(turn, energy, dimension=2, samples=10)

    def in_place(z: Array, t: float) -> Array:
        z[:] = turn(z, t)
        return z

    assert_hamiltonian_flow(in_place, energy, dimension=2, samples=10)
    space = PhaseSpace("q", "p", positive="w")
    q, p, w = space.symbols("q p w")
    oscillator = Hamiltonian(space, p**2 / 2 + w**2 * q**2 / 2)
    assert_hamiltonian_flow(turn, oscillator, dimension=2, samples=10, parameters={"w": 2})
    with pytest.raises(AssertionError, match="its velocity isn't J ∇H"):
        assert_hamiltonian_flow(turn, oscillator, dimension=2, samples=10, parameters={"w": 2 + 1e-9})


@pytest.mark.parametrize(
    ("flow", "message"),
    [
        (lambda z, t: turn(z, t + 1e-9), r"doesn't start where it should at t = 0: p is off by 1\.\d+e-09"),
        (lambda z, t: turn(z, -t), r"at t = 0.1 its velocity isn't J ∇H: . is off by .*, bound .*, from q = "),
        (lambda z, t: turn(z, t) * (1 + 1e-9 * t), "its velocity isn't J ∇H"),
        (lambda z, t: turn(z, t * (1 + 1e-10)), "its velocity isn't J ∇H"),
    ],
)
def test_what_is_no_flow_of_it(flow: Any, message: str) -> None:
    with pytest.raises(AssertionError, match=message):
        assert_hamiltonian_flow(flow, energy, dimension=2, samples=10)


def test_a_velocity_field_may_agree_at_single_points_alone() -> None:
    """Each orbit is right, but at a wrong phase that depends on where it began: the velocity is, the map isn't."""

    def late(z: Array, t: float) -> Array:
        return turn(z, t + 1e-3 * np.sin(10 * np.pi * t) ** 4 * z[0] ** 2)

    with pytest.raises(AssertionError):
        assert_hamiltonian_flow(late, energy, dimension=2, times=(0.05, 0.1), samples=10)


def test_an_approximate_flow_needs_a_tolerance() -> None:
    def kick_and_drift(z: Array, t: float, steps: int = 200) -> Array:
        q, p = z
        h = t / steps
        for _ in range(steps):
            p = p - h / 2 * 4 * q
            q = q + h * p
            p = p - h / 2 * 4 * q
        return np.array([q, p])

    assert_hamiltonian_flow(kick_and_drift, energy, dimension=2, times=(0.5,), samples=4, tolerance=1e-4)
    with pytest.raises(AssertionError, match="kick_and_drift is not the flow of this Hamiltonian"):
        assert_hamiltonian_flow(kick_and_drift, energy, dimension=2, times=(0.5,), samples=4)


def oscillation(w: float) -> tuple[Any, Any]:
    """The flow of an oscillator of angular frequency w, and H."""

    def flow(z: Array, t: float) -> Array:
        c, s = np.cos(w * t), np.sin(w * t)
        return np.array([c * z[0] + s * z[1] / w, -w * s * z[0] + c * z[1]])

    return flow, lambda z: (z[1] ** 2 + w**2 * z[0] ** 2) / 2


@pytest.mark.parametrize(("w", "t"), [(1.0, 1e3), (1.3, 1e4), (1e4, 1.0), (0.7, -500.0), (1e-3, 1e3)])
def test_many_turns_are_no_fault(w: float, t: float) -> None:
    """Differences over several turns agree with each other, and not with the velocity."""
    flow, H = oscillation(w)
    domain = [(-1.0, 1.0), (-w, w)]
    assert_hamiltonian_flow(flow, H, dimension=2, times=(t,), domain=domain, samples=5)
    with pytest.raises(AssertionError, match="its velocity isn't J ∇H"):
        assert_hamiltonian_flow(
            lambda z, s: flow(z, s * (1 + 1e-7)), H, dimension=2, times=(t,), domain=domain, samples=5
        )


def test_a_flow_is_a_function_to_phase_points() -> None:
    with pytest.raises(InputError, match="flow: a flow is a function, not None"):
        assert_hamiltonian_flow(None, energy, dimension=2)  # type: ignore[arg-type]
    with pytest.raises(
        InputError, match=r"a flow takes a phase point z and t to a phase point: of \(2,\) it makes \(3,\)"
    ):
        assert_hamiltonian_flow(lambda z, t: np.zeros(3), energy, dimension=2)


def test_bad_input() -> None:
    with pytest.raises(InputError, match="a Hamiltonian, or a function of z, is expected, not float"):
        assert_hamiltonian_flow(turn, 1.0, dimension=2)  # type: ignore[arg-type]
    with pytest.raises(InputError, match=r"a Hamiltonian is a number, not an array of shape \(2,\)"):
        assert_hamiltonian_flow(turn, lambda z: z, dimension=2)
    with pytest.raises(InputError, match="at least one time"):
        assert_hamiltonian_flow(turn, lambda z: 7 * energy(z), dimension=2, times=())
    with pytest.raises(InputError, match="tolerance: a finite number, at least 0"):
        assert_hamiltonian_flow(turn, lambda z: 7 * energy(z), dimension=2, tolerance=np.inf)
    space = PhaseSpace("x y", "u v")
    with pytest.raises(InputError, match="H has 2 degrees of freedom, the flow 1"):
        assert_hamiltonian_flow(turn, Hamiltonian(space, space.p[0]), dimension=2)
