"""The systems of the catalogue that move, one a file: coordinates, parameters, the Hamiltonian effect by effect."""

from importlib.resources import files as _package_files
from importlib.resources.abc import Traversable


def system_files() -> dict[str, Traversable]:
    """Every system's file by the system's name, in alphabetical order."""
    entries = sorted(_package_files(__name__).iterdir(), key=lambda found: found.name)
    return {entry.name.removesuffix(".toml"): entry for entry in entries if entry.name.endswith(".toml")}
