"""New variables that are complex because their formulas are."""

import pytest

from canon.claims.reader import read_text
from canon.claims.verify import verify

OSCILLATOR = """
[phase_space]
q = ["q"]
p = ["p"]
Q = ["a"]
P = ["b"]
[definitions]
z = "(q + 1j*p)/sqrt(2)"
[hamiltonian]
H = "(p**2 + q**2)/2"
[transformation]
Q = ["z"]
P = ["1j*(q - 1j*p)/sqrt(2)"]
[[claim]]
kind = "new_hamiltonian"
K = "{}"
"""


def test_the_modulus_of_a_complex_variable_is_not_read_as_its_square():
    """K = |a|² holds; with a taken as real it would be refuted as a². The modulus has no derivative by a."""
    modulus, square = (read_text(OSCILLATOR.format(K)).claims[0] for K in ("abs(a)**2", "a**2"))
    assert verify(modulus).status == "undecided"
    assert verify(square).status == "refuted"


def test_the_holomorphic_form_is_proved():
    (claim,) = read_text(OSCILLATOR.format("-1j*a*b")).claims
    assert verify(claim).status == "proved"


@pytest.mark.parametrize(
    ("a", "expected"),
    [
        ("sqrt(a**2 - 2*a + 1) - a + 2", "supported"),
        ("2 + atan(a) + atan(1/a) - pi/2 - a/2*0", "refuted"),
        ("1 + atan(a) + atan(1/a) - pi/2", "supported"),
        ("1 + (a - 2)*b", "supported"),
        ("1 + (a - 2)*c", "proved"),
        ("1 + (a - 2)*sqrt(1 + a**2)", "proved"),
    ],
)
def test_generic_failure_is_shown_at_almost_all_values_of_all_parameters(status, a, expected):
    verdict = status(
        'kind = "canonical_when"\nsolutions = [{a = 2}]',
        symbols='a = "real"\nb = "real"\nc = "positive"',
        transformation=f'Q = ["q*({a})"]\nP = ["p"]',
    )
    assert verdict == expected
