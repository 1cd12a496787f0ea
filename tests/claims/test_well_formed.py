"""Claims that are made by hand in Python: what a file's reader would refuse is refused of them, too."""

import copy
import pickle
from concurrent.futures import ThreadPoolExecutor

import pytest
import sympy as sp

from canon import (
    Claim,
    Condition,
    Domain,
    Formula,
    GeneratingFunction,
    InputError,
    PhaseSpace,
    Subject,
    Transformation,
    algebra,
    bracket,
    casimir,
    group,
    identity,
    matrix_algebra,
    normal_form,
    verify,
    verify_many,
)

SPACE = PhaseSpace("q", "p", new=("Q", "P"), positive="m")
q, p, Q, P, m = SPACE.symbols("q p Q P m")
STATED = {"f": Formula(q), "g": Formula(p), "equals": Formula(sp.Integer(1))}


def refusal(make):
    with pytest.raises(InputError) as caught:
        make()
    return str(caught.value)


def test_a_claim_made_by_hand_is_decided():
    assert verify(Claim("bracket", Subject(SPACE), STATED)).status == "proved"


A, B, C, T = *sp.symbols("a b c", real=True), SPACE.t
GROUP = PhaseSpace("q", "p", new=("Q", "P"), real=(A, B, C), positive=m)
SPIN = [[0, q * C, -q * B], [-q * C, 0, q * A], [q * B, -q * A, 0]]
PAIR = {"A": q**2, "B": q * p}


@pytest.mark.parametrize(
    ("make", "said"),
    [
        # {q², qp} = 2q² = (2q/p) qp: the equation holds, and there are no such constants
        (lambda: algebra(SPACE, PAIR, structure={"A,B": {"B": 2 * q / p}}), "'structure': p is out of place"),
        (lambda: algebra(SPACE, {"A": q, "B": T * q * p}, structure={"A,B": {"A": T}}), "t is out of place"),
        (
            lambda: matrix_algebra(SPACE, {"A": [[0, 1], [0, 0]], "B": [[q, 0], [0, 0]]}, equals="aff(1)"),
            "'basis': q is",
        ),
        (lambda: group(GROUP, [A + B + q * A * B], [A], [B], structure={}), "'composition': q is out of place"),
        (lambda: casimir(GROUP, A**2 + B**2 + C**2, [A, B, C], SPIN), "'tensor': q is out of place"),
        (lambda: casimir(GROUP, p, [A, B, C], [[0] * 3] * 3), "'f': p is out of place"),
    ],
)
def test_formulas_of_variables_that_a_file_would_not_let_them_use(make, said):
    claim = make()
    assert said in refusal(lambda: verify(claim))


def test_formulas_of_variables_that_are_open():
    assert verify(algebra(SPACE, PAIR, structure={"A,B": {"A": 2}})).status == "proved"
    assert verify(algebra(SPACE, {"A": m * q, "B": q * p / m}, structure={"A,B": {"A": 1 / m}})).status == "proved"
    spin = [[0, m * C, -m * B], [-m * C, 0, m * A], [m * B, -m * A, 0]]
    assert verify(casimir(GROUP, A**2 + B**2 + C**2, [A, B, C], spin)).status == "proved"
    assert verify(group(GROUP, [A + B + m * A * B], [A], [B], structure={})).status == "proved"


def test_a_key_that_is_misspelt_is_not_left_out_in_silence():
    doubled = Transformation(SPACE, Q=2 * q, P=p)
    asked = doubled.subject().claim("canonical", {"scal": Formula(sp.Integer(2))})
    assert "has no key 'scal': did you mean 'scale'?" in refusal(lambda: verify(asked))


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Claim("bracket", Subject(SPACE), {**STATED, "f": q}), "a Formula is expected, not q"),
        (lambda: Claim("bracket", Subject(SPACE), {**STATED, "f": "q"}), "a Formula is expected"),
        (lambda: Claim("involution", Subject(SPACE), {"functions": [q, p]}), "a Formula is expected"),
        (lambda: Claim("bracket", SPACE, STATED), "a claim is about a Subject"),
        (lambda: Claim("bracket", Subject(SPACE), STATED, budget=-1), "a budget is a number of seconds"),
        (lambda: Claim("bracket", Subject(SPACE), STATED, budget="x"), "a budget is a number of seconds"),
        (lambda: Claim(None, Subject(SPACE), STATED), "a claim has a kind"),
        (lambda: Claim("bracket", Subject(SPACE), None), "a table of keys"),
        (lambda: Claim("bracket", Subject(SPACE), STATED, expect="yes"), "expect is one of"),
        (lambda: Subject(SPACE, generating_function="F"), "what a claim is about can't be 'F'"),
        (lambda: Subject(SPACE, domain=q > 0), "what a claim is about can't be"),
        (lambda: Formula("q"), "an expression of sympy's"),
        (lambda: Formula(q, (q > 0,)), "a Condition is expected"),
        (lambda: Condition("negative", (q,)), "a condition is one of"),
        (lambda: Condition("positive", "q"), "the terms of a condition|a list of expressions is expected"),
        (lambda: Condition("uncut", (q,)), "the terms of a condition"),
        (lambda: Domain((q > 0,)), "a Condition is expected"),
        (lambda: Domain(surface=("q",)), "a surface is where"),
        (lambda: normal_form(SPACE, (q**2 + p**2) / 2, 4.0, {}), "a whole number is expected"),
        (lambda: normal_form(SPACE, (q**2 + p**2) / 2, 60, {}), "an order up to 20"),
        (lambda: GeneratingFunction(SPACE, 2.0, q * P), "there is no type 2.0"),
        (lambda: Transformation(SPACE, Q=q, P=p).generated_by(q * P), "a GeneratingFunction is expected"),
        (lambda: Transformation(SPACE, Q=q, P=p).canonical_when([1]), "a table parameter: value"),
        (lambda: PhaseSpace(1, 2), "names are expected"),
        (lambda: PhaseSpace([q**2], "p"), "a name or a symbol is expected"),
        (lambda: PhaseSpace("q", "p", symbols={"m": 3}), "a word such as"),
        (lambda: PhaseSpace("q", "p", time=3), "names are expected|a name or a symbol"),
        (lambda: SPACE.formula(q), "a text is expected"),
        (lambda: SPACE.symbols(None), "names are expected"),
        (lambda: SPACE.where(sp.Eq(sp.Tuple(q), sp.Tuple(p))), "which is no formula"),
        (lambda: bracket(None, q, p, 1), "a PhaseSpace is expected"),
        (lambda: Transformation("q", Q=q, P=p), "a PhaseSpace is expected"),
        (lambda: algebra(SPACE, [q, p], equals="R^2"), "a table by names"),
        (lambda: algebra(SPACE, {"A": q}, equals=3), "the name of an algebra"),
        (lambda: algebra(SPACE, {"A": q, "B": p}, structure={"A,B": "A"}), "a table by names"),
        (lambda: algebra(SPACE, {"A": q, "B": p}, structure={("A", "B"): {"A": 1}}), "a table by names"),
    ],
)  # fmt: skip
def test_what_is_no_claim_is_an_error_of_input(make, said):
    with pytest.raises(InputError, match=said):
        verify(make())


def test_formulas_and_domains_keep_what_they_were_made_of():
    conditions, surface = [Condition("positive", [q])], [q - p]
    domain = Domain(conditions, surface)
    formula = Formula(q, conditions)
    conditions.clear()
    surface.append(q)
    assert domain == Domain((Condition("positive", (q,)),), (q - p,))
    assert formula.conditions == (Condition("positive", (q,)),)


@pytest.mark.parametrize("options", [{"seed": [1]}, {"seed": None}, {"accuracy": 0}, {"accuracy": -1},
                                     {"accuracy": float("nan")}, {"accuracy": "x"}, {"accuracy": 2}])  # fmt: skip
def test_a_seed_and_an_accuracy_are_numbers(options):
    (word,) = options
    assert f"{word} is a" in refusal(lambda: verify(bracket(SPACE, q, p, 1), method="all", **options))


def test_a_hamiltonian_in_new_variables_is_refused():
    same = Transformation(SPACE, Q=q, P=p)
    for make in (
        lambda: same.new_hamiltonian(P**2 / 2, P**2 / 2),
        lambda: same.symmetry(P),
        lambda: Subject(SPACE, hamiltonian=P**2 / 2).claim("conserved", {"f": Formula(q)}),
    ):
        assert "P is one of the new variables: the Hamiltonian is one in the old ones" in refusal(make)
    assert verify(same.inverse().new_hamiltonian(P**2 / 2, p**2 / 2)).status == "proved"


def test_a_generating_function_of_other_names_is_refused():
    elsewhere = PhaseSpace("x", "y", new=("X", "Y"))
    x, Y = elsewhere.symbols("x Y")
    same = Transformation(SPACE, Q=q, P=p)
    assert "F is one of x, y, X, Y" in refusal(lambda: same.generated_by(GeneratingFunction(elsewhere, 2, x * Y)))
    turned = GeneratingFunction(SPACE.swapped(), 2, Q * p)
    assert "F is one of Q, P, q, p" in refusal(lambda: same.generated_by(turned))
    assert verify(same.generated_by(GeneratingFunction(SPACE, 2, q * P))).status == "proved"


def test_what_is_said_of_a_symbol_that_does_not_know_it_is_refused():
    plain = sp.Symbol("a")
    for word in ("positive", "negative", "nonnegative", "nonzero", "integer", "real"):
        said = refusal(lambda word=word: PhaseSpace("q", "p", **{word: [plain]}))
        assert f"the symbol a was not made {word}" in said
    assert "was not made positive" in refusal(lambda: PhaseSpace([sp.Symbol("x", real=True)], "p", positive="x"))
    assert "was not made complex" in refusal(lambda: PhaseSpace("q", "p", complex=[sp.Symbol("a", real=True)]))
    table = {sp.Symbol("a", real=True): "negative"}
    assert "was not made negative" in refusal(lambda: PhaseSpace("q", "p", symbols=table))
    known = sp.Symbol("a", positive=True)
    for word in ("positive", "real", "nonnegative", "nonzero"):
        space = PhaseSpace("q", "p", **{word: [known]})
        assert verify(identity(space, sp.sqrt(known**2) * q, known * q)).status == "proved"
    assert PhaseSpace("q", "p", complex=[plain]).parameters == (plain,)


def test_values_of_subs_that_are_put_in_one_after_the_other_are_refused():
    x = sp.Symbol("x")
    nested = sp.Subs(sp.Subs(x * q, x, q), q, p)
    assert nested.doit() == p**2
    assert "write what is meant" in refusal(lambda: identity(SPACE, nested, q * p))
    assert "write what is meant" in refusal(lambda: identity(SPACE, nested, p**2))
    assert verify(identity(SPACE, nested.doit(), p**2)).status == "proved"
    at_once = sp.Subs(x * q**2, (q, x), (p, q))
    assert verify(identity(SPACE, at_once, q * p**2)).status == "proved"


def test_many_claims_are_some_and_each_is_one():
    """With batches of none nothing would be decided, and nobody would be told."""
    true = bracket(SPACE, q, p, 1)
    asked = [
        (lambda: verify_many([true], batch=0), "batch: a whole number is needed"),
        (lambda: verify_many(true), "claims are expected"),
        (lambda: verify_many([true], executor=5), "an executor of concurrent.futures is expected"),
    ]
    for make, said in asked:
        assert said in refusal(lambda make=make: list(make()))
    with ThreadPoolExecutor(1) as here:
        found = dict(verify_many([None, true], executor=here, apart=False))
    assert "a claim is expected, not None" in str(found[0])
    assert found[1].status == "proved"


def test_a_verdict_is_not_changed_and_a_set_may_hold_it():
    claim = bracket(SPACE, q, p, 2)
    verdict = verify(claim)
    with pytest.raises(TypeError):
        verdict.witness["q"] = "0"
    with pytest.raises(TypeError):
        verdict.detail["fails"] = ""
    again = pickle.loads(pickle.dumps(verdict))  # noqa: S301 - our own
    assert again == verdict == copy.deepcopy(verdict)
    assert len({claim, bracket(SPACE, q, p, 2)}) == len({verdict, again}) == 1


def test_a_program_that_has_told_sympy_not_to_evaluate():
    space = PhaseSpace("q", "p")
    x, y = space.old
    N = {2: (x**2 + y**2) / 2, 4: -sp.Rational(15, 16) * (x**2 + y**2) ** 2}
    with sp.evaluate(False):
        assert verify(normal_form(space, (x**2 + y**2) / 2 + x**3, 4, N)).status == "proved"


def test_claims_of_a_subject_are_restricted_as_its_space_is() -> None:
    q, p = map(SPACE.symbol, "qp")
    right, above = SPACE.where(q > 0), SPACE.where(p > 0)
    keys = {"lhs": Formula(abs(q)), "rhs": Formula(q)}
    for subject in (Subject(right), Subject(right, domain=above.domain), Subject(above, domain=right.domain)):
        assert verify(subject.claim("identity", keys)).status == "proved"
    assert verify(Claim("identity", Subject(right), keys)).status == "proved"
    assert verify(Subject(above).claim("identity", keys)).status == "refuted"


def test_a_map_and_its_generating_function_bring_the_domains_of_their_spaces() -> None:
    """F = q P generates Q = |q|, P = p sign q where q > 0 alone."""
    plane = PhaseSpace("q", "p", new=("Q", "P"))
    q, p = map(plane.symbol, "qp")
    right, keys = plane.where(q > 0), {"lhs": Formula(abs(q)), "rhs": Formula(q)}
    F = GeneratingFunction(right, 2, q * plane.symbol("P"))
    everywhere, there = (Transformation(space, Q=abs(q), P=p * sp.sign(q)) for space in (plane, right))
    whole = GeneratingFunction(plane, 2, q * plane.symbol("P"))
    assert verify(everywhere.generated_by(F)).status == verify(there.generated_by(whole)).status == "proved"
    assert verify(everywhere.generated_by(whole)).status == "refuted"
    assert verify(Subject(plane, transformation=there).claim("identity", keys)).status == "proved"
    assert verify(Subject(plane, transformation=everywhere).claim("identity", keys)).status == "refuted"
