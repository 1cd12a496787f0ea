"""Local groups by their composition: `python alone_groups.py CERTIFICATE.json …`

θ(a, 0) = a, θ(0, b) = b and θ(θ(a, b), c) = θ(a, θ(b, c)) are identities, seen at random points modulo primes. Where
all parameters are 0 the formulas have a value and slopes, without edges or cuts; there C_ijk = ∂²θ_k/∂a_j∂b_i −
∂²θ_k/∂a_i∂b_j are the structure constants: those that the claim states, or numbers with small numerators and
denominators, the same at all points. The algebra of a name is told by them (`alone_lie.py`).
"""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations
from typing import Any

if __package__:
    from canon.checker import alone, alone_lie, alone_wider
    from canon.checker.alone_regular import itself
    from canon.checker.counterexample_formulas import Writer
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_lie  # type: ignore
    import alone_wider  # type: ignore
    from alone_regular import itself  # type: ignore
    from counterexample_formulas import Writer  # type: ignore

Formula, Stop = alone.Formula, alone.Stop
FORM = {"keys": "first second composition", "names": "first second third", "germ": "first second third",
    "of": {"composition": "first second"},
    "besides": [
        "with(composition_i, each_j[second_j, 0]) - first_i", "with(composition_i, each_j[first_j, 0]) - second_i",
        "with(composition_i, each_j[first_j, composition_j], each_j[second_j, third_j]) - "
        "with(composition_i, "
        "each_j[second_j, with(composition_j, each_k[first_k, second_k], each_k[second_k, third_k])])",
    ]}  # fmt: skip
SMALL = 24
"""The largest numerator, and denominator, of a structure constant that isn't stated."""


class Group(alone_wider.Wider):
    """A claim that a composition is a local group's, with its structure constants, as far as they are known."""

    def __init__(self, tables: Any) -> None:
        said = {key: x for key, x in tables["claim"].items() if key not in alone.UNASKED}
        if {*said} - {"first", "second", "composition", "equals", "structure"} or not {"equals", "structure"} & {*said}:
            raise Stop("not shown", "a group with other keys")
        self.a, self.b = said["first"], said["second"]
        if not len(self.a) == len(self.b) == len(said["composition"]) > 0 or len(self.a) > alone_lie.LARGEST:
            raise Stop("not shown", "other numbers of parameters")
        whole = alone.formulas(tables)
        c = [next(x for x in (f"third{k}x{m}" for m in range(1000)) if x not in whole) for k in range(len(self.a))]
        claim = {key: said[key] for key in ("first", "second", "composition")} | {"third": c}
        form = FORM | {"keys": f"{FORM['keys']} third"}
        super().__init__({**tables, "claim": {**claim, "kind": tables["claim"]["kind"]}}, form)
        write, own, n = Writer(self), itself(self), range(len(self.a))
        self.theta = [write.written(self.read(f"__composition_{k}", own)) for k in n]
        if any(self.is_function(g.kind) for f in self.theta for g in self.parts(f)):
            raise Stop("not shown", "a composition with functions of which nothing is known")
        self.constants = self.stated(said["structure"]) if "structure" in said else {}

    def outer(self, f: Any, k: int) -> Any:
        """∂f/∂(its k-th argument); that of a is 1 where a is 0, too."""
        n = f.of[1].of[0] if f.kind == "^" and f.of[1].kind == "#" else 2
        return alone.number(n) if n in (0, 1) else super().outer(f, k)

    def parts(self, f: Any) -> Any:
        """A formula without abbreviations and all within it."""
        yield f
        for g in (g for g in f.of if isinstance(g, Formula)):
            yield from self.parts(g)

    def stated(self, structure: Any) -> dict[Any, Fraction]:
        """The constants that the claim states: {(i, j, k): C}, i < j; those of pairs that it leaves out are 0."""
        n = range(len(self.a))
        found = alone_lie.constants_of(self.a, structure, lambda text: alone_lie.combination(text, self.a))
        return {(i, j, k): found[i][j][k] for i, j in combinations(n, 2) for k in n}


class Unit(alone_wider.Placed):
    """Where all parameters of the group are 0."""

    def named(self, name: str) -> int:
        return 0 if name in {*self.asked.a, *self.asked.b} else super().named(name)  # type: ignore[attr-defined]

    def terms(self, f: Any) -> dict[int, Fraction]:
        """What isn't 0 of an angle, or of an exponent."""
        return {value: r for value, r in super().terms(f).items() if value}


def check_unit(claim: Any, prime: int) -> int:
    """See the structure constants at one point. A number that isn't stated is read off the first one."""
    point = Unit(claim, prime)
    point.check_domain()
    slope = lambda k, x, y: point.at(claim.theta[k], *sorted((x, y)))
    n, a, b = range(len(claim.a)), claim.a, claim.b
    for k in n:
        if point.at(claim.theta[k]):
            raise Stop("not shown", "that the unit is one")
    for i, j in combinations(n, 2):
        for k in n:
            value = (slope(k, a[j], b[i]) - slope(k, a[i], b[j])) % prime
            if (i, j, k) not in claim.constants:
                claim.constants[i, j, k] = small(value, prime)
            if (point.fraction(claim.constants[i, j, k], prime) - value) % prime:
                raise Stop("not shown", "the structure constants")
    return len(point.roots)


def small(value: int, prime: int) -> Fraction:
    """The small number that is this modulo the prime. Raises Stop."""
    for below in range(1, SMALL + 1):
        above = value * below % prime
        above = above - prime if above > prime // 2 else above
        if abs(above) <= SMALL:
            return Fraction(above, below)
    raise Stop("not shown", "structure constants that aren't small numbers")


def sample(claim: Any, prime: int) -> int:
    point = alone_wider.Placed(claim, prime)
    point.check_domain()
    point.check()
    return max(len(point.roots), check_unit(claim, prime))


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim."""
    said = data["tables"]["claim"]
    if said["kind"] != "group":
        raise Stop("not shown", "no group")
    claim = Group(data["tables"])
    answer = alone.tried(sample, claim)
    n = range(len(claim.a))
    if answer[0] == "shown" and "equals" in said:
        zero = Fraction(0)
        get = lambda i, j, k: claim.constants.get((i, j, k), zero) if i < j else -claim.constants.get((j, i, k), zero)
        constants = [[[get(i, j, k) if i != j else zero for k in n] for j in n] for i in n]
        if not alone_lie.is_called(constants, str(said["equals"])):
            raise Stop("not shown", "that it is the algebra of this name")
    return answer


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
