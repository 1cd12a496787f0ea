"""Claims in old variables beside a map whose image is the whole domain, but for what they don't come to."""

import tomllib
from typing import Any

import pytest

from canon.checker.check import check
from canon.checker.statement import Statement
from canon.checker.whole_image import is_whole
from canon.claims.certificate_data import certificate, statement_tables
from canon.claims.reader import read_text
from canon.claims.verify import verify
from tests.checker.certified import resealed

WELL = "p**2/2 + q**2/2"
POLAR = ('q = ["sqrt(2*P)*sin(Q)"]\np = ["sqrt(2*P)*cos(Q)"]', "")
IDENTITY = ('q = ["Q"]\np = ["P"]', "")
TRUE, WRONG = 'equals = "2*pi*E"', 'equals = "2*pi*E + E**2/1000"'
ORBIT = 'kind = "action"\ncoordinate = "q"\nenergy = "E"\n'
LINE = 'q = ["q"]\np = ["p"]\nQ = ["Q"]\nP = ["P"]\n'
PLANE = 'q = ["q", "y"]\np = ["p", "z"]\nQ = ["Q", "Y"]\nP = ["P", "Z"]\n'
POLAR_TWICE = (
    'q = ["sqrt(2*P)*sin(Q)", "sqrt(2*Z)*sin(Y)"]\np = ["sqrt(2*P)*cos(Q)", "sqrt(2*Z)*cos(Y)"]',
    "",
)


def _file(given: tuple[str, str], H: str = WELL, where: str = "", space: str = LINE, E: str = "positive") -> str:
    text, symbols = given
    section = "[generating_function]" if text.startswith("type") else "[transformation]"
    domain = f"[domain]\nwhere = [{where}]\n" if where else ""
    return (
        f'[phase_space]\n{space}[symbols]\nE = "{E}"\nA = "positive"\n{symbols}\n[hamiltonian]\nH = "{H}"\n'
        f"{section}\n{text}\n{domain}[[claim]]\n"
    )


def _status(text: str) -> str:
    (claim,) = read_text(text).claims
    return verify(claim, budget=60).status


WHOLE = {
    "polar": POLAR,
    "polar, with scales": (
        'q = ["sqrt(P/(pi*m))*cos(2*pi*Q)"]\np = ["-sqrt(m*P/pi)*sin(2*pi*Q)"]',
        'm = "positive"\nP = "positive"',
    ),
    "an angle that is positive": (POLAR[0], 'Q = "positive"\nP = "positive"'),
    "polar, in time": ('q = ["sqrt(2*P)*sin(Q + t)"]\np = ["sqrt(2*P)*cos(Q + t)"]', ""),
    "affine": ('q = ["Q/2 + P"]\np = ["2*P + b"]', 'b = "real"'),
    "a moving frame": ('q = ["Q + a(t)"]\np = ["P + b(t)"]', 'a = "function"\nb = "function"'),
    "a point transformation": ('q = ["sinh(Q)"]\np = ["P/cosh(Q)"]', ""),
    "type 1": ('type = 1\nF = "q*Q"', ""),
    "type 2": ('type = 2\nF = "q*P + q**3"', ""),
    "type 3": ('type = 3\nF = "-p*Q + Q**2"', ""),
    "type 4": ('type = 4\nF = "p*log(P)"', ""),
}


@pytest.mark.parametrize("name", WHOLE)
def test_beside_a_map_onto_the_whole_domain_an_orbit_is_one_without_it(name: str):
    text = _file(WHOLE[name])
    assert _status(text + ORBIT + TRUE) == "proved"
    assert _status(text + ORBIT + WRONG) == "refuted"


PARTS = {
    "half of the circle": (POLAR, '"0 < Q < pi"'),
    "a circle with a cut": (POLAR, '"-pi < Q < pi"'),
    "a disc": (POLAR, '"P < 3"'),
    "beyond an energy": (POLAR, '"E > P"'),
    "a new variable beside an old one": (IDENTITY, '"q + P > 0"'),
    "a ring": (('q = ["(1 + exp(P))*sin(Q)"]\np = ["(1 + exp(P))*cos(Q)"]', ""), ""),
    "a half line": (('q = ["exp(Q)"]\np = ["P*exp(-Q)"]', ""), ""),
    "not one to one": (('q = ["Q**2"]\np = ["P/(2*Q)"]', ""), ""),
    "a puncture": (('q = ["-1/Q"]\np = ["Q**2*P"]', ""), ""),
    "a critical point": (('q = ["Q**3"]\np = ["P/(3*Q**2)"]', ""), ""),
    "one sheet": (('q = ["Q"]\np = ["sqrt(P)"]', ""), ""),
    "what is assumed of P": ((IDENTITY[0], 'P = "positive"'), ""),
    "what is assumed of Q": ((IDENTITY[0], 'Q = "nonzero"'), ""),
    "what is written and doesn't count": (('q = ["Q + 0*sqrt(P - 7)"]\np = ["P"]', ""), ""),
    "a pole of the angle's": (('q = ["sqrt(2*P)*(sin(Q) + 0*tan(Q))"]\np = ["sqrt(2*P)*cos(Q)"]', ""), ""),
    "a branch of the angle's": (('q = ["sqrt(2*P)*(sin(Q) + 0*log(Q))"]\np = ["sqrt(2*P)*cos(Q)"]', ""), ""),
    "two phases": (('q = ["sqrt(2*P)*sin(Q)"]\np = ["sqrt(2*P)*cos(Q + 1/10)"]', ""), ""),
    "a rate that may be 0": (('q = ["sqrt(2*P)*sin(n*Q)"]\np = ["sqrt(2*P)*cos(n*Q)"]', 'n = "integer"'), ""),
    "an angle that is no angle": (('q = ["sqrt(2*P)*sin(atan(Q))"]\np = ["sqrt(2*P)*cos(atan(Q))"]', ""), ""),
    "an arbitrary function": (('q = ["g(Q)"]\np = ["P"]', 'g = "function"'), ""),
    "singular": (('q = ["Q"]\np = ["Q"]', ""), ""),
    "another place left out": (('q = ["1 + sqrt(2*P)*sin(Q)"]\np = ["sqrt(2*P)*cos(Q)"]', ""), ""),
    "a place that moves": (('q = ["t + sqrt(2*P)*sin(Q)"]\np = ["sqrt(2*P)*cos(Q)"]', ""), ""),
    "type 1": (('type = 1\nF = "q**2*cot(Q)/2"', ""), ""),
    "type 2": (('type = 2\nF = "P**2*q + q**3"', ""), ""),
    "type 3": (('type = 3\nF = "-p*exp(Q)"', ""), ""),
    "type 4": (('type = 4\nF = "p*tanh(P)"', ""), ""),
}


@pytest.mark.parametrize("name", PARTS)
@pytest.mark.parametrize("equals", [TRUE, WRONG])
def test_an_orbit_may_leave_what_is_not_seen_to_be_the_whole_domain(name: str, equals: str):
    given, where = PARTS[name]
    assert _status(_file(given, where=where) + ORBIT + equals) == "undecided"


KEPLER = "p**2/2 + 1/(2*q**2) - 1/q"
ON_A_HALF = {
    "log": (('q = ["exp(Q)"]\np = ["P*exp(-Q)"]', 'q = "positive"'), True),
    "square": (('q = ["Q**2"]\np = ["P/(2*Q)"]', 'q = "positive"'), True),
    "polar": ((POLAR[0], 'q = "positive"'), True),
    "generated": (('type = 2\nF = "P*log(q)"', ""), True),
    "less than it": (('q = ["2 + exp(Q)"]\np = ["P*exp(-Q)"]', 'q = "positive"'), False),
}


@pytest.mark.parametrize("name", ON_A_HALF)
def test_an_image_is_the_whole_domain_where_the_file_asks_for_no_more(name: str):
    given, whole = ON_A_HALF[name]
    text = _file(given, KEPLER, '"E < 0"', E="real") + ORBIT
    assert _status(text + 'equals = "2*pi*(1/sqrt(-2*E) - 1)"') == ("proved" if whole else "undecided")
    assert _status(text + 'equals = "2*pi*(1/sqrt(-2*E) + 1)"') == ("refuted" if whole else "undecided")


SADDLE = "p**2/2 - q**2/2 + q**4/4"


@pytest.mark.parametrize(
    ("H", "keys", "expected"),
    [
        ("p**2/2 + q**2/2 - q", 'equals = "2*pi*(E + 1/2)"', "undecided"),  # that with E = 0 comes to the origin
        ("p**2/2 + q**2/2 - q", 'fixed = {E = "0"}\nequals = "2"', "undecided"),
        (SADDLE, 'fixed = {E = "0"}\nwell = "1"\nequals = "7/3"', "undecided"),
        (SADDLE, 'fixed = {E = "c"}\nwell = "1"\nequals = "7/3"', "undecided"),
        (SADDLE, 'fixed = {E = "-1/8"}\nwell = "1"\nequals = "7/3"', "refuted"),
        ("p**2/2 + (1 - exp(-q))**2", 'equals = "pi*sqrt(2)*(1 - sqrt(1 - E))"', "refuted"),
    ],
)
def test_the_place_left_out_must_be_an_equilibrium_at_another_energy(H: str, keys: str, expected: str):
    where = '"E < 1"' if "exp" in H else ""
    text = _file((POLAR[0], 'c = "real"'), H, where, E="positive" if where else "real")
    assert _status(text + ORBIT + keys) == expected


MOTION = 'kind = "average"\nf = "q**2"\nequals = "{}"\nparameter = "t"\nfrom = "0"\nto = "2*pi"\n[claim.motion]\n'
TURNING, RESTING = 'q = "A*sin(t)"\np = "A*cos(t)"\n', 'q = "0"\np = "0"\n'


@pytest.mark.parametrize(
    ("given", "motion", "equals", "expected"),
    [
        (POLAR, TURNING, "A**2/2", "proved"),
        (POLAR, TURNING, "A**2", "refuted"),
        (POLAR, RESTING, "0", "undecided"),
        (POLAR, RESTING, "1", "undecided"),
        (IDENTITY, RESTING, "0", "proved"),
    ],
)
def test_motions_stay_off_the_place_left_out_if_they_are_elsewhere_once(
    given: tuple[str, str], motion: str, equals: str, expected: str
):
    assert _status(_file(given) + MOTION.format(equals) + motion) == expected


@pytest.mark.parametrize(
    ("claim", "expected"),
    [
        (ORBIT + 'fixed = {y = "0", z = "0"}\n' + TRUE, "undecided"),
        (ORBIT + 'fixed = {y = "0", z = "0"}\n' + WRONG, "undecided"),
        (MOTION.format("A**2/2") + TURNING + 'y = "A*cos(t)"\nz = "-A*sin(t)"', "proved"),
        (MOTION.format("A**2/2") + TURNING + 'y = "0"\nz = "0"', "undecided"),
    ],
)
def test_no_pair_may_be_at_its_place(claim: str, expected: str):
    assert _status(_file(POLAR_TWICE, f"{WELL} + z**2/2 + y**2/2", space=PLANE) + claim) == expected


SPAN = '\nfrom = "{}"\nto = "{}"\n'


@pytest.mark.parametrize(
    ("given", "claim", "expected"),
    [
        (POLAR, 'kind = "integral"\nvariable = "q"\nf = "q"\nequals = "0"' + SPAN.format(-1, 1), "proved"),
        (POLAR, 'kind = "integral"\nvariable = "q"\nf = "p*q"\nequals = "0"' + SPAN.format(-1, 1), "undecided"),
        (IDENTITY, 'kind = "integral"\nvariable = "q"\nf = "p*q"\nequals = "0"' + SPAN.format(-1, 1), "proved"),
        (POLAR, 'kind = "limit"\nvariable = "q"\nf = "q"\nto = "-1"\nequals = "1"', "refuted"),
        (
            POLAR,
            'kind = "stationary"\nL = "v**2/2 - q**2/2"\nvelocities = ["v"]\npath = ["sin(2*t)"]' + SPAN.format(0, 1),
            "refuted",
        ),
    ],
)
def test_ranges_and_paths_in_the_whole_domain(given: tuple[str, str], claim: str, expected: str):
    assert _status(_file(given) + claim) == expected


HALF = PARTS["a half line"][0]


@pytest.mark.parametrize(
    ("given", "order", "expected"),
    [(POLAR, 3, "proved"), (POLAR, 4, "refuted"), (HALF, 3, "undecided"), (HALF, 4, "undecided")],
)
def test_a_normal_form_is_about_an_origin_that_has_the_image_around_it(
    given: tuple[str, str], order: int, expected: str
):
    claim = f'kind = "normal_form"\norder = {order}\nN = {{ "2" = "{WELL}" }}'
    assert _status(_file(given, f"{WELL} + q**3") + claim) == expected


SCALED = ('q = ["k*Q"]\np = ["P/k"]', 'k = "real"')
ROOT = ('q = ["sqrt(t)*Q"]\np = ["P/sqrt(t)"]', "")


@pytest.mark.parametrize(
    ("given", "claim", "expected"),
    [
        (SCALED, ORBIT + TRUE, "proved"),
        (SCALED, 'kind = "integral"\nvariable = "k"\nf = "k"\nequals = "0"' + SPAN.format(-1, 1), "undecided"),
        (SCALED, 'kind = "integral"\nvariable = "k"\nf = "k"\nequals = "1/2"' + SPAN.format(1, 2), "refuted"),
        (ROOT, MOTION.format("A**2/2").replace('"0"', '"-2*pi"', 1) + TURNING, "undecided"),
        (ROOT, MOTION.format("A**2/2") + TURNING, "proved"),
    ],
)
def test_what_the_map_demands_of_parameters_and_time_stays(given: tuple[str, str], claim: str, expected: str):
    assert _status(_file(given) + claim) == expected


def _certified(text: str) -> Any:
    (claim,) = read_text(text).claims
    verdict = verify(claim, budget=60)
    assert any("image" in str(step.get("theorem")) for step in verdict.certificate["arguments"])  # pyright: ignore[reportOptionalSubscript]
    return certificate(claim, verdict, statement_tables(tomllib.loads(text), 0))


@pytest.mark.parametrize("name", WHOLE)
@pytest.mark.parametrize("equals", [TRUE, WRONG])
def test_the_checker_sees_images_of_affine_and_of_polar_maps(name: str, equals: str):
    answer = check(_certified(_file(WHOLE[name]) + ORBIT + equals))
    if name in ("polar", "polar, with scales", "affine"):
        assert (answer.status, answer.reasons) == ("confirmed", ())
    else:
        assert answer.status == "confirmed in part"
        assert any("image" in reason for reason in answer.reasons)


@pytest.mark.parametrize("equals", [TRUE, WRONG])
def test_beside_an_image_that_is_less_a_forgery_is_not_confirmed(equals: str):
    """Proofs and refutations of files with maps onto the plane, beside maps that aren't."""
    data = _certified(_file(POLAR) + ORBIT + equals)
    for given, where in PARTS.values():
        text = _file(given, where=where) + ORBIT + equals
        forged = resealed({**data, "tables": statement_tables(tomllib.loads(text), 0)})
        assert check(forged).status != "confirmed", (given, where)


@pytest.mark.parametrize(
    ("H", "keys", "whole"),
    [
        (WELL, "", True),
        (WELL, 'fixed = {E = "1"}', True),
        (WELL, 'fixed = {E = "c**2"}', False),
        (WELL + " + q", "", False),
        (WELL + " + 0*log(q + 3)", "", False),
        (WELL + " + 1/(5 + q**2)", "", False),
    ],
)
def test_the_checker_asks_that_the_origin_is_an_equilibrium(H: str, keys: str, whole: bool):
    tables = tomllib.loads(_file((POLAR[0], 'c = "real"'), H) + ORBIT + TRUE + "\n" + keys)
    (claim,) = tables.pop("claim")
    assert is_whole(Statement({**tables, "claim": claim}, {}, "proved")) == whole
