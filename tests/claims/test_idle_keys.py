"""Keys that a claim makes nothing of: what they say, true or not, would pass for shown."""

import pytest

from canon.errors import InputError

OSCILLATOR = {"hamiltonian": 'H = "p**2/2 + q**2/2"'}
RING = {"hamiltonian": 'H = "p**2/2 - cos(q)"'}
VIRIAL = 'kind = "average"\nf = "p**2 - q**2"\nequals = "0"\nvirial = "q*p"\nbound = "(p**2 + q**2)/2"'
MOTION = 'kind = "average"\nf = "q**2"\nequals = "1/2"\nparameter = "t"\nfrom = "0"\nto = "2*pi"\n'
MOTION += 'motion = {q = "sin(t)", p = "cos(t)"}'
ORBIT = 'kind = "average"\nf = "q**2"\nequals = "E"\ncoordinate = "q"\nenergy = "E"'
ROUND = 'kind = "action"\ncoordinate = "q"\nenergy = "E"\nbranch = "rotation"\n'
ROUND += 'equals = "4*sqrt(2*(E + 1))*elliptic_e(2/(E + 1))"'
PATH = 'kind = "stationary"\nvelocities = ["v"]\npath = ["0"]\nfrom = "0"\nto = "7"\n'
WAVES, GROWTH = PATH + 'L = "v**2/2 - q**2/2"', PATH + 'L = "v**2/2 + q**2/2"\nextremum = "minimum"'
FORM = 'kind = "constraint"\nvelocities = ["v"]\nforms = ["v"]\nholonomic = true'


@pytest.mark.parametrize(
    ("claim", "idle", "file"),
    [
        (VIRIAL, 'antiderivative = "q"', OSCILLATOR),
        (VIRIAL, 'well = "77"', OSCILLATOR),
        (MOTION, 'bound = "-5"', OSCILLATOR),
        (MOTION, 'energy = "E"', OSCILLATOR),
        (MOTION, 'fixed = {q = "3"}', OSCILLATOR),
        (ORBIT, 'bound = "3"', OSCILLATOR),
        (ORBIT, 'antiderivative = "q"', OSCILLATOR),
        (ROUND, 'well = "99"', RING),
        (WAVES, 'field = "sin(t)"', {}),
        (WAVES, 'field = "sin(2*t)"', {}),
        (WAVES, 'field = "sin(t - 1)"\nconjugate = ["1", "1001/1000 + pi"]', {}),
        (WAVES, 'conjugate = ["1", "2"]', {}),
        (GROWTH, 'conjugate = ["1", "2"]', {}),
        (FORM, 'qddot = ["5"]', {}),
        (FORM, 'forces = ["5"]', {}),
        (FORM, 'L = "v**2"', {}),
    ],
)
def test_no_key_is_passed_over(ask, claim, idle, file):
    with pytest.raises((InputError, AssertionError), match="is no part of this claim"):
        ask(f"{claim}\n{idle}", **file)


@pytest.mark.parametrize(("claim", "file"), [(VIRIAL, OSCILLATOR), (MOTION, OSCILLATOR), (ROUND, RING), (FORM, {})])
def test_they_are_proved_without_it(status, claim, file):
    assert status(claim, **file) == "proved"


def test_a_field_is_looked_at_where_the_second_variation_is_a_sum_of_squares(ask):
    (verdict,) = ask(GROWTH + '\nfield = "cosh(t)"')
    assert verdict.status == "proved"
    with pytest.raises((InputError, AssertionError), match="doesn't solve Jacobi"):
        ask(GROWTH + '\nfield = "sin(7*t)"')
    with pytest.raises((InputError, AssertionError), match="doesn't vanish"):
        ask(GROWTH + '\nfield = "sinh(t)"\nconjugate = ["1", "2"]')
