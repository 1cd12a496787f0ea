"""Where both sides of `>=` may be equal all over a part of the domain, the checker has nothing to say."""

import pytest

from canon.checker.check import check
from tests.checker.certified import certified, resealed

LINE = '[phase_space]\nq = ["x"]\np = ["p"]\n[symbols]\na = "real"\n'


@pytest.mark.parametrize(
    ("strict", "claim", "status"),
    [
        ("x + abs(x) > 0", 'kind = "independent"\nfunctions = ["p", "x + abs(x)"]', "confirmed in part"),
        ("a > 0", 'kind = "independent"\nfunctions = ["x", "a*p"]', "confirmed in part"),
        ("x > 1", 'kind = "identity"\nlhs = "sqrt(x**2)"\nrhs = "x"', "confirmed"),
        ("a > 1", 'kind = "identity"\nlhs = "sqrt(a**2)"\nrhs = "a"', "confirmed"),
    ],
)
def test_it_is_taken_on_trust(strict: str, claim: str, status: str) -> None:
    data = certified(f'{LINE}[domain]\nwhere = ["{strict}"]', claim)
    assert check(data).status == "confirmed"
    data["tables"]["domain"]["where"] = [strict.replace(">", ">=")]
    answer = check(resealed(data))
    assert answer.status == status
    assert ("both sides of" in str(answer)) == (status != "confirmed")


def test_so_it_is_on_a_surface() -> None:
    data = certified(f'{LINE}[domain]\nwhere = ["x > 0"]\non = ["x*p"]', 'kind = "identity"\nlhs = "p"\nrhs = "0"')
    data["tables"]["domain"]["where"] = ["x >= 0"]
    assert "both sides of x >= 0 are equal" in str(check(resealed(data)))
