"""The typed values of one claim's keys, by the form that each of them has."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import sympy as sp

from canon.claims import algebra_keys, document, key_tables
from canon.claims.dimension_keys import bases_of, read_dimension, read_dimensions
from canon.claims.document import Table, key
from canon.claims.ends import read_end, read_side
from canon.claims.key_tables import Given
from canon.claims.keys import TENSOR, Form, Key, KeySpec
from canon.claims.names import Names
from canon.claims.sections import read_types
from canon.claims.tensors import read_tensor
from canon.errors import InputError
from canon.expression import Formula, Vocabulary
from canon.mechanics.assumptions import symbol_with


def read_keys(table: Table, spec: KeySpec, names: Names) -> Mapping[str, Any]:
    """The values of a claim's keys, typed as `canon.claims.keys` says. **Raises:** `InputError` with the place."""
    return _Keys(table, spec, names).read()


class _Keys:
    """One claim's keys while they are read."""

    def __init__(self, table: Table, spec: KeySpec, names: Names) -> None:
        self.table = table
        self.spec = spec
        self.names = names
        self.vocabulary = self._declared()
        self.coordinates: tuple[sp.Symbol, ...] | None = None

    def read(self) -> Mapping[str, Any]:
        """Each key's value, as `canon.claims.keys` types it."""
        tensor = {}
        own = [word for word in TENSOR if self.spec.keys.get(word) == TENSOR[word]]
        if any(word in self.table for word in own):
            tensor = read_tensor({word: self.table[word] for word in own if word in self.table}, self.names)
            self.coordinates = tensor["coordinates"]
            self.vocabulary = self.vocabulary.declaring({s.name: s for s in tensor["coordinates"]})
            self._check_hamiltonian(tensor["coordinates"])
        given = [word for word in self.spec.keys if word in self.table and word not in own]
        given.sort(key=lambda word: self.spec.keys[word].form not in ("name", "variable", "names", "constants"))
        values = {word: self._value(word, self.spec.keys[word], self.table[word]) for word in given}
        if "structure" in values:  # what is claimed of the basis, not the bracket that is used
            values["brackets"] = values.pop("structure")
        return values | tensor

    def _declared(self) -> Vocabulary:
        """The file's vocabulary with the names that the claim itself declares."""
        own: dict[str, sp.Symbol] = {}
        for word, entry in self.spec.keys.items():
            if word not in self.table:
                continue
            value = self.table[word]
            if entry.form in ("name", "variable") or (
                entry.form == "constant" and isinstance(value, str) and value.isidentifier()
            ):
                listed: tuple[str, ...] = (document.name(value, key(word)),)
            elif entry.form in ("names", "constants") and word != "coordinates":
                listed = document.names(value, key(word))
            else:
                continue
            own |= {name: symbol_with(name) for name in listed}
        return self.names.vocabulary.declaring(own)

    def _value(self, word: str, entry: Key, value: Any) -> Any:
        where = key(word)
        if entry.form in algebra_keys.FORMS:
            return algebra_keys.read_algebra_key(
                entry.form, self.table, word, self.names, self.vocabulary, lambda v, at: self._formula(v, entry, at)
            )
        if entry.form in ("expression", "constant"):
            return self._formula(value, entry, where)
        if entry.form == "end":
            return read_end(value, where, self.vocabulary.declares) or self._formula(value, entry, where)
        if entry.form in ("expressions", "per pair"):
            return self._formulas(word, entry, value)
        if entry.form in key_tables.FORMS:
            given = Given(self.names, self.vocabulary, self._name, lambda v, at: self._formula(v, entry, at))
            return key_tables.FORMS[entry.form](given, value, where)
        simple: Mapping[Form, Callable[[Any, str], Any]] = {
            "name": self._parameter,
            "names": self._velocities,
            "constants": self._constants,
            "number": self._number,
            "power": self._power,
            "type": self._type,
            "coordinate": self._coordinate,
            "word": document.text,
            "relation": _relation,
            "variable": self._variable,
            "side": read_side,
            "truth": _truth,
            "bases": document.names,
            "dimension": lambda v, at: read_dimension(v, bases_of(self.table), at),
            "dimensions": lambda v, at: read_dimensions(v, bases_of(self.table), self.names, at),
        }
        return simple[entry.form](value, where)

    def _formula(self, value: Any, entry: Key, where: str) -> Formula:
        types = read_types(self.table["type"], self.names.space, key("type")) if entry.side == "mixed" else ()
        allowed = None
        if self.coordinates is not None:
            allowed = [symbol.name for symbol in self.coordinates]
        elif entry.side in ("lagrangian", "jet"):
            words = ["velocities"] + ["accelerations"] * (entry.side == "jet" and "accelerations" in self.table)
            jets = [name for word in words for name in document.names(self.table[word], key(word))]
            allowed = [*(symbol.name for symbol in self.names.space.q), *jets]
        elif entry.side == "group":
            words = [word for word in ("first", "second") if word in self.table]
            allowed = [n for word in words for n in document.names(self.table[word], key(word))]
        elif entry.side == "integral":
            constants = document.names(self.table["constants"], key("constants"))
            allowed = [*([] if entry.form == "constant" else (s.name for s in self.names.space.q)), *constants]
        return self.names.formula(value, entry.side, where, types=types, vocabulary=self.vocabulary, allowed=allowed)

    def _formulas(self, word: str, entry: Key, value: Any) -> tuple[Formula, ...]:
        values = document.listing(value, key(word))
        q = self.names.space.q
        if entry.form == "per pair" and len(values) != len(q):
            wanted = ", ".join(symbol.name for symbol in q)
            raise InputError(f"{len(values)} components for the {len(q)} degrees of freedom {wanted}", key(word))
        if not values:
            raise InputError("the list is empty", key(word))
        return tuple(self._formula(v, entry, f"{key(word)}, entry {i}") for i, v in enumerate(values, 1))

    def _parameter(self, value: Any, where: str) -> sp.Symbol:
        return self._name(document.name(value, where), where)

    def _variable(self, value: Any, where: str) -> sp.Symbol:
        name = document.name(value, where)
        if name not in self.vocabulary.symbols:
            raise InputError(f"{name!r} is a function or an abbreviation, not a variable", where)
        return self.vocabulary.symbols[name]

    def _constants(self, value: Any, where: str) -> tuple[sp.Symbol, ...]:
        return tuple(self._constant(name, where) for name in document.names(value, where))

    def _type(self, value: Any, where: str) -> int | tuple[int, ...]:
        read_types(value, self.names.space, where)
        return tuple(value) if isinstance(value, list) else value

    def _name(self, name: str, where: str) -> sp.Symbol:
        """The symbol of a name that a claim's key gives: a parameter, declared in the file or by the key."""
        symbol = self.vocabulary.symbols.get(name)
        if symbol is None:
            raise InputError(f"{name!r} is a function or an abbreviation, not a parameter", where)
        if symbol in (*self.names.space.old, *self.names.space.new):
            raise InputError(f"{name!r} is a variable of [phase_space], not a parameter", where)
        return symbol

    def _constant(self, name: str, where: str) -> sp.Symbol:
        """The symbol of a constant of an integral: a name of its own, a parameter, or a new variable."""
        space = self.names.space
        symbol = self.vocabulary.symbols.get(name)
        if symbol is None:
            raise InputError(f"{name!r} is a function or an abbreviation, not a constant", where)
        if symbol in (*space.old, space.t):
            advice = "; time may be called otherwise: time = ... in [phase_space]" if symbol == space.t else ""
            raise InputError(f"{name!r} moves, so it is no constant{advice}", where)
        return symbol

    def _velocities(self, value: Any, where: str) -> tuple[sp.Symbol, ...]:
        listed = document.names(value, where)
        q = self.names.space.q
        if len(listed) != len(q):
            raise InputError(f"{len(listed)} names for {len(q)} coordinates", where)
        return tuple(self._name(name, where) for name in listed)

    def _number(self, value: Any, where: str) -> int:
        number = document.whole(value, where)
        lowest, highest = (0, 40) if "parameter" in self.spec.keys else (1, self.names.space.n)
        if "N" in self.spec.keys:
            lowest, highest = 2, key_tables.HIGHEST_DEGREE
        if not lowest <= number <= highest:
            raise InputError(f"a whole number from {lowest} to {highest} is expected, not {number}", where)
        return number

    def _coordinate(self, value: Any, where: str) -> sp.Symbol:
        name = document.name(value, where)
        for symbol in self.names.space.q:
            if symbol.name == name:
                return symbol
        wanted = ", ".join(symbol.name for symbol in self.names.space.q)
        raise InputError(f"{name!r} is none of the coordinates {wanted}", where)

    def _power(self, value: Any, where: str) -> tuple[sp.Symbol, int]:
        items = document.listing(value, where)
        if len(items) != 2 or not isinstance(items[0], str):
            raise InputError('a name and a number are expected, as in order = ["eps", 2]', where)
        order = document.whole(items[1], where)
        if not 0 <= order <= 40:
            raise InputError(f"an order from 0 to 40 is expected, not {order}", where)
        return self._name(document.name(items[0], where), where), order

    def _check_hamiltonian(self, coordinates: tuple[sp.Symbol, ...]) -> None:
        """Refuse a Hamiltonian in phase-space variables that the tensor's bracket doesn't know."""
        if self.table["kind"] != "conserved" or self.names.hamiltonian is None:
            return
        space = self.names.space
        outside = {s.name for s in (*space.old, *space.new)} - {s.name for s in coordinates}
        for name in sorted(outside & self.names.hamiltonian.names):
            raise InputError(f"H depends on {name!r}, which is not among the coordinates", key("coordinates"))


def _relation(value: Any, where: str) -> str:
    if value not in ("<", "<=", ">", ">="):
        raise InputError("one of < <= > >= is expected", where)
    return value


def _truth(value: Any, where: str) -> bool:
    if not isinstance(value, bool):
        raise InputError(f"true or false is expected, not {document.kind_of(value)}", where)
    return value
