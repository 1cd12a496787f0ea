"""Relations of kernels that are proved: read off what a kernel stands for, not looked at in numbers.

- A root, k = R^(1/n): k^n − R; or k^m − R^(m/n), where that is a kernel.
- A sine beside the cosine of the same argument: s² + c² − 1. Hyperbolic ones: c² − s² − 1, in either order.
- An absolute value of something real: k² − A².
- Jacobi's functions of the same arguments: cn² + sn² − 1, and dn² + m sn² − 1.

A kernel that is a number (no name in it) has its relation checked in fifty digits, which is enough for it.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from canon.checker import core
from canon.checker.formulas import Formulas
from canon.checker.functions import Rejected

CIRCLES = {("sin", "cos"): 1, ("cos", "sin"): 1, ("jacobi_sn", "jacobi_cn"): 1, ("jacobi_cn", "jacobi_sn"): 1}


def is_proved(f: Formulas, name: str, relation: core.Polynomial, kernels: Mapping[str, int], *, real: bool) -> bool:
    """Whether the relation of a kernel follows from what it stands for; False where no rule of the table says so."""
    target = kernels[name]
    op = f.ops[target]
    if _is_number(f, target, kernels):
        return True
    if op[0] != "f":
        return False
    square = _without(relation, name, 2)
    if op[1] == "power":
        exponent = f.value(op[3][1])
        if exponent is None or exponent.numerator != 1:
            return False
        for other, node in kernels.items():  # R^(1/4) squared is R^(1/2)
            same = f.ops[node][0] == "f" and f.ops[node][1] == "power" and f.ops[node][3][0] == op[3][0]
            times = (f.value(f.ops[node][3][1]) or 0) / exponent if same else Fraction(1)
            if times > 1 and relation == {((name, int(times)),): Fraction(1), ((other, 1),): Fraction(-1)}:
                return times.denominator == 1
        rest = _without(relation, name, exponent.denominator)
        return rest is not None and _is_value(f, op[3][0], _negative(rest), kernels)
    if square is None:
        return False
    if op[1] == "abs":
        return real and _is_value(f, f.power(op[3][0], f.number(2)), _negative(square), kernels)
    for other, node in kernels.items():
        word = f.ops[node]
        if word[0] == "f" and word[3] == op[3] and other != name:
            z: core.Polynomial = {((other, 2),): Fraction(1)}
            if (op[1], word[1]) in CIRCLES and square == core.combined(z, core.ONE, {(): Fraction(-1)}):
                return True
            if (op[1], word[1]) == ("jacobi_dn", "jacobi_sn"):
                bent = core.combined(square, core.ONE, {(): Fraction(1)})
                return _is_value(f, f.mul(op[3][1], f.power(f.node("s", other), f.number(2))), bent, kernels)
            if (op[1], word[1]) == ("sinh", "cosh"):
                return square == core.combined(_negative(z), core.ONE, core.ONE)
            if (op[1], word[1]) == ("cosh", "sinh"):
                return square == core.combined(_negative(z), core.ONE, {(): Fraction(-1)})
    return False


def _negative(p: core.Polynomial) -> core.Polynomial:
    return {m: -c for m, c in p.items()}


def _without(relation: core.Polynomial, name: str, power: int) -> core.Polynomial | None:
    """The relation less name^power; None where it is not of this form, with nothing else of the name in it."""
    rest = {m: c for m, c in relation.items() if m != ((name, power),)}
    single = relation.get(((name, power),)) == 1 and name not in core.names(rest)
    return rest if single else None


def _is_value(f: Formulas, target: int, value: core.Polynomial, kernels: Mapping[str, int]) -> bool:
    """Whether a formula of names and kernels, or of functions that are kernels, is this polynomial."""
    own = {node: name for name, node in kernels.items()}
    steps, leaves = f.rational([target])
    found = {}
    for leaf in leaves:
        name = own.get(leaf) or (f.ops[leaf][1] if f.ops[leaf][0] == "s" else None)
        if name is None:
            return False
        found[leaf] = ({((name, 1),): Fraction(1)}, core.ONE)
    program = core.Program(target, [(b, f.ops[b], f.parts(b)) for b in steps], found)
    try:
        core.compared(program, value, core.ONE)
    except Rejected:
        return False
    return True


def _is_number(f: Formulas, target: int, kernels: Mapping[str, int]) -> bool:
    """Whether no name stands in a formula, kernels followed."""
    names = {f.ops[a][1] for a in f.reach(target) if f.ops[a][0] == "s"} - {"pi", "1j"}
    calls = any(f.ops[a][0] == "f" and f.ops[a][1] in f.functions for a in f.reach(target))
    return not calls and all(name in kernels and _is_number(f, kernels[name], kernels) for name in names)
