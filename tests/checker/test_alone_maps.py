"""More claims about maps by small files: what is shown, near misses, branches, components and special values."""

from typing import Any

import mpmath as mp
import pytest

from canon.checker import alone, alone_maps, alone_special, alone_together
from tests.checker.certified import certified, resealed

LINE: Any = {"phase_space": {"q": ["q"], "p": ["p"], "Q": ["Q"], "P": ["P"]}}
PLANE: Any = {"phase_space": {"q": ["x", "y"], "p": ["a", "b"], "Q": ["X", "Y"], "P": ["A", "B"]}}
NAMES: Any = {"m": "positive", "k": "positive", "e": "real", "V": "function", "g": "function"}


def answer(claim: Any, Q: Any = None, P: Any = None, *, potential: Any = "", **sections: Any) -> str:
    """The answer about a claim beside a map given forward, whatever a certificate says of it."""
    of = lambda x: x if isinstance(x, list) else [x]
    explicit = {"transformation": {"Q": of(Q), "P": of(P)}} if Q is not None else {}
    tables = {**LINE, "symbols": NAMES, **explicit, **sections, "claim": claim}
    data = {"certificate": 1, "tables": tables, "verdict": "proved", "witness": None, "cases": [{}],
            "known": {"potential": potential} if potential else {}}  # fmt: skip
    return alone_maps.checked(resealed(data))[0]


CANONICAL = {"kind": "canonical"}
K = "p**2 + sin(q/2)**2"


@pytest.mark.parametrize("name", alone_special.MORE)
def test_derivatives_are_those_of_the_functions(name: str) -> None:
    """By difference quotients of the integrals and functions as mpmath has them."""
    F, E = (lambda u, m: mp.ellipf(u, m)), (lambda u, m: mp.ellipe(u, m))
    sn, cn, dn = ((lambda u, m, k=k: mp.ellipfun(k, u, m=m)) for k in ("sn", "cn", "dn"))
    epsilon = lambda u, m: mp.quad(lambda v: dn(v, m) ** 2, [0, u])
    of = {"elliptic_k": mp.ellipk, "elliptic_e": mp.ellipe, "elliptic_f/2": F, "elliptic_e/2": E, "jacobi_sn/2": sn,
          "jacobi_cn/2": cn, "jacobi_dn/2": dn, "jacobi_epsilon/2": epsilon}  # fmt: skip
    called = lambda u, m=None: mp.ellipe(u) if m is None else E(u, m)
    words = {"elliptic_k": mp.ellipk, "elliptic_e": called, "elliptic_f": F, "jacobi_sn": sn, "jacobi_cn": cn,
             "jacobi_dn": dn, "jacobi_epsilon": epsilon, "sin": mp.sin, "cos": mp.cos, "sqrt": mp.sqrt}  # fmt: skip
    place = [mp.mpf("0.7"), mp.mpf("0.3")][: len(alone_special.MORE[name])]
    for k, text in enumerate(alone_special.MORE[name]):
        ahead, back = ([x + s * (i == k) for i, x in enumerate(place)] for s in (mp.mpf("1e-5"), -mp.mpf("1e-5")))
        text = text.replace("(-1/2)", "(-0.5)")
        steep = eval(text, {**words, **dict(zip("ab", place, strict=False))})  # noqa: S307
        assert abs((of[name](*ahead) - of[name](*back)) / mp.mpf("2e-5") - steep) < 1e-7


SHOWN: dict[str, Any] = {
    "Jacobi": ("jacobi_sn(q, m/(1 + m))", "p/(jacobi_cn(q, m/(1 + m))*jacobi_dn(q, m/(1 + m)))"),
    "an elliptic integral": ("elliptic_f(q, e)", "p*sqrt(1 - e*sin(q)**2)"),
    "an angle of the pendulum": (f"elliptic_f(asin(sin(q/2)/sqrt({K})), {K})", "p**2 - cos(q)/2"),
    "a modulus": ("abs(q)", "p*sign(q)"), "a logarithm": ("exp(log(q)/2)", "2*p*sqrt(q)"),
    "an arc": ("sin(acos(q))", "-p*sqrt(1 - q**2)/q"), "an area": ("cosh(asinh(q))", "p*sqrt(1 + q**2)/q"),
    "a half plane": ("atan2(q, sqrt(m))*sqrt(m)", "p*(q**2 + m)/m"),
}  # fmt: skip


@pytest.mark.parametrize("name", SHOWN)
def test_a_canonical_map_is_shown(name: str) -> None:
    domain = {"domain": {"where": ["-pi < q < pi", "p > 0", f"{K} < 1"]}} if "pendulum" in name else {}
    Q, P = SHOWN[name]
    claim = {**CANONICAL, "scale": "1"}
    assert answer(claim, Q, P, **domain) == "shown"
    assert answer(claim, Q, f"-({P})", **domain) == "not shown"
    assert answer(claim, Q, f"({P})*(1 + p/1000)", **domain) == "not shown"


MISSES: dict[str, Any] = {
    "another modulus": ("jacobi_sn(q, m)", "p/(jacobi_cn(q, m)*jacobi_dn(q, 2*m))"),
    "dn that may be negative": ("asin(sqrt(m)*jacobi_sn(q, m))/sqrt(m)", "p/jacobi_cn(q, m)"),
    "cn that may be negative": ("asin(jacobi_sn(q, m))", "p/jacobi_dn(q, m)"),
    "a modulus without its sign": ("abs(q)", "p"), "a sine's inverse, anywhere": ("asin(sin(q))", "p"),
    "a cosine's, anywhere": ("acos(cos(q))", "p"), "a root of a square": ("sqrt(q**2)", "p"),
    "half of an arc": ("sin(acos(q)/2)", "-p*sqrt(1 - q**2)"), "E for K": ("elliptic_e(q, e)",
    "p*sqrt(1 - e*sin(q)**2)"),
    "a function of three": ("elliptic_f(q, e, m)", "p"), "of none": ("q*elliptic_k()", "p"),
    "a name that is a function's": ("q + 0*jacobi_sn", "p"), "no function": ("q + jacobi_am(q, e)*0", "p"),
    "many roots": ("sqrt(sqrt(sqrt((q - 1)**8)**4)**2)", "p"),
}  # fmt: skip


@pytest.mark.parametrize("name", MISSES)
def test_what_is_false_somewhere_is_not_shown(name: str) -> None:
    assert [answer(CANONICAL, *MISSES[name]) for _ in range(2)] == ["not shown"] * 2


def test_what_is_false_on_one_component_of_many_is_not_shown() -> None:
    """Of 32 choices of signs the last one alone has another bracket: 8 points would hardly meet it."""
    names = [f"a{k}" for k in range(5)]
    product = "*".join(f"(sqrt({name}**2) - {name})" for name in names)
    symbols = {"symbols": dict.fromkeys(names, "real")}
    assert [answer(CANONICAL, "q", f"p*(1 + {product})", **symbols) for _ in range(3)] == ["not shown"] * 3
    four = "*".join(f"(sqrt(sqrt({name}**4)) - {name})" for name in names[:2])
    assert [answer(CANONICAL, "q", f"p*(1 + {four})", **symbols) for _ in range(3)] == ["not shown"] * 3
    true = "*".join(f"(sqrt({name}**2) - abs({name}))" for name in names[:3])
    assert answer(CANONICAL, "q", f"p*(1 + {true})", **symbols) == "shown"


def test_a_sine_has_its_sign_where_the_angle_is_bounded() -> None:
    for low, high, sign in (("-pi/2", "pi/2", ""), ("pi/2", "3*pi/2", "-"), ("-3*pi/2", "-pi/2", "-")):
        for given in ("", "-"):
            domain = {"where": [f"{low} < q < {high}"]}
            assert answer(CANONICAL, "asin(sin(q))", f"{given}p", domain=domain) == (
                "shown" if given == sign else "not shown"
            )
    assert answer(CANONICAL, "asin(sin(q))", "p", domain={"where": ["-pi/2 < q < 2"]}) == "not shown"
    assert answer(CANONICAL, "asin(sin(q))", "p", domain={"where": ["0 < q < 4"]}) == "not shown"


@pytest.mark.parametrize(("scale", "shown"), [
    ("1 + e**2", True), ("exp(-m*k)", True), ("-m", True), ("2", True), ("e", False), ("e**2", False), ("0", False),
    ("1 + cos(e)", False), ("m - k", False), ("1 + g(e)**2", False), ("q/q", False), ("1/e", False), ("t/t", False),
])  # fmt: skip
def test_a_scale_is_0_nowhere(scale: str, shown: bool) -> None:
    assert answer({**CANONICAL, "scale": scale}, f"q*({scale})", "p") == ("shown" if shown else "not shown")
    assert answer({**CANONICAL, "scale": f"2*({scale})"}, f"q*({scale})", "p") == "not shown"


@pytest.mark.parametrize("sign", ["abs(x)", "sqrt(x**2)"])
def test_a_scale_that_is_not_stated_is_one_number(sign: str) -> None:
    """{X, A} = {Y, B} = sign(x) is two numbers; in all of the small files."""
    given = {"transformation": {"Q": [sign, f"y*x/{sign}"], "P": ["a", "b"]}, "hamiltonian": {"H": "0"}, **PLANE}
    entry = {"numerator": {}, "denominator": {"": "1"}, "cofactors": {}}
    for claim, count in (({"kind": "new_hamiltonian", "K": "0"}, 15), ({"kind": "symmetry"}, 15)):
        data = {"certificate": 1, "tables": {**given, "claim": claim}, "verdict": "proved", "witness": None,
                "cases": [{"kernels": [], "residuals": [entry] * count}], "known": {}}  # fmt: skip
        assert [alone_together.checked(resealed(data))[0] for _ in range(4)] == ["not shown"] * 4
    assert answer({"kind": "new_hamiltonian", "K": "m*P**2"}, "m*q", "p", hamiltonian={"H": "p**2"}) == "shown"


@pytest.mark.parametrize(("Q", "P", "order", "shown"), [
    ("q + e*p", "p - e*q", 1, True), ("q + e*p", "p - e*q", 2, False),
    ("q + e*D(g(q, p), p)", "p - e*D(g(q, p), q)", 1, True),
    ("q + e*p", "p - 2*e*q", 1, True),
    ("q + e*q", "p", 1, False), ("q + e*q", "p - e*p", 1, True), ("q + e*q", "p - e*p", 2, False),
    ("q + abs(e)*q", "p", 0, False), ("q + e**(3/2)*q", "p", 1, False), ("q*(1 + e**2/e)", "p", 0, False),
    ("q*exp(e)", "p*exp(-e)", 5, True), ("q*exp(e)", "p*(1 - e + e**2/2)", 2, True),
    ("q*exp(e)", "p*(1 - e + e**2/2)", 3, False),
    ("q + e*p", "p - e*q", -1, False), ("q + e*p", "p - e*q", 1.0, False), ("q + e*p", "p - e*q", 60, False),
    ("q + sin(e*p)", "p - sin(e*q)", 1, True), ("q + sin(e*p)", "p - sin(e*q)", 2, False),
    ("2*q + e*p", "p/2", 3, True),
])  # fmt: skip
def test_an_order_counts_all_powers_up_to_it(Q: str, P: str, order: Any, shown: bool) -> None:
    assert answer({**CANONICAL, "order": ["e", order]}, Q, P) == ("shown" if shown else "not shown")


def test_a_parameter_of_an_order_may_be_0() -> None:
    claim = {**CANONICAL, "order": ["e", 1]}
    for more in ({"domain": {"where": ["e > 0"]}}, {"symbols": {"e": "positive"}}, {"hamiltonian": {"H": "p/e"}}):
        assert answer(claim, "q + e*p", "p - e*q", **more) == "not shown"
    assert answer({**CANONICAL, "order": ["q", 1]}, "q", "p") == "not shown"


def test_fewer_variables_have_brackets_too() -> None:
    space = {"phase_space": {"q": ["x", "y"], "p": ["a", "b"], "Q": ["r"], "P": ["s"]}}
    r = "sqrt(x**2 + y**2)"
    for kind in ("canonical", "fundamental_brackets"):
        assert answer({"kind": kind}, r, f"(x*a + y*b)/{r}", **space) == "shown"
        assert answer({"kind": kind}, r, f"(x*a + 2*y*b)/{r}", **space) == "not shown"
    for kind in ("volume", "integral_invariant", "cartan_invariant", "new_hamiltonian"):
        claim = {"kind": kind, **({"K": "0"} if kind[0] in "cn" else {})}
        assert answer(claim, r, f"(x*a + y*b)/{r}", hamiltonian={"H": "0"}, **space) == "not shown"


@pytest.mark.parametrize(("on", "P", "shown"), [
    ("x*b - y*a", ["a + e*(x*b - y*a)**2", "b"], True), ("x*b - y*a", ["a + e*(x*b - y*a)", "b"], False),
    ("x*y", ["a + x**2*y**2*b", "b"], True), ("x*y", ["a + y**2*b", "b"], False), ("x*y", ["a + x**2*b", "b"], False),
    ("x**2*y", ["a + y**2*b", "b"], False), ("(x**2 + y**2 - 1)*a", ["a + a**2*b", "b"], False),
    ("(x - m)*y", ["a + y**2*b", "b"], False), ("X*b - y*a", ["a", "b"], False), ("m - 1", ["a", "b"], False),
    ("sin(x)*y", ["a + y**2*b", "b"], False), ("e*x", ["a + x**2*b", "b"], False),
])  # fmt: skip
def test_a_surface_has_all_of_its_components(on: str, P: Any, shown: bool) -> None:
    domain = {"domain": {"on": [on]}}
    assert answer(CANONICAL, ["x", "y"], P, **domain, **PLANE) == ("shown" if shown else "not shown")
    assert answer({"kind": "volume"}, ["x", "y"], P, **domain, **PLANE) == "not shown"
    assert answer(CANONICAL, ["x", "y"], P, domain={"on": [on, "x"]}, **PLANE) == "not shown"


def test_volumes_and_invariants() -> None:
    shear: Any = (["x + a", "y"], ["a", "b"])
    turned: Any = (["x", "y"], ["b", "a"])
    for claim in ({"kind": "volume"}, {"kind": "integral_invariant"}, {"kind": "integral_invariant", "order": 2}):
        assert answer(claim, *shear, **PLANE) == "shown"
    assert answer({"kind": "volume"}, *turned, **PLANE) == "shown"
    assert answer({"kind": "integral_invariant", "order": 2}, *turned, **PLANE) == "not shown"
    assert answer({"kind": "volume"}, ["x + a", "2*y"], ["a", "b"], **PLANE) == "not shown"
    for order in (0, 3, True, "2", 1.0):
        assert answer({"kind": "integral_invariant", "order": order}, *shear, **PLANE) == "not shown"
    assert answer({"kind": "volume"}, "(q + 1j*p)/sqrt(2)", "(q - 1j*p)/sqrt(2)") == "shown"
    assert answer({"kind": "volume"}, "q + 1j*p", "q - 1j*p") == "not shown"
    assert answer({"kind": "volume", "order": 1}, "(q + 1j*p)/sqrt(2)", "(q - 1j*p)/sqrt(2)") == "not shown"


@pytest.mark.parametrize(("H", "K", "potential", "shown"), [
    ("p**2", "P**2", "0", True), ("p**2", "P**2", "", True), ("p**2", "2*P**2", "0", False),
    ("p**2", "P**2 + 1", "t", True),
    ("p**2", "P**2 + 1", "-t", False), ("p**2", "P**2", "log(q) - log(q)", False),
    ("p**2", "P**2 - V(t)", "V(t)", False),
    ("p**2", "P**2 - 1", "-t + asin(q) - asin(q)", False), ("p**2", "P**2 - 1", "-t + Q - q", False),
    ("p**2", "P**2", "q", False),
])  # fmt: skip
def test_cartans_form_by_a_potential(H: str, K: str, potential: str, shown: bool) -> None:
    claim = {"kind": "cartan_invariant", "K": K}
    found = answer(claim, "q", "p", hamiltonian={"H": H}, potential=potential)
    assert found == ("shown" if shown else "not shown")


def test_a_flux_through_a_hole_has_no_potential() -> None:
    around = {"phase_space": PLANE["phase_space"], "symbols": {}, "hamiltonian": {"H": "0"}}
    P = ["a - y/(x**2 + y**2)", "b + x/(x**2 + y**2)"]
    claim = {"kind": "cartan_invariant", "K": "0"}
    for potential in ("-atan2(y, x)", "-atan(y/x)", "atan2(x, y)", "0"):
        assert answer(claim, ["x", "y"], P, potential=potential, **around) == "not shown"
    cut = {**around, "hamiltonian": {"H": "atan2(y, x)"}}  # the file is about the plane with a cut
    assert answer({**claim, "K": "atan2(Y, X)"}, ["x", "y"], P, potential="-atan2(y, x)", **cut) == "shown"


def test_what_holds_of_every_canonical_map() -> None:
    claim = {"kind": "bracket_invariance", "f": "V(Q, P)", "g": "sin(Q)*P"}
    assert answer(claim, "q + p", "p") == "shown"
    assert answer(claim, "q + p", "2*p") == "not shown"
    assert answer({**claim, "f": "q*P"}, "q + p", "p") == "not shown"
    assert answer({**claim, "h": "P"}, "q + p", "p") == "not shown"
    assert answer({**claim, "f": "P"}, "-q**2", "-p/(2*q)", symbols={"Q": "positive"}) == "not shown"


def test_complete_integrals() -> None:
    H, claim = {"hamiltonian": {"H": "p**2/(2*m)"}}, {"kind": "hamilton_jacobi", "constants": ["E"], "energy": "E"}
    assert answer({**claim, "W": "q*sqrt(2*m*E)"}, **H) == "shown"
    assert answer({**claim, "W": "q*sqrt(m*E)"}, **H) == "not shown"
    plane = {**PLANE, "hamiltonian": {"H": "(a**2 + b**2)/2"}}
    W = "c*x + y*sqrt(2*E - c**2)"
    for constants, energy, expected in ((["c"], "E", "shown"), (["c"], "2*E", "not shown"), (["c"], "c", "not shown"),
                                        (["c", "E"], "E", "shown"), ([], "E", "not shown"),
                                        (["c"], "x", "not shown")):  # fmt: skip
        given = {**claim, "W": W, "constants": constants, "energy": energy}
        assert answer(given, **plane) == expected
    given = {**claim, "W": "c*x + c*y", "constants": ["c"], "energy": "E"}
    assert answer(given, **plane) == "not shown"


@pytest.mark.parametrize(("F", "shown"), [
    ("q*P + e*g(q, P)", True), ("e*q*P + e*g(q, P)", False), ("e*q*P", False), ("e*g(q, P)", False),
    ("q*P/m + e*V(q)", True),
    ("(1 + e)*q*P + g(q)", False), ("q*P + e*g(q, P)/V(q)", False), ("(1 + e**2)*q*P + g(q, P)", False),
])  # fmt: skip
def test_a_generating_function_of_all_parameters(F: str, shown: bool) -> None:
    given = {"generating_function": {"type": 2, "F": F}}
    for claim in (CANONICAL, {"kind": "volume"}, {"kind": "integral_invariant"}):
        assert answer(claim, **given) == ("shown" if shown else "not shown")
    for claim in ({"kind": "volume", "order": 1}, {"kind": "integral_invariant", "order": 2}, {"kind": "symmetry"},
                  {"kind": "fundamental_brackets"}, {**CANONICAL, "scale": "1"}):  # fmt: skip
        assert answer(claim, **given) == "not shown"


def test_what_a_map_gives_is_as_it_is_assumed() -> None:
    assert answer(CANONICAL, "-q**2", "-p/(2*q)", symbols={"Q": "positive"}) == "not shown"
    assert answer(CANONICAL, "-q**2", "-p/(2*q)", symbols={"Q": "negative"}) == "shown"
    definitions = {"definitions": {"M": "q + 0*Q"}}
    assert answer(CANONICAL, "M", "p", **definitions) == "not shown"


def test_it_is_asked_of_a_certificate() -> None:
    space = '[phase_space]\nq = ["q"]\np = ["p"]\nQ = ["Q"]\nP = ["P"]\n'
    text = space + '[transformation]\nQ = ["abs(q)"]\nP = ["p*sign(q)"]\n'
    data = certified(text, "kind = 'canonical'")
    assert alone_together.checked(data) == ("shown", "")
    data["tables"]["transformation"]["P"] = ["p"]
    assert alone_together.checked(resealed(data))[0] == "not shown"
    assert alone.checked(data)[0] != "shown"
