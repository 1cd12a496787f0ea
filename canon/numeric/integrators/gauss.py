"""Gauss–Legendre collocation: symplectic, symmetric, of order 2s, for Hamiltonians that do not separate.

The stages are solved by fixed-point iteration until nothing but rounding changes, from the last step's collocation
polynomial carried on; or by Newton's method with the Jacobian at the step's beginning, for long steps.
Hairer, Lubich and Wanner (2006), Geometric Numerical Integration, II.1.3 and VIII.6; Hairer, McLachlan and
Razakarivony (2008), BIT 48, 231, on iterating until rounding.

A run that keeps the rounding of its additions keeps that of the coefficients and of the last products, too: rounded
coefficients fulfil the condition for symplecticity to 10⁻¹⁷ only, and what that takes in each step has a sign.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final, Literal

import numpy as np

from canon.numeric.compensated import Constant, add_pair, in_two_doubles, times_constant, weighed_sum
from canon.numeric.integrators.fields import as_field
from canon.numeric.integrators.problem import State
from canon.numeric.integrators.stepper import Stepper, Time
from canon.numeric.integrators.traits import Traits

MOST_ITERATIONS: Final = 60
SOLVED: Final = 1e-9
"""Stages that are left with a larger change, relative to the step's, are not solved: the state becomes nan."""


@dataclass(frozen=True)
class Gauss:
    """Gauss–Legendre with `stages` s, of order 2s: s = 1 is the implicit midpoint rule."""

    stages: int
    solver: Literal["fixed point", "newton"] = "fixed point"
    source: str = "Butcher (1964); Kuntzmann (1961); Hairer, Lubich and Wanner (2006), II.1.3"

    @property
    def name(self) -> str:
        """implicit_midpoint, gauss4, gauss6, …"""
        kind = "implicit_midpoint" if self.stages == 1 else f"gauss{2 * self.stages}"
        return kind if self.solver == "fixed point" else f"{kind}_newton"

    @property
    def traits(self) -> Traits:
        """Symplectic and symmetric; it preserves volume where the field is Hamiltonian."""
        return Traits(order=2 * self.stages, symplectic=True, symmetric=True, volume_preserving=True)

    def stepper(self, problem: Any, *, compensated: bool = False) -> Stepper:
        """The method set up for a `Field`, or for the sum of a `Splitting`'s parts; slots are arrays."""
        return _stepper(self, problem, compensated)


def tableau(stages: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(A, b, c): the nodes are the zeros of Legendre's polynomial on [0, 1]."""
    nodes, weights = np.polynomial.legendre.leggauss(stages)
    c, b = (1 + nodes) / 2, weights / 2
    powers = np.arange(stages)
    basis = np.linalg.inv(np.vander(c - 0.5, increasing=True))
    upper = ((c[:, None] - 0.5) ** (powers + 1) - (-0.5) ** (powers + 1)) / (powers + 1)
    return upper @ basis, b, c


DIGITS: Final = 40


@lru_cache(maxsize=8)
def exact_tableau(stages: int) -> tuple[tuple[tuple[Constant, ...], ...], tuple[Constant, ...]]:
    """(A, b) in two doubles each: Σ_j a_ij c_j^k = c_i^(k+1)/(k+1) and Σ_j b_j c_j^k = 1/(k+1) for k < s."""
    import mpmath

    mp = mpmath.mp.clone()
    mp.dps = DIGITS
    near = np.polynomial.legendre.leggauss(stages)[0]
    c = [(1 + mp.findroot(lambda x: mp.legendre(stages, x), mp.mpf(float(x)))) / 2 for x in near]
    powers = mp.matrix([[node**k for node in c] for k in range(stages)])

    def weights(end: Any) -> tuple[Constant, ...]:
        return tuple(map(in_two_doubles, mp.lu_solve(powers, [end ** (k + 1) / (k + 1) for k in range(stages)])))

    return tuple(weights(node) for node in c), weights(mp.one)


def _stepper(method: Gauss, problem: Any, compensated: bool) -> Stepper:
    import jax
    import jax.numpy as jnp
    from jax import lax
    from jax.flatten_util import ravel_pytree

    field = as_field(problem, method.name)
    A, b, c = tableau(method.stages)
    ahead = np.vander(1 + c - 0.5, method.stages, increasing=True) @ np.linalg.inv(np.vander(c - 0.5, increasing=True))

    def slopes_of(state: State, inner: Any, time: Time, lost: Any = None) -> Any:
        """f at the stages z + Z_i, all at once."""

        def one(Z: Any, node: Any) -> Any:
            Z = Z if lost is None else jax.tree.map(jnp.add, Z, lost)
            return field.rate(jax.tree.map(jnp.add, state, Z), time.at(node))

        return jax.vmap(one)(inner, jnp.asarray(c))

    def weighed(matrix: np.ndarray, slopes: Any, h: Any) -> Any:
        """h Σ_j a_ij k_j, written out: a product of small matrices is no small program."""
        rows = [[float(x) for x in row] for row in matrix]
        return jax.tree.map(
            lambda k: jnp.stack([h * sum((w * k[j] for j, w in enumerate(row) if j), row[0] * k[0]) for row in rows]),
            slopes,
        )

    def prepare(h: Any) -> Any:
        """The coefficients times h, in two doubles."""
        if not compensated:
            return None
        rows, last = exact_tableau(method.stages)
        return [[times_constant(h, w) for w in row] for row in (*rows, last)]

    def inner_of(slopes: Any, tables: Any, h: Any) -> Any:
        """Z_i = h Σ_j a_ij k_j."""
        if tables is None:
            return weighed(A, slopes, h)

        def one(k: Any) -> Any:
            return jnp.stack([weighed_sum(row, [k[j] for j in range(method.stages)])[0] for row in tables[:-1]])

        return jax.tree.map(one, slopes)

    def size(tree: Any) -> Any:
        return jnp.max(jnp.stack([jnp.max(jnp.abs(x)) for x in jax.tree.leaves(tree)]))

    def initial(state: State) -> Any:
        slopes = jax.tree.map(lambda x: jnp.zeros((method.stages, *jnp.shape(x))), state)
        return (state, jax.tree.map(jnp.zeros_like, state) if compensated else None, slopes)

    def step(carry: Any, tables: Any, time: Time) -> Any:
        state, lost, old = carry
        h = time.h
        solve = _newton_solve(state, time) if method.solver == "newton" else None

        def improve(loop: Any) -> Any:
            count, Z, last, _ = loop
            new = inner_of(slopes_of(state, Z, time, lost), tables, h)
            if solve is not None:
                new = jax.tree.map(jnp.add, Z, solve(jax.tree.map(jnp.subtract, new, Z)))
            change = size(jax.tree.map(jnp.subtract, new, Z))
            still = (change > 0) & ((change < last) | (change > SOLVED * size(new)) | (count < 2))
            return count + 1, new, change, still

        first = weighed(A @ ahead, old, h)
        begin = (0, first, jnp.asarray(jnp.inf), jnp.asarray(True))
        _, Z, change, _ = lax.while_loop(lambda loop: (loop[0] < MOST_ITERATIONS) & loop[3], improve, begin)
        slopes = slopes_of(state, Z, time, lost)
        good = change <= SOLVED * size(Z) + 1e-300
        if lost is None:
            increment = jax.tree.map(lambda k: jnp.where(good, k[0], jnp.nan), weighed(b[None, :], slopes, h))
            return jax.tree.map(jnp.add, state, increment), None, slopes

        def moved(z: Any, rest: Any, k: Any) -> Any:
            high, low = weighed_sum(tables[-1], [k[j] for j in range(method.stages)])
            return add_pair(z, rest, (jnp.where(good, high, jnp.nan), low))

        pairs = jax.tree.map(moved, state, lost, slopes)
        return (*jax.tree.transpose(jax.tree.structure(state), None, pairs), slopes)

    def _newton_solve(state: State, time: Time) -> Any:
        """(1 − h A ⊗ f')⁻¹ at the step's beginning, applied to the stages."""
        flat, restore = ravel_pytree(state)
        jacobian = jax.jacfwd(lambda z: ravel_pytree(field.rate(restore(z), time.at(0.5)))[0])(flat)
        matrix = jnp.eye(method.stages * flat.size) - time.h * jnp.kron(jnp.asarray(A), jacobian)
        inverse = jnp.linalg.inv(matrix)

        def solve(rest: Any) -> Any:
            rows = jax.vmap(lambda part: ravel_pytree(part)[0])(rest)
            return jax.vmap(restore)((inverse @ rows.ravel()).reshape(rows.shape))

        return solve

    return Stepper(
        prepare=prepare,
        initial=initial,
        begin=lambda carry, tables, time: carry,
        step=step,
        end=lambda carry, tables, time: carry,
        read=lambda carry: carry[0],
    )


IMPLICIT_MIDPOINT: Final = Gauss(1)
GAUSS_4: Final = Gauss(2)
GAUSS_6: Final = Gauss(3)
GAUSS_8: Final = Gauss(4)
METHODS: Final = (IMPLICIT_MIDPOINT, GAUSS_4, GAUSS_6, GAUSS_8)
