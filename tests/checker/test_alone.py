"""The checker in one file: what it shows, that it notices what was changed, and that it needs nothing but Python."""

import ast
import copy
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from canon.checker import alone
from tests.checker.certified import certified, places, resealed

FILE = Path(alone.__file__)
PLANE = '[phase_space]\nq = ["x", "y"]\np = ["px", "py"]\n'
POLAR = PLANE.replace("]\np =", "]\nQ = ['r', 'phi']\nP = ['pr', 'L']\np =") + (
    "[transformation]\nQ = ['sqrt(x**2 + y**2)', 'atan2(y, x)']\n"
    "P = ['(x*px + y*py)/sqrt(x**2 + y**2)', 'x*py - y*px']\n"
)
LINE = '[phase_space]\nq = ["q"]\np = ["p"]\n'
MAP = LINE.replace("]\np", "]\nQ = ['Q']\nP = ['P']\np")
ANGLE = (
    MAP
    + "[symbols]\nm = 'positive'\nomega = 'positive'\nP = 'positive'\n[hamiltonian]\nH = '(p**2 + m**2*omega**2*q**2)/"
    "(2*m)'\n[transformation]\nq = ['sqrt(2*P/(m*omega))*sin(Q)']\np = ['sqrt(2*m*omega*P)*cos(Q)']\n"
)
KEPLER = PLANE + "[symbols]\nV = 'function'\n[hamiltonian]\nH = '(px**2 + py**2)/2 + V(sqrt(x**2 + y**2))'\n"
COTANGENT = MAP + "[transformation]\nq = ['sqrt(2*P)*sin(Q)']\np = ['sqrt(2*P)*cos(Q)']\n[symbols]\nP = 'positive'\n"
MOVED = MAP + "[hamiltonian]\nH = 'p**2/2'\n[transformation]\nQ = ['q - t**2/2']\nP = ['p - t']\n"
SHOWN = {
    "polar coordinates": (POLAR, "kind = 'canonical'"),
    "action and angle": (ANGLE, "kind = 'canonical'"),
    "their Hamiltonian": (ANGLE, "kind = 'new_hamiltonian'\nK = 'omega*P'"),
    "a frame that is accelerated": (MOVED, "kind = 'new_hamiltonian'\nK = 'P**2/2 + Q + t**2/2'"),
    "type 1": (COTANGENT, "kind = 'generating_function'\ntype = 1\nF = 'q**2/2/tan(Q)'"),
    "what generates it": (ANGLE, "kind = 'generating_function'\ntype = 1\nF = 'm*omega*q**2*cos(Q)/sin(Q)/2'"),
    "a central force": (KEPLER, "kind = 'conserved'\nf = 'x*py - y*px'"),
    "its motion": (
        KEPLER,
        "kind = 'equations_of_motion'\nqdot = ['px', 'py']\npdot = ['-D(H0, x)', '-D(H0, y)']",
    ),
    "Jacobi": (PLANE, "kind = 'jacobi'\nf = 'x*py'\ng = 'sin(y)*px'\nh = 'exp(x*y)'"),
    "a bracket": (LINE, "kind = 'bracket'\nf = 'q**(1/2)'\ng = 'log(p)'\nequals = '1/(2*sqrt(q)*p)'"),
    "a double angle": (LINE, "kind = 'identity'\nlhs = 'sin(2*q)'\nrhs = '2*sin(q)*cos(q)'"),
    "roots of what is positive": (LINE, "kind = 'identity'\nlhs = 'sqrt(q)*sqrt(p)'\nrhs = 'sqrt(q*p)'"),
}  # fmt: skip
DEFINED = "[definitions]\nH0 = '(px**2 + py**2)/2 + V(sqrt(x**2 + y**2))'\n"


def proof(name: str) -> Any:
    text, keys = SHOWN[name]
    return certified(text + (DEFINED if "H0" in keys else ""), keys)


@pytest.mark.parametrize("name", SHOWN)
def test_it_shows_what_a_certificate_shows(name: str) -> None:
    assert alone.checked(proof(name)) == ("shown", "")


MUTANTS = {
    "polar coordinates": [("x*py - y*px", "x*py + y*px"), ("atan2(y, x)", "1001/1000*atan2(y, x)")],
    "action and angle": [("sqrt(2*P/", "sqrt(3*P/"), ("*cos(Q)", "*cos(Q + 1/1000)")],
    "their Hamiltonian": [("'omega*P'", "'-omega*P'"), ("omega*P", "omega*P*1001/1000"), ("omega*P", "omega*P + Q")],
    "a frame that is accelerated": [("+ Q +", "- Q +"), ("- t**2/2", "- t**2/3")],
    "type 1": [("q**2/2/tan(Q)", "-q**2/2/tan(Q)"), ("tan(Q)", "sin(Q)")],
    "what generates it": [("/sin(Q)/2", "/sin(Q)/3"), ("type = 1", "type = 3")],
    "a central force": [("x*py - y*px", "x*py - 1001/1000*y*px"), ("sqrt(x**2 + y**2)", "sqrt(x**2 + 2*y**2)")],
    "Jacobi": [],
    "a bracket": [("1/(2*", "-1/(2*"), ("q**(1/2)", "q**(1/3)")],
    "a double angle": [("2*sin(q)", "2001/1000*sin(q)"), ("sin(2*q)", "sin(2*q + pi)")],
    "roots of what is positive": [("sqrt(q*p)", "-sqrt(q*p)"), ("sqrt(q*p)", "sqrt(q*p + 1)")],
}


@pytest.mark.parametrize(("name", "old", "new"), [(name, *pair) for name, pairs in MUTANTS.items() for pair in pairs])
def test_the_proof_of_another_claim_shows_nothing(name: str, old: str, new: str) -> None:
    data = proof(name)
    key, kind = old.partition(" = ")[0], data["tables"]
    changed = json.loads(json.dumps(kind).replace(old, new))
    if old == "type = 1":
        changed["claim"][key] = 3
    elif "'" in old:
        changed = json.loads(json.dumps(kind).replace(old.replace("'", '"'), new.replace("'", '"')))
    assert changed != kind
    assert alone.checked(resealed({**data, "tables": changed}))[0] == "not shown"


def test_a_changed_field_is_wrong() -> None:
    data = proof("polar coordinates")
    for path in places(data):
        changed = copy.deepcopy(data)
        inner = changed
        for key in path[:-1]:
            inner = inner[key]
        if isinstance(inner[path[-1]], str):
            inner[path[-1]] += "0"
            assert alone.checked(changed)[0] == "wrong", path


def test_a_cofactor_that_is_changed_is_wrong() -> None:
    data = proof("a double angle")
    entry = data["cases"][0]["residuals"][0]
    entry["numerator"] = {"": "1", **entry["numerator"]}
    assert alone.checked(resealed(data))[0] == "wrong"


@pytest.mark.parametrize("data", [[], {}, {"checksum": ""}, None, {"checksum": 1, "tables": []}])
def test_what_is_no_certificate_is_said_to_be_none(data: Any) -> None:
    assert alone.checked(data)[0] != "shown"


def test_a_second_case_is_not_passed_over() -> None:
    """Nothing of it would be looked at."""
    data = proof("polar coordinates")
    two = {**data, "cases": [*data["cases"], {**data["cases"][0], "residuals": []}]}
    assert alone.checked(resealed(two))[0] == "not shown"
    assert alone.checked(resealed({**data, "cases": []}))[0] == "not shown"


def test_what_titles_say_has_no_meaning() -> None:
    """A name of its own, or a letter that looks like another, may stand there, and nowhere else."""
    data = proof("a double angle")
    for key in ("title", "source"):
        tables = {
            **data["tables"],
            key: "_lhs, \u00bd \u2026",
            "claim": {**data["tables"]["claim"], key: "_rhs, \ufb01"},
        }
        assert alone.checked(resealed({**data, "tables": tables})) == ("shown", "")
    for key, text in (("lhs", "_rhs"), ("lhs", "\ufb01")):
        tables = {**data["tables"], "claim": {**data["tables"]["claim"], key: text}}
        assert alone.checked(resealed({**data, "tables": tables}))[0] == "not shown"


def test_it_needs_nothing_but_python(tmp_path: Path) -> None:
    """A copy of the file, elsewhere, by a Python that sees no packages."""
    imported = [node for node in ast.walk(ast.parse(FILE.read_text(encoding="utf-8"))) if isinstance(node, ast.Import)]
    assert {name.name.partition(".")[0] for node in imported for name in node.names} <= {*sys.stdlib_module_names}
    copied, right, wrong = tmp_path / "alone.py", tmp_path / "right.json", tmp_path / "wrong.json"
    copied.write_bytes(FILE.read_bytes())
    data = proof("a double angle")
    right.write_text(json.dumps(data), encoding="utf-8")
    wrong.write_text(json.dumps({**data, "method": "by hand"}), encoding="utf-8")
    for file, status, word in ((right, 0, "shown"), (wrong, 1, "wrong")):
        done = subprocess.run([sys.executable, "-IS", copied, file], capture_output=True, text=True, check=False)
        assert (done.returncode, done.stderr) == (status, "")
        assert word in done.stdout


def test_the_squares_behave_as_positive_numbers() -> None:
    p = alone.random_prime()
    assert all(pow(n, (p - 1) // 2, p) == 1 for n in (2, 3, 5, 7, 11, 13, 17, 19, 23))
    assert pow(p - 1, (p - 1) // 2, p) == p - 1
    assert all((p - 1) // 2 % n for n in (2, 3, 5, 7, 11, 13, 17, 19, 23))
