"""Where soundness hurts: surfaces, thin regions, conditions on other names, the bound of modular evaluation."""

import random
from fractions import Fraction

import pytest
import sympy as sp

from canon.budget import Budget
from canon.decide import ladder, modular
from canon.decide.cells import cells_of
from canon.decide.constants import _root_bound, number_is_zero
from canon.decide.ladder import Contradiction
from canon.decide.normal_form import reduce_to_zero
from canon.decide.region import Region
from canon.decide.sampling import sample
from canon.decide.tape import Tape
from canon.decide.tower import Tower
from canon.domain import Condition, Domain, conditions_of

x, y, z = sp.symbols("x y z", real=True)


def decided(f: sp.Expr, *conditions: Condition, surface: tuple[sp.Expr, ...] = (), seed: int = 0) -> ladder.Answer:
    tape = Tape()
    domain = Domain(conditions_of(f) + conditions, surface)
    return ladder.vanish(tape, [tape.load(f)], Region.of(tape, domain, f.free_symbols), budget=Budget(20), seed=seed)[0]


def positive(expression: sp.Expr) -> Condition:
    return Condition("positive", (expression,), f"{expression} > 0")


def test_a_witness_satisfies_conditions_on_names_that_the_residual_lacks():
    answer = decided(sp.Abs(x) - y, positive(y - 1), positive(z - 5 - x))
    assert answer.status == "refuted"
    point = {name: sp.Rational(value) for name, value in answer.witness.as_table().items()}
    assert point["y"] > 1
    assert point["z"] > 5 + point["x"]


@pytest.mark.parametrize("seed", range(5))
def test_no_refutation_outside_the_region(seed: int):
    assert decided(sp.Abs(y) - y, positive(y - 1), seed=seed).status == "proved"


@pytest.mark.parametrize(
    ("f", "surface", "status"),
    [
        (x * y - 1, (x * y - 1,), "proved"),
        (x**2 + y**2 - 1, (x**2 + y**2 - 1,), "proved"),
        (x - sp.sqrt(1 - y**2), (x**2 + y**2 - 1,), "refuted"),
        (x, (x * y,), "refuted"),
        (x**2 * z - z * y**2, (x - y,), "proved"),
        (sp.sin(x) - sp.cos(y), (sp.sin(x) - sp.cos(y),), "proved"),
        (x - y, (x**3 - y**3,), "supported"),
        (x + y + z, (x**2 + y**2 + z**2 - 3, x * y - z), "refuted"),
    ],
)
def test_on_a_surface(f: sp.Expr, surface: tuple[sp.Expr, ...], status: str):
    assert decided(f, surface=surface).status in ({status, "undecided"} if status == "supported" else {status})


def test_a_proof_never_coexists_with_a_ball_that_excludes_zero():
    tape = Tape()
    node, region = tape.load(x * y), Region((), (), ())
    run = ladder._Ladder(tape, region, Budget(20), random.Random(0))
    run.witnesses([node], {})
    with pytest.raises(Contradiction):
        run.prove(node, {}, "a wrong argument", {})


def test_the_modular_bound_is_enforced():
    tape = Tape()
    f = tape.load((sp.sqrt(1 + x**2) + y) ** 9 - (sp.sqrt(1 + x**2) + y) ** 8 * (sp.sqrt(1 + x**2) + y))
    tower = Tower(tape, [f], budget=Budget(20))
    zero, log2_error = modular.vanishing(tower, [f], random.Random(1))
    assert log2_error <= -100
    assert zero[f]
    other = tape.add([(f, 1), (tape.symbol(x), 1)])
    assert not modular.vanishing(Tower(tape, [other], budget=Budget(20)), [other], random.Random(1))[0][other]


@pytest.mark.parametrize(
    ("number", "zero"),
    [
        (sp.cbrt(2 + sp.sqrt(5)) - sp.cbrt(sp.sqrt(5) - 2) - 1, True),
        (sp.cos(sp.pi / 7) * sp.cos(2 * sp.pi / 7) * sp.cos(3 * sp.pi / 7) - sp.Rational(1, 8), True),
        (sp.cos(sp.pi / 7) * sp.cos(2 * sp.pi / 7) * sp.cos(3 * sp.pi / 7) - sp.Rational(1001, 8000), False),
        (sp.sqrt(5 + 2 * sp.sqrt(6)) - sp.sqrt(2) - sp.sqrt(3), True),
        (4 * sp.atan(sp.Rational(1, 5)) - sp.atan(sp.Rational(1, 239)) - sp.pi / 4, True),
        (sp.log(2 + sp.sqrt(3)) + sp.log(2 - sp.sqrt(3)), True),
        (sp.exp(sp.pi * sp.sqrt(163)) - 262537412640768744, False),
        (sp.sin(1) ** 2 + sp.cos(1) ** 2 - 1, True),
        (sp.tan(3 * sp.pi / 11) + 4 * sp.sin(2 * sp.pi / 11) - sp.sqrt(11), True),
        (sp.tan(3 * sp.pi / 11) + 4 * sp.sin(2 * sp.pi / 11) - sp.sqrt(11) - sp.Rational(1, 10**40), False),
    ],
)
def test_exact_constants(number: sp.Expr, zero: bool):
    tape = Tape()
    assert number_is_zero(tape, tape.load(number), Budget(20)) is zero


@pytest.mark.parametrize(
    ("name", "argument", "angle"),
    [
        ("atan", sp.sqrt(3) / 3, sp.pi / 6),
        ("asin", (sp.sqrt(5) - 1) / 4, sp.pi / 10),
        ("acos", -sp.sqrt(2) / 2, 3 * sp.pi / 4),
    ],
)
@pytest.mark.parametrize("off", [0, sp.Rational(1, 10**30)])
def test_inverse_functions_that_are_fractions_of_pi(name, argument, angle, off):
    """Times a root, so that no whole number of them is a turn."""
    tape = Tape()
    call = tape.times(tape.call(name, tape.load(argument)), tape.load(sp.sqrt(2)))
    rest = tape.minus(call, tape.load(sp.sqrt(2) * angle + off))
    assert number_is_zero(tape, rest, Budget(20)) is (off == 0)


NEAR = sp.pi * sp.log(2)


@pytest.mark.parametrize(
    ("number", "zero"),
    [
        (sp.Integer(0), True),
        (sp.Integer(1), False),
        (NEAR - sp.Rational(sp.N(NEAR, 60)), False),  # seen in 1024 bits, and by nothing else
        (sp.log(sp.Symbol("x")), None),
    ],
)
def test_what_is_known_of_a_number(number: sp.Expr, zero: bool | None):
    tape = Tape()
    assert number_is_zero(tape, tape.load(number), Budget(20)) is zero
    assert number_is_zero(tape, tape.call("log", tape.number(-2)), Budget(20)) is None  # on the cut


def test_cells_cut_where_a_condition_vanishes():
    tape = Tape()
    f = tape.load(sp.Abs(x - 1) + sp.atan2(y, x))
    region = Region.of(tape, Domain(conditions_of(sp.Abs(x - 1) + sp.atan2(y, x))), [x, y])
    cells = cells_of(tape, region, [f], Budget(20))
    assert cells is not None
    assert len(cells) == 6
    assert all(cell.connected for cell in cells)


def test_samples_stand_beside_their_own_bound():
    tape = Tape()
    f = tape.load(sp.sin(x) ** 2 + sp.cos(x) ** 2 - 1)
    evidence, refuted = sample(tape, [f], Region((), (), ()), points=50, budget=Budget(20))
    assert refuted is None
    assert evidence is not None
    assert evidence.points == 50
    assert evidence.max_residual <= evidence.bound < 1e-12
    _, refuted = sample(
        tape, [tape.add([(f, 1)], sp.Rational(1, 10**9))], Region((), (), ()), points=5, budget=Budget(20)
    )
    assert refuted is not None
    assert refuted.status == "refuted"


@pytest.mark.parametrize(
    "f", [sp.sqrt(2) - sp.Rational(7, 5), sp.sqrt(2) + sp.sqrt(3) - sp.Rational(22, 7), sp.sqrt(2) / 9]
)
def test_the_bound_below_a_number_is_below_its_conjugates(f: sp.Expr):
    """A ball within the bound proves 0: a bound that is too large would prove it of what isn't."""
    tape = Tape()
    node = tape.load(f)
    _, nonzero, field = reduce_to_zero(Tower(tape, [node], budget=Budget(20)), [node], Budget(20))
    bound = _root_bound(field, nonzero[node][0], Budget(20))
    conjugates = [
        f.xreplace({sp.sqrt(2): s * sp.sqrt(2), sp.sqrt(3): t * sp.sqrt(3)}) for s in (1, -1) for t in (1, -1)
    ]
    assert bound is not None
    assert 0 < float(bound) < min(abs(sp.N(c)) for c in conjugates)
    for number in (Fraction(1, 10), Fraction(1, 10**9), Fraction(7)):
        assert 0 < float(_root_bound(field, field.ring.constant(number), Budget(20))) <= number


@pytest.mark.parametrize(
    ("surface", "f"),
    [
        (3 * x**2 + 2 * x * y + 3 * y**2, x - y),
        (-2 * x**2 + 4 * x * y - 5 * y**2, x * y + x),
        (5 * x**2 + 4 * x * y + 2 * y**2 + 2 * y * z + 3 * z**2, x + y + z),
    ],
)
def test_a_definite_form_vanishes_at_the_origin_alone(surface: sp.Expr, f: sp.Expr):
    assert decided(f, surface=(surface,)).status == "proved"
    assert decided(f + 1, surface=(surface,)).status == "refuted"
