"""Share of a worker's time in the engines and outside of them.

    python benchmarks/engine_share.py --seeds 1

One process makes all pieces of a sweep, as a worker does. The entrances of the engines (OMPL,
Pinocchio with Coal, toppra, PyBullet) are timed, and their calls back into Python are not: the time
is attributed to the innermost side that runs. The rest is outside: arguments of bindings, monitoring,
recording, grasp analysis, texts and digests.
"""

from __future__ import annotations

import argparse
import cProfile
import functools
import json
import pstats
import sys
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

REPOSITORY = Path(__file__).resolve().parent.parent
OUTSIDE = "outside"
_CALLS = 20_000


class Sides:
    """Stopwatch of the two sides; exactly one runs at any time."""

    def __init__(self) -> None:
        self.seconds: Counter[str] = Counter()
        self.calls: Counter[str] = Counter()
        self._side = OUTSIDE
        self._since = time.perf_counter()

    def timed(self, side: str, function: Callable[..., Any]) -> Callable[..., Any]:
        """The function, with its time attributed to a side."""

        @functools.wraps(function, updated=())
        def call(*arguments: Any, **options: Any) -> Any:
            before = self._turn(side)
            self.calls[side] += 1
            try:
                return function(*arguments, **options)
            finally:
                self._turn(before)

        return call

    def _turn(self, side: str) -> str:
        now, before = time.perf_counter(), self._side
        self.seconds[before] += now - self._since
        self._side, self._since = side, now
        return before

    def cost_of_a_call(self) -> tuple[float, float]:
        """Overhead of the timing of one call of an engine, in s: within the engine and outside of it."""
        bare = _nothing
        timed = self.timed("nothing", bare)
        best = (float("inf"), float("inf"))
        for _ in range(9):
            # As many arguments as calls of an engine have on average.
            begun = time.perf_counter()
            for _ in range(_CALLS):
                bare(0, 1, 2, 3)
            bare_s = time.perf_counter() - begun
            self.restart()
            begun = time.perf_counter()
            for _ in range(_CALLS):
                timed(0, 1, 2, 3)
            took_s = time.perf_counter() - begun
            # What the call itself takes belongs to it, wherever it is counted.
            within_s = self.seconds["nothing"]
            best = min(best, ((within_s - bare_s) / _CALLS, (took_s - within_s) / _CALLS), key=sum)
        self.restart()
        return best

    def outside_s(self) -> float:
        """Time outside of all engines so far, that of timing them included."""
        self._turn(self._side)
        return self.seconds[OUTSIDE]

    def restart(self) -> None:
        """Reset the times."""
        self._turn(self._side)
        self.seconds.clear()
        self.calls.clear()


def _nothing(*_: Any) -> None:
    """Placeholder for a call of an engine."""


def time_engines(sides: Sides) -> None:
    """Time the entrances of all engines in this process, for as long as it lives."""
    import pinocchio
    import pybullet
    import toppra

    from rgss.motion import SOURCE_PLANNERS
    from rgss.motion.engine import load_engine

    base, geometric, _ = load_engine()
    for name, member in list(vars(pybullet).items()):
        if callable(member) and not isinstance(member, type):
            setattr(pybullet, name, sides.timed("PyBullet", member))
    for name in (
        "computeCollisions",
        "computeDistances",
        "forwardKinematics",
        "updateFramePlacement",
        "updateFramePlacements",
        "framesForwardKinematics",
        "computeFrameJacobian",
        "computeJointJacobians",
        "getFrameJacobian",
        "getFrameVelocity",
        "getFrameAcceleration",
        "rnea",
        "crba",
    ):
        if hasattr(pinocchio, name):
            setattr(pinocchio, name, sides.timed("Pinocchio and Coal", getattr(pinocchio, name)))
    for name in SOURCE_PLANNERS:
        planner = getattr(geometric, name)
        for method in ("__init__", "setup", "solve"):
            setattr(planner, method, sides.timed("OMPL", getattr(planner, method)))
    for name in ("StateValidityCheckerFn", "PlannerTerminationConditionFn"):
        adapter = getattr(base, name)
        # What the planner calls back is ours again.
        setattr(base, name, lambda function, adapter=adapter: adapter(sides.timed(OUTSIDE, function)))
    from rgss.motion import search

    validator_of = search.motion_validator

    def timed_validator(*given: Any) -> Any:
        validator = validator_of(*given)
        kind = type(validator)
        kind.checkMotion = sides.timed(OUTSIDE, kind.checkMotion)
        return validator

    search.motion_validator = timed_validator
    for method in ("__init__", "compute_parameterization"):
        algorithm = toppra.algorithm.TOPPRA
        setattr(algorithm, method, sides.timed("toppra", getattr(algorithm, method)))


def measure(seeds: int, *, fidelity: str = "contact", project: Path = REPOSITORY, top: int = 0) -> dict[str, Any]:
    """Make the pieces of a sweep in this process; return the time of each side in seconds.

    Args:
        seeds: Replicates of each variant.
        fidelity: Fidelity of the trials.
        project: The project's folder.
        top: How many functions to show of a profile by cProfile, which itself costs time; 0 for none.
    """
    from rgss.sweep.worker_process import settle

    settle()
    from rgss.studies.expansion import trial_specs
    from rgss.studies.project import load_project
    from rgss.sweep.task_queue import TaskQueue
    from rgss.sweep.trial_keys import trials_of
    from rgss.trials.pieces.run import make

    loaded = load_project(project).with_replicates(seeds).with_fidelity(fidelity)
    sides = Sides()
    time_engines(sides)
    work = TaskQueue(trials_of(trial_specs(loaded)))
    pieces: dict[str, Any] = {}
    kinds: Counter[str] = Counter()
    outside: Counter[str] = Counter()
    timed: Counter[str] = Counter()
    profile = cProfile.Profile()
    # The first search, timing and world load what a worker loads once.
    warm = TaskQueue(trials_of(trial_specs(loaded.with_replicates(1)))[:1])
    while warm.left:
        task = warm.take()
        pieces[task.digest] = make(task, {digest: pieces[digest] for digest in task.needs})
        warm.done(task.digest, took_s=0.0)
    sides.restart()
    begun, cpu = time.perf_counter(), time.process_time()
    if top:
        profile.enable()
    while work.left:
        task = work.take()
        before, outside_before, calls_before = time.perf_counter(), sides.outside_s(), sum(sides.calls.values())
        pieces[task.digest] = make(task, {digest: pieces[digest] for digest in task.needs})
        kinds[task.kind.value] += time.perf_counter() - before
        outside[task.kind.value] += sides.outside_s() - outside_before
        timed[task.kind.value] += sum(sides.calls.values()) - calls_before
        work.done(task.digest, took_s=0.0)
    if top:
        profile.disable()
        pstats.Stats(profile).sort_stats("tottime").print_stats(top)
    took_s, cpu_s = time.perf_counter() - begun, time.process_time() - cpu
    seconds, calls = dict(sides.seconds), dict(sides.calls)
    within_s, around_s = sides.cost_of_a_call()
    engines = {side: max(0.0, seconds[side] - calls[side] * within_s) for side in sorted(seconds) if side != OUTSIDE}
    timing_s = sum(calls.values()) * (within_s + around_s)
    own_s = took_s - timing_s
    outside_s = own_s - sum(engines.values())
    return {
        "pieces": len(pieces),
        "wall_s": own_s,
        "cpu_s": cpu_s,
        "timing_s": timing_s,
        "outside_s": outside_s,
        "outside_share": outside_s / own_s,
        "engines_s": engines,
        "engine_calls": {side: calls[side] for side in engines},
        "kinds_s": {kind: kinds[kind] - timed[kind] * (within_s + around_s) for kind in sorted(kinds)},
        "kinds_outside_s": {kind: outside[kind] - timed[kind] * around_s for kind in sorted(kinds)},
    }


def main() -> None:
    """Measure and print JSON."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--fidelity", default="contact")
    parser.add_argument("--project", type=Path, default=REPOSITORY)
    parser.add_argument("--top", type=int, default=0, help="functions of a profile to show")
    options = parser.parse_args()
    found = measure(options.seeds, fidelity=options.fidelity, project=options.project, top=options.top)
    sys.stdout.write(json.dumps(found, indent=2) + "\n")


if __name__ == "__main__":
    main()
