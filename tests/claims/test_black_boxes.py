"""Audits of functions that can only be evaluated: gaps in their domain, noise, and where complex steps mislead."""

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from canon import InputError, audit, certify, loop_invariant, surface_invariant
from canon.numeric.noise import noise_of
from canon.testing import assert_symplectic

Array = np.ndarray


def squeezed(q: Array, p: Array) -> tuple[Array, Array]:
    """Canonical where q > 0: Q = √q, P = 2 √q p."""
    return np.sqrt(q), 2 * np.sqrt(q) * p


def circle(s: Array) -> Array:
    return np.stack([np.cos(2 * np.pi * s), np.sin(2 * np.pi * s)], axis=1)


@pytest.mark.parametrize("root", [np.sqrt, np.emath.sqrt], ids=["nan", "complex"])
def test_a_gap_in_the_domain_spoils_no_bound_elsewhere(root: Any) -> None:
    """A complex step goes through a root of a negative number, and finds derivatives where there are none."""
    right = audit(lambda q, p: (root(q), 2 * root(q) * p), dimension=2, domain=[(-0.2, 1), (-1, 1)], samples=200)
    assert right.verdict == "supported"
    assert right.audited < 200
    assert any("no finite value" in note for note in right.notes)
    wrong = audit(lambda q, p: (root(q), 2.000002 * root(q) * p), dimension=2, domain=[(-0.2, 1), (-1, 1)], samples=200)
    assert wrong.failures
    assert wrong.worst.size == pytest.approx(1e-6, rel=1e-6)


def test_a_map_that_is_defined_on_little_of_the_domain_is_found() -> None:
    def rare(z: Array) -> Array:
        if z[0] < 0.9:
            raise ValueError("only for large q")
        return z

    report = audit(rare, dimension=2, samples=300)
    assert 0 < report.audited < 40
    assert report.verdict == "undecided"
    assert "only for large q" in report.notes[0]


def test_where_nothing_is_resolved_nothing_is_said() -> None:
    report = audit(lambda z: np.asarray(z).astype(np.float16), dimension=2, samples=20)
    assert report.verdict == "undecided"
    assert "condition of M not resolved" in str(report)
    assert "det M     not resolved" in str(report)
    assert "inf to" not in str(report)
    assert any("computes in float16" in note for note in report.notes)


@pytest.mark.parametrize("part", [np.abs, lambda p: np.sign(p.real) * p.real], ids=["abs", "real"])
def test_complex_steps_are_tried_at_every_point(part: Any) -> None:
    """What a complex step doesn't see may begin beyond the first points: here a drag for large momenta."""
    report = audit(lambda q, p: (q, p - 1e-8 * np.maximum(part(p) - 0.95, 0.0)), dimension=2)
    assert report.derivatives == "complex step"
    assert report.failures
    assert abs(report.worst.point[1]) > 0.95
    assert report.worst.size == pytest.approx(1e-8, rel=1e-3)
    wall = audit(lambda q, p: (q, p - 0.1 * np.maximum(part(q) - 0.95, 0.0) ** 2), dimension=2)
    assert wall.verdict == "supported"


def kicks(numbers: Any, turns: int, off: float = 0.0) -> Any:
    """The standard map, so strongly kicked that in a few turns no difference of its values is a derivative."""

    def step(q: Any, p: Any) -> Any:
        for _ in range(turns):
            p = p + 3.0 * numbers.sin(q)
            q = q + p
        return q, p * (1 + off)

    return step


def test_chaos_is_no_failure() -> None:
    """Central differences of the longer steps meet by chance; complex steps and forward AD don't need them."""
    for numbers in (np, jnp):
        report = audit(kicks(numbers, 8), dimension=2, samples=200)
        assert report.verdict == "supported", report
        assert report.condition > 1e9
    assert audit(kicks(np, 3, 1e-9), dimension=2, samples=50).failures
    ripple = audit(lambda q, p: (q + 1e-3 * np.sin(1e6 * p), p), dimension=2, samples=200)
    assert ripple.verdict == "supported"
    folded = audit(lambda q, p: kicks(np, 8)(np.real(q), p), dimension=2, samples=200)
    assert folded.derivatives == "central differences"
    assert not folded.failures


def test_derivatives_are_compared_with_values_at_every_point() -> None:
    """A stopped gradient beyond some momentum: jax's derivatives are right at the first points, and wrong there."""

    def stopped(q: Any, p: Any) -> Any:
        return q, jnp.where(p > 0.9, p - 1e-3 * jax.lax.stop_gradient(p), p)

    report = audit(stopped, dimension=2, samples=300)
    assert report.verdict == "undecided"
    assert any("derivatives are not those of the values" in doubt for doubt in report.doubts)


def in_float32(q: Array, p: Array, mistaken: float = 0.0) -> tuple[Array, Array]:
    """A kick by a force that is computed in float32, and added in float64."""
    force = np.sin(q.astype(np.float32))
    p = p - np.float32(0.1) * force
    return q + 0.1 * p, p * (1 + mistaken)


def test_noise_is_no_failure_and_hides_no_more_than_it_must() -> None:
    report = audit(in_float32, dimension=2, samples=200)
    assert report.verdict == "supported"
    assert any("values jump by about" in note for note in report.notes)
    report = audit(lambda q, p: in_float32(q, p, 1e-3), dimension=2, samples=200)
    assert report.failures
    assert report.worst.label == "{Q1,P1}"
    with pytest.raises(AssertionError, match="values jump"):
        assert_symplectic(lambda q, p: in_float32(q, p, 1e-3), dimension=2, samples=200)


def test_noise_is_told_from_steepness() -> None:
    points, lengths = np.random.default_rng(0).uniform(-1, 1, (3, 2)), np.full(2, 2.0)
    smooth = (lambda z: np.sin(30 * z), lambda z: np.exp(50 * z), lambda z: 1e5 * z, np.abs, lambda z: np.sin(3e3 * z))
    for function in smooth:
        assert not noise_of(function, points, lengths, 2.0**-53).any()
    rng = np.random.default_rng(1)
    found = noise_of(lambda z: z + 1e-9 * rng.standard_normal(z.shape), points, lengths, 2.0**-53)
    assert np.all((found > 2e-10) & (found < 3e-9))


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"seed": "one"}, "seed: a whole number"),
        ({"scale": "1"}, "scale: a finite number"),
        ({"loops": circle}, "loops: a list"),
        ({"surfaces": [circle]}, "surfaces: each is a pair"),
        ({"loops": [lambda s: circle(s) * 1j]}, "real points, not complex"),
        ({"loops": [lambda s: circle(s) * np.nan]}, "not finite"),
        ({"loops": [lambda s: "round"]}, "has numbers for points"),
    ],
)
def test_wrong_options_are_told(options: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=said):
        audit(lambda z: z * 1.0, dimension=2, samples=5, **options)


def test_wrong_limits_are_told() -> None:
    with pytest.raises(InputError, match="most_nodes: a whole number"):
        loop_invariant(squeezed, circle, most_nodes="many")  # pyright: ignore[reportArgumentType]
    with pytest.raises(InputError, match="most_points: a whole number"):
        surface_invariant(squeezed, circle, periodic=(False, True), most_points=0)
    for name, value in (("tolerance", "small"), ("tolerance", -1), ("budget", -1), ("boxes", 0), ("degree", 0.5)):
        with pytest.raises(InputError, match=name):
            certify(lambda z: z, (0, 1), dimension=2, **{name: value})


def test_fewer_digits_within_a_jax_program_are_told() -> None:
    """numpy takes bfloat16 for no floating-point type: its roundings counted as none."""

    def step(z: Any) -> Any:
        return jnp.stack([z[0], z[1] - 0.1 * jnp.sin(z[0].astype("bfloat16"))])

    report = audit(step, dimension=2, samples=5)
    assert any("computes in bfloat16" in note for note in report.notes)
    assert report.brackets["{P,P}"].bound > 1e-5
    with pytest.raises(InputError, match="numbers of type"):
        certify(step, (0, 1), dimension=2)
