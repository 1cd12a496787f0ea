"""Relations of sympy as regions: what they say of the points where a claim is made."""

from typing import Any

import sympy as sp
from sympy.core.relational import GreaterThan, LessThan, Relational, StrictGreaterThan, StrictLessThan
from sympy.logic.boolalg import BooleanFalse, BooleanTrue

from canon.domain import Condition, Domain, conditions_of
from canon.errors import InputError
from canon.mechanics.extent import check_extent
from canon.whole_bounds import at_least_zero


def region_of(relation: Any) -> Domain:
    """Where an inequality, `Ne`, a conjunction of these, or an equation (a surface) holds.

    **Raises:** `InputError` for a relation that can never hold, or that is none.
    """
    if relation is True or isinstance(relation, BooleanTrue):
        return Domain()
    if relation is False or isinstance(relation, BooleanFalse):
        raise InputError("a relation of the domain can never hold")
    if isinstance(relation, sp.And):
        region = Domain()
        for part in relation.args:
            region = region & region_of(part)
        return region
    if not isinstance(relation, Relational):
        raise InputError(f"an inequality or equation is expected, not {relation!r}", "domain")
    ordered: Any = relation
    for side in (ordered.lhs, ordered.rhs):
        if not isinstance(side, sp.Expr):
            raise InputError(f"{relation} compares {side!r}, which is no formula", "domain")
        check_extent(side, where="domain")
    closed = ""
    if isinstance(relation, GreaterThan | LessThan | StrictGreaterThan | StrictLessThan):
        difference = ordered.gts - ordered.lts
        if isinstance(relation, GreaterThan | LessThan):
            bound = at_least_zero(difference, str(relation))
            difference, closed = bound, str(relation) if bound is difference else ""
    else:
        difference = ordered.lhs - ordered.rhs
    defined = tuple(conditions_of(ordered.lhs)) + tuple(conditions_of(ordered.rhs))
    if isinstance(relation, sp.Eq):
        return Domain(conditions=defined, surface=(difference,))
    kind = "nonzero" if isinstance(relation, sp.Ne) else "positive"
    return Domain(conditions=(*defined, Condition(kind, (difference,), str(relation), closed)))
