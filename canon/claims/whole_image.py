"""Is the image of a map that is given backward, or by a generating function, all of the domain in the old variables?

Then the file's domain is the same with the map and without it, and a claim in old variables is one without the map.
It is shown by a right inverse: new variables as functions of the old ones, smooth throughout the domain in old
variables, that satisfy all that the map and the file demand of them, and whose image the old variables are. An angle is
a point of the circle there, (s, c) with s² + c² = 1, so that no branch is cut: every point of the circle is
(sin x, cos x) of some x, also of one that is positive, or negative.

With q = a(P) sin Q, p = b(P) cos Q the place q = p = 0 may be left out: it is shown on either side of it, in q or in p,
that nothing else is.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import TYPE_CHECKING, Any, Final

import sympy as sp

from canon.claims.along_a_range import is_positive
from canon.claims.chart import chart_of
from canon.claims.outcome import Residual
from canon.deadline import within
from canon.decide.nowhere_zero import has_no_zero
from canon.decide.region import Region
from canon.decide.tape import Unsupported
from canon.domain import Condition, Domain, conditions_of, nonzero
from canon.errors import BudgetExceeded, EmptyDomain, InputError
from canon.mechanics.formulas import assumed_of
from canon.mechanics.right_inverse import Angle, angles_of, as_waves, right_inverses
from canon.mechanics.subject import Subject
from canon.sign import declared
from canon.substitution import replaced

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.mechanics import GeneratingFunction

SEARCH: Final = 0.5
"""Of the budget, to find a right inverse."""
SHARE: Final = 0.5
"""Of the budget, for all of it."""
MOST: Final = 6
"""Right inverses that are looked at."""


@dataclass(frozen=True)
class Place:
    """The places where the i-th pair of old variables has these values."""

    pair: int
    q: Any
    p: Any
    said: str

    def __str__(self) -> str:
        return self.said


@dataclass(frozen=True)
class WholeImage:
    """The image is all of the domain in the old variables but the places `left_out`; `inverse` says in words why."""

    inverse: tuple[str, ...]
    left_out: tuple[Place, ...] = ()


@dataclass(frozen=True)
class Map:
    """Old variables as functions of coordinates, of which the `unknown` are new variables, and what is demanded."""

    equations: tuple[Any, ...]
    unknown: tuple[sp.Symbol, ...]
    conditions: tuple[Condition, ...]
    angles: tuple[Angle, ...]

    def put_in(self, expression: Any, solution: Mapping[Any, Any]) -> Any:
        """An expression of the coordinates at a right inverse."""
        for angle in self.angles:
            expression = angle.put_in(expression)
        return replaced(expression, solution)


def without_map(question: Question) -> Subject:
    """What the claim is about without the file's map: of its domain, and of what the map demands, all that is said
    without new variables."""
    subject, new = question.subject, {*question.space.new}
    asked = (*subject.domain.conditions, *_written(question))
    kept = tuple(c for c in asked if not names_of(c) & new)
    domain = replace(subject.domain, conditions=tuple(dict.fromkeys(kept)))
    return replace(subject, transformation=None, generating_function=None, domain=domain)


def whole_image(question: Question) -> WholeImage | None:
    """What is seen of the image, exactly; None where it isn't seen to be the whole domain."""
    subject = question.subject
    if subject.domain.surface or len(question.space.new) != len(question.space.old):
        return None
    exactly = replace(question, budget=question.budget.share(SHARE), method="symbolic", listen=None)
    try:
        found = _map_of(exactly)
        return None if found is None else _shown(exactly, found)
    except (BudgetExceeded, Unsupported, EmptyDomain, InputError, RecursionError, NotImplementedError):
        return None


def names_of(condition: Condition) -> set[Any]:
    return {name for term in condition.terms for name in term.free_symbols}


def _written(question: Question) -> tuple[Condition, ...]:
    """The conditions of the map's own formulas, and that a generating function defines one."""
    subject = question.subject
    if subject.transformation is not None:
        return tuple(c for formula in subject.transformation.formulas for c in formula.conditions)
    generating = subject.generating_function
    return () if generating is None else (*generating.F.conditions, *_regular(generating))


def _map_of(question: Question) -> Map | None:
    """The map, if it is one of real numbers."""
    space, subject = question.space, question.subject
    generating = None if subject.transformation is not None else subject.generating_function
    mixed: dict[Any, Any] = {} if generating is None else dict(generating.conjugates())
    if generating is None:
        assert subject.transformation is not None
        given: dict[Any, Any] = {x: formula.expr for x, formula in subject.transformation.mapping.items()}
    else:
        given = {x: mixed[x] for x in generating.old_conjugates}
    unknown = tuple(x for x in space.new if x not in mixed)
    new = {*space.new}
    asked = [c for c in (*subject.domain.conditions, *_written(question)) if names_of(c) & new]
    conditions = [c.substitute(mixed) for c in asked]
    for x in space.new:
        if declared(x).get("integer") or not declared(x).get("real"):
            return None
        conditions += assumed_of(x, mixed[x]) if x in mixed else ()
    formulas = [*given.values(), *(term for c in conditions for term in c.terms)]
    if any(e.has(sp.I) or not all(x.is_real for x in e.free_symbols) for e in formulas):
        return None
    angles = tuple(angles_of(list(given.values()), unknown))
    turning = {angle.variable for angle in angles}
    conditions += [c for x in unknown if x not in turning for c in _sign_of(x)]
    equations = tuple(as_waves(e) - x for x, e in given.items())
    return Map(equations, unknown, tuple(dict.fromkeys(conditions)), angles)


def _sign_of(x: Any) -> Iterator[Condition]:
    """What is assumed of a new variable, as a condition on what stands in its place."""
    if x.is_nonnegative or x.is_nonpositive:
        yield Condition("positive", (x if x.is_nonnegative else -x,))
    elif x.is_zero is False:
        yield Condition("nonzero", (x,))


def _regular(generating: GeneratingFunction) -> tuple[Condition, ...]:
    """Where the mixed Hessian is not singular: only there is a map defined. **Raises** `InputError` if nowhere."""
    return nonzero(generating.mixed_hessian().det())


@dataclass(frozen=True)
class Part:
    """A part of the domain in old variables, in coordinates of its own: `rules` give old ones in these."""

    rules: Mapping[Any, Any]
    region: Region


def _shown(question: Question, given: Map) -> WholeImage | None:
    equations = [given.put_in(e, {}) for e in given.equations]
    search = question.budget.share(SEARCH)
    solutions = within(search, lambda: _first(right_inverses(equations, given.unknown, given.angles)))
    whole = _part(question, {})
    for solution in solutions:
        if _is_right_inverse(question, given, solution, whole):
            return WholeImage(_words(given, solution))
    places = [place for angle in given.angles if (place := _centre(question, given, angle)) is not None]
    if not places:
        return None
    for solution in solutions:
        if all(_is_right_inverse(question, given, solution, part) for part in _parts(question, places)):
            return WholeImage(_words(given, solution), tuple(x for x in places if not _is_outside(question, x)))
    return None


def _first(found: Iterator[dict[Any, Any]]) -> list[dict[Any, Any]]:
    return [solution for solution, _ in zip(found, range(MOST), strict=False)]


def _old_domain(question: Question) -> Domain:
    """The domain in old variables that the file would have without its map, with the kinks that orbits pass."""
    subject = without_map(question)
    H, domain = subject.hamiltonian, subject.domain
    whole = domain if H is None else domain & Domain(conditions=H.conditions)
    return replace(whole, conditions=tuple(c for c in whole.conditions if not c.kink))


def _is_right_inverse(question: Question, given: Map, solution: Mapping[Any, Any], part: Part) -> bool:
    """Whether a solution is smooth in the part, and there a point of the map's domain whose image is the old one."""
    tape, closed = question.tape, {*given.unknown}
    here = {x: replaced(value, part.rules) for x, value in solution.items()}

    def at(expression: Any) -> Any:
        return replaced(given.put_in(expression, here), part.rules)

    needed = [*conditions_of(*here.values())]
    needed += [Condition(c.kind, tuple(at(term) for term in c.terms)) for c in given.conditions]
    needed += [Condition("nonzero", (at(angle.rate),)) for angle in given.angles]
    if any(names_of(c) & closed for c in needed):
        return False
    if not all(holds_throughout(question, c, part.region) for c in needed):
        return False
    left = [at(e) for e in given.equations] + [here[a.sine] ** 2 + here[a.cosine] ** 2 - 1 for a in given.angles]
    if any(e.free_symbols & closed for e in left):
        return False
    residuals = [Residual(f"image {k}", tape.load(e)) for k, e in enumerate(left)]
    return question.decide(residuals, part.region).status == "proved"


def holds_throughout(question: Question, condition: Condition, region: Region) -> bool:
    """Whether a condition holds throughout a region. Conditions of what stands inside of it are asked for besides."""
    tape = question.tape
    terms: list[Any] = [sp.factor(term) if term.is_rational_function() else term for term in condition.terms]
    first, *more = map(tape.load, terms)
    if any(r.kind == condition.kind and r.nodes == (first, *more) for r in region.requirements):
        return True
    if condition.kind == "positive" and not more:
        return is_positive(question, first, region)
    if condition.kind != "nonzero" or more:
        return False
    if has_no_zero(tape, first, region, question.budget):
        return True
    return is_positive(question, first, region) or is_positive(question, tape.negative(first), region)


def _centre(question: Question, given: Map, angle: Angle) -> Place | None:
    """Where the pair of an angle is when neither its sine nor its cosine counts: (c, c') of q = c + a s, p = c' + b c,
    if the angle is in these two formulas alone."""
    space = question.space
    values: dict[Any, Any] = {}
    for equation in (angle.put_in(e) for e in given.equations):
        if not equation.has(angle.sine, angle.cosine):
            continue
        rest = sp.expand(equation.xreplace({angle.sine: sp.S.Zero, angle.cosine: sp.S.Zero}))
        names = [x for x in space.old if rest.coeff(x) == -1]
        value = sp.S.Zero if len(names) != 1 else rest + names[0]
        if len(names) != 1 or value.free_symbols & {*space.old, *space.new}:
            return None
        values[names[0]] = value
    for i, (q, p) in enumerate(zip(space.q, space.p, strict=True)):
        if values.keys() == {q, p}:
            return Place(i, values[q], values[p], f"{q} = {values[q]}, {p} = {values[p]}")
    return None


def _is_outside(question: Question, place: Place) -> bool:
    """Whether a place is none of the domain: |q| is smooth where q isn't 0."""
    space = question.space
    rules: dict[Any, Any] = {space.q[place.pair]: place.q, space.p[place.pair]: place.p}
    asked = [c for c in _old_domain(question).conditions if c.kind in ("positive", "nonzero")]
    return any(replaced(c.terms[0], rules) == 0 for c in asked)


def _part(question: Question, rules: Mapping[Any, Any]) -> Part:
    tape = question.tape
    images = {tape.symbol(x): tape.load(value) for x, value in rules.items()}
    plain = chart_of(tape, question.space, None)
    return Part(rules, question.region(domain=_old_domain(question), chart=plain, images=images))


def _parts(question: Question, places: Sequence[Place]) -> Iterator[Part]:
    """Parts that together are all but the places: on either side of each, in its coordinate or in its momentum."""
    space, aside = question.space, [sp.Dummy(f"u{k}", positive=True) for k in range(len(places))]
    for sides in product(((0, 1), (0, -1), (1, 1), (1, -1)), repeat=len(places)):
        rules: dict[Any, Any] = {}
        for (side, sign), place, u in zip(sides, places, aside, strict=True):
            name = (space.q[place.pair], space.p[place.pair])[side]
            rules[name] = (place.q, place.p)[side] + sign * u
        yield _part(question, rules)


def _words(given: Map, solution: Mapping[Any, Any]) -> tuple[str, ...]:
    """A right inverse in words."""
    names = {a.sine: f"sin({a.argument})" for a in given.angles}
    names |= {a.cosine: f"cos({a.argument})" for a in given.angles}
    return tuple(f"{names.get(x, x)} = {value}" for x, value in solution.items())
