"""A certificate is answered in bounded time."""

import threading
import time
from typing import Any

import pytest

from canon.checker.check import check
from canon.checker.functions import Unreadable
from canon.checker.limits import checked
from tests.checker.test_forgeries import forged, sealed


def test_what_takes_too_long_is_not_confirmed() -> None:
    many = "+".join(f"sqrt(x + {k})" for k in range(14))
    data = forged(f"1/({many})", f"1/(0 + {many})")
    data["cases"][0]["residuals"] = [{"argument": "normal form"}]
    start = time.process_time()
    answer = checked(sealed(data), seconds=0.5)
    assert answer.status == "not confirmed"
    assert "longer" in answer.reasons[0]
    assert time.process_time() - start < 20


def test_what_is_answered_in_time_is_answered_the_same() -> None:
    assert checked(forged("x", "x")) == check(forged("x", "x"))


def in_a_thread(certificate: Any, seconds: float = 120) -> list[Any]:
    """What `checked` returns, or raises, in a thread that isn't the first one."""
    found: list[Any] = []

    def run() -> None:
        try:
            found.append(checked(certificate, seconds))
        except Unreadable as error:
            found.append(str(error))

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    return found


@pytest.mark.slow
def test_another_thread_has_the_same_limits() -> None:
    """Timers are those of the first thread: a process of its own answers."""
    assert in_a_thread(forged("x", "x")) == [check(forged("x", "x"))]
    many = "+".join(f"sqrt(x + {k})" for k in range(14))
    data = forged(f"1/({many})", f"1/(0 + {many})")
    data["cases"][0]["residuals"] = [{"argument": "normal form"}]
    (answer,) = in_a_thread(sealed(data), 0.5)
    assert answer.status == "not confirmed"
    assert "longer" in answer.reasons[0]
    assert in_a_thread({"certificate": 7}) == ["this is no certificate of version 1"]


def test_what_is_no_data_is_unreadable_in_a_thread() -> None:
    assert in_a_thread({"certificate": object()}) == ["this is no certificate: it can't be written as JSON"]
