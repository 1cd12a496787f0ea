"""Levi-Civita's coordinates and Kustaanheimo and Stiefel's: what they are, proved; orbits through collisions there."""

from fractions import Fraction
from functools import cache
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
import sympy as sp

from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.errors import InputError
from canon.numeric.engines import installed
from canon.numeric.exact.kepler import kepler
from canon.numeric.integrate import integrate
from canon.numeric.integrators import separable
from canon.numeric.integrators.catalogue import method
from canon.numeric.levi_civita import Regularised, matrix, regularised
from canon.numeric.precision import double
from canon.numeric.regularised_orbit import RegularisedOrbit, regularised_orbit

x, y, z, px, py, pz, t = sp.symbols("x y z px py pz t", real=True)
LINE, PLANE, SPACE = ((x,), (px,)), ((x, y), (px, py)), ((x, y, z), (px, py, pz))
TURN = 2 * np.pi
STORMER, SPLITTING = method("stormer12"), method("sofroniou_spaletta10")
EXACT = jax.jit(kepler)
FIELD, BUMP = y / 32, sp.Rational(1, 1000) / (x**2 + y**2)


def attracted(place: Any, V: Any = 0, m: Any = 1, k: Any = 1) -> Any:
    q, p = place
    return sum(s**2 for s in p) / (2 * m) - k / sp.sqrt(sum(s**2 for s in q)) + V


@cache
def plane(V: Any = sp.S.Zero) -> Regularised:
    return regularised(attracted(PLANE, V), *PLANE, t)


def ellipse(e: float) -> tuple[np.ndarray, np.ndarray]:
    return np.array([1 - e, 0.0]), np.array([0.0, ((1 + e) / (1 - e)) ** 0.5])


def both(orbit: RegularisedOrbit) -> np.ndarray:
    return np.concatenate([orbit.q, orbit.p], axis=-1)


def exact(q: np.ndarray, p: np.ndarray, time: float) -> np.ndarray:
    with double():
        return np.concatenate([np.asarray(each) for each in EXACT(q, p, 1.0, time)])


RELATION = "u1*w4 - u2*w3 + u3*w2 - u4*w1"


@pytest.mark.parametrize(
    ("place", "V", "wrong"),
    [(LINE, x / 7, ""), (PLANE, x / 7 + y**2 / (2 * x**2 + 2 * y**2) ** 2, ""), (SPACE, x / 7 + x * y, RELATION)],
    ids=["line", "plane", "space"],
)
def test_what_is_integrated_is_proved(place: Any, V: Any, wrong: str) -> None:
    """The map is canonical, and r (H + b) = K, in space on the bilinear relation's surface and not off it."""
    made = regularised(attracted(place, V, m=3, k=2), *place)
    u, w = made.coordinates[:-1], made.momenta[:-1]
    r = sum(s**2 for s in u)
    L = sp.Matrix(matrix(np.array(u, dtype=object)))
    q, p = [*(L * sp.Matrix(u))], [*(L * sp.Matrix(w) / (2 * r))]
    H = attracted(place, V, m=3, k=2).subs(sp.sqrt(sum(s**2 for s in place[0])), sp.Symbol("R"))
    names = lambda each: "[" + ", ".join(f'"{s}"' for s in each) + "]"
    text = f"""
        [phase_space]
        q = {names(u)}
        p = {names(w)}
        Q = {names(place[0])}
        P = {names(place[1])}
        [symbols]
        b = "real"
        [definitions]
        R = "{r}"
        {{}}
        [transformation]
        Q = {names(q)}
        P = {names(p)}
        [[claim]]
        kind = "canonical"
        [[claim]]
        kind = "identity"
        lhs = "R*({H} + b)"
        rhs = "{made.K}"
        """.replace("    ", "")
    surface = f'[domain]\non = ["{wrong}"]' if wrong else '[domain]\nwhere = ["u1 > 0"]'
    assert [verify(claim).status for claim in read_text(text.format(surface)).claims] == ["proved", "proved"]
    if wrong:
        assert [verify(claim).status for claim in read_text(text.format("")).claims] == ["refuted", "refuted"]


@pytest.mark.parametrize("place", [LINE, PLANE, SPACE], ids=["line", "plane", "space"])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_states_there_and_back(place: Any, sign: float) -> None:
    made = regularised(attracted(place, m=3, k=2), *place, sign=sign)
    random = np.random.default_rng(5)
    q, p = random.normal(size=(2, len(place[0])))
    q[0] = sign * abs(q[0])
    state = made.state(q, p)
    back = made.shown(state)
    assert np.abs(back[0] - q).max() < 1e-15
    assert np.abs(back[1] - p).max() < 2e-15
    assert (
        abs(float(made.K.subs(dict(zip((*made.coordinates, *made.momenta), np.concatenate(state), strict=True)))))
        < 1e-14
    )
    if len(q) == 3:
        (u1, u2, u3, u4), (w1, w2, w3, w4) = state[0][:4], state[1][:4]
        assert abs(u1 * w4 - u2 * w3 + u3 * w2 - u4 * w1) < 1e-15


def test_the_energy_is_that_of_the_numbers_that_are_given() -> None:
    """At e = 0.99 it is the difference of sums two hundred times as large, as fractions have it."""
    x0, v = Fraction(float(ellipse(0.99)[0][0])), Fraction(float(ellipse(0.99)[1][1]))
    exact = v * v / 2 - 1 / x0
    assert plane().energy(*ellipse(0.99)) == float(exact)
    assert plane(BUMP).energy(*ellipse(0.99)) == float(exact + Fraction(1, 1000) / x0**2)


SLOW_SPLITTING = pytest.param(SPLITTING, id=SPLITTING.name, marks=pytest.mark.slow)


@pytest.mark.parametrize("chosen", [pytest.param(STORMER, id=STORMER.name), SLOW_SPLITTING])
@pytest.mark.parametrize(
    ("e", "tolerance"),
    [(0.0, 1e-10), (0.99, 2e-8), pytest.param(1.0, 1e-10, marks=pytest.mark.slow), (1.5, 1e-10)],
)
def test_keplers_orbits_at_times(e: float, tolerance: float, chosen: Any) -> None:
    """Circle, ellipse, parabola and hyperbola, at the times of the exact flow."""
    q, p = ellipse(e) if e < 1 else (np.array([0.5, 0.0]), np.array([0.0, 2 * (0.5 + e / 2) ** 0.5]))
    times = [0.0, 1e-3, 0.3, 1.7 * TURN, 20 * TURN]
    made = plane()
    step = 0.06 * made.pace(float(made.state(q, p)[0][-1]), times[-1])
    found = regularised_orbit(made, chosen, q, p, times, step=step)
    assert both(found).shape == (5, 4)
    sizes = np.abs(both(found)).max()
    for time, state in zip(times, both(found), strict=True):
        assert np.abs(state - exact(q, p, time)).max() < tolerance * sizes


@pytest.mark.slow
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_fall_into_the_centre_is_thrown_back(sign: float) -> None:
    """From rest at distance 1: back there after π/√2, and as high as it fell at times that are mirrored."""
    made = regularised(attracted(LINE), *LINE, sign=sign)
    period = np.pi / 2**0.5
    found = regularised_orbit(made, STORMER, [sign], [0.0], [0.0, 0.3 * period, 0.7 * period, period], step=0.1)
    assert sign * found.q[:, 0] == pytest.approx([1, found.q[1, 0] * sign, found.q[1, 0] * sign, 1], abs=1e-10)
    assert found.p[1:, 0] == pytest.approx([found.p[1, 0], -found.p[1, 0], 0], abs=1e-9)
    assert found.p[1, 0] * sign < -0.5
    along = regularised_orbit(plane(), STORMER, [0.6, 0.8], [0.0, 0.0], [0.0, period], step=0.1)
    assert along.q[-1] == pytest.approx([0.6, 0.8], abs=1e-10)


def test_precession_by_an_inverse_square() -> None:
    """c/r² beside −1/r: r as for the angular momentum √(L² + 2c), and the angle slower than there by L over that."""
    q, p = ellipse(0.9)
    L = q[0] * p[1]
    fast = (L**2 + 0.002) ** 0.5
    time = 7.3
    place = exact(q, np.array([0.0, fast / q[0]]), time)
    turns = 2 * np.pi * np.floor(time / (2 * np.pi * (2 / q[0] - (fast / q[0]) ** 2) ** -1.5) + 0.5)
    angle = (np.arctan2(place[1], place[0]) + turns) * L / fast
    found = regularised_orbit(plane(BUMP), STORMER, q, p, [0.0, time], step=0.01)
    expected = np.hypot(*place[:2]) * np.array([np.cos(angle), np.sin(angle)])
    assert found.q[-1] == pytest.approx(expected, abs=1e-8)


@pytest.mark.parametrize(("name", "few", "many"), [("stormer12", 36, 50), ("nystrom8", 10, 16)])
def test_order_in_a_uniform_field(name: str, few: int, many: int) -> None:
    """Measured at a time, where the fictitious time has an error too; the oscillators' equations are of degree 3."""
    q, p = ellipse(0.95)

    def end(chosen: Any, steps: int) -> np.ndarray:
        return both(regularised_orbit(plane(FIELD), chosen, q, p, [0.0, 2.6 * TURN], step=TURN / steps))[-1]

    reference = end(SPLITTING, 30)
    errors = [np.abs(end(method(name), steps) - reference).max() for steps in (few, many)]
    assert errors[1] > 1e-12, "on the rounding plateau nothing is measured"
    assert np.log(errors[0] / errors[1]) / np.log(many / few) == pytest.approx(method(name).traits.order, abs=1)


@pytest.mark.slow
def test_against_steps_in_time_itself() -> None:
    """In space, with a force that isn't central and one that depends on time, by another problem's steps."""
    V = x * y / 8 - z / 16 + sp.cos(2 * t) * x / 8
    made = regularised(attracted(SPACE, V), *SPACE, t, t0=0.5)

    def force(q: Any, time: Any) -> Any:
        a, b, c = q
        pull = (a * a + b * b + c * c) ** -1.5
        return jnp.stack([-a * pull - b / 8 - jnp.cos(2 * time) / 8, -b * pull - a / 8, -c * pull + 1 / 16])

    q, p = np.array([0.7, 0.1, -0.2]), np.array([-0.3, 0.9, 0.4])
    problem = separable(lambda v: v, force, time_dependent=True)
    end = integrate(problem, SPLITTING, (q, p), duration=3.0, steps=1500, t0=0.5).state
    found = regularised_orbit(made, SPLITTING, q, p, [0.5, 3.5], step=0.02)
    assert both(found)[-1] == pytest.approx(np.concatenate(end), abs=1e-9)
    with pytest.raises(InputError, match="T quadratic"):
        regularised_orbit(made, STORMER, q, p, [0.5, 3.5], step=0.02)


@pytest.mark.slow
@pytest.mark.skipif(not installed(), reason="the extra `native` is not installed")
@pytest.mark.parametrize("compensated", [False, True])
def test_both_engines_agree(compensated: bool) -> None:
    q, p = ellipse(0.99)
    native, xla = (
        regularised_orbit(
            plane(FIELD), STORMER, q, p, [0.0, 5.0, 9.0], step=0.1, compensated=compensated, engine=engine
        )
        for engine in ("native", "xla")
    )
    assert (native.engine, xla.engine) == ("native", "xla")
    assert np.abs(both(native) - both(xla)).max() < 1e-10


def test_runs_find_their_length_and_can_be_stopped() -> None:
    q, p = np.array([1.0, 0.0]), np.array([-0.3, 1.6])
    far = regularised_orbit(plane(), STORMER, q, p, [0.0, 1.0, 9.0, 50.0, 2000.0], step=0.05)
    assert both(far)[-1] == pytest.approx(exact(q, p, 2000.0), rel=1e-9)
    q, p = ellipse(0.3)
    stopped = regularised_orbit(plane(), STORMER, q, p, [0.0, 0.5, 1.0, 1.5, 1e5], step=1e-3, stop=lambda run: True)
    assert stopped.interrupted
    assert len(stopped.q) == 4
    limited = regularised_orbit(plane(), STORMER, q, p, [0.0, 0.5, 1.0, 1.5, 1e7], step=0.1, most_steps=100)
    assert len(limited.q) == 4


@pytest.mark.slow
def test_where_many_steps_are_few_states_are_kept() -> None:
    q, p = ellipse(0.3)
    fine = regularised_orbit(plane(), STORMER, q, p, [0.0, TURN], step=TURN / 400_000)
    assert fine.q[-1] == pytest.approx(q, abs=1e-11)


@pytest.mark.parametrize(
    ("H", "place", "message"),
    [
        (attracted(PLANE, x * py), PLANE, "nothing else of the momenta"),
        (attracted(PLANE, 0, k=-1), PLANE, "k > 0"),
        (attracted(PLANE, 0, k=sp.Symbol("b", real=True)), PLANE, "no value is given for b"),
        (px**2 / 2 + py**2 / 4 - 1 / sp.sqrt(x**2 + y**2), PLANE, "nothing else of the momenta"),
        (attracted(PLANE, x * sp.Symbol("g")), PLANE, "no value is given for g"),
        (attracted(((x, y, z, t), (px, py, pz, t))), ((x, y, z, t), (px, py, pz, t)), "not of 4"),
    ],
)
def test_what_is_refused(H: Any, place: Any, message: str) -> None:
    with pytest.raises(InputError, match=message):
        regularised(H, *place)


def test_what_is_refused_of_an_orbit() -> None:
    q, p = ellipse(0.1)
    with pytest.raises(InputError, match="increase from t0 = 0"):
        regularised_orbit(plane(), STORMER, q, p, [0.0, 0.0], step=0.1)
    with pytest.raises(InputError, match="positive"):
        regularised_orbit(plane(), STORMER, q, p, [0.0, 1.0], step=0.0)
    with pytest.raises(InputError, match="no place"):
        plane().state([0.0, 0.0], [0.0, 1.0])
    with pytest.raises(InputError, match="no place"):
        regularised(attracted(LINE), *LINE).state([-1.0], [0.0])
