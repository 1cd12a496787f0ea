"""How figures look: as matplotlib draws them by itself, wherever they are drawn.

matplotlib reads a file `matplotlibrc` of the working folder, which may come with the scenes that are drawn, and might
hand their titles to TeX. What is in it is forgotten here; what a program that imports canon has set is back afterwards.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager

from canon.report.words import visible

SETTINGS = "matplotlibrc"


@contextmanager
def plain() -> Iterator[None]:
    """Within, figures have matplotlib's own settings. **Raises:** `OSError` where it can't be loaded."""
    if os.path.exists(SETTINGS) and not os.path.isfile(SETTINGS):
        raise OSError(errno.EINVAL, f"{SETTINGS!r} here is no regular file, and matplotlib would wait for it")
    try:
        import matplotlib
    except ValueError as error:  # the settings are no text
        raise OSError(errno.EINVAL, f"matplotlib can't read its file {SETTINGS!r}: {error}") from None
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        yield


def words(text: str) -> str:
    """A text that is drawn as it is: a dollar is no beginning of a formula."""
    return visible(text).replace("$", r"\$")
