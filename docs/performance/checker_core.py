"""Which certificates are confirmed by the checker's core alone, once their residuals are derived?

    canon verify --fresh --certificate proofs
    python docs/performance/checker_core.py proofs

A certificate of a proof counts as the core's where nothing is asked but that residuals are 0, or that a rational
function isn't 0 everywhere, and each residual is shown by an identity:

- rational: it has no functions, so that there are no kernels;
- kernels: each function in it is a kernel, with a relation of its own, or none.

A refutation by a witness counts as "in fractions" where the residual is rational and the point is, too: then a program
that puts fractions into formulas sees it, and no intervals are needed.

Of the others each is counted once, under the first of the things that it needs besides.
"""

import json
import sys
from collections import Counter
from pathlib import Path
from typing import Any

from canon.checker import core
from canon.checker.case import Case
from canon.checker.check import check
from canon.checker.fractions_alone import fails_exactly
from canon.checker.functions import Unknown, Unreadable
from canon.checker.kinds import obligations
from canon.checker.shapes import is_rational
from canon.checker.statement import Statement


def needs(data: Any) -> str:
    """What a confirmed certificate rests on besides the core, in a word; "rational" or "kernels" for nothing."""
    if data["verdict"] == "refuted" and data["witness"] is not None:
        s = Statement(data["tables"], data["known"], data["verdict"])
        exact = any(fails_exactly(s, case, data["witness"]) for case in obligations(s))
        return "a witness in fractions" if exact else "a witness in intervals"
    s = Statement(data["tables"], data["known"], data["verdict"])
    found = [_of_case(s, case, shown) for case, shown in zip(obligations(s), data["cases"], strict=True)]
    return max(found, key=lambda word: (word != "rational", word != "kernels"))


def _of_case(s: Statement, case: Case, data: Any) -> str:
    if case.independent or case.found is not None:
        return "linear algebra, or exact arithmetic of its kind"
    if case.positive:
        return "signs of terms"
    if not all(is_rational(s, a) for group in case.nonzeros for a in group):
        return "something that isn't 0, in intervals"
    if not all("cofactors" in entry for entry in data["residuals"]):
        return "a residual that is followed through its functions"
    if s.surface:
        return "a surface"
    kernels = {f"{k['name']}" for k in data["kernels"]}
    values = [tuple(map(core.read, value)) for value in data["atoms"].values()]
    if not kernels:
        return "rational"
    plain = all(under == core.ONE and len(over) == 1 and core.names(over) <= kernels for over, under in values)
    return (
        "kernels"
        if plain and all(sum(e for _, e in m) == 1 for over, _ in values for m in over)
        else "values of functions"
    )


def main() -> None:
    counts, confirmed = Counter[str](), 0
    for path in sorted(Path(sys.argv[1]).rglob("*.json")):
        data = json.loads(path.read_text(encoding="utf-8"))
        try:
            if check(data).status != "confirmed":
                continue
            counts[needs(data)] += 1
            confirmed += 1
        except (Unreadable, Unknown):
            continue
    print(f"{confirmed} confirmed")
    for word, count in counts.most_common():
        print(f"{count:6d}  {word}")


if __name__ == "__main__":
    main()
