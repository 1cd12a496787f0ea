"""Scenes of many bodies: what acts between all pairs is one small program, and is what its terms written out are."""

from dataclasses import replace

import numpy as np
import pytest

from canon.numeric.integrators.yoshida import VERLET
from canon.numeric.operations import operations_per_step
from canon.numeric.pair_sum import PairSum
from canon.scenes.model import Model, Term
from canon.scenes.problem import problem_of
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import simulate

GRAVITY = 'kind = "mutual_gravity"\nG = 2.0\nsoftening = 0.3\n'
TIMED = 'kind = "potential"\npair = "cos(t)/r + r**2"\n'


def scene(bodies: int, *effects: str, run: str = "duration = 0.5\naccuracy = 1e-8\nsamples = 3\n"):
    random = np.random.default_rng(bodies)
    text = f"[run]\n{run}"
    for k in range(bodies):
        x, v = random.uniform(-1, 1, (2, 3)).round(3)
        text += f"[[body]]\nmass = {k % 3 + 1}\nposition = {x.tolist()}\nvelocity = {v.tolist()}\n"
    return read_scene_text(text + "".join(f"[[effect]]\n{effect}" for effect in effects))


def written_out(model: Model) -> Model:
    terms = (x.expr.written_out() if isinstance(x.expr, PairSum) else x.expr for x in model.terms)
    return replace(model, terms=tuple(Term(x.effect, expr) for x, expr in zip(model.terms, terms, strict=True)))


@pytest.mark.slow
@pytest.mark.parametrize(
    "effects", [(GRAVITY,), (TIMED, 'kind = "uniform_gravity"\ng = 2.0\n')], ids=["gravity", "timed"]
)
def test_the_orbit_is_that_of_all_terms_written_out(effects: tuple[str, ...]) -> None:
    given = scene(5, *effects)
    assert any(isinstance(term.expr, PairSum) for term in given.model.terms)
    found, plain = simulate(given), simulate(replace(given, model=written_out(given.model)))
    assert found.problem.kind == plain.problem.kind == "T(p) + V(q)"
    assert found.choice.method.name == plain.choice.method.name
    assert found.q == pytest.approx(plain.q, rel=1e-11)
    assert found.p == pytest.approx(plain.p, rel=1e-11)


def test_monitors_know_what_a_law_breaks() -> None:
    monitor = 'duration = 0.3\nmonitor = ["energy", "momentum", "angular_momentum", "symplecticity"]\nsamples = 3\n'
    readings = {each.name: each for each in simulate(scene(4, TIMED, run=monitor)).monitors}
    assert readings["energy"].expected == "broken by potential"
    assert readings["energy"].max_drift is not None
    assert readings["energy"].max_drift > 1e-3
    assert readings["momentum"].expected == readings["angular_momentum"].expected == "conserved"
    assert not any(each.alarm for each in readings.values())


def test_operations_grow_with_the_pairs_and_no_more_than_the_effect_calls_for() -> None:
    def operations(bodies: int, *effects: str) -> int:
        made = scene(bodies, *effects)
        return operations_per_step(problem_of(made.model).value, VERLET, (np.array(made.q), np.array(made.p)))

    few, many = operations(40, GRAVITY), operations(80, GRAVITY)
    assert 3.5 < many / few < 4.5
    assert many < 30 * 80**2
    assert operations(40) <= 3 * 120 * 2


def test_a_long_sum_is_shown_in_one_line() -> None:
    assert "over the 10 pairs of 5 bodies" in str(scene(5, GRAVITY).model.H)
    assert "pairs" not in str(scene(2, GRAVITY).model.H)
