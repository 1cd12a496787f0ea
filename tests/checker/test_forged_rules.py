"""Certificates that a rule of the checker's own once confirmed, each beside one that it has to confirm.

Series where a function has a branch point, scales that vanish, maps that are none, points that aren't of the domain,
names of numbers; and what would take for ever.
"""

from typing import Any

import pytest

from canon.checker.check import Answer, check
from canon.checker.limits import checked
from tests.checker.test_forged_calculus import of, status
from tests.checker.test_forgeries import sealed

MAP = {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]}}
FREE = {"H": "p**2/2"}


def near(factor: str, order: int = 1) -> dict[str, Any]:
    """A map that is to be canonical up to an order of eps."""
    claim = {"kind": "canonical", "order": ["eps", order]}
    images = {"Q": [f"q*({factor})"], "P": ["p"]}
    return of(claim, order + 1, transformation=images, symbols={"eps": "real"}, **MAP)


def series(equals: str, where: list[str] | None = None, **keys: Any) -> dict[str, Any]:
    claim = {"kind": "lie_series", "generator": "p", "parameter": "s", "f": "q", "equals": equals, **keys}
    zeros = 3 if "order" in keys else 2
    return of(claim, zeros, symbols={"s": "real"}, domain={"where": where or []})


def scaled(P: str, K: str, H: str = "p**2/2", **symbols: str) -> dict[str, Any]:
    tables = {"transformation": {"Q": ["q"], "P": [P]}, "hamiltonian": {"H": H}, "symbols": symbols}
    return of({"kind": "new_hamiltonian", "K": K}, 6, **tables, **MAP)


def generated(F: str, **claim: Any) -> dict[str, Any]:
    data = of(claim, 1 if claim["kind"] != "cartan_invariant" else 3, generating_function={"type": 2, "F": F}, **MAP)
    tables = {**data["tables"], "hamiltonian": {"H": "0"}}
    known = {"determinant": "1"} if claim["kind"] == "volume" else {}
    return sealed({**data, "tables": tables, "known": known})


def normal(H: str, order: int = 3, **tables: Any) -> dict[str, Any]:
    return of({"kind": "normal_form", "order": order, "N": {"3": "0"}}, 0, hamiltonian={"H": H}, **tables)


def bracket(tensor: list[list[str]], kind: str = "bracket") -> dict[str, Any]:
    keys = {"f": "x", "g": "y", "equals": "1"} if kind == "bracket" else {"f": "a"}
    return of({"kind": kind, **keys, "tensor": tensor, "coordinates": ["x", "y"]}, 1 if kind == "bracket" else 2)


def equal(lhs: str, rhs: str, **tables: Any) -> dict[str, Any]:
    return of({"kind": "identity", "lhs": lhs, "rhs": rhs}, 1, **tables)


VOLUME, CARTAN = {"kind": "volume"}, {"kind": "cartan_invariant", "K": "0"}
FALSE = {
    "a kink of first order in a parameter": near("1 + asin(1 - eps**2) - pi/2"),
    "the same by a cosine of 0": near("1 + asin(cos(eps**2) - eps**2) - pi/2"),
    "a series with a kink": series("q + s + asin(1 - s**2) - pi/2", order=1),
    "a series beyond a condition": series("q - 1/2 + sqrt((s - 1/2)**2)", ["s > 1/2"]),
    "a scale that is 0 on one side": scaled("p*(abs(q) + q)/(2*q)", "P**2/2"),
    "a scale that may be 0": scaled("a*p", "P**2/2", "a*p**2/2", a="real"),
    "a volume of no map": generated("q**2 + P**2", **VOLUME),
    "an invariant of no map": generated("q**2 + P**2", kind="integral_invariant"),
    "an exact form of no map": generated("q**2 + P**2", **CARTAN),
    "a normal form with a kink": normal("(p**2 + q**2)/2 + q**2*(asin(cos(q**2) - q**2) - pi/2)"),
    "the same by a root of 0": normal("(p**2 + q**2)/2 + q**2*(asin(1 - q**2) - pi/2)"),
    "a tensor that isn't antisymmetric": bracket([["0", "1"], ["5", "0"]]),
    "a tensor with a diagonal": bracket([["1", "1"], ["-1", "0"]]),
    "what commutes with no coordinates": of({"kind": "casimir", "f": "q"}, 0),
}


ROOTED = {"name": "g", "stands for": "sqrt(q)", "sign": "nonneg"}
"""A kernel that is real for q > 0 alone."""


def test_a_kernel_is_no_reason_for_itself() -> None:
    """With √q for a kernel |q| would be q, so that √(q (|q| + q)²), which is real everywhere, would be 2 (√q)³."""
    data = equal("sqrt(q**2) + sqrt(q*(abs(q) + q)**2)", "q + sqrt(q*(abs(q) + q)**2)")
    atoms = {"((q**2)**(1/2))": [{"g^2": "1"}, {"": "1"}],
             "((q*((abs(q)+q)**2))**(1/2))": [{"g^3": "2"}, {"": "1"}]}  # fmt: skip
    shown = {**data["cases"][0], "kernels": [ROOTED], "atoms": atoms}
    assert status(sealed({**data, "cases": [shown]})) != "confirmed"


def test_a_jump_between_the_points_that_are_looked_at() -> None:
    jump = {"kind": "inequality", "lhs": "0", "relation": "<", "rhs": "1/2 + sign(q - 1/100)*sign(q - 1/50)"}
    data = of(jump, 0, domain={"where": ["0 < q", "q < 1"]})
    assert status(data) != "confirmed"
    smooth = {**jump, "rhs": "3/2 - q - sin(q)/3"}
    assert status(of(smooth, 0, domain={"where": ["0 < q", "q < 1"]})) == "confirmed"


@pytest.mark.parametrize("name", sorted(FALSE))
def test_what_is_false_is_not_confirmed(name: str) -> None:
    assert status(FALSE[name]) != "confirmed", name


TRUE = {
    "a root of what isn't 0": near("1 + sqrt(1 + eps**2) - 1"),
    "a logarithm of a positive coordinate": near("1 + eps**2*log(1 + q**2 + eps)"),
    "a series": series("q + s"),
    "a series of an order": series("q + s", order=1),
    "a constant scale": scaled("a*p", "P**2/(2*a)", a="positive"),
    "a rational scale": scaled("2*p", "P**2/4"),
    "a volume": generated("q*P + q**2", **VOLUME),
    "a normal form": normal("(p**2 + q**2)/2 + q**3"),
    "a tensor": bracket([["0", "1"], ["-1", "0"]]),
    "a tensor's entries, written otherwise": bracket([["0", "sin(x)**2 + cos(x)**2"], ["-1", "0"]]),
}


@pytest.mark.parametrize("name", sorted(TRUE))
def test_what_is_true_is_confirmed(name: str) -> None:
    """The same rules, where they hold."""
    assert status(TRUE[name]) == "confirmed", name


def test_a_minimum_up_to_a_name() -> None:
    claim = {"kind": "stationary", "L": "v**2/2 - w**2*q**2/2", "velocities": ["v"], "path": ["0"], "from": "0"}
    symbols = {"w": "positive"}
    data = of({**claim, "to": "pi/w", "extremum": "minimum", "field": "sin(w*t)"}, 2, symbols=symbols)
    assert status(data) == "confirmed"
    data = of({**claim, "to": "2*pi/w", "extremum": "minimum", "field": "sin(w*t)"}, 2, symbols=symbols)
    assert status(data) != "confirmed"


def against(data: dict[str, Any], **witness: Any) -> Answer:
    return check(sealed({**data, "verdict": "refuted", "witness": witness, "cases": []}))


def least(L: str, path: str, to: str, **keys: str) -> dict[str, Any]:
    claim = {"kind": "stationary", "L": L, "velocities": ["v"], "path": [path], "from": "0", "to": to, **keys}
    return of(claim, 1)


KINKED = "v**2/2 + sqrt((t - 2)**2)*q - (2 - t)*q"
POLE = {"on": ["(q - 2)/(q - 1)"]}
REFUTED = {
    "π is 3": (equal("sin(pi) + q", "q"), {"q": "1", "pi": "3"}),
    "i is 2": (equal("1j**2", "-1"), {"q": "1", "1j": "2"}),
    "a coordinate is i": (equal("sqrt(q**4) + 1j", "q**2 + 1j"), {"q": {"re": "0", "im": "1"}}),
    "a pole of a surface": (equal("q", "2", domain=POLE), {"q": f"{10**30 + 1}/{10**30}"}),
    "a germ, far from its place": (series("q + s + sqrt((s - 1)**2) + s - 1"), {"s": "3"}),
    "a time beyond the ends": (least(KINKED, "t", "1"), {"t": "3"}),
    "a time beyond the ends, of a minimum": (least(KINKED, "t", "1", extremum="minimum"), {"t": "3"}),
}


@pytest.mark.parametrize("name", sorted(REFUTED))
def test_no_refutation_of_what_is_true(name: str) -> None:
    data, witness = REFUTED[name]
    assert against(data, **witness).status != "confirmed", name


def test_no_refutation_of_a_second_variation_with_a_jump() -> None:
    """That it is positive off the jump of ∂²L/∂q∂v says nothing of what the jump adds."""
    data = least("v**2/2 + 5*q*v*abs(t - 1)/(t - 1)", "0", "2", extremum="neither")
    shown = sealed({**data, "verdict": "refuted", "cases": [{**data["cases"][0], "residuals": []}]})
    assert status(shown) != "confirmed"
    smooth = least("v**2/2 + 5*q*v", "0", "2", extremum="neither")
    shown = sealed({**smooth, "verdict": "refuted", "cases": [{**smooth["cases"][0], "residuals": []}]})
    assert status(shown) == "confirmed"


def test_what_is_false_is_refuted() -> None:
    """The same points, where they are of the domain."""
    assert against(equal("sin(pi) + q", "q + 1/10**9"), q="1").status == "confirmed"
    assert against(equal("c**2", "-2", symbols={"c": "complex"}), c={"re": "0", "im": "1"}).status == "confirmed"
    assert against(equal("q", "3", domain={"on": ["q - 2"]}), q="2").status == "confirmed"
    assert (
        against(equal("q", "3", domain={"on": ["q**2 - 2"]}), q="1.414213562373095048801688724").status == "confirmed"
    )
    assert against(least("v**2/2 + q*t", "t", "1"), t="1/2").status == "confirmed"
    assert against(series("q + 2*s"), s="3").status == "confirmed"


TEN = {"phase_space": {"q": [f"q{k}" for k in range(10)], "p": [f"p{k}" for k in range(10)]}}
ROUND = "+".join(f"q{k}**2 + p{k}**2" for k in range(10))
ENDLESS = {
    "a normal form in twenty variables": normal(f"{ROUND} + q1**12", 12, **TEN),
    "a root of a high degree": equal("1/q**(1/1000000007)", "q**(-1/1000000007)", symbols={"q": "positive"}),
}
ENDLESS_AT = {
    "exponentials one in another": (equal("exp(exp(exp(exp(exp(q)))))", "q"), {"q": "9"}),
    "a sine of what is huge": (equal("sin(exp(exp(q)))", "q"), {"q": "30"}),
    "powers one in another": (equal("q**q**q**q**q", "q", symbols={"q": "positive"}), {"q": "9"}),
    "a complex exponential": (equal("exp(1j*exp(exp(q)))", "q"), {"q": "30"}),
}


@pytest.mark.parametrize("name", sorted(ENDLESS))
def test_what_would_take_for_ever_is_given_up(name: str) -> None:
    assert status(ENDLESS[name]) != "confirmed"


@pytest.mark.parametrize("name", sorted(ENDLESS_AT))
def test_values_without_an_end_are_given_up(name: str) -> None:
    data, witness = ENDLESS_AT[name]
    assert against(data, **witness).status != "confirmed"


def test_the_checker_ends_in_time() -> None:
    """By the processor's time; what it was about to do is given up, and the next one is answered."""
    steps = {"a0": "q"} | {f"a{k + 1}": f"(a{k} + 1j)**9999" for k in range(300)}
    data = equal("a300", "q", definitions=steps)
    long = sealed({**data, "verdict": "refuted", "witness": {"q": "1/3"}, "cases": []})
    assert checked(long, seconds=0.3).status == "not confirmed"
    assert checked(TRUE["a series"]).status == "confirmed"
