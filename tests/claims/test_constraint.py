"""Constraints: Frobenius' test, displacements, multipliers and reactions."""

import pytest

from canon.errors import InputError

SKATE = 'q = ["x", "y", "a"]\np = ["px", "py", "pa"]\n'
SYMBOLS = 'm = "positive"\ng = "positive"\nR = "positive"\nc = "nonzero"\nk = "real"\nV = "function"'
KNIFE = "vx*sin(a) - vy*cos(a)"
TWO_WHEELS = '["vx - R*w*cos(a)", "vy - R*w*sin(a)"]'  # rolling with the heading a turned by the wheel itself


def _claim(form: str, *keys: str, word: str = "forms") -> str:
    listed = form if form.startswith("[") else f'["{form}"]'
    return "\n".join(['kind = "constraint"', 'velocities = ["vx", "vy", "w"]', f"{word} = {listed}", *keys])


@pytest.mark.parametrize(
    ("form", "holonomic", "expected"),
    [
        (KNIFE, "false", "proved"),
        (KNIFE, "true", "refuted"),
        ("2*x*vx + 2*y*vy", "true", "proved"),
        ("2*x*vx + 2*y*vy", "false", "refuted"),
        ("y*vx - x*vy", "true", "proved"),  # an integrating factor: d(y/x)
        ("y*vx - 1001/1000*x*vy", "true", "proved"),
        ("y*vx - x*vy + a*w", "true", "refuted"),
        ("y*vx - x*vy + k*a*w", "true", "refuted"),
        ("y*vx - x*vy + k*a*w", "false", "refuted"),  # integrable where k is 0
        ("y*vx - x*vy + c*a*w", "false", "proved"),
        ("vx*sin(a) - vy*cos(a) + 1/1000", "false", "proved"),
        (TWO_WHEELS, "true", "proved"),  # y + R cos a and x - R sin a keep their values
        ('["vx*sin(a) - vy*cos(a)", "w - vx"]', "true", "proved"),  # two forms in three coordinates
        ('["vx*sin(a) - vy*cos(a)", "w - vx - t"]', "false", "proved"),
        ("x*vx + t*vy + y", "true", "proved"),
        ("x*vx + t*vy + 2*y", "false", "proved"),
        ("D(V(x*y, t), x)*vx + D(V(x*y, t), y)*vy + D(V(x*y, t), t) + c*w", "true", "proved"),
    ],
)
def test_frobenius(status, form, holonomic, expected):
    assert status(_claim(form, f"holonomic = {holonomic}"), space=SKATE, symbols=SYMBOLS) == expected


def test_a_refuted_integrability_names_the_coefficient(ask):
    (verdict,) = ask(_claim(KNIFE, "holonomic = true"), space=SKATE)
    assert "dx dy da" in verdict.detail["fails"]
    assert verdict.detail["value"] == "-1"


@pytest.mark.parametrize(
    ("form", "key", "detail"),
    [
        ("y*vx - x*vy + k*a*w", "holonomic", {"integrable_at": {"k": "0"}}),
        ("vx + V(y)*x*w", "holonomic", {"integrable_for": {"V": "0"}}),
        ("vx - (abs(y) + y)*w", "holonomic", {"integrable_where": "-y > 0"}),
        ("vx - k", "stationary", {"stationary_at": {"k": "0"}}),
        ("vx - y**2*a*w", "holonomic", {"frobenius": "coefficient of dx dy da in dω ∧ ω, form 1: -2*a*y"}),
    ],
)
def test_the_answer_says_for_which_values_forms_are_what_they_are_said_not_to_be(ask, form, key, detail):
    (verdict,) = ask(_claim(form, f"{key} = false"), space=SKATE, symbols=SYMBOLS)
    assert detail.items() <= dict(verdict.detail).items()
    assert "minor" not in verdict.detail  # one of columns that aren't derivatives


def test_forms_that_are_not_seen_to_be_integrable_or_not_say_which_coefficient_is_open(ask):
    """Beyond 10000 the slope of tanh y is less than every ball knows."""
    (verdict,) = ask(_claim("vx - tanh(y)*w", "holonomic = false"), space=SKATE, domain='where = ["y > 10000"]')
    assert verdict.status == "undecided"
    assert "is 0 on no open part of the domain" in verdict.detail["note"]


@pytest.mark.parametrize(
    ("form", "where"), [("(abs(y) + y)*vx", "where -y > 0"), ("(asin(sin(y)) - y)*vx", "near .*y = ")]
)
def test_forms_that_vanish_in_a_part_of_the_domain_are_told_where(ask, form, where):
    with pytest.raises(InputError, match=where):
        ask(_claim(form, "holonomic = true"), space=SKATE)


@pytest.mark.parametrize(
    ("form", "word", "stationary", "expected"),
    [
        ("x**2 + y**2 - R**2", "functions", "true", "proved"),
        ("x**2 + y**2 - R**2", "functions", "false", "refuted"),
        ("x**2 + y**2 - (R + c*t)**2", "functions", "true", "refuted"),
        ("x**2 + y**2 - (R + c*t)**2", "functions", "false", "proved"),
        ("vx - t*vy", "forms", "true", "refuted"),
        ("vx - c", "forms", "false", "proved"),
        ("vx - k", "forms", "false", "refuted"),  # stationary where k is 0
    ],
)
def test_stationary(status, form, word, stationary, expected):
    assert status(_claim(form, f"stationary = {stationary}", word=word), space=SKATE, symbols=SYMBOLS) == expected


@pytest.mark.parametrize(
    ("form", "integrals", "expected"),
    [
        ("y*vx - x*vy", '["x/y"]', "proved"),
        ("y*vx - x*vy", '["x/y + x/1000"]', "refuted"),
        ("y*vx - x*vy", '["R"]', "refuted"),
        (TWO_WHEELS, '["x - R*sin(a)", "y + R*cos(a)"]', "proved"),
        (TWO_WHEELS, '["x - R*sin(a)", "y - R*cos(a)"]', "refuted"),
        (TWO_WHEELS, '["x - R*sin(a)", "2*x - 2*R*sin(a)"]', "refuted"),
    ],
)
def test_integrals(status, form, integrals, expected):
    assert status(_claim(form, f"integrals = {integrals}"), space=SKATE, symbols=SYMBOLS) == expected


@pytest.mark.parametrize(("integral", "detail"), [("R", {}), ("k*x/y", {"dependent_at": {"k": "0"}}), ("V(x/y)", {})])
def test_integrals_that_may_be_constants_are_none_and_the_answer_says_so(ask, integral, detail):
    """A constant keeps its value along every motion, too, and tells nothing of the constraint."""
    (verdict,) = ask(_claim("y*vx - x*vy", f'integrals = ["{integral}"]'), space=SKATE, symbols=SYMBOLS)
    assert verdict.status == "refuted"
    assert verdict.detail["fails"] == "the integrals depend on each other"
    assert detail.items() <= dict(verdict.detail).items()


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        ('possible = ["c*x/(R + c*t) - y", "c*y/(R + c*t) + x", "1"]', "proved"),
        ('possible = ["-y", "x", "1"]', "refuted"),  # it stays behind the moving surface
        ('virtual = ["-y", "x", "1"]', "proved"),
        ('virtual = ["c*x/(R + c*t) - y", "c*y/(R + c*t) + x", "1"]', "refuted"),
    ],
)
def test_displacements_on_a_moving_surface(status, keys, expected):
    claim = _claim("x**2 + y**2 - (R + c*t)**2", keys, word="functions")
    assert status(claim, space=SKATE, symbols=SYMBOLS, domain='where = ["R + c*t > 0"]') == expected


@pytest.mark.parametrize("functions", ["x**2", "x**2 + y**2", '["x - y", "(x - y)**2 + x - y"]', '["x", "x**2"]'])
def test_functions_whose_differentials_depend_on_each_other_where_they_vanish(ask, functions):
    """Of x² = 0 the differential is 0, and would allow any displacement."""
    with pytest.raises(InputError, match="depend on each other"):
        ask(_claim(functions, 'virtual = ["1", "0", "0"]', word="functions"), space=SKATE)


@pytest.mark.parametrize(("form", "where"), [("V(x)*vx", "V = 0"), ("k*vx", "k = 0")])
def test_a_form_that_may_be_0_is_named(ask, form, where):
    with pytest.raises(InputError, match=where):
        ask(_claim(form, "holonomic = true"), space=SKATE, symbols=SYMBOLS)


@pytest.mark.parametrize(("step", "expected"), [('["1", "0", "0"]', "proved"), ('["0", "1", "0"]', "refuted")])
def test_a_surface_is_left_out_where_its_differential_is_0(status, step, expected):
    claim = _claim("x**2*(y - 1)", f"virtual = {step}", word="functions")
    assert status(claim, space=SKATE) == expected


@pytest.mark.parametrize(
    ("multiplier", "expected"),
    [
        ("-m*(vx**2 + vy**2 - g*y)/(2*R**2)", "proved"),
        ("-m*(vx**2 + vy**2 + g*y)/(2*R**2)", "refuted"),
        ("-1001/1000*m*(vx**2 + vy**2 - g*y)/(2*R**2)", "refuted"),
    ],
)
def test_the_pendulum_by_a_multiplier(status, multiplier, expected):
    claim = _claim(
        "x**2 + y**2 - R**2",
        'L = "m*(vx**2 + vy**2 + w**2)/2 - m*g*y"',
        f'multipliers = ["{multiplier}"]',
        'qddot = ["-(vx**2 + vy**2 - g*y)*x/R**2", "-(vx**2 + vy**2 - g*y)*y/R**2 - g", "0"]',
        word="functions",
    )
    assert status(claim, space=SKATE, symbols=SYMBOLS) == expected


@pytest.mark.parametrize(
    ("force", "expected"), [("m*w*vy*sin(a)", "refuted"), ("m*w*(vx*cos(a) + vy*sin(a))", "proved")]
)
def test_the_skate_by_a_multiplier(status, force, expected):
    claim = _claim(
        KNIFE,
        'L = "m*(vx**2 + vy**2 + w**2)/2"',
        f'multipliers = ["-({force})"]',
        'qddot = ["-w*(vx*cos(a) + vy*sin(a))*sin(a)", "w*(vx*cos(a) + vy*sin(a))*cos(a)", "0"]',
    )
    assert status(claim, space=SKATE, symbols=SYMBOLS) == expected


@pytest.mark.parametrize(
    ("form", "keys", "message"),
    [
        ("vx**2 - vy", ("holonomic = true",), "linear"),
        ('["vx - vy", "2*vx - 2*vy"]', ("holonomic = true",), "depend"),
        ("vx - vy", (), "nothing is claimed"),
        ("vx - vy", ('holonomic = "yes"',), "true or false"),
        ("vx - vy", ('multipliers = ["0"]',), "need"),
    ],
)
def test_faults(ask, form, keys, message):
    with pytest.raises((InputError, AssertionError), match=message):
        ask(_claim(form, *keys), space=SKATE)


FREE = 'L = "m*(vx**2 + vy**2)/2 + m*R**2*w**2/2"'


@pytest.mark.parametrize(
    ("form", "word", "L", "claimed", "expected"),
    [
        (KNIFE, "forms", FREE, "true", "proved"),
        (KNIFE, "forms", FREE, "false", "refuted"),
        ("a - V(x, y)", "functions", FREE, "true", "proved"),
        ("x**2 + y**2 - R**2", "functions", FREE, "true", "proved"),  # on the circle, though not at its centre
        ("x**2 + y**2 - k", "functions", FREE, "true", "undecided"),  # k may be 0
        ("k*x**2 + y**2 - R**2", "functions", FREE, "true", "undecided"),
        ("x*vx + y*vy", "forms", FREE, "true", "undecided"),  # not at x = y = 0
        ("vx - vy", "forms", 'L = "m*vx**2/2"', "true", "refuted"),  # nothing determines a
        ("vx - vy", "forms", 'L = "m*vx**2/2"', "false", "proved"),
        ('["vx + vy", "2*vx + 2*vy"]', "forms", FREE, "false", "proved"),  # one of them follows
        ('["vx + vy", "2*vx + 2001/1000*vy"]', "forms", FREE, "false", "refuted"),
    ],
)
def test_determined(status, form, word, L, claimed, expected):
    symbols = SYMBOLS.replace('V = "function"', 'V = ["function", "positive"]')
    claim = _claim(form, L, f"determined = {claimed}", word=word)
    assert status(claim, space=SKATE, symbols=symbols) == expected


def test_determined_needs_a_lagrangian(ask):
    with pytest.raises((InputError, AssertionError), match="needs the Lagrangian"):
        ask(_claim(KNIFE, "determined = true"), space=SKATE)


@pytest.mark.parametrize(
    ("form", "word", "L", "claimed", "expected"),
    [
        ("vx", "forms", "vx*vy**2 + w**2", "false", "proved"),  # the determinant is vx, which is 0
        ("x", "functions", "vx*vy**2 + w**2", "false", "proved"),
        ("vx - 1", "forms", "(vx - 1)*vy**2 + w**2", "false", "proved"),
        ("vx - 1", "forms", "(vx - 1)*vy**2 + w**2", "true", "refuted"),
        ("vx - 1", "forms", "vx*vy**2 + w**2", "true", "proved"),
        ("vx - 1", "forms", "vx*vy**2 + w**2", "false", "refuted"),
        ("vx - 1", "forms", "(vx - 1001/1000)*vy**2 + w**2", "false", "refuted"),
    ],
)
def test_a_state_has_velocities_that_the_constraints_allow(status, form, word, L, claimed, expected):
    assert status(_claim(form, f'L = "{L}"', f"determined = {claimed}", word=word), space=SKATE) == expected


POSSIBLE = 'kind = "constraint"\nvelocities = ["vx", "vy"]\nforms = ["{}"]\npossible = ["{}", "1"]'
PLANE = 'q = ["x", "y"]\np = ["px", "py"]'


@pytest.mark.parametrize("word", ["positive", "nonnegative", "negative", "nonzero", "real"])
def test_possible_velocities_are_what_is_said_of_their_names(ask, status, word):
    for form, step, kept in (("vx", "0", ("nonnegative", "real")), ("vx + 1", "-1", ("negative", "nonzero", "real"))):
        claim = POSSIBLE.format(form, step)
        if word in kept:
            assert status(claim, space=PLANE, symbols=f'vx = "{word}"') == "proved"
        else:
            with pytest.raises(InputError, match="no point of the domain"):
                ask(claim, space=PLANE, symbols=f'vx = "{word}"')


@pytest.mark.parametrize("form", ["vx + 1 + 0*log(vx)", "x*vx + x + 0/(vx + 1)", "vx + 1 + 0*sqrt(vx - x**2)"])
def test_possible_velocities_are_in_the_domain(ask, status, form):
    with pytest.raises(InputError, match="no point of the domain"):
        ask(POSSIBLE.format(form, "-1"), space=PLANE)
    assert status(POSSIBLE.format("vx + 1 + 0*log(vx + 2)", "-1"), space=PLANE) == "proved"


@pytest.mark.parametrize(
    "asked", ['integrals = ["x + t"]', "holonomic = true", 'determined = true\nL = "(vx**2+vy**2)/2"']
)
def test_a_constraint_holds_somewhere(ask, status, asked):
    claim = f'kind = "constraint"\nvelocities = ["vx", "vy"]\nforms = ["vx + 1"]\n{asked}'
    assert status(claim, space=PLANE) == status(claim, space=PLANE, symbols='vx = "negative"') == "proved"
    with pytest.raises(InputError, match="no point of the domain"):
        ask(claim, space=PLANE, symbols='vx = "positive"')
