"""`--accuracy` of `canon verify`: whether it makes sense, and what it takes, said before anything is decided."""

from __future__ import annotations

import argparse
import sys


def no_accuracy(arguments: argparse.Namespace) -> str:
    """Return why an accuracy makes no sense here, or nothing; of one that doubles can't hold, say what can."""
    from canon.decide.to_accuracy import DOUBLE, LEAST, bits_for

    if arguments.method == "symbolic":
        return "an exact decision has none: it is for --method numeric or all"
    if not LEAST <= arguments.accuracy < 1:
        return f"give one from {LEAST:g} to 1, as 1e-30"
    if arguments.accuracy < DOUBLE:
        print(
            f"canon verify: {arguments.accuracy:g} can't be had in double precision: residuals are bounded in balls of "
            f"{bits_for(arguments.accuracy)} bits or more",
            file=sys.stderr,
        )
    return ""
