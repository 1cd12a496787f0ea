"""Refutations by small files, one after the other: `python refutations.py CERTIFICATE.json …`"""

from __future__ import annotations

from typing import Any

if __package__:
    from canon.checker import alone, counterexample, counterexample_kinds
    from canon.checker.alone import Stop
else:  # as a program, beside the other files
    import alone  # type: ignore
    import counterexample  # type: ignore
    import counterexample_kinds  # type: ignore
    from alone import Stop  # type: ignore

FILES = (counterexample_kinds,)


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate that was read as JSON: that of `counterexample`, or where it has none, of the
    others."""
    answer = counterexample.checked(data)
    if answer[0] != "not shown" or not isinstance(data, dict) or data.get("verdict") != "refuted":
        return answer
    for file in FILES:
        try:
            found = file.refuted(data["tables"], data.get("witness"))
        except Stop as stop:
            found = stop.args
        except Exception as error:  # whatever a certificate has in the wrong place
            found = "not shown", f"a certificate of another form ({type(error).__name__}: {error})"
        if found[0] == "shown":
            return "shown", ""
        answer = found if found[1] and "such a claim" not in found[1] else answer
    return "not shown", answer[1]


if __name__ == "__main__":
    alone.main(checked)
