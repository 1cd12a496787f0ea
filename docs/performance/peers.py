"""canon beside other packages: how long each takes to an accuracy, both sides in turns in one run.

    pip install -e '.[peers,native]'
    python docs/performance/peers.py [--only orbits orbit kepler pendulum bodies] [--json FILE]

All times are CPU times, medians of nine runs. Of every package the fastest of the settings that are listed in
`peers_*.py` is taken that reaches the error. Compilation is not counted; docs/performance/peers.md tells it apart.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from importlib import import_module
from importlib.metadata import version
from pathlib import Path

from peers_common import Row

TASKS = ("orbits", "orbit", "kepler", "pendulum", "bodies")
PACKAGES = ("canon-mechanics", "jax", "llvmlite", "heyoka", "diffrax", "rebound", "numba", "numpy")


def table(rows: Sequence[Row]) -> Iterator[str]:
    yield "| task | to | canon | beside | ratio | asked for | |"
    yield "|---|---|--:|---|--:|--:|---|"
    for row in rows:
        ours = row.sides["canon"]
        for name, side in row.sides.items():
            if name == "canon":
                continue
            mine = "–" if ours is None else f"{shown(ours.seconds)} ({ours.error:.0e})"
            theirs = f"{name} –" if side is None else f"{name} {shown(side.seconds)} ({side.error:.0e})"
            ratio = None if ours is None or side is None else side.seconds / ours.seconds
            goal = row.goals.get(name)
            shown_ratio = "" if ratio is None else f"{ratio:.0f}" if ratio >= 10 else f"{ratio:.2g}"
            mark = "" if goal is None or ratio is None else "✓" if ratio >= goal else "not met"
            asked = "" if goal is None else f"{goal:.3g}"
            yield f"| {row.task} | {row.target} | {mine} | {theirs} | {shown_ratio} | {asked} | {mark} |"


def shown(seconds: float) -> str:
    """A time in three digits."""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"


def machine() -> str:
    names = [line.split(":")[1].strip() for line in cpu_lines() if line.startswith("model name")]
    return f"{names[0] if names else platform.processor()}, Python {platform.python_version()}"


def cpu_lines() -> list[str]:
    path = Path("/proc/cpuinfo")
    return path.read_text().splitlines() if path.exists() else []


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", nargs="+", choices=TASKS, default=TASKS)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    # one core, before any package makes threads: with two of them XLA divides loops, and the CPU time of waiting counts
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    rows = list[Row]()
    for task in options.only:
        for row in import_module(f"peers_{task}").rows():
            rows.append(row)
            print("\n".join(list(table([row]))[2:]), flush=True)
    about = {"machine": machine(), "versions": {name: version(name) for name in PACKAGES}}
    print("\n".join(["", *table(rows), "", about["machine"], str(about["versions"])]))
    if options.json:
        options.json.write_text(json.dumps({**about, "rows": [asdict(row) for row in rows]}, indent=1) + "\n")


if __name__ == "__main__":
    main()
