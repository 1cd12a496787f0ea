"""Limits by what vanishes, and how fast: `python alone_limits.py CERTIFICATE.json …`

At infinity x is 1/s with s > 0 near 0. The formula is N/D with N smooth at the limit, where each radicand and so on is
seen to be positive (`alone_integrals.py`), and D a polynomial of the distance whose first coefficient, of hⁿ, is seen
not to be 0 for any parameters (`alone_signs.py`). So the limit is that of N⁽ⁿ⁾/D⁽ⁿ⁾ if the derivatives of N before the
n-th are 0, which is seen at random points (`alone.py`); and infinite where N isn't 0.
"""

from __future__ import annotations

import re
from typing import Any

if __package__:
    from canon.checker import alone, alone_integrals
    from canon.checker import alone_polynomials as of
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_integrals  # type: ignore
    import alone_polynomials as of  # type: ignore

Formula, Stop, ENDLESS = alone.Formula, alone.Stop, alone_integrals.ENDLESS
KEYS = {"f", "variable", "to", "equals", "side"}
ONE, STEP = alone.number(1), "#h"


def mentions(tables: Any, text: str, x: str) -> bool:
    """Whether a name is in a text, or in what it is made of."""
    seen, left, defined = set[str](), {*re.findall(r"\w+", str(text))}, tables.get("definitions", {})
    while left:
        seen, left = (
            seen | left,
            {w for name in left & {*defined} for w in re.findall(r"\w+", str(defined[name]))} - seen - left,
        )
    return x in seen


class Limit(alone_integrals.Integral):
    """f as x tends to a, from above (1), below (−1) or both (0)."""

    def __init__(self, tables: Any) -> None:
        said = {key: x for key, x in tables["claim"].items() if key not in alone.UNASKED}
        if tables["claim"]["kind"] != "limit" or {*said} - KEYS or said.get("side", "+") not in ("+", "-"):
            raise Stop("not shown", "no limit, or with other keys")
        way, value = (ENDLESS.get(str(said[key]).strip()) for key in ("to", "equals"))
        start, equals = "0" if way else said["to"], "0" if value else said["equals"]
        claim = {"kind": "integral", "f": said["f"], "variable": said["variable"], "from": start, "to": start}
        where = tables.get("domain", {}).get("where", [])
        free = [text for text in where if not mentions(tables, text, said["variable"])]
        domain = {"domain": {**tables["domain"], "where": free}} if free else {}
        tables = {key: x for key, x in tables.items() if key != "domain" or {*x} != {"where"}} | domain
        super().__init__({**tables, "claim": {**claim, "equals": equals}}, said["f"])
        self.value, self.side = value, 1 if way else {"+": 1, "-": -1}.get(said.get("side", ""), 0)
        self.way, self.at_end = way, Beside(self)
        self.prepare()
        self.top, self.bottom = self.split(self.moved(self.f))
        demanded = ["0 < " + said["variable"]] if self.signed and way != 1 else []
        for words in (re.split(r"(<=|>=|<|>)", text) for text in (*demanded, *(t for t in where if t not in free))):
            for a, sign, b in zip(words[::2], words[1::2], words[2::2], strict=False):
                g = self.read(f"({b}) - ({a})" if "<" in sign else f"({a}) - ({b})")
                if self.tends(*self.split(self.moved(g)))[1] != 1:
                    raise Stop("not shown", "that the domain comes up to the limit")

    def prepare(self) -> None:
        """What has to be known of f before it is moved."""

    def moved(self, f: Any) -> Any:
        """A formula in the distance to the limit, or its inverse."""
        return self.turned(f, self.way) if self.way else f

    def tends(self, top: Any, bottom: Any) -> tuple[int, int]:
        """The order in which a quotient vanishes at the limit, and its sign beside it, where this is one."""
        each = []
        for f in (top, bottom):
            try:
                each.append(self.at_end.first(f))
            except Stop:  # no polynomial
                self.at_end.check(f, strict=True)  # the sign at the limit is that beside it where f is continuous
                each.append((0, self.at_end.sign(f)))
        order, sides = each[0][0] - each[1][0], {self.side} if self.side else {-1, 1}
        signs = {each[0][1] * each[1][1] * side ** abs(order) for side in sides}
        return order, signs.pop() if len(signs) == 1 else 0

    def turned(self, f: Any, way: int) -> Any:
        """The formula with way/x for x."""
        self.spend()
        if not self.has(f):
            return f
        if f.kind == "." and f.of[0] == self.x:
            return Formula("*", (alone.number(way), Formula("^", (f, alone.number(-1)))))
        if f.kind == "D" or self.is_called(f):
            raise Stop("not shown", "a derivative, or a function, at infinity")
        if f.kind == ".":
            return self.turned(self.known(self.texts[f.of[0]]), way)
        return Formula(f.kind, tuple(self.turned(g, way) if isinstance(g, Formula) else g for g in f.of))

    def split(self, f: Any) -> tuple[Any, Any]:
        """N and D of a formula N/D; D is 1 where nothing vanishes."""
        self.spend()
        if not self.has(f) or f.kind == "D" or self.is_called(f) or (f.kind == "." and f.of[0] == self.x):
            return f, ONE
        if f.kind == ".":
            return self.split(self.known(self.texts[f.of[0]]))
        each = [self.split(g) for g in f.of if isinstance(g, Formula)]
        times = lambda a, b: b if a == ONE or a.of == (1,) else a if b.of == (1,) else Formula("*", (a, b))
        if f.kind == "*":
            return times(each[0][0], each[1][0]), times(each[0][1], each[1][1])
        if f.kind == "+":
            (a, b), (c, d) = each
            return Formula("+", (times(a, d), times(c, b))), times(b, d)
        whole = f.kind == "^" and f.of[1].kind == "#" and f.of[1].of[0].denominator == 1
        if whole and not (f.of[1].of[0] < 0 and each[0][1] == ONE and self.at_end.is_apart(each[0][0])):
            n = alone.number(abs(f.of[1].of[0]))
            up, down = (Formula("^", (g, n)) if g.of != (1,) else ONE for g in each[0])
            return (up, down) if f.of[1].of[0] > 0 else (down, up)
        if not all(d.of == (1,) or self.at_end.is_apart(d) for _, d in each):
            raise Stop("not shown", "a function of what has a pole")
        inner = [a if d.of == (1,) else times(a, Formula("^", (d, alone.number(-1)))) for a, d in each]
        return Formula(f.kind, tuple(inner), f.orders), ONE


class Beside(alone_integrals.Between):
    """What is so at the limit, or at a small distance from it."""

    def __init__(self, claim: Limit) -> None:
        super().__init__(claim, 0)

    def sign(self, f: Any) -> int:
        """1 or −1 where a formula is seen to be positive or negative at the limit; else 0."""
        n, d = self.quotient(f)
        return 1 if self.is_positive((n, d)) else -1 if self.is_positive((of.minus(n), d)) else 0

    def is_apart(self, f: Any) -> bool:
        self.check(f, strict=True)
        return self.sign(f) != 0

    def first(self, f: Any) -> tuple[int, int]:
        """The order in which a polynomial vanishes at the limit, and the sign of its coefficient there."""
        claim, x = self.of, self.of.x
        for g in (g for g in claim.parts(f) if claim.has(g)):
            if not (g.kind in ("+", "*", ".") or (g.kind == "^" and g.of[1].kind == "#" and g.of[1].of[0] >= 0)):
                raise Stop("not shown", "a denominator that is no polynomial")
            if g.kind == "^" and g.of[1].of[0].denominator > 1:
                raise Stop("not shown", "a denominator that is no polynomial")
        before, (a, b) = self.put[x], self.put[x]
        self.put[x] = of.plus(a, of.times(of.named(STEP), b)), b
        powers = of.by_powers(self.plain(self.quotient(f)[0]), STEP)
        self.put[x] = before
        order = min((k for k, q in powers.items() if self.plain(q)), default=-1)
        signs = [sign for sign in (1, -1) if order >= 0 and self.shown(of.times(of.number(sign), powers[order]), True)]
        if not signs or order > alone.HIGHEST:
            raise Stop("not shown", "in which order a denominator vanishes")
        return order, signs[0]


def sample(claim: Limit, order: int, prime: int) -> int:
    """See at one point what the derivatives are."""
    point = alone_integrals.Along(claim, prime)
    point.check_domain()
    end = alone_integrals.Along(claim, prime, point, claim.ends[0])
    by = [(claim.x,) * k for k in range(order + 1)]
    rest = [end.at(claim.top, *names) for names in by[:-1]]
    if any(rest) or (end.at(claim.top, *by[-1]) - point.at(claim.equals) * end.at(claim.bottom, *by[-1])) % prime:
        raise Stop("not shown", "that this is the limit")
    return len(point.roots)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim."""
    claim = Limit(data["tables"])
    claim.at_end.check(claim.top, strict=True)
    order, _ = claim.at_end.first(claim.bottom)
    if claim.value is None:
        return alone.tried(sample, claim, order)
    grows, sign = claim.tends(claim.top, claim.bottom)
    return ("shown", "") if grows < 0 and sign == claim.value else ("not shown", "that it grows beyond all bounds")


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
