"""Certificates: what a proof rests on, as data, made when somebody looks."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from canon.decide.region import Region
    from canon.decide.tower import Generator, Tower


LONGEST: Final = 120
"""The most characters of an item that a notebook shows; the data has all of it."""
_SIGNS: Final = {
    "\\": r"\backslash ", "{": r"\{", "}": r"\}", "_": r"\_", "^": r"\char94 ", "#": r"\#", "$": r"\$", "%": r"\%",
    "&": r"\&", "~": r"\char126 ",
}  # fmt: skip


class Certificate(Mapping[str, Any]):
    """A mapping that is computed on first use, so that a verdict nobody asks about costs nothing."""

    def __init__(self, make: Callable[[], dict[str, Any]]) -> None:
        self._make = make
        self._data: dict[str, Any] | None = None

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (dict(self),)

    def __repr__(self) -> str:
        known = "made when it is looked at" if self._data is None else ", ".join(self._data)
        return f"Certificate({known})"

    def _repr_latex_(self) -> str:
        rows = "".join(rf"\text{{{_tex(name)}}} &\colon \text{{{_tex(text)}}} \\ " for name, text in _rows(self, ""))
        return rf"$\begin{{aligned}} {rows}\end{{aligned}}$"

    def _known(self) -> dict[str, Any]:
        if self._data is None:
            self._data = self._make()
        return self._data

    def __getitem__(self, key: str) -> Any:
        return self._known()[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._known())

    def __len__(self) -> int:
        return len(self._known())


def _restored(data: dict[str, Any]) -> Certificate:
    """A certificate that was made in another process."""
    return Certificate(lambda: data)


def _rows(value: Any, name: str) -> Iterator[tuple[str, str]]:
    """The leaves of nested data, each with its name."""
    if isinstance(value, Mapping):
        for key, item in value.items():
            yield from _rows(item, str(key))
    elif isinstance(value, (list, tuple)):
        for number, item in enumerate(value, 1):
            yield from _rows(item, f"{name} {number}")
    elif value not in (None, ""):
        yield name, str(value)


def _tex(text: str) -> str:
    """Text for LaTeX: its special signs escaped, cut where it is long."""
    text = text if len(text) <= LONGEST else f"{text[:LONGEST]} …"
    return "".join(_SIGNS.get(sign, sign) for sign in text)


def of_tower(tower: Tower, region: Region, argument: str) -> Certificate:
    """The kernels with their defining relations, and the conditions that hold on the region."""

    def make() -> dict[str, Any]:
        return {
            "argument": argument,
            "domain": [requirement.text for requirement in region.requirements],
            "kernels": [describe(tower, g) for g in tower.generators],
        }

    return Certificate(make)


def describe(tower: Tower, g: Generator) -> dict[str, Any]:
    """One generator: its name, what it stands for, its sign and its relation."""
    name = f"g{g.index}"
    out: dict[str, Any] = {"name": name, "stands for": _meaning(tower, g), "sign": g.sign}
    if g.degree:
        out["relation"] = f"{name}**{g.degree} = {g.lower}"
    return out


def _meaning(tower: Tower, g: Generator) -> str:
    def shown(x: Any) -> str:
        numerator, denominator = x
        under = " * ".join(f"({tower.field.factors[k]})**{e}" for k, e in denominator.items())
        return f"({numerator})/({under})" if under else f"{numerator}"

    if g.kind == "symbol":
        return str(tower.tape.symbol_at(g.data))
    if g.kind in ("pi", "I"):
        return g.kind
    if g.kind in ("cos", "sin", "exp"):
        return f"{g.kind}({shown(g.data)})"
    if g.kind.endswith("of pi/n"):
        return f"{g.kind[:3]}(pi/{g.data})"
    if g.kind == "log":
        return f"log({g.data[1]})" if len(g.data) == 2 else f"log(({g.data[1]})/({g.data[2]}))"
    if g.kind == "root" and g.data[0] == "chain":
        return f"({g.data[1]})**(1/{g.data[2] ** g.data[3]})"
    if g.kind == "root":
        return f"({g.data[2]})*(({g.data[1]})/({g.data[2]}))**(1/{g.data[3]})"
    if g.kind == "abs":
        return f"abs({g.data})"
    if g.kind == "arbitrary":
        name, orders, arguments = g.data
        return f"D{list(orders)} {name}({', '.join(shown(x) for x in arguments)})"
    return f"{g.kind}({', '.join(shown(x) for x in g.data)})"
