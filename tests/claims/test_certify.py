"""Rigorous bounds over boxes: known defects are enclosed, symplectic maps bounded tightly, and kinks are said."""

import json
import math
from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest
import sympy as sp

from canon import InputError, PhaseSpace, Transformation, certify

SPACE = PhaseSpace("q", "p", new=("Q", "P"), real="h")
q, p, h = SPACE.symbols("q p h")


def euler(z: Any) -> Any:
    moved = z[1] - 0.5 * jnp.sin(z[0])
    return jnp.stack([z[0] + 0.5 * moved, moved])


def mistaken(z: Any) -> Any:
    """det M = 1 + cos(q)/4."""
    return jnp.stack([z[0] + 0.5 * z[1], z[1] - 0.5 * jnp.sin(z[0])])


def test_a_symplectic_map_is_bounded_tightly_and_cheaply() -> None:
    bound = certify(euler, (-1, 1), dimension=2, tolerance=1e-8, budget=math.inf)
    assert bound.upper <= 1e-8
    assert bound.lower == 0
    assert bound.at is None
    assert bound.boxes < 20
    assert bound.enclosed == 1


def test_a_list_of_pairs_tells_the_dimension() -> None:
    assert certify(euler, [(-0.1, 0.1), (-0.1, 0.1)], tolerance=1e-6).upper <= 1e-6
    with pytest.raises(InputError, match="dimension of phase space is needed"):
        certify(euler, (-0.1, 0.1))


def test_smaller_boxes_have_much_smaller_bounds() -> None:
    sizes = [certify(euler, (-r, r), dimension=2, boxes=1).upper for r in (1.0, 0.5, 0.25)]
    assert sizes[0] > 500 * sizes[1] > 500**2 * sizes[2] > 0


def test_a_defect_is_enclosed_from_both_sides() -> None:
    bound = certify(mistaken, [(-1, 2), (-1, 1)], dimension=2, budget=math.inf)
    assert 0.2 < bound.lower <= 0.25 <= bound.upper < 0.265
    assert bound.entry == "{Q1,P1}"
    assert bound.at is not None
    assert math.cos(bound.at[0]) / 4 == pytest.approx(bound.lower, rel=1e-12)
    assert "at least" in str(bound)


def test_the_bound_holds_at_random_points() -> None:
    bound = certify(mistaken, (1, 3), dimension=2, boxes=3)
    angles = np.random.default_rng(0).uniform(1, 3, 1000)
    assert np.abs(np.cos(angles) / 4).max() <= bound.upper


def test_formulas_keep_their_exact_numbers() -> None:
    """(q/3, 3p) is canonical; in floats 1/3 isn't a third, and the bound says that."""
    third = Transformation(SPACE, Q=q / 3, P=3 * p)
    assert certify(third, (-1, 1)).upper < 1e-30
    floats = certify(lambda z: jnp.stack([z[0] * (1 / 3), 3 * z[1]]), (-1, 1), dimension=2, tolerance=0)
    assert 1e-17 < floats.lower <= floats.upper < 1e-16
    near = Transformation(SPACE, Q=q / 3 * (1 + sp.Rational(1, 10**20)), P=3 * p)
    assert 0.99e-20 < certify(near, (-1, 1), tolerance=0).lower < 1.01e-20


def test_formulas_with_parameters_roots_and_a_valence() -> None:
    map = Transformation(SPACE, Q=sp.sqrt(q) * sp.exp(h), P=4 * sp.exp(-h) * p * sp.sqrt(q))
    bound = certify(map, {"q": (1, 1.5), "p": (-1, 1)}, parameters={"h": 0.3}, scale=2, budget=math.inf)
    assert bound.upper <= 1e-9
    assert bound.scale == 2
    polar = Transformation(SPACE, Q=sp.atan2(q, p), P=(q**2 + p**2) / 2)
    assert certify(polar, (0.75, 1), budget=math.inf).upper <= 1e-9


def test_a_part_that_is_not_smooth_is_said() -> None:
    bound = certify(lambda z: jnp.stack([z[0], z[1] - 0.1 * jnp.abs(z[0])]), (-1, 2), dimension=2, boxes=60)
    assert bound.upper == math.inf
    assert bound.upper_enclosed < 1e-9
    assert 0.5 < bound.enclosed < 1
    assert "absolute value" in bound.reason
    assert "not enclosed elsewhere" in str(bound)
    assert json.loads(json.dumps(bound.as_record()))["upper"] == "inf"


def test_jumps_away_from_the_box_do_not_matter() -> None:
    def wrapped(z: Any) -> Any:
        moved = z[1] + 0.9 * jnp.sin(z[0])
        return jnp.stack([jnp.mod(z[0] + moved, 2 * jnp.pi), moved])

    bound = certify(wrapped, [(1, 2), (0, 1)], dimension=2, budget=math.inf)
    assert bound.upper <= 1e-9


@pytest.mark.parametrize(
    ("map", "box", "options", "message"),
    [
        (lambda z: np.sin(z), (-1, 1), {"dimension": 2}, "jax cannot trace"),
        (lambda z: jnp.stack([z[0]]), (-1, 1), {"dimension": 2}, "jax cannot trace"),
        (euler, None, {"dimension": 2}, "a box is a pair"),
        (euler, (-1, 1), {}, "dimension of phase space"),
        (euler, (-1, 1), {"dimension": 2, "degree": 0}, "degree"),
        (euler, (-1, 1), {"dimension": 2, "parameters": {"h": 1}}, "for formulas"),
        (euler, {"q": (0, 1)}, {"dimension": 2}, "no pair"),
        (Transformation(SPACE, Q=q, P=p + sp.gamma(q + 3)), (0, 1), {}, "no numerical form"),
        (lambda z: jnp.log(z), (-2, -1), {"dimension": 2}, "not certified to be smooth on any part"),
    ],
)
def test_what_cannot_be_bounded_is_an_input_error(map: Any, box: Any, options: Any, message: str) -> None:
    with pytest.raises(InputError, match=message):
        certify(map, box, **options)


def test_action_and_angle_are_bounded_near_their_singularity() -> None:
    """A box whose nearest corner is a seventh of its side away from the origin, where the angle has no value."""
    polar = Transformation(SPACE, Q=[sp.atan2(q, p)], P=[(q**2 + p**2) / 2])
    found = certify(polar, [(0.15, 1), (0.15, 1)], boxes=150, budget=60.0)
    assert found.enclosed == 1
    assert found.upper < 1e-2
