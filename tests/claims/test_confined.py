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
    ],
)
def test_an_image_without_interior_says_nothing(claim: str, regular: str) -> None:
    def status(q: str, p: str) -> str:
        (read,) = read_text(FILE.format(q=q, p=p, claim=claim)).claims
        return verify(read).status

    assert status("Q", "P + Q") == regular
    assert status("0", "0") == "undecided"
    assert status("Q + P", "(Q + P)**3/3 + 1") == "undecided"
