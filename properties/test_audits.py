"""Audits by numbers: they agree with what is decided exactly, and no mutant is too small, no unit too strange."""

from typing import Any

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from canon import InputError, audit, verify
from canon.testing import (
    UNITS,
    MatrixMutant,
    canonical_maps,
    matrix_mutants,
    mutants,
    phase_points,
    phase_spaces,
    symplectic_matrices,
)

Array = np.ndarray
few = settings(max_examples=max(6, settings.default.max_examples // 4))
SIZES = (1e-3, 1e-6, 1e-9)
VALUES = {"a": 0.75}


def linear_map(M: Array, units: tuple[float, float] = (1.0, 1.0)) -> Any:
    """z → M z with z in these units of q and p."""
    scale = np.repeat(units, len(M) // 2)
    scaled = M * scale[:, None] / scale
    return lambda z: scaled @ z


@few
@given(st.data())
def test_what_is_proved_is_supported(data: st.DataObject) -> None:
    made = data.draw(canonical_maps(data.draw(phase_spaces(max_degrees=2)), max_factors=2))
    verdict = verify(made.canonical(), budget=20)
    try:
        report = audit(made, domain=(0.2, 1.2), samples=40, parameters=VALUES)
    except InputError:  # a map may overflow everywhere in a box
        return
    if verdict.status == "proved":
        assert not report.failures, (made, report)
        assert report.verdict == "supported" or report.doubts, (made, report)


@few
@given(st.data())
def test_what_is_refuted_is_never_supported(data: st.DataObject) -> None:
    """Mutants by 1/1000 to 1/10⁹ of one factor: proof and numbers say the same, and balls confirm the numbers."""
    mutant = data.draw(mutants(data.draw(phase_spaces(max_degrees=2)), max_factors=1, kinds=("near", "momenta")))
    assert verify(mutant.transformation.canonical(), budget=20).status == "refuted"
    report = audit(mutant.transformation, domain=(0.2, 1.2), samples=40, parameters=VALUES)
    assert report.verdict == "refuted", (mutant, report)
    assert report.failures
    assert report.witness


@few
@given(st.data())
def test_a_stated_defect_is_measured(data: st.DataObject) -> None:
    """What comes last is found in its own bracket, with its own size, to the digits that rounding leaves."""
    space = data.draw(phase_spaces(max_degrees=2))
    mutant = data.draw(mutants(space, max_factors=1, kinds=("near", "coordinates"), buried=False))
    report = audit(mutant.transformation, domain=(0.2, 1.2), samples=20, parameters=VALUES)
    worst = report.worst
    assert worst.label == mutant.bracket, (mutant, report)
    assert abs(worst.size - abs(float(mutant.defect))) <= worst.bound + 1e-15


@pytest.mark.parametrize("size", SIZES)
@few
@given(st.data())
def test_matrices_and_their_mutants_of_every_size(size: float, data: st.DataObject) -> None:
    n = data.draw(st.integers(1, 4))
    S = data.draw(symplectic_matrices(n, made="generators"))
    assert audit(linear_map(S), dimension=2 * n, samples=10).verdict == "supported"
    mutant: MatrixMutant = data.draw(matrix_mutants(n, sizes=(size,), condition=4.0))
    report = audit(linear_map(mutant.matrix), dimension=2 * n, samples=10)
    assert report.verdict in ("undecided", "refuted")
    assert report.worst.label == mutant.bracket, (mutant, report)
    assert abs(report.worst.size - abs(mutant.defect)) <= report.worst.bound + 1e-14


@pytest.mark.parametrize("name", [name for name in UNITS if name != "natural"])
@few
@given(st.data())
def test_strange_units_hide_nothing_and_alarm_nobody(name: str, data: st.DataObject) -> None:
    """The same maps in SI units of an electron and of a planet: right ones pass, mutants by 1e-9 don't."""
    units = UNITS[name]
    S = data.draw(symplectic_matrices(2, condition=9.0))
    mutant = data.draw(matrix_mutants(2, sizes=(1e-6, 1e-9), condition=4.0))
    box = [(-unit, unit) for unit in np.repeat(units, 2)]
    assert audit(linear_map(S, units), dimension=4, domain=box, samples=10).verdict == "supported"
    report = audit(linear_map(mutant.matrix, units), dimension=4, domain=box, samples=10)
    assert report.verdict in ("undecided", "refuted")
    assert report.failures
    # {P1,P2} and {Q1,Q2} carry units, {Q,P} doesn't
    scale = {"{Q,P}": 1.0, "{P,P}": units[1] / units[0], "{Q,Q}": units[0] / units[1]}[report.worst.name]
    assert abs(report.worst.size / scale - abs(mutant.defect)) <= report.worst.bound / scale + 1e-13


def chain(z: Array, h: float = 0.1, push: float = 0.0) -> Array:
    """A leapfrog step of a chain of n masses with springs that are not linear; `push`: a force that is no gradient."""
    n = len(z) // 2

    def force(q: Array) -> Array:
        stretched = np.diff(np.concatenate([0 * q[:1], q, 0 * q[:1]]))
        tension = stretched + stretched**3
        pushed = np.concatenate([q[:1] * 0, q[:-1]]) * push if n > 1 else -push * z[n:] * q
        return tension[1:] - tension[:-1] + pushed

    p = z[n:] + h / 2 * force(z[:n])
    q = z[:n] + h * p
    return np.concatenate([q, p + h / 2 * force(q)])


@pytest.mark.parametrize("n", [1, 2, 5, 20, 50])
def test_one_to_fifty_degrees_of_freedom(n: int) -> None:
    samples = 5 if n < 20 else 2
    assert audit(chain, dimension=2 * n, samples=samples).verdict == "supported"
    for size in SIZES:
        report = audit(lambda z, size=size: chain(z, push=size), dimension=2 * n, samples=samples)
        assert report.verdict in ("undecided", "refuted"), report
        assert any(size / 100 < defect.largest < 10 * size for defect in report.brackets.values()), report


@few
@given(phase_points(2))
def test_at_points_of_all_scales(z: Array) -> None:
    """A right map is never accused, wherever it is looked at."""
    report = audit(lambda z: chain(z, h=1e-3), dimension=4, domain=np.stack([z, z * (1 + 1e-3), z + 1e-3]))
    assert not report.failures, report


@few
@given(st.data())
def test_badly_conditioned_matrices_are_not_accused(data: st.DataObject) -> None:
    n = data.draw(st.integers(1, 3))
    M = data.draw(symplectic_matrices(n, condition=data.draw(st.sampled_from([1e2, 1e4, 1e6]))))
    report = audit(linear_map(M), dimension=2 * n, samples=5)
    # M's entries are rounded themselves: its defect is a few roundings of |M|²
    assert report.worst.size <= 1e-15 * float(np.abs(M).max() ** 2) + report.worst.bound


def test_the_sizes_are_those_of_the_mutants() -> None:
    from canon.testing.maps import SIZES as EXACT
    from canon.testing.matrices import SIZES as FLOAT

    assert FLOAT == SIZES
    assert tuple(map(sp.Rational, ("1/1000", "1/1000000", "1/1000000000"))) == EXACT
