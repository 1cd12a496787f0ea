"""Refutations of `field_equations` in fields of several variables, beside `counterexample.py`.

In L each field u(x, …), and each of its derivatives, becomes a name; so Σ (−1)^|α| D^α ∂L/∂(D^α u) is written out, with
total derivatives taken after the fields are put back. Where it isn't the claim's entry at a point, for the functions
that the witness has, the claim is false.
"""

from __future__ import annotations

from typing import Any

if __package__:
    from canon.checker import alone
    from canon.checker.alone import Formula, Stop
    from canon.checker.counterexample import Arithmetic, Open, check, check_domain, fails, somewhere
    from canon.checker.counterexample_formulas import Writer, put, put_names
    from canon.checker.counterexample_functions import More, Place
    from canon.checker.counterexample_maps import plain
else:  # as a program's part, beside the other files
    import alone  # type: ignore
    from alone import Formula, Stop  # type: ignore
    from counterexample import Arithmetic, Open, check, check_domain, fails, somewhere  # type: ignore
    from counterexample_formulas import Writer, put, put_names  # type: ignore
    from counterexample_functions import More, Place  # type: ignore
    from counterexample_maps import plain  # type: ignore

BITS, HIGHEST, SHARED = 128, 4, ("hamiltonian", "transformation", "generating_function")


class Fields:
    """A Lagrangian of fields, which are functions of variables that the claim calls them with."""

    def __init__(self, claim: Any, fields: list[Formula]) -> None:
        self.claim, self.fields, self.write = claim, fields, Writer(claim)
        self.names = dict[tuple[int, tuple[int, ...]], Formula]()  # of a field, and of how often it is differentiated
        self.back = dict[str, Formula]()
        if len({f.kind for f in fields}) < len(fields):
            raise Stop("not shown", "a field that stands twice")
        for f in fields:
            arguments = [x.of[0] for x in f.of if isinstance(x, Formula) and x.kind == "."]
            if "function" not in claim.words.get(f.kind, ()) or len({*arguments}) < len(f.of) or any(f.orders):
                raise Stop("not shown", "fields that aren't functions of names")

    def replaced(self, f: Formula) -> Formula | None:
        """The name that stands for a field, or for a derivative of one. Raises Stop where it is called elsewhere."""
        for k, field in enumerate(self.fields):
            if f.kind == field.kind:
                if [x.of for x in f.of] != [x.of for x in field.of] or any(x.kind != "." for x in f.of):
                    raise Stop("not shown", "a field at another place")
                key = (k, f.orders)
                if key not in self.names:
                    self.names[key] = Formula(".", (f"#{len(self.names)}",))
                    self.back[self.names[key].of[0]] = f
                return self.names[key]
        return None

    def equation(self, lagrangian: Formula, k: int) -> Formula:
        """Σ (−1)^|α| D^α ∂L/∂(D^α u) of the k-th field."""
        found = alone.number(0)
        of_names = put(lagrangian, self.replaced)
        for (j, orders), name in [*self.names.items()]:
            if j != k:
                continue
            if sum(orders) > HIGHEST:
                raise Stop("not shown", "derivatives of so high an order")
            term = put_names(self.write.slope(of_names, name.of[0]), self.back)
            for argument, n in zip(self.fields[k].of, orders, strict=True):
                for _ in range(n):
                    term = self.write.slope(term, argument.of[0])
            sign = alone.number((-1) ** sum(orders))
            found = self.claim.made("+", found, self.claim.made("*", sign, term))
        return found


def refuted(tables: Any, witness: Any, known: Any = None) -> tuple[str, str]:
    """Whether an equation isn't the field's at the witness."""
    said = tables["claim"]
    if said["kind"] != "field_equations" or not isinstance(witness, dict) or {*SHARED} & {*tables}:
        raise Stop("not shown", "a refutation of such a claim")
    if {*said} - {"kind", "L", "fields", "equations"} or len(said["fields"]) != len(said["equations"]):
        raise Stop("not shown", "fields with other keys")
    if {*tables.get("domain", {})} - {"where"}:
        raise Stop("not shown", "fields on a surface")
    claim = More(plain(tables))
    claim.texts |= {f"_e{k}": text for k, text in enumerate(said["equations"])} | {"_L": said["L"]}
    variables = {x.of[0] for text in said["fields"] for x in claim.known(text).of if isinstance(x, Formula)}
    fields = Fields(claim, [claim.known(text) for text in said["fields"]])
    lagrangian, reason = fields.write.written(claim.known("_L")), "that something fails at the witness"
    equations = [fields.equation(lagrangian, k) for k in range(len(fields.fields))]
    for k in range(3):
        point = Place(claim, somewhere(claim, witness, k), Arithmetic(BITS))
        try:
            check_domain(point, {})
            for name in variables:
                check(point.named(name), claim.words.get(name, ()))
            for f in fields.write.under:
                point.at(f)
            for j, found in enumerate(equations):
                a, b = point.at(found), point.text(f"_e{j}")
                if fails(point.real.add(a, (-b[1], -b[0])), ""):
                    return "shown", ""
        except Open as left:
            reason = str(left)
    return "not shown", reason
