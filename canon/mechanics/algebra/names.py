"""Names of Lie algebras, as they are written: `so(4)`, `so(3,1)`, `sp(6,R)`, `e(3)`, `su(3) + u(1)`."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Final

from canon.errors import InputError
from canon.mechanics.algebra.complex_type import ComplexType
from canon.mechanics.algebra.identity import Core, Identity, RealSimple

Parts = tuple[list[RealSimple], int, list[Core]]

KNOWN: Final = (
    "so(n)", "so(p,q)", "so*(2n)", "so(n,C)", "su(n)", "su(p,q)", "su*(2n)", "sl(n,R)", "sl(n,C)", "sp(2n,R)",
    "sp(2n,C)", "usp(2n)", "u(n)", "u(p,q)", "gl(n,R)", "gl(n,C)", "u(1)^n", "e(n)", "iso(p,q)", "poincare", "lorentz",
    "galilei", "bargmann", "heisenberg(n)", "h(n)", "aff(1)",
)  # fmt: skip
"""The names, with n, p and q for whole numbers; a sum of them is a direct sum."""

LARGEST: Final = 40
_SUMMAND: Final = re.compile(r"([a-z]+\*?)(?:\(([0-9]+)(?:,([0-9]+|[RC]))?\))?(?:(?:\^|\*\*)([0-9]+))?")


def read_name(text: str) -> Identity:
    """The algebra of a name; a sum is a direct sum, `u(1)^3` a sum of equal terms.

    **Raises:** `InputError` for another name, saying which there are.
    """
    simple: list[RealSimple] = []
    abelian = 0
    cores: list[Core] = []
    for word in re.split(r"[+⊕]", text):
        name = re.sub(r"\s+", "", word).replace("ℝ", "R").replace("ℂ", "C")
        matched = _SUMMAND.fullmatch(_lowered(name))
        family = FAMILIES.get(matched[1]) if matched else None
        if matched is None or family is None:
            raise InputError(f"unknown algebra {word.strip()[:80]!r}: known are {', '.join(KNOWN)}, and sums of them")
        count = int(matched[4] or 1)
        numbers = [int(n) for n in matched.groups()[1:3] if n and n.isdigit()]
        if any(n > LARGEST for n in (*numbers, count)):
            raise InputError(f"{name!r} is too large: at most {LARGEST} is understood")
        parts = family(numbers, "" if (matched[3] or "").isdigit() else matched[3] or "")
        if parts is None or not count:
            raise InputError(f"{name!r} isn't understood: known are {', '.join(KNOWN)}, and sums of them")
        simple += parts[0] * count
        abelian += parts[1] * count
        cores += parts[2] * count
    levi = [*simple, *(ideal for core in cores for ideal in _levi_of(core))]
    dimension = sum(s.dimension for s in simple) + abelian + sum(core.dimension for core in cores)
    return Identity(tuple(sorted(simple)), abelian, tuple(sorted(cores)), "", tuple(sorted(levi)), dimension)


def _lowered(name: str) -> str:
    """The name with its letters small up to the brackets: SO(3) is so(3), Poincaré is poincare; R and C stay."""
    head, bracket, tail = name.partition("(")
    return head.lower().replace("é", "e") + bracket + tail


def _simple(letter: str, rank: int, compact: int) -> Parts:
    return [RealSimple(ComplexType(letter, rank), False, compact)], 0, []


def _complex(letter: str, rank: int) -> Parts:
    kind = ComplexType(letter, rank)
    return [RealSimple(kind, True, kind.dimension)], 0, []


def orthogonal(p: int, q: int) -> Parts:
    """so(p, q), in low dimensions by its other names."""
    N, compact = p + q, (p * (p - 1) + q * (q - 1)) // 2
    if N <= 2:
        return [], N * (N - 1) // 2, []
    if N == 4:
        if min(p, q) == 1:
            return _complex("A", 1)
        return _simple("A", 1, compact // 2)[0] * 2, 0, []
    small = {3: ("A", 1), 6: ("A", 3)}
    letter, rank = small.get(N) or ("B" if N % 2 else "D", N // 2)
    return _simple(letter, rank, compact)


def _orthogonal_complex(N: int) -> Parts:
    if N <= 2:
        return [], N * (N - 1), []
    if N == 4:
        return _complex("A", 1)[0] * 2, 0, []
    letter, rank = {3: ("A", 1), 6: ("A", 3)}.get(N) or ("B" if N % 2 else "D", N // 2)
    return _complex(letter, rank)


def _so(numbers: list[int], field: str) -> Parts | None:
    if field == "C":
        return _orthogonal_complex(numbers[0]) if numbers else None
    if field or not numbers or not sum(numbers):
        return None
    return orthogonal(numbers[0], numbers[1] if len(numbers) > 1 else 0)


def _so_star(numbers: list[int], field: str) -> Parts | None:
    if field or len(numbers) != 1 or numbers[0] % 2 or not numbers[0]:
        return None
    n = numbers[0] // 2
    if n == 1:
        return [], 1, []
    if n == 2:
        return _simple("A", 1, 3)[0] + _simple("A", 1, 1)[0], 0, []
    return _simple("A", 3, 9) if n == 3 else _simple("D", n, n * n)


def _su(numbers: list[int], field: str) -> Parts | None:
    if field or not numbers or not sum(numbers):
        return None
    p, q = numbers[0], numbers[1] if len(numbers) > 1 else 0
    return ([], 0, []) if p + q == 1 else _simple("A", p + q - 1, p * p + q * q - 1)


def _su_star(numbers: list[int], field: str) -> Parts | None:
    if field or len(numbers) != 1 or numbers[0] % 2 or not numbers[0]:
        return None
    return _simple("A", numbers[0] - 1, numbers[0] * (numbers[0] + 1) // 2)


def _sl(numbers: list[int], field: str) -> Parts | None:
    if len(numbers) != 1 or not numbers[0]:
        return None
    n = numbers[0]
    if n == 1:
        return [], 0, []
    return _complex("A", n - 1) if field == "C" else _simple("A", n - 1, n * (n - 1) // 2)


def _sp(numbers: list[int], field: str) -> Parts | None:
    if len(numbers) != 1 or numbers[0] % 2 or not numbers[0]:
        return None
    n = numbers[0] // 2
    letter = "A" if n == 1 else "B" if n == 2 else "C"
    return _complex(letter, n) if field == "C" else _simple(letter, n, n * n)


def _usp(numbers: list[int], field: str) -> Parts | None:
    if field or not numbers or any(n % 2 for n in numbers) or not sum(numbers):
        return None
    halves = [n // 2 for n in numbers]
    n = sum(halves)
    return _simple("A" if n == 1 else "B" if n == 2 else "C", n, sum(k * (2 * k + 1) for k in halves))


def _with_centre(inner: Callable[[list[int], str], Parts | None], numbers: list[int], field: str) -> Parts | None:
    parts = inner(numbers, field)
    return None if parts is None else (parts[0], parts[1] + (2 if field == "C" else 1), parts[2])


def iso(p: int, q: int) -> Parts | None:
    """so(p, q) with the translations on which it acts."""
    if p + q < 2:
        return ([], p + q, []) if p + q else None
    return [], 0, [Core("iso", (max(p, q), min(p, q)))]


def _iso(numbers: list[int], field: str) -> Parts | None:
    return None if field or not numbers else iso(numbers[0], numbers[1] if len(numbers) > 1 else 0)


def _one(core: Core) -> Callable[[list[int], str], Parts | None]:
    return lambda numbers, field: None if field or numbers else ([], 0, [core])


def _heisenberg(numbers: list[int], field: str) -> Parts | None:
    return None if field or len(numbers) != 1 or not numbers[0] else ([], 0, [Core("heisenberg", (numbers[0],))])


def _levi_of(core: Core) -> list[RealSimple]:
    if core.family == "iso":
        return orthogonal(*core.numbers)[0]
    return orthogonal(3, 0)[0] if core.family in ("galilei", "bargmann") else []


FAMILIES: Final[dict[str, Callable[[list[int], str], Parts | None]]] = {
    "so": _so,
    "so*": _so_star,
    "su": _su,
    "su*": _su_star,
    "sl": _sl,
    "sp": _sp,
    "usp": _usp,
    "u": lambda numbers, field: None if field else _with_centre(_su, numbers, field),
    "gl": lambda numbers, field: _with_centre(_sl, numbers, field),
    "e": lambda numbers, field: _iso(numbers, field) if len(numbers) == 1 else None,
    "iso": _iso,
    "lorentz": lambda numbers, field: None if field or numbers else orthogonal(3, 1),
    "poincare": _one(Core("iso", (3, 1))),
    "galilei": _one(Core("galilei")),
    "bargmann": _one(Core("bargmann")),
    "heisenberg": _heisenberg,
    "h": _heisenberg,
    "aff": lambda numbers, field: ([], 0, [Core("aff", (1,))]) if numbers == [1] and not field else None,
}
