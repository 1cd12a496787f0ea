"""What a command says, in a form that does nothing but say it: no name or text of a file moves a terminal's cursor."""

from __future__ import annotations

import json
import re
import sys
from typing import Any, Final

_MOVING: Final = re.compile("[\x7f-\x9f\u061c\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff\ufff9-\ufffb]")
"""Control characters that JSON leaves alone, of which terminals take some for the beginning of a command."""


def complain(text: str) -> None:
    """Print one line on standard error."""
    print(shown(text), file=sys.stderr)


def shown(text: object) -> str:
    """A text, as the name of a file, on one line and without control characters."""
    from canon.report.words import visible

    return visible(str(text))


def notation(record: Any, *, indent: int | None = None) -> str:
    """A record as JSON, for standard output. Letters that its encoding doesn't have are escaped, never replaced; and so
    are control characters. **Raises:** `ValueError` for a number that isn't finite."""
    text = json.dumps(record, ensure_ascii=False, indent=indent, allow_nan=False)
    try:
        text.encode(sys.stdout.encoding or "utf-8")
    except UnicodeEncodeError:
        return json.dumps(record, ensure_ascii=True, indent=indent, allow_nan=False)
    return _MOVING.sub(lambda found: f"\\u{ord(found[0]):04x}", text)
