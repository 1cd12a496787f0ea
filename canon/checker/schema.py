"""Which sections and keys a claim has, and what each may hold: a certificate of anything else is one of no claim.

The rules of each kind read the keys that they know. What they don't read, or read as something else (1 for true, a
text for a list of letters, a pair of a basis that is stated twice), would let the same table say one thing to its
reader and another to the checker. What a key may hold is written down here, for every kind; nothing else is read.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from canon.checker.algebra_names import is_name
from canon.checker.functions import ARITIES, Unknown, Unreadable

SECTIONS: dict[str, set[str] | None] = {
    "title": None, "source": None, "symbols": None, "definitions": None, "claim": None,
    "phase_space": {"q", "p", "Q", "P", "time"}, "hamiltonian": {"H"}, "generating_function": {"type", "F"},
    "transformation": {"q", "p", "Q", "P"}, "domain": {"where", "on"},
}  # fmt: skip
"""The sections of a file, and the keys of those that have the same ones always."""
COMMON = {"kind": "label", "title": "label", "source": "label", "expect": "expected", "budget": "seconds"}
_TENSOR = {"tensor": "matrix", "coordinates": "names", "structure": "brackets"}
_NAMED = {"equals": "algebra", "structure": "combinations"}
_ACTION = {
    "coordinate": "name", "energy": "name", "branch": "branch", "period": "text", "well": "text", "fixed": "values",
    "equals": "text",
}  # fmt: skip
_MOTION = {"L": "text", "velocities": "names"}
KEYS: dict[str, dict[str, str]] = {
    "canonical": {"scale": "text", "order": "power"}, "fundamental_brackets": {}, "volume": {}, "symmetry": {},
    "canonical_when": {"solutions": "solutions"}, "bracket_invariance": {"f": "text", "g": "text"},
    "integral_invariant": {"order": "whole"}, "cartan_invariant": {"K": "text"}, "generates": {},
    "generating_function": {"type": "types", "F": "text"}, "new_hamiltonian": {"K": "text"},
    "bracket": {"f": "text", "g": "text", "equals": "text", **_TENSOR}, "conserved": {"f": "text", **_TENSOR},
    "jacobi": {"f": "text", "g": "text", "h": "text", **_TENSOR}, "involution": {"functions": "several", **_TENSOR},
    "casimir": {"f": "text", **_TENSOR}, "independent": {"functions": "texts"},
    "lie_series": {"generator": "text", "parameter": "name", "f": "text", "equals": "text", "order": "whole"},
    "infinitesimal": {"generator": "text", "dq": "texts", "dp": "texts"},
    "equations_of_motion": {"qdot": "texts", "pdot": "texts"},
    "hamiltonian_field": {"qdot": "texts", "pdot": "texts", "H": "text"}, "legendre": _MOTION,
    "euler_lagrange": {
        **_MOTION, "accelerations": "names", "dissipation": "text", "forces": "texts", "equations": "texts",
        "qddot": "texts",
    },
    "noether": {**_MOTION, "dq": "texts", "dt": "text", "f": "text", "charge": "text"},
    "hamilton_jacobi": {"S": "text", "W": "text", "constants": "names", "energy": "text"},
    "solves": {"solution": "values", "equations": "texts"}, "action_angle": {"angle_period": "text"},
    "action": _ACTION, "frequency": _ACTION, "normal_form": {"order": "whole", "N": "degrees"},
    "algebra": {"basis": "values", **_NAMED, "tensor": "matrix", "coordinates": "names"},
    "matrix_algebra": {"basis": "matrices", **_NAMED},
    "group": {"composition": "texts", "first": "names", "second": "names", "matrix": "matrix", "inverse": "matrix",
              **_NAMED},
    "field_equations": {"L": "text", "fields": "texts", "equations": "texts"},
    "invariant_interval": {"matrix": "matrix", "metric": "matrix", "inverse": "matrix"},
    "matrix_group": {
        "matrix": "matrix", "first": "names", "second": "names", "composition": "texts", "inverse": "texts",
    },
    "constraint": {
        **_MOTION, "forms": "texts", "functions": "texts", "holonomic": "truth", "stationary": "truth",
        "integrals": "texts", "possible": "texts", "virtual": "texts", "qddot": "texts", "multipliers": "texts",
        "forces": "texts", "determined": "truth",
    },
    "dimension": {"functions": "texts", "dimensions": "dimensions", "equals": "text", "base": "names"},
    "limit": {"f": "text", "variable": "name", "to": "text", "side": "side", "equals": "text"},
    "integral": {"f": "text", "variable": "name", "from": "text", "to": "text", "equals": "text",
                 "antiderivative": "text"},
    "stationary": {
        **_MOTION, "path": "texts", "from": "text", "to": "text", "extremum": "label", "field": "fields",
        "conjugate": "texts",
    },
    "average": {
        "f": "text", "equals": "text", "virial": "text", "bound": "text", "parameter": "name", "motion": "values",
        "from": "text", "to": "text", "antiderivative": "text", "coordinate": "name", "energy": "name",
        "branch": "branch", "well": "text", "fixed": "values",
    },
    "inequality": {"lhs": "text", "relation": "label", "rhs": "text"}, "identity": {"lhs": "text", "rhs": "text"},
}  # fmt: skip
"""The keys of each kind of claim, and the form of what they hold."""
DECLARING = (
    "parameter", "velocities", "accelerations", "coordinates", "constants", "energy", "first", "second", "variable",
)  # fmt: skip
"""Keys with names of a claim's own: these are no abbreviations, and no functions."""
OPPOSITE = (
    {"positive", "negative"}, {"negative", "nonnegative"}, {"complex", "positive"}, {"complex", "negative"},
    {"complex", "nonnegative"}, {"complex", "integer"}, {"complex", "real"},
)  # fmt: skip
"""Words that can't both be so."""
WITH_FUNCTION = {"function", "real", "positive", "negative", "nonzero"}
BARE = ("matrix_algebra", "group", "matrix_group", "invariant_interval")
"""Kinds of claims without a phase space."""


def check_tables(tables: Any) -> None:
    """Refuse tables that no claim file has. Raises Unreadable."""
    _sections(tables)
    claim, kind = tables["claim"], tables["claim"].get("kind")
    if not isinstance(kind, str) or kind not in KEYS:
        return  # there is no rule for it, which is said elsewhere
    forms = {**KEYS[kind], **COMMON}
    for key, value in claim.items():
        if key not in forms:
            raise Unreadable(f"a claim of kind {kind[:40]!r} has no key {str(key)[:40]!r}")
        if not FORMS[forms[key]](value):
            raise Unreadable(f"what the key {key!r} holds isn't what it is for: {str(value)[:60]}")
    own = {str(name) for key in DECLARING if key in claim for name in _listed(claim[key])}
    own -= {str(claim.get("energy"))} if forms.get("energy") == "text" else set()
    own |= {claim["order"][0]} if "order" in claim and forms["order"] == "power" else set()
    if taken := own & ({*tables.get("definitions", {})} | _functions(tables)):
        raise Unreadable(f"{min(taken)[:40]!r} is a function or an abbreviation, no name of the claim's own")
    if "tensor" in claim and len(claim["tensor"]) != len(claim.get("coordinates", ())):
        raise Unreadable("a tensor has a row for each of its coordinates")
    if {*_NAMED} <= forms.keys() and not {*_NAMED} & claim.keys():
        raise Unreadable(f"a claim of kind {kind[:40]!r} names an algebra, or its structure constants")
    if {"structure", "tensor"} <= claim.keys() and "basis" not in claim:
        raise Unreadable("a bracket is stated by a tensor or by structure constants, not by both")
    names = claim.get("basis", claim.get("first", claim.get("coordinates")))
    if names is not None and not {*_paired(claim.get("structure", {}))} <= {*names}:
        raise Unreadable("structure constants of what isn't in the basis")


def check_known(known: Any) -> None:
    """Refuse what a certificate may not add to a claim. Raises Unreadable."""
    if not _are_pairs(_table(known, "what the claim leaves open").get("structure", {})):
        raise Unreadable("structure constants are a table of pairs, each of which stands once")
    if "torus" in known and not _is_torus(known["torus"]):
        raise Unreadable("a torus has its cycles, tables of texts, and whole numbers of turns round them")


def _sections(tables: Any) -> None:
    """The sections that are the same for all claims."""
    for section, value in _table(tables, "a certificate's tables").items():
        if section not in SECTIONS:
            raise Unreadable(f"there is no section {str(section)[:40]!r}")
        if section in ("title", "source"):
            if not isinstance(value, str):
                raise Unreadable(f"{section}: a text is expected")
            continue
        if unknown := {*_table(value, section)} - (SECTIONS[section] or {*value}):
            raise Unreadable(f"[{section}] has no key {str(min(unknown))[:40]!r}")
    space, claim = tables.get("phase_space", {}), tables["claim"]
    if not all(_are_names(space[side]) or space[side] == [] for side in "qpQP" if side in space):
        raise Unreadable("the variables of a phase space are lists of names")
    if not _is_name(space.get("time", "t")) or not all(map(_is_name, [*tables.get("symbols", {})])):
        raise Unreadable("a name is expected")
    olds, news = ([len(space.get(side, [])) for side in pair] for pair in ("qp", "QP"))
    if len({*olds}) > 1 or len({*news}) > 1 or news[0] > olds[0]:
        raise Unreadable("as many momenta as coordinates are needed, and no more new variables than old ones")
    if "transformation" in tables and not (tables["transformation"] and news[0]):
        raise Unreadable("a map to no new variables")
    if news != olds and ({"q", "p"} & {*tables.get("transformation", {})} or "generating_function" in tables):
        raise Unreadable("as many new variables as old ones are needed where these are given by them")
    if "phase_space" in tables and not space.get("q") and claim.get("kind") not in BARE:
        raise Unreadable("at least one coordinate is needed")
    for words in tables.get("symbols", {}).values():
        said = {words} if isinstance(words, str) else {*words} if _are_texts(words) else {0}
        if 0 in said or any(pair <= said for pair in OPPOSITE) or ("function" in said and said - WITH_FUNCTION):
            raise Unreadable(f"assumptions that say nothing, or too much: {str(words)[:60]}")
    if found := _functions(tables) & {*ARITIES, "power", "pi"}:
        raise Unknown(f"a file in which {min(found)} is something else")
    texts = [*tables.get("definitions", {}).values(), *tables.get("hamiltonian", {}).values()]
    texts += [tables["generating_function"].get("F")] if "generating_function" in tables else []
    lists = [*tables.get("transformation", {}).values(), *tables.get("domain", {}).values()]
    if not all(map(_is_text, texts)) or not all(value == [] or _are_texts(value) for value in lists):
        raise Unreadable("formulas are texts, and several are a list of texts")
    if "generating_function" in tables and not _are_types(tables["generating_function"].get("type")):
        raise Unreadable("the types of generating functions are 1, 2, 3 and 4")


def _table(value: Any, what: str) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise Unreadable(f"{what}: a table is expected")
    return value


def _functions(tables: Any) -> set[str]:
    return {name for name, words in tables.get("symbols", {}).items() if "function" in _listed(words)}


def _listed(value: Any) -> list[Any]:
    return value if isinstance(value, list) else [value]


# -- forms ------------------------------------------------------------------------------------------


def _is_whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _is_text(value: Any) -> bool:
    """A formula; how often a function is differentiated is written in brackets by certificates alone."""
    return "[" not in value if isinstance(value, str) else _is_whole(value)


def _is_name(value: Any) -> bool:
    return isinstance(value, str) and unicodedata.normalize("NFKC", value).isidentifier()


def _is_list_of(value: Any, rule: Callable[[Any], bool]) -> bool:
    return isinstance(value, list) and bool(value) and all(map(rule, value))


def _are_texts(value: Any) -> bool:
    return _is_list_of(value, _is_text)


def _are_names(value: Any) -> bool:
    return _is_list_of(value, _is_name) and len({*value}) == len(value)


def _are_types(value: Any) -> bool:
    one: Callable[[Any], bool] = lambda x: _is_whole(x) and 1 <= x <= 4
    return one(value) or _is_list_of(value, one)


def _is_matrix(value: Any) -> bool:
    """A square one."""
    return _is_list_of(value, _are_texts) and all(len(row) == len(value) for row in value)


def _is_table_of(value: Any, rule: Callable[[Any], bool]) -> bool:
    return isinstance(value, Mapping) and bool(value) and all(map(rule, value.values()))


def _is_torus(value: Any) -> bool:
    """What `alone_tori.py` reads; here it is trusted for nothing."""
    if not isinstance(value, Mapping) or {*value} != {"cycles", "turns"}:
        return False
    cycle: Callable[[Any], bool] = lambda one: _is_table_of(one, lambda text: isinstance(text, str))
    return _is_list_of(value["cycles"], cycle) and _is_list_of(value["turns"], lambda row: _is_list_of(row, _is_whole))


def _paired(structure: Any) -> Iterator[str]:
    """The names in the pairs of a table "A,B" = …"""
    for words in structure:
        yield from (word.strip() for word in str(words).split(","))


def _are_pairs(value: Any) -> bool:
    """A table "A,B" = formula with each pair of two different names once."""
    if not isinstance(value, Mapping) or not all(map(_is_text, value.values())):
        return False
    pairs = [[word.strip() for word in str(words).split(",")] for words in value]
    if any(len(pair) != 2 or pair[0] == pair[1] or not all(map(_is_name, pair)) for pair in pairs):
        return False
    return len({frozenset(pair) for pair in pairs}) == len(pairs)


def _is_power(value: Any) -> bool:
    return isinstance(value, list) and len(value) == 2 and _is_name(value[0]) and _is_whole(value[1])


def _are_fields(value: Any) -> bool:
    return _is_text(value) or _is_list_of(value, _are_texts)


def _are_dimensions(value: Any) -> bool:
    return isinstance(value, Mapping) and all(_is_text(row) or _are_texts(row) for row in value.values())


def _are_degrees(value: Any) -> bool:
    """A table degree = formula, the degrees in plain digits; of a normal form that is H₂ alone, an empty one."""
    return value == {} or (_is_table_of(value, _is_text) and all(key.isascii() and key.isdecimal() for key in value))


FORMS: dict[str, Callable[[Any], bool]] = {
    "expected": lambda x: x in ("holds", "fails", "proved", "refuted", "supported", "undecided"),
    "seconds": lambda x: isinstance(x, (int, float)) and not isinstance(x, bool) and x > 0,
    "label": lambda x: isinstance(x, str), "text": _is_text, "texts": _are_texts,
    "several": lambda x: _are_texts(x) and len(x) > 1,
    "name": _is_name, "names": _are_names, "whole": _is_whole,
    "types": _are_types, "power": _is_power, "truth": lambda x: isinstance(x, bool), "matrix": _is_matrix,
    "values": lambda x: _is_table_of(x, _is_text), "matrices": lambda x: _is_table_of(x, _is_matrix),
    "solutions": lambda x: _is_list_of(x, lambda row: _is_table_of(row, _is_text)), "brackets": _are_pairs,
    "combinations": _are_pairs, "branch": lambda x: x in ("libration", "rotation"), "side": lambda x: x in ("+", "-"),
    "algebra": is_name, "fields": _are_fields, "degrees": _are_degrees, "dimensions": _are_dimensions,
}  # fmt: skip
