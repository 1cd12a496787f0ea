"""Claims of normal forms, unique or not: decided both ways, exactly."""

import random

import pytest
import sympy as sp

from canon.claims.reached import compared
from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.errors import InputError
from canon.mechanics.birkhoff import birkhoff_gustavson, equilibrium, exponential, normalised
from canon.mechanics.homological import kernel, monomials
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.taylor_polynomial import homogeneous_parts

LINE = 'q = ["q"]\np = ["p"]\n'
PLANE = 'q = ["x", "y"]\np = ["px", "py"]\n'
RESONANT = {
    "definitions": """I = "(x**2 + y**2 + px**2 + py**2)/2"
L = "x*py - y*px"
u = "x*y + px*py"
v = "(x**2 + px**2 - y**2 - py**2)/2"
N4 = "-5/12*I**2 + 7/12*L**2"
N6 = "-67/432*I**3 - 7/144*I*L**2 + 7/18*(v**3 - 3*v*u**2)"
""",
    "hamiltonian": 'H = "I + x**2*y - y**3/3"',
}


def _claim(order: int, **N: str) -> str:
    table = ", ".join(f'{name[1:]} = "{value}"' for name, value in N.items())
    return f'kind = "normal_form"\norder = {order}\nN = {{{table}}}'


@pytest.mark.parametrize(
    ("order", "N", "expected"),
    [
        (6, {"N4": "N4", "N6": "N6"}, "proved"),
        (6, {"N2": "I", "N3": "0", "N4": "N4", "N6": "N6 + bracket(N4, 3*u*v - L*v)"}, "proved"),
        (6, {"N4": "N4", "N6": "N6 + L*u*v/1000"}, "proved"),  # {L**2, u**2} is a multiple of L*u*v
        (6, {"N4": "N4", "N6": "N6 + L*I**2/1000"}, "refuted"),
        (6, {"N4": "N4", "N6": "N6 + I**3/1000"}, "refuted"),
        (5, {"N4": "N4 + bracket(N4, u*v)*0 + u*v/1000"}, "refuted"),
        (6, {"N4": "N4", "N6": "N6 + x**6/1000"}, "refuted"),
        (4, {"N2": "L", "N4": "N4"}, "refuted"),
        (6, {"N4": "N4"}, "refuted"),
    ],
)
def test_one_to_one_resonance(status, order, N, expected):
    assert status(_claim(order, **N), space=PLANE, **RESONANT) == expected


def test_a_true_normal_form_of_higher_order_that_isnt_the_computed_one(ask):
    """exp{., k} of the computed one up to order 8: the correction found in degree 6 must fit in degree 8 too."""
    space = PhaseSpace("x y", "px py")
    x, y, px, py = space.symbols("x y px py")
    found = birkhoff_gustavson(space, (px**2 + py**2 + x**2 + y**2) / 2 + x**2 * y - y**3 / 3, 8)
    gx, gy, gpx, gpy = found.algebra.generators
    kappa = (gx * gy + gpx * gpy) * (gx * gpy - gy * gpx)
    moved = exponential(found.algebra, dict(found.parts), kappa, 8)
    N = {f"N{d}": sp.sstr(found.algebra.expression(f)).replace("\n", "") for d, f in moved.items() if d > 2}
    assert moved[6] != found.parts[6]
    holds, fails = ask(_claim(8, **N), _claim(8, **(N | {"N8": N["N8"] + " + I**4/1000"})), space=PLANE, **RESONANT)
    assert holds.status == "proved"
    assert (fails.status, fails.detail["fails_at_degree"]) == ("refuted", 8)
    assert fails.witness is None
    assert fails.detail["resonances"] == ["(1, -1)"]


def test_without_a_semisimple_linear_flow_more_is_reached(status):
    """P = p √(1 + 2p²) makes p²/2 + p⁴ of p²/2: no κ that commutes with H₂ does that."""
    free = {"hamiltonian": 'H = "p**2/2"'}
    assert status(_claim(6, N3="5*p**3", N4="p**4"), space=LINE, **free) == "proved"
    assert status(_claim(4, N4="q*p**3"), space=LINE, **free) == "refuted"


def test_parameters_have_a_witness(ask):
    sections = {"symbols": 'omega = "positive"\na = "real"', "hamiltonian": 'H = "p**2/2 + omega**2*q**2/2 + a*q**4"'}
    term = "3*a*(p**2 + omega**2*q**2)**2/(8*omega**4)"
    right, wrong = ask(_claim(4, N4=term), _claim(4, N4=term + "*(1 + a*omega/1000)"), space=LINE, **sections)
    assert right.status == "proved"
    assert wrong.status == "refuted"
    assert set(wrong.witness) == {"a", "omega"}


def test_small_divisors_leave_a_claim_supported(ask):
    sections = {"symbols": 'w = "positive"', "hamiltonian": 'H = "(px**2 + x**2)/2 + w*(py**2 + y**2)/2 + x**2*y"'}
    (verdict,) = ask(_claim(3), space=PLANE, **sections)
    assert verdict.status == "supported"
    assert "w - 2 = 0" in verdict.detail["note"]
    (verdict,) = ask(_claim(3), space=PLANE, domain='where = ["w > 2"]', **sections)
    assert verdict.status == "proved"
    (verdict,) = ask(_claim(3), space=PLANE, **(sections | {"symbols": 'w = "negative"'}))
    assert verdict.status == "supported"
    assert "w + 2 = 0" in verdict.detail["note"]
    (verdict,) = ask(_claim(3, N3="0/(w**2 - 4)"), space=PLANE, **sections)
    assert verdict.status == "proved"  # where N is defined


def test_outside_of_exact_arithmetic(ask):
    (verdict,) = ask(_claim(3), space=LINE, hamiltonian='H = "p**2/2 + q**2*cos(1 + q)/2"')
    assert verdict.status == "undecided"
    (verdict,) = ask(_claim(4), space=LINE, symbols='V = "function"', hamiltonian='H = "p**2/2 + V(q)"')
    assert verdict.status == "undecided"


def test_sampling_reaches_it_at_values_of_the_parameters(ask):
    options = {"method": "numeric"}
    good, near, bad = ask(
        _claim(4, N4="N4"),
        _claim(4, N4="N4 + I**2/1000"),
        _claim(4, N4="x**4"),
        space=PLANE,
        options=options,
        **RESONANT,
    )
    assert (good.status, near.status, bad.status) == ("supported", "refuted", "refuted")
    assert good.numeric.points == 1000
    quartic = {"space": LINE, "symbols": 'b = "positive"', "hamiltonian": 'H = "(p**2 + q**2)/2 + b*q**4"'}
    I = "3/2*b*((p**2 + q**2)/2)**2"
    good, near = ask(_claim(4, N4=I), _claim(4, N4=f"1001/1000*{I}"), options=options, **quartic)
    assert (good.status, near.status) == ("supported", "refuted")
    assert set(near.witness) == {"b"}


@pytest.mark.parametrize(
    ("H", "N", "words"),
    [
        ("p**2/2 + q", "{}", "no equilibrium"),
        ("p**2/2 + sqrt(q)", "{}", "isn't inside the domain: q > 0"),
        ("p**2/2 + q**2*t", "{}", "H depends on t"),
        ("p**2/2 + q**2", '{4 = "q**3"}', "not homogeneous of degree 4"),
        ("p**2/2 + q**2", '{6 = "q**6"}', "the order is 4"),
        ("p**2/2 + q**2", '{4 = "sqrt(1 + q**2)"}', "a polynomial in the variables"),
    ],
)
def test_bad_input(H, N, words):
    text = f'[phase_space]\n{LINE}[hamiltonian]\nH = "{H}"\n[[claim]]\nkind = "normal_form"\norder = 4\nN = {N}'
    reading = read_text(text)
    assert not reading.problems
    with pytest.raises(Exception, match=words):
        verify(reading.claims[0])


@pytest.mark.parametrize(
    ("line", "words"),
    [('N = {x = "q"}', "degrees from 2 to 20"), ("N = {}\norder = 21", "from 2 to 20"), ('N = "q"', "")],
)
def test_faults_of_the_file(line, words):
    order = "" if "order" in line else "order = 4\n"
    reading = read_text(f'[phase_space]\n{LINE}[hamiltonian]\nH = "p"\n[[claim]]\nkind = "normal_form"\n{order}{line}')
    assert words in reading.problems[0]["message"]


@pytest.mark.parametrize("seed", range(4))
def test_the_search_among_all_maps_agrees_with_that_among_those_that_commute(seed, monkeypatch):
    """Two ways to the same answer: κ in the kernel of {., H₂}, and any κ at all."""
    rng = random.Random(seed)
    x, y, px, py = variables = sp.symbols("x y px py", real=True)
    H2 = rng.choice([(px**2 + x**2 + py**2 + y**2) / 2, (px**2 + x**2 - py**2 - y**2) / 2, x * px + y * py])
    cubic = [sp.Mul(*rng.choices(variables, k=3)) for _ in range(3)]
    H = H2 + sum(rng.choice((-2, -1, 1, 2)) * term for term in cubic)
    algebra, (parts,) = homogeneous_parts(H, variables, 5)
    normal = normalised(algebra, equilibrium(algebra, parts), 5)
    basis = kernel(algebra, normal.parts[2], [*monomials(algebra, 4), *monomials(algebra, 3)])
    moved = exponential(algebra, dict(normal.parts), rng.choice(basis) + rng.choice(basis) * 2, 5)
    N = {degree: algebra.expression(f) for degree, f in moved.items() if degree > 2}
    changed = {**N, 4: N.get(4, sp.S.Zero) + sp.sympify(H2) ** 2 / 1000}
    answers = [compared(variables, H, claimed, 5, lambda: None) for claimed in (N, changed)]
    monkeypatch.setattr("canon.claims.reached.semisimple", lambda algebra, H2: False)
    again = [compared(variables, H, claimed, 5, lambda: None) for claimed in (N, changed)]
    assert [a.holds for a in answers] == [a.holds for a in again] == [True, False]
    assert [a.fails_at for a in answers] == [a.fails_at for a in again]


def test_a_part_that_is_long_to_expand_ends_with_the_budget():
    text = f'[phase_space]\n{PLANE}[hamiltonian]\nH = "(px**2 + py**2 + x**2 + y**2)/2 + x**3"\n'
    long = "(x + y + px + py + sqrt(1 + x**2) + 1)**40 * (x + 2*y + px + 3)**40"
    (claim,) = read_text(f'{text}[[claim]]\nkind = "normal_form"\norder = 4\nN = {{4 = "{long}"}}\n').claims
    verdict = verify(claim, budget=0.2)
    assert (verdict.status, "budget" in str(verdict)) == ("undecided", True)


def test_a_degree_stands_once():
    text = '[phase_space]\nq = ["q"]\np = ["p"]\n[hamiltonian]\nH = "(p**2 + q**2)/2 + q**3"\n[[claim]]\n'
    (problem,) = read_text(f'{text}kind = "normal_form"\norder = 4\nN = {{4 = "0", 04 = "q**4"}}\n').problems
    assert problem["message"] == "the degree 4 stands there twice"


def test_an_arbitrary_function_in_numbers(ask):
    claim = 'kind = "normal_form"\norder = 4\nN = {}'
    file = {"symbols": 'V = "function"', "hamiltonian": 'H = "p**2/2 + q**2/2 + V(q)*q**3"'}
    assert ask(claim, options={"method": "numeric"}, **file)[0].status == "undecided"


@pytest.mark.parametrize("name", ["q", "p"])
def test_the_origin_is_no_edge(ask, name):
    claim = 'kind = "normal_form"\norder = 3\nN = {}'
    with pytest.raises(InputError, match="one sign"):
        ask(claim, symbols=f'{name} = "nonnegative"', hamiltonian='H = "p**2/2 + q**2/2"')
