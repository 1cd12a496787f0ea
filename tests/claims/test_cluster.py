"""Claims on a cluster of Dask: it answers as this process does, and what a worker loses or runs away with is known."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from pathlib import Path

import pytest

from canon.claims.many import LOST, verify_many
from canon.claims.reader import read_text
from canon.cli import cluster
from canon.cli.main import main
from canon.verdict import Verdict
from tests.claims.test_many import brackets


def test_a_cluster_that_is_not_there_is_an_input_error(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "claims.toml"
    file.write_text(brackets(1))
    assert main(["verify", str(file), "--cluster", "nowhere", "--certificate", str(tmp_path)]) == 3
    assert "verdicts alone" in capsys.readouterr().err
    pytest.importorskip("distributed")
    assert main(["verify", str(file), "--cluster", "no://such.place:1"]) == 3
    assert "no scheduler of Dask answers at 'no://such.place:1'" in capsys.readouterr().err


@pytest.mark.filterwarnings("ignore")
def test_a_cluster_without_workers_is_not_waited_for(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    distributed = pytest.importorskip("distributed")
    file = tmp_path / "claims.toml"
    file.write_text(brackets(1))
    monkeypatch.setattr(cluster, "SECONDS", 2)
    with distributed.LocalCluster(
        n_workers=0, processes=False, dashboard_address=None, local_directory=str(tmp_path)
    ) as empty:
        assert main(["verify", str(file), "--cluster", empty.scheduler_address]) == 3
    assert "has no worker, and none has come" in capsys.readouterr().err


class Deserted:
    """As much of a client of Dask's as `Reaching` uses; `workers` are there, or nobody answers, nor any call."""

    status = "running"

    def __init__(self, workers: dict[str, int] | None) -> None:
        self.workers, self.scheduler = workers, self
        self.out: list[Future[object]] = []

    def get_executor(self) -> Deserted:
        return self

    def ncores(self) -> dict[str, int] | None:
        return self.workers

    def sync(self, function: Callable[[], object], callback_timeout: float) -> object:
        if self.workers is None:
            raise TimeoutError
        return function()

    def submit(self, function: object, *arguments: object) -> Future[object]:
        self.out.append(Future())
        return self.out[-1]


@pytest.mark.parametrize("workers", [{}, None])
def test_claims_of_a_cluster_that_is_deserted_or_silent_are_undecided_and_asked_again(
    workers: dict[str, int] | None,
) -> None:
    claims = read_text(brackets(3)).claims
    with cluster.Reaching(Deserted(workers), patience=0.05, glance=0.01) as executor:
        found = dict(verify_many(claims, executor=executor))
    assert sorted(found) == [0, 1, 2]
    for verdict in found.values():
        assert isinstance(verdict, Verdict)
        assert verdict.status == "undecided"
        assert str(verdict.detail["note"]).startswith(LOST)  # which no journal keeps
        assert "has had no worker for" in str(verdict.detail["note"])


def test_a_cluster_with_workers_is_waited_for() -> None:
    client = Deserted({"one": 1})
    with cluster.Reaching(client, patience=0.05, glance=0.01) as executor:
        sent = [executor.submit(print, k) for k in range(3)]
        client.out[0].set_result("answered")
        client.out[1].set_exception(ValueError("it went wrong"))
        assert sent[0].result(30) == "answered"
        assert isinstance(sent[1].exception(30), ValueError)
        assert sent[2].cancel()
        assert client.out[2].cancelled()
        late = executor.submit(print, 3)
        with pytest.raises(TimeoutError):
            late.result(0.5)
        client.workers = {}
        assert isinstance(late.exception(30), RuntimeError)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_a_worker_of_a_cluster_is_killed_and_nothing_lost(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import json

    distributed = pytest.importorskip("distributed")
    file, few, journal = tmp_path / "claims.toml", tmp_path / "few.toml", tmp_path / "journal"
    file.write_text(brackets(400))
    few.write_text(brackets(2))
    written: list[int] = []

    def kill(process: int) -> None:
        while sum(written[-1:]) < 20:  # answers have come, and most have not
            time.sleep(0.01)
            written.append(journal.read_bytes().count(b"\n") if journal.exists() else 0)
        os.kill(process, signal.SIGKILL)

    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, local_directory=str(tmp_path)
    ) as local:
        with distributed.Client(local.scheduler_address, set_as_default=False) as client:
            pids = list(client.run(os.getpid).values())
        killer = threading.Thread(target=kill, args=(pids[0],), daemon=True)
        killer.start()
        command = ["verify", "--json", str(file), "--resume", str(journal)]
        status = main([*command, "--cluster", local.scheduler_address])
        killer.join(30)
        record = json.loads(capsys.readouterr().out)
        command = ["verify", "--json", str(few), "--method", "numeric", "--accuracy", "1e-30"]
        assert main([*command, "--cluster", local.scheduler_address]) == 0
        bounded = json.loads(capsys.readouterr().out)["claims"]
    assert [claim["detail"]["accuracy"]["reached"] for claim in bounded] == [True, True]
    assert 20 <= written[-1] < 400
    assert [claim["index"] for claim in record["claims"]] == list(range(400))
    assert record["summary"] == {"proved": 267, "refuted": 133, "supported": 0, "undecided": 0, "errors": 0}
    assert status == 1


RUNAWAY = """
import importlib.util, sys

class Finder:
    def find_spec(self, name, path, target=None):
        if name != "canon.claims.many":
            return None
        sys.meta_path.remove(self)
        spec = importlib.util.find_spec(name)
        load = spec.loader.exec_module
        def patched(module):
            load(module)
            real = module.verify
            module.verify = lambda claim, **how: pow(3, 10**9) if claim.title == "runs away" else real(claim, **how)
        spec.loader.exec_module = patched
        return spec

sys.meta_path.insert(0, Finder())
"""
"""What a process of the cluster, and one beside it, runs when it starts: one claim gets lost in a call into C."""


@pytest.mark.thorough
@pytest.mark.filterwarnings("ignore")
def test_a_claim_that_runs_away_on_a_cluster_is_killed_there(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    import json

    distributed = pytest.importorskip("distributed")
    (tmp_path / "start").mkdir()
    (tmp_path / "start/sitecustomize.py").write_text(RUNAWAY)
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(tmp_path / "start"), *sys.path]))
    (tmp_path / "a.toml").write_text(brackets(1).replace("[[claim]]", '[[claim]]\ntitle = "runs away"'))
    (tmp_path / "b.toml").write_text(brackets(30))
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=2, processes=True, dashboard_address=None, local_directory=str(tmp_path)
    ) as local:
        address = local.scheduler_address
        assert main(["verify", "--json", str(tmp_path), "--cluster", address, "--budget", "1"]) == 1
    claims = json.loads(capsys.readouterr().out)["claims"]
    assert claims[0]["verdict"] == "undecided"
    assert claims[0]["detail"]["note"].startswith("stopped: ")
    assert [claim["verdict"] for claim in claims[1:4]] == ["proved", "proved", "refuted"]
    assert len(claims) == 31
