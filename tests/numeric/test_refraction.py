"""Rays by Fermat's principle: Snell's law, reflection, the least optical path."""

from itertools import pairwise
from math import hypot, isclose, sqrt

import pytest

from canon.errors import InputError
from canon.numeric.refraction import ray_through_layers, reflected, refracted

LAYERS = (1.0, 1.5, 1.33, 2.4), (2.0, 0.5, 1.0, 0.25)


def _path(indices, thicknesses, crossings):
    return sum(n * hypot(b - a, d) for n, d, (a, b) in zip(indices, thicknesses, pairwise(crossings), strict=True))


@pytest.mark.parametrize("across", [0.0, 1e-9, 0.3, 7.0, 1e9])
def test_the_invariant_is_n_sin_theta_in_every_layer_and_the_ray_arrives(across):
    ray = ray_through_layers(*LAYERS, across)
    assert isclose(ray.places[-1][0], across, rel_tol=1e-14)
    for n, slope in zip(LAYERS[0], ray.slopes, strict=True):
        assert isclose(n * slope / sqrt(1 + slope * slope), ray.invariant, rel_tol=1e-13)


def test_every_other_path_is_longer():
    ray = ray_through_layers(*LAYERS, 3.0)
    crossings = [x for x, _ in ray.places]
    assert isclose(_path(*LAYERS, crossings), ray.optical_path, rel_tol=1e-14)
    for k in (1, 2, 3):
        for shift in (-1e-3, 1e-3):
            moved = [x + shift * (i == k) for i, x in enumerate(crossings)]
            assert _path(*LAYERS, moved) > ray.optical_path + 1e-8


def test_one_layer_is_crossed_straight():
    ray = ray_through_layers([1.7], [3.0], 4.0)
    assert (ray.slopes, ray.optical_path) == ((4 / 3,), 1.7 * 5)


def test_an_interface_refracts_as_the_layers_do():
    ray = ray_through_layers([1.0, 1.5], [1.0, 2.0], 2.5)
    first, second = ray.slopes
    found = refracted((first, 1.0), (0.0, -1.0), 1.0, 1.5)  # the normal's sign doesn't matter
    assert isclose(found[0] / found[1], second, rel_tol=1e-14)
    assert isclose(hypot(*found), 1.0, rel_tol=1e-15)


def test_beyond_the_critical_angle_all_is_reflected():
    assert refracted((0.8, 0.0, 0.6), (0, 0, 1), 1.5, 1.0) is None
    assert refracted((0.6, 0.0, 0.8), (0, 0, 1), 1.5, 1.0) is not None
    assert reflected((0.8, 0.0, 0.6), (0, 0, 1)) == pytest.approx((0.8, 0.0, -0.6), abs=1e-16)
    assert refracted((0.0, 1.0), (0.0, 1.0), 1.5, 1.0) == (0.0, 1.0)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: ray_through_layers([1.0], [1.0, 2.0], 1.0), "one index and one thickness"),
        (lambda: ray_through_layers([1.0, -1.0], [1.0, 2.0], 1.0), "positive numbers"),
        (lambda: ray_through_layers([1.0], [1.0], -1.0), "across: .* at least 0"),
        (lambda: refracted((0, 0), (0, 1), 1.0, 1.5), "not all 0"),
        (lambda: refracted((0, 1), (0, 1), 1.0, float("nan")), "behind: a finite number"),
    ],
)
def test_faults(call, message):
    with pytest.raises(InputError, match=message):
        call()
