"""The comparison with Maxima notices a verdict that is wrong, where Maxima is installed."""

import random
import shutil

import pytest

from properties.maxima import Skipped, ask, judged, point, question

SPACE = {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]}}
RIGHT = {"transformation": {"Q": ["sqrt(2*q)*exp(t)*cos(p)"], "P": ["sqrt(2*q)*exp(-t)*sin(p)"]}}
WRONG = {"transformation": {"Q": ["sqrt(2*q)*exp(t)*cos(p)"], "P": ["1001/1000*sqrt(2*q)*exp(-t)*sin(p)"]}}
CLAIMS = [
    (SPACE | RIGHT, {"kind": "canonical"}, "vanishes"),
    (SPACE | WRONG, {"kind": "canonical"}, "differs"),
    (SPACE, {"kind": "identity", "lhs": "log(q**2)", "rhs": "2*log(q)"}, "vanishes"),
    (SPACE, {"kind": "identity", "lhs": "exp(2*log(q)) + (q**4)**(1/4)", "rhs": "q + q**2"}, "vanishes"),
    (SPACE, {"kind": "identity", "lhs": "sqrt(q**2)", "rhs": "q"}, "differs"),
    (SPACE, {"kind": "bracket", "f": "q**2", "g": "p", "equals": "2*q"}, "vanishes"),
    (SPACE, {"kind": "bracket", "f": "q**2", "g": "p", "equals": "2*q + 1/10**12"}, "differs"),
]


@pytest.mark.skipif(shutil.which("maxima") is None, reason="Maxima isn't installed")
def test_maxima_tells_right_from_wrong():
    rng = random.Random(1)
    asked = [(found := question(file, claim), [point(rng, found.names) for _ in range(8)]) for file, claim, _ in CLAIMS]
    for seen, (_, _, wanted) in zip(ask(asked, 120.0), CLAIMS, strict=True):
        assert len(seen) == 8
        assert judged("proved", seen) == ("agrees" if wanted == "vanishes" else "contradicts")
        assert "outside" in seen or "differs" in seen or set(seen) == {"vanishes"}


def test_what_is_not_translated_is_left_out():
    for lhs in ("V(q)", "1j*q", "r", "q.real"):
        with pytest.raises(Skipped):
            question(SPACE, {"kind": "identity", "lhs": lhs, "rhs": "q"})
