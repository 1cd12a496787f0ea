"""The small files of refutations: what they show, that no true claim is shown to be false, and that they are small."""

import json
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import mpmath
import pytest

from canon.checker import alone, counterexample, refutations
from canon.checker.counterexample import Arithmetic
from canon.checker.counterexample_functions import More, Place
from canon.checker.lie_invariants import Invariants, named, structure_of
from tests.checker.certified import certified, resealed

FOLDER = Path(counterexample.__file__).parent
FILES = (*sorted(FOLDER.glob("counterexample_*.py")), FOLDER / "refutations.py", FOLDER / "lie_invariants.py")
LINE = '[phase_space]\nq = ["q"]\np = ["p"]\n'
MAP = LINE.replace("]\np", "]\nQ = ['Q']\nP = ['P']\np")
PLANE = "[phase_space]\nq = ['x', 'y']\np = ['u', 'v']\n"
WELL = LINE + "[symbols]\nk = 'positive'\n[hamiltonian]\nH = 'p**2/2 + k**2*q**2/2'\n"
SPINS = "[phase_space]\nq = ['x', 'y', 'z']\np = ['u', 'v', 'w']\n"
TURNS = "basis = { A = 'y*w - z*v', B = 'z*u - x*w', C = 'x*v - y*u' }"
SHOWN = {
    "to an order": (
        MAP + "[symbols]\ne = 'real'\n[transformation]\nQ = ['q + e*p']\nP = ['p - e*q']\n",
        "kind = 'canonical'\norder = ['e', 2]",
    ),
    "fewer variables": (
        "[phase_space]\nq = ['x', 'y']\np = ['u', 'v']\nQ = ['r']\nP = ['s']\n"
        "[transformation]\nQ = ['x + y']\nP = ['u + v']\n",
        "kind = 'canonical'",
    ),
    "on a surface": (
        PLANE.replace("]\np", "]\nQ = ['X', 'Y']\nP = ['U', 'V']\np") + "[domain]\non = ['x*v - y*u']\n"
        "[transformation]\nQ = ['x', 'y']\nP = ['u + x*v', 'v']\n",
        "kind = 'canonical'",
    ),
    "a modulus": (MAP + "[transformation]\nQ = ['abs(q)']\nP = ['p']\n", "kind = 'canonical'"),
    "by a generating function": (
        MAP + "[hamiltonian]\nH = 'p**2/2'\n[generating_function]\ntype = 2\nF = 'q*P - P**2*t/2'\n",
        "kind = 'new_hamiltonian'\nK = 'P'",
    ),
    "a mixed Hessian of 0": (MAP + "[generating_function]\ntype = 1\nF = 'q**2 + Q**3'\n", "kind = 'canonical'"),
    "a Lie series": (LINE, "kind = 'lie_series'\ngenerator = 'p**2/2'\nparameter = 's'\nf = 'q'\nequals = 'q - s*p'"),
    "a Lie series to an order": (
        LINE, "kind = 'lie_series'\ngenerator = 'p**2/2 + q**2/2'\nparameter = 's'\nf = 'q'\norder = 2\n"
        "equals = 'q + s*p - s**2*q'"
    ),
    "a form that isn't closed": (
        MAP + "[hamiltonian]\nH = 'p**2/2'\n[transformation]\nQ = ['q - p*t']\nP = ['p']\n",
        "kind = 'cartan_invariant'\nK = 'P**2/2'",
    ),
    "beside a map given backward": (
        MAP + "[transformation]\nq = ['Q + P']\np = ['P']\n", "kind = 'identity'\nlhs = 'q'\nrhs = 'Q'"
    ),
    "a complete integral beside a map": (
        MAP + "[hamiltonian]\nH = 'p**2/2'\n[transformation]\nQ = ['q/p']\nP = ['p**2/2']\n",
        "kind = 'hamilton_jacobi'\nW = 'q*P'\nconstants = ['P']\nenergy = 'P'",
    ),
    "an integral that isn't complete": (
        LINE + "[hamiltonian]\nH = 'p**2/2'\n", "kind = 'hamilton_jacobi'\nS = 'q - t/2'\nconstants = ['a']"
    ),
    "a Lagrangian that is singular": (
        LINE + "[hamiltonian]\nH = 'q'\n", "kind = 'legendre'\nL = 'q*w - q'\nvelocities = ['w']"
    ),
    "functions that depend on each other": (LINE, "kind = 'independent'\nfunctions = ['q*p', 'exp(q*p)']"),
    "units": (LINE, "kind = 'dimension'\nfunctions = ['q*p']\ndimensions = { q = 'L', p = 'M*L/T' }\nequals = 'M*L/T'"),
    "matrices that don't compose": (
        LINE + "[symbols]\na = 'real'\nb = 'real'\n",
        "kind = 'matrix_group'\nmatrix = [['exp(a)', 0], [0, 1]]\nfirst = ['a']\nsecond = ['b']\n"
        "composition = ['a*b + a']",
    ),
    "a path": (
        LINE, "kind = 'stationary'\nL = 'w**2/2 - q**2/2'\nvelocities = ['w']\npath = ['sin(2*t)']\nfrom = 0\nto = 1"
    ),
    "a maximum that is a minimum": (
        LINE, "kind = 'stationary'\nL = 'w**2/2'\nvelocities = ['w']\npath = ['t']\nfrom = 0\nto = 1\n"
        "extremum = 'maximum'"
    ),
    "beyond a conjugate point": (
        LINE, "kind = 'stationary'\nL = 'w**2/2 - q**2/2'\nvelocities = ['w']\npath = ['sin(t)']\nfrom = 0\nto = 4\n"
        "extremum = 'minimum'"
    ),
    "a constraint that moves": (
        PLANE, "kind = 'constraint'\nvelocities = ['a', 'b']\nfunctions = ['x - t*y']\nstationary = true"
    ),
    "velocities off a constraint": (
        PLANE, "kind = 'constraint'\nvelocities = ['a', 'b']\nfunctions = ['x**2 + y**2 - 3']\npossible = ['x', 'y']"
    ),
    "a form that isn't integrable": (
        SPINS, "kind = 'constraint'\nvelocities = ['a', 'b', 'c']\nforms = ['c - y*a']\nholonomic = true"
    ),
    "an integral": (LINE, "kind = 'integral'\nf = 'exp(q)'\nvariable = 'q'\nfrom = 0\nto = 1\nequals = '171/100'"),
    "an improper integral": (
        LINE + "[symbols]\nr = 'positive'\n",
        "kind = 'integral'\nf = '1/sqrt(q*(r - q))'\nvariable = 'q'\nfrom = 0\nto = 'r'\nequals = 'pi + 1/100'",
    ),
    "an average along a motion": (
        LINE, "kind = 'average'\nf = 'q**2'\nequals = '1/3'\nparameter = 't'\nfrom = 0\nto = '2*pi'\n"
        "motion = { q = 'sin(t)', p = 'cos(t)' }"
    ),
    "an average by a virial": (
        LINE + "[hamiltonian]\nH = 'p**2/2 + q**2/2'\n",
        "kind = 'average'\nf = 'p**2'\nequals = 'p**2 + q**2'\nvirial = 'q*p/2'\nbound = '(p**2 + q**2)/2'",
    ),
    "an action": (WELL, "kind = 'action'\ncoordinate = 'q'\nenergy = 'E'\nequals = '201*pi*E/(100*k)'"),
    "a frequency": (WELL, "kind = 'frequency'\ncoordinate = 'q'\nenergy = 'E'\nequals = '101*k/(200*pi)'"),
    "an action of a rotation": (
        LINE + "[hamiltonian]\nH = 'p**2/2 + cos(q)'\n",
        "kind = 'action'\ncoordinate = 'q'\nenergy = 'E'\nbranch = 'rotation'\nequals = '2*pi*sqrt(2*E)'",
    ),
    "a relativistic action": (
        LINE + "[hamiltonian]\nH = 'sqrt(1 + p**2) + q**2/2'\n",
        "kind = 'action'\ncoordinate = 'q'\nenergy = 'E'\nequals = '2*pi*(E - 1)'",
    ),
    "an angle given backward": (
        MAP + "[symbols]\nP = 'positive'\n[hamiltonian]\nH = '(p**2 + q**2)/2'\n[transformation]\n"
        "q = ['sqrt(2*P)*sin(Q)']\np = ['sqrt(2*P)*cos(Q)']\n", "kind = 'action_angle'"
    ),
    "an angle given forward": (
        MAP + "[hamiltonian]\nH = '(p**2 + q**2)/2'\n[transformation]\nQ = ['atan2(q, p)']\nP = ['(p**2 + q**2)/2']\n",
        "kind = 'action_angle'",
    ),
    "functions that don't close": (
        PLANE, "kind = 'algebra'\nequals = 'so(3)'\nbasis = { A = 'x*u', B = 'y*x', C = 'v**2' }"
    ),
    "another algebra": (SPINS, f"kind = 'algebra'\nequals = 'sl(2,R)'\n{TURNS}"),
    "another algebra of matrices": (
        LINE, "kind = 'matrix_algebra'\nequals = 'so(3)'\n"
        "basis = { A = [[1, 0], [0, -1]], B = [[0, 1], [0, 0]], C = [[0, 0], [1, 0]] }"
    ),
    "what isn't associative": (
        LINE, "kind = 'group'\nfirst = ['a', 'b']\nsecond = ['c', 'd']\ncomposition = ['a + c', 'b + d + a**2*c']\n"
        "equals = 'u(1)^2'"
    ),
    "structure constants of a group": (
        LINE, "kind = 'group'\nfirst = ['a', 'b']\nsecond = ['c', 'd']\ncomposition = ['a + c', 'b + exp(a)*d']\n"
        "structure = { 'a,b' = 'b' }"
    ),
    "an imaginary number": (LINE, "kind = 'bracket'\nf = '(q + 1j*p)/2'\ng = '(q - 1j*p)/2'\nequals = '1j/2'"),
    "a limit": (LINE, "kind = 'limit'\nf = 'sin(2*q)/q'\nvariable = 'q'\nto = 0\nequals = 1"),
    "a limit at infinity": (
        LINE, "kind = 'limit'\nf = 'sqrt(q**2 + q) - q'\nvariable = 'q'\nto = 'infinity'\nequals = 0"
    ),
    "a normal form": (
        LINE + "[hamiltonian]\nH = 'p**2/2 + 1 - cos(q)'\n", "kind = 'normal_form'\norder = 4\n"
        "N = { 4 = '-(p**2 + q**2)**2/65' }"
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", SHOWN)
def test_it_shows_what_is_refuted(name: str) -> None:
    data = certified(*SHOWN[name])
    assert data["verdict"] == "refuted"
    assert counterexample.checked(data)[0] == "not shown"
    assert refutations.checked(data) == ("shown", "")
    assert refutations.checked({**data, "method": "by hand"})[0] == "wrong"


@pytest.mark.parametrize("name", ["a normal form", "to an order", "on a surface"])
def test_what_a_file_says_to_people_means_nothing(name: str) -> None:
    text, claim = SHOWN[name]
    words = "title = 'D(F) = 1j'\nsource = 'bracket(q, p)'\n"
    data = certified(words + text, f"{claim}\n{words}expect = 'fails'\nbudget = 5")
    assert data["tables"]["claim"]["expect"] == "fails"
    assert refutations.checked(data) == ("shown", "")


def answer(claim: Any, witness: Any, known: Any = None, **tables: Any) -> str:
    """The answer about a certificate that refutes a claim."""
    tables = {"phase_space": {"q": ["q"], "p": ["p"]}, **tables, "claim": claim}
    data = {
        "certificate": 1,
        "tables": tables,
        "known": known or {},
        "verdict": "refuted",
        "witness": witness,
        "cases": [],
    }
    return refutations.checked(resealed(data))[0]


SPACE = {"q": ["x", "y", "z"], "p": ["u", "v", "w"]}
NEW = {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]}
ROUND = {"q": ["sqrt(2*P)*sin(Q)"], "p": ["sqrt(2*P)*cos(Q)"]}
LIFT = {"Q": ["x", "y", "z"], "P": ["u", "v", "w"]}
TRUE: dict[str, tuple[Any, Any, Any]] = {
    "an action": ({"kind": "action", "coordinate": "q", "energy": "E", "equals": "2*pi*E"},
        {"hamiltonian": {"H": "(p**2 + q**2)/2"}}, {"E": "3/2"}),
    "an action of the well that is meant": (
        {"kind": "action", "coordinate": "q", "energy": "E", "fixed": {"E": "(s**2 - 1)/4"},
         "equals": "2*sqrt(2 + 2*s)/3*(elliptic_e(2*s/(1 + s)) - (1 - s)*elliptic_k(2*s/(1 + s)))"},
        {"hamiltonian": {"H": "p**2/2 - q**2/2 + q**4/4"}, "symbols": {"q": "positive", "s": "real"},
         "domain": {"where": ["0 < s < 1"]}}, {"s": "9/16"}),
    "where the domain cuts the orbit": ({"kind": "action", "coordinate": "q", "energy": "E", "equals": "7"},
        {"hamiltonian": {"H": "(p**2 + q**2)/2"}, "domain": {"where": ["q < 1/10"]}}, {"E": "3/2"}),
    "where a momentum has a sign": ({"kind": "action", "coordinate": "q", "energy": "E", "equals": "7"},
        {"hamiltonian": {"H": "(p**2 + q**2)/2"}, "symbols": {"p": "positive"}}, {"E": "3/2"}),
    "a motion that leads away": ({"kind": "action", "coordinate": "q", "energy": "E", "equals": "7"},
        {"hamiltonian": {"H": "p**2/2 - q"}}, {"E": "3/2"}),
    "a frequency": ({"kind": "frequency", "coordinate": "q", "energy": "E", "equals": "1/(2*pi)"},
        {"hamiltonian": {"H": "(p**2 + q**2)/2"}}, {"E": "3/2"}),
    "a rotation over half of 2 pi": ({"kind": "action", "coordinate": "q", "energy": "E", "branch": "rotation",
        "equals": "2*sqrt(2*(E + 1))*elliptic_e(2/(E + 1))"}, {"hamiltonian": {"H": "p**2/2 + cos(2*q)"}}, {"E": "5"}),
    "a rotation over what is no period of H": ({"kind": "action", "coordinate": "q", "energy": "E", "equals": "1",
        "branch": "rotation", "period": "3"}, {"hamiltonian": {"H": "p**2/2 - cos(q)"}}, {"E": "5"}),
    "a rotation over nearly a period of H": ({"kind": "action", "coordinate": "q", "energy": "E", "equals": "1",
        "branch": "rotation", "period": "2*pi + 1/10**80"}, {"hamiltonian": {"H": "p**2/2 - cos(q)"}}, {"E": "5"}),
    "a rotation over a period of H at some values": ({"kind": "action", "coordinate": "q", "energy": "E", "equals": "1",
        "branch": "rotation", "period": "2*pi*a"}, {"symbols": {"a": "real"}, "hamiltonian": {"H": "p**2/2 - cos(q)"}},
        {"E": "5", "a": "2"}),
    "an integral": ({"kind": "integral", "f": "exp(q)", "variable": "q", "from": "0", "to": "1",
        "equals": "exp(1) - 1"}, {}, {}),
    "an integral outside of its domain": ({"kind": "integral", "f": "sqrt(q**2)", "variable": "q", "from": "a",
        "to": "1", "equals": "(1 - a**2)/2"}, {"symbols": {"q": "positive", "a": "real"}}, {"a": "-1"}),
    "an integral whose range runs downwards": ({"kind": "integral", "f": "sqrt(q**2)", "variable": "q", "from": "0",
        "to": "a", "equals": "a**2/2"}, {"symbols": {"a": "real"}}, {"a": "-1"}),
    "an improper integral": ({"kind": "integral", "f": "1/sqrt(q*(1 - q))", "variable": "q", "from": "0", "to": "1",
        "equals": "pi"}, {}, {}),
    "an improper integral of a root's powers": (
        {"kind": "integral", "f": "u*u*u*q**(3/5)", "variable": "q", "from": "0", "to": "1", "equals": "10"},
        {"definitions": {"u": "1/sqrt(q)"}}, {}),
    "an average": ({"kind": "average", "f": "q**2", "equals": "1/2", "parameter": "t", "from": "0", "to": "2*pi",
        "motion": {"q": "sin(t)", "p": "cos(t)"}}, {}, {}),
    "a virial of motions that end": ({"kind": "average", "f": "p**2", "equals": "7", "virial": "q*p", "bound": "9"},
        {"hamiltonian": {"H": "p**2/2 - q**4"}}, {"q": "1", "p": "1"}),
    "a minimum": ({"kind": "stationary", "L": "w**2/2 - q**2/2", "velocities": ["w"], "path": ["sin(t)"], "from": "0",
        "to": "3", "extremum": "minimum"}, {}, {"t": "1"}),
    "a path that leaves the domain": ({"kind": "stationary", "L": "w**2/2 - sqrt(q**2)", "velocities": ["w"],
        "path": ["a - t**2/2"], "from": "0", "to": "1"}, {"symbols": {"a": "positive"}}, {"a": "1/4", "t": "9/10"}),
    "a path beside a condition": ({"kind": "stationary", "L": "w**2/2 - sqrt(q**2)", "velocities": ["w"],
        "path": ["a - t**2/2"], "from": "0", "to": "1"}, {"symbols": {"a": "real"}, "domain": {"where": ["q > 0"]}},
        {"a": "-1", "t": "1/2", "q": "1"}),
    "a path before it begins": ({"kind": "stationary", "L": "w**2/2 - sqrt(q**2)", "velocities": ["w"],
        "path": ["2 - t**2/2"], "from": "0", "to": "1"}, {}, {"t": "3"}),
    "a map to the first order": ({"kind": "canonical", "order": ["e", 1]}, {"phase_space": NEW,
        "symbols": {"e": "real"}, "transformation": {"Q": ["q + e*p"], "P": ["p - e*q"]}},
        {"q": "1", "p": "2", "e": "1"}),
    "a map on a surface": ({"kind": "canonical"}, {"phase_space": SPACE | {"Q": ["X", "Y", "Z"], "P": ["U", "V", "W"]},
        "domain": {"on": ["x"]}, "transformation": LIFT | {"P": ["u + x**2", "v", "w"]}},
        {"x": "1", "y": "1", "z": "1", "u": "2", "v": "3", "w": "1"}),
    "a generating function": ({"kind": "new_hamiltonian", "K": "P**2/2 - 1/2*P**2"}, {"phase_space": NEW,
        "hamiltonian": {"H": "p**2/2"}, "generating_function": {"type": 2, "F": "q*P - P**2*t/2"}},
        {"q": "1", "P": "2"}),
    "a Hessian that isn't 0": ({"kind": "canonical"}, {"phase_space": NEW, "generating_function": {
        "type": 1, "F": "q*Q"}}, None),
    "a Hessian that is 0 here": ({"kind": "canonical"}, {"phase_space": NEW, "generating_function": {
        "type": 1, "F": "q**2*Q"}}, None),
    "independent functions": ({"kind": "independent", "functions": ["q", "exp(p)*q"]}, {}, None),
    "a Lie series": ({"kind": "lie_series", "generator": "p**2/2", "parameter": "s", "f": "q", "equals": "q + s*p"}, {},
        {"q": "1", "p": "2", "s": "1"}),
    "a dimension": ({"kind": "dimension", "functions": ["log(q/p)"], "dimensions": {"q": "L", "p": "L"}, "equals": "1"},
        {"symbols": {"q": "positive", "p": "positive"}}, {"q": "1", "p": "2"}),
    "a group where it is real": ({"kind": "matrix_group", "matrix": [["sqrt(a**2)"]], "first": ["a"], "second": ["b"],
        "composition": ["a*b"]}, {"symbols": {"a": "positive", "b": "real"}}, {"a": "1", "b": "-2"}),
    "a group beside a condition": ({"kind": "matrix_group", "matrix": [["a + sqrt((a - 3)**2)"]], "first": ["a"],
        "second": ["b"], "composition": ["a + b"]}, {"symbols": {"a": "real", "b": "real"}, "domain": {
        "where": ["a < 0"]}}, {"a": "-1", "b": "9"}),
    "an angle": ({"kind": "action_angle", "angle_period": "2*pi"}, {"phase_space": NEW, "symbols": {"P": "positive"},
        "hamiltonian": {"H": "(p**2 + q**2)/2"}, "transformation": ROUND}, {"Q": "1", "P": "2"}),
    "an angle given forward": ({"kind": "action_angle", "angle_period": "2*pi"}, {"phase_space": NEW,
        "hamiltonian": {"H": "(p**2 + q**2)/2"}, "transformation": {"Q": ["atan2(q, p)"], "P": ["(p**2 + q**2)/2"]}},
        {"q": "1", "p": "2"}),
    "an angle that turns": ({"kind": "action_angle", "angle_period": "1"}, {"phase_space": NEW,
        "hamiltonian": {"H": "p**2/2"}, "transformation": {"q": ["2*pi*Q"], "p": ["P/(2*pi)"]}}, {"Q": "1", "P": "2"}),
    "an algebra": ({"kind": "algebra", "equals": "so(3)", "basis": {"A": "y*w - z*v", "B": "z*u - x*w",
        "C": "x*v - y*u"}}, {"phase_space": SPACE}, {"x": "1", "y": "2", "z": "3", "u": "1", "v": "-1", "w": "2"}),
    "an algebra of another basis": ({"kind": "matrix_algebra", "equals": "sl(2,R)", "basis": {
        "A": [["1/2", "0"], ["0", "-1/2"]], "B": [["0", "1"], ["0", "0"]], "C": [["0", "0"], ["3", "0"]]}}, {}, None),
    "Pauli's matrices": ({"kind": "matrix_algebra", "structure": {"A,B": "2*C", "B,C": "2*A", "C,A": "2*B"}, "basis": {
        "A": [["0", "1"], ["1", "0"]], "B": [["0", "-1j"], ["1j", "0"]], "C": [["1", "0"], ["0", "-1"]]}}, {}, None),
    "a group": ({"kind": "group", "first": ["a", "b"], "second": ["c", "d"], "composition": ["a + c", "b + exp(a)*d"],
        "structure": {"a,b": "-b"}}, {}, None),
    "a complex bracket": ({"kind": "bracket", "f": "(q + 1j*p)/sqrt(2)", "g": "(q - 1j*p)/sqrt(2)",
        "equals": "-1j"}, {}, {"q": "1", "p": "2"}),
    "Euler's formula": ({"kind": "identity", "lhs": "exp(1j*q)**2", "rhs": "cos(2*q) + 1j*sin(2*q)"}, {},
        {"q": "1", "p": "2"}),
    "a limit": ({"kind": "limit", "f": "(1 - cos(q))/q**2", "variable": "q", "to": "0", "equals": "1/2"}, {}, {}),
    "a limit at infinity": ({"kind": "limit", "f": "(1 + 1/q)**q", "variable": "q", "to": "infinity",
        "equals": "exp(1)"}, {}, {}),
    "a limit from one side": ({"kind": "limit", "f": "abs(q)/q", "variable": "q", "to": "0", "side": "+",
        "equals": "1"}, {}, {}),
    "a limit of a positive name": ({"kind": "limit", "f": "sqrt(q**2)/q", "variable": "q", "to": "0", "side": "+",
        "equals": "1"}, {"symbols": {"q": "positive"}}, {}),
    "a normal form": ({"kind": "normal_form", "order": 4, "N": {"4": "-(p**2 + q**2)**2/64"}},
        {"hamiltonian": {"H": "p**2/2 + 1 - cos(q)"}}, None),
    "one of several normal forms": ({"kind": "normal_form", "order": 3, "N": {"3": "0"}},
        {"hamiltonian": {"H": "(p**2 + q**2)/2 + q**3"}}, None),
    "velocities on a constraint": ({"kind": "constraint", "velocities": ["a", "b", "c"], "functions": [
        "x**2 + y**2 - 1"],
        "possible": ["y", "-x", "7*(x**2 + y**2 - 1)"]}, {"phase_space": SPACE}, {"x": "3/5", "y": "4/5", "z": "1"}),
    "velocities beside a constraint": ({"kind": "constraint", "velocities": ["a", "b", "c"], "functions": [
        "x**2 + y**2 - 1"], "possible": ["x*(x**2 + y**2 - 1)", "0", "0"]}, {"phase_space": SPACE},
        {"x": "1", "y": "1", "z": "1"}),
    "a form that is integrable": ({"kind": "constraint", "velocities": ["a", "b", "c"], "forms": ["y*a + x*b"],
        "holonomic": True}, {"phase_space": SPACE}, {"x": "1", "y": "1", "z": "1"}),
    "a closed form": ({"kind": "cartan_invariant", "K": "0"}, {"phase_space": NEW, "hamiltonian": {"H": "p**2/2"},
        "transformation": {"Q": ["q - p*t"], "P": ["p"]}}, {"q": "1", "p": "2", "t": "3"}),
    "an elliptic identity": ({"kind": "identity", "lhs": "jacobi_dn(q, 1/3)**2 + jacobi_sn(q, 1/3)**2/3", "rhs": "1"},
        {}, {"q": "1", "p": "2"}),
    "Legendre's relation": ({"kind": "identity", "lhs":
        "elliptic_e(1/3)*elliptic_k(2/3) + elliptic_e(2/3)*elliptic_k(1/3) - elliptic_k(1/3)*elliptic_k(2/3)",
        "rhs": "pi/2"}, {}, {"q": "1", "p": "2"}),
}  # fmt: skip


@pytest.mark.parametrize(("H", "period"), [("p**2/2 - cos(q)", "4*pi"), ("p**2/2", "3")])
def test_a_rotation_over_a_period_of_the_hamiltonian_is_refuted(H: str, period: str) -> None:
    """Where H doesn't depend on the coordinate any length is one."""
    claim = {"kind": "action", "coordinate": "q", "energy": "E", "equals": "1", "branch": "rotation", "period": period}
    assert answer(claim, {"E": "5"}, hamiltonian={"H": H}) == "shown"


@pytest.mark.parametrize("name", TRUE)
def test_no_true_claim_is_shown_to_be_false(name: str) -> None:
    """At a point that seems to refute it, at others, and without one; what the claim doesn't say may be anything."""
    claim, tables, witness = TRUE[name]
    other = dict.fromkeys(("q", "p", "Q", "P", "t", "a", "b", "E", "e", "x", "y", "u", "z"), "1/3")
    for at in (witness, None, other):
        assert answer(claim, at, **tables) != "shown"


def test_structure_constants_of_a_certificate_have_to_be_linear_and_right() -> None:
    claim = {"kind": "algebra", "equals": "so(3)", "basis": {"A": "y*w - z*v", "B": "z*u - x*w", "C": "x*v - y*u"}}
    for c in ("-C", "C + A*B - A*B", "0", "C*(1 + A - A)", "2*C"):
        known = {"structure": {"A,B": c, "B,C": "A", "A,C": "-B"}}
        assert answer(claim, None, known, phase_space=SPACE) == "not shown"
    known = {"structure": {"A,B": "C", "B,C": "A", "A,C": "-B"}}
    assert answer({**claim, "equals": "e(2)"}, None, known, phase_space=SPACE) == "shown"


@pytest.mark.parametrize(
    ("one", "other"), [("so(4)", "so(3) + so(3)"), ("so(2,1)", "sl(2,R)"), ("so(3,1)", "so(1,3)"), ("e(3)", "iso(3)")]
)
def test_isomorphic_algebras_have_the_same_invariants(one: str, other: str) -> None:
    assert named(one) == named(other)


def test_algebras_that_differ_have_other_invariants() -> None:
    names = ("so(4)", "so(3,1)", "so(2,2)", "e(3)", "iso(2,1)", "so(3) + u(1)^3", "u(1)^6")
    assert len({named(name) for name in names}) == len(names)
    sl = [[[(Fraction(x), Fraction(0)) for x in row] for row in a]
          for a in ([[1, 0], [0, -1]], [[0, 1], [0, 0]], [[0, 0], [1, 0]])]  # fmt: skip
    assert Invariants.of(structure_of(sl)) == named("sl(2,R)") != named("so(3)")


FUNCTIONS = {
    "elliptic_k": lambda u, m: mpmath.ellipk(m), "elliptic_f": mpmath.ellipf, "elliptic_e": mpmath.ellipe,
    "elliptic_pi": lambda u, m: mpmath.ellippi(mpmath.mpf(1) / 3, u, m),
    **{f"jacobi_{k}": lambda u, m, k=k: mpmath.ellipfun(k, u, m=m) for k in ("sn", "cn", "dn")},
}  # fmt: skip


@pytest.mark.parametrize("m", [Fraction(1, 7), Fraction(4, 5)])
@pytest.mark.parametrize("name", FUNCTIONS)
def test_values_and_slopes_of_special_functions_are_those_of_mpmath(name: str, m: Fraction) -> None:
    tables = {"phase_space": {"q": ["q"], "p": ["p"]}, "claim": {"kind": "identity", "lhs": "q", "rhs": "p"}}
    claim, u, f = More(tables), Fraction(4, 5), FUNCTIONS[name]
    text = {"elliptic_k": "elliptic_k(p)", "elliptic_pi": "elliptic_pi(1/3, q, p)"}.get(name, f"{name}(q, p)")
    point = Place(claim, {"q": (u, u), "p": (m, m)}, Arithmetic(64))
    with mpmath.workdps(30):
        x, y = (mpmath.mpf(value.numerator) / value.denominator for value in (u, m))
        ways = [(point.at(claim.read(text)), f(x, y))]
        if name != "elliptic_pi":
            ways.append((point.at(claim.read(text), "q"), mpmath.diff(lambda z: f(z, y), x)))
            ways.append((point.at(claim.read(text), "p"), mpmath.diff(lambda z: f(x, z), y)))
        for (low, high), value in ways:
            near = Fraction(str(mpmath.nstr(value, 20)))
            assert low - Fraction(1, 10**12) <= near <= high + Fraction(1, 10**12)
            assert high - low < Fraction(1, 10**5)


def test_it_runs_where_canon_is_not_installed(tmp_path: Path) -> None:
    for file in (*FILES, *FOLDER.glob("alone*"), *FOLDER.glob("counterexample*")):
        if file.is_file():
            (tmp_path / file.name).write_bytes(file.read_bytes())
    command = [sys.executable, "-ES", "refutations.py", "c.json"]
    for name, change, status, word in (("a limit", {}, 0, "shown"), ("a limit", {"method": "by hand"}, 1, "wrong")):
        data = {**certified(*SHOWN[name]), **change}
        (tmp_path / "c.json").write_text(json.dumps(data), encoding="utf-8")
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
        assert (done.returncode, done.stderr) == (status, "")
        assert f": {word}" in done.stdout


def test_proofs_are_left_to_the_other_files() -> None:
    data = certified(LINE, "kind = 'limit'\nf = 'sin(q)/q'\nvariable = 'q'\nto = 0\nequals = 1")
    assert data["verdict"] == "proved"
    assert refutations.checked(data)[0] == "not shown"
    assert alone.checked(data)[0] == "not shown"
