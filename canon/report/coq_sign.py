"""An inequality of rational functions as a theorem of Coq, which rests on the signs of factors.

Numerator and denominator are products. Of a factor that has an odd power the sign is shown term by term, or with the
differences that the domain says to be positive as new names, or by `nra`, which is told the squares that complete a
quadratic polynomial: of a x² + … it is 4 a p = (∂p/∂x)² − discriminant. What has an even power isn't negative.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from math import prod
from typing import Any, Final

from canon.checker.functions import Unknown
from canon.checker.statement import Statement
from canon.report.coq_field import Fractions, scaled
from canon.report.coq_text import identifiers, number, polynomial, term
from canon.report.coq_theorem import SIGNS

ASSUMED: Final = {**SIGNS, "nonnegative": "0 <= {}"}
SIGNED: Final = """\
Lemma square_positive (x : R) : x <> 0 -> 0 < x ^ 2.
Proof. intro H. destruct (Rdichotomy _ _ H); nra. Qed.

(* What is not negative, or positive, factor by factor and term by term. *)
Ltac not_negative :=
  match goal with
  | |- _ => assumption
  | |- 0 <= _ + _ => apply Rplus_le_le_0_compat; not_negative
  | |- 0 <= _ * _ => apply Rmult_le_pos; not_negative
  | |- 0 <= _ ^ 2 => apply pow2_ge_0
  | |- 0 <= ?a ^ 4 => replace (a ^ 4) with ((a ^ 2) ^ 2) by ring; apply pow2_ge_0
  | |- 0 <= _ ^ _ => apply pow_le; not_negative
  | |- _ => lra
  end.
Ltac positive :=
  match goal with
  | |- _ => assumption
  | |- 0 < _ + _ => first [ apply Rplus_lt_le_0_compat; [ positive | not_negative ]
                          | apply Rplus_le_lt_0_compat; [ not_negative | positive ] ]
  | |- 0 < _ * _ => apply Rmult_lt_0_compat; positive
  | |- 0 < (_ ^ _) ^ 2 => apply square_positive; apply pow_nonzero; nonzero
  | |- 0 < _ ^ 2 => apply square_positive; nonzero
  | |- 0 < _ ^ _ => apply pow_lt; positive
  | |- _ => lra
  end.
(* A difference that is positive is a name; what is larger is the sum of that and of what is less. *)
Ltac with_differences :=
  repeat match goal with
  | H : 0 < ?a - ?b |- _ =>
      is_var a; let d := fresh "d" in remember (a - b) as d;
      match goal with E : d = a - b |- _ => assert (a = b + d) by lra; clear E; subst a end
  end; ring_simplify.
"""
"""What a file with an inequality begins with."""
NEAR_PI: Final = Fraction(355, 113)
HIGHEST: Final = 4
"""The degree in one name above which terms of both signs are too much for `nra`."""


def inequality_of(s: Statement, target: int, points: Sequence[Mapping[str, Any]], *, strict: bool) -> str:
    """The theorem that a rational function is positive, or nowhere negative, on the claim's domain.

    `points` of the domain tell the signs that are tried. Raises Unknown where the theorem can't be written so.
    """
    f = s.f
    if s.surface or any(sign in text for text in s.domain.get("where", []) for sign in ("<=", ">=")):
        raise Unknown("an inequality on a surface, or with an edge of the domain")
    leaves = _leaves(s, target)
    if leaves is None:
        raise Unknown("an inequality with functions in it")
    conditions = {
        a: (kind, of) for a, kind in s.conditions if (of := _leaves(s, a)) and {*of.values()} & {*leaves.values()}
    }
    for _, of in conditions.values():
        leaves |= of
    free = sorted({*leaves.values()} - {"pi"})
    words = identifiers(free) | {"pi": "PI"}
    texts = {a: words[name] for a, name in leaves.items()}
    fractions = Fractions(f, sorted({*leaves.values()}), {a: ({name: "1"}, {"": "1"}) for a, name in leaves.items()})
    over, under = fractions.value(target)
    content, above = fractions.field.split_denominator(over)
    hypotheses = [ASSUMED[sign].format(words[n]) for n in free for sign in ASSUMED if sign in s.words.get(n, ())]
    for a, (kind, _) in conditions.items():
        hypotheses.append(("0 < {}" if kind == "positive" else "{} <> 0").format(term(f, a, texts)))
    for k in dict.fromkeys(k for _, product in fractions.products() for k in product):
        if not {"positive", "negative", "nonzero"} & {*s.words.get(fractions.name_of(k) or "", ())}:
            hypotheses.append(f"{polynomial(fractions.table(fractions.field.factors[k]), words)} <> 0")

    words_of = [s.words.get(fractions.name_of(k) or "", ()) for k in (*above, *under)]
    signs = {
        k: -1 if "negative" in of else _sign(fractions.table(fractions.field.factors[k]), points)
        for k, of in zip((*above, *under), words_of, strict=True)
    }
    content *= prod(signs[k] for product in (above, under) for k, e in product.items() if e % 2)
    if content < 0 or (strict and not content):
        raise Unknown("an inequality that isn't seen from the signs of factors")
    tables = {k: scaled(fractions.table(fractions.field.factors[k]), Fraction(signs[k])) for k in signs}
    top, bottom = (_product(product, tables, c, words) for product, c in ((above, content), (under, Fraction(1))))
    shown, sign = term(f, target, texts), "<" if strict else "<="
    statement = [
        *([f"  forall {' '.join(words[name] for name in free)} : R,"] if free else []),
        *(f"  {h} ->" for h in dict.fromkeys(hypotheses)),
        f"  0 {sign} {shown}.",
    ]
    if not content:
        zero = [f"  replace ({shown}) with 0 by (field; nonzero).", "  lra."]
        return "\n".join(["Theorem RESIDUAL :", *statement, "Proof.", "  intros.", *zero, "Qed.", ""])
    steps = ["intros.", *(["pose proof PI_RGT_0."] if "pi" in leaves.values() else [])]
    needed = {k: sign if e % 2 else "<>" for k, e in above.items() if strict or e % 2}
    needed |= {k: "<" for k, e in under.items() if e % 2}
    for j, (k, less) in enumerate(needed.items(), 1):
        if fractions.name_of(k) is None or above.get(k, under.get(k, 0)) % 2:
            _reachable(tables[k], s)
            if "positive" not in s.words.get(fractions.name_of(k) or "", ()):
                steps += _factor(f"factor'{j}", tables[k], less, words)
    steps += [f"assert (numerator' : 0 {sign} {top}) by {'positive' if strict else 'not_negative'}."]
    steps += [f"assert (denominator' : 0 < {bottom}) by positive."]
    steps += [f"replace ({shown}) with (({top}) / ({bottom})) by (field; nonzero)."]
    steps += ["apply Rdiv_lt_0_compat; assumption."] if strict else [
        "unfold Rdiv. apply Rmult_le_pos; [ assumption | apply Rlt_le, Rinv_0_lt_compat; assumption ]."
    ]  # fmt: skip
    return "\n".join(["Theorem RESIDUAL :", *statement, "Proof.", *(f"  {step}" for step in steps), "Qed.", ""])


def _reachable(table: Mapping[str, str], s: Statement) -> None:
    """Raises Unknown where the tactics have no chance: terms of both signs, with π's digits, of a high degree, or for
    whole numbers alone.
    """
    powers = [dict(_power(factor) for factor in monomial.split()) for monomial in table]
    signed = {"pi", *(name for name, of in s.words.items() if {"positive", "nonnegative"} & {*of})}
    if all(
        Fraction(c) > 0 and all(e % 2 == 0 or name in signed for name, e in each.items())
        for each, c in zip(powers, table.values(), strict=True)
    ):
        return
    if any("integer" in s.words.get(name, ()) for each in powers for name in each):
        raise Unknown("an inequality about whole numbers")
    if any("pi" in each for each in powers):
        raise Unknown("an inequality about digits of pi")
    if max((e for each in powers for e in each.values()), default=0) > HIGHEST:
        raise Unknown("an inequality of a high degree")


def _factor(name: str, table: Mapping[str, str], less: str, words: Mapping[str, str]) -> Iterator[str]:
    """Steps that show a factor's sign, or that it isn't 0, which a sign shows as well."""
    text, tactic = polynomial(table, words), "not_negative" if less == "<=" else "positive"
    hints = "".join(f"pose proof (pow2_ge_0 ({hint})); " for hint in _slopes(table, words))
    shown = f"first [ solve [ {tactic} ] | solve [ with_differences; {tactic} ] | {hints}nra ]"
    if less == "<>":
        yield f"assert ({name} : {text} <> 0) by (first [ solve [ nonzero ] | apply Rgt_not_eq; {shown} ])."
    else:
        yield f"assert ({name} : 0 {less} {text}).\n  {{ {shown}. }}"


def _leaves(s: Statement, target: int) -> dict[int, str] | None:
    """The names that a formula is a rational function of; None where functions or complex numbers are in it."""
    leaves = s.f.rational([target])[1]
    found = {a: s.f.ops[a][1] for a in leaves if s.f.ops[a][0] == "s"}
    odd = any(name == "1j" or "complex" in s.words.get(name, ()) for name in found.values())
    return None if odd or len(found) < len(leaves) else found


def _sign(table: Mapping[str, str], points: Sequence[Mapping[str, Any]]) -> int:
    """The sign of a polynomial at the first point at which it has a value that isn't 0; 1 where there is none."""
    for point in points:
        with suppress(KeyError, ValueError, ZeroDivisionError):
            value = sum(
                Fraction(c) * prod((_value(factor, point) for factor in monomial.split()), start=Fraction(1))
                for monomial, c in table.items()
            )
            if value:
                return 1 if value > 0 else -1
    return 1


def _value(factor: str, point: Mapping[str, Any]) -> Fraction:
    name, _, exponent = factor.partition("^")
    return (NEAR_PI if name == "pi" else Fraction(str(point[name]))) ** int(exponent or 1)


def _product(
    product: Mapping[int, int], tables: Mapping[int, Mapping[str, str]], content: Fraction, words: Mapping[str, str]
) -> str:
    """A product of powers; even ones as squares, which aren't negative whatever is squared."""
    factors = [] if content == 1 and product else [number(content)]
    for k, e in product.items():
        text = polynomial(tables[k], words)
        text = text if text.isidentifier() else f"({text})"
        factors.append(text if e == 1 else f"{text} ^ {e}" if e % 2 or e == 2 else f"({text} ^ {e // 2}) ^ 2")
    return " * ".join(factors)


def _slopes(table: Mapping[str, str], words: Mapping[str, str]) -> Iterator[str]:
    """The derivatives of a polynomial by the names in which it is quadratic."""
    powers = [dict(_power(factor) for factor in monomial.split()) for monomial in table]
    for name in dict.fromkeys(name for each in powers for name in each):
        if max(each.get(name, 0) for each in powers) == 2:
            slope: dict[str, str] = {}
            for each, c in zip(powers, table.values(), strict=True):
                if e := each.get(name, 0):
                    rest = [*(n if k == 1 else f"{n}^{k}" for n, k in each.items() if n != name), *[name] * (e - 1)]
                    slope[" ".join(rest)] = str(e * Fraction(c))
            yield polynomial(slope, words)


def _power(factor: str) -> tuple[str, int]:
    name, _, exponent = factor.partition("^")
    return name, int(exponent or 1)
