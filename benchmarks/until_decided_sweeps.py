"""Compare `rgss sweep --until decided` with 200 fixed replicates for many master seeds; every trial is run.

    python benchmarks/until_decided_sweeps.py                        20 master seeds: 40 minutes of one core
    python benchmarks/until_decided_sweeps.py --seeds 2 --step 200   two that share no trial
    python benchmarks/until_decided_sweeps.py --project FOLDER       keep the evidence there, and go on from it
    python benchmarks/until_decided_sweeps.py --json until.json

For each master seed the study's file gets that seed, and three processes run on the project: `rgss sweep
--until decided`, `rgss sweep --replicates 200`, and `rgss trade --replicates 200`, whose decision is the
one to reach. Replicate r of a study has its seed + r. Master seeds lie a step apart and have one evidence
store, so that windows of 200 seeds overlap, and trials that two of them have in common are run once. They
are taken from the last to the first: then no sweep until decided finds its first replicates, as many as the
step, in the store. It never looks at others than those that its rule asked for.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from sweep_runs import REPOSITORY, Bench

STUDY = "studies/nominal_world.yaml"
MOST_SHARE = 0.25


@dataclass(frozen=True, kw_only=True)
class Decision:
    """Outcome of a master seed by both procedures.

    Attributes:
        seed: The master seed.
        fixed: The variant that fixed replicates choose.
        variant: The one that is chosen by replication until decided.
        reason: Why that ended.
        loss: By how much the fixed replicates value it below their own choice; None if they find it infeasible.
        ties: Whether they call the two a tie: equal, or within the study's practical margin.
        probability: The probability of good selection that was reported.
        looks: Number of looks.
        trials: Trials that replication until decided asked for.
        run: How many of these the store did not have.
        share: The trials, of those of fixed replicates.
        until_s: Wall time of the sweep until decided.
        fixed_s: Wall time of the sweep with fixed replicates, which goes on from it.
    """

    seed: int
    fixed: int
    variant: int | None
    reason: str
    loss: float | None
    ties: bool
    probability: float
    looks: int
    trials: int
    run: int
    share: float
    until_s: float
    fixed_s: float


def decide(bench: Bench, folder: Path, seed: int, *, replicates: int, fidelity: str) -> Decision:
    """Decide for one master seed by both procedures."""
    file = folder / STUDY
    file.write_text(re.sub(r"(?m)^seed: \d+$", f"seed: {seed}", file.read_text(encoding="utf-8")), encoding="utf-8")
    words = ("--jobs", bench.jobs, "--fidelity", fidelity)
    before = trials_in(folder)
    until = bench.sweep(folder, *words, "--until", "decided", "--cap", replicates)
    run = trials_in(folder) - before
    fixed = bench.sweep(folder, *words, "--replicates", replicates)
    trade = traded(folder, "--fidelity", fidelity, "--replicates", str(replicates))
    variant, best = until.document["variant"], trade["chosen"]
    values = {each["variant"]: each["value"] for each in trade["ranking"]}
    return Decision(
        seed=seed,
        fixed=best,
        variant=variant,
        reason=until.document["reason"],
        loss=values[best] - values[variant] if variant in values else None,
        ties=variant in {best, *trade["ties"], *trade["near_ties"]},
        probability=until.document["probability"],
        looks=until.document["looks"],
        trials=until.document["trials"],
        run=run,
        share=until.document["trials"] / fixed.document["trials"],
        until_s=until.wall_s,
        fixed_s=fixed.wall_s,
    )


def trials_in(folder: Path) -> int:
    """How many trials a project's store has."""
    from rgss.evidence import EvidenceStore

    file = folder / ".rgss" / "evidence.sqlite"
    if not file.exists():
        return 0
    with EvidenceStore.open(file, create=False) as store:
        return len(store)


def traded(folder: Path, *words: str) -> dict[str, Any]:
    """The decision by the evidence."""
    command = [sys.executable, "-m", "rgss.cli.main", "trade", "--project", str(folder), "--brief", "--json", *words]
    done = subprocess.run(command, stdout=subprocess.PIPE, check=True, cwd=REPOSITORY)  # noqa: S603
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def summary(decisions: Sequence[Decision], *, step: int, replicates: int) -> dict[str, Any]:
    """The figures over all master seeds."""
    trials = sum(each.trials for each in decisions)
    return {
        "master_seeds": len(decisions),
        "step": step,
        "fixed_replicates": replicates,
        "seeds_run": replicates + step * (len(decisions) - 1),
        "decided": sum(each.reason == "decided" for each in decisions),
        "same_variant": sum(each.variant == each.fixed for each in decisions),
        "same_or_tie": sum(each.ties for each in decisions),
        "share": trials / sum(each.trials / each.share for each in decisions),
        "greatest_share": max(each.share for each in decisions),
        "run_by_until_decided": sum(each.run for each in decisions) / trials,
        "decisions": [asdict(each) for each in decisions],
    }


def main() -> int:
    """Decide again and again; print a table in Markdown; 1 if a decision differs or costs too much."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=20, metavar="N", help="master seeds (default: 20)")
    parser.add_argument("--first", type=int, default=1, metavar="N", help="the least of them (default: 1)")
    parser.add_argument("--step", type=int, default=15, metavar="N", help="from one to the next (default: 15)")
    parser.add_argument("--replicates", type=int, default=200, metavar="N", help="fixed replicates (default: 200)")
    parser.add_argument("--fidelity", default="kinematic", help="fidelity of the trials (default: kinematic)")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="worker processes (default: 2)")
    parser.add_argument("--project", type=Path, help="a copy of the project made for this, to keep its evidence")
    parser.add_argument("--json", type=Path, help="also write the figures there")
    options = parser.parse_args()
    out = sys.stdout
    out.write(
        f"| master seed | {options.replicates} fixed | until decided | ended | loss | probability | looks | trials "
        "| share | newly run |\n|---|---|---|---|---|---|---|---|---|---|\n"
    )
    decisions: list[Decision] = []
    begun = time.monotonic()
    with ExitStack() as stack:
        work = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        bench = Bench(REPOSITORY, work, replicates=options.replicates, jobs=options.jobs)
        folder = options.project or bench.project()
        for number in reversed(range(options.seeds)):
            seed = options.first + options.step * number
            one = decide(bench, folder, seed, replicates=options.replicates, fidelity=options.fidelity)
            decisions.append(one)
            loss = "infeasible" if one.loss is None else f"{one.loss:.4f}"
            told = (seed, one.fixed, one.variant, one.reason, loss, f"{one.probability:.3f}", one.looks, one.trials)
            out.write("| " + " | ".join(map(str, (*told, f"{one.share:.1%}", one.run))) + " |\n")
            out.flush()
            found = summary(decisions, step=options.step, replicates=options.replicates)
            found["wall_s"] = round(time.monotonic() - begun, 1)
            if options.json is not None:
                options.json.write_text(json.dumps(found, indent=2) + "\n", encoding="utf-8")
    kept = found["same_or_tie"] == len(decisions) and found["share"] <= MOST_SHARE
    out.write(
        f"\n{found['decided']} of {len(decisions)} decided; {found['same_variant']} choose the same variant as "
        f"{options.replicates} fixed replicates, {found['same_or_tie']} the same or one that these call a tie; "
        f"{found['share']:.1%} of the trials (bar: all, ≤ {MOST_SHARE:.0%}): {'kept' if kept else '**not kept**'}\n"
    )
    return 0 if kept else 1


if __name__ == "__main__":
    raise SystemExit(main())
