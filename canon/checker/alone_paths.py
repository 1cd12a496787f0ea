"""Paths that make ∫ L dt stationary, and second variations: `python alone_paths.py CERTIFICATE.json …`

Along the path, L is seen to be smooth between the ends, by signs (`alone_integrals.py`), and Lagrange's equations hold
at random points modulo primes. The second variation is ∫ (η'·P η' + 2 η·R η' + η·Q η) dt with P = ∂²L/∂v², R =
∂²L/∂q∂v, Q = ∂²L/∂q². With P positive definite by its minors it is positive

- where R is symmetric, and S = Q − R' diagonal and nowhere negative;
- where as many fields u as coordinates solve Jacobi's equations (P u' + Rᵀ u)' = R u' + Q u, are conjoined (u·(P w' +
  Rᵀ w) is symmetric in u and w), and have a determinant without a zero between the ends: then it is ∫ ζ·P ζ dt;

and it takes both signs where one such field, whose slope at the first isn't 0, has two zeros there (Gelfand and Fomin,
Calculus of Variations, §§ 25-29).
"""

from __future__ import annotations

import re
from fractions import Fraction
from itertools import combinations, pairwise
from typing import Any

if __package__:
    from canon.checker import alone, alone_integrals, alone_regular, alone_wider
    from canon.checker import alone_polynomials as of
    from canon.checker.counterexample_formulas import (
        NOUGHT,
        Writer,
        inner_names,
        is_nought,
        put,
        put_names,
        times,
        total,
    )
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_integrals  # type: ignore
    import alone_polynomials as of  # type: ignore
    import alone_regular  # type: ignore
    import alone_wider  # type: ignore
    from counterexample_formulas import (  # type: ignore
        NOUGHT,
        Writer,
        inner_names,
        is_nought,
        put,
        put_names,
        times,
        total,
    )

Formula, Stop = alone.Formula, alone.Stop
FORM: Any = {"keys": "L velocities path from to", "may": "field conjugate", "names": "velocities",
    "of": {"L": "q velocities t", "path field": "t", "from to conjugate": ""},
    "besides": ["velocities_i - velocities_i"]}  # fmt: skip
WITH_H = FORM | {"besides": ["velocities_i - velocities_i", "H - H"]}
SIGNS = {"minimum": (1,), "maximum": (-1,), "neither": (1, -1)}
TURNS = (
    {},
    {"cos": "sin(a + pi/2)", "sin": "-cos(a + pi/2)"},
    {"cos": "1 - 2*sin(a/2)**2", "sin": "2*sin(a/2)*cos(a/2)"},
    {"cos": "cos(-a)", "sin": "-sin(-a)"},
)
"""In which words sines and cosines are written: what is known is that sin a > 0 where 0 < a < π."""
QUARTERS, PI = range(-4, 5), of.named("pi")
Vector = list[Any]
Matrix = list[Vector]


class Path(alone_wider.Wider):
    """A claim about a path, as formulas of the time and of parameters."""

    def __init__(self, tables: Any) -> None:
        said = {key: x for key, x in tables["claim"].items() if key not in alone.UNASKED}
        self.extremum = said.pop("extremum", None)
        keys = {*f"{FORM['keys']} {FORM['may']}".split()}
        if (
            {"transformation", "generating_function"} & {*tables}
            or self.extremum not in (*SIGNS, None)
            or {*said} - keys
        ):
            raise Stop("not shown", "a path beside a map, another extremum, or with other keys")
        if (self.extremum is None and "field" in said) or (self.extremum == "neither") != ("conjugate" in said):
            raise Stop("not shown", "a field that says nothing, or none")
        has = "hamiltonian" in tables
        super().__init__({**tables, "claim": {**said, "kind": tables["claim"]["kind"]}}, WITH_H if has else FORM)
        self.q, self.v, self.t = tables["phase_space"]["q"], said["velocities"], self.names[-1]
        self.write, self.own, n = Writer(self), alone_regular.itself(self), len(self.q)
        if len(self.v) != n or any({*self.words.get(x, ())} - {"real"} for x in (*self.q, *self.v)):
            raise Stop("not shown", "other numbers of velocities, or signs of what moves")
        moving = {*self.names, *self.v}
        for side in (side for text in self.domain.get("where", []) for side in re.split("<=|>=|!=|<|>", text)):
            if inner_names(self.read(side, self.own), self) & moving:
                raise Stop("not shown", "a condition on what moves along the path")
        texts = said["path"] if isinstance(said["path"], list) else [said["path"]]
        self.path = [
            self.plain(f"__path_{k}" if isinstance(said["path"], list) else "__path") for k in range(len(texts))
        ]
        if len(self.path) != n:
            raise Stop("not shown", "other numbers of functions")
        self.put = dict(zip((*self.q, *self.v), (*self.path, *map(self.steep, self.path)), strict=True))
        self.L = self.along("__L")
        self.demanded = [self.along("__H")] if has else []  # it has values in all of the domain
        self.fields = self.fields_of(said.get("field", []))
        self.conjugate = [self.plain(f"__conjugate_{k}") for k in range(len(said.get("conjugate", ())))]

    def fields_of(self, said: Any) -> Matrix:
        """The fields, each a list of components."""
        if isinstance(said, str):
            return [[self.plain("__field")]]
        return [[self.plain(f"__field_{i}_{k}") for k in range(len(one))] for i, one in enumerate(said)]

    def plain(self, text: str) -> Any:
        """A formula without derivatives and abbreviations."""
        return self.write.written(self.read(text, self.own))

    def along(self, text: str) -> Any:
        """A formula at the path; derivatives are taken before."""
        return put_names(self.plain(text), self.put)

    def steep(self, f: Any) -> Any:
        """df/dt."""
        return self.write.slope(f, self.t)

    def dot(self, x: Vector, y: Vector) -> Any:
        found = NOUGHT
        for a, b in zip(x, y, strict=True):
            found = total(self, found, times(self, a, b))
        return found

    def less(self, a: Any, b: Any) -> Any:
        return total(self, a, alone_regular.negative(self, b))

    def lagrange(self) -> Vector:
        """What has to vanish along the path."""
        pairs = zip(self.q, self.v, strict=True)
        return [self.less(self.steep(self.along(f"D(__L, {v})")), self.along(f"D(__L, {q})")) for q, v in pairs]

    def second(self, first: Any, other: Any) -> Matrix:
        return [[self.along(f"D(D(__L, {x}), {y})") for y in other] for x in first]


class Range(alone_integrals.Integral):
    """The time between the ends."""

    def __init__(self, tables: Any, path: Path) -> None:
        said = tables["claim"]
        claim = {
            "kind": "integral",
            "f": "0",
            "variable": path.t,
            "from": said["from"],
            "to": said["to"],
            "equals": "0",
        }
        kept = {key: x for key, x in tables.items() if key in ("phase_space", "symbols", "definitions", "domain")}
        super().__init__({**kept, "claim": claim}, "0")
        if any(isinstance(end, int) for end in self.ends):
            raise Stop("not shown", "a path without an end")
        formulas = [path.L, *path.path, *path.demanded, *(x for field in path.fields for x in field)]
        self.calls |= {self.structure(self.bare(g)) for f in formulas for g in self.parts(f) if self.is_called(g)}
        self.between = alone_integrals.Between(self)
        self.positive = self.is_positive(Formula(".", (self.x,)))
        if self.signed and not self.positive:
            raise Stop("not shown", "that time is positive along the range")
        for f in (*formulas, *(put_names(g, path.put) for g in path.write.under)):
            self.between.check(f)

    def is_positive(self, f: Any, strict: bool = True) -> bool:
        """Whether it is seen to be positive, or not negative, at all times between the ends."""
        return self.between.shown(self.between.quotient(f)[0], strict)

    def at_quarters(self, f: Any) -> Any:
        """A formula with the values of sines and cosines of so many right angles."""

        def value(x: Any) -> Any:
            if x.kind not in ("sin", "cos"):
                return None
            n, d = self.between.quotient(x.of[0])
            known = (k for k in QUARTERS if not of.plus(n, of.times(of.number(Fraction(-k, 2)), of.times(PI, d))))
            k = next(known, None)
            return None if k is None else alone.number((1, 0, -1, 0)[(k - (x.kind == "sin")) % 4])

        return put(f, value)

    def has_no_zero(self, f: Any) -> bool:
        """Whether it is seen to have a sign between the ends, with sines and cosines in one of several forms."""
        for words in TURNS:
            new = lambda x, words=words: self.read(words[x.kind], {"a": x.of[0]}) if x.kind in words else None
            g = put(f, new)
            if self.is_positive(g) or self.is_positive(self.made("*", alone.number(-1), g)):
                return True
        return False


class Second:
    """The second variation along a path, times a sign: `zeros` have to vanish, and `ends` at the zeros of a field."""

    def __init__(self, path: Path, range_: Range, sign: int) -> None:
        self.path, self.range, self.zeros = path, range_, list[Any]()
        times_sign = lambda m: [[times(path, alone.number(sign), x) for x in row] for row in m]
        q, v = path.q, path.v
        self.P, self.R, self.Q = (times_sign(path.second(*pair)) for pair in ((v, v), (q, v), (q, q)))

    def is_definite(self) -> bool:
        """Whether P is positive definite, by its leading minors."""
        minors = [[row[:k] for row in self.P[:k]] for k in range(1, len(self.P) + 1)]
        return all(self.range.is_positive(alone_regular.determinant(self.path, m)) for m in minors)

    def check_potential(self) -> None:
        """R is symmetric, and S = Q − R' diagonal and nowhere negative."""
        path, n = self.path, range(len(self.P))
        for i in n:
            for j in n:
                S = path.less(self.Q[i][j], path.steep(self.R[i][j]))
                if i < j:
                    self.zeros += [path.less(self.R[i][j], self.R[j][i]), S]
                elif i == j and not is_nought(S) and not self.range.is_positive(S, strict=False):
                    raise Stop("not shown", "that S is nowhere negative, and there is no field")

    def momentum(self, u: Vector) -> Vector:
        """P u' + Rᵀ u."""
        path, steep = self.path, [self.path.steep(x) for x in u]
        columns = zip(*self.R, strict=True)
        return [total(path, path.dot(row, steep), path.dot([*c], u)) for row, c in zip(self.P, columns, strict=True)]

    def check_jacobi(self) -> None:
        """Each field solves Jacobi's equations, and they are conjoined."""
        path, fields = self.path, self.path.fields
        if any(len(u) != len(self.P) for u in fields):
            raise Stop("not shown", "fields with other numbers of components")
        for u in fields:
            steep = [path.steep(x) for x in u]
            force = [total(path, path.dot(r, steep), path.dot(k, u)) for r, k in zip(self.R, self.Q, strict=True)]
            self.zeros += [path.less(path.steep(p), f) for p, f in zip(self.momentum(u), force, strict=True)]
        for u, w in combinations(fields, 2):
            self.zeros.append(path.less(path.dot(u, self.momentum(w)), path.dot(w, self.momentum(u))))

    def check_fields(self) -> None:
        """As many fields as coordinates, which are independent between the ends."""
        self.check_jacobi()
        fields = self.path.fields
        if len(fields) != len(self.P) or not self.range.has_no_zero(alone_regular.determinant(self.path, fields)):
            raise Stop("not shown", "that the fields have a determinant without a zero")

    def check_conjugate(self) -> None:
        """One field with two zeros between the ends, and a slope at the first."""
        self.check_jacobi()
        path, places = self.path, [self.range.ends[0], *self.path.conjugate, self.range.ends[1]]
        if len(path.fields) != 1 or len(places) != 4:
            raise Stop("not shown", "several fields, or other numbers of zeros")
        if not all(self.range.is_positive(path.less(b, a)) for a, b in pairwise(places)):
            raise Stop("not shown", "that the zeros are between the ends")
        (u,), (first, last) = path.fields, path.conjugate
        steep = [self.range.at_quarters(put_names(path.steep(x), {path.t: first})) for x in u]
        if not any(self.range.is_positive(y) for x in steep for y in (x, alone_regular.negative(path, x))):
            raise Stop("not shown", "that the field isn't 0")
        self.zeros += [put_names(x, {path.t: place}) for x in u for place in (first, last)]


def sample(span: Range, zeros: Vector, prime: int) -> int:
    """See at one point of the range that all vanishes."""
    point = alone_integrals.Along(span, prime)
    point.check_domain()
    point.start()
    if any(map(point.at, zeros)):
        raise Stop("not shown", "that all is 0 that has to be")
    return len(point.roots)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim."""
    tables = data["tables"]
    if tables["claim"]["kind"] != "stationary":
        raise Stop("not shown", "no path")
    path = Path(tables)
    span = Range(tables, path)
    zeros = path.lagrange()
    if path.extremum:
        ways = [second for sign in SIGNS[path.extremum] if (second := Second(path, span, sign)).is_definite()]
        if not ways:
            raise Stop("not shown", "that P is definite")
        found = ways[0]
        found.check_conjugate() if path.conjugate else found.check_fields() if path.fields else found.check_potential()
        zeros += found.zeros
    return alone.tried(sample, span, zeros)


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
