"""RATTLE, Boris's push, the extended phase space, rigid bodies and damping: orders and what each keeps."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from canon.errors import InputError
from canon.numeric.adaptive import integrate_adaptively
from canon.numeric.exact.oscillator import oscillator
from canon.numeric.integrate import integrate
from canon.numeric.integrators import Splitting, separable
from canon.numeric.integrators.blanes_moan import BLANES_MOAN_4, BLANES_MOAN_6
from canon.numeric.integrators.boris import METHODS as PUSHES
from canon.numeric.integrators.boris import Charge
from canon.numeric.integrators.composed import OneStep, composed
from canon.numeric.integrators.compositions import SUZUKI_4_GAMMA
from canon.numeric.integrators.constrained import Constrained, onto_surface, reactions
from canon.numeric.integrators.extended import extend, extended, project, separation
from canon.numeric.integrators.fields import hamiltonian_field
from canon.numeric.integrators.measure import errors, jacobian, measure_step
from canon.numeric.integrators.parts import damping_part, rayleigh_part
from canon.numeric.integrators.problem import ExactPart
from canon.numeric.integrators.rattle import RATTLE
from canon.numeric.integrators.rigid_body import rigid_body
from canon.numeric.integrators.yoshida import VERLET, YOSHIDA_4
from canon.numeric.precision import double
from canon.numeric.rotations import from_euler, matrix, rotate


def order(few: float, many: float, ratio: float = 2.0) -> float:
    return float(np.log(few / many) / np.log(ratio))


PENDULUM = Constrained(
    (2.0, 2.0, 2.0),
    lambda q, t: jnp.stack([0 * q[0], 0 * q[0], 0 * q[0] - 2.0 * 9.81]),
    lambda q, t: ((jnp.sum(q**2, axis=0) - 1) / 2,),
)
HANGING = (np.array([0.6, 0.0, -0.8]), np.array([0.8, 1.5, 0.6]))


def test_rattle_keeps_the_constraint_and_its_order() -> None:
    fourth = composed(RATTLE, SUZUKI_4_GAMMA, 4)
    exact = integrate(PENDULUM, fourth, HANGING, duration=2.0, steps=2000).state
    for method, steps in ((RATTLE, (100, 200)), (fourth, (40, 80))):
        few, many = errors(PENDULUM, method, HANGING, exact, duration=2.0, steps=steps)
        assert order(few, many) == pytest.approx(method.traits.order, abs=0.2)
    run = integrate(PENDULUM, RATTLE, HANGING, duration=50.0, steps=5000, samples=11)
    q, p = run.states
    assert np.abs((q**2).sum(axis=1) - 1).max() < 1e-14
    assert np.abs((q * p).sum(axis=1)).max() < 1e-13
    energy = (p**2).sum(axis=1) / 4 + 2 * 9.81 * q[:, 2]
    assert np.abs(energy - energy[0]).max() < 2e-2
    vertical = q[:, 0] * p[:, 1] - q[:, 1] * p[:, 0]
    assert np.abs(vertical - vertical[0]).max() < 1e-12
    assert measure_step(PENDULUM, RATTLE, HANGING, h=0.01).asymmetry < 1e-13


def test_rattle_leaves_no_rounding_of_coordinates_over_the_step_in_momenta() -> None:
    """In short steps m (q' - q)/h has the rounding of q over h: energies wandered by 7e-9 here."""
    run = integrate(PENDULUM, RATTLE, HANGING, duration=2e-3, steps=2000, samples=5)
    q, p = run.states
    energy = (p**2).sum(axis=1) / 4 + 2 * 9.81 * q[:, 2]
    assert np.abs(energy - energy[0]).max() < 1e-12


def test_rattle_is_symplectic_on_the_surface() -> None:
    """dp ∧ dq of two vectors tangent to the surface and to its lifted velocities is kept."""
    q, p = HANGING
    M = jacobian(PENDULUM, RATTLE, HANGING, h=0.05)
    tangents = []
    for u, w in (((0.8, 0.0, 0.6), (0.0, 0.0, 0.0)), ((0.0, 1.0, 0.0), (0.0, 0.3, 0.0)), ((0.0,) * 3, (0.8, 0, 0.6))):
        moved, change = np.array(u), np.array(w)
        change = change - q * (q @ change + p @ moved)
        tangents.append(np.concatenate([moved, change]))
    for a in tangents:
        for b in tangents:
            before = a[:3] @ b[3:] - a[3:] @ b[:3]
            x, y = M @ a, M @ b
            assert x[:3] @ y[3:] - x[3:] @ y[:3] == pytest.approx(before, abs=1e-13)


def test_moving_constraints_reactions_and_states_off_the_surface() -> None:
    """A bead on the x axis of a rod in a lift that rises as t²: its reaction is m (g + 2) upwards."""
    lift = Constrained(
        (3.0, 3.0), lambda q, t: jnp.stack([0 * q[0], 0 * q[0] - 3.0 * 9.81]), lambda q, t: (q[1] - t**2,), moving=True
    )
    with double():
        start = onto_surface(lift, jnp.array([0.0, 0.2]), jnp.array([1.0, 5.0]), jnp.asarray(1.0))
        assert np.allclose(start, [[0.0, 1.0], [1.0, 6.0]])
        (multiplier,) = reactions(lift, *start, 1.0)
        assert float(-multiplier) == pytest.approx(3 * (9.81 + 2))
    run = integrate(lift, RATTLE, start, duration=1.0, steps=10, t0=1.0)
    assert np.allclose(run.state[0], [1 / 3, 4.0], rtol=1e-13)
    with pytest.raises(InputError, match="holonomic"):
        integrate(separable(lambda p: p, lambda q: q), RATTLE, HANGING, duration=1.0, steps=1)


def test_two_constraints_of_two_orbits() -> None:
    double_pendulum = Constrained(
        (1.0, 1.0, 2.0, 2.0),
        lambda q, t: jnp.stack([0 * q[0], 0 * q[0] - 1, 0 * q[0], 0 * q[0] - 2]),
        lambda q, t: (q[0] ** 2 + q[1] ** 2 - 1, (q[2] - q[0]) ** 2 + (q[3] - q[1]) ** 2 - 1),
    )
    q = np.array([[0.0, 0.6], [-1.0, -0.8], [1.0, 0.6], [-1.0, -1.8]])
    run = integrate(double_pendulum, RATTLE, (q, 0 * q), duration=5.0, steps=2000, batched=True)
    x = run.state[0]
    assert np.abs(x[0] ** 2 + x[1] ** 2 - 1).max() < 1e-14
    one = integrate(double_pendulum, RATTLE, (q[:, 1], 0 * q[:, 1]), duration=5.0, steps=2000)
    assert np.allclose(x[:, 1], one.state[0], atol=1e-9)


CHARGE_STATE = (np.array([0.5, 0.2, 0.1]), np.array([0.3, -0.4, 0.5]))


@pytest.mark.parametrize(
    ("method", "c"),
    [pytest.param(PUSHES[0], None, marks=pytest.mark.slow), (PUSHES[0], 1.2), (PUSHES[1], None)],
)
def test_pushes(method: OneStep, c: float | None) -> None:
    charge = Charge(
        lambda x, t: jnp.stack([-x[0], 0.3 * jnp.cos(t) + 0 * x[0], 0.1 * x[1]]),
        lambda x, t: jnp.stack([0.2 * x[1], 0.2 * x[0], 1 + 0.5 * x[0]]),
        c,
    )
    exact = integrate_adaptively(charge.field(), CHARGE_STATE, [0.0, 3.0]).states
    exact = (exact[0][1], exact[1][1])
    few, many = errors(charge, method, CHARGE_STATE, exact, duration=3.0, steps=(60, 120))
    assert order(few, many) == pytest.approx(2, abs=0.1)
    seen = measure_step(charge, method, CHARGE_STATE, h=0.2, t0=0.4)
    assert (seen.volume < 1e-13) == method.traits.volume_preserving
    assert (seen.asymmetry < 1e-13) == method.traits.symmetric
    # nor is the form dx ∧ du + qB/m kept: see Ellison, Burby and Qin
    assert method.traits.symplectic is False
    with pytest.raises(InputError, match="charge"):
        method.stepper(PENDULUM)


@pytest.mark.slow
def test_the_exact_push_is_exact_in_momentum() -> None:
    uniform = Charge(
        lambda x, t: jnp.stack([0 * x[0] + 0.5, 0 * x[0], 0 * x[0] + 0.1]), lambda x, t: 0 * x + 0.7, c=1.2
    )
    exact = integrate_adaptively(uniform.field(), CHARGE_STATE, [0.0, 4.0]).states[1][1]
    found = [integrate(uniform, method, CHARGE_STATE, duration=4.0, steps=4).state[1] for method in PUSHES]
    assert np.abs(found[1] - exact).max() < 1e-12
    assert np.abs(found[0] - exact).max() > 1e-3


def hamiltonian(q: jax.Array, p: jax.Array) -> jax.Array:
    return jnp.sum((1 + q**2) * p**2 / 2 + q**2 / 2, axis=0)


@pytest.mark.slow
def test_extended_phase_space() -> None:
    state = (np.array([0.5, 0.1]), np.array([0.3, -0.2]))
    field = hamiltonian_field(hamiltonian)
    exact = integrate_adaptively(field, state, [0.0, 3.0]).states
    problem = extended(hamiltonian, 5.0)
    ends = [integrate(problem, BLANES_MOAN_4, extend(state), duration=3.0, steps=n).state for n in (60, 120)]
    few, many = (np.abs(np.concatenate(project(end)) - np.concatenate([x[1] for x in exact])).max() for end in ends)
    assert order(few, many) == pytest.approx(4, abs=0.4)
    with double():
        assert float(separation(ends[1])) < 1e-4
    M = jacobian(problem, BLANES_MOAN_4, extend(state), h=0.1)
    J = np.kron(np.eye(2), np.kron([[0, 1], [-1, 0]], np.eye(2)))
    assert np.abs(M @ J @ M.T - J).max() < 1e-13


WEIGHT, MOMENTS = 2.0, (1.0, 1.3, 0.5)


def torque(attitude: jax.Array) -> jax.Array:
    """r × mg in space, for a centre of mass at e_3 in the body."""
    down = jnp.stack([0 * attitude[0], 0 * attitude[0], 0 * attitude[0] - WEIGHT])
    arm = rotate(attitude, jnp.stack([0 * attitude[0], 0 * attitude[0], 0 * attitude[0] + 1]))
    return jnp.cross(arm, down, axis=0)


@pytest.mark.slow
def test_heavy_tops() -> None:
    """A top with a fixed point keeps M_z; three rotations and the exact free top lead to the same."""
    problem = rigid_body(MOMENTS, torque, frame="space")
    with double():
        state = (np.asarray(from_euler(0.1, 0.9, 0.2)), np.array([0.3, 0.2, 2.0]))
    last = integrate(problem, YOSHIDA_4, state, duration=2.0, steps=3200).state
    few, many = errors(problem, YOSHIDA_4, state, last, duration=2.0, steps=(80, 160))
    assert order(few, many) == pytest.approx(4, abs=0.3)
    exact = rigid_body(MOMENTS, torque, frame="space", exact=True)
    few, many = errors(exact, VERLET, state, last, duration=2.0, steps=(80, 160))
    assert order(few, many) == pytest.approx(2, abs=0.1)
    run = integrate(problem, YOSHIDA_4, state, duration=20.0, steps=3200)
    attitude, M = run.state
    with double():
        vertical = np.asarray(rotate(attitude, M))[2] - np.asarray(rotate(*state))[2]
        rise = np.asarray(matrix(attitude))[2, 2] - np.asarray(matrix(state[0]))[2, 2]
    assert abs(vertical) < 1e-12
    energy = sum((M[k] ** 2 - state[1][k] ** 2) / (2 * MOMENTS[k]) for k in range(3)) + WEIGHT * rise
    assert abs(energy) < 1e-5
    assert abs((attitude**2).sum() - 1) < 1e-14


def test_moments_of_inertia_are_checked() -> None:
    with pytest.raises(InputError, match="principal moments"):
        rigid_body((1.0, 1.0, 3.0))
    with pytest.raises(InputError, match="undefined"):
        rigid_body((0.0, 1.0, 1.0))


def test_damping_is_conformally_symplectic() -> None:
    oscillation = separable(lambda p: p / 2, lambda q: -3 * q)
    problem = Splitting((*oscillation.parts, damping_part(0.1)))
    state = (np.array([1.0]), np.array([0.4]))
    with double():
        exact = [float(x) for x in oscillator(1.0, 0.2, 4.0, omega2=1.5, damping=0.1)]
    found = [float(x[0]) for x in integrate(problem, BLANES_MOAN_6, state, duration=4.0, steps=100).state]
    assert np.allclose(found, [exact[0], 2 * exact[1]], atol=1e-9)
    M = jacobian(problem, BLANES_MOAN_4, state, h=0.3, steps=5)
    assert np.linalg.det(M) == pytest.approx(np.exp(-2 * 0.1 * 1.5), rel=1e-13)


def test_rayleigh_dissipation() -> None:
    alpha, mass = [[0.4, 0.1], [0.1, 0.2]], [1.0, 2.0]
    drift = separable(lambda p: p / jnp.asarray(mass), lambda q: -q).parts
    problem = Splitting((*drift, rayleigh_part(alpha, mass)))
    M = jacobian(problem, BLANES_MOAN_4, (np.array([1.0, 0.2]), np.array([0.1, 0.3])), h=0.2, steps=5)
    assert np.linalg.det(M) == pytest.approx(np.exp(-(0.4 + 0.2 / 2)), rel=1e-13)


def test_copies_are_bound_by_their_spring() -> None:
    """ω((q − x)² + (p − y)²)/2: q̇ = ω(p − y), ṗ = −ω(q − x), and the opposite of the copies."""
    binding = extended(lambda q, p: jnp.sum(p * p), 3.0).parts[0]
    before = [np.array([value]) for value in (0.4, -0.7, 0.1, 0.2)]
    assert isinstance(binding, ExactPart)
    assert binding.prepare is not None
    with double():
        after = binding.flow((*before,), binding.prepare(jnp.asarray(1e-7)), None)
    rates = [float(np.asarray(new)[0] - old[0]) / 1e-7 for new, old in zip(after, before, strict=True)]
    assert np.allclose(rates, [3 * -0.9, -3 * 0.3, 3 * 0.9, 3 * 0.3], atol=1e-5)
