"""A Hamiltonian H(q, p) of one degree of freedom as a potential and a width.

V(q) = min_p H(q, p), at p = p_0(q), is where the motion turns: at an energy E it is possible where V < E, with the two
momenta p_0 ± s_±(q, E). For H = A p² + B p + C they are −B/2A ± √((E − V)/A), and need no iteration.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Final

import flint
import sympy as sp
from flint import arb

from canon.errors import InputError
from canon.expected import formula_of
from canon.numeric.actions.balls import NOTHING, Ball, BallFunction, ball_function, middle
from canon.numeric.actions.harmonic import harmonic_rate

_DOUBLINGS: Final = 200
_HALVINGS: Final = 40
_NEWTON: Final = 60
_PARTS: Final = 16
"""On the way from the momentum at rest to that of an energy, H is looked at in so many steps."""


@dataclass(frozen=True)
class Profile:
    """H with its potential `V` and p_0 = `centre` as formulas, and all of them as functions of balls.

    `velocity` is ∂H/∂p, and `bend` ∂²H/∂p² at p_0(q).
    `square` is A(q) where H is quadratic in p, else None; `mirrored` says that H(q, p_0 + s) = H(q, p_0 − s);
    `harmonic` is the n of a pendulum's V = c + a cos nq + b sin nq.
    """

    H: Any
    q: sp.Symbol
    p: sp.Symbol
    V: Any
    centre: Any
    mirrored: bool
    potential: BallFunction = field(repr=False)
    slope: BallFunction = field(repr=False)
    curvature: BallFunction = field(repr=False)
    energy: BallFunction = field(repr=False)
    velocity: BallFunction = field(repr=False)
    bend: BallFunction = field(repr=False)
    middle_momentum: BallFunction = field(repr=False)
    square: BallFunction | None = field(repr=False)
    kinks: tuple[BallFunction, ...] = field(repr=False)
    harmonic: BallFunction | None = field(repr=False, default=None)

    def outward(self, q: Ball, E: Ball, side: int) -> tuple[Ball, Ball]:
        """(p, |∂p/∂E|) on the upper branch (`side` 1) or the lower one (−1); not finite where E isn't above V."""
        if self.square is None:
            return self._solved(q, E, side)
        A = self.square(q)
        square = (E - self.potential(q)) / A
        s = (square.nonnegative_part() if square.contains(0) else square).sqrt()
        return self.middle_momentum(q) + side * s, 1 / (2 * A * s)

    def _solved(self, q: Ball, E: Ball, side: int) -> tuple[Ball, Ball]:
        """By halving and Newton's method on the exact middle of q: H − E grows away from p_0."""
        rest = self.middle_momentum(q)
        low, step = middle(rest), arb(side)
        if not self.potential(q) < E:
            return NOTHING, NOTHING
        if self.energy(q, low + step) > E:
            while self.energy(q, low + step / 2) > E and abs(step) > arb(2) ** -flint.ctx.prec:
                step = step / 2
        else:
            for _ in range(_DOUBLINGS):
                if not self.energy(q, low + step) < E:
                    break
                step = 2 * step
        high = low + step
        for _ in range(_HALVINGS):
            half = middle((low + high) / 2)
            low, high = (half, high) if self.energy(q, half) < E else (low, half)
        self._rises(q, rest, middle(low), side)
        return _polished(self, q, E, middle((low + high) / 2))

    def check_rest(self, q: Ball) -> None:
        """**Raises** `InputError` where H is greatest, not least, at the momentum at rest."""
        if self.square is None and self.bend(q) < 0:
            at = f"{self.p} = {float(self.middle_momentum(q)):.6g}, where {self.q} = {float(middle(q)):.6g}"
            raise InputError(f"H = {self.H} is greatest, not least, at {at}", "H")

    def _rises(self, q: Ball, rest: Ball, p: Ball, side: int) -> None:
        """**Raises** `InputError` where H falls somewhere on the way from the momentum at rest to p."""
        for k in range(1, _PARTS):
            between = rest + (p - rest) * k / _PARTS
            if side * self.velocity(q, between) < 0:
                at = f"{self.q} = {float(middle(q)):.6g}, {self.p} = {float(middle(between)):.6g}"
                raise InputError(
                    f"H = {self.H} isn't least at one momentum for each {self.q} and greater the farther away: "
                    f"at {at} it falls",
                    "H",
                )


def _polished(profile: Profile, q: Ball, E: Ball, p: Ball) -> tuple[Ball, Ball]:
    """Newton's method; what is left of H − E, over the velocity, is the radius of p."""
    left = NOTHING
    for _ in range(_NEWTON):
        left = (profile.energy(q, p) - E) / profile.velocity(q, p)
        if not left.is_finite():
            return NOTHING, NOTHING
        if left.contains(0):
            break
        p = middle(p - left)
    return p + arb(0, 2 * left.abs_upper()), 1 / abs(profile.velocity(q, p))


def profile_of(H: Any, q: sp.Symbol, p: sp.Symbol) -> Profile:
    """The profile of a formula. **Raises:** `InputError` where H has no single minimum in p that a formula gives."""
    H = formula_of(H, "H")
    strange = H.free_symbols - {q, p}
    if strange:
        names = ", ".join(sorted(map(str, strange)))
        raise InputError(f"H depends on {names} besides {q} and {p}: give values in `parameters`")
    A, centre = _quadratic(H, q, p)
    if A is None:
        centre = _rest(H, q, p)
    V = sp.expand(H.subs(p, centre)) if A is not None and centre == 0 else H.subs(p, centre)
    if not V.free_symbols <= {q}:
        raise InputError(f"the momentum at rest of {H} still depends on {p}")
    rate = harmonic_rate(V, q) if A is not None and q not in A.free_symbols else None
    mirrored = A is not None or H.subs(p, 2 * centre - p).equals(H) is True
    return Profile(
        H,
        q,
        p,
        V,
        centre,
        mirrored,
        ball_function(V, (q,)),
        ball_function(_derivative(V, q), (q,)),
        ball_function(_derivative(V, q, 2), (q,)),
        ball_function(H, (q, p)),
        ball_function(_derivative(H, p), (q, p)),
        ball_function(_derivative(H, p, 2).subs(p, centre), (q,)),
        ball_function(centre, (q,)),
        None if A is None else ball_function(A, (q,)),
        tuple(ball_function(place, ()) for place in _kinks(H, q)),
        None if rate is None else ball_function(rate, ()),
    )


def _kinks(H: Any, q: sp.Symbol) -> list[Any]:
    """Where the argument of an absolute value or sign vanishes, if it is linear in q."""
    found = []
    for part in H.atoms(sp.Abs, sp.sign):
        rate = sp.diff(part.args[0], q)
        if rate.is_number and rate.is_zero is False:
            found.append(-part.args[0].subs(q, 0) / rate)
    return found


def _derivative(formula: Any, symbol: sp.Symbol, order: int = 1) -> Any:
    """The derivative away from the kinks: that of |x| is sign x, that of sign x is 0."""
    found = sp.diff(formula, symbol, order)
    return found.replace(lambda part: isinstance(part, sp.DiracDelta), lambda part: sp.S.Zero).doit()


def _quadratic(H: Any, q: sp.Symbol, p: sp.Symbol) -> tuple[Any, Any]:
    """(A, −B/2A) of H = A p² + B p + C with A > 0 as far as signs are known; (None, None) where it is no such sum."""
    expanded = sp.expand(H)
    if not expanded.is_polynomial(p):
        return None, None
    polynomial = sp.Poly(expanded, p)
    if polynomial.degree() < 1:
        raise InputError(f"H = {H} does not depend on {p}: nothing moves")
    if polynomial.degree() == 1:
        raise InputError(f"H = {H} is linear in {p}, so its curves of constant energy do not close")
    if polynomial.degree() != 2:
        return None, None
    A, B = polynomial.coeff_monomial(p**2), polynomial.coeff_monomial(p)
    if A.is_negative:
        raise InputError(f"the kinetic energy in H = {H} is negative: take −H, whose motion is the same in reverse")
    return A, sp.cancel(-B / (2 * A)) if B != 0 else sp.S.Zero


def _rest(H: Any, q: sp.Symbol, p: sp.Symbol) -> Any:
    """p_0(q) where ∂H/∂p = 0: 0 for an even H, else the one real solution that sympy finds."""
    if H.subs(p, -p).equals(H) is True:
        return sp.S.Zero
    try:
        found = sp.solve(sp.diff(H, p), p)
    except (NotImplementedError, ValueError, TypeError):
        found = []
    real = [value for value in found if value.is_real is not False]
    if len(real) != 1:
        raise InputError(
            f"H = {H} is neither quadratic nor even in {p}, and no formula gives the one momentum at which it is least "
            f"for each {q}"
        )
    return real[0]
