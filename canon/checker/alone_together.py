"""All small checkers of proofs, one after the other: `python alone_together.py CERTIFICATE.json …`"""

from __future__ import annotations

import json
import re
from typing import Any

if __package__:
    from canon.checker import (
        alone,
        alone_algebras,
        alone_complex,
        alone_fields,
        alone_generated,
        alone_integrals,
        alone_lie,
        alone_limits,
        alone_parameters,
        alone_related,
        alone_signs,
        alone_wider,
    )
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_algebras  # type: ignore
    import alone_complex  # type: ignore
    import alone_fields  # type: ignore
    import alone_generated  # type: ignore
    import alone_integrals  # type: ignore
    import alone_lie  # type: ignore
    import alone_limits  # type: ignore
    import alone_parameters  # type: ignore
    import alone_related  # type: ignore
    import alone_signs  # type: ignore
    import alone_wider  # type: ignore

COMPLEX = re.compile(r"\bcomplex\b|(?<![^\W\d_])\d[jJ]\b")
BESIDES: dict[str, tuple[Any, ...]] = {
    "inequality": (alone_signs,),
    "integral": (alone_integrals,),
    "limit": (alone_limits,),
    "algebra": (alone_algebras, alone_parameters),
    "field_equations": (alone_fields,),
    "matrix_algebra": (alone_lie,),
    "canonical": (alone_generated,),
    "new_hamiltonian": (alone_generated,),
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
