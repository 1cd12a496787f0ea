"""Certificates as files of Coq: each residual of the claim is 0 over the reals, with a proof that coqc checks.

A theorem states a residual with its square roots, sines and so on as Coq's own functions; a function that Coq's library
lacks is any real number that satisfies its relation. It is proved by writing the residual as numerator / denominator
(`field`), the numerator as Σ cofactor · relation (`ring`), and each relation by a lemma of the library.
"""

from __future__ import annotations

import re
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
from canon.report.coq_field import Fractions, scaled
from canon.report.coq_kernels import Kernel, kernels_of
from canon.report.coq_powers import powers
from canon.report.coq_shared import procedure, theorem
from canon.report.coq_text import identifiers, number, polynomial, term, wrapped

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
SIGNS: Final = {"positive": "0 < {}", "negative": "{} < 0", "nonzero": "{} <> 0"}


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
            body = [_refutation(statement, cases[0].zeros, certificate["witness"])]
        else:
            pairs = list(zip(cases, certificate["cases"], strict=False))
            for case in cases:
                if case.measured is not None or case.positive or not (case.zeros or case.nonzeros):
                    raise Unknown("what is claimed is no identity")
            _compare("cases", len(certificate["cases"]), len(cases))
            for case, data in pairs:
                _compare("residuals", len(data["residuals"]), len(case.zeros))
            if not all("cofactors" in entry for _, data in pairs for entry in data["residuals"]):
                _reduced(certificate)
            body = [text for case, data in pairs for text in _proofs(statement, case, data)]
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


def _proofs(s: Statement, case: Case, data: Mapping[str, Any]) -> list[str]:
    """A theorem for each residual; one that is the number 0 as it stands needs none."""
    if any("1j" in str(kernel["stands for"]) for kernel in data["kernels"]):
        raise Unknown("complex numbers")
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
            found.append(_named(label) + _theorem(s, target, data, entry))
    return found or ["Theorem RESIDUAL : 0 = 0.\nProof. reflexivity. Qed.\n"]


def _named(label: str) -> str:
    """What a residual is, for people: the bracket, the difference of two sides."""
    return f"(* {_harmless(label)} *)\n" if label else ""


def _harmless(text: str) -> str:
    """Words for a comment: what would end it, or begin a string in it, is written otherwise."""
    return text.replace("(*", "( *").replace("*)", "* )").replace('"', "'")


def _size(f: Formulas, targets: Sequence[int]) -> int:
    """How many operations the residuals have when written out."""
    sizes: dict[int, int] = {}
    for a in f.rational(targets)[0]:
        sizes[a] = 1 + sum(sizes.get(b, 1) for b in f.parts(a))
    return sum(sizes.get(a, 1) for a in targets)


def _shared(s: Statement, targets: Sequence[int], data: Mapping[str, Any]) -> str:
    """One theorem for all residuals, with names for what they share."""
    f = s.f
    atoms = _atoms(f, targets, data)
    used = {name for pair in atoms.values() for p in pair for name in _names(p)}
    for entry in data["residuals"]:
        used |= {name for k, c in entry.get("cofactors", {}).items() for name in (k, *_names(c))}
    kernels = _used_kernels(f, data["kernels"], used)
    free = sorted(used - {kernel["name"] for kernel in kernels})
    words = identifiers([*free, *(kernel["name"] for kernel in kernels)])
    words |= {kernel["name"]: "PI" for kernel in kernels if kernel["stands for"] == "pi"}
    made = kernels_of(f, kernels, words)
    words |= {kernel.name: kernel.word for kernel in made}
    signs = {name: SIGNS[sign].format(words[name]) for name in free for sign in SIGNS if sign in s.words.get(name, ())}
    return theorem(s, targets, atoms, words, kernels, made, signs)


def _atoms(f: Formulas, targets: Sequence[int], data: Mapping[str, Any]) -> dict[int, Sequence[Mapping[str, str]]]:
    """The value of each name and function in the formulas, as [numerator, denominator] in the kernels."""
    leaves = f.rational(targets)[1]
    return {a: data["atoms"].get(f.text(a), [{f.text(a): "1"}, {"": "1"}]) for a in leaves}


def _theorem(s: Statement, target: int, data: Mapping[str, Any], entry: Mapping[str, Any]) -> str:
    f = s.f
    on = {f"surface {k}": a for k, a in enumerate(s.surface, 1) if f"surface {k}" in entry["cofactors"]}
    atoms = _atoms(f, [target, *on.values()], data)
    used = {name for pair in atoms.values() for p in pair for name in _names(p)}
    used |= {name for k, c in entry["cofactors"].items() for name in (*({k} - on.keys()), *_names(c))}
    kernels = _used_kernels(f, data["kernels"], used)
    free = sorted(used - {kernel["name"] for kernel in kernels})
    words = identifiers([*free, *(kernel["name"] for kernel in kernels)])
    words |= {kernel["name"]: "PI" for kernel in kernels if kernel["stands for"] == "pi"}
    made = kernels_of(f, kernels, words)
    words |= {kernel.name: kernel.word for kernel in made}
    fractions = Fractions(f, list(words), atoms)
    equations = [_surface(fractions, name, a, atoms, words) for name, a in on.items()]
    value, factor = _value(fractions, target, entry)
    signs = [(name, sign) for name in free for sign in SIGNS if sign in s.words.get(name, ())]
    assumed = [SIGNS[sign].format(words[name]) for name, sign in signs]
    known = {name for name, _ in signs} | {kernel.name for kernel in made if kernel.positive}
    equal = powers(kernels, made, words, entry["cofactors"]) if value[0] and not on else None
    nonzero = "nonzero_product" if equal else "nonzero"
    facts, hypotheses = _denominators(fractions, words, known, made, nonzero)
    hypotheses = [*assumed, *(h for kernel in made for h in kernel.hypotheses), *hypotheses]
    hypotheses += [h for equation in equations for h in equation.hypotheses]
    residual = term(f, target, {a: _fraction(pair, words) for a, pair in atoms.items()})
    variables = [words[name] for name in free] + [kernel.word for kernel in made if kernel.word != "PI"]
    statement = [
        *([f"  forall {' '.join(variables)} : R,"] if variables else []),
        *(f"  {h} ->" for h in dict.fromkeys(hypotheses)),
        f"  {residual} = 0.",
    ]
    divides = any(product for _, product in fractions.products())
    needed = {*entry["cofactors"], *(kernel.name for kernel in made if divides)}
    steps = ["intros.", *(step for kernel in made for step in kernel.steps_for(kernel.name in needed)), *facts]
    steps += [step for equation in equations for step in equation.steps]
    shown = {a: _fraction(pair, words) for a, pair in atoms.items()}
    steps += _factored(fractions, shown, words, nonzero)
    if not value[0]:
        steps.append("field; nonzero." if divides else "field.")
    elif equal is not None and not equal.replaced:
        steps += [*equal.steps, f"field [{' '.join(equal.names)}]; nonzero_product."]
    else:
        over, under = polynomial(fractions.table(value[0]), words), _product(fractions, Fraction(1), value[1], words)
        if equal is not None:
            replaced = "".join(f"rewrite {name}. " for name in equal.replaced)
            steps += [*equal.steps, f"assert (numerator' : {over} = 0)."]
            steps.append(f"{{ {replaced}field [{' '.join(equal.names)}]. }}")
        else:
            steps += _combination(entry["cofactors"], factor, {k.name: k for k in [*made, *equations]}, over, words)
        steps += [
            "match goal with |- ?residual = 0 =>",
            f"  replace residual with (({over}) / ({under})) by (field; {nonzero}) end.",
            "rewrite numerator'. unfold Rdiv. apply Rmult_0_l.",
        ]
    return "\n".join(["Theorem RESIDUAL :", *statement, "Proof.", *(f"  {step}" for step in steps), "Qed.", ""])


def _combination(
    cofactors: Mapping[str, Any], factor: Fraction, relations: Mapping[str, Kernel], over: str, words: Mapping[str, str]
) -> list[str]:
    """The numerator as Σ cofactor · relation, and so 0."""
    terms = [f"({polynomial(scaled(c, factor), words)}) * ({relations[k].relation})" for k, c in cofactors.items()]
    return [
        f"assert (numerator' : {over} = 0).",
        f"{{ replace ({over})\n      with ({' + '.join(terms)}) by field.",
        f"   rewrite {', '.join(relations[k].lemma for k in cofactors)}.",
        "   rewrite ?Rmult_0_r, ?Rplus_0_r. reflexivity. }",
    ]


def _surface(
    fractions: Fractions,
    name: str,
    equation: int,
    atoms: Mapping[int, Sequence[Mapping[str, str]]],
    words: Mapping[str, str],
) -> Kernel:
    """An equation of a surface: a hypothesis, and as a step, that the numerator is 0."""
    over, under = fractions.value(equation)
    shown = term(fractions.f, equation, {a: _fraction(pair, words) for a, pair in atoms.items()})
    relation, lemma = polynomial(fractions.table(over), words), name.replace(" ", "'")
    product = _product(fractions, Fraction(1), under, words)
    on, cleared = f"assert ({lemma}' : {shown} = 0) by assumption.", f"({shown}) * ({product})"
    proof = f"replace ({relation}) with ({cleared}) by (field; nonzero); rewrite {lemma}'; apply Rmult_0_l"
    return Kernel(
        name, "", (f"{shown} = 0",), (on, f"assert ({lemma} : {relation} = 0) by ({proof})."), relation, lemma, False
    )


def _names(table: Mapping[str, str]) -> set[str]:
    return {factor.partition("^")[0] for monomial in table for factor in monomial.split()}


def _fraction(pair: Sequence[Mapping[str, str]], words: Mapping[str, str]) -> str:
    over = polynomial(pair[0], words)
    return over if pair[1] == {"": "1"} else f"(({over}) / ({polynomial(pair[1], words)}))"


def _used_kernels(f: Formulas, kernels: Sequence[Mapping[str, Any]], used: set[str]) -> list[Mapping[str, Any]]:
    """The kernels in use, and those that they are made of; names that they need are added to `used`."""
    found = []
    for kernel in reversed(kernels):
        if kernel["name"] in used:
            node = f.read(kernel["stands for"], {})
            used |= {f.ops[a][1] for a in f.reach(node) if f.ops[a][0] == "s" and f.ops[a][1] != "pi"}
            used |= _names(kernel.get("relation", {}))
            found.append(kernel)
    return found[::-1]


def _value(fractions: Fractions, target: int, entry: Mapping[str, Any]) -> tuple[Any, Fraction]:
    """The residual as a fraction, and its numerator over the certificate's, which is a number."""
    value = fractions.value(target)
    stated = fractions.polynomial(entry["numerator"])
    if not value[0] or not stated:
        if value[0] or stated:
            raise Unknown("a numerator that isn't the residual's")
        return value, Fraction(1)
    factor = fractions.ring.leading(value[0]) / fractions.ring.leading(stated)
    if value[0] != fractions.ring.scaled(stated, factor):
        raise Unknown("a numerator that isn't the residual's")
    return value, factor


def _denominators(
    fractions: Fractions, words: Mapping[str, str], known: set[str], kernels: Sequence[Kernel], nonzero: str
) -> tuple[list[str], list[str]]:
    """Why the factors of what is divided by aren't 0: steps of the proof, or hypotheses where nothing says so."""
    steps: list[str] = []
    hypotheses: list[str] = []
    radicands = [fractions.polynomial(dict(kernel.radicand)) for kernel in kernels if kernel.radicand]
    for k in dict.fromkeys(k for _, product in fractions.products() for k in product):
        factor = fractions.field.factors[k]
        shown, name = polynomial(fractions.table(factor), words), fractions.name_of(k)
        if name is not None and name in known:
            continue
        if any(factor in (radicand, -radicand) for radicand in radicands):
            steps.append(f"assert ({shown} <> 0) by (first [apply Rgt_not_eq; lra | apply Rlt_not_eq; lra]).")
        else:
            hypotheses.append(f"{shown} <> 0")
    for base in (*fractions.bases, *(fractions.values[a] for a in dict.fromkeys(fractions.divisors))):
        content, product = fractions.field.split_denominator(base[0])
        if len(fractions.ring.terms(base[0])) > 1 and sum(product.values()) > 1:
            shown = polynomial(fractions.table(base[0]), words)
            factored = _product(fractions, content, product, words)
            steps.append(f"try assert ({shown} <> 0) by (replace ({shown}) with ({factored}) by field; {nonzero}).")
    return list(dict.fromkeys(steps)), hypotheses


def _factored(fractions: Fractions, leaves: dict[int, str], words: Mapping[str, str], nonzero: str) -> list[str]:
    """Steps that write what is divided by as a fraction of products, inner ones first; `leaves` gets these texts."""
    steps: list[str] = []
    for a in sorted(set(fractions.divisors) - leaves.keys()):
        over, under = fractions.values[a]
        content, product = fractions.field.split_denominator(over)
        plain = len(fractions.ring.terms(over)) == 1 and fractions.f.ops[a][0] != "+"
        inverse = any(op[0] == "^" and op[2] < 0 for op in map(fractions.f.ops.__getitem__, fractions.f.reach(a)))
        if not under and not inverse and (plain or (sum(product.values()) == 1 and abs(content) == 1)):
            continue  # `field` sees by itself what a product is made of
        name, value = f"factored'{len(steps)}", f"{_product(fractions, content, product, words)}"
        value = f"{value} / ({_product(fractions, Fraction(1), under, words)})"
        shown = term(fractions.f, a, leaves)
        steps.append(f"assert ({name} : {shown} = {value}) by (field; {nonzero}). try rewrite {name}.")
        leaves[a] = value
    return steps


def _product(fractions: Fractions, content: Fraction, product: Mapping[int, int], words: Mapping[str, str]) -> str:
    """constant * factor ^ exponent * …"""
    factors = [f"({polynomial(fractions.table(fractions.field.factors[k]), words)}) ^ {e}" for k, e in product.items()]
    return " * ".join([number(content), *factors])


def _refutation(s: Statement, zeros: Sequence[int], witness: Mapping[str, Any] | None) -> str:
    """A residual that is a rational function isn't 0 at the witness."""
    f = s.f
    if witness is None:
        raise Unknown("a refutation without a point")
    values = {name: f.number(value) for name, value in witness.items() if RATIONAL.fullmatch(str(value))}
    for target in zeros:
        leaves = f.rational([target])[1]
        names = sorted({f.ops[a][1] for a in leaves if f.ops[a][0] == "s"})
        if all(f.ops[a][0] == "s" and f.ops[a][1] in values for a in leaves):
            value = f.value(f.substitute(target, values))
            if value:
                words = identifiers(names)
                shown = term(f, target, {a: words[f.ops[a][1]] for a in leaves})
                equations = [f"  {words[n]} = {number(f.value(values[n]) or Fraction(0))} ->" for n in names]
                proof = (
                    f"  intros. assert (value' : {shown} = {number(value)}) by (subst; field).\n  rewrite value'. lra."
                )
                proof = proof if names else "  lra."
                head = ["Theorem RESIDUAL :", *([f"  forall {' '.join(words.values())} : R,"] if names else [])]
                return "\n".join([*head, *equations, f"  {shown} <> 0.", "Proof.", proof, "Qed.", ""])
    raise Unknown("no residual is a rational function of the witness's coordinates")
