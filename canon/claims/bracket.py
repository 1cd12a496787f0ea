"""Brackets of functions on phase space: values, Jacobi's identity, constants of motion, involution, identities.

With `tensor` and `coordinates` (or `structure`) the bracket is {f, g} = Σ T_ij ∂f/∂x_i ∂g/∂x_j in place of the
canonical one. Residuals are functions of the old variables, pulled back to the chart where the file's map is not
explicit in them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from itertools import combinations
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims.outcome import Outcome, Residual
from canon.decide import ladder
from canon.decide.derivative import derivative, poisson_bracket
from canon.decide.sample import Sample
from canon.decide.tape import Node
from canon.errors import InputError
from canon.expression import Formula
from canon.mechanics.vanishing import vanishes

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.decide.region import Region

Bracket = Callable[[Node, Node], Node]


def bracket_of(question: Question) -> Bracket:
    """The bracket that the claim is about, as a function of nodes.

    **Raises:** `InputError` for a tensor that isn't square, doesn't fit its coordinates, or isn't antisymmetric.
    """
    tape = question.tape
    if question.key("tensor") is None and question.key("structure") is None:
        q, p = question.nodes(question.space.q), question.nodes(question.space.p)
        return lambda f, g: poisson_bracket(tape, f, g, q, p)
    tensor, coordinates = tensor_of(question)
    entries = {
        (i, j): question.load(tensor[i][j])
        for i, j in combinations(range(len(coordinates)), 2)
        if question.load(tensor[i][j]) != tape.zero
    }
    x = question.nodes(coordinates)

    def bracket(f: Node, g: Node) -> Node:
        terms = []
        for (i, j), entry in entries.items():
            for a, b, sign in ((i, j, 1), (j, i, -1)):
                product = tape.times(entry, derivative(tape, f, x[a]), derivative(tape, g, x[b]))
                terms.append((product, sign))
        return tape.add(terms)

    return bracket


def tensor_of(question: Question) -> tuple[tuple[tuple[Formula, ...], ...], tuple[sp.Symbol, ...]]:
    """The Poisson tensor and its coordinates, given as `tensor` or as `structure` constants."""
    coordinates = names(question.key("coordinates"))
    if not coordinates:
        raise InputError("a tensor needs its coordinates, a list of names", "key 'coordinates'")
    if len(set(coordinates)) < len(coordinates):
        raise InputError("a coordinate is named twice", "key 'coordinates'")
    rows = question.key("tensor")
    if rows is None:
        return _from_structure(question, coordinates), coordinates
    size = len(coordinates)
    if len(rows) != size or any(len(row) != size for row in rows):
        raise InputError(f"a {size} by {size} matrix is expected, one row for each coordinate", "key 'tensor'")
    for i in range(size):
        for j in range(i, size):
            total = question.tape.plus(question.load(rows[i][j]), question.load(rows[j][i]))
            if question.tape.value(total) != 0 and not vanishes(rows[i][j].expr + rows[j][i].expr):
                raise InputError(
                    f"not antisymmetric: see the entries {i + 1},{j + 1} and {j + 1},{i + 1}", "key 'tensor'"
                )
    return tuple(tuple(row) for row in rows), coordinates


def names(values: Any) -> tuple[sp.Symbol, ...]:
    """The symbols of a list of names, given as symbols or as formulas; empty where it is no such list."""
    symbols = [item.expr if isinstance(item, Formula) else item for item in values or ()]
    found = tuple(item for item in symbols if isinstance(item, sp.Symbol))
    return found if len(found) == len(symbols) else ()


def _from_structure(question: Question, coordinates: tuple[sp.Symbol, ...]) -> tuple[tuple[Formula, ...], ...]:
    """The tensor of a Lie–Poisson bracket from a table "A,B" = {A, B}."""
    by_name = {x.name: k for k, x in enumerate(coordinates)}
    size = len(coordinates)
    zero = Formula(sp.S.Zero, ())
    entries = [[zero] * size for _ in range(size)]
    given: set[tuple[int, int]] = set()
    for pair, value in dict(question.key("structure")).items():
        names = [part.strip() for part in pair.split(",")] if isinstance(pair, str) else [str(part) for part in pair]
        unknown = [name for name in names if name not in by_name]
        if len(names) != 2 or unknown:
            raise InputError(f"a pair of coordinates is expected, not {pair!r}", "key 'structure'")
        i, j = by_name[names[0]], by_name[names[1]]
        if (i, j) in given or (j, i) in given or i == j:
            raise InputError(f"the pair {pair!r} is given twice, or is no pair", "key 'structure'")
        given.add((i, j))
        entries[i][j] = value
        entries[j][i] = replace(value, expr=-value.expr)
    return tuple(tuple(row) for row in entries)


def keys_domain(question: Question, *formulas: Formula) -> Region:
    """The region of the claim with the tensor's entries."""
    extra: Iterable[Formula] = ()
    if question.key("tensor") is not None or question.key("structure") is not None:
        tensor, _ = tensor_of(question)
        extra = (entry for row in tensor for entry in row)
    return question.region(*formulas, *extra)


def _pulled(question: Question, residuals: Iterable[Residual]) -> Iterator[Residual]:
    chart = question.chart
    for residual in residuals:
        actual = None if residual.actual is None else chart.pull(residual.actual)
        yield Residual(residual.label, chart.pull(residual.node), actual)


def decided(question: Question, residuals: Iterable[Residual], region: Region, *, warn: bool = True) -> Outcome:
    """The outcome, with the actual value of the bracket that fails; `warn` of a tensor that violates Jacobi's."""
    outcome = question.decide(_pulled(question, residuals), region)
    if outcome.failed is not None and outcome.failed.residual.actual is not None:
        outcome = outcome.with_detail(value=question.show(outcome.failed.residual.actual))
    return outcome.with_detail(warning=_not_poisson(question, region) if warn else None)


def _not_poisson(question: Question, region: Region) -> str | None:
    """A warning, if a point of the region shows that the claim's own tensor violates Jacobi's identity.

    Such a bracket isn't Poisson's, but what is claimed of it has a meaning (in nonholonomic mechanics it has a use):
    the claim is decided all the same.
    """
    if question.claim.kind == "jacobi" or (question.key("tensor") is None and question.key("structure") is None):
        return None
    coordinates, b = question.nodes(tensor_of(question)[1]), bracket_of(question)
    points: list[Sample] = []
    for x, y, z in combinations(coordinates, 3):
        if question.budget.spent():
            break
        cycle = question.tape.plus(b(x, b(y, z)), b(y, b(z, x)), b(z, b(x, y)))
        look = {"budget": question.budget, "seed": question.seed, "known": points}
        points, fails = ladder.look(question.tape, [question.chart.pull(cycle)], region, **look)
        if fails:
            names = ", ".join(str(question.tape.symbol_at(node)) for node in (x, y, z))
            return f"this is no Poisson bracket: Jacobi's identity fails for {names}"
    return None


def bracket(question: Question) -> Outcome:
    """`bracket`: {f, g} = equals."""
    f, g, equals = (question.formula(name) for name in ("f", "g", "equals"))
    region = keys_domain(question, f, g, equals)
    actual = bracket_of(question)(question.load(f), question.load(g))
    label = f"{{{f.label}, {g.label}}}"
    node = question.tape.minus(actual, question.load(equals))
    return decided(question, [Residual(label, node, actual)], region)


def jacobi(question: Question) -> Outcome:
    """`jacobi`: {f, {g, h}} + {g, {h, f}} + {h, {f, g}} = 0."""
    f, g, h = (question.formula(name) for name in ("f", "g", "h"))
    region = keys_domain(question, f, g, h)
    b = bracket_of(question)
    x, y, z = (question.load(formula) for formula in (f, g, h))
    total = question.tape.plus(b(x, b(y, z)), b(y, b(z, x)), b(z, b(x, y)))
    return decided(question, [Residual("{f, {g, h}} + {g, {h, f}} + {h, {f, g}}", total, total)], region)


def conserved(question: Question) -> Outcome:
    """`conserved`: ∂f/∂t + {f, H} = 0."""
    f, H = question.formula("f"), question.hamiltonian()
    region = keys_domain(question, f)
    node = question.load(f)
    explicit = derivative(question.tape, node, question.chart.time)
    rate = question.tape.plus(explicit, bracket_of(question)(node, question.load(H)))
    return decided(question, [Residual("df/dt", rate, rate)], region)


def involution(question: Question) -> Outcome:
    """`involution`: every pair of the functions has bracket 0."""
    functions = question.formulas("functions")
    if len(functions) < 2:
        raise InputError("at least two functions are needed", "key 'functions'")
    region = keys_domain(question, *functions)
    b = bracket_of(question)

    def pairs() -> Iterator[Residual]:
        for f, g in combinations(functions, 2):
            value = b(question.load(f), question.load(g))
            yield Residual(f"{{{f.label}, {g.label}}}", value, value)

    return decided(question, pairs(), region)


def identity(question: Question) -> Outcome:
    """`identity`: lhs = rhs throughout the domain; old and new variables are related by the map."""
    lhs, rhs = question.formula("lhs", "both"), question.formula("rhs", "both")
    tape = question.tape
    used = lhs.symbols | rhs.symbols
    if question.subject.map is None and used & set(question.space.new):
        raise InputError("new variables occur, but there is no transformation that relates them to the old ones")
    residual = Residual("lhs - rhs", tape.minus(question.load(lhs), question.load(rhs)))
    return decided(question, [residual], question.region(lhs, rhs))


KINDS = {"bracket": bracket, "jacobi": jacobi, "conserved": conserved, "involution": involution, "identity": identity}
