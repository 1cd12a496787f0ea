"""Action and angle variables (course section 14.5): canonical, K of the momenta alone, cycles that close once."""

import pytest
import sympy as sp

from canon.catalogue import files
from canon.claims.action_angle import _parts
from canon.claims.cycle_lattice import _is_no_integer
from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.transformation import Transformation

SPACE = 'q = ["q"]\np = ["p"]\nQ = ["w"]\nP = ["J"]\n'
OSCILLATOR = {
    "symbols": 'm = "positive"\nomega = "positive"\nJ = "positive"',
    "hamiltonian": 'H = "p**2/(2*m) + m*omega**2*q**2/2"',
}
MAP = 'q = ["sqrt(J/(pi*m*omega))*sin(2*pi*w)"]\np = ["sqrt(m*omega*J/pi)*cos(2*pi*w)"]'


def angle_claim(period: str | None = None) -> str:
    return 'kind = "action_angle"' + (f'\nangle_period = "{period}"' if period else "")


@pytest.mark.parametrize(
    ("transformation", "period", "expected"),
    [
        (MAP, None, "proved"),
        (MAP, "2", "refuted"),  # that is two turns
        (MAP, "3", "refuted"),
        (MAP, "1/2", "refuted"),
        (MAP, "1.001", "refuted"),
        (MAP, "1 + 10**-60", "refuted"),  # off by less than the balls know by which turns are counted
        (MAP, "1/2 + 10**-60", "refuted"),
        (MAP, "-1", "proved"),  # backwards
        (MAP.replace("sin", "-sin"), None, "refuted"),  # not canonical
        (MAP.replace("2*pi*w", "2*pi*(w + J)"), None, "proved"),  # another origin on each orbit
        (MAP.replace("pi*m", "m").replace("J/pi", "J").replace("2*pi*w", "2*w"), None, "refuted"),
        (MAP.replace("pi*m", "m").replace("J/pi", "J").replace("2*pi*w", "2*w"), "pi", "proved"),
        ('q = ["w"]\np = ["J"]', None, "refuted"),  # canonical, but H depends on the angle
    ],
)
def test_the_oscillator(status, transformation, period, expected):
    assert status(angle_claim(period), space=SPACE, transformation=transformation, **OSCILLATOR) == expected


MORSE = {
    "symbols": 'c = "positive"\na = "positive"\nm = "positive"\nJ = "positive"',
    "definitions": 'k = "1 - a*J/c"\ne = "sqrt(a*J*(2*c - a*J))/c"',
    "hamiltonian": 'H = "(p**2 + c**2*(1 - exp(-a*q))**2)/(2*m)"',
    "domain": 'where = ["a*J < c"]',
}
MORSES = 'q = ["log((1 + e*sin(w))/k**2)/a"]\np = ["c*k*e*cos(w)/(1 + e*sin(w))"]'


@pytest.mark.parametrize(("where", "period"), [("c*k*e", "2*pi"), ("1001/1000*c*k*e", "2*pi"), ("c*k*e", "4*pi")])
def test_a_well_whose_orbits_are_bound_below_an_energy(status, where, period):
    """The cycles fill a connected domain though the conditions on it have several names, and a sine."""
    mutant = where != "c*k*e" or period != "2*pi"
    found = status(angle_claim(period), space=SPACE, transformation=MORSES.replace("c*k*e", where), **MORSE)
    assert found == ("refuted" if mutant else "proved")


PENDULUM = {
    "definitions": 'k = "p**2/4 + sin(q/2)**2"',
    "hamiltonian": 'H = "p**2/2 - cos(q)"',
    "domain": 'where = ["k < 1", "-pi < q < pi", "p > 0"]',
}
PHASE, LIBRATION = "elliptic_f(asin(sin(q/2)/sqrt(k)), k)", "16*(elliptic_e(k) - (1 - k)*elliptic_k(k))"


@pytest.mark.parametrize(
    ("factor", "J", "period", "expected"),
    [
        ("1/4", LIBRATION, "1", "proved"),
        ("-1/4", f"-{LIBRATION}", "1", "proved"),
        ("1/2", f"({LIBRATION})/2", "2", "proved"),
        ("1/4", f"{LIBRATION} + 3", "1", "proved"),  # an action from another origin
        ("1/2", f"({LIBRATION})/2", "1", "refuted"),
        ("1/4", LIBRATION, "1001/1000", "refuted"),
        ("1/4", LIBRATION.replace("1 - k", "1 - 1001/1000*k"), "1", "refuted"),
        ("1/4", f"{LIBRATION} + q**3/1000", "1", "refuted"),
    ],
)
def test_an_angle_on_a_part_of_its_cycle_by_the_action(ask, factor, J, period, expected):
    """Goldstein, Poole and Safko (2002), section 10.6: compared with the action in closed form, nothing is inverted."""
    forward = f'Q = ["{factor}*{PHASE}/elliptic_k(k)"]\nP = ["{J}"]'
    (verdict,) = ask(angle_claim(period), space=SPACE, transformation=forward, **PENDULUM)
    assert verdict.status == expected
    if expected == "proved":
        assert verdict.detail["cycle of w"] == f"a libration, dJ/dP = {period}"


@pytest.mark.parametrize(("period", "expected"), [("1", "proved"), ("2", "refuted")])
def test_a_turn_of_a_rotation_by_the_action(status, period, expected):
    forward = 'Q = ["elliptic_f(q/2, 1/k)/(2*elliptic_k(1/k))"]\nP = ["8*sqrt(k)*elliptic_e(1/k)"]'
    beyond = {**PENDULUM, "domain": 'where = ["k > 1", "-pi < q < pi", "p > 0"]'}
    assert status(angle_claim(period), space=SPACE, transformation=forward, **beyond) == expected


def test_orbits_that_need_not_be_the_closed_forms_are_not_compared(ask):
    """With k > 1 on a part of the domain the libration's action says nothing there."""
    forward = 'Q = ["elliptic_f(q/2, 1/k)/(2*elliptic_k(1/k))"]\nP = ["8*sqrt(k)*elliptic_e(1/k)"]'
    both = {**PENDULUM, "domain": 'where = ["k > 1/2", "-pi < q < pi", "p > 0"]'}
    (verdict,) = ask(angle_claim(), space=SPACE, transformation=forward, **both)
    assert verdict.status in ("undecided", "supported")


def test_what_fails_is_named(ask):
    (verdict,) = ask(angle_claim("2"), space=SPACE, transformation=MAP, **OSCILLATOR)
    assert verdict.detail["fails"] == "the cycle of w is closed after 1/2 of the period already"
    assert verdict.witness is None
    (verdict,) = ask(angle_claim("1.001"), space=SPACE, transformation=MAP, **OSCILLATOR)
    assert "after a period of w" in verdict.detail["fails"]
    assert set(verdict.witness) == {"J", "m", "omega", "w"}
    (verdict,) = ask(angle_claim(), space=SPACE, transformation=MAP, **OSCILLATOR)
    assert verdict.detail["cycle of w"] == "closed in (q, p)"


def test_bounds_on_the_angle_leave_the_cycle_whole(status):
    domain = 'where = ["0 < w < 1"]'
    assert status(angle_claim(), space=SPACE, transformation=MAP, domain=domain, **OSCILLATOR) == "proved"


def test_rotations_close_where_a_coordinate_has_grown_by_2_pi(ask):
    rotor = {"symbols": 'I = "positive"', "hamiltonian": 'H = "p**2/(2*I)"'}
    right, wrong = ask(
        angle_claim(), angle_claim("2"), space=SPACE, transformation='q = ["2*pi*w"]\np = ["J/(2*pi)"]', **rotor
    )
    assert (right.status, wrong.status) == ("proved", "refuted")
    assert right.detail["cycle of w"] == "q grows by 2*pi"


def test_sampling_knows_rotations_and_takes_no_two_turns_for_one(ask):
    rotor = {"symbols": 'I = "positive"', "hamiltonian": 'H = "p**2/(2*I)"', "space": SPACE}
    plain = {"transformation": 'q = ["2*pi*w"]\np = ["J/(2*pi)"]', "options": {"method": "numeric"}}
    right, wrong, twice = ask(angle_claim(), angle_claim("1/2"), angle_claim("2"), **rotor, **plain)
    assert [v.status for v in (right, wrong, twice)] == ["supported", "refuted", "undecided"]
    assert right.numeric.points == 1000
    assert "closed after 1/2 of the period" in twice.detail["note"]
    plain["options"] = {"method": "all"}
    assert [v.status for v in ask(angle_claim(), angle_claim("1/2"), angle_claim("2"), **rotor, **plain)] == [
        "proved", "refuted", "refuted",
    ]  # fmt: skip


def test_a_cycle_may_go_round_several_angles_at_once(ask, status):
    space = 'q = ["a", "b"]\np = ["pa", "pb"]\nQ = ["u", "v"]\nP = ["J", "K"]\n'
    two = {"space": space, "hamiltonian": 'H = "pa**2/2 + pb**2"'}
    unimodular = 'q = ["2*pi*(u + 3*v)", "2*pi*v"]\np = ["J/(2*pi)", "(K - 3*J)/(2*pi)"]'
    (verdict,) = ask(angle_claim(), transformation=unimodular, **two)
    assert verdict.status == "proved"
    assert verdict.detail["cycle of v"] == "a grows by 6*pi, b grows by 2*pi"
    doubled = 'q = ["2*pi*(u + 4*v)", "4*pi*v"]\np = ["J/(2*pi)", "(K - 4*J)/(4*pi)"]'
    assert status(angle_claim(), transformation=doubled, **two) == "refuted"
    assert status(angle_claim(), transformation=unimodular.replace("3", "3/2"), **two) == "refuted"


def test_turns_that_differ_from_part_to_part_refute_nothing(ask):
    rotor = {"symbols": 'J = "nonzero"', "hamiltonian": 'H = "p**2/2"'}
    either = 'q = ["2*pi*w*sign(J)"]\np = ["J*sign(J)/(2*pi)"]'
    (verdict,) = ask(angle_claim(), space=SPACE, transformation=either, **rotor)
    assert verdict.status == "undecided"
    assert "other parts of the domain" in verdict.detail["note"]


def test_two_degrees_of_freedom(status):
    space = 'q = ["x", "y"]\np = ["px", "py"]\nQ = ["u", "v"]\nP = ["J", "K"]\n'
    both = {
        "symbols": 'a = "positive"\nJ = "positive"\nK = "positive"',
        "hamiltonian": 'H = "(px**2 + x**2)/2 + a*(py**2 + y**2)/2"',
    }
    straight = 'q = ["sqrt(2*J)*sin(u)", "sqrt(2*K)*sin(v)"]\np = ["sqrt(2*J)*cos(u)", "sqrt(2*K)*cos(v)"]'
    assert status(angle_claim("2*pi"), space=space, transformation=straight, **both) == "proved"
    twisted = straight.replace("(u)", "(u + v)").replace("sqrt(2*K)", "sqrt(2*K - 2*J)")
    assert status(angle_claim("2*pi"), space=space, transformation=twisted, **both) == "proved"  # unimodular
    doubled = straight.replace("(u)", "(2*u)").replace("(2*J)", "(J)")
    assert status(angle_claim("2*pi"), space=space, transformation=doubled, **both) == "refuted"


@pytest.mark.parametrize(
    ("sections", "line", "words"),
    [
        ('[hamiltonian]\nH = "p**2*t"\n', angle_claim(), "without time"),
        ('[hamiltonian]\nH = "p**2"\n', angle_claim("0"), "and not 0"),
    ],
)
def test_bad_input(sections, line, words):
    text = f'[phase_space]\n{SPACE}{sections}[transformation]\nq = ["w"]\np = ["J"]\n[[claim]]\n{line}'
    reading = read_text(text)
    assert not reading.problems
    with pytest.raises(Exception, match=words):
        verify(reading.claims[0])


def test_the_same_claim_made_in_python():
    space = PhaseSpace("q", "p", new=("w", "J"), positive="J")
    w, J, q, p = space.symbols("w J q p")
    pair = Transformation(space, q=sp.sqrt(2 * J) * sp.sin(w), p=sp.sqrt(2 * J) * sp.cos(w))
    assert verify(pair.action_angle((q**2 + p**2) / 2, 2 * sp.pi)).status == "proved"
    assert verify(pair.action_angle((q**2 + p**2) / 2)).status == "refuted"
    assert verify(pair.action_angle(q**2 + p**2 + q, 2 * sp.pi)).status == "refuted"


@pytest.mark.parametrize(
    ("lhs", "rhs", "expected"),
    [
        ("elliptic_k(-n)*sqrt(1 + n)", "elliptic_k(n/(1 + n))", "proved"),
        ("elliptic_e(-n)", "elliptic_e(n/(1 + n))*sqrt(1 + n)", "proved"),
        ("elliptic_e(x)", "elliptic_e(x/(x - 1))*sqrt(1 - x)", "proved"),
        ("elliptic_k(x)", "elliptic_k(x/(x - 1))*sqrt(1 - x)", "refuted"),
        ("elliptic_e(x)", "elliptic_e(x/(x - 1))*sqrt(1 - x)*1001/1000", "refuted"),
        ("2*elliptic_k(-3)", "elliptic_k(3/4)", "proved"),
    ],
)
def test_complete_integrals_of_a_negative_parameter(status, lhs, rhs, expected):
    """DLMF 19.7.2: what the actions of a bead on a parabola in closed form and by its angle differ by."""
    claim = f'kind = "identity"\nlhs = "{lhs}"\nrhs = "{rhs}"'
    assert status(claim, symbols='n = "positive"\nx = "real"') == expected


@pytest.mark.parametrize(
    ("H", "transformation", "domain"),
    [
        ("p**2/2 + abs(q) - q", 'q = ["2*pi*w"]\np = ["J/(2*pi)"]', "q > 0"),
        ("(p**2 + q**2)/2 + (abs(p - 5) + p - 5)**2", MAP, "p < 5"),
    ],
)
def test_a_cycle_that_leaves_the_domain_at_a_kink_of_H(ask, H, transformation, domain):
    """On the other side of the kink the orbits are others: nothing is proved of where the formulas lead."""
    sections = {**OSCILLATOR, "hamiltonian": f'H = "{H}"', "domain": f'where = ["{domain}"]'}
    plain = transformation.replace("*m*omega", "").replace("m*omega*", "")
    (verdict,) = ask(angle_claim(), space=SPACE, transformation=plain, **sections)
    assert verdict.status == "supported"
    assert "whether the cycles stay" in verdict.detail["note"]
    smooth = {**sections, "hamiltonian": 'H = "p**2/2"' if "q**2" not in H else 'H = "(p**2 + q**2)/2"'}
    (verdict,) = ask(angle_claim(), space=SPACE, transformation=plain, **smooth)
    assert verdict.status in ("proved", "supported")
    assert "whether the cycles stay" not in verdict.detail.get("note", "")


@pytest.mark.parametrize(
    ("number", "between"),
    [
        (sp.Rational(1, 2), True),
        (1 / (2 * sp.pi), True),
        (sp.Integer(3), False),
        (sp.sqrt(3 + 2 * sp.sqrt(2)) - sp.sqrt(2), False),  # 1, though it doesn't look like it
        (sp.Symbol("k", integer=True) / 2, False),
        (sp.Integer(1) + sp.Rational(1, 10**20), False),  # too near to be told apart by digits
    ],
)
def test_an_advance_refutes_only_where_it_is_seen_to_lie_between_integers(number: sp.Expr, between: bool) -> None:
    assert _is_no_integer(number) is between


@pytest.mark.slow
def test_a_period_that_is_off_by_ever_so_little_is_not_proved() -> None:
    text = next(file for file in files() if file.name == "kepler-angles-plane.toml").read_text(encoding="utf-8")
    assert '"2*pi"' in text
    claim = read_text(text.replace('"2*pi"', '"2*pi*(1 + 10**-20)"')).claims[0]
    assert claim.kind == "action_angle"
    assert verify(claim).status != "proved"


@pytest.mark.parametrize(("sign", "status"), [("real", "proved"), ("positive", "undecided"), ("negative", "undecided")])
def test_an_angle_has_no_sign(sign, status):
    """H = p leads out of the half-line on which q is said to be: q isn't an angle there."""
    text = f"""
    [phase_space]
    {SPACE}
    [symbols]
    q = "{sign}"
    [hamiltonian]
    H = "p"
    [transformation]
    q = ["w"]
    p = ["J"]
    [[claim]]
    {angle_claim("2*pi")}
    """
    (read,) = read_text(text.replace("    ", "")).claims
    assert verify(read).status == status


@pytest.mark.parametrize("period", [sp.S.NegativeOne, 2 * sp.pi, sp.Symbol("k", negative=True)])
def test_a_part_of_a_turn_runs_upwards_whichever_way_round_the_cycle_is_gone(period):
    assert all((high - low).is_positive for low, high in _parts(period))


@pytest.mark.slow
def test_a_negative_period_of_a_map_that_is_inverted(status):
    sections = {"hamiltonian": 'H = "(p**2 + q**2)/2"'}
    sections["transformation"] = 'Q = ["-atan2(q, p)/(2*pi)"]\nP = ["-pi*(q**2 + p**2)"]'
    assert status(angle_claim("-1"), space=SPACE, **sections) in ("proved", "supported")


def test_a_parameter_that_stands_in_the_period_alone(status):
    """It is a name of the point at which the cycle is followed."""
    sections = {"symbols": 'k = "real"', "hamiltonian": 'H = "(p**2 + q**2)/2"'}
    sections["transformation"] = 'Q = ["atan2(q, p)"]\nP = ["(q**2 + p**2)/2"]'
    space = 'q = ["q"]\np = ["p"]\nQ = ["Q"]\nP = ["P"]\n'
    assert status(angle_claim("2*pi*sqrt(k**2)/k"), space=space, **sections) in ("supported", "refuted")
