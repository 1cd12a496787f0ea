"""Certificates of the catalogue, some of each room, kind and argument: confirmed as far as their answers say."""

import json
from pathlib import Path

import pytest

from canon.catalogue import files
from canon.checker.check import check
from canon.claims import document
from canon.claims.certificate_data import certificate, statement_tables
from canon.claims.reader import read_tables
from canon.claims.verify import verify

CLAIMS = {
    ("transformations", "oscillator-type-1"): (0, 1, 2, 3),
    ("transformations", "oscillator-type-2-implicit"): (0, 1),
    ("transformations", "spherical-coordinates"): (0,),
    ("transformations", "delaunay-space"): (0,),
    ("transformations", "complex-oscillator-variables"): (0,),
    ("flows", "duffing-time-energy"): (0,),
    ("transformations", "false-singular-hessian"): (0,),
    ("transformations", "lie-transform-truncated"): (0,),
    ("course", "what-canonical-must-mean"): (2,),
    ("course", "bracket-laws"): (0, 5, 7),
    ("course", "legendre-transform"): (0, 4),
    ("course", "kepler-so4"): (0,),
    ("course", "hamilton-jacobi-free-fall"): (0, 5),
    ("course", "integrals-oscillator"): (3,),
    ("course", "precession"): (0, 1),
    ("course", "symmetries-and-charges"): (0, 1),
    ("course", "small-oscillations"): (0,),
    ("errata", "pendulum-length"): (0, 1),
    ("brackets", "poincare-algebra"): (4,),
    ("brackets", "rigid-body-lie-poisson"): (0, 3),
    ("flows", "harmonic-oscillator"): (0, 3),
    ("errata", "valence"): (0, 1, 2),
    ("actions", "pendulum-generating-function"): (0, 3),
    ("actions", "morse-angle"): (3, 4),
    ("actions", "henon-heiles-normal-form"): (1, 3),
    ("actions", "anharmonic-oscillator-normal-form"): (0, 1),
    ("transformations", "kustaanheimo-stiefel"): (0,),
    ("transformations", "momenta-off-a-constraint"): (0,),
    ("transformations", "complex-oscillator-valence"): (0,),
    ("course", "conjugate-points"): (1, 3, 4),
    ("course", "oscillator-least-action"): (2,),
    ("course", "gaussian-pulse"): (1, 4),
    ("course", "kepler-quadratures"): (4, 5, 8),
    ("course", "lorentz-group"): (4,),
    ("course", "principal-axes"): (0,),
    ("course", "composition-near-the-identity"): (5,),
    ("brackets", "fradkin-tensor"): (4,),
    ("flows", "pendulum-rotation-time-energy"): (1,),
    ("transformations", "oscillator-type-2"): (0,),
    ("course", "hamilton-jacobi-free-polar"): (1,),
    ("course", "action-angle-oscillator"): (2, 3),
    ("actions", "free-symmetric-top-angles"): (0, 2),
    ("actions", "tangent-well-action"): (0, 1),
    ("actions", "double-well-action"): (0,),
    ("course", "limits"): (4, 5, 8, 16, 19, 20, 21, 22),
    ("course", "angle-without-a-shift"): (6, 8),
}
IN_PART = {
    ("transformations", "power-and-angle", 0): "almost all values",
    ("course", "brachistochrone-minimum", 0): "second variation",
}
PATHS = {(Path(str(file)).parent.name, Path(str(file)).stem): Path(str(file)) for file in files()}


def answer(room: str, name: str, index: int) -> str:
    tables = document.load(PATHS[room, name])
    claim = read_tables(tables).claims[index]
    data = certificate(claim, verify(claim, budget=60), statement_tables(tables, index))
    return str(check(json.loads(json.dumps(data))))


@pytest.mark.parametrize(("room", "name", "index"), [(*key, index) for key, found in CLAIMS.items() for index in found])
def test_confirmed(room: str, name: str, index: int) -> None:
    assert answer(room, name, index) == "confirmed"


@pytest.mark.parametrize(("room", "name", "index"), IN_PART)
def test_in_part(room: str, name: str, index: int) -> None:
    found = answer(room, name, index)
    assert found.startswith("confirmed in part: ")
    assert IN_PART[room, name, index] in found


def test_two_loops_that_meet_at_a_separatrix_are_not_measured_as_one() -> None:
    assert answer("actions", "double-well-separatrix", 0) == "confirmed"
