"""The ladder: witness first, then normal form, then the arguments that need more than one of either.

Soundness: `refuted` only by a ball that excludes 0 at a certified point of the region; `proved` only by
an exact argument valid on the whole region. Both together can't be, and that is checked on every proof.
"""

from __future__ import annotations

import contextlib
import random
from collections.abc import Iterable, Sequence
from dataclasses import replace

from canon.budget import Budget, BudgetExceeded
from canon.decide import modular
from canon.decide.answer import Answer, Answers, Witness
from canon.decide.certificate import Certificate, of_tower
from canon.decide.enclosure import Ball, OutOfDomain, excludes_zero
from canon.decide.intervals import intervals_of
from canon.decide.normal_form import FIRST, LARGER, reduce_to_zero
from canon.decide.other_arguments import other_argument
from canon.decide.region import Region
from canon.decide.ring import TooCostly
from canon.decide.sample import Sample, deeply_zero, evaluate_again, extended
from canon.decide.search import samples, some_point
from canon.decide.slivers import points_between_zeros
from canon.decide.tape import Node, Tape, Unsupported
from canon.decide.tower import Tower

DEEPER = (256, 1024, 4096)


class Contradiction(AssertionError):
    """A proof and a ball that excludes 0 at once: a fault of the decider, never to be answered over."""


def vanish(
    tape: Tape,
    nodes: Sequence[Node],
    region: Region,
    *,
    budget: Budget,
    seed: int = 0,
    first_refutation: bool = True,
    known: Sequence[Sample] = (),
) -> list[Answer]:
    """Is each node the zero function on the region?

    Arguments:
      nodes: the residuals.
      first_refutation: stop at the first residual that is refuted; the others may then be `undecided`.
      known: certified points of the region to begin with (of `look`).
    Returns: one answer a node.
    Raises: InputError where no point of the region could be found.
    """
    answers: Answers = {}
    open_nodes = list(dict.fromkeys(nodes))
    ladder = _Ladder(tape, region, budget, random.Random(seed), known)
    with contextlib.suppress(BudgetExceeded):
        ladder.run(open_nodes, answers, first_refutation)
    for node in open_nodes:
        if node not in answers:
            tried = ", ".join(ladder.tried) or "nothing yet"
            answers[node] = Answer("undecided", "", f"the budget ended; tried: {tried}")
    return [answers[node] for node in nodes]


def look(
    tape: Tape, nodes: Sequence[Node], region: Region, *, budget: Budget, seed: int = 0, known: Sequence[Sample] = ()
) -> tuple[list[Sample], bool]:
    """The first rung alone: two certified points with the nodes' balls there, and whether one of them refutes.

    Raises: InputError where no point of the region could be found.
    """
    answers: Answers = {}
    ladder = _Ladder(tape, region, budget, random.Random(seed), known)
    try:
        ladder.witnesses(nodes, answers)
    except BudgetExceeded:
        return [], False
    return ladder.points, bool(answers)


def nonvanishing(tape: Tape, node: Node, region: Region, *, budget: Budget, seed: int = 0) -> Answer:
    """Is the node not identically zero?  Proved by a point at which its ball excludes 0, refuted by a proof of 0."""
    answer = vanish(tape, [node], region, budget=budget, seed=seed)[0]
    if answer.status == "refuted":
        method = f"nonzero at a point ({answer.method})"
        return replace(answer, status="proved", method=method, certificate={})
    if answer.status == "proved":
        return replace(answer, status="refuted", method=f"identically zero ({answer.method})")
    return Answer("undecided", answer.method, answer.note, balls=answer.balls)


class _Ladder:
    """One run of the ladder over residuals of one region."""

    def __init__(
        self, tape: Tape, region: Region, budget: Budget, rng: random.Random, known: Sequence[Sample] = ()
    ) -> None:
        self.tape, self.region, self.budget, self.rng = tape, region, budget, rng
        self.known = known
        self.points: list[Sample] = []
        self.tried: list[str] = []
        self.evidence: dict[Node, float] = {}

    def run(self, nodes: Sequence[Node], answers: Answers, first_refutation: bool) -> None:
        """Rung by rung; every rung takes what the ones before left open."""

        def left() -> list[Node]:
            return [node for node in nodes if node not in answers]

        def done() -> bool:
            return not left() or (first_refutation and any(a.status == "refuted" for a in answers.values()))

        self.witnesses(nodes, answers)
        for node in nodes:
            if node not in answers and node == self.tape.zero:
                argument = {"argument": "the residual is the number 0"}
                answers[node] = Answer("proved", "identity", certificate=argument, balls=self.seen(node))
        if done():
            return
        self.normal_forms(left(), answers, first_refutation)
        if done():
            return
        self.deeper_witnesses(left(), answers, first_refutation)
        if done():
            return
        for node in left():
            self.by_other_arguments(node, answers)
        if left():
            self.between_zeros(left(), answers)
        for node in left():
            self.leave(node, answers)

    # -- witnesses ----------------------------------------------------------------------------------

    def witnesses(self, nodes: Sequence[Node], answers: Answers) -> None:
        """Two certified points: the region isn't empty, and most of what is false ends here."""
        self.tried.append("balls at two points")
        self.points = extended(self.tape, nodes, self.known)
        for sample in self.points:
            self.refute(nodes, sample, sample.balls, answers, 64)
        if self.points:
            return
        try:
            for sample in samples(
                self.tape, nodes, self.region, self.rng, count=2, tries=60, budget=self.budget, nice=True
            ):
                self.points.append(sample)
                self.refute(nodes, sample, sample.balls, answers, 64)
        except Unsupported as reason:
            self.tried.append(f"no balls: {reason}")
        if not self.points:
            self.points += some_point(self.tape, self.region, self.rng, self.budget)

    def refute(self, nodes: Iterable[Node], sample: Sample, balls, answers: Answers, bits: int) -> None:
        """Record every node whose ball excludes 0 at the sample."""
        for node in nodes:
            if node not in answers and node in balls and excludes_zero(balls[node]):
                witness = Witness.of(self.tape, sample, balls[node])
                answers[node] = Answer(
                    "refuted", f"ball at {bits} bits", witness=witness, balls=(balls[node],), bits=bits
                )

    def deeper_witnesses(self, nodes: Sequence[Node], answers: Answers, first_refutation: bool) -> None:
        """More points and more bits, for differences that hide below 64 bits."""
        for bits in DEEPER:
            self.budget.check()
            self.tried.append(f"balls at {bits} bits")
            try:
                new = list(
                    samples(self.tape, nodes, self.region, self.rng, count=2, bits=bits, tries=20, budget=self.budget)
                )
                for sample in new:
                    self.refute(nodes, sample, sample.balls, answers, bits)
                for sample in self.points[:1]:
                    if not sample.solved and all(node in sample.balls for node in nodes):
                        self.refute(nodes, sample, evaluate_again(self.tape, nodes, sample, bits), answers, bits)
            except (Unsupported, OutOfDomain, ZeroDivisionError):
                continue
            if first_refutation and any(answers[n].status == "refuted" for n in nodes if n in answers):
                return

    def between_zeros(self, nodes: Sequence[Node], answers: Answers) -> None:
        """The thin parts of the region, before anything is left open."""
        self.tried.append("points between the zeros of conditions")
        try:
            for sample in points_between_zeros(
                self.tape, nodes, self.region, self.points, self.rng, self.budget.share(0.5)
            ):
                self.refute(nodes, sample, sample.balls, answers, 64)
                if all(node in answers for node in nodes):
                    return
        except (BudgetExceeded, Unsupported):
            return

    # -- proofs ---------------------------------------------------------------------------------------

    def normal_forms(self, nodes: Sequence[Node], answers: Answers, first_refutation: bool) -> None:
        """Numerators modulo the relations of the kernels; modular evaluation tells when to stop trying.

        Before the large ones, points at which to refute what doesn't reduce: one of them may make all others idle.
        """
        self.tried.append("normal form")
        positive = [r.nodes[0] for r in self.region.requirements if r.kind == "positive"]
        try:
            tower = Tower(
                self.tape,
                nodes,
                positive=[n for n in positive if not self.tape.is_complex(n)],
                intervals=intervals_of(self.tape, self.region),
                budget=self.budget,
            )
            zero, nonzero, _ = reduce_to_zero(tower, nodes, self.budget, FIRST)
            costly = [node for node in nodes if node not in zero and node not in nonzero]
            if costly:
                hopeless = self._modular_nonzero(tower, costly)
                costly = [node for node in costly if node not in hopeless]
                if hopeless and costly:
                    self.deeper_witnesses(sorted(hopeless), answers, first_refutation)
                if not first_refutation or not any(answer.status == "refuted" for answer in answers.values()):
                    zero |= self._at_any_cost(tower, costly)
        except (Unsupported, TooCostly, ZeroDivisionError) as reason:
            self.tried.append(f"no tower: {reason}")
            return
        certificate = of_tower(tower, self.region, "the numerator is 0 modulo the relations of its kernels")
        for node in zero:
            self.prove(node, answers, "normal form", certificate)

    def _at_any_cost(self, tower: Tower, nodes: Sequence[Node]) -> set[Node]:
        """Larger and larger normal forms, for what probably is 0, with most of the time that is left."""
        try:
            return reduce_to_zero(tower, nodes, self.budget.share(0.8), LARGER)[0]
        except BudgetExceeded:
            return set()

    def _modular_nonzero(self, tower: Tower, nodes: Sequence[Node]) -> set[Node]:
        """Nodes that certainly don't reduce to 0, by a cheap evaluation over a prime field."""
        try:
            zero, log_error = modular.vanishing(tower, nodes, self.rng)
        except (modular.NoPoint, ValueError, ZeroDivisionError):
            return set()
        for node, vanished in zero.items():
            if vanished:
                self.evidence[node] = log_error
        return {node for node, vanished in zero.items() if not vanished}

    def by_other_arguments(self, node: Node, answers: Answers) -> None:
        """Constants, surfaces, and cell by cell."""

        def asked_again(residual: Node, region: Region) -> Answer:
            return vanish(self.tape, [residual], region, budget=self.budget.share(0.5))[0]

        found = other_argument(self.tape, node, self.region, self.rng, self.budget, self.tried, asked_again)
        if found is not None:
            self.prove(node, answers, *found)

    def prove(self, node: Node, answers: Answers, method: str, certificate: Certificate) -> None:
        """Record a proof, after looking that no ball contradicts it."""
        for sample in self.points:
            if node in sample.balls and excludes_zero(sample.balls[node]):
                raise Contradiction(f"{method} against a ball that excludes 0: please report this claim")
        if not self.points:
            answers[node] = Answer("supported", method, "an identity, but no point of the domain could be certified")
            return
        answers[node] = Answer(
            "proved", method, conditions=self.region.requirements, certificate=certificate, balls=self.seen(node)
        )

    def leave(self, node: Node, answers: Answers) -> None:
        """What remains: supported by modular evaluation or by balls that all contain 0, else undecided."""
        tried = ", ".join(dict.fromkeys(self.tried))
        log_error = self.evidence.get(node)
        if log_error is not None and self.points:
            note = f"zero over a random prime field, error below 2^{log_error:.0f}; tried: {tried}"
            answers[node] = Answer("supported", "modular evaluation", note, log2_error=log_error, balls=self.seen(node))
            return
        if self.seen(node) and deeply_zero(self.tape, node, self.points):
            note = f"within 10^-200 of 0 at {len(self.points)} points; tried: {tried}"
            answers[node] = Answer("supported", "balls at 1024 bits", note, balls=self.seen(node))
            return
        answers[node] = Answer("undecided", "", f"tried: {tried}", balls=self.seen(node))

    def seen(self, node: Node) -> tuple[Ball, ...]:
        """The node's balls at the points where it was looked at first, in 64 bits."""
        return tuple(sample.balls[node] for sample in self.points if node in sample.balls)
