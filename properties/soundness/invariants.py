"""Claims about what a map leaves alone: volumes, invariants, forms, Hamiltonians; true by construction, or spoiled."""

from __future__ import annotations

import random
from collections.abc import Callable
from fractions import Fraction

from properties.soundness.dynamics import function_of, maybe
from properties.soundness.formula import Formula, call, of, substituted, variable
from properties.soundness.maps import Map, canonical_map, pick, slope, smooth
from properties.soundness.truth import Case, judged

NEAR = (Fraction(1001, 1000), Fraction(999, 1000), 1 + Fraction(1, 10**6), 2, Fraction(1, 2), -1)
SMALL = (Fraction(1, 1000), Fraction(1, 10**6), 1)


def _map(rng: random.Random, degrees: tuple[int, ...] = (1, 2, 3)) -> Map:
    made = canonical_map(rng)
    while "potential" in made.factors or made.n not in degrees:
        made = canonical_map(rng)
    return made


def _text(made: Map, functions: list[Formula], claim: str, sections: str = "", symbols: str = "") -> str:
    n = made.n
    where = [f"{name} > {low}" for name, (low, _) in made.box.items()]
    domain = f"[domain]\nwhere = {where}\n" if where else ""
    new = [[f"{letter}{k + 1}" for k in range(n)] for letter in "QP"]
    return (
        f"[phase_space]\nq = {list(made.q)}\np = {list(made.p)}\nQ = {new[0]}\nP = {new[1]}\n"
        f"[symbols]\na = 'real'\n{symbols}{domain}{sections}"
        f"[transformation]\nQ = {[str(f) for f in functions[:n]]}\nP = {[str(f) for f in functions[n:]]}\n"
        f"[[claim]]\n{claim}\n"
    )


def volume(rng: random.Random) -> Case:
    """A triangular map of determinant 1, which need not be canonical, after one; or one stretched a little."""
    made = _map(rng)
    new = [variable(f"u{k}") for k in range(2 * made.n)]
    for k in range(1, 2 * made.n):
        if rng.random() < 0.5:
            new[k] = new[k] + smooth(rng, new[:k][-2:])
    images = {f"u{k}": f for k, f in enumerate(made.functions)}
    functions = [substituted(f, images) for f in new]
    truth, note = True, "triangular"
    if rng.random() < 0.5:
        k, factor = rng.randrange(2 * made.n), rng.choice(NEAR)
        functions[k] = factor * functions[k]
        truth, note = factor == -1, f"times {factor}"
    return Case("volume", _text(made, functions, "kind = 'volume'"), truth, note)


def integral_invariant(rng: random.Random) -> Case:
    """Pairs scaled one by one: the power of order k is preserved when each product of k different scales is 1."""
    made = _map(rng, (2, 3))
    c = Fraction(rng.choice(NEAR))
    scales = rng.choice(([c, 1 / c, 1], [c, c, c], [-1, -1, 1], [-1, -1, -1], [1, 1, 1], [c, 1 / c, c]))[: made.n]
    rng.shuffle(scales)
    functions = list(made.functions)
    for k, scale in enumerate(scales):
        side = k + made.n * rng.randrange(2)
        functions[side] = scale * functions[side]
    order = rng.randint(1, made.n)
    products = {1: scales, 2: [scales[i] * scales[j] for i in range(made.n) for j in range(i)]}
    whole = scales[0] * scales[1] * (scales[2] if made.n == 3 else 1)
    truth = all(product == 1 for product in (products[order] if order < made.n else [whole]))
    claim = f"kind = 'integral_invariant'\norder = {order}"
    return Case("integral_invariant", _text(made, functions, claim), truth, f"scales {[str(c) for c in scales]}")


def bracket_invariance(rng: random.Random) -> Case:
    """{Q, P} of a pair in old and in new variables, where the pair was scaled or not."""
    made = _map(rng)
    k, factor = rng.randrange(made.n), rng.choice((1, *NEAR))
    functions = list(made.functions)
    functions[k] = factor * functions[k]
    claim = f"kind = 'bracket_invariance'\nf = 'Q{k + 1}'\ng = 'P{k + 1} + 3*Q{k + 1}**2'"
    return Case("bracket_invariance", _text(made, functions, claim), factor == 1, f"times {factor}")


def canonical_when(rng: random.Random) -> Case:
    """One function multiplied by what is 1 at c = c0 alone."""
    made = _map(rng)
    k, c, c0 = rng.randrange(2 * made.n), variable("c"), Fraction(rng.choice((1, 2, -1, Fraction(1, 3))))
    functions = list(made.functions)
    functions[k] = (
        rng.choice((c / c0, 1 + (c - c0) * rng.choice((1, Fraction(1, 1000))), call("exp", c - c0))) * functions[k]
    )
    right = rng.random() < 0.5
    at = c0 if right else c0 + rng.choice((Fraction(1, 1000), Fraction(-1, 10**6), 1 if c0 != -1 else 2))
    claim = f"kind = 'canonical_when'\nsolutions = [{{c = '{at}'}}]"
    return Case("canonical_when", _text(made, functions, claim, symbols="c = 'real'\n"), right, f"{at} for {c0}")


def _gauge(rng: random.Random) -> tuple[Map, list[Formula], Formula, Formula]:
    """P = p + ∂S/∂q with S(q, t), some H(q, p), and K∘(map) = H − ∂S/∂t in the new variables."""
    made = Map(("q1", "q2"), ("p1", "p2"), ())
    q, p, t = [variable(name) for name in made.q], [variable(name) for name in made.p], variable("t")
    S = smooth(rng, [*q, t]) + smooth(rng, q) * t
    H = function_of(rng, *p) + smooth(rng, q)
    functions = [*q, *(y + slope(S, x) for x, y in zip(made.q, p, strict=True))]
    names = {x: variable(f"Q{k + 1}") for k, x in enumerate(made.q)}
    moved = {y: variable(f"P{k + 1}") - substituted(slope(S, f"q{k + 1}"), names) for k, y in enumerate(made.p)}
    K = substituted(H, {**names, **moved}) - substituted(slope(S, "t"), names)
    return made, functions, H, K


def cartan_invariant(rng: random.Random) -> Case | None:
    """A gauge transformation with its K; a mutant of K; or the flux of a solenoid, closed and not exact."""
    made, functions, H, K = _gauge(rng)
    kind, note = rng.randrange(4), ""
    sections = f"[hamiltonian]\nH = '{H}'\n"
    if kind == 0:
        return _flux(rng)
    if kind == 1:
        k = rng.randrange(1, 3)
        K, note = (
            K + rng.choice((Fraction(1, 1000), Fraction(1, 10**6), 1)) * variable(f"Q{k}") ** 2,
            "K has a term more",
        )
    if kind == 2:
        functions[2], note = (
            functions[2] + rng.choice((Fraction(1, 1000), Fraction(1, 10**6))) * variable("q2"),
            "not closed",
        )
    name = rng.choice(("cartan_invariant", "new_hamiltonian"))
    text = _text(made, functions, f"kind = '{name}'\nK = '{K}'", sections)
    return Case(name, text, not note, note or "gauge transformation")


def _flux(rng: random.Random) -> Case:
    """An angle's differential round a point: exact on half-planes and slit planes that don't surround it."""
    made = Map(("q1", "q2"), ("p1", "p2"), ())
    x, y = variable("q1") - pick(rng), variable("q2") - rng.choice((of(0), pick(rng)))
    c = rng.choice((pick(rng), of(Fraction(1, 10**6)), variable("m")))
    S = smooth(rng, [variable("q1"), variable("q2")])
    square = x**2 + y**2
    functions = [
        variable("q1"),
        variable("q2"),
        variable("p1") + slope(S, "q1") - c * y / square,
        variable("p2") + slope(S, "q2") + c * x / square,
    ]
    where, truth = rng.choice(
        (
            ([], False),
            ([f"{x} > 0"], True),
            ([f"{y} > {x}"], True),
            ([f"{square} > 1"], False),
            ([f"{square} > 1", f"{y} < 0"], True),
            ([f"{square} > 1", f"{square} < 2"], False),
            ([f"{y} > -1"], False),
            ([f"atan2({y}, {x}) < 3"], True),
            ([f"atan2({y} + 2*{x}, {x}) < 4"], True),
            ([f"atan2({y}, {x} - 3) < 4"], True),
            ([f"atan2({y}, {x} + 3) < 4"], False),
            ([f"atan2({y} - 1, {x}) < 4"], False),
            ([f"atan2(p1*exp(q2) + {y}, {x}) < 4"], False),
            ([f"{x}**2 > 1"], True),
            ([f"{x}*{y} > 0"], True),
            ([f"{x}*{y} > -1"], False),
            ([f"{x} > {y}**2"], True),
            ([f"{x} > {y}**2 - 1"], False),
            ([f"{x} > -1", f"{x} < 1"], False),
            ([f"p1 > {x}", "p2**2 > q1"], False),
            ([f"({square} - 1)**2 > 0"], False),
            ([f"{square} > t"], False),
            ([f"{square} > t", "t > 1"], False),
            ([f"{x} > t", "t > 1"], True),
            ([f"exp({x}) > 1 + {y}**2"], True),
            ([f"sqrt({square}) + {x} > 0"], True),
            ([f"sqrt({square} + 1) + {x} > 0"], False),
            ([f"log({square} + {y}**2) > 0"], False),
            ([f"({square})*p1 > p2"], False),
        )
    )
    sections = (f"[domain]\nwhere = {where}\n" if where else "") + "[hamiltonian]\nH = '0'\n"
    text = _text(made, functions, "kind = 'cartan_invariant'\nK = '0'", sections, "m = 'positive'\n")
    return Case("cartan_invariant", text, truth, f"flux, where {where}")


def symmetry(rng: random.Random) -> Case | None:
    """A rotation and an H that it leaves alone, or a mutant of H: false where H(Q, P) − H(q, p) varies."""
    made = Map(("q1", "q2"), ("p1", "p2"), ())
    q1, q2, p1, p2 = (variable(name) for name in made.variables)
    c, s = (of(Fraction(3, 5)), of(Fraction(4, 5))) if rng.random() < 0.5 else (call("cos", variable("a")),
                                                                            call("sin", variable("a")))  # fmt: skip
    functions = [c * q1 + s * q2, c * q2 - s * q1, c * p1 + s * p2, c * p2 - s * p1]
    H = function_of(rng, p1**2 + p2**2) + function_of(rng, q1**2 + q2**2, q1 * p2 - q2 * p1)
    H, what = maybe(rng, H)
    moved = substituted(H, dict(zip(made.variables, functions, strict=True)))
    text = _text(made, functions, "kind = 'symmetry'", f"[hamiltonian]\nH = '{H}'\n")
    residuals = [slope(moved, name) - slope(H, name) for name in made.variables] if what else [of(0)]
    found = judged(rng, "symmetry", text, residuals, (*made.variables, "a"), changed=what)
    return found


INVARIANTS: dict[str, Callable[[random.Random], Case | None]] = {
    "volume": volume,
    "integral_invariant": integral_invariant,
    "bracket_invariance": bracket_invariance,
    "canonical_when": canonical_when,
    "cartan_invariant": cartan_invariant,
    "symmetry": symmetry,
}
"""Families by name, each a function of a random stream."""
