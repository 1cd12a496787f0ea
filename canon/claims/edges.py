"""What `>=` says besides `>`: places with an inner point at which two sides are equal, of which deciders know nothing.

Conditions are strict, and claims speak of the open part of a domain, so that nothing is lost where the zeros of a
difference have no inner point. They have one where x + |x| >= 0, for x < 0; on a surface, where x >= 0 and x p = 0, for
x = 0; for a >= 0 at a = 0, since a claim is one about each value of its parameters; and for V(x) >= 0 where V is 0.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import product
from typing import TYPE_CHECKING, Any, Final, Literal

import sympy as sp
from sympy.core.function import AppliedUndef

from canon.claims.own_names import VARIED
from canon.domain import Condition
from canon.expression import Formula

if TYPE_CHECKING:
    from canon.claims.outcome import Outcome
    from canon.claims.question import Question

Edge = Literal["thin", "given", "thick"]
"""Without an inner point; with one at values of what is given alone, near which there are others; neither is seen."""

CONTINUOUS: Final = frozenset(
    {
        "identity", "bracket", "jacobi", "conserved", "involution", "casimir", "infinitesimal", "equations_of_motion",
        "bracket_invariance", "fundamental_brackets", "canonical", "volume", "integral_invariant", "generates",
        "invariant_interval", "matrix_group", "field_equations", "solves", "noether", "dimension",
        "hamiltonian_field",
    }
)  # fmt: skip
"""Kinds of which all that is claimed is that something vanishes: it does so in a limit, too."""
EVERYWHERE: Final = CONTINUOUS | {"inequality", "limit", "integral", "independent", "symmetry", "new_hamiltonian"}
"""Kinds that fail where they fail on a part of the domain."""
MEROMORPHIC: Final = (sp.exp, sp.sin, sp.cos, sp.tan, sp.cot, sp.sec, sp.csc, sp.sinh, sp.cosh, sp.tanh, sp.coth)
MOST: Final = 5
"""Roots and absolute values of which both signs are tried."""
LARGEST: Final = 4
"""The degree of a surface's equation, and of what is compared on it."""
UNSEEN: Final = "nothing is said where both sides of {} are equal: write it with < or > where that isn't meant"


def with_edges(question: Question, outcome: Outcome) -> Outcome:
    """The outcome; a proof, or a refutation without a point, is none where an edge may hold more of the domain."""
    if outcome.status not in ("proved", "refuted") or (
        outcome.status == "refuted" and question.claim.kind in EVERYWHERE
    ):
        return outcome
    space, stated = question.space, any(c.closed for c in question.subject.domain.conditions)
    if not stated and not any(_may_be_zero(x) for x in (*space.old, *space.new)):
        return outcome
    moving, mapped = _moving(question), _mapped(question)
    domain = question.domain(*_formulas(list(question.claim.keys.values())))
    apart = {e for c in domain.conditions if c.kind == "nonzero" for e in (c.terms[0], -c.terms[0])}
    closed = [c.substitute(mapped) for c in domain.conditions if c.closed and c.terms[0] not in apart]
    closed += [c for x, e in mapped.items() if (c := _assumed(x, e)) is not None and c not in domain.conditions]
    surface = tuple(e.xreplace(mapped) for e in domain.surface)
    edges = [(c, edge_of(c.terms[0], moving, surface)) for c in closed]
    wide = [c for c, edge in edges if edge == "thick"]
    given = [c for c, edge in edges if edge == "given" and _matters(question, c, domain.conditions)]
    if len(given) > 1 and not all(_is_affine(c.terms[0]) for c in given):
        wide += given
    if given and not wide and outcome.status == "proved" and not _is_continuous(question):
        wide = given
    if not wide:
        return outcome
    said = UNSEEN.format(wide[0].closed)
    return outcome.with_status("supported" if outcome.status == "proved" else "undecided", said)


def _mapped(question: Question) -> dict[Any, Any]:
    """What the map puts in the place of variables: of those that are not the ones in which it is given."""
    made = question.subject.map
    if made is None:
        return {}
    F = made.generating_function if made.direction == "implicit" else None
    if F is None:
        return {x: formula.expr for x, formula in made.mapping.items()}
    names, signs = (*F.old_conjugates, *F.new_conjugates), [sign for side in F.signs() for sign in side]
    return {x: sign * F.F.expr.diff(y) for x, y, sign in zip(names, F.mixed, signs, strict=True)}


def _assumed(x: Any, e: Any) -> Condition | None:
    """What is assumed of a variable that may be 0, of its value by the map."""
    if not _may_be_zero(x) or not e.free_symbols:
        return None
    return Condition("positive", (e if x.is_nonnegative else -e,), closed=f"{x} {'>=' if x.is_nonnegative else '<='} 0")


def _may_be_zero(x: Any) -> bool:
    return x.is_zero is not False and bool(x.is_nonnegative or x.is_nonpositive)


def _matters(question: Question, edge: Condition, conditions: Iterable[Condition]) -> bool:
    """Whether what is given in an edge stands anywhere else."""
    formulas = (*question.sections(), *_formulas(list(question.claim.keys.values())))
    others = [f.expr for f in formulas] + [term for c in conditions if c != edge for term in c.terms]
    own = edge.terms[0]
    return own.has(AppliedUndef) or any((own.free_symbols - _moving(question)) & e.free_symbols for e in others)


def _is_continuous(question: Question) -> bool:
    """Whether a claim holds at a value of its parameters if it holds at those near it."""
    claim, made = question.claim, question.subject.map
    if claim.kind == "inequality":
        return claim.keys.get("relation") in ("<=", ">=")
    return claim.kind in CONTINUOUS and "scale" not in claim.keys and (made is None or made.direction != "implicit")


def _moving(question: Question) -> set[Any]:
    """The names that a claim varies: variables, time, and those of its own."""
    space, keys = question.space, question.claim.keys
    own = [value for word in (*VARIED, "variable") for value in _listed(keys.get(word))]
    return {*space.old, *space.new, space.t, *(x.expr if isinstance(x, Formula) else x for x in own)}


def _listed(value: Any) -> tuple[Any, ...]:
    return tuple(value) if isinstance(value, tuple | list) else (value,)


def _formulas(value: Any) -> Iterator[Formula]:
    if isinstance(value, Formula):
        yield value
    elif isinstance(value, tuple | list):
        for item in value:
            yield from _formulas(item)
    elif hasattr(value, "items"):
        for item in value.values():
            yield from _formulas(item)


def edge_of(e: Any, moving: Iterable[Any], surface: Iterable[Any] = ()) -> Edge:
    """Of the zeros of e for fixed values of all names but those that move, and for fixed functions: their inner points.

    - "thin": there are none, whatever is fixed.
    - "given": there may be some at single values of what is fixed; by a slope, e is positive near these.
    - "thick": neither is seen.
    """
    moving = {*moving}
    names = sorted(e.free_symbols & moving, key=str)
    if not all(x.is_real for x in e.free_symbols):
        return "thick"
    if equations := tuple(surface):
        return "thin" if _crosses(e, equations, moving) else "thick"
    slopes = [e.diff(x) for x in names]
    if any(slope.is_zero is False for slope in slopes):
        return "thin"
    for f in (e, *slopes):
        if (signed := _signed(f)) and all(_is_nowhere_flat(g, names) for g in signed):
            return "thin"
    functions = [a for a in sp.preorder_traversal(e) if isinstance(a, AppliedUndef | sp.Derivative | sp.Subs)]
    if any(_may_grow(x, e.diff(x)) for x in e.free_symbols - {*names} if not x.is_integer):
        return "given"
    return "given" if any(_is_free(e, f) for f in functions) else "thick"


def _may_grow(x: Any, slope: Any) -> bool:
    """Whether what has this slope, a number, grows with x, or as x decreases, which what is 0 at least can't always."""
    bound = x.is_nonpositive if slope.is_positive else x.is_nonnegative
    return _is_not_zero(slope) and not (_may_be_zero(x) and bound)


def _is_free(e: Any, f: Any) -> bool:
    """Whether the value of a function stands in e alone, with a number for its slope."""
    value = sp.Dummy(real=True)
    there = e.xreplace({f: value})
    return not there.has(AppliedUndef, sp.Derivative, sp.Subs) and _is_not_zero(there.diff(value))


def _signed(e: Any) -> list[Any]:
    """What e is on parts of its domain, with each sign of its roots and absolute values; empty where that isn't seen.

    A root goes over into its other value round its zeros. If e were 0 on a part, one of these would be so everywhere.
    """
    kinks = [a for a in {*sp.preorder_traversal(e)} if isinstance(a, sp.Abs | sp.sign) or _is_root(a)]
    if len(kinks) > MOST:
        return []
    choices = product((1, -1), repeat=len(kinks))
    found = [_with_signs(e, dict(zip(kinks, signs, strict=True))) for signs in choices]
    return found if all(_is_meromorphic(a) for f in found for a in sp.preorder_traversal(f)) else []


def _with_signs(e: Any, signs: dict[Any, int]) -> Any:
    parts = [_with_signs(part, signs) for part in e.args]
    if isinstance(e, sp.Abs | sp.sign):
        return signs[e] * (parts[0] if isinstance(e, sp.Abs) else sp.Integer(1))
    return signs.get(e, 1) * e.func(*parts) if parts else e


def _is_root(a: Any) -> bool:
    return isinstance(a, sp.Pow) and isinstance(a.exp, sp.Rational) and a.exp.q == 2 and bool(a.base.free_symbols)


def _is_meromorphic(a: Any) -> bool:
    """Whether it is a function that is meromorphic where those are that it is made of, or one of their square roots."""
    if isinstance(a, sp.Pow):
        return a.exp.is_Integer or _is_root(a) or (a.base.is_number and a.base.is_positive is True)
    return isinstance(a, (sp.Add, sp.Mul, sp.Number, sp.NumberSymbol, sp.Symbol, *MEROMORPHIC))


def _is_nowhere_flat(f: Any, names: list[Any]) -> bool:
    """Whether f is seen not to be 0 throughout its domain in these names, whatever the others are.

    By a value, or a slope's, at one place that contains no other name; or as a polynomial with a coefficient that is
    never 0.
    """
    place = {x: sp.Rational(3 + k, 7 + 4 * k) for k, x in enumerate(names)}
    for g in (f, *(f.diff(x) for x in names)):
        if g.free_symbols <= {*names} and _is_not_zero(g.subs(place)):
            return True
    top = sp.fraction(sp.together(f))[0]
    if not names or not top.is_polynomial(*names):
        return False
    return any(c.is_zero is False for c in sp.Poly(top, *names).coeffs())


def _crosses(e: Any, equations: tuple[Any, ...], moving: set[Any]) -> bool:
    """Whether e is 0 on no piece of a surface: without a common factor, and where both are 0 the surface is smooth."""
    g, *others = equations
    xs = sorted(e.free_symbols | g.free_symbols, key=str)
    if (
        others
        or not {*xs} <= moving
        or len(xs) > LARGEST
        or not all(f.is_polynomial(*xs) and sp.Poly(f, *xs).total_degree() <= LARGEST for f in (e, g))
    ):
        return False
    polynomials = [sp.Poly(f, *xs) for f in (e, g, *(g.diff(x) for x in xs))]
    if not all(f.domain.is_QQ or f.domain.is_ZZ for f in polynomials):
        return False
    return polynomials[0].gcd(polynomials[1]).is_ground and sp.groebner(polynomials, *xs, domain="QQ").exprs == [1]


def _is_affine(e: Any) -> bool:
    names = sorted(e.free_symbols, key=str)
    return bool(names) and e.is_polynomial(*names) and sp.Poly(e, *names).total_degree() <= 1


def _is_not_zero(value: Any) -> bool:
    return not value.free_symbols and value.is_zero is False
