"""Kepler's motion ẍ = −μ x/r³ for every energy and eccentricity, attracting or repelling, in universal variables.

With dt = r ds and β = 2μ/r − v², t = r_0 G_1 + η_0 G_2 + μ G_3 and r = r_0 + η_0 G_1 + ζ_0 G_2, where η = x·v,
ζ_0 = μ − β r_0 and G_k = s^k c_k(β s²). Nothing is singular at e = 1 or at E = 0, and e = 0 is no special case.
Conditioning: that of the motion. N periods cost log₁₀ 3πN digits of the place on the orbit, as the energy is known to a
rounding; from the pericentre of a slim orbit the energy, a difference, is known to 1 − e only.
Danby (1988), Fundamentals of Celestial Mechanics, 6.9; Mikkola (1997), Celest. Mech. Dyn. Astron. 67, 145.
"""

from __future__ import annotations

from typing import Any, Final

from canon.numeric.compensated import sum_of_products, two_product, two_sum
from canon.numeric.exact.stumpff import QUICK_BELOW, stumpff_quickly

MOST_ITERATIONS: Final = 40
QUICK_ITERATIONS: Final = 5
FINE: Final = 1e-9
COARSE: Final = 1e-4
SLIGHT: Final = 1e-9
"""A correction of the energy is smaller than this, or none is made."""
OPEN: Final = 1.0
"""From this −βs² on a hyperbola's new state is found from its pericentre."""

_LAGUERRE: Final = 5


def kepler(q: Any, v: Any, mu: Any, t: Any) -> tuple[Any, Any]:
    """The position and velocity after a time t.

    **Arguments:** `q` and `v`, arrays (n, …), or tuples of n arrays, of position and velocity; `mu`, the attraction's
    strength per mass (a/m for a potential −a/r; negative repels); `t`, of any sign.

    **Returns:** (q, v) of the same shape. A fall into the centre (no angular momentum) goes through it and comes back,
    as the limit of slim orbits does; at the centre itself the velocity is infinite. It is nan beyond a hyperbolic
    anomaly of 64, some 1e27 times the time of the passage.
    """
    import jax
    import jax.numpy as jnp
    from jax import lax

    start = q, v
    r, (beta, beta_low), eta, _ = _elements(q, v, mu)
    zeta = mu - beta * r
    forwards = jnp.where(t >= 0, 1.0, -1.0)
    span = _within_a_period(jnp.abs(t), beta, mu)
    # the iteration's derivative is that of one last step of Newton's, which is first-order in what is left
    s = forwards * lax.stop_gradient(_solve(span, r, forwards * eta, zeta, beta, mu))
    span = forwards * span
    psi = beta * s * s
    c0, c1, c2, c3 = stumpff_quickly(jnp.where(jnp.abs(psi) <= QUICK_BELOW, psi, jnp.nan))
    g1, g2, g3 = s * c1, s * s * c2, s * s * s * c3
    left = (span - (r * g1 + eta * g2 + mu * g3)) / (r + eta * g1 + zeta * g2)
    g1, g2, g3 = g1 + left * c0, g2 + left * g1, g3 + left * g2
    after = r + eta * g1 + zeta * g2
    f, g = -mu * g2 / r, span - mu * g3
    f_dot, g_dot = -mu * g1 / (after * r), -mu * g2 / after
    q, v = (
        jax.tree.map(lambda x, u: x + (f * x + g * u), q, v),
        jax.tree.map(lambda x, u: u + (f_dot * x + g_dot * u), q, v),
    )
    open_ = (-psi > OPEN) & (mu != 0)
    q, v = lax.cond(
        jnp.any(open_),
        lambda: _from_pericentre(start, (r, beta, eta), (q, v), mu, span, lax.stop_gradient(s), open_),
        lambda: (q, v),
    )
    longer, faster = lax.stop_gradient(_energy_correction(q, v, mu, (beta, beta_low)))
    return jax.tree.map(lambda x: x + longer * x, q), jax.tree.map(lambda u: u + faster * u, v)


def _from_pericentre(start: Any, elements: Any, other: Any, mu: Any, span: Any, s: Any, where: Any) -> Any:
    """The state on a hyperbola that turns by much, in the frame of its pericentre, where `where` is; else the other.
    `elements`: r, β and η of the start.

    On the way in and out again f x and g v grow as the exponential of s and cancel. From the pericentre, with ε = |μ|e,
    t = q_p s + ε G_3, r = q_p + ε G_2 and x = (q_p − μ G_2) P + G_1 P·L are sums without a difference but the one in
    which x changes its sign; P is along v × (x × v) − μ x/r, with x × v as in twice the precision. Danby (1988), 6.9.
    """
    import jax
    import jax.numpy as jnp

    x, v = start
    count = len(x)
    r, beta, eta = elements
    beta = jnp.where(where, beta, -1.0)
    below = [[sum_of_products([(x[i], v[j]), (-x[j], v[i])])[0] for j in range(i)] for i in range(count)]
    L = [[below[i][j] if j < i else -below[j][i] if j > i else 0.0 * r for j in range(count)] for i in range(count)]
    h2 = sum((L[i][j] * L[i][j] for i in range(count) for j in range(i)), 0.0 * r)
    epsilon = jnp.sqrt(mu * mu - beta * h2)
    nearest = jnp.where(mu > 0, h2 / jnp.where(mu > 0, mu + epsilon, 1.0), (epsilon - mu) / -beta)
    root = jnp.sqrt(-beta)
    axis = [(sum((v[j] * L[i][j] for j in range(count)), -mu * x[i] / r)) / epsilon for i in range(count)]
    across = [sum((axis[i] * L[i][j] for i in range(count)), 0.0 * r) for j in range(count)]

    def at(s: Any) -> tuple[Any, Any, Any, Any]:
        """(c_0, G_1, G_2, t) at s after the pericentre."""
        psi = beta * s * s
        c0, c1, c2, c3 = stumpff_quickly(jnp.where(where, jnp.where(jnp.abs(psi) <= QUICK_BELOW, psi, jnp.nan), -1.0))
        return c0, s * c1, s * s * c2, nearest * s + epsilon * s * s * s * c3

    first = jnp.arcsinh(root * eta / epsilon) / root
    c0, g1, g2, reached = at(jax.lax.stop_gradient(first + s))
    # a last step of Newton's, to first order, carries the derivatives too
    left = (at(first)[3] + span - reached) / (nearest + epsilon * g2)
    c0, g1, g2 = c0 - beta * left * g1, g1 + left * c0, g2 + left * g1
    after = nearest + epsilon * g2
    along, speed = nearest - mu * g2, -mu * g1 / after
    place = [jnp.where(where, along * P + g1 * W, old) for P, W, old in zip(axis, across, other[0], strict=True)]
    velocity = [
        jnp.where(where, speed * P + c0 / after * W, old) for P, W, old in zip(axis, across, other[1], strict=True)
    ]
    return tuple(tuple(new) if isinstance(x, tuple) else jnp.stack(new) for new in (place, velocity))


def _energy_correction(q: Any, v: Any, mu: Any, wanted: tuple[Any, Any]) -> tuple[Any, Any]:
    """The parts by which q and v are to grow, as little as may be, so that β is what it was.

    Where the first state is far from the pericentre f x + g v cancels near it, and without this the energy would lose
    what the distance loses. Nacozy (1971), Astrophys. Space Sci. 14, 40.
    """
    import jax.numpy as jnp

    r, (beta, low), _, v2 = _elements(q, v, mu)
    by_distance, by_speed = 2 * mu / r, 2 * v2
    off = ((beta - wanted[0]) + (low - wanted[1])) / (by_distance * by_distance + by_speed * by_speed)
    slight = jnp.abs(off) * (jnp.abs(by_distance) + by_speed) < SLIGHT
    return jnp.where(slight, off * by_distance, 0.0), jnp.where(slight, off * by_speed, 0.0)


def _elements(q: Any, v: Any, mu: Any) -> tuple[Any, tuple[Any, Any], Any, Any]:
    """(r, β, η, v²): β = (2μ − v² r)/r in double-double arithmetic, for the orbits with hardly any energy."""
    import jax.numpy as jnp

    count = len(q)
    r2, r2_low = sum_of_products((q[i], q[i]) for i in range(count))
    v2, v2_low = sum_of_products((v[i], v[i]) for i in range(count))
    eta, _ = sum_of_products((q[i], v[i]) for i in range(count))
    r = jnp.sqrt(r2)
    square, square_low = two_product(r, r)
    r_low = ((r2 - square) + (r2_low - square_low)) / (2 * r)
    product, product_low = two_product(v2, r)
    high, low = two_sum(2 * mu, -product)
    low = low - product_low - v2_low * r - v2 * r_low
    beta = (high + low) / (r + r_low)
    back, back_low = two_product(beta, r)
    return r, (beta, ((high - back) - back_low + (low - beta * r_low)) / r), eta, v2


def _within_a_period(span: Any, beta: Any, mu: Any) -> Any:
    """The time less as many whole periods as it has, for bound orbits."""
    import jax.numpy as jnp

    bound = beta > 0
    rate = jnp.where(bound, beta, 1.0)
    period = 2 * jnp.pi * mu / (rate * jnp.sqrt(rate))
    turns = jnp.where(bound & (span > period), jnp.floor(span / period), 0.0)
    whole, low = two_product(turns, period)
    return jnp.where(turns > 0, jnp.maximum((span - whole) - low, 0.0), span)


def _solve(span: Any, r: Any, eta: Any, zeta: Any, beta: Any, mu: Any) -> Any:
    """s ≥ 0 with t(s) = span ≥ 0: Laguerre's iteration with n = 5, kept between bounds, as dt/ds = r > 0.

    Conway (1986), Celest. Mech. 39, 199.
    """
    import jax.numpy as jnp
    from jax import lax

    span, r, eta, zeta, beta, mu = jnp.broadcast_arrays(span, r, eta, zeta, beta, mu)
    bound = beta > 0
    root = jnp.sqrt(jnp.abs(beta))
    full = 2 * jnp.pi / jnp.where(bound, root, 1.0)
    first = jnp.clip(_guess(span, r, eta, beta, mu), 0.0, jnp.where(bound, full, jnp.inf))

    def laguerre(s: Any) -> tuple[Any, Any]:
        c0, c1, c2, c3 = stumpff_quickly(beta * s * s)
        g1, g2, g3 = s * c1, s * s * c2, s * s * s * c3
        miss = (r * g1 + eta * g2 + mu * g3) - span
        slope = r + eta * g1 + zeta * g2
        bend = eta * c0 + zeta * g1
        n = _LAGUERRE
        under = jnp.abs((n - 1) ** 2 * slope * slope - n * (n - 1) * miss * bend)
        return s - n * miss / (slope + jnp.sqrt(under)), miss

    def improve(loop: Any) -> Any:
        count, s, low, high, last, done = loop
        new, miss = laguerre(s)
        high, low = jnp.where(miss > 0, s, high), jnp.where(miss <= 0, s, low)
        middle = jnp.where(jnp.isinf(high), 2 * s + jnp.where(s == 0, span / r, 0.0), (low + high) / 2)
        new = jnp.where((new >= low) & (new <= high), new, middle)
        step = jnp.abs(new - s)
        # steps that are small and shrink no more are rounding
        ends = (step <= FINE * s) | (miss == 0) | ((step <= COARSE * s) & (2 * step >= last)) | ~jnp.isfinite(new)
        new = jnp.where(done | (ends & (step > COARSE * s)), s, new)
        return count + 1, new, low, high, step, done | ends

    high = jnp.where(bound, full * 1.0000001, jnp.inf)
    zero = jnp.zeros_like(first)
    # nearly always a few steps do, and without bounds to keep they are one loop over the orbits where they are written
    # out; for one orbit that would only take long to compile
    turns = QUICK_ITERATIONS if jnp.ndim(first) else 1
    quick, before = lax.fori_loop(
        0, QUICK_ITERATIONS, lambda _, s: (laguerre(s[0])[0], s[0]), (first, first), unroll=turns
    )
    settled = (quick >= 0) & (quick <= high) & (jnp.abs(quick - before) <= FINE * quick)
    first = jnp.where(settled, quick, first)
    begin = (0, first, zero, jnp.broadcast_to(high, zero.shape), zero + jnp.inf, settled | (span + zero == 0))
    found = lax.while_loop(lambda loop: (loop[0] < MOST_ITERATIONS) & ~jnp.all(loop[5]), improve, begin)[1]
    return jnp.where(span == 0, 0.0, found)


def _guess(span: Any, r: Any, eta: Any, beta: Any, mu: Any) -> Any:
    """A first s: from the anomaly on an ellipse or hyperbola, from the parabola where that is close."""
    import jax.numpy as jnp
    from jax import lax

    # u, a distance in s from the pericentre, on the parabola with this momentum: r_p u + μ u³/6 = t since pericentre
    attraction = jnp.where(mu > 0, mu, 1.0)
    near = jnp.maximum(r * (2 * attraction - beta * r) - eta * eta, 0.0) / (2 * attraction)
    u0 = eta / attraction
    total = 3 * (span + near * u0 + attraction * u0**3 / 6) / attraction
    b = 2 * near / attraction
    w = jnp.cbrt(jnp.abs(total) + jnp.sqrt(total * total + b * b * b))
    parabolic = jnp.sign(total) * (w - b / jnp.where(w == 0, 1.0, w)) - u0

    root = jnp.sqrt(jnp.abs(jnp.where(beta == 0, 1.0, beta)))
    strength = jnp.where(mu == 0, 1.0, mu)
    cosine, sine = 1 - beta * r / strength, root * eta / strength
    motion = root**3 * span / strength
    e2 = cosine * cosine + jnp.where(beta > 0, 1.0, -1.0) * sine * sine
    e = jnp.sqrt(jnp.maximum(e2, 1e-30))
    start = jnp.arctan2(sine, cosine)
    mean = start - sine + motion
    elliptic = (mean + 0.85 * jnp.minimum(e, 1.0) * jnp.sign(jnp.sin(mean)) - start) / root

    def on_a_hyperbola(_: Any) -> Any:
        open_start = jnp.arcsinh(sine / e) * jnp.where(strength > 0, 1.0, -1.0)
        open_mean = sine - jnp.where(strength > 0, open_start, -open_start) + motion
        open_end = jnp.arcsinh(open_mean / e) * jnp.where(strength > 0, 1.0, -1.0)
        return jnp.abs(open_end - open_start) / root

    hyperbolic = lax.cond(jnp.all(beta > 0), lambda _: elliptic, on_a_hyperbola, None)
    guess = jnp.where(beta > 0, elliptic, hyperbolic)
    parabola_serves = (mu > 0) & (jnp.abs(beta) * parabolic * parabolic < 0.5)
    guess = jnp.where(parabola_serves, parabolic, guess)
    return jnp.where(mu == 0, span / r, jnp.where(jnp.isfinite(guess), guess, span / r))
