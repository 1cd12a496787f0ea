"""Refutations of claims with the imaginary unit, beside `counterexample.py`: a complex formula is two real ones.

Names are real. Sums, products, quotients, whole powers, exponentials, derivatives and brackets of such pairs are
written out; of all else only what is real has a meaning here.
"""

from __future__ import annotations

import ast
import re
from itertools import combinations
from typing import Any

if __package__:
    from canon.checker.alone import Formula, Stop, number
    from canon.checker.counterexample import Arithmetic, Open, check_domain, fails, somewhere
    from canon.checker.counterexample_formulas import NOUGHT, UNIT, is_nought, times, total
    from canon.checker.counterexample_functions import Place
    from canon.checker.counterexample_integrals import claim_with
else:  # as a program's part, beside the other files
    from alone import Formula, Stop, number  # type: ignore
    from counterexample import Arithmetic, Open, check_domain, fails, somewhere  # type: ignore
    from counterexample_formulas import NOUGHT, UNIT, is_nought, times, total  # type: ignore
    from counterexample_functions import Place  # type: ignore
    from counterexample_integrals import claim_with  # type: ignore

BITS, TRIES, MOST_POWER, MOST = (64, 192), 3, 12, 4000
Pair = tuple[Formula, Formula]
"""The real part and the imaginary part."""


class Reader:
    """The two parts of a claim's texts; `met` are all parts on the way, which have to have values."""

    def __init__(self, claim: Any, definitions: Any, pairs: Any) -> None:
        self.claim, self.definitions, self.pairs, self.met = claim, definitions, pairs, list[Formula]()
        self.known = dict[str, Pair]()

    def text(self, text: Any) -> Pair:
        """What a text is."""
        plain = re.sub(r"[^\w ()\[\],.+*/-]", "?", " ".join(str(text).split()))
        marked = re.sub(r"(?<![\w.])[^\W\d]\w*", r"_\g<0>", plain)
        return self.built(ast.parse(marked, mode="eval").body, marked)

    def built(self, at: Any, text: str) -> Pair:
        """The parts of a syntax tree in this text."""
        found = self.parts(at, text)
        self.met += found
        if len(self.met) > MOST:
            raise Stop("not shown", "formulas that are so long")
        return found

    def parts(self, at: Any, text: str) -> Pair:
        if isinstance(at, ast.Constant):
            said = ast.get_source_segment(text, at) or ""
            return (NOUGHT, number(said[:-1])) if said[-1:] in "jJ" else (number(said), NOUGHT)
        if isinstance(at, ast.Name):
            return self.name(at.id[1:])
        if isinstance(at, ast.UnaryOp):
            a = self.built(at.operand, text)
            return self.product((number(-1), NOUGHT), a) if isinstance(at.op, ast.USub) else a
        if isinstance(at, ast.BinOp):
            return self.operation(at, self.built(at.left, text), self.built(at.right, text))
        called = getattr(getattr(at, "func", None), "id", "_")[1:]
        if called == "D":
            (a, b), (name, *times_) = self.built(at.args[0], text), at.args[1:]
            n = int(ast.get_source_segment(text, times_[0]) or 0) if times_ else 1
            return self.slope(a, name.id[1:], n), self.slope(b, name.id[1:], n)
        if called == "bracket":
            x, y = (self.built(item, text) for item in at.args)
            return self.bracket(x, y)
        given = [self.built(item, text) for item in at.args]
        if all(is_nought(b) for _, b in given) and not at.keywords:
            if "function" in self.claim.words.get(called, ()):
                return Formula(called, tuple(a for a, _ in given), (0,) * len(given)), NOUGHT
            if called in {*self.claim.names, *self.claim.words, *self.definitions}:
                raise Stop("not shown", "a name that is called")
            return self.claim.made(called, *(a for a, _ in given)), NOUGHT
        if called == "exp" and len(given) == 1:
            (a, b), made = given[0], self.claim.made
            size = made("exp", a)
            return times(self.claim, size, made("cos", b)), times(self.claim, size, made("sin", b))
        raise Stop("not shown", f"{called[:40]} of a complex number")

    def name(self, name: str) -> Pair:
        """A name, or what a definition says of it."""
        if name in self.definitions:
            if name not in self.known:
                self.known[name] = self.text(self.definitions[name])
            return self.known[name]
        if name not in {*self.claim.names, *self.claim.words, "pi"} or "function" in self.claim.words.get(name, ()):
            raise Stop("not shown", f"what {name[:40]} is")
        return Formula(".", (name,)), NOUGHT

    def slope(self, f: Formula, name: str, n: int) -> Formula:
        """A derivative, by a name that moves or is declared."""
        if name in self.definitions or name not in {*self.claim.names, *self.claim.words} or not 0 <= n <= 4:
            raise Stop("not shown", f"a derivative by {name[:40]}")
        return NOUGHT if f.kind == "#" and n else Formula("D", (f,), (name,) * n)

    def sum(self, x: Pair, y: Pair) -> Pair:
        return total(self.claim, x[0], y[0]), total(self.claim, x[1], y[1])

    def product(self, x: Pair, y: Pair) -> Pair:
        (a, b), (c, d), t = x, y, lambda u, v: times(self.claim, u, v)
        minus = t(number(-1), t(b, d))
        return total(self.claim, t(a, c), minus), total(self.claim, t(a, d), t(b, c))

    def inverse(self, x: Pair) -> Pair:
        (a, b), made = x, self.claim.made
        if is_nought(b):
            return made("^", a, number(-1)), NOUGHT
        size = made("^", total(self.claim, times(self.claim, a, a), times(self.claim, b, b)), number(-1))
        return times(self.claim, a, size), times(self.claim, number(-1), times(self.claim, b, size))

    def operation(self, at: Any, x: Pair, y: Pair) -> Pair:
        """A sum, a difference, a product, a quotient, or a power."""
        if isinstance(at.op, ast.Add | ast.Sub):
            return self.sum(x, y if isinstance(at.op, ast.Add) else self.product((number(-1), NOUGHT), y))
        if isinstance(at.op, ast.Mult | ast.Div):
            return self.product(x, y if isinstance(at.op, ast.Mult) else self.inverse(y))
        if not isinstance(at.op, ast.Pow):
            raise Stop("not shown", "an operation that isn't one of the language")
        if is_nought(x[1]) and is_nought(y[1]):
            return self.claim.made("^", x[0], y[0]), NOUGHT
        r = y[0].of[0] if y[0].kind == "#" and is_nought(y[1]) else None
        if r is None or r.denominator != 1 or abs(r) > MOST_POWER:
            raise Stop("not shown", "such a power of a complex number")
        found = (UNIT, NOUGHT)
        for _ in range(abs(int(r))):
            found = self.product(found, x)
        return self.inverse(found) if r < 0 else found

    def bracket(self, x: Pair, y: Pair) -> Pair:
        """Poisson's, of which each part is a sum."""
        found = (NOUGHT, NOUGHT)
        d = lambda pair, name: (self.slope(pair[0], name, 1), self.slope(pair[1], name, 1))
        for q, p in self.pairs:
            found = self.sum(found, self.product(d(x, q), d(y, p)))
            found = self.sum(found, self.product((number(-1), NOUGHT), self.product(d(x, p), d(y, q))))
        return found


def zeros(tables: Any) -> tuple[list[str], dict[str, Any], list[str]]:
    """What has to vanish, with what stands for new variables, which are definitions then; and the keys of the claim."""
    claim, space, explicit = tables["claim"], tables["phase_space"], tables.get("transformation", {})
    kind, time = claim["kind"], space.get("time", "t")
    if kind in ("canonical", "fundamental_brackets") and {*explicit} == {"Q", "P"} and {*claim} == {"kind"}:
        new = dict(zip([*space["Q"], *space["P"]], [*explicit["Q"], *explicit["P"]], strict=True))
        x, n = [*new], len(space["Q"])
        return [f"bracket({x[i]}, {x[j]}) - {int(j == i + n)}" for i, j in combinations(range(len(x)), 2)], new, []
    rows = {"identity": "lhs - rhs", "bracket": "bracket(f, g) - equals", "conserved": f"D(f, {time}) + bracket(f, H)"}
    keys = {"identity": ["lhs", "rhs"], "bracket": ["f", "g", "equals"], "conserved": ["f"]}.get(kind, [])
    if not keys or {*claim} != {"kind", *keys} or explicit:
        raise Stop("not shown", "a refutation of such a claim")
    texts = {key: claim[key] for key in keys} | {"H": tables.get("hamiltonian", {}).get("H", "0")}
    row = re.sub(r"\b(lhs|rhs|f|g|equals|H)\b", lambda m: f"({texts[m[1]]})", rows[kind])
    return [row], {}, keys


RULES = {"canonical", "fundamental_brackets", "identity", "bracket", "conserved"}


def refuted(tables: Any, witness: Any, known: Any = None) -> tuple[str, str]:
    """Whether the claim fails at the witness."""
    del known
    if tables["claim"]["kind"] not in RULES or not isinstance(witness, dict) or "generating_function" in tables:
        raise Stop("not shown", "a refutation of such a claim")
    texts, new, _ = zeros(tables)
    space = tables["phase_space"]
    names = {*space["q"], *space["p"], *space.get("Q", []), *space.get("P", [])}
    if len(names) < sum(len(space.get(side, [])) for side in "qpQP") or {*new} & {*tables.get("definitions", {})}:
        raise Stop("not shown", "names with two meanings")
    if {*tables.get("symbols", {})} & {*new}:
        raise Stop("not shown", "new variables of which something is assumed")
    kept = ("phase_space", "symbols", "domain", "hamiltonian", "definitions")
    base = {key: x for key, x in tables.items() if key in kept}
    asked = claim_with(base, [], {})
    reader = Reader(asked, {**tables.get("definitions", {}), **new}, [*zip(space["q"], space["p"], strict=True)])
    found = [part for text in texts for part in reader.text(text)]
    reason = "that something fails at the witness"
    for k, bits in ((k, bits) for k in range(TRIES) for bits in BITS):
        point = Place(asked, somewhere(asked, witness, k), Arithmetic(bits))
        try:
            check_domain(point, {"hamiltonian": tables.get("hamiltonian", {})})
            for f in reader.met:
                point.at(f)
            if any(fails(point.at(f), "") for f in found):
                return "shown", ""
        except Open as left:
            reason = str(left)
    return "not shown", reason
