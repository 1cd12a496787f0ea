"""The checker's formulas: read as the language reads them, differentiated as mpmath does, refused where they aren't."""

from fractions import Fraction
from typing import Any

import mpmath
import pytest

from canon.checker.formulas import Formulas
from canon.checker.functions import SLOPES, Unknown, Unreadable
from canon.checker.points import Numbers, Outside
from canon.expression import Vocabulary, read
from canon.mechanics.phase_space import PhaseSpace

SPACE = PhaseSpace("q", "p", symbols={"a": "positive", "lambda": "real"})
POINT = {"q": Fraction(3, 7), "p": Fraction(2, 5), "a": Fraction(4, 3), "lambda": Fraction(-1, 2)}
TEXTS = [
    "-q**2 + 2**3**2/7", "1e-3*q - .5*p", "lambda*q/(a + 1)/p", "sqrt(a + q**2)*cbrt(a)", "a**q", "q**-2 - -p",
    "atan2(q, p) + asin(q)*acos(p) - atan(a)", "tan(q) + cot(p) + sec(q)*csc(p)", "sinh(q)*cosh(p) - tanh(a)/coth(q)",
    "asinh(q) + acosh(a) + atanh(p)", "abs(lambda)*sign(lambda) + exp(-q)*log(a)", "bracket(q**2*p, sin(p)*q)",
    "D(sin(q*p), q, 2) + D(a*q, q)", "elliptic_k(q) + elliptic_e(q) + elliptic_f(q, p)",
    "gamma(a) + lambertw(a)", "pi*q",
]  # fmt: skip


def value(formulas: Formulas, node: int, point: dict[str, Any]) -> Any:
    numbers = Numbers()
    return numbers.values(formulas, [node], {n: numbers.number(Fraction(x)) for n, x in point.items()})[node]


@pytest.mark.parametrize("text", TEXTS)
def test_a_text_means_what_the_language_says(text: str) -> None:
    formulas = Formulas(pairs=[("q", "p")])
    pairs = tuple(zip(SPACE.q, SPACE.p, strict=True))
    expected = read(text, Vocabulary(SPACE.vocabulary, pairs=pairs)).expr.subs(
        {SPACE.vocabulary[name]: number for name, number in POINT.items()}
    )
    found = value(formulas, formulas.read(text, {}), POINT)
    assert abs(found - Numbers().mp.mpf(str(expected.doit().evalf(40)))) < 1e-30


@pytest.mark.parametrize("name", sorted(set(SLOPES) - {"sign", "gamma"}))
def test_derivatives_of_functions(name: str) -> None:
    """Each rule of the table, against a difference quotient in fifty digits."""
    formulas, h = Formulas(), Fraction(1, 10**12)
    point = {"u": Fraction(16, 5) if name == "acosh" else Fraction(3, 7), "v": Fraction(2, 7), "w": Fraction(3, 5)}
    arguments = "u, v" if len(SLOPES[name]) == 2 or name == "elliptic_f" else "u"
    arguments = "u, v, w" if name == "elliptic_pi/3" else "u, v" if "/" in name else arguments
    node = formulas.read(f"{name.partition('/')[0]}({arguments})", {})
    for letter, _ in zip("uvw", SLOPES[name], strict=False):
        right, left = (value(formulas, node, {**point, letter: point[letter] + s * h}) for s in (1, -1))
        slope = value(formulas, formulas.slope(node, letter), point)
        assert abs(slope - (right - left) / (2 * mpmath.mpf(h.numerator) / h.denominator)) < 1e-15


def test_declared_functions_are_differentiated_in_order() -> None:
    formulas = Formulas(["V"])
    node = formulas.slope(formulas.slope(formulas.read("V(q**2, p)", {}), "q"), "p")
    assert formulas.text(node) == "((2*q)*V[1, 1]((q**2), p))"
    numbers = Numbers()
    of = {"q": numbers.mp.mpf(3), "p": numbers.mp.mpf(2), "V": "a1**2*a2**3"}
    assert numbers.values(formulas, [node], of)[node] == 2 * 9 * 3 * 4 * 6


@pytest.mark.parametrize(
    "text",
    [
        "__import__('os').system('true')", "q.real", "q[0]", "lambda: 1", "[q]", "'q'", "q if p else a", "q; p", "q =",
        "print(q)", "q**10**10", "9**9**9", "0**-1", "1/0", "sqrt()", "(" * 300 + "q" + ")" * 300, "f(x=1)", "q @ p",
        "q" * 60_000, "1e99999", "", "q < p", "~q", "not q", "D(q)", "V[1, 0](q)", "V[q](q)", "q\x00",
    ],
)  # fmt: skip
def test_what_is_no_formula_is_refused(text: str) -> None:
    with pytest.raises(Unreadable):
        Formulas(["V"]).read(text, {})


def test_long_sums_and_deep_powers_end() -> None:
    formulas = Formulas()
    with pytest.raises(Unreadable):
        formulas.read("+".join(["q*p"] * 12_000), {})
    node = formulas.read("q + p", {})
    for _ in range(40):
        node = formulas.mul(node, node)
    with pytest.raises(Unknown):
        formulas.text(node)


@pytest.mark.parametrize(
    "text", ["1/(q - q)", "log(-a)", "sqrt(q - 1)", "asin(2*a)", "exp(exp(exp(99)))", "abs(q - q)"]
)
def test_outside_of_the_domain(text: str) -> None:
    formulas = Formulas()
    with pytest.raises(Outside):
        value(formulas, formulas.read(text.replace("q - q", "(q - 3/7)"), {}), POINT)
