"""One family of values of functions for the small checkers: what maps and identities have in common, and forgeries."""

from contextlib import suppress
from itertools import count
from typing import Any

import pytest

from canon.checker import alone, alone_maps, alone_related, alone_special, alone_squares, alone_values
from tests.checker.certified import resealed
from tests.checker.identities import NAMES, SPACE, answer

SURFACE: Any = {"transformation": {"Q": ["x + y", "x - y"], "P": ["(u + v)/2", "(u - v)/2"]}}


def canonical(Q: str, P: str, *, on: str = "", where: Any = (), **claim: Any) -> str:
    """The answer about a map of one coordinate, whatever a certificate says of it."""
    names = dict.fromkeys([f"a{k}" for k in range(9)], "real")
    words = names | {"m": "positive", "n": "positive", "k": "real", "e": "real", "V": "function"}
    tables = {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]}, "symbols": words,
              "transformation": {"Q": [Q], "P": [P]}, "domain": {"where": [*where]} | ({"on": [on]} if on else {}),
              "claim": {"kind": "canonical", **claim}}  # fmt: skip
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "known": {}, "witness": None, "cases": [{}]}
    return alone_maps.checked(resealed(data))[0]


def test_derivatives_in_exponents_and_angles_are_not_told_by_what_is_differentiated() -> None:
    """On q = k, and where e is 0, V is the same in these places, and its derivative isn't."""
    for wave in ("exp({})", "cos({})"):
        one, other = "D(V(q, k), q)", "D(V(k, q), q)"
        assert canonical("q", "p*" + wave.format(f"{one} - {other}"), on="q - k") == "not shown"
        assert canonical("q", "p*" + wave.format(f"{one} - {one}"), on="q - k") == "shown"
        one, other = "D(V(q, e), e)", "D(V(q, -e), e)"
        assert canonical("q", "p*" + wave.format(f"{one} - {other}"), order=["e", 1]) == "not shown"
        assert canonical("q", "p*" + wave.format(f"{one} - {one}"), order=["e", 1]) == "shown"


@pytest.mark.parametrize(("m", "parts"), [("1", 2), ("y/y", 2), ("x/(2*x - x)", 2), ("y", 1), ("1 - y", 1), ("2", 1)])
def test_the_curve_of_jacobis_functions_has_two_parts_where_m_is_1(m: str, parts: int) -> None:
    claim: Any = alone_special.Small({**SPACE, "claim": {"kind": "identity", "lhs": f"jacobi_dn(x, {m})", "rhs": "0"}})
    claim.loose = frozenset[int]()
    point = alone_values.Values(claim, alone_values.random_prime())
    point.text("_lhs")
    assert 2 ** point.components() == parts


MAPS: Any = [
    ("cos(acos(q)/2)", "4*p*cos(acos(q)/2)"), ("sin(asin(q)/2)", "2*p*sqrt(1 - q**2)/cos(asin(q)/2)"),
    ("cos(3*atan(q)/2)", "-2/3*p*(1 + q**2)/sin(3*atan(q)/2)"),
    ("sqrt(q**2 + 1)**n", "p/(n*q)*sqrt(q**2 + 1)**(2 - n)"),
    ("jacobi_epsilon(q, m)", "p/jacobi_dn(q, m)**2"),
    ("(1 + q**2)**n", "p*sqrt((1 + q**2)**2)/(2*n*q)*(1 + q**2)**(-n)"),
]  # fmt: skip


@pytest.mark.parametrize("given", MAPS)
def test_maps_have_what_identities_have(given: Any) -> None:
    Q, P = given
    assert (canonical(Q, P), canonical(Q, f"-({P})")) == ("shown", "not shown")


IDENTITIES: Any = [
    ("D(elliptic_k(x), x)", "elliptic_e(x)/(2*x*(1 - x)) - elliptic_k(x)/(2*x)"), ("abs(x)**2", "x**2"),
    ("elliptic_k(x/(x - 1))", "sqrt(1 - x)*elliptic_k(x)"), ("sign(x)*abs(x)", "x"), ("D(abs(x), x)", "sign(x)"),
    ("asin(x) + acos(x)", "pi/2"), ("asin(x)", "atan(x/sqrt(1 - x**2))"), ("sqrt(abs(x)**2)", "abs(x)"),
    ("D(jacobi_epsilon(x, y), x)", "jacobi_dn(x, y)**2"), ("sqrt(x)*sqrt(y)", "sqrt(x*y)"),
    ("sqrt(x)*sqrt(y)*sqrt(u)*sqrt(v)", "sqrt(x*y)*sqrt(u*v)"), ("sqrt(c**2*m)", "-c*sqrt(m)"),
]  # fmt: skip


@pytest.mark.parametrize("given", IDENTITIES)
def test_identities_have_what_maps_have(given: Any) -> None:
    lhs, rhs = given
    assert (answer(lhs, rhs), answer(lhs, f"-({rhs})")) == ("shown", "not shown")


MISSES: Any = [
    ("sqrt(sqrt(x**4))", "x"), ("sqrt(sqrt(x**2*y**4))", "sqrt(x)*y"), ("sqrt(x**2*y**2)", "x*y"),
    ("sqrt(x**2)*sqrt(y**2)*sqrt(u**2)", "x*y*u"), ("(x**4)**(1/4)", "x"), ("(x**6)**(1/2)", "x**3"),
    ("sqrt(x**2*m)", "x*sqrt(m)"), ("sqrt(c**2*m**2)", "c*m"), ("sqrt(c**2*x**2)", "-c*x"), ("sqrt(c**2)", "c"),
    ("abs(x)", "x"), ("abs(x*y)", "x*y"), ("sign(x)", "1"), ("D(abs(x), x)", "1"), ("abs(c)", "c"),
    ("jacobi_dn(x, 1)", "-jacobi_cn(x, 1)"), ("jacobi_dn(x, 0)", "-1"), ("jacobi_epsilon(x, y)", "x"),
    ("elliptic_k(x)*sqrt(1 - x)", "elliptic_k(x/(x - 1))*(1 - x)"), ("elliptic_f(x, y)", "elliptic_e(x, y)"),
    ("(x**2)**n", "x**(2*n)"), ("(x**2)**(n/2)", "x**n"), ("sqrt((-c)**n)", "(-c)**n"), ("c**n*c**n", "c**n"),
    ("2*atan(x)", "asin(2*x/(1 + x**2))"), ("acos(2*x**2 - 1)", "2*acos(x)"), ("acos(-x)", "-acos(x)"),
    ("atan(x) + atan(1/x)", "pi/2"), ("sin(acos(x)/2)", "-sqrt((1 - x)/2)"), ("log(x**2)", "2*log(x)"),
    ("sin(atan2(y, x)/2)", "sqrt((1 - x/sqrt(x**2 + y**2))/2)"), ("acosh(cosh(x))", "x"),
]  # fmt: skip


@pytest.mark.parametrize("given", MISSES)
def test_branches_and_components_show_nothing(given: Any) -> None:
    assert answer(*given) == "not shown"


BOUNDS: Any = [
    ("sqrt((1 - x*y)**2)", "1 - x*y", ("0 < x < 1", "0 < y < 1"), ("0 < x < 2", "0 < y < 1")),
    ("sqrt((x - y)**2)", "x - y", ("x > y",), ("x > 1", "y < 2")), ("sqrt((x*y)**2)", "x*y", ("x*y > 0",), ("x > 0",)),
    ("sqrt(x**2)", "x", ("x > 0",), ("x**2 > 1",)), ("x**k*x**(-k)", "1", ("x > 1",), ("x > -1",)),
    ("sqrt((m - 1)**2)", "m - 1", ("m > 1",), ("m < 2",)),
    ("sqrt((x*(y + m) - 1)**2)", "x*(y + m) - 1", ("y > 0", "x*(y + m) > 1"), ("y > 0",)),
    ("sqrt(c**2)", "-c", ("c > -1",), None),
]  # fmt: skip


@pytest.mark.parametrize("given", BOUNDS)
def test_conditions_hold_at_the_points(given: Any) -> None:
    lhs, rhs, where, other = given
    assert answer(lhs, rhs, *where) == "shown"
    assert answer(lhs, f"-({rhs})", *where) == "not shown"
    assert other is None or answer(lhs, rhs, *other) == "not shown"


def found(claim: Any) -> Any:
    """A point at which all is positive that has to be."""
    for _ in range(500):
        point = alone_values.Values(claim, alone_values.random_prime())
        with suppress(alone.Elsewhere):
            point.evaluate()
            return point
    raise AssertionError


COMPONENTS: Any = [
    ("sqrt(x)", 0), ("sqrt(m)", 0), ("sqrt(sqrt(m))", 0), ("sqrt(2*m*y)/sqrt(y)", 0), ("sqrt(x)*sqrt(y)*sqrt(x*y)", 0),
    ("sqrt(x)*sqrt(x**3)", 0), ("sqrt(sqrt(x))", 1), ("sqrt(x**2)", 1), ("sqrt(sqrt(x**4))", 2), ("sqrt(c**2)", 1),
    ("sqrt(sqrt(x**2*y**4))", 2), ("sqrt(((x**2 + 1)**2)**(n + 1/2))", 2), ("sqrt(x**2)*sqrt(y)", 2),
    ("m**n*sqrt(m**n)", 0), ("jacobi_dn(x, 1)*sqrt(y)", 2), ("jacobi_dn(x, y)*sqrt(y)", 0), ("abs(x)*sqrt(abs(x))", 2),
]  # fmt: skip


@pytest.mark.parametrize("given", COMPONENTS)
def test_roots_that_may_tell_components_apart_are_counted(given: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """And what is taken for a square is one. By many points, as what is never refused by chance counts, too."""
    text, roots = given
    monkeypatch.setattr(alone_squares, "ENOUGH", 20)
    tables = {**SPACE, "symbols": NAMES, "claim": {"kind": "identity", "lhs": text, "rhs": text}}
    claim: Any = alone_special.Small(tables)
    assert alone_values.shown(claim) == ("shown", "")
    point = found(claim)
    assert point.components() == roots
    assert all(pow(x, point.half, point.p) == 1 for x in point.sure | point.seen)


TERMS: Any = [
    ("cos(X)", "cos(x)*cos(y) - sin(x)*sin(y)", ()), ("exp(X)", "exp(x)*exp(y)", ()),
    ("cos(asin(sin(x)))", "-cos(x)", ("pi/2 < x < 3*pi/2",)),
    ("exp(asin(sin(x)))", "exp(pi)/exp(x)", ("pi/2 < x < pi",)),
]  # fmt: skip


@pytest.mark.parametrize("given", TERMS)
def test_names_that_are_given_and_branches_are_sums_of_their_terms(given: Any) -> None:
    lhs, rhs, where = given
    assert answer(lhs, rhs, *where, by=SURFACE) == "shown"
    assert answer(lhs, f"2*{rhs}", *where, by=SURFACE) == "not shown"


INSISTED: Any = [
    ("x", ("0 < x < 1",)), ("x*y", ("0 < x < 2", "x < y", "y < 5")), ("sqrt(1 - x)", ("0 < x < 1",)),
    ("sqrt((1 - x)**2)", ("0 < x < 1",)), ("sqrt(m*x - m)", ("x > 1",)), ("sqrt(x*m)", ("m > 2", "x > m")),
    ("sqrt(m)", ("0 < k", "k*m < x**2")), ("k", ("m > u", "k > 1", "u > k")),
    ("x", ("x > 0", "x/(1 + exp(y)) > 0")), ("k", ("k/m > u**2 + 1",)),
]  # fmt: skip


@pytest.mark.parametrize("given", INSISTED)
def test_conditions_that_are_insisted_on_are_no_components(given: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    text, where = given
    monkeypatch.setattr(alone_squares, "ENOUGH", 20)
    identity = {"kind": "identity", "lhs": text, "rhs": text}
    claim: Any = alone_special.Small({**SPACE, "symbols": NAMES, "domain": {"where": [*where]}, "claim": identity})
    claim.insist()
    assert alone_values.shown(claim) == ("shown", "")
    point = found(claim)
    assert point.components() == 0
    assert {point.at(f) for f in claim.conditions()} <= point.seen | point.sure


def test_what_a_map_gives_is_no_square_that_is_chosen(monkeypatch: pytest.MonkeyPatch) -> None:
    """X is x² and positive: its root is x or −x, and the root of this is √x or √−x."""
    monkeypatch.setattr(alone_squares, "ENOUGH", 20)
    explicit = {"Q": ["x**2", "y"], "P": ["u/(2*x)", "v"]}
    for text, roots in (("X", 1), ("sqrt(X)", 1), ("sqrt(sqrt(X))", 2), ("sqrt(m*X)", 1)):
        identity = {"kind": "identity", "lhs": text, "rhs": text}
        tables = {**SPACE, "symbols": {**NAMES, "X": "positive"}, "transformation": explicit, "claim": identity}
        claim: Any = alone_related.Related(tables)
        assert alone_values.shown(claim) == ("shown", "")
        assert found(claim).components() == roots
        f = claim.known("m")
        assert claim.is_positive(f)
        assert claim.factor(f) == claim.factor(claim.known("m**3"))
        claim.settle({"m"})
        assert not claim.is_positive(f)
        assert claim.factor(f) != claim.factor(claim.known("m**3"))


def test_points_of_maps_are_within_many_bounds() -> None:
    """Two conditions for each of nine names: by chance nearly no point fulfils them."""
    where = [f"0 < a{k} < {k + 2}" for k in range(9)]
    assert canonical("q*exp(a0*a1)", "p*exp(-a0*a1)", where=where) == "shown"
    assert canonical("q*exp(a0*a1)", "p*exp(-a0*a2)", where=where) == "not shown"


def test_no_bound_chooses_what_a_map_or_a_surface_gives() -> None:
    """X is x + y: that it is greater than x says something of y, and x isn't chosen below it."""
    assert answer("sqrt(y**2)", "y", "X > x", by=SURFACE) == "shown"
    assert answer("sqrt(x**2)", "x", "X > x", by=SURFACE) == "not shown"
    assert answer("sqrt(x**2)", "x", "X > 0", by=SURFACE) == "not shown"
    assert answer("sqrt(x**2)", "x", "x > 0", "y > x", on="x - u*m") == "shown"
    assert answer("sqrt((y - u*m)**2)", "y - u*m", "x > 0", "y > x", on="x - u*m") == "shown"
    assert answer("sqrt(y**2)", "y", "x > v", "y > x", on="x - u*m") == "not shown"
    assert answer("sqrt((y - x)**2)", "x**3*m - x", "y > x", on="y - x**3*m") == "shown"
    assert answer("sqrt((y - x)**2)", "x - x**3*m", "y > x", on="y - x**3*m") == "not shown"


def test_a_square_on_a_surface_has_two_roots() -> None:
    for root in ("m", "-m", "sqrt(x**2)", "-sqrt(x**2)"):
        assert answer("x", root, on="x**2 - m**2") == "not shown"
    assert answer("x**4", "m**4", on="x**2 - m**2") == "shown"


def test_primes_at_which_a_number_is_no_square_are_left(monkeypatch: pytest.MonkeyPatch) -> None:
    """29 is a square modulo every other prime: no claim is refused for the first few of them."""
    plain, given = alone_squares.random_prime, count()

    def prime() -> int:
        at_first = next(given) < 5
        return next(p for p in iter(plain, 0) if not at_first or pow(29, p // 2, p) != 1)

    monkeypatch.setattr(alone_squares, "random_prime", prime)
    assert answer("sqrt(29)**2*sqrt(x)", "29*sqrt(x)") == "shown"
    assert answer("sqrt(29)", "sqrt(31)") == "not shown"
    assert alone.MODULUS % 29
