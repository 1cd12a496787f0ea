"""Certificates as files of Coq: each residual of the claim is 0 over the reals, with a proof that coqc checks.

A theorem states a residual with its square roots, sines and so on as Coq's own functions; a function that Coq's library
lacks is any real number that satisfies its relation. It is proved by writing the residual as numerator / denominator
(`field`), the numerator as Σ cofactor · relation (`ring`), and each relation by a lemma of the library.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any, Final

from canon.checker.case import Case
from canon.checker.check import VERSION, check
from canon.checker.formulas import Formulas
from canon.checker.functions import Unknown, Unreadable
from canon.checker.kinds import obligations
from canon.checker.statement import Statement
from canon.decide.ring import TooCostly
from canon.errors import InputError
from canon.report.coq_kernels import kernels_of
from canon.report.coq_shared import procedure, theorem
from canon.report.coq_sign import SIGNED, inequality_of
from canon.report.coq_text import identifiers, number, term, wrapped
from canon.report.coq_theorem import SIGNS, atoms_of, names_of, theorem_of, used_kernels

LIBRARY: Final = """\
From Coq Require Import Reals Lra.
Open Scope R_scope.
"""
HEAD: Final = f"""{LIBRARY}
(* What isn't 0: by a hypothesis, perhaps in another form, by its sign, or factor by factor. *)
Ltac other_form :=
  match goal with
  | H : ?b <> 0 |- ?a <> 0 =>
      let E := fresh in intro E; apply H;
      first [ replace b with a by field | replace b with (- a) by field
            | replace b with (a / 2) by field | replace b with (- a / 2) by field
            | replace b with (a / 4) by field | replace b with (- a / 4) by field
            | replace b with (2 * a) by field | replace b with (- 2 * a) by field
            | replace b with (4 * a) by field | replace b with (- 4 * a) by field ]; lra
  end.
Ltac nonzero_factor := first [ assumption | apply Rgt_not_eq; lra | apply Rlt_not_eq; lra | other_form ].
Ltac nonzero :=
  repeat split;
  first [ nonzero_factor
        | repeat apply Rmult_integral_contrapositive_currified; try apply pow_nonzero; nonzero_factor ].
"""
PRODUCTS: Final = """\
(* The same, what is a product first: `lra` and other forms take long where the hypotheses are long. *)
Ltac sure :=
  first [ assumption | apply Rgt_not_eq; assumption
        | apply Rgt_not_eq; clear; lra | apply Rlt_not_eq; clear; lra ].
Ltac nonzero_product :=
  repeat split;
  first [ sure
        | solve [ repeat apply Rmult_integral_contrapositive_currified; try apply pow_nonzero; sure ]
        | nonzero ].
"""
LONG: Final = 3000
"""Residuals with more operations than this, written out, are put in one theorem with names for what they share."""
REDUCED: Final = ("normal form", "normal form, identity")
"""Arguments for what was too large to be written down, but is an identity."""
BROKEN: Final = (KeyError, TypeError, ValueError, AttributeError, IndexError, ArithmeticError, RecursionError)
"""What a certificate that isn't as described raises somewhere."""
RATIONAL: Final = re.compile(r"-?\d+(/\d+)?")


def coq_of(certificate: Mapping[str, Any]) -> str:
    """The text of a file of Coq for a certificate.

    **Raises:** `InputError` where the certificate isn't one of identities over the reals, or of a rational witness
    against one: it says why.
    """
    if not isinstance(certificate, Mapping) or certificate.get("certificate") != VERSION:
        raise InputError(f"this is no certificate of version {VERSION}")
    try:
        statement = Statement(certificate["tables"], certificate["known"], certificate["verdict"])
        cases = obligations(statement)
        if certificate["verdict"] == "refuted":
            if statement.surface:
                raise Unknown("a refutation on a surface")
            body = [_refutation(statement, cases[0], certificate["witness"])]
        else:
            pairs = list(zip(cases, certificate["cases"], strict=False))
            for case in cases:
                if case.measured is not None or not (case.zeros or case.nonzeros or case.positive):
                    raise Unknown("what is claimed is no identity")
            _compare("cases", len(certificate["cases"]), len(cases))
            for case, data in pairs:
                _compare("residuals", len(data["residuals"]), len(case.zeros))
            if not all("cofactors" in entry for _, data in pairs for entry in data["residuals"]):
                _reduced(certificate)
            body = [
                text for case, data in pairs for text in _proofs(statement, case, data, certificate.get("points", []))
            ]
    except (Unknown, Unreadable, TooCostly) as reason:
        raise InputError(f"this certificate can't be put in Coq: {reason}") from None
    except BROKEN as reason:
        what = f"{type(reason).__name__} {reason}"[:200]
        raise InputError(
            f"this certificate can't be put in Coq: something is missing, or isn't as it must be: {what}"
        ) from None
    numbered = [text.replace("RESIDUAL", f"residual_{k}") for k, text in enumerate(body, 1)]
    products = [PRODUCTS] if any("nonzero_product" in text for text in numbered) else []
    shared = ["\n  all_vanish " in text for text in numbered]
    heads = [*([procedure()] if any(shared) else []), *([] if all(shared) else [HEAD])]
    products += [SIGNED] if any("numerator' : 0 <" in text for text in numbered) else []
    if not any(shared) and not any("nonzero" in text for text in numbered):
        heads = [LIBRARY]
    return "\n".join([_comment(certificate), *heads, *products, *map(wrapped, numbered)])


def _compare(things: str, shown: int, stated: int) -> None:
    if shown != stated:
        raise Unknown(
            f"it shows {shown} {things}, but its claim has {stated}: it was made by another version of canon, or "
            "changed; make it anew with `canon verify FILE --certificate DIR`"
        )


def _reduced(certificate: Mapping[str, Any]) -> None:
    """Raises Unknown where an argument of the certificate is no identity modulo the relations of its kernels."""
    for reason in check(certificate).reasons:
        if "the argument" in reason:
            raise Unknown(f"{reason.split(' (')[0]} is no identity")


def _comment(certificate: Mapping[str, Any]) -> str:
    """The claim, for people."""
    tables = certificate["tables"]
    lines = [f"{certificate['verdict'].capitalize()}: a claim of kind {tables['claim']['kind']}"]
    for section, table in tables.items():
        entries = table.items() if isinstance(table, Mapping) else [("", table)]
        lines += [f"  {section}{'.' if key else ''}{key} = {value}" for key, value in entries]
    text = _harmless("\n   ".join(lines))
    return (
        f"(* {text}\n\n   What must vanish follows from these formulas by differentiation; below it is shown to. *)\n"
    )


def _proofs(s: Statement, case: Case, data: Mapping[str, Any], points: Sequence[Mapping[str, Any]]) -> list[str]:
    """A theorem for each residual; one that is the number 0 as it stands needs none."""
    if any("1j" in str(kernel["stands for"]) for kernel in data["kernels"]):
        raise Unknown("complex numbers")
    if case.positive:
        if s.claim["kind"] != "inequality":
            raise Unknown("what is claimed is no identity")
        return [inequality_of(s, a, points, strict=strict) for a, strict in case.positive]
    zeros, labels = case.zeros, [*case.labels, *[""] * len(case.zeros)]
    open_ = [target for target in zeros if s.f.value(target) is None]
    plain = all("cofactors" in entry or entry.get("argument") in REDUCED for entry in data["residuals"])
    if plain and not s.surface and _size(s.f, open_) > LONG:
        return [_shared(s, open_, data)]
    found = []
    for target, entry, label in zip(zeros, data["residuals"], labels, strict=False):
        if "cofactors" not in entry:
            raise Unknown(f"the argument {entry['argument']!r} is no identity that was written down")
        if s.f.value(target) is None:
            found.append(_named(label) + theorem_of(s, target, data, entry))
    return found or ["Theorem RESIDUAL : 0 = 0.\nProof. reflexivity. Qed.\n"]


def _named(label: str) -> str:
    """What a residual is, for people: the bracket, the difference of two sides."""
    return f"(* {_harmless(label)} *)\n" if label else ""


UNSEEN: Final = frozenset({"Cc", "Cf", "Cs", "Cn", "Co", "Zl", "Zp"})
"""Kinds of characters that are no letters and no spaces: they move what stands beside them."""


def _harmless(text: str) -> str:
    """Words for a comment: what would end it, or begin a string in it, or be read backwards, is written otherwise."""
    plain = "".join(
        c if c == "\n" or unicodedata.category(c) not in UNSEEN else "\N{REPLACEMENT CHARACTER}" for c in text
    )
    return plain.replace("(*", "( *").replace("*)", "* )").replace('"', "'")


def _size(f: Formulas, targets: Sequence[int]) -> int:
    """How many operations the residuals have when written out."""
    sizes: dict[int, int] = {}
    for a in f.rational(targets)[0]:
        sizes[a] = 1 + sum(sizes.get(b, 1) for b in f.parts(a))
    return sum(sizes.get(a, 1) for a in targets)


def _shared(s: Statement, targets: Sequence[int], data: Mapping[str, Any]) -> str:
    """One theorem for all residuals, with names for what they share."""
    f = s.f
    atoms = atoms_of(f, targets, data)
    used = {name for pair in atoms.values() for p in pair for name in names_of(p)}
    for entry in data["residuals"]:
        used |= {name for k, c in entry.get("cofactors", {}).items() for name in (k, *names_of(c))}
    kernels = used_kernels(f, data["kernels"], used)
    free = sorted(used - {kernel["name"] for kernel in kernels})
    words = identifiers([*free, *(kernel["name"] for kernel in kernels)])
    words |= {kernel["name"]: "PI" for kernel in kernels if kernel["stands for"] == "pi"}
    made = kernels_of(f, kernels, words)
    words |= {kernel.name: kernel.word for kernel in made}
    signs = {name: SIGNS[sign].format(words[name]) for name in free for sign in SIGNS if sign in s.words.get(name, ())}
    return theorem(s, targets, atoms, words, kernels, made, signs)


def _refutation(s: Statement, case: Case, witness: Mapping[str, Any] | None) -> str:
    """A residual that is a rational function isn't 0 at the witness; of an inequality, a difference isn't positive."""
    f = s.f
    # what has to hold of each residual, and what is shown instead
    claims = [(target, lambda value: value == 0, "<>") for target in case.zeros]
    if s.claim["kind"] == "inequality":
        claims += [
            (target, (lambda value: value > 0) if strict else (lambda value: value >= 0), "<=" if strict else "<")
            for target, strict in case.positive
        ]
    if witness is None:
        raise Unknown("a refutation without a point")
    values = {name: f.number(value) for name, value in witness.items() if RATIONAL.fullmatch(str(value))}
    for target, holds, instead in claims:
        leaves = f.rational([target])[1]
        names = sorted({f.ops[a][1] for a in leaves if f.ops[a][0] == "s"})
        if all(f.ops[a][0] == "s" and f.ops[a][1] in values for a in leaves):
            value = f.value(f.substitute(target, values))
            if value is not None and not holds(value):
                words = identifiers(names)
                shown = term(f, target, {a: words[f.ops[a][1]] for a in leaves})
                equations = [f"  {words[n]} = {number(f.value(values[n]) or Fraction(0))} ->" for n in names]
                proof = (
                    f"  intros. assert (value' : {shown} = {number(value)}) by (subst; field).\n  rewrite value'. lra."
                )
                proof = proof if names else "  lra."
                head = ["Theorem RESIDUAL :", *([f"  forall {' '.join(words.values())} : R,"] if names else [])]
                return "\n".join([*head, *equations, f"  {shown} {instead} 0.", "Proof.", proof, "Qed.", ""])
    raise Unknown("no residual is a rational function of the witness's coordinates")
