"""An effect that a scene does not name adds no operation to its compiled program, and no number to its state."""

from itertools import combinations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from jax import lax

from canon.numeric.integrators.stepper import Time
from canon.numeric.integrators.yoshida import VERLET
from canon.numeric.operations import count_operations, operations_per_step
from canon.scenes.problem import problem_of
from canon.scenes.reader import read_scene_text

BODIES = """
constants = {c = 10.0}
[[body]]
name = "a"
mass = 1.0
charge = 1.0
position = [1.0, 0.0, 0.1]
velocity = [0.0, 1.0, 0.2]
[[body]]
name = "b"
mass = 2.0
charge = -1.0
position = [-1.0, 0.3, 0.0]
velocity = [0.1, -0.5, 0.0]
[run]
duration = 1.0
"""
EFFECTS = {
    "uniform_gravity": "g = 9.81",
    "mutual_gravity": "G = 1.0",
    "inverse_distance": "a = 1.0",
    "inverse_square": "c = 0.1",
    "power_law": "a = 0.2\nn = 3",
    "potential": 'V = "x*y*z"',
    "spring": "k = 0.5\nlength = 0.1",
    "coupling_spring": 'k = 0.5\nlength = 0.1\nbodies = ["a", "b"]',
    "damping": "rate = 0.1",
    "driving": 'force = "cos(t)"',
    "electric_field": 'potential = "x**2*y"',
    "magnetic_field": "B = 1.0",
    "rotating_frame": "Omega = 0.3",
    "accelerated_frame": 'displacement = "cos(t)"',
}


def operations(*kinds: str) -> int:
    """Arithmetic operations of a step of Störmer and Verlet's method, for the scene with these effects alone."""
    text = BODIES + "".join(f'[[effect]]\nkind = "{kind}"\n{EFFECTS[kind]}\n' for kind in kinds)
    scene = read_scene_text(text)
    return operations_per_step(problem_of(scene.model).value, VERLET, (np.array(scene.q), np.array(scene.p)))


NONE = operations()
ALONE = {kind: operations(kind) for kind in EFFECTS}


def test_without_effects_there_is_the_free_motion_alone() -> None:
    """q += h p/m for six coordinates: a product with 1/m where it is not 1, a product with h, a sum."""
    assert NONE <= 6 * 4


@pytest.mark.parametrize("kind", EFFECTS)
def test_an_effect_costs_what_it_adds(kind: str) -> None:
    assert ALONE[kind] > NONE
    assert read_scene_text(BODIES).model.effects == ("kinetic",)


@pytest.mark.parametrize("pair", list(combinations(["mutual_gravity", "spring", "damping", "potential", "driving"], 2)))
def test_two_effects_cost_no_more_than_both(pair: tuple[str, str]) -> None:
    together = operations(*pair)
    assert max(ALONE[kind] for kind in pair) < together <= sum(ALONE[kind] for kind in pair) - NONE + 40


def test_time_is_computed_only_where_an_effect_asks_for_it() -> None:

    def primitives(kind: str) -> str:
        scene = read_scene_text(BODIES + f'[[effect]]\nkind = "{kind}"\n{EFFECTS[kind]}\n')
        problem = problem_of(scene.model).value
        stepper = VERLET.stepper(problem)

        def step(state: object, h: float, k: float) -> object:
            tables = stepper.prepare(h)
            return stepper.read(stepper.step(stepper.initial(state), tables, Time(0.0, h, k)))

        state = (jnp.array(scene.q), jnp.array(scene.p))
        return str(jax.make_jaxpr(step)(state, 0.1, 2.0))

    assert " cos " in primitives("driving")
    for absent in (" cos ", " sqrt ", " exp ", " expm1 "):
        assert absent not in primitives("uniform_gravity")
    assert " sqrt " in primitives("mutual_gravity")
    assert " expm1 " in primitives("damping")


def test_the_state_holds_what_moves_and_nothing_else() -> None:
    scene = read_scene_text(BODIES)
    assert (len(scene.q), len(scene.p)) == (6, 6)
    plane = BODIES.replace("[1.0, 0.0, 0.1]", "[1.0]").replace("[0.0, 1.0, 0.2]", "[0]")
    line = read_scene_text(plane.replace("[-1.0, 0.3, 0.0]", "[0]").replace("[0.1, -0.5, 0.0]", "[1]"))
    assert (len(line.q), len(line.p)) == (2, 2)


def test_loops_count_as_often_as_they_turn() -> None:
    traced = jax.make_jaxpr(lambda x: lax.fori_loop(0, 7, lambda i, y: y * 2.0 + 1.0, x))(1.0)
    assert 14 <= count_operations(traced.jaxpr) <= 21
