"""What the planner foretells and what comes true, over the catalogue's systems.

    python docs/performance/calibration.py [--accuracy 1e-9] [--longer 1] [--seconds-only] [--json FILE]

For each system that `canon scenes` lists: the steps and seconds that short runs predicted of the last run, and the
seconds of all runs with more and more steps, before any was made; the error and seconds that the planner expected of
its last run when that run began; what it took, the error that it estimated, and the true one, against a reference of
its own (Taylor series with 34 digits where it has them; none with `--seconds-only`). Seconds are CPU time of this
process, so that others' work on the machine counts little; compiling, and the short runs themselves, are apart. At the
end the shares: seconds within a factor 2, steps within a factor 2 (which no machine's load can change), errors within a
factor 10, and scenes whose true error is within the accuracy that was asked for, at the first try.
"""

from __future__ import annotations

import argparse
import json
import math
from dataclasses import replace

import numpy as np

from canon.cost.reference import distance, reference_of
from canon.errors import CanonError
from canon.numeric.forecast import forecast_of
from canon.scenes.examples import scene_text
from canon.scenes.reader import read_scene_text
from canon.scenes.simulate import simulate
from canon.scenes.systems import load_system, system_names


def row(name: str, accuracy: float, longer: float, patience: float | None) -> dict[str, object]:
    """One system's forecast and truth, over so many times its example's duration."""
    scene = read_scene_text(scene_text(load_system(name)))
    duration = longer * scene.settings.duration
    settings = replace(scene.settings, accuracy=accuracy, step=None, monitors=(), duration=duration)
    scene = replace(scene, settings=settings)
    result = simulate(scene)
    trials, exact = result.planned.trials, result.problem.exact
    planned = result.planned.error
    told = forecast_of(trials, None if exact else result.choice.method.traits.order)
    found = None if patience is None else reference_of(scene, seconds=patience)
    start = (np.array(scene.q), np.array(scene.p))
    true = found and distance((result.q[-1], result.p[-1]), (found.q, found.p), start)
    before = result.choice.foreseen
    return {
        "system": name,
        "predicted_steps": before and before.steps,
        "predicted_seconds": before and before.seconds,
        "predicted_total": before and before.total,
        "whole": len(result.times) == settings.samples,
        "reference_is_finer": planned is None or found is None or found.off < 0.3 * planned,
        "method": "exact" if exact else result.choice.method.name,
        "steps": trials[-1].steps,
        "foretold_error": None if told is None else told.error,
        "estimated_error": result.planned.error,
        "true_error": true,
        "reference": found and found.source,
        "reference_off": found and found.off,
        "foretold_seconds": None if told is None else told.seconds,
        "seconds": trials[-1].seconds,
        "total": sum(trial.seconds for trial in trials),
    }


def within(a: float | None, b: float | None, factor: float) -> bool | None:
    """Whether two positive numbers differ by no more than a factor; None where one is missing."""
    if not a or not b:
        return None
    return abs(math.log(a / b)) <= math.log(factor)


def share(found: list[bool | None]) -> str:
    """How many of those that are known hold."""
    return f"{found.count(True)} of {len(found) - found.count(None)}"


def main() -> None:
    """Print the table and the shares."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--accuracy", type=float, default=1e-9)
    parser.add_argument("--longer", type=float, default=1.0, help="times the duration of each system's example")
    parser.add_argument("--patience", type=float, default=60.0, help="seconds that a reference by series may take")
    parser.add_argument("--seconds-only", action="store_true", help="no reference: steps and seconds alone")
    parser.add_argument("--json")
    arguments = parser.parse_args()
    rows, refused = [], []
    heads = "steps predicted | steps | error foretold | estimated | true | s predicted | s foretold | s taken"
    print(f"| system | method | {heads} | all runs predicted | all runs |")
    print("|---|---|" + "--:|" * 10)
    for name in system_names():
        try:
            patience = None if arguments.seconds_only else arguments.patience
            found = row(name, arguments.accuracy, arguments.longer, patience)
        except CanonError as reason:
            refused.append((name, str(reason)))
            continue
        if not found["whole"]:
            refused.append((name, "the orbit ends before that"))
            continue
        rows.append(found)
        errors = [found[word] for word in ("foretold_error", "estimated_error", "true_error")]
        seconds = [found[word] for word in ("predicted_seconds", "foretold_seconds", "seconds")]
        seconds += [found["predicted_total"], found["total"]]
        before = found["predicted_steps"]
        cells = [f"{before:.0f}" if before else "–", str(found["steps"])]
        cells += [f"{e:.1e}" if e is not None else "–" for e in errors]
        cells += [f"{s:.2g}" if s else "–" for s in seconds]
        print(f"| {found['system']} | {found['method']} | {' | '.join(cells)} |", flush=True)
    for name, reason in refused:
        print(f"{name}: {reason}")
    stepped = [r for r in rows if r["method"] != "exact"]
    print()
    for words, which, of, made in (
        ("steps of the last run, predicted before the first,", rows, "predicted_steps", "steps"),
        ("seconds of the last run, predicted before the first,", rows, "predicted_seconds", "seconds"),
        ("  of these, of motions that are not solved in closed form,", stepped, "predicted_seconds", "seconds"),
        ("seconds of all runs, predicted before the first,", rows, "predicted_total", "total"),
        ("  of these, of motions that are not solved in closed form,", stepped, "predicted_total", "total"),
        ("seconds of the last run, foretold before it,", stepped, "foretold_seconds", "seconds"),
    ):
        print(f"{words} within a factor 2: {share([within(r[of], r[made], 2) for r in which])}")
    if not arguments.seconds_only:
        coarse = [r["system"] for r in rows if not r["reference_is_finer"]]
        if coarse:
            print(f"no reference finer than the run, so that nothing is known of its error: {', '.join(coarse)}")
        rows, stepped = ([r for r in each if r["reference_is_finer"]] for each in (rows, stepped))
        reached = [r["true_error"] <= arguments.accuracy for r in rows]
        print(
            f"errors within a factor 10: {share([within(r['foretold_error'], r['true_error'], 10) for r in stepped])}"
        )
        print(f"true error within {arguments.accuracy:g}: {sum(reached)} of {len(reached)}")
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1)


if __name__ == "__main__":
    main()
