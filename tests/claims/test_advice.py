"""What people write wrong by hand, and what they are told to write instead."""

import pytest

from canon.claims import document
from canon.claims.verify import verify
from canon.errors import InputError
from canon.expression import Vocabulary, read
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.transformation import Transformation
from canon.numeric.integrators import catalogue
from canon.report.proof.of_claim import proof
from canon.scenes.reader import read_scene_text
from tests.claims.stated import DEMAND, OSCILLATOR, PLANE, claim, fault_of

SCENE = '[[body]]\nmass = 1.0\nposition = [1.0, 0.0]\n[[effect]]\nkind = "spring"\nk = {}\n[run]\nduration = 1.0\n{}'


@pytest.mark.parametrize(
    ("text", "advice"),
    [
        (PLANE + "[claim]\n[claim]\n", "line 6, column 7): write [[claim]], in double brackets, for each"),
        (PLANE + "[symbols]\n[symbols]\n", ": each section stands once"),
        (PLANE + '[hamiltonian]\nH = "x"\nH = "y"\n', ": a key stands once in its section"),
        (PLANE + "[hamiltonian]\nH = x**2\n", ": a formula is written in quotes, and a number without a unit"),
        (PLANE + "[hamiltonian]\nH = 2*x\n", ": a formula is written in quotes, and a number without a unit"),
        (PLANE + "[hamiltonian]\nH = -(x + 1)\n", ": a formula is written in quotes, and a number without a unit"),
        (PLANE + "[symbols]\nm = 9.81 m\n", "and a number without a unit"),
        (PLANE + "[symbols]\nm = 1" + DEMAND, 'as "positive": what has a value is given in [definitions]'),
        (PLANE + "[[body]]\n" + DEMAND, "unknown key 'body': that is a scene's, and `canon simulate` runs it"),
        (PLANE + '[hamiltonian]\nH = "k*x"' + DEMAND, "unknown name 'k' at column 1: declare it in [symbols]"),
        (
            PLANE + '[hamiltonian]\nH = "x"\n' + claim("conserved", 'f = "H"'),
            'a key of [hamiltonian] is no name: define H in [definitions], and write H = "H" there',
        ),
        (OSCILLATOR + claim("new_hamiltonian", 'K = "ω*I"'), "unknown name 'ω' at column 1: did you mean 'omega'?"),
        (OSCILLATOR + claim("symplectic"), "unknown kind 'symplectic': did you mean 'canonical'?"),
    ],
)
def test_claim_files(text, advice):
    assert fault_of(text).endswith(advice)


@pytest.mark.parametrize("text", ["a = [1\n", "a =\n", "[b\n", 'a = "x\n', "\n\na"])
def test_no_advice_where_none_is_known(text):
    with pytest.raises(InputError) as caught:
        document.parse(text)
    assert caught.value.message.endswith(")")


@pytest.mark.parametrize(
    ("text", "advice"),
    [
        ("|x|", "write an absolute value as abs(...)"),
        ("x!", "gamma(n + 1)"),
        ("x'", "a derivative is written as D(f, x)"),
        (r"\frac{x}{2}", "write a fraction as a/b, a root as sqrt(...)"),
        ("diff(x, x)", "write D(f, x)"),
        ("sin x", "write a product with *, a function's argument in parentheses, as in sin(x)"),
        ("sin 2*x", "as in sin(2)"),
        ("sin**2(x)", "a power of a function behind it, as in sin(...)**2"),
        ("2(x + 1)", "before '(' at column 2: write a product with *"),
        ("(x)(x)", "before '(' at column 4: write a product with *"),
    ],
)
def test_formulas(text, advice):
    x = PhaseSpace("x", "p").vocabulary
    with pytest.raises(InputError) as caught:
        read(text, Vocabulary(x))
    assert caught.value.message.endswith(advice)


@pytest.mark.parametrize(
    ("text", "advice"),
    [
        (SCENE.format('"1/r"', ""), "unknown name 'r' at column 3: the names here are t, x, y"),
        (SCENE.format("1.0", 'monitor = ["laplace-runge"]'), "lrl, casimir, symplecticity, volume, loop, cartan, "),
        (SCENE.format("1.0", 'monitor = ["enrgy"]'), "unknown monitor 'enrgy': did you mean 'energy'?"),
        (SCENE.format("1.0", 'monitor = ["energy", "energy"]'), "'energy' is listed twice"),
        (SCENE.format("1.0", "[[claim]]"), "that is a claim file's, and `canon verify` checks it"),
        (
            '[system]\nq_names = ["q"]\np_names = ["p"]\nH = "p**2/m"\nq = [1]\np = [0]\n[run]\nduration = 1',
            "unknown name 'm' at column 6: give its value in parameters, as in parameters = { m = 1.0 }",
        ),
    ],
)
def test_scenes(text, advice):
    with pytest.raises(InputError) as caught:
        read_scene_text(text)
    assert advice in caught.value.message


@pytest.mark.parametrize(("name", "meant"), [("leapfrog", "verlet"), ("Velocity-Verlet", "verlet"), ("rk45", "rk4")])
def test_integrators_by_other_names(name, meant):
    with pytest.raises(InputError) as caught:
        catalogue.method(name)
    assert caught.value.message.endswith(f"there is {meant}")


def test_every_other_name_of_an_integrator_is_one_of_an_integrator():
    for name, meant in catalogue.OTHER_NAMES.items():
        assert catalogue.method(meant).name == meant != name


def test_in_python():
    space = PhaseSpace("q", "p", new=("Q", "P"))
    q, p = space.symbols("q p")
    same = Transformation(space, Q=q, P=p)
    for wrong, said in (
        (lambda: PhaseSpace("q", "p", new="Q P"), "new is a pair"),
        (lambda: Transformation(space, Q="q**2", P=p), "not 'q**2'; text is read by space.formula"),
        (lambda: Transformation(space, Q=None, P=p), "an expression is expected, not None"),  # pyright: ignore
        (lambda: Transformation(space, Q=lambda: q, P=p), "an expression is expected, not <function"),  # pyright: ignore
        (lambda: verify(same.canonical), "call it"),  # pyright: ignore
        (lambda: proof(verify(same.canonical())), "claim: a Claim is expected, not Verdict"),  # pyright: ignore
    ):
        with pytest.raises(InputError, match=said.replace("*", r"\*").replace("(", r"\(")):
            wrong()
