"""Filters of warnings are the process', and a thread's own errors are no other's."""

import threading
import warnings

import numpy as np
import pytest

from canon import audit
from canon.numeric.warnings_raised import warnings_raised


def test_they_are_raised_within_it_alone() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with warnings_raised():
            with pytest.raises(UserWarning, match="told"):
                warnings.warn("told", UserWarning, stacklevel=1)
            with pytest.raises(DeprecationWarning), warnings_raised():
                warnings.warn("old", DeprecationWarning, stacklevel=1)
            with pytest.raises(UserWarning, match="still"):
                warnings.warn("still", UserWarning, stacklevel=1)
        warnings.warn("not told", UserWarning, stacklevel=1)


def test_they_are_no_errors_of_another_thread() -> None:
    found = []

    def other() -> None:
        try:
            warnings.warn("elsewhere", UserWarning, stacklevel=1)
        except UserWarning as error:
            found.append(error)

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with warnings_raised():
            thread = threading.Thread(target=other)
            thread.start()
            thread.join(20)
    assert not found


def test_two_audits_at_once_leave_the_filters_as_they_were() -> None:
    """The one begins within the other's complex step and ends after it: errors stayed errors for ever."""
    first_in, second_in, first_out = threading.Event(), threading.Event(), threading.Event()

    def called(mine: threading.Event, wait_for: threading.Event, z: np.ndarray) -> np.ndarray:
        if np.iscomplexobj(z) and not mine.is_set():
            mine.set()
            wait_for.wait(20)
        return np.array([z[1], -z[0] + 0.1 * np.sin(z[1])])

    def first() -> None:
        audit(lambda z: called(first_in, second_in, z), dimension=2, samples=20)
        first_out.set()

    def second() -> None:
        first_in.wait(20)
        audit(lambda z: called(second_in, first_out, z), dimension=2, samples=20)

    before = list(warnings.filters)
    threads = [threading.Thread(target=work) for work in (first, second)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert first_out.is_set()
    assert list(warnings.filters) == before


def test_a_dropped_imaginary_part_is_an_error_in_every_thread() -> None:
    """numpy only warns, and the derivative would be 0."""

    def drops(z: np.ndarray) -> np.ndarray:
        image = np.empty(2)
        image[:] = [z[0] + z[1] ** 2, z[1]]
        return image

    verdicts = []
    threads = [
        threading.Thread(target=lambda: verdicts.append(audit(drops, dimension=2, samples=20).verdict))
        for _ in range(3)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert len(set(verdicts)) == 1
    assert len(verdicts) == 3
