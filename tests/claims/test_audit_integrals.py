"""Integral invariants in an audit, and audits of maps that a generating function defines."""

import json

import numpy as np
import sympy as sp

from canon import GeneratingFunction, PhaseSpace, audit

Array = np.ndarray
TURN = 2 * np.pi


def circle(s: Array) -> Array:
    return np.stack([0.3 + np.cos(TURN * s), np.sin(TURN * s)], axis=1)


def disc(u: Array) -> Array:
    angle = TURN * u[:, 1]
    return np.stack([u[:, 0] * np.cos(angle), u[:, 0] * np.sin(angle)], axis=1)


def step(q: Array, p: Array, h: float = 0.1) -> tuple[Array, Array]:
    p = p - h * np.sin(q)
    return q + h * p, p


def test_an_audit_compares_loops_and_surfaces_when_asked() -> None:
    report = audit(step, dimension=2, samples=50, loops=[circle], surfaces=[(disc, (False, True))])
    assert report.verdict == "supported"
    assert [item.preserved for item in report.integrals] == [True, True]
    assert "∮ p dq" in str(report)
    assert len(json.loads(json.dumps(report.as_record()))["integrals"]) == 2
    assert audit(step, dimension=2, samples=50).integrals == ()


def test_a_loop_sees_what_the_samples_miss() -> None:
    """Wrong beyond q = 1.2 only, where no sample lies."""

    def spoiled(q: Array, p: Array) -> tuple[Array, Array]:
        new_q, new_p = step(q, p)
        return new_q, new_p + 1e-4 * np.exp(-((q - 1.25) ** 2) / 0.002) * p

    report = audit(spoiled, dimension=2, domain=(-0.8, 0.8), samples=200, loops=[circle])
    assert report.verdict == "undecided"
    assert "∮ p dq changes by" in report.failures[0]
    assert not report.worst.exceeds


def test_a_loop_that_is_not_resolved_is_a_note() -> None:
    report = audit(step, dimension=2, samples=50, loops=[circle(np.arange(8) / 8)])
    assert report.verdict == "supported"
    assert "∮ p dq is not resolved" in report.notes


def test_the_map_of_a_generating_function_is_audited_as_it_is_solved() -> None:
    space = PhaseSpace("q", "p", new=("Q", "P"), positive="h")
    q, P, h = space.symbols("q P h")
    F = GeneratingFunction(space, type=2, F=q * P + h * (P**2 / 2 - sp.cos(q)) + h**2 * P**2 * sp.cos(q) / 6)
    report = audit(F.transformation(), parameters={"h": 0.1}, samples=100, loops=[circle])
    assert report.verdict == "supported"
    assert report.map == "generating function"
    assert report.variables == ("q", "p")
    assert report.integrals[0].preserved is True
