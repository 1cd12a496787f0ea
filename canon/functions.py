"""The functions of the language by name, and their values."""

from __future__ import annotations

from typing import Any, Final

import sympy as sp

from canon.constants import constant, is_constant
from canon.errors import InputError
from canon.measure import check_exponential
from canon.special import EllipticPi, JacobiCN, JacobiDN, JacobiSN
from canon.substitution import QUOTIENTS

FUNCTIONS: Final[dict[str, tuple[Any, tuple[int, ...]]]] = {
    "exp": (sp.exp, (1,)), "log": (sp.log, (1,)), "sin": (sp.sin, (1,)), "cos": (sp.cos, (1,)),
    "tan": (sp.tan, (1,)), "cot": (sp.cot, (1,)), "sec": (sp.sec, (1,)), "csc": (sp.csc, (1,)),
    "asin": (sp.asin, (1,)), "acos": (sp.acos, (1,)), "atan": (sp.atan, (1,)), "atan2": (sp.atan2, (2,)),
    "sinh": (sp.sinh, (1,)), "cosh": (sp.cosh, (1,)), "tanh": (sp.tanh, (1,)), "coth": (sp.coth, (1,)),
    "asinh": (sp.asinh, (1,)), "acosh": (sp.acosh, (1,)), "atanh": (sp.atanh, (1,)),
    "abs": (sp.Abs, (1,)), "sign": (sp.sign, (1,)), "gamma": (sp.gamma, (1,)), "lambertw": (sp.LambertW, (1,)),
    "elliptic_k": (sp.elliptic_k, (1,)), "elliptic_e": (sp.elliptic_e, (1, 2)), "elliptic_f": (sp.elliptic_f, (2,)),
    "elliptic_pi": (EllipticPi, (2, 3)),
    "jacobi_sn": (JacobiSN, (2,)), "jacobi_cn": (JacobiCN, (2,)), "jacobi_dn": (JacobiDN, (2,)),
}  # fmt: skip
"""Each function's class in sympy and the numbers of arguments that it takes."""

_GAMMA_LIMIT: Final = 300


def applied(function: Any, values: list[Any], is_complex: bool, beside_integers: bool = False) -> Any:
    """The value of a function, kept from what sympy would make of arguments that it wasn't written for.

    **Raises:** `InputError` where the value is too large, or where the function isn't analytic in a complex argument.
    """
    if is_complex and function is sp.sign:
        raise InputError("sign is for real arguments only")
    if function is sp.exp:
        check_exponential(values[0])
    if function is sp.gamma and values[0].is_Rational and abs(values[0]) > _GAMMA_LIMIT:
        raise InputError(f"gamma of a number above {_GAMMA_LIMIT}")
    if function is sp.atan2 and values[0].is_zero:
        return sp.Integer(0)
    if beside_integers and function in QUOTIENTS and not is_constant(values):
        over, under = QUOTIENTS[function]
        return over(*values) / under(*values)
    value = constant(function, *values) if is_constant(values) else function(*values)
    if is_complex and function is sp.Abs and value.has(sp.re, sp.im, sp.arg, sp.conjugate):
        raise InputError("abs of this complex expression: write x + 1j*y for its names, with real x and y")
    return value
