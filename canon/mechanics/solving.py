"""Solving the equations of a transformation for some of its variables, branch by branch.

What is found is a proposal: it satisfies the equations at sample points and the assumptions on the names, and whoever
uses it has it verified as any other formula.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import product
from typing import Any, TypeAlias

import sympy as sp

from canon.budget import Budget
from canon.deadline import within as in_time
from canon.domain import Condition, unique
from canon.errors import BudgetExceeded, InputError
from canon.mechanics.formulas import as_formulas, replaced
from canon.mechanics.one_form import tidy
from canon.mechanics.solution_points import agrees, holds, sample_points

Solution: TypeAlias = dict[Any, Any]

_LARGEST = 8  # branches that are followed at once
_MOST_KINKS = 2  # absolute values whose signs are chosen one by one
_SECONDS = 10.0  # that sympy may take to solve and to shorten all branches together: neither always ends


def branches(
    equations: Mapping[sp.Symbol, sp.Expr],
    unknowns: Sequence[sp.Symbol],
    also: Mapping[sp.Symbol, sp.Expr] | None = None,
    *,
    within: Sequence[Condition] = (),
    besides: Mapping[sp.Symbol, sp.Expr] | None = None,
    throughout: bool = False,
) -> tuple[Solution, ...]:
    """The solutions of y = equations[y] for `unknowns`, as functions of the y and whatever else occurs.

    **Arguments:** besides the equations, what else is wanted at the solutions, `also`: functions of the same variables,
    each under a name of its own; `within`, the conditions of a domain to which the solutions are restricted; `besides`,
    further variables of which these may speak, as functions of the others; `throughout`, whether what is right at all
    points goes before what continues smoothly where no domain is stated, too.

    **Returns:** the branches that are right at some sample point: within a stated domain, or `throughout`, those first
    that are right at all of them, smooth ones before those with absolute values, and rare ones last; empty when sympy
    finds none. With arbitrary functions in the equations no branch can be sampled and all are kept.
    """
    wanted = dict(also or {})
    everything = (*unknowns, *wanted)
    system = [_prepared(known, value) for known, value in equations.items()]
    system += [value - name for name, value in wanted.items()]
    found: list[Solution] = []
    budget = Budget(_SECONDS)
    for solution in _solve(system, everything, budget):
        readable = {x: _shorter(_readable(solution[x]), budget) for x in everything}
        plus, *others = _smooth(readable, budget)
        for form in (plus, readable, *others, _with_other_roots(readable)):
            if form not in found:
                found.append(form)
        if len(found) >= _LARGEST:
            break
    points = list(sample_points(equations, unknowns, {**wanted, **(besides or {})}, within))
    if within and not points:  # too thin to be met by chance
        points = list(sample_points(equations, unknowns, wanted))
    if not points:
        return tuple(found)
    right = [sum(map(_right_at(solution), points)) for solution in found]
    kinks = [any(value.has(sp.Abs, sp.sign) for value in solution.values()) for solution in found]
    rare = [2 * count < max(right) for count in right]
    minus = [sum(map(_minus_signs, solution.values())) for solution in found]
    partial = [(bool(within) or throughout) and count < len(points) for count in right]
    order = sorted((k for k in range(len(found)) if right[k]), key=lambda k: (partial[k], kinks[k], rare[k], minus[k]))
    return tuple(found[k] for k in order)


def _right_at(solution: Solution) -> Callable[[Solution], bool]:
    """Whether a solution is right at a point: it is defined there, as claims have it, and gives the unknowns."""
    try:
        conditions = unique(*(formula.conditions for formula in as_formulas(solution.values())))
    except InputError:  # a function that isn't in the language, which whoever wants the formulas will be told
        conditions = ()
    return lambda point: agrees(solution, point) and all(holds(condition, point) for condition in conditions)


def _with_other_roots(solution: Solution) -> Solution:
    """The same with odd roots of negative numbers, which are negative: x^(1/3) as -(-x)^(1/3)."""

    def is_odd_root(part: Any) -> bool:
        exponent: Any = part.exp if isinstance(part, sp.Pow) else sp.S.One
        return exponent.is_Rational and exponent.q > 1 and exponent.q % 2 == 1

    return {
        x: value.replace(is_odd_root, lambda part: (-1) ** part.exp.p * (-part.base) ** part.exp)
        for x, value in solution.items()
    }


def _minus_signs(expression: sp.Expr) -> int:
    return sum(bool(part.is_Mul and part.args[0].is_negative) for part in sp.preorder_traversal(expression))


def _prepared(known: sp.Symbol, value: sp.Expr) -> sp.Expr:
    """An expression that vanishes where `known = value`, with an outermost arctangent undone.

    The arctangent may have a number as factor and a number added, as angles that advance by 1 have.
    """
    shift, scaled = value.as_independent(sp.atan2, sp.atan, as_Add=True)
    factor, turn = scaled.as_independent(sp.atan2, sp.atan, as_Add=False)
    angle = known if not shift and factor == 1 else (known - shift) / factor
    if isinstance(turn, (sp.atan2, sp.atan)) and shift.is_number and factor.is_number:
        if isinstance(turn, sp.atan):
            return turn.args[0] - sp.sin(angle) / sp.cos(angle)
        y, x = turn.args
        return y * sp.cos(angle) - x * sp.sin(angle)
    return value - known


def _solve(system: Sequence[sp.Expr], unknowns: tuple[sp.Symbol, ...], budget: Budget) -> Iterator[Solution]:
    """Solve by elimination: an equation in one unknown first, then one linear in an unknown, else the whole system.

    What sympy hasn't solved within the budget counts as not solved.
    """
    if not unknowns:
        yield {}
        return
    rooted = _without_roots(system, unknowns)
    if rooted is not None:
        easier, roots = rooted
        for solution in _solve(easier, tuple(roots.get(x, x) for x in unknowns), budget):
            yield {x: solution[roots[x]] ** 2 if x in roots else solution[x] for x in unknowns}
        return
    turned = _polar_pair(system, unknowns)
    if turned is not None:
        angle, candidates = turned
        others = tuple(x for x in unknowns if x != angle)
        for value, reduced in candidates:
            for solution in _solve(reduced, others, budget):
                yield {angle: replaced(value, solution), **solution}
        return
    system = [_numerator(equation) for equation in system]
    pick = _easiest(system, unknowns)
    if pick is None:
        yield from _solve_whole(system, unknowns, budget)
        return
    index, unknown = pick
    rest = [equation for k, equation in enumerate(system) if k != index]
    others = tuple(x for x in unknowns if x != unknown)
    for root in _roots(system[index], unknown, budget):
        reduced = [_shorter(replaced(equation, {unknown: root}), budget) for equation in rest]
        if any(equation.has(sp.zoo, sp.nan) or equation == 0 for equation in reduced):
            continue
        for solution in _solve(reduced, others, budget):
            yield {unknown: replaced(root, solution), **solution}


def _without_roots(
    system: Sequence[sp.Expr], unknowns: Sequence[sp.Symbol]
) -> tuple[list[sp.Expr], dict[Any, Any]] | None:
    """The system with x = s^2, s > 0, for each unknown x that occurs under a square root by itself."""
    powers: set[Any] = {power for equation in system for power in equation.atoms(sp.Pow) if power.exp.is_Rational}
    roots = {
        x: sp.Dummy(f"root_{x}", positive=True)
        for x in unknowns
        if any(power.base == x and power.exp.q == 2 for power in powers)
    }
    if not roots:
        return None
    squares = {x: root**2 for x, root in roots.items()}
    return [replaced(equation, squares) for equation in system], roots


def _polar_pair(
    system: Sequence[sp.Expr], unknowns: Sequence[sp.Symbol]
) -> tuple[sp.Symbol, list[tuple[sp.Expr, list[sp.Expr]]]] | None:
    """An angle of two equations A cos(angle) = a, k A sin(angle) = b, with what is left of the system.

    Then angle = atan2(b / k, a) with A = sqrt(a^2 + b^2 / k^2), or both signs turned.
    """
    for angle in unknowns:
        cosines, sines = [], []
        for index, equation in enumerate(system):
            found = _single_wave(equation, angle, unknowns)
            if found is not None:
                (cosines if found[0] is sp.cos else sines).append((index, *found[1:]))
        for i, A, a in cosines:
            for j, B, b in sines:
                ratio = tidy(B / A)
                if ratio.free_symbols & {*unknowns}:
                    continue
                y = tidy(b / ratio)
                radius = sp.sqrt(tidy(a**2 + y**2))
                kept = [equation for k, equation in enumerate(system) if k not in (i, j)]
                return angle, [
                    (direction, [A - size, *(replaced(equation, {angle: direction}) for equation in kept)])
                    for direction, size in ((sp.atan2(y, a), radius), (sp.atan2(-y, -a), -radius))
                ]
    return None


def _single_wave(equation: sp.Expr, angle: sp.Symbol, unknowns: Sequence[sp.Symbol]) -> tuple | None:
    """(cos, A, a) if the equation is A cos(angle) = a, and the same with sin; a must be known."""
    if angle not in equation.free_symbols:
        return None
    expanded = sp.expand(equation)
    for wave in (sp.cos, sp.sin):
        amplitude: Any = expanded.coeff(wave(angle))
        rest = expanded - sp.expand(amplitude * wave(angle))
        if amplitude != 0 and not amplitude.has(angle) and not rest.free_symbols & {*unknowns}:
            return wave, amplitude, -rest
    return None


def _numerator(equation: sp.Expr) -> sp.Expr:
    return sp.fraction(sp.together(equation))[0] if sp.count_ops(equation) < 200 else equation


def _easiest(system: Sequence[sp.Expr], unknowns: Sequence[sp.Symbol]) -> tuple[int, sp.Symbol] | None:
    """An equation and the unknown to solve it for: linear ones first, then those in one unknown alone."""
    best: tuple[tuple[int, int], int, sp.Symbol] | None = None
    for index, equation in enumerate(system):
        present = [x for x in unknowns if x in equation.free_symbols]
        for x in present:
            linear = not tidy(equation.diff(x)).has(x)
            if not linear and len(present) > 1:
                continue
            rank = (len(present) if linear else 2 * len(unknowns), sp.count_ops(equation))
            if best is None or rank < best[0]:
                best = (rank, index, x)
    return None if best is None else (best[1], best[2])


def _roots(equation: sp.Expr, unknown: sp.Symbol, budget: Budget) -> list[sp.Expr]:
    slope = tidy(equation.diff(unknown))
    if not slope.has(unknown):
        return [] if slope == 0 else [tidy(-replaced(equation, {unknown: sp.S.Zero}) / slope)]
    try:
        roots = in_time(budget, lambda: sp.solve(equation, unknown, check=False, simplify=False))
    except (RuntimeError, ValueError, TypeError, BudgetExceeded):
        return []
    return [root for root in roots if isinstance(root, sp.Expr) and not root.has(sp.Piecewise, sp.zoo, sp.nan)]


def _shorter(expression: sp.Expr, budget: Budget) -> sp.Expr:
    """The same in a shorter form, where that is found in time."""
    try:
        return in_time(budget, lambda: tidy(expression))
    except BudgetExceeded:
        return expression


def _solve_whole(system: Sequence[sp.Expr], unknowns: Sequence[sp.Symbol], budget: Budget) -> Iterator[Solution]:
    try:
        solutions = in_time(budget, lambda: sp.solve(system, unknowns, dict=True, check=False, simplify=False))
    except (RuntimeError, ValueError, TypeError, BudgetExceeded):
        return
    for solution in solutions:
        free = {x for value in solution.values() for x in value.free_symbols}
        if set(solution) == set(unknowns) and not free & set(unknowns):
            yield dict(solution)


def _readable(expression: Any) -> Any:
    """Inverse functions of the language alone: acot x = atan(1/x), asec x = acos(1/x), acsc x = asin(1/x)."""
    plain = {sp.acot: sp.atan, sp.asec: sp.acos, sp.acsc: sp.asin, sp.acoth: sp.atanh}
    for function, direct in plain.items():
        expression = expression.replace(function, lambda x, direct=direct: direct(1 / x))
    return expression.replace(
        _is_root_of_a_wave, lambda root: sp.sqrt(sp.factor(sp.trigsimp(root.base))) ** (2 * root.exp)
    )


def _is_root_of_a_wave(expression: sp.Expr) -> bool:
    """√(a − a sin²x) is to be found as √a |cos x|, whose absolute value can be continued."""
    if not isinstance(expression, sp.Pow) or expression.exp not in (sp.S.Half, -sp.S.Half):
        return False
    return expression.base.is_Add and expression.base.has(sp.sin, sp.cos) and sp.count_ops(expression.base) < 60


def _smooth(solution: Solution, budget: Budget) -> Iterator[Solution]:
    """The branches that continue analytically where absolute values have their kinks: |x| as x first, then as -x."""
    kinks = sorted({kink for value in solution.values() for kink in value.atoms(sp.Abs)}, key=str)
    for signs in product((1, -1), repeat=min(len(kinks), _MOST_KINKS)):
        chosen = dict(zip(kinks, signs, strict=False))

        def side(inner: sp.Expr, chosen: Mapping[Any, int] = chosen) -> sp.Expr:
            return chosen.get(sp.Abs(inner), 1) * inner

        yield {x: _shorter(value.replace(sp.Abs, side), budget) for x, value in solution.items()}
