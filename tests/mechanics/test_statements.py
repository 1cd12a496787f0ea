import pickle
from typing import Any

import pytest
import sympy as sp

import canon
from canon import InputError, PhaseSpace, Transformation
from canon.domain import Domain
from canon.mechanics.assumptions import symbol_with
from canon.mechanics.relations import region_of

SPACE = PhaseSpace("q", "p", new=("Q", "P"), real="a eps")
q, p, Q, P, a, eps = SPACE.symbols("q p Q P a eps")
H = (p**2 + q**2) / 2
TURN = Transformation(SPACE, Q=p, P=-q)


def test_each_statement_is_a_claim_of_its_kind():
    claims = {
        "bracket": canon.bracket(SPACE, q, p, 1),
        "jacobi": canon.jacobi(SPACE, q, p, H),
        "conserved": canon.conserved(SPACE, H, H),
        "involution": canon.involution(SPACE, [q, q**2]),
        "independent": canon.independent(SPACE, [q, p]),
        "identity": canon.identity(SPACE, q + p, p + q),
        "lie_series": canon.lie_series(SPACE, H, eps, q, q * sp.cos(eps) + p * sp.sin(eps)),
        "infinitesimal": canon.infinitesimal(SPACE, H, p, -q),
        "equations_of_motion": canon.equations_of_motion(SPACE, H, p, -q),
        "hamiltonian_field": canon.hamiltonian_field(SPACE, p, -q),
        "legendre": canon.legendre(SPACE, p**2 / 2, a**2 / 2, a),
        "canonical": TURN.canonical(),
        "canonical_when": TURN.canonical_when({a: 1}),
        "fundamental_brackets": TURN.fundamental_brackets(),
        "bracket_invariance": TURN.bracket_invariance(Q, P**2),
        "volume": TURN.volume(),
        "integral_invariant": TURN.integral_invariant(),
        "cartan_invariant": TURN.cartan_invariant(H, (P**2 + Q**2) / 2),
        "generates": TURN.generated_by(canon.GeneratingFunction(SPACE, 1, q * Q)),
        "generating_function": TURN.has_generating_function(1, q * Q),
        "new_hamiltonian": TURN.new_hamiltonian(H, (P**2 + Q**2) / 2),
        "symmetry": TURN.symmetry(H),
    }
    for kind, claim in claims.items():
        assert claim.kind == kind
        assert claim.subject.space == SPACE
        assert pickle.loads(pickle.dumps(claim)).keys == claim.keys  # noqa: S301


def test_the_keys_are_formulas_with_their_conditions():
    claim = canon.bracket(SPACE, sp.log(q), p, 1 / q)
    assert [condition.kind for condition in claim.keys["f"].conditions] == ["positive"]
    assert [condition.kind for condition in claim.keys["equals"].conditions] == ["nonzero"]


def test_scale_and_order_are_keys_only_where_given():
    assert TURN.canonical().keys == {}
    assert TURN.canonical(2).keys["scale"].expr == 2
    assert TURN.canonical(order=(eps, 2)).keys["order"] == (eps, 2)


def test_statements_of_orbits_have_the_keys_that_are_given():
    """`action` and `frequency`; a series has an order only where one is given."""
    plain = canon.action(SPACE, H, q, a, 2 * sp.pi * a)
    assert plain.kind == "action"
    assert {name: str(value) for name, value in plain.keys.items()} == {
        "coordinate": "q", "energy": "a", "equals": "2*pi*a",
    }  # fmt: skip
    options = {"branch": "rotation", "period": sp.pi, "well": sp.S.One, "fixed": {eps: sp.S.Half}}
    whole = canon.frequency(SPACE, H, q, a, 1 / (2 * sp.pi), **options)
    assert whole.kind == "frequency"
    assert whole.subject.hamiltonian.expr == H
    assert (whole.keys["branch"], whole.keys["period"].expr, whole.keys["well"].expr) == ("rotation", sp.pi, 1)
    assert whole.keys["fixed"][eps].expr == sp.S.Half
    ordered = canon.lie_series(SPACE, H, eps, q, q + eps * p, order=1)
    assert ordered.keys["order"] == 1
    assert "order" not in canon.lie_series(SPACE, H, eps, q, q).keys


def test_words_of_assumptions_mean_what_they_say():
    facts = {
        "real": ("real", True), "complex": ("complex", True), "positive": ("positive", True),
        "negative": ("negative", True), "nonnegative": ("nonnegative", True), "nonzero": ("zero", False),
        "integer": ("integer", True),
    }  # fmt: skip
    for word, (fact, value) in facts.items():
        symbol = symbol_with("s", word)
        assert symbol.assumptions0[fact] is value
        assert symbol.is_real is (None if word == "complex" else True)
    assert symbol_with("s").assumptions0 == sp.Symbol("s", real=True).assumptions0
    assert symbol_with("s", "integer positive") == sp.Symbol("s", integer=True, positive=True)
    assert symbol_with("s", "complex nonzero").is_real is None
    with pytest.raises(InputError, match="did you mean 'positive'"):
        symbol_with("s", "positiv")
    with pytest.raises(InputError, match="contradict"):
        symbol_with("s", "positive negative")


def test_relations_are_regions():
    both = region_of(sp.And(q > 1, sp.Ne(p, 0), q**2 + p**2 < 9))
    assert {(c.kind, sp.expand(c.terms[0])) for c in both.conditions} == {
        ("positive", q - 1), ("nonzero", p), ("positive", 9 - q**2 - p**2),
    }  # fmt: skip
    assert region_of(sp.true) == Domain()
    assert region_of(sp.Eq(q**2, p)).surface == (q**2 - p,)
    assert {c.terms for c in region_of(sp.log(q) > 1 / p).conditions} == {(q,), (p,), (sp.log(q) - 1 / p,)}
    with pytest.raises(InputError, match="never hold"):
        region_of(sp.false)
    with pytest.raises(InputError, match="is expected"):
        region_of(q)


def test_an_implicit_map_is_left_to_its_generating_function():
    F = canon.GeneratingFunction(SPACE, 1, q * Q)
    subject = F.transformation().canonical().subject
    assert subject.transformation is None
    assert subject.map.direction == "implicit"


def test_the_domain_of_the_space_comes_along():
    space = SPACE.where(q > 0)
    assert canon.bracket(space, q, p, 1).subject.domain == space.domain
    assert Transformation(space, Q=p, P=-q).volume().subject.domain == space.domain


def test_symbols_may_be_named_and_what_is_none_is_refused():
    space = PhaseSpace("q", "p", positive="E b")
    q, p, E, b = (space.symbol(name) for name in ("q", "p", "E", "b"))
    named = canon.frequency(space, p**2 / 2 + b**2 * q**2 / 2, "q", "E", b / (2 * sp.pi), fixed={"E": E})
    assert named.keys["coordinate"] == q
    assert named.keys["fixed"].keys() == {E}
    assert canon.verify(canon.lie_series(space, p, "b", q, q + b)).status == "proved"
    others: tuple[Any, ...] = (3, "z", sp.Symbol("q"), q + 1)
    for other in others:
        with pytest.raises(InputError):
            canon.action(space, p**2 / 2 + q**2 / 2, other, E, 2 * sp.pi * E)
