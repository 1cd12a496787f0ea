"""A scene's run in words, for terminals and plain text alike; and the explanation that `--explain` prints."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final

from canon.numeric.forecast import digit_factor
from canon.report.scene_record import active_effects, engine_name, integrator_name
from canon.report.words import duration, visible
from canon.scenes.simulate import Result
from canon.scenes.values import text_of

PRICED: Final = (1e-3, 1e-6, 1e-9, 1e-12)
_SHOWN: Final = 6
_SCATTERED: Final = 12


def run_lines(result: Result) -> list[str]:
    """What was run, how exactly, what the monitors say, and what went otherwise than it should."""
    run, method = result.planned.run, result.choice.method
    lines = [visible(result.scene.title)] if result.scene.title else []
    lines.append(f"  effects     {', '.join(active_effects(result)) or 'none'}")
    order = "" if result.problem.exact else f", order {method.traits.order}"
    mean = " on average" if run.taken is not None else ""
    lines.append(f"  integrator  {integrator_name(result)}{order}, step {run.step:.6g}{mean}, {run.steps} steps")
    error = result.planned.error
    lines.append(f"  error       {'unknown' if error is None else f'{error:.1e}, estimated'}")
    lines.append(f"  time        {_time(result)}")
    times, t = result.times, result.scene.model.t
    lines.append(f"  states      {len(times)}, from {t} = {times[0]:.6g} to {times[-1]:.6g}")
    lines.append(f"  final       {', '.join(_state(result))}")
    lines += list(_strings(result))
    width = max((len(reading.name) for reading in result.monitors), default=0)
    for reading in result.monitors:
        drift = "" if reading.max_drift is None else f", largest drift {reading.max_drift:.1e}"
        mark = "✗" if reading.alarm else "✓" if reading.bound is not None else "·"
        predicted = ", as predicted" if "predicted" in reading.extra and not reading.alarm else ""
        note = f": {reading.extra['note']}" if "note" in reading.extra else ""
        lines.append(f"  {mark} {reading.name:<{width}}  {reading.expected}{predicted}{drift}{note}")
    lines += scattering_lines(result)
    lines += [f"  ! {message}" for message in result.messages]
    return lines


def _time(result: Result) -> str:
    """What it took, and what one digit more would."""
    took = f"{duration(result.seconds[0])} to compile, {duration(result.seconds[1])} to run"
    trials, order = result.planned.trials, None if result.problem.exact else result.choice.method.traits.order
    factor = digit_factor(order)
    if factor is None:
        return f"{took}; no digit is to be bought"
    if not trials:
        return took
    return f"{took}; one digit more: {factor:.2g} times as many steps"


def scattering_lines(result: Result) -> Iterator[str]:
    """What the scatterer did, one line a body."""
    for name, seen in list(result.scattering.items())[:_SCATTERED]:
        found, far = seen.deflection, ""
        if seen.impact_parameter is not None:
            far = f", impact parameter {seen.impact_parameter:.10g}"
        if found is None:
            yield f"  scattering  {visible(name)}{far}: turned by {seen.turned:.10g} in this run"
            continue
        chi = f"{found.angle:.10g}" if found.backward > 0.1 or found.angle < 0 else f"π − {found.backward:.10g}"
        sigma = "" if seen.cross_section is None else f", dσ/dΩ = {seen.cross_section:.10g}"
        yield f"  scattering  {visible(name)}{far}: deflected by {chi} ({seen.turned:.6g} in this run){sigma}"
    if len(result.scattering) > _SCATTERED:
        yield f"  scattering  … ({len(result.scattering)} bodies: --json has them all)"


def _strings(result: Result) -> Iterator[str]:
    """When strings went slack and became taut."""
    several = len(result.scene.model.strings) > 1
    for event in result.events[:_SHOWN]:
        what = f"taut, {event.lost:.4g} of energy lost" if event.taut else "slack"
        yield f"  string{f' {event.index}' if several else '':<6}{what} at t = {event.time:.10g}"
    if len(result.events) > _SHOWN:
        yield f"  string      … ({len(result.events)} times slack or taut)"


def _state(result: Result) -> Iterator[str]:
    model = result.scene.model
    shown = [*zip(model.q, result.q[-1], strict=True), *zip(model.p, result.p[-1], strict=True)]
    for symbol, value in shown[: 2 * _SHOWN]:
        yield f"{symbol} = {value:.10g}"
    if len(shown) > 2 * _SHOWN:
        yield f"… ({len(shown)} numbers)"


def explanation_lines(result: Result) -> list[str]:
    """The Hamiltonian effect by effect, the splitting, the method and its price, and what no effect called for."""
    model, problem, choice = result.scene.model, result.problem, result.choice
    lines = ["Hamiltonian"]
    for effect in dict.fromkeys(term.effect for term in model.terms):
        terms = [term.expr for term in model.terms if term.effect == effect]
        lines += [f"  {effect:<18} {text_of(expr)}" for expr in terms]
    for friction in model.frictions:
        forces = ", ".join(text_of(force) for force in friction.force)
        lines.append(f"  {friction.effect:<18} no part of it: the force ({forces})")
    for k, (effect, g) in enumerate(model.constraints):
        lines.append(f"  {effect:<18} no part of it: {text_of(g)} {'≤' if k in model.strings else '='} 0")
    lines += ["", f"Splitting: {problem.kind}"]
    lines += [f"  {name or 'part':<18} {formula}" for name, formula in problem.parts]
    source = problem.source if problem.exact else choice.method.source
    lines += ["", f"Method: {integrator_name(result)}", f"  {choice.why}", *([f"  {source}"] if source else [])]
    if result.operations is not None:
        engine = {"native": ", by native code", "xla": ", by XLA"}.get(engine_name(result) or "", "")
        lines.append(f"  {result.operations} arithmetic operations a step{engine}")
    lines += candidate_lines(result)
    prices = list(price_lines(result))
    if prices:
        lines += ["", "Price, estimated from this run", *prices]
    if result.scene.absent:
        lines += ["", "Left out, as no effect calls for it", f"  {', '.join(result.scene.absent)}"]
    return lines


def candidate_lines(result: Result) -> list[str]:
    """What each candidate was predicted to cost before the run, the one that was taken first."""
    candidates = result.choice.candidates
    if not candidates:
        return []
    lines = ["", "Candidates, as predicted from short runs"]
    for each in candidates:
        known = each.steps is not None and each.seconds is not None
        cost = f"{each.steps:10.0f} steps   {duration(max(each.seconds or 0.0, 1e-6))}" if known else ""
        if each.runs is not None and each.total is not None:
            cost += f"   {each.runs} runs {duration(max(each.total, 1e-6))}"
        lines.append(f"  {each.method.name:<20} {cost}{'   ' * bool(cost and each.why)}{each.why}")
    return lines


def price_lines(result: Result) -> Iterator[str]:
    """What the same method would cost at other accuracies, by its order."""
    planned: Any = result.planned
    if result.problem.exact or not planned.error or not planned.trials:
        return
    last = planned.trials[-1]
    for accuracy in PRICED:
        steps = last.steps * (planned.error / accuracy) ** (1 / result.choice.method.traits.order)
        seconds = last.seconds * steps / max(last.steps, 1)
        yield f"  {accuracy:.0e}   {max(steps, 1):10.0f} steps   {duration(max(seconds, 1e-6))}"
