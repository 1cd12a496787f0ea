"""What claims about actions, frequencies and angles ask for: integrals round an orbit, measured at points.

Where a Hamiltonian is quadratic in the momentum, a p² + b p + c = E, the momentum is −b/2a ± √D/2a with
D = b² − 4 a (c − E); where it is only even in p, the momentum is what H = E is solved by. The orbit runs between two
ends, at which D, or E − H(q, 0), changes its sign, or at a separatrix touches 0; its action is the integral of the
momentum's two branches, or of that with p > 0 over a period of the coordinate. What is measured is evidence, never a
proof; where two ways of measuring it don't agree, nothing is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from canon.checker.case import Case
from canon.checker.functions import Unknown
from canon.checker.orbits import Ends, Form, Momenta, Orbit
from canon.checker.points import Numbers, Outside
from canon.checker.statement import Statement

DIGITS = 12
"""To so many digits an integral has to agree."""
PRECISE, SOLVED = (32, 44), (20, 26)
"""Digits in which an orbit is measured, and again where it isn't as claimed: fewer where the momentum is solved for."""


def action(s: Statement) -> Case:
    """J = ∮ p dq, or ν = dE/dJ, is `equals`."""
    f, claim = s.f, s.claim
    x, E = str(claim["coordinate"]), str(claim["energy"])
    p = s.p[s.q.index(x)]
    fixed = {name: f.read(text, s.names) for name, text in claim.get("fixed", {}).items()}
    s.declared |= {E}
    H = f.substitute(s.H, {n: v for n, v in fixed.items() if n != E})
    level, equals = fixed.get(E, f.node("s", E)), s.key("equals")
    given = [f.read(claim[word], s.names) for word in ("period", "well") if word in claim]
    s.written += [level, *fixed.values(), *given]
    period = f.read(claim.get("period", "2*pi"), s.names)
    form = Form.of(s, H, x, p)
    rate, rotates = claim["kind"] == "frequency", claim.get("branch") == "rotation"
    if rotates and not form.quadratic:
        raise Unknown("a rotation with a Hamiltonian that isn't quadratic in the momentum")

    def measured(numbers: Numbers, of: Mapping[str, Any]) -> list[Any]:
        found = numbers.values(f, [level, equals, period, *given], of)
        well = found[given[-1]] if "well" in claim else None
        values = []
        for digits, fine in zip(PRECISE if form.quadratic else SOLVED, (1, 3), strict=True):
            momenta = Momenta(form, Numbers(digits), {**of}, found[level])
            orbit = Orbit(momenta, rate, DIGITS)
            values.append(orbit.turn(found[period]) if rotates else Ends(s, momenta, fine, orbit).measure(well))
            if abs(found[equals] / values[-1] - 1) <= numbers.mp.mpf(10) ** -DIGITS:
                return [numbers.mp.mpf(0)]
        if abs(values[0] / values[1] - 1) > numbers.mp.mpf(10) ** -DIGITS:
            raise Outside
        return [found[equals] / values[-1] - 1]

    return Case([], measured=measured, digits=DIGITS)


def action_angle(s: Statement) -> Case:
    """Canonical, and K depends on the new momenta alone; each angle's period brings the old variables back."""
    f = s.f
    zeros, _ = s.brackets(f.number(1))
    period = f.read(s.claim.get("angle_period", "1"), s.names)
    s.written.append(period)
    once = "that each angle advances by its period once round its cycle"
    if s.direction == "forward":
        if s.verdict == "refuted":
            raise Unknown("a refutation of angles of a map that is given forward")
        momenta = s.new[len(s.q) :]
        return Case([*zeros, *(f.bracket(P, s.H, s.f.pairs) for P in momenta)], trusted=once)
    if s.direction != "backward":
        raise Unknown("angles of a map that is given by a generating function")
    K = s.pull(s.H)
    zeros += [f.slope(K, angle) for angle in s.Q]
    later = [[f.substitute(x, {Q: f.add(f.node("s", Q), period)}) for x in s.old] for Q in s.Q]

    def measured(numbers: Numbers, of: Mapping[str, Any]) -> list[Any]:
        """The changes of the old variables, but for coordinates that H doesn't tell from themselves afterwards."""
        found = numbers.values(f, [*s.old, *(x for row in later for x in row)], of)
        residuals = []
        for row in later:
            for name, before, after in zip((*s.q, *s.p), s.old, row, strict=True):
                change = found[after] - found[before]
                if abs(change) > numbers.mp.mpf(10) ** -DIGITS and name in s.q and _same(s, numbers, of, name, change):
                    change = numbers.mp.mpf(0)
                residuals.append(change)
        return residuals

    return Case(zeros, measured=measured, digits=DIGITS, trusted=once)


def _same(s: Statement, numbers: Numbers, of: Mapping[str, Any], name: str, change: Any) -> bool:
    """Whether H is the same where a coordinate has moved by a full turn."""
    f = s.f
    here = {n: numbers.values(f, [x], of)[x] for n, x in zip((*s.q, *s.p), s.old, strict=True)}
    a, b = (numbers.values(f, [s.H], {**of, **here, name: here[name] + d})[s.H] for d in (0, change))
    turns = abs(change) / (2 * numbers.mp.pi)
    return bool(abs(a - b) < numbers.mp.mpf(10) ** -DIGITS and abs(turns - 1) < numbers.mp.mpf(10) ** -DIGITS)


KINDS: dict[str, Callable[[Statement], Case]] = {
    "action": action,
    "frequency": action,
    "action_angle": action_angle,
}
