"""Replay of a trial: rendered bodies and their motion, contacts, planned paths and the planner's graph."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trials.replay.replay_scene import (
        LEAST_SHOWN_S,
        ContactForce,
        Line,
        LineKind,
        NodeKind,
        NodeTrack,
        ReplayScene,
        Touch,
    )
    from rgss.trials.replay.replayed_trial import ReplayedTrial, run_replayed_trial
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
