"""Planning of a task: its planned and direct moves, and the reasons for unreachable waypoints."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trials.planning.direct_moves import direct_move
    from rgss.trials.planning.goal_reasons import GoalReason, Obstacle
    from rgss.trials.planning.other_limits import plan_with_limits, with_limits_of
    from rgss.trials.planning.plan import plan_of, plan_task
    from rgss.trials.planning.planned_moves import PlannedMove, TaskPlan
    from rgss.trials.planning.planner_searches import searches_of
    from rgss.trials.planning.planning_costs import state_cost
    from rgss.trials.planning.present_object import with_object_named
    from rgss.trials.planning.task_stops import (
        every_stop_is_feasible,
        infeasible_waypoints,
        stops_of,
        waypoint_configurations,
    )
    from rgss.trials.planning.turned_grasp import objects_served_turned, serving_place_yaw
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
