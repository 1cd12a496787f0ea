"""Gauss's integrals over all of the line: `python alone_gauss.py CERTIFICATE.json …`

The integrand is a sum of A exp(−a x² + b x + c) cos(w x + g), or with a sine, or with neither, where a is seen to be
positive and x is in none of the coefficients (`alone_signs.py`). With β = b + i w

    ∫ exp(−a x² + β x + c + i g) dx = √(π/a) exp(c + i g + β²/(4 a)),

so that this is A √(π/a) exp(c + (b² − w²)/(4 a)) cos(g + b w/(2 a)). That the claim's value is the sum of these is
seen at random points modulo random primes (`alone.py`).
"""

from __future__ import annotations

from typing import Any

if __package__:
    from canon.checker import alone, alone_integrals, alone_radicands, alone_signs
    from canon.checker import alone_polynomials as of
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_integrals  # type: ignore
    import alone_polynomials as of  # type: ignore
    import alone_radicands  # type: ignore
    import alone_signs  # type: ignore

Formula, Stop = alone.Formula, alone.Stop
MOST_TERMS = 20


class Waves:
    """The integrand as a sum of products, and what each of them is integrated."""

    def __init__(self, claim: alone_integrals.Integral) -> None:
        self.claim, self.signs = claim, alone_signs.Signs(claim)
        self.signs.everywhere = True

    def products(self, f: Any) -> list[list[Any]]:
        """The products of which a formula is the sum."""
        self.claim.spend()
        if f.kind == "." and f.of[0] in self.claim.texts:
            return self.products(self.claim.known(self.claim.texts[f.of[0]]))
        if f.kind == "+":
            found = [one for g in f.of for one in self.products(g)]
        elif f.kind == "*" and self.claim.has(f):
            a, b = map(self.products, f.of)
            found = [[*x, *y] for x in a for y in b]
        else:
            found = [[f]]
        if len(found) > MOST_TERMS:
            raise Stop("not shown", "sums that are so long")
        return found

    def coefficients(self, f: Any, most: int) -> list[Any]:
        """The formulas of a polynomial's coefficients of 1, x, x², …"""
        claim, (n, d) = self.claim, self.signs.quotient(f)
        powers = of.by_powers(n, claim.x)
        if {*powers} - {*range(most + 1)} or any(
            name[0] == "#" or (name == claim.x and p is d) for p in (n, d) for name in of.names_in(p)
        ):
            raise Stop("not shown", "an exponent, or an angle, of another form")
        if most == 2 and not self.signs.shown(of.minus(powers.get(2, {})), True):
            raise Stop("not shown", "that an exponent falls on both sides")
        each = [(self.text(powers.get(k, {})), self.text(d)) for k in range(most + 1)]
        return [n if n.of == (0,) else Formula("*", (n, Formula("^", (d, alone.number(-1))))) for n, d in each]

    def text(self, p: of.Polynomial) -> Any:
        """A polynomial as a formula."""
        terms = ["*".join((f"({c})", *(f"{x}**{k}" for x, k in m))) for m, c in p.items()]
        return self.claim.read(" + ".join(terms) or "0")

    def integrated(self, factors: list[Any]) -> Any:
        """The integral of a product."""
        claim, own, each = self.claim, dict[str, Any](), {"exp": list[Any](), "cos": list[Any](), "sin": list[Any]()}
        rest = alone.number(1)
        for g in factors:
            if not claim.has(g):
                rest = Formula("*", (rest, g))
            elif g.kind in each:
                each[g.kind].append(g.of[0])
            else:
                raise Stop("not shown", "an integrand that isn't Gauss's")
        waves = [*each["cos"], *each["sin"]]
        if not each["exp"] or len(waves) > 1:
            raise Stop("not shown", "an integrand that isn't Gauss's")
        exponent = alone.number(0)
        for g in each["exp"]:
            exponent = Formula("+", (exponent, g))
        own |= dict(zip("cba", self.coefficients(exponent, 2), strict=True))  # a is that of x² here
        own |= dict(zip("gw", self.coefficients(waves[0], 1) if waves else [alone.number(0)] * 2, strict=True))
        has = {
            name for name, f in own.items() if f.of != (0,)
        }  # a power of 0 would be a number of which nothing is known
        parts = {"c": "c", "b": "-b**2*(4*a)**(-1)", "w": "w**2*(4*a)**(-1)"}
        exponent = " + ".join(part for name, part in parts.items() if name in has) or "0"
        angle = (
            " + ".join([*(["g"] if "g" in has else []), *(["-b*w*(2*a)**(-1)"] if {"b", "w"} <= has else [])]) or "0"
        )
        wave = f"*{'sin' if each['sin'] else 'cos'}({angle})" if waves else ""
        text = f"r*(-pi*a**(-1))**(1/2)*exp({exponent}){wave}"
        return claim.read(text, own | {"r": rest})


def value(claim: alone_integrals.Integral) -> Any:
    """What the integral is. Raises Stop where it isn't one of these."""
    if claim.ends != [-1, 1] or claim.signed:
        raise Stop("not shown", "an integral over a part of the line")
    waves, found = Waves(claim), alone.number(0)
    for one in waves.products(claim.f):
        found = Formula("+", (found, waves.integrated(one)))
    return found


def sample(claim: Any, integral: Any, prime: int) -> int:
    """See at one point that the integral is as the claim says."""
    point = alone.Point(claim, prime)
    point.check_domain()
    if (point.at(integral) - point.at(claim.equals)) % prime:
        raise Stop("not shown", "that this is the integral's value")
    return len(point.roots)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim itself."""
    if data["tables"]["claim"]["kind"] != "integral":
        raise Stop("not shown", "no integral")
    claim = alone_integrals.Integral(alone_radicands.without_others(data["tables"]), "0")
    return alone.tried(sample, claim, value(claim))


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
