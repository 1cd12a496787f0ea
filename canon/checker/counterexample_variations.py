"""Refutations of minima and maxima, beside `counterexample.py`: the second variation takes both signs.

Where a file says that ∫ L dt has a minimum along a path, or a maximum, with a field of Jacobi's and two of its zeros,
what it says may show the contrary: if the field is one, and its zeros lie between the ends, the second variation is
negative for some variations and positive for others. That is a claim of its own, "neither", which `alone_paths.py`
shows. Nothing of a certificate is used, and no point is needed.
"""

from __future__ import annotations

from typing import Any

if __package__:
    from canon.checker import alone_paths
    from canon.checker.alone import Stop
else:  # as a program's part, beside the other files
    import alone_paths  # type: ignore
    from alone import Stop  # type: ignore


def refuted(tables: Any, witness: Any, known: Any = None) -> tuple[str, str]:
    """Whether the second variation is seen to take both signs where one is claimed."""
    claim = tables["claim"]
    if claim["kind"] != "stationary" or claim.get("extremum") not in ("minimum", "maximum") or "conjugate" not in claim:
        raise Stop("not shown", "a refutation of such a claim")
    return alone_paths.shown({"tables": {**tables, "claim": {**claim, "extremum": "neither"}}})
