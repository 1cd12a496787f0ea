"""Actions between roots: wells of cubics and quartics, areas inside a separatrix, loops at a double root."""

import pytest

from canon.errors import InputError
from tests.claims.test_action import LINE, action_claim


@pytest.mark.parametrize(
    ("potential", "domain", "energy", "area"),
    [
        ("q**4/4 - q**2/2", 'where = ["q > 0"]', "0", "4/3"),
        ("a*q**4/4 - q**2/2", 'where = ["q > 0"]', "0", "4/(3*a)"),
        ("q**2/2 - q**4/4", "", "1/4", "4*sqrt(2)/3"),
        ("q**2/2 - a*q**4/4", "", "1/(4*a)", "4*sqrt(2)/(3*a)"),
    ],
)
def test_the_area_inside_a_separatrix_of_a_quartic(status, potential, domain, energy, area):
    sections = {"symbols": 'a = "positive"', "hamiltonian": f'H = "p**2/2 + {potential}"', "domain": domain}
    for value, expected in ((area, "proved"), (f"{area} + 1/10**9", "refuted")):
        assert status(action_claim(value, fixed=f'{{E = "{energy}"}}'), space=LINE, **sections) == expected


@pytest.mark.parametrize(("potential", "expected"), [("b*cos(q)", "proved"), ("b**2*tan(q)**2", "supported")])
def test_the_images_of_a_well_under_a_translation_are_the_same_well(status, potential, expected):
    areas = {
        "b*cos(q)": "16*sqrt(abs(b))*(elliptic_e((1+E/abs(b))/2) - (1-E/abs(b))/2*elliptic_k((1+E/abs(b))/2))",
        "b**2*tan(q)**2": "2*pi*(sqrt(2*E + 2*b**2) - sqrt(2)*abs(b))",
    }
    sections = {"symbols": 'b = "nonzero"', "hamiltonian": f'H = "p**2/2 + {potential}"'}
    assert status(action_claim(areas[potential], branch='"libration"'), space=LINE, **sections) == expected
    assert status(action_claim("1", branch='"libration"'), space=LINE, **sections) == "refuted"


def test_a_period_that_shows_at_the_constants_alone_has_images_and_other_wells(status):
    sections = {"symbols": 'a = "positive"', "hamiltonian": 'H = "p**2/2 + tan(a*q)**2"'}
    for value, expected in (("2*pi/a*(sqrt(2*E + 2) - sqrt(2))", "supported"), ("2*pi*E", "refuted")):
        assert status(action_claim(value, fixed='{a = "2/5"}'), space=LINE, **sections) == expected
    unlike = {"hamiltonian": 'H = "p**2/2 + cos(8*q/5) + cos(4*q/5)/10"'}
    with pytest.raises(InputError, match="more than one well"):
        status(action_claim("1", fixed='{E = "1/2"}', branch='"libration"'), space=LINE, **unlike)


ROOTS = {
    "hamiltonian": 'H = "p**2/2 - q**3/2 + q**2*(a + b + c)/2 - q*(a*b + b*c + a*c)/2"',
    "symbols": 'a = "real"\nb = "real"\nc = "real"\nE = "real"',
    "domain": 'where = ["a < b", "b < c"]',
}
CUBIC = "4/15*sqrt(c-a)**5*(2*(M**2-M+1)*elliptic_e(M) - (1-M)*(2-M)*elliptic_k(M))".replace("M", "((b-a)/(c-a))")


@pytest.mark.parametrize(
    ("equals", "kind", "expected"),
    [
        (CUBIC, "action", "proved"),
        (CUBIC.replace("4/15", "4001/15000"), "action", "refuted"),
        (CUBIC.replace("(2-", "(3-"), "action", "refuted"),
        ("sqrt(c - a)/(4*elliptic_k((b-a)/(c-a)))", "frequency", "proved"),
        ("1001*sqrt(c - a)/(4000*elliptic_k((b-a)/(c-a)))", "frequency", "refuted"),
    ],
)
def test_the_well_of_a_cubic_by_its_roots(status, equals, kind, expected):
    assert status(action_claim(equals, kind=kind, fixed='{E = "-a*b*c/2"}'), space=LINE, **ROOTS) == expected


def test_roots_of_unknown_order_are_not_argued_about(status):
    """Where c may lie below a, the well is another one: true for a < b < c alone."""
    open_order = {**ROOTS, "domain": 'where = ["a < b", "c > b - 1"]'}
    claim = action_claim(CUBIC.replace("sqrt(c-a)**5", "abs(c-a)**(5/2)"), fixed='{E = "-a*b*c/2"}', well='"(a+b)/2"')
    assert status(claim, space=LINE, **open_order) != "proved"


@pytest.mark.parametrize(("factor", "well", "expected"), [("2", "(a+b)/2", "proved"), ("2.001", "-(a+b)/2", "refuted")])
def test_either_well_of_an_even_quartic_by_a_point_inside(status, factor, well, expected):
    equals = f"{factor}*b/3*((a**2+b**2)*elliptic_e(1-a**2/b**2) - 2*a**2*elliptic_k(1-a**2/b**2))"
    sections = {"symbols": 'a = "positive"\nb = "positive"', "domain": 'where = ["a < b"]'}
    claim = action_claim(equals, fixed='{E = "0"}', well=f'"{well}"')
    assert status(claim, space=LINE, hamiltonian='H = "p**2/2 + (q**2-a**2)*(q**2-b**2)/2"', **sections) == expected


def test_the_order_of_roots_and_ends_follows_from_sums_of_conditions(status):
    """0 < a < b: b > 0 is neither of them."""
    inside = {**ROOTS, "domain": 'where = ["a < b", "b < c", "q > 0", "a > 0"]'}
    assert status(action_claim(CUBIC, fixed='{E = "-a*b*c/2"}'), space=LINE, **inside) == "proved"
    cut = {**ROOTS, "domain": 'where = ["a < b", "b < c", "q > 0"]'}
    assert status(action_claim(CUBIC, fixed='{E = "-a*b*c/2"}'), space=LINE, **cut) != "proved"


LOOPS = 'H = "p**2/2 - q**2*(q + 1)*(2 - q)/2"'
LEFT, RIGHT = (f"(76*sqrt(2) + 54*asin(1/3) {sign} 27*pi)/48" for sign in "-+")
HYPERBOLIC = 'H = "p**2/2 - (q - 3)**2*(q - 1)*(q + 2)/2"'


@pytest.mark.parametrize(
    ("hamiltonian", "equals", "keys", "expected"),
    [
        ('H = "p**2/2 + q**2/2 - q**3/3"', "6/5", {"fixed": '{E = "1/6"}'}, "proved"),
        ('H = "p**2/2 + q**2/2 + q**3/3"', "6/5", {"fixed": '{E = "1/6"}'}, "proved"),
        ('H = "p**2/2 + q**2/2 - q**3/3"', "6001/5000", {"fixed": '{E = "1/6"}'}, "refuted"),
        (LOOPS, LEFT, {"fixed": '{E = "0"}', "well": '"-1/2"'}, "proved"),
        (LOOPS, RIGHT, {"fixed": '{E = "0"}', "well": '"1"'}, "proved"),
        (LOOPS, LEFT, {"fixed": '{E = "0"}', "well": '"1"'}, "refuted"),
        (HYPERBOLIC, "67*sqrt(10)/12 - 63*acosh(7/3)/8", {"fixed": '{E = "0"}'}, "proved"),
        (HYPERBOLIC, "67*sqrt(10)/12 - 63*acosh(5/3)/8", {"fixed": '{E = "0"}'}, "refuted"),
    ],
)
def test_loops_at_a_double_root_are_elementary(status, hamiltonian, equals, keys, expected):
    assert status(action_claim(equals, **keys), space=LINE, hamiltonian=hamiltonian) == expected


def test_two_loops_are_ambiguous(ask):
    with pytest.raises(InputError, match="2 wells"):
        ask(action_claim(LEFT, fixed='{E = "0"}'), space=LINE, hamiltonian=LOOPS)


NO_LOOP = "p**2/2 - (q**2 + 1)*(q - 1/2)**4/2"


@pytest.mark.parametrize(
    ("H", "symbol", "equals", "expected"),
    [
        (NO_LOOP, 'q = "real"', "-25*sqrt(5)/96", "not bounded"),  # E - V has no root where a loop would end
        ("q**2*(p**2/2 + q**2 - 1)", 'q = "nonzero"', "pi*sqrt(2)", "2 wells"),  # the motion stands still at q = 0
        ("p**2/(2*q) + q", 'q = "nonzero"', "1", "no minimum"),  # it ends at q = 0, where H isn't defined
        ("q**2*(p**2 + q**2 - 1)", 'q = "real"', "pi", "2 wells"),
    ],
)
def test_what_is_no_orbit_has_no_action(ask, H, symbol, equals, expected):
    claim = action_claim(equals, fixed='{E = "0"}') if "(2*q)" not in H else action_claim(equals)
    with pytest.raises(InputError, match=expected):
        ask(claim, space=LINE, hamiltonian=f'H = "{H}"', symbols=symbol)
