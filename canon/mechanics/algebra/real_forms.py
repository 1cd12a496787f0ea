"""The real forms of complex simple Lie algebras by the dimension of their maximal compact subalgebras.

Helgason, Differential Geometry, Lie Groups, and Symmetric Spaces (1978), chapter X, table V.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from canon.mechanics.algebra.complex_type import ComplexType

_EXCEPTIONAL: Final = {
    ("G", 2): (-14, 2),
    ("F", 4): (-52, -20, 4),
    ("E", 6): (-78, -26, -14, 2, 6),
    ("E", 7): (-133, -25, -5, 7),
    ("E", 8): (-248, -24, 8),
}
"""The characters (positive less negative squares of the Killing form), by which the forms are named."""

_USUAL: Final = {
    ("A1", 3): ("so(3)", "su(2)", "usp(2)"),
    ("A1", 1): ("sl(2,R)", "so(2,1)", "sp(2,R)", "su(1,1)"),
    ("B2", 10): ("so(5)", "usp(4)"),
    ("B2", 6): ("so(4,1)", "usp(2,2)"),
    ("B2", 4): ("so(3,2)", "sp(4,R)"),
    ("A3", 15): ("su(4)", "so(6)"),
    ("A3", 10): ("so(5,1)", "su*(4)"),
    ("A3", 7): ("so(4,2)", "su(2,2)"),
    ("A3", 6): ("sl(4,R)", "so(3,3)"),
    ("A3", 9): ("su(3,1)", "so*(6)"),
    ("D4", 16): ("so(6,2)", "so*(8)"),
}
"""Where low dimensions give one algebra several names."""

_COMPLEX: Final = {"A1": ("so(3,1)", "sl(2,C)", "so(3,C)"), "B2": ("so(5,C)", "sp(4,C)"), "A3": ("sl(4,C)", "so(6,C)")}


def real_form_names(kind: ComplexType, is_complex: bool, compact_dimension: int) -> tuple[str, ...]:
    """The names of a real simple algebra, the most usual first; several unrelated ones where `is_ambiguous`."""
    if is_complex:
        return _COMPLEX.get(str(kind)) or (_complex_name(kind),)
    found = _USUAL.get((str(kind), compact_dimension))
    if found is not None:
        return found
    return tuple(name for name, compact in _forms(kind) if compact == compact_dimension) or (
        f"a form of {kind} with a maximal compact subalgebra of dimension {compact_dimension}",
    )


def is_ambiguous(kind: ComplexType, is_complex: bool, compact_dimension: int) -> bool:
    """Whether two real forms that aren't isomorphic have this dimension of a maximal compact subalgebra."""
    if is_complex or (str(kind), compact_dimension) in _USUAL:
        return False
    return sum(compact == compact_dimension for _, compact in _forms(kind)) != 1


def compact_dimensions(kind: ComplexType) -> tuple[int, ...]:
    """The dimensions of the maximal compact subalgebras of all real forms, as often as there are forms with them."""
    forms = [(name, compact) for name, compact in _forms(kind)]
    usual = sorted({compact for key, compact in _USUAL if key == str(kind)})
    return tuple(usual) if kind.letter in "AB" and usual else tuple(sorted(compact for _, compact in forms))


def _complex_name(kind: ComplexType) -> str:
    n = kind.rank
    names = {"A": f"sl({n + 1},C)", "B": f"so({2 * n + 1},C)", "C": f"sp({2 * n},C)", "D": f"so({2 * n},C)"}
    return names.get(kind.letter) or f"{kind.letter.lower()}{n}(C)"


def _forms(kind: ComplexType) -> Iterator[tuple[str, int]]:
    """Each real form with the dimension of its maximal compact subalgebra."""
    n, letter = kind.rank, kind.letter
    if letter == "A":
        N = n + 1
        yield f"sl({N},R)", N * (N - 1) // 2
        yield f"su({N})", N * N - 1
        for q in range(1, N // 2 + 1):
            yield f"su({N - q},{q})", (N - q) ** 2 + q**2 - 1
        if N % 2 == 0:
            yield f"su*({N})", N * (N + 1) // 2
    elif letter == "C":
        yield f"sp({2 * n},R)", n * n
        yield f"usp({2 * n})", n * (2 * n + 1)
        for q in range(1, n // 2 + 1):
            p = n - q
            yield f"usp({2 * p},{2 * q})", p * (2 * p + 1) + q * (2 * q + 1)
    elif letter in "BD":
        N = 2 * n + (letter == "B")
        yield f"so({N})", N * (N - 1) // 2
        for q in range(1, N // 2 + 1):
            p = N - q
            yield f"so({p},{q})", (p * (p - 1) + q * (q - 1)) // 2
        if letter == "D":
            yield f"so*({N})", n * n
    else:
        for character in _EXCEPTIONAL[letter, n]:
            yield f"{letter.lower()}{n}({character})", (kind.dimension - character) // 2
