"""What a campaign costs a claim: deciding, sending, starting workers. The figures of scale.md.

Seconds are those of the processor, which other programs on the machine don't change, but where it says wall.
"""

from __future__ import annotations

import json
import os
import pickle
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from importlib.util import find_spec
from multiprocessing import get_context
from pathlib import Path
from typing import Any, Final

from canon import verify, verify_many
from canon.catalogue import files
from canon.claim import Claim
from canon.claims.reader import read_file

TICKS: Final = os.sysconf("SC_CLK_TCK")
CAMPAIGNS: Final = ((1, 16, True), (2, 16, True), (1, 16, False), (2, 16, False), (2, 1, True))
"""Workers, claims to a message, and whether each worker keeps a process beside it."""


def spent(action: Callable[[], Any]) -> tuple[float, Any]:
    """Seconds of the processor, and what came out."""
    start = time.process_time()
    found = action()
    return time.process_time() - start, found


def claims_of(every: int) -> list[Claim]:
    """Every so many of the catalogue's claims."""
    found = [claim for path in files() for claim in read_file(str(path)).claims]
    return found[::every]


def of_descendants() -> float:
    """Seconds of the processor that this process's children, and theirs, have used so far."""
    parent, used = dict[int, int](), dict[int, float]()
    for name in filter(str.isdigit, os.listdir("/proc")):
        with suppress(OSError):
            fields = Path("/proc", name, "stat").read_text().rpartition(")")[2].split()
            parent[int(name)], used[int(name)] = int(fields[1]), (int(fields[11]) + int(fields[12])) / TICKS
    ours, before = {os.getpid()}, 0
    while len(ours) > before:
        before = len(ours)
        ours |= {process for process, above in parent.items() if above in ours}
    return sum(used[process] for process in ours - {os.getpid()} if process in used)


def campaign(claims: list[Claim], workers: int, batch: int, apart: bool) -> dict[str, Any]:
    """A campaign in so many processes, with as many beside them where `apart`; what they need to start is left out."""
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as executor:
        how: dict[str, Any] = {"executor": executor, "apart": apart}
        list(verify_many(claims[: 4 * workers], batch=1, **how))
        starting, here, start = of_descendants(), time.process_time(), time.monotonic()
        answers = list(verify_many(claims, batch=batch, **how))
        wall, sent, used = time.monotonic() - start, time.process_time() - here, of_descendants() - starting
    assert len(answers) == len(claims)
    return {
        "workers": workers,
        "batch": batch,
        "apart": apart,
        "cpu_seconds_to_start_a_worker": round(starting / workers, 2),
        "cpu_ms_a_claim_of_the_workers": round(1e3 * used / len(claims), 2),
        "cpu_ms_a_claim_of_who_sends": round(1e3 * sent / len(claims), 2),
        "wall_seconds": round(wall, 2),
        "claims_a_second": round(len(claims) / wall, 1),
        "processors_in_use": round((used + sent) / wall, 2),
    }


CLUSTER: Final = """
from distributed import LocalCluster
if __name__ == "__main__":
    with LocalCluster(n_workers={}, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        print(cluster.scheduler_address, flush=True)
        input()
"""


def on_a_cluster(every: int, workers: int) -> dict[str, Any]:
    """Files read here, and by the workers of a Dask cluster, whose scheduler is another process; then decided there."""
    from canon.claims.worker import Entry, Settings
    from canon.cli.cluster import answers_of, readings_of

    paths = [Path(str(path)) for path in files()][::every]
    program = Path(tempfile.mkdtemp(), "cluster.py")
    program.write_text(CLUSTER.format(workers))
    figures: dict[str, Any] = {"workers": workers}
    with subprocess.Popen(
        [sys.executable, str(program)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as cluster:
        assert cluster.stdout is not None
        address = cluster.stdout.readline().strip()
        readings_of(address, paths[:8])  # what is imported once
        for how, read in (
            ("here", lambda: [read_file(path) for path in paths]),
            ("there", lambda: readings_of(address, paths)),
        ):
            start, here = time.monotonic(), time.process_time()
            found = read()
            sent, wall = time.process_time() - here, time.monotonic() - start
            claims = sum(len(reading[0]) for reading in found)
            figures[f"read_{how}"] = {
                "claims": claims,
                "cpu_ms_a_claim_of_who_asks": round(1e3 * sent / claims, 2),
                "claims_a_second_of_who_asks": round(claims / sent),
                "wall_seconds": round(wall, 2),
            }
            whole = [(claim, None) if isinstance(claim, Claim) else claim for reading in found for claim in reading[0]]
            entries = [Entry("", claim.index, claim, "", message) for claim, message in whole]
            here = time.process_time()
            assert len(list(answers_of(address, entries, Settings()))) == claims
            sent = time.process_time() - here
            figures[f"read_{how}"]["cpu_ms_a_claim_to_have_it_decided"] = round(1e3 * sent / claims, 2)
        cluster.communicate("\n")
    return figures


def main() -> None:
    """Print the figures as JSON."""
    reading, claims = spent(lambda: claims_of(8))
    verify(claims[0])  # what is imported and filled once
    times = []
    for claim in claims:
        seconds, verdict = spent(lambda claim=claim: verify(claim))
        times.append((seconds, verdict))
    sizes = [len(pickle.dumps(claim)) for claim in claims]
    packing, _ = spent(lambda: [pickle.loads(pickle.dumps(claim)) for claim in claims])  # noqa: S301 - our own
    seconds = sorted(t for t, _ in times)
    print(
        json.dumps(
            {
                "claims": len(claims),
                "reading_the_catalogue": round(reading, 2),
                "deciding_in_all": round(sum(seconds), 2),
                "deciding_ms_median_p90_p99_max": [
                    round(1e3 * x, 1)
                    for x in (*(statistics.quantiles(seconds, n=100)[k] for k in (49, 89, 98)), seconds[-1])
                ],
                "share_of_the_slowest_hundredth": round(sum(seconds[-max(1, len(seconds) // 100) :]) / sum(seconds), 3),
                "packing_ms_a_claim": round(1e3 * packing / len(claims), 2),
                "bytes_a_claim_median_max": [int(statistics.median(sizes)), max(sizes)],
                "cluster": on_a_cluster(4, 2) if find_spec("distributed") else None,
                "campaigns": [campaign(claims, *how) for how in CAMPAIGNS],
            },
            indent=1,
        )
    )


if __name__ == "__main__":
    main()
