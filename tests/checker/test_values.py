"""Relations and values of functions that the checker's rules prove, and such that only look so."""

import random
from typing import Any

import pytest

from canon.checker import core
from canon.checker.followed import Followed
from canon.checker.intervals import Intervals, Open
from canon.checker.points import Numbers
from canon.checker.statement import Statement
from canon.checker.tower import Tower
from canon.checker.values import Values

PRIME = 2**127 - 1
KERNELS = {
    "r": "(x**2 + y**2)**(1/2)",
    "h": "(x**2 + y**2)**(1/4)",
    "k": "(r + y)**(1/3)",
    "c": "cos(x*r)",
    "s": "sin(x*r)",
    "s2": "sin(2*x*r)",
    "ch": "cosh(y)",
    "sh": "sinh(y)",
    "a": "abs(x - y)",
    "cn": "jacobi_cn(x, m)",
    "sn": "jacobi_sn(x, m)",
    "dn": "jacobi_dn(x, m)",
    "n": "2**(1/2)",
    "e": "exp(x)",
}


def followed(
    atoms: dict[str, Any], *, real: bool = True, where: tuple[str, ...] = (), kernels: dict[str, str] = KERNELS
) -> tuple[Followed, Statement]:
    """The kernels, and these values of functions in them, of a claim with x > 0 that says nothing."""
    words = {"x": "positive", "y": "real", "m": "positive"} | ({} if real else {"z": "complex"})
    tables = {"phase_space": {"q": ["x"], "p": ["y"]}, "symbols": words, "domain": {"where": [*where]}, "claim": {}}
    s = Statement(tables, {}, "proved")
    nodes = {name: s.f.read(text, {}) for name, text in kernels.items()}
    values = {s.f.read(text, {}): tuple(map(core.read, pair)) for text, pair in atoms.items()}
    return Followed(s, nodes, values, Values(s, PRIME, random.Random(5), real=real)), s


def answer(name: str, relation: dict[str, str], *, real: bool = True) -> bool:
    return followed({}, real=real)[0].vanishes(core.read(relation))


@pytest.mark.parametrize(
    ("name", "relation"),
    [
        ("r", {"r^2": "1", "x^2": "-1", "y^2": "-1"}),
        ("h", {"h^2": "1", "r": "-1"}),
        ("h", {"h^4": "1", "x^2": "-1", "y^2": "-1"}),
        ("k", {"k^3": "1", "r": "-1", "y": "-1"}),
        ("s", {"s^2": "1", "c^2": "1", "": "-1"}),
        ("c", {"s^2": "1", "c^2": "1", "": "-1"}),
        ("sh", {"sh^2": "1", "ch^2": "-1", "": "1"}),
        ("ch", {"ch^2": "1", "sh^2": "-1", "": "-1"}),
        ("a", {"a^2": "1", "x^2": "-1", "x y": "2", "y^2": "-1"}),
        ("cn", {"cn^2": "1", "sn^2": "1", "": "-1"}),
        ("dn", {"dn^2": "1", "m sn^2": "1", "": "-1"}),
        ("n", {"n^2": "1", "": "-2"}),
    ],
)
def test_what_the_table_proves(name: str, relation: dict[str, str]) -> None:
    assert answer(name, relation)
    for monomial, coefficient in relation.items():  # each coefficient matters
        other = {**relation, monomial: f"{coefficient}01/100"}
        assert not answer(name, other)


@pytest.mark.parametrize(
    ("name", "relation"),
    [
        ("s2", {"s2^2": "1", "c^2": "1", "": "-1"}),  # another argument
        ("h", {"h^3": "1", "r": "-1"}),
        ("n", {"n^2": "1", "": "-2", "x": "1/1000000000000000000000000000000000000000000000000000000000000"}),
        ("r", {"r^2": "1", "r": "1", "x^2": "-1", "y^2": "-1"}),
        ("e", {"e^2": "1", "x": "-1"}),
        ("dn", {"dn^2": "1", "sn^2": "1", "": "-1"}),
    ],
)
def test_what_it_does_not_prove(name: str, relation: dict[str, str]) -> None:
    assert not answer(name, relation)


def test_an_absolute_value_is_one_of_something_real() -> None:
    assert not answer("a", {"a^2": "1", "x^2": "-1", "x y": "2", "y^2": "-1"}, real=False)


def one(**powers: int) -> dict[str, str]:
    return {" ".join(f"{name}^{e}" for name, e in powers.items()): "1"}


ONE = {"": "1"}
VALUES: dict[str, tuple[dict[str, str], dict[str, str]]] = {
    "sin(2*x*r)": ({"s c": "2"}, ONE),
    "cos(-x*r)": (one(c=1), ONE),
    "tan(x*r + pi/2)": ({"c": "-1"}, one(s=1)),
    "exp(3*x)": (one(e=3), ONE),
    "exp(2*log(y + 7))": ({"y^2": "1", "y": "14", "": "49"}, ONE),
    "sqrt(x**2)": (one(x=1), ONE),
    "(x**2 + y**2)**(-3/2)": (ONE, one(r=3)),
    "sqrt(8*x**4*(x**2 + y**2))": ({"n r x^2": "2"}, ONE),
    "sin(atan2(y, x))": (one(y=1), one(r=1)),
    "cos(asin(y/r))": (one(x=1), one(r=1)),
    "cosh(asinh(y/x))": (one(r=1), one(x=1)),
    "sign(y - x)": (one(a=1), {"y": "1", "x": "-1"}),
    "sqrt((y - 9)**2)": ({"y": "1", "": "-9"}, ONE),
}


@pytest.mark.parametrize("text", sorted(VALUES))
def test_values_of_functions(text: str) -> None:
    """Each follows from the rules; with another coefficient, or the other sign, it doesn't."""
    value = VALUES[text]
    for factor, right in (("1", True), ("-1", False), ("1001/1000", False)):
        changed = {m: str(core.number(c) * core.number(factor)) for m, c in value[0].items()}
        shown, s = followed({text: (changed, value[1])}, where=("y > 9",))
        assert shown.is_value(s.f.read(text, {})) is right, factor


def test_what_a_sign_rests_on() -> None:
    """√((y − 9)²) is y − 9 where the domain says so, and not elsewhere; nor is anything so that is complex."""
    text = "sqrt((y - 9)**2)"
    for where, real in (((), True), (("y < 9",), True), (("y > 9",), False)):
        shown, s = followed({text: VALUES[text]}, real=real, where=where)
        assert not shown.is_value(s.f.read(text, {}))


@pytest.mark.parametrize(
    ("where", "right"), [(("0 < x", "x < pi"), True), (("x < pi",), True), (("x < 4",), False), ((), False)]
)
def test_the_sign_of_a_sine(where: tuple[str, ...], right: bool) -> None:
    """√(1 − cos² x) is sin x between 0 and π."""
    kernels = {"c1": "cos(x)", "s1": "sin(x)"}
    shown, s = followed({"sqrt(1 - cos(x)**2)": (one(s1=1), ONE)}, where=where, kernels=kernels)
    assert shown.is_value(s.f.read("sqrt(1 - cos(x)**2)", {})) is right


def test_divisors_of_zero_have_no_inverse() -> None:
    t = Tower(PRIME, random.Random(1))
    x = t.free()
    g = t.root(t.mul(x, x), 2)  # x or -x
    h = t.root(t.add(g, x), 3)
    a = t.add(t.mul(h, h), t.add(h, g))
    assert t.mul(a, t.inverse(a)) == t.constant(core.Fraction(1))
    for zero in (t.add(g, x), t.add(g, x, -1), t.constant(core.Fraction(0))):
        with pytest.raises(ZeroDivisionError):
            t.inverse(zero)


def test_a_random_prime_is_one() -> None:
    rng = random.Random(3)
    for n in {core.random_prime(rng) for _ in range(3)}:
        assert n.bit_length() == 127
        assert pow(5, n - 1, n) == 1


FORMULAS = (
    "exp(x)*((x + 10**200) - 10**200)",
    "atan2(x, -x) + atan2(-x, -x) - asin(x) + acos(x)*sqrt(x)",
    "elliptic_f(x, x) + elliptic_k(x) - elliptic_e(x) + elliptic_e(x, x)",
    "jacobi_sn(x, x) - jacobi_cn(x, x)*jacobi_dn(x, x)",
    "tanh(x) + coth(x) + sinh(x)*cosh(x) + abs(-x) + sign(-x) + tan(x) + sec(x)",
)


@pytest.mark.parametrize("text", FORMULAS)
def test_intervals_hold_the_value(text: str) -> None:
    """Those of few digits hold those of many, and mpmath's value."""
    s = Statement({"phase_space": {}, "claim": {}}, {}, "proved")
    a = s.f.read(text, {})
    found = []
    for digits in (250, 600):
        own = Intervals(digits)
        found.append(own.values(s.f, [a], {"x": own.number(core.Fraction(1, 3))})[a])
    wide, narrow = found
    assert wide.a <= narrow.a <= narrow.b <= wide.b
    assert narrow.b - narrow.a < 1e-100
    value = Numbers(300).values(s.f, [a], {"x": Numbers(300).number(core.Fraction(1, 3))})[a]
    assert abs(float(narrow.a) - float(value)) < 1e-15


@pytest.mark.parametrize("text", ["log(x - x)", "1/(x - x)", "lambertw(x)", "gamma(-x)", "sqrt(-x)", "abs(x - x)"])
def test_where_there_is_no_interval(text: str) -> None:
    s = Statement({"phase_space": {}, "claim": {}}, {}, "proved")
    own = Intervals(30)
    with pytest.raises(Open):
        own.values(s.f, [s.f.read(text, {})], {"x": own.number(core.Fraction(1, 3))})


@pytest.mark.parametrize(("u", "m"), [("-2", "9/10"), ("5", "3/10")])
def test_an_interval_of_jacobis_epsilon_holds_its_integral(u: str, m: str) -> None:
    """At the corners of a rectangle of arguments, the integral of dn² by quadrature."""
    own, mp, far = Intervals(30), Numbers(15).mp, core.Fraction(1, 10**6)
    corners = [(core.Fraction(u) + j * far, core.Fraction(m) + k * far) for j in (0, 1) for k in (0, 1)]
    s = Statement({"phase_space": {}, "claim": {}}, {}, "proved")
    a = s.f.read("jacobi_epsilon(x, y)", {})
    box = {name: own.iv.mpf([own.number(low).a, own.number(high).b])
           for name, low, high in zip("xy", corners[0], corners[3], strict=True)}  # fmt: skip
    held = own.values(s.f, [a], box)[a]
    for x, y in corners:
        end, parameter = (mp.mpf(z.numerator) / z.denominator for z in (x, y))
        value = mp.quad(lambda w, k=parameter: mp.ellipfun("dn", w, m=k) ** 2, mp.linspace(0, end, 5))
        assert held.a < value < held.b
    assert held.b - held.a < 1e-1
