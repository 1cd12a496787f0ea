"""Functions of 0, and of 1, as numbers."""

from __future__ import annotations

from canon.checker.statement import Statement

AT_ZERO = {"exp": 1, "cos": 1, "cosh": 1, "sin": 0, "sinh": 0, "tan": 0, "tanh": 0, "asin": 0, "asinh": 0, "atan": 0}


def evaluated(s: Statement, target: int) -> int:
    """The formula with functions of 0, logarithms of 1 and powers of 1 as numbers."""
    f, new = s.f, dict[int, int]()
    for a in f.reach(target):
        op, parts = f.ops[a], [new[b] for b in f.parts(a)]
        new[a] = f.rebuilt(a, parts)
        if op[0] == "f" and f.value(parts[0]) is not None:
            if f.value(parts[0]) == 0 and op[1] in AT_ZERO:
                new[a] = f.number(AT_ZERO[op[1]])
            elif f.value(parts[0]) == 1 and op[1] in ("log", "power"):
                new[a] = f.number(int(op[1] == "power"))
    return new[target]
