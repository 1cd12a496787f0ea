"""`matrix_algebra` and `casimir`: what closes, what it is called, and what is refuted with its true value."""

import pytest

from canon.claims.reader import read_text

LINE = {"space": 'q = ["q"]\np = ["p"]\n'}
J = {
    "J1": '[["0", "0", "0"], ["0", "0", "-1j"], ["0", "1j", "0"]]',
    "J2": '[["0", "0", "1j"], ["0", "0", "0"], ["-1j", "0", "0"]]',
    "J3": '[["0", "-1j", "0"], ["1j", "0", "0"], ["0", "0", "0"]]',
}
TABLE = '{"J1,J2" = "J3", "J2,J3" = "J1", "J3,J1" = "J2"}'


def stated(basis, **keys):
    lines = ['kind = "matrix_algebra"', *(f"{k} = {v}" for k, v in keys.items())]
    return "\n".join([*lines, "[claim.basis]", *(f"{name} = {rows}" for name, rows in basis.items())])


def test_physicists_generators_of_rotations(ask):
    """Course exercise-7.2, sec-13.12-a: [J_i, J_j] = i ε_ijk J_k."""
    right, sign, other = ask(
        stated(J, equals='"so(3)"', structure=TABLE),
        stated(J, structure=TABLE.replace('"J1"', '"-J1"')),
        stated(J, equals='"sl(2,R)"'),
        **LINE,
    )
    assert right.status == "proved"
    assert right.detail["algebra"] == "so(3)"
    assert right.detail["bracket"].startswith("−i[A, B]")
    assert (sign.status, sign.detail["fails"], sign.detail["value"]) == ("refuted", "[J2, J3]", "J1")
    assert sign.witness is None
    assert (other.status, other.detail["algebra"]) == ("refuted", "so(3)")


def test_one_factor_in_a_thousand_is_caught(ask):
    (found,) = ask(stated(J, structure=TABLE.replace('"J3"', '"1.001*J3"', 1)), **LINE)
    assert (found.status, found.detail["fails"], found.detail["value"]) == ("refuted", "[J1, J2]", "J3")


def test_generators_with_roots_in_them(ask):
    """Gell-Mann's matrices with a root in each scale: su(3), not so(4) + u(1)^2 of the same dimension."""
    root = "1/sqrt(3)"
    gell_mann = {
        "l1": '[["0", "1", "0"], ["1", "0", "0"], ["0", "0", "0"]]',
        "l2": '[["0", "-1j", "0"], ["1j", "0", "0"], ["0", "0", "0"]]',
        "l3": '[["sqrt(2)", "0", "0"], ["0", "-sqrt(2)", "0"], ["0", "0", "0"]]',
        "l4": '[["0", "0", "1"], ["0", "0", "0"], ["1", "0", "0"]]',
        "l5": '[["0", "0", "-1j"], ["0", "0", "0"], ["1j", "0", "0"]]',
        "l6": '[["0", "0", "0"], ["0", "0", "1"], ["0", "1", "0"]]',
        "l7": '[["0", "0", "0"], ["0", "0", "-1j"], ["0", "1j", "0"]]',
        "l8": f'[["{root}", "0", "0"], ["0", "{root}", "0"], ["0", "0", "-2*{root}"]]',
    }
    right, value, wrong = ask(
        stated(gell_mann, equals='"su(3)"'),
        stated(gell_mann, structure='{"l4,l5" = "l3"}'),
        stated(gell_mann, equals='"so(4) + u(1)^2"'),
        **LINE,
    )
    assert (right.status, wrong.status, value.status) == ("proved", "refuted", "refuted")
    assert value.detail["fails"] == "[l1, l2]"


BOOSTS = {
    "K1": '[["0", "k", "0"], ["1", "0", "0"], ["0", "0", "0"]]',
    "K2": '[["0", "0", "k"], ["0", "0", "0"], ["1", "0", "0"]]',
    "J3": '[["0", "0", "0"], ["0", "0", "-1"], ["0", "1", "0"]]',
}


@pytest.mark.parametrize(
    ("assumed", "name", "verdict"),
    [
        ("positive", "so(2,1)", "proved"), ("negative", "so(3)", "proved"), ("negative", "so(2,1)", "refuted"),
        ("real", "so(2,1)", "refuted"), ("real", "e(2)", "refuted"), ("nonnegative", "so(2,1)", "refuted"),
    ],
)  # fmt: skip
def test_a_parameter_decides_for_all_of_its_values(ask, assumed, name, verdict):
    """k = 1/c²: boosts of one plane make so(2,1) for k > 0, e(2) at k = 0 and so(3) for k < 0."""
    (found,) = ask(stated(BOOSTS, equals=f'"{name}"'), symbols=f'k = "{assumed}"', **LINE)
    assert found.status == verdict, found


def test_one_algebra_for_each_sign_of_a_parameter(ask):
    """[e, f] = k h: sl(2,R) for k of either sign; names in capitals are understood."""
    basis = {"e": '[["0", "k"], ["0", "0"]]', "f": '[["0", "0"], ["1", "0"]]', "h": '[["1", "0"], ["0", "-1"]]'}
    table = '{"e,f" = "k*h", "h,e" = "2*e", "h,f" = "-2*f"}'
    right, wrong, constants = ask(
        stated(basis, equals='"SL(2,R)"'),
        stated(basis, equals='"so(3)"'),
        stated(basis, structure=table, equals='"sl(2,R)"'),
        symbols='k = "nonzero"',
        **LINE,
    )
    assert (right.status, wrong.status, constants.status) == ("proved", "refuted", "proved")


def test_a_parameter_that_is_no_power(ask):
    """[K1, K2] = (k² + 1) J3: semisimple and of one class for every real k."""
    basis = {name: rows.replace('"k"', '"k**2 + 1"') for name, rows in BOOSTS.items()}
    right, wrong = ask(stated(basis, equals='"so(2,1)"'), stated(basis, equals='"so(3)"'), symbols='k = "real"', **LINE)
    assert (right.status, wrong.status) == ("proved", "refuted")


def test_a_constant_that_is_small_at_the_value_tried_is_no_zero(ask):
    """[K1, K2] = ((k − 1)² + 10⁻⁶⁰) J3, for positive k: once rounded to 0 at k = 1, and proved to be e(2)."""
    basis = {name: rows.replace('"k"', '"k**2 - 2*k + 1 + 1/10**60"') for name, rows in BOOSTS.items()}
    wrong, right = ask(
        stated(basis, equals='"e(2)"'), stated(basis, equals='"so(2,1)"'), symbols='k = "positive"', **LINE
    )
    assert (right.status, wrong.status) == ("proved", "refuted")


def test_a_bracket_that_leaves_the_span_and_dependent_generators(ask):
    leaves, depends = ask(
        stated({"J1": J["J1"], "J2": J["J2"]}, equals='"u(1)^2"'),
        stated({**J, "S": J["J1"].replace("1j", "2j")}, equals='"so(3) + u(1)"'),
        **LINE,
    )
    assert (leaves.status, leaves.detail["fails"]) == ("refuted", "[J1, J2] in the real span")
    assert leaves.detail["value"] == [["0", "1", "0"], ["-1", "0", "0"], ["0", "0", "0"]]
    assert (depends.status, depends.detail["fails"]) == ("refuted", "independence over the reals")
    assert "J1" in depends.detail["relation"]


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"equals": '"so(3"'}, "unknown algebra"),
        ({"structure": '{"J1,J9" = "J3"}'}, "a pair of basis names"),
        ({"structure": '{"J1,J2" = "J3", "J2,J1" = "J3"}'}, "stated twice"),
        ({"structure": '{"J1,J2" = "q*J3"}'}, "structure constant, which depends on parameters alone"),
        ({"structure": '{"J1,J2" = "J3**2"}'}, "a linear combination"),
        ({}, "needs 'equals'"),
    ],
)
def test_ill_posed_claims(ask, keys, message):
    text = '[phase_space]\nq = ["q"]\np = ["p"]\n[[claim]]\n' + stated(J, **keys)
    reading = read_text(text)
    if reading.problems:
        assert message in reading.problems[0]["message"]
    else:
        from canon.claims.verify import verify
        from canon.errors import InputError

        with pytest.raises(InputError, match=message):
            verify(reading.claims[0])


RIGID = 'structure = {"x,y" = "z", "y,z" = "x", "z,x" = "y"}'


def test_casimirs(ask):
    """Rigid body: M² commutes with everything; M_x doesn't; a tensor that violates Jacobi's identity has none."""
    space = {**LINE, "symbols": 'x = "real"\ny = "real"\nz = "real"'}
    square, component, bent, factor = ask(
        f'kind = "casimir"\nf = "x**2 + y**2 + z**2"\n{RIGID}',
        f'kind = "casimir"\nf = "x"\n{RIGID}',
        'kind = "casimir"\nf = "1"\ncoordinates = ["x", "y", "z"]\n'
        'tensor = [["0", "1", "x"], ["-1", "0", "y"], ["-x", "-y", "0"]]',
        f'kind = "casimir"\nf = "x**2 + y**2 + 1.001*z**2"\n{RIGID}',
        **space,
    )
    assert (square.status, component.status, bent.status, factor.status) == ("proved", *["refuted"] * 3)
    assert (component.detail["fails"], component.detail["value"]) == ("{x, y}", "z")
    assert bent.detail["fails"].startswith("Jacobi's identity")


@pytest.mark.parametrize(("name", "status"), [("so(3)", "proved"), ("sl(2,R)", "refuted"), ("e(2)", "refuted")])
def test_rotations_about_three_corners_of_an_icosahedron(ask, name, status):
    """Structure constants in Q(√5) that no change of scale makes rational: the Killing form, enclosed, tells."""
    axes = {"A": ("1", "f", "0"), "B": ("0", "1", "f"), "C": ("f", "0", "1")}
    lines = [
        f'{k} = [["0", "-({z})", "{y}"], ["{z}", "0", "-({x})"], ["-({y})", "{x}", "0"]]'
        for k, (x, y, z) in axes.items()
    ]
    claim = f'kind = "matrix_algebra"\nequals = "{name}"\n[claim.basis]\n' + "\n".join(lines).replace(
        "f", "(1 + sqrt(5))/2"
    )
    (found,) = ask(claim, space='q = ["q"]\np = ["p"]\n')
    assert found.status == status, found
    assert found.detail["algebra"] == "so(3)"


@pytest.mark.parametrize(
    ("where", "coefficient", "expected"),
    [
        ("a > 1", "C/(a - 1)", "proved"),
        ("a != 1", "C/(a - 1)", "proved"),
        ("a > 1", "C/(1 - a)", "refuted"),
        ("a > 1", "1001*C/(1000*(a - 1))", "refuted"),
    ],
)
def test_matrices_that_the_domain_keeps_independent(status, where, coefficient, expected):
    matrices = (
        'A = [["0","0","0"],["0","0","-1"],["0","1","0"]], B = [["0","0","1"],["0","0","0"],["-1","0","0"]], '
        'C = [["0","1 - a","0"],["a - 1","0","0"],["0","0","0"]]'
    )
    structure = f'"A,B" = "{coefficient}", "B,C" = "(a - 1)*A", "C,A" = "(a - 1)*B"'
    claim = f'kind = "matrix_algebra"\nbasis = {{ {matrices} }}\nstructure = {{ {structure} }}'
    assert status(claim, symbols='a = "real"', domain=f'where = ["{where}"]') == expected
