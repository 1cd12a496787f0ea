"""Claims about Lie algebras of functions, of matrices and of group laws, and about Casimir functions.

Structure constants are a table "A,B" = {"C": coefficient} of the basis.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp

from canon.claim import Claim
from canon.errors import InputError
from canon.expected import instance_of, listed
from canon.expression import Formula
from canon.mechanics.algebra.names import read_name
from canon.mechanics.formulas import Expression, as_formula, as_formulas
from canon.mechanics.phase_space import PhaseSpace, check_space
from canon.mechanics.subject import Subject

Structure = Mapping[str, Mapping[str, Expression]]
"""Brackets "A,B" as combinations {name: coefficient}; what isn't listed follows by antisymmetry or is 0."""
Rows = Sequence[Sequence[Expression]]


def algebra(
    space: PhaseSpace,
    basis: Mapping[str, Expression],
    *,
    equals: str | None = None,
    structure: Structure | None = None,
) -> Claim:
    """Functions, by name, close under the Poisson bracket as `equals`, say "so(4)", or with these constants."""
    formulas = {name: as_formula(f, f"basis, {name}") for name, f in _table(basis, "basis").items()}
    return _claim(space, "algebra", {"basis": formulas} | _stated(tuple(basis), equals, structure))


def matrix_algebra(
    space: PhaseSpace,
    basis: Mapping[str, Rows | sp.MatrixBase],
    *,
    equals: str | None = None,
    structure: Structure | None = None,
) -> Claim:
    """Square matrices, by name, close under [A, B], or where they don't under −i[A, B], as that Lie algebra.

    **Arguments:** `space`, for its parameters; `basis`, sympy matrices, or nested lists of expressions in parameters.

    **Raises:** `InputError` where the matrices aren't square of one size.
    """
    matrices: dict[str, tuple[tuple[Formula, ...], ...]] = {}
    size = 0
    for name, given in _table(basis, "basis").items():
        rows = given.tolist() if isinstance(given, sp.MatrixBase) else listed(given, "rows", f"basis, {name}")
        matrices[name] = tuple(as_formulas(row, f"basis, {name}") for row in rows)
        size = size or len(rows)
        if not rows or len(rows) != size or any(len(row) != size for row in matrices[name]):
            raise InputError(f"a square matrix is expected, {size} by {size} as the first of them", f"basis, {name}")
    return _claim(space, "matrix_algebra", {"basis": matrices} | _stated(tuple(basis), equals, structure))


def group(
    space: PhaseSpace,
    composition: Sequence[Expression] | None = None,
    first: Sequence[sp.Symbol] = (),
    second: Sequence[sp.Symbol] = (),
    *,
    matrix: Rows | sp.MatrixBase | None = None,
    inverse: Rows | sp.MatrixBase | None = None,
    equals: str | None = None,
    structure: Structure | None = None,
) -> Claim:
    """θ(a, b) = `composition`, of real symbols a = `first` and b = `second`, is a local group law about 0.

    Its Lie algebra has C^a_bc = f^a_cb − f^a_bc of the second-order Taylor coefficients, in the basis `first`. In place
    of the composition, `matrix` M(a) claims that the matrices near M(0) = 1 make a group with coordinates a, so that
    M(a) M(b) = M(θ(a, b)); `inverse` of a, where it is known, makes that easier.

    **Raises:** `InputError` for a matrix that isn't square, or both of them, or symbols that aren't real.
    """
    check_space(space)
    first, second = listed(first, "symbols", "first"), listed(second, "symbols", "second")
    if (composition is None) == (matrix is None) or (matrix is None) != bool(second):
        raise InputError("say the composition with both sets of symbols, or a matrix with the first")
    keys: dict[str, object] = {"first": first}
    if composition is not None:
        keys |= {"composition": as_formulas(composition), "second": second}
    for word, given in (("matrix", matrix), ("inverse", inverse)):
        if given is not None:
            keys[word] = _square(given, word)
    for symbol in (*first, *second):
        moves = not isinstance(symbol, sp.Symbol) or symbol in (*space.old, *space.new, space.t)
        if moves or not symbol.is_real:
            raise InputError(f"{symbol} is no parameter of a group: give real symbols, and none that moves")
    return _claim(space, "group", keys | _stated(tuple(x.name for x in first), equals, structure))


def _square(given: Rows | sp.MatrixBase, where: str) -> tuple[tuple[Formula, ...], ...]:
    rows: Any = given.tolist() if isinstance(given, sp.MatrixBase) else listed(given, "rows", where)
    rows = [listed(row, "entries", where) for row in rows]
    if not rows or any(len(row) != len(rows) for row in rows):
        raise InputError("a square matrix is expected", where)
    return tuple(as_formulas(row, where) for row in rows)


def casimir(space: PhaseSpace, f: Expression, coordinates: Sequence[sp.Symbol], tensor: Rows | sp.MatrixBase) -> Claim:
    """{f, x} = 0 for all coordinates x, real symbols with the brackets {x_i, x_j} = `tensor`, which obeys Jacobi."""
    given = tensor.tolist() if isinstance(tensor, sp.MatrixBase) else listed(tensor, "rows", "tensor")
    names = listed(coordinates, "symbols", "coordinates")
    for name in names:
        instance_of(name, sp.Symbol, "coordinates")
    rows = tuple(as_formulas(row, f"tensor, row {i}") for i, row in enumerate(given, 1))
    return _claim(space, "casimir", {"f": as_formula(f, "f"), "coordinates": names, "tensor": rows})


def _claim(space: PhaseSpace, kind: str, keys: Mapping[str, object]) -> Claim:
    check_space(space)
    return Subject(space, domain=space.domain, functions=space.functions).claim(kind, keys)


def _table(value: Any, where: str) -> Mapping[str, Any]:
    """The table itself; **raises** `InputError` for what is none, or has other keys than text."""
    if not isinstance(value, Mapping) or not all(isinstance(name, str) for name in value):
        raise InputError(f"a table by names is expected, not {value!r}", where)
    return value


def _stated(names: tuple[str, ...], equals: str | None, structure: Structure | None) -> dict[str, object]:
    """The keys for what is claimed of a basis with these names."""
    keys: dict[str, object] = {}
    if equals is None and structure is None:
        raise InputError("say which algebra it is: equals = a name as 'so(4)', or structure = its constants")
    if equals is not None and not isinstance(equals, str):
        raise InputError(f"the name of an algebra is expected, as 'so(4)', not {equals!r}", "equals")
    if equals is not None:
        read_name(equals)
        keys["equals"] = equals
    if structure is not None:
        keys["brackets"] = {}
        seen: set[frozenset[str]] = set()
        for pair, given in _table(structure, "structure").items():
            row = _table(given, f"structure, {pair!r}")
            words = [word.strip() for word in pair.split(",")]
            where = f"structure, {pair!r}"
            if len(words) != 2 or len(set(words)) < 2 or not {*words, *row} <= set(names):
                raise InputError(f'"A,B" = {{"C": coefficient}} is expected, of the basis {", ".join(names)}', where)
            if frozenset(words) in seen:
                raise InputError(f"the bracket of {words[0]} and {words[1]} is stated twice", where)
            seen.add(frozenset(words))
            stated = {name: as_formula(value, where) for name, value in row.items()}
            combination = {name: value for name, value in stated.items() if value.expr != 0}
            keys["brackets"] |= {",".join(words): combination}  # type: ignore[operator]
    return keys
