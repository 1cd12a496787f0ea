"""Many orbits or points over all devices of jax: one program, whose last axis is divided among them.

jax's own sharding does the work: what is elementwise along that axis stays on its device, and what looks at all of it
(whether any orbit is still finite) is gathered by the compiler. Devices are what `jax.devices()` lists, those of other
hosts too where `jax.distributed` has been initialised.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, Final

import numpy as np

AXIS: Final = "orbits"


def devices_for(count: int) -> int:
    """Over how many devices so many orbits are divided: the most that divide them evenly."""
    import jax

    present = len(jax.devices())
    return next(k for k in range(min(present, max(count, 1)), 0, -1) if count % k == 0)


def spread(tree: Any, count: int) -> Any:
    """The arrays of a tree with their last axis, where it is as long as `count`, divided among the devices; what has no
    such axis is on all of them. Where there is one device, the tree as it is.
    """
    import jax

    number = devices_for(count)
    if number == 1:
        return tree

    def put(x: Any) -> Any:
        shape = np.shape(x)
        along = len(shape) > 0 and shape[-1] == count
        return jax.device_put(x, along_last(number, len(shape) if along else 0))

    return jax.tree.map(put, tree)


@lru_cache(maxsize=64)
def along_last(devices: int, rank: int) -> Any:
    """The sharding of an array of this rank along its last axis (of rank 0: a copy on each) over so many devices."""
    import jax
    from jax.sharding import Mesh, NamedSharding, PartitionSpec

    mesh = Mesh(np.array(jax.devices()[:devices]), (AXIS,))
    return NamedSharding(mesh, PartitionSpec(*[None] * (rank - 1), AXIS) if rank else PartitionSpec())
