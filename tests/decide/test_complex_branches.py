"""Complex logarithms, roots and inverse functions of real names: branches by signs on convex cells."""

import pytest

from canon.claims.reader import read_text
from canon.claims.verify import verify

# where; left; right; verdict
BRANCHES = [
    ("-3<x<3", "log(exp(1j*x))", "1j*x", "proved"),
    ("-pi<x<pi", "log(exp(1j*x))", "1j*x", "proved"),
    ("-4<x<4", "log(exp(1j*x))", "1j*x", "refuted"),
    ("0<x<pi", "log(exp(2j*x)*-1)", "2j*x-1j*pi", "proved"),
    ("0<x<pi", "log(-exp(2j*x))", "2j*x-1001/1000*1j*pi", "refuted"),
    ("x>0", "log(x+1j*y)", "log(x**2+y**2)/2+1j*atan(y/x)", "proved"),
    ("", "log(x+1j*y)", "log(x**2+y**2)/2+1j*atan2(y,x)", "proved"),
    ("", "log(x+1j*y)", "log(x**2+y**2)/2+1j*atan(y/x)", "refuted"),
    ("-1<x<1", "sqrt(exp(2j*x))", "exp(1j*x)", "proved"),
    ("-2<x<2", "sqrt(exp(2j*x))", "exp(1j*x)", "refuted"),
    ("x>0", "sqrt(x+1j*y)**2", "x+1j*y", "proved"),
    ("x>0", "sqrt((x+1j*y)**2)", "x+1j*y", "proved"),
    ("y>0", "sqrt((x+1j*y)**2)", "x+1j*y", "refuted"),
    ("", "asin(1j*x)", "1j*asinh(x)", "proved"),
    ("-1<x<1", "atan(1j*x)", "1j*atanh(x)", "proved"),
    ("-5<x<-pi", "log(exp(1j*x))", "1j*x+2j*pi", "proved"),
    ("-3*pi<x<-pi", "log(exp(1j*x))", "1j*x+2j*pi", "proved"),
    ("-3*pi<x<0", "log(exp(1j*x))", "1j*x+2j*pi", "refuted"),
    ("-1<x<7", "log(exp(1j*x))", "1j*x", "refuted"),
    ("pi<x<7", "log(exp(1j*x))", "1j*x-2j*pi", "proved"),
    ("x<0", "log(x+1j*y)", "log(x**2+y**2)/2+1j*atan(y/x)", "refuted"),
    ("x<0; y>0", "log(x+1j*y)", "log(x**2+y**2)/2+1j*atan(y/x)+1j*pi", "proved"),
    ("x<0; y<0", "log(x+1j*y)", "log(x**2+y**2)/2+1j*atan(y/x)+1j*pi", "refuted"),
    ("x<0; y<0", "log(x+1j*y)", "log(x**2+y**2)/2+1j*atan(y/x)-1j*pi", "proved"),
    ("x<0", "log(x+1j*y)", "log(-x-1j*y)+1j*pi", "refuted"),
    ("y>0", "log(x+1j*y)", "log(-x-1j*y)+1j*pi", "proved"),
    ("y>0", "log((x+1j*y)**2)", "2*log(x+1j*y)", "refuted"),
    ("x>0", "log((x+1j*y)**2)", "2*log(x+1j*y)", "proved"),
    ("x>0", "log((x+1j*y)**2)", "2*log(x+1j*y)+1j*x/1000", "refuted"),
    ("x>0", "sqrt(x+1j*y)*sqrt(x-1j*y)", "sqrt(x**2+y**2)", "proved"),
    ("", "sqrt(x+1j*y)*sqrt(x-1j*y)", "sqrt(x**2+y**2)", "proved"),
    ("", "sqrt(x+1j*y)**3", "sqrt((x+1j*y)**3)", "refuted"),
    ("x>0; -1/2<y/x<1/2", "sqrt(x+1j*y)**3", "sqrt((x+1j*y)**3)", "supported"),
    ("0<x<1; 0<y<1", "log(exp(1j*x)*exp(1j*y))", "1j*(x+y)", "proved"),
    ("0<x<2; 0<y<2", "log(exp(1j*x)*exp(1j*y))", "1j*(x+y)", "refuted"),
    ("0<x<1", "sqrt(exp(8j*x))", "exp(4j*x)", "refuted"),
    ("", "sqrt(1+exp(1j*x))**2", "1+exp(1j*x)", "proved"),
    ("-3<x<3", "sqrt(1+exp(1j*x))", "sqrt(2*cos(x/2))*exp(1j*x/4)", "supported"),
    ("-6<x<6", "sqrt(1+exp(1j*x))", "sqrt(2*cos(x/2))*exp(1j*x/4)", "supported"),
    ("", "log(1+exp(1j*x))", "log(2*cos(x/2))+1j*x/2", "refuted"),
    ("-pi<x<pi", "log(1+exp(1j*x))", "log(2*cos(x/2))+1j*x/2", "proved"),
    ("", "acosh(cosh(x)+0j*y)", "abs(x)", "proved"),
    ("", "asin(sin(x)+0j)", "x", "refuted"),
    ("x>0", "atan(x+1j*y)+atan(1/(x+1j*y))", "pi/2", "supported"),
    ("", "atan(x+1j*y)+atan(1/(x+1j*y))", "pi/2", "refuted"),
    ("", "sqrt((x+1j*y)**2)", "sign(x)*(x+1j*y)", "proved"),
    ("", "sqrt(-(x+1j*y)**2)", "-1j*(x+1j*y)", "refuted"),
    ("y>0", "sqrt(-(x+1j*y)**2)", "-1j*(x+1j*y)", "proved"),
    ("y<0", "sqrt(-(x+1j*y)**2)", "-1j*(x+1j*y)", "refuted"),
]


@pytest.mark.parametrize(("where", "left", "right", "expected"), BRANCHES)
def test_branch(where, left, right, expected):
    parts = where.split("; ") if where else []
    text = f'[phase_space]\nq = ["x"]\np = ["y"]\n[domain]\nwhere = {parts!r}\n[[claim]]\nkind = "identity"\n'
    (claim,) = read_text(text + f'lhs = "{left}"\nrhs = "{right}"\n').claims
    assert verify(claim, budget=20.0).status == expected
