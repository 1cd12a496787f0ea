"""What the small checker says of an identity, by a certificate that says nothing."""

from typing import Any

from canon.checker import alone_related
from tests.checker.certified import resealed

SPACE: Any = {"phase_space": {"q": ["x", "y"], "p": ["u", "v"], "Q": ["X", "Y"], "P": ["U", "V"]}}
NAMES = {
    "m": "positive", "k": "real", "n": "integer", "l": "integer", "b": ["integer", "positive"], "c": "negative",
    "F": "function",
}  # fmt: skip


def answer(lhs: str, rhs: str, *where: str, on: Any = (), by: Any = None, **words: str) -> str:
    """The answer about lhs = rhs, in such a domain, beside a map, with words for names."""
    domain = {
        **({"where": [*where]} if where else {}),
        **({"on": [on] if isinstance(on, str) else [*on]} if on else {}),
    }
    tables = {**SPACE, "symbols": {**NAMES, **words}, **({"domain": domain} if domain else {}), **(by or {})}
    claim = {"kind": "identity", "lhs": lhs, "rhs": rhs}
    data = {"certificate": 1, "tables": {**tables, "claim": claim}, "verdict": "proved", "witness": None, "cases": [{}]}
    return alone_related.checked(resealed(data))[0]
