"""What accuracy costs, measured in small: each study against what theory says of it. No seconds are tested."""

import itertools
import math

import pytest
import sympy as sp
from flint import arb

from canon.claims.reader import read_text
from canon.cli.simulate import read_scene_or_system
from canon.cost.action import cost_of_action
from canon.cost.claim import cost_of_claim
from canon.cost.loop import cost_of_loop
from canon.cost.normal_form import cost_of_normal_form, hamiltonian_of_scene, henon_heiles
from canon.cost.reference import FINEST, distance, reference_of
from canon.cost.scene import USUAL, cost_of_scene
from canon.cost.study import measured_order
from canon.cost.taylor import NoSeries, flow, reference
from canon.errors import BudgetExceeded, InputError
from canon.numeric.actions.balls import precision
from canon.scenes.methods import NYSTROM, SPLITTING
from canon.scenes.reader import read_scene_text

x, p, t = sp.symbols("x p t", real=True)
OWN = """
[system]
q_names = ["q"]
p_names = ["p"]
H = "p**2/2 + q**4/4"
q = [1.0]
p = [0.0]
"""
OSCILLATOR = """
[phase_space]
q = ["q"]
p = ["p"]
Q = ["phi"]
P = ["I"]
[symbols]
m = "positive"
omega = "positive"
[transformation]
Q = ["atan2(m*omega*q, p)"]
P = ["{factor}(p**2 + m**2*omega**2*q**2)/(2*m*omega)"]
[[claim]]
kind = "canonical"
"""


def test_taylor_series_reach_the_oscillators_cosine():
    found = flow([p, -x], [x, p], t, [1.0, 0.0], (0.0, 10.0), digits=30)
    with precision(150):
        exact = arb(10).cos()
        assert abs(float(found[0] - exact)) < 1e-25


def test_taylor_series_know_the_time_and_all_elementary_functions():
    # x = exp(sin t) solves x' = x cos t; y = tanh t solves y' = 1 - y²; z = sqrt(1 + t) solves z' = 1/(2z)
    y, z = sp.symbols("y z", real=True)
    rates = [x * sp.cos(t), sp.sinh(t) / sp.cosh(t) - y + 1 - sp.tanh(t) ** 2 + y - sp.tanh(t), 1 / (2 * z)]
    found = flow(rates, [x, y, z], t, [1.0, 0.0, 1.0], (0.0, 1.5), digits=24)
    for value, exact in zip(found, (math.exp(math.sin(1.5)), math.tanh(1.5), math.sqrt(2.5)), strict=True):
        assert float(value) == pytest.approx(exact, rel=4e-16)


def test_taylor_series_say_where_they_end():
    with pytest.raises(BudgetExceeded):
        reference([x**2], [x], t, [1.0], (0.0, 1.5), seconds=20)  # x = 1/(1 - t)
    with pytest.raises(NoSeries):
        flow([sp.Abs(x)], [x], t, [1.0], (0.0, 1.0), digits=20)


@pytest.fixture(scope="module")
def pendulum():
    scene = read_scene_or_system("pendulum")
    return cost_of_scene(scene, integrators=["verlet", "rk4"], cap=60.0, most_steps=8192)


def test_integrators_show_the_order_that_they_claim(pendulum):
    assert measured_order(pendulum, "verlet") == pytest.approx(2, abs=0.1)
    assert measured_order(pendulum, "rk4") == pytest.approx(4.5, abs=0.8)


def test_only_the_symplectic_one_is_symplectic(pendulum):
    coarse = {method: pendulum.of(method)[0].measures for method in pendulum.methods}
    assert coarse["verlet"]["symplecticity"] < 1e-14 < 1e-9 < coarse["rk4"]["symplecticity"]
    assert coarse["verlet"]["loop"] < 1e-6 < coarse["rk4"]["loop"]


def test_the_reference_is_none_of_what_is_measured(pendulum):
    assert "Taylor" in pendulum.reference
    closed = reference_of(read_scene_or_system("asymmetric_top"), seconds=5)
    assert "closed form" in closed.source


def test_an_integrator_that_does_not_fit_is_refused():
    with pytest.raises(InputError, match="rattle"):
        cost_of_scene(read_scene_text(OWN + "[run]\nduration = 1"), integrators=["rattle"], cap=0.01)


def test_spectral_nodes_beat_polygons():
    study = cost_of_loop(read_scene_text(OWN + "[run]\nduration = 3"), cap=30.0, counts=(32, 64, 128))
    spectral, polygon = ({point.work: point.error for point in study.of(method)} for method in ("spectral", "polygon"))
    assert spectral[128] < 1e-8 < 1e-5 < polygon[128]
    assert measured_order(study, "polygon") == pytest.approx(2, abs=0.1)


def test_actions_converge_by_the_rule_that_suits_the_turning_points():
    (study,) = cost_of_action(read_scene_text(OWN + "[run]\nduration = 3"))
    best = {point.work: point.error for point in study.of("Gauss-Chebyshev")}
    naive = {point.work: point.error for point in study.of("midpoints")}
    assert best[64] < 1e-25 < 1e-6 < naive[64]
    assert measured_order(study, "midpoints") == pytest.approx(1.5, abs=0.1)  # of a root at the ends


def test_a_momentum_costs_nothing():
    with pytest.raises(InputError):
        cost_of_action(read_scene_or_system("free_particle"))


def test_more_bits_hide_less_and_a_proof_nothing():
    (claim,) = read_text(OSCILLATOR.replace("{factor}", "")).claims
    points = {(point.method, point.work): point for point in cost_of_claim(claim).points}
    errors = [
        points[key].error
        for key in (("float32", 24), ("float64", 53), ("double-double", 106), ("balls", 300), ("balls", 1000))
    ]
    assert all(after < 1e-4 * before for before, after in itertools.pairwise(errors))
    assert errors[0] < 1e-3
    assert points["exact", None].error == 0
    assert points["exact", None].note.startswith("proved")


def test_a_defect_of_one_in_a_million_is_not_seen_in_single_precision():
    (claim,) = read_text(OSCILLATOR.replace("{factor}", "(1 + 1/10000000)*")).claims
    points = {(point.method, point.work): point.note for point in cost_of_claim(claim).points}
    assert points["float32", 24] == "rounding alone"
    assert points["float64", 53] == "beyond its rounding"
    assert points["balls", 100] == "a defect, for certain"
    assert points["exact", None].startswith("refuted")


def test_remainders_of_normal_forms_fall_with_the_order():
    study = cost_of_normal_form(*henon_heiles(), order=7, radius=0.05)
    errors = [point.error for point in study.points]
    assert all(later < earlier for earlier, later in itertools.pairwise(errors))
    assert errors[-1] < 1e-7


def test_a_wrong_normal_form_would_show():
    title, space, H = henon_heiles()
    first = cost_of_normal_form(title, space, H, order=5, radius=0.05).points[-1].error
    closer = cost_of_normal_form(title, space, H, order=5, radius=0.025).points[-1].error
    # the remainder is of degree 6, H of degree 2: a wrong coefficient would leave one of lower degree
    assert first / closer == pytest.approx(2**4, rel=0.2)


def test_normal_forms_of_scenes_refuse_friction():
    with pytest.raises(InputError):
        hamiltonian_of_scene(read_scene_or_system("forced_oscillator"))


def test_a_reference_is_never_what_is_compared():
    scene = read_scene_or_system("two_body")
    fine, other = (reference_of(scene, seconds=0.0, compared=names) for names in ((), (FINEST,)))
    assert FINEST in fine.source
    assert "DOP853" in other.source
    assert distance((other.q, other.p), (fine.q, fine.p), (scene.q, scene.p)) < 1e-9
    assert FINEST not in (*SPLITTING, *NYSTROM, *USUAL)
