"""What a claim asks for, kind by kind: formulas that must vanish, and such that must not."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from itertools import combinations
from math import factorial

from canon.checker.case import Case, whole
from canon.checker.defined import bounding, shared, unseen
from canon.checker.everywhere import is_exact, is_nearly
from canon.checker.followed import FAILURES, at_random, is_identity
from canon.checker.functions import Unknown, Unreadable
from canon.checker.poisson import brackets
from canon.checker.positive import is_nowhere_zero
from canon.checker.ratios import multiple
from canon.checker.regular import is_regular
from canon.checker.shapes import is_rational, is_smooth, is_smooth_there
from canon.checker.statement import Statement

FLAT = "that the Hessian of L isn't 0 on a part of the domain, nor at any values of the parameters"


def canonical(s: Statement) -> Case:
    """Brackets, or their Taylor coefficients up to an order; of a generating function, its mixed Hessian too."""
    f, claimed = s.f, s.key("scale") if "scale" in s.claim else s.f.number(1)
    if f.value(claimed) == 0 or any(f.ops[b][0] == "f" and f.ops[b][1] in f.functions for b in f.reach(claimed)):
        raise Unreadable("a scale is nowhere 0, and made of parameters alone")
    trusted = "" if is_nowhere_zero(s, claimed) else "that the scale vanishes nowhere"
    zeros, _ = s.brackets(claimed)
    if s.direction == "implicit":
        return Case([*zeros, f.sub(claimed, f.number(1))], [[hessian(s)]])
    if "order" in s.claim:
        name, order = s.claim["order"]
        powers = range(whole(order) + 1)
        images = {s.parameter(name): f.number(0)}
        _analytic(s, s.images.values(), images)
        return Case(
            [c for z in zeros for c in taylor(s, z, name, powers)], images=images, trusted=trusted, against=trusted
        )
    labels = bracket_labels(s, str(s.claim.get("scale", 1)))
    return Case(zeros, labels=labels, trusted=trusted, against=trusted)


def bracket_labels(s: Statement, scale: str = "c") -> list[str]:
    """The names of the brackets of an explicit map, less what they are to be."""
    names, one = (
        ((*s.Q, *s.P), scale) if s.direction == "forward" else ((*s.q, *s.p), "1" if scale == "1" else f"1/({scale})")
    )
    pairs, half = combinations(range(len(names)), 2), len(names) // 2
    return [f"bracket({names[i]}, {names[j]}){f' - {one}' if j == i + half else ''}" for i, j in pairs]


def hessian(s: Statement) -> int:
    """The mixed Hessian's determinant of a generating function."""
    old, new = s.coordinates[: len(s.q)], s.coordinates[len(s.q) :]
    return s.determinant([[s.f.slope(s.f.slope(s.generating[1], a), b) for b in new] for a in old])


def taylor(s: Statement, a: int, name: str, orders: Iterable[int]) -> list[int]:
    """Taylor coefficients at 0."""
    f, found = s.f, []
    if max(orders) > 40:
        raise Unknown(f"a series to the order {max(orders)}")
    for k in range(max(orders) + 1):
        if k in orders:
            found.append(f.mul(f.over(f.number(1), f.number(factorial(k))), f.substitute(a, {name: f.number(0)})))
        a = f.slope(a, name)
    return found


def _analytic(s: Statement, targets: Iterable[int], at: Mapping[str, int]) -> None:
    """Refuse a series of what isn't seen to be analytic. Raises Unknown."""
    if not is_regular(s, [*(s.pull(a) for a in targets), *unseen(s)], at, own=True):
        raise Unknown("a series of what isn't seen to be analytic at its place")


def canonical_when(s: Statement) -> list[Case]:
    """Canonical at each solution, and not elsewhere."""
    zeros, _ = s.brackets(s.f.number(1))
    tables = [
        {s.parameter(name): s.f.read(text, s.names) for name, text in table.items()} for table in s.claim["solutions"]
    ]
    trusted = "that it fails at almost all values of the parameters, and not only at those tried"
    return [Case([s.f.substitute(z, t) for z in zeros], images=t) for t in tables] + [
        Case([], [zeros], trusted="" if all(is_rational(s, z) for z in zeros) else trusted)
    ]


def new_hamiltonian(s: Statement) -> Case:
    """Canonical with a constant scale c, and the gradient of K - cH, with what moves with time, is 0."""
    f, H = s.f, s.H
    if s.claim["kind"] == "symmetry":
        renamed = zip((*s.q, *s.p), (*s.Q, *s.P), strict=True)
        K = f.substitute(H, {a: f.node("s", b) for a, b in renamed})
        s.written.append(K)
    else:
        K = s.key("K")
    zeros, c = s.brackets(None)
    zeros += [f.slope(c, u) for u in (*s.coordinates, s.time)]
    difference = f.sub(s.pull(K), f.mul(c, s.pull(H)))
    for u in s.coordinates:
        moved = [dragged(s, X, u) for X in (s.new, s.old)]
        zeros.append(f.add(f.slope(difference, u), f.sub(moved[0], f.mul(c, moved[1]))))
    labels = [*(bracket_labels(s) if s.direction != "implicit" else [f"b_{k}" for k in range(len(s.lagrange(s.new)))])]
    labels += [*(f"D(c, {u})" for u in (*s.coordinates, s.time)), *(f"residual_{u}" for u in s.coordinates)]
    apart = is_nowhere_zero(s, c) and (s.direction == "forward" or is_nowhere_zero(s, f.over(f.number(1), c)))
    constant = s.direction == "implicit" or apart or _is_one_number(s, c) or _is_one(s, K)
    trusted = "" if constant else "that the scale vanishes nowhere"
    return Case(zeros, [[hessian(s) if s.direction == "implicit" else c]], labels=labels, trusted=trusted)


def _is_one(s: Statement, K: int) -> bool:
    """Whether a scale is 1 as K is H: ∂(K − c H) is 0 then, and ∂H nowhere."""
    f, H = s.f, s.pull(s.H)
    still = all(f.ops[b] != ("s", s.time) for b in f.reach(*s.old, *s.new))
    steep = any(is_nowhere_zero(s, f.slope(H, u)) for u in s.coordinates)
    return still and steep and is_identity(at_random(s), f.sub(s.pull(K), H))


def _is_one_number(s: Statement, c: int) -> bool:
    """Whether a scale that doesn't change, and isn't 0 at some point, is 0 nowhere: it is rational, in no parameter, or
    by the rules for functions a number."""
    if is_rational(s, c, [*s.coordinates, s.time]):
        return True
    values = at_random(s)
    try:
        return bool(multiple(values.value(c), values.one, values.t.prime))
    except FAILURES:
        return False


def dragged(s: Statement, X: list[int], u: str) -> int:
    """Σ ∂q/∂u ∂p/∂t − ∂p/∂u ∂q/∂t."""
    f, half, t = s.f, len(X) // 2, s.time
    return f.add(*(f.sub(f.mul(f.slope(a, u), f.slope(b, t)), f.mul(f.slope(b, u), f.slope(a, t)))
                   for a, b in zip(X[:half], X[half:], strict=True)))  # fmt: skip


def volume(s: Statement) -> Case:
    """The Pfaffians of Lagrange's brackets, of which the determinant is the quotient, differ by a phase."""
    everything = range(len(s.coordinates))
    new, old = (s.pfaffian(s.lagrange(X), everything) for X in (s.new, s.old))
    phase = s.known.get("determinant")
    if phase not in ("1", "-1", "1j", "-1j"):
        return Case([s.f.sub(s.f.call("abs", [], [new]), s.f.call("abs", [], [old]))], _not_singular(s))
    return Case([s.f.sub(new, s.f.mul(s.f.read(phase, {}), old))], _not_singular(s))


def _not_singular(s: Statement) -> list[list[int]]:
    """What mustn't vanish everywhere for a generating function to define a map."""
    return [[hessian(s)]] if s.direction == "implicit" and s.verdict == "proved" else []


def integral_invariant(s: Statement) -> Case:
    """The Pfaffians of so many of Lagrange's brackets agree."""
    order = whole(s.claim.get("order", 1), 1)
    if order > len(s.q):
        raise Unreadable(f"an invariant of order {order} of {len(s.q)} degrees of freedom")
    rows = combinations(range(len(s.coordinates)), 2 * order)
    new, old = (s.lagrange(X) for X in (s.new, s.old))
    return Case([s.f.sub(s.pfaffian(new, r), s.pfaffian(old, r)) for r in rows], _not_singular(s))


def cartan_invariant(s: Statement) -> Case:
    """p dq - H dt - (P dQ - K dt) is the differential of a potential; where none is known, it is closed."""
    f, names, K, H = s.f, [*s.coordinates, s.time], s.pull(s.key("K")), s.pull(s.H)
    slopes = []
    for u in names:
        terms = [f.mul(X[i + len(X) // 2], f.slope(X[i], u)) for X in (s.old, s.new) for i in range(len(X) // 2)]
        half = len(s.old) // 2
        moved = f.sub(K, H) if u == s.time else f.number(0)
        slopes.append(f.add(moved, f.sub(f.add(*terms[:half]), f.add(*terms[half:]))))
    if isinstance(s.known.get("potential"), str):
        W = f.apart(s.known["potential"], {})
        s.added.append(W)
        trusted = "" if is_smooth_there(s, W) else "that the potential is smooth throughout the domain"
        zeros = [f.sub(slope, f.slope(W, u)) for u, slope in zip(names, slopes, strict=True)]
        return Case(zeros, _not_singular(s), trusted=trusted)
    pairs = combinations(range(len(names)), 2)
    zeros = [f.sub(f.slope(slopes[j], names[i]), f.slope(slopes[i], names[j])) for i, j in pairs]
    exact = is_exact(s, [*s.old, *s.new, K, H])
    trusted = "" if exact else "that the form, which is closed, is exact"
    return Case(zeros, _not_singular(s), trusted=trusted)


def bracket_invariance(s: Statement) -> Case:
    """{f, g} in the old variables is {f, g} in the new ones."""
    if (
        s.direction == "backward" and len(s.q) == 1 and s.verdict == "proved"
    ):  # {f, g} = {q, p} times what it is in the old variables
        f, g, pairs = s.key("f"), s.key("g"), list(zip(s.Q, s.P, strict=True))
        jacobian = s.f.bracket(s.old[0], s.old[1], pairs)
        return Case([s.f.mul(s.f.bracket(f, g, pairs), s.f.sub(jacobian, s.f.number(1)))], [[jacobian]])
    if s.direction != "forward":
        raise Unknown("invariance of brackets for a map that isn't given forward")
    f, g, pairs = s.key("f"), s.key("g"), list(zip(s.Q, s.P, strict=True))
    inner = s.pull(s.f.bracket(f, g, pairs))
    return Case([s.f.sub(s.f.bracket(s.pull(f), s.pull(g), s.f.pairs), inner)])


def generates(s: Statement) -> Case:
    """The equations of a generating function along the map."""
    types, F = (s.claim["type"], s.key("F")) if s.claim["kind"] == "generating_function" else s.generating
    s.written.append(F)
    equations = list(s.equations(types, F))
    labels = [f"{name} {'-' if name in s.p or name in s.Q else '+'} D(F, {u})" for name, u, _ in equations]
    return Case([s.pull(s.f.sub(s.f.node("s", name), slope)) for name, _, slope in equations], labels=labels)


def identity(s: Statement) -> Case:
    """lhs - rhs."""
    return Case([s.pull(s.f.sub(s.key("lhs"), s.key("rhs")))], labels=["lhs - rhs"])


def independent(s: Statement) -> Case:
    """A minor of the functions' derivatives doesn't vanish."""
    variables = (*s.q, *s.p)
    rows = [[s.pull(s.f.slope(a, x)) for x in variables] for a in s.keys("functions")]
    columns = combinations(range(len(variables)), len(rows))
    minors = [s.determinant([[row[k] for k in chosen] for row in rows]) for chosen in columns]
    trusted = "that a minor, which is not 0 at some points, is not 0 on any component of the domain"
    trusted = "" if is_nearly(s, minors, s.coordinates) else trusted
    return Case([], [minors or [s.f.number(0)]], trusted=trusted)


def lie_series(s: Statement) -> Case:
    """The value at 0 and the equation of the flow; with an order, the Taylor coefficients."""
    f, name, G, x, given = s.f, s.parameter(s.claim["parameter"]), s.key("generator"), s.key("f"), s.key("equals")
    if any(f.ops[a] == ("s", name) for a in f.reach(G, x)):
        raise Unreadable(f"the generator, or f, depends on {name[:40]!r}")
    order = s.claim.get("order", s.known.get("fails_at_order"))
    order = None if order is None else whole(order)
    if order is None:
        start = f.substitute(given, {name: f.number(0)})
        s.written.append(start)  # it has to have a value, too
        bound = any(f.ops[b] == ("s", name) for a, _ in s.conditions for b in f.reach(a))
        bound = bound or bool(bounding(s, [name]))
        sure = not bound and is_regular(s, [s.pull(given), *unseen(s), *shared(s)], {name: f.number(0)}, own=True)
        trusted = "" if sure else f"that {name} may be 0, and the series is analytic there"
        flow = f.sub(f.slope(given, name), f.bracket(given, G, f.pairs))
        smooth = is_smooth(s, s.pull(given), name) and not any(f.ops[b][1] in f.functions for b in f.reach(given))
        against = "" if smooth else "that the point speaks of the germ, as the series may not be analytic up to it"
        return Case([s.pull(f.sub(start, x)), s.pull(flow)], trusted=trusted, against=against)
    _analytic(s, [given], {name: f.number(0)})
    zeros = []
    for k, c in enumerate(taylor(s, given, name, range(order + 1))):
        zeros.append(s.pull(f.sub(c, f.over(x, f.number(factorial(k))))))
        x = f.bracket(x, G, f.pairs)
    rest = given
    for _ in range(order + 1 if "order" in s.claim else 0):
        rest = f.slope(rest, name)
    return Case([*zeros, s.pull(rest)] if "order" in s.claim else zeros, images={name: f.number(0)})


def field_of(s: Statement) -> Case:
    """equations_of_motion, infinitesimal, hamiltonian_field: J∇H is the field, or a field's form is closed."""
    f, kind = s.f, s.claim["kind"]
    words = ("dq", "dp") if kind == "infinitesimal" else ("qdot", "pdot")
    first, second = (s.keys(word) if isinstance(s.claim[word], list) else [s.key(word)] for word in words)
    if len(first) != len(s.q) or len(second) != len(s.p):
        raise Unreadable("a component is needed for each variable")
    if kind == "hamiltonian_field" and "H" not in s.claim:
        names, slopes = [*s.q, *s.p], [f.mul(f.number(-1), x) for x in second] + first
        curls = combinations(range(len(names)), 2)
        return Case([s.pull(f.sub(f.slope(slopes[j], names[i]), f.slope(slopes[i], names[j]))) for i, j in curls])
    H = s.H if kind == "equations_of_motion" else s.key("generator" if kind == "infinitesimal" else "H")
    zeros = [f.sub(f.slope(H, p), x) for p, x in zip(s.p, first, strict=True)]
    zeros += [f.add(f.slope(H, q), x) for q, x in zip(s.q, second, strict=True)]
    labels = [
        *(f"D(H, {p}) - {x}_dot" for x, p in zip(s.q, s.p, strict=True)),
        *(f"D(H, {x}) + {p}_dot" for x, p in zip(s.q, s.p, strict=True)),
    ]
    return Case([s.pull(z) for z in zeros], labels=labels if kind == "equations_of_motion" else [])


def legendre(s: Statement) -> Case:
    """H with p = ∂L/∂v is p v - L, and the Hessian of L by the velocities doesn't vanish everywhere."""
    if s.direction in ("implicit", "backward"):
        s.on_old_side()
    f, L, v = s.f, s.key("L"), s.claim["velocities"]
    s.without(s.H, v)
    s.without(L, s.p)
    momenta = {p: f.slope(L, x) for p, x in zip(s.p, v, strict=True)}
    energy = f.sub(f.add(*(f.mul(f.node("s", x), y) for x, y in zip(v, momenta.values(), strict=True))), L)
    rows = [[f.slope(y, x) for x in v] for y in momenta.values()]
    hessian_of = s.determinant(rows)
    trusted = "" if is_nearly(s, [hessian_of], [*s.q, *v, s.time]) else FLAT
    return Case([f.sub(f.substitute(s.H, momenta), energy)], [[hessian_of]], momenta, trusted)


KINDS: dict[str, Callable[[Statement], Case | list[Case]]] = {
    "canonical": canonical, "fundamental_brackets": canonical, "canonical_when": canonical_when,
    "new_hamiltonian": new_hamiltonian, "symmetry": new_hamiltonian, "volume": volume, "identity": identity,
    "integral_invariant": integral_invariant, "cartan_invariant": cartan_invariant, "lie_series": lie_series,
    "bracket_invariance": bracket_invariance, "generates": generates, "generating_function": generates,
    "bracket": brackets, "jacobi": brackets, "conserved": brackets, "involution": brackets, "casimir": brackets,
    "legendre": legendre, "independent": independent, "equations_of_motion": field_of, "infinitesimal": field_of,
    "hamiltonian_field": field_of,
}  # fmt: skip
