"""Actions where H isn't quadratic in p: solved for p², with the branch decided; and what must be left open."""

import pytest

from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.errors import InputError

RELATIVISTIC = (
    "8/(3*c)*sqrt(2*(E+m*c**2)/k)*(E*elliptic_e((E-m*c**2)/(E+m*c**2)) - N*m*c**2*elliptic_k((E-m*c**2)/(E+m*c**2)))"
)
QUARTIC = "4*(4*E)**(1/4)*sqrt(2*E)*gamma(3/2)*gamma(5/4)/gamma(7/4)"
SYMBOLS = 'm = "positive"\nc = "positive"\nk = "positive"\n'
SOMMERFELD = "sqrt(p**2*c**2 + L**2*c**2/q**2 + m**2*c**4) - k/q"
CENTRAL = SYMBOLS + 'q = "positive"\nL = "positive"\nE = "positive"'
RATE = "sqrt(m**2*c**4 - E**2)**3/(2*pi*k*m**2*c**3)"
CASES = [
    ("sqrt(p**2*c**2 + m**2*c**4) + k*q**2/2", RELATIVISTIC.replace("N", "1"), "action", SYMBOLS, "proved"),
    ("sqrt(p**2*c**2 + m**2*c**4) + k*q**2/2", RELATIVISTIC.replace("N", "1.001"), "action", SYMBOLS, "refuted"),
    (SOMMERFELD, RATE, "frequency", CENTRAL, "proved"),
    (SOMMERFELD, f"1001/1000*{RATE}", "frequency", CENTRAL, "refuted"),
    ("p**4/4 + q**2/2", QUARTIC, "action", "", "proved"),
    ("p**4/4 + q**2/2", f"1001/1000*{QUARTIC}", "action", "", "refuted"),
    ("(p**2 + q**2)**2", "pi*sqrt(E)", "action", "", "proved"),
    ("exp(p**2/2 + q**2/2)", "2*pi*log(E)", "action", "", "proved"),
    ("p**4/4 + p**2/2 + q**2/2", "2*pi*E", "action", "", "refuted"),  # by quadrature
    ("exp(p**2) + q**2/2", "2*pi*E", "action", "", "refuted"),
    ("(p**2 + q**2 - 1)**2", "pi*sqrt(E)", "action", "", "undecided"),  # two branches of it
    ("p**4 - p**2 + q**2", "1", "action", "", "undecided"),
    ("p**3 + q**2", "1", "action", "", "undecided"),
    ("-sqrt(p**2 + q**2 + 1)", "pi*(1 - E**2)", "action", "", "undecided"),
    ("1/(p**2 + q**2)", "-pi/E", "action", "", "undecided"),  # it falls with p**2: circles round a maximum
]  # fmt: skip


def _status(H: str, equals: str, kind: str, symbols: str) -> str:
    text = f'[phase_space]\nq = ["q"]\np = ["p"]\n[symbols]\n{symbols}\n[hamiltonian]\nH = "{H}"\n[[claim]]\n'
    text += f'kind = "{kind}"\ncoordinate = "q"\nenergy = "E"\nequals = "{equals}"\n'
    (claim,) = read_text(text).claims
    return verify(claim).status


@pytest.mark.parametrize(("H", "equals", "kind", "symbols", "expected"), CASES)
def test_actions(H: str, equals: str, kind: str, symbols: str, expected: str) -> None:
    assert _status(H, equals, kind, symbols) == expected


def test_far_away_the_square_is_positive_where_no_motion_is() -> None:
    """For V = −q² the square is positive outside of a hump too, where E − V < 0: nothing is bound there."""
    with pytest.raises(InputError, match="no minimum"):
        _status("sqrt(p**2 + 1) - q**2", "pi*E", "action", "")
