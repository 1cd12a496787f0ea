"""What a name's sign grants isn't so at its 0: 0/eps, of a positive eps, leaves no germ at eps = 0."""

import pytest

from canon import PhaseSpace, Transformation, verify
from canon.claims.reader import read_text
from canon.errors import InputError

FILE = """
[phase_space]
q = ["q"]
p = ["p"]
Q = ["Q"]
P = ["P"]
[symbols]
eps = "{word}"
c = "positive"
[definitions]
small = "{term}"
[transformation]
Q = ["q + eps*p + {written}"]
P = ["p"]
[[claim]]
kind = "canonical"
order = ["eps", 1]
"""
SERIES = """
[phase_space]
q = ["q"]
p = ["p"]
[symbols]
eps = "{word}"
c = "positive"
[definitions]
small = "{term}"
[[claim]]
kind = "lie_series"
generator = "p**2/2"
parameter = "eps"
f = "q"
equals = "q + eps*p + {written}"
[[claim]]
kind = "lie_series"
generator = "p**2/2"
parameter = "eps"
order = 2
f = "q"
equals = "q + eps*p + {written}"
"""
FOR_ANY_SIGN = ("0/eps", "0*abs(eps)", "0*sign(c*eps)", "(eps/eps - 1)*q", "0*eps**(-2)")
FOR_ONE_SIGN = (
    "0*sqrt(eps)", "0*log(c*eps)", "eps*(log(eps) - log(eps))", "(sqrt(eps)**2 - eps)*p", "0*acosh(1 + eps)",
    "0*eps**(1/3)", "0*atan2(0, eps)", "0*log(eps + q**2 - q**2)",
)  # fmt: skip
HARMLESS = ("0/(1 + eps)", "0*sqrt(c)", "0*log(c + eps)", "0*sqrt(c + q**2 + eps)", "0/exp(eps)")


@pytest.mark.parametrize("text", [FILE, SERIES], ids=["truncated", "series"])
@pytest.mark.parametrize(
    ("word", "term"),
    [*(("nonzero", term) for term in FOR_ANY_SIGN), *(("positive", term) for term in FOR_ANY_SIGN + FOR_ONE_SIGN)],
)
def test_a_germ_is_defined_at_0(text, word, term):
    for written in (term, "small"):
        reading = read_text(text.format(word=word, term=term, written=written))
        for claim in reading.claims:
            with pytest.raises(InputError, match="not analytic at eps = 0"):
                verify(claim)
        assert reading.claims or reading.problems


@pytest.mark.parametrize("text", [FILE, SERIES], ids=["truncated", "series"])
@pytest.mark.parametrize("term", HARMLESS)
def test_what_holds_at_0_is_no_matter(text, term):
    for written in (term, "small"):
        for claim in read_text(text.format(word="positive", term=term, written=written)).claims:
            assert verify(claim).status == "proved"


def test_a_part_of_the_domain_may_have_no_germ():
    """At eps = 0, √(eps + |q| − q) is left with q < 0 alone, where the map is canonical."""
    term, written = "0*sqrt(eps + abs(q) - q)", "eps*(abs(q) {} q) + small"
    for sign, statuses in (("+", ("proved", "supported")), ("-", ("refuted",))):
        text = FILE.format(word="positive", term=term, written=written.format(sign))
        assert verify(read_text(text).claims[0]).status in statuses


def test_formulas_of_python_know_it_too():
    space = PhaseSpace("q", "p", new=("Q", "P"), positive="eps")
    for term, there in (("0*log(eps)", False), ("0*log(1 + eps)", True)):
        made = Transformation(space, Q=[space.formula(f"q + eps*p + {term}")], P=[space.formula("p")])
        claim = made.canonical(order=(*space.parameters, 1))
        if there:
            assert verify(claim).status == "proved"
        else:
            with pytest.raises(InputError, match="not analytic"):
                verify(claim)
