"""Which integrator a scene is run with: the one that is asked for, or the one that is best for an accuracy."""

from __future__ import annotations

from typing import Any, Final, NamedTuple

from canon.errors import InputError
from canon.numeric.candidates import Prediction, most_accurate, of_closed_form, predicted
from canon.numeric.integrators import catalogue
from canon.numeric.integrators.constrained import Held
from canon.numeric.integrators.side_by_side import Together
from canon.numeric.step_search import Task
from canon.scenes.problem import Problem
from canon.scenes.scene import Settings

COARSE: Final = 1e-4
FINE: Final = 1e-10
LEAST_BUDGET: Final = 30.0
"""Seconds below which candidates for a budget are not tried: to compile them takes some seconds."""
SPENT: Final = 0.5
"""Of a budget what the last run takes: the runs before it, with half as many steps each, take as much together."""


SPLITTING: Final = ("blanes_moan4", "blanes_moan6", "kahan_li8", "sofroniou_spaletta10")
NYSTROM: Final = ("nystrom4", "nystrom6a", "nystrom8", "sofroniou_spaletta10")
WHOLE: Final = ("gauss4", "gauss6", "gauss8")
"""Candidates by the form of the problem, one an order."""


class Choice(NamedTuple):
    """A method and why it was chosen; with `candidates`, what each was predicted to cost, and with `foreseen` what the
    method itself was."""

    method: Any
    why: str
    candidates: tuple[Prediction, ...] = ()
    foreseen: Prediction | None = None


def chosen_for(
    problem: Problem, task: Task, settings: Settings, rule: Choice, *, began_with: str | None = None
) -> Choice:
    """The candidate whose predicted work for the accuracy is least, or whose predicted error within the budget is;
    what the rules say where a method or a step is given, where the motion is in closed form or of systems side by side,
    and where trying would take longer than what it could save.

    **Arguments:** `began_with`, the method of the run that is gone on with.
    """
    names = _names(problem)
    if began_with in names and settings.integrator is None:
        return Choice(catalogue.method(began_with), "chosen when the run was begun")
    given = settings.integrator is not None or settings.step is not None
    if problem.exact and not given and began_with is None and settings.accuracy is not None:
        return rule._replace(foreseen=of_closed_form(task))
    if not names or given:
        return rule
    others = [catalogue.method(name) for name in names if name != rule.method.name]
    if settings.accuracy is None:
        if settings.budget is None or settings.budget < LEAST_BUDGET:
            return rule
        best = most_accurate(task, [rule.method, *others], SPENT * settings.budget)
        same = best[0].method is rule.method
        why = rule.why if same else f"of least predicted error within the budget among {len(best)} candidates"
        return Choice(best[0].method, why, tuple(best), best[0])
    found = predicted(task, [rule.method, *others], settings.accuracy, compare=settings.compare)
    if found[0].method is rule.method:
        return rule._replace(candidates=tuple(found), foreseen=found[0])
    return Choice(found[0].method, f"of least predicted work among {len(found)} candidates", tuple(found), found[0])


def _names(problem: Problem) -> tuple[str, ...]:
    if problem.exact or problem.beside:
        return ()
    if isinstance(problem.value, Held):
        return tuple(method.name for method in catalogue.CONSTRAINED)
    if not problem.splits:
        return WHOLE
    return NYSTROM if problem.value.nystrom else SPLITTING  # pyright: ignore[reportAttributeAccessIssue]


def choose(problem: Problem, accuracy: float | None, name: str | None, where: str = "") -> Choice:
    """The method for an accuracy, or the one of this name. **Raises:** `InputError` for a name that there isn't."""
    if problem.beside:
        return _beside(problem, accuracy, name, where)
    if name is not None:
        try:
            return Choice(catalogue.method(name), "asked for")
        except InputError as error:
            raise error.at(where) from None
    known: dict[str, Any] = {method.name: method for method in catalogue.METHODS}
    if isinstance(problem.value, Held):
        order = (
            4 if accuracy is not None and accuracy >= COARSE else 8 if accuracy is not None and accuracy < FINE else 6
        )
        chosen = next(each for each in catalogue.CONSTRAINED if each.traits.order == order)
        return Choice(chosen, f"symplectic on the constraint surface; order {order} for the accuracy")
    if not problem.splits:
        stages = 2 if accuracy is not None and accuracy >= COARSE else 3 if accuracy is None or accuracy >= FINE else 4
        chosen = known[f"gauss{2 * stages}"]
        return Choice(chosen, f"symplectic, for a Hamiltonian that does not split; order {2 * stages} for the accuracy")
    if problem.exact:
        return Choice(
            known["verlet"], "the motion is one part, solved in closed form: its steps make no error but rounding"
        )
    nystrom = problem.value.nystrom  # pyright: ignore[reportAttributeAccessIssue]
    if accuracy is not None and accuracy >= COARSE:
        chosen = known["nystrom4"] if nystrom else known["blanes_moan4"]
    elif accuracy is not None and accuracy < FINE:
        chosen = known["nystrom8"] if nystrom else known["kahan_li8"]
    else:
        chosen = known["nystrom6a"] if nystrom else known["blanes_moan6"]
    what = "parts that are solved exactly"
    if chosen.needs == "nystrom":
        plain = problem.kind == "T(p) + V(q)"
        what = "T(p) + V(q, t) with a quadratic T" if plain else "a part that is quadratic in the momenta, and V(q, t)"
    return Choice(chosen, f"order {chosen.traits.order} for the accuracy, {chosen.stages} stages, for {what}")


def _beside(problem: Problem, accuracy: float | None, name: str | None, where: str) -> Choice:
    """A method for each of the independent problems; one that is asked for goes to all that it can solve."""
    chosen = [choose(each, accuracy, name, where) for each in problem.beside]
    if name is not None:
        taken = [_takes(choice.method, each) for choice, each in zip(chosen, problem.beside, strict=True)]
        if not any(taken):
            raise InputError(f"{name} solves none of the scene's parts: {problem.kind}", where)
        rows = zip(chosen, taken, problem.beside, strict=True)
        chosen = [choice if takes else choose(each, accuracy, None) for choice, takes, each in rows]
    methods = tuple(choice.method for choice in chosen)
    weighty = tuple(method for method, each in zip(methods, problem.beside, strict=True) if not each.exact)
    return Choice(Together(methods, weighty), "; ".join(dict.fromkeys(choice.why for choice in chosen)))


def _takes(method: Any, problem: Problem) -> bool:
    """Whether a method can solve a problem."""
    try:
        method.stepper(problem.value)
    except InputError:
        return False
    return True
