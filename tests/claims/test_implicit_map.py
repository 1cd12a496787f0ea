"""Maps of generating functions, solved for: exact values, branches, caustics, evidence, and a flaw made on purpose."""

from collections.abc import Callable
from time import process_time

import mpmath as mp
import numpy as np
import pytest
import sympy as sp

from canon import GeneratingFunction, ImplicitMap, InputError, PhaseSpace, loop_invariant, verify
from canon.claims import implicit_images
from canon.numeric import implicit
from canon.numeric.precision import UNIT

Array = np.ndarray
RNG = np.random.default_rng(5)

OSCILLATOR = PhaseSpace("q", "p", new=("phi", "I"), positive="m omega")
q, p, phi, m, omega = OSCILLATOR.symbols("q p phi m omega")
TYPE_1 = GeneratingFunction(OSCILLATOR, type=1, F=m * omega * q**2 * sp.cot(phi) / 2)

PLANE = PhaseSpace("q", "p", new=("Q", "P"), symbols={"tau": "real"})
x, Q, tau = PLANE.symbols("q Q tau")
FLOW = GeneratingFunction(PLANE, type=1, F=((x**2 + Q**2) * sp.cos(tau) - 2 * x * Q) / (2 * sp.sin(tau)))

FOUR = PhaseSpace("q1 q2", "p1 p2", new=("Q1 Q2", "P1 P2"))
q1, q2, P1, P2 = FOUR.symbols("q1 q2 P1 P2")
KICKED = GeneratingFunction(
    FOUR, type=2, F=q1 * P1 + q2 * P2 + (P1**2 / 2 + P2**4 / 4 - sp.cos(q1 - q2) + q1 * P2**2 / 3) / 10
)


def symplectic_defect(M: Array) -> float:
    n = M.shape[1] // 2
    J = np.block([[np.zeros((n, n)), np.eye(n)], [-np.eye(n), np.zeros((n, n))]])
    return float(np.abs(M @ J @ np.swapaxes(M, 1, 2) - J).max())


def test_the_oscillator_in_angle_and_action() -> None:
    found = ImplicitMap(TYPE_1, {"m": 2.0, "omega": 3.0}).solve(RNG.uniform(-1, 1, (300, 2)))
    assert found.solved.all()
    assert found.notes == ()
    assert symplectic_defect(found.jacobians) < 1e-10


def test_the_images_satisfy_the_equations_within_the_errors_that_are_told() -> None:
    z = RNG.uniform(-1, 1, (200, 2))
    found = ImplicitMap(TYPE_1, {"m": 2.0, "omega": 3.0}).solve(z)
    action = (z[:, 1] ** 2 / 4 + 9 * z[:, 0] ** 2) / 3
    off = np.abs(found.images[:, 1] - action)
    assert np.all(off <= found.errors[:, 1] + 4e-16 * action)
    assert np.all(np.abs(np.tan(found.images[:, 0]) * z[:, 1] - 6 * z[:, 0]) < 1e-10)


def test_a_guess_chooses_the_branch() -> None:
    turned = ImplicitMap(TYPE_1, {"m": 1.0, "omega": 1.0})
    z = np.array([[0.5, 0.8]])
    near, far = (turned.solve(z, guess=np.array([start])).images[0] for start in (0.5, 0.5 + np.pi))
    assert far[0] - near[0] == pytest.approx(np.pi)
    assert far[1] == pytest.approx(near[1])
    assert turned.solve(z).images[0, 0] == pytest.approx(near[0])


def test_one_point_many_points_and_pairs() -> None:
    f = ImplicitMap(KICKED)
    z = RNG.uniform(-1, 1, (5, 4))
    many = f(z)
    assert np.array_equal(f(z[3]), many[3])
    new_q, new_p = f(z[:, :2], z[:, 2:])
    assert np.array_equal(np.concatenate([new_q, new_p], axis=1), many)


def test_derivatives_are_those_of_the_map() -> None:
    f = ImplicitMap(KICKED)
    z = RNG.uniform(-1, 1, (20, 4))
    M = f.solve(z).jacobians
    for k in range(4):
        step = np.zeros(4)
        step[k] = 1e-5
        assert np.allclose((f(z + step) - f(z - step)) / 2e-5, M[:, :, k], atol=1e-9)


def test_the_map_keeps_loops() -> None:
    def loop(s: Array) -> Array:
        a = 2 * np.pi * s
        return np.stack([np.cos(a), np.sin(a), 0.5 * np.sin(2 * a), 0.3 * np.cos(a)], axis=1)

    assert loop_invariant(KICKED.transformation(), loop).preserved is True


# -- near a caustic ------------------------------------------------------------------------------

h = PhaseSpace("q", "p", symbols={"h": "real"}).symbols("h")
KICKS = PhaseSpace("q", "p", new=("Q", "P"), symbols={"h": "real"})
KICK = GeneratingFunction(KICKS, type=1, F=-((Q - x) ** 2) / (2 * h) + h * sp.cos(x))
VERLET = GeneratingFunction(KICKS, type=1, F=-((Q - x) ** 2) / (2 * h) + h * (sp.cos(x) + sp.cos(Q)) / 2)
FOLD = GeneratingFunction(KICKS, type=2, F=h * x * KICKS.symbols("P") + KICKS.symbols("P") ** 3 / 3 - x**3 / 3)
SIZES = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12]
"""Mixed derivatives by which the arguments of F depend on one another: ∂Q/∂p for type 1, ∂²F/∂q∂P for `FOLD`."""


def flow_exactly(q: mp.mpf, p: mp.mpf, tau: mp.mpf) -> list[mp.mpf]:
    return [q * mp.cos(tau) - p * mp.sin(tau), q * mp.sin(tau) + p * mp.cos(tau)]


def kick_exactly(q: mp.mpf, p: mp.mpf, h: mp.mpf) -> list[mp.mpf]:
    return [q + h * (p + h * mp.sin(q)), p + h * mp.sin(q)]


def verlet_exactly(q: mp.mpf, p: mp.mpf, h: mp.mpf) -> list[mp.mpf]:
    half = p + h / 2 * mp.sin(q)
    return [q + h * half, half + h / 2 * mp.sin(q + h * half)]


def fold_exactly(q: mp.mpf, p: mp.mpf, h: mp.mpf) -> list[mp.mpf]:
    P = (p + q**2) / h
    return [h * q + P**2, P]


def exact_images(rule: Callable[..., list[mp.mpf]], z: Array, size: float) -> Array:
    """The images of the same doubles in 50 digits, rounded once."""
    with mp.workdps(50):
        return np.array([[float(value) for value in rule(*map(mp.mpf, (*point, size)))] for point in z])


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize(
    ("generating", "rule", "how"),
    [
        (FLOW, flow_exactly, "type 2 in place of 1, by its own formula"),
        (KICK, kick_exactly, "type 2 in place of 1, by its own formula"),
        (VERLET, verlet_exactly, "in place of 1, in "),
        (FOLD, fold_exactly, "F's own type, in "),
    ],
)
def test_near_a_caustic_another_type_keeps_all_digits(
    generating: GeneratingFunction, rule: Callable[..., list[mp.mpf]], how: str, size: float
) -> None:
    """For short times the type-1 function of a flow has a caustic: q and Q are nearly the same variable."""
    z = np.array([[0.7, 0.3], [0.2, -1.0], [-0.4, 0.9]])
    if generating is FOLD:  # where the derivatives of F cancel, too
        z[:, 1] = size / 2 - z[:, 0] ** 2
    name = "tau" if generating is FLOW else "h"
    found = ImplicitMap(generating, {name: size}).solve(z)
    exact = exact_images(rule, z, size)
    off = np.abs(found.images - exact) / np.abs(exact).max(axis=1, keepdims=True)
    assert off.max() < (5e-16 if size < 1e-7 else 1e-9)
    assert np.all(np.abs(found.images - exact) <= found.errors + UNIT * np.abs(exact))
    largest = np.abs(found.jacobians).max(axis=(1, 2)) ** 2
    assert np.all(np.abs(np.linalg.det(found.jacobians) - 1) < 1e-9 * largest)
    if size < 1e-7:
        (note,) = found.notes
        assert how in note
        assert found.own_condition.min() > 1e6 > 1e2 > found.condition.max()
    assert found.condition.max() < 1e6


def test_each_degree_of_freedom_has_the_type_that_it_needs() -> None:
    """A fast pendulum beside a slow one: only the short flow's pair changes its type."""
    Q1, Q2 = FOUR.symbols("Q1 Q2")
    short, one = sp.Rational(1, 10**9), sp.S.One
    F = sum(((a**2 + b**2) * sp.cos(s) - 2 * a * b) / (2 * sp.sin(s)) for a, b, s in ((q1, Q1, short), (q2, Q2, one)))
    coupled = ImplicitMap(GeneratingFunction(FOUR, type=1, F=F + q1 * Q2 / 10)).solve(RNG.uniform(-1, 1, (5, 4)))
    assert set(coupled.types) == {(2, 1)}
    assert (coupled.bits == 53).all()  # what cancels in the formula's coefficients has gone from it
    z = RNG.uniform(-1, 1, (40, 4))
    found = ImplicitMap(GeneratingFunction(FOUR, type=1, F=F)).solve(z)
    assert set(found.types) == {(2, 1)}
    assert (found.bits == 53).all()
    for k, time in ((0, 1e-9), (1, 1.0)):
        exact = exact_images(flow_exactly, z[:, [k, k + 2]], time)
        assert np.abs(found.images[:, [k, k + 2]] - exact).max() < 1e-15
    assert "type [2, 1] in place of 1, by its own formula; condition" in str(found)


def test_another_type_that_is_not_confirmed_is_not_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    """A Legendre transform made wrong on purpose, by one part in 10⁴: more digits are taken in its place."""
    right = GeneratingFunction.converted

    def wrong(F: GeneratingFunction, type: int) -> GeneratingFunction:  # noqa: A002
        found = right(F, type)
        return GeneratingFunction(found.space, type, found.F.expr * (1 + sp.Rational(1, 10**4)))

    monkeypatch.setattr(GeneratingFunction, "converted", wrong)
    z = np.array([[0.7, 0.3], [0.2, -1.0]])
    found = ImplicitMap(FLOW, {"tau": 1e-9}).solve(z)
    assert (found.bits > 53).all()
    assert np.abs(found.images - exact_images(flow_exactly, z, 1e-9)).max() < 1e-15


def test_double_precision_alone_would_lose_them(monkeypatch: pytest.MonkeyPatch) -> None:
    """The other side of these tests: F's own equations in double precision leave half of the digits."""
    monkeypatch.setattr(implicit_images, "LOSES", np.inf)
    found = ImplicitMap(FLOW, {"tau": 1e-8}, tolerated=np.inf).solve(np.array([[0.7, 0.3]]))
    off = abs(found.images[0, 1] - 0.3)
    assert 1e-11 < off <= found.errors[0, 1]
    assert found.condition[0] > 1e6


def test_digits_are_kept_where_all_of_them_are_asked_for() -> None:
    z = np.array([[0.7, 0.3], [0.2, -1.0]])
    plain, all_of_them = (ImplicitMap(FLOW, {"tau": 0.01}, **more).solve(z) for more in ({}, {"tolerated": 4.0}))
    exact = exact_images(flow_exactly, z, 0.01)
    assert np.abs(all_of_them.images - exact).max() < 2.3e-16 < np.abs(plain.images - exact).max()


def test_where_there_is_no_image_there_is_none() -> None:
    """p = ∂F/∂q = eᴾ has no solution for p < 0."""
    P = PLANE.symbols("P")
    f = ImplicitMap(GeneratingFunction(PLANE, type=2, F=x * sp.exp(P)))
    found = f.solve(np.array([[1.0, 2.0], [1.0, -2.0]]))
    assert list(found.solved) == [True, False]
    assert found.images[0] == pytest.approx([2.0, np.log(2)])
    assert np.isnan(found.images[1]).all()
    assert "not solved at 1 of 2 points" in str(found)


def test_what_is_missing_is_said() -> None:
    with pytest.raises(InputError, match="no value is given for omega"):
        ImplicitMap(TYPE_1, {"m": 1.0})
    with pytest.raises(InputError, match="'k' is no parameter"):
        ImplicitMap(TYPE_1, {"m": 1.0, "omega": 1.0, "k": 2.0})
    with pytest.raises(InputError, match="shape"):
        ImplicitMap(KICKED)(np.zeros((3, 2)))


# -- evidence for claims -------------------------------------------------------------------------


@pytest.mark.parametrize("generating", [TYPE_1, FLOW, KICKED])
def test_a_claim_about_an_implicit_map_has_numbers(generating: GeneratingFunction) -> None:
    claim = generating.transformation().canonical()
    for method, status in (("numeric", "supported"), ("all", "proved")):
        verdict = verify(claim, method=method)
        assert verdict.status == status
        assert verdict.numeric is not None
        assert verdict.numeric.points > 900
        assert verdict.numeric.max_residual <= verdict.numeric.bound
        assert "Newton's method" in verdict.detail["solved"]
    assert verify(claim).numeric is None


def test_evidence_says_that_points_lie_near_a_caustic() -> None:
    """A short time, and momenta of ordinary size: q and Q nearly agree at every point of the domain."""
    space = PLANE.where("-1 < p", "p < 1", "-1 < P", "P < 1")
    short = FLOW.F.expr.subs(tau, sp.Rational(1, 10**8))
    verdict = verify(GeneratingFunction(space, type=1, F=short).transformation().canonical(), method="numeric")
    assert verdict.status == "supported"
    assert "near a caustic" in verdict.detail["solved"]
    assert "in place of 1, in " in verdict.detail["solved"]


def test_evidence_that_denies_the_theorem_is_an_alarm(monkeypatch: pytest.MonkeyPatch) -> None:
    """A sign wrong on purpose in the equations for the new variables."""
    from canon.numeric import mixed_variables

    right = mixed_variables.Pattern.new_signs
    wrong = property(lambda self: -1.5 * right.fget(self))  # type: ignore[misc]
    monkeypatch.setattr(mixed_variables.Pattern, "new_signs", wrong)
    for method in ("numeric", "all"):
        verdict = verify(KICKED.transformation().canonical(), method=method)
        assert verdict.status == "undecided"
        assert "contradict" in verdict.detail["alarm"]
        assert verdict.numeric is not None
        assert verdict.numeric.max_residual > 1e3 * verdict.numeric.bound


def test_few_steps_are_taken() -> None:
    """Newton's method, not a slower one: a cubic equation to all digits in a few steps."""
    P = PLANE.symbols("P")
    cubic = ImplicitMap(GeneratingFunction(PLANE, type=2, F=x * P + x * P**3 / 3))
    found = cubic.solve(RNG.uniform(-2, 2, (500, 2)), guess=np.array([0.1]))
    assert found.solved.all()
    assert found.iterations.max() <= 12
    assert implicit.ITERATIONS > 12


def test_beyond_a_fold_it_is_soon_given_up() -> None:
    """p = P + q P² has no solution where 1 + 4 p q < 0: Newton's steps crawl there, and the last of them for ever."""
    space = PhaseSpace("q", "p", new=("Q", "P"))
    q, P = space.symbols("q P")
    fold = ImplicitMap(GeneratingFunction(space, type=2, F=q * P + q**2 * P**2 / 2))
    points = np.array([[1.0, -1.0 + 0.01 * k] for k in range(150)])
    start = process_time()
    found = fold.solve(points)
    assert process_time() - start < 8  # it was 20 s; a second or two alone
    assert (found.solved == (1 + 4 * points[:, 0] * points[:, 1] >= 0)).all()


@pytest.mark.parametrize(("p", "guess"), [(0.8, 0.1), (-0.8, 3.1)])
@pytest.mark.parametrize("q", [1e-3, 1e-8, 1e-14])
def test_a_start_may_be_decades_away_from_a_pole(q: float, p: float, guess: float) -> None:
    """φ = atan2(q, p) of p = q cot φ: towards the pole each step is a small part of Newton's, and none is in vain."""
    pole = ImplicitMap(GeneratingFunction(OSCILLATOR, type=1, F=TYPE_1.F.expr.subs({m: 1, omega: 1})))
    found = pole.solve(np.array([[q, p]]), np.array([guess]))
    assert found.solved.all()
    assert found.images[0, 0] == pytest.approx(float(np.arctan2(q, p)), rel=1e-14)
