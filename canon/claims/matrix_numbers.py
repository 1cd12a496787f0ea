"""The brackets of matrices in floating-point numbers, each entry beside a bound on its rounding.

At points of the parameters X_a X_b − X_b X_a (or −i times that) is compared with Σ_c C^c_ab X_c: the entries come out
of balls, whose radii go into the bounds, and products are rounded by at most (m + 4) u |X_a||X_b| each way (Higham,
Accuracy and Stability of Numerical Algorithms, 2002, section 3.6, with complex factors).
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import TYPE_CHECKING, Any, Final

from flint import acb

from canon.decide.search import samples
from canon.decide.tape import Unsupported
from canon.verdict import Evidence

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.decide.region import Region
    from canon.decide.tape import Node

POINTS: Final = 40
UNIT: Final = 2.0**-53

Constants = Mapping[tuple[int, int], Mapping[int, int]]


def bracket_evidence(
    question: Question,
    region: Region,
    matrices: Mapping[str, Sequence[Sequence[Any]]],
    constants: Constants | None,
    *,
    physicists: bool,
) -> Evidence | None:
    """The worst entry of [X_a, X_b] − Σ C^c_ab X_c against its bound; None where no point could be evaluated.

    **Arguments:** `matrices`, their entries as expressions; `constants`, nodes by positions, and without them those
    that fit best at each point; `physicists`, whether the bracket is −i[A, B].
    """
    import numpy as np

    tape, size = question.tape, len(matrices)
    entries: list[Node] = [question.load(entry) for rows in matrices.values() for row in rows for entry in row]
    values: list[Node] = [value for row in (constants or {}).values() for value in row.values()]
    nodes = [*entries, *values]
    parameters = {x for node in (*nodes, *region.nodes()) for x in tape.support(node)}
    rng, count = random.Random(question.seed), POINTS if parameters else 1
    found: list[tuple[Any, Any]] = []
    try:
        for place in samples(tape, nodes, region, rng, count=count, bits=64, budget=question.budget):
            found.append(_numbers([place.balls[node] for node in nodes]))
    except Unsupported:
        return None
    if not found:
        return None
    value, off = (np.array([pair[k] for pair in found]) for k in range(2))
    m = len(next(iter(matrices.values())))
    X, EX = (array[:, : len(entries)].reshape(-1, size, m, m) for array in (value, off))
    pairs = list(combinations(range(size), 2))
    C, EC = (_table(array[:, len(entries) :], constants or {}, pairs, size) for array in (value, off))
    bracket, bound = _commutators(X, EX, pairs)
    bracket = -1j * bracket if physicists else bracket
    if constants is None:
        C = _fitted(X, bracket)
    claimed = np.einsum("pkc,pcij->pkij", C, X)
    rounding = (2 * size + 4) * UNIT
    bound = bound + np.einsum("pkc,pcij->pkij", np.abs(C), EX + rounding * np.abs(X))
    bound = bound + np.einsum("pkc,pcij->pkij", EC, np.abs(X) + EX)
    sizes = np.abs(bracket - claimed)
    bound = bound + 2 * UNIT * sizes
    if not sizes.size:
        return Evidence(len(found), 0.0, 0.0)
    with np.errstate(all="ignore"):
        ratio = np.where(sizes == 0, 0.0, sizes / bound)
    worst = np.unravel_index(np.argmax(ratio if ratio.any() else bound), ratio.shape)
    return Evidence(len(found), float(sizes[worst]), float(bound[worst]))


def _numbers(balls: Sequence[Any]) -> tuple[list[complex], list[float]]:
    """The middles as floats, and how far off they are: each ball's radius and the rounding of its middle."""
    values, off = [], []
    for ball in balls:
        parts = (ball.real, ball.imag) if isinstance(ball, acb) else (ball, None)
        value = complex(float(parts[0].mid()), 0.0 if parts[1] is None else float(parts[1].mid()))
        radius = sum(float(part.rad()) for part in parts if part is not None)
        exact = all(
            part is None or part == middle for part, middle in zip(parts, (value.real, value.imag), strict=True)
        )
        values.append(value)
        off.append(0.0 if exact else radius + 2 * UNIT * abs(value))
    return values, off


def _table(values: Any, constants: Constants, pairs: Sequence[tuple[int, int]], size: int) -> Any:
    """The constants (points, pairs, size), out of their list in the order of the table."""
    import numpy as np

    table = np.zeros((values.shape[0], len(pairs), size), values.dtype)
    position = 0
    for pair, row in constants.items():
        sign = 1 if pair in pairs else -1
        k = pairs.index(pair if sign == 1 else pair[::-1])
        for c in row:
            number = values[:, position]
            table[:, k, c] = sign * number if np.iscomplexobj(table) else number
            position += 1
    return table


def _commutators(X: Any, EX: Any, pairs: Sequence[tuple[int, int]]) -> tuple[Any, Any]:
    """X_a X_b − X_b X_a for the pairs, and bounds on their errors."""
    import numpy as np

    a, b = (np.array([pair[k] for pair in pairs], dtype=int) for k in range(2))
    size, rounding = np.abs(X), (X.shape[-1] + 4) * UNIT

    def product(i: Any, j: Any) -> tuple[Any, Any]:
        off = EX[:, i] @ (size[:, j] + EX[:, j]) + size[:, i] @ EX[:, j]
        return X[:, i] @ X[:, j], off + 2 * rounding * (size[:, i] @ size[:, j])

    (left, left_bound), (right, right_bound) = product(a, b), product(b, a)
    return left - right, left_bound + right_bound + 2 * UNIT * np.abs(left - right)


def _fitted(X: Any, bracket: Any) -> Any:
    """Real coefficients that fit best, point by point."""
    import numpy as np

    out = np.zeros((*bracket.shape[:2], X.shape[1]))
    for p, (basis, products) in enumerate(zip(X, bracket, strict=True)):
        flat = basis.reshape(len(basis), -1)
        columns = np.concatenate([flat.real, flat.imag], axis=1).T
        wanted = products.reshape(len(products), -1)
        right = np.concatenate([wanted.real, wanted.imag], axis=1).T
        out[p] = np.linalg.lstsq(columns, right, rcond=None)[0].T
    return out
