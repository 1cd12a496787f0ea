"""Claims of the old variables beside a map that is singular everywhere: nothing is concluded from its image."""

import pytest

from canon.claims.reader import read_text
from canon.claims.verify import verify

FILE = """
[phase_space]
q = ["q"]
p = ["p"]
Q = ["Q"]
P = ["P"]
[transformation]
q = ["{q}"]
p = ["{p}"]
[hamiltonian]
H = "p**2/2 + q**2/2"
[[claim]]
{claim}
"""


@pytest.mark.parametrize(
    ("claim", "regular"),
    [
        ('kind = "conserved"\nf = "q**2 - p**2"', "refuted"),
        ('kind = "bracket"\nf = "q**2"\ng = "p**2"\nequals = "4*q**2"', "refuted"),
        ('kind = "involution"\nfunctions = ["q**2", "p"]', "refuted"),
        ('kind = "independent"\nfunctions = ["q", "p"]', "proved"),
        (
            'kind = "lie_series"\ngenerator = "1"\nparameter = "s"\nf = "p*q"\nequals = "p*q + s*q*(p - q**3/3 - 1)"',
            "refuted",
        ),
        ('kind = "infinitesimal"\ngenerator = "q*p"\ndq = ["p"]\ndp = ["-q"]', "refuted"),
        ('kind = "equations_of_motion"\nqdot = ["q"]\npdot = ["-p"]', "refuted"),
        ('kind = "hamiltonian_field"\nqdot = ["q**2"]\npdot = ["-p*q"]', "refuted"),
        ('kind = "dimension"\nfunctions = ["q + p**2"]\ndimensions = {q = "L"}\nequals = "L"', "refuted"),
        ('kind = "identity"\nlhs = "p - q**3/3"\nrhs = "1"', "refuted"),
    ],
)
def test_an_image_without_interior_says_nothing(claim: str, regular: str) -> None:
    def status(q: str, p: str) -> str:
        (read,) = read_text(FILE.format(q=q, p=p, claim=claim)).claims
        return verify(read).status

    assert status("Q", "P + Q") == regular
    assert status("0", "0") == "undecided"
    assert status("Q + P", "(Q + P)**3/3 + 1") == "undecided"


def _of_many(q: str, p: str) -> str:
    names = {side: [f"{side}{i}" for i in range(6)] for side in "qpQP"}
    rows = {"q": [q.format(i=i) for i in range(6)], "p": [p.format(i=i) for i in range(6)]}
    (read,) = read_text(
        f"[phase_space]\n{_lines(names)}[transformation]\n{_lines(rows)}"
        '[[claim]]\nkind = "bracket"\nf = "q0"\ng = "p0"\nequals = "1 + q0 - p0"\n'
    ).claims
    return verify(read).status


def _lines(table: dict[str, list[str]]) -> str:
    return "".join(f"{name} = {row}\n" for name, row in table.items())


def test_an_image_in_many_variables() -> None:
    assert _of_many("Q{i} + P{i}**3", "P{i}") == "refuted"
    assert _of_many("Q{i}", "Q{i}") == "undecided"


def test_a_generating_function_that_defines_no_map() -> None:
    """p = 1 wherever it is anything."""
    text = """
[phase_space]
q = ["q"]
p = ["p"]
Q = ["Q"]
P = ["P"]
[generating_function]
type = 1
F = "q + Q"
[[claim]]
kind = "lie_series"
generator = "p"
parameter = "s"
f = "q"
equals = "2*q + s"
"""
    (read,) = read_text(text).claims
    assert verify(read).status == "undecided"
