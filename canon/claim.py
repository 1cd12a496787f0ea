"""A claim: what is asserted, of what, and what its author expects of the answer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Final

from canon.errors import InputError
from canon.expected import text, whole_number

EXPECTATIONS: Final = ("holds", "fails", "proved", "refuted", "supported", "undecided")
"""The words of `expect`: a verdict, or `holds` (proved or supported), or `fails` (refuted)."""

_MET: Final[Mapping[str, tuple[str, ...]]] = {"holds": ("proved", "supported"), "fails": ("refuted",)}


@dataclass(frozen=True)
class Claim:
    """One assertion of a kind of `claim-files.md` about a subject.

    **Arguments:** `kind`; `subject`, what all claims of one file share (phase space, Hamiltonian,
    transformation, generating function, domain: `canon.mechanics.Subject`); `keys`, the kind's own keys
    with typed values; `title` and `source`, free text; `expect`, one of `EXPECTATIONS`; `budget`
    in seconds, which wins over the caller's; `index`, the claim's place in its file, from 0.

    **Raises:** `InputError` for another word in `expect`, a kind that is no text, or keys that are no table.
    """

    kind: str
    subject: Any
    keys: Mapping[str, Any] = field(default_factory=dict, hash=False)
    title: str | None = None
    source: str | None = None
    expect: str = "holds"
    budget: float | None = None
    index: int = 0

    def __post_init__(self) -> None:
        if not isinstance(self.expect, str) or self.expect not in EXPECTATIONS:
            raise InputError(f"expect is one of {', '.join(EXPECTATIONS)}, not {self.expect!r}")
        for said, where in ((self.title, "title"), (self.source, "source")):
            if said is not None:
                text(said, where)
        whole_number(self.index, "index", 0)
        if not isinstance(self.kind, str) or not isinstance(self.keys, Mapping):
            raise InputError(f"a claim has a kind and a table of keys, not {self.kind!r} and {self.keys!r}")
        object.__setattr__(self, "keys", _frozen(self.keys))

    def __repr__(self) -> str:
        keys = "".join(f", {name}={value!r}" for name, value in self.keys.items())
        return f"Claim({self.kind!r} about {getattr(self.subject, 'map', None) or self.subject!r}{keys})"

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "keys": _thawed(self.keys)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        for name, value in state.items():
            object.__setattr__(self, name, _frozen(value) if name == "keys" else value)

    def is_met_by(self, status: str) -> bool:
        """Whether a verdict of this status is what the claim's author expects."""
        text(status, "status")
        return status in _MET.get(self.expect, (self.expect,))


def _frozen(value: Any) -> Any:
    """The same value, whose tables and lists nobody can change."""
    if isinstance(value, Mapping):
        return MappingProxyType({name: _frozen(item) for name, item in value.items()})
    return tuple(map(_frozen, value)) if isinstance(value, (list, tuple)) else value


def _thawed(value: Any) -> Any:
    """The same value with tables that can be pickled."""
    if isinstance(value, Mapping):
        return {name: _thawed(item) for name, item in value.items()}
    return tuple(map(_thawed, value)) if isinstance(value, tuple) else value
