"""Files to be written where they can't be: refused before any work, or said after it; what was there is kept."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from canon.cli.main import main
from canon.report.whole_file import atomically, written
from tests.hostile.test_faults import CLAIMS, full_disk
from tests.short_scenes import PENDULUM

WRITTEN = {
    "--csv": (["cost", "normal-form", "--order", "3", "--cap", "0.1"], "t.csv", "Lie series"),
    "--plot": (["actions", "pendulum.toml"], "t.svg", "frequency"),
    "--proof": (["verify", "claims.toml"], "t.md", "1 proved, 1 refuted (as expected)"),
}


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "pendulum.toml").write_text(PENDULUM)
    (tmp_path / "claims.toml").write_text(CLAIMS, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("option", ["--csv", "--proof", pytest.param("--plot", marks=pytest.mark.slow)])
def test_a_full_disk_costs_the_file_and_not_what_was_computed(
    option: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    command, name, found = WRITTEN[option]
    (here / name).write_text("what was here before")
    before = sorted(path.name for path in here.iterdir())
    with full_disk(100):
        assert main([*command, option, name]) == 74
    out, err = capsys.readouterr()
    assert found in out
    assert err.startswith(f"canon {command[0]}: {option}")
    assert "can't be written: File too large" in err
    assert (here / name).read_text() == "what was here before"
    assert sorted(path.name for path in here.iterdir()) == before
    assert main([*command, option, name]) == 0
    assert (here / name).read_text() != "what was here before"


def test_what_is_no_place_for_a_file_is_refused_before_any_work(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    os.mkfifo(here / "pipe")
    for option, (command, name, _) in {**WRITTEN, "--certificate": (["verify", "claims.toml"], "t", "")}.items():
        ending = Path(name).suffix
        (here / f"to-pipe{ending}").symlink_to("pipe")
        (here / f"to-device{ending}").symlink_to("/dev/null")
        for target in (f"to-pipe{ending}", f"to-device{ending}", f"a\0b{ending}"):
            assert main([*command, option, target]) == 3, (option, target)
            assert "canon" in capsys.readouterr().err
    assert Path("/dev/null").is_char_device()


def test_a_link_stays_one(here: Path) -> None:
    (here / "target").write_text("before")
    (here / "link").symlink_to("target")
    written("link", "after")
    assert (here / "link").is_symlink()
    assert (here / "target").read_text() == "after"
    with pytest.raises(ZeroDivisionError):
        atomically("link", lambda file: (file.write(b"half"), 1 / 0))
    assert (here / "target").read_text() == "after"


@pytest.mark.parametrize("radius", ["5e-324", "1e-200", "1e200", "1e308"])
def test_a_distance_at_which_doubles_hold_no_energy(radius: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["cost", "normal-form", "--order", "3", "--radius", radius, "--json"]) == 3
    assert "of which doubles keep no digits" in capsys.readouterr().out
