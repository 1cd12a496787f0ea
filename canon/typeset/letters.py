"""Greek letters by their names, and names as a letter with an index."""

from __future__ import annotations

import re
import unicodedata
from typing import Final

_SMALL: Final = (
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lamda", "mu", "nu", "xi",
    "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega",
)  # fmt: skip
_CAPITAL: Final = ("Gamma", "Delta", "Theta", "Lamda", "Xi", "Pi", "Sigma", "Phi", "Psi", "Omega")


def _letter(word: str) -> str:
    size = "CAPITAL" if word[0].isupper() else "SMALL"
    return unicodedata.lookup(f"GREEK {size} LETTER {word}")


GREEK: Final = {
    **{name: _letter(word) for word in (*_SMALL, *_CAPITAL) for name in {word, word.replace("amda", "ambda")}},
    "lam": _letter("lamda"),
}
"""The letters of the words for them; lambda in both spellings, and as Python has to shorten it."""


def split_name(name: str) -> tuple[str, str]:
    """A name as its letter and its index: ("omega", "0") for omega_0 and omega0; p_x for px, M_x for Mx."""
    head, _, index = name.partition("_")
    if not head:
        return name, ""
    if not index and (found := re.fullmatch(r"(\D+?)(\d+)", head)):
        return found[1], found[2]
    if not index:
        for word in ("theta", "phi", "psi", "rho", "alpha", "beta"):
            if head[: -len(word)] in ("p", "q", "d") and head.endswith(word):
                return head[: -len(word)], word
        if len(head) == 2 and head[0] == "p" and head[1].isalpha() and head != "pi":
            return "p", head[1]
        if re.fullmatch(r"[a-ce-wA-W][xyzXYZ]", head):
            return head[0], head[1]
    return head, index.strip("_")
