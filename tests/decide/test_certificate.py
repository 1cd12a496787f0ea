"""What a certificate and a witness say in words has the value that they speak of."""

import math
import pickle
from fractions import Fraction

import pytest
import sympy as sp
from flint import acb, arb

from canon.decide.answer import Witness, show_ball
from canon.decide.certificate import Certificate, of_tower
from canon.decide.enclosure import evaluate, precision
from canon.decide.generator_values import GeneratorBalls
from canon.decide.kernel_text import KernelText, cofactors, denominator_of
from canon.decide.region import Region, Requirement
from canon.decide.sample import Sample
from canon.decide.tape import Tape
from canon.special import JacobiDN
from properties.towers import tower_of

x, y = sp.symbols("x y", real=True)
a, b = sp.symbols("a b", positive=True)
z = sp.Symbol("z")
FORMULAS = [
    sp.sqrt(a) + (a + b) ** sp.Rational(2, 3) + sp.sqrt(x**2 * a + y**2) / (1 + x**2),
    sp.sin(x / a) + sp.cos(2 * x / a + y) * sp.exp(x / (a + b)) + sp.exp(-y),
    sp.log(a) + sp.log(1 + x**2) * sp.Abs(y) + sp.Abs(x - y) ** 3,
    sp.cos(sp.pi / 7) + sp.pi * sp.sin(2 * sp.pi / 5) + sp.sqrt(2),
    sp.atan(x / a) + sp.atan2(y, a) + sp.asin(x / 9) * sp.log(a - x),
    sp.sqrt(a**2 - x) * sp.sqrt((a - x) / (b + y**2)) + sp.log((a - x) * (b - x)),
]
KNOWN = {n: getattr(math, n) for n in ("cos", "sin", "exp", "log", "atan", "atan2", "asin", "pi")} | {"abs": abs}


@pytest.mark.parametrize("formula", FORMULAS, ids=str)
def test_kernels_are_what_they_are_said_to_stand_for(formula: sp.Expr):
    tape = Tape()
    node = tape.load(formula)
    tower = tower_of(tape, node, [])
    region = Region((Requirement("positive", (node,), "a > 0", " here"),), (), ())
    certificate = of_tower(tower, region, "because")
    assert dict(certificate)["argument"] == "because"
    assert certificate["domain"] == ["a > 0 here"]
    assert len(certificate) == 3
    place = {x: Fraction(2, 7), y: Fraction(-5, 4), a: Fraction(9, 5), b: Fraction(2, 3)}
    with precision(128):
        balls = {tape.symbol(s): arb(v.numerator) / v.denominator for s, v in place.items()}
        values = GeneratorBalls(tower, balls)
        of = [float(values.generator(k).mid()) for k in range(len(tower.generators))]
    names = KNOWN | {f"g{k}": v for k, v in enumerate(of)} | {str(s): float(v) for s, v in place.items()}
    for kernel, made in zip(certificate["kernels"], tower.generators, strict=True):
        assert kernel["name"] == f"g{made.index}"
        assert kernel["sign"] == made.sign
        assert eval(kernel["stands for"].replace("^", "**"), names) == pytest.approx(of[made.index])  # noqa: S307 - our own text
        assert ("relation" in kernel) == bool(made.degree)
        if made.degree:
            left, right = kernel["relation"].replace("^", "**").split(" = ")
            assert eval(left, names) == pytest.approx(eval(right, names))  # noqa: S307


def value(text: str, names: dict) -> float:
    return eval(text.replace("^", "**"), names)  # noqa: S307 - our own text


def value_of_table(table: dict[str, str], names: dict) -> float:
    return sum(float(Fraction(c)) * math.prod(value(f, names) for f in m.split()) for m, c in table.items())


@pytest.mark.parametrize("formula", FORMULAS, ids=str)
def test_formulas_of_kernels_have_their_values(formula: sp.Expr):
    """The texts that the checker reads: each kernel from those before, relations, numerators and their cofactors."""
    tape = Tape()
    node = tape.load(formula)
    tower = tower_of(tape, node, [])
    text = KernelText(tower, ["x", "y", "a", "b", "g1", "g_0"])
    assert set(text.names) & {"x", "y", "a", "b"} == {str(s) for s in formula.free_symbols}
    assert all(name.startswith("g__") for name in set(text.names) - {"x", "y", "a", "b"})
    place = {x: Fraction(2, 7), y: Fraction(-5, 4), a: Fraction(9, 5), b: Fraction(2, 3)}
    with precision(128):
        balls = {tape.symbol(s): arb(v.numerator) / v.denominator for s, v in place.items()}
        values = GeneratorBalls(tower, balls)
        of = [float(values.generator(k).mid()) for k in range(len(tower.generators))]
        exact = {kernel: float(values.element(e).mid()) for kernel, e in tower.kernels.items()}
    names = KNOWN | dict(zip(text.names, of, strict=True))
    for kernel, element in tower.kernels.items():
        assert value(text.fraction(element), names) == pytest.approx(exact[kernel])
        assert value_of_table(text.table(element[0]), names) == pytest.approx(value(text.formula(element[0]), names))
        below = denominator_of(tower.field, element)
        assert value(text.formula(element[0]), names) == pytest.approx(
            exact[kernel] * value(text.formula(below), names)
        )
    everything = [text.fraction(e) for e in tower.kernels.values()]
    listed = {entry["name"]: entry for entry in text.kernels(everything)}
    kinds = {text.names[g.index]: g for g in tower.generators if g.kind not in ("symbol", "full")}
    assert set(listed) <= set(kinds)
    for name, entry in listed.items():
        assert entry["sign"] == kinds[name].sign
        assert value(entry["stands for"], names) == pytest.approx(names[name])
        assert ("relation" in entry) == bool(kinds[name].degree)
        if "relation" in entry:
            assert value_of_table(entry["relation"], names) == pytest.approx(0, abs=1e-9)
    assert [e["name"] for e in text.kernels(everything)] == sorted(listed, key=text.names.index)
    assert text.kernels([]) == []


def test_cofactors_make_up_what_is_zero_and_nothing_else():
    tape = Tape()
    tower = tower_of(tape, tape.load(sp.sqrt(a + x**2) * sp.sqrt(a) + sp.sin(x) * sp.cos(x)), [])
    field, ring = tower.field, tower.ring
    relations = {generator: relation for generator, *_, relation in field.relations}
    assert len(relations) >= 3
    g = ring.generators
    surface = [g[1] - g[0] - ring.one, g[0] ** 2 - ring.one]
    total = ring.zero
    for k, relation in relations.items():
        total = total + relation * (g[k] + g[0] + ring.one)
    for k, p in enumerate(surface):
        total = total + p * (g[0] ** k + ring.constant(2))
    for equations in ([], surface):
        whole = total if equations else sum((r * (g[k] + g[0]) for k, r in relations.items()), ring.zero)
        found = cofactors(field, whole, equations)
        assert found is not None
        made = sum((c * (relations[k] if k >= 0 else equations[-k - 1]) for k, c in found.items()), ring.zero)
        assert made == whole
        assert cofactors(field, whole + ring.constant(Fraction(1, 1000)), equations) is None
    assert cofactors(field, ring.zero) == {}


def test_special_kernels_are_named():
    tape = Tape()
    formula = sp.I * sp.Function("V")(x * y).diff(x) + sp.log(z) + sp.sqrt(z) + sp.gamma(a + sp.Rational(1, 2))
    tower = tower_of(tape, tape.load(formula), [])
    said = {kernel["stands for"] for kernel in of_tower(tower, Region((), (), ()), "")["kernels"]}
    assert {"I", "x", "y", "z", "a"} <= said
    assert any(text.startswith("D[1] V(") for text in said)
    assert any(text.startswith("log((g") and ")/(1)" in text for text in said)
    assert any(text.startswith("(1)*((g") and text.endswith("**(1/2)") for text in said)
    assert any(text.startswith("gamma(g") for text in said)


def test_special_kernels_as_formulas():
    tape = Tape()
    formula = sp.Function("V")(x * y).diff(x) + JacobiDN(x, a / (1 + a)) + sp.I
    tower = tower_of(tape, tape.load(formula), [])
    text = KernelText(tower, [])
    said = {e["name"]: e["stands for"] for e in text.kernels([text.fraction(e) for e in tower.kernels.values()])}
    kinds = {text.names[g.index]: g.kind for g in tower.generators}
    assert {said[name] for name, kind in kinds.items() if kind == "arbitrary"} == {"V[1](x*y)"}
    assert {said[name] for name, kind in kinds.items() if kind == "I"} == {"1j"}
    assert {said[name] for name, kind in kinds.items() if kind == "jacobi_dn over"} == {
        "(a + 1)*jacobi_dn(x, (a)/((a + 1)**1))"
    }


def test_a_certificate_is_made_when_it_is_looked_at():
    made = []
    certificate = Certificate(lambda: made.append(1) or {"argument": "x_1", "cases": [{"why": ""}, {"why": "50 %"}]})
    assert "made when it is looked at" in repr(certificate)
    assert not made
    assert list(certificate) == ["argument", "cases"]
    assert repr(certificate) == "Certificate(argument, cases)"
    assert dict(pickle.loads(pickle.dumps(certificate))) == dict(certificate)  # noqa: S301 - our own
    assert made == [1]
    shown = certificate._repr_latex_()
    assert r"\text{why} &\colon \text{50 \%}" in shown
    assert shown.count(r"\colon") == 2


def test_a_witness_gives_values_exactly_or_to_certain_digits():
    tape = Tape()
    X, Y, Z = (tape.symbol(s) for s in (x, y, z))
    with precision(64):
        square = tape.load(x**2 + y)
        root = arb(2).sqrt()
        sample = Sample({X: Fraction(-3, 2), Z: (Fraction(1, 3), Fraction(2))}, {Y: root}, {}, {})
        ball = evaluate(tape, tape.reach([square]), {X: arb(-1.5), Y: root})[square]
        witness = Witness.of(tape, sample, ball)
    assert witness.coordinates["x"] == "-3/2"
    assert witness.coordinates["z"] == {"re": "1/3", "im": "2"}
    assert float(witness.coordinates["y"]) == pytest.approx(math.sqrt(2), rel=1e-15)
    assert float(witness.value) == pytest.approx(2.25 + math.sqrt(2), rel=1e-11)
    assert witness.as_table() == witness.coordinates
    assert witness.value_of(tape, tape.load(x**2 - 1)) == "5/4"
    assert float(witness.value_of(tape, tape.load(sp.exp(x) * y))) == pytest.approx(math.exp(-1.5) * math.sqrt(2))
    assert witness.value_of(tape, tape.load(a * x)) is None
    of_z = witness.value_of(tape, tape.load(z**2))
    assert (float(of_z["re"]), float(of_z["im"])) == pytest.approx((1 / 9 - 4, 4 / 3))
    assert show_ball(acb(1.5, -2)) == "1.50000000000 + -2.00000000000*1j"
    assert show_ball(arb(0, 1)) == "0"
