"""How long the catalogue's scenes take to compile and to run: CPU times, one process for all.

python docs/performance/scenes_compiled.py [NAME ...]
"""

from __future__ import annotations

import sys
import time

from canon.errors import InputError
from canon.scenes.examples import scene_text
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import simulate
from canon.scenes.systems import load_system, system_names


def main() -> None:
    print("| scene | method | compile | all |\n|---|---|--:|--:|")
    for name in sys.argv[1:] or system_names():
        try:
            scene = read_scene_text(scene_text(load_system(name)))
        except InputError:
            continue  # it does not move
        begun = time.process_time()
        result = simulate(scene)
        whole = time.process_time() - begun
        print(f"| {name} | `{result.choice.method.name}` | {result.seconds[0]:.2f} s | {whole:.2f} s |", flush=True)


if __name__ == "__main__":
    main()
