"""`python -m canon` is the command `canon`."""

import os
import sys


def entry() -> None:
    """Run as a program. Ctrl-C is heard while it is still being loaded, too."""
    try:
        from canon.cli.main import entry as loaded
    except KeyboardInterrupt:
        print("canon: interrupted", file=sys.stderr, flush=True)
        os._exit(130)
    loaded()


if __name__ == "__main__":
    entry()
