"""The loop over blocks of orbits, over chunks of steps and over steps, around the programs of a step.

A carry is loaded at the beginning of a chunk, stays in registers (as far as they suffice) for its steps, and is stored
at its end.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from canon.numeric.native.emit import Known, Writer, hexadecimal, written
from canon.numeric.native.rewrite import rewritten
from canon.numeric.native.straight import Straight
from canon.program import Program

ENTRY: Final = "canon_run"
PREPARE: Final = "canon_prepare"
_ARGUMENTS: Final = (
    "ptr noalias %carry, ptr noalias %rows, ptr noalias readonly %tables, ptr noalias %alive, i64 %first, i64 %last, "
    "i64 %per_sample, i64 %per_chunk, double %h, double %t0, i64 %stride, i64 %begin, i64 %end"
)
_INFINITY: Final = hexadecimal(float("inf"))


def source_text(programs: Straight, *, width: int, blocks: int, fused: bool) -> str:
    """The module of LLVM that prepares the tables and makes the runs, of `blocks` times `width` orbits at once."""
    loop = _Loop(programs, Writer(width, blocks), fused)
    loop.whole()
    plain = Writer(1, 1)
    plain.lines.append(f"define void @{PREPARE}(ptr noalias %out, double %h) {{")
    results = written(plain, rewritten(programs.prepare, fused=fused), lambda k: Known(("%h",), True))
    for k, result in enumerate(results):
        place = plain.put(f"getelementptr double, ptr %out, i64 {k}")
        plain.do(f"store double {result.names[0]}, ptr {place}")
    plain.do("ret void")
    plain.lines.append("}")
    declared = {**loop.writer.declared, **plain.declared}
    return "\n".join([*declared.values(), *loop.writer.lines, *plain.lines, "!0 = !{}", ""])


class _Loop:
    """The function that runs: (carry, rows, tables, alive, …) to the number of chunks that are done.

    `carry` is (numbers, stride) with the orbits' axis last, `rows` (samples, numbers of the state, stride); blocks from
    `begin` to `end` are run. One orbit's run ends with the chunk after which it is not finite; of many, `alive` says of
    each chunk whether any is finite after it.
    """

    def __init__(self, programs: Straight, writer: Writer, fused: bool) -> None:
        self.programs, self.writer, self.fused = programs, writer, fused
        self.size = programs.carry.size
        self.single = writer.width == 1

    def whole(self) -> None:
        w = self.writer
        w.lines.append(f"define i64 @{ENTRY}({_ARGUMENTS}) {{")
        w.label("entry")
        for k in range(self.size):
            for b in range(w.blocks):
                w.do(f"%c{k}_{b} = alloca {w.kind}")
        w.do("br label %block_head")
        w.label("block_head")
        w.do("%block = phi i64 [ %begin, %entry ], [ %block_next, %block_done ]")
        w.do("%block_over = icmp sge i64 %block, %end")
        w.do("br i1 %block_over, label %finished, label %chunk_enter")
        w.label("finished")
        w.do("ret i64 %last")
        w.label("block_done")
        w.do("%block_next = add i64 %block, 1")
        w.do("br label %block_head")
        w.label("chunk_enter")
        w.do(f"%orbit = mul i64 %block, {w.width * w.blocks}")
        w.do("br label %chunk_head")
        w.label("chunk_head")
        w.do("%done = phi i64 [ %first, %chunk_enter ], [ %done_next, %good ]")
        w.do("%over = icmp sge i64 %done, %last")
        w.do("br i1 %over, label %block_done, label %chunk")
        w.label("chunk")
        w.do("%k0 = mul i64 %done, %per_chunk")
        w.do("%stop = add i64 %k0, %per_chunk")
        w.do("%done_next = add i64 %done, 1")
        w.do("%sample = sdiv i64 %done, %per_sample")
        w.do("%sample0 = sdiv i64 %first, %per_sample")
        w.do("%row = sub i64 %sample, %sample0")
        for k in range(self.size):
            for b in range(w.blocks):
                value = w.put(f"load {w.kind}, ptr {self.address('%carry', str(k), b)}, align 8")
                w.do(f"store {w.kind} {value}, ptr %c{k}_{b}")
        if self.programs.begin.operations:
            self.moved(self.programs.begin, "%k0")
        self.steps()
        results = self.program(self.programs.end, "%stop")
        carried, shown = results[: self.size], results[self.size :]
        self.judged(shown)
        w.label("good")
        self.stored("%carry", "0", carried)
        base = w.put(f"mul i64 %row, {len(shown)}")
        self.stored("%rows", base, shown)
        w.do("br label %chunk_head")
        w.lines.append("}")

    def steps(self) -> None:
        """The steps of a chunk. Where a carry holds a history, so many at once that each number of it is back in its
        place: then none has to be moved from register to register.
        """
        w, together = self.writer, self.programs.moves + 1
        w.do("br label %turn_head")
        w.label("turn_head")
        w.do("%k = phi i64 [ %k0, %chunk ], [ %k_after, %turn ]")
        w.do(f"%k_after = add i64 %k, {together}")
        w.do("%turn_over = icmp sgt i64 %k_after, %stop")
        w.do(f"br i1 %turn_over, label %{'rest_head' if together > 1 else 'steps_done'}, label %turn")
        w.label("turn")
        for number in range(together):
            self.moved(self.programs.step, w.put(f"add i64 %k, {number}"))
        w.do("br label %turn_head")
        if together > 1:
            w.label("rest_head")
            w.do("%k_rest = phi i64 [ %k, %turn_head ], [ %k_next, %rest ]")
            w.do("%rest_over = icmp sge i64 %k_rest, %stop")
            w.do("br i1 %rest_over, label %steps_done, label %rest")
            w.label("rest")
            self.moved(self.programs.step, "%k_rest")
            w.do("%k_next = add i64 %k_rest, 1")
            w.do("br label %rest_head")
        w.label("steps_done")

    def judged(self, shown: Sequence[Known]) -> None:
        """Whether the state is finite: one orbit's run ends where it isn't, and of many it is noted where any is."""
        w = self.writer
        anyone = []
        for b in range(w.blocks):
            fine = None
            for value in shown:
                size = w.intrinsic("fabs", [value.names[b]], False)
                finite = w.put(f"fcmp olt {w.kind} {size}, {w.spread(_INFINITY)}")
                fine = finite if fine is None else w.put(f"and {w.truth} {fine}, {finite}")
            anyone.append(fine)
        if self.single:
            w.do(f"br i1 {anyone[0]}, label %good, label %bad")
            w.label("bad")
            w.do("ret i64 %done")
            return
        for fine in anyone:
            bits = w.put(f"bitcast {w.truth} {fine} to i{w.width}")
            some = w.put(f"icmp ne i{w.width} {bits}, 0")
            flag = w.put(f"zext i1 {some} to i8")
            index = w.put("sub i64 %done, %first")
            place = w.put(f"getelementptr i8, ptr %alive, i64 {index}")
            before = w.put(f"load i8, ptr {place}")
            w.do(f"store i8 {w.put(f'or i8 {before}, {flag}')}, ptr {place}")
        w.do("br label %good")

    def moved(self, program: Program, k: str) -> None:
        """A program from the carry to the carry."""
        for number, result in enumerate(self.program(program, k)):
            for b, name in enumerate(result.names):
                self.writer.do(f"store {self.writer.kind} {name}, ptr %c{number}_{b}")

    def program(self, program: Program, k: str) -> list[Known]:
        w, tables = self.writer, self.programs.tables

        def source(position: int) -> Known:
            if position < self.size:
                return Known(tuple(w.put(f"load {w.kind}, ptr %c{position}_{b}") for b in range(w.blocks)), False)
            if position < self.size + tables:
                place = w.put(f"getelementptr double, ptr %tables, i64 {position - self.size}")
                return Known((w.put(f"load double, ptr {place}, !invariant.load !0"),), True)
            if position == self.size + tables + 2:
                return Known((w.put(f"sitofp i64 {k} to double"),), True)
            return Known(("%t0" if position == self.size + tables else "%h",), True)

        return written(w, rewritten(program, fused=self.fused), source)

    def stored(self, array: str, first: str, values: Sequence[Known]) -> None:
        for number, value in enumerate(values):
            row = str(number) if first == "0" else self.writer.put(f"add i64 {first}, {number}")
            for b, name in enumerate(value.names):
                place = self.address(array, row, b)
                self.writer.do(f"store {self.writer.kind} {name}, ptr {place}, align 8")

    def address(self, array: str, row: str, block: int) -> str:
        w = self.writer
        along = w.put(f"mul i64 {row}, %stride")
        along = w.put(f"add i64 {along}, %orbit")
        along = w.put(f"add i64 {along}, {block * w.width}")
        return w.put(f"getelementptr double, ptr {array}, i64 {along}")
