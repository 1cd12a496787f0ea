"""Decides, with proofs and counterexamples, whether transformations of classical mechanics are canonical.

The public names below are loaded when they are first used, so `import canon` itself costs nothing.
"""

from importlib import import_module

from canon.homes import HOME_OF
from canon.version import __version__

TYPE_CHECKING = False  # as a checker of types reads it; `typing` would be most of what the import costs
if TYPE_CHECKING:
    from canon.claim import Claim
    from canon.claims.audit_report import AuditFailed, AuditReport
    from canon.claims.certify import DefectBound, certify
    from canon.claims.closure import Closure, closure, closure_of_fields
    from canon.claims.implicit_images import ImplicitImages
    from canon.claims.implicit_map import ImplicitMap
    from canon.claims.invariance import cartan_loop_invariant, loop_invariant, surface_invariant
    from canon.claims.invariance_report import Invariance, NotInvariant
    from canon.claims.many import verify_many
    from canon.claims.separability import Separability, separates, separates_here
    from canon.claims.symplectify import MapRepair, MatrixRepair, symplectify
    from canon.claims.verify import verify
    from canon.domain import (
        Condition,
        Domain,
    )
    from canon.errors import (
        CanonError,
        ClaimFailed,
        InputError,
    )
    from canon.expression import Formula
    from canon.mechanics.algebra.from_matrices import MatrixAlgebra, algebra_of_matrices
    from canon.mechanics.algebra.identify import Identification, identify
    from canon.mechanics.algebra.lie_algebra import LieAlgebra
    from canon.mechanics.algebra.roots import Root, RootSystem, roots_of
    from canon.mechanics.algebra.sums import direct_sum, semidirect_sum
    from canon.mechanics.algebra_statements import algebra, casimir, group, matrix_algebra
    from canon.mechanics.birkhoff import NormalForm, birkhoff_gustavson
    from canon.mechanics.boosts import BoostAndRotation, boost, compose_boosts, split_boost
    from canon.mechanics.central_motion import RadialRegion, effective_potential, radial_regions
    from canon.mechanics.composition import (
        compose,
        extended_by_time,
        identity_transformation,
    )
    from canon.mechanics.conventions import (
        GOLDSTEIN,
        LANDAU_LIFSHITZ,
        SICM,
        Conventions,
    )
    from canon.mechanics.four_tensors import (
        FourTensor,
        doppler,
        field_tensor,
        fields_of,
        four_force,
        four_vector,
        four_velocity,
    )
    from canon.mechanics.generating_function import GeneratingFunction
    from canon.mechanics.hamilton_jacobi import CompleteIntegral
    from canon.mechanics.hamiltonian import Hamiltonian
    from canon.mechanics.inertia import RigidBody, composite, point_masses, polyhedron, principal_moments
    from canon.mechanics.kepler_variables import delaunay_variables, poincare_variables
    from canon.mechanics.lagrangian import Lagrangian
    from canon.mechanics.legendre_conversion import recovered
    from canon.mechanics.lie_series import (
        InfinitesimalTransformation,
        closed_lie_series,
        truncated_lie_series,
    )
    from canon.mechanics.phase_space import PhaseSpace
    from canon.mechanics.picard import picard
    from canon.mechanics.point_transformation import PointTransformation
    from canon.mechanics.poisson import (
        bracket_matrix,
        jacobi_sum,
        lagrange_bracket,
        lagrange_matrix,
        poisson_bracket,
        standard_j,
    )
    from canon.mechanics.separation.actions import separated_actions
    from canon.mechanics.separation.characteristic import characteristic_function
    from canon.mechanics.separation.coordinates import OrthogonalCoordinates, orthogonal_coordinates
    from canon.mechanics.separation.levi_civita import levi_civita
    from canon.mechanics.separation.staeckel import Separation, separation
    from canon.mechanics.statements import (
        action,
        bracket,
        conserved,
        equations_of_motion,
        frequency,
        hamiltonian_field,
        identity,
        independent,
        infinitesimal,
        involution,
        jacobi,
        legendre,
        lie_series,
        normal_form,
    )
    from canon.mechanics.subject import Subject
    from canon.mechanics.transformation import Transformation
    from canon.mechanics.two_body import TwoBodies, two_bodies
    from canon.numeric.actions.bounded import Bounded
    from canon.numeric.actions.central import central_actions
    from canon.numeric.actions.frequency_analysis import Lines, frequency_lines
    from canon.numeric.actions.isochrone import isochrone_actions, isochrone_angle
    from canon.numeric.actions.motion import Motion, motion
    from canon.numeric.actions.orbit import Orbit
    from canon.numeric.actions.pendulum import pendulum_actions, pendulum_angle
    from canon.numeric.actions.separable import staeckel_actions
    from canon.numeric.actions.staeckel_angles import staeckel_angles
    from canon.numeric.actions.staeckel_frequencies import staeckel_frequencies
    from canon.numeric.chains import chain_frequencies
    from canon.numeric.cycloid import Descent, fastest_descent
    from canon.numeric.lie_sum import LieSum, lie_sum, nested_bracket
    from canon.numeric.normal_modes import NormalModes, Williamson, normal_modes, williamson
    from canon.numeric.refraction import LayeredRay, ray_through_layers, reflected, refracted
    from canon.numeric.scattering import Scattering, scattering
    from canon.numeric.values import value_at
    from canon.report.proof.of_claim import Proof, proof
    from canon.scenes.audit import audit
    from canon.verdict import Verdict


__all__ = [
    "GOLDSTEIN",
    "LANDAU_LIFSHITZ",
    "SICM",
    "AuditFailed",
    "AuditReport",
    "BoostAndRotation",
    "Bounded",
    "CanonError",
    "Claim",
    "ClaimFailed",
    "Closure",
    "CompleteIntegral",
    "Condition",
    "Conventions",
    "DefectBound",
    "Descent",
    "Domain",
    "Formula",
    "FourTensor",
    "GeneratingFunction",
    "Hamiltonian",
    "Identification",
    "ImplicitImages",
    "ImplicitMap",
    "InfinitesimalTransformation",
    "InputError",
    "Invariance",
    "Lagrangian",
    "LayeredRay",
    "LieAlgebra",
    "LieSum",
    "Lines",
    "MapRepair",
    "MatrixAlgebra",
    "MatrixRepair",
    "Motion",
    "NormalForm",
    "NormalModes",
    "NotInvariant",
    "Orbit",
    "OrthogonalCoordinates",
    "PhaseSpace",
    "PointTransformation",
    "Proof",
    "RadialRegion",
    "RigidBody",
    "Root",
    "RootSystem",
    "Scattering",
    "Separability",
    "Separation",
    "Subject",
    "Transformation",
    "TwoBodies",
    "Verdict",
    "Williamson",
    "__version__",
    "action",
    "algebra",
    "algebra_of_matrices",
    "audit",
    "birkhoff_gustavson",
    "boost",
    "bracket",
    "bracket_matrix",
    "cartan_loop_invariant",
    "casimir",
    "central_actions",
    "certify",
    "chain_frequencies",
    "characteristic_function",
    "closed_lie_series",
    "closure",
    "closure_of_fields",
    "compose",
    "compose_boosts",
    "composite",
    "conserved",
    "delaunay_variables",
    "direct_sum",
    "doppler",
    "effective_potential",
    "equations_of_motion",
    "extended_by_time",
    "fastest_descent",
    "field_tensor",
    "fields_of",
    "four_force",
    "four_vector",
    "four_velocity",
    "frequency",
    "frequency_lines",
    "group",
    "hamiltonian_field",
    "identify",
    "identity",
    "identity_transformation",
    "independent",
    "infinitesimal",
    "involution",
    "isochrone_actions",
    "isochrone_angle",
    "jacobi",
    "jacobi_sum",
    "lagrange_bracket",
    "lagrange_matrix",
    "legendre",
    "levi_civita",
    "lie_series",
    "lie_sum",
    "loop_invariant",
    "matrix_algebra",
    "motion",
    "nested_bracket",
    "normal_form",
    "normal_modes",
    "orthogonal_coordinates",
    "pendulum_actions",
    "pendulum_angle",
    "picard",
    "poincare_variables",
    "point_masses",
    "poisson_bracket",
    "polyhedron",
    "principal_moments",
    "proof",
    "radial_regions",
    "ray_through_layers",
    "recovered",
    "reflected",
    "refracted",
    "roots_of",
    "scattering",
    "semidirect_sum",
    "separated_actions",
    "separates",
    "separates_here",
    "separation",
    "split_boost",
    "staeckel_actions",
    "staeckel_angles",
    "staeckel_frequencies",
    "standard_j",
    "surface_invariant",
    "symplectify",
    "truncated_lie_series",
    "two_bodies",
    "value_at",
    "verify",
    "verify_many",
    "williamson",
]


def __getattr__(name: str) -> object:
    if name not in HOME_OF:
        raise AttributeError(f"module 'canon' has no attribute {name!r}")
    value = getattr(import_module(HOME_OF[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
