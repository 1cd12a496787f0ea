"""`canon simulate`: run a scene, and show where it went and what was conserved."""

from __future__ import annotations

import argparse
import math
import os
import signal
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from canon.cli.files import is_protected, same_file
from canon.cli.parser import NOT_WRITTEN, positive, seconds
from canon.cli.refusal import refused
from canon.cli.spoken import complain, notation, shown

if TYPE_CHECKING:
    from canon.scenes.scene import Scene
    from canon.scenes.simulate import Result

HELP: Final = "run a scene: bodies and effects, a system of the catalogue, or a Hamiltonian of your own"
DESCRIPTION: Final = (
    "Simulates a scene. Only the effects that it names are computed; the method and its step are chosen for the "
    "accuracy. Exit status 1 says that the accuracy was not reached, that the run ended early, or that something "
    "drifted that must be conserved; what was computed is written all the same."
)
_PICTURES: Final = ("png", "svg", "pdf")


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the command."""
    parser.add_argument(
        "scene", metavar="SCENE.toml", help="a scene file, or the name of a system (see `canon scenes`)"
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object and nothing else")
    parser.add_argument("--plot", metavar="FILE", type=picture, help="draw the orbit into a .png, .svg or .pdf file")
    parser.add_argument(
        "--out", metavar="FILE.npz", help="write the stored states into a file, now and then and at last"
    )
    parser.add_argument(
        "--resume",
        metavar="FILE.npz",
        help="go on with the run that wrote this file and was interrupted; --out is this file, too, if not given",
    )
    how = parser.add_mutually_exclusive_group()
    how.add_argument(
        "--accuracy", type=_fraction, metavar="A", help="of the states, relative to the largest (default: 1e-9)"
    )
    how.add_argument("--budget", type=seconds, metavar="SECONDS", help="be as accurate as this time allows")
    how.add_argument("--step", type=positive, metavar="H", help="a fixed step")
    parser.add_argument("--integrator", metavar="NAME", help="instead of the one that the planner would choose")
    parser.add_argument(
        "--engine",
        choices=("auto", "native", "xla"),
        help="what computes the steps: machine code of canon's own, where the extra `native` is installed, or XLA",
    )
    parser.add_argument(
        "--compare", action="store_true", help="try every candidate for the integrator first, however short the run"
    )
    parser.add_argument(
        "--explain", action="store_true", help="show the Hamiltonian, its splitting, the method, its price"
    )


def picture(text: str) -> str:
    """The name of a figure's file, by its ending."""
    if text.rpartition(".")[2].lower() not in _PICTURES:
        raise argparse.ArgumentTypeError(f"{text!r} is no figure's name: it ends with .png, .svg or .pdf")
    return text


def _fraction(text: str) -> float:
    value = positive(text)
    if not 1e-15 <= value < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is no accuracy: give one from 1e-15 to 1, as 1e-9")
    return value


def execute(arguments: argparse.Namespace) -> int:
    """Run the scene, print and write what is asked for, and return the exit status."""
    from canon.errors import InputError

    begun = time.monotonic()
    if arguments.out is None:
        arguments.out = arguments.resume
    try:
        scene = _with_options(read_scene_or_system(arguments.scene), arguments)
        _check_folders(arguments)
        if scene.settings.budget is not None:
            left = max(scene.settings.budget - (time.monotonic() - begun), 0.0)
            scene = replace(scene, settings=replace(scene.settings, budget=left))
        result = _run(scene, arguments)
    except InputError as error:
        return refused("simulate", arguments.scene, error, as_json=arguments.json)
    faults = _write_states(result, arguments)
    try:
        _print(result, arguments)
        sys.stdout.flush()
    finally:  # the figure last, which takes longest: where it is interrupted, the rest is there
        faults += _draw(result, arguments)
    if arguments.plot is not None and not arguments.json:
        print(f"  figure      {shown(arguments.plot)}")
    for fault in faults:
        complain(f"canon simulate: {fault}")
    return NOT_WRITTEN if faults else 0 if result.ok else 1


def _run(scene: Scene, arguments: argparse.Namespace) -> Result:
    from canon.errors import InputError
    from canon.report.states_file import read_arrays, write_arrays
    from canon.scenes.simulate import simulate

    def keep(arrays: Any) -> None:
        with suppress(OSError):  # the run is worth more than what it could be gone on with; it is said at the end
            write_arrays(arrays, arguments.out)

    def warn(message: str) -> None:
        complain(f"canon simulate: {arguments.scene}: {message}")

    with _watched(arguments.json) as watch, _terminated_as_interrupted():
        if arguments.resume is None:
            return simulate(scene, watch=watch, keep=None if arguments.out is None else keep, warn=warn)
        try:
            resume = read_arrays(arguments.resume)
            return simulate(scene, watch=watch, keep=keep, resume=resume, warn=warn)
        except InputError as error:
            raise error if error.where else error.at(f"--resume {arguments.resume}") from None


@contextmanager
def _terminated_as_interrupted() -> Iterator[None]:
    """SIGTERM within ends the run as Ctrl-C does: what was computed until then is written."""

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    try:
        before = signal.signal(signal.SIGTERM, interrupt)
    except ValueError:  # not in the main thread, where no signal arrives
        yield
        return
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def read_scene_or_system(name: str) -> Scene:
    """The scene of a file, or the example of a system of this name. **Raises:** `InputError`."""
    from canon.scenes.reader import read_scene, read_scene_text

    if not os.path.lexists(name) and not name.endswith(".toml"):
        from canon.scenes.examples import scene_text
        from canon.scenes.systems import load_system

        return read_scene_text(scene_text(load_system(name)))
    return read_scene(name)


def _with_options(scene: Scene, arguments: argparse.Namespace) -> Scene:
    """The scene with the command line's settings in place of its own."""
    settings = scene.settings
    if arguments.step is not None:
        settings = replace(settings, step=arguments.step, accuracy=None)
    elif arguments.budget is not None:
        settings = replace(settings, budget=arguments.budget, accuracy=None, step=None)
    elif arguments.accuracy is not None:
        settings = replace(settings, accuracy=arguments.accuracy, step=None)
    if arguments.integrator is not None:
        settings = replace(settings, integrator=arguments.integrator)
    if arguments.engine is not None:
        settings = replace(settings, engine=arguments.engine)
    return replace(scene, settings=replace(settings, compare=arguments.compare))


def _check_folders(arguments: argparse.Namespace) -> None:
    """Refuse files that can't be written before anything is computed."""
    check_folder("--plot", arguments.plot, arguments.scene, arguments.out, arguments.resume)
    check_folder("--out", arguments.out, arguments.scene)


def check_folder(option: str, path: str | None, *others: str | None) -> None:
    """**Raises:** `InputError` where a file can't be written, or is one of the `others`, which would be lost."""
    from canon.errors import InputError

    if path is None:
        return
    if "\0" in path:
        raise InputError("no file's name has the character NUL in it", option)
    if same_file(path, others):
        raise InputError(f"{path!r} would be written over what is read from it, or written to it as well", option)
    folder = os.path.dirname(path) or os.curdir
    if not os.path.isdir(folder):
        raise InputError(f"there is no folder {folder!r} to write to", option)
    if not os.access(folder, os.W_OK) or (os.path.exists(path) and not os.path.isfile(path)):
        raise InputError(f"{path!r} can't be written, or is no regular file", option)
    if is_protected(path):
        raise InputError(f"{path!r} is there, and is protected against being written over", option)


class _watched:  # noqa: N801 - a context manager that reads as a word
    """A progress bar on a terminal, for runs that take long; nothing elsewhere."""

    def __init__(self, silent: bool) -> None:
        self.silent = silent
        self.bar: Any = None

    def __enter__(self) -> Callable[[float], None] | None:
        if self.silent or not sys.stderr.isatty():
            return None
        from canon.report.console import part_bar

        self.bar = part_bar()
        return self.bar.update

    def __exit__(self, *exception: object) -> None:
        if self.bar is not None:
            self.bar.close()


def _write_states(result: Result, arguments: argparse.Namespace) -> list[str]:
    from canon.report.states_file import write_states

    return write_each(arguments, {"out": lambda: write_states(result, arguments.out)})


def _draw(result: Result, arguments: argparse.Namespace) -> list[str]:
    def draw() -> None:
        from canon.report.figures import plot

        plot(result, arguments.plot)

    return write_each(arguments, {"plot": draw})


def write_each(arguments: argparse.Namespace, files: Mapping[str, Callable[[], None]]) -> list[str]:
    """Write the files of those options that are given, and return what to say of those that couldn't be written.

    An option whose file isn't there is None afterwards. What was computed is worth more than a file of it: it is
    printed all the same.
    """
    faults = []
    for option, write in files.items():
        path = getattr(arguments, option)
        try:
            if path is not None:
                write()
        except OSError as error:
            faults.append(f"--{option} {path} can't be written: {error.strerror or error}")
            setattr(arguments, option, None)
    return faults


def finite(data: Any) -> Any:
    """The data with None in place of numbers that are not finite."""
    if isinstance(data, dict):
        return {key: finite(value) for key, value in data.items()}
    if isinstance(data, (list, tuple)):
        return [finite(value) for value in data]
    return None if isinstance(data, float) and not math.isfinite(data) else data


def _print(result: Result, arguments: argparse.Namespace) -> None:
    if arguments.json:
        from canon.report.scene_record import scene_record

        record = scene_record(result)
        try:
            print(notation(record))
        except ValueError:  # JSON has no word for what isn't finite, as it may be of a run that was changed on disk
            print(notation(finite(record)))
        return
    from canon.report.scene_text import explanation_lines, run_lines

    lines = run_lines(result)
    if arguments.explain:
        lines = [*explanation_lines(result), "", *lines]
    print("\n".join(lines))
    if arguments.out is not None:
        print(f"  states      {shown(arguments.out)}")
