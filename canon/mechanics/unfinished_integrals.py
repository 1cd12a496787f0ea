"""What sympy remembers of integrals that it hasn't finished, which is forgotten before it is asked anew.

Its rules for integrals note each integrand that they are at, so as not to go round in circles, and take the note away
when they are done with it. A call that fails, or is given up when its time is over (`canon.deadline`), leaves its notes
behind: the same integrand, met again, has then no antiderivative, until the process ends.
"""

from __future__ import annotations

from contextlib import suppress


def forget_unfinished_integrals() -> None:
    """Forget the notes of earlier calls of `manualintegrate`, or of `integrate`, in this process."""
    from sympy.integrals import manualintegrate as rules

    with suppress(AttributeError):  # another version may keep them elsewhere
        rules._integral_cache.clear()  # pyright: ignore[reportPrivateUsage]
        rules._parts_u_cache.clear()  # pyright: ignore[reportPrivateUsage]
