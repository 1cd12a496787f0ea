"""Averages over time, by a virial or along a motion: `python alone_averages.py CERTIFICATE.json …`

With a virial G: f − dG/dt is what the claim says, a constant of the motion as the bound is, and |G| isn't larger than
that. H is a polynomial of degree 2, so that all motions go on for ever, and all formulas are polynomials of what moves.
With a motion: it solves Hamilton's equations, time grows with its parameter u, and ∫ (f − equals) (dt/du) du is 0 by
the certificate's antiderivative less `equals` · t (`alone_integrals.py`). A sine, or a cosine, is 2z/(1 + z²) there, z
real, and e with 0 ≤ e < U is U y²/(1 + y²).
"""

from __future__ import annotations

from itertools import combinations_with_replacement
from typing import Any

if __package__:
    from canon.checker import alone, alone_integrals, alone_limits, alone_signs
    from canon.checker import alone_polynomials as of
    from canon.checker.counterexample_formulas import Writer
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_integrals  # type: ignore
    import alone_limits  # type: ignore
    import alone_polynomials as of  # type: ignore
    import alone_signs  # type: ignore
    from counterexample_formulas import Writer  # type: ignore

Formula, Stop = alone.Formula, alone.Stop
VIRIAL = {"kind", "f", "equals", "virial", "bound"}
MOTION = {"kind", "f", "equals", "motion", "parameter", "from", "to", "antiderivative"}


class Bounded(alone_integrals.Between):
    """What is so along a range, with sines and cosines that aren't larger than 1, and names that may be 0."""

    def turn(self, sine: bool, angle: Any) -> of.Quotient:
        n, d = super().turn(sine, angle)
        if d != of.ONE or not of.names_in(n):
            return n, d
        z = of.named(self.new(("wave", *of.names_in(n)), False))
        return of.times(of.number(2), z), of.plus(of.ONE, of.power(z, 2))

    def use(self, p: of.Polynomial) -> None:
        """Use that p > 0; for b − a v with v ≥ 0 all values of v are kept."""
        for v in of.names_in(p):
            powers = of.by_powers(p, v)
            a, b = of.minus(powers.get(1, {})), powers.get(0, {})
            if "nonnegative" in self.claim.words.get(v, ()) and v not in self.put and {*powers} <= {0, 1}:
                if self.shown(a, True) and self.shown(b, False):
                    square = of.power(of.named(self.new(("below", v), False)), 2)
                    self.put[v] = of.times(b, square), of.times(a, of.plus(of.ONE, square))
                    return
        super().use(p)

    def check(self, f: Any, strict: bool = False) -> None:
        """See that a formula is smooth; a product isn't 0 where no factor is. Raises Stop."""
        if f.kind == "^" and f.of[1].kind == "#" and f.of[1].of[0] == -1 and self.is_apart(f.of[0]):
            return self.check(f.of[0], strict)
        return super().check(f, strict)

    def is_apart(self, f: Any) -> bool:
        """Whether a formula is seen not to be 0, factor by factor."""
        if f.kind == "*" or (f.kind == "^" and f.of[1].kind == "#" and f.of[1].of[0] > 0):
            return all(map(self.is_apart, f.of))
        n, d = self.quotient(f)
        return self.is_positive((n, d)) or self.is_positive((of.minus(n), d))


def tables_of(tables: Any, keys: set[str]) -> tuple[Any, Any]:
    """The claim, and the names that move. Raises Stop for other sections, and where conditions speak of what moves."""
    claim = {key: x for key, x in tables["claim"].items() if key not in ("title", "source", "expect", "budget")}
    space, domain = tables["phase_space"], tables.get("domain", {})
    if {*claim} - keys or {"transformation", "generating_function"} & {*tables} or {*domain} - {"where"}:
        raise Stop("not shown", "an average beside a map, on a surface, or with other keys")
    moving = [*space["q"], *space["p"], space.get("time", "t")]
    names = [*moving, claim.get("parameter", moving[-1])]
    if any(alone_limits.mentions(tables, text, name) for text in domain.get("where", []) for name in names):
        raise Stop("not shown", "conditions on what moves")
    return claim, moving


def is_polynomial(claim: alone.Claim, f: Any, names: set[str]) -> bool:
    """Whether a formula is a polynomial of these names, by how it is written, with coefficients of others."""
    left, seen = [f], 0
    while left:
        g, seen = left.pop(), seen + 1
        if seen > alone.MOST_VALUES // 10:
            raise Stop("not shown", "formulas that are so long")
        if g.kind == "." and g.of[0] in claim.texts:
            left.append(claim.known(claim.texts[g.of[0]]))
        elif g.kind in "+*":
            left += g.of
        elif g.kind == "^" and g.of[1].kind == "#" and g.of[1].of[0] >= 0 and g.of[1].of[0].denominator == 1:
            left.append(g.of[0])
        elif g.kind not in ("#", ".") and has(claim, g, names):
            return False
    return True


def has(claim: alone.Claim, f: Any, names: set[str]) -> bool:
    """Whether one of these names is in a formula."""
    left, seen = [f], 0
    while left:
        g, seen = left.pop(), seen + 1
        if seen > alone.MOST_VALUES // 10:
            raise Stop("not shown", "formulas that are so long")
        if g.kind == "." and g.of[0] in claim.texts:
            left.append(claim.known(claim.texts[g.of[0]]))
        elif g.kind == "." and g.of[0] in names:
            return True
        left += [x for x in g.of if isinstance(x, Formula)]
    return False


def vanish(claim: alone.Claim, texts: list[str], prime: int) -> int:
    """See at one point that formulas are 0."""
    point = alone.Point(claim, prime)
    point.check_domain()
    if any(map(point.text, texts)):
        raise Stop("not shown", "that f is what the claim says and what a bounded function grows")
    return len(point.roots)


def by_virial(tables: Any) -> tuple[str, str]:
    """The answer about an average by a virial."""
    said, moving = tables_of(tables, VIRIAL)
    identity = {"kind": "identity", "lhs": said["equals"], "rhs": said["virial"]}
    claim = alone.Claim({**tables, "claim": identity})
    if any({*claim.words.get(name, ())} - {"real"} for name in moving):
        raise Stop("not shown", "what is assumed of what moves")
    claim.texts |= {f"_{key}": said[key] for key in ("f", "equals", "virial", "bound")}
    claim.texts["_H"] = tables["hamiltonian"]["H"]
    if not all(
        is_polynomial(claim, claim.known(f"_{key}"), {*moving}) for key in ("f", "equals", "virial", "bound", "H")
    ):
        raise Stop("not shown", "what is no polynomial of what moves")
    rate = lambda key: f"bracket(_{key}, _H) + D(_{key}, {moving[-1]})"
    texts = [f"_f - ({rate('virial')}) - _equals", rate("equals"), rate("bound"), f"D(_H, {moving[-1]})"]
    texts += [f"D(D(D(_H, {a}), {b}), {c})" for a, b, c in combinations_with_replacement(moving[:-1], 3)]
    signs = alone_signs.Signs(claim)
    for sign in "-+":
        if not signs.shown(signs.quotient(claim.read(f"_bound {sign} _virial"))[0], False):
            raise Stop("not shown", "that the virial is bounded")
    return alone.tried(vanish, claim, texts)


def solves(tables: Any, integral: Any, motion: Any, moving: list[str], prime: int) -> int:
    """See at one point that a motion solves Hamilton's equations."""
    u, names, words = integral.x, moving[:-1], tables.get("symbols", {})
    plain = {key: x for key, x in tables.items() if key not in ("claim", "symbols", "domain")}
    symbols = {name: x for name, x in words.items() if name not in moving}
    if u != moving[-1]:
        symbols[u] = "real"
    claim = alone.Claim({**plain, "symbols": symbols, "claim": {"kind": "identity", "lhs": "0", "rhs": "0"}})
    claim.texts["_H"] = tables["hamiltonian"]["H"]
    along = alone_integrals.Along(integral, prime)
    along.check_domain()
    along.start()
    there = alone.Point(claim, prime)
    there.free, there.roots, there.sure = along.free, along.roots, along.sure
    own = {name: along.text(name) for name in motion}
    there.free |= {(name,): value for name, value in own.items()}
    if moving[-1] not in motion:
        there.free[(moving[-1],)] = along.text(u)
    speed = along.text(f"D({moving[-1]}, {u})") if moving[-1] in motion else 1
    n = len(names) // 2
    for q, p in zip(names[:n], names[n:], strict=True):
        for x, rate in ((q, there.text(f"D(_H, {p})")), (p, -there.text(f"D(_H, {q})"))):
            if (along.text(f"D({x}, {u})") - rate * speed) % prime:
                raise Stop("not shown", "that the motion is one")
    return len(along.roots)


def by_motion(tables: Any, known: Any) -> tuple[str, str]:
    """The answer about an average along a motion."""
    said, moving = tables_of(tables, MOTION)
    motion, u, time = said["motion"], said["parameter"], moving[-1]
    if {*motion} - {*moving} or u in motion or u in moving[:-1] or ((time in motion) == (u == time)):
        raise Stop("not shown", "a motion of that form")
    if "hamiltonian" in tables and {*moving[:-1]} - {*motion}:
        raise Stop("not shown", "a motion of some of what moves")
    for text in (*motion.values(), said["equals"], said["from"], said["to"]):
        if any(alone_limits.mentions(tables, str(text), name) for name in moving if name != u):
            raise Stop("not shown", "a motion by itself")
    if "infinity" in f"{said['from']} {said['to']}":
        raise Stop("not shown", "an average over all time")
    ends = (said["equals"], said["from"], said["to"])
    if any(alone_limits.mentions(tables, str(text), u) for text in ends):
        raise Stop("not shown", "an average that moves")
    whole, words = alone.formulas(tables), tables.get("symbols", {})
    names = [f"old{k}" for k in range(1000) if f"old{k}" not in whole][:3]
    speed, clock = (f"D({time}, {u})", time) if time in motion else ("1", u)
    claim = {"kind": "integral", "variable": u, "from": said["from"], "to": said["to"], "equals": "0"}
    claim["f"] = f"(({said['f']}) - ({said['equals']}))*{speed}"
    given = f"({known['antiderivative']}) - ({said['equals']})*{clock}"
    inner = {
        "phase_space": {"q": names[:1], "p": names[1:2], "time": names[2]},
        "symbols": {name: word for name, word in words.items() if name not in moving},
        "definitions": {**tables.get("definitions", {}), **motion},
        **({"domain": tables["domain"]} if "domain" in tables else {}),
        "claim": claim,
    }
    integral = alone_integrals.Integral(inner, given)
    between = Bounded(integral)
    checks = [("positive", f"D({time}, {u})")] if time in motion else []
    for name in motion:
        between.check(integral.known(name))
        said_of = words.get(name, [])
        checks += [(word, name) for word in ([said_of] if isinstance(said_of, str) else said_of) if word != "real"]
    for word, text in checks:
        n, _ = between.quotient(Writer(integral).written(integral.known(text)))
        if word not in ("positive", "nonnegative") or not between.shown(n, word == "positive"):
            raise Stop("not shown", "that time grows, and what is assumed of what moves")
    if "hamiltonian" in tables:
        alone.tried(lambda prime: solves(tables, integral, motion, moving, prime))
    return alone_integrals.shown({"tables": inner, "known": {"antiderivative": given}}, of_kind=Bounded)


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim."""
    claim = data["tables"]["claim"]
    if claim["kind"] != "average" or ("virial" in claim) == ("motion" in claim):
        raise Stop("not shown", "no average, or over an orbit")
    return by_virial(data["tables"]) if "virial" in claim else by_motion(data["tables"], data["known"])


if __name__ == "__main__":
    alone.main(checked)
