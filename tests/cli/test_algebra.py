"""`canon algebra`: bracket tables, Killing forms and names, as text, LaTeX and JSON."""

import json

import pytest

from canon.cli.main import main

FILE = """
title = "rotations and boosts of a plane"
[phase_space]
q = ["x", "y"]
p = ["px", "py"]
[symbols]
k = "positive"
[[claim]]
kind = "algebra"
equals = "e(2)"
title = "motions of the plane"
basis = {M = "x*py - y*px", Px = "px", Py = "k*py"}
[[claim]]
kind = "bracket"
f = "x"
g = "px"
equals = "1"
[[claim]]
kind = "algebra"
equals = "so(3)"
expect = "fails"
basis = {f = "x**3", g = "px"}
"""


BOOSTS = """
[symbols]
k = "real"
[[claim]]
kind = "matrix_algebra"
equals = "so(2,1)"
[claim.basis]
K1 = [["0", "k", "0"], ["1", "0", "0"], ["0", "0", "0"]]
K2 = [["0", "0", "k"], ["0", "0", "0"], ["1", "0", "0"]]
J3 = [["0", "0", "0"], ["0", "0", "-1"], ["0", "1", "0"]]
"""


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "plane.toml"
    path.write_text(FILE)
    return str(path)


def test_text(file, capsys):
    assert main(["algebra", file]) == 0
    out = capsys.readouterr().out
    assert "#1 (motions of the plane): proved" in out
    rows = [line.split() for line in out.splitlines()]
    assert ["M", "0", "Py/k", "-Px*k"] in rows
    assert "  algebra          e(2)\n" in out
    assert "  Killing form     0 positive, 1 negative, 2 zero\n" in out
    assert "  derived series   3 > 2 > 0; centre of dimension 0" in out
    assert "#3: refuted\n  the basis doesn't close with constant coefficients: {f, g} = 3*x**2" in out
    assert "#2" not in out


def test_json(file, capsys):
    assert main(["algebra", file, "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    first, third = record["algebras"]
    assert (first["algebra"], first["verdict"], first["killing_signature"]) == ("e(2)", "proved", [0, 1, 2])
    assert first["brackets"] == {"M,Px": "Py/k", "M,Py": "-Px*k"}
    assert first["scales"] == {"Py": "1/k"} or first["scales"] == {"Px": "k"}
    assert (third["algebra"], third["verdict"], third["expected"]) == (None, "refuted", True)
    assert record["errors"] == []


def test_latex(file, capsys):
    assert main(["algebra", file, "--latex"]) == 0
    out = capsys.readouterr().out
    assert r"M & 0 & \frac{Py}{k} & - Px k \\" in out
    assert "e(2), Killing form of signature $(0, 1, 2)$" in out
    assert "K = \\begin{pmatrix}\n-2 & 0 & 0 \\\\\n0 & 0 & 0" in out


def test_parameters_of_any_sign_are_left_in_the_killing_form(tmp_path, capsys):
    path = tmp_path / "boosts.toml"
    path.write_text(BOOSTS)
    assert main(["algebra", str(path)]) == 1
    out = capsys.readouterr().out
    assert ["K1", "2*k", "0", "0"] in [line.split() for line in out.splitlines()]
    assert "  algebra          so(3) at k = -1\n" in out


def test_bad_input_is_named(tmp_path, capsys):
    empty = tmp_path / "none.toml"
    empty.write_text(
        '[phase_space]\nq = ["x"]\np = ["px"]\n[[claim]]\nkind = "bracket"\nf = "x"\ng = "x"\nequals = "0"'
    )
    assert main(["algebra", str(empty)]) == 3
    assert "no claim of kind algebra, matrix_algebra, group is in it" in capsys.readouterr().err
    assert main(["algebra", str(tmp_path / "absent.toml")]) == 3
    assert "absent.toml" in capsys.readouterr().err


def test_what_takes_too_long_costs_its_own_algebra(tmp_path, capsys):
    """One raised an error that took all others along, another took minutes, whatever the budget."""
    n = 8
    names = ", ".join(f'"x{k}"' for k in range(n)), ", ".join(f'"p{k}"' for k in range(n))
    pairs = [(j, k) for j in range(n) for k in range(j)]
    turns = ", ".join(f'L{j}_{k} = "x{j}*p{k} - x{k}*p{j}"' for j, k in pairs)

    def matrix(j: int, k: int) -> str:
        rows = [[{(j, k): "s", (k, j): "-s"}.get((a, b), f"{a - b}*sin(s)") for b in range(n)] for a in range(n)]
        return str(rows).replace("'", '"')

    turned = ", ".join(f"L{j}_{k} = {matrix(j, k)}" for j, k in pairs)
    text = f"""[phase_space]
q = [{names[0]}]
p = [{names[1]}]
[symbols]
s = "real"
[[claim]]
kind = "algebra"
equals = "so(8)"
basis = {{{turns}}}
[[claim]]
kind = "matrix_algebra"
equals = "so(8)"
basis = {{{turned}}}
[[claim]]
kind = "algebra"
equals = "heisenberg(1)"
basis = {{Q = "x0", P = "p0", E = "1"}}
budget = 20
"""
    path = tmp_path / "dear.toml"
    path.write_text(text)
    assert main(["algebra", str(path), "--json", "--budget", "0.2"]) == 2
    first, second, third = json.loads(capsys.readouterr().out)["algebras"]
    assert "isn't found within 0.2 s" in first["note"] or first["algebra"] == "so(8)"
    assert second["verdict"] == "undecided"
    assert (third["algebra"], third["verdict"]) == ("heisenberg(1)", "proved")
