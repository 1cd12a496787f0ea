"""Noether's charges of a scene: which translations, rotations, boosts and shifts of time leave it as it is.

A symmetry with the generator C(q, p, t) has dC/dt = {C, H} + ∂C/∂t = 0. Candidates are the generators of the Galilei
group, H, Σ p, Σ x × p and t Σ p − Σ m x, with what changes the Lagrangian by a total derivative: Σ m x, Σ e x, t, t².
Of a system in coordinates of its own they are H and what is linear in the momenta and at most linear in q. dC/dt is
linear in the coefficients, so the charges are the null space of a matrix of numbers, one row a state near the orbit.
Arnold (1989), Mathematical Methods of Classical Mechanics, § 20; Lévy-Leblond (1971), in Group Theory and its
Applications II.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, Final, NamedTuple

import numpy as np
import sympy as sp

from canon.numeric.observe import observe
from canon.scenes.model import Formula, Model
from canon.scenes.monitors.conserved import drift_bound
from canon.scenes.monitors.flow import Flow
from canon.scenes.monitors.reading import Reading, judged

NEGLIGIBLE: Final = 1e-9
"""A rate below this part of its terms' sizes is taken to be zero."""
CLEAN: Final = 1e-7
"""A coefficient below this part of what it is beside is taken to be zero."""
MOST_BILINEAR: Final = 6
SEED: Final = 0


class Charge(NamedTuple):
    """A conserved quantity: how it is written, which kind of symmetry it belongs to, and its formula."""

    text: str
    symmetry: str
    formula: Formula


class Candidate(NamedTuple):
    """A generator by its `name`; `symmetry` is what it generates, nothing where it only accompanies others."""

    name: str
    symmetry: str
    formula: Formula


def candidates(model: Model) -> list[Candidate]:
    """Of what charges are sought: the simplest first."""
    t, H = model.t, model.H
    found = [Candidate("H", "time", H)]
    found += [Candidate(name, "rotation", M) for name, M in model.angular_momenta.items()]
    for body in model.rigid:
        own = f" of {body.name}" if len(model.rigid) > 1 else ""
        found += [Candidate(f"{M.name}{own}", "rotation in the body", M) for M in body.M]
    found += [Candidate(name, "translation", P) for name, P in model.momenta.items()]
    if model.mass:
        found += _boosts(model)
    elif not model.brackets:
        found += _linear(model)
    return [*found, Candidate("t", "", t), Candidate("t^2", "", t**2)]


def _boosts(model: Model) -> list[Candidate]:
    """t Σ p, Σ m x and Σ e x of bodies, along every axis."""
    found, places = [], dict(zip(model.p, model.q, strict=True))
    mass, charge = (dict(zip(model.p, values, strict=True)) for values in (model.mass, model.charge))
    for name, P in model.momenta.items():
        axis = name.removeprefix("P_")
        own = [y for y in model.p if y in P.free_symbols]
        found.append(Candidate(f"t P_{axis}", "boost", model.t * P))
        found.append(Candidate(f"sum(m {axis})", "", sp.Add(*(mass[y] * places[y] for y in own))))
        if any(charge.values()):
            found.append(Candidate(f"sum(e {axis})", "", sp.Add(*(charge[y] * places[y] for y in own))))
    return found


def _linear(model: Model) -> list[Candidate]:
    """p_i, q_j p_i, t p_i and q_i of a system in coordinates of its own."""
    known = {*model.momenta.values()}
    found = [Candidate(str(y), "translation", y) for y in model.p if y not in known]
    if model.n <= MOST_BILINEAR:
        pairs = [(x, y) for x in model.q for y in model.p]
        found += [Candidate(f"{x} {y}", "linear point map", x * y) for x, y in pairs]
    found += [Candidate(f"t {y}", "boost", model.t * y) for y in model.p]
    return found + [Candidate(str(x), "", x) for x in model.q]


def charges(model: Model, q: np.ndarray, p: np.ndarray, times: np.ndarray) -> list[Charge]:
    """The charges of a model, found in numbers at states near those given, q and p (samples, n).

    **Returns:** independent ones that span all, each with as few candidates as that allows.
    """
    if model.beside:
        return [
            charge._replace(text=f"{charge.text} of the {'rigid bodies' if each[0].rigid else 'bodies'}")
            for each in _shares(model, q, p)
            for charge in charges(*each, times)
        ]
    tried = candidates(model)
    near = _states_near(model, q, p, times, 4 * len(tried) + 8)
    values = observe([each.formula for each in tried], (model.q, model.p, model.t), *near)
    good = np.isfinite(values).all(axis=0)
    kept = _independent(values[:, good])
    tried, values = [tried[k] for k in kept], values[kept]
    # a constraint's reaction is one more thing that must vanish
    blocks = [_conditions(each.formula, model, near) for each in tried]
    good &= np.isfinite([row for each in blocks for block in each for row in block]).all(axis=0)
    span = max(float(np.ptp(times)), 1e-300)
    sizes = np.array([max(np.abs(block).sum(axis=0)[good].max() for block in each) for each in blocks])
    sizes = np.maximum(sizes, np.abs(values[:, good]).max(axis=1) / span)
    matrix = np.array([np.concatenate([block.sum(axis=0)[good] for block in each]) for each in blocks]).T / sizes
    null = _null_space(matrix) / sizes
    units = np.abs(values[:, good]).max(axis=1)
    return [_charge(row, tried) for row in _simplest(null, units)]


def read_charges(flow: Flow, times: np.ndarray, q: np.ndarray, p: np.ndarray) -> Reading:
    """The drift of every charge that the scene has, each beside its own bound: what comes nearest to it counts."""
    model = flow.model
    found = charges(model, q, p, times)
    if not found:
        acting = ", ".join(effect for effect in model.effects if effect not in ("kinetic", "H")) or "H"
        note = "no translation, rotation, boost or shift of time leaves this scene as it is"
        return Reading("charges", f"broken by {acting}", None, None, None, extra={"note": note})
    values = observe([each.formula for each in found], (model.q, model.p, model.t), times, q, p)
    drifts = np.abs(values - values[:, :1]).max(axis=1)
    bounds = [
        drift_bound((each.formula,), flow, times, q, p, row[None]) for each, row in zip(found, values, strict=True)
    ]
    weights = [float(drift) / (bound or 1.0) for drift, bound in zip(drifts, bounds, strict=True)]
    worst = int(np.argmax(weights))
    extra: dict[str, Any] = {
        "charges": [each.text for each in found],
        "symmetries": [each.symmetry for each in found],
        "drifts": [float(drift) for drift in drifts],
        "note": "; ".join(each.text for each in found),
    }
    first, last = ([float(value) for value in values[:, k]] for k in (0, -1))
    return judged("charges", "conserved", first, last, float(drifts[worst]), bounds[worst], **extra)


def _shares(model: Model, q: np.ndarray, p: np.ndarray) -> Iterator[tuple[Model, np.ndarray, np.ndarray]]:
    """The independent parts of a model, each with its states: what each keeps is kept."""
    for each in model.beside:
        yield each, q[:, : len(each.q)], p[:, : len(each.p)]
        q, p = q[:, len(each.q) :], p[:, len(each.p) :]


def _conditions(f: Formula, model: Model, near: tuple[np.ndarray, np.ndarray, np.ndarray]) -> list[np.ndarray]:
    """The terms of df/dt at states (terms, samples), and of each constraint what its reaction changes of f."""
    energy, symbols = f == model.H, (model.q, model.p, model.t)
    terms = [f.diff(model.t)] if energy else [*model.bracket_terms(f, model.H), f.diff(model.t)]
    for friction in model.frictions:
        terms += [f.diff(y) * F for y, F in zip(model.p, friction.force, strict=True)]
    found = [observe([term for term in terms if term != 0] or [sp.S.Zero], symbols, *near)]
    for _, g in model.constraints:
        pulls = zip(model.q, model.p, strict=True)
        parts = [g.diff(model.t)] if energy else [f.diff(y) * g.diff(x) for x, y in pulls]
        found.append(observe(parts, symbols, *near))
    return found


def _states_near(
    model: Model, q: np.ndarray, p: np.ndarray, times: np.ndarray, count: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times and states near the orbit, with no symmetry of their own."""
    random = np.random.default_rng(SEED)
    rows = random.integers(0, len(q), count)
    span = max(float(np.ptp(times)), 1e-300)
    states = []
    for x in (q, p):
        size = float(np.abs(x).max(initial=0.0)) or 1.0
        states.append(x[rows] + 0.2 * size * random.standard_normal((count, x.shape[1])))
    return times[0] + span * random.uniform(0.1, 0.9, count), *states


def _independent(values: np.ndarray) -> list[int]:
    """Of rows of values those that neither a constant nor the ones before make."""
    basis = [np.ones(values.shape[1]) / np.sqrt(values.shape[1])]
    kept = []
    for k, row in enumerate(values):
        rest = row.copy()
        for _ in range(2):
            for each in basis:
                rest = rest - (each @ rest) * each
        size = float(np.linalg.norm(rest))
        if size > CLEAN * float(np.linalg.norm(row)):
            kept.append(k)
            basis.append(rest / size)
    return kept


def _null_space(matrix: np.ndarray) -> np.ndarray:
    """Rows that span the null space of a matrix whose columns are of size 1 at most."""
    _, singular, rows = np.linalg.svd(matrix)
    return rows[int((singular > NEGLIGIBLE * np.sqrt(len(matrix))).sum()) :]


def _simplest(rows: np.ndarray, units: np.ndarray) -> np.ndarray:
    """The reduced echelon form of the rows, in which what is nothing beside the others by its size is 0."""
    rows = rows * units
    place = 0
    for column in range(rows.shape[1]):
        if place == len(rows):
            break
        best = place + int(np.argmax(np.abs(rows[place:, column])))
        if np.abs(rows[best, column]) <= CLEAN * np.abs(rows[place:]).max():
            continue
        rows[[place, best]] = rows[[best, place]]
        rows[place] /= rows[place, column]
        for other in range(len(rows)):
            if other != place:
                rows[other] -= rows[other, column] * rows[place]
        place += 1
    rows = np.where(np.abs(rows) > CLEAN * np.abs(rows).max(axis=1, initial=0.0)[:, None], rows, 0.0) / units
    leading = np.array([row[np.flatnonzero(row)[0]] for row in rows]) if len(rows) else np.ones(0)
    return rows / leading[:, None]


def _charge(row: np.ndarray, tried: Sequence[Candidate]) -> Charge:
    used = [(float(c), each) for c, each in zip(row, tried, strict=True) if c != 0]
    named = next((each.symmetry for _, each in used if each.symmetry), "gauge")
    text = " ".join(_term(c, each.name, first=k == 0) for k, (c, each) in enumerate(used))
    return Charge(text, named, sp.Add(*(_number(c) * each.formula for c, each in used)))


def _term(c: float, name: str, *, first: bool) -> str:
    sign = "" if first and c > 0 else "-" if first else "- " if c < 0 else "+ "
    size = f"{abs(c):.10g}"
    return f"{sign}{name}" if size == "1" else f"{sign}{size} {name}"


def _number(c: float) -> Any:
    """A whole number where it is one to rounding."""
    return sp.Integer(round(c)) if abs(c - round(c)) <= CLEAN * abs(c) else sp.Float(c)
