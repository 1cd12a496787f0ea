"""Claim files as text: sections to begin with, a claim to add, and what is read or said of the whole."""

from canon.claims.reader import read_text

OSCILLATOR = """
[phase_space]
q = ["q"]
p = ["p"]
Q = ["phi"]
P = ["I"]

[symbols]
m = "positive"
omega = "positive"

[definitions]
E0 = "p**2/(2*m) + m*omega**2*q**2/2"

[hamiltonian]
H = "E0"

[generating_function]
type = 1
F = "m*omega*q**2*cot(phi)/2"

[transformation]
Q = ["atan2(m*omega*q, p)"]
P = ["E0/omega"]
"""
PLANE = """
[phase_space]
q = ["x", "y"]
p = ["px", "py"]
"""
EULER = """
tensor = [[0, "L3", "-L2"], ["-L3", 0, "L1"], ["L2", "-L1", 0]]
coordinates = ["L1", "L2", "L3"]
"""


def claims_of(text: str):
    reading = read_text(text)
    assert reading.problems == []
    return reading.claims


def fault_of(text: str) -> str:
    """The only fault of a document, with its place."""
    (problem,) = read_text(text).problems
    return f"{problem['where']}: {problem['message']}"


def claim(kind: str, keys: str = "") -> str:
    return f'\n[[claim]]\nkind = "{kind}"\n{keys}\n'


DEMAND = claim("identity", 'lhs="x"\nrhs="x"')
