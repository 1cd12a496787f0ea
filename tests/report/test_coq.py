"""Certificates in Coq: what the theorems say, what is refused; and where coqc is installed, that it accepts them."""

import shutil
import subprocess
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from canon.catalogue import files
from canon.claims import document
from canon.claims.certificate_data import certificate, statement_tables
from canon.claims.reader import read_tables
from canon.claims.verify import verify
from canon.errors import InputError
from canon.report.coq import HEAD, coq_of

COQC = shutil.which("coqc")
needs_coqc = pytest.mark.skipif(COQC is None, reason="coqc is not installed: apt-get install coq")
PATHS = {(Path(str(file)).parent.name, Path(str(file)).stem): Path(str(file)) for file in files()}
CLAIMS = [
    ("transformations", "oscillator-type-1", 0),
    ("transformations", "oscillator-type-1", 1),
    ("transformations", "polar-coordinates", 0),
    ("transformations", "shear-with-coupling", 0),
    ("transformations", "phase-space-rotation", 0),
    ("transformations", "linear-symplectic-family", 0),
    ("transformations", "henon-map", 0),
    ("course", "angular-momentum", 4),
    ("course", "angular-momentum", 12),
    ("course", "kepler-so4", 0),
    ("brackets", "jacobi-identity-examples", 0),
    ("errata", "valence", 0),
    ("transformations", "henon-map", 2),
    ("transformations", "kustaanheimo-stiefel", 3),
    ("transformations", "momenta-on-a-constraint", 0),
    ("course", "conjugate-points", 2),  # a sine whose cosine, of pi/8, is known by a relation alone
]

ROOT = "sqrt(sqrt(x**2 + 1) + p**2/3)"
FRACTIONS = f"""kind = "identity"
lhs = "({ROOT} + sqrt({ROOT} + x**2/5))*({ROOT} - sqrt({ROOT} + x**2/5))/p"
rhs = "(sqrt(x**2 + 1) + p**2/3 - {ROOT} - x**2/5)/p"
"""


@cache
def data(room: str, name: str, index: int) -> Any:
    return of_tables(document.load(PATHS[room, name]), index)


def of_tables(tables: Any, index: int = 0) -> Any:
    claim = read_tables(tables).claims[index]
    return certificate(claim, verify(claim), statement_tables(tables, index))


def of_text(keys: str, extra: str = "") -> Any:
    return of_tables(document.parse(f'[phase_space]\nq = ["x"]\np = ["p"]\n{extra}\n[[claim]]\n{keys}'))


def coqc(folder: Path, text: str) -> str:
    """What coqc says; nothing where it accepts the file."""
    (folder / "claims.v").write_text(text, encoding="utf-8")
    done = subprocess.run([str(COQC), "-q", "claims.v"], cwd=folder, capture_output=True, text=True, timeout=240)
    return "" if done.returncode == 0 else done.stderr or "refused"


@pytest.mark.slow
@needs_coqc
def test_coqc_accepts_the_catalogue(tmp_path: Path) -> None:
    """The oscillator, polar coordinates, families, SO(3), Kepler's SO(4), Jacobi's identity, refutations, in a file."""
    nested = of_text('kind = "bracket"\nf = "1/(x + 1/(p**2 + 1))"\ng = "p"\nequals = "-1/(x + 1/(p**2 + 1))**2"')
    halves = of_text(FRACTIONS)
    texts = [coq_of(found).replace(HEAD, "") for found in (nested, halves, *(data(*claim) for claim in CLAIMS))]
    modules = [f"Module claim_{k}.\n{text}\nEnd claim_{k}.\n" for k, text in enumerate(texts)]
    assert coqc(tmp_path, "\n".join([HEAD, *modules])) == ""


@needs_coqc
def test_the_tactic_for_denominators_knows_multiples(tmp_path: Path) -> None:
    """What is 2, 4, 1/2 or 1/4 times something that isn't 0, of either sign; nothing else."""
    goal = "Goal forall a b : R, a * b - 4 <> 0 -> {c} * (b * a) - {c} * 4 <> 0.\nProof. intros. nonzero. Qed.\n"
    factors = [f"({sign} {c})" for c in ("1", "2", "4", "/ 2", "/ 4") for sign in ("", "-")]
    assert coqc(tmp_path, HEAD + "".join(goal.format(c=c) for c in factors)) == ""
    assert coqc(tmp_path, HEAD + "Goal forall a : R, a - 4 <> 0 -> a - 5 <> 0.\nProof. intros. nonzero. Qed.\n") != ""


INEQUALITIES = [
    # terms of one sign, a square, a factor that is negative, a quotient of unknown signs, a difference of the domain
    ("x**2 + a*b", ">", "0", ""),
    ("x**2 + b**2", ">=", "2*b*x", ""),
    ("(a - b)*(b + x**2)", "<", "0", 'where = ["b > a"]'),
    ("x**2/(p**2 - 5)**2", ">=", "0", ""),
    ("b*x**2 + a*p**2/b", ">=", "a*x**2 + a*p**2/b", 'where = ["b > a"]'),
    ("a*x**2 + 2*x*p + b*p**2", ">=", "0", 'where = ["a*b > 1"]'),
    ("2*a + pi*b", ">", "a + b*pi/2", ""),
    ("3/7", "<", "4/9", ""),
    ("c*a", ">=", "0", ""),
    ("(x - p)**2", ">", "0", 'where = ["x != p"]'),
    ("d**3*(x**2 + 1)", "<", "0", ""),
    ("0*x", ">=", "0", ""),
]


def inequality(lhs: str, relation: str, rhs: str, domain: str) -> Any:
    words = {"a": "positive", "b": "positive", "c": "nonnegative", "d": "negative", "n": "integer"}
    symbols = "\n".join(f'{name} = "{word}"' for name, word in words.items())
    extra = f"[symbols]\n{symbols}\n[domain]\n{domain}"
    return of_text(f'kind = "inequality"\nlhs = "{lhs}"\nrelation = "{relation}"\nrhs = "{rhs}"', extra)


@needs_coqc
def test_coqc_accepts_inequalities(tmp_path: Path) -> None:
    texts = [coq_of(inequality(*each)) for each in INEQUALITIES]
    for relation, shown in ((">", "<= 0."), (">=", "< 0.")):
        texts.append(coq_of(inequality("x**2 - a", relation, "p/b", "")))
        assert shown in texts[-1]
    assert coqc(tmp_path, "\n".join(f"Module M{k}.\n{text}\nEnd M{k}." for k, text in enumerate(texts))) == ""


@needs_coqc
@pytest.mark.parametrize(
    ("k", "old", "new"), [(0, "x ^ 2 + a * b", "x ^ 2 - a * b"), (5, "0 < a * b - 1", "0 < a * b + 1")]
)
def test_coqc_refuses_an_inequality_that_is_false(tmp_path: Path, k: int, old: str, new: str) -> None:
    text = coq_of(inequality(*INEQUALITIES[k]))
    assert old in text
    assert "Error" in coqc(tmp_path, text.replace(old, new))


@pytest.mark.parametrize(
    ("lhs", "rhs", "domain", "reason"),
    [
        ("exp(x)", "0", "", "functions"),
        ("pi", "3", "", "digits of pi"),
        ("x**6 - x + 1", "0", "", "high degree"),
        ("n**2 - n + 1", "0", "", "whole numbers"),
        ("a*x**2", "-1", 'where = ["x >= 0"]', "edge of the domain"),
    ],
)
def test_an_inequality_that_has_no_proof_by_signs_is_refused(lhs: str, rhs: str, domain: str, reason: str) -> None:
    with pytest.raises(InputError, match=reason):
        coq_of(inequality(lhs, ">", rhs, domain))


@needs_coqc
def test_coqc_refuses_what_is_false(tmp_path: Path) -> None:
    text = coq_of(data("transformations", "polar-coordinates", 0))
    false = text.replace("- 1 = 0.\nProof", "- 2 = 0.\nProof")
    assert false != text
    assert "Error" in coqc(tmp_path, false)


def test_relations_are_equations_for_field() -> None:
    """With integers as they are, with fractions for multiples of the kernels: no cofactors are written out."""
    whole = of_text('kind = "identity"\nlhs = "(sqrt(x**2 + 1) + p)*(sqrt(x**2 + 1) - p)"\nrhs = "x**2 + 1 - p**2"')
    text = coq_of(whole)
    assert "x ^ 2 + 1) by" in text
    assert "field [power'" in text
    assert "numerator'" not in text
    text = coq_of(of_text(FRACTIONS))
    assert text.count("pose (multiple'") == 2
    assert "15 ^ 2 *" in text  # 15 times the outer root, squared, is 75 times 3 times the inner root, and so on
    assert "75 * multiple'" in text
    assert "rewrite relation'" not in text[text.index("numerator'") :]


@needs_coqc
@pytest.mark.slow
def test_a_wrong_coefficient_beside_fractions_is_not_accepted(tmp_path: Path) -> None:
    text = coq_of(of_text(FRACTIONS))
    statement = text[text.index("Theorem") : text.index("Proof.")]
    assert "(1 / 3)" in statement
    assert "Error" in coqc(tmp_path, text.replace(statement, statement.replace("(1 / 3)", "(1 / 4)")))


def test_a_claim_on_a_surface_has_its_equation_as_a_hypothesis() -> None:
    text = coq_of(of_text('kind = "identity"\nlhs = "x**2"\nrhs = "1/p"', '[domain]\non = ["x**2 - 1/p"]'))
    assert "  x ^ 2 - / p = 0 ->\n" in text
    unused = coq_of(of_text('kind = "bracket"\nf = "x"\ng = "p"\nequals = "1"', '[domain]\non = ["x*p"]'))
    assert "surface" not in unused[unused.index("Theorem") :]


@needs_coqc
@pytest.mark.slow
def test_without_the_equation_of_its_surface_a_claim_is_not_accepted(tmp_path: Path) -> None:
    text = coq_of(of_text('kind = "identity"\nlhs = "x**2"\nrhs = "1/p"', '[domain]\non = ["x**2 - 1/p"]'))
    assert coqc(tmp_path, text) == ""
    free = text.replace("  x ^ 2 - / p = 0 ->\n", "").replace(") by assumption", ") by (field; nonzero)")
    assert "Error" in coqc(tmp_path, free)


def test_a_theorem_says_what_the_functions_are() -> None:
    text = coq_of(
        of_text('kind = "bracket"\nf = "sqrt(x)*sin(x)"\ng = "p"\nequals = "sin(x)/(2*sqrt(x)) + sqrt(x)*cos(x)"')
    )
    statement = text[text.index("Theorem residual_1") : text.index("Proof.")]
    for part in ("= sqrt (x) ->", "= cos (x) ->", "= sin (x) ->", "0 < x ->"):
        assert part in statement
    assert "admit" not in text.lower()
    assert "axiom" not in text.lower()


def test_other_functions_are_any_number_with_their_relation() -> None:
    text = coq_of(
        of_text(
            'kind = "bracket"\nf = "x*cbrt(a)**3 + atan2(a, x**2 + 1)"\ng = "x"\nequals = "0"',
            '[symbols]\na = "positive"',
        )
    )
    assert "atan2" not in text[text.index("Theorem") :]


@pytest.mark.parametrize(
    ("keys", "extra", "reason"),
    [
        ('kind = "bracket"\nf = "1j*x"\ng = "p"\nequals = "1j"', "", "complex"),
        ('kind = "bracket"\nf = "x"\ng = "p"\nequals = "0"', '[domain]\non = ["x*p"]', "surface"),
        ('kind = "identity"\nlhs = "sin(x)"\nrhs = "x"', "", "rational function"),
        ('kind = "matrix_algebra"\nbasis = { A = [["0", "1"], ["-1", "0"]] }\nequals = "u(1)"', "", "no identity"),
        (
            'kind = "identity"\nlhs = "asin(sin(x))"\nrhs = "pi - x"',
            '[domain]\nwhere = ["pi/2 < x < 3*pi/2"]',
            "no identity",
        ),
    ],
)
def test_what_cannot_be_put_in_coq_is_refused(keys: str, extra: str, reason: str) -> None:
    with pytest.raises(InputError, match=reason):
        coq_of(of_text(keys, extra))


def test_a_changed_numerator_is_refused() -> None:
    changed = {**data("transformations", "polar-coordinates", 0)}
    entry = changed["cases"][0]["residuals"][3]
    case = {**changed["cases"][0], "residuals": list(changed["cases"][0]["residuals"])}
    case["residuals"][3] = {**entry, "numerator": {"r": "1"}}
    with pytest.raises(InputError, match="isn't the residual's"):
        coq_of({**changed, "cases": [case]})


def shared(monkeypatch: pytest.MonkeyPatch, found: Any) -> str:
    """A certificate in Coq with names for what its residuals share, whatever their length."""
    monkeypatch.setattr("canon.report.coq.LONG", 0)
    return coq_of(found)


POLAR = ("transformations", "polar-coordinates", 0)


def test_what_residuals_share_is_defined_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """One theorem; nothing is assumed beyond the kernels, the domain and the definitions."""
    text = shared(monkeypatch, data(*POLAR))
    assert text.count("\nTheorem ") == 1
    statement = text[text.index("Theorem residual_1") : text.rindex("Proof.")]
    assert statement.count(" = 0") == statement.count(" /\\\n") + 1
    lines = [line.split(" = ") for line in statement.splitlines() if line.startswith("  u")]
    for k, (name, line) in enumerate(lines, 1):
        assert name == f"  u{k}"
        assert not any(f"u{later}" in line.replace("*", " ").split() for later in range(k, len(lines) + 1))


@needs_coqc
@pytest.mark.slow
def test_the_procedure_for_what_is_shared_accepts_what_is_true_alone(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Polar coordinates, the oscillator, a nested root are accepted, on the library's axioms; a changed one isn't."""
    text = shared(monkeypatch, data(*POLAR))
    more = [
        shared(monkeypatch, found) for found in (data("transformations", "oscillator-type-1", 0), of_text(FRACTIONS))
    ]
    theorems = [text, *(other[other.index("\nTheorem residual_1") :] for other in more)]
    modules = "\n".join(
        [theorems[0], *(f"Module claim_{k}.\n{t}\nEnd claim_{k}.\n" for k, t in enumerate(theorems[1:]))]
    )
    (tmp_path / "claims.v").write_text(f"{modules}\nPrint Assumptions residual_1.\n", encoding="utf-8")
    done = subprocess.run([str(COQC), "-q", "claims.v"], cwd=tmp_path, capture_output=True, text=True, timeout=240)
    assert done.returncode == 0, done.stderr
    axioms = [line.split(" ")[0] for line in done.stdout.splitlines() if line[0] not in " A"]
    assert {name.rpartition(".")[2] for name in axioms} == {
        "sig_not_dec",
        "sig_forall_dec",
        "functional_extensionality_dep",
    }
    statement = text[text.index("Theorem residual_1") : text.rindex("Proof.")]
    assert "+ (- 1) = 0" in statement
    false = text.replace(statement, statement.replace("+ (- 1) = 0", "+ (- (1000 / 1001)) = 0", 1))
    assert "Error" in coqc(tmp_path, false)


@pytest.mark.parametrize("things", ["cases", "residuals"])
def test_a_certificate_of_another_version_is_named_as_one(things: str) -> None:
    changed = {**data(*POLAR)}
    if things == "cases":
        changed["cases"] = changed["cases"] * 2
    else:
        changed["cases"] = [{**changed["cases"][0], "residuals": changed["cases"][0]["residuals"][1:]}]
    with pytest.raises(InputError, match=f"{things}, but its claim has .* make it anew with `canon verify"):
        coq_of(changed)
