"""Is what a certificate says so? Its claim's residuals are derived anew, its identities multiplied out.

Its claim is one that a file could state (`canon.checker.schema`, `stated`); what has to be shown of it is a matter of
its kind (`kinds`); whether it is shown, of `shown`, and for a refutation by a point of `witness`.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import chain
from typing import Any

from canon.checker.case import Case
from canon.checker.followed import is_identity
from canon.checker.functions import NotZero, Rejected, Unknown, Unreadable
from canon.checker.kinds import obligations
from canon.checker.obligations import hessian
from canon.checker.schema import check_known, check_tables
from canon.checker.shown import Shown
from canon.checker.statement import KNOWN, Statement
from canon.checker.values import Values
from canon.checker.witness import refutes

VERSION = 1


@dataclass(frozen=True)
class Answer:
    """`status` is "confirmed", "confirmed in part", "not confirmed" (what the checker has no rules for) or "rejected".

    `reasons` say what isn't confirmed, or what is wrong.
    """

    status: str
    reasons: tuple[str, ...] = ()

    def __str__(self) -> str:
        return ": ".join([self.status, *(["; ".join(self.reasons)] if self.reasons else [])])


def check(certificate: Any) -> Answer:
    """The answer about a certificate that has been read as JSON. Raises Unreadable for what is none."""
    if not isinstance(certificate, Mapping) or certificate.get("certificate") != VERSION:
        raise Unreadable(f"this is no certificate of version {VERSION}")
    try:
        if checksum(certificate) != certificate.get("checksum"):
            raise Rejected("the checksum is wrong: something was changed")
        trusted = tuple(dict.fromkeys(_Check(certificate).run()))
    except Rejected as reason:
        return Answer("rejected", (str(reason),))
    except (KeyError, TypeError, AttributeError, IndexError, ValueError, RecursionError) as error:
        if isinstance(error, Unknown):
            return Answer("not confirmed", (str(error),))
        raise Unreadable(str(error) if isinstance(error, Unreadable) else f"something is missing: {error}") from None
    return Answer("confirmed in part" if trusted else "confirmed", trusted)


def checksum(certificate: Mapping[str, Any]) -> str:
    """SHA-256 of all the rest, as compact JSON with its keys in order."""
    rest = {key: value for key, value in certificate.items() if key != "checksum"}
    return hashlib.sha256(json.dumps(rest, sort_keys=True, separators=(",", ":")).encode()).hexdigest()


class _Check:
    """One certificate being checked."""

    def __init__(self, certificate: Mapping[str, Any]) -> None:
        self.data, self.verdict = certificate, certificate["verdict"]
        if self.verdict not in KNOWN:
            raise Rejected(f"there is no proof of what is {str(self.verdict)[:40]!r}")
        check_tables(certificate["tables"])
        check_known(certificate["known"])
        self.s = Statement(certificate["tables"], certificate["known"], self.verdict)
        self.cases = obligations(self.s)
        self.s.check_names()
        more = {"equals"} if self.verdict == "refuted" else {""}  # one thing more that would have to hold
        self.unread = sorted(self.s.claim.unread - more)
        words = chain.from_iterable(self.s.words.values())
        self.real = "complex" not in words and ("s", "1j") not in self.s.f.ops
        self.shown = Shown(self.s, certificate.get("points", []), real=self.real)

    def run(self) -> list[str]:
        """What has to be taken on trust. Raises Rejected."""
        unread = (f"what the key {key!r} says, which there is no rule for" for key in self.unread)
        return [*unread, *self._run(), *self.s.trusted]

    def _run(self) -> list[str]:
        witness = self.data.get("witness")
        if self.verdict == "refuted" and witness is not None and all(case.found is not False for case in self.cases):
            if self.s.direction == "implicit":  # where its mixed Hessian is 0 a generating function makes no map
                self.s.conditions = [*self.s.conditions, (hessian(self.s), "nonzero")]
            trusted = refutes(self.s, self.cases, witness, real=self.real)
            own = Values(self.s, self.shown.primes[0], self.shown.rng, real=self.real)
            if not all(is_identity(own, a) for case in self.cases for a in case.granted):
                trusted.append(
                    "that the point says something of what is claimed, as its grounds aren't seen to be constant"
                )
            return trusted
        if self.verdict == "proved" and witness is not None:
            raise Rejected("a proof with a witness against it")
        if not isinstance(self.data["cases"], list):
            raise Rejected("its cases are no list")
        if not self.cases:
            raise Unknown("nothing is claimed")
        if self.verdict == "refuted" and all(case.fails_alone for case in self.cases):
            return [x for case in self.cases for x in (*_doubts(case), *self.shown.is_somewhere(case))]
        if not self.data["cases"]:
            raise Unknown("nothing is shown of it")
        if len(self.data["cases"]) != len(self.cases):
            raise Rejected(f"{len(self.data['cases'])} cases are shown, but the claim has {len(self.cases)}")
        return [
            x for case, data in zip(self.cases, self.data["cases"], strict=True) for x in self._answered(case, data)
        ]

    def _answered(self, case: Case, data: Mapping[str, Any]) -> list[str]:
        if self.verdict == "proved":
            if case.found is False:
                raise Rejected("by exact arithmetic the claim fails")
            return self.shown.of(case, data)
        if case.found is False:  # by what the certificate shows to be 0
            grounds = Case(case.zeros, images=case.images, independent=case.independent, algebra=case.algebra)
            return [*_doubts(case), *self.shown.of(grounds, data)]
        if case.granted_by_all:
            return self.shown.of(case, {**data, "residuals": []})
        if not case.nonzeros:
            raise Unknown("a refutation without a point, by an argument that there is no rule for")
        try:
            return self.shown.of(Case(case.nonzeros[0], [], case.images), data)  # what must not vanish everywhere does
        except NotZero:
            if not case.trusted:
                raise
            raise Unknown("what must not vanish isn't 0 everywhere; whether it is on a part isn't said") from None


def _doubts(case: Case) -> list[str]:
    """What a refutation takes on trust."""
    return [case.against] if case.against else []
