"""What a campaign costs a claim: deciding, sending, starting workers. The figures of scale.md.

Seconds are those of the processor, which other programs on the machine don't change, but where it says wall.
"""

from __future__ import annotations

import json
import pickle
import resource
import statistics
import time
from collections.abc import Callable
from typing import Any

from canon import verify, verify_many
from canon.catalogue import files
from canon.claim import Claim
from canon.claims.reader import read_file


def spent(action: Callable[[], Any]) -> tuple[float, Any]:
    """Seconds of the processor, and what came out."""
    start = time.process_time()
    found = action()
    return time.process_time() - start, found


def claims_of(every: int) -> list[Claim]:
    """Every so many of the catalogue's claims."""
    found = [claim for path in files() for claim in read_file(str(path)).claims]
    return found[::every]


def of_children() -> float:
    """Seconds of the processor that processes which have ended have used."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def campaign(claims: list[Claim], workers: int, batch: int) -> dict[str, float]:
    """A campaign in so many processes."""
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing import get_context

    before, here, start = of_children(), time.process_time(), time.monotonic()
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as executor:
        answers = list(verify_many(claims, executor=executor, batch=batch))
    assert len(answers) == len(claims)
    return {
        "workers": workers,
        "batch": batch,
        "wall_seconds": round(time.monotonic() - start, 2),
        "cpu_seconds_of_workers": round(of_children() - before, 2),
        "cpu_seconds_here": round(time.process_time() - here, 2),
    }


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
                "campaigns": [campaign(claims, workers, batch) for workers, batch in ((1, 16), (2, 16), (2, 1))],
            },
            indent=1,
        )
    )


if __name__ == "__main__":
    main()
