import pickle

import pytest
import sympy as sp

from canon import InputError, PhaseSpace


def test_names_become_symbols_with_their_assumptions():
    space = PhaseSpace("r theta", "p_r p_theta", positive="r m", symbols={"n": ["integer", "positive"]})
    assert space.n == 2
    assert space.q[0].is_positive
    assert space.p[0].is_real
    assert not space.p[0].is_positive
    n, m = space.symbols("n m")
    assert n.is_integer
    assert n.is_positive
    assert m.is_positive
    assert space.parameters == (n, m)


def test_a_single_name_gives_the_symbol_itself():
    assert PhaseSpace("q", "p").symbols("q") == sp.Symbol("q", real=True)


def test_complex_names_are_not_real():
    space = PhaseSpace("q", "p", new=("a", "b"), complex="a b")
    assert all(symbol.is_real is None for symbol in space.new)


def test_J_is_the_matrix_of_the_brackets():
    space = PhaseSpace("x y", "px py")
    assert sp.Matrix([[0, 0, 1, 0], [0, 0, 0, 1], [-1, 0, 0, 0], [0, -1, 0, 0]]) == space.J


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: PhaseSpace("x y", "px"), "2 coordinates and 1 momenta"),
        (lambda: PhaseSpace("q", "q"), "'q' is declared twice"),
        (lambda: PhaseSpace("q", "p", new=("Q", "P1 P2")), "1 new coordinates and 2 new momenta"),
        (lambda: PhaseSpace("q", "p", new=("Q1 Q2", "P1 P2")), "2 new pairs, but only 1 old ones"),
        (lambda: PhaseSpace("q", "t"), "'t' is declared twice"),
        (lambda: PhaseSpace("q", "p", symbols={"m": "positiv"}), "did you mean 'positive'"),
        (lambda: PhaseSpace("q", "p", positive="m", negative="m"), "contradict"),
        (lambda: PhaseSpace("q", "p", functions="q"), "cannot be a function"),
        (lambda: PhaseSpace("q", "p", positive="omega").symbols("omgea"), "did you mean 'omega'"),
        (lambda: PhaseSpace("q", "p").function("V"), "not declared as a function"),
        (lambda: PhaseSpace("q-1", "p"), "not a name"),
    ],
)
def test_what_is_ill_posed_is_an_input_error(build, message):
    with pytest.raises(InputError, match=message):
        build()


def test_where_restricts_the_domain():
    space = PhaseSpace("q", "p", positive="a")
    q, a = space.symbols("q a")
    region = space.where(q > -a, "q < a", sp.Ne(q, 0)).domain
    assert [condition.kind for condition in region.conditions] == ["positive", "positive", "nonzero"]
    assert region.conditions[0].terms == (q + a,)
    assert region.conditions[1].terms == (a - q,)
    assert space.where(sp.Eq(q, a)).domain.surface == (q - a,)
    assert space.domain.conditions == ()


def test_a_relation_that_never_holds_is_refused():
    space = PhaseSpace("q", "p", positive="a")
    with pytest.raises(InputError, match="never hold"):
        space.where(space.symbols("a") < 0)


def test_a_formula_can_be_read_from_text():
    space = PhaseSpace("q", "p", positive="m", functions="V")
    q, p, m = space.symbols("q p m")
    assert space.formula("p**2/(2*m) + V(q)").expr == p**2 / (2 * m) + space.function("V")(q)


def test_a_space_is_a_value():
    first, second = (PhaseSpace("q", "p", new=("Q", "P"), positive="m") for _ in range(2))
    assert first == second
    assert hash(first) == hash(second)
    assert pickle.loads(pickle.dumps(first)) == first  # noqa: S301
    assert first.swapped().swapped() == first
    with pytest.raises(AttributeError):
        first.t = sp.Symbol("s")  # pyright: ignore[reportAttributeAccessIssue]


@pytest.mark.parametrize("domain", [sp.Symbol("q") > 0, "q > 0", True])
def test_a_domain_is_no_relation(domain):
    with pytest.raises(InputError, match=r"space\.where"):
        PhaseSpace("q", "p", domain=domain)


def test_no_variable_is_an_integer():
    for name in ("q", "p", "Q", "t"):
        with pytest.raises(InputError, match="can't be an integer"):
            PhaseSpace("q", "p", new=("Q", "P"), integer=name)
