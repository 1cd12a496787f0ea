"""Hostile files end in an input error, soon and in little memory; none of them is believed or run."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import numpy as np
import pytest

from canon.claims.document import BIGGEST
from canon.claims.reader import read_file
from canon.cli.main import main
from canon.errors import InputError
from canon.scenes.reader import read_scene, read_scene_text
from tests.hostile.attacks import FILES, FORMULAS, LARGE
from tests.hostile.measured import DEAR, HEAVY, SCENE, SECONDS, spent, toml, writable

MEMORY = 500_000_000
LATER = [pytest.mark.thorough]
COMMANDS = ["verify", "simulate", *(pytest.param(word, marks=LATER) for word in ("algebra", "actions"))]


@pytest.mark.parametrize("place", ["claim", "scene"])
def test_no_formula_of_the_corpus_is_read(place: str) -> None:
    from canon.claims.reader import read_text

    head = '[phase_space]\nq = ["q"]\np = ["p"]\n[[claim]]\nkind = "casimir"\n'

    def claim(formula: str) -> str:
        (problem,) = read_text(f"{head}f = {toml(formula)}\n").problems
        return problem["message"]

    def scene(formula: str) -> str:
        with pytest.raises(InputError) as caught:
            read_scene_text(SCENE.format(formula=toml(formula)))
        return caught.value.message

    for name, formula in FORMULAS.items():
        if name in HEAVY or (name in DEAR and place == "scene") or not writable(formula) or len(formula) > 20_001:
            continue
        read = claim if place == "claim" else scene
        said: list[str] = []
        assert spent(lambda read=read, formula=formula, said=said: said.append(read(formula))) < SECONDS, name
        assert said[0], name
        assert len(said[0]) < 2000, name


def refused(name: str, data: bytes, path: Path) -> None:
    """Neither a claim file nor a scene: fails unless both readers say so, soon."""
    path.write_bytes(data)
    found = []
    assert spent(lambda: found.append(read_file(path))) < SECONDS, name
    claims, problems = found[0]
    assert problems, name
    assert not claims, name
    assert all(problem["message"] for problem in problems), name
    if len(data) < 100_000:
        with pytest.raises(InputError) as caught:
            read_scene(path)
        assert caught.value.message, name


def test_no_file_of_the_corpus_is_read(tmp_path: Path) -> None:
    for name, data in FILES.items():
        refused(name, data, tmp_path / "file.toml")


@pytest.mark.thorough
@pytest.mark.skipif(sys.platform == "win32", reason="no limit of memory here")
def test_large_files_are_refused_in_little_memory(tmp_path: Path) -> None:
    program = (
        "import resource, sys; from pathlib import Path; from tests.hostile.attacks import FILES, LARGE\n"
        f"from tests.hostile.test_readers import refused\nresource.setrlimit(resource.RLIMIT_AS, ({MEMORY * 4}, -1))\n"
        "for name, data in {**FILES, **LARGE}.items():\n    refused(name, data, Path(sys.argv[1]))\n"
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, str(tmp_path / "file.toml")], capture_output=True, text=True, timeout=300
    )
    assert done.stderr == ""
    assert int(done.stdout) < MEMORY


def test_the_corpus_has_files_of_every_size() -> None:
    sizes = [len(data) for data in {**FILES, **LARGE}.values()]
    assert max(sizes) > 9 * BIGGEST
    assert sum(BIGGEST * 0.8 < size <= BIGGEST for size in sizes) > 20


@pytest.mark.parametrize("command", COMMANDS)
def test_the_commands_say_it_in_a_line(command: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    attacks = {
        "bytes.toml": FILES["Latin-1"],
        "deep.toml": FILES["deep tables"],
        "large.toml": FILES["10 MB of one string"],
        "twice.toml": FILES["key twice"],
        "code.toml": FILES["dunder name"],
    }
    (tmp_path / "loop.toml").symlink_to("loop.toml")
    (tmp_path / "folder.toml").mkdir()
    os.mkfifo(tmp_path / "pipe.toml")
    for name, data in attacks.items():
        (tmp_path / name).write_bytes(data)
    for path in sorted(tmp_path.iterdir()):
        if command == "verify" and path.name == "folder.toml":
            continue  # a folder of claim files, if an empty one
        assert main([command, str(path)]) == 3, path
        out, err = capsys.readouterr()
        assert path.name in out + err
        assert "Traceback" not in out + err
        assert len(err) < 1000


HEADERS = {
    "an array of a terabyte": "{'descr': '<f8', 'fortran_order': False, 'shape': (1000000000000,), }",
    "a negative shape": "{'descr': '<f8', 'fortran_order': False, 'shape': (-1,), }",
    "objects": "{'descr': '|O', 'fortran_order': False, 'shape': (1,), }",
    "code": "{'descr': __import__('os').system('echo gotcha'), 'fortran_order': False, 'shape': (1,), }",
    "parentheses": "{'descr': '<f8', 'fortran_order': False, 'shape': " + "(" * 3000 + ")" * 3000 + ", }",
    "a record of a terabyte": "{'descr': [('a', '<f8', (999, 999, 999999))], 'fortran_order': False, 'shape': (1,), }",
}


@pytest.mark.parametrize("name", HEADERS)
def test_a_run_that_is_an_attack_is_not_gone_on_with(name: str, tmp_path: Path, capfd: pytest.CaptureFixture) -> None:
    from canon.report.states_file import read_arrays

    header = HEADERS[name].encode()
    member = b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header + b"cos\nsystem\n(S'echo gotcha'\ntR."
    with zipfile.ZipFile(tmp_path / "run.npz", "w") as archive:
        archive.writestr("q.npy", member)
    with pytest.raises(InputError, match="damaged"):
        read_arrays(tmp_path / "run.npz")
    assert "gotcha" not in capfd.readouterr().out


def test_a_run_is_read_of_a_file_alone(tmp_path: Path) -> None:
    from canon.report.states_file import read_arrays

    os.mkfifo(tmp_path / "pipe.npz")
    (tmp_path / "loop.npz").symlink_to("loop.npz")
    for name in ("pipe.npz", "loop.npz", "."):
        with pytest.raises(InputError, match="not a regular file"):
            read_arrays(tmp_path / name)


def test_figures_of_a_run_that_are_anything_are_damage() -> None:
    from canon.numeric.progress import Packed, unpack

    figures = {"runs": [], "finished": 0, "trials": [], "agreed": [], "compensated": None}

    def begin(steps: int, compensated: bool):
        raise AssertionError("nothing is begun")

    for key in figures:
        for value in (10**300, -1, "a", 1.5, [1], [{}], [[None]], {"a": 1}):
            with pytest.raises(InputError, match="damaged"):
                unpack(Packed({**figures, key: value}, {"resume_0_carry_0": np.zeros(1)}), begin)


@pytest.mark.parametrize("name", ["../../etc/x", "a\\b", "a\0b", "a\nb", "\u202ea"])
def test_names_of_bodies_name_no_place(name: str) -> None:
    scene = f"[[body]]\nname = {json.dumps(name)}\nmass = 1\nposition = [0, 0]\n[run]\nduration = 1\n"
    with pytest.raises(InputError, match="a name of 1 to 80 characters"):
        read_scene_text(scene)


def test_numbers_beyond_double_precision_are_input_errors(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(SCENE.format(formula='"10**400*q**2 + p**2"'))
    assert main(["simulate", str(path)]) == 3
    assert "beyond double precision" in capsys.readouterr().err


BODY = "[[body]]\nmass = 1\ncharge = 1\nposition = [1, 0, 0]\n[run]\nduration = 1\n[[effect]]\n"
TOO_MANY_TERMS = {
    "an exponent of 308 digits": BODY + 'kind = "power_law"\na = 1\nn = 1e308\n',
    "the same below": BODY + 'kind = "power_law"\na = 1\nn = -1e308\n',
    "a power of a distance": BODY + 'kind = "potential"\nV = "(x**2 + y**2 + z**2)**999"\n',
    "a field": BODY + 'kind = "electric_field"\nE = ["(x + y + z + 1)**999", "0", "0"]\n',
    "the square of its potential": BODY + 'kind = "magnetic_field"\nB = ["0", "0", "(x + 1)**200"]\n',
    "a product": BODY + 'kind = "potential"\nV = "(x + y + z + 1)**50*(x - y + z + 2)**50"\n',
    "a Hamiltonian": SCENE.format(formula='"(q + p + 1)**999"'),
}


@pytest.mark.parametrize("name", TOO_MANY_TERMS)
def test_what_has_too_many_terms_is_not_multiplied_out(name: str) -> None:
    start = time.process_time()
    with pytest.raises(InputError, match="multiplied out it has more than"):
        read_scene_text(TOO_MANY_TERMS[name])
    assert time.process_time() - start < SECONDS
    assert read_scene_text(BODY + 'kind = "potential"\nV = "(x**2 + y**2)**50"\n').model.n == 3


@pytest.mark.parametrize("c", ["0", "-1", "0.0"])
def test_light_has_a_speed(c: str) -> None:
    scene = f'dynamics = "relativistic"\n[constants]\nc = {c}\n{BODY}kind = "uniform_gravity"\ng = 1\n'
    with pytest.raises(InputError, match="the speed of light is above 0"):
        read_scene_text(scene.replace("position = [1, 0, 0]", "position = [1, 0, 0]\nvelocity = [0, 0, 0]"))
    assert read_scene_text(scene.replace(f"c = {c}", "c = 1")).model.n == 3


@pytest.mark.skipif(not Path("/proc/kmsg").exists(), reason="no file of the system's that waits")
def test_files_of_the_system_are_not_waited_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """They look like files, and have nothing to say, or can't be read at their beginning."""
    (tmp_path / "scene.toml").write_text(SCENE.format(formula='"q*p"'), encoding="utf-8")
    claims = tmp_path / "claims.toml"
    claims.write_text("", encoding="utf-8")
    for command in (["simulate"], ["verify"], ["certificate", "check"], ["verify", str(claims), "--resume"]):
        assert main([*command, "/proc/kmsg"]) == 3, command
    capsys.readouterr()
    assert main(["verify", str(claims), "--resume", "/proc/self/mem"]) == 3
    assert "can't be read" in capsys.readouterr().err
