"""Motion: planning by random trees on a counted clock, shortening, smoothing and timing of paths."""

from rgss.motion.blending import BlendedPath, SmoothPath, blend
from rgss.motion.clock import ClockKind, PlanningClock
from rgss.motion.limits import MotionLimits
from rgss.motion.paths import JointPath, path_length, segment_states
from rgss.motion.planners import PLANNERS, Planner
from rgss.motion.planning import plan
from rgss.motion.problem import PlanningProblem, PlanResult, outcome_within
from rgss.motion.timing import TimedMove, TimingOutcome, time_blended, time_move
from rgss.motion.trajectory import Trajectory
from rgss.motion.validity import StateValidity, ToolKinematics

__all__ = [
    "PLANNERS",
    "BlendedPath",
    "ClockKind",
    "JointPath",
    "MotionLimits",
    "PlanResult",
    "Planner",
    "PlanningClock",
    "PlanningProblem",
    "SmoothPath",
    "StateValidity",
    "TimedMove",
    "TimingOutcome",
    "ToolKinematics",
    "Trajectory",
    "blend",
    "outcome_within",
    "path_length",
    "plan",
    "segment_states",
    "time_blended",
    "time_move",
]
