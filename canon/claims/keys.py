"""Which keys each kind of claim takes, what they hold, and what else a file must state for it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final, Literal

Form = Literal[
    "expression", "expressions", "per pair", "name", "names", "number", "power", "tables", "type", "matrix",
    "structure", "constants", "constant", "functions", "calls", "degrees", "basis", "matrices", "algebra", "brackets",
    "values", "coordinate", "word", "relation", "square", "truth", "bases", "dimension", "dimensions",
    "variable", "end", "side", "fields",
]  # fmt: skip
"""What a key holds: an expression; a list of them; one for each old pair; a name, or a list; a whole number;
`["eps", 2]`; a list of tables name = value; a type 1 to 4 or one per pair; nested lists; a table "A,B" = value; names
of constants, which may be new variables; an expression of constants, or the name of one that it declares; a table
"x(t)" = formula of functions that the file declares; a table degree = polynomial; a table name = expression, or
name = matrix; the name of a Lie algebra; a table "A,B" = combination of a basis; a table name =
value of constants; one of the coordinates; a word; a relation; a square matrix; true or false; the base quantities
of dimensions; a dimension; a table name = dimension; a name that may be a variable; an expression or an infinity; "+"
or "-"; an expression, or a list of lists of one for each coordinate."""

Side = Literal["old", "new", "mixed", "both", "parameters", "lagrangian", "jet", "integral", "group"]
"""The variables that a formula may use: old or new ones; for each pair those of the generating function's type; both;
none at all; coordinates and velocities; these and accelerations; coordinates and the constants of an integral; the
parameters of two elements of a group. Parameters and (but for "parameters") time are open to all."""

Need = Literal["hamiltonian", "transformation", "generating_function", "map", "square"]
"""What a kind needs of its file: sections; `map`, a transformation or a generating function; `square`, as many new
pairs as old ones."""

COMMON: Final = ("kind", "title", "source", "expect", "budget")
"""The keys that every claim may have."""


@dataclass(frozen=True)
class Key:
    """One key: its form, the variables open to it, and whether it may be left out."""

    form: Form = "expression"
    side: Side = "old"
    optional: bool = False


@dataclass(frozen=True)
class KeySpec:
    """The keys of a kind and what it needs of its file."""

    keys: Mapping[str, Key] = field(default_factory=dict)
    needs: tuple[Need, ...] = ()


_OLD: Final = Key()
_NEW: Final = Key(side="new")
_PER_PAIR: Final = Key("per pair")
_LAGRANGIAN: Final = Key(side="lagrangian")
TENSOR: Final[Mapping[str, Key]] = {
    "tensor": Key("matrix", optional=True),
    "coordinates": Key("names", optional=True),
    "structure": Key("structure", optional=True),
}
"""The keys that put another Poisson bracket in place of the canonical one."""

WRITTEN: Final[Mapping[str, str]] = {"brackets": "structure"}
"""Keys that the reader of files makes of others: what is claimed of a basis, not the bracket that is used."""

_EQUALS: Final[Mapping[str, Key]] = {
    "equals": Key("algebra", optional=True),
    "structure": Key("brackets", optional=True),
}

_ACTION: Final[Mapping[str, Key]] = {
    "coordinate": Key("coordinate"),
    "energy": Key("name"),
    "branch": Key("word", optional=True),
    "period": Key(side="parameters", optional=True),
    "well": Key(side="parameters", optional=True),
    "fixed": Key("values", "parameters", optional=True),
    "equals": Key(),
}

KEYS: Final[Mapping[str, KeySpec]] = {
    "canonical": KeySpec(
        {"scale": Key(side="parameters", optional=True), "order": Key("power", optional=True)}, ("map",)
    ),
    "canonical_when": KeySpec({"solutions": Key("tables", "parameters")}, ("map",)),
    "fundamental_brackets": KeySpec({}, ("map",)),
    "bracket_invariance": KeySpec({"f": _NEW, "g": _NEW}, ("map",)),
    "volume": KeySpec({}, ("map", "square")),
    "integral_invariant": KeySpec({"order": Key("number", optional=True)}, ("map", "square")),
    "cartan_invariant": KeySpec({"K": _NEW}, ("hamiltonian", "map", "square")),
    "generates": KeySpec({}, ("generating_function", "transformation", "square")),
    "generating_function": KeySpec({"type": Key("type"), "F": Key(side="mixed")}, ("transformation", "square")),
    "new_hamiltonian": KeySpec({"K": _NEW}, ("hamiltonian", "map", "square")),
    "symmetry": KeySpec({}, ("hamiltonian", "map", "square")),
    "bracket": KeySpec({"f": _OLD, "g": _OLD, "equals": _OLD, **TENSOR}),
    "jacobi": KeySpec({"f": _OLD, "g": _OLD, "h": _OLD, **TENSOR}),
    "conserved": KeySpec({"f": _OLD, **TENSOR}, ("hamiltonian",)),
    "involution": KeySpec({"functions": Key("expressions"), **TENSOR}),
    "independent": KeySpec({"functions": Key("expressions")}),
    "lie_series": KeySpec(
        {"generator": _OLD, "parameter": Key("name"), "f": _OLD, "equals": _OLD, "order": Key("number", optional=True)}
    ),
    "infinitesimal": KeySpec({"generator": _OLD, "dq": _PER_PAIR, "dp": _PER_PAIR}),
    "equations_of_motion": KeySpec({"qdot": _PER_PAIR, "pdot": _PER_PAIR}, ("hamiltonian",)),
    "hamiltonian_field": KeySpec({"qdot": _PER_PAIR, "pdot": _PER_PAIR, "H": Key(optional=True)}),
    "legendre": KeySpec({"L": _LAGRANGIAN, "velocities": Key("names")}, ("hamiltonian",)),
    "euler_lagrange": KeySpec(
        {
            "L": _LAGRANGIAN,
            "velocities": Key("names"),
            "accelerations": Key("names", optional=True),
            "dissipation": Key(side="lagrangian", optional=True),
            "forces": Key("per pair", "lagrangian", optional=True),
            "equations": Key("per pair", "jet", optional=True),
            "qddot": Key("per pair", "lagrangian", optional=True),
        }
    ),
    "noether": KeySpec(
        {
            "L": _LAGRANGIAN,
            "velocities": Key("names"),
            "dq": Key("per pair", "lagrangian"),
            "dt": Key(side="lagrangian", optional=True),
            "f": Key(side="lagrangian", optional=True),
            "charge": Key(side="lagrangian", optional=True),
        }
    ),
    "hamilton_jacobi": KeySpec(
        {
            "S": Key(side="integral", optional=True),
            "W": Key(side="integral", optional=True),
            "constants": Key("constants"),
            "energy": Key("constant", "integral", optional=True),
        },
        ("hamiltonian",),
    ),
    "solves": KeySpec(
        {"solution": Key("functions", "both"), "equations": Key("expressions", "both")},
    ),
    "action_angle": KeySpec({"angle_period": Key(side="parameters", optional=True)}, ("hamiltonian", "map", "square")),
    "action": KeySpec(_ACTION, ("hamiltonian",)),
    "frequency": KeySpec(_ACTION, ("hamiltonian",)),
    "normal_form": KeySpec({"order": Key("number"), "N": Key("degrees")}, ("hamiltonian",)),
    "algebra": KeySpec(
        {"basis": Key("basis"), **_EQUALS, "tensor": TENSOR["tensor"], "coordinates": TENSOR["coordinates"]}
    ),
    "matrix_algebra": KeySpec({"basis": Key("matrices", "parameters"), **_EQUALS}),
    "group": KeySpec(
        {
            "composition": Key("expressions", "group", optional=True),
            "first": Key("constants"),
            "second": Key("constants", optional=True),
            "matrix": Key("square", "group", optional=True),
            "inverse": Key("square", "group", optional=True),
            **_EQUALS,
        }
    ),
    "casimir": KeySpec({"f": _OLD, **TENSOR}),
    "field_equations": KeySpec(
        {"L": Key(side="both"), "fields": Key("calls", "both"), "equations": Key("expressions", "both")},
    ),
    "invariant_interval": KeySpec(
        {
            "matrix": Key("square", "both"),
            "metric": Key("square", "both"),
            "inverse": Key("square", "both", optional=True),
        }
    ),
    "matrix_group": KeySpec(
        {
            "matrix": Key("square", "both"),
            "first": Key("constants"),
            "second": Key("constants"),
            "composition": Key("expressions", "both"),
            "inverse": Key("expressions", "both", optional=True),
        }
    ),
    "constraint": KeySpec(
        {
            "velocities": Key("names"),
            "forms": Key("expressions", "lagrangian", optional=True),
            "functions": Key("expressions", "lagrangian", optional=True),
            "holonomic": Key("truth", optional=True),
            "stationary": Key("truth", optional=True),
            "integrals": Key("expressions", "lagrangian", optional=True),
            "possible": Key("per pair", "lagrangian", optional=True),
            "virtual": Key("per pair", "lagrangian", optional=True),
            "L": Key(side="lagrangian", optional=True),
            "qddot": Key("per pair", "lagrangian", optional=True),
            "multipliers": Key("expressions", "lagrangian", optional=True),
            "forces": Key("per pair", "lagrangian", optional=True),
            "determined": Key("truth", optional=True),
        }
    ),
    "dimension": KeySpec(
        {
            "functions": Key("expressions", "both"),
            "dimensions": Key("dimensions"),
            "equals": Key("dimension"),
            "base": Key("bases", optional=True),
        }
    ),
    "limit": KeySpec(
        {
            "f": _OLD,
            "variable": Key("variable"),
            "to": Key("end"),
            "side": Key("side", optional=True),
            "equals": Key("end"),
        }
    ),
    "integral": KeySpec(
        {
            "f": _OLD,
            "variable": Key("variable"),
            "from": Key("end"),
            "to": Key("end"),
            "equals": _OLD,
            "antiderivative": Key(optional=True),
        }
    ),
    "stationary": KeySpec(
        {
            "L": _LAGRANGIAN,
            "velocities": Key("names"),
            "path": _PER_PAIR,
            "from": Key("end"),
            "to": Key("end"),
            "extremum": Key("word", optional=True),
            "field": Key("fields", optional=True),
            "conjugate": Key("expressions", optional=True),
        }
    ),
    "average": KeySpec(
        {
            "f": _OLD,
            "equals": _OLD,
            "virial": Key(optional=True),
            "bound": Key(optional=True),
            "parameter": Key("variable", optional=True),
            "motion": Key("values", optional=True),
            "from": Key("end", optional=True),
            "to": Key("end", optional=True),
            "antiderivative": Key(optional=True),
            "coordinate": Key("coordinate", optional=True),
            "energy": Key("name", optional=True),
            "branch": Key("word", optional=True),
            "well": Key(side="parameters", optional=True),
            "fixed": Key("values", "parameters", optional=True),
        }
    ),
    "inequality": KeySpec({"lhs": Key(side="both"), "relation": Key("relation"), "rhs": Key(side="both")}),
    "identity": KeySpec({"lhs": Key(side="both"), "rhs": Key(side="both")}),
}
"""The kinds that this version checks."""
