import pickle

import sympy as sp

import canon
from canon import PhaseSpace, Transformation

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


def test_an_implicit_map_is_left_to_its_generating_function():
    F = canon.GeneratingFunction(SPACE, 1, q * Q)
    subject = F.transformation().canonical().subject
    assert subject.transformation is None
    assert subject.map.direction == "implicit"


def test_the_domain_of_the_space_comes_along():
    space = SPACE.where(q > 0)
    assert canon.bracket(space, q, p, 1).subject.domain == space.domain
    assert Transformation(space, Q=p, P=-q).volume().subject.domain == space.domain
