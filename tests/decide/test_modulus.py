"""The modulus of complex names: real-valued, multiplicative, without a derivative."""

import pytest

from canon.claims.reader import read_text
from canon.claims.verify import verify

# left; right; where; verdict
MODULI = [
    ("abs(1j*x)", "abs(x)", "", "proved"),
    ("abs(1j*x)", "x", "", "refuted"),
    ("abs(z*w)", "abs(z)*abs(w)", "", "proved"),
    ("abs(z)**2", "z**2", "", "refuted"),
    ("abs(z)**2", "z*w", "", "refuted"),
    ("abs(z**3)", "abs(z)**3", "", "proved"),
    ("abs(1j*z)", "abs(z)", "", "proved"),
    ("abs(-2*z)", "2*abs(z)", "", "proved"),
    ("abs(-2*z)", "2001/1000*abs(z)", "", "refuted"),
    ("abs(z/w)", "abs(z)/abs(w)", "", "proved"),
    ("abs(z+w)", "abs(z)+abs(w)", "", "refuted"),
    ("sqrt(abs(z)**2)", "abs(z)", "", "proved"),
    ("log(abs(z*w))", "log(abs(z))+log(abs(w))", "", "proved"),
    ("abs(z)*x", "abs(z*x)", "", "refuted"),
    ("abs(z)*abs(x)", "abs(z*x)", "", "proved"),
    ("abs(z)", "1/2", "abs(z) < 1", "refuted"),
    ("abs(abs(z)-1)", "1-abs(z)", "abs(z) < 1", "proved"),
    ("abs(abs(z)-1)", "1-abs(z)", "abs(z) < 2", "refuted"),
    ("abs(z+1j)", "abs(1j*z-1)", "", "supported"),
    ("D(abs(z),z)", "1", "", "error"),
    ("D(x*abs(z),x)", "abs(z)", "", "proved"),
    ("abs(exp(z))", "1", "", "error"),
    ("abs(x+1j*y)", "sqrt(x**2+y**2)", "", "proved"),
    ("D(abs(x+1j*y),x)", "x/sqrt(x**2+y**2)", "", "proved"),
    ("abs(exp(1j*x))", "1", "", "proved"),
    ("abs(1j)", "1", "", "proved"),
    ("abs(3+4j)*x", "5*x", "", "proved"),
    ("sign(abs(z))", "1", "", "proved"),
    ("abs(z)**x*abs(z)**y", "abs(z)**(x+y)", "", "proved"),
    ("sqrt(abs(z))*sqrt(abs(w))", "sqrt(abs(z*w))", "", "proved"),
    ("bracket(x*abs(z),y)", "abs(z)", "", "proved"),
    ("bracket(abs(x*z),y)", "abs(z)", "", "error"),
    ("bracket(abs(x)*abs(z),y)", "abs(z)*sign(x)", "", "proved"),
]


@pytest.mark.parametrize(("left", "right", "where", "expected"), MODULI)
def test_modulus(left, right, where, expected):
    text = '[phase_space]\nq = ["x"]\np = ["y"]\n[symbols]\nz = "complex"\nw = "complex"\n'
    text += f'[domain]\nwhere = {[where] if where else []!r}\n[[claim]]\nkind = "identity"\n'
    reading = read_text(text + f'lhs = "{left}"\nrhs = "{right}"\n')
    if expected == "error":
        assert "abs of" in str(reading.problems[0])
        return
    assert verify(reading.claims[0], budget=5.0).status == expected
