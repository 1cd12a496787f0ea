"""Refutations that need no intervals: rational residuals at rational points, and what is none."""

from typing import Any

import pytest

from canon.checker.fractions_alone import fails_exactly
from canon.checker.kinds import obligations
from canon.checker.statement import Statement

MAP = {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]}}
CANONICAL = {"kind": "canonical"}
POINT = {"q": "11/3", "p": "-3/4"}
SCALED = {"Q": ["2*q"], "P": ["p"]}
Tables = dict[str, Any]
FOUND: dict[str, tuple[Tables, dict[str, Any], bool]] = {
    "a scale": ({"transformation": SCALED}, POINT, True),
    "a point of the domain": (
        {"transformation": SCALED, "domain": {"where": ["q > 11/3 - 1/1000", "p != 0"]}},
        POINT,
        True,
    ),
    "a parameter": (
        {"transformation": {"Q": ["a*q"], "P": ["p"]}, "symbols": {"a": "real"}},
        {**POINT, "a": "2"},
        True,
    ),
    "a surface": ({"transformation": SCALED, "domain": {"on": ["3*q + 4*p - 8"]}}, POINT, True),
    "it holds": ({"transformation": {"Q": ["2*q"], "P": ["p/2"]}}, POINT, False),
    "it holds for this parameter": (
        {"transformation": {"Q": ["a*q"], "P": ["p"]}, "symbols": {"a": "real"}},
        {**POINT, "a": "1"},
        False,
    ),
    "an end of the domain": ({"transformation": SCALED, "domain": {"where": ["q > 11/3"]}}, POINT, False),
    "what is no place": ({"transformation": SCALED, "domain": {"where": ["3*q != 11"]}}, POINT, False),
    "off the surface": ({"transformation": SCALED, "domain": {"on": ["3*q + 4*p - 7"]}}, POINT, False),
    "a sign": ({"transformation": SCALED, "symbols": {"p": "positive"}}, POINT, False),
    "a sign of the image": ({"transformation": SCALED, "symbols": {"P": "positive"}}, POINT, False),
    "no integer": (
        {"transformation": {"Q": ["n*q"], "P": ["p"]}, "symbols": {"n": "integer"}},
        {**POINT, "n": "3/2"},
        False,
    ),
    "a pole": ({"transformation": {"Q": ["2*q"], "P": ["p + 1/(3*q - 11)"]}}, POINT, False),
    "a name that is open": ({"transformation": {"Q": ["a*q"], "P": ["p"]}, "symbols": {"a": "real"}}, POINT, False),
    "a function": ({"transformation": {"Q": ["2*sin(q)"], "P": ["p"]}}, POINT, False),
    "a function that the residual lacks": ({"transformation": {"Q": ["2*q"], "P": ["p + log(-q)"]}}, POINT, False),
    "a complex point": ({"transformation": SCALED}, {**POINT, "p": {"re": "1", "im": "0"}}, False),
}


@pytest.mark.parametrize("name", FOUND)
def test_a_point_in_fractions(name: str) -> None:
    tables, witness, fails = FOUND[name]
    s = Statement({**MAP, **tables, "claim": CANONICAL}, {}, "refuted")
    assert any(fails_exactly(s, case, witness) for case in obligations(s)) == fails
