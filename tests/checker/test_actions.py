"""What the checker measures: actions and frequencies of orbits, periods of angles. Evidence, and refutations."""

import copy
from typing import Any

import pytest

from canon.checker.actions import action
from canon.checker.check import check
from canon.checker.points import Numbers, Outside
from canon.checker.statement import Statement
from tests.checker.certified import certified, resealed

OSCILLATOR = """
[phase_space]
q = ["q"]
p = ["p"]
Q = ["w"]
P = ["J"]
[symbols]
m = "positive"
k = "positive"
E = "positive"
J = "positive"
[hamiltonian]
H = "p**2/(2*m) + k**2*q**2/2"
[transformation]
q = ["sqrt(J/(pi*k*sqrt(m)))*sin(2*pi*w)"]
p = ["sqrt(J*k*sqrt(m)/pi)*cos(2*pi*w)"]
"""
ROTOR = """
[phase_space]
q = ["a"]
p = ["L"]
[symbols]
E = "positive"
[domain]
where = ["E > 1"]
[hamiltonian]
H = "L**2/2 - cos(a)"
"""
KEYS = 'coordinate = "q"\nenergy = "E"\n'
CLAIMS = {
    "action": (OSCILLATOR, f'kind = "action"\n{KEYS}equals = "2*pi*E*sqrt(m)/k"'),
    "wrong action": (OSCILLATOR, f'kind = "action"\n{KEYS}equals = "2001*pi*E*sqrt(m)/(1000*k)"'),
    "frequency": (OSCILLATOR, f'kind = "frequency"\n{KEYS}equals = "k/(2*pi*sqrt(m))"'),
    "rotation": (
        ROTOR,
        'kind = "action"\ncoordinate = "a"\nenergy = "E"\nbranch = "rotation"\n'
        'equals = "4*sqrt(2*(E + 1))*elliptic_e(2/(E + 1))"',
    ),
    "separatrix": (
        OSCILLATOR.replace("k**2*q**2/2", "m*k**2*q**2/2 - m*q**3/3").replace('E = "positive"', ""),
        f'kind = "action"\n{KEYS}fixed = {{E = "m*k**6/6"}}\nequals = "6*m*k**5/5"',
    ),
    "angle": (OSCILLATOR, 'kind = "action_angle"'),
    "wrong angle": (OSCILLATOR, 'kind = "action_angle"\nangle_period = "1/3"'),
}


def made(name: str) -> Any:
    return certified(*CLAIMS[name])


@pytest.mark.parametrize("name", sorted(CLAIMS))
def test_what_is_measured_is_evidence(name: str) -> None:
    """Of a proof it agrees with what is derived; a refutation is seen in intervals."""
    data = made(name)
    answer = check(data)
    if name.startswith("wrong"):
        assert (data["verdict"], answer.status) == ("refuted", "confirmed")
        return
    # in closed form, or by elliptic integrals; an angle's period is an identity
    assert (data["verdict"], answer.status) == ("proved", "confirmed")


@pytest.mark.parametrize(
    ("name", "path", "text"),
    [
        ("action", ("claim", "equals"), "2000001*pi*E*sqrt(m)/(1000000*k)"),
        ("action", ("claim", "kind"), "frequency"),
        ("frequency", ("claim", "equals"), "k/(2*pi*m)"),
        ("frequency", ("hamiltonian", "H"), "p**2/(2*m) + k**2*q**2/2 + q**4/1000000"),
        ("rotation", ("claim", "equals"), "4*sqrt(2*(E + 1))*elliptic_k(2/(E + 1))"),
        ("angle", ("claim", "angle_period"), "1/2"),
        ("angle", ("hamiltonian", "H"), "p**2/(2*m) + k**2*q**2/2 + q"),
        ("angle", ("transformation", "p"), ["sqrt(J*k*sqrt(m)/pi)*cos(2*pi*w)*2"]),
    ],
)
def test_what_is_not_so_is_rejected(name: str, path: tuple[str, str], text: Any) -> None:
    data = copy.deepcopy(made(name))
    data["tables"][path[0]][path[1]] = text
    assert check(resealed(data)).status == "rejected"


def test_a_refutation_of_something_true_is_rejected() -> None:
    for wrong, right in (("wrong action", "action"), ("wrong angle", "angle")):
        answer = check(resealed({**made(wrong), "tables": made(right)["tables"]}))
        assert answer.status in ("rejected", "not confirmed")


LINE = '[phase_space]\nq = ["q"]\np = ["p"]\n'
CUBIC = LINE + '[hamiltonian]\nH = "p**2/2 + q**2/2 - q**3/3"\n'
ORBITS = {
    "a negative mass": (LINE + '[hamiltonian]\nH = "-(p**2 + q**2)/2"\n', f'kind = "action"\n{KEYS}equals = "2*pi*E"'),
    "a separatrix": (CUBIC, f'kind = "action"\n{KEYS}fixed = {{E = "1/6"}}\nequals = "6/5"'),
    "another loop of it": (
        LINE + '[hamiltonian]\nH = "p**2/2 - q**2*(q + 1)*(2 - q)/2"\n',
        f'kind = "action"\n{KEYS}fixed = {{E = "0"}}\nwell = "1"\nequals = "(76*sqrt(2) + 54*asin(1/3) + 27*pi)/48"',
    ),
    "a quartic kinetic energy": (
        LINE + '[hamiltonian]\nH = "p**4/4 + q**2/2"\n',
        f'kind = "action"\n{KEYS}equals = "4*(4*E)**(1/4)*sqrt(2*E)*gamma(3/2)*gamma(5/4)/gamma(7/4)"',
    ),
}


LONG = "a quartic kinetic energy"
"""It is measured in 32 digits and more."""


@pytest.mark.parametrize(
    "name", [*(name for name in ORBITS if name != LONG), pytest.param(LONG, marks=pytest.mark.slow)]
)
def test_orbits_that_are_measured(name: str) -> None:
    data = certified(*ORBITS[name])
    status = "confirmed in part" if name == LONG else "confirmed"
    answer = check(data)
    assert (data["verdict"], answer.status) == ("proved", status)
    assert any("points where it was measured" in reason for reason in answer.reasons) == (status != "confirmed")
    wrong = copy.deepcopy(data)
    wrong["tables"]["claim"]["equals"] = f"1000001/1000000*({wrong['tables']['claim']['equals']})"
    assert check(resealed(wrong)).status == "rejected"


def _measured(H: str, domain: dict[str, Any], equals: str, **keys: str) -> Any:
    """What is measured of an action claimed at E = 5."""
    tables = {
        "phase_space": {"q": ["q"], "p": ["p"]},
        "hamiltonian": {"H": H},
        **domain,
        "claim": {
            "kind": "action", "coordinate": "q", "energy": "E", "fixed": {"E": "5"}, "equals": equals, **keys
        },
    }  # fmt: skip
    case = action(Statement(tables, {}, "proved"))
    assert case.measured is not None
    return float(abs(case.measured(Numbers(), {})[0]))


def test_of_two_wells_the_one_in_the_domain_is_measured() -> None:
    """Of q²/2 + 1/q² + q at E = 5, by mpmath's quadrature between the roots in 20 digits."""
    H, right, left = "p**2/2 + q**2/2 + 1/q**2 + q", "6.1867378690937350", "19.485015444077258"
    assert _measured(H, {"symbols": {"q": "positive"}}, right) < 1e-12
    assert _measured(H, {"domain": {"where": ["q < 0"]}}, left) < 1e-12
    assert _measured(H, {"symbols": {"q": "positive"}}, left) > 1
    assert _measured(H, {}, left, well="-2") < 1e-12
    with pytest.raises(Outside):  # which one isn't said
        _measured(H, {}, right)


PLAIN = '[phase_space]\nq = ["q"]\np = ["p"]\n[symbols]\na = "positive"\nx = "real"\n'
MORE = {
    "integral": 'kind = "integral"\nf = "exp(-a*x)"\nvariable = "x"\nfrom = "0"\nto = "infinity"\nequals = "1/a"',
    "wrong integral": 'kind = "integral"\nf = "x**2"\nvariable = "x"\nfrom = "0"\nto = "a"\nequals = "a**3/2"',
    "limit": 'kind = "limit"\nf = "sin(a*x)/x"\nvariable = "x"\nto = "0"\nequals = "a"',
    "path": 'kind = "stationary"\nL = "v**2/2 - a*q"\nvelocities = ["v"]\npath = ["-a*t**2/2 + t"]\nfrom = "0"\n'
    'to = "1"',
    "energy": 'kind = "dimension"\nfunctions = ["a*p**2", "p*q"]\ndimensions = { a = "L/M", p = "M", q = "L" }\n'
    'equals = "M*L"',
    "no energy": 'kind = "dimension"\nfunctions = ["a*p + p*q"]\ndimensions = { a = "L/M", p = "M", q = "L" }\n'
    'equals = "M*L"',
}


@pytest.mark.parametrize(
    ("name", "status", "other"),
    [
        ("integral", "confirmed", {"equals": "1001/(1000*a)"}),
        ("wrong integral", "confirmed", {"equals": "a**3/3"}),
        ("limit", "confirmed", {"equals": "2*a"}),
        ("path", "confirmed", {"path": ["-a*t**2 + t"]}),
        ("energy", "confirmed", {"functions": ["a*p**2", "p"]}),
        ("no energy", "confirmed", {"functions": ["a*p**2"]}),
    ],
)
def test_integrals_limits_and_paths(name: str, status: str, other: dict[str, Any]) -> None:
    data = certified(PLAIN, MORE[name])
    assert check(data).status == status
    data["tables"]["claim"] |= other
    sure = name in ("integral", "limit", "path")
    assert check(resealed(data)).status in (("rejected",) if sure else ("rejected", "not confirmed"))


@pytest.mark.parametrize("period", ["0", "-1", -(10**9)])
def test_a_rotation_takes_some_of_its_coordinate(period: Any) -> None:
    """Refuted in intervals it can't be, whose ends would be in the wrong order."""
    free = ROTOR.replace("- cos(a)", "")
    keys = 'kind = "action"\ncoordinate = "a"\nenergy = "E"\nbranch = "rotation"\nperiod = "2*pi"\n'
    certificate = certified(free, f'{keys}equals = "2002*pi*sqrt(2*E)/1000"')
    assert check(certificate).status == "confirmed"
    certificate["tables"]["claim"]["period"] = period
    assert check(resealed(certificate)).status in ("not confirmed", "confirmed in part")
