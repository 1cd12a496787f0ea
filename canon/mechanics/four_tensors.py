"""Four-vectors and tensors of special relativity with the metric diag(1, −1, −1, −1); exact, with sympy.

Components are those of (ct, x, y, z). An index is upper (contravariant) or lower; an upper one is summed with a lower
one only, so that what is formed is a tensor again (Jackson, Classical Electrodynamics (1999), sections 11.6 and 11.9).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from canon.errors import InputError
from canon.expected import instance_of, listed, shown, whole_number
from canon.mechanics.boosts import boost
from canon.mechanics.formulas import as_expression
from canon.mechanics.vanishing import vanishes

Vector = Sequence[Any]
METRIC = sp.ImmutableMatrix(sp.diag(1, -1, -1, -1))
HIGHEST_RANK = 6


@dataclass(frozen=True)
class FourTensor:
    """Components T[μ, ν, …] with one letter for each index: "u" for an upper, "d" for a lower one.

    **Arguments:** `components`, nested lists 4 × 4 × … of exact numbers or sympy expressions, as many deep as `indices`
    has letters (a single expression for a scalar, with `indices` ""). **Raises:** `InputError`.
    """

    components: Any
    indices: str

    def __post_init__(self) -> None:
        if not isinstance(self.indices, str) or set(self.indices) - {"u", "d"} or len(self.indices) > HIGHEST_RANK:
            raise InputError(f'a word of at most {HIGHEST_RANK} letters "u" and "d" is expected', "indices")
        shape = (4,) * self.rank
        if isinstance(self.components, (str, bytes)) or getattr(self.components, "dtype", None) is not None:
            said = "lists of exact numbers or formulas are expected"
            raise InputError(f"{said}, not {shown(self.components)}", "components")
        entries = _entries(self.components, self.rank)
        if len(entries) != 4**self.rank:
            raise InputError(f"components {' × '.join(map(str, shape)) or 'of a scalar'} are expected", "components")
        flat = [as_expression(entry, "components") for entry in entries]
        object.__setattr__(self, "components", sp.ImmutableDenseNDimArray(flat, shape))

    @property
    def rank(self) -> int:
        """The number of indices."""
        return len(self.indices)

    def __getitem__(self, place: Any) -> Any:
        return self.components[place]

    @property
    def value(self) -> Any:
        """The number or formula that a scalar is. **Raises:** `InputError` for other ranks."""
        if self.rank:
            raise InputError(f"a tensor of rank {self.rank} is no scalar: contract it")
        return self.components[()]

    def with_index(self, k: int, kind: str) -> FourTensor:
        """The tensor with its k-th index, counted from 0, raised (`kind` "u") or lowered ("d") by the metric."""
        self._check(k)
        if not isinstance(kind, str) or kind not in ("u", "d"):
            raise InputError('"u" or "d" is expected', "kind")
        if self.indices[k] == kind:
            return self
        return FourTensor(self._applied(METRIC, k), self.indices[:k] + kind + self.indices[k + 1 :])

    def transformed(self, matrix: Any) -> FourTensor:
        """The components in the frame x' = Λ x: Λ for each upper index, its inverse transposed, g Λ g, for a lower one.

        **Raises:** `InputError` where ΛᵀgΛ isn't g.
        """
        Lambda = _lorentz(matrix)
        tensor = self
        for k, kind in enumerate(self.indices):
            factor = Lambda if kind == "u" else METRIC * Lambda * METRIC
            tensor = FourTensor(tensor._applied(factor, k), self.indices)
        return tensor

    def times(self, other: FourTensor) -> FourTensor:
        """The product with all indices of both kept, this one's first."""
        instance_of(other, FourTensor, "other")
        product = sp.tensorproduct(self.components, other.components)
        return FourTensor(product, self.indices + other.indices)

    def contracted(self, i: int, j: int) -> FourTensor:
        """The sum over two indices, one upper and one lower. **Raises:** `InputError` where both are of one kind."""
        self._check(i)
        self._check(j)
        if i == j or self.indices[i] == self.indices[j]:
            raise InputError(f"an upper and a lower index are summed: these are {self.indices[i]}, {self.indices[j]}")
        kept = "".join(kind for k, kind in enumerate(self.indices) if k not in (i, j))
        total = sp.tensorcontraction(self.components, (i, j))
        return FourTensor(total if kept else sp.expand(total), kept)

    def dot(self, other: FourTensor) -> Any:
        """The scalar product of two vectors, whatever their indices' places: a_μ b^μ."""
        instance_of(other, FourTensor, "other")
        if self.rank != 1 or other.rank != 1:
            raise InputError("a scalar product is one of two vectors")
        return self.with_index(0, "d").times(other.with_index(0, "u")).contracted(0, 1).value

    @property
    def square(self) -> Any:
        """The sum of all components times those with each index moved: a_μ a^μ, F_μν F^μν; a scalar."""
        moved = self
        for k, kind in enumerate(self.indices):
            moved = moved.with_index(k, "d" if kind == "u" else "u")
        pairs = zip(sp.flatten(self.components), sp.flatten(moved.components), strict=True)
        return sp.expand(sum((a * b for a, b in pairs), sp.S.Zero))

    def _applied(self, matrix: Any, k: int) -> Any:
        """The components with a matrix applied to the k-th index."""
        product = sp.tensorproduct(sp.ImmutableDenseNDimArray(matrix), self.components)
        summed = sp.tensorcontraction(product, (1, k + 2))  # the new index now stands in front
        order = [*range(1, k + 1), 0, *range(k + 1, self.rank)]
        return sp.permutedims(summed, order) if self.rank > 1 else summed

    def _check(self, k: int) -> None:
        whole_number(k, "index")
        if not 0 <= k < self.rank:
            raise InputError(f"the indices are counted from 0 to {self.rank - 1}: there is no {k}")


def four_vector(components: Vector) -> FourTensor:
    """The contravariant four-vector (a⁰, a¹, a², a³)."""
    return FourTensor(list(listed(components, "four components", "components")), "u")


def four_velocity(velocity: Vector, c: Any = 1) -> FourTensor:
    """γ (c, v): u_μ u^μ = c². **Raises:** `InputError` where the speed isn't below c."""
    light = as_expression(c, "c")
    matrix = boost(velocity, c)
    return four_vector([light * matrix[k, 0] for k in range(4)])


def field_tensor(electric: Vector, magnetic: Vector, c: Any = 1) -> FourTensor:
    """F^μν of the fields E and B in SI units: F^i0 = E_i/c, F^ij = −ε_ijk B_k (Jackson, eq. 11.137, with E/c for E)."""
    (Ex, Ey, Ez), (Bx, By, Bz) = (_three(v, w) for v, w in ((electric, "electric"), (magnetic, "magnetic")))
    light = _speed(c)
    ex, ey, ez = Ex / light, Ey / light, Ez / light
    rows = [[0, -ex, -ey, -ez], [ex, 0, -Bz, By], [ey, Bz, 0, -Bx], [ez, -By, Bx, 0]]
    return FourTensor(rows, "uu")


def fields_of(tensor: FourTensor, c: Any = 1) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
    """E and B of a field tensor, wherever its indices stand."""
    instance_of(tensor, FourTensor, "tensor")
    if tensor.rank != 2:
        raise InputError("a field tensor has two indices", "tensor")
    F = tensor.with_index(0, "u").with_index(1, "u")
    if any(vanishes(F[i, j] + F[j, i]) is False for i in range(4) for j in range(i, 4)):
        raise InputError("a field tensor is antisymmetric", "tensor")
    light = _speed(c)
    return tuple(sp.simplify(light * F[k, 0]) for k in (1, 2, 3)), (F[3, 2], F[1, 3], F[2, 1])


def four_force(charge: Any, tensor: FourTensor, velocity: FourTensor) -> FourTensor:
    """q F^μν u_ν: the rate of the four-momentum by the proper time in these fields (Jackson, eq. 11.144).

    **Arguments:** `velocity`, the `four_velocity`. **Raises:** `InputError` for tensors of other ranks.
    """
    for given, rank, where in ((tensor, 2, "tensor"), (velocity, 1, "velocity")):
        instance_of(given, FourTensor, where)
        if given.rank != rank:
            raise InputError(f"a tensor of rank {rank} is expected, not of rank {given.rank}", where)
    F = tensor.with_index(0, "u").with_index(1, "u")
    pushed = F.times(velocity.with_index(0, "d")).contracted(1, 2)
    return FourTensor([as_expression(charge, "charge") * sp.expand(entry) for entry in pushed.components], "u")


def doppler(velocity: Vector, direction: Vector, c: Any = 1) -> Any:
    """Observed over emitted frequency of a source that moves with a velocity.

    γ⁻¹/(1 + v·n/c), n the unit vector from the observer to the source: 1/(u·k) of the light's k = (1, −n), which comes
    to the observer (Jackson, eq. 11.30).

    **Arguments:** `direction`, n or any multiple of it. **Raises:** `InputError` for no direction, or no slower source.
    """
    ways = _three(direction, "direction")
    length = sp.sqrt(sum(x**2 for x in ways))
    if vanishes(length):
        raise InputError("a direction isn't 0", "direction")
    u = four_velocity(velocity, c)
    light = four_vector([1, *(-x / length for x in ways)])
    return sp.simplify(as_expression(c, "c") / u.dot(light))


def _speed(c: Any) -> Any:
    light = as_expression(c, "c")
    if light.is_positive is False:
        raise InputError(f"the speed of light is positive, not {light}", "c")
    return light


def _three(vector: Vector, where: str) -> list[Any]:
    found = [as_expression(entry, where) for entry in listed(vector, "three components", where)]
    if len(found) != 3:
        raise InputError(f"three components are expected, not {len(found)}", where)
    return found


def _lorentz(matrix: Any) -> sp.ImmutableMatrix:
    given = (
        matrix.tolist() if isinstance(matrix, sp.MatrixBase) else listed(matrix, "four rows of four entries", "matrix")
    )
    rows = [listed(row, "entries", "matrix") for row in given]
    if len(rows) != 4 or any(len(row) != 4 for row in rows):
        raise InputError("four rows of four entries are expected", "matrix")
    Lambda = sp.ImmutableMatrix([[as_expression(entry, "matrix") for entry in row] for row in rows])
    defect: Any = Lambda.T * METRIC * Lambda - METRIC
    answers = [vanishes(defect[i, j]) for i in range(4) for j in range(i, 4)]
    if not all(answers):
        seen = "is not g" if False in answers else "is not seen to be g: simplify its entries"
        raise InputError(f"no Lorentz matrix: transpose(L) g L {seen}", "matrix")
    return Lambda


def _entries(value: Any, deep: int) -> list[Any]:
    """The entries of lists of four, so deep; an empty list for another shape. **Raises:** `InputError` for no lists.

    They are taken apart here: sympy goes into tables, sets and texts without an end.
    """
    if not deep:
        return [value]
    whole = isinstance(value, sp.MatrixBase) and 1 not in value.shape
    parts = value.tolist() if isinstance(value, sp.NDimArray) or whole else listed(value, "components", "components")
    found = [_entries(part, deep - 1) for part in parts]
    right = len(found) == 4 and all(len(each) == 4 ** (deep - 1) for each in found)
    return [entry for each in found for entry in each] if right else []
