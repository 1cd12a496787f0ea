"""Actions, frequencies and angles in numbers, each with a bound of its error.

One degree of freedom is computed with balls of as many digits as the case needs, so that neither a small energy above
a minimum nor a small distance from a separatrix loses any; orbits by the thousand are computed in double precision by
jax, in forms that do not cancel. J = ∮ p dq, without a factor 1/2π, and angles grow by 1 in a period.
"""
