"""Claims that fail where a parameter is 0, 1 or −1 alone, and others that have no value there."""

import pytest

SYMBOLS = 'a = "nonnegative"\nn = "integer"\nb = "real"\nm = "positive"\n'


def _limit(f: str, equals: str) -> str:
    return f'kind = "limit"\nf = "{f}"\nvariable = "q"\nto = "infinity"\nequals = "{equals}"'


def _positive(lhs: str) -> str:
    return f'kind = "inequality"\nlhs = "{lhs}"\nrelation = ">"\nrhs = "0"'


def _turn(f: str, equals: str) -> str:
    return f'kind = "integral"\nf = "{f}"\nvariable = "q"\nfrom = "0"\nto = "2*pi"\nequals = "{equals}"'


@pytest.mark.parametrize(
    ("text", "where"),
    [
        (_limit("exp(-a*q)", "0"), {"a": "0"}),
        (_limit("b**2/(1/q**2 + b**2)", "1"), {"b": "0"}),
        (_limit("exp(-(b - 1)**2*q)", "0"), {"b": "1"}),
        (_limit("exp(-(b + 1)**2*q)", "0"), {"b": "-1"}),
        (_positive("(b - 1)**2"), {"b": "1"}),
        (_positive("b**2 + m - 2*b*sqrt(m)"), {"b": "1", "m": "1"}),
        (_turn("cos(n*q)", "0"), {"n": "0"}),
    ],
)
def test_one_value_is_enough_to_refute(text: str, where: dict[str, str], ask) -> None:
    (found,) = ask(text, symbols=SYMBOLS)
    assert found.status == "refuted"
    assert found.witness is not None
    assert {name: found.witness[name] for name in where} == where


@pytest.mark.parametrize(
    "text",
    [
        _limit("a*exp(-a*q)/a", "0"),
        _limit("a*log(a*q)", "infinity"),
        _limit("exp(-a*q) + 0*log(a)", "0"),
        _limit("exp(-a*q)", "0*(1/a)"),
        _limit("exp(-(b - 1)**2*q)", "0/(b - 1)"),
        _positive("(b - 1)**2/(b - 1)*(b - 1)"),
        _positive("b**2*sqrt(b**2)/b**2"),
        _positive("a + 0*log(a)"),
        _turn("n*cos(n*q)/n", "0"),
        _turn("cos(n*q)", "0*(1/n)"),
    ],
)
def test_a_value_at_which_nothing_is_said_refutes_nothing(text: str, status) -> None:
    assert status(text, symbols=SYMBOLS) in ("proved", "supported")
