"""Potentials with one harmonic: the pendulum's, in any angle and with any phase."""

from __future__ import annotations

from typing import Any

import sympy as sp


def harmonic_rate(V: Any, q: sp.Symbol) -> Any | None:
    """The n of V = c + a cos nq + b sin nq (phases allowed); None of any other potential."""
    atoms = [part for part in V.atoms(sp.sin, sp.cos) if q in part.free_symbols]
    rates = {sp.Abs(sp.diff(part.args[0], q)) for part in atoms}
    if len(rates) != 1 or q in (rate := rates.pop()).free_symbols:
        return None
    symbols = [sp.Dummy() for _ in atoms]
    replaced = sp.expand(V.subs(dict(zip(atoms, symbols, strict=True))))
    if q in replaced.free_symbols or not replaced.is_polynomial(*symbols):
        return None
    return rate if sp.Poly(replaced, *symbols).total_degree() == 1 else None
