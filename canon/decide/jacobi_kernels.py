"""Jacobi's functions as generators: sn, cn, dn over a Q-basis of their arguments, for each parameter m.

Sums of arguments are taken apart by the addition theorems (DLMF 22.8, 22.16.27). Their denominator 1 − m sn²u sn²v is
positive for all real u, v and m. Whole multiples of K(m) and of F(φ, m) are atoms with known values (DLMF 22.5(i),
22.16.12): (sn, cn, dn, ε)(K) = (1, 0, √(1−m), E) and (sn φ, cos φ, √(1 − m sin²φ), E(φ, m)).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING

from canon.decide.fraction_field import Element
from canon.decide.linear import divided_basis
from canon.decide.ring import Polynomial
from canon.decide.tape import ONE, Unsupported

if TYPE_CHECKING:
    from canon.decide.tower import Tower

JACOBI = ("jacobi_sn", "jacobi_cn", "jacobi_dn", "jacobi_epsilon")
ODD = ("jacobi_sn", "jacobi_epsilon")
MOST_MULTIPLES = 6
HALF = Fraction(1, 2)
Values = tuple[Element, ...]
"""sn, cn, dn, and ε where it is asked for."""


@dataclass(frozen=True)
class Atom:
    """An argument that isn't taken apart, and its four functions by name."""

    value: Callable[[str], Element]


Parts = list[tuple[Atom, int]]


@dataclass
class Family:
    """What is known of one parameter m: basic arguments with their atoms, and arguments taken apart."""

    m: Element
    basis: list[tuple[Element, Atom]] = field(default_factory=list)
    known: list[tuple[Element, Parts]] = field(default_factory=list)


def function(tower: Tower, name: str, u: Element, m: Element) -> Element:
    """sn, cn, dn or epsilon of u for the parameter m."""
    prepare(tower, [(u, m)])
    family = _family(tower, m)
    parts = next(parts for known, parts in family.known if tower.field.equal(known, u))
    if len(parts) == 1 and abs(parts[0][1]) == 1:
        value = parts[0][0].value(name)
        return tower.field.negative(value) if parts[0][1] < 0 and name in ODD else value
    with_epsilon = name == "jacobi_epsilon"
    total = _origin(tower, with_epsilon)
    for atom, n in parts:
        names = JACOBI if with_epsilon else JACOBI[:3]
        total = _added(tower, m, total, _multiple(tower, m, tuple(atom.value(name) for name in names), n))
    return total[JACOBI.index(name)]


def prepare(tower: Tower, pairs: Sequence[tuple[Element, Element]]) -> None:
    """Choose basic arguments among these (u, m) together, so that they are taken apart alike."""
    families: dict[int, tuple[Family, list[Element]]] = {}
    for u, m in pairs:
        family = _family(tower, m)
        wanted = families.setdefault(id(family), (family, []))[1]
        if not any(tower.field.equal(u, known) for known in (*(v for v, _ in family.known), *wanted)):
            wanted.append(u)
    for family, wanted in families.values():
        if wanted:
            _take_apart(tower, family, wanted)


def _family(tower: Tower, m: Element) -> Family:
    families: list[Family] = tower.memory.setdefault("jacobi", [])
    for family in families:
        if tower.field.equal(family.m, m):
            return family
    families.append(Family(m))
    return families[-1]


def _take_apart(tower: Tower, family: Family, wanted: list[Element]) -> None:
    peeled = [_peeled(tower, family, u) for u in wanted]
    old = [b for b, _ in family.basis]
    new = [rest for _, rest in peeled]
    try:
        combinations, divisors = divided_basis(tower, old, new, MOST_MULTIPLES)
        if any(q.denominator != 1 for c in combinations for k, q in c.items() if k < len(old)):
            raise Unsupported("a fraction of an argument that has been taken for basic")
    except Unsupported:
        combinations = [{len(old) + n: ONE} if rest[0] else {} for n, rest in enumerate(new)]
        divisors = {len(old) + n: 1 for n, rest in enumerate(new) if rest[0]}
    atoms = {k: atom for k, (_, atom) in enumerate(family.basis)}
    for k, divisor in divisors.items():
        b = tower.field.combine([(Fraction(1, divisor), new[k - len(old)])])
        atoms[k] = Atom(_values_of(tower, b, family.m))
        family.basis.append((b, atoms[k]))
    for (parts, _), u, combination in zip(peeled, wanted, combinations, strict=True):
        family.known.append((u, [*parts, *((atoms[k], int(q * divisors.get(k, 1))) for k, q in combination.items())]))


def _peeled(tower: Tower, family: Family, u: Element) -> tuple[Parts, Element]:
    """Whole multiples of K(m) and F(φ, m) taken out of the argument."""
    from canon.decide.angles import take_out

    parts, back = list[tuple[Atom, int]](), [(ONE, u)]
    taken, _ = take_out(tower, u, ("elliptic_k", "elliptic_f"))
    for k, q in taken.items():
        made = tower.generators[k]
        if q.denominator == 1 and abs(q) <= MOST_MULTIPLES and tower.field.equal(made.data[-1], family.m):
            values = _period(tower, family.m) if len(made.data) == 1 else _amplitude(tower, made.data)
            parts.append((Atom(values), int(q)))
            back.append((-q, tower.element(made)))
    return parts, tower.field.combine(back)


def _period(tower: Tower, m: Element) -> Callable[[str], Element]:
    def value(name: str) -> Element:
        from canon.decide.inverse import kernel

        if name == "jacobi_epsilon":
            return kernel(tower, "elliptic_e", [m])
        if name == "jacobi_dn":
            return _root(tower, tower.field.combine([(-ONE, m)], ONE))
        return tower.field.constant(int(name == "jacobi_sn"))

    return value


def _amplitude(tower: Tower, data: tuple[Element, Element]) -> Callable[[str], Element]:
    phi, m = data

    def value(name: str) -> Element:
        from canon.decide.angles import cosines_and_sines
        from canon.decide.inverse import kernel

        if name == "jacobi_epsilon":
            return kernel(tower, "elliptic_ei", [phi, m])
        ((cosine, sine),) = cosines_and_sines(tower, [phi])
        if name == "jacobi_dn":
            square = tower.field.product([m, tower.field.power(sine, 2)])
            return _root(tower, tower.field.combine([(-ONE, square)], ONE))
        return sine if name == "jacobi_sn" else cosine

    return value


def _root(tower: Tower, x: Element) -> Element:
    from canon.decide.radicals import power

    return power(tower, x, HALF)


# -- the addition theorems ------------------------------------------------------------------------


def _origin(tower: Tower, with_epsilon: bool) -> Values:
    zero, one = tower.field.constant(0), tower.field.constant(1)
    return (zero, one, one, zero) if with_epsilon else (zero, one, one)


def _added(tower: Tower, m: Element, a: Values, b: Values) -> Values:
    """The functions of u + v from those of u and v."""
    f = tower.field
    if not a[0][0] and f.equal(a[1], f.constant(1)):
        return b
    if not b[0][0] and f.equal(b[1], f.constant(1)):
        return a
    (s1, c1, d1), (s2, c2, d2) = a[:3], b[:3]
    both = f.product([s1, s2])
    inverse = f.inverse(f.combine([(-ONE, f.product([m, f.power(both, 2)]))], ONE))
    sn = f.product([f.combine([(ONE, f.product([s1, c2, d2])), (ONE, f.product([s2, c1, d1]))]), inverse])
    cn = f.product([f.combine([(ONE, f.product([c1, c2])), (-ONE, f.product([both, d1, d2]))]), inverse])
    dn = f.product([f.combine([(ONE, f.product([d1, d2])), (-ONE, f.product([m, both, c1, c2]))]), inverse])
    total = tuple((f.normal(x[0]), x[1]) for x in (sn, cn, dn))
    if len(a) == 3:
        return total
    return *total, f.combine([(ONE, a[3]), (ONE, b[3]), (-ONE, f.product([m, both, total[0]]))])


def _multiple(tower: Tower, m: Element, values: Values, n: int) -> Values:
    if n < 0:
        s, c, d, *epsilon = _multiple(tower, m, values, -n)
        return tower.field.negative(s), c, d, *(tower.field.negative(e) for e in epsilon)
    total = _origin(tower, len(values) == 4)
    for _ in range(n):
        total = _added(tower, m, total, values)
    return total


# -- generators -----------------------------------------------------------------------------------


def _values_of(tower: Tower, u: Element, m: Element) -> Callable[[str], Element]:
    """The generators of a basic argument, each made when it is asked for."""
    made: dict[str, Element] = {}

    def value(name: str) -> Element:
        if name not in made:
            constant = tower.is_constant(u) and tower.is_constant(m)
            if name in ODD:
                made[name] = tower.element(tower.generator(name, "real", (u, m), constant=constant))
            else:
                made[name] = _even(tower, name, u, m, value("jacobi_sn"), constant)
        return made[name]

    return value


def _even(tower: Tower, name: str, u: Element, m: Element, sn: Element, constant: bool) -> Element:
    """cn and dn with cn² = 1 − sn² and dn² = 1 − m·sn² (DLMF 22.6.1); for a fraction m = n/d the generator is d·dn."""
    f, ring = tower.field, tower.ring
    under = ring.one
    if name == "jacobi_dn":
        for k, e in m[1].items():
            under = f.normal(ring.times(under, f.factor_power(k, e)))
    fractional = not under.is_constant()
    factor, first = f.constant(1) if name == "jacobi_cn" else (m[0], {}), f.constant(1)
    if fractional:
        factor, first = f.product([factor, (under, {})]), f.power((under, {}), 2)
    lower = f.combine([(ONE, first), (-ONE, f.product([factor, f.power(sn, 2)]))])
    positive = name == "jacobi_dn" and _below_one(tower, m) and (not fractional or _is_positive(tower, under))
    kind, data = ("jacobi_dn over", (u, m, (under, {}))) if fractional else (name, (u, m))
    relation = (2, f.normal(lower[0]))
    made = tower.generator(kind, "pos" if positive else "real", data, relation=relation, constant=constant)
    value = tower.element(made)
    return f.product([value, f.inverse((under, {}))]) if fractional else value


def _below_one(tower: Tower, m: Element) -> bool:
    """m ≤ 1 on the region: dn then has no zero; for m > 1 it changes its sign."""
    from canon.decide.signs import classify

    sign, _, _, unknown = classify(tower, tower.field.combine([(-ONE, m)], ONE))
    return sign > 0 and not unknown


def _is_positive(tower: Tower, p: Polynomial) -> bool:
    from canon.decide.signs import sign_of

    return sign_of(tower, p) == "pos"
