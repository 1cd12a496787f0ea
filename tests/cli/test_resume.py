"""`canon simulate --resume`: what is interrupted and gone on with has every bit, and no file is trusted."""

import json
from pathlib import Path

import numpy as np
import pytest

from canon.cli import simulate as command
from canon.cli.main import main
from canon.errors import InputError
from canon.numeric import engines
from canon.report.states_file import read_arrays, write_arrays

SCENE = """
[[body]]
name = "ball"
mass = 1.0
position = [1.0, 0.0]
velocity = [0.0, 1.1]
[[effect]]
kind = "inverse_distance"
a = 1.0
[[effect]]
kind = "inverse_square"
c = 0.01
[run]
duration = 30
samples = 31
accuracy = 1e-8
"""


def run(folder: Path, *options: str, text: str = SCENE) -> int:
    (folder / "scene.toml").write_text(text)
    return main(["simulate", str(folder / "scene.toml"), *options])


def test_an_interrupted_run_is_gone_on_with(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    whole, part = tmp_path / "whole.npz", tmp_path / "part.npz"
    assert run(tmp_path, "--out", str(whole)) == 0

    class Stopping(command._watched):
        """Presses Ctrl-C while the run goes on."""

        def __enter__(self):
            looks = iter([None] * 6)

            def watch(done: float) -> None:
                if next(looks, "now") == "now":
                    raise KeyboardInterrupt

            return watch

    with monkeypatch.context() as patched:
        patched.setattr(command, "_watched", Stopping)
        assert run(tmp_path, "--out", str(part)) == 1
    assert "interrupted" in capsys.readouterr().out
    assert run(tmp_path, "--resume", str(part)) == 0
    assert str(part) in capsys.readouterr().out
    one, other = (read_arrays(path) for path in (whole, part))
    assert one.keys() == other.keys() >= {"times", "q", "p", "position_ball", "velocity_ball"}
    assert all(np.array_equal(one[name], other[name]) for name in one if name != "resume")

    assert run(tmp_path, "--resume", str(part), text=SCENE.replace("c = 0.01", "c = 0.02")) == 3
    assert "it is the run of another scene" in capsys.readouterr().err
    assert run(tmp_path, "--resume", str(part), "--accuracy", "1e-6") == 3
    assert "begun with accuracy 1e-08, and this is accuracy 1e-06" in capsys.readouterr().err
    begun, another = ("native", "xla") if engines.installed() else ("xla", "native")
    assert json.loads(str(other["resume"]))["engine"] == begun
    assert run(tmp_path, "--resume", str(part), "--engine", another) == 3
    assert f"begun with the engine {begun}, and this is the engine {another}" in capsys.readouterr().err
    if begun == "native":
        with monkeypatch.context() as patched:
            patched.setattr(engines, "hindrance", lambda: engines.MISSING)
            assert run(tmp_path, "--resume", str(part)) == 3
        assert "begun with the native engine" in capsys.readouterr().err
    write_arrays({**other, "resume": np.array("[")}, part)
    assert run(tmp_path, "--resume", str(part)) == 3
    assert "damaged" in capsys.readouterr().err


def test_files_that_are_none(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "states.npz"

    def refused(says: str) -> None:
        assert run(tmp_path, "--resume", str(path)) == 3
        assert says in capsys.readouterr().err

    refused("there is no such file")
    path.write_text("no archive")
    refused("it is damaged")
    np.savez(path, q=np.array([{"an": "object"}], dtype=object))
    refused("it is damaged")
    np.savez_compressed(path, q=np.zeros(3))
    refused("not a file that `canon simulate --out` wrote")
    write_arrays({"q": np.zeros(3)}, path)
    refused("nothing to go on with")
    path.write_bytes(path.read_bytes()[:-40])
    refused("it is damaged")


def test_members_that_share_their_bytes_are_damage(tmp_path: Path) -> None:
    """Few bytes that would be read as many: the same member, listed twenty times."""
    path = tmp_path / "states.npz"
    write_arrays({"q": np.zeros(1000)}, path)
    data = path.read_bytes()
    end, listed = data.rfind(b"PK\x05\x06"), data.rfind(b"PK\x01\x02")
    entry, tail = data[listed:end], bytearray(data[end:])
    tail[8:12] = (20).to_bytes(2, "little") * 2
    tail[12:16] = (20 * len(entry)).to_bytes(4, "little")
    path.write_bytes(data[:listed] + 20 * entry + bytes(tail))
    with pytest.raises(InputError, match="damaged") as caught:
        read_arrays(path)
    assert str(caught.value.__cause__) == "members that share their bytes"


def test_what_is_larger_than_memory_is_not_read(tmp_path: Path) -> None:
    path = tmp_path / "states.npz"
    with path.open("wb") as file:
        file.truncate(10**13)  # without a block on the disk
    with pytest.raises(InputError, match="more than the memory of this machine"):
        read_arrays(path)


def test_what_is_not_finite_is_null_in_json() -> None:
    """As in the record of a run that is gone on with from an archive that somebody changed."""
    data = {"a": [1.0, float("nan"), (float("-inf"), "x", None)], "b": {"c": float("inf"), "d": 1e308, "e": True}}
    assert command.finite(data) == {"a": [1.0, None, [None, "x", None]], "b": {"c": None, "d": 1e308, "e": True}}
