"""What a claim is about: the phase space and whatever lives on it."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final

from canon.claim import Claim
from canon.domain import Domain
from canon.errors import InputError
from canon.expected import listed, table, text
from canon.expression import Formula
from canon.mechanics.admissible import check_calls, check_namesakes
from canon.mechanics.extent import check_extent, recursion_told
from canon.mechanics.formulas import as_formula, check_symbols
from canon.mechanics.phase_space import PhaseSpace
from canon.substitution import QUOTIENTS, are_beside_integers, with_quotients

if TYPE_CHECKING:
    from canon.mechanics.generating_function import GeneratingFunction
    from canon.mechanics.transformation import Transformation

_OF_THE_SPACE: Final = Domain()
"""What stands for the domain of the space: this very object, and no other without conditions."""


@dataclass(frozen=True)
class Subject:
    """All that the claims of one file share.

    `domain` is the region that was asked for (`where` and `on`), that of the space if left out; what `claim` states is
    restricted to that of the space, too, and of those in which the map and its generating function were made. Each
    formula carries its own conditions besides.
    `transformation` is the explicit one. Where there is none, claims are about the transformation that the generating
    function defines: `map` is the one or the other.

    **Raises:** `InputError` where one of them is something else.
    """

    space: PhaseSpace
    hamiltonian: Formula | None = None
    generating_function: "GeneratingFunction | None" = None
    transformation: "Transformation | None" = None
    domain: Domain = _OF_THE_SPACE
    functions: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        from canon.mechanics.generating_function import GeneratingFunction
        from canon.mechanics.transformation import Transformation

        for value, kind in (
            (self.space, PhaseSpace),
            (self.generating_function, GeneratingFunction | None),
            (self.transformation, Transformation | None),
            (self.domain, Domain),
        ):
            if not isinstance(value, kind):
                raise InputError(f"what a claim is about can't be {value!r}: see what Subject is made of")
        if self.domain is _OF_THE_SPACE:
            object.__setattr__(self, "domain", self._stated_domain())
        if self.hamiltonian is not None:
            object.__setattr__(self, "hamiltonian", as_formula(self.hamiltonian, "hamiltonian"))
        functions = listed(self.functions, "names of functions", "functions")
        for name in functions:
            text(name, "functions")
        object.__setattr__(self, "functions", functions)

    @property
    def map(self) -> "Transformation | None":
        """The transformation that claims are about: the explicit one, else the one generated, else `None`."""
        if self.transformation is not None or self.generating_function is None:
            return self.transformation
        return self.generating_function.transformation()

    def claim(self, kind: str, keys: Mapping[str, object], **options: object) -> Claim:
        """The claim of this kind about this subject; `options` are `title`, `source`, `expect` and `budget`.

        **Raises:** `InputError` where a formula has a symbol that only shares its name with one of the space, or where
        two formulas have different symbols of one name, or call a function with different numbers of arguments.
        """
        table(keys, "a kind's own keys", "keys")
        domain = self._stated_domain() & self.domain
        kept = {*domain.conditions} <= {*self.domain.conditions} and {*domain.surface} <= {*self.domain.surface}
        within = self if kept else replace(self, domain=domain)
        with recursion_told():
            return within._claim(kind, keys, options)

    def _stated_domain(self) -> Domain:
        """The domain of the space, and of those in which the map and its generating function were made."""
        domain = self.space.domain
        for made in (self.transformation, self.generating_function):
            if made is not None and made.space.domain != self.space.domain:
                domain = domain & made.space.domain
        return domain

    def _claim(self, kind: str, keys: Mapping[str, object], options: Mapping[str, object]) -> Claim:
        shared = () if self.hamiltonian is None else (self.hamiltonian,)
        for formula in (*shared, *self._shared_formulas(), *_formulas(list(keys.values()))):
            check_extent(formula.expr)
        check_symbols(shared, self.space.vocabulary, "hamiltonian")
        strangers = {*self.space.new} - {*self.space.old}
        for symbol in sorted({s for form in shared for s in form.symbols & strangers}, key=str):
            said = f"{symbol} is one of the new variables: the Hamiltonian is one in the old ones"
            raise InputError(said, "hamiltonian")
        for name, value in keys.items():
            check_symbols(_formulas(value), self.space.vocabulary, f"key {name!r}")
        written = [*shared, *self._shared_formulas(), *_formulas(list(keys.values()))]
        check_namesakes(written)
        check_calls(written)
        symbols = (*self.space.vocabulary.values(), *(formula.expr for formula in written))
        if not are_beside_integers(symbols):
            return Claim(kind=kind, subject=self, keys=dict(keys), **options)  # pyright: ignore[reportArgumentType]
        form = None if self.hamiltonian is None else _with_quotients(self.hamiltonian)
        subject, table = replace(self, hamiltonian=form), {name: _with_quotients(value) for name, value in keys.items()}
        return Claim(kind=kind, subject=subject, keys=table, **options)  # pyright: ignore[reportArgumentType]

    def _shared_formulas(self) -> Iterator[Formula]:
        """The formulas of the map."""
        if self.transformation is not None and self.transformation.direction != "implicit":
            yield from self.transformation.formulas
        if self.generating_function is not None:
            yield self.generating_function.F


def _with_quotients(value: Any) -> Any:
    """A key's value with tangents as quotients, as a file's reader writes them beside integers."""
    if isinstance(value, Formula):
        return replace(value, expr=with_quotients(value.expr)) if value.expr.has(*QUOTIENTS) else value
    if isinstance(value, (tuple, list)):
        return type(value)(_with_quotients(item) for item in value)
    return {name: _with_quotients(item) for name, item in value.items()} if isinstance(value, Mapping) else value


def _formulas(value: object) -> Iterator[Formula]:
    """The formulas in a key's value: itself, or those of a list or of tables."""
    if isinstance(value, Formula):
        yield value
    elif isinstance(value, (tuple, list)):
        for item in value:
            yield from _formulas(item)
    elif isinstance(value, Mapping):
        yield from _formulas(list(value.values()))
