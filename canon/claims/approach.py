"""A name that tends to a value or to infinity: the domain near it, and what formulas tend to there."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from fractions import Fraction
from math import lcm
from typing import TYPE_CHECKING

import sympy as sp

from canon.claims.velocities import region_in_velocities
from canon.decide import ladder
from canon.decide.asymptotic import Expander, Known, Ramified, Sign, SignOf, expand
from canon.decide.derivative import derivative, substitute
from canon.decide.enclosure import certainly_positive
from canon.decide.growth import Tamed, growth, tamed
from canon.decide.nowhere_zero import has_no_zero
from canon.decide.positivity import positive_by_signs
from canon.decide.power_series import Series, Unexpanded
from canon.decide.region import Region, Requirement
from canon.decide.tape import Node, Tape
from canon.errors import InputError
from canon.expression import Formula

if TYPE_CHECKING:
    from canon.claims.question import Question

TERMS = (3, 6, 12)


@dataclass(frozen=True)
class Approach:
    """A name tending to its limit from one side.

    **Arguments:** `x`, its node; `s`, a positive symbol that tends to 0; `image`, x in s; `region`, the conditions on
    the other names; `near`, those that must hold for small s.
    """

    x: Node
    s: Node
    image: Node
    region: Region
    near: tuple[Requirement, ...]
    words: str

    def at(self, tape: Tape, fixed: Mapping[Node, Node]) -> Approach:
        """The approach with numbers for the other names, at a point of the region."""
        image = substitute(tape, self.image, fixed)
        near = tuple(replace(r, nodes=tuple(substitute(tape, n, fixed) for n in r.nodes)) for r in self.near)
        return Approach(self.x, self.s, image, Region((), (), ()), near, self.words)


def approaching(
    question: Question, x: sp.Symbol, to: Formula | str, side: int, formulas: Sequence[Formula]
) -> Approach:
    """The approach of a name to its limit, with the domain of the claim divided between it and the others."""
    tape = question.tape
    s = tape.symbol(sp.Dummy("s", positive=True))
    if isinstance(to, Formula):
        image = tape.add([(question.load(to), 1), (s, side)])
        words = f"{x} -> {to} from {'above' if side > 0 else 'below'}"
    else:
        image = tape.scaled(tape.power(s, -1), side)
        words = f"{x} -> {to}"
    node = tape.symbol(x)
    written = region_in_velocities(question, *formulas, images={node: image})
    near = tuple(r for r in written.requirements if any(s in tape.support(n) for n in r.nodes))
    if any(s in tape.support(n) for n in written.surface):
        raise InputError(f"the surface of the domain contains {x}, which is to vary", "[domain], key 'on'")
    kept = tuple(r for r in written.requirements if r not in near)
    return Approach(
        node, s, image, Region(kept, written.surface, tuple(n for n in written.symbols if n != node)), near, words
    )


def signs_on(question: Question, region: Region) -> SignOf:
    """The signs that nodes have on all of a region."""
    tape, known = question.tape, dict[Node, Known | None]()

    def sign_of(node: Node) -> Known | None:
        if node not in known:
            known[node] = found(node)
        return known[node]

    def found(node: Node) -> Known | None:
        value = tape.value(node)
        if value is not None:
            return "zero" if value == 0 else "pos" if value > 0 else "neg"
        (answer,) = ladder.vanish(tape, [node], region, budget=question.budget.share(0.3), seed=question.seed)
        if answer.status == "proved":
            return "zero"
        if not tape.support(node) and not tape.functions_of([node]) and answer.balls:
            return (
                "pos"
                if certainly_positive(answer.balls[0])
                else "neg"
                if certainly_positive(-answer.balls[0])
                else None
            )
        if positive_by_signs(tape, node, region, question.budget, strict=True):
            return "pos"
        if positive_by_signs(tape, tape.negative(node), region, question.budget, strict=True):
            return "neg"
        if tape.is_complex(node) or not has_no_zero(tape, node, region, question.budget):
            return None
        if positive_by_signs(tape, node, region, question.budget, strict=False):
            return "pos"
        if positive_by_signs(tape, tape.negative(node), region, question.budget, strict=False):
            return "neg"
        return "nonzero"

    return sign_of


@dataclass(frozen=True)
class Limit:
    """What an expansion shows: a finite limit, or the sign of an infinite one (0: it depends on the other names).

    `leading` is the coefficient of the leading term, of that `order`.
    """

    value: Node | None
    infinite: int = 0
    leading: Node | None = None
    order: Fraction = Fraction(0)


def limit_of(question: Question, approach: Approach, node: Node, also: Sequence[Node] = ()) -> Limit:
    """The limit of a node, exactly; `also` are other nodes that are smooth on the domain.

    **Raises:** `Unexpanded` where none is found.
    """
    tape, sign_of = question.tape, signs_on(question, approach.region)
    target = substitute(tape, node, {approach.x: approach.image})
    calls = [tape.ops[i] for i in tape.reach([target, *also]) if tape.ops[i][0] == "u"]
    written = {(op[1], op[3]) for op in calls if all(approach.s not in tape.support(a) for a in op[3])}
    reason = Unexpanded("no expansion")
    for taming in (False, True):
        for terms in TERMS:
            try:
                found = _expanded(tape, approach, target, sign_of, terms, written, taming)
                if found is None:
                    break
                return found
            except Unexpanded as failed:
                reason = failed
    raise reason


def _expanded(
    tape: Tape,
    approach: Approach,
    target: Node,
    sign_of: SignOf,
    terms: int,
    written: Set[tuple[str, tuple[Node, ...]]],
    taming: bool,
) -> Limit | None:
    """The limit by expansions of so many terms; with `taming`, of what is left without exponentials that grow (None
    where there are none)."""
    main, near, scaled, power = Tamed(tape.zero, target), approach.near, False, 1
    if taming:
        main, near, power = _tamed(tape, approach, target, sign_of, terms)
        scaled = near != approach.near
        if main == (tape.zero, target) and not scaled:
            return None
    nodes = [main.rest, *(n for r in near for n in r.nodes)]
    series, _, expander = expand(tape, nodes[1:], approach.s, sign_of, terms)
    inside = _hold(approach, near, series, expander.leading, expander.from_nonzero) and not scaled
    series, root, expander = expand(tape, nodes, approach.s, sign_of, terms)
    if not inside and not expander.arbitrary <= written:
        raise Unexpanded("an arbitrary function at the edge of the domain, where it may not be smooth")
    towards = "zero" if main.exponent == tape.zero else growth(expander, main.exponent)
    if towards == "neg":
        return Limit(tape.zero)
    if towards == "pos":
        first, sign = expander.leading(series[0])
        size = tape.times(first.coefficients[0], tape.call("exp", main.exponent))
        return Limit(None, 1 if sign == "pos" else -1, size, Fraction(first.start, root * power))
    if main.exponent != tape.zero:
        raise Unexpanded("exponentials that nearly cancel")
    return _read_off(series[0], root * power, expander)


def _tamed(
    tape: Tape, approach: Approach, target: Node, sign_of: SignOf, terms: int
) -> tuple[Tamed, tuple[Requirement, ...], int]:
    """The target and the conditions without exponentials that grow, s being the power returned of a new s."""
    power = 1
    for _ in range(4):
        shift = {approach.s: tape.power(approach.s, power)}
        expander = Expander(tape, approach.s, sign_of, terms)
        near = (replace(r, nodes=tuple(substitute(tape, n, shift) for n in r.nodes)) for r in approach.near)
        try:
            main = tamed(expander, substitute(tape, target, shift))
            return main, tuple(_tamed_condition(expander, r) for r in near), power
        except Ramified as need:
            power = lcm(power, power * need.root)
    raise Unexpanded("no expansion in fractional powers")


def _tamed_condition(expander: Expander, r: Requirement) -> Requirement:
    """The condition without an exponential that is a factor: its sign is the same."""
    if r.kind not in ("positive", "nonzero", "slit"):
        return r
    return replace(r, nodes=tuple(tamed(expander, n).rest for n in r.nodes))


def _hold(
    approach: Approach,
    near: Sequence[Requirement],
    series: Sequence[Series],
    leading: Callable[[Series], tuple[Series, Sign]],
    nonzero: Callable[[Series], Series],
) -> bool:
    """Whether what must hold for small s does so at s = 0 too. **Raises:** `InputError` where it fails."""
    index, inside = 0, True
    for requirement in near:
        parts = series[index : index + len(requirement.nodes)]
        index += len(requirement.nodes)
        if requirement.kind in ("positive", "slit"):
            found, sign = leading(parts[0])
            if sign == "neg":
                raise InputError(
                    f"{requirement.text} fails for {approach.words}: the domain doesn't reach there (see `side`)",
                    "key 'to'",
                )
        elif requirement.kind == "nonzero":
            found = nonzero(parts[0])
        elif requirement.kind == "uncut":
            found, sign = leading(parts[1])
            if sign == "neg":
                found, _ = leading(parts[0])
        else:
            found = Series(0, ())
        inside = inside and found.start == 0
    return inside


def _read_off(f: Series, root: int, expander: Expander) -> Limit:
    tape, log = expander.tape, expander.log
    for k, c in enumerate(f.coefficients):
        power = f.start + k
        if power > 0:
            return Limit(tape.zero)
        if expander.wild(c):
            slope = derivative(tape, c, log)
            if not expander.wild(slope) and expander.sign_of(slope) == "zero":
                c = substitute(tape, c, {log: tape.zero})  # logarithms that cancel
        if expander.wild(c):
            slope = derivative(tape, c, log)
            if expander.wild(slope) or power < 0:
                raise Unexpanded("it oscillates, or grows like a power of a logarithm")
            sign = expander.sign_of(slope)
            if sign not in ("pos", "neg"):
                raise Unexpanded("it oscillates, or grows like a logarithm whose factor has no sign")
            return Limit(None, -1 if sign == "pos" else 1, tape.times(slope, log))
        if power == 0:
            return Limit(c)
        sign = expander.sign_of(c)
        if sign != "zero":
            return Limit(None, {"pos": 1, "neg": -1}.get(sign or "", 0), c, Fraction(power, root))
    if f.end > 0:
        return Limit(tape.zero)
    raise Unexpanded("too few terms")
