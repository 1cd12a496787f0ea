"""What a claim is made into by rules is decided as it must be: a short run of each, and of the rules by themselves."""

import random
from contextlib import suppress

import pytest

from canon import verify
from canon.claims import document
from canon.claims.reader import read_tables
from canon.errors import EmptyDomain
from canon.syntax import parse
from properties.metamorphic import analysis, equations
from properties.metamorphic.__main__ import Source, Variant, contradicts, sources, variant
from properties.metamorphic.rules import KINDS, SAME, STRONGER, WEAKER
from properties.metamorphic.spoiled import is_true
from properties.metamorphic.tables import alone, in_nodes, in_toml, mapped, shown

POLAR = alone(document.parse("""
title = "Polar coordinates"
[phase_space]
q = ["x", "y"]
p = ["px", "py"]
Q = ["r", "f"]
P = ["pr", "pf"]
[symbols]
m = "positive"
a = "real"
V = "function"
[definitions]
R = "sqrt(x**2 + y**2)"
[hamiltonian]
H = "(px**2 + py**2)/(2*m) + V(R)"
[transformation]
Q = ["R", "atan2(y, x)"]
P = ["(x*px + y*py)/R", "x*py - y*px + 2*a - a - a"]
[domain]
where = ["0 < x < 10", "y > -a**2"]
[[claim]]
kind = "canonical"
"""), 0)  # fmt: skip
IDENTITY = alone(document.parse("""
phase_space = { q = ["x"], p = ["p"] }
symbols = { a = "positive", b = "real", n = "integer", V = "function" }
domain = { where = ["x > 0"] }
[[claim]]
kind = "identity"
lhs = "log(a*x) + sin(b)*exp(-V(x)) + n*x**2"
rhs = "log(a) + log(x) + sin(b)*exp(-V(x)) + n*x**2"
"""), 0)  # fmt: skip


@pytest.mark.parametrize("tables", [POLAR, IDENTITY], ids=["map", "identity"])
@pytest.mark.parametrize("rule", [name for name in (*SAME, *WEAKER) if not hasattr(analysis, name)])
def test_no_rule_makes_a_true_claim_false(rule, tables):
    """Where a rule has a place in one of these two claims it makes what is read, and not refuted."""
    made = [new for seed in range(20) if (new := {**SAME, **WEAKER}[rule](random.Random(seed), tables)) is not None]
    for new in made[:2]:
        reading = read_tables(new)
        assert not reading.problems, in_toml(new)
        with suppress(EmptyDomain):
            assert verify(reading.claims[0], budget=2).status != "refuted", in_toml(new)
    assert made or rule in NOWHERE[tables["claim"][0]["kind"]]


NOWHERE = {
    "canonical": (
        "with_other_integers", "as_real_and_imaginary", "by_another_equation", "with_a_hole", "by_a_domain",
        "multiplied", "by_derivatives", "with_another_hamiltonian", "at_an_integer", "at_another_time", "by_a_surface",
    ),
    "identity": (
        "as_real_and_imaginary", "by_another_equation", "to_other_coordinates", "read_backward", "written_out",
        "with_another_hamiltonian", "at_another_time", "by_a_surface",
    ),
}  # fmt: skip
"""The rules that have no place in these two claims."""


@pytest.mark.parametrize("rule", STRONGER)
def test_what_a_false_claim_follows_from_is_not_proved(rule):
    false = {**IDENTITY, "claim": [{**IDENTITY["claim"][0], "rhs": "2*log(a) + log(x) + sin(b)*exp(-V(x)) + n*x**2"}]}
    made = [new for seed in range(20) if (new := STRONGER[rule](random.Random(seed), false)) is not None]
    assert made
    for new in made[:4]:
        assert verify(read_tables(new).claims[0], budget=2).status != "proved", in_toml(new)


@pytest.mark.parametrize("tables", [POLAR, IDENTITY], ids=["map", "identity"])
@pytest.mark.parametrize("rule", ["as_another_kind", "as_not"])
def test_claims_of_other_kinds(rule, tables):
    for seed in range(6):
        new = KINDS[rule](random.Random(seed), tables)
        assert new is not None
        status = verify(read_tables(new).claims[0], budget=2).status
        assert status != ("proved" if rule == "as_not" else "refuted"), in_toml(new)


def test_trees_are_written_as_they_are_read():
    for text in (
        "-x**2",
        "(-x)**2",
        "a-(b-c)/d*e",
        "2**-x",
        "D(V(x,-y),x,2)",
        "1.5e-3*x",
        "x/(y/z)/-u",
        "3j*x",
        "-(-x)",
    ):
        assert shown(parse(shown(parse(text)))) == shown(parse(text))
    assert mapped(POLAR, lambda text: in_nodes(text, lambda node: node)) == {k: v for k, v in POLAR.items() if v != {}}


def test_what_is_spoiled_is_judged_by_mpmath():
    rng = random.Random(1)
    assert is_true(rng, IDENTITY) is True
    assert is_true(rng, {**POLAR, "symbols": {**POLAR["symbols"], "m": "negative"}}) is True
    wrong = {**POLAR, "transformation": {**POLAR["transformation"], "P": ["(x*px+y*py)/R", "x*py-1001/1000*y*px"]}}
    assert is_true(rng, wrong) is False
    assert is_true(rng, {**POLAR, "domain": {"on": ["x - y"]}}) is None
    found = Variant(Source("", POLAR, True), ("spoiled",), wrong, None)
    assert contradicts(found, "proved")
    assert not contradicts(found, "refuted")


def test_variants_of_the_catalogue_are_read():
    chosen = random.Random(2).sample(sources(), 25)
    made = [new for source in chosen for asked in ("same", "mixed", "spoiled") if (new := variant(source, "1", asked))]
    problems = [in_toml(new.tables) for new in made if read_tables(new.tables).problems]
    assert len(made) > 30
    assert len(problems) < 0.1 * len(made)


ANALYSIS = """
phase_space = { q = ["q"], p = ["p"] }
symbols = { w = "positive", b = "real", V = "function" }
hamiltonian = { H = "(p**2 + w**2*q**2)/2" }
claim = [
  { kind = "action", coordinate = "q", energy = "E", equals = "2*pi*E/w" },
  { kind = "frequency", coordinate = "q", energy = "E", equals = "w/(2*pi)" },
  { kind = "integral", f = "w*x**2", variable = "x", from = "0", to = "b", equals = "w*b**3/3" },
  { kind = "limit", f = "sin(b*x)/x", variable = "x", to = "0", side = "+", equals = "b" },
  { kind = "legendre", L = "v**2/2 - w**2*q**2/2", velocities = ["v"] },
  { kind = "stationary", L = "v**2/2", velocities = ["v"], path = ["b*t"], from = "0", to = "1", extremum = "minimum" },
  { kind = "lie_series", generator = "p*q", parameter = "s", f = "q", equals = "q*exp(s)" },
  { kind = "average", f = "q**2", equals = "E/w**2", coordinate = "q", energy = "E" },
  { kind = "noether", L = "v**2/2 - V(v)", velocities = ["v"], dq = ["1"] },
  { kind = "matrix_algebra", equals = "sl(2,R)", basis = { A = [[1,0],[0,-1]], B = [[0,1],[0,0]], C = [[0,0],[1,0]] } },
]
"""


def test_claims_of_dynamics_and_analysis():
    """In other variables of their own they stay true; what they imply is true, and what denies them false."""
    tables, made = document.parse(ANALYSIS), 0
    rules = {
        name: rule
        for name, rule in {**SAME, **KINDS}.items()
        if rule.__module__ in (analysis.__name__, equations.__name__)
    }
    for k in range(len(tables["claim"])):
        for name, rule in rules.items():
            new = rule(random.Random(k), alone(tables, k))
            if new is not None:
                status = verify(read_tables(new).claims[0], budget=2).status
                assert status != ("proved" if name == "as_not_quite" else "refuted"), in_toml(new)
                made += 1
    assert made > 20
