"""Claim files: what is read from them."""

import pickle

import sympy as sp

from canon.claims.keys import KEYS
from canon.claims.kinds import KINDS
from canon.claims.reader import read_text
from tests.claims.stated import EULER, OSCILLATOR, PLANE, claim, claims_of, fault_of


def test_the_example_of_the_format():
    canonical, generates, new = claims_of(
        'title = "t"\nsource = "s"\n' + OSCILLATOR + claim("canonical") + claim("generates")
        + claim("new_hamiltonian", 'K = "omega*I"\nexpect = "proved"\nbudget = 2.5\ntitle = "here"')
    )  # fmt: skip
    assert [c.kind for c in (canonical, generates, new)] == ["canonical", "generates", "new_hamiltonian"]
    assert [c.index for c in (canonical, generates, new)] == [0, 1, 2]
    assert canonical.source == "s"
    assert (new.title, new.expect, new.budget) == ("here", "proved", 2.5)
    subject = new.subject
    assert subject is canonical.subject
    assert subject.space.q[0].name == "q"
    assert subject.generating_function.type == 1
    assert subject.transformation.direction == "forward"
    I, omega = subject.space.symbols("I omega")
    assert new.keys["K"].expr == I * omega
    assert omega.is_positive
    assert subject.hamiltonian.text == "E0"


def test_claims_travel_between_processes():
    (one,) = claims_of(OSCILLATOR + claim("new_hamiltonian", 'K = "omega*I"'))
    assert pickle.loads(pickle.dumps(one)).keys["K"] == one.keys["K"]  # noqa: S301 - our own


def test_one_bad_claim_leaves_the_others():
    reading = read_text(
        PLANE + claim("bracket", 'f="x"\ng="qx"\nequals=1') + claim("bracket", 'f="x"\ng="px"\nequals=1')
    )
    assert [c.index for c in reading.claims] == [1]
    assert reading.problems == [
        {"where": "claim 1, key 'g'", "message": "unknown name 'qx' at column 1: did you mean 'x'?"}
    ]


def test_a_bad_section_fails_the_file():
    reading = read_text(PLANE + '[hamiltonian]\nH = "px**2 + u"\n' + claim("identity", 'lhs="x"\nrhs="x"'))
    assert reading.claims == []
    assert reading.problems[0]["where"] == "[hamiltonian], key 'H'"


def test_numbers_in_toml_are_exact():
    (one,) = claims_of(PLANE + claim("bracket", "f = 0.1\ng = 1\nequals = 1e-3"))
    assert [one.keys[k].expr for k in ("f", "g", "equals")] == [sp.Rational(1, 10), 1, sp.Rational(1, 1000)]


KS = """
[phase_space]
q = ["a", "b"]
p = ["u", "v"]
Q = ["X"]
P = ["Y"]
[transformation]
Q = ["a"]
P = ["u"]
[hamiltonian]
H = "u**2"
"""


def test_fewer_new_pairs_than_old_ones():
    assert [c.kind for c in claims_of(KS + claim("canonical") + claim("fundamental_brackets"))]
    for kind, keys in [("volume", ""), ("new_hamiltonian", 'K="X"'), ("symmetry", ""), ("integral_invariant", "")]:
        assert "as many new pairs as old ones, not 1 for 2" in fault_of(KS + claim(kind, keys))
    generating = KS + '[generating_function]\ntype=1\nF="a*X"\n'
    assert "[generating_function], key 'type': a generating function needs" in fault_of(generating + claim("generates"))


def test_definitions_are_read_from_top_to_bottom_and_faults_told_where_used():
    text = PLANE + '[definitions]\na = "b"\nb = "x"\nc = "1/u"\nd = "c + 1"\n' + claim("identity", 'lhs="d"\nrhs="b"')
    problems = read_text(text).problems
    assert problems[0] == {"where": "claim 1, key 'lhs'", "message": problems[0]["message"]}
    assert problems[0]["message"].startswith("the definition 'c' is wrong: unknown name 'u'")
    assert problems[1:] == [
        {
            "where": "[definitions], key 'a'",
            "message": "'b' at column 1 is defined further down: definitions are read from top to bottom",
        }
    ]


def test_conditions_of_definitions_come_along():
    (one,) = claims_of(PLANE + '[definitions]\nr = "sqrt(x**2+y**2)"\n' + claim("identity", 'lhs="r/r"\nrhs="1"'))
    assert [str(c) for c in one.keys["lhs"].conditions] == ["x**2+y**2 > 0"]


def test_the_domain():
    text = PLANE + '[domain]\nwhere = ["0 < x <= pi", "y != 0", "1 < 2"]\non = ["x - sqrt(y)", "0"]\n'
    (one,) = claims_of(text + claim("identity", 'lhs="x"\nrhs="x"'))
    domain = one.subject.domain
    assert [str(c) for c in domain.conditions] == ["0 < x", "x < pi", "y != 0", "y > 0"]
    x, y = one.subject.space.symbols("x y")
    assert domain.surface == (x - sp.sqrt(y),)
    assert one.subject.space.domain == domain


def test_names_that_claims_declare():
    H = '[hamiltonian]\nH = "(px**2+py**2)/2"\n'
    legendre, series = claims_of(
        PLANE + H + claim("legendre", 'L="(vx**2+vy**2)/2"\nvelocities=["vx","vy"]')
        + claim("lie_series", 'generator="px"\nparameter="s"\nf="x"\nequals="x+s"')
    )  # fmt: skip
    assert [v.name for v in legendre.keys["velocities"]] == ["vx", "vy"]
    assert series.keys["parameter"] in series.keys["equals"].expr.free_symbols
    truncated = '[transformation]\nQ=["q+eps*p"]\nP=["p"]\n'
    (one,) = claims_of(OSCILLATOR.split("[transformation]")[0] + truncated + claim("canonical", 'order=["eps", 2]'))
    eps, order = one.keys["order"]
    assert (eps.name, order) == ("eps", 2)
    assert eps in one.subject.transformation.Q[0].expr.free_symbols


def test_time():
    (one,) = claims_of(PLANE + claim("conserved", 'f="x-px*t"') + '[hamiltonian]\nH="px**2/2"\n')
    assert one.subject.space.t.name == "t"
    (two,) = claims_of('[phase_space]\nq=["x","t"]\np=["p","pt"]' + claim("bracket", 'f="t"\ng="pt"\nequals=1'))
    assert two.subject.space.t.name != "t"
    assert two.subject.space.t.name not in {"x", "t", "p", "pt"}
    assert "unknown name 't'" in fault_of(
        PLANE.replace('"py"]', '"py"]\ntime = "s"') + claim("identity", 'lhs="t"\nrhs=1')
    )


def test_arbitrary_functions_keep_their_number_of_arguments():
    text = PLANE + '[symbols]\nV = "function"\n[hamiltonian]\nH = "V(x)"\n'
    assert claims_of(text + claim("conserved", 'f="V(y)"'))
    assert "'V' is called with 2 arguments here and with 1 elsewhere" in fault_of(
        text + claim("conserved", 'f="V(x, y)"')
    )


def test_a_tensor_in_place_of_the_canonical_bracket():
    (one,) = claims_of(PLANE + claim("bracket", EULER + 'f="L1"\ng="L2"\nequals="L3"'))
    L1, L2, L3 = one.keys["coordinates"]
    assert [[entry.expr for entry in row] for row in one.keys["tensor"]] == [[0, L3, -L2], [-L3, 0, L1], [L2, -L1, 0]]
    structure = 'structure = {"L1,L2" = "L3", "L2,L3" = "L1", "L3,L1" = "L2"}\n'
    (two,) = claims_of(PLANE + claim("bracket", structure + 'f="L1"\ng="L2"\nequals="L3"'))
    assert [[e.expr for e in row] for row in two.keys["tensor"]] == [
        [e.expr for e in row] for row in one.keys["tensor"]
    ]


def test_every_kind_has_its_keys():
    assert set(KEYS) == set(KINDS)
