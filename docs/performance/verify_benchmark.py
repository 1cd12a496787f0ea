"""The benchmark of verdicts: canon beside `sympy.simplify`, in one run, case by case.

    python docs/performance/verify_benchmark.py [--cap 60] [--only NAME] [--json FILE]

Writes `verify_benchmark.json` (or FILE) as it goes, and from it `verify_benchmark.md` and `verify_benchmark.png`.
Every case runs in a process of its own, which is killed when simplify has used its cap.
"""

from __future__ import annotations

import argparse
import json
import platform
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path
from typing import Any

from cases_all import all_cases
from figure import draw
from table import write_table

HERE = Path(__file__).parent
WALL = 6.0
"""Wall time that a process may take, as a multiple of its CPU time, before it counts as stuck."""


def measured(name: str, options: argparse.Namespace) -> dict[str, Any]:
    """One case's record: canon's runs and phases, and simplify's time, or that it was stopped."""
    command = [sys.executable, str(HERE / "measure.py"), name, "--cap", str(options.cap), "--runs", str(options.runs)]
    command += ["--skip-simplify"] if options.skip_simplify else []
    command += ["--skip-canon"] if options.skip_canon else []
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        out, error = process.communicate(timeout=WALL * (options.cap + 60.0))
    except subprocess.TimeoutExpired:
        process.kill()
        out, error = process.communicate()
    record: dict[str, Any] = {}
    for line in out.splitlines():
        record.update(json.loads(line))
    if record.pop("started", None) and "simplify" not in record:
        record["simplify"] = {"stopped": "memory" if "MemoryError" in error else "cap", "cap": options.cap}
    elif process.returncode:
        raise RuntimeError(f"{name}: {error}")
    return record


def machine() -> dict[str, str]:
    """What the run was made with."""
    return {
        "python": platform.python_version(),
        "sympy": version("sympy"),
        "python-flint": version("python-flint"),
        "processor": _processor(),
    }


def _processor() -> str:
    """The processor's name."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    return next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), "unknown")


def main(arguments: list[str]) -> None:
    """Measure, and write the JSON record, the table and the figure."""
    parser = argparse.ArgumentParser(description="Time per verdict, canon beside sympy.simplify.")
    parser.add_argument("--cap", type=float, default=60.0, help="CPU seconds that simplify may use for a case")
    parser.add_argument("--only", action="append", metavar="NAME", help="cases whose name contains this")
    parser.add_argument("--json", type=Path, default=HERE / "verify_benchmark.json", metavar="FILE")
    parser.add_argument("--runs", type=int, default=7, help="fresh runs of canon, of which the median counts")
    parser.add_argument("--skip-simplify", action="store_true", help="canon alone; simplify's times in FILE are kept")
    parser.add_argument("--skip-canon", action="store_true", help="simplify alone; canon's times in FILE are kept")
    options = parser.parse_args(arguments)
    report: dict[str, Any] = {"cases": {}}
    if options.json.exists() and (options.only or options.skip_simplify or options.skip_canon):
        report = json.loads(options.json.read_text())
    report["machine"], report["cap"] = machine(), options.cap
    for name in all_cases():
        if options.only and not any(part in name for part in options.only):
            continue
        record = measured(name, options)
        report["cases"][name] = {**report["cases"].get(name, {}), **record}
        options.json.write_text(json.dumps(report, indent=1) + "\n")
        print(_line(name, report["cases"][name]), flush=True)
    if all("canon" in case for case in report["cases"].values()):
        target = options.json.with_suffix("")
        write_table(report, target.with_suffix(".md"))
        draw(report, target.with_suffix(".png"))


def _line(name: str, record: dict[str, Any]) -> str:
    parts = [f"{name:32}"]
    if "canon" in record:
        parts.append(f"{record['canon']['verdict']:9} {1000 * record['canon']['seconds']:9.2f} ms")
    if "simplify" in record:
        found = record["simplify"]
        parts.append(f"simplify stopped ({found['stopped']})" if "stopped" in found else f"{found['seconds']:9.3f} s")
    return "  ".join(parts)


if __name__ == "__main__":
    main(sys.argv[1:])
