import pytest
import sympy as sp

from canon import GOLDSTEIN, LANDAU_LIFSHITZ, SICM, Conventions, InputError, PhaseSpace, poisson_bracket
from canon.mechanics.conventions import (
    generating_function_from,
    generating_function_in,
    translated_bracket,
    translated_iterated_bracket,
    translated_matrix,
    translated_vector,
)

SPACE = PhaseSpace("x y", "px py", new=("X Y", "PX PY"))
(x, y), (px, py) = SPACE.q, SPACE.p
f, g = x**2 * py + px, y * px**3 + x
MOMENTA_FIRST = Conventions("momenta first", order="pq", J_sign=-1)


def test_fundamental_brackets_of_the_books():
    assert GOLDSTEIN.bracket(x, px, SPACE) == 1
    assert SICM.bracket(x, px, SPACE) == 1
    assert LANDAU_LIFSHITZ.bracket(px, x, SPACE) == 1


@pytest.mark.parametrize("book", [GOLDSTEIN, LANDAU_LIFSHITZ, SICM, MOMENTA_FIRST])
def test_a_bracket_translates_to_what_the_book_computes(book, vanishes):
    ours = poisson_bracket(f, g, SPACE)
    assert vanishes(translated_bracket(ours, GOLDSTEIN, book) - book.bracket(f, g, SPACE))
    nested = poisson_bracket(poisson_bracket(f, g, SPACE), x * py, SPACE)
    theirs = book.bracket(book.bracket(f, g, SPACE), x * py, SPACE)
    assert vanishes(translated_iterated_bracket(nested, 2, GOLDSTEIN, book) - theirs)


@pytest.mark.parametrize("book", [GOLDSTEIN, LANDAU_LIFSHITZ, SICM, MOMENTA_FIRST])
def test_hamiltons_equations_are_the_same_everywhere(book, vanishes):
    variables = [z for z in book.variables(SPACE) if z != SPACE.t]
    H = px**2 / 2 + py**2 + x**2 * y
    rates = book.J(2) * sp.Matrix([H.diff(z) for z in variables])
    for variable, rate in zip(variables, rates, strict=True):
        assert vanishes(rate - book.evolution_sign() * book.bracket(variable, H, SPACE))
        assert vanishes(rate - poisson_bracket(variable, H, SPACE))


def test_matrices_and_vectors_change_their_order():
    assert translated_matrix(GOLDSTEIN.J(2), GOLDSTEIN, MOMENTA_FIRST) == MOMENTA_FIRST.J(2)
    assert translated_vector((SPACE.t, x, y, px, py), SICM, MOMENTA_FIRST) == (px, py, x, y)
    assert translated_vector((px, py, x, y), MOMENTA_FIRST, GOLDSTEIN) == (x, y, px, py)
    with pytest.raises(InputError, match="time in front"):
        translated_vector((x, y, px, py), GOLDSTEIN, SICM)
    with pytest.raises(InputError, match="square matrix of even size"):
        translated_matrix(sp.eye(3), GOLDSTEIN, SICM)


def test_generating_functions_there_and_back():
    turned = Conventions("type 3 with the other sign", function_signs=(1, 1, -1, 1))
    F = generating_function_from(SPACE, 3, px * SPACE.Q[0] + py * SPACE.Q[1], turned)
    assert F.F.expr == -px * SPACE.Q[0] - py * SPACE.Q[1]
    assert generating_function_in(F, turned) == px * SPACE.Q[0] + py * SPACE.Q[1]
    assert generating_function_in(F, SICM) == F.F.expr
    with pytest.raises(InputError, match="no one F"):
        generating_function_from(SPACE, (2, 3), 0, turned)


def test_a_convention_that_contradicts_itself_is_refused():
    with pytest.raises(InputError, match="wrong sign"):
        Conventions("no book", order="pq")


def test_the_sign_of_j_goes_with_the_order():
    """z' = J ∂H/∂z: with (q, p) it is +J, with (p, q) it is −J; every other sign is ±1, too."""
    turned = Conventions("other", order="pq", J_sign=-1, bracket_sign=-1, function_signs=(-1, 1, -1, 1))
    assert turned.J(1) == sp.Matrix([[0, -1], [1, 0]])
    assert Conventions("plain").J(1) == sp.Matrix([[0, 1], [-1, 0]])
    for given in ({"order": "pq"}, {"J_sign": -1}):
        with pytest.raises(InputError, match="wrong sign"):
            Conventions("none", **given)
    for given in ({"bracket_sign": 2}, {"J_sign": 0}, {"function_signs": (1, 1, -2, 1)}, {"bracket_sign": -2}):
        with pytest.raises(InputError, match=r"signs are \+1 or -1"):
            Conventions("none", **given)
