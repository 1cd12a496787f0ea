"""What an audit is of: a function of points with names for their entries, made of formulas if need be."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from canon.errors import NO_NUMBER, InputError
from canon.expected import shown, table
from canon.numeric.lower import lower_map
from canon.numeric.membership import Membership, membership
from canon.numeric.points import DEFAULT, DEFAULT_POSITIVE

if TYPE_CHECKING:
    import sympy as sp

    from canon.mechanics.transformation import Transformation

Array = np.ndarray


@dataclass(frozen=True)
class AuditSubject:
    """A map of points, the names and default ranges of their entries, and the scale that M J Mᵀ = scale J expects.

    A map that is given `backward` has the reciprocal of the `scale` that it is made with, exactly.
    For a map given by formulas: the `transformation`, its `parameters`, the `membership` in its domain; and
    `rounded_numbers` says that the function's numbers are rounded ones of the formulas.
    """

    function: Callable[..., Any]
    names: Sequence[str]
    defaults: Sequence[tuple[float, float]]
    scale: float
    kind: str = ""
    transformation: Transformation | None = None
    parameters: Mapping[sp.Symbol, float] = field(default_factory=dict)
    membership: Membership | None = None
    rounded_numbers: bool = False
    exact_scale: Fraction = field(init=False)
    backward: bool = False

    def __post_init__(self) -> None:
        given = exactly(self.scale)
        object.__setattr__(self, "exact_scale", 1 / given if self.backward else given)
        object.__setattr__(self, "scale", float(self.exact_scale))

    def inside(self, points: Array) -> Array:
        """Which points (N, 2n) satisfy the conditions of the formulas, as far as floats tell."""
        return np.ones(len(points), dtype=bool) if self.membership is None else self.membership(list(points.T))


def exactly(scale: Any) -> Fraction:
    """The number itself, also of one of numpy's."""
    return Fraction(scale) if isinstance(scale, (int, float, Fraction)) else Fraction(float(scale))


def checked_parameters(parameters: Any) -> Mapping[Any, float]:
    """A table of numbers, as floats; **raises** `InputError` for what is none."""
    if parameters is None:
        return {}
    table(parameters, "numbers", "parameters")
    found: dict[Any, float] = {}
    for name, value in parameters.items():
        try:
            found[name] = float(value)
        except NO_NUMBER:
            found[name] = math.nan
        if isinstance(value, str) or not math.isfinite(found[name]):
            raise InputError(f"a finite number is needed, not {shown(value)}", f"parameters, {name}")
    return found


def formulas_as_map(transformation: Transformation, parameters: Mapping[str, float], scale: float) -> AuditSubject:
    """The map of a transformation's formulas at values of its parameters, lowered to jax.

    A backward map is audited as it is written, (q, p) as functions of (Q, P), where the scale is 1/scale.

    **Raises:** `InputError` for an implicit map, a parameter that is unknown or has no value, or a formula that has no
    numerical form.
    """
    if transformation.direction == "implicit":
        raise InputError("an implicit transformation has no formulas to audit: pass its .forward() or .backward()")
    space, arguments = transformation.space, transformation.arguments
    if len(transformation.formulas) != len(arguments):
        raise InputError("a map with as many new variables as old ones is needed")
    known = {symbol.name: symbol for symbol in (*space.parameters, space.t)}
    values: dict[Any, float] = {}
    for name, value in checked_parameters(parameters).items():
        if str(name) not in known:
            near = get_close_matches(str(name), known, 1)
            raise InputError(
                f"{str(name)!r} is no parameter" + (f"; did you mean {near[0]!r}?" if near else ""), "parameters"
            )
        values[known[str(name)]] = value
    usable = {*arguments, *values}
    conditions = dict.fromkeys((*space.domain.conditions, *(c for f in transformation.formulas for c in f.conditions)))
    stated = [
        condition
        for condition in conditions
        if condition.kind in ("positive", "nonzero", "uncut")
        and {symbol for term in condition.terms for symbol in term.free_symbols} <= usable
    ]
    return AuditSubject(
        function=lower_map(transformation.expressions, arguments, values),
        names=tuple(symbol.name for symbol in arguments),
        defaults=[DEFAULT_POSITIVE if symbol.is_positive else DEFAULT for symbol in arguments],
        scale=scale,
        backward=transformation.direction == "backward",
        kind="formulas",
        transformation=transformation,
        parameters=values,
        membership=membership(stated, arguments, values),
        rounded_numbers=True,
    )
