"""`python -m canon` is the command `canon`."""

from canon.cli.main import entry

if __name__ == "__main__":
    entry()
