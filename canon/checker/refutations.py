"""Refutations by small files, one after the other: `python refutations.py CERTIFICATE.json …`"""

from __future__ import annotations

import json
import re
from itertools import chain
from typing import Any

if __package__:
    from canon.checker import (
        alone,
        counterexample,
        counterexample_algebras,
        counterexample_angles,
        counterexample_closed_actions,
        counterexample_complex,
        counterexample_cycles,
        counterexample_endless,
        counterexample_fields,
        counterexample_groups,
        counterexample_hamilton_jacobi,
        counterexample_integrals,
        counterexample_kinds,
        counterexample_limits,
        counterexample_normal_forms,
        counterexample_open_paths,
        counterexample_orbits,
        counterexample_units,
        counterexample_vanishing,
        counterexample_variations,
    )
    from canon.checker.alone import Stop
    from canon.checker.counterexample import Open
else:  # as a program, beside the other files
    import alone  # type: ignore
    import counterexample  # type: ignore
    import counterexample_algebras  # type: ignore
    import counterexample_angles  # type: ignore
    import counterexample_closed_actions  # type: ignore
    import counterexample_complex  # type: ignore
    import counterexample_cycles  # type: ignore
    import counterexample_endless  # type: ignore
    import counterexample_fields  # type: ignore
    import counterexample_groups  # type: ignore
    import counterexample_hamilton_jacobi  # type: ignore
    import counterexample_integrals  # type: ignore
    import counterexample_kinds  # type: ignore
    import counterexample_limits  # type: ignore
    import counterexample_normal_forms  # type: ignore
    import counterexample_open_paths  # type: ignore
    import counterexample_orbits  # type: ignore
    import counterexample_units  # type: ignore
    import counterexample_vanishing  # type: ignore
    import counterexample_variations  # type: ignore
    from alone import Stop  # type: ignore
    from counterexample import Open  # type: ignore

FILES = (
    counterexample_hamilton_jacobi,
    counterexample_open_paths,
    counterexample_kinds,
    counterexample_integrals,
    counterexample_closed_actions,
    counterexample_orbits,
    counterexample_angles,
    counterexample_vanishing,
    counterexample_algebras,
    counterexample_groups,
    counterexample_complex,
    counterexample_limits,
    counterexample_normal_forms,
    counterexample_endless,
    counterexample_cycles,
    counterexample_fields,
    counterexample_variations,
    counterexample_units,
)


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate that was read as JSON: that of `counterexample`, or where it has none, of the
    others."""
    answer = counterexample.checked(data)
    if answer[0] != "not shown" or not isinstance(data, dict) or data.get("verdict") != "refuted":
        return answer
    try:
        tables, witness = renamed(said(data["tables"]), data.get("witness"))
    except Exception as error:  # whatever a certificate has in the wrong place
        return "not shown", f"a certificate of another form ({type(error).__name__}: {error})"
    for file in FILES:
        try:
            found = file.refuted(tables, witness, data.get("known") or {})
        except Stop as stop:
            found = stop.args
        except Open as left:
            found = "not shown", str(left)
        except Exception as error:  # whatever a certificate has in the wrong place
            found = "not shown", f"a certificate of another form ({type(error).__name__}: {error})"
        if found[0] == "shown":
            return "shown", ""
        answer = found if found[1] and "such a claim" not in found[1] else answer
    return "not shown", answer[1]


def said(tables: Any) -> Any:
    """The tables without what is for people, and without what the file expects."""
    unsaid = ("title", "source", "expect", "budget")
    claim = {key: x for key, x in tables["claim"].items() if key not in unsaid}
    return {key: x for key, x in tables.items() if key not in ("title", "source")} | {"claim": claim}


def renamed(tables: Any, witness: Any) -> tuple[Any, Any]:
    """A name D that isn't a function is called otherwise, as D is the derivative in the language."""
    space, text = tables.get("phase_space", {}), json.dumps(tables)
    names = {*tables.get("symbols", {}), *tables.get("definitions", {}), *chain(*(space.get(x, ()) for x in "qpQP"))}
    new = next(f"D{k}" for k in range(2, 1000) if f"D{k}" not in text)
    if "D" not in names or re.search(r"(?<!\w)D *\(", text):
        return tables, witness
    swap = lambda x: json.loads(re.sub(r"(?<!\w)D(?!\w)", new, json.dumps(x)))
    return swap(tables), swap(witness)


if __name__ == "__main__":
    alone.main(checked)
