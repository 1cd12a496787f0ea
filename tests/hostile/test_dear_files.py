"""What all formulas of a file may cost is bounded: a file beyond it is refused in under a second, and says so."""

from __future__ import annotations

import tomllib
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest
import sympy as sp

from canon import measure
from canon.claims.reader import read_text
from canon.errors import InputError
from canon.expression import Vocabulary, read
from canon.measure import OF_FILE, Measure
from canon.scenes.reader import read_scene_text
from canon.slope import differentiated
from tests.hostile.dear import CLAIM, DEAR, HEAD, SCENES
from tests.hostile.measured import spent

SOON = 2.0
"""Seconds of the processor: twice what is said, for a machine that is busy."""


@pytest.mark.parametrize("name", DEAR)
def test_a_file_of_dear_formulas_is_refused_soon(name: str) -> None:
    found: list[Any] = []
    assert spent(lambda: found.append(read_text(DEAR[name]))) < SOON
    ((claims, problems),) = found
    assert not claims
    assert problems[-1]["message"].startswith("too much work to read all formulas up to here: divide them over several")


@pytest.mark.parametrize("name", SCENES)
def test_a_scene_of_dear_formulas_is_refused_soon(name: str) -> None:
    def refused() -> None:
        with pytest.raises(InputError, match="too much work to read all formulas"):
            read_scene_text(SCENES[name])

    assert spent(refused) < SOON


def test_a_scene_counts_its_own_formulas_alone() -> None:
    scene = '[[body]]\nmass = "sqrt(2)"\nposition = ["sin(1)", 0]\n[run]\nduration = 1\n'
    for _ in range(3):
        with pytest.raises(InputError):
            read_scene_text(SCENES["constants"])
        assert read_scene_text(scene).model.n == 2


def test_every_file_of_the_catalogue_takes_less_than_half(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(measure, "OF_FILE", OF_FILE // 2)
    folder = files("canon.catalogue")
    read = 0
    for room in ("actions", "course", "transformations"):
        for file in (folder / room).iterdir():
            if file.name.endswith(".toml"):
                assert not read_text(file.read_text(encoding="utf-8")).problems, file.name
                read += 1
    assert read > 300


def test_thousands_of_claims_are_read() -> None:
    assert len(read_text(HEAD + CLAIM * 2500).claims) == 2500


def test_what_is_written_again_is_not_built_again() -> None:
    terms = " + ".join(f"{k}*sin(q*p)*sqrt(1 + q**2)*f(q)" for k in range(300))
    text = f'{HEAD}[symbols]\nf = "function"\n[[claim]]\nkind = "bracket"\nf = "{terms}"\ng = "p"\nequals = "q"\n'
    (claim,) = read_text(text).claims
    assert not claim.keys["f"].conditions


def test_a_function_written_again_has_its_conditions_again() -> None:
    x = sp.Symbol("x", real=True)
    shared, vocabulary = Measure(), Vocabulary({"x": x})
    first, second = (
        read(text, vocabulary, "", shared) for text in ("log(x) + 1/x + sqrt(x)", "log(x) + 1/x + sqrt(x)")
    )
    assert first.conditions
    assert first == second


@pytest.mark.parametrize(
    "formula",
    [
        "sin(x*y)*exp(x/(y + 1))", "(x + y)**(x*y)", "(x**2 + 1)**3/(y - x)", "gamma(x*y)", "abs(x*y - 1)*sign(x)",
        "log(x**2 + y**2)", "atan2(x, y)", "f(x*y, x)", "D(f(x, y), x)*x", "elliptic_f(x, y)", "jacobi_sn(x, y)",
        "x**y*y**x", "lambertw(x)", "sqrt(x + sqrt(x + sqrt(x)))", "asin(x)*acos(y*x)", "tan(x)**2", "7", "y",
        "elliptic_pi(x, x)", "elliptic_pi(x, y)", "2**x", "x*x*x/(x*y)", "f(f(x, y), y)",
    ],
)  # fmt: skip
@pytest.mark.parametrize("by", ["x", "y"])
def test_derivatives_are_those_of_sympy(formula: str, by: str) -> None:
    symbols = {name: sp.Symbol(name, positive=True) for name in "xy"}
    value: Any = read(formula, Vocabulary(symbols, functions=frozenset("f"))).expr
    smooth = value.replace(sp.Abs, lambda u: sp.Symbol("s") * u)
    if smooth.has(sp.sign):
        return
    assert differentiated(smooth, symbols[by], Measure()) == smooth.diff(symbols[by])


@pytest.mark.parametrize(("corpus", "number"), [("round15_algebra", 411), ("round12", 53), ("round13_analysis", 0)])
def test_the_dearest_files_of_the_corpora_are_read(corpus: str, number: int) -> None:
    """A file of 109 identities between numbers was refused: their costs were counted five times over."""
    with (Path(__file__).parents[2] / "properties" / f"{corpus}.toml").open("rb") as stream:
        file = tomllib.load(stream)["file"][number]
    read = read_text(file["text"])
    assert len(read.claims) == len(file["truths"])
    assert not read.problems
