"""Splittings that are found: which rule applies, that they agree with each other, and that they reach their order."""

import numpy as np
import pytest
import sympy as sp

from canon.errors import InputError
from canon.numeric.integrate import integrate
from canon.numeric.integrators.blanes_moan import BLANES_MOAN_4, BLANES_MOAN_6
from canon.numeric.integrators.nystrom_8 import NYSTROM_8
from canon.numeric.integrators.parts import quadratic_part, rayleigh_part
from canon.numeric.shears import shear
from canon.numeric.split_hamiltonian import split_hamiltonian

x, y, px, py, t = sp.symbols("x y p_x p_y t", real=True)
m, B, a = sp.symbols("m B a", positive=True)
T = (px**2 + py**2) / (2 * m)
STATE = (np.array([0.9, 0.2]), np.array([-0.3, 0.9]))

CASES = {
    "henon-heiles": (T + (x**2 + y**2) / 2 + x**2 * y - y**3 / 3, ["T(p) + V(q)", "quadratic and rest"]),
    "kepler": (
        T - a / sp.sqrt(x**2 + y**2) + x**2 / 50 + sp.cos(t) * y / 10,
        ["T(p) + V(q)", "Kepler and perturbation", "quadratic and rest"],
    ),
    "magnetic": (((px + B * y / 2) ** 2 + (py - B * x / 2) ** 2) / (2 * m) + x**4, ["quadratic and rest", "4 shears"]),
    "rotating": (T - B * (x * py - y * px) + x**4 * sp.cos(t), ["quadratic and rest", "3 shears"]),
    "anisotropic": (T - B * (x * py - y * px) + x**2 / 2 + y**2, ["quadratic and rest", "4 shears"]),
    "polar": (px**2 / (2 * m) + py**2 / (2 * m * x**2) - a / x, ["2 shears"]),
}
VALUES = {m: 1.3, B: 0.7, a: 1.1}


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_rules_and_their_agreement(name: str) -> None:
    H, kinds = CASES[name]
    found = split_hamiltonian(H, (x, y), (px, py), t)
    assert [split.kind for split in found] == kinds
    assert all(sp.simplify(sum(split.terms) - H) == 0 for split in found)
    ends = [
        np.concatenate(integrate(split.splitting(VALUES), BLANES_MOAN_6, STATE, duration=2.0, steps=250).state)
        for split in found
    ]
    assert all(np.abs(end - ends[0]).max() < 1e-10 for end in ends)


def test_the_order_is_kept_by_three_parts_with_time() -> None:
    found = split_hamiltonian(CASES["rotating"][0], (x, y), (px, py), t)[-1].splitting(VALUES)
    ends = [integrate(found, BLANES_MOAN_4, STATE, duration=2.0, steps=n).state[0] for n in (20, 40, 320)]
    ratio = np.abs(ends[0] - ends[2]).max() / np.abs(ends[1] - ends[2]).max()
    assert np.log2(ratio) == pytest.approx(4, abs=0.3)


def test_nystrom_is_recognised() -> None:
    relativistic = sp.sqrt(1 + px**2) + x**2
    assert split_hamiltonian(CASES["henon-heiles"][0], (x, y), (px, py))[0].nystrom
    assert not split_hamiltonian(relativistic, (x,), (px,))[0].nystrom
    assert not split_hamiltonian(sp.exp(-t) * px**2 + x**2, (x,), (px,), t)[0].nystrom


@pytest.mark.parametrize(
    ("name", "rule", "steps"),
    [pytest.param("kepler", 1, (6, 16), marks=pytest.mark.slow), ("rotating", 0, (8, 12))],
)
def test_nystrom_methods_keep_their_order_beside_any_part_that_is_quadratic_in_the_momenta(
    name: str, rule: int, steps: tuple[int, int]
) -> None:
    split = split_hamiltonian(CASES[name][0], (x, y), (px, py), t)[rule]
    assert split.nystrom
    problem = split.splitting(VALUES)
    ends = [integrate(problem, NYSTROM_8, STATE, duration=2.0, steps=n).state[0] for n in (*steps, 100)]
    errors = [np.abs(end - ends[2]).max() for end in ends[:2]]
    assert errors[1] > 1e-13
    assert np.log(errors[0] / errors[1]) / np.log(steps[1] / steps[0]) == pytest.approx(8, abs=0.8)


def test_components_may_be_arrays_of_orbits() -> None:
    split = split_hamiltonian(CASES["magnetic"][0], (x, y), (px, py))[0].splitting(VALUES)
    one = integrate(split, BLANES_MOAN_4, STATE, duration=1.0, steps=20).state
    many = tuple(tuple(np.full(3, value) for value in slot) for slot in STATE)
    all_of_them = integrate(split, BLANES_MOAN_4, many, duration=1.0, steps=20, batched=True).state
    assert np.allclose(np.array(all_of_them)[:, :, 1], np.array(one), rtol=1e-13)


def test_what_does_not_split() -> None:
    assert split_hamiltonian(px**2 / (1 + x**2), (x,), (px,)) == ()
    with pytest.raises(InputError, match="no shear"):
        shear(px * x, (x,), (px,), None, {})
    with pytest.raises(InputError, match="commute"):
        quadratic_part([1.0, 2.0], None, [[0.0, 1.0], [-1.0, 0.0]])
    with pytest.raises(InputError, match="symmetric"):
        rayleigh_part([[1.0, 0.5], [0.0, 1.0]], [1.0, 1.0])
    with pytest.raises(InputError, match="no value is given for B"):
        split_hamiltonian(CASES["rotating"][0], (x, y), (px, py))[0].splitting({m: 1.0})
