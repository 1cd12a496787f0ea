"""Compositions of groups in one small file: what is shown, near misses, and compositions that are none."""

from typing import Any

import pytest

from canon.checker import alone_groups, alone_together
from tests.checker.certified import certified, resealed

SPACE: Any = {"phase_space": {"q": ["q"], "p": ["p"]}, "symbols": {"c": "positive", "k": "real", "V": "function"}}
AFFINE = ["a + x", "b + exp(a)*y"]
CROSS = [f"({a}{i} + {b}{i} {sign} ({a}{j}*{b}{k} - {a}{k}*{b}{j})/2)/(1 - (a1*b1 + a2*b2 + a3*b3)/4)"
    for sign, a, b in ("-ab",) for i, j, k in ((1, 2, 3), (2, 3, 1), (3, 1, 2))]  # fmt: skip


def answer(composition: Any, first: Any = "", second: Any = "", file: Any = SPACE, **keys: Any) -> str:
    """The answer about a composition of a, b with x, y."""
    n = len(composition)
    names = {"first": [*(first or "abd"[:n])], "second": [*(second or "xyz"[:n])]}
    claim = {"kind": "group", "composition": composition, **names, **(keys or {"equals": "u(1)"})}
    data = {"certificate": 1, "tables": {**file, "claim": claim}, "verdict": "proved", "witness": None, "cases": [{}]}
    return alone_groups.checked(resealed(data))[0]


def test_groups_are_shown() -> None:
    assert answer(["a + x"]) == answer(["(a + x)/(1 + a*x/c**2)"]) == answer(["a + x + k*a*x"]) == "shown"
    assert answer(["a + x", "b + y"], structure={}) == answer(AFFINE, structure={"a,b": "-b"}) == "shown"
    assert answer(AFFINE, equals="aff(1)") == answer(AFFINE, structure={"b,a": "b"}, equals="aff(1)") == "shown"


def test_rotations_by_gibbs_vectors() -> None:
    three = (["a1", "a2", "a3"], ["b1", "b2", "b3"])
    structure = {"a1,a2": "a3", "a2,a3": "a1", "a3,a1": "a2"}
    assert (
        answer(CROSS, *three, structure=structure, equals="so(3)") == answer(CROSS, *three, equals="so(3)") == "shown"
    )
    assert answer(CROSS, *three, equals="sl(2,r)") == answer(CROSS, *three, equals="e(3)") == "not shown"
    assert answer(CROSS, *three, structure=structure | {"a1,a2": "-a3"}) == "not shown"


def test_heisenbergs_group() -> None:
    heisenberg = ["a + x", "b + y", "d + z + (a*y - b*x)/2"]
    assert answer(heisenberg, structure={"a,b": "-d"}, equals="h(1)") == "shown"
    assert answer(heisenberg, structure={"a,b": "d"}) == answer(heisenberg, structure={"a,b": "-d/2"}) == "not shown"
    assert answer(heisenberg, structure={}) == answer(heisenberg, equals="so(3)") == "not shown"


@pytest.mark.parametrize("composition", [
    ["a"], ["x"], ["a + x + a**2*x"], ["a + x + a*x*(a - x)"], ["a + x + 1"], ["a*x"], ["a - x"], ["2*a + x"],
    ["a + 2*x"],
    ["a + x + a*x/1000*(a + x)"], ["sqrt((a + x)**2)"], ["a + x + sqrt(a**2*x**2)"], ["a + x + 0*log(a)"],
    ["a + x + 0/a"], ["a*x/a + a"], ["a + x + a*x*V(a)"], ["a + x + 0*V(a)"], ["a + x + q"], ["a + x + t"],
    ["asin(sin(a) + x) + 0"], ["a + x + a*x*1j"], ["(a**(1/3) + x**(1/3))**3"], ["(sqrt(a) + sqrt(x))**2"],
    ["a + x + exp(1/a)*0"], ["atan2(a, 1) + x"], ["0"],
])  # fmt: skip
def test_what_is_no_group_isnt_shown(composition: Any) -> None:
    assert answer(composition) == "not shown"


def test_what_no_file_could_state_isnt_shown() -> None:
    signed = lambda word: {**SPACE, "symbols": {"a": word}}
    assert answer(["a + x"], file=signed("real")) == "shown"
    assert {answer(["a + x"], file=signed(w)) for w in ("positive", "nonzero", "integer", "function")} == {"not shown"}
    assert answer(["a + x"], file={**SPACE, "domain": {"where": ["a > 1"]}}) == "not shown"
    assert answer(["a + x"], file={**SPACE, "hamiltonian": {"H": "p"}}) == "shown"
    assert answer(["a + x"], file={**SPACE, "symbols": {"a": "real"}, "hamiltonian": {"H": "1/a"}}) == "not shown"
    assert answer(["a + x"], file={**SPACE, "definitions": {"a": "0"}}) == "not shown"
    assert answer(["q + x"], "q", "x") == answer(["a + a"], "a", "a") == answer(["a + x"], "a", "xy") == "not shown"
    assert answer(["a + x"], inverse=["-a"], equals="u(1)") == answer(["a + x"], structure={"a,a": "0"}) == "not shown"
    assert (
        answer(AFFINE, structure={"a,b": "-b", "b,a": "b"}) == answer(AFFINE, structure={"a,b": "-b*a"}) == "not shown"
    )
    assert answer(AFFINE, structure={"a,b": "-y"}) == answer(AFFINE, structure={"a,d": "-b"}) == "not shown"
    assert answer(["a + x"], equals="so(3)") == answer(["a + x"], equals="some") == "not shown"


def test_it_is_asked_of_a_certificate() -> None:
    keys = 'first = ["a", "b"]\nsecond = ["x", "y"]\ncomposition = ["a + x", "b + exp(a)*y"]\nequals = "aff(1)"'
    data = certified('[phase_space]\nq = ["q"]\np = ["p"]\n', f'kind = "group"\n{keys}')
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["claim"]["composition"] = ["a + x", "b + y"]
    assert alone_together.checked(resealed(data))[0] == "not shown"
