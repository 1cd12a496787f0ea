"""The table of hard cases in hard.md, from a run of the whole catalogue, slow cases included.

python docs/performance/hard.py                 runs `canon hard --slow --json`, writes hard.json and the table
python docs/performance/hard.py --from hard.json   writes the table of a record that there is
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
BEGIN, END = "<!-- table -->\n", "<!-- end -->\n"


def record() -> dict[str, Any]:
    """The record of a run, or the one that is asked for."""
    if len(sys.argv) > 2 and sys.argv[1] == "--from":
        return json.loads(Path(sys.argv[2]).read_text(encoding="utf-8"))
    command = [sys.executable, "-m", "canon", "hard", "--slow", "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    found = json.loads(done.stdout)
    (HERE / "hard.json").write_text(json.dumps(found, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")
    return found


def table(cases: list[dict[str, Any]]) -> str:
    """One line a case, at the point at which the naive formula falls shortest."""
    lines = ["| | condition | allowed | naive | ours | peers | |", "|---|--:|--:|--:|--:|---|---|"]
    family = ""
    for case in cases:
        if case["family"] != family:
            family = case["family"]
            lines.append(f"| **{family}** | | | | | | |")
        shown = max(case["points"], key=lambda each: each["allowed"] - each["naive"])
        peers = ", ".join(
            f"{name} {'absent' if kept is None else f'{kept:.1f}'}" for name, kept in shown["peers"].items()
        )
        lines.append(
            f"| {case['name']} | {shown['condition']:.0e} | {shown['allowed']:.1f} | {shown['naive']:.1f} | "
            f"{shown['ours']:.1f} | {peers} | {case['verdict']} |"
        )
    return "\n".join(lines) + "\n"


def summary(cases: list[dict[str, Any]]) -> str:
    """What the table amounts to."""
    kept = sum(case["verdict"] == "kept" for case in cases)
    naive = sum(case["naive_fails"] for case in cases)
    peers = sum(bool(case["peers_failing"]) for case in cases)
    points = sum(len(case["points"]) for case in cases)
    opened = "\n".join(f"- *{case['name']}* is open: {case['open']}." for case in cases if case["verdict"] == "open")
    lost = ", ".join(case["name"] for case in cases if case["verdict"] == "lost") or "none"
    return (
        f"\n{len(cases)} cases at {points} points: {kept} kept, lost without a reason: {lost}. The naive formula loses "
        f"digits in {naive}, a peer in {peers}.\n\n{opened}\n"
    )


def main() -> None:
    cases = record()["cases"]
    page = HERE / "hard.md"
    text = page.read_text(encoding="utf-8")
    before, rest = text.split(BEGIN)
    _, after = rest.split(END)
    page.write_text(before + BEGIN + table(cases) + summary(cases) + END + after, encoding="utf-8")


if __name__ == "__main__":
    main()
