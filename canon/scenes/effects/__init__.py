"""The catalogue of effects, one a file: what a scene does not name is not even looked at."""

from __future__ import annotations

from typing import Final

from canon.scenes.effects import (
    accelerated_frame,
    coupling_spring,
    damping,
    driving,
    electric_field,
    gravity_torque,
    inverse_distance,
    inverse_square,
    magnetic_field,
    mutual_gravity,
    potential,
    power_law,
    refractive_index,
    rod,
    rotating_frame,
    scatterer,
    skate,
    spring,
    string,
    surface,
    torque,
    uniform_gravity,
)
from canon.scenes.effects.effect import Effect

EFFECTS: Final[dict[str, Effect]] = {
    module.EFFECT.kind: module.EFFECT
    for module in (
        uniform_gravity,
        mutual_gravity,
        inverse_distance,
        inverse_square,
        power_law,
        potential,
        spring,
        coupling_spring,
        damping,
        driving,
        electric_field,
        magnetic_field,
        rotating_frame,
        accelerated_frame,
        rod,
        string,
        surface,
        refractive_index,
        scatterer,
        skate,
        torque,
        gravity_torque,
    )
}
"""The effects of this version by their kind."""
