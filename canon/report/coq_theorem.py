"""One residual as a theorem of Coq: its hypotheses, the residual itself, and the steps of a proof that it is 0."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any, Final

from canon.checker.formulas import Formulas
from canon.checker.functions import Unknown
from canon.checker.statement import Statement
from canon.report.coq_field import Fractions, scaled
from canon.report.coq_kernels import Kernel, kernels_of
from canon.report.coq_powers import powers
from canon.report.coq_text import identifiers, number, polynomial, term

SIGNS: Final = {"positive": "0 < {}", "negative": "{} < 0", "nonzero": "{} <> 0"}


def theorem_of(s: Statement, target: int, data: Mapping[str, Any], entry: Mapping[str, Any]) -> str:
    """The theorem that one residual is 0, as the certificate's entry shows it. Raises Unknown."""
    f = s.f
    on = {f"surface {k}": a for k, a in enumerate(s.surface, 1) if f"surface {k}" in entry["cofactors"]}
    atoms = atoms_of(f, [target, *on.values()], data)
    used = {name for pair in atoms.values() for p in pair for name in names_of(p)}
    used |= {name for k, c in entry["cofactors"].items() for name in (*({k} - on.keys()), *names_of(c))}
    kernels = used_kernels(f, data["kernels"], used)
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


def atoms_of(f: Formulas, targets: Sequence[int], data: Mapping[str, Any]) -> dict[int, Sequence[Mapping[str, str]]]:
    """The value of each name and function in the formulas, as [numerator, denominator] in the kernels."""
    leaves = f.rational(targets)[1]
    return {a: data["atoms"].get(f.text(a), [{f.text(a): "1"}, {"": "1"}]) for a in leaves}


def used_kernels(f: Formulas, kernels: Sequence[Mapping[str, Any]], used: set[str]) -> list[Mapping[str, Any]]:
    """The kernels in use, and those that they are made of; names that they need are added to `used`."""
    found = []
    for kernel in reversed(kernels):
        if kernel["name"] in used:
            node = f.read(kernel["stands for"], {})
            used |= {f.ops[a][1] for a in f.reach(node) if f.ops[a][0] == "s" and f.ops[a][1] != "pi"}
            used |= names_of(kernel.get("relation", {}))
            found.append(kernel)
    return found[::-1]


def names_of(table: Mapping[str, str]) -> set[str]:
    """The names in a polynomial's monomials."""
    return {factor.partition("^")[0] for monomial in table for factor in monomial.split()}


def _fraction(pair: Sequence[Mapping[str, str]], words: Mapping[str, str]) -> str:
    over = polynomial(pair[0], words)
    return over if pair[1] == {"": "1"} else f"(({over}) / ({polynomial(pair[1], words)}))"


def _product(fractions: Fractions, content: Fraction, product: Mapping[int, int], words: Mapping[str, str]) -> str:
    """constant * factor ^ exponent * …"""
    factors = [f"({polynomial(fractions.table(fractions.field.factors[k]), words)}) ^ {e}" for k, e in product.items()]
    return " * ".join([number(content), *factors])
