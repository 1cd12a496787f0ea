"""Certificates with one thing in them changed: which does the checker still confirm, and are these claims true?

    canon verify --fresh --certificate proofs
    python -m properties.tampered proofs [--each 1] [--seed 1] [--most 60]

Of each kind of claim and verdict some certificates are taken, and each of their fields changed in turn (`--most` of a
certificate's, by chance). With the old checksum all have to be rejected. With the right one what is shown may still be
a proof, of the same claim or of another: where the claim itself was changed, canon decides the new one, and the two
verdicts have to agree. A line for each case in which they don't; then the counts.
"""

import argparse
import copy
import json
import random
from collections import Counter, defaultdict
from pathlib import Path
from typing import Any

from canon.checker.check import check, checksum
from canon.checker.functions import Unreadable
from canon.claims.reader import read_tables
from canon.claims.verify import verify
from canon.errors import CanonError
from tests.checker.certified import places

Route = tuple[Any, ...]


def changed(data: Any, path: Route, rng: random.Random) -> Any:
    """The certificate with one thing changed: a formula by a thousandth, a number by 1, a table or list by one less."""
    data = copy.deepcopy(data)
    *above, last = path
    holder = data
    for key in above:
        holder = holder[key]
    item = holder[last]
    if isinstance(item, dict):
        holder[last] = {"x": "1"} if not item else dict(list(item.items())[1:])
    elif isinstance(item, list):
        holder[last] = ["1"] if not item else item[1:]
    elif isinstance(item, str):
        holder[last] = rng.choice((f"({item})*1001/1000", f"-({item})", f"({item}) + 1/1000", f"{item}1"))
    else:
        holder[last] = 2 if item is None else not item if isinstance(item, bool) else item + 1
    return data


def status(data: Any) -> str:
    try:
        return check(data).status
    except Unreadable:
        return "unreadable"


def verdict(data: Any) -> str:
    """Canon's own verdict of the claim that a certificate is about."""
    tables = {**data["tables"], "claim": [data["tables"]["claim"]]}
    reading = read_tables(tables)
    if reading.problems or not reading.claims:
        return "ill-posed"
    try:
        return verify(reading.claims[0], budget=10).status
    except CanonError:
        return "ill-posed"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--each", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--most", type=int, default=60)
    arguments = parser.parse_args()
    rng, groups = random.Random(arguments.seed), defaultdict[tuple[str, str], list[Path]](list)
    for path in sorted(Path(arguments.folder).rglob("*.json")):
        if path.stat().st_size < 30_000:
            data = json.loads(path.read_text(encoding="utf-8"))
            groups[data["tables"]["claim"]["kind"], data["verdict"]].append(path)
    counts = Counter[str]()
    for (kind, said), paths in sorted(groups.items()):
        for path in rng.sample(paths, min(arguments.each, len(paths))):
            data = json.loads(path.read_text(encoding="utf-8"))
            first, routes = status(data), list(places(data))
            counts["certificates"] += 1
            for route in rng.sample(routes, min(arguments.most, len(routes))):
                new = changed(data, route, rng)
                if new == data:
                    continue
                counts["changes"] += 1
                old = status(new)
                if old not in ("rejected", "unreadable"):
                    print(f"WRONG: {path} with {route} changed is {old} with the old checksum", flush=True)
                new["checksum"] = checksum({k: v for k, v in new.items() if k != "checksum"})
                answer = status(new)
                counts[f"with the right checksum: {answer}"] += 1
                if answer != "confirmed" or first != "confirmed":
                    continue
                if route[0] != "tables":
                    counts["confirmed: the same claim"] += 1
                    if route[0] in ("cases", "verdict", "known"):
                        counts[f"  {route[0]} {'…'.join(str(r) for r in route[-2:] if isinstance(r, str))[:40]}"] += 1
                    continue
                own = verdict(new)
                counts[f"confirmed: another claim, {own if own != new['verdict'] else 'the verdict is right'}"] += 1
                if own in ("proved", "refuted") and own != new["verdict"]:
                    print(f"WRONG: {path} ({kind}, {said}) with {route} changed is confirmed, and {own}", flush=True)
    for word, count in sorted(counts.items()):
        print(f"{count:6d}  {word}")


if __name__ == "__main__":
    main()
