"""Is a claim stated as a claim file may state it? Names that are distinct, formulas of the variables open to them.

A certificate could else be about a text that says something else to its reader than to the checker: {Q, p} = 0, as Q is
no function of q when the bracket is taken; a definition that gives a coordinate's name to something else.
"""

from __future__ import annotations

import ast
import re
import unicodedata
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from canon.checker.functions import Unknown, Unreadable

if TYPE_CHECKING:
    from canon.checker.statement import Statement

WORDS = {"real", "complex", "positive", "negative", "nonnegative", "nonzero", "integer", "function"}
BOTH = ("identity", "inequality", "field_equations", "invariant_interval", "matrix_group", "solves", "dimension")
"""Kinds of claims whose formulas may mix old and new variables."""
SIDES = {
    "K": "new", "F": "mixed", "scale": "parameters", "solutions": "parameters", "period": "parameters",
    "well": "parameters", "fixed": "parameters", "angle_period": "parameters",
}  # fmt: skip
"""Of keys of claims: the variables that their formulas may use; where nothing is said, the old ones."""
NAMING = (
    "parameter", "velocities", "accelerations", "coordinates", "constants", "energy", "order", "first", "second",
    "variable",
)  # fmt: skip
"""The keys of claims that declare names."""
_NAME = re.compile(r"[^\W\d]\w*")
FRESH = ("velocities", "accelerations", "first", "second")
"""Those of which the names are no variables."""
HOLD_NO_FORMULA = {
    "kind", "title", "source", "expect", "budget", "coordinate", "branch", "relation", "side", "type", "extremum",
    "fields", *NAMING,
}  # fmt: skip

MAPPED = ("canonical", "canonical_when", "fundamental_brackets", "bracket_invariance")
SQUARE = (
    "volume", "integral_invariant", "cartan_invariant", "generates", "generating_function", "new_hamiltonian",
    "symmetry", "action_angle",
)  # fmt: skip
"""Kinds of claims about a map, the latter about one with as many new pairs as old ones."""


NO_TIME = "#t"
"""What time is called in a file in which nothing moves with it."""


def time_of(tables: Mapping[str, Any]) -> str:
    """The name of time: "t", where the file doesn't say; but what the file calls so itself is that, and no time."""
    space, symbols = tables["phase_space"], tables.get("symbols", {})
    own = {name for side in "qpQP" for name in space.get(side, [])} | {*tables.get("definitions", {})}
    own |= {name for name, words in symbols.items() if "function" in (words if isinstance(words, list) else [words])}
    return str(space.get("time", NO_TIME if "t" in own else "t"))


def own_names(claim: dict[str, Any]) -> set[str]:
    """The names that a claim has for something of its own."""
    held = [dict.get(claim, key, []) for key in NAMING]  # which doesn't say that the keys were read
    return {str(name) for value in held for name in (value if isinstance(value, list) else [value])}


def check_names(tables: Mapping[str, Any]) -> None:
    """Refuse names that are declared twice, and words that say nothing. Raises Unreadable."""
    space, symbols = tables["phase_space"], tables.get("symbols", {})
    sides = {side: list(space.get(side, [])) for side in "qpQP"}
    names = [name for side in sides.values() for name in side]
    claim = tables["claim"]
    own = [
        n
        for key in NAMING
        if key != "energy"
        for n in (claim[key] if isinstance(claim.get(key), list) else [claim.get(key)])
    ]
    for name in (*names, space.get("time", "t"), *symbols, *tables.get("definitions", {}), *own):
        if isinstance(name, str) and not _NAME.fullmatch(unicodedata.normalize("NFKC", name)):
            raise Unreadable(f"{name[:40]!r} is no name")
        if name == "pi":
            raise Unknown("a file in which pi is something else")
    if len(sides["q"]) != len(sides["p"]) or len(sides["Q"]) != len(sides["P"]):
        raise Unreadable("as many momenta as coordinates are needed")
    given = [*names, *([space["time"]] if "time" in space else [])]
    if len({*given}) < len(given):
        raise Unreadable("a name stands twice in the phase space")
    taken = {*given, *symbols, space.get("time", "t")}
    for name in tables.get("definitions", {}):
        if name in taken and not (name == "t" and "time" not in space):
            raise Unreadable(f"{name[:40]!r} is declared, and defined as something else")
    time = time_of(tables)
    for names_of in (claim[key] for key in FRESH if isinstance(claim.get(key), list)):
        if len({*names_of}) < len(names_of) or {*names_of} & {*given, time}:
            raise Unreadable("a name of the claim's own stands twice, or is a variable")
    if functions := {*given, time} & {name for name, words in symbols.items() if "function" in _listed(words)}:
        raise Unreadable(f"{min(functions)[:40]!r} is a variable, and no function")
    if claim.get("kind") in ("action", "frequency", "average") and claim.get("energy") in given:
        raise Unreadable("an energy is a constant, and no variable")
    if claim.get("variable") in {*sides["Q"], *sides["P"]}:
        raise Unreadable("what a formula of old variables is looked at along is none of the new ones")
    if {*sides["Q"], *sides["P"]} & {str(name) for name in _listed(claim.get("coordinates", []))} and _has_map(tables):
        raise Unreadable("a tensor of new variables beside a map")
    _check_values(claim, {n for n, words in symbols.items() if "function" not in _listed(words)}, sides, time)
    varied = [
        *given,
        space.get("time", "t"),
        *([*own, claim.get("energy")] if claim.get("kind") != "matrix_group" else []),
    ]
    for name, words in symbols.items():
        if name in varied and (words == "integer" or "integer" in [*words]):
            raise Unreadable(f"{name[:40]!r} is an integer: there is no derivative by it")
        if unknown := {words} - WORDS if isinstance(words, str) else {*words} - WORDS:
            raise Unreadable(f"{min(unknown)[:40]!r} is no assumption on {name[:40]!r}")


def _check_values(claim: Mapping[str, Any], symbols: set[str], sides: Mapping[str, list[str]], time: str) -> None:
    """Refuse values of what is not declared, or moves. Raises Unreadable."""
    variables = {name for side in sides.values() for name in side}
    for name in (name for table in claim.get("solutions", []) for name in table):
        if name not in symbols or name in {*variables, time}:
            raise Unreadable(f"{name[:40]!r} is no parameter that is declared")
    own = claim.get("coordinate")
    moving = {own, time, *(p for q, p in zip(sides["q"], sides["p"], strict=True) if q == own)}
    for name in claim.get("fixed", {}):
        if name not in {*symbols, *variables, claim.get("energy")} or name in moving:
            raise Unreadable(f"{name[:40]!r} is not declared, or moves: it can't be held fixed")


def _listed(value: Any) -> list[Any]:
    return value if isinstance(value, list) else [value]


def _has_map(tables: Mapping[str, Any]) -> bool:
    return "transformation" in tables or "generating_function" in tables


def check_sides(s: Statement, tables: Mapping[str, Any]) -> None:
    """Refuse claims about a map that isn't there, and derivatives by what depends on it. Raises Unreadable."""
    old, new = {*s.q, *s.p}, {*s.Q, *s.P}
    explicit, generating = tables.get("transformation", {}), tables.get("generating_function", {})
    if {"Q", "P"} & {*explicit} and {"q", "p"} & {*explicit}:
        raise Unreadable("a transformation in both directions")
    claim, kind = tables["claim"], tables["claim"].get("kind")
    if kind in (*MAPPED, *SQUARE) and not (explicit or generating):
        raise Unreadable("a claim about a map that isn't there")
    if kind in ("generates", "generating_function") and not (explicit and (generating or kind != "generates")):
        raise Unreadable("a generating function needs an explicit map beside it")
    if kind in SQUARE and len(s.Q) != len(s.q):
        raise Unreadable("as many new variables as old ones are needed")
    mixed = [*texts(tables.get("domain", {})), *(texts(dict(claim)) if kind in BOTH else ())]
    if any(new & _in_brackets(s, text) for text in mixed):
        raise Unreadable("a bracket in the old variables beside new ones")
    for text in texts(dict(claim)):
        _check_related(s, text, old, new)
    if kind == "solves":
        _check_slopes(s, [*texts(claim["equations"]), *texts(tables.get("definitions", {}))], old, new)


def texts(value: Any) -> Iterator[str]:
    """The texts in lists and tables."""
    if isinstance(value, str):
        yield value
    items = value.values() if isinstance(value, Mapping) else value if isinstance(value, list) else ()
    for item in items:
        yield from texts(item)


def _nodes(s: Statement, text: str) -> list[Any]:
    try:
        return list(ast.walk(s.f.tree(text)[0]))
    except Unreadable:  # no formula: whoever wants one here says so
        return []


def written_names(s: Statement, text: str) -> set[str]:
    """The names that stand in a text."""
    return {node.id[1:] for node in _nodes(s, text) if isinstance(node, ast.Name)}


def _check_related(s: Statement, text: str, old: set[str], new: set[str]) -> None:
    """Refuse D(Q, q), which is no 0: by the map Q depends on q. Raises Unreadable."""
    for node in _nodes(s, text):
        if not (isinstance(node, ast.Call) and ast.unparse(node.func)[1:] == "D" and len(node.args) > 1):
            continue
        names, by = _meant(s, ast.walk(node.args[0])), _meant(s, [node.args[1]])
        if any(by <= side and names & other and not names & side for side, other in ((old, new), (new, old))):
            raise Unreadable(f"a derivative of variables that depend on the name by the map: {text[:60]!r}")


def _check_slopes(s: Statement, equations: list[str], old: set[str], new: set[str]) -> None:
    """Refuse D(f(t), a) of a solution a cos t, which is no 0: it was taken too early. Raises Unreadable."""
    slopes = set[tuple[str, str]]()
    for node in (node for text in equations for node in _nodes(s, text) if isinstance(node, ast.Call)):
        name = ast.unparse(node.func)[1:]
        if name == "bracket" or (name == "D" and len(node.args) > 1):
            by = {*s.q, *s.p} if name == "bracket" else _meant(s, [node.args[1]])
            slopes |= {(x, f) for x in by for f in _functions(s, node.args if name == "bracket" else node.args[:1])}
    for call, text in s.claim["solution"].items():
        held = {s.f.ops[a][1] for a in s.f.reach(s.f.read(text, s.names)) if s.f.ops[a][0] == "s"}
        held |= (new if held & old else set()) | (old if held & new else set())
        held -= {s.f.ops[a][1] for a in s.f.reach(s.f.read(call, {})) if s.f.ops[a][0] == "s"}
        if any((x, f) in slopes for x in held for f in _functions(s, [s.f.tree(call)[0]])):
            raise Unreadable(f"a derivative of {call[:40]!r} by a name on which the solution depends, and it doesn't")


def _functions(s: Statement, trees: list[Any]) -> set[str]:
    """The arbitrary functions that are called in formulas, and in their abbreviations."""
    nodes = [node for tree in trees for node in ast.walk(tree)]
    called = {ast.unparse(node.func)[1:] for node in nodes if isinstance(node, ast.Call)}
    inner = [s.names[node.id[1:]] for node in nodes if isinstance(node, ast.Name) and node.id[1:] in s.names]
    return called | {s.f.ops[a][1] for a in s.f.reach(*inner) if s.f.ops[a][0] == "f"}


def _in_brackets(s: Statement, text: str) -> set[str]:
    """The names within its brackets."""
    calls = (node for node in _nodes(s, text) if isinstance(node, ast.Call) and isinstance(node.func, ast.Name))
    inside = (part for call in calls if ast.unparse(call.func)[1:] == "bracket" for part in ast.walk(call))
    return _meant(s, inside)


def _meant(s: Statement, nodes: Iterable[ast.AST]) -> set[str]:
    written = {node.id[1:] for node in nodes if isinstance(node, ast.Name)}
    inner = [s.names[name] for name in written if name in s.names]
    return (written - {*s.names}) | {s.f.ops[a][1] for a in s.f.reach(*inner) if s.f.ops[a][0] == "s"}
