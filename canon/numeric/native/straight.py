"""The pieces of an integrator as straight-line programs of scalars: what prepares, begins, makes a step, and ends.

One orbit's numbers are the inputs: of a batch, in which orbits go their own ways, the functions are traced for a batch
of one. What a carry holds of whole numbers and truth values (whether a multistep method has begun) is known while
tracing, and is to be the same after a step.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np

from canon.numeric.integrators.stepper import Stepper, Time
from canon.numeric.operations import count_operations
from canon.numeric.precision import double
from canon.numeric.scalar_arrays import Traced, Unscalar, Value, known
from canon.numeric.scalar_program import taken_apart
from canon.program import Builder, Program

MOST_OPERATIONS: Final = 13_000
"""Operations of a step and what brackets it: longer programs would take seconds to compile."""


@dataclass(frozen=True)
class Layout:
    """How a carry's numbers lie one after another: the `shapes` of its leaves that hold doubles, without the orbits'
    axis, and which leaves these are; the others are `statics`.
    """

    structure: Any
    floats: tuple[int, ...]
    shapes: tuple[tuple[int, ...], ...]
    leaves: int

    @cached_property
    def size(self) -> int:
        """Doubles of one orbit."""
        return sum(int(np.prod(shape)) for shape in self.shapes)


@dataclass(frozen=True)
class Straight:
    """Programs of one orbit, for carries with these whole numbers, the `statics`. `prepare` takes h to the tables; the
    others take (carry, tables, t0, h, k), `begin` and `step` to a carry, `end` to a carry and the state that is shown.

    `moves`: how often a number of the carry goes from place to place, at most, before it is left.
    """

    carry: Layout
    state: Layout
    tables: int
    prepare: Program
    statics: tuple[np.ndarray, ...]
    begin: Program
    step: Program
    end: Program
    moves: int

    @property
    def operations(self) -> int:
        """All that is to be compiled."""
        return sum(len(p.operations) for p in (self.prepare, self.begin, self.step, self.end))

    def fits(self, statics: Sequence[np.ndarray]) -> bool:
        """Whether the programs are for these whole numbers."""
        return _key(statics) == _key(self.statics)


def straight(stepper: Stepper, carry: Any, first: Sequence[np.ndarray] | None, batched: bool) -> Straight:
    """The stepper as straight programs, for carries of this form; `first`: the whole numbers of a carry that has begun,
    where it has any.

    **Raises:** `Unscalar` where it depends on more than that: loops whose length depends on the state, functions that
    are no elementary ones, more operations than are worth compiling; whatever jax raises where it cannot trace.
    """
    import jax

    with double():
        layout = layout_of(carry, batched)
        statics = [np.asarray(x) for k, x in enumerate(jax.tree.leaves(carry)) if k not in layout.floats]
        one = _orbits(carry, layout, 1 if batched else None)
        tables = jax.eval_shape(stepper.prepare, 0.01)
        table_layout = layout_of(tables, False)
        if table_layout.leaves != len(table_layout.floats):
            raise Unscalar("tables of whole numbers")
        moment = jax.ShapeDtypeStruct((), np.float64)

        def traced(function: Callable[[Any, Any, Time], Any], form: Any = one) -> Any:
            whole = lambda c, made, t0, h, k: function(c, made, Time(t0, h, k))
            try:
                return jax.make_jaxpr(whole, return_shape=True)(form, tables, moment, moment, moment)
            except Exception as reason:  # a problem that isn't for so many orbits may raise anything
                raise Unscalar(f"{type(reason).__name__}: {reason}") from reason

        step, shape = traced(stepper.step)
        if count_operations(step.jaxpr) > MOST_OPERATIONS:
            raise Unscalar(f"more than {MOST_OPERATIONS} operations")
        _same_form(shape, one)
        begin, shape = traced(stepper.begin)
        _same_form(shape, one)
        end, (shape, shown) = traced(lambda *a: (lambda made: (made, stepper.read(made)))(stepper.end(*a)))
        _same_form(shape, one)
        state = layout_of(shown, batched)
        if state.leaves != len(state.floats):
            raise Unscalar("a state of whole numbers")
        parts = _Parts(layout, table_layout)
        whole = statics if first is None else [*first]
        made = [parts.program(each, whole) for each in (begin, step, end)]
        if first is not None and not _is_identity(made[0]):
            raise Unscalar("a method that begins in two ways")
        if batched:
            _check_alone(parts, traced(stepper.step, _orbits(carry, layout, 2))[0], whole)
        prepare = _prepared(stepper)
    found = Straight(
        layout, state, table_layout.size, prepare, tuple(whole), made[0], made[1], made[2], _moves(made[1])
    )
    if found.operations > MOST_OPERATIONS:
        raise Unscalar(f"more than {MOST_OPERATIONS} operations")
    return found


def layout_of(tree: Any, batched: bool) -> Layout:
    """**Raises:** `Unscalar` where numbers are of another type than float64, or a batch's have no axis of orbits."""
    import jax

    leaves, structure = jax.tree.flatten(tree)
    floats, shapes = [], []
    for k, leaf in enumerate(leaves):
        kind, shape = np.dtype(getattr(leaf, "dtype", type(leaf))), np.shape(leaf)
        if kind == np.float64:
            if batched and not shape:
                raise Unscalar("a number that all orbits share")
            floats.append(k)
            shapes.append(shape[:-1] if batched else shape)
        elif kind.kind not in "iub" or shape:
            raise Unscalar(f"numbers of type {kind}")
    return Layout(structure, tuple(floats), tuple(shapes), len(leaves))


def _orbits(carry: Any, layout: Layout, count: int | None) -> Any:
    """The form of a carry, with so many orbits, or None for one without their axis."""
    import jax

    leaves = [np.asarray(x) for x in jax.tree.leaves(carry)]
    forms = [jax.ShapeDtypeStruct(x.shape, x.dtype) for x in leaves]
    for k, shape in zip(layout.floats, layout.shapes, strict=True):
        forms[k] = jax.ShapeDtypeStruct(shape if count is None else (*shape, count), np.float64)
    return jax.tree.unflatten(layout.structure, forms)


def _same_form(found: Any, wanted: Any) -> None:
    import jax

    forms = [[(x.shape, np.dtype(x.dtype)) for x in jax.tree.leaves(tree)] for tree in (found, wanted)]
    if forms[0] != forms[1] or jax.tree.structure(found) != jax.tree.structure(wanted):
        raise Unscalar("a carry that changes its form, or numbers of single orbits in the problem")


def _check_alone(parts: _Parts, step: Any, statics: Sequence[np.ndarray]) -> None:
    """Of two orbits, traced together, the first must not depend on the second. **Raises:** `Unscalar` if it does."""
    program = parts.program(step, statics)
    own = program.select(program.outputs[::2])
    if any(o.name == "input" and int(o.datum) < parts.doubles(step) and int(o.datum) % 2 for o in own.operations):
        raise Unscalar("an orbit that depends on another")


class _Parts:
    """Programs of (carry, tables, t0, h, k), with what the carry holds of whole numbers known."""

    def __init__(self, carry: Layout, tables: Layout) -> None:
        self.carry, self.tables = carry, tables

    def doubles(self, closed: Any) -> int:
        """The numbers of the carry that a jaxpr takes."""
        return sum(int(np.prod(closed.jaxpr.invars[k].aval.shape)) for k in self.carry.floats)

    def program(self, closed: Any, statics: Sequence[np.ndarray]) -> Program:
        """The program of a jaxpr, which leaves the whole numbers in the carry as they are."""
        inputs = self.doubles(closed) + self.tables.size + 3
        builder = Builder(inputs, 20 * MOST_OPERATIONS)
        position = iter(range(inputs))
        forms = [v.aval for v in closed.jaxpr.invars]
        others = iter(statics)
        values: list[Value] = []
        for k, form in enumerate(forms):
            if k < self.carry.leaves and k not in self.carry.floats:
                values.append(known(next(others)))
                continue
            nodes = [builder.input(next(position)) for _ in range(int(np.prod(form.shape)))]
            values.append(Traced(np.array(nodes, dtype=int).reshape(form.shape)))
        found = taken_apart(builder, closed, values, whole=True)
        after, nodes = list[np.ndarray](), list[int]()
        for k, value in enumerate(found):
            if k >= self.carry.leaves or k in self.carry.floats:
                nodes += [int(node) for node in value.nodes.ravel()]
            elif isinstance(value, Traced):
                raise Unscalar("a whole number that depends on the state")
            else:
                after.append(value)
        if _key(after) != _key(statics):
            raise Unscalar("whole numbers that change from step to step")
        return builder.program(tuple(nodes))


def _prepared(stepper: Stepper) -> Program:
    import jax

    closed = jax.make_jaxpr(stepper.prepare)(jax.ShapeDtypeStruct((), np.float64))
    builder = Builder(1, 20 * MOST_OPERATIONS)
    found = taken_apart(builder, closed, [Traced(np.array(builder.input(0)))])
    return builder.program(tuple(int(node) for x in found for node in x.nodes.ravel()))


def _is_identity(program: Program) -> bool:
    operations = [program.operations[node] for node in program.outputs]
    return all(o.name == "input" and o.datum == k for k, o in enumerate(operations))


def _moves(program: Program) -> int:
    """The places that a number goes through in a carry, one a step, before it is left: a history's length less one."""
    outputs = [program.operations[node] for node in program.outputs]
    source = {k: int(o.datum) for k, o in enumerate(outputs) if o.name == "input" and o.datum != k}
    longest = 0
    for place in source:
        count, at = 0, place
        while at in source and count < len(source):
            count, at = count + 1, source[at]
        longest = max(longest, count)
    return longest


def _key(statics: Sequence[np.ndarray]) -> tuple[tuple[str, bytes], ...]:
    return tuple((np.asarray(x).dtype.str, np.asarray(x).tobytes()) for x in statics)
