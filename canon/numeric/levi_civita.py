"""Coordinates in which Kepler's collision is no singularity: x = u² on a line, Levi-Civita's in a plane, and in space
the four of Kustaanheimo and Stiefel.

With r = |u|², 4 r |p|² = |w|² and time as a coordinate beside −H = b, the Hamiltonian of motion in a time s with
dt = r ds is r (H + b), which of H = p²/2m − k/r + V(x) is

    K = |w|²/8m + |u|² (b + V(x(u))) − k.

It is T(p) + V(q) with a quadratic T: b is a coordinate that stays, and −t its momentum, on which the force −|u|² acts.
So every method for such Hamiltonians solves it; without V it is an oscillator, whatever the eccentricity.

Levi-Civita (1920), Acta Math. 42, 99; Kustaanheimo and Stiefel (1965), J. reine angew. Math. 218, 204; Stiefel and
Scheifele (1971), Linear and Regular Celestial Mechanics. The claims are in the catalogue, transformations/levi-civita
and transformations/kustaanheimo-stiefel.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal, localcontext
from typing import Any, Final

import numpy as np
import sympy as sp

from canon.errors import InputError
from canon.numeric.integrators.problem import Splitting, State
from canon.numeric.shears import Parameters, shear
from canon.numeric.split_hamiltonian import split_hamiltonian

DIGITS: Final = 25
"""Decimal digits of V in a state's energy, which the sum has twice as many of."""
DISTANCE: Final = sp.Dummy("r", positive=True)
"""Stands for the distance while a formula is taken apart."""
Formula = Any
"""A sympy expression: its operations have no useful types."""
Vector = Sequence[float] | np.ndarray


@dataclass(frozen=True)
class Regularised:
    """`K`(u, b; w, −t) of H(q, p[, t]), and the `problem` of its motion, on slots (u…, b) and (w…, −t).

    The time of a state is `t0` − its last momentum. `rest` is V(q, t), a formula of `place`, `mass` and `strength`
    are m and k; on a line x keeps the `sign`.
    """

    rest: sp.Expr
    K: sp.Expr
    coordinates: tuple[sp.Symbol, ...]
    momenta: tuple[sp.Symbol, ...]
    problem: Splitting
    mass: float
    strength: float
    t0: float
    sign: float
    place: tuple[sp.Symbol, ...]

    def state(self, q: Vector, p: Vector) -> State:
        """(u, b) and (w, 0) of the positions and momenta (d,) at t0, with the energy of just these numbers.

        **Raises:** `InputError` at the centre, where the direction of motion has no meaning in (q, p), and on the other
        side of it than the one for which the problem was made; so far away that u is beyond double precision.
        """
        x, y = np.asarray(q, dtype=float), np.asarray(p, dtype=float)
        if not 0 < np.hypot.reduce(x) < np.inf or (len(x) == 1 and x[0] * self.sign < 0):
            raise InputError(f"the motion begins at {x}, which is no place that has these coordinates")
        with np.errstate(over="ignore", invalid="ignore"):
            u = preimage(x * self.sign)
            w = 2 * matrix(u).T @ (y * self.sign)
        if not np.all(np.isfinite([*u, *w])):
            raise InputError(f"the motion begins at {x}, of which these coordinates are beyond double precision")
        b = -self.energy(x, y)
        return np.array([*u, b]), np.array([*w, 0.0])

    def energy(self, q: np.ndarray, p: np.ndarray) -> float:
        """H of just these numbers at t0, in `DIGITS`: near the centre it is the difference of larger ones.

        **Raises:** `InputError` where V has no value there.
        """
        if self.rest == 0:
            V = Decimal(0)
        else:
            exact: dict[Any, Any] = dict(zip(self.place, map(sp.Rational, map(float, [*q, *p, self.t0])), strict=False))
            value = self.rest.evalf(DIGITS, subs=exact)
            if not (value.is_real and value.is_finite):
                raise InputError(f"the Hamiltonian has no value at the beginning: its potential is {value}")
            V = Decimal(str(value))
        with localcontext() as context:
            context.prec = 2 * DIGITS
            r = sum((Decimal(float(x)) ** 2 for x in q), Decimal(0)).sqrt()
            square = sum((Decimal(float(y)) ** 2 for y in p), Decimal(0))
            return float(square / (2 * Decimal(self.mass)) - Decimal(self.strength) / r + V)

    def shown(self, states: State) -> tuple[np.ndarray, np.ndarray]:
        """Positions (…, d) and momenta (…, d) of states (…, n)."""
        coordinates, momenta = (np.asarray(slot) for slot in states)
        u, w = coordinates[..., :-1], momenta[..., :-1]
        L = matrix(np.moveaxis(u, -1, 0))
        r = (u**2).sum(axis=-1)[..., None]
        q = np.einsum("ij...,...j->...i", L, u)
        p = np.einsum("ij...,...j->...i", L, w) / (2 * r)
        return self.sign * q, self.sign * p

    def pace(self, b: float, duration: float) -> float:
        """The fictitious time in which the oscillator that the motion is without V turns by an angle of one; near a
        parabola no more than that orbit has in the `duration`.
        """
        slow = np.inf if b == 0 else float(np.sqrt(2 * self.mass / abs(b)))
        return min(slow, float((6 * self.mass * duration / self.strength) ** (1 / 3)))


def matrix(u: Any) -> Any:
    """L(u) (d, n) with x = L u and p = L w/2|u|², of arrays (n, …): n = 1, 2, 4 for d = 1, 2, 3."""
    return np.array(entries(u))


def entries(u: Any) -> list[list[Any]]:
    """The rows of L(u), of whatever numbers u has."""
    if len(u) == 1:
        return [[u[0]]]
    if len(u) == 2:
        return [[u[0], -u[1]], [u[1], u[0]]]
    a, b, c, d = u
    return [[a, -b, -c, d], [b, a, -d, -c], [c, d, a, b]]


def preimage(x: np.ndarray) -> np.ndarray:
    """One u of those with L(u) u = x, without cancellation; of x ≥ 0 on a line."""
    if len(x) == 1:
        return np.sqrt(x)
    r, first = float(np.hypot.reduce(x)), float(x[0])
    large = np.sqrt((r + abs(first)) / 2)
    small = x[1:] / (2 * large)
    if len(x) == 2:
        return np.array([large, small[0]] if first >= 0 else [small[0], large])
    return np.array([large, small[0], small[1], 0.0] if first >= 0 else [small[0], large, 0.0, small[1]])


def regularised(
    H: sp.Expr,
    q: Sequence[sp.Symbol],
    p: Sequence[sp.Symbol],
    t: sp.Symbol | None = None,
    parameters: Parameters | None = None,
    *,
    t0: float = 0.0,
    sign: float = 1.0,
) -> Regularised:
    """H = |p|²/2m − k/|q| + V(q, t) with k > 0 in coordinates in which its collision is no singularity.

    **Arguments:** one, two or three `q` and `p`; `parameters` have values; `t0`, when motions begin; `sign` of q on a
    line, where a motion is thrown back by a collision.

    **Raises:** `InputError` where H is no such Hamiltonian. V may be singular at the centre; then K is.
    """
    if not 1 <= len(q) <= 3 or len(q) != len(p):
        raise InputError(
            f"collisions are removed of one body on a line, in a plane or in space, not of {len(q)} numbers"
        )
    values = {symbol: sp.Float(float(value), precision=53) for symbol, value in (parameters or {}).items()}
    formula: Formula = sp.sympify(H).xreplace(values)
    unknown = formula.free_symbols - {*q, *p, t}
    if unknown:
        raise InputError(f"no value is given for {', '.join(sorted(map(str, unknown)))}")
    mass, strength, rest = _kepler(_with_distance(formula, q), q, p)
    side = math.copysign(1.0, sign) if len(q) == 1 else 1.0
    dimension = 4 if len(q) == 3 else len(q)
    u = tuple(sp.Symbol(f"u{k}", real=True) for k in range(1, dimension + 1))
    w = tuple(sp.Symbol(f"w{k}", real=True) for k in range(1, dimension + 1))
    b, past = sp.Symbol("b", real=True), sp.Symbol("p_b", real=True)
    r: Formula = sum((x**2 for x in u), sp.S.Zero)
    kinetic = sum((y**2 for y in w), sp.S.Zero) / (8 * mass)
    V = _in_squares(rest, q, u, side)
    well = b * r + V
    timed = t is not None and t in V.free_symbols
    if timed:
        well = well.xreplace({t: sp.Float(t0, precision=53) - past})
    K = kinetic + well
    coordinates, momenta = (*u, b), (*w, past)
    if timed:
        found = split_hamiltonian(K, coordinates, momenta)
        problem = next(each for each in found if each.kind.endswith("shears")).splitting()
    else:
        T, W = (shear(part, coordinates, momenta, None, {}, name) for part, name in ((kinetic, "T"), (well, "V")))
        problem = Splitting((T, W), None, True)
    potential: Formula = rest.xreplace({DISTANCE: sp.sqrt(sum((x**2 for x in q), sp.S.Zero))})
    place = (*q, *p) if t is None else (*q, *p, t)
    return Regularised(
        potential, K - strength, coordinates, momenta, problem, float(mass), float(strength), t0, side, place,
    )  # fmt: skip


def _kepler(H: Formula, q: Sequence[sp.Symbol], p: Sequence[sp.Symbol]) -> tuple[Formula, Formula, Formula]:
    """m, k and V of |p|²/2m − k/r + V."""
    H = sp.expand(H)
    inverse: Formula = 2 * H.coeff(p[0], 2)
    kinetic: Formula = sum((y**2 for y in p), sp.S.Zero) * inverse / 2
    rest: Formula = sp.expand(H - kinetic)
    if inverse.free_symbols or not inverse.is_positive or rest.free_symbols & {*p}:
        raise InputError("collisions are removed of H = |p|²/2m − k/r + V(q, t), with nothing else of the momenta")
    pulls = [x for x in sp.Add.make_args(rest) if (x * DISTANCE).is_number]
    strength = -sp.Add(*pulls) * DISTANCE
    if not strength.is_positive:
        raise InputError("collisions are removed of an attraction −k/r with k > 0, and the Hamiltonian has none")
    return 1 / inverse, strength, sp.Add(*(x for x in sp.Add.make_args(rest) if x not in pulls))


def _with_distance(H: Formula, q: Sequence[sp.Symbol]) -> Formula:
    """H with `DISTANCE` where it has |q|, or a power of |q|² times a number."""
    squared: Formula = sum((x**2 for x in q), sp.S.Zero)

    def factor(x: Formula) -> Formula:
        return x.base.coeff(q[0], 2) if isinstance(x, sp.Pow) and isinstance(x.base, sp.Add) else sp.S.Zero

    def is_distance(x: Formula) -> bool:
        c = factor(x)
        return bool(c.is_positive) and sp.expand(x.base - c * squared) == 0

    if len(q) == 1:
        return H.xreplace({sp.Abs(q[0]): DISTANCE})
    return H.replace(is_distance, lambda x: factor(x) ** x.exp * DISTANCE ** (2 * x.exp))


def _in_squares(V: Formula, q: Sequence[sp.Symbol], u: Sequence[sp.Symbol], side: float) -> Formula:
    """|u|² V(x(u)), with |u|² for the distance."""
    L = matrix(np.array(u, dtype=object))
    places = [int(side) * sp.expand(sum(L[i, j] * u[j] for j in range(len(u)))) for i in range(len(q))]
    table = {**dict(zip(q, places, strict=True)), DISTANCE: sum((x**2 for x in u), sp.S.Zero)}
    terms: list[Formula] = [(DISTANCE * term).xreplace(table) for term in sp.Add.make_args(V)]
    return sp.Add(*(sp.expand(term) if term.is_polynomial(*u) else term for term in terms))
