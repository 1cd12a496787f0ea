"""Surfaces as people write them: redundant, repeated, singular, complex, or empty."""

import pytest

from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.errors import InputError

# complex names; equations; left; right; verdict
SURFACES = [
    ("", ["x**2+y**2-1", "2*x**2+2*y**2-2"], "x**4+2*x**2*y**2+y**4", "1", "proved"),
    ("", ["x**2+y**2-1", "2*x**2+2*y**2-2"], "x", "y", "refuted"),
    ("", ["(x-y)**2"], "x", "y", "proved"),
    ("", ["(x-y)**2"], "x", "y*1001/1000", "refuted"),
    ("", ["(x**2+y**2-1)**2"], "x**2", "1-y**2", "proved"),
    ("", ["(x**2+y**2-1)**2"], "x**2", "1-y**2*1001/1000", "refuted"),
    ("", ["x*y"], "x", "0", "refuted"),
    ("", ["x*y"], "x*y", "0", "proved"),
    ("", ["x**2*y"], "x*y", "0", "proved"),
    ("", ["x**2*y"], "x", "0", "refuted"),
    ("", ["x**2*y"], "y", "0", "refuted"),
    ("", ["x**2+y**2"], "x**2", "-y**2", "proved"),
    ("", ["x**2+y**2"], "x+y", "0", "proved"),
    ("", ["x**2+y**2"], "x+y", "1", "refuted"),
    ("", ["(x-y)**2+(x-1)**2"], "x*y", "1", "proved"),
    ("", ["(x-y)**2+(x-1)**2"], "x*y", "1001/1000", "refuted"),
    ("", ["x**2+y**2+1"], "x", "0", "empty"),
    ("", ["y-x**2", "y"], "x", "0", "proved"),
    ("", ["y-x**2", "y"], "x", "1", "refuted"),
    ("", ["y-x**2+2", "y"], "x**2", "2", "proved"),
    ("", ["y-x**2+2", "y"], "x", "sqrt(2)", "refuted"),
    ("", ["x", "x**2+y**2-y*2"], "y*(y-2)", "0", "proved"),
    ("", ["x+1j*y"], "x+y", "0", "proved"),
    ("", ["x+1j*y"], "x+y", "1", "refuted"),
    ("", ["x+1j*y-1-2j"], "x*y", "2", "proved"),
    ("", ["x+1j*y-1-2j"], "x*y", "3", "refuted"),
    ("", ["(x+1j*y)**2-1j"], "2*x*y", "1", "proved"),
    ("", ["(x+1j*y)**2-1j"], "x", "y", "supported"),
    ("", ["(x+1j*y)**2-1j"], "x", "-y", "refuted"),
    ("z w", ["z-1j*w"], "z**2", "-w**2", "proved"),
    ("z w", ["z-1j*w"], "z**2", "w**2", "refuted"),
    ("z w", ["z*w-1"], "z", "1/w", "proved"),
    ("z w", ["z**2+w**2-1"], "z**2-1", "-w**2", "proved"),
    ("z w", ["z**2+w**2-1"], "z**2-1", "w**2", "refuted"),
    ("z w", ["z**3+w**3-1", "z**3+w**3-1"], "(z**3+w**3)**2", "1", "proved"),
    ("", ["sin(x)", "sin(x)"], "cos(x)**2", "1", "proved"),
    ("", ["sin(x)", "2*sin(x)"], "cos(x)", "1", "refuted"),
    ("", ["sin(x)**2"], "cos(x)**2", "1", "proved"),
    ("", ["exp(x)-1"], "x*y", "0", "supported"),
    ("", ["y**2-x**3"], "y**4", "x**6", "proved"),
    ("", ["y**2-x**3"], "y", "x", "refuted"),
    ("", ["y**2-x**2*(x-1)"], "y**2/x**2", "x-1", "proved"),
    ("", ["x**2-2*x*y+y**2"], "x**3", "y**3", "proved"),
    ("", ["x**3-2"], "x**6", "4", "proved"),
    ("", ["x**3-2", "x**3-2"], "x", "13/10", "refuted"),
    ("", ["x**3-2", "x**2+y**2-7", "(x**3-2)*(x-y)"], "x**3", "2", "proved"),
    ("", ["x", "y", "x+y"], "x**2", "y", "proved"),
    ("", ["x", "y", "x-y+1"], "x**2", "y", "empty"),
    ("", ["x*(x-1)", "x*(y-1)"], "x*(x-y)", "0", "proved"),
    ("", ["x*(x-1)", "x*(y-1)"], "x", "0", "refuted"),
    ("", ["(x**2+y**2-1)*(x**2+y**2-4)"], "x**2+y**2", "1", "refuted"),
    ("", ["(x**2+y**2-1)*(x**2+y**2+4)"], "x**2+y**2", "1", "proved"),
]


def _file(names: str, on: list[str], left: str, right: str) -> str:
    symbols = "".join(f'{name} = "complex"\n' for name in names.split())
    return (
        f'[phase_space]\nq = ["x"]\np = ["y"]\n[symbols]\n{symbols}[domain]\non = {on!r}\n'
        f'[[claim]]\nkind = "identity"\nlhs = "{left}"\nrhs = "{right}"\n'
    )


@pytest.mark.parametrize(("names", "on", "left", "right", "expected"), SURFACES)
def test_identity_on_a_surface(names, on, left, right, expected):
    (claim,) = read_text(_file(names, on, left, right)).claims
    if expected == "empty":
        with pytest.raises(InputError, match="empty"):
            verify(claim, budget=5.0)
        return
    assert verify(claim, budget=20.0).status == expected


@pytest.mark.parametrize(
    ("on", "left", "right", "expected"),
    [
        ("x", "bracket(elliptic_k(x)*x, y)", "elliptic_k(x)", "supported"),
        ("x", "bracket(elliptic_k(x)*x, y)", "1001/1000*elliptic_k(x)", "refuted"),
        ("x", "bracket(x**2*elliptic_k(x), y)", "0", "proved"),
        ("x", "bracket(x*y, y)", "0", "refuted"),
    ],
)
def test_brackets_come_before_the_restriction(on, left, right, expected):
    (claim,) = read_text(_file("", [on], left, right)).claims
    assert verify(claim, budget=5.0).status == expected


@pytest.mark.parametrize(
    ("where", "left", "right", "expected"),
    [
        ("y > 0", "sqrt(1-x**2)", "y", "proved"),
        ("y > 0", "sqrt(1-x**2)", "abs(y)", "proved"),
        ("y < 0", "sqrt(1-x**2)", "-y", "proved"),
        ("y > 0", "sqrt(1-x**2)", "1001/1000*y", "refuted"),
        ("y > -1/2", "sqrt(1-x**2)", "y", "refuted"),
        ("x > 0", "sqrt(1-x**2)", "y", "refuted"),
        ("x > 0", "sqrt(1-x**2)", "abs(y)", "proved"),
    ],
)
def test_roots_on_a_part_of_the_circle(where, left, right, expected):
    text = _file("", ["x**2+y**2-1"], left, right).replace("[domain]", f'[domain]\nwhere = ["{where}"]')
    (claim,) = read_text(text).claims
    assert verify(claim, budget=10.0).status == expected


@pytest.mark.parametrize(
    ("assumption", "on", "where", "left", "right", "expected"),
    [  # an equation gives y, of which the name said that it isn't 0: beyond 0 the angle is another
        ("nonzero", "y - x", ["x > -1", "x < 1e-30"], "atan(y) + atan(1/y)", "-pi/2", "refuted"),
        ("nonzero", "y - x", ["x > -1", "x < 1e-30"], "sign(y)", "-1", "refuted"),
        ("nonzero", "y - x", ["y > -1", "y < 1e-30"], "abs(y)", "-y", "refuted"),
        ("nonzero", "y - x**3", ["x > -1", "x < 1e-30"], "atan(y) + atan(1/y)", "-pi/2", "refuted"),
        ("nonzero", "y - x", ["x < 0"], "atan(y) + atan(1/y)", "-pi/2", "proved"),
        ("nonzero", "y - x", [], "atan(y) + atan(1/y)", "sign(x)*pi/2", "proved"),
        ("positive", "y - x", [], "atan(y) + atan(1/y)", "pi/2", "proved"),
    ],
)
def test_what_a_name_said_is_said_of_what_is_put_in_its_place(assumption, on, where, left, right, expected):
    names = f'[phase_space]\nq = ["x"]\np = ["p"]\n[symbols]\ny = "{assumption}"\n'
    text = f'{names}[domain]\non = ["{on}"]\nwhere = {where!r}\n'
    (claim,) = read_text(f'{text}[[claim]]\nkind = "identity"\nlhs = "{left}"\nrhs = "{right}"\n').claims
    assert verify(claim, budget=20.0).status in ({"refuted", "supported"} if expected == "refuted" else {expected})
