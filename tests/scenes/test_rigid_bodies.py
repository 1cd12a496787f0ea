"""Rigid bodies: free tops against closed forms, tops under torques against other descriptions of the same motion."""

from dataclasses import replace
from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest

from canon.errors import InputError
from canon.numeric.integrate import integrate
from canon.numeric.integrators.problem import Shear, Splitting
from canon.numeric.integrators.rigid_body import rotation_part
from canon.numeric.integrators.yoshida import VERLET
from canon.numeric.operations import operations_per_step
from canon.numeric.precision import double
from canon.numeric.rotations import rotate
from canon.scenes.examples import scene_text
from canon.scenes.monitors import Reading, read_monitors
from canon.scenes.monitors.flow import Flow
from canon.scenes.problem import problem_of
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import Result, simulate
from canon.scenes.states import named_states, own_states
from canon.scenes.systems import load_system

TOP = """
[[rigid_body]]
name = "top"
moments = [1.0, 1.0, 0.5]
euler = [0.1, 0.7, 0.3]
angular_velocity = [0.3, 0.2, 8.0]
[run]
duration = 4.0
samples = 21
"""
GRAVITY = '[[effect]]\nkind = "gravity_torque"\nm = 2.0\ng = 9.81\nl = 0.3\n'
TORQUE = '[[effect]]\nkind = "torque"\nK = ["cos(t)/10", 0, 0.1]\nframe = "space"\n'
ALL = ("energy", "angular_momentum", "casimir", "symplecticity", "volume", "cartan")


def run(text: str, monitors: tuple[str, ...] = ()) -> tuple[Result, dict[str, Reading]]:
    scene = read_scene_text(text)
    result = simulate(replace(scene, settings=replace(scene.settings, monitors=monitors)))
    assert result.ok, result.messages
    return result, {reading.name: reading for reading in result.monitors}


def test_the_free_symmetric_top() -> None:
    """ex-12.4: ω_1 + iω_2 turns at Ω = ω_3 (I_3 − I_1)/I_1; the axis precesses about M at M/I_1."""
    result, found = run(TOP, ALL[:3])
    assert result.problem.exact
    states = named_states(result)
    omega, M, R = (states[name]["top"] for name in ("angular_velocity", "angular_momentum", "rotation"))
    turn = np.exp(1j * 8.0 * (0.5 - 1.0) / 1.0 * result.times)
    assert np.allclose(omega[:, 0] + 1j * omega[:, 1], (0.3 + 0.2j) * turn, atol=1e-13)
    assert np.allclose(R @ np.swapaxes(R, 1, 2), np.eye(3), atol=2e-15)
    assert np.allclose(np.einsum("kij,kj->ki", R, omega * [1.0, 1.0, 0.5]), M, atol=1e-14)
    size = np.linalg.norm(M[0])
    along = M[0] / size
    axis = R[:, :, 2]
    across = axis - (axis @ along)[:, None] * along
    other = np.cross(along, across[0])
    angle = np.unwrap(np.arctan2(across @ other, across @ across[0]))
    assert np.allclose(angle, size / 1.0 * result.times, atol=1e-12)
    assert {reading.expected for reading in found.values()} == {"conserved"}
    assert all(reading.bound is not None and reading.max_drift <= reading.bound < 1e-6 for reading in found.values())


def test_the_separatrix_of_the_asymmetric_top() -> None:
    """sec-12.3.1-c: M² = 2 E I_2, ω_2 = W tanh gt, the others as sech; the state is M and nothing else."""
    I1, I2, I3, W = 1.0, 2.0, 2.7, 1.3
    g = W * np.sqrt((I2 - I1) * (I3 - I2) / (I1 * I3))
    first, last = (
        I1 * W * np.sqrt(I2 * (I3 - I2) / (I1 * (I3 - I1))),
        I3 * W * np.sqrt(I2 * (I2 - I1) / (I3 * (I3 - I1))),
    )
    text = scene_text(load_system("asymmetric_top")).replace("[0.3, 2.4, -0.5]", str([float(first), 0.0, float(last)]))
    result, _ = run(text.replace("duration = 20.0", "duration = 10.0"), ("energy", "casimir", "volume"))
    assert (result.q.shape, result.p.shape) == ((200, 0), (200, 3))
    M = own_states(result)["M"]
    sech = 1 / np.cosh(g * result.times)
    expected = np.column_stack([first * sech, I2 * W * np.tanh(g * result.times), last * sech])
    # an error in M grows as exp gt on the separatrix
    assert np.abs(M - expected).max() < 1e-15 * np.exp(10 * g) * 10


@pytest.mark.slow
def test_the_attitude_of_an_asymmetric_top() -> None:
    """The elliptic functions agree with three rotations in small steps."""
    text = TOP.replace("[1.0, 1.0, 0.5]", "[1.0, 2.0, 2.7]").replace("8.0]", "-0.5]")
    exact, found = run(text, ("symplecticity", "angular_momentum"))
    assert exact.problem.exact
    assert {reading.expected for reading in found.values()} == {"conserved"}
    nothing = '[[effect]]\nkind = "torque"\nK = ["t*0 + 1e-300", 0, 0]\n'
    split, _ = run(text + nothing)
    assert not split.problem.exact
    assert np.abs(exact.q - split.q).max() < 1e-9
    assert np.abs(exact.p - split.p).max() < 1e-9


@pytest.mark.slow
def test_the_heavy_top_in_euler_angles() -> None:
    """sec-12.3.2-e: the same motion as the system in (θ, φ, ψ), M_3 is kept, and so are M_z and the bracket."""
    result, found = run(TOP + GRAVITY, ALL)
    assert found["angular_momentum"].expected == found["casimir"].expected == "broken by gravity_torque"
    assert {found[name].expected for name in {*ALL} - {"angular_momentum", "casimir"}} == {"conserved"}
    assert found["symplecticity"].max_drift < 1e-11
    states = named_states(result)
    R, M = states["rotation"]["top"], states["angular_momentum"]["top"]
    assert np.allclose(M[:, 2], M[0, 2], atol=1e-12)
    assert np.allclose(result.p[:, 2], 4.0, atol=1e-13)
    theta, psi = 0.7, 0.3
    rate = 0.3 * np.cos(psi) - 0.2 * np.sin(psi)
    angles = scene_text(load_system("heavy_symmetric_top"))
    lines = [
        f"parameters = {{ I1 = 1.0, I3 = 0.5, m = 2.0, g = 9.81, l = 0.3 }}\nq = [{theta}, 0.1, {psi}]",
        f"p = [{float(rate)!r}, {float(M[0, 2])!r}, 4.0]\n[run]\nduration = 4.0\nsamples = 21\n",
    ]
    other, _ = run(angles[: angles.index("parameters")] + "\n".join(lines))
    assert np.allclose(R[:, 2, 2], np.cos(other.q[:, 0]), atol=1e-8)
    node = np.column_stack([np.sin(other.q[:, 0]) * f(other.q[:, 1]) for f in (np.sin, np.cos)]) * [1, -1]
    assert np.allclose(R[:, :2, 2], node, atol=1e-8)


@pytest.mark.slow
def test_torques() -> None:
    """dM/dt = K in space; a body that is turned about an axis of its own speeds up as K t/I."""
    result, found = run(TOP + TORQUE, ("energy", "angular_momentum", "casimir", "volume", "symplecticity"))
    M = named_states(result)["angular_momentum"]["top"]
    gained = np.column_stack([np.sin(result.times) / 10, 0 * result.times, result.times / 10])
    assert np.allclose(M - M[0], gained, atol=1e-9)
    assert found.pop("volume").expected == "conserved"
    assert {reading.expected for reading in found.values()} == {"broken by torque"}
    assert found["symplecticity"].final > 1e-3
    spun = scene_text(load_system("asymmetric_top")).replace("[0.3, 2.4, -0.5]", "[0, 0, 0]")
    result, _ = run(spun + '[[effect]]\nkind = "torque"\nK = 0.25\n')
    assert np.allclose(result.p, np.outer(0.25 * result.times, [0, 0, 1]), atol=1e-12)


@pytest.mark.slow
def test_a_torque_without_a_potential_raises_the_alarm() -> None:
    """The model says gravity, the steps have a little more of one component: bracket, energy and loops see it."""
    scene = read_scene_text(TOP + GRAVITY)
    free, kick = problem_of(scene.model).value.parts
    assert isinstance(kick, Shear)

    def rate(state: Any, t: Any) -> tuple[Any]:
        (K,) = kick.rate(state, t)
        return (jnp.stack([K[0], 1.001 * K[1], K[2]]),)

    problem = Splitting((free, Shear((1,), rate, "torque")), None, True)
    start = (np.array(scene.q), np.array(scene.p))
    made = integrate(problem, VERLET, start, duration=4.0, steps=2000, samples=21)
    flow = Flow(scene.model, problem, VERLET, made, made.completed, 1e-9)
    q, p = (np.asarray(slot) for slot in made.states)
    names = ("energy", "symplecticity", "volume")
    found = {reading.name: bool(reading.alarm) for reading in read_monitors(names, flow, made.times, q, p)}
    assert found == {"energy": True, "symplecticity": True, "volume": False}


@pytest.mark.slow
def test_a_method_that_is_asked_for_is_used() -> None:
    """Gauss's keeps the attitude's norm, and the brackets to its error alone: that is no alarm."""
    text = TOP.replace("[1.0, 1.0, 0.5]", "[1.0, 2.0, 2.7]").replace("8.0]", "-0.5]")
    text = text.replace("samples = 21", 'samples = 6\nstep = 0.2\nintegrator = "gauss6"')
    result, found = run(text, ("symplecticity",))
    assert not result.problem.exact
    assert 1e-12 < found["symplecticity"].max_drift <= found["symplecticity"].bound
    assert np.allclose((result.q**2).sum(axis=1), 1, atol=1e-13)


def operations(effects: str, body: str = TOP) -> int:
    scene = read_scene_text(body + effects)
    return operations_per_step(problem_of(scene.model).value, VERLET, (np.array(scene.q), np.array(scene.p)))


def test_only_what_is_called_for() -> None:
    none, gravity, torque = operations(""), operations(GRAVITY), operations(TORQUE)
    assert none < gravity < none + 60
    assert none < torque < none + 90
    assert max(gravity, torque) < operations(GRAVITY + TORQUE) <= gravity + torque - none + 10
    euler = scene_text(load_system("asymmetric_top"))
    assert [len(read_scene_text(euler + more).q) for more in ("", '[[effect]]\nkind = "torque"\nK = 1.0\n')] == [0, 0]
    assert [len(read_scene_text(euler + more).q) for more in (GRAVITY, TORQUE)] == [4, 4]
    asked = euler.replace('"casimir"', '"angular_momentum"')
    assert len(read_scene_text(asked).q) == 4
    assert operations("", euler) < operations("", TOP.replace("[1.0, 1.0, 0.5]", "[1.0, 2.0, 2.7]")) / 5


def test_how_a_body_is_given() -> None:
    """z-x-z Euler angles are passive: the rows of A are the body's axes in space; ω is in the body, M in space."""
    phi, theta, psi = 0.1, 0.7, 0.3

    def about_z(angle: float) -> np.ndarray:
        return np.array([[np.cos(angle), np.sin(angle), 0], [-np.sin(angle), np.cos(angle), 0], [0, 0, 1]])

    about_x = np.array([[1, 0, 0], [0, np.cos(theta), np.sin(theta)], [0, -np.sin(theta), np.cos(theta)]])
    A = about_z(psi) @ about_x @ about_z(phi)
    w, x, y, z = read_scene_text(TOP).q
    R = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    assert np.allclose(R, A.T, atol=1e-15)
    same = TOP.replace("euler = [0.1, 0.7, 0.3]", "attitude = { euler = [0.1, 0.7, 0.3] }")
    assert read_scene_text(same).q == (w, x, y, z)
    doubled = TOP.replace("euler = [0.1, 0.7, 0.3]", f"attitude = [{2 * w}, {2 * x}, {2 * y}, {2 * z}]")
    assert np.allclose(read_scene_text(doubled).q, (w, x, y, z), atol=1e-15)
    L = A.T @ np.array([0.3, 0.2, 4.0])
    in_space = TOP.replace("angular_velocity = [0.3, 0.2, 8.0]", f"angular_momentum = {L.tolist()}")
    assert np.allclose(read_scene_text(in_space).p, [0.3, 0.2, 4.0], atol=1e-14)
    two = read_scene_text(
        TOP + '[[rigid_body]]\nmoments = [1, 2, 2.5]\n[[effect]]\nkind = "torque"\nK = 1\nbodies = ["top"]\n'
    )
    assert (len(two.q), len(two.p)) == (8, 6)
    assert [K != 0 for K in two.model.frictions[0].force] == [False, False, True, False, False, False]


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (TOP.replace("1.0, 1.0, 0.5", "1.0, 1.0, 2.5"), "no principal moments of inertia"),
        (TOP.replace("1.0, 1.0, 0.5", "1.0, 1.0"), "2 components where 3 are expected"),
        (TOP.replace("euler", "attitude"), "a quaternion w, x, y, z is expected"),
        (TOP.replace("euler = [0.1, 0.7, 0.3]", "attitude = [0, 0, 0, 0]"), "the quaternion 0 is no attitude"),
        (TOP.replace("name =", "mass = 1\nname ="), "unknown key 'mass'"),
        (TOP.replace("name =", "angular_momentum = [0, 0, 1]\nname ="), "both 'angular_velocity' and"),
        (TOP.replace("[[rigid_body]]", "[rigid_body]"), "rigid bodies are a list"),
        (TOP + "[system]\nname = 'pendulum'\n", "both [system] and [[rigid_body]] are given"),
        (TOP + '[[effect]]\nkind = "spring"\nk = 1\n', "the effect 'spring' acts on a [[body]]"),
        ("[[body]]\nmass = 1\nposition = [1, 0]\n[run]\nduration = 1\n" + TORQUE, "a rigid body: add [[rigid_body]]"),
        (TOP + TORQUE.replace("space", "lab"), "the frame is 'body' or 'space', not 'lab'"),
        (TOP + TORQUE.replace("cos(t)", "cos(x)"), "unknown name 'x'"),
        (TOP.replace("samples = 21", 'monitor = ["lrl"]'), "the monitor 'lrl' needs"),
        ('dynamics = "relativistic"\n' + TOP, "relativistic dynamics are those of point bodies"),
    ],
)  # fmt: skip
def test_bad_input_is_told_from_good(text: str, says: str) -> None:
    with pytest.raises(InputError) as caught:
        read_scene_text(text)
    assert says in str(caught.value)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_rotation_about_one_axis_turns_as_eulers_equations_say(axis: int) -> None:
    """Ṁ = M × ω with ω along the axis: M in the body turns backwards by ωt, and in space it stays where it is."""
    M, omega = np.array([0.3, -1.2, 0.7]), np.zeros(3)
    omega[axis] = M[axis] / 1.6
    part = rotation_part(axis, 1.6)
    with double():
        q, after = part.flow((np.array([1.0, 0.0, 0.0, 0.0]), M), 1e-6, None)[:2]
        assert np.allclose((after - M) / 1e-6, np.cross(M, omega), atol=1e-5)
        assert np.allclose(np.asarray(q)[1:] / 1e-6, omega / 2, atol=1e-5)
        q, after = part.flow((np.array([1.0, 0.0, 0.0, 0.0]), M), 2.5, None)[:2]
        assert np.allclose(rotate(q, after), M)
