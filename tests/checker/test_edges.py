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


@pytest.mark.parametrize(
    ("symbols", "domain", "claim"),
    [
        ('a = "real"', 'where = ["x > 0"]\non = ["x*p"]', 'lhs = "p"\nrhs = "0"'),
        ('a = "real"', 'where = ["x > 0"]\non = ["x*(x**2 + p**2 - 1)"]', 'lhs = "x**2 + p**2"\nrhs = "1"'),
        ('x = "positive"', 'on = ["x*p"]', 'lhs = "p"\nrhs = "0"'),
        ('a = "real"', 'on = ["x*p"]', 'lhs = "p/x"\nrhs = "0"'),
    ],
)
def test_a_point_that_is_on_the_edge_but_for_rounding_rejects_nothing(symbols: str, domain: str, claim: str) -> None:
    text = f'[phase_space]\nq = ["x"]\np = ["p"]\n[symbols]\n{symbols}\n[domain]\n{domain}'
    data = certified(text, f'kind = "identity"\n{claim}')
    assert data["verdict"] == "proved"
    assert all(check(data).status.startswith("confirmed") for _ in range(8))
