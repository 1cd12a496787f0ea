"""Which orbits a Hamiltonian has, at one choice of its constants: for errors that say which energies would work.

A claim about an energy at which nothing librates or rotates is ill-posed. Its error names what is wrong there, as the
map of the potential shows it in numbers, and the energies that have such orbits; where H has constants, at a choice of
them, for the sake of example.
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.budget import BudgetExceeded
from canon.claims.action_region import Setting, constants_region
from canon.decide.search import samples
from canon.decide.tape import Unsupported
from canon.errors import InputError

if TYPE_CHECKING:
    from canon.claims.question import Question
    from canon.numeric.actions.motion import Motion

TIME = 0.3
PLACES = ("energy", "well", "branch")


@dataclass(frozen=True)
class Example:
    """The motion where the constants have these values."""

    values: Mapping[sp.Symbol, sp.Rational]
    motion: Motion

    def number(self, expression: Any) -> Any:
        """An expression in the constants at these values."""
        return _at(expression, self.values)

    @property
    def prefix(self) -> str:
        """The values in words, such as "at k = 1, m = 2/3: "."""
        shown = ", ".join(f"{name} = {value}" for name, value in sorted(self.values.items(), key=str))
        return f"at {shown}: " if shown else ""


def example(question: Question, setting: Setting) -> Example | None:
    """The motion at some choice of the constants; None where none is found, or H isn't understood in numbers."""
    from canon.numeric.actions.motion import motion

    values = _constants(question, setting)
    if values is None:
        return None
    low, high = (_at(end, values) for end in (setting.motion.low, setting.motion.high))
    try:
        ends = None if (low, high) == (-sp.oo, sp.oo) else (float(low), float(high))
        return Example(values, motion(_at(setting.H, values), setting.q, setting.p, domain=ends))
    except (InputError, TypeError, ValueError):
        return None


def _at(expression: Any, values: Mapping[Any, Any]) -> Any:
    return expression.xreplace(values)


def _rational(value: Any) -> Any:
    return sp.Rational(value.numerator, value.denominator) if isinstance(value, Fraction) else None


def _constants(question: Question, setting: Setting) -> dict[Any, Any] | None:
    range_of = (setting.motion.low, setting.motion.high)
    named = set().union(setting.H.free_symbols, setting.equals.free_symbols, *(end.free_symbols for end in range_of))
    for expression in (setting.level, setting.energy, setting.well):
        named |= expression.free_symbols if expression is not None else set()
    named -= {setting.q, setting.p}
    if isinstance(setting.energy, sp.Symbol):
        named.discard(setting.energy)
    if not named:
        return {}
    tape, names = question.tape, sorted(named, key=str)
    rng, nodes = random.Random(question.seed), [tape.symbol(name) for name in names]
    try:
        region = constants_region(question, setting)
        for sample in samples(tape, nodes, region, rng, count=1, budget=question.budget.share(TIME), nice=True):
            exact = [_rational(sample.point.get(node)) for node in nodes]
            if all(value is not None for value in exact):
                return dict(zip(names, exact, strict=True))
    except (Unsupported, BudgetExceeded):
        pass
    return None


def why_not(question: Question, setting: Setting, branch: str, here: Example | None) -> InputError | None:
    """What is wrong with the energy, branch or well of a claim; None where such an orbit is found after all."""
    if here is None:
        return None
    orbits, rate = here.motion, question.claim.kind == "frequency"
    level = setting.level if setting.level is not None else setting.energy
    try:
        if isinstance(level, sp.Symbol) and level not in here.values:
            _at_any_energy(orbits, branch)
            return None
        inside = None if setting.well is None else here.number(setting.well)
        found = orbits.orbit(energy=here.number(level), well=inside, branch=question.key("branch"))
    except InputError as error:
        if error.where not in PLACES:  # not a fault of what is claimed
            return None
        return InputError(here.prefix + error.message, _place(question, error.where))
    if inside is not None and orbits.domain.period is None:
        left, right = (end.value for end in found.ends)
        if not left <= float(inside) <= right:
            return InputError(
                f"{here.prefix}{setting.q} = {setting.well} is not inside an orbit: the nearest one runs from "
                f"{left:.6g} to {right:.6g}",
                "key 'well'",
            )
    if rate and found.period is None:
        return InputError(
            f"{here.prefix}E = {here.number(level)} is exactly that of the separatrix: the period is infinite there, "
            f"and there is no frequency; the action is finite. {orbits.ranges()}",
            _place(question, "energy"),
        )
    return None


def _at_any_energy(orbits: Motion, branch: str) -> None:
    """**Raises** `InputError` where no energy at all has such an orbit."""
    if branch == "rotation" and orbits.domain.period is None:
        raise InputError(f"nothing rotates, as H isn't periodic in {orbits.profile.q}: {orbits.ranges()}", "branch")
    if branch == "libration" and not any(node.kind > 0 for node in orbits.nodes):
        raise InputError(f"{orbits.ranges()}", "energy")


def _place(question: Question, where: str) -> str:
    if where == "energy" and question.key("energy") in (question.key("fixed") or {}):
        return "key 'fixed'"
    return f"key {where!r}"
