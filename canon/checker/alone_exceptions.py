"""Maps that are canonical for some values of parameters, and else not: `python alone_exceptions.py CERTIFICATE.json …`

A claim of kind `canonical_when` says two things. At each solution, a table name = value, the map is canonical: that is
a claim about the file with these values as definitions, which `alone.py` reads. And it is canonical at almost no values
of these parameters, whatever the other ones are. The map is made of functions that are meromorphic where the names have
their signs: what isn't 0 at one point is 0 almost nowhere then. If it is rational, a residual's numerator is written
out, and has, as a polynomial in the variables and the solutions' names, a coefficient that is 0 for no values of the
others; else there are no others, and a point is found in intervals of fractions. Both parts of the claim are about
something: a point of the domain is found at each solution, and elsewhere.

Of a certificate nothing is used.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from contextlib import suppress
from fractions import Fraction
from itertools import chain, combinations
from random import Random
from typing import Any

if __package__:
    from canon.checker import alone, alone_signs, counterexample
    from canon.checker import alone_polynomials as of
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_polynomials as of  # type: ignore
    import alone_signs  # type: ignore
    import counterexample  # type: ignore

Formula, Stop = alone.Formula, alone.Stop
SECTIONS = {
    "phase_space",
    "symbols",
    "definitions",
    "hamiltonian",
    "transformation",
    "domain",
    "claim",
    "title",
    "source",
}
ZERO = {"numerator": {}, "denominator": {"": "1"}, "cofactors": {}}
WORDS, APART = (
    {"real", "positive", "negative", "nonzero", "nonnegative", "function"},
    {"positive", "negative", "nonzero"},
)
GUESSES, MOST_SOLUTIONS = 40, 12


class Class:
    """Which functions a claim's formulas are, where each name is any real number that has its sign.

    `new` are names that may not stand in them; `declared`, whether functions that are declared may.
    """

    def __init__(self, claim: Any, new: set[str], declared: bool = False) -> None:
        self.claim, self.new, self.declared = claim, new, declared

    def plain(self, f: Any) -> Any:
        """A formula, with what a name stands for in its place."""
        while f.kind == "." and f.of[0] in self.claim.texts and f.of[0] not in self.new:
            f = self.claim.known(self.claim.texts[f.of[0]])
        return f

    def is_positive(self, f: Any) -> bool:
        """Whether it is seen to be positive, and analytic."""
        f = self.plain(f)
        if f.kind == "#":
            return f.of[0] > 0
        if f.kind == ".":
            return f.of[0] == "pi" or "positive" in self.claim.words.get(f.of[0], ())
        if f.kind in "+*":
            return all(map(self.is_positive, f.of))
        return self.is_analytic(f) if f.kind == "exp" else f.kind == "^" and self.is_analytic(f, rooted=True)

    def is_analytic(self, f: Any, rooted: bool = False) -> bool:
        """Whether it is analytic at all values of its names."""
        f = self.plain(f)
        if f.kind == ".":
            return f.of[0] not in self.new
        if f.kind == "^":
            r, whole = self.plain(f.of[1]), False
            if r.kind == "#" and not rooted:
                whole = r.of[0].denominator == 1 and r.of[0] >= 0 and self.is_analytic(f.of[0])
            return whole or (self.is_positive(f.of[0]) and self.is_analytic(f.of[1]))
        known = f.kind in ("+", "*", "sin", "cos", "exp") or (
            self.declared and self.claim.words.get(f.kind) == ["function"]
        )
        return f.kind == "#" or (known and all(map(self.is_analytic, f.of)))

    def is_meromorphic(self, f: Any) -> bool:
        """Whether it is made of analytic functions by sums, products and quotients."""
        f = self.plain(f)
        if f.kind in "+*":
            return all(map(self.is_meromorphic, f.of))
        r = self.plain(f.of[1]) if f.kind == "^" else f
        whole = f.kind == "^" and r.kind == "#" and r.of[0].denominator == 1
        return self.is_analytic(f) or (whole and self.is_meromorphic(f.of[0]))

    def names(self, f: Any) -> set[str]:
        """The names in a formula, as it stands for itself."""
        f = self.plain(f)
        parts = [self.names(x) for x in f.of if isinstance(x, Formula)]
        return set[str]({f.of[0]} if f.kind == "." else ()).union(*parts)

    def quotient(self, f: Any) -> of.Quotient:
        """A rational formula as a quotient of polynomials in its names. Raises Stop where it is another one."""
        f = self.plain(f)
        if f.kind == "#":
            return of.number(f.of[0]), of.ONE
        if f.kind == ".":
            return of.named(f.of[0]), of.ONE
        if f.kind in "+*":
            a, b = map(self.quotient, f.of)
            return of.added(a, b) if f.kind == "+" else of.multiplied(a, b)
        r = self.plain(f.of[1]) if f.kind == "^" else f
        if f.kind != "^" or r.kind != "#" or r.of[0].denominator != 1 or abs(r.of[0]) > 20:
            raise Stop("not shown", "what isn't rational")
        n, d = self.quotient(f.of[0])
        n, d = (n, d) if r.of[0] >= 0 else (d, n)
        return of.power(n, abs(int(r.of[0]))), of.power(d, abs(int(r.of[0])))


def slope(f: of.Quotient, name: str) -> of.Quotient:
    """∂f/∂(a name)."""
    each = list[of.Polynomial]()
    for p in f:
        powers = [(k, c) for k, c in of.by_powers(p, name).items() if k]
        terms = [of.times(of.times(of.number(k), c), of.named(name, k - 1) if k > 1 else of.ONE) for k, c in powers]
        each.append(total(terms))
    return of.plus(of.times(each[0], f[1]), of.minus(of.times(f[0], each[1]))), of.times(f[1], f[1])


def total(terms: Any) -> of.Polynomial:
    found: of.Polynomial = {}
    for p in terms:
        found = of.plus(found, p)
    return found


def numerators(known: Class, space: Any, texts: list[str]) -> Iterator[of.Polynomial]:
    """Those of the brackets of a rational map less what they are for a canonical one."""
    x, n = [known.quotient(known.claim.known(text)) for text in texts], len(space["q"])
    for i, j in combinations(range(2 * n), 2):
        found: of.Quotient = (of.number(-int(j == i + n)), of.ONE)
        for q, p in zip(space["q"], space["p"], strict=True):
            for sign, a, b in ((1, q, p), (-1, p, q)):
                part = of.multiplied(slope(x[i], a), slope(x[j], b))
                found = of.added(found, (of.times(of.number(sign), part[0]), part[1]))
        yield found[0]


def is_apart(claim: Any, p: of.Polynomial, moving: set[str]) -> bool:
    """Whether a polynomial in moving names has a coefficient that is 0 for no values of the others."""
    found = dict[Any, of.Polynomial]()
    for m, c in p.items():
        key = tuple(one for one in m if one[0] in moving)
        found.setdefault(key, {})[tuple(one for one in m if one[0] not in moving)] = c
    signed = lambda x: x == "pi" or bool(APART & {*claim.words.get(x, ())})
    return any(len(q) == 1 and all(signed(x) for x, _ in next(iter(q))) for q in found.values())


def is_somewhere(tables: Any, scale: str) -> bool:
    """Whether there is found a point of the domain at which the map, which has a value there, hasn't this scale."""
    asked = {**tables, "claim": {"kind": "canonical", "scale": scale}}
    space, rng = tables["phase_space"], Random(0)
    words = {n: [w] if isinstance(w, str) else w for n, w in tables.get("symbols", {}).items()}
    names = [*space["q"], *space["p"], space.get("time", "t"), *(n for n, w in words.items() if "function" not in w)]
    for k in range(GUESSES):
        values = {n: Fraction(rng.randint(1, 30), rng.randint(1, 30)) for n in names} if k else {}
        for n in values:
            signed = {*words.get(n, ())} & {"positive", "negative", "nonnegative"}
            if "negative" in signed or (not signed and rng.random() < 0.5):
                values[n] = -values[n]
        with suppress(Stop, counterexample.Open, ZeroDivisionError):
            if counterexample.refuted(asked, values)[0] == "shown":
                return True
    return False


def check_form(tables: Any) -> None:
    """See that the file is one of those that are read here. Raises Stop."""
    claim, space, explicit = ({**tables.get(key, {})} for key in ("claim", "phase_space", "transformation"))
    words = [w if isinstance(w, list) else [w] for w in tables.get("symbols", {}).values()]
    new = {*space.get("Q", ()), *space.get("P", ())}
    odd = claim["kind"] != "canonical_when" or {*claim} - {"solutions", *alone.UNASKED} or {*tables} - SECTIONS
    odd = odd or {*explicit} != {"Q", "P"} or {*tables.get("domain", {})} - {"where"} or not {*chain(*words)} <= WORDS
    odd = odd or any(tables.get("symbols", {}).get(x, "real") not in ("real", ["real"]) for x in new)
    odd = odd or not 0 < len(claim["solutions"]) <= MOST_SOLUTIONS
    said = [
        *explicit.values(),
        claim["solutions"],
        *(tables.get(x, {}) for x in ("domain", "definitions", "hamiltonian")),
    ]
    odd = odd or new & {*re.findall(r"\w+", json.dumps(said, ensure_ascii=False))}
    if odd or any(re.search("<=|>=", text) for text in tables.get("domain", {}).get("where", [])):
        raise Stop("not shown", "such a claim, or such a map, or a domain with edges")


def made(tables: Any) -> tuple[Any, Class]:
    """The claim that the map is canonical, all of whose formulas are meromorphic."""
    claim = alone.Claim({**tables, "claim": {"kind": "canonical"}})
    space = tables["phase_space"]
    new = {*space["Q"], *space["P"]}
    known, loose = Class(claim, new), Class(claim, new, declared=True)
    sides = [side for text in tables.get("domain", {}).get("where", []) for side in re.split("!=|<|>", text)]
    texts = [*sides, *tables.get("definitions", {}), *tables["transformation"]["Q"], *tables["transformation"]["P"]]
    fine = all(known.is_meromorphic(claim.known(text)) for text in texts)
    if not fine or not all(loose.is_meromorphic(claim.known(x)) for x in tables.get("hamiltonian", {}).values()):
        raise Stop("not shown", "functions of another kind")
    return claim, known


def is_said(claim: Any, text: str, words: set[str]) -> bool:
    """Whether a value is seen to have the sign that is assumed of its name."""
    signs = alone_signs.Signs(claim)
    n, _ = signs.quotient(claim.known(text))
    below, above, least = (
        (lambda: signs.shown(of.minus(n), True)),
        (lambda: signs.shown(n, True)),
        signs.shown(n, False),
    )
    ways = {"positive": above, "negative": below, "nonzero": lambda: above() or below(), "nonnegative": lambda: least}
    return all(ways[word]() for word in words - {"real"})


def check_solution(tables: Any, table: Any, known: Class) -> None:
    """See that the map is canonical with these values, which are such as the names may have. Raises Stop."""
    space, symbols = tables["phase_space"], tables["symbols"]
    fixed = {*known.claim.names, *table}
    for name, text in table.items():
        odd = not isinstance(text, str) or name not in symbols or name in known.claim.names or name in known.claim.texts
        if odd or "function" in symbols[name] or known.names(f := known.claim.known(text)) & fixed:
            raise Stop("not shown", f"such a value of {name[:40]}")
        if not known.is_meromorphic(f):
            raise Stop("not shown", f"which function the value of {name[:40]} is")
    kept = {name: words for name, words in symbols.items() if name not in table}
    there = {**tables, "symbols": kept, "definitions": {**tables.get("definitions", {}), **table}}
    claim, _ = made(there)
    for name in table:
        words = {symbols[name]} if isinstance(symbols[name], str) else {*symbols[name]}
        if not is_said(claim, name, words):
            raise Stop("not shown", f"that the value of {name[:40]} is one that it may have")
    case = {"kernels": [], "residuals": [ZERO] * len(claim.zeros)}
    alone.tried(lambda prime: alone.sample(claim, case, prime))
    if len(space["q"]) != len(space["Q"]) or not is_somewhere(there, "2"):
        raise Stop("not shown", "a point of the domain at a solution")


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim itself."""
    tables = json.loads(json.dumps(data["tables"]))
    check_form(tables)
    claim, known = made({**tables, "claim": {"kind": "canonical"}})
    solutions, space, explicit = tables["claim"]["solutions"], tables["phase_space"], tables["transformation"]
    plain = {key: x for key, x in tables.items() if key != "claim"}
    for table in solutions:
        if not table:
            raise Stop("not shown", "a solution that says nothing")
        check_solution({**plain, "claim": {"kind": "canonical"}}, table, known)
    named, texts = {name for table in solutions for name in table}, [*explicit["Q"], *explicit["P"]]
    used = set[str]().union(*(known.names(claim.known(text)) for text in texts))
    others = used - named - {*claim.names, "pi"}
    try:
        apart = any(is_apart(claim, p, named | {*claim.names}) for p in numerators(known, space, texts) if p)
    except Stop:
        apart = False
    if not apart and others:
        raise Stop("not shown", "that it isn't canonical elsewhere, whatever the other names are")
    if not is_somewhere(plain, "1"):
        raise Stop("not shown", "that it isn't canonical somewhere else")
    return "shown", ""


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON, of one case for each solution and one for all others."""
    return alone.answered(data, shown, several=True)


if __name__ == "__main__":
    alone.main(checked)
