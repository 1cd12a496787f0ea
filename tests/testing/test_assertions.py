"""The assertions pass what is right, and say of what is wrong which bracket fails, where, and by how much."""

from typing import Any

import numpy as np
import pytest

from canon import InputError
from canon.testing import (
    assert_canonical,
    assert_order,
    assert_reversible,
    assert_symplectic,
    assert_volume_preserving,
)

Array = np.ndarray


def force(q: Any) -> Any:
    return -np.sin(q) - q**3


def leapfrog(z: Array, h: float = 0.1) -> Array:
    q, p = z[: len(z) // 2], z[len(z) // 2 :]
    p = p + h / 2 * force(q)
    q = q + h * p
    return np.concatenate([q, p + h / 2 * force(q)])


def symplectic_euler(z: Array, h: float = 0.1) -> Array:
    q, p = z[: len(z) // 2], z[len(z) // 2 :]
    p = p + h * force(q)
    return np.concatenate([q + h * p, p])


def rk4(z: Array, h: float = 0.1) -> Array:
    def field(z: Array) -> Array:
        n = len(z) // 2
        return np.concatenate([z[n:], force(z[:n])])

    a = field(z)
    b = field(z + h / 2 * a)
    c = field(z + h / 2 * b)
    d = field(z + h * c)
    return z + h / 6 * (a + 2 * b + 2 * c + d)


def test_symplectic() -> None:
    assert assert_symplectic(leapfrog, dimension=6, samples=200).verdict == "supported"
    with pytest.raises(AssertionError) as failure:
        assert_symplectic(rk4, dimension=2, samples=200)
    first = str(failure.value).splitlines()[0]
    assert first.startswith("rk4 is not symplectic: {Q1,P1} is off by ")
    assert ", bound " in first
    assert ", at q = " in first


def test_canonical_with_a_valence() -> None:
    assert_canonical(lambda q, p: (2 * q, 3 * p), dimension=2, scale=6, samples=20)
    with pytest.raises(AssertionError, match=r"is not canonical: {Q1,P1} is off by 5"):
        assert_canonical(lambda q, p: (2 * q, 3 * p), dimension=2, samples=20)


def test_volume() -> None:
    def sheared(z: Array) -> Array:
        return np.array([z[0], z[1], z[2] + np.sin(z[1]), z[3]])

    assert_volume_preserving(sheared, dimension=4, samples=50)
    with pytest.raises(AssertionError, match=r"is not symplectic: {P1,P2}"):
        assert_symplectic(sheared, dimension=4, samples=50)
    with pytest.raises(AssertionError, match=r"rk4 does not preserve volume: \|det M\| is off by .* at q = "):
        assert_volume_preserving(rk4, dimension=2, samples=50)


def test_reversible() -> None:
    assert_reversible(leapfrog, dimension=4, samples=200)
    assert_reversible(lambda z: leapfrog(leapfrog(z)), dimension=2, samples=200)
    with pytest.raises(AssertionError, match=r"symplectic_euler is not reversible: . comes back off by "):
        assert_reversible(symplectic_euler, dimension=2, samples=200)
    with pytest.raises(AssertionError, match="rk4 is not reversible"):
        assert_reversible(rk4, dimension=2, samples=200)


@pytest.mark.parametrize(("step", "order"), [(symplectic_euler, 1), (leapfrog, 2), (rk4, 4)])
def test_orders_are_measured(step: Any, order: int) -> None:
    measured = assert_order(step, order, start=[0.7, 0.3])
    assert measured == pytest.approx(order, abs=0.25)
    with pytest.raises(AssertionError, match=f"{step.__name__} has order .*, not {order + 1}: at halved steps"):
        assert_order(step, order + 1, start=[0.7, 0.3])


def test_a_step_may_take_positions_and_momenta_apart() -> None:
    def apart(q: Array, p: Array, h: float = 0.1) -> tuple[Array, Array]:
        p = p - h * np.sin(q)
        return q + h * p, p

    for start in ([0.7, 0.3], [0.7, 0.2, 0.3, 0.1]):
        assert assert_order(apart, 1, start=start) == pytest.approx(1, abs=0.25)
        assert assert_order(lambda q, p, h: apart(q, p, h), 1, start=start) == pytest.approx(1, abs=0.25)


def test_a_step_that_works_in_place_is_given_copies() -> None:
    start = np.array([0.7, 0.3])

    def kick_and_drift(z: Array, h: float = 0.1) -> Array:
        z[1] -= h * np.sin(z[0])
        z[0] += h * z[1]
        return z

    assert assert_order(kick_and_drift, 1, start=start) == pytest.approx(1, abs=0.25)
    assert start.tolist() == [0.7, 0.3]
    assert_symplectic(kick_and_drift, dimension=2, samples=20)


def test_an_order_below_the_plateau_is_not_guessed() -> None:
    with pytest.raises(InputError, match="above the rounding plateau"):
        assert_order(rk4, 4, start=[0.7, 0.3], duration=1e-3)


def test_a_linear_problem_is_no_measure_of_an_order() -> None:
    def of_oscillator(z: Array, h: float) -> Array:
        p = z[1] - h / 2 * z[0]
        q = z[0] + h * p
        return np.array([q, p - h / 2 * q])

    with pytest.raises(InputError, match=r"of \(2,\) it makes \(1,\)"):
        assert_order(lambda z, h: z[:1], 2, start=[0.7, 0.3])
    with pytest.raises(InputError, match="as at an equilibrium"):
        assert_order(rk4, 4, start=[0.0, 0.0])
    with pytest.raises(InputError, match="a phase point is a list of numbers"):
        assert_order(of_oscillator, 2, start="0.7")
    with pytest.raises(InputError, match="the step is linear in z"):
        assert_order(of_oscillator, 2, start=[0.7, 0.3])
    assert assert_order(of_oscillator, 2, start=[0.7, 0.3], linear=True) == pytest.approx(2, abs=0.1)


def nested(field: Any, z: Array, h: float) -> Array:
    """z + h f(z + h/2 f(z + h/3 f(z))), Jameson's scheme: of order 3 for linear fields, of order 2 for others."""
    return z + h * field(z + h / 2 * field(z + h / 3 * field(z)))


def test_a_method_that_is_better_on_linear_problems_is_caught() -> None:
    def on_line(z: Array, h: float) -> Array:
        return nested(lambda z: np.array([z[1], -z[0]]), z, h)

    def on_pendulum(z: Array, h: float) -> Array:
        return nested(lambda z: np.array([z[1], -np.sin(z[0]) - z[0] ** 3]), z, h)

    assert assert_order(on_line, 3, start=[0.7, 0.3], linear=True) == pytest.approx(3, abs=0.25)
    with pytest.raises(AssertionError, match="on_pendulum has order 2"):
        assert_order(on_pendulum, 3, start=[0.7, 0.3])


@pytest.mark.parametrize(
    "collapsing", [lambda z: z * 0, lambda z: np.array([z[0], z[0]]), lambda z: np.array([z[0] ** 2, z[1]]) * 1e-200]
)
def test_a_map_that_collapses_volume_is_caught(collapsing: Any) -> None:
    with pytest.raises(AssertionError, match="does not preserve volume"):
        assert_volume_preserving(collapsing, dimension=2, samples=20)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"order": 0}, "order: a whole number is needed, at least 1, at most 1000, not 0"),
        ({"order": "2"}, "order: a whole number"),
        ({"steps": 0}, "steps: a whole number"),
        ({"duration": np.nan}, "duration: a finite number other than 0"),
        ({"tolerance": np.nan}, "tolerance: a finite number, at least 0"),
        ({"tolerance": 7.0}, "tolerance: an order less by 1 is another order"),
        ({"exact": [0.1]}, "exact: a phase point like the start is expected, 2 finite numbers"),
        ({"start": [np.nan, 0.1]}, "start: a phase point is a list of finite numbers"),
    ],
)
def test_what_says_nothing_of_an_order_is_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        assert_order(rk4, **{"order": 4, "start": [0.7, 0.3], **options})


def test_involutions_are_given_copies_and_are_functions() -> None:
    def in_place(points: Array) -> Array:
        points[:, 1] *= -1
        return points

    assert_reversible(leapfrog, dimension=2, involution=in_place, samples=20)
    with pytest.raises(InputError, match=r"involution: an involution of points .* is a function, not 3"):
        assert_reversible(leapfrog, dimension=2, involution=3)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="samples: a whole number is needed, at least 1, at most 1000000, not 0"):
        assert_reversible(leapfrog, dimension=2, samples=0)


def _raises(z: Array) -> Array:
    raise ZeroDivisionError("nowhere")


@pytest.mark.parametrize(
    "assertion", [assert_symplectic, assert_canonical, assert_volume_preserving, assert_reversible]
)
def test_a_map_without_any_value_fails_and_what_is_no_map_is_an_input_error(assertion: Any) -> None:
    with pytest.raises(AssertionError, match="no finite value at any of"):
        assertion(lambda z: z * np.nan, dimension=2)
    with pytest.raises(AssertionError, match=r"_raises: the map raises at every point.*ZeroDivisionError: nowhere"):
        assertion(_raises, dimension=2)
    for no_map in (lambda z: z[:1], lambda z: z + 1j, lambda z: None):
        with pytest.raises(InputError, match="the map returns"):
            assertion(no_map, dimension=2)
