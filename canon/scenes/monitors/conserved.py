"""Monitors that are functions of the state: energy, momentum, angular momentum, the Laplace–Runge–Lenz vector.

For each the Poisson bracket with every effect's term says which effects break it; the brackets are looked at in numbers
at states of the orbit and beside it, so that a bracket that vanishes is told from one that doesn't without algebra.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
import sympy as sp

from canon.numeric.gradient import gradient
from canon.numeric.observe import observe
from canon.scenes.model import Formula, Model
from canon.scenes.monitors.flow import Flow
from canon.scenes.monitors.reading import Reading, judged, plain

NEGLIGIBLE: Final = 1e-9
"""A bracket below this part of its terms' sizes is taken to be zero."""
LOOKS: Final = 12
SAFETY: Final = 20.0


def read_conserved(
    name: str, quantities: Mapping[str, Formula], flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray
) -> Reading:
    """The reading of the quantities (all components of one monitor)."""
    model = flow.model
    symbols = (model.q, model.p, model.t)
    values = observe(tuple(quantities.values()), symbols, times, q, p)
    breaking = breakers(tuple(quantities.values()), model, q, p)
    drifts = np.abs(values - values[:, :1])
    drift = float(np.sqrt((drifts**2).sum(axis=0)).max())
    expected = "conserved" if not breaking else f"broken by {', '.join(breaking)}"
    bound = None if breaking else drift_bound(tuple(quantities.values()), flow, times, q, p, values)
    return judged(name, expected, plain(values[:, 0]), plain(values[:, -1]), drift, bound)


def breakers(quantities: Sequence[Formula], model: Model, q: np.ndarray, p: np.ndarray) -> tuple[str, ...]:
    """The effects that change one of the quantities.

    An effect that depends on time breaks the energy by its partial derivative; the energy's bracket with the terms
    vanishes as a whole.
    """
    found: list[str] = []
    for quantity in quantities:
        energy = quantity == model.H
        for effect in model.effects:
            own = sp.Add(*(term.expr for term in model.terms if term.effect == effect))
            terms = [own.diff(model.t)] if energy else model.bracket_terms(quantity, own)
            if not energy and quantity.has(model.t) and effect == model.effects[0]:
                terms.append(quantity.diff(model.t))
            for friction in model.frictions:
                if friction.effect == effect:
                    terms += [quantity.diff(y) * F for y, F in zip(model.p, friction.force, strict=True)]
            for held, g in model.constraints:
                if held == effect:
                    # its reaction is along ∂g/∂q, and a surface that moves does work
                    pulls = zip(model.q, model.p, strict=not model.beside)
                    terms += [g.diff(model.t)] if energy else [quantity.diff(y) * g.diff(x) for x, y in pulls]
            if not _vanishes(terms, model, q, p):
                found.append(effect)
    broken = tuple(dict.fromkeys(found))
    total = sp.Add(*(term.expr for term in model.terms))
    if broken and not model.frictions and not model.constraints and all(q_ != model.H for q_ in quantities):
        # terms may break it one by one and keep it together, as kinetic energy and a frame's rotation do
        whole = [[*model.bracket_terms(x, total), x.diff(model.t)] for x in quantities]
        if all(_vanishes(terms, model, q, p) for terms in whole):
            return ()
    return broken if all(x == model.H for x in quantities) else _without_pair(broken, quantities, model, q, p)


def _without_pair(
    broken: tuple[str, ...], quantities: Sequence[Formula], model: Model, q: np.ndarray, p: np.ndarray
) -> tuple[str, ...]:
    """The same less two effects that keep together what each breaks, as kinetic energy and 1/r keep the LRL vector."""
    # what frictions and constraints do is in no term of H: two of them would seem to keep anything
    besides = {friction.effect for friction in model.frictions} | {held for held, _ in model.constraints}
    for other in broken[1:]:
        both = sp.Add(*(term.expr for term in model.terms if term.effect in (broken[0], other)))
        if not besides & {broken[0], other} and all(
            _vanishes(model.bracket_terms(x, both), model, q, p) for x in quantities
        ):
            return tuple(effect for effect in broken if effect not in (broken[0], other))
    return broken


def _vanishes(terms: Sequence[Formula], model: Model, q: np.ndarray, p: np.ndarray) -> bool:
    """Whether Σ terms is zero, by its size beside those of its terms at states near the orbit."""
    parts = [part for term in terms for part in sp.Add.make_args(sp.expand(term)) if part != 0]
    if not parts:
        return True
    random = np.random.default_rng(0)
    rows = random.integers(0, len(q), LOOKS)
    shake = [1 + 0.1 * random.standard_normal(x.shape) for x in (q[rows], p[rows])]
    sizes = [max(float(np.abs(x).max(initial=0.0)), 1e-300) for x in (q, p)]
    near = [
        x[rows] * s + 0.1 * size * random.standard_normal(s.shape)
        for x, s, size in zip((q, p), shake, sizes, strict=True)
    ]
    times = random.uniform(0.1, 1.9, LOOKS)
    values = observe(parts, (model.q, model.p, model.t), times, *near)
    good = np.isfinite(values).all(axis=0)
    return bool(np.all(np.abs(values.sum(axis=0))[good] <= NEGLIGIBLE * np.abs(values).sum(axis=0)[good]))


def drift_bound(
    quantities: Sequence[Formula], flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray, values: np.ndarray
) -> float | None:
    """How far conserved quantities may be off: what the estimated error of the states makes of them, and rounding."""
    if flow.error is None:
        return None
    model = flow.model
    off = [flow.error * float(np.abs(x).max(initial=0.0)) for x in (q, p)]
    total = 0.0
    for quantity in quantities:
        slopes = observe(gradient(quantity, (*model.q, *model.p)), (model.q, model.p, model.t), times, q, p)
        n = model.n
        moved = np.abs(slopes[:n]).sum(axis=0) * off[0] + np.abs(slopes[n:]).sum(axis=0) * off[1]
        parts = observe(sp.Add.make_args(sp.expand(quantity)), (model.q, model.p, model.t), times, q, p)
        total += float(moved.max() + np.abs(parts).sum(axis=0).max() * 1e-15 * np.sqrt(max(flow.steps, 1)))
    return SAFETY * total
