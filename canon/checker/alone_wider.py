"""More kinds of claims for `alone.py`, by a table: `python alone_wider.py CERTIFICATE.json …`

What a kind asks for is written down in `alone_kinds.toml`, as formulas. Here these become texts about a claim, with its
names for theirs; which vanish is seen by `alone.py`. Beside that there is looked at what isn't 0, and what is near 0.
"""

from __future__ import annotations

import ast
import json
import re
import unicodedata
from functools import cache
from itertools import chain, combinations, product
from typing import Any

if __package__:
    from canon.checker import alone, alone_table
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_table  # type: ignore

Formula, Stop, flat = alone.Formula, alone.Stop, alone_table.flat
UNIT = r"([^\W\d]\w*(\*\*(-?\d+|\(-?\d+(/\d+)?\)))?)"
UNITS = rf"(1|{UNIT})([*/]({UNIT}|\({UNIT}([*/]{UNIT})*\)))*"
BASE = ["L", "M", "T", "I", "Theta", "N", "J"]


class Wider(alone.Claim):
    """What a claim asks for by the table: `zeros` and `besides` vanish, and `nonzero` doesn't."""

    def __init__(self, tables: Any, form: Any = None) -> None:
        self.known, self.outer, self.inner = cache(self.read), cache(super().outer), cache(self.inner)
        tables = json.loads(re.sub(r"\\([nrtfb]|u00[01].)", " ", json.dumps(tables)))
        self.form = form = form or alone_table.form_of(tables)
        self.kind, self.domain = tables["claim"]["kind"], tables.get("domain", {})
        claim = {key: x for key, x in tables["claim"].items() if key not in (*alone.UNASKED, *form.get("fixed", ()))}
        space = tables.get("phase_space", {}) if "bare" in form else tables["phase_space"]
        held: Any = {side: space.get(side, []) for side in "qpQP"} | {"t": space.get("time", "t")}
        self.words = {n: [w] if isinstance(w, str) else w for n, w in tables.get("symbols", {}).items()}
        self.names, self.texts = flat([*held.values()]), dict(tables.get("definitions", {}))
        self.solution, self.slopes, self.used, self.placed = dict[str, Any](), set[str](), list[str](), list[Any]()
        self.puts = list[dict[str, Any]]()  # what stands in the place of names in what is just being read
        self.take_bracket(claim, held)
        own = self.take_names(tables, claim, held)
        self.take_solution(claim.pop("solution", {}))
        if "dimensions" in claim:
            self.take_units(claim, held)
        if "map" in form:
            self.take_map(tables, held)
        said = (tables.get("hamiltonian", {}) if re.search(r"\bH\b", str(form)) else {}) | claim
        held |= {key: self.stored(f"__{key}", value) for key, value in said.items()}
        self.pairs, self.variables = held.pop("pairs"), flat([held[w] for w in form.get("vary", "x t").split()]) + own
        self.check_variables(held, said, own)
        template = alone_table.Template(held, form.get("absent", {}))
        for key, row in form.get("let", {}).items():
            held[key] = self.stored(f"__{key}", *template.texts(row))
            self.texts |= {"_scale": "__scale"} if key == "scale" else {}  # it is one number
        rows = lambda key: [text for row in form.get(key, ()) for text in template.texts(row)]
        self.zeros, self.besides, self.nonzero = map(rows, ("zeros", "besides", "nonzero"))
        if not self.zeros + self.besides + self.nonzero:
            raise Stop("not shown", "nothing")
        self.check_solution()
        self.check_germ(tables, held)
        read = [self.known(text) for text in (*self.zeros, *self.besides, *self.nonzero)]
        self.places = tuple(self.placed) if read else ()  # no others, whatever a certificate says of its kernels

    def take_names(self, tables: Any, claim: Any, held: Any) -> list[str]:
        """The names of the claim's own; each name has one meaning."""
        listed = {key: self.form.get(key, "").split() for key in ("names", "among")}
        own = flat([claim[key] for key in listed["names"] if key in claim])
        among, whole = flat([held[word] for word in listed["among"]]), alone.formulas(tables)
        named = [*self.texts, *self.names, *({*self.words} - {*self.names}), *({*own} - {*self.names, *self.words})]
        every, sections = [*named, "pi", *alone_table.LANGUAGE, *alone.SLOPES, *alone.MEANINGS], alone.SECTIONS
        odd = re.search(r"(?<!\w)_", whole) or unicodedata.normalize("NFKC", whole) != whole or {*tables} - {*sections}
        odd = odd or any({*tables.get(s, {})} - {*keys} for s, keys in sections.items() if keys)
        odd = odd or len({*own}) < len(own) or {*own} & ({*self.names} - {*among}) or any(map(self.is_function, own))
        lists = [held[side] for side in "qpQP"] + [claim.get(key, []) for key in listed["names"] if key != "parameter"]
        odd = odd or not all(isinstance(names, list) for names in lists)
        odd = odd or any("integer" in self.words.get(name, ()) for name in (*own, *self.names))
        odd = odd or len({*every}) < len(every) or len(every) > alone_table.MOST or "complex" in str(self.words)
        if odd or not all(map(str.isidentifier, named)):
            raise Stop("not shown", "names with two meanings, complex ones, of another form, or so many")
        held |= {key: claim.pop(key) for key in listed["names"] if key in claim}
        if "accelerations" in listed["names"] and "accelerations" not in held:
            own += held.setdefault("accelerations", [f"_{name}_tt" for name in held["q"]])
        self.words |= {name: ["real"] for name in own if name not in self.words}
        return own

    def take_bracket(self, claim: Any, held: Any) -> None:
        """Pairs of variables with factors: the canonical ones, or those of a tensor, or of structure constants."""
        held |= {"x": [*held["q"], *held["p"]], "pairs": [*zip(held["q"], held["p"], strict=True)]}
        self.factors = ["1"] * len(held["q"])
        if isinstance(constants := claim.get("structure"), dict):
            pairs = [tuple(name.strip() for name in pair.split(",")) for pair in constants]
            claim |= {"structure": [*constants.values()], "coordinates": [*dict.fromkeys(chain(*pairs))]}
            held["pairs"], self.factors = pairs, [f"__structure_{k}" for k in range(len(pairs))]
            if not all(len({*pair}) == len(pair) == 2 for pair in pairs) or len({*map(frozenset, pairs)}) < len(pairs):
                raise Stop("not shown", "pairs that stand twice")
        elif "tensor" in claim:
            x = claim["coordinates"]
            places = [*combinations(range(len(x)), 2)]
            held["pairs"], self.factors = [(x[i], x[j]) for i, j in places], [f"__tensor_{i}_{j}" for i, j in places]
            if len(x) != len(claim["tensor"]):
                raise Stop("not shown", "a tensor of other coordinates")

    def take_solution(self, solution: Any) -> None:
        """Functions that stand for formulas of these names."""
        for call, body in solution.items():
            name, *given = re.findall(r"\w+", call)
            odd = not re.fullmatch(r"\w+\(\w+(, *\w+)*\)", call) or len({*given}) < len(given) or name in self.solution
            odd = odd or self.words.get(name) != ["function"] or not {*given} <= {*self.names, *self.words}
            if odd or any(map(self.is_function, given)):
                raise Stop("not shown", f"{call[:40]} for a function of names")
            self.solution[name] = given, body

    def take_units(self, claim: Any, held: Any) -> None:
        """What names, and functions, are multiplied by in other units."""
        held["scaled"], table, equals = [*claim["dimensions"]], claim.pop("dimensions"), claim.pop("equals")
        texts = [str(text) for text in (*table.values(), equals)]
        known = all(name in {*self.names, *self.words} and not self.is_function(name) for name in table)
        units, base = re.findall(r"[^\W\d]\w*", " ".join(texts)), claim.pop("base", BASE)
        odd = not isinstance(base, list) or len({*base}) < len(base) or {*units} - {*base}
        if odd or not known or not all(re.fullmatch(UNITS, text) for text in texts):
            raise Stop("not shown", "a unit of that form, or of a function, or that isn't in the base")
        self.words |= {f"_{unit}": ["positive"] for unit in units}
        *scales, scale = [re.sub(r"[^\W\d]\w*", r"_\g<0>", text) for text in texts]
        claim |= {"scales": scales, "scale": scale}

    def take_map(self, tables: Any, held: Any) -> None:
        """The formulas of a map stand for its variables."""
        explicit, n = tables["transformation"], len(held["q"])
        (a, b), (c, d) = ("QP", "qp") if "Q" in explicit else ("qp", "QP")
        written = {*re.findall(r"\w+", json.dumps([*explicit.values()], ensure_ascii=False))}
        if any(len(held[side]) != n for side in "qpQP") or {*held[a], *held[b]} & written:
            raise Stop("not shown", "a map to fewer variables, or of others")
        if a == "q" and self.kind == "identity" and "bracket" in str([tables["claim"], self.texts]):  # of old variables
            raise Stop("not shown", "brackets beside a map that gives old variables")
        self.texts |= dict(chain(*(zip(held[side], explicit[side], strict=True) for side in explicit)))
        held |= {"X": held[a] + held[b], "x": held[c] + held[d], "pairs": [*zip(held[c], held[d], strict=True)]}

    def stored(self, name: str, value: Any) -> Any:
        """A name for a text, or such lists of names."""
        if isinstance(value, list):
            return [self.stored(f"{name}_{k}", one) for k, one in enumerate(value)]
        self.texts[name] = value
        return name

    def is_function(self, name: str) -> bool:
        """Whether a name is declared as one."""
        return "function" in self.words.get(name, ())

    def inner(self, f: Any, slopes: bool = False) -> set[str]:
        """The names in a formula, or those in its derivatives alone."""
        parts = [self.inner(x, slopes and f.kind != "D") for x in f.of if isinstance(x, Formula)]
        return set[str]({f.of[0]} if f.kind == "." and not slopes else ()).union(*parts)

    def check_variables(self, held: Any, said: Any, own: list[str]) -> None:
        """Each formula is of the variables that the table says."""
        moving = {*self.names, *own}
        usual = {*flat([held[side] for side in "qpt"])} - {*own}
        rules = {key: row for words, row in self.form.get("of", {}).items() for key in words.split()}
        itself = {name: Formula(".", (name,)) for name in moving}  # and not what a map gives for it
        where = [side for text in self.domain.get("where", []) for side in re.split("<=|>=|!=|<|>", text)]
        if any(self.inner(self.read(side, itself), slopes=True) & {*held.get("X", ())} for side in where):
            raise Stop("not shown", "a condition on derivatives of what a map gives")
        for key in said:
            free = {*flat([held[word] for word in rules[key].split()])} if key in rules else usual
            for name in flat(held[key]):
                f = self.read(self.texts[name], itself)
                if other := self.inner(f) & (moving - free):
                    raise Stop("not shown", f"{min(other)[:40]} in {key}")
                if self.inner(f, slopes=True) & {*held.get("X", ())}:
                    raise Stop("not shown", "a derivative of what a map gives")

    def check_solution(self) -> None:
        """Each equation has a function in it that is given, and no derivative by what stands in it besides."""
        for text in self.zeros if self.solution else ():
            before = len(self.used)
            if self.known(text) and len(self.used) == before:
                raise Stop("not shown", "an equation without a function that solves it")
        for given, body in self.solution.values():
            if self.slopes & (self.inner(self.known(body)) - {*given}):
                raise Stop("not shown", "a derivative by a name in a solution")

    def check_germ(self, tables: Any, held: Any) -> None:
        """What is to be near 0 may be 0, whatever the file says besides."""
        if "germ" not in self.form:
            return
        sections = ("transformation", "generating_function", "hamiltonian")
        said = [text for section in sections for text in flat([*tables.get(section, {}).values()])]
        said += chain(*(re.split("<=|>=|!=|<|>", text) for text in self.domain.get("where", [])))
        names = {*chain(*(self.inner(self.known(text)) for text in said))}
        for name in flat([held[word] for word in self.form["germ"].split()]):
            if {*self.words.get(name, ())} - {"real"} or name in names:
                raise Stop("not shown", f"{name[:40]} near 0")

    def check_free(self, own: Any, by: Any, of: Any, text: str) -> None:
        """Derivatives are taken before something stands in a name's place: in what is differentiated, or by which."""
        moved = lambda put: {name: f for name, f in put.items() if (f.kind, f.of) != (".", (name,))}
        itself = own | {name: Formula(".", (name,)) for put in self.puts for name in put}
        names = {*chain(*(self.inner(self.built(at, text, itself)) for at in of))} if self.puts else {*()}
        inside = (f for put in self.puts for name, f in moved(put).items() if name in names)
        if {*by} & {*moved(own)}.union(*map(self.inner, inside)):
            raise Stop("not shown", "a derivative at a place")
        self.slopes |= {*by}

    def built(self, at: Any, text: str, own: Any) -> Any:
        """The formula of a syntax tree: besides what `alone` knows, _with(a, x, b, …), and functions that are given."""
        name = at.id[1:] if isinstance(at, ast.Name) else ""
        if own and name not in own and name in self.texts and name not in self.variables:
            return self.read(self.texts[name], own)
        if isinstance(at, ast.Call):
            called, args = getattr(at.func, "id", "_")[1:], list[Any](at.args)
            if called == "_with":
                put = {x.id[1:]: self.built(b, text, own) for x, b in zip(args[1::2], args[2::2], strict=True)}
                self.placed += [(f, {*self.words.get(name, ())}) for name, f in put.items()]
                self.puts.append(put)
                try:
                    return self.built(args[0], text, own | put)
                finally:
                    self.puts.pop()
            if called in self.solution and not at.keywords:
                given, body = self.solution[called]
                self.used.append(called)
                return self.read(body, dict(zip(given, (self.built(x, text, own) for x in args), strict=True)))
            if called == "bracket":
                self.check_free(own, [*chain(*self.pairs)], (*args, *at.keywords), text)
                x, y = (self.built(item, text, own) for item in (*args, *at.keywords))
                pairs = zip(self.factors, self.pairs, strict=True)
                each = [f"{c}*(D(_x, {q})*D(_y, {p}) - D(_x, {p})*D(_y, {q}))" for c, (q, p) in pairs]
                return self.read(" + ".join(each), {"_x": x, "_y": y})
            if called == "D":
                self.check_free(own, [args[1].id[1:]], args[:1], text)
            if {node.id[1:] for node in ast.walk(at.func) if isinstance(node, ast.Name)} & {*self.solution}:
                raise Stop("not shown", "a derivative of what is to be solved for")
        return super().built(at, text, own)


class Placed(alone.Point):
    """A random point, at which there is looked at what isn't 0 and what has no edge."""

    def __init__(self, claim: Wider, prime: int) -> None:
        super().__init__(claim, prime)
        self.asked: Any = claim

    def value(self, f: Any) -> int:
        """The value of a formula; near what is 0, functions have no edges or cuts."""
        found, claim = super().value(f), self.asked
        if "germ" in claim.form and f.kind in {*alone.SLOPES} - {*"+*^", "sin", "cos", "exp"}:
            a = self.at(f.of[0])
            if f.kind == "atan2" and not a:
                raise Stop("not shown", "what is at a cut")
            if f.kind in ("log", "atanh"):
                self.square(a if f.kind == "log" else (1 - a * a) % self.p)
            _ = [self.at(claim.outer(f, k)) for k in range(len(f.of))]  # at an edge there is no slope
        return found

    def check(self) -> None:
        """What stands in a name's place is what is assumed of it; and what else the claim asks for."""
        for f, words in self.asked.places:
            if words & {"positive", "nonnegative", "negative"}:
                self.square(self.at(f) * (-1 if "negative" in words else 1) % self.p)
        if any(self.at(self.asked.known(text)) for text in self.asked.besides):
            raise Stop("not shown", "that all is 0 that has to be")
        for f in map(self.asked.known, self.asked.nonzero):
            self.check_apart(lambda point, *by, f=f: point.at(f, *by))

    def check_apart(self, f: Any) -> None:
        """See that f(point), whose derivatives are f(point, name), is 0 nearly nowhere, whatever the parameters are.

        It isn't 0 here, nor where functions have other values but sines and exponentials of names and their products,
        which are algebraically independent. And for each parameter x there are weights w of the variables v with
        x ∂f/∂x + Σ w v ∂f/∂v = r f: where f was 0 on an open set for some values, it would be so for their neighbours.
        """
        claim, p = self.asked, self.p
        names = [n for n in {*claim.words, *claim.variables} if not claim.is_function(n) and n not in claim.texts]
        values = {n: self.named(n) for n in names}
        plain = {x * y % p for x, y in product([1, *values.values()], repeat=2)}
        other, value = type(self)(claim, p), f(self)
        generic = claim.is_function if "generic" in claim.form else lambda name: False
        held = lambda k: (k[0] in ("circle", "exp") and k[1] in plain) or generic(k[0])
        other.free = {k: self.free[k] for k in self.free if len(k) == 1 or held(k)}
        if not value or f(other) != value:
            raise Stop("not shown", "that something isn't 0")
        steep = {n: values[n] * f(self, n) % p for n in names}
        ratios = {k * value * pow(2, -1, p) % p for k in range(-24, 25)}
        ways = {0}
        for s in [s for n, s in steep.items() if s and n in claim.variables][:6]:
            ways = {(way + w * s) % p for way in ways for w in (0, -1, 1, -2, 2)}
        for n in (n for n, s in steep.items() if s and n not in claim.variables):
            apart = {*claim.words[n]} & {"positive", "negative", "nonzero"}
            if not apart or not {(r - k * steep[n]) % p for r in ratios for k in (1, 2)} & ways:
                raise Stop("not shown", f"that what mustn't be 0 isn't, whatever {n[:40]} is")


def sample(claim: Any, case: Any, prime: int) -> int:
    """Put one random point into everything; returns the number of roots that were met."""
    return alone.sample(claim, case, prime, Placed, Placed.check)


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON: that of `alone`, or where it knows none, by the table."""
    answer = alone.checked(data)
    try:
        alone_table.form_of(data["tables"])
    except (ValueError, KeyError, TypeError, AttributeError):  # the table has no such claim
        return answer
    return answer if answer[0] != "not shown" else alone.checked(data, Wider, sample)


if __name__ == "__main__":
    alone.main(checked)
