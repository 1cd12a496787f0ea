"""The sign of a polynomial whose terms have one sign each, by the signs of its names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from canon.checker import core


def sign_of(words: Mapping[str, Sequence[str]], p: core.Polynomial) -> tuple[int, bool]:
    """1 or -1 where all terms have this sign (0: they haven't), and whether one of them is never 0."""
    found: set[int] = set()
    never = False
    for monomial, c in p.items():
        sign, nowhere = (1 if c > 0 else -1), True
        for name, e in monomial:
            own = words.get(name, ())
            if "complex" in own or name == "1j":
                return 0, False
            if "negative" in own or "nonpositive" in own:
                sign *= (-1) ** e
            elif not ("positive" in own or "nonnegative" in own or e % 2 == 0):
                return 0, False
            nowhere &= "positive" in own or "negative" in own or "nonzero" in own
        found.add(sign)
        never |= nowhere
    return (found.pop(), never) if len(found) == 1 else (0, False)


def implied(words: Mapping[str, Sequence[str]], p: core.Polynomial) -> dict[str, list[str]]:
    """With c·α·q > 0, and a sign of all but q, q has one: what is known of it then."""
    found: dict[str, list[str]] = {}
    if len(p) != 1:
        return found
    ((monomial, c),) = p.items()
    for name, e in monomial:
        sign, never = sign_of(words, {tuple(x for x in monomial if x[0] != name): c})
        if e % 2 and sign and never:
            found[name] = [*words.get(name, ()), "positive" if sign > 0 else "negative"]
    return found
