"""Exponential and logarithm on the groups of mechanics, in jax: batched, differentiable, one group a file.

Rotations are active: exp of a vector v turns vectors by the angle |v| about v, counter-clockwise seen from its tip. The
passive rotation, of the axes instead, is exp(−v), the transpose. Boosts are active as well: exp takes a particle at
rest into one of velocity tanh|ζ| along ζ. Arguments have any leading axes; results have the precision of the arguments
(`canon.numeric.precision.double` for 64 bits).
"""
