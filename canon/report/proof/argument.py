"""Why a claim holds: the substitutions, each identity and why it vanishes.

All is read off a certificate: its kernels with their relations, its residuals with numerators and cofactors. What must
vanish is derived from the claim's text by the checker's rules.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Final

from canon.checker.case import Case
from canon.checker.formulas import Formulas
from canon.checker.functions import Unknown, Unreadable
from canon.checker.kinds import obligations
from canon.checker.statement import Statement
from canon.report.proof.blocks import Block, Display, Items, Piece, equation, paragraph, words
from canon.report.proof.findings import details, open_question, refutation
from canon.report.proof.matrix import jacobian
from canon.report.proof.statement import names_of
from canon.report.proof.structure import LONG, cut, polynomial, structured
from canon.typeset.trees import Tree, times, tree_of

Data = Mapping[str, Any]
Blocks = list[Block]
MOST: Final = 6
"""So many residuals of a case are written down; the others are counted."""
SIGNS: Final = {"pos": "> 0", "neg": "< 0", "nonneg": ">= 0", "nonpos": "<= 0"}
BOTH_SIDES: Final = "lhs - rhs"
ZERO: Final = Tree("number", "0")
ARGUMENTS: Final = {
    "normal form": "Everything is brought to a common denominator and reduced by the relations: nothing is left.",
    "on a connected cell": "The gradient vanishes on a connected domain, and the value at one point is 0.",
    "ball": "The value at the point is enclosed in a ball that doesn't contain 0.",
}


def argument(tables: Data, certificate: Data, record: Data) -> Blocks:
    """The proof of a claim, or its refutation; of what is neither, what is known."""
    status = record["verdict"]
    if status == "refuted":
        return refutation(tables, certificate, record)
    if status != "proved":
        return open_question(record)
    try:
        statement = Statement(certificate["tables"], certificate["known"], "proved")
        cases = obligations(statement)
    except (Unknown, Unreadable, KeyError, TypeError, ValueError):
        return [_by_method(record), *details(record)]
    found = jacobian(tables) if record["kind"] in ("canonical", "fundamental_brackets", "volume") else []
    for number, (case, data) in enumerate(zip(cases, certificate["cases"], strict=False), 1):
        if len(cases) > 1:
            found.append(paragraph(lead=f"Case {number}."))
        found += _case(statement, case, data, names_of(tables), record)
    return [*(found or [_by_method(record)]), *details(record)]


def _by_method(record: Data) -> Block:
    return paragraph(f"It is decided by an exact argument: {record['method'] or 'a theorem'}.")


# -- a proof by identities ----------------------------------------------------------------------


def _case(s: Statement, case: Case, data: Data, taken: set[str], record: Data) -> Blocks:
    found: Blocks = []
    if case.zeros:
        found.append(paragraph(_what_vanishes(len(case.zeros))))
    if "c" not in taken and any(label.startswith("residual_") for label in case.labels):
        found.append(
            paragraph(
                "Here `c` is the scale of the map, `M*J*transpose(M) = c*J`; a residual with an index is the "
                "derivative of `K - c*H` by that variable, with what moves with time."
            )
        )
    used = _used(data)
    kernels = [_kernel(kernel) for kernel in data["kernels"] if kernel["name"] in used]
    if kernels:
        found += [paragraph("Put", lead="Substitutions."), Items(tuple(kernels))]
    values = [equation(tree_of(text), _quotient(*pair)) for text, pair in data["atoms"].items()]
    values = [tree for tree in values if tree.size <= 2 * LONG and not _is_own_name(tree, data)]
    if values:
        found += [paragraph("so that" if kernels else "Here"), Display(tuple(cut(tree) for tree in values[:MOST]))]
        if len(values) > MOST:
            found.append(paragraph(f"and so on for {len(values) - MOST} more functions."))
    entries = list(zip(case.zeros, data["residuals"], strict=False))
    relations = {kernel["name"]: kernel.get("relation", {}) for kernel in data["kernels"]}
    shown = [pair for pair in entries if s.f.value(pair[0]) is None]
    for k, (a, entry) in enumerate(shown[:MOST]):
        position = case.zeros.index(a)
        label = case.labels[position] if position < len(case.labels) else ""
        found += _residual(s.f, a, entry, label or f"r_{k + 1}", relations, taken)
    found += _rest(shown[MOST:], len(entries) - len(shown))
    for group in case.nonzeros:
        what = "is not 0 at a point of the domain" if len(group) == 1 else "are not all 0 at a point of the domain"
        found.append(paragraph(_side(s.f, group), f" {what}, hence not identically 0.", lead="Side condition."))
    return found


def _what_vanishes(count: int) -> str:
    return "One quantity has to vanish." if count == 1 else f"{count} quantities have to vanish."


def _used(data: Data) -> set[str]:
    """The kernels that the residuals and the values of functions speak of, and those that these are made of."""
    tables = [table for pair in data["atoms"].values() for table in pair]
    for entry in data["residuals"]:
        tables += [entry.get("numerator", {}), *entry.get("cofactors", {}).values()]
    used = {factor.partition("^")[0] for table in tables for monomial in table for factor in monomial.split()}
    used |= {name for entry in data["residuals"] for name in entry.get("cofactors", {})}
    for kernel in reversed(data["kernels"]):
        if kernel["name"] in used:
            tree = tree_of(kernel["stands for"])
            used |= {part.text for part in tree.below() if part.kind == "name"}
    return used


def _kernel(kernel: Data) -> tuple[Piece, ...]:
    """One substitution: what the kernel stands for, its sign, and its relation."""
    name = Tree("name", kernel["name"])
    meaning = tree_of(kernel["stands for"])
    pieces: list[Piece] = [equation(name, cut(meaning))]
    if kernel["sign"] in SIGNS:
        pieces += [f" (`{kernel['name']} {SIGNS[kernel['sign']]}`)"]
    if "relation" in kernel:
        pieces += [", with ", equation(cut(polynomial(kernel["relation"])), ZERO)]
    return words(*pieces)


def _quotient(over: dict[str, str], under: dict[str, str]) -> Tree:
    if under == {"": "1"}:
        return polynomial(over)
    return Tree("fraction", parts=(polynomial(over), polynomial(under)))


def _is_own_name(tree: Tree, data: Data) -> bool:
    """Whether a function's value is a kernel that stands for this very function: that is said already."""
    left, right = tree.parts
    return any(k["name"] == right.text and tree_of(k["stands for"]) == left for k in data["kernels"])


def _residual(
    f: Formulas, a: int, entry: Data, label: str, relations: Mapping[str, dict[str, str]], taken: set[str]
) -> Blocks:
    """One residual: the identity that shows it to be 0."""
    name = "The difference of the two sides" if label == BOTH_SIDES else tree_of(label)
    if "cofactors" not in entry:
        why = next((text for word, text in ARGUMENTS.items() if word in str(entry.get("argument"))), "")
        return [paragraph(name, f" vanishes by the argument {str(entry.get('argument'))!r}. {why}")]
    over, cofactors = entry["numerator"], {k: c for k, c in entry["cofactors"].items() if c}
    lines: list[Tree] = []
    if (expression := _expression(f, a)) is not None:
        short, parts = structured(expression, taken)
        lines += [equation(tree_of(label), short), *(equation(Tree("name", n), part) for n, part in reversed(parts))]
    if not over:
        divided = not lines or any(part.kind == "fraction" for line in lines for part in line.below())
        why = "is 0 as soon as it is over one denominator: all terms cancel." if divided else "is 0: all terms cancel."
        return [Display(tuple(lines)), paragraph(why)] if lines else [paragraph(name, f" {why}")]
    numerator = cut(polynomial(over))
    quotient = numerator
    if entry["denominator"] != {"": "1"}:
        quotient = Tree("fraction", parts=(numerator, cut(polynomial(entry["denominator"]))))
    blocks: Blocks = [Display((*lines, equation(tree_of(label), quotient)))]
    shown = [times([_cofactor(c), polynomial(relations.get(k, {}))]) for k, c in cofactors.items()]
    terms = tuple(cut(term) for term in shown)
    total = terms[0] if len(terms) == 1 else Tree("sum", parts=terms, signs=("+",) * len(terms))
    identity = equation(numerator, total)
    count = "the relation" if len(terms) == 1 else f"{len(terms)} relations"
    if all(k.startswith("surface") for k in cofactors):
        return [*blocks, paragraph("The numerator is a combination of the equations of the surface, hence 0 on it.")]
    return [
        *blocks,
        paragraph(f"whose numerator is a multiple of {count}," if len(terms) == 1 else "whose numerator is"),
        Display((identity if identity.size <= LONG else total,)),
        paragraph("and so 0." if len(terms) == 1 else "a combination of the relations, and so 0."),
    ]


def _cofactor(table: dict[str, str]) -> Tree:
    """A cofactor; of a long one its first term, and how many more there are (the certificate has them all)."""
    tree = polynomial(table)
    if tree.size <= LONG or tree.kind != "sum":
        return cut(tree)
    return replace(
        tree, parts=(tree.parts[0], Tree("more", f"{len(tree.parts) - 1} terms")), signs=(tree.signs[0], "+")
    )


def _expression(f: Formulas, a: int) -> Tree | None:
    """The residual as it is derived, where it is short enough to be read."""
    if len(f.reach(a)) > 60:
        return None
    tree = tree_of(f.text(a))
    return None if tree.kind == "verbatim" or tree.size > 3 * LONG else tree


def _rest(entries: Sequence[tuple[int, Data]], trivial: int) -> Blocks:
    """How many residuals aren't shown, and why they vanish."""
    found: Blocks = []
    if entries:
        cancel = sum("cofactors" in e and not e["numerator"] for _, e in entries)
        ways = [
            (cancel, "over one denominator, all terms cancel"),
            (sum("cofactors" in e for _, e in entries) - cancel, "by multiples of the relations"),
            (sum("cofactors" not in e for _, e in entries), "by the argument named in the certificate"),
        ]
        said = "; ".join(f"{n} {why}" for n, why in ways if n)
        found.append(paragraph(f"In the same way the other {len(entries)} vanish: {said}."))
    if trivial:
        found.append(
            paragraph(
                "One quantity is 0 as it stands." if trivial == 1 else f"{trivial} quantities are 0 as they stand."
            )
        )
    return found


def _side(f: Formulas, group: Sequence[int]) -> Piece:
    if len(group) == 1 and (tree := _expression(f, group[0])) is not None:
        if tree.size <= LONG:
            return tree
    return "A long formula" if len(group) == 1 else f"{len(group)} quantities"
