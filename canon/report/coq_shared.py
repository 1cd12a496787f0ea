"""A theorem of Coq for all residuals of a case at once, with the quantities that they share as names of their own.

Written out one by one, residuals of some thousand terms repeat what they share, and most of the time of `coqc` goes
into reading them. Here each quantity is defined once, in terms of those before it; and what is 0 is seen by a procedure
that is proved in the file itself (`vanishing.v`), which goes through the definitions in order and computes.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any, Final

from canon.checker.functions import Unknown
from canon.checker.statement import Statement
from canon.decide.ring import TooCostly
from canon.errors import BudgetExceeded
from canon.report.coq_field import Fractions, Table
from canon.report.coq_kernels import Kernel
from canon.report.coq_text import RESERVED, operation, polynomial

SHORT: Final = 24
"""What is shorter is repeated rather than named."""


@cache
def procedure() -> str:
    """The procedure, and the proof that it is right."""
    return Path(__file__).with_name("vanishing.v").read_text(encoding="utf-8")


class Definitions:
    """Formulas with names for what they share.

    **Arguments:** the fractions that divisors are taken from, names in Coq, and the value of each name and function of
    the formulas as [numerator, denominator] in the kernels.
    """

    def __init__(
        self,
        fractions: Fractions,
        words: Mapping[str, str],
        atoms: Mapping[int, Sequence[Table]],
        targets: Sequence[int],
    ) -> None:
        self.fractions, self.words, f = fractions, words, fractions.f
        self.lines: list[tuple[str, str, tuple[Fraction, dict[int, int]] | None]] = []
        """Each a name, what it is, and for one that is divided by its value: a number, and powers of factors."""
        self.texts: dict[int, tuple[str, int]] = {}
        self.factors: set[int] = set()
        """The irreducible factors of what is divided by."""
        nodes = f.rational(targets)[0]
        times = Counter(b for a in nodes for b in f.parts(a))
        divides = {b for a in nodes if f.ops[a][0] == "^" and f.ops[a][2] < 0 for b in f.parts(a)}
        for a, (over, under) in atoms.items():
            text = polynomial(over, words)
            if under != {"": "1"}:
                below = fractions.polynomial(under)
                text = f"({text}) / {self._named(polynomial(under, words), self._product((below, {})))}"
            value = self._product(fractions.values[a]) if a in divides else None
            self._keep(a, (text, 3 if text.isidentifier() else 0), times[a], value)
        for a in nodes:
            value = self._product(fractions.value(a)) if a in divides and f.value(a) is None else None
            op, parts = f.ops[a], [self.texts[b] for b in f.parts(a)]
            if op[0] == "^" and op[2] < -1:  # a power of an inverse, not the inverse of a power
                op, parts = ("^", op[1], -op[2]), [(f"/ {parts[0][0]}", 2)]
            self._keep(a, operation(op, parts), times[a], value)

    def _product(self, value: Any) -> tuple[Fraction, dict[int, int]]:
        """A fraction as a number times powers of irreducible factors."""
        content, powers = self.fractions.field.split_denominator(value[0])
        self.factors |= powers.keys() | value[1].keys()
        return content, {k: powers.get(k, 0) - value[1].get(k, 0) for k in powers.keys() | value[1].keys()}

    def _keep(self, a: int, text: tuple[str, int], times: int, value: tuple[Fraction, dict[int, int]] | None) -> None:
        named = text[1] < 3 and (value is not None or (times > 1 and len(text[0]) > SHORT))
        self.texts[a] = (self._named(text[0], value), 3) if named else text

    def _named(self, text: str, value: tuple[Fraction, dict[int, int]] | None) -> str:
        known = next((word for word, line, _ in self.lines if line == text), None)
        if known is not None:
            return known
        taken, word = {*self.words.values(), *RESERVED}, f"u{len(self.lines) + 1}"
        while word in taken:
            word += "_"
        self.lines.append((word, text, value))
        return word


def theorem(
    s: Statement,
    targets: Sequence[int],
    atoms: Mapping[int, Sequence[Table]],
    words: Mapping[str, str],
    kernels: Sequence[Mapping[str, Any]],
    made: Sequence[Kernel],
    free: Mapping[str, str],
) -> str:
    """The theorem that these residuals are 0.

    **Arguments:** the statement and its residuals; the values of their names and functions in the kernels; names in
    Coq; the kernels, and what they are in Coq; hypotheses on names, by the names that they are about.
    """
    equal = [_relation(data["name"], data["relation"]) for data, k in zip(kernels, made, strict=True) if k.relation]
    fractions = Fractions(s.f, list(words), atoms, equal)
    shared = Definitions(fractions, words, atoms, targets)
    if not all(_may_vanish(fractions, a) for a in targets):
        raise Unknown("a residual that is 0 for some signs of its roots or moduli only, which the relations don't tell")
    factors = sorted(shared.factors)
    known = {*free, *(kernel.name for kernel in made if kernel.positive)}
    radicands = [_monic(fractions, fractions.polynomial(dict(kernel.radicand))) for kernel in made if kernel.radicand]
    steps = [step for kernel in made for step in kernel.steps]
    hypotheses = [*free.values(), *(h for kernel in made for h in kernel.hypotheses)]
    divisors = []
    for k in factors:
        factor = fractions.field.factors[k]
        shown, divisor = polynomial(fractions.table(factor), words), f"divisor'{k}"
        divisors.append(divisor)
        if fractions.name_of(k) in known:
            proof = "first [assumption | apply Rgt_not_eq; assumption | apply Rlt_not_eq; assumption]"
        elif factor in radicands:
            proof = "first [apply Rgt_not_eq; lra | apply Rlt_not_eq; lra]"
        else:
            proof = "assumption"
            hypotheses.append(f"{shown} <> 0")
        steps.append(f"assert ({divisor} : {shown} <> 0) by ({proof}).")
    relations = []
    lemmas = {kernel.name: kernel.lemma for kernel in made}
    for name, degree, rest in equal:
        relations.append(f"power'{words[name]}")
        equation = f"{words[name]} ^ {degree} = {polynomial(rest, words)}"
        steps.append(f"assert ({relations[-1]} : {equation}) by (clear - {lemmas[name]}; lra).")
    hypotheses = list(dict.fromkeys(hypotheses))
    variables = [words[name] for name in words if words[name] != "PI"]
    names = [word for word, _, _ in shared.lines]
    goals = [f"  {shared.texts[a][0]} = 0" for a in targets]
    everything = [*variables, *(["PI"] if "PI" in words.values() else [])]
    given = [f"given'{k}" for k in range(1, len(hypotheses) + 1)]
    products = [[f"{value[1].get(k, 0)}" for k in factors] if value else [] for _, _, value in shared.lines]
    return "\n".join([
        "Theorem RESIDUAL :",
        *([f"  forall {' '.join(variables)} : R,"] if variables else []),
        *(f"  {h} ->" for h in hypotheses),
        *([f"  forall {' '.join(names)} : R,"] if names else []),
        *(f"  {word} = {text} ->" for word, text, _ in shared.lines),
        " /\\\n".join(goals) + ".",
        "Proof.",
        f"  intros {' '.join([*variables, *given])}.",
        *(f"  {step}" for step in steps),
        "  intros.",
        f"  all_vanish ({_list(everything)} : list R) ({_list(names)} : list R)",
        f"    {_pairs(relations)} {_pairs(divisors)}\n    ({_list([_list(z) for z in products])} : list (list Z))%Z.",
        "Qed.",
        "",
    ])  # fmt: skip


def _may_vanish(fractions: Fractions, target: int) -> bool:
    """Whether a residual is 0 by the relations alone, all that the theorem has; what is too long to tell is for Coq."""
    try:
        return not fractions.table(fractions.value(target)[0])
    except (TooCostly, BudgetExceeded):
        return True


def _monic(fractions: Fractions, p: Any) -> Any:
    return fractions.ring.scaled(p, 1 / fractions.ring.leading(p))


def _list(words: Sequence[str]) -> str:
    return f"[{'; '.join(words)}]"


def _pairs(words: Sequence[str]) -> str:
    return "".join(f"({word}, " for word in words) + "tt" + ")" * len(words)


def _relation(name: str, relation: Table) -> tuple[str, int, Table]:
    """A relation as g ^ n = the rest."""
    lead = next((m for m in relation if m.partition("^")[0] == name and " " not in m), "")
    if relation.get(lead) != "1":
        raise Unknown(f"a relation that isn't solved for a power of {name}")
    rest = {m: str(-Fraction(c)) for m, c in relation.items() if m != lead}
    return name, int(lead.partition("^")[2] or 1), rest
