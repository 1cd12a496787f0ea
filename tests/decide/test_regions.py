"""Points are found in thin, bounded and far-away regions; where there are none, that is said."""

import pytest

from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.errors import InputError

REGIONS = [
    ('n = "integer"', ["n > 20"]),
    ('n = ["integer", "negative"]', ["n < -100"]),
    ('n = "integer"', ["5 < n < 7"]),
    ('n = "integer"', ["n**2 < 1"]),
    ('n = "real"', ["100 < n < 100.001"]),
    ('n = "real"', ["n**5 - n - 1 > 0", "n < 1.168"]),
    ('n = "real"\nm = "real"', ["m > n**2", "m < n**2 + 1e-8"]),
    ('n = "real"\nm = "real"', ["m**2 + n**2 < 1", "m**2 + n**2 > 1 - 1e-6"]),
    ('n = "real"\nm = "real"\nk = "real"', ["n + m + k > 3", "n < 1", "m < 1", "k < 1.0001"]),
    ('n = "real"', ["sin(n) > 0.9999"]),
    ('n = "positive"', ["n < 1e-20"]),
    ('n = "positive"', ["n > 1e30"]),
    ('c = "positive"\nn = "real"', ["299792457 < c < 299792459", "n > 0.999*c", "n**2 < c**2"]),
]
FILE = '[phase_space]\nq = ["a"]\np = ["b"]\n[symbols]\n{}\n[domain]\nwhere = {}\n[[claim]]\nkind = "identity"\n{}'


@pytest.mark.parametrize(("symbols", "where"), REGIONS)
def test_a_point_is_found_and_lies_inside(symbols: str, where: list[str]):
    text = FILE.format(symbols, [*where], 'lhs = "n + 1e-40"\nrhs = "n"')
    verdict = verify(read_text(text).claims[0], budget=20)
    assert verdict.status == "refuted"


@pytest.mark.slow
def test_a_search_that_leaves_floating_point_numbers_goes_on():
    """The slope exp(x) y of a condition may be beyond them where a point is looked for."""
    where = ["-1001/1000 < exp(x)*y < 0", "z**3 < -1501/1000"]
    u, v = (
        "((exp(x)*y)**2 + 999900000001/1000000000000*exp(x)*y - 1000000000001/10000000000000000)",
        "(z**3*(z**3 + 1))",
    )
    claim = f'lhs = "log({u}/{v})"\nrhs = "log({u}) - log({v})"'
    text = FILE.format('x = "real"\ny = "real"\nz = "real"', where, claim)
    assert verify(read_text(text).claims[0], budget=20, seed=0).status == "proved"


def test_a_root_looked_for_beyond_floating_point_numbers_is_left():
    """The secant method may reach values of exp(x) y that no floating-point number holds."""
    u = "exp(x)*y"
    P, Q = f"(1/100 - {u} + ({u})**2/100 - ({u})**3)", f"({u}/3000000 - ({u})**2/3)"
    claim = f'lhs = "sqrt({P}/{Q})"\nrhs = "sqrt({P}*{Q})/abs({Q})"'
    text = FILE.format('x = "real"\ny = "real"', ["exp(x)*y > 0"], claim)
    assert verify(read_text(text).claims[0], budget=20, seed=21004975).status in ("supported", "proved")


@pytest.mark.parametrize("where", [["5 < n < 6"], ["n > 2", "n < 1"]])
def test_no_point_is_an_input_error(where: list[str]):
    text = FILE.format('n = "integer"', where, 'lhs = "n"\nrhs = "n"')
    with pytest.raises(InputError, match="no point of the domain"):
        verify(read_text(text).claims[0], budget=20)
