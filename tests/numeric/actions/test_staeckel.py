"""Stäckel actions against 40 digits of the same integrals, and against the spherical limit."""

from typing import Any

import mpmath as mp
import numpy as np
import pytest

from canon.errors import InputError
from canon.numeric.actions.separable import staeckel_actions
from canon.numeric.actions.staeckel_frequencies import staeckel_frequencies
from tests.numeric.actions.spheroidal import spheroidal_orbit

C, DELTA, M = 0.6, 0.8, 2.0
KUZMIN_KUTUZOV = "k/(c + sqrt(t + c**2))"


def reference(R: float, z: float, p_R: float, p_z: float, L: float, nodes: int = 120) -> tuple[Any, Any]:
    """(J_λ, J_ν) for V = −1/(√λ + √ν), by Gauss–Chebyshev in l and in n; de Zeeuw (1985)."""
    with mp.workdps(40):
        m, D2, _, _, _, depth, I3, low, high, top = spheroidal_orbit(R, z, p_R, p_z, L, c=C, delta=DELTA, m=M)

        def over(f: Any) -> Any:
            angles = [mp.pi * (2 * k + 1) / (2 * nodes) for k in range(nodes)]
            return mp.pi / nodes * sum(f(mp.cos(x)) * mp.sin(x) for x in angles)

        mid, half = (low + high) / 2, (high - low) / 2

        def along(u: Any) -> Any:
            t = mid + half * u
            return half * mp.sqrt(max(m * (depth(t) - I3) / (2 * (t - D2) * t), 0))

        def across(u: Any) -> Any:
            t = top * (1 + u) / 2
            return top / 2 * mp.sqrt(max(m * (I3 - depth(t)) / (2 * (D2 - t) * t), 0))

        return 2 * over(along), 4 * over(across)


def states(spread: float, height: float, count: int) -> list[np.ndarray]:
    """Orbits about the circles of the plane, whose radii differ."""
    rng = np.random.default_rng(8)
    R = np.exp(0.4 * rng.normal(size=count))
    a = np.hypot(C, DELTA)
    s = np.sqrt(R * R + a * a)
    L = M * R * R / np.sqrt(M * s) / (C + s)
    p = L / R
    return [
        R, height * rng.normal(size=count), spread * p * rng.normal(size=count), height * p * rng.normal(size=count),
        L * (1 - spread * rng.random(count)),
    ]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(("spread", "height"), [(0.3, 0.2), (0.3, 1e-5), (1e-6, 1e-9)])
def test_both_actions_near_the_plane_and_far_from_it(spread: float, height: float) -> None:
    rows = states(spread, height, 4)
    found = staeckel_actions(KUZMIN_KUTUZOV, DELTA, *rows, m=M, parameters={"c": C, "k": 1})
    assert np.array_equal(found.azimuthal, 2 * np.pi * rows[4])
    for k in range(4):
        radial, vertical = reference(*(float(row[k]) for row in rows))
        assert abs(found.radial[k] - radial) <= found.radial_bound[k]
        assert abs(found.vertical[k] - vertical) <= found.vertical_bound[k]
        assert abs(found.vertical[k] / vertical - 1) < 3e-15
    assert np.median(found.radial_bound / found.radial) < 1e-12 / spread
    assert np.all(found.vertical_bound < 1e-13 * found.vertical)


def test_the_vertical_action_does_not_vanish_with_the_height() -> None:
    """J_z is quadratic in the height, all the way down: galpy's is 0 there."""
    heights = np.array([1e-3, 1e-6, 1e-12, 1e-30])
    found = staeckel_actions(KUZMIN_KUTUZOV, DELTA, 1.0, heights, 0.1, 0.0, 1.0, m=M, parameters={"c": C, "k": 1})
    ratio = found.vertical / heights**2
    assert np.allclose(ratio, ratio[-1], rtol=1e-5)
    assert np.allclose(ratio[1:], ratio[-1], rtol=1e-11)


@pytest.mark.parametrize(
    ("state", "message"),
    [
        ((1.0, 0.0, 0.1, 0.0, 0.0), "orbit 0 has no R > 0 and L_z ≠ 0"),
        ((1.0, 0.0, 9.0, 0.0, 1.0), "orbit 0 has no turning points on both sides: it is not bound"),
    ],
)
def test_what_is_refused(state: tuple[float, ...], message: str) -> None:
    with pytest.raises(InputError, match=message):
        staeckel_actions(KUZMIN_KUTUZOV, DELTA, *state, m=M, parameters={"c": C, "k": 1})


def actions_and_energy(x: np.ndarray) -> np.ndarray:
    """J_λ, J_ν, J_φ in 40 digits' quadrature, and the energy, of a state (R, z, p_R, p_z, L)."""
    R, z, p_R, p_z, L = map(mp.mpf, x)
    S = R * R + z * z + mp.mpf(DELTA) ** 2
    l = (S + mp.sqrt(S * S - 4 * z * z * mp.mpf(DELTA) ** 2)) / 2
    n = z * z * mp.mpf(DELTA) ** 2 / l
    c = mp.mpf(C)
    E = (p_R**2 + p_z**2 + L**2 / R**2) / (2 * mp.mpf(M)) - 1 / (mp.sqrt(l + c * c) + mp.sqrt(n + c * c))
    return np.array([*reference(*x, nodes=60), 2 * mp.pi * L, E])


@pytest.mark.parametrize("height", [pytest.param(0.2, marks=pytest.mark.slow), 1e-7])
def test_frequencies_are_derivatives_of_the_energy(height: float) -> None:
    """dE = ν·dJ along each direction of phase space: differences in 40 digits, so that steps may be tiny."""
    state = np.array([1.0, height / 3, 0.2, height, 0.7])
    found = staeckel_frequencies(KUZMIN_KUTUZOV, DELTA, *state, m=M, parameters={"c": C, "k": 1})
    rates = [float(found.radial), float(found.vertical), float(found.azimuthal)]
    with mp.workdps(40):
        for k in (0, 2, 3, 4):
            step = mp.mpf(10) ** -9
            sides = []
            for sign in (1, -1):
                moved = [mp.mpf(x) for x in state]
                moved[k] += sign * step
                sides.append(actions_and_energy(moved))
            *dJ, dE = (sides[0] - sides[1]) / (2 * step)
            along = sum(rate * change for rate, change in zip(rates, dJ, strict=True))
            assert abs(along - dE) <= float(found.relative_bound) * sum(
                abs(r * x) for r, x in zip(rates, dJ, strict=True)
            )
    assert found.relative_bound < 1e-10


def test_frequencies_in_the_plane() -> None:
    heights = [0.0, 1e-9]
    found = staeckel_frequencies(KUZMIN_KUTUZOV, DELTA, 1.0, heights, 0.2, 0.0, -0.7, m=M, parameters={"c": C, "k": 1})
    assert found.vertical[0] == pytest.approx(found.vertical[1], rel=1e-13)
    assert np.all(found.azimuthal < 0)


@pytest.mark.slow
@pytest.mark.parametrize("L", [1e-3, 1e-6, 1e-12])
def test_orbits_that_pass_by_the_axis_beyond_the_foci(L: float) -> None:
    """Each passage adds π to φ, however close: ν_φ tends to ν_ν, and J_ν + 2πL to what J_ν is in a plane through it."""
    state, options = ([0.3, 1.5], [1.2, 0.0], [0.35, 0.1], [-0.1, 0.55]), {"c": C, "k": 1}
    found = staeckel_frequencies(KUZMIN_KUTUZOV, DELTA, *state, L, m=M, parameters=options)
    assert np.all(np.abs(found.azimuthal / found.vertical - 1) < L + found.relative_bound)
    assert np.all(found.relative_bound < 1e-10)
    near = staeckel_actions(KUZMIN_KUTUZOV, DELTA, *state, L, m=M, parameters=options)
    limit = staeckel_actions(KUZMIN_KUTUZOV, DELTA, *state, 1e-13, m=M, parameters=options)
    change = near.vertical - limit.vertical + 2 * np.pi * (L - 1e-13)
    assert np.all(np.abs(change) < 100 * L * L + near.vertical_bound + limit.vertical_bound)
    assert np.all(near.vertical_bound < 1e-12)
