"""Maps that a generating function alone defines: `python alone_generated.py CERTIFICATE.json …`

Where det ∂²F/∂x∂y isn't 0, x being the old variables in F and y the new ones, F defines a map, and it is canonical. In
x and y its Hamiltonian is K = H + ∂F/∂t, with p = ∂F/∂q and so on in the place of what isn't in F; up to a function of
time. So nothing is solved for. What vanishes and what doesn't are rows of the table (`alone_wider.py`).
"""

from __future__ import annotations

from typing import Any

if __package__:
    from canon.checker import alone, alone_wider
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_wider  # type: ignore

Stop = alone.Stop
KEYS = {"canonical": set[str](), "new_hamiltonian": {"K"}}


def claim_of(tables: Any, reader: Any = alone_wider.Wider) -> Any:
    """What the claim asks for, in the variables of F."""
    claim, space, given = tables["claim"], tables["phase_space"], tables["generating_function"]
    kind, said = claim["kind"], {key: x for key, x in claim.items() if key not in alone.UNASKED}
    n = len(space["q"])
    if kind not in KEYS or {*said} != KEYS[kind] or "transformation" in tables or {*given} != {"type", "F"}:
        raise Stop("not shown", "no map by a generating function alone, or other keys")
    if [len(space.get(side, [])) for side in "qpQP"] != [n] * 4:
        raise Stop("not shown", "a map to fewer variables")
    types = [given["type"]] * n if isinstance(given["type"], int) else given["type"]
    old, new, missing, stands = list[str](), list[str](), list[str](), list[str]()
    for i, one in zip(range(n), types, strict=True):
        sides = alone.TYPES[one]
        for side, names in zip(sides, (old, new), strict=True):
            other, sign = alone.GIVES[side]
            names.append(space[side][i])
            missing.append(space[other][i])
            stands.append(f"{'-' if sign == '+' else ''}D({given['F']}, {space[side][i]})")
    new_claim = {"kind": f"{kind}_generated", "F": given["F"], "old": old, "new": new, "missing": missing}
    rest = {key: x for key, x in tables.items() if key != "generating_function"}
    return reader({**rest, "claim": {**new_claim, "stands": stands, **said}})


def sample(claim: Any, prime: int) -> int:
    point = alone_wider.Placed(claim, prime)
    point.check_domain()
    point.check()
    return len(point.roots)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim itself."""
    return alone.tried(sample, claim_of(data["tables"]))


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
