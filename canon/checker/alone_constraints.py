"""Claims about constraints, linear in the velocities: `python alone_constraints.py CERTIFICATE.json …`

Forms ω = a·dq + b dt, or the differentials of functions of coordinates and time. They are holonomic where dω ∧ ω₁ ∧ … ∧
ω_m = 0 for each, and not where a coefficient of one is 0 nearly nowhere; integrals are g with dg ∧ ω₁ ∧ … = 0, as many
as forms. What vanishes is seen at random points modulo primes. Displacements and Lagrange's equations with multipliers
are looked at for all coordinates and velocities; where each function is linear in a coordinate, with a number for its
slope, on the surface, which q → q − f/slope gives. A determinant without a zero has a sign (`alone_regular.py`).

The coefficients a are independent nearly everywhere, whatever the parameters are; and there is a real point of the
domain, of small numbers, at which the functions vanish, and the coefficients are independent.
"""

from __future__ import annotations

import re
from contextlib import suppress
from fractions import Fraction
from itertools import combinations, permutations, product
from random import Random
from typing import Any

if __package__:
    from canon.checker import alone, alone_regular, alone_wider
    from canon.checker.counterexample import NONE, Arithmetic, Open, check, fails
    from canon.checker.counterexample_formulas import Writer, inner_names, put_names
    from canon.checker.counterexample_functions import Place
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_regular  # type: ignore
    import alone_wider  # type: ignore
    from counterexample import NONE, Arithmetic, Open, check, fails  # type: ignore
    from counterexample_formulas import Writer, inner_names, put_names  # type: ignore
    from counterexample_functions import Place  # type: ignore

Formula, Stop = alone.Formula, alone.Stop
MOST_FORMS, MOST_NAMES, MOST_POINTS, SMALL, BITS = 3, 8, 600, (0, 1, 2, -1, -2), 64
ANSWERS, ASKED = ("holonomic", "stationary", "determined"), ("integrals", "possible", "virtual", "multipliers")
FORM: Any = {"keys": "velocities", "may": "forms functions integrals possible virtual multipliers L qddot forces",
    "of": {"functions integrals": "q t", "forms possible virtual multipliers L qddot forces": "q velocities t"},
    "names": "velocities", "besides": ["velocities_i - velocities_i"]}  # fmt: skip


def determinant(rows: list[list[str]]) -> str:
    """Of texts."""
    terms = list[str]()
    for turn in permutations(range(len(rows))):
        sign = (-1) ** sum(a > b for a, b in combinations(turn, 2))
        terms.append("*".join([f"({sign})", *(f"({row[k]})" for row, k in zip(rows, turn, strict=True))]))
    return " + ".join(terms)


def minors(rows: list[list[str]]) -> list[str]:
    columns = combinations(range(len(rows[0])), len(rows))
    return [determinant([[row[k] for k in chosen] for row in rows]) for chosen in columns]


class Constraint(alone_wider.Wider):
    """A claim about constraints: `besides` and `none` vanish everywhere, `displaced` where the functions do, `on` where
    they and their rates do, and of each of `choices` one is 0 nearly nowhere."""

    def __init__(self, tables: Any) -> None:
        self.said = {key: x for key, x in tables["claim"].items() if key not in alone.UNASKED}
        answers = {key: self.said[key] for key in ANSWERS if key in self.said}
        if {"transformation", "generating_function"} & {*tables} or any(type(x) is not bool for x in answers.values()):
            raise Stop("not shown", "constraints beside a map, or no answers")
        self.check_keys(answers)
        claim = {key: x for key, x in self.said.items() if key not in answers} | {"kind": tables["claim"]["kind"]}
        super().__init__({**tables, "claim": claim}, FORM)
        self.texts["__H"] = tables.get("hamiltonian", {}).get("H", "0")
        self.q, self.v, self.t = tables["phase_space"]["q"], claim["velocities"], self.names[-1]
        self.functions, self.qddot = self.listed("functions"), self.listed("qddot")
        self.lines = [f"({self.rate(f)})" for f in self.functions] or self.listed("forms")
        if (
            len(self.v) != len(self.q)
            or not 1 <= len(self.lines) <= min(MOST_FORMS, len(self.q))
            or len(self.q) > MOST_NAMES
        ):
            raise Stop("not shown", "other numbers of velocities, or of forms")
        self.rows = [self.row_of(line) for line in self.lines]
        written = {*re.findall(r"\w+", str(self.domain))}
        if written & ({*self.v} - {*tables.get("symbols", {})}):
            raise Stop("not shown", "a condition on names of the claim's own")
        write, own = Writer(self), alone_regular.itself(self)
        slopes = [write.written(self.read(a, own)) for row in self.rows for a in row[:-1]]
        if any(inner_names(f, self) & {*self.v} for f in slopes):
            raise Stop("not shown", "a constraint that isn't seen to be linear in the velocities")
        self.displaced, self.on, self.none = list[str](), list[str](), list[Any]()
        self.choices = list[list[str]]()
        self.independent = minors([row[:-1] for row in self.rows])
        if answers.get("determined") is not False:
            self.choices.append(self.independent)
        for word in (word for word in (*ANSWERS, *ASKED) if word in self.said):
            getattr(self, f"ask_{word}")(self.said[word])
        self.chosen = list[str]()

    def check_keys(self, answers: Any) -> None:
        """Each key has a meaning beside the others."""
        said, moved = {*self.said}, {"multipliers": {"L", "qddot"}, "determined": {"L"}}
        needed = set[str]().union(*(keys for word, keys in moved.items() if word in said))
        extra = {"L", "qddot", "forces"} & (said - needed - ({"forces"} if "multipliers" in said else set()))
        extra |= said - {*ANSWERS, *f"{FORM['keys']} {FORM['may']}".split()}
        if len({"forms", "functions"} & said) != 1 or not {*ANSWERS, *ASKED} & said or needed - said or extra:
            raise Stop("not shown", "keys that say nothing, or are missing")
        if answers.get("determined") is False and (len({*ANSWERS, *ASKED} & said) > 1 or "forms" in said):
            raise Stop("not shown", "several claims of equations that leave something open, or such forms")
        lists = ("forms", "functions", "velocities", "qddot", "forces", *ASKED)
        if any(not isinstance(self.said.get(key, []), list) for key in lists):
            raise Stop("not shown", "lists of another form")

    def listed(self, key: str) -> list[str]:
        """The names under which the formulas of a list are kept."""
        return [f"__{key}_{k}" for k in range(len(self.said.get(key, ())))]

    def rate(self, f: str) -> str:
        """d/dt of a formula, with the velocities, and the claim's accelerations, if it has any."""
        moving = [*zip(self.v, self.q, strict=True), *(zip(self.qddot, self.v, strict=True) if self.qddot else ())]
        return " + ".join([f"D({f}, {self.t})", *(f"{steep}*D({f}, {x})" for steep, x in moving)])

    def row_of(self, line: str) -> list[str]:
        """The coefficients of dq and dt."""
        slopes = [f"D({line}, {v})" for v in self.v]
        return [*slopes, f"{line} - ({' + '.join(f'{v}*{a}' for v, a in zip(self.v, slopes, strict=True))})"]

    def say(self, found: list[str], answer: bool) -> None:
        """All vanish, or one of them doesn't, nearly everywhere."""
        if answer:
            self.besides += found
        else:
            self.choices.append(found)

    def ask_holonomic(self, answer: bool) -> None:
        """The coefficients of dω ∧ ω₁ ∧ …"""
        names, found = [*self.q, self.t], list[str]()
        for row, chosen in product(self.rows, combinations(range(len(names)), len(self.rows) + 2)):
            terms = list[str]()
            for i, j in combinations(range(len(chosen)), 2):
                a, b = chosen[i], chosen[j]
                minor = determinant([[other[k] for k in chosen if k not in (a, b)] for other in self.rows])
                curl = f"D({row[b]}, {names[a]}) - D({row[a]}, {names[b]})"
                terms.append(f"({(-1) ** (i + j + 1)})*({curl})*({minor})")
            found.append(" + ".join(terms))
        self.say(found, answer)

    def ask_stationary(self, answer: bool) -> None:
        """There is no term without velocities, and no time; or there is."""
        self.say([x for row in self.rows for x in (row[-1], *(f"D({a}, {self.t})" for a in row[:-1]))], answer)

    def ask_integrals(self, texts: Any) -> None:
        """Their differentials are combinations of the forms, and independent."""
        own = [[f"D({f}, {x})" for x in (*self.q, self.t)] for f in self.listed("integrals")]
        if len(texts) != len(self.rows):
            raise Stop("not shown", "more or fewer integrals than forms")
        self.choices.append(minors(own))
        for row in own:
            self.besides += minors([*self.rows, row])

    def ask_possible(self, texts: Any, key: str = "possible") -> None:
        """Velocities that the forms allow."""
        if len(texts) != len(self.q):
            raise Stop("not shown", "other numbers of displacements")
        for row in self.rows:
            terms = [f"({a})*{x}" for a, x in zip(row, self.listed(key), strict=False)]
            self.displaced.append(" + ".join([*terms, *([row[-1]] if key == "possible" else [])]))

    def ask_virtual(self, texts: Any) -> None:
        """Displacements with time held fixed."""
        self.ask_possible(texts, "virtual")

    def ask_multipliers(self, texts: Any) -> None:
        """d/dt ∂L/∂v − ∂L/∂q = Σ λ a + forces, and the rates of the constraints don't change."""
        n, forces = len(self.q), self.listed("forces")
        if len(texts) != len(self.rows) or len(self.qddot) != n or len(forces) not in (0, n):
            raise Stop("not shown", "other numbers of multipliers")
        for k, (q, v) in enumerate(zip(self.q, self.v, strict=True)):
            right = [f"{x}*({row[k]})" for x, row in zip(self.listed("multipliers"), self.rows, strict=True)]
            self.on.append(f"{self.rate(f'D(__L, {v})')} - D(__L, {q}) - ({' + '.join([*right, *forces[k : k + 1]])})")
        self.on += [self.rate(line) for line in self.lines]

    def ask_determined(self, answer: bool) -> None:
        """The determinant of (∂²L/∂v², −aᵀ; a, 0) has a sign, or is 0."""
        rows = [[f"D(D(__L, {v}), {w})" for w in self.v] for v in self.v]
        rows = [[*row, *(f"-({form[k]})" for form in self.rows)] for k, row in enumerate(rows)]
        rows += [[*form[:-1], *("0" for _ in self.rows)] for form in self.rows]
        write, own = Writer(self), alone_regular.itself(self)
        found = alone_regular.determinant(self, [[write.written(self.read(x, own)) for x in row] for row in rows])
        if answer:
            alone_regular.check_sign(self, found)
        else:
            self.none.append(found)


class Surface:
    """Where the functions vanish: what stands for coordinates, and for velocities, there."""

    def __init__(self, claim: Constraint) -> None:
        self.claim, self.write, self.own = claim, Writer(claim), alone_regular.itself(claim)
        self.put = dict[str, Any]()
        solved = [self.solve(f) for f in claim.functions]
        self.solved = bool(solved) and all(solved)
        self.put = self.put if self.solved else {}

    def text(self, text: str, free: Any = ()) -> Any:
        """A formula on the surface, where some names are free; derivatives are taken before."""
        put = {name: f for name, f in self.put.items() if name not in free}
        return put_names(self.write.written(self.claim.read(text, self.own)), put)

    def solve(self, f: str) -> bool:
        """Whether a function is linear in a coordinate that is left, or is 0 by then where this may be."""
        claim, left = self.claim, self.text(f)
        for q, v in zip(claim.q, claim.v, strict=True):
            slope = self.write.slope(left, q)
            if q not in self.put and slope.kind == "#" and slope.of[0]:
                self.add(q, left, slope.of[0])
                line = self.text(f"({self.claim.rate(f)})")
                if self.write.slope(line, v).of != slope.of:
                    raise Stop("not shown", "a velocity on the surface")
                self.add(v, line, slope.of[0])
                return True
        return claim.said.get("determined") is False and is_nothing(claim, [left])

    def add(self, name: str, f: Any, slope: Fraction) -> None:
        """x − f/slope for a name x, here and in what stands for others."""
        new = self.claim.made("+", Formula(".", (name,)), self.claim.made("*", alone.number(-1 / slope), f))
        self.put = {x: put_names(g, {name: new}) for x, g in self.put.items()} | {name: new}

    def check_place(self) -> None:
        """See a real point of the domain at which the functions vanish and are independent. Raises Stop."""
        claim, rng = self.claim, Random(0)
        names = [n for n in dict.fromkeys([*claim.names, *claim.words]) if not claim.is_function(n)]
        for _ in range(MOST_POINTS):
            of = {n: (x, x) for n in names for x in [Fraction(rng.choice(SMALL))]}
            with suppress(Open, ZeroDivisionError):
                first = Place(claim, of, Arithmetic(BITS))
                point = Place(claim, of | {x: first.at(g) for x, g in self.put.items()}, first.real)
                _ = point.text(claim.texts["__H"])  # it has values in all of the domain
                if not self.solved and any(point.text(f) != NONE for f in claim.functions):
                    continue
                for name in names:
                    check(point.named(name), claim.words.get(name, ()))
                for words in (re.split(r"(<=|>=|!=|<|>)", text) for text in claim.domain.get("where", [])):
                    for a, sign, b in zip(words[::2], words[1::2], words[2::2], strict=False):
                        kind = "nonzero" if sign == "!=" else "positive" if "<" in sign else "negative"
                        check(point.text(f"({b}) - ({a})"), [kind])
                if claim.none or any(fails(point.text(text), "") for text in claim.independent):
                    return
        raise Stop("not shown", "that the constraints hold somewhere, and say something there")


def is_nothing(claim: Any, formulas: Any) -> bool:
    """Whether formulas are seen to be 0 everywhere."""

    def sample(prime: int) -> int:
        point = alone_wider.Placed(claim, prime)
        point.check_domain()
        if any(map(point.at, formulas)):
            raise Stop("not shown", "that all is 0 that has to be")
        return len(point.roots)

    try:
        return alone.tried(sample)[0] == "shown"
    except Stop:
        return False


def sample(claim: Constraint, zeros: Any, prime: int) -> int:
    """Put one random point into everything; returns the number of roots that were met."""
    point = alone_wider.Placed(claim, prime)
    point.check_domain()
    point.check()
    if any(map(point.at, zeros)):
        raise Stop("not shown", "that all is 0 that has to be")
    apart = lambda text: point.check_apart(lambda at, *by: at.at(claim.known(text), *by))
    for n, texts in enumerate(claim.choices):
        for text in texts if n == len(claim.chosen) else ():
            with suppress(Stop):
                apart(text)
                claim.chosen.append(text)
                break
        if n >= len(claim.chosen):
            raise Stop("not shown", "that the forms are independent, or that something isn't 0")
        apart(claim.chosen[n])
    return len(point.roots)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim."""
    if data["tables"]["claim"]["kind"] != "constraint":
        raise Stop("not shown", "no claim about constraints")
    claim = Constraint(data["tables"])
    surface = Surface(claim)
    if claim.none and not surface.solved:
        raise Stop("not shown", "a surface of such functions")
    surface.check_place()
    displaced = [surface.text(text, free=claim.v) for text in claim.displaced]
    return alone.tried(sample, claim, [*claim.none, *displaced, *map(surface.text, claim.on)])


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON: there is a case for each part of the claim."""
    return alone.answered(data, shown, several=True)


if __name__ == "__main__":
    alone.main(checked)
