"""What isn't 0: independent functions, and Hessians of Lagrangians: `python alone_regular.py CERTIFICATE.json …`

Functions are independent where a minor of their derivatives by coordinates and momenta isn't 0. Which one is tried, and
it has to be 0 nearly nowhere, whatever the parameters and the time are (`alone_wider.py`). A Hessian isn't 0 where its
determinant, with derivatives written out, or the negative of it, is seen to be positive (`alone_signs.py`).
"""

from __future__ import annotations

from typing import Any

if __package__:
    from canon.checker import alone, alone_algebras, alone_signs, alone_table, alone_wider
    from canon.checker.counterexample_formulas import NOUGHT, UNIT, Writer, is_nought, times, total
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_algebras  # type: ignore
    import alone_signs  # type: ignore
    import alone_table  # type: ignore
    import alone_wider  # type: ignore
    from counterexample_formulas import NOUGHT, UNIT, Writer, is_nought, times, total  # type: ignore

Formula, Stop, RANDOM = alone.Formula, alone.Stop, alone.RANDOM
TRIES, MOST_ANGLES, MOST_ROWS = 12, 3, 7
INDEPENDENT = {"keys": "functions", "vary": "x", "besides": ["functions_i - functions_i"]}
"""Time is a parameter: functions are independent at each time. What is 0 says only that they have values."""


def itself(claim: Any) -> dict[str, Any]:
    """Names that stand for themselves; what is read with them has no abbreviations left in it."""
    return {name: Formula(".", (name,)) for name in {*claim.names, *claim.variables}}


def negative(claim: Any, f: Any) -> Any:
    return times(claim, alone.number(-1), f)


def determinant(claim: Any, rows: list[list[Any]]) -> Any:
    """Of formulas without derivatives, by the first row."""
    if len(rows) > MOST_ROWS:
        raise Stop("not shown", "a determinant that is so large")
    if not rows:
        return UNIT
    found = NOUGHT
    for k, first in enumerate(rows[0]):
        if not is_nought(first):
            rest = times(claim, first, determinant(claim, [[*row[:k], *row[k + 1 :]] for row in rows[1:]]))
            found = total(claim, found, negative(claim, rest) if k % 2 else rest)
    return found


def is_positive(claim: Any, f: Any) -> bool:
    """Whether a formula without derivatives is seen to be positive wherever it has a value, in all of the domain."""
    first = alone_signs.Signs(claim)
    first.quotient(f)
    angles = first.angles
    if len(angles) > MOST_ANGLES:
        return False
    flats = [[k for n, k in enumerate(angles) if ways >> n & 1] for ways in range(1 << len(angles))]
    return all((signs := alone_signs.Signs(claim, flat)).shown(signs.quotient(f)[0], True) for flat in flats)


def check_sign(claim: Any, f: Any) -> None:
    """See that it has one sign everywhere. Raises Stop."""
    if not (is_positive(claim, f) or is_positive(claim, negative(claim, f))):
        raise Stop("not shown", "that a determinant has a sign")


class Functions(alone_wider.Wider):
    """A claim that functions are independent."""

    def __init__(self, tables: Any) -> None:
        super().__init__(tables, INDEPENDENT)
        self.words.setdefault(self.names[-1], ["real"])
        self.basis = [self.known(f"__functions_{k}") for k in range(len(tables["claim"]["functions"]))]
        self.chosen: tuple[Any, ...] = ()


class Independent(alone_algebras.Independent):
    """A random point at which a minor isn't 0."""

    def check(self) -> None:
        alone_wider.Placed.check(self)
        claim: Any = self.asked
        minor = lambda chosen: lambda point, *by: point.determinant(chosen, *by)
        if claim.chosen:
            self.check_apart(minor(claim.chosen))
            return
        routes: list[alone_algebras.Route] = [(v,) for v in claim.variables]
        reason = Stop("not shown", "that the functions are independent")
        rows, other = [self.row(route) for route in routes], Independent(claim, self.p)
        other.free = {key: x for key, x in self.free.items() if len(key) == 1 or key[0] in ("circle", "exp")}
        called = {
            r: sum(a != b for a, b in zip(row, other.row(r), strict=True)) for r, row in zip(routes, rows, strict=True)
        }
        for _ in range(TRIES):
            chosen = self.chosen_of(sorted(routes, key=lambda r: (called[r], RANDOM.random())))
            if len(chosen) < len(claim.basis):
                break
            try:
                self.check_apart(minor(chosen))
            except Stop as stop:
                reason = stop
                continue
            claim.chosen = chosen
            return
        raise reason


def of_functions(data: Any) -> tuple[str, str]:
    """That functions are independent."""
    tables = data["tables"]
    said = {*tables["claim"]} - {*alone.UNASKED}
    if said != {"functions"} or "generating_function" in tables or {*"qp"} & {*tables.get("transformation", {})}:
        raise Stop("not shown", "functions with other keys, or beside a map whose image is all that there is")
    if not tables["claim"]["functions"]:
        raise Stop("not shown", "no functions")

    def sample(claim: Any, prime: int) -> int:
        point = Independent(claim, prime)
        point.check_domain()
        point.check()
        return len(point.roots)

    return alone.tried(sample, Functions(tables))


def of_lagrangian(data: Any) -> tuple[str, str]:
    """What the table says of a Lagrangian, with its Hessian's sign."""
    tables = data["tables"]
    form = dict(alone_table.form_of(tables))
    if not form.pop("nonzero", None):
        raise Stop("not shown", "a Lagrangian whose Hessian isn't asked for")
    claim = alone_wider.Wider(tables, form)
    own, write, v = itself(claim), Writer(claim), tables["claim"]["velocities"]
    rows = [[write.written(claim.read(f"D(D(__L, {a}), {b})", own)) for b in v] for a in v]
    check_sign(claim, determinant(claim, rows))
    return alone.tried(alone_wider.sample, claim, data["cases"][0])


RULES = {"independent": of_functions, "euler_lagrange": of_lagrangian, "legendre": of_lagrangian}


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim."""
    if (rule := RULES.get(data["tables"]["claim"]["kind"])) is None:
        raise Stop("not shown", "such a claim")
    return rule(data)


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
