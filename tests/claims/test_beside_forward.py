"""Claims about orbits and origins, beside a map given forward whose formulas have no value in a part of phase space."""

import pytest

from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.errors import InputError

FILE = """[phase_space]
q = ["q"]
p = ["p"]
Q = ["Q"]
P = ["P"]
[symbols]
E = "positive"
{symbols}
[hamiltonian]
H = "p**2/2 + q**2/2"
[transformation]
{given}
[domain]
where = [{where}]
[[claim]]
{claim}
"""
ORBIT = 'coordinate = "q"\nenergy = "E"\n'
CLAIMS = {
    "action": 'kind = "action"\n' + ORBIT + 'equals = "{right}*2*pi*E"',
    "frequency": 'kind = "frequency"\n' + ORBIT + 'equals = "{right}/(2*pi)"',
    "average": 'kind = "average"\nf = "q**2"\n' + ORBIT + 'equals = "{right}*E"',
    "normal form": 'kind = "normal_form"\norder = 4\nN = {{ 4 = "({right} - 1)*q**4" }}',
}
CUT = {
    "a half plane": ('Q = ["log(q)"]\nP = ["p*q"]', "", ""),
    "without a line": ('Q = ["1/q"]\nP = ["-q**2*p"]', "", ""),
    "conditions on new variables": ('Q = ["q - 1"]\nP = ["p"]', "", '"Q > 0"'),
    "what is assumed of them": ('Q = ["q - 1"]\nP = ["p"]', 'Q = "positive"', ""),
}
WHOLE = {
    "a shear": ('Q = ["q"]\nP = ["p + q**3"]', "", ""),
    "a root of what is positive": ('Q = ["q*sqrt(1 + p**2)"]\nP = ["p/sqrt(1 + p**2)"]', "", ""),
    "a condition that holds anyway": ('Q = ["q"]\nP = ["p"]', "", '"Q**2 + 1 > 0"'),
}


def _status(given: tuple[str, str, str], claim: str, right: str) -> str:
    text, symbols, where = given
    (read,) = read_text(FILE.format(given=text, symbols=symbols, where=where, claim=claim.format(right=right))).claims
    return verify(read).status


@pytest.mark.parametrize("right", ["1", "1001/1000"])
@pytest.mark.parametrize("kind", CLAIMS)
@pytest.mark.parametrize("cut", CUT)
def test_nothing_is_said_of_orbits_that_leave_what_the_map_allows(cut: str, kind: str, right: str) -> None:
    assert _status(CUT[cut], CLAIMS[kind], right) == "undecided"


@pytest.mark.parametrize("kind", CLAIMS)
@pytest.mark.parametrize("whole", WHOLE)
def test_a_map_that_has_a_value_everywhere_changes_nothing(whole: str, kind: str) -> None:
    assert _status(WHOLE[whole], CLAIMS[kind], "1") == ("supported" if kind == "average" else "proved")
    assert _status(WHOLE[whole], CLAIMS[kind], "1001/1000") == "refuted"


HAMILTON_JACOBI = """[phase_space]
q = ["q"]
p = ["p"]
Q = ["Q"]
P = ["P"]
[symbols]
{symbols}
[hamiltonian]
H = "p"
[transformation]
{given}
[domain]
where = [{where}]
[[claim]]
kind = "hamilton_jacobi"
{claim}
"""


@pytest.mark.parametrize(
    "claim",
    [
        'S = "alpha*q - alpha*t*{sign}sqrt(q**2)/q"\nconstants = ["alpha"]',
        'W = "{sign}alpha*sqrt(q**2)"\nconstants = ["alpha"]\nenergy = "alpha"',
        'W = "{sign}P*sqrt(q**2)"\nconstants = ["P"]\nenergy = "P"',
    ],
)
@pytest.mark.parametrize("cut", [cut for cut in CUT if cut != "without a line"])
def test_an_integral_is_one_where_the_map_given_forward_has_a_value(cut: str, claim: str) -> None:
    given, symbols, where = CUT[cut]
    for sign, truth in (("", "proved"), ("-", "refuted")):
        text = HAMILTON_JACOBI.format(given=given, symbols=symbols, where=where, claim=claim.format(sign=sign))
        (read,) = read_text(text).claims
        assert verify(read).status == truth


TWO_WELLS = FILE.replace('q**2/2"', 'q**2/2 + 1/(2*q**2)"')


@pytest.mark.parametrize("right", ["1", "1001/1000"])
@pytest.mark.parametrize("given", ['Q = ["log(q)"]\nP = ["p*q"]', 'q = ["exp(Q)"]\np = ["P*exp(-Q)"]'])
def test_a_second_well_that_the_map_leaves_out_is_no_fault_of_the_claim(given: str, right: str) -> None:
    claim = 'kind = "action"\n' + ORBIT + 'equals = "{right}*pi*(E - 1)"'
    text = TWO_WELLS.format(given=given, symbols="", where="", claim=claim.format(right=right))
    (read,) = read_text(text).claims
    assert verify(read).status == "undecided"
    (plain,) = read_text(text.replace(given, 'Q = ["q"]\nP = ["p"]')).claims
    with pytest.raises(InputError, match="more than one well"):
        verify(plain)
