"""More claims about maps: `python alone_maps.py CERTIFICATE.json …`

With the functions of `alone_special.py`. Beside what `alone.py` and its table ask for: canonical up to an order of a
parameter, for fewer new variables than old ones, on a surface, and with a scale that has a sign; volumes and Poincaré's
invariants by Pfaffians of Lagrange's brackets; Cartan's form by a potential; what holds of every canonical map;
complete integrals with the energy as a constant; maps that a generating function alone defines, whatever its parameters
are. Of a certificate nothing is used but such a potential, which is smooth where the claim's own formulas are.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from contextlib import suppress
from itertools import combinations
from typing import Any

if __package__:
    from canon.checker import alone, alone_complex, alone_generated, alone_signs, alone_special, alone_values
    from canon.checker import alone_polynomials as polynomials
else:  # as a program, beside the other files
    import alone  # type: ignore
    import alone_complex  # type: ignore
    import alone_generated  # type: ignore
    import alone_polynomials as polynomials  # type: ignore
    import alone_signs  # type: ignore
    import alone_special  # type: ignore
    import alone_values  # type: ignore

Formula, Stop = alone.Formula, alone.Stop
HIGHEST, MOST_PAIRS, SMOOTH = 6, 3, ("#", ".", "+", "*", "sin", "cos", "exp", "D")
COMPLEX = re.compile(r"\bcomplex\b|(?<![^\W\d_])\d[jJ]\b")
FORWARD = ["i<j: bracket(Q_i, Q_j)", "i<j: bracket(P_i, P_j)", "bracket(Q_i, P_j) - one_ij*scale"]
BACKWARD = ["i<j: bracket(q_i, q_j)", "i<j: bracket(p_i, p_j)", "bracket(q_i, p_j) - one_ij/scale"]
OLD, NEW = "sum_m[p_m*D(q_m, {u})]", "sum_m[P_m*D(Q_m, {u})]"
CARTAN = [f"{OLD} - {NEW} - D(potential, {{u}})".format(u="x_i"),
    f"{OLD} - H - {NEW} + K - D(potential, {{u}})".format(u="t")]  # fmt: skip
KEYS: dict[str, tuple[set[str], set[str]]] = {
    "canonical": (set(), {"scale", "order"}), "fundamental_brackets": (set(), set()),
    "bracket_invariance": ({"f", "g"}, set()), "volume": (set(), set()), "integral_invariant": (set(), {"order"}),
    "cartan_invariant": ({"K"}, set()),
}  # fmt: skip
"""The keys that a claim has, and those that it may have besides."""


def pfaffian(of: str, places: tuple[int, ...]) -> str:
    """The Pfaffian of Lagrange's brackets of these coordinates."""
    if not places:
        return "1"
    first, rest = places[0], places[1:]
    parts = [
        f"({(-1) ** k})*{of}[x_{first}; x_{other}]*({pfaffian(of, rest[:k] + rest[k + 1 :])})"
        for k, other in enumerate(rest)
    ]
    return " + ".join(parts)


class Map(alone_special.Wide):
    """A claim about a map, by rows that are written for it."""

    def take_map(self, tables: Any, held: Any) -> None:
        """The formulas of a map stand for its variables; new ones may be fewer where it is given forward."""
        explicit, n, m = tables["transformation"], len(held["q"]), len(held["Q"])
        forward = {*explicit} == {*"QP"}
        (a, b), (c, d) = ("QP", "qp") if forward else ("qp", "QP")
        written = {*re.findall(r"\w+", json.dumps([*explicit.values()], ensure_ascii=False))}
        odd = {*explicit} not in ({*"QP"}, {*"qp"}) or len(held["p"]) != n or len(held["P"]) != m or not m
        if odd or {*held[a], *held[b]} & written or m > n or (m < n and not (forward and "fewer" in self.form)):
            raise Stop("not shown", "a map to fewer variables, or of others")
        self.texts |= dict(zip(held[a] + held[b], explicit[a] + explicit[b], strict=True))
        self.map_names = held[a] + held[b]
        held |= {"X": held[a] + held[b], "x": held[c] + held[d], "pairs": [*zip(held[c], held[d], strict=True)]}

    def check_variables(self, held: Any, said: Any, own: list[str]) -> None:
        """No formula of the map has one of its own variables in it, by way of a definition."""
        super().check_variables(held, said, own)
        itself = {name: Formula(".", (name,)) for name in held["X"]}
        if any(self.inner(self.read(self.texts[name], itself)) & {*held["X"]} for name in held["X"]):
            raise Stop("not shown", "a map that contains what it gives")

    def check_germ(self, tables: Any, held: Any) -> None:
        """The parameter of an order is 0, whatever the file says besides, but for the map."""
        if "germ" in self.form:
            super().check_germ({key: x for key, x in tables.items() if key != "transformation"}, held)
            self.zero = held["parameter"]


class Still(alone_special.Wide):
    """A claim whose functions are 0 everywhere, as functions of general values may be."""

    def built(self, at: Any, text: str, own: Any) -> Any:
        f = super().built(at, text, own)
        return alone.number(0) if self.words.get(f.kind) == ["function"] else f


class Surface(alone_values.Values):
    """A random point of the surface on which g, a polynomial of degree 1 in each name, is 0: solved for one of them."""

    solved = ""

    def check_domain(self) -> None:
        lines = [type(self)(self.claim, self.p) for _ in range(2)]
        for k, line in enumerate(lines):
            line.free, line.fixed = self.free, {self.solved: k}
        low, high = (line.at(self.asked.surface) for line in lines)
        self.fixed = {self.solved: -low * pow(high - low, -1, self.p) % self.p}
        if self.at(self.asked.surface):
            raise Stop("not shown", "a point of the surface")
        super().check_domain()


def rows(claim: Any, n: int, forward: bool) -> Any:
    """What a claim asks for: the form of a row of the table."""
    kind, order = claim["kind"], claim.get("order", 1)
    form: dict[str, Any] = {"map": "either", "absent": {"scale": "1"}, "of": {"surface": "q p"}}
    if kind in ("canonical", "fundamental_brackets", "bracket_invariance"):
        form["zeros"] = FORWARD if forward else BACKWARD
        form["of"] |= {"scale": "", "f g": "Q P t"}
        form |= {"fewer": True} if kind != "bracket_invariance" else {}
        if "order" in claim:
            name, k = order
            if not isinstance(name, str) or type(k) is not int or not 0 <= k < HIGHEST or not forward:
                raise Stop("not shown", "a series to such an order")
            each = [row.rpartition(": ") for row in FORWARD]
            zeros = [f"{a}{b}D({text}, parameter, {j})" for j in range(1, k + 1) for a, b, text in each]
            form |= {"zeros": FORWARD + zeros, "names": "parameter", "germ": "parameter"}
    elif kind == "cartan_invariant":
        form |= {"zeros": CARTAN, "of": {"K": "Q P t", "potential": "x t"}}
    else:
        k = n if kind == "volume" else order
        if type(k) is not int or not 0 < k <= n <= MOST_PAIRS:
            raise Stop("not shown", "an invariant of such an order")
        power = "**2" if kind == "volume" else ""
        form["zeros"] = [
            f"({pfaffian('lagrange', way)}){power} - ({pfaffian('before', way)}){power}"
            for way in combinations(range(2 * n), 2 * k)
        ]
    return form


def claim_of(data: Any) -> Any:
    """The claim, with the form that is written for it."""
    tables = json.loads(json.dumps(data["tables"]))
    kind, space, explicit = tables["claim"]["kind"], tables["phase_space"], tables.get("transformation", {})
    claim = {key: x for key, x in tables["claim"].items() if key not in alone.UNASKED}
    if kind in ("generates", "generating_function"):
        return alone_special.Small(tables)
    if kind == "hamilton_jacobi" and "W" in claim and len(claim["constants"]) == len(space["q"]) - 1:
        claim["constants"] = [*claim["constants"], claim["energy"]]  # the last one
    if kind not in KEYS:
        return alone_special.Wide({**tables, "claim": {"kind": kind, **claim}})
    needed, may = KEYS[kind]
    if not needed <= {*claim} <= needed | may:
        raise Stop("not shown", "other keys")
    form = rows({"kind": kind, **claim}, len(space["q"]), "Q" in explicit)
    if "order" in claim:
        order = claim.pop("order")
        claim |= {"parameter": order[0]} if "germ" in form else {}
    if kind == "cartan_invariant":
        claim["potential"] = str(data["known"].get("potential", "0"))
    if on := tables.get("domain", {}).pop("on", []):
        if kind not in ("canonical", "fundamental_brackets") or len(on) > 1 or "germ" in form or "Q" not in explicit:
            raise Stop("not shown", "such a claim on a surface")
        claim["surface"] = on[0]
    return Map({**tables, "claim": {"kind": kind, **claim}}, form)


def sides(text: str) -> list[str]:
    """What stands in a condition between the signs."""
    return re.split("<=|>=|!=|<|>", text)


def check_scale(made: Any) -> None:
    """See that a scale is 0 nowhere, and made of parameters alone."""
    scale = made.known(made.texts.get("__scale", "1"))
    if any(made.is_function(f.kind) for f in parts(made, scale)):
        raise Stop("not shown", "a scale with a function in it")
    above = alone_special.is_above_everywhere
    if not above(made, scale) and not above(made, made.made("*", alone.number(-1), scale)):
        raise Stop("not shown", "that the scale is 0 nowhere")


def parts(made: Any, f: Any) -> Iterator[Any]:
    """A formula and all that it is made of; a definition is what it says."""
    yield f
    if f.kind == "." and f.of[0] in made.texts:
        yield from parts(made, made.known(made.texts[f.of[0]]))
    for g in f.of:
        if isinstance(g, Formula):
            yield from parts(made, g)


def check_potential(made: Any) -> None:
    """See that a potential is smooth where the formulas are that the claim is about."""
    signs = alone_signs.Signs(made)
    plain = lambda f: Formula(f.kind, f.of, (0,) * len(f.of)) if made.is_function(f.kind) else f
    own = [made.known(name) for name in (*made.map_names, "__K", "__H")]
    own = {signs.structure(plain(g)) for f in own for g in parts(made, f)}
    for f in parts(made, made.known("__potential")):
        whole = f.kind == "^" and f.of[1].kind == "#" and f.of[1].of[0].denominator == 1 and f.of[1].of[0] > 0
        whole = whole or (f.kind == "^" and alone_special.is_above_everywhere(made, f.of[0]))
        if not whole and f.kind not in SMOOTH and signs.structure(plain(f)) not in own:
            raise Stop("not shown", f"that the potential is smooth, for {f.kind[:40]} in it")


def check_surface(made: Any) -> list[str]:
    """The names in the equation of a surface: a polynomial in which each of them stands once at most in a product.

    So each factor is one of degree 1 in some name, for which it is solved: no component of the surface is left out.
    """
    signs = alone_signs.Signs(made)
    signs.put = {}
    whole = all(f.kind in "#.+*^" and not (f.kind == "^" and f.of[1].kind != "#") for f in parts(made, made.surface))
    n, d = signs.quotient(made.surface)
    names = polynomials.names_in(n)
    if not whole or signs.roots or signs.seen or d != polynomials.ONE or any(k > 1 for m in n for _, k in m):
        raise Stop("not shown", "a surface of another form")
    if any({*made.words.get(name, ())} - {"real"} for name in names) or not {*names} & {*made.variables}:
        raise Stop("not shown", "a surface of names with signs")
    return names


def by_phase(claim: Any, _: int) -> int:
    """The number of roots at a random point of a claim with complex names."""
    point = alone_complex.Numbers(claim, alone_complex.random_prime())
    if any(map(point.text, claim.zeros)):
        raise Stop("not shown", "that the determinant is 1, -1, i or -i")
    return len(point.roots)


def generated(tables: Any) -> tuple[str, str]:
    """The answer about a map that a generating function alone defines."""
    claim = {key: x for key, x in tables["claim"].items() if key not in alone.UNASKED}
    kind, keys = tables["claim"]["kind"], {*claim}
    n = len(tables["phase_space"]["q"])
    right = {
        "volume": keys == set(),
        "integral_invariant": keys <= {"order"} and claim.get("order", 1) in range(1, n + 1),
    }
    if right.get(kind):
        claim = {}
    asked = {**tables, "claim": {**claim, "kind": "canonical" if kind in right else kind}}
    general = alone_generated.claim_of(asked, alone_special.Wide)
    with suppress(Stop):
        return alone_values.shown(general)
    general.nonzero = []
    still = {key: x for key, x in asked.items() if key != "hamiltonian"} | {"claim": {"kind": "canonical"}}
    alone_values.shown(alone_generated.claim_of(still, Still))
    return alone_values.shown(general)


def shown(data: Any) -> tuple[str, str]:
    """The answer about the claim itself."""
    tables = data["tables"]
    kind = tables["claim"]["kind"]
    if (
        "generating_function" in tables
        and "transformation" not in tables
        and kind not in ("hamilton_jacobi", "generates")
    ):
        return generated(tables)
    if kind == "volume" and not {*tables["claim"]} - {*alone.UNASKED} and COMPLEX.search(json.dumps(tables)):
        return alone.tried(by_phase, alone_complex.Wide({**tables, "claim": {"kind": "volume_by_phase"}}))
    for bases in (False, True):
        made = claim_of(data)
        made.bases, made.chosen_too, made.ways = bases, bases, [alone_values.Values]
        if kind in ("canonical", "fundamental_brackets"):
            check_scale(made)
        if kind == "cartan_invariant":
            check_potential(made)
        if "__surface" in getattr(made, "texts", {}):
            made.surface, made.signs, made.put = made.known("__surface"), None, {}
            made.ways = [type("Solved", (Surface,), {"solved": name}) for name in check_surface(made)]
        try:
            answers = [alone_values.shown(made, way) for way in made.ways]
            return answers[0]
        except Stop:
            if bases:
                raise
    return "not shown", "no answer"


def checked(data: Any) -> tuple[str, str]:
    """(answer, reason) for a certificate as JSON."""
    return alone.answered(data, shown)


if __name__ == "__main__":
    alone.main(checked)
