"""One-dimensional motion: actions, periods, frequencies and angles of every branch, and back from them to q and p.

Arnold (1989), Mathematical Methods of Classical Mechanics, § 50; Landau and Lifshitz (1976), Mechanics, §§ 11, 49, 50.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final

import sympy as sp

from canon.errors import NO_NUMBER, InputError
from canon.expected import formula_of, instance_of, numbers, shown, table
from canon.expression import read
from canon.numeric.actions.angle import angle_of
from canon.numeric.actions.balls import Ball, ball_function, ball_of, precision
from canon.numeric.actions.bounded import Bounded
from canon.numeric.actions.branches import Branch, TooCoarse, branches_at, end_place
from canon.numeric.actions.course import Course
from canon.numeric.actions.drift import drift_of
from canon.numeric.actions.inverse import energy_of, point_of
from canon.numeric.actions.landscape import Critical, Interval, landscape
from canon.numeric.actions.levels import Level, level_at, level_of
from canon.numeric.actions.measure import drifted, measured
from canon.numeric.actions.orbit import Orbit
from canon.numeric.actions.period import least_period, seems_periodic
from canon.numeric.actions.profile import Profile, profile_of
from canon.numeric.actions.ranges import ranges_text
from canon.numeric.actions.wells import holds
from canon.vocabulary import Vocabulary

BITS: Final = 58
"""Results are wanted to so many bits: more than a double holds."""

PRECISIONS: Final = (256, 512, 1024, 2304, 4608)


@dataclass(frozen=True)
class Motion:
    """The motion of H(q, p) on its domain; `nodes` are the minima and maxima of its potential."""

    profile: Profile
    domain: Interval
    nodes: tuple[Critical, ...]

    def orbits(self, energy: Any) -> tuple[Orbit, ...]:
        """Every branch at an energy, from left to right; of rotations that with p > 0.

        **Raises:** `InputError` where there is none, or one is not bounded.
        """
        level = level_of(_exact(energy, "energy"), str(energy))
        return tuple(self._measured(level, branch) for branch in self._branches(level))

    def librations(self, energy: Any) -> tuple[tuple[float, float], ...]:
        """Between which places each bounded libration at an energy runs; its images under a period count once.

        **Raises:** `InputError` where there is no motion.
        """
        level = level_of(_exact(energy, "energy"), str(energy))
        ends = [branch.ends for branch in self._branches(level) if branch.kind == "libration" and not branch.is_open]
        with precision(PRECISIONS[0]):
            E = level.value()
            places = [[float(end_place(end, self.profile, self.domain, E)) for end in pair] for pair in ends if pair]
        return tuple((low, high) for low, high in places)

    def orbit(
        self,
        energy: Any = None,
        *,
        above_minimum: Any = None,
        above_separatrix: Any = None,
        below_separatrix: Any = None,
        well: float | None = None,
        branch: str | None = None,
    ) -> Orbit:
        """The orbit at an energy, or at a distance from the minimum or from the separatrix of a well.

        The distances are what keeps digits: `below_separatrix=1e-300` is another orbit than `energy` = that of the
        barrier. Numbers are taken exactly as given; text, as "1/3", is read in the language of claim files.

        **Arguments:** `well`, a point in the well that is meant, where there are several; `branch`, "libration" or
        "rotation".

        **Raises:** `InputError` where there is no such orbit, or more than one, with the energies that have one.
        """
        given = {
            "energy": energy,
            "above_minimum": above_minimum,
            "above_separatrix": above_separatrix,
            "below_separatrix": below_separatrix,
        }
        exact = {name: _exact(v, name) for name, v in given.items() if v is not None}
        try:
            with precision(PRECISIONS[0]):
                level = level_at(exact, self.nodes, well)
        except InputError as error:
            raise InputError(f"{error.message}; {self.ranges()}", error.where) from error
        found = self._branches(level)
        return self._measured(level, self._chosen(found, level, well, branch))

    def at(self, q: Any, p: Any) -> Orbit:
        """The orbit through a phase point, with its angle there. **Raises:** `InputError` as `orbit` does."""
        q, p, level, branch, side = self._through(q, p)
        return self._measured(level, branch, lambda course: angle_of(course, self.domain, q, p, BITS), side)

    def drift(self, q: Any, p: Any, rate: Any, start: Any) -> tuple[Bounded, Bounded]:
        """The frequency and the angle variable of a cyclic coordinate of period 2π that H held a momentum of.

        **Arguments:** `rate`, its velocity ∂H/∂p_c as a formula in q and p; `start`, its value at (q, p).
        """
        q, p, level, branch, side = self._through(q, p)
        speed = ball_function(formula_of(rate, "rate"), (self.profile.q, self.profile.p))
        start = _exact(start, "the angle")
        return drifted(
            self, level, branch, side, lambda course: drift_of(course, self.domain, speed, q, p, start, BITS)
        )

    def _through(self, q: Any, p: Any) -> tuple[Any, Any, Level, Branch, int]:
        q, p = _exact(q, str(self.profile.q)), _exact(p, str(self.profile.p))
        energy = self.profile.energy
        level = Level(lambda: energy(ball_of(q), ball_of(p)), f"H at {self.profile.q} = {q}, {self.profile.p} = {p}")
        branch = self._around(self._branches(level), ball_of(q))
        below = self.profile.middle_momentum(ball_of(q)) > ball_of(p)
        return q, p, level, branch, -1 if below else 1

    def point(
        self, action: Any, angle: Any, *, well: float | None = None, branch: str | None = None
    ) -> tuple[Bounded, Bounded]:
        """(q, p) at an action J and an angle w: the inverse of `at`. **Raises:** `InputError` where J is too large."""
        _check_choice(well, branch)
        return point_of(self, ball_of(_exact(action, "action")), ball_of(_exact(angle, "angle")), well, branch)

    def energy(self, action: Any, *, well: float | None = None, branch: str | None = None) -> Bounded:
        """The energy H(J) of an action. **Raises:** `InputError` where J is too large for the branch."""
        _check_choice(well, branch)
        return energy_of(self, ball_of(_exact(action, "action")), well, branch)

    def _branches(self, level: Level) -> tuple[Branch, ...]:
        for bits in PRECISIONS:
            with precision(bits):
                try:
                    found = branches_at(self.nodes, self.domain, level.value(), last=bits == PRECISIONS[-1])
                except TooCoarse:
                    continue
                if not found:
                    raise InputError(f"{_nothing(level, self.nodes)} at {level.text}; {self.ranges()}", "energy")
                return found
        raise AssertionError("the last precision tells")

    def _chosen(self, found: tuple[Branch, ...], level: Level, well: float | None, kind: str | None) -> Branch:
        _check_choice(well, kind)
        if kind is not None:
            of_kind = [branch for branch in found if branch.kind == kind or branch.on_separatrix]
            if not of_kind:
                raise InputError(f"there is no {kind} at {level.text}: {self.ranges()}", "branch")
            found = tuple(of_kind)
        if well is not None:
            return self._around(found, ball_of(_exact(well, "well")))
        bound = tuple(branch for branch in found if not branch.is_open)
        if len(bound) > 1:
            places = ", ".join(f"{float(branch.inside[0][0]):.6g}" for branch in bound)
            raise InputError(f"{len(bound)} wells have orbits at {level.text}: choose one with well = {places}", "well")
        return bound[0] if bound else found[0]

    def _around(self, found: tuple[Branch, ...], q: Ball) -> Branch:
        """The branch in whose well a point lies."""
        around = [branch for branch in found if holds(branch, q, self.domain)]
        if len(around) > 1:
            wells = ", ".join(f"{float(branch.inside[0][0]):.6g}" for branch in around)
            raise InputError(
                f"{self.profile.q} = {float(q):.17g} is on the barrier between two wells, in neither: the wells have "
                f"{self.profile.q} = {wells} inside",
                "well",
            )
        if around:
            return around[0]
        raise InputError(f"there is no orbit around {self.profile.q} = {float(q):.17g}: {self.ranges()}", "well")

    def _measured(
        self, level: Level, branch: Branch, angle: Callable[[Course], Ball] | None = None, side: int = 1
    ) -> Orbit:
        return measured(self, level, branch, angle, side)

    def ranges(self) -> str:
        """The energies that have orbits, in words."""
        return ranges_text(self.nodes, self.domain, str(self.profile.q))


def _nothing(level: Level, nodes: tuple[Critical, ...]) -> str:
    """Why there is no branch at an energy."""
    E = level.value()
    if any(node.kind > 0 and not node.value() > E and not node.value() < E for node in nodes):
        return "nothing moves: J = 0, and there is no angle, at the minimum,"
    return "there is no motion"


def _check_choice(well: Any, branch: Any) -> None:
    """**Raises:** `InputError` for what chooses no well, or no branch."""
    if well is not None:
        _exact(well, "well")
    if branch is not None and not (isinstance(branch, str) and branch in ("libration", "rotation")):
        raise InputError(f"a branch is 'libration' or 'rotation', not {shown(branch)}", "branch")


def _exact(value: Any, where: str) -> Any:
    """A number as it is given, exactly; text is read. **Raises:** `InputError`."""
    if isinstance(value, str):
        value = read(value, Vocabulary(), where).expr
    if isinstance(value, sp.Basic) and not value.is_real:
        raise InputError(f"a real number is expected, not {value}", where)
    try:
        found = ball_of(value, where)
    except NO_NUMBER:
        raise InputError(f"a real number is expected, not {shown(value)}", where) from None
    if not found.is_finite():
        raise InputError(f"a finite number is expected, not {value}", where)
    return value


def motion(
    H: Any,
    q: Any = "q",
    p: Any = "p",
    *,
    parameters: Mapping[str, Any] | None = None,
    period: Any = None,
    domain: tuple[float, float] | None = None,
    walls: bool = False,
) -> Motion:
    """The motion of a Hamiltonian of one degree of freedom.

    **Arguments:** `H`, a formula in the language of claim files or of sympy, least at one momentum for each q; `q` and
    `p`, names or symbols; `parameters`, numbers for the other names; `period`, of H in q where q is an angle: the least
    one is found where H holds q in sines and cosines alone; `domain`, the ends of q where it has any (a symbol that is
    positive begins at 0), and with `walls` the motion is reflected there.

    **Raises:** `InputError` where H is no such formula.
    """
    for name, given in (("q", q), ("p", p)):
        if not isinstance(given, (str, sp.Symbol)):
            raise InputError(f"a name or a symbol is expected, not {shown(given)}", name)
    q, p = (x if isinstance(x, sp.Symbol) else sp.Symbol(x, real=True) for x in (q, p))
    parameters = {} if parameters is None else parameters
    table(parameters, "numbers", "parameters")
    for name in parameters:
        instance_of(name, str, "parameters")
    values = {name: _number(value, name) for name, value in parameters.items()}
    if isinstance(H, str):
        symbols = {q.name: q, p.name: p, **{name: sp.Symbol(name, real=True) for name in values}}
        H = read(H, Vocabulary(symbols), "H").expr
    H = formula_of(H, "H")
    H = H.subs({symbol: values[symbol.name] for symbol in H.free_symbols if symbol.name in values})
    profile = profile_of(H, q, p)
    lowest = 0.0 if q.is_positive else -float("inf")
    ends = (lowest, float("inf")) if domain is None else numbers(domain, "domain")
    if len(ends) != 2:
        raise InputError(f"a domain has two ends, low and high, not {shown(domain)}", "domain")
    low, high = ends
    if not low < high:
        raise InputError(f"the domain's ends are in order, unlike {low} and {high}", "domain")
    turn = None
    if domain is None and not q.is_positive:
        turn = _period(period) if period is not None else least_period(H, q)
        if period is not None and turn is not None and not seems_periodic(profile.energy, turn):
            raise InputError(f"H = {H} doesn't repeat itself after {period}", "period")
    interval = Interval(float(low), float(high), turn, walls)
    return Motion(profile, interval, landscape(profile, interval))


def _number(value: Any, name: str) -> Any:
    exact = _exact(value, name)
    return sp.Rational(exact) if isinstance(exact, float) else formula_of(exact, name)


def _period(value: Any) -> Callable[[], Ball]:
    exact = _exact(value, "period")
    if not ball_of(exact) > 0:
        raise InputError(f"a period is positive, unlike {value}", "period")
    return ball_function(sp.Rational(exact) if isinstance(exact, float) else formula_of(exact, "period"), ())
