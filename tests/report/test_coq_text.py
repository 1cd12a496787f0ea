"""Files of Coq as texts: names, titles, polynomials, lines, and certificates that are broken."""

import json
from contextlib import suppress
from typing import Any

import pytest

from canon.checker.formulas import Formulas
from canon.errors import InputError
from canon.report.coq import HEAD, LIBRARY, coq_of
from canon.report.coq_text import identifiers, polynomial, term, wrapped
from tests.checker.certified import certified
from tests.report.test_coq import POLAR, data, of_text


def test_a_title_is_no_code() -> None:
    """A comment that a title would end, and names that are Coq's words or letters that Coq doesn't know."""
    title = 'title = "*) Admitted. (* \\" "\n'
    text = coq_of(
        of_text(
            title + 'kind = "bracket"\nf = "x*Set*θ"\ng = "p"\nequals = "Set*θ"',
            '[symbols]\nSet = "real"\n"θ" = "real"',
        )
    )
    comment = text[: text.index(LIBRARY)]
    assert comment.count("(*") == comment.count("*)") == 1
    assert '"' not in comment
    assert "forall Set_ x3b8 : R" in text.replace("x3b8 Set_", "Set_ x3b8") or "Set_" in text
    assert identifiers(["R", "x", "Set", "θ"]) == {"R": "R_", "x": "x", "Set": "Set_", "θ": "x3b8"}


@pytest.mark.parametrize("key", ["tables", "cases", "verdict", "kernels", "residuals", "atoms", "numerator"])
@pytest.mark.parametrize("value", [None, 3, [], {}, "1/0", [[]], {"": "1/0"}, {"x^99999999999999999999": "1"}])
def test_a_broken_certificate_is_refused_in_words(key: str, value: Any) -> None:
    def broken(part: Any) -> Any:
        if isinstance(part, dict):
            return {k: value if k == key else broken(v) for k, v in part.items()}
        return [broken(v) for v in part] if isinstance(part, list) else part

    with suppress(InputError) if value in ([], {}) else pytest.raises(InputError, match="can't be put in Coq"):
        coq_of(broken(data(*POLAR)))


def test_names_are_no_commands() -> None:
    """Whatever stands in a certificate, what is outside of comments is this module's own."""
    found = data(*POLAR)
    nasty = "x. Admitted. (* \n Axiom false : False."
    tables = {**found["tables"], "title": nasty, "(*": {'"': "*) Axiom bad : False. (*"}}
    text = coq_of({**found, "tables": tables})
    rest = text[text.index(HEAD) :]
    assert not any(word in rest for word in ("Admitted", "Axiom", "admit", "Parameter", "False"))
    named = of_text('kind = "identity"\nlhs = "(sqrt(x**2 + 1) + p)*(sqrt(x**2 + 1) - p)"\nrhs = "x**2 + 1 - p**2"')
    (kernel,) = named["cases"][0]["kernels"]
    case = json.loads(json.dumps(named["cases"][0]).replace(kernel["name"], "Admitted.Axiom(*"))
    text = coq_of({**named, "cases": [case]})
    rest = text[text.index("Theorem residual_1") :]
    assert "= sqrt (" in rest
    assert not any(word in rest for word in ("Admitted", "Axiom", "(*"))


def test_a_file_has_no_more_than_it_needs() -> None:
    """Of a polynomial no tactics for denominators; of a bracket its name; differences and quotients as people write."""
    polynomial_claim = coq_of(data("transformations", "henon-map", 0))
    assert "Ltac" not in polynomial_claim
    assert "(* bracket(X, Y) - -b *)\nTheorem residual_1 :" in polynomial_claim
    assert "  - b - (- b) = 0.\nProof.\n  intros.\n  field.\nQed.\n" in polynomial_claim
    polar = coq_of(data("transformations", "polar-coordinates", 0))
    assert "Ltac" in polar
    assert "(- 1) *" not in polar.partition("Theorem")[2]
    assert max(map(len, polar.splitlines())) <= 120
    eighth = coq_of(data("course", "conjugate-points", 2))
    assert "relation'g9" not in eighth  # no proof uses it


@pytest.mark.parametrize(
    ("terms", "text"),
    [
        ({"x^2": "-1", "y": "1", "": "-3/2"}, "- x ^ 2 + y - (3 / 2)"),
        ({"x y^3": "-2/5"}, "- (2 / 5) * x * y ^ 3"),
        ({"": "-1"}, "- 1"),
        ({}, "0"),
    ],
)
def test_polynomials_are_written_with_signs(terms: dict[str, str], text: str) -> None:
    assert polynomial(terms, {"x": "x", "y": "y"}) == text


def test_long_lines_are_broken_at_spaces() -> None:
    text = wrapped("  " + " + ".join(["g1 ^ 2"] * 40) + ".\nQed.", 60)
    assert max(map(len, text.splitlines())) <= 60
    assert " ".join(text.split()) == " + ".join(["g1 ^ 2"] * 40) + ". Qed."


def test_an_inverse_that_is_written_otherwise_is_multiplied_by() -> None:
    """In place of an inverse stands a text of its own, which begins with no division: x (- 1) would be a call."""
    f = Formulas()
    product = f.read("x/y", {})
    inverse = f.parts(product)[1]
    leaves = {a: f.ops[a][1] for a in f.rational([product])[1]}
    assert term(f, product, leaves) == "x / y"
    assert term(f, product, {**leaves, inverse: "- 1 * z"}) == "x * (- 1 * z)"


def test_what_is_0_for_some_signs_only_is_not_written(monkeypatch: pytest.MonkeyPatch) -> None:
    """A file that `coqc` would refuse: |q| q = q^2 doesn't follow from |q|^2 = q^2."""
    monkeypatch.setattr("canon.report.coq.LONG", 0)
    data = certified(
        '[phase_space]\nq = ["q"]\np = ["p"]\n', "kind = 'identity'\nlhs = 'abs(q)*q'\nrhs = 'q**3/abs(q)'"
    )
    assert "all_vanish" in coq_of(data)
    data["tables"]["claim"]["rhs"] = "q**2"
    with pytest.raises(InputError, match="some signs of its roots or moduli only"):
        coq_of(data)
