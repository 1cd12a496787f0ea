"""Phase space: canonical coordinates with what is assumed of them, parameters, and time."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from typing import Any

import sympy as sp

from canon.calls import function
from canon.display import latex
from canon.domain import Domain
from canon.errors import InputError
from canon.expected import instance_of
from canon.expression import Formula, read, read_relation
from canon.mechanics.admissible import check_symbol
from canon.mechanics.assumptions import check_words, symbol_with
from canon.mechanics.extent import recursion_told
from canon.mechanics.formulas import check_symbols
from canon.mechanics.relations import region_of
from canon.mechanics.stated_names import Names, as_declared, check_name, listed_names, ordered_names, stated_words
from canon.vocabulary import Vocabulary

UNSTATED = ("q__", "p__")
"""The variables of claims that are about no phase space."""


@dataclass(frozen=True, init=False)
class PhaseSpace:
    """The phase space with coordinates q, momenta p, and, where there is a transformation, new ones Q, P.

    **Arguments:**

    - `q`, `p`: names (`"x y"`, `["x", "y"]`) or sympy symbols, in the same order.
    - `new`: the pair (names of Q, names of P); at most as many pairs as old ones.
    - `time`: the name of time.
    - `positive`, `negative`, `nonnegative`, `nonzero`, `integer`, `real`, `complex`: names of which that is
      assumed; names that are not coordinates become parameters. What has no assumption is real.
    - `symbols`: the same the other way round, `{"n": ["integer", "positive"], "V": "function"}`.
    - `functions`: names of arbitrary smooth real functions.
    - `domain`: the region of which claims speak; see `where`.

    **Raises:** `InputError` when the counts differ, a name is declared twice, or assumptions contradict each other.
    """

    q: tuple[sp.Symbol, ...]
    p: tuple[sp.Symbol, ...]
    Q: tuple[sp.Symbol, ...]
    P: tuple[sp.Symbol, ...]
    t: sp.Symbol
    parameters: tuple[sp.Symbol, ...]
    functions: tuple[str, ...]
    domain: Domain = field(default_factory=Domain)
    plain: frozenset[str] = field(default=frozenset(), compare=False)
    """The names of variables that were given without an assumption: they are real unless their formula is complex."""

    def __init__(
        self,
        q: Names,
        p: Names,
        *,
        new: tuple[Names, Names] | None = None,
        time: str | sp.Symbol = "t",
        symbols: Mapping[str, str | Iterable[str]] | None = None,
        functions: Names = (),
        domain: Domain | None = None,
        positive: Names = (),
        negative: Names = (),
        nonnegative: Names = (),
        nonzero: Names = (),
        integer: Names = (),
        real: Names = (),
        complex: Names = (),  # noqa: A002 - the field's own word
    ) -> None:
        if new is not None and (isinstance(new, str) or not isinstance(new, Sequence) or len(new) != 2):
            raise InputError("new is a pair, the names of Q and those of P, as new=('Q1 Q2', 'P1 P2')", "phase_space")
        keywords = {
            "positive": positive,
            "negative": negative,
            "nonnegative": nonnegative,
            "nonzero": nonzero,
            "integer": integer,
            "real": real,
            "complex": complex,
            "function": functions,
        }
        words, given = stated_words(symbols, keywords)

        def symbol(name: str | sp.Symbol) -> sp.Symbol:
            if isinstance(name, sp.Symbol):
                check_symbol(name, "phase_space")
                check_words(name, words.get(name.name, ()))
                return name
            check_name(name)
            if "function" in words.get(name, ()):
                raise InputError(f"{name!r} is a variable, so it cannot be a function", "symbols")
            if name not in given:
                return symbol_with(name, words.get(name, ()))
            check_words(given[name], words.get(name, ()))
            return given[name]

        sides = [tuple(symbol(name) for name in ordered_names(names)) for names in (q, p, *(new or ((), ())))]
        old, momenta, new_q, new_p = sides
        moment = symbol(listed_names((time,), "time")[0])
        if not old or len(old) != len(momenta):
            raise InputError(f"{len(old)} coordinates and {len(momenta)} momenta", "phase_space")
        if len(new_q) != len(new_p):
            raise InputError(f"{len(new_q)} new coordinates and {len(new_p)} new momenta", "phase_space")
        if len(new_q) > len(old):
            raise InputError(f"{len(new_q)} new pairs, but only {len(old)} old ones", "phase_space")
        variables = (*old, *momenta, *new_q, *new_p, moment)
        taken = [variable.name for variable in variables]
        for name in taken:
            if taken.count(name) > 1:
                raise InputError(f"{name!r} is declared twice", "phase_space")
        for variable in variables:
            if variable.is_integer:
                aside = ": give time another name, as `time`" if variable == moment else ""
                raise InputError(f"{variable} is a variable, so it can't be an integer{aside}", "symbols")
        rest = [name for name in words if name not in taken]
        called = tuple(name for name in rest if "function" in words[name])
        for name in called:
            if set(words[name]) != {"function"}:
                raise InputError(
                    f"{name!r} is a function, of which nothing more is assumed here; restrict its values by "
                    f"space.where(...), as in '{name}(x) > 0'",
                    "symbols",
                )
        put = object.__setattr__
        put(self, "q", old)
        put(self, "p", momenta)
        put(self, "Q", new_q)
        put(self, "P", new_p)
        put(self, "t", moment)
        put(self, "parameters", tuple(symbol(name) for name in rest if name not in called))
        put(self, "functions", called)
        put(self, "domain", Domain())
        spoken = {name for name, given in words.items() if given}
        listed = [name for names in (q, p, *(new or ())) for name in listed_names(names) if isinstance(name, str)]
        put(self, "plain", frozenset(listed) - spoken)
        if domain is not None:
            put(self, "domain", self.with_domain(domain).domain)

    @property
    def n(self) -> int:
        """The number of degrees of freedom."""
        return len(self.q)

    @property
    def old(self) -> tuple[sp.Symbol, ...]:
        """The old variables (q, p)."""
        return self.q + self.p

    @property
    def new(self) -> tuple[sp.Symbol, ...]:
        """The new variables (Q, P); empty where there is no transformation."""
        return self.Q + self.P

    @property
    def J(self) -> sp.ImmutableMatrix:
        """The matrix J = [[0, 1], [-1, 0]] of the brackets of (q, p)."""
        n = self.n
        return sp.ImmutableMatrix(2 * n, 2 * n, lambda i, j: int(j == i + n) - int(i == j + n))

    @property
    def vocabulary(self) -> dict[str, sp.Symbol]:
        """Every name that stands for a symbol, with its symbol."""
        return {s.name: s for s in (*self.old, *self.new, self.t, *self.parameters)}

    def symbols(self, names: Names) -> sp.Symbol | tuple[sp.Symbol, ...]:
        """The symbols with these names: a tuple, or for a single name the symbol itself.

        **Raises:** `InputError` for a name that is not declared, with the nearest one that is.
        """
        found = tuple(self.symbol(name) for name in listed_names(names))
        return found[0] if len(found) == 1 else found

    def symbol(self, name: str | sp.Symbol) -> sp.Symbol:
        """The symbol with this name; **raises** `InputError` when it is not declared."""
        known = self.vocabulary
        (stated,) = listed_names((name,))
        key = stated.name if isinstance(stated, sp.Symbol) else stated
        if key not in known:
            near = get_close_matches(key, known, 1)
            hint = f"; did you mean {near[0]!r}?" if near else f"; known are {', '.join(known)}"
            raise InputError(f"{key!r} is not declared in this phase space{hint}")
        return known[key]

    def function(self, name: str) -> Any:
        """The arbitrary smooth function with this name; **raises** `InputError` when it is not declared."""
        if not isinstance(name, str) or name not in self.functions:
            raise InputError(f"{name!r} is not declared as a function")
        return function(name)

    def formula(self, text: str) -> Formula:
        """The formula that a text states, read as in a claim file; **raises** `InputError` where it cannot be."""
        if not isinstance(text, str):
            raise InputError(f"a text is expected, not {text!r}")
        return read(text, self._names())

    def _names(self) -> Vocabulary:
        return Vocabulary(
            symbols=self.vocabulary,
            functions=frozenset(self.functions),
            pairs=tuple(zip(self.q, self.p, strict=True)),
            new=frozenset(symbol.name for symbol in self.new),
        )

    def where(self, *relations: sp.Basic | str) -> "PhaseSpace":
        """The same space, with claims restricted to the region where the relations hold.

        **Arguments:** inequalities (`>=` is read as `>`: claims speak of the open part; not so among whole
        numbers), as text or from sympy; of these also `Ne`, conjunctions, and `Eq` for a surface.

        **Raises:** `InputError` for a relation that cannot hold, or that is none.
        """
        region = self.domain
        for relation in relations:
            if isinstance(relation, str):
                region = region & read_relation(relation, self._names())
            else:
                with recursion_told("domain"):
                    region = region & region_of(relation)
        return self.with_domain(region)

    def with_domain(self, domain: Domain) -> "PhaseSpace":
        """The same space with another domain.

        **Raises:** `InputError` where the domain has a symbol that only shares its name with one of the space.
        """
        if not isinstance(domain, Domain):
            raise InputError(f"a Domain is expected, not {domain!r}: write space.where(...) for relations", "domain")
        terms = [term for condition in domain.conditions for term in condition.terms]
        check_symbols([*terms, *domain.surface], self.vocabulary, "domain")
        return _copy(self, domain=domain)

    def with_complex(self, names: Names) -> "PhaseSpace":
        """The same space with the variables of these names complex."""
        known = map(self.symbol, listed_names(names))
        fresh: dict[Any, Any] = {x: symbol_with(x.name, ["complex"]) for x in known}
        sides = {side: tuple(fresh.get(x, x) for x in getattr(self, side)) for side in "qpQP"}
        domain = self.domain.substitute(fresh)
        return _copy(self, **sides, domain=domain, plain=self.plain - {x.name for x in fresh})

    def with_new(self, new: tuple[Names, Names] | None) -> "PhaseSpace":
        """The same space with other new variables (none at all for `None`)."""
        return PhaseSpace(
            self.q,
            self.p,
            new=new,
            time=self.t,
            **as_declared(self.parameters),
            functions=self.functions,
            domain=self.domain,
        )

    def swapped(self) -> "PhaseSpace":
        """The space with the roles of old and new variables exchanged: where the inverse map lives.

        **Raises:** `InputError` when there are not as many new pairs as old ones.
        """
        if len(self.Q) != self.n:
            raise InputError(f"{len(self.Q)} new pairs and {self.n} old ones cannot change places")
        return _copy(self, q=self.Q, p=self.P, Q=self.q, P=self.p)

    def __repr__(self) -> str:
        def row(symbols: tuple[sp.Symbol, ...]) -> str:
            return f"({', '.join(map(str, symbols))})"

        to = f" -> {row(self.new)}" if self.Q else ""
        more = [str(s) for s in (*self.parameters, *self.functions)]
        return f"PhaseSpace({row(self.old)}{to}{', with ' if more else ''}{', '.join(more)})"

    def _repr_latex_(self) -> str:
        def row(symbols: tuple[sp.Symbol, ...]) -> str:
            return ", ".join(latex(symbol) for symbol in symbols)

        to = f" \\mapsto ({row(self.new)})" if self.Q else ""
        return f"$({row(self.old)}){to}$"


def check_space(space: Any) -> None:
    """**Raises** `InputError` for what is no phase space."""
    instance_of(space, PhaseSpace, "space")


def _copy(space: PhaseSpace, **changes: object) -> PhaseSpace:
    """A copy with some fields changed (the constructor reads names, so `dataclasses.replace` does not serve)."""
    copy = object.__new__(PhaseSpace)
    for name in PhaseSpace.__dataclass_fields__:
        object.__setattr__(copy, name, changes.get(name, getattr(space, name)))
    return copy
