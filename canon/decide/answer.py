"""Answers of the ladder: what is known of one residual, and why."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from flint import acb

from canon.decide.derivative import substitute
from canon.decide.enclosure import Ball
from canon.decide.region import Requirement
from canon.decide.sample import Sample, evaluate_again
from canon.decide.tape import Node, Tape
from canon.verdict import Evidence


@dataclass(frozen=True)
class Witness:
    """A point of the region at which a residual's ball excludes 0 (certified, each condition included)."""

    coordinates: Mapping[str, Any]
    functions: Mapping[str, str]
    value: str
    size: float
    sample: Sample | None = field(default=None, compare=False, repr=False)

    @staticmethod
    def of(tape: Tape, sample: Sample, ball: Ball) -> Witness:
        """The witness at a certified sample."""
        coordinates: dict[str, Any] = {}
        for node, value in sorted(sample.point.items(), key=lambda item: str(tape.symbol_at(item[0]))):
            name = str(tape.symbol_at(node))
            coordinates[name] = {"re": str(value[0]), "im": str(value[1])} if isinstance(value, tuple) else str(value)
        for node, box in sample.solved.items():
            coordinates[str(tape.symbol_at(node))] = box.mid().str(30, radius=False)
        functions = {name: chosen.formula() for name, chosen in sample.functions.items()}
        return Witness(coordinates, functions, show_ball(ball), float(ball.abs_lower()), sample)

    def as_table(self) -> dict[str, Any]:
        """name = value, with the chosen functions by formula (a, or a1, a2, … their arguments)."""
        return {**self.coordinates, **self.functions}

    def value_of(self, tape: Tape, node: Node) -> Any:
        """Another node's value at the same point, as data: exact where it is rational, else decimals that are certain.

        None where the point doesn't determine it.
        """
        sample = self.sample
        if sample is None or not tape.support(node) <= {*sample.point, *sample.solved}:
            return None
        exact = {n: tape.number(v) for n, v in sample.point.items() if not isinstance(v, tuple)}
        value = tape.value(substitute(tape, node, exact))
        if value is not None:
            return str(value)
        ball = evaluate_again(tape, [node], sample, 128)[node]
        if isinstance(ball, acb):
            return {"re": ball.real.str(30, radius=False), "im": ball.imag.str(30, radius=False)}
        return ball.str(30, radius=False)


def show_ball(ball: Ball) -> str:
    """A ball's middle to the digits that are certain."""
    if isinstance(ball, acb):
        return f"{_digits(ball.real)} + {_digits(ball.imag)}*1j"
    return _digits(ball)


def _digits(ball: Any) -> str:
    text = ball.str(12, radius=False)
    return "0" if text.startswith("0e") else text  # a part of which no digit is certain


@dataclass(frozen=True)
class Answer:
    """What is known of one node: does it vanish on the region?

    `status` is "proved", "refuted", "supported" or "undecided"; `conditions` are the side conditions that the
    argument used; `log2_error` bounds the probability that a `supported` by modular evaluation is wrong; `index` is
    the position of the node that a sampling refuted; `balls` are the node's at the certified points that were looked at
    in `bits` bits: at the witness alone, where there is one.
    """

    status: str
    method: str
    note: str = ""
    witness: Witness | None = None
    conditions: tuple[Requirement, ...] = ()
    certificate: Mapping[str, Any] = field(default_factory=dict)
    log2_error: float | None = None
    index: int | None = None
    balls: tuple[Ball, ...] = field(default=(), compare=False, repr=False)
    bits: int = 64

    @property
    def numeric(self) -> Evidence | None:
        """What the balls say, None without them: the largest residual with the radius of its own ball."""
        if not self.balls:
            return None
        return Evidence(len(self.balls), *largest(self.balls), self.bits)


def largest(balls: Iterable[Ball]) -> tuple[float, float]:
    """The largest middle of the balls, and the radius that bounds its rounding."""
    return max((float(abs(ball.mid())), float(ball.rad())) for ball in balls)


Answers = dict[Node, Answer]
