"""Every system of the ledger that moves: its scene is run by the command, its monitors and states are compared with
textbook formulas.

python -m properties.ledger_scenes [NAME …]
"""

from __future__ import annotations

import contextlib
import io
import json
import sys

from canon.cli.main import main as canon
from canon.scenes.systems import load_system, system_names
from tests.scenes.ledger import deviations


def main() -> int:
    """Print a table, one row a system; the exit status is 1 if something is further off than was asked for."""
    print("| system | scene | monitors: largest drift | what is said of it: how far off |")
    print("|---|---|---|---|")
    worst = 0
    for name in sys.argv[1:] or system_names():
        shown = io.StringIO()
        with contextlib.redirect_stdout(shown):
            status = canon(["simulate", name, "--json"])
        record = json.loads(shown.getvalue())
        monitors = [
            f"{monitor} {reading['expected']}"
            + ("" if reading["max_drift"] is None else f" {reading['max_drift']:.0e}")
            for monitor, reading in record["monitors"].items()
        ]
        off = deviations(name, record)
        bad = status != 0 or max(off.values()) > 20 * record["accuracy"]["asked"]
        worst |= bad
        said = "; ".join(f"{what}: {far:.0e}" for what, far in off.items())
        print(
            f"| {load_system(name).ledger} | `{name}` | {'; '.join(monitors) or '–'} | {said}{' ✗' * bad} |", flush=True
        )
    return worst


if __name__ == "__main__":
    sys.exit(main())
