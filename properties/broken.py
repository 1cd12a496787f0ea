"""Is each fault's handling tested? It is taken out, and the test has to fail: `python -m properties.broken`.

In a copy of the package and its tests, one line is changed at a time: a checksum is no longer compared, a worker no
longer killed, an error no longer caught. The test that injects the fault runs on the copy; if it still passes, it tests
nothing. Each test passes on the copy as it is, or its failure would mean nothing.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Final

FAULTS: Final = "tests/hostile/test_faults.py::"
WORKERS: Final = "tests/cli/test_workers.py::"
JOURNAL: Final = "tests/cli/test_journal.py::"
TARGETS: Final = "tests/hostile/test_targets.py::"
REMEMBERED: Final = "tests/cli/test_remembered.py::"
CHANGED: Final = "tests/hostile/test_changed_files.py::"
UNFORESEEN: Final = "tests/hostile/test_unforeseen.py::"
NOTHING: Final = "except ZeroDivisionError:"
"""What catches nothing that happens here."""
LONGEST: Final = 120.0
"""Seconds after which a test of a broken copy has failed: what is to be killed would go on."""


@dataclass(frozen=True)
class Break:
    """A fault, how its handling is taken out (the text `old` of a file below canon/ becomes `new`), and its test."""

    fault: str
    how: str
    file: str
    old: str
    new: str
    test: str


BREAKS: Final = (
    Break("a claim overstays, in a call into C", "no worker is killed at its deadline", "claims/run.py",
          "elif time.monotonic() >= worker.deadline and", "elif False and",
          FAULTS + "test_a_product_that_holds_the_interpreter_is_killed"),
    Break("the same, its parent gone", "no alarm is set in the worker", "claims/worker.py",
          'if hasattr(signal, "setitimer"):', "if False:",
          WORKERS + "test_a_worker_whose_parent_is_killed_ends_though_it_is_busy"),
    Break("a claim needs too much memory", "no limit of memory is set", "claims/worker.py",
          "resource.setrlimit(resource.RLIMIT_AS, (limit, hard))", "pass",
          FAULTS + "test_a_worker_that_the_system_ends_costs_one_answer[devour"),
    Break("the same, the error heard", "`MemoryError` is any other error", "claims/worker.py",
          "except MemoryError:", "except ZeroDivisionError:",
          WORKERS + "test_what_was_cut_short_says_why[5"),
    Break("the system kills a worker", "the end of its pipe isn't expected", "claims/run.py",
          "except (EOFError, OSError):\n                    cause", f"{NOTHING}\n                    cause",
          FAULTS + "test_a_worker_that_the_system_ends_costs_one_answer[kill"),
    Break("the same", "its claim isn't asked again", "claims/run.py", "if position in self.lost:", "if True:",
          WORKERS + "test_what_a_killed_worker_had_is_asked_again"),
    Break("the same", "a journal keeps that nobody answered", "cli/verify.py", "(LOST, ENDED)", "LOST",
          WORKERS + "test_what_a_killed_worker_had_is_asked_again"),
    Break("Ctrl-Z", "what has lost its time is answered", "claims/run.py",
          "worker.stops != continued() and _is_open(reply)", "False",
          WORKERS + "test_what_lost_its_time_while_the_run_was_stopped_is_asked_again"),
    Break("a certificate is gone", "a journal's answer is believed without it", "claims/journal.py",
          " and _is_whole(kept, record, entry)", "",
          JOURNAL + "test_a_certificate_that_is_missing_is_made_again"),
    Break("a journal of another version", "nobody counts its answers", "claims/journal.py",
          'kept.others += body.get("by") != kept.by', "pass",
          JOURNAL + "test_answers_of_another_version_or_other_options_are_counted"),
    Break("more workers, another order", "the seed depends on the worker", "claims/worker.py",
          "seed=settings.seed,", "seed=os.getpid(),", FAULTS + "test_the_number_of_workers_changes_nothing"),
    Break("Ctrl-C", "it isn't caught", "cli/verify.py",
          "except KeyboardInterrupt:\n        interrupted = True", f"{NOTHING}\n        interrupted = True",
          WORKERS + "test_an_interruption_keeps_what_is_known_and_leaves_no_process"),
    Break("Ctrl-C", "workers are asked to end, and waited for", "claims/run.py",
          "worker.process.kill()\n        for worker", "worker.connection.close()\n        for worker",
          WORKERS + "test_an_interruption_keeps_what_is_known_and_leaves_no_process"),
    Break("a full disk: standard output", "the error isn't caught", "cli/main.py",
          "except OSError as error:\n        refused", "except ZeroDivisionError as error:\n        refused",
          FAULTS + "test_output_to_a_full_disk_is_an_error_of_its_own"),
    Break("a full disk: states", "the file is written in its place", "report/whole_file.py",
          'tempfile.mkstemp(dir=target.parent, prefix=f".{target.name[:100]}.", suffix=".part")',
          "(os.open(target, os.O_RDWR | os.O_TRUNC), str(target))",
          FAULTS + "test_a_full_disk_costs_the_files_and_not_the_run"),
    Break("a full disk: certificates", "the error isn't caught", "report/certificate_file.py",
          "except OSError as error:\n            record", "except ZeroDivisionError as error:\n            record",
          FAULTS + "test_a_certificate_that_is_missing_is_missed"),
    Break("a full disk: certificates", "the exit status says nothing of it", "cli/verify.py",
          "(NOT_WRITTEN if unwritten or unproved or unkept else 0)", "0",
          FAULTS + "test_a_certificate_that_is_missing_is_missed"),
    Break("a full disk: the journal", "the error isn't caught", "claims/journal.py",
          "except OSError as error:\n        kept.fault", "except ZeroDivisionError as error:\n        kept.fault",
          JOURNAL + "test_a_full_disk_costs_the_journal_alone"),
    Break("a full disk: the cache", "what was begun is left there", "claims/remembered.py",
          "os.unlink(name)", "pass", FAULTS + "test_a_folder_that_cant_be_written_to_is_no_error"),
    Break("a cache that can't be written", "the error isn't caught", "claims/remembered.py",
          "suppress(OSError, ValueError):\n        place", "suppress(ValueError):\n        place",
          FAULTS + "test_a_folder_that_cant_be_written_to_is_no_error"),
    Break("a cache that can't be written", "its folder can't be made, and that isn't caught", "claims/remembered.py",
          "suppress(OSError, ValueError):\n        place", "suppress(ValueError):\n        place",
          REMEMBERED + "test_without_a_folder_nothing_is_lost"),
    Break("a closed pipe", "the error isn't caught", "cli/main.py", "except BrokenPipeError:", NOTHING,
          "tests/cli/test_arguments.py::test_a_reader_that_hangs_up_is_no_error"),
    Break("a closed pipe, in the middle of a run", "the error isn't caught", "cli/main.py", "except BrokenPipeError:",
          NOTHING, FAULTS + "test_a_reader_that_hangs_up_ends_the_run"),
    Break("a terminal of another alphabet", "letters that it hasn't aren't replaced", "cli/main.py",
          'stream.reconfigure(errors="replace")', "pass", FAULTS + "test_a_bare_environment_is_enough"),
    Break("no home", "that isn't caught", "claims/remembered.py",
          "with contextlib.suppress(RuntimeError):", "with contextlib.suppress(ZeroDivisionError):",
          FAULTS + "test_without_a_home_nothing_is_remembered"),
    Break("a clock that jumps", "deadlines of workers go by it", "claims/run.py", "time.monotonic()", "time.time()",
          FAULTS + "test_a_clock_that_jumps_changes_no_verdict"),
    Break("a clock that jumps", "budgets go by it", "budget.py", "time.monotonic()", "time.time()",
          FAULTS + "test_a_clock_that_jumps_changes_no_verdict"),
    Break("two runs, one cache", "an entry is written in its place", "claims/remembered.py",
          'tempfile.mkstemp(dir=kept.folder, prefix=".new-")',
          "(os.open(place, os.O_RDWR | os.O_CREAT | os.O_TRUNC, 0o600), str(place))",
          FAULTS + "test_two_runs_that_remember_at_once_spoil_nothing"),
    Break("a damaged entry of the cache", "the checksum isn't compared", "claims/remembered.py",
          'whole["checksum"] != _checksum(body) or', "", REMEMBERED + "test_a_tampered_verdict_is_ignored"),
    Break("the same, cut short", "that isn't caught", "claims/remembered.py",
          "except (InputError, OSError, ValueError, KeyError,", "except (InputError, OSError, KeyError,",
          REMEMBERED + "test_damaged_entries_are_ignored"),
    Break("the same, of another claim", "what is read isn't compared with the claim", "claims/remembered.py",
          'and fits("claim", record, Entry(name, claim.index, claim))', "",
          FAULTS + "test_a_memory_with_anything_in_it_is_none"),
    Break("a damaged journal", "the checksum isn't compared", "claims/journal.py",
          'whole["check"] == _checksum(body) and', "", JOURNAL + "test_lines_that_are_damaged_are_none"),
    Break("a journal that was cut short", "the next line is joined to it", "claims/journal.py",
          'b"\\n" * cut + line', "line", JOURNAL + "test_lines_that_are_damaged_are_none"),
    Break("a file changes while it is worked on", "a journal names answers by what it says now", "claims/journal.py",
          "{entry.digest or entry.path}", "{Path(entry.path).read_text()}",
          CHANGED + "test_a_journal_answers_for_what_was_read"),
    Break("the same", "what is remembered is named so", "cli/verify.py",
          "remember(kept, entries[positions[0]].digest,",
          "from canon.claims.document import content, digest\n"
          "            remember(kept, digest(content(entries[0].path)),",
          CHANGED + "test_so_does_what_is_remembered"),
    Break("the same", "certificates are made of what it says now", "claims/worker.py",
          "if entry.digest and document.digest(text) != entry.digest:", "if False:",
          CHANGED + "test_no_certificate_quotes_another_file"),
    Break("an entry of the cache is a pipe", "it is waited for", "claims/remembered.py",
          'os.O_RDONLY | getattr(os, "O_NONBLOCK", 0)', "os.O_RDONLY",
          CHANGED + "test_an_entry_that_is_no_file_is_no_memory[pipe"),
    Break("a folder in the cache is a link", "it is emptied", "claims/remembered.py",
          "and not folder.is_symlink()", "", CHANGED + "test_only_what_is_ours_is_forgotten"),
    Break("a journal of two runs at once", "a line is written in two pieces", "claims/journal.py",
          "if os.write(handle, data) < len(data):",
          "if os.write(handle, data[:9]) + (time.sleep(0.01) or os.write(handle, data[9:])) < len(data):",
          JOURNAL + "test_killed_outright_and_resumed_by_two_at_once"),
    Break("a campaign that is interrupted", "answers aren't read again", "cli/verify.py",
          "results |= answered(diary, entries)", "answered(diary, entries)",
          JOURNAL + "test_interrupted_at_random_and_resumed"),
    Break("a full disk: tables, figures, proofs", "the error isn't caught", "cli/simulate.py",
          "except OSError as error:\n            faults", "except ZeroDivisionError as error:\n            faults",
          TARGETS + "test_a_full_disk_costs_the_file_and_not_what_was_computed[csv"),
    Break("a full disk: tables, figures, proofs", "the error isn't caught", "cli/verify_output.py",
          'except OSError as error:\n        return f"{name!r} can',
          'except ZeroDivisionError as error:\n        return f"{name!r} can',
          TARGETS + "test_a_full_disk_costs_the_file_and_not_what_was_computed[proof"),
    Break("an executor loses a worker", "what it had isn't asked again", "claims/batches.py",
          "again += once_more", "pass",
          "tests/claims/test_many.py::test_what_a_lost_worker_had_is_asked_again"),
    Break("a claim overstays on an executor", "its process isn't waited for with a limit", "claims/apart.py",
          "if not self.connection.poll(min(seconds + settings.grace_of(seconds), LONGEST)):", "if False:",
          "tests/claims/test_many.py::test_a_claim_that_overstays_or_takes_its_process_along_costs_one_answer"),
    Break("a program asks for a limit of memory", "its process keeps to none", "claims/apart.py",
          "isolate(memory)", "isolate(None)", "tests/claims/test_apart.py::test_neither_time_nor_memory_is_exceeded"),
    Break("a program forks", "both ask over one pipe", "claims/apart.py",
          "os.register_at_fork(after_in_child=_forget)", "pass",
          "tests/claims/test_apart.py::test_a_fork_shares_no_pipe_with_its_parent"),
    Break("standard streams are closed", "they stay so", "cli/main.py",
          "    _open_what_is_closed()\n    for", "    for",
          "tests/cli/test_streams.py::test_streams_that_are_closed_are_nowhere"),
    Break("a system that gives no more", "it is said to be the output", "cli/main.py",
          "refused = error.errno in REFUSED", "refused = False",
          "tests/cli/test_streams.py::test_an_error_of_the_system_is_told_from_one_of_output"),
    Break("a budget ends in a callback that nobody hears", "it is told as an error", "deadline.py",
          "if told.exc_type is not None and issubclass(told.exc_type, _Stop):", "if False:",
          "tests/test_deadline.py::test_what_is_raised_where_nobody_hears_is_raised_again"),
    Break("an error that nobody has foreseen", "its status is that of a refuted claim", "cli/main.py",
          "os._exit(FLAW)", "os._exit(1)",
          UNFORESEEN + "test_an_error_that_nobody_has_foreseen_has_a_status_of_its_own"),
    Break("variables of libraries", "they are heeded", "__main__.py",
          "        del os.environ[name]", "        pass",
          UNFORESEEN + "test_variables_of_libraries_are_not_heeded"),
    Break("folders in folders", "each asks for the next", "cli/files.py",
          "    waiting += [entry.path for entry in reversed(inside) if _is_folder(entry, False)]",
          "    for entry in inside:\n            if _is_folder(entry, False):\n"
          "                yield from files_below(entry.path, ending, unreadable)",
          UNFORESEEN + "test_folders_lie_in_folders_as_deep_as_they_like"),
    Break("a certificate that can't be made", "the error isn't caught", "report/proof_file.py",
          "except Exception as error:", "except ZeroDivisionError as error:",
          UNFORESEEN + "test_a_verdict_stands_whatever_happens_to_its_certificate"),
    Break("a full disk: a PDF", "it is drawn into its file", "report/whole_file.py",
          "figure.savefig(drawn, dpi=150, format=ending)",
          "return atomically(path, lambda file: figure.savefig(file, dpi=150, format=ending))",
          UNFORESEEN + "test_a_figure_is_drawn_before_its_file_is_begun"),
    Break("an entry of the cache in the place of another", "its name isn't compared", "claims/remembered.py",
          '(body["format"], body["name"]) != (FORMAT, kept.name(digest))', 'body["format"] != FORMAT',
          REMEMBERED + "test_an_entry_in_the_place_of_another_is_none"),
    Break("few threads", "they aren't counted", "cli/main.py",
          "if arguments.command in COMPILING and not", "if False and not",
          UNFORESEEN + "test_a_program_without_threads_says_so"),
    Break("a signal while Python ends", "it is heard", "__main__.py",
          "signal.signal(getattr(signal, name), signal.SIG_IGN)", "pass",
          UNFORESEEN + "test_no_signal_changes_a_status_that_is_known"),
)  # fmt: skip
"""What may happen, and what is done about it that a test would miss."""


def passes(place: Path, test: str) -> bool:
    """Whether a test passes in a copy. What isn't found, or doesn't end, doesn't."""
    file, _, name = test.partition("::")
    name, _, case = name.partition("[")
    chosen = [f"{file}::{name}", *(["-k", f"{name} and {case}"] if case else [])]
    environment = {**os.environ, "PYTHONPATH": str(place), "CANON_PROFILE": "ci"}
    command = [sys.executable, "-m", "pytest", "-q", "-x", "-n", "0", "-p", "no:cacheprovider", *chosen]
    process = subprocess.Popen(
        command,
        cwd=place,
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        return process.wait(LONGEST) == 0
    except subprocess.TimeoutExpired:
        return False
    finally:
        with suppress(OSError):
            os.killpg(process.pid, signal.SIGKILL)  # also what a broken copy has left behind
        process.wait()


def main() -> int:
    """Try every break, and print what was noticed, as JSON; exit status 1 where one wasn't."""
    parser = argparse.ArgumentParser(prog="python -m properties.broken", description=__doc__)
    parser.add_argument("words", nargs="*", help="of the faults that are tried (default: all)")
    asked = parser.parse_args()
    here = Path(__file__).resolve().parents[1]
    chosen = [b for b in BREAKS if all(word in f"{b.fault} {b.how} {b.test}" for word in asked.words)]
    rows = []
    with tempfile.TemporaryDirectory(prefix="broken-") as name:
        place = Path(name)
        for part in ("canon", "tests", "properties"):
            shutil.copytree(here / part, place / part, ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy(here / "pyproject.toml", place)
        sound = {test: passes(place, test) for test in dict.fromkeys(b.test for b in chosen)}
        for b in chosen:
            path = place / "canon" / b.file
            text = path.read_text(encoding="utf-8")
            found = text.count(b.old) > 0
            extra = "import time\n" if b.file == "claims/journal.py" else ""
            path.write_text(
                text.replace(b.old, b.new).replace("import stat\n", "import stat\n" + extra), encoding="utf-8"
            )
            noticed = found and sound[b.test] and not passes(place, b.test)
            path.write_text(text, encoding="utf-8")
            why = (
                ""
                if noticed
                else "the text isn't there"
                if not found
                else "fails anyway"
                if not sound[b.test]
                else "passes"
            )
            rows.append({"fault": b.fault, "broken": b.how, "test": b.test, "noticed": noticed, "why": why})
            print(json.dumps(rows[-1]), flush=True)
    left = [row for row in rows if not row["noticed"]]
    print(json.dumps({"broken": len(rows), "noticed": len(rows) - len(left)}))
    return 1 if left else 0


if __name__ == "__main__":
    sys.exit(main())
