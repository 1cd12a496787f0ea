"""Gauss's integrals: exact values of ∫ Σ c xⁿ exp(−a x² + b x) cos(w x) over all real x, or over x > 0.

∫ xⁿ exp(−a x² + z x) dx = (d/dz)ⁿ √(π/a) exp(z²/(4a)) over all x, for any complex z and a > 0, of which z = b + i w is
taken; ∫ xⁿ exp(−a x²) dx = Γ((n + 1)/2)/(2 a^((n + 1)/2)) over x > 0 (Abramowitz & Stegun, 7.4.2 to 7.4.10).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import sympy as sp

from canon.claims.along_a_range import Range, holds, is_positive
from canon.claims.outcome import Outcome, Residual
from canon.decide.tape import Node
from canon.expression import Formula

if TYPE_CHECKING:
    from canon.claims.question import Question

THEOREM = "Gauss's integral, differentiated by its parameters"
HIGHEST = 12
"""The highest power of the variable."""
LONGEST = 60


@dataclass(frozen=True)
class _Term:
    """c xⁿ exp(−a x² + b x) times cos(w x + d) or sin, or neither (`wave` empty)."""

    c: Any
    n: int
    a: Any
    b: Any
    wave: str = ""
    w: Any = sp.S.Zero
    d: Any = sp.S.Zero

    def text(self, x: sp.Symbol) -> Any:
        """The term as a formula."""
        wave = {"": sp.S.One, "cos": sp.cos(self.w * x + self.d), "sin": sp.sin(self.w * x + self.d)}[self.wave]
        return self.c * x**self.n * sp.exp(-self.a * x**2 + self.b * x) * wave

    def over_all(self) -> Any:
        """Its integral over all real x, for a > 0."""
        a, b, w = (sp.Dummy(real=True) for _ in range(3))  # real names, whose real and imaginary parts are known
        z, polynomial = sp.Dummy("z"), sp.S.One
        for _ in range(self.n):  # (d/dz) P exp(z²/(4a)) = (P' + z P/(2a)) exp(z²/(4a))
            polynomial = sp.expand(sp.diff(polynomial, z) + z * polynomial / (2 * a))
        parts = sp.expand(polynomial.subs(z, b + sp.I * w)).as_real_imag()
        images = {a: self.a, b: self.b, w: self.w}
        real, imaginary = (part.subs(images) for part in parts)
        size = self.c * sp.sqrt(sp.pi / self.a) * sp.exp((self.b**2 - self.w**2) / (4 * self.a))
        angle = self.b * self.w / (2 * self.a) + self.d
        if self.wave == "sin":
            return size * (real * sp.sin(angle) + imaginary * sp.cos(angle))
        return size * (real * sp.cos(angle) - imaginary * sp.sin(angle))

    def over_half(self) -> Any:
        """Its integral over x > 0, for a > 0, b = 0 and no wave."""
        half = sp.Rational(self.n + 1, 2)
        return self.c * sp.gamma(half) / (2 * self.a**half)


def gauss(question: Question, span: Range, f: Formula, node: Node, claimed: Node) -> Outcome | None:
    """Is the integral what is claimed? None where f or the range isn't of this form, or is not shown to be."""
    tape, x = question.tape, span.x
    sides = (span.low, span.high)
    half = isinstance(span.low, Formula) and span.low.expr == 0 and span.high == "infinity"
    if not half and sides != ("-infinity", "infinity"):
        return None
    terms = list(_terms(f, x))
    if not terms or (half and any(t.b != 0 or t.wave for t in terms)):
        return None
    if not all(holds(question, requirement, span.inside, span) for requirement in span.demanded):
        return None
    if not all(is_positive(question, question.load(term.a), span.others) for term in terms):
        return None
    whole = question.load(sp.Add(*(term.text(x) for term in terms)))
    shown = question.decide([Residual("integrand", tape.minus(node, whole))], span.inside)
    if shown.status != "proved":
        return None
    value = question.load(sp.Add(*(term.over_half() if half else term.over_all() for term in terms)))
    outcome = question.decide([Residual("value of the integral", tape.minus(value, claimed), value)], span.others)
    steps = (*shown.arguments, {"theorem": THEOREM, "value": question.show(value)}, *outcome.arguments)
    method = ", ".join(part for part in ("Gauss's integral", outcome.method) if part)
    return Outcome(
        outcome.status, method, outcome.findings, outcome.witness, outcome.numeric, outcome.detail,
        steps if outcome.status == "proved" else outcome.arguments, outcome.note,
    )  # fmt: skip


def _terms(f: Formula, x: sp.Symbol) -> Iterator[_Term]:
    """The terms of a sum of this form; none where it is another. Whether they are right is decided afterwards."""
    expression: Any = f.expr
    if sp.count_ops(expression) > LONGEST or not expression.has(sp.exp):
        return
    found = []
    for part in sp.Add.make_args(sp.expand(sp.expand(expression), power_exp=False)):
        term = _term(part, x)
        if term is None:
            return
        found.append(term)
    yield from found


def _term(part: Any, x: sp.Symbol) -> _Term | None:
    c, n, exponent, waves = sp.S.One, 0, sp.S.Zero, []
    for factor in sp.Mul.make_args(part):
        base, power = factor.as_base_exp() if not isinstance(factor, sp.exp) else (factor, sp.S.One)
        if not factor.has(x):
            c *= factor
        elif base == x and power.is_Integer and 0 <= power <= HIGHEST:
            n += int(power)
        elif isinstance(base, sp.exp) and power.is_Integer:
            exponent += base.args[0] * power
        elif base is sp.E:
            exponent += power
        elif isinstance(factor, (sp.sin, sp.cos)):
            waves.append(factor)
        else:
            return None
    if len(waves) > 1 or n > HIGHEST:
        return None
    square = sp.Poly(exponent, x).all_coeffs() if exponent.is_polynomial(x) else []
    if len(square) != 3:
        return None
    a, b, rest = -square[0], square[1], square[2]
    if not waves:
        return _Term(c * sp.exp(rest), n, a, b)
    phase = waves[0].args[0]
    line = sp.Poly(phase, x).all_coeffs() if phase.is_polynomial(x) else []
    if len(line) != 2:
        return None
    return _Term(c * sp.exp(rest), n, a, b, type(waves[0]).__name__, line[0], line[1])
