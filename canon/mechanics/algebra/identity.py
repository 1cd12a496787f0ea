"""What a real Lie algebra is up to isomorphism: simple ideals, an abelian factor, and what else is known by name."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from canon.mechanics.algebra.complex_type import ComplexType
from canon.mechanics.algebra.real_forms import is_ambiguous, real_form_names


@dataclass(frozen=True, slots=True, order=True)
class RealSimple:
    """A real simple algebra: its complex type, whether it is that complex algebra read as a real one, and otherwise
    the dimension of a maximal compact subalgebra, which tells the real form."""

    type: ComplexType
    is_complex: bool
    compact_dimension: int

    @property
    def dimension(self) -> int:
        """The real dimension."""
        return self.type.dimension * (2 if self.is_complex else 1)

    @property
    def names(self) -> tuple[str, ...]:
        """All names of it, the most usual first."""
        return real_form_names(self.type, self.is_complex, self.compact_dimension)


@dataclass(frozen=True, slots=True, order=True)
class Core:
    """A Lie algebra that is no direct sum, is neither semisimple nor abelian, and has a name.

    `family` is "iso" (of a quadratic form with p and q squares, p ≥ q), "heisenberg" (of n pairs), "galilei",
    "bargmann" (Galilei's algebra extended by the mass) or "aff" (of the line), `numbers` what it depends on.
    """

    family: str
    numbers: tuple[int, ...] = ()

    @property
    def name(self) -> str:
        """The name, as `e(3)`."""
        if self.family == "iso":
            p, q = self.numbers
            return f"iso({p},{q})" if q else f"e({p})"
        if self.family in ("heisenberg", "aff"):
            return f"{self.family}({self.numbers[0]})"
        return self.family

    @property
    def dimension(self) -> int:
        """The dimension."""
        if self.family == "iso":
            n = sum(self.numbers)
            return n * (n + 1) // 2
        return {"heisenberg": 2 * (self.numbers or (0,))[0] + 1, "aff": 2, "galilei": 10, "bargmann": 11}[self.family]


@dataclass(frozen=True, slots=True)
class Identity:
    """A direct sum of simple ideals, of `abelian` copies of R, and of further summands that are no direct sums.

    **Arguments:** `simple`, sorted; `abelian`; `cores`, the further summands that have a name, sorted; `other`, what is
    known of those that have none ("" where there are none); `levi`, the simple ideals of the Levi subalgebra of the
    whole; `dimension`; `is_open`, whether there may be algebras with a name among `other`, since it wasn't taken apart.
    """

    simple: tuple[RealSimple, ...]
    abelian: int
    cores: tuple[Core, ...]
    other: str
    levi: tuple[RealSimple, ...]
    dimension: int
    is_open: bool = False

    @property
    def is_named(self) -> bool:
        """Whether the isomorphism class is known entirely."""
        return not self.other and not any(is_ambiguous(s.type, s.is_complex, s.compact_dimension) for s in self.simple)

    @property
    def name(self) -> str:
        """The usual name: `so(4)`, `su(3) + u(1)`, `e(3)`, or what is known."""
        parts = [*_semisimple_names(self.simple)]
        parts += [core.name for core in self.cores]
        parts += [self.other] if self.other else []
        parts += [] if not self.abelian else ["u(1)" if self.abelian == 1 else f"u(1)^{self.abelian}"]
        return " + ".join(parts) or "0"

    @property
    def aliases(self) -> tuple[str, ...]:
        """Other names of it, where it is simple."""
        if len(self.simple) == 1 and not self.abelian and not self.cores and not self.other:
            return tuple(name for name in self.simple[0].names if name != self.name)
        return ()

    def __str__(self) -> str:
        return self.name


_PAIRS = {(3, 3): "so(4)", (1, 1): "so(2,2)"}


def _semisimple_names(simple: tuple[RealSimple, ...]) -> list[str]:
    if len(simple) == 2 and all(s.type == ComplexType("A", 1) and not s.is_complex for s in simple):
        name = _PAIRS.get((simple[0].compact_dimension, simple[1].compact_dimension))
        if name:
            return [name]
    return [s.names[0] for s in simple]


def isomorphic(found: Identity, named: Identity) -> bool | None:
    """Whether two real Lie algebras are isomorphic, the second one of those that have names; None: not known.

    Decompositions into indecomposable ideals are unique up to isomorphism (Krull, Remak, Schmidt), and so are Levi
    subalgebras (Malcev). A summand without a name is none of those that have one, since each of these is recognised
    wherever it occurs.
    """
    if found.dimension != named.dimension or found.levi != named.levi:
        return False
    if found.abelian != named.abelian or found.simple != named.simple:
        return False
    if not found.other:
        return (True if found.is_named else None) if found.cores == named.cores else False
    missing = Counter(named.cores) - Counter(found.cores)
    if Counter(found.cores) - Counter(named.cores) or missing.total() < 2 or not found.is_open:
        return False  # `other` isn't one summand with a name either, or it would have been recognised
    return None
