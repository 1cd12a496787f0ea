"""Claims stated as text, answered."""

from collections.abc import Callable

import pytest

from canon.claims.reader import read_text
from canon.claims.verify import verify
from canon.verdict import Verdict

PATIENT = 120.0
"""Seconds of a claim's budget: verdicts are to be the same on a machine that is slow, or busy with other things."""
PLANE = 'q = ["q"]\np = ["p"]\nQ = ["Q"]\nP = ["P"]\n'


def _text(space: str, sections: dict[str, str], claims: tuple[str, ...]) -> str:
    parts = [f"[phase_space]\n{space}"]
    parts += [f"[{name}]\n{body}" for name, body in sections.items()]
    parts += [f"[[claim]]\n{claim}" for claim in claims]
    return "\n".join(parts)


@pytest.fixture
def ask() -> Callable[..., list[Verdict]]:
    """Answers claims about a subject given by sections; `space` is one degree of freedom with new variables Q, P."""

    def answers(*claims: str, space: str = PLANE, options: dict | None = None, **sections: str) -> list[Verdict]:
        reading = read_text(_text(space, sections, claims))
        assert not reading.problems, reading.problems
        return [verify(claim, **{"budget": PATIENT, **(options or {})}) for claim in reading.claims]

    return answers


@pytest.fixture
def status(ask: Callable[..., list[Verdict]]) -> Callable[..., str]:
    """The status of a single claim."""
    return lambda *claims, **sections: ask(*claims, **sections)[0].status
