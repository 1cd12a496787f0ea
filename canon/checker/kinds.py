"""What claims ask for, of all the kinds that the checker knows; among them those about motions."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

from canon.checker import (
    actions,
    algebras,
    averages,
    calculus,
    constraints,
    dimensions,
    matrices,
    normal_forms,
    variations,
)
from canon.checker import obligations as mechanics
from canon.checker.case import Case
from canon.checker.everywhere import is_nearly
from canon.checker.followed import at_random, is_identity
from canon.checker.functions import Unknown, Unreadable
from canon.checker.motion import Motion, formulas
from canon.checker.positive import is_nowhere_zero
from canon.checker.shapes import SMOOTH, is_rational
from canon.checker.stated import BOTH, MAPPED, SQUARE
from canon.checker.statement import Statement
from canon.checker.whole_image import is_whole

ALONG = ("action", "average", "frequency", "normal_form", "stationary")
"""Kinds about paths, orbits and origins: beside a map given backward, or a generating function, those in its image."""
ON_ITS_IMAGE = "that what the claim speaks of lies in the image of the file's map"
FEW = 4
"""Of so many degrees of freedom a determinant is written down."""
OF_OLD_ONES = ("euler_lagrange", "noether", "legendre", "hamilton_jacobi", "constraint")
"""Kinds of claims that leave the map out of the domain; what refutes them is a point of the map's image."""


def obligations(s: Statement) -> list[Case]:
    """What the claim asks for. Raises Unknown for a kind, or a form of one, that there is no rule for."""
    kind = str(s.claim["kind"])
    if kind not in KINDS:
        raise Unknown(f"claims of kind {kind[:40]!r} are not known to the checker")
    given = s.direction in ("implicit", "backward")
    beside = given and (kind in ALONG or _varies(s, kind)) and not is_whole(s)
    found = KINDS[kind](s)
    if beside:
        s.trusted.append(ON_ITS_IMAGE)
    found = found if isinstance(found, list) else [found]
    if given and kind in OF_OLD_ONES and s.verdict == "refuted":
        found = [replace(x, zeros=[s.pull(a) for a in x.zeros], images={}, elsewhere=True) for x in found]
    if kind not in (*MAPPED, *SQUARE):
        regular = _regular(s)
        if found and s.verdict == "proved":
            found[0].nonzeros += regular
            if s.direction == "backward" and not regular:
                found[0].trusted = found[0].trusted or "that the map isn't singular everywhere"
        if s.verdict == "refuted" and kind not in BOTH:  # where the map is one to one nearby: else it says nothing
            s.conditions = [*s.conditions, *((group[0], "nonzero") for group in regular)]
            if s.direction == "backward" and not regular:
                for case in found:
                    case.against = case.against or "that the map has an inverse near the point"
    return found


def _varies(s: Statement, kind: str) -> bool:
    """Whether a claim varies an old variable, or a name that occurs in what all claims of the file share."""
    if kind not in ("integral", "limit"):
        return False
    shared = [*s.written, *s.old, *s.new, *s.images.values(), *(a for a, _ in s.conditions)]
    shared += [s.generating[1]] if s.direction == "implicit" else []
    name = str(s.claim["variable"])
    return name in {*s.q, *s.p} or any(s.f.ops[b] == ("s", name) for b in s.f.reach(*shared))


def _regular(s: Statement) -> list[list[int]]:
    """What mustn't vanish everywhere for old variables that are given by others to be variables at all."""
    if s.direction == "implicit":
        return [[mechanics.hessian(s)]]
    if s.direction == "backward" and len(s.q) <= FEW:
        return [[s.pfaffian(s.lagrange(s.old), range(len(s.coordinates)))]]
    return []


def euler_lagrange(s: Statement) -> Case:
    """d/dt ∂L/∂v − ∂L/∂q + ∂R/∂v − Q are the equations, or vanish for the accelerations."""
    f, m, L = s.f, Motion(s), s.key("L")
    s.without(L, [*m.a, *s.p])
    left = [f.sub(m.rate(f.slope(L, v)), f.slope(L, q)) for q, v in zip(m.q, m.v, strict=True)]
    if "dissipation" in s.claim:
        R = s.key("dissipation")
        s.without(R, m.a)
        left = [f.add(x, f.slope(R, v)) for x, v in zip(left, m.v, strict=True)]
    if "forces" in s.claim:
        for force in formulas(s, "forces"):
            s.without(force, m.a)
        left = [f.sub(x, force) for x, force in zip(left, formulas(s, "forces"), strict=True)]
    if "equations" in s.claim:
        return Case([f.sub(x, y) for x, y in zip(left, formulas(s, "equations"), strict=True)])
    images = dict(zip(m.a, formulas(s, "qddot"), strict=True))
    hessian = s.determinant([[f.slope(f.slope(L, x), y) for y in m.v] for x in m.v])
    trusted = "" if is_nearly(s, [hessian], [*m.q, *m.v, m.t]) else mechanics.FLAT
    return Case([f.substitute(x, images) for x in left], [[hessian]], trusted=trusted)


def noether(s: Statement) -> Case:
    """∂L/∂t τ + ∂L/∂q ξ + ∂L/∂v (ξ' − v τ') + L τ' = f', and the charge is ∂L/∂v ξ − (v ∂L/∂v − L) τ − f."""
    f, m, L, steps = s.f, Motion(s), s.key("L"), formulas(s, "dq")
    s.without(L, [*m.a, *s.p])
    tau, gauge = (s.key(word) if word in s.claim else f.number(0) for word in ("dt", "f"))
    stretch, momenta = m.rate(tau), [f.slope(L, v) for v in m.v]
    change, charge = [f.mul(f.slope(L, m.t), tau), f.mul(L, stretch)], [f.mul(L, tau), f.mul(f.number(-1), gauge)]
    for q, v, p, step in zip(m.q, m.v, momenta, steps, strict=True):
        slide = f.sub(m.rate(step), f.mul(f.node("s", v), stretch))
        change += [f.mul(f.slope(L, q), step), f.mul(p, slide)]
        charge += [f.mul(p, step), f.mul(f.number(-1), f.node("s", v), p, tau)]
    zeros = [f.sub(f.add(*change), m.rate(gauge))]
    return Case([*zeros, *([f.sub(f.add(*charge), s.key("charge"))] if "charge" in s.claim else [])])


def hamilton_jacobi(s: Statement) -> Case:
    """H(q, ∂S/∂q, t) + ∂S/∂t = 0, or H(q, ∂W/∂q) = energy; det ∂²S/∂q∂α isn't 0 everywhere."""
    f, word = s.f, "S" if "S" in s.claim else "W"
    s.on_old_side()
    S, constants = s.key(word), list(s.claim["constants"])
    energy = s.key("energy") if word == "W" else f.number(0)
    if word == "W":  # there is no energy where something moves with time
        s.without(energy, [*s.q, *s.p])
        for a in (S, energy, s.H):
            s.without(a, [s.time])
    if len(constants) < len(s.q) and f.ops[energy][0] == "s":
        constants.append(f.ops[energy][1])
    if not len({*constants}) == len(constants) == len(s.q) or {*constants} & {*s.q, *s.p, s.time, *f.functions}:
        raise Unreadable("as many constants as coordinates are needed, none of which moves")
    s.without(s.H, constants)
    s.without(S, s.p)
    momenta = {p: f.slope(S, q) for p, q in zip(s.p, s.q, strict=True)}
    other = f.slope(S, s.time) if word == "S" else f.mul(f.number(-1), energy)
    complete = s.determinant([[f.slope(p, a) for a in constants] for p in momenta.values()])
    names = {f.ops[a][1] for a in f.reach(complete) if f.ops[a][0] == "s"}
    generic = not s.surface and _is_generic(s, complete)  # on q = d the sine of q is 0 for some d
    whole = names <= {*s.q, *constants, s.time, "pi"} and generic
    trusted = "that the integral is complete for all values of the parameters, not only for those tried"
    sure = whole or is_nowhere_zero(s, complete) or _is_complete(s, S, constants, energy, word)
    trusted = "" if sure else trusted
    return Case([f.add(f.substitute(s.H, momenta), other)], [[complete]], momenta, trusted)


def _is_generic(s: Statement, a: int) -> bool:
    """Whether a formula that isn't 0 identically is so on no part of its domain, factor by factor.

    A rational function is none, nor is one that is analytic everywhere; |a| + a is, and √(a²) + a.
    """
    f, op = s.f, s.f.ops[a]
    if op[0] in "*^":
        return all(_is_generic(s, b) for b in f.parts(a))
    if op[:2] == ("f", "power") and f.value(op[3][1]) is not None:
        return _is_generic(s, op[3][0])
    inside = [f.ops[b] for b in f.reach(a)]
    entire = all(b[0] != "f" or b[1] in SMOOTH for b in inside) and all(b[0] != "^" or b[2] > 0 for b in inside)
    return entire or is_rational(s, a)


def _is_complete(s: Statement, S: int, constants: list[str], energy: int, word: str) -> bool:
    """Whether ∂²S/∂q∂α is regular by the equation itself: H_p · ∂(∂S/∂q)/∂α is the energy's slope by α, which is not 0.

    In two degrees of freedom a column with one entry is then not 0 in it, and the rest of the determinant is the other.
    """
    f, values = s.f, at_random(s)
    for k, a in enumerate(constants):
        level = f.slope(energy if word == "W" else f.slope(S, s.time), a)
        column = [f.slope(f.slope(S, q), a) for q in s.q]
        left = [i for i, x in enumerate(column) if not is_identity(values, x)]
        if not is_nowhere_zero(s, level) or len(left) != 1 or len(s.q) > 2:
            continue
        rest = [f.slope(f.slope(S, q), b) for i, q in enumerate(s.q) for j, b in enumerate(constants)
                if i not in left and j != k]  # fmt: skip
        if all(is_nowhere_zero(s, x) for x in rest):
            return True
    return False


def solves(s: Statement) -> Case:
    """The equations with formulas in place of the functions."""
    f, solution, hidden = s.f, {}, dict[str, list[int]]()
    for call, text in s.claim["solution"].items():
        op = f.ops[f.read(call, {})]
        if op[0] != "f" or op[1] not in f.functions or any(f.ops[a][0] != "s" for a in op[3]) or any(op[2]):
            raise Unreadable(f"{call[:40]!r} is no function of names")
        if len({*op[3]}) < len(op[3]) or op[1] in solution:
            raise Unreadable(f"{call[:40]!r}: a name, or the function, stands twice")
        before = len(f.unseen)
        solution[op[1]] = [f.ops[a][1] for a in op[3]], f.read(text, s.names)
        hidden[op[1]] = f.unseen[before:]
        s.conditions += _as_declared(s, op[1], s.pull(solution[op[1]][1]))
    if any(f.ops[a][0] == "f" and f.ops[a][1] in solution for _, body in solution.values() for a in f.reach(body)):
        raise Unreadable("a solution that contains what is to be solved for")
    equations = [s.pull(f.read(text, s.names)) for text in s.claim["equations"]]
    for a in equations:
        if all(f.ops[b][0] != "f" or f.ops[b][1] not in solution for b in f.reach(a, *f.unseen)):
            raise Unreadable("an equation without any of the functions that solve it")
    for op in (f.ops[a] for a in f.reach(*equations, *(s.pull(a) for a in f.unseen))):
        if op[0] == "f" and op[1] in solution:
            names, body = solution[op[1]]
            places = dict(zip(names, (f.put_in(x, solution) for x in op[3]), strict=True))
            s.written += [
                s.pull(b) for a in (body, *hidden[op[1]]) for b in (f.substitute(a, places), *f.at(a, places))
            ]
            s.conditions += _as_declared(s, op[1], s.pull(f.substitute(body, places)))
    return Case([s.pull(f.put_in(a, solution)) for a in equations])


def _as_declared(s: Statement, name: str, body: int) -> Iterator[tuple[int, str]]:
    """What a solution has to be, wherever it is looked at, to be a function as it is declared."""
    words = s.words[name]
    if "positive" in words or "negative" in words:
        yield (body if "positive" in words else s.f.mul(s.f.number(-1), body)), "positive"
    elif "nonzero" in words:
        yield body, "nonzero"


KINDS: dict[str, Callable[[Statement], Case | list[Case]]] = {
    **mechanics.KINDS,
    **matrices.KINDS,
    **actions.KINDS,
    **averages.KINDS,
    **calculus.KINDS,
    **normal_forms.KINDS,
    **variations.KINDS,
    "algebra": algebras.algebra,
    "matrix_algebra": algebras.matrix_algebra,
    "group": algebras.group,
    "dimension": dimensions.dimension,
    "constraint": constraints.constraint,
    "euler_lagrange": euler_lagrange,
    "noether": noether,
    "hamilton_jacobi": hamilton_jacobi,
    "solves": solves,
}
