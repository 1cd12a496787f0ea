"""Numerical evidence on the map of a generating function that stays implicit: solve its equations, look at M J Mᵀ − J.

The theorem on generating functions needs no numbers. So these are a check of another kind: Newton's method finds the
images of phase points, and the Jacobian that follows there must be symplectic, beside what rounding explains.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from canon.claims.implicit_images import ImplicitImages, with_caustics
from canon.claims.mixed_derivatives import OnTape
from canon.decide.cloud import cloud_around
from canon.decide.search import Finder
from canon.decide.tape import Unsupported
from canon.numeric.implicit import MixedSolution, solve_mixed
from canon.numeric.residuals import brackets
from canon.verdict import Evidence

if TYPE_CHECKING:
    from canon.claims.question import Question

Array = Any  # numpy arrays

POINTS: Final = 1000
TRIES: Final = 32
MOVED: Final = (1e-9, 1e-6, 1e-3)
"""Newton's method starts as far, relatively, from the new arguments that it should find."""

PLAINLY: Final = 1e3

DEEPEST: Final = 8
"""So many of the worst points near a caustic are found again in more digits."""


@dataclass(frozen=True)
class Solved:
    """What was found: the `evidence` on M J Mᵀ − J, whether it `holds`, and words on the solving.

    The bounds are running bounds, to first order; it doesn't hold where a residual is `PLAINLY` times its bound.
    """

    evidence: Evidence
    holds: bool
    words: str


def solved_numerically(question: Question) -> Solved | None:
    """The map of the question's generating function at random points.

    None where it can't be evaluated in double precision, or a bound proves to be a little too small.
    """
    generating = question.map.generating_function
    if generating is None or question.subject.domain.surface:
        return None
    F = OnTape.of(question, generating)
    finder = Finder(question.tape, F.nodes, F.region, random.Random(question.seed), question.budget)
    try:
        for attempt in range(TRIES):
            seed = finder.attempt(64, nice=attempt < 2, effort=attempt)
            if seed is not None:
                break
        else:
            return None
        cloud = cloud_around(finder, [seed], POINTS, question.budget.share(0.3), question.seed)
        others = {node: values for node, values in cloud.points.items() if node not in F.u}
        F = replace(F, others=others, functions=cloud.functions)
        ones = np.ones(cloud.size)
        u = np.stack([cloud.points.get(node, ones) for node in F.u], axis=1)
        return _judged(F, u, question.seed)
    except Unsupported:
        return None


def _judged(F: OnTape, u: Array, seed: int) -> Solved | None:
    pattern, n = F.pattern, u.shape[1] // 2
    rng = np.random.default_rng(seed)
    with np.errstate(all="ignore"):
        there = F(u, np.arange(len(u)))
        z = np.empty_like(u)
        z[:, pattern.old_arguments] = u[:, :n]
        z[:, pattern.old_conjugates] = pattern.old_signs * there.gradient[:, :n]
        start = _beside(F, u, rng)
        found = solve_mixed(F, pattern, z, start)
        images = with_caustics(F, z, found, most=DEEPEST)
        usable = found.solved & np.isfinite(found.M_errors).all(axis=(1, 2))
        if not usable.any():
            return None
        residuals = brackets(found.M[usable], found.M_errors[usable]).residuals(1.0)
    sizes = np.concatenate([r.sizes.ravel() for r in residuals])
    bounds = np.concatenate([r.bounds.ravel() for r in residuals])
    with np.errstate(all="ignore"):
        most = int(np.argmax(np.where(sizes == 0, 0.0, sizes / bounds)))
    if np.any(sizes > bounds) and not np.any(sizes > PLAINLY * bounds):
        return None
    evidence = Evidence(int(usable.sum()), float(sizes[most]), float(bounds[most]), 53)
    return Solved(evidence, bool(np.all(sizes <= bounds)), _words(found, images))


def _beside(F: OnTape, u: Array, rng: np.random.Generator) -> Array:
    """First guesses of the new arguments: off by the largest of `MOVED` that leaves the point in F's region."""
    n = u.shape[1] // 2
    start = u[:, n:].copy()
    for part in MOVED:
        trial = u[:, n:] * (1 + part * rng.choice([-1.0, 1.0], start.shape))
        inside = F(np.concatenate([u[:, :n], trial], axis=1), np.arange(len(u))).inside
        start[inside] = trial[inside]
    return start


def _words(found: MixedSolution, images: ImplicitImages) -> str:
    steps = int(found.iterations[found.solved].max(initial=0))
    return f"Newton's method: {images}, at most {steps} steps"
