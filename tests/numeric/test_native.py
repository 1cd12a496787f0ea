"""Native code beside XLA's: the same states but for rounding; and every bit of itself, whatever is run beside it."""

from collections.abc import Callable
from functools import partial
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from canon import InputError
from canon.numeric import engines
from canon.numeric.integrate import Run, advance, integrate, pieces, start
from canon.numeric.integrators import Field, Splitting, clock_part, separable
from canon.numeric.integrators.catalogue import method
from canon.numeric.integrators.gauss import METHODS as GAUSS
from canon.numeric.integrators.problem import Shear
from canon.numeric.integrators.stepper import stepper_of
from canon.numeric.native import compile, engine

pytest.importorskip("llvmlite", reason="the optional extra `native` is not installed")

COUNT = 9


def force(q: Any, t: Any = 0.0) -> Any:
    rates = (-q[0] - 2 * q[0] * q[1], -q[1] - q[0] ** 2 + q[1] ** 2 + 0.002 * t)
    return rates if isinstance(q, tuple) else jnp.stack(rates)


HENON_HEILES = separable(lambda p: p, force)
DRIVEN = separable(lambda p: p, force, time_dependent=True)
RANDOM = np.random.default_rng(5)
MANY = tuple(tuple(row) for row in RANDOM.uniform(-0.2, 0.2, (2, 2, COUNT)))
ONE = tuple(np.array([x[3] for x in slot]) for slot in MANY)


def both(problem: Any, name: str, state: Any, **keywords: Any) -> tuple[Run, Run]:
    """The run by the native engine and by XLA."""
    shared = {"duration": 8.0, "steps": 80, "samples": 5, **keywords}
    runs = [integrate(problem, method(name), state, engine=engine, **shared) for engine in ("native", "xla")]
    assert [run.engine for run in runs] == ["native", "xla"]
    return runs[0], runs[1]


def apart(a: Any, b: Any) -> float:
    pairs = zip(jax.tree.leaves(a), jax.tree.leaves(b), strict=True)
    return max(float(np.max(np.abs(np.asarray(x, float) - np.asarray(y, float)))) for x, y in pairs)


CASES = [
    *(("nystrom6", compensated, orbits) for compensated in (False, True) for orbits in (1, COUNT)),
    ("stormer8", True, 1),
    *(pytest.param(*each, marks=pytest.mark.slow) for each in [("stormer8", True, COUNT), ("stormer12", False, 1)]),
]


@pytest.mark.parametrize(("name", "compensated", "orbits"), CASES)
def test_states_and_carries_are_those_of_xla(name: str, compensated: bool, orbits: int) -> None:
    state = ONE if orbits == 1 else MANY
    mine, other = both(HENON_HEILES, name, state, compensated=compensated, batched=orbits > 1)
    assert apart(mine.stored, other.stored) < 1e-14
    assert mine.completed == other.completed == 5
    assert jax.tree.structure(mine.carry) == jax.tree.structure(other.carry)
    carries = [run.carry if name == "nystrom6" else run.carry._replace(ring=(), place=()) for run in (mine, other)]
    assert apart(*carries) < 1e-12


@pytest.mark.parametrize("orbits", [1, 7, 8, 9, 1000])
def test_each_of_many_orbits_is_the_single_one_bit_for_bit(orbits: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """The lanes that are left over, how many orbits are interleaved, and in how many threads, change nothing."""
    q, p = RANDOM.uniform(-0.2, 0.2, (2, 2, orbits))
    run = partial(integrate, HENON_HEILES, method("nystrom6"), duration=3.0, steps=30, engine="native")
    monkeypatch.setattr(engine, "WORTH_A_THREAD", 1.0)
    found = run(((q[0], q[1]), (p[0], p[1])), batched=True)
    for k in {0, orbits // 2, orbits - 1}:
        alone = run((q[:, k], p[:, k]))
        assert np.array_equal([x[k] for x in found.state[0]], alone.state[0])
        assert np.array_equal([x[k] for x in found.state[1]], alone.state[1])


def test_time_is_that_of_each_step_and_a_clock_of_its_own_is_a_part() -> None:
    mine, other = both(DRIVEN, "yoshida6", MANY, t0=1.5, batched=True)
    assert apart(mine.stored, other.stored) < 1e-13
    timed = Splitting((clock_part(), *DRIVEN.parts), 0, False)
    mine, other = both(timed, "yoshida4", ONE, t0=1.5)
    assert apart(mine.stored, other.stored) < 1e-13


@pytest.mark.parametrize("name", ["yoshida6", "stormer8"])
def test_a_run_in_pieces_has_every_bit(name: str) -> None:
    """Five steps a chunk: a multistep method's place in its history is another one at each chunk."""
    keywords = {"duration": 6.0, "steps": 45, "samples": 10, "compensated": True, "engine": "native"}
    whole = integrate(HENON_HEILES, method(name), ONE, **keywords)
    *_, run = pieces(HENON_HEILES, method(name), start(HENON_HEILES, method(name), ONE, **keywords), chunks=2)
    assert run.engine == whole.engine == "native"
    assert run.completed == whole.completed == 10
    assert apart(run.stored, whole.stored) == apart(run.carry, whole.carry) == 0
    assert advance(HENON_HEILES, method(name), run, chunks=0).done == run.done


def test_it_ends_where_no_orbit_is_finite() -> None:
    blow_up = separable(lambda p: p, lambda q: q**3)
    shared = {"duration": 10.0, "steps": 2000, "samples": 101}
    starts = ((np.array([3.0]), np.array([9.0])), (np.full((1, 9), 3.0), np.full((1, 9), 9.0)))
    for state, batched in zip(starts, (False, True), strict=True):
        mine, other = both(blow_up, "verlet", state, batched=batched, **shared)
        assert (mine.ended, mine.done, mine.completed) == (True, other.done, other.completed)
        assert np.isnan(mine.stored[0][mine.completed :]).all()
        assert np.isfinite(mine.states[0]).all()
        assert np.isfinite(mine.carry[0][0]).all()
    some = (np.array([[3.0, 0.1]]), np.array([[9.0, 0.0]]))
    mine, other = both(blow_up, "verlet", some, batched=True, **shared)
    assert mine.completed == other.completed == 101
    assert apart(mine.state[0][0, 1], other.state[0][0, 1]) < 1e-13


FUNCTIONS: dict[str, Callable[[Any], Any]] = {
    "sines": lambda q: -jnp.sin(q) * jnp.exp(-0.1 * jnp.cos(q)),
    "powers": lambda q: -(q**3) / (1 + q**2) ** 1.5 - q**-2 + jnp.cbrt(q),
    "choices": lambda q: jnp.where(q > 0.2, -q, jnp.maximum(q, 0.1) - jnp.abs(q)) + jnp.minimum(q, 0.0),
    "sums": lambda q: -q + 1e-3 * jnp.sum(q * q) * jnp.cumsum(q) - jnp.floor(q) / jnp.ceil(q + 0.5),
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_of_one_orbit(name: str) -> None:
    problem = separable(lambda p: p, FUNCTIONS[name])
    mine, other = both(problem, "verlet", (np.array([0.7, 0.9]), np.array([0.1, -0.2])), duration=1.0)
    assert apart(mine.stored, other.stored) < 1e-13
    assert apart(mine.state[0], np.array([0.7, 0.9])) > 1e-3


def test_what_is_no_straight_line_is_left_to_xla() -> None:
    implicit = integrate(
        Field(lambda state, t: (state[1], -jnp.sin(state[0]))), GAUSS[0], (np.array([1.0]), np.array([0.3])),
        duration=1.0, steps=10, engine="native",
    )  # fmt: skip
    pendulums = integrate(
        separable(lambda p: p, lambda q: -jnp.sin(q)), method("verlet"), (np.ones((1, 3)), np.ones((1, 3))),
        duration=1.0, steps=10, engine="native", batched=True,
    )  # fmt: skip
    own = np.array([1.0, 2.0, 3.0])
    different = integrate(
        Splitting((Shear((0,), lambda z, t: (z[1],)), Shear((1,), lambda z, t: (-own * z[0],))), None, True),
        method("verlet"), (np.ones((1, 3)), np.ones((1, 3))), duration=1.0, steps=10, engine="native", batched=True,
    )  # fmt: skip
    assert [run.engine for run in (implicit, pendulums, different)] == ["xla"] * 3
    assert len({*different.state[0][0].tolist()}) == 3


def test_orbits_that_are_none_of_their_own_are_left_to_xla() -> None:
    """A force that is made of all orbits, and one that can't be traced for another number of them."""
    q, p = RANDOM.uniform(-0.2, 0.2, (2, 2, 3))
    stacked = lambda q: jnp.stack([-q[0] * jnp.arange(3.0), -q[1]])
    for rate in (lambda q: -(q - jnp.mean(q, axis=-1, keepdims=True)), stacked):
        mine = integrate(separable(lambda p: p, rate), method("verlet"), (q, p), duration=1.0, steps=10, batched=True)
        assert mine.engine == "xla"
        assert np.isfinite(np.asarray(mine.state[0])).all()


def test_an_engine_that_is_not_there(monkeypatch: pytest.MonkeyPatch) -> None:
    shared = {"duration": 1.0, "steps": 10}
    with pytest.raises(InputError, match="no engine 'fast'"):
        integrate(HENON_HEILES, method("verlet"), ONE, engine="fast", **shared)  # type: ignore[arg-type]
    monkeypatch.setattr(engines, "hindrance", lambda: engines.MISSING)
    with pytest.raises(InputError, match=r"canon-mechanics\[native"):
        integrate(HENON_HEILES, method("verlet"), ONE, engine="native", **shared)
    assert integrate(HENON_HEILES, method("verlet"), ONE, engine="auto", **shared).engine == "xla"


@pytest.mark.parametrize(
    ("raised", "says"),
    [
        (ModuleNotFoundError("No module named 'llvmlite'", name="llvmlite"), "is not installed"),
        (ImportError("DLL load failed"), "can't be used \\(ImportError: DLL load failed\\): install"),
        (OSError("libllvmlite.so: cannot open\nshared object"), "can't be used \\(OSError: .* open shared object\\)"),
        (AttributeError("no 'create_pass_builder'"), "can't be used"),
        (RuntimeError("LLVM ERROR"), "can't be used"),
    ],
)
def test_a_library_that_is_broken_is_none(monkeypatch: pytest.MonkeyPatch, raised: Exception, says: str) -> None:
    def broken(*_: object) -> None:
        raise raised

    engines.hindrance.cache_clear()
    monkeypatch.setattr(compile, "optimised", broken)
    try:
        assert (engines.installed(), engines.settled("auto"), engines.settled("xla")) == (False, "xla", "xla")
        with pytest.raises(InputError, match=says):
            engines.settled("native")
    finally:
        monkeypatch.undo()
        engines.hindrance.cache_clear()
    assert engines.installed()


def test_two_blocks_at_least_are_interleaved_where_there_are_orbits_for_them() -> None:
    width = compile.processor().width
    for name in ("verlet", "stormer8"):
        state = (np.zeros((2, 4 * width)), np.zeros((2, 4 * width)))
        carry = stepper_of(method(name), HENON_HEILES, False).initial(state)
        made = engine.native(HENON_HEILES, method(name), False, True, carry)
        assert made is not None
        assert 2 <= made.blocks(1000) <= 4
        assert made.blocks(width) == 1
        assert made.blocks(width + 1) == 2
