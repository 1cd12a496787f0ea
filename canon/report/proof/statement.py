"""What a claim says, in words: its setting, and its statement by kind, from the tables of its file."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final

from canon.report.proof import calculus
from canon.report.proof.blocks import Block, Display, Items, Paragraph, display, listed, paragraph, words
from canon.report.proof.lines import by_structure, formulas, names_of
from canon.report.proof.structure import LONG, cut
from canon.typeset.trees import Tree, tree_of

Tables = Mapping[str, Any]
Blocks = list[Block]
TYPES: Final = {1: ("q", "Q"), 2: ("q", "P"), 3: ("p", "Q"), 4: ("p", "P")}


def setting(tables: Tables) -> Blocks:
    """The phase space, what is assumed of names, abbreviations, the Hamiltonian, the map and the domain."""
    space = tables["phase_space"]
    found: Blocks = [paragraph(_variables(space, tables.get("symbols", {})), lead="Setting.")]
    if "definitions" in tables:
        found.append(paragraph("Write"))
        found.append(formulas([(name, text) for name, text in tables["definitions"].items()], tables))
    if "hamiltonian" in tables:
        found += [paragraph("The Hamiltonian is"), formulas([("H", tables["hamiltonian"]["H"])], tables)]
    found += [*_generating_function(tables), *_map(tables)]
    domain = tables.get("domain", {})
    if domain.get("where"):
        found.append(paragraph(f"All is said of the region where {listed(domain['where'])}."))
    if domain.get("on"):
        found.append(paragraph(f"All is said of the surface where {listed([f'{text} = 0' for text in domain['on']])}."))
    return found


def _variables(space: Tables, symbols: Tables) -> str:
    text = "Names of which nothing else is said are real"  # of a claim about matrices or groups, without a phase space
    if space.get("q"):
        text = f"C{_pairs(space['q'], space['p'])[1:]}"
    if space.get("Q"):
        text += f"; new {_pairs(space['Q'], space['P'])}"
    groups: dict[str, list[str]] = {}
    for name, value in symbols.items():
        groups.setdefault(value if isinstance(value, str) else " and ".join(value), []).append(name)
    said = [f"{listed(names)} {_assumed(word, len(names))}" for word, names in groups.items() if word != "real"]
    return f"{text}. {'; '.join(said)}.".replace(" .", "") if said else f"{text}."


def _pairs(q: list[str], p: list[str]) -> str:
    one = len(q) == 1
    return f"coordinate{'' if one else 's'} {listed(q)} with moment{'um' if one else 'a'} {listed(p)}"


def _assumed(word: str, count: int) -> str:
    if word == "function":
        return "is any smooth function" if count == 1 else "are any smooth functions"
    return f"{'is' if count == 1 else 'are'} {word}"


def _map(tables: Tables) -> Blocks:
    space, given = tables["phase_space"], tables.get("transformation")
    if not given:
        return []
    sides = ("Q", "P") if "Q" in given else ("q", "p")
    names = [name for side in sides for name in space.get(side, [])]
    texts = [text for side in sides for text in given[side]]
    back = "" if "Q" in given else ", given as old variables in terms of new ones"
    return [paragraph(f"The map{back}:"), formulas(list(zip(names, texts, strict=False)), tables)]


def _generating_function(tables: Tables) -> Blocks:
    given = tables.get("generating_function")
    if not given:
        return []
    kinds = given["type"]
    name = f"type {kinds}" if isinstance(kinds, int) else f"types {', '.join(map(str, kinds))}"
    found: Blocks = [paragraph(f"The generating function of {name}:"), formulas([("F", given["F"])], tables)]
    space = tables["phase_space"]
    sides = {side: space.get(side, []) for side in "qpQP"}
    lines = []
    for i in range(len(sides["q"])):
        a, b = TYPES[kinds if isinstance(kinds, int) else kinds[i]]
        other = {"q": "p", "p": "q", "Q": "P", "P": "Q"}
        for side, sign in ((a, "" if a == "q" else "-"), (b, "-" if b == "Q" else "")):
            lines.append(f"{sides[other[side]][i]} = {sign}D(F, {sides[side][i]})")
    return [*found, paragraph("It defines a map by"), display(*lines)]


def statement(tables: Tables) -> Blocks:
    """What the claim says."""
    claim = tables["claim"]
    make = KINDS.get(claim["kind"], _by_its_keys)
    found = make(claim, tables)
    return [found] if isinstance(found, Paragraph) else list(found)


def _by_its_keys(claim: Tables, tables: Tables) -> Blocks:
    """A kind without words of its own: its name and its keys."""
    keys = [k for k in claim if k not in ("kind", "title", "source", "expect", "budget")]
    kind = claim["kind"].replace("_", " ")
    items = tuple(words(f"{key.replace('_', ' ')}: ", *_value(claim[key])) for key in keys)
    return [paragraph(f"The claim {kind!r} holds{', with' if items else '.'}"), *([Items(items)] if items else [])]


def _value(value: Any) -> list[str | Tree]:
    if isinstance(value, Mapping):
        pairs = [f"`{k.replace(',', ' ,')}`" if k.isidentifier() else k for k in value]
        texts = [_value(v) for v in value.values()]
        return [x for name, text in zip(pairs, texts, strict=True) for x in (f"{name} is ", *text, "; ")][:-1]
    if isinstance(value, list):
        return [x for item in value for x in (*_value(item), ", ")][:-1]
    return [_short(value)]


def _short(value: Any) -> str | Tree:
    tree = tree_of(str(value))
    return str(value) if tree.kind == "verbatim" else cut(tree)


def _canonical(claim: Tables, tables: Tables) -> Paragraph:
    scale = str(claim.get("scale", "1"))
    J = "J" if scale == "1" else f"({scale})*J"
    text = f"The map is canonical{'' if scale == '1' else f' with the scale `{scale}`'}: `M*J*transpose(M) = {J}`, "
    text += "where `M` is the matrix of the derivatives of the new variables by the old ones"
    if "order" in claim:
        name, order = claim["order"]
        return paragraph(f"{text}, up to terms of order {order + 1} in `{name}`.")
    return paragraph(f"{text}, everywhere in the domain.")


def _brackets(claim: Tables, tables: Tables) -> Paragraph:
    return paragraph(
        "`bracket(Q_i, Q_j) = 0`, `bracket(P_i, P_j) = 0` and `bracket(Q_i, P_j) = delta_ij` for the new variables."
    )


def _new_hamiltonian(claim: Tables, tables: Tables) -> Blocks:
    return [
        paragraph("The map takes Hamilton's equations of `H` into those of"),
        formulas([("K", claim["K"])], tables),
        paragraph("so `K` is the new Hamiltonian, up to a function of time."),
    ]


def _bracket(claim: Tables, tables: Tables) -> Blocks:
    f, g = tree_of(str(claim["f"])), tree_of(str(claim["g"]))
    taken = names_of(tables)
    if f.size + g.size <= LONG:
        return [Display(tuple(by_structure(Tree("call", "bracket", (f, g)), tree_of(str(claim["equals"])), taken)))]
    return [
        paragraph("The Poisson bracket of"),
        formulas([("f", claim["f"]), ("g", claim["g"])], tables),
        paragraph("is"),
        formulas([("bracket(f, g)", claim["equals"])], tables),
    ]


def _identity(claim: Tables, tables: Tables) -> Blocks:
    taken = names_of(tables)
    left, right = tree_of(str(claim["lhs"])), tree_of(str(claim["rhs"]))
    if left.size + right.size <= 2 * LONG:
        return [Display((Tree("relation", parts=(left, right), signs=("=",)),)), paragraph("throughout the domain.")]
    lines = [*by_structure(Tree("name", "lhs"), left, taken), *by_structure(Tree("name", "rhs"), right, taken)]
    return [Display(tuple(lines)), paragraph("The two sides agree throughout the domain.")]


def _of_one(text: str, key: str, name: str) -> Callable[[Tables, Tables], Blocks]:
    """A sentence, and then a formula by name."""
    return lambda claim, tables: [paragraph(text), formulas([(name, claim[key])], tables)]


def _motion(text: str, keys: Sequence[tuple[str, str]]) -> Callable[[Tables, Tables], Blocks]:
    """A sentence, and then for each coordinate a formula."""

    def make(claim: Tables, tables: Tables) -> Blocks:
        pairs: list[tuple[str, str]] = []
        for key, side in keys:
            values = claim[key] if isinstance(claim[key], list) else [claim[key]]
            mark = "dot" if key.endswith("dot") else "delta"
            pairs += [(f"{mark}({x})", v) for x, v in zip(tables["phase_space"][side], values, strict=False)]
        return [paragraph(text), formulas(pairs, tables)]

    return make


def _functions(text: str) -> Callable[[Tables, Tables], Blocks]:
    def make(claim: Tables, tables: Tables) -> Blocks:
        pairs = [(f"f_{k}", str(value)) for k, value in enumerate(claim["functions"], 1)]
        return [formulas(pairs, tables), paragraph(text)]

    return make


def _said(text: str) -> Callable[[Tables, Tables], Paragraph]:
    return lambda claim, tables: paragraph(text)


def _generates(claim: Tables, tables: Tables) -> Blocks:
    if claim["kind"] == "generates":
        return [paragraph("The generating function `F` generates the map.")]
    return [
        paragraph(f"A generating function of type {claim['type']} of the map, up to a function of time, is"),
        formulas([("F", claim["F"])], tables),
    ]


def _hamilton_jacobi(claim: Tables, tables: Tables) -> Blocks:
    word = "S" if "S" in claim else "W"
    equation = "H(q, D(S, q), t) + D(S, t) = 0" if word == "S" else f"H(q, D(W, q)) = {claim['energy']}"
    return [
        formulas([(word, claim[word])], tables),
        paragraph(f"is a complete integral of `{equation}`, with the constants {listed(claim['constants'])}."),
    ]


def _lie_series(claim: Tables, tables: Tables) -> Blocks:
    order = f", up to the power {claim['order']}" if "order" in claim else ""
    return [
        paragraph(f"The Lie series of `{claim['f']}` along the flow of the generator `G`{order} is"),
        formulas([("G", claim["generator"]), ("f", claim["equals"])], tables),
        paragraph(f"with the parameter `{claim['parameter']}`."),
    ]


def _algebra(claim: Tables, tables: Tables) -> Blocks:
    pairs = (
        [(k, v) for k, v in claim["basis"].items() if not isinstance(v, list) and v != k] if "basis" in claim else []
    )
    what = f"the algebra {claim['equals']}" if "equals" in claim else "these brackets"
    brackets = [
        (f"bracket({pair.replace(' ', '')})".replace(",", ", "), str(value))
        for pair, value in claim.get("structure", {}).items()
    ]
    return [
        paragraph(f"The basis {listed(list(claim.get('basis', {})) or ['e'])} closes under the bracket, with {what}."),
        *([formulas(pairs, tables)] if pairs else []),
        *([formulas(brackets, tables)] if brackets else []),
    ]


def _action_angle(claim: Tables, tables: Tables) -> Paragraph:
    return paragraph(
        "The new variables are actions and angles of `H`: the map is canonical, the new Hamiltonian depends on the new "
        f"momenta alone, and each angle advances by `{claim.get('angle_period', '1')}` once round its cycle."
    )


def _jacobi(claim: Tables, tables: Tables) -> Blocks:
    cyclic = "bracket(f, bracket(g, h)) + bracket(g, bracket(h, f)) + bracket(h, bracket(f, g)) = 0"
    if not {"f", "g", "h"} <= set(claim) or "tensor" in claim:
        return _by_its_keys(claim, tables)
    return [
        paragraph(f"Jacobi's identity `{cyclic}` holds, where"),
        formulas([(name, claim[name]) for name in "fgh"], tables),
    ]


KINDS: Final[Mapping[str, Callable[[Tables, Tables], Blocks | Paragraph]]] = {
    "canonical": _canonical,
    "fundamental_brackets": _brackets,
    "new_hamiltonian": _new_hamiltonian,
    "symmetry": _said("The map leaves `H` form-invariant: its new Hamiltonian is `H` in the new variables."),
    "volume": _said("The map preserves the volume of phase space: `abs(det(M)) = 1` (Liouville)."),
    "integral_invariant": _said("The map preserves Poincaré's integral invariant."),
    "bracket": _bracket,
    "identity": _identity,
    "conserved": _of_one("This is a constant of the motion: `D(f, t) + bracket(f, H) = 0`, where", "f", "f"),
    "casimir": _of_one("This has the bracket 0 with every function:", "f", "f"),
    "involution": _functions("are in involution: each pair has the bracket 0."),
    "independent": _functions("are functionally independent, almost everywhere."),
    "generates": _generates,
    "generating_function": _generates,
    "equations_of_motion": _motion("Hamilton's equations are", (("qdot", "q"), ("pdot", "p"))),
    "hamiltonian_field": _motion("This vector field is Hamiltonian:", (("qdot", "q"), ("pdot", "p"))),
    "hamilton_jacobi": _hamilton_jacobi,
    "lie_series": _lie_series,
    "legendre": _of_one("The Hamiltonian is the Legendre transform of", "L", "L"),
    "cartan_invariant": _of_one(
        "`p*dq - H*dt` and `P*dQ - K*dt` differ by the differential of a function (Poincaré and Cartan), where",
        "K",
        "K",
    ),
    "algebra": _algebra,
    "matrix_algebra": _algebra,
    **calculus.KINDS,
    "action": _of_one("The action `J`, the integral of `p*dq` over one period, is", "equals", "J"),
    "frequency": _of_one("The frequency `nu = D(E, J)` is", "equals", "nu"),
    "action_angle": _action_angle,
    "jacobi": _jacobi,
}
"""Of each kind its words; others are shown by their keys."""
