"""What `certify` proved of a map on a box."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from canon.display import text_in_html


@dataclass(frozen=True)
class DefectBound:
    """A rigorous bound on the symplectic defect of a map over a box of phase space.

    **Fields:**

    - `upper`: every entry of M J Mᵀ − scale J is at most this in size, at every point of the box; infinite where a part
      of the box could not be enclosed.
    - `lower`: somewhere on the box an entry is at least this; at the point `at`. 0 if none was found to differ from 0.
    - `entry`: the bracket with the largest bound, as "{Q1,P2}".
    - `enclosed`: the fraction of the box's volume on which the map is certified to be smooth, and `upper_enclosed` the
      bound there; `reason`, why the rest is not.
    - the price: `boxes` that were bounded, Taylor's `degree`, `bits` of the balls, `seconds`.
    """

    upper: float
    lower: float
    entry: str
    at: tuple[float, ...] | None
    enclosed: float
    upper_enclosed: float
    reason: str
    dimension: int
    scale: float
    box: str
    variables: tuple[str, ...]
    boxes: int
    degree: int
    bits: int
    seconds: float = field(default=0.0, compare=False)

    _repr_html_ = text_in_html

    def __str__(self) -> str:
        c = "" if self.scale == 1 else f"{self.scale:g} "
        boxes = "1 box" if self.boxes == 1 else f"{self.boxes} boxes"
        price = f"{boxes}, degree {self.degree}, {self.bits} bits, {self.seconds:.2g} s"
        part = "" if self.enclosed == 1 else f" on {self.enclosed:.4g} of the volume"
        lines = [f"|M J Mᵀ − {c}J| <= {_up(self.upper_enclosed)}{part} in {self.box} ({price})"]
        if self.enclosed < 1:
            lines.append(f"  not enclosed elsewhere: {self.reason}")
        if self.upper_enclosed:
            lines.append(f"  the largest bound is that of {self.entry}")
        if self.at is not None:
            place = ", ".join(f"{name} = {x:.6g}" for name, x in zip(self.variables, self.at, strict=True))
            lines.append(f"  at least {_down(self.lower)} at {place}")
        return "\n".join(lines)

    def as_record(self) -> dict[str, Any]:
        """The bound as data for JSON: infinity is text."""
        return {
            "upper": self.upper if math.isfinite(self.upper) else "inf",
            "lower": self.lower,
            "entry": self.entry,
            "at": None if self.at is None else dict(zip(self.variables, self.at, strict=True)),
            "enclosed": self.enclosed,
            "upper_enclosed": self.upper_enclosed if math.isfinite(self.upper_enclosed) else "inf",
            "reason": self.reason,
            "dimension": self.dimension,
            "scale": self.scale,
            "box": self.box,
            "boxes": self.boxes,
            "degree": self.degree,
            "bits": self.bits,
            "seconds": round(self.seconds, 6),
        }


def _up(x: float) -> str:
    """Three digits, never less than x."""
    return _rounded(x, 1)


def _down(x: float) -> str:
    """Three digits, never more than x."""
    return _rounded(x, -1)


def _rounded(x: float, direction: int) -> str:
    text = f"{x:.2e}"
    if not math.isfinite(x) or not x:
        return f"{x:g}"
    mantissa, exponent = text.split("e")
    if (float(text) - x) * direction < 0:
        text = f"{float(mantissa) + direction * 0.01:.2f}e{exponent}"
    return f"{float(text):.3g}"
