"""Which integrator a scene is run with: the one that is asked for, or the one that is best for an accuracy."""

from __future__ import annotations

from typing import Any, Final, NamedTuple

from canon.errors import InputError
from canon.numeric.integrators import catalogue
from canon.numeric.integrators.constrained import Held
from canon.numeric.integrators.side_by_side import Together
from canon.scenes.problem import Problem

COARSE: Final = 1e-4
FINE: Final = 1e-10


class Choice(NamedTuple):
    """A method and why it was chosen."""

    method: Any
    why: str


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
