"""The precision of balls, set in turn: it is one for all threads of a process."""

from __future__ import annotations

from types import TracebackType

import flint

from canon.turns import in_turn


class precision(in_turn):  # noqa: N801 - it is used as a function is
    """Arb's working precision, set in turn within a `with`, and put back after it."""

    def __init__(self, bits: int) -> None:
        super().__init__()
        self._bits = bits

    def __enter__(self) -> None:
        super().__enter__()
        self._before = flint.ctx.prec
        flint.ctx.prec = self._bits

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        flint.ctx.prec = self._before
        super().__exit__(kind, error, trace)
