"""The checker in one file: what it shows, what it mustn't, and that it needs nothing but Python."""

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
    "a refutation": (MAP + "[transformation]\nQ = ['q + p**2']\nP = ['2*p']\n", "kind = 'canonical'"),
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


def forged(tables: Any, count: int = 1, **case: Any) -> tuple[str, str]:
    """The answer about a certificate that says of each residual that it is 0."""
    entry = {"numerator": {}, "denominator": {"": "1"}, "cofactors": {}}
    cases = [{"kernels": [], "residuals": [entry] * count, **case}]
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": cases}
    return alone.checked(resealed(data))


SPACE: Any = {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]}}
TURNED = {"transformation": {"Q": ["p"], "P": ["q"]}}
FORGED = {
    "a kernel by the name of the claim's own formula": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "q", "rhs": "0"}},
        {"kernels": [{"name": "_lhs", "stands for": "0"}]},
    ),
    "a kernel by the name of a coordinate": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "q", "rhs": "0"}},
        {"kernels": [{"name": "q", "stands for": "0"}]},
    ),
    "a name of this program's own": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "_rhs", "rhs": "_lhs + 1 - 1"}}, {},
    ),
    "a formula that isn't there": ({**SPACE, "claim": {"kind": "conserved", "f": "q"}}, {}),
    "a function with a name of the language": (
        {**SPACE, "symbols": {"sin": "function"}, "claim": {"kind": "identity", "lhs": "sin(q)", "rhs": "sin(q)"}}, {},
    ),
    "a definition of a coordinate": (
        {**SPACE, "definitions": {"q": "0"}, "claim": {"kind": "identity", "lhs": "q", "rhs": "0"}}, {},
    ),
    "a bracket in the old variables of new ones": (
        {**SPACE, **TURNED, "claim": {"kind": "bracket", "f": "Q", "g": "p", "equals": "0"}}, {},
    ),
    "a letter that looks like another": (
        {**SPACE, **TURNED, "claim": {"kind": "bracket", "f": "\uff31", "g": "q", "equals": "0"}}, {},
    ),
    "a key that nobody asks for": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "q", "rhs": "q", "order": "1"}}, {},
    ),
    "a function that nobody declares": ({**SPACE, "claim": {"kind": "identity", "lhs": "f(q)", "rhs": "f(q)"}}, {}),
    "a function without its arguments": (
        {**SPACE, "symbols": {"f": "function"}, "claim": {"kind": "identity", "lhs": "f*q", "rhs": "q*f"}}, {},
    ),
    "an order below 0": ({**SPACE, "claim": {"kind": "identity", "lhs": "D(q, q, -1)", "rhs": "q"}}, {}),
    "an order that is too high": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "D(exp(q), q, 999999999)", "rhs": "exp(q)"}}, {},
    ),
    "a surface": ({**SPACE, "domain": {"on": ["q - 1"]}, "claim": {"kind": "identity", "lhs": "q", "rhs": "q"}}, {}),
    "a scale that may be 0": (
        {**SPACE, "symbols": {"c": "real"}, "transformation": {"Q": ["q"], "P": ["c*p"]}, "hamiltonian": {"H": "0"},
         "claim": {"kind": "new_hamiltonian", "K": "0"}}, {"residuals": []},
    ),
    "integers in an exponent": (
        {**SPACE, "symbols": {"n": "integer"}, "claim": {"kind": "identity", "lhs": "sqrt(q**(2*n))", "rhs": "q**n"}},
        {},
    ),
    "the image of a map that is singular everywhere": (
        {**SPACE, "hamiltonian": {"H": "(p**2 + q**2)/2"}, "transformation": {"q": ["Q"], "p": ["Q"]},
         "claim": {"kind": "conserved", "f": "q*p"}}, {},
    ),
    "a map backward that is singular everywhere": (
        {**SPACE, "transformation": {"q": ["Q"], "p": ["Q"]}, "claim": {"kind": "identity", "lhs": "q", "rhs": "p"}},
        {},
    ),
    "what holds on its image, of new variables": (
        {**SPACE, "transformation": {"q": ["Q"], "p": ["Q"]},
         "claim": {"kind": "identity", "lhs": "q - p + Q", "rhs": "Q"}}, {},
    ),
    "a generating function whose Hessian is singular": (
        {**SPACE, "generating_function": {"type": 2, "F": "q"}, "claim": {"kind": "canonical"}},
        {"residuals": [None] * 2},
    ),
    "what it generates there": (
        {**SPACE, "transformation": {"q": ["0*Q"], "p": ["0*P"]},
         "claim": {"kind": "generating_function", "type": 1, "F": "q*sin(p*Q)*0 + q*0"}}, {"residuals": [None] * 2},
    ),
    "two maps backward that are singular everywhere": (
        {"phase_space": {"q": ["q", "x"], "p": ["p", "y"], "Q": ["Q", "X"], "P": ["P", "Y"]},
         "transformation": {"q": ["0*Q", "0*X"], "p": ["0*P", "0*Y"]},
         "claim": {"kind": "generating_function", "type": 1, "F": "q*x*Q"}}, {"residuals": [None] * 4},
    ),
    "a power's slope by its exponent": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "D(2**q, q)", "rhs": "0"}}, {},
    ),
    "a sine with more than its argument": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "sin(q, x=p)", "rhs": "sin(q)"}}, {},
    ),
    "a sine's slope for a sine": ({**SPACE, "claim": {"kind": "identity", "lhs": "sin[1](q)", "rhs": "sin(q)"}}, {}),
    "a kernel whose root throws points away": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "sqrt(q**2)", "rhs": "q"}},
        {"kernels": [{"name": "k", "stands for": "sqrt(q)", "relation": {"k^2": "1", "q": "-1"}}]},
    ),
    "roots of numbers, 0 modulo most primes": (
        {**SPACE, "claim": {"kind": "identity", "rhs": "0", "lhs": "*".join(
            f"(sqrt((sqrt({n}) - 1)**2) + sqrt({n}) - 1)" for n in (2, 3, 5, 7, 11))}}, {},
    ),
    "a remark": ({**SPACE, "claim": {"kind": "identity", "lhs": "q # + 1", "rhs": "q"}}, {}),
    "an order below 0, of nothing": ({**SPACE, "claim": {"kind": "identity", "lhs": "D(q, q, -1)", "rhs": "0"}}, {}),
    "half a derivative": ({**SPACE, "claim": {"kind": "identity", "lhs": "D(q, q, 1/2)", "rhs": "q"}}, {}),
    "a Hamiltonian of the claim's own": (
        {**SPACE, "hamiltonian": {"H": "p**2/2"}, "claim": {"kind": "conserved", "f": "q", "H": "0"}}, {},
    ),
    "a scale beside the Hamiltonian": (
        {**SPACE, "hamiltonian": {"H": "0", "scale": "2"}, "transformation": {"Q": ["2*q"], "P": ["p"]},
         "claim": {"kind": "canonical"}}, {},
    ),
    "a map forward and a value backward": (
        {**SPACE, "transformation": {"Q": ["q + q**2"], "P": ["p"], "q": ["0"]}, "claim": {"kind": "canonical"}}, {},
    ),
    "a type beside another file's": (
        {**SPACE, "transformation": {"Q": ["q"], "P": ["p"]}, "generating_function": {"type": 2, "F": "q*P"},
         "claim": {"kind": "generates", "type": 1}}, {"residuals": [None] * 2},
    ),
    "a generating function of the other variables": (
        {**SPACE, "transformation": {"Q": ["q"], "P": ["0*p"]},
         "claim": {"kind": "generating_function", "type": 2, "F": "q*p + q*P"}}, {"residuals": [None] * 2},
    ),
    "a function without a name": (
        {**SPACE, "symbols": {"": "function"}, "claim": {"kind": "identity", "lhs": "q.f(q)", "rhs": "p.g(q)"}}, {},
    ),
    "a section that isn't known": (
        {**SPACE, "constraints": {"on": ["q"]}, "claim": {"kind": "bracket", "f": "q", "g": "p", "equals": "1"}}, {},
    ),
    "nothing": ({**SPACE, "claim": {"kind": "involution", "functions": ["q"]}}, {"residuals": []}),
    "a sum of roots": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "sqrt((q - p)**2)", "rhs": "q - p"}}, {},
    ),
    "a root of another branch": (
        {**SPACE, "symbols": {"q": "positive"}, "claim": {"kind": "identity", "lhs": "sqrt((q-1)**2)", "rhs": "q-1"}},
        {},
    ),
    "an arc": ({**SPACE, "claim": {"kind": "identity", "lhs": "asin(sin(q))", "rhs": "q"}}, {}),
    "logarithms of what has a sign": (
        {**SPACE, "claim": {"kind": "identity", "lhs": "log(q**2)", "rhs": "2*log(q)"}}, {},
    ),
    "half of the equations": (
        {"phase_space": {"q": ["q", "x"], "p": ["p", "y"], "Q": ["Q", "X"], "P": ["P", "Y"]},
         "transformation": {"Q": ["q", "x"], "P": ["p", "7*y"]},
         "claim": {"kind": "generating_function", "type": [2], "F": "q*P"}}, {"residuals": [None] * 2},
    ),
    "another file's generating function": (
        {**SPACE, "generating_function": {"type": 2, "F": "q*P"}, "transformation": {"Q": ["q"], "P": ["p"]},
         "claim": {"kind": "generating_function", "type": 3, "F": "-p*Q + p*sin(t)"}}, {"residuals": [None] * 2},
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", FORGED)
def test_nothing_is_shown_by_a_forgery(name: str) -> None:
    tables, case = FORGED[name]
    count = len(case.pop("residuals", [None])) if "residuals" in case else 1
    assert all(forged(tables, n, **case)[0] != "shown" for n in {count, 1, 2, 3, 4, 6})


def test_of_old_variables_alone_a_map_says_nothing() -> None:
    tables = {**SPACE, "hamiltonian": {"H": "p**2 + q**2"}, "transformation": {"q": ["Q"], "p": ["Q"]}}
    assert forged({**tables, "claim": {"kind": "conserved", "f": "H"}})[0] == "not shown"
    assert forged({**tables, "claim": {"kind": "conserved", "f": "(p**2 + q**2)**2"}})[0] == "shown"


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


def test_exponents_and_numbers_are_limited() -> None:
    tables = {**SPACE, "claim": {"kind": "identity", "lhs": "q*1e999999999", "rhs": "q*1e999999999"}}
    assert forged(tables)[0] == "not shown"
    entry = {"numerator": {"q^999999999": "1"}, "denominator": {"": "1"}, "cofactors": {}}
    assert forged({**SPACE, "claim": {"kind": "identity", "lhs": "0", "rhs": "0"}}, residuals=[entry])[0] == "wrong"


def test_it_has_less_than_300_lines_of_code() -> None:
    """Lines but for empty ones, comments and docstrings, none longer than the house's."""
    text = FILE.read_text(encoding="utf-8")
    docs = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Expr)]
    said = {line for node in docs for line in range(node.lineno, (node.end_lineno or 0) + 1)
            if isinstance(node.value, ast.Constant)}  # fmt: skip
    lines = [line for number, line in enumerate(text.splitlines(), 1) if number not in said]
    assert len([line for line in lines if line.strip() and not line.strip().startswith("#")]) < 300
    assert max(map(len, lines)) <= 120


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


def test_numbers_that_are_squared_for_ever_are_not_waited_for() -> None:
    squares = {f"a{k + 1}": f"a{k}*a{k}" for k in range(60)}
    for first in ("10", "10*q"):
        tables = {**SPACE, "definitions": {"a0": first, **squares}}
        for formula in ("a60", "sin(a60)", "D(a60, q)"):
            assert forged({**tables, "claim": {"kind": "identity", "lhs": formula, "rhs": "0"}})[0] == "not shown"


@pytest.mark.parametrize(("formula", "order"), [("a{0}*sin(a{0}*q + {0})", 15), ("a{0}*p", 8), ("sin(a{0})", 2)])
def test_derivatives_of_derivatives_are_not_waited_for(formula: str, order: int) -> None:
    nested = {f"a{k + 1}": f"D({formula.format(k)}, q, {order})" for k in range(6)}
    tables = {
        **SPACE,
        "definitions": {"a0": "q*p", **nested},
        "claim": {"kind": "identity", "lhs": "a6 + 1", "rhs": "0"},
    }
    assert forged(tables)[0] == "not shown"


@pytest.mark.parametrize(
    "witness", [{"_lhs": "1"}, {"Q": "5", "P": "7"}, {"q": "q"}, {"q": "p + 1"}, {"c": "-1", "q": "1"}]
)
def test_a_witness_says_nothing_but_where(witness: Any) -> None:
    """What is true isn't refuted by naming other formulas, and -1 is no value of what is positive."""
    maps = {**SPACE, "symbols": {"c": "positive"}, "transformation": {"Q": ["q"], "P": ["p"]}}
    claims = [{"kind": "identity", "lhs": "c*Q", "rhs": "c*q"}, {"kind": "identity", "lhs": "c*q", "rhs": "q*c"},
              {"kind": "canonical"}]  # fmt: skip
    for claim in claims:
        data = {"certificate": 1, "tables": {**maps, "claim": claim}, "verdict": "refuted", "witness": witness}
        assert alone.checked(resealed({**data, "cases": []}))[0] != "shown"
