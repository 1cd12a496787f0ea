"""Picard's iteration: a first-order equation solved by integrating again and again, exactly."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy as sp

from canon.errors import InputError
from canon.expected import instance_of, whole_number
from canon.mechanics.formulas import as_expression

MOST_TERMS = 2000
MOST_STEPS = 1000


def picard(
    rates: Any, variables: Any, time: sp.Symbol, initial: Any, steps: int, *, start: Any = 0
) -> tuple[tuple[Any, ...], ...]:
    """The iterates x₀, x₁, …, of x_{k+1}(t) = x(t₀) + ∫_{t₀}^t f(x_k(τ), τ) dτ, one tuple for each.

    They converge to the solution near t₀ where f is continuous and Lipschitz in x (Arnold, Ordinary Differential
    Equations, § 30).

    **Arguments:** `rates`, f for each of the `variables` (or one of each), polynomials in the variables and in `time`
    with any coefficients free of these; `initial` values; the number of `steps`; `start`, t₀.

    **Returns:** `steps` + 1 tuples of polynomials in `time`, expanded.

    **Raises:** `InputError` for rates that aren't polynomials, other counts, and iterates of more than 2000 terms.
    """
    instance_of(time, sp.Symbol, "time")
    steps = whole_number(steps, "steps", 0, MOST_STEPS)
    fields, names, values = (_listed(part) for part in (rates, variables, initial))
    if not len(fields) == len(names) == len(values):
        raise InputError(f"{len(fields)} rates and {len(values)} values for {len(names)} variables", "rates")
    for f in fields:
        if not f.is_polynomial(*names, time):
            raise InputError(f"{f} is no polynomial in {', '.join(map(str, (*names, time)))}", "rates")
    if any(v.has(time) or v.has(*names) for v in values):
        raise InputError("initial values contain neither time nor the variables", "initial")
    found = [tuple(values)]
    for _ in range(steps):
        images = dict(zip(names, found[-1], strict=True))
        found.append(
            tuple(
                v + _integral(f.subs(images, simultaneous=True), time, start)
                for f, v in zip(fields, values, strict=True)
            )
        )
    return tuple(tuple(sp.expand(x) for x in step) for step in found)


def _integral(f: Any, time: sp.Symbol, start: Any) -> Any:
    polynomial = sp.Poly(f, time)
    if len(polynomial.terms()) > MOST_TERMS:
        raise InputError(f"an iterate has more than {MOST_TERMS} terms: take fewer steps", "steps")
    primitive = polynomial.integrate(time)
    return primitive.as_expr() - primitive.eval(as_expression(start))


def _listed(value: Any) -> list[Any]:
    items: Any = value if isinstance(value, Sequence) and not isinstance(value, (str, bytes)) else [value]
    return [as_expression(item) for item in items]
