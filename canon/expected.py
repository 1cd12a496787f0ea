"""What an argument of a public function has to be: one error for what is something else.

Each **raises** an `InputError` that names the argument, says what was given, and what to give.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import islice
from numbers import Integral, Number, Real
from typing import Any, Final

from canon.errors import NO_NUMBER, InputError

_MADE_BY: Final[Mapping[str, str]] = {
    "PhaseSpace": 'one is made by PhaseSpace("q", "p")',
    "Transformation": "one is made by Transformation(space, Q=..., P=...), or by F.transformation()",
    "GeneratingFunction": "one is made by GeneratingFunction(space, type=2, F=...)",
    "LieAlgebra": 'one is made by LieAlgebra.of(["A", "B"], {"A,B": "B"})',
    "Claim": "one is made by a transformation's .canonical(), by bracket(space, f, g, equals), by read_file(path), ...",
    "Verdict": "one is returned by verify(claim)",
    "ComplexType": "one is ComplexType('A', 2) of canon.mechanics.algebra.complex_type",
    "Symbol": 'one of a phase space is space.symbol("q")',
}
"""Where the values of these types come from."""
MOST_LISTED: Final = 1_000_000
"""A list has no more items: one that comes one by one may have no end."""
_NUMPYS_OWN: Final = (("numpy", "bool"), ("numpy", "bool_"))
"""The type of numpy's True and False, which not everybody who asks here has loaded."""


def shown(value: Any) -> str:
    """A value in an error: its text, where that is short."""
    text = repr(value)
    return text if len(text) <= 80 else f"{text[:60]}… ({type(value).__name__})"


def instance_of(value: Any, kind: type, where: str) -> None:
    """The value is of this type."""
    if not isinstance(value, kind):
        origin = _MADE_BY.get(kind.__name__, "")
        raise InputError(
            f"a {kind.__name__} is expected, not {shown(value)}" + (f": {origin}" if origin else ""), where
        )


def listed(value: Any, what: str, where: str) -> tuple[Any, ...]:
    """A list of `what`, as a tuple; a text, a table and a set, which has no order, are none, nor is what has no end."""
    found: tuple[Any, ...] | None = None
    try:
        if isinstance(value, (str, bytes, Mapping, set, frozenset)):
            pass
        elif hasattr(value, "__len__"):  # matrices of sympy's, too, which have no __iter__
            found = tuple(value)
        elif hasattr(value, "__iter__"):  # not its indexed names, which have an item at every place
            found = tuple(islice(value, MOST_LISTED + 1))
    except TypeError:
        pass
    if found is not None and len(found) <= MOST_LISTED:
        return found
    raise InputError(f"a list of {what} is expected, not {shown(value)}", where)


def table(value: Any, what: str, where: str) -> None:
    """A table (a dict) of `what`."""
    if not isinstance(value, Mapping):
        raise InputError(f"a table of {what} is expected, as {{name: value}}, not {shown(value)}", where)


def whole_number(value: Any, where: str, least: int | None = None, most: int | None = None) -> int:
    """A whole number, no less than `least` and no more than `most`; as Python's own."""
    found: Any = int(value) if isinstance(value, Integral) and not isinstance(value, bool) else None
    if found is None or (least is not None and found < least) or (most is not None and found > most):
        bound = ("" if least is None else f", at least {least}") + ("" if most is None else f", at most {most}")
        raise InputError(f"a whole number is needed{bound}, not {shown(value)}", where)
    return found


def one_of(value: Any, choices: Sequence[str], where: str) -> None:
    """One of these words."""
    if not isinstance(value, str) or value not in choices:
        words = ", ".join(f"'{word}'" for word in choices)
        raise InputError(f"one of {words} is expected, not {shown(value)}", where)


def yes_or_no(value: Any, where: str) -> None:
    """True or False: of anything else the truth is a guess, and an array, or an inequality, has none."""
    if not isinstance(value, bool) and (type(value).__module__, type(value).__name__) not in _NUMPYS_OWN:
        raise InputError(f"True or False is expected, not {shown(value)}", where)


def text(value: Any, where: str) -> None:
    """A text."""
    if not isinstance(value, str):
        raise InputError(f"a text is expected, not {shown(value)}", where)


def finite_number(value: Any, where: str, *, least: float | None = None, nonzero: bool = False) -> None:
    """A real and finite number, no less than `least`, and not 0 where `nonzero` says so."""
    try:
        fits = isinstance(value, Real) and not isinstance(value, bool) and math.isfinite(value)
    except OverflowError:  # a whole number beyond the largest float
        fits = False
    if not fits or (least is not None and value < least) or (nonzero and value == 0):
        bound = (f", at least {least:g}" if least is not None else "") + (" other than 0" if nonzero else "")
        raise InputError(f"a finite number{bound} is needed, not {shown(value)}", where)


def function(value: Any, what: str, where: str) -> None:
    """A function, to be called."""
    if not callable(value):
        raise InputError(f"{what} is a function, not {shown(value)}", where)


def formula_of(value: Any, where: str) -> Any:
    """The formula of sympy's that a value stands for: an expression, or a number."""
    import sympy as sp

    found = exact_object(value)
    if not isinstance(found, sp.Expr):
        raise InputError(f"a formula of sympy's is expected, not {shown(value)}", where)
    if found.has(sp.nan, sp.oo, -sp.oo, sp.zoo):
        raise InputError(f"a formula with finite values is expected, not {shown(value)}", where)
    return found


def exact_object(value: Any) -> Any:
    """What sympy makes of its own objects and of numbers, as Python, numpy and mpmath have them; None of all else.

    Nothing else may come to `sympify`: it evaluates text as a program of Python's, and with `strict` it still does so
    where the text stands in a tuple, a set or a table.
    """
    import sympy as sp

    if isinstance(value, sp.Basic):
        return None if isinstance(value, sp.Lambda) else value
    if not isinstance(value, Number) or isinstance(value, bool):
        return None
    try:
        return sp.sympify(value, strict=True)
    except (sp.SympifyError, TypeError, ValueError):
        return None


def numbers(value: Any, where: str) -> list[float]:
    """A list of numbers, as floats."""
    found = listed(value, "numbers", where)
    try:
        return [float(x) for x in found]
    except NO_NUMBER as reason:
        raise InputError(f"a list of numbers is expected, not {shown(value)}", where) from reason


def real_array(value: Any, where: str) -> Any:
    """Real numbers as an array of floats, nan among them; of complex ones the imaginary parts would be lost."""
    import numpy as np

    try:
        found = np.asarray(value)
        known = found.dtype.kind in "biuf" or (found.dtype.kind == "O" and all(x is not None for x in found.flat))
        if known and not isinstance(value, (str, bytes)):
            return np.asarray(found, dtype=float)
    except NO_NUMBER:
        pass
    raise InputError(f"real numbers are expected, not {shown(value)}", where)
