"""The tape in double precision: bounds that hold against balls, and what sampling does with them."""

import random

import numpy as np
import pytest
import sympy as sp
from flint import arb

from canon.budget import Budget
from canon.claims.verify import verify
from canon.decide import sampling
from canon.decide.arbitrary import choose_functions
from canon.decide.enclosure import evaluate, precision
from canon.decide.floating import evaluate_many
from canon.decide.region import Region
from canon.decide.search import Finder
from canon.decide.tape import Tape, Unsupported
from canon.domain import Domain, conditions_of
from canon.mechanics import PhaseSpace, Transformation

x, y = sp.symbols("x y", real=True)
z = sp.Symbol("z", complex=True)
V = sp.Function("V")

FORMULAS = [
    sp.sin(x * y) * sp.exp(x) / sp.sqrt(x**2 + y**2),
    sp.atan2(y, x) * sp.log(1 + x**2) - sp.cbrt(x**2 + 2) / 3,
    sp.sqrt(2) * x**7 - sp.acos(x / 10) * sp.sinh(y) + sp.Abs(x) ** sp.Rational(5, 3),
    (sp.cos(x) - 1 + x**2 / 2) / x**3 - sp.asin(y / 4) + sp.atan(x * y**3),
    sp.tan(x) - sp.pi * y + 1 / (x - y),
]


def compared(expression: sp.Expr, count: int = 200, typical: float = 1e-11) -> float:
    """The largest error of a value, as a part of its bound."""
    tape = Tape()
    node = tape.load(expression)
    order = tape.reach([node])
    rng = np.random.default_rng(1)
    place = {tape.symbol(s): rng.uniform(-3, 3, count) for s in (x, y)}
    functions = choose_functions(tape, order, random.Random(2))
    values, bounds = evaluate_many(tape, order, place, functions)[node]
    assert np.isfinite(bounds).all()
    assert np.median(bounds) < typical
    worst = 0.0
    with precision(400):
        for k in range(count):
            point = {name: arb(float(array[k])) for name, array in place.items()}
            exact = evaluate(tape, order, point, functions)[node]
            worst = max(worst, abs(float(exact - arb(float(values[k])))) / bounds[k])
    return worst


@pytest.mark.parametrize("expression", FORMULAS)
def test_bounds_hold(expression: sp.Expr) -> None:
    assert 0 < compared(expression) <= 1


MILLION = 10**6
INEXACT = 4 * MILLION * (sp.sin(x + sp.Rational(1, MILLION)) - sp.sin(x))
"""4 cos x, of which ten digits are left."""


@pytest.mark.parametrize(
    "expression",
    [
        INEXACT**5, (INEXACT + 9) ** -3, sp.sqrt(INEXACT + 9), sp.exp(INEXACT), sp.log(INEXACT + 9),
        sp.sin(INEXACT) * y,
        sp.atan(INEXACT), sp.asin(INEXACT / 5), sp.acos(INEXACT / 5), sp.Abs(INEXACT + 7) ** sp.Rational(7, 3),
        sp.atan2(INEXACT, 5 + y), INEXACT * sp.tan(INEXACT / 4),
        (INEXACT + 9) ** 4 / (INEXACT - 9) ** 3,
    ],
)  # fmt: skip
def test_bounds_hold_of_what_is_computed_from_inexact_values(expression: sp.Expr) -> None:
    assert 0 < compared(expression, 60, typical=1e-3) <= 1


def test_bounds_hold_for_arbitrary_functions() -> None:
    assert compared(V(x**2 * y) + x * sp.diff(V(x), x)) <= 1


def test_complex_numbers() -> None:
    """(1 + z)² − 1 − 2z − z² and √(z²+4)² − z² − 4 are rounding alone."""
    tape = Tape()
    nodes = [
        tape.load((1 + z) ** 2 - 1 - 2 * z - z**2),
        tape.load(sp.exp(z) * sp.exp(-z) - 1),
        tape.load(sp.sin(z) ** 2 + sp.cos(z) ** 2 - 1),
        tape.load(sp.sqrt(z + 5) ** 3 - (z + 5) * sp.sqrt(z + 5)),
        tape.load(sp.log(sp.I * z + 7) - sp.log(sp.I * z + 7 + sp.I / 10**9)),
    ]
    rng = np.random.default_rng(3)
    place = {tape.symbol(z): rng.uniform(-2, 2, 300) + 1j * rng.uniform(-2, 2, 300)}
    found = evaluate_many(tape, tape.reach(nodes), place)
    for node in nodes[:-1]:
        value, bound = found[node]
        assert np.all(np.abs(value) <= bound)
        assert np.median(bound) < 1e-13
    value, bound = found[nodes[-1]]
    assert np.all(np.abs(value) > bound)


def test_outside_of_a_domain_nothing_is_bounded() -> None:
    tape = Tape()
    nodes = [tape.load(f) for f in (sp.sqrt(x), sp.log(x), sp.acos(x), 1 / x)]
    found = evaluate_many(tape, tape.reach(nodes), {tape.symbol(x): np.array([-1.5, 0.0])})
    good = [np.isfinite(found[node][1]) & np.isfinite(found[node][0]) for node in nodes]
    assert [list(g) for g in good] == [[False, False], [False, False], [False, True], [True, False]]


def test_a_function_without_a_rule_is_sampled_in_balls() -> None:
    tape = Tape()
    node = tape.load(sp.elliptic_k(x) - sp.elliptic_k(x) * (sp.sin(y) ** 2 + sp.cos(y) ** 2))
    with pytest.raises(Unsupported):
        evaluate_many(tape, tape.reach([node]), {tape.symbol(s): np.array([0.5]) for s in (x, y)})
    region = Region.of(tape, Domain(conditions=tuple(conditions_of(sp.elliptic_k(x)))))
    evidence, refutation = sampling.sample(tape, [node], region, points=20, budget=Budget(5))
    assert refutation is None
    assert evidence is not None
    assert evidence.points == 20


def test_a_thousand_points_take_few_balls(monkeypatch: pytest.MonkeyPatch) -> None:
    certified = []
    real = Finder.certify

    def counted(self, *arguments):
        certified.append(1)
        return real(self, *arguments)

    monkeypatch.setattr(Finder, "certify", counted)
    space = PhaseSpace("q", "p", new=("Q", "P"))
    q, p = space.symbols("q p")
    verdict = verify(
        Transformation(space, Q=(sp.log(sp.sin(p) / q),), P=(q * sp.cot(p),)).canonical(), method="numeric"
    )
    assert verdict.status == "supported"
    assert verdict.numeric is not None
    assert verdict.numeric.points == 1000
    assert verdict.numeric.max_residual <= verdict.numeric.bound
    assert len(certified) < 100


def test_a_failure_far_from_the_first_points_is_found() -> None:
    """1e-7·max(x − 20, 0)-like: zero for x < 20, so that the first points see nothing."""
    space = PhaseSpace("q", "p", new=("Q", "P"))
    q, p = space.symbols("q p")
    bump = sp.Abs(q - 30) + q - 30
    verdict = verify(Transformation(space, Q=(q,), P=(p + p * bump / 10**7,)).canonical(), method="numeric")
    assert verdict.status == "refuted"
    assert verdict.witness is not None
    assert sp.Rational(verdict.witness["q"]) > 30
    assert len(verdict.witness["q"]) < 12


def test_a_bound_that_is_too_small_is_not_believed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Rounding beyond a wrong bound refutes nothing: balls take over."""
    from canon.decide import floating

    monkeypatch.setattr(floating, "UNIT", 2.0**-70)
    monkeypatch.setattr(floating, "ULPS", 0.0)
    space = PhaseSpace("q", "p", new=("Q", "P"))
    q, p = space.symbols("q p")
    verdict = verify(
        Transformation(space, Q=(sp.log(sp.sin(p) / q),), P=(q * sp.cot(p),)).canonical(), method="numeric"
    )
    assert verdict.status == "supported"
    assert verdict.numeric is not None
    assert verdict.numeric.max_residual <= verdict.numeric.bound


def test_refutations_bring_their_residual() -> None:
    space = PhaseSpace("q", "p", new=("Q", "P"))
    q, p = space.symbols("q p")
    verdict = verify(Transformation(space, Q=(2 * q,), P=(p,)).canonical(), method="numeric")
    assert verdict.status == "refuted"
    assert verdict.numeric is not None
    assert verdict.numeric.max_residual == pytest.approx(1.0)
    assert verdict.numeric.bound < 1e-12
