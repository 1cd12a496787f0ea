"""A certificate is answered in bounded time."""

import time

from canon.checker.check import check
from canon.checker.limits import checked
from tests.checker.test_forgeries import forged


def test_what_takes_too_long_is_not_confirmed() -> None:
    many = "+".join(f"sqrt(x + {k})" for k in range(14))
    data = forged(f"1/({many})", f"1/(0 + {many})")
    data["cases"][0]["residuals"] = [{"argument": "normal form"}]
    from tests.checker.test_forgeries import sealed

    start = time.process_time()
    answer = checked(sealed(data), seconds=0.5)
    assert answer.status == "not confirmed"
    assert "longer" in answer.reasons[0]
    assert time.process_time() - start < 20


def test_what_is_answered_in_time_is_answered_the_same() -> None:
    assert checked(forged("x", "x")) == check(forged("x", "x"))
