"""What a chain of bodies joined by rods costs to compile: CPU time, and the memory of a process of its own.

python docs/performance/chain_of_rods.py [LINKS ...]
"""

from __future__ import annotations

import resource
import subprocess
import sys

from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import simulate

LINKS = (3, 10, 20, 40, 100)


def chain(links: int) -> str:
    """A chain that hangs from the origin and is let go when it is stretched out."""
    bodies = [f'[[body]]\nname = "b{k}"\nmass = 1.0\nposition = [{k + 1}.0, 0.0]\n' for k in range(links)]
    bodies = [f"{body}velocity = [0.0, 0.0]\n" for body in bodies]
    ends = ['bodies = ["b0"]', *(f'bodies = ["b{k}", "b{k + 1}"]' for k in range(links - 1))]
    rods = [f'[[effect]]\nkind = "rod"\nlength = 1.0\n{end}\n' for end in ends]
    fall = '[[effect]]\nkind = "uniform_gravity"\ng = 9.81\n'
    return "".join([*bodies, fall, *rods, "[run]\nduration = 1.0\naccuracy = 1e-6\nsamples = 11\n"])


def main() -> None:
    if sys.argv[1:2] == ["--one"]:
        result = simulate(read_scene_text(chain(int(sys.argv[2]))))
        most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        compiling, running = result.seconds
        print(f"| {sys.argv[2]} | {compiling:.1f} s | {running:.1f} s | {most:.0f} MB |", flush=True)
        return
    print("| rods | compile | the rest | memory |\n|--:|--:|--:|--:|", flush=True)
    for links in map(int, sys.argv[1:] or LINKS):
        subprocess.run([sys.executable, __file__, "--one", str(links)], check=True)  # noqa: S603 - this very script


if __name__ == "__main__":
    main()
