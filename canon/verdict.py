"""The answer to a claim: four words, and what each of them rests on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final, Literal

from canon.display import list_in_html, status_in_html
from canon.errors import ClaimFailed

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
    bounded probability of error; `undecided` says in `method` and `detail` what was tried.
    """

    status: Status
    kind: str
    title: str | None = None
    method: str = ""
    seconds: float = 0.0
    witness: Mapping[str, Any] | None = None
    numeric: Evidence | None = None
    certificate: Mapping[str, Any] | None = None
    detail: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.status not in STATUSES:
            raise ValueError(f"a verdict is one of {', '.join(STATUSES)}, not {self.status!r}")

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

    def require(self) -> Verdict:
        """This verdict, if it is `proved`.

        **Raises:** `ClaimFailed` otherwise, with the witness or with what isn't known.
        """
        if self.status != "proved":
            raise ClaimFailed(self)
        return self

    def __str__(self) -> str:
        name = f"{self.kind} ({self.title})" if self.title else self.kind
        how = f" by {self.method}" if self.method else ""
        lines = [f"{self.status}: {name}{how}, {_duration(self.seconds)}"]
        if self.witness is not None:
            lines.append("  at " + ", ".join(f"{key} = {_value(value)}" for key, value in self.witness.items()))
        lines += [f"  {key.replace('_', ' ')}: {_value(value)}" for key, value in self.detail.items()]
        if self.numeric is not None and (self.status in ("supported", "undecided") or self.numeric.points > GLANCES):
            lines.append(f"  {self.numeric.words(NUMBERS.get(self.kind, 'largest residual'))}")
        return "\n".join(lines)

    def _repr_markdown_(self) -> str:
        first, *rest = str(self).split("\n")
        status, _, remainder = first.partition(": ")
        items = "".join(f"\n- {_escaped(line.strip())}" for line in rest)
        return f"**{status}**: {_escaped(remainder)}" + (f"\n{items}" if items else "")

    def _repr_html_(self) -> str:
        first, *rest = str(self).split("\n")
        words = first.partition(": ")[2].replace(self.kind, self.kind.replace("_", " "), 1)
        return f"<div>{status_in_html(self.status, words)}{list_in_html(map(str.strip, rest))}</div>"

    def _repr_latex_(self) -> str:
        words = self.kind.replace("_", r"\ ")
        point = (self.witness or {}).items()
        at = ",\\ ".join(rf"\mathtt{{{_tex(key)} = {_tex(_value(value))}}}" for key, value in point)
        where = rf"\ \text{{at}}\ {at}" if at else ""
        return rf"$\textbf{{{self.status}}}\colon\ \mathrm{{{words}}}{where}$"


def _escaped(text: str) -> str:
    """Markdown without accidental emphasis: products and powers keep their stars."""
    return text.replace("*", r"\*").replace("_", r"\_")


def _tex(text: str) -> str:
    """A name or a formula as it is written, for LaTeX."""
    return text.replace("_", r"\_").replace("{", r"\{").replace("}", r"\}").replace("**", r"{*}{*}")


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
