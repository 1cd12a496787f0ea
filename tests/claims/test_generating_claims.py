"""Generating functions: canonical where their mixed Hessian isn't singular, what they generate, what they lead to."""

from fractions import Fraction

import pytest

from canon.errors import InputError

CANONICAL = 'kind = "canonical"'
OSCILLATOR = {
    "symbols": 'm = "positive"\nomega = "positive"',
    "hamiltonian": 'H = "p**2/(2*m) + m*omega**2*q**2/2"',
}


@pytest.mark.parametrize(
    ("type", "F", "expected"),
    [
        (1, "q*Q", "proved"),
        (1, "q**2 + Q**2", "refuted"),
        (2, "q*P + V(q)", "proved"),
        (2, "V(q) + V(P)", "refuted"),
        (3, "-p*Q", "proved"),
        (4, "p*P", "proved"),
        (1, "q**2*cot(Q)/2", "proved"),
        (2, "q + t*P", "refuted"),
    ],
)
def test_canonical_where_the_mixed_hessian_is_not_singular(ask, type, F, expected):
    (verdict,) = ask(CANONICAL, symbols='V = "function"', generating_function=f'type = {type}\nF = "{F}"')
    assert verdict.status == expected
    if expected == "refuted":
        assert verdict.witness is None
        assert verdict.detail["mixed_hessian"] == "0"


def test_a_generating_function_has_scale_one(ask):
    (verdict,) = ask(f'{CANONICAL}\nscale = "2"', generating_function='type = 2\nF = "q*P"')
    assert verdict.status == "refuted"
    assert verdict.detail["scale"] == "1"


@pytest.mark.parametrize(
    "claim",
    [
        'kind = "volume"',
        'kind = "integral_invariant"',
        'kind = "fundamental_brackets"',
        'kind = "bracket_invariance"\nf = "Q**2"\ng = "P"',
        'kind = "cartan_invariant"\nK = "omega*P"',
        'kind = "new_hamiltonian"\nK = "omega*P"',
        'kind = "identity"\nlhs = "q"\nrhs = "sqrt(2*P/(m*omega))*sin(Q)"',
    ],
)
def test_the_oscillator_from_its_type_1_function_alone(status, claim):
    """Goldstein, Poole and Safko (2002), section 9.3; the identity holds on half of the domain only."""
    sections = {**OSCILLATOR, "generating_function": 'type = 1\nF = "m*omega*q**2*cot(Q)/2"'}
    region = {"domain": 'where = ["0 < Q < pi", "q > 0"]'}
    assert status(claim, **sections, **region) == "proved"
    if "identity" in claim:
        assert status(claim, **sections) == "refuted"


@pytest.mark.parametrize(("type", "F", "expected"), [
    (1, "q*Q", "proved"), (1, "q*Q + t**3", "proved"), (4, "p*P", "proved"), (4, "-p*P", "refuted"),
    (2, "q*P", "refuted"), (1, "q*Q*1001/1000", "refuted"),
])  # fmt: skip
def test_which_function_generates_the_exchange(ask, type, F, expected):
    sections = {"transformation": 'Q = ["p"]\nP = ["-q"]'}
    named = ask(f'kind = "generating_function"\ntype = {type}\nF = "{F}"', **sections)[0]
    given = ask('kind = "generates"', generating_function=f'type = {type}\nF = "{F}"', **sections)[0]
    assert named.status == given.status == expected


def test_types_mixed_by_degree_of_freedom(status):
    space = 'q = ["x", "y"]\np = ["px", "py"]\nQ = ["X", "Y"]\nP = ["PX", "PY"]\n'
    swap = 'Q = ["px", "y"]\nP = ["-x", "py"]'
    claim = 'kind = "generating_function"\ntype = [1, 2]\nF = "x*X + y*PY"'
    assert status(claim, space=space, transformation=swap) == "proved"


def test_a_function_of_the_wrong_variables(ask):
    with pytest.raises((InputError, AssertionError), match=r"P|key 'F'"):
        ask('kind = "generating_function"\ntype = 1\nF = "q*P"', transformation='Q = ["p"]\nP = ["-q"]')


NEW = {"symbols": 'a = "positive"', "hamiltonian": 'H = "p**2/2"'}


@pytest.mark.parametrize(
    ("Q", "P", "K", "expected"),
    [
        ("2*q", "3*p", "P**2/3", "proved"),  # scale 6
        ("2*q", "3*p", "P**2/2", "refuted"),
        ("a*q", "p", "a*P**2/2", "proved"),
        ("q - a*t", "p", "P**2/2 - a*P", "proved"),
        ("q - a*t", "p", "P**2/2", "refuted"),  # ∂F/∂t forgotten
        ("q*exp(t)", "p", "P**2/2", "refuted"),  # the scale depends on time
        ("abs(q)", "p", "P**2/2", "refuted"),  # scale 1 and −1
        ("q", "q", "P", "refuted"),  # no map
        ("q", "p + t", "P**2/2 - t*P - Q", "proved"),
    ],
)
def test_new_hamiltonians(status, Q, P, K, expected):
    transformation = f'Q = ["{Q}"]\nP = ["{P}"]'
    assert status(f'kind = "new_hamiltonian"\nK = "{K}"', transformation=transformation, **NEW) == expected


def test_a_scale_that_may_vanish_proves_no_new_hamiltonian(ask):
    (verdict,) = ask(
        'kind = "new_hamiltonian"\nK = "a*P**2/2"',
        symbols='a = "real"',
        hamiltonian='H = "p**2/2"',
        transformation='Q = ["a*q"]\nP = ["p"]',
    )
    assert verdict.status == "supported"


@pytest.mark.parametrize("kind", ["new_hamiltonian", "symmetry"])
@pytest.mark.parametrize("direction", ["Q P", "q p"])
def test_a_scale_that_is_zero_in_disguise(status, kind, direction):
    (a, b), x = direction.split(), "qp" if direction == "Q P" else "QP"
    transformation = f'{a} = ["{x[0]}"]\n{b} = ["{x[1]}*(cos(a)**2 + sin(a)**2 - 1)"]'
    claim = f'kind = "{kind}"' + ('\nK = "P"' if kind == "new_hamiltonian" else "")
    sections = {"symbols": 'a = "real"', "hamiltonian": 'H = "p"', "transformation": transformation}
    assert status(claim, **sections) == "refuted"


def test_new_hamiltonian_of_a_backward_map_with_time(status):
    """The frame that moves with the free particle: K = 0."""
    claim = 'kind = "new_hamiltonian"\nK = "{}"'
    sections = {"hamiltonian": 'H = "p**2/2"', "transformation": 'q = ["Q + P*t"]\np = ["P"]'}
    assert status(claim.format("0"), **sections) == "proved"
    assert status(claim.format("P**2/2"), **sections) == "refuted"


@pytest.mark.parametrize(
    ("Q", "P", "expected"), [("-q", "-p", "proved"), ("p", "-q", "proved"), ("q + 1", "p", "refuted")]
)
def test_symmetries_of_the_oscillator(status, Q, P, expected):
    transformation = f'Q = ["{Q}"]\nP = ["{P}"]'
    assert status('kind = "symmetry"', hamiltonian='H = "p**2/2 + q**2/2"', transformation=transformation) == expected


def test_without_a_hamiltonian(ask):
    with pytest.raises(AssertionError, match="hamiltonian"):
        ask('kind = "symmetry"', transformation='Q = ["q"]\nP = ["p"]')


def test_what_fails_its_value_and_its_witness_belong_together(ask):
    (verdict,) = ask('kind = "generating_function"\ntype = 1\nF = "q*Q"', transformation='Q = ["q"]\nP = ["p"]')
    assert verdict.detail["fails"] == "p = dF/dq"
    q, p = (Fraction(verdict.witness[name]) for name in "qp")
    assert float(verdict.detail["residual"]) == pytest.approx(float(p - q))
    assert verdict.numeric.max_residual == pytest.approx(abs(float(p - q)))
