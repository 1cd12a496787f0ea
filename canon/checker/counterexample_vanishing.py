"""Refutations of what must not vanish everywhere and does, beside `counterexample.py`: by `alone.py`'s random
points.

A mixed Hessian, the Hessian of a Lagrangian, the determinant of a complete integral, the minors of gradients: where
these are 0 modulo random primes they are 0 wherever the formulas have values. That there is such a place is seen in
intervals.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from itertools import combinations
from typing import Any

if __package__:
    from canon.checker import alone, alone_table
    from canon.checker.alone import TYPES, Claim, Stop
    from canon.checker.alone_wider import Placed, Wider
    from canon.checker.counterexample import Arithmetic, Open, check_domain
    from canon.checker.counterexample_functions import Place
    from canon.checker.counterexample_kinds import guesses
    from canon.checker.counterexample_maps import Asked, determinant, plain
else:  # as a program's part, beside the other files
    import alone  # type: ignore
    import alone_table  # type: ignore
    from alone import TYPES, Claim, Stop  # type: ignore
    from alone_wider import Placed, Wider  # type: ignore
    from counterexample import Arithmetic, Open, check_domain  # type: ignore
    from counterexample_functions import Place  # type: ignore
    from counterexample_kinds import guesses  # type: ignore
    from counterexample_maps import Asked, determinant, plain  # type: ignore

MOST_MINORS = 60


def vanish(claim: Any, texts: list[str]) -> bool:
    """Whether formulas are 0 wherever they have values, as `alone.checked` sees it of a proof's."""
    claim.zeros, claim.besides = texts, []
    claim.texts = {key: x for key, x in claim.texts.items() if key != "_scale"}
    one = {"numerator": {}, "denominator": {"": "1"}, "cofactors": {}}
    done, tried, needed = 0, 0, alone.TRIALS
    kind = Placed if isinstance(claim, Wider) else alone.Point
    while done < needed:
        tried += 1
        if tried > alone.MOST_TRIED + 20 * done or needed > alone.TRIALS << alone.MOST_ROOTS:
            raise Stop("not shown", "points at which everything is positive that has to be, or so many roots")
        with suppress(alone.Elsewhere):
            case = {"kernels": [], "residuals": [one] * len(texts)}
            besides = Placed.check if isinstance(claim, Wider) else None
            roots = alone.sample(claim, case, alone.random_prime(), kind, besides)
            needed = max(needed, alone.TRIALS << roots)
            done += 1
    return True


def of_generating(tables: Any) -> Iterator[tuple[Any, list[str]]]:
    """The mixed Hessian of a generating function, of a map that has no other formulas."""
    space, generating = tables["phase_space"], tables["generating_function"]
    n, types = len(space["q"]), generating["type"]
    kinds = [types] * n if isinstance(types, int) else types
    if "transformation" in tables or [len(space[side]) for side in "qpQP"] != [n] * 4 or len(kinds) != n:
        raise Stop("not shown", "a map of that form")
    claim = Claim(plain(tables))
    claim.texts["_F"] = generating["F"]
    free = [[space[side][i] for i, one in enumerate(kinds) for side in TYPES[one][k]] for k in (0, 1)]
    yield claim, [determinant([[f"D(D(_F, {u}), {v})" for v in free[1]] for u in free[0]])]


def of_functions(tables: Any) -> Iterator[tuple[Any, list[str]]]:
    """The minors of the gradients, by coordinates, momenta and time."""
    if {*tables} & {"transformation", "generating_function"} or {*tables["claim"]} - {"kind", "functions"}:
        raise Stop("not shown", "functions beside a map, or of a bracket of their own")
    functions = tables["claim"]["functions"]
    claim = Claim(plain(drop_complex(tables, functions)))
    claim.texts |= {f"_f{k}": text for k, text in enumerate(functions)}
    names, m = claim.names, len(functions)
    if m > 5 or m < 2:
        raise Stop("not shown", "so many functions")
    minors = [determinant([[f"D(_f{k}, {x})" for x in some] for k in range(m)]) for some in combinations(names, m)]
    if len(minors) > MOST_MINORS:
        raise Stop("not shown", "so many minors")
    yield claim, minors or ["0"]


def drop_complex(tables: Any, functions: list[str]) -> Any:
    """Without definitions that none of these uses, directly or not."""
    words = " ".join(map(str, [*functions, tables.get("hamiltonian", {}).get("H", ""), tables.get("domain", "")]))
    kept: dict[str, Any] = {}
    for name, text in reversed(tables.get("definitions", {}).items()):
        if re.search(rf"(?<!\w){re.escape(name)}(?!\w)", words):
            kept, words = {name: text, **kept}, f"{words} {text}"
    return {**tables, "definitions": kept}


def of_table(tables: Any) -> Iterator[tuple[Any, list[str]]]:
    """What must not vanish by the table, of a Lagrangian or a complete integral."""
    usual = {key: x for key, x in tables.items() if key not in ("transformation", "generating_function")}
    form = dict(alone_table.form_of(usual))
    claim = Wider(usual, form)
    texts, claim.nonzero, claim.places = [*claim.nonzero], [], ()
    if not texts:
        raise Stop("not shown", "nothing that must not vanish")
    for text in texts:
        yield claim, [text]


RULES = {"legendre": of_table, "hamilton_jacobi": of_table, "euler_lagrange": of_table, "independent": of_functions,
    "canonical": of_generating, "fundamental_brackets": of_generating, "new_hamiltonian": of_generating}  # fmt: skip


def refuted(tables: Any, witness: Any, known: Any = None) -> tuple[str, str]:
    """Whether something vanishes everywhere that must not."""
    kind = tables["claim"]["kind"]
    if kind not in RULES or isinstance(witness, dict) or tables.get("domain", {}).get("on"):
        raise Stop("not shown", "a refutation of such a claim")
    for claim, texts in RULES[kind](tables):
        if is_somewhere(claim, texts, tables) and vanish(claim, texts):
            return "shown", ""
    return "not shown", "a point at which all has a value"


def is_somewhere(claim: Any, texts: list[str], tables: Any) -> bool:
    """Whether the domain has a point, at which everything has a value."""
    for of in guesses(Asked(claim, ()), None):
        point = Place(claim, of, Arithmetic(64))
        with suppress(Open):
            check_domain(point, {"hamiltonian": tables.get("hamiltonian", {})})
            for text in texts:
                point.text(text)
            return True
    return False
