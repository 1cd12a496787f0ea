"""Claims of actions and frequencies (course section 14.5; Goldstein, Poole and Safko 2002, sections 10.6 to 10.8)."""

from fractions import Fraction

import pytest
import sympy as sp
from mpmath import mp

from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.errors import InputError
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.statements import action, frequency

LINE = 'q = ["q"]\np = ["p"]\n'
PLANE = 'q = ["r", "theta"]\np = ["p_r", "p_theta"]\n'
KEPLER = {
    "symbols": 'r = "positive"\nm = "positive"\na = "positive"\nM = "positive"',
    "hamiltonian": 'H = "(p_r**2 + p_theta**2/r**2)/(2*m) - a/r"',
}
PENDULUM = {"hamiltonian": 'H = "p**2/2 - cos(q)"', "symbols": 'E = "real"'}


def action_claim(equals: str, coordinate: str = "q", kind: str = "action", **keys: str) -> str:
    lines = [f'kind = "{kind}"', f'coordinate = "{coordinate}"', 'energy = "E"', f'equals = "{equals}"']
    return "\n".join([*lines, *(f"{name} = {value}" for name, value in keys.items())])


@pytest.mark.parametrize(
    ("equals", "kind", "expected"),
    [
        ("2*pi*(a*sqrt(m/(-2*E)) - M)", "action", "proved"),
        ("2*pi*(a*sqrt(m/(-2*E)) - 1001/1000*M)", "action", "refuted"),
        ("-2*pi*(a*sqrt(m/(-2*E)) - M)", "action", "refuted"),
        ("sqrt(-2*E)**3/(2*pi*a*sqrt(m))", "frequency", "proved"),
        ("sqrt(-2*E)**3/(a*sqrt(m))", "frequency", "refuted"),
    ],
)
def test_kepler(ask, equals, kind, expected):
    (verdict,) = ask(action_claim(equals, "r", kind, fixed='{p_theta = "M"}'), space=PLANE, **KEPLER)
    assert verdict.status == expected
    if expected == "refuted":
        assert set(verdict.witness) == {"E", "M", "a", "m"}
        E, M, a, m = (float(Fraction(verdict.witness[name])) for name in "EMam")
        assert -m * a**2 / (2 * M**2) < E < 0  # a bound orbit


def test_a_momentum_left_free_is_a_constant(status):
    claim = action_claim("2*pi*(a*sqrt(m/(-2*E)) - abs(p_theta))", "r")
    assert status(claim, space=PLANE, **KEPLER) == "proved"
    claim = action_claim("2*pi*(a*sqrt(m/(-2*E)) - p_theta)", "r")
    assert status(claim, space=PLANE, **KEPLER) == "refuted"  # where p_theta < 0


@pytest.mark.parametrize(
    ("equals", "keys", "expected"),
    [
        ("16*(elliptic_e((E+1)/2) - (1-E)/2*elliptic_k((E+1)/2))", {"branch": '"libration"'}, "proved"),
        ("16.001*(elliptic_e((E+1)/2) - (1-E)/2*elliptic_k((E+1)/2))", {"branch": '"libration"'}, "refuted"),
        ("4*sqrt(2*(E+1))*elliptic_e(2/(E+1))", {"branch": '"rotation"'}, "proved"),
        ("8*sqrt(2*(E+1))*elliptic_e(2/(E+1))", {"branch": '"rotation"', "period": '"4*pi"'}, "proved"),
        ("16", {"branch": '"libration"', "fixed": '{E = "1"}'}, "proved"),
        ("8", {"branch": '"rotation"', "fixed": '{E = "1"}'}, "proved"),
        ("16", {"branch": '"rotation"', "fixed": '{E = "1"}'}, "refuted"),
        ("16*(elliptic_e(1/2) - elliptic_k(1/2)/2)", {"branch": '"libration"', "fixed": '{E = "0"}'}, "proved"),
        (
            "16*(elliptic_e((E+1)/2) - (1-E)/2*elliptic_k((E+1)/2))",
            {"branch": '"libration"', "well": '"2*pi"'},
            "proved",
        ),
    ],
)
def test_the_pendulum(status, equals, keys, expected):
    assert status(action_claim(equals, **keys), space=LINE, **PENDULUM) == expected


def test_a_domain_that_cuts_the_orbits_is_not_argued_about(ask):
    claim = action_claim("2*pi*E")
    oscillator = {"hamiltonian": 'H = "(p**2 + q**2)/2"'}
    (verdict,) = ask(claim, space=LINE, **oscillator, domain='where = ["-2 < q < 1"]')
    assert verdict.status == "proved"  # of the orbits within
    (verdict,) = ask(action_claim("2*pi*E*1.001"), space=LINE, **oscillator, domain='where = ["-2 < q < 1"]')
    assert float(Fraction(verdict.witness["E"])) < 1 / 2


def test_a_coefficient_of_p_squared_that_vanishes_in_the_range_is_no_oscillator(status):
    """On q = 0 the orbits of q (p² + q² − 1) = 0 stand still: the circle isn't one of them."""
    claim = 'kind = "action"\ncoordinate = "q"\nenergy = "E"\nfixed = {E = "0"}\nequals = "pi"'
    assert status(claim, space=LINE, hamiltonian='H = "q*(p**2 + q**2 - 1)"', symbols='E = "real"') == "undecided"


def test_constants_are_chosen_for_the_sake_of_example():
    text = (
        f'[phase_space]\n{LINE}[symbols]\nk = "positive"\n[hamiltonian]\nH = "p**2/2 - k*cos(q)"\n[[claim]]\n'
        + action_claim("1", branch='"libration"', fixed='{E = "2*k"}')
    )
    with pytest.raises(InputError, match="at k = 11/3: there is no libration at E = 22/3") as error:
        verify(read_text(text).claims[0])
    assert error.value.where == "key 'branch'"


@pytest.mark.parametrize(
    ("H", "claim", "expected"),
    [
        (
            "(p - 3)**2/2",
            action_claim("2*pi*(3 + sqrt(2*E))", branch='"rotation"', period='"2*pi"', fixed='{E = "5"}'),
            "proved",
        ),
        ("(p + 3)**2/2", action_claim("2*pi*(sqrt(2*E) - 3)", branch='"rotation"', period='"2*pi"'), "proved"),
        # a well beside a hill that leads away is the only one
        ("p**2/2 + q**2/2 - q**3/3", action_claim("0.6628973708825298", fixed='{E = "1/10"}'), "refuted"),
        ("p**2/2 + q**2/2 - q**3/3", action_claim("1.2", fixed='{E = "1/6"}'), "proved"),
        # between two hilltops, where no closed form is known
        ("p**2/2 + q**2/(1 + q**4)", action_claim("2.5741483994445118", fixed='{E = "1/2"}'), "supported"),
        ("p**2/2 + q**2/(1 + q**4)", action_claim("2.5741483", fixed='{E = "1/2"}'), "undecided"),
        ("p**2/2 + q**2/2 - q**3/3", action_claim("2*pi*E"), "refuted"),  # energies between the bottom and the barrier
        ("p**2/2 + q**2/2", action_claim("1/(2*pi)", kind="frequency", fixed='{E = "sqrt(2)"}'), "proved"),
        ("p**2/2 + q**6", action_claim("1.001", kind="frequency", fixed='{E = "2"}'), "refuted"),
        ("p**2/2 - q**4 + q**2 - q**6/9", action_claim("1", kind="frequency", fixed='{E = "sqrt(2)/20"}'), "undecided"),
    ],
)
def test_energies_that_are_given(status, H, claim, expected):
    assert status(claim, space=LINE, symbols='E = "real"', hamiltonian=f'H = "{H}"') == expected


def test_rotations_over_a_period_that_is_no_rational_number(ask):
    """The mean of sqrt(2(E - V)) over 2 pi, by mpmath's quadrature in 30 digits."""
    sections = {"hamiltonian": 'H = "p**2/2 + cos(q) + cos(2*q)/3"', "symbols": 'E = "real"'}
    with mp.workdps(30):
        momentum = lambda q: mp.sqrt(2 * (3 - mp.cos(q) - mp.cos(2 * q) / 3))  # noqa: E731
        J = mp.nstr(mp.quad(momentum, mp.linspace(0, 2 * mp.pi, 9)), 25)
        T = mp.quad(lambda q: 1 / momentum(q), mp.linspace(0, 2 * mp.pi, 9))
        rate = mp.nstr(1 / T, 25)
    near = ask(
        action_claim(f"{J} + 1e-20", branch='"rotation"', fixed='{E = "3"}'),
        action_claim(f"{J} + 1e-12", branch='"rotation"', fixed='{E = "3"}'),
        action_claim(f"{rate} + 1e-12", branch='"rotation"', fixed='{E = "3"}', kind="frequency"),
        space=LINE,
        **sections,
    )
    assert [v.status for v in near] == ["supported", "refuted", "refuted"]


@pytest.mark.parametrize(("b", "expected"), [("abs(b)", "proved"), ("1001/1000*abs(b)", "refuted")])
def test_a_cosine_of_either_sign(status, b, expected):
    sections = {"symbols": 'b = "real"', "hamiltonian": 'H = "p**2/2 + b*cos(q)"'}
    claim = action_claim(f"4*sqrt(2*(E + {b}))*elliptic_e(2*{b}/(E + {b}))", branch='"rotation"')
    assert status(claim, space=LINE, **sections) == expected


def test_what_no_standard_integral_covers_is_enclosed(ask):
    """J = 7.46700987104130930581… by quadrature in 25 digits with mpmath: the first 16 of them are refuted."""
    sextic = {"hamiltonian": 'H = "p**2/2 + q**2/2 + b*q**6"', "symbols": 'b = "positive"'}
    (near,) = ask(action_claim("7.467009871041309", fixed='{E = "2", b = "1"}'), space=LINE, **sextic)
    assert near.status == "refuted"
    assert near.method == "certified quadrature"
    assert near.detail["value"] == "7.46700987104"
    assert near.detail["residual"].startswith("-3")


def test_conditions_on_the_momentum_are_certified_along_the_orbit(ask):
    sections = {"hamiltonian": 'H = "(p**2 + q**2)/2"', "domain": 'where = ["p > -3"]'}
    right, wrong, rate = ask(
        action_claim("2*pi*E"),
        action_claim("2.001*pi*E"),
        action_claim("1/(2*pi)", kind="frequency"),
        space=LINE,
        **sections,
    )
    assert (right.status, wrong.status, rate.status) == ("supported", "refuted", "supported")
    assert right.numeric.max_residual <= right.numeric.bound < 1e-13
    assert Fraction(wrong.witness["E"]) < Fraction(9, 2)  # of an orbit within p > -3


@pytest.mark.parametrize("bound", ["q + b > 0", "q < b"])
def test_an_end_of_the_range_may_be_a_constant(status, bound):
    """No closed form has it, and no example's motion can be made without a value for it."""
    sections = {"symbols": 'b = "real"', "hamiltonian": 'H = "p**2/2 + q**4/4"', "domain": f'where = ["{bound}"]'}
    assert status(action_claim("2*pi*E"), space=LINE, **sections) in ("undecided", "refuted")


def test_the_same_claims_made_in_python():
    space = PhaseSpace("r theta", "p_r p_theta", positive="r m a M")
    r, m, a, M, p_theta = space.symbols("r m a M p_theta")
    E = sp.Symbol("E", real=True)
    H = (space.p[0] ** 2 + p_theta**2 / r**2) / (2 * m) - a / r
    J = 2 * sp.pi * (a * sp.sqrt(m / (-2 * E)) - M)
    assert verify(action(space, H, r, E, J, fixed={p_theta: M})).status == "proved"
    assert verify(action(space, H, r, E, J + sp.pi, fixed={p_theta: M})).status == "refuted"
    assert verify(frequency(space, H, r, E, 1 / J.diff(E), fixed={p_theta: M})).status == "proved"
    rotor = PhaseSpace("q", "p")
    (momentum,) = rotor.p
    turn = action(
        rotor, momentum**2 / 2, rotor.q[0], E, 4 * sp.pi * sp.sqrt(2 * E), branch="rotation", period=4 * sp.pi
    )
    assert verify(turn).status == "proved"


@pytest.mark.parametrize("H", ["(p**2 + q**2)/2", "-(p**2 + q**2)/2"])
def test_the_orbit_is_run_through_in_the_sense_of_the_motion(ask, H):
    """A negative mass turns the sense round: J = 2 pi E < 0, and dE/dJ stays positive."""
    claims = (action_claim("2*pi*E"), action_claim("-2*pi*E"), action_claim("1/(2*pi)", kind="frequency"))
    assert [v.status for v in ask(*claims, space=LINE, hamiltonian=f'H = "{H}"')] == ["proved", "refuted", "proved"]
    domain = 'where = ["p > -3"]'
    inside = ask(*claims, space=LINE, hamiltonian=f'H = "{H}"', domain=domain)
    assert [v.status for v in inside] == ["supported", "refuted", "supported"]


def test_a_frequency_differentiates_at_constants_that_the_energy_does_not_move(ask):
    """With L given by E, dE/dJ along that curve would be no frequency of the motion."""
    sections = {"hamiltonian": 'H = "(p_r**2 + p_theta**2/r**2)/2 - 1/r"', "symbols": 'r = "positive"\nE = "negative"'}
    along_the_curve = "1/(2*pi*(1/sqrt(-2*E)**3 + 1/(2*sqrt(-E))))"
    with pytest.raises(InputError, match="held fixed"):
        ask(action_claim(along_the_curve, "r", "frequency", fixed='{p_theta = "sqrt(-E)"}'), space=PLANE, **sections)
    claim = action_claim("2*pi*(1/sqrt(-2*E) - sqrt(-E))", "r", fixed='{p_theta = "sqrt(-E)"}')
    assert ask(claim, space=PLANE, **sections)[0].status == "proved"


@pytest.mark.parametrize(("symbol", "expected"), [("positive", "undecided"), ("negative", "undecided")])
def test_a_momentum_of_one_sign_librates_nowhere(status, symbol, expected):
    sections = {"symbols": f'p = "{symbol}"', "hamiltonian": 'H = "(p**2 + q**2)/2"'}
    assert status(action_claim("2*pi*E"), space=LINE, **sections) == expected


def test_a_rotation_has_a_positive_momentum(status):
    sections = {"symbols": 'p = "positive"', "hamiltonian": 'H = "p**2/2 - cos(q)"'}
    turn = action_claim("4*sqrt(2*(E+1))*elliptic_e(2/(E+1))", branch='"rotation"')
    assert status(turn, space=LINE, **sections) == "proved"


def test_a_pole_whose_coefficient_may_be_0_is_no_crash(status):
    nought = "(2*atan(sqrt((1 - cos(1))/(1 + cos(1)))) - 1)"  # 0, which is hard to show
    claim = 'kind = "action"\ncoordinate = "q"\nenergy = "E"\nequals = "2*pi*E"'
    hamiltonian = f'H = "p**2/2 + q**2/2 + {nought}/q**2"'
    assert status(claim, symbols='E = "positive"', hamiltonian=hamiltonian) in ("undecided", "supported", "proved")


@pytest.mark.parametrize(
    ("equals", "where", "expected"),
    [
        ("2*pi*E/sqrt(abs(a))", "a > -5", ("proved",)),
        ("2*pi*E/sqrt(abs(a)) + a - abs(a)", "a > -5", ("refuted",)),
        ("2*pi*E/sqrt(abs(a)) + a - abs(a)", "a > -1e-30", ("supported", "refuted")),  # it fails where a < 0
    ],
)
def test_an_absolute_value_of_a_constant(status, equals, where, expected):
    claim = f'kind = "action"\ncoordinate = "q"\nenergy = "E"\nequals = "{equals}"'
    hamiltonian, symbols = 'H = "p**2/2 + abs(a)*q**2/2"', 'E = "positive"\na = "real"'
    assert status(claim, symbols=symbols, hamiltonian=hamiltonian, domain=f'where = ["{where}"]') in expected


@pytest.mark.parametrize(
    ("equals", "kind", "expected"),
    [
        ("2*pi*(w - sqrt(w**2 - 2*k*E))/k", "action", "proved"),
        ("2*pi*(w - sqrt(w**2 - 2*k*E))/(1001/1000*k)", "action", "refuted"),
        ("sqrt(w**2 - 2*k*E)/(2*pi)", "frequency", "proved"),
        ("w/(2*pi)", "frequency", "refuted"),
    ],
)
@pytest.mark.parametrize("where", ["w**2 > 2*k*E", "E > 0"])
def test_an_oscillator_whose_mass_depends_on_the_position(status, equals, kind, expected, where):
    """The integrand has poles off the real line (Mathews and Lakshmanan 1974, Quarterly of Applied Mathematics 32)."""
    keys = {
        "symbols": 'w = "positive"\nk = "positive"\nE = "positive"',
        "hamiltonian": 'H = "p**2*(1 + k*q**2)/2 + w**2*q**2/(2*(1 + k*q**2))"',
        "domain": f'where = ["{where}"]',
    }
    assert status(action_claim(equals, kind=kind), space=LINE, **keys) == expected
