"""Trials: simulation of the task by one design variant under one seed."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trials.conditions import DrawnValue, conditions_of, drawn_values
    from rgss.trials.filming import Film
    from rgss.trials.geometry_checks import (
        CheckStepProblem,
        HandStepProblem,
        HeldLoad,
        check_step_problems,
        draw_problems,
        hand_step_problems,
        held_loads,
    )
    from rgss.trials.impact import ClosingImpact, closing_impact
    from rgss.trials.lifecycle import Simulation, SimulationState
    from rgss.trials.metrics import (
        FOR_EACH_JOINT,
        FOR_EACH_MOVE,
        METRICS,
        PHASE_METRICS,
        Aggregation,
        MetricDescriptor,
        PhaseValue,
    )
    from rgss.trials.planning import (
        Obstacle,
        PlannedMove,
        TaskPlan,
        every_stop_is_feasible,
        infeasible_waypoints,
        plan_of,
        searches_of,
        waypoint_configurations,
    )
    from rgss.trials.plants import (
        ControlMode,
        ControlSettings,
        JointController,
        JointGains,
        is_stable,
        least_stable_rate_hz,
        stated_in_step,
    )
    from rgss.trials.scene_check import SceneProblem, SceneProblemKind, reach_problems, scene_problems
    from rgss.trials.second_engine import mujoco_settings
    from rgss.trials.settings import PlanningSettings, TrialSettings
    from rgss.trials.timing import TaskTiming, timing_of
    from rgss.trials.timing_settings import TimingProfile, TimingSettings
    from rgss.trials.tracing import run_traced_trial
    from rgss.trials.trial_spec import TrialSpec
    from rgss.trials.workcell import Workcell, cell_of, with_grasp_of
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
