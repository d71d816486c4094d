"""All trials of a study on workers: task queue, resume, dry run and replay."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.sweep.agreement import Agreement, beyond_tolerance, deviation
    from rgss.sweep.engine_process import compute
    from rgss.sweep.evidence_writer import Origin, origin_of
    from rgss.sweep.inline_workers import InlineWorkers
    from rgss.sweep.input_changes import values_by_name
    from rgss.sweep.kept_searches import KeptSearches
    from rgss.sweep.persistent_pool import PersistentWorkerPool
    from rgss.sweep.planner_comparison import ComparedPlanner, compared_planners, has_searches, limits_of
    from rgss.sweep.planning_history import planning_runs
    from rgss.sweep.preview import Cause, DryRun, DueTrials, Reason, dry_run
    from rgss.sweep.reading_off import FoundTrials, StoredSearches
    from rgss.sweep.replaying import find_trial, replay
    from rgss.sweep.results import FinishedTrial, LostTrials, SweepResult, SweepState, WorkerLimits
    from rgss.sweep.running import Maker, sweep
    from rgss.sweep.task_end import Workers
    from rgss.sweep.trial_keys import key_of, keys_of, trials_of
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
