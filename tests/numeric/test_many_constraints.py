"""Many constraints, in arrays: the same motion as written out one by one, by a program that does not grow with them."""

from typing import Any

import numpy as np
import pytest
import sympy as sp

from canon.numeric import constrained_formula
from canon.numeric.constrained_formula import constrained
from canon.numeric.integrators import multipliers
from canon.numeric.integrators.constrained import Drag, Held, gradients, onto_surface, reactions
from canon.numeric.integrators.rattle import RATTLE
from canon.numeric.precision import double
from canon.numeric.similar_formulas import similar_formulas

t = sp.Symbol("t", real=True)


def chain(links: int, *, moving: bool = False, mixed: bool = False, drag: Drag | None = None) -> Held:
    """A chain of rods from the origin, or from a point that is moved, `mixed`: not T(p) + V(q)."""
    x, y = (sp.symbols(f"{name}0:{links}", real=True) for name in "xy")
    p = sp.symbols(f"p0:{2 * links}", real=True)
    q = [place for pair in zip(x, y, strict=True) for place in pair]
    ends = [(sp.sin(t) / 10 if moving else sp.S.Zero, sp.S.Zero), *zip(x, y, strict=True)]
    rods = [((a - c) ** 2 + (b - d) ** 2 - 1) / 2 for (a, b), (c, d) in zip(ends[1:], ends[:-1], strict=True)]
    masses = [1.0 + 0.5 * (k // 2) for k in range(2 * links)]
    H = sp.Add(*(v**2 / (2 * m) for v, m in zip(p, masses, strict=True))) + 10 * sp.Add(*y)
    if mixed:
        H = H + sp.Add(*(v**2 * place**2 for v, place in zip(p, q, strict=True))) / 10
    return constrained(masses, H, rods, q, p, t, drag)


def state(links: int) -> tuple[np.ndarray, np.ndarray]:
    """Stretched out, and turning about the origin."""
    q = np.array([place for k in range(links) for place in (0.8 * (k + 1), -0.6 * (k + 1))])
    p = np.array([(0.1 + 0.05 * (k // 2)) * (k // 2 + 1) * (0.6, 0.8)[k % 2] for k in range(2 * links)])
    return q, p


@pytest.fixture(params=["few", "many"])
def written(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    few = 99 if request.param == "few" else 0
    monkeypatch.setattr(multipliers, "FEW", few)
    monkeypatch.setattr(constrained_formula, "FEW", few)
    return request.param


SEEN: dict[str, dict[str, np.ndarray]] = {}
DRAG = Drag(tuple(tuple(0.3 if i == j else 0.1 / (1 + abs(i - j)) for j in range(6)) for i in range(6)))
CASES: dict[str, dict[str, Any]] = {
    "moving and slowed": {"moving": True, "drag": DRAG}, "mixed": {"mixed": True},
}  # fmt: skip


def everything(problem: Held, q: Any, p: Any) -> np.ndarray:
    """A step from what is nearest on the surface, the reactions there, and gradients for two orbits at once."""
    import jax
    import jax.numpy as jnp

    def of(q: Any, p: Any) -> Any:
        q, p = onto_surface(problem, q, p, 0.1)
        both = jnp.stack([q, 1.01 * q], axis=-1)
        values, rows, rates = gradients(problem, both, 0.1)
        after = RATTLE.build(problem)((q, p), 0.1, 0.01)
        found = [*after, *reactions(problem, q, p, 0.1), *values, *rows, *rates]
        return jnp.concatenate([jnp.ravel(part) for part in found])

    with double():
        return np.asarray(jax.jit(of)(q, p))


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_arrays_make_the_same_motion(case: str, written: str) -> None:
    SEEN.setdefault(case, {})[written] = everything(chain(3, **CASES[case]), *state(3))
    few, many = SEEN[case].get("few"), SEEN[case].get("many")
    if few is not None and many is not None:
        assert np.allclose(many, few, rtol=1e-11, atol=1e-12)


def test_two_equations_that_do_not_act_are_left_out() -> None:
    random = np.random.default_rng(1)
    A = random.standard_normal((4, 4, 3))
    A = np.einsum("ikn,jkn->ijn", A, A)
    b, active = random.standard_normal((4, 3)), np.array([1.0, 0.0, 1.0, 0.0])
    with double():
        import jax.numpy as jnp

        many = np.asarray(multipliers.solve_active(active, jnp.asarray(A), jnp.asarray(b)))
        whole = np.asarray(multipliers.solve_active(None, jnp.asarray(A), jnp.asarray(b)))
    few = multipliers.solve_active(active, [[*row] for row in A], [*b])
    assert np.allclose(many, np.stack(few), rtol=1e-11, atol=1e-12)
    assert np.all(many[1::2] == 0)
    for k in range(3):
        assert np.allclose(many[::2, k], np.linalg.solve(A[::2, ::2, k], b[::2, k]), rtol=1e-11)
        assert np.allclose(A[:, :, k] @ whole[:, k], b[:, k], rtol=1e-11, atol=1e-12)


def test_similar_formulas_keep_their_places_and_numbers() -> None:
    a, b, c, d = q = sp.symbols("a b c d", real=True)
    formulas = [a**2 - 3, c - d + t, sp.sin(b) + sp.Rational(1, 4), a - b, b**2 + 1, d - c, sp.S(7), sp.sin(d), t * c]
    values = similar_formulas(formulas, q, t)
    at, now = np.array([0.3, -1.2, 2.0, 0.7]), 0.4
    expected = [float(f.subs(dict(zip(q, at, strict=True))).subs(t, now)) for f in formulas]
    with double():
        import jax.numpy as jnp

        assert np.allclose(values(jnp.asarray(at), now), expected, rtol=1e-14)
        both = np.asarray(values(jnp.asarray(np.stack([2 * at, at], axis=1)), now))
    assert both.shape == (9, 2)
    assert np.allclose(both[:, 1], expected, rtol=1e-14)


def equations(program: Any) -> int:
    """The operations of a traced program, those of its loops included."""
    inner = (part for eqn in program.eqns for part in eqn.params.values())
    return len(program.eqns) + sum(
        equations(getattr(part, "jaxpr", part)) for part in inner if hasattr(getattr(part, "jaxpr", part), "eqns")
    )


def test_the_program_of_a_chain_does_not_grow_with_its_rods() -> None:
    """Of the rods: the force has its own slope for every coordinate, as it is written."""
    import jax

    sizes = []
    for links in (8, 24):
        problem = chain(links)
        with double():
            sizes.append(equations(jax.make_jaxpr(lambda q, f=problem: gradients(f, q, 0.0))(state(links)[0]).jaxpr))
    assert sizes[0] == sizes[1] < 200
