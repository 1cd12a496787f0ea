"""Which Lie algebra structure constants make, and whether it is the one that a claim names."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy as sp
from flint import fmpq

from canon.claims.algebra_in_balls import killing_signature
from canon.claims.outcome import Outcome, exact
from canon.claims.scale import never_zero
from canon.claims.structure_search import BITS
from canon.domain import Condition
from canon.errors import InputError
from canon.mechanics.algebra import linear
from canon.mechanics.algebra.by_signature import semisimple_of
from canon.mechanics.algebra.coefficients import sympy_of
from canon.mechanics.algebra.identify import Identification, identify
from canon.mechanics.algebra.identity import isomorphic
from canon.mechanics.algebra.lie_algebra import LieAlgebra
from canon.mechanics.algebra.names import read_name
from canon.mechanics.algebra.rescaling import rescaled
from canon.mechanics.formulas import replaced
from canon.mechanics.vanishing import ball_of
from canon.sign import declared

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.decide.region import Region

INVARIANTS = "real Lie algebras of different dimension, Levi subalgebra or abelian factors aren't isomorphic"
CLASSIFIED = "its Levi decomposition, complex types and real forms determine a real Lie algebra of this kind"
RIGID = "semisimple Lie algebras don't change their isomorphism class where their structure constants are continuous"
BY_SIGNATURE = "of semisimple algebras of this dimension one alone has a Killing form of this signature, found in balls"
LARGEST_SYMBOLIC = 10
MOST_CASES = 3
"""The most parameters of open sign whose cases are looked at one by one."""
DEPENDS = "depends on the parameters: "
VALUES = (sp.S.One, sp.S.NegativeOne, sp.S.Zero, sp.Integer(2))


def identity_outcome(question: Question, region: Region, algebra: LieAlgebra, equals: str | None) -> Outcome:
    """What the algebra is, for all values of the parameters in its structure constants; is it `equals`?

    Proved where the isomorphism is determined by invariants, refuted where invariants differ; where the constants
    depend on parameters, after a change of scale that makes them rational, or because a semisimple algebra is rigid.
    """
    named = None if equals is None else read_name(equals)
    try:
        found, reason = _for_all_parameters(_with_signs(algebra, question.domain().conditions))
        if found is None:
            return _at_values(question, region, algebra, equals)
    except ArithmeticError as error:
        return Outcome("undecided", note=f"not identified: {error}")
    detail = described(found)
    if named is None:
        return exact("proved", CLASSIFIED if found.identity.is_named else "structure constants", **detail)
    same = isomorphic(found.identity, named)
    if same is None:
        return Outcome("undecided", detail=detail, note=f"not identified among several: is it {equals}?")
    if not same:
        detail["fails"] = f"isomorphism with {equals}"
        return question.refuted_exactly(region, INVARIANTS, **detail)
    return exact("proved", "; ".join(part for part in (reason, CLASSIFIED) if part), **detail)


def sign_on_the_domain(symbol: sp.Symbol, conditions: Iterable[Condition]) -> str | None:
    """ "positive" or "negative" for a parameter of open sign to which a condition of the domain gives one."""
    if not _sign_is_open(declared(symbol)):
        return None
    for condition in conditions:
        factor: Any = condition.terms[0] / symbol
        if condition.kind == "positive" and factor.is_Rational:
            return "positive" if factor > 0 else "negative"
    return None


def _with_signs(algebra: LieAlgebra, conditions: Sequence[Condition]) -> LieAlgebra:
    """The algebra with parameters of the signs that the domain gives them."""
    signs = {x: sign_on_the_domain(x, conditions) for x in algebra.parameters}
    images = {x: sp.Symbol(x.name, **{sign: True}) for x, sign in signs.items() if sign is not None}
    return (at(algebra, images) or algebra) if images else algebra


def described(found: Identification) -> dict[str, Any]:
    """What was found, for a verdict's detail."""
    detail: dict[str, Any] = {"algebra": found.identity.name}
    if found.identity.aliases:
        detail["also_called"] = ", ".join(found.identity.aliases)
    positive, negative, zero = found.killing_signature
    detail["killing_signature"] = f"{positive} positive, {negative} negative, {zero} zero"
    bases = found.ideal_bases()
    if len(bases) > 1:
        detail["simple_ideals"] = [", ".join(basis) for basis in bases]
    return detail


def _for_all_parameters(algebra: LieAlgebra) -> tuple[Identification | None, str]:
    """The identification that holds for all values of the parameters, and the argument for that; None: not found."""
    scaled = rescaled(algebra)
    if scaled is not None:
        if scaled.is_trivial:
            return identify(scaled.algebra), ""
        scales = ", ".join(f"{n} by {s}" for n, s in zip(algebra.names, scaled.scales, strict=True) if s != 1)
        return identify(scaled.algebra), f"the basis rescaled, {scales}"
    if not algebra.parameters:
        return _by_signature(algebra), BY_SIGNATURE
    if not _is_semisimple_throughout(algebra):
        return _in_each_case(algebra)
    values = next(_tables(algebra.parameters))
    there = at(algebra, values)
    if there is None:
        return None, ""
    return (identify(there), RIGID) if there.is_rational else (_by_signature(there), f"{RIGID}; {BY_SIGNATURE}")


def _by_signature(algebra: LieAlgebra) -> Identification | None:
    """A semisimple algebra of irrational constants, by its Killing form in balls; None where that doesn't tell."""
    size = algebra.dimension
    balls: dict[tuple[int, int], list[Any]] = {}
    for pair, row in algebra.constants.items():
        found = [ball_of(sympy_of(row.get(c, Fraction(0))), {}, BITS) for c in range(size)]
        if any(ball is None or not ball.imag.contains(0) for ball in found):
            return None
        balls[pair] = [ball.real for ball in found if ball is not None]
    signature = killing_signature(size, balls) if size else None
    identity = None if signature is None else semisimple_of(*signature)
    if signature is None or identity is None:
        return None
    every = linear.matrix([[fmpq(int(i == j)) for j in range(size)] for i in range(size)], size)
    return Identification(identity, algebra, every, linear.matrix([], size), (), (*signature, 0))


def _in_each_case(algebra: LieAlgebra) -> tuple[Identification | None, str]:
    """The identification where it is one for either sign of a parameter, and for 0 where that is allowed."""
    free = [x for x in sorted(algebra.parameters, key=str) if _sign_is_open(declared(x))]
    if not free or len(free) > MOST_CASES:
        return None, ""
    facts, name = declared(free[0]), free[0].name
    cases: list[Any] = []
    if not facts.get("nonpositive"):
        cases.append(sp.Symbol(name, positive=True))
    if not facts.get("nonnegative"):
        cases.append(sp.Symbol(name, negative=True))
    if facts.get("zero") is None:
        cases.append(sp.S.Zero)
    found: list[Identification] = []
    for value in cases:
        there = at(algebra, {free[0]: value})
        one = None if there is None else _for_all_parameters(there)[0]
        if one is None or (found and one.identity != found[0].identity):
            return None, ""
        found.append(one)
    return found[0], f"the same for each sign of {name}"


def _sign_is_open(facts: Mapping[str, bool]) -> bool:
    return bool(facts.get("real")) and not any(facts.get(sign) for sign in ("positive", "negative", "zero"))


def at(algebra: LieAlgebra, values: Mapping[Any, Any]) -> LieAlgebra | None:
    """The algebra at values of its parameters; None where a constant isn't defined there."""
    constants: dict[tuple[int, int], dict[int, Any]] = {}
    for pair, row in algebra.constants.items():
        constants[pair] = {
            c: value if isinstance(value, Fraction) else sp.radsimp(replaced(value, values)) for c, value in row.items()
        }
        if any(not isinstance(v, Fraction) and v.has(sp.zoo, sp.nan, sp.oo) for v in constants[pair].values()):
            return None
    return LieAlgebra(algebra.names, constants)


def _tables(parameters: frozenset[sp.Symbol]) -> Iterator[dict[sp.Symbol, sp.Expr]]:
    """Allowed values of the parameters: 1, −1, 0 or 2 for all, as far as each may be that."""
    for value in VALUES:
        chosen = {}
        for symbol in parameters:
            facts = declared(symbol)
            tried = [value, *VALUES]
            chosen[symbol] = next((v for v in tried if _may_be(facts, v)), None)
        if None not in chosen.values():
            yield chosen


def _may_be(facts: Mapping[str, bool], value: Any) -> bool:
    known = declared(sp.Dummy(positive=True)) if value > 0 else declared(sp.Dummy(negative=True))
    known = declared(sp.Dummy(zero=True)) if value == 0 else known
    signs = ("positive", "negative", "zero", "nonnegative", "nonpositive", "nonzero")
    return all(known.get(word) == facts[word] for word in signs if facts.get(word) is not None)


def _is_semisimple_throughout(algebra: LieAlgebra) -> bool:
    """The Killing form is nowhere singular, the constants are continuous, and the parameters make a connected set."""
    if algebra.dimension > LARGEST_SYMBOLIC:
        return False
    for symbol in algebra.parameters:
        facts = declared(symbol)
        connected = any(facts.get(sign) for sign in ("positive", "negative", "nonnegative", "nonpositive"))
        if not facts.get("real") or facts.get("integer") or not (connected or facts.get("zero") is None):
            return False
    values = [v for row in algebra.constants.values() for v in row.values() if not isinstance(v, Fraction)]
    if any(not v.is_rational_function(*algebra.parameters) for v in values):
        return False
    if not all(never_zero(sp.fraction(sp.together(v))[1]) for v in values):
        return False
    n = algebra.dimension
    ad = [sp.Matrix(n, n, lambda c, b, a=a: algebra.bracket_of(a, b).get(c, 0)) for a in range(n)]
    form = sp.Matrix(n, n, lambda a, b: sp.expand((ad[a] * ad[b]).trace()))
    determinant: Any = sp.factor(form.det(method="berkowitz"))
    return never_zero(determinant)


def _at_values(question: Question, region: Region, algebra: LieAlgebra, equals: str | None) -> Outcome:
    """A refutation at values of the parameters; else undecided, with what it is at those that were tried."""
    named = None if equals is None else read_name(equals)
    seen: dict[str, str] = {}
    for values in _tables(algebra.parameters):
        there = at(algebra, values)
        scaled = None if there is None else rescaled(there)
        if scaled is None:
            continue
        found = identify(scaled.algebra)
        place = ", ".join(f"{symbol} = {value}" for symbol, value in sorted(values.items(), key=str))
        seen[place] = found.identity.name
        if named is not None and isomorphic(found.identity, named) is False and _is_inside(question, region, values):
            detail = described(found) | {"fails": f"isomorphism with {equals} at {place}"}
            detail |= {"algebra": f"{found.identity.name} at {place}"}
            return exact("refuted", INVARIANTS, **detail)
    note = "; ".join(f"{name} at {place}" for place, name in seen.items())
    if named is None and seen:
        return exact("proved", "structure constants", algebra=f"{DEPENDS}{note}")
    return Outcome("undecided", note=f"not identified for all values of the parameters: {note}")


def _is_inside(question: Question, region: Region, values: Mapping[sp.Symbol, sp.Expr]) -> bool:
    """Whether the claim's domain has a point at these values of the parameters."""
    from canon.claims.fixed_parameters import fixed_region

    tape = question.tape
    moved = fixed_region(tape, region, {tape.symbol(s): tape.load(v) for s, v in values.items()})
    if moved is None:
        return False
    try:
        outcome = question.refuted_exactly(moved, INVARIANTS)
    except InputError:
        return False
    return outcome.status == "refuted"
