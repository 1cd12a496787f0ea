"""Cases: constants of motion, algebras of brackets, Jacobi's identity, moving frames."""

from __future__ import annotations

import itertools

import sympy as sp
from cases_common import Case, cyclic, of_map, of_residuals, pb, positives, reals
from sympy import LeviCivita, cos, exp, sin, sqrt

NONE = sp.S.Zero


class Kepler:
    """Kepler's problem: angular momentum M, the vector A of Laplace, Runge and Lenz, the Hamiltonian H."""

    def __init__(self) -> None:
        self.x, self.p = reals("x y z"), reals("p_x p_y p_z")
        self.m, self.k = positives("m k")
        x, p, r = self.x, self.p, sqrt(sp.Add(*(a * a for a in self.x)))
        self.M = [x[j] * p[l] - x[l] * p[j] for _, j, l in cyclic()]
        self.A = [p[j] * self.M[l] - p[l] * self.M[j] - self.m * self.k * x[i] / r for i, j, l in cyclic()]
        self.H = sp.Add(*(a * a for a in p)) / (2 * self.m) - self.k / r


def c23_kepler_AA(error: sp.Rational = NONE) -> Case:
    """{A_i, A_j} = −2mH M_k, and A is conserved."""
    s = Kepler()
    factors = (1 + error, 1, 1)
    return of_residuals(
        *(
            pb(s.A[i], s.A[j], s.x, s.p) + 2 * s.m * s.H * s.M[l] * factor
            for (i, j, l), factor in zip(cyclic(), factors, strict=True)
        ),
        *(pb(a, s.H, s.x, s.p) for a in s.A),
    )


def c24_kepler_DD_DM(error: sp.Rational = NONE) -> Case:
    """D = A/√(−2mH) and M close to so(4)."""
    s = Kepler()
    D = [a / sqrt(-2 * s.m * s.H) for a in s.A]
    residuals = []
    for i, j, l in cyclic():
        residuals.append(pb(D[i], D[j], s.x, s.p) - s.M[l])
        residuals.append(pb(D[i], s.M[j], s.x, s.p) - D[l] * (1 + error))
    return of_residuals(*residuals, pb(D[0], s.M[0], s.x, s.p))


def c25_angmom_N6(error: sp.Rational = NONE) -> Case:
    """The angular momentum of six bodies closes to so(3)."""
    X = [reals(f"x{a}_1:4") for a in range(6)]
    P = [reals(f"p{a}_1:4") for a in range(6)]
    M = [sp.Add(*(x[j] * p[l] - x[l] * p[j] for x, p in zip(X, P, strict=True))) for _, j, l in cyclic()]
    q, p, square = sum(X, ()), sum(P, ()), sp.Add(*(m**2 for m in M))
    first = pb(M[0], M[1], q, p) - M[2] * (1 + error)
    rest = [pb(M[i], M[j], q, p) - M[l] for i, j, l in cyclic()[1:]]
    return of_residuals(first, *rest, *(pb(square, m, q, p) for m in M))


def c28_rigid_body(error: sp.Rational = NONE) -> Case:
    """Angular momenta of a rigid body in the body and in space, by Euler's angles."""
    f, t, s, pf, pt, ps = reals("phi theta psi p_phi p_theta p_psi")
    q, p = [f, t, s], [pf, pt, ps]
    body = [
        ((pf - ps * cos(t)) * sin(s) + pt * sin(t) * cos(s)) / sin(t),
        ((pf - ps * cos(t)) * cos(s) - pt * sin(t) * sin(s)) / sin(t),
        ps,
    ]
    space = [
        ((ps - pf * cos(t)) * sin(f) + pt * sin(t) * cos(f)) / sin(t),
        (-(ps - pf * cos(t)) * cos(f) + pt * sin(t) * sin(f)) / sin(t),
        pf,
    ]
    factors = (1 + error, 1, 1)
    return of_residuals(
        *(pb(body[i], body[j], q, p) + body[l] * factor for (i, j, l), factor in zip(cyclic(), factors, strict=True)),
        *(pb(space[i], space[j], q, p) - space[l] for i, j, l in cyclic()),
        *(pb(a, b, q, p) for a in body for b in space),
        sum(a * a for a in body) - sum(a * a for a in space),
    )


def _jacobi(f: sp.Expr, g: sp.Expr, h: sp.Expr, q: tuple, p: tuple) -> sp.Expr:
    return sp.Add(*(pb(a, pb(b, c, q, p), q, p) for a, b, c in ((f, g, h), (g, h, f), (h, f, g))))


def c29_jacobi_2dof() -> Case:
    """Jacobi's identity for three functions."""
    q1, q2, p1, p2 = reals("q1 q2 p1 p2")
    f, g = sin(q1 * p2) + p1**2 * q2, exp(q1 - p2) * cos(q2) + p1 * p2
    h = sqrt(1 + q1**2 + p1**2) * q2 + p2**3
    return of_residuals(_jacobi(f, g, h, (q1, q2), (p1, p2)))


def c30_jacobi_3dof() -> Case:
    """Jacobi's identity for three functions of six variables."""
    q, p = reals("q1 q2 q3"), reals("p1 p2 p3")
    f = sin(q[0] + q[1]) * p[2] ** 2 + p[0] * p[1] * q[2] / (1 + q[0] ** 2)
    g = exp(q[2] * p[0]) + q[1] ** 2 * p[1] / (2 + p[2] ** 2)
    h = cos(q[1] * p[0]) * q[0] + p[2] * sqrt(1 + q[2] ** 2)
    return of_residuals(_jacobi(f, g, h, q, p))


def n30_jacobi_3dof_miss() -> Case:
    """The same with a small term that does not belong there."""
    (residual,) = c30_jacobi_3dof().more
    q1, p3 = reals("q1 p3")
    return of_residuals(residual + sp.Rational(1, 1000) * q1 * sin(p3)).missed()


def c31_relativistic_em(error: sp.Rational = NONE) -> Case:
    """A relativistic charge in any electromagnetic field: velocity, brackets, Lorentz's force."""
    x, p, (m, c, e) = reals("x y z"), reals("p_x p_y p_z"), positives("m c e")
    A = [sp.Function(f"A_{s}", real=True)(*x) for s in "xyz"]
    phi = sp.Function("phi", real=True)(*x)
    kinetic = [p[i] - e * A[i] / c for i in range(3)]
    W = sqrt(m**2 * c**4 + c**2 * sp.Add(*(a**2 for a in kinetic)))
    H, v = W + e * phi, [c**2 * a / W for a in kinetic]
    B = [sp.diff(A[l], x[j]) - sp.diff(A[j], x[l]) for _, j, l in cyclic()]
    return of_residuals(
        *(pb(x[i], H, x, p) - v[i] for i in range(3)),
        *(pb(kinetic[i], kinetic[j], x, p) - e / c * B[l] for i, j, l in cyclic()),
        *(
            pb(kinetic[i], H, x, p) + e * sp.diff(phi, x[i]) - e / c * (v[j] * B[l] - v[l] * B[j]) * (1 + error)
            for i, j, l in cyclic()
        ),
    )


def _with_equations(case: Case, H: sp.Expr, K: sp.Expr, new: list, t: sp.Symbol, factors: list) -> Case:
    """The case of a map, and that it takes Hamilton's equations of H into those of K."""
    assert case.map is not None
    given, n = case.map, len(case.map.q)
    images = dict(zip(new, (*given.Q, *given.P), strict=True))
    velocities = [sp.diff(K, y) for y in new[n:]] + [-sp.diff(K, x) for x in new[:n]]
    return Case(
        given,
        tuple(
            sp.diff(f, t) + pb(f, H, given.q, given.p) - v.subs(images, simultaneous=True) * factor
            for f, v, factor in zip((*given.Q, *given.P), velocities, factors, strict=True)
        ),
    )


def c32_rotating_frame(error: sp.Rational = NONE) -> Case:
    """A rotating frame and the Hamiltonian in it."""
    x, y, px, py, t, w = reals("x y p_x p_y t omega")
    c, s = cos(w * t), sin(w * t)
    case = of_map([c * x + s * y, -s * x + c * y], [c * px + s * py, -s * px + c * py], [x, y], [px, py])
    X, Y, PX, PY = new = reals("X Y P_X P_Y")
    H = (px**2 + py**2) / 2 + (x**2 + y**2) ** 2
    K = (PX**2 + PY**2) / 2 + (X**2 + Y**2) ** 2 - w * (X * PY - Y * PX)
    return _with_equations(case, H, K, list(new), t, [1 + error] * 4)


def c38_damped_osc_Kform(error: sp.Rational = NONE) -> Case:
    """The damped oscillator made autonomous."""
    (q, p, t), (g, m, w) = reals("q p t"), positives("gamma m omega")
    X, Y = new = reals("X Y")
    H = p**2 * exp(-g * t) / (2 * m) + m * w**2 * q**2 * exp(g * t) / 2
    K = Y**2 / (2 * m) + m * w**2 * X**2 / 2 + g * X * Y / 2
    case = of_map([q * exp(g * t / 2)], [p * exp(-g * t / 2)], [q], [p])
    return _with_equations(case, H, K, list(new), t, [1 + error, 1])


def c35_toda3(error: sp.Rational = NONE) -> Case:
    """The periodic Toda chain of three: energy, momentum and the cubic integral commute."""
    q, p = reals("q1 q2 q3"), reals("p1 p2 p3")
    a = [exp(q[i] - q[(i + 1) % 3]) for i in range(3)]
    H = sp.Add(*(x**2 for x in p)) / 2 + sp.Add(*a)
    cubic = p[0] * p[1] * p[2] - p[0] * a[1] * (1 + error) - p[1] * a[2] - p[2] * a[0]
    total = sp.Add(*p)
    return of_residuals(pb(H, cubic, q, p), pb(total, cubic, q, p), pb(total, H, q, p))


def c36_calogero3() -> Case:
    """Rational Calogero–Moser system of four: traces of powers of Lax's matrix commute."""
    n, (g,) = 4, positives("g")
    q, p = reals(f"q1:{n + 1}"), reals(f"p1:{n + 1}")
    L = sp.Matrix(n, n, lambda i, j: p[i] if i == j else sp.I * g / (q[i] - q[j]))
    return of_residuals(pb((L * L).trace() / 2, (L * L * L).trace() / 3, q, p))


def c39_two_centre(error: sp.Rational = NONE) -> Case:
    """Euler's problem of two fixed centres: his integral is conserved."""
    (x, y, px, py), (a, k1, k2) = reals("x y p_x p_y"), positives("a k1 k2")
    r1, r2 = sqrt((x - a) ** 2 + y**2), sqrt((x + a) ** 2 + y**2)
    H = (px**2 + py**2) / 2 - k1 / r1 - k2 / r2
    L1, L2 = (x - a) * py - y * px, (x + a) * py - y * px
    integral = L1 * L2 + 2 * a * k2 * (x + a) / r2 - 2 * a * k1 * (x - a) / r1 * (1 + error)
    return of_residuals(pb(H, integral, [x, y], [px, py]))


def c41_jacobi_generic_2dof() -> Case:
    """Jacobi's identity for any three functions of four variables."""
    q, p = reals("q1 q2"), reals("p1 p2")
    return of_residuals(_jacobi(*(sp.Function(name, real=True)(*q, *p) for name in "fgh"), q, p))


def c46_kovalevskaya(error: sp.Rational = NONE) -> Case:
    """Kovalevskaya's top: her integral commutes with the energy and with Casimir's functions."""
    M, g, (mu,) = reals("M1 M2 M3"), reals("g1 g2 g3"), reals("mu")

    def bracket(a: sp.Expr, b: sp.Expr) -> sp.Expr:
        total = sp.S.Zero
        for i, j, k in itertools.permutations(range(3)):
            mixed = sp.diff(a, M[i]) * sp.diff(b, g[j]) + sp.diff(a, g[i]) * sp.diff(b, M[j])
            total += LeviCivita(i, j, k) * (M[k] * sp.diff(a, M[i]) * sp.diff(b, M[j]) + g[k] * mixed)
        return total

    H = (M[0] ** 2 + M[1] ** 2 + 2 * M[2] ** 2) / 2 - mu * g[0]
    K = (M[0] ** 2 - M[1] ** 2 + 2 * mu * g[0]) ** 2 * (1 + error) + (2 * M[0] * M[1] + 2 * mu * g[1]) ** 2
    square, product = sum(a * a for a in g), sum(a * b for a, b in zip(M, g, strict=True))
    return of_residuals(bracket(H, K), bracket(square, K), bracket(product, K))


def c50_calogero5_trig(error: sp.Rational = NONE) -> Case:
    """Sutherland's system of three: energy and the cubic integral commute."""
    q, p, (g,) = reals("q1:4"), reals("p1:4"), positives("g")

    def V(i: int, j: int) -> sp.Expr:
        return g**2 / sin(q[i] - q[j]) ** 2

    H2 = sum(a**2 for a in p) / 2 + sum(V(i, j) for i, j in itertools.combinations(range(3), 2))
    H3 = p[0] * p[1] * p[2] - p[0] * V(1, 2) * (1 + error) - p[1] * V(0, 2) - p[2] * V(0, 1)
    return of_residuals(pb(H2, H3, q, p))


def nbody(N: int, error: sp.Rational = NONE) -> Case:
    """Angular momentum and one component of momentum of N gravitating bodies are conserved."""
    X = [reals(f"x{a}_1:4") for a in range(N)]
    P = [reals(f"p{a}_1:4") for a in range(N)]
    m, (G,) = positives(f"m1:{N + 1}"), positives("G")

    def distance(i: int, j: int) -> sp.Expr:
        return sqrt(sum((a - b) ** 2 for a, b in zip(X[i], X[j], strict=True)))

    kinetic = sum(sum(c**2 for c in P[a]) / (2 * m[a]) for a in range(N))
    H = kinetic - sum(G * m[i] * m[j] / distance(i, j) for i, j in itertools.combinations(range(N), 2))
    q, p = sum(X, ()), sum(P, ())
    off = [1 + (error if a == 1 else 0) for a in range(N)]
    M = [sum(X[a][j] * P[a][l] - X[a][l] * P[a][j] * off[a] for a in range(N)) for _, j, l in cyclic()]
    return of_residuals(*(pb(f, H, q, p) for f in (*M, sum(P[a][0] for a in range(N)))))


def c51_nbody3() -> Case:
    """Three bodies."""
    return nbody(3)


def c52_nbody5(error: sp.Rational = NONE) -> Case:
    """Five bodies."""
    return nbody(5, error)


def c53_nbody6() -> Case:
    """Six bodies."""
    return nbody(6)


CASES = {name: build for name, build in list(globals().items()) if name[:1] in "cn" and name[1:3].isdigit()}
