"""Identities with known truth, most of them traps: branches, boxes, integers, arbitrary and special functions.

Each is stated as a claim file states it. What is only `supported` is listed as such, so that an improvement shows.
"""

import pytest

from canon.claims.reader import read_text
from canon.claims.verify import verify

# symbols and what is known of them; where; left; right; verdict
IDENTITIES = [
    ("x: real, n: integer positive", "", "abs(x)**n", "x**n", "refuted"),
    ("n: integer positive", "", "cos(n*pi)**2", "1", "proved"),
    ("n: integer", "", "(-1)**(2*n)", "1", "proved"),
    ("n: integer", "", "cos(n*pi)", "(-1)**n", "proved"),
    ("n: integer", "", "sqrt(5+4*cos(n*pi))", "2+cos(n*pi)", "supported"),
    ("n: integer, x: real", "", "sin(x+2*pi*n)", "sin(x)", "proved"),
    ("n: integer, x: real", "", "sin(x+pi*n)", "sin(x)", "refuted"),
    ("x: real", "pi/2 < x < 3*pi/2", "asin(sin(x))", "pi-x", "proved"),
    ("x: real", "pi/2 < x < 2*pi", "asin(sin(x))", "pi-x", "refuted"),
    ("x: real", "0 < x < pi", "acos(cos(x))", "x", "proved"),
    ("x: real", "0 < x < 3.2", "acos(cos(x))", "x", "refuted"),
    ("x: real", "-pi < x < 0", "acos(cos(x))", "-x", "proved"),
    ("x: real", "1 < x < 2", "sqrt((x-1)**2)", "x-1", "proved"),
    ("x: real", "x > 1/2", "sqrt((x-1)**2)", "x-1", "refuted"),
    ("x: nonzero", "-1<x; x<1e-9", "atan(1/x)+atan(x)", "-pi/2", "refuted"),  # beyond 0 it is pi/2
    ("x: nonzero", "-1<x; x<1e-9", "sign(x)", "-1", "refuted"),
    ("x: nonzero", "-1<x; x<1e-9", "x*sqrt(1/x**2)", "-1", "refuted"),
    ("x: nonzero", "-1<x; x<1", "atan(1/x)+atan(x)", "-pi/2", "refuted"),
    ("x: nonzero", "", "atan(1/x)+atan(x)", "sign(x)*pi/2", "proved"),
    ("x: real", "0<x<pi", "2*atan(sqrt((1-cos(x))/(1+cos(x))))", "x", "proved"),
    ("x: real", "pi<x<2*pi", "2*atan(sqrt((1-cos(x))/(1+cos(x))))", "2*pi-x", "proved"),
    ("x: real", "-1/1000<x<pi", "2*atan(sqrt((1-cos(x))/(1+cos(x))))", "x", "refuted"),
    (
        "x: real, e: real",
        "0<x<pi; 0<e<1",
        "acos((cos(x)-e)/(1-e*cos(x)))",
        "2*atan(sqrt((1+e)/(1-e))*tan(x/2))",
        "proved",
    ),
    (
        "x: real, e: real",
        "0<x<3.2; 0<e<1",
        "acos((cos(x)-e)/(1-e*cos(x)))",
        "2*atan(sqrt((1+e)/(1-e))*tan(x/2))",
        "refuted",
    ),
    ("x: real", "0<x<pi/2", "elliptic_e(x,1)", "sin(x)", "proved"),
    ("x: real", "0<x<pi/2", "elliptic_f(x,1)", "asinh(tan(x))", "proved"),
    ("x: real, m: positive", "m<1", "elliptic_f(x+pi,m)", "elliptic_f(x,m)+2*elliptic_k(m)", "proved"),
    ("x: real, m: positive", "m<1", "elliptic_f(x+pi,m)", "elliptic_f(x,m)+elliptic_k(m)", "refuted"),
    ("x: real, m: positive", "m<1", "elliptic_e(3*pi-x,m)", "6*elliptic_e(m)-elliptic_e(x,m)", "proved"),
    ("x: real, y: real", "0<x<1; -1<y<1", "abs(x-y)", "x-y", "refuted"),
    ("x: real, y: real", "0<x<1; -1e-9<y<1", "abs(x+y)", "x+y", "refuted"),
    ("x: real, y: real", "1<x<2; -1<y<1", "atan2(y,x)", "atan(y/x)", "proved"),
    ("x: real, y: real", "-2<x<-1; -1<y<1", "atan2(y,x)", "atan(y/x)+pi", "refuted"),
    ("x: real, y: real", "-2<x<-1; 0<y<1", "atan2(y,x)", "atan(y/x)+pi", "proved"),
    ("x: real, y: real", "1<x<2; -1<y<1", "atan2(y,x)-atan2(-y,-x)", "pi", "refuted"),
    ("x: real", "", "atan(x)+atan(1/x)", "pi/2", "refuted"),
    ("x: real", "", "atan(x)+atan(1/x)", "sign(x)*pi/2", "proved"),
    ("x: real", "", "abs(x)", "sqrt(x)**2", "proved"),
    ("x: real", "", "x*abs(x)/x", "abs(x)", "proved"),
    ("x: real", "-1<x<1", "sqrt(x**2)", "x", "refuted"),
    ("x: real", "", "sign(x)", "1", "refuted"),
    ("x: real", "", "log(x**2)", "2*log(x)", "proved"),
    ("x: real", "", "log(x**2)/2", "log(abs(x))", "proved"),
    ("x: real, y: real", "", "log(x*y)", "log(x)+log(y)", "proved"),
    ("x: real, y: real", "-5 < x < 5", "(x**4*y**2+4*x**4*y+4*x**4)**(1/4)", "x*sqrt(abs(y+2))", "refuted"),
    ("x: real, y: real", "", "(x**4*y**2+4*x**4*y+4*x**4)**(1/4)", "abs(x)*sqrt(abs(y+2))", "proved"),
    (
        "x: real, y: real",
        "x > -1/1000",
        "exp(log(x**4*y**2+4*x**4*y+4*x**4)/4+y)",
        "x*sqrt(abs(y+2))*exp(y)",
        "refuted",
    ),
    ("x: real, y: real", "", "sqrt(x*y)", "sqrt(abs(x))*sqrt(abs(y))", "proved"),
    ("V: function, x: real", "", "sqrt(V(x)**2)", "V(x)", "refuted"),
    ("V: function, x: real, y: real", "", "V(sqrt(x**2+y**2))", "V(sqrt((x+1j*y)*(x-1j*y)))", "proved"),
    ("V: function, x: real", "", "V(x)", "V(-x)", "refuted"),
    ("V: function, x: real", "", "V(abs(x))", "V(sqrt(x**2))", "proved"),
    ("V: function, x: real", "", "D(V(x**2),x)", "2*x*D(V(x),x)", "refuted"),
    ("x: real", "", "sqrt(1+sin(2*x))", "abs(sin(x)+cos(x))", "proved"),
    ("x: real", "", "sqrt(1+sin(2*x))", "sin(x)+cos(x)", "refuted"),
    ("x: real", "", "sqrt((1+cos(x))/2)", "cos(x/2)", "refuted"),
    ("x: real", "-pi<x<pi", "sqrt((1+cos(x))/2)", "cos(x/2)", "proved"),
    ("x: real", "", "tan(x/2)", "sin(x)/(1+cos(x))", "proved"),
    ("x: real", "", "tan(x/2)", "(1-cos(x))/sin(x)", "proved"),
    ("x: real", "", "asinh(x)", "log(x+sqrt(x**2+1))", "proved"),
    ("x: real", "", "acosh(x)", "log(x+sqrt(x**2-1))", "proved"),
    ("x: real", "", "atanh(x)", "log((1+x)/(1-x))/2", "proved"),
    ("x: real", "", "acosh(cosh(x))", "x", "refuted"),
    ("x: real", "", "acosh(cosh(x))", "abs(x)", "proved"),
    ("x: positive", "", "acosh(cosh(x))", "x", "proved"),
    ("x: real", "", "asinh(sinh(x))", "x", "proved"),
    ("x: real", "", "atanh(tanh(x))", "x", "proved"),
    ("x: real", "", "cbrt(x)**3", "x", "proved"),
    ("x: real", "x<0", "cbrt(-x)**3", "-x", "proved"),
    ("x: positive", "", "gamma(x+1)", "x*gamma(x)", "proved"),
    ("x: positive", "", "gamma(x)*gamma(1-x)", "pi/sin(pi*x)", "proved"),
    ("x: positive", "", "lambertw(x)*exp(lambertw(x))", "x", "proved"),
    ("u: real, m: real", "", "jacobi_sn(u,m)**2+jacobi_cn(u,m)**2", "1", "proved"),
    ("u: real, m: real", "", "jacobi_dn(u,m)**2+m*jacobi_sn(u,m)**2", "1", "proved"),
    ("z: complex", "", "exp(log(z))", "z", "proved"),
    ("z: complex", "", "log(exp(z))", "z", "refuted"),
    ("z: complex", "", "sqrt(z**2)", "z", "refuted"),
    ("z: complex", "", "sqrt(z)**2", "z", "proved"),
    ("z: complex, w: complex", "", "sqrt(z)*sqrt(w)", "sqrt(z*w)", "refuted"),
    ("z: complex", "", "sin(z)**2+cos(z)**2", "1", "proved"),
    ("x: real, y: real", "", "abs(x+1j*y)**2", "x**2+y**2", "proved"),
    ("x: real", "", "exp(1j*x)", "cos(x)+1j*sin(x)", "proved"),
    ("x: real", "", "log(exp(1j*x))", "1j*x", "refuted"),
    ("x: real", "-3<x<3", "log(exp(1j*x))", "1j*x", "proved"),
    ("x: real", "", "(1+1e-12*sin(x))", "1", "refuted"),
    ("x: real", "1<x<1+1e-9", "x", "x", "proved"),
    ("x: real, y: real", "x**2+y**2<1; x**2+y**2>1-1e-6", "x", "x", "proved"),
    ("x: real", "", "acos(x)+asin(x)", "pi/2", "proved"),
    ("x: real", "", "acos(-x)", "pi-acos(x)", "proved"),
    ("x: real", "", "2*asin(x)", "asin(2*x*sqrt(1-x**2))", "refuted"),
    ("x: real", "-1/2<x<1/2", "2*asin(x)", "asin(2*x*sqrt(1-x**2))", "proved"),
    ("x: real", "-1<x<1", "2*atan(x)", "atan(2*x/(1-x**2))", "proved"),
    ("x: real", "0<x<1", "2*atan(x)", "asin(2*x/(1+x**2))", "proved"),
    ("x: real", "0<x<2", "2*atan(x)", "asin(2*x/(1+x**2))", "refuted"),
    ("x: real, y: real", "0<x<1; 0<y<1", "atan(x)+atan(y)", "atan((x+y)/(1-x*y))", "proved"),
    ("x: real, y: real", "0<x<2; 0<y<2", "atan(x)+atan(y)", "atan((x+y)/(1-x*y))", "refuted"),
    ("x: real", "", "sqrt(5+2*sqrt(6))", "sqrt(2)+sqrt(3)", "proved"),
    ("x: real", "", "sqrt(x+2*sqrt(x-1))", "1+sqrt(x-1)", "proved"),
    ("x: real", "", "sqrt(x-2*sqrt(x-1))", "abs(1-sqrt(x-1))", "proved"),
    ("x: real", "", "sqrt(x-2*sqrt(x-1))", "1-sqrt(x-1)", "refuted"),
    ("x: real", "1<x<2", "sqrt(x-2*sqrt(x-1))", "1-sqrt(x-1)", "proved"),
    ("x: nonnegative", "", "abs(x)", "x", "proved"),
    ("x: negative", "", "abs(x)", "-x", "proved"),
    ("x: negative", "", "sqrt(x**2)", "-x", "proved"),
    ("x: negative, y: negative", "", "sqrt(x*y)", "sqrt(-x)*sqrt(-y)", "proved"),
    ("z: complex", "", "sin(asin(z))", "z", "proved"),
    ("z: complex", "", "tan(atan(z))", "z", "proved"),
    ("z: complex", "", "asin(z)+acos(z)", "pi/2", "proved"),
    ("z: complex", "", "asin(sin(z))", "z", "refuted"),
    ("z: complex", "", "asin(z)+acos(z)", "1001/2000*pi", "refuted"),
    ("n: integer", "", "exp(1j*n*pi)", "(-1)**n", "proved"),
    ("n: integer", "", "exp(2j*n*pi)", "1", "proved"),
    ("n: integer", "", "exp(1j*n*pi)", "1", "refuted"),
    ("n: integer", "", "exp(1j*n*pi/2)**4", "1", "proved"),
    ("n: integer", "", "exp(1j*n*pi/2)**2", "1", "refuted"),
    ("n: integer, k: integer", "", "exp(1j*pi*n*k)**2", "1", "proved"),
    ("n: integer, k: integer", "", "exp(1j*pi*n/k)**2", "1", "refuted"),
    ("x: real", "x>0", "gamma(2*x)", "2**(2*x-1)*gamma(x)*gamma(x+1/2)/sqrt(pi)", "proved"),
    ("x: real", "x>0", "gamma(2*x)", "2**(2*x-1)*gamma(x)*gamma(x+1/2)/sqrt(pi)*1001/1000", "refuted"),
    ("x: real", "x>0", "gamma(3*x)", "3**(3*x-1/2)*gamma(x)*gamma(x+1/3)*gamma(x+2/3)/(2*pi)", "supported"),
    ("x: real", "", "gamma(1/3)*gamma(2/3)+0*x", "2*pi/sqrt(3)", "proved"),
    ("x: real", "", "gamma(1/4)*gamma(3/4)+0*x", "1001/1000*pi*sqrt(2)", "refuted"),
    (
        "x: real",
        "0<x<1",
        "elliptic_e(x)*elliptic_k(1-x)+elliptic_e(1-x)*elliptic_k(x)-elliptic_k(x)*elliptic_k(1-x)",
        "pi/2",
        "proved",
    ),
    (
        "x: real",
        "0<x<1",
        "elliptic_e(x)*elliptic_k(1-x)+elliptic_e(1-x)*elliptic_k(x)-elliptic_k(x)*elliptic_k(1-x)",
        "1001/2000*pi",
        "refuted",
    ),
    ("x: real", "0<x<1", "elliptic_e(x)+elliptic_e(1-x)", "pi/2", "refuted"),
    ("x: real", "x>-1", "lambertw(x*exp(x))", "x", "proved"),
    ("x: real", "x<-1", "lambertw(x*exp(x))", "x", "refuted"),
    ("x: real", "", "cbrt(sqrt(1+x**2)+x)-cbrt(sqrt(1+x**2)-x)", "2*sinh(asinh(x)/3)", "proved"),
    ("x: real", "", "cbrt(sqrt(1+x**2)+x)-cbrt(sqrt(1+x**2)-x)", "1001/500*sinh(asinh(x)/3)", "refuted"),
    ("x: real", "x>1", "cbrt(x+sqrt(x**2-1))+cbrt(x-sqrt(x**2-1))", "2*cosh(acosh(x)/3)", "proved"),
    ("x: real", "x>1", "cbrt(x+sqrt(x**2-1))-cbrt(x-sqrt(x**2-1))", "2*cosh(acosh(x)/3)", "refuted"),
]


def claim_file(symbols: str, where: str, left: str, right: str) -> str:
    lines = ["[phase_space]", 'q = ["Z1"]', 'p = ["Z2"]', "[symbols]"]
    for entry in symbols.split(", "):
        name, words = entry.split(": ")
        lines.append(f"{name} = [{', '.join(repr(word) for word in words.split())}]")
    if where:
        lines += ["[domain]", f"where = [{', '.join(repr(part) for part in where.split('; '))}]"]
    return "\n".join([*lines, "[[claim]]", 'kind = "identity"', f'lhs = "{left}"', f'rhs = "{right}"'])


@pytest.mark.parametrize(("symbols", "where", "left", "right", "expected"), IDENTITIES)
def test_identity(symbols: str, where: str, left: str, right: str, expected: str):
    reading = read_text(claim_file(symbols, where, left, right))
    assert not reading.problems, reading.problems
    verdict = verify(reading.claims[0], budget=20)
    assert verdict.status == expected, verdict
    if expected == "refuted":
        assert verdict.witness


@pytest.mark.parametrize(
    ("where", "left"),
    [("x > 2; x < 1", "x"), ("", "1/(x - x)"), ("", "sqrt(-1 - x**2)"), ("", "cbrt(2 - sqrt(5))*x")],
)
def test_an_empty_domain_is_no_verdict(where: str, left: str):
    from canon.errors import InputError

    reading = read_text(claim_file("x: real", where, left, left))
    if not reading.problems:
        with pytest.raises(InputError, match=r"empty|undefined"):
            verify(reading.claims[0], budget=20)
