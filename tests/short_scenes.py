"""Scenes for tests of what is round a run."""

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
"""A pendulum, five states, hardly any time."""
HENON = """
[system]
q_names = ["x", "y"]
p_names = ["px", "py"]
H = "(px**2 + py**2)/2 + (x**2 + y**2)/2 + x**2*y - y**3/3"
q = [0.0, 0.1]
p = [0.5, 0.0]
[run]
"""
"""Hénon's and Heiles' system, in chaos; how it is run is to be added."""
