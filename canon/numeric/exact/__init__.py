"""Closed flows, one a file: functions of a state and a time that jax can trace, batch and differentiate.

Each takes the state at time 0, parameters and a time, elementwise (all of a shape, or broadcasting), and returns the
state then, without stepping: the error does not grow with the number of steps, as there are none. What cancels is
written so that it does not; where a formula has a limit (critical damping, resonance, e → 1, a separatrix), the same
formula goes through it.
"""
