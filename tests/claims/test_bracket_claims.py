"""Brackets, Jacobi's identity, constants of motion, involution, independence, identities."""

from fractions import Fraction

import pytest

from canon.errors import InputError

PLANE = 'q = ["x", "y"]\np = ["px", "py"]\n'
SO3 = 'tensor = [["0", "z", "-y"], ["-z", "0", "x"], ["y", "-x", "0"]]\ncoordinates = ["x", "y", "z"]'
BODY = {
    "space": 'q = ["q"]\np = ["p"]\n',
    "symbols": 'x = "real"\ny = "real"\nz = "real"\na = "positive"\nb = "positive"',
    "hamiltonian": 'H = "a*x**2 + b*y**2"',
}


def test_the_bracket_of_angular_momentum_with_the_radius(ask):
    right, wrong = ask(
        'kind = "bracket"\nf = "x*py - y*px"\ng = "sqrt(x**2 + y**2)"\nequals = "0"',
        'kind = "bracket"\nf = "x*py - y*px"\ng = "x"\nequals = "-y"',
        space=PLANE,
    )
    assert right.status == "proved"
    assert wrong.status == "refuted"
    assert wrong.detail["value"] == "y"  # the sign is what fails


def test_jacobi_for_any_functions_and_for_tensors(status):
    claim = 'kind = "jacobi"\nf = "{}"\ng = "{}"\nh = "{}"'
    functions = {"symbols": 'V = "function"\nW = "function"', "space": PLANE}
    assert status(claim.format("V(x, py)", "W(y, px)", "x*py"), **functions) == "proved"
    assert status(f"{claim.format('x', 'y', 'z')}\n{SO3}", **BODY) == "proved"
    bent = SO3.replace('"x"', '"x*y"', 1).replace('"-x"', '"-x*y"')
    assert status(f"{claim.format('x', 'y', 'z')}\n{bent}", **BODY) == "refuted"


def test_a_tensor_that_is_not_poissons_is_warned_of(ask):
    claim = 'kind = "bracket"\nf = "x"\ng = "y"\nequals = "z"'
    bent = SO3.replace('"x"', '"x*y"', 1).replace('"-x"', '"-x*y"')
    good, bad = ask(f"{claim}\n{SO3}", f"{claim}\n{bent}", **BODY)
    assert (good.status, bad.status) == ("proved", "proved")
    assert "warning" not in good.detail
    assert bad.detail["warning"] == "this is no Poisson bracket: Jacobi's identity fails for x, y, z"
    (jacobi,) = ask(f'kind = "jacobi"\nf = "x"\ng = "y"\nh = "z"\n{bent}', **BODY)
    assert (jacobi.status, "warning" in jacobi.detail) == ("refuted", False)  # it is the claim itself


def test_a_function_with_a_sign(status):
    """What holds of every positive function, not of every function, and not of every nonzero one."""
    root, slope = 'lhs = "sqrt(V(x)**2)"\nrhs = "V(x)"', 'lhs = "sqrt(D(V(x), x)**2)"\nrhs = "D(V(x), x)"'

    def answer(words, claim):
        return status(f'kind = "identity"\n{claim}', space=PLANE, symbols=f"V = {words}")

    assert answer('["function", "positive"]', root) == "proved"
    assert answer('["function", "negative"]', root.replace('"V(x)"', '"-V(x)"')) == "proved"
    assert answer('["function", "positive"]', slope) == "refuted"
    for words in ('"function"', '["function", "negative"]', '["function", "nonzero"]', '["real", "function"]'):
        assert answer(words, root) == "refuted"


def test_euler_equations_conserve_the_square(status):
    assert status(f'kind = "conserved"\nf = "x**2 + y**2 + z**2"\n{SO3}', **BODY) == "proved"
    assert status(f'kind = "conserved"\nf = "x**2 + y**2"\n{SO3}', **BODY) == "refuted"


def test_structure_constants_in_place_of_a_tensor(status):
    structure = 'structure = {"x,y" = "z", "y,z" = "x", "z,x" = "y"}\ncoordinates = ["x", "y", "z"]'
    assert status(f'kind = "bracket"\nf = "x*y"\ng = "y"\nequals = "y*z"\n{structure}', **BODY) == "proved"


def test_a_tensor_must_be_antisymmetric(status):
    with pytest.raises((InputError, AssertionError), match="antisymmetric"):
        status(f'kind = "jacobi"\nf = "x"\ng = "y"\nh = "z"\n{SO3.replace("-z", "z")}', **BODY)


def test_a_constant_of_motion_that_depends_on_time(status):
    sections = {"space": 'q = ["q"]\np = ["p"]\n', "symbols": 'm = "positive"', "hamiltonian": 'H = "p**2/(2*m)"'}
    assert status('kind = "conserved"\nf = "q - p*t/m"', **sections) == "proved"
    assert status('kind = "conserved"\nf = "q + p*t/m"', **sections) == "refuted"


def test_involution_pair_by_pair(ask):
    right, wrong = ask(
        'kind = "involution"\nfunctions = ["x*py - y*px", "px**2 + py**2", "x**2*py**2 + y**2*px**2 - 2*x*y*px*py"]',
        'kind = "involution"\nfunctions = ["px", "py", "x*py - y*px"]',
        space=PLANE,
    )
    assert right.status == "proved"
    assert wrong.status == "refuted"


@pytest.mark.parametrize(
    ("functions", "expected"),
    [
        (["x*py - y*px", "px**2 + py**2", "x**2 + y**2"], "proved"),
        (["x", "x**2"], "refuted"),
        (["x", "y", "px", "py", "x*y"], "refuted"),
        (["abs(x)", "y"], "proved"),
        (["x + abs(x)"], "refuted"),  # constant where x < 0
        (["x*sign(y) + x", "y"], "refuted"),
        (["m*x + py/m", "y"], "proved"),
        (["a*x", "y"], "refuted"),  # a = 0 is allowed
        (["(m + 1)*x", "y"], "proved"),
        (["(a**2 - 2)*x", "y"], "refuted"),
        (["(a**2 + 2)*x", "y"], "proved"),
        (["a*x + b*y", "b*x - a*y"], "refuted"),
        (["x*cos(a)", "y"], "refuted"),
        (["x*cos(a) + y*sin(a)", "y*cos(a) - x*sin(a)"], "proved"),
        (["x**a", "y"], "refuted"),
        (["asin(sin(x)) - x", "y"], "refuted"),  # x near 0
        (["sqrt((x - 1)**2) + abs(y) + x - y", "y"], "refuted"),
        (["sqrt((x - 1)**2) + 2*x", "y"], "proved"),
        (["log(x)*y**2 + x*atan(y)", "y*log(x)"], "proved"),
        (["atan(x)*log(abs(y))", "y*atan(x)"], "proved"),
        (["x*y", "V(x)*y"], "refuted"),  # V(x) = x
        (["V(x + y)", "x - y"], "refuted"),  # V = 0
        (["exp(V(x))*y", "x"], "proved"),
        (["y/V(x)", "x"], "proved"),
        (["sqrt(x**2 + y**2)", "x*py - y*px", "px**2 + py**2 - 2/sqrt(x**2 + y**2)"], "proved"),
        (["atan2(y, x)", "x**2 + y**2"], "proved"),
        (["x*cos(t) + px*sin(t)", "px*cos(t) - x*sin(t)"], "proved"),
        (["V(x) + px", "x"], "proved"),
    ],
)
def test_independence_on_every_component(status, functions, expected):
    claim = f'kind = "independent"\nfunctions = {functions}'.replace("'", '"').replace('kind = "', 'kind = "')
    symbols = 'a = "real"\nb = "real"\nm = "positive"\nV = "function"'
    assert status(claim, space=PLANE, symbols=symbols) == expected


def test_a_refutation_of_independence_says_where(ask):
    claims = [f'kind = "independent"\nfunctions = {f}' for f in ('["a*x"]', '["V(x)"]', '["asin(sin(x)) - x"]')]
    parameter, function, component = ask(*claims, space=PLANE, symbols='a = "real"\nV = "function"')
    assert parameter.detail["dependent_at"] == {"a": "0"}
    assert function.detail["dependent_for"] == {"V": "0"}
    assert abs(Fraction(component.detail["dependent_near"]["x"])) < 2


def test_independence_on_a_surface_is_not_proved_by_a_point(status):
    claim = 'kind = "independent"\nfunctions = ["x", "px"]'
    assert status(claim, space=PLANE, domain='on = ["x**2 + y**2 - 1"]') == "supported"


def test_brackets_on_a_surface_are_restricted_after_they_are_taken(status):
    claim = 'kind = "bracket"\nf = "x**2 + y**2"\ng = "x*px + y*py"\nequals = "{}"'
    sections = {"space": PLANE, "domain": 'on = ["x**2 + y**2 - 1"]'}
    assert status(claim.format("2"), **sections) == "proved"
    assert status(claim.format("0"), **sections) == "refuted"


@pytest.mark.parametrize(
    ("lhs", "rhs", "expected"),
    [
        ("P - p", "1", "proved"),
        ("atan(q) + atan(1/q)", "pi/2", "refuted"),  # −π/2 for q < 0
        ("sqrt(q**2)", "q", "refuted"),
        ("Q*P", "q*p", "refuted"),
    ],
)
def test_identities_of_old_and_new_variables(status, lhs, rhs, expected):
    claim = f'kind = "identity"\nlhs = "{lhs}"\nrhs = "{rhs}"'
    assert status(claim, transformation='Q = ["q"]\nP = ["p + 1"]') == expected


def test_old_variables_of_a_backward_map_are_known_on_its_image_alone(status):
    """q = exp(Q) is positive."""
    sections = {"transformation": 'q = ["exp(Q)"]\np = ["P*exp(-Q)"]'}
    assert status('kind = "identity"\nlhs = "abs(q)"\nrhs = "q"', **sections) == "proved"
    assert status('kind = "bracket"\nf = "sqrt(q**2)"\ng = "p"\nequals = "1"', **sections) == "proved"
