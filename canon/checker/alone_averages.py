"""Averages over time: `python alone_averages.py CERTIFICATE.json …`

Along a motion, given by formulas of a parameter u: it solves Hamilton's equations, if the file has H, time grows with
u, and the antiderivative of f dt/du, which the claim or the certificate has, gives the average times the time that goes
by (`alone_integrals.py`). Names that are nonnegative are positive, or 0: both are looked at.

By a virial G: f − dG/dt is `equals`, and doesn't change, and |G| is at most B, which doesn't (`alone_signs.py`). There
are motions that go on for ever: H is of degree 2 in coordinates and momenta, with second derivatives that don't depend
on time, all formulas are polynomials in these, and no condition speaks of them.
"""

from __future__ import annotations

import re
from itertools import product
from typing import Any

if __package__:
    from canon.checker import alone, alone_integrals, alone_paths, alone_signs, alone_wider
    from canon.checker.alone_regular import itself, negative
    from canon.checker.counterexample_formulas import Writer, degree, inner_names, put, put_names, times, total
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_integrals  # type: ignore
    import alone_paths  # type: ignore
    import alone_signs  # type: ignore
    import alone_wider  # type: ignore
    from alone_regular import itself, negative  # type: ignore
    from counterexample_formulas import Writer, degree, inner_names, put, put_names, times, total  # type: ignore

Formula, Stop = alone.Formula, alone.Stop
MOVING = {"keys": "f equals parameter from to motions antiderivative", "names": "parameter", "among": "t",
    "of": {"f": "q p t", "equals from to": "", "motions antiderivative": "parameter", "H": "q p t"}}  # fmt: skip
VIRIAL = {"keys": "f equals virial bound",
    "let": {"mean": "f - bracket(virial, H) - D(virial, t)"},
    "besides": [
        "mean - equals", "bracket(equals, H) + D(equals, t)", "bracket(bound, H) + D(bound, t)",
        "D(D(D(H, x_i), x_j), x_k)", "D(D(D(H, x_i), x_j), t)",
    ]}  # fmt: skip
MOTION, BOUNDED = {"parameter", "from", "to", "motion"}, {"virial", "bound"}


def unwritten(asked: Any) -> None:
    """No condition of the domain speaks of what moves. Raises Stop."""
    own = itself(asked)
    for side in (side for text in asked.domain.get("where", []) for side in re.split("<=|>=|!=|<|>", text)):
        if inner_names(asked.read(side, own), asked) & {*asked.names}:
            raise Stop("not shown", "a condition on what moves")


class Motion(alone_wider.Wider):
    """An average along a motion, as formulas of its parameter."""

    def __init__(self, tables: Any, said: Any, antiderivative: Any) -> None:
        moved = {**said["motion"]}
        names = [*tables["phase_space"]["q"], *tables["phase_space"]["p"]]
        claim = {key: said[key] for key in ("f", "equals", "parameter", "from", "to")}
        claim |= {"kind": "average", "motions": [*moved.values()], "antiderivative": antiderivative}
        has = "hamiltonian" in tables
        form = MOVING | {"besides": ["f - f", *(["H - H"] if has else [])]}
        super().__init__({**tables, "claim": claim}, form)
        self.u, self.t, own, write = said["parameter"], self.names[-1], itself(self), Writer(self)
        if {*moved} - {*names, self.t} or (has and {*names} - {*moved}) or self.u in moved:
            raise Stop("not shown", "a motion of other names, or of a part of them")
        unwritten(self)
        plain = lambda text: write.written(self.read(text, own))
        self.put = {name: plain(f"__motions_{k}") for k, name in enumerate(moved)}
        if inner_names(plain("__f"), self) & {*names} - {*moved} or (self.u != self.t and self.t not in moved):
            raise Stop("not shown", "a function of what isn't said to move")
        self.along = lambda text: put_names(plain(text), self.put)
        self.clock = self.put.get(self.t, Formula(".", (self.t,)))
        steep = lambda f: write.slope(f, self.u)
        self.pace, self.antiderivative, self.f = steep(self.clock), plain("__antiderivative"), self.along("__f")
        less = lambda a, b: total(self, a, negative(self, b))
        self.equals, self.rate = plain("__equals"), less(steep(self.antiderivative), times(self, self.f, self.pace))
        self.zeros, self.smooth = [self.rate], [self.f, self.pace, self.antiderivative, *self.put.values()]
        for q, p in self.pairs if has else ():
            flow = [times(self, self.along(f"D(__H, {x})"), self.pace) for x in (p, q)]
            self.zeros += [less(steep(self.put[q]), flow[0]), total(self, steep(self.put[p]), flow[1])]
        self.smooth += [self.along("__H")] if has else []
        self.smooth += [put_names(f, self.put) for f in write.under]


class Stretch(alone_integrals.Integral):
    """The parameter between its ends, with sines and cosines in these words."""

    def __init__(self, tables: Any, motion: Motion, words: Any) -> None:
        said = tables["claim"]
        claim = {"kind": "integral", "f": "0", "variable": motion.u, "equals": "0"}
        claim |= {"from": said["from"], "to": said["to"]}
        kept = {key: x for key, x in tables.items() if key in ("phase_space", "symbols", "definitions", "domain")}
        super().__init__({**kept, "claim": claim}, "0")
        if any(isinstance(end, int) for end in self.ends):
            raise Stop("not shown", "a stretch without an end")
        self.calls |= {self.structure(self.bare(g)) for g in self.parts(motion.f) if self.is_called(g)}
        new = lambda x: self.read(words[x.kind], {"a": x.of[0]}) if x.kind in words else None
        self.told = lambda f: put(f, new)
        self.between = alone_integrals.Between(self)
        self.positive = self.is_positive(Formula(".", (self.x,)))
        if self.signed and not self.positive:
            raise Stop("not shown", "that the parameter is positive along the stretch")
        for f in map(self.told, motion.smooth):
            self.between.check(f)
        for end, f in product((0, 1), (motion.antiderivative, motion.clock)):
            alone_integrals.Between(self, end).check(self.told(f))
        if not self.is_positive(motion.pace):
            raise Stop("not shown", "that time grows along the motion")
        for name, f in motion.put.items():
            for word in {*motion.words.get(name, ())} - {"real"}:
                if word not in ("positive", "nonnegative") or not self.is_positive(f, word == "positive"):
                    raise Stop("not shown", f"that {name[:40]} is what is said of it")

    def is_positive(self, f: Any, strict: bool = True) -> bool:
        return self.between.shown(self.between.quotient(self.told(f))[0], strict)


def sample(span: Stretch, motion: Motion, prime: int) -> int:
    """See at one point of the stretch that it is a motion, and what the integral is."""
    point = alone_integrals.Along(span, prime)
    point.check_domain()
    point.start()
    ends = [alone_integrals.Along(span, prime, point, end) for end in span.ends]
    change = [(ends[1].at(f) - ends[0].at(f)) % prime for f in (motion.antiderivative, motion.clock)]
    if any(map(point.at, motion.zeros)) or (change[0] - point.at(motion.equals) * change[1]) % prime:
        raise Stop("not shown", "that this is a motion, and the average along it")
    return len(point.roots)


def by_motion(tables: Any, said: Any, antiderivative: Any) -> tuple[str, str]:
    """The answer along a motion, with names that are nonnegative as positive ones and as 0."""
    words = {name: [w] if isinstance(w, str) else w for name, w in tables.get("symbols", {}).items()}
    moved = {*said["motion"], said["parameter"]}
    edges = [name for name, w in words.items() if "nonnegative" in w and name not in moved]
    if len(edges) > 2 or any(words[name] != ["nonnegative"] for name in edges):
        raise Stop("not shown", "so many names that may be 0")
    answer = "not shown", "nothing"
    for way in product((False, True), repeat=len(edges)):
        nought = {name for name, zero in zip(edges, way, strict=True) if zero}
        symbols = {name: "positive" if name in edges else w for name, w in words.items() if name not in nought}
        definitions = {**tables.get("definitions", {}), **dict.fromkeys(nought, "0")}
        own = {**tables, "symbols": symbols, "definitions": definitions}
        motion = Motion(own, said, antiderivative)
        answer = alone.tried(sample, seen(own, motion), motion)
    return answer


def seen(tables: Any, motion: Motion) -> Stretch:
    """The stretch, on which all is seen to be smooth with sines and cosines in some words."""
    reason = Stop("not shown", "nothing")
    for words in alone_paths.TURNS:
        try:
            return Stretch(tables, motion, words)
        except Stop as stop:
            reason = stop
    raise reason


def by_virial(tables: Any, said: Any) -> tuple[str, str]:
    """The answer by a virial."""
    asked = alone_wider.Wider({**tables, "claim": {**said, "kind": "average"}}, VIRIAL)
    unwritten(asked)
    if any({*asked.words.get(name, ())} - {"real"} for name in asked.names):
        raise Stop("not shown", "signs of what moves")
    own, write = itself(asked), Writer(asked)
    formulas = [write.written(asked.read(f"__{key}", own)) for key in ("f", "equals", "virial", "bound", "H")]
    if any(degree(f, name, asked) is None for f in (*formulas, *write.under) for name in asked.names):
        raise Stop("not shown", "formulas that aren't seen to have values everywhere")
    for side in ("bound - (virial)", "bound + (virial)"):
        put_in = re.sub(r"\b(bound|virial)\b", lambda m: f"({said[m[1]]})", side)
        claim = {"kind": "inequality", "lhs": put_in, "relation": ">=", "rhs": "0"}
        answer = alone_signs.shown({"tables": {**tables, "claim": claim}})
        if answer[0] != "shown":
            return answer

    def values(prime: int) -> int:
        point = alone_wider.Placed(asked, prime)
        point.check_domain()
        point.check()
        return len(point.roots)

    return alone.tried(values)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim."""
    tables = data["tables"]
    said = {key: x for key, x in tables["claim"].items() if key not in alone.UNASKED}
    keys = {*said} - {"f", "equals"}
    if tables["claim"]["kind"] != "average" or {"transformation", "generating_function"} & {*tables}:
        raise Stop("not shown", "no average, or one beside a map")
    if keys == BOUNDED and "hamiltonian" in tables:
        return by_virial(tables, said)
    if keys - {"antiderivative"} != MOTION:
        raise Stop("not shown", "an average with other keys")
    antiderivative = said.get("antiderivative", data["known"].get("antiderivative"))
    if antiderivative is None:
        raise Stop("not shown", "no antiderivative")
    return by_motion(tables, said, antiderivative)


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
