"""The JSON record of a scene's run, in format 1 of the scenes' contract."""

from __future__ import annotations

import math
from typing import Any, Final

from canon.numeric.candidates import Prediction
from canon.numeric.forecast import digit_factor, forecast_of
from canon.scenes.monitors import Reading
from canon.scenes.simulate import Result
from canon.scenes.states import named_states, own_states
from canon.scenes.string_events import Event
from canon.scenes.values import text_of

FORMAT: Final = 1
Record = dict[str, Any]


def scene_record(result: Result) -> Record:
    """The run as the one object that `--json` prints: one row a stored time."""
    scene, planned, method = result.scene, result.planned, result.choice.method
    return {
        "format": FORMAT,
        "title": scene.title,
        "units": scene.units,
        "effects": {"active": active_effects(result)},
        "hamiltonian": text_of(scene.model.H),
        "integrator": {
            "name": integrator_name(result),
            "order": None if result.problem.exact else method.traits.order,
            "symplectic": method.traits.symplectic,
            "step": planned.run.step,
            "engine": engine_name(result),
            "why": result.choice.why,
            "candidates": [candidate_record(each) for each in result.choice.candidates],
        },
        "operations": {"per_step": result.operations},
        "steps": planned.run.steps,
        "seconds": {"compile": round(result.seconds[0], 6), "run": round(result.seconds[1], 6)},
        "error_estimate": _finite(planned.error),
        "price": price_record(result),
        "accuracy": {"asked": scene.settings.accuracy, "reached": planned.reached},
        "monitors": {reading.name: monitor_record(reading) for reading in result.monitors},
        **({"scattering": scattering_record(result)} if result.scattering else {}),
        **({"events": [event_record(event) for event in result.events]} if result.scene.model.strings else {}),
        "messages": list(result.messages),
        "coordinates": {"q": [str(x) for x in scene.model.q], "p": [str(x) for x in scene.model.p]},
        "times": result.times.tolist(),
        "q": result.q.tolist(),
        "p": result.p.tolist(),
        **{name: rows.tolist() for name, rows in own_states(result).items()},
        **{word: {name: rows.tolist() for name, rows in table.items()} for word, table in named_states(result).items()},
    }


def engine_name(result: Result) -> str | None:
    """What computed the steps, "native" or "xla"; None where it is another package."""
    engine = result.planned.run.engine
    return None if engine == "auto" else engine


def candidate_record(each: Prediction) -> Record:
    """What a candidate for the integrator was predicted to cost, and why it was not taken."""
    return {
        "name": each.method.name,
        "operations": each.operations or None,
        "measured_order": each.order and round(each.order, 2),
        **foreseen_record(each),
        "rejected": each.why or None,
    }


def foreseen_record(each: Prediction) -> Record:
    """What was predicted, before any run, of the last one, and of all with more and more steps."""
    return {
        "steps": each.steps and round(each.steps),
        "error": _finite(each.error),
        "seconds": each.seconds and round(each.seconds, 6),
        "runs": each.runs,
        "all_runs": each.total and round(each.total, 6),
    }


def price_record(result: Result) -> Record:
    """What was predicted of the runs and foretold of the last one, what they took, and the price of one digit more,
    "exact" where none is sold.
    """
    trials, order = result.planned.trials, None if result.problem.exact else result.choice.method.traits.order
    told = forecast_of(trials, order)
    factor = digit_factor(order)
    foreseen = result.choice.foreseen
    return {
        "predicted": None if foreseen is None else foreseen_record(foreseen),
        "foretold": None
        if told is None
        else {"steps": told.steps, "error": _finite(told.error), "seconds": round(told.seconds, 6)},
        "last_run": round(trials[-1].seconds, 6) if trials else None,
        "all_runs": round(sum(trial.seconds for trial in trials), 6) if trials else None,
        "one_digit_more": "exact"
        if factor is None
        else {"factor": round(factor, 3), "seconds": round(factor * trials[-1].seconds, 6) if trials else None},
    }


def scattering_record(result: Result) -> Record:
    """What the scatterer did, by the bodies' names."""
    return {
        name: {
            "energy": seen.energy,
            "impact_parameter": seen.impact_parameter,
            "nearest": seen.deflection and seen.deflection.nearest,
            "deflection": seen.deflection and seen.deflection.angle,
            "from_backward": seen.deflection and seen.deflection.backward,
            "angle": seen.angle,
            "turned": seen.turned,
            "cross_section": seen.cross_section,
        }
        for name, seen in result.scattering.items()
    }


def event_record(event: Event) -> Record:
    """What became of a string as data."""
    return {
        "time": event.time,
        "string": event.index,
        "becomes": "taut" if event.taut else "slack",
        "energy_lost": event.lost,
    }


def active_effects(result: Result) -> list[str]:
    """The effects that are simulated, beside the kinetic energy; none for a Hamiltonian of one's own."""
    return [effect for effect in result.scene.model.effects if effect not in ("kinetic", "H")]


def integrator_name(result: Result) -> str:
    """The method's name; "exact" where the motion has a closed form."""
    return "exact" if result.problem.exact else result.choice.method.name


def monitor_record(reading: Reading) -> Record:
    """A monitor's reading as data."""
    return {
        "expected": reading.expected,
        "initial": _finite(reading.initial),
        "final": _finite(reading.final),
        "max_drift": _finite(reading.max_drift),
        "bound": _finite(reading.bound),
        **({"alarm": reading.alarm} if reading.alarm else {}),
        **{name: _finite(value) for name, value in reading.extra.items()},
    }


def _finite(value: Any) -> Any:
    """A number, or a list of numbers, that JSON can hold: None for what is not finite."""
    if isinstance(value, list):
        return [_finite(item) for item in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value
