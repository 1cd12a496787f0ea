"""Scales that are constant though they don't look it: found, and never refuted by a wrong or approximate constant."""

import pytest

NEW = 'kind = "new_hamiltonian"\nK = "{}"'


def test_a_constant_that_is_nearly_a_simple_number(status):
    near = "(1/2 + 1e-25)"
    verdict = status(
        NEW.format(f"{near}*P**2/2"),
        hamiltonian='H = "p**2/2"',
        transformation=f'Q = ["{near}*q*(sin(p)**2 + cos(p)**2)"]\nP = ["p"]',
    )
    assert verdict == "proved"


@pytest.mark.parametrize(
    "transformation",
    [
        'Q = ["2*q*(V(p) + 1)**2/(V(p)**2 + 2*V(p) + 1)"]\nP = ["p"]',
        'Q = ["2*(q + W(p - V(q)))"]\nP = ["p - V(q)"]',
    ],
)
def test_a_constant_among_arbitrary_functions(status, transformation):
    verdict = status(
        NEW.format("2*P"),
        symbols='V = "function"\nW = "function"',
        hamiltonian='H = "p"' if "W" not in transformation else 'H = "p - V(q)"',
        transformation=transformation,
    )
    assert verdict == "proved"


def test_a_constant_on_a_surface_whose_points_are_known_approximately(status):
    verdict = status(
        NEW.format("0"),
        symbols='a = "positive"',
        domain='on = ["q**2 + p**2 - 2"]',
        hamiltonian='H = "0"',
        transformation='Q = ["a*q**3/3 + a*q*p**2"]\nP = ["p"]',
    )
    assert verdict == "proved"


def test_a_constant_on_each_side_of_an_absolute_value(status):
    """Q = 2q wherever a·q > 0; the value at one point, with another sign of a, is another one."""
    verdict = status(
        NEW.format("2*P"),
        symbols='a = "real"',
        domain='where = ["a*q > 0"]',
        hamiltonian='H = "p"',
        transformation='Q = ["2*a*abs(q)/abs(a)"]\nP = ["p"]',
    )
    assert verdict == "proved"


@pytest.mark.parametrize("Q", ["q*abs(q)", "2*abs(q)", "q**2", "a*q**2", "q*V(q)"])
def test_no_constant(status, Q):
    verdict = status(
        NEW.format("P"),
        symbols='a = "real"\nV = "function"',
        hamiltonian='H = "p"',
        transformation=f'Q = ["{Q}"]\nP = ["p"]',
    )
    assert verdict == "refuted"


@pytest.mark.parametrize("Q", ["q*(1 + sqrt(eps))", "q*(1 + eps*log(eps))"])
def test_what_is_assumed_of_a_small_parameter_hides_no_singularity(ask, Q):
    """√eps is no O(eps), though its value at 0 is 0."""
    from canon.errors import InputError

    with pytest.raises(InputError, match="not analytic"):
        ask(
            'kind = "canonical"\norder = ["eps", 0]',
            symbols='eps = "positive"',
            transformation=f'Q = ["{Q}"]\nP = ["p"]',
        )


def test_the_lesson_of_a_refutation_keeps_to_its_time(ask):
    """An exponent with a long number in it is no degree of a polynomial to be factored."""
    near = "999999999999/1000000000000"
    (verdict,) = ask(
        'kind = "canonical"',
        symbols='a = "real"',
        transformation=f'Q = ["q*exp(a) + p/exp(a)"]\nP = ["p*exp(-a*{near}) - q*exp(a*{near})"]',
        options={"budget": 3.0},
    )
    assert verdict.status == "refuted"
    assert verdict.seconds < 10


@pytest.mark.parametrize("method", ["symbolic", "numeric"])
def test_what_is_supported_only_refutes_nothing(status, method):
    """The scale tanh a can't be told from 1 for a > 10⁴; with tanh a = 1 − 2/(exp 2a + 1) that K is tanh a times H."""
    powers = [f"{{0}}**{k}/{k}" for k in range(1, 70)]  # so many that sums are merged term by term
    large = " + ".join(f"exp(2*a)*{power}" for power in powers)
    K = f"{large} - 2*exp(2*a)/(exp(2*a) + 1)*({' + '.join(powers)})".format("Q")
    file = {
        "symbols": 'a = "real"',
        "domain": 'where = ["a > 10000", "0 < q < 1/2"]',
        "hamiltonian": f'H = "{large.format("q")}"',
        "transformation": 'Q = ["q"]\nP = ["p*tanh(a)"]',
    }
    assert status(NEW.format(K), options={"method": method}, **file) == "supported"
    assert status(NEW.format(f"2*({K})"), options={"method": method}, **file) == "refuted"
