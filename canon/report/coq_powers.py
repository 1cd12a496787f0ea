"""Relations between kernels as equations g ^ n = …, with which Coq's `field` reduces powers by itself.

A numerator is 0 modulo the relations. Written out as Σ cofactor · relation it is long, and Coq needs most of its time
to read it; `field [equations]` needs the equations alone. Their coefficients have to be integers: where a relation has
fractions, a multiple of the kernel takes its place.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from typing import Any

from canon.report.coq_kernels import Kernel
from canon.report.coq_text import polynomial

Table = Mapping[str, str]


@dataclass(frozen=True)
class Powers:
    """Equations for `field`.

    **Arguments:** the `names` of the equations; `steps` that prove them; the names of equations kernel = multiple /
    number, with which kernels are `replaced` where relations have fractions.
    """

    names: tuple[str, ...]
    steps: tuple[str, ...]
    replaced: tuple[str, ...]


def powers(
    kernels: Sequence[Mapping[str, Any]], made: Sequence[Kernel], words: Mapping[str, str], used: Collection[str]
) -> Powers | None:
    """The equations for the relations of the kernels in `used`; None where one of these isn't of the form g ^ n + …."""
    chosen = [(k, in_coq) for k, in_coq in zip(kernels, made, strict=True) if k["name"] in used]
    multiples: dict[str, int] = {}
    names, steps, replaced = [], [], []
    renamed = dict(words)
    for kernel, in_coq in chosen:
        name, relation = kernel["name"], kernel["relation"]
        lead = next((m for m in relation if m.partition("^")[0] == name and " " not in m), "")
        if relation.get(lead) != "1":
            return None
        degree = int(lead.partition("^")[2] or 1)
        rest = {m: _in_multiples(m, -Fraction(c), multiples) for m, c in relation.items() if m != lead}
        factor = lcm(*(c.denominator for c in rest.values()))
        if factor > 1:
            multiples[name], renamed[name] = factor, f"multiple'{in_coq.word}"
            steps.append(f"pose ({renamed[name]} := {factor} * {in_coq.word}).")
            fraction = f"{in_coq.word} = {renamed[name]} / {factor}"
            replaced.append(f"replaced'{in_coq.word}")
            steps.append(f"assert ({replaced[-1]} : {fraction}) by (unfold {renamed[name]}; field).")
        right = polynomial({m: str(c * factor**degree) for m, c in rest.items()}, renamed)
        left, unfolded = polynomial({lead: "1"}, renamed), [renamed[n] for n in multiples]
        proof = f"apply Rminus_diag_uniq; rewrite <- {in_coq.lemma}; ring"
        if unfolded:
            times = f"{factor} ^ {degree} * ({in_coq.relation})"
            proof = f"unfold {', '.join(unfolded)}; field"
            proof = f"apply Rminus_diag_uniq; transitivity ({times}); [{proof} | rewrite {in_coq.lemma}; ring]"
        names.append(f"power'{in_coq.word}")
        steps.append(f"assert ({names[-1]} : {left} = {right}) by ({proof}).")
    if multiples:
        steps.append(f"clearbody {' '.join(renamed[name] for name in multiples)}.")
    return Powers(tuple(names), tuple(steps), tuple(replaced))


def _in_multiples(monomial: str, coefficient: Fraction, multiples: Mapping[str, int]) -> Fraction:
    """The coefficient that a monomial has in the multiples of kernels."""
    for factor in monomial.split():
        name, _, exponent = factor.partition("^")
        coefficient /= multiples.get(name, 1) ** int(exponent or 1)
    return coefficient
