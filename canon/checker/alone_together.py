"""All small checkers of proofs, one after the other: `python alone_together.py CERTIFICATE.json …`"""

from __future__ import annotations

import json
import re
from importlib import import_module
from typing import Any

if __package__:
    from canon.checker import alone, alone_wider
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_wider  # type: ignore

COMPLEX = re.compile(r"\bcomplex\b|(?<![^\W\d_])\d[jJ]\b")
BESIDES = {
    "action": "actions elliptic separatrices power_wells",
    "action_angle": "angles forward tori",
    "algebra": "algebras parameters",
    "average": "averages",
    "bracket": "related",
    "bracket_invariance": "maps",
    "canonical": "generated maps",
    "canonical_when": "exceptions",
    "cartan_invariant": "maps",
    "casimir": "related",
    "conserved": "related",
    "constraint": "constraints",
    "dimension": "units",
    "equations_of_motion": "related",
    "euler_lagrange": "regular powers related",
    "field_equations": "fields",
    "frequency": "actions elliptic",
    "fundamental_brackets": "maps",
    "generates": "maps",
    "generating_function": "maps",
    "group": "groups",
    "hamilton_jacobi": "maps",
    "hamiltonian_field": "related",
    "identity": "related",
    "independent": "regular",
    "inequality": "signs covers",
    "infinitesimal": "related",
    "integral": "integrals radicands gauss",
    "integral_invariant": "maps",
    "invariant_interval": "related",
    "involution": "related",
    "jacobi": "related",
    "legendre": "regular",
    "lie_series": "series",
    "limit": "limits tending",
    "matrix_algebra": "lie",
    "matrix_group": "related",
    "new_hamiltonian": "generated maps transported",
    "noether": "powers",
    "normal_form": "normal_forms",
    "solves": "powers related",
    "stationary": "paths",
    "symmetry": "maps",
    "volume": "maps",
}
"""The files called alone_… that know a kind of claims, besides the table, in the order in which they are asked."""


def named(name: str) -> Any:
    """The file alone_… of this name, which is read when it is needed."""
    return import_module(f"canon.checker.alone_{name}" if __package__ else f"alone_{name}")


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON: of the first that has a means, else of the last."""
    answer = alone_wider.checked(data)
    try:
        besides = BESIDES.get(data["tables"]["claim"]["kind"], "").split()
    except (KeyError, TypeError):  # what is no certificate
        return answer
    if answer[0] == "not shown" and COMPLEX.search(json.dumps(data["tables"])):
        besides.append("complex")
    for name in besides:
        answer = answer if answer[0] != "not shown" else named(name).checked(data)
    return answer


if __name__ == "__main__":
    alone.main(checked)
