"""What is known not to be canonical is refuted, with a witness at which it fails."""

import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from canon.claims.verify import verify
from canon.testing import mutants, phase_spaces


@given(st.data())
def test_mutants_are_refuted(data: st.DataObject):
    space = data.draw(phase_spaces())
    mutant = data.draw(mutants(space))
    verdict = verify(mutant.transformation.canonical(), budget=20)
    assert verdict.status == "refuted", (mutant, verdict)
    assert verdict.witness


@given(st.data())
def test_the_known_witness_is_one(data: st.DataObject):
    space = data.draw(phase_spaces(max_degrees=2))
    mutant = data.draw(mutants(space))
    residual = mutant.transformation.symplectic_residual()
    assert any(sp.N(entry.xreplace(dict(mutant.witness)), 30) != 0 for entry in residual)
