"""Formulas among words: which they are, and how they are set for people."""

import pytest

from canon.typeset.mixed import in_html, in_latex, in_markdown, in_text, pieces, tidied
from canon.verdict import Verdict


@pytest.mark.parametrize(
    ("text", "formulas"),
    [
        ("x**2 + 1", ["$$"]),
        ("divide pr by sqrt(x**2 + y**2), where that is not 0", ["divide pr by ", "$$", ", where that is not 0"]),
        ("{X, Y} = 6*p**2*q - 1, {a, b} = 2", ["$$", ", ", "$$"]),
        ("at x = 11/3, y = -3/4", ["at ", "$$", ", ", "$$"]),
        ("at I = 3/4, omega = 3", ["at ", "$$", ", ", "$$"]),
        ("it is canonical with scale -1", ["it is canonical with scale -1"]),
        ("power of L in m*v**2/2 - e*phi", ["power of L in ", "$$"]),
        ("a long formula, off by 0.02 at the witness", ["a long formula, off by 0.02 at the witness"]),
        ("well-known and left-handed", ["well-known and left-handed"]),
        ("-h*(-Subs(V(_a1), (_a1, 2)) + x/2)", ["-h*(-Subs(V(_a1), (_a1, 2)) + x/2)"]),  # tuples aren't formulas
        ("<b>q**2</b> and a/b", ["<b>q**2</b> and ", "$$"]),
        ("", [""]),
        ("fails: {Q1, P_2}", ["fails: ", "$$"]),
        ("{a set} of {two}", ["{a set} of {two}"]),
    ],
)
def test_formulas_are_found_among_words(text: str, formulas: list[str]) -> None:
    assert [piece if isinstance(piece, str) else "$$" for piece in pieces(text)] == formulas


def test_they_are_set_and_words_are_escaped() -> None:
    text = "<b> off by q**2/a"
    assert "<msup><mi>q</mi><mn>2</mn></msup>" in in_html(text)
    assert in_html(text).startswith("&lt;b&gt; off by <math>")
    assert in_markdown(text, lambda words: words.upper()).startswith(r"<B> OFF BY $\frac{{q }^{2}}{a }")
    assert in_latex(text).startswith(r"\text{\ensuremath{<}b\ensuremath{>} off by }\frac{")
    assert "λ" in in_html("lam/2")
    assert in_latex("lam/2") == r"\frac{\lambda }{2}"
    assert in_text(text) == "<b> off by q^2/a"


def test_a_chosen_function_is_read_easily() -> None:
    chosen = "(-3/5)*(2*a + 1)**1 + (1)*(2*a + 0)**2 + (-2/3)*(1/2*a + -1)**13 + (2)*(-1*a + 11)**1"
    assert tidied(chosen) == "(-3/5)*(2*a + 1) + (2*a)**2 - (2/3)*(1/2*a - 1)**13 + 2*(-a + 11)"


def test_a_verdict_shows_mathematics_in_a_notebook() -> None:
    found = Verdict(
        "refuted", "canonical", witness={"q": "3/2", "f": "(1)*(1*a + 0)**2"}, detail={"brackets": {"{Q, P}": "q**2"}}
    )
    html, markdown, latex, text = found._repr_html_(), found._repr_markdown_(), found._repr_latex_(), str(found)
    assert not any("**" in shown.replace("**refuted**", "") for shown in (html, markdown, latex, text))
    assert "<mfrac><mn>3</mn><mn>2</mn></mfrac>" in html
    assert "<msup><mi>q</mi><mn>2</mn></msup>" in html
    assert r"\left\{ Q ,\, P  \right\} = {q }^{2}" in markdown
    assert r"f = {a }^{2}" in " ".join(latex.split())
    assert "{Q, P}: q^2" in text
    assert "f = (a)^2" in text
