"""Störmer's methods: their weights, measured orders and traits, how they begin and go on, and where rounding ends."""

from fractions import Fraction
from functools import cache

import jax.numpy as jnp
import numpy as np
import pytest

from canon import InputError
from canon.numeric.compensated import add_small_product
from canon.numeric.integrate import advance, integrate, start
from canon.numeric.integrators import compositions, separable
from canon.numeric.integrators.catalogue import METHODS as ALL
from canon.numeric.integrators.measure import errors, measure_step
from canon.numeric.integrators.multistep import METHODS, Stormer
from canon.numeric.integrators.multistep_weights import GRID, differences, sums_of, weights

HENON_HEILES = separable(lambda p: p, lambda q: jnp.stack([-q[0] - 2 * q[0] * q[1], -q[1] - q[0] ** 2 + q[1] ** 2]))
STATE = (np.array([0.11, -0.22]), np.array([0.385, 0.33]))
DURATION = 60.0
STEPS = {8: (18, 24), 10: (16, 20), 12: (14, 18)}
"""Steps in a unit of time: with more, rounding is seen; with fewer, the methods of many terms blow up."""
METHOD = METHODS[0]


@cache
def reference() -> tuple[np.ndarray, np.ndarray]:
    exact = compositions.SOFRONIOU_SPALETTA_10
    return integrate(HENON_HEILES, exact, STATE, duration=DURATION, steps=3000, compensated=True).state


MEASURED = [pytest.param(m, id=m.name, marks=[pytest.mark.slow] if m.terms == 10 else []) for m in METHODS]


@pytest.mark.parametrize("method", MEASURED)
def test_measured_order_and_traits(method: Stormer) -> None:
    few, many = (round(DURATION) * each for each in STEPS[method.traits.order])
    coarse, fine = errors(HENON_HEILES, method, STATE, reference(), duration=DURATION, steps=(few, many))
    assert fine > 1e-14, "on the rounding plateau nothing is measured"
    assert np.log(coarse / fine) / np.log(many / few) == pytest.approx(method.traits.order, abs=0.5)
    assert method in ALL


def test_a_step_keeps_no_structure() -> None:
    seen = measure_step(HENON_HEILES, METHOD, STATE, h=0.3)
    assert min(seen.symplecticity, seen.volume, seen.asymmetry) > 1e-9
    assert METHOD.traits.symplectic is METHOD.traits.volume_preserving is METHOD.traits.symmetric is False


@pytest.mark.parametrize("terms", [8, 12])
def test_weights_integrate_polynomials_exactly(terms: int) -> None:
    """With a = t^m, of every degree that the terms allow: q'' = a and its differences are known numbers."""
    delta, phi = differences(terms)
    kick, shown = ([*map(float, weights(each))] for each in (delta, phi))
    for m in range(terms):
        past = [Fraction(-j) ** m for j in range(terms)]
        q = [Fraction(t) ** (m + 2) / ((m + 1) * (m + 2)) for t in (-1, 0, 1)]
        size = float(max(map(abs, past)))
        assert sum(w * float(a) for w, a in zip(kick, past, strict=True)) == pytest.approx(
            float(q[0] - 2 * q[1] + q[2]), abs=1e-13 * size
        )
        assert sum(w * float(a) for w, a in zip(shown, past, strict=True)) == pytest.approx(
            float(q[1] - q[0]), abs=1e-13 * size
        )


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.name)
def test_rounded_weights_make_no_damping(method: Stormer) -> None:
    """Their sums of order 0 and 1 are exact, as numbers of the machine: 1 and 0."""
    kick = [Fraction(float(w)) for w in sums_of(method.terms, False).kick]
    assert sum(kick) == 1
    assert sum(j * w for j, w in enumerate(kick)) == 0
    assert all((w * GRID).denominator == 1 for w in kick)


@pytest.mark.parametrize("compensated", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_a_run_in_pieces_is_the_same_to_the_last_bit(compensated: bool) -> None:
    options = {"duration": 30.0, "steps": 300, "samples": 7, "compensated": compensated}
    whole = integrate(HENON_HEILES, METHOD, STATE, **options)
    run = start(HENON_HEILES, METHOD, STATE, **options)
    for _ in range(7):
        run = advance(HENON_HEILES, METHOD, run, chunks=1)
    assert [x.tobytes() for x in whole.states] == [x.tobytes() for x in run.states]
    two = integrate(HENON_HEILES, METHOD, STATE, **{**options, "samples": 2})
    assert np.abs(np.array(two.state) - np.array(whole.state)).max() < 1e-13


def test_many_orbits_are_as_one_by_one() -> None:
    scales = np.array([1.0, 0.7, 0.4])
    options = {"duration": 10.0, "steps": 150}
    many = integrate(HENON_HEILES, METHOD, tuple(np.outer(x, scales) for x in STATE), batched=True, **options).state
    for k, scale in enumerate(scales):
        one = integrate(HENON_HEILES, METHOD, tuple(scale * x for x in STATE), **options).state
        assert np.abs(np.array(one) - np.array(many)[..., k]).max() < 1e-14


def test_a_force_that_depends_on_time() -> None:
    """q'' = −q + cos 2t from rest: q = (cos t − cos 2t)/3."""
    driven = separable(lambda p: p, lambda q, t: -q + jnp.cos(2 * t), time_dependent=True)
    run = integrate(driven, METHODS[1], (np.zeros(1), np.zeros(1)), duration=9.0, steps=300, t0=0.0)
    q, p = run.state
    assert q[0] == pytest.approx((np.cos(9) - np.cos(18)) / 3, abs=1e-12)
    assert p[0] == pytest.approx((-np.sin(9) + 2 * np.sin(18)) / 3, abs=1e-12)


def test_it_refuses_what_its_past_does_not_tell() -> None:
    relativistic = separable(lambda p: p / jnp.sqrt(1 + p**2), lambda q: -q, nystrom=False)
    with pytest.raises(InputError, match="T quadratic"):
        integrate(relativistic, METHOD, STATE, duration=1.0, steps=10)


@pytest.mark.slow
def test_compensated_sums_hold_the_energy_where_plain_ones_drift() -> None:
    def drift(compensated: bool) -> float:
        run = integrate(HENON_HEILES, METHODS[2], STATE, duration=20_000.0, steps=800_000, compensated=compensated)
        energy = [
            (p @ p + q @ q) / 2 + q[0] ** 2 * q[1] - q[1] ** 3 / 3
            for q, p in zip(*run.states, strict=True)
        ]  # fmt: skip
        return abs(energy[-1] / energy[0] - 1)

    assert drift(True) < 2e-14 < drift(False)


def test_small_products_add_up_as_if_none_were_rounded() -> None:
    """A hundred thousand increments of either sign, which plain sums lose 1e-12 of."""
    assert add_small_product(1.0, 0.0, 2.0**-30, 2.0**-30) == (1.0, 2.0**-60)
    rates = np.random.default_rng(4).normal(size=100_000).tolist()
    value, lost, plain = 1.0, 0.0, 1.0
    for rate in rates:
        value, lost = add_small_product(value, lost, 0.05, rate)
        plain += 0.05 * rate
    exact = 1 + sum(Fraction(0.05) * Fraction(rate) for rate in rates)
    assert abs(value + lost - float(exact)) < 1e-14 < abs(plain - float(exact))
