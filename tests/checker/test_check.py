"""The checker: it confirms what the deciders prove, says what it takes on trust, and rejects whatever was changed."""

import copy
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest

import canon
from canon.checker.check import check
from canon.checker.functions import Unreadable
from canon.claims.certificate_data import certificate
from canon.claims.reader import read_text
from canon.errors import InputError
from tests.checker.certified import certified, places, resealed

POLAR = """
[phase_space]
q = ["x", "y"]
p = ["px", "py"]
Q = ["r", "phi"]
P = ["pr", "L"]
[symbols]
m = "positive"
V = "function"
[hamiltonian]
H = "(px**2 + py**2)/(2*m) + V(sqrt(x**2 + y**2))"
[transformation]
Q = ["sqrt(x**2 + y**2)", "atan2(y, x)"]
P = ["(x*px + y*py)/sqrt(x**2 + y**2)", "x*py - y*px"]
"""
TYPE_2 = """
[phase_space]
q = ["q"]
p = ["p"]
Q = ["Q"]
P = ["P"]
[symbols]
a = "real"
[generating_function]
type = 2
F = "q*P + a*sin(q)*P**2"
"""
CLAIMS = {
    "polar": (POLAR, 'kind = "canonical"'),
    "scale": (POLAR, 'kind = "canonical"\nscale = "2"'),
    "new H": (POLAR, 'kind = "new_hamiltonian"\nK = "(pr**2 + L**2/r**2)/(2*m) + V(r)"'),
    "wrong H": (POLAR, 'kind = "new_hamiltonian"\nK = "(pr**2 + L**2)/(2*m) + V(r)"'),
    "conserved": (POLAR, 'kind = "conserved"\nf = "x*py - y*px"'),
    "not conserved": (POLAR, 'kind = "conserved"\nf = "px"'),
    "bracket": (POLAR, 'kind = "bracket"\nf = "sqrt(x**2 + y**2)"\ng = "px"\nequals = "cos(atan2(y, x))"'),
    "identity": (POLAR, 'kind = "identity"\nlhs = "exp(2*x)*sin(2*y)"\nrhs = "2*exp(x)**2*sin(y)*cos(y)"'),
    "volume": (POLAR, 'kind = "volume"'),
    "implicit": (TYPE_2, 'kind = "canonical"'),
    "independent": (POLAR, 'kind = "independent"\nfunctions = ["x*py - y*px", "px"]'),
    "dependent": (
        f'{POLAR}[domain]\nwhere = ["px > 0"]',
        'kind = "independent"\nfunctions = ["x**2*px", "x*px**(1/2)*2"]',
    ),
}


def made(name: str) -> Any:
    return certified(*CLAIMS[name])


@pytest.mark.parametrize("name", sorted(CLAIMS))
def test_what_is_proved_or_refuted_is_confirmed(name: str) -> None:
    data = made(name)
    assert str(check(data)) == "confirmed"
    assert data["verdict"] == ("refuted" if name in ("scale", "wrong H", "not conserved", "dependent") else "proved")


def changed(data: Any, path: tuple[Any, ...]) -> Any:
    """The certificate with one thing in it changed: a number by 1, a text's last letter; a table or list loses one."""
    data = copy.deepcopy(data)
    *above, last = path
    holder = data
    for key in above:
        holder = holder[key]
    item = holder[last]
    if isinstance(item, dict):
        holder[last] = {"x": "1"} if not item else dict(list(item.items())[1:])
    elif isinstance(item, list):
        holder[last] = ["1"] if not item else item[1:]
    elif isinstance(item, str) and item.lstrip("-").replace("/", "").isdigit():
        holder[last] = f"{item}1"
    else:
        holder[last] = f"{item}*2" if isinstance(item, str) else 2 if item is None else item + 1
    return data


@pytest.mark.parametrize("name", ["polar", "new H", "not conserved", "implicit"])
def test_every_change_breaks_the_checksum(name: str) -> None:
    """Each field in turn, descriptive ones too; one of another version is not read at all."""
    data = made(name)
    count = 0
    for path in places(data):
        if path == ("certificate",):
            continue
        answer = check(changed(data, path))
        assert answer.status == "rejected", path
        count += 1
    assert count > 20


def _formulas(data: Any) -> Iterator[tuple[Any, ...]]:
    """The leaves on which the argument rests: the formulas that the claim is about, and all that is shown of them."""
    used = {"canonical": "transformation", "volume": "transformation", "new_hamiltonian": "transformation hamiltonian"}
    sections = ("claim", *used.get(data["tables"]["claim"]["kind"], "").split())
    if "generating_function" in data["tables"]:
        sections = ("generating_function",)
    for path in places(data):
        leaf = data
        for key in path:
            leaf = leaf[key]
        if isinstance(leaf, dict | list) or path[-1] in ("sign", "name", "kind", "type"):
            continue
        if path[0] in ("cases", "known", "verdict") or (path[0] == "tables" and path[1] in sections):
            yield path


@pytest.mark.parametrize("name", ["polar", "new H", "bracket", "identity", "volume", "implicit"])
def test_a_changed_proof_is_rejected_with_the_right_checksum_too(name: str) -> None:
    """Every kernel, relation, value, numerator, denominator, cofactor and expression; every formula of the claim."""
    data = made(name)
    assert sum(path[0] == "cases" for path in _formulas(data)) > 2
    for path in _formulas(data):
        new = resealed(changed(data, path))
        try:
            status = check(new).status
        except Unreadable:
            status = "unreadable"
        assert status in ("rejected", "unreadable", "not confirmed"), (path, status)


@pytest.mark.parametrize("coordinate", ["px", "x"])
def test_a_witness_that_is_none_is_rejected(coordinate: str) -> None:
    """L is conserved at every point: no witness against it is one."""
    data, other = made("not conserved"), made("conserved")
    assert check(resealed({**data, "tables": other["tables"]})).status == "rejected"
    outside = {**made("dependent"), "witness": {coordinate: "-1", "y": "1", "py": "1"}}
    assert check(resealed(outside)).status == "rejected"


def test_a_proof_of_something_false_is_rejected() -> None:
    """The proof of one claim beside the text of another; a numerator that only happens to vanish at no point."""
    false = made("wrong H")["tables"]
    assert check(resealed({**made("new H"), "tables": false})).status == "rejected"
    data = made("bracket")
    data["tables"]["claim"]["equals"] = "1001/1000*cos(atan2(y, x))"
    assert check(resealed(data)).status == "rejected"


def test_a_proof_is_no_refutation() -> None:
    """Without a witness there is nothing to be said against a claim, unless what must not vanish is shown to."""
    answer = check(resealed({**made("conserved"), "verdict": "refuted", "known": {}}))
    assert str(answer) == "not confirmed: a refutation without a point, by an argument that there is no rule for"
    assert check(resealed({**made("implicit"), "verdict": "refuted"})).status == "rejected"
    assert check(resealed({**made("not conserved"), "verdict": "proved", "witness": None})).status != "confirmed"


def test_a_name_that_nothing_declares_is_unreadable() -> None:
    data = made("polar")
    data["tables"]["transformation"]["P"][1] += " + z - z"
    with pytest.raises(Unreadable, match="'z' is not declared"):
        check(resealed(data))


def test_a_domain_without_points_confirms_nothing() -> None:
    data = made("identity")
    data["tables"]["domain"] = {"where": ["x > 1", "x < 1"]}
    assert str(check(resealed(data))) == "not confirmed: the checker found no point of the domain"


def test_a_relation_defines_its_own_kernel_and_nothing_else() -> None:
    """A residual that vanishes is no relation, though it holds at every point of the domain."""
    data = made("identity")
    (case,) = data["cases"]
    numerator = case["residuals"][0]["numerator"]
    case["kernels"][-1]["relation"] = numerator
    case["residuals"][0]["cofactors"] = {case["kernels"][-1]["name"]: {"": "1"}}
    answer = check(resealed(data))
    assert answer.status == "rejected"
    assert "in terms of those before" in str(answer)


def test_what_is_known_of_a_proof_says_nothing_of_a_refutation() -> None:
    """The order at which a series fails would leave a proof of a closed form little to show."""
    text = '[phase_space]\nq = ["q"]\np = ["p"]\n[symbols]\ns = "real"\n'
    keys = 'kind = "lie_series"\ngenerator = "p"\nparameter = "s"\nf = "q**2"\nequals = "(q + s)**2"'
    data = certified(text, keys)
    assert check(data).status == "confirmed"
    data["tables"]["claim"]["equals"] = "q**2"
    data["known"] = {"fails_at_order": 0}
    data["cases"][0]["residuals"] = data["cases"][0]["residuals"][:1]
    assert check(resealed(data)).status == "rejected"


@pytest.mark.parametrize("data", [None, [], "certificate", {}, {"certificate": 2}, {"certificate": 1, "verdict": []}])
def test_what_is_no_certificate_is_unreadable_or_rejected(data: Any) -> None:
    if isinstance(data, dict) and data.get("certificate") == 1:
        assert check(data).status == "rejected"
        return
    with pytest.raises(Unreadable, match="version 1"):
        check(data)


def test_kinds_without_a_rule_are_not_confirmed() -> None:
    data = made("polar")
    data["tables"]["claim"] = {"kind": "marvellous"}
    assert str(check(resealed(data))) == "not confirmed: claims of kind 'marvellous' are not known to the checker"


def test_what_is_open_has_no_certificate() -> None:
    (claim,) = read_text(f'{POLAR}[[claim]]\nkind = "canonical"\n').claims
    with pytest.raises(InputError, match="proved or refuted; this one is undecided"):
        certificate(claim, replace(canon.verify(claim), status="undecided", witness=None), {"claim": {}})


@pytest.mark.parametrize("factor", ["(a - 1)", "(a + abs(a))", "cos(pi*n/2)"])
def test_what_fails_at_a_value_of_a_parameter_is_no_forgery(factor: str) -> None:
    text = '[phase_space]\nq = ["q"]\np = ["p"]\n[symbols]\na = "real"\nn = "integer"\n'
    data = certified(text, f'kind = "independent"\nfunctions = ["q", "{factor}*p"]')
    assert data["verdict"] == "refuted"
    assert check(data).status == "not confirmed"
