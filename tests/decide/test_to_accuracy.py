"""Evidence to an accuracy is of the worst residual, in as many bits as that takes."""

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide.region import Region
from canon.decide.tape import Tape
from canon.decide.to_accuracy import bits_for, sample_to

x = sp.Symbol("x", real=True)
NOTHING = sp.sin(3 * x) - 3 * sp.sin(x) + 4 * sp.sin(x) ** 3
LARGE, SMALL = 10**9 * NOTHING, NOTHING / 10**9


@pytest.mark.parametrize("accuracy", [1e-10, 1e-40, 1e-100])
def test_the_worst_residual_is_below_the_accuracy(accuracy: float):
    tape = Tape()
    nodes = [tape.load(LARGE), tape.load(SMALL)]
    region = Region((), (), tuple(tape.support(nodes[0])))
    found, refuted = sample_to(tape, nodes, region, points=200, accuracy=accuracy, budget=Budget(30))
    alone, _ = sample_to(tape, nodes[:1], region, points=200, accuracy=accuracy, budget=Budget(30))
    assert refuted is None
    assert found is not None
    assert alone is not None
    assert alone.bound / 4 < found.bound <= accuracy
    assert found.max_residual == alone.max_residual > 0
    assert found.max_residual <= found.bound
    assert found.bits >= bits_for(accuracy) > -float(sp.log(accuracy, 2))


def test_what_hides_below_double_precision_is_refuted():
    tape = Tape()
    nodes = [tape.load(SMALL), tape.load(LARGE + sp.Rational(1, 10**40))]
    region = Region((), (), tuple(tape.support(nodes[0])))
    _, refuted = sample_to(tape, nodes, region, points=100, accuracy=1e-60, budget=Budget(30))
    assert refuted is not None
    assert (refuted.status, refuted.index) == ("refuted", 1)
    assert refuted.witness is not None
    assert float(refuted.witness.value) == pytest.approx(1e-40)
