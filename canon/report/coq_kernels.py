"""Kernels of a certificate in Coq: a function of its library with the lemma that gives its relation, or any number."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

from canon.checker.formulas import Formulas
from canon.report.coq_text import polynomial, term

FUNCTIONS: Final = {"sin": "sin", "cos": "cos", "exp": "exp", "log": "ln", "abs": "Rabs", "atan": "atan"}
"""The functions of Coq's library that kernels are, by their names in the language of formulas."""


@dataclass(frozen=True)
class Kernel:
    """A kernel for Coq.

    **Arguments:** its `name` in the certificate and its `word` in Coq; the `hypotheses` that say what it is; `steps`
    of a proof that give its sign and its relation; the `relation` as a term, and the name of the `lemma` that it is 0;
    whether it is `positive`; the `radicand` that is assumed to be positive, as the items of a table.
    """

    name: str
    word: str
    hypotheses: tuple[str, ...]
    steps: tuple[str, ...]
    relation: str
    lemma: str
    positive: bool
    radicand: tuple[tuple[str, str], ...] = ()

    def steps_for(self, relation: bool) -> tuple[str, ...]:
        """The steps of its proof; those that give its relation only where that is asked for."""
        return tuple(step for step in self.steps if relation or f"({self.lemma} :" not in step)


def kernels_of(f: Formulas, kernels: Sequence[Mapping[str, Any]], words: Mapping[str, str]) -> list[Kernel]:
    """The kernels of a certificate in Coq; `words` are the names in Coq of names and kernels."""
    functions = {kernel["name"] for kernel in kernels if "relation" not in kernel}
    return [_kernel(f, kernel, words, functions) for kernel in kernels]


def _kernel(f: Formulas, kernel: Mapping[str, Any], words: Mapping[str, str], functions: set[str]) -> Kernel:
    """One kernel; `functions` are those that are stated by their function alone."""
    name, node, relation = kernel["name"], f.read(kernel["stands for"], {}), kernel.get("relation")
    word, op = words[name], f.ops[node]
    shown = "" if relation is None else polynomial(relation, words)
    lemma = f"relation'{word}"
    if op == ("s", "pi"):
        return Kernel(name, "PI", (), ("pose proof PI_RGT_0.",), "", "", True)
    if op[0] == "f" and op[1] == "power" and f.value(op[3][1]) == Fraction(1, 2):
        return _root(f, kernel, words, op[3][0], shown)
    if op[0] == "f" and op[1] in FUNCTIONS and f.ops[op[3][0]]:
        argument = _term(f, op[3][0], words)
        equation = f"{word} = {FUNCTIONS[op[1]]} ({argument})"
        steps = []
        if op[1] == "exp":
            steps.append(f"assert (positive'{word} : 0 < {word}) by (subst; apply exp_pos).")
        if op[1] == "abs" and relation is not None:
            steps.append(f"assert ({lemma} : {shown} = 0) by (subst {word}; rewrite pow2_abs; first [field | lra]).")
            return Kernel(name, word, (equation,), tuple(steps), shown, lemma, False)
        circle = op[1] == "sin" and _others(kernel) <= functions
        if circle and relation is not None:
            proof = f"pose proof (sin2_cos2 ({argument})) as circle'; unfold Rsqr in circle'; subst; lra"
            steps.append(f"assert ({lemma} : {shown} = 0) by ({proof}).")
        if relation is None or circle:
            return Kernel(name, word, (equation,), tuple(steps), shown, lemma, op[1] == "exp")
    positive = kernel["sign"] == "pos"
    hypotheses = ([f"0 < {word}"] if positive else []) + ([] if relation is None else [f"{shown} = 0"])
    steps = [] if relation is None else [f"assert ({lemma} : {shown} = 0) by assumption."]
    return Kernel(name, word, tuple(hypotheses), tuple(steps), shown, lemma, positive)


def _others(kernel: Mapping[str, Any]) -> set[str]:
    """The names in a kernel's relation besides its own: of a sine, the cosine that stands beside it."""
    names = {factor.partition("^")[0] for monomial in kernel.get("relation", {}) for factor in monomial.split()}
    return names - {kernel["name"]}


def _root(f: Formulas, kernel: Mapping[str, Any], words: Mapping[str, str], radicand: int, relation: str) -> Kernel:
    """A square root: positive where its radicand is, and its square is that."""
    word, inner = words[kernel["name"]], _term(f, radicand, words)
    table = {m: str(-Fraction(c)) for m, c in kernel.get("relation", {}).items() if m != f"{kernel['name']}^2"}
    number = f.value(radicand) is not None
    hypotheses = ([] if number else [f"0 < {inner}"]) + [f"{word} = sqrt ({inner})"]
    steps = (
        f"assert (positive'{word} : 0 < {word}) by (subst {word}; apply sqrt_lt_R0; lra).",
        f"assert (relation'{word} : {relation} = 0) by (subst {word}; rewrite pow2_sqrt by lra; field).",
    )
    items = () if number else tuple(table.items())
    return Kernel(kernel["name"], word, tuple(hypotheses), steps, relation, f"relation'{word}", True, items)


def _term(f: Formulas, node: int, words: Mapping[str, str]) -> str:
    """A rational formula of names and kernels."""
    leaves = {a: words.get(f.ops[a][1], "PI") for a in f.rational([node])[1]}
    return term(f, node, leaves)
