"""Point bodies and rigid bodies in one scene: two systems side by side, as no effect of the format couples them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import sympy as sp

from canon.scenes.model import Formula, Friction, Model


def side_by_side(bodies: Model, rigid: Model) -> Model:
    """The model of both: H is the sum, q and p are the bodies' and then the rigid bodies', the brackets both's own.

    Angular momenta add up by their components about the axes of space.
    """
    own = bodies.brackets or tuple((x, y, sp.S.One) for x, y in zip(bodies.q, bodies.p, strict=True))
    before, after = (sp.S.Zero,) * len(bodies.p), (sp.S.Zero,) * len(rigid.p)
    frictions = [Friction(each.effect, (*each.force, *after)) for each in bodies.frictions]
    frictions += [Friction(each.effect, (*before, *each.force)) for each in rigid.frictions]
    return replace(
        bodies,
        q=(*bodies.q, *rigid.q),
        p=(*bodies.p, *rigid.p),
        terms=(*bodies.terms, *rigid.terms),
        frictions=tuple(frictions),
        angular_momenta=_added(bodies.angular_momenta, rigid.angular_momenta),
        rigid=rigid.rigid,
        casimirs=rigid.casimirs,
        brackets=(*own, *rigid.brackets),
        beside=(bodies, rigid),
    )


def _added(one: Mapping[str, Formula], other: Mapping[str, Formula]) -> dict[str, Formula]:
    """Sums by name; what only one of them has stays. In a plane M is that about its normal."""
    one = {"M_z" if name == "M" else name: M for name, M in one.items()}
    return {name: one.get(name, sp.S.Zero) + other.get(name, sp.S.Zero) for name in {**other, **one}}
