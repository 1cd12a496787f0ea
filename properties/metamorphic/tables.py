"""A claim file as tables, and what can be done to it whatever it claims: names, formulas, one claim alone."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable, Iterator, Mapping
from decimal import Decimal
from typing import Any, Final

from canon.claims.keys import COMMON, KEYS
from canon.syntax import Call, Name, Node, Number, Power, Product, Sum, parse, parse_relation
from canon.tokens import RELATIONS, tokens
from canon.vocabulary import CALLABLE, CONSTANTS

Tables = dict[str, Any]
Told = Callable[[str], str]
FORMULAS: Final = ("expression", "expressions", "per pair", "matrix", "square", "end", "constant", "fields")
NAMED: Final = ("values", "basis", "matrices")
NAMES: Final = ("name", "names", "constants", "coordinate", "variable")


def alone(tables: Tables, index: int) -> Tables:
    """The file with one of its claims, of which nothing is expected and no budget is its own."""
    claim = {word: value for word, value in tables["claim"][index].items() if word not in ("expect", "budget", "title")}
    return copy.deepcopy({**tables, "claim": [claim]})


def mapped(tables: Tables, formula: Told, name: Told = lambda name: name) -> Tables:
    """The file with each of its formulas and names replaced; calls as `"x(t)"` that stand for functions are names."""
    found = dict(tables)
    if "phase_space" in tables:
        found["phase_space"] = {word: _nested(value, name) for word, value in tables["phase_space"].items()}
    found["symbols"] = {name(word): value for word, value in tables.get("symbols", {}).items()}
    found["definitions"] = {
        name(word): _nested(value, formula) for word, value in tables.get("definitions", {}).items()
    }
    for section in ("hamiltonian", "transformation", "domain", "generating_function"):
        if section in tables:
            found[section] = {w: v if w == "type" else _nested(v, formula) for w, v in tables[section].items()}
    found["claim"] = [_claim(claim, formula, name) for claim in tables["claim"]]
    return {word: value for word, value in found.items() if value != {}}


def _nested(value: Any, told: Told) -> Any:
    if isinstance(value, list):
        return [_nested(item, told) for item in value]
    if isinstance(value, bool):
        return value
    text = str(value)
    return value if (new := told(text)) == text else new


def _claim(claim: Tables, formula: Told, name: Told) -> Tables:
    found = {word: value for word, value in claim.items() if word in COMMON}
    for word, value in claim.items():
        form = KEYS[claim["kind"]].keys[word].form if word not in COMMON else "word"
        if form == "end" and value in ("infinity", "-infinity"):
            found[word] = value
        elif form in FORMULAS:
            found[word] = _nested(value, formula)
        elif form == "calls":
            found[word] = [in_names(text, name) for text in value]
        elif form in NAMES:
            found[word] = _nested(value, name)
        elif form in NAMED:
            found[word] = {name(key): _nested(item, formula) for key, item in value.items()}
        elif form == "tables":
            found[word] = [{name(key): _nested(item, formula) for key, item in table.items()} for table in value]
        elif form == "functions":
            found[word] = {in_names(key, name): _nested(item, formula) for key, item in value.items()}
        elif form == "degrees":
            found[word] = {key: _nested(item, formula) for key, item in value.items()}
        elif form in ("structure", "brackets"):
            found[word] = {
                ",".join(name(part.strip()) for part in key.split(",")): _nested(item, formula)
                for key, item in value.items()
            }
        elif form == "power":
            found[word] = [name(value[0]), *value[1:]]
        elif form == "dimensions":
            found[word] = {name(key): item for key, item in value.items()}
        else:
            found[word] = value
    return found


def in_names(text: str, name: Told) -> str:
    """The text of a formula or an inequality with its names replaced, all else as it is written."""
    parts, end = list[str](), 0
    for token in tokens(text):
        if token.kind == "name":
            parts += [text[end : token.start], name(token.text)]
            end = token.end
    return "".join(parts) + text[end:]


def in_nodes(text: str, told: Callable[[Node], Node]) -> str:
    """The text of a formula or an inequality with its tree, or both sides' trees, replaced; else as it is written."""
    if not any(token.text in RELATIONS for token in tokens(text)):
        node = parse(text)
        return text if (new := told(node)) is node else shown(new)
    sides, signs = parse_relation(text)
    news = [told(side) for side in sides]
    if all(new is side for new, side in zip(news, sides, strict=True)):
        return text
    return shown(news[0]) + "".join(f" {sign} {shown(new)}" for sign, new in zip(signs, news[1:], strict=True))


def every_name(tables: Tables) -> set[str]:
    """All names that occur, built-in ones among them."""
    found = set[str]()

    def seen(name: str) -> str:
        found.add(name)
        return name

    mapped(tables, lambda text: in_names(text, seen), seen)
    return found


def own_names(claim: Tables) -> set[str]:
    """What a claim's keys name: declared there, or spoken of by name."""
    found = set[str]()

    def seen(name: str) -> str:
        found.add(name)
        return name

    _claim(claim, lambda text: text, seen)
    return found


def declared(tables: Tables) -> set[str]:
    """The names of the file's sections and of its claim, time among them."""
    space = tables.get("phase_space", {})
    listed = {name for word in "qpQP" for name in space.get(word, [])} | {space.get("time", "t")}
    return listed | {*tables.get("symbols", {}), *tables.get("definitions", {})} | own_names(tables["claim"][0])


def unused(tables: Tables, wanted: str) -> str:
    """A name like the one that is wanted, which the file hasn't got."""
    taken = every_name(tables) | {*CALLABLE, *CONSTANTS, "t"}
    while wanted in taken:
        wanted += "0"
    return wanted


def shown(node: Node) -> str:
    """A tree as text."""
    if isinstance(node, Number):
        text = str(node.value) if node.value.denominator == 1 else f"({node.value})"
        return text if not node.imaginary else f"{text}j" if node.value.denominator == 1 else f"({node.value}*1j)"
    if isinstance(node, Name):
        return node.name
    if isinstance(node, Call):
        return f"{node.name}({', '.join(map(shown, node.arguments))})"
    if isinstance(node, Power):
        return f"{_inside(node.base)}**{_inside(node.exponent)}"
    if isinstance(node, Product):
        first = _inside(node.factors[0])
        rest = zip(node.factors[1:], node.multiplied[1:], strict=True)
        return first + "".join(f"{'*' if multiplied else '/'}{_inside(part)}" for part, multiplied in rest)
    terms = zip(node.terms, node.added, strict=True)
    text = "".join(f"{'+' if added else '-'}{_term(term)}" for term, added in terms)
    return text.removeprefix("+")


def _inside(node: Node) -> str:
    return f"({shown(node)})" if isinstance(node, (Sum, Product, Power)) else shown(node)


def _term(node: Node) -> str:
    return f"({shown(node)})" if isinstance(node, Sum) else shown(node)


def with_children(node: Node, parts: tuple[Node, ...]) -> Node:
    """The node with other parts."""
    if isinstance(node, Sum):
        return Sum(node.span, parts, node.added)
    if isinstance(node, Product):
        return Product(node.span, parts, node.multiplied)
    if isinstance(node, Power):
        return Power(node.span, *parts)
    return Call(node.span, node.name, parts) if isinstance(node, Call) else node


def open_parts(node: Node) -> tuple[Node, ...]:
    """The parts of a node that may be replaced by equal ones: not the names by which a derivative is taken."""
    if isinstance(node, Call):
        return node.arguments[:1] if node.name == "D" else node.arguments
    if isinstance(node, Sum):
        return node.terms
    if isinstance(node, Product):
        return node.factors
    return (node.base, node.exponent) if isinstance(node, Power) else ()


def walk(node: Node) -> Iterator[Node]:
    """The node, and all that may be replaced inside of it."""
    yield node
    for part in open_parts(node):
        yield from walk(part)


def replaced(node: Node, told: Callable[[Node], Node]) -> Node:
    """The tree with each of its replaceable nodes put through `told`, the innermost first; itself if none changed."""
    parts = open_parts(node)
    news = tuple(replaced(part, told) for part in parts)
    if any(new is not part for new, part in zip(news, parts, strict=True)):
        kept = node.arguments[1:] if isinstance(node, Call) and node.name == "D" else ()
        node = with_children(node, (*news, *kept))
    return told(node)


def in_toml(tables: Mapping[str, Any]) -> str:
    """The tables as a file."""
    return "\n".join(f"{json.dumps(word)} = {_value(value)}" for word, value in tables.items()) + "\n"


def _value(value: Any) -> str:
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{json.dumps(k)} = {_value(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    return str(value) if isinstance(value, Decimal) else json.dumps(value, ensure_ascii=False)
