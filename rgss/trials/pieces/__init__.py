"""Pieces of a trial, each computed once for all variants with the same inputs."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trials.pieces.assembling import record_with_plan
    from rgss.trials.pieces.bench_json import bench_from_json
    from rgss.trials.pieces.execution_json import execution_from_json
    from rgss.trials.pieces.input_digests import TrialDigests, digests_of
    from rgss.trials.pieces.pieces import PieceTask, Task, TrialTask, record_of, tasks_of
    from rgss.trials.pieces.plain_values import to_plain
    from rgss.trials.pieces.plan_json import plan_from_json, plan_to_json
    from rgss.trials.pieces.run import Pieces, make, require_search, run_trial
    from rgss.trials.pieces.timing_json import timing_from_json
    from rgss.trials.trial_spec import TrialSpec
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
