"""Claims worked out in exact arithmetic beforehand: identities and near misses, linear maps, polynomials' brackets."""

from __future__ import annotations

import random
from fractions import Fraction

from properties.soundness.formula import Formula, call, of, variable
from properties.soundness.identities import HALF, Equation, acos, asin, atan, cos, exp, log, pi, sin, sqrt, tan
from properties.soundness.rooted import TINY

x, y, z, a = (variable(name) for name in ("x", "y", "z", "a"))
sinh, cosh, tanh = (lambda u: call("sinh", u)), (lambda u: call("cosh", u)), (lambda u: call("tanh", u))
NEAR = (*TINY[2:], Fraction(1, 10**15), Fraction(1, 10**20), Fraction(1, 10**30), Fraction(1, 10**40))

Polynomial = dict[tuple[int, ...], Fraction]
Matrix = list[list[Fraction]]


# -- identities that hold wherever they are defined ----------------------------------------------------


def _pool(u: Formula, v: Formula) -> tuple[tuple[str, Formula, Formula], ...]:
    r = sqrt(u**2 + v**2)
    return (
        ("square", (u + v) ** 2, u**2 + 2 * u * v + v**2), ("cubes", u**3 - v**3, (u - v) * (u**2 + u * v + v**2)),
        ("fourth powers", u**4 - v**4, (u - v) * (u + v) * (u**2 + v**2)),
        ("Lagrange", (u**2 + v**2) * (z**2 + a**2), (u * z - v * a) ** 2 + (u * a + v * z) ** 2),
        ("partial fractions", 1 / (u - v) - 1 / (u + v), 2 * v / (u**2 - v**2)),
        ("sine of a sum", sin(u + v), sin(u) * cos(v) + cos(u) * sin(v)),
        ("cosine of a sum", cos(u + v), cos(u) * cos(v) - sin(u) * sin(v)),
        ("product of sines", 2 * sin(u) * sin(v), cos(u - v) - cos(u + v)),
        ("third multiple", sin(3 * u), 3 * sin(u) - 4 * sin(u) ** 3),
        ("fifth multiple", cos(5 * u), 16 * cos(u) ** 5 - 20 * cos(u) ** 3 + 5 * cos(u)),
        ("tangent of a sum", tan(u + v), (tan(u) + tan(v)) / (1 - tan(u) * tan(v))),
        ("half angle", tan(u / 2), sin(u) / (1 + cos(u))), ("Pythagoras", 1 + tan(u) ** 2, 1 / cos(u) ** 2),
        ("sixty degrees", sin(u + pi / 3), sin(u) / 2 + sqrt(of(3)) * cos(u) / 2),
        ("exponentials", exp(u + v), exp(u) * exp(v)), ("hyperbolic", cosh(u) ** 2 - sinh(u) ** 2, of(1)),
        ("hyperbolic sum", sinh(u + v), sinh(u) * cosh(v) + cosh(u) * sinh(v)),
        ("tanh", tanh(u), (exp(2 * u) - 1) / (exp(2 * u) + 1)),
        ("asin and acos", asin(u) + acos(u), pi / 2), ("asin by atan", asin(u), atan(u / sqrt(1 - u**2))),
        ("asinh", call("asinh", u), log(u + sqrt(u**2 + 1))),
        ("asinh, minus", call("asinh", u), -log(sqrt(u**2 + 1) - u)),
        ("acosh", call("acosh", u), log(u + sqrt(u**2 - 1))),
        ("atanh", call("atanh", u), log((1 + u) / (1 - u)) / 2), ("gudermannian", asin(tanh(u)), atan(sinh(u))),
        ("rationalised", 1 / (r - v), (r + v) / u**2), ("roots", (r + u) * (r - u), v**2),
        ("norms", sqrt(1 + u**2) * sqrt(1 + v**2), sqrt(1 + u**2 + v**2 + u**2 * v**2)),
        ("conjugates", sqrt(u**2 + 1) - sqrt(u**2 + 2), -1 / (sqrt(u**2 + 1) + sqrt(u**2 + 2))),
        ("golden", sqrt(6 + 2 * sqrt(of(5))) * u, (1 + sqrt(of(5))) * u),
        ("cosine of pi/5", cos(pi / 5) * u, (1 + sqrt(of(5))) * u / 4),
        ("powers", exp(a * log(1 + u**2)), (1 + u**2) ** a),
        ("power of a product", (1 + u**2) ** HALF * (1 + v**2) ** HALF, ((1 + u**2) * (1 + v**2)) ** HALF),
        ("logarithms", log(1 + u**2) + log(1 + v**2), log((1 + u**2) * (1 + v**2))),
    )  # fmt: skip


INNER = (
    x, x, x, y, x * y, x + y, x - 2 * y, x / 3, x**2, 1 - x, x / y, a * x, sin(x), exp(x), x + HALF, cos(y), x * a - y,
    sqrt(1 + x**2), log(1 + y**2), x / (1 + y**2),
)  # fmt: skip


def near(rng: random.Random) -> tuple[Equation, bool] | None:
    """An identity of the textbook with formulas in it, or one that misses it by 10⁻³ to 10⁻⁴⁰ times something."""
    u, v = rng.choice(INNER), rng.choice(INNER)
    if u == v:
        return None
    name, lhs, rhs = rng.choice(_pool(u, v))
    words = {"x": "real", "y": "real", "z": "real", "a": "real"}
    around = rng.randrange(5)
    if around == 0:
        lhs, rhs = rhs, lhs
    elif around == 1:
        lhs, rhs = lhs * (1 + z**2), (z**2 + 1) * rhs
    elif around == 2:
        lhs, rhs = lhs - rhs, of(0)
    if rng.random() < 0.5:
        return Equation(lhs, rhs, words, {}, (), name), True
    gap = rng.choice(NEAR) * rng.choice((of(1), x, x * y, 1 + z**2, cos(x), exp(y), a + x))
    return Equation(lhs, rhs + gap, words, {}, (), f"{name}, missed"), False


# -- linear maps ----------------------------------------------------------------------------------------


def _times(A: Matrix, B: Matrix) -> Matrix:
    return [
        [sum((A[i][k] * B[k][j] for k in range(len(B))), Fraction(0)) for j in range(len(B[0]))] for i in range(len(A))
    ]


def _unit(n: int) -> Matrix:
    return [[Fraction(int(i == j)) for j in range(n)] for i in range(n)]


def symplectic(rng: random.Random, n: int) -> Matrix:
    """A symplectic matrix over the fractions: a product of shears, squeezes and exchanges."""
    M = _unit(2 * n)
    small = [Fraction(k, d) for k in (-2, -1, 1, 2, 3) for d in (1, 1, 2, 1000)]
    for _ in range(rng.randrange(2, 6)):
        factor, kind = _unit(2 * n), rng.randrange(4)
        i, j = rng.randrange(n), rng.randrange(n)
        c = rng.choice(small)
        if kind == 0:
            factor[i][n + j] += c
            factor[j][n + i] += c if i != j else 0
        elif kind == 1:
            factor[n + i][j] += c
            factor[n + j][i] += c if i != j else 0
        elif kind == 2:
            factor[i][i], factor[n + i][n + i] = c, 1 / c
        elif i != j:
            factor[i][j], factor[n + j][n + i] = c, -c
        else:
            factor[i][i] = factor[n + i][n + i] = Fraction(0)
            factor[i][n + i], factor[n + i][i] = Fraction(1), Fraction(-1)
        M = _times(factor, M)
    return M


def is_symplectic(M: Matrix) -> bool:
    """M J Mᵀ = J, exactly."""
    n = len(M) // 2
    return all(
        sum((M[i][k] * M[j][k + n] - M[i][k + n] * M[j][k] for k in range(n)), Fraction(0)) == (1 if j == i + n else 0)
        for i in range(2 * n)
        for j in range(i + 1, 2 * n)
    )


def linear(rng: random.Random) -> tuple[str, bool, str]:
    """(a claim file of a linear map with constants added, its truth, a note)."""
    n = rng.choice((1, 2, 2, 3))
    M, what = symplectic(rng, n), "symplectic"
    if rng.random() < 0.6:
        i, j = rng.randrange(2 * n), rng.randrange(2 * n)
        gap = rng.choice(NEAR)
        kind = rng.randrange(3)
        if kind == 0:
            M[i][j], what = -M[i][j], "a sign"
        elif kind == 1:
            M[i][j], what = M[i][j] * (1 + gap), f"a factor 1 + {gap}"
        else:
            M[i][j], what = M[i][j] + gap, f"an entry by {gap}"
    names = [variable(f"{letter}{k + 1}") for letter in "qp" for k in range(n)]
    shift = rng.choice((of(0), of(1), a, sin(a)))
    rows = []
    for row in M:
        total = shift
        for c, name in zip(row, names, strict=True):
            if c:
                total = total + c * name
        rows.append(str(total))
    kind = rng.choice(("canonical", "fundamental_brackets", "integral_invariant"))
    text = (
        f"[phase_space]\nq = {[str(v) for v in names[:n]]}\np = {[str(v) for v in names[n:]]}\n"
        f"Q = {[f'Q{k + 1}' for k in range(n)]}\nP = {[f'P{k + 1}' for k in range(n)]}\n[symbols]\na = 'real'\n"
        f"[transformation]\nQ = {rows[:n]}\nP = {rows[n:]}\n[[claim]]\nkind = '{kind}'\n"
    )
    return text, is_symplectic(M), what


# -- brackets of polynomials -----------------------------------------------------------------------------


def _random_polynomial(rng: random.Random, names: int) -> Polynomial:
    out: Polynomial = {}
    for _ in range(rng.randrange(1, 5)):
        powers = [0] * names
        for _ in range(rng.randrange(1, 4)):
            powers[rng.randrange(names)] += 1
        out[tuple(powers)] = Fraction(rng.choice((-3, -2, -1, 1, 2, 5)), rng.choice((1, 1, 2, 3)))
    return out


def _derivative(f: Polynomial, k: int) -> Polynomial:
    return {(*m[:k], m[k] - 1, *m[k + 1 :]): c * m[k] for m, c in f.items() if m[k]}


def _add(f: Polynomial, g: Polynomial, factor: int = 1) -> Polynomial:
    out = dict(f)
    for m, c in g.items():
        out[m] = out.get(m, Fraction(0)) + factor * c
    return {m: c for m, c in out.items() if c}


def _multiply(f: Polynomial, g: Polynomial) -> Polynomial:
    out: Polynomial = {}
    for m, c in f.items():
        for k, d in g.items():
            key = tuple(i + j for i, j in zip(m, k, strict=True))
            out[key] = out.get(key, Fraction(0)) + c * d
    return {m: c for m, c in out.items() if c}


def bracket(f: Polynomial, g: Polynomial, n: int) -> Polynomial:
    """{f, g} of polynomials in q₁ … qₙ, p₁ … pₙ."""
    total: Polynomial = {}
    for k in range(n):
        total = _add(total, _multiply(_derivative(f, k), _derivative(g, k + n)))
        total = _add(total, _multiply(_derivative(f, k + n), _derivative(g, k)), -1)
    return total


def _text(f: Polynomial, names: list[str]) -> str:
    terms = []
    for powers, c in f.items():
        factors = [f"{name}**{e}" if e > 1 else name for name, e in zip(names, powers, strict=True) if e]
        terms.append("*".join([f"({c})", *factors]))
    return " + ".join(terms) or "0"


def brackets(rng: random.Random) -> tuple[str, bool, str]:
    """(a claim file about brackets of polynomials, its truth, a note)."""
    n = rng.choice((1, 2, 3))
    names = [f"{letter}{k + 1}" for letter in "qp" for k in range(n)]
    f, g = _random_polynomial(rng, 2 * n), _random_polynomial(rng, 2 * n)
    value, what = bracket(f, g, n), "as it is"
    head = f"[phase_space]\nq = {names[:n]}\np = {names[n:]}\n"
    kind = rng.randrange(3)
    if kind == 0:
        claimed = dict(value)
        if rng.random() < 0.6:
            key = rng.choice([*claimed, tuple(rng.randrange(3) for _ in names)])
            claimed[key] = claimed.get(key, Fraction(0)) + (gap := rng.choice(NEAR))
            what = f"a coefficient by {gap}"
        truth = _add(value, claimed, -1) == {}
        claim = (
            f"kind = 'bracket'\nf = '{_text(f, names)}'\ng = '{_text(g, names)}'\nequals = '{_text(claimed, names)}'\n"
        )
    elif kind == 1:
        square = _add(_multiply(f, f), f)
        if rng.random() < 0.5:
            extra = {rng.choice(list(_random_polynomial(rng, 2 * n))): rng.choice(NEAR)}
            square, what = _add(square, extra), "a term more"
        truth = bracket(square, f, n) == {}
        claim = f"kind = 'conserved'\nf = '{_text(square, names)}'\n"
        head += f"[hamiltonian]\nH = '{_text(f, names)}'\n"
    else:
        dq = [_derivative(f, k + n) for k in range(n)]
        dp = [_add({}, _derivative(f, k), -1) for k in range(n)]
        if rng.random() < 0.6:
            k, gap = rng.randrange(n), rng.choice(NEAR)
            half = rng.choice((dq, dp))
            half[k], what = _add(half[k], _random_polynomial(rng, 2 * n)), "a term more"
            half[k] = {m: c * (1 + gap) for m, c in half[k].items()}
        right = [_derivative(f, k + n) for k in range(n)], [_add({}, _derivative(f, k), -1) for k in range(n)]
        truth = (dq, dp) == right
        claim = (
            f"kind = 'equations_of_motion'\nqdot = {[_text(v, names) for v in dq]}\n"
            f"pdot = {[_text(v, names) for v in dp]}\n"
        )
        head += f"[hamiltonian]\nH = '{_text(f, names)}'\n"
    return f"{head}[[claim]]\n{claim}", truth, what
