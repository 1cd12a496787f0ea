"""Random cases: a claim file with one claim, and what the oracle knows of its truth."""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any

import mpmath as mp

from properties.soundness import oracle
from properties.soundness.dynamics import DYNAMICS
from properties.soundness.formula import DIGITS, Formula, Outside, call, names, of, value, variable
from properties.soundness.identities import Equation, equation
from properties.soundness.invariants import INVARIANTS
from properties.soundness.maps import Map, canonical_map, pick, slope, smooth
from properties.soundness.mutants import NEAR, mutant
from properties.soundness.series import SERIES
from properties.soundness.truth import Case, gap, numbers


def case(seed: int) -> Case | None:
    """The case of a seed; None where the draw is no claim (an equation that is defined nowhere)."""
    rng = random.Random(seed)
    own = ("map",) * 5 + ("mutant",) * 6 + ("identity",) * 7 + ("generating", "surface", "bracket")
    family = rng.choice((*own, *KINDS_OF_CLAIMS))
    made = {
        "map": _true_map, "mutant": _mutant, "identity": _identity, "generating": _generating, "surface": _surface,
        "bracket": _bracket, **KINDS_OF_CLAIMS,
    }  # fmt: skip
    return made[family](rng)


KINDS_OF_CLAIMS: dict[str, Callable[[random.Random], Case | None]] = {**DYNAMICS, **SERIES, **INVARIANTS}


# -- maps -----------------------------------------------------------------------------------------

KINDS = (
    "canonical", "canonical", "canonical", "fundamental_brackets", "volume", "integral_invariant", "new_hamiltonian",
    "bracket_invariance",
)  # fmt: skip


def _space(made: Map, backward: bool) -> str:
    n = made.n
    new = [f"Q{k + 1}" for k in range(n)], [f"P{k + 1}" for k in range(n)]
    (q, p), (Q, P) = ((made.q, made.p), new)
    if backward:
        (q, p), (Q, P) = new, (made.q, made.p)
    function = "V = 'function'\n" if "potential" in made.factors else ""
    return (
        f"[phase_space]\nq = {list(q)}\np = {list(p)}\nQ = {list(Q)}\nP = {list(P)}\n[symbols]\na = 'real'\n{function}"
    )


def _file(made: Map, functions: tuple[Formula, ...], claim: str, *, backward: bool, extra: str = "") -> str:
    n = made.n
    words = ("q", "p") if backward else ("Q", "P")
    where = [f"{name} > {low}" for name, (low, _) in made.box.items()]
    domain = f"[domain]\nwhere = {where}\n" if where else ""
    first, second = ([str(f) for f in part] for part in (functions[:n], functions[n:]))
    return (
        f"{_space(made, backward)}{domain}{extra}[transformation]\n{words[0]} = {first}\n{words[1]} = {second}\n"
        f"[[claim]]\n{claim}\n"
    )


def _claim(rng: random.Random, made: Map, backward: bool, scale: Fraction | int) -> tuple[str, str]:
    """(the claim's text, further sections) of a map that is canonical with this scale."""
    if scale != 1:
        given = 1 / Fraction(scale) if backward else scale
        return f'kind = "canonical"\nscale = "{given}"', ""
    kind = rng.choice(KINDS)
    if kind == "integral_invariant":
        return f'kind = "{kind}"\norder = {rng.randint(1, made.n)}', ""
    if kind == "bracket_invariance":
        new = [variable(f"{word}{k + 1}") for word in "QP" for k in range(made.n)]
        if backward:
            new = [variable(name) for name in made.variables]
        return f'kind = "{kind}"\nf = "{rng.choice(new) * rng.choice(new)}"\ng = "{rng.choice(new) + 1}"', ""
    if kind == "new_hamiltonian":
        if backward:
            return 'kind = "canonical"', ""
        k = rng.randrange(made.n)
        H = made.functions[k] ** 2
        return f'kind = "{kind}"\nK = "Q{k + 1}**2"', f'[hamiltonian]\nH = "{H}"\n'
    return f'kind = "{kind}"', ""


def _true_map(rng: random.Random) -> Case:
    made = canonical_map(rng)
    scale = rng.choice((1, 1, 1, 1, 2, -1, Fraction(1, 3)))
    functions = tuple(scale * f if scale != 1 and k < made.n else f for k, f in enumerate(made.functions))
    backward = rng.random() < 0.2
    claim, extra = _claim(rng, made, backward, scale)
    text = _file(made, functions, claim, backward=backward, extra=extra)
    return Case("map", text, True, " ".join(made.factors), _defect(made, functions, scale))


def _defect(made: Map, functions: tuple[Formula, ...], scale: Any) -> Callable[[Mapping[str, Any]], bool | None]:
    def confirm(point: Mapping[str, Any]) -> bool | None:
        with mp.workdps(DIGITS):
            place = numbers(point)
            if place is None or not {*made.variables} <= set(place) or "potential" in made.factors:
                return None
            place.setdefault("a", mp.mpf(1))
            try:
                number = mp.mpf(scale.numerator) / scale.denominator
                return oracle.fails_at(functions, made.variables, place, number, close=True)
            except (Outside, ZeroDivisionError):
                return None

    return confirm


def _mutant(rng: random.Random) -> Case | None:
    made = canonical_map(rng)
    functions, what = list(made.functions), "swapped pair"
    if rng.random() < 0.1:
        k = rng.randrange(made.n)
        functions[k], functions[k + made.n] = functions[k + made.n], functions[k]
    else:
        k = rng.randrange(2 * made.n)
        functions[k], what = mutant(rng, functions[k])
    changed = tuple(functions)
    point, seen = oracle.not_canonical(rng, changed, made.variables, (*made.variables, "a"), made.box)
    if not seen:
        return None
    truth = False if point is not None else None
    kind = rng.choice(("canonical", "canonical", "fundamental_brackets"))
    text = _file(made, changed, f'kind = "{kind}"', backward=rng.random() < 0.2)
    note = f"{' '.join(made.factors)}: {what}"
    return Case("mutant", text, truth, note, _defect(made, changed, 1))


# -- equations --------------------------------------------------------------------------------------


def _end(bound: Any) -> str:
    if isinstance(bound, str):
        return f"({bound.removesuffix('pi')})*pi"
    return f"({bound})" if bound < 0 else str(bound)


def equation_file(found: Equation, on: tuple[Formula, ...] = ()) -> str:
    """The claim file of an equation."""
    used = names(found.lhs) | names(found.rhs) | {n for f in (*found.positive, *on) for n in names(f)}
    used |= set(found.box)
    lines = ["[phase_space]", 'q = ["Z1"]', 'p = ["Z2"]', "[symbols]"]
    lines += [f"{name} = {words.split()}" for name, words in found.words.items() if name in used]
    lines += [f"{name} = 'function'" for name in ("V", "W") if f"{name}(" in f"{found.lhs}{found.rhs}"]
    where = []
    for name, (low, high) in found.box.items():
        where += [f"{_end(low)} < {name}"] if low is not None else []
        where += [f"{name} < {_end(high)}"] if high is not None else []
    where += [f"{f} > 0" for f in found.positive]
    if where or on:
        lines.append("[domain]")
    if where:
        lines.append(f"where = {where}")
    if on:
        lines.append(f"on = {[str(f) for f in on]}")
    return "\n".join([*lines, "[[claim]]", 'kind = "identity"', f'lhs = "{found.lhs}"', f'rhs = "{found.rhs}"', ""])


def _identity(rng: random.Random) -> Case | None:
    found = equation(rng)
    box = dict(found.box)
    signs = {"positive": (Fraction(0), None), "nonnegative": (Fraction(0), None), "negative": (None, Fraction(0))}
    for name, words in found.words.items():
        if words in signs:
            box[name] = signs[words]
    integers = [name for name, words in found.words.items() if words.startswith("integer")]
    complexes = [name for name, words in found.words.items() if words == "complex"]
    if found.words.get("n", "") in ("integer positive", "integer nonnegative"):
        box["n"] = (Fraction(0), Fraction(9))

    def inside(point: Any) -> bool:
        for name in point.keys() & set(complexes):
            point[name] = mp.mpc(point[name], rng.randrange(-3000, 3000) / mp.mpf(1000))
        return all(value(f, point) > 0 for f in found.positive)

    used = sorted(names(found.lhs) | names(found.rhs) | {n for f in found.positive for n in names(f)} | set(box))
    used = [name for name in used if name not in ("pi", "1j")]
    point, seen = oracle.differs(rng, found.lhs, found.rhs, used, box, count=60, integers=integers, inside=inside)
    truth = False if point is not None else None
    return Case("identity", equation_file(found), truth, found.template, gap(found)) if seen else None


# -- generating functions and surfaces ----------------------------------------------------------------


def _generating(rng: random.Random) -> Case | None:
    """A function of type 1 to 4 with the map that it generates, both as its author would write them, or a mutant."""
    q, p, Q, P = (variable(name) for name in ("q", "p", "Q", "P"))
    c, d = pick(rng), pick(rng)
    b = 1 + variable("a") ** 2
    kind = rng.randrange(6)
    if kind == 0:
        number, F, new = 2, b * q * P + c * q**2 + d * P**2 / 2, (b * q + d * (p - 2 * c * q) / b, (p - 2 * c * q) / b)
    elif kind == 1:
        number, F, new = 2, call("exp", q) * P + c * call("cos", q), (
            call("exp", q), (p + c * call("sin", q)) / call("exp", q))  # fmt: skip
    elif kind == 2:
        number, F, new = 1, b * q * Q + c * q**3 + d * Q**2, ((p - 3 * c * q**2) / b,
                                                               -b * q - 2 * d * (p - 3 * c * q**2) / b)  # fmt: skip
    elif kind == 3:
        number, F, new = 3, -b * p * Q + c * p**2, ((q + 2 * c * p) / b, b * p)
    elif kind == 4:
        number, F, new = 4, b * p * P + c * P**3 + d * p**2, (
            b * p + 3 * c * ((-q - 2 * d * p) / b) ** 2, (-q - 2 * d * p) / b)  # fmt: skip
    else:
        number, F, new = 1, q**2 / (2 * call("tan", Q)) * b, (
            call("atan2", b * q, p), p**2 / (2 * b) + b * q**2 / 2)  # fmt: skip
    what, truth = "", True
    if rng.random() < 0.5:
        side = rng.randrange(2)
        changed, what = mutant(rng, new[side])
        functions = (changed, new[1]) if side == 0 else (new[0], changed)
        with mp.workdps(DIGITS):
            point, seen = oracle.differs(rng, changed, new[side], ("q", "p", "a"), {}, count=15)
        if not seen:
            return None
        truth = False if point is not None else None
    else:
        functions = new
    text = (
        f"[phase_space]\nq = ['q']\np = ['p']\nQ = ['Q']\nP = ['P']\n[symbols]\na = 'real'\n"
        f"[transformation]\nQ = ['{functions[0]}']\nP = ['{functions[1]}']\n"
    )
    if rng.random() < 0.5:
        text += f"[generating_function]\ntype = {number}\nF = '{F}'\n[[claim]]\nkind = 'generates'\n"
    else:
        text += f"[[claim]]\nkind = 'generating_function'\ntype = {number}\nF = '{F}'\n"
    return Case("generating", text, truth, f"type {number}: {what}")


def _surface(rng: random.Random) -> Case | None:
    """An equation on a surface of which points are known: true modulo the surface, or not."""
    x, y, t = variable("x"), variable("y"), variable("t")
    c = pick(rng)
    equation_of, image, box = rng.choice((
        (x**2 + y**2 - 1, (call("cos", t), call("sin", t)), {}),
        (x * y - 1, (t, 1 / t), {}),
        (x - y**2, (t**2, t), {}),
        (x**2 - y**2, (t, t), {}),
        (x**2 - y**2, (t, -t), {}),
        (y - call("exp", x), (t, call("exp", t)), {}),
        (x**3 - y**2, (t**2, t**3), {}),
        (y**2 - x**2 - 1, (call("sinh", t), call("cosh", t)), {}),
        (y**2 - x**2 - 1, (call("sinh", t), -call("cosh", t)), {}),
    ))  # fmt: skip
    base = rng.choice((x**2, x * y, call("sin", x), y**3 - x, call("sqrt", 2 + x**2), call("exp", y)))
    factor = rng.choice((x, y, of(1), x + y, call("cos", x), c))
    lhs, rhs = base + factor * equation_of, base
    kind = rng.randrange(5)
    if kind == 0:
        lhs, rhs = call("sqrt", y**2), y
    elif kind == 1:
        lhs, rhs = x, call("sqrt", 1 - y**2)
    elif kind == 2:
        lhs, rhs = x**2 + y, y + x * y
    elif kind == 3:
        rhs = rhs * rng.choice(NEAR)
    found = Equation(lhs, rhs, {"x": "real", "y": "real"}, box, template="surface")
    place = {"x": image[0], "y": image[1]}

    def at(f: Formula) -> Formula:
        from properties.soundness.formula import substituted

        return substituted(f, place)

    point, seen = oracle.differs(rng, at(lhs), at(rhs), ("t",), {}, count=40)
    if not seen:
        return None
    truth = False if point is not None else True if kind == 4 else None
    return Case("surface", equation_file(found, (equation_of,)), truth, f"surface {equation_of}")


def _bracket(rng: random.Random) -> Case | None:
    """{f, g} of two functions with its value worked out by the textbook's rules, or with a mutant of it."""
    n = rng.randint(1, 3)
    q, p = [f"q{k + 1}" for k in range(n)], [f"p{k + 1}" for k in range(n)]
    every = [variable(name) for name in (*q, *p)]
    f, g = smooth(rng, every) + smooth(rng, every), smooth(rng, every) * rng.choice(every)
    value_of = of(0)
    for x, y in zip(q, p, strict=True):
        value_of = value_of + slope(f, x) * slope(g, y) - slope(f, y) * slope(g, x)
    equals, what = (value_of, "") if rng.random() < 0.5 else mutant(rng, value_of)
    point, seen = oracle.differs(rng, value_of, equals, (*q, *p, "a"), {}, count=20)
    if not seen:
        return None
    truth = True if not what else False if point is not None else None
    text = f"[phase_space]\nq = {q}\np = {p}\n[symbols]\na = 'real'\n"
    text += f"[[claim]]\nkind = 'bracket'\nf = '{f}'\ng = '{g}'\nequals = '{equals}'\n"
    return Case("bracket", text, truth, what, gap(Equation(value_of, equals, {})))
