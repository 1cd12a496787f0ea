"""The laws of brackets, transformations and generating functions, as data: what must vanish for each.

A law is checked of objects of one's own by `assert_law(law, space, f, g)`, of random ones by `check_laws`; a bracket or
a composition of one's own is checked by `check_laws(bracket_laws(my_bracket))`. The residuals are there for other uses.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import sympy as sp

from canon.claims.verify import verify
from canon.errors import InputError
from canon.expected import instance_of
from canon.mechanics.composition import compose, identity_transformation
from canon.mechanics.generating_function import GeneratingFunction
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.poisson import poisson_bracket
from canon.mechanics.stated_names import as_declared
from canon.mechanics.statements import identity
from canon.mechanics.transformation import Transformation

Bracket = Callable[[sp.Expr, sp.Expr, PhaseSpace], sp.Expr]
Composition = Callable[[Transformation, Transformation], Transformation]


@dataclass(frozen=True)
class Law:
    """A law.

    **Arguments:** its `name`; what it `says`; the kinds of objects that it `takes`, after a phase space; `residuals`,
    a function of the space and these objects, of what must vanish.
    """

    name: str
    says: str
    takes: tuple[str, ...]
    residuals: Callable[..., Iterable[sp.Expr]]

    def __str__(self) -> str:
        return f"{self.name}: {self.says}"


def assert_law(law: Law, space: PhaseSpace, *objects: Any, budget: float = 10.0) -> None:
    """Raise `AssertionError`, with the witness, unless the law is proved (at least supported) of these objects."""
    instance_of(law, Law, "law")
    instance_of(space, PhaseSpace, "space")
    if len(objects) != len(law.takes):
        said = f"the law {law.name!r} takes {', '.join(law.takes) or 'no objects'}, {len(law.takes)} in all"
        raise InputError(f"{said}, not {len(objects)}", "objects")
    residuals = [*law.residuals(space, *objects)]
    if not residuals:
        raise InputError(f"the law {law.name!r} has no residual that could be other than 0", "law")
    for number, residual in enumerate(residuals, 1):
        free: list[Any] = sorted(residual.free_symbols, key=str)
        everywhere = PhaseSpace(
            "z_1", "z_2", time="z_3", **as_declared(free), functions=space.functions, domain=space.domain
        )
        verdict = verify(identity(everywhere, residual, 0), budget=budget)
        if verdict.status not in ("proved", "supported"):
            raise AssertionError(f"{law}\nresidual {number} = {residual}\n{verdict}")


def _difference(one: Transformation, other: Transformation) -> list[sp.Expr]:
    """The components of a difference of two maps in the same direction, in the arguments of the first."""
    renamed = dict(zip(other.arguments, one.arguments, strict=True))
    return [f - g.xreplace(renamed) for f, g in zip(one.expressions, other.expressions, strict=True)]


def _brackets_of_map(space: PhaseSpace, made: Transformation) -> list[sp.Expr]:
    residual = made.symplectic_residual()
    entries: Any = residual
    return [entries[i, j] for i in range(residual.rows) for j in range(i + 1, residual.cols)]


def _there_and_back(space: PhaseSpace, F: GeneratingFunction) -> list[sp.Expr]:
    """F less what F becomes by Legendre transforms to another type and back, up to a constant: its derivatives."""
    turned = {1: 2, 2: 1, 3: 4, 4: 3}
    other = F.converted(tuple(turned[kind] for kind in F.types))
    back = other.converted(F.types)
    return [(back.F.expr - F.F.expr).diff(u) for u in F.mixed]


def bracket_laws(bracket: Bracket = poisson_bracket) -> tuple[Law, ...]:
    """The laws of a bracket(f, g, space): of canon's own, or of one that is to be checked."""

    def cyclic(s: PhaseSpace, f: sp.Expr, g: sp.Expr, h: sp.Expr) -> sp.Expr:
        return bracket(f, bracket(g, h, s), s) + bracket(g, bracket(h, f, s), s) + bracket(h, bracket(f, g, s), s)

    return (
        Law(
            "antisymmetry", "{f, g} = −{g, f}", ("function", "function"),
            lambda s, f, g: [bracket(f, g, s) + bracket(g, f, s)],
        ),
        Law("no self-bracket", "{f, f} = 0", ("function",), lambda s, f: [bracket(f, f, s)]),
        Law(
            "linearity", "{2f + 3g, h} = 2{f, h} + 3{g, h}", ("function", "function", "function"),
            lambda s, f, g, h: [
                bracket(2 * f + 3 * g, h, s) - 2 * bracket(f, h, s) - 3 * bracket(g, h, s)
            ],
        ),
        Law(
            "Leibniz' rule", "{f g, h} = f {g, h} + {f, h} g", ("function", "function", "function"),
            lambda s, f, g, h: [
                bracket(f * g, h, s) - f * bracket(g, h, s) - bracket(f, h, s) * g
            ],
        ),
        Law(
            "Jacobi's identity", "{f, {g, h}} + {g, {h, f}} + {h, {f, g}} = 0", ("function", "function", "function"),
            lambda s, f, g, h: [cyclic(s, f, g, h)],
        ),
        Law(
            "chain rule", "{sin f, g} = cos f {f, g}", ("function", "function"),
            lambda s, f, g: [bracket(sp.sin(f), g, s) - sp.cos(f) * bracket(f, g, s)],
        ),
        Law(
            "fundamental brackets", "{q_i, p_j} = δ_ij, the others vanish", (),
            lambda s: [
                bracket(x, y, s) - s.J[i, j] for i, x in enumerate(s.old) for j, y in enumerate(s.old)
            ],
        ),
    )  # fmt: skip


BRACKET_LAWS = bracket_laws()


def group_laws(compose: Composition = compose) -> tuple[Law, ...]:
    """The laws of a compose(first, second) of transformations: of canon's own, or of one that is to be checked."""
    return (
        Law("canonical", "M J Mᵀ = J", ("map",), _brackets_of_map),
        Law(
            "identity first", "f ∘ 1 = f", ("map",),
            lambda s, f: _difference(compose(identity_transformation(s), f), f),
        ),
        Law(
            "identity last", "1 ∘ f = f", ("map",),
            lambda s, f: _difference(compose(f, identity_transformation(s)), f),
        ),
        Law(
            "associativity", "(h ∘ g) ∘ f = h ∘ (g ∘ f)", ("map", "map", "map"),
            lambda s, f, g, h: _difference(compose(compose(f, g), h), compose(f, compose(g, h))),
        ),
        Law(
            "closure", "g ∘ f is canonical", ("map", "map"),
            lambda s, f, g: _brackets_of_map(s, compose(f, g)),
        ),
        Law(
            "inverse", "the inverse of a canonical map is canonical", ("map",),
            lambda s, f: _brackets_of_map(s, f.inverse()),
        ),
        Law(
            "inverse last", "f⁻¹ ∘ f = 1", ("elementary map",),
            lambda s, f: _difference(compose(f, f.inverse()), identity_transformation(s)),
        ),
        Law(
            "inverse of a product", "f⁻¹ ∘ g⁻¹ is the inverse of g ∘ f", ("factor", "factor"),
            lambda s, f, g: _difference(
                compose(compose(f, g), compose(g.inverse(), f.inverse())), identity_transformation(s)
            ),
        ),
    )  # fmt: skip


GROUP_LAWS = group_laws()

GENERATING_LAWS = (
    Law(
        "symplectic", "D_newᵀ J D_new = D_oldᵀ J D_old", ("generating function",),
        lambda s, F: [*F.symplectic_residual()],
    ),
    Law("there and back", "type k → type l → type k is F again", ("generating function",), _there_and_back),
    Law(
        "inverse", "−F with old and new exchanged is symplectic too", ("generating function",),
        lambda s, F: [*F.inverse().symplectic_residual()],
    ),
)  # fmt: skip
