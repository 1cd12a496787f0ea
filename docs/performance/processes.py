"""What the commands cost as whole processes, imports and all.

    python docs/performance/processes.py [--runs 5]

Prints the median of CPU time (user and system, children included) and of wall time.
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

ONE_CLAIM = Path(__file__).parent / "oscillator.toml"


def spent() -> float:
    """CPU seconds of all children that have ended."""
    times = os.times()
    return times.children_user + times.children_system


def measured(arguments: list[str], runs: int) -> tuple[float, float]:
    """Median CPU and wall seconds of `canon` with these arguments."""
    cpu, wall = [], []
    for _ in range(runs):
        before, start = spent(), time.perf_counter()
        subprocess.run([sys.executable, "-m", "canon", *arguments], stdout=subprocess.DEVNULL, check=True)
        cpu.append(spent() - before)
        wall.append(time.perf_counter() - start)
    return statistics.median(cpu), statistics.median(wall)


def main() -> None:
    """Print one line for each command."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=5)
    runs = parser.parse_args().runs
    commands = [
        ("canon --help", ["--help"], runs),
        ("canon verify oscillator.toml (one claim)", ["verify", str(ONE_CLAIM)], runs),
        ("canon verify --jobs 1 (the catalogue)", ["verify", "--fresh", "--jobs", "1"], 1),
        ("canon verify --jobs 2 (the catalogue)", ["verify", "--fresh", "--jobs", "2"], 1),
    ]
    print("| command | CPU time | wall time |", "|---|--:|--:|", sep="\n")
    for name, arguments, count in commands:
        cpu, wall = measured(arguments, count)
        print(f"| `{name}` | {cpu:.2f} s | {wall:.2f} s |", flush=True)


if __name__ == "__main__":
    main()
