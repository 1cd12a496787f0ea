"""Strategies of canonical maps, and of mutants of them that are known not to be canonical.

Each factor is canonical by a theorem: linear symplectic maps, shears by potentials, exchanges, rotations, lifts of
point transformations, action and angle, flows of quadratic Hamiltonians. A mutant has one factor S among them with
S J Sᵀ ≠ J, and then A S B isn't canonical either, A and B being so.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal

import sympy as sp
from hypothesis import strategies as st

from canon.errors import InputError
from canon.expected import function, listed, whole_number
from canon.mechanics.formulas import replaced
from canon.mechanics.phase_space import PhaseSpace, check_space
from canon.mechanics.transformation import Transformation
from canon.testing.strategies import functions, rational, rationals

Images = list[sp.Expr]
Factor = Callable[[st.DrawFn, PhaseSpace], Images]
Kind = Literal["near", "momenta", "coordinates", "sign", "factor", "pair"]
MOST_PARTS: Final = 100
LONGEST: Final = 250
KINDS: Final[tuple[Kind, ...]] = ("near", "momenta", "coordinates", "sign", "factor", "pair")
SIZES: Final[tuple[sp.Rational, ...]] = tuple(rational(1, 10**k) for k in (3, 6, 9))


@dataclass(frozen=True)
class Mutant:
    """A map that isn't canonical.

    **Arguments:** the `transformation`; what was `changed`; the `witness`, a point at which it fails, as a table of
    the variables' values; the `bracket` that the change spoils ("{Q1,P2}"), and the `defect`, by which it is off. Where
    the change is `buried`, these are the factor's own brackets, and those of the map follow from it and the factors
    after it.
    """

    transformation: Transformation
    changed: str
    witness: Mapping[sp.Symbol, sp.Rational]
    bracket: str
    defect: sp.Rational
    buried: bool


def canonical_maps(
    space: PhaseSpace, *, max_factors: int = 3, factors: Sequence[Factor] | None = None
) -> st.SearchStrategy[Transformation]:
    """Maps (q, p) → (Q, P) that are canonical: compositions of `factors`, defined for almost all values.

    A composition that grows too long to be written is cut.
    """
    check_space(space)
    max_factors = whole_number(max_factors, "max_factors", 1, MOST_PARTS)
    chosen = FACTORS if factors is None else listed(factors, "factors", "factors")
    for factor in chosen:
        function(factor, "a factor", "factors")
    if not chosen:
        raise InputError("no factors to compose maps of", "factors")
    return _canonical_maps(space, max_factors, tuple(chosen))


@st.composite
def _canonical_maps(
    draw: st.DrawFn, space: PhaseSpace, max_factors: int, factors: tuple[Factor, ...]
) -> Transformation:
    images: Images = list(space.old)
    for factor in draw(st.lists(st.sampled_from(factors), min_size=1, max_size=max_factors)):
        images = _composed(space, images, factor(draw, space))
    return _transformation(space, images)


@st.composite
def mutants(
    draw: st.DrawFn,
    space: PhaseSpace,
    *,
    max_factors: int = 2,
    kinds: Sequence[Kind] = KINDS,
    sizes: Sequence[sp.Rational] = SIZES,
    buried: bool = True,
) -> Mutant:
    """Canonical maps with one factor spoiled, of these `kinds`: a sign, a factor, an exchanged pair; or by one of the
    `sizes`: a pair's scale ("near"), a momentum that takes up another coordinate ("momenta": {P_i,P_j} ≠ 0), a
    coordinate that takes up another momentum ("coordinates").

    Unless `buried`, the spoiled factor comes last: the map's own bracket is then off by the defect, at every point.
    """
    before = draw(st.lists(st.sampled_from(POLYNOMIAL), max_size=max_factors))
    after = draw(st.lists(st.sampled_from(POLYNOMIAL), max_size=max_factors)) if buried else []
    images: Images = list(space.old)
    for factor in before:
        images = _composed(space, images, factor(draw, space))
    usable: list[Kind] = [kind for kind in kinds if space.n > 1 or kind not in ("momenta", "coordinates")]
    changed = draw(st.sampled_from(usable))
    spoiled, bracket, defect = draw(_spoiled(space, changed, sizes))
    images = [replaced(f, dict(zip(space.old, images, strict=True))) for f in spoiled]
    for factor in after:
        images = _composed(space, images, factor(draw, space))
    witness = {x: draw(rationals(largest=3)) for x in (*space.old, *space.parameters)}
    return Mutant(_transformation(space, images), changed, witness, bracket, defect, bool(after))


@st.composite
def _spoiled(
    draw: st.DrawFn, space: PhaseSpace, kind: Kind, sizes: Sequence[sp.Rational]
) -> tuple[Images, str, sp.Rational]:
    """A linear map one bracket of which is a wrong constant; that bracket, and by how much it is off."""
    f: Images = list(space.old)
    n, k = space.n, draw(st.integers(0, space.n - 1))
    own = f"{{Q{k + 1},P{k + 1}}}"
    off: sp.Rational = draw(st.sampled_from(list(sizes))) * draw(st.sampled_from((1, -1)))
    if kind in ("momenta", "coordinates"):
        i, j = sorted(draw(st.permutations(range(n)))[:2])
        letter, side, other = ("P", n, 0) if kind == "momenta" else ("Q", 0, n)
        f[side + i] += (off if kind == "momenta" else -off) * f[other + j]
        return f, f"{{{letter}{i + 1},{letter}{j + 1}}}", off
    if kind == "pair":
        f[k], f[k + n] = f[k + n], f[k]
        return f, own, rational(-2)
    spoiled = draw(st.sampled_from((k, k + n)))
    factor: Any = -1 if kind == "sign" else 1 + off if kind == "near" else draw(rationals().filter(lambda c: c != 1))
    f[spoiled] = factor * f[spoiled]
    return f, own, rational(factor - 1)


def _transformation(space: PhaseSpace, images: Images) -> Transformation:
    return Transformation(space, Q=images[: space.n], P=images[space.n :])


def _composed(space: PhaseSpace, first: Images, second: Images) -> Images:
    """`second` after `first`, or `first` alone where that would be too long."""
    composed = [replaced(f, dict(zip(space.old, first, strict=True))) for f in second]
    return composed if sum(sp.count_ops(f) for f in composed) <= LONGEST else first


# -- factors -----------------------------------------------------------------------------------------


def kick(draw: st.DrawFn, space: PhaseSpace) -> Images:
    """p → p − ∂V/∂q."""
    V = draw(functions(space.q))
    return [*space.q, *(p - V.diff(q) for q, p in zip(space.q, space.p, strict=True))]


def drift(draw: st.DrawFn, space: PhaseSpace) -> Images:
    """q → q + ∂T/∂p."""
    T = draw(functions(space.p))
    return [*(q + T.diff(p) for q, p in zip(space.q, space.p, strict=True)), *space.p]


def polynomial_kick(draw: st.DrawFn, space: PhaseSpace) -> Images:
    """p → p − ∂V/∂q with a polynomial V."""
    V = draw(functions(space.q, transcendental=False))
    return [*space.q, *(p - V.diff(q) for q, p in zip(space.q, space.p, strict=True))]


def linear(draw: st.DrawFn, space: PhaseSpace) -> Images:
    """q → A q, p → A⁻ᵀ p with a random triangular A."""
    n = space.n
    A = sp.Matrix(n, n, lambda i, j: draw(rationals(largest=3)) if i == j else draw(st.integers(-2, 2)) if i < j else 0)
    q, p = A * sp.Matrix(space.q), A.inv().T * sp.Matrix(space.p)
    return [*q, *p]


def exchange(draw: st.DrawFn, space: PhaseSpace) -> Images:
    """(q, p) → (p, −q) in one degree of freedom."""
    f: Images = list(space.old)
    k = draw(st.integers(0, space.n - 1))
    f[k], f[k + space.n] = f[k + space.n], -f[k]
    return f


def rotation(draw: st.DrawFn, space: PhaseSpace) -> Images:
    """The flow of an oscillator, by an angle that is a number, a parameter, or a function of the energy."""
    f: Images = list(space.old)
    k = draw(st.integers(0, space.n - 1))
    x, y = f[k], f[k + space.n]
    angles = [draw(rationals()), x**2 + y**2, *space.parameters]
    angle = draw(st.sampled_from(angles))
    f[k], f[k + space.n] = sp.cos(angle) * x + sp.sin(angle) * y, sp.cos(angle) * y - sp.sin(angle) * x
    return f


def hyperbolic(draw: st.DrawFn, space: PhaseSpace) -> Images:
    """The flow of q·p, a squeeze, by a number or a parameter."""
    f: Images = list(space.old)
    k = draw(st.integers(0, space.n - 1))
    s = draw(st.sampled_from([draw(rationals(largest=2)), *space.parameters]))
    f[k], f[k + space.n] = sp.exp(s) * f[k], sp.exp(-s) * f[k + space.n]
    return f


def point(draw: st.DrawFn, space: PhaseSpace) -> Images:
    """q → f(q), p → p/f′(q) with an increasing f."""
    f: Images = list(space.old)
    k = draw(st.integers(0, space.n - 1))
    x = f[k]
    image = draw(st.sampled_from((sp.exp(x), sp.sinh(x), x**3 + x, sp.atan(x), sp.log(1 + sp.exp(x)))))
    f[k], f[k + space.n] = image, f[k + space.n] / image.diff(space.q[k])
    return f


def action(draw: st.DrawFn, space: PhaseSpace) -> Images:
    """(q, p) → (atan2(q, p), (q² + p²)/2): the oscillator's angle and action."""
    f: Images = list(space.old)
    k = draw(st.integers(0, space.n - 1))
    q, p = f[k], f[k + space.n]
    f[k], f[k + space.n] = sp.atan2(q, p), (q**2 + p**2) / 2
    return f


def polar(draw: st.DrawFn, space: PhaseSpace) -> Images:
    """Polar coordinates of a plane; where there is one degree of freedom only, its angle and action."""
    if space.n < 2:
        return action(draw, space)
    f: Images = list(space.old)
    i, j = draw(st.permutations(range(space.n)))[:2]
    x, y, u, v = f[i], f[j], f[i + space.n], f[j + space.n]
    r = sp.sqrt(x**2 + y**2)
    f[i], f[j], f[i + space.n], f[j + space.n] = r, sp.atan2(y, x), (x * u + y * v) / r, x * v - y * u
    return f


POLYNOMIAL: tuple[Factor, ...] = (polynomial_kick, linear, exchange)
FACTORS: tuple[Factor, ...] = (kick, drift, linear, exchange, rotation, hyperbolic, point, action, polar)
