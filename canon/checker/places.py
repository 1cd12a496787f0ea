"""Which names stand in which texts: as they are written, be it times 0 or behind an abbreviation.

Of 0·q a formula keeps nothing, and a file in which q is out of place there is none all the same. So names are looked up
in the texts, and in those of the definitions that they use.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from canon.checker.functions import Unreadable
from canon.checker.stated import BOTH, HOLD_NO_FORMULA, NAMING, SIDES, texts

if TYPE_CHECKING:
    from canon.checker.statement import Statement

OF_VELOCITIES = ("euler_lagrange", "noether", "legendre", "constraint", "stationary")
"""Kinds of claims in coordinates and velocities."""
WITHOUT_A_BRACKET = (*OF_VELOCITIES, "hamilton_jacobi", "group", "matrix_algebra", "bracket_invariance")
"""Kinds of claims with no formula in which the bracket in the old variables has a place."""
STILL = ("path", "field")
"""Keys of a path: functions of time alone."""
ENDS = ("from", "to", "conjugate")
"""Its times, which are numbers."""
UNITS = ("L", "M", "T", "I", "Theta", "N", "J")
"""The bases of dimensions where a claim lists none."""


class Place(NamedTuple):
    """What holds texts, the names that are out of place there, and whether a bracket in the old variables may stand.

    Names of a `basis` win over abbreviations.
    """

    value: Any
    refused: set[str]
    bracket: bool = True
    basis: frozenset[str] = frozenset()


class Written:
    """The names and functions that texts are written with, those of the definitions that they use among them."""

    def __init__(self, s: Statement, definitions: Mapping[str, Any]) -> None:
        self.s, self.definitions = s, definitions
        self._known = dict[tuple[str, frozenset[str]], tuple[set[str], set[str]]]()

    def of(self, text: Any, basis: frozenset[str] = frozenset()) -> tuple[set[str], set[str]]:
        """Names, and functions that are called. A text that is no formula has none: who wants one there says so."""
        key = str(text), basis
        if key not in self._known:
            self._known[key] = set[str](), set[str]()  # a definition by itself is refused elsewhere
            try:
                nodes = [*ast.walk(self.s.f.tree(text)[0])]
            except Unreadable:
                nodes = []
            functions = [node.func for node in nodes if isinstance(node, ast.Call)]
            names = {node.id[1:] for node in nodes if isinstance(node, ast.Name) and node not in functions}
            short = names & ({*self.definitions} - basis)
            inner = [self.of(self.definitions[name]) for name in short]
            names = (names - short).union(*(x for x, _ in inner))
            self._known[key] = names, {ast.unparse(a)[1:] for a in functions}.union(*(y for _, y in inner))
        return self._known[key]


def check_places(s: Statement, tables: Mapping[str, Any]) -> None:
    """Refuse formulas of variables that they may not use. Raises Unreadable."""
    written = Written(s, tables.get("definitions", {}))
    for value, refused, bracket, basis in (*_of_sections(s, tables), *_of_claim(s, tables)):
        for text in texts(value):
            names, calls = written.of(text, basis)
            if wrong := names & refused:
                raise Unreadable(f"{min(wrong)[:40]!r} is out of place in {text[:60]!r}")
            if "bracket" in calls and not bracket:
                raise Unreadable(f"a bracket in the old variables is out of place in {text[:60]!r}")
    claim = tables["claim"]
    if claim.get("kind") == "dimension":
        for text in (claim["equals"], *texts(claim["dimensions"])):
            names, calls = written.of(text)
            if calls or names - {*claim.get("base", UNITS)}:
                raise Unreadable(f"a dimension is a product of powers of the bases: {text[:60]!r}")


def _of_sections(s: Statement, tables: Mapping[str, Any]) -> Iterator[Place]:
    old, new = {*s.q, *s.p}, {*s.Q, *s.P}
    explicit, generating = tables.get("transformation", {}), tables.get("generating_function", {})
    yield Place(tables.get("hamiltonian", {}).get("H"), new)
    for side in "QPqp":
        yield Place(explicit.get(side), old if side in "qp" else new, side in "QP")
    if generating:
        yield Place(generating.get("F"), _of_the_rest(s, generating.get("type")), bracket=False)
    if not (explicit or generating):  # nothing relates the new variables to the old ones
        yield Place(tables.get("domain", {}), new - _own(tables["claim"]))


def _of_claim(s: Statement, tables: Mapping[str, Any]) -> Iterator[Place]:
    claim, kind = tables["claim"], tables["claim"].get("kind")
    old, new, own = {*s.q, *s.p}, {*s.Q, *s.P}, _own(tables["claim"])
    mapped = "transformation" in tables or "generating_function" in tables
    for key, value in claim.items():
        if key in HOLD_NO_FORMULA and not (kind == "hamilton_jacobi" and key == "energy"):
            continue
        side = "new" if kind == "bracket_invariance" else SIDES.get(key, "both" if kind in BOTH else "old")
        rest = _of_the_rest(s, claim.get("type")) if side == "mixed" else set[str]()
        refused = {
            "old": new, "new": old, "mixed": rest, "parameters": old | new | {s.time},
            "both": set[str]() if mapped else new,
        }[side]  # fmt: skip
        refused = refused | _besides(s, claim, str(kind), key)
        whole = not (side in ("new", "mixed", "parameters") or kind in WITHOUT_A_BRACKET or key == "structure")
        basis = frozenset({*claim.get("basis", claim.get("first", ()))} | _elements(claim))
        yield Place(value, refused - own, whole, basis if key == "structure" else frozenset())


def _besides(s: Statement, claim: Mapping[str, Any], kind: str, key: str) -> set[str]:
    """What is out of place in a key of a claim besides: of a Lagrangian the momenta, of a path all but time."""
    old, both = {*s.q, *s.p}, {*s.q, *s.p, *s.Q, *s.P}
    if kind == "stationary" and key in (*STILL, *ENDS):
        return {*both, *claim["velocities"], *([s.time] if key in ENDS else [])}
    if kind in OF_VELOCITIES:
        return {*s.p}
    if kind == "hamilton_jacobi":
        return {"S": {*s.p}, "W": {*s.p, s.time}, "energy": {*both, s.time}}.get(key, set[str]())
    if kind == "matrix_algebra" or (key == "structure" and kind in ("algebra", "group")):
        return {*both, s.time} - {*claim.get("basis", ())}
    if kind == "group":
        return both
    elements = _elements(claim)
    return old - elements if ("coordinates" in claim or elements) and kind != "algebra" else set[str]()


def _elements(claim: Mapping[str, Any]) -> set[str]:
    return {word.strip() for words in claim.get("structure", {}) for word in str(words).split(",")}


def _own(claim: Mapping[str, Any]) -> set[str]:
    return {str(n) for key in NAMING for n in texts(claim.get(key))}


def _of_the_rest(s: Statement, types: Any) -> set[str]:
    """The variables that a generating function of these types is none of."""
    found = set[str]()
    for i in range(len(s.q)):
        one = types if isinstance(types, int) else types[i]
        found |= {s.p[i] if one in (1, 2) else s.q[i], s.P[i] if one in (1, 3) else s.Q[i]}
    return found
