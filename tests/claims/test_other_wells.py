"""Claims that name no well, or one outside of the domain: of which orbit they speak."""

import pytest

from canon.errors import InputError
from tests.claims.test_action import LINE, action_claim

TWO_WELLS = 'H = "p**2/2 + q**2*(q - 10)**2/100"'
RADIAL = {
    "symbols": 'E = "positive"\nw = "positive"\ng = "positive"',
    "hamiltonian": 'H = "p**2/2 + w**2*q**2/2 + g/(2*q**2)"',
}


def mean_claim(f: str, equals: str, **keys: str) -> str:
    return action_claim(equals, kind="average", f=f'"{f}"', **keys)


def _where(condition: str) -> str:
    return f'where = ["{condition}"]'


@pytest.mark.parametrize(
    "claim",
    [
        action_claim("pi*(E/w - sqrt(g))", well='"-1"'),
        action_claim("pi*(E/w - sqrt(g)) + 1/1000", well='"-1"'),
        action_claim("w/pi", kind="frequency", well='"-sqrt(E)/w"'),
    ],
)
def test_a_well_outside_of_the_domain_is_none(ask, claim):
    """p² is even in q, so that it is positive at the image of the well, too, where nothing is."""
    try:
        (verdict,) = ask(claim, space=LINE, domain=_where("q > 0"), **RADIAL)
    except InputError:
        return
    assert verdict.status == "undecided"


def test_the_wells_of_the_domain_are_there(ask):
    (inside,) = ask(
        action_claim("pi*(E/w - sqrt(g))", well='"sqrt(E)/w"'), space=LINE, domain=_where("q > 0"), **RADIAL
    )
    assert inside.status == "proved"
    with pytest.raises(InputError):  # 2π is another well than that of −π < q < π
        ask(
            action_claim("8*E", branch='"libration"', well='"2*pi"'),
            space=LINE,
            symbols='E = "real"',
            hamiltonian='H = "p**2/2 - cos(q)"',
            domain=_where("-pi < q < pi"),
        )


def test_a_quadrature_stays_on_the_side_of_the_sign(ask):
    symbols = RADIAL["symbols"] + '\nq = "negative"'
    claim = action_claim("7", well='"1"')
    (verdict,) = ask(claim, space=LINE, symbols=symbols, hamiltonian=RADIAL["hamiltonian"])
    assert verdict.status == "undecided"


@pytest.mark.parametrize(
    "claim",
    [action_claim("1"), action_claim("7", kind="frequency"), mean_claim("q**2", "7")],
    ids=["J", "rate", "mean"],
)
def test_two_wells_of_a_negative_mass_are_ambiguous(ask, claim):
    with pytest.raises(InputError, match="2 wells"):
        ask(claim, space=LINE, hamiltonian='H = "-p**2/2 - q**2*(q - 100)**2/10000"')


@pytest.mark.parametrize(
    ("condition", "kind"),
    [
        ("q**2 < 4", "action"),
        ("p**2 + q**2 < 9", "average"),
        ("cos(q/10) > 1/2", "frequency"),
        ("abs(q - 10) < 3", "action"),
    ],
)
def test_a_well_outside_of_a_nonlinear_condition_is_not_meant(ask, condition, kind):
    claim = mean_claim("q**2", "7") if kind == "average" else action_claim("1", kind=kind)
    (verdict,) = ask(claim, space=LINE, hamiltonian=TWO_WELLS, domain=_where(condition))
    assert verdict.status in ("refuted", "undecided")
    assert condition.startswith("abs") or verdict.status == "refuted"


def test_two_wells_inside_of_a_nonlinear_condition_are_ambiguous(ask):
    with pytest.raises(InputError, match="well"):
        ask(action_claim("1"), space=LINE, hamiltonian=TWO_WELLS, domain=_where("q**2 < 400"))


@pytest.mark.parametrize(("H", "branch"), [("-cos(q)", {"branch": '"libration"'}), ("tan(q)**2", {})])
def test_an_average_that_differs_between_images_needs_its_well(ask, H, branch):
    H = f'H = "p**2/2 + {H}"'
    with pytest.raises(InputError, match="images"):
        ask(mean_claim("q", "0", **branch), space=LINE, hamiltonian=H)
    (there,) = ask(mean_claim("q", "1/10", well='"0"', **branch), space=LINE, hamiltonian=H)
    (alike,) = ask(mean_claim("cos(q)**2", "1", **branch), space=LINE, hamiltonian=H)
    assert (there.status, alike.status) == ("refuted", "refuted")
