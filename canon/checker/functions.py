"""The functions that the checker knows, with their derivatives, and what it says where it knows no further."""

_FALL = "((1 - v)*u - jacobi_epsilon(u, v))"
_TURN = f"(jacobi_dn(u, v)*{_FALL} + v*jacobi_sn(u, v)*jacobi_cn(u, v))/(2*v*(1 - v))"
_SINK = f"(jacobi_sn(u, v)*jacobi_dn(u, v) + jacobi_cn(u, v)*{_FALL})/(2*(1 - v))"
_SWELL = (
    "(jacobi_sn(u, v)*jacobi_cn(u, v)*jacobi_dn(u, v) - (1 - v)*u*jacobi_sn(u, v)**2"
    " - jacobi_epsilon(u, v)*jacobi_cn(u, v)**2)/(2*(1 - v))"
)
_LEAN = "elliptic_e(u, v)/(2*v*(1 - v)) - elliptic_f(u, v)/(2*v) - sin(u)*cos(u)/(2*(1 - v)*sqrt(1 - v*sin(u)**2))"
_ROOT = "sqrt(1 - w*sin(v)**2)"


def _by_n(first: str, second: str, third: str) -> str:
    return f"({second}/(w - u) + {first}/u + (u**2 - w)*{third}/(u*(w - u)))/(2*(u - 1))"


def _by_m(second: str, third: str) -> str:
    return f"({second}/(w - 1) + {third})/(2*(u - w))"


_FULL = ("elliptic_e(w)", "elliptic_pi(u, w)")
_ARC = f"(elliptic_e(v, w) - u*{_ROOT}*sin(v)*cos(v)/(1 - u*sin(v)**2))"
_BEND = f"(elliptic_e(v, w) - w*sin(v)*cos(v)/{_ROOT})"
_THIRD = "elliptic_pi(u, v, w)"
SLOPES = {
    "sin": ["cos(u)"], "cos": ["-sin(u)"], "exp": ["exp(u)"], "log": ["1/u"], "tan": ["1 + tan(u)**2"],
    "cot": ["-1 - cot(u)**2"], "sec": ["sec(u)*tan(u)"], "csc": ["-csc(u)*cot(u)"], "asin": ["1/sqrt(1 - u**2)"],
    "acos": ["-1/sqrt(1 - u**2)"], "atan": ["1/(1 + u**2)"], "atan2": ["v/(u**2 + v**2)", "-u/(u**2 + v**2)"],
    "sinh": ["cosh(u)"], "cosh": ["sinh(u)"], "tanh": ["1 - tanh(u)**2"], "coth": ["1 - coth(u)**2"],
    "asinh": ["1/sqrt(u**2 + 1)"], "acosh": ["1/(sqrt(u - 1)*sqrt(u + 1))"], "atanh": ["1/(1 - u**2)"],
    "abs": ["abs(u)/u"], "sign": ["0"], "lambertw": ["lambertw(u)/(u*(1 + lambertw(u)))"], "gamma": [],
    "elliptic_k": ["elliptic_e(u)/(2*u*(1 - u)) - elliptic_k(u)/(2*u)"],
    "elliptic_e": ["(elliptic_e(u) - elliptic_k(u))/(2*u)"], "elliptic_f": ["1/sqrt(1 - v*sin(u)**2)", _LEAN],
    "elliptic_e/2": ["sqrt(1 - v*sin(u)**2)", "(elliptic_e(u, v) - elliptic_f(u, v))/(2*v)"],
    "elliptic_pi": [rule.replace("w", "v") for rule in (_by_n("elliptic_k(w)", *_FULL), _by_m(*_FULL))],
    "elliptic_pi/3": [
        _by_n("elliptic_f(v, w)", _ARC, _THIRD), f"1/({_ROOT}*(1 - u*sin(v)**2))", _by_m(_BEND, _THIRD),
    ],
    "jacobi_sn": ["jacobi_cn(u, v)*jacobi_dn(u, v)", f"jacobi_cn(u, v)*{_TURN}"],
    "jacobi_cn": ["-jacobi_sn(u, v)*jacobi_dn(u, v)", f"-jacobi_sn(u, v)*{_TURN}"],
    "jacobi_dn": ["-v*jacobi_sn(u, v)*jacobi_cn(u, v)", f"-jacobi_sn(u, v)*{_SINK}"],
    "jacobi_epsilon": ["jacobi_dn(u, v)**2", _SWELL],
}  # fmt: skip
"""The derivatives of the functions by their arguments u, v and w; one that isn't here is not known."""

ARITIES = {name.partition("/")[0]: {len(rules) or 1} for name, rules in SLOPES.items() if "/" not in name}
"""The numbers of arguments with which each function may be called."""
ARITIES |= {"sqrt": {1}, "cbrt": {1}, "bracket": {2}, "D": {2, 3}, "elliptic_e": {1, 2}, "elliptic_pi": {2, 3}}


class Unreadable(ValueError):
    """A certificate, or a formula in it, that isn't what it should be."""


class Unknown(ValueError):
    """Something that the checker has no rule for: it is neither confirmed nor rejected."""


class Rejected(Exception):
    """What the certificate says isn't so."""


class NotZero(Rejected):
    """What the certificate takes for 0 isn't, at a point of the domain."""
