"""Methods for whole vector fields: their measured orders and traits on a Hamiltonian that does not separate."""

from fractions import Fraction
from functools import cache

import jax.numpy as jnp
import numpy as np
import pytest

from canon.errors import InputError
from canon.numeric.adaptive import integrate_adaptively
from canon.numeric.integrate import integrate
from canon.numeric.integrators import Field, separable
from canon.numeric.integrators.composed import OneStep, composed
from canon.numeric.integrators.compositions import KAHAN_LI_6_GAMMA
from canon.numeric.integrators.fields import as_field, hamiltonian_field
from canon.numeric.integrators.gauss import GAUSS_6, Gauss, exact_tableau, tableau
from canon.numeric.integrators.gauss import METHODS as GAUSS
from canon.numeric.integrators.measure import errors, measure_step
from canon.numeric.integrators.runge_kutta import METHODS as RUNGE_KUTTA
from canon.numeric.integrators.stepper import Method
from canon.numeric.integrators.traits import Traits

FIELD = hamiltonian_field(lambda q, p: p**2 / (2 * (1 + q**2)) + q**2 / 2 + p * q**2 / 5)
STATE = (np.array([0.8, 0.2]), np.array([0.3, -0.4]))
STEPS = {1: (2000, 4000), 2: (100, 200), 4: (60, 120), 6: (20, 40), 8: (16, 24)}


@cache
def reference() -> tuple[np.ndarray, np.ndarray]:
    run = integrate_adaptively(FIELD, STATE, [0.0, 3.0], relative=1e-14, absolute=1e-15)
    return run.states[0][-1], run.states[1][-1]


@pytest.mark.parametrize(
    "method",
    [
        pytest.param(method, id=method.name, marks=[pytest.mark.slow] if method.name in ("gauss6", "gauss8") else [])
        for method in (*RUNGE_KUTTA, *GAUSS, Gauss(2, "newton"))
    ],
)
def test_measured_order_and_traits(method: Method) -> None:
    few, many = STEPS[method.traits.order]
    coarse, fine = errors(FIELD, method, STATE, reference(), duration=3.0, steps=(few, many))
    assert fine > 2e-14
    assert np.log(coarse / fine) / np.log(many / few) == pytest.approx(method.traits.order, abs=0.35)
    seen = measure_step(FIELD, method, STATE, h=0.2)
    assert (seen.symplecticity < 1e-14) == method.traits.symplectic
    assert (seen.volume < 1e-14) == method.traits.volume_preserving
    assert (seen.asymmetry < 1e-14) == method.traits.symmetric


@pytest.mark.parametrize("stages", [1, 2, 3, 4])
def test_gauss_tableaux_are_symplectic(stages: int) -> None:
    A, b, c = tableau(stages)
    assert np.abs(b[:, None] * A + b[None, :] * A.T - np.outer(b, b)).max() < 1e-16
    assert np.allclose(A.sum(axis=1), c, rtol=1e-15)


def test_stages_that_are_not_solved_end_the_run() -> None:
    stiff = Field(lambda state, t: (-1000 * state[0] + jnp.cos(t),), autonomous=False)
    start = (np.array([1.0]),)
    run = integrate(stiff, Gauss(2), start, duration=1.0, steps=10)
    assert run.ended
    assert run.completed == 1
    assert integrate(stiff, Gauss(2, "newton"), start, duration=1.0, steps=10).completed == 2


def test_compositions_of_a_map_reach_their_order() -> None:
    def build(problem: Field) -> object:
        """Heun's explicit trapezoid is not symmetric; the implicit one, by iteration, is."""

        def step(state: tuple, t: float, h: float) -> tuple:
            (z,) = state
            before = problem.rate(state, t)[0]
            after = z + h * before
            for _ in range(40):
                after = z + h / 2 * (before + problem.rate((after,), t + h)[0])
            return (after,)

        return step

    traits = Traits(2, symplectic=None, symmetric=True, volume_preserving=None)
    trapezoid = OneStep("trapezoid", traits, build, "Euler")
    sixth = composed(trapezoid, KAHAN_LI_6_GAMMA, 6)
    field = Field(lambda state, t: (jnp.sin(state[0]) * jnp.cos(t),), autonomous=False)
    start = (np.array([1.0]),)
    exact = (2 * np.arctan(np.tan(0.5) * np.exp(np.sin(2.0))),)
    few, many = errors(field, sixth, start, exact, duration=2.0, steps=(6, 12))
    assert np.log2(few / many) == pytest.approx(6, abs=0.4)
    with pytest.raises(InputError, match="not a symmetric map"):
        composed(sixth, KAHAN_LI_6_GAMMA, 8)
    with pytest.raises(InputError, match="sum to 1"):
        composed(trapezoid, (0.4, 0.4), 4)


def test_the_adaptive_reference() -> None:
    """Kepler's ellipse at e = 0.9, there and back, with as few steps as its estimate allows."""
    problem = separable(lambda p: p, lambda q: -q / jnp.sum(q**2, axis=0) ** 1.5)
    start = (np.array([0.1, 0.0]), np.array([0.0, 19.0**0.5]))
    there = integrate_adaptively(problem, start, [0.0, np.pi, 2 * np.pi])
    assert np.abs(there.states[0][1] - [-1.9, 0]).max() < 1e-9
    assert np.abs(there.states[0][2] - start[0]).max() < 1e-8
    assert there.completed == 3
    assert 60 < there.steps < 400
    back = integrate_adaptively(problem, (there.states[0][1], there.states[1][1]), [np.pi, 0.0])
    assert np.abs(back.states[1][1] - start[1]).max() < 1e-8


def test_the_adaptive_reference_stops_where_it_must() -> None:
    blow_up = Field(lambda state, t: (state[0] ** 2,))
    run = integrate_adaptively(blow_up, (np.array([1.0]),), [0.0, 0.5, 2.0])
    assert run.completed == 2
    assert run.states[0][1, 0] == pytest.approx(2.0, rel=1e-11)
    with pytest.raises(InputError, match="increase"):
        integrate_adaptively(blow_up, (np.array([1.0]),), [0.0, 1.0, 0.5])


def test_a_splitting_has_a_field() -> None:
    from canon.numeric.integrators.parts import damping_part
    from canon.numeric.integrators.problem import Splitting
    from canon.numeric.precision import double

    problem = separable(lambda p: 2 * p, lambda q: -(q**3))
    problem = Splitting((*problem.parts, damping_part(0.3)))
    with double():
        q, p = as_field(problem, "any").rate((jnp.asarray([2.0]), jnp.asarray([0.5])), 0.0)
    assert np.allclose(q, [1.0])
    assert np.allclose(p, [-8.3])


@pytest.mark.parametrize("stages", [1, 2, 3, 4])
def test_coefficients_in_two_doubles_are_symplectic_to_thirty_digits(stages: int) -> None:
    rows, last = exact_tableau(stages)
    a = [[sum(map(Fraction, w)) for w in row] for row in rows]
    b = [sum(map(Fraction, w)) for w in last]
    A, weights, _ = tableau(stages)
    assert np.array(a, dtype=float) == pytest.approx(A, rel=1e-14, abs=1e-16)
    assert np.array(b, dtype=float) == pytest.approx(weights, rel=1e-14)
    for i in range(stages):
        for j in range(stages):
            assert abs(b[i] * a[i][j] + b[j] * a[j][i] - b[i] * b[j]) < 1e-31


def test_energy_of_a_run_that_keeps_its_rounding_does_not_drift_in_one_direction() -> None:
    """With the rounding of additions alone kept, it grows by 1.4e-14, as t; random walks as long scatter by 3e-16."""
    angles = np.linspace(0, 2 * np.pi, 8, endpoint=False)
    run = integrate(
        separable(lambda p: p, lambda q: -q), GAUSS_6, (np.cos(angles), np.sin(angles)),
        duration=2500.0, steps=50_000, compensated=True,
    )  # fmt: skip
    values = (np.asarray(run.states[0], np.longdouble) ** 2 + np.asarray(run.states[1], np.longdouble) ** 2)[[0, -1]]
    assert abs(float(np.mean(values[1] / values[0] - 1))) < 6e-16
