"""CPU time and memory of a long run with a fixed step: Hénon and Heiles, 1e5 steps beside 1e8.

python docs/performance/long_run.py [STEPS…]
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

SCENE = """
[system]
q_names = ["x", "y"]
p_names = ["px", "py"]
H = "(px**2 + py**2)/2 + (x**2 + y**2)/2 + x**2*y - y**3/3"
q = [0.0, 0.1]
p = [0.4, 0.0]
[run]
duration = {duration}
step = 0.01
samples = 1001
monitor = ["energy"]
"""


def measured(steps: float) -> str:
    """One line of the table: a process of its own, its record, its CPU time and its largest resident memory."""
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder) / "scene.toml"
        scene.write_text(SCENE.format(duration=steps / 100))
        command = [sys.executable, "-m", "canon", "simulate", str(scene), "--json", "--out", f"{folder}/states.npz"]
        with open(f"{folder}/record.json", "w+") as record:
            process = subprocess.Popen(command, stdout=record)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            if process.returncode not in (0, 1):
                raise SystemExit(f"{' '.join(command)} ended with {process.returncode}")
            record.seek(0)
            run = json.load(record)
    drift = run["monitors"]["energy"]["max_drift"]
    spent = usage.ru_utime + usage.ru_stime
    return (
        f"{run['steps']:12d} {run['integrator']['name']} {spent:8.1f} s {usage.ru_maxrss / 1024:7.0f} MiB {drift:10.1e}"
    )


if __name__ == "__main__":
    print("       steps method   CPU time   memory   energy's drift")
    for count in sys.argv[1:] or ("1e5", "1e8"):
        print(measured(float(count)), flush=True)
