"""Cases: canonical transformations of textbooks, coordinate systems among them."""

from __future__ import annotations

import sympy as sp
from cases_common import Case, lifted, of_map, positives, reals
from sympy import acos, atan, atan2, cos, cosh, cot, exp, log, sin, sinh, sqrt


def c01_poincare_polar(error: sp.Rational = sp.S.Zero) -> Case:
    """Polar coordinates of the oscillator's phase plane."""
    (q,), (p,) = reals("q"), positives("p")
    return of_map([sqrt(2 * p) * sin(q) * (1 + error)], [sqrt(2 * p) * cos(q)], [q], [p])


def c02_ho_F1() -> Case:
    """Oscillator: action and angle to position and momentum."""
    (Q,), (P, m, w) = reals("Q"), positives("P m omega")
    return of_map([sqrt(2 * P / (m * w)) * sin(Q)], [sqrt(2 * m * w * P) * cos(Q)], [Q], [P])


def c03_ho_F1_inverse() -> Case:
    """Oscillator: position and momentum to action and angle."""
    (q, p), (m, w) = reals("q p"), positives("m omega")
    return of_map([atan(m * w * q / p)], [(p**2 + m**2 * w**2 * q**2) / (2 * m * w)], [q], [p])


def c04_goldstein_log() -> Case:
    """Q = log(sin p / q), P = q cot p."""
    (q,), (p,) = positives("q"), reals("p")
    return of_map([log(sin(p) / q)], [q * cot(p)], [q], [p])


def c05_goldstein_sqrtlog() -> Case:
    """Q = log(1 + √q cos p), P = 2(1 + √q cos p)√q sin p."""
    (q,), (p,) = positives("q"), reals("p")
    return of_map([log(1 + sqrt(q) * cos(p))], [2 * (1 + sqrt(q) * cos(p)) * sqrt(q) * sin(p)], [q], [p])


def c06_polar_forward() -> Case:
    """Polar to Cartesian coordinates, lifted."""
    (r,), (f,) = positives("r"), reals("phi")
    return lifted([r * cos(f), r * sin(f)], (r, f), "p_r p_phi")


def c07_polar_inverse() -> Case:
    """Cartesian to polar coordinates."""
    x, y, px, py = reals("x y p_x p_y")
    r = sqrt(x**2 + y**2)
    return of_map([r, atan2(y, x)], [(x * px + y * py) / r, x * py - y * px], [x, y], [px, py])


def c08_spherical_forward() -> Case:
    """Spherical to Cartesian coordinates, momenta as they are printed."""
    (r,), (t, f), (pr, pt, pf) = positives("r"), reals("theta phi"), reals("p_r p_theta p_phi")
    X = [r * sin(t) * cos(f), r * sin(t) * sin(f), r * cos(t)]
    P = [
        pr * sin(t) * cos(f) + pt * cos(t) * cos(f) / r - pf * sin(f) / (r * sin(t)),
        pr * sin(t) * sin(f) + pt * cos(t) * sin(f) / r + pf * cos(f) / (r * sin(t)),
        pr * cos(t) - pt * sin(t) / r,
    ]
    return of_map(X, P, [r, t, f], [pr, pt, pf])


def c09_spherical_adjugate() -> Case:
    """Spherical to Cartesian coordinates, lifted."""
    (r,), (t, f) = positives("r"), reals("theta phi")
    return lifted([r * sin(t) * cos(f), r * sin(t) * sin(f), r * cos(t)], (r, t, f), "p_r p_theta p_phi")


def c10_spherical_inverse(error: sp.Rational = sp.S.Zero) -> Case:
    """Cartesian to spherical coordinates."""
    x, y, z, px, py, pz = reals("x y z p_x p_y p_z")
    r, rho = sqrt(x**2 + y**2 + z**2), sqrt(x**2 + y**2)
    pr, pth = (x * px + y * py + z * pz) / r, (z * (x * px + y * py)) / rho - rho * pz * (1 + error)
    return of_map([r, acos(z / r), atan2(y, x)], [pr, pth, x * py - y * px], [x, y, z], [px, py, pz])


def c11_cylindrical() -> Case:
    """Cylindrical coordinates, lifted."""
    (r,), (f, z) = positives("r"), reals("phi z")
    return lifted([r * cos(f), r * sin(f), z], (r, f, z), "p_r p_phi p_z")


def c12_parabolic2d() -> Case:
    """Parabolic coordinates of the plane, lifted."""
    s, t = reals("sigma tau")
    return lifted([s * t, (t**2 - s**2) / 2], (s, t), "p_s p_t")


def c13_parabolic3d() -> Case:
    """Parabolic coordinates of space, lifted."""
    (s, t), (f,) = positives("sigma tau"), reals("phi")
    return lifted([s * t * cos(f), s * t * sin(f), (t**2 - s**2) / 2], (s, t, f), "p_s p_t p_f")


def c14_elliptic2d() -> Case:
    """Elliptic coordinates of the plane, lifted."""
    (u, v), (a,) = reals("mu nu"), positives("a")
    return lifted([a * cosh(u) * cos(v), a * sinh(u) * sin(v)], (u, v), "p_u p_v")


def c15_prolate3d() -> Case:
    """Prolate spheroidal coordinates, lifted."""
    (u, v, f), (a,) = reals("mu nu phi"), positives("a")
    x = [a * sinh(u) * sin(v) * cos(f), a * sinh(u) * sin(v) * sin(f), a * cosh(u) * cos(v)]
    return lifted(x, (u, v, f), "p_u p_v p_f")


def c26_delaunay_planar(error: sp.Rational = sp.S.Zero) -> Case:
    """Polar to Delaunay variables in the plane."""
    (r, k), (f, pr), (G,) = positives("r k"), reals("phi p_r"), positives("G")
    H = pr**2 / 2 + G**2 / (2 * r**2) - k / r
    L = k / sqrt(-2 * H)
    e_cos, e_sin = 1 + 2 * H * r / k, r * pr / L
    mean = atan2(e_sin, e_cos) - e_sin * (1 + error)
    true = atan2(G * pr, G**2 / r - k)
    return of_map([mean, f - true], [L, G], [r, f], [pr, G])


def c27_levi_civita() -> Case:
    """Regularisation of Levi-Civita."""
    u, v, pu, pv = reals("u v p_u p_v")
    d = 2 * (u**2 + v**2)
    return of_map([u**2 - v**2, 2 * u * v], [(u * pu - v * pv) / d, (v * pu + u * pv) / d], [u, v], [pu, pv])


def c37_morse_action_angle() -> Case:
    """Morse's oscillator to action and angle."""
    (x, p), (D,) = reals("x p"), positives("D")
    H = p**2 / 2 + D * (1 - exp(-x)) ** 2
    s = sqrt(2 * (D - H))
    angle = atan2(p * exp(x) * s / sqrt(2 * D) / sqrt(2 * D), 1 - exp(x) * (D - H) / D)
    return of_map([angle], [sqrt(2 * D) - s], [x], [p])


def c40_sec_nested_radicals() -> Case:
    """Cartesian to parabolic coordinates: nested radicals."""
    (x, px, py), (y,) = reals("x p_x p_y"), positives("y")
    r = sqrt(x**2 + y**2)
    a, b = sqrt(r + x), sqrt(r - x)
    return of_map([a, b], [px * a + py * b, -px * b + py * a], [x, y], [px, py])


def c42_generic_point_transf() -> Case:
    """Any point transformation of the plane, lifted."""
    q = reals("q1 q2")
    return lifted([sp.Function(name, real=True)(*q) for name in ("f1", "f2")], q, "p1 p2")


def c43_triaxial_ellipsoidal() -> Case:
    """Ellipsoidal coordinates with three different axes, lifted."""
    l, m, n = reals("lambda mu nu")
    axes = ((5, 3, 1), (3, 5, 1), (1, 5, 3))
    x = [sqrt((a + l) * (a + m) * (a + n) / sp.Integer((a - b) * (a - c))) for a, b, c in axes]
    return lifted(x, (l, m, n), "p_l p_m p_n")


def c44_delaunay3d(error: sp.Rational = sp.S.Zero) -> Case:
    """Spherical to Delaunay variables."""
    (r, k), (th, f, pr, pt, pf) = positives("r k"), reals("theta phi p_r p_theta p_phi")
    G = sqrt(pt**2 + pf**2 / sin(th) ** 2)
    H = pr**2 / 2 + G**2 / (2 * r**2) - k / r
    L = k / sqrt(-2 * H)
    mean = atan2(r * pr / L, 1 + 2 * H * r / k) - r * pr / L * (1 + error)
    true = atan2(G * pr, G**2 / r - k)
    latitude = atan2(cos(th) * G, -sin(th) * pt)
    node = f - atan2(pf * cos(th), -sin(th) * pt)
    return of_map([mean, latitude - true, node], [L, G, pf], [r, th, f], [pr, pt, pf])


def c47_powers_symbolic(error: sp.Rational = sp.S.Zero) -> Case:
    """Q = q^α with a symbolic exponent, lifted."""
    (q, al), (p,) = positives("q alpha"), reals("p")
    return of_map([q**al], [p * q ** (1 - al) / al * (1 + error)], [q], [p])


def c48_cube_roots() -> Case:
    """A point transformation with cube roots inside a square root, lifted."""
    q1, q2 = positives("q1 q2")
    u, v = sp.cbrt(3 * q1), sqrt(sp.cbrt(q2) + q1**2)
    return lifted([u * v, v / u], (q1, q2), "p1 p2")


CASES = {name: build for name, build in list(globals().items()) if name.startswith("c") and name[1:3].isdigit()}
