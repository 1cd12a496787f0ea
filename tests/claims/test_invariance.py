"""Integral invariants of maps: exact values, known changes, what isn't resolved, angles, and time."""

import json

import numpy as np
import pytest
import sympy as sp

from canon import (
    InputError,
    NotInvariant,
    PhaseSpace,
    Transformation,
    loop_invariant,
)
from tests.claims.known_loops import TURN, Array, damped, ellipse, henon, leapfrog


def test_a_symplectic_step_keeps_the_loop_integral() -> None:
    found = loop_invariant(leapfrog, ellipse)
    assert found.preserved is True
    assert found.before == pytest.approx(-1.4 * np.pi, abs=found.found.before.bound)
    assert abs(found.difference) <= found.bound < 1e-11
    assert found.require() is found


def test_a_known_change_is_found() -> None:
    found = loop_invariant(damped, ellipse)
    assert found.preserved is False
    assert found.verdict == "undecided"
    assert found.difference == pytest.approx(0.1 * 1.4 * np.pi, rel=1e-12)
    with pytest.raises(NotInvariant, match="changes by more than rounding"):
        found.require()
    with pytest.raises(TypeError, match="neither true nor false"):
        bool(found)


def test_a_change_of_a_billionth_is_found() -> None:
    found = loop_invariant(lambda q, p: (q, (1 + 1e-9) * p), ellipse)
    assert found.preserved is False
    assert found.difference == pytest.approx(-1.4e-9 * np.pi, rel=1e-3)


def test_valence() -> None:
    assert loop_invariant(henon, ellipse, scale=-0.3).preserved is True
    found = loop_invariant(henon, ellipse)
    assert found.preserved is False
    assert found.after == pytest.approx(0.3 * 1.4 * np.pi, rel=1e-13)
    with pytest.raises(InputError, match="scale"):
        loop_invariant(henon, ellipse, scale=0.0)


def test_what_is_not_resolved_is_said() -> None:
    found = loop_invariant(lambda q, p: (q, np.abs(p - 1)), ellipse, most_nodes=1024)
    assert found.preserved is None
    assert found.verdict == "undecided"
    assert "1024 nodes: not resolved" in str(found)
    assert "nothing is known" in str(found)


def test_single_precision_is_measured_against_its_own_rounding() -> None:
    def rounded(q: Array, p: Array) -> tuple[Array, Array]:
        new_q, new_p = leapfrog(np.asarray(q, np.float32), np.asarray(p, np.float32), np.float32(0.1))
        return np.asarray(new_q, np.float32), np.asarray(new_p, np.float32)

    found = loop_invariant(rounded, ellipse)
    assert found.preserved is True
    assert 1e-8 < found.bound < 1e-3
    coarse = loop_invariant(lambda q, p: damped(*rounded(q, p)), ellipse)
    assert coarse.preserved is False


def test_points_of_a_loop_without_the_loop() -> None:
    nodes = ellipse(np.arange(256) / 256)
    assert loop_invariant(leapfrog, nodes).preserved is True
    few = loop_invariant(leapfrog, nodes[::16])
    assert few.preserved is None
    odd = loop_invariant(leapfrog, ellipse(np.arange(301) / 301))
    assert odd.preserved is True
    with pytest.raises(InputError, match="8 points at least"):
        loop_invariant(leapfrog, nodes[::64])


def test_a_loop_that_winds_round_an_angle() -> None:
    """Round the origin the action is ∮ p dq / 2π, and the angle gains a whole turn."""
    space = PhaseSpace("q", "p", new=("phi", "I"), positive="m omega")
    q, p, m, omega = space.symbols("q p m omega")
    action = (p**2 / (2 * m) + m * omega**2 * q**2 / 2) / omega
    polar = Transformation(space, Q=(sp.atan2(m * omega * q, p),), P=(action,))

    def circle(s: Array) -> Array:
        return np.stack([np.sin(TURN * s), np.cos(TURN * s)], axis=1)

    values = {"m": 2.0, "omega": 3.0}
    found = loop_invariant(polar, circle, parameters=values, new_periods=(TURN, None))
    assert found.preserved is True
    assert found.after == pytest.approx(np.pi, abs=1e-12)
    assert loop_invariant(polar, circle, parameters=values, most_nodes=512).preserved is None


def test_the_standard_map_on_the_cylinder() -> None:
    """An exact map keeps ∮ p dq round the cylinder, a shift of p changes it by 2π times the shift."""

    def round_it(s: Array) -> Array:
        return np.stack([TURN * s, 0.2 + 0.1 * np.cos(TURN * s)], axis=1)

    def kick(q: Array, p: Array, shift: float = 0.0) -> tuple[Array, Array]:
        p = p + 0.9 * np.sin(q) + shift
        return np.mod(q + p, TURN), p

    angle = (TURN, None)
    assert loop_invariant(kick, round_it, periods=angle, new_periods=angle).preserved is True
    shifted = loop_invariant(lambda q, p: kick(q, p, 0.5), round_it, periods=angle, new_periods=angle)
    assert shifted.preserved is False
    assert shifted.difference == pytest.approx(np.pi, rel=1e-12)


def test_a_backward_map_is_taken_as_it_is_written() -> None:
    space = PhaseSpace("q", "p", new=("Q", "P"))
    Q, P = space.symbols("Q P")
    back = Transformation(space, q=(Q / 2,), p=(P / 3,))
    assert loop_invariant(back, ellipse, scale=6.0).preserved is True


@pytest.mark.parametrize(
    ("loop", "message"),
    [
        (lambda s: np.stack([s, s**2], axis=1), "not closed"),
        (lambda s: np.stack([s, s, s], axis=1), "N, 2n"),
        (lambda s: s, "points"),
        (None, "a loop takes parameters"),
        (lambda s: np.stack([np.cos(TURN * s), np.log(s - 2)], axis=1), "finite"),
    ],
)
@pytest.mark.filterwarnings("ignore:invalid value:RuntimeWarning")
def test_what_is_no_loop(loop, message: str) -> None:
    with pytest.raises(InputError, match=message):
        loop_invariant(leapfrog, loop)


def test_what_goes_wrong_after_the_map_is_said_to_be_there() -> None:
    with pytest.raises(InputError, match="after the map, the loop has a point that is not finite"):
        loop_invariant(lambda q, p: (q, np.where(q > 2, np.nan, p)), ellipse)


def test_records() -> None:
    record = json.loads(json.dumps(loop_invariant(damped, ellipse).as_record()))
    assert record["integral"] == "∮ p dq"
    assert record["preserved"] is False
    assert record["before"]["resolved"] is True
    rough = loop_invariant(lambda q, p: (q, np.abs(p - 1)), ellipse, most_nodes=32)
    assert json.loads(json.dumps(rough.as_record()))["after"]["change"] == "nan"
