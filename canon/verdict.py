"""The answer to a claim: four words, and what each of them rests on."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final, Literal

from canon.display import items_in_html, status_in_html
from canon.errors import ClaimFailed
from canon.typeset.mixed import in_html, in_latex, in_markdown, in_text, tidied

if TYPE_CHECKING:
    from canon.claim import Claim

Status = Literal["proved", "refuted", "supported", "undecided"]

GLANCES: Final = 2
"""Every decision looks at so many points: they are worth a line only where nothing else was found."""

STATUSES: Final[tuple[Status, ...]] = ("proved", "refuted", "supported", "undecided")


NUMBERS: Final[Mapping[str, str]] = {"independent": "the minor's size", "inequality": "smallest difference"}
"""What the number of the evidence is, for kinds that claim that something doesn't vanish; else the largest residual."""


@dataclass(frozen=True)
class Evidence:
    """What sampling found: at `points` points in `bits` bits, the worst residual and its rounding bound.

    `max_residual` is the absolute residual that is the largest part of its own bound, `bound` the rounding error that
    it is to be measured against at that same point; so no residual exceeds its bound where this one doesn't. Where the
    claim is that something is *not* identically 0 (`independent`), it is that determinant.
    """

    points: int
    max_residual: float
    bound: float
    bits: int = 53

    def __str__(self) -> str:
        return self.words("largest residual")

    def words(self, number: str) -> str:
        """The evidence in words; `number` says what it is that was looked at."""
        counted = f"{self.points} point{'s' * (self.points != 1)} in {self.bits} bits"
        return f"{counted}, {number} {self.max_residual:.3g} against a rounding bound of {self.bound:.3g}"


@dataclass(frozen=True)
class Verdict:
    """A claim's verdict with its grounds.

    `proved` rests on an exact argument (`certificate`), `refuted` on a point at which the claim fails by more than
    a rigorous bound (`witness`) or on an exact argument (`witness` None), `supported` on `numeric` evidence or on a
    bounded probability of error; `undecided` says in `method` and `detail` what was tried. `matters` are the names of
    the witness on which the refutation depends, where others stand in it too: these alone are shown to people. `claim`
    is what was verified, None of a verdict that comes from another process or a file.
    """

    status: Status
    kind: str
    title: str | None = None
    method: str = ""
    seconds: float = 0.0
    witness: Mapping[str, Any] | None = field(default=None, hash=False)
    numeric: Evidence | None = None
    certificate: Mapping[str, Any] | None = field(default=None, hash=False)
    detail: Mapping[str, Any] = field(default_factory=dict, hash=False)
    matters: tuple[str, ...] | None = None
    claim: Claim | None = field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        if self.status not in STATUSES:
            raise ValueError(f"a verdict is one of {', '.join(STATUSES)}, not {self.status!r}")
        for name in ("witness", "detail"):  # a verdict is read, and nobody changes what it rests on
            told = getattr(self, name)
            object.__setattr__(self, name, told if told is None else MappingProxyType(dict(told)))

    def __getstate__(self) -> dict[str, Any]:
        told = {**self.__dict__, "claim": None}  # whoever asked has it
        return {name: dict(x) if isinstance(x, MappingProxyType) else x for name, x in told.items()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        for name, value in state.items():
            shown = MappingProxyType(value) if name in ("witness", "detail") and value is not None else value
            object.__setattr__(self, name, shown)

    @property
    def one_digit_more(self) -> str | None:
        """What one digit more costs: "exact" of what is proved or refuted, where none is to be bought; None else."""
        return "exact" if self.status in ("proved", "refuted") else None

    def __bool__(self) -> bool:
        """True if proved, False if refuted; unknown is no truth value.

        **Raises:** `TypeError` where the claim is neither proved nor refuted.
        """
        if self.status == "proved":
            return True
        if self.status == "refuted":
            return False
        raise TypeError(
            f"the claim is {self.status}, which is neither true nor false: look at .status, or ask with .require()"
        )

    @property
    def shown_witness(self) -> Mapping[str, Any]:
        """The witness without names on which the refutation doesn't depend; empty where there is none."""
        witness = self.witness or {}
        return witness if self.matters is None else {name: witness[name] for name in self.matters}

    def require(self) -> Verdict:
        """This verdict, if it is `proved`.

        **Raises:** `ClaimFailed` otherwise, with the witness or with what isn't known.
        """
        if self.status != "proved":
            raise ClaimFailed(self)
        return self

    def __str__(self) -> str:
        return "\n".join([self._heading(), *(f"  {in_text(line)}" for line in self._told(_value))])

    def _heading(self) -> str:
        name = f"{self.kind} ({self.title})" if self.title else self.kind
        how = f" by {self.method}" if self.method else ""
        return f"{self.status}: {name}{how}, {_duration(self.seconds)}"

    def _told(self, shown: Callable[[object], str]) -> Iterator[str]:
        """What the verdict says below its first line, formulas in the language of claim files."""
        if self.witness is not None:
            at = ", ".join(_coordinate(key, value, shown) for key, value in self.shown_witness.items())
            yield f"at {at}" if at or self.matters is None else "wherever the formulas are defined"
        for key, value in self.detail.items():
            yield f"{key.replace('_', ' ')}: {shown(value)}"
        if self.numeric is not None and (self.status in ("supported", "undecided") or self.numeric.points > GLANCES):
            yield self.numeric.words(NUMBERS.get(self.kind, "largest residual"))

    def _repr_markdown_(self) -> str:
        status, _, remainder = self._heading().partition(": ")
        items = "".join(f"\n- {in_markdown(line, _escaped)}" for line in self._told(_listed))
        return f"**{status}**: {_escaped(remainder)}" + (f"\n{items}" if items else "")

    def _repr_html_(self) -> str:
        words = self._heading().partition(": ")[2].replace(self.kind, self.kind.replace("_", " "), 1)
        items = items_in_html(map(in_html, self._told(_listed)))
        return f"<div>{status_in_html(self.status, words)}{items}</div>"

    def _repr_latex_(self) -> str:
        words = self.kind.replace("_", r"\ ")
        at = ",\\ ".join(in_latex(_coordinate(k, v, _listed)).replace("$", "") for k, v in self.shown_witness.items())
        where = rf"\ \text{{at}}\ {at}" if at else ""
        return rf"$\textbf{{{self.status}}}\colon\ \mathrm{{{words}}}{where}$"


def _escaped(text: str) -> str:
    """Markdown without accidental emphasis, code, formulas, links or tags: a title is words, products keep stars."""
    plain = " ".join(text.splitlines()).replace("&", "&amp;").replace("<", "&lt;")
    return re.sub(r"[\\`*_$\[\]]", r"\\\g<0>", plain)


def _coordinate(name: str, value: object, shown: Callable[[object], str]) -> str:
    """name = value; of an arbitrary function the one that was chosen, in its argument a or its arguments a1, a2, …"""
    text = shown(value)
    return f"{name} = {tidied(text) if isinstance(value, str) else text}"


def _duration(seconds: float) -> str:
    return f"{1000 * seconds:.3g} ms" if seconds < 1 else f"{seconds:.3g} s"


def _value(value: object) -> str:
    if isinstance(value, Mapping):
        if set(value) == {"re", "im"}:
            return f"{value['re']} + {value['im']}*1j"
        return "{" + ", ".join(f"{key}: {_value(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    return str(value)


def _listed(value: object) -> str:
    """The same with an equality for each pair, which can be set as formulas."""
    if isinstance(value, Mapping) and set(value) != {"re", "im"}:
        return ", ".join(f"{key} = {_listed(item)}" for key, item in value.items())
    if isinstance(value, (list, tuple)):
        return ", ".join(map(_listed, value))
    return _value(value)
