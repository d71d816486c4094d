"""The numeric environment: what a process is started with, and the same trials whatever kernels a machine prefers."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest

from rgss.errors import EvidenceError
from rgss.evidence.records.numerics import numerics_difference, numerics_text, require_alike, results_of
from rgss.trials.code import kernel_environment as environment_module
from rgss.trials.code.kernel_environment import (
    KERNEL,
    numeric_environment,
    numeric_environment_of_children,
    problem_here,
    problem_in,
)
from rgss.trials.code.numeric_probe import fixed_numerics, numerics

HERE = {"platform": "Linux-x86_64", "libm": "glibc 2.36 aaaa", "numpy": "X86_V2 bbbb", "blas": "Nehalem+Nehalem cccc"}
OUR_CAPABILITIES = "-FMA,-FMA4,-FMA_Usable,-FMA4_Usable"


@pytest.fixture
def on_x86(monkeypatch):
    monkeypatch.setattr(environment_module, "_is_x86_64", lambda: True)
    monkeypatch.setattr(environment_module, "_dispatched", lambda: ["X86_V4", "X86_V3"])


def test_the_environment_overrules_what_a_machine_has_set(on_x86):
    preset = {
        "HOME": "/home",
        "OPENBLAS_CORETYPE": "Haswell",
        "OMP_NUM_THREADS": "8",
        "NPY_ENABLE_CPU_FEATURES": "X86_V4",
        "NPY_DISABLE_CPU_FEATURES": "AVX512_SPR, AVX512_ICL",
        "GLIBC_TUNABLES": "glibc.malloc.check=1:glibc.cpu.hwcaps=FMA,-AVX2",
    }
    chosen = numeric_environment(preset)
    assert chosen == {
        "HOME": "/home",
        "OPENBLAS_CORETYPE": KERNEL,
        "OMP_NUM_THREADS": "1",
        "OPENBLAS_NUM_THREADS": "1",
        "MKL_NUM_THREADS": "1",
        "NPY_DISABLE_CPU_FEATURES": "AVX512_ICL AVX512_SPR X86_V3 X86_V4",
        "GLIBC_TUNABLES": f"glibc.malloc.check=1:glibc.cpu.hwcaps=-AVX2,{OUR_CAPABILITIES}",
    }
    assert numeric_environment(chosen) == chosen
    assert problem_in(chosen) == ""
    assert numeric_environment({})["GLIBC_TUNABLES"] == f"glibc.cpu.hwcaps={OUR_CAPABILITIES}"


@pytest.mark.parametrize(
    ("name", "value", "problem"),
    [
        ("OPENBLAS_CORETYPE", "Haswell", "OPENBLAS_CORETYPE is Haswell instead of Nehalem"),
        ("OPENBLAS_CORETYPE", None, "OPENBLAS_CORETYPE is not set instead of Nehalem"),
        ("OPENBLAS_NUM_THREADS", "2", "OPENBLAS_NUM_THREADS is 2 instead of 1"),
        ("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA", "GLIBC_TUNABLES does not restrict the C library's kernels"),
        ("NPY_DISABLE_CPU_FEATURES", None, "NPY_DISABLE_CPU_FEATURES is not set"),
    ],
)
def test_a_process_that_was_started_with_another_is_found(on_x86, name, value, problem):
    chosen = numeric_environment({})
    changed = {**chosen, name: value} if value is not None else {k: v for k, v in chosen.items() if k != name}
    assert problem_in(changed) == problem


def test_children_get_the_environment_and_this_process_keeps_its_own(monkeypatch):
    monkeypatch.setenv("OPENBLAS_CORETYPE", "Haswell")
    monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    before = dict(os.environ)
    script = "from rgss.trials.code.kernel_environment import problem_here; print(problem_here() or 'none')"

    def child() -> str:
        return subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout.strip()

    assert child() == "OMP_NUM_THREADS is not set instead of 1"
    with numeric_environment_of_children():
        assert child() == "none"
    assert dict(os.environ) == before


def test_the_suite_computes_as_trials_do():
    assert problem_here() == ""
    assert numerics() == fixed_numerics()


def test_what_computes_the_same_is_alike_whatever_its_name():
    newer = {**HERE, "libm": "glibc 2.41 aaaa"}
    assert results_of(HERE) == {"platform": "Linux-x86_64", "libm": "aaaa", "numpy": "bbbb", "blas": "cccc"}
    assert numerics_difference(HERE, newer) == ""
    assert numerics_difference(HERE, {**HERE, "libm": "musl dddd"}) == "libm: glibc 2.36 aaaa there, musl dddd here"
    # What is not known cannot be called another.
    assert numerics_difference({}, HERE) == numerics_difference(HERE, {}) == ""
    assert numerics_text({}) == "not recorded"


def test_what_was_computed_otherwise_is_told_in_one_line():
    require_alike("it", HERE, HERE)
    with pytest.raises(EvidenceError, match=r"^it was computed with other numerics \(blas: .* there, Haswell x here\)"):
        require_alike("it", HERE, {**HERE, "blas": "Haswell x"})


ANOTHER = """
import json, sys
from rgss.trials.code.numeric_probe import numerics
if sys.argv[1:]:
    import scs  # brings an OpenBLAS of its own
print(json.dumps(dict(numerics())))
"""


def test_another_library_of_the_process_does_not_name_its_numerics():
    def run(*arguments: str) -> dict:
        done = subprocess.run([sys.executable, "-c", ANOTHER, *arguments], capture_output=True, text=True, check=True)
        return json.loads(done.stdout)

    assert run() == run("scs")


PROBE = """
import json, sys
from pathlib import Path
from rgss.evidence import record_digest
from rgss.sweep.engine_process import compute
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.trials.code.numeric_probe import fixed_numerics, numerics
from rgss.trials.pieces.run import run_trial

project = load_project(Path(sys.argv[1]))
(spec,) = trial_specs(project, variants=[project.designs.variant(1)], seeds=[1])
print(json.dumps({
    "record": record_digest(compute(run_trial, spec)),
    "own": record_digest(run_trial(spec)),
    "fixed": dict(fixed_numerics()),
    "numerics": dict(numerics()),
}))
"""
NAMES = (
    "OPENBLAS_CORETYPE",
    "OPENBLAS_NUM_THREADS",
    "OMP_NUM_THREADS",
    "MKL_NUM_THREADS",
    "GLIBC_TUNABLES",
    "NPY_DISABLE_CPU_FEATURES",
)


@pytest.mark.engine
def test_a_trial_is_the_same_bit_for_bit_whatever_kernels_the_machine_prefers(project):
    def run(**chosen: str) -> dict:
        environment = {name: value for name, value in os.environ.items() if name not in NAMES}
        done = subprocess.run(
            [sys.executable, "-c", PROBE, str(project.folder)],
            env={**environment, **chosen},
            capture_output=True,
            text=True,
            check=True,
        )
        return json.loads(done.stdout.splitlines()[-1])

    one = run(OPENBLAS_CORETYPE="Nehalem", GLIBC_TUNABLES=f"glibc.cpu.hwcaps={OUR_CAPABILITIES}")
    other = run(OPENBLAS_CORETYPE="Prescott")

    assert one["record"] == other["record"]
    assert one["fixed"] == other["fixed"] == fixed_numerics()
    # The two settings are two: what these processes compute by themselves differs, and so does the trial.
    assert numerics_difference(one["numerics"], other["numerics"])
    assert one["own"] != other["own"]
