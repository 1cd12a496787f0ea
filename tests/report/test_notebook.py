"""What a notebook shows: values in HTML or LaTeX, proofs of claims made in Python, a bar while one waits."""

import json
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest
import sympy as sp

import canon.report.waiting as waiting
from canon import (
    GeneratingFunction,
    Hamiltonian,
    LieAlgebra,
    PhaseSpace,
    Transformation,
    algebra_of_matrices,
    audit,
    bracket,
    bracket_matrix,
    identify,
    identity,
    proof,
    verify,
)
from canon.checker.check import check
from canon.claims.claim_tables import claim_tables, text_of
from canon.domain import Condition, Domain
from canon.errors import InputError
from canon.verdict import Verdict

SPACE = PhaseSpace("q", "p", new=("Q", "P"), positive="m", functions="V")
q, p, m = SPACE.symbols("q p m")
SHEAR = Transformation(SPACE, Q=[q], P=[p + m * q**2])
TYPE_2 = GeneratingFunction(SPACE, type=2, F=q * SPACE.symbols("P") + q**3)
SO3 = LieAlgebra.of(("X", "Y", "Z"), {"X,Y": "Z", "Y,Z": "X", "Z,X": "Y"})
ROTATION = sp.Matrix([[0, -1], [1, 0]])


def values() -> dict[str, Any]:
    return {
        "verdict": verify(SHEAR.canonical()),
        "transformation": SHEAR,
        "generating function": TYPE_2,
        "implicit transformation": TYPE_2.transformation(),
        "Hamiltonian": Hamiltonian(SPACE, p**2 / (2 * m)),
        "brackets": bracket_matrix([q, p], SPACE),
        "algebra": SO3,
        "abelian algebra": LieAlgebra.of(("X", "Y"), {}),
        "matrices": algebra_of_matrices({"R": ROTATION.tolist()}),
        "identification": identify(SO3),
        "phase space": SPACE,
        "audit": audit(lambda x, y: (x, y + x), dimension=2, samples=20),
        "proof": proof(SHEAR.canonical()),
    }


class Balanced(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


@pytest.fixture(scope="module")
def shown() -> dict[str, Any]:
    return values()


def test_every_value_displays_itself(shown: dict[str, Any]) -> None:
    for name, value in shown.items():
        html, latex = (getattr(value, f"_repr_{word}_", None) for word in ("html", "latex"))
        assert html or latex, name
        if html:
            parser = Balanced()
            parser.feed(html())
            assert parser.open == [], name
        if latex:
            text = latex()
            assert re.fullmatch(r"\$[^$]+\$", text, re.DOTALL), name
            assert text.count("{") == text.count("}"), name
            # in LaTeX a bracket there would be an option, and not shown
            assert not re.search(r"(\\\\|\\begin\{\w+\}) *\[", text), name
    assert "[X, Y] &= Z" in SO3._repr_latex_()
    assert "so(3)" in shown["identification"]._repr_html_()
    assert "within it" in shown["audit"]._repr_html_()
    assert "{Q1,P1}" in shown["audit"]._repr_html_()  # the bracket that its text names
    assert "{Q,P}" not in shown["audit"]._repr_html_()


def test_ipython_shows_it(shown: dict[str, Any]) -> None:
    formatters = pytest.importorskip("IPython.core.formatters")
    for name, value in shown.items():
        bundle, _ = formatters.DisplayFormatter().format(value)
        assert "text/html" in bundle or "text/latex" in bundle, name


def test_nothing_in_a_title_is_markup() -> None:
    assert "<b>x" not in Verdict("proved", "identity", title="<b>x")._repr_html_()


def test_a_proof_of_a_claim_made_in_python(tmp_path: Path) -> None:
    """It is to be read, its certificate is confirmed, and it goes into files by their endings."""
    claim = bracket(SPACE, sp.Abs(q) * sp.exp(1) * SPACE.function("V")(q), p**2, 2 * p * sp.diff(
        sp.Abs(q) * SPACE.function("V")(q), q) * sp.E)  # fmt: skip
    made = proof(claim)
    assert made.verdict
    assert str(check(json.loads(json.dumps(made.certificate)))) == "confirmed"
    assert {"text/html", "text/markdown", "text/plain"} == set(made._repr_mimebundle_())
    for ending, word in {
        ".html": "<math",
        ".tex": r"\begin",
        ".md": "prf:",
        ".txt": "Claim.",
        ".json": '"cases"',
    }.items():
        assert word in made.save(tmp_path / f"proof{ending}").read_text(encoding="utf-8")
    assert "Theorem" in proof(SHEAR.canonical()).save(tmp_path / "shear.v").read_text(encoding="utf-8")
    with pytest.raises(InputError, match=r"none of the endings .*\.v"):
        made.save(tmp_path / "proof.pdf")


def test_a_proof_names_nothing_that_its_claim_does_not_say() -> None:
    """The bracket of two long functions: what vanishes are its two sides' difference, f, g and no third name."""
    f, g = sum(q**k * p for k in range(12)), sum(p**k for k in range(2, 12))
    text = proof(bracket(SPACE, f, g, sp.expand(sp.diff(f, q) * sp.diff(g, p)))).text()
    assert "The Poisson bracket of" in text
    assert "The difference of the two sides is 0" in text
    assert not re.search(r"− h\b", text)


def test_a_proof_of_a_map_made_explicit_from_its_generating_function() -> None:
    """The map keeps the function that it was made of: its claim has both, and so has its certificate."""
    implicit = TYPE_2.transformation()
    for explicit in (implicit.forward(), implicit.backward()):
        made = proof(explicit.canonical())
        assert made.verdict
        assert str(check(json.loads(json.dumps(made.certificate)))) == "confirmed"
        assert made.tables["generating_function"]["F"] == text_of(TYPE_2.F.expr)


def test_what_is_open_has_no_certificate(tmp_path: Path) -> None:
    claim = identity(SPACE, q, q)
    made = proof(claim, Verdict("undecided", "identity", detail={"note": "no time"}))
    assert made.certificate is None
    assert "no time" in made.text()
    with pytest.raises(InputError, match="no certificate of what is undecided"):
        made.save(tmp_path / "proof.json")


def test_claims_come_back_from_their_tables() -> None:
    tables = claim_tables(
        TYPE_2.transformation().new_hamiltonian(p**2 + SPACE.function("V")(q), SPACE.symbols("P") ** 2)
    )
    assert tables["generating_function"] == {"type": 2, "F": text_of(TYPE_2.F.expr)}
    assert tables["symbols"]["V"] == "function"
    assert tables["symbols"]["m"] == "positive"
    assert text_of(sp.Derivative(SPACE.function("V")(q), q, q) * sp.I) == "1j*D(V(q), q, 2)"
    inside = PhaseSpace("q", "p").where("q > 1")
    assert claim_tables(identity(inside, 1, 1))["domain"] == {"where": ["q - 1 > 0"]}
    cut = PhaseSpace("q", "p", domain=Domain((Condition("uncut", (p, q)),)))
    with pytest.raises(InputError, match="has no inequality"):
        claim_tables(identity(cut, 1, 1))


class Display:
    """As IPython's display: it returns a handle whose outputs are kept."""

    def __init__(self) -> None:
        self.seen: list[dict[str, str]] = []

    def __call__(self, bundle: dict[str, str], *, raw: bool, display_id: bool) -> "Display":
        assert raw
        assert display_id
        self.seen.append(bundle)
        return self

    def update(self, bundle: dict[str, str], *, raw: bool) -> None:
        assert raw
        self.seen.append(bundle)


def test_a_bar_in_a_notebook(monkeypatch: pytest.MonkeyPatch) -> None:
    display = Display()
    monkeypatch.setattr(waiting, "_notebook_display", lambda: display)
    with waiting.progress("walking") as watch:
        watch(0.1)
        assert display.seen == []
        monkeypatch.setattr(waiting, "PATIENCE", 0.0)
        monkeypatch.setattr(waiting, "SELDOM", 0.0)
        watch(0.25)
        watch(0.5)
        assert [bundle["text/plain"][:13] for bundle in display.seen] == ["walking: 25 %", "walking: 50 %"]
        assert 'value="50"' in display.seen[-1]["text/html"]
    assert display.seen[-1]["text/html"] == ""


def test_no_bar_where_nobody_looks(capsys: pytest.CaptureFixture[str]) -> None:
    with waiting.progress() as watch:
        watch(0.5)
    assert capsys.readouterr().err == ""


BAR = """
import canon.report.waiting as waiting
from canon import PhaseSpace, bracket, verify
waiting.PATIENCE = waiting.SELDOM = 0.0
space = PhaseSpace("q", "p")
q, p = space.symbols("q p")
with waiting.progress("proving") as watch:
    for power in (1, 2, 3, 4):
        assert verify(bracket(space, q**power, p, power * q ** (power - 1)))
        watch(power / 4)
verify(bracket(space, q**2, p, 3 * q**2))
"""


@pytest.mark.slow
def test_a_bar_in_a_real_kernel(monkeypatch: pytest.MonkeyPatch) -> None:
    """What a notebook's page is sent: one bar, drawn anew in its place and taken away; then the verdict, set."""
    nbclient, nbformat = pytest.importorskip("nbclient"), pytest.importorskip("nbformat")
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parents[2]))
    monkeypatch.setenv("PYDEVD_DISABLE_FILE_VALIDATION", "1")
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(BAR)])
    sent: list[tuple[str, str]] = []

    class Client(nbclient.NotebookClient):
        def process_message(self, msg: Any, cell: Any, cell_index: int) -> Any:
            if "data" in msg["content"]:
                sent.append((msg["msg_type"], msg["content"]["data"]["text/html"]))
            return super().process_message(msg, cell, cell_index)

    Client(notebook, timeout=120, kernel_name="python3").execute()
    first, *others, last, verdict = sent
    assert first[0] == "display_data"
    assert 'value="25"' in first[1]
    assert [kind for kind, _ in (*others, last)] == ["update_display_data"] * 4
    assert 'value="100"' in others[-1][1]
    assert last[1] == ""
    assert verdict[0] == "execute_result"
    assert "refuted" in verdict[1]
    assert "<math>" in verdict[1]
    assert [output["data"]["text/html"] for output in notebook.cells[0].outputs] == ["", verdict[1]]


def test_a_residual_beyond_doubles_is_written_out():
    q, _ = SPACE.old
    found = proof(identity(SPACE, 10**400 * q, q))
    assert found.verdict.status == "refuted"
    assert "it is enclosed in a ball of" in found.text()
    assert "enclosed in a ball of" in found.html()
