"""What is done for a file beside reading its formulas is bounded, too: advice, sums that must be 0, combinations."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from canon.claims.reader import read_text
from canon.cli.files import ADVISED, claim_files
from canon.vocabulary import nearest
from tests.hostile.measured import spent

SOON = 1.5

HEAD = '[phase_space]\nq = ["x", "y"]\np = ["px", "py"]\n[symbols]\nz = "real"\n'


def problems(text: str) -> list[str]:
    """What is wrong with a file, which is found out within the time that reading may take."""
    found: list[str] = []
    assert spent(lambda: found.extend(problem["message"] for problem in read_text(text).problems)) < SOON
    return found


@pytest.mark.parametrize(
    ("above", "below"),
    [
        ("(x + y + z + 1)**2000", "-(2*x + 2*y + 2*z + 2)**2000/2**2000"),
        ("((1 + y)**99)**99", "0"),
        ("(x + y + z + sqrt(1 + x**2))**60", "-(2*x + 2*y + 2*z + sqrt(4 + 4*x**2))**60/2**60"),
    ],
)
def test_a_tensor_is_not_multiplied_out_at_any_price(above: str, below: str) -> None:
    """It took all memory, before there was a worker or a budget."""
    tensor = f'[["0", "{above}", "0"], ["{below}", "0", "0"], ["0", "0", "0"]]'
    text = f'{HEAD}[[claim]]\nkind = "casimir"\nf = "x"\ncoordinates = ["x", "y", "z"]\ntensor = {tensor}\n'
    assert problems(text) == ["not antisymmetric: row 1, column 2 and row 2, column 1"]


def test_an_antisymmetric_tensor_may_be_written_in_any_way() -> None:
    tensor = '[["0", "(x + y)**2*z"], ["-(x**2 + 2*x*y + y**2)*z", "0"]]'
    text = f'{HEAD}[[claim]]\nkind = "casimir"\nf = "x"\ncoordinates = ["x", "y"]\ntensor = {tensor}\n'
    assert problems(text.replace("*z", "")) == []


@pytest.mark.parametrize(("kind", "more"), [("casimir", 'f = "A0"'), ("algebra", "basis = {BASIS}\n")])
def test_combinations_of_many_names_are_read_in_time(kind: str, more: str) -> None:
    names = [f"A{k}" for k in range(120)]
    total = "+".join(f"{k + 2}*{name}" for k, name in enumerate(names))
    pairs = ", ".join(f'"A{j},A{k}" = "{total}"' for k in range(6) for j in range(k))
    basis = ", ".join(f'{name} = "x"' for name in names)
    text = f'{HEAD}[[claim]]\nkind = "{kind}"\n{more.replace("BASIS", basis)}\nstructure = {{{pairs}}}\n'
    if kind == "casimir":
        text += f"coordinates = {names}\n".replace("'", '"')
    assert problems(text) == []


def test_what_is_no_combination_is_told() -> None:
    for total in ("A*B", "sin(A)", "A + 1", "A**2 - A*A + x"):
        text = (
            f'{HEAD}[[claim]]\nkind = "casimir"\nf = "A"\ncoordinates = ["A", "B"]\nstructure = {{"A,B" = "{total}"}}\n'
        )
        assert len(problems(text)) == 1


def test_thousands_of_unknown_names_are_told_without_advice() -> None:
    """Each was compared with all that are declared, which took minutes."""
    names = [f"{'a' * 60}{k:04d}" for k in range(300)]
    symbols = "".join(f'{name} = "real"\n' for name in names)
    claim = '[[claim]]\nkind = "conserved"\nf = "{}"\n'
    text = HEAD + symbols + "[hamiltonian]\nH = 'px**2'\n" + "".join(claim.format(name[:-1] + "b") for name in names)
    found = problems(text)
    assert len(found) == 300
    assert "did you mean" in found[0]
    assert "did you mean" not in found[-1]


def test_advice_names_what_is_nearest() -> None:
    words = ("momentum", "energy", "angular_momentum", "Omega", "omega_0", "theta")
    for name, meant in (
        ("momentun", "momentum"),
        ("ENERGY", "energy"),
        ("omega0", "omega_0"),
        ("anglar_momentum", "angular_momentum"),
    ):
        assert nearest(name, words) == f": did you mean {meant!r}?"
    assert nearest("xyz", words) == ""


def test_files_that_are_not_there_are_told_in_time(tmp_path: Path) -> None:
    for k in range(300):
        (tmp_path / f"claims_of_the_course_{k:04d}.txt").touch()
    asked = [os.path.join(tmp_path, f"claims_of_the_course_{k:04d}.toml") for k in range(300)]
    missing = []
    assert spent(lambda: missing.extend(claim_files(asked)[1])) < SOON
    assert [" meant?" in each.message for each in missing] == [k < ADVISED for k in range(300)]
