"""Times of Lie algebras: from matrices to a name, Casimirs, Kepler's brackets, beside GAP and sympy.liealgebras.

python docs/performance/lie_algebras.py

CPU seconds, each the least of three runs. GAP (`apt install gap-core`) is asked where it is installed: structure
constants of matrices, Jacobi's identities, Levi decomposition, complex type and root system. sympy's liealgebras knows
complex simple types by name: what both have is the Cartan matrix and the roots of a type.
"""

from __future__ import annotations

import random
import shutil
import subprocess
import time
from collections.abc import Callable, Mapping
from typing import Any

import sympy as sp
from sympy.liealgebras.root_system import RootSystem

from canon import PhaseSpace, algebra_of_matrices, closure, identify, verify
from canon.mechanics.algebra.complex_type import ComplexType
from canon.mechanics.algebra.invariants import motion_casimirs, orthogonal_casimirs
from canon.mechanics.algebra.root_system import cartan_matrix, positive_roots
from canon.mechanics.algebra.roots import roots_of
from canon.mechanics.algebra.standard import euclidean, orthogonal, symplectic
from canon.mechanics.formulas import as_formula
from canon.mechanics.subject import Subject


def seconds(work: Callable[[], Any], times: int = 3) -> tuple[float, Any]:
    """The least CPU time of several runs, and what came out."""
    best, value = float("inf"), None
    for _ in range(times):
        start = time.process_time()
        value = work()
        best = min(best, time.process_time() - start)
    return best, value


def identified(matrices: Mapping[str, Any]) -> str:
    """Structure constants with all their Jacobi identities, and the name."""
    return identify(algebra_of_matrices(matrices).algebra).identity.name


def kepler() -> tuple[Any, dict[str, Any]]:
    """The claim that M and D close as so(4) for bound motion, and what closure needs."""
    space = PhaseSpace("x y z", "px py pz", positive="m a", negative="E0")
    r, p = sp.Matrix(space.q), sp.Matrix(space.p)
    m, a, E0 = space.symbols("m a E0")
    H = p.dot(p) / (2 * m) - a / sp.sqrt(r.dot(r))
    M = r.cross(p)
    A = p.cross(M) - m * a * r / sp.sqrt(r.dot(r))
    basis = {f"M{k}": M[k] for k in range(3)} | {f"D{k}": A[k] / sp.sqrt(-2 * m * H) for k in range(3)}
    keys = {"basis": {name: as_formula(f) for name, f in basis.items()}, "equals": "so(4)"}
    claim = Subject(space).claim("algebra", keys)
    return claim, {"space": space, "functions": {"M3": M[2], "A": A[0] + A[2]}, "H": H, "energy": E0}


GAP = """
m := List({matrices}, LieObject);; start := Runtime();;
S := StructureConstantsTable(Basis(LieAlgebra(Rationals, m)));; right := TestJacobi(S);;
L := LieAlgebraByStructureConstants(Rationals, S);; D := LeviMalcevDecomposition(L);;
type := SemiSimpleType(D[1]);; named := Runtime() - start;; start := Runtime();;
R := RootSystem(D[1]);; if R = fail then roots := "no root system";; else roots := "a root system";; fi;
Print(right, " ", type, " (", List(D, Dimension), ") ", named, " ms; ", roots, " ", Runtime() - start, " ms\\n");
"""


def by_gap(matrices: Mapping[str, Any]) -> str:
    """What GAP says of the same matrices, with its own times."""
    rows = [[[str(entry) for entry in row] for row in given] for given in matrices.values()]
    text = str(rows).replace("'", "")
    found = subprocess.run(
        ["gap", "-q", "-b"], input=GAP.format(matrices=text), capture_output=True, text=True, check=True
    )
    return " ".join(found.stdout.replace("\\\n", "").split())


def main() -> None:
    """Print the table."""
    families = {
        "so(8)": orthogonal(8), "so(4,4)": orthogonal(4, 4), "e(3)": euclidean(3), "iso(2,1)": euclidean(2, 1),
        "sp(12,R)": symplectic(6),
    }  # fmt: skip
    for name, matrices in families.items():
        taken, found = seconds(lambda matrices=matrices: identified(matrices), 3 if len(matrices) < 50 else 1)
        assert found == name
        print(f"{name}, {len(matrices)} matrices, verified and identified: {taken:.3f} s")
        if shutil.which("gap"):
            print(f"    GAP: {by_gap(matrices)}")
    plain, rng = algebra_of_matrices(orthogonal(6, 2)).algebra, random.Random(0)
    rows = [[rng.randint(-3, 3) for _ in range(28)] for _ in range(28)]
    made, disguised = seconds(lambda: plain.in_basis(rows), 1)
    taken, found = seconds(lambda: identify(disguised))
    assert found.identity.name == "so(6,2)"
    constants = sum(len(row) for row in disguised.constants.values())
    print(f"so(6,2) in a basis at random, {constants} constants: verified {made:.2f} s, identified {taken:.2f} s")
    for name in ("so(8)", "sp(12,R)"):
        algebra = algebra_of_matrices(families[name]).algebra
        taken, found = seconds(lambda algebra=algebra: roots_of(algebra), 1)
        print(f"{name}: {len(found.roots)} roots with their vectors {taken:.2f} s")
    for name, work in (
        ("so(8): its four Casimirs", lambda: orthogonal_casimirs(orthogonal(8))),
        ("e(5): its three Casimirs", lambda: motion_casimirs(algebra_of_matrices(euclidean(5)).algebra)),
    ):
        taken, found = seconds(work)
        print(f"{name}, {max(len(sp.Add.make_args(f)) for f in found)} terms at most: {taken:.2f} s")
    claim, given = kepler()
    taken, verdict = seconds(lambda: verify(claim))
    assert verdict.status == "proved"
    print(f"Kepler's brackets of M and D, proved, so(4): {taken:.2f} s")
    taken, found = seconds(lambda: closure(**given))
    assert (found.status, found.name) == ("proved", "so(4)")
    print(f"so(4) by closure from H, M3 and A1 + A3: {taken:.2f} s")
    for kind in (ComplexType("B", 6), ComplexType("E", 7)):
        ours, _ = seconds(lambda kind=kind: (cartan_matrix(kind), positive_roots(kind)))
        theirs, system = seconds(lambda kind=kind: _sympy(kind))
        assert len(system) == 2 * len(positive_roots(kind))
        print(f"{kind}: Cartan matrix and roots {1e3 * ours:.1f} ms, sympy.liealgebras {1e3 * theirs:.1f} ms")


def _sympy(kind: ComplexType) -> Any:
    system = RootSystem(str(kind))
    system.cartan_type.cartan_matrix()
    return system.all_roots()


if __name__ == "__main__":
    main()
