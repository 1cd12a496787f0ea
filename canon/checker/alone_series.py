"""Lie series up to an order: `python alone_series.py CERTIFICATE.json …`

The claim's E(s) = Σ c_k s^k has to be a polynomial of degree n at most, as it stands, with c_0 = f and (k + 1) c_{k+1}
= {c_k, G} for k < n. So ∂E/∂s − {E, G} is r sⁿ, and r, at two random values of s, is the same.
"""

from __future__ import annotations

from typing import Any

if __package__:
    from canon.checker import alone, alone_wider
    from canon.checker.alone_regular import itself
    from canon.checker.counterexample_formulas import Writer, degree
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_wider  # type: ignore
    from alone_regular import itself  # type: ignore
    from counterexample_formulas import Writer, degree  # type: ignore

Stop, MOST_ORDER = alone.Stop, 40
FORM: Any = {"keys": "generator parameter f equals", "names": "parameter", "among": "t", "germ": "parameter",
    "of": {"equals": "q p t parameter", "generator f": "q p t"},
    "let": {"rest": "D(equals, parameter) - bracket(equals, generator)"},
    "besides": ["with(equals, parameter, 0) - f"]}  # fmt: skip


class Series(alone_wider.Wider):
    """A claim about a Lie series to an order."""

    def __init__(self, tables: Any) -> None:
        claim = {key: x for key, x in tables["claim"].items() if key not in alone.UNASKED}
        self.order = claim.pop("order", None)
        if type(self.order) is not int or not 1 <= self.order <= MOST_ORDER or {*claim} != {*FORM["keys"].split()}:
            raise Stop("not shown", "a series without an order, of such a one, or with other keys")
        if "generating_function" in tables or {*"qp"} & {*tables.get("transformation", {})}:
            raise Stop("not shown", "a series beside a map whose image is all that there is")
        super().__init__({**tables, "claim": {**claim, "kind": tables["claim"]["kind"]}}, FORM)
        self.parameter = claim["parameter"]
        own = itself(self)
        highest = degree(Writer(self).written(self.read("__equals", own)), self.parameter, self)
        if highest is None or highest > self.order:
            raise Stop("not shown", "what isn't a polynomial of this degree in the parameter")
        f = [Writer(self).written(self.read(f"__{key}", own)) for key in ("generator", "f")]
        if any(degree(g, self.parameter, self) != 0 for g in f):
            raise Stop("not shown", "a generator, or a function, with the parameter in it")


def sample(claim: Series, prime: int) -> int:
    """See at two points that differ in the parameter alone that what is left is r sⁿ."""
    point = alone_wider.Placed(claim, prime)
    point.check_domain()
    point.check()
    first = point.text("__rest") * pow(point.named(claim.parameter), -claim.order, prime) % prime
    other = alone_wider.Placed(claim, prime)
    other.free = {key: x for key, x in point.free.items() if key != (claim.parameter,)}
    second = other.text("__rest") * pow(other.named(claim.parameter), -claim.order, prime) % prime
    if first != second or point.named(claim.parameter) == other.named(claim.parameter):
        raise Stop("not shown", "that this is the series")
    return max(len(point.roots), len(other.roots))


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim."""
    if data["tables"]["claim"]["kind"] != "lie_series":
        raise Stop("not shown", "no Lie series")
    return alone.tried(sample, Series(data["tables"]))


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
