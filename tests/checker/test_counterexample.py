"""The checker of refutations: what it shows, that no true claim is shown to be false, and that its intervals hold."""

import ast
import json
import random
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import mpmath
import pytest

from canon.checker import alone, counterexample
from canon.checker.counterexample import Arithmetic, Interval, Open
from tests.checker.certified import certified, resealed

FILE = Path(counterexample.__file__)
LINE = '[phase_space]\nq = ["q"]\np = ["p"]\n'
MAP = LINE.replace("]\np", "]\nQ = ['Q']\nP = ['P']\np")
WELL = "[symbols]\nV = 'function'\nk = 'positive'\n[hamiltonian]\nH = '(p**2 + k**2*q**2)/2 + V(q)'\n"
SHOWN = {
    "fractions": (MAP + "[transformation]\nQ = ['q + p**2']\nP = ['2*p']\n", "kind = 'canonical'"),
    "roots": (MAP + "[transformation]\nQ = ['sqrt(3*q)*cos(p)']\nP = ['sqrt(2*q)*sin(p)']\n", "kind = 'canonical'"),
    "an arc": (MAP + "[transformation]\nQ = ['atan2(q, p)']\nP = ['(q**2 + p**2)/3']\n", "kind = 'canonical'"),
    "another branch": (LINE, "kind = 'identity'\nlhs = 'asin(sin(q))'\nrhs = 'q'"),
    "hyperbolic functions": (LINE, "kind = 'identity'\nlhs = 'atanh(tanh(q)) + asinh(sinh(p))'\nrhs = 'q - p'"),
    "given backward": (
        MAP + "[symbols]\nP = 'positive'\n[hamiltonian]\nH = '(p**2 + q**2)/2'\n[transformation]\n"
        "q = ['sqrt(2*P)*sin(Q)']\np = ['sqrt(2*P)*cos(Q)']\n",
        "kind = 'new_hamiltonian'\nK = 'P + P**2/1000'",
    ),
    "type 1": (
        MAP + "[transformation]\nQ = ['p']\nP = ['-q']\n", "kind = 'generating_function'\ntype = 1\nF = 'q*Q + q*Q**3'"
    ),
    "a function by its formula": (LINE + WELL, "kind = 'conserved'\nf = 'p**2 + k**2*q**2'"),
    "a power": (
        LINE + "[symbols]\na = 'real'\nq = 'positive'\n", "kind = 'bracket'\nf = 'q**a'\ng = 'p'\nequals = 'a'"
    ),
    "an inequality": (LINE, "kind = 'inequality'\nlhs = 'exp(q)'\nrelation = '>'\nrhs = '1 + q + q**2/2'"),
    "equality": (LINE, "kind = 'inequality'\nlhs = '2*q'\nrelation = '<'\nrhs = 'q + q'"),
    "beside a map": (
        MAP + "[transformation]\nQ = ['q**3']\nP = ['p']\n", "kind = 'identity'\nlhs = 'Q*q'\nrhs = 'q**2'"
    ),
}  # fmt: skip


def refutation(name: str) -> Any:
    return certified(*SHOWN[name])


@pytest.mark.parametrize("name", SHOWN)
def test_it_shows_what_is_refuted(name: str) -> None:
    data = refutation(name)
    assert data["verdict"] == "refuted"
    assert counterexample.checked(data) == ("shown", "")
    assert alone.checked(data)[0] == "not shown"


def test_a_changed_certificate_is_wrong() -> None:
    data = refutation("fractions")
    data["witness"]["q"] += "0"
    assert counterexample.checked(data) == ("wrong", "the checksum")
    data = refutation("type 1")
    data["witness"] |= {"q": "0", "p": "0"}
    assert counterexample.checked(resealed(data)) == ("wrong", "nothing fails at the witness")


def answer(claim: Any, witness: Any, **tables: Any) -> str:
    """The answer about a certificate that refutes a claim by a witness."""
    space = {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]}
    tables = {"phase_space": space, **tables, "claim": claim}
    data = {"certificate": 1, "tables": tables, "verdict": "refuted", "witness": witness, "cases": []}
    return counterexample.checked(resealed(data))[0]


ROUND = {"transformation": {"Q": ["q*exp(t)"], "P": ["p*exp(-t)"]}}
TRUE: dict[str, tuple[Any, Any]] = {
    "a quotient that is 1": ({"lhs": "sin(q)/sin(q)", "rhs": "1"}, {}),
    "a pole that is taken away": ({"lhs": "q*(1/q)", "rhs": "1"}, {}),
    "a slope": ({"lhs": "q**3*D(1/q**2, q)", "rhs": "-2"}, {}),
    "the root of a square": ({"lhs": "D(sqrt(q**2), q)**2", "rhs": "1"}, {}),
    "a cube root, of what is positive": ({"lhs": "cbrt(q**3)", "rhs": "q"}, {}),
    "a logarithm": ({"lhs": "exp(log(q))", "rhs": "q"}, {}),
    "two logarithms": ({"lhs": "log(q*p)", "rhs": "log(q) + log(p)"}, {}),
    "what is multiplied by 0": ({"lhs": "0*log(q) + q**2/q", "rhs": "q"}, {}),
    "a sum of arcs": ({"lhs": "asin(q) + acos(q)", "rhs": "pi/2"}, {}),
    "an angle": ({"lhs": "tan(atan2(q, p))", "rhs": "q/p"}, {}),
    "a hyperbolic function": ({"lhs": "acosh(cosh(q) + 1/10**40)", "rhs": "acosh(cosh(q) + 1/10**40)"}, {}),
    "a very small angle": ({"lhs": "sin(q/10**90)**2 + cos(q/10**90)**2", "rhs": "1"}, {}),
    "a very large angle": ({"lhs": "sin(10**90*q)**2 + cos(10**90*q)**2", "rhs": "1"}, {}),
    "a domain": ({"lhs": "sqrt((q - 1)**2)", "rhs": "q - 1"}, {"domain": {"where": ["q > 1"]}}),
    "a chain": ({"lhs": "asin(sin(q))", "rhs": "q"}, {"domain": {"where": ["-pi/2 < q < pi/2"]}}),
    "another side": ({"lhs": "atan(1/q) + atan(q)", "rhs": "pi/2"}, {"domain": {"where": ["q >= 0", "p != 0"]}}),
    "a name that is positive": ({"lhs": "sqrt(c**2)", "rhs": "c"}, {"symbols": {"c": "positive"}}),
    "a name that is negative": ({"lhs": "sqrt(c**2)", "rhs": "-c"}, {"symbols": {"c": ["real", "negative"]}}),
    "a whole number": ({"lhs": "sin(pi*n)", "rhs": "0"}, {"symbols": {"n": "integer"}}),
    "a new variable that is positive": (
        {"lhs": "sqrt(q**2)", "rhs": "q"}, {"symbols": {"Q": "positive"}, **ROUND},
    ),
    "a new variable's value": ({"lhs": "Q*P", "rhs": "q*p"}, ROUND),
    "a condition on it": ({"lhs": "sqrt(Q**2)", "rhs": "Q"}, {"domain": {"where": ["0 < Q"]}, **ROUND}),
    "a Hamiltonian's own domain": ({"lhs": "sqrt(q**2)", "rhs": "q"}, {"hamiltonian": {"H": "p**2 + log(q)"}}),
    "it beside a map": ({"kind": "canonical"}, {"hamiltonian": {"H": "p**2 + log(q)"}, "transformation": {
        "Q": ["sqrt(q**2)"], "P": ["p"]}}),
    "the domain of a map that is given by a generating function": (
        {"lhs": "sqrt(q**2)", "rhs": "q"}, {"generating_function": {"type": 2, "F": "P*log(q)"}},
    ),
    "a map's own domain": (
        {"lhs": "sqrt(q**2)", "rhs": "q"}, {"transformation": {"Q": ["log(q)"], "P": ["q*p"]}},
    ),
    "a map": ({"kind": "canonical"}, ROUND),
    "a scale": ({"kind": "canonical", "scale": "c"}, {"symbols": {"c": "nonzero"}, "transformation": {
        "Q": ["c*q"], "P": ["p"]}}),
    "a map's scale": ({"kind": "new_hamiltonian", "K": "3*P**2"}, {"hamiltonian": {"H": "p**2"}, "transformation": {
        "Q": ["3*q"], "P": ["p/1"]}, "symbols": {}}),
    "a map backward": ({"kind": "canonical"}, {"transformation": {
        "q": ["sqrt(2*P)*sin(Q)"], "p": ["sqrt(2*P)*cos(Q)"]}}),
    "a bracket beside it": ({"kind": "new_hamiltonian", "K": "P**2/4"}, {"transformation": {
        "q": ["2*Q"], "p": ["P"]}, "hamiltonian": {"H": "bracket(q, p)*p**2/2"}}),
    "a generating function up to time": (
        {"kind": "generating_function", "type": 2, "F": "q*P*exp(t) + sin(t)"}, ROUND,
    ),
    "a function": ({"kind": "bracket", "f": "V(q)", "g": "p", "equals": "D(V(q), q)"}, {"symbols": {"V": "function"}}),
    "a function that is positive": ({"lhs": "sqrt(V(q)**2)", "rhs": "V(q)"}, {"symbols": {
        "V": ["function", "positive"]}}),
    "a function that has one sign": ({"lhs": "sqrt(V(q)**2*V(p)**2)", "rhs": "V(q)*V(p)"}, {"symbols": {
        "V": ["function", "nonzero"]}}),
    "a difference that nobody sees": ({"kind": "inequality", "lhs": "sin(q)**2 + cos(q)**2", "relation": "<",
        "rhs": "1 + 1/10**300"}, {}),
    "a square": ({"kind": "inequality", "lhs": "q**2", "relation": ">=", "rhs": "0"}, {}),
    "an exponential": ({"kind": "inequality", "lhs": "exp(q)", "relation": ">", "rhs": "0"}, {}),
    "the side of a motion": ({"kind": "inequality", "lhs": "q", "relation": "<=", "rhs": "0"}, {"domain": {
        "where": ["q < 0"]}}),
    "a motion": ({"kind": "conserved", "f": "q - p*t"}, {"hamiltonian": {"H": "p**2/2"}}),
    "a field": ({"kind": "hamiltonian_field", "qdot": ["p"], "pdot": ["-q"], "H": "(p**2 + q**2)/2"}, {}),
    "the field of some other H": ({"kind": "hamiltonian_field", "qdot": ["p"], "pdot": ["-q"]}, {
        "hamiltonian": {"H": "p**2/2"}}),
    "a surface": ({"lhs": "q", "rhs": "1"}, {"domain": {"on": ["q - 1"]}}),
    "a shift that a claim's own key says": ({"kind": "canonical", "order": ["eps", 1]}, {"symbols": {
        "eps": "real"}, "transformation": {"Q": ["q + eps*p"], "P": ["p + eps**2*q"]}}),
    "an imaginary number": ({"lhs": "(1j*q)**2", "rhs": "-q**2"}, {}),
}  # fmt: skip
VALUES = ("0", "1", "-1", "2", "-2", "1/2", "-7/3", "22/7", "-1000000000001/1000000000000", "1/100000000000000000000")


@pytest.mark.parametrize("name", TRUE)
def test_no_true_claim_is_shown_to_be_false(name: str) -> None:
    """At points of the domain and outside of it, in integers and near them, with names left out, or of others."""
    claim, tables = TRUE[name]
    rng = random.Random(name)
    names = ["q", "p", "Q", "P", "t", "c", "n", "eps"]
    for k in range(8):
        witness = {x: rng.choice(VALUES) if k > 3 else VALUES[k] for x in names if k % 4 or rng.random() < 0.8}
        witness |= {"V": rng.choice(["a", "a**2 - 1/2", "-1", "sqrt(a)", "1/a", "q", "exp(a)"])} if k % 2 else {}
        found = answer({"kind": "identity", **claim}, {**witness, "_lhs": "1", "_H": "0", "pi": "3"}, **tables)
        assert found != "shown", witness


def test_what_is_false_is_shown_where_it_fails_in_the_domain_alone() -> None:
    claim, where = {"kind": "identity", "lhs": "sqrt(q**2)", "rhs": "q"}, {"domain": {"where": ["q < -1", "p > q"]}}
    assert answer(claim, {"q": "-2", "p": "0"}, **where) == "shown"
    assert answer(claim, {"q": "-2", "p": "-2"}, **where) == "not shown"
    assert answer(claim, {"q": "-1", "p": "0"}, **where) == "not shown"
    assert answer(claim, {"q": "2", "p": "3"}, **where) == "not shown"


def test_a_difference_that_is_small_is_seen_and_one_that_is_smaller_is_not() -> None:
    claim = {"kind": "identity", "lhs": "exp(q)*exp(p)"}
    assert answer({**claim, "rhs": "exp(q + p) + 1/10**150"}, {"q": "1/3", "p": "-5/7"}) == "shown"
    assert answer({**claim, "rhs": "exp(q + p) + 1/10**160"}, {"q": "1/3", "p": "-5/7"}) == "not shown"


@pytest.mark.parametrize(
    "witness", [{"q": "q"}, {"q": {"re": "1", "im": "1"}}, {"q": ["1"]}, {"q": "1e999999999"}, [1]]
)
def test_what_is_no_point_shows_nothing(witness: Any) -> None:
    assert answer({"kind": "identity", "lhs": "q", "rhs": "p"}, witness) == "not shown"


@pytest.mark.parametrize("data", [[], {}, {"checksum": ""}, None, {"checksum": 1, "tables": []}])
def test_what_is_no_certificate_is_said_to_be_none(data: Any) -> None:
    assert counterexample.checked(data)[0] != "shown"


def test_large_numbers_and_high_derivatives_are_not_waited_for() -> None:
    squares = {f"a{k + 1}": f"a{k}*a{k}" for k in range(60)}
    for first in ("10*q", "exp(q)", "1/q"):
        tables = {"definitions": {"a0": first, **squares}}
        for formula in ("a60", "sin(a60)", "exp(a60)", "D(a60, q)"):
            assert answer({"kind": "identity", "lhs": formula, "rhs": "1"}, {"q": "3"}, **tables) == "not shown"
    nested = {f"a{k + 1}": f"D(sin(a{k})*a{k}, q, 7)" for k in range(6)}
    tables = {"definitions": {"a0": "q*p", **nested}}
    assert answer({"kind": "identity", "lhs": "a6", "rhs": "1"}, {"q": "3", "p": "1/7"}, **tables) == "not shown"


def exact(x: Any) -> Fraction:
    sign, mantissa, exponent, _ = mpmath.mpf(x)._mpf_
    return (-1) ** sign * int(mantissa) * Fraction(2) ** exponent


def some_number(rng: random.Random) -> Fraction:
    digits = 10 ** rng.choice([0, 1, 3, 30])
    x = Fraction(rng.randint(-20 * digits, 20 * digits), rng.randint(1, digits))
    return rng.choice([x, x * 10**25, x / 10**40, 1 + x / 10**30, x - 1, Fraction(round(x), 2)])


@pytest.mark.parametrize("bits", [64, 300])
def test_intervals_hold_what_mpmath_says(bits: int) -> None:
    """Near 0 and far from it, near 1, and near the zeros of sines and cosines."""
    rng, real = random.Random(bits), Arithmetic(bits)
    with mpmath.workprec(1500):
        for _ in range(150):
            x = some_number(rng)
            turns = exact(mpmath.pi * rng.randint(-(10**12), 10**12) / 2) + some_number(rng) / 10**50
            found: list[tuple[Interval, Any]] = []
            for y in (x, Fraction(turns.numerator * 2**200 // turns.denominator, 2**200)):
                z = mpmath.mpf(y.numerator) / y.denominator
                found += [(real.sine((y, y)), mpmath.sin(z)), (real.sine((y, y), 1), mpmath.cos(z))]
                found.append((real.monotone(real.atan, (y, y)), mpmath.atan(z)))
            z = mpmath.mpf(x.numerator) / x.denominator
            found += [(real.monotone(real.exp, (x, x)), mpmath.exp(z))] if abs(x) < 1000 else []
            for f, value in ((real.log, mpmath.log), (real.root, mpmath.sqrt)) if x > 0 else ():
                found.append((real.monotone(f, (x, x)), value(z)))
            for (low, high), value in found:
                middle = exact(value)
                spare = (1 + abs(middle)) / 2**1400
                assert low - spare <= middle <= high + spare
                assert high - low <= (1 + abs(middle)) / 2 ** (bits - 2)


def test_intervals_hold_all_values_of_an_interval() -> None:
    rng, real = random.Random(3), Arithmetic(64)
    for _ in range(150):
        (a, b), wide = (some_number(rng), some_number(rng)), Fraction(rng.randint(0, 99), 10 ** rng.randint(0, 9))
        x, y = (a, a + wide), (b, b + wide * 3)
        s, t = a + wide * rng.randint(0, 8) / 8, b + wide * 3 * rng.randint(0, 8) / 8
        n = rng.randint(0, 7)
        ways = [(real.add(x, y), s + t), (real.times(x, y), s * t), (real.power(x, n), s**n)]
        with mpmath.workprec(300):
            z = mpmath.mpf(s.numerator) / s.denominator
            ways += [(real.sine(x), exact(mpmath.sin(z))), (real.monotone(real.atan, x), exact(mpmath.atan(z)))]
        assert all(low - Fraction(1, 2**200) <= value <= high + Fraction(1, 2**200) for (low, high), value in ways)
        if x[0] <= 0 <= x[1]:
            with pytest.raises(Open):
                real.power(x, -1)
        else:
            low, high = real.power(x, -n)
            assert low <= 1 / s**n <= high


def test_it_has_less_than_300_lines_of_code() -> None:
    """Lines but for empty ones, comments and docstrings, none longer than the house's."""
    text = FILE.read_text(encoding="utf-8")
    docs = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Expr)]
    said = {line for node in docs for line in range(node.lineno, (node.end_lineno or 0) + 1)
            if isinstance(node.value, ast.Constant)}  # fmt: skip
    lines = [line for number, line in enumerate(text.splitlines(), 1) if number not in said]
    assert len([line for line in lines if line.strip() and not line.strip().startswith("#")]) < 300
    assert max(map(len, lines)) <= 120


def test_it_needs_nothing_but_python_and_the_other_file(tmp_path: Path) -> None:
    """Copies of both, elsewhere, by a Python that sees no packages."""
    for file in (FILE, Path(alone.__file__)):
        (tmp_path / file.name).write_bytes(file.read_bytes())
    data, command = refutation("an arc"), [sys.executable, "-ES", tmp_path / FILE.name, "c.json"]
    for change, status, word in (({}, 0, "shown"), ({"method": "by hand"}, 1, "wrong")):
        (tmp_path / "c.json").write_text(json.dumps({**data, **change}), encoding="utf-8")
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
        assert (done.returncode, done.stderr) == (status, "")
        assert word in done.stdout
