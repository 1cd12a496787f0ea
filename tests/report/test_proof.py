"""Proofs to be read: what they say, that HTML and LaTeX are well made, that nothing in a file becomes markup."""

import re
import shutil
import subprocess
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

from canon.claims.reader import read_file
from canon.claims.verify import verify
from canon.claims.worker import Entry
from canon.cli.main import main
from canon.report.certificate_file import certified
from canon.report.proof_file import NOTATIONS, document, rendered

FILE = """\
title = "Polar <b>coordinates</b> & $their$ momenta"

[phase_space]
q = ["x", "y"]
p = ["px", "py"]
Q = ["r", "phi"]
P = ["pr", "L"]

[symbols]
V = "function"
omega_0 = "positive"

[hamiltonian]
H = "(px**2 + py**2)/2 + V(sqrt(x**2 + y**2))"

[transformation]
Q = ["sqrt(x**2 + y**2)", "atan2(y, x)"]
P = ["(x*px + y*py)/sqrt(x**2 + y**2)", "x*py - y*px"]

[[claim]]
kind = "canonical"
title = "polar \\\\ {coordinates} 100% #1_a <script>"

[[claim]]
kind = "new_hamiltonian"
K = "(pr**2 + L**2/r**2)/2 + V(r)"

[[claim]]
kind = "bracket"
title = "not so"
f = "x*py - y*px"
g = "omega_0*px"
equals = "2*omega_0*py"
expect = "fails"

[[claim]]
kind = "identity"
lhs = "sin(x)**2"
rhs = "1 - cos(x)**2"
"""


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """The proofs of the file in each notation, by the endings of files."""
    path = tmp_path_factory.mktemp("proofs") / "polar.toml"
    path.write_text(FILE, encoding="utf-8")
    found = []
    for claim in read_file(path).claims:
        found.append(certified(None, Entry("polar.toml", claim.index, claim, str(path)), claim, verify(claim)))

    def of(notation: str) -> str:
        records = [{**record, "proof": rendered(notation, record, *rest)} for record, *rest in found]
        return document(notation, "Proofs", records, 1.0)

    return {ending[1:]: of(notation) for ending, notation in NOTATIONS.items()}


def test_a_proof_says_what_it_rests_on(made: dict[str, str]) -> None:
    """The setting once; of each claim the statement, the substitutions, the identity, the side conditions, the time."""
    text = made["txt"]
    assert text.count("The Hamiltonian is") == 1
    first, second, third, fourth = re.split(r"\n-{5,}\n", text)[1:]
    for part in ("M J M^T = J", "g", "√(y^2 + x^2)", "{r, pr} − 1", "all terms cancel", "Where it holds.", " ms. ∎"):
        assert part in first, part
    assert re.search(r"\n +M +x +y +px +py\n +r +x/", first)
    assert "M J M^T = c J" in second
    assert "K = (pr^2 + (L^2)/(r^2))/2 + V(r)" in second
    assert "Refutation." in third
    assert re.search(r"At the point\n( +\w+ = .*\n)+", third)
    assert re.search(r"error of at most [\d.e+-]+,\s+enclosed\s+in\s+a\s+ball\s+of\s+64\s+bits", third)
    assert "∎" not in third
    assert re.search(r"(g\d)\^2 \+ g\d\^2 − 1 = \1\^2", fourth)
    assert "numerator is a multiple of the relation" in fourth
    assert "Where it holds. x^2 + y^2 > 0, not (y = 0 and x ≤ 0)." in first


class Balanced(HTMLParser):
    """Every element that is opened is closed, in order."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.seen: set[str] = set()

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        self.seen.add(tag)
        if tag != "meta":
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def test_html_stands_by_itself(made: dict[str, str]) -> None:
    parser = Balanced()
    parser.feed(made["html"])
    assert parser.open == []
    assert {"math", "mfrac", "msqrt", "table", "section"} <= parser.seen
    assert not parser.seen & {"script", "link", "img", "b "}
    assert "http" not in made["html"]
    assert "polar \\ {coordinates} 100% #1_a &lt;script&gt;" in made["html"]
    for word in ("width=device-width", "prefers-color-scheme: dark", "overflow-x: auto"):
        assert word in made["html"]


def test_latex_is_balanced(made: dict[str, str]) -> None:
    text = made["tex"]
    plain = re.sub(r"\\[\\{}$]", "", text)
    assert plain.count("{") == plain.count("}")
    assert plain.count("$") % 2 == 0
    assert len(re.findall(r"\\left\b", text)) == len(re.findall(r"\\right\b", text))
    begun, ended = (re.findall(rf"\\{word}{{(\w+\*?)}}", text) for word in ("begin", "end"))
    assert sorted(w for w in begun if w != "list") == sorted(w for w in ended if w != "list")
    assert r"100\% \#1\_a \ensuremath{<}script\ensuremath{>}" in text


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="pdflatex is not installed")
def test_pdflatex_reads_it(made: dict[str, str], tmp_path: Path) -> None:
    (tmp_path / "proof.tex").write_text(made["tex"], encoding="utf-8")
    command = ["pdflatex", "-interaction=nonstopmode", "-draftmode", "-halt-on-error", "proof.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=120, errors="replace")
    assert done.returncode == 0, done.stdout[-2000:]


def test_markdown_has_directives_and_no_stray_signs(made: dict[str, str]) -> None:
    text = made["md"]
    assert text.count(":::{prf:theorem}") == text.count(":::{prf:proof}") == 3
    assert text.count(":::{prf:conjecture}") == 1
    assert len(re.findall(r"^:::$", text, re.MULTILINE)) == 7
    assert r"\<script\>" in text
    assert text.count("\n$$\n") % 2 == 0


def test_the_command_writes_the_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "a.toml").write_text(FILE.partition('[[claim]]\nkind = "new')[0], encoding="utf-8")
    assert main(["verify", str(tmp_path / "a.toml"), "--json", "--jobs", "1", "--proof", str(tmp_path / "a.md")]) == 0
    assert '"proof"' not in capsys.readouterr().out
    assert "1 claim: 1 proved" in (tmp_path / "a.md").read_text(encoding="utf-8")


def test_a_file_of_another_name_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "a.toml").write_text(FILE, encoding="utf-8")
    assert main(["verify", str(tmp_path / "a.toml"), "--proof", str(tmp_path / "a.pdf")]) == 3
    assert "none of the endings .html" in capsys.readouterr().err
    assert main(["verify", str(tmp_path / "a.toml"), "--proof", str(tmp_path / "no" / "a.html")]) == 3
    assert "there is no folder" in capsys.readouterr().err


"""A fraction that is wider than a page, above and below."""


HOSTILE = (
    "</title><script>x</script>", "\\input{/etc/passwd}\\write18{x}", "*) Axiom a : False. (*", '(*(*"(*',
    "&lt;b&gt; ~~~",
    "\x1b[31ma\u202eb\u2066c\u200bd\u2028e", "x\n\n:::\n\n~~~{raw} html\n<script>x</script>",
)  # fmt: skip
"""Titles and sources that are markup, commands, the end of a comment, or move what stands beside them."""


def test_what_a_file_says_is_inert_in_every_notation(tmp_path: Path) -> None:
    import json
    import unicodedata

    claim = '[[claim]]\nkind = "bracket"\nf = "q**2"\ng = "p"\nequals = "2*q"\ntitle = {0}\nsource = {0}\n'
    file = tmp_path / "\u202e<b>*).toml"
    file.write_text('[phase_space]\nq = ["q"]\np = ["p"]\n' + "".join(map(claim.format, map(json.dumps, HOSTILE))))
    for ending in NOTATIONS:
        out = tmp_path / f"out{ending}"
        assert main(["verify", str(file), "--jobs", "1", "--proof", str(out)]) == 0
        text = out.read_text()
        moving = {c for c in text if c != "\n" and unicodedata.category(c) in {"Cc", "Cf", "Cs", "Zl", "Zp"}}
        assert not moving, ending
        if ending in {".html", ".htm"}:
            assert "<script" not in text
        if ending == ".tex":
            assert r"\input" not in text
            assert r"\write" not in text
        if ending == ".md":
            assert not re.search(r"(?m)^~~~|(?<!\\)<", text)
            assert r"\&lt;b\&gt;" in text
    certificates = tmp_path / "certificates"
    assert main(["verify", str(file), "--jobs", "1", "--certificate", str(certificates)]) == 0
    for certificate in certificates.iterdir():
        assert main(["certificate", "export", str(certificate), "--coq", str(tmp_path / "out.v")]) == 0
        comment = (tmp_path / "out.v").read_text().partition("From Coq")[0].strip()
        assert comment.startswith("(*")
        assert comment.endswith("*)")
        assert not re.search(r'\(\*|\*\)|"', comment[2:-2])
        assert not {c for c in comment if c != "\n" and unicodedata.category(c) in {"Cc", "Cf", "Cs", "Zl", "Zp"}}
