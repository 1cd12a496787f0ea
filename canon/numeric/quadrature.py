"""Spectral grids: equidistant nodes in directions that close, Gauss's in those that don't, and derivatives on both.

On either grid smooth functions are integrated, differentiated and interpolated with errors that fall faster than any
power of the number of nodes, geometrically if they are analytic. Trefethen, Spectral Methods in MATLAB (2000),
chapters 3, 6 and 12; Berrut and Trefethen, SIAM Review 46 (2004) 501.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

Array = Any  # numpy arrays


@dataclass(frozen=True)
class Grid:
    """Nodes in [0, 1] of one direction: their places `x`, the quadrature's `weights`, and what differentiates.

    `matrix` takes values at the nodes to derivatives there; `modes` takes them to coefficients in the orthogonal basis
    (Fourier's, Legendre's), in order of frequency.
    """

    periodic: bool
    x: Array
    weights: Array
    matrix: Array
    modes: Array

    @property
    def count(self) -> int:
        """The number of nodes."""
        return len(self.x)

    def derivative(self, values: Array, axis: int) -> Array:
        """The derivative of the interpolant, at the nodes."""
        return np.moveaxis(np.tensordot(self.matrix, values, axes=(1, axis)), 0, axis)

    def amplification(self) -> Array:
        """At each node: how much larger the derivative's error is than independent errors of the values."""
        return np.sqrt(np.sum(self.matrix**2, axis=1))

    def tail(self, values: Array, axis: int) -> Array:
        """The largest coefficient among the last quarter of the frequencies, for each column of the last axis."""
        coefficients = np.abs(np.tensordot(self.modes[-max(1, self.count // 4) :], values, axes=(1, axis)))
        return coefficients.reshape(-1, values.shape[-1]).max(axis=0)

    def interpolation(self, at: Array) -> Array:
        """The matrix that takes values at the nodes to those of the interpolant at points `at` (m,)."""
        if self.periodic:
            waves = _waves(self.count)
            return np.real(np.exp(2j * np.pi * np.subtract.outer(at, self.x)[..., None] * waves).mean(axis=-1))
        weights = _barycentric(self.x)
        with np.errstate(divide="ignore", invalid="ignore"):
            terms = weights / np.subtract.outer(at, self.x)
            rows = terms / terms.sum(axis=1, keepdims=True)
        hit = np.isclose(at[:, None], self.x, rtol=0, atol=1e-15)
        return np.where(hit.any(axis=1)[:, None], hit.astype(float), rows)


def _waves(count: int) -> Array:
    return np.fft.fftfreq(count, 1 / count)


@lru_cache(maxsize=32)
def grid(count: int, periodic: bool) -> Grid:
    """The grid of `count` nodes: k/N of a circle, or Gauss–Legendre nodes of the unit interval."""
    return _circle(count) if periodic else _interval(count)


def _circle(count: int) -> Grid:
    x = np.arange(count) / count
    waves = _waves(count)
    moved = 2j * np.pi * np.where(2 * np.abs(waves) == count, 0.0, waves)
    columns = np.exp(-2j * np.pi * np.outer(waves, x)) / count
    matrix = np.real(np.exp(2j * np.pi * np.outer(x, waves)) @ (moved[:, None] * columns))
    order = np.argsort(np.abs(waves), kind="stable")
    return Grid(True, x, np.full(count, 1 / count), matrix, columns[order])


def _interval(count: int) -> Grid:
    nodes, weights = np.polynomial.legendre.leggauss(count)
    x = (nodes + 1) / 2
    bary = _barycentric(x)
    away = np.subtract.outer(x, x)
    np.fill_diagonal(away, 1.0)
    matrix = bary / bary[:, None] / away
    np.fill_diagonal(matrix, 0.0)
    np.fill_diagonal(matrix, -matrix.sum(axis=1))
    degrees = np.arange(count)
    modes = (degrees + 0.5)[:, None] * np.polynomial.legendre.legvander(nodes, count - 1).T * weights
    return Grid(False, x, weights / 2, matrix, modes)


def _barycentric(x: Array) -> Array:
    away = np.subtract.outer(x, x) * 4
    np.fill_diagonal(away, 1.0)
    return 1 / away.prod(axis=1)
