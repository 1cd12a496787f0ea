"""New Hamiltonians with derivatives by new variables beside a map: `python alone_transported.py CERTIFICATE.json …`

The map, given forward, is canonical (`alone_maps.py`). K is its new Hamiltonian, up to a function of time, where the
motion is the one that K says:

    {Q, H} + ∂Q/∂t = ∂K/∂P,  {P, H} + ∂P/∂t = −∂K/∂Q

for each of the new variables: identities of old and new variables, each with its own derivatives (`alone_related.py`).
"""

from __future__ import annotations

import json
from itertools import chain
from typing import Any

if __package__:
    from canon.checker import alone, alone_maps, alone_related, alone_surfaces, alone_values
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_maps  # type: ignore
    import alone_related  # type: ignore
    import alone_surfaces  # type: ignore
    import alone_values  # type: ignore

Stop = alone.Stop
MOST = 4


class Transported(alone_related.Related):
    """An identity whose left side is one of old variables, its right side one of new ones, as independent names."""

    def check_related(self, f: Any) -> None:
        """Nothing: each side has names and derivatives of its own."""

    def check_sides(self) -> None:
        """See that H has no new variables in it and K no old ones, nor derivatives by them or by anything else."""
        for name, own, other in (("_lhs", self.old, self.new), ("_rhs", self.new, self.old)):
            names, by = self.parts_of(name)
            if names & other or by - own - {self.variables[-1]}:
                raise Stop("not shown", "a Hamiltonian of the other variables, or derivatives by them")

    def parts_of(self, text: str) -> tuple[set[str], set[str]]:
        """The names in a text, of what definitions say, and those by which something is differentiated."""
        names, by, left, done = set[str](), set[str](), [self.known(text)], set[str]()
        while left:
            f = left.pop()
            by |= {*f.orders} if f.kind == "D" else set()
            if f.kind == ".":
                names |= {*f.of}
                left += [self.known(self.texts[f.of[0]])] if f.of[0] in {*self.texts} - done else []
                done |= {*f.of}
            left += [g for g in f.of if isinstance(g, alone.Formula)]
        return names, by


def rows(tables: Any) -> list[tuple[str, str]]:
    """What is equal, for each of the new variables."""
    space, H = tables["phase_space"], tables["hamiltonian"]["H"]
    K, time, (q, p) = tables["claim"]["K"], space.get("time", "t"), (space[side] for side in "qp")
    found = list[tuple[str, str]]()
    for side, other, sign in (("Q", "P", ""), ("P", "Q", "-")):
        for text, conjugate in zip(tables["transformation"][side], space[other], strict=True):
            terms = [f"D({text}, {time})"]
            for a, b in zip(q, p, strict=True):
                terms.append(f"D({text}, {a})*D({H}, {b}) - D({text}, {b})*D({H}, {a})")
            found.append((" + ".join(terms), f"{sign}D({K}, {conjugate})"))
    return found


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim itself."""
    tables = json.loads(json.dumps(data["tables"]))
    claim, space = tables["claim"], tables["phase_space"]
    said = {*claim} - {*alone.UNASKED} - {"kind"}
    n = len(space["q"])
    if claim["kind"] != "new_hamiltonian" or said != {"K"} or {*tables["hamiltonian"]} != {"H"}:
        raise Stop("not shown", "no new Hamiltonian")
    if {*tables.get("transformation", {})} != {*"QP"} or "generating_function" in tables:
        raise Stop("not shown", "a map that isn't given forward")
    if (
        [len(space.get(side, [])) for side in "qpQP"] != [n] * 4
        or not 0 < n <= MOST
        or "on" in tables.get("domain", {})
    ):
        raise Stop("not shown", "a map to other variables, or on a surface")
    still = {"tables": {**tables, "claim": {"kind": "canonical"}}, "known": {}, "cases": [{}]}
    if alone_maps.shown(still)[0] != "shown":
        raise Stop("not shown", "that the map is canonical")
    for text in (tables["hamiltonian"]["H"], claim["K"], *chain(*tables["transformation"].values())):
        Transported({**tables, "claim": {"kind": "identity", "lhs": text, "rhs": "0"}})  # each is a formula by itself
    for left, right in rows(tables):
        asked = Transported({**tables, "claim": {"kind": "identity", "lhs": left, "rhs": right}})
        asked.check_sides()
        asked.insist()
        alone_values.shown(asked, alone_surfaces.On)
    return "shown", ""


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
