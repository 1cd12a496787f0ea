"""Which names of Lie algebras there are: `so(4)`, `so(3,1)`, `sp(6,R)`, `e(3)`, `su(3) + u(1)^2`.

A name that nobody can read isn't one of another algebra: a claim with it is no claim, whatever its structure constants.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Any

LARGEST = 40
"""The largest number in a name."""
_TERM = re.compile(r"([a-z]+\*?)(?:\((\d+)(?:,(\d+|[RC]))?\))?(?:(?:\^|\*\*)(\d+))?", re.ASCII)
Rule = Callable[[Sequence[int], str], bool]


def _signature(n: Sequence[int], field: str) -> bool:
    return not field and sum(n) > 0


def _linear(n: Sequence[int], field: str) -> bool:
    return len(n) == 1 and n[0] > 0


def _even(n: Sequence[int], field: str) -> bool:
    return not field and len(n) == 1 and n[0] > 0 and n[0] % 2 == 0


def _alone(n: Sequence[int], field: str) -> bool:
    return not field and not n


FAMILIES: dict[str, Rule] = {
    "so": lambda n, field: field == "C" or _signature(n, field),
    "so*": _even, "su*": _even, "su": _signature, "u": _signature, "iso": _signature, "sl": _linear, "gl": _linear,
    "sp": lambda n, field: len(n) == 1 and n[0] > 0 and n[0] % 2 == 0,
    "usp": lambda n, field: _signature(n, field) and all(k % 2 == 0 for k in n),
    "e": lambda n, field: _signature(n, field) and len(n) == 1,
    "heisenberg": lambda n, field: not field and _linear(n, field),
    "h": lambda n, field: not field and _linear(n, field),
    "aff": lambda n, field: not field and [*n] == [1],
    "lorentz": _alone, "poincare": _alone, "galilei": _alone, "bargmann": _alone,
}  # fmt: skip
"""The families, with what may stand in their brackets: one number or two, or a number and R or C."""


def is_name(text: Any) -> bool:
    """Whether a text names a Lie algebra, or a direct sum of such."""
    return isinstance(text, str) and all(map(_is_term, re.split(r"[+⊕]", text)))


def _is_term(word: str) -> bool:
    head, bracket, tail = re.sub(r"\s+", "", word).replace("ℝ", "R").replace("ℂ", "C").partition("(")
    found = _TERM.fullmatch(head.lower().replace("é", "e") + bracket + tail)
    if found is None or found[1] not in FAMILIES:
        return False
    numbers = [int(n) for n in (found[2], found[3]) if n and n.isdecimal()]
    field = found[3] if found[3] in ("R", "C") else ""
    count = int(found[4] or 1)
    return max([count, *numbers]) <= LARGEST and count > 0 and FAMILIES[found[1]](numbers, field)
