"""New Hamiltonians with derivatives by new variables, by a small file."""

from typing import Any

import pytest

from canon.checker import alone_together, alone_transported
from tests.checker.certified import resealed

SPACE: Any = {"q": ["x"], "p": ["p"], "Q": ["X"], "P": ["P"]}
NAMES: Any = {"m": "positive", "e": "real", "f": "function", "V": "function"}
H = "(p - e*D(f(x, t), x))**2/(2*m) + V(x)"
MAP: Any = {"Q": ["x"], "P": ["p + e*D(f(x, t), x)"]}
K = "(P - 2*e*D(f(X, t), X))**2/(2*m) + V(X) - e*D(f(X, t), t)"


def answer(K: str, H: str = H, by: Any = alone_transported, **more: Any) -> str:
    tables = {"phase_space": SPACE, "symbols": NAMES, "hamiltonian": {"H": H}, "transformation": MAP, **more}
    tables["claim"] = {"kind": "new_hamiltonian", "K": K, **more.get("claim", {})}
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": [{}], "known": {}}
    return by.checked(resealed(data))[0]


def test_it_is_shown() -> None:
    """K is one up to a function of time."""
    assert answer(K) == "shown"
    assert answer(K, by=alone_together) == "shown"
    assert answer(f"{K} + t**2") == "shown"


MISSES: Any = {
    "a sign": (K.replace("- e*D", "+ e*D"),),
    "without the rate": (K.replace("- e*D(f(X, t), t)", ""),),
    "a factor": (K.replace("2*e", "e"),),
    "more": (f"{K} + X",),
    "old in K": (K.replace("V(X)", "V(x)"),),
    "old derivatives in K": (K.replace("D(f(X, t), X)", "D(f(x, t), x)"),),
    "no dependence": (K.replace("D(f(X, t), X)", "D(f(X, t), x)"),),
    "new in H": (K, H.replace("V(x)", "V(X)")),
    "new derivatives in H": (K, H.replace("D(f(x, t), x)", "D(f(X, t), X)")),
    "by another name": (f"{K} + D(m*X, m)*0",),
}  # fmt: skip


@pytest.mark.parametrize("name", MISSES)
def test_near_misses_are_not_shown(name: str) -> None:
    assert answer(*MISSES[name]) == "not shown"


OTHER: Any = {
    "not canonical": {"transformation": {"Q": ["x"], "P": ["2*p + e*D(f(x, t), x)"]}},
    "backward": {"transformation": {"q": ["X"], "p": ["P"]}},
    "itself": {"transformation": {"Q": ["x"], "P": ["p + e*D(f(x, t), x) + 0*P"]}},
    "a scale": {"claim": {"scale": "1"}},
    "hidden": {"definitions": {"V0": "x"}, "claim": {"K": f"{K} + V0 - X"}},
    "a surface": {"domain": {"on": ["x - p"]}},
}  # fmt: skip


@pytest.mark.parametrize("name", OTHER)
def test_other_sections_are_heeded(name: str) -> None:
    assert answer(K, **OTHER[name]) == "not shown"


def test_a_scale_is_none_of_these() -> None:
    assert answer("P**2/m", "p**2/(2*m)", transformation={"Q": ["x"], "P": ["2*p"]}) == "not shown"
