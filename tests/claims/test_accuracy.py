"""Sampling to an accuracy: residuals bounded by it, in as many bits as that takes, and said where doubles can't."""

import pytest

from canon import verify
from canon.claims.reader import read_text
from canon.cli.main import main
from canon.decide.to_accuracy import bits_for

FILE = """
[phase_space]
q = ["q"]
p = ["p"]
[symbols]
a = "positive"
[[claim]]
kind = "identity"
lhs = "sin(q + a)**2 + cos(q + a)**2 {more}"
rhs = "1"
"""


def claim(more: str = ""):
    return read_text(FILE.replace("{more}", more)).claims[0]


@pytest.mark.parametrize("accuracy", [1e-9, 1e-40, 1e-250])
def test_residuals_are_bounded_by_what_is_asked_for(accuracy: float) -> None:
    found = verify(claim(), method="numeric", accuracy=accuracy)
    assert found.status == "supported"
    assert found.numeric is not None
    assert found.numeric.bound <= accuracy
    assert found.numeric.bits >= bits_for(accuracy)
    assert found.detail["accuracy"] == {"asked": accuracy, "reached": True}


def test_a_defect_beyond_the_accuracy_is_refuted() -> None:
    found = verify(claim("+ 1e-60*exp(-q**2)"), method="numeric", accuracy=1e-70)
    assert found.status == "refuted"


def test_a_defect_below_it_is_not_seen_and_not_denied() -> None:
    found = verify(claim("+ 1e-200*exp(-q**2)"), method="numeric", accuracy=1e-20)
    assert found.status == "supported"
    assert found.numeric is not None
    assert found.numeric.bound > 1e-200


def test_what_doubles_cannot_hold_is_said_first(tmp_path, capsys) -> None:
    path = tmp_path / "identity.toml"
    path.write_text(FILE.replace("{more}", ""), encoding="utf-8")
    assert main(["verify", str(path), "--method", "numeric", "--accuracy", "1e-30", "--jobs", "1"]) == 0
    assert f"balls of {bits_for(1e-30)} bits" in capsys.readouterr().err
    assert main(["verify", str(path), "--accuracy", "1e-30"]) == 3
    assert "an exact decision has none" in capsys.readouterr().err
