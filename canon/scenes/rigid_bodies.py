"""Rigid bodies: their tables in a scene file."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from canon.claims import document
from canon.claims.document import Table, key
from canon.errors import InputError
from canon.numeric.integrators.rigid_body import check_moments
from canon.scenes.bodies import MOST
from canon.scenes.rigid import RigidBody, rigid_body_named
from canon.scenes.systems import WHERE, named_system, read_parameters
from canon.scenes.values import needed, number, numbers

KEYS: Final = ("name", "moments", "attitude", "euler", "angular_velocity", "angular_momentum")
REST: Final = (1.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Spin:
    """A rigid body with its initial attitude, and its angular momentum in the body's frame."""

    body: RigidBody
    attitude: tuple[float, ...]
    M: tuple[float, ...]


def read_rigid_bodies(value: Any, default: str = "body") -> tuple[Spin, ...]:
    """The rigid bodies of a scene, called `default` and their number where they have no name. **Raises:** `InputError`
    with the place.
    """
    if isinstance(value, dict):
        raise InputError("rigid bodies are a list: write [[rigid_body]], in double brackets", "rigid_body")
    tables = document.listing(value, "rigid_body", document.BIGGEST)
    if not 1 <= len(tables) <= MOST:
        raise InputError(f"{len(tables)} rigid bodies: a scene has from 1 to {MOST}", "rigid_body")
    spins = list[Spin]()
    for index, item in enumerate(tables, 1):
        where = f"rigid_body {index}"
        suffix = "" if len(tables) == 1 else f"_{index}"
        spin = _spin(document.table(item, where), where, f"{default}{index}", suffix)
        if any(spin.body.name == other.body.name for other in spins):
            raise InputError(f"there are two rigid bodies {spin.body.name!r}", key("name", where))
        spins.append(spin)
    return tuple(spins)


def _spin(table: Table, where: str, default: str, suffix: str) -> Spin:
    document.only(table, KEYS, where)
    name = document.text(table.get("name", default), key("name", where))
    if not name or len(name) > 80:
        raise InputError("a name of 1 to 80 letters is expected", key("name", where))
    moments = checked(numbers(needed(table, "moments", where), key("moments", where), [3]), key("moments", where))
    body = rigid_body_named(name, moments, suffix)
    attitude = read_attitude(table, where)
    return Spin(body, attitude, _momentum(table, where, moments, attitude))


def read_top(table: Table) -> Spin:
    """The top of the catalogue, a [system] with the state M. **Raises:** `InputError`."""
    document.only(table, ("name", "parameters", "M", "attitude", "euler"), WHERE)
    system = named_system(table)
    values, _, place = read_parameters(system, table)
    moments = checked(tuple(values[word] for word in ("I1", "I2", "I3")), place)
    M = numbers(needed(table, "M", WHERE), key("M", WHERE), [3])
    body = rigid_body_named(system.name, moments)
    return Spin(body, read_attitude(table, WHERE), tuple(map(float, M)))


def checked(moments: tuple[Any, ...], where: str) -> tuple[Any, ...]:
    """Moments of a body that can be. **Raises:** `InputError`."""
    try:
        check_moments([float(moment) for moment in moments])
    except InputError as error:
        raise error.at(where) from None
    return moments


def read_attitude(table: Table, where: str) -> tuple[float, ...]:
    """The unit quaternion of `attitude`, of `euler`, or of no rotation where neither is given."""
    value: Any = table.get("attitude")
    if isinstance(value, dict):
        document.only(value, ("euler",), key("attitude", where))
        if "euler" in table:
            raise InputError("the Euler angles are given twice", where)
        table, value, where = {"euler": needed(value, "euler", where)}, None, key("attitude", where)
    if value is not None and "euler" in table:
        raise InputError("both 'attitude' and 'euler' are given", where)
    if "euler" in table:
        angles = numbers(table["euler"], key("euler", where), [3])
        return _from_euler(*map(float, angles))
    if value is None:
        return REST
    if isinstance(value, list) and len(value) == 3:
        raise InputError("a quaternion w, x, y, z is expected: three angles are euler = [phi, theta, psi]", where)
    quaternion = np.array([float(part) for part in numbers(value, key("attitude", where), [4])])
    size = float(np.linalg.norm(quaternion))
    if not (0 < size < np.inf):
        raise InputError("the quaternion 0 is no attitude: [1, 0, 0, 0] is no rotation", key("attitude", where))
    return tuple(float(part) for part in quaternion / size)


def _from_euler(phi: float, theta: float, psi: float) -> tuple[float, ...]:
    """Turned by φ about z, by θ about the line of nodes, by ψ about the body's third axis. Goldstein, 4.4."""
    total, less = (phi + psi) / 2, (phi - psi) / 2
    c, s = np.cos(theta / 2), np.sin(theta / 2)
    return (
        float(c * np.cos(total)),
        float(s * np.cos(less)),
        float(s * np.sin(less)),
        float(c * np.sin(total)),
    )


def _momentum(table: Table, where: str, moments: tuple[Any, ...], attitude: tuple[float, ...]) -> tuple[float, ...]:
    """M in the body's frame, from ω there, or from M in space."""
    if "angular_velocity" in table and "angular_momentum" in table:
        raise InputError("both 'angular_velocity' and 'angular_momentum' are given", where)
    if "angular_momentum" in table:
        given = numbers(table["angular_momentum"], key("angular_momentum", where), [3])
        w, u = attitude[0], np.array(attitude[1:])
        v = np.array([float(part) for part in given])
        twice = 2 * np.cross(u, v)
        return tuple(float(part) for part in v - w * twice + np.cross(u, twice))
    given = (
        numbers(table["angular_velocity"], key("angular_velocity", where), [3])
        if "angular_velocity" in table
        else (number(0, where),) * 3
    )
    return tuple(float(moment * part) for moment, part in zip(moments, given, strict=True))
