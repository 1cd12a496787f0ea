"""Maps that remember, draw lots or write into what they are given: it is noticed, and refutes nothing."""

from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest

from canon import AuditFailed, audit
from tests.claims.known_maps import Array, H, symplectic_euler


@pytest.mark.parametrize("numbers", [np, jnp])
def test_hidden_state_is_noticed(numbers: Any) -> None:
    calls: list[int] = []

    def remembers(z: Any) -> Any:
        calls.append(1)
        return numbers.stack([z[0], z[1] + 1e-6 * len(calls)])

    report = audit(remembers, dimension=2, samples=20)
    assert report.verdict == "undecided"
    assert any("hidden state" in doubt for doubt in report.doubts)


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
