"""Refutations of integrals to infinity, beside `counterexample.py`: what the integral is isn't what the claim says.

The integral is Gauss's (`alone_gauss.py`), or there is an antiderivative F, in the claim or the certificate, that is
smooth along the range and has limits at infinity, as `alone_integrals.py` sees them for all parameters. At
the certificate's point, in the claim's domain, F(b) − F(a) and the claim's value lie in intervals that are apart.
"""

from __future__ import annotations

from typing import Any

if __package__:
    from canon.checker import alone, alone_endless, alone_gauss, alone_integrals
    from canon.checker.alone import Formula, Stop
    from canon.checker.counterexample import Arithmetic, Open, check, fails, somewhere
    from canon.checker.counterexample_formulas import Writer, put_names
    from canon.checker.counterexample_functions import Place
    from canon.checker.counterexample_integrals import sides_of
else:  # as a program's part, beside the other files
    import alone  # type: ignore
    import alone_endless  # type: ignore
    import alone_gauss  # type: ignore
    import alone_integrals  # type: ignore
    from alone import Formula, Stop  # type: ignore
    from counterexample import Arithmetic, Open, check, fails, somewhere  # type: ignore
    from counterexample_formulas import Writer, put_names  # type: ignore
    from counterexample_functions import Place  # type: ignore
    from counterexample_integrals import sides_of  # type: ignore

BITS, SHARED = 192, ("hamiltonian", "transformation", "generating_function")


def sample(claim: Any, prime: int) -> int:
    """See at one point that the antiderivative is one."""
    point = alone_integrals.Along(claim, prime)
    point.check_domain()
    point.start()
    if point.text(f"D(_rhs, {claim.x}) - _lhs"):
        raise Stop("not shown", "that the antiderivative is one")
    return len(point.roots)


def by_antiderivative(claim: Any) -> Any:
    """F(b) − F(a) as a formula. Raises Stop."""
    between = alone_integrals.Between(claim)
    claim.positive = between.is_positive(between.at(alone_integrals.of.named(claim.x)))
    if claim.signed and not claim.positive:
        raise Stop("not shown", "that what is assumed of the variable holds along the range")
    between.check(claim.f)
    between.check(claim.antiderivative)
    values = list[Any]()
    for n, end in enumerate(claim.ends):
        if isinstance(end, int):
            values.append(alone_endless.Endless(claim, end).limit(claim.antiderivative))
        else:
            alone_integrals.Between(claim, n).check(claim.antiderivative, strict=True)
            values.append(put_names(Writer(claim).written(claim.antiderivative), {claim.x: end}))
    if alone.tried(sample, claim)[0] != "shown":
        raise Stop("not shown", "that the antiderivative is one")
    return Formula("+", (values[1], Formula("*", (alone.number(-1), values[0]))))


def refuted(tables: Any, witness: Any, known: Any = None) -> tuple[str, str]:
    """Whether the integral has another value at the witness."""
    said = tables["claim"]
    if said["kind"] != "integral" or not isinstance(witness, dict):
        raise Stop("not shown", "a refutation of such a claim")
    if {*SHARED} & {*tables} or {*tables.get("domain", {})} - {"where"}:
        raise Stop("not shown", "an integral beside a Hamiltonian or a map")
    if "infinity" not in f"{said['from']} {said['to']}":
        raise Stop("not shown", "an integral between two numbers")
    given = said.get("antiderivative", (known or {}).get("antiderivative"))
    if given is None:
        claim = alone_integrals.Integral(tables, "0")
        value = alone_gauss.value(claim)
    else:
        claim = alone_integrals.Integral(tables, given)
        value = by_antiderivative(claim)
    of = somewhere(claim, witness, 0)
    of.pop(claim.x, None)
    point = Place(claim, of, Arithmetic(BITS))
    for text, word in sides_of(claim.domain.get("where", [])):
        check(point.text(text), [word])
    for name, words in claim.words.items():
        if name != claim.x and "function" not in words:
            check(point.named(name), words)
    if any(claim.is_called(g) for f in (claim.f, claim.equals, value) for g in claim.parts(f)):
        raise Stop("not shown", "an integral with functions")
    difference = Formula("+", (value, Formula("*", (alone.number(-1), claim.equals))))
    box = Place(claim, of | {claim.x: (somewhere(claim, {}, 1)[claim.x])}, Arithmetic(BITS))
    try:
        box.at(claim.f)  # the integrand's coefficients have values there
    except Open:
        return "not shown", "that the integrand has a value"
    return ("shown", "") if fails(point.at(difference), "") else ("not shown", "that something fails at the witness")
