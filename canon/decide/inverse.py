"""Inverse trigonometric, special and arbitrary functions: kernels with few relations or none.

They stand as generators of their arguments; equal arguments share one. What relates different ones
(atan x and atan 1/x) is left to the later steps of the ladder.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from canon.decide import jacobi_kernels
from canon.decide.fraction_field import Element
from canon.decide.tape import ONE, Unsupported

if TYPE_CHECKING:
    from canon.decide.tower import Tower

ODD = ("atan", "asin")
REAL_KERNELS = (
    "atan", "asin", "acos", "atan2", "gamma", "lambertw", "elliptic_k", "elliptic_e", "elliptic_f", "elliptic_ei",
    "elliptic_pi", "elliptic_pii", "integer_power",
)  # fmt: skip
FARTHEST_SHIFT = 40


def kernel(tower: Tower, name: str, arguments: Sequence[Element]) -> Element:
    """The generator of an inverse or special function of real arguments."""
    field = tower.field
    if any(tower.is_complex(x) for x in arguments):
        raise Unsupported(f"{name} of a complex argument")
    if name in jacobi_kernels.JACOBI:
        return jacobi_kernels.function(tower, name, arguments[0], arguments[1])
    if name not in REAL_KERNELS:
        raise Unsupported(f"no exact argument about {name}")
    if name == "lambertw":
        inverse = _lambertw(tower, arguments[0])
        if inverse is not None:
            return inverse
    if name == "gamma":
        return _gamma(tower, arguments[0])
    flipped = name in ODD and bool(arguments[0][0]) and tower.ring.leading(arguments[0][0]) < 0
    if flipped:
        arguments = [field.negative(arguments[0])]
    known = _find(tower, name, arguments)
    if known is None and name in ("elliptic_k", "elliptic_e"):
        known = _by_other_parameter(tower, name, arguments[0])
    if known is None and name == "elliptic_pi":
        known = _third_kind(tower, *arguments)
    if known is None and name == "elliptic_e":
        known = _by_legendre(tower, arguments[0])
    if known is None:
        constant = all(tower.is_constant(x) for x in arguments)
        sign = _sign(tower, name, arguments)
        known = tower.element(_made(tower, name, sign, arguments, constant))
    return field.negative(known) if flipped else known


def _by_other_parameter(tower: Tower, name: str, m: Element) -> Element | None:
    """K(m) = K(m/(m−1))/√(1−m) and E(m) = √(1−m) E(m/(m−1)) where that is there already, for m < 1 (DLMF 19.7.2)."""
    from canon.decide import radicals
    from canon.decide.signs import learn_positive

    field = tower.field
    rest = field.combine([(-ONE, m)], ONE)
    if not m[0] or not rest[0]:
        return None
    other = _find(tower, name, [field.negative(field.product([m, field.inverse(rest)]))])
    if other is None:
        return None
    learn_positive(tower, [rest])  # both are defined for m < 1 alone
    return field.product([other, radicals.power(tower, rest, Fraction(-1 if name == "elliptic_k" else 1, 2))])


def _third_kind(tower: Tower, n: Element, m: Element) -> Element | None:
    """Π(n, m), n < 1 and m < 1, by what is there already.

    Π(0, m) = K(m); Π(m, m) = E(m)/(1 − m); Π(n, m) = Π(n/(n−1), m/(m−1))/((1−n)√(1−m)) (DLMF 19.6.1-2, 19.7.4 with
    the complement of the amplitude).
    """
    from canon.decide import radicals
    from canon.decide.signs import learn_positive

    field = tower.field
    if not n[0]:
        return kernel(tower, "elliptic_k", [m])
    over, under = (field.combine([(-ONE, x)], ONE) for x in (n, m))
    if not over[0] or not under[0]:
        return None
    if field.equal(n, m):
        return field.product([kernel(tower, "elliptic_e", [m]), field.inverse(under)])
    turned = [field.negative(field.product([x, field.inverse(rest)])) for x, rest in ((n, over), (m, under))]
    other = _find(tower, "elliptic_pi", turned)
    if other is None:
        return None
    learn_positive(tower, [over, under])  # both are defined for n < 1 and m < 1 alone
    return field.product([other, field.inverse(over), radicals.power(tower, under, Fraction(-1, 2))])


def _by_legendre(tower: Tower, m: Element) -> Element | None:
    """E(m) from E(1−m), where that is there already: E K′ + E′K − K K′ = π/2 (DLMF 19.7.1), for 0 < m < 1."""
    field = tower.field
    rest = field.combine([(-ONE, m)], ONE)
    other = _find(tower, "elliptic_e", [rest])
    if other is None or field.equal(m, rest):
        return None
    k, k_other = kernel(tower, "elliptic_k", [m]), kernel(tower, "elliptic_k", [rest])
    terms = [(Fraction(1, 2), _pi(tower)), (ONE, field.product([k, k_other])), (-ONE, field.product([other, k]))]
    return field.product([field.combine(terms), field.inverse(k_other)])


def _gamma(tower: Tower, x: Element) -> Element:
    """Γ(y + n) = Γ(y)·y(y+1)…(y+n−1), with the constant term of y in (0, 1]."""
    field, ring = tower.field, tower.ring
    reflected = _reflected(tower, x)
    if reflected is not None:
        return reflected
    constant = ring.terms(x[0]).get((0,) * ring.size, Fraction(0)) if not x[1] and x[0] else Fraction(0)
    shift = -((-constant.numerator) // constant.denominator) - 1
    if x[1] or shift == 0 or abs(shift) > FARTHEST_SHIFT:
        shift = 0
    y = field.combine([(ONE, x)], Fraction(-shift))
    known = (_reflected(tower, y) if shift else None) or _doubled(tower, y) or _find(tower, "gamma", [y])
    if known is None:
        known = tower.element(_made(tower, "gamma", "real", [y], tower.is_constant(y)))
    steps = [field.combine([(ONE, y)], Fraction(k)) for k in (range(shift) if shift > 0 else range(shift, 0))]
    if not steps:
        return known
    product = field.product(steps)
    return field.product([known, product if shift > 0 else field.inverse(product)])


def _reflected(tower: Tower, x: Element) -> Element | None:
    """Γ(x) = π/(sin(πz)·Γ(z)), z = 1 − x, where x falls with its leading symbol (DLMF 5.5.3).

    sin(πz) must vanish on a null set only, so x has to vary with symbols that aren't integers; or to be a number
    between 1/2 and 1.
    """
    field, ring = tower.field, tower.ring
    if x[1] or not x[0]:
        return None
    if x[0].is_constant():
        if not Fraction(1, 2) < ring.leading(x[0]) < 1:
            return None
    elif ring.leading(x[0]) > 0:
        return None
    if any(g.kind != "symbol" or tower.tape.symbol_at(g.data).is_integer for g in tower.used(x[0])):
        return None
    from canon.decide.angles import cosines_and_sines

    pi = _pi(tower)
    z = field.combine([(-ONE, x)], ONE)
    ((_, sine),) = cosines_and_sines(tower, [field.product([pi, z])])
    return field.product([pi, field.inverse(field.product([sine, _gamma(tower, z)]))])


def _doubled(tower: Tower, y: Element) -> Element | None:
    """Γ(2x) = 2**(2x−1) Γ(x) Γ(x+1/2) / √π where y = 2x varies by even multiples of its generators (DLMF 5.5.5)."""
    field, ring = tower.field, tower.ring
    if y[1] or not y[0] or y[0].is_constant():
        return None
    if any(c.denominator != 1 or c % 2 for m, c in ring.terms(y[0]).items() if any(m)):
        return None
    from canon.decide.exponentials import exponential, log_of_factor
    from canon.decide.radicals import power

    log = log_of_factor(tower, ring.constant(2))
    (factor,) = exponential(tower, [field.product([field.combine([(ONE, y)], -ONE), log])])
    root = power(tower, _pi(tower), Fraction(1, 2))
    parts = [_gamma(tower, field.combine([(Fraction(1, 2), y)], shift)) for shift in (Fraction(0), Fraction(1, 2))]
    return field.product([factor, *parts, field.inverse(root)])


def _pi(tower: Tower) -> Element:
    pi = next((g for g in tower.generators if g.kind == "pi"), None)
    return tower.element(pi if pi is not None else tower.generator("pi", "pos", None, constant=True))


def _lambertw(tower: Tower, x: Element) -> Element | None:
    """W(y exp y) = y for y > −1 (DLMF 4.13.1: the principal branch is the inverse there)."""
    field = tower.field
    from canon.decide.signs import classify

    for _, made in tower.memory.get("exponentials", []):
        for times in (1, 2, 3, 4):
            y = field.combine([(Fraction(times), made.data)])
            if field.equal(x, field.product([y, field.power(tower.element(made), times)])):
                sign, _, known, unknown = classify(tower, field.combine([(ONE, y)], ONE))
                return y if sign > 0 and not unknown and all(_strict(tower, f) for f, _ in known) else None
    return None


def arbitrary(tower: Tower, name: str, orders: tuple[int, ...], arguments: Sequence[Element]) -> Element:
    """A derivative of an arbitrary function as a free generator: true for every value, true for every function."""
    table = tower.memory.setdefault("arbitrary", [])
    for known, order, others, made in table:
        if (
            known == name
            and order == orders
            and all(tower.field.equal(x, y) for x, y in zip(others, arguments, strict=True))
        ):
            return tower.element(made)
    sign = "cplx" if any(tower.is_complex(x) for x in arguments) else "real"
    made = tower.generator("arbitrary", sign, (name, orders, tuple(arguments)))
    table.append((name, orders, tuple(arguments), made))
    return tower.element(made)


def _find(tower: Tower, name: str, arguments: Sequence[Element]) -> Element | None:
    for known, others, made in tower.memory.setdefault("kernels", []):
        if known == name and all(tower.field.equal(x, y) for x, y in zip(others, arguments, strict=True)):
            return tower.element(made)
    return None


def _made(tower: Tower, name: str, sign: str, arguments: Sequence[Element], constant: bool):
    made = tower.generator(name, sign, tuple(arguments), constant=constant)
    tower.memory["kernels"].append((name, tuple(arguments), made))
    return made


def _sign(tower: Tower, name: str, arguments: Sequence[Element]) -> str:
    from canon.decide.signs import classify

    if name in ("acos", "elliptic_k", "elliptic_e", "elliptic_pi"):
        return "pos"
    if name in ("atan", "asin"):
        sign, _, known, unknown = classify(tower, arguments[0])
        if not unknown and arguments[0][0]:
            strict = all(_strict(tower, f) for f, _ in known)
            return ("pos" if sign > 0 else "neg") if strict else ("nonneg" if sign > 0 else "nonpos")
    return "real"


def _strict(tower: Tower, f) -> bool:
    from canon.decide.signs import sign_of

    return sign_of(tower, f) in ("pos", "neg")
