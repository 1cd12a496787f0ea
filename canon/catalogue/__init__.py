"""The built-in catalogue: claim files of classical mechanics, shipped as package data.

Six rooms: `course` (the statements of a course on Hamiltonian mechanics), `errata` (its printed errors, each beside
the corrected statement), `transformations`, `brackets` and `flows` (textbook maps, algebras and evolutions, with
near misses that must be refuted), and `actions` (action variables, frequencies and normal forms).
"""

import re
from importlib.resources import files as _package_files
from importlib.resources.abc import Traversable

ROOMS = ("course", "errata", "transformations", "brackets", "flows", "actions")


_SOURCE = re.compile(r'^source\s*=\s*"([^"]*)"', re.MULTILINE)


def files() -> tuple[Traversable, ...]:
    """Every claim file of the catalogue, room by room: those of the course and its errata in the order of the ids that
    they cite first, the others by name.

    **Returns** the files as `importlib.resources` traversables: `.name`, `.read_text(encoding="utf-8")`; they are
    plain paths wherever the package is installed as files.
    """
    from canon.catalogue.ledger import cited, errata, statements

    places = {item.id: place for place, item in enumerate((*statements(), *errata()))}
    catalogue = _package_files(__name__)

    def order(room: str, entry: Traversable) -> tuple[int, str]:
        if room not in ("course", "errata"):
            return 0, entry.name
        sources = _SOURCE.findall(entry.read_text(encoding="utf-8"))
        named = [name for source in sources for name in cited(source)]
        wanted = [places[name] for name in named if name.startswith("E") == (room == "errata")]
        return (wanted or [len(places)])[0], entry.name

    return tuple(
        entry
        for room in ROOMS
        for entry in sorted(catalogue.joinpath(room).iterdir(), key=lambda found, room=room: order(room, found))
        if entry.name.endswith(".toml")
    )
