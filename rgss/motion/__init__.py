"""Motion planning with a counted clock; simplification, blending and timing of paths."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.motion.blending import SmoothPath, blend
    from rgss.motion.clock import ClockKind, PlanningClock
    from rgss.motion.limits import MotionLimits
    from rgss.motion.paths import JointPath, path_length, segment_states
    from rgss.motion.planner_catalogue import (
        SOURCE_PLANNERS,
        Objective,
        OmplPlanner,
        OnUnverified,
        ParameterType,
        PlannerParameter,
        PlannerSettings,
        available_planners,
        ompl_planners,
        refusal_of,
        takes_objective,
    )
    from rgss.motion.planning import plan
    from rgss.motion.problem import PlanningProblem, PlanResult
    from rgss.motion.profiles import time_move_by_joint_waypoints, time_move_by_trapezoids, trapezoidal_trajectory
    from rgss.motion.roadmap import SearchGraph
    from rgss.motion.timing import TimedMove, TimingOutcome, time_blended, time_move
    from rgss.motion.trajectory import Trajectory
    from rgss.motion.validity import StateCost
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
