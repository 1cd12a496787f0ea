"""Normal forms in one small file: what is shown, near misses, and what is none."""

from typing import Any

import pytest

from canon.checker import alone_normal_forms, alone_together
from tests.checker.certified import certified, resealed

ONE: Any = {"phase_space": {"q": ["q"], "p": ["p"]}, "symbols": {"w": "positive", "a": "real", "V": "function"}}
TWO: Any = {"phase_space": {"q": ["x", "y"], "p": ["px", "py"]}, "symbols": {"w": "positive"}}
J, E = "(p**2 + q**2)/2", "(p**2 + w**2*q**2)/2"
QUARTIC = (f"{E} + a*q**4/4", 4, {"4": f"3*a*({E})**2/(8*w**4)"})
CUBIC = (f"{E} + a*q**3/3", 4, {"4": f"-5*a**2*({E})**2/(12*w**6)"})
HENON = "(px**2 + py**2 + x**2 + y**2)/2 + x**2*y - y**3/3"
I, M = "(x**2 + y**2 + px**2 + py**2)/2", "(x*py - y*px)"
FOURTH = f"-5/12*({I})**2 + 7/12*{M}**2"


def answer(H: str, order: Any, N: Any, file: Any = ONE, **sections: Any) -> str:
    tables = {**file, "hamiltonian": {"H": H}, "claim": {"kind": "normal_form", "order": order, "N": N}, **sections}
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": [{}]}
    return alone_normal_forms.checked(resealed(data))[0]


@pytest.mark.parametrize("given", [
    QUARTIC, CUBIC, (J, 6, {}), (J, 3, {"2": J}), (f"{J} + q**3", 3, {}), (f"{E} + a*q**3", 3, {"2": E}),
    ("p**2/2 + 1 - cos(q)", 6, {"4": f"-({J})**2/16", "6": f"-({J})**3/256"}),
    ("exp(q**2/2) + p**2/2", 4, {"4": f"3*({J})**2/16"}), ("p**2/2 + q**2/(2 + 2*q**2)", 4, {"4": f"-3*({J})**2/4"}),
    ("(p**2 - q**2)/2 + a*q**3", 3, {}), (HENON, 4, {"4": FOURTH}, TWO), (HENON, 3, {}, TWO),
])  # fmt: skip
def test_normal_forms_are_shown(given: Any) -> None:
    assert answer(*given) == "shown"


@pytest.mark.parametrize("given", [
    (QUARTIC[0], 4, {"4": f"3*a*({E})**2/(8*w**3)"}), (QUARTIC[0], 4, {}),
    (QUARTIC[0], 4, {"4": f"-{QUARTIC[2]['4']}"}),
    (QUARTIC[0], 4, {"4": "a*q**4/4"}), (CUBIC[0], 4, {}), (CUBIC[0], 3, {"3": "a*q**3/3"}), (J, 4, {"4": f"({J})**2"}),
    (J, 3, {"2": f"2*({J})"}), (HENON, 4, {"4": f"-5/12*({I})**2 + 5/12*{M}**2"}, TWO), (HENON, 4, {}, TWO),
    ("p**2/2 + 1 - cos(q)", 4, {"4": f"({J})**2/16"}), ("p**2/2 + 1 - cos(q)", 6, {"4": f"-({J})**2/16"}),
    (QUARTIC[0], 4, {"4": f"3*sqrt(a**2)*({E})**2/(8*w**4)"}), (J, 4, {"4": "a - a"}), (J, 4, {"4": "1"}),
    ("(w**2*x**2 + px**2 + y**2 + py**2)/2 + x**2*y", 3, {}, TWO),  # w may be 1/2
    ("a*(p**2 + q**2)/2 + q**3", 3, {}), ("p**2/2", 3, {}), ("p**2/2 + q**3", 3, {}),
])  # fmt: skip
def test_what_is_false_isnt_shown(given: Any) -> None:
    expected = "shown" if given in ((J, 4, {"4": "a - a"}), ("p**2/2", 3, {})) else "not shown"
    assert answer(*given) == expected


@pytest.mark.parametrize("given", [
    ("q + p**2/2", 3, {}), ("q**3", 3, {}), ("sqrt(q**2 + p**2)", 3, {}), (f"{J} + t*q**3", 3, {}),
    (f"{J} + V(q)", 3, {}),
    (f"{J} + 0/q", 3, {}), (f"{J} + log(q)*0", 3, {}), (f"{J} + sqrt(q**6)", 3, {}), (J, 2, {}), (J, "4", {}),
    (J, 9, {}),
    (J, 4, {"5": "0"}), (J, 4, {"1": "0"}), (J, 4, {"04": "0"}), (J, 4, {"4": f"{J}"}), (J, 4, {"4": "0*t"}),
    (J, True, {}),
    (f"{J} + cos(a)*q**3", 3, {}), (f"{J} + D(V(q), p)", 3, {}), (f"{J} + 1j*q**3", 3, {}),
])  # fmt: skip
def test_what_no_file_could_state_isnt_shown(given: Any) -> None:
    assert answer(*given) == "not shown"


def test_other_sections() -> None:
    for sections in ({"domain": {"where": ["q > -1"]}}, {"symbols": {"q": "positive"}}, {"definitions": {"q": "p"}},
        {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]}, "transformation": {"Q": ["q"], "P": ["p"]}},
        {"domain": {"on": ["q"]}}):  # fmt: skip
        assert answer(J, 4, {}, **sections) == "not shown"
    claim = {"kind": "normal_form", "order": 4, "N": {}, "scale": "1"}
    assert answer(J, 4, {}, claim=claim) == "not shown"


def test_it_is_asked_of_a_certificate() -> None:
    text = '[phase_space]\nq = ["q"]\np = ["p"]\n[hamiltonian]\nH = "(p**2 + q**2)/2 + q**3"\n'
    data = certified(text, f'kind = "normal_form"\norder = 4\nN = {{ 4 = "-15*({J})**2/4" }}')
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["claim"]["N"] = {"4": f"-15*({J})**2/2"}
    assert alone_together.checked(resealed(data))[0] == "not shown"
