"""What a flow's derivative is measured in: tangent vectors at a state, and the structure that the flow keeps there.

In canonical variables it is the bracket J; of rigid bodies the Lie–Poisson bracket, in turns of the body and changes of
M; on a constraint surface the form Σ dp∧dq, restricted to it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from canon.numeric.constraint_tangents import tangents
from canon.numeric.integrators.constrained import Held
from canon.numeric.observe import observe
from canon.scenes.model import Model


@dataclass(frozen=True)
class Frame:
    """Tangent vectors, the columns of `basis` (N, d); their `dual` (d, N); the `structure` (d, d) of these coordinates,
    their brackets, or the `form`.

    `density` is that of phase volume.
    """

    basis: np.ndarray
    dual: np.ndarray
    structure: np.ndarray
    form: bool = False
    density: float = 1.0


def carried(before: Frame, after: Frame, T: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """What a map with the derivative T (d, d) makes of the structure, and what it should be: T B Tᵀ and B of brackets,
    Tᵀ ω T and ω of forms.
    """
    if before.form:
        return T.T @ after.structure @ T, before.structure
    return T @ before.structure @ T.T, after.structure


def frame_on_surface(problem: Held, state: np.ndarray, t: float) -> Frame:
    """The frame at a state on a constraint surface."""
    n = len(state) // 2
    basis = tangents(problem, state[:n], state[n:], t)
    form = basis[n:].T @ basis[:n] - basis[:n].T @ basis[n:]
    return Frame(basis, basis.T, form, True, float(np.sqrt(abs(np.linalg.det(form)))))


def frame_at(model: Model, state: np.ndarray) -> Frame:
    """The frame at a state (N,), q before p."""
    if model.gliders:
        return _without_structure(model, state)
    if not model.rigid:
        n = model.n
        J = np.block([[np.zeros((n, n)), np.eye(n)], [-np.eye(n), np.zeros((n, n))]])
        return Frame(np.eye(2 * n), np.eye(2 * n), J)
    first = len(model.q)
    count = len(model.rigid)
    turning = first > 0
    size = 3 * count * (2 if turning else 1)
    basis, dual = np.zeros((len(state), size)), np.zeros((size, len(state)))
    bracket = np.zeros((size, size))
    for k in range(count):
        M = slice(first + 3 * k, first + 3 * k + 3)
        own = slice(size - 3 * count + 3 * k, size - 3 * count + 3 * k + 3)
        basis[M, own] = dual[own, M] = np.eye(3)
        bracket[own, own] = -_crossing(state[M])
        if turning:
            a, turn = slice(4 * k, 4 * k + 4), slice(3 * k, 3 * k + 3)
            turns = _turns(state[a])
            basis[a, turn], dual[turn, a] = turns / 2, 2 * turns.T
            bracket[turn, own], bracket[own, turn] = np.eye(3), -np.eye(3)
    return Frame(basis, dual, bracket)


def _without_structure(model: Model, state: np.ndarray) -> Frame:
    """The brackets of bodies on skates, which no flow keeps in general; phase volume is that of all variables."""
    symbols = (*model.q, *model.p)
    place = {symbol: k for k, symbol in enumerate(symbols)}
    n, size = len(model.q), len(state)
    bracket = np.zeros((size, size))
    values = observe(
        [value for _, _, value in model.brackets],
        (model.q, model.p, model.t),
        np.zeros(1),
        state[None, :n],
        state[None, n:],
    )[:, 0]
    for (u, v, _), value in zip(model.brackets, values, strict=True):
        bracket[place[u], place[v]], bracket[place[v], place[u]] = value, -value
    return Frame(np.eye(size), np.eye(size), bracket)


def _crossing(v: np.ndarray) -> np.ndarray:
    """The matrix ε_ijk v_k."""
    return np.array([[0, v[2], -v[1]], [-v[2], 0, v[0]], [v[1], -v[0], 0]])


def _turns(a: np.ndarray) -> np.ndarray:
    """The quaternions a e_i as columns."""
    w, x, y, z = a
    return np.array([[-x, -y, -z], [w, -z, y], [z, w, -x], [-y, x, w]])


def onto_attitudes(model: Model, points: np.ndarray) -> np.ndarray:
    """Phase points (…, N) with the quaternions of rigid bodies made unit ones."""
    placed = points.copy()
    for k in range(len(model.q) // 4 if model.rigid else 0):
        part = placed[..., 4 * k : 4 * k + 4]
        part /= np.linalg.norm(part, axis=-1, keepdims=True)
    return placed


def canonical(model: Model, points: np.ndarray) -> np.ndarray:
    """Phase points (…, N) in variables whose Σ p dq is the invariant form: for a rigid body p = 2 a M, in quaternions,
    since then p·ȧ = M·ω.
    """
    n = len(model.q)
    if model.gliders:
        return _with_momenta(model, points)
    if not model.rigid:
        return points
    momenta = []
    for k in range(n // 4):
        w, x, y, z = np.moveaxis(points[..., 4 * k : 4 * k + 4], -1, 0)
        one, two, three = np.moveaxis(points[..., n + 3 * k : n + 3 * k + 3], -1, 0)
        momenta += [
            -x * one - y * two - z * three,
            w * one - z * two + y * three,
            z * one + w * two - x * three,
            -y * one + x * two + w * three,
        ]
    return np.concatenate([points[..., :n], 2 * np.stack(momenta, axis=-1)], axis=-1)


def _with_momenta(model: Model, points: np.ndarray) -> np.ndarray:
    """The same with m v in place of the momentum along a heading."""
    n = len(model.q)
    q, p = points[..., :n], points[..., n:]
    along = {glider.P: glider for glider in model.gliders}
    columns = []
    for k, symbol in enumerate(model.p):
        glider = along.get(symbol)
        if glider is None:
            columns.append(p[..., k])
        else:
            heading = q[..., model.q.index(glider.heading)]
            columns += [p[..., k] * np.cos(heading), p[..., k] * np.sin(heading)]
    return np.concatenate([q, np.stack(columns, axis=-1)], axis=-1)
