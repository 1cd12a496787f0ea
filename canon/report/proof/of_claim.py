"""Proofs of claims that were made in Python: shown in a notebook, saved as a document, a certificate, or for Coq."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from canon.claim import Claim
from canon.claims.worker import Entry
from canon.errors import InputError
from canon.expected import instance_of
from canon.report.proof_file import NOTATIONS, document, rendered
from canon.report.record import claim_record
from canon.verdict import Verdict


@dataclass(frozen=True)
class Proof:
    """A verdict with what it rests on, to be read: `verdict`; `certificate`, the data that `canon certificate` checks.

    Where the verdict is neither `proved` nor `refuted`, it says what is known, and `certificate` is None.
    """

    verdict: Verdict
    certificate: Mapping[str, Any] | None
    tables: Mapping[str, Any] = field(repr=False)
    record: Mapping[str, Any] = field(repr=False)

    def text(self) -> str:
        """Plain text."""
        return self._section("plain")

    def latex(self) -> str:
        """A document for pdflatex."""
        return self._document("latex")

    def markdown(self) -> str:
        """Markdown for MyST, with theorem and proof directives."""
        return self._section("markdown")

    def html(self) -> str:
        """A web page by itself."""
        return self._document("html")

    def coq(self) -> str:
        """A file for Coq; **raises** `InputError` where the certificate can't be put in Coq, with the reason."""
        from canon.report.coq import coq_of

        return coq_of(self._certificate())

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the proof: .html, .tex, .md, .txt; .json is the certificate, .v the file for Coq.

        **Raises:** `InputError` for another ending, or where there is no certificate; `OSError`.
        """
        if not isinstance(path, (str, os.PathLike)):
            raise InputError(f"a path is expected, not {path!r}", "path")
        place = Path(path)
        if place.suffix == ".json":
            text = json.dumps(self._certificate(), indent=1, ensure_ascii=False) + "\n"
        elif place.suffix == ".v":
            text = self.coq()
        elif place.suffix in NOTATIONS:
            text = self._document(NOTATIONS[place.suffix])
        else:
            raise InputError(f"{place.name!r} has none of the endings {', '.join([*NOTATIONS, '.json', '.v'])}")
        place.write_text(text, encoding="utf-8")
        return place

    def _certificate(self) -> Mapping[str, Any]:
        if self.certificate is None:
            raise InputError(f"there is no certificate of what is {self.verdict.status}")
        return self.certificate

    def _section(self, notation: str) -> str:
        return "\n".join(rendered(notation, dict(self.record), self.tables, self.certificate))

    def _document(self, notation: str) -> str:
        record = {**self.record, "proof": rendered(notation, dict(self.record), self.tables, self.certificate)}
        return document(notation, str(self.record["title"] or "A proof"), [record], self.verdict.seconds)

    def __str__(self) -> str:
        return self.text()

    def _repr_html_(self) -> str:
        return self._section("html")

    def _repr_markdown_(self) -> str:
        return self.markdown()

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        return {"text/html": self._repr_html_(), "text/markdown": self.markdown(), "text/plain": self.text()}


def proof(claim: Claim, verdict: Verdict | None = None, *, budget: float = 10.0) -> Proof:
    """The proof of a claim, or what refutes it, to be read and to be checked by others.

    **Arguments:** the claim; its verdict, if it has one already, else it is verified within the `budget` in seconds.

    **Raises:** `InputError` where the claim is ill-posed, or can't be written as a claim file (of which its certificate
    speaks): a domain with a condition that is no inequality, for example.
    """
    from canon.checker.check import check
    from canon.claims.certificate_data import certificate
    from canon.claims.claim_tables import claim_tables
    from canon.claims.verify import verify

    instance_of(claim, Claim, "claim")
    if verdict is not None:
        instance_of(verdict, Verdict, "verdict")
        if (verdict.kind, verdict.title) != (claim.kind, claim.title):
            raise InputError(f"this is the verdict on another claim, of kind {verdict.kind!r}", "verdict")
    tables = claim_tables(claim)
    if verdict is not None and verdict.claim is not None and claim_tables(verdict.claim) != tables:
        raise InputError("this is the verdict on another claim of this kind", "verdict")
    answer = verify(claim, budget=budget) if verdict is None else verdict
    data = certificate(claim, answer, tables) if answer.status in ("proved", "refuted") else None
    if verdict is not None and data is not None and (found := check(data)).status == "rejected":
        raise InputError(f"this verdict isn't that of the claim: {'; '.join(found.reasons)}", "verdict")
    return Proof(answer, data, tables, claim_record(Entry("", claim.index, claim), claim, answer))
