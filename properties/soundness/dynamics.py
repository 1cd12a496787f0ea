"""Claims about Hamiltonians, brackets and fields that are true by construction, and mutants of them.

What a claim says is written as residuals by the textbook's rules; a mutant is false where mpmath finds one not 0.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from fractions import Fraction

from properties.soundness.formula import Formula, call, of, substituted, variable
from properties.soundness.maps import Map, canonical_map, slope, smooth
from properties.soundness.mutants import mutant
from properties.soundness.truth import Case, judged

Q, P = ("q1", "q2"), ("p1", "p2")
q1, q2, p1, p2, t, a, m = (variable(name) for name in (*Q, *P, "t", "a", "m"))
HALF = Fraction(1, 2)


def bracket(f: Formula, g: Formula, q: Sequence[str] = Q, p: Sequence[str] = P) -> Formula:
    """{f, g} by the textbook's rules."""
    total = of(0)
    for x, y in zip(q, p, strict=True):
        total = total + slope(f, x) * slope(g, y) - slope(f, y) * slope(g, x)
    return total


def file(
    claim: str, *, q: Sequence[str] = Q, p: Sequence[str] = P, sections: str = "", symbols: str = "", new: bool = False
) -> str:
    """A claim file with the parameters that `smooth` uses, and a positive m."""
    images = f"Q = {[x.upper() for x in q]}\nP = {[x.upper() for x in p]}\n" if new else ""
    return (
        f"[phase_space]\nq = {list(q)}\np = {list(p)}\n{images}[symbols]\na = 'real'\nm = 'positive'\n"
        f"{symbols}{sections}[[claim]]\n{claim}\n"
    )


def maybe(rng: random.Random, formula: Formula, share: float = 0.5) -> tuple[Formula, str]:
    """The formula, or a mutant of it and what was changed."""
    return mutant(rng, formula) if rng.random() < share else (formula, "")


def function_of(rng: random.Random, *arguments: Formula) -> Formula:
    """A smooth function of names, with formulas put in their places."""
    names = [variable(f"u{k}") for k in range(len(arguments))]
    return substituted(smooth(rng, names), {f"u{k}": value for k, value in enumerate(arguments)})


def _integrals(rng: random.Random) -> tuple[Formula, Formula]:
    """A Hamiltonian and a function that it conserves."""
    L, square, length, mixed = q1 * p2 - q2 * p1, p1**2 + p2**2, q1**2 + q2**2, q1 * p1 + q2 * p2
    kind = rng.randrange(4)
    if kind == 0:
        return square / (2 * m) + function_of(rng, length), function_of(rng, L)
    if kind == 1:
        return function_of(rng, mixed, square) + function_of(rng, length), function_of(rng, L)
    if kind == 2:
        return square / (2 * m), function_of(rng, p1, q2 - p2 * t / m)
    c, s = call("cos", t), call("sin", t)
    return (p1**2 + q1**2) * HALF + function_of(rng, p2), function_of(rng, q1 * c - p1 * s, p1 * c + q1 * s)


def conserved(rng: random.Random) -> Case | None:
    """∂f/∂t + {f, H} = 0."""
    H, f = _integrals(rng)
    f, what = maybe(rng, f)
    text = file(f'kind = "conserved"\nf = "{f}"', sections=f'[hamiltonian]\nH = "{H}"\n')
    rate = slope(f, "t") + bracket(f, H)
    return judged(rng, "conserved", text, [rate], (*Q, *P, "t", "a", "m"), changed=what, box={"m": (Fraction(0), None)})


def involution(rng: random.Random) -> Case | None:
    """Functions whose brackets all vanish."""
    L = q1 * p2 - q2 * p1
    functions = [function_of(rng, L), function_of(rng, p1**2 + p2**2), function_of(rng, L, p1**2 + p2**2)]
    k, what = rng.randrange(3), ""
    functions[k], what = maybe(rng, functions[k])
    residuals = [bracket(functions[i], functions[j]) for i, j in ((0, 1), (0, 2), (1, 2))]
    text = file(f'kind = "involution"\nfunctions = {[str(f) for f in functions]}'.replace("'", '"'))
    return judged(rng, "involution", text, residuals, (*Q, *P, "a"), changed=what)


def jacobi(rng: random.Random) -> Case | None:
    """A Poisson tensor ψ∇φ of three coordinates, or one that isn't quite: V · curl V = 0."""
    names = ("x", "y", "z")
    x, y, z = (variable(name) for name in names)
    potential, factor = x**2 + y**2 + smooth(rng, [x, y, z]), 1 + smooth(rng, [x, y, z]) ** 2
    V = [factor * slope(potential, name) for name in names]
    k = rng.randrange(3)
    V[k], what = maybe(rng, V[k])
    curl = [
        slope(V[2], "y") - slope(V[1], "z"),
        slope(V[0], "z") - slope(V[2], "x"),
        slope(V[1], "x") - slope(V[0], "y"),
    ]
    residual = V[0] * curl[0] + V[1] * curl[1] + V[2] * curl[2]
    tensor = [["0", str(V[2]), str(-V[1])], [str(-V[2]), "0", str(V[0])], [str(V[1]), str(-V[0]), "0"]]
    claim = f'kind = "jacobi"\nf = "x"\ng = "y"\nh = "z"\ncoordinates = {list(names)}\ntensor = {tensor}'
    text = file(claim.replace("'", '"')).replace(
        "m = 'positive'\n", "m = 'positive'\nx = 'real'\ny = 'real'\nz = 'real'\n"
    )
    return judged(rng, "jacobi", text, [residual], (*names, "a"), changed=what)


def _field(rng: random.Random) -> tuple[Formula, list[Formula], list[Formula]]:
    """A function of two degrees of freedom, its derivatives by p, and minus those by q."""
    every = [q1, q2, p1, p2]
    H = smooth(rng, every) + smooth(rng, every) * rng.choice(every)
    return H, [slope(H, name) for name in P], [-slope(H, name) for name in Q]


def _vector_field(rng: random.Random, kind: str) -> Case | None:
    """`infinitesimal`, `equations_of_motion` and `hamiltonian_field`: J∇H, or a mutant of one component."""
    H, right, down = _field(rng)
    components = [*right, *down]
    k = rng.randrange(4)
    components[k], what = maybe(rng, components[k])
    residuals = [f - g for f, g in zip(components, [*right, *down], strict=True)] if what else [of(0)]
    first, second = ([str(f) for f in part] for part in (components[:2], components[2:]))
    names = ("dq", "dp") if kind == "infinitesimal" else ("qdot", "pdot")
    keys = f"{names[0]} = {first}\n{names[1]} = {second}\n"
    sections = ""
    if kind == "infinitesimal":
        keys += f"generator = '{H}'\n"
    elif kind == "equations_of_motion":
        sections = f"[hamiltonian]\nH = '{H}'\n"
    elif rng.random() < 0.5:
        keys += f"H = '{H}'\n"
    else:
        order = (*Q, *P)
        down_up = [-components[2], -components[3], components[0], components[1]]
        residuals = [
            slope(down_up[i], order[j]) - slope(down_up[j], order[i]) for i in range(4) for j in range(i)
        ] if what else [of(0)]  # fmt: skip
    text = file(f'kind = "{kind}"\n{keys}'.replace("'", '"'), sections=sections.replace("'", '"'))
    return judged(rng, kind, text, residuals, (*Q, *P, "a"), changed=what)


def legendre(rng: random.Random) -> Case | None:
    """T(v) + A v − V with its Legendre transform; H mutated, or L without an invertible kinetic energy."""
    v1, v2 = variable("v1"), variable("v2")
    w, A, V = 2 + smooth(rng, [q1, q2]) ** 2, smooth(rng, [q1, q2]), smooth(rng, [q1, q2])
    if rng.random() < 0.2:
        L, H = v1 * A + v2 - V, V
        text = _legendre(L, H)
        return Case("legendre", text, False, "linear in the velocities")
    if rng.random() < 0.2:
        L, H, what = a * v1**2 * HALF + m * v2**2 * HALF - V, p2**2 / (2 * m) + p1**2 / (2 * a) + V, ""
        return Case("legendre", _legendre(L, H), True, "a isn't 0 where H is defined")
    if rng.random() < 0.3:
        L, H = call("exp", v1) + m * v2**2 * HALF + A, p1 * call("log", p1) - p1 + p2**2 / (2 * m) - A
    else:
        L, H = m * w * v1**2 * HALF + v2**2 * HALF + A * v1 - V, (p1 - A) ** 2 / (2 * m * w) + p2**2 * HALF + V
    changed, what = maybe(rng, H)
    box = {"m": (Fraction(0), None), "p1": (Fraction(0), None)}
    found = judged(rng, "legendre", _legendre(L, changed), [changed - H], (*Q, *P, "a", "m"), changed=what, box=box)
    return None if found is None else Case("legendre", found.text, found.truth, found.note)


def _legendre(L: Formula, H: Formula) -> str:
    return file(f'kind = "legendre"\nL = "{L}"\nvelocities = ["v1", "v2"]', sections=f'[hamiltonian]\nH = "{H}"\n')


def independent(rng: random.Random) -> Case | None:
    """Components of a canonical map are independent; with a function of them added they aren't."""
    made: Map = canonical_map(rng)
    while "potential" in made.factors or made.n < 2:
        made = canonical_map(rng)
    functions = list(made.functions)
    rng.shuffle(functions)
    functions = functions[: rng.randint(2, 3)]
    truth, note = True, "components of a canonical map"
    kind = rng.randrange(5)
    if kind == 0:
        functions[-1] = function_of(rng, *functions[:-1])
        truth, note = False, "a function of the others"
    elif kind == 1:
        functions[-1] = a * functions[-1] + functions[0]
        truth, note = False, "dependent at a = 0"
    elif kind == 2:
        f = functions[-1]
        functions[-1] = call("abs", f) + f
        truth, note = False, "constant where negative"
        if f.head not in ("var", "+", "*"):
            return None
        if "exp" in str(f) or "sqrt" in str(f) or "**" in str(f):
            truth = None
    where = [f"{name} > {low}" for name, (low, _) in made.box.items()]
    domain = f"[domain]\nwhere = {where}\n" if where else ""
    claim = f"kind = 'independent'\nfunctions = {[str(f) for f in functions]}"
    text = file(claim.replace("'", '"'), q=made.q, p=made.p, sections=domain)
    return Case("independent", text, truth, note)


def _kind(name: str) -> Callable[[random.Random], Case | None]:
    return lambda rng: _vector_field(rng, name)


DYNAMICS: dict[str, Callable[[random.Random], Case | None]] = {
    "conserved": conserved,
    "involution": involution,
    "jacobi": jacobi,
    "legendre": legendre,
    "independent": independent,
    **{name: _kind(name) for name in ("infinitesimal", "equations_of_motion", "hamiltonian_field")},
}
"""Families by name, each a function of a random stream."""
