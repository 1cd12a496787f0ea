"""Audits of maps: known integrators and maps get their known answers, and bad input a clear message."""

import json
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from canon import AuditFailed, AuditReport, InputError, PhaseSpace, Transformation, audit

Array = np.ndarray
H = 0.1


def leapfrog(q: Any, p: Any) -> Any:
    """Kick, drift, kick of two pendulums."""
    p = p - H / 2 * np.sin(q)
    q = q + H * p
    return q, p - H / 2 * np.sin(q)


def mistaken_leapfrog(q: Any, p: Any) -> Any:
    """The second kick with the force at the old positions."""
    half = p - H / 2 * np.sin(q)
    return q + H * half, half - H / 2 * np.sin(q)


def field(z: Array) -> Array:
    return np.array([z[1], -np.sin(z[0])])


def rk4(z: Array) -> Array:
    a = field(z)
    b = field(z + H / 2 * a)
    c = field(z + H / 2 * b)
    d = field(z + H * c)
    return z + H / 6 * (a + 2 * b + 2 * c + d)


def velocity_verlet(z: Array) -> Array:
    q, v = z
    moved = q + H * v - H**2 / 2 * np.sin(q)
    return np.array([moved, v - H / 2 * (np.sin(q) + np.sin(moved))])


def implicit_midpoint(z: Array) -> Array:
    y = z
    for _ in range(40):
        y = z + H * field((z + y) / 2)
    return y


def symplectic_euler(z: Array) -> Array:
    p = z[1] - H * np.sin(z[0])
    return np.array([z[0] + H * p, p])


def standard_map(z: Array) -> Array:
    p = z[1] + 0.9 * np.sin(z[0])
    return np.array([np.mod(z[0] + p, 2 * np.pi), p])


def henon_map(z: Array) -> Array:
    """The area-preserving one: a shear, then a rotation."""
    c, s = np.cos(0.5), np.sin(0.5)
    kicked = z[1] - z[0] ** 2
    return np.array([c * z[0] - s * kicked, s * z[0] + c * kicked])


def henon_attractor(z: Array) -> Array:
    """Hénon's dissipative map, det M = −0.3."""
    return np.array([1 - 1.4 * z[0] ** 2 + z[1], 0.3 * z[0]])


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


# -- bad input ------------------------------------------------------------------------------------


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
def test_hidden_state_is_noticed(numbers: Any) -> None:
    calls: list[int] = []

    def remembers(z: Any) -> Any:
        calls.append(1)
        return numbers.stack([z[0], z[1] + 1e-6 * len(calls)])

    report = audit(remembers, dimension=2, samples=20)
    assert report.verdict == "undecided"
    assert any("hidden state" in doubt for doubt in report.doubts)


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
        ({"dimension": "4"}, "even dimension 2n, not '4'"),
        ({"dimension": 2, "samples": 0}, "at least one"),
        ({"dimension": 2, "samples": 1e3}, "whole number of samples"),
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


def test_what_depends_on_hidden_state_is_not_refuted() -> None:
    calls: list[int] = []

    def drifting(z: Any) -> Any:
        calls.append(1)
        return z * (1 + 1e-3 * len(calls))

    report = audit(drifting, dimension=2, samples=10)
    assert (report.verdict, report.witness) == ("undecided", None)
    assert "hidden state" in report.doubts[0]
    with pytest.raises(AuditFailed):
        report.require()


def test_a_map_that_works_in_place_is_given_copies() -> None:
    buffer = np.empty(2)

    def point(z: Array) -> Array:
        z[1] -= H * np.sin(z[0])
        z[0] += H * z[1]
        return z

    def pair(q: Array, p: Array) -> tuple[Array, Array]:
        p -= H * np.sin(q)
        q += H * p
        return q, p

    def rows(z: Array) -> Array:
        z[..., 1] -= H * np.sin(z[..., 0])
        z[..., 0] += H * z[..., 1]
        return z

    def reused(z: Array) -> Array:
        buffer[:] = symplectic_euler(z)
        return buffer

    for step in (point, pair, rows, reused):
        report = audit(step, dimension=2, samples=50)
        assert report.verdict == "supported", (step.__name__, str(report))
        assert report.brackets["{Q,P}"].largest < 1e-13
    reports = [audit(lambda z, step=step: step(z) * (1 + 1e-9), dimension=2, samples=50) for step in (point, reused)]
    assert all(report.failures for report in reports)


def test_hidden_state_in_a_buffer_is_noticed() -> None:
    buffer, calls = np.empty(2), [0]

    def drifting(z: Array) -> Array:
        calls[0] += 1
        buffer[:] = symplectic_euler(z) + 1e-6 * calls[0]
        return buffer

    assert any("hidden state" in doubt for doubt in audit(drifting, dimension=2, samples=20).doubts)


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
