"""Maps that a generating function alone defines: what is shown, near misses, and functions that define none."""

from typing import Any

import pytest

from canon.checker import alone_generated, alone_together
from tests.checker.certified import certified, resealed

SPACE: Any = {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]}}
NAMES = {"m": "positive", "k": "real", "V": "function", "P": "positive"}


def answer(kind: int | list[int], F: str, K: str = "", H: str = "p**2/(2*m) + V(q)", **sections: Any) -> str:
    """The answer about the map that F defines: that it is canonical, or what its Hamiltonian is."""
    claim = {"kind": "new_hamiltonian", "K": K} if K else {"kind": "canonical"}
    tables = {**SPACE, "symbols": NAMES, "hamiltonian": {"H": H}, "generating_function": {"type": kind, "F": F}}
    data = {"certificate": 1, "tables": {**tables, "claim": claim, **sections}, "verdict": "proved", "witness": None,
            "cases": [{}]}  # fmt: skip
    return alone_generated.checked(resealed(data))[0]


@pytest.mark.parametrize("given", [
    (1, "m*q**2/2/tan(Q)"), (2, "q*P"), (3, "-p*Q + V(Q)"), (4, "p*P"), (2, "V(q, P)"), ([2], "exp(q)*P"),
    (2, "q*P", "P**2/(2*m) + V(Q)"), (2, "q*P - m*t*q", "(P - m*t)**2/(2*m) + V(Q) - m*Q"),
    (1, "q*Q", "Q**2/(2*m) + V(-P)"), (1, "m*q**2/2/tan(Q)", "P", "p**2/(2*m) + m*q**2/2"),
    (4, "p*P", "Q**2/(2*m) + V(-P) + t"),
])  # fmt: skip
def test_a_map_is_shown(given: Any) -> None:
    answers = {answer(*given), answer(*given, symbols={**NAMES, "P": "real"})}
    assert answers == {"shown"}


@pytest.mark.parametrize("given", [
    (2, "q"), (2, "q + P"), (2, "V(q) + V(P)"), (2, "V(q, P) - V(q, P)"), (2, "k*q*P"), (2, "0*q*P"), (1, "q*P"),
    (2, "q*P + p"), (2, "q*P + Q"), (5, "q*P"), ([2, 2], "q*P"), (2, "(exp(1/(2*q + 2*P)) - exp(1/(2*(q + P))))*q"),
    (2, "q*P*1j"),
    (2, "q*P", "P**2/(2*m) - V(Q)"), (2, "q*P", "P**2/(2*m) + V(q)"), (2, "q*P - m*t*q", "(P - m*t)**2/(2*m) + V(Q)"),
    (2, "q*P", "P**2/(2*m) + V(Q) + P/1000"),
    (1, "q*Q", "Q**2/(2*m) + V(P)"), (1, "m*q**2/2/tan(Q)", "2*P", "p**2/(2*m)"),
    (2, "q", "0*P"), (2, "q*P", "P**2/(2*m) + V(Q)", "q*P"), (2, "q*sqrt(P**2)", "P**2/(2*m) + V(-Q)"),
])  # fmt: skip
def test_another_hamiltonian_or_no_map_shows_nothing(given: Any) -> None:
    assert answer(*given, symbols={**NAMES, "P": "real"}) == "not shown"


def test_it_is_about_the_generating_function_alone() -> None:
    explicit: Any = {"transformation": {"Q": ["q"], "P": ["2*p"]}}
    assert answer(2, "q*P", **explicit) == "not shown"
    assert answer(2, "q*P", claim={"kind": "canonical", "scale": "2"}) == "not shown"
    assert answer(2, "q*P", claim={"kind": "new_hamiltonian"}) == "not shown"
    assert answer(2, "q*P", claim={"kind": "volume"}) == "not shown"


def test_it_is_asked_of_a_certificate() -> None:
    text = (
        '[phase_space]\nq = ["q"]\np = ["p"]\nQ = ["Q"]\nP = ["P"]\n[generating_function]\ntype = 2\nF = "q*P + q**3"\n'
    )
    data = certified(text, "kind = 'canonical'")
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["generating_function"]["F"] = "q + P"
    assert alone_together.checked(resealed(data))[0] == "not shown"
