"""Scenes: which bodies there are and which effects act, what of them moves how, and what is kept on the way.

A scene's way: `reader` (file to `Scene`), `effects` (each adds its own terms), `model` (the Hamiltonian), `problem`
(what an integrator takes), `simulate` (the run, by the planner of `canon.numeric`), `monitors`.
"""
