"""Every table of coefficients: its order conditions to rounding, and its measured order and traits on problems that
are not linear (an oscillator would flatter them).
"""

from functools import cache
from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest

from canon import InputError
from canon.numeric.integrate import integrate
from canon.numeric.integrators import (
    SplittingMethod,
    blanes_moan,
    compositions,
    corrected,
    near_integrable,
    nystrom,
    nystrom_8,
    separable,
    yoshida,
)
from canon.numeric.integrators.measure import errors, measure_step
from tests.numeric.order_conditions import nystrom_residual, residual, substeps

NEAR = (*near_integrable.METHODS, *corrected.METHODS)
GENERAL = (*yoshida.METHODS, *compositions.METHODS, *blanes_moan.METHODS, *NEAR)
NYSTROM = (*nystrom.METHODS, *nystrom_8.METHODS)
METHODS = (*GENERAL, *NYSTROM)
ALWAYS = {
    *("verlet", "mclachlan4", "blanes_moan6", "kahan_li8", "sofroniou_spaletta10"),
    *("corrected_verlet6", "aba864", "nystrom4", "nystrom6a", "nystrom8a"),
}
"""One of each kind and order, measured always: the others' coefficients satisfy the same conditions."""


def unless_slow(methods: tuple[SplittingMethod, ...], always: set[str]) -> list[Any]:
    return [
        pytest.param(method, id=method.name, marks=[] if method.name in always else [pytest.mark.slow])
        for method in methods
    ]


HENON_HEILES = separable(
    lambda p: p, lambda q: jnp.stack([-q[0] - 2 * q[0] * q[1], -q[1] - q[0] ** 2 + q[1] ** 2]), nystrom=True
)
STATE = (np.array([0.1, -0.2]), np.array([0.35, 0.3]))
DURATION = 6.0
STEPS = {2: (100, 200), 4: (36, 60), 6: (24, 36), 8: (54, 80), 10: (10, 14)}
NYSTROM_8_STEPS = (20, 28)


@cache
def reference() -> tuple[np.ndarray, np.ndarray]:
    return integrate(
        HENON_HEILES, compositions.KAHAN_LI_8, STATE, duration=DURATION, steps=1500, compensated=True
    ).state


def all_substeps(method: SplittingMethod) -> list[tuple[int, float]]:
    """Those of a step, between those of the processor and its inverse."""
    undo = [(part, -length) for part, length in reversed(method.processor)]
    return [*undo, *substeps(method.a, method.b), *method.processor]


@pytest.mark.parametrize("method", GENERAL, ids=lambda method: method.name)
def test_order_conditions_hold_to_rounding_and_no_further(method: SplittingMethod) -> None:
    order = method.traits.order
    assert residual(all_substeps(method), order) < 1e-15
    if order < 10:
        assert residual(all_substeps(method), order + 1) > 1e-7


@pytest.mark.parametrize("method", unless_slow(NYSTROM, {m.name for m in NYSTROM} - {"nystrom8", "nystrom8b"}))
def test_nystrom_conditions_hold_modulo_the_bracket_that_vanishes(method: SplittingMethod) -> None:
    letters = (1, 0) if method.outer == "last" else (0, 1)
    steps = [(letters[letter], length) for letter, length in substeps(method.a, method.b)]
    assert nystrom_residual(steps, method.traits.order) < 1e-15
    assert nystrom_residual(steps, method.traits.order + 1) > 1e-8
    if method.traits.order > 4:
        assert residual(steps, method.traits.order) > 1e-7


@pytest.mark.parametrize("method", unless_slow(METHODS, ALWAYS))
def test_measured_order_and_traits(method: SplittingMethod) -> None:
    few, many = NYSTROM_8_STEPS if method in nystrom_8.METHODS else STEPS[method.traits.order]
    coarse, fine = errors(HENON_HEILES, method, STATE, reference(), duration=DURATION, steps=(few, many))
    assert fine > 1e-14, "on the rounding plateau nothing is measured"
    assert np.log(coarse / fine) / np.log(many / few) == pytest.approx(method.traits.order, abs=0.35)
    seen = measure_step(HENON_HEILES, method, STATE, h=0.2)
    assert (seen.symplecticity < 1e-14) == method.traits.symplectic
    assert (seen.volume < 1e-14) == method.traits.volume_preserving
    assert (seen.asymmetry < 1e-14) == method.traits.symmetric


@pytest.mark.parametrize("method", NEAR, ids=lambda method: method.name)
def test_near_integrable_orders(method: SplittingMethod) -> None:
    """Terms with k letters B, of size ε^k, vanish up to the order p_k."""
    steps = all_substeps(method)
    for count, order in enumerate(method.near_integrable, 1):
        assert residual(steps, order, count) < 1e-15
        assert residual(steps, order + 1, count) > 1e-12


def test_nystrom_methods_refuse_what_they_are_not_for() -> None:
    relativistic = separable(lambda p: p / jnp.sqrt(1 + p**2), lambda q: -q, nystrom=False)
    with pytest.raises(InputError, match="T quadratic"):
        integrate(relativistic, nystrom.NYSTROM_6, STATE, duration=1.0, steps=1)
