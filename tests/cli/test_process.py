"""The command line as a process: pipes that break, disks that are full, and Ctrl-C."""

from __future__ import annotations

import importlib
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from rgss.cli.main import module_name

RGSS = [sys.executable, "-m", "rgss.cli.main"]


@pytest.mark.parametrize("words", [["variants"], ["variants", "--json"], ["check"], ["check", "--json"]])
def test_a_reader_that_goes_away_is_no_error(untouched, words):
    command = [*RGSS, *words, "--project", str(untouched)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.close()
        errors = process.stderr.read()

    assert (process.returncode, errors) == (0, b"")


def test_a_reader_of_one_line(untouched):
    done = subprocess.run(
        ["/bin/sh", "-c", '"$0" "$@" | head -n 1', *RGSS, "variants", "--project", str(untouched)],
        capture_output=True,
        text=True,
        check=False,
    )

    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("id ")
    assert len(done.stdout.splitlines()) == 1


@pytest.mark.parametrize("words", [["variants"], ["check"], ["--help"], ["--version"], ["sweep", "--help"]])
def test_a_full_disk_is_told_in_one_line(untouched, words):
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [*RGSS, *words], cwd=untouched, stdout=full, stderr=subprocess.PIPE, text=True, check=False
        )

    assert done.returncode == 3
    assert done.stderr == "rgss: the output cannot be written: No space left on device\n"


def test_bad_input_and_help_by_exit_status(rgss_process, tmp_path):
    bad, helped = rgss_process("check", "--project", tmp_path), rgss_process("--help")

    assert (bad.returncode, bad.stdout, len(bad.stderr.splitlines())) == (2, "", 1)
    assert (helped.returncode, helped.stderr) == (0, "")


def test_an_interrupt_before_the_work_begins_is_one_line():
    # The signal is written into a pipe, so that none is missed that comes before the pipe is read; a shell that
    # runs the tests in the background has them ignore it.
    script = (
        "import os, signal, sys; from rgss.cli import main as module; read_end, write_end = os.pipe(); "
        "os.set_blocking(write_end, False); signal.set_wakeup_fd(write_end); "
        "signal.signal(signal.SIGINT, signal.default_int_handler); "
        "module.command_line = lambda: (print('ready', flush=True), os.read(read_end, 1)); "
        "sys.exit(module.main())"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stdout.readline() == "ready\n"
    os.kill(process.pid, signal.SIGINT)
    output, errors = process.communicate()

    assert (process.returncode, output, errors) == (130, "", "rgss: interrupted\n")


def test_a_second_interrupt_cuts_off_nothing():
    """It comes while the message is printed, and once more while the interpreter ends."""
    script = (
        "import atexit, os, signal, sys; from rgss.cli import main as module; again = lambda: os.kill(os.getpid(), "
        "signal.SIGINT); signal.signal(signal.SIGINT, signal.default_int_handler); own = module._print_error; "
        "module._print_error = lambda text: (again(), own(text)); atexit.register(again); "
        "module.command_line = again; sys.exit(module.main())"
    )
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stdout, ended.stderr) == (130, "", "rgss: interrupted\n")


@pytest.mark.parametrize("error", ["ValueError('wrapped')", "ImportError('of a module whose import was cut off')"])
def test_an_interrupt_that_a_library_turns_into_an_error_is_one(error):
    """As pydantic does where it comes within the validator of a model."""
    script = (
        "import os, signal, sys; from rgss.cli import main as module; "
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "def wrapped():\n"
        "    try:\n        os.kill(os.getpid(), signal.SIGINT); signal.pause()\n"
        f"    except KeyboardInterrupt:\n        raise {error}\n"
        "module.command_line = wrapped; sys.exit(module.main())"
    )
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stdout, ended.stderr) == (130, "", "rgss: interrupted\n")


def test_an_interrupt_while_modules_are_imported_is_one_line():
    """What is looked up for the message may need a module whose import was cut off."""
    script = (
        "import signal, sys; from rgss.cli import main as module; "
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "def cut_off():\n    sys.modules['rgss.studies'] = None; signal.raise_signal(signal.SIGINT)\n"
        "module.command_line = cut_off; sys.exit(module.main())"
    )
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stdout, ended.stderr) == (130, "", "rgss: interrupted\n")


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
def test_an_interrupt_at_the_very_end_cuts_off_nothing(untouched, name):
    """It comes when the work is done, while the interpreter ends processes and removes temporary files."""
    script = (
        "import atexit, os, signal, sys; from rgss.cli.main import main; "
        "signal.signal(signal.SIGINT, signal.default_int_handler); "
        "atexit.register(lambda: (os.kill(os.getpid(), signal.Signals[sys.argv.pop()]), print('cleaned up'))); "
        "own, sys.argv = sys.argv.pop(), ['rgss']; name = own; "
        "status = main(); sys.argv.append(name); sys.exit(status)"
    )
    command = [sys.executable, "-c", script, name]
    ended = subprocess.run(command, cwd=untouched, capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stdout.splitlines()[-1], ended.stderr) == (0, "cleaned up", "")


# Of a run under nohup, whose children ignore SIGHUP too.
REQUEST = (
    "import os, signal, sys; from rgss.cli import main as module; "
    "[signal.signal(number, signal.SIG_DFL) for number in (signal.SIGTERM, signal.SIGHUP)]; "
    "again = lambda: [os.kill(os.getpid(), signal.Signals[name]) for name in sys.argv[1].split()]; "
    "own = module._print_error; module._print_error = lambda text: (again(), own(text)); "
    "module.command_line = lambda: (again(), signal.pause()); sys.exit(module.main())"
)


@pytest.mark.parametrize("names", ["SIGTERM", "SIGHUP", "SIGTERM SIGHUP", "SIGHUP SIGINT SIGTERM"])
def test_a_request_to_terminate_ends_a_verb_as_an_interrupt_does(names):
    """Of a scheduler, of a service manager, which may send two at once, and of a terminal that is closed."""
    ended = subprocess.run([sys.executable, "-c", REQUEST, names], capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stdout, ended.stderr) == (130, "", "rgss: interrupted\n")


def test_a_verb_under_nohup_outlives_its_terminal():
    script = (
        "import os, signal, sys; from rgss.cli import main as module; "
        "signal.signal(signal.SIGHUP, signal.SIG_IGN); own = module.command_line; "
        "module.command_line = lambda: (os.kill(os.getpid(), signal.SIGHUP), own())[1]; "
        "sys.exit(module.main())"
    )
    ended = subprocess.run([sys.executable, "-c", script, "--version"], capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stderr) == (0, "")


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["sweep"], "rgss: interrupted; finished trials are stored\n"),
        (["confirm"], "rgss: interrupted; finished trials are stored\n"),
        (["regress"], "rgss: interrupted; finished trials are stored\n"),
        (["trade", "--what-if", "charge.check=1 ms", "--run"], "rgss: interrupted; finished trials are stored\n"),
        (["trade"], "rgss: interrupted\n"),
        (["import", "csv", "table.csv"], "rgss: interrupted\n"),
        (["run", "28"], "rgss: interrupted\n"),
    ],
)
def test_an_interrupt_speaks_of_trials_where_they_are_stored(rgss, monkeypatch, words, told):
    def interrupted(_options):
        raise KeyboardInterrupt

    monkeypatch.setattr(importlib.import_module(f"rgss.cli.verbs.{module_name(words[0])}"), "run", interrupted)
    result = rgss(*words)
    assert (result.status, result.output, result.errors) == (130, "", told)
