"""Formulas of proofs: how they are set, what claims say, and what is too long or too wide for a page."""

import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

from canon.report.proof.blocks import Display, Grid, Items, Paragraph, Section, paragraph
from canon.report.proof.findings import side_conditions
from canon.report.proof.fitted import LINE, fitted
from canon.report.proof.latex import document as document_in_latex
from canon.report.proof.latex import section as section_in_latex
from canon.report.proof.plain import section
from canon.report.proof.statement import setting, statement
from canon.report.proof.structure import LONG, polynomial, structured
from canon.typeset.in_latex import LATEX
from canon.typeset.in_mathml import MATHML
from canon.typeset.in_room import room
from canon.typeset.in_text import PLAIN
from canon.typeset.letters import split_name
from canon.typeset.notation import written
from canon.typeset.trees import Tree, tree_of


@pytest.mark.parametrize(
    ("text", "latex", "plain"),
    [
        ("-x*3*y/2 - -1", r"-\frac{3\,x \,y }{2} + 1", "− (3 x y)/2 + 1"),
        ("a**(-1/2)*b", r"\frac{b }{\sqrt{a }}", "b/(√a)"),
        ("(a + b)**2*exp(-c)", r"{\left(a  + b \right)}^{2}\,{e }^{-c }", "(a + b)^2 e^(− c)"),
        ("sin(omega0*t)**2", r"{\sin}^{2}\!\left(\omega_{0}\,t \right)", "sin^2(omega0 t)"),
        ("V[1, 0](x, y)", r"\partial_{1} V \!\left(x ,\, y \right)", "∂_1V(x, y)"),
        ("V[2](x)", r"V ''\!\left(x \right)", "V′′(x)"),
        (
            "D(f(q, X), q, X)",
            r"\frac{{\partial}^{2} f\!\left(q,\,X\right)}{\partial q \partial X}",
            "(∂^2f(q, X))/(∂q∂X)",
        ),
        ("D(D(f(q, X), X), q)", None, "(∂^2f(q, X))/(∂X∂q)"),
        ("D(f(q), q, 3)", r"\frac{{\partial}^{3} f\!\left(q\right)}{\partial {q}^{3}}", "(∂^3f(q))/(∂q^3)"),
        ("bracket(q, p) = 1", r"\left\{ q ,\, p  \right\} = 1", "{q, p} = 1"),
        ("0.125*x - 1e-3", r"0.125\,x  - 0.001", "0.125 x − 0.001"),
        ("not a formula!", None, "not a formula!"),
    ],
)
def test_formulas_are_set(text: str, latex: str | None, plain: str) -> None:
    tree = tree_of(text)
    assert written(tree, PLAIN) == plain
    if latex is not None:
        assert re.sub(r"\s+", "", written(tree, LATEX)) == re.sub(r"\s+", "", latex)
    written(tree, MATHML)


@pytest.mark.parametrize(
    ("text", "grown"),
    [("(a + b1)*c", [False]), ("(a + b/c)*d", [True]), ("((x + y)*z + sqrt(w))*v", [True, False])],
)
def test_parentheses_grow_round_what_is_tall_only(text: str, grown: list[bool]) -> None:
    """A browser without a font for formulas sets those that may grow twice as tall as a line, an index given."""
    opening = re.findall("<mo [^>]*>(?=[(])", written(tree_of(text), MATHML))
    assert ["stretchy='false'" not in each for each in opening] == grown


def test_a_number_as_index_is_a_number() -> None:
    assert written(Tree("name", "u1"), MATHML) == "<msub><mi>u</mi><mn>1</mn></msub>"


def test_names_have_their_indices() -> None:
    assert [split_name(n) for n in ("omega_0", "q1", "px", "ptheta", "alpha", "energy", "pi", "Mx", "dx")] == [
        ("omega", "0"), ("q", "1"), ("p", "x"), ("p", "theta"), ("alpha", ""), ("energy", ""), ("pi", ""),
        ("M", "x"), ("dx", ""),
    ]  # fmt: skip


STATED = [
    ({"kind": "inequality", "lhs": "x**2", "relation": ">=", "rhs": "2*x - 1"}, ["x^2 ≥ 2 x − 1", "throughout"]),
    ({"kind": "limit", "f": "1/x", "variable": "x", "to": "0", "side": "+", "equals": "infinity"},
     ["As x tends to 0 from above, this tends to infinity:", "f = 1/x"]),
    ({"kind": "integral", "f": "sin(u)", "variable": "u", "from": "0", "to": "pi", "equals": "2"},
     ["The integral over u from 0 to pi of", "f = sin(u)", "is", "2"]),
    ({"kind": "average", "f": "x**2", "equals": "1/2", "parameter": "u", "motion": {"x": "cos(u)"}, "from": "0",
      "to": "2*pi"}, ["The average over time of", "along the motion, u from 0 to 2 pi,", "x = cos(u)"]),
    ({"kind": "noether", "L": "v**2", "velocities": ["v"], "dq": ["t"], "f": "2*x"},
     ["delta(x) = t", "by the differential of", "f = 2 x", "for the Lagrangian", "L = v^2"]),
    ({"kind": "solves", "solution": {"X(t)": "t**2"}, "equations": ["D(X(t), t) - 2*t"]},
     ["X(t) = t^2", "solves", "− 2 t = 0"]),
    ({"kind": "jacobi", "f": "x", "g": "p", "h": "x*p"}, ["Jacobi's identity", "{f, {g, h}}", "h = x p"]),
    ({"kind": "action_angle", "angle_period": "2*pi"}, ["each angle advances by 2 pi once round"]),
    ({"kind": "euler_lagrange", "L": "v**2/2 - x", "velocities": ["v"], "qddot": "-1"},
     ["With the Lagrangian", "Lagrange's equations are solved by the accelerations"]),
]  # fmt: skip


@pytest.mark.parametrize(("claim", "said"), STATED)
def test_a_claim_says_what_is_claimed(claim: dict[str, Any], said: list[str]) -> None:
    """In its own words, not by its keys: an inequality has two sides, an integral its ends."""
    blocks = statement({"phase_space": {"q": ["x"], "p": ["p"]}, "claim": claim})
    assert not any(isinstance(block, Items) for block in blocks)
    text = section(Section("", "", "proved", "", (), tuple(blocks), (), ()))[2]
    assert all(" ".join(line.split()) in " ".join(text.split()) for line in said), text


def test_long_formulas_are_shown_by_structure() -> None:
    """Parts that are repeated get names, nothing is lost but what is counted."""
    part = "sqrt(x**2 + 3*y**2 + z)"
    tree = tree_of(" + ".join(f"sin({k}*{part})/{part}" for k in range(2, 8)))
    short, named = structured(tree, {"u1"})
    assert tree.size > LONG >= short.size
    assert (named[0][0], written(named[0][1], PLAIN)) == ("u2", "√(x^2 + 3 y^2 + z)")
    long = polynomial({f"x^{k}": str(k) for k in range(2, 40)})
    assert written(structured(long, set())[0], PLAIN).endswith("⋯ (33 terms)")


SUMS = [" + ".join(f"{term}**{k}" for k in range(20)) for term in ("u1*x", "sin(y)")]


WIDE = tree_of(f"r = ({SUMS[0]})/(u1 + {SUMS[1]})")


def _section(*blocks: Any) -> Section:
    return fitted(Section("wide", "", "proved", "", (), (), blocks, ()))


def test_what_is_too_wide_for_a_page_gets_a_name() -> None:
    """The fraction of two new names, u2 over u3, and what they are: u1 has a meaning already."""
    (shown,) = _section(Display((WIDE,))).proof
    assert isinstance(shown, Display)
    assert [written(line, PLAIN)[:12] for line in shown.lines] == ["r = u2/u3", "u2 = u1 x^0 ", "u3 = u1 + si"]
    assert all(room(part) <= LINE for line in shown.lines for part in line.below() if part.kind == "fraction")
    narrow = Display((tree_of("r = sin(x)/y"),))
    assert _section(narrow).proof == (narrow,)


def test_a_wide_formula_among_words_is_explained_behind_them() -> None:
    (shown,) = _section(paragraph("where ", WIDE, " holds")).proof
    assert isinstance(shown, Paragraph)
    text = " ".join("".join(p if isinstance(p, str) else written(p, PLAIN) for p in shown.words).split())
    assert text.startswith("where r = u2/u3 holds; here u2 = u1 x^0 +")


def test_a_wide_matrix_has_names_for_its_entries() -> None:
    entry = WIDE.parts[1]
    grid = Grid(Tree("name", "M"), ("Q", "P"), ("q", "p"), ((entry, Tree("number", "0")), (entry, Tree("name", "q"))))
    first, _, lines = _section(grid).proof
    assert isinstance(first, Grid)
    assert isinstance(lines, Display)
    assert [written(e, PLAIN) for row in first.entries for e in row] == ["u2", "0", "u3", "q"]
    assert written(lines.lines[0], PLAIN).startswith("u2 = u4/u5")


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="pdflatex is not installed")
def test_no_line_is_wider_than_the_page(tmp_path: Path) -> None:
    long = " + ".join(f"omega_{k}*cos(theta)*(p_x - m*V(x, y))**2" for k in range(9))
    wide = [WIDE, tree_of(f"s = sqrt({long})*exp({long})"), tree_of(f"t = ({long})**2*({long})"), tree_of(long)]
    text = document_in_latex("wide", ["\n".join(section_in_latex(_section(Display(tuple(wide)))))], "")
    (tmp_path / "wide.tex").write_text(text, encoding="utf-8")
    command = ["pdflatex", "-interaction=nonstopmode", "-draftmode", "-halt-on-error", "wide.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=120, errors="replace")
    assert done.returncode == 0, done.stdout[-2000:]
    assert all(float(points) < 10 for points in re.findall(r"Overfull .hbox \(([\d.]+)pt", done.stdout)), done.stdout


def test_a_condition_that_ends_with_a_power_is_a_formula() -> None:
    (shown,) = side_conditions({"domain": ["E > V(r) + M**2/(2*mu*r**2)", "not (y = 0 and x <= 0)"]})
    assert isinstance(shown, Paragraph)
    text = "".join(piece if isinstance(piece, str) else written(piece, PLAIN) for piece in shown.words)
    assert text == "E > V(r) + (M^2)/(2 mu r^2), not (y = 0 and x ≤ 0)."


@pytest.mark.parametrize(
    ("q", "p", "words"),
    [
        (["q"], ["p"], "Coordinate q with momentum p."),
        (["x", "y"], ["px", "py"], "Coordinates x and y with momenta px and py."),
    ],
)
def test_one_coordinate_is_not_several(q: list[str], p: list[str], words: str) -> None:
    (block,) = setting({"phase_space": {"q": q, "p": p}})
    assert isinstance(block, Paragraph)
    assert "".join(piece if isinstance(piece, str) else written(piece, PLAIN) for piece in block.words) == words
