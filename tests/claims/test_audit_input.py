"""Audits of maps that are no maps, have no derivative, hide a state, or round: each gets a clear message."""

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from canon import InputError, audit
from tests.claims.known_maps import Array, H, symplectic_euler


def test_nan_on_part_of_the_domain_is_reported_and_the_rest_audited() -> None:
    report = audit(lambda z: np.array([np.sqrt(z[0]), 2 * np.sqrt(z[0]) * z[1]]), dimension=2, domain=(-0.5, 1.5))
    assert report.verdict == "supported"
    (note,) = report.notes
    missing = report.samples - report.audited
    assert f"no finite value at {missing} of 1000 points ({missing / 1000:.3g}), for instance at q = -" in note


def test_exceptions_at_some_points_are_reported() -> None:
    def fragile(z: Array) -> Array:
        if z[0] > 0.5:
            raise RuntimeError("too far")
        return np.array([z[0] + z[1], z[1]])

    report = audit(fragile, dimension=2, samples=100)
    assert report.verdict == "supported"
    assert "raises (RuntimeError: too far)" in report.notes[0]


@pytest.mark.parametrize("numbers", [np, jnp])
def test_float32_is_said_and_paid_for(numbers: Any) -> None:
    def rounded(z: Any) -> Any:
        w = z.astype(numbers.float32)
        return numbers.stack([w[0] + numbers.sin(w[1]), w[1]])

    report = audit(rounded, dimension=2, samples=50)
    assert any("float32" in note for note in report.notes)
    assert report.brackets["{Q,P}"].bound > 1e-8


def test_the_rounding_of_points_in_float32_is_no_kink() -> None:
    def leapfrog(z: Any) -> Any:
        q, p = z.astype(np.float32)
        p = p - np.float32(0.05) * np.sin(q)
        q = q + np.float32(0.1) * p
        return np.array([q, p - np.float32(0.05) * np.sin(q)])

    report = audit(leapfrog, dimension=2, samples=200)
    assert report.verdict == "supported"
    assert not any("differentiable" in note for note in report.notes)


def test_complex_numbers_on_the_way_have_estimates() -> None:
    def turned(z: Any) -> Any:
        w = (z[0] + 1j * z[1]) * jnp.exp(0.3j)
        return jnp.stack([w.real, w.imag])

    report = audit(turned, dimension=2, samples=50)
    assert (report.verdict, report.errors) == ("supported", "estimate")


def test_a_map_without_a_value_anywhere_is_an_input_error() -> None:
    with pytest.raises(InputError, match="no finite value at any"):
        audit(lambda z: z + jnp.array(0.0) / jnp.array(0.0), dimension=2, samples=20)


def test_points_without_a_derivative_are_reported() -> None:
    def kinked(z: Any) -> Any:
        return jnp.stack([z[0], z[1] + jnp.sqrt(z[0] ** 2)])

    points = np.array([[0.5, 1.0], [0.0, 1.0], [-0.5, 1.0]])
    report = audit(kinked, dimension=2, domain=points)
    assert report.audited == 2
    assert "the map is not differentiable at 1 points, for instance at q = 0, p = 1" in report.notes


def test_derivatives_that_are_not_those_of_the_values_are_noticed() -> None:
    def stopped(z: Any) -> Any:
        return jnp.stack([z[0] + jax.lax.stop_gradient(z[1]), z[1]])

    report = audit(stopped, dimension=2, samples=20)
    assert report.verdict == "undecided"
    assert any("derivatives are not those of the values" in doubt for doubt in report.doubts)


@pytest.mark.parametrize(
    ("bad", "message"),
    [
        (lambda z: z[:1], r"an array of shape \(1,\) for a point of shape \(2,\)"),
        (lambda z: None, "a NoneType for a point"),
        (lambda z: np.array([z[0], 1 / 0]), "raises at every point tried.*ZeroDivisionError"),
        (lambda z: z * 1j, "complex"),
        (lambda z: z.astype(int), r"whole numbers \(int64\)"),
        (lambda z: np.array([int(10 * float(z[0])), 0]), r"whole numbers \(int64\)"),
        (lambda z: ["a", "b"], "an array of texts"),
        (lambda z: np.array([z[0], None], dtype=object), "an array of objects"),
        (lambda z: z * np.nan, "no finite value at any"),
        (3, "a map is a function or a transformation, not int"),
    ],
)
def test_what_is_no_map_is_an_input_error(bad: Any, message: str) -> None:
    with pytest.raises(InputError, match=message):
        audit(bad, dimension=2, samples=20)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({}, "dimension of phase space is needed"),
        ({"dimension": 3}, "even dimension"),
        ({"dimension": 10**9}, "up to 100000 dimensions"),
        ({"dimension": 2**70}, "up to 100000 dimensions"),
        ({"dimension": "4"}, "even dimension 2n, not '4'"),
        ({"dimension": 2, "samples": 0}, "at least 1"),
        ({"dimension": 2, "samples": 1e3}, "samples: a whole number is needed, at least 1"),
        ({"dimension": 2, "domain": [(0, 1)]}, "a pair"),
        ({"dimension": 2, "domain": (1, 0)}, "low <= high"),
        ({"dimension": 2, "domain": {"x": (0, 1)}}, "'x' is none of q, p"),
        ({"dimension": 2, "domain": np.zeros((3, 4))}, "shape"),
        ({"dimension": 2, "scale": 0}, "scale"),
        ({"dimension": 2, "parameters": {"h": 1}}, "for formulas"),
    ],
)
def test_options_that_make_no_sense_are_input_errors(options: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        audit(symplectic_euler, **options)


@pytest.mark.parametrize("numbers", [np, jnp])
def test_a_bend_that_spoils_no_bracket_is_told_all_the_same(numbers: Any) -> None:
    points = np.array([[0.3, 0.2], [0.1, 0.0], [0.3, -0.2]])
    kicks = (lambda p: abs(p), lambda p: numbers.where(p > 0, p**3, 0.0))
    bent, smooth = (
        audit(lambda z, kick=kick: numbers.stack([z[0] + kick(z[1]), z[1]]), dimension=2, domain=points)
        for kick in kicks
    )
    assert bent.verdict == smooth.verdict == "supported"
    (note,) = bent.notes
    assert note.startswith("the map seems not to be differentiable at 1 of 3 points that were looked at, for instance")
    assert "q = 0.1, p = 0:" in note
    assert not smooth.notes


def test_a_point_on_a_kink_is_told_apart_from_a_failure() -> None:
    def folded(z: Array) -> Array:
        return np.array([abs(z[0]), np.sign(z[0]) * z[1]])

    report = audit(folded, dimension=2, domain=np.array([[0.0, 1.0], [1.0, 1.0], [0.5, 0.2]]))
    assert report.verdict == "undecided"
    assert report.doubts == ("the map is not differentiable at q = 0, p = 1: its differences to the two sides differ",)
    bent = audit(lambda z: np.array([z[0], z[1] + 5 * z[0] ** 2 + 1e-3 * z[1] ** 3]), dimension=2)
    assert not bent.doubts  # curvature is no kink
    assert bent.failures


def test_jax_functions_without_forward_derivatives_are_evaluated() -> None:
    @jax.custom_vjp
    def sine(x: Any) -> Any:
        return jnp.sin(x)

    sine.defvjp(lambda x: (sine(x), x), lambda x, slope: (slope * jnp.cos(x),))

    def backward_only(z: Any, h: float = H) -> Any:
        p = z[1] - h * sine(z[0])
        return jnp.stack([z[0] + H * p, p])

    def called(z: Any) -> Any:
        return jax.pure_callback(lambda x: symplectic_euler(np.asarray(x)), jax.ShapeDtypeStruct((2,), z.dtype), z)

    for map in (backward_only, called):
        report = audit(map, dimension=2, samples=5)
        assert (report.verdict, report.derivatives, report.errors) == ("supported", "complex step", "estimate")
    assert audit(lambda z: backward_only(z) * (1 + 1e-6), dimension=2, samples=5).failures


def test_a_map_without_derivatives_nearly_everywhere_is_in_doubt() -> None:
    seen: dict[tuple[float, ...], float] = {}

    def numbered(z: Array) -> Array:
        """Each point has an offset of its own, the same at every call."""
        return np.array([z[0] + seen.setdefault(tuple(z), 1e-3 * len(seen)), z[1]])

    report = audit(numbered, dimension=2, samples=20)
    assert report.verdict == "undecided"
    assert any("not to be differentiable at 20 of 20 points" in doubt for doubt in report.doubts)


def test_a_valence_close_to_the_expected_one_is_told_apart_from_it() -> None:
    report = audit(lambda z: jnp.array([1 + 1e-13, 1.0]) * z, dimension=2, samples=20)
    assert "all brackets agree with valence 1 + 1e-13 instead of 1" in report.notes


def pendulum_steps(count: int, units: tuple[float, float], stretch: float = 1.0) -> Callable[[Array], Array]:
    """Many leapfrog steps of a pendulum in units of q and p of their own."""

    def map(z: Array) -> Array:
        q, p = z[0] / units[0], z[1] / units[1]
        for _ in range(count):
            p = p - H / 2 * np.sin(q)
            q = stretch * (q + H * p)
            p = p - H / 2 * np.sin(q)
        return np.array([q * units[0], p * units[1]])

    return map


@pytest.mark.parametrize(("count", "units"), [(300, (1.0, 1.0)), (3, (1e-10, 1e-25))])
def test_roundings_of_many_steps_and_tiny_units_are_no_alarm(count: int, units: tuple[float, float]) -> None:
    domain = [(-unit, unit) for unit in units]
    report = audit(pendulum_steps(count, units), dimension=2, domain=domain, samples=500)
    assert (report.verdict, report.derivatives) == ("supported", "complex step"), str(report)
    assert report.brackets["{Q,P}"].bound < 1e-12
    mutant = audit(pendulum_steps(count, units, 1 + 1e-12), dimension=2, domain=domain, samples=50)
    assert mutant.worst.label == "{Q1,P1}"
    assert mutant.worst.size == pytest.approx(count * 1e-12, rel=0.1)


def test_a_thousand_steps_in_jax_have_estimates_where_bounds_say_nothing():
    import jax
    import jax.numpy as jnp

    def flow(z, off=0.0):
        def step(_, z):
            q, p = z
            p = p - 0.05 * jnp.sin(q)
            q = q + 0.1 * p
            return q, p - 0.05 * jnp.sin(q)

        q, p = jax.lax.fori_loop(0, 400, step, (z[0], z[1]))
        return jnp.stack([q * (1 + off), p])

    report = audit(flow, dimension=2, samples=20)
    assert report.verdict == "supported"
    assert report.symplectic.bound < 1e-9
    assert "estimated errors" in str(report)
    assert audit(lambda z: flow(z, 1e-9), dimension=2, samples=20).failures
