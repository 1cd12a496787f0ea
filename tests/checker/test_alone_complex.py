"""Claims with complex names: what is shown, near misses, and what mustn't be read off numbers that have no signs."""

from typing import Any

import pytest

from canon.checker import alone_complex, alone_together
from tests.checker.certified import certified, resealed

LINE: Any = {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]}}
NAMES: Any = {
    "z": "complex",
    "w": ["complex", "nonzero"],
    "m": "positive",
    "k": "positive",
    "a": "real",
    "V": "function",
}


def answer(claim: Any, **sections: Any) -> str:
    """The answer about a certificate that says of each residual that it is 0."""
    tables = {**LINE, "symbols": NAMES, **sections, "claim": claim}
    count = 1
    for reader in (alone_complex.Small, alone_complex.Wide):
        try:
            count = len(reader(tables).zeros)
            break
        except Exception:  # whatever it says of them
            continue
    entry = {"numerator": {}, "denominator": {"": "1"}, "cofactors": {}}
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None,
            "cases": [{"kernels": [], "residuals": [entry] * count}]}  # fmt: skip
    return alone_complex.checked(resealed(data))[0]


SHOWN = [
    ("1j**2", "-1"), ("exp(1j*a)", "cos(a) + 1j*sin(a)"), ("cos(1j*a)", "cosh(a)"), ("sin(z)**2 + cos(z)**2", "1"),
    ("(z + 1j*w)*(z - 1j*w)", "z**2 + w**2"), ("sqrt(m)*sqrt(k)*1j", "1j*sqrt(m*k)"), ("sqrt(4*m**2)*z", "2*m*z"),
    ("D(exp(1j*a*q), q)", "1j*a*exp(1j*a*q)"), ("1/(q + 1j)", "(q - 1j)/(q**2 + 1)"), ("sqrt(z)**2", "z"),
    ("V(q)*1j**3", "-1j*V(q)"), ("exp(z)*exp(-z)", "1"), ("exp(1j*a)**(-2)", "exp(-2j*a)"),
]  # fmt: skip


@pytest.mark.parametrize(("lhs", "rhs"), SHOWN)
def test_an_identity_is_shown(lhs: str, rhs: str) -> None:
    assert answer({"kind": "identity", "lhs": lhs, "rhs": rhs}) == "shown"


MISSES = [
    ("1j**2", "1"), ("1j", "-1j"), ("exp(1j*a)", "cos(a) - 1j*sin(a)"), ("cos(1j*a)", "cos(a)"), ("sqrt(z**2)", "z"),
    ("sqrt(z*w)", "sqrt(z)*sqrt(w)"), ("sqrt(-m)", "1j*sqrt(m)"), ("sqrt(-m)", "-1j*sqrt(m)"), ("sqrt(a**2)", "a"),
    ("exp(z)**(1/2)", "exp(z/2)"), ("V(z)", "V(z)"), ("log(z)", "log(z)"), ("log(exp(1j*a))", "1j*a"),
    ("sqrt(1j)**4", "1"), ("z**(1/3)", "z**(1/3)"), ("sqrt(2)*1j", "-sqrt(2)*1j"), ("exp(1j*pi)", "1"),
    ("sqrt(m)*1j", "-sqrt(m)*1j"), ("sqrt(4)*1j", "-2j"), ("sqrt((a - 1)**2)*1j", "(a - 1)*1j"), ("abs(z)", "z"),
    ("z", "w"), ("1j*q", "0*q"), ("j", "1j"), ("atan2(z, w)", "atan2(z, w)"), ("acos(z) + asin(z)", "0*z"),
    ("D(V(1j*q), q)", "V(q)"), ("2j", "j2"), ("z**w", "z**w"),
]  # fmt: skip


@pytest.mark.parametrize(("lhs", "rhs"), MISSES)
def test_what_is_false_or_has_branches_is_not_shown(lhs: str, rhs: str) -> None:
    assert [answer({"kind": "identity", "lhs": lhs, "rhs": rhs}) for _ in range(3)] == ["not shown"] * 3


MAP = {"transformation": {"Q": ["(q + 1j*p)/sqrt(2)"], "P": ["(q - 1j*p)/sqrt(2)"]}}


def test_complex_amplitudes_are_canonical_with_their_valence() -> None:
    assert answer({"kind": "canonical", "scale": "-1j"}, **MAP) == "shown"
    for scale in ("1j", "1", "-1", "-1j*z", "-2j"):
        assert answer({"kind": "canonical", "scale": scale}, **MAP) == "not shown"
    energy = {"hamiltonian": {"H": "(p**2 + q**2)/2"}, **MAP}
    assert answer({"kind": "new_hamiltonian", "K": "-1j*Q*P"}, **energy) == "shown"
    assert answer({"kind": "new_hamiltonian", "K": "1j*Q*P"}, **energy) == "not shown"


@pytest.mark.parametrize(
    "equals", ["q + s*1j + log(s - 1) - log(s - 1)", "q + s*1j + 0*sqrt(s)", "q + 1j*s + 0*atan2(s, -1)"]
)
def test_what_is_near_0_has_no_signs(equals: str) -> None:
    series = {"kind": "lie_series", "generator": "1j*p", "parameter": "s", "f": "q"}
    assert answer({**series, "equals": "q + 1j*s"}) == "shown"
    assert answer({**series, "equals": equals}) == "not shown"


@pytest.mark.parametrize("words", [["complex", "positive"], ["complex", "integer"], ["complex", "function"]])
def test_a_complex_name_has_no_sign(words: Any) -> None:
    assert answer({"kind": "identity", "lhs": "z", "rhs": "z"}, symbols={"z": words}) == "not shown"


def test_it_is_asked_where_something_is_complex() -> None:
    text = '[phase_space]\nq = ["q"]\np = ["p"]\n[symbols]\nm = "positive"\n'
    data = certified(text, "kind = 'bracket'\nf = 'q + 1j*m*p'\ng = 'q - 1j*m*p'\nequals = '-2j*m'")
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["claim"]["equals"] = "2j*m"
    assert alone_together.checked(resealed(data))[0] == "not shown"
