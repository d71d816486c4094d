"""Records of trials under other numeric kernels, compared bit for bit.

    python benchmarks/kernels.py [--variants 1,10,28,40,65] [--seed 1]

Each trial is run under every setting twice: as a worker runs it, with the numeric environment, and in a process
that has whatever the setting chose. Only the first must always give the same records. Settings are environment
variables that are read when a process starts, as a processor of another kind is; what cannot be chosen this way,
such as a C library of another version, is not tried here. Exit status 1 if a record differs.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[1]

_CORE, _NUMPY, _GLIBC = "OPENBLAS_CORETYPE", "NPY_DISABLE_CPU_FEATURES", "GLIBC_TUNABLES"
_CHOSEN = (_CORE, _NUMPY, _GLIBC, "NPY_ENABLE_CPU_FEATURES", "OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS")
_CAPABILITIES = "glibc.cpu.hwcaps="

_RUN = """
import json, os, sys, time
from pathlib import Path
from rgss.evidence import PieceKind, record_digest
from rgss.evidence.records.digests import text_digest
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.trials.pieces.pieces import make_piece, record_of, tasks_of
from rgss.trials.code.numeric_probe import numerics
from rgss.trials.pieces.input_digests import digests_of
from rgss.trials.code.piece_versions import versions

folder, variants, seed = Path(sys.argv[1]), json.loads(sys.argv[2]), int(sys.argv[3])
project = load_project(folder).with_fidelity("contact")
specs = trial_specs(project, variants=[project.designs.variant(one) for one in variants], seeds=[seed])
found, made, begun = {}, {}, time.process_time()
for spec in specs:
    pieces = {}
    for task in tasks_of(spec, digests_of(spec, versions())):
        if task.digest not in made:
            made[task.digest] = make_piece(task, made)
        pieces[task.kind] = made[task.digest]
        found[f"{spec.variant} {task.kind.value}"] = text_digest(made[task.digest].text)
    found[f"{spec.variant} record"] = record_digest(record_of(spec, pieces))
took_s = time.process_time() - begun
print(json.dumps({"found": found, "numerics": dict(numerics()), "took_s": took_s}))
"""


def settings() -> dict[str, dict[str, str]]:
    """Environments that a processor or a user may choose, by name."""
    import numpy as np

    dispatched = " ".join(np.show_config(mode="dicts").get("SIMD Extensions", {}).get("found", []))
    return {
        "this processor": {},
        **{f"OpenBLAS {core}": {_CORE: core} for core in ("Prescott", "Nehalem", "Sandybridge", "Haswell", "Zen")},
        "OpenBLAS SkylakeX": {_CORE: "SkylakeX"},
        "NumPy baseline": {_NUMPY: dispatched},
        "libm without FMA": {_GLIBC: f"{_CAPABILITIES}-FMA,-FMA4,-FMA_Usable,-FMA4_Usable"},
        "C library without AVX": {
            _GLIBC: f"{_CAPABILITIES}-AVX,-AVX2,-AVX512F,-AVX512VL,-FMA,-FMA4,-AVX_Usable,-AVX2_Usable,-FMA_Usable"
        },
        "four threads": {"OPENBLAS_NUM_THREADS": "4", "OMP_NUM_THREADS": "4"},
        "all of an old processor": {
            _CORE: "Nehalem",
            _NUMPY: dispatched,
            _GLIBC: f"{_CAPABILITIES}-AVX,-AVX2,-FMA,-FMA4,-SSE4_1,-SSE4_2,-AVX_Usable,-AVX2_Usable,-FMA_Usable",
        },
    }


def run(environment: dict[str, str], variants: list[int], seed: int) -> dict[str, object]:
    """Run the trials in a process with an environment; returns their records."""
    words = [sys.executable, "-c", _RUN, str(PROJECT), json.dumps(variants), str(seed)]
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)  # noqa: S603
    if done.returncode:
        raise SystemExit(f"the trials cannot be run: {done.stderr.strip().splitlines()[-1]}")
    found: dict[str, object] = json.loads(done.stdout.splitlines()[-1])
    return found


def main() -> int:
    """Run everything and print a row a setting; 1 if a record of a worker differs."""
    from rgss.trials.code.kernel_environment import numeric_environment

    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--variants", default="1,10,28,40,65", help="ids of the variants")
    parser.add_argument("--seed", type=int, default=1, help="the trials' seed")
    options = parser.parse_args()
    variants = [int(one) for one in options.variants.split(",")]
    plain = {name: value for name, value in os.environ.items() if name not in _CHOSEN}
    first: dict[bool, dict[str, str]] = {}
    spent = {True: 0.0, False: 0.0}
    failed = False
    out = sys.stdout
    out.write(
        f"{'setting':26}{'worker: records that differ':30}{'other process: records that differ':38}libm, NumPy, BLAS\n"
    )
    for name, chosen in settings().items():
        cells = []
        for fixed in (True, False):
            environment = numeric_environment({**plain, **chosen}) if fixed else {**plain, **chosen}
            result = run(environment, variants, options.seed)
            found = dict(result["found"])  # type: ignore[call-overload]
            spent[fixed] += float(str(result["took_s"]))
            differing = [key for key in found if found[key] != first.setdefault(fixed, found)[key]]
            records = sum(key.endswith("record") for key in differing)
            failed = failed or (fixed and bool(differing))
            cells.append(f"{records} of {len(variants)}, {len(differing) - records} pieces")
            if not fixed:
                numerics = dict(result["numerics"])  # type: ignore[call-overload]
        kernels = ", ".join(numerics[part].rpartition(" ")[2] for part in ("libm", "numpy", "blas"))
        out.write(f"{name:26}{cells[0]:30}{cells[1]:38}{kernels}\n")
        out.flush()
    out.write(
        f"Processor time of a worker's trials as a share of the other process's: {spent[True] / spent[False]:.2f}\n"
    )
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
