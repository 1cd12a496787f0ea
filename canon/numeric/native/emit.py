"""Straight-line programs as instructions of LLVM, for one orbit or for several in the lanes of registers.

What depends on no orbit (the time, the lengths of substeps) is computed once, as scalars. Several `blocks` of orbits
are interleaved operation by operation: while one waits for a result, another computes.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Final

from canon.numeric.native.rewrite import number
from canon.numeric.scalar_arrays import Unscalar
from canon.program import Operation, Program

_ARITHMETIC: Final = {"add": "fadd", "sub": "fsub", "mul": "fmul", "div": "fdiv"}
_COMPARISONS: Final = {"less": "olt", "less_equal": "ole", "equal": "oeq"}
_LOGIC: Final = {"and": "and", "or": "or"}
_INTRINSICS: Final = {
    "sqrt": "sqrt",
    "abs": "fabs",
    "floor": "floor",
    "ceil": "ceil",
    "round": "roundeven",
    "max": "maximum",
    "min": "minimum",
}
_LIBRARY: Final = {
    **{name: name for name in ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "atan2")},
    **{name: name for name in ("asinh", "acosh", "atanh", "exp", "expm1", "log", "log1p", "pow", "cbrt")},
    "rem": "fmod",
}
"""Functions of C's mathematical library, for scalars."""


@dataclass(frozen=True)
class Known:
    """A value: its name, whether every orbit has the same, and the names of each block's where they have not."""

    names: tuple[str, ...]
    uniform: bool


@dataclass
class Writer:
    """Instructions that are being written, for `blocks` of `width` orbits each."""

    width: int
    blocks: int
    lines: list[str] = field(default_factory=list)
    declared: dict[str, str] = field(default_factory=dict)
    count: int = 0

    @property
    def kind(self) -> str:
        return "double" if self.width == 1 else f"<{self.width} x double>"

    @property
    def truth(self) -> str:
        return "i1" if self.width == 1 else f"<{self.width} x i1>"

    def put(self, text: str) -> str:
        """An instruction with a result."""
        self.count += 1
        self.lines.append(f"  %v{self.count} = {text}")
        return f"%v{self.count}"

    def do(self, text: str) -> None:
        """An instruction without one."""
        self.lines.append(f"  {text}")

    def label(self, name: str) -> None:
        self.lines.append(f"{name}:")

    def declare(self, name: str, result: str, arguments: Sequence[str]) -> None:
        self.declared[name] = f"declare {result} @{name}({', '.join(arguments)})"

    def spread(self, scalar: str) -> str:
        """A scalar in all lanes."""
        if self.width == 1:
            return scalar
        if not scalar.startswith("%"):
            return f"splat (double {scalar})"
        one = self.put(f"insertelement {self.kind} poison, double {scalar}, i64 0")
        zeros = f"<{self.width} x i32> zeroinitializer"
        return self.put(f"shufflevector {self.kind} {one}, {self.kind} poison, {zeros}")

    def intrinsic(self, name: str, operands: Sequence[str], uniform: bool) -> str:
        kind = "double" if uniform else self.kind
        suffix = "f64" if uniform or self.width == 1 else f"v{self.width}f64"
        full = f"llvm.{name}.{suffix}"
        self.declare(full, kind, [kind] * len(operands))
        return self.put(f"call {kind} @{full}({', '.join(f'{kind} {x}' for x in operands)})")


def hexadecimal(value: float) -> str:
    """A double as LLVM reads it, bit for bit."""
    return f"0x{struct.unpack('>Q', struct.pack('>d', value))[0]:016X}"


def written(writer: Writer, program: Program, source: Callable[[int], Known]) -> list[Known]:
    """Write a program's operations; its outputs' values. `source` gives the value of an input.

    **Raises:** `Unscalar` for a function that has no instruction, of several orbits at once.
    """
    values: list[Known] = []
    spreads: dict[int, str] = {}

    def lanes(node: int, block: int) -> str:
        known = values[node]
        if not known.uniform:
            return known.names[block]
        if node not in spreads:
            spreads[node] = writer.spread(known.names[0])
        return spreads[node]

    for operation in program.operations:
        if operation.name == "input":
            values.append(source(int(operation.datum)))
        elif operation.name == "number":
            values.append(Known((hexadecimal(number(operation.datum)),), True))
        elif all(values[k].uniform for k in operation.operands):
            values.append(
                Known((_one(writer, operation, [values[k].names[0] for k in operation.operands], True),), True)
            )
        else:
            # all that is spread first: so it comes once, before what uses it
            rows = [[lanes(k, block) for k in operation.operands] for block in range(writer.blocks)]
            values.append(Known(tuple(_one(writer, operation, row, False) for row in rows), False))
    outputs = []
    for node in program.outputs:
        outputs.append(Known(tuple(lanes(node, block) for block in range(writer.blocks)), False))
    return outputs


def _one(writer: Writer, operation: Operation, a: Sequence[str], uniform: bool) -> str:
    """One operation on scalars (`uniform`) or on the lanes of a block."""
    name = operation.name
    kind, truth = ("double", "i1") if uniform else (writer.kind, writer.truth)
    if name in _ARITHMETIC:
        return writer.put(f"{_ARITHMETIC[name]} {kind} {a[0]}, {a[1]}")
    if name == "neg":
        return writer.put(f"fneg {kind} {a[0]}")
    if name == "fma":
        return writer.intrinsic("fma", a, uniform)
    if name == "fms":
        return writer.intrinsic("fma", [a[0], a[1], writer.put(f"fneg {kind} {a[2]}")], uniform)
    if name == "fnma":
        return writer.intrinsic("fma", [writer.put(f"fneg {kind} {a[0]}"), a[1], a[2]], uniform)
    if name in _INTRINSICS:
        return writer.intrinsic(_INTRINSICS[name], a, uniform)
    if name in _COMPARISONS:
        return writer.put(f"fcmp {_COMPARISONS[name]} {kind} {a[0]}, {a[1]}")
    if name in _LOGIC:
        return writer.put(f"{_LOGIC[name]} {truth} {a[0]}, {a[1]}")
    if name == "not":
        ones = "true" if truth == "i1" else "splat (i1 true)"
        return writer.put(f"xor {truth} {a[0]}, {ones}")
    if name == "select":
        return writer.put(f"select {truth} {a[0]}, {kind} {a[1]}, {kind} {a[2]}")
    if name in _LIBRARY and (uniform or writer.width == 1):
        writer.declare(_LIBRARY[name], "double", ["double"] * len(a))
        return writer.put(f"call double @{_LIBRARY[name]}({', '.join(f'double {x}' for x in a)})")
    raise Unscalar(f"no instruction for {name} of many orbits")
