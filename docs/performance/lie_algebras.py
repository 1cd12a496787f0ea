"""Times of Lie algebras: from matrices to a name, Kepler's brackets, and Cartan types beside sympy.liealgebras.

python docs/performance/lie_algebras.py

CPU seconds of one run, each the least of three. sympy's liealgebras knows complex simple types by name: it has Cartan
matrices, roots and Weyl groups, but takes no matrices, structure constants or real forms, and so identifies nothing.
What both do is set beside each other: the Cartan matrix and the positive roots of a type.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import sympy as sp
from sympy.liealgebras.root_system import RootSystem

from canon import PhaseSpace, algebra_of_matrices, closure, identify, verify
from canon.mechanics.algebra.complex_type import ComplexType
from canon.mechanics.algebra.root_system import cartan_matrix, positive_roots
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


def unit(size: int, *entries: tuple[int, int, int]) -> list[list[Any]]:
    """The matrix with these entries, else 0."""
    found: list[list[Any]] = [[0] * size for _ in range(size)]
    for i, j, value in entries:
        found[i][j] = value
    return found


def orthogonal(n: int) -> dict[str, Any]:
    """Antisymmetric matrices."""
    return {f"L{i}_{j}": unit(n, (i, j, -1), (j, i, 1)) for i in range(n) for j in range(i + 1, n)}


def symplectic(n: int) -> dict[str, Any]:
    """J S for symmetric S, of 2n dimensions."""
    found = {}
    for i in range(n):
        for j in range(n):
            found[f"a{i}_{j}"] = unit(2 * n, (i, j, 1), (n + j, n + i, -1))
            if i <= j:
                found[f"b{i}_{j}"] = unit(2 * n, (i, n + j, 1), (j, n + i, 1))
                found[f"c{i}_{j}"] = unit(2 * n, (n + i, j, 1), (n + j, i, 1))
    return found


def identified(matrices: dict[str, Any]) -> str:
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


def main() -> None:
    """Print the table."""
    for name, matrices in (("so(8)", orthogonal(8)), ("sp(12,R)", symplectic(6))):
        taken, found = seconds(lambda matrices=matrices: identified(matrices), 3 if len(matrices) < 50 else 1)
        assert found == name
        print(f"{name}, {len(matrices)} matrices, verified and identified: {taken:.2f} s")
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
