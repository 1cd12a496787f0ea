"""Scene files of the catalogue's systems: complete, with all parameters, and ready to run."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from canon.scenes.systems import System


def scene_text(system: System) -> str:
    """A scene file that runs the system's example, and says what may be changed in it."""
    return "\n".join(_lines(system)) + "\n"


def _lines(system: System) -> Iterator[str]:
    yield f"# {system.title}"
    yield f"# effects: {', '.join(system.terms)}"
    if system.note:
        yield f"# {system.note}"
    yield f"title = {_value(system.title)}"
    yield ""
    yield "[system]"
    yield f"name = {_value(system.name)}"
    parameters = {**system.parameters, **{name: default for name, (_, default) in system.functions.items()}}
    if parameters:
        yield f"parameters = {{ {', '.join(f'{name} = {_value(value)}' for name, value in parameters.items())} }}"
    for name, (of, _) in system.functions.items():
        yield f"# {name} is any expression in {', '.join(of)}"
    for word in system.own or ("q", "p"):
        names = "" if system.own else f"  # {', '.join(getattr(system, word))}"
        yield f"{word} = {_value(system.example[word])}{names}"
    yield ""
    yield "[run]"
    yield f"duration = {_value(system.example['duration'])}"
    yield "accuracy = 1e-9"
    yield f"monitor = {_value(list(system.example['monitor']))}"


def _value(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_value, value))}]"
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else str(value)
