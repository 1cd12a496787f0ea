"""The benchmark set: 53 identities, and 19 near misses of them in which one coefficient is off by a thousandth."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import cases_brackets
import cases_maps
import cases_polynomial
from cases_common import ERROR, Case

MISSED = (
    "c01_poincare_polar", "c10_spherical_inverse", "c23_kepler_AA", "c24_kepler_DD_DM", "c25_angmom_N6",
    "c28_rigid_body", "c31_relativistic_em", "c32_rotating_frame", "c35_toda3", "c38_damped_osc_Kform",
    "c39_two_centre", "c44_delaunay3d", "c46_kovalevskaya", "c47_powers_symbolic", "c50_calogero5_trig",
    "c52_nbody5",
)  # fmt: skip


def _missed(build: Callable[..., Case]) -> Case:
    return build(error=ERROR).missed()


def all_cases() -> dict[str, Callable[[], Case]]:
    """Each case's builder by its name, identities first."""
    built = {**cases_maps.CASES, **cases_polynomial.CASES, **cases_brackets.CASES}
    near = {f"n{name[1:]}_miss": partial(_missed, built[name]) for name in MISSED}
    near["n26_delaunay_miss"] = partial(_missed, built["c26_delaunay_planar"])
    everything = {**built, **near}
    return {name: everything[name] for name in sorted(everything)}
