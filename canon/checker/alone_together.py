"""All small checkers of proofs, one after the other: `python alone_together.py CERTIFICATE.json …`"""

from __future__ import annotations

import json
import re
from typing import Any

if __package__:
    from canon.checker import (
        alone,
        alone_actions,
        alone_algebras,
        alone_averages,
        alone_complex,
        alone_constraints,
        alone_covers,
        alone_elliptic,
        alone_fields,
        alone_gauss,
        alone_generated,
        alone_groups,
        alone_integrals,
        alone_lie,
        alone_limits,
        alone_normal_forms,
        alone_parameters,
        alone_paths,
        alone_powers,
        alone_radicands,
        alone_regular,
        alone_related,
        alone_series,
        alone_signs,
        alone_tending,
        alone_units,
        alone_wider,
    )
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_actions  # type: ignore
    import alone_algebras  # type: ignore
    import alone_averages  # type: ignore
    import alone_complex  # type: ignore
    import alone_constraints  # type: ignore
    import alone_covers  # type: ignore
    import alone_elliptic  # type: ignore
    import alone_fields  # type: ignore
    import alone_gauss  # type: ignore
    import alone_generated  # type: ignore
    import alone_groups  # type: ignore
    import alone_integrals  # type: ignore
    import alone_lie  # type: ignore
    import alone_limits  # type: ignore
    import alone_normal_forms  # type: ignore
    import alone_parameters  # type: ignore
    import alone_paths  # type: ignore
    import alone_powers  # type: ignore
    import alone_radicands  # type: ignore
    import alone_regular  # type: ignore
    import alone_related  # type: ignore
    import alone_series  # type: ignore
    import alone_signs  # type: ignore
    import alone_tending  # type: ignore
    import alone_units  # type: ignore
    import alone_wider  # type: ignore

COMPLEX = re.compile(r"\bcomplex\b|(?<![^\W\d_])\d[jJ]\b")
BESIDES: dict[str, tuple[Any, ...]] = {
    "inequality": (alone_signs, alone_covers),
    "integral": (alone_integrals, alone_radicands, alone_gauss),
    "limit": (alone_limits, alone_tending),
    "average": (alone_averages,),
    "algebra": (alone_algebras, alone_parameters),
    "field_equations": (alone_fields,),
    "matrix_algebra": (alone_lie,),
    "canonical": (alone_generated,),
    "new_hamiltonian": (alone_generated,),
    "independent": (alone_regular,),
    "euler_lagrange": (alone_regular, alone_powers),
    "noether": (alone_powers,),
    "legendre": (alone_regular,),
    "solves": (alone_powers,),
    "constraint": (alone_constraints,),
    "stationary": (alone_paths,),
    "group": (alone_groups,),
    "lie_series": (alone_series,),
    "normal_form": (alone_normal_forms,),
    "dimension": (alone_units,),
    "action": (alone_actions, alone_elliptic),
    "frequency": (alone_actions, alone_elliptic),
}
"""Those that know a kind of claims, besides the table."""


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON: of the first that has a means, else of the last."""
    answer = alone_wider.checked(data)
    try:
        kind = data["tables"]["claim"]["kind"]
        besides = (*BESIDES.get(kind, ()), *((alone_related,) if kind in alone_related.KINDS else ()))
    except (KeyError, TypeError):  # what is no certificate
        return answer
    if answer[0] == "not shown" and COMPLEX.search(json.dumps(data["tables"])):
        besides = (*besides, alone_complex)
    for one in besides:
        answer = answer if answer[0] != "not shown" else one.checked(data)
    return answer


if __name__ == "__main__":
    alone.main(checked)
