"""The language of formulas: what is read, and what is refused with its place."""

from fractions import Fraction

import pytest

from canon.errors import InputError
from canon.syntax import Call, Name, Number, Power, Product, Sum, parse, parse_relation


def shape(text: str) -> str:
    """The tree of a formula, fully parenthesised."""

    def show(node):
        if isinstance(node, Number):
            return f"{node.value}{'j' if node.imaginary else ''}"
        if isinstance(node, Name):
            return node.name
        if isinstance(node, Sum):
            return "(" + "".join("-+"[plus] + show(t) for t, plus in zip(node.terms, node.added, strict=True)) + ")"
        if isinstance(node, Product):
            signs = "".join("/*"[up] + show(f) for f, up in zip(node.factors, node.multiplied, strict=True))
            return "[" + signs + "]"
        if isinstance(node, Power):
            return f"{{{show(node.base)}^{show(node.exponent)}}}"
        assert isinstance(node, Call)
        return f"{node.name}({','.join(map(show, node.arguments))})"

    return show(parse(text))


@pytest.mark.parametrize(
    ("text", "tree"),
    [
        ("-x**2", "(-{x^2})"),
        ("2**-x**2", "{2^(-{x^2})}"),
        ("x**y**z", "{x^{y^z}}"),
        ("(x**y)**z", "{{x^y}^z}"),
        ("a/b*c", "[*a/b*c]"),
        ("a-b-c", "(+a-b-c)"),
        ("a*-b", "[*a*(-b)]"),
        ("-a*b", "[*(-a)*b]"),
        ("+x", "(+x)"),
        ("lambda*if", "[*lambda*if]"),
        ("f(x, y)\n + 1", "(+f(x,y)+1)"),
        ("θ", "θ"),
        ("3j", "3j"),
    ],
)
def test_precedence_is_that_of_python(text, tree):
    assert shape(text) == tree


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0.1", Fraction(1, 10)),
        ("1e-3", Fraction(1, 1000)),
        ("1E2", Fraction(100)),
        (".5", Fraction(1, 2)),
        ("3.", Fraction(3)),
        ("007", Fraction(7)),
        ("1e400", Fraction(10**400)),
        ("0.30000000000000004", Fraction(30000000000000004, 10**17)),
    ],
)
def test_numbers_are_exact(text, value):
    node = parse(text)
    assert isinstance(node, Number)
    assert node.value == value


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "empty"),
        ("  ", "empty"),
        ("x +", "ends too early"),
        ("2x", "write 2*x"),
        ("2(x)", "operator is missing before '(' at column 2"),
        ("sin x", "operator is missing before 'x' at column 5"),
        ("1_000", "plain decimal digits"),
        ("0x10", "plain decimal digits"),
        ("1e9999999", "more than 10000 bits"),
        ("9" * 20000, "more than 10000 bits"),
        ("x.real", "'.' at column 2 is not part of the language: attributes"),
        ("x[0]", "subscripts"),
        ("'x'", "strings"),
        ('"x"', "strings"),
        ("x^2", "write a power as **"),
        ("x²", "write a square as **2"),
        ("−x", "U+2212"),
        ("ﬁ", "write 'fi'"),
        ("ℎ*x", "write 'h'"),
        ("x\u00a0+1", "U+00A0"),
        ("\x00", "U+0000"),
        ("f()", "without an argument"),
        ("f(x,)", "not expected"),
        ("f(*x)", "'*' at column 3"),
        ("f(x=1)", "'=' at column 4"),
        ("(x", "')' is missing"),
        ("x)", "')' at column 2"),
        ("x;y", "';' at column 2"),
        ("x:=1", "':' at column 2"),
        ("x if y else z", "operator is missing"),
        ("lambda x: x", "operator is missing|':' at"),
        ("a < b", "comparison has no place"),
        ("__import__('os')", "strings"),
        ("x\n+\n y z", "line 3, column 4"),
        ("(" * 101 + "x" + ")" * 101, "100 levels"),
        ("-" * 101 + "x", "100 levels"),
        ("sin(" * 20000, "100 levels|at most 20000"),
        ("x" * 20001, "at most 20000"),
    ],
)
def test_what_is_not_in_the_language_is_refused_with_its_place(text, message):
    with pytest.raises(InputError) as caught:
        parse(text)
    assert any(part in str(caught.value) for part in message.split("|"))


def test_a_chain_of_comparisons():
    sides, signs = parse_relation("0 < theta <= 2*pi")
    assert len(sides) == 3
    assert signs == ("<", "<=")
    with pytest.raises(InputError, match="an inequality is expected"):
        parse_relation("theta")
