"""Audits of maps: known integrators and maps get their known answers."""

import json
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from canon import AuditFailed, AuditReport, InputError, PhaseSpace, Transformation, audit
from tests.claims.known_maps import (
    Array,
    H,
    henon_attractor,
    henon_map,
    implicit_midpoint,
    leapfrog,
    mistaken_leapfrog,
    rk4,
    standard_map,
    symplectic_euler,
    velocity_verlet,
)


@pytest.mark.parametrize("step", [velocity_verlet, implicit_midpoint, symplectic_euler, standard_map, henon_map])
def test_symplectic_maps_are_supported(step: Callable[[Array], Array]) -> None:
    report = audit(step, dimension=2)
    assert report.verdict == "supported", str(report)
    assert report.require() is report
    assert report.audited == 1000
    assert abs(report.valence - 1) < 1e-12
    assert not report.volume.exceeds
    assert not any(order.exceeds for order in report.invariants)


def test_runge_kutta_is_not_symplectic() -> None:
    report = audit(rk4, dimension=2)
    assert report.verdict == "undecided"  # a black box is never refuted
    assert report.worst.label == "{Q1,P1}"
    assert 1e-9 < report.worst.size < 1e-7
    assert report.worst.bound < 1e-13
    assert report.volume.exceeds


def test_leapfrog_passes_and_a_mistaken_one_fails_with_bracket_point_and_size() -> None:
    assert audit(leapfrog, dimension=4).verdict == "supported"
    report = audit(mistaken_leapfrog, dimension=4)
    assert report.verdict == "undecided"
    (failure,) = report.failures
    worst = report.worst
    assert failure.startswith(f"{worst.label} is off by {worst.size:.3g}, bound {worst.bound:.2g}, at q1 = ")
    q, p = np.array(worst.point[:2]), np.array(worst.point[2:])
    k = int(worst.label[2]) - 1
    moved = q + H * (p - H / 2 * np.sin(q))
    assert np.all(np.isfinite(moved))
    assert worst.size == pytest.approx(H**2 / 2 * np.cos(q[k]), rel=1e-6)
    with pytest.raises(AuditFailed, match="fails: "):
        report.require()
    with pytest.raises(TypeError, match="neither true nor false"):
        bool(report)


def test_brackets_of_momenta_are_looked_at_apart() -> None:
    """P1 = p1 + q2 keeps every {Q_i,P_j}: a check of these alone passes it."""
    report = audit(lambda z: np.array([z[0], z[1], z[2] + z[1], z[3]]), dimension=4)
    assert report.verdict == "undecided"
    assert not report.brackets["{Q,P}"].exceeds
    assert not report.brackets["{Q,Q}"].exceeds
    assert report.brackets["{P,P}"].label == "{P1,P2}"
    assert report.brackets["{P,P}"].size == 1
    assert not report.volume.exceeds
    assert [order.exceeds for order in report.invariants] == [True, False]


def test_the_valence_is_fitted() -> None:
    report = audit(henon_attractor, dimension=2)
    assert report.verdict == "undecided"
    assert report.valence == pytest.approx(-0.3, abs=1e-14)
    assert "all brackets agree with valence -0.3 instead of 1" in report.notes
    assert report.determinant == pytest.approx((-0.3, -0.3))
    assert audit(henon_attractor, dimension=2, scale=-0.3).verdict == "supported"


@pytest.mark.parametrize("size", [1e-3, 1e-6, 1e-9])
def test_mutants_are_caught(size: float) -> None:
    report = audit(lambda z: symplectic_euler(z) * np.array([1 + size, 1]), dimension=2)
    assert report.verdict == "undecided"
    assert report.worst.size == pytest.approx(size, rel=1e-4)


def test_badly_scaled_units_are_no_alarm_and_no_hiding_place() -> None:
    """An electron in SI units: a drift, and a drift that loses 1e-9 of the momentum."""
    domain = [(-1e-10, 1e-10), (-1e-24, 1e-24)]
    drift = audit(lambda z: np.array([z[0] + 1e-17 * z[1] / 9.1e-31, z[1]]), dimension=2, domain=domain)
    assert drift.verdict == "supported"
    lossy = audit(lambda z: np.array([z[0] + 1e-17 * z[1] / 9.1e-31, z[1] * (1 - 1e-9)]), dimension=2, domain=domain)
    assert lossy.verdict == "undecided"
    assert lossy.worst.size == pytest.approx(1e-9, rel=1e-5)


def test_a_jax_function_has_running_bounds() -> None:
    def step(q: Any, p: Any) -> Any:
        p = p - H * jnp.sin(q)
        return q + H * p, p

    report = audit(step, dimension=2, samples=50)
    assert report.verdict == "supported"
    assert (report.derivatives, report.errors) == ("forward-mode AD", "bound")
    assert not jax.config.jax_enable_x64  # the host's own setting is left alone


def jax_step(z: Any, defect: float = 0.0) -> Any:
    """A kick and a drift of three coupled oscillators, with a defect in the last momentum."""
    q, p = z[:3], z[3:]
    p = p - H * q * (1 + q @ q)
    return jnp.concatenate([q + H * p, p * jnp.array([1.0, 1.0, 1.0 + defect])])


def test_a_million_points_are_swept_and_their_worst_examined() -> None:
    report = audit(jax_step, dimension=6, samples=200_000)
    assert report.verdict == "supported"
    assert (report.audited, report.failing) == (200_000, 0)
    assert 256 < report.examined < 300
    assert all(defect.largest < 1e-15 for defect in report.brackets.values())


def test_a_defect_in_a_corner_is_found_by_sweeping() -> None:
    def corner(z: Any) -> Any:
        return jnp.where(z[0] > 0.999, jax_step(z, 1e-11), jax_step(z))

    report = audit(corner, dimension=6, samples=200_000)
    assert report.verdict == "refuted"
    assert 50 < report.failing < 150  # a part 1/2000 of the box
    assert report.worst.label == "{Q3,P3}"
    assert report.worst.point[0] > 0.999
    assert report.worst.size == pytest.approx(1e-11, rel=1e-3)
    assert any(f"exceed their bounds at {report.failing} of 200000 points" in note for note in report.notes)
    points = np.random.default_rng(0).uniform(-1, 1, (60_000, 6))
    given = audit(corner, dimension=6, domain=points)
    assert given.failing == int((points[:, 0] > 0.999).sum())
    assert given.audited == 60_000


def test_formulas_are_swept_within_their_domain() -> None:
    space = PhaseSpace("q", "p", new=("Q", "P"))
    q, p = space.symbols("q p")
    right = Transformation(space.where(q > 0), Q=q**3, P=p / (3 * q**2))
    report = audit(right, domain=[(-1, 3), (-1, 1)], samples=50_000)
    assert report.verdict == "supported"
    outside = report.samples - report.audited
    assert abs(outside / 50_000 - 0.25) < 0.01
    assert f"{outside} of 50000 points lie outside the domain of the formulas" in report.notes


def test_a_jax_function_is_refuted_by_balls_alone() -> None:
    def mistaken(z: Any) -> Any:
        return jnp.stack([z[0] + 0.5 * z[1], z[1] - 0.5 * jnp.sin(z[0])])

    report = audit(mistaken, dimension=2, samples=50)
    assert report.verdict == "refuted"
    assert report.witness is not None
    place = [float(Fraction(report.witness[name])) for name in ("q", "p")]
    assert place == list(report.worst.point)

    def black_box(z: Any) -> Any:
        return jax.lax.while_loop(lambda w: jnp.abs(w[0]) < 0.1, lambda w: w + 1.0, mistaken(z))

    report = audit(black_box, dimension=2, samples=50)
    assert report.verdict == "undecided"
    assert report.failures


def test_a_false_derivative_refutes_nothing() -> None:
    """The derivative is declared wrongly: balls see that the values are a symplectic map's."""

    @jax.custom_jvp
    def declared(x: Any) -> Any:
        return jnp.sin(x)

    declared.defjvp(lambda primals, tangents: (jnp.sin(primals[0]), 2 * jnp.cos(primals[0]) * tangents[0]))

    def step(z: Any) -> Any:
        moved = z[1] + declared(z[0])
        return jnp.stack([z[0] + jnp.cos(declared(z[0])) + moved, moved])

    report = audit(step, dimension=2, samples=50)
    assert report.verdict != "refuted" or any("derivatives are not" in doubt for doubt in report.doubts)
    assert any("derivatives are not those of the values" in doubt for doubt in report.doubts)


def test_linear_solves_and_loops_have_estimates_and_say_so() -> None:
    def newton(z: Any) -> Any:
        """Two Newton steps for the implicit midpoint rule of a pendulum."""
        rest = lambda y: y - z - H * jnp.stack([(y[1] + z[1]) / 2, -jnp.sin((y[0] + z[0]) / 2)])
        y = z
        for _ in range(4):
            y = y - jnp.linalg.solve(jax.jacfwd(rest)(y), rest(y))
        return y

    report = audit(newton, dimension=2, samples=200)
    assert report.verdict == "supported"
    assert report.errors == "estimate"
    assert "estimated errors" in str(report)


def test_many_degrees_of_freedom_need_no_more_memory() -> None:
    """120 variables: blocks have fewer points, and J is never formed."""

    def ring(z: Any) -> Any:
        q, p = z[:60], z[60:]
        p = p - H * (jnp.sin(q) + 2 * q - jnp.roll(q, 1) - jnp.roll(q, -1))
        return jnp.concatenate([q + H * p, p])

    report = audit(ring, dimension=120, samples=5)
    assert report.verdict == "supported"
    assert report.invariants == ()
    assert not report.volume.exceeds


SPACE = PhaseSpace("q1 q2", "p1 p2", new=("Q1 Q2", "P1 P2"), real="h")
q1, q2, p1, p2, h = SPACE.symbols("q1 q2 p1 p2 h")


def test_formulas_are_refuted_by_balls_only() -> None:
    shear = Transformation(SPACE, Q=(q1, q2), P=(p1 + h * q2, p2))
    report = audit(shear, parameters={"h": 0.1}, samples=50)
    assert report.verdict == "refuted"
    assert not report
    assert report.witness is not None
    assert set(report.witness) >= {"h"}
    assert (report.map, report.errors) == ("formulas", "bound")
    with pytest.raises(InputError, match="no value is given for h"):
        audit(shear)
    with pytest.raises(InputError, match="did you mean 'h'"):
        audit(shear, parameters={"hh": 1.0})


def test_formulas_outside_their_domain_are_left_out() -> None:
    space = PhaseSpace("q", "p", new=("Q", "P"))
    q, p = space.symbols("q p")
    report = audit(Transformation(space, Q=q**3, P=p / (3 * q**2)), domain={"q": (0.5, 2)}, samples=50)
    assert report.verdict == "supported"
    half = Transformation(space.where(q > 0), Q=q, P=p)
    assert any("outside the domain" in note for note in audit(half, samples=50).notes)


def test_a_report_is_data() -> None:
    record = json.loads(json.dumps(audit(rk4, dimension=2, samples=20).as_record()))
    assert record["verdict"] == "undecided"
    assert set(record["brackets"]) == {"{Q,Q}", "{P,P}", "{Q,P}"}
    assert set(record["brackets"]["{Q,P}"]["at"]) == {"q", "p"}


def test_an_audit_is_repeatable() -> None:
    first, second = (audit(rk4, dimension=2, samples=20, seed=3) for _ in range(2))
    assert isinstance(first, AuditReport)
    assert first == second
    assert first != audit(rk4, dimension=2, samples=20, seed=4)
