"""The map of a generating function by numbers, left implicit: its equations are solved at each point."""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from numbers import Real
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from canon.budget import Budget
from canon.claims.implicit_images import DEEP, ImplicitImages, joined, with_caustics
from canon.claims.mixed_derivatives import OnTape
from canon.claims.other_type import of_type, valued
from canon.decide.cloud import cloud_around
from canon.decide.sample import Sample
from canon.decide.search import Finder
from canon.decide.tape import Unsupported
from canon.errors import InputError
from canon.expected import finite_number, instance_of, real_array, shown, table
from canon.numeric.implicit import MixedSolution, solve_mixed
from canon.numeric.map_shape import of_any_form
from canon.numeric.mixed_variables import Types

if TYPE_CHECKING:
    from canon.mechanics import GeneratingFunction

Array = Any  # numpy arrays

SEEDS: Final = 8
GUESSES: Final = 512
NEAREST: Final = 2
SMALLEST: Final = 3
AROUND: Final = 32
"""Starts are the nearest of the guesses, and of so many near ones those with the smallest new arguments."""

BLOCK: Final = 1024


@dataclass(frozen=True, eq=False)
class ImplicitMap:
    """(q, p) -> (Q, P) by a generating function whose equations are solved by Newton's method, point by point.

    It is called with one phase point (2n,), with points (N, 2n), or with a pair (q, p), and returns the same; where the
    equations could not be solved it is nan. `.solve` tells more. Where they have several solutions, that with the
    new arguments nearest to the `guess` is taken (to zero without one) among those that Newton's method finds.

    **Arguments:** the `generating` function; `parameters`, values of its parameters (and of the time) by name;
    `tolerated`, how many roundings an image may be off before it is found in more bits, which takes some ten times as
    long: with 4, nearly all digits are kept everywhere.

    **Raises:** `InputError` for a parameter without a value; when it is called, for an arbitrary function, or an F that
    defines no map.
    """

    generating: GeneratingFunction
    parameters: Mapping[str, float] = field(default_factory=dict)
    tolerated: float = DEEP

    def __post_init__(self) -> None:
        from canon.mechanics.generating_function import GeneratingFunction

        instance_of(self.generating, GeneratingFunction, "generating_function")
        space = self.generating.space
        known = {symbol.name for symbol in (*space.parameters, space.t)}
        table(self.parameters, "numbers", "parameters")
        for name, value in self.parameters.items():
            if name not in known:
                raise InputError(f"{name!r} is no parameter of this generating function", "parameters")
            finite_number(value, f"parameters, {name}")
        if not isinstance(self.tolerated, Real) or not self.tolerated >= 0:  # infinite: never in more bits
            raise InputError(f"a number of at least 0 is needed, not {shown(self.tolerated)}", "tolerated")
        object.__setattr__(self, "parameters", dict(self.parameters))  # the caller may change his own
        free = self.generating.F.expr.free_symbols - {*self.generating.mixed}
        for symbol in sorted(free, key=str):
            if str(symbol) not in self.parameters:
                raise InputError(f"no value is given for {symbol}: give one in `parameters`", "parameters")

    @cached_property
    def _seeded(self) -> tuple[OnTape, Array]:
        """F on a tape, and mixed points u (K, 2n) of its region."""
        question, F = valued(self.generating, self.parameters)
        tape = question.tape
        if tape.functions_of(F.gradient):
            raise InputError("an arbitrary function has no values", "generating_function, F")
        finder = Finder(tape, F.nodes, F.region, random.Random(0), question.budget)
        seeds: list[Sample] = []
        for attempt in range(8 * SEEDS):
            point = finder.attempt(64, nice=attempt < 4, effort=attempt)
            seeds += [point] if point is not None else []
            if len(seeds) == SEEDS:
                break
        if not seeds:
            raise InputError("no point was found at which this generating function defines a map")
        try:
            cloud = cloud_around(finder, seeds, GUESSES, Budget(10.0), 0)
        except Unsupported as reason:
            raise InputError(f"a function without a numerical form: {reason}", "generating_function, F") from reason
        fixed = np.ones(cloud.size)
        u = np.stack([cloud.points.get(node, fixed) for node in F.u], axis=1)
        return F, u

    def _of_type(self, types: Types) -> OnTape | None:
        """The function of another type of this map, if formulas lead to it: that is tried once for each type."""
        if types not in self._others:
            self._others[types] = of_type(self.generating, types, self.parameters)
        return self._others[types]

    @cached_property
    def _others(self) -> dict[Types, OnTape | None]:
        return {}

    def __call__(self, *arguments: Any) -> Any:
        """The image of a phase point, of points, or of a pair (q, p)."""
        return of_any_form(lambda z: self.solve(z).images, arguments)

    def solve(self, points: Array, guess: Array | None = None) -> ImplicitImages:
        """Images with all that is known of them.

        **Arguments:** `points` (N, 2n); `guess` (N, n) or (n,), first guesses of the new arguments of F (Q or P in each
        degree of freedom); without it, starts are taken from F's own region, and of several solutions found that with
        the smallest new arguments.

        **Raises:** `InputError` for points of another shape.
        """
        z = np.atleast_2d(real_array(points, "points"))
        size = 2 * self.generating.space.n
        if z.ndim != 2 or z.shape[1] != size:
            raise InputError(f"points have shape (N, {size}), not {np.shape(points)}", "points")
        F, _ = self._seeded
        wanted = None if guess is None else _guesses(guess, (len(z), size // 2))
        parts = [
            self._solved(F, z[k : k + BLOCK], None if wanted is None else wanted[k : k + BLOCK])
            for k in range(0, max(len(z), 1), BLOCK)
        ]
        return parts[0] if len(parts) == 1 else joined(parts)

    def _solved(self, F: OnTape, z: Array, guess: Array | None) -> ImplicitImages:
        n = z.shape[1] // 2
        starts = self._starts(z) if guess is None else [guess]
        target = np.zeros((len(z), n)) if guess is None else guess
        best: MixedSolution | None = None
        with np.errstate(all="ignore"):
            for start in starts:
                found = solve_mixed(F, F.pattern, z, start)
                best = found if best is None else _nearer(best, found, target)
        assert best is not None
        return with_caustics(F, z, best, of_type=self._of_type, tolerated=self.tolerated)

    def _starts(self, z: Array) -> list[Array]:
        """New arguments at points of the region whose old variables are near z: the nearest, and the smallest."""
        F, u = self._seeded
        n = u.shape[1] // 2
        found = F(u, np.arange(len(u)))
        old = np.empty_like(u)
        old[:, F.pattern.old_arguments] = u[:, :n]
        old[:, F.pattern.old_conjugates] = F.pattern.old_signs * found.gradient[:, :n]
        usable = found.inside & np.isfinite(old).all(axis=1)
        old, new = old[usable], u[usable, n:]
        # by the point's own size: what a point is mapped to doesn't hang on those that it is given with
        scale = np.median(np.abs(old), axis=0) + np.abs(z)[:, None, :] + 1e-300
        with np.errstate(all="ignore"):
            away = np.linalg.norm((z[:, None, :] - old[None, :, :]) / scale, axis=2)
        near = np.argsort(away, axis=1)[:, :AROUND]
        size = np.linalg.norm(new / (np.median(np.abs(new), axis=0) + 1e-300), axis=1)
        small = np.take_along_axis(near, np.argsort(size[near], axis=1), axis=1)[:, :SMALLEST]
        order = np.concatenate([near[:, :NEAREST], small], axis=1)
        return [new[order[:, k]] for k in range(order.shape[1])]


def _guesses(guess: Any, shape: tuple[int, int]) -> Array:
    """First guesses for each point. **Raises:** `InputError` for another shape."""
    given = real_array(guess, "guess")
    try:
        return np.broadcast_to(given, shape)
    except ValueError:
        raise InputError(f"guesses have shape {shape} or {shape[1:]}, not {given.shape}", "guess") from None


def _nearer(one: MixedSolution, other: MixedSolution, target: Array) -> MixedSolution:
    """Of two solutions at each point the one whose new arguments are nearer to the target."""
    n = target.shape[1]
    first, second = (np.linalg.norm(s.u[:, n:] - target, axis=1) for s in (one, other))
    take = other.solved & (~one.solved | (second < first * (1 - 1e-9)))

    def mixed(a: Array, b: Array) -> Array:
        return np.where(take.reshape(-1, *[1] * (a.ndim - 1)), b, a)

    names = ("u", "solved", "images", "errors", "M", "M_errors", "condition", "iterations")
    return MixedSolution(*(mixed(getattr(one, name), getattr(other, name)) for name in names))
