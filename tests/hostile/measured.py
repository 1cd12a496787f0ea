"""What an attack costs the processor, which attacks are large or dear by right, and how a formula comes into a file."""

from __future__ import annotations

import time

SECONDS = 5.0
"""Of a processor: ten times what the dearest takes."""
HEAVY = ("expanding power",)
"""What is a formula after all, if a large one."""
DEAR = ("derivatives nested", "brackets nested", "derivative of a tower", "denested roots", "commas")
"""What is refused only when it has been built in part; looked at once."""

HEAD = '[phase_space]\nq = ["q"]\np = ["p"]\n'
SCENE = """
[system]
q_names = ["q"]
p_names = ["p"]
H = {formula}
q = [0.1]
p = [0.5]
[run]
duration = 1.0
"""


def toml(text: str) -> str:
    """A text as a string of TOML, whatever is in it."""
    return '"' + "".join(c if c.isalnum() or c in " +-*/(),." else f"\\U{ord(c):08x}" for c in text) + '"'


def spent(action) -> float:
    start = time.process_time()
    action()
    return time.process_time() - start


def writable(formula: str) -> bool:
    return not any(0xD800 <= ord(c) < 0xE000 for c in formula)
