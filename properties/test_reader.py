"""The reader of formulas and of claim files: whatever it is given, a value or an `InputError`, and soon."""

import time

from hypothesis import example, given
from hypothesis import strategies as st

from canon.claims.reader import read_text
from canon.errors import InputError
from canon.expression import Formula, Vocabulary, read
from canon.mechanics.phase_space import PhaseSpace

SPACE = PhaseSpace("q x", "p y", new=("Q X", "P Y"), positive="m", symbols={"n": "integer", "z": "complex"})
VOCABULARY = Vocabulary(symbols=SPACE.vocabulary, functions=frozenset({"V"}), pairs=((SPACE.q[0], SPACE.p[0]),))
NAMES = ("q", "p", "x", "m", "n", "z", "pi", "1j", "V", "e", "lambda", "__import__", "None", "True")
CALLS = (
    "sqrt",
    "exp",
    "log",
    "sin",
    "atan2",
    "abs",
    "sign",
    "D",
    "bracket",
    "V",
    "gamma",
    "elliptic_f",
    "cbrt",
    "eval",
)
SECONDS = 10


@st.composite
def texts(draw: st.DrawFn, depth: int = 4) -> str:
    """Texts that are nearly formulas."""
    if depth == 0 or draw(st.integers(0, 5)) == 0:
        return draw(st.sampled_from((*NAMES, "0", "1", "2", "1/3", "0.1", "1e-3", "9", "10**6", "1e400", "007", "")))
    one = draw(texts(depth=depth - 1))
    kind = draw(st.integers(0, 5))
    if kind == 0:
        return f"({one})"
    if kind == 1:
        return f"-{one}"
    if kind == 2:
        arguments = [one, *(draw(texts(depth=depth - 1)) for _ in range(draw(st.integers(0, 2))))]
        return f"{draw(st.sampled_from(CALLS))}({', '.join(arguments)})"
    sign = draw(st.sampled_from(("+", "-", "*", "/", "**", "//", "%", "@", ".", "<", "=", " ", ",")))
    return f"{one}{sign}{draw(texts(depth=depth - 1))}"


def only_input_errors(text: str) -> None:
    """Read it, and fail for anything but a formula or an `InputError` that says something."""
    start = time.process_time()
    message = "a formula"
    try:
        assert isinstance(read(text, VOCABULARY), Formula)
    except InputError as error:
        message = error.message
    assert message
    assert time.process_time() - start < SECONDS, text


@given(texts())
@example("9**9**9**9")
@example("(" * 5000)
@example("sqrt(" * 90 + "q" + ")" * 90)
@example("q**(1/100000007)")
@example("\x00")
@example("q.__class__")
@example("[q for q in x]")
@example("exp(1000*log(10**300))")
def test_near_formulas(text: str):
    only_input_errors(text)


@given(st.text(max_size=40))
def test_any_text(text: str):
    only_input_errors(text)


LINES = (
    "[phase_space]", 'q = ["q"]', 'p = ["p"]', 'Q = ["Q"]', 'P = ["P"]', "[symbols]", 'a = "positive"',
    "[transformation]", 'Q = ["2*q"]', 'P = ["p/2"]', "[[claim]]", 'kind = "canonical"', 'kind = "volume"', "[domain]",
    'where = ["q > 0"]', 'on = ["q - p"]', "type = 2", 'F = "q*P"', "[generating_function]", "scale = 2", "q = 1",
    "[hamiltonian]", 'H = "p"', "= 3", "[[", 'a = "nonsense"', 'kind = "bracket"', 'f = "q"', 'g = "p"', 'equals = "1"',
    'order = ["a", 2]',
)  # fmt: skip


@given(st.lists(st.sampled_from(LINES), max_size=25))
def test_near_claim_files(lines: list[str]):
    reading = read_text("\n".join(lines))
    assert reading.claims or reading.problems
    assert all(problem["message"] for problem in reading.problems)


@given(st.text(max_size=200))
def test_any_file(text: str):
    reading = read_text(text)
    assert reading.problems
