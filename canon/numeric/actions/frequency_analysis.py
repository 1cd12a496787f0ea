"""Numerical analysis of fundamental frequencies: the lines of a quasi-periodic signal on an equidistant grid.

Each line is where |⟨s, e^{2πiνt}⟩| is largest, the mean being weighted by a power of Hann's window, so that far lines
leak as t^(−2p−1): it is looked for by a Fourier transform and found by Newton's method on the derivative. All
amplitudes are solved for together. At last every line is looked for again in the signal less all others, until nothing
changes: what is left of the leaking is that of lines that were not asked for. Conditioning: noise of a standard
deviation σ in each part of the samples moves the frequency of a line of amplitude a by some 2.2 √6 σ/(π a N^(3/2)) over
the sampling interval, twice what no method can go below; with roundings of the samples for σ that is its last digit.
Laskar (1990), Icarus 88, 266; Laskar (2003), arXiv:math/0305364.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from canon.errors import NO_NUMBER, InputError
from canon.expected import finite_number, shown, whole_number

Array = Any  # numpy arrays

POWER: Final = 4
HIGHEST_POWER: Final = 64
_PASSES: Final = 12
_STEPS: Final = 30
_SETTLED: Final = 1e-16


@dataclass(frozen=True)
class Lines:
    """Lines Σ a_k e^{2πiν_k t} of a signal, the largest first.

    `frequencies` ν in cycles per unit of time and complex `amplitudes` a, at the time of the first sample; `change`,
    what the last pass changed of each frequency; `left`, the weighted root mean square of what they leave.
    """

    frequencies: Array
    amplitudes: Array
    change: Array
    left: float


def frequency_lines(signal: Array, step: float, count: int = 1, *, power: float = POWER) -> Lines:
    """The `count` largest lines of a signal of N samples at intervals `step`.

    **Arguments:** `signal`, real or complex, as q + ip of a degree of freedom; of a real one, each line comes with its
    mirror image at −ν. `power`, that of Hann's window: 0 is none; more separate lines less finely and leak less.

    **Raises:** `InputError` for a signal that is too short, or not finite.
    """
    whole_number(count, "count", 1)
    finite_number(step, "step")
    finite_number(power, "power", least=0.0)
    step, power = float(step), float(power)
    if power > HIGHEST_POWER:
        raise InputError(f"a power of at most {HIGHEST_POWER} is needed, not {shown(power)}", "power")
    try:
        values = np.asarray(signal, dtype=complex)
    except NO_NUMBER:
        raise InputError(f"an array of numbers is expected, not {shown(signal)}", "signal") from None
    if values.ndim != 1 or values.size < 16 * count or values.size < 32:
        raise InputError(f"{count} lines need {max(32, 16 * count)} samples in a row at least", "signal")
    if not np.all(np.isfinite(values)) or not (step > 0 and np.isfinite(step)):
        raise InputError("the signal or its step is not finite", "signal")
    grid = _Grid(values.size, power)
    found = np.empty(0)
    amplitudes = np.empty(0, dtype=complex)
    for _ in range(count):
        rest = values - grid.sum(found, amplitudes)
        found = np.append(found, grid.peak(rest))
        amplitudes = grid.amplitudes(values, found)
    change = np.full(count, np.inf)
    for _ in range(_PASSES):
        before = found.copy()
        for k in range(count):
            others = np.delete(np.arange(count), k)
            rest = values - grid.sum(found[others], amplitudes[others])
            found[k] = grid.climbed(rest, found[k])
            amplitudes = grid.amplitudes(values, found)
        change = np.abs(found - before)
        if np.all(change <= 4 * _SETTLED):
            break
    order = np.argsort(-np.abs(amplitudes), kind="stable")
    left = values - grid.sum(found, amplitudes)
    # phases were taken from the middle of the signal
    start = np.exp(2j * np.pi * found * grid.times[0])
    return Lines(
        found[order] / step,
        (amplitudes * start)[order],
        change[order] / step,
        float(np.sqrt(np.sum(grid.window * np.abs(left) ** 2))),
    )


class _Grid:
    """N times, in units of the step and from the middle, and the window on them, whose sum is 1."""

    def __init__(self, size: int, power: float) -> None:
        self.times = np.arange(size) - (size - 1) / 2
        self.window = (1 + np.cos(2 * np.pi * self.times / size)) ** power
        self.window = self.window / self.window.sum()

    def wave(self, frequency: float) -> Array:
        """e^{2πiνt}, its phase reduced to a turn before it is rounded."""
        turns = frequency * self.times
        return np.exp(2j * np.pi * (turns - np.round(turns)))

    def sum(self, frequencies: Array, amplitudes: Array) -> Array:
        """The signal of lines."""
        total = np.zeros(self.times.size, dtype=complex)
        for frequency, amplitude in zip(frequencies, amplitudes, strict=True):
            total = total + amplitude * self.wave(frequency)
        return total

    def amplitudes(self, values: Array, frequencies: Array) -> Array:
        """Those that leave the least weighted square."""
        waves = np.stack([self.wave(frequency) for frequency in frequencies])
        gram = (waves.conj() * self.window) @ waves.T
        right = (waves.conj() * self.window) @ values
        return np.linalg.lstsq(gram, right, rcond=None)[0]

    def peak(self, values: Array) -> float:
        """The frequency of the largest line."""
        size = 4 * self.times.size
        spectrum = np.abs(np.fft.fft(values * self.window, size))
        return self.climbed(values, float(np.fft.fftfreq(size)[int(np.argmax(spectrum))]))

    def climbed(self, values: Array, frequency: float) -> float:
        """The top of |A(ν)|² next to a frequency, where Re(A* A') = 0: by Newton's method in steps of a quarter bin."""
        weighted = self.window * values
        most = 0.25 / self.times.size
        for _ in range(_STEPS):
            turned = weighted * self.wave(frequency).conj()
            moment = self.times * turned
            A, A1, A2 = turned.sum(), -2j * np.pi * moment.sum(), -4 * np.pi**2 * (self.times @ moment)
            slope = (A.conjugate() * A1).real
            bend = abs(A1) ** 2 + (A.conjugate() * A2).real
            step = -slope / bend if bend < 0 else np.copysign(most, slope)
            step = min(max(step, -most), most)
            frequency += step
            if abs(step) <= _SETTLED:
                break
        return float(frequency)
