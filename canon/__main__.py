"""`python -m canon` is the command `canon`."""

import os
import sys

ROOM = 64 << 20
"""Bytes on the disk below which no compiled files are kept: CPython 3.11 keeps those that are cut short, too."""

CUT_SHORT = (
    ": a file that Python has compiled is cut short, as where the disk was full when it was written: remove the "
    f"folders __pycache__ below {os.path.dirname(os.path.abspath(__file__))!r}"
    if sys.pycache_prefix is None
    else f": a file that Python has compiled is cut short: remove the folder {sys.pycache_prefix!r}"
)

HEARD = ("SIGINT", "SIGTERM", "SIGHUP")
"""The signals that end a run, with what is known until then."""

UNHEEDED = ("SYMPY_", "MPMATH_", "JAX_", "XLA_FLAGS", "MPLBACKEND", "MATPLOTLIBRC", "PYTHONINTMAXSTRDIGITS")
"""How the variables begin by which libraries are made to compute otherwise, or to fail: a verdict depends on none."""
HEEDED = ("JAX_PLATFORM", "JAX_COMPILATION_CACHE_", "JAX_PERSISTENT_CACHE_")
"""Those that say where jax computes, and where it keeps what it has compiled."""


def entry() -> None:
    """Run as a program. Ctrl-C, and an end that the system asks for, are heard while it is still being loaded, too."""
    _drop_the_working_folder()
    for name in [name for name in os.environ if name.startswith(UNHEEDED) and not name.startswith(HEEDED)]:
        del os.environ[name]
    sys.set_int_max_str_digits(sys.int_info.default_max_str_digits)  # without a bound a number of 1 MB takes seconds
    if "OPENBLAS_NUM_THREADS" not in os.environ and not starts_threads(os.cpu_count() or 1):
        os.environ["OPENBLAS_NUM_THREADS"] = "1"  # refused threads it interrupts the program, and crashes at its end
    import signal

    for name in HEARD:
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) in (signal.SIG_DFL, signal.default_int_handler):
            signal.signal(number, _leave)
    if _is_short_of_room():
        sys.dont_write_bytecode = True
    try:
        from canon.cli.main import entry as loaded
    except (OSError, MemoryError, EOFError) as error:
        _say(f"canon can't be loaded: {error or 'out of memory'}{CUT_SHORT if isinstance(error, EOFError) else ''}")
        os._exit(71)
    try:
        loaded()
    finally:  # the status is known: while Python ends, which takes large libraries a while, no signal changes it
        for name in HEARD:
            if hasattr(signal, name):
                signal.signal(getattr(signal, name), signal.SIG_IGN)


def _leave(*_: object) -> None:
    """End at once: there is nothing to report. Nothing is raised, which a library that is being loaded might lose."""
    _say("canon: interrupted")
    os._exit(130)


def _say(text: str) -> None:
    import contextlib

    with contextlib.suppress(OSError):
        os.write(2, f"{text}\n".encode("utf-8", "backslashreplace"))


def _drop_the_working_folder() -> None:
    """Import nothing from the folder in which the claims lie: they are data, and what lies beside them is, too.

    `python -m` looks there first. It is left where canon itself lies there.
    """
    home = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    try:
        here = os.getcwd()
    except OSError:  # it is gone
        return
    if not sys.flags.safe_path and sys.path and sys.path[0] in ("", here) and here != home:
        del sys.path[0]


def starts_threads(count: int) -> bool:
    """Whether the system starts so many threads at once; they are gone afterwards."""
    import _thread
    import time

    gate, before = _thread.allocate_lock(), _thread._count()

    def wait() -> None:
        with gate:
            pass

    try:
        with gate:
            for _ in range(count):
                _thread.start_new_thread(wait, ())
    except RuntimeError:
        return False
    finally:
        until = time.monotonic() + 1.0
        while _thread._count() > before and time.monotonic() < until:
            time.sleep(0.001)
    return True


def _is_short_of_room() -> bool:
    """Whether files that are written may be cut short."""
    try:
        import resource

        limits = resource.getrlimit(resource.RLIMIT_FSIZE)
        place = os.statvfs(_nearest_folder(sys.pycache_prefix or os.path.dirname(os.path.abspath(__file__))))
    except (ImportError, OSError):
        return False
    return place.f_bavail * place.f_frsize < ROOM or limits[0] != resource.RLIM_INFINITY


def _nearest_folder(path: str) -> str:
    """The folder, or the nearest one above it that there is."""
    while not os.path.isdir(path) and os.path.dirname(path) != path:
        path = os.path.dirname(path)
    return path or os.curdir


if __name__ == "__main__":
    entry()
