"""The built-in catalogue: claim files of classical mechanics, shipped as package data.

Six rooms: `course` (the statements of a course on Hamiltonian mechanics), `errata` (its printed errors, each beside
the corrected statement), `transformations`, `brackets` and `flows` (textbook maps, algebras and evolutions, with
near misses that must be refuted), and `actions` (action variables, frequencies and normal forms).
"""

from importlib.resources import files as _package_files
from importlib.resources.abc import Traversable

ROOMS = ("course", "errata", "transformations", "brackets", "flows", "actions")


def files() -> tuple[Traversable, ...]:
    """Every claim file of the catalogue, room by room and by name within a room.

    **Returns** the files as `importlib.resources` traversables: `.name`, `.read_text(encoding="utf-8")`; they are
    plain paths wherever the package is installed as files.
    """
    catalogue = _package_files(__name__)
    return tuple(
        entry
        for room in ROOMS
        for entry in sorted(catalogue.joinpath(room).iterdir(), key=lambda found: found.name)
        if entry.name.endswith(".toml")
    )
