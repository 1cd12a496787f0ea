"""Workers: a claim that hangs, dies or devours memory costs its own answer only."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

STAND_IN = Path(__file__).with_name("stand_in.py")


def start(*arguments: object) -> subprocess.Popen[str]:
    command = [sys.executable, str(STAND_IN), "verify", *map(str, arguments)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def answer(*arguments: object) -> tuple[int, dict]:
    process = start("--json", *arguments)
    out, err = process.communicate(timeout=60)
    assert err == ""
    return process.returncode, json.loads(out)


@pytest.fixture(scope="module")
def mixed(tmp_path_factory: pytest.TempPathFactory) -> tuple[int, dict]:
    file = tmp_path_factory.mktemp("claims") / "mixed.toml"
    file.write_text("fine false !false hang@0.2 die devour ill flaw chatter fine")
    return answer(file, "--budget", "60", "--jobs", "2")


def test_every_claim_has_its_answer_in_order(mixed: tuple[int, dict]) -> None:
    status, record = mixed
    verdicts = [(claim["index"], claim["kind"], claim["verdict"]) for claim in record["claims"]]
    assert verdicts == [
        (0, "fine", "proved"),
        (1, "false", "refuted"),
        (2, "false", "refuted"),
        (3, "hang", "undecided"),
        (4, "die", "undecided"),
        (5, "devour", "undecided"),
        (7, "flaw", "undecided"),
        (8, "chatter", "proved"),
        (9, "fine", "proved"),
    ]
    assert status == 3
    assert record["summary"] == {"proved": 3, "refuted": 2, "supported": 0, "undecided": 4, "errors": 1}


@pytest.mark.parametrize(
    ("index", "note"),
    [
        (3, "stopped: still busy well past its budget of 0.2 s"),
        (4, "stopped: its worker process was ended by SIGABRT (out of memory, most likely)"),
        (5, "stopped: out of memory"),
        (7, "stopped by an internal error, ZeroDivisionError: division by zero (stand_in.py, line "),
    ],
)
def test_what_was_cut_short_says_why(mixed: tuple[int, dict], index: int, note: str) -> None:
    (claim,) = [claim for claim in mixed[1]["claims"] if claim["index"] == index]
    assert claim["detail"]["note"].startswith(note)


def test_an_ill_posed_claim_is_an_error_with_its_place(mixed: tuple[int, dict]) -> None:
    (error,) = mixed[1]["errors"]
    assert error["file"].endswith("mixed.toml")
    assert (error["where"], error["message"]) == ("claim 4", "the domain seems empty")


def test_a_claim_that_hangs_is_stopped_soon_after_its_budget(mixed: tuple[int, dict]) -> None:
    (claim,) = [claim for claim in mixed[1]["claims"] if claim["kind"] == "hang"]
    assert 0.2 < claim["seconds"] < 30


def test_a_claims_own_budget_wins_and_settings_arrive(tmp_path: Path) -> None:
    file = tmp_path / "settings.toml"
    file.write_text("settings settings@2.5")
    _, record = answer(file, "--budget", "7", "--seed", "11", "--method", "all", "--jobs", "1")
    first, second = (claim["detail"] for claim in record["claims"])
    assert (first["budget"], first["seed"], first["method"]) == (7, 11, "all")
    assert second["budget"] == 2.5
    assert first["process"] == second["process"]  # one worker serves many claims


@pytest.mark.parametrize(
    ("kinds", "status"),
    [
        ("fine !false", 0),
        ("fine false", 1),
        ("false flaw", 1),
        ("!fine", 1),
        ("fine flaw", 2),
        ("!flaw", 2),
        ("false flaw ill", 3),
    ],
)
def test_exit_status(tmp_path: Path, kinds: str, status: int) -> None:
    file = tmp_path / "claims.toml"
    file.write_text(kinds)
    assert answer(file)[0] == status


def test_a_contradiction_is_shown_and_never_expected(tmp_path: Path) -> None:
    file = tmp_path / "contradiction.toml"
    file.write_text("fine contradict")
    status, record = answer(file)
    assert status == 2
    assert record["claims"][1]["expected"] is False
    assert "contradict" in record["claims"][1]["detail"]["alarm"]
    process = start(file)
    shown, _ = process.communicate(timeout=60)
    assert process.returncode == 2
    assert "alarm: a proof and a certified counterexample contradict each other" in shown


@pytest.mark.usefixtures("hangups_heard")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP], ids=lambda n: n.name)
def test_an_interruption_keeps_what_is_known_and_leaves_no_process(tmp_path: Path, number: signal.Signals) -> None:
    file = tmp_path / "claims.toml"
    file.write_text("fine hang")
    process = start(file, "--budget", "50", "--jobs", "1")
    assert process.stdout is not None
    first = process.stdout.readline()
    assert first.startswith("✓ proved")
    pressed = time.monotonic()
    process.send_signal(number)
    out, err = process.communicate(timeout=60)
    assert time.monotonic() - pressed < 20  # half a second, when the machine has nothing else to do
    assert process.returncode == 130
    assert err == ""
    assert "1 claim in 1 file: 1 proved, 1 not checked (interrupted) in" in out


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc")
def test_workers_end_when_their_parent_is_killed(tmp_path: Path) -> None:
    file = tmp_path / "claims.toml"
    file.write_text("settings settings nap nap")
    process = start(file, "--jobs", "2")
    assert process.stdout is not None
    process.stdout.readline()
    process.kill()
    process.communicate(timeout=20)
    deadline = time.monotonic() + 60
    while _running(str(file)) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not _running(str(file))


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc")
def test_a_worker_whose_parent_is_killed_ends_though_it_is_busy(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In the middle of a call that doesn't return: by an alarm that the system rings."""
    file = tmp_path / "claims.toml"
    file.write_text("fine sleep")
    mark = tmp_path / "asleep"
    monkeypatch.setenv("ASLEEP", str(mark))
    process = start(file, "--jobs", "1", "--budget", "0.1")
    deadline = time.monotonic() + 60
    while not mark.exists() and time.monotonic() < deadline:
        time.sleep(0.01)
    assert set(_running(str(file))) > {str(process.pid)}
    process.kill()
    process.communicate(timeout=20)
    deadline = time.monotonic() + 60
    while _running(str(file)) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not _running(str(file))


def _running(word: str) -> list[str]:
    found = []
    for process in os.listdir("/proc"):
        if process.isdigit():
            try:
                command = Path("/proc", process, "cmdline").read_bytes().decode()
            except OSError:
                continue
            if word in command:
                found.append(process)
    return found


def test_what_a_killed_worker_had_is_asked_again(tmp_path: Path) -> None:
    """Whoever killed it, as a system short of memory, may not have meant the claim."""
    file, kept = tmp_path / "claims.toml", tmp_path / "journal"
    file.write_text("fine victim fine die")
    command = [sys.executable, str(STAND_IN), "verify", "--json", str(file), "--jobs", "1", "--resume", str(kept)]
    surroundings = {**os.environ, "MARK": str(tmp_path / "mark")}
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, env=surroundings, timeout=60)
    verdicts = [claim["verdict"] for claim in json.loads(done.stdout)["claims"]]
    assert verdicts == ["proved", "proved", "proved", "undecided"]
    assert kept.read_bytes().count(b"\n") == 3  # nobody has answered the last: another run asks again


@pytest.mark.skipif(not hasattr(signal, "SIGCONT"), reason="needs SIGSTOP and SIGCONT")
def test_what_lost_its_time_while_the_run_was_stopped_is_asked_again(tmp_path: Path) -> None:
    file, mark, gate = tmp_path / "claims.toml", tmp_path / "mark", tmp_path / "gate"
    file.write_text("late fine")
    command = [sys.executable, str(STAND_IN), "verify", "--json", str(file), "--jobs", "1", "--budget", "60"]
    surroundings = {**os.environ, "MARK": str(mark), "GATE": str(gate)}
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=surroundings)
    deadline = time.monotonic() + 60
    while not mark.exists() and time.monotonic() < deadline:
        time.sleep(0.01)
    process.send_signal(signal.SIGSTOP)
    process.send_signal(signal.SIGCONT)
    time.sleep(0.2)
    gate.touch()
    out, _ = process.communicate(timeout=60)
    assert [claim["verdict"] for claim in json.loads(out)["claims"]] == ["proved", "proved"]
