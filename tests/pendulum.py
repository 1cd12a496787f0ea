"""A scene for tests of what is round a run: a pendulum, five states, hardly any time."""

PENDULUM = """
[system]
q_names = ["q"]
p_names = ["p"]
H = "p**2/2 - cos(q)"
q = [0.1]
p = [0.5]
[run]
duration = 2.0
samples = 5
step = 0.1
integrator = "verlet"
"""
