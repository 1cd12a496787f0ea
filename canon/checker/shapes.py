"""What a formula is seen to be by its operations: rational, or smooth."""

from __future__ import annotations

from collections.abc import Iterable

from canon.checker.signs import Signs
from canon.checker.statement import Statement

SMOOTH = ("sin", "cos", "exp", "sinh", "cosh", "tanh", "atan", "asinh")
"""Functions that are smooth at every real number."""
ENTIRE = ("sin", "cos", "exp", "sinh", "cosh")
"""Those that are smooth at every complex one, too: tanh has poles there, and atan and asinh have cuts."""


def is_rational(s: Statement, a: int, names: Iterable[str] | None = None) -> bool:
    """Whether a formula is a rational function (of these names alone): not 0 at a point, it isn't nearly everywhere."""
    ops = [s.f.ops[b] for b in s.f.reach(a)]
    own = None if names is None else {*names}
    return all(op[0] != "f" and (op[0] != "s" or own is None or op[1] in own) for op in ops)


def is_algebraic(s: Statement, a: int) -> bool:
    """Whether a formula is made of sums, products and roots."""
    ops = [s.f.ops[b] for b in s.f.reach(a)]
    return all(op[0] != "f" or (op[1] == "power" and s.f.value(op[3][1]) is not None) for op in ops)


def is_smooth(s: Statement, a: int, x: str, *, anywhere: bool = True) -> bool:
    """Whether a formula is seen to be smooth for all real values of a name: its operations have no pole or edge.

    Declared functions are smooth, where they are called, by what they are declared to be. What is divided by must have
    a sign, and so must what stands under a root: for every value of the name, of which nothing may be assumed; or not
    `anywhere`, but where the conditions hold.
    """
    f, moving = s.f, set[int]()
    real = not has_complex(s, a)
    smooth = (*SMOOTH, *f.functions) if real else ENTIRE
    assumed = s.words.get(x, ["real"]) not in (["real"], []) or any(
        f.ops[b] == ("s", x) for c, _ in s.conditions for b in f.reach(c)
    )
    for b in f.reach(a):
        op = f.ops[b]
        if op != ("s", x) and not moving & {*f.parts(b)}:
            continue
        moving.add(b)
        if op[0] in "s+*" or (op[0] == "^" and op[2] > 0) or (op[0] == "f" and op[1] in smooth):
            continue
        if (anywhere and assumed) or not real:
            return False
        inner = f.ops[op[3][0]] if op[0] == "f" and len(op[3]) == 1 else ("", "")
        if op[:2] == ("f", "tan") and inner[:2] in (("f", "asin"), ("f", "atan")):
            continue  # which are themselves asked to lie inside of a right angle
        if op[0] == "f" and op[1] in ("asin", "acos"):
            rest = f.sub(f.number(1), f.power(op[3][0], f.number(2)))
            if not Signs(s).is_positive(rest, strict=True):
                return False
            continue
        below = op[0] == "^" and _is_apart(s, op[1])
        root = op[0] == "f" and op[1] in ("power", "log") and Signs(s).is_positive(op[3][0], strict=True)
        if not (below or root):
            return False
    return True


def _is_apart(s: Statement, a: int) -> bool:
    """Whether a formula is seen to be 0 nowhere, factor by factor."""
    seen, stack = {a}, [a]
    while stack:
        a = stack.pop()
        op = s.f.ops[a]
        if op[0] not in "*^":
            if not Signs(s).is_nowhere_zero(a):
                return False
            continue
        new = {*s.f.parts(a)} - seen
        seen |= new
        stack.extend(new)
    return True


def has_complex(s: Statement, *targets: int) -> bool:
    """Whether the imaginary unit, or a name that may be complex, is in these formulas (in any, where none is given)."""
    names = {op[1] for op in (map(s.f.ops.__getitem__, s.f.reach(*targets)) if targets else s.f.ops) if op[0] == "s"}
    return "1j" in names or any("complex" in s.words.get(name, ()) for name in names)


def is_product_of_nonzeros(s: Statement, a: int) -> bool:
    """Whether a formula is a product of numbers and of names that aren't 0."""
    ops = [s.f.ops[b] for b in s.f.reach(a)]
    sure = {"positive", "negative", "nonzero"}
    return all(
        op[1] != 0
        if op[0] == "n"
        else op[1] in ("pi", "1j") or bool(sure & {*s.words.get(op[1], ())})
        if op[0] == "s"
        else op[0] in "*^"
        for op in ops
    )


def is_smooth_there(s: Statement, a: int) -> bool:
    """Whether a formula is seen to be smooth in the domain: what may fail in it stands in the claim's formulas too."""
    f, written = s.f, {*s.f.reach(*(s.pull(b) for b in (*s.written, *s.images.values())))}
    for b in f.reach(a):
        op = f.ops[b]
        inverted = op[0] == "^" and op[2] < 0 and not is_product_of_nonzeros(s, op[1])
        if inverted and not any(c[0] == "^" and c[2] < 0 and c[1] == op[1] for c in (f.ops[k] for k in written)):
            return False
        regular = ENTIRE if has_complex(s, a) else (*SMOOTH, *f.functions)
        smooth = op[0] != "f" or op[1] in regular or (op[1] in ("power", "log") and b in written)
        if not smooth:
            return False
    return True
