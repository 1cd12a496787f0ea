"""Derivatives of functions of which nothing is known, at arguments that share names, in any order."""

import pickle
from itertools import combinations_with_replacement, permutations
from typing import Any

import pytest
import sympy as sp

from canon import InputError, PhaseSpace, identity
from canon.calls import function
from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.substitution import replaced

x, t, s, a = NAMES = sp.symbols("x t s a", real=True)
f, X = function("f"), function("x")
CALLS = [
    f(X(t) + a, t + s), f(x, s + t), f(t, t), f(X(t)), f(2 * t), f(x, t), f(x * t, x + t, x), f(a * s, X(x) + a, X(t)),
    f(f(t, x), t),
]  # fmt: skip
BODIES = {1: lambda u: u**3 + u, 2: lambda u, v: u**2 * v**3 + sp.sin(u), 3: lambda u, v, w: u**2 * v * w**3 + v * w}


def known(expression: Any) -> Any:
    """The expression where f and x are functions that are known."""

    def of(call: Any) -> Any:
        arguments = [known(argument) for argument in call.args]
        return sp.cos(arguments[0]) + arguments[0] if call.func == X else BODIES[len(arguments)](*arguments)

    found = expression.replace(
        lambda part: isinstance(part, sp.Subs),
        lambda part: sp.diff(known(part.expr.expr), *part.expr.variable_count).xreplace(
            dict(zip(part.variables, map(known, part.point), strict=True))
        ),
    )
    found = found.replace(
        lambda part: isinstance(part, sp.Derivative), lambda part: sp.diff(known(part.expr), *part.variable_count)
    )
    return found.replace(lambda part: part.func in (f, X), of)


@pytest.mark.parametrize("call", CALLS, ids=str)
def test_mixed_derivatives_are_those_of_any_function(call):
    at = dict(zip(NAMES, (sp.Rational(2, 3), sp.Rational(3, 5), sp.Rational(5, 7), sp.Rational(7, 11)), strict=True))
    for chosen in combinations_with_replacement(NAMES, 2):
        slopes = {sp.expand(call.diff(u).diff(v)) for u, v in permutations(chosen)}
        assert len(slopes) == 1, chosen
        (slope,) = slopes
        assert slope.free_symbols <= call.free_symbols
        wanted = known(call).diff(*chosen)
        assert abs(sp.N((known(slope) - wanted).xreplace(at))) < 1e-12, chosen


def test_places_where_the_same_stands_are_different_places():
    u, v = sp.symbols("u v", real=True)
    first, second = (replaced(f(u, v).diff(*by), {u: t, v: t}) for by in ((u, u, v), (u, v, v)))
    assert first != second
    assert f(t, t).diff(t).args != (2, f(t, t).diff(t) / 2)


def test_what_is_put_in_is_put_in_at_its_place():
    slope = f(x, t).diff(x)
    assert replaced(slope, {x: t, t: x}) == f(t, x).diff(t)
    assert replaced(f(X(t) + a, t).diff(t), {t: s}) == f(X(s) + a, s).diff(s)


def test_they_are_pickled():
    for call in CALLS:
        slope = call.diff(t).diff(x) if call.has(x) else call.diff(t)
        assert pickle.loads(pickle.dumps(slope)) == slope  # noqa: S301


CLAIMS = [
    ("D(D(f(x*t, a*s, g(x) + a), a), x)", "D(D(f(x*t, a*s, g(x) + a), x), a)", "proved"),
    ("D(D(D(f(t + s, 2*a), a), a), t)", "D(D(D(f(t + s, 2*a), t), a), a)", "proved"),
    ("D(D(f(g(t) + a, t + s), t), a)", "1001/1000*D(D(f(g(t) + a, t + s), a), t)", "refuted"),
    ("D(f(t, t), t, 2)", "D(D(f(t, x), t), x)", "refuted"),
]


@pytest.mark.parametrize(("left", "right", "expected"), CLAIMS)
def test_claims_of_mixed_derivatives(left, right, expected):
    names = "".join(f'{name} = "real"\n' for name in "xtsa")
    text = f"""[phase_space]\nq = ["q"]\np = ["p"]\n[symbols]\n{names}f = "function"\ng = "function"
[[claim]]\nkind = "identity"\nlhs = "{left}"\nrhs = "{right}"\n"""
    verdict = verify(read_text(text).claims[0])
    assert verdict.status == expected
    assert "_" not in str(verdict.witness or "")


def test_a_function_of_sympys_with_the_same_name_does_not_change_its_derivatives() -> None:
    """Equal functions would share what sympy's cache holds: derivatives with names that sympy has left in them."""
    x, a, s = sp.symbols("x a s", real=True)
    places = (x * a, a * s, x + a)
    assert sp.Function("shared")(*places).diff(x).diff(a).has(sp.Subs)
    first, second = function("shared")(*places).diff(a).diff(x), function("shared")(*places).diff(x).diff(a)
    assert not (first - second).expand().free_symbols - {x, a, s}
    assert function("shared") != sp.Function("shared")


def test_derivatives_that_sympy_does_not_tell_apart_are_refused() -> None:
    """Of sympy's Subs(∂₁V(a, b), (a, b), (q, q)) and the same of ∂₂V, the difference is 0 before anybody can look."""
    space = PhaseSpace("q", "p", real="a b", functions="V U")
    q, p, a, b = map(space.symbol, "qpab")
    V = space.function("V")
    first, second = (sp.Subs(V(a, b).diff(name), (a, b), (q, q)) for name in (a, b))
    assert first == second
    for state in (lambda: identity(space, first, second), lambda: identity(space, V(q, q).diff(q), first + second)):
        with pytest.raises(InputError, match="does not tell"):
            state()
    U = space.function("U")  # of three places two have the same order
    with pytest.raises(InputError, match="does not tell"):
        identity(space, sp.Subs(U(a, b, q).diff(a, b), (a, b, q), (p, p, p)), U(p, p, p))
    both = [sp.Subs(V(a, b).diff(a, b), names, (q, q)) for names in ((a, b), (b, a))]
    assert verify(identity(space, *both)).status == "proved"
    assert verify(identity(space, sp.Subs(V(a, b).diff(a), (a, b), (q, p)), V(q, p).diff(q))).status == "proved"
    one, two = (V(a, b).diff(name).subs(a, q).subs(b, q) for name in (a, b))
    assert verify(identity(space, one, two)).status == "refuted"
    assert verify(identity(space, one + two, V(q, q).diff(q))).status == "proved"
