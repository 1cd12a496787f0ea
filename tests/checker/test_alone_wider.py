"""Kinds of claims by the table of the small checker: what is shown of each, near misses, and what says nothing."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from canon.checker import alone, alone_wider
from tests.checker.certified import certified, resealed

LINE = '[phase_space]\nq = ["q"]\np = ["p"]\n'
PLANE = '[phase_space]\nq = ["x", "y"]\np = ["px", "py"]\n'
MAP = LINE.replace("]\np", "]\nQ = ['Q']\nP = ['P']\np")
TWO = PLANE.replace("]\np =", "]\nQ = ['X', 'Y']\nP = ['A', 'B']\np =")
SPRING = "[symbols]\nm = 'positive'\nk = 'positive'\n"
SPIN = (
    '[phase_space]\nq = ["x", "y", "z"]\np = ["u", "v", "w"]\n',
    "[claim.structure]\n'x,y' = 'z'\n'y,z' = 'x'\n'z,x' = 'y'",
)
TURN = "matrix = [['cos(a)', 'sin(a)'], ['-sin(a)', 'cos(a)']]\nfirst = ['a']\nsecond = ['b']\ncomposition = ['a + b']"
SHOWN = {
    "Lagrange's equations": (
        LINE + SPRING,
        "kind = 'euler_lagrange'\nL = 'm*v**2/2 - k*q**2/2'\nvelocities = ['v']\naccelerations = ['a']\n"
        "equations = ['m*a + k*q']",
    ),
    "accelerations": (
        LINE + SPRING,
        "kind = 'euler_lagrange'\nL = 'm*v**2/2 - k*q**2/2'\nvelocities = ['v']\nqddot = ['-k*q/m']",
    ),
    "friction and a force": (
        LINE + SPRING,
        "kind = 'euler_lagrange'\nL = 'm*v**2/2'\nvelocities = ['v']\nqddot = ['(sin(t) - k*v)/m']\n"
        "dissipation = 'k*v**2/2'\nforces = ['sin(t)']",
    ),
    "a symmetry and its charge": (
        PLANE + "[symbols]\nV = 'function'\n",
        "kind = 'noether'\nL = '(a**2 + b**2)/2 - V(x**2 + y**2)'\nvelocities = ['a', 'b']\ndq = ['-y', 'x']\n"
        "charge = 'x*b - y*a'",
    ),
    "a shift of time": (
        LINE + SPRING,
        "kind = 'noether'\nL = 'm*v**2/2 - k*q**2/2'\nvelocities = ['v']\ndq = ['0']\ndt = '1'\n"
        "charge = '-m*v**2/2 - k*q**2/2'",
    ),
    "a boost": (
        LINE + SPRING,
        "kind = 'noether'\nL = 'm*v**2/2'\nvelocities = ['v']\ndq = ['t']\nf = 'm*q'",
    ),
    "Legendre's transform": (
        LINE + SPRING + "[hamiltonian]\nH = 'p**2/(2*m) + k*cos(q)'\n",
        "kind = 'legendre'\nL = 'm*v**2/2 - k*cos(q)'\nvelocities = ['v']",
    ),
    "a complete integral": (
        LINE + "[symbols]\nm = 'positive'\n[hamiltonian]\nH = 'p**2/(2*m)'\n",
        "kind = 'hamilton_jacobi'\nS = 'a*q - a**2*t/(2*m)'\nconstants = ['a']",
    ),
    "one at constant energy": (
        LINE + "[symbols]\nm = 'positive'\ng = 'positive'\n[hamiltonian]\nH = 'p**2/(2*m) + m*g*q'\n",
        "kind = 'hamilton_jacobi'\nW = '-(2*m*(a - m*g*q))**(3/2)/(3*m**2*g)'\nconstants = ['a']\nenergy = 'a'",
    ),
    "a rotation's series": (
        LINE,
        "kind = 'lie_series'\ngenerator = '(p**2 + q**2)/2'\nparameter = 's'\nf = 'q'\nequals = 'q*cos(s) + p*sin(s)'",
    ),
    "a solution": (
        LINE + SPRING + "X = 'function'\nc = 'real'\n",
        "kind = 'solves'\nequations = ['m*D(X(t), t, 2) + k*X(t)', 'X(0) - c']\n"
        "[claim.solution]\n'X(t)' = 'c*cos(sqrt(k/m)*t)'",
    ),
    "volume": (
        MAP + "[transformation]\nQ = ['q + sin(p)']\nP = ['-p']\n",
        "kind = 'volume'",
    ),
    "Poincare's invariant": (
        TWO + "[transformation]\nQ = ['x + sin(px)', 'y']\nP = ['px', 'py + y**2']\n",
        "kind = 'integral_invariant'",
    ),
    "that of fourth order": (
        TWO + "[transformation]\nQ = ['2*x', 'y/2']\nP = ['px', 'py']\n",
        "kind = 'integral_invariant'\norder = 2",
    ),
    "a symmetry": (
        MAP + "[hamiltonian]\nH = '(p**2 + q**2)/2'\n[transformation]\nQ = ['p']\nP = ['-q']\n",
        "kind = 'symmetry'",
    ),
    "a scale of parameters": (
        MAP + SPRING + "[transformation]\nQ = ['m*q']\nP = ['k*p']\n",
        "kind = 'canonical'\nscale = 'm*k'",
    ),
    "an identity of old and new variables": (
        MAP + "[transformation]\nq = ['exp(Q)']\np = ['P*exp(-Q)']\n",
        "kind = 'identity'\nlhs = 'q*p + sin(Q)'\nrhs = 'P + sin(Q)'",
    ),
    "a field that has a Hamiltonian": (
        LINE,
        "kind = 'hamiltonian_field'\nqdot = ['p*cos(q)']\npdot = ['p**2*sin(q)/2']",
    ),
    "dimensions": (
        LINE + SPRING,
        "kind = 'dimension'\nfunctions = ['sqrt(m/k)']\nequals = 'T'\n[claim.dimensions]\nm = 'M'\nk = 'M/T**2'",
    ),
    "an interval": (
        "[symbols]\na = 'real'\n",
        "kind = 'invariant_interval'\nmatrix = [['cosh(a)', 'sinh(a)'], ['sinh(a)', 'cosh(a)']]\n"
        "metric = [[1, 0], [0, -1]]\ninverse = [['cosh(a)', '-sinh(a)'], ['-sinh(a)', 'cosh(a)']]",
    ),
    "rotations": ("[symbols]\na = 'real'\nb = 'real'\n", f"kind = 'matrix_group'\n{TURN}\ninverse = ['-a']"),
    "a Casimir function": (SPIN[0], f"kind = 'casimir'\nf = 'x**2 + y**2 + z**2'\n{SPIN[1]}"),
    "a bracket of spins": (SPIN[0], f"kind = 'bracket'\nf = 'x**2'\ng = 'y'\nequals = '2*x*z'\n{SPIN[1]}"),
}  # fmt: skip


def proof(name: str) -> Any:
    return certified(*SHOWN[name])


@pytest.mark.parametrize("name", SHOWN)
def test_it_shows_what_the_table_defines(name: str) -> None:
    assert alone.checked(proof(name))[0] == "not shown"
    assert alone_wider.checked(proof(name)) == ("shown", "")


def forged(tables: Any, *kernels: Any) -> tuple[str, str]:
    """The answer about a certificate that says of each residual that it is 0."""
    try:
        count = len(alone_wider.Wider(tables).zeros)
    except Exception:  # whatever the checker says of them
        count = 1
    entry = {"numerator": {}, "denominator": {"": "1"}, "cofactors": {}}
    cases = [{"kernels": [*kernels], "residuals": [entry] * count}]
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": cases}
    return alone_wider.checked(resealed(data))


MISSES = {
    "Lagrange's equations": [("m*a + k*q", "m*a - k*q"), ("m*a + k*q", "m*a + 1001/1000*k*q")],
    "accelerations": [("-k*q/m", "k*q/m"), ("-k*q/m", "-1001/1000*k*q/m")],
    "friction and a force": [("- k*v", "+ k*v"), ("k*v**2/2", "1001/1000*k*v**2/2"), ('"sin(t)"', '"0"')],
    "a symmetry and its charge": [("x*b - y*a", "x*b + y*a"), ('"-y"', '"y"'), ("x*b", "1001/1000*x*b")],
    "a shift of time": [("-m*v**2/2 -", "m*v**2/2 -"), ('"dt": "1"', '"dt": "1001/1000"')],
    "a boost": [('"m*q"', '"-m*q"'), ('"m*q"', '"1001/1000*m*q"')],
    "Legendre's transform": [("+ k*cos", "- k*cos"), ("p**2/(2*m)", "1001/1000*p**2/(2*m)")],
    "a complete integral": [("- a**2*t", "+ a**2*t"), ("a**2*t/(2*m)", "a**2*t/(2001/1000*m)")],
    "one at constant energy": [("+ m*g*q", "- m*g*q"), ('"energy": "a"', '"energy": "1001/1000*a"')],
    "a rotation's series": [("+ p*sin(s)", "- p*sin(s)"), ("cos(s)", "cos(1001/1000*s)"), ("p*sin(s)", "p*sin(s) + s")],
    "a solution": [("+ k*X(t)", "- k*X(t)"), ("sqrt(k/m)", "1001/1000*sqrt(k/m)"), ("X(0) - c", "X(0) - 2*c")],
    "volume": [('"-p"', '"-1001/1000*p"'), ('"-p"', '"0*p"')],
    "Poincare's invariant": [('"px"]', '"px"]'), ("sin(px)", "sin(py)"), ("py + y**2", "py + x**2")],
    "that of fourth order": [("y/2", "y/3"), ('"order": 2', '"order": 1')],
    "a symmetry": [("p**2 + q**2", "p**2 + 1001/1000*q**2"), ('"-q"', '"-q + 1"')],
    "a scale of parameters": [('"m*k"', '"-m*k"'), ('"m*k"', '"1001/1000*m*k"'), ('"m*k"', '"m"')],
    "an identity of old and new variables": [("= P", "= -P"), ('"P + ', '"1001/1000*P + '), ("exp(-Q)", "exp(Q)")],
    "a field that has a Hamiltonian": [("sin(q)/2", "sin(q)/3"), ('"p**2*', '"-p**2*')],
    "dimensions": [('"equals": "T"', '"equals": "T**2"'), ("M/T**2", "M/T")],
    "an interval": [('"-sinh(a)"', '"sinh(a)"'), ('"metric": [[1', '"metric": [[2'), ("cosh(a)", "cosh(1001/1000*a)")],
    "rotations": [('"a + b"', '"a - b"'), ('"a + b"', '"a + 1001/1000*b"'), ('"inverse": ["-a"]', '"inverse": ["a"]')],
    "a Casimir function": [("+ z**2", "- z**2"), ("+ z**2", "+ 1001/1000*z**2"), ('"x,y": "z"', '"x,y": "2*z"')],
    "a bracket of spins": [("2*x*z", "-2*x*z"), ("2*x*z", "2001/1000*x*z")],
}  # fmt: skip


@pytest.mark.parametrize("name", MISSES)
def test_a_near_miss_is_not_shown(name: str) -> None:
    """Neither by the true claim's certificate, nor by one that says of each residual that it is 0."""
    data = proof(name)
    assert forged(data["tables"]) == ("shown", "")
    text = json.dumps(data["tables"])
    for old, new in MISSES[name]:
        changed = json.loads(text.replace(old, new))
        if changed != data["tables"]:
            assert forged(changed)[0] == "not shown", (old, new)
            assert alone_wider.checked(resealed({**data, "tables": changed}))[0] != "shown", (old, new)


SPACE: Any = {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]}}
BOTH: Any = {"phase_space": {"q": ["q", "x"], "p": ["p", "y"]}}
FREE: Any = {"kind": "euler_lagrange", "velocities": ["v"]}
NOTHING: dict[str, Any] = {
    "a Hessian that is 0": {**SPACE, "claim": {**FREE, "L": "q*v", "qddot": ["5"]}},
    "a mass that may be 0": {
        **SPACE, "symbols": {"a": "real"}, "claim": {**FREE, "L": "a*v**2/2", "qddot": ["0"]},
    },
    "a mass that is an arbitrary function": {
        **SPACE, "symbols": {"a": "function"}, "claim": {**FREE, "L": "a(t)*v**2/2", "qddot": ["-D(a(t), t)*v/a(t)"]},
    },
    "a Hessian that is 0, said otherwise": {
        **SPACE, "claim": {**FREE, "L": "(exp(1/(2*q + 2*t)) - exp(1/(2*(q + t))))*v**2/2", "qddot": ["0"]},
    },
    "a Hessian that is 0 on a half": {
        **SPACE, "claim": {**FREE, "L": "(sqrt(q**2) + q)*v**2/2", "qddot": ["-v**2/(2*q)"]},
    },
    "a Hessian that is 0, as a logarithm of a product": {
        **SPACE, "symbols": {"q": "positive"}, "claim": {**FREE, "L": "(log(q**2) - 2*log(q))*v**2/2", "qddot": ["0"]},
    },
    "accelerations in L": {
        **SPACE, "claim": {**FREE, "L": "v**2/2 + a", "accelerations": ["a"], "equations": ["a"]},
    },
    "velocities that are coordinates": {**SPACE, "claim": {**FREE, "velocities": ["q"], "L": "q", "equations": ["-1"]}},
    "velocities that are defined": {
        **SPACE, "definitions": {"v": "0"}, "claim": {**FREE, "L": "v", "equations": ["0"]},
    },
    "velocities that are no names": {
        **SPACE, "claim": {**FREE, "velocities": ["0*(q)"], "L": "0", "equations": ["0"]},
    },
    "one velocity for two coordinates": {**BOTH, "claim": {**FREE, "L": "v**2/2", "qddot": ["0", "0"]}},
    "one equation for two coordinates": {
        **BOTH, "claim": {**FREE, "velocities": ["v", "w"], "L": "v**2/2 + w**2*x", "equations": ["0"]},
    },
    "new variables in L": {**SPACE, "claim": {**FREE, "L": "Q*v", "equations": ["0"]}},
    "a key that nobody asks for": {
        **SPACE, "claim": {**FREE, "L": "0*v", "equations": ["0"], "order": 1},
    },
    "a momentum in the integral": {
        **SPACE, "hamiltonian": {"H": "p**2/2"},
        "claim": {"kind": "hamilton_jacobi", "S": "a*q - a**2*t/2 + p", "constants": ["a"]},
    },
    "an integral without its constant": {
        **SPACE, "hamiltonian": {"H": "p**2/2"},
        "claim": {"kind": "hamilton_jacobi", "S": "q - t/2", "constants": ["a"]},
    },
    "a constant of the Hamiltonian": {
        **SPACE, "hamiltonian": {"H": "p**2/2 - a**2/2"},
        "claim": {"kind": "hamilton_jacobi", "S": "a*q", "constants": ["a"]},
    },
    "more constants than coordinates": {
        **BOTH, "hamiltonian": {"H": "p + y"},
        "claim": {"kind": "hamilton_jacobi", "W": "a*q + b*x + c*(q - x)", "constants": ["a", "b", "c"],
                  "energy": "a + b"},
    },
    "an energy of coordinates": {
        **SPACE, "hamiltonian": {"H": "p**2/2"},
        "claim": {"kind": "hamilton_jacobi", "W": "a*q**2", "constants": ["a"], "energy": "2*a**2*q**2"},
    },
    "a Hamiltonian that isn't there": {
        **SPACE, "symbols": {"H": "real"},
        "claim": {"kind": "hamilton_jacobi", "W": "0*q", "constants": ["a"], "energy": "H"},
    },
    "a momentum of another sign": {
        **SPACE, "symbols": {"v": "positive", "p": "negative"}, "hamiltonian": {"H": "p**2/2"},
        "claim": {"kind": "legendre", "L": "v**2/2", "velocities": ["v"]},
    },
    "velocities in the Hamiltonian": {
        **SPACE, "hamiltonian": {"H": "p*v - v**2/2"},
        "claim": {"kind": "legendre", "L": "v**2/2", "velocities": ["v"]},
    },
}  # fmt: skip


@pytest.mark.parametrize("name", NOTHING)
def test_nothing_is_shown_of_motions_by_a_forgery(name: str) -> None:
    assert forged(NOTHING[name])[0] == "not shown"


SERIES: Any = {"kind": "lie_series", "generator": "p", "parameter": "s", "f": "q"}
SOLVED: Any = {**SPACE, "symbols": {"X": "function", "c": "real"}}
MATRIX: Any = {"kind": "matrix_group", "first": ["a"], "second": ["b"]}
SPINS: Any = {"phase_space": {"q": ["x", "y", "z"], "p": ["u", "v", "w"]}}
EMPTY: dict[str, Any] = {
    "a parameter that is positive": {
        **SPACE, "symbols": {"s": "positive"}, "claim": {**SERIES, "equals": "q + s"},
    },
    "a parameter that is bounded": {
        **SPACE, "domain": {"where": ["s + q > 1"]}, "claim": {**SERIES, "equals": "q + s"},
    },
    "a parameter of the generator": {**SPACE, "claim": {**SERIES, "generator": "p*s/s", "equals": "q + s"}},
    "a parameter that is a coordinate": {**SPACE, "claim": {**SERIES, "parameter": "q", "f": "p", "equals": "p"}},
    "a cut at 0": {
        **SPACE, "claim": {**SERIES, "equals": "q + s + atan2(s, -1) + atan2(-s, -1) - 2*atan2(0, -1)"},
    },
    "a logarithm without a value at 0": {
        **SPACE, "claim": {**SERIES, "equals": "q + s + log(s - 1) - log(s - 1)"},
    },
    "an edge at 0": {**SPACE, "claim": {**SERIES, "equals": "q + s + 0*asin(1 - s)"}},
    "a root at 0": {**SPACE, "claim": {**SERIES, "equals": "q + s + 0*sqrt(s)"}},
    "a value at 0 alone": {**SPACE, "claim": {**SERIES, "equals": "q + s + s**2*q"}},
    "a series to an order": {**SPACE, "claim": {**SERIES, "equals": "q + s", "order": 1}},
    "an equation without the function": {
        **SOLVED, "claim": {"kind": "solves", "solution": {"X(t)": "c"}, "equations": ["c - c"]},
    },
    "a derivative by what the solution is made of": {
        **SOLVED, "claim": {"kind": "solves", "solution": {"X(t)": "c*t"}, "equations": ["D(X(t), c) - t"]},
    },
    "a bracket of solutions": {
        **SOLVED, "claim": {"kind": "solves", "solution": {"X(t)": "q + t"}, "equations": ["bracket(X(t), p) - 1"]},
    },
    "a derivative at a place": {
        **SOLVED, "definitions": {"w": "D(t**2, t)"},
        "claim": {"kind": "solves", "solution": {"X(t)": "w"}, "equations": ["X(0) - 0*t"]},
    },
    "a solution that is itself": {
        **SOLVED, "claim": {"kind": "solves", "solution": {"X(t)": "X(t)"}, "equations": ["X(t) - X(t)"]},
    },
    "a solution with another sign": {
        **SPACE, "symbols": {"X": ["function", "positive"]},
        "claim": {"kind": "solves", "solution": {"X(t)": "-1"}, "equations": ["X(t) + 1"]},
    },
    "a solution of what is defined": {
        **SOLVED, "definitions": {"a": "0"},
        "claim": {"kind": "solves", "solution": {"X(a)": "a"}, "equations": ["X(1) - 1"]},
    },
    "a function of the same name twice": {
        **SOLVED, "claim": {"kind": "solves", "solution": {"X(t)": "t", "X(q)": "0"}, "equations": ["X(q)"]},
    },
    "a bracket of new variables": {
        "phase_space": {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]},
        "transformation": {"q": ["sqrt(Q)"], "p": ["4*P*sqrt(Q)"]},
        "claim": {"kind": "identity", "lhs": "bracket(Q, P)", "rhs": "1"},
    },
    "a unit with a number": {
        **SPACE, "claim": {"kind": "dimension", "functions": ["q"], "dimensions": {"q": "2*L"}, "equals": "2*L"},
    },
    "a sum of units": {
        **SPACE, "claim": {"kind": "dimension", "functions": ["q"], "dimensions": {"q": "L + M"}, "equals": "L + M"},
    },
    "a unit that isn't in the base": {
        **SPACE, "claim": {"kind": "dimension", "functions": ["q"], "dimensions": {"q": "X"}, "equals": "X"},
    },
    "a base of another form": {
        **SPACE,
        "claim": {"kind": "dimension", "functions": ["q"], "dimensions": {"q": "L"}, "equals": "L", "base": "L"},
    },
    "a dimension of a function": {
        **SOLVED, "claim": {"kind": "dimension", "functions": ["0"], "dimensions": {"X": ["L", "T"]}, "equals": "L"},
    },
    "logarithms of units": {
        **SPACE, "symbols": {"q": "positive"},
        "claim": {"kind": "dimension", "functions": ["log(q)"], "dimensions": {"q": "L"}, "equals": "1"},
    },
    "a matrix with a longer row": {
        "claim": {"kind": "invariant_interval", "matrix": [["1", "0"], ["0", "1", "7"]],
                  "metric": [["1", "0"], ["0", "1"]]},
    },
    "a metric that is smaller": {
        "claim": {"kind": "invariant_interval", "matrix": [["1", "0"], ["0", "7"]], "metric": [["1"]]},
    },
    "a group of matrices of the second names": {
        **MATRIX, "claim": {**MATRIX, "matrix": [["b/b"]], "composition": ["a"]},
    },
    "a group of what isn't 0": {
        "symbols": {"a": "nonzero"}, "claim": {**MATRIX, "matrix": [["1"]], "composition": ["a*b"]},
    },
    "a tensor that isn't antisymmetric": {
        **SPACE, "claim": {"kind": "bracket", "f": "q", "g": "p", "equals": "1", "coordinates": ["q", "p"],
                           "tensor": [["0", "1"], ["1", "0"]]},
    },
    "a tensor with a diagonal": {
        **SPACE, "claim": {"kind": "bracket", "f": "q", "g": "p", "equals": "1", "coordinates": ["q", "p"],
                           "tensor": [["1", "1"], ["-1", "0"]]},
    },
    "structure constants that aren't linear": {
        **SPINS, "claim": {"kind": "bracket", "f": "x", "g": "y", "equals": "z**2",
                           "structure": {"x,y": "z**2", "y,z": "x"}},
    },
    "a pair that stands twice": {
        **SPINS, "claim": {"kind": "bracket", "f": "x", "g": "y", "equals": "2*z",
                           "structure": {"x,y": "z", "y, x": "-z"}},
    },
    "a bracket that isn't Poisson's": {
        **SPINS, "claim": {"kind": "casimir", "f": "1", "structure": {"x,y": "z", "y,z": "z", "z,x": "x"}},
    },
    "one function in involution": {
        **SPINS, "claim": {"kind": "involution", "functions": ["x"], "structure": {"x,y": "z"}},
    },
    "a map that is singular everywhere": {
        **SPACE, "transformation": {"q": ["Q"], "p": ["Q"]},
        "claim": {"kind": "identity", "lhs": "q + P", "rhs": "p + P"},
    },
    "a derivative of what the map gives": {
        **SPACE, "transformation": {"Q": ["q**2"], "P": ["p/(2*q)"]},
        "claim": {"kind": "identity", "lhs": "D(Q, q)", "rhs": "2*q"},
    },
    "a condition on a bracket of old variables": {
        **SPACE, "transformation": {"q": ["Q"], "p": ["2*P"]}, "domain": {"where": ["bracket(q, p) > 3/2"]},
        "claim": {"kind": "identity", "lhs": "sqrt((Q - 1)**2)*0 + q", "rhs": "Q"},
    },
    "a scale that may be 0": {
        **SPACE, "symbols": {"c": "real"}, "transformation": {"Q": ["c*q"], "P": ["p"]},
        "claim": {"kind": "canonical", "scale": "c"},
    },
    "a scale that moves": {
        **SPACE, "symbols": {"q": "positive"}, "transformation": {"Q": ["q**2"], "P": ["p"]},
        "claim": {"kind": "canonical", "scale": "2*q"},
    },
    "an invariant of no such order": {
        **SPACE, "transformation": {"Q": ["5*q"], "P": ["p"]}, "claim": {"kind": "integral_invariant", "order": 2},
    },
    "a word of the table in a claim": {
        **SPACE, "claim": {"kind": "hamiltonian_field", "qdot": ["with(q, q, 0)"], "pdot": ["0"]},
    },
    "what a claim has under another key": {
        **SPACE, "claim": {"kind": "hamiltonian_field", "qdot": ["__pdot_0"], "pdot": ["0"]},
    },
}  # fmt: skip


@pytest.mark.parametrize("name", EMPTY)
def test_nothing_is_shown_by_a_forgery(name: str) -> None:
    assert forged(EMPTY[name])[0] == "not shown"


THROWN: Any = {
    "a Hessian that is 0 on a half": NOTHING["a Hessian that is 0 on a half"],
    "what has a dimension on a half": {
        **SPACE, "claim": {"kind": "dimension", "functions": ["q + (sqrt(q**2) - q)*sin(q)"], "dimensions": {"q": "L"},
                           "equals": "L"},
    },
}  # fmt: skip
KERNEL: Any = {"name": "k", "stands for": "sqrt(q)", "relation": {"k^2": "1", "q": "-1"}}
PLACED: Any = {"name": "k", "stands for": "_with(m, m, q)", "relation": {"k": "1", "q": "-1"}}


@pytest.mark.parametrize("kernel", [KERNEL, PLACED], ids=["a root", "a place"])
@pytest.mark.parametrize("name", THROWN)
def test_a_kernel_does_not_choose_the_points(name: str, kernel: Any) -> None:
    """It would throw away those at which the claim is false; of the second, those after the first."""
    tables = {**THROWN[name], "symbols": {"m": "positive"}}
    assert [forged(tables, kernel)[0] for _ in range(6)] == ["not shown"] * 6


def test_its_files_need_nothing_but_python(tmp_path: Path) -> None:
    """Copies of the files, elsewhere, by a Python that sees no packages."""
    folder = Path(alone.__file__).parent
    for pattern in ("alone*", "counterexample*", "lie_invariants.py"):
        for file in folder.glob(pattern):
            (tmp_path / file.name).write_bytes(file.read_bytes())
    proofs = [tmp_path / f"{n}.json" for n in range(2)]
    data = proof("a solution")
    proofs[0].write_text(json.dumps(data), encoding="utf-8")
    proofs[1].write_text(json.dumps({**data, "method": "by hand"}), encoding="utf-8")
    for program in ("alone_wider.py", "alone_together.py"):
        for file, status, word in ((proofs[0], 0, "shown"), (proofs[1], 1, "wrong")):
            command = [sys.executable, "-ES", tmp_path / program, file]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            assert (done.returncode, done.stderr) == (status, "")
            assert word in done.stdout
