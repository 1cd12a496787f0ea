"""Claims of actions that are ill-posed, or about which no motion is: what is said of them."""

from fractions import Fraction

import pytest
import sympy as sp

from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.domain import conditions_of
from canon.errors import InputError
from tests.claims.test_action import LINE, PLANE, action_claim


@pytest.mark.parametrize(
    ("H", "line", "words"),
    [
        ("p**2/2 - cos(q)", action_claim("1"), "say whether the branch"),
        ("p**2/2 - cos(q)", action_claim("1", branch='"orbit"'), "a branch is"),
        ("p**2/2 + q**2", action_claim("1", period='"2"'), "a period is one of a rotation"),
        ("p**2/2 - q**2", action_claim("1"), "no minimum, so that nothing is bound at any energy"),
        (
            "p**2/2 - q**2",
            action_claim("1", fixed='{E = "1"}'),
            "the motion at E = 1 is not bounded: the potential has no",
        ),
        ("p**2/2", action_claim("1"), "there is a rotation only"),
        ("p**2/2 + q**2*t", action_claim("1"), "H depends on t"),
        ("p**2/2 + q**2", action_claim("q"), "not of q"),
        ("p**2/2 + q**2", action_claim("1", fixed='{q = "1"}'), "q moves"),
        ("p**2/2 - cos(q)", action_claim("1", branch='"rotation"', period='"1"'), "not a period of H"),
        (
            "p**2/2 + q**2",
            action_claim("1", fixed='{E = "-1"}'),
            "no motion at E = -1; .* librations about q = 0",
        ),
        ("p**2/2 + q**2", action_claim("0", fixed='{E = "0"}'), "nothing moves: J = 0"),
        (
            "p**2/2 - cos(q)",
            action_claim("1", branch='"libration"', fixed='{E = "2"}'),
            "no libration at E = 2.* above 1",
        ),
        (
            "p**2/2 - cos(q)",
            action_claim("1", branch='"rotation"', fixed='{E = "0"}'),
            "no rotation at E = 0.*from -1 to 1",
        ),
        ("p**2/2 + q**2/2 - q**3/3", action_claim("1", fixed='{E = "1/2"}'), "not bounded.*from 0 to 0.16666"),
        ("p**2/2 + q**2/2 - q**3/3", action_claim("1", branch='"rotation"'), "H isn't periodic in q"),
        ("p**2/2 + q**4/4 - q**2/2", action_claim("4/3", fixed='{E = "0"}'), "2 wells have orbits at E = 0"),
        ("p**2/2 + (1-exp(-q))**2", action_claim("1", fixed='{E = "1"}'), "not bounded.*from 0 to 1"),
        (
            "p**2/2 + q**2/2",
            action_claim("2*pi", fixed='{E = "1"}', well='"7"'),
            "7 is not inside .* from -1.41421 to 1.41421",
        ),
        *(
            ("p**2/2", action_claim("0", branch='"rotation"', period=f'"{period}"'), "is no period: it is above 0")
            for period in ("0", "-1", "-2*pi", "2 - sqrt(5)")
        ),
        (
            "p**2/2 + cos(q) + cos(2*q)/3",
            action_claim("1", branch='"rotation"', period='"1"'),
            "1 is not a period of H",
        ),
        (
            "(p - 3)**2/2",
            action_claim("1", branch='"rotation"', period='"1"'),
            "both branches of the rotation have p > 0",
        ),
        (
            "p**2/2 - cos(q)",
            action_claim("1", kind="frequency", branch='"libration"', fixed='{E = "1"}'),
            "exactly that of the separatrix: the period is infinite.*from -1 to 1",
        ),
    ],
)
def test_bad_input(H, line, words):
    reading = read_text(f'[phase_space]\n{LINE}[symbols]\nE = "real"\n[hamiltonian]\nH = "{H}"\n[[claim]]\n{line}')
    assert not reading.problems
    with pytest.raises(Exception, match=words):
        verify(reading.claims[0])


def test_a_coordinate_that_does_not_separate():
    reading = read_text(
        f'[phase_space]\n{PLANE}[hamiltonian]\nH = "p_r**2 + p_theta**2 + r*theta"\n[[claim]]\n{action_claim("1", "r")}'
    )
    with pytest.raises(Exception, match="H depends on theta"):
        verify(reading.claims[0])


@pytest.mark.parametrize(
    ("keys", "words"),
    [({"coordinate": "x"}, "none of the coordinates q"), ({"fixed": '{z = "1"}'}, "unknown name 'z'")],
)
def test_faults_of_the_file(keys, words):
    coordinate = keys.pop("coordinate", "q")
    text = f'[phase_space]\n{LINE}[hamiltonian]\nH = "p**2"\n[[claim]]\n{action_claim("1", coordinate, **keys)}'
    assert words in read_text(text).problems[0]["message"]


@pytest.mark.parametrize("half", ["p > 0", "p + q > 0", "p > q", "q + p/1000 > 0"])
def test_half_a_phase_plane_holds_no_orbit(status, half):
    """The momentum is no bound of the coordinate: all orbits leave the half, so that nothing is proved or refuted."""
    sections = {"hamiltonian": 'H = "(p**2 + q**2)/2"', "domain": f'where = ["{half}"]'}
    assert status(action_claim("2*pi*E"), space=LINE, **sections) == "undecided"
    assert status(action_claim("2*pi*E + 1"), space=LINE, **sections) == "undecided"


def test_an_energy_that_is_not_quadratic_in_the_momentum_is_left_open(ask):
    (verdict,) = ask(action_claim("1"), space=LINE, hamiltonian='H = "p**4 - p**2 + q**2"')
    assert verdict.status == "undecided"
    assert "isn't quadratic in p" in verdict.detail["note"]


def test_two_wells_are_ambiguous(ask):
    sections = {"hamiltonian": 'H = "p**2/2 - q**2/2 + q**4/4"', "symbols": 'E = "negative"'}
    with pytest.raises(InputError, match="more than one well"):
        ask(action_claim("1"), space=LINE, **sections)
    (verdict,) = ask(action_claim("1", well='"1"'), space=LINE, **sections)
    assert verdict.status == "refuted"
    (verdict,) = ask(action_claim("1"), space=LINE, domain='where = ["q > 0"]', **sections)
    assert verdict.status == "refuted"


def test_a_mass_of_unknown_sign_leaves_the_sense_open(ask):
    sections = {"symbols": 'w = "nonzero"', "hamiltonian": 'H = "w*(p**2 + q**2)/2"'}
    right, wrong = ask(action_claim("2*pi*E/abs(w)"), action_claim("2*pi*E/w"), space=LINE, **sections)
    assert (right.status, wrong.status) == ("supported", "refuted")
    assert Fraction(wrong.witness["w"]) < 0


@pytest.mark.parametrize("H", ["p**2/2 + q**2/2 + 1j*q", "p**2/2 + c*q**2/2"])
def test_a_complex_hamiltonian_has_no_action(ask, H):
    claim = 'kind = "action"\ncoordinate = "q"\nenergy = "E"\nequals = "2*pi*E"'
    with pytest.raises(InputError, match="H is complex"):
        ask(claim, symbols='E = "positive"\nc = "complex"', hamiltonian=f'H = "{H}"')


def test_a_real_hamiltonian_in_complex_words(status):
    claim = 'kind = "action"\ncoordinate = "q"\nenergy = "E"\nequals = "2*pi*E"'
    assert status(claim, symbols='E = "positive"', hamiltonian='H = "(p - 1j*q)*(p + 1j*q)/2"') == "proved"


SOFT = {"hamiltonian": 'H = "p**2/2 + q**2/2 - q**4/4"', "space": LINE}


@pytest.mark.parametrize("kind", ["action", "frequency"])
@pytest.mark.parametrize("fixed", ['{E = "1/8"}', "{}"])
def test_a_well_beyond_the_barrier_is_none(ask, kind, fixed):
    """p² is positive beyond the barriers of a soft spring too, where nothing comes back."""
    with pytest.raises(InputError):
        ask(action_claim("1", kind=kind, well='"10"', fixed=fixed), **SOFT)


def test_the_loop_between_two_barriers_has_its_well_inside(ask):
    (inner,) = ask(action_claim("4*sqrt(2)/3", well='"1/2"', fixed='{E = "1/4"}'), **SOFT)
    assert inner.status == "proved"
    with pytest.raises(InputError, match="not bounded"):
        ask(action_claim("4*sqrt(2)/3", well='"2"', fixed='{E = "1/4"}'), **SOFT)


@pytest.mark.parametrize("method", ["symbolic", "numeric"])
def test_wells_far_apart_are_ambiguous(ask, method):
    """A hundred widths away: which orbit is meant isn't known, so that neither refutes."""
    H, options = 'H = "p**2/2 + q**2*(q - 100)**2/10000"', {"method": method}
    claim = action_claim("2*pi*E", fixed='{E = "1/100"}')
    with pytest.raises(InputError, match="2 wells"):
        ask(claim, space=LINE, hamiltonian=H, options=options)
    (verdict,) = ask(claim + '\nwell = "0"', space=LINE, hamiltonian=H, options=options)
    assert verdict.status == "refuted"


def test_what_is_fixed_is_so_in_a_period_and_a_well(ask):
    turn = action_claim("L*sqrt(2*E)", branch='"rotation"', period='"L"', fixed='{L = "3"}')
    inside = action_claim("4*sqrt(2)/3", well='"a"', fixed='{E = "1/4", a = "1/2"}')
    symbols = 'E = "positive"\nL = "real"\na = "real"'
    (free,) = ask(turn, space=LINE, symbols=symbols, hamiltonian='H = "p**2/2"')
    (bound,) = ask(inside, symbols=symbols, **SOFT)
    assert (free.status, bound.status) == ("proved", "proved")


def test_a_period_is_above_zero_wherever_it_is_one(ask):
    same = {"space": LINE, "symbols": 'E = "positive"\nL = "real"', "hamiltonian": 'H = "p**2/2"'}
    (forward,) = ask(action_claim("abs(L)*sqrt(2*E)", branch='"rotation"', period='"L"'), **same)
    (backward,) = ask(action_claim("L*sqrt(2*E)", branch='"rotation"', period='"-L"'), **same)
    assert (forward.status, backward.status) == ("proved", "refuted")


def test_a_period_stays_while_the_energy_changes(ask):
    claim = action_claim("2/(3*sqrt(2*E))", kind="frequency", branch='"rotation"', period='"E"')
    with pytest.raises(InputError, match="doesn't change with it"):
        ask(claim, space=LINE, symbols='E = "positive"', hamiltonian='H = "p**2/2"')


@pytest.mark.parametrize(
    ("word", "H", "fixed"),
    [
        ('k = "positive"', "p**2/2 + (abs(k) - k + 1)*q**2/2", '{k = "-1"}'),
        ('k = "positive"', "p**2/2 + (abs(k) - k + 1)*q**2/2", '{k = "0"}'),
        ('k = "integer"', "p**2/2 + cos(2*pi*k)*q**2/2", '{k = "1/2"}'),
        ('k = "real"', "p**2/2 + (k**2 + 1)*q**2/2", '{k = "1j"}'),
        ('E = "positive"', "-(p**2 + q**2)/2", '{E = "-1"}'),
    ],
)
@pytest.mark.parametrize("method", ["symbolic", "numeric"])
def test_a_name_is_fixed_at_what_is_assumed_of_it(ask, word, H, fixed, method):
    """|k| is k for positive k, and cos 2πk is 1 for whole numbers: in the formulas no other value can be put."""
    same = {"space": LINE, "symbols": word, "hamiltonian": f'H = "{H}"', "options": {"method": method}}
    with pytest.raises(InputError):
        ask(action_claim("2*pi", fixed=fixed), **same)
    average = 'kind = "average"\ncoordinate = "q"\nenergy = "E"\nf = "1"\nequals = "2"'
    with pytest.raises(InputError):
        ask(f"{average}\nfixed = {fixed}", **same)


SLOPES = action_claim("8*sqrt(2)/3*E**(3/2)")


@pytest.mark.parametrize("H", ["abs(q)", "abs(q) + 0*p", "sqrt(2)*abs(q)/sqrt(2)"])
def test_a_motion_goes_through_a_kink(status, H):
    assert status(SLOPES, space=LINE, symbols='E = "positive"', hamiltonian=f'H = "p**2/2 + {H}"') == "proved"


@pytest.mark.parametrize(
    "H", ["abs(q) + 0/q", "0/q + abs(q)", "abs(q) + 0/abs(q)", "abs(q) + 0*log(abs(q))", "0*log(q**2) + abs(q)"]
)
def test_no_motion_goes_through_a_pole_that_lies_in_a_kink(status, H):
    """|q| and 1/q both say q != 0, but |q| has a value there."""
    sections = {"space": LINE, "symbols": 'E = "positive"'}
    assert status(SLOPES, hamiltonian=f'H = "p**2/2 + {H}"', **sections) == "undecided"
    definitions = 'u = "abs(q)"\nv = "0/q"\nw = "u + v"'
    assert status(SLOPES, hamiltonian='H = "p**2/2 + w"', definitions=definitions, **sections) == "undecided"


@pytest.mark.parametrize(("section", "said"), [("domain", 'where = ["q != 0"]'), ("symbols", 'q = "nonzero"')])
def test_a_domain_without_the_kink_holds_no_such_motion(status, section, said):
    sections = {"space": LINE, "hamiltonian": 'H = "p**2/2 + abs(q)"', section: said}
    assert status(SLOPES, **sections) == "undecided"


CUBE = "4*sqrt(2)*E**(5/6)*gamma(1/3)*gamma(3/2)/(3*gamma(11/6))"


@pytest.mark.parametrize("V", ["abs(q)**3", "q**2*abs(q)", "abs(q**3)"])
def test_the_modulus_of_a_cube_is_a_well_like_others(status, V):
    sections = {"space": LINE, "symbols": 'E = "positive"', "hamiltonian": f'H = "p**2/2 + {V}"'}
    assert status(action_claim(CUBE), **sections) == "proved"
    assert status(action_claim(f"1001/1000*{CUBE}"), **sections) == "refuted"


def test_the_square_of_a_modulus_is_an_oscillator(status):
    sections = {"space": LINE, "hamiltonian": 'H = "p**2/2 + abs(q)**2/2"'}
    assert status(action_claim("2*pi*E"), **sections) == "proved"
    assert status(action_claim("2*pi*E"), domain='where = ["q != 0"]', **sections) == "undecided"


@pytest.mark.parametrize(
    "V",
    ["q*D(abs(q), q)", "abs(q) + 0*D(abs(q), q)", "0*D(sqrt(abs(q)), q) + abs(q)", "q*bracket(abs(q), p)",
     "u + 0*D(u, q)", "0*D(u, q) + u"],
)  # fmt: skip
def test_what_has_a_kink_has_no_slope_there(status, V):
    sections = {"space": LINE, "symbols": 'E = "positive"', "definitions": 'u = "abs(q)"'}
    assert status(SLOPES, hamiltonian=f'H = "p**2/2 + {V}"', **sections) == "undecided"
    smooth = f'H = "p**2/2 + abs(q) + 0*({V.replace("abs(q)", "q**2").replace("u", "p")})"'
    assert status(SLOPES, hamiltonian=smooth, **sections) == ("undecided" if "sqrt" in V else "proved")


def test_a_free_rotation_has_room_for_a_period(status):
    claim = action_claim("2*pi*sqrt(2*E)", branch='"rotation"', period='"2*pi"')
    sections = {"space": LINE, "hamiltonian": 'H = "p**2/2"'}
    assert status(claim, symbols='E = "positive"', **sections) == "proved"
    assert status(claim, symbols='E = "positive"', domain='where = ["-pi < q < pi"]', **sections) == "proved"
    with pytest.raises(InputError):
        status(claim, symbols='E = "positive"', domain='where = ["0 < q < 1"]', **sections)
    assert status(claim, symbols='E = "positive"\nq = "positive"', **sections) != "proved"


@pytest.mark.parametrize(
    "term",
    ["0/sqrt(abs(q))", "0*log(sqrt(abs(q)))", "0*sign(sqrt(abs(q)))", "0*sqrt(abs(q))**(-1)", "0/abs(q)**(3/2)",
     "0/(1 - exp(sqrt(abs(q))))", "0*log(abs(q) + sqrt(abs(q)))", "0*log(abs(q)**(1/3))"],
)  # fmt: skip
def test_a_root_of_a_modulus_is_positive_only_off_the_kink(status, term):
    """That √|q| isn't 0 shows from |q| > 0, of which nothing may be left where the kink is passed."""
    sections = {"space": LINE, "symbols": 'E = "positive"'}
    assert status(SLOPES, hamiltonian=f'H = "p**2/2 + abs(q) + {term}"', **sections) == "undecided"
    definitions = f'u = "abs(q)"\nv = "sqrt(u)"\nw = "{term.replace("sqrt(abs(q))", "v")}"'
    assert status(SLOPES, hamiltonian='H = "p**2/2 + u + w"', definitions=definitions, **sections) == "undecided"


@pytest.mark.parametrize("said", ["abs(q)**(1/2) > 0", "1 < 1 + sqrt(abs(q))", "exp(sqrt(abs(q))) > 1"])
def test_a_domain_that_excludes_a_kink_by_a_root(status, said):
    sections = {"space": LINE, "symbols": 'E = "positive"', "hamiltonian": 'H = "p**2/2 + abs(q)"'}
    assert status(SLOPES, domain=f'where = ["{said}"]', **sections) == "undecided"


def test_kinks_of_sympys_formulas():
    q = sp.Symbol("q", real=True)
    (kink,) = conditions_of(sp.Abs(q))
    assert kink.kink
    assert all(c.kink for c in conditions_of(sp.sqrt(sp.Abs(q)) + sp.Abs(q) ** 3))
    assert not any(c.kink for c in conditions_of(sp.Abs(q) + 0 * q + sp.log(sp.sqrt(sp.Abs(q)))))


@pytest.mark.parametrize(
    ("section", "said"),
    [
        ("transformation", 'Q = ["q + 0/q"]\nP = ["p"]'),
        ("transformation", 'Q = ["q"]\nP = ["p + sign(q)"]'),
        ("transformation", 'Q = ["abs(q)"]\nP = ["p"]'),
        ("transformation", 'q = ["Q"]\np = ["P + 0/Q"]'),
        ("domain", 'where = ["Q != 0"]'),
        ("symbols", 'E = "positive"\nQ = "nonzero"'),
    ],
)
def test_a_kink_of_H_implies_nothing_that_a_map_demands(status, section, said):
    """With Q = q + 0/q a file is about q != 0: that |q| says so, too, doesn't keep an orbit off."""
    sections = {"symbols": 'E = "positive"', "hamiltonian": 'H = "p**2/2 + abs(q)"',
                "transformation": 'Q = ["q"]\nP = ["p"]'}  # fmt: skip
    assert status(SLOPES, **sections) == "proved"
    assert status(SLOPES, **{**sections, section: said}) == "undecided"
