"""Certificates of what holds on a part of the domain, or at some values of the parameters, and nowhere else.

What must not vanish doesn't at one point; of the other parts, and of other values, a rule has to speak. Each of `FALSE`
was confirmed by an earlier checker.
"""

from typing import Any

import pytest

from tests.checker.test_forged_places import MAP, of, status

REAL, SPACE = {"a": "real"}, {"q": ["x", "y"], "p": ["px", "py"]}


def lagrangian(L: str, **symbols: str) -> dict[str, Any]:
    """The motion of L, of which the equations are solved for the acceleration 0."""
    return of({"kind": "euler_lagrange", "L": L, "velocities": ["v"], "qddot": ["0"]}, symbols=symbols)


def legendre(L: str, H: str, **symbols: str) -> dict[str, Any]:
    return of({"kind": "legendre", "L": L, "velocities": ["v"]}, hamiltonian={"H": H}, symbols=symbols)


def moving(form: str, **symbols: str) -> dict[str, Any]:
    claim = {"kind": "constraint", "velocities": ["v", "w"], "forms": [form], "stationary": False}
    return of(claim, phase_space=SPACE, symbols=symbols)


def mean(to: str, **symbols: str) -> dict[str, Any]:
    motion = {"q": "cos(u)", "p": "-sin(u)", "t": "u"}
    ends = {"parameter": "u", "from": "0", "to": to, "antiderivative": "u"}
    claim = {"kind": "average", "f": "1", "equals": "1", "motion": motion, **ends}
    return of(claim, hamiltonian={"H": "p**2/2 + q**2/2"}, symbols=symbols)


def backward(q: str, p: str, kind: str = "new_hamiltonian", **symbols: str) -> dict[str, Any]:
    claim = {"kind": kind} | ({"K": "0"} if kind == "new_hamiltonian" else {})
    return of(claim, transformation={"q": [q], "p": [p]}, hamiltonian={"H": "0"}, phase_space=MAP, symbols=symbols)


FALSE = {
    "accelerations of no motion, for a = 0": lagrangian("a*v**2/2", **REAL),
    "accelerations of no motion, for v < 0": lagrangian("(v + abs(v))**2/8"),
    "a transformation of no momenta, for v < 0": legendre("(v + abs(v))**2/8", "p**2/2"),
    "time is in it but for a = 0": moving("v + a*t*w", **REAL),
    "time is in it, and wasn't before": moving("v + (t + abs(t))*w"),
    "an average over no time": mean("a", **REAL),
    "an average over no time, for a < 0": mean("a + abs(a)", **REAL),
    "an average over n periods, be they none": mean("2*pi*n", n="integer"),
    "a scale of no map, for a = 0": backward("a*Q", "P", **REAL),
    "a scale of no symmetry, for a = 0": backward("a*Q", "a*P", "symmetry", **REAL),
}
TRUE = {
    "accelerations": lagrangian("a*v**2/2", a="positive"),
    "accelerations, but for v = 0": lagrangian("v**4"),
    "a transformation": legendre("a*v**2*sin(q)**2", "p**2/(4*a*sin(q)**2)", a="positive"),
    "a form with time": moving("v + (a + b*t)**2*w", a="positive", b="nonzero"),
    "an average": mean("a", a="positive"),
    "a scale": backward("a*Q", "P", a="nonzero"),
    "a scale with Jacobi's functions": of(
        {"kind": "new_hamiltonian", "K": "E"},
        phase_space={"q": ["q"], "p": ["p"], "Q": ["s"], "P": ["E"]},
        definitions={"k": "sqrt((E + 1)/2)"},
        domain={"where": ["-1 < E < 1"]},
        hamiltonian={"H": "p**2/2 - cos(q)"},
        transformation={"q": ["2*asin(k*jacobi_sn(s, k**2))"], "p": ["2*k*jacobi_cn(s, k**2)"]},
    ),
}


@pytest.mark.parametrize("name", sorted(FALSE))
def test_what_holds_on_a_part_is_not_confirmed(name: str) -> None:
    assert status(FALSE[name]) != "confirmed", name


@pytest.mark.parametrize("name", sorted(TRUE))
def test_what_holds_nearly_everywhere_is_confirmed(name: str) -> None:
    assert status(TRUE[name]) == "confirmed", name
