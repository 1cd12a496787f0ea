"""A claim being decided: its tape, its chart, its region, and the one door to the deciders."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from itertools import islice
from typing import TYPE_CHECKING, Any, Literal

import sympy as sp

from canon.budget import Budget
from canon.claims.chart import Chart, chart_of, required_of
from canon.claims.matters import tied_to
from canon.claims.outcome import Finding, Outcome, Residual, combined, exact, outcome_of
from canon.claims.show import shown
from canon.decide import ladder
from canon.decide.derivative import substitute
from canon.decide.region import Region, Requirement
from canon.decide.sample import Sample
from canon.decide.sampling import sample
from canon.decide.tape import Node, Tape
from canon.decide.to_accuracy import sample_to
from canon.domain import Domain
from canon.errors import InputError
from canon.expression import Formula
from canon.mechanics.phase_space import UNSTATED

if TYPE_CHECKING:
    from collections.abc import Mapping

    from canon.claim import Claim
    from canon.mechanics import PhaseSpace, Subject, Transformation

Method = Literal["symbolic", "numeric"]
Side = Literal["old", "new", "both"]

SAMPLE_POINTS = 1000
SUPPORT_POINTS = 400
FIRST_BATCH = 6
FOR_PROOFS = 0.85
"""The share of the time for exact arguments: what they leave open still gets its numerical evidence."""


@dataclass(frozen=True)
class Question:
    """A claim with what is needed to decide it. Nothing is built before a kind asks for it."""

    claim: Claim
    budget: Budget
    seed: int = 0
    method: Method = "symbolic"
    accuracy: float | None = None  # what sampled residuals are to be bounded by
    tape: Tape = field(default_factory=Tape)
    listen: Callable[[Sequence[Residual], Region], None] | None = None
    """Is told what the kind asks to be decided."""

    # -- what the claim is about --------------------------------------------------------------

    @property
    def subject(self) -> Subject:
        """What the claims of one file share."""
        return self.claim.subject

    @property
    def space(self) -> PhaseSpace:
        """The phase space."""
        return self.subject.space

    @cached_property
    def map(self) -> Transformation:
        """The transformation; **raises** `InputError` where there is none."""
        found = self.subject.map
        if found is None:
            raise InputError(f"a claim of kind {self.claim.kind!r} needs a transformation or a generating function")
        return found

    def square_map(self) -> Transformation:
        """The transformation, if it has as many new pairs as old ones; **raises** `InputError` otherwise."""
        found = self.map
        if len(self.space.Q) != self.space.n:
            raise InputError(
                f"a claim of kind {self.claim.kind!r} needs as many new pairs as old ones: "
                f"there are {len(self.space.Q)} and {self.space.n}"
            )
        return found

    @cached_property
    def chart(self) -> Chart:
        """Coordinates in which old and new variables are explicit."""
        return chart_of(self.tape, self.space, self.subject.map)

    def hamiltonian(self) -> Formula:
        """H; **raises** `InputError` where the file has none."""
        if self.subject.hamiltonian is None:
            raise InputError(f"a claim of kind {self.claim.kind!r} needs a Hamiltonian")
        return self.subject.hamiltonian

    # -- keys ---------------------------------------------------------------------------------

    def key(self, name: str, default: Any = None) -> Any:
        """The value of a key of the claim."""
        return self.claim.keys.get(name, default)

    def formula(self, name: str, side: Side = "old") -> Formula:
        """A key that holds a formula of the old or new variables; **raises** `InputError` where it is missing."""
        value = self.key(name)
        if value is None:
            raise InputError(f"a claim of kind {self.claim.kind!r} needs the key {name!r}")
        return self.checked(value, name, side)

    def formulas(self, name: str, count: int | None = None, side: Side = "old") -> tuple[Formula, ...]:
        """A key that holds a list of formulas, `count` of them."""
        values = self.key(name)
        if values is None:
            raise InputError(f"a claim of kind {self.claim.kind!r} needs the key {name!r}")
        values = (values,) if isinstance(values, Formula) else tuple(values)
        if not values:
            raise InputError("the list is empty", f"key {name!r}")
        if count is not None and len(values) != count:
            raise InputError(f"{count} expressions are expected, not {len(values)}", f"key {name!r}")
        return tuple(self.checked(value, name, side) for value in values)

    def checked(self, formula: Formula, name: str, side: Side) -> Formula:
        """The formula, if it uses no variable of the other side."""
        if side == "both":
            return formula
        wrong = self.space.new if side == "old" else self.space.old
        for symbol in sorted(formula.symbols & set(wrong), key=str):
            other = "new" if side == "old" else "old"
            raise InputError(
                f"{symbol} is one of the {other} variables: this formula is one in the {side} ones", f"key {name!r}"
            )
        return formula

    # -- nodes and regions --------------------------------------------------------------------

    def load(self, formula: Formula | sp.Expr | int) -> Node:
        """The node of a formula, in its own variables."""
        return self.tape.load(formula.expr if isinstance(formula, Formula) else formula)

    def nodes(self, symbols: Iterable[sp.Symbol]) -> list[Node]:
        """The symbols' nodes."""
        return [self.tape.symbol(symbol) for symbol in symbols]

    def sections(self) -> Iterator[Formula]:
        """The formulas that every claim of the file carries along in its domain."""
        subject = self.subject
        if subject.hamiltonian is not None:
            yield subject.hamiltonian
        if subject.transformation is not None:
            yield from subject.transformation.formulas
        elif subject.generating_function is not None:
            yield subject.generating_function.F

    def domain(self, *formulas: Formula) -> Domain:
        """The claim's domain in the variables in which it is written: old, new, or mixed."""
        region = self.subject.domain
        for formula in (*self.sections(), *formulas):
            region = region & Domain(conditions=formula.conditions)
        return region

    def region(
        self,
        *formulas: Formula,
        images: Mapping[Node, Node] | None = None,
        domain: Domain | None = None,
        chart: Chart | None = None,
        assumed: bool = True,
        regular: bool = True,
    ) -> Region:
        """The claim's domain on the tape, pulled back to the chart.

        **Arguments:** `formulas`, the claim's own keys; `images`, replaced after the chart's own; `domain`, in place of
        `self.domain(*formulas)`; `chart`, in place of the subject's; `assumed`, whether a value in `images` must
        satisfy what is assumed of the name that it stands for; `regular`, whether points where the mixed Hessian of a
        generating function is singular are left out, since no map is defined there.
        """
        tape, chart, images = self.tape, chart or self.chart, images or {}
        names = [tape.symbol_at(u) for u in chart.coordinates if u not in images]
        names = [x for x in names if x.name not in UNSTATED]
        written = Region.of(tape, self.domain(*formulas) if domain is None else domain, names)
        if not chart.images and not images:
            return written

        def moved(node: Node) -> Node:
            pulled = chart.pull(node)
            return substitute(tape, pulled, images) if images else pulled

        requirements = []
        for r in written.requirements:
            nodes = tuple(moved(node) for node in r.nodes)
            requirements.append(r if nodes == r.nodes else Requirement(r.kind, nodes, r.said, " (pulled back)"))
        for variable in (*chart.images, *(images if assumed else ())):
            requirements.extend(required_of(tape, tape.symbol_at(variable), moved(variable)))
        if regular and chart.hessian is not None:
            hessian = substitute(tape, chart.hessian, images) if images else chart.hessian
            requirements.append(Requirement("nonzero", (hessian,), "the mixed Hessian is not singular"))
        return Region(tuple(requirements), tuple(moved(node) for node in written.surface), written.symbols)

    # -- deciding -----------------------------------------------------------------------------

    def decide(self, residuals: Iterable[Residual], region: Region, *, budget: Budget | None = None) -> Outcome:
        """Do all residuals vanish on the region?

        They are built in batches and looked at with balls; a refutation builds no more. What no ball refutes is
        decided together, in one tower.
        """
        if self.listen is not None:
            residuals = list(residuals)
            self.listen(residuals, region)
        stream = iter(residuals)
        time_left = budget or self.budget
        if self.method == "numeric":
            return self._sampled_in_batches(stream, region, time_left)
        seen: list[Residual] = []
        points: list[Sample] = []
        size = FIRST_BATCH
        while batch := list(islice(stream, size)):
            points, refuted = ladder.look(
                self.tape, _nodes(batch), region, budget=time_left, seed=self.seed, known=points
            )
            if refuted:
                return self._decide_batch(batch, region, time_left, points)
            seen.extend(batch)
            size *= 4
        return self._decide_batch(seen or [Residual("0", self.tape.zero)], region, time_left, points)

    def _sampled_in_batches(self, stream: Iterator[Residual], region: Region, budget: Budget) -> Outcome:
        outcomes: list[Outcome] = []
        size = FIRST_BATCH
        while batch := list(islice(stream, size)) or ([] if outcomes else [Residual("0", self.tape.zero)]):
            outcomes.append(self.sampled(batch, region, SAMPLE_POINTS, budget))
            if outcomes[-1].status == "refuted":
                break
            size *= 4
        return combined(outcomes)

    def _decide_batch(
        self, batch: Sequence[Residual], region: Region, budget: Budget, points: Sequence[Sample]
    ) -> Outcome:
        part = budget.share(FOR_PROOFS)
        answers = ladder.vanish(self.tape, _nodes(batch), region, budget=part, seed=self.seed, known=points)
        findings = [self._finding(residual, answer, region) for residual, answer in zip(batch, answers, strict=True)]
        outcome = combined(outcome_of(finding) for finding in findings)
        if outcome.status in ("supported", "undecided") and not budget.spent():
            unproved = [f.residual for f in findings if f.answer.status != "proved"]
            return self._beside(outcome, self.sampled(unproved, region, SUPPORT_POINTS, budget))
        return outcome

    def _finding(self, residual: Residual, answer: ladder.Answer, region: Region) -> Finding:
        tied = tied_to(self.tape, residual.node, region) if answer.witness is not None else frozenset[str]()
        return Finding(residual, answer, tied)

    def sampled(self, batch: Sequence[Residual], region: Region, points: int, budget: Budget | None = None) -> Outcome:
        """Numerical evidence: refuted where a ball excludes 0, else supported."""
        nodes = [residual.node for residual in batch]
        part = (budget or self.budget).share(0.4)
        look = sample if self.accuracy is None else partial(sample_to, accuracy=self.accuracy)
        evidence, answer = look(self.tape, nodes, region, points=points, seed=self.seed, budget=part)
        if answer is not None and answer.status == "refuted":
            index = getattr(answer, "index", None)
            residual = batch[index if index is not None else 0]
            return outcome_of(self._finding(residual, answer, region))
        if evidence is None or not evidence.points:
            ladder.vanish(self.tape, [self.tape.zero], region, budget=budget or self.budget, seed=self.seed)
            return Outcome("undecided", note="no sample points could be evaluated")
        return Outcome("supported", method="sampling", numeric=evidence)

    def _beside(self, outcome: Outcome, sampled: Outcome) -> Outcome:
        """What exact arguments left open, with numerical evidence beside it; a refutation by it wins."""
        if sampled.status == "refuted":
            return sampled
        return replace(outcome, status="supported", numeric=sampled.numeric) if sampled.numeric else outcome

    def not_identically_zero(self, node: Node, region: Region) -> ladder.Answer:
        """Is there a point of the region where the node doesn't vanish? ("refuted": it vanishes identically.)"""
        if self.method != "numeric" or node == self.tape.zero:  # of the number itself there is nothing to sample
            return ladder.nonvanishing(self.tape, node, region, budget=self.budget, seed=self.seed)
        outcome = self.sampled([Residual("0", node)], region, SUPPORT_POINTS)
        if outcome.failed is not None:
            return replace(outcome.failed.answer, status="proved", method="nonzero at a point")
        return ladder.Answer("undecided", "sampling", "zero at every point tried")

    def refuted_exactly(self, region: Region, theorem: str, **detail: Any) -> Outcome:
        """A refutation by an exact argument, on a region that is shown to have a point."""
        (answer,) = ladder.vanish(self.tape, [self.tape.zero], region, budget=self.budget, seed=self.seed)
        if answer.status != "proved":
            return Outcome("undecided", note=f"{theorem}; but no point of the domain could be certified")
        seen = answer.numeric if self.method != "numeric" else None  # the number 0 at a point is no sampled residual
        return replace(exact("refuted", theorem, **detail), numeric=seen)

    def show(self, node: Node, *, shorten: bool = True) -> str:
        """A node as a formula for people."""
        return shown(self.tape, node, shorten=shorten)


def _nodes(residuals: Iterable[Residual]) -> list[Node]:
    return [residual.node for residual in residuals]
