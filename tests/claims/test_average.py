"""Averages over time: the virial theorem, and motions that are given."""

import pytest

from canon.errors import InputError

SYMBOLS = "\n".join([f'{x} = "positive"' for x in ("a", "m", "w", "A", "g", "k", "M")])
SYMBOLS += '\ne = "nonnegative"\nf0 = "real"\n'
OSCILLATOR = 'H = "p**2/(2*m) + m*w**2*q**2/2"'


def _virial(f: str, equals: str, G: str = "q*p/2", bound: str = "(p**2/(2*m) + m*w**2*q**2/2)/w") -> str:
    return f'kind = "average"\nf = "{f}"\nequals = "{equals}"\nvirial = "{G}"\nbound = "{bound}"'


@pytest.mark.parametrize(
    ("f", "equals", "G", "expected"),
    [
        ("p**2/m", "p**2/(2*m) + m*w**2*q**2/2", "q*p/2", "proved"),
        ("p**2/m", "p**2/m + m*w**2*q**2", "q*p/2", "refuted"),
        ("p**2/m", "1001/1000*(p**2/(2*m) + m*w**2*q**2/2)", "q*p/2", "refuted"),
        ("m*w**2*q**2/2", "(p**2/(2*m) + m*w**2*q**2/2)/2", "-q*p/4", "proved"),
    ],
)
def test_the_oscillator(status, f, equals, G, expected):
    assert status(_virial(f, equals, G), symbols=SYMBOLS, hamiltonian=OSCILLATOR) == expected


def test_a_bound_must_be_one(ask):
    small = _virial("p**2/m", "p**2/(2*m) + m*w**2*q**2/2", bound="(p**2/(2*m) + m*w**2*q**2/2)/(4*w)")
    (verdict,) = ask(small, symbols=SYMBOLS, hamiltonian=OSCILLATOR)
    assert verdict.status == "undecided"
    with pytest.raises((InputError, AssertionError), match="no constant"):
        ask(_virial("p**2/m", "p**2/m", bound="q**2 + p**2"), symbols=SYMBOLS, hamiltonian=OSCILLATOR)
    with pytest.raises((InputError, AssertionError), match="no constant"):
        ask(_virial("p**2/m", "p**2/m", G="2*q*p"), symbols=SYMBOLS, hamiltonian=OSCILLATOR)


@pytest.mark.parametrize(
    ("H", "symbols", "where", "expected"),
    [
        ("p**2/2 + q**4/4", "", "", "refuted"),
        ("p**2/2 - cos(q)", "", "", "refuted"),
        ("p**2/2", 'p = "positive"', "", "refuted"),
        ("p**2/2 + q*t**2", "", "", "refuted"),
        ("p**2/2 - exp(q)", "", "p**2/2 < exp(q)", "undecided"),  # each is at infinity before long
        ("p**2/2 - q**4/4", "", "p**2/2 < q**4/4", "undecided"),
        ("p**2/2 - 1/q", 'q = "positive"', "p**2/2 < 1/q", "undecided"),  # each falls into the centre
        ("p*q**2", "", "q != 0", "undecided"),
        ("p**2/2 + q", 'q = "positive"', "", "undecided"),  # each leaves what is assumed of q
        ("p**2/2", 'q = "nonzero"', "", "undecided"),
        ("p**2/(2*t)", "", "", "undecided"),
    ],
)
def test_no_average_is_refuted_where_no_motion_goes_on_for_ever(status, H, symbols, where, expected):
    domain = {"domain": f'where = ["{where}"]'} if where else {}
    claim = _virial("1", "2", G="0", bound="0")
    assert status(claim, symbols=SYMBOLS + symbols + "\n", hamiltonian=f'H = "{H}"', **domain) == expected


def test_what_moves_besides_is_no_constant_of_an_orbit(ask):
    """The average of sin t over the period 2π is 0, at no fixed time; that of another coordinate is none."""
    orbit = 'kind = "average"\nequals = 0\ncoordinate = "q"\nenergy = "E"\n'
    with pytest.raises((InputError, AssertionError), match="t moves too"):
        ask(orbit + 'f = "sin(t)"', hamiltonian='H = "p**2/2 + q**2/2"')
    with pytest.raises((InputError, AssertionError), match="y moves too"):
        ask(orbit + 'f = "y"', space='q = ["q", "y"]\np = ["p", "py"]\n', hamiltonian='H = "p**2/2 + q**2/2 + py**2/2"')


def _motion(f: str, equals: str, motion: str, parameter: str, to: str = "2*pi") -> str:
    head = f'kind = "average"\nf = "{f}"\nequals = "{equals}"\nparameter = "{parameter}"\nfrom = 0\nto = "{to}"\n'
    return head + f"motion = {{{motion}}}"


SWING = 'q = "A*sin(w*t)", p = "m*A*w*cos(w*t)"'


@pytest.mark.parametrize(
    ("f", "equals", "expected"),
    [
        ("m*w**2*q**2/2", "m*w**2*A**2/4", "proved"),
        ("m*w**2*q**2/2", "m*w**2*A**2/2", "refuted"),
        ("p**2/(2*m)", "1001*m*w**2*A**2/4000", "refuted"),
        ("q*p", "0", "proved"),
    ],
)
def test_along_a_motion(status, f, equals, expected):
    claim = _motion(f, equals, SWING, "t", "2*pi/w")
    assert status(claim, symbols=SYMBOLS, hamiltonian=OSCILLATOR) == expected


ELLIPSE = ", ".join(
    [
        'r = "a*(1 - e*cos(u))"',
        'pr = "m*sqrt(k/(m*a))*e*sin(u)/(1 - e*cos(u))"',
        't = "sqrt(m*a**3/k)*(u - e*sin(u))"',
    ]
)
RADIAL = 'H = "pr**2/(2*m) + m*k*a*(1 - e**2)/(2*m*r**2) - k/r"'


@pytest.mark.parametrize(
    ("f", "equals", "expected"),
    [
        ("1/r", "1/a", "proved"),
        ("1/r", "1/a + e/1000", "refuted"),
        ("r", "a*(1 + e**2/2)", "proved"),
        ("r", "a*(1 + 1001*e**2/2000)", "refuted"),
    ],
)
def test_the_kepler_ellipse_in_the_eccentric_anomaly(status, f, equals, expected):
    space, domain = 'q = ["r"]\np = ["pr"]\n', 'where = ["e < 1"]'
    claim = _motion(f, equals, ELLIPSE, "u")
    found = status(
        claim,
        space=space,
        symbols=f'{SYMBOLS}\nr = "positive"',
        hamiltonian=RADIAL,
        domain=domain,
    )
    assert found == expected


def test_a_clock_that_jumps_is_none(status):
    back = 'q = "u", p = "0", t = "atan2(sin(u), cos(u))"'  # from pi back to -pi
    assert status(_motion("q", "pi", back, "u")) == "undecided"


def test_a_motion_there_and_back_has_no_average(status):
    back = 'q = "A*sin(w*sin(u))", p = "m*A*w*cos(w*sin(u))", t = "sin(u)"'  # 0 = equals * 0, whatever is claimed
    claim = _motion("q", "7", back, "u", "pi")
    assert status(claim, symbols=SYMBOLS, hamiltonian=OSCILLATOR) == "undecided"


@pytest.mark.parametrize(
    ("claim", "message"),
    [
        (_motion("q", "0", 'q = "A*sin(2*w*t)", p = "m*A*w*cos(w*t)"', "t"), "solve Hamilton"),
        (_motion("q", "0", 'q = "A*sin(w*t)"', "t"), "missing"),
        (_motion("q", "q", SWING, "t"), "moves"),
        (_motion("q", "0", 'q = "A*sin(u)", p = "m*A*w*cos(u)"', "u"), "time as a formula"),
        ('kind = "average"\nf = "q"\nequals = 0', "give either"),
    ],
)
def test_faults(ask, claim, message):
    with pytest.raises((InputError, AssertionError), match=message):
        ask(claim, symbols=SYMBOLS, hamiltonian=OSCILLATOR)


def _orbit(f: str, equals: str, *more: str) -> str:
    return "\n".join([f'kind = "average"\nf = "{f}"\nequals = "{equals}"\ncoordinate = "q"\nenergy = "E"', *more])


AT_ONE = "fixed = {E = 1}"


@pytest.mark.parametrize(
    ("H", "f", "equals", "more", "expected"),
    [
        ("p**2/2 + q**4", "p**2/2", "2*E/3", AT_ONE, "supported"),  # the virial theorem of a quartic
        ("p**2/2 + q**4", "p**2/2", "2*E/3 + 1e-9", AT_ONE, "refuted"),
        ("p**2/2 + q**4", "q**4", "E/2", AT_ONE, "refuted"),
        ("p**2/2 + q**4", "q**2", "4*(gamma(3/4)/gamma(1/4))**2*sqrt(E)", AT_ONE, "supported"),
        ("p**2/2 + q**4", "p", "1e-6", AT_ONE, "refuted"),
        ("(p - q)**2/2 + a*q**2", "(p - q)**2/2", "E/2", AT_ONE, "supported"),
        ("p**2/2 - cos(q)", "p**2 - q*sin(q)", "0", 'branch = "libration"\nfixed = {E = "1/2"}', "supported"),
        ("p**2/2 - cos(q)", "p**2 - q*sin(q)", "1e-9", 'branch = "libration"\nfixed = {E = "1/2"}', "refuted"),
        ("p**2/2 + q**4", "1/q", "0", AT_ONE, "undecided"),  # the orbit goes through its pole
    ],
)
def test_over_an_orbit(status, H, f, equals, more, expected):
    assert status(_orbit(f, equals, more), symbols=SYMBOLS, hamiltonian=f'H = "{H}"') == expected


@pytest.mark.parametrize(
    ("H", "claim", "message"),
    [
        ("p**2/2 - cos(q)", _orbit("p", "0", 'branch = "rotation"'), "over librations"),
        ("p**2/2 + q**4", _orbit("p", "q", AT_ONE), "not of q"),
        ("p**2/2 + q**4", _orbit("p", "0", 'virial = "q"'), "give either"),
        ("p**2/2 - q**2", _orbit("p", "0", AT_ONE), "E|energy|minimum|orbit"),
    ],
)
def test_faults_over_an_orbit(ask, H, claim, message):
    with pytest.raises((InputError, AssertionError), match=message):
        ask(claim, symbols=SYMBOLS, hamiltonian=f'H = "{H}"')


ROUND = 'kind = "average"\nf = "{f}"\nequals = "{equals}"\nparameter = "u"\nfrom = "0"\nto = "{to}"\n'
ROUND += 'motion = {{ q = "cos(u)", p = "-sin(u)", t = "u" }}'


@pytest.mark.parametrize(
    ("f", "equals", "to", "symbols", "where", "expected"),
    [
        ("abs(q)", "0", "2*pi", 'q = "positive"', "", "undecided"),  # 2/π, were q not said to be positive
        ("abs(q)", "2*sqrt(2)/pi", "pi/4", 'q = "positive"', "", "proved"),
        ("q**2", "1/2", "2*pi", "", 'where = ["q > 5"]', "undecided"),
        ("q**2", "1/2", "2*pi", "", 'where = ["q > -5"]', "proved"),
    ],
)
def test_a_motion_stays_in_the_domain(status, f, equals, to, symbols, where, expected):
    claim = ROUND.format(f=f, equals=equals, to=to)
    assert status(claim, symbols=symbols, domain=where, hamiltonian='H = "p**2/2 + q**2/2"') == expected


NUMERIC = {"method": "numeric"}


@pytest.mark.parametrize(
    ("claim", "H", "where"),
    [
        ('f = "p"\nequals = "p"\nvirial = "q"\nbound = "1000"', "p**2/2", ""),  # q is not bounded by 1000
        ('f = "1"\nequals = "2"\nvirial = "0"\nbound = "1"', "p**2/2 - exp(q)", 'where = ["p**2/2 < exp(q)"]'),
    ],
)
@pytest.mark.parametrize("method", ["symbolic", "numeric"])
def test_samples_refute_no_average_of_motions_that_may_not_be_there(ask, claim, H, where, method):
    sections = {"hamiltonian": f'H = "{H}"', **({"domain": where} if where else {})}
    (verdict,) = ask(f'kind = "average"\n{claim}', options={"method": method}, **sections)
    assert verdict.status == "undecided"


def test_samples_refute_a_wrong_average_where_the_theorem_holds(ask):
    wrong = _virial("p**2/m", "p**2/m + m*w**2*q**2")
    (verdict,) = ask(wrong, symbols=SYMBOLS, hamiltonian=OSCILLATOR, options=NUMERIC)
    assert verdict.status == "refuted"


def test_a_bound_with_a_pole_where_a_wave_is_0_is_an_answer(ask):
    """tan(t/2) has a pole where cos(t/2) is 0, which was once put in."""
    G = "2*atan(tan(t/2)/sqrt(3))/sqrt(3) - t/sqrt(3)"
    claim = _virial("1/(2 + cos(t))", "1/sqrt(3)", G, "10")
    (verdict,) = ask(claim, hamiltonian='H = "p**2/2 + q**2/2"')
    assert verdict.status in ("proved", "undecided")


CENTRIFUGAL = {"symbols": 'q = "positive"\nl = "positive"', "hamiltonian": 'H = "p**2/2 + l**2/(2*q**2) + q**2/2"'}


@pytest.mark.parametrize(
    ("sections", "f", "equals", "G", "bound", "expected"),
    [
        ({"hamiltonian": 'H = "p"', "domain": 'where = ["-1 < q", "q < 1"]'}, "1", "0", "q", "1", "undecided"),
        ({"hamiltonian": 'H = "p"', "symbols": 'q = "positive"', "domain": 'where = ["q < 1"]'}, "1", "0", "q", "1",
         "undecided"),
        ({"hamiltonian": 'H = "p**2/2 + q**2/2"', "domain": 'where = ["p > 0"]'}, "p", "0", "q", "sqrt(p**2 + q**2)",
         "undecided"),
        ({"hamiltonian": 'H = "p**2/2 + q**2/2"', "domain": 'where = ["p**2 + q**2 > 1"]'}, "p", "0", "q",
         "sqrt(p**2 + q**2)", "proved"),
        (CENTRIFUGAL, "p**2 + l**2/q**2", "p**2/2 + l**2/(2*q**2) + q**2/2", "q*p/2",
         "(p**2/2 + l**2/(2*q**2) + q**2/2)/2", "proved"),  # the centre, where H has a pole, is not reached
        ({"hamiltonian": 'H = "p*(1 + q**2)*sqrt(1 + q**2)"'}, "1", "0", "q/sqrt(1 + q**2)", "1", "undecided"),
        ({"hamiltonian": 'H = "p*cosh(q)**2"'}, "1", "0", "tanh(q)", "1", "undecided"),  # at infinity after a time of 2
        ({"hamiltonian": 'H = "p*cosh(q)**2"'}, "1 + 25*cos(5*tanh(q))", "0", "tanh(q) + 5*sin(5*tanh(q))", "6",
         "undecided"),
    ],
)  # fmt: skip
def test_an_average_of_no_motion_at_all(status, sections, f, equals, G, bound, expected):
    assert status(_virial(f, equals, G, bound), **sections) == expected


@pytest.mark.parametrize("u", ["u", "t"])
def test_an_average_does_not_depend_on_its_parameter(ask, u):
    claim = f'kind = "average"\nf = "1"\nequals = "{u}"\nparameter = "{u}"\nfrom = "0"\nto = "1"\n'
    with pytest.raises(InputError, match="runs through"):
        ask(claim + f'motion = {{t = "{u}"}}' if u == "u" else claim + 'motion = {q = "t"}')
