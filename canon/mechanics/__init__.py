"""The objects of mechanics as immutable values with symbolic methods, one object a file.

Nothing here decides whether an expression is zero: residuals are returned, claims are stated, others judge.
"""

from canon.mechanics.generating_function import GeneratingFunction
from canon.mechanics.phase_space import PhaseSpace
from canon.mechanics.subject import Subject
from canon.mechanics.transformation import Transformation

__all__ = ["GeneratingFunction", "PhaseSpace", "Subject", "Transformation"]
